//! What kernels in the rates of joints cost: operations, as the macro counts them.

use holonom::JointCoordinates;
use holonom_models::{Bricard, FourBar, Panda, SliderCrank, Ur5};

fn counts<M: JointCoordinates>() -> [usize; 3] {
    ["mass", "inverse", "jacobian"].map(|word| {
        let mut kernels = M::JOINT_REPORT.asked.iter();
        let kernel = kernels.find(|kernel| kernel.name == word);
        kernel.map_or(0, |kernel| kernel.operations.total())
    })
}

#[test]
fn operations() {
    assert_eq!(counts::<Ur5>(), [79, 253, 37]);
    assert_eq!(counts::<Panda>(), [368, 653, 142]);
    assert_eq!(counts::<FourBar>(), [7, 34, 0]);
    assert_eq!(counts::<SliderCrank>(), [10, 34, 2]);
    assert_eq!(counts::<Bricard>(), [28, 130, 7]);
}

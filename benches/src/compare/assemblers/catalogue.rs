//! Those of the catalogue's models.

use holonom::Mechanism;
use holonom_assembler::assembler::Assembler;
use holonom_assembler::bodies::GROUND;
use holonom_assembler::forces::Force;
use holonom_models::{CartPole, HeavyTop, Panda, SliderCrank, SqueezingMechanism, Ur5};

use super::{Join, X, Y, Z, add_bodies, in_a_row, join, scene};

pub(in crate::compare) fn heavy_top() -> Assembler {
    scene::<HeavyTop>([0.0, 0.0, -9.81], in_a_row(1, |_| Join::Ball([0.0; 3])))
}

pub(in crate::compare) fn slider_crank() -> Assembler {
    let pin = [0.459, 0.0, 0.0];
    let joints = [
        ([None, Some(0)], Join::Hinge([0.0; 3], Z)),
        ([Some(0), Some(1)], Join::Hinge([0.153, 0.0, 0.0], Z)),
        ([None, Some(2)], Join::Slider(pin, X)),
        ([Some(2), Some(1)], Join::OnLine(pin, Z)),
    ];
    scene::<SliderCrank>([0.0, -9.81, 0.0], joints)
}

pub(in crate::compare) fn cart_pole() -> Assembler {
    let joints = [
        ([None, Some(0)], Join::Slider([0.0; 3], X)),
        ([Some(0), Some(1)], Join::Hinge([0.0; 3], [0.0, 0.0, -1.0])),
    ];
    scene::<CartPole>([0.0, -9.81, 0.0], joints)
}

pub(in crate::compare) fn ur5() -> Assembler {
    let hinges = [
        ([0.0, 0.0, 0.089159], Z),
        ([0.0, 0.13585, 0.089159], Y),
        ([0.425, 0.016149999999999998, 0.08915900000208107], Y),
        ([0.81725, 0.016149999999999998, 0.08915900000400177], Y),
        (
            [0.81725, 0.10915, 0.08915900000400177],
            [9.793277300218506e-12, 0.0, -1.0],
        ),
        ([0.817250000000927, 0.10915, -0.005490999995998225], Y),
    ];
    arm::<Ur5, 6>(hinges)
}

pub(in crate::compare) fn panda() -> Assembler {
    let hinges = [
        ([0.0, 0.0, 0.333], Z),
        ([0.0, 0.0, 0.333], Y),
        ([0.0, 0.0, 0.649], Z),
        ([0.0825, 0.0, 0.649], [0.0, -1.0, 0.0]),
        ([0.0, 0.0, 1.033], Z),
        ([0.0, 0.0, 1.033], [0.0, -1.0, 0.0]),
        ([0.088, 0.0, 1.033], [0.0, 0.0, -1.0]),
    ];
    arm::<Panda, 7>(hinges)
}

/// Points and axes of an arm's hinges from the ground outwards; the motors are off.
fn arm<M: Mechanism + Default, const N: usize>(hinges: [([f64; 3], [f64; 3]); N]) -> Assembler {
    let joint = |link: usize| Join::Hinge(hinges[link].0, hinges[link].1);
    scene::<M>([0.0, 0.0, -9.81], in_a_row(N, joint))
}

pub(in crate::compare) fn squeezer() -> Assembler {
    let [rocker, e] = [
        [-0.06934, -0.00227, 0.0],
        [-0.020960022346354336, 0.0012951691937066864, 0.0],
    ];
    let joints = [
        ([None, Some(0)], Join::Hinge([0.0; 3], Z)),
        (
            [Some(0), Some(1)],
            Join::Hinge([0.006986674115451445, -0.0004317230645688955, 0.0], Z),
        ),
        ([None, Some(2)], Join::Hinge([-0.03635, 0.03273, 0.0], Z)),
        ([None, Some(4)], Join::Hinge(rocker, Z)),
        (
            [Some(4), Some(3)],
            Join::Hinge([-0.03399720388583998, 0.01646197167499768, 0.0], Z),
        ),
        ([None, Some(6)], Join::Hinge(rocker, Z)),
        (
            [Some(6), Some(5)],
            Join::Hinge([-0.03163313450740889, -0.015618868668304533, 0.0], Z),
        ),
        ([Some(2), Some(1)], Join::OnLine(e, Z)),
        ([Some(2), Some(3)], Join::OnLine(e, Z)),
        ([Some(2), Some(5)], Join::OnLine(e, Z)),
    ];
    let mut scene = Assembler::new([0.0; 3]);
    let bodies = add_bodies::<SqueezingMechanism>(&mut scene);
    join(&mut scene, &bodies, joints);
    let motor = Force::constant_moment(&scene, [GROUND, bodies[0]], [0.0, 0.0, 0.033]);
    scene.add_force(motor);
    let spring = Force::spring_damper(
        &scene,
        [GROUND, bodies[2]],
        [0.014, 0.072, 0.0],
        [-0.010472393888814626, 0.025357788530275246, 0.0],
        4530.0,
        0.0,
        0.07785,
    );
    scene.add_force(spring);
    scene
}

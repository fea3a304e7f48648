//! The drawings in the documentation are what the models and joints give.

mod bicycle;
mod contacts;
mod joints;
mod pen;

use std::fs;
use std::path::Path;

use holonom_film::Sketch as _;
use holonom_models::{
    Bicycle, Bricard, CartPole, Clock, Door, DoubleFourBar, DrivenSliderCrank, FlyballGovernor,
    FourBar, HeavyChain, HeavyTop, Panda, QuintupleFourBar, RodPendulum, SimplePendulum,
    SliderCrank, SqueezingMechanism, Ur5, VariableLengthPendulum,
};

/// Write the drawings anew: `HOLONOM_DRAW=1 cargo test -p holonom-film --test drawings`.
const WRITE: &str = "HOLONOM_DRAW";

/// Compares a file, by its path in the workspace, with what is drawn now.
fn check(path: &str, drawn: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path);
    if std::env::var_os(WRITE).is_some() {
        fs::write(&path, drawn).expect("the folder is there");
    }
    let kept = fs::read_to_string(&path).unwrap_or_default();
    assert!(
        kept == drawn,
        "{} is not what is drawn now; set {WRITE}=1",
        path.display()
    );
    // One line: in a page of documentation it is one piece of HTML.
    assert_eq!(drawn.trim_end().lines().count(), 1, "{}", path.display());
}

macro_rules! sketches {
    ($($name:literal: $model:ty,)*) => {
        #[test]
        fn models_have_the_sketches_that_they_give() {
            $(
                let sketch = <$model>::default().sketch().expect("no parameters");
                check(concat!("models/src/sketches/", $name, ".svg"), &sketch);
            )*
        }
    };
}

sketches! {
    "bicycle": Bicycle,
    "bricard": Bricard,
    "cart_pole": CartPole,
    "clock": Clock,
    "door": Door,
    "double_four_bar": DoubleFourBar,
    "driven_slider_crank": DrivenSliderCrank,
    "flyball_governor": FlyballGovernor,
    "four_bar": FourBar,
    "heavy_chain": HeavyChain,
    "heavy_top": HeavyTop,
    "panda": Panda,
    "quintuple_four_bar": QuintupleFourBar,
    "rod_pendulum": RodPendulum,
    "simple_pendulum": SimplePendulum,
    "slider_crank": SliderCrank,
    "squeezing_mechanism": SqueezingMechanism,
    "ur5": Ur5,
    "variable_length_pendulum": VariableLengthPendulum,
}

#[test]
fn the_guide_has_the_figure_of_the_joints() {
    check("runtime/src/guide/joints.svg", &joints::figure());
    check("runtime/src/guide/rolling.svg", &joints::rolling());
}

#[test]
fn the_guide_has_the_figure_of_the_contacts() {
    check("runtime/src/guide/contacts.svg", &contacts::figure());
}

#[test]
fn the_guide_has_pictures_of_a_bicycle_that_recovers() {
    check("runtime/src/guide/bicycle.svg", &bicycle::figure());
}

//! Mechanisms that were found at random and failed once, made smaller.

use holonom_engine::model::ElementKind;

use crate::comparison::Extent;
use crate::text::{Outcome, Text};

/// A given moment and a spring on one body: their sum was turned out of the body and back, which multiplied the moment of the spring by
/// `|p|^4`.
const MOMENT_AND_SPRING: &str = "
    pub struct Random {
        #[body(mass = 0.7, inertia = [1.9, 1.3, 1.1], free)]
        a: Body,
        #[body(mass = 0.9, inertia = [1.6, 1.3, 1.0], position = [0.5, 0.0, 0.0], free)]
        b: Body,
        #[force(between = [a, b], moment = [1.5, -2.6, -0.5])]
        moment: ConstantMoment,
        #[force(between = [a, b], head = [-1.2, 0.9, 0.1], tail = [0.4, -0.3, -0.5], free_length = 0.9, stiffness = 1.7)]
        spring: SpringDamper,
    }";

/// An axis by `local(..)` on a body with a full tensor: round-off of the principal axes decided which of the equal components of the axis was
/// the smallest, and so where its normals were.
const NORMALS: &str = "
    #[mechanism(redundant = \"keep\")]
    pub struct Random {
        #[body(mass = 1.9, inertia = [
            [1.3265772141905323, 0.25913251382795965, -0.03663110619993026],
            [0.25913251382795965, 1.2159225524554471, -0.05610750013414348],
            [-0.03663110619993026, -0.05610750013414348, 1.0535364933927585],
        ])]
        a: Body,
        #[body(mass = 2.2, inertia = [0.9, 0.6, 0.65])]
        b: Body,
        #[joint(between = [a, b], axis = local([0.0, 0.0, -2.0], [0.0, 0.0, -2.0]))]
        joint: Own,
    }";

#[test]
fn mechanisms_that_failed_once() {
    let own = "Own(i, j; axis: Axis) { dot(i.axis.normal(), j.origin - i.origin); }";
    for item in [MOMENT_AND_SPRING, NORMALS] {
        let text = Text {
            item: item.into(),
            definitions: vec![("Own".into(), ElementKind::Joint, own.into())],
        };
        for seed in 0..5 {
            match text.check(&text, seed, Extent::Full) {
                Ok(Outcome::Compared(_)) => {}
                Ok(Outcome::Known(defect)) => panic!("{defect}:\n{text}"),
                Ok(Outcome::Refused(why)) | Err(why) => panic!("{text}\n{why}"),
            }
        }
    }
}

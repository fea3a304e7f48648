//! Linkages whose masses are handed over closing joints: whatever link they are counted on,
//! accelerations and multipliers are those of the bodies.

use holonom_engine::coordinates::candidates::{Method, Strategy};
use holonom_engine::coordinates::system::Reduced;

use crate::common::{delivered, tokens};
use crate::comparison::Extent;
use crate::library;
use crate::text::{Outcome, Text};

/// A crank that turns all round, a coupler and a rocker, tilted, with centres of mass off their
/// middles, gravity out of their plane.
const FOUR_BAR: &str = "
    #[mechanism(gravity = [0.3, -9.7, 1.1], redundant = \"drop\")]
    pub struct Linkage {
        #[body(mass = 0.7, inertia = [0.2, 0.3, 0.4], position = [0.3, 0.5, 0.1], orientation = rotation([0.0, 0.0, 1.0], 0.3))]
        crank: Body,
        #[body(mass = 1.9, inertia = [0.5, 0.7, 0.4], position = [1.2, 1.1, 0.25], orientation = rotation([0.0, 0.0, 1.0], 1.1))]
        coupler: Body,
        #[body(mass = 1.1, inertia = [0.4, 0.2, 0.5], position = [2.3, 0.8, 0.0])]
        rocker: Body,
        #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
        foot: Revolute,
        #[joint(between = [ground, rocker], point = [2.4, -0.2, 0.1], axis = [0.0, 0.0, 1.0])]
        bearing: Revolute,
        #[joint(between = [crank, coupler], point = [0.2, 0.45, 0.2], axis = [0.0, 0.0, 1.0])]
        knee: Revolute,
        #[joint(between = [rocker, coupler], point = [1.9, 1.4, 0.3], axis = [0.0, 0.0, 1.0])]
        wrist: Revolute,
    }";

/// Two windows: the second coupler hands over to a rod that carries another one.
const WINDOWS: &str = "
    #[mechanism(gravity = [0.0, -9.81, 0.0], redundant = \"drop\")]
    pub struct Linkage {
        #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.1, 0.5, 0.0])]
        a: Body,
        #[body(mass = 1.2, inertia = [0.1, 0.1, 0.1], position = [0.9, 0.6, 0.0])]
        b: Body,
        #[body(mass = 1.4, inertia = [0.1, 0.1, 0.1], position = [2.1, 0.4, 0.0])]
        c: Body,
        #[body(mass = 0.6, inertia = [0.1, 0.1, 0.1], position = [0.5, 1.0, 0.0])]
        first: Body,
        #[body(mass = 0.8, inertia = [0.1, 0.1, 0.1], position = [1.6, 1.2, 0.0])]
        second: Body,
        #[joint(between = [ground, a], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
        foot_a: Revolute,
        #[joint(between = [ground, b], point = [1.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
        foot_b: Revolute,
        #[joint(between = [ground, c], point = [2.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
        foot_c: Revolute,
        #[joint(between = [a, first], point = [0.0, 1.0, 0.0], axis = [0.0, 0.0, 1.0])]
        left_first: Revolute,
        #[joint(between = [first, b], point = [1.1, 1.1, 0.0], axis = [0.0, 0.0, 1.0])]
        right_first: Revolute,
        #[joint(between = [b, second], point = [1.1, 1.1, 0.0], axis = [0.0, 0.0, 1.0])]
        left_second: Revolute,
        #[joint(between = [second, c], point = [2.2, 0.9, 0.0], axis = [0.0, 0.0, 1.0])]
        right_second: Revolute,
    }";

/// A crank, a rod and a slider on an inclined guide.
const SLIDER_CRANK: &str = "
    #[mechanism(gravity = [0.0, -9.81, 0.0])]
    pub struct Linkage {
        #[body(mass = 0.9, inertia = [0.1, 0.2, 0.3], position = [0.1, 0.3, 0.0])]
        crank: Body,
        #[body(mass = 1.3, inertia = [0.3, 0.2, 0.4], position = [0.9, 0.4, 0.0])]
        rod: Body,
        #[body(mass = 0.4, inertia = [0.1, 0.1, 0.1], position = [1.6, 0.3, 0.0])]
        slider: Body,
        #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
        bearing: Revolute,
        #[joint(between = [crank, rod], point = [0.2, 0.6, 0.0], axis = [0.0, 0.0, 1.0])]
        crank_pin: Revolute,
        #[joint(between = [ground, slider], point = [1.6, 0.3, 0.0], axis = [1.0, 0.25, 0.0])]
        guide: Prismatic,
        #[joint(between = [slider, rod], point = [1.7, 0.2, 0.0], axis = [0.0, 0.0, 1.0])]
        slider_pin: PointOnLine,
    }";

/// In space: a rod on a rod, with a ball at its end that a third one carries.
const BALL: &str = "
    #[mechanism(gravity = [0.0, 0.0, -9.81])]
    pub struct Linkage {
        #[body(mass = 0.9, inertia = [0.1, 0.2, 0.3], position = [0.1, 0.3, 0.0])]
        a: Body,
        #[body(mass = 1.3, inertia = [0.3, 0.2, 0.4], position = [0.5, 0.8, 0.1])]
        b: Body,
        #[body(mass = 1.1, inertia = [0.3, 0.2, 0.3], position = [1.0, 0.4, 0.2])]
        c: Body,
        #[body(mass = 0.8, inertia = [0.3, 0.2, 0.3], position = [0.8, 0.1, 0.5])]
        d: Body,
        #[joint(between = [ground, a], point = [0.0, 0.0, 0.0], axis = [0.0, 0.2, 1.0])]
        first: Revolute,
        #[joint(between = [a, b], point = [0.2, 0.6, 0.0], axis = [1.0, 0.0, 0.3])]
        second: Revolute,
        #[joint(between = [ground, d], point = [1.2, 0.1, 0.0], axis = [0.1, 0.0, 1.0])]
        third: Revolute,
        #[joint(between = [d, c], point = [1.1, 0.3, 0.4], axis = [1.0, 0.0, 0.0])]
        fourth: Revolute,
        #[joint(between = [b, c], point = [0.8, 0.7, 0.1])]
        closing: Spherical,
    }";

#[test]
fn masses_handed_over_closing_joints() {
    for item in [FOUR_BAR, WINDOWS, SLIDER_CRANK, BALL] {
        let model = delivered(&tokens(item), |name| {
            library::definition(name).map(|(kind, text)| (kind, tokens(&text)))
        });
        let handed = Strategy::all(&model).into_iter().map(|strategy| {
            let reduced = Reduced::of(&model, strategy);
            (strategy.method, reduced.handed_over())
        });
        for (method, handed) in handed {
            assert_eq!(method == Method::Dependent, handed > 0, "{handed} {item}");
        }
        let text = Text {
            item: item.into(),
            definitions: Vec::new(),
        };
        for seed in 0..8 {
            match text.check(&text, seed, Extent::Full) {
                Ok(Outcome::Compared(_)) => {}
                Ok(Outcome::Refused(why) | Outcome::RefusedOtherwise(why)) | Err(why) => {
                    panic!("{text}\n{why}")
                }
            }
        }
    }
}

//! Other branches: where the constraints hold far from the reference configuration.
//!
//! Motion need not lead there, but a state may be set there, or assembled.

use super::closing::{Free, Place};
use super::random::Random;
use crate::model::Model;
use crate::symbolic::equations::with_scene;
use crate::symbolic::scene::Scene;
use crate::symbolic::tape::Tape;

/// Random configurations that are led onto the constraints.
const PLACES: usize = 12;
/// Their number times the velocities of the bodies: so that an expansion ends.
const WORK: usize = 1_000;
/// How much farther than the motions of a walk: half a turn of each body at most, and one and a
/// half times the size of the mechanism.
const FAR: f64 = 8.0;

impl Free {
    /// Places on the constraints, with joints on the sides that are meant, that random
    /// configurations about a place lead to.
    pub(crate) fn elsewhere(&self, model: &Model, about: &Place) -> Vec<Place> {
        let constraints = self.constraints();
        let velocities = constraints.velocities();
        let sides = sides(model);
        let is_meant = |place: &Place| {
            let sides = constraints.evaluate(&sides, &place.into());
            sides.is_some_and(|sides| sides.iter().all(|side| *side > 0.0))
        };
        let mut random = Random::new();
        let places = (0..PLACES.min(WORK / velocities.max(1))).filter_map(|_| {
            let motion = random.motion(velocities);
            let motion: Vec<f64> = motion.iter().map(|x| FAR * x).collect();
            self.reached(about, &motion)
        });
        places.filter(is_meant).collect()
    }
}

/// What is positive on the sides of all joints that are meant.
fn sides(model: &Model) -> Tape {
    let kernel = with_scene(&Scene::new(model), |scene| {
        let joints = 0..model.joints.len();
        let sides: Vec<_> = joints.flat_map(|joint| scene.sides(model, joint)).collect();
        let (space, motion) = (&mut scene.space, &scene.motion);
        sides.iter().map(|side| side.value(space, motion)).collect()
    });
    Tape::new(&kernel.arena, &kernel.outputs)
}

//! Walks by random motions.

use super::motion::{Configuration, Constraints};
use super::random::Random;

/// Configurations besides the start.
const SAMPLES: usize = 5;
/// How often a motion that does not lead back onto the constraints is halved.
const HALVINGS: usize = 4;

/// A configuration, and some more that random motions lead to, each from the last: they walk away
/// from the first. All satisfy the given rows, `None` for all.
pub(super) fn walk(
    constraints: &Constraints,
    start: Configuration,
    rows: Option<&[usize]>,
    random: &mut Random,
) -> Vec<Configuration> {
    let mut configurations = vec![start];
    for _ in 0..SAMPLES {
        let from = &configurations[configurations.len() - 1];
        let mut motion = random.motion(constraints.velocities());
        for _ in 0..=HALVINGS {
            let reached = constraints.assembled_of(&constraints.moved(from, &motion), rows);
            if let Some(reached) = reached {
                configurations.push(reached);
                break;
            }
            motion.iter_mut().for_each(|x| *x *= 0.5);
        }
    }
    configurations
}

//! What is known to be wrong and is not generated, or not compared, until it is cured. A cure turns its constant to `true`.

use holonom_engine::model::Model;
use holonom_engine::symbolic::scene::{Constraint, Scene};

use crate::reading::Described;
use crate::reference::Equations;

/// Whether `p' = 1/2 L(p)^T w` holds in the normalised reading for `p` of any length; if not, the line is compared at length 1.
pub(crate) const RATES_OF_ANY_LENGTH: bool = false;

/// Whether two single rows of a joint of three bodies may determine two components of an angular acceleration.
pub(crate) const TWO_ROWS_OF_THREE_BODIES: bool = false;

/// Whether rows of a joint that are independent may depend on each other where one of its bodies moves alone: a row may leave a body alone.
pub(crate) const ROWS_OF_SOME_BODIES: bool = false;

/// Whether axes by `local(..)` may differ from each other, as long as their normals are used.
pub(crate) const LOCAL_AXES_NOT_PARALLEL: bool = false;

/// Whether equations that contradict each other in time, not in position, are refused; if not, what is left out of a driven mechanism is not judged.
pub(crate) const CONTRADICTIONS_IN_TIME: bool = false;

/// What is in a mechanism that is known to be wrong.
pub(crate) fn defect(model: &Model) -> Option<&'static str> {
    let is_known = !TWO_ROWS_OF_THREE_BODIES && has_two_rows_of_three_bodies(model);
    is_known.then_some("two rows of three bodies")
}

/// What is in the equations at a state that is known to be wrong.
pub(crate) fn defect_at(described: &Described, equations: &Equations) -> bool {
    !ROWS_OF_SOME_BODIES && has_rows_of_some_bodies(described, equations)
}

fn has_two_rows_of_three_bodies(model: &Model) -> bool {
    let scene = Scene::new(model);
    let mut joints = model.joints.iter().enumerate();
    joints.any(|(joint, used)| {
        let own = scene.constraints.iter().filter(|c| c.joint == joint);
        let single = own.filter(|c| matches!(c.constraint, Constraint::Scalar(_)));
        used.bodies.len() > 2 && single.count() == 2
    })
}

fn has_rows_of_some_bodies(described: &Described, equations: &Equations) -> bool {
    let mut first = vec![0];
    for body in &described.bodies {
        first.push(first[first.len() - 1] + body.velocities());
    }
    (0..described.elements.len()).any(|joint| {
        let own = equations.gradients.iter().zip(&equations.joints);
        let own: Vec<&[f64]> = own
            .filter(|(_, of)| **of == joint)
            .map(|(row, _)| &row[..])
            .collect();
        let all = rank(own.iter().map(|row| row.to_vec()).collect());
        let mut bodies = described.elements[joint].between.iter().flatten();
        bodies.any(|&body| {
            let parts = own
                .iter()
                .map(|row| row[first[body]..first[body + 1]].to_vec());
            rank(parts.collect()) < all
        })
    })
}

/// The number of rows that stand out from those before them by a thousandth of the longest, the one that stands out most first.
fn rank(mut rows: Vec<Vec<f64>>) -> usize {
    let length = |row: &[f64]| row.iter().map(|x| x * x).sum::<f64>().sqrt();
    let longest = rows.iter().map(|row| length(row)).fold(1e-9, f64::max);
    let mut rank = 0;
    loop {
        rows.sort_by(|a, b| length(a).total_cmp(&length(b)));
        let Some(last) = rows.pop().filter(|row| length(row) > 1e-3 * longest) else {
            return rank;
        };
        rank += 1;
        let square = length(&last) * length(&last);
        for row in &mut rows {
            let share = row.iter().zip(&last).map(|(a, b)| a * b).sum::<f64>() / square;
            row.iter_mut().zip(&last).for_each(|(a, b)| *a -= share * b);
        }
    }
}

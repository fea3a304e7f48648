//! The derivatives of the rates of a state, as kernels that share everything.
//!
//! An evaluation is differentiated operation by operation, along every number of the state. In
//! joint coordinates there is a shorter road as well (`coordinates/derivatives.rs`).

use super::system::Terms;
use crate::model::{Asked, Coordinates, Curve, Model};
use crate::symbolic::arena::{Arena, Input, Node, Stage};
use crate::symbolic::equations::Kernel;
use crate::symbolic::tangent::{Direction, along};

/// The columns for a set of terms: of the rates by each coordinate of the state, auxiliary
/// variables and the user's own states behind those of bodies, and by each velocity.
#[derive(Clone, Debug)]
pub struct RateColumns {
    /// The terms of the formulation.
    pub terms: Terms,
    /// The outputs.
    pub kernel: Kernel,
}

/// Those of all evaluations, where they are asked for and bodies alone are described. None where a
/// row has a spline: its `gamma` has the second derivative of that, and the third one jumps.
pub(super) fn rate_columns<'k>(
    model: &Model,
    evaluations: impl Iterator<Item = (Terms, &'k Kernel)>,
) -> Vec<RateColumns> {
    let are_asked = model.asked.contains(&Asked::Derivatives);
    if !are_asked || model.coordinates != Coordinates::Bodies {
        return Vec::new();
    }
    let layout = model.layout();
    let coordinates = (0..layout.stored() as u32).map(Input::Coordinate);
    let velocities = (0..layout.velocities as u32).map(Input::Velocity);
    let inputs = coordinates.chain(velocities);
    let directions: Vec<Direction> = inputs
        .map(|input| Direction::from([(input, Arena::ONE)]))
        .collect();
    let columns = evaluations.map(|(terms, kernel)| {
        let mut arena = kernel.arena.clone();
        let rates = &kernel.outputs[..directions.len()];
        let outputs = along(&mut arena, rates, &directions).concat();
        let mut kernel = Kernel { arena, outputs };
        kernel.gather(&[]);
        RateColumns { terms, kernel }
    });
    let columns: Vec<RateColumns> = columns.collect();
    if columns.iter().all(|columns| is_smooth(&columns.kernel)) {
        columns
    } else {
        Vec::new()
    }
}

/// Whether it has no derivative of a spline that jumps.
pub(crate) fn is_smooth(kernel: &Kernel) -> bool {
    let live = kernel.arena.live(&kernel.outputs, Stage::Parameter);
    live.into_iter()
        .all(|place| match kernel.arena.node(place) {
            Node::Curve(curve, _) => curve.derivative <= Curve::HIGHEST,
            _ => true,
        })
}

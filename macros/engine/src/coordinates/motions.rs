//! How bodies stand and move, as a kernel over joint coordinates.

use super::system::Reduced;
use crate::model::{BodyKind, Model};
use crate::symbolic::arena::{Arena, Input, Stage};
use crate::symbolic::count::count;
use crate::symbolic::equations::Kernel;
use crate::symbolic::scene::Chart;

/// The bodies, by the way that takes fewer operations.
pub(super) fn bodies(reduced: &Reduced, model: &Model) -> Kernel {
    let arena = reduced.scene.space.arena.clone();
    let stepwise = read(arena, reduced, &reduced.charts, model);
    let mut arena = stepwise.arena.clone();
    let charts = reduced.charts_by_rotations(&mut arena, model);
    let by_rotations = read(arena, reduced, &charts, model);
    let operations = |kernel: &Kernel| count(&kernel.arena, &kernel.outputs, Stage::State).total();
    if operations(&by_rotations) < operations(&stepwise) {
        by_rotations
    } else {
        stepwise
    }
}

fn read(mut arena: Arena, reduced: &Reduced, charts: &[Chart], model: &Model) -> Kernel {
    let mut outputs = Vec::new();
    for (chart, body) in charts.iter().zip(&model.bodies) {
        outputs.extend(chart.position);
        outputs.extend(chart.velocity);
        if let (BodyKind::Rigid, Some(rotation)) = (body.kind, chart.rotation) {
            outputs.extend(rotation.as_flattened());
            outputs.extend(chart.spin);
        }
    }
    let first = 2 * reduced.links.turns + reduced.links.rest;
    for place in 0..reduced.scene.counters.len() + model.states.len() {
        outputs.push(arena.input(Input::Coordinate((first + place) as u32)));
    }
    Kernel { arena, outputs }
}

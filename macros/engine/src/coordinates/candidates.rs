//! Ways to the equations of motion worth counting, and the choice among them.

use super::links::Runs;
use super::system::Reduced;
use crate::model::Model;
use crate::plan::system::Terms;
use crate::symbolic::arena::Stage;
use crate::symbolic::count::count;

/// What the candidates differ in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Strategy {
    /// How runs of parallel axes are described: a part of what the state is.
    pub runs: Runs,
    /// Whether motions are solved for link by link, by articulated inertias, where no equations remain; else by the mass matrix.
    pub is_articulated: bool,
}

impl Strategy {
    /// All of them.
    pub const ALL: [Self; 4] = [
        Self::new(Runs::Relative, false),
        Self::new(Runs::Shared, false),
        Self::new(Runs::Relative, true),
        Self::new(Runs::Shared, true),
    ];

    const fn new(runs: Runs, is_articulated: bool) -> Self {
        Self {
            runs,
            is_articulated,
        }
    }
}

/// The cheapest for constraints without stabilisation.
#[must_use]
pub fn choose(model: &Model) -> Strategy {
    let cost = |strategy: &Strategy| {
        let mut reduced = Reduced::of(model, *strategy);
        let solution = reduced.solve(Terms::Plain);
        let outputs = [&solution.accelerations[..], &solution.multipliers].concat();
        count(&reduced.scene.space.arena, &outputs, Stage::State).weighted()
    };
    let cheapest = Strategy::ALL.into_iter().min_by_key(cost);
    cheapest.expect("there is a way")
}

//! Ways to the equations of motion worth counting, and the choice among them.

use super::beginning::Beginning;
use super::dependent::Led;
use super::links::Runs;
use super::system::Reduced;
use crate::model::Model;
use crate::plan::system::Terms;
use crate::symbolic::arena::Stage;
use crate::symbolic::count::count;

/// How the equations of motion are solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// By the mass matrix, with rows that close loops behind it.
    MassMatrix,
    /// Link by link, by articulated inertias, where no equations remain; else like
    /// [`Self::MassMatrix`].
    Articulated,
    /// By the mass matrix behind the velocities that the rows determine, where these stand out all
    /// along a sweep of the mechanism and rows have no compliance; else like [`Self::MassMatrix`].
    Dependent,
}

/// What the candidates differ in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Strategy {
    /// How runs of parallel axes are described: a part of what the state is.
    pub runs: Runs,
    /// How the equations of motion are solved.
    pub method: Method,
}

impl Strategy {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::new(Runs::Relative, Method::MassMatrix),
        Self::new(Runs::Shared, Method::MassMatrix),
        Self::new(Runs::Relative, Method::Articulated),
        Self::new(Runs::Shared, Method::Articulated),
        Self::new(Runs::Relative, Method::Dependent),
        Self::new(Runs::Shared, Method::Dependent),
    ];

    /// Those that differ for a mechanism.
    #[must_use]
    pub fn all(model: &Model) -> Vec<Self> {
        Self::beginning_with(&Beginning::new(model))
    }

    fn beginning_with(beginning: &Beginning<'_>) -> Vec<Self> {
        let has_loops = !beginning.spanning.closing.is_empty();
        let differs = |strategy: &Self| match strategy.method {
            Method::MassMatrix => true,
            Method::Articulated => !has_loops,
            Method::Dependent => has_loops,
        };
        Self::ALL.into_iter().filter(differs).collect()
    }

    const fn new(runs: Runs, method: Method) -> Self {
        Self { runs, method }
    }
}

/// The cheapest for constraints without stabilisation.
#[must_use]
pub fn choose(model: &Model) -> (Strategy, Reduced) {
    let beginning = Beginning::new(model);
    let of = |strategy, led| {
        let reduced = Reduced::from_beginning(&beginning, strategy, led);
        (cost(reduced.clone()), strategy, led, reduced)
    };
    let strategies = Strategy::beginning_with(&beginning).into_iter();
    let mut all: Vec<(usize, Strategy, Led, Reduced)> = strategies
        .map(|strategy| of(strategy, Led::Along))
        .collect();
    // What a choice is led to takes longer than all else: that is done for what would be taken.
    let (strategy, mut reduced) = loop {
        let best = all
            .iter_mut()
            .min_by_key(|(cost, ..)| *cost)
            .expect("there is a way");
        let (_, strategy, led, reduced) = &*best;
        if *led == Led::WhereItVanishes || reduced.together_count() == 0 {
            break (*strategy, reduced.clone());
        }
        *best = of(*strategy, Led::WhereItVanishes);
    };
    // Determinants are compared with their own values at the start.
    if !reduced.determines() {
        reduced.find_references(&beginning);
    }
    (strategy, reduced)
}

fn cost(mut reduced: Reduced) -> usize {
    let solution = reduced.solve(Terms::Plain);
    let outputs = [&solution.accelerations[..], &solution.multipliers].concat();
    count(&reduced.scene.space.arena, &outputs, Stage::State).weighted()
}

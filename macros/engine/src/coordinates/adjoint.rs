//! How a weighted sum of accelerations changes with positions, rates and inputs: what the adjoint
//! of a step takes.
//!
//! Backward, so that all of it together costs a few evaluations. As for
//! [`derivatives`](super::derivatives), two roads lead there, and the one with fewer operations is
//! taken. The first goes back through the solution, operation by operation. The second weighs what
//! is solved: `w . a` changes by `-y . (dM a + dh)` with `M y = w`.

use super::derivatives::{Directions, Road, cheapest, plain_inputs, solved};
use super::joint_rates::{Sums, Wanted};
use super::system::Reduced;
use crate::model::{Asked, Model};
use crate::plan::system::Terms;
use crate::symbolic::arena::{Arena, Expr, Input};
use crate::symbolic::cotangent::gradient;
use crate::symbolic::equations::Kernel;
use crate::symbolic::tangent::{Direction, with_inputs};

/// The kernel, over weights of the accelerations of the joints' rates, which are
/// [`Input::Acceleration`]. Its outputs are what the weighted sum changes by with the position of
/// each joint, with each rate, and with each of the inputs.
#[derive(Clone, Debug)]
pub struct Adjoint {
    /// The outputs.
    pub kernel: Kernel,
    /// The places of the inputs among the values of the mechanism: those that the forces have as
    /// they are.
    pub inputs: Vec<usize>,
}

impl Adjoint {
    /// By the road that has fewer operations. `None` where it is not asked for, and where rows
    /// close loops.
    pub(super) fn new(model: &Model, reduced: &Reduced) -> Option<Self> {
        if !model.asked.contains(&Asked::Adjoint) || reduced.scene.layout.rows > 0 {
            return None;
        }
        let sums = &Sums::of(&reduced.links);
        let inputs = plain_inputs(model, reduced, sums);
        let kernel = cheapest(reduced, |reduced, road| {
            kernel(reduced, sums, &inputs, road)
        })?;
        let inputs = inputs.into_iter().map(|(_, place)| place).collect();
        Some(Self { kernel, inputs })
    }
}

fn kernel(mut reduced: Reduced, sums: &Sums, inputs: &[(u32, usize)], road: Road) -> Kernel {
    let directions = reduced.directions(sums, inputs);
    let outputs = match road {
        Road::ThroughSolution => reduced.back_through_solution(sums, &directions),
        Road::ThroughEfforts => reduced.back_through_efforts(sums, &directions),
    };
    let mut kernel = Kernel {
        arena: reduced.scene.space.arena,
        outputs,
    };
    kernel.gather(&[]);
    kernel
}

impl Reduced {
    fn back_through_solution(&mut self, sums: &Sums, directions: &Directions) -> Vec<Expr> {
        let solution = self.solve(Terms::Plain);
        let arena = &mut self.scene.space.arena;
        let accelerations = sums.rates(arena, &solution.accelerations);
        let places = accelerations.into_iter().zip(0..);
        let sum: Vec<(Expr, Expr)> = places
            .map(|(acceleration, place)| (arena.input(Input::Acceleration(place)), acceleration))
            .collect();
        back(arena, &sum, &directions.all(), |_, slope| slope)
    }

    fn back_through_efforts(&mut self, sums: &Sums, directions: &Directions) -> Vec<Expr> {
        let solution = self.solve(Terms::Plain);
        let factors = self.factors();
        let arena = &mut self.scene.space.arena;
        let accelerations = sums.rates(arena, &solution.accelerations);
        let weights = (0..accelerations.len() as u32).map(Input::Acceleration);
        let weights = weights.map(|weight| arena.input(weight)).collect();
        let shares = solved(arena, sums, &factors, weights, Vec::new());
        let efforts = self.efforts(sums, Wanted::All);
        let arena = &mut self.scene.space.arena;
        // Accelerations and shares are held: numbers of their own until the slopes are there.
        let places = efforts.into_iter().zip(0..);
        let sum: Vec<(Expr, Expr)> = places
            .map(|(effort, place)| (-arena.input(Input::Lower(place)), effort))
            .collect();
        back(arena, &sum, &directions.all(), |arena, slope| {
            let held = |input| match input {
                Input::Acceleration(place) => accelerations.get(place as usize).copied(),
                Input::Lower(place) => shares.get(place as usize).copied(),
                _ => None,
            };
            with_inputs(arena, &[slope], held)[0]
        })
    }
}

/// What a weighted sum changes by along directions, of slopes in which something stands for
/// something else.
fn back(
    arena: &mut Arena,
    sum: &[(Expr, Expr)],
    directions: &[Direction],
    meant: impl Fn(&mut Arena, Expr) -> Expr,
) -> Vec<Expr> {
    let moved = |input| directions.iter().any(|along| along.contains_key(&input));
    let slopes = gradient(arena, sum, moved);
    let slopes: Direction = slopes
        .into_iter()
        .map(|(input, slope)| (input, meant(arena, slope)))
        .collect();
    let directions = directions.iter();
    let changes = directions.map(|direction| {
        let terms = direction.iter().filter_map(|(input, &change)| {
            let slope = *slopes.get(input)?;
            Some(arena.mul(slope, change))
        });
        let terms: Vec<Expr> = terms.collect();
        arena.sum(terms)
    });
    changes.collect()
}

//! How a weighted sum of the rates of velocities and of states changes with positions, rates, these
//! states and inputs: what the adjoint of a step takes.
//!
//! Backward, so that all of it together costs a few evaluations. As for
//! [`derivatives`](super::derivatives), two roads lead there, and the one with fewer operations is
//! taken. The first goes back through the solution, operation by operation. The second weighs what
//! is solved, `M a + h + D^T lambda = 0` and `D a = gamma*`. The matrix of accelerations and
//! multipliers is symmetric. So with its solution `y, mu` of `w, 0` the sum `w . a` changes by
//! `-y . (dM a + dh + dD^T lambda) - mu . (dD a - dgamma*)`.

use super::derivatives::{Directions, Road, cheapest, plain_inputs, solved_with_multipliers};
use super::joint_rates::{Sums, Wanted};
use super::system::Reduced;
use crate::model::{Asked, Model};
use crate::plan::system::Terms;
use crate::symbolic::arena::{Arena, Expr, Input};
use crate::symbolic::cotangent::gradient;
use crate::symbolic::equations::{Kernel, state_rates};
use crate::symbolic::tangent::{Direction, with_inputs};

/// The kernels, over weights of the accelerations of the joints' rates and of the rates of the
/// user's own states, which are [`Input::Acceleration`]. Their outputs are what the weighted sum
/// changes by with the position of each joint, with each rate, with each of these states, and with
/// each of the inputs.
#[derive(Clone, Debug)]
pub struct Adjoint {
    /// By terms: in a tree for all of them, else without and with those of stabilisation. There is
    /// none with a compliance.
    pub kernels: Vec<(Terms, Kernel)>,
    /// How many weights there are.
    pub weights: usize,
    /// The places of the inputs among the values of the mechanism: those that the forces have as
    /// they are.
    pub inputs: Vec<usize>,
}

impl Adjoint {
    /// By the road that has fewer operations. `None` where it is not asked for. So it is where a
    /// derivative of a spline jumps, and where an angle over many turns is no sum of turns: after
    /// a step that is put right.
    pub(super) fn new(model: &Model, reduced: &Reduced) -> Option<Self> {
        let mut counters = reduced.scene.counters.iter();
        let is_put_right = counters.any(|counted| counted.angle.paired.is_none());
        if !model.asked.contains(&Asked::Adjoint) || is_put_right {
            return None;
        }
        let sums = &Sums::of(&reduced.links);
        let inputs = plain_inputs(model, reduced, sums);
        let of = |terms| {
            let kernel = |reduced, road| kernel(reduced, sums, &inputs, (terms, road));
            Some((terms, cheapest(reduced, kernel)?))
        };
        let mut kernels = vec![of(Terms::Plain)?];
        if reduced.scene.layout.rows > 0 {
            kernels.push(of(Terms::Stabilised)?);
        }
        let inputs = inputs.into_iter().map(|(_, place)| place).collect();
        Some(Self {
            kernels,
            weights: reduced.links.velocities + model.states.len(),
            inputs,
        })
    }
}

fn kernel(
    mut reduced: Reduced,
    sums: &Sums,
    inputs: &[(u32, usize)],
    (terms, road): (Terms, Road),
) -> Kernel {
    let directions = reduced.directions(sums, inputs);
    let outputs = match road {
        Road::ThroughSolution => reduced.back_through_solution(sums, terms, &directions),
        Road::ThroughEfforts => reduced.back_through_efforts(sums, terms, &directions),
    };
    let mut kernel = Kernel {
        arena: reduced.scene.space.arena,
        outputs,
    };
    kernel.gather(&[]);
    kernel
}

impl Reduced {
    fn back_through_solution(
        &mut self,
        sums: &Sums,
        terms: Terms,
        directions: &Directions,
    ) -> Vec<Expr> {
        let solution = self.solve(terms);
        let arena = &mut self.scene.space.arena;
        let mut rates = sums.rates(arena, &solution.accelerations);
        rates.extend(state_rates(&mut self.scene));
        let arena = &mut self.scene.space.arena;
        let sum = weighed(arena, rates, 0);
        back(arena, &sum, &directions.all(), |_, slope| slope)
    }

    fn back_through_efforts(
        &mut self,
        sums: &Sums,
        terms: Terms,
        directions: &Directions,
    ) -> Vec<Expr> {
        let solution = self.solve(terms);
        let factors = self.factors();
        let (rows, gamma) = self.rows(terms);
        let arena = &mut self.scene.space.arena;
        let accelerations = sums.rates(arena, &solution.accelerations);
        let count = accelerations.len();
        let weights = (0..count as u32).map(|place| arena.input(Input::Acceleration(place)));
        let weights = weights.collect();
        let lower = vec![Arena::ZERO; rows.len()];
        let shares = solved_with_multipliers(arena, sums, &factors, weights, lower).concat();
        let mut left = self.efforts(sums, Wanted::All);
        let arena = &mut self.scene.space.arena;
        // Accelerations, multipliers and shares are held: numbers of their own until the slopes are
        // there.
        for (place, (row, gamma)) in rows.into_iter().zip(gamma).enumerate() {
            let multiplier = arena.input(Input::Lower(place as u32));
            let mut open = -gamma;
            for (k, entry) in sums.efforts(arena, row).into_iter().enumerate() {
                let term = arena.mul(entry, multiplier);
                left[k] = arena.add(left[k], term);
                let acceleration = arena.input(Input::Acceleration(k as u32));
                let term = arena.mul(entry, acceleration);
                open = arena.add(open, term);
            }
            left.push(open);
        }
        let places = left.into_iter().zip(0..);
        let sum = places.map(|(left, place)| (-arena.input(Input::Upper(place)), left));
        let mut sum: Vec<(Expr, Expr)> = sum.collect();
        let states = state_rates(&mut self.scene);
        let arena = &mut self.scene.space.arena;
        // A weight stands for itself.
        sum.extend(weighed(arena, states, count));
        let at = |numbers: &[Expr], place: u32| numbers.get(place as usize).copied();
        back(arena, &sum, &directions.all(), |arena, slope| {
            let held = |input| match input {
                Input::Acceleration(place) => at(&accelerations, place),
                Input::Lower(place) => at(&solution.multipliers, place),
                Input::Upper(place) => at(&shares, place),
                _ => None,
            };
            with_inputs(arena, &[slope], held)[0]
        })
    }
}

/// Rates with their weights, of which the first has a place.
fn weighed(arena: &mut Arena, rates: Vec<Expr>, first: usize) -> Vec<(Expr, Expr)> {
    let places = rates.into_iter().zip(first as u32..);
    let pairs = places.map(|(rate, place)| (arena.input(Input::Acceleration(place)), rate));
    pairs.collect()
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

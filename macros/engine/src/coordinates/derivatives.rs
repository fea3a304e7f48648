//! The rates of velocities with their derivatives, as one kernel that shares everything.
//!
//! Two roads lead there, and the one with fewer operations is taken. The first differentiates the
//! solution itself, operation by operation. The second differentiates what is solved,
//! `M a + h + D^T lambda = 0` and `D a = gamma`, where accelerations and multipliers are held, and
//! solves for what these change by, with the factors that are there: J. Carpentier, N. Mansard,
//! *Analytical derivatives of rigid body dynamics algorithms*, RSS 2018.
//!
//! Directions are those of joints, as handles read them: a small turn or displacement along a rate
//! of a joint, a rate, an effort along a rate, an input.

use super::candidates::Method;
use super::joint_rates::{Sums, Wanted};
use super::rates::coordinate_rates;
use super::system::Reduced;
use crate::model::{Asked, Curve, Model};
use crate::plan::eliminate::Factors;
use crate::plan::kernels::relative;
use crate::plan::system::Terms;
use crate::symbolic::arena::{Arena, Expr, Input, Node, Stage};
use crate::symbolic::count::count;
use crate::symbolic::equations::{Kernel, turning};
use crate::symbolic::tangent::{Direction, along, with_inputs};

/// The kernel. Its outputs are, in this order:
///
/// - the accelerations of the joints' rates;
/// - column by column their derivatives by positions, by rates, by efforts and by inputs;
/// - where rows close loops, for each position `x` with `D x = -dPhi'/dq`;
/// - relative pivots.
#[derive(Clone, Debug)]
pub struct Derivatives {
    /// The outputs.
    pub kernel: Kernel,
    /// The places among the values of the mechanism of the inputs by which it is differentiated:
    /// those that the forces have as they are, and the rows have not.
    pub inputs: Vec<usize>,
}

/// What the columns are along.
pub(super) struct Directions {
    positions: Vec<Direction>,
    rates: Vec<Direction>,
    states: Vec<Direction>,
    inputs: Vec<Direction>,
}

impl Directions {
    pub(super) fn all(&self) -> Vec<Direction> {
        let all = [&self.positions, &self.rates, &self.inputs];
        all.into_iter().flatten().cloned().collect()
    }

    /// The same, with the user's own states before the inputs.
    pub(super) fn with_states(&self) -> Vec<Direction> {
        let all = [&self.positions, &self.rates, &self.states, &self.inputs];
        all.into_iter().flatten().cloned().collect()
    }
}

/// How the derivatives are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Road {
    /// Through the solution.
    ThroughSolution,
    /// Through the efforts of the accelerations.
    ThroughEfforts,
}

/// The kernel with the fewest operations, by either road and by the methods that may solve for
/// accelerations. `None` where a derivative of a spline jumps.
pub(super) fn cheapest(
    reduced: &Reduced,
    kernel: impl Fn(Reduced, Road) -> Kernel,
) -> Option<Kernel> {
    let own = reduced.strategy.method;
    // Factors that all columns share are those of one matrix.
    let methods = match own {
        Method::Articulated => vec![own, Method::MassMatrix],
        _ => vec![own],
    };
    let kernels = methods.into_iter().flat_map(|method| {
        let mut reduced = reduced.clone();
        reduced.strategy.method = method;
        [Road::ThroughSolution, Road::ThroughEfforts].map(|road| kernel(reduced.clone(), road))
    });
    let cost = |kernel: &Kernel| count(&kernel.arena, &kernel.outputs, Stage::State).total();
    kernels.min_by_key(cost).filter(is_smooth)
}

impl Derivatives {
    /// By the road that has fewer operations. `None` where they are not asked for. So it is where a
    /// row has a spline: its `gamma` has the second derivative of that, and the third one jumps.
    pub(super) fn new(model: &Model, reduced: &Reduced) -> Option<Self> {
        if !model.asked.contains(&Asked::Derivatives) {
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

/// Whether it has no derivative of a spline that jumps.
fn is_smooth(kernel: &Kernel) -> bool {
    let mut live = kernel
        .arena
        .live(&kernel.outputs, Stage::Parameter)
        .into_iter();
    live.all(|place| match kernel.arena.node(place) {
        Node::Curve(curve, _) => curve.derivative <= Curve::HIGHEST,
        _ => true,
    })
}

/// The rows that remain, in the rates of the joints.
struct Rows {
    jacobian: Vec<Vec<Expr>>,
    gamma: Vec<Expr>,
    /// `Phi'`.
    rates: Vec<Expr>,
}

fn kernel(mut reduced: Reduced, sums: &Sums, inputs: &[(u32, usize)], road: Road) -> Kernel {
    let directions = reduced.directions(sums, inputs);
    let rows = reduced.split_rows(sums);
    let solution = reduced.solve(Terms::Plain);
    let factors = reduced.factors();
    let arena = &mut reduced.scene.space.arena;
    let accelerations = sums.rates(arena, &solution.accelerations);
    let all = directions.all();
    let columns = match road {
        Road::ThroughSolution => along(arena, &accelerations, &all),
        Road::ThroughEfforts => {
            let known = (&accelerations[..], &solution.multipliers[..]);
            reduced.through_efforts(sums, (&rows, &factors), known, &all)
        }
    };
    let arena = &mut reduced.scene.space.arena;
    let (count, height) = (accelerations.len(), rows.gamma.len());
    let efforts = (0..count).map(|place| {
        let mut unit = vec![Arena::ZERO; count];
        unit[place] = Arena::ONE;
        solved(arena, sums, &factors, unit, vec![Arena::ZERO; height])
    });
    let efforts: Vec<Vec<Expr>> = efforts.collect();
    let following = if height > 0 {
        let opening = along(arena, &rows.rates, &directions.positions);
        let opening = opening.into_iter().map(|opening| {
            let lower = opening.into_iter().map(|rate| -rate).collect();
            solved(arena, sums, &factors, vec![Arena::ZERO; count], lower)
        });
        opening.collect()
    } else {
        Vec::new()
    };
    let checks = reduced.referred(&solution.checks);
    let (pivots, _) = relative(&mut reduced.scene, &checks);
    let (states, inputs) = columns.split_at(2 * count);
    let mut outputs = accelerations;
    let columns = [states, &efforts, inputs, &following].concat();
    outputs.extend(columns.into_iter().flatten());
    outputs.extend(pivots);
    let mut kernel = Kernel {
        arena: reduced.scene.space.arena,
        outputs,
    };
    kernel.gather(&[]);
    kernel
}

/// The accelerations of efforts along the rates of the joints, and right-hand sides of the rows.
pub(super) fn solved(
    arena: &mut Arena,
    sums: &Sums,
    factors: &Factors,
    efforts: Vec<Expr>,
    lower: Vec<Expr>,
) -> Vec<Expr> {
    let [accelerations, _] = solved_with_multipliers(arena, sums, factors, efforts, lower);
    accelerations
}

/// The same, and the multipliers.
pub(super) fn solved_with_multipliers(
    arena: &mut Arena,
    sums: &Sums,
    factors: &Factors,
    efforts: Vec<Expr>,
    lower: Vec<Expr>,
) -> [Vec<Expr>; 2] {
    let mut right = sums.forces(arena, efforts);
    let velocities = right.len();
    right.extend(lower);
    let mut solution = factors.solve(arena, right);
    let multipliers = solution.split_off(velocities);
    [sums.rates(arena, &solution), multipliers]
}

/// The inputs that stand in the forces as they are, and not in the rows: symbol and place among the
/// values.
pub(super) fn plain_inputs(model: &Model, reduced: &Reduced, sums: &Sums) -> Vec<(u32, usize)> {
    let mut reduced = reduced.clone();
    let rows = reduced.rows_of_joints(sums);
    let arena = &mut reduced.scene.space.arena;
    let symbols = model.symbols.iter().enumerate();
    let plain = symbols.filter_map(|(symbol, known)| {
        let place = known.itself?;
        let mut others = model.symbols.iter().enumerate();
        // One that is a part of another number as well changes more than its own symbol.
        let is_alone =
            others.all(|(other, known)| other == symbol || !known.values.contains(&place));
        let is_input = model.values.get(place).is_some_and(|value| value.is_input);
        let found = (symbol as u32, place);
        (is_input && is_alone).then_some(found)
    });
    let leaves_rows = |&(symbol, _): &(u32, usize)| {
        let direction = Direction::from([(Input::Varying(symbol), Arena::ONE)]);
        let changes = along(arena, &rows, &[direction]);
        changes
            .into_iter()
            .flatten()
            .all(|change| change == Arena::ZERO)
    };
    plain.filter(leaves_rows).collect()
}

impl Reduced {
    /// The directions of joints and inputs.
    pub(super) fn directions(&mut self, sums: &Sums, inputs: &[(u32, usize)]) -> Directions {
        // The rates of coordinates are linear in velocities: along a direction they are what the
        // coordinates change by.
        let mut moving = coordinate_rates(self);
        let counters = 0..self.scene.counters.len();
        moving.extend(counters.map(|counter| turning(&mut self.scene, counter)));
        let (velocities, turns) = (self.links.velocities, self.links.turns);
        let arena = &mut self.scene.space.arena;
        let rates = (0..velocities).map(|place| {
            let mut unit = vec![Arena::ZERO; velocities];
            unit[place] = Arena::ONE;
            let along = sums.velocities(arena, &unit).into_iter().enumerate();
            let along = along.filter(|(_, velocity)| *velocity != Arena::ZERO);
            along
                .map(|(place, velocity)| (Input::Velocity(place as u32), velocity))
                .collect()
        });
        let rates: Vec<Direction> = rates.collect();
        let moved = along(arena, &moving, &rates);
        let positions = moved.into_iter().map(|moved| {
            let mut direction = Direction::new();
            for (place, change) in moved.into_iter().enumerate() {
                if change == Arena::ZERO {
                    continue;
                }
                if place < turns {
                    let [cosine, sine] =
                        [2 * place, 2 * place + 1].map(|place| Input::Coordinate(place as u32));
                    let [x, y] = [cosine, sine].map(|input| arena.input(input));
                    direction.insert(cosine, -arena.mul(change, y));
                    direction.insert(sine, arena.mul(change, x));
                } else {
                    direction.insert(Input::Coordinate((turns + place) as u32), change);
                }
            }
            direction
        });
        let positions = positions.collect();
        let first = 2 * turns + self.links.rest + self.scene.counters.len();
        let states = (0..self.scene.motion.states.len()).map(|state| {
            let place = Input::Coordinate((first + state) as u32);
            Direction::from([(place, Arena::ONE)])
        });
        let inputs = inputs.iter();
        let inputs =
            inputs.map(|&(symbol, _)| Direction::from([(Input::Varying(symbol), Arena::ONE)]));
        Directions {
            positions,
            rates,
            states: states.collect(),
            inputs: inputs.collect(),
        }
    }

    /// The factors of the equations of motion.
    pub(super) fn factors(&mut self) -> Factors {
        // Without a compliance they are the same, whatever the terms.
        let (rows, _) = self.rows(Terms::Plain);
        let elimination = self.elimination(Terms::Plain, &rows);
        let Self { links, scene, .. } = self;
        elimination.factors(&mut scene.space.arena, links, &rows)
    }

    fn split_rows(&mut self, sums: &Sums) -> Rows {
        let mut jacobian = self.rows_of_joints(sums);
        let (width, height) = (self.links.velocities, self.scene.layout.rows);
        let mut gamma = jacobian.split_off(width * height);
        let mut rates = gamma.split_off(height);
        rates.truncate(height);
        let jacobian = jacobian.chunks(width.max(1)).map(<[Expr]>::to_vec);
        Rows {
            jacobian: jacobian.collect(),
            gamma,
            rates,
        }
    }

    /// The derivatives of the accelerations by what directions make of the equations, with
    /// accelerations and multipliers held.
    fn through_efforts(
        &mut self,
        sums: &Sums,
        (rows, factors): (&Rows, &Factors),
        (accelerations, multipliers): (&[Expr], &[Expr]),
        directions: &[Direction],
    ) -> Vec<Vec<Expr>> {
        let mut left = self.efforts(sums, Wanted::All);
        let count = left.len();
        let arena = &mut self.scene.space.arena;
        for (place, row) in rows.jacobian.iter().enumerate() {
            let multiplier = arena.input(Input::Lower(place as u32));
            let mut held = -rows.gamma[place];
            for (k, &entry) in row.iter().enumerate() {
                let term = arena.mul(entry, multiplier);
                left[k] = arena.add(left[k], term);
                let acceleration = arena.input(Input::Acceleration(k as u32));
                let term = arena.mul(entry, acceleration);
                held = arena.add(held, term);
            }
            left.push(held);
        }
        let columns = along(arena, &left, directions);
        let columns = columns.into_iter().map(|column| {
            let column = with_inputs(arena, &column, |input| match input {
                Input::Acceleration(place) => accelerations.get(place as usize).copied(),
                Input::Lower(place) => multipliers.get(place as usize).copied(),
                _ => None,
            });
            let mut missing: Vec<Expr> = column.into_iter().map(|change| -change).collect();
            let lower = missing.split_off(count);
            solved(arena, sums, factors, missing, lower)
        });
        columns.collect()
    }
}

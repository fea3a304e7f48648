//! The rates of velocities with their derivatives, as one kernel that shares everything.
//!
//! Two roads lead there, and the one with fewer operations is taken. The first differentiates the
//! solution itself, operation by operation. The second differentiates what is solved,
//! `M a + h + D^T lambda = 0` and `D a = gamma`, where accelerations and multipliers are held, and
//! solves for what these change by, with the factors that are there: J. Carpentier, N. Mansard,
//! *Analytical derivatives of rigid body dynamics algorithms*, RSS 2018.
//!
//! Directions are those of joints, as handles read them: a small turn or displacement along a rate
//! of a joint, a rate, a state of the user's own, an effort along a rate, an input or a parameter.

use super::candidates::Method;
use super::joint_rates::{Sums, Wanted};
use super::motions::bodies;
use super::rates::coordinate_rates;
use super::system::Reduced;
use crate::model::{Asked, BodyKind, Model, Number};
use crate::plan::derivatives::is_smooth;
use crate::plan::eliminate::Factors;
use crate::plan::kernels::relative;
use crate::plan::system::Terms;
use crate::symbolic::arena::{Arena, Expr, Input, Stage};
use crate::symbolic::count::count;
use crate::symbolic::equations::{Kernel, state_rates, turning};
use crate::symbolic::tangent::{Direction, along, with_inputs};

/// The kernel. Its outputs are, in this order:
///
/// - the accelerations of the joints' rates, and the rates of the user's own states;
/// - column by column their derivatives by positions, by rates, by those states, by efforts and by
///   values;
/// - where rows close loops, for each position `x` with `D x = -dPhi'/dq`, and for each value `x`
///   with `D x = -dPhi/dp`, and `x` with `D x = -dPhi'/dp`; zeros in the places of states;
/// - relative pivots.
#[derive(Clone, Debug)]
pub struct Derivatives {
    /// The outputs.
    pub kernel: Kernel,
    /// What the velocities of the bodies change by, linear ones in global axes and angular ones in
    /// principal axes, body by body: along each rate, which is how the bodies themselves are
    /// displaced along its position, and then along each position. Behind them what the auxiliary
    /// variables change by along each position.
    pub motions: Kernel,
    /// The places among the values of the mechanism of the inputs and parameters by which it is
    /// differentiated.
    pub values: Vec<usize>,
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
        let values = model.derived_values();
        let kernel = cheapest(reduced, |reduced, road| kernel(model, reduced, sums, road))?;
        let motions = motions(model, reduced.clone(), sums);
        Some(Self {
            kernel,
            motions,
            values,
        })
    }
}

/// The rows that remain, in the rates of the joints.
struct Rows {
    jacobian: Vec<Vec<Expr>>,
    gamma: Vec<Expr>,
    /// `Phi'`.
    rates: Vec<Expr>,
    /// `Phi`.
    values: Vec<Expr>,
}

/// The directions along which inputs and parameters change by one: with all symbols that have them.
fn along_values(model: &Model, arena: &mut Arena) -> Vec<Direction> {
    let known = |symbol: usize| match model.number(symbol) {
        Number::Varying(place) => Input::Varying(place),
        _ => Input::Symbol(symbol as u32),
    };
    let of_value = |value| {
        let symbols = model.symbols.iter().enumerate();
        let changes = symbols.filter_map(|(place, symbol)| match symbol.slope_of {
            Some((of, by)) => (by == value).then(|| (known(of), arena.input(known(place)))),
            None => (symbol.itself == Some(value)).then(|| (known(place), Arena::ONE)),
        });
        changes.collect()
    };
    model.derived_values().into_iter().map(of_value).collect()
}

fn kernel(model: &Model, mut reduced: Reduced, sums: &Sums, road: Road) -> Kernel {
    let mut directions = reduced.directions(sums, &[]);
    directions.inputs = along_values(model, &mut reduced.scene.space.arena);
    let rows = reduced.split_rows(sums);
    let solution = reduced.solve(Terms::Plain);
    let factors = reduced.factors();
    let state_rates = state_rates(&mut reduced.scene);
    let arena = &mut reduced.scene.space.arena;
    let accelerations = sums.rates(arena, &solution.accelerations);
    let all = directions.all();
    let mut columns = match road {
        Road::ThroughSolution => along(arena, &accelerations, &all),
        Road::ThroughEfforts => {
            let known = (&accelerations[..], &solution.multipliers[..]);
            reduced.through_efforts(sums, (&rows, &factors), known, &all)
        }
    };
    let arena = &mut reduced.scene.space.arena;
    let of_states = along(arena, &state_rates, &all);
    for (column, of_states) in columns.iter_mut().zip(of_states) {
        column.extend(of_states);
    }
    let (count, height) = (accelerations.len(), rows.gamma.len());
    let nothing = vec![Arena::ZERO; count];
    let solved = |arena: &mut Arena, upper: Vec<Expr>, lower: Vec<Expr>| {
        let mut column = solved(arena, sums, &factors, upper, lower);
        column.resize(count + state_rates.len(), Arena::ZERO);
        column
    };
    let efforts = (0..count).map(|place| {
        let mut unit = nothing.clone();
        unit[place] = Arena::ONE;
        solved(arena, unit, vec![Arena::ZERO; height])
    });
    let efforts: Vec<Vec<Expr>> = efforts.collect();
    let mut opening = Vec::new();
    if height > 0 {
        opening.extend(along(arena, &rows.rates, &directions.positions));
        opening.extend(along(arena, &rows.values, &directions.inputs));
        opening.extend(along(arena, &rows.rates, &directions.inputs));
    }
    let following = opening.into_iter().map(|opening| {
        let lower = opening.into_iter().map(|change| -change).collect();
        solved(arena, nothing.clone(), lower)
    });
    let following: Vec<Vec<Expr>> = following.collect();
    let checks = reduced.referred(&solution.checks);
    let (pivots, _) = relative(&mut reduced.scene, &checks);
    let (before, inputs) = columns.split_at(2 * count + directions.states.len());
    let columns = [before, &efforts, inputs, &following].concat();
    let mut outputs = [accelerations, state_rates].concat();
    outputs.extend(columns.into_iter().flatten());
    outputs.extend(pivots);
    let mut kernel = Kernel {
        arena: reduced.scene.space.arena,
        outputs,
    };
    kernel.gather(&[]);
    kernel
}

fn motions(model: &Model, mut reduced: Reduced, sums: &Sums) -> Kernel {
    let directions = reduced.directions(sums, &[]);
    let counters = 2 * reduced.links.turns + reduced.links.rest;
    let counters = counters..counters + reduced.scene.counters.len();
    let counted: Vec<Input> = counters
        .map(|place| Input::Coordinate(place as u32))
        .collect();
    let Kernel {
        mut arena,
        outputs: read,
    } = bodies(&reduced, model);
    let mut velocities = Vec::new();
    let mut read = &read[..];
    for body in &model.bodies {
        let (rotation, velocity) = match body.kind {
            BodyKind::Rigid => (9, 6),
            BodyKind::Particle => (0, 3),
        };
        velocities.extend(&read[3..6]);
        velocities.extend(&read[6 + rotation..3 + rotation + velocity]);
        read = &read[3 + rotation + velocity..];
    }
    let all = [&directions.rates[..], &directions.positions].concat();
    let mut outputs = along(&mut arena, &velocities, &all).concat();
    let of_counted = directions.positions.iter().flat_map(|direction| {
        let change = |input| direction.get(input).copied().unwrap_or(Arena::ZERO);
        counted.iter().map(change)
    });
    outputs.extend(of_counted);
    let mut kernel = Kernel { arena, outputs };
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
        let is_alone = others.all(|(other, known)| {
            other == symbol || known.slope_of.is_some() || !known.values.contains(&place)
        });
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
        let values = rates.split_off(height);
        let jacobian = jacobian.chunks(width.max(1)).map(<[Expr]>::to_vec);
        Rows {
            jacobian: jacobian.collect(),
            gamma,
            rates,
            values,
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

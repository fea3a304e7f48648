//! The kernels of a mechanism in joint coordinates.

use super::adjoint::Adjoint;
use super::candidates::{Strategy, choose};
use super::derivatives::Derivatives;
use super::freedom::Freedom;
use super::from_bodies::from_bodies;
use super::joint_rates::JointRates;
use super::motions::bodies;
use super::rates::coordinate_rates;
use super::system::Reduced;
use crate::model::Model;
use crate::plan::kernels::{PivotCheck, Solver, relative};
use crate::plan::system::Terms;
use crate::symbolic::equations::{Kernel, state_rates, turning};

/// An evaluation: outputs are the rates of the pairs' angles, of the further coordinates and
/// auxiliary variables, and of the velocities; multipliers; relative pivots in the order of
/// `checks`.
#[derive(Clone, Debug)]
pub struct Evaluation {
    /// The terms of the formulation.
    pub terms: Terms,
    /// The outputs.
    pub kernel: Kernel,
    /// The pivots to check.
    pub checks: Vec<PivotCheck>,
}

/// What a coordinate or a velocity of the reduced system is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    /// An angle, counted the other way round than the joint does if so.
    Turn(bool),
    /// A displacement.
    Slide,
    /// An angle, counted the other way round than the joint does if so, and the place among the
    /// further coordinates of the joint's angle over any number of turns.
    Screw(bool, usize),
    /// Every rotation.
    Ball,
}

/// A link, for the report.
#[derive(Clone, Copy, Debug)]
pub struct Described {
    /// The joint, `None` for a body that moves freely.
    pub joint: Option<usize>,
    /// The body that it carries, or is on the way to.
    pub body: usize,
    /// What it moves by.
    pub meaning: Meaning,
    /// The place of its first coordinate: among the pairs of a turn or a screw, among the further
    /// coordinates otherwise.
    pub coordinate: usize,
    /// Its first velocity.
    pub velocity: usize,
    /// The link whose angle is to be taken off: both are measured against what carries the run.
    pub against: Option<usize>,
    /// The angle in the reference configuration (rad).
    pub zero: f64,
}

/// Everything that is generated for a mechanism in joint coordinates.
#[derive(Clone, Debug)]
pub struct JointKernels {
    /// The way that was chosen.
    pub strategy: Strategy,
    /// Pairs of cosine and sine.
    pub turns: usize,
    /// Further coordinates, auxiliary variables behind them, and then the user's own states.
    pub rest: usize,
    /// The auxiliary variables among them.
    pub auxiliaries: usize,
    /// The user's own states among them.
    pub states: usize,
    /// Whether an auxiliary variable is not the integral of velocities.
    pub rewraps: bool,
    /// Whether every row determines a velocity where rows have no compliance.
    pub determines: bool,
    /// Velocities.
    pub velocities: usize,
    /// The joints of the rows that remain, row by row.
    pub rows: Vec<usize>,
    /// The same rows among those of the bodies; `None` for one that is left out there.
    pub rows_of_bodies: Vec<Option<usize>>,
    /// The places of Euler parameters among the further coordinates.
    pub balls: Vec<usize>,
    /// What the velocities are, in order; one for three of a ball.
    pub links: Vec<Described>,
    /// One for each set of terms; one alone where no row remains.
    pub evaluations: Vec<Evaluation>,
    /// Without a compliance, and with one where rows remain.
    pub solvers: Vec<Solver>,
    /// The bodies: position, velocity, and of a rigid one rotation matrix row by row and angular
    /// velocity in principal axes; auxiliary variables; the user's own states.
    pub bodies: Kernel,
    /// Pairs, further coordinates, auxiliary variables and velocities, from the state of the
    /// bodies.
    pub joints: Kernel,
    /// What is asked for in the rates of the joints.
    pub joint_rates: Option<JointRates>,
    /// The accelerations with their derivatives, where they are asked for.
    pub derivatives: Option<Derivatives>,
    /// What a weighted sum of accelerations changes by, where it is asked for.
    pub adjoint: Option<Adjoint>,
}

impl JointKernels {
    /// Builds all kernels of a model.
    #[must_use]
    pub fn new(model: &Model) -> Self {
        let (strategy, reduced) = choose(model);
        let rows: Vec<usize> = reduced
            .scene
            .constraints
            .iter()
            .flat_map(|constrained| vec![constrained.joint; constrained.equations()])
            .collect();
        let terms = if rows.is_empty() {
            &Terms::ALL[..1]
        } else {
            &Terms::ALL[..]
        };
        let evaluations = terms
            .iter()
            .map(|&terms| evaluation(reduced.clone(), terms));
        let solvers: &[Terms] = if rows.is_empty() {
            &[Terms::Plain]
        } else {
            &[Terms::Plain, Terms::Compliant]
        };
        let solvers = solvers.iter().map(|&terms| solver(reduced.clone(), terms));
        let links = &reduced.links;
        let auxiliaries = reduced.scene.counters.len();
        let balls = links.links.iter().filter_map(|link| match link.freedom {
            Freedom::Ball { rest } => Some(rest),
            _ => None,
        });
        Self {
            strategy,
            turns: links.turns,
            rest: links.rest + auxiliaries + model.states.len(),
            auxiliaries,
            states: model.states.len(),
            rewraps: reduced
                .scene
                .counters
                .iter()
                .any(|counted| counted.angle.paired.is_none()),
            velocities: links.velocities,
            determines: reduced.determines(),
            rows,
            rows_of_bodies: rows_of_bodies(model, &reduced),
            balls: balls.collect(),
            links: links
                .links
                .iter()
                .map(|link| Described {
                    joint: link.joint,
                    body: link.body,
                    coordinate: match link.freedom {
                        Freedom::Turn { pair, .. } | Freedom::Screw { pair, .. } => pair,
                        Freedom::Slide { rest, .. } | Freedom::Ball { rest } => rest,
                    },
                    velocity: link.velocity,
                    against: links.measured_with(link),
                    zero: links.zero(&reduced.scene.space.arena, link),
                    meaning: match link.freedom {
                        Freedom::Turn { is_reversed, .. } => Meaning::Turn(is_reversed),
                        Freedom::Slide { .. } => Meaning::Slide,
                        Freedom::Screw {
                            is_reversed,
                            counter,
                            ..
                        } => Meaning::Screw(is_reversed, links.rest + counter),
                        Freedom::Ball { .. } => Meaning::Ball,
                    },
                })
                .collect(),
            evaluations: evaluations.collect(),
            solvers: solvers.collect(),
            bodies: bodies(&reduced, model),
            joint_rates: JointRates::new(model, &reduced),
            derivatives: Derivatives::new(model, &reduced),
            adjoint: Adjoint::new(model, &reduced),
            joints: {
                let mut arena = reduced.scene.space.arena.clone();
                let outputs = from_bodies(&mut arena, model, links);
                Kernel { arena, outputs }
            },
        }
    }
}

/// Where the rows that remain stand among those of the bodies.
fn rows_of_bodies(model: &Model, reduced: &Reduced) -> Vec<Option<usize>> {
    let layout = model.layout();
    let mut rows = Vec::new();
    for constrained in &reduced.scene.constraints {
        let joint = constrained.joint;
        let of_joint = &model.joints[joint];
        let places = 0..model.definition(of_joint).equations();
        let remain = places.filter(|place| !reduced.dropped[joint].contains(place));
        let first = constrained.row - reduced.scene.layout.row[joint];
        rows.extend(
            remain
                .skip(first)
                .take(constrained.equations())
                .map(|place| {
                    let before = of_joint.dropped.iter().filter(|&&row| row < place);
                    (!of_joint.dropped.contains(&place))
                        .then(|| layout.row[joint] + place - before.count())
                }),
        );
    }
    rows
}

fn evaluation(mut reduced: Reduced, terms: Terms) -> Evaluation {
    let solution = reduced.solve(terms);
    let mut outputs = coordinate_rates(&mut reduced);
    for place in 0..reduced.scene.counters.len() {
        outputs.push(turning(&mut reduced.scene, place));
    }
    outputs.extend(state_rates(&mut reduced.scene));
    outputs.extend(solution.accelerations);
    outputs.extend(solution.multipliers);
    let checks = reduced.referred(&solution.checks);
    let (pivots, checks) = relative(&mut reduced.scene, &checks);
    outputs.extend(pivots);
    let mut kernel = Kernel {
        arena: reduced.scene.space.arena,
        outputs,
    };
    kernel.gather(&[]);
    Evaluation {
        terms,
        kernel,
        checks,
    }
}

/// What forces and moments on the bodies, and right-hand sides of the rows, make of rates and
/// multipliers. Pivots are checked by the evaluation of the same state.
fn solver(mut reduced: Reduced, terms: Terms) -> Solver {
    let solution = reduced.solve_given(terms);
    Solver {
        terms,
        arena: reduced.scene.space.arena,
        pivots: Vec::new(),
        checks: Vec::new(),
        solution: [solution.accelerations, solution.multipliers].concat(),
    }
}

//! The kernels of a mechanism, as outputs over arenas.

use super::Plan;
use super::candidates::{Factorised, Plans, cheapest, first, solved};
use super::derivatives::{RateColumns, rate_columns};
use super::eliminate::Check;
use super::profile::{Profile, compliances};
use super::readouts::Readouts;
use super::reference::by_numbers;
use super::system::{System, Terms, applied_forces};
use crate::model::Model;
use crate::symbolic::arena::{Arena, Expr, Input, Stage};
use crate::symbolic::equations::{
    Block, Kernel, coordinate_rates, counters, initial_state, jacobian, kinds, kinetic_energy,
    mass, metric, potential_energy, rows, state_rates, switches, vector_rows, with_scene,
};
use crate::symbolic::scene::Scene;
use crate::symbolic::separation::Separations;
use crate::symbolic::table::Table;

/// A kernel that solves: outputs are coordinate rates, accelerations, multipliers.
#[derive(Clone, Debug)]
pub struct Evaluation {
    /// The terms of the formulation.
    pub terms: Terms,
    /// Outputs, and behind them the relative pivots in the order of `checks`.
    pub kernel: Kernel,
    /// The pivots to check.
    pub checks: Vec<PivotCheck>,
}

/// A pivot that is checked at run time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PivotCheck {
    /// The joint; the output is the pivot over what it is compared with.
    Relative(usize),
    /// The joint; the output is a pivot that nothing was subtracted from, so that only zero is bad.
    Nonzero(usize),
}

/// Factorisation and back-substitution; both over one arena.
#[derive(Clone, Debug)]
pub struct Solver {
    /// The terms of the formulation: plain or compliant.
    pub terms: Terms,
    /// The arena.
    pub arena: Arena,
    /// The relative pivots.
    pub pivots: Vec<Expr>,
    /// The pivots to check.
    pub checks: Vec<PivotCheck>,
    /// Accelerations and multipliers for a given right-hand side.
    pub solution: Vec<Expr>,
}

/// Everything that is generated for a mechanism.
#[derive(Clone, Debug)]
pub struct Kernels {
    /// `Phi`.
    pub constraints: Kernel,
    /// `Phi'`.
    pub constraint_rates: Kernel,
    /// `D`, block by block.
    pub jacobian: Kernel,
    /// The blocks of `D`.
    pub blocks: Vec<Block>,
    /// The first rows of equations between vectors, which have three each.
    pub vector_rows: Vec<usize>,
    /// `gamma`.
    pub gamma: Kernel,
    /// The diagonal of the mass matrix.
    pub mass: Kernel,
    /// The same with masses and moments that are positive, where a body has others.
    pub metric: Option<Kernel>,
    /// `g`.
    pub forces: Kernel,
    /// Kinetic energy.
    pub kinetic_energy: Kernel,
    /// Potential energy.
    pub potential_energy: Kernel,
    /// `q'`; zeros in the places of the user's own states.
    pub coordinate_rates: Kernel,
    /// The rates of the user's own states.
    pub state_rates: Kernel,
    /// The expressions whose signs decide in laws; behind them those of the time alone.
    pub switches: [Kernel; 2],
    /// The separations with whose direction a force turns round.
    pub separations: Separations,
    /// Coordinates, auxiliary variables, the user's own states, then velocities, of the described
    /// state.
    pub initial_state: Kernel,
    /// The auxiliary variables, as the angles that they count.
    pub counters: Kernel,
    /// The power of all forces that have no potential.
    pub power: Kernel,
    /// What can be read of joints and forces.
    pub readouts: Readouts,
    /// The fused evaluations for all terms. None where the mechanism is described by its joints
    /// alone.
    pub evaluations: Vec<Evaluation>,
    /// The gains of `Phi'` and of `Phi` in `gamma*`, for evaluations that are put together from
    /// their parts.
    pub gains: Option<Kernel>,
    /// The derivatives of the rates of evaluations, where they are asked for.
    pub rate_columns: Vec<RateColumns>,
    /// Factorisation and back-substitution.
    pub solvers: Vec<Solver>,
    /// The plans of the solutions.
    pub plans: Option<Plans>,
    /// What takes the place of both where many bodies run by their joints.
    pub by_rows: Option<ByRows>,
}

/// So many bodies at the most have their equations of motion unrolled where they run by their
/// joints: a projection solves them at every step, and loops take three times as long for a
/// four-bar. Of more bodies the code is what costs.
pub const FEW: usize = 12;

/// What loops over the rows need for the bodies' equations of motion, which a mechanism that runs
/// by its joints solves seldom.
#[derive(Clone, Debug)]
pub struct ByRows {
    /// The entries that are kept.
    pub profile: Profile,
    /// The compliance of each row.
    pub compliances: Kernel,
}

impl Kernels {
    /// Builds all kernels of a model.
    #[must_use]
    pub fn new(model: &Model) -> Self {
        let scene = &Scene::new(model);
        let (mut solvers, mut plans) = (vec![], None);
        let is_fused = model.coordinates.fuse_bodies();
        let is_unrolled = is_fused || model.bodies.len() <= FEW;
        let factorised = is_unrolled.then(|| {
            if is_fused {
                cheapest(model)
            } else {
                first(&model.with_metric())
            }
        });
        let evaluations = factorised.as_ref().filter(|_| is_fused);
        let evaluations = evaluations.map(|factorised| evaluations_of(model, factorised));
        let evaluations = evaluations.unwrap_or_default();
        if let Some([rigid, compliant]) = factorised {
            plans = Some(Plans {
                rigid: rigid.plan.clone(),
                compliant: compliant.plan.clone(),
            });
            solvers = vec![
                back_substitution(rigid, Terms::Plain),
                back_substitution(compliant, Terms::Compliant),
            ];
        }
        let with_terms = evaluations.iter();
        let with_terms = with_terms.map(|evaluation| (evaluation.terms, &evaluation.kernel));
        let rate_columns = rate_columns(model, with_terms);
        let (jacobian, blocks) = jacobian(scene, model);
        let minus = -Arena::ONE;
        let (one, zero) = (Arena::ONE, Arena::ZERO);
        Self {
            constraints: rows(scene, [one, zero, zero]),
            constraint_rates: rows(scene, [zero, one, zero]),
            gamma: rows(scene, [zero, zero, minus]),
            jacobian,
            blocks,
            vector_rows: vector_rows(scene),
            mass: mass(scene, model),
            metric: model.is_of_joints_alone().then(|| metric(scene, model)),
            forces: with_scene(scene, |scene| applied_forces(scene, &kinds(model))),
            kinetic_energy: kinetic_energy(scene),
            potential_energy: potential_energy(scene),
            coordinate_rates: with_scene(scene, |scene| {
                let mut rates = coordinate_rates(scene, model);
                // They have no part in how bodies move.
                rates.resize(model.layout().stored(), Arena::ZERO);
                rates
            }),
            state_rates: with_scene(scene, state_rates),
            switches: [false, true].map(|of_time| {
                with_scene(scene, |scene| {
                    switches(scene, model, |switch| switch.is_of_time || !of_time)
                })
            }),
            separations: Separations::new(scene),
            initial_state: initial_state(model),
            counters: counters(scene),
            power: with_scene(scene, |scene| {
                let powers = (0..model.forces.len()).map(|k| scene.energy_and_power(k)[1]);
                let powers: Vec<Expr> = powers.collect();
                vec![scene.space.arena.sum(powers)]
            }),
            readouts: Readouts::new(scene, model),
            rate_columns,
            evaluations,
            gains: (!is_fused).then(gains),
            solvers,
            plans,
            by_rows: (!is_unrolled).then(|| ByRows {
                profile: Profile::new(model),
                compliances: compliances(scene),
            }),
        }
    }
}

/// The fused evaluations for all terms.
fn evaluations_of(model: &Model, [rigid, compliant]: &[Factorised; 2]) -> Vec<Evaluation> {
    let normalised = &Scene::normalised(model);
    let evaluations = Terms::ALL.map(|terms| {
        let factorised = match terms {
            Terms::Plain | Terms::Stabilised => rigid,
            Terms::Compliant => compliant,
        };
        fused(model, factorised, normalised, terms)
    });
    evaluations.into()
}

/// The gains of stabilisation, of `Phi'` and of `Phi`.
fn gains() -> Kernel {
    let mut arena = Arena::new();
    let outputs = [Input::RateGain, Input::PositionGain].map(|gain| arena.input(gain));
    Kernel {
        outputs: outputs.into(),
        arena,
    }
}

fn relative_pivots(scene: &mut Scene, system: &System) -> (Vec<Expr>, Vec<PivotCheck>) {
    let mut recorded = system.checks(scene);
    by_numbers(scene, system.kinds(), &mut recorded);
    relative(scene, &recorded)
}

/// Recorded pivots, by rows, over what they are compared with.
pub(crate) fn relative(scene: &mut Scene, recorded: &[Check]) -> (Vec<Expr>, Vec<PivotCheck>) {
    let joint_of = |scene: &Scene, row: usize| {
        scene
            .constraints
            .iter()
            .rev()
            .find(|c| c.row <= row)
            .map(|c| c.joint)
            .expect("a row belongs to a constraint")
    };
    let mut pivots = Vec::new();
    let mut checks = Vec::new();
    for &Check {
        unknown,
        pivot,
        before,
    } in recorded
    {
        let joint = joint_of(scene, unknown);
        if pivot.abs() == before.abs() {
            pivots.push(pivot);
            checks.push(PivotCheck::Nonzero(joint));
        } else {
            pivots.push(scene.space.arena.div(pivot, before));
            checks.push(PivotCheck::Relative(joint));
        }
    }
    (pivots, checks)
}

/// The fused evaluation with a plan.
#[must_use]
pub fn evaluation(model: &Model, plan: &Plan, terms: Terms) -> Evaluation {
    let factorised = Factorised::new(model, plan, terms);
    fused(model, &factorised, &Scene::normalised(model), terms)
}

/// The fused evaluation, worked out with rotation matrices of Euler parameters as they are, and
/// then written with those of a scene that normalises them.
fn fused(
    model: &Model,
    Factorised { scene, system, .. }: &Factorised,
    normalised: &Scene,
    terms: Terms,
) -> Evaluation {
    let mut scene = scene.clone();
    let solution = solved(&mut scene, &kinds(model), system, terms);
    let mut outputs = coordinate_rates(&mut scene, model);
    outputs.extend(state_rates(&mut scene));
    outputs.extend(solution.accelerations);
    outputs.extend(solution.multipliers);
    let (pivots, checks) = relative_pivots(&mut scene, system);
    outputs.extend(pivots);
    let rotations = rotations(&scene);
    let mut kernel = Kernel {
        arena: scene.space.arena,
        outputs,
    };
    kernel.gather(&rotations);
    Evaluation {
        terms,
        kernel: with_rotations(&kernel, &rotations, normalised),
        checks,
    }
}

/// The entries of the rotation matrices, body by body, row by row.
fn rotations(scene: &Scene) -> Vec<Expr> {
    let bodies = 0..scene.mass.len();
    let matrices = bodies.filter_map(|body| scene.space.rotation(body).copied());
    matrices.flatten().flatten().collect()
}

/// The same function of the rotation matrices of another scene. What else is made of Euler
/// parameters, their rates, is made of them as they are.
fn with_rotations(kernel: &Kernel, former: &[Expr], scene: &Scene) -> Kernel {
    let mut arena = scene.space.arena.clone();
    let entries = former.iter().zip(rotations(scene));
    let mut known: Table<usize, Expr> = entries
        .map(|(former, entry)| {
            let entry = if former.is_negative() { -entry } else { entry };
            (former.node(), entry)
        })
        .collect();
    let of = |known: &Table<usize, Expr>, expr: Expr| {
        let found = known[&expr.node()];
        if expr.is_negative() { -found } else { found }
    };
    let given = former.iter().map(|entry| entry.node());
    let nodes = kernel
        .arena
        .live_above(&kernel.outputs, Stage::Literal, given);
    for place in nodes {
        let made = arena.again(kernel.arena.node(place), |operand| of(&known, operand));
        if let Some(label) = kernel.arena.label(place) {
            arena.name(made, || label.to_owned());
        }
        known.insert(place, made);
    }
    let outputs = kernel.outputs.iter().map(|&output| of(&known, output));
    Kernel {
        outputs: outputs.collect(),
        arena,
    }
}

/// Factorisation and back-substitution with a plan.
#[must_use]
pub fn solver(model: &Model, plan: &Plan, terms: Terms) -> Solver {
    back_substitution(Factorised::new(model, plan, terms), terms)
}

fn back_substitution(factorised: Factorised, terms: Terms) -> Solver {
    let Factorised {
        mut scene, system, ..
    } = factorised;
    let (pivots, checks) = relative_pivots(&mut scene, &system);
    let solution = system.solve_given(&mut scene);
    let solution = solution
        .accelerations
        .into_iter()
        .chain(solution.multipliers)
        .collect();
    Solver {
        terms,
        arena: scene.space.arena,
        pivots,
        checks,
        solution,
    }
}

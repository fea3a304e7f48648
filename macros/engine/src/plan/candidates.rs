//! Plans worth counting, and the choice among them.
//!
//! Bodies are eliminated from the leaves of a spanning tree towards the ground, rows of a body's joint right behind it,
//! closing joints last: work grows linearly along a chain. Candidates differ in the axes of point rows and of
//! accelerations, and in whether point rows are paired with accelerations or left to the Schur complement.

use super::Plan;
use super::order::{Kinds, Order, StartValues};
use super::reach::Reach;
use super::system::{System, Terms, coupling};
use super::tree::{Tree, tree};
use crate::model::{BodyKind, Model};
use crate::symbolic::arena::{Expr, Stage};
use crate::symbolic::count::count;
use crate::symbolic::scene::{Reading, Scene};
use crate::symbolic::vector::Frame;

/// What the candidates differ in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Strategy {
    /// Accelerations of rigid bodies in body axes.
    body_accelerations: bool,
    /// Rows in the axes of the body that is carried.
    body_rows: bool,
    kinds: Kinds,
}

impl Strategy {
    const fn new(body_accelerations: bool, body_rows: bool, kinds: Kinds) -> Self {
        Self {
            body_accelerations,
            body_rows,
            kinds,
        }
    }
}

const STRATEGIES: [Strategy; 7] = {
    const ALONE: Kinds = Kinds {
        saddles: false,
        forbidden: false,
    };
    const SADDLES: Kinds = Kinds {
        saddles: true,
        ..ALONE
    };
    const PAIRS: Kinds = Kinds {
        forbidden: true,
        ..SADDLES
    };
    [
        Strategy::new(true, true, PAIRS),
        Strategy::new(true, true, SADDLES),
        Strategy::new(false, false, PAIRS),
        Strategy::new(false, false, SADDLES),
        Strategy::new(true, true, ALONE),
        Strategy::new(false, true, ALONE),
        Strategy::new(false, false, ALONE),
    ]
};

/// The number of candidates, of which some may be the same plan.
pub const CANDIDATES: usize = STRATEGIES.len();

/// One of the plans worth counting.
///
/// # Panics
/// From [`CANDIDATES`] on.
#[must_use]
pub fn candidate(model: &Model, place: usize) -> Plan {
    let reach = Reach::new(model);
    let tree = tree(model, &reach);
    plan(
        model,
        &tree,
        &reach,
        &StartValues::new(model),
        STRATEGIES[place],
    )
}

/// The plans worth counting, each once.
#[must_use]
pub fn all(model: &Model) -> Vec<Plan> {
    let reach = Reach::new(model);
    let tree = tree(model, &reach);
    let start = StartValues::new(model);
    let mut plans: Vec<Plan> = Vec::new();
    for strategy in STRATEGIES {
        let plan = plan(model, &tree, &reach, &start, strategy);
        if !plans.contains(&plan) {
            plans.push(plan);
        }
    }
    plans
}

/// The cheapest plan for a model, by the operations of its standard evaluation.
#[must_use]
pub fn choose(model: &Model) -> Plan {
    let plans = all(model).into_iter();
    let cheapest = plans.min_by_key(|plan| cost(model, plan));
    cheapest.expect("there are strategies")
}

/// The operations of the standard evaluation with a plan.
#[must_use]
pub fn cost(model: &Model, plan: &Plan) -> usize {
    let mut scene = Scene::for_solution(model, Reading::Raw);
    let solution = equations_of_motion(&mut scene, model, plan.clone(), Terms::Plain).0;
    let outputs: Vec<Expr> = solution
        .accelerations
        .into_iter()
        .chain(solution.multipliers)
        .collect();
    count(&scene.space.arena, &outputs, Stage::State).total()
}

/// The solved equations of motion.
pub fn equations_of_motion(
    scene: &mut Scene,
    model: &Model,
    plan: Plan,
    terms: Terms,
) -> (super::system::Solution, System) {
    let kinds: Vec<BodyKind> = model.bodies.iter().map(|body| body.kind).collect();
    let system = System::new(scene, &kinds, plan, terms);
    let right = system.equations_of_motion(scene, terms);
    let upper = crate::plan::system::applied_forces(scene, &kinds);
    let solution = system.solve(scene, &right, &upper);
    (solution, system)
}

fn plan(
    model: &Model,
    tree: &Tree,
    reach: &Reach,
    start: &StartValues,
    strategy: Strategy,
) -> Plan {
    let frame_of = |body: usize, wanted: bool| match model.bodies[body].kind {
        BodyKind::Rigid if wanted => Frame::Body(body),
        _ => Frame::Global,
    };
    let translation = (0..model.bodies.len())
        .map(|body| frame_of(body, strategy.body_accelerations))
        .collect();
    let mut scene = Scene::for_solution(model, Reading::Raw);
    let last_body = |joint: usize| {
        model.joints[joint]
            .bodies
            .iter()
            .rev()
            .copied()
            .flatten()
            .next()
    };
    let rows = scene
        .constraints
        .iter()
        .map(|constrained| {
            let child = tree.child[constrained.joint].or_else(|| last_body(constrained.joint));
            child.map_or(Frame::Global, |body| frame_of(body, strategy.body_rows))
        })
        .collect();
    let mut plan = Plan {
        translation,
        rows,
        pivots: Vec::new(),
        compliant_pivots: Vec::new(),
        determinants: Vec::new(),
    };
    let kinds: Vec<BodyKind> = model.bodies.iter().map(|body| body.kind).collect();
    let coupling = coupling(&mut scene, &kinds, &plan);
    let mut order = Order::new(&scene, &coupling, &kinds, start, reach);
    (plan.pivots, plan.determinants) = order.pivots(tree, strategy.kinds);
    let compliant = Kinds {
        forbidden: false,
        ..strategy.kinds
    };
    (plan.compliant_pivots, _) = order.pivots(tree, compliant);
    plan
}

//! Plans worth counting, and the choice among them.
//!
//! Bodies are eliminated from the leaves of a spanning tree towards the ground, rows of a body's joint right behind it,
//! closing joints last: work grows linearly along a chain. Candidates differ in the axes of point rows and of
//! accelerations, and in whether point rows are paired with accelerations or left to the Schur complement.

use super::eliminate::Check;
use super::order::{Course, Order, Rows, StartValues};
use super::reach::Reach;
use super::system::{System, Terms, coupling};
use super::tree::{Tree, tree};
use super::{Plan, Plans};
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
    course: Course,
}

impl Strategy {
    const fn new(body_accelerations: bool, body_rows: bool, course: Course) -> Self {
        Self {
            body_accelerations,
            body_rows,
            course,
        }
    }
}

const fn leaves(saddles: bool, forbidden: bool, late: Option<Rows>) -> Course {
    Course::Leaves {
        saddles,
        forbidden,
        late,
    }
}

const LATE: Option<Rows> = Some(Rows::BothEnds);
const GROUND: Course = Course::BodiesFirst(Rows::Ground);
const ENDS: Course = Course::BodiesFirst(Rows::BothEnds);

/// Without a compliance: what forbids a motion is eliminated with it.
const RIGID: [Strategy; 7] = {
    const PAIRS: Course = leaves(true, true, None);
    const LATE_PAIRS: Course = leaves(true, true, LATE);
    [
        Strategy::new(true, true, PAIRS),
        Strategy::new(false, false, PAIRS),
        Strategy::new(true, true, LATE_PAIRS),
        Strategy::new(false, false, LATE_PAIRS),
        Strategy::new(true, true, GROUND),
        Strategy::new(false, false, GROUND),
        Strategy::new(false, false, ENDS),
    ]
};

/// With a compliance: no motion is forbidden.
const COMPLIANT: [Strategy; 8] = {
    const SADDLES: Course = leaves(true, false, None);
    const LATE_SADDLES: Course = leaves(true, false, LATE);
    const ALONE: Course = leaves(false, false, None);
    [
        Strategy::new(true, true, SADDLES),
        Strategy::new(false, false, SADDLES),
        Strategy::new(true, true, LATE_SADDLES),
        Strategy::new(false, false, LATE_SADDLES),
        Strategy::new(true, true, GROUND),
        Strategy::new(false, false, GROUND),
        Strategy::new(true, true, ALONE),
        Strategy::new(false, false, ALONE),
    ]
};

const fn strategies(terms: Terms) -> &'static [Strategy] {
    match terms {
        Terms::Plain | Terms::Stabilised => &RIGID,
        Terms::Compliant => &COMPLIANT,
    }
}

/// The plans worth counting, each once.
#[must_use]
pub fn all(model: &Model, terms: Terms) -> Vec<Plan> {
    let reach = Reach::new(model);
    let tree = tree(model, &reach);
    let start = StartValues::new(model);
    let mut plans: Vec<Plan> = Vec::new();
    for &strategy in strategies(terms) {
        let plan = plan(model, &tree, &reach, &start, strategy);
        if !plans.contains(&plan) {
            plans.push(plan);
        }
    }
    plans
}

/// The cheapest plans for a model, by the operations of the standard evaluation and of that with a compliance, each together with the
/// back-substitution for a given right-hand side; of two that are equal, the one with the shorter path.
#[must_use]
pub fn choose(model: &Model) -> Plans {
    let [rigid, compliant] = [Terms::Plain, Terms::Compliant].map(|terms| {
        let plans = all(model, terms).into_iter();
        plans
            .min_by_key(|plan| cost(model, plan, terms))
            .expect("there are strategies")
    });
    Plans { rigid, compliant }
}

/// What a plan costs: the operations of an evaluation (accelerations, multipliers and relative pivots) and of a back-substitution
/// together, then the path of the evaluation.
fn cost(model: &Model, plan: &Plan, terms: Terms) -> (usize, usize) {
    let mut scene = Scene::for_solution(model, Reading::Raw);
    let (solution, system) = equations_of_motion(&mut scene, model, plan.clone(), terms);
    let checks = system.checks(&scene);
    let ratio = |check: &Check| scene.space.arena.div(check.pivot, check.before);
    let pivots = checks.iter().map(ratio).collect();
    let outputs: Vec<Expr> = [solution.accelerations, solution.multipliers, pivots].concat();
    let evaluation = count(&scene.space.arena, &outputs, Stage::State);
    let solution = system.solve_given(&mut scene);
    let outputs = [solution.accelerations, solution.multipliers].concat();
    let back = count(&scene.space.arena, &outputs, Stage::RightHandSide);
    (evaluation.total() + back.total(), evaluation.depth)
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
    let solution = system.solve(scene, &right, &upper, Stage::State);
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
        determinants: Vec::new(),
    };
    let kinds: Vec<BodyKind> = model.bodies.iter().map(|body| body.kind).collect();
    let coupling = coupling(&mut scene, &kinds, &plan);
    let mut order = Order::new(&scene, &coupling, &kinds, start, reach);
    (plan.pivots, plan.determinants) = order.pivots(tree, strategy.course);
    plan
}

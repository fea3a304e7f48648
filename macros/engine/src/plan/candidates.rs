//! Plans worth counting, and the choice among them.
//!
//! Bodies are eliminated from the leaves of a spanning tree towards the ground, rows of a body's joint right behind it, closing joints last: work
//! grows linearly along a chain. Or rows wait for all bodies, all of them or the point rows between moving bodies. Candidates differ in this, in
//! the points whose accelerations are eliminated, and in the axes of rows and of accelerations.

use super::eliminate::Check;
use super::order::{Course, Order, Rows, StartValues};
use super::reach::Reach;
use super::system::{Solution, System, Terms, applied_forces, coupling};
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
    /// Accelerations of the points where joints carry the bodies, instead of centres of mass.
    carried_points: bool,
    /// Accelerations of rigid bodies in body axes.
    body_accelerations: bool,
    /// Rows in the axes of the body that is carried.
    body_rows: bool,
    course: Course,
}

impl Strategy {
    const fn new(body_accelerations: bool, body_rows: bool, course: Course) -> Self {
        Self {
            carried_points: false,
            body_accelerations,
            body_rows,
            course,
        }
    }

    /// The same with accelerations of the points where joints carry the bodies.
    const fn at_joints(self) -> Self {
        Self {
            carried_points: true,
            ..self
        }
    }
}

const fn leaves(forbidden: bool, late: Option<Rows>) -> Course {
    Course::Leaves { forbidden, late }
}

const LATE: Option<Rows> = Some(Rows::BothEnds);
const GROUND: Course = Course::BodiesFirst(Rows::Ground);

/// Without a compliance: what forbids a motion is eliminated with it.
const RIGID: [Strategy; 6] = {
    const PAIRS: Course = leaves(true, None);
    const LATE_PAIRS: Course = leaves(true, LATE);
    [
        Strategy::new(false, false, PAIRS).at_joints(),
        Strategy::new(true, true, PAIRS).at_joints(),
        Strategy::new(false, false, PAIRS),
        Strategy::new(true, true, PAIRS),
        Strategy::new(false, false, LATE_PAIRS),
        Strategy::new(true, true, GROUND),
    ]
};

/// With a compliance: no motion is forbidden.
const COMPLIANT: [Strategy; 5] = {
    const SADDLES: Course = leaves(false, None);
    const LATE_SADDLES: Course = leaves(false, LATE);
    [
        Strategy::new(true, true, SADDLES),
        Strategy::new(false, false, SADDLES),
        Strategy::new(true, true, LATE_SADDLES),
        Strategy::new(false, false, LATE_SADDLES),
        Strategy::new(true, true, GROUND),
    ]
};

const fn strategies(terms: Terms) -> &'static [Strategy] {
    match terms {
        Terms::Plain | Terms::Stabilised => &RIGID,
        Terms::Compliant => &COMPLIANT,
    }
}

/// The terms of the evaluations that go by a plan.
const fn served(terms: Terms) -> &'static [Terms] {
    match terms {
        Terms::Plain | Terms::Stabilised => &[Terms::Plain, Terms::Stabilised],
        Terms::Compliant => &[Terms::Compliant],
    }
}

/// What all candidates begin with.
struct Beginning<'a> {
    model: &'a Model,
    kinds: Vec<BodyKind>,
    /// Of which nothing is computed yet: every candidate works on a copy.
    scene: Scene,
    reach: Reach,
    tree: Tree,
    start: StartValues,
}

impl<'a> Beginning<'a> {
    fn new(model: &'a Model) -> Self {
        let scene = Scene::for_solution(model, Reading::Raw);
        let reach = Reach::new(model, scene.clone());
        Self {
            model,
            kinds: kinds(model),
            tree: tree(model, &reach),
            scene,
            reach,
            start: StartValues::new(model),
        }
    }

    /// The plans worth counting, each once.
    fn plans(&self, terms: Terms) -> Vec<Plan> {
        let mut plans: Vec<Plan> = Vec::new();
        for &strategy in strategies(terms) {
            let plan = self.plan(strategy);
            if !plans.contains(&plan) {
                plans.push(plan);
            }
        }
        plans
    }
}

/// The plans worth counting, each once.
#[must_use]
pub fn all(model: &Model, terms: Terms) -> Vec<Plan> {
    Beginning::new(model).plans(terms)
}

/// The cheapest plans for a model.
#[must_use]
pub fn choose(model: &Model) -> Plans {
    let beginning = Beginning::new(model);
    let [rigid, compliant] = [Terms::Plain, Terms::Compliant].map(|terms| beginning.choose(terms));
    Plans { rigid, compliant }
}

/// Plans that cost little to find, for what runs seldom: bodies from the leaves of the tree, rows of a body's joint right behind it.
#[must_use]
pub fn first(model: &Model) -> Plans {
    let beginning = Beginning::new(model);
    let [rigid, compliant] = [Terms::Plain, Terms::Compliant].map(|terms| {
        let [strategy, ..] = strategies(terms) else {
            unreachable!("there are strategies")
        };
        beginning.plan(*strategy)
    });
    Plans { rigid, compliant }
}

/// A plan whose matrix is factorised.
struct Candidate {
    plan: Plan,
    scene: Scene,
    system: System,
    /// What it costs without the right-hand sides.
    at_least: usize,
}

/// The factors of a plan take no more nodes than so many times those of another, or the plan is given up.
const FILLED: usize = 3;

impl Beginning<'_> {
    /// The cheapest plan. What a plan costs is found in two steps, of which the second takes longer: the factors and the back-substitution, then the right-hand sides.
    fn choose(&self, terms: Terms) -> Plan {
        let mut candidates: Vec<Candidate> = Vec::new();
        let mut most = usize::MAX;
        for plan in self.plans(terms) {
            candidates.extend(self.factorised(plan, terms, &mut most));
        }
        candidates.sort_by_key(|candidate| candidate.at_least);
        let mut best: Option<(usize, Plan)> = None;
        for candidate in candidates {
            let at_least = candidate.at_least;
            if best.as_ref().is_some_and(|(least, _)| at_least >= *least) {
                break;
            }
            let (cost, plan) = self.cost(candidate, terms);
            if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                best = Some((cost, plan));
            }
        }
        best.expect("there are strategies").1
    }

    fn factorised(&self, plan: Plan, terms: Terms, most: &mut usize) -> Option<Candidate> {
        let mut scene = self.scene.clone();
        let before = scene.space.arena.len();
        let system = System::within(&mut scene, &self.kinds, plan.clone(), terms, *most)?;
        let nodes = scene.space.arena.len() - before;
        *most = (*most).min(FILLED * nodes);
        let (factors, back) = Self::given(&mut scene.clone(), &system);
        let evaluations = served(terms).len() * factors;
        Some(Candidate {
            plan,
            scene,
            system,
            at_least: 4 * evaluations + back,
        })
    }

    /// What a given right-hand side costs: with the factors that it needs, and by itself.
    fn given(scene: &mut Scene, system: &System) -> (usize, usize) {
        let solution = system.solve_given(scene);
        let outputs = [&solution.accelerations[..], &solution.multipliers].concat();
        let [all, back] = [Stage::State, Stage::RightHandSide]
            .map(|stage| count(&scene.space.arena, &outputs, stage));
        (all.total(), back.weighted())
    }

    /// What a plan costs: four times the evaluations that go by it, with accelerations, multipliers and relative pivots, and once the
    /// back-substitution for a given right-hand side, which runs less often.
    fn cost(&self, candidate: Candidate, terms: Terms) -> (usize, Plan) {
        let Candidate {
            plan,
            mut scene,
            system,
            ..
        } = candidate;
        let checks = system.checks(&scene);
        let ratio = |check: &Check| scene.space.arena.div(check.pivot, check.before);
        let pivots: Vec<Expr> = checks.iter().map(ratio).collect();
        let evaluations = served(terms).iter().map(|&terms| {
            let solution = solved(&mut scene, &self.kinds, &system, terms);
            let outputs = [&solution.accelerations[..], &solution.multipliers, &pivots].concat();
            count(&scene.space.arena, &outputs, Stage::State).weighted()
        });
        let evaluations: usize = evaluations.sum();
        let (_, back) = Self::given(&mut scene, &system);
        (4 * evaluations + back, plan)
    }

    fn plan(&self, strategy: Strategy) -> Plan {
        let Self {
            model, kinds, tree, ..
        } = self;
        let frame_of = |body: usize, wanted: bool| match model.bodies[body].kind {
            BodyKind::Rigid if wanted => Frame::Body(body),
            _ => Frame::Global,
        };
        let translation = (0..model.bodies.len())
            .map(|body| frame_of(body, strategy.body_accelerations))
            .collect();
        let mut scene = self.scene.clone();
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
        let points = (0..model.bodies.len())
            .map(|body| {
                let joint = tree.child.iter().position(|child| *child == Some(body));
                let carries = |place: &usize| {
                    Some(scene.constraints[*place].joint) == joint
                        && scene.point_on(*place, body).is_some()
                };
                (0..scene.constraints.len())
                    .filter(|_| {
                        strategy.carried_points && model.bodies[body].kind == BodyKind::Rigid
                    })
                    .find(carries)
            })
            .collect();
        let mut plan = Plan {
            translation,
            points,
            rows,
            pivots: Vec::new(),
            determinants: Vec::new(),
        };
        plan.refer(&mut scene);
        let coupling = coupling(&mut scene, kinds, &plan);
        let mut order = Order::new(&scene, &coupling, kinds, &self.start, &self.reach);
        (plan.pivots, plan.determinants) = order.pivots(tree, strategy.course);
        plan
    }
}

/// The solved equations of motion.
pub fn equations_of_motion(
    scene: &mut Scene,
    model: &Model,
    plan: Plan,
    terms: Terms,
) -> (Solution, System) {
    let kinds = kinds(model);
    let system = System::new(scene, &kinds, plan, terms);
    let solution = solved(scene, &kinds, &system, terms);
    (solution, system)
}

fn kinds(model: &Model) -> Vec<BodyKind> {
    model.bodies.iter().map(|body| body.kind).collect()
}

fn solved(scene: &mut Scene, kinds: &[BodyKind], system: &System, terms: Terms) -> Solution {
    let right = system.equations_of_motion(scene, terms);
    let upper = applied_forces(scene, kinds);
    system.solve(scene, &right, &upper, Stage::State)
}

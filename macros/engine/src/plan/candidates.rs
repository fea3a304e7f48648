//! Plans worth counting, and the choice among them.
//!
//! Bodies are eliminated from the leaves of a spanning tree towards the ground, rows of a body's
//! joint right behind it, closing joints last: work grows linearly along a chain. Or rows wait for
//! all bodies, all of them or the point rows between moving bodies. Candidates differ in this, in
//! the points whose accelerations are eliminated, and in the axes of rows and of accelerations.

use super::Plan;
use super::eliminate::Check;
use super::order::{Order, Rows, Sequence, StartValues};
use super::reach::Reach;
use super::system::{Solution, System, Terms, applied_forces, coupling};
use super::tree::{Tree, tree};
use crate::model::{BodyKind, Model};
use crate::symbolic::arena::{Expr, Stage};
use crate::symbolic::count::count;
use crate::symbolic::scene::Scene;
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
    sequence: Sequence,
}

impl Strategy {
    const fn new(body_accelerations: bool, body_rows: bool, sequence: Sequence) -> Self {
        Self {
            carried_points: false,
            body_accelerations,
            body_rows,
            sequence,
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

const fn leaves(forbidden: bool, late: Option<Rows>) -> Sequence {
    Sequence::Leaves { forbidden, late }
}

const LATE: Option<Rows> = Some(Rows::BothEnds);
const GROUND: Sequence = Sequence::BodiesFirst(Rows::Ground);

/// Without a compliance: what forbids a motion is eliminated with it.
const RIGID: [Strategy; 6] = {
    const PAIRS: Sequence = leaves(true, None);
    const LATE_PAIRS: Sequence = leaves(true, LATE);
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
    const SADDLES: Sequence = leaves(false, None);
    const LATE_SADDLES: Sequence = leaves(false, LATE);
    [
        Strategy::new(true, true, SADDLES),
        Strategy::new(false, false, SADDLES),
        Strategy::new(true, true, LATE_SADDLES),
        Strategy::new(false, false, LATE_SADDLES),
        Strategy::new(true, true, GROUND),
    ]
};

/// Mechanisms of more bodies are not searched in full: what wins where there are many is one of
/// two, and every candidate takes time.
const MANY: usize = 12;
const RIGID_OF_MANY: [Strategy; 2] = [RIGID[0], RIGID[5]];
const COMPLIANT_OF_MANY: [Strategy; 2] = [COMPLIANT[4], COMPLIANT[3]];

const fn strategies(terms: Terms, bodies: usize) -> &'static [Strategy] {
    match terms {
        Terms::Plain | Terms::Stabilised if bodies > MANY => &RIGID_OF_MANY,
        Terms::Plain | Terms::Stabilised => &RIGID,
        Terms::Compliant if bodies > MANY => &COMPLIANT_OF_MANY,
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
        let scene = Scene::for_solution(model);
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
        for &strategy in strategies(terms, self.kinds.len()) {
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

/// The plans of a mechanism: what is cheapest without a compliance need not be so with one, where
/// the rows have a diagonal of their own.
#[derive(Clone, Debug, PartialEq)]
pub struct Plans {
    /// For rigid constraints, with or without stabilisation.
    pub rigid: Plan,
    /// For constraints with a compliance, where every order is safe.
    pub compliant: Plan,
}

impl Plans {
    /// The plan for some terms.
    #[must_use]
    pub fn of(&self, terms: Terms) -> &Plan {
        match terms {
            Terms::Plain | Terms::Stabilised => &self.rigid,
            Terms::Compliant => &self.compliant,
        }
    }
}

/// The cheapest plans for a model.
#[must_use]
pub fn choose(model: &Model) -> Plans {
    let [rigid, compliant] = cheapest(model).map(|factorised| factorised.plan);
    Plans { rigid, compliant }
}

/// The cheapest plans, without a compliance and with one.
pub(super) fn cheapest(model: &Model) -> [Factorised; 2] {
    let beginning = Beginning::new(model);
    [Terms::Plain, Terms::Compliant].map(|terms| beginning.choose(terms))
}

/// Plans that cost little to find, for what runs seldom: bodies from the leaves of the tree, rows
/// of a body's joint right behind it; with a compliance all bodies first, which takes a quarter to
/// a half fewer operations than that.
pub(super) fn first(model: &Model) -> [Factorised; 2] {
    let beginning = Beginning::new(model);
    [(Terms::Plain, RIGID[0]), (Terms::Compliant, COMPLIANT[4])].map(|(terms, strategy)| {
        let plan = beginning.plan(strategy);
        let factorised = beginning.factorised(plan, terms, usize::MAX);
        factorised.expect("there is no bound")
    })
}

/// A plan whose matrix is factorised, and nothing else worked out yet.
#[derive(Clone, Debug)]
pub(super) struct Factorised {
    pub(super) plan: Plan,
    pub(super) scene: Scene,
    pub(super) system: System,
}

impl Factorised {
    pub(super) fn new(model: &Model, plan: &Plan, terms: Terms) -> Self {
        let mut scene = Scene::for_solution(model);
        let system = System::new(&mut scene, &kinds(model), plan.clone(), terms);
        Self {
            plan: plan.clone(),
            scene,
            system,
        }
    }
}

/// A plan that may be the cheapest.
struct Candidate {
    factorised: Factorised,
    /// What it costs without the right-hand sides.
    at_least: usize,
}

/// The factors of a plan take no more nodes than so many times those of another, or the plan is
/// given up.
const FILLED: usize = 3;

impl Beginning<'_> {
    /// The cheapest plan. What a plan costs is found in two steps, of which the second takes
    /// longer: the factors and the back-substitution, then the right-hand sides.
    fn choose(&self, terms: Terms) -> Factorised {
        let mut candidates: Vec<Candidate> = Vec::new();
        let mut most = usize::MAX;
        for plan in self.plans(terms) {
            let Some(factorised) = self.factorised(plan, terms, most) else {
                continue;
            };
            let nodes = factorised.scene.space.arena.len() - self.scene.space.arena.len();
            most = most.min(FILLED * nodes);
            let (factors, back) = Self::given(&mut factorised.scene.clone(), &factorised.system);
            let evaluations = served(terms).len() * factors;
            candidates.push(Candidate {
                factorised,
                at_least: 4 * evaluations + back,
            });
        }
        candidates.sort_by_key(|candidate| candidate.at_least);
        let mut best: Option<(usize, Factorised)> = None;
        for Candidate {
            factorised,
            at_least,
        } in candidates
        {
            if best.as_ref().is_some_and(|(least, _)| at_least >= *least) {
                break;
            }
            // Right-hand sides of many bodies take as long to work out as the factors, and decide
            // seldom.
            let cost = if self.kinds.len() > MANY {
                at_least
            } else {
                self.cost(&factorised, terms)
            };
            if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                best = Some((cost, factorised));
            }
        }
        best.expect("there are strategies").1
    }

    fn factorised(&self, plan: Plan, terms: Terms, most: usize) -> Option<Factorised> {
        let mut scene = self.scene.clone();
        let system = System::within(&mut scene, &self.kinds, plan.clone(), terms, most)?;
        Some(Factorised {
            plan,
            scene,
            system,
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

    /// What a plan costs: four times the evaluations that go by it, with accelerations, multipliers
    /// and relative pivots, and once the back-substitution for a given right-hand side, which runs
    /// less often.
    fn cost(&self, factorised: &Factorised, terms: Terms) -> usize {
        let Factorised { scene, system, .. } = factorised;
        let mut scene = scene.clone();
        let checks = system.checks(&scene);
        let ratio = |check: &Check| scene.space.arena.div(check.pivot, check.before);
        let pivots: Vec<Expr> = checks.iter().map(ratio).collect();
        let evaluations = served(terms).iter().map(|&terms| {
            let solution = solved(&mut scene, &self.kinds, system, terms);
            let outputs = [&solution.accelerations[..], &solution.multipliers, &pivots].concat();
            count(&scene.space.arena, &outputs, Stage::State).weighted()
        });
        let evaluations: usize = evaluations.sum();
        let (_, back) = Self::given(&mut scene, system);
        4 * evaluations + back
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
        (plan.pivots, plan.determinants) = order.pivots(tree, strategy.sequence);
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

pub(super) fn solved(
    scene: &mut Scene,
    kinds: &[BodyKind],
    system: &System,
    terms: Terms,
) -> Solution {
    let right = system.equations_of_motion(scene, terms);
    let upper = applied_forces(scene, kinds);
    system.solve(scene, &right, &upper, Stage::State)
}

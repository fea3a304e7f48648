//! A mechanism in symbols: bodies with their motion, joints with their constraints bound to the
//! bodies.

use super::arena::{Arena, Expr, Input};
use super::bind::{Binder, Effect, Law, all_copies};
use super::expression::{AngleExpr, Constraint, PairedAngles, ScalarExpr, VectorExpr};
use super::fixed::{Copies, number, triple};
use super::kept::kept;
use super::motion::Motion;
use super::rotation::{complete, homogeneous_rotation, normalised_rotation, own_cofactors};
use super::vector::{Frame, Space, Triple, ZERO};
use crate::model::mechanism::Layout;
use crate::model::{BodyKind, ElementKind, Model, Row, Term};

/// A rotation matrix from Euler parameters, row by row.
type Rotation = fn(&mut Arena, [Expr; 4]) -> [Triple; 3];

/// How a body stands and moves.
#[derive(Clone, Copy, Debug)]
pub struct Chart {
    /// The centre of mass, global axes.
    pub position: Triple,
    /// Its velocity, global axes.
    pub velocity: Triple,
    /// The angular velocity, principal axes.
    pub spin: Triple,
    /// From principal to global axes; `None` for a particle.
    pub rotation: Option<[Triple; 3]>,
    /// Euler parameters, where these are coordinates.
    pub orientation: Option<[Expr; 4]>,
}

/// A constraint and where its rows stand.
#[derive(Clone, Debug)]
pub struct Constrained {
    /// The joint.
    pub joint: usize,
    /// The first row among all rows.
    pub row: usize,
    /// The equations.
    pub constraint: Constraint,
    /// Whether they are equations of velocities, so that nothing of them is left at rest.
    pub of_velocities: bool,
}

impl Constrained {
    /// The number of equations.
    #[must_use]
    pub fn equations(&self) -> usize {
        match self.constraint {
            Constraint::Scalar(_) => 1,
            Constraint::Vector(_) => 3,
        }
    }
}

/// A mechanism in symbols.
#[derive(Clone, Debug)]
pub struct Scene {
    /// All vectors and scalars.
    pub space: Space,
    /// Position and rates of the bodies.
    pub motion: Motion,
    /// The constraints of all joints, in order.
    pub constraints: Vec<Constrained>,
    /// Euler parameters as stored, `None` for a particle.
    pub orientation: Vec<Option<[Expr; 4]>>,
    /// Masses.
    pub mass: Vec<Expr>,
    /// Principal moments of inertia.
    pub inertia: Vec<Triple>,
    /// Masses and principal moments that are positive: the same, unless a body is as given.
    pub metric: Vec<(Expr, Triple)>,
    /// Gravity, global axes.
    pub gravity: Triple,
    /// Where things stand.
    pub layout: Layout,
    /// The vector parameters of all joints, then forces, `None` for others.
    pub copies: Vec<Vec<Option<Copies>>>,
    /// The effects of each force.
    pub effects: Vec<Vec<Effect>>,
    /// The auxiliary variables: the angles that they count.
    pub counters: Vec<CountedAngle>,
    /// The displacement of each joint.
    pub displacements: Vec<Option<ScalarExpr>>,
    /// The expressions whose signs decide in laws.
    pub switches: Vec<ScalarExpr>,
}

/// An angle over many turns, and what moves its auxiliary variable.
#[derive(Clone, Debug)]
pub struct CountedAngle {
    /// The angle.
    pub angle: AngleExpr,
    /// The axis, fixed on the first of the bodies.
    pub axis: VectorExpr,
    /// The body that it is measured from, and the one that turns.
    pub bodies: [Option<usize>; 2],
}

/// Whether a body has an axis of symmetry.
fn has_equal_moments([a, b, c]: &Triple) -> bool {
    a == b || b == c || c == a
}

/// `m (c.c I - c c^T)`: the tensor of inertia of a mass on a point.
fn huygens(arena: &mut Arena, m: Expr, c: Triple) -> [Triple; 3] {
    let mut tensor = [ZERO; 3];
    for k in 0..3 {
        for l in 0..3 {
            let (a, b) = ((k + 1) % 3, (k + 2) % 3);
            let arms = if k == l {
                let (first, second) = (arena.square(c[a]), arena.square(c[b]));
                arena.add(first, second)
            } else {
                -arena.mul(c[k], c[l])
            };
            tensor[k][l] = arena.mul(m, arms);
        }
    }
    tensor
}

/// Masses and principal moments that are positive, see [`Model::with_metric`].
fn metric(arena: &mut Arena, model: &Model) -> Vec<(Expr, Triple)> {
    let model = model.with_metric();
    let bodies = model.bodies.iter();
    let metric = bodies.map(|body| {
        let mass = number(arena, body.mass);
        (mass, triple(arena, body.inertia))
    });
    metric.collect()
}

impl Scene {
    /// The scene of a model with Euler parameters as they are, exact for any length of them.
    #[must_use]
    pub fn new(model: &Model) -> Self {
        Self::build(model, homogeneous_rotation, true)
    }

    fn build(model: &Model, rotation: Rotation, exact: bool) -> Self {
        let layout = model.layout();
        let mut arena = Arena::new();
        let mut charts = Vec::new();
        for (place, body) in model.bodies.iter().enumerate() {
            let at = |k: usize| Input::Coordinate((layout.coordinate[place] + k) as u32);
            let rate = |k: usize| Input::Velocity((layout.velocity[place] + k) as u32);
            let position = [0, 1, 2].map(|k| arena.input(at(k)));
            let velocity = [0, 1, 2].map(|k| arena.input(rate(k)));
            let mut chart = Chart {
                position,
                velocity,
                spin: ZERO,
                rotation: None,
                orientation: None,
            };
            if body.kind == BodyKind::Rigid {
                let p = [3, 4, 5, 6].map(|k| arena.input(at(k)));
                let matrix = rotation(&mut arena, p);
                for (k, row) in matrix.iter().enumerate() {
                    for (l, entry) in row.iter().enumerate() {
                        arena.name(*entry, || {
                            format!("{}_a{}{}", body.name.word(), k + 1, l + 1)
                        });
                    }
                }
                chart.spin = [3, 4, 5].map(|k| arena.input(rate(k)));
                chart.rotation = Some(matrix);
                chart.orientation = Some(p);
            }
            charts.push(chart);
        }
        Self::on(
            model,
            arena,
            &charts,
            layout.coordinates,
            exact,
            &|_, _, _| None,
        )
    }

    /// The scene of a model whose bodies move as some charts say; `first_counter` is the coordinate
    /// of the first auxiliary variable, and `paired` knows angles by the pairs of the coordinates.
    pub(crate) fn on(
        model: &Model,
        mut arena: Arena,
        charts: &[Chart],
        first_counter: usize,
        exact: bool,
        paired: &PairedAngles<'_>,
    ) -> Self {
        let layout = model.layout();
        let bodies = || model.bodies.iter();
        let mass = bodies().map(|body| number(&mut arena, body.mass));
        let mass = mass.collect();
        let inertia = bodies().map(|body| triple(&mut arena, body.inertia));
        let inertia = inertia.collect();
        let metric = metric(&mut arena, model);
        let gravity = triple(&mut arena, model.gravity);
        let copies = all_copies(&mut arena, model);
        let time = arena.input(Input::Time);
        let rotations = charts.iter().map(|chart| chart.rotation);
        let mut space = Space::new(arena, rotations.collect());
        if exact {
            space = space.exact();
        }
        let mut motion = Motion {
            position: charts
                .iter()
                .map(|chart| space.native(Frame::Global, chart.position))
                .collect(),
            velocity: charts
                .iter()
                .map(|chart| space.native(Frame::Global, chart.velocity))
                .collect(),
            spin: charts
                .iter()
                .enumerate()
                .map(|(body, chart)| space.native(Frame::Body(body), chart.spin))
                .collect(),
            spin_components: charts.iter().map(|chart| chart.spin).collect(),
            reference: vec![ZERO; charts.len()],
            time,
            states: Vec::new(),
        };
        let mut constraints = Vec::new();
        let mut effects = Vec::new();
        let mut counters = Vec::new();
        let mut displacements = Vec::new();
        let mut first_counters = Vec::new();
        let first_state = first_counter + layout.auxiliaries;
        for (place, element) in model.elements().enumerate() {
            let definition = model.definition(element);
            first_counters.push(first_counter + counters.len());
            let binder = Binder {
                model,
                element,
                copies: &copies[place],
                first_counter: first_counter + counters.len(),
                first_state,
                paired,
            };
            let arena = &mut space.arena;
            // Forces, which stand behind the joints, have no rows.
            let mut row = layout.row.get(place).copied().unwrap_or_default();
            let mut place_in_definition = 0;
            for definition in &definition.rows {
                let constraint = match definition {
                    Row::Scalar(term) => Constraint::Scalar(binder.scalar(arena, term)),
                    Row::Vector(term) => Constraint::Vector(binder.vector(arena, term)),
                };
                for constraint in kept(arena, constraint, place_in_definition, element) {
                    let constrained = Constrained {
                        joint: place,
                        row,
                        constraint,
                        of_velocities: definition.is_of_velocities(),
                    };
                    row += constrained.equations();
                    constraints.push(constrained);
                }
                place_in_definition += definition.equations();
            }
            match definition.kind {
                ElementKind::Joint => {
                    let term = definition.displacement.as_ref();
                    displacements.push(term.map(|term| binder.scalar(arena, term)));
                }
                ElementKind::Force => {
                    let actions = definition.actions.iter();
                    effects.push(actions.map(|action| binder.effect(arena, action)).collect());
                }
            }
            for turn in model.counted(element) {
                let axis = Term::Fixed {
                    body: turn.from,
                    parameter: turn.axis,
                };
                counters.push(CountedAngle {
                    angle: binder.angle(arena, turn),
                    axis: binder.vector(arena, &axis),
                    bodies: [element.bodies[turn.from], element.bodies[turn.to]],
                });
            }
        }
        let elements: Vec<_> = model.elements().collect();
        let reading = |arena: &mut Arena, element: usize, term: &Term| {
            let binder = Binder {
                model,
                element: elements[element],
                copies: &copies[element],
                first_counter: first_counters[element],
                first_state,
                paired,
            };
            binder.scalar(arena, term)
        };
        let rate = Law {
            first_state,
            arguments: &[],
            reading: &reading,
            held: &|of| model.held(None, of),
        };
        for state in &model.states {
            let rate = rate.expand(&mut space.arena, &state.rate);
            motion.states.push(rate);
        }
        let switches = model.switches.iter().map(|switch| {
            let (place, terms) = match &switch.arguments {
                Some((place, terms)) => (Some(*place), &terms[..]),
                None => (None, &[][..]),
            };
            let arena = &mut space.arena;
            let arguments = terms.iter().zip(place.into_iter().cycle());
            let arguments = arguments.map(|(term, place)| reading(arena, place, term));
            let law = Law {
                first_state,
                arguments: &arguments.collect::<Vec<_>>(),
                reading: &reading,
                held: &|of| model.held(place.map(|place| (place, terms)), of),
            };
            law.expand(arena, &switch.of)
        });
        let switches = switches.collect();
        Self {
            space,
            motion,
            constraints,
            orientation: charts.iter().map(|chart| chart.orientation).collect(),
            mass,
            inertia,
            metric,
            gravity,
            layout,
            copies,
            effects,
            counters,
            displacements,
            switches,
        }
    }

    /// What is positive on the side of a joint that is meant. Bound where it is asked for: no other
    /// kernel has a part of it.
    pub(crate) fn sides(&mut self, model: &Model, joint: usize) -> Vec<ScalarExpr> {
        let definition = model.definition(&model.joints[joint]);
        let terms = definition.requirements.iter();
        self.bound(model, joint, |binder, arena| {
            terms.map(|term| binder.scalar(arena, term)).collect()
        })
    }

    /// Point, normal and slip of the contact of a joint, bound likewise.
    pub(crate) fn contact(&mut self, model: &Model, joint: usize) -> Vec<VectorExpr> {
        let definition = model.definition(&model.joints[joint]);
        let terms = definition.contact.iter().flatten();
        self.bound(model, joint, |binder, arena| {
            terms.map(|term| binder.vector(arena, term)).collect()
        })
    }

    /// What is bound of expressions of a joint that speak of no angle over turns, and of no law.
    fn bound<T>(
        &mut self,
        model: &Model,
        joint: usize,
        bind: impl FnOnce(&Binder<'_>, &mut Arena) -> T,
    ) -> T {
        let binder = Binder {
            model,
            element: &model.joints[joint],
            copies: &self.copies[joint],
            first_counter: 0,
            first_state: 0,
            paired: &|_, _, _| None,
        };
        bind(&binder, &mut self.space.arena)
    }

    /// The scene of a model for a solution of its equations: vectors are computed in whatever axes
    /// are cheapest, and every entry of a rotation matrix is its own cofactor.
    ///
    /// Exact for `p` of length 1; elsewhere it differs by the drift of `|p|`, as `A^T A = I` does.
    #[must_use]
    pub fn for_solution(model: &Model) -> Self {
        Self::solvable(model, homogeneous_rotation)
    }

    /// The same with `p / |p|` in the place of `p` in `A(p)`: exact for any `p` but zero.
    #[must_use]
    pub fn normalised(model: &Model) -> Self {
        Self::solvable(model, normalised_rotation)
    }

    fn solvable(model: &Model, rotation: Rotation) -> Self {
        let mut scene = Self::build(model, rotation, false);
        for body in 0..model.bodies.len() {
            let Some(a) = scene.space.rotation(body).copied() else {
                continue;
            };
            own_cofactors(&mut scene.space.arena, &a);
            if has_equal_moments(&scene.inertia[body]) {
                complete(&mut scene.space.arena, &a);
            }
        }
        scene
    }

    /// The centre of mass of a body from the point of reference, body axes.
    pub fn centre(&self, body: usize) -> Triple {
        self.motion.reference[body].map(|component| -component)
    }

    /// The first moment of mass and the tensor of inertia of a body about the point of reference,
    /// principal axes, with masses on points of it, from the centre of mass.
    pub fn moments_about_reference(
        &mut self,
        body: usize,
        points: &[(Expr, Triple)],
    ) -> (Triple, [Triple; 3]) {
        let mut inertia = self.inertia_about_reference(body);
        let (centre, mass) = (self.centre(body), self.mass[body]);
        let arena = &mut self.space.arena;
        let mut moment = centre.map(|c| arena.mul(mass, c));
        for &(mass, point) in points {
            let arm = [0, 1, 2].map(|k| arena.add(point[k], centre[k]));
            let steiner = huygens(arena, mass, arm);
            for k in 0..3 {
                let first = arena.mul(mass, arm[k]);
                moment[k] = arena.add(moment[k], first);
                for l in 0..3 {
                    inertia[k][l] = arena.add(inertia[k][l], steiner[k][l]);
                }
            }
        }
        (moment, inertia)
    }

    /// The tensor of inertia of a body about the point of reference, principal axes:
    /// `J + m (c.c I - c c^T)` (Huygens, Steiner).
    pub fn inertia_about_reference(&mut self, body: usize) -> [Triple; 3] {
        let (c, m, j) = (self.centre(body), self.mass[body], self.inertia[body]);
        let arena = &mut self.space.arena;
        let mut tensor = huygens(arena, m, c);
        for k in 0..3 {
            tensor[k][k] = arena.add(j[k], tensor[k][k]);
        }
        tensor
    }

    /// The gyroscopic moment `-w x J w` of a body about the point of reference, principal axes
    /// (Euler's equations).
    pub fn gyroscopic_moment(&mut self, body: usize) -> Triple {
        let w = self.motion.spin_components[body];
        let j = self.inertia_about_reference(body);
        let arena = &mut self.space.arena;
        [(0, 1, 2), (1, 2, 0), (2, 0, 1)].map(|(m, k, l)| {
            let difference = arena.sub(j[k][k], j[l][l]);
            let product = arena.mul(w[k], w[l]);
            let mut moment = arena.mul(difference, product);
            for (factor, a, b) in [(j[m][k], m, l), (-j[m][l], m, k)] {
                let product = arena.mul(w[a], w[b]);
                let term = arena.mul(factor, product);
                moment = arena.add(moment, term);
            }
            if j[k][l] != Arena::ZERO {
                let (first, second) = (arena.square(w[l]), arena.square(w[k]));
                let squares = arena.sub(first, second);
                let term = arena.mul(j[k][l], squares);
                moment = arena.add(moment, term);
            }
            moment
        })
    }
}

//! What is said of a mechanism before anything is solved: `Phi`, `Phi'`, `D`, `gamma`, masses,
//! energies, rates of coordinates, the described state.

use super::arena::{Arena, Expr, Node};
use super::expression::Constraint;
use super::fixed::{initial_orientation, number, triple};
use super::scene::Scene;
use super::vector::{self, Frame, Triple};
use crate::model::inertia::rotation;
use crate::model::{BodyKind, Model, Switch};

/// Outputs over an arena.
#[derive(Clone, Debug)]
pub struct Kernel {
    /// The arena.
    pub arena: Arena,
    /// What is computed.
    pub outputs: Vec<Expr>,
}

impl Kernel {
    /// The places of outputs of which one is not finite wherever any output is not. A sum or a
    /// product is not finite where an operand is not: what another output is made of by these tells
    /// nothing besides.
    pub(crate) fn telling(&self) -> Vec<usize> {
        let mut is_output = vec![false; self.arena.len()];
        let mut is_told = is_output.clone();
        for output in &self.outputs {
            is_output[output.node()] = true;
        }
        // Operands stand before what is made of them.
        for place in (0..self.arena.len()).rev() {
            if !is_output[place] && !is_told[place] {
                continue;
            }
            match self.arena.node(place) {
                Node::Constant(_) => is_told[place] = true,
                Node::Add(a, b) | Node::Multiply(a, b) => {
                    is_told[a.node()] = true;
                    is_told[b.node()] = true;
                }
                _ => {}
            }
        }
        let outputs = self.outputs.iter().enumerate();
        let mut tells = |output: &Expr| !std::mem::replace(&mut is_told[output.node()], true);
        let places = outputs.filter(|(_, output)| tells(output));
        places.map(|(place, _)| place).collect()
    }
}

/// A block of the Jacobian.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Block {
    /// The joint.
    pub joint: usize,
    /// The body.
    pub body: usize,
    /// Where its values start.
    pub offset: usize,
}

pub(crate) fn kinds(model: &Model) -> Vec<BodyKind> {
    model.bodies.iter().map(|body| body.kind).collect()
}

/// A kernel over a scene of its own, so that no other has a say in what is at hand and in the order
/// of operands.
pub(crate) fn with_scene(scene: &Scene, outputs: impl FnOnce(&mut Scene) -> Vec<Expr>) -> Kernel {
    let mut scene = scene.clone();
    let outputs = outputs(&mut scene);
    Kernel {
        arena: scene.space.arena,
        outputs,
    }
}

/// The first rows of equations between vectors.
pub(crate) fn vector_rows(scene: &Scene) -> Vec<usize> {
    let vectors = scene.constraints.iter();
    let vectors = vectors.filter(|c| matches!(c.constraint, Constraint::Vector(_)));
    vectors.map(|constrained| constrained.row).collect()
}

/// A combination of `Phi`, `Phi'` and the quadratic terms of `Phi''`, row by row.
pub(crate) fn rows(scene: &Scene, factors: [Expr; 3]) -> Kernel {
    with_scene(scene, |scene| combinations(scene, factors))
}

pub(crate) fn combinations(scene: &mut Scene, factors: [Expr; 3]) -> Vec<Expr> {
    (0..scene.constraints.len())
        .flat_map(|place| scene.combination(place, Frame::Global, factors))
        .collect()
}

/// `D`, block by block.
pub(crate) fn jacobian(scene: &Scene, model: &Model) -> (Kernel, Vec<Block>) {
    let mut scene = scene.clone();
    let mut outputs = Vec::new();
    let mut blocks = Vec::new();
    for (joint, described) in model.joints.iter().enumerate() {
        let mut bodies: Vec<usize> = described.bodies.iter().copied().flatten().collect();
        bodies.sort_unstable();
        bodies.dedup();
        let own: Vec<usize> = (0..scene.constraints.len())
            .filter(|&c| scene.constraints[c].joint == joint)
            .collect();
        for body in bodies {
            blocks.push(Block {
                joint,
                body,
                offset: outputs.len(),
            });
            for &place in &own {
                for gradient in scene.gradients(place, Frame::Global) {
                    let force = gradient.force(&mut scene.space, body);
                    outputs.extend(scene.space.components(force, Frame::Global));
                    if model.bodies[body].kind == BodyKind::Rigid {
                        let moment = gradient.moment(&mut scene.space, body);
                        outputs.extend(scene.space.components(moment, Frame::Body(body)));
                    }
                }
            }
        }
    }
    (
        Kernel {
            arena: scene.space.arena,
            outputs,
        },
        blocks,
    )
}

pub(crate) fn mass(scene: &Scene, model: &Model) -> Kernel {
    with_scene(scene, |scene| {
        let mut diagonal = Vec::new();
        for (body, kind) in kinds(model).into_iter().enumerate() {
            diagonal.extend([scene.mass[body]; 3]);
            if kind == BodyKind::Rigid {
                diagonal.extend(scene.inertia[body]);
            }
        }
        diagonal
    })
}

/// The diagonal of a mass matrix that is positive definite: the same, unless a body is as given.
pub(crate) fn metric(scene: &Scene, model: &Model) -> Kernel {
    with_scene(scene, |scene| {
        let mut diagonal = Vec::new();
        for (&(mass, moments), kind) in scene.metric.iter().zip(kinds(model)) {
            diagonal.extend([mass; 3]);
            if kind == BodyKind::Rigid {
                diagonal.extend(moments);
            }
        }
        diagonal
    })
}

pub(crate) fn kinetic_energy(scene: &Scene) -> Kernel {
    with_scene(scene, |scene| {
        let mut sum = Arena::ZERO;
        for body in 0..scene.mass.len() {
            let v = scene
                .space
                .components(scene.motion.velocity[body], Frame::Global);
            let (w, j, m) = (
                scene.motion.spin_components[body],
                scene.inertia[body],
                scene.mass[body],
            );
            let arena = &mut scene.space.arena;
            let squares = v.map(|component| arena.square(component));
            let speed = arena.sum(squares);
            let translation = arena.mul(m, speed);
            let rotation = [0, 1, 2].map(|k| {
                let square = arena.square(w[k]);
                arena.mul(j[k], square)
            });
            let rotation = arena.sum(rotation);
            let both = arena.add(translation, rotation);
            sum = arena.add(sum, both);
        }
        let half = scene.space.arena.constant(0.5);
        vec![scene.space.arena.mul(half, sum)]
    })
}

pub(crate) fn potential_energy(scene: &Scene) -> Kernel {
    with_scene(scene, |scene| {
        let mut sum = Arena::ZERO;
        let gravity = scene.space.native(Frame::Global, scene.gravity);
        for body in 0..scene.mass.len() {
            let height = scene.space.dot(gravity, scene.motion.position[body]);
            let energy = scene.space.arena.mul(scene.mass[body], height);
            sum = scene.space.arena.sub(sum, energy);
        }
        for force in 0..scene.effects.len() {
            let [energy, _] = scene.energy_and_power(force);
            sum = scene.space.arena.add(sum, energy);
        }
        vec![sum]
    })
}

/// `r' = v`, `p' = 1/2 L(p)^T w` with `p` as stored (Nikravesh 1988, eq. 6.111, body axes), and the
/// rates of auxiliary variables.
///
/// Of whatever length `p` is, `p / |p|` then turns at `w`: with `p / |p|` in these rates it would
/// turn at `w / |p|`.
pub(crate) fn coordinate_rates(scene: &mut Scene, model: &Model) -> Vec<Expr> {
    let mut rates = Vec::new();
    for body in 0..model.bodies.len() {
        rates.extend(
            scene
                .space
                .components(scene.motion.velocity[body], Frame::Global),
        );
        let Some(p) = scene.orientation[body] else {
            continue;
        };
        let arena = &mut scene.space.arena;
        rates.extend(euler_rates(arena, p, scene.motion.spin_components[body]));
    }
    for place in 0..scene.counters.len() {
        rates.push(turning(scene, place));
    }
    rates
}

/// `1/2 L(p)^T w` (Nikravesh 1988, eq. 6.111, body axes).
pub(crate) fn euler_rates(arena: &mut Arena, p: [Expr; 4], w: [Expr; 3]) -> [Expr; 4] {
    let half = arena.constant(0.5);
    let w = w.map(|component| arena.mul(half, component));
    let mut combination = |terms: [(usize, usize, bool); 3]| {
        let mut sum = Arena::ZERO;
        for (k, l, minus) in terms {
            let product = arena.mul(p[k], w[l]);
            sum = arena.add(sum, if minus { -product } else { product });
        }
        sum
    };
    [
        combination([(1, 0, true), (2, 1, true), (3, 2, true)]),
        combination([(0, 0, false), (2, 2, false), (3, 1, true)]),
        combination([(0, 1, false), (3, 0, false), (1, 2, true)]),
        combination([(0, 2, false), (1, 1, false), (2, 0, true)]),
    ]
}

/// `a . (w(j) - w(i))` of an angle over many turns.
pub(crate) fn turning(scene: &mut Scene, counter: usize) -> Expr {
    let Scene {
        space,
        motion,
        counters,
        ..
    } = scene;
    let counted = &counters[counter];
    if counted.angle.paired.is_some() {
        return counted.angle.rate(space, motion);
    }
    let axis = counted.axis.value(space, motion);
    let [from, to] = counted.bodies;
    let mut rate = Arena::ZERO;
    for (body, sign) in [(to, Arena::ONE), (from, -Arena::ONE)] {
        if let Some(body) = body {
            let along = space.dot(axis, motion.spin[body]);
            let signed = space.arena.mul(sign, along);
            rate = space.arena.add(rate, signed);
        }
    }
    rate
}

/// The rates of the user's own states.
pub(crate) fn state_rates(scene: &mut Scene) -> Vec<Expr> {
    let Scene { space, motion, .. } = scene;
    let rates = motion.states.iter();
    rates.map(|rate| rate.value(space, motion)).collect()
}

/// The expressions whose signs decide in laws: those that fulfil a condition.
pub(crate) fn switches(
    scene: &mut Scene,
    model: &Model,
    is_wanted: impl Fn(&Switch) -> bool,
) -> Vec<Expr> {
    let Scene {
        space,
        motion,
        switches,
        ..
    } = scene;
    let switches = switches.iter().zip(&model.switches);
    let wanted = switches.filter(|(_, switch)| is_wanted(switch));
    wanted.map(|(of, _)| of.value(space, motion)).collect()
}

/// The rates of the auxiliary variables.
pub(crate) fn counter_rates(scene: &Scene) -> Kernel {
    with_scene(scene, |scene| {
        (0..scene.counters.len())
            .map(|place| turning(scene, place))
            .collect()
    })
}

/// The auxiliary variables, as the angles that they count.
pub(crate) fn counters(scene: &Scene) -> Kernel {
    with_scene(scene, unwrapped_angles)
}

fn unwrapped_angles(scene: &mut Scene) -> Vec<Expr> {
    let Scene {
        space,
        motion,
        counters,
        ..
    } = scene;
    counters
        .iter()
        .map(|counted| counted.angle.value(space, motion))
        .collect()
}

/// The state that the attributes describe: coordinates, auxiliary variables, the user's own states,
/// then velocities.
pub fn initial_state(model: &Model) -> Kernel {
    let mut arena = Arena::new();
    let (mut coordinates, mut velocities) = (Vec::new(), Vec::new());
    for body in &model.bodies {
        coordinates.extend(triple(&mut arena, body.position));
        velocities.extend(triple(&mut arena, body.velocity));
        if body.kind == BodyKind::Rigid {
            coordinates.extend(initial_orientation(&mut arena, body));
            let user = triple(&mut arena, body.angular_velocity);
            let turn = rotation(body.user_axes);
            velocities.extend(turn.map(|row| {
                let row: Triple = row.map(|entry| arena.constant(entry));
                vector::dot(&mut arena, row, user)
            }));
        }
    }
    coordinates.resize(coordinates.len() + model.layout().auxiliaries, Arena::ZERO);
    coordinates.extend(
        model
            .states
            .iter()
            .map(|state| number(&mut arena, state.start)),
    );
    coordinates.extend(velocities);
    Kernel {
        arena,
        outputs: coordinates,
    }
}

#[cfg(test)]
mod tests {
    use super::{Arena, Kernel};
    use crate::symbolic::arena::Input;

    /// Of a number, a reciprocal, what it is made of, a sum with a product and its parts.
    #[test]
    fn what_sums_and_products_are_made_of_tells_nothing_besides() {
        let mut arena = Arena::new();
        let [a, b, c] = [0, 1, 2].map(|k| arena.input(Input::Coordinate(k)));
        let number = arena.constant(2.0);
        let product = arena.mul(a, b);
        let sum = arena.add(product, c);
        let inverse = arena.reciprocal(sum);
        let outputs = vec![number, product, -c, sum, inverse, sum, inverse];
        let kernel = Kernel { arena, outputs };
        // A sum may be infinite where its reciprocal is zero.
        assert_eq!(kernel.telling(), [3, 4]);
    }
}

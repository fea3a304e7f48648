//! A joint by itself: what `Phi`, `D` and `gamma` cost as functions of its bodies alone.

use crate::model::Model;
use crate::symbolic::arena::{Arena, Expr, Input, Stage};
use crate::symbolic::count::{Count, count};
use crate::symbolic::scene::Scene;
use crate::symbolic::vector::Frame;

/// `Phi`, `D` and `gamma` of one joint.
#[derive(Clone, Debug)]
pub struct Alone {
    /// Where the expressions live.
    pub arena: Arena,
    /// An expression for every equation.
    pub constraints: Vec<Expr>,
    /// The rows of `D` along global axes: force and moment on every body of the joint.
    pub jacobian: Vec<Expr>,
    /// An expression for every equation.
    pub gamma: Vec<Expr>,
}

/// The cheapest functions found for a joint, by position, Euler parameters of length 1, velocity
/// and angular velocity of its bodies.
///
/// The angular velocity is given in body axes, as [`Input::Velocity`], and in global axes, as
/// [`Input::Upper`] of the same place: one product `A w` a body serves all its joints.
#[must_use]
pub fn alone(model: &Model, joint: usize) -> Alone {
    let model = model.only(joint);
    let [one, other] = [false, true].map(|from_centres| {
        let mut scene = Scene::for_one_joint(&model, from_centres);
        give_global_spins(&mut scene);
        Alone::of(scene)
    });
    if other.count().total() < one.count().total() {
        other
    } else {
        one
    }
}

impl Alone {
    /// The functions of a scene that has one joint only.
    #[must_use]
    pub fn of(mut scene: Scene) -> Self {
        let places = 0..scene.constraints.len();
        let (zero, one) = (Arena::ZERO, Arena::ONE);
        let combined = |scene: &mut Scene, factors: [Expr; 3]| {
            let rows = places.clone();
            rows.flat_map(|place| scene.combination(place, Frame::Global, factors))
                .collect()
        };
        let constraints = combined(&mut scene, [one, zero, zero]);
        let gamma = combined(&mut scene, [zero, zero, -one]);
        let mut jacobian = Vec::new();
        for place in places {
            for gradient in scene.gradients(place, Frame::Global) {
                for body in 0..scene.mass.len() {
                    let force = gradient.force(&mut scene.space, body);
                    let moment = gradient.moment(&mut scene.space, body);
                    for vector in [force, moment] {
                        jacobian.extend(scene.space.components(vector, Frame::Global));
                    }
                }
            }
        }
        Self {
            arena: scene.space.arena,
            constraints,
            jacobian,
            gamma,
        }
    }

    /// What the three functions cost together.
    #[must_use]
    pub fn count(&self) -> Count {
        let outputs = [&self.constraints[..], &self.jacobian, &self.gamma].concat();
        count(&self.arena, &outputs, Stage::State)
    }
}

fn give_global_spins(scene: &mut Scene) {
    for body in 0..scene.mass.len() {
        if scene.orientation[body].is_some() {
            let first = scene.layout.velocity[body] + 3;
            let given = [0, 1, 2].map(|k| {
                let place = u32::try_from(first + k).expect("fewer than 2^32 velocities");
                scene.space.arena.input(Input::Upper(place))
            });
            let spin = scene.motion.spin[body];
            scene.space.give(spin, Frame::Global, given);
        }
    }
}

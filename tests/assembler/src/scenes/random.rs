//! Scenes of one joint with random data.

use nalgebra::Vector4;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::GRAVITY;
use crate::assembler::Assembler;
use crate::bodies::{Body, BodyId, GROUND};
use crate::joints::Joint;

/// A rigid body with a random mass (kg), inertia (kg m^2), position (up to 0.5 m per axis) and
/// orientation, at rest.
#[must_use]
pub fn random_body(rng: &mut ChaCha8Rng) -> Body {
    // Sums of two of three positive numbers: the moments of a body that can exist.
    let [a, b, c] = [(); 3].map(|()| rng.random_range(0.02..0.3));
    let mass = rng.random_range(0.5..3.0);
    let position = [(); 3].map(|()| rng.random_range(-0.5..0.5));
    let euler = Vector4::from_fn(|_, _| rng.random_range(-1.0..1.0_f64));
    Body::rigid(mass, [b + c, c + a, a + b], position).with_euler(euler.normalize().into())
}

/// Random bodies, the ground where `moves` says no, and one joint among them.
pub fn connected<const N: usize>(
    moves: [bool; N],
    rng: &mut ChaCha8Rng,
    joint: impl FnOnce(&Assembler, [BodyId; N], &mut ChaCha8Rng) -> Joint,
) -> Assembler {
    let mut scene = Assembler::new(GRAVITY);
    let bodies = moves.map(|moves| {
        if moves {
            scene.add_body(random_body(rng))
        } else {
            GROUND
        }
    });
    let joint = joint(&scene, bodies, rng);
    scene.add_joint(joint);
    scene
}

/// Which of two bodies is the ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ends {
    /// Neither.
    Bodies,
    /// The first.
    GroundFirst,
    /// The second.
    GroundSecond,
}

impl Ends {
    /// All three.
    pub const ALL: [Self; 3] = [Self::Bodies, Self::GroundFirst, Self::GroundSecond];
}

/// Two random bodies, or one and the ground, with one joint between them.
pub fn two_bodies(
    ends: Ends,
    rng: &mut ChaCha8Rng,
    joint: impl FnOnce(&Assembler, [BodyId; 2], &mut ChaCha8Rng) -> Joint,
) -> Assembler {
    let moves = [ends != Ends::GroundFirst, ends != Ends::GroundSecond];
    connected(moves, rng, joint)
}

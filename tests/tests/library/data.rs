//! Numbers that scenes are made of.

use holonom_assembler::assembler::Assembler;
use holonom_assembler::bodies::{Body, BodyId, GROUND};
use nalgebra::Vector3;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Poses of three bodies, points (m), axes (any length), a number; global axes, reference
/// configuration.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Data {
    pub(crate) gravity: [f64; 3],
    pub(crate) positions: [[f64; 3]; 3],
    /// Euler parameters of any length.
    pub(crate) orientations: [[f64; 4]; 3],
    pub(crate) head: [f64; 3],
    pub(crate) tail: [f64; 3],
    pub(crate) a: [f64; 3],
    /// At less than a right angle with `a`.
    pub(crate) b: [f64; 3],
    pub(crate) number: f64,
}

/// The numbers that stand in the scenes of literals.
pub(crate) const LITERAL: Data = Data {
    gravity: [0.0; 3],
    positions: [[0.1, 0.2, -0.3], [-0.4, 0.3, 0.2], [0.2, -0.5, 0.1]],
    orientations: [
        [0.5, -0.1, 0.7, 0.5],
        [0.1, 0.7, -0.5, 0.5],
        [0.7, 0.1, 0.5, -0.5],
    ],
    head: [0.3, -0.2, 0.4],
    tail: [0.7, 0.5, -0.6],
    a: [0.5, 1.0, -0.25],
    b: [0.75, 0.5, 0.5],
    number: 0.8,
};

fn vector(rng: &mut ChaCha8Rng, size: f64) -> [f64; 3] {
    [(); 3].map(|()| rng.random_range(-size..size))
}

impl Data {
    /// Anything, but for directions that are well defined.
    pub(crate) fn random(rng: &mut ChaCha8Rng) -> Self {
        let head = vector(rng, 0.5);
        let [tx, ty, tz] = vector(rng, 0.5);
        let (a, b) = loop {
            let (a, b) = (vector(rng, 1.0), vector(rng, 1.0));
            let [u, v] = [a, b].map(Vector3::from);
            let cosine = u.dot(&v) / (u.norm() * v.norm());
            if u.norm() > 0.3 && v.norm() > 0.3 && (0.1..0.9).contains(&cosine) {
                break (a, b);
            }
        };
        Self {
            gravity: vector(rng, 10.0),
            positions: [(); 3].map(|()| vector(rng, 0.5)),
            orientations: [(); 3].map(|()| {
                let size = rng.random_range(0.5..2.0);
                let p = [(); 4].map(|()| rng.random_range(0.1..1.0));
                p.map(|e: f64| {
                    if rng.random_bool(0.5) {
                        size * e
                    } else {
                        -size * e
                    }
                })
            }),
            head,
            tail: [tx, ty, tz + 1.5],
            a,
            b,
            number: rng.random_range(0.3..1.5),
        }
    }

    /// A direction perpendicular to both axes.
    pub(crate) fn arm(&self) -> [f64; 3] {
        Vector3::from(self.a).cross(&Vector3::from(self.b)).into()
    }

    /// A point that is perpendicular to `a` from the head.
    pub(crate) fn across(&self) -> [f64; 3] {
        (Vector3::from(self.head) + Vector3::from(self.arm())).into()
    }

    /// A point in the direction `a` from the head.
    pub(crate) fn beyond(&self) -> [f64; 3] {
        (Vector3::from(self.head) + self.number * Vector3::from(self.a)).into()
    }

    /// Where the particle is.
    pub(crate) fn centre(&self) -> [f64; 3] {
        self.positions[2]
    }

    /// The distance of head and tail (m).
    pub(crate) fn reach(&self) -> f64 {
        (Vector3::from(self.tail) - Vector3::from(self.head)).norm()
    }

    /// The bodies of a scene: `i`, `j`, `k`, or a particle in the place of `k`.
    pub(crate) fn assembler(&self, bodies: &[Member]) -> (Assembler, Vec<BodyId>) {
        let mut scene = Assembler::new(self.gravity);
        let among = bodies.iter().map(|member| match member {
            Member::Ground => GROUND,
            Member::Bead => scene.add_body(Body::particle(0.9, self.positions[2])),
            Member::I => scene.add_body(self.body(0, 1.3, [0.2, 0.3, 0.25])),
            Member::J => scene.add_body(self.body(1, 0.7, [0.1, 0.15, 0.12])),
            Member::K => scene.add_body(self.body(2, 2.1, [0.4, 0.35, 0.5])),
        });
        let among = among.collect();
        (scene, among)
    }

    fn body(&self, k: usize, mass: f64, inertia: [f64; 3]) -> Body {
        let euler = nalgebra::Vector4::from(self.orientations[k]).normalize();
        Body::rigid(mass, inertia, self.positions[k]).with_euler(euler.into())
    }
}

/// What an element may be between.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Member {
    Ground,
    I,
    J,
    K,
    Bead,
}

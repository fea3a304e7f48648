//! Joints whose rows couple several products or angles: constant velocity, screw, gears, rack and
//! pinion.
//!
//! Points (m) and axes (any length) as in [`library`](crate::library). Sources: Haug (1989),
//! chapter 9 (screw, gears, rack and pinion); Nikravesh (1988), chapter 7.

use core::f64::consts::TAU;

use nalgebra::Vector3;

use crate::assembler::Assembler;
use crate::bodies::BodyId;
use crate::joints::{Joint, Row};
use crate::laws::Motion;
use crate::library::{along, coincidence, joint, unit};
use crate::scalars::Scalar;

impl Joint {
    /// `P_j - P_i`, `b_i . n_j - n_i . b_j`: 4 rows. `n_j`, `b_j` are the normals of `axis_i`,
    /// turned by the least rotation that takes `axis_i` to `axis_j`: in this frame both shafts turn
    /// by the same angle at any bend.
    #[must_use]
    pub fn constant_velocity(
        scene: &Assembler,
        [i, j]: [BodyId; 2],
        point: [f64; 3],
        axis_i: [f64; 3],
        axis_j: [f64; 3],
    ) -> Self {
        let (a_i, a_j) = (unit(axis_i), unit(axis_j));
        let [n, b] = scene.normals(&a_i);
        let turned = |v: &Vector3<f64>| v - v.dot(&a_j) / (1.0 + a_i.dot(&a_j)) * (a_i + a_j);
        let [n_i, b_i] = [n, b].map(|v| scene.vector(i, v.into()));
        let [n_j, b_j] = [n, b].map(|v| scene.vector(j, turned(&v).into()));
        let rows = [
            coincidence(scene, [i, j], point),
            Row::combination([
                (1.0, Scalar::Product([b_i, n_j])),
                (-1.0, Scalar::Product([n_i, b_j])),
            ]),
        ];
        joint(scene, [i, j], point, point, rows)
    }

    /// The rows of a cylindrical joint, then `a_i . d - pitch / (2 pi) theta` with the advance
    /// `pitch` (m) per turn: 5 rows.
    #[must_use]
    pub fn screw(
        scene: &Assembler,
        between: [BodyId; 2],
        point: [f64; 3],
        axis: [f64; 3],
        pitch: f64,
    ) -> Self {
        let mut joint = Self::cylindrical(scene, between, point, axis);
        joint.push(Row::combination([
            (1.0, along(scene, between, point, point, axis)),
            (-pitch / TAU, Scalar::Angle(scene.angle(between, axis))),
        ]));
        joint
    }

    /// Angle of `j` against the carrier `k` minus `ratio` times that of `i` against `k`: 1 row;
    /// external gears have a negative ratio.
    #[must_use]
    pub fn gear(
        scene: &Assembler,
        [i, j, k]: [BodyId; 3],
        axis_i: [f64; 3],
        axis_j: [f64; 3],
        ratio: f64,
    ) -> Self {
        let row = Row::combination([
            (1.0, Scalar::Angle(scene.angle([k, j], axis_j))),
            (-ratio, Scalar::Angle(scene.angle([k, i], axis_i))),
        ]);
        Self::new([i, j, k], [Vector3::zeros(); 3], [row])
    }

    /// `slide_k . (P_j - H_i) - radius theta`, less what it is in the reference configuration, with
    /// the point `H` of the pinion `i`, `P` of the rack `j`, and `theta` the angle of the pinion
    /// against the carrier `k` about `axis`: 1 row.
    #[must_use]
    pub fn rack_and_pinion(
        scene: &Assembler,
        [i, j, k]: [BodyId; 3],
        axis: [f64; 3],
        [hub, point]: [[f64; 3]; 2],
        slide: [f64; 3],
        radius: f64,
    ) -> Self {
        let far = Scalar::Along {
            axis: scene.vector(k, unit(slide).into()),
            points: [scene.point(i, hub), scene.point(j, point)],
        };
        let initial = unit(slide).dot(&(Vector3::from(point) - Vector3::from(hub)));
        let row = Row::Combination {
            terms: vec![
                (1.0, far),
                (-radius, Scalar::Angle(scene.angle([k, i], axis))),
            ],
            motion: Motion::Constant(initial),
        };
        let bodies = [i, j, k];
        Self::new(
            bodies,
            bodies.map(|body| scene.to_body_point(body, hub)),
            [row],
        )
    }
}

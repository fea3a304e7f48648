//! Primitive joints between axes and points, and drivers: rows that follow a law of time.
//!
//! Like [`library`](crate::library): points (m) and axes (any length) in global axes of the
//! reference configuration, `d` from a point of `i` to a point of `j`. Sources: Nikravesh (1988),
//! chapter 7; Haug (1989), chapter 9.

use nalgebra::Vector3;

use crate::assembler::Assembler;
use crate::bodies::BodyId;
use crate::joints::{Joint, Row};
use crate::laws::Motion;
use crate::library::{along, parallel, unit};
use crate::scalars::Scalar;

/// A joint of two bodies whose rows are from `head` on `i` to `tail` on `j`.
fn between_points(
    scene: &Assembler,
    [i, j]: [BodyId; 2],
    head: [f64; 3],
    tail: [f64; 3],
    rows: impl Into<Vec<Row>>,
) -> Joint {
    let points = [scene.to_body_point(i, head), scene.to_body_point(j, tail)];
    Joint::new([i, j], points, rows)
}

/// A joint of two bodies without points.
fn between_axes(between: [BodyId; 2], rows: impl Into<Vec<Row>>) -> Joint {
    Joint::new(between, [Vector3::zeros(); 2], rows)
}

impl Joint {
    /// `a_i . a_j`: 1 row.
    #[must_use]
    pub fn perpendicular1(
        scene: &Assembler,
        [i, j]: [BodyId; 2],
        axis_i: [f64; 3],
        axis_j: [f64; 3],
    ) -> Self {
        let row = Row::perpendicular(
            scene.vector(i, unit(axis_i).into()),
            scene.vector(j, unit(axis_j).into()),
        );
        between_axes([i, j], [row])
    }

    /// `a_i . d`: 1 row.
    #[must_use]
    pub fn perpendicular2(
        scene: &Assembler,
        between: [BodyId; 2],
        axis: [f64; 3],
        head: [f64; 3],
        tail: [f64; 3],
    ) -> Self {
        let row = Row::constant(along(scene, between, head, tail, axis), 0.0);
        between_points(scene, between, head, tail, [row])
    }

    /// `n1_i . a_j`, `n2_i . a_j` of the normals of `axis_i`: 2 rows.
    #[must_use]
    pub fn parallel1(
        scene: &Assembler,
        between: [BodyId; 2],
        axis_i: [f64; 3],
        axis_j: [f64; 3],
    ) -> Self {
        between_axes(between, parallel(scene, between, axis_i, axis_j))
    }

    /// `n1_i . d`, `n2_i . d`: 2 rows.
    #[must_use]
    pub fn parallel2(
        scene: &Assembler,
        between: [BodyId; 2],
        axis: [f64; 3],
        head: [f64; 3],
        tail: [f64; 3],
    ) -> Self {
        let rows = scene
            .normals(&unit(axis))
            .map(|n| Row::constant(along(scene, between, head, tail, n.into()), 0.0));
        between_points(scene, between, head, tail, rows)
    }

    /// `theta - f(t)` of the unwrapped angle of `j` against `i`: 1 row.
    #[must_use]
    pub fn angle_driver(
        scene: &Assembler,
        between: [BodyId; 2],
        axis: [f64; 3],
        motion: Motion,
    ) -> Self {
        let angle = Scalar::Angle(scene.angle(between, axis));
        between_axes(between, [Row::driven(angle, motion)])
    }

    /// `|d| - f(t)`: 1 row.
    #[must_use]
    pub fn distance_driver(
        scene: &Assembler,
        [i, j]: [BodyId; 2],
        head: [f64; 3],
        tail: [f64; 3],
        motion: Motion,
    ) -> Self {
        let length = Scalar::Length([scene.point(i, head), scene.point(j, tail)]);
        between_points(scene, [i, j], head, tail, [Row::driven(length, motion)])
    }

    /// `a_i . d - f(t)` with `d` between the copies of one point: 1 row.
    #[must_use]
    pub fn displacement_driver(
        scene: &Assembler,
        between: [BodyId; 2],
        point: [f64; 3],
        axis: [f64; 3],
        motion: Motion,
    ) -> Self {
        let displacement = along(scene, between, point, point, axis);
        let row = Row::driven(displacement, motion);
        between_points(scene, between, point, point, [row])
    }

    /// `n1_i . a_j`, `n2_i . a_j`, `theta - f(t)`: 3 rows.
    #[must_use]
    pub fn orientation_driver(
        scene: &Assembler,
        between: [BodyId; 2],
        axis: [f64; 3],
        motion: Motion,
    ) -> Self {
        let [r1, r2] = parallel(scene, between, axis, axis);
        let angle = Scalar::Angle(scene.angle(between, axis));
        between_axes(between, [r1, r2, Row::driven(angle, motion)])
    }
}

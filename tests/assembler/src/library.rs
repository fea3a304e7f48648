//! The joints by name, from points (m) and axes (any length) in global axes of the reference
//! configuration.
//!
//! Rows stand in the order of the definitions; [`Assembler::normals`] is applied to the axis in
//! global axes and the two vectors are carried to the body that the definition names. `d` is the
//! point on `j` minus the point on `i`. Sources: Nikravesh (1988), chapter 7; Haug (1989), chapter
//! 9; Flores (2015), chapter 8.

use nalgebra::Vector3;

use crate::angles::Angle;
use crate::assembler::Assembler;
use crate::bodies::BodyId;
use crate::joints::{Joint, Row};
use crate::kinematics::Mark;
use crate::scalars::Scalar;

impl Assembler {
    /// A point (m, global axes, reference configuration) fixed on a body.
    #[must_use]
    pub fn point(&self, body: BodyId, point: [f64; 3]) -> Mark {
        Mark::new(body, self.to_body_point(body, point))
    }

    /// A vector (global axes, reference configuration) fixed on a body.
    #[must_use]
    pub fn vector(&self, body: BodyId, vector: [f64; 3]) -> Mark {
        Mark::new(body, self.to_body_vector(body, vector))
    }

    /// The angle of `j` against `i` about an axis, zero in the reference configuration.
    #[must_use]
    pub fn angle(&self, [i, j]: [BodyId; 2], axis: [f64; 3]) -> Angle {
        let axis = unit(axis);
        let [n1, n2] = self.normals(&axis);
        Angle::new(
            [n1, n2].map(|n| self.vector(i, n.into())),
            self.vector(j, n1.into()),
            self.vector(i, axis.into()),
        )
    }
}

/// The unit vector along an axis.
pub(crate) fn unit(axis: [f64; 3]) -> Vector3<f64> {
    Vector3::from(axis).normalize()
}

/// The two normals of an axis on body `i`, each perpendicular to the axis on body `j`.
pub(crate) fn parallel(
    scene: &Assembler,
    [i, j]: [BodyId; 2],
    axis_i: [f64; 3],
    axis_j: [f64; 3],
) -> [Row; 2] {
    let other = scene.vector(j, unit(axis_j).into());
    scene
        .normals(&unit(axis_i))
        .map(|n| Row::perpendicular(scene.vector(i, n.into()), other))
}

/// `n1 . d` and `n2 . d` of the normals of an axis on body `i`.
fn beside(
    scene: &Assembler,
    [i, j]: [BodyId; 2],
    head: [f64; 3],
    tail: [f64; 3],
    axis: [f64; 3],
) -> [Row; 2] {
    let points = [scene.point(i, head), scene.point(j, tail)];
    scene.normals(&unit(axis)).map(|n| {
        let axis = scene.vector(i, n.into());
        Row::constant(Scalar::Along { axis, points }, 0.0)
    })
}

/// `a . d` of a unit axis `a` on body `i`.
pub(crate) fn along(
    scene: &Assembler,
    [i, j]: [BodyId; 2],
    head: [f64; 3],
    tail: [f64; 3],
    axis: [f64; 3],
) -> Scalar {
    Scalar::Along {
        axis: scene.vector(i, unit(axis).into()),
        points: [scene.point(i, head), scene.point(j, tail)],
    }
}

/// `a . d` kept at what it is in the reference configuration.
fn along_kept(
    scene: &Assembler,
    between: [BodyId; 2],
    head: [f64; 3],
    tail: [f64; 3],
    axis: [f64; 3],
) -> Row {
    let gap = Vector3::from(tail) - Vector3::from(head);
    let initial = unit(axis).dot(&gap);
    Row::constant(along(scene, between, head, tail, axis), initial)
}

/// `d . d` kept at what it is in the reference configuration.
fn distance_kept(scene: &Assembler, [i, j]: [BodyId; 2], head: [f64; 3], tail: [f64; 3]) -> Row {
    let initial = (Vector3::from(tail) - Vector3::from(head)).norm_squared();
    let points = [scene.point(i, head), scene.point(j, tail)];
    Row::constant(Scalar::SquaredLength(points), initial)
}

pub(crate) fn coincidence(scene: &Assembler, between: [BodyId; 2], point: [f64; 3]) -> Row {
    Row::Coincidence(between.map(|body| scene.point(body, point)))
}

/// A joint of two bodies whose reactions are reduced to a point on `i` and a point on `j`.
pub(crate) fn joint(
    scene: &Assembler,
    between: [BodyId; 2],
    head: [f64; 3],
    tail: [f64; 3],
    rows: impl Into<Vec<Row>>,
) -> Joint {
    let points = [
        scene.to_body_point(between[0], head),
        scene.to_body_point(between[1], tail),
    ];
    Joint::new(between, points, rows)
}

impl Joint {
    /// `P_j - P_i`: 3 rows.
    #[must_use]
    pub fn spherical(scene: &Assembler, between: [BodyId; 2], point: [f64; 3]) -> Self {
        let rows = [coincidence(scene, between, point)];
        joint(scene, between, point, point, rows)
    }

    /// `P_j - P_i`, `n1 . a_j`, `n2 . a_j`: 5 rows.
    #[must_use]
    pub fn revolute(
        scene: &Assembler,
        between: [BodyId; 2],
        point: [f64; 3],
        axis: [f64; 3],
    ) -> Self {
        let [r1, r2] = parallel(scene, between, axis, axis);
        let rows = [coincidence(scene, between, point), r1, r2];
        joint(scene, between, point, point, rows)
    }

    /// `P_j - P_i`, `a_i . a_j`: 4 rows.
    #[must_use]
    pub fn universal(
        scene: &Assembler,
        between: [BodyId; 2],
        point: [f64; 3],
        axis_i: [f64; 3],
        axis_j: [f64; 3],
    ) -> Self {
        let cross = [(between[0], axis_i), (between[1], axis_j)]
            .map(|(body, axis)| scene.vector(body, unit(axis).into()));
        let rows = [
            coincidence(scene, between, point),
            Row::perpendicular(cross[0], cross[1]),
        ];
        joint(scene, between, point, point, rows)
    }

    /// `n1 . a_j`, `n2 . a_j`, `n1 . d`, `n2 . d`: 4 rows.
    #[must_use]
    pub fn cylindrical(
        scene: &Assembler,
        between: [BodyId; 2],
        point: [f64; 3],
        axis: [f64; 3],
    ) -> Self {
        let [r1, r2] = parallel(scene, between, axis, axis);
        let [r3, r4] = beside(scene, between, point, point, axis);
        joint(scene, between, point, point, [r1, r2, r3, r4])
    }

    /// The rows of a cylindrical joint, then `n1_i . n2_j`: 5 rows.
    #[must_use]
    pub fn prismatic(
        scene: &Assembler,
        between: [BodyId; 2],
        point: [f64; 3],
        axis: [f64; 3],
    ) -> Self {
        let [n1, n2] = scene.normals(&unit(axis));
        let (n1, n2) = (
            scene.vector(between[0], n1.into()),
            scene.vector(between[1], n2.into()),
        );
        let mut joint = Self::cylindrical(scene, between, point, axis);
        joint.push(Row::perpendicular(n1, n2));
        joint
    }

    /// `P_j - P_i`, then `y_i . x_j`, `z_i . x_j`, `y_i . z_j` of the global axes of the reference
    /// configuration: 6 rows.
    #[must_use]
    pub fn fixed(scene: &Assembler, between: [BodyId; 2], point: [f64; 3]) -> Self {
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
        let [_, yi, zi] = axes.map(|axis| scene.vector(between[0], axis.into()));
        let [xj, _, zj] = axes.map(|axis| scene.vector(between[1], axis.into()));
        let rows = [
            coincidence(scene, between, point),
            Row::perpendicular(yi, xj),
            Row::perpendicular(zi, xj),
            Row::perpendicular(yi, zj),
        ];
        joint(scene, between, point, point, rows)
    }

    /// `n1 . a_j`, `n2 . a_j`, `a_i . d` with `a` the normal of the plane: 3 rows.
    #[must_use]
    pub fn planar(
        scene: &Assembler,
        between: [BodyId; 2],
        point: [f64; 3],
        normal: [f64; 3],
    ) -> Self {
        let [r1, r2] = parallel(scene, between, normal, normal);
        let flat = Row::constant(along(scene, between, point, point, normal), 0.0);
        joint(scene, between, point, point, [r1, r2, flat])
    }

    /// `d . d - L^2` between `head` on `i` and `tail` on `j`, the reference distance without a
    /// `length` (m): 1 row.
    #[must_use]
    pub fn distance(
        scene: &Assembler,
        between: [BodyId; 2],
        head: [f64; 3],
        tail: [f64; 3],
        length: Option<f64>,
    ) -> Self {
        let described = (Vector3::from(tail) - Vector3::from(head)).norm();
        let points = [(between[0], head), (between[1], tail)]
            .map(|(body, point)| scene.to_body_point(body, point));
        Self::distance_at(between, points, length.unwrap_or(described))
    }

    /// `a_i . d` and `d . d` as described, from `hinge` on `i` to `ball` on `j`: 2 rows.
    #[must_use]
    pub fn revolute_spherical(
        scene: &Assembler,
        between: [BodyId; 2],
        hinge: [f64; 3],
        axis: [f64; 3],
        ball: [f64; 3],
    ) -> Self {
        let rows = [
            along_kept(scene, between, hinge, ball, axis),
            distance_kept(scene, between, hinge, ball),
        ];
        joint(scene, between, hinge, ball, rows)
    }

    /// `n1 . a_j`, `n2 . a_j`, then `a_i . d` and `d . d` as described, from `first` on `i` to
    /// `second` on `j`: 4 rows.
    #[must_use]
    pub fn revolute_revolute(
        scene: &Assembler,
        between: [BodyId; 2],
        first: [f64; 3],
        second: [f64; 3],
        axis: [f64; 3],
    ) -> Self {
        let [r1, r2] = parallel(scene, between, axis, axis);
        let rows = [
            r1,
            r2,
            along_kept(scene, between, first, second, axis),
            distance_kept(scene, between, first, second),
        ];
        joint(scene, between, first, second, rows)
    }

    /// `n1 . d`, `n2 . d`: the point of `j` on the line fixed on `i`, 2 rows.
    #[must_use]
    pub fn point_on_line(
        scene: &Assembler,
        between: [BodyId; 2],
        point: [f64; 3],
        axis: [f64; 3],
    ) -> Self {
        let rows = beside(scene, between, point, point, axis);
        joint(scene, between, point, point, rows)
    }

    /// `a_i . d`: the point of `j` in the plane fixed on `i`, 1 row.
    #[must_use]
    pub fn point_on_plane(
        scene: &Assembler,
        between: [BodyId; 2],
        point: [f64; 3],
        normal: [f64; 3],
    ) -> Self {
        let row = Row::constant(along(scene, between, point, point, normal), 0.0);
        joint(scene, between, point, point, [row])
    }
}

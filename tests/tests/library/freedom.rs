//! What each joint leaves free, from the geometry alone: the relative motions of `j` against `i`
//! that it allows, as twists at a point of `j`. Nothing here knows an equation of a joint.

use core::f64::consts::TAU;

use holonom_assembler::assembler::Assembler;
use holonom_assembler::bodies::BodyId;
use holonom_assembler::joints::normals;
use holonom_assembler::kinematics::Kinematics;
use nalgebra::{DMatrix, Vector3, Vector6};

type V = [f64; 3];

/// A point (m, global axes) and the motions that are free there: velocity of the point, then
/// angular velocity, global axes.
pub(crate) struct Freedom {
    pub(crate) point: Vector3<f64>,
    pub(crate) twists: Vec<Vector6<f64>>,
    /// From 1 to 0 where the directions become undetermined: their round-off is that of a unit
    /// vector over this.
    pub(crate) sharpness: f64,
}

/// Two bodies at an instant.
pub(crate) struct Pair<'a> {
    scene: &'a Assembler,
    at: Kinematics,
    ends: [BodyId; 2],
}

/// The first or the second body of a joint.
#[derive(Clone, Copy)]
enum End {
    I,
    J,
}

use End::{I, J};

impl<'a> Pair<'a> {
    pub(crate) fn new(scene: &'a Assembler, ends: [BodyId; 2], time: f64, x: &[f64]) -> Self {
        Self {
            at: scene.kinematics_at(time, x),
            scene,
            ends,
        }
    }

    /// A point given in the reference configuration, on a body.
    fn point(&self, end: End, point: V) -> Vector3<f64> {
        self.scene
            .point(self.ends[end as usize], point)
            .point(&self.at)
    }

    /// The unit vector along an axis given in the reference configuration, on a body.
    fn axis(&self, end: End, axis: V) -> Vector3<f64> {
        let mark = self.scene.vector(self.ends[end as usize], axis);
        mark.vector(&self.at).normalize()
    }

    /// The relative twist of `j` against `i` at a point.
    pub(crate) fn relative(&self, point: &Vector3<f64>) -> Vector6<f64> {
        let [i, j] = self.ends.map(|body| {
            let frame = self.at.frame(body);
            let w = frame.rotation * frame.rate;
            (frame.velocity + w.cross(&(point - frame.position)), w)
        });
        twist(j.0 - i.0, j.1 - i.1)
    }
}

fn twist(v: Vector3<f64>, w: Vector3<f64>) -> Vector6<f64> {
    Vector6::new(v.x, v.y, v.z, w.x, w.y, w.z)
}

fn slides<const N: usize>(along: [Vector3<f64>; N]) -> [Vector6<f64>; N] {
    along.map(|v| twist(v, Vector3::zeros()))
}

fn turns<const N: usize>(about: [Vector3<f64>; N]) -> [Vector6<f64>; N] {
    about.map(|w| twist(Vector3::zeros(), w))
}

/// The global axes: any direction.
fn any() -> [Vector3<f64>; 3] {
    [Vector3::x(), Vector3::y(), Vector3::z()]
}

fn free(point: Vector3<f64>, twists: &[&[Vector6<f64>]]) -> Freedom {
    Freedom {
        point,
        twists: twists.concat(),
        sharpness: 1.0,
    }
}

/// A twist at a point as it is at the origin: the velocity of what moves along there, and the same
/// angular velocity.
pub(crate) fn at_origin(twist_there: &Vector6<f64>, point: &Vector3<f64>) -> Vector6<f64> {
    let [v, w] = [0, 3].map(|k| Vector3::from(twist_there.fixed_rows::<3>(k)));
    twist(v + point.cross(&w), w)
}

/// The projection onto what some twists do not span.
pub(crate) fn complement(twists: &[Vector6<f64>]) -> DMatrix<f64> {
    let mut left = DMatrix::identity(6, 6);
    if !twists.is_empty() {
        let span = DMatrix::from_fn(6, twists.len(), |row, column| twists[column][row]);
        let q = span.qr().q();
        left -= &q * q.transpose();
    }
    left
}

/// The part of a vector that the twists do not span.
pub(crate) fn beside(twists: &[Vector6<f64>], vector: &Vector6<f64>) -> f64 {
    (complement(twists) * vector).norm()
}

/// How much of each free twist, scaled to the length 1, is in a vector (least squares).
pub(crate) fn coordinates(twists: &[Vector6<f64>], vector: &Vector6<f64>) -> Vec<f64> {
    if twists.is_empty() {
        return Vec::new();
    }
    let span = DMatrix::from_fn(6, twists.len(), |row, column| {
        twists[column][row] / twists[column].norm()
    });
    let svd = span.svd(true, true);
    let found = svd.solve(vector, 1e-9).expect("both sides were computed");
    found.iter().copied().collect()
}

pub(crate) fn spherical(p: &Pair<'_>, [point]: [V; 1]) -> Freedom {
    free(p.point(J, point), &[&turns(any())])
}

pub(crate) fn revolute(p: &Pair<'_>, [point, axis]: [V; 2]) -> Freedom {
    free(p.point(J, point), &[&turns([p.axis(I, axis)])])
}

/// About either arm of the cross.
pub(crate) fn universal(p: &Pair<'_>, [point, axis_i, axis_j]: [V; 3]) -> Freedom {
    let arms = [p.axis(I, axis_i), p.axis(J, axis_j)];
    free(p.point(J, point), &[&turns(arms)])
}

pub(crate) fn cylindrical(p: &Pair<'_>, [point, axis]: [V; 2]) -> Freedom {
    let a = [p.axis(I, axis)];
    free(p.point(J, point), &[&slides(a), &turns(a)])
}

pub(crate) fn prismatic(p: &Pair<'_>, [point, axis]: [V; 2]) -> Freedom {
    free(p.point(J, point), &[&slides([p.axis(I, axis)])])
}

pub(crate) fn fixed(p: &Pair<'_>, [point]: [V; 1]) -> Freedom {
    free(p.point(J, point), &[])
}

pub(crate) fn planar(p: &Pair<'_>, [point, normal]: [V; 2]) -> Freedom {
    let n = p.axis(I, normal);
    free(p.point(J, point), &[&slides(normals(&n)), &turns([n])])
}

/// The end of the rod on `j` moves on a sphere.
pub(crate) fn distance(p: &Pair<'_>, [head, tail]: [V; 2]) -> Freedom {
    let tail = p.point(J, tail);
    let along = (tail - p.point(I, head)).normalize();
    free(tail, &[&slides(normals(&along)), &turns(any())])
}

/// The ball moves on a circle about the hinge.
pub(crate) fn revolute_spherical(p: &Pair<'_>, [hinge, axis, ball]: [V; 3]) -> Freedom {
    let ball = p.point(J, ball);
    let swing = p.axis(I, axis).cross(&(ball - p.point(I, hinge)));
    free(ball, &[&slides([swing]), &turns(any())])
}

pub(crate) fn revolute_revolute(p: &Pair<'_>, [first, second, axis]: [V; 3]) -> Freedom {
    let second = p.point(J, second);
    let a = p.axis(I, axis);
    let swing = a.cross(&(second - p.point(I, first)));
    free(second, &[&slides([swing]), &turns([a])])
}

pub(crate) fn point_on_line(p: &Pair<'_>, [point, axis]: [V; 2]) -> Freedom {
    let a = [p.axis(I, axis)];
    free(p.point(J, point), &[&slides(a), &turns(any())])
}

pub(crate) fn point_on_plane(p: &Pair<'_>, [point, normal]: [V; 2]) -> Freedom {
    let n = p.axis(I, normal);
    free(p.point(J, point), &[&slides(normals(&n)), &turns(any())])
}

/// About every axis in the plane that halves the angle between the shafts.
pub(crate) fn constant_velocity(p: &Pair<'_>, [point, axis_i, axis_j]: [V; 3]) -> Freedom {
    let bisector = p.axis(I, axis_i) + p.axis(J, axis_j);
    let twists = turns(normals(&bisector.normalize()));
    Freedom {
        sharpness: 0.5 * bisector.norm(),
        ..free(p.point(J, point), &[&twists])
    }
}

/// Along the axis and about it, the pitch for every turn.
pub(crate) fn screw(p: &Pair<'_>, [point, axis]: [V; 2], pitch: f64) -> Freedom {
    let a = p.axis(I, axis);
    free(p.point(J, point), &[&[twist(pitch / TAU * a, a)]])
}

/// About either axis, and along all directions. The point does not matter.
pub(crate) fn perpendicular1(p: &Pair<'_>, [axis_i, axis_j]: [V; 2]) -> Freedom {
    let axes = [p.axis(I, axis_i), p.axis(J, axis_j)];
    free(Vector3::zeros(), &[&slides(any()), &turns(axes)])
}

pub(crate) fn perpendicular2(p: &Pair<'_>, [axis, _, tail]: [V; 3]) -> Freedom {
    let n = p.axis(I, axis);
    free(p.point(J, tail), &[&slides(normals(&n)), &turns(any())])
}

pub(crate) fn parallel1(p: &Pair<'_>, [axis_i, _]: [V; 2]) -> Freedom {
    let a = [p.axis(I, axis_i)];
    free(Vector3::zeros(), &[&slides(any()), &turns(a)])
}

pub(crate) fn parallel2(p: &Pair<'_>, [axis, _, tail]: [V; 3]) -> Freedom {
    let a = [p.axis(I, axis)];
    free(p.point(J, tail), &[&slides(a), &turns(any())])
}

/// The angle is that of a pointer on `j`, seen along the axis of `i`: it stays while `j` turns
/// about the pointer, or about a line that is perpendicular to both the axis and the pointer.
pub(crate) fn angle_driver(p: &Pair<'_>, [axis]: [V; 1]) -> Freedom {
    let [normal, _] = p.scene.normals(&Vector3::from(axis).normalize());
    let pointer = p.axis(J, normal.into());
    let level = p.axis(I, axis).cross(&pointer);
    let twists = turns([pointer, level.normalize()]);
    Freedom {
        sharpness: level.norm(),
        ..free(Vector3::zeros(), &[&slides(any()), &twists])
    }
}

pub(crate) fn orientation_driver(_: &Pair<'_>, [_]: [V; 1]) -> Freedom {
    free(Vector3::zeros(), &[&slides(any())])
}

//! Every joint and driver of the library with random data, and its definition in global axes,
//! written down once more.

use core::f64::consts::TAU;

use nalgebra::{Matrix3, Rotation3, Vector3};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::assembler::Assembler;
use crate::bodies::BodyId;
use crate::joints::{Joint, normals};
use crate::laws::Motion;

/// Random points (m), unit axes and numbers in global axes of the reference configuration.
#[derive(Clone, Copy, Debug)]
pub(super) struct Data {
    pub(super) head: Vector3<f64>,
    pub(super) tail: Vector3<f64>,
    pub(super) a: Vector3<f64>,
    pub(super) b: Vector3<f64>,
    pub(super) number: f64,
}

impl Data {
    pub(super) fn random(rng: &mut ChaCha8Rng) -> Self {
        let mut vector = || Vector3::from_fn(|_, _| rng.random_range(-1.0..1.0));
        Self {
            head: vector(),
            tail: vector() + Vector3::new(0.0, 0.0, 2.5),
            a: vector().normalize(),
            b: vector().normalize(),
            number: rng.random_range(0.3..2.0),
        }
    }
}

/// The displacement of a body since the reference configuration: `R X + t` for points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moved {
    pub(super) turn: Matrix3<f64>,
    pub(super) shift: Vector3<f64>,
}

impl Moved {
    pub(super) fn p(&self, point: Vector3<f64>) -> Vector3<f64> {
        self.turn * point + self.shift
    }
}

type Place = fn(&Assembler, [BodyId; 3], &Data) -> Joint;
type Define = fn(&[Moved; 3], &Data, f64) -> Vec<f64>;

/// A joint: how many of the three bodies it takes, how it is built, and what its rows are.
pub(super) struct Entry {
    pub(super) name: &'static str,
    pub(super) bodies: usize,
    pub(super) place: Place,
    /// `Phi` at a time.
    pub(super) define: Define,
}

/// The law of all drivers, chosen so that it vanishes at the time zero.
pub(super) fn motion(offset: f64) -> Motion {
    Motion::sine(offset, 0.3, 2.0, 0.0)
}

fn sine(time: f64) -> f64 {
    0.3 * (2.0 * time).sin()
}

fn two([i, j, _]: [BodyId; 3]) -> [BodyId; 2] {
    [i, j]
}

fn coincide([i, j, _]: &[Moved; 3], point: Vector3<f64>) -> Vec<f64> {
    (j.p(point) - i.p(point)).iter().copied().collect()
}

/// `n1 . b`, `n2 . b` of the normals of `a` on `i`, `b` on `j`.
fn parallel([i, j, _]: &[Moved; 3], a: Vector3<f64>, b: Vector3<f64>) -> Vec<f64> {
    normals(&a).map(|n| (i.turn * n).dot(&(j.turn * b))).into()
}

/// `v . d` with `v` on `i`.
fn along(i: &Moved, j: &Moved, v: Vector3<f64>, head: Vector3<f64>, tail: Vector3<f64>) -> f64 {
    (i.turn * v).dot(&(j.p(tail) - i.p(head)))
}

fn beside([i, j, _]: &[Moved; 3], a: Vector3<f64>, point: Vector3<f64>) -> Vec<f64> {
    normals(&a).map(|n| along(i, j, n, point, point)).into()
}

/// The angle of `j` against `i`: from the relative rotation, of which `n1` is the first column.
fn angle(i: &Moved, j: &Moved, a: Vector3<f64>) -> f64 {
    let [n1, n2] = normals(&a);
    let frame = Matrix3::from_columns(&[n1, n2, a]);
    let relative = frame.transpose() * i.turn.transpose() * j.turn * frame;
    relative[(1, 0)].atan2(relative[(0, 0)])
}

fn cylinder(at: &[Moved; 3], d: &Data) -> Vec<f64> {
    [parallel(at, d.a, d.a), beside(at, d.a, d.head)].concat()
}

fn kept(at: &[Moved; 3], d: &Data) -> Vec<f64> {
    let gap = d.tail - d.head;
    let now = at[1].p(d.tail) - at[0].p(d.head);
    vec![
        along(&at[0], &at[1], d.a, d.head, d.tail) - d.a.dot(&gap),
        now.dot(&now) - gap.dot(&gap),
    ]
}

/// The normals of `a`, turned as little as possible until `a` is at `b`.
fn carried(d: &Data) -> [Vector3<f64>; 2] {
    let least = Rotation3::rotation_between(&d.a, &d.b).expect("not opposite");
    normals(&d.a).map(|n| least * n)
}

macro_rules! entry {
    ($name:literal, $bodies:literal, |$s:ident, $b:ident, $d:ident| $place:expr, |$at:ident, $e:ident, $t:pat_param| $define:expr) => {
        Entry {
            name: $name,
            bodies: $bodies,
            place: |$s, $b, $d| $place,
            define: |$at, $e, $t| $define,
        }
    };
}

/// All joints and drivers.
#[rustfmt::skip]
pub(super) fn catalogue() -> Vec<Entry> {
    vec![
        entry!("Spherical", 2, |s, b, d| Joint::spherical(s, two(b), d.head.into()),
            |at, d, _| coincide(at, d.head)),
        entry!("Revolute", 2, |s, b, d| Joint::revolute(s, two(b), d.head.into(), d.a.into()),
            |at, d, _| [coincide(at, d.head), parallel(at, d.a, d.a)].concat()),
        entry!("Universal", 2, |s, b, d| Joint::universal(s, two(b), d.head.into(), d.a.into(), d.b.into()),
            |at, d, _| [coincide(at, d.head), vec![(at[0].turn * d.a).dot(&(at[1].turn * d.b))]].concat()),
        entry!("Cylindrical", 2, |s, b, d| Joint::cylindrical(s, two(b), d.head.into(), d.a.into()),
            |at, d, _| cylinder(at, d)),
        entry!("Prismatic", 2, |s, b, d| Joint::prismatic(s, two(b), d.head.into(), d.a.into()),
            |at, d, _| {
                let [n1, n2] = normals(&d.a);
                [cylinder(at, d), vec![(at[0].turn * n1).dot(&(at[1].turn * n2))]].concat()
            }),
        entry!("Fixed", 2, |s, b, d| Joint::fixed(s, two(b), d.head.into()),
            |at, d, _| {
                let relative = at[0].turn.transpose() * at[1].turn;
                let axes = vec![relative[(1, 0)], relative[(2, 0)], relative[(1, 2)]];
                [coincide(at, d.head), axes].concat()
            }),
        entry!("Planar", 2, |s, b, d| Joint::planar(s, two(b), d.head.into(), d.a.into()),
            |at, d, _| [parallel(at, d.a, d.a), vec![along(&at[0], &at[1], d.a, d.head, d.head)]].concat()),
        entry!("Distance", 2, |s, b, d| Joint::distance(s, two(b), d.head.into(), d.tail.into(), None),
            |at, d, _| vec![kept(at, d)[1]]),
        entry!("Distance with a length", 2,
            |s, b, d| Joint::distance(s, two(b), d.head.into(), d.tail.into(), Some(d.number)),
            |at, d, _| vec![(at[1].p(d.tail) - at[0].p(d.head)).norm_squared() - d.number * d.number]),
        entry!("RevoluteSpherical", 2,
            |s, b, d| Joint::revolute_spherical(s, two(b), d.head.into(), d.a.into(), d.tail.into()),
            |at, d, _| kept(at, d)),
        entry!("RevoluteRevolute", 2,
            |s, b, d| Joint::revolute_revolute(s, two(b), d.head.into(), d.tail.into(), d.a.into()),
            |at, d, _| [parallel(at, d.a, d.a), kept(at, d)].concat()),
        entry!("PointOnLine", 2, |s, b, d| Joint::point_on_line(s, two(b), d.head.into(), d.a.into()),
            |at, d, _| beside(at, d.a, d.head)),
        entry!("PointOnPlane", 2, |s, b, d| Joint::point_on_plane(s, two(b), d.head.into(), d.a.into()),
            |at, d, _| vec![along(&at[0], &at[1], d.a, d.head, d.head)]),
        entry!("ConstantVelocity", 2,
            |s, b, d| Joint::constant_velocity(s, two(b), d.head.into(), d.a.into(), d.b.into()),
            |at, d, _| {
                let ([n_i, b_i], [n_j, b_j]) = (normals(&d.a), carried(d));
                let relative = at[0].turn.transpose() * at[1].turn;
                [coincide(at, d.head), vec![b_i.dot(&(relative * n_j)) - n_i.dot(&(relative * b_j))]].concat()
            }),
        entry!("Screw", 2, |s, b, d| Joint::screw(s, two(b), d.head.into(), d.a.into(), d.number),
            |at, d, _| {
                let advance = along(&at[0], &at[1], d.a, d.head, d.head);
                [cylinder(at, d), vec![advance - d.number * angle(&at[0], &at[1], d.a) / TAU]].concat()
            }),
        entry!("Gear", 3, |s, b, d| Joint::gear(s, b, d.a.into(), d.b.into(), -d.number),
            |at, d, _| vec![angle(&at[2], &at[1], d.b) + d.number * angle(&at[2], &at[0], d.a)]),
        entry!("RackAndPinion", 3,
            |s, b, d| {
                let points = [d.tail.into(), d.head.into()];
                Joint::rack_and_pinion(s, b, d.a.into(), points, d.b.into(), d.number)
            },
            |at, d, _| {
                let far = (at[2].turn * d.b).dot(&(at[1].p(d.head) - at[0].p(d.tail)));
                vec![far - d.b.dot(&(d.head - d.tail)) - d.number * angle(&at[2], &at[0], d.a)]
            }),
        entry!("Perpendicular1", 2, |s, b, d| Joint::perpendicular1(s, two(b), d.a.into(), d.b.into()),
            |at, d, _| vec![(at[0].turn * d.a).dot(&(at[1].turn * d.b))]),
        entry!("Perpendicular2", 2,
            |s, b, d| Joint::perpendicular2(s, two(b), d.a.into(), d.head.into(), d.tail.into()),
            |at, d, _| vec![along(&at[0], &at[1], d.a, d.head, d.tail)]),
        entry!("Parallel1", 2, |s, b, d| Joint::parallel1(s, two(b), d.a.into(), d.b.into()),
            |at, d, _| parallel(at, d.a, d.b)),
        entry!("Parallel2", 2,
            |s, b, d| Joint::parallel2(s, two(b), d.a.into(), d.head.into(), d.tail.into()),
            |at, d, _| normals(&d.a).map(|n| along(&at[0], &at[1], n, d.head, d.tail)).into()),
        entry!("AngleDriver", 2, |s, b, d| Joint::angle_driver(s, two(b), d.a.into(), motion(0.0)),
            |at, d, t| vec![angle(&at[0], &at[1], d.a) - sine(t)]),
        entry!("DistanceDriver", 2,
            |s, b, d| {
                let law = motion((d.tail - d.head).norm());
                Joint::distance_driver(s, two(b), d.head.into(), d.tail.into(), law)
            },
            |at, d, t| vec![(at[1].p(d.tail) - at[0].p(d.head)).norm() - (d.tail - d.head).norm() - sine(t)]),
        entry!("DisplacementDriver", 2,
            |s, b, d| Joint::displacement_driver(s, two(b), d.head.into(), d.a.into(), motion(0.0)),
            |at, d, t| vec![along(&at[0], &at[1], d.a, d.head, d.head) - sine(t)]),
        entry!("OrientationDriver", 2,
            |s, b, d| Joint::orientation_driver(s, two(b), d.a.into(), motion(0.0)),
            |at, d, t| [parallel(at, d.a, d.a), vec![angle(&at[0], &at[1], d.a) - sine(t)]].concat()),
    ]
}

/// Joints that hold in the reference configuration for any data; the others have to be corrected
/// onto their rows.
pub(super) fn holds_as_described(name: &str) -> bool {
    const OTHERS: [&str; 6] = [
        "Universal",
        "Distance with a length",
        "Perpendicular1",
        "Perpendicular2",
        "Parallel1",
        "Parallel2",
    ];
    !OTHERS.contains(&name)
}

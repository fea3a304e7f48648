//! Gears and racks: pitch circles and teeth, from the hinges that the gears turn on and from the
//! ratio of each pair.

use std::f64::consts::{FRAC_PI_2, TAU};

use holonom::mechanism::{BodyKind, ElementPlace, JointInfo};
use holonom::nalgebra::{Unit, UnitQuaternion, Vector3};
use holonom::{BodyHandle, Mechanism, Real, View};

use crate::page::{Marker, Rack, Wheel};
use crate::subject::Subject;

/// Axes are parallel where the cosine of their angle is beyond this.
const PARALLEL: f64 = 0.999;
/// Radii and places that differ by less than this part of a radius are those of one wheel.
const SAME: f64 = 0.02;
/// Teeth of the smaller wheel of a pair, at least and at most.
const TEETH: [u32; 2] = [12, 36];
/// Teeth of a wheel at most: more are not seen apart.
const MOST: f64 = 400.0;

/// The ratio of a `Gear` or the radius (m) of a `RackAndPinion`, with its joint.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Proportion {
    joint: usize,
    number: f64,
}

/// The proportions of all gears, from their rows of the Jacobian: the report holds no numbers. A
/// joint whose row was left out has none.
pub(crate) fn proportions<S: Real, M: Mechanism>(view: &View<'_, S, M>) -> Vec<Proportion> {
    let joints = M::REPORT.joints.iter().enumerate();
    let gears = joints.filter(|(_, info)| ["Gear", "RackAndPinion"].contains(&info.kind));
    let found = gears.filter_map(|(joint, info)| {
        let row = Row::<S, M>::new(view, joint, info)?;
        let number = if info.kind == "Gear" {
            row.ratio()
        } else {
            row.radius()
        };
        number.is_finite().then_some(Proportion { joint, number })
    });
    found.collect()
}

/// The row of a joint in the Jacobian.
struct Row<'a, S: Real, M: Mechanism> {
    view: &'a View<'a, S, M>,
    jacobian: M::Jacobian<S>,
    joint: usize,
    info: &'a JointInfo,
}

impl<'a, S: Real, M: Mechanism> Row<'a, S, M> {
    fn new(view: &'a View<'a, S, M>, joint: usize, info: &'a JointInfo) -> Option<Self> {
        (info.rows == 1 && info.bodies.len() == 3).then(|| Self {
            view,
            jacobian: M::jacobian(view.constants(), view.time(), view.state()),
            joint,
            info,
        })
    }

    /// The part of the row along a marker of its body: of the angular velocity (principal axes), or
    /// of the velocity (global axes). `None` on the ground.
    fn along(&self, place: usize, name: &str, is_turn: bool) -> Option<f64> {
        use holonom::state::Array as _;

        let body = self.info.bodies[place]?;
        let block = M::REPORT.blocks.iter().find(|block| {
            block.body == body && (block.row..block.row + block.rows).contains(&self.info.row)
        })?;
        let first = block.offset + (self.info.row - block.row) * block.columns;
        let is_rigid = M::REPORT.bodies[body].kind == BodyKind::Rigid;
        let first = first + if is_turn && is_rigid { 3 } else { 0 };
        let values = self.jacobian.as_slice().get(first..first + 3)?;
        let marker = self.marker(place, name)?;
        let direction: [S; 3] = if is_turn {
            M::marker(self.view.constants(), marker)
        } else {
            self.view.marker(marker).into()
        };
        let products = values.iter().zip(direction);
        Some(products.map(|(a, b)| a.to_f64() * b.to_f64()).sum())
    }

    fn marker(&self, place: usize, name: &str) -> Option<usize> {
        let of = ElementPlace::Joint(self.joint);
        let mut markers = M::REPORT.markers.iter();
        markers.position(|marker| marker.of == of && marker.place == place && marker.name == name)
    }

    /// Angle of the second gear over that of the first.
    fn ratio(&self) -> f64 {
        let first = self.along(0, "axis_i", true);
        let second = self.along(1, "axis_j", true);
        let cosine = || {
            let axis = |name| Some(self.view.marker(self.marker(2, name)?).map(Real::to_f64));
            Some(axis("axis_i")?.dot(&axis("axis_j")?))
        };
        let ratio = || match (first, second) {
            (Some(first), Some(second)) => Some(-first / second),
            // A gear on the ground turns against the carrier as that turns back.
            (None, Some(second)) => {
                Some((1.0 + self.along(2, "axis_j", true)? / second) / cosine()?)
            }
            (Some(first), None) => Some(cosine()? / (1.0 + self.along(2, "axis_i", true)? / first)),
            (None, None) => None,
        };
        ratio().unwrap_or(f64::NAN)
    }

    /// The way of the rack (m) over the angle of the pinion, whose hub may turn about its centre of
    /// mass.
    fn radius(&self) -> f64 {
        let radius = || {
            let pinion = self.along(0, "axis", true)?;
            let rack = self.along(1, "slide", false);
            let rack = rack.or_else(|| Some(-self.along(0, "slide", false)?))?;
            let marker = |name| Some(self.view.marker(self.marker(0, name)?).map(Real::to_f64));
            let centre = self
                .view
                .pose(BodyHandle::new(self.info.bodies[0]?))
                .position;
            let arm = marker("hub")? - centre.map(Real::to_f64);
            let lever = arm.cross(&marker("slide")?).dot(&marker("axis")?);
            Some(-pinion / rack - lever)
        };
        radius().unwrap_or(f64::NAN)
    }
}

/// Wheels and racks, and a place where each pair meets, on its carrier.
#[derive(Clone, Debug, Default)]
pub(crate) struct Gearing {
    pub(crate) wheels: Vec<Wheel>,
    pub(crate) racks: Vec<Rack>,
    pub(crate) anchors: Vec<Marker>,
}

/// A gear in the first frame: its body, the centre (m) and its axis, global.
#[derive(Clone, Copy)]
struct Seat {
    body: Option<usize>,
    centre: Vector3<f64>,
    axis: Vector3<f64>,
}

/// A wheel that is asked for: where its pitch circle meets the other one, from the centre.
struct Wanted {
    seat: Seat,
    radius: f64,
    towards: Vector3<f64>,
    is_ring: bool,
}

/// What meets, by the places of `wheels`, at a point.
#[derive(Clone, Copy)]
struct Tooth {
    wheel: usize,
    /// How far the meeting point is behind a tooth, in teeth.
    phase: f64,
}

impl Gearing {
    pub(crate) fn new(subject: &Subject<'_>, proportions: &[Proportion]) -> Self {
        let mut all = Self::default();
        for proportion in proportions {
            let place = |place, axis| seat(subject, proportion.joint, place, axis);
            if subject.elements[proportion.joint].kind == "Gear" {
                if let (Some(first), Some(second)) = (place(0, "axis_i"), place(1, "axis_j")) {
                    all.pair(subject, *proportion, first, second);
                }
            } else if let Some(pinion) = place(0, "axis") {
                all.rack(subject, *proportion, pinion);
            }
        }
        all
    }

    fn pair(&mut self, subject: &Subject<'_>, proportion: Proportion, first: Seat, second: Seat) {
        let [a, b] = meeting(proportion.number, first, second, subject.size());
        let ratio = a.radius / b.radius;
        let is_internal = a.is_ring || b.is_ring;
        let place = a.seat.centre + a.radius * a.towards;
        let known = [self.known(subject, &a), self.known(subject, &b)];
        let teeth = match known.map(|known| known.map(|place| f64::from(self.wheels[place].teeth)))
        {
            [Some(first), _] => [first, (first / ratio).round()],
            [None, Some(second)] => [(second * ratio).round(), second],
            [None, None] => teeth(ratio),
        };
        let joint = proportion.joint;
        // A tooth of one meets a gap of the other.
        let opposite = |phase: f64| 0.5 + if is_internal { phase } else { -phase };
        match known {
            [None, Some(_)] => {
                let tooth = self.wheel(subject, joint, &b, teeth[1], 0.0);
                self.wheel(subject, joint, &a, teeth[0], opposite(tooth.phase));
            }
            _ => {
                let tooth = self.wheel(subject, joint, &a, teeth[0], 0.0);
                self.wheel(subject, joint, &b, teeth[1], opposite(tooth.phase));
            }
        }
        self.anchor(subject, joint, place);
    }

    fn rack(&mut self, subject: &Subject<'_>, proportion: Proportion, pinion: Seat) {
        let (joint, radius) = (proportion.joint, proportion.number);
        let element = &subject.elements[joint];
        let (body, slide) = (element.bodies[1], subject.axis(joint, 2, "slide"));
        let Some(slide) = slide.filter(|_| radius != 0.0) else {
            return;
        };
        // Where the pinion moves along the slide as fast as the rack.
        let Some(towards) = (radius * slide.cross(&pinion.axis)).try_normalize(0.0) else {
            return;
        };
        let wanted = Wanted {
            seat: pinion,
            radius: radius.abs(),
            towards,
            is_ring: false,
        };
        let tooth = self.wheel(subject, joint, &wanted, 18.0, 0.0);
        let pitch = TAU * radius.abs() / f64::from(self.wheels[tooth.wheel].teeth);
        let meeting = pinion.centre + radius.abs() * towards;
        let along = pinion.axis.cross(&towards);
        let at = meeting + (0.5 - tooth.phase) * pitch * along;
        let [at, along, tips] = [
            subject.point_on(body, at),
            subject.direction_on(body, along),
            subject.direction_on(body, -towards),
        ];
        // As long as the pinion runs on it.
        let hub = subject.point_on(pinion.body, pinion.centre);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for frame in 0..subject.times.len() {
            let from = subject.place(frame, body, at.into());
            let way = subject.direction(frame, body, along.into());
            let far = (subject.place(frame, pinion.body, hub.into()) - from).dot(&way);
            (low, high) = (low.min(far), high.max(far));
        }
        self.racks.push(Rack {
            element: joint,
            body,
            at: at.into(),
            along: along.into(),
            tips: tips.into(),
            pitch,
            teeth: [low - 1.2 * radius.abs(), high + 1.2 * radius.abs()]
                .map(|far| (far / pitch).round() as i32),
        });
        self.anchor(subject, joint, meeting);
    }

    /// The wheel that is there already, as for the planet of two pairs.
    fn known(&self, subject: &Subject<'_>, wanted: &Wanted) -> Option<usize> {
        self.wheels.iter().position(|wheel| {
            let centre = subject.place(0, wheel.body, wheel.centre);
            let off = (centre - wanted.seat.centre)
                .norm()
                .max((wheel.radius - wanted.radius).abs());
            wheel.body == wanted.seat.body && off < SAME * wanted.radius
        })
    }

    /// A wheel whose meeting point is behind a tooth by a phase, unless it is there already.
    fn wheel(
        &mut self,
        subject: &Subject<'_>,
        joint: usize,
        wanted: &Wanted,
        teeth: f64,
        phase: f64,
    ) -> Tooth {
        let Seat { body, centre, axis } = wanted.seat;
        if let Some(place) = self.known(subject, wanted) {
            let wheel = &mut self.wheels[place];
            wheel.elements.push(joint);
            let tooth = subject.direction(0, body, wheel.tooth);
            let sine = tooth.cross(&wanted.towards).dot(&axis);
            let angle = sine.atan2(tooth.dot(&wanted.towards));
            return Tooth {
                wheel: place,
                phase: angle * f64::from(wheel.teeth) / TAU,
            };
        }
        let back =
            UnitQuaternion::from_axis_angle(&Unit::new_normalize(axis), -phase * TAU / teeth);
        self.wheels.push(Wheel {
            elements: vec![joint],
            body,
            centre: subject.point_on(body, centre).into(),
            axis: subject.direction_on(body, axis).into(),
            tooth: subject.direction_on(body, back * wanted.towards).into(),
            radius: wanted.radius,
            teeth: teeth as u32,
            is_ring: wanted.is_ring,
        });
        Tooth {
            wheel: self.wheels.len() - 1,
            phase,
        }
    }

    fn anchor(&mut self, subject: &Subject<'_>, joint: usize, place: Vector3<f64>) {
        let carrier = subject.elements[joint].bodies[2];
        self.anchors.push(Marker {
            element: joint,
            place: 2,
            body: carrier,
            name: "anchor",
            kind: "anchor",
            at: subject.point_on(carrier, place).into(),
        });
    }
}

/// Where a gear turns: the point of the joint that it turns by on the carrier, or its centre of
/// mass.
fn seat(subject: &Subject<'_>, joint: usize, place: usize, axis: &str) -> Option<Seat> {
    let bodies = subject.elements[joint].bodies;
    let (body, axis) = (bodies[place], subject.axis(joint, 2, axis)?);
    let hinge = subject.hinge([body, bodies[2]], axis);
    let centre = match (hinge, body) {
        (Some(marker), _) => subject.place(0, marker.body, marker.at),
        (None, Some(body)) => subject.place(0, Some(body), [0.0; 3]),
        (None, None) => return None,
    };
    Some(Seat { body, centre, axis })
}

/// Pitch circles of a pair, from its ratio and the distance of its axes.
fn meeting(ratio: f64, first: Seat, mut second: Seat, size: f64) -> [Wanted; 2] {
    let cosine = first.axis.dot(&second.axis);
    let share = ratio.abs().max(1e-9);
    let wanted = |seat, radius, towards, is_ring| Wanted {
        seat,
        radius,
        towards,
        is_ring,
    };
    if cosine.abs() < PARALLEL {
        return bevel(share, first, second, size);
    }
    // In one plane.
    second.centre -= first.axis * first.axis.dot(&(second.centre - first.centre));
    let apart = second.centre - first.centre;
    let far = apart.norm();
    let is_internal = ratio * cosine > 0.0;
    if far < 1e-6 * size {
        // On one axis, by gears that nothing is said of: beside each other.
        let aside = across(first.axis);
        second.centre += 0.06 * size * first.axis;
        let largest = 0.14 * size / share.max(1.0);
        return [
            wanted(first, largest * share, aside, false),
            wanted(second, largest, aside, false),
        ];
    }
    let towards = apart / far;
    if !is_internal {
        let radius = far / (1.0 + share);
        return [
            wanted(first, share * radius, towards, false),
            wanted(second, radius, -towards, false),
        ];
    }
    if (share - 1.0).abs() < 0.05 {
        // As by a belt.
        return [
            wanted(first, 0.3 * far, towards, false),
            wanted(second, 0.3 * far, -towards, false),
        ];
    }
    let radius = far / (share - 1.0).abs();
    // The ring reaches beyond the centre of the wheel in it.
    let towards = if share > 1.0 { towards } else { -towards };
    [
        wanted(first, share * radius, towards, share > 1.0),
        wanted(second, radius, towards, share < 1.0),
    ]
}

/// Wheels on two cones whose common apex is where the axes meet, or come nearest.
fn bevel(share: f64, first: Seat, second: Seat, size: f64) -> [Wanted; 2] {
    let apex = nearest(first, second);
    let from_apex = |seat: Seat| {
        let far = seat.axis.dot(&(seat.centre - apex));
        (seat.axis * if far < 0.0 { -1.0 } else { 1.0 }, far.abs())
    };
    let ((a, far_a), (b, far_b)) = (from_apex(first), from_apex(second));
    let angle = a.angle(&b);
    // The sines of the angles of the cones are as the radii.
    let cone = (angle.sin()).atan2(1.0 / share + angle.cos());
    let lengths = [far_a / cone.cos(), far_b / (angle - cone).cos()];
    let given = lengths.into_iter().filter(|length| *length > 0.02 * size);
    let length = given.fold(f64::INFINITY, f64::min);
    let length = if length.is_finite() {
        length
    } else {
        0.2 * size
    };
    let wheel = |seat: Seat, own: Vector3<f64>, other: Vector3<f64>, cone: f64| Wanted {
        seat: Seat {
            centre: apex + own * (length * cone.cos()),
            ..seat
        },
        radius: length * cone.sin(),
        towards: (other - own * own.dot(&other)).normalize(),
        is_ring: false,
    };
    [
        wheel(first, a, b, cone),
        wheel(second, b, a, (angle - cone).clamp(0.0, FRAC_PI_2)),
    ]
}

/// The point half way between two lines where they come nearest.
fn nearest(first: Seat, second: Seat) -> Vector3<f64> {
    let (a, b, off) = (first.axis, second.axis, second.centre - first.centre);
    let cosine = a.dot(&b);
    let sine = 1.0 - cosine * cosine;
    let s = (off.dot(&a) - cosine * off.dot(&b)) / sine;
    let t = (cosine * off.dot(&a) - off.dot(&b)) / sine;
    0.5 * (first.centre + s * a + second.centre + t * b)
}

/// A unit vector across another.
fn across(axis: Vector3<f64>) -> Vector3<f64> {
    let other = if axis.x.abs() < 0.9 {
        Vector3::x()
    } else {
        Vector3::y()
    };
    axis.cross(&other).normalize()
}

/// Few teeth whose numbers are as the radii.
fn teeth(ratio: f64) -> [f64; 2] {
    let large = ratio.max(1.0 / ratio);
    let error = |small: f64| ((small * large).round() / (small * large) - 1.0).abs();
    let [least, most] = TEETH;
    let counts = (least..=most).map(f64::from);
    let counts = counts.filter(|small| small * large <= MOST || *small <= f64::from(least));
    let small = counts.fold(f64::from(least), |best, small| {
        if error(small) < error(best) - 1e-9 {
            small
        } else {
            best
        }
    });
    let large = (small * large).round().min(MOST);
    if ratio > 1.0 {
        [large, small]
    } else {
        [small, large]
    }
}

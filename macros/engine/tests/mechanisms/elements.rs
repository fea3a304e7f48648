//! Joints and forces of the library between given bodies, such that the reference configuration
//! satisfies them.

use crate::generator::Generator;

pub(crate) type Bodies = Vec<Option<usize>>;
type Entries = Vec<(String, String)>;

/// Which joints are wanted.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Wanted {
    /// What carries a body.
    Tree,
    /// What closes a loop, or drives.
    Loop,
    /// What fits in a plane.
    Planar,
    /// What has equations of velocities.
    Rolling,
}

const TREE: [&str; 12] = [
    "Revolute",
    "Revolute",
    "Revolute",
    "Spherical",
    "Universal",
    "Cylindrical",
    "Prismatic",
    "Planar",
    "ConstantVelocity",
    "Screw",
    "Fixed",
    "RevoluteRevolute",
];
const LOOP: [&str; 23] = [
    "Revolute",
    "Spherical",
    "Universal",
    "Cylindrical",
    "Distance",
    "Distance",
    "RevoluteSpherical",
    "RevoluteRevolute",
    "PointOnLine",
    "PointOnPlane",
    "Perpendicular1",
    "Perpendicular2",
    "Parallel1",
    "Parallel2",
    "AngleDriver",
    "DistanceDriver",
    "DisplacementDriver",
    "OrientationDriver",
    "Screw",
    "KnifeEdge",
    "RollingWheel",
    "RollingBall",
    "RollingBallInBowl",
];
const PLANAR: [&str; 6] = [
    "Revolute",
    "Revolute",
    "Prismatic",
    "RevoluteRevolute",
    "AngleDriver",
    "Distance",
];
const ROLLING: [&str; 5] = [
    "KnifeEdge",
    "RollingWheel",
    "RollingWheel",
    "RollingBall",
    "RollingBall",
];
/// For a particle as the second body.
const PARTICLE: [&str; 8] = [
    "Spherical",
    "Distance",
    "Distance",
    "PointOnLine",
    "PointOnPlane",
    "DistanceDriver",
    "DisplacementDriver",
    "Perpendicular2",
];

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn length(a: [f64; 3]) -> f64 {
    a.iter().map(|x| x * x).sum::<f64>().sqrt()
}

impl Generator {
    /// A direction perpendicular to another.
    fn across(&mut self, axis: [f64; 3]) -> [f64; 3] {
        loop {
            let other = if self.dice.below(2) == 0 {
                self.dice.unit()
            } else {
                [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]][self.dice.below(3)]
            };
            let across = cross(axis, other);
            if length(across) > 0.2 * length(axis) {
                return across;
            }
        }
    }

    /// Where a body is, if it is a particle, else anywhere, at a distance from another point.
    fn anchor(&mut self, body: Option<usize>, apart: Option<[f64; 3]>) -> [f64; 3] {
        if self.is_particle(body) {
            return self.pose(body).position.map(|x| x.re);
        }
        loop {
            let at = self.point();
            if apart.is_none_or(|other| length(minus(at, other)) > 0.2) {
                return at;
            }
        }
    }

    /// A point as it is written, for bodies of which some may be particles.
    fn at(&mut self, at: [f64; 3], bodies: &[Option<usize>], on: Option<usize>) -> String {
        match self.placed(on).filter(|placed| placed.is_particle) {
            Some(placed) => placed.position.clone(),
            None => self.written_point(at, bodies),
        }
    }

    fn axis(
        &mut self,
        key: &str,
        direction: [f64; 3],
        bodies: &[Option<usize>],
    ) -> (String, String) {
        (key.into(), self.written_vector(direction, bodies))
    }

    /// Type, bodies and entries of a joint.
    pub(crate) fn joint(
        &mut self,
        wanted: Wanted,
        pair: [Option<usize>; 2],
    ) -> Option<(&'static str, Bodies, Entries)> {
        let pair = if self.is_particle(pair[0]) {
            [pair[1], pair[0]]
        } else {
            pair
        };
        let particles = pair.iter().filter(|&&body| self.is_particle(body)).count();
        let names: &[&str] = match (particles, wanted) {
            (2, _) => &["Distance"],
            (1, _) => &PARTICLE,
            (_, Wanted::Tree) => &TREE,
            (_, Wanted::Loop) => &LOOP,
            (_, Wanted::Planar) => &PLANAR,
            (_, Wanted::Rolling) => &ROLLING,
        };
        let ty = names[self.dice.below(names.len())];
        let [i, j] = pair;
        let direction = self.direction();
        let mut entries: Entries = Vec::new();
        match ty {
            "Distance" | "DistanceDriver" | "Perpendicular2" | "Parallel2"
            | "RevoluteSpherical" | "RevoluteRevolute" => {
                let (one, other) = match ty {
                    "RevoluteSpherical" => ("hinge", "ball"),
                    "RevoluteRevolute" => ("first", "second"),
                    _ => ("head", "tail"),
                };
                let tail = self.anchor(j, None);
                let head = self.anchor(i, Some(tail));
                let arm = minus(tail, head);
                if length(arm) < 0.1 {
                    return None;
                }
                let written = self.at(head, &pair, i);
                entries.push((one.into(), written));
                let written = self.at(tail, &pair, j);
                entries.push((other.into(), written));
                match ty {
                    "Perpendicular2" => {
                        let across = self.across(arm);
                        entries.push(self.axis("axis", across, &pair));
                    }
                    "Parallel2" => entries.push(self.axis("axis", arm, &pair)),
                    "RevoluteSpherical" | "RevoluteRevolute" => {
                        entries.push(self.axis("axis", direction, &pair))
                    }
                    "DistanceDriver" => {
                        let law = format!("{:?} + {}", length(arm), self.law(&[]));
                        entries.push(("motion".into(), law));
                    }
                    _ if self.dice.below(2) == 0 => {
                        let written = self.number(length(arm));
                        entries.push(("length".into(), written));
                    }
                    _ => {}
                }
            }
            "Perpendicular1" | "Parallel1" | "Universal" | "ConstantVelocity" => {
                let other = match ty {
                    "Parallel1" => direction.map(|x| 2.0 * x),
                    "ConstantVelocity" => {
                        let by = self.dice.unit::<3>();
                        [0, 1, 2].map(|k| direction[k] / length(direction) + 0.5 * by[k])
                    }
                    _ => self.across(direction),
                };
                entries.push(self.axis("axis_i", direction, &pair));
                entries.push(self.axis("axis_j", other, &pair));
                if matches!(ty, "Universal" | "ConstantVelocity") {
                    let at = self.point();
                    entries.push(("point".into(), self.written_point(at, &pair)));
                }
            }
            "KnifeEdge" => {
                let at = self.anchor(j, None);
                let written = self.at(at, &pair, j);
                entries.push(("point".into(), written));
                entries.push(self.axis("side", direction, &pair));
            }
            "RollingWheel" | "RollingBall" => {
                entries.extend(self.rolling(ty == "RollingWheel", direction, &pair)?)
            }
            "RollingBallInBowl" => entries.extend(self.in_bowl(direction, &pair)?),
            "AngleDriver" | "OrientationDriver" => {
                entries.push(self.axis("axis", direction, &pair));
                entries.push(("motion".into(), self.law(&[])));
            }
            _ => {
                let at = self.anchor(j, None);
                let written = self.at(at, &pair, j);
                entries.push(("point".into(), written));
                let key = if matches!(ty, "Planar" | "PointOnPlane") {
                    "normal"
                } else {
                    "axis"
                };
                if !matches!(ty, "Spherical" | "Fixed") {
                    entries.push(self.axis(key, direction, &pair));
                }
                if ty == "Screw" {
                    let pitch = 0.1 + self.dice.number().abs();
                    entries.push(("pitch".into(), self.number(pitch)));
                }
                if matches!(ty, "Revolute" | "Cylindrical" | "Planar") {
                    self.hinges.push((pair, direction));
                }
                if ty == "DisplacementDriver" {
                    entries.push(("motion".into(), self.law(&[])));
                }
            }
        }
        Some((ty, pair.into(), entries))
    }

    /// A wheel or a ball on a plane with a normal.
    fn rolling(
        &mut self,
        is_wheel: bool,
        normal: [f64; 3],
        pair: &[Option<usize>; 2],
    ) -> Option<Entries> {
        let unit = |v: [f64; 3]| v.map(|x| x / length(v));
        // In a mechanism that moves in a plane, so does a wheel.
        let (normal, plane) = match self.plane {
            Some(plane) => (self.across(plane), Some(plane)),
            None => (normal, None),
        };
        let center = self.point();
        let radius = 0.2 + 0.3 * self.dice.number().abs();
        let n = unit(normal);
        let mut entries = vec![
            ("center".into(), self.written_point(center, pair)),
            self.axis("normal", normal, pair),
            ("radius".into(), self.number(radius)),
        ];
        let mut arm = n.map(|x| -radius * x);
        if is_wheel {
            let axle = plane.map_or_else(|| self.dice.unit(), unit);
            let crown = [0.0, 0.3 * radius][self.dice.below(2)];
            let lean: f64 = (0..3).map(|k| n[k] * axle[k]).sum();
            if lean.abs() > 0.9 {
                return None;
            }
            let upright = (1.0 - lean * lean).sqrt();
            arm = [0, 1, 2]
                .map(|k| (radius - crown) * (lean * axle[k] - n[k]) / upright - crown * n[k]);
            entries.push(self.axis("axle", axle, pair));
            entries.push(("crown".into(), self.number(crown)));
        }
        // Anywhere in the plane.
        let aside = cross(n, self.dice.unit::<3>());
        let point = [0, 1, 2].map(|k| center[k] + arm[k] + aside[k]);
        entries.push(("point".into(), self.written_point(point, pair)));
        Some(entries)
    }

    /// A ball in a bowl about an axis, or on the outside of a sphere.
    fn in_bowl(&mut self, axis: [f64; 3], pair: &[Option<usize>; 2]) -> Option<Entries> {
        let (center, outward) = (self.point(), self.dice.unit::<3>());
        let along: f64 = (0..3).map(|k| outward[k] * axis[k]).sum();
        if along.abs() < 0.3 * length(axis) {
            return None;
        }
        let radius = 0.2 + 0.3 * self.dice.number().abs();
        let bowl_radius = [1.5 + radius, -0.8][self.dice.below(2)];
        let bowl = [0, 1, 2].map(|k| center[k] - (bowl_radius - radius) * outward[k]);
        Some(vec![
            ("center".into(), self.written_point(center, pair)),
            ("bowl".into(), self.written_point(bowl, pair)),
            self.axis("axis", axis, pair),
            ("radius".into(), self.number(radius)),
            ("bowl_radius".into(), self.number(bowl_radius)),
        ])
    }

    /// Two wheels of an axle that is perpendicular to the normal of their plane.
    fn wheels(&mut self, axle: [f64; 3], bodies: &[Option<usize>]) -> Entries {
        let (normal, center) = (self.across(axle), self.point());
        let radius = 0.2 + 0.3 * self.dice.number().abs();
        let [aside, far] = [0; 2].map(|_| cross(normal, self.dice.unit::<3>()));
        let height = radius / length(normal);
        let point = [0, 1, 2].map(|k| center[k] - height * normal[k] + aside[k]);
        let other = [0, 1, 2].map(|k| center[k] + far[k]);
        vec![
            ("center_j".into(), self.written_point(center, bodies)),
            ("center_k".into(), self.written_point(other, bodies)),
            self.axis("axle", axle, bodies),
            ("point".into(), self.written_point(point, bodies)),
            self.axis("normal", normal, bodies),
            ("radius".into(), self.number(radius)),
        ]
    }

    /// A joint of three bodies.
    pub(crate) fn of_three(&mut self, bodies: &[Option<usize>]) -> Option<(&'static str, Entries)> {
        if bodies.iter().any(|&body| self.is_particle(body)) {
            return None;
        }
        let (one, other) = (self.direction(), self.direction());
        match self.dice.below(4) {
            0 => return Some(("WheelPair", self.wheels(one, bodies))),
            1 => {
                let at = self.point();
                let entries = vec![
                    ("point".into(), self.written_point(at, bodies)),
                    self.axis("tangent", one, bodies),
                ];
                return Some(("RollingPair", entries));
            }
            _ => {}
        }
        let ratio = 0.5 + self.dice.number().abs();
        if self.dice.below(2) == 0 {
            let entries = vec![
                self.axis("axis_i", one, bodies),
                self.axis("axis_j", other, bodies),
                ("ratio".into(), self.number(-ratio)),
            ];
            return Some(("Gear", entries));
        }
        let (hub, at) = (self.point(), self.point());
        let entries = vec![
            self.axis("axis", one, bodies),
            self.axis("slide", other, bodies),
            ("hub".into(), self.written_point(hub, bodies)),
            ("point".into(), self.written_point(at, bodies)),
            ("radius".into(), self.number(ratio)),
        ];
        Some(("RackAndPinion", entries))
    }

    /// A force of the library.
    pub(crate) fn applied(
        &mut self,
        pair: [Option<usize>; 2],
    ) -> Option<(&'static str, Bodies, Entries)> {
        let mut pair = if self.is_particle(pair[0]) {
            [pair[1], pair[0]]
        } else {
            pair
        };
        let [i, j] = pair;
        let direct: &[&'static str] = &["SpringDamper", "Actuator", "PointForce"];
        let turning: &[&'static str] = &[
            "TorsionalSpringDamper",
            "TorsionalActuator",
            "FollowerForce",
            "ConstantMoment",
            "FollowerMoment",
            "RotationalDamper",
        ];
        let names = if self.is_particle(j) || self.dice.below(2) == 0 {
            direct
        } else {
            turning
        };
        let ty = names[self.dice.below(names.len())];
        if ty == "PointForce" && self.is_particle(i) {
            return None;
        }
        let mut bodies: Bodies = pair.into();
        let mut entries: Entries = Vec::new();
        match ty {
            "SpringDamper" | "Actuator" => {
                let tail = self.anchor(j, None);
                let head = self.anchor(i, Some(tail));
                if length(minus(tail, head)) < 0.1 {
                    return None;
                }
                let written = self.at(head, &bodies, i);
                entries.push(("head".into(), written));
                let written = self.at(tail, &bodies, j);
                entries.push(("tail".into(), written));
            }
            "TorsionalSpringDamper" | "TorsionalActuator" => {
                let mut direction = self.direction();
                if !self.hinges.is_empty() && self.dice.below(4) > 0 {
                    // At a hinge, as joints are moved; either body may come first, and the axis may
                    // be turned.
                    let chosen = self.dice.below(self.hinges.len());
                    (pair, direction) = self.hinges[chosen];
                    if self.dice.below(2) == 0 {
                        pair.swap(0, 1);
                    }
                    if self.dice.below(2) == 0 {
                        direction = direction.map(|x| -x);
                    }
                    bodies = pair.into();
                }
                entries.push(self.axis("axis", direction, &bodies));
            }
            // A particle does not turn.
            "RotationalDamper" if self.is_particle(i) => return None,
            "RotationalDamper" => {}
            _ => {
                if matches!(ty, "FollowerForce" | "FollowerMoment") {
                    bodies = vec![
                        [i, j]
                            .into_iter()
                            .find(|&body| body.is_some() && !self.is_particle(body))?,
                    ];
                }
                let vector = self.dice.vector(3.0);
                let key = if ty.ends_with("Moment") {
                    "moment"
                } else {
                    "force"
                };
                entries.push((key.into(), self.written_vector(vector, &bodies)));
                if key == "force" {
                    let on = bodies[bodies.len() - 1];
                    let at = self.anchor(on, None);
                    entries.push(("point".into(), self.at(at, &bodies, on)));
                }
            }
        }
        let (stiffness, damping) = (5.0 * self.dice.number().abs(), self.dice.number().abs());
        match ty {
            "SpringDamper" | "TorsionalSpringDamper" => {
                entries.push(("stiffness".into(), self.number(stiffness)));
                if self.dice.below(2) == 0 {
                    entries.push(("damping".into(), self.number(damping)));
                }
                if ty == "SpringDamper" {
                    entries.push(("free_length".into(), self.number(damping)));
                } else if self.dice.below(2) == 0 {
                    entries.push(("free_angle".into(), self.number(damping)));
                }
            }
            "Actuator" => entries.push(("force".into(), self.law(&["length", "rate"]))),
            "TorsionalActuator" => entries.push(("moment".into(), self.law(&["angle", "rate"]))),
            "RotationalDamper" => entries.push(("damping".into(), self.number(damping))),
            _ => {}
        }
        Some((ty, bodies, entries))
    }
}

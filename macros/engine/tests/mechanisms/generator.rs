//! Random mechanisms, written as a user would write them.

use holonom_engine::model::ElementKind;

use crate::apart::{Field, Mechanism, shuffle};
use crate::elements::Wanted;
use crate::pose::Pose;
use crate::writing::{Dice, Statement, Written, definition};

/// Definitions are shorter than this, in characters.
const LONG: usize = 450;

/// Run-time values of a mechanism.
const MOST_VALUES: usize = 24;

pub(crate) fn show<const N: usize>(numbers: [f64; N]) -> String {
    format!("{:?}", numbers.map(|x| x + 0.0))
}

/// A body with where it stands.
pub(crate) struct Placed {
    pub(crate) name: String,
    pub(crate) is_particle: bool,
    pub(crate) pose: Pose,
    /// The position as it is written.
    pub(crate) position: String,
}

/// Writes a mechanism.
pub(crate) struct Generator {
    pub(crate) dice: Dice,
    fields: Vec<Field>,
    definitions: Vec<(String, ElementKind, String)>,
    bodies: Vec<Placed>,
    /// How many in ten numbers are run-time values.
    run_time: usize,
    /// Whether numbers are mostly simple.
    is_simple: bool,
    /// The axis of all joints, in a mechanism that moves in a plane.
    pub(crate) plane: Option<[f64; 3]>,
    /// The axes of hinges, and their bodies.
    pub(crate) hinges: Vec<([Option<usize>; 2], [f64; 3])>,
    /// Whether one of the joints has equations of velocities.
    rolls: bool,
}

impl Generator {
    pub(crate) fn new(seed: u64, choices: &[u8]) -> Self {
        let mut dice = Dice::with_choices(seed.wrapping_add(0x5851_f42d), choices);
        // The first numbers of neighbouring seeds are alike.
        (0..8).for_each(|_| _ = dice.number());
        // A third of all numbers, most of them in half of the mechanisms.
        let run_time = if dice.below(2) == 0 {
            5 + dice.below(3)
        } else {
            0
        };
        let is_simple = dice.below(2) == 0;
        let plane = (dice.below(5) == 0).then(|| {
            if is_simple {
                [0.0, 0.0, 1.0]
            } else {
                dice.unit()
            }
        });
        Self {
            dice,
            fields: Vec::new(),
            definitions: Vec::new(),
            bodies: Vec::new(),
            run_time,
            is_simple,
            plane,
            hinges: Vec::new(),
            rolls: false,
        }
    }

    /// Wants a joint with equations of velocities in the mechanism.
    pub(crate) fn with_rolling(mut self) -> Self {
        self.rolls = true;
        self
    }

    pub(crate) fn mechanism(mut self) -> Mechanism {
        let most = if self.dice.below(3) == 0 { 5 } else { 3 };
        let count = 2 + self.dice.below(most);
        (0..count).for_each(|place| self.body(place));
        // A tree: every body hangs on the ground or on one before it.
        for child in 0..count {
            if self.dice.below(12) == 0 {
                continue;
            }
            let parent = self
                .dice
                .below(child + 2)
                .checked_sub(1)
                .filter(|&p| p < child);
            let others: Vec<Option<usize>> = (0..child)
                .filter(|&k| Some(k) != parent)
                .map(Some)
                .chain([None])
                .collect();
            self.connect(parent, child, &others);
        }
        // What rolls closes a loop itself.
        for _ in 0..self.dice.below(if self.rolls { 2 } else { 3 }) {
            self.close();
        }
        if self.rolls {
            self.roll();
        }
        if self.dice.below(4) == 0 {
            self.repeat();
        }
        for _ in 0..self.dice.below(4) {
            self.force();
        }
        self.free_bodies();
        let mut fields = self.fields;
        shuffle(&mut fields, &mut self.dice);
        let mut attributes = Vec::new();
        if self.dice.below(4) > 0 {
            let gravity = if self.is_simple {
                [0.0, 0.0, -9.81]
            } else {
                self.dice.vector(9.0)
            };
            attributes.push(("gravity".to_string(), show(gravity)));
        }
        let mut mechanism = Mechanism {
            attributes,
            fields,
            definitions: self.definitions,
        };
        mechanism
            .redundant([None, None, Some("keep"), Some("drop"), Some("drop")][self.dice.below(5)]);
        mechanism
    }

    fn push(&mut self, word: &'static str, ty: &str, entries: Vec<(String, String)>) {
        let prefix = if word == "body" { "b" } else { &word[..1] };
        let count = self
            .fields
            .iter()
            .filter(|field| field.word == word)
            .count();
        self.fields.push(Field {
            word,
            name: format!("{prefix}{count}"),
            ty: ty.into(),
            value: 0.0,
            entries,
        });
    }

    /// A number as it is written: as such, or a run-time value.
    pub(crate) fn number(&mut self, value: f64) -> String {
        self.perhaps(value, "param")
    }

    fn perhaps(&mut self, value: f64, word: &'static str) -> String {
        if self.dice.below(10) >= self.run_time
            || self.fields.iter().filter(|f| f.ty == "f64").count() > MOST_VALUES
        {
            return format!("{:?}", value + 0.0);
        }
        self.push(word, "f64", Vec::new());
        let field = self.fields.last_mut().expect("a field");
        let doubled = self.dice.below(3) == 0;
        field.value = if doubled { 0.5 * value } else { value };
        if doubled {
            format!("2.0 * {}", field.name)
        } else {
            field.name.clone()
        }
    }

    pub(crate) fn vector(&mut self, numbers: [f64; 3]) -> String {
        let written = numbers.map(|x| self.number(x));
        format!("[{}]", written.join(", "))
    }

    pub(crate) fn length(&mut self) -> f64 {
        if self.dice.below(10) < if self.is_simple { 9 } else { 2 } {
            [0.0, 0.5, 1.0, -0.5, 0.25, 0.0][self.dice.below(6)]
        } else {
            self.dice.number()
        }
    }

    pub(crate) fn point(&mut self) -> [f64; 3] {
        [0; 3].map(|_| self.length())
    }

    /// A direction.
    pub(crate) fn direction(&mut self) -> [f64; 3] {
        if let Some(plane) = self.plane {
            return plane;
        }
        if self.dice.below(10) < if self.is_simple { 8 } else { 2 } {
            let mut axis = [0.0; 3];
            axis[self.dice.below(3)] = if self.dice.below(4) == 0 { -2.0 } else { 1.0 };
            return axis;
        }
        self.dice.unit()
    }

    fn body(&mut self, place: usize) {
        // A body that rolls is rigid.
        let is_rigid = self.rolls && place == 0;
        let is_particle = self.plane.is_none() && self.dice.below(6) == 0 && !is_rigid;
        let at = self.point();
        let mass = 0.3 + 2.0 * self.dice.number().abs();
        let position = self.vector(at);
        let mut entries = vec![("mass".to_string(), self.number(mass))];
        let mut euler = [1.0, 0.0, 0.0, 0.0];
        if !is_particle {
            let parts = [0; 3].map(|_| 0.1 + self.dice.number().abs());
            let [a, b, c] = parts;
            let moments = [b + c, c + a, a + b];
            let inertia = if self.dice.below(3) == 0 {
                self.tensor(moments)
            } else {
                self.vector(moments)
            };
            entries.push(("inertia".into(), inertia));
            let turned = self.dice.below(if self.is_simple { 3 } else { 2 });
            if turned == 0 {
                let written;
                (written, euler) = self.orientation();
                entries.push(("orientation".into(), written));
            }
            if self.dice.below(2) == 0 {
                let spin = self.point();
                entries.push(("angular_velocity".into(), show(spin)));
            }
        }
        entries.push(("position".into(), position.clone()));
        if self.dice.below(2) == 0 {
            let velocity = self.point();
            entries.push(("velocity".into(), show(velocity)));
        }
        self.push(
            "body",
            if is_particle { "Particle" } else { "Body" },
            entries,
        );
        self.bodies.push(Placed {
            name: format!("b{place}"),
            is_particle,
            pose: Pose::still(at, euler),
            position,
        });
    }

    fn orientation(&mut self) -> (String, [f64; 4]) {
        if self.is_simple && self.dice.below(4) > 0 {
            let axis = self.dice.below(3);
            let angle = [90.0, 180.0, -90.0][self.dice.below(3)];
            let mut unit = [0.0; 3];
            unit[axis] = 1.0;
            let (sine, cosine) = f64::sin_cos(f64::to_radians(angle) / 2.0);
            let mut euler = [cosine, 0.0, 0.0, 0.0];
            euler[1 + axis] = sine;
            return (format!("rotation({unit:?}, deg({angle:?}))"), euler);
        }
        let euler: [f64; 4] = self.dice.unit();
        let written = euler.map(|e| self.number(e));
        (format!("[{}]", written.join(", ")), euler)
    }

    /// A full tensor with given moments.
    fn tensor(&mut self, moments: [f64; 3]) -> String {
        let pose = Pose::still([0.0; 3], self.dice.unit());
        let columns = [0, 1, 2].map(|k| {
            let mut unit = [0.0; 3];
            unit[k] = 1.0;
            let s = pose.local_of(unit);
            pose.global_of([0, 1, 2].map(|l| moments[l] * s[l]))
        });
        let rows = [0, 1, 2].map(|k| [0, 1, 2].map(|l| 0.5 * (columns[k][l] + columns[l][k])));
        format!("[{}, {}, {}]", show(rows[0]), show(rows[1]), show(rows[2]))
    }

    pub(crate) fn placed(&self, body: Option<usize>) -> Option<&Placed> {
        body.map(|body| &self.bodies[body])
    }

    pub(crate) fn pose(&self, body: Option<usize>) -> Pose {
        self.placed(body)
            .map_or_else(Pose::ground, |placed| placed.pose)
    }

    pub(crate) fn is_particle(&self, body: Option<usize>) -> bool {
        self.placed(body).is_some_and(|placed| placed.is_particle)
    }

    fn names(&self, bodies: &[Option<usize>]) -> String {
        let names = bodies
            .iter()
            .map(|&body| self.placed(body).map_or("ground", |placed| &placed.name));
        format!("[{}]", names.collect::<Vec<_>>().join(", "))
    }

    /// A point as it is written.
    pub(crate) fn written_point(&mut self, at: [f64; 3], bodies: &[Option<usize>]) -> String {
        if self.dice.below(4) > 0 {
            return self.vector(at);
        }
        let copies = bodies.iter().map(|&body| {
            let pose = self.pose(body);
            let from = pose.position.map(|x| x.re);
            show(pose.local_of([0, 1, 2].map(|k| at[k] - from[k])))
        });
        format!("local({})", copies.collect::<Vec<_>>().join(", "))
    }

    /// An axis or a vector as it is written.
    pub(crate) fn written_vector(&mut self, vector: [f64; 3], bodies: &[Option<usize>]) -> String {
        // Of an axis that only the run time knows, the sign of z picks the normals: round-off must
        // not pick it.
        let is_picked = self.run_time > 0 && vector[2].abs() < 1e-6;
        if self.dice.below(4) > 0 || is_picked {
            return self.vector(vector);
        }
        let other = (self.dice.below(2) == 0).then(|| self.dice.unit());
        let copies = bodies.iter().enumerate().map(|(place, &body)| {
            let vector = if place == 0 {
                vector
            } else {
                other.unwrap_or(vector)
            };
            show(self.pose(body).local_of(vector))
        });
        format!("local({})", copies.collect::<Vec<_>>().join(", "))
    }

    fn add(
        &mut self,
        word: &'static str,
        ty: &str,
        bodies: &[Option<usize>],
        mut entries: Vec<(String, String)>,
    ) {
        entries.insert(0, ("between".into(), self.names(bodies)));
        if self.dice.below(3) == 0 {
            shuffle(&mut entries, &mut self.dice);
        }
        self.push(word, ty, entries);
    }

    fn connect(&mut self, parent: Option<usize>, child: usize, others: &[Option<usize>]) {
        if self.plane.is_none()
            && self.dice.below(6) == 0
            && self.of_users(Some(child), parent, others)
        {
            return;
        }
        let wanted = if self.plane.is_some() {
            Wanted::Planar
        } else {
            Wanted::Tree
        };
        self.library(wanted, [parent, Some(child)]);
    }

    fn library(&mut self, wanted: Wanted, pair: [Option<usize>; 2]) {
        let pair = if self.dice.below(3) == 0 {
            [pair[1], pair[0]]
        } else {
            pair
        };
        if let Some((ty, bodies, entries)) = self.joint(wanted, pair) {
            self.add("joint", ty, &bodies, entries);
        }
    }

    /// What rolls is a body of its own, free or on another as a wheel is, or one that is there.
    fn roll(&mut self) {
        let own = self.bodies.len();
        let is_new = self.dice.below(6) > 0;
        if is_new {
            self.body(own);
            if self.dice.below(3) == 0 {
                let carrier = self.dice.below(own);
                self.connect(Some(carrier), own, &[]);
            }
        }
        loop {
            let Some(mut pair) = self.some_bodies(2) else {
                continue;
            };
            if is_new && !pair.contains(&Some(own)) {
                pair[1] = Some(own);
            }
            if pair.iter().any(|&body| self.is_particle(body)) {
                if is_new && self.is_particle(Some(own)) {
                    return self.roll();
                }
                continue;
            }
            if let Some((ty, bodies, entries)) = self.joint(Wanted::Rolling, [pair[0], pair[1]]) {
                return self.add("joint", ty, &bodies, entries);
            }
        }
    }

    /// Two or three different bodies, the ground at most once.
    fn some_bodies(&mut self, count: usize) -> Option<Vec<Option<usize>>> {
        let mut bodies: Vec<Option<usize>> =
            (0..self.bodies.len()).map(Some).chain([None]).collect();
        shuffle(&mut bodies, &mut self.dice);
        bodies.truncate(count);
        (bodies.len() == count && bodies.iter().any(Option::is_some)).then_some(bodies)
    }

    fn close(&mut self) {
        let three = self.dice.below(3) == 0;
        let Some(bodies) = self.some_bodies(if three { 3 } else { 2 }) else {
            return;
        };
        if three && self.plane.is_none() {
            if self.dice.below(2) == 0 {
                self.of_users(bodies[0], bodies[1], &bodies[2..]);
            } else if let Some((ty, entries)) = self.of_three(&bodies) {
                self.add("joint", ty, &bodies, entries);
            }
            return;
        }
        let wanted = if self.plane.is_some() {
            Wanted::Planar
        } else {
            Wanted::Loop
        };
        self.library(wanted, [bodies[0], bodies[1]]);
    }

    /// A second joint of what is joined already, so that equations depend on each other.
    fn repeat(&mut self) {
        let joints: Vec<&Field> = self
            .fields
            .iter()
            .filter(|field| field.word == "joint")
            .collect();
        if joints.is_empty() {
            return;
        }
        let field = joints[self.dice.below(joints.len())].clone();
        if !self.definitions.iter().any(|(name, ..)| *name == field.ty) {
            self.push("joint", &field.ty, field.entries);
        }
    }

    /// A joint or a force of a random definition; whether there was one.
    fn of_users(
        &mut self,
        first: Option<usize>,
        second: Option<usize>,
        others: &[Option<usize>],
    ) -> bool {
        let mut bodies = vec![first, second];
        let others: Vec<_> = others
            .iter()
            .copied()
            .filter(|other| !bodies.contains(other))
            .collect();
        if !others.is_empty() && self.dice.below(2) == 0 {
            bodies.push(others[self.dice.below(others.len())]);
        }
        shuffle(&mut bodies, &mut self.dice);
        if bodies.iter().any(|&body| self.is_particle(body)) {
            return false;
        }
        self.define(ElementKind::Joint, &bodies);
        true
    }

    fn define(&mut self, kind: ElementKind, bodies: &[Option<usize>]) {
        let name = format!("Own{}", self.definitions.len());
        let fixed = |text: &str| vec![Statement::Row(text.to_string())];
        let statements = match (kind, bodies.len(), self.dice.below(4)) {
            (ElementKind::Joint, 3, 0) => {
                let mut rows = fixed("j.p - i.p");
                rows.extend(fixed("dot(k.a.normals(), j.a)"));
                rows
            }
            (ElementKind::Joint, 3, 1) => fixed("i.p + k.p - 2.0 * j.p"),
            (ElementKind::Joint, 3, 2) => fixed("dot(i.a, k.q - j.p)"),
            (_, count, _) => loop {
                let statements = Written::random(kind, count, &mut self.dice).statements;
                // Long ones take seconds to be differentiated and planned.
                if definition(&name, count, &statements).len() < LONG {
                    break statements;
                }
            },
        };
        let text = definition(&name, bodies.len(), &statements);
        self.definitions.push((name.clone(), kind, text));
        let mut entries = Vec::new();
        for key in ["p", "q"] {
            let at = self.point();
            entries.push((key.to_string(), self.written_point(at, bodies)));
        }
        for key in ["a", "b", "v"] {
            let vector = self.direction();
            entries.push((key.to_string(), self.written_vector(vector, bodies)));
        }
        for key in ["size", "ratio"] {
            let value = self.dice.number();
            entries.push((key.to_string(), self.number(value)));
        }
        entries.push(("law".into(), crate::writing::law(&mut self.dice)));
        self.add(kind.word(), &name, bodies, entries);
    }

    fn force(&mut self) {
        let three = self.dice.below(4) == 0;
        let Some(bodies) = self.some_bodies(if three { 3 } else { 2 }) else {
            return;
        };
        if self.dice.below(4) == 0 {
            if !bodies.iter().any(|&body| self.is_particle(body)) {
                self.define(ElementKind::Force, &bodies);
            }
            return;
        }
        let pair = [bodies[0], bodies[1]];
        if let Some((ty, bodies, entries)) = self.applied(pair) {
            self.add("force", ty, &bodies, entries);
        }
    }

    /// A law of the time and of arguments.
    pub(crate) fn law(&mut self, arguments: &[&str]) -> String {
        let (a, b) = (self.dice.number(), self.dice.number());
        let (a, b) = (self.number(a), self.number(b));
        let mut law = match self.dice.below(4) {
            0 => format!("{a} * sin(3.0 * time)"),
            1 => format!("{a} + {b} * time * time"),
            2 => format!("{a} * smooth_step(time / 2.0)"),
            _ => format!("{a} * exp(-time) / (2.0 + cos({b} * time))"),
        };
        for argument in arguments {
            if self.dice.below(3) > 0 {
                law += &format!(" - {a} * {argument} * {argument} + {b} * {argument}");
            }
        }
        law
    }

    /// Bodies that no joint names are marked as free.
    fn free_bodies(&mut self) {
        let mut joined = Vec::new();
        for field in self.fields.iter().filter(|field| field.word == "joint") {
            let between = field.entries.iter().find(|(key, _)| key == "between");
            let names = between
                .map_or("", |(_, names)| names)
                .split(|c: char| !c.is_alphanumeric());
            joined.extend(names.map(ToString::to_string));
        }
        for field in &mut self.fields {
            if field.word == "body" && !joined.contains(&field.name) {
                field.entries.push(("free".into(), String::new()));
            }
        }
    }
}

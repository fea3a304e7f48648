//! A second reader of the language: evaluates the text of a joint over dual numbers, without any derivative of its own.

use std::cell::Cell;

use num_dual::{Dual2_64, DualNum};
use syn::{BinOp, Expr, Lit, Member, UnOp};

use crate::random::{BODIES, Joint, Statement};

pub(crate) type Vector = [Dual2_64; 3];

/// Below this, a divisor, a length or the argument of a root is near a singularity.
const SINGULAR: f64 = 0.05;

/// Position and Euler parameters of a body.
#[derive(Clone, Copy)]
pub(crate) struct Pose {
    pub(crate) position: Vector,
    pub(crate) euler: [Dual2_64; 4],
}

/// One or two scalars or vectors.
#[derive(Clone)]
enum Value {
    Scalars(Vec<Dual2_64>),
    Vectors(Vec<Vector>),
}

pub(crate) fn constant(value: f64) -> Dual2_64 {
    Dual2_64::new(value, 0.0, 0.0)
}

pub(crate) fn dot(a: Vector, b: Vector) -> Dual2_64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

impl Pose {
    /// A body that stands still.
    pub(crate) fn still(position: [f64; 3], euler: [f64; 4]) -> Self {
        Self {
            position: position.map(constant),
            euler: euler.map(constant),
        }
    }

    /// `A(p) s` by the formula for one vector: `(e0^2 - e.e) s + 2 e (e.s) + 2 e0 (e x s)`; backwards with `-e`.
    fn turned(&self, s: Vector, sign: f64) -> Vector {
        let [e0, x, y, z] = self.euler;
        let e = [x * sign, y * sign, z * sign];
        let (square, along, around) = (e0 * e0 - dot(e, e), dot(e, s), cross(e, s));
        [0, 1, 2].map(|k| square * s[k] + e[k] * along * 2.0 + e0 * around[k] * 2.0)
    }

    pub(crate) fn outwards(&self, s: Vector) -> Vector {
        self.turned(s, 1.0)
    }

    fn inwards(&self, s: Vector) -> Vector {
        self.turned(s, -1.0)
    }
}

/// The two unit vectors perpendicular to an axis, as the documentation has it: the first is `e_k x a`, normalised, where component
/// `k` of `a` is the smallest; axis, first and second are right-handed.
fn normals(axis: [f64; 3]) -> [[f64; 3]; 2] {
    let [x, y, z] = axis;
    let smallest = (0..3).fold(0, |k, l| if axis[l].abs() < axis[k].abs() { l } else { k });
    let first = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]][smallest];
    let length = first.iter().map(|c| c * c).sum::<f64>().sqrt();
    let [a, b, c] = first.map(|component| component / length);
    [[a, b, c], [y * c - z * b, z * a - x * c, x * b - y * a]]
}

/// What a force is made of, at one instant.
#[derive(Clone, Copy)]
pub(crate) enum Acting {
    Potential(Dual2_64),
    /// Effort and coordinate.
    Along(Dual2_64, Dual2_64),
    /// Force and point.
    Force(Vector, Vector),
    /// Moment and formal body.
    Moment(Vector, usize),
}

/// Reads the text of a joint at one instant.
pub(crate) struct Interpreter<'a> {
    joint: &'a Joint,
    /// Of the formal bodies, now and in the described configuration.
    poses: [Vec<Pose>; 2],
    time: Dual2_64,
    turns: &'a [f64],
    /// The largest number so far.
    pub(crate) scale: Cell<f64>,
    /// Whether something was near a singularity.
    pub(crate) singular: Cell<bool>,
}

/// Where an expression is evaluated.
#[derive(Clone, Copy)]
enum When {
    Now,
    Described,
}

impl<'a> Interpreter<'a> {
    /// The poses of the mechanism's bodies in order.
    pub(crate) fn new(
        joint: &'a Joint,
        poses: Vec<Pose>,
        time: Dual2_64,
        turns: &'a [f64],
    ) -> Self {
        let ground = Pose::still([0.0; 3], [1.0, 0.0, 0.0, 0.0]);
        let formal = |poses: &[Pose]| {
            let places = joint.between.iter();
            places
                .map(|place| place.map_or(ground, |place| poses[place]))
                .collect()
        };
        let starts: Vec<Pose> = joint
            .starts
            .iter()
            .map(|(r, p)| Pose::still(*r, *p))
            .collect();
        Self {
            joint,
            poses: [formal(&poses), formal(&starts)],
            time,
            turns,
            scale: Cell::new(1.0),
            singular: Cell::new(false),
        }
    }

    /// The values of all equations.
    pub(crate) fn rows(&self) -> Vec<Dual2_64> {
        let mut rows = Vec::new();
        for statement in &self.joint.statements {
            match statement {
                Statement::Row(text) => match self.text(text, When::Now) {
                    Value::Scalars(scalars) => rows.extend(scalars),
                    Value::Vectors(vectors) => rows.extend(vectors.into_iter().flatten()),
                },
                Statement::Drive(driven, law) => rows.push(self.number(driven) - self.number(law)),
                _ => {}
            }
        }
        rows
    }

    /// The values of what forces are made of.
    pub(crate) fn actions(&self) -> Vec<Acting> {
        let statements = self.joint.statements.iter();
        let actions = statements.filter_map(|statement| match statement {
            Statement::Potential(energy) => Some(Acting::Potential(self.number(energy))),
            Statement::Along(effort, coordinate) => {
                Some(Acting::Along(self.number(effort), self.number(coordinate)))
            }
            Statement::Force(force, point) => {
                Some(Acting::Force(self.triple(force), self.triple(point)))
            }
            Statement::Moment(moment, body) => {
                let place = BODIES.iter().position(|known| known == body);
                Some(Acting::Moment(self.triple(moment), place.expect("a body")))
            }
            _ => None,
        });
        actions.collect()
    }

    fn number(&self, text: &str) -> Dual2_64 {
        self.one(self.text(text, When::Now))
    }

    fn triple(&self, text: &str) -> Vector {
        match self.text(text, When::Now) {
            Value::Vectors(vectors) if vectors.len() == 1 => vectors[0],
            _ => panic!("one vector is wanted"),
        }
    }

    fn text(&self, text: &str, when: When) -> Value {
        let expr: Expr = syn::parse_str(text).expect("an expression");
        self.value(&expr, when, None)
    }

    fn one(&self, value: Value) -> Dual2_64 {
        match value {
            Value::Scalars(scalars) if scalars.len() == 1 => scalars[0],
            _ => panic!("one scalar is wanted"),
        }
    }

    fn avoid(&self, value: Dual2_64) {
        if value.re.abs() < SINGULAR {
            self.singular.set(true);
        }
    }

    fn value(&self, expr: &Expr, when: When, argument: Option<Dual2_64>) -> Value {
        let value = self.unmeasured(expr, when, argument);
        let measure = |number: &Dual2_64| {
            let size = number.re.abs().max(number.v1.abs()).max(number.v2.abs());
            self.scale.set(self.scale.get().max(size));
        };
        match &value {
            Value::Scalars(scalars) => scalars.iter().for_each(measure),
            Value::Vectors(vectors) => vectors.iter().flatten().for_each(measure),
        }
        value
    }

    fn unmeasured(&self, expr: &Expr, when: When, argument: Option<Dual2_64>) -> Value {
        let of = |expr: &Expr| self.value(expr, when, argument);
        match expr {
            Expr::Paren(inner) => of(&inner.expr),
            Expr::Lit(literal) => match &literal.lit {
                Lit::Float(float) => scalar(constant(float.base10_parse().expect("a number"))),
                Lit::Int(int) => scalar(constant(int.base10_parse().expect("a number"))),
                _ => panic!("a number is wanted"),
            },
            Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => match of(&unary.expr) {
                Value::Scalars(a) => Value::Scalars(a.into_iter().map(|a| -a).collect()),
                Value::Vectors(a) => Value::Vectors(a.into_iter().map(|a| a.map(|a| -a)).collect()),
            },
            Expr::Binary(binary) => self.binary(binary.op, of(&binary.left), of(&binary.right)),
            Expr::Array(array) => {
                let components: Vec<Dual2_64> =
                    array.elems.iter().map(|c| self.one(of(c))).collect();
                Value::Vectors(vec![components.try_into().expect("three components")])
            }
            Expr::Field(field) => {
                let Member::Named(name) = &field.member else {
                    panic!("a name is wanted");
                };
                vector(self.fixed(self.body(&field.base), &name.to_string(), when))
            }
            Expr::MethodCall(call) => {
                let Expr::Field(field) = &*call.receiver else {
                    panic!("an axis is wanted");
                };
                let Member::Named(name) = &field.member else {
                    panic!("a name is wanted");
                };
                let normals = self.normals(self.body(&field.base), &name.to_string(), when);
                Value::Vectors(match call.method.to_string().as_str() {
                    "normals" => normals.to_vec(),
                    "normal" => vec![normals[0]],
                    _ => vec![normals[1]],
                })
            }
            Expr::Path(path) => {
                let name = path.path.get_ident().expect("a name").to_string();
                match (name.as_str(), argument) {
                    ("x", Some(argument)) => scalar(argument),
                    ("time", _) => scalar(self.time),
                    ("PI", _) => scalar(constant(std::f64::consts::PI)),
                    ("TAU", _) => scalar(constant(std::f64::consts::TAU)),
                    _ => self.named(&name, when),
                }
            }
            Expr::Call(call) => {
                let Expr::Path(path) = &*call.func else {
                    panic!("a function is wanted");
                };
                let name = path.path.get_ident().expect("a name").to_string();
                let arguments: Vec<&Expr> = call.args.iter().collect();
                self.call(&name, &arguments, when, argument)
            }
            _ => panic!("not of the language"),
        }
    }

    /// A scalar parameter, or what a `let` names.
    fn named(&self, name: &str, when: When) -> Value {
        let scalars = &self.joint.scalars;
        if let Some((_, value)) = scalars.iter().find(|(known, _)| *known == name) {
            return scalar(constant(*value));
        }
        let found = self
            .joint
            .statements
            .iter()
            .find_map(|statement| match statement {
                Statement::Let(known, text) if known == name => Some(text),
                _ => None,
            });
        self.text(found.expect("a known name"), when)
    }

    fn body(&self, expr: &Expr) -> usize {
        let Expr::Path(path) = expr else {
            panic!("a body is wanted");
        };
        let place = BODIES.iter().position(|body| path.path.is_ident(body));
        place.expect("a body")
    }

    fn pose(&self, body: usize, when: When) -> &Pose {
        &self.poses[when as usize][body]
    }

    /// Where a body that carries a global vector of the described configuration has it.
    fn carried(&self, body: usize, described: Vector, when: When) -> Vector {
        let local = self.pose(body, When::Described).inwards(described);
        self.pose(body, when).outwards(local)
    }

    /// A point, vector or axis of a body.
    fn fixed(&self, body: usize, name: &str, when: When) -> Vector {
        let position = self.pose(body, when).position;
        if name == "origin" {
            return position;
        }
        if let Some((_, axis)) = self.joint.axes.iter().find(|(known, _)| *known == name) {
            return self.carried(body, axis.map(constant), when);
        }
        if let Some((_, given)) = self.joint.vectors.iter().find(|(known, _)| *known == name) {
            return self.carried(body, given.map(constant), when);
        }
        let points = &self.joint.points;
        let (_, point) = points
            .iter()
            .find(|(known, _)| *known == name)
            .expect("a known name");
        let start = self.pose(body, When::Described).position;
        let arm = [0, 1, 2].map(|k| constant(point[k]) - start[k]);
        let arm = self.carried(body, arm, when);
        [0, 1, 2].map(|k| position[k] + arm[k])
    }

    fn normals(&self, body: usize, name: &str, when: When) -> [Vector; 2] {
        let axes = &self.joint.axes;
        let (_, axis) = axes
            .iter()
            .find(|(known, _)| *known == name)
            .expect("a known axis");
        normals(*axis).map(|normal| self.carried(body, normal.map(constant), when))
    }

    fn binary(&self, op: BinOp, left: Value, right: Value) -> Value {
        use Value::{Scalars, Vectors};
        match (op, left, right) {
            (BinOp::Add(_), Scalars(a), Scalars(b)) => Scalars(pairs(&a, &b, |a, b| a + b)),
            (BinOp::Sub(_), Scalars(a), Scalars(b)) => Scalars(pairs(&a, &b, |a, b| a - b)),
            (BinOp::Mul(_), Scalars(a), Scalars(b)) => Scalars(pairs(&a, &b, |a, b| a * b)),
            (BinOp::Div(_), Scalars(a), Scalars(b)) => {
                b.iter().for_each(|b| self.avoid(*b));
                Scalars(pairs(&a, &b, |a, b| a / b))
            }
            (BinOp::Add(_), Vectors(a), Vectors(b)) => {
                Vectors(pairs(&a, &b, |a, b| [0, 1, 2].map(|k| a[k] + b[k])))
            }
            (BinOp::Sub(_), Vectors(a), Vectors(b)) => {
                Vectors(pairs(&a, &b, |a, b| [0, 1, 2].map(|k| a[k] - b[k])))
            }
            (BinOp::Mul(_), Scalars(a), Vectors(b)) | (BinOp::Mul(_), Vectors(b), Scalars(a)) => {
                Vectors(pairs(&a, &b, |a, b| b.map(|b| a * b)))
            }
            (BinOp::Div(_), Vectors(a), Scalars(b)) => {
                b.iter().for_each(|b| self.avoid(*b));
                Vectors(pairs(&a, &b, |a, b| a.map(|a| a / b)))
            }
            _ => panic!("shapes do not fit"),
        }
    }

    fn call(
        &self,
        name: &str,
        arguments: &[&Expr],
        when: When,
        argument: Option<Dual2_64>,
    ) -> Value {
        let of = |place: usize| self.value(arguments[place], when, argument);
        let number = |place: usize| self.one(of(place));
        let vectors = |place: usize| match of(place) {
            Value::Vectors(vectors) => vectors,
            Value::Scalars(_) => panic!("a vector is wanted"),
        };
        match name {
            "dot" => Value::Scalars(pairs(&vectors(0), &vectors(1), dot)),
            "cross" => Value::Vectors(pairs(&vectors(0), &vectors(1), cross)),
            "squared" => Value::Scalars(vectors(0).into_iter().map(|a| dot(a, a)).collect()),
            "length" => {
                let squares = vectors(0).into_iter().map(|a| dot(a, a));
                Value::Scalars(squares.map(|square| self.root(square)).collect())
            }
            // Along the motion.
            "rate" => scalar(constant(number(0).v1)),
            "sqrt" => scalar(self.root(number(0))),
            "sin" => scalar(number(0).sin()),
            "cos" => scalar(number(0).cos()),
            "exp" => scalar(number(0).exp()),
            "smooth_step" => {
                let x = number(0);
                scalar(match x.re {
                    x if x <= 0.0 => constant(0.0),
                    x if x >= 1.0 => constant(1.0),
                    _ => x * x * x * (x * (x * 6.0 - 15.0) + 10.0),
                })
            }
            "law" => {
                let law: Expr = syn::parse_str(&self.joint.law).expect("an expression");
                self.value(&law, when, Some(number(0)))
            }
            "angle" => {
                let (from, to) = (self.body(arguments[0]), self.body(arguments[1]));
                scalar(self.angle(from, to, &name_of(arguments[2]), when))
            }
            "initial" => self.value(arguments[0], When::Described, argument),
            "fixed" => {
                let body = self.body(arguments[0]);
                let described = self.value(arguments[1], When::Described, argument);
                let Value::Vectors(described) = described else {
                    panic!("a vector is wanted");
                };
                let carried = described.into_iter().map(|v| self.carried(body, v, when));
                Value::Vectors(carried.collect())
            }
            _ => panic!("no function {name}"),
        }
    }

    /// The angle of a body against another, with its whole turns.
    pub(crate) fn angle_now(&self, from: usize, to: usize, axis: &str) -> f64 {
        self.angle(from, to, axis, When::Now).re
    }

    fn angle(&self, from: usize, to: usize, axis: &str, when: When) -> Dual2_64 {
        if matches!(when, When::Described) {
            return constant(0.0);
        }
        let [first, second] = self.normals(from, axis, when);
        let [turning, _] = self.normals(to, axis, when);
        let (sine, cosine) = (dot(second, turning), dot(first, turning));
        self.avoid(sine * sine + cosine * cosine);
        let place = self.joint.angle_place(from, to, axis);
        let turns = place.and_then(|place| self.turns.get(place)).copied();
        sine.atan2(cosine) + std::f64::consts::TAU * turns.unwrap_or(0.0)
    }

    fn root(&self, square: Dual2_64) -> Dual2_64 {
        self.avoid(square);
        square.sqrt()
    }
}

fn name_of(expr: &Expr) -> String {
    let Expr::Path(path) = expr else {
        panic!("a name is wanted");
    };
    path.path.get_ident().expect("a name").to_string()
}

fn scalar(value: Dual2_64) -> Value {
    Value::Scalars(vec![value])
}

fn vector(value: Vector) -> Value {
    Value::Vectors(vec![value])
}

/// One with one, one with two, two with two.
fn pairs<A: Copy, B: Copy, C>(a: &[A], b: &[B], f: impl Fn(A, B) -> C) -> Vec<C> {
    let count = a.len().max(b.len());
    (0..count)
        .map(|k| f(a[k % a.len()], b[k % b.len()]))
        .collect()
}

//! A second reader of the language: evaluates a definition over dual numbers, without any
//! derivative of its own.
#![allow(dead_code, reason = "every test uses a part of it")]

use std::cell::Cell;
use std::f64::consts::{PI, TAU};

use num_dual::{Dual2_64, DualNum};
use syn::{BinOp, Expr, Lit, Member, UnOp};

use crate::pose::{Pose, Vector, constant, cross, dot, rate};
use crate::reading::{Element, Given, Statement};

/// Below this, a divisor, a length or the argument of a root is near a singularity.
const SINGULAR: f64 = 0.05;

/// One or two scalars or vectors.
#[derive(Clone)]
enum Value {
    Scalars(Vec<Dual2_64>),
    Vectors(Vec<Vector>),
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

/// Reads a definition at one instant.
pub(crate) struct Interpreter<'a> {
    element: &'a Element,
    /// Of the formal bodies, now and in the reference configuration.
    poses: [Vec<Pose>; 2],
    /// Run-time values of the mechanism.
    values: &'a [(String, f64)],
    time: Dual2_64,
    /// Whole turns of the angles that the state counts.
    turns: &'a [f64],
    /// The largest number so far.
    pub(crate) scale: Cell<f64>,
    /// Whether something was near a singularity.
    pub(crate) singular: Cell<bool>,
    /// Whether a rate stands in what was evaluated.
    rated: Cell<bool>,
}

/// Where an expression is evaluated.
#[derive(Clone, Copy)]
enum When {
    Now,
    Described,
}

/// What names mean, besides the words of the language: those of the definition, or the arguments of
/// a law.
type Arguments<'a> = Option<&'a [(String, Dual2_64)]>;

impl<'a> Interpreter<'a> {
    /// The poses of the mechanism's bodies in order, now and in the reference configuration.
    pub(crate) fn new(
        element: &'a Element,
        [now, described]: [&[Pose]; 2],
        values: &'a [(String, f64)],
        time: Dual2_64,
        turns: &'a [f64],
    ) -> Self {
        let formal = |poses: &[Pose]| {
            let places = element.between.iter();
            places
                .map(|place| place.map_or_else(Pose::ground, |place| poses[place]))
                .collect()
        };
        Self {
            element,
            poses: [formal(now), formal(described)],
            values,
            time,
            turns,
            scale: Cell::new(1.0),
            singular: Cell::new(false),
            rated: Cell::new(false),
        }
    }

    /// The values of all equations. One of velocities is the derivative of nothing that is known:
    /// its value is zero.
    pub(crate) fn rows(&self) -> Vec<Dual2_64> {
        let mut rows = Vec::new();
        for statement in &self.element.statements {
            self.rated.set(false);
            let first = rows.len();
            match statement {
                Statement::Row(expr) => match self.value(expr, When::Now, None) {
                    Value::Scalars(scalars) => rows.extend(scalars),
                    Value::Vectors(vectors) => rows.extend(vectors.into_iter().flatten()),
                },
                Statement::Drive(driven, law) => rows.push(self.number(driven) - self.number(law)),
                _ => {}
            }
            if self.rated.get() {
                for row in &mut rows[first..] {
                    *row = Dual2_64::new(0.0, row.re, row.v1);
                }
            }
        }
        rows
    }

    /// What is positive on the side that is meant.
    pub(crate) fn sides(&self) -> Vec<f64> {
        let statements = self.element.statements.iter();
        let sides = statements.filter_map(|statement| match statement {
            Statement::Require(expr) => Some(self.number(expr).re),
            _ => None,
        });
        sides.collect()
    }

    /// The values of what forces are made of.
    pub(crate) fn actions(&self) -> Vec<Acting> {
        let statements = self.element.statements.iter();
        let actions = statements.filter_map(|statement| match statement {
            Statement::Potential(energy) => Some(Acting::Potential(self.number(energy))),
            Statement::Along(effort, coordinate) => {
                Some(Acting::Along(self.number(effort), self.number(coordinate)))
            }
            Statement::Force(force, point) => {
                Some(Acting::Force(self.triple(force), self.triple(point)))
            }
            Statement::Moment(moment, body) => {
                let place = self.element.formal.iter().position(|known| body == known);
                Some(Acting::Moment(self.triple(moment), place.expect("a body")))
            }
            _ => None,
        });
        actions.collect()
    }

    fn number(&self, expr: &Expr) -> Dual2_64 {
        self.one(self.value(expr, When::Now, None))
    }

    fn triple(&self, expr: &Expr) -> Vector {
        match self.value(expr, When::Now, None) {
            Value::Vectors(vectors) if vectors.len() == 1 => vectors[0],
            _ => panic!("one vector is wanted"),
        }
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

    fn value(&self, expr: &Expr, when: When, arguments: Arguments<'_>) -> Value {
        let value = self.unmeasured(expr, when, arguments);
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

    fn unmeasured(&self, expr: &Expr, when: When, arguments: Arguments<'_>) -> Value {
        let of = |expr: &Expr| self.value(expr, when, arguments);
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
                self.named(&name, when, arguments)
            }
            Expr::Call(call) => {
                let Expr::Path(path) = &*call.func else {
                    panic!("a function is wanted");
                };
                let name = path.path.get_ident().expect("a name").to_string();
                let given: Vec<&Expr> = call.args.iter().collect();
                self.call(&name, &given, when, arguments)
            }
            _ => panic!("not of the language"),
        }
    }

    /// An argument of a law, a run-time value; or a scalar parameter, or what a `let` names.
    fn named(&self, name: &str, when: When, arguments: Arguments<'_>) -> Value {
        match name {
            "time" => return scalar(self.time),
            "PI" => return scalar(constant(PI)),
            "TAU" => return scalar(constant(TAU)),
            _ => {}
        }
        if let Some(arguments) = arguments {
            let known = arguments.iter().find(|(known, _)| known == name);
            let value = self.values.iter().find(|(known, _)| known == name);
            let value = value.map(|(_, value)| constant(*value));
            return scalar(
                known
                    .map(|(_, value)| *value)
                    .or(value)
                    .expect("a known name"),
            );
        }
        let mut numbers = self.element.numbers.iter();
        if let Some((_, given)) = numbers.find(|(known, _)| known == name) {
            return match given {
                Given::Number(value) => scalar(constant(*value)),
                Given::Default(expr) => self.value(expr, when, None),
            };
        }
        let mut statements = self.element.statements.iter();
        let found = statements.find_map(|statement| match statement {
            Statement::Let(known, expr) if known == name => Some(expr),
            _ => None,
        });
        self.value(found.expect("a known name"), when, None)
    }

    fn body(&self, expr: &Expr) -> usize {
        let Expr::Path(path) = expr else {
            panic!("a body is wanted");
        };
        let mut formal = self.element.formal.iter();
        let place = formal.position(|body| path.path.is_ident(body));
        place.expect("a body")
    }

    fn pose(&self, body: usize, when: When) -> &Pose {
        &self.poses[when as usize][body]
    }

    /// Where a body that carries a global vector of the reference configuration has it.
    fn carried(&self, body: usize, described: Vector, when: When) -> Vector {
        let local = self.pose(body, When::Described).inwards(described);
        self.pose(body, when).outwards(local)
    }

    /// A point, vector or axis of a body.
    fn fixed(&self, body: usize, name: &str, when: When) -> Vector {
        let pose = self.pose(body, when);
        if name == "origin" {
            return pose.position;
        }
        let mut vectors = self.element.vectors.iter();
        let carried = vectors.find(|vector| vector.name == name);
        let carried = carried.expect("a known name");
        let arm = pose.outwards(carried.copies[body].map(constant));
        if carried.is_point {
            [0, 1, 2].map(|k| pose.position[k] + arm[k])
        } else {
            arm
        }
    }

    fn normals(&self, body: usize, name: &str, when: When) -> [Vector; 2] {
        let mut vectors = self.element.vectors.iter();
        let carried = vectors.find(|vector| vector.name == name);
        let normals = carried.expect("a known axis").normals[body];
        normals.map(|normal| self.pose(body, when).outwards(normal.map(constant)))
    }

    /// The components of vector equations that are split along directions fixed on a body, by the
    /// first equation.
    pub(crate) fn components(&self, rows: &[Dual2_64]) -> Vec<(usize, Vector)> {
        let split = self.element.components.iter();
        let components = split.map(|(first, body, axes)| {
            let pose = self.pose(*body, When::Now);
            let own = [0, 1, 2].map(|k| rows[first + k]);
            let along = axes.map(|axis| dot(pose.outwards(axis.map(constant)), own));
            (*first, along)
        });
        components.collect()
    }

    /// An axis of a body, now.
    pub(crate) fn axis_now(&self, body: usize, name: &str) -> Vector {
        self.fixed(body, name, When::Now)
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

    fn call(&self, name: &str, given: &[&Expr], when: When, arguments: Arguments<'_>) -> Value {
        let of = |place: usize| self.value(given[place], when, arguments);
        let number = |place: usize| self.one(of(place));
        let vectors = |place: usize| match of(place) {
            Value::Vectors(vectors) => vectors,
            Value::Scalars(_) => panic!("a vector is wanted"),
        };
        if arguments.is_none()
            && let Some(law) = self.element.laws.iter().find(|law| law.name == name)
        {
            let names = law.arguments.iter().cloned().enumerate();
            let known: Vec<_> = names.map(|(place, name)| (name, number(place))).collect();
            return self.value(&law.body, when, Some(&known));
        }
        match name {
            "dot" => Value::Scalars(pairs(&vectors(0), &vectors(1), dot)),
            "cross" => Value::Vectors(pairs(&vectors(0), &vectors(1), cross)),
            "squared" => Value::Scalars(vectors(0).into_iter().map(|a| dot(a, a)).collect()),
            "length" => {
                let squares = vectors(0).into_iter().map(|a| dot(a, a));
                Value::Scalars(squares.map(|square| self.root(square)).collect())
            }
            // Along the motion.
            "rate" => {
                self.rated.set(true);
                match of(0) {
                    Value::Scalars(scalars) => {
                        Value::Scalars(scalars.into_iter().map(rate).collect())
                    }
                    Value::Vectors(vectors) => {
                        Value::Vectors(vectors.into_iter().map(|v| v.map(rate)).collect())
                    }
                }
            }
            "angular_velocity" => {
                self.rated.set(true);
                let spins = given
                    .iter()
                    .map(|body| self.pose(self.body(body), when).spin());
                vector(match spins.collect::<Vec<_>>()[..] {
                    [to] => to,
                    [from, to] => [0, 1, 2].map(|k| to[k] - from[k]),
                    _ => panic!("one body or two"),
                })
            }
            "asin" => scalar(number(0).asin()),
            "acos" => scalar(number(0).acos()),
            "atan" => scalar(number(0).atan()),
            "atan2" => {
                let (sine, cosine) = (number(0), number(1));
                self.avoid(sine * sine + cosine * cosine);
                // Round-off must not decide by which half turn it is.
                if cosine.re < 0.0 {
                    self.avoid(sine);
                }
                scalar(arc(sine, cosine))
            }
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
            "angle" => {
                let (from, to) = (self.body(given[0]), self.body(given[1]));
                scalar(self.angle(from, to, &name_of(given[2]), when))
            }
            "initial" => self.value(given[0], When::Described, None),
            "fixed" => {
                let body = self.body(given[0]);
                let described = self.value(given[1], When::Described, None);
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
        let mut turns = self.element.turns.iter().zip(self.turns);
        let known = |turn: &(usize, usize, String)| (turn.0, turn.1, &*turn.2) == (from, to, axis);
        // Of a force only what nobody reads is not counted: these turns would show.
        let uncounted = if self.element.is_force { 5.0 } else { 0.0 };
        let turns = turns
            .find(|(turn, _)| known(turn))
            .map_or(uncounted, |(_, turns)| *turns);
        arc(sine, cosine) + TAU * turns
    }

    fn root(&self, square: Dual2_64) -> Dual2_64 {
        self.avoid(square);
        square.sqrt()
    }
}

/// The angle of a point. The quotient is at most 1: that of the library has no derivatives where
/// the cosine vanishes.
fn arc(sine: Dual2_64, cosine: Dual2_64) -> Dual2_64 {
    let mut angle = if sine.re.abs() > cosine.re.abs() {
        -(cosine / sine).atan()
    } else {
        (sine / cosine).atan()
    };
    angle.re = sine.re.atan2(cosine.re);
    angle
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

//! Rotations as they are written, from body axes to global axes.

use syn::{Expr, ExprCall, parse_quote};

use super::formula::difference;
use super::reader::{Reader, place_of};
use crate::check::number::elements;
use crate::check::turning::Turn;
use crate::diag::{code, did_you_mean, list};
use crate::model::Number;
use crate::model::inertia::euler_parameters;
use crate::model::number::literals;
use crate::syntax::ungroup;

/// What makes a rotation, and how it is written.
const FORMS: [(&str, &str); 6] = [
    ("rotation", "rotation([1.0, 0.0, 0.0], deg(30.0))"),
    ("rpy", "rpy(roll, pitch, yaw)"),
    ("euler_zxz", "euler_zxz(precession, nutation, spin)"),
    ("bryant_xyz", "bryant_xyz(first, second, third)"),
    ("axes", "axes(x = [0.0, 1.0, 0.0], y = [0.0, 0.0, 1.0])"),
    ("along", "along(x, [0.0, 0.0, 0.0], [0.0, 0.5, 0.0])"),
];

/// Axes that are given together are perpendicular up to this cosine.
const PERPENDICULAR: f64 = 1e-6;

/// A word for an axis.
pub(super) const AXES: [&str; 3] = ["x", "y", "z"];

impl Reader<'_, '_> {
    /// Four Euler parameters, or a rotation by words.
    pub(super) fn orientation(&mut self, attribute: &str, expr: &Expr) -> Option<[Number; 4]> {
        self.at(attribute);
        match ungroup(expr) {
            Expr::Call(call) if is_call(call, "along") => {
                let parameters = self.along(call)?;
                self.euler_parameters(&parse_quote!([#(#parameters),*]))
            }
            Expr::Call(_) | Expr::Binary(_) => {
                let turn = self.turn(expr)?;
                Some(self.numbers.parameters(&turn))
            }
            _ if elements(expr).is_some() => self.euler_parameters(expr),
            _ => {
                self.faults.at(
                    expr,
                    "expected four Euler parameters, scalar first, as in `[1.0, 0.0, 0.0, 0.0]`, \
                     or `rotation([1.0, 0.0, 0.0], deg(30.0))`",
                );
                None
            }
        }
    }

    /// Four Euler parameters of any length but zero.
    fn euler_parameters(&mut self, expr: &Expr) -> Option<[Number; 4]> {
        let p: [Number; 4] = self.numbers.array(expr, self.faults)?;
        let Some(values) = self.numbers.all_seen(&p) else {
            return Some(p);
        };
        let norm = values.iter().map(|e| e * e).sum::<f64>().sqrt();
        if norm == 0.0 {
            let place = place_of(&p);
            self.faults.at(
                expr,
                format!("Euler parameters may be of any length but zero; these are zero{place}"),
            );
            return None;
        }
        Some(match literals(&p) {
            Some(values) => values.map(|e| Number::Literal(e / norm)),
            None => p,
        })
    }

    /// Unit Euler parameters of a rotation. Its angles may be parameters and constants by path.
    pub(super) fn turn(&mut self, expr: &Expr) -> Option<Turn> {
        match ungroup(expr) {
            Expr::Binary(binary) if matches!(binary.op, syn::BinOp::Mul(_)) => {
                let (left, right) = (self.turn(&binary.left), self.turn(&binary.right));
                Some(self.numbers.composed(&left?, &right?))
            }
            Expr::Call(call) => self.called(call),
            _ if elements(expr).is_some() => {
                let p = self.euler_parameters(expr)?;
                self.unit(expr, p)
            }
            _ => {
                let forms = FORMS.map(|(name, _)| name);
                self.faults.at(
                    expr,
                    format!(
                        "expected a rotation: {}, four Euler parameters, or a product of these, of which the last turns first",
                        list(forms)
                    ),
                );
                None
            }
        }
    }

    /// A rotation that the macro can see; `what` says what takes no other.
    pub(super) fn seen_turn(&mut self, what: &str, expr: &Expr) -> Option<[f64; 4]> {
        let seen = self.turn(expr)?.seen();
        if seen.is_none() {
            let message = format!(
                "{what} needs numbers that the macro can see: literals, their arithmetic, `PI` and `TAU`"
            );
            self.faults.at(expr, message);
        }
        seen
    }

    /// Euler parameters whose length the macro can see to be 1.
    fn unit(&mut self, at: impl quote::ToTokens, p: [Number; 4]) -> Option<Turn> {
        let seen = literals(&p);
        if seen.is_none() {
            self.unseen(at);
        }
        seen.map(Turn::Seen)
    }

    fn called(&mut self, call: &ExprCall) -> Option<Turn> {
        let found = code(&call.func);
        let Some((name, example)) = FORMS.iter().find(|(name, _)| is_call(call, name)) else {
            let known = FORMS.map(|(name, _)| name);
            let near = did_you_mean(&found, known);
            self.faults.at(
                call,
                format!("no rotation `{found}`; there are {}{near}", list(known)),
            );
            return None;
        };
        let arguments: Vec<&Expr> = call.args.iter().collect();
        match (*name, &arguments[..]) {
            ("rotation", [axis, angle]) => self.about(call, axis, angle),
            ("rpy", [roll, pitch, yaw]) => self.angles([(2, yaw), (1, pitch), (0, roll)]),
            ("euler_zxz", [a, b, c]) => self.angles([(2, a), (0, b), (2, c)]),
            ("bryant_xyz", [a, b, c]) => self.angles([(0, a), (1, b), (2, c)]),
            ("axes", [_, _]) => self.axes(call),
            ("along", [_, _, _]) => {
                let parameters = self.along(call)?;
                let p = self.euler_parameters(&parse_quote!([#(#parameters),*]))?;
                self.unit(call, p)
            }
            _ => {
                self.faults
                    .at(call, format!("expected `{name}(..)`, as in `{example}`"));
                None
            }
        }
    }

    fn unseen(&mut self, at: impl quote::ToTokens) {
        self.faults.at(
            at,
            "here the macro has to see the numbers: literals, their arithmetic, `PI` and `TAU`; parameters and constants may be the angles of \
             `rotation`, `rpy`, `euler_zxz` and `bryant_xyz`",
        );
    }

    fn about(&mut self, call: &ExprCall, axis: &Expr, angle: &Expr) -> Option<Turn> {
        let vector = self.numbers.vector(axis, self.faults);
        let half = self.half(angle);
        let (vector, [cosine, sine]) = (vector?, half?);
        let Some(vector) = literals(&vector) else {
            self.unseen(call);
            return None;
        };
        let length = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length == 0.0 {
            self.faults
                .at(axis, "the axis of a rotation must not be the zero vector");
            return None;
        }
        if let (Some(cosine), Some(sine)) = (cosine.literal(), sine.literal()) {
            let [x, y, z] = vector.map(|component| sine * component / length);
            return Some(Turn::Seen([cosine, x, y, z]));
        }
        let along = vector.map(|component| component / length);
        let [x, y, z] =
            along.map(|component| self.numbers.linear([component], [sine], Number::ZERO));
        Some(self.numbers.turn([cosine, x, y, z]))
    }

    /// The cosine and the sine of half an angle.
    fn half(&mut self, angle: &Expr) -> Option<[Number; 2]> {
        if let Some(size) = self.numbers.scalar(angle, self.faults)?.literal() {
            let (sine, cosine) = (0.5 * size).sin_cos();
            return Some([cosine, sine].map(Number::Literal));
        }
        let [cosine, sine]: [Expr; 2] = [
            parse_quote!(cos(0.5 * (#angle))),
            parse_quote!(sin(0.5 * (#angle))),
        ];
        let cosine = self.numbers.scalar(&cosine, self.faults);
        let sine = self.numbers.scalar(&sine, self.faults);
        Some([cosine?, sine?])
    }

    /// Turns about axes, of which the first written turns last.
    fn angles(&mut self, turns: [(usize, &Expr); 3]) -> Option<Turn> {
        let halves = turns.map(|(_, angle)| self.half(angle));
        let mut whole = Turn::NONE;
        for ((axis, _), half) in turns.into_iter().zip(halves) {
            let [cosine, sine] = half?;
            let mut turn = [cosine, Number::ZERO, Number::ZERO, Number::ZERO];
            turn[axis + 1] = sine;
            whole = self.numbers.composed(&whole, &self.numbers.turn(turn));
        }
        Some(whole)
    }

    /// `axes(x = .., y = ..)`: two body axes in global axes.
    fn axes(&mut self, call: &ExprCall) -> Option<Turn> {
        let mut columns: [Option<[f64; 3]>; 3] = [None; 3];
        for argument in &call.args {
            let (axis, given) = self.assigned(argument)?;
            let vector = self.numbers.vector(given, self.faults)?;
            let Some(vector) = literals(&vector) else {
                self.unseen(call);
                return None;
            };
            let length = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
            if length == 0.0 || columns[axis].is_some() {
                let message = "`axes` takes two different axes, neither of which is zero";
                self.faults.at(argument, message);
                return None;
            }
            columns[axis] = Some(vector.map(|x| x / length));
        }
        let third = (0..3).find(|&k| columns[k].is_none())?;
        let (k, l) = ((third + 1) % 3, (third + 2) % 3);
        let (a, b) = (columns[k]?, columns[l]?);
        let cosine: f64 = (0..3).map(|m| a[m] * b[m]).sum();
        if cosine.abs() > PERPENDICULAR {
            let angle = cosine.acos().to_degrees();
            self.faults.at(
                call,
                format!("axes of a body are perpendicular; between these are {angle:.4} degrees"),
            );
            return None;
        }
        columns[third] = Some(cross(a, b));
        let columns = [columns[0]?, columns[1]?, columns[2]?];
        let rows = [0, 1, 2].map(|row| columns.map(|column| column[row]));
        Some(Turn::Seen(euler_parameters(rows)))
    }

    /// `x = [..]`.
    fn assigned<'e>(&mut self, argument: &'e Expr) -> Option<(usize, &'e Expr)> {
        if let Expr::Assign(assign) = argument
            && let Some(axis) = axis_of(&assign.left)
        {
            return Some((axis, &assign.right));
        }
        let message = "expected an axis and its direction, as in `x = [0.0, 1.0, 0.0]`";
        self.faults.at(argument, message);
        None
    }

    /// `along(x, from, to)`: Euler parameters of any length.
    fn along(&mut self, call: &ExprCall) -> Option<[Expr; 4]> {
        let arguments: Vec<&Expr> = call.args.iter().collect();
        let [axis, from, to] = arguments[..] else {
            let [.., (_, example)] = FORMS;
            self.faults
                .at(call, format!("expected `along(..)`, as in `{example}`"));
            return None;
        };
        let Some(axis) = axis_of(axis) else {
            self.faults
                .at(axis, "expected an axis of the body: `x`, `y` or `z`");
            return None;
        };
        let (from, to) = (self.components(from), self.components(to));
        let (from, to) = (from?, to?);
        let d = [0, 1, 2].map(|k| difference(&to[k], &from[k]));
        self.leading(call, axis, &d)
    }

    /// Three expressions in brackets, each of which is a number.
    pub(super) fn components(&mut self, expr: &Expr) -> Option<[Expr; 3]> {
        let found = elements(expr).unwrap_or_default();
        if found.len() != 3 {
            // The sentence about it.
            self.numbers.vector(expr, self.faults)?;
        }
        let parts: Vec<_> = found
            .iter()
            .map(|part| self.numbers.part(part, self.faults))
            .collect();
        parts.into_iter().collect::<Option<Vec<_>>>()?;
        let components: Vec<Expr> = found.into_iter().cloned().collect();
        components.try_into().ok()
    }

    /// A number as the macro sees it.
    pub(super) fn glance(&mut self, expr: &Expr) -> Option<f64> {
        self.numbers.part(expr, self.faults)?.seen
    }
}

pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn axis_of(expr: &Expr) -> Option<usize> {
    let Expr::Path(path) = ungroup(expr) else {
        return None;
    };
    AXES.iter().position(|axis| path.path.is_ident(axis))
}

/// Whether a call is one of a word.
pub(super) fn is_call(call: &ExprCall, word: &str) -> bool {
    matches!(ungroup(&call.func), Expr::Path(path) if path.path.is_ident(word))
}

//! Laws: functions that a mechanism writes, of the time and of the arguments that a definition
//! names.

use proc_macro2::{Ident, TokenStream, TokenTree};
use quote::ToTokens;
use syn::{BinOp, Expr, UnOp};

use super::elements::Found;
use super::functions::TANGENT;
use super::number::Numbers;
use super::readings::Readings;
use super::switching::{SWITCHING, is_switching};
use super::tables::Called;
use crate::diag::{Faults, code, did_you_mean, list};
use crate::model::{Curve, Function, LawTerm, Number};
use crate::syntax::ungroup;

/// Reads a law.
pub(super) struct LawReader<'a, 'b, 'c> {
    pub(super) arguments: &'a [Ident],
    pub(super) numbers: &'b mut Numbers<'c>,
    /// What can be read of joints and forces: in rates of states.
    pub(super) readings: Option<&'a Readings<'a>>,
    /// Why the law may not switch; `None` where it may.
    pub(super) no_switches: Option<&'static str>,
}

impl LawReader<'_, '_, '_> {
    pub(super) fn read(&mut self, expr: &Expr, faults: &mut Faults) -> Option<LawTerm> {
        let is_number = matches!(
            ungroup(expr),
            Expr::Lit(_)
                | Expr::Unary(_)
                | Expr::Binary(_)
                | Expr::Call(_)
                | Expr::Path(_)
                | Expr::Index(_)
                | Expr::Field(_)
        );
        if is_number && !self.varies(expr) {
            return self.numbers.scalar(expr, faults).map(LawTerm::Number);
        }
        if !self.is_own(expr)
            && let Some(state) = self.numbers.state(expr, faults)
        {
            return self.state(state, expr, faults);
        }
        match ungroup(expr) {
            Expr::Field(field) if self.is_reading(expr) => {
                let readings = self.readings?;
                readings.read(field, &self.numbers.field, faults)
            }
            Expr::Index(_) | Expr::Field(_) if self.numbers.setpoint(expr).is_some() => {
                let input = self.numbers.setpoint(expr)?;
                Some(LawTerm::Setpoint(self.numbers.derivatives(input, expr)))
            }
            Expr::Path(path) => {
                let name = path.path.get_ident()?;
                let place = self.arguments.iter().position(|argument| argument == name);
                if let (None, Some(input)) = (place, self.numbers.setpoint(expr)) {
                    return Some(LawTerm::Setpoint(self.numbers.derivatives(input, expr)));
                }
                let scope = self.numbers.field.parts();
                let mut fields = self.numbers.values.iter().map(|value| &value.name);
                if fields.any(|field| field.field() == name && field.parts() == scope) {
                    faults.at(
                        name,
                        format!(
                            "`{name}` is an argument of this law, and a field of the mechanism; take another name for the field"
                        ),
                    );
                }
                Some(place.map_or(LawTerm::Time, LawTerm::Argument))
            }
            Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => {
                let inner = self.read(&unary.expr, faults)?;
                Some(LawTerm::Sum(vec![(true, inner)]))
            }
            Expr::Binary(binary) => {
                let left = self.read(&binary.left, faults);
                let right = self.read(&binary.right, faults);
                let (left, right) = (left?, right?);
                match binary.op {
                    BinOp::Add(_) => Some(LawTerm::Sum(vec![(false, left), (false, right)])),
                    BinOp::Sub(_) => Some(LawTerm::Sum(vec![(false, left), (true, right)])),
                    BinOp::Mul(_) => Some(LawTerm::Product(Box::new(left), Box::new(right))),
                    BinOp::Div(_) => {
                        let divisor = LawTerm::Function(Function::Reciprocal, Box::new(right));
                        Some(LawTerm::Product(Box::new(divisor), Box::new(left)))
                    }
                    op => {
                        super::refuse_operator(&op, faults);
                        None
                    }
                }
            }
            Expr::Call(call) => self.call(call, faults),
            Expr::If(choice) => self.choice(choice, faults),
            other => {
                let more = match other {
                    Expr::Match(_) => "; from one value to another leads `smooth_step`",
                    _ => "",
                };
                faults.at(
                    other,
                    format!(
                        "expected an expression of {} and numbers: `+`, `-`, `*`, `/`, {}{more}",
                        self.words(),
                        list(self.functions())
                    ),
                );
                None
            }
        }
    }

    /// Whether it is the time or an argument, whatever else has that name.
    fn is_own(&self, expr: &Expr) -> bool {
        let Expr::Path(path) = ungroup(expr) else {
            return false;
        };
        let name = path.path.get_ident();
        name.is_some_and(|name| name == "time" || self.arguments.contains(name))
    }

    /// A state of the user's own.
    fn state(&self, found: Found, expr: &Expr, faults: &mut Faults) -> Option<LawTerm> {
        let Found::At(place) = found else { return None };
        if let Some(reason) = self.numbers.no_inputs {
            let name = code(expr);
            let (reason, _) = reason.split_once(';').unwrap_or((reason, ""));
            faults.at(
                expr,
                format!("`{name}` is a state, which changes in time: {reason}"),
            );
            return None;
        }
        Some(LawTerm::State(place))
    }

    /// Whether a path with a `.` is a reading of a joint or force, and no number of a part.
    fn is_reading(&self, expr: &Expr) -> bool {
        let is_field = matches!(ungroup(expr), Expr::Field(_));
        self.readings.is_some() && is_field && !self.numbers.is_value(expr)
    }

    fn call(&mut self, call: &syn::ExprCall, faults: &mut Faults) -> Option<LawTerm> {
        let name = code(&call.func);
        let mut switching = SWITCHING.into_iter();
        if let Some(switching) = switching.find(|(known, _)| *known == name) {
            return self.switch(call, switching, faults);
        }
        if name == "atan2" {
            let [sine, cosine] = call.args.iter().collect::<Vec<_>>()[..] else {
                let found = call.args.len();
                faults.at(call, format!("`{name}` takes 2 numbers; found {found}"));
                return None;
            };
            let (sine, cosine) = (self.read(sine, faults), self.read(cosine, faults));
            return Some(LawTerm::Direction(Box::new(sine?), Box::new(cosine?)));
        }
        let function = match Function::named(&name) {
            Some(function) => Some(function),
            None => match self.numbers.spline(&call.func, faults) {
                Called::Spline(spline) => Some(Function::Curve(Curve {
                    spline,
                    derivative: 0,
                })),
                Called::Nothing => None,
                Called::Refused => return None,
            },
        };
        let Some(function) = function else {
            let known = self.functions();
            let splines = self.numbers.spline_names();
            let all = known
                .iter()
                .copied()
                .chain(splines.iter().map(String::as_str));
            let near = match name.as_str() {
                "tan" => TANGENT.to_string(),
                _ => did_you_mean(&name, all),
            };
            faults.at(
                &call.func,
                format!(
                    "no function `{name}` of {}; there are {}{near}",
                    self.words(),
                    list(known)
                ),
            );
            return None;
        };
        let [argument] = call.args.iter().collect::<Vec<_>>()[..] else {
            let found = call.args.len();
            faults.at(call, format!("`{name}` takes 1 number; found {found}"));
            return None;
        };
        let term = self.read(argument, faults)?;
        if let LawTerm::Number(Number::Literal(value)) = term
            && let Some(refusal) = function.refusal(&name, value)
        {
            faults.at(argument, refusal);
            return None;
        }
        Some(LawTerm::Function(function, Box::new(term)))
    }

    /// The functions that a law may call.
    fn functions(&self) -> Vec<&'static str> {
        let named = Function::NAMED
            .map(|(name, _)| name)
            .into_iter()
            .chain(["atan2"]);
        let switching = SWITCHING.map(|(name, _)| name).into_iter();
        let may_switch = self.no_switches.is_none();
        named.chain(switching.filter(|_| may_switch)).collect()
    }

    /// "`time` and `length`".
    fn words(&self) -> String {
        let arguments = self.arguments.iter().map(ToString::to_string);
        list(std::iter::once("time".to_string()).chain(arguments))
    }

    /// Whether an expression speaks of the time, of an argument, of a state or of a reading.
    fn varies(&self, expr: &Expr) -> bool {
        if self.numbers.is_state(expr) || self.is_reading(expr) || is_switching(expr) {
            return true;
        }
        match ungroup(expr) {
            Expr::Path(_) => self.is_own(expr) || self.numbers.setpoint(expr).is_some(),
            Expr::Index(_) | Expr::Field(_) if self.numbers.setpoint(expr).is_some() => true,
            Expr::Unary(unary) => self.varies(&unary.expr),
            Expr::Binary(binary) => self.varies(&binary.left) || self.varies(&binary.right),
            Expr::Call(call) => {
                call.args.iter().any(|argument| self.varies(argument))
                    || matches!(
                        code(&call.func).as_str(),
                        "smooth_step" | "asin" | "acos" | "atan" | "atan2"
                    )
            }
            other => self.mentioned(other.to_token_stream()),
        }
    }

    /// Whether tokens that are no expression of the language speak of the time or of an argument.
    fn mentioned(&self, tokens: TokenStream) -> bool {
        tokens.into_iter().any(|token| match token {
            TokenTree::Group(group) => self.mentioned(group.stream()),
            TokenTree::Ident(name) => name == "time" || self.arguments.contains(&name),
            _ => false,
        })
    }
}

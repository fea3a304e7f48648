//! Functions in the expressions of definitions.

use syn::{Expr, ExprCall};

use super::expression::{Context, Shaped, value};
use super::switching::SWITCHING;
use crate::diag::{Faults, code, did_you_mean, list};
use crate::model::{ElementKind, Function, ParameterKind, Term, Turn};
use crate::syntax::ungroup;

/// The functions of vectors and of states, beside those of numbers.
const FUNCTIONS: [&str; 10] = [
    "dot",
    "cross",
    "squared",
    "length",
    "angle",
    "fixed",
    "initial",
    "rate",
    "angular_velocity",
    "atan2",
];

/// What stands for a function that is no other one misspelt.
pub(super) const TANGENT: &str = "; a tangent is `sin(x) / cos(x)`";

impl Function {
    /// Why a number has no value of a function of this name; `None` where it has one.
    pub(super) fn refusal(self, name: &str, x: f64) -> Option<String> {
        let is_beyond = matches!(self, Self::ArcSine | Self::ArcCosine) && x.abs() > 1.0;
        is_beyond.then(|| format!("`{name}` takes a number from -1 to 1; this is {x}"))
    }
}

impl Context<'_> {
    pub(super) fn call(&self, call: &ExprCall, faults: &mut Faults) -> Option<Shaped> {
        let name = code(&call.func);
        if let Some(parameter) = self
            .parameters
            .iter()
            .position(|p| p.name == name && p.kind == ParameterKind::Law)
        {
            return self.law(call, parameter, faults);
        }
        if let Some(function) = Function::named(&name) {
            let [argument] = self.arguments::<1>(call, "1 number", faults)?;
            let term = self.argument(&name, argument, faults)?;
            if let Some(refusal) = value(&term).and_then(|value| function.refusal(&name, value)) {
                faults.at(argument, refusal);
                return None;
            }
            return Some(Shaped::scalar(Term::Function(function, Box::new(term))));
        }
        match name.as_str() {
            "dot" | "cross" => {
                let [a, b] = self.arguments::<2>(call, "2 vectors", faults)?;
                let (a, b) = (
                    self.of_vectors(&name, a, faults),
                    self.of_vectors(&name, b, faults),
                );
                let vector = name == "cross";
                let make = if vector { Term::Cross } else { Term::Dot };
                self.pairwise(call, a?, b?, vector, faults, make)
            }
            "squared" | "length" => {
                let [a] = self.arguments::<1>(call, "1 vector", faults)?;
                let a = self.of_vectors(&name, a, faults)?;
                let again = self.repeated(&a, call, faults)?;
                let mut squared = self.pairwise(call, a, again, false, faults, Term::Dot)?;
                if name == "length" {
                    let root = |term| Term::Function(Function::SquareRoot, Box::new(term));
                    squared.terms = squared.terms.into_iter().map(root).collect();
                }
                Some(squared)
            }
            "angle" => self.angle(call, faults),
            "atan2" => self.direction_of(call, faults),
            "fixed" => self.fixed(call, faults),
            "initial" => {
                let [argument] = self.arguments::<1>(call, "1 number", faults)?;
                let argument = self.expression(argument, faults)?;
                if argument.vector {
                    faults.at(
                        call,
                        "`initial` takes a scalar; for a vector write `fixed(i, ..)`, which fixes it on a body",
                    );
                    return None;
                }
                self.is_of_configuration(call, &argument, faults)?;
                let initial = |term| Term::Initial(Box::new(term));
                Some(Shaped {
                    vector: false,
                    terms: argument.terms.into_iter().map(initial).collect(),
                })
            }
            "rate" => self.rate(call, faults),
            "angular_velocity" => self.angular_velocity(call, faults),
            _ => {
                let laws = self
                    .parameters
                    .iter()
                    .filter(|p| p.kind == ParameterKind::Law);
                let laws: Vec<String> = laws.map(|p| p.name.to_string()).collect();
                let known: Vec<&str> = FUNCTIONS
                    .into_iter()
                    .chain(Function::NAMED.map(|(name, _)| name))
                    .chain(laws.iter().map(String::as_str))
                    .collect();
                let mut near = did_you_mean(&name, known.iter().copied());
                if name == "tan" {
                    near = TANGENT.to_string();
                }
                if SWITCHING.iter().any(|(switching, _)| *switching == name) {
                    near = match self.kind {
                        ElementKind::Force => "; it stands in laws, which a mechanism gives: take a parameter that is a `Law`",
                        ElementKind::Joint => "; the equations of a joint have two derivatives",
                    }
                    .to_string();
                }
                faults.at(
                    &call.func,
                    format!("no function `{name}`; there are {}{near}", list(known)),
                );
                None
            }
        }
    }

    fn arguments<'a, const N: usize>(
        &self,
        call: &'a ExprCall,
        wanted: &str,
        faults: &mut Faults,
    ) -> Option<[&'a Expr; N]> {
        let arguments: Vec<&Expr> = call.args.iter().collect();
        let found = arguments.len();
        let arguments = arguments.try_into().ok();
        if arguments.is_none() {
            let name = code(&call.func);
            faults.at(call, format!("`{name}` takes {wanted}; found {found}"));
        }
        arguments
    }

    fn of_vectors(&self, name: &str, expr: &Expr, faults: &mut Faults) -> Option<Shaped> {
        let argument = self.expression(expr, faults)?;
        if !argument.vector {
            faults.at(
                expr,
                format!("`{name}` takes vectors; this is {}", argument.name()),
            );
            return None;
        }
        Some(argument)
    }

    fn angle(&self, call: &ExprCall, faults: &mut Faults) -> Option<Shaped> {
        let [from, to, axis] = self.arguments::<3>(
            call,
            "two bodies and an axis, as in `angle(i, j, axis)`",
            faults,
        )?;
        let (from, to) = (self.body(from, faults), self.body(to, faults));
        let axis = match ungroup(axis) {
            Expr::Path(path) if path.path.get_ident().is_some() => path
                .path
                .get_ident()
                .and_then(|name| self.axis(name, faults)),
            other => {
                faults.at(
                    other,
                    "expected the name of an axis, as in `angle(i, j, axis)`",
                );
                None
            }
        };
        let turn = Turn {
            from: from?,
            to: to?,
            axis: axis?,
        };
        if turn.from == turn.to {
            faults.at(call, "the angle of a body against itself is zero");
            return None;
        }
        Some(Shaped::scalar(Term::Angle(turn)))
    }

    fn direction_of(&self, call: &ExprCall, faults: &mut Faults) -> Option<Shaped> {
        let [sine, cosine] = self.arguments::<2>(call, "2 numbers", faults)?;
        let (sine, cosine) = (
            self.argument("atan2", sine, faults),
            self.argument("atan2", cosine, faults),
        );
        let (sine, cosine) = (Box::new(sine?), Box::new(cosine?));
        Some(Shaped::scalar(Term::Direction(sine, cosine)))
    }

    fn fixed(&self, call: &ExprCall, faults: &mut Faults) -> Option<Shaped> {
        let [body, vector] = self.arguments::<2>(call, "a body and a vector", faults)?;
        let (body, vector) = (
            self.body(body, faults),
            self.of_vectors("fixed", vector, faults),
        );
        let (body, vector) = (body?, vector?);
        self.is_of_configuration(call, &vector, faults)?;
        let onto = |term| Term::Onto(body, Box::new(term));
        Some(Shaped {
            vector: true,
            terms: vector.terms.into_iter().map(onto).collect(),
        })
    }

    fn rate(&self, call: &ExprCall, faults: &mut Faults) -> Option<Shaped> {
        let [argument] = self.arguments::<1>(call, "1 number or vector", faults)?;
        let argument = self.expression(argument, faults)?;
        if argument.terms.iter().any(|term| term.has(Term::is_rate)) {
            faults.at(
                call,
                "there is no rate of a rate: accelerations are what is solved for",
            );
            return None;
        }
        let rate = |term| Term::Rate(Box::new(term));
        Some(Shaped {
            vector: argument.vector,
            terms: argument.terms.into_iter().map(rate).collect(),
        })
    }

    fn angular_velocity(&self, call: &ExprCall, faults: &mut Faults) -> Option<Shaped> {
        if call.args.len() == 1 {
            let to = self.body(&call.args[0], faults)?;
            return Some(Shaped::vector(Term::Spin { from: None, to }));
        }
        let wanted = "one body, or two as in `angular_velocity(i, j)`";
        let [from, to] = self.arguments::<2>(call, wanted, faults)?;
        let (from, to) = (self.body(from, faults), self.body(to, faults));
        let (from, to) = (from?, to?);
        if from == to {
            faults.at(
                call,
                "the angular velocity of a body against itself is zero",
            );
            return None;
        }
        let from = Some(from);
        Some(Shaped::vector(Term::Spin { from, to }))
    }

    fn law(&self, call: &ExprCall, parameter: usize, faults: &mut Faults) -> Option<Shaped> {
        let names = &self.parameters[parameter].arguments;
        if call.args.len() != names.len() {
            let (name, found) = (code(&call.func), call.args.len());
            let wanted = match names.as_slice() {
                [] => "nothing in its parentheses: the law that a mechanism writes knows `time`"
                    .into(),
                [only] => format!("1 number, `{only}`"),
                several => format!("{} numbers, {}", several.len(), list(several)),
            };
            faults.at(call, format!("`{name}` takes {wanted}; found {found}"));
            return None;
        }
        let arguments: Vec<Option<Term>> = call
            .args
            .iter()
            .map(|argument| self.argument(&code(&call.func), argument, faults))
            .collect();
        Some(Shaped::scalar(Term::Law {
            parameter,
            arguments: arguments.into_iter().collect::<Option<_>>()?,
        }))
    }

    /// Refuses what has no value in the reference configuration.
    fn is_of_configuration(
        &self,
        call: &ExprCall,
        argument: &Shaped,
        faults: &mut Faults,
    ) -> Option<()> {
        let moving = |term: &Term| term.is_rate() || matches!(term, Term::Time | Term::Law { .. });
        if argument.terms.iter().any(|term| term.has(moving)) {
            let name = code(&call.func);
            faults.at(
                call,
                format!(
                    "`{name}` is what something is in the reference configuration, which knows no time, no rates and no laws"
                ),
            );
            return None;
        }
        Some(())
    }
}

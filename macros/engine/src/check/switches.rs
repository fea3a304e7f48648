//! Laws that switch: `sign`, `abs`, `min`, `max` and `if`, and the switches of a mechanism.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};
use syn::{BinOp, Expr, ExprIf, UnOp};

use super::later::{Later, Value};
use super::laws::LawReader;
use super::number::Numbers;
use crate::diag::{Faults, code};
use crate::model::{
    Action, Binding, Element, ElementDef, LawTerm, Number, Switch, Switching, Term, UserState,
    first_further, law::place,
};
use crate::syntax::array::only;
use crate::syntax::ungroup;
use crate::syntax::words::local;

/// A condition of an `if`.
enum Condition {
    /// An expression is negative.
    Negative(Switching),
    Not(Box<Condition>),
    And(Box<Condition>, Box<Condition>),
    Or(Box<Condition>, Box<Condition>),
}

/// How often an `if` may repeat one of its laws.
const COPIES: f64 = 64.0;

impl Condition {
    /// How often a choice repeats the first law, and the second.
    fn copies(&self) -> [f64; 2] {
        match self {
            Self::Negative(_) => [1.0, 1.0],
            Self::Not(inner) => {
                let [first, second] = inner.copies();
                [second, first]
            }
            Self::And(a, b) => {
                let ([a, not_a], [b, not_b]) = (a.copies(), b.copies());
                [a * b, a * not_b + not_a]
            }
            Self::Or(a, b) => {
                let ([a, not_a], [b, not_b]) = (a.copies(), b.copies());
                [a + not_a * b, not_a * not_b]
            }
        }
    }

    /// The first law where the condition is met, else the second.
    fn choose(self, first: LawTerm, second: LawTerm) -> LawTerm {
        match self {
            Self::Negative(switching) => select(switching, second, first),
            Self::Not(inner) => inner.choose(second, first),
            Self::And(a, b) => a.choose(b.choose(first, second.clone()), second),
            Self::Or(a, b) => a.choose(first.clone(), b.choose(first, second)),
        }
    }
}

/// The first law where an expression is not negative, else the second.
fn select(switching: Switching, first: LawTerm, second: LawTerm) -> LawTerm {
    LawTerm::Select(Box::new(switching), Box::new([first, second]))
}

/// `a - b`, as it was written.
fn difference(a: (LawTerm, &Expr), b: (LawTerm, &Expr)) -> Switching {
    let is_zero = |law: &LawTerm| matches!(law, LawTerm::Number(Number::Literal(0.0)));
    let ((a, left), (b, right)) = (a, b);
    let (left, right) = (code(left), in_a_difference(right));
    if is_zero(&b) {
        return Switching { of: a, text: left };
    }
    if is_zero(&a) {
        let of = LawTerm::Sum(vec![(true, b)]);
        let text = format!("-{right}");
        return Switching { of, text };
    }
    Switching {
        of: LawTerm::Sum(vec![(false, a), (true, b)]),
        text: format!("{left} - {right}"),
    }
}

/// What is subtracted: a sum, or a number with a sign, stands in parentheses.
fn in_a_difference(expr: &Expr) -> String {
    let is_sum = match ungroup(expr) {
        Expr::Binary(binary) => matches!(binary.op, BinOp::Add(_) | BinOp::Sub(_)),
        Expr::Unary(_) | Expr::If(_) => true,
        _ => false,
    };
    let text = code(expr);
    if is_sum && !text.starts_with('(') {
        format!("({text})")
    } else {
        text
    }
}

impl LawReader<'_, '_, '_> {
    /// Refuses what switches, where it may not stand.
    fn may_switch(&self, word: &str, at: impl ToTokens, faults: &mut Faults) -> Option<()> {
        let Some(reason) = self.no_switches else {
            return Some(());
        };
        let (key, name) = (&self.numbers.attribute, &self.numbers.field);
        faults.at(
            at,
            format!("`{word}` cannot stand in `{key}` of `{name}`: {reason}"),
        );
        None
    }

    /// A call of a function that switches.
    pub(super) fn switch(
        &mut self,
        call: &syn::ExprCall,
        (name, count): (&str, usize),
        faults: &mut Faults,
    ) -> Option<LawTerm> {
        self.may_switch(name, call, faults)?;
        let found = call.args.len();
        if found != count {
            let wanted = super::joints::plural(count, "number", "numbers");
            faults.at(call, format!("`{name}` takes {wanted}; found {found}"));
            return None;
        }
        let arguments: Vec<Option<LawTerm>> = call
            .args
            .iter()
            .map(|argument| self.read(argument, faults))
            .collect();
        let arguments: Vec<LawTerm> = arguments.into_iter().collect::<Option<_>>()?;
        let mut both = arguments.into_iter().zip(&call.args);
        let first = both.next()?;
        if let Some(second) = both.next() {
            let (a, b) = (first.0.clone(), second.0.clone());
            let switching = difference(first, second);
            return Some(match name {
                "min" => select(switching, b, a),
                _ => select(switching, a, b),
            });
        }
        let (of, expr) = first;
        let text = code(expr);
        let side = LawTerm::Side(Box::new(Switching {
            of: of.clone(),
            text,
        }));
        Some(match name {
            "abs" => LawTerm::Product(Box::new(side), Box::new(of)),
            _ => side,
        })
    }

    /// A law that is one of two.
    pub(super) fn choice(&mut self, choice: &ExprIf, faults: &mut Faults) -> Option<LawTerm> {
        self.may_switch("if", choice, faults)?;
        let condition = self.condition(&choice.cond, faults);
        let then = only(&choice.then_branch, faults).and_then(|then| self.read(then, faults));
        let Some((_, otherwise)) = &choice.else_branch else {
            faults.at(
                choice.if_token,
                "an `if` needs an `else` here: a law has a value at all times",
            );
            return None;
        };
        let otherwise = match &**otherwise {
            Expr::Block(block) => only(&block.block, faults),
            other => Some(other),
        };
        let otherwise = otherwise.and_then(|otherwise| self.read(otherwise, faults));
        let condition = condition?;
        if condition.copies().iter().any(|&copies| copies > COPIES) {
            faults.at(
                &choice.cond,
                "this condition has too many alternatives; make several forces of it, each with one of its own",
            );
            return None;
        }
        Some(condition.choose(then?, otherwise?))
    }

    fn condition(&mut self, expr: &Expr, faults: &mut Faults) -> Option<Condition> {
        match ungroup(expr) {
            Expr::Unary(unary) if matches!(unary.op, UnOp::Not(_)) => {
                let inner = self.condition(&unary.expr, faults)?;
                Some(Condition::Not(Box::new(inner)))
            }
            Expr::Binary(binary) => {
                let (left, right) = (&*binary.left, &*binary.right);
                if let BinOp::And(_) | BinOp::Or(_) = binary.op {
                    let first = self.condition(left, faults);
                    let second = self.condition(right, faults);
                    let (first, second) = (Box::new(first?), Box::new(second?));
                    return Some(match binary.op {
                        BinOp::And(_) => Condition::And(first, second),
                        _ => Condition::Or(first, second),
                    });
                }
                if let BinOp::Eq(equal) = binary.op {
                    faults.at(
                        equal,
                        "two numbers of a law are equal at instants only: compare by `<`, `<=`, `>` or `>=`",
                    );
                    return None;
                }
                // `a < b` where `a - b` is negative, `a > b` where `b - a` is.
                let (is_turned, is_negated) = match binary.op {
                    BinOp::Lt(_) => (false, false),
                    BinOp::Ge(_) => (false, true),
                    BinOp::Gt(_) => (true, false),
                    BinOp::Le(_) => (true, true),
                    _ => return refuse_condition(expr, faults),
                };
                let a = self.read(left, faults);
                let b = self.read(right, faults);
                let (a, b) = ((a?, left), (b?, right));
                let switching = if is_turned {
                    difference(b, a)
                } else {
                    difference(a, b)
                };
                let negative = Condition::Negative(switching);
                Some(match is_negated {
                    true => Condition::Not(Box::new(negative)),
                    false => negative,
                })
            }
            _ => refuse_condition(expr, faults),
        }
    }
}

fn refuse_condition(expr: &Expr, faults: &mut Faults) -> Option<Condition> {
    faults.at(
        expr,
        "expected a comparison of two numbers, such as `time < 2.0`, or several joined by `&&` and `||`",
    );
    None
}

/// The switches of forces, which stand behind so many joints, and of rates of states: each behind
/// those that its expression holds.
pub(super) fn switches(
    (joints, forces): (usize, &[Element]),
    definitions: &[ElementDef],
    states: &[UserState],
    numbers: &mut Numbers<'_>,
) -> Vec<Switch> {
    let mut found = Vec::new();
    for (place, force) in (joints..).zip(forces) {
        let actions = definitions[force.definition].actions.iter();
        for term in actions.flat_map(Action::terms) {
            term.visit(&mut |term| {
                if let Term::Law {
                    parameter,
                    arguments,
                } = term
                    && let Binding::Law(law) = &force.bindings[*parameter]
                {
                    numbers.field = force.name.clone();
                    add((law, law), Some((place, arguments)), numbers, &mut found);
                }
            });
        }
    }
    for state in states {
        numbers.field = state.name.clone();
        add((&state.rate, &state.rate), None, numbers, &mut found);
    }
    found
}

/// Adds those of a part of a law.
fn add(
    (part, law): (&LawTerm, &LawTerm),
    arguments: Option<(usize, &[Term])>,
    numbers: &mut Numbers<'_>,
    found: &mut Vec<Switch>,
) {
    for part in part.parts() {
        add((part, law), arguments, numbers, found);
    }
    let Some(Switching { of, text }) = part.switching() else {
        return;
    };
    let takes = of.has(&|term| matches!(term, LawTerm::Argument(_)));
    let moves =
        takes || of.has(&|term| matches!(term, LawTerm::State(_) | LawTerm::Reading { .. }));
    let has_time = of.has(&|term| matches!(term, LawTerm::Time));
    // What no run changes by itself has the side that it has.
    if !moves && !has_time {
        return;
    }
    let is_continuous = law.is_continuous_at(of);
    if let Some((place, _)) = place(found, arguments, of) {
        found[place].is_continuous &= is_continuous;
        return;
    }
    let place = first_further(&numbers.values, numbers.values.len()) + found.len();
    found.push(Switch {
        owner: numbers.field.clone(),
        text: text.clone(),
        arguments: arguments
            .filter(|_| takes)
            .map(|(place, terms)| (place, terms.to_vec())),
        of: of.clone(),
        held: numbers.side(place),
        is_of_time: !moves,
        is_continuous,
    });
}

impl Numbers<'_> {
    /// The side of a switch, by its place among the parameters: an input that no field has.
    fn side(&mut self, place: usize) -> Number {
        self.attribute = "side".into();
        let (parameters, marked) = (local("parameters"), place as f64);
        let later = Later {
            // It tells one from another, and is zero.
            expression: quote!((0.0_f64 * #marked)),
            scalar: Some(quote!(#parameters[#place])),
            is_const: false,
            is_varying: true,
            values: Vec::new(),
            like: None,
        };
        let span = TokenStream::new();
        self.number(Value::Later(later), syn::spanned::Spanned::span(&span))
    }
}

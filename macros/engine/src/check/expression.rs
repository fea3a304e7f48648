//! Expressions of definitions: names bound, shapes checked.

use std::cell::Cell;

use proc_macro2::Ident;
use quote::ToTokens;
use syn::{BinOp, Expr, Member, UnOp};

use super::number::{in_range, literal};
use crate::diag::{Faults, code, did_you_mean, list};
use crate::model::{ElementKind, Extent, Function, Parameter, ParameterKind, Term};
use crate::syntax::ungroup;

/// Words that begin statements, or join two halves of one.
const STATEMENTS: [&str; 10] = [
    "along",
    "angle",
    "contact",
    "displacement",
    "drive",
    "force",
    "moment",
    "motion",
    "potential",
    "require",
];

/// Makes a term of two.
pub(super) type Make = fn(Box<Term>, Box<Term>) -> Term;

/// One or two terms of one shape: the normals of an axis are two vectors, and what is made of them
/// is twofold too.
#[derive(Clone, Debug)]
pub(super) struct Shaped {
    pub(super) vector: bool,
    pub(super) terms: Vec<Term>,
}

impl Shaped {
    pub(super) fn scalar(term: Term) -> Self {
        Self {
            vector: false,
            terms: vec![term],
        }
    }

    pub(super) fn vector(term: Term) -> Self {
        Self {
            vector: true,
            terms: vec![term],
        }
    }

    pub(super) fn name(&self) -> &'static str {
        match (self.vector, self.terms.len()) {
            (false, 1) => "a scalar",
            (false, _) => "two scalars",
            (true, 1) => "a vector",
            (true, _) => "two vectors",
        }
    }
}

/// The value of a scalar that is written in numbers alone.
pub(super) fn value(term: &Term) -> Option<f64> {
    match term {
        Term::Number(value) => Some(*value),
        Term::Sum(terms) => terms.iter().try_fold(0.0, |sum, (minus, term)| {
            let term = value(term)?;
            Some(if *minus { sum - term } else { sum + term })
        }),
        Term::Product(a, b) => Some(value(a)? * value(b)?),
        Term::Function(function, inner) => value(inner).map(|x| function.of(x)),
        Term::Direction(sine, cosine) => Some(value(sine)?.atan2(value(cosine)?)),
        _ => None,
    }
}

/// How large terms are, without defaults and laws.
pub(super) fn extent<'t>(terms: impl IntoIterator<Item = &'t Term>) -> Extent {
    let written = |_: usize, arguments: &[Extent]| Extent::sum(arguments.iter().copied());
    Extent::sum(terms.into_iter().map(|term| term.extent(&written)))
}

/// The refusal of what cannot be differentiated in a reasonable time.
pub(super) fn too_large(what: &str) -> String {
    let most = Extent::MOST.size;
    format!(
        "{what} too large to be differentiated: with names put in, it has more than {most} terms, or products of products of them"
    )
}

/// What the expressions of a definition may speak of.
pub(super) struct Context<'a> {
    pub(super) kind: ElementKind,
    pub(super) bodies: &'a [Ident],
    pub(super) parameters: &'a [Parameter],
    /// Parameters whose kind is not known.
    pub(super) ambiguous: Vec<&'a Ident>,
    /// What `let` has named; without a value where that is faulty.
    pub(super) names: Vec<(Ident, Option<Shaped>)>,
    /// The terms that names and squares may still add to what is written.
    pub(super) left: Cell<f64>,
}

impl Context<'_> {
    /// Whether a body, a parameter or a `let` has the name.
    pub(super) fn is_known(&self, name: &Ident) -> bool {
        self.bodies.contains(name)
            || self.parameters.iter().any(|p| p.name == *name)
            || self.names.iter().any(|(known, _)| known == name)
    }

    /// One scalar.
    pub(super) fn scalar(&self, expr: &Expr, faults: &mut Faults) -> Option<Term> {
        self.single(expr, false, "expected a scalar", faults)
    }

    /// One scalar, the argument of a function.
    pub(super) fn argument(&self, of: &str, expr: &Expr, faults: &mut Faults) -> Option<Term> {
        self.single(expr, false, &format!("`{of}` takes a scalar"), faults)
    }

    /// One vector.
    pub(super) fn vector(&self, expr: &Expr, faults: &mut Faults) -> Option<Term> {
        self.single(expr, true, "expected a vector", faults)
    }

    fn single(&self, expr: &Expr, vector: bool, wanted: &str, faults: &mut Faults) -> Option<Term> {
        let shaped = self.expression(expr, faults)?;
        let found = shaped.name();
        match <[Term; 1]>::try_from(shaped.terms) {
            Ok([term]) if shaped.vector == vector => Some(term),
            _ => {
                faults.at(expr, format!("{wanted}; this is {found}"));
                None
            }
        }
    }

    pub(super) fn axis(&self, name: &Ident, faults: &mut Faults) -> Option<usize> {
        let axis = self
            .parameters
            .iter()
            .position(|p| p.name == *name && p.kind == ParameterKind::Axis);
        if axis.is_none() && !self.ambiguous.contains(&name) {
            let axes = self.known(|kind| kind == ParameterKind::Axis);
            let near = did_you_mean(&name.to_string(), axes.iter().map(String::as_str));
            let has = self.has(&axes);
            faults.at(name, format!("no axis `{name}`; {has}{near}"));
        }
        axis
    }

    /// "the joint has `length`", "the force has none".
    pub(super) fn has(&self, names: &[String]) -> String {
        let word = self.kind.word();
        if names.is_empty() {
            return format!("the {word} has none");
        }
        format!("the {word} has {}", list(names))
    }

    /// The names of the parameters of some kinds.
    pub(super) fn known(&self, wanted: impl Fn(ParameterKind) -> bool) -> Vec<String> {
        let known = self.parameters.iter().filter(|p| wanted(p.kind));
        known
            .filter(|p| !self.ambiguous.contains(&&p.name))
            .map(|p| p.name.to_string())
            .collect()
    }

    pub(super) fn expression(&self, expr: &Expr, faults: &mut Faults) -> Option<Shaped> {
        let shaped = self.any(expr, faults)?;
        for value in shaped.terms.iter().filter_map(value) {
            in_range(value, expr, faults)?;
        }
        Some(shaped)
    }

    fn any(&self, expr: &Expr, faults: &mut Faults) -> Option<Shaped> {
        match ungroup(expr) {
            Expr::Lit(found) => {
                let value = faults.accept(literal(&found.lit))?;
                Some(Shaped::scalar(Term::Number(value)))
            }
            Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => {
                let inner = self.expression(&unary.expr, faults)?;
                let terms = inner
                    .terms
                    .into_iter()
                    .map(|term| Term::Sum(vec![(true, term)]));
                Some(Shaped {
                    vector: inner.vector,
                    terms: terms.collect(),
                })
            }
            Expr::Binary(binary) => self.binary(binary, faults),
            Expr::Field(field) => self.field(field, faults),
            Expr::MethodCall(call) => self.normals(call, faults),
            Expr::Array(array) => self.components(array, faults),
            Expr::Call(call) => self.call(call, faults),
            Expr::Path(path) => self.name(path, faults),
            other => {
                faults.at(
                    other,
                    "expected an expression of points, vectors and numbers: `i.point`, `+`, `-`, `*`, `/`, `dot(..)`, \
                     `cross(..)`, `length(..)`",
                );
                None
            }
        }
    }

    fn binary(&self, binary: &syn::ExprBinary, faults: &mut Faults) -> Option<Shaped> {
        let left = self.expression(&binary.left, faults);
        let right = self.expression(&binary.right, faults);
        let (left, right) = (left?, right?);
        match binary.op {
            BinOp::Add(_) | BinOp::Sub(_) => {
                if left.vector != right.vector || left.terms.len() != right.terms.len() {
                    let word = if matches!(binary.op, BinOp::Add(_)) {
                        "add"
                    } else {
                        "subtract"
                    };
                    faults.at(
                        binary,
                        format!(
                            "cannot {word} {} and {}; both sides must have one shape",
                            left.name(),
                            right.name()
                        ),
                    );
                    return None;
                }
                let minus = matches!(binary.op, BinOp::Sub(_));
                let terms = left
                    .terms
                    .into_iter()
                    .zip(right.terms)
                    .map(|(a, b)| Term::Sum(vec![(false, a), (minus, b)]))
                    .collect();
                Some(Shaped {
                    vector: left.vector,
                    terms,
                })
            }
            BinOp::Mul(_) => {
                if left.vector && right.vector {
                    faults.at(
                        binary,
                        "cannot multiply two vectors; write `dot(a, b)` or `cross(a, b)`",
                    );
                    return None;
                }
                let vector = left.vector || right.vector;
                let (scalar, other) = if left.vector {
                    (right, left)
                } else {
                    (left, right)
                };
                self.pairwise(binary, scalar, other, vector, faults, Term::Product)
            }
            BinOp::Div(_) => {
                if right.vector {
                    faults.at(
                        &binary.right,
                        format!("cannot divide by {}; a divisor is a scalar", right.name()),
                    );
                    return None;
                }
                if right.terms.iter().any(|term| value(term) == Some(0.0)) {
                    faults.at(&binary.right, "cannot divide by 0");
                    return None;
                }
                let vector = left.vector;
                self.pairwise(binary, right, left, vector, faults, |divisor, other| {
                    let reciprocal = Term::Function(Function::Reciprocal, divisor);
                    Term::Product(Box::new(reciprocal), other)
                })
            }
            op => {
                super::refuse_operator(&op, faults);
                None
            }
        }
    }

    pub(super) fn pairwise(
        &self,
        at: impl ToTokens,
        left: Shaped,
        right: Shaped,
        vector: bool,
        faults: &mut Faults,
        make: Make,
    ) -> Option<Shaped> {
        let (m, n) = (left.terms.len(), right.terms.len());
        if m != n && m != 1 && n != 1 {
            faults.at(
                at,
                format!("cannot combine {} and {}", left.name(), right.name()),
            );
            return None;
        }
        let terms = (0..m.max(n))
            .map(|k| {
                let (a, b) = (&left.terms[k % m], &right.terms[k % n]);
                make(Box::new(a.clone()), Box::new(b.clone()))
            })
            .collect();
        Some(Shaped { vector, terms })
    }

    /// A copy, unless copies of copies make too much of it.
    pub(super) fn repeated(
        &self,
        shaped: &Shaped,
        at: impl ToTokens,
        faults: &mut Faults,
    ) -> Option<Shaped> {
        let before = self.left.get();
        self.left.set(before - extent(&shaped.terms).size);
        if self.left.get() < 0.0 {
            // Said once.
            if before >= 0.0 {
                faults.at(
                    at,
                    too_large(&format!("this makes the {}", self.kind.word())),
                );
            }
            return None;
        }
        Some(shaped.clone())
    }

    pub(super) fn body(&self, expr: &Expr, faults: &mut Faults) -> Option<usize> {
        if let Expr::Path(path) = ungroup(expr)
            && let Some(name) = path.path.get_ident()
        {
            if let Some(place) = self.bodies.iter().position(|body| body == name) {
                return Some(place);
            }
            let known: Vec<String> = self.bodies.iter().map(ToString::to_string).collect();
            let near = did_you_mean(&name.to_string(), known.iter().map(String::as_str));
            faults.at(
                name,
                format!(
                    "no body `{name}`; the {}'s bodies are {}{near}",
                    self.kind.word(),
                    list(known.iter())
                ),
            );
            return None;
        }
        faults.at(
            expr,
            format!(
                "expected a body of the {}; there are {}",
                self.kind.word(),
                list(self.bodies)
            ),
        );
        None
    }

    fn field(&self, field: &syn::ExprField, faults: &mut Faults) -> Option<Shaped> {
        let body = self.body(&field.base, faults)?;
        let Member::Named(name) = &field.member else {
            faults.at(
                &field.member,
                "expected the name of a point, a vector or an axis",
            );
            return None;
        };
        if name == "origin" {
            return Some(Shaped::vector(Term::Origin(body)));
        }
        if self.ambiguous.contains(&name) {
            return None;
        }
        let Some(parameter) = self
            .parameters
            .iter()
            .position(|p| p.name == *name && p.kind.is_vector())
        else {
            let known = self.known(ParameterKind::is_vector);
            let near = did_you_mean(&name.to_string(), known.iter().map(String::as_str));
            let fixed = list(known.iter().map(String::as_str).chain(["origin"]));
            faults.at(
                name,
                format!("no point or vector `{name}` on a body; it has {fixed}{near}"),
            );
            return None;
        };
        let term = match self.parameters[parameter].kind {
            ParameterKind::Point => Term::Point { body, parameter },
            _ => Term::Fixed { body, parameter },
        };
        Some(Shaped::vector(term))
    }

    fn components(&self, array: &syn::ExprArray, faults: &mut Faults) -> Option<Shaped> {
        if array.elems.len() != 3 {
            let found = array.elems.len();
            faults.at(
                array,
                format!("a vector has three components; found {found}"),
            );
            return None;
        }
        let components = array
            .elems
            .iter()
            .map(|element| self.scalar(element, faults));
        let components: Vec<Option<Term>> = components.collect();
        let components: Vec<Box<Term>> = components
            .into_iter()
            .map(|c| c.map(Box::new))
            .collect::<Option<_>>()?;
        let components = components.try_into().ok()?;
        Some(Shaped::vector(Term::Components(components)))
    }

    fn normals(&self, call: &syn::ExprMethodCall, faults: &mut Faults) -> Option<Shaped> {
        let method = call.method.to_string();
        let places: &[usize] = match method.as_str() {
            "normals" => &[0, 1],
            "normal" => &[0],
            "binormal" => &[1],
            _ => &[],
        };
        if !places.is_empty() && !call.args.is_empty() {
            let found = call.args.len();
            faults.at(
                &call.args,
                format!("`{method}()` takes nothing in its parentheses; found {found}"),
            );
            return None;
        }
        if places.is_empty() {
            let near = did_you_mean(&method, ["normals", "normal", "binormal"]);
            faults.at(
                &call.method,
                format!(
                    "no `{method}` here; an axis has `normal()` and `binormal()`, unit vectors perpendicular to it, and \
                     `normals()`, which is both{near}"
                ),
            );
            return None;
        }
        let base = self.expression(&call.receiver, faults)?;
        if let [Term::Fixed { body, parameter }] = base.terms[..]
            && self.parameters[parameter].kind == ParameterKind::Axis
        {
            let terms = places
                .iter()
                .map(|&which| Term::Normal {
                    body,
                    parameter,
                    which,
                })
                .collect();
            return Some(Shaped {
                vector: true,
                terms,
            });
        }
        faults.at(
            &call.receiver,
            format!("only an axis has `{method}()`; this is {}", base.name()),
        );
        None
    }

    fn name(&self, path: &syn::ExprPath, faults: &mut Faults) -> Option<Shaped> {
        if let Some(name) = path.path.get_ident() {
            if let Some((_, value)) = self.names.iter().rev().find(|(known, _)| known == name) {
                return self.repeated(value.as_ref()?, path, faults);
            }
            match name.to_string().as_str() {
                "PI" => return Some(Shaped::scalar(Term::Number(std::f64::consts::PI))),
                "TAU" => return Some(Shaped::scalar(Term::Number(std::f64::consts::TAU))),
                "time" => return Some(Shaped::scalar(Term::Time)),
                _ => {}
            }
        }
        self.scalar_parameter(path, faults)
    }

    fn scalar_parameter(&self, path: &syn::ExprPath, faults: &mut Faults) -> Option<Shaped> {
        let found = code(path);
        let Some(name) = path.path.get_ident() else {
            faults.at(
                path,
                format!("`{found}` is not known here; a definition speaks of its own parameters, which a mechanism gives"),
            );
            return None;
        };
        let place = self.parameters.iter().position(|p| p.name == *name);
        match place {
            _ if self.ambiguous.contains(&name) => {}
            Some(place) if self.parameters[place].kind.is_number() => {
                return Some(Shaped::scalar(Term::Scalar(place)));
            }
            Some(place) if self.parameters[place].kind == ParameterKind::Law => {
                let arguments: Vec<String> =
                    self.parameters[place].arguments.iter().map(ToString::to_string).collect();
                let call = format!("{found}({})", arguments.join(", "));
                faults.at(path, format!("`{found}` is a law; write `{call}`"));
            }
            Some(_) => {
                let body = self.bodies.first().map_or("i".into(), ToString::to_string);
                faults.at(
                    path,
                    format!("`{found}` is fixed on a body; write for instance `{body}.{found}`"),
                );
            }
            None if self.bodies.contains(name) => faults.at(
                path,
                format!("`{found}` is a body; write a point or vector of it, for instance `{found}.origin`"),
            ),
            None => {
                if STATEMENTS.contains(&found.as_str()) {
                    faults.at(path, format!("`{found}` stands alone; expected an expression beside it"));
                    return None;
                }
                let named = self.names.iter().map(|(name, _)| name.to_string());
                let known: Vec<String> =
                    self.known(ParameterKind::is_number).into_iter().chain(named).collect();
                let near = did_you_mean(&found, known.iter().map(String::as_str));
                faults.at(path, format!("no number or `let` is named `{found}`; {}{near}", self.has(&known)));
            }
        }
        None
    }
}

//! Definitions of joints: names, shapes, equations.

use proc_macro2::Ident;
use quote::ToTokens;
use syn::{BinOp, Expr, Lit, Member, UnOp};

use super::number::in_range;
use crate::diag::{Faults, code, did_you_mean, list};
use crate::model::{AngleDef, JointDef, Parameter, ParameterKind, Row, Term};
use crate::syntax::joint::{JointSyntax, Statement};
use crate::syntax::ungroup;
use crate::wire;

/// Names that a definition may not use for itself.
const RESERVED: [&str; 3] = ["between", "ground", "origin"];

/// Makes a term of two.
type Make = fn(Box<Term>, Box<Term>) -> Term;

/// One or two terms of one shape: the normals of an axis are two vectors, and what is made of them is twofold too.
#[derive(Clone, Debug)]
struct Shaped {
    vector: bool,
    terms: Vec<Term>,
}

impl Shaped {
    fn scalar(term: Term) -> Self {
        Self {
            vector: false,
            terms: vec![term],
        }
    }

    fn vector(term: Term) -> Self {
        Self {
            vector: true,
            terms: vec![term],
        }
    }

    fn name(&self) -> &'static str {
        match (self.vector, self.terms.len()) {
            (false, 1) => "a scalar",
            (false, _) => "two scalars",
            (true, 1) => "a vector",
            (true, _) => "two vectors",
        }
    }
}

/// Checks a definition. `None` if anything is wrong; the faults say what.
pub fn check(syntax: &JointSyntax, faults: &mut Faults) -> Option<JointDef> {
    if !syntax.is_complete {
        return None;
    }
    let before = faults.any();
    let mut fresh = Faults::new();
    let (parameters, doubtful) = signature(syntax, &mut fresh);
    let context = Context {
        bodies: &syntax.bodies,
        parameters: &parameters,
        doubtful: &doubtful,
    };
    let mut rows = Vec::new();
    let mut angle = None;
    for statement in &syntax.statements {
        match statement {
            Statement::Zero(expr) => {
                if let Some(shaped) = context.expression(expr, &mut fresh) {
                    rows.extend(shaped.terms.into_iter().map(|term| {
                        if shaped.vector {
                            Row::Vector(term)
                        } else {
                            Row::Scalar(term)
                        }
                    }));
                }
            }
            Statement::Angle { keyword, axis } => {
                if angle.is_some() {
                    fresh.at(keyword, "a joint has one angle; this is the second");
                } else if syntax.bodies.len() != 2 {
                    let (name, count) = (&syntax.name, syntax.bodies.len());
                    fresh.at(
                        keyword,
                        format!("an angle needs two bodies; `{name}` has {count}"),
                    );
                } else {
                    angle = context.axis(axis, &mut fresh).map(|axis| AngleDef { axis });
                }
            }
        }
    }
    if rows.is_empty() && !before && !fresh.any() {
        let name = &syntax.name;
        fresh.at(
            name,
            format!("joint `{name}` has no equation; write an expression that is zero, as in `j.origin - i.origin;`"),
        );
    }
    let sound = !fresh.any() && !before;
    faults.append(fresh);
    sound.then(|| JointDef {
        name: syntax.name.clone(),
        bodies: syntax.bodies.clone(),
        parameters,
        rows,
        angle,
        fingerprint: fingerprint(&syntax.body.to_string()),
        span: syntax.name.span(),
    })
}

/// Tells definitions apart, by their text without spaces.
fn fingerprint(text: &str) -> u64 {
    wire::hash(text.bytes().filter(|byte| !byte.is_ascii_whitespace()))
}

/// The parameters, and the names of those whose kind is not known.
fn signature<'a>(syntax: &'a JointSyntax, faults: &mut Faults) -> (Vec<Parameter>, Vec<&'a Ident>) {
    if syntax.bodies.is_empty() {
        faults.at(
            &syntax.name,
            "a joint connects at least one body, as in `(i, j)`",
        );
    }
    let mut doubtful = Vec::new();
    let mut seen: Vec<&Ident> = Vec::new();
    for name in syntax
        .bodies
        .iter()
        .chain(syntax.parameters.iter().map(|(name, _)| name))
    {
        if RESERVED.contains(&name.to_string().as_str()) {
            faults.at(
                name,
                format!("`{name}` is a word of the language; take another name"),
            );
        }
        if seen.contains(&name) {
            faults.at(name, format!("`{name}` is declared twice"));
        }
        seen.push(name);
    }
    let parameters = syntax
        .parameters
        .iter()
        .map(|(name, kind)| {
            let found = kind.to_string();
            let known = ParameterKind::ALL.iter().find(|(word, _)| *word == found);
            if known.is_none() {
                doubtful.push(name);
                let words = ParameterKind::ALL.map(|(word, _)| word);
                let near = did_you_mean(&found, words);
                faults.at(
                    kind,
                    format!("no kind `{found}`; there are {}{near}", list(words)),
                );
            }
            let kind = known.map_or(ParameterKind::Number, |(_, kind)| *kind);
            Parameter {
                name: name.clone(),
                kind,
            }
        })
        .collect();
    (parameters, doubtful)
}

struct Context<'a> {
    bodies: &'a [Ident],
    parameters: &'a [Parameter],
    doubtful: &'a [&'a Ident],
}

impl Context<'_> {
    fn axis(&self, name: &Ident, faults: &mut Faults) -> Option<usize> {
        let axis = self
            .parameters
            .iter()
            .position(|p| p.name == *name && p.kind == ParameterKind::Axis);
        if axis.is_none() && !self.doubtful.contains(&name) {
            let axes = self.known(|kind| kind == ParameterKind::Axis);
            let near = did_you_mean(&name.to_string(), axes.iter().map(String::as_str));
            let has = if axes.is_empty() {
                "the joint has none".into()
            } else {
                format!("the joint has {}", list(&axes))
            };
            faults.at(name, format!("no axis `{name}`; {has}{near}"));
        }
        axis
    }

    /// The names of the parameters of some kinds.
    fn known(&self, wanted: impl Fn(ParameterKind) -> bool) -> Vec<String> {
        let known = self.parameters.iter().filter(|p| wanted(p.kind));
        known
            .filter(|p| !self.doubtful.contains(&&p.name))
            .map(|p| p.name.to_string())
            .collect()
    }

    fn expression(&self, expr: &Expr, faults: &mut Faults) -> Option<Shaped> {
        match ungroup(expr) {
            Expr::Lit(literal) => match &literal.lit {
                Lit::Float(f) => faults.accept(f.base10_parse()),
                Lit::Int(i) => faults.accept(i.base10_parse()),
                other => {
                    faults.at(other, "expected a number");
                    None
                }
            }
            .and_then(|value| in_range(value, literal, faults))
            .map(|value| Shaped::scalar(Term::Number(value))),
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
            Expr::Call(call) => self.call(call, faults),
            Expr::Path(path) => self.scalar_parameter(path, faults),
            other => {
                faults.at(
                    other,
                    "expected an expression of points, vectors and numbers: `i.point`, `+`, `-`, `*`, `dot(..)`, \
                     `cross(..)`, `squared(..)`",
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
            op => {
                faults.at(op, "expected `+`, `-` or `*`");
                None
            }
        }
    }

    fn pairwise(
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

    fn body(&self, expr: &Expr, faults: &mut Faults) -> Option<usize> {
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
                    "no body `{name}`; the joint's bodies are {}{near}",
                    list(known.iter())
                ),
            );
            return None;
        }
        faults.at(
            expr,
            format!("expected one of the joint's bodies, {}", list(self.bodies)),
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
        if self.doubtful.contains(&name) {
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

    fn normals(&self, call: &syn::ExprMethodCall, faults: &mut Faults) -> Option<Shaped> {
        if call.method != "normals" || !call.args.is_empty() {
            faults.at(
                &call.method,
                format!(
                    "no `{}` here; an axis has `normals()`, two unit vectors perpendicular to it",
                    call.method
                ),
            );
            return None;
        }
        let base = self.expression(&call.receiver, faults)?;
        if let [Term::Fixed { body, parameter }] = base.terms[..]
            && self.parameters[parameter].kind == ParameterKind::Axis
        {
            let terms = [0, 1]
                .map(|which| Term::Normal {
                    body,
                    parameter,
                    which,
                })
                .into();
            return Some(Shaped {
                vector: true,
                terms,
            });
        }
        faults.at(
            &call.receiver,
            format!("only an axis has `normals()`; this is {}", base.name()),
        );
        None
    }

    fn call(&self, call: &syn::ExprCall, faults: &mut Faults) -> Option<Shaped> {
        let name = code(&call.func);
        let arguments: Vec<Option<Shaped>> = call
            .args
            .iter()
            .map(|argument| self.expression(argument, faults))
            .collect();
        let arguments: Vec<Shaped> = arguments.into_iter().collect::<Option<_>>()?;
        let (wanted, vector, make): (usize, bool, Make) = match name.as_str() {
            "dot" => (2, false, Term::Dot),
            "squared" => (1, false, Term::Dot),
            "cross" => (2, true, Term::Cross),
            _ => {
                let known = ["dot", "cross", "squared"];
                let near = did_you_mean(&name, known);
                faults.at(
                    &call.func,
                    format!("no function `{name}`; there are {}{near}", list(known)),
                );
                return None;
            }
        };
        if arguments.len() != wanted {
            let count = arguments.len();
            let vectors = if wanted == 1 { "vector" } else { "vectors" };
            faults.at(
                call,
                format!("`{name}` takes {wanted} {vectors}, not {count}"),
            );
            return None;
        }
        for (argument, expr) in arguments.iter().zip(&call.args) {
            if !argument.vector {
                faults.at(
                    expr,
                    format!("`{name}` takes vectors; this is {}", argument.name()),
                );
                return None;
            }
        }
        let first = arguments.first()?.clone();
        let second = arguments.last()?.clone();
        self.pairwise(call, first, second, vector, faults, make)
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
            _ if self.doubtful.contains(&name) => {}
            Some(place) if !self.parameters[place].kind.is_vector() => {
                return Some(Shaped::scalar(Term::Scalar(place)));
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
                let known = self.known(|kind| !kind.is_vector());
                let near = did_you_mean(&found, known.iter().map(String::as_str));
                let has = if known.is_empty() {
                    "the joint has none".into()
                } else {
                    format!("the joint has {}", list(&known))
                };
                faults.at(path, format!("no number `{found}`; {has}{near}"));
            }
        }
        None
    }
}

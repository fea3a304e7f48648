//! Numbers: literals, arithmetic and elementary functions are evaluated here; paths become symbols.

use std::ops::RangeInclusive;

use proc_macro2::{Ident, Span, TokenStream};
use quote::{ToTokens, quote, quote_spanned};
use syn::spanned::Spanned;
use syn::{Expr, Lit, UnOp};

use super::elements::{Found, Reference, bare, known};
use super::later::{Later, Value, later_advice};
use crate::diag::{Faults, code, did_you_mean, list};
use crate::model::name::Step;
use crate::model::number::literals;
use crate::model::{Name, Number, RunTimeValue, Spline, Symbol, ValueKind};
use crate::syntax::array::is_index;
use crate::syntax::integer::integer;
use crate::syntax::ungroup;
use crate::syntax::words::local;

/// The size of numbers: beyond it products and reciprocals leave the range of `f64`.
const SIZES: RangeInclusive<f64> = 1e-40..=1e40;

/// Of numbers, evaluated at expansion.
type Function = fn(f64) -> f64;

const FUNCTIONS: [(&str, Function); 6] = [
    ("sqrt", f64::sqrt),
    ("sin", f64::sin),
    ("cos", f64::cos),
    ("tan", f64::tan),
    ("exp", f64::exp),
    ("deg", f64::to_radians),
];

/// Evaluates numbers and keeps the table of symbols.
#[derive(Debug)]
pub struct Numbers<'a> {
    /// Where the private support of the run-time crate lives.
    pub(super) facade: &'a TokenStream,
    /// The run-time values of the mechanism.
    pub values: Vec<RunTimeValue>,
    /// What else may stand here, for messages: the words of a law.
    pub words: Vec<String>,
    /// Why inputs cannot stand here; `None` where they can.
    pub no_inputs: Option<&'static str>,
    /// Symbols met so far.
    pub symbols: Vec<Symbol>,
    /// Splines met so far.
    pub splines: Vec<Spline>,
    /// Constants by their paths, met so far outside parts.
    pub constants: Vec<TokenStream>,
    /// The types of parts by the way to each: the constants of an assembly have their meaning
    /// there.
    pub scopes: Vec<(Vec<Step>, TokenStream)>,
    /// Arrays among the values whose length was refused.
    pub unmeasured: &'a [Ident],
    /// The field that is being read.
    pub field: Name,
    /// The attribute that is being read.
    pub attribute: String,
}

/// A number that others are made of.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// What it is, at the typical values of parameters.
    pub seen: Option<f64>,
    /// Whether it is that everywhere.
    pub is_written: bool,
}

impl<'a> Numbers<'a> {
    /// No symbols so far; what is read first describes the owner.
    #[must_use]
    pub fn new(owner: Name, unmeasured: &'a [Ident], facade: &'a TokenStream) -> Self {
        Self {
            facade,
            values: Vec::new(),
            words: Vec::new(),
            no_inputs: None,
            symbols: Vec::new(),
            splines: Vec::new(),
            constants: Vec::new(),
            scopes: Vec::new(),
            unmeasured,
            field: owner,
            attribute: String::new(),
        }
    }

    /// One number.
    pub fn scalar(&mut self, expr: &Expr, faults: &mut Faults) -> Option<Number> {
        let value = self.value(expr, faults)?;
        match &value {
            Value::Literal(value) => {
                in_range(*value, expr, faults)?;
            }
            Value::Later(later) => {
                if let Some(like) = later.like {
                    in_range_where(like, AT_LIKES, expr, faults)?;
                }
            }
        }
        Some(self.number(value, expr.span()))
    }

    /// The number that a value is: an expression becomes a symbol.
    pub(super) fn number(&mut self, value: Value, span: Span) -> Number {
        let itself = value.itself();
        let Later {
            expression,
            scalar,
            is_const,
            is_varying,
            values,
            like,
        } = match value {
            Value::Literal(value) => return Number::Literal(value),
            Value::Later(later) => later,
        };
        let number = if is_varying {
            Number::Varying
        } else {
            Number::Symbol
        };
        // A constant of another type, or an unknown one, is refused by the compiler: with one
        // sentence, wherever the expression is used. The call changes nothing; it tells the type
        // where that of the constant is not known.
        let value = local("value");
        let expression = quote! {
            ::core::convert::identity::<f64>({ let #value: f64 = #expression; #value })
        };
        if let Some(known) = self.known(&expression) {
            return number(known);
        }
        let place = u32::try_from(self.symbols.len()).expect("fewer symbols than tokens");
        let name = local(&format!("CONSTANT_{place}"));
        let is_checked = is_const && must_be_positive(&self.attribute);
        let (expression, constant) = if is_checked {
            (quote!(#name), Some((name, expression)))
        } else {
            (expression, None)
        };
        self.symbols.push(Symbol {
            expression,
            scalar,
            values,
            itself,
            slope_of: None,
            like,
            constant,
            span,
            field: self.field.clone(),
            attribute: self.attribute.clone(),
        });
        number(place)
    }

    /// What the macro sees of a number that others are made of. It becomes no symbol.
    pub fn part(&mut self, expr: &Expr, faults: &mut Faults) -> Option<Part> {
        Some(match self.value(expr, faults)? {
            Value::Literal(value) => Part {
                seen: in_range(value, expr, faults),
                is_written: true,
            },
            Value::Later(later) => Part {
                seen: later.like,
                is_written: false,
            },
        })
    }

    /// A number that must be written: literals and their arithmetic.
    pub fn written(&mut self, expr: &Expr, faults: &mut Faults) -> Option<f64> {
        if let Some(unseen) = unseen(expr) {
            faults.at(
                unseen,
                format!(
                    "`{}` takes a number that the macro can see: literals, their arithmetic, `PI` and `TAU`; `{}` is none",
                    self.attribute,
                    code(unseen)
                ),
            );
            return None;
        }
        match self.value(expr, faults)? {
            Value::Literal(value) => in_range(value, expr, faults),
            Value::Later(_) => None,
        }
    }

    /// The symbol of the same expression, so that what is equal in two places cancels. What must be
    /// positive keeps a symbol of its own, whose place a refusal names.
    fn known(&self, expression: &TokenStream) -> Option<u32> {
        if must_be_positive(&self.attribute) {
            return None;
        }
        let text = expression.to_string();
        self.symbols
            .iter()
            .position(|s| !must_be_positive(&s.attribute) && s.expression.to_string() == text)
            .and_then(|place| u32::try_from(place).ok())
    }

    /// `N` numbers in brackets.
    pub fn array<const N: usize>(
        &mut self,
        expr: &Expr,
        faults: &mut Faults,
    ) -> Option<[Number; N]> {
        let elements = elements(expr)?;
        if elements.len() != N {
            faults.at(
                expr,
                format!(
                    "`{}` takes {N} numbers; found {}",
                    self.attribute,
                    elements.len()
                ),
            );
            return None;
        }
        let numbers: Vec<Option<Number>> = elements
            .iter()
            .map(|element| self.scalar(element, faults))
            .collect();
        let numbers: Vec<Number> = numbers.into_iter().collect::<Option<_>>()?;
        numbers.try_into().ok()
    }

    /// Three numbers in brackets, with a sentence about what else was found.
    pub fn vector(&mut self, expr: &Expr, faults: &mut Faults) -> Option<[Number; 3]> {
        if elements(expr).is_none() {
            let key = &self.attribute;
            let example = if key == "gravity" {
                "[0.0, 0.0, -9.81]"
            } else {
                "[0.0, 0.5, 0.0]"
            };
            faults.at(
                expr,
                format!("`{key}` takes three numbers in brackets, as in `{example}`"),
            );
            return None;
        }
        self.array(expr, faults)
    }

    fn value(&mut self, expr: &Expr, faults: &mut Faults) -> Option<Value> {
        match ungroup(expr) {
            Expr::Lit(found) => match &found.lit {
                Lit::Float(_) | Lit::Int(_) => {
                    faults.accept(literal(&found.lit)).map(Value::Literal)
                }
                _ => self.refuse(expr, faults),
            },
            Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => {
                Some(self.value(&unary.expr, faults)?.negated())
            }
            Expr::Binary(binary) => {
                let left = self.value(&binary.left, faults);
                let right = self.value(&binary.right, faults);
                let (left, right) = (left?, right?);
                let combined = left.combined(&binary.op, right);
                if combined.is_none() {
                    super::refuse_operator(&binary.op, faults);
                }
                combined
            }
            Expr::Call(call) => self.call(call, faults),
            Expr::Path(path) if path.path.is_ident("PI") => {
                Some(Value::Literal(std::f64::consts::PI))
            }
            Expr::Path(path) if path.path.is_ident("TAU") => {
                Some(Value::Literal(std::f64::consts::TAU))
            }
            Expr::Path(_) | Expr::Index(_) | Expr::Field(_) => match self.place(expr, faults) {
                Found::At(place) => self.run_time_value(place, expr, faults).map(Value::Later),
                Found::Nothing => self.constant(expr, faults).map(|expression| {
                    Value::Later(Later {
                        expression: self.in_scope(expression),
                        scalar: None,
                        is_const: true,
                        is_varying: false,
                        values: Vec::new(),
                        like: None,
                    })
                }),
                Found::Refused => None,
            },
            _ => self.refuse(expr, faults),
        }
    }

    /// A constant as it is named from the mechanism. Another one of its name may be there.
    fn in_scope(&mut self, constant: TokenStream) -> TokenStream {
        let scope = self.field.parts();
        let Some((_, owner)) = self.scopes.iter().find(|(known, _)| known == scope) else {
            self.constants.push(constant.clone());
            return constant;
        };
        let (facade, number) = (self.facade, crate::wire::fingerprint([&constant]));
        quote!(<#owner as #facade::__private::ConstantOf<#number>>::VALUE)
    }

    /// A constant by its path, or an entry of one that is an array.
    pub(super) fn constant(&self, expr: &Expr, faults: &mut Faults) -> Option<TokenStream> {
        match ungroup(expr) {
            Expr::Path(path) => (!self.is_unknown(path, faults)).then(|| path.to_token_stream()),
            Expr::Index(entry) => {
                let array = self.constant(&entry.expr, faults);
                let index = faults.accept(integer(&entry.index));
                let (array, index) = (array?, index?);
                let Ok(index) = usize::try_from(index) else {
                    let found = code(&entry.expr);
                    faults.at(
                        expr,
                        format!("the entries of `{found}` are counted from 0; this is `{found}[{index}]`"),
                    );
                    return None;
                };
                // A block that begins with a block would be two statements.
                let array = match ungroup(&entry.expr) {
                    Expr::Index(_) => quote!((#array)),
                    _ => array,
                };
                // Whether there is such an entry is found by the compiler, and not when the program
                // runs.
                let at = expr.span();
                Some(quote_spanned!(at=> const { #array[#index] }))
            }
            _ => {
                self.refuse(expr, faults);
                None
            }
        }
    }

    /// Refuses a name in small letters, which is no constant, before the compiler does: it cannot
    /// say what there is.
    fn is_unknown(&self, path: &syn::ExprPath, faults: &mut Faults) -> bool {
        let Some(name) = path.path.get_ident().map(ToString::to_string) else {
            return false;
        };
        let is_small = !name.starts_with("r#") && name.starts_with(char::is_lowercase);
        if is_small {
            let values = known(self.values.iter().map(|value| &value.name), &self.field);
            let words = self.words.iter().cloned();
            let constants = ["PI", "TAU"].map(ToString::to_string);
            let all: Vec<String> = words.chain(values).chain(constants).collect();
            let near = did_you_mean(&name, all.iter().map(|name| bare(name)));
            let advice = if path.path.get_ident().is_some_and(is_index) {
                "; `k` is the number of an element, in the attribute of a field that is an array"
            } else {
                later_advice(self.no_inputs.is_some())
            };
            let advice = if near.is_empty() { advice } else { &near };
            faults.at(
                path,
                format!(
                    "no number `{name}`; there are {} and constants such as `crate::LENGTH`{advice}",
                    list(&all).replace(" and ", ", ")
                ),
            );
        }
        is_small
    }

    /// The place of a run-time value by its name.
    pub(super) fn place(&self, expr: &Expr, faults: &mut Faults) -> Found {
        let names = self.values.iter().map(|value| &value.name);
        Reference::of(expr).map_or(Found::Nothing, |reference| {
            reference.find(names, self.unmeasured, &self.field, faults)
        })
    }

    fn run_time_value(&self, place: usize, at: &Expr, faults: &mut Faults) -> Option<Later> {
        let value = &self.values[place];
        if value.is_start {
            let name = &value.name;
            faults.at(
                at,
                format!("`{name}` is a state, which changes in time: it stands in laws of forces and in rates of states alone"),
            );
            return None;
        }
        if matches!(value.kind, ValueKind::Spline(_)) {
            let name = &value.name;
            faults.at(
                at,
                format!("`{name}` is a spline; a law reads it, as in `{name}(time)`"),
            );
            return None;
        }
        if value.is_input
            && let Some(reason) = self.no_inputs
        {
            let name = &value.name;
            faults.at(
                at,
                format!("`{name}` is an input, which may change at every step: {reason}"),
            );
            return None;
        }
        Some(self.at_run_time(place))
    }

    pub(super) fn at_run_time(&self, place: usize) -> Later {
        let value = &self.values[place];
        let (name, parameters) = (value_name(&value.name), local("parameters"));
        Later {
            expression: quote!(#name),
            scalar: Some(quote!(#parameters[#place])),
            is_const: false,
            is_varying: value.is_input,
            values: vec![place],
            like: value.like,
        }
    }

    fn call(&mut self, call: &syn::ExprCall, faults: &mut Faults) -> Option<Value> {
        let Expr::Path(path) = ungroup(&call.func) else {
            return self.refuse(&call.func, faults);
        };
        let Some((name, function)) = FUNCTIONS.iter().find(|(name, _)| path.path.is_ident(name))
        else {
            let found = code(path);
            let known = FUNCTIONS.map(|(name, _)| name);
            let near = did_you_mean(&found, known);
            faults.at(
                &call.func,
                format!(
                    "no function `{found}` here; there are {}{near}",
                    list(known)
                ),
            );
            return None;
        };
        let [argument] = call.args.iter().collect::<Vec<_>>()[..] else {
            faults.at(
                call,
                format!("`{name}` takes 1 number; found {}", call.args.len()),
            );
            return None;
        };
        Some(match self.value(argument, faults)? {
            Value::Literal(value) => Value::Literal(function(value)),
            Value::Later(Later {
                expression,
                scalar,
                is_varying,
                values,
                like,
                ..
            }) => {
                let like = like.map(function);
                let (facade, function) = (self.facade, quote::format_ident!("{name}"));
                let scalar = scalar.map(|x| match *name {
                    "tan" => quote!((__S::sin(#x) * __S::reciprocal(__S::cos(#x)))),
                    "deg" => {
                        let degree = std::f64::consts::PI / 180.0;
                        quote!((#x * __S::constant(#degree)))
                    }
                    _ => quote!(__S::#function(#x)),
                });
                Value::Later(Later {
                    expression: quote!(#facade::__private::#function(#expression)),
                    scalar,
                    is_const: false,
                    is_varying,
                    values,
                    like,
                })
            }
        })
    }

    /// A number as the macro sees it: written, or at the typical values of parameters.
    #[must_use]
    pub fn seen(&self, number: Number) -> Option<f64> {
        match number {
            Number::Literal(value) => Some(value),
            Number::Symbol(symbol) | Number::Varying(symbol) => {
                self.symbols.get(symbol as usize)?.like
            }
        }
    }

    /// Several of them.
    #[must_use]
    pub fn all_seen<const N: usize>(&self, numbers: &[Number; N]) -> Option<[f64; N]> {
        literals(&numbers.map(|number| self.seen(number).map_or(number, Number::Literal)))
    }

    fn refuse(&self, expr: &Expr, faults: &mut Faults) -> Option<Value> {
        faults.at(
            expr,
            format!(
                "expected a number: a literal, arithmetic, `PI`, `TAU`, the path of a constant, or one of {}",
                list(FUNCTIONS.map(|(name, _)| name))
            ),
        );
        None
    }
}

/// A number as it is written.
///
/// # Errors
/// A sentence at what is no number, and at one with a unit behind it.
pub fn literal(lit: &Lit) -> syn::Result<f64> {
    let (suffix, value) = match lit {
        Lit::Float(float) => (float.suffix(), float.base10_parse()),
        Lit::Int(int) => (int.suffix(), int.base10_parse()),
        other => return Err(syn::Error::new_spanned(other, "expected a number")),
    };
    if matches!(suffix, "" | "f64") {
        return value;
    }
    let found = code(lit);
    Err(syn::Error::new_spanned(
        lit,
        format!(
            "`{found}` ends in `{suffix}`; a number stands alone, in m, kg, s and rad (degrees are `deg(30.0)`)"
        ),
    ))
}

/// What stands in an expression that the macro cannot see: a name, or an entry of an array.
fn unseen(expr: &Expr) -> Option<&Expr> {
    match ungroup(expr) {
        Expr::Path(path) if path.path.is_ident("PI") || path.path.is_ident("TAU") => None,
        found @ (Expr::Path(_) | Expr::Index(_)) => Some(found),
        Expr::Unary(unary) => unseen(&unary.expr),
        Expr::Binary(binary) => unseen(&binary.left).or_else(|| unseen(&binary.right)),
        Expr::Call(call) => call.args.iter().find_map(unseen),
        _ => None,
    }
}

/// Whether numbers of an attribute must be positive.
fn must_be_positive(attribute: &str) -> bool {
    matches!(attribute, "mass" | "inertia")
}

/// The local variable that holds a run-time value as `f64`.
#[must_use]
pub fn value_name(name: &Name) -> Ident {
    // An element must not meet a field whose name is like its own in one word.
    let kind = match name.index() {
        Some(_) => "element",
        None => "value",
    };
    let part = if name.parts().is_empty() {
        ""
    } else {
        "_in_part"
    };
    local(&format!("{kind}{part}_of_{}", name.word()))
}

/// A number that is finite, and of a size that products and reciprocals bear.
pub fn in_range(value: f64, at: impl ToTokens, faults: &mut Faults) -> Option<f64> {
    in_range_where(value, "", at, faults)
}

/// The same of a number that is what it is somewhere, which a refusal says.
fn in_range_where(value: f64, place: &str, at: impl ToTokens, faults: &mut Faults) -> Option<f64> {
    if value == 0.0 || SIZES.contains(&value.abs()) {
        return Some(value);
    }
    if value.is_finite() {
        let (least, most) = (SIZES.start(), SIZES.end());
        faults.at(
            at,
            format!(
                "this is {value:e}{place}; a number that is not 0 has a size from {least:e} to {most:e}"
            ),
        );
    } else {
        faults.at(
            at,
            format!("this is {value}{place}; a finite number is needed"),
        );
    }
    None
}

/// Behind a number that the macro sees at the typical values of parameters.
pub const AT_LIKES: &str = " at the typical values of parameters (`like`)";

/// The elements of an expression in brackets.
#[must_use]
pub fn elements(expr: &Expr) -> Option<Vec<&Expr>> {
    match ungroup(expr) {
        Expr::Array(array) => Some(array.elems.iter().collect()),
        _ => None,
    }
}

//! Fields that are arrays, `links: [Body; 16]`: each element becomes a field of its own, with its
//! number in the place of `k`.
//!
//! Behind this there are bodies, joints, forces and values with names such as `links[3]`, and
//! nothing else. `if` is decided here, and so is `%`; what names an element of another array,
//! `links[k - 1]`, keeps its place until all names are known.

use proc_macro2::{Literal, Span, TokenStream, TokenTree};
use quote::{ToTokens, quote_spanned};
use syn::spanned::Spanned;
use syn::{BinOp, Expr, ExprIf, Ident, Stmt, Type, TypeArray};

use super::field::Field;
use super::integer::{condition, integer};
use super::{KeyValue, List, Value, ungroup};
use crate::diag::{Faults, code};
use crate::model::Name;

/// The word for the number of an element.
pub const INDEX: &str = "k";
/// The most elements of an array: a mistyped length is not worth the memory of the machine.
const LONGEST: usize = 1000;

/// The array that a type is.
#[must_use]
pub fn array(ty: &Type) -> Option<&TypeArray> {
    match ty {
        Type::Group(group) => array(&group.elem),
        Type::Paren(paren) => array(&paren.elem),
        Type::Array(array) => Some(array),
        _ => None,
    }
}

/// The type of a field, or of its elements.
#[must_use]
pub fn element_type(ty: &Type) -> &Type {
    array(ty).map_or(ty, |array| element_type(&array.elem))
}

/// Lengths by names of constants, `#[mechanism(N = 16)]`.
pub type Lengths = Vec<(Ident, usize)>;

/// The elements of a field as fields, and whether their number is known; where it was refused, the
/// first stands for all.
pub(super) fn elements(field: Field, lengths: &Lengths, faults: &mut Faults) -> (Vec<Field>, bool) {
    let Some(written) = array(&field.written) else {
        let list = if lengths.is_empty() {
            field.list
        } else {
            let words = Words {
                index: None,
                lengths,
            };
            placed_list(&field.list, words, faults)
        };
        return (vec![Field { list, ..field }], true);
    };
    let length = length(&field, written, lengths, faults);
    let elements = (0..length.unwrap_or(1)).map(|index| {
        let name = Name::element(field.name.field().clone(), index);
        let words = Words {
            index: Some(index),
            lengths,
        };
        let list = faults.within(&name, |faults| placed_list(&field.list, words, faults));
        Field {
            name,
            list,
            written: field.written.clone(),
            ty: field.ty.clone(),
            role: field.role.clone(),
            context: field.context.clone(),
            origin: field.origin,
        }
    });
    (elements.collect(), length.is_some())
}

/// What names stand for.
#[derive(Clone, Copy)]
struct Words<'a> {
    /// The number of the element, in an array.
    index: Option<usize>,
    /// Constants whose values are given.
    lengths: &'a Lengths,
}

impl Words<'_> {
    fn value(self, name: &Ident) -> Option<usize> {
        if is_index(name) {
            return self.index;
        }
        let known = self.lengths.iter().find(|(known, _)| known == name);
        known.map(|(_, value)| *value)
    }
}

fn length(
    field: &Field,
    array: &TypeArray,
    lengths: &Lengths,
    faults: &mut Faults,
) -> Option<usize> {
    let name = &field.name;
    if let Some(inner) = self::array(&array.elem) {
        let (outer, inner) = (code(&array.len), code(&inner.len));
        faults.at(
            &field.written,
            format!(
                "`{name}` is an array of arrays; write one of `{outer} * {inner}` elements, in figures, and take rows and columns from `{INDEX}` \
                 by `/` and `%`"
            ),
        );
        return None;
    }
    let named = |path: &syn::ExprPath| {
        let name = path.path.get_ident()?;
        let known = lengths.iter().find(|(known, _)| known == name);
        known.map(|(_, length)| length.to_string())
    };
    let (written, length) = match ungroup(&array.len) {
        Expr::Lit(syn::ExprLit {
            lit: syn::Lit::Int(literal),
            ..
        }) => (literal.to_string(), literal.base10_parse::<usize>().ok()),
        Expr::Path(path) if let Some(length) = named(path) => {
            let parsed = length.parse().ok();
            (length, parsed)
        }
        other => {
            let found = code(other);
            let advice = match other {
                Expr::Path(path) if path.path.get_ident().is_some_and(is_constant) => {
                    format!(", or say it in `#[mechanism({found} = 16)]`")
                }
                _ => String::new(),
            };
            faults.at(
                &array.len,
                format!("the macro cannot see how many elements `{found}` are; write the length of `{name}` in figures, as in `[{}; 16]`{advice}", code(&field.ty)),
            );
            return None;
        }
    };
    match length {
        Some(length) if (1..=LONGEST).contains(&length) => Some(length),
        _ => {
            faults.at(
                &array.len,
                format!("`{name}` has {written} elements; an array has from 1 to {LONGEST}"),
            );
            None
        }
    }
}

/// Whether a name is that of a constant: `N`, `LEGS`.
#[must_use]
pub fn is_constant(name: &Ident) -> bool {
    let text = name.to_string();
    text.starts_with(|first: char| first.is_ascii_uppercase())
        && text
            .chars()
            .all(|c| matches!(c, 'A'..='Z' | '0'..='9' | '_'))
}

/// The lengths that the list of `#[mechanism(..)]` gives.
pub(super) fn lengths(list: &List, faults: &mut Faults) -> Lengths {
    let mut lengths = Lengths::new();
    for KeyValue { key, value } in list.pairs.iter().filter(|pair| is_constant(&pair.key)) {
        let Value::Expr(expr) = value else { continue };
        let length = match ungroup(expr) {
            Expr::Lit(syn::ExprLit {
                lit: syn::Lit::Int(literal),
                ..
            }) => literal.base10_parse().ok(),
            _ => None,
        };
        match length {
            Some(length) => lengths.push((key.clone(), length)),
            None => faults.at(
                expr,
                format!("`{key}` takes the value of the constant in figures, as in `{key} = 16`"),
            ),
        }
    }
    lengths
}

fn placed_list(list: &List, words: Words<'_>, faults: &mut Faults) -> List {
    let pairs = list.pairs.iter().map(|KeyValue { key, value }| {
        let value = match value {
            Value::Expr(expr) => placed(expr, words, faults)
                .map_or(Value::Faulty, |placed| Value::Expr(Box::new(placed))),
            other => other.clone(),
        };
        let key = key.clone();
        KeyValue { key, value }
    });
    List {
        pairs: pairs.collect(),
        unreadable: list.unreadable,
    }
}

/// An expression for one element. What is no expression of the language is left as it is; it is
/// refused where it is read.
fn placed(expr: &Expr, words: Words<'_>, faults: &mut Faults) -> Option<Expr> {
    let mut result = expr.clone();
    let mut inner = |expr: &mut Expr| -> Option<()> {
        *expr = placed(expr, words, faults)?;
        Some(())
    };
    match &mut result {
        Expr::Path(path) => {
            let value = path.path.get_ident().and_then(|name| words.value(name));
            if let Some(value) = value {
                return Some(literal(value, path.span()));
            }
        }
        Expr::Group(group) => inner(&mut group.expr)?,
        Expr::Paren(paren) => inner(&mut paren.expr)?,
        Expr::Unary(unary) => inner(&mut unary.expr)?,
        Expr::Binary(binary) => {
            let operands = [&mut binary.left, &mut binary.right].into_iter();
            every(operands.map(|operand| inner(operand)))?;
            if words.index.is_some()
                && let BinOp::Rem(_) = binary.op
            {
                return remainder(&result, faults);
            }
        }
        Expr::Array(array) => every(array.elems.iter_mut().map(inner))?,
        Expr::Call(call) => {
            // A spline among several.
            if let Expr::Index(_) | Expr::Field(_) = ungroup(&call.func) {
                inner(&mut call.func)?;
            }
            every(call.args.iter_mut().map(inner))?;
        }
        // An argument by its name, such as the radius of a shape.
        Expr::Assign(argument) => inner(&mut argument.right)?,
        Expr::Index(found) => {
            // A table of tables, or a field of a part.
            if let Expr::Index(_) | Expr::Field(_) = ungroup(&found.expr) {
                inner(&mut found.expr)?;
            }
            inner(&mut found.index)?;
        }
        Expr::Field(field) => {
            if let Expr::Index(_) | Expr::Field(_) = ungroup(&field.base) {
                inner(&mut field.base)?;
            }
        }
        // One of a law is read there.
        Expr::If(choice) if is_of_a_law(&choice.cond, words) => {
            inner(&mut choice.cond)?;
            let then = only_mut(&mut choice.then_branch);
            let otherwise = choice.else_branch.as_mut();
            let otherwise = otherwise.and_then(|(_, otherwise)| match &mut **otherwise {
                Expr::Block(block) => only_mut(&mut block.block),
                other => Some(other),
            });
            every([then, otherwise].into_iter().flatten().map(inner))?;
        }
        Expr::If(choice) if words.index.is_some() => {
            let chosen = chosen(choice, words, faults)?;
            return placed(chosen, words, faults);
        }
        Expr::Cast(cast) if words.index.is_some() => {
            let number = code(&cast.expr);
            let message = format!(
                "numbers are not converted here, and integers are numbers; write `{number}`"
            );
            faults.at(expr, message);
            return None;
        }
        _ => {}
    }
    Some(result)
}

/// Goes on behind the first fault, so that all are found.
fn every(results: impl Iterator<Item = Option<()>>) -> Option<()> {
    results.fold(Some(()), Option::and)
}

fn literal(value: usize, span: Span) -> Expr {
    let mut literal = Literal::usize_unsuffixed(value);
    literal.set_span(span);
    Expr::Lit(syn::ExprLit {
        attrs: Vec::new(),
        lit: syn::Lit::new(literal),
    })
}

/// A remainder is one of integers, and then a number like any other.
fn remainder(expr: &Expr, faults: &mut Faults) -> Option<Expr> {
    let value = faults.accept(integer(expr))?;
    let (size, span) = (value.unsigned_abs(), expr.span());
    let size = literal(usize::try_from(size).ok()?, span);
    let tokens: TokenStream = match value {
        0.. => size.into_token_stream(),
        _ => quote_spanned!(span=> (-#size)),
    };
    faults.accept(syn::parse2(tokens))
}

/// What an `if` leaves for one element.
fn chosen<'a>(choice: &'a ExprIf, words: Words<'_>, faults: &mut Faults) -> Option<&'a Expr> {
    let condition =
        placed(&choice.cond, words, faults).and_then(|expr| faults.accept(condition(&expr)));
    let then = only(&choice.then_branch, faults);
    let Some((_, otherwise)) = &choice.else_branch else {
        faults.at(
            choice.if_token,
            "an `if` needs an `else` here: every element has a value",
        );
        return None;
    };
    let otherwise = match &**otherwise {
        Expr::Block(block) => only(&block.block, faults),
        other => Some(other),
    };
    let (then, otherwise) = (then?, otherwise?);
    Some(if condition? { then } else { otherwise })
}

/// What stands in braces.
pub(crate) fn only<'a>(block: &'a syn::Block, faults: &mut Faults) -> Option<&'a Expr> {
    if let [Stmt::Expr(expr, None)] = &block.stmts[..] {
        return Some(expr);
    }
    faults.at(block, "expected one expression in these braces");
    None
}

/// The same to be changed; `None` where there is something else, which is refused later.
fn only_mut(block: &mut syn::Block) -> Option<&mut Expr> {
    match &mut block.stmts[..] {
        [Stmt::Expr(expr, None)] => Some(expr),
        _ => None,
    }
}

/// Whether a condition speaks of more than the index and constants.
fn is_of_a_law(condition: &Expr, words: Words<'_>) -> bool {
    fn has(tokens: TokenStream, words: Words<'_>) -> bool {
        tokens.into_iter().any(|token| match token {
            TokenTree::Group(group) => has(group.stream(), words),
            TokenTree::Ident(name) => words.value(&name).is_none() && !is_constant(&name),
            _ => false,
        })
    }
    has(condition.to_token_stream(), words)
}

/// Whether a field, or an argument of a law, has the name of the index.
#[must_use]
pub fn is_index(name: &Ident) -> bool {
    name == INDEX
}

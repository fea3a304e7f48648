//! What was written: tokens with their spans, no meaning yet.

pub mod array;
mod attributes;
pub mod depth;
mod field;
pub mod files;
pub mod integer;
pub mod joint;
pub mod mechanism;
pub mod motion;
mod part;
mod piece;
pub mod words;

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use syn::parse::{Parse, ParseStream, Parser};
use syn::{Ident, Token};

pub use self::piece::{Piece, split};
use crate::diag::Faults;

impl Piece {
    /// Parses the whole piece, unless it is too deep. What is missing at its end is reported at its
    /// last token.
    pub fn parse<T>(
        &self,
        parser: impl FnOnce(ParseStream<'_>) -> syn::Result<T>,
        faults: &mut Faults,
    ) -> Option<T> {
        faults.accept(depth::of_expression(&self.tokens))?;
        self.parse_outline(parser, faults)
    }

    /// Parses the whole piece, however deep, with a parser that leaves what stands in brackets
    /// alone.
    fn parse_outline<T>(
        &self,
        parser: impl FnOnce(ParseStream<'_>) -> syn::Result<T>,
        faults: &mut Faults,
    ) -> Option<T> {
        let last = self.tokens.clone().into_iter().last();
        let end = last.map_or(self.end, |token| token.span());
        // The parser reports what is missing at the end of the brackets that it reads in.
        let mut group = Group::new(Delimiter::Brace, self.tokens.clone());
        group.set_span(end);
        let within = |input: ParseStream<'_>| {
            let content;
            syn::braced!(content in input);
            let value = parser(&content)?;
            if content.is_empty() {
                Ok(value)
            } else {
                Err(content.error("unexpected token"))
            }
        };
        let result = within.parse2(TokenTree::from(group).into());
        faults.accept(result.map_err(|error| self.sentence(error)))
    }

    /// The parser's words for what is missing at an end, put for a piece.
    fn sentence(&self, error: syn::Error) -> syn::Error {
        let message = error.to_string();
        match message.strip_prefix("unexpected end of input, ") {
            Some(rest) if self.tokens.is_empty() => syn::Error::new(error.span(), rest),
            Some(rest) => syn::Error::new(error.span(), format!("{rest} behind this")),
            None => error,
        }
    }
}

/// Takes invisible groups, which `macro_rules` leave around fragments, away.
#[must_use]
pub fn ungroup(expr: &syn::Expr) -> &syn::Expr {
    match expr {
        syn::Expr::Group(group) => ungroup(&group.expr),
        syn::Expr::Paren(paren) => ungroup(&paren.expr),
        other => other,
    }
}

/// The list of an attribute such as `#[body(..)]`.
#[derive(Clone, Debug, Default)]
pub struct List {
    /// Its pairs.
    pub pairs: Vec<KeyValue>,
    /// Whether a piece could not be read: what seems to be missing may be in it.
    pub unreadable: bool,
}

/// `key` or `key = value`.
#[derive(Clone, Debug)]
pub struct KeyValue {
    /// The key.
    pub key: Ident,
    /// What stands behind it.
    pub value: Value,
}

/// What stands behind a key.
#[derive(Clone, Debug)]
pub enum Value {
    /// Nothing.
    None,
    /// An expression.
    Expr(Box<syn::Expr>),
    /// Something that was reported.
    Faulty,
}

/// A key and the rest of its piece.
struct Keyed {
    key: Ident,
    rest: TokenStream,
}

impl Parse for Keyed {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let key = input.parse::<Ident>().map_err(|error| {
            let message = "expected an attribute's name, as in `mass = 7.02`";
            syn::Error::new(error.span(), message)
        })?;
        Ok(Self {
            key,
            rest: input.parse()?,
        })
    }
}

/// The list of an attribute; a faulty pair is reported.
pub fn list(attribute: &syn::Attribute, faults: &mut Faults) -> List {
    let mut list = List::default();
    let tokens = match &attribute.meta {
        syn::Meta::Path(_) => return list,
        syn::Meta::List(found) if delimiter(found) == Delimiter::Parenthesis => {
            found.tokens.clone()
        }
        other => {
            let word = other
                .path()
                .get_ident()
                .map_or_else(String::new, ToString::to_string);
            let example = match word.as_str() {
                "body" => "#[body(mass = 7.02, ..)]",
                "joint" => "#[joint(between = [ground, rod], ..)]",
                "force" => "#[force(between = [ground, rod], ..)]",
                "param" => "#[param(like = 0.8)]",
                "state" => "#[state(rate = -current / 0.1)]",
                "point" => "#[point(on = rod, at = [0.0, 0.5, 0.0])]",
                "part" => "#[part(at = [0.0, 0.5, 0.0], ..)]",
                _ => "#[mechanism(gravity = [0.0, 0.0, -9.81])]",
            };
            faults.at(
                other,
                format!("expected a list in parentheses, as in `{example}`"),
            );
            list.unreadable = true;
            return list;
        }
    };
    for piece in split(tokens, ',') {
        if piece.tokens.is_empty() {
            faults.at_span(piece.end, "one `,` is too many here");
            continue;
        }
        let Some(Keyed { key, rest }) = piece.parse(Keyed::parse, faults) else {
            list.unreadable = true;
            continue;
        };
        let rest = Piece {
            tokens: rest,
            end: piece.end,
        };
        let value = value(&key, &rest, faults);
        // Where a `,` is missing, the next key is hidden in this value.
        list.unreadable |= matches!(value, Value::Faulty);
        list.pairs.push(KeyValue { key, value });
    }
    list
}

fn value(key: &Ident, piece: &Piece, faults: &mut Faults) -> Value {
    let parser = |input: ParseStream<'_>| {
        if input.is_empty() {
            return Ok(Value::None);
        }
        if !input.peek(Token![=]) {
            return Err(input.error(format!("expected `=` or `,` behind `{key}`")));
        }
        let equals: Token![=] = input.parse()?;
        if input.is_empty() {
            let message = format!("`{key}` needs a value behind `=`");
            return Err(syn::Error::new(equals.span, message));
        }
        let value = input.parse()?;
        if !input.is_empty() {
            return Err(input.error(format!("expected `,` behind the value of `{key}`")));
        }
        Ok(Value::Expr(Box::new(value)))
    };
    piece.parse(parser, faults).unwrap_or(Value::Faulty)
}

fn delimiter(list: &syn::MetaList) -> Delimiter {
    match list.delimiter {
        syn::MacroDelimiter::Paren(_) => Delimiter::Parenthesis,
        syn::MacroDelimiter::Brace(_) => Delimiter::Brace,
        syn::MacroDelimiter::Bracket(_) => Delimiter::Bracket,
    }
}

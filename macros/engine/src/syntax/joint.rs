//! `joint!` blocks.
//!
//! ```text
//! /// Documentation.
//! pub joint Name(i, j; point: Point, axis: Axis) {
//!     j.point - i.point;                   // vectors give three equations, scalars one
//!     dot(i.axis.normals(), j.axis);       // normals are two vectors: two equations
//!     angle about axis;                    // the joint has an angle
//! }
//! ```

use proc_macro2::{Delimiter, Ident, Span, TokenStream, TokenTree};
use syn::parse::{Parse, ParseStream};
use syn::{Attribute, Token, Visibility};

use super::{Piece, split};
use crate::diag::{Faults, list};
use crate::model::ParameterKind;

/// A `joint!` block as written.
#[derive(Clone, Debug)]
pub struct JointSyntax {
    /// Documentation and other attributes.
    pub attributes: Vec<Attribute>,
    /// The visibility of the joint.
    pub visibility: Visibility,
    /// Its name.
    pub name: Ident,
    /// Its formal bodies.
    pub bodies: Vec<Ident>,
    /// Names and kinds of its parameters.
    pub parameters: Vec<(Ident, Ident)>,
    /// What stands in the braces.
    pub statements: Vec<Statement>,
    /// Everything behind the word `joint`, for transport.
    pub body: TokenStream,
    /// Whether bodies, parameters and equations could be told apart; if not, that was reported.
    pub is_complete: bool,
}

/// A statement of a `joint!` block.
#[derive(Clone, Debug)]
pub enum Statement {
    /// An expression that is zero.
    Zero(Box<syn::Expr>),
    /// `angle about axis`.
    Angle {
        /// The word `angle`.
        keyword: Ident,
        /// The axis.
        axis: Ident,
    },
}

struct Head {
    attributes: Vec<Attribute>,
    visibility: Visibility,
    keyword: Span,
    rest: TokenStream,
}

impl Parse for Head {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let attributes = input.call(Attribute::parse_outer)?;
        let visibility = input.parse()?;
        let keyword: Option<Ident> = input.parse()?;
        if keyword.as_ref().is_none_or(|keyword| keyword != "joint") {
            let span = keyword.map_or_else(|| input.span(), |keyword| keyword.span());
            return Err(syn::Error::new(
                span,
                "expected `joint`, as in `pub joint Hinge(i, j; point: Point) { .. }`",
            ));
        }
        let keyword = keyword.map_or_else(Span::call_site, |keyword| keyword.span());
        Ok(Self {
            attributes,
            visibility,
            keyword,
            rest: input.parse()?,
        })
    }
}

/// Parses a `joint!` block; what can be understood of a faulty one is kept.
pub fn parse(tokens: TokenStream, faults: &mut Faults) -> Option<JointSyntax> {
    let head: Head = faults.accept(syn::parse2(tokens))?;
    if head.rest.is_empty() {
        faults.at_span(head.keyword, "expected the joint's name behind `joint`");
        return None;
    }
    let mut joint = parse_transported(head.rest, faults)?;
    joint.attributes = head.attributes;
    joint.visibility = head.visibility;
    Some(joint)
}

/// Parses what stands behind the word `joint`; of a faulty one at least the name is kept.
pub fn parse_transported(body: TokenStream, faults: &mut Faults) -> Option<JointSyntax> {
    let mut joint = JointSyntax {
        attributes: Vec::new(),
        visibility: Visibility::Inherited,
        name: Ident::new("_", Span::call_site()),
        bodies: Vec::new(),
        parameters: Vec::new(),
        statements: Vec::new(),
        body: body.clone(),
        is_complete: false,
    };
    let named =
        |input: ParseStream<'_>| Ok((input.parse::<Ident>()?, input.parse::<TokenStream>()?));
    let whole = Piece {
        tokens: body,
        end: Span::call_site(),
    };
    let (name, rest) = whole.parse(named, faults)?;
    let rest = Piece {
        end: name.span(),
        tokens: rest,
    };
    joint.name = name;
    let Some((signature, block)) = rest.parse(outline, faults) else {
        return Some(joint);
    };
    joint.is_complete = true;
    let mut halves = split(signature, ';').into_iter();
    if let Some(half) = halves.next() {
        let pieces = split(half.tokens, ',');
        joint.bodies = names(&pieces, faults);
        joint.is_complete &= joint.bodies.len() == pieces.len();
    }
    if let Some(half) = halves.next() {
        let pieces = split(half.tokens, ',');
        joint.parameters = parameters(&pieces, faults);
        joint.is_complete &= joint.parameters.len() == pieces.len();
    }
    if let Some(excess) = halves.next() {
        faults.at(
            excess.tokens,
            "expected one `;`, between the bodies and the parameters",
        );
    }
    joint.statements = split(block, ';')
        .iter()
        .filter_map(|piece| statement(piece, faults))
        .collect();
    Some(joint)
}

fn outline(input: ParseStream<'_>) -> syn::Result<(TokenStream, TokenStream)> {
    let signature = group(
        input,
        Delimiter::Parenthesis,
        "the joint's bodies in parentheses, as in `(i, j)`",
    )?;
    let block = group(input, Delimiter::Brace, "the joint's equations in braces")?;
    if !input.is_empty() {
        return Err(input.error(
            "expected nothing behind the joint's equations; write one `joint!` for each joint",
        ));
    }
    Ok((signature, block))
}

fn group(input: ParseStream<'_>, delimiter: Delimiter, what: &str) -> syn::Result<TokenStream> {
    if input.is_empty() {
        return Err(input.error(format!("expected {what}")));
    }
    match input.parse::<TokenTree>()? {
        TokenTree::Group(group) if group.delimiter() == delimiter => Ok(group.stream()),
        other => Err(syn::Error::new(other.span(), format!("expected {what}"))),
    }
}

fn names(pieces: &[Piece], faults: &mut Faults) -> Vec<Ident> {
    pieces
        .iter()
        .filter_map(|piece| piece.parse(name, faults))
        .collect()
}

fn name(input: ParseStream<'_>) -> syn::Result<Ident> {
    input.parse().map_err(|error: syn::Error| {
        syn::Error::new(
            error.span(),
            "expected a name, as in `(i, j; point: Point)`",
        )
    })
}

fn parameters(pieces: &[Piece], faults: &mut Faults) -> Vec<(Ident, Ident)> {
    let parameter = |input: ParseStream<'_>| {
        let name = name(input)?;
        if !input.peek(Token![:]) {
            let message = format!("`{name}` needs a kind, as in `{name}: Point`");
            let at = if input.is_empty() {
                name.span()
            } else {
                input.span()
            };
            return Err(syn::Error::new(at, message));
        }
        let colon: Token![:] = input.parse()?;
        let kind = input.parse().map_err(|_: syn::Error| {
            let kinds = list(ParameterKind::ALL.map(|(word, _)| word));
            let at = if input.is_empty() {
                colon.span
            } else {
                input.span()
            };
            syn::Error::new(
                at,
                format!("expected the kind of `{name}`; there are {kinds}"),
            )
        })?;
        if !input.is_empty() {
            return Err(input.error("expected `,` or `)` behind the kind"));
        }
        Ok((name, kind))
    };
    pieces
        .iter()
        .filter_map(|piece| piece.parse(parameter, faults))
        .collect()
}

fn statement(piece: &Piece, faults: &mut Faults) -> Option<Statement> {
    let Piece { tokens, end } = piece;
    let words: Vec<Ident> = tokens
        .clone()
        .into_iter()
        .map_while(|token| match token {
            TokenTree::Ident(ident) => Some(ident),
            _ => None,
        })
        .collect();
    if let [keyword, about, rest @ ..] = words.as_slice()
        && keyword == "angle"
        && about == "about"
    {
        return match rest {
            [axis] if tokens.clone().into_iter().count() == 3 => Some(Statement::Angle {
                keyword: keyword.clone(),
                axis: axis.clone(),
            }),
            _ => {
                faults.at(tokens, "expected an axis, as in `angle about axis`");
                None
            }
        };
    }
    if tokens.is_empty() {
        faults.at_span(*end, "one `;` is too many here");
        return None;
    }
    let equation = |input: ParseStream<'_>| {
        let expr = input.parse()?;
        if !input.is_empty() {
            return Err(input.error("expected an operator, or `;` behind the equation"));
        }
        Ok(Statement::Zero(Box::new(expr)))
    };
    piece.parse(equation, faults)
}

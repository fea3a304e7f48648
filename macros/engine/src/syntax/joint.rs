//! `joint!` and `force!` blocks.
//!
//! ```text
//! /// Documentation.
//! pub joint Name(i, j; point: Point, axis: Axis) {
//!     j.point - i.point;                   // vectors give three equations, scalars one
//!     dot(i.axis.normals(), j.axis);       // normals are two vectors: two equations
//!     angle about axis;                    // the joint has an angle
//!     motion turn axis at point;           // what the equations leave free
//!     require dot(i.axis, j.axis) > 0;     // which of the solutions is meant
//! }
//!
//! pub force Name(i, j; head: Point, tail: Point, stiffness: Number, damping: Number = 0.0) {
//!     let d = length(j.tail - i.head);
//!     potential 0.5 * stiffness * d * d;   // minus its gradient acts
//!     -damping * rate(d) along d;          // a generalised force and its coordinate
//! }
//! ```

use proc_macro2::{Delimiter, Ident, Span, TokenStream, TokenTree};
use quote::ToTokens;
use syn::parse::{Parse, ParseStream, Parser};
use syn::punctuated::Punctuated;
use syn::{Attribute, Token, Visibility};

use super::motion::{MotionSyntax, motions};
use super::piece::around;
use super::{Piece, split};
use crate::diag::{Faults, list};
use crate::model::{ElementKind, ParameterKind};

/// A parameter as written.
#[derive(Clone, Debug)]
pub struct ParameterSyntax {
    /// The name.
    pub name: Ident,
    /// The word of its kind.
    pub kind: Ident,
    /// The names in parentheses behind the kind.
    pub arguments: Vec<Ident>,
    /// What stands behind `=`.
    pub default: Option<syn::Expr>,
}

/// A `joint!` or `force!` block as written.
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
    /// Its parameters.
    pub parameters: Vec<ParameterSyntax>,
    /// What stands in the braces.
    pub statements: Vec<Statement>,
    /// Joint or force.
    pub kind: ElementKind,
    /// Everything behind the word `joint` or `force`, for transport.
    pub body: TokenStream,
    /// Whether bodies, parameters and equations could be told apart; if not, that was reported.
    pub is_complete: bool,
}

/// A statement of a block.
#[derive(Clone, Debug)]
pub enum Statement {
    /// An expression that is zero.
    Zero(Box<syn::Expr>),
    /// `let name = expr`, without an expression where that could not be read.
    Let(Ident, Option<Box<syn::Expr>>),
    /// `angle about axis`, or `angle about first, second`.
    Angle {
        /// The word `angle`.
        keyword: Ident,
        /// The axis, or both.
        axes: Vec<Ident>,
    },
    /// `displacement expr`.
    Displacement(Ident, Box<syn::Expr>),
    /// `contact expr, expr`: the word, the point, the normal.
    Contact(Ident, Box<syn::Expr>, Box<syn::Expr>),
    /// `motion ..`.
    Motion {
        /// The word `motion`.
        keyword: Ident,
        /// All tokens.
        tokens: TokenStream,
        /// The motions; none of `motion none`.
        motions: Vec<MotionSyntax>,
    },
    /// `require expr > 0`.
    Require(Ident, Box<syn::Expr>),
    /// `drive expr to expr`.
    Drive(Ident, Box<syn::Expr>, Box<syn::Expr>),
    /// `potential expr`.
    Potential(Ident, Box<syn::Expr>),
    /// `expr along expr`: effort, the word `along`, coordinate.
    Along(Box<syn::Expr>, Ident, Box<syn::Expr>),
    /// `force expr at expr`.
    Force(Ident, Box<syn::Expr>, Box<syn::Expr>),
    /// `moment expr on body`.
    Moment(Ident, Box<syn::Expr>, Box<syn::Expr>),
}

struct Head {
    attributes: Vec<Attribute>,
    visibility: Visibility,
    keyword: Option<Ident>,
    end: Span,
    rest: TokenStream,
}

impl Parse for Head {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let attributes = input.call(Attribute::parse_outer)?;
        let visibility = input.parse()?;
        Ok(Self {
            attributes,
            visibility,
            keyword: input.parse()?,
            end: input.span(),
            rest: input.parse()?,
        })
    }
}

/// Parses a block; what can be understood of a faulty one is kept.
pub fn parse(tokens: TokenStream, kind: ElementKind, faults: &mut Faults) -> Option<JointSyntax> {
    let word = kind.word();
    let last = tokens.clone().into_iter().last();
    let whole = Piece {
        tokens,
        end: last.map_or_else(Span::call_site, |token| token.span()),
    };
    let head = whole.parse_outline(Head::parse, faults)?;
    let keyword = match head.keyword {
        Some(keyword) if keyword == word => keyword,
        found => {
            let name = found.as_ref().map_or_else(String::new, Ident::to_string);
            let message = match (kind, name.as_str()) {
                (_, "joint" | "force") => {
                    format!("a `{word}` is defined here; a {name} by `{name}! {{ .. }}`")
                }
                (ElementKind::Joint, _) => {
                    "expected `joint`, as in `pub joint Hinge(i, j; point: Point) { .. }`".into()
                }
                (ElementKind::Force, _) => {
                    "expected `force`, as in `pub force Spring(i, j; head: Point, tail: Point) { .. }`"
                        .into()
                }
            };
            faults.at_span(found.map_or(head.end, |found| found.span()), message);
            return None;
        }
    };
    if head.rest.is_empty() {
        faults.at_span(
            keyword.span(),
            format!("expected the {word}'s name behind `{word}`"),
        );
        return None;
    }
    let mut joint = parse_transported(head.rest, kind, faults)?;
    joint.attributes = head.attributes;
    joint.visibility = head.visibility;
    Some(joint)
}

/// Parses what stands behind the word `joint` or `force`; of a faulty one at least the name is
/// kept.
pub fn parse_transported(
    body: TokenStream,
    kind: ElementKind,
    faults: &mut Faults,
) -> Option<JointSyntax> {
    let mut joint = JointSyntax {
        attributes: Vec::new(),
        visibility: Visibility::Inherited,
        name: Ident::new("_", Span::call_site()),
        bodies: Vec::new(),
        parameters: Vec::new(),
        statements: Vec::new(),
        kind,
        body: body.clone(),
        is_complete: false,
    };
    let named =
        |input: ParseStream<'_>| Ok((input.parse::<Ident>()?, input.parse::<TokenStream>()?));
    let whole = Piece {
        tokens: body,
        end: Span::call_site(),
    };
    let (name, rest) = whole.parse_outline(named, faults)?;
    let rest = Piece {
        end: name.span(),
        tokens: rest,
    };
    joint.name = name;
    let Some((signature, block)) =
        rest.parse_outline(|input: ParseStream<'_>| outline(input, kind), faults)
    else {
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

fn outline(input: ParseStream<'_>, kind: ElementKind) -> syn::Result<(TokenStream, TokenStream)> {
    let word = kind.word();
    let content = match kind {
        ElementKind::Joint => "joint's equations",
        ElementKind::Force => "force's statements",
    };
    let signature = group(
        input,
        Delimiter::Parenthesis,
        &format!("the {word}'s bodies in parentheses, as in `(i, j)`"),
    )?;
    let block = group(input, Delimiter::Brace, &format!("the {content} in braces"))?;
    if !input.is_empty() {
        return Err(input.error(format!(
            "expected nothing behind the {content}; write one `{word}!` for each {word}"
        )));
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

fn parameters(pieces: &[Piece], faults: &mut Faults) -> Vec<ParameterSyntax> {
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
        let mut arguments = Vec::new();
        if input.peek(syn::token::Paren) {
            let inside;
            syn::parenthesized!(inside in input);
            let argument = |input: ParseStream<'_>| {
                input.parse::<Ident>().map_err(|error| {
                    let message = "expected an argument's name, as in `Law(length, rate)`";
                    syn::Error::new(error.span(), message)
                })
            };
            arguments.extend(inside.parse_terminated(argument, Token![,])?);
        }
        let mut default = None;
        if input.peek(Token![=]) {
            let _: Token![=] = input.parse()?;
            default = Some(input.parse()?);
        }
        if !input.is_empty() {
            return Err(input.error("expected `,` or `)` behind the kind"));
        }
        Ok(ParameterSyntax {
            name,
            kind,
            arguments,
            default,
        })
    };
    pieces
        .iter()
        .filter_map(|piece| piece.parse(parameter, faults))
        .collect()
}

/// The word at the start of a piece, where an operand and no operator stands behind it, and the
/// rest. A parenthesis or a sign may open the operand of a word that is no name, or of one that
/// another word follows; else it is a call, or a difference.
fn keyword(piece: &Piece) -> Option<(Ident, Piece)> {
    let mut tokens = piece.tokens.clone().into_iter();
    let Some(TokenTree::Ident(keyword)) = tokens.next() else {
        return None;
    };
    let rest = Piece {
        tokens: tokens.collect(),
        end: piece.end,
    };
    let is_statement = match keyword.to_string().as_str() {
        "potential" | "displacement" => true,
        "contact" => split(rest.tokens.clone(), ',').len() > 1,
        "require" => is_inequality(&rest),
        "drive" => around(&rest, "to").is_some(),
        "force" => around(&rest, "at").is_some(),
        "moment" => around(&rest, "on").is_some(),
        _ => false,
    };
    let operand = match rest.tokens.clone().into_iter().next() {
        Some(TokenTree::Punct(punct)) => punct.as_char() == '-' && is_statement,
        Some(TokenTree::Group(group)) => group.delimiter() == Delimiter::Bracket || is_statement,
        // `let` is nothing else.
        None => keyword == "let",
        Some(_) => true,
    };
    operand.then_some((keyword, rest))
}

/// Whether a comparison stands in a piece, which is no expression of the language.
fn is_inequality(piece: &Piece) -> bool {
    let mut tokens = piece.tokens.clone().into_iter();
    tokens.any(|token| matches!(&token, TokenTree::Punct(punct) if matches!(punct.as_char(), '<' | '>' | '=')))
}

fn statement(piece: &Piece, faults: &mut Faults) -> Option<Statement> {
    if piece.tokens.is_empty() {
        faults.at_span(piece.end, "one `;` is too many here");
        return None;
    }
    let mut words = piece.tokens.clone().into_iter();
    let (first, second) = (words.next(), words.next());
    let begins_with =
        |word: &str| matches!(&first, Some(TokenTree::Ident(found)) if *found == word);
    let is_binding = begins_with("let");
    // A number or a law may bear this name, and then no other word follows but `along`.
    let is_motion =
        begins_with("motion") && matches!(second, Some(TokenTree::Ident(word)) if word != "along");
    if !is_binding
        && !is_motion
        && let Some((effort, word, coordinate)) = around(piece, "along")
    {
        let effort = expression(&effort, faults);
        let coordinate = expression(&coordinate, faults);
        return Some(Statement::Along(effort?, word, coordinate?));
    }
    let Some((keyword, rest)) = keyword(piece) else {
        return expression(piece, faults).map(Statement::Zero);
    };
    if keyword == "along" {
        faults.at(
            &keyword,
            "expected a force or a moment before `along`, as in `-damping * rate(d) along d`",
        );
        return None;
    }
    let mut pair = |word: &str, example: &str| {
        let Some((first, _, second)) = around(&rest, word) else {
            faults.at(
                &keyword,
                format!("expected `{word}` behind it, as in `{example}`"),
            );
            return None;
        };
        let (first, second) = (expression(&first, faults), expression(&second, faults));
        Some((first?, second?))
    };
    match keyword.to_string().as_str() {
        "let" => binding(&rest, faults),
        "angle" => {
            let about = |input: ParseStream<'_>| {
                let about: Ident = input.parse()?;
                let axes = Punctuated::<Ident, Token![,]>::parse_separated_nonempty(input)?;
                if about != "about" || axes.len() > 2 || !input.is_empty() {
                    return Err(input.error("expected an axis"));
                }
                Ok(axes.into_iter().collect())
            };
            let axes = about.parse2(rest.tokens).ok();
            if axes.is_none() {
                faults.at(
                    &piece.tokens,
                    "expected an axis, as in `angle about axis`, or two, as in `angle about first, second`",
                );
            }
            axes.map(|axes| Statement::Angle { keyword, axes })
        }
        "motion" => {
            let motions = motions(&rest, faults);
            let tokens = piece.tokens.clone();
            Some(Statement::Motion {
                keyword,
                tokens,
                motions,
            })
        }
        "displacement" => {
            expression(&rest, faults).map(|expr| Statement::Displacement(keyword, expr))
        }
        "contact" => contact(keyword, rest, faults),
        "require" => requirement(&rest, faults).map(|expr| Statement::Require(keyword, expr)),
        "potential" => expression(&rest, faults).map(|expr| Statement::Potential(keyword, expr)),
        "drive" => pair("to", "drive length(j.tail - i.head) to motion()")
            .map(|(driven, law)| Statement::Drive(keyword, driven, law)),
        "force" => pair("at", "force j.force at j.point")
            .map(|(vector, point)| Statement::Force(keyword, vector, point)),
        "moment" => pair("on", "moment j.moment on j")
            .map(|(vector, body)| Statement::Moment(keyword, vector, body)),
        _ => expression(piece, faults).map(Statement::Zero),
    }
}

/// The point of a contact and its normal.
fn contact(keyword: Ident, rest: Piece, faults: &mut Faults) -> Option<Statement> {
    let parts = split(rest.tokens, ',');
    let [point, normal] = parts.as_slice() else {
        faults.at(
            &keyword,
            "expected a point and a normal, as in `contact j.center - radius * i.normal, i.normal`",
        );
        return None;
    };
    let (point, normal) = (expression(point, faults), expression(normal, faults));
    Some(Statement::Contact(keyword, point?, normal?))
}

/// What is positive: `expr > 0`.
fn requirement(rest: &Piece, faults: &mut Faults) -> Option<Box<syn::Expr>> {
    let whole = expression(rest, faults)?;
    if let syn::Expr::Binary(syn::ExprBinary {
        left, op, right, ..
    }) = &*whole
        && let syn::BinOp::Gt(_) = op
        && let syn::Expr::Lit(literal) = &**right
        && let syn::Lit::Int(_) | syn::Lit::Float(_) = &literal.lit
        && literal.lit.to_token_stream().to_string().parse() == Ok(0.0)
    {
        return Some(left.clone());
    }
    faults.at(
        &rest.tokens,
        "expected `> 0` behind a scalar, as in `require dot(i.axis, j.axis) > 0`",
    );
    None
}

fn binding(rest: &Piece, faults: &mut Faults) -> Option<Statement> {
    let parser = |input: ParseStream<'_>| {
        let expected = |_| input.error("expected a name and `=`, as in `let d = j.tail - i.head`");
        let name: Ident = input.parse().map_err(expected)?;
        let _: Token![=] = input.parse().map_err(expected)?;
        let tokens: TokenStream = input.parse()?;
        Ok((name, tokens))
    };
    let (name, tokens) = rest.parse(parser, faults)?;
    let value = Piece {
        tokens,
        end: rest.end,
    };
    Some(Statement::Let(name, expression(&value, faults)))
}

fn expression(piece: &Piece, faults: &mut Faults) -> Option<Box<syn::Expr>> {
    let parser = |input: ParseStream<'_>| {
        let expr = input.parse()?;
        if !input.is_empty() {
            return Err(input.error("expected an operator, or `;` before this"));
        }
        Ok(Box::new(expr))
    };
    piece.parse(parser, faults)
}

#[cfg(test)]
mod tests {
    use proc_macro2::Span;
    use quote::quote;

    use super::{Piece, Statement, statement};
    use crate::diag::Faults;

    fn read(tokens: proc_macro2::TokenStream) -> Statement {
        let mut faults = Faults::new();
        let end = Span::call_site();
        let found = statement(&Piece { tokens, end }, &mut faults);
        let errors = faults.into_tokens();
        assert!(errors.is_empty(), "{errors}");
        found.expect("a statement")
    }

    #[test]
    fn an_operand_may_begin_with_a_parenthesis_or_a_sign() {
        use Statement::{Displacement, Drive, Force, Moment, Potential};
        assert!(matches!(
            read(quote!(force (a * b) * i.v at i.p)),
            Force(..)
        ));
        assert!(matches!(read(quote!(force -i.v at i.p)), Force(..)));
        assert!(matches!(read(quote!(moment -(a * i.v) on i)), Moment(..)));
        assert!(matches!(
            read(quote!(drive (a - b) / 2.0 to motion())),
            Drive(..)
        ));
        assert!(matches!(read(quote!(drive -a to motion())), Drive(..)));
        assert!(matches!(read(quote!(potential - a / b)), Potential(..)));
        assert!(matches!(
            read(quote!(displacement(a + b))),
            Displacement(..)
        ));
        assert!(matches!(read(quote!(displacement - a)), Displacement(..)));
        assert!(matches!(
            read(quote!(require - a > 0)),
            Statement::Require(..)
        ));
        assert!(matches!(
            read(quote!(require(a + b) * c > 0.0)),
            Statement::Require(..)
        ));
    }

    #[test]
    fn laws_and_numbers_may_bear_the_words_of_statements() {
        use Statement::{Along, Let, Motion, Zero};
        assert!(matches!(read(quote!(let along = i.axis)), Let(..)));
        assert!(matches!(read(quote!(force(d, rate(d)) along d)), Along(..)));
        assert!(matches!(read(quote!(moment - a)), Zero(..)));
        assert!(matches!(read(quote!(motion() - a)), Zero(..)));
        assert!(matches!(read(quote!(motion * a)), Zero(..)));
        assert!(matches!(read(quote!(motion along a)), Along(..)));
        assert!(matches!(read(quote!(motion slide a)), Motion { .. }));
        assert!(matches!(read(quote!(require - a)), Zero(..)));
        assert!(matches!(read(quote!(require(a) - b)), Zero(..)));
        assert!(matches!(read(quote!(force(a) - drive(b))), Zero(..)));
    }
}

//! How a joint moves, as written.
//!
//! ```text
//! motion turn axis at point, slide axis;
//! motion slide normal.normal(), ball at point;
//! motion screw axis at point by pitch;
//! motion none;
//! ```

use proc_macro2::{Ident, TokenStream, TokenTree};
use syn::parse::ParseStream;

use super::piece::around;
use super::{Piece, split};
use crate::diag::{Faults, did_you_mean, list};

/// The words that begin a motion.
const WORDS: [&str; 5] = ["turn", "slide", "screw", "ball", "none"];

/// One motion as written.
#[derive(Clone, Debug)]
pub struct MotionSyntax {
    /// All its tokens.
    pub tokens: TokenStream,
    /// What stands in it.
    pub kind: MotionKind,
}

/// What stands in a motion.
#[derive(Clone, Debug)]
pub enum MotionKind {
    /// `turn axis at point`.
    Turn {
        /// The direction.
        axis: Box<syn::Expr>,
        /// The point.
        point: Box<syn::Expr>,
    },
    /// `slide axis`.
    Slide {
        /// The direction.
        along: Box<syn::Expr>,
    },
    /// `screw axis at point by pitch`.
    Screw {
        /// The direction.
        axis: Box<syn::Expr>,
        /// The point.
        point: Box<syn::Expr>,
        /// The way along the axis for every turn.
        pitch: Box<syn::Expr>,
    },
    /// `ball at point`.
    Ball {
        /// The point.
        point: Box<syn::Expr>,
    },
}

/// Reads what stands behind `motion`: what can be understood; the rest is reported.
pub(super) fn motions(rest: &Piece, faults: &mut Faults) -> Vec<MotionSyntax> {
    let pieces = split(rest.tokens.clone(), ',');
    let is_alone = pieces.len() == 1;
    pieces
        .iter()
        .filter_map(|piece| motion(piece, is_alone, faults))
        .collect()
}

fn motion(piece: &Piece, is_alone: bool, faults: &mut Faults) -> Option<MotionSyntax> {
    let mut tokens = piece.tokens.clone().into_iter();
    let word = match tokens.next() {
        None => {
            faults.at_span(piece.end, "one `,` is too many here");
            return None;
        }
        Some(TokenTree::Ident(word)) => word,
        Some(other) => {
            faults.at(
                other,
                "expected `turn axis at point`, `slide axis`, `screw axis at point by pitch`, `ball at point` or `none`",
            );
            return None;
        }
    };
    let rest = Piece {
        tokens: tokens.collect(),
        end: piece.end,
    };
    let kind = match word.to_string().as_str() {
        "turn" => turn(&word, &rest, faults),
        "slide" => slide(&word, &rest, faults),
        "screw" => screw(&word, &rest, faults),
        "ball" => ball(&word, &rest, faults),
        "none" => {
            if !rest.tokens.is_empty() {
                faults.at(
                    &rest.tokens,
                    "expected nothing behind `none`, which says that no motion is left",
                );
            } else if !is_alone {
                faults.at(
                    &word,
                    "`none` says that no motion is left; beside others it says nothing",
                );
            }
            None
        }
        found => {
            let near = did_you_mean(found, WORDS);
            faults.at(
                &word,
                format!("no motion `{found}`; there are {}{near}", list(WORDS)),
            );
            None
        }
    };
    kind.map(|kind| MotionSyntax {
        tokens: piece.tokens.clone(),
        kind,
    })
}

fn turn(word: &Ident, rest: &Piece, faults: &mut Faults) -> Option<MotionKind> {
    let Some((axis, at, point)) = around(rest, "at") else {
        faults.at(
            word,
            "expected an axis, `at` and a point behind it, as in `turn axis at point`",
        );
        return None;
    };
    let axis = operand(&axis, word, "an axis", faults);
    let point = operand(&point, &at, "a point", faults);
    Some(MotionKind::Turn {
        axis: axis?,
        point: point?,
    })
}

fn slide(word: &Ident, rest: &Piece, faults: &mut Faults) -> Option<MotionKind> {
    if let Some((_, at, _)) = around(rest, "at") {
        faults.at(
            at,
            "a body slides in a direction, wherever its points are; write `slide axis`",
        );
        return None;
    }
    let along = operand(rest, word, "an axis", faults)?;
    Some(MotionKind::Slide { along })
}

fn screw(word: &Ident, rest: &Piece, faults: &mut Faults) -> Option<MotionKind> {
    let parts = around(rest, "at").and_then(|(axis, at, behind)| {
        let (point, by, pitch) = around(&behind, "by")?;
        Some((axis, at, point, by, pitch))
    });
    let Some((axis, at, point, by, pitch)) = parts else {
        faults.at(
            word,
            "expected an axis, `at`, a point, `by` and a length behind it, as in `screw axis at point by pitch`",
        );
        return None;
    };
    let axis = operand(&axis, word, "an axis", faults);
    let point = operand(&point, &at, "a point", faults);
    let pitch = operand(&pitch, &by, "a length", faults);
    Some(MotionKind::Screw {
        axis: axis?,
        point: point?,
        pitch: pitch?,
    })
}

fn ball(word: &Ident, rest: &Piece, faults: &mut Faults) -> Option<MotionKind> {
    let mut tokens = rest.tokens.clone().into_iter();
    match tokens.next() {
        Some(TokenTree::Ident(at)) if at == "at" => {
            let point = Piece {
                tokens: tokens.collect(),
                end: rest.end,
            };
            let point = operand(&point, &at, "a point", faults)?;
            Some(MotionKind::Ball { point })
        }
        _ => {
            faults.at(
                word,
                "expected `at` and a point behind it, as in `ball at point`",
            );
            None
        }
    }
}

/// What stands behind a word.
fn operand(piece: &Piece, word: &Ident, what: &str, faults: &mut Faults) -> Option<Box<syn::Expr>> {
    if piece.tokens.is_empty() {
        faults.at(word, format!("expected {what} behind `{word}`"));
        return None;
    }
    let parser = |input: ParseStream<'_>| {
        let expr = input.parse()?;
        if !input.is_empty() {
            return Err(input.error("expected `,` or `;` before this"));
        }
        Ok(Box::new(expr))
    };
    piece.parse(parser, faults)
}

#[cfg(test)]
mod tests {
    use proc_macro2::Span;
    use quote::quote;

    use super::{MotionKind, motions};
    use crate::diag::Faults;
    use crate::syntax::Piece;

    /// The first letters of the motions, and the number of faults.
    fn read(tokens: proc_macro2::TokenStream) -> (String, usize) {
        let mut faults = Faults::new();
        let end = Span::call_site();
        let found = motions(&Piece { tokens, end }, &mut faults);
        let letters = found.iter().map(|motion| match motion.kind {
            MotionKind::Turn { .. } => 't',
            MotionKind::Slide { .. } => 's',
            MotionKind::Screw { .. } => 'h',
            MotionKind::Ball { .. } => 'b',
        });
        let errors = faults.into_tokens().to_string();
        (letters.collect(), errors.matches("compile_error").count())
    }

    #[test]
    fn motions_are_read_in_order() {
        assert_eq!(read(quote!(none)), (String::new(), 0));
        assert_eq!(read(quote!(turn a at p, slide a)), ("ts".into(), 0));
        assert_eq!(
            read(quote!(slide n.normal(), slide n.binormal(), ball at p)),
            ("ssb".into(), 0)
        );
        assert_eq!(read(quote!(turn n.normal() at p)), ("t".into(), 0));
        assert_eq!(read(quote!(screw a at p by h, slide a)), ("hs".into(), 0));
    }

    #[test]
    fn every_faulty_motion_is_reported() {
        let spoilt = quote!(twist a at p, slide a, turn a, turn at p, slide, slide a at p, ball p, , none, 3.0, turn a at, ball at);
        assert_eq!(read(spoilt), ("s".into(), 11));
        assert_eq!(read(quote!(slide a b)), (String::new(), 1));
        assert_eq!(read(quote!(none a)), (String::new(), 1));
        let spoilt = quote!(screw, screw a, screw a at p, screw a by h, screw a at p by, screw a at by h, screw a at p by h h);
        assert_eq!(read(spoilt), (String::new(), 7));
    }
}

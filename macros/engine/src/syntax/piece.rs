//! Tokens between separators.

use proc_macro2::{Ident, Span, TokenStream, TokenTree};

/// Tokens between two separators.
#[derive(Clone, Debug)]
pub struct Piece {
    /// The tokens, without the separator.
    pub tokens: TokenStream,
    /// Where the piece ends: its separator, or its last token.
    pub end: Span,
}

/// Splits tokens at a separator, so that one faulty piece does not hide the others. An empty last
/// piece is left out.
#[must_use]
pub fn split(tokens: TokenStream, separator: char) -> Vec<Piece> {
    let mut pieces = Vec::new();
    let mut piece = TokenStream::new();
    let mut end = Span::call_site();
    for token in tokens {
        end = token.span();
        match &token {
            TokenTree::Punct(punct) if punct.as_char() == separator => {
                let tokens = std::mem::take(&mut piece);
                pieces.push(Piece { tokens, end });
            }
            _ => piece.extend([token]),
        }
    }
    if !piece.is_empty() {
        pieces.push(Piece { tokens: piece, end });
    }
    pieces
}

/// What stands before and behind a word, if it stands between two operands of the piece.
pub(super) fn around(piece: &Piece, word: &str) -> Option<(Piece, Ident, Piece)> {
    let mut before = TokenStream::new();
    let mut tokens = piece.tokens.clone().into_iter();
    let mut behind_operand = false;
    while let Some(token) = tokens.next() {
        let is_infix = behind_operand;
        behind_operand = !matches!(token, TokenTree::Punct(_));
        match token {
            TokenTree::Ident(found) if is_infix && found == word => {
                let before = Piece {
                    tokens: before,
                    end: found.span(),
                };
                let behind = Piece {
                    tokens: tokens.collect(),
                    end: piece.end,
                };
                return Some((before, found, behind));
            }
            other => before.extend([other]),
        }
    }
    None
}

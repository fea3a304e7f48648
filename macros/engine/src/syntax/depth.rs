//! How deep tokens are nested, found without recursion: what parses and differentiates them calls
//! itself for every level, and the stack of the compiler is finite.

use proc_macro2::{Literal, Span, TokenStream, TokenTree, token_stream};

use super::piece::split;

/// The deepest expression that is read: operators in a row and brackets within each other.
pub const DEEPEST: usize = 300;
/// The deepest input of a macro.
const DEEPEST_INPUT: usize = 500;
/// The longest number that is read.
const MOST_DIGITS: usize = 1000;
/// A pair of brackets takes more of the stack than an operator does.
const BRACKETS: usize = 8;

/// Refuses an expression that is too deep.
///
/// # Errors
/// A sentence at its first token.
pub fn of_expression(tokens: &TokenStream) -> syn::Result<()> {
    bounded(
        tokens,
        DEEPEST,
        "name parts of it by `let`, or write it with fewer operators",
    )
}

/// Refuses the input of a macro if it is too deep, before anything else looks at it.
///
/// # Errors
/// A sentence at the token.
pub fn of_input(tokens: &TokenStream) -> syn::Result<()> {
    if let Some(literal) = long_number(tokens) {
        let message = format!("a number has {MOST_DIGITS} digits at most");
        return Err(syn::Error::new(literal.span(), message));
    }
    bounded(
        tokens,
        DEEPEST_INPUT,
        "write it with fewer brackets and operators",
    )
}

/// A number whose value nobody would wait for: reading takes the square of its length.
fn long_number(tokens: &TokenStream) -> Option<Literal> {
    let mut levels = vec![tokens.clone().into_iter()];
    while let Some(level) = levels.last_mut() {
        match level.next() {
            Some(TokenTree::Group(group)) => levels.push(group.stream().into_iter()),
            Some(TokenTree::Literal(literal)) => {
                let text = literal.to_string();
                if text.len() > MOST_DIGITS
                    && text.starts_with(|first: char| first.is_ascii_digit())
                {
                    return Some(literal);
                }
            }
            Some(_) => {}
            None => drop(levels.pop()),
        }
    }
    None
}

fn bounded(tokens: &TokenStream, most: usize, advice: &str) -> syn::Result<()> {
    if depth(tokens.clone()) <= most {
        return Ok(());
    }
    Err(syn::Error::new(
        place(tokens.clone(), most),
        format!(
            "this is nested more than {most} operators deep (brackets count {BRACKETS}); {advice}"
        ),
    ))
}

/// Where tokens are too deep: the start of the innermost piece that still is.
fn place(mut tokens: TokenStream, most: usize) -> Span {
    // Every round looks at all that is left.
    const ROUNDS: usize = 20;
    let mut span = Span::call_site();
    for _ in 0..ROUNDS {
        let pieces = split(tokens, ';').into_iter();
        let mut pieces = pieces.flat_map(|piece| split(piece.tokens, ','));
        let Some(piece) = pieces.find(|piece| depth(piece.tokens.clone()) > most) else {
            return span;
        };
        let mut within = None;
        for (k, token) in piece.tokens.into_iter().enumerate() {
            if k == 0 {
                span = token.span();
            }
            match token {
                TokenTree::Group(group) if depth(group.stream()) > most => {
                    within = Some(group.stream());
                    break;
                }
                _ => {}
            }
        }
        match within {
            Some(inner) => tokens = inner,
            None => return span,
        }
    }
    span
}

/// What stands between two separators.
#[derive(Clone, Copy, Default)]
struct Chain {
    /// Operators that each hold what stands before them.
    operators: usize,
    /// Factors of the present product.
    factors: usize,
    /// Factors of the longest product.
    most_factors: usize,
    /// Calls, fields and the like behind the present operand.
    suffixes: usize,
    /// The most of them.
    most_suffixes: usize,
    /// The deepest group.
    groups: usize,
}

impl Chain {
    fn depth(self) -> usize {
        self.operators + self.most_factors + self.most_suffixes + self.groups
    }
}

/// The tokens within one pair of brackets.
struct Level {
    rest: token_stream::IntoIter,
    chain: Chain,
    /// Angle brackets and closures that are open: they go on behind a comma.
    open: usize,
    most_open: usize,
    behind_operand: bool,
    /// The sign before, if it was one.
    before: Option<char>,
    deepest: usize,
}

impl Level {
    fn new(tokens: TokenStream) -> Self {
        Self {
            rest: tokens.into_iter(),
            chain: Chain::default(),
            open: 0,
            most_open: 0,
            behind_operand: false,
            before: None,
            deepest: 0,
        }
    }

    fn suffix(&mut self) {
        self.chain.suffixes += 1;
        self.chain.most_suffixes = self.chain.most_suffixes.max(self.chain.suffixes);
    }

    fn punct(&mut self, sign: char) {
        let behind_operand = std::mem::take(&mut self.behind_operand);
        match sign {
            '.' | '?' => self.suffix(),
            '>' if !matches!(self.before, Some('-' | '=')) => {
                self.open = self.open.saturating_sub(1)
            }
            ',' | ';' => {
                self.deepest = self.deepest.max(self.chain.depth());
                self.chain = Chain::default();
            }
            // Paths and attributes are read one piece after another.
            ':' | '#' | '\'' => {}
            '*' | '/' if behind_operand => {
                self.chain.suffixes = 0;
                self.chain.factors += 1;
                self.chain.most_factors = self.chain.most_factors.max(self.chain.factors);
            }
            '<' | '|' => {
                self.open += 1;
                self.most_open = self.most_open.max(self.open);
            }
            _ => {
                self.chain.operators += 1;
                if behind_operand {
                    (self.chain.factors, self.chain.suffixes) = (0, 0);
                }
            }
        }
        self.before = Some(sign);
    }

    /// An operand: behind another one it holds that, as a call does.
    fn operand(&mut self) {
        if self.behind_operand {
            self.suffix();
        }
        self.behind_operand = true;
        self.before = None;
    }

    fn depth(&self) -> usize {
        self.deepest.max(self.chain.depth()) + self.most_open
    }
}

/// Operators in a row, and brackets within each other; never less than what a parser makes of it.
fn depth(tokens: TokenStream) -> usize {
    let mut levels = vec![Level::new(tokens)];
    loop {
        let Some(level) = levels.last_mut() else {
            return 0;
        };
        match level.rest.next() {
            Some(TokenTree::Group(group)) => {
                level.operand();
                levels.push(Level::new(group.stream()));
            }
            Some(TokenTree::Punct(punct)) => level.punct(punct.as_char()),
            Some(TokenTree::Ident(_) | TokenTree::Literal(_)) => level.operand(),
            None => {
                let inner = level.depth() + BRACKETS;
                levels.pop();
                let Some(outer) = levels.last_mut() else {
                    return inner - BRACKETS;
                };
                outer.chain.groups = outer.chain.groups.max(inner);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{BRACKETS, depth};

    fn depth_of(text: &str) -> usize {
        depth(text.parse().expect("brackets in pairs"))
    }

    #[test]
    fn operators_and_brackets_count() {
        assert_eq!(depth_of("a"), 0);
        assert_eq!(depth_of("a + b - c"), 2);
        assert_eq!(depth_of("a * b + c * d"), 2);
        assert_eq!(depth_of("a + b; c + d"), 1);
        assert_eq!(
            depth_of("a + (b * (c + d))"),
            1 + BRACKETS + 1 + BRACKETS + 1
        );
        assert_eq!(depth_of("f(x)"), 1 + BRACKETS);
        assert_eq!(depth_of("a.b * f(x) + c.d"), 1 + 1 + 1 + BRACKETS);
        assert_eq!(depth_of("- * - * a"), 4);
        assert_eq!(depth_of("A<B, A<B, A<B>>>"), 3);
        assert_eq!(depth_of("a: A<B>, b: A<B>"), 1);
        assert_eq!(depth_of("fn(A) -> B<C, fn(A) -> B<C>>"), 3 + BRACKETS + 2);
        assert_eq!(depth_of("#[a] #[b] #[c] crate::x::Y"), BRACKETS + 1);
    }
}

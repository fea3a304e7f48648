//! Faults of a description: all of them at once, each on the user's token.

use std::fmt::Display;

use proc_macro2::{Span, TokenStream};
use quote::ToTokens;

use crate::model::Name;

/// Collects faults. Dropping it unread is a mistake of ours and panics in a test.
#[derive(Debug, Default)]
pub struct Faults {
    faults: Vec<Fault>,
    /// The element of an array that is being read.
    element: Option<usize>,
    read: bool,
}

/// A fault, and the element of an array that it was found in.
#[derive(Debug)]
struct Fault {
    error: syn::Error,
    element: Option<usize>,
    /// How much of its end is advice.
    advice: usize,
}

impl Fault {
    /// Whether two faults, of two elements of an array, say the same at the same place, but for
    /// numbers and advice.
    fn is_repeated_by(&self, other: &Self) -> bool {
        let place = |fault: &Self| {
            let span = fault.error.span();
            let (start, end) = (span.start(), span.end());
            (start.line, start.column, end.line, end.column)
        };
        let words = |fault: &Self| {
            let mut text = fault.error.to_string();
            text.truncate(text.len() - fault.advice);
            text.retain(|c| !c.is_ascii_digit() && !matches!(c, '.' | '-'));
            text
        };
        let elements = [self.element, other.element];
        matches!(elements, [Some(a), Some(b)] if a != b)
            && place(self) == place(other)
            && words(self) == words(other)
    }
}

impl Faults {
    /// No fault so far.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// A fault at some tokens.
    pub fn at(&mut self, tokens: impl ToTokens, message: impl Display) {
        self.add(syn::Error::new_spanned(tokens, message));
    }

    /// A fault at some tokens, and what to do about it.
    pub fn advised(&mut self, tokens: impl ToTokens, message: impl Display, advice: &str) {
        let error = syn::Error::new_spanned(tokens, format!("{message}{advice}"));
        self.push(error, advice.len());
    }

    /// A fault at a span.
    pub fn at_span(&mut self, span: Span, message: impl Display) {
        self.add(syn::Error::new(span, message));
    }

    /// A fault at the name of a field or of an element.
    pub fn at_name(&mut self, name: &Name, message: impl Display) {
        self.within(name, |faults| faults.at(name, message));
    }

    /// A fault found by the parser.
    pub fn add(&mut self, error: syn::Error) {
        self.push(error, 0);
    }

    fn push(&mut self, error: syn::Error, advice: usize) {
        let element = self.element;
        let fault = Fault {
            error,
            element,
            advice,
        };
        // Only the first element says what is wrong with all of them.
        if !self.faults.iter().any(|known| known.is_repeated_by(&fault)) {
            self.faults.push(fault);
        }
    }

    /// Collects the faults of a field, or of an element of one: what several elements have in
    /// common is reported once.
    pub fn within<T>(&mut self, name: &Name, read: impl FnOnce(&mut Self) -> T) -> T {
        let outer = std::mem::replace(&mut self.element, name.index());
        let result = read(self);
        self.element = outer;
        result
    }

    /// The value of a result, or the fault.
    pub fn accept<T>(&mut self, result: syn::Result<T>) -> Option<T> {
        result.map_err(|error| self.add(error)).ok()
    }

    /// What a reader finds, whatever it refuses on the way: for one that only looks.
    pub fn unheard<T>(look: impl FnOnce(&mut Self) -> T) -> T {
        let mut faults = Self::new();
        let found = look(&mut faults);
        faults.read = true;
        found
    }

    /// Whether there is a fault.
    #[must_use]
    pub fn any(&self) -> bool {
        !self.faults.is_empty()
    }

    /// Takes the faults of another collector over.
    pub fn append(&mut self, mut other: Self) {
        other.read = true;
        self.faults.append(&mut other.faults);
    }

    /// The faults as items that the compiler reports, in the order of the source; nothing without
    /// faults.
    pub fn into_tokens(mut self) -> TokenStream {
        self.read = true;
        self.faults.sort_by_key(|fault| {
            let start = fault.error.span().start();
            (start.line, start.column)
        });
        self.faults
            .drain(..)
            .map(|fault| fault.error.into_compile_error())
            .collect()
    }
}

impl Drop for Faults {
    fn drop(&mut self) {
        if !self.read && !std::thread::panicking() {
            panic!("faults were collected and never read");
        }
    }
}

/// "`a`, `b` and `c`".
pub fn list<T: Display>(names: impl IntoIterator<Item = T>) -> String {
    let names: Vec<String> = names.into_iter().map(|name| format!("`{name}`")).collect();
    match names.as_slice() {
        [] => "nothing".into(),
        [only] => only.clone(),
        [most @ .., last] => format!("{} and {last}", most.join(", ")),
    }
}

/// Code on one line as a person would write it: `Option<Revolute>`, `crate::LENGTH`.
pub fn code(tokens: impl ToTokens) -> String {
    let mut text = tokens.into_token_stream().to_string();
    for (spaced, tight) in [
        (" :: ", "::"),
        (":: ", "::"),
        (" <", "<"),
        ("< ", "<"),
        (" >", ">"),
        (" ,", ","),
    ] {
        text = text.replace(spaced, tight);
    }
    text
}

/// "; did you mean `rocker`?" where a known name is near enough, or is what other tools call so.
pub fn did_you_mean<'a>(found: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.into_iter().collect();
    let near = known.iter().map(|name| (distance(found, name), *name));
    let near = near
        .filter(|&(distance, name)| distance <= 1 + name.len() / 4 && distance < name.len())
        .min();
    let other = || ELSEWHERE.iter().find(|(name, _)| *name == found);
    let called = || {
        let (_, ours) = other()?;
        ours.iter().find(|name| known.contains(name)).copied()
    };
    near.map(|(_, name)| name)
        .or_else(called)
        .map_or_else(String::new, |name| format!("; did you mean `{name}`?"))
}

/// What other tools and books call something, and what it may be called here.
const ELSEWHERE: [(&str, &[&str]); 39] = [
    ("anchor", &["point"]),
    ("base", &["ground"]),
    ("beam", &["bar"]),
    ("bodies", &["between"]),
    ("box", &["block"]),
    ("c", &["damping"]),
    ("center", &["position", "at"]),
    ("centre", &["position", "at"]),
    ("child", &["between"]),
    ("com", &["position"]),
    ("connects", &["between"]),
    ("cuboid", &["block"]),
    ("damper", &["damping"]),
    ("degrees", &["deg"]),
    ("diameter", &["radius"]),
    ("direction", &["axis", "normal"]),
    ("end", &["to", "tail"]),
    ("fixed", &["ground"]),
    ("floor", &["ground"]),
    ("frame", &["ground"]),
    ("free_length", &["length"]),
    ("initial_velocity", &["velocity"]),
    ("k", &["stiffness"]),
    ("location", &["position", "point", "at"]),
    ("moi", &["inertia"]),
    ("omega", &["angular_velocity"]),
    ("origin", &["position", "point"]),
    ("parent", &["between"]),
    ("pipe", &["tube"]),
    ("pos", &["position", "point"]),
    ("position", &["point", "at"]),
    ("quaternion", &["orientation"]),
    ("range", &["limits"]),
    ("rest_length", &["length"]),
    ("rotation", &["orientation"]),
    ("sphere", &["ball"]),
    ("start", &["from", "head"]),
    ("torque", &["moment"]),
    ("world", &["ground"]),
];

/// The number of insertions, deletions and replacements between two words (Levenshtein).
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (k, x) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = k + 1;
        for (l, &y) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(x != y);
            diagonal = row[l + 1];
            row[l + 1] = replaced.min(row[l] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::{ELSEWHERE, Faults, code, did_you_mean, distance};
    use quote::quote;

    #[test]
    fn near_names_are_offered() {
        assert_eq!(distance("roker", "rocker"), 1);
        assert_eq!(
            did_you_mean("roker", ["crank", "rocker"]),
            "; did you mean `rocker`?"
        );
        assert_eq!(did_you_mean("wheel", ["crank", "rocker"]), "");
        assert_eq!(did_you_mean("k", ["i", "j"]), "");
    }

    #[test]
    fn names_of_other_tools_are_translated_where_ours_is_known() {
        assert_eq!(
            did_you_mean("world", ["rod", "ground"]),
            "; did you mean `ground`?"
        );
        assert_eq!(
            did_you_mean("position", ["between", "at"]),
            "; did you mean `at`?"
        );
        assert_eq!(did_you_mean("world", ["rod", "crank"]), "");
        // A name that is near is what was meant.
        assert_eq!(
            did_you_mean("world", ["ground", "worlds"]),
            "; did you mean `worlds`?"
        );
        let others = ELSEWHERE.map(|(name, _)| name);
        assert!(others.is_sorted() && ELSEWHERE.iter().all(|(_, ours)| !ours.is_empty()));
    }

    #[test]
    fn code_is_written_without_needless_space() {
        assert_eq!(
            code(quote!(::a::Pair<'a, Option<f64>>)),
            "::a::Pair<'a, Option<f64>>"
        );
    }

    #[test]
    #[should_panic(expected = "never read")]
    fn faults_must_be_read() {
        drop(Faults::new());
    }
}

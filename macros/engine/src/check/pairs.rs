//! Keys of an attribute: missing, twice, unknown.

use proc_macro2::Span;

use crate::diag::{Faults, did_you_mean, list};
use crate::syntax::{KeyValue, List, Value};

/// The pairs of one attribute, taken out key by key; what is left at the end is unknown.
#[derive(Debug)]
pub struct Pairs<'a> {
    what: String,
    owner: Span,
    remaining: Vec<&'a KeyValue>,
    known: Vec<String>,
    missing: Vec<(String, String)>,
    unreadable: bool,
}

impl<'a> Pairs<'a> {
    /// The pairs of `what`, for messages such as "body `rod` lacks `mass`"; what is missing is
    /// reported at `owner`, the word of the attribute.
    #[must_use]
    pub fn new(what: String, owner: Span, list: &'a List) -> Self {
        Self {
            what,
            owner,
            remaining: list.pairs.iter().collect(),
            known: Vec::new(),
            missing: Vec::new(),
            unreadable: list.unreadable,
        }
    }

    fn take(&mut self, key: &str, faults: &mut Faults) -> Option<&'a KeyValue> {
        self.known.push(key.into());
        let mut found = None;
        self.remaining.retain(|pair| {
            if pair.key != key {
                return true;
            }
            if found.is_some() {
                faults.at(
                    &pair.key,
                    format!("`{key}` stands here twice; give it once"),
                );
            } else {
                found = Some(*pair);
            }
            false
        });
        found
    }

    /// Whether something in the list could not be read: what is missing may be in it.
    #[must_use]
    pub fn is_unreadable(&self) -> bool {
        self.unreadable
    }

    /// Whether a key is there.
    #[must_use]
    pub fn has(&self, key: &str) -> bool {
        self.remaining.iter().any(|pair| pair.key == key)
    }

    /// The value of a key that may be left out.
    pub fn optional(&mut self, key: &str, faults: &mut Faults) -> Option<&'a syn::Expr> {
        let pair = self.take(key, faults)?;
        match &pair.value {
            Value::Expr(value) => Some(value),
            Value::Faulty => None,
            Value::None => {
                faults.at(
                    &pair.key,
                    format!("`{key}` needs a value, as in `{key} = ..`"),
                );
                None
            }
        }
    }

    /// The value of a key that must be there.
    pub fn required(
        &mut self,
        key: &str,
        example: &str,
        faults: &mut Faults,
    ) -> Option<&'a syn::Expr> {
        if self.has(key) {
            return self.optional(key, faults);
        }
        self.known.push(key.into());
        let message = format!("{} lacks `{key}`; give {example}", self.what);
        self.missing.push((key.into(), message));
        None
    }

    /// A key that was read before; what it takes is not listed.
    pub fn known_elsewhere(&mut self, key: &str, faults: &mut Faults) {
        self.optional(key, faults);
        self.known.pop();
    }

    /// A key without a value.
    pub fn flag(&mut self, key: &str, faults: &mut Faults) -> bool {
        let pair = self.take(key, faults);
        if let Some(Value::Expr(value)) = pair.map(|pair| &pair.value) {
            faults.at(
                value,
                format!("`{key}` takes no value; write `{key}` alone"),
            );
        }
        pair.is_some()
    }

    /// Refuses a key that is known elsewhere, with a reason.
    pub fn refuse(&mut self, key: &str, reason: &str, faults: &mut Faults) {
        if let Some(pair) = self.take(key, faults) {
            faults.at(&pair.key, format!("{} has no `{key}`: {reason}", self.what));
        }
        self.known.pop();
    }

    /// Reports what is missing, and what nobody took: a missing key that is misspelt once only.
    pub fn finish(self, faults: &mut Faults) {
        for (key, message) in &self.missing {
            let misspelt = self.remaining.iter().any(|pair| {
                let found = pair.key.to_string();
                !did_you_mean(&found, [key.as_str()]).is_empty()
            });
            if !self.unreadable && !misspelt {
                faults.at_span(self.owner, message);
            }
        }
        for pair in &self.remaining {
            let found = pair.key.to_string();
            let near = did_you_mean(&found, self.known.iter().map(String::as_str));
            faults.at(
                &pair.key,
                format!(
                    "{} has no attribute `{found}`; it takes {}{near}",
                    self.what,
                    list(&self.known)
                ),
            );
        }
    }
}

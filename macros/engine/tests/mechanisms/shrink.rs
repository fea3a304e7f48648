//! What becomes of a mechanism, and a smaller one that fails as well.

use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::apart::Mechanism;
use crate::comparison::Extent;
use crate::text::Outcome;
use crate::writing::Dice;

/// What becomes of a mechanism, and its text.
///
/// # Panics
/// If something differs: with the smallest mechanism found that fails as well.
pub(crate) fn run(mut mechanism: Mechanism, seed: u64, extent: Extent) -> (Outcome, String) {
    // What is refused is said otherwise: redundant equations left out, or kept.
    let mut wishes = [Some("drop"), Some("keep")].into_iter();
    loop {
        let message = match outcome(&mechanism, seed, extent) {
            Ok(Outcome::Refused(why)) => {
                let Some(wish) = wishes.next() else {
                    return (Outcome::Refused(why), mechanism.text().item);
                };
                mechanism.redundant(wish);
                continue;
            }
            Ok(outcome) => return (outcome, mechanism.text().item),
            Err(message) => message,
        };
        let (mechanism, message) = shrink(mechanism, seed, extent, message);
        panic!("seed {seed}\n{}\n{message}", mechanism.text());
    }
}

/// What becomes of a mechanism; a panic is a failure.
fn outcome(mechanism: &Mechanism, seed: u64, extent: Extent) -> Result<Outcome, String> {
    let text = mechanism.text();
    let shuffled = mechanism.shuffled(&mut Dice::new(seed)).text();
    let run = catch_unwind(AssertUnwindSafe(|| text.check(&shuffled, seed, extent)));
    run.unwrap_or_else(|panic| {
        let message = panic.downcast_ref::<String>().cloned();
        let message = message.or_else(|| panic.downcast_ref::<&str>().map(ToString::to_string));
        Err(format!("panic: {}", message.unwrap_or_default()))
    })
}

/// Leaves out fields, then entries, as long as something fails.
fn shrink(
    mut mechanism: Mechanism,
    seed: u64,
    extent: Extent,
    mut message: String,
) -> (Mechanism, String) {
    loop {
        let smaller = candidates(&mechanism).into_iter().find_map(|candidate| {
            let failure = outcome(&candidate, seed, extent).err()?;
            Some((candidate, failure))
        });
        match smaller {
            Some(found) => (mechanism, message) = found,
            None => return (mechanism, message),
        }
    }
}

/// Whether a name stands in a text as a word.
fn names(text: &str, name: &str) -> bool {
    let mut words = text.split(|c: char| !c.is_alphanumeric() && c != '_');
    words.any(|word| word == name)
}

fn candidates(mechanism: &Mechanism) -> Vec<Mechanism> {
    let mut candidates = Vec::new();
    for (place, field) in mechanism.fields.iter().enumerate() {
        let mut others = mechanism
            .fields
            .iter()
            .filter(|other| other.name != field.name);
        let is_named = others.any(|other| {
            other
                .entries
                .iter()
                .any(|(_, value)| names(value, &field.name))
        });
        if !is_named {
            let mut smaller = mechanism.clone();
            smaller.fields.remove(place);
            for body in smaller
                .fields
                .iter_mut()
                .filter(|field| field.word == "body")
            {
                if !body.entries.iter().any(|(key, _)| key == "free") {
                    body.entries.push(("free".into(), String::new()));
                }
            }
            candidates.push(smaller);
        }
    }
    for (place, field) in mechanism.fields.iter().enumerate() {
        for (entry, (key, _)) in field.entries.iter().enumerate() {
            if matches!(key.as_str(), "velocity" | "angular_velocity") {
                let mut smaller = mechanism.clone();
                smaller.fields[place].entries.remove(entry);
                candidates.push(smaller);
            }
        }
    }
    for entry in 0..mechanism.attributes.len() {
        let mut smaller = mechanism.clone();
        smaller.attributes.remove(entry);
        candidates.push(smaller);
    }
    candidates
}

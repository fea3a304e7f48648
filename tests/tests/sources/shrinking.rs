//! What the run time has too often, in lists that may only shrink.
//!
//! A time and a state that go together are one value of a named type, not a tuple. A tolerance has
//! one name and one value. It stands with its reason in a file `limits.rs`, or with the method
//! that it belongs to. A name of several values tells a reader nothing.

use std::collections::BTreeMap;

use super::lengths::{assert_known, sources};

/// Tuples of a time and a state in signatures and fields, by file.
const TUPLES: [(&str, usize); 37] = [
    ("constraints/newton.rs", 1),
    ("dynamics/equations.rs", 4),
    ("dynamics/evaluate.rs", 2),
    ("dynamics/faults.rs", 2),
    ("dynamics/near.rs", 1),
    ("dynamics/straight_on.rs", 1),
    ("formulation/consistency.rs", 1),
    ("integrate/single.rs", 2),
    ("integrate/slopes.rs", 1),
    ("lanes/step.rs", 1),
    ("mechanism/kernels.rs", 1),
    ("monitor/energy.rs", 1),
    ("monitor/events.rs", 1),
    ("monitor/gradients.rs", 1),
    ("monitor/growth.rs", 1),
    ("monitor/memory.rs", 1),
    ("monitor/passage.rs", 1),
    ("monitor/pivots.rs", 2),
    ("monitor/within.rs", 1),
    ("nonsmooth/described.rs", 1),
    ("run/checkpoint/capture.rs", 1),
    ("run/events/guards.rs", 1),
    ("run/events/handling.rs", 1),
    ("run/events/sides.rs", 3),
    ("run/events/sizes.rs", 1),
    ("run/events/switching.rs", 1),
    ("run/kinematics.rs", 1),
    ("run/kinematics/motion.rs", 1),
    ("run/passages.rs", 4),
    ("run/passing.rs", 1),
    ("run/remembered.rs", 1),
    ("run/trajectory/record.rs", 1),
    ("run/within.rs", 2),
    ("state/joint_state.rs", 2),
    ("stepping/followed.rs", 2),
    ("stepping/march.rs", 6),
    ("stepping/marching.rs", 5),
];

/// Numeric constants of one name that are defined more than once.
const NAMES: [(&str, usize); 32] = [
    ("ALIKE", 3),
    ("ANGLE_ERROR", 2),
    ("ANGLE_ERROR_OF_SHORT_STEPS", 2),
    ("BEYOND", 3),
    ("CLOSE", 2),
    ("FAR", 3),
    ("FIRST_SHARE", 2),
    ("FREE", 2),
    ("FURTHER", 2),
    ("GROWN", 2),
    ("HARDLY", 2),
    ("INEXACT", 3),
    ("KNOWN", 2),
    ("LEAST", 9),
    ("LITTLE", 4),
    ("LONGER", 2),
    ("MARGIN", 3),
    ("MOMENT", 3),
    ("NEAR", 4),
    ("NEARLY_VANISHED", 4),
    ("NOISE", 3),
    ("NO_FREEDOM", 2),
    ("OFF", 2),
    ("POWER", 4),
    ("RESOLVED", 3),
    ("ROUGH", 2),
    ("ROUND_OFF", 7),
    ("SAME", 4),
    ("SHORTEST", 3),
    ("SMALL", 2),
    ("STRAIGHT", 2),
    ("TURN", 3),
];

/// The sources of the run time, but tests, without comments.
fn runtime() -> Vec<(String, String)> {
    let sources = sources().into_iter().filter_map(|(path, text)| {
        let path = path.strip_prefix("runtime/src/")?.to_owned();
        let lines = text
            .lines()
            .filter(|line| !line.trim_start().starts_with("//"));
        let code = lines.collect::<Vec<_>>().join("\n");
        (!path.split('/').any(|part| part.starts_with("tests"))).then_some((path, code))
    });
    sources.collect()
}

/// How many tuple types begin with a number and go on with a state.
fn tuples(code: &str) -> usize {
    let starts = ["(S,", "(T,", "(f64,", "(P::Number,"].into_iter();
    let second = |rest: &str| {
        let rest = rest.trim_start().trim_start_matches('&');
        let rest = match rest.strip_prefix('\'') {
            Some(rest) => rest.trim_start_matches(|c: char| c.is_alphanumeric() || c == '_'),
            None => rest,
        };
        let rest = rest.trim_start().trim_start_matches("mut ");
        let end = rest.find([',', ')', ';', '(']).unwrap_or(rest.len());
        ["State", "Bodies"]
            .iter()
            .any(|state| rest[..end].contains(state))
    };
    // Arguments of a closure are none.
    let is_tuple = |&(place, start): &(usize, &str)| {
        !code[..place].ends_with("Fn") && second(&code[place + start.len()..])
    };
    let found = starts.map(|start| code.match_indices(start).filter(is_tuple).count());
    found.sum()
}

/// The names of the numeric constants that are defined.
fn numbers(code: &str) -> impl Iterator<Item = &str> {
    code.lines().filter_map(|line| {
        let (before, rest) = line.split_once("const ")?;
        let is_item = before.trim().is_empty() || before.trim().starts_with("pub");
        let (name, rest) = rest.split_once(": ")?;
        let of = rest.split(' ').next()?;
        let is_number = ["f64", "f32", "S"].contains(&of) && !name.starts_with("fn ");
        (is_item && is_number).then_some(name)
    })
}

fn owned(known: &[(&str, usize)]) -> Vec<(String, usize)> {
    let known = known
        .iter()
        .map(|(name, count)| ((*name).to_owned(), *count));
    known.collect()
}

#[test]
fn tuples_of_a_time_and_a_state_do_not_grow() {
    let found = runtime()
        .into_iter()
        .map(|(path, code)| (path, tuples(&code)));
    let found: Vec<_> = found.filter(|(_, count)| *count > 0).collect();
    assert_known(&found, &owned(&TUPLES), "tuples of a time and a state");
}

#[test]
fn names_of_several_numbers_do_not_grow() {
    let (mut counts, mut seen) = (BTreeMap::<String, usize>::new(), 0);
    for (path, code) in runtime() {
        for name in numbers(&code) {
            seen += 1;
            if !path.ends_with("limits.rs") {
                *counts.entry(name.to_owned()).or_default() += 1;
            }
        }
    }
    assert!(seen > 100, "they were found: {seen}");
    let found: Vec<_> = counts.into_iter().filter(|(_, count)| *count > 1).collect();
    assert_known(&found, &owned(&NAMES), "definitions of one name");
}

#[test]
fn a_tuple_and_a_number_are_recognised() {
    let code = "fn a((time, state): (S, &'a mut M::State<S>), b: (S, S)) -> (S, C::State<S>);";
    assert_eq!(tuples(code), 2);
    let code = "fn a(b: (P::Number, &Bodies<P>), c: impl Fn(S, &M::State<S>));";
    assert_eq!(tuples(code), 1);
    let code =
        "const LEAST: f64 = 1.0;\n    pub(crate) const A: S = 1;\nconst fn a(b: f64) -> f64;";
    assert_eq!(numbers(code).collect::<Vec<_>>(), ["LEAST", "A"]);
}

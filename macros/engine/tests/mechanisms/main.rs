//! Random mechanisms through all passes of the engine: whatever is generated for them agrees with a
//! dense solution of the same equations.
//!
//! A mechanism is text. The engine reads it as in a compiler session; its kernels, in all
//! formulations, both readings of Euler parameters and by every plan, are evaluated by numbers. A
//! second reader ([`reading`], [`language`]) interprets the same text over dual numbers, and knows
//! neither symbols nor derivatives ([`reference`]); masses are put in by hand, in the user's axes,
//! and the saddle system is solved by Gaussian elimination with complete pivoting ([`dense`]).
//!
//! `HOLONOM_MECHANISMS=100000 cargo test --release -p holonom-engine --test mechanisms` compares
//! more of them, `HOLONOM_SEED=..` begins elsewhere. With `HOLONOM_ROLLING=1` each of them has a
//! joint with equations of velocities.

mod apart;
mod carriers;
#[path = "../common/mod.rs"]
mod common;
mod comparison;
mod dense;
mod elements;
mod found;
mod generator;
mod inputs;
#[path = "../common/language.rs"]
mod language;
mod library;
mod loops;
#[path = "../common/pose.rs"]
mod pose;
#[path = "../common/reading.rs"]
mod reading;
mod reduced;
mod redundancy;
mod reference;
mod screws;
mod shrink;
mod solutions;
mod states;
mod text;
mod twins;
#[path = "../common/writing.rs"]
mod writing;

use std::collections::BTreeMap;
use std::ops::Range;
use std::panic::resume_unwind;
use std::thread;

use comparison::Extent;
use generator::Generator;
use shrink::run;
use text::{Outcome, Statistics};

fn setting(name: &str, default: u64) -> u64 {
    let given = std::env::var(name).ok();
    given.map_or(default, |text| text.parse().expect("a number"))
}

/// Mechanisms that are compared at the same time.
const BATCH: u64 = 8;

/// What becomes of some mechanisms, which know nothing of each other.
fn side_by_side(
    seeds: Range<u64>,
    rolls: bool,
    extent: &(impl Fn(u64) -> Extent + Sync),
) -> Vec<(u64, (Outcome, String))> {
    let of = move |seed| {
        let generator = Generator::new(seed, &[]);
        let generator = if rolls {
            generator.with_rolling()
        } else {
            generator
        };
        run(generator.mechanism(), seed, extent(seed))
    };
    thread::scope(|scope| {
        let spawn = |seed| (seed, scope.spawn(move || of(seed)));
        let running: Vec<_> = seeds.map(spawn).collect();
        let ended = running.into_iter().map(|(seed, thread)| {
            let ended = thread.join();
            (seed, ended.unwrap_or_else(|panic| resume_unwind(panic)))
        });
        ended.collect()
    })
}

#[test]
fn random_mechanisms_against_a_dense_solution() {
    let wanted = setting("HOLONOM_MECHANISMS", 60);
    let first = setting("HOLONOM_SEED", 0);
    let rolls = setting("HOLONOM_ROLLING", 0) == 1;
    let mut statistics = Statistics::default();
    let mut used: BTreeMap<&str, usize> = library::names().map(|name| (name, 0)).collect();
    let (mut refused, mut refused_otherwise) = (0, 0);
    // In a long run, most of them quickly.
    let extent = |seed: u64| match seed % 128 {
        1.. if wanted > 10_000 => Extent::Quick,
        _ => Extent::Full,
    };
    let batches = (0..).map(|batch| first + batch * BATCH);
    let outcomes = batches.flat_map(|first| side_by_side(first..first + BATCH, rolls, &extent));
    for (seed, (outcome, text)) in outcomes {
        match outcome {
            Outcome::Compared(found) => {
                statistics.add(&found);
                if statistics.mechanisms.is_multiple_of(1_000) {
                    println!("up to seed {seed}: {statistics}");
                }
                let types = used.iter_mut();
                let occurring = types.filter(|(name, _)| text.contains(&format!(": {name},")));
                occurring.for_each(|(_, count)| *count += 1);
            }
            Outcome::RefusedOtherwise(why) => {
                println!("seed {seed} is refused in another order: {why}");
                refused_otherwise += 1;
            }
            Outcome::Refused(why) => {
                // What is wrong with these is said in sentences that other tests hold.
                println!("seed {seed} is refused: {why}");
                refused += 1;
            }
        }
        if statistics.mechanisms as u64 >= wanted {
            break;
        }
    }
    println!("{statistics}; refused: {refused}, in another order only: {refused_otherwise}");
    assert!(
        refused * 10 < wanted && refused_otherwise * 100 <= wanted,
        "most mechanisms are sound: {refused} refused, {refused_otherwise} in another order only"
    );
    assert!(
        statistics.told * 50 < statistics.states && statistics.satisfied * 4 > statistics.states,
        "most states are sound: {statistics}"
    );
    assert!(
        statistics.singular * 2 < statistics.states,
        "most systems are regular: {statistics}"
    );
    let missing: Vec<&&str> = used
        .iter()
        .filter(|(_, count)| **count == 0)
        .map(|(name, _)| name)
        .collect();
    assert!(
        wanted < 300 || missing.is_empty(),
        "never compared: {missing:?}"
    );
}

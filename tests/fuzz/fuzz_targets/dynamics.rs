//! Bytes as the choices of a random mechanism: bodies, joints, forces, their order. What is
//! generated for it agrees with a dense solution of the same equations. The test `mechanisms` of
//! the engine does the same from seeds, and on a stable compiler.
#![no_main]
#![allow(dead_code, reason = "the test uses more of it")]

#[path = "../../../macros/engine/tests/mechanisms/apart.rs"]
mod apart;
#[path = "../../../macros/engine/tests/common/mod.rs"]
mod common;
#[path = "../../../macros/engine/tests/mechanisms/comparison.rs"]
mod comparison;
#[path = "../../../macros/engine/tests/mechanisms/dense.rs"]
mod dense;
#[path = "../../../macros/engine/tests/mechanisms/elements.rs"]
mod elements;
#[path = "../../../macros/engine/tests/mechanisms/generator.rs"]
mod generator;
#[path = "../../../macros/engine/tests/mechanisms/inputs.rs"]
mod inputs;
#[path = "../../../macros/engine/tests/common/language.rs"]
mod language;
#[path = "../../../macros/engine/tests/mechanisms/library.rs"]
mod library;
#[path = "../../../macros/engine/tests/common/pose.rs"]
mod pose;
#[path = "../../../macros/engine/tests/common/reading.rs"]
mod reading;
#[path = "../../../macros/engine/tests/mechanisms/redundancy.rs"]
mod redundancy;
#[path = "../../../macros/engine/tests/mechanisms/reduced.rs"]
mod reduced;
#[path = "../../../macros/engine/tests/mechanisms/reference.rs"]
mod reference;
#[path = "../../../macros/engine/tests/mechanisms/shrink.rs"]
mod shrink;
#[path = "../../../macros/engine/tests/mechanisms/solutions.rs"]
mod solutions;
#[path = "../../../macros/engine/tests/mechanisms/states.rs"]
mod states;
#[path = "../../../macros/engine/tests/mechanisms/text.rs"]
mod text;
#[path = "../../../macros/engine/tests/common/writing.rs"]
mod writing;

use comparison::Extent;
use generator::Generator;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    // Two bytes for the numbers, the others for choices.
    let Some((seed, choices)) = bytes.split_first_chunk::<2>() else {
        return;
    };
    let seed = u64::from(u16::from_le_bytes(*seed));
    let mechanism = Generator::new(seed, choices).mechanism();
    shrink::run(mechanism, seed, Extent::Quick);
});

//! A crate that refuses warnings stays clean with the derive and `joint!`: this file is such a
//! crate.
//!
//! The lints of clippy count when clippy runs.
#![deny(
    warnings,
    future_incompatible,
    let_underscore,
    nonstandard_style,
    rust_2018_idioms,
    rust_2021_compatibility,
    rust_2024_compatibility,
    unused,
    absolute_paths_not_starting_with_crate,
    ambiguous_negative_literals,
    elided_lifetimes_in_paths,
    explicit_outlives_requirements,
    macro_use_extern_crate,
    meta_variable_misuse,
    missing_copy_implementations,
    missing_debug_implementations,
    missing_docs,
    non_ascii_idents,
    redundant_imports,
    redundant_lifetimes,
    single_use_lifetimes,
    trivial_casts,
    trivial_numeric_casts,
    unit_bindings,
    unnameable_types,
    unreachable_pub,
    unsafe_code,
    unused_extern_crates,
    unused_import_braces,
    unused_lifetimes,
    unused_qualifications,
    unused_results,
    variant_size_differences
)]
#![deny(
    clippy::all,
    clippy::nursery,
    clippy::pedantic,
    clippy::absolute_paths,
    clippy::allow_attributes,
    clippy::arithmetic_side_effects,
    clippy::as_conversions,
    clippy::default_numeric_fallback,
    clippy::else_if_without_else,
    clippy::exhaustive_structs,
    clippy::expect_used,
    clippy::float_arithmetic,
    clippy::indexing_slicing,
    clippy::infinite_loop,
    clippy::integer_division,
    clippy::let_underscore_untyped,
    clippy::min_ident_chars,
    clippy::missing_docs_in_private_items,
    clippy::missing_inline_in_public_items,
    clippy::missing_trait_methods,
    clippy::module_name_repetitions,
    clippy::multiple_inherent_impl,
    clippy::panic,
    clippy::pattern_type_mismatch,
    clippy::pub_use,
    clippy::pub_with_shorthand,
    clippy::question_mark_used,
    clippy::shadow_reuse,
    clippy::shadow_same,
    clippy::shadow_unrelated,
    clippy::single_call_fn,
    clippy::single_char_lifetime_names,
    clippy::std_instead_of_core,
    clippy::unseparated_literal_suffix,
    clippy::unwrap_used,
    clippy::use_debug
)]
#![allow(
    clippy::exhaustive_structs,
    clippy::module_name_repetitions,
    reason = "they are about what this file writes itself: its types are public and named after their module"
)]

use ::holonom::joints::Revolute;
use ::holonom::{Body, Mechanism, MechanismExt as _, Particle};

/// Definitions, public and private, at the root and in a module.
pub mod joints {
    ::holonom::joint! {
        /// A rod without mass.
        pub joint Rod(i, j; head: Point, tail: Point, length: Length) {
            squared(j.tail - i.head) - length * length;
        }
    }

    ::holonom::joint! {
        /// A pin of the crate's own.
        pub(crate) joint Pin(i, j; point: Point, axis: Axis) {
            j.point - i.point;
            angle about axis;
        }
    }
}

::holonom::joint! {
    /// Two bodies keep two directions at an angle.
    joint Slant(i, j; first: Axis, second: Axis, cosine: Number) {
        dot(i.first, j.second) - cosine;
    }
}

/// A mass that the macro cannot see.
pub const MASS: f64 = 2.5;

/// A door whose names collide with what generated code might call its own.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
pub struct Door {
    /// The first body.
    #[body(
        mass = crate::MASS * 2.0,
        inertia = [[1.0, 0.1, 0.0], [0.1, 1.2, 0.0], [0.0, 0.0, 0.9]],
        position = [0.5, 0.0, 0.0]
    )]
    state: Body,
    /// The second body.
    #[body(mass = 1.0, inertia = [1.0, sqrt(MASS), MASS], position = [1.5, 0.0, 0.0])]
    constants: Body,
    /// A mass point.
    #[body(mass = 0.1, position = [2.0, 0.0, 0.0])]
    velocities: Particle,
    /// A joint of the library.
    #[joint(between = [ground, state], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    self_: Revolute,
    /// A joint of the crate.
    #[joint(between = [state, constants], point = [1.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    value: joints::Pin,
    /// A private one.
    #[joint(between = [ground, constants], first = [0.0, 0.0, 1.0], second = [0.0, 0.0, MASS], cosine = 1.0)]
    n_5: Slant,
    /// A public one.
    #[joint(between = [constants, velocities], head = [1.5, 0.0, 0.0], tail = [2.0, 0.0, 0.0], length = 0.5)]
    n_1: joints::Rod,
}

/// The code is there and works, not only compiles.
#[test]
fn generated_code_works_in_a_strict_crate() {
    let door = Door::default();
    assert!(door.described_state::<f64>().is_ok());
    let report = Door::REPORT;
    assert_eq!(report.equations, 10);
}

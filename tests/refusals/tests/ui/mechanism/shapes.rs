//! A mechanism is a struct with named fields and without parameters.

use holonom::prelude::*;

#[derive(Mechanism)]
enum Choice {
    Rod,
}

#[derive(Mechanism)]
union Overlay {
    rod: u32,
}

#[derive(Mechanism)]
struct Unit;

#[derive(Mechanism)]
struct Tuple(#[body(mass = 1.0, free)] Particle);

#[derive(Mechanism)]
struct Bare(u32);

#[derive(Mechanism)]
struct Empty {}

#[derive(Mechanism)]
struct Generic<T: 'static> {
    #[body(mass = -1.0, free)]
    bead: Particle,
    #[body(mass = 1.0, free)]
    other: T,
}

#[derive(Mechanism)]
struct Borrowed<'a> {
    #[body(mass = 1.0, free)]
    bead: &'a Particle,
}

fn main() {}

//! Random times and states that kernels are tried at.

use holonom_assembler::assembler::Assembler;
use holonom_assembler::states::{Spread, add_turns, generator, make_consistent_at, moved};
use nalgebra::DVector;
use rand::RngExt;

/// After so many states a walk begins anew, so that it does not come to configurations in which an
/// angle has no value.
const WALK: usize = 5;

/// The latest time (s) of a state.
const LATEST: f64 = 2.0;

/// A time (s) and `x`.
pub(crate) type Instant = (f64, DVector<f64>);

/// Random times and states on the constraints at these times, in position and velocity: walks from
/// the initial configuration, each state corrected by the assembler's own Newton method.
pub(crate) fn consistent(scene: &Assembler, count: usize, seed: u64) -> Vec<Instant> {
    let mut rng = generator(seed);
    let mut states = Vec::with_capacity(count);
    let mut at = scene.initial_state();
    let mut failures = 0;
    while states.len() < count {
        if states.len() % WALK == 0 {
            at = scene.initial_state();
        }
        let time = rng.random_range(0.0..LATEST);
        let mut x = moved(scene, &at, Spread::STRIDE, &mut rng);
        if make_consistent_at(scene, time, x.as_mut_slice()).is_some() {
            at = x.clone();
            states.push((time, x));
        } else {
            failures += 1;
            assert!(failures < 10 * count, "no state can be corrected");
        }
    }
    states
}

/// Up to 0.1 m and 0.1 rad off the constraints, `|p|` up to 5 % from 1.
const OFF: Spread = Spread {
    position: 0.1,
    angle: 0.1,
    velocity: 1.0,
    rate: 2.0,
    norm: 0.05,
};

/// States off the constraints, with any number of turns counted.
pub(crate) fn violated(scene: &Assembler, count: usize, seed: u64, norm: f64) -> Vec<Instant> {
    let mut rng = generator(seed.wrapping_add(1));
    consistent(scene, count, seed)
        .into_iter()
        .map(|(time, x)| {
            let mut x = moved(scene, &x, Spread { norm, ..OFF }, &mut rng);
            add_turns(scene, x.as_mut_slice(), &mut rng);
            (time, x)
        })
        .collect()
}

/// The states that kernels are tried at: on the constraints, off them, and off them with `|p|` up
/// to 5 % from 1.
pub(crate) fn all(scene: &Assembler, count: usize, seed: u64) -> Vec<Instant> {
    let mut states = consistent(scene, count, seed);
    states.extend(violated(scene, count, seed + 1, 0.0));
    states.extend(violated(scene, count, seed + 2, OFF.norm));
    states
}

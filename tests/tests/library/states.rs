//! Random times and states that kernels are tried at.

use holonom_tests::assembler::Assembler;
use holonom_tests::bodies::Kind;
use holonom_tests::states::{Spread, add_turns, displace, generator, make_consistent_at};
use nalgebra::DVector;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// How far one state on the constraints is from the one before.
const STRIDE: Spread = Spread {
    position: 0.1,
    angle: 0.4,
    velocity: 1.0,
    rate: 2.0,
    norm: 0.0,
};

/// After so many states a walk begins anew, so that it does not come to configurations in which an angle has no value.
const WALK: usize = 5;

/// The latest time (s) of a state.
const LATEST: f64 = 2.0;

/// A time (s) and `x`.
pub(crate) type Instant = (f64, DVector<f64>);

/// Random times and states on the constraints at these times, in position and velocity: walks from the initial configuration, each
/// state corrected by the assembler's own Newton method.
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
        let mut x = moved(scene, &at, STRIDE, &mut rng);
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

/// The states that kernels are tried at: on the constraints, off them, and off them with `|p|` up to 5 % from 1.
pub(crate) fn all(scene: &Assembler, count: usize, seed: u64) -> Vec<Instant> {
    let mut states = consistent(scene, count, seed);
    states.extend(violated(scene, count, seed + 1, 0.0));
    states.extend(violated(scene, count, seed + 2, OFF.norm));
    states
}

/// A state with every body moved by a random displacement, its Euler parameters scaled, and with random velocities.
fn moved(
    scene: &Assembler,
    x: &DVector<f64>,
    spread: Spread,
    rng: &mut ChaCha8Rng,
) -> DVector<f64> {
    let mut any = |size: f64| size * rng.random_range(-1.0..=1.0);
    let mut x = x.clone();
    let mut motion = DVector::zeros(scene.velocities());
    for (body, _, n) in scene.bodies() {
        let u = scene.coordinates() + n;
        for k in 0..body.kind.velocities() {
            // A rotation vector with components up to a / sqrt(3) is no longer than a.
            let turns = k >= 3;
            motion[n + k] = any(if turns {
                spread.angle / 3_f64.sqrt()
            } else {
                spread.position
            });
            x[u + k] = any(if turns { spread.rate } else { spread.velocity });
        }
    }
    displace(scene, x.as_mut_slice(), motion.as_slice());
    for (body, q, _) in scene.bodies() {
        if body.kind == Kind::Rigid {
            x.fixed_rows_mut::<4>(q + 3)
                .scale_mut(1.0 + any(spread.norm));
        }
    }
    x
}

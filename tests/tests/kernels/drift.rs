//! Euler parameters off the unit sphere.

use holonom::{
    mechanism::{Compliant, Plain, Stabilised, Terms},
    state::Array,
};
use holonom_assembler::bodies::Orientation;
use holonom_assembler::saddle::Coefficients;
use holonom_assembler::states::Spread;

use crate::comparison::{DOUBLE, SOLUTION, Worst, distance};
use crate::scene::{Scene, constants, dense, off, state, states_to_try, values};
use crate::solutions::{Reference, evaluated};

/// Near the constraints, `|p|` up to this much from 1.
const fn drifted(norm: f64) -> Spread {
    Spread {
        position: 0.01,
        angle: 0.01,
        velocity: 1.0,
        rate: 2.0,
        norm,
    }
}

/// The largest deviation of the kernels from the assembler's, `|p|` up to `norm` from 1.
fn of_kernels<M: Scene>(norm: f64) -> f64 {
    let scene = M::read_as(Orientation::Raw);
    let constants = constants::<f64, M>();
    let mut worst = Worst::default();
    for x in off(&scene, states_to_try(), 12, drifted(norm)) {
        let x = x.as_slice();
        let state = state::<f64, M>(x);
        let jacobian = M::jacobian(&constants, 0.0, &state);
        let jacobian = dense::<f64, M>(jacobian.as_slice());
        for (what, computed, reference) in [
            (
                "Phi",
                values(M::constraints(&constants, 0.0, &state).as_slice()),
                scene.constraints(x).as_slice(),
            ),
            (
                "Phi'",
                values(M::constraint_rates(&constants, 0.0, &state).as_slice()),
                scene.constraint_rates(x).as_slice(),
            ),
            (
                "gamma",
                values(M::gamma(&constants, 0.0, &state).as_slice()),
                scene.gamma(x).as_slice(),
            ),
            (
                "D",
                jacobian.as_slice().to_vec(),
                scene.jacobian(x).as_slice(),
            ),
            (
                "q'",
                values(M::coordinate_rates(&constants, &state).as_slice()),
                scene.coordinate_rates(x).as_slice(),
            ),
        ] {
            worst.take(what, distance(&computed, reference, 1.0), f64::MAX);
        }
    }
    worst.0
}

fn kernels_take_p_as_it_is<M: Scene>() {
    let [near, far] = [1e-6, 0.05].map(of_kernels::<M>);
    println!("kernels: {near:e} at a drift of 1e-6, {far:e} at 0.05");
    assert!(near <= DOUBLE && far <= DOUBLE);
}

fn evaluations<M: Scene, T: Terms>(what: &str, coefficients: Coefficients) {
    let scene = M::read_as(Orientation::Normalised);
    let mut worst = Worst::default();
    for x in off(&scene, states_to_try(), 13, drifted(0.05)) {
        let reference = Reference::new(&scene, coefficients, x.as_slice());
        let (solution, rates) = evaluated::<f64, M, T>(coefficients, x.as_slice());
        let deviation = reference.deviation(&solution, SOLUTION);
        worst.take(what, deviation, SOLUTION);
        let reference = scene.coordinate_rates(x.as_slice());
        worst.take("q'", distance(&rates, reference.as_slice(), 0.0), DOUBLE);
    }
    println!("{what}: largest deviation {:e} of the condition", worst.0);
}

const BAUMGARTE: Coefficients = Coefficients {
    a: 5.0,
    b: 7.0,
    eps: 0.0,
};
const PENALTY: Coefficients = Coefficients {
    a: 10.0,
    b: 10.0,
    eps: 1e-7,
};

/// In `A` alone: the rates of `p` are those of `p` as it is.
fn an_evaluation_reads_p_over_its_length<M: Scene>() {
    evaluations::<M, Plain>("standard", Coefficients::default());
    evaluations::<M, Stabilised>("baumgarte", BAUMGARTE);
    evaluations::<M, Compliant>("penalty", PENALTY);
}

mod kernels_take_p_as_it_is {
    every_independent_mechanism! { kernels_take_p_as_it_is }
    every_redundant_mechanism! { kernels_take_p_as_it_is }
}

mod an_evaluation_reads_p_over_its_length {
    every_independent_mechanism! { an_evaluation_reads_p_over_its_length }
}

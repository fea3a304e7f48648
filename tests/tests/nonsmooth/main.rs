//! Mechanisms with stops, impacts, brakes and dry friction, against closed forms and against
//! integrals over minimal coordinates of their own: `reference.py`.

#![forbid(unsafe_code)]

mod brakes;
mod capacity;
mod clock;
mod cradle;
mod extremes;
mod reference;
mod rest;
mod rocking;
mod stick_slip;
mod stops;

use holonom::Runs;
use holonom::measure::{Interacting, NoForces};
use holonom::mechanism::Coordinates;
use holonom::prelude::*;
use holonom_fixtures as _;

/// An integrator that moves a mechanism with so many interactions.
trait Moves<M: Mechanism, C: Coordinates<M>, const K: usize>:
    Runs<Problem<M, StandardLagrange, f64, C, Interacting<f64, M, NoForces, K>>>
{
}

impl<I, M, C, const K: usize> Moves<M, C, K> for I
where
    M: Mechanism,
    C: Coordinates<M>,
    I: Runs<Problem<M, StandardLagrange, f64, C, Interacting<f64, M, NoForces, K>>>,
{
}

const GRAVITY: f64 = 9.81;

fn tight() -> Tolerance<f64> {
    Tolerance {
        relative: 1e-12,
        absolute: 1e-12,
    }
}

/// Times agree, and there are as many.
fn assert_times(what: &str, found: &[f64], wanted: &[f64], bound: f64) {
    assert_eq!(found.len(), wanted.len(), "{what}: {found:?}");
    for (found, wanted) in found.iter().zip(wanted) {
        let error = (found - wanted).abs();
        assert!(error < bound, "{what}: {found} {wanted} {error:e}");
    }
}

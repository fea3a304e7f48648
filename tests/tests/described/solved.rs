//! The bodies' equations of mechanisms that run by their joints: without loops, and by loops over
//! their rows where there are many.

use holonom::mechanism::{Compliant, Plain, Stabilisation, Terms};
use holonom::prelude::*;
use holonom::state::Array;

use crate::descriptions::{Crane, FourBar, Loose};

/// Fourteen links on hinges that are inclined against each other, closed by a ball at the tip: too
/// many for code without loops.
#[derive(Mechanism)]
#[mechanism(gravity = [0.3, -9.7, 1.1], coordinates = "joints")]
struct Chain {
    #[body(mass = 1.0 + 0.1 * k, inertia = [0.02, 0.03, 0.04], position = [0.2 * k, 0.1, 0.05 * k])]
    links: [Body; 14],
    #[joint(
        between = [if k == 0 { ground } else { links[k - 1] }, links[k]],
        point = [0.2 * k - 0.1, 0.0, 0.05 * k], axis = [1.0, 0.3 * k - 2.0, 0.5]
    )]
    hinges: [Revolute; 14],
    #[joint(between = [links[13], ground], point = [2.7, 0.2, 0.7])]
    tip: Spherical,
}

/// Puts solutions into the equations, and returns the smallest relative pivot.
///
/// ```text
/// M u' + D^T lambda = upper        D u' - E lambda = lower
/// ```
fn put_in<M: Mechanism, T: Terms>(mechanism: &M, state: &M::State<f64>, compliance: f64) -> f64 {
    let parameters = mechanism.parameters().expect("numbers of a mechanism");
    let constants = M::prepare::<f64>(&parameters);
    let stabilisation = Stabilisation {
        rate: 0.0,
        position: 0.0,
        compliance,
    };
    let coefficients = M::coefficients(&constants, &stabilisation);
    let compliance = if T::COMPLIANT { compliance } else { 0.0 };
    let (factors, pivot) = M::factor::<f64, T>(&constants, &coefficients, 0.0, state);
    let mut upper = M::forces(&constants, 0.0, state);
    let mut lower = M::gamma(&constants, 0.0, state);
    for (number, row) in lower.as_mut_slice().iter_mut().enumerate() {
        *row += 0.1 * (number as f64 + 1.0).sin();
    }
    let (a, lambda) = M::solve::<f64, T>(&constants, &coefficients, &factors, &upper, &lower);
    let (mass, jacobian) = (M::mass(&constants), M::jacobian(&constants, 0.0, state));
    let size = |x: &[f64]| x.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
    let tolerance = 1e-11 * size(a.as_slice()).max(size(lambda.as_slice()));
    let (forces, rows) = (upper.as_mut_slice(), lower.as_mut_slice());
    for (k, force) in forces.iter_mut().enumerate() {
        *force -= mass.as_slice()[k] * a.as_slice()[k];
    }
    for (k, row) in rows.iter_mut().enumerate() {
        *row += compliance * lambda.as_slice()[k];
    }
    for block in M::REPORT.blocks {
        for row in 0..block.rows {
            for column in 0..block.columns {
                let entry = jacobian.as_slice()[block.offset + row * block.columns + column];
                forces[block.column + column] -= entry * lambda.as_slice()[block.row + row];
                rows[block.row + row] -= entry * a.as_slice()[block.column + column];
            }
        }
    }
    let left = size(forces) + size(rows) - 2.0;
    let left = left.max(
        forces
            .iter()
            .chain(&*rows)
            .fold(0.0_f64, |left, x| left.max(x.abs())),
    );
    assert!(left < tolerance, "{}: {left:e}", M::REPORT.name);
    pivot.relative
}

fn solved<M: Mechanism>(mechanism: &M, state: &M::State<f64>) {
    for compliance in [1e-3, 1e-9] {
        assert_eq!(put_in::<M, Compliant>(mechanism, state, compliance), 1.0);
    }
    let pivot = put_in::<M, Plain>(mechanism, state, 0.0);
    println!("{}: {pivot:e}", M::REPORT.name);
    assert!(pivot > 1e-3 && pivot < 1.0, "{pivot:e}");
}

#[test]
fn solutions_satisfy_the_equations() {
    let crane = Crane::driven().expect("numbers of a crane");
    solved(&crane, &crane.start());
    let loose = Loose::default();
    solved(&loose, &loose.described_state().expect("described"));
    let four_bar = FourBar::default();
    solved(&four_bar, &four_bar.described_state().expect("described"));
    let chain = Chain::default();
    solved(&chain, &chain.described_state().expect("described"));
}

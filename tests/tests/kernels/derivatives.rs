//! The kernels `D` and `gamma` are derivatives of the kernels `Phi` and `Phi'`: by the kernels
//! themselves over dual numbers, by the assembler's `Phi` over dual numbers, and by finite
//! differences.

use holonom::{Mechanism, Scalar, StateParts, state::Array};
use holonom_assembler::bodies::Orientation;
use holonom_assembler::dual;
use holonom_assembler::states::{Spread, displace};
use nalgebra::{DMatrix, DVector};

use crate::comparison::{DOUBLE, Worst, distance};
use crate::scalars::Dual;
use crate::scene::{Scene, consistent, constants, dense, off, state, values, violated};

/// What finite differences may differ by: their step is 1e-5, its square and the round-off over it
/// are 1e-10.
const FINITE: f64 = 1e-6;
const STEP: f64 = 1e-5;

/// Off the constraints as `violated` is, and `|p|` up to 5 % from 1.
const DRIFTED: Spread = Spread {
    position: 0.1,
    angle: 0.1,
    velocity: 1.0,
    rate: 2.0,
    norm: 0.05,
};

fn states<M: Scene>(count: usize) -> Vec<DVector<f64>> {
    let scene = M::assembler();
    let mut states = consistent(&scene, count, 7);
    states.extend(violated(&scene, count, 8));
    states.extend(off(&scene, count, 9, DRIFTED));
    states
}

/// The state on a curve with these rates of the coordinates, velocities constant.
fn curve<M: Mechanism>(x: &[f64], rates: &[f64]) -> M::State<Dual> {
    let mut state = state::<Dual, M>(x);
    let coordinates = state.coordinates_mut().as_mut_slice();
    for ((coordinate, value), rate) in coordinates.iter_mut().zip(x).zip(rates) {
        *coordinate = Dual::new(*value, *rate);
    }
    state
}

/// The rates of the coordinates for given velocities: the kernel, at a state with these velocities.
fn rates<M: Scene>(x: &[f64], velocities: &[f64]) -> Vec<f64> {
    let mut x = x.to_vec();
    x[M::REPORT.coordinates..].copy_from_slice(velocities);
    let constants = constants::<f64, M>();
    values(M::coordinate_rates(&constants, &state::<f64, M>(&x)).as_slice())
}

fn derivatives(elements: &[Dual]) -> Vec<f64> {
    elements
        .iter()
        .map(|element| element.derivative())
        .collect()
}

/// `D` column by column: `Phi` along a displacement, or a virtual rotation, of one body.
fn differentiated_jacobian<M: Scene>(x: &[f64]) -> DMatrix<f64> {
    let constants = constants::<Dual, M>();
    let mut matrix = DMatrix::zeros(M::REPORT.equations, M::REPORT.velocities);
    for column in 0..M::REPORT.velocities {
        let mut unit = vec![0.0; M::REPORT.velocities];
        unit[column] = 1.0;
        let state = curve::<M>(x, &rates::<M>(x, &unit));
        let phi = M::constraints(&constants, Dual::zero(), &state);
        matrix.set_column(column, &DVector::from_vec(derivatives(phi.as_slice())));
    }
    matrix
}

fn columns(matrix: &DMatrix<f64>) -> Vec<Vec<f64>> {
    let columns = matrix.column_iter();
    columns
        .map(|column| column.iter().copied().collect())
        .collect()
}

fn dual_numbers<M: Scene>() {
    let scene = M::read_as(Orientation::Raw);
    let (plain, duals) = (constants::<f64, M>(), constants::<Dual, M>());
    let mut worst = Worst::default();
    for x in states::<M>(100) {
        let x = x.as_slice();
        let state = state::<f64, M>(x);
        let jacobian = M::jacobian(&plain, 0.0, &state);
        let jacobian = dense::<f64, M>(jacobian.as_slice());
        for (what, reference) in [
            ("D by the kernels", differentiated_jacobian::<M>(x)),
            ("D by the assembler", dual::jacobian(&scene, x)),
        ] {
            for (computed, reference) in columns(&jacobian).iter().zip(columns(&reference)) {
                worst.take(what, distance(computed, &reference, 1.0), DOUBLE);
            }
        }
        // Phi' along the motion without accelerations, and Phi along the motion.
        let moving = curve::<M>(x, &rates::<M>(x, &x[M::REPORT.coordinates..]));
        let phi = M::constraints(&duals, Dual::zero(), &moving);
        let phi_rate = M::constraint_rates(&duals, Dual::zero(), &moving);
        let minus_gamma = derivatives(phi_rate.as_slice());
        let by_kernels = [
            derivatives(phi.as_slice()),
            minus_gamma.iter().map(|value| -value).collect(),
        ];
        let (rate, gamma) = dual::constraint_rates_and_gamma(&scene, x);
        let by_assembler = [rate, gamma].map(|vector| vector.as_slice().to_vec());
        let computed = [
            values(M::constraint_rates(&plain, 0.0, &state).as_slice()),
            values(M::gamma(&plain, 0.0, &state).as_slice()),
        ];
        for reference in [by_kernels, by_assembler] {
            for (k, what) in ["Phi'", "gamma"].into_iter().enumerate() {
                let deviation = distance(&computed[k], &reference[k], 1.0);
                worst.take(what, deviation, DOUBLE);
            }
        }
    }
    println!("dual numbers: largest deviation {:e}", worst.0);
}

/// A state moved by finite displacements and rotations.
fn displaced<M: Scene>(x: &[f64], motion: &DVector<f64>) -> M::State<f64> {
    let mut x = x.to_vec();
    displace(&M::assembler(), &mut x, motion.as_slice());
    state::<f64, M>(&x)
}

/// The central difference of a kernel along a motion.
fn difference<M: Scene>(
    x: &[f64],
    motion: &DVector<f64>,
    kernel: impl Fn(&M::State<f64>) -> Vec<f64>,
) -> Vec<f64> {
    let [ahead, behind] = [STEP, -STEP].map(|step| kernel(&displaced::<M>(x, &(step * motion))));
    let pairs = ahead.iter().zip(&behind);
    pairs
        .map(|(ahead, behind)| (ahead - behind) / (2.0 * STEP))
        .collect()
}

fn finite_differences<M: Scene>() {
    let constants = constants::<f64, M>();
    let phi = |state: &M::State<f64>| values(M::constraints(&constants, 0.0, state).as_slice());
    let rate =
        |state: &M::State<f64>| values(M::constraint_rates(&constants, 0.0, state).as_slice());
    let mut worst = Worst::default();
    // Rotations leave p at unit length only where it has it.
    let scene = M::assembler();
    let mut states = consistent(&scene, 30, 10);
    states.extend(violated(&scene, 30, 11));
    for x in states {
        let x = x.as_slice();
        let state = state::<f64, M>(x);
        let jacobian = M::jacobian(&constants, 0.0, &state);
        let jacobian = dense::<f64, M>(jacobian.as_slice());
        for (column, computed) in columns(&jacobian).iter().enumerate() {
            let mut unit = DVector::zeros(M::REPORT.velocities);
            unit[column] = 1.0;
            let reference = difference::<M>(x, &unit, phi);
            worst.take("D", distance(computed, &reference, 1.0), FINITE);
        }
        let motion = DVector::from_column_slice(&x[M::REPORT.coordinates..]);
        let reference: Vec<f64> = difference::<M>(x, &motion, rate)
            .iter()
            .map(|value| -value)
            .collect();
        let gamma = values(M::gamma(&constants, 0.0, &state).as_slice());
        worst.take("gamma", distance(&gamma, &reference, 1.0), FINITE);
    }
    println!("finite differences: largest deviation {:e}", worst.0);
}

mod dual_numbers {
    every_independent_mechanism! { dual_numbers }
    every_redundant_mechanism! { dual_numbers }
}

mod finite_differences {
    every_independent_mechanism! { finite_differences }
    every_redundant_mechanism! { finite_differences }
}

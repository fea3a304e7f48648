//! `D` and `gamma` of equations of velocities are derivatives of their `Phi'`, and `Phi'` is what a
//! person writes.

use holonom::nalgebra::{UnitQuaternion, Vector3};
use holonom::prelude::*;
use holonom::state::Array;
use holonom::{Forward, Mechanism};
use holonom_models::Bicycle;

use crate::bowl::Bowl;
use crate::free::{Disc, Drum, Table, disc};
use crate::rattleback::Rattleback;
use crate::robot::{Robot, Shafts};
use crate::sleigh::sleigh;

type Dual = Forward<f64, 1>;

/// Numbers from -1 to 1 without a pattern.
fn spread(seed: usize) -> impl Iterator<Item = f64> {
    (1..).map(move |k| 2.0 * ((k + 97 * seed) as f64 * 0.618_033_988_749_895 % 1.0) - 1.0)
}

/// A state that no joint knows of.
fn any<M: Mechanism>(seed: usize) -> M::State<f64> {
    let mut coordinates = <M::State<f64> as StateParts<f64>>::Coordinates::zeros();
    let mut velocities = <M::State<f64> as StateParts<f64>>::Velocities::zeros();
    let mut numbers = spread(seed);
    let mut fill = |slice: &mut [f64]| slice.iter_mut().zip(&mut numbers).for_each(|(x, n)| *x = n);
    fill(coordinates.as_mut_slice());
    fill(velocities.as_mut_slice());
    for body in M::REPORT.bodies {
        let p = &mut coordinates.as_mut_slice()[body.coordinate + 3..body.coordinate + 7];
        let length = p.iter().map(|e| e * e).sum::<f64>().sqrt();
        p.iter_mut().for_each(|e| *e /= length);
    }
    M::State::from_parts(coordinates, velocities)
}

/// The state with derivatives of its coordinates and velocities.
fn along<M: Mechanism>(
    state: &M::State<f64>,
    coordinates: &[f64],
    velocities: &[f64],
) -> M::State<Dual> {
    let mut q = <M::State<Dual> as StateParts<Dual>>::Coordinates::zeros();
    let mut u = <M::State<Dual> as StateParts<Dual>>::Velocities::zeros();
    let put = |to: &mut [Dual], values: &[f64], slopes: &[f64]| {
        for (place, number) in to.iter_mut().enumerate() {
            *number = Dual::new(values[place], [slopes.get(place).copied().unwrap_or(0.0)]);
        }
    };
    put(
        q.as_mut_slice(),
        state.coordinates().as_slice(),
        coordinates,
    );
    put(u.as_mut_slice(), state.velocities().as_slice(), velocities);
    M::State::from_parts(q, u)
}

fn slopes(numbers: &[Dual]) -> Vec<f64> {
    numbers
        .iter()
        .map(|number| number.derivatives()[0])
        .collect()
}

fn are_derivatives<M: Mechanism>(mechanism: &M) {
    let time = 0.7;
    let plain = mechanism.constants::<f64>().expect("parameters");
    let duals = mechanism.constants::<Dual>().expect("parameters");
    for seed in 0..50 {
        let state = any::<M>(seed);
        let phi = M::constraints(&plain, time, &state);
        let of_velocities = M::REPORT.velocity_rows;
        assert!(!of_velocities.is_empty());
        assert!(of_velocities.iter().all(|&row| phi.as_slice()[row] == 0.0));
        let width = M::REPORT.velocities;
        let mut jacobian = vec![vec![0.0; width]; M::REPORT.equations];
        let values = M::jacobian(&plain, time, &state);
        for block in M::REPORT.blocks {
            let values = values.as_slice()[block.offset..].chunks(block.columns);
            for (row, values) in (block.row..block.row + block.rows).zip(values) {
                jacobian[row][block.column..block.column + block.columns].copy_from_slice(values);
            }
        }
        for column in 0..width {
            let mut unit = vec![0.0; width];
            unit[column] = 1.0;
            let moved = along::<M>(&state, &[], &unit);
            let rates = M::constraint_rates(&duals, Dual::fixed(time), &moved);
            for &row in of_velocities {
                let expected = slopes(rates.as_slice())[row];
                let found = jacobian[row][column];
                let off = (found - expected).abs();
                assert!(
                    off < 1e-12 * (1.0 + expected.abs()),
                    "{row} {column}: {found} {expected}"
                );
            }
        }
        let rates = M::coordinate_rates(&plain, &state);
        let moving = along::<M>(&state, rates.as_slice(), &[]);
        let later = M::constraint_rates(&duals, Dual::new(time, [1.0]), &moving);
        let gamma = M::gamma(&plain, time, &state);
        for &row in of_velocities {
            let (found, expected) = (gamma.as_slice()[row], -slopes(later.as_slice())[row]);
            let off = (found - expected).abs();
            assert!(
                off < 1e-11 * (1.0 + expected.abs()),
                "gamma {row}: {found} {expected}"
            );
        }
    }
}

#[test]
fn rows_are_derivatives_of_rates() {
    are_derivatives(&Bicycle::default());
    are_derivatives(&disc(0.03));
    are_derivatives(&Table::new(3.0).expect("a table"));
    are_derivatives(&sleigh(0.4));
    are_derivatives(&Drum::default());
    are_derivatives(&Bowl::new(0.6).expect("a bowl"));
    are_derivatives(&Robot::new(0.08, 3.0, 5.0).expect("a robot"));
    are_derivatives(&Shafts::default());
    are_derivatives(&Rattleback::new(-0.05).expect("a rattleback"));
}

/// The slip of a disc, and that it touches, by the angular velocity and the lowest point.
#[test]
fn a_wheel_slips_by_what_its_lowest_point_does() {
    let disc = disc(0.0);
    let constants = disc.constants::<f64>().expect("parameters");
    let h = Disc::HANDLES;
    for seed in 0..50 {
        let state = any::<Disc>(seed);
        let pose = Disc::pose(&state, h.disc);
        let axle = UnitQuaternion::new_normalize(pose.orientation) * Vector3::y();
        let lowest = -(Vector3::z() - axle * axle.z).normalize() * 0.2;
        let spin = Disc::angular_velocity_global(&state, h.disc);
        let slip = Disc::velocity(&state, h.disc) + spin.cross(&lowest);
        let phi = Disc::constraints(&constants, 0.0, &state);
        let rates = Disc::constraint_rates(&constants, 0.0, &state);
        assert!((phi.as_slice()[0] - (pose.position + lowest).z).abs() < 1e-13);
        // Along two directions of the plane that are perpendicular.
        let found: f64 = rates.as_slice()[1..].iter().map(|rate| rate * rate).sum();
        assert!((found - slip.xy().norm_squared()).abs() < 1e-12 * (1.0 + found));
    }
}

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
    are_derivatives(&Carried::default());
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

/// A base that moves, a ball in its bowl, and two wheels on its plane that touch each other.
#[derive(Mechanism)]
struct Carried {
    #[body(mass = 3.0, inertia = [1.0, 1.0, 1.0], position = [0.1, 0.2, 0.3])]
    base: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], position = [0.0, 0.0, -0.55])]
    ball: Body,
    #[body(mass = 1.0, inertia = [1.0, 2.0, 1.0], position = [0.0, 0.2, 0.1])]
    left: Body,
    #[body(mass = 1.0, inertia = [1.0, 2.0, 1.0], position = [0.0, -0.2, 0.1])]
    right: Body,
    #[joint(
        between = [base, ball], center = [0.0, 0.0, -0.55], bowl = [0.0, 0.0, 0.0],
        axis = [0.0, 0.0, 1.0], radius = 0.05, bowl_radius = 0.6
    )]
    bowl: RollingBallInBowl,
    #[joint(
        between = [base, left, right], center_j = [0.0, 0.2, 0.1], center_k = [0.0, -0.2, 0.1],
        axle = [0.0, 1.0, 0.0], point = [0.0, 0.0, 0.0], normal = [0.0, 0.0, 1.0], radius = 0.1
    )]
    wheels: WheelPair,
    #[joint(between = [left, right, base], point = [0.2, 0.0, 0.1], tangent = [1.0, 0.0, 0.0])]
    pair: RollingPair,
}

/// On what moves, bodies slip by the velocities of their material points against each other.
#[test]
fn what_is_carried_slips_by_its_material_points() {
    let carried = Carried::default();
    let constants = carried.constants::<f64>().expect("parameters");
    let h = Carried::HANDLES;
    for seed in 0..50 {
        let state = any::<Carried>(seed);
        let base = Carried::pose(&state, h.base);
        let turned = UnitQuaternion::new_normalize(base.orientation);
        let place = |body| Carried::pose(&state, body).position;
        let velocity = |body, at: Vector3<f64>| {
            let spin = Carried::angular_velocity_global(&state, body);
            Carried::velocity(&state, body) + spin.cross(&(at - place(body)))
        };
        let slip = |body, against, at| velocity(body, at) - velocity(against, at);
        let on_base = |point: [f64; 3]| {
            base.position + turned * (Vector3::from(point) - Vector3::new(0.1, 0.2, 0.3))
        };
        let phi = Carried::constraints(&constants, 0.0, &state);
        let rates = Carried::constraint_rates(&constants, 0.0, &state);
        let (phi, rates) = (phi.as_slice(), rates.as_slice());

        let line = place(h.ball) - on_base([0.0; 3]);
        let outward = line / 0.55;
        assert!((phi[0] - 0.5 * (line.norm_squared() / 0.55 - 0.55)).abs() < 1e-13);
        let of_ball = slip(h.ball, h.base, place(h.ball) + 0.05 * outward);
        let across = turned.inverse() * outward.cross(&of_ball);
        let found: f64 = rates[1..3].iter().map(|rate| rate * rate).sum();
        assert!((found - across.xy().norm_squared()).abs() < 1e-12 * (1.0 + found));

        let normal = turned * Vector3::z();
        let left = UnitQuaternion::new_normalize(Carried::pose(&state, h.left).orientation);
        let axle = left * Vector3::y();
        let [of_left, of_right] = [h.left, h.right].map(|wheel| {
            let height = normal.dot(&(place(wheel) - on_base([0.0; 3])));
            (height, slip(wheel, h.base, place(wheel) - 0.1 * normal))
        });
        let along = axle.cross(&normal);
        let of_pair = slip(h.right, h.left, on_base([0.2, 0.0, 0.1]));
        for (found, expected) in [
            (phi[3], of_left.0 - 0.1),
            (phi[4], of_right.0 - 0.1),
            (rates[5], axle.dot(&of_left.1)),
            (rates[6], along.dot(&of_left.1)),
            (rates[7], along.dot(&of_right.1)),
            (rates[8], (turned * Vector3::x()).dot(&of_pair)),
        ] {
            let off = (found - expected).abs();
            assert!(
                off < 1e-12 * (1.0 + expected.abs()),
                "{found} for {expected}"
            );
        }
    }
}

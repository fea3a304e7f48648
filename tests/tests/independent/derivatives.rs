//! `kernels = [derivatives]`: the accelerations with their derivatives as a kernel, against numbers
//! that carry derivatives. `kernels = [adjoint]`: how a weighted sum of accelerations changes.
//! `kernels = [forward]`, against the mass matrix.

use core::array::from_fn;
use core::f64::consts::PI;

use holonom::independent::{IndependentCoordinates, Linearised};
use holonom::mechanism::{
    HasInverse, HasMassMatrix, JointRates, Plain as Rigid, Stabilisation, ValueHandle,
};
use holonom::prelude::*;
use holonom::spline::Spline;
use holonom::state::Array;
use holonom_models::{Panda, Ur5};

use crate::derivatives_reference as pinocchio;

/// A friction that falls with the rate.
static FRICTION: Spline<4> = Spline::natural([-3.0, -1.0, 1.0, 3.0], [0.4, 0.6, -0.6, -0.4]);

/// The same mechanism twice: with the kernel and without.
macro_rules! twins {
    // Of a plane loop some rows follow from the others.
    ($with:ident by $by:ident, $without:ident, $fields:tt) => {
        twins! { @$with [mass, inverse, forward, derivatives($by), adjoint] $fields }
        twins! { @$without [mass, inverse] $fields }
    };
    (@$name:ident [$($kernel:tt)*] { $($fields:tt)* }) => {
        #[derive(Clone, Copy, Debug, Mechanism)]
        #[mechanism(gravity = [0.3, -0.2, -9.81], redundant = "drop", coordinates = "joints", kernels = [$($kernel)*])]
        struct $name { $($fields)* }
    };
}

// All that a tree may have. A hull floats. Arms about parallel axes are counted together, and
// backwards. There are a slide, a thread, a ball, and laws with every function.
twins!(Crawler by long, Plain, {
    #[param(like = 0.7)]
    long: f64,
    #[input]
    torque: f64,
    #[input]
    push: f64,
    #[input]
    pull: f64,
    #[body(mass = 3.0, inertia = [[0.5, 0.1, 0.0], [0.1, 0.7, -0.1], [0.0, -0.1, 0.6]], free)]
    hull: Body,
    #[body(mass = 1.0, inertia = [0.02, 0.1, 0.09], position = [0.2 + 0.5 * long, 0.0, 0.1])]
    upper: Body,
    #[joint(between = [hull, upper], point = [0.2, 0.0, 0.1], axis = [0.0, 1.0, 0.0])]
    shoulder: Revolute,
    #[body(mass = 0.8, inertia = [0.01, 0.06, 0.07], position = [0.5 + long, 0.05, 0.1])]
    lower: Body,
    #[joint(between = [lower, upper], point = [0.2 + long, 0.0, 0.1], axis = [0.0, 1.0, 0.0])]
    elbow: Revolute,
    #[body(mass = 0.4, inertia = [0.01, 0.02, 0.015], position = [0.9 + long, 0.0, 0.2])]
    slide: Body,
    #[joint(between = [lower, slide], point = [0.5 + long, 0.0, 0.1], axis = [0.6, 0.0, 0.8])]
    rail: Prismatic,
    #[body(mass = 0.3, inertia = [0.004, 0.005, 0.006], position = [-0.3, 0.2, 0.0])]
    nut: Body,
    #[joint(between = [hull, nut], point = [-0.3, 0.2, 0.0], axis = [0.0, 0.6, 0.8], pitch = 0.05)]
    thread: Screw,
    #[body(mass = 0.5, inertia = [0.01, 0.012, 0.02], position = [-0.3, -0.4, 0.3])]
    tail: Body,
    #[joint(between = [hull, tail], point = [-0.2, -0.2, 0.2])]
    socket: Spherical,
    #[force(between = [hull, upper], axis = [0.0, 1.0, 0.0], moment = torque)]
    motor: TorsionalActuator,
    #[force(between = [upper, lower], axis = [0.0, 1.0, 0.0],
        moment = FRICTION(rate) - exp(0.3 * angle) + 2.0 * long * push)]
    brake: TorsionalActuator,
    #[force(between = [lower, slide], head = [0.3 + long, 0.1, 0.1], tail = [0.9 + long, 0.1, 0.2],
        force = 5.0 * smooth_step(2.0 * length - 0.7) * sin(time) - sqrt(1.0 + rate * rate) + atan(length))]
    piston: Actuator,
    #[force(between = [ground, slide], head = [0.0, 1.0, 0.5], tail = [0.9 + long, 0.1, 0.2],
        stiffness = 40.0, damping = 3.0, free_length = 0.5)]
    spring: SpringDamper,
    #[force(between = [hull, tail], damping = 0.2)]
    damper: RotationalDamper,
    #[force(between = [tail], point = [-0.5, -0.5, 0.3], force = [pull, 0.0, 1.0])]
    jet: FollowerForce,
});

// A five-bar in a plane, a rod in space from it to a slide, a driver that moves a weight along.
twins!(Looped by crank, PlainLooped, {
    #[param(like = 0.3)]
    crank: f64,
    #[input]
    torque: f64,
    #[input]
    wind: f64,
    #[body(mass = 1.0, inertia = [0.02, 0.03, 0.04], position = [-0.05, 0.14, 0.0])]
    left: Body,
    #[joint(between = [ground, left], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    motor_hinge: Revolute,
    #[body(mass = 0.8, inertia = [0.01, 0.02, 0.02], position = [0.45, 0.14, 0.0])]
    right: Body,
    #[joint(between = [ground, right], point = [0.4, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    other_hinge: Revolute,
    #[body(mass = 0.5, inertia = [0.01, 0.01, 0.015], position = [0.05, 0.39, 0.05])]
    upper: Body,
    #[joint(between = [left, upper], point = [-crank / 3.0, 0.28, 0.0], axis = [0.0, 0.0, 1.0])]
    elbow: Revolute,
    #[body(mass = 0.6, inertia = [0.01, 0.01, 0.015], position = [0.35, 0.39, -0.05])]
    wide: Body,
    #[joint(between = [right, wide], point = [0.5, 0.28, 0.0], axis = [0.0, 0.0, 1.0])]
    knee: Revolute,
    #[joint(between = [upper, wide], point = [0.2, 0.5, 0.0], axis = [0.0, 0.0, 1.0])]
    top: Revolute,
    #[body(mass = 0.7, inertia = [0.02, 0.02, 0.02], position = [0.2, 0.5, 0.6])]
    slide: Body,
    #[joint(between = [ground, slide], point = [0.2, 0.5, 0.6], axis = [0.0, 0.6, 0.8])]
    rail: Prismatic,
    #[joint(between = [upper, slide], head = [0.1, 0.4, 0.1], tail = [0.2, 0.5, 0.6])]
    rod: Distance,
    #[body(mass = 0.2, inertia = [0.001, 0.001, 0.002], position = [0.3, 0.5, 0.7])]
    weight: Body,
    #[joint(between = [slide, weight], point = [0.3, 0.5, 0.7], axis = [1.0, 0.0, 0.0])]
    track: Prismatic,
    #[joint(between = [slide, weight], point = [0.3, 0.5, 0.7], axis = [1.0, 0.0, 0.0],
        motion = crank * sin(2.0 * time))]
    drive: DisplacementDriver,
    #[force(between = [ground, left], axis = [0.0, 0.0, 1.0], moment = torque - 0.1 * rate)]
    motor: TorsionalActuator,
    #[force(between = [ground, wide], point = [0.3, 0.4, 0.0], force = [wind, 2.0, 0.0])]
    gust: PointForce,
    #[force(between = [ground, slide], head = [1.0, 1.0, 1.0], tail = [0.2, 0.5, 0.6], stiffness = 30.0, free_length = 0.4)]
    spring: SpringDamper,
});

holonom::joint! {
    /// A follower on the profile of a cam.
    joint Cam(i, j, k; axis: Axis, point: Point, slide: Axis, lift: Law(phi)) {
        dot(k.slide, j.point - k.point) - lift(angle(k, i, axis));
    }
}

/// The lift of a cam.
static LIFT: Spline<5> = Spline::periodic(
    [0.0, 0.5 * PI, PI, 1.5 * PI, 2.0 * PI],
    [0.0, 0.01, 0.02, 0.01, 0.0],
);

/// A spline in the equation of a joint: its third derivative jumps.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(coordinates = "joints", kernels = [mass, inverse, derivatives])]
struct Camshaft {
    #[body(mass = 1.0, inertia = [0.02, 0.03, 0.04])]
    shaft: Body,
    #[joint(between = [ground, shaft], point = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    hinge: Revolute,
    #[body(mass = 0.4, inertia = [0.02, 0.03, 0.05], position = [0.0, 0.0, 0.1])]
    tappet: Body,
    #[joint(between = [ground, tappet], point = [0.0, 0.0, 0.1], axis = [0.0, 0.0, 1.0])]
    guide: Prismatic,
    #[joint(between = [shaft, tappet, ground], axis = [0.0, 1.0, 0.0], point = [0.0, 0.0, 0.1],
        slide = [0.0, 0.0, 1.0], lift = LIFT(phi))]
    cam: Cam,
}

/// The largest difference of two matrices, over the largest entry.
fn off(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    let largest = b.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let pairs = a.iter().zip(b);
    pairs.fold(0.0_f64, |most, (x, y)| most.max((x - y).abs())) / largest.max(f64::MIN_POSITIVE)
}

fn parts<const N: usize, const K: usize, const P: usize>(
    linear: &Linearised<N, K, P>,
) -> [&[f64]; 5] {
    [
        linear.rates_by_positions.as_slice(),
        linear.by_positions.as_slice(),
        linear.by_rates.as_slice(),
        linear.by_efforts.as_slice(),
        linear.by_values.as_slice(),
    ]
}

/// `kernels = [adjoint]`, of random weights, against the columns of the derivatives.
fn weighed<M: JointRates>(
    parameters: &M::Parameters<f64>,
    time: f64,
    state: &M::JointState<f64>,
    mut noise: impl FnMut() -> f64,
) {
    let constants = M::prepare_joints(parameters);
    let none = Stabilisation {
        rate: 0.0,
        position: 0.0,
        compliance: 0.0,
    };
    let coefficients = M::joint_coefficients(&constants, &none, &Array::zeros());
    let mut weights = M::AdjointWeights::zeros();
    weights.as_mut_slice().fill_with(&mut noise);
    let found = M::adjoint::<f64, Rigid>(&constants, &coefficients, time, state, &weights);
    let columns = M::derivatives(&constants, time, state);
    let (weights, columns) = (weights.as_slice(), columns.as_slice());
    let rates = weights.len();
    let by = M::DERIVED_BY.expect("asked for");
    let inputs = M::ADJOINT_BY.expect("asked for").iter();
    let inputs = inputs.map(|input| by.iter().position(|value| value == input).expect("known"));
    // Behind positions and rates stand efforts.
    let places = (1..=2 * rates).chain(inputs.map(|place| 1 + 3 * rates + place));
    let wanted = places.map(|place| {
        let column = &columns[rates * place..rates * (place + 1)];
        column.iter().zip(weights).map(|(a, b)| a * b).sum::<f64>()
    });
    let wanted: Vec<f64> = wanted.collect();
    assert_eq!(found.as_slice().len(), wanted.len());
    let off = off(found.as_slice(), &wanted);
    assert!(off < 1e-12, "{off:e}");
}

/// Numbers from -1 to 1, always the same.
fn noise(seed: usize) -> impl FnMut() -> f64 {
    let mut place = seed as f64;
    move || {
        place += 1.0;
        (12.9898 * place).sin() * (0.7 * place * place).cos()
    }
}

/// Of a state the chosen coordinates and rates of another mechanism are the same.
fn compared<A, B, const N: usize, const K: usize>(
    with: (
        &IndependentCoordinates<A, N>,
        &A::JointState<f64>,
        [ValueHandle<A>; K],
    ),
    without: (
        &IndependentCoordinates<B, N>,
        &B::JointState<f64>,
        [ValueHandle<B>; K],
    ),
) -> Result<(), Fault>
where
    A: HasInverse + HasMassMatrix,
    B: HasInverse + HasMassMatrix,
{
    assert!(A::DERIVED_BY.is_some() && B::DERIVED_BY.is_none());
    let found = with.0.linearise(with.1, with.2, |_| [])?;
    let wanted = without.0.linearise(without.1, without.2, |_| [])?;
    for (part, (found, wanted)) in parts(&found).into_iter().zip(parts(&wanted)).enumerate() {
        let off = off(found, wanted);
        assert!(off < 1e-13, "part {part}: {off:e}");
    }
    Ok(())
}

#[test]
fn everything_that_a_tree_may_have() -> Result<(), Fault> {
    let (a, b) = (Crawler::new(0.7)?, Plain::new(0.7)?);
    let (h, g) = (Crawler::HANDLES, Plain::HANDLES);
    // All inputs have a column, and the parameter that is named.
    let columns = Crawler::DERIVED_BY.map(<[usize]>::len);
    assert_eq!(columns, Some(4));
    for seed in 0..20 {
        let mut noise = noise(31 * seed);
        let q: [f64; 4] = from_fn(|_| 1.5 * noise());
        let v: [f64; 13] = from_fn(|_| noise());
        let inputs: [f64; 3] = from_fn(|_| 5.0 * noise());
        let time = 3.0 * noise();
        macro_rules! standing {
            ($mechanism:expr, $h:expr) => {{
                let hull: [Motion<_>; 6] = from_fn(|k| Motion::free($h.hull, k));
                let [x, y, z, r, s, t] = hull;
                let [i, j, k] = from_fn(|k| Motion::of($h.socket, k));
                let [a, b] = [$h.shoulder, $h.elbow].map(|joint| Motion::of(joint, 0));
                let (c, d) = (Motion::of($h.rail, 0), Motion::of($h.thread, 0));
                let chosen = [x, y, z, r, s, t, a, b, c, d, i, j, k];
                let mut space = $mechanism.coordinates(chosen)?;
                space.set_time(time);
                for (handle, value) in [$h.torque, $h.push, $h.pull].into_iter().zip(inputs) {
                    space.set_value(handle, value)?;
                }
                let mut bodies = $mechanism.described_state::<f64>()?;
                let turn = nalgebra::Quaternion::new(0.5, q[0], q[1], 0.3).normalize();
                $mechanism.set_relative_orientation(&mut bodies, $h.socket, turn)?;
                $mechanism.set_angle(&mut bodies, $h.shoulder, q[0])?;
                $mechanism.set_angle(&mut bodies, $h.elbow, q[1])?;
                $mechanism.set_displacement(&mut bodies, $h.rail, 0.2 * q[2])?;
                $mechanism.set_angle(&mut bodies, $h.thread, 5.0 * q[3])?;
                let mut state = space.of_bodies(&bodies);
                state = space.with_rates(&state, v)?;
                (space, state)
            }};
        }
        let (with, one) = standing!(a, h);
        let (without, two) = standing!(b, g);
        compared(
            (&with, &one, [h.torque, h.push, h.pull, h.long]),
            (&without, &two, [g.torque, g.push, g.pull, g.long]),
        )?;
        let efforts: [f64; 13] = from_fn(|_| 2.0 * noise());
        let found = with.forward(&one, efforts)?;
        let wanted = without.forward(&two, efforts)?;
        assert!(off(found.as_slice(), wanted.as_slice()) < 1e-12);
        let mut parameters = a.parameters()?;
        for (handle, value) in [h.torque, h.push, h.pull].into_iter().zip(inputs) {
            parameters.as_mut_slice()[handle.index()] = value;
        }
        weighed::<Crawler>(&parameters, time, &one, &mut noise);
        // Of coordinates and rates the kernel has them as well.
        let found = with.linearise(&one, [h.torque, h.long], |view| [view.position(h.slide).x])?;
        let wanted =
            without.linearise(&two, [g.torque, g.long], |view| [view.position(g.slide).x])?;
        for (found, wanted) in parts(&found).into_iter().zip(parts(&wanted)) {
            assert!(off(found, wanted) < 1e-13);
        }
        assert!((found.c::<26>() - wanted.c::<26>()).amax() < 1e-13);
        assert!((found.d() - wanted.d()).amax() < 1e-13);
        macro_rules! read {
            ($space:expr, $state:expr, $h:expr) => {
                $space.linearise($state, [], |view| {
                    let (tail, nut) = (view.angular_velocity($h.tail), view.velocity($h.nut));
                    [
                        tail.x,
                        nut.y,
                        view.angle($h.thread),
                        view.velocity($h.tail).z,
                    ]
                })?
            };
        }
        let (found, wanted) = (read!(with, &one, h), read!(without, &two, g));
        let (found, wanted) = (found.c::<26>(), wanted.c::<26>());
        assert!((found - wanted).amax() < 1e-13 * wanted.amax());
        // Inputs move no body, but forces.
        let found = with.linearise(&one, [h.torque, h.push], |view| [view.power()])?;
        let wanted = without.linearise(&two, [g.torque, g.push], |view| [view.power()])?;
        let (found, wanted) = (found.d(), wanted.d());
        assert!(off(found.as_slice(), wanted.as_slice()) < 1e-13 && wanted.amax() > 1e-3);
    }
    Ok(())
}

/// The kernel is taken here: as many equations as rates that follow, and no weak pivot.
fn is_taken<M: JointRates, const N: usize>(
    space: &IndependentCoordinates<M, N>,
    state: &M::JointState<f64>,
    constants: &M::JointConstants<f64>,
) {
    let (rates, rows) = (M::JOINT_REPORT.motions.len(), M::JOINT_REPORT.closing.len());
    assert_eq!(rates, N + rows);
    let numbers = M::derivatives(constants, space.time(), state);
    let columns = 4 * rates + 3 * M::DERIVED_BY.map_or(0, <[usize]>::len);
    let pivots = &numbers.as_slice()[rates * (1 + columns)..];
    assert!(pivots.iter().all(|pivot| pivot.abs() > 1e-3), "{pivots:?}");
}

/// In a loop what is not chosen follows: its rates go with the positions.
#[test]
fn loops_and_drivers() -> Result<(), Fault> {
    let (a, b) = (Looped::new(0.3)?, PlainLooped::new(0.3)?);
    let (h, g) = (Looped::HANDLES, PlainLooped::HANDLES);
    assert_eq!(Looped::DERIVED_BY.map(<[usize]>::len), Some(3));
    // This is of trees.
    const { assert!(!Looped::HAS_FORWARD && Crawler::HAS_FORWARD) };
    for seed in 0..20 {
        let mut noise = noise(17 * seed);
        let q: [f64; 2] = from_fn(|_| 0.3 * noise());
        let v: [f64; 2] = from_fn(|_| 2.0 * noise());
        let inputs: [f64; 2] = from_fn(|_| 5.0 * noise());
        let time = 3.0 * noise();
        macro_rules! standing {
            ($mechanism:expr, $h:expr) => {{
                let mut space = $mechanism.coordinates(($h.motor_hinge, $h.other_hinge))?;
                space.set_time(time);
                for (handle, value) in [$h.torque, $h.wind].into_iter().zip(inputs) {
                    space.set_value(handle, value)?;
                }
                let state = space.state(q, v)?;
                (space, state)
            }};
        }
        let (with, one) = standing!(a, h);
        let (without, two) = standing!(b, g);
        let mut parameters = a.parameters()?;
        is_taken(&with, &one, &Looped::prepare_joints(&parameters));
        for (handle, value) in [h.torque, h.wind].into_iter().zip(inputs) {
            parameters.as_mut_slice()[handle.index()] = value;
        }
        weighed::<Looped>(&parameters, time, &one, &mut noise);
        compared(
            (&with, &one, [h.torque, h.wind, h.crank]),
            (&without, &two, [g.torque, g.wind, g.crank]),
        )?;
        // Readings of places, velocities and angular velocities, which go with the loops.
        macro_rules! read {
            ($space:expr, $state:expr, $h:expr) => {
                $space.linearise($state, [$h.torque, $h.crank], |view| {
                    let (turning, velocity) =
                        (view.angular_velocity($h.wide), view.velocity($h.weight));
                    [
                        view.position($h.upper).x,
                        velocity.z,
                        turning.z,
                        view.angle($h.knee),
                    ]
                })?
            };
        }
        let (found, wanted) = (read!(with, &one, h), read!(without, &two, g));
        let (found, wanted) = ((found.c::<4>(), found.d()), (wanted.c::<4>(), wanted.d()));
        assert!((found.0 - wanted.0).amax() < 1e-13 * wanted.0.amax());
        assert!((found.1 - wanted.1).amax() < 1e-13 * wanted.1.amax().max(1.0));
    }
    Ok(())
}

/// Numbers that carry derivatives are taken where the kernel would need what is not generated.
#[test]
fn a_spline_in_the_equation_of_a_joint() -> Result<(), Fault> {
    assert_eq!(Camshaft::DERIVED_BY, None);
    let (cam, h) = (Camshaft::default(), Camshaft::HANDLES);
    let space = cam.coordinates([h.hinge])?;
    let state = |angle: f64| space.state([angle], [3.0]);
    let found = space.linearise(&state(0.4)?, [], |_| [])?.by_positions[(0, 0)];
    let step = 1e-5;
    let near = [state(0.4 + step)?, state(0.4 - step)?];
    let [a, b] = near.map(|state| space.forward(&state, [0.0]));
    let wanted = (a?[0] - b?[0]) / (2.0 * step);
    assert!(
        (found - wanted).abs() < 1e-8 * wanted.abs(),
        "{found} {wanted}"
    );
    Ok(())
}

/// Angles (rad), rates (rad/s) and torques (N m) of `derivatives_reference.py`.
fn given<const N: usize>() -> [[f64; N]; 3] {
    [(0.3, 0.2), (0.5, -0.3), (2.0, -0.7)].map(|(first, step)| from_fn(|k| first + step * k as f64))
}

/// A matrix by its columns, against one by its rows.
fn same<const N: usize>(what: &str, found: &[f64], wanted: [[f64; N]; N]) {
    let columns: Vec<f64> = (0..N)
        .flat_map(|column| wanted.map(|row| row[column]))
        .collect();
    let off = off(found, &columns);
    assert!(off < 1e-12, "{what}: {off:e}");
}

/// An arm at the state of `derivatives_reference.py`, against matrices by positions, by rates and
/// by efforts. A motor is an effort along its axis.
fn arm<M, const N: usize>(
    mut space: IndependentCoordinates<M, N>,
    motors: [ValueHandle<M>; N],
    [positions, rates, efforts]: [[[f64; N]; N]; 3],
) -> Result<(), Fault>
where
    M: HasInverse + HasMassMatrix + Default,
{
    let [q, v, torques] = given();
    for (motor, torque) in motors.into_iter().zip(torques) {
        space.set_value(motor, torque)?;
    }
    let state = space.state(q, v)?;
    weighed::<M>(&M::default().parameters()?, 0.0, &state, noise(7));
    let linear = space.linearise(&state, motors, |_| [])?;
    same("positions", linear.by_positions.as_slice(), positions);
    same("rates", linear.by_rates.as_slice(), rates);
    same("efforts", linear.by_efforts.as_slice(), efforts);
    same("motors", linear.by_values.as_slice(), efforts);
    Ok(())
}

#[test]
fn arms_against_pinocchio() -> Result<(), Fault> {
    use pinocchio::{
        PANDA_BY_EFFORTS, PANDA_BY_POSITIONS, PANDA_BY_RATES, UR5_BY_EFFORTS, UR5_BY_POSITIONS,
        UR5_BY_RATES,
    };
    let h = Ur5::HANDLES;
    let joints = [h.pan, h.lift, h.elbow, h.wrist_1, h.wrist_2, h.wrist_3];
    let motors = [
        h.pan_torque,
        h.lift_torque,
        h.elbow_torque,
        h.wrist_1_torque,
        h.wrist_2_torque,
        h.wrist_3_torque,
    ];
    let wanted = [UR5_BY_POSITIONS, UR5_BY_RATES, UR5_BY_EFFORTS];
    arm(Ur5::default().coordinates(joints)?, motors, wanted)?;
    let h = Panda::HANDLES;
    let joints = [
        h.joint_1, h.joint_2, h.joint_3, h.joint_4, h.joint_5, h.joint_6, h.joint_7,
    ];
    let motors = [
        h.joint_1_torque,
        h.joint_2_torque,
        h.joint_3_torque,
        h.joint_4_torque,
        h.joint_5_torque,
        h.joint_6_torque,
        h.joint_7_torque,
    ];
    let wanted = [PANDA_BY_POSITIONS, PANDA_BY_RATES, PANDA_BY_EFFORTS];
    arm(Panda::default().coordinates(joints)?, motors, wanted)
}

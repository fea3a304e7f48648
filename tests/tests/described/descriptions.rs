//! The same runs in both descriptions: what moves by its joints moves as what is held by them.

mod open;

use holonom::forces::{SpringDamper, TorsionalActuator, TorsionalSpringDamper};
use holonom::joints::{
    Cylindrical, Fixed, Gear, Planar, PointOnLine, Prismatic, Revolute, Spherical, Universal,
};
use holonom::prelude::*;
use holonom::{
    JointCoordinates, ParameterError, SimulationError, StateParts, dynamics::Dynamics,
    error::Quantity, integrate::OneStep, state::Array,
};
use nalgebra::Vector3;

/// A cart with a boom, which carries a weight by a weld and a load by a cross and a ball; numbers
/// that are known at run time, springs, a motor.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.3, -9.81], coordinates = "joints")]
pub(crate) struct Crane {
    #[param]
    length: f64,
    #[param]
    mass: f64,
    #[input]
    moment: f64,
    #[body(mass = 4.0, inertia = [0.2, 0.3, 0.4], position = [0.1, 0.0, 0.1])]
    cart: Body,
    #[body(mass = mass, inertia = [0.1, 0.02, 0.11], position = [0.0, 0.5 * length, 0.2])]
    boom: Body,
    #[body(
        mass = 0.7,
        inertia = [[0.02, 0.001, 0.0], [0.001, 0.03, 0.002], [0.0, 0.002, 0.025]],
        position = [0.05, -0.3, 0.25]
    )]
    weight: Body,
    #[body(mass = 0.5, inertia = [0.03, 0.03, 0.002], position = [0.0, length, -0.3])]
    rod: Body,
    #[body(mass = 1.1, inertia = [0.04, 0.05, 0.06], position = [0.05, length, -1.0])]
    load: Body,
    #[joint(between = [cart, ground], point = [0.0, 0.0, 0.0], axis = [1.0, 0.2, 0.0])]
    rail: Prismatic,
    #[joint(between = [cart, boom], point = [0.0, 0.0, 0.2], axis = [1.0, 0.0, 0.0])]
    elbow: Revolute,
    #[joint(between = [boom, weight], point = [0.0, -0.2, 0.2])]
    weld: Fixed,
    #[joint(between = [boom, rod], point = [0.0, length, 0.2], axis_i = [1.0, 0.0, 0.0], axis_j = [0.0, 1.0, 0.0])]
    cardan: Universal,
    #[joint(between = [load, rod], point = [0.0, length, -0.8])]
    hook: Spherical,
    #[force(between = [cart, boom], axis = [1.0, 0.0, 0.0], stiffness = 60.0, damping = 0.4, free_angle = 0.2)]
    coil: TorsionalSpringDamper,
    #[force(between = [ground, cart], axis = [1.0, 0.0, 0.0], moment = moment - 0.1 * rate - 0.01 * angle)]
    lean: TorsionalActuator,
    #[force(between = [boom, cart], axis = [1.0, 0.0, 0.0], moment = moment - 0.1 * rate - 0.01 * angle)]
    motor: TorsionalActuator,
    #[force(between = [ground, rod], head = [0.4, 1.0, 0.5], tail = [0.0, length, -0.4], stiffness = 25.0, damping = 0.8, free_length = 0.5)]
    rope: SpringDamper,
}

impl Crane {
    pub(crate) fn driven() -> Result<Self, ParameterError> {
        let mut crane = Self::new(1.2, 2.0)?;
        crane.moment = 0.6;
        Ok(crane)
    }

    /// With every freedom in motion.
    pub(crate) fn start<S: holonom::Real>(&self) -> <Self as Mechanism>::State<S> {
        let mut state = self.described_state().expect("described");
        let handles = Self::HANDLES;
        let rolls = Vector3::new(0.5, 0.1, 0.0);
        for body in [
            handles.cart,
            handles.boom,
            handles.weight,
            handles.rod,
            handles.load,
        ] {
            Self::set_velocity(&mut state, body, rolls.map(S::constant));
        }
        let spin = Vector3::new(0.3, -0.4, 2.0);
        let swings = rolls + spin.cross(&Vector3::new(0.05, 0.0, -0.2));
        Self::set_angular_velocity_global(&mut state, handles.load, spin.map(S::constant));
        Self::set_velocity(&mut state, handles.load, swings.map(S::constant));
        state
    }
}

/// A box that slides and turns on a table with a bead on a wire and a rod through a sleeve; a
/// satellite with a wheel; nothing is held but by joints.
#[derive(Mechanism)]
#[mechanism(gravity = [0.5, 0.0, -0.2], coordinates = "joints")]
pub(crate) struct Loose {
    #[body(mass = 1.0, inertia = [0.1, 0.2, 0.25], position = [0.3, 0.2, 0.1])]
    puck: Body,
    #[body(mass = 0.2, position = [0.3, 0.2, 0.4])]
    bead: Particle,
    #[body(mass = 0.4, inertia = [0.02, 0.001, 0.02], position = [0.6, 0.5, 0.1])]
    piston: Body,
    #[body(mass = 5.0, inertia = [1.0, 1.3, 1.9], position = [0.0, 5.0, 0.0])]
    satellite: Body,
    #[body(mass = 0.8, inertia = [0.01, 0.01, 0.02], position = [0.1, 5.0, 0.3])]
    wheel: Body,
    #[joint(between = [ground, puck], point = [0.3, 0.2, 0.0], normal = [0.0, 0.0, 1.0])]
    table: Planar,
    #[joint(between = [puck, bead], point = [0.3, 0.2, 0.4], axis = [1.0, 1.0, 0.0])]
    wire: PointOnLine,
    #[joint(between = [puck, piston], point = [0.6, 0.2, 0.1], axis = [0.0, 1.0, 0.0])]
    sleeve: Cylindrical,
    #[joint(between = [satellite, wheel], point = [0.1, 5.0, 0.3], axis = [0.0, 0.6, 0.8])]
    bearing: Revolute,
    #[force(between = [puck, bead], head = [0.0, -0.1, 0.4], tail = [0.3, 0.2, 0.4], stiffness = 5.0, free_length = 0.3)]
    elastic: SpringDamper,
    #[force(between = [puck, piston], head = [0.6, -0.4, 0.1], tail = [0.6, 0.5, 0.1], stiffness = 8.0, damping = 0.1, free_length = 0.8)]
    bumper: SpringDamper,
    #[force(between = [puck, piston], axis = [0.0, 1.0, 0.0], stiffness = 0.01)]
    twist: TorsionalSpringDamper,
}

impl Loose {
    /// Corrected onto the constraints, so that every freedom is in motion.
    pub(crate) fn start(&self) -> <Self as Mechanism>::State<f64> {
        let mut state = self.described_state().expect("described");
        let handles = Self::HANDLES;
        let bodies = [
            handles.puck,
            handles.piston,
            handles.satellite,
            handles.wheel,
        ];
        for (place, body) in (0..).map(f64::from).zip(bodies) {
            let spin = Vector3::new(0.3 - 0.2 * place, 0.5 * place, 1.0 + place);
            Self::set_angular_velocity_global(&mut state, body, spin);
            Self::set_velocity(&mut state, body, Vector3::new(0.2, 0.1 * place, 0.05));
        }
        self.assemble(0.0, &mut state).expect("solvable");
        state
    }
}

/// A four-bar in the plane, whose joints are more than enough, with a gear on its crank; and a
/// spatial pendulum on its coupler.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints", redundant = "drop")]
pub(crate) struct FourBar {
    #[body(mass = 0.5, inertia = [0.02, 0.0005, 0.02], position = [0.0, 0.0, 0.2])]
    crank: Body,
    #[body(mass = 1.5, inertia = [0.1, 0.1, 0.002], position = [0.0, 0.5, 0.5])]
    coupler: Body,
    #[body(mass = 1.0, inertia = [0.06, 0.002, 0.06], position = [0.0, 1.0, 0.3])]
    rocker: Body,
    #[body(mass = 0.3, inertia = [0.01, 0.01, 0.001], position = [0.0, -0.3, 0.0])]
    pinion: Body,
    #[body(mass = 0.4, inertia = [0.005, 0.004, 0.003], position = [0.1, 0.5, 0.2])]
    bob: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    first: Revolute,
    #[joint(cut, between = [crank, coupler], point = [0.0, 0.0, 0.4], axis = [1.0, 0.0, 0.0])]
    second: Revolute,
    #[joint(between = [coupler, rocker], point = [0.0, 1.0, 0.6], axis = [1.0, 0.0, 0.0])]
    third: Revolute,
    #[joint(between = [rocker, ground], point = [0.0, 1.0, 0.0], axis = [1.0, 0.0, 0.0])]
    fourth: Revolute,
    #[joint(between = [ground, pinion], point = [0.0, -0.3, 0.0], axis = [1.0, 0.0, 0.0])]
    shaft: Revolute,
    #[joint(between = [crank, pinion, ground], axis_i = [1.0, 0.0, 0.0], axis_j = [1.0, 0.0, 0.0], ratio = -2.0)]
    mesh: Gear,
    #[joint(between = [coupler, bob], point = [0.0, 0.5, 0.5])]
    ball: Spherical,
    #[force(between = [ground, crank], axis = [1.0, 0.0, 0.0], moment = 2.0 - 0.1 * rate)]
    motor: TorsionalActuator,
}

fn tight() -> DormandPrince<f64> {
    DormandPrince::new(Tolerance {
        relative: 1e-11,
        absolute: 1e-12,
    })
}

/// Coordinates and velocities. Euler parameters of either sign are one orientation: those of one
/// state are given the sign of the other.
fn compare<M: Mechanism>(left: &M::State<f64>, right: &M::State<f64>) -> f64 {
    let mut worst = 0.0_f64;
    let (a, b) = (
        left.coordinates().as_slice(),
        right.coordinates().as_slice(),
    );
    for body in M::REPORT.bodies {
        let range =
            |of: &[f64], places: core::ops::Range<usize>| of.get(places).map(<[f64]>::to_vec);
        let place = body.coordinate;
        let positions = [a, b].map(|of| range(of, place..place + 3).expect("a position"));
        let [r, s] = positions;
        worst = r
            .iter()
            .zip(&s)
            .fold(worst, |worst, (r, s)| worst.max((r - s).abs()));
        if body.kind == holonom::mechanism::BodyKind::Rigid {
            let [p, q] = [a, b].map(|of| range(of, place + 3..place + 7).expect("an orientation"));
            let same: f64 = p.iter().zip(&q).map(|(p, q)| p * q).sum();
            let differences = p.iter().zip(&q).map(|(p, q)| (p - same.signum() * q).abs());
            worst = differences.fold(worst, f64::max);
        }
    }
    let behind = |of: &'_ [f64]| of.get(M::REPORT.coordinates..).map(<[f64]>::to_vec);
    let velocities = [left, right].map(|state| state.velocities().as_slice().to_vec());
    let angles = [a, b].map(|of| behind(of).expect("auxiliary variables"));
    for [left, right] in [velocities, angles] {
        let pairs = left.iter().zip(&right);
        worst = pairs.fold(worst, |worst, (l, r)| worst.max((l - r).abs()));
    }
    worst
}

type Observer<'a, M> = &'a mut dyn FnMut(&Sample<'_, f64, M>) -> ControlFlow<()>;

/// Compares the states of two runs at all reports, and what is read there.
fn compared<M: Mechanism>(
    (start, tolerance): (M::State<f64>, f64),
    read: impl Fn(&Sample<'_, f64, M>) -> Vec<f64>,
    by_bodies: impl FnOnce(Observer<'_, M>) -> RunResult<f64, M>,
    by_joints: impl FnOnce(Observer<'_, M>) -> RunResult<f64, M>,
) {
    let mut seen = Vec::new();
    let by_bodies = by_bodies(&mut |sample| {
        seen.push((*sample.state(), sample.energy(), read(sample)));
        ControlFlow::Continue(())
    });
    let by_bodies = by_bodies.expect("solvable");
    let mut place = 0;
    let by_joints = by_joints(&mut |sample| {
        let (state, energy, readings) = seen.get(place).expect("a report");
        place += 1;
        let (time, worst) = (sample.time(), compare::<M>(state, sample.state()));
        assert!(worst < tolerance, "{time} s: {worst:e}");
        let change = (energy - sample.energy()).abs();
        assert!(change < 10.0 * tolerance, "{time} s: {change:e} J");
        let here = read(sample);
        assert_eq!(here.len(), readings.len());
        for (number, (a, b)) in here.iter().zip(readings).enumerate() {
            let difference = (a - b).abs() / (1.0 + b.abs());
            assert!(
                difference < 100.0 * tolerance,
                "{time} s, reading {number}: {a} and {b}"
            );
        }
        ControlFlow::Continue(())
    });
    let by_joints = by_joints.expect("solvable");
    assert_eq!(place, seen.len());
    let moved = compare::<M>(&start, &by_joints.state);
    println!(
        "{}: {} and {} evaluations, {:?} and {:?}, moved by {moved}, violations {:e} and {:e}",
        M::REPORT.name,
        by_bodies.evaluations,
        by_joints.evaluations,
        by_bodies.iterations,
        by_joints.iterations,
        by_bodies.worst_violation,
        by_joints.worst_violation
    );
    assert!(moved > 0.1, "nothing is compared");
}

/// Runs in both descriptions and compares them.
pub(crate) fn both<M: JointCoordinates, F: Formulation<f64>>(
    mechanism: &M,
    method: F,
    start: M::State<f64>,
    tolerance: f64,
    read: impl Fn(&Sample<'_, f64, M>) -> Vec<f64>,
) {
    println!("{method:?}");
    let simulation = || Simulation::new(mechanism, method, tight()).initial_state(start);
    compared(
        (start, tolerance),
        read,
        |observe| {
            let by_bodies = simulation().absolute_coordinates();
            by_bodies.run(0.0..=1.0, every(0.1), observe)
        },
        |observe| {
            let by_joints = simulation().joint_coordinates();
            by_joints.run(0.0..=1.0, every(0.1), observe)
        },
    );
}

/// The same under forces of a closure.
pub(crate) fn both_under<M: JointCoordinates, F: Formulation<f64>>(
    mechanism: &M,
    method: F,
    start: M::State<f64>,
    law: impl Fn(f64, &M::State<f64>, &mut Loads<'_, f64, M>),
    read: impl Fn(&Sample<'_, f64, M>) -> Vec<f64>,
) {
    println!("{method:?}, with forces");
    let simulation = || Simulation::new(mechanism, method, tight()).initial_state(start);
    let free = simulation()
        .absolute_coordinates()
        .run(0.0..=1.0, every(1.0), |_| ControlFlow::Continue(()));
    let free = free.expect("solvable").state;
    compared(
        (start, 1e-7),
        read,
        |observe| {
            let report = simulation().forces(&law).absolute_coordinates().run(
                0.0..=1.0,
                every(0.1),
                observe,
            )?;
            assert!(compare::<M>(&free, &report.state) > 0.1, "they do nothing");
            Ok(report)
        },
        |observe| {
            // In either order.
            let before = simulation().forces(&law).joint_coordinates();
            let report = before.run(0.0..=1.0, every(0.1), observe)?;
            let behind = simulation().joint_coordinates().forces(&law);
            let again = behind.run(0.0..=1.0, every(0.1), |_| ControlFlow::Continue(()))?;
            assert_eq!(report.state, again.state);
            Ok(report)
        },
    );
}

/// Forces and moments of a joint on its last body.
pub(crate) fn reaction<M: Mechanism, J>(
    sample: &Sample<'_, f64, M>,
    joint: holonom::JointHandle<M, J>,
    body: holonom::BodyHandle<M>,
) -> [f64; 6] {
    let reaction = sample.reaction(joint, body).expect("between these bodies");
    let (f, m) = (reaction.force, reaction.moment);
    [f.x, f.y, f.z, m.x, m.y, m.z]
}

#[test]
fn a_crane_with_parameters_inputs_and_springs() {
    let crane = Crane::driven().expect("acceptable");
    assert!(Crane::JOINT_REPORT.closing.is_empty());
    let handles = Crane::HANDLES;
    let read = |sample: &Sample<'_, f64, Crane>| {
        let mut values = vec![
            sample.angle(handles.elbow),
            sample.angle_rate(handles.elbow),
            sample.displacement(handles.rail),
            sample.displacement_rate(handles.rail),
            sample.power(),
            sample.kinetic_energy(),
        ];
        values.extend(reaction(sample, handles.rail, handles.cart));
        values.extend(reaction(sample, handles.elbow, handles.boom));
        values.extend(reaction(sample, handles.weld, handles.weight));
        values.extend(reaction(sample, handles.cardan, handles.rod));
        values.extend(reaction(sample, handles.hook, handles.load));
        values
    };
    let start = crane.start();
    both(&crane, StandardLagrange, start, 1e-7, read);
    both(&crane, Baumgarte::default(), start, 1e-7, read);
    // Nothing is left to iterate on.
    both(&crane, AugmentedLagrangian::default(), start, 1e-6, read);
    let law = |time: f64, state: &_, loads: &mut Loads<'_, f64, Crane>| {
        let drag: Vector3<f64> = Crane::velocity(state, handles.load) * -3.0;
        loads.force(handles.load, drag.into());
        loads.force_at(handles.boom, [0.0, 0.6, 0.1], [0.0, 2.0, 20.0 * time]);
        loads.moment(handles.rod, [0.3, -0.2, 0.1]);
        loads.moment_in_body_axes(handles.weight, [0.5, 0.2, -0.1]);
        loads.force(handles.cart, [4.0, 1.0, 0.0]);
    };
    both_under(&crane, StandardLagrange, start, law, read);
}

#[test]
fn planes_wires_sleeves_and_free_bodies() {
    let loose = Loose::default();
    assert!(Loose::JOINT_REPORT.closing.is_empty());
    let handles = Loose::HANDLES;
    let start = loose.start();
    let read = |sample: &Sample<'_, f64, Loose>| {
        let mut values = vec![
            sample.angle(handles.sleeve),
            sample.displacement(handles.sleeve),
            sample.displacement(handles.wire),
            sample.angle(handles.bearing),
            sample.angle_rate(handles.bearing),
        ];
        values.extend(reaction(sample, handles.table, handles.puck));
        values.extend(reaction(sample, handles.bearing, handles.wheel));
        values
    };
    both(&loose, StandardLagrange, start, 1e-7, read);
    let law = |_: f64, state: &_, loads: &mut Loads<'_, f64, Loose>| {
        let drag: Vector3<f64> = Loose::velocity(state, handles.bead) * -0.3;
        loads.force(handles.bead, drag.into());
        loads.force_at(handles.puck, [0.1, 0.0, 0.0], [0.0, 1.0, 0.2]);
        loads.moment(handles.wheel, [0.0, 0.1, 0.3]);
        loads.force_at(handles.satellite, [0.5, 0.0, 0.1], [1.0, 2.0, -1.0]);
        loads.moment_in_body_axes(handles.piston, [0.0, 0.004, 0.0]);
    };
    both_under(&loose, Baumgarte::default(), start, law, read);
}

#[test]
fn loops_with_equations_too_many() {
    let bars = FourBar::default();
    // `third` would close the loop, had `second` not been cut.
    assert_eq!(FourBar::JOINT_REPORT.closing, ["second", "second", "mesh"]);
    let handles = FourBar::HANDLES;
    let read = |sample: &Sample<'_, f64, FourBar>| {
        let angles = [handles.first, handles.second, handles.third, handles.fourth];
        let mut values: Vec<f64> = angles.map(|joint| sample.angle(joint)).into();
        values.extend(angles.map(|joint| sample.angle_rate(joint)));
        // In the plane of the motion, where all that is determined.
        let [_, y, z, ..] = reaction(sample, handles.first, handles.crank);
        values.extend([y, z]);
        values.extend(reaction(sample, handles.ball, handles.bob));
        values
    };
    let start = bars.described_state().expect("described");
    both(&bars, StandardLagrange, start, 1e-7, read);
    both(&bars, Baumgarte::default(), start, 1e-7, read);
    let augmented = AugmentedLagrangian::default();
    both(&bars, augmented, start, 1e-6, read);
    let law = |time: f64, state: &_, loads: &mut Loads<'_, f64, FourBar>| {
        let drag: Vector3<f64> = FourBar::velocity(state, handles.bob) * -0.5;
        loads.force(handles.bob, drag.into());
        loads.force_at(handles.coupler, [0.0, 0.2, 0.1], [0.5, 3.0, 6.0 * time]);
        loads.moment(handles.pinion, [0.4, 0.0, 0.0]);
    };
    both_under(&bars, StandardLagrange, start, law, read);
    both_under(&bars, Baumgarte::default(), start, law, read);
    both_under(&bars, augmented, start, law, read);
    // Joints of the tree do not yield: what is compared is the limit of a stiff penalty.
    both(&bars, Penalty::new(1e9, 10.0, 1.0), start, 1e-4, read);
}

#[test]
fn single_precision_in_both_descriptions() {
    let crane = Crane::driven().expect("acceptable");
    let start = crane.start::<f32>();
    let simulation =
        || Simulation::new(&crane, StandardLagrange, Rk4::every(2e-3_f32)).initial_state(start);
    let ignore = |_: &Sample<'_, f32, Crane>| ControlFlow::Continue(());
    let by_bodies = simulation()
        .absolute_coordinates()
        .run(0.0..=1.0, every(1.0), ignore);
    let by_joints = simulation()
        .joint_coordinates()
        .run(0.0..=1.0, every(1.0), ignore);
    let [by_bodies, by_joints] =
        [by_bodies, by_joints].map(|report| report.expect("solvable").state);
    let handles = Crane::HANDLES;
    for body in [handles.cart, handles.boom, handles.rod, handles.load] {
        let [a, b] = [by_bodies, by_joints].map(|state| {
            let pose = Crane::pose(&state, body);
            (pose.position, Crane::velocity(&state, body))
        });
        let (position, velocity) = ((a.0 - b.0).norm(), (a.1 - b.1).norm());
        println!("{}: {position:e} m, {velocity:e} m/s", body.name());
        // Round-off of 500 steps, which the motion of a double pendulum magnifies.
        assert!(position < 1e-3 && velocity < 1e-2);
    }
}

/// What a stage takes is what an evaluation gives, which has the multipliers besides.
fn stages<M: JointCoordinates, F: Formulation<f64>>(mechanism: &M, formulation: F, step: f64) {
    use holonom::integrate::System;
    let mut dynamics = Dynamics::<Problem<_, _>>::new(mechanism, formulation)
        .expect("acceptable")
        .joint_coordinates();
    let mut state = dynamics.initial_state().expect("consistent");
    for number in 0..50 {
        let time = step * f64::from(number);
        let (evaluation, _) = dynamics.evaluate(time, &state).expect("regular");
        let rates = dynamics.rates(time, &state).expect("regular");
        assert_eq!(rates, evaluation.rates);
        let multipliers = evaluation.multipliers.as_slice();
        assert!(!multipliers.is_empty() && multipliers.iter().any(|x| x.abs() > 1e-6));
        Rk4.step(&mut dynamics, time, &mut state, step)
            .expect("regular");
    }
}

#[test]
fn a_stage_computes_what_an_evaluation_does() {
    let bars = FourBar::default();
    stages(&bars, StandardLagrange, 2e-3);
    stages(&bars, Baumgarte::default(), 2e-3);
    stages(&bars, Penalty::default(), 2e-3);
    stages(&bars, AugmentedLagrangian::default(), 2e-3);
    let linkage = holonom_models::SqueezingMechanism::default();
    stages(&linkage, StandardLagrange, 1e-5);
    stages(&linkage, Baumgarte::default(), 1e-5);
}

/// Both descriptions step on from where the other one is.
#[test]
fn descriptions_take_turns() {
    let loose = Loose::default();
    let start = loose.start();
    let mut joints = Dynamics::<Problem<_, _>>::new(&loose, StandardLagrange)
        .expect("acceptable")
        .joint_coordinates();
    let mut bodies = holonom::dynamics::Dynamics::<Problem<_, _>>::new(&loose, StandardLagrange)
        .expect("acceptable")
        .absolute_coordinates();
    let mut alone = joints.state_of(&start).expect("consistent");
    let mut state = start;
    let step = 1e-3;
    for turn in 0..10 {
        for number in 0..50 {
            let time = step * f64::from(100 * turn + number);
            Rk4.step(&mut bodies, time, &mut state, step)
                .expect("solvable");
        }
        let mut other = joints.state_of(&state).expect("consistent");
        for number in 50..100 {
            let time = step * f64::from(100 * turn + number);
            Rk4.step(&mut joints, time, &mut other, step)
                .expect("solvable");
        }
        state = joints.bodies(&other);
        for number in 0..100 {
            let time = step * f64::from(100 * turn + number);
            Rk4.step(&mut joints, time, &mut alone, step)
                .expect("solvable");
        }
    }
    let worst = compare::<Loose>(&joints.bodies(&alone), &state);
    println!("{worst:e}");
    assert!(worst < 1e-7, "{worst:e}");
}

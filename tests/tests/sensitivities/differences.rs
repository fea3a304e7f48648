//! Derivatives against differences of whole runs with the same steps.

use holonom::formulation::Formulation;
use holonom::independent::{Chosen, Direction};
use holonom::mechanism::JointRates;
use holonom::prelude::*;
use holonom::sensitivity::Differentiable;
use holonom::state::Array as _;
use holonom::{Forward, Real};
use holonom_models::{Bricard, CartPole, FourBar, SliderCrank, Ur5};

/// Of a derivative, relative to the largest of its reading.
const LIMIT: f64 = 1e-6;

/// A double pendulum with lengths, a mass and a damper as parameters.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Arm {
    #[param]
    upper_length: f64,
    #[param]
    lower_length: f64,
    #[param]
    mass: f64,
    #[param]
    damping: f64,
    #[body(mass = 1.3, inertia = [0.2, 0.2, 0.01], position = [0.0, 0.5 * upper_length, 0.0])]
    upper: Body,
    #[body(
        mass = mass,
        inertia = [0.1, 0.01, 0.1],
        position = [0.0, upper_length + 0.5 * lower_length, 0.0],
        angular_velocity = [0.4, 0.0, 0.0],
        velocity = [0.0, 0.0, 0.2 * lower_length]
    )]
    lower: Body,
    #[joint(between = [ground, upper], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    shoulder: Revolute,
    #[joint(between = [upper, lower], point = [0.0, upper_length, 0.0], axis = [1.0, 0.0, 0.0])]
    elbow: Revolute,
    #[force(between = [upper, lower], axis = [1.0, 0.0, 0.0], stiffness = 0.5, damping = damping)]
    bush: TorsionalSpringDamper,
}

const VALUES: [f64; 4] = [1.0, 0.8, 0.9, 0.3];

/// What is read: an angle, a rate, a position and a reaction.
fn read<S: Real>(sample: &Sample<'_, S, Arm>) -> [S; 4] {
    let h = Arm::HANDLES;
    let reaction = sample.reaction(h.elbow, h.lower);
    let force = reaction.map_or(S::constant(f64::NAN), |wrench| wrench.force.z);
    [
        sample.angle(h.elbow),
        sample.angle_rate(h.shoulder),
        sample.position(h.lower).z,
        force,
    ]
}

/// The last readings of a run of two seconds.
fn plain<F: Formulation<f64>>(
    values: [f64; 4],
    formulation: F,
    is_by_joints: bool,
) -> Result<[f64; 4], Box<dyn std::error::Error>> {
    let [a, b, c, d] = values;
    let arm = Arm::new(a, b, c, d)?;
    let simulation = arm.simulation(formulation, Rk4::every(5e-3));
    let mut last = [0.0; 4];
    let mut observe = |sample: &Sample<'_, f64, Arm>| last = read(sample);
    if is_by_joints {
        let _ = simulation
            .joint_coordinates()
            .run(0.0..=2.0, every(1.0), &mut observe)?;
    } else {
        let _ = simulation.run(0.0..=2.0, every(1.0), &mut observe)?;
    }
    Ok(last)
}

fn by_parameters<F>(
    formulation: F,
    is_by_joints: bool,
    limit: f64,
) -> Result<(), Box<dyn std::error::Error>>
where
    F: Formulation<f64> + Differentiable<f64, 4, Carrying: Formulation<Forward<f64, 4>>>,
{
    let ([a, b, c, d], h) = (VALUES, Arm::HANDLES);
    let arm = Arm::new(a, b, c, d)?;
    let handles = [h.upper_length, h.lower_length, h.mass, h.damping];
    let along = arm.sensitivities(handles)?;
    let mut last = [Forward::fixed(0.0); 4];
    let simulation = along.simulation(formulation, Rk4::every(5e-3));
    let mut observe = |sample: &Sample<'_, Forward<f64, 4>, Arm>| last = read(sample);
    if is_by_joints {
        let _ = simulation
            .joint_coordinates()
            .run(0.0..=2.0, every(1.0), &mut observe)?;
    } else {
        let _ = simulation.run(0.0..=2.0, every(1.0), &mut observe)?;
    }
    let here = plain(VALUES, formulation, is_by_joints)?;
    for (number, here) in last.iter().zip(here) {
        assert!((number.value() - here).abs() < 1e-12 * (1.0 + here.abs()));
    }
    for direction in 0..4 {
        // Of fourth order.
        let step = 1e-3 * VALUES[direction];
        let at = |by: f64| {
            let mut values = VALUES;
            values[direction] += by * step;
            plain(values, formulation, is_by_joints)
        };
        let [far, before, after, beyond] = [at(-2.0)?, at(-1.0)?, at(1.0)?, at(2.0)?];
        for reading in 0..4 {
            let near = 8.0 * (after[reading] - before[reading]);
            let wanted = (near - (beyond[reading] - far[reading])) / (12.0 * step);
            let found = last[reading].derivatives();
            let size = found
                .iter()
                .fold(1.0_f64, |most, slope| most.max(slope.abs()));
            assert!(
                (found[direction] - wanted).abs() < limit * size,
                "reading {reading} by {direction}: {} for {wanted}",
                found[direction]
            );
        }
    }
    Ok(())
}

#[test]
fn of_every_formulation_by_parameters() -> Result<(), Box<dyn std::error::Error>> {
    by_parameters(StandardLagrange, true, LIMIT)?;
    by_parameters(StandardLagrange, false, LIMIT)?;
    by_parameters(Baumgarte::new(10.0, 10.0), false, LIMIT)?;
    by_parameters(Penalty::new(1e5, 10.0, 1.0), false, LIMIT)?;
    by_parameters(AugmentedLagrangian::new(1e5, 10.0, 1.0), false, LIMIT)
}

/// Derivatives of all numbers of the bodies by the first coordinate and the last rate of a start.
fn by_start<M, const N: usize>(
    mechanism: &M,
    chosen: impl Chosen<M, N>,
    [first, last]: [Direction<M>; 2],
    [positions, rates]: [[f64; N]; 2],
) -> Result<(), Box<dyn std::error::Error>>
where
    M: JointRates,
{
    let space = mechanism.coordinates(chosen)?;
    let start = space.state(positions, rates)?;
    let mut found = Vec::new();
    space
        .sensitivities(&start, [first, last])?
        .simulation(StandardLagrange, Rk4::every(1e-3))
        .joint_coordinates()
        .run(0.0..=0.3, every(0.3), |sample| {
            found = numbers(sample.state())
        })?;
    let end = |positions: [f64; N], rates: [f64; N]| {
        let there = space.state_near(&start, positions, rates)?;
        let mut end = Vec::new();
        mechanism
            .simulation(StandardLagrange, Rk4::every(1e-3))
            .joint_coordinates()
            .initial_state(space.bodies(&there))
            .run(0.0..=0.3, every(0.3), |sample| {
                end = numbers(sample.state())
            })?;
        Ok::<_, Box<dyn std::error::Error>>(end)
    };
    let here = end(positions, rates)?;
    for (found, here) in found.iter().zip(&here) {
        assert!((found.value() - here).abs() < 1e-10 * (1.0 + here.abs()));
    }
    let step = 1e-4;
    let at = |direction: usize, by: f64| {
        let (mut positions, mut rates) = (positions, rates);
        if direction == 0 {
            positions[0] += by * step;
        } else {
            rates[N - 1] += by * step;
        }
        end(positions, rates)
    };
    for direction in 0..2 {
        let ends = [-2.0, -1.0, 1.0, 2.0].map(|by| at(direction, by));
        let [far, before, after, beyond] = ends;
        let (far, before, after, beyond) = (far?, before?, after?, beyond?);
        let slope = |number: &Forward<f64, 2>| number.derivatives()[direction];
        let size = found
            .iter()
            .map(slope)
            .fold(1.0_f64, |most, slope| most.max(slope.abs()));
        for (place, number) in found.iter().enumerate() {
            let near = 8.0 * (after[place] - before[place]);
            let wanted = (near - (beyond[place] - far[place])) / (12.0 * step);
            assert!(
                (slope(number) - wanted).abs() < LIMIT * size,
                "{}, number {place} by {direction}: {} for {wanted}",
                M::REPORT.name,
                slope(number)
            );
        }
    }
    Ok(())
}

fn numbers<S: Real, X: StateParts<S>>(state: &X) -> Vec<S> {
    let coordinates = state.coordinates().as_slice().iter();
    coordinates
        .chain(state.velocities().as_slice())
        .copied()
        .collect()
}

#[test]
fn of_trees_and_loops_by_the_start() -> Result<(), Box<dyn std::error::Error>> {
    let h = FourBar::HANDLES;
    let ends = [
        Direction::position(h.left_foot),
        Direction::rate(h.left_foot),
    ];
    by_start(&FourBar::default(), [h.left_foot], ends, [[0.4], [2.0]])?;
    by_start(&FourBar::default(), [h.left_foot], ends, [[0.0], [2.0]])?;
    let h = SliderCrank::HANDLES;
    let ends = [Direction::position(h.bearing), Direction::rate(h.bearing)];
    by_start(&SliderCrank::default(), [h.bearing], ends, [[0.7], [9.0]])?;
    let h = Bricard::HANDLES;
    let ends = [Direction::position(h.p1), Direction::rate(h.p1)];
    by_start(&Bricard::default(), [h.p1], ends, [[0.2], [1.5]])?;
    let h = CartPole::HANDLES;
    let ends = [Direction::position(h.rail), Direction::rate(h.hinge)];
    by_start(
        &CartPole::default(),
        (h.rail, h.hinge),
        ends,
        [[0.2, 0.9], [1.0, -2.0]],
    )?;
    let h = Ur5::HANDLES;
    let arm = [h.pan, h.lift, h.elbow, h.wrist_1, h.wrist_2, h.wrist_3];
    let ends = [Direction::position(h.pan), Direction::rate(h.wrist_3)];
    let start = [
        [0.3, -0.8, 1.1, 0.4, -0.7, 2.0],
        [0.5, -1.0, 0.7, 1.5, -0.2, 0.9],
    ];
    by_start(&Ur5::default(), arm, ends, start)
}

/// A slider-crank with its lengths as parameters.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(
    gravity = [0.0, -9.81, 0.0],
    redundant = "drop",
    coordinates = "joints",
    kernels = [mass, inverse]
)]
struct Engine {
    #[param(like = 0.1)]
    crank: f64,
    #[param(like = 0.4)]
    rod: f64,
    #[input]
    gas: f64,
    #[body(mass = 1.0, inertia = [0.01, 0.01, 0.01], position = [0.5 * crank, 0.0, 0.0])]
    web: Body,
    #[body(mass = 0.5, inertia = [0.001, 0.02, 0.02], position = [crank + 0.5 * rod, 0.0, 0.0])]
    link: Body,
    #[body(mass = 0.4, inertia = [0.001, 0.001, 0.001], position = [crank + rod, 0.0, 0.0])]
    piston: Body,
    #[joint(between = [ground, web], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    main: Revolute,
    #[joint(between = [web, link], point = [crank, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    pin: Revolute,
    #[joint(between = [link, piston], point = [crank + rod, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    wrist: Revolute,
    #[joint(between = [ground, piston], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    bore: Prismatic,
    #[force(between = [ground, piston], point = [crank + rod, 0.0, 0.0], force = [gas, 0.0, 0.0])]
    pressure: PointForce,
}

/// A loop by two lengths and an input: the crank keeps its start, and the others follow.
#[test]
fn of_a_loop_by_lengths() -> Result<(), Box<dyn std::error::Error>> {
    let (values, h) = ([0.1, 0.4, -30.0], Engine::HANDLES);
    let made = |[crank, rod, gas]: [f64; 3]| {
        let mut engine = Engine::new(crank, rod)?;
        engine.gas = gas;
        let mut space = engine.coordinates([h.main])?;
        space.set_inputs(&engine.inputs())?;
        let start = space.state([0.5], [12.0])?;
        Ok::<_, Fault>((engine, space, start))
    };
    let (_, space, start) = made(values)?;
    let directions = [h.crank, h.rod, h.gas].map(Direction::value);
    let along = space.sensitivities(&start, directions)?;
    let mut found = Vec::new();
    along
        .simulation(StandardLagrange, Rk4::every(1e-3))
        .run(0.0..=0.3, every(0.3), |sample| {
            found = numbers(sample.state())
        })?;
    let mut of_bodies = Vec::new();
    along
        .simulation(StandardLagrange, Rk4::every(1e-3))
        .absolute_coordinates()
        .run(0.0..=0.3, every(0.3), |sample| {
            of_bodies = numbers(sample.state())
        })?;
    let end = |direction: usize, by: f64| {
        let mut values = values;
        values[direction] += by * step(direction);
        let (engine, space, start) = made(values)?;
        let mut end = Vec::new();
        engine
            .simulation(StandardLagrange, Rk4::every(1e-3))
            .initial_state(space.bodies(&start))
            .run(0.0..=0.3, every(0.3), |sample| {
                end = numbers(sample.state())
            })?;
        Ok::<_, Box<dyn std::error::Error>>(end)
    };
    for direction in 0..3 {
        let [far, before, after, beyond] = [-2.0, -1.0, 1.0, 2.0].map(|by| end(direction, by));
        let (far, before, after, beyond) = (far?, before?, after?, beyond?);
        let slope = |number: &Forward<f64, 3>| number.derivatives()[direction];
        let size = found
            .iter()
            .map(slope)
            .fold(0.0_f64, |most, slope| most.max(slope.abs()));
        for (place, (number, of_bodies)) in found.iter().zip(&of_bodies).enumerate() {
            let near = 8.0 * (after[place] - before[place]);
            let wanted = (near - (beyond[place] - far[place])) / (12.0 * step(direction));
            assert!(
                (slope(number) - wanted).abs() < LIMIT * size,
                "number {place} by {direction}: {} for {wanted}",
                slope(number)
            );
            // Another method: its steps are those of other numbers.
            assert!((slope(of_bodies) - slope(number)).abs() < 1e-4 * size);
        }
    }
    Ok(())
}

const fn step(direction: usize) -> f64 {
    [1e-4, 4e-4, 1e-1][direction]
}

//! Mechanisms of any size, any mass and at any place: what counts as corrected follows them.

use core::fmt::Debug;

use holonom::error::StepFault;
use holonom::joints::{AngleDriver, Distance, PointOnPlane, Revolute, Spherical};
use holonom::prelude::*;
use holonom::{Fault, Mechanism, Real, Sample, StateParts, dynamics::Dynamics, state::Array};

/// A thin rod on a hinge at the distance `place` from the origin, along x and z.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Hinged {
    #[param]
    length: f64,
    #[param]
    mass: f64,
    #[param]
    place: f64,
    #[body(
        mass = mass,
        inertia = [mass * length * length / 12.0, 1e-3 * mass * length * length, mass * length * length / 12.0],
        position = [place, 0.5 * length, place]
    )]
    rod: Body,
    #[joint(between = [ground, rod], point = [place, 0.0, place], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
}

/// A particle on a massless link.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Linked {
    #[param]
    length: f64,
    #[param]
    mass: f64,
    #[param]
    place: f64,
    #[body(mass = mass, position = [place, length, place])]
    bob: Particle,
    #[joint(
        between = [ground, bob],
        head = [place, 0.0, place],
        tail = [place, length, place],
        length = length
    )]
    link: Distance,
    #[joint(between = [ground, bob], point = [place, length, place], normal = [1.0, 0.0, 0.0])]
    plane: PointOnPlane,
}

/// A slider-crank with a motor: a crank of 3 and a rod of 5 parts, whose end stays at the height of
/// the crank's hinge.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct SliderCrank {
    #[param]
    length: f64,
    #[param]
    mass: f64,
    #[param]
    place: f64,
    #[param]
    speed: f64,
    #[body(
        mass = mass,
        inertia = [0.75 * mass * length * length, 0.75 * mass * length * length, 0.01 * mass * length * length],
        position = [place, 0.0, place + 1.5 * length],
        velocity = [0.0, -1.5 * speed * length, 0.0],
        angular_velocity = [speed, 0.0, 0.0]
    )]
    crank: Body,
    #[body(
        mass = mass,
        inertia = [2.0 * mass * length * length, mass * length * length, mass * length * length],
        position = [place, 2.0 * length, place + 1.5 * length],
        velocity = [0.0, -3.0 * speed * length, 0.0]
    )]
    rod: Body,
    #[joint(between = [ground, crank], point = [place, 0.0, place], axis = [1.0, 0.0, 0.0])]
    a: Revolute,
    #[joint(between = [crank, rod], point = [place, 0.0, place + 3.0 * length], axis = [1.0, 0.0, 0.0])]
    b: Revolute,
    #[joint(between = [ground, rod], point = [place, 4.0 * length, place], normal = [0.0, 0.0, 1.0])]
    slider: PointOnPlane,
    #[joint(between = [ground, crank], axis = [1.0, 0.0, 0.0], motion = speed * time)]
    motor: AngleDriver,
}

/// Two rods one below the other, the second lighter by a factor.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Double {
    #[param]
    length: f64,
    #[param]
    mass: f64,
    #[param]
    place: f64,
    #[param]
    ratio: f64,
    #[body(
        mass = mass,
        inertia = [mass * length * length / 12.0, 1e-3 * mass * length * length, mass * length * length / 12.0],
        position = [place, 0.5 * length, place]
    )]
    upper: Body,
    #[body(
        mass = ratio * mass,
        inertia = [ratio * mass * length * length / 12.0, 1e-3 * ratio * mass * length * length, ratio * mass * length * length / 12.0],
        position = [place, 1.5 * length, place]
    )]
    lower: Body,
    #[joint(between = [ground, upper], point = [place, 0.0, place], axis = [1.0, 0.0, 0.0])]
    a: Revolute,
    #[joint(between = [upper, lower], point = [place, length, place], axis = [1.0, 0.0, 0.0])]
    b: Revolute,
}

/// Sizes (m), masses (kg), distances from the origin (m).
const LENGTHS: [f64; 4] = [1e-6, 1e-3, 1.0, 1e3];
const MASSES: [f64; 3] = [1e-6, 1.0, 1e6];
const PLACES: [f64; 3] = [0.0, 1e3, 1e6];

/// All combinations of which the digits of a place resolve the length to a hundredth at least.
fn sweep<S: Real>(mut case: impl FnMut(f64, f64, f64, f64)) {
    for length in LENGTHS {
        for mass in MASSES {
            for place in PLACES {
                let resolved = S::EPSILON.to_f64() * (1.0 + place / length);
                if resolved < 1e-4 {
                    case(length, mass, place, resolved);
                }
            }
        }
    }
}

/// Displaces every body by a part of a length, turns it a little, and gives it some velocity.
fn disturbed<S: Real, M: Mechanism>(mechanism: &M, length: f64, part: f64) -> M::State<S> {
    let mut state = mechanism.described_state::<S>().expect("described");
    let sign = |place: usize| (place as f64 * 0.618_033_988_749_895 % 1.0 - 0.5) * part;
    for (body, info) in M::REPORT.bodies.iter().enumerate() {
        let rigid = info.kind == holonom::mechanism::BodyKind::Rigid;
        for k in 0..if rigid { 7 } else { 3 } {
            let size = if k < 3 { length } else { 1.0 };
            let place = &mut state.coordinates_mut().as_mut_slice()[info.coordinate + k];
            *place = *place + S::constant(size * sign(7 * body + k + 1));
        }
        let rate = (9.81 / length).sqrt();
        for k in 0..if rigid { 6 } else { 3 } {
            let size = if k < 3 { length * rate } else { rate };
            let place = &mut state.velocities_mut().as_mut_slice()[info.velocity + k];
            *place = *place + S::constant(size * sign(6 * body + k + 4));
        }
    }
    state
}

/// The largest violation of a state, with rows of equal kind made relative: `size` is that of a row
/// by its number.
fn violation<S: Real, M: Mechanism>(
    mechanism: &M,
    time: f64,
    state: &M::State<S>,
    size: impl Fn(usize) -> f64,
) -> f64 {
    let constants = mechanism.constants::<S>().expect("acceptable");
    let phi = M::constraints(&constants, S::constant(time), state);
    let rows = phi.as_slice().iter().enumerate();
    rows.fold(0.0, |worst, (row, phi)| {
        worst.max(phi.to_f64().abs() / size(row))
    })
}

/// A hinge: three rows in metres, two without a unit.
fn hinge(length: f64) -> impl Fn(usize) -> f64 {
    move |row| if row % 5 < 3 { length } else { 1.0 }
}

fn assembles<S: Real, M: Mechanism>(
    mechanism: &M,
    length: f64,
    resolved: f64,
    size: impl Fn(usize) -> f64,
) {
    let mut state = disturbed::<S, M>(mechanism, length, 0.05);
    let told = mechanism.assemble(S::zero(), &mut state);
    let told = told.unwrap_or_else(|fault| panic!("{} of {length} m: {fault}", M::REPORT.name));
    assert!(told.iterations > 0);
    let left = violation::<S, M>(mechanism, 0.0, &state, size);
    assert!(
        left <= 20.0 * resolved,
        "{} of {length} m: {left:e}, {resolved:e}",
        M::REPORT.name
    );
}

fn all_assemble<S: Real>() {
    sweep::<S>(|length, mass, place, resolved| {
        let hinged = Hinged::new(length, mass, place).expect("acceptable");
        assembles::<S, _>(&hinged, length, resolved, hinge(length));
        let linked = Linked::new(length, mass, place).expect("acceptable");
        assembles::<S, _>(&linked, length, resolved, |row| {
            [length * length, length][row]
        });
        let crank =
            SliderCrank::new(length, mass, place, (9.81 / length).sqrt()).expect("acceptable");
        let size = |row| {
            if row < 10 {
                hinge(length)(row)
            } else {
                [length, 1.0][row - 10]
            }
        };
        assembles::<S, _>(&crank, length, 5.0 * resolved, size);
        for ratio in [1e-9, 1.0] {
            let double = Double::new(length, mass, place, ratio).expect("acceptable");
            assembles::<S, _>(&double, length, 2.0 * resolved, hinge(length));
        }
    });
}

#[test]
fn mechanisms_of_any_size_mass_and_place_assemble() {
    all_assemble::<f64>();
}

#[test]
fn mechanisms_of_any_size_mass_and_place_assemble_in_single_precision() {
    all_assemble::<f32>();
}

/// The angle of a hinge after one and a half units of time `sqrt(length / g)`, with a projection
/// after every step.
fn swung<S: Real, M: Mechanism>(
    mechanism: &M,
    length: f64,
    angle: impl Fn(&Sample<'_, S, M>) -> S,
) -> Result<f64, String> {
    let unit = (length / 9.81).sqrt();
    let mut reached = f64::NAN;
    Simulation::new(
        mechanism,
        StandardLagrange,
        Rk4::every(S::constant(0.01 * unit)),
    )
    .projection(Projection::default())
    .run(
        S::zero()..=S::constant(1.5 * unit),
        every_step(),
        |sample| {
            reached = angle(sample).to_f64();
            ControlFlow::Continue(())
        },
    )
    .map_err(|error| error.to_string())?;
    Ok(reached)
}

fn all_swing<S: Real>() {
    let hinged = |length, mass, place| {
        let model = Hinged::new(length, mass, place).expect("acceptable");
        swung::<S, _>(&model, length, |sample| sample.angle(Hinged::HANDLES.pivot))
    };
    let double = |length, mass, place| {
        let model = Double::new(length, mass, place, 1e-9).expect("acceptable");
        swung::<S, _>(&model, length, |sample| sample.angle(Double::HANDLES.a))
    };
    let wanted =
        [hinged(1.0, 1.0, 0.0), double(1.0, 1.0, 0.0)].map(|angle| angle.expect("regular"));
    sweep::<S>(|length, mass, place, resolved| {
        for (wanted, angle) in wanted
            .iter()
            .zip([hinged(length, mass, place), double(length, mass, place)])
        {
            let angle =
                angle.unwrap_or_else(|error| panic!("{length} m, {mass} kg, {place} m: {error}"));
            // 150 steps, each rounded.
            let error = (angle - wanted).abs();
            assert!(
                error <= 500.0 * resolved,
                "{length} m, {mass} kg, {place} m: {error:e} rad, {resolved:e}"
            );
        }
    });
}

#[test]
fn projected_runs_are_similar_at_any_size_mass_and_place() {
    all_swing::<f64>();
}

#[test]
fn projected_runs_are_similar_in_single_precision() {
    all_swing::<f32>();
}

fn all_are_driven<S: Real>() {
    sweep::<S>(|length, mass, place, resolved| {
        let speed = (9.81 / length).sqrt();
        let model = SliderCrank::new(length, mass, place, speed).expect("acceptable");
        let end = 1.0 / speed;
        let mut worst = 0.0_f64;
        let report = KinematicAnalysis::new(&model, StandardLagrange).run(
            S::zero()..=S::constant(end),
            every(S::constant(0.1 * end)),
            |sample| {
                let time = sample.time().to_f64();
                let size = |row| {
                    if row < 10 {
                        hinge(length)(row)
                    } else {
                        [length, 1.0][row - 10]
                    }
                };
                worst = worst.max(violation::<S, _>(&model, time, sample.state(), size));
                ControlFlow::Continue(())
            },
        );
        if let Err(error) = report {
            panic!("{length} m, {mass} kg, {place} m: {error}");
        }
        assert!(
            worst <= 100.0 * resolved,
            "{length} m, {mass} kg, {place} m: {worst:e}, {resolved:e}"
        );
    });
}

#[test]
fn driven_mechanisms_of_any_size_mass_and_place_are_followed() {
    all_are_driven::<f64>();
}

#[test]
fn driven_mechanisms_are_followed_in_single_precision() {
    all_are_driven::<f32>();
}

#[test]
fn half_a_millimetre_is_corrected_a_thousand_kilometres_away() {
    let model = Hinged::new(1.0, 1.0, 1e6).expect("acceptable");
    let mut state = model.described_state::<f64>().expect("described");
    state.coordinates_mut()[1] += 5e-4;
    let told = model.assemble(0.0, &mut state).expect("reachable");
    assert!(told.iterations > 0);
    assert!(violation::<f64, _>(&model, 0.0, &state, |_| 1.0) < 1e-8);
}

#[test]
fn a_short_link_is_judged_by_its_own_length() {
    let model = Linked::new(1e-6, 1.0, 0.0).expect("acceptable");
    let mut state = model.described_state::<f64>().expect("described");
    state.coordinates_mut()[1] *= 1.0 + 1e-4;
    let told = model.assemble(0.0, &mut state).expect("reachable");
    assert!(told.iterations > 0);
    assert!((state.coordinates()[1] - 1e-6).abs() < 1e-20);
}

/// An arm of two links whose hand is held at a distance.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, 0.0])]
struct Stretched {
    #[param]
    length: f64,
    #[param]
    place: f64,
    #[param]
    distance: f64,
    #[body(mass = 1.0, position = [place + length, 0.0, 0.0])]
    elbow: Particle,
    #[body(mass = 1.0, position = [place + distance, 0.0, 0.0])]
    hand: Particle,
    #[joint(between = [ground, elbow], head = [place, 0.0, 0.0], tail = [place + length, 0.0, 0.0], length = length)]
    upper: Distance,
    #[joint(between = [elbow, hand], head = [place + length, 0.0, 0.0], tail = [place + distance, 0.0, 0.0], length = length)]
    lower: Distance,
    #[joint(between = [ground, hand], point = [place + distance, 0.0, 0.0])]
    held: Spherical,
}

#[test]
fn what_contradicts_itself_does_not_assemble_at_any_size_and_place() {
    for (length, place, distance) in [
        (1.0, 0.0, 3.0),
        (1.0, 1e5, 3.0),
        (1.0, 1e5, 2.001),
        (1e-5, 0.0, 2.2e-5),
        (1e-6, 0.0, 2.001e-6),
        (1e3, 1e6, 2.001e3),
    ] {
        let model = Stretched::new(length, place, distance).expect("acceptable");
        let mut state = model.described_state::<f64>().expect("described");
        let fault = model.assemble(0.0, &mut state);
        assert!(
            matches!(fault, Err(Fault::Step(StepFault::NotConverged { .. }))),
            "{length} m, {place} m, {distance} m: {fault:?}"
        );
    }
}

/// An arm whose hand is pulled along x, from 1.2 of its links' length at one of them in a second.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, 0.0])]
struct Pulled {
    #[param]
    length: f64,
    #[body(mass = 1.0, position = [0.6 * length, 0.8 * length, 0.0])]
    elbow: Particle,
    #[body(mass = 1.0, position = [1.2 * length, 0.0, 0.0], velocity = [length, 0.0, 0.0])]
    hand: Particle,
    #[joint(between = [ground, elbow], head = [0.0, 0.0, 0.0], tail = [0.6 * length, 0.8 * length, 0.0], length = length)]
    upper: Distance,
    #[joint(between = [elbow, hand], head = [0.6 * length, 0.8 * length, 0.0], tail = [1.2 * length, 0.0, 0.0], length = length)]
    lower: Distance,
    #[joint(between = [ground, elbow], point = [0.6 * length, 0.8 * length, 0.0], normal = [0.0, 0.0, 1.0])]
    plane: PointOnPlane,
    #[joint(between = [ground, hand], point = [1.2 * length, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    line: holonom::joints::PointOnLine,
    #[joint(
        between = [ground, hand],
        point = [1.2 * length, 0.0, 0.0],
        axis = [1.0, 0.0, 0.0],
        motion = length * time
    )]
    pull: holonom::joints::DisplacementDriver,
}

#[test]
fn an_arm_of_any_size_is_not_pulled_beyond_its_reach() {
    fn stops<S: Real, F: Formulation<S> + Debug>(method: F, length: f64) {
        let model = Pulled::new(length).expect("acceptable");
        let error = Simulation::new(&model, method, Rk4::every(S::constant(1e-3)))
            .assembled()
            .projection(Projection::default())
            .run(
                S::zero()..=S::constant(2.0),
                every(S::constant(0.1)),
                |_| ControlFlow::Continue(()),
            );
        let time = error.err().map(|error| error.time);
        let wanted = 0.7..0.83;
        assert!(
            time.is_some_and(|time| wanted.contains(&time)),
            "{method:?}, {length} m: {time:?}"
        );
    }
    for length in [1e-6, 1e-5, 1e-3, 1.0, 1e3] {
        stops::<f64, _>(Penalty::default(), length);
        stops::<f64, _>(StandardLagrange, length);
        stops::<f32, _>(Penalty::default(), length);
    }
}

/// The bob of a link after one and a half units of time, in lengths of the link, with a penalty.
fn bob<F: Formulation<f64>>(method: F, length: f64, mass: f64) -> f64 {
    let model = Linked::new(length, mass, 0.0).expect("acceptable");
    let unit = (length / 9.81).sqrt();
    let report = Simulation::new(&model, method, Rk4::every(0.01 * unit))
        .run(
            0.0..=1.5 * unit,
            every_step(),
            |_| ControlFlow::Continue(()),
        )
        .expect("regular");
    report.state.coordinates()[2] / length
}

#[test]
fn a_penalty_means_the_same_for_links_of_any_length() {
    // Factors that scale with the rates of the motion: then all links swing alike.
    let swung = |length: f64| {
        let omega = 10.0 * (1.0 / length).sqrt();
        bob(Penalty::new(1e7, omega, 1.0), length, 1.0)
    };
    let wanted = swung(1.0);
    let exact = bob(StandardLagrange, 1.0, 1.0);
    assert!((wanted - exact).abs() < 1e-5);
    for length in [1e-6, 1e-3, 1e3] {
        let z = swung(length);
        assert!(
            (z - wanted).abs() < 1e-9,
            "{length} m: {z} in place of {wanted}"
        );
    }
}

/// The bias of a penalty grows with the mass, and is told.
#[test]
fn the_bias_of_a_penalty_is_told() {
    for (mass, least, most) in [(1.0, 1e-9, 1e-6), (1e3, 1e-5, 1e-3), (1e7, 0.1, 1.0)] {
        let model = Linked::new(1.0, mass, 0.0).expect("acceptable");
        let mut state = model.described_state::<f64>().expect("described");
        state.velocities_mut()[2] = 1.0;
        let biased = Dynamics::new(&model, Penalty::default()).expect("acceptable");
        let (evaluation, _) = biased.evaluate(0.0, &state).expect("regular");
        let (bias, joint) = biased.inconsistency(0.0, &state, &evaluation);
        assert!((least..most).contains(&bias), "{mass} kg: {bias:e}");
        assert_eq!(joint, Some("link"));
        let rigid = Dynamics::new(&model, StandardLagrange).expect("acceptable");
        let (evaluation, _) = rigid.evaluate(0.0, &state).expect("regular");
        assert!(rigid.inconsistency(0.0, &state, &evaluation).0 < 1e-15);
    }
}

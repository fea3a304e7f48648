//! Threads and collars, which rub by the thrust along their axis.

use holonom::error::StartFault;
use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::nalgebra::Vector3;
use holonom::prelude::*;
use holonom::run::InteractionMode as Mode;

use super::{GRAVITY, tight};

/// A spindle of 3 kg in a nut on the ground, and a turntable of 5 kg, both with a vertical axis. A
/// head of 2 kg is the nut of an oblique spindle of a cart, with a left-handed thread.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Jack {
    #[param]
    pitch: f64,
    #[input]
    moment: f64,
    #[body(mass = 3.0, inertia = [2e-3, 2e-3, 2e-3], position = [0.01, 0.0, 0.3])]
    spindle: Body,
    #[body(mass = 5.0, inertia = [0.3, 0.3, 0.3], position = [1.0, 0.0, 0.0], angular_velocity = [0.0, 0.0, 4.0])]
    turntable: Body,
    #[joint(between = [ground, spindle], point = [0.01, 0.0, 0.0], axis = [0.0, 0.0, 1.0], pitch = pitch)]
    thread: Screw,
    #[joint(between = [ground, turntable], point = [1.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[body(mass = 4.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 2.0, 0.0])]
    cart: Body,
    #[body(mass = 2.0, inertia = [0.01, 0.02, 0.03], position = [0.5, 2.0, 0.6])]
    head: Body,
    #[joint(between = [ground, cart], point = [0.0, 2.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rail: Prismatic,
    #[joint(between = [head, cart], point = [0.3, 2.0, 0.4], axis = [0.6, 0.0, 0.8], pitch = -0.08)]
    oblique: Screw,
    #[force(between = [ground, spindle], axis = [0.0, 0.0, 1.0], moment = moment)]
    motor: TorsionalActuator,
}

const MASS: f64 = 3.0;
const INERTIA: f64 = 2e-3;
const RADIUS: f64 = 0.012;

fn turning(jack: &Jack, rate: f64) -> StateOf<Jack> {
    let mut state = jack.described_state().expect("it is described");
    jack.set_angle_rate(&mut state, Jack::HANDLES.thread, rate)
        .expect("it is free");
    state
}

/// A load `F = m (g + z'')` asks for the moment `F r tan(l + phi)` where it is raised and for `F r
/// tan(l - phi)` where it is lowered, of the lead angle `l` and the angle of friction `phi`: the
/// textbook's, in which no effort is along a quantity.
fn turns<C: Coordinates<Jack>>() {
    for (tangent, mu, moment, rate) in [
        (0.1, 0.15, 0.3, 5.0),
        (0.1, 0.15, 0.0, -5.0),
        (0.4, 0.15, 0.0, -5.0),
        (0.4, 0.15, 0.0, 3.0),
        (-0.3, 0.2, 0.0, 2.0),
        (-0.3, 0.2, -0.5, -2.0),
        (2.0, 0.3, 0.0, -1.0),
    ] {
        let advance: f64 = RADIUS * tangent;
        let pitch = core::f64::consts::TAU * advance;
        let jack = Jack {
            moment,
            ..Jack::new(pitch).expect("a jack")
        };
        let h = Jack::HANDLES;
        let interactions = [Interaction::friction_by_load(h.thread, mu).radius(RADIUS)];
        let [friction] = Interaction::handles(&interactions);
        // By the lift: of a left-handed thread it is lifted by turns to the left.
        let (lead, phi) = (f64::atan(tangent.abs()), f64::atan(mu));
        let is_raised = rate * tangent > 0.0;
        let angle = if is_raised { lead + phi } else { lead - phi };
        let needed = tangent.signum() * RADIUS * angle.tan();
        // I q'' = M - m (g + h q'') needed
        let acceleration = (moment - MASS * GRAVITY * needed) / (INERTIA + MASS * advance * needed);
        let end = if rate * acceleration < 0.0 {
            (-rate / acceleration).min(0.5)
        } else {
            0.5
        };
        let simulation = Simulation::new(&jack, StandardLagrange, DormandPrince::new(tight()))
            .coordinates::<C>()
            .initial_state(turning(&jack, rate))
            .interactions(interactions);
        simulation
            .clone()
            .run(
                0.0..=0.99 * end,
                every(0.1 * end),
                |sample| -> Result<(), Fault> {
                    let wanted = rate + acceleration * sample.time();
                    let found = sample.angle_rate(h.thread);
                    assert!(
                        (found - wanted).abs() < 1e-8,
                        "{tangent} {mu}: {found} {wanted}"
                    );
                    // Torque of the motor less that of the spindle is what the thread takes.
                    let thrust = MASS * (GRAVITY + advance * acceleration);
                    let effort = thrust * advance - thrust * needed;
                    let found = sample.effort(friction)?;
                    assert!(
                        (found - effort).abs() < 1e-8,
                        "{tangent} {mu}: {found} {effort}"
                    );
                    let lift = MASS * (GRAVITY + advance * sample.angle_acceleration(h.thread)?);
                    let reaction = sample.reaction(h.thread, h.spindle)?.force.z;
                    assert!((lift - thrust).abs() < 1e-8 && (reaction - thrust).abs() < 1e-8);
                    Ok(())
                },
            )
            .expect("it turns");
        if end < 0.5 {
            // It stands still. Then it stays where the thread locks itself.
            let locks = mu > tangent.abs();
            let report = simulation.clone().run(0.0..=end + 0.2, every(0.1), |_| ());
            let report = report.expect("it runs");
            let view = jack.view(0.0, &report.state).expect("a view");
            let stands = view.angle_rate(h.thread).abs() < 1e-9;
            assert_eq!(stands, locks, "{tangent} {mu}");
        }
    }
}

#[test]
fn a_thread_takes_the_moment_of_the_textbook() {
    turns::<Relative>();
    turns::<Absolute>();
}

/// From rest it locks where the coefficient is more than the tangent of its lead angle, in a step
/// as in a run.
fn locks<C: Coordinates<Jack>>() {
    let h = Jack::HANDLES;
    for (tangent, mu) in [(0.1, 0.1001), (0.1, 0.0999), (-0.5, 0.501), (-0.5, 0.499)] {
        let pitch = core::f64::consts::TAU * RADIUS * tangent;
        let jack = Jack::new(pitch).expect("a jack");
        let interactions = [Interaction::friction_by_load(h.thread, mu).radius(RADIUS)];
        let [friction] = Interaction::handles(&interactions);
        let does = mu > f64::abs(tangent);
        Simulation::new(&jack, StandardLagrange, DormandPrince::new(tight()))
            .coordinates::<C>()
            .interactions(interactions)
            .run(0.0..=1.0, every(0.5), |sample| -> Result<(), Fault> {
                let sticks = sample.mode(friction)? == Mode::Sticking;
                assert_eq!(sticks, does, "{tangent} {mu}");
                if sticks {
                    let effort = sample.effort(friction)?;
                    let wanted = MASS * GRAVITY * RADIUS * tangent;
                    assert!((effort - wanted).abs() < 1e-10, "{effort} {wanted}");
                }
                Ok(())
            })
            .expect("it runs");
        let mut stepper = jack
            .stepper(StandardLagrange, Rk4)
            .expect("it is prepared")
            .coordinates::<C>()
            .interactions(interactions);
        let mut state = stepper.initial_state().expect("a state");
        for _ in 0..50 {
            stepper.step(&mut state, 1e-3).expect("it steps");
        }
        assert_eq!(stepper.mode(friction) == Ok(Mode::Sticking), does);
    }
}

#[test]
fn a_screw_locks_itself() {
    locks::<Relative>();
    locks::<Absolute>();
}

/// The effort is the load of the reaction that is read, whichever of its bodies is the first.
fn follows_its_reaction<C: Coordinates<Jack>>(rate: f64) -> [f64; 3] {
    let (jack, h) = (Jack::new(0.01).expect("a jack"), Jack::HANDLES);
    let (mu, radius) = (0.35, 0.02);
    let interactions = [Interaction::friction_by_load(h.oblique, mu).radius(radius)];
    let [friction] = Interaction::handles(&interactions);
    let mut start = jack.described_state().expect("it is described");
    jack.set_angle_rate(&mut start, h.oblique, rate)
        .expect("it is free");
    let energy = jack.view(0.0, &start).expect("a view").energy();
    let axis = Vector3::new(0.6, 0.0, 0.8);
    let tangent = -0.08 / (core::f64::consts::TAU * radius);
    let mut work = 0.0;
    let mut last = None;
    let report = Simulation::new(&jack, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .initial_state(start)
        .interactions(interactions)
        .run(0.0..=0.2, every(1e-3), |sample| -> Result<(), Fault> {
            let effort = sample.effort(friction)?;
            assert!(matches!(
                sample.mode(friction)?,
                Mode::SlidingUp | Mode::SlidingDown
            ));
            assert!(effort * sample.angle_rate(h.oblique) < 0.0);
            // Along the helix it acts on the second body with `x tan / (r (1 + tan^2))`.
            let thrust = sample.reaction(h.oblique, h.cart)?.force.dot(&axis);
            let ratio = 1.0 + tangent * tangent;
            let flank = thrust - effort * tangent / (radius * ratio);
            let wanted = mu * radius * ratio * flank.abs();
            assert!((effort.abs() - wanted).abs() < 1e-9, "{effort} {wanted}");
            let power = sample.power();
            if let Some((time, before)) = last {
                work += 0.5 * (power + before) * (sample.time() - time);
            }
            last = Some((sample.time(), power));
            Ok(())
        })
        .expect("it turns");
    let view = jack.view(0.2, &report.state).expect("a view");
    let left = view.energy() - energy - work;
    assert!(
        left.abs() < 1e-5 * energy.abs().max(work.abs()),
        "{left} {work}"
    );
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    [
        view.angle(h.oblique),
        view.angle_rate(h.oblique),
        view.displacement(h.rail),
    ]
}

#[test]
fn an_oblique_thread_follows_its_reaction() {
    for rate in [30.0, -30.0] {
        let of_joints = follows_its_reaction::<Relative>(rate);
        let of_bodies = follows_its_reaction::<Absolute>(rate);
        for (a, b) in of_joints.iter().zip(of_bodies) {
            assert!((a - b).abs() < 1e-9, "{of_joints:?} {of_bodies:?}");
        }
    }
}

/// A collar of 0.1 m bears 5 kg: it slows by `mu r m g / I`, and then rests.
fn slows<C: Coordinates<Jack>>() {
    let (jack, h) = (Jack::new(0.01).expect("a jack"), Jack::HANDLES);
    let mu = 0.2;
    let slope = mu * 0.1 * 5.0 * GRAVITY / 0.3;
    let by_load = Interaction::friction_by_load(h.bearing, mu);
    // Nothing acts across the axis: a journal beside the collar adds nothing.
    for friction in [by_load.collar(0.1), by_load.collar(0.1).radius(0.4)] {
        Simulation::new(&jack, StandardLagrange, DormandPrince::new(tight()))
            .coordinates::<C>()
            .interactions([friction])
            .run(0.0..=1.5 * 4.0 / slope, every(0.1), |sample| {
                let wanted = (4.0 - slope * sample.time()).max(0.0);
                let found = sample.angle_rate(h.bearing);
                assert!((found - wanted).abs() < 1e-9, "{found} {wanted}");
            })
            .expect("it slows");
    }
}

#[test]
fn a_collar_bears_the_thrust() {
    slows::<Relative>();
    slows::<Absolute>();
}

#[test]
fn settings_of_threads_and_collars_are_refused_by_name() {
    let (jack, h) = (Jack::new(0.01).expect("a jack"), Jack::HANDLES);
    let fault = |interaction: Interaction<f64, Jack>| {
        let run = jack
            .simulation(StandardLagrange, DormandPrince::default())
            .interactions([interaction])
            .run(0.0..=1.0, every(0.1), |_| ());
        run.expect_err("it is refused").fault
    };
    let thread = Interaction::friction_by_load(h.thread, 0.1);
    let bearing = Interaction::friction_by_load(h.bearing, 0.1);
    for (interaction, wanted) in [
        (thread, "radius"),
        (bearing, "radius"),
        (bearing.collar(0.0), "collar"),
        (bearing.collar(1.0).radius(0.0), "radius"),
    ] {
        let fault = fault(interaction);
        let is_told = matches!(fault, Fault::Start(StartFault::InteractionSetting { setting, .. }) if setting == wanted);
        assert!(is_told, "{wanted}: {fault}");
    }
    for (interaction, wanted) in [
        (thread.radius(0.1).guide(0.1), "guide"),
        (thread.radius(0.1).collar(0.1), "collar"),
    ] {
        let fault = fault(interaction);
        let is_told = matches!(fault, Fault::Start(StartFault::MisplacedSetting { joint: "thread", setting }) if setting == wanted);
        assert!(is_told, "{wanted}: {fault}");
    }
}

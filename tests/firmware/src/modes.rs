//! What happens in time, in the loop of a controller: stops, dry friction, a clutch, the end of a
//! step where a reading passes zero, a current as a state, a law from a table, one that switches.
//! Each is compared with its closed form.

use holonom::forces::Actuator;
use holonom::joints::PointOnLine;
use holonom::prelude::*;
use holonom::spline::uniform_knots;
use holonom::{Real, Scalar};

/// The period of the loop (s).
const PERIOD: f64 = 1e-3;

/// A block on a vertical rail.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
pub struct Falling {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    block: Body,
    #[joint(between = [ground, block], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    rail: Prismatic,
}

/// A block that slides at 1 m/s.
#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
pub struct Sliding {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], velocity = [1.0, 0.0, 0.0])]
    block: Body,
    #[joint(between = [ground, block], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rail: Prismatic,
}

/// A motor at 30 rad/s, and a drum at rest on the same axis.
#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
pub struct Winch {
    #[body(mass = 1.0, inertia = [0.02, 0.02, 0.02], angular_velocity = [0.0, 0.0, 30.0])]
    motor: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    drum: Body,
    #[joint(between = [ground, motor], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    shaft: Revolute,
    #[joint(between = [ground, drum], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
}

/// Of the motor: ohm, H, and N m/A, which are V s/rad.
const RESISTANCE: f64 = 1.0;
const INDUCTANCE: f64 = 5e-3;
const CONSTANT: f64 = 0.05;

/// A rotor with a motor, whose current is a state.
#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
pub struct Motor {
    #[input]
    voltage: f64,
    #[state(
        rate = (voltage - RESISTANCE * current - CONSTANT * drive.rate) / INDUCTANCE,
        start = 0.0
    )]
    current: f64,
    #[body(mass = 0.2, inertia = [1e-4, 1e-4, 1e-4])]
    rotor: Body,
    #[joint(between = [ground, rotor], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[force(between = [ground, rotor], axis = [0.0, 0.0, 1.0], moment = CONSTANT * current)]
    drive: TorsionalActuator,
}

/// Twice the time (N), from a table in the flash.
const PUSH: Spline<5> = Spline::natural(uniform_knots(0.0, 2.0), [0.0, 1.0, 2.0, 3.0, 4.0]);

/// A particle that a force from a table pushes along a line.
#[derive(Mechanism)]
pub struct Pushed {
    #[body(mass = 1.0)]
    bob: Particle,
    #[joint(between = [ground, bob], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    line: PointOnLine,
    #[force(
        between = [ground, bob], head = [-10.0, 0.0, 0.0], tail = [0.0, 0.0, 0.0],
        force = PUSH(time)
    )]
    push: Actuator,
}

/// A particle at 1 m/s with a spring of 1 N/m on one side alone.
#[derive(Mechanism)]
pub struct Springing {
    #[body(mass = 1.0, velocity = [1.0, 0.0, 0.0])]
    bob: Particle,
    #[joint(between = [ground, bob], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    line: PointOnLine,
    #[force(
        between = [ground, bob], head = [-10.0, 0.0, 0.0], tail = [0.0, 0.0, 0.0],
        force = -max(0.0, length - 10.0)
    )]
    spring: Actuator,
}

/// The largest difference of all but the last to their closed forms, over the size of each.
///
/// # Errors
/// What a step or a reading refuses.
pub fn worst<S: Real>() -> Result<S, Fault> {
    let all = [
        bounced::<S>()?,
        reached::<S>()?,
        stopped::<S>()?,
        coupled::<S>()?,
        driven::<S>()?,
        pushed::<S>()?,
    ];
    Ok(all
        .into_iter()
        .fold(S::zero(), |worst, off| worst.max(off.abs())))
}

/// Falls 1 m onto a stop, and is at some height 0.2 s after it: with half the speed.
fn bounced<S: Real>() -> Result<S, Fault> {
    let (falling, h) = (Falling::default(), Falling::HANDLES);
    let (floor, open) = (S::constant(-1.0), S::constant(f64::INFINITY));
    let limit = Interaction::limits(h.rail.displacement(), [floor, open]);
    let mut stepper = Stepper::<Problem<_, _, S>, _>::new(&falling, StandardLagrange, Rk4)?
        .interactions([limit.restitution(S::constant(0.5))]);
    let mut state = stepper.initial_state()?;
    for _ in 0..600 {
        stepper.step(&mut state, S::constant(PERIOD))?;
    }
    let bodies = stepper.bodies(&state);
    let impact = Scalar::sqrt(2.0_f64 / 9.81);
    let after = 0.6 - impact;
    let expected = -1.0 + 0.5 * 9.81 * impact * after - 0.5 * 9.81 * after * after;
    let floor = h.rail.displacement().limits();
    let told = stepper
        .impact(floor)?
        .map_or(S::zero(), |impact| impact.time);
    let height = stepper.view(&bodies).displacement(h.rail) - S::constant(expected);
    Ok(height.abs().max((told - S::constant(impact)).abs()))
}

/// Stops a step where half a metre is fallen.
fn reached<S: Real>() -> Result<S, Fault> {
    let (falling, h) = (Falling::default(), Falling::HANDLES);
    let mut stepper = Stepper::<Problem<_, _, S>, _>::new(&falling, StandardLagrange, Rk4)?;
    let mut state = stepper.initial_state()?;
    let half = |view: &View<'_, S, Falling>| view.displacement(h.rail) + S::constant(0.5);
    for _ in 0..600 {
        let found = stepper.step_until(&mut state, S::constant(PERIOD), Crossing::Falling, half)?;
        if let Some(time) = found {
            return Ok(time - S::constant(Scalar::sqrt(1.0_f64 / 9.81)));
        }
    }
    Ok(S::one())
}

/// Comes to rest by friction of 2 N after 0.25 m, and stays, pushed by nothing.
fn stopped<S: Real>() -> Result<S, Fault> {
    let (sliding, h) = (Sliding::default(), Sliding::HANDLES);
    let friction = Interaction::friction(h.rail.displacement(), S::constant(2.0));
    let mut stepper = Stepper::<Problem<_, _, S>, _>::new(&sliding, StandardLagrange, Rk4)?
        .interactions([friction.stiction(S::constant(3.0))]);
    let mut state = stepper.initial_state()?;
    for _ in 0..1000 {
        stepper.step(&mut state, S::constant(PERIOD))?;
    }
    let bodies = stepper.bodies(&state);
    let view = stepper.view(&bodies);
    let creep = view.displacement_rate(h.rail).abs();
    Ok((view.displacement(h.rail) - S::constant(0.25))
        .abs()
        .max(creep))
}

/// Engages a clutch of 2 N m after 0.1 s: a second later both turn at 5 rad/s.
fn coupled<S: Real>() -> Result<S, Fault> {
    let (winch, h) = (Winch::default(), Winch::HANDLES);
    let (one, capacity) = (S::one(), S::constant(2.0));
    let clutch = Interaction::clutch(h.shaft.angle(), h.bearing.angle(), one, capacity);
    let interactions = [clutch.released()];
    let [clutch] = Interaction::handles(&interactions);
    let mut stepper = Stepper::<Problem<_, _, S>, _>::new(&winch, StandardLagrange, Rk4)?
        .interactions(interactions);
    let mut state = stepper.initial_state()?;
    for period in 0..1100 {
        if period == 100 {
            stepper.engage(clutch)?;
        }
        stepper.step(&mut state, S::constant(PERIOD))?;
    }
    let bodies = stepper.bodies(&state);
    let view = stepper.view(&bodies);
    let rates = [h.shaft, h.bearing].map(|hinge| view.angle_rate(hinge) - S::constant(5.0));
    Ok(rates[0].abs().max(rates[1].abs()) * S::constant(0.2))
}

/// Runs up to where the voltage of the motor is its own: 2 V are 40 rad/s.
fn driven<S: Real>() -> Result<S, Fault> {
    let (motor, h) = (Motor::default(), Motor::HANDLES);
    let mut stepper = Stepper::<Problem<_, _, S>, _>::new(&motor, StandardLagrange, Rk4)?;
    let mut state = stepper.initial_state()?;
    let inputs = InputsOf::<Motor, S> {
        voltage: S::constant(2.0),
    };
    for _ in 0..1500 {
        stepper.step_with(&mut state, &inputs, S::constant(PERIOD))?;
    }
    let bodies = stepper.bodies(&state);
    let view = stepper.view(&bodies);
    let rate = view.angle_rate(h.bearing) - S::constant(40.0);
    Ok((rate * S::constant(1.0 / 40.0))
        .abs()
        .max(view.state_value(h.current).abs()))
}

/// Goes `t^3 / 3` under the force of the table.
fn pushed<S: Real>() -> Result<S, Fault> {
    let (pushed, h) = (Pushed::default(), Pushed::HANDLES);
    let mut stepper = Stepper::<Problem<_, _, S>, _>::new(&pushed, StandardLagrange, Rk4)?;
    let mut state = stepper.initial_state()?;
    for _ in 0..1000 {
        stepper.step(&mut state, S::constant(PERIOD))?;
    }
    let bodies = stepper.bodies(&state);
    let place = stepper.view(&bodies).position(h.bob).x;
    Ok(place - S::constant(1.0 / 3.0))
}

/// Swings half a turn on the spring, and then goes back at 1 m/s. A stepper does not look where the
/// law switches: the slope of the force jumps within a step.
///
/// # Errors
/// What a step refuses.
pub fn sprung<S: Real>() -> Result<S, Fault> {
    let (springing, h) = (Springing::default(), Springing::HANDLES);
    let mut stepper = Stepper::<Problem<_, _, S>, _>::new(&springing, StandardLagrange, Rk4)?;
    let mut state = stepper.initial_state()?;
    for _ in 0..4000 {
        stepper.step(&mut state, S::constant(PERIOD))?;
    }
    let bodies = stepper.bodies(&state);
    let place = stepper.view(&bodies).position(h.bob).x;
    Ok(place + S::constant(4.0 - core::f64::consts::PI))
}

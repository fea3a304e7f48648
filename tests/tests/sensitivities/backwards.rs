//! Gradients by the adjoint of balls, closed loops, states of one's own and laws that bend: by the
//! kernel, by numbers that carry derivatives, and by differences of whole runs.

use holonom::error::AnalysisFault;
use holonom::mechanism::Freedom;
use holonom::prelude::*;
use holonom::sensitivity::{Gradient, Instant};
use holonom::{Formulation, JointCoordinates, Kutta3, Midpoint, Real};

/// A hull that floats, with an arm, a tail in a socket and a weight in one at the tail; a spring
/// that begins to act on the way, and a motor that lags.
#[derive(Clone, Copy, Mechanism)]
#[mechanism(gravity = [0.3, -0.2, -9.81], coordinates = "joints", kernels = [mass, adjoint])]
struct Floating {
    #[input]
    push: f64,
    #[input]
    command: f64,
    #[param]
    heavy: f64,
    #[body(mass = 3.0, inertia = [[0.5, 0.1, 0.0], [0.1, 0.7, -0.1], [0.0, -0.1, 0.6]], free)]
    hull: Body,
    #[body(mass = 1.0, inertia = [0.02, 0.1, 0.09], position = [0.45, 0.0, 0.1])]
    arm: Body,
    #[joint(between = [hull, arm], point = [0.2, 0.0, 0.1], axis = [0.0, 1.0, 0.0])]
    shoulder: Revolute,
    #[body(mass = heavy, inertia = [0.01, 0.012, 0.02], position = [-0.3, -0.4, 0.3])]
    tail: Body,
    #[joint(between = [hull, tail], point = [-0.2, -0.2, 0.2])]
    socket: Spherical,
    #[body(mass = 0.3, inertia = [0.004, 0.005, 0.006], position = [-0.5, -0.6, 0.3])]
    weight: Body,
    #[joint(between = [tail, weight], point = [-0.4, -0.5, 0.3])]
    loose: Spherical,
    #[state(rate = 8.0 * (command - lag) - 0.3 * shoulder.rate, start = 0.5)]
    lag: f64,
    #[force(between = [hull, arm], axis = [0.0, 1.0, 0.0], moment = lag - 0.2 * rate)]
    motor: TorsionalActuator,
    #[force(between = [hull, tail], damping = 0.2)]
    damper: RotationalDamper,
    #[force(between = [hull], point = [0.1, 0.1, 0.0], force = [push, 0.0, 20.0])]
    jet: FollowerForce,
    #[force(between = [ground, weight], head = [0.0, 0.0, 1.0], tail = [-0.5, -0.6, 0.3],
        force = -30.0 * max(0.0, length - 1.4))]
    rope: Actuator,
}

/// A crank-rocker with a moment on its crank, and a rod in space from its coupler to a slide.
#[derive(Clone, Copy, Mechanism)]
#[mechanism(
    gravity = [0.0, 0.0, -9.81],
    redundant = "drop",
    coordinates = "joints",
    kernels = [mass, adjoint]
)]
struct Linkage {
    #[input]
    torque: f64,
    #[param(like = 1.0)]
    long: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 0.5 * long])]
    crank: Body,
    #[body(mass = 1.5, inertia = [1.5, 1.0, 1.0], position = [0.0, 1.5, 1.5])]
    coupler: Body,
    #[body(mass = 2.0, inertia = [1.0, 1.0, 1.0], position = [0.0, 3.0, 1.0])]
    rocker: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    foot: Revolute,
    #[joint(between = [crank, coupler], point = [0.0, 0.0, long], axis = [1.0, 0.0, 0.0])]
    pin: Revolute,
    #[joint(between = [coupler, rocker], point = [0.0, 3.0, 2.0], axis = [1.0, 0.0, 0.0])]
    knee: Revolute,
    #[joint(between = [ground, rocker], point = [0.0, 3.0, 0.0], axis = [1.0, 0.0, 0.0])]
    post: Revolute,
    #[body(mass = 0.7, inertia = [0.02, 0.02, 0.02], position = [1.0, 1.5, 2.0])]
    slide: Body,
    #[joint(between = [ground, slide], point = [1.0, 1.5, 2.0], axis = [0.0, 0.6, 0.8])]
    rail: Prismatic,
    #[joint(between = [coupler, slide], head = [0.0, 1.5, 1.5], tail = [1.0, 1.5, 2.0])]
    rod: Distance,
    #[force(between = [ground, crank], axis = [1.0, 0.0, 0.0], moment = torque - 0.1 * rate)]
    motor: TorsionalActuator,
    #[force(between = [ground, slide], head = [1.0, 0.0, 0.0], tail = [1.0, 1.5, 2.0],
        stiffness = 30.0, free_length = 2.0)]
    spring: SpringDamper,
}

const STEP: f64 = 0.05;

/// The length of the rope (m).
const SLACK: f64 = 1.4;

/// How far two numbers are from each other, over the size of one.
fn off(found: f64, wanted: f64) -> f64 {
    (found - wanted).abs() / wanted.abs().max(1.0)
}

/// All slopes that both gradients have.
fn pairs<X, const N: usize, const U: usize, const P: usize, const Q: usize>(
    found: &Gradient<X, N, U, P>,
    wanted: &Gradient<X, N, U, Q>,
) -> Vec<[f64; 2]> {
    let slopes = |by: &[[f64; U]]| by.iter().flatten().copied().collect::<Vec<f64>>();
    let [a, b] = [&found.by_controls, &wanted.by_controls].map(|by| slopes(by));
    let state = found.by_positions.iter().chain(&found.by_rates).copied();
    let other = wanted.by_positions.iter().chain(&wanted.by_rates).copied();
    let values = found.by_values.iter().zip(&wanted.by_values);
    let mut pairs: Vec<[f64; 2]> = a.into_iter().zip(b).map(Into::into).collect();
    pairs.extend(state.zip(other).map(<[f64; 2]>::from));
    pairs.extend(values.map(|(&a, &b)| [a, b]));
    pairs
}

/// Central differences of a cost by a number.
fn difference(cost: impl Fn(f64) -> f64, step: f64) -> f64 {
    (cost(step) - cost(-step)) / (2.0 * step)
}

/// A body on a ball, with a moment by its angle about the vertical over many turns: that is no sum
/// of turns of joints, and put right after every step.
#[derive(Clone, Copy, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints", kernels = [mass, adjoint])]
struct Hanging {
    #[input]
    torque: f64,
    #[body(mass = 0.5, inertia = [0.02, 0.03, 0.01], position = [0.1, 0.0, -0.4])]
    bob: Body,
    #[joint(between = [ground, bob], point = [0.0, 0.0, 0.0])]
    socket: Spherical,
    #[force(between = [ground, bob], axis = [0.0, 0.0, 1.0], moment = torque - 0.5 * angle)]
    wire: TorsionalActuator,
}

type Whole = <Floating as JointCoordinates>::JointState<f64>;

/// What a cost reads of a floating hull.
fn floating<S: Real>(view: &View<'_, S, Floating>, push: Option<S>) -> S {
    let h = Floating::HANDLES;
    let place = view.point(h.weight, [0.1, 0.0, -0.1].map(S::constant).into());
    let spin = view.angular_velocity(h.tail);
    let off = place.x - S::constant(0.5);
    let sum = off * off + place.y * place.z + S::constant(0.02) * spin.x * spin.y;
    let lag = view.state_value(h.lag);
    let sum = sum + S::constant(0.1) * lag * view.angle_rate(h.shoulder);
    push.map_or(sum, |push| sum + S::constant(1e-3) * push * push)
}

const STEPS: usize = 12;

/// The cost of a run.
fn run_of(hull: Floating, start: &Whole, controls: &[[f64; 2]; STEPS]) -> f64 {
    let stepper = hull.stepper(StandardLagrange, Rk4).expect("regular");
    let mut stepper = stepper.joint_coordinates();
    let (mut state, mut sum) = (*start, 0.0);
    for number in 0..=STEPS {
        let bodies = stepper.bodies(&state);
        let control = controls.get(number);
        sum += floating(&stepper.view(&bodies), control.map(|control| control[0]));
        if let Some(&[push, command]) = control {
            let inputs = InputsOf::<Floating, f64> { push, command };
            let stepped = stepper.step_with(&mut state, &inputs, STEP);
            stepped.expect("regular");
        }
    }
    sum
}

/// A start that is moved along a rate.
fn moved(start: &Whole, rate: usize, by: f64) -> Whole {
    let mut state = *start;
    let mut motions = Floating::JOINT_REPORT.motions.iter();
    let motion = motions.rfind(|motion| motion.velocity <= rate);
    let motion = motion.expect("a motion of the rate");
    match motion.freedom {
        Freedom::Slide => state.rest_mut()[motion.coordinate] += by,
        Freedom::Ball => {
            let [a, b, c] = core::array::from_fn(|k| {
                let axis = rate - motion.velocity == k;
                if axis { 0.5 * by } else { 0.0 }
            });
            let e = state.rest_mut()[motion.coordinate..].first_chunk_mut::<4>();
            let e = e.expect("four numbers");
            let turn = nalgebra::Quaternion::new(1.0, a, b, c);
            let turned = (nalgebra::Quaternion::new(e[0], e[1], e[2], e[3]) * turn).normalize();
            *e = [turned.w, turned.i, turned.j, turned.k];
        }
        _ => {
            let by = if motion.is_reversed() { -by } else { by };
            let [[c, s]] = *state.pairs();
            let (t, u) = (by.cos(), by.sin());
            *state.pairs_mut() = [[c * t - s * u, s * t + c * u]];
        }
    }
    state
}

#[test]
fn of_balls_states_and_laws_that_bend() -> Result<(), Fault> {
    const H: f64 = 2e-6;
    let (hull, h) = (Floating::new(0.5)?, Floating::HANDLES);
    let [x, y, z, r, s, t]: [Motion<_>; 6] = core::array::from_fn(|k| Motion::free(h.hull, k));
    let [a, b, c] = core::array::from_fn(|k| Motion::of(h.socket, k));
    let [i, j, k] = core::array::from_fn(|k| Motion::of(h.loose, k));
    let arm = Motion::of(h.shoulder, 0);
    let space = hull.coordinates([x, y, z, r, s, t, arm, a, b, c, i, j, k])?;
    let mut bodies = hull.described_state::<f64>()?;
    hull.set_angle(&mut bodies, h.shoulder, 0.4)?;
    let turn = nalgebra::Quaternion::new(0.8, 0.3, -0.2, 0.4).normalize();
    hull.set_relative_orientation(&mut bodies, h.socket, turn)?;
    let rates: [f64; 13] = core::array::from_fn(|k| 1.5 * (1.0 + 2.0 * k as f64).sin());
    let start = space.with_rates(&space.of_bodies(&bodies), rates)?;
    let controls: [[f64; 2]; STEPS] = core::array::from_fn(|k| {
        let k = k as f64;
        [6.0 * (0.7 * k).sin(), 2.0 * (0.5 * k).cos()]
    });
    let inputs = [h.push.index(), h.command.index()];
    assert_eq!(Floating::ADJOINT_BY, Some(&inputs[..]));
    macro_rules! agree {
        ($scheme:expr) => {{
            let run = space.adjoint(StandardLagrange, $scheme);
            let cost = |instant: &Instant<'_, Floating, 2>| {
                floating(instant, instant.controls().map(|[push, _]| push))
            };
            let (held, lag) = ([h.push, h.command], h.lag.start());
            let found = run.gradient(&start, held, &controls, [lag], cost)?;
            // A parameter asks for numbers that carry derivatives.
            let wanted = run.gradient(&start, held, &controls, [lag, h.heavy], cost)?;
            assert_eq!((found.cost, &found.states), (wanted.cost, &wanted.states));
            for [found, wanted] in pairs(&found, &wanted) {
                assert!(off(found, wanted) < 2e-13, "{run:?}: {found} {wanted}");
            }
            wanted
        }};
    }
    agree!(Midpoint::every(STEP));
    agree!(Kutta3::every(STEP));
    agree!(DormandPrince::every(STEP));
    let found = agree!(Rk4::every(STEP));
    assert!(off(found.cost, run_of(hull, &start, &controls)) < 1e-13);
    // The rope is loose, and pulls.
    let pulls = found.states.iter().map(|state| {
        let bodies = space.bodies(state);
        let place = hull.view(0.0, &bodies).expect("finite").position(h.weight);
        place.x.hypot(place.y).hypot(place.z - 1.0) > SLACK
    });
    let pulls: Vec<bool> = pulls.collect();
    assert!(pulls.contains(&true) && pulls.contains(&false), "{pulls:?}");
    for (step, by) in found.by_controls.iter().enumerate() {
        for (control, &found) in by.iter().enumerate() {
            let varied = |by: f64| {
                let mut controls = controls;
                controls[step][control] += by;
                run_of(hull, &start, &controls)
            };
            let wanted = difference(varied, H);
            assert!(
                off(found, wanted) < 1e-8,
                "{step} {control}: {found} {wanted}"
            );
        }
    }
    for rate in 0..13 {
        let wanted = difference(|by| run_of(hull, &moved(&start, rate, by), &controls), H);
        let by = found.by_positions[rate];
        assert!(off(by, wanted) < 1e-8, "position {rate}: {by} {wanted}");
        let varied = |by: f64| {
            let mut rates = rates;
            rates[rate] += by;
            let start = space.with_rates(&start, rates).expect("finite");
            run_of(hull, &start, &controls)
        };
        let (by, wanted) = (found.by_rates[rate], difference(varied, H));
        assert!(off(by, wanted) < 1e-8, "rate {rate}: {by} {wanted}");
    }
    let by_start = |by: f64| {
        let mut start = start;
        start.rest_mut()[15] += by;
        run_of(hull, &start, &controls)
    };
    let by_mass = |by: f64| {
        let hull = Floating::new(0.5 + by).expect("positive");
        run_of(hull, &start, &controls)
    };
    let wanted = [difference(by_start, H), difference(by_mass, H)];
    for (found, wanted) in found.by_values.into_iter().zip(wanted) {
        assert!(off(found, wanted) < 1e-8, "{found} {wanted}");
    }
    Ok(())
}

/// What a cost reads of a linkage.
fn linkage<S: Real>(view: &View<'_, S, Linkage>, torque: Option<S>) -> S {
    let h = Linkage::HANDLES;
    let place = view.point(h.coupler, [0.0, 0.5, 0.2].map(S::constant).into());
    let off = place.y - S::constant(1.0);
    let rate = view.angle_rate(h.post);
    let sum = off * off + view.displacement(h.rail) * rate;
    torque.map_or(sum, |torque| sum + S::constant(1e-3) * torque * torque)
}

const LONG_STEPS: usize = 10;

/// The cost of a run of a linkage.
fn run_of_linkage<F: Formulation<f64> + Copy>(
    formulation: F,
    of: Linkage,
    (q, v): (f64, f64),
    controls: &[[f64; 1]; LONG_STEPS],
) -> f64 {
    let space = of.coordinates([Linkage::HANDLES.foot]).expect("regular");
    let mut state = space.state([q], [v]).expect("regular");
    let stepper = of.stepper(formulation, Rk4).expect("regular");
    let mut stepper = stepper.joint_coordinates();
    let mut sum = 0.0;
    for number in 0..=LONG_STEPS {
        let bodies = stepper.bodies(&state);
        let control = controls.get(number);
        sum += linkage(&stepper.view(&bodies), control.map(|control| control[0]));
        if let Some(&[torque]) = control {
            let inputs = InputsOf::<Linkage, f64> { torque };
            stepper
                .step_with(&mut state, &inputs, STEP)
                .expect("regular");
        }
    }
    sum
}

/// Steps are long: what they leave the constraints by is part of the gradient.
#[test]
fn of_closed_loops() -> Result<(), Fault> {
    let (rocker, h) = (Linkage::new(1.0)?, Linkage::HANDLES);
    let space = rocker.coordinates([h.foot])?;
    let start = space.state([0.3], [1.0])?;
    let controls: [[f64; 1]; LONG_STEPS] =
        core::array::from_fn(|k| [20.0 * (0.7 * k as f64).sin() + 5.0]);
    assert_eq!(Linkage::ADJOINT_BY, Some(&[h.torque.index()][..]));
    macro_rules! agree {
        ($formulation:expr, $scheme:expr) => {{
            let integrator = $scheme;
            let run = space.adjoint($formulation, integrator);
            let cost = |instant: &Instant<'_, Linkage, 1>| {
                linkage(instant, instant.controls().map(|[torque]| torque))
            };
            let found = run.gradient(&start, [h.torque], &controls, [], cost)?;
            let wanted = run.gradient(&start, [h.torque], &controls, [h.long], cost)?;
            assert_eq!((found.cost, &found.states), (wanted.cost, &wanted.states));
            for [found, wanted] in pairs(&found, &wanted) {
                assert!(
                    off(found, wanted) < 2e-12,
                    "{integrator:?}: {found} {wanted}"
                );
            }
            wanted
        }};
    }
    macro_rules! differ {
        ($formulation:expr) => {{
            const H: f64 = 1e-5;
            let found = agree!($formulation, Rk4::every(STEP));
            let (q, v) = (0.3, 1.0);
            let cost = |long: f64, start: (f64, f64), controls: &[[f64; 1]; LONG_STEPS]| {
                run_of_linkage(
                    $formulation,
                    Linkage::new(long).expect("positive"),
                    start,
                    controls,
                )
            };
            assert!(off(found.cost, cost(1.0, (q, v), &controls)) < 1e-13);
            for step in 0..LONG_STEPS {
                let turned = |by: f64| {
                    let mut controls = controls;
                    controls[step][0] += by;
                    cost(1.0, (q, v), &controls)
                };
                let (found, wanted) = (found.by_controls[step][0], difference(turned, H));
                assert!(off(found, wanted) < 1e-8, "step {step}: {found} {wanted}");
            }
            let wanted = [
                difference(|by| cost(1.0, (q + by, v), &controls), H),
                difference(|by| cost(1.0, (q, v + by), &controls), H),
                difference(|by| cost(1.0 + by, (q, v), &controls), H),
            ];
            let found = [found.by_positions[0], found.by_rates[0], found.by_values[0]];
            for (found, wanted) in found.into_iter().zip(wanted) {
                assert!(off(found, wanted) < 1e-8, "{found} {wanted}");
            }
        }};
    }
    differ!(StandardLagrange);
    differ!(Baumgarte::default());
    differ!(Penalty::default());
    agree!(Baumgarte::default(), Kutta3::every(STEP));
    agree!(StandardLagrange, DormandPrince::every(STEP));
    Ok(())
}

/// Numbers that carry derivatives are taken where the kernel is not there. The angles of a ball are
/// no coordinates that a cost could read.
#[test]
fn of_an_angle_that_is_put_right() -> Result<(), Fault> {
    let (hanging, h) = (Hanging::default(), Hanging::HANDLES);
    assert_eq!(Hanging::ADJOINT_BY, None);
    let axes: [Motion<_>; 3] = core::array::from_fn(|k| Motion::of(h.socket, k));
    let space = hanging.coordinates(axes)?;
    let bodies = hanging.described_state::<f64>()?;
    let start = space.with_rates(&space.of_bodies(&bodies), [0.5, -1.0, 2.0])?;
    let controls: [[f64; 1]; STEPS] = core::array::from_fn(|k| [(0.7 * k as f64).sin()]);
    let run = space.adjoint(StandardLagrange, Rk4::every(STEP));
    let found = run.gradient(&start, [h.torque], &controls, [], |instant| {
        instant.position(h.bob).x * instant.angular_velocity(h.bob).z
    })?;
    let cost = |controls: &[[f64; 1]; STEPS]| {
        let stepper = hanging.stepper(StandardLagrange, Rk4).expect("regular");
        let mut stepper = stepper.joint_coordinates();
        let (mut state, mut sum) = (start, 0.0);
        for number in 0..=STEPS {
            let bodies = stepper.bodies(&state);
            let view = stepper.view(&bodies);
            sum += view.position(h.bob).x * view.angular_velocity(h.bob).z;
            if let Some(&[torque]) = controls.get(number) {
                let inputs = InputsOf::<Hanging, f64> { torque };
                stepper
                    .step_with(&mut state, &inputs, STEP)
                    .expect("regular");
            }
        }
        sum
    };
    for step in 0..STEPS {
        let turned = |by: f64| {
            let mut controls = controls;
            controls[step][0] += by;
            cost(&controls)
        };
        let (found, wanted) = (found.by_controls[step][0], difference(turned, 1e-5));
        assert!(off(found, wanted) < 1e-8, "step {step}: {found} {wanted}");
    }
    let refused = run.gradient(&start, [h.torque], &controls, [], |instant| {
        instant.positions()[0]
    });
    let joint = "socket";
    let wanted = Fault::Analysis(AnalysisFault::NoPosition { joint });
    assert_eq!(refused.err(), Some(wanted));
    Ok(())
}

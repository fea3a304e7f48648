//! Gradients by the adjoint against forward sensitivities, differences of whole runs, and a closed
//! form.

use holonom::error::{AnalysisFault, StartFault};
use holonom::independent::Direction;
use holonom::prelude::*;
use holonom::sensitivity::Instant;
use holonom::{DormandPrince853, Forward, Heun, Kutta3, Midpoint, Real, Scalar as _};

/// A cart that a force pushes, with a pendulum.
#[derive(Clone, Copy, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints", kernels = [mass, adjoint])]
struct Crane {
    #[input]
    push: f64,
    #[param]
    length: f64,
    #[body(mass = 2.0, inertia = [1.0, 1.0, 1.0])]
    cart: Body,
    #[body(
        mass = 1.0,
        inertia = [0.01 + length * length / 30.0, 0.01 + length * length / 30.0, 0.01],
        position = [0.0, 0.0, -length]
    )]
    load: Body,
    #[joint(between = [ground, cart], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rail: Prismatic,
    #[joint(between = [cart, load], point = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    hinge: Revolute,
    #[force(between = [ground, cart], point = [0.0, 0.0, 0.0], force = [push, 0.0, 0.0])]
    motor: PointForce,
}

/// A crank-rocker of 1, 3, 2.5 and 3 m with a moment on its crank; the length of the crank may
/// change.
#[derive(Clone, Copy, Mechanism)]
#[mechanism(
    gravity = [0.0, 0.0, -9.81],
    redundant = "drop",
    coordinates = "joints",
    kernels = [mass]
)]
struct Rocker {
    #[input]
    torque: f64,
    #[param]
    mass: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 0.5])]
    crank: Body,
    #[body(mass = mass, inertia = [1.5 * mass / 2.0, 1.0, 1.0], position = [0.0, 1.5, 1.5])]
    coupler: Body,
    #[body(mass = 2.0, inertia = [1.0, 1.0, 1.0], position = [0.0, 3.0, 1.0])]
    rocker: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    foot: Revolute,
    #[joint(between = [crank, coupler], point = [0.0, 0.0, 1.0], axis = [1.0, 0.0, 0.0])]
    pin: Revolute,
    #[joint(between = [coupler, rocker], point = [0.0, 3.0, 2.0], axis = [1.0, 0.0, 0.0])]
    knee: Revolute,
    #[joint(between = [ground, rocker], point = [0.0, 3.0, 0.0], axis = [1.0, 0.0, 0.0])]
    post: Revolute,
    #[force(between = [ground, crank], axis = [1.0, 0.0, 0.0], moment = torque)]
    motor: TorsionalActuator,
}

/// Controls that are all different.
fn controls<const K: usize>() -> [[f64; 1]; K] {
    core::array::from_fn(|k| [3.0 * (0.7 * k as f64).sin() + 1.0])
}

/// How far two gradients are from each other, over the size of one.
fn off(found: f64, wanted: f64) -> f64 {
    (found - wanted).abs() / wanted.abs().max(1.0)
}

#[test]
fn of_a_crane_by_everything() {
    const STEPS: usize = 40;
    let (crane, h) = (Crane::new(0.8).expect("acceptable"), Crane::HANDLES);
    let space = crane.coordinates([h.rail]).err();
    assert!(space.is_some(), "one of two");
    let space = crane.coordinates((h.rail, h.hinge)).expect("both");
    let start = space.state([0.1, 0.4], [0.2, -0.3]).expect("regular");
    let run = space.adjoint(StandardLagrange, Rk4::every(0.02));
    let controls = controls::<STEPS>();
    let cost = |controls: &[[f64; 1]], start: &StateOf<Crane>, length: f64| {
        let crane = Crane::new(length).expect("acceptable");
        let mut stepper = crane.stepper(StandardLagrange, Rk4).expect("regular");
        let mut state = stepper.state_of(start).expect("regular");
        let mut sum = 0.0;
        for number in 0..=controls.len() {
            let bodies = stepper.bodies(&state);
            let view = stepper.view(&bodies);
            let place = view.point(h.load, [0.0, 0.0, -0.1].into());
            let off: f64 = place.x - 1.0;
            sum += off * off + 0.1 * view.angle_rate(h.hinge).powi(2);
            if let Some(&[push]) = controls.get(number) {
                sum += 1e-2 * push * push;
                let inputs = InputsOf::<Crane, f64> { push };
                stepper
                    .step_with(&mut state, &inputs, 0.02)
                    .expect("regular");
            }
        }
        sum
    };
    let found = run.gradient(&start, [h.push], &controls, [h.length], |instant| {
        let arm = [0.0, 0.0, -0.1].map(Forward::fixed);
        let off = instant.point(h.load, arm.into()).x - Forward::fixed(1.0);
        let rate = instant.angle_rate(h.hinge);
        let sum = off * off + Forward::fixed(0.1) * rate * rate;
        instant
            .controls()
            .map_or(sum, |[push]| sum + Forward::fixed(1e-2) * push * push)
    });
    let found = found.expect("regular");
    let bodies = space.bodies(&start);
    let plain = cost(&controls, &bodies, 0.8);
    assert!(off(found.cost, plain) < 1e-13, "{} {plain}", found.cost);
    const H: f64 = 1e-5;
    for step in 0..STEPS {
        let ends = [H, -H].map(|h| {
            let mut controls = controls;
            controls[step][0] += h;
            cost(&controls, &bodies, 0.8)
        });
        let wanted = (ends[0] - ends[1]) / (2.0 * H);
        let by = found.by_controls[step][0];
        assert!(off(by, wanted) < 1e-8, "step {step}: {by} {wanted}");
    }
    let of_start = |q: [f64; 2], v: [f64; 2]| {
        let state = space.state(q, v).expect("regular");
        cost(&controls, &space.bodies(&state), 0.8)
    };
    let (q, v) = ([0.1, 0.4], [0.2, -0.3]);
    for k in 0..2 {
        let moved = |numbers: [f64; 2], h: f64| {
            let mut numbers = numbers;
            numbers[k] += h;
            numbers
        };
        let by_position = (of_start(moved(q, H), v) - of_start(moved(q, -H), v)) / (2.0 * H);
        let by_rate = (of_start(q, moved(v, H)) - of_start(q, moved(v, -H))) / (2.0 * H);
        assert!(off(found.by_positions[k], by_position) < 1e-8);
        assert!(off(found.by_rates[k], by_rate) < 1e-8);
    }
    // The coordinates of the start stay.
    let of_length = |length: f64| {
        let crane = Crane::new(length).expect("acceptable");
        let space = crane.coordinates((h.rail, h.hinge)).expect("both");
        let state = space.state(q, v).expect("regular");
        cost(&controls, &space.bodies(&state), length)
    };
    let by_length = (of_length(0.8 + H) - of_length(0.8 - H)) / (2.0 * H);
    assert!(
        off(found.by_values[0], by_length) < 1e-8,
        "{by_length} {found:?}"
    );
}

/// By the kernel, and by numbers that carry derivatives, which a parameter among the values needs.
/// The chosen coordinates stand the other way round.
#[test]
fn of_a_crane_by_its_kernel() {
    let (crane, h) = (Crane::new(0.8).expect("acceptable"), Crane::HANDLES);
    let space = crane.coordinates((h.hinge, h.rail)).expect("both");
    let start = space.state([0.4, 0.1], [-0.3, 0.2]).expect("regular");
    let controls = controls::<12>();
    assert_eq!(Crane::ADJOINT_BY, Some(&[h.push.index()][..]));
    macro_rules! agree {
        ($integrator:expr, |$instant:ident| $cost:expr) => {{
            let integrator = $integrator;
            let run = space.adjoint(StandardLagrange, integrator);
            let found = run.gradient(&start, [h.push], &controls, [], |$instant| $cost);
            let found = found.expect("regular");
            let wanted = run.gradient(&start, [h.push], &controls, [h.length], |$instant| $cost);
            let wanted = wanted.expect("regular");
            assert_eq!((found.cost, &found.states), (wanted.cost, &wanted.states));
            let by_controls = found.by_controls.iter().zip(&wanted.by_controls);
            let by_state = found.by_positions.iter().chain(&found.by_rates);
            let others = wanted.by_positions.iter().chain(&wanted.by_rates);
            let pairs = by_controls.map(|([a], [b])| (*a, *b));
            for (found, wanted) in pairs.chain(by_state.copied().zip(others.copied())) {
                assert!(
                    off(found, wanted) < 1e-13,
                    "{integrator:?}: {found} {wanted}"
                );
            }
        }};
    }
    macro_rules! costs {
        ($integrator:expr) => {{
            let fixed = Forward::fixed;
            // What it reads of the state, at every instant, at the end, and without the bodies.
            agree!($integrator, |instant| {
                let off = instant.point(h.load, [0.0, 0.0, -0.1].map(fixed).into()).x;
                let rate = instant.angle_rate(h.hinge);
                off * off + fixed(0.1) * rate * rate
            });
            agree!($integrator, |instant| match instant.controls() {
                Some([push]) => fixed(1e-2) * push * push,
                None => instant.displacement(h.rail) * instant.angle(h.hinge),
            });
            agree!($integrator, |instant| {
                let ([angle, way], [rate, speed]) = (instant.positions(), instant.rates()) else {
                    unreachable!("two coordinates")
                };
                *angle * *speed + *way * *rate + instant.angle(h.hinge) * *way
            });
        }};
    }
    costs!(Rk4::every(0.05));
    costs!(Midpoint::every(0.05));
    costs!(Heun::every(0.05));
    costs!(Kutta3::every(0.05));
    costs!(DormandPrince::every(0.05));
    costs!(BogackiShampine::every(0.05));
    costs!(DormandPrince853::every(0.05));
    // No Runge-Kutta method.
    costs!(SemiImplicitEuler::every(0.05));
    // An input that stays changes what all controls do.
    let mut space = space;
    space.set_value(h.push, 2.0).expect("finite");
    let run = space.adjoint(StandardLagrange, Rk4::every(0.05));
    let at_end = |is_end: bool, view: &View<'_, Forward<f64, 4>, Crane>| {
        if is_end {
            view.displacement(h.rail)
        } else {
            Forward::fixed(0.0)
        }
    };
    let stays = run.gradient(&start, [], &[[]; 12], [h.push], |instant| {
        at_end(instant.is_end(), instant)
    });
    let held = run.gradient(&start, [h.push], &[[2.0]; 12], [], |instant| {
        at_end(instant.is_end(), instant)
    });
    let (stays, held) = (stays.expect("regular"), held.expect("regular"));
    let sum: f64 = held.by_controls.iter().map(|[by]| by).sum();
    assert!(off(stays.by_values[0], sum) < 1e-13 && sum > 0.01);
    // An input that is held and stays would be two things.
    let both = run.gradient(&start, [h.push], &[[2.0]; 12], [h.push], |_| {
        Forward::fixed(0.0)
    });
    let twice = AnalysisFault::GivenTwice { value: "push" };
    assert_eq!(both.err(), Some(Fault::Analysis(twice)));
    let still = space.adjoint(StandardLagrange, Rk4::every(0.0));
    let none = still.gradient(&start, [h.push], &[[2.0]], [], |_| Forward::fixed(0.0));
    assert!(matches!(
        none.err(),
        Some(Fault::Start(StartFault::Setting { .. }))
    ));
}

/// Products of the Hessian of a cost, by the kernel over numbers that carry derivatives, against
/// differences of gradients; and it is symmetric.
#[test]
fn of_a_gradient_are_products_of_the_hessian() {
    type Twice<'a> = Instant<'a, Crane, 1, Forward<f64, 2>>;

    fn cost<S: Real>(instant: &Instant<'_, Crane, 1, S>) -> Forward<S, 4> {
        let ([angle, way], [rate, speed]) = (instant.positions(), instant.rates()) else {
            unreachable!("two coordinates")
        };
        match instant.controls() {
            Some([push]) => Forward::constant(1e-2) * push * push * *rate,
            None => *angle * *way * *way + *rate * *speed,
        }
    }

    let (crane, h) = (Crane::new(0.8).expect("acceptable"), Crane::HANDLES);
    let space = crane.coordinates((h.hinge, h.rail)).expect("both");
    let start = space.state([0.4, 0.1], [-0.3, 0.2]).expect("regular");
    let controls = controls::<10>();
    let run = space.adjoint(StandardLagrange, Rk4::every(0.05));
    let gradient = |controls: &[[f64; 1]; 10]| -> [f64; 10] {
        let found = run.gradient(&start, [h.push], controls, [], cost);
        let found = found.expect("regular").by_controls;
        core::array::from_fn(|k| found[k][0])
    };
    let along = [3, 7];
    let carrying = space.carrying::<2>();
    let number = Forward::<f64, 2>::fixed;
    let begin = carrying.state([0.4, 0.1].map(number), [-0.3, 0.2].map(number));
    let varied = core::array::from_fn::<_, 10, _>(|k| {
        let slopes = along.map(|place| f64::from(u8::from(place == k)));
        [Forward::new(controls[k][0], slopes)]
    });
    let run_twice = carrying.adjoint(StandardLagrange, Rk4::every(number(0.05)));
    let found = run_twice.gradient(
        &begin.expect("regular"),
        [h.push],
        &varied,
        [],
        |instant: &Twice<'_>| cost(instant),
    );
    let found = found.expect("regular").by_controls;
    let plain = gradient(&controls);
    for (k, [slope]) in found.iter().enumerate() {
        assert!(off(slope.value(), plain[k]) < 1e-14);
        for (lane, place) in along.into_iter().enumerate() {
            let [less, more] = [-1e-4, 1e-4].map(|by| {
                let mut controls = controls;
                controls[place][0] += by;
                gradient(&controls)[k]
            });
            let difference = (more - less) / 2e-4;
            let product = slope.derivatives()[lane];
            assert!(
                (product - difference).abs() < 1e-8,
                "{k} {place}: {product} {difference}"
            );
        }
    }
    let entry = |row: usize, lane: usize| found[row][0].derivatives()[lane];
    assert!((entry(7, 0) - entry(3, 1)).abs() < 1e-14 && entry(7, 0).abs() > 1e-4);
}

/// Against forward sensitivities to a constant input: the sum over the controls. Both are of the
/// steps as they are taken.
#[test]
fn of_a_loop_is_the_sum_of_forward_ones() {
    const STEPS: usize = 200;
    let (rocker, h) = (Rocker::new(1.5).expect("acceptable"), Rocker::HANDLES);
    let mut space = rocker.coordinates([h.foot]).expect("the crank");
    space.set_value(h.torque, 2.0).expect("finite");
    let start = space.state([0.3], [1.0]).expect("regular");
    let directions = [
        h.torque.into(),
        h.mass.into(),
        Direction::position(h.foot),
        Direction::rate(h.foot),
    ];
    macro_rules! agree {
        ($formulation:expr, $scheme:expr, $bound:literal) => {{
            let integrator = $scheme;
            let run = space.adjoint($formulation, integrator);
            let controls = [[2.0]; STEPS];
            let found = run.gradient(&start, [h.torque], &controls, [h.mass], |instant| {
                if instant.is_end() {
                    instant.angle(h.post)
                } else {
                    Forward::fixed(0.0)
                }
            });
            let found = found.expect("regular");
            let mut end = [0.0; 4];
            space
                .sensitivities(&start, directions)
                .expect("chosen")
                .simulation($formulation, integrator)
                .run(0.0..=0.5, every(0.5), |sample| {
                    end = sample.angle(h.post).derivatives()
                })
                .expect("regular");
            let by_torque: f64 = found.by_controls.iter().map(|[by]| by).sum();
            let found = [
                by_torque,
                found.by_values[0],
                found.by_positions[0],
                found.by_rates[0],
            ];
            for (found, wanted) in found.into_iter().zip(end) {
                assert!(off(found, wanted) < $bound, "{found} {wanted}");
            }
        }};
    }
    agree!(StandardLagrange, Rk4::every(0.0025), 1e-12);
    agree!(Baumgarte::default(), Rk4::every(0.0025), 1e-12);
    agree!(StandardLagrange, Kutta3::every(0.0025), 1e-12);
}

/// `x'' = u`: the end of a step `k` of `n` moves by `h^2 (n - k - 1/2)` with its control.
#[test]
fn of_a_cart_is_the_closed_form() {
    /// A cart.
    #[derive(Clone, Copy, Mechanism)]
    #[mechanism(coordinates = "joints", kernels = [mass])]
    struct Cart {
        #[input]
        push: f64,
        #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
        cart: Body,
        #[joint(between = [ground, cart], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
        rail: Prismatic,
        #[force(between = [ground, cart], point = [0.0, 0.0, 0.0], force = [push, 0.0, 0.0])]
        motor: PointForce,
    }

    let (cart, h) = (Cart::default(), Cart::HANDLES);
    let space = cart.coordinates([h.rail]).expect("it slides");
    let start = space.state([0.0], [0.0]).expect("regular");
    let run = space.adjoint(StandardLagrange, Rk4::every(0.1));
    let found = run.gradient(&start, [h.push], &[[1.0]; 20], [], |instant| {
        if instant.is_end() {
            instant.displacement(h.rail)
        } else {
            Forward::fixed(0.0)
        }
    });
    let found = found.expect("regular");
    assert!((found.cost - 2.0).abs() < 1e-13);
    for (k, [by]) in found.by_controls.iter().enumerate() {
        assert!((by - 0.01 * (19.5 - k as f64)).abs() < 1e-14);
    }
    assert!((found.by_positions[0] - 1.0).abs() < 1e-15);
    assert!((found.by_rates[0] - 2.0).abs() < 1e-14);
    let none = run.gradient(&start, [h.push], &[], [], |instant| {
        instant.displacement(h.rail)
    });
    let none = none.expect("the start alone");
    assert_eq!(
        (none.cost, none.by_positions[0], none.by_rates[0]),
        (0.0, 1.0, 0.0)
    );
    let bad = run.gradient(&start, [h.push], &[[f64::NAN]], [], |_| Forward::fixed(0.0));
    assert!(bad.is_err());
    let bad = run.gradient(&start, [h.push], &[[1.0]], [], |_| Forward::fixed(f64::NAN));
    assert!(bad.is_err());
}

/// What would be left out is refused by name.
#[test]
fn of_laws_that_jump_is_refused() {
    /// A block with a force that sets in.
    #[derive(Clone, Copy, Mechanism)]
    #[mechanism(coordinates = "joints", kernels = [mass])]
    struct Block {
        #[input]
        push: f64,
        #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
        block: Body,
        #[joint(between = [ground, block], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
        rail: Prismatic,
        #[force(
            between = [ground, block], head = [-5.0, 0.0, 0.0], tail = [0.0, 0.0, 0.0],
            force = push - if length >= 5.1 { 2.0 } else { 0.0 }
        )]
        stop: Actuator,
    }

    let (block, h) = (Block::default(), Block::HANDLES);
    let space = block.coordinates([h.rail]).expect("it slides");
    let start = space.state([0.0], [0.0]).expect("regular");
    let run = space.adjoint(StandardLagrange, Rk4::every(0.1));
    let found = run.gradient(&start, [h.push], &[[1.0]], [], |_| Forward::fixed(0.0));
    assert_eq!(
        found.err(),
        Some(Fault::Start(StartFault::SwitchLeftOut { law: "stop" }))
    );
}

//! Coefficients that follow from a mechanism: with its masses, lengths and times, for whatever it
//! is made of, and never without a number.

use core::fmt::Debug;

use holonom::error::{StartFault, StepFault};
use holonom::forces::{ConstantMoment, SpringDamper};
use holonom::joints::{AngleDriver, Distance, PointOnPlane, Prismatic, Revolute};
use holonom::prelude::*;
use holonom::{Real, constraints::Scales, dynamics::Dynamics};
use holonom_models::{Door, RodPendulum, SimplePendulum};

/// A rod on a hinge with a bob on a link and a spring, and a wheel that is driven, in units of its
/// own.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, -9.81 * length * rate * rate, 0.0])]
struct Measured {
    #[param]
    length: f64,
    #[param]
    mass: f64,
    /// 1/s.
    #[param]
    rate: f64,
    #[body(
        mass = mass,
        inertia = [mass * length * length / 12.0, 0.02 * mass * length * length, mass * length * length / 12.0],
        position = [0.0, 0.0, 0.5 * length],
        velocity = [0.0, -0.35 * length * rate, 0.0],
        angular_velocity = [0.7 * rate, 0.0, 0.0]
    )]
    rod: Body,
    #[body(mass = 0.2 * mass, position = [0.0, 0.8 * length, length])]
    bob: Particle,
    #[body(mass = 3.0 * mass, inertia = [mass * length * length, mass * length * length, mass * length * length], position = [3.0 * length, 0.0, 0.0])]
    wheel: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[joint(between = [rod, bob], head = [0.0, 0.0, length], tail = [0.0, 0.8 * length, length])]
    link: Distance,
    #[joint(between = [ground, wheel], point = [3.0 * length, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    axle: Revolute,
    #[joint(between = [ground, wheel], axis = [1.0, 0.0, 0.0], motion = 0.1 * rate * time)]
    motor: AngleDriver,
    #[force(
        between = [ground, bob],
        head = [0.0, 2.0 * length, length],
        tail = [0.0, 0.8 * length, length],
        stiffness = mass * rate * rate,
        free_length = length
    )]
    spring: SpringDamper,
}

fn same(a: f64, b: f64, epsilon: f64) {
    assert!(
        (a - b).abs() <= 16.0 * epsilon * b.abs(),
        "{a:e}, not {b:e}"
    );
}

fn powers<S: Real + Debug>(decades: &[f64]) {
    let epsilon = S::EPSILON.to_f64();
    let of = |length, mass, rate| Measured::new(length, mass, rate).expect("positive");
    let unit = of(1.0, 1.0, 1.0);
    let one: Scales<S> = Scales::of(&unit).expect("finite");
    // Both pull: gravity over the length, more or less.
    assert!(
        one.time.to_f64() < 0.8 && one.length.to_f64() >= 3.0,
        "{one:?}"
    );
    let terms: Baumgarte<S> = Baumgarte::of(&unit).expect("finite");
    let penalty: Penalty<S> = Penalty::of(&unit).expect("finite");
    for &l in decades {
        for &m in decades {
            for &r in decades {
                let there = of(l, m, r);
                let scales: Scales<S> = Scales::of(&there).expect("finite");
                same(scales.mass.to_f64(), m * one.mass.to_f64(), epsilon);
                same(scales.lightest.to_f64(), m * one.lightest.to_f64(), epsilon);
                same(scales.length.to_f64(), l * one.length.to_f64(), epsilon);
                same(scales.time.to_f64(), one.time.to_f64() / r, epsilon);
                let found: Baumgarte<S> = Baumgarte::of(&there).expect("finite");
                same(found.alpha.to_f64(), r * terms.alpha.to_f64(), epsilon);
                assert_eq!(found.alpha, found.beta);
                let found: Penalty<S> = Penalty::of(&there).expect("finite");
                same(found.alpha.to_f64(), m * penalty.alpha.to_f64(), epsilon);
                same(found.omega.to_f64(), r * penalty.omega.to_f64(), epsilon);
                let [radian, at_one] = [found, penalty].map(|of| of.radian.expect("derived"));
                same(radian.to_f64(), l * at_one.to_f64(), epsilon);
                let augmented = AugmentedLagrangian::of(&there).expect("finite");
                assert_eq!(
                    (augmented.alpha, augmented.radian),
                    (found.alpha, found.radian)
                );
                let tolerance = Tolerance::of(&there, S::constant(1e-4)).expect("finite");
                let (l, t) = (scales.length.to_f64(), scales.time.to_f64());
                let least = 1.0_f64.min(l).min(l / t).min(1.0 / t);
                same(tolerance.absolute.to_f64(), 1e-7 * least, epsilon);
            }
        }
    }
}

#[test]
fn coefficients_go_with_masses_lengths_and_times() {
    powers::<f64>(&[1e-9, 1e-3, 0.7, 1.0, 1e4, 1e6]);
    powers::<f32>(&[1e-3, 0.7, 1.0, 1e3]);
}

#[test]
fn the_pendulum_of_the_book_gets_about_the_numbers_of_the_book() {
    let rod = RodPendulum::default();
    let Baumgarte { alpha, beta } = Baumgarte::<f64>::of(&rod).expect("finite");
    assert!(alpha == beta && (4.0..6.0).contains(&alpha), "{alpha}");
    let penalty = Penalty::<f64>::of(&rod).expect("finite");
    assert!((5e6..2e7).contains(&penalty.alpha), "{penalty:?}");
    assert!((8.0..12.0).contains(&penalty.omega) && penalty.mu == 1.0);
    let single = Penalty::<f32>::of(&rod).expect("finite");
    assert!((f64::from(single.omega) / penalty.omega - 1.0).abs() < 1e-6);
}

/// A rod that hangs, or stands, in equilibrium.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -weight])]
struct Plumb {
    /// m/s^2.
    #[param]
    weight: f64,
    /// N/m, of two springs that pull against each other.
    #[param]
    stiffness: f64,
    /// m.
    #[param]
    strained: f64,
    #[body(mass = 2.0, inertia = [0.2, 0.01, 0.2], position = [0.0, 0.0, -0.5])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
    #[force(
        between = [ground, rod],
        head = [0.0, 2.0, -0.5],
        tail = [0.0, 0.0, -0.5],
        stiffness = stiffness,
        free_length = 2.0 - strained
    )]
    right: SpringDamper,
    #[force(
        between = [ground, rod],
        head = [0.0, -2.0, -0.5],
        tail = [0.0, 0.0, -0.5],
        stiffness = stiffness,
        free_length = 2.0 - strained
    )]
    left: SpringDamper,
}

#[test]
fn an_equilibrium_has_the_time_of_its_weight_and_springs_do_not_shorten_it() {
    let time = |weight, stiffness, strained| {
        let plumb = Plumb::new(weight, stiffness, strained).expect("finite");
        let scales: Scales<f64> = Scales::of(&plumb).expect("finite");
        let single: Scales<f32> = Scales::of(&plumb).expect("finite");
        assert!((f64::from(single.time) / scales.time - 1.0).abs() < 1e-5);
        scales.time
    };
    let alone = time(9.81, 0.0, 0.0);
    assert_eq!(alone, (0.5_f64 / 9.81).sqrt());
    // Springs without strain, and springs that pull against each other.
    assert_eq!(time(9.81, 1e12, 0.0), alone);
    assert_eq!(time(9.81, 1e9, 0.1), alone);
    // Nothing moves and nothing pulls, or what pulls cancels: a second.
    assert_eq!(time(0.0, 1e6, 0.0), 1.0);
    assert_eq!(time(0.0, 1e6, 0.1), 1.0);
    // What formulations make of that runs.
    let plumb = Plumb::new(0.0, 1e3, 0.1).expect("finite");
    let report = Simulation::new(
        &plumb,
        Baumgarte::of(&plumb).expect("finite"),
        Rk4::every(1e-3),
    )
    .run(0.0..=0.1, every(0.1), |_| ControlFlow::Continue(()));
    assert!(report.expect("at rest").worst_violation < 1e-30);
}

/// A body without a joint.
#[derive(Mechanism)]
struct Free {
    #[param]
    spin: f64,
    #[body(free, mass = 2.0, inertia = [0.5, 0.4, 0.3], position = [1e3, 0.0, 0.0], angular_velocity = [0.0, 0.0, spin])]
    body: Body,
}

/// A particle without any length.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -4.0])]
struct Point {
    #[body(mass = 2.0)]
    body: Particle,
    #[joint(between = [ground, body], point = [0.0, 0.0, 0.0], normal = [1.0, 0.0, 0.0])]
    plane: PointOnPlane,
}

/// A block that a law pushes along a rail, from rest; a crank that a law turns.
#[derive(Mechanism)]
struct Driven {
    #[param]
    speed: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    crank: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    axle: Revolute,
    #[joint(between = [ground, crank], axis = [0.0, 0.0, 1.0], motion = speed * time)]
    motor: AngleDriver,
}

#[test]
fn free_bodies_points_and_drivers_have_scales() {
    let free: Scales<f64> = Scales::of(&Free::new(50.0).expect("finite")).expect("finite");
    assert_eq!((free.mass, free.lightest, free.length), (2.0, 2.0, 0.5));
    assert_eq!(free.time, 0.02);
    let resting = Free::new(0.0).expect("finite");
    let scales: Scales<f64> = Scales::of(&resting).expect("finite");
    assert_eq!(scales.time, 1.0);
    assert!(Penalty::<f64>::of(&resting).is_ok());

    let point: Scales<f64> = Scales::of(&Point::default()).expect("finite");
    assert_eq!((point.mass, point.length, point.time), (2.0, 1.0, 0.5));

    // At rest as described, although the law moves at once.
    let driven = Driven::new(-30.0).expect("finite");
    let scales: Scales<f64> = Scales::of(&driven).expect("finite");
    same(scales.time, 1.0 / 30.0, f64::EPSILON);
}

holonom::joint! {
    /// A point stays in a plane, in hundredths of a metre.
    joint Hundredfold(i, j; point: Point, normal: Axis) {
        100.0 * dot(i.normal, j.point - i.point);
    }
}

/// The same equation in three units.
#[derive(Mechanism)]
struct Units {
    #[body(mass = 3.0, inertia = [0.1, 0.1, 0.1], position = [0.4, 0.0, 0.0])]
    first: Body,
    #[body(mass = 3.0, inertia = [0.1, 0.1, 0.1], position = [0.4, 0.0, 0.0])]
    second: Body,
    #[body(mass = 3.0, inertia = [0.1, 0.1, 0.1], position = [0.4, 0.0, 0.0])]
    third: Body,
    #[joint(between = [ground, first], point = [0.4, 0.1, 0.2], normal = [0.0, 0.0, 1.0])]
    metres: PointOnPlane,
    #[joint(between = [ground, second], point = [0.4, 0.1, 0.2], normal = [0.0, 0.0, 1.0])]
    centimetres: Hundredfold,
    #[joint(between = [ground, third], head = [0.4, 0.1, 7.2], tail = [0.4, 0.1, 0.2])]
    square_metres: Distance,
}

#[test]
fn the_unit_of_an_equation_does_not_count() {
    let units = Units::default();
    let scales: Scales<f64> = Scales::of(&units).expect("finite");
    // An arm of 0.1 m: 1 / (1/m + 0.01 / J), whatever the unit of the row.
    same(scales.lightest, 1.0 / (1.0 / 3.0 + 0.1), f64::EPSILON);
    assert_eq!(scales.mass, 9.0);
    // The three yield to a pull by the same.
    let penalty = Penalty::<f64>::of(&units).expect("finite");
    let dynamics = Dynamics::new(&units, penalty).expect("acceptable");
    let dynamics = dynamics.forces(|_, _, loads| {
        for body in [
            Units::HANDLES.first,
            Units::HANDLES.second,
            Units::HANDLES.third,
        ] {
            loads.force(body, [0.0, 0.0, 1.0]);
        }
    });
    let state = units.described_state().expect("described");
    let (evaluation, _) = dynamics.evaluate(0.0, &state).expect("regular");
    let h = Units::HANDLES;
    let [first, second, third] =
        [h.first, h.second, h.third].map(|body| Units::velocity(&evaluation.rates, body).z);
    assert!(first != 0.0 && (second / first - 1.0).abs() < 1e-6);
    assert!((third / first - 1.0).abs() < 1e-6, "{third} {first}");
}

/// A door whose equations are all kept, with a handle of another mass.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, -1.7, -9.66], redundant = "keep")]
struct Kept {
    #[param]
    handle: f64,
    #[body(mass = 20.0, inertia = [5.0, 4.0, 1.1], position = [0.4, 0.0, 0.0])]
    leaf: Body,
    #[body(mass = handle, inertia = [0.01 * handle, 0.01 * handle, 0.01 * handle], position = [0.8, 0.0, 0.0])]
    knob: Body,
    #[joint(between = [ground, leaf], point = [0.0, 0.0, -0.7], axis = [0.0, 0.0, 1.0])]
    lower: Revolute,
    #[joint(between = [ground, leaf], point = [0.0, 0.0, 0.7], axis = [0.0, 0.0, 1.0])]
    upper: Revolute,
    #[joint(between = [leaf, knob], point = [0.8, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    spindle: Revolute,
}

fn kept<S: Real + Debug>(handle: f64, error: f64) -> Result<(), Fault> {
    let door = Kept::new(handle).expect("positive");
    let penalty = Penalty::<S>::of(&door)?;
    let augmented = AugmentedLagrangian::<S>::of(&door)?;
    let scales = Scales::<S>::of(&door)?;
    let limit = scales.lightest.to_f64() / (64.0 * S::EPSILON.to_f64());
    assert!(penalty.alpha.to_f64() <= 0.26 * limit);
    assert!(penalty.alpha.to_f64() >= 100.0 * scales.mass.to_f64());
    // And the run takes them.
    fn angle<S: Real, F: Formulation<S>>(door: &Kept, formulation: F) -> f64 {
        let mut angle = 0.0;
        let end = S::constant(1.0);
        Simulation::new(door, formulation, Rk4::every(S::constant(1.0 / 128.0)))
            .run(S::zero()..=end, every(end), |sample| {
                angle = sample.angle(Kept::HANDLES.lower).to_f64();
                ControlFlow::Continue(())
            })
            .expect("solvable");
        angle
    }
    let step = S::constant(1.0 / 128.0);
    let reference = angle::<f64, _>(&door, AugmentedLagrangian::of(&door)?);
    let bias = angle::<S, _>(&door, penalty.at_step(step)) - reference;
    let left = angle::<S, _>(&door, augmented.at_step(step)) - reference;
    println!("{handle} kg: {bias:e} {left:e}");
    assert!(bias.abs() <= error && left.abs() <= error);
    Ok(())
}

#[test]
fn the_factor_stays_where_dependent_equations_are_told_apart() {
    kept::<f64>(1.0, 1e-4).expect("seven digits to spare");
    kept::<f64>(1e-3, 1e-4).expect("in range");
    kept::<f32>(10.0, 3e-2).expect("in range");
    // A ratio of masses for which single precision has no compliance.
    let fault = kept::<f32>(1e-3, 1.0).expect_err("no compliance");
    assert!(
        matches!(fault, Fault::Start(StartFault::PenaltyFactor { alpha, largest }) if largest < alpha)
    );
    // Nor double precision, some day.
    let fault = kept::<f64>(1e-11, 1.0).expect_err("no compliance");
    assert!(matches!(
        fault,
        Fault::Start(StartFault::PenaltyFactor { .. })
    ));
    // Where no equation depends on others, nothing is refused.
    assert!(Penalty::<f32>::of(&Door::default()).is_ok());
}

/// A force that may be anything.
#[derive(Mechanism)]
struct Pushed {
    #[input]
    moment: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.5, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
    #[force(between = [ground, rod], moment = [moment, 0.0, 0.0])]
    push: ConstantMoment,
}

#[test]
fn what_is_no_number_is_refused_by_its_name() {
    let pushed = |moment| Pushed {
        moment,
        ..Pushed::default()
    };
    for moment in [f64::NAN, f64::INFINITY] {
        let fault = Scales::<f64>::of(&pushed(moment)).expect_err("no number");
        assert!(matches!(fault, Fault::Parameter(_)), "{fault}");
        let fault = Baumgarte::<f32>::of(&pushed(moment)).expect_err("no number");
        assert!(matches!(fault, Fault::Parameter(_)), "{fault}");
    }
    // Beyond single precision, and beyond any.
    assert!(Scales::<f32>::of(&pushed(1e60)).is_err());
    let fault = Scales::<f64>::of(&pushed(f64::MAX)).expect_err("beyond numbers");
    assert!(
        matches!(
            fault,
            Fault::Start(StartFault::Setting { .. })
                | Fault::Step(StepFault::RatesNotFinite { .. })
        ),
        "{fault}"
    );
    // As large and as small as numbers go otherwise.
    for moment in [5e-324, 1e-300, 1e300] {
        let scales = Scales::<f64>::of(&pushed(moment)).expect("a number");
        assert!(scales.time > 0.0 && scales.time.is_finite());
    }
    // Another state.
    let rod = RodPendulum::default();
    let mut state = rod.described_state::<f64>().expect("described");
    RodPendulum::set_angular_velocity(
        &mut state,
        RodPendulum::HANDLES.rod,
        [40.0, 0.0, 0.0].into(),
    );
    let scales = Scales::at(&rod, 0.0, &state).expect("finite");
    // The accelerations of a turn are its square.
    assert!((scales.time - 0.025).abs() < 0.002, "{scales:?}");
    RodPendulum::set_angular_velocity(
        &mut state,
        RodPendulum::HANDLES.rod,
        [f64::NAN, 0.0, 0.0].into(),
    );
    assert_eq!(
        Scales::at(&rod, 0.0, &state),
        Err(Fault::Step(StepFault::StateNotFinite))
    );
}

#[test]
fn a_fixed_step_bounds_the_rates() {
    let bob = SimplePendulum::default();
    let terms = Baumgarte::<f64>::of(&bob).expect("finite");
    assert_eq!(terms.at_step(1e-3), terms);
    assert_eq!(terms.at_step(0.1), Baumgarte::new(1.0, 1.0));
    let penalty = Penalty::<f64>::of(&bob).expect("finite").at_step(0.1);
    assert_eq!(penalty.omega, 1.0);
    // A step that is none is refused where it is used.
    for step in [f64::NAN, -0.1] {
        let refused = Simulation::new(&bob, terms.at_step(step), Rk4::every(0.01))
            .run(0.0..=1.0, every(1.0), |_| ControlFlow::Continue(()))
            .expect_err("no step");
        assert!(matches!(
            refused.fault,
            Fault::Start(StartFault::Setting { .. })
        ));
    }
    // And so is a radian that has no length.
    let nothing = Penalty {
        radian: Some(0.0),
        ..penalty
    };
    assert!(matches!(
        Dynamics::<Problem<_, _>>::new(&bob, nothing).map(drop),
        Err(Fault::Start(StartFault::Setting { value: 0.0, .. }))
    ));
}

/// A slide without a length of its own: its inertia is what measures it.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Slide {
    #[body(mass = 2.0, inertia = [0.5, 0.5, 0.5])]
    block: Body,
    #[joint(between = [ground, block], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    rail: Prismatic,
}

#[test]
fn a_body_on_its_own_centre_is_measured_by_its_inertia() {
    let scales: Scales<f64> = Scales::of(&Slide::default()).expect("finite");
    assert_eq!(scales.length, 0.5);
    same(scales.time, (0.5_f64 / 9.81).sqrt(), f64::EPSILON);
}

#[test]
fn the_numbers_of_the_guide() {
    fn column<M: Mechanism>(mechanism: &M, [mass, length, time]: [f64; 3], absolute: f64) {
        let near = |found: f64, told: f64| {
            assert!(
                (found / told - 1.0).abs() < 6e-3,
                "{found:e}, {told:e} is told"
            );
        };
        let scales = Scales::of(mechanism).expect("finite");
        println!("{scales:?}");
        near(scales.mass, mass);
        near(scales.length, length);
        near(scales.time, time);
        let penalty = Penalty::of(mechanism).expect("finite");
        let augmented = AugmentedLagrangian::of(mechanism).expect("finite");
        near(Baumgarte::of(mechanism).expect("finite").alpha, 1.0 / time);
        near(penalty.alpha, 1e6 * mass);
        near(augmented.alpha, 1e6 * mass);
        near(penalty.omega, 2.0 / time);
        near(augmented.omega, 1.0 / time);
        let tolerance = Tolerance::of(mechanism, 1e-6).expect("finite");
        near(tolerance.absolute, absolute);
    }
    column(&RodPendulum::default(), [7.02, 0.5, 0.2258], 5e-10);
    let squeezer = holonom_models::SqueezingMechanism::default();
    column(&squeezer, [0.2102, 0.0703, 8.385e-3], 7.03e-11);
    let chain = holonom_models::HeavyChain::default();
    column(&chain, [1000.0, 0.75, 0.2765], 7.5e-10);
}

/// Two rods one behind the other, whose end hangs on a link.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Held {
    #[param]
    length: f64,
    #[body(mass = 1.0, inertia = [length * length / 12.0, 1e-3 * length * length, length * length / 12.0], position = [0.0, 0.5 * length, 0.0])]
    first: Body,
    #[body(mass = 1.0, inertia = [length * length / 12.0, 1e-3 * length * length, length * length / 12.0], position = [0.0, 1.5 * length, 0.0])]
    second: Body,
    #[joint(between = [ground, first], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    a: Revolute,
    #[joint(between = [first, second], point = [0.0, length, 0.0], axis = [1.0, 0.0, 0.0])]
    b: Revolute,
    #[joint(between = [ground, second], head = [0.0, 2.0 * length, 1.5 * length], tail = [0.0, 2.0 * length, 0.0])]
    link: Distance,
}

#[test]
fn a_penalty_is_as_stiff_by_joints_as_by_bodies_at_any_length() {
    for length in [1e-4, 1.0, 1e4] {
        let held = Held::new(length).expect("positive");
        let time = Scales::<f64>::of(&held).expect("finite").time;
        let h = 0.01 * time;
        fn angle<F: Formulation<f64>>(held: &Held, formulation: F, [h, end]: [f64; 2]) -> [f64; 2] {
            let mut angles = [0.0; 2];
            let run = || Simulation::new(held, formulation, Rk4::every(h));
            run()
                .run(0.0..=end, every(end), |sample| {
                    angles[0] = sample.angle(Held::HANDLES.a);
                    ControlFlow::Continue(())
                })
                .expect("regular");
            run()
                .joint_coordinates()
                .run(0.0..=end, every(end), |sample| {
                    angles[1] = sample.angle(Held::HANDLES.a);
                    ControlFlow::Continue(())
                })
                .expect("regular");
            angles
        }
        let over = [h, 3.0 * time];
        let rigid = angle(&held, StandardLagrange, over);
        let penalty = Penalty::of(&held).expect("finite").at_step(h);
        let yielding = angle(&held, penalty, over);
        println!("{length} m: {rigid:?} {yielding:?}");
        assert!(rigid[0].abs() > 0.1 && (rigid[0] - rigid[1]).abs() < 1e-7);
        for (rigid, yielding) in rigid.into_iter().zip(yielding) {
            assert!((rigid - yielding).abs() < 2e-5);
        }
    }
}

//! Motions through singular configurations, with every formulation, with and without a projection,
//! at every tolerance and step: none ends wrong without an error or a warning, and none goes on for
//! ever.

use std::fmt::Debug;

use holonom::error::StepFault;
use holonom::joints::{Distance, PointOnLine, Prismatic, Revolute};
use holonom::prelude::*;
use holonom::{
    Adams, Bdf, BodyHandle, BogackiShampine, DormandPrince853, Heun, JointCoordinates, RadauIIA,
    Rk4, Runs, Sample, SemiImplicitEuler, Warning,
    dynamics::Dynamics,
    mechanism::{Relative, Terms as _},
};
use holonom_models::FourBar;
use holonom_tests::RunsBoth;
use nalgebra::Vector3;

use holonom_tests::is_exhaustive;

macro_rules! equal_links {
    ($($(#[$attribute:meta])* $name:ident($pin:ident))*) => {$(
        #[derive(Mechanism)]
        $(#[$attribute])*
        struct $name {
            #[body(
                mass = 1.0,
                inertia = [0.1, 0.1, 0.1],
                position = [0.4, 0.3, 0.0],
                velocity = [-0.9, 1.2, 0.0],
                angular_velocity = [0.0, 0.0, 3.0]
            )]
            crank: Body,
            #[body(
                mass = 1.0,
                inertia = [0.1, 0.1, 0.1],
                position = [1.2, 0.3, 0.0],
                velocity = [-2.7, 1.2, 0.0],
                angular_velocity = [0.0, 0.0, -3.0]
            )]
            rod: Body,
            #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [1.6, 0.0, 0.0], velocity = [-3.6, 0.0, 0.0])]
            slider: Body,
            #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
            bearing: Revolute,
            #[joint(between = [crank, rod], point = [0.8, 0.6, 0.0], axis = [0.0, 0.0, 1.0])]
            crank_pin: Revolute,
            #[joint(between = [ground, slider], point = [1.6, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
            guide: Prismatic,
            #[joint(between = [slider, rod], point = [1.6, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
            slider_pin: $pin,
        }
    )*};
}

equal_links! {
    /// A slider-crank whose crank and rod are of 1 m both: a quarter of a turn on, the slider
    /// passes over the crank's axis, where it may stay while the links turn on together.
    #[mechanism(coordinates = "both")]
    EqualLinks(PointOnLine)

    /// The same with all its hinges, of whose equations some follow from others.
    #[mechanism(coordinates = "both", redundant = "keep")]
    KeptLinks(Revolute)
}

/// Four links of 1 m, the ground among them: a parallelogram that passes over the line in little
/// more than the time of a step, by joints.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Rhombus {
    #[body(
        mass = 1.0,
        inertia = [0.1, 0.1, 0.1],
        position = [0.3, 0.4, 0.0],
        velocity = [0.4, -0.3, 0.0],
        angular_velocity = [0.0, 0.0, -1.0]
    )]
    crank: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [1.1, 0.8, 0.0], velocity = [0.8, -0.6, 0.0])]
    coupler: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[joint(between = [crank, coupler], point = [0.6, 0.8, 0.0], axis = [0.0, 0.0, 1.0])]
    pin: Revolute,
    #[joint(between = [ground, coupler], head = [1.0, 0.0, 0.0], tail = [1.6, 0.8, 0.0])]
    rod: Distance,
}

/// A slider-crank that keeps away from its dead points, beside a rotor.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct BesideRotor {
    #[body(
        mass = 1.0,
        inertia = [0.1, 0.1, 0.1],
        position = [0.2, 0.15, 0.0],
        velocity = [-0.15, 0.2, 0.0],
        angular_velocity = [0.0, 0.0, 1.0]
    )]
    crank: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.4 + 0.5 * sqrt(0.27), 0.15, 0.0])]
    rod: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.4 + sqrt(0.27), 0.0, 0.0])]
    slider: Body,
    #[body(mass = 0.1, inertia = [1e-6, 1e-6, 1e-6], angular_velocity = [0.0, 0.0, 1000.0])]
    rotor: Body,
    #[joint(between = [ground, rotor], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    shaft: Revolute,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[joint(between = [crank, rod], point = [0.4, 0.3, 0.0], axis = [0.0, 0.0, 1.0])]
    crank_pin: Revolute,
    #[joint(between = [ground, slider], point = [0.4 + sqrt(0.27), 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    guide: Prismatic,
    #[joint(between = [slider, rod], point = [0.4 + sqrt(0.27), 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    slider_pin: PointOnLine,
}

/// A body, a point on it, and where that should be at the end of a run (m).
struct Mark<M> {
    body: BodyHandle<M>,
    point: Vector3<f64>,
    place: Vector3<f64>,
    duration: f64,
    /// The joint whose equations come to depend on the others.
    joint: &'static str,
}

/// The top left pin after five turns and ten times on a line: closed form, see the references.
fn four_bar() -> Mark<FourBar> {
    Mark {
        body: FourBar::HANDLES.left,
        point: FourBar::TOP.into(),
        place: Vector3::new(0.478_385_057_760_970_56, 0.878_150_178_791_209_3, 0.0),
        duration: 10.0,
        joint: "right_pin",
    }
}

/// The crank pin after some turns: `I(theta) theta'^2` stays, integrated by small steps.
fn equal_links<M>(body: BodyHandle<M>) -> Mark<M> {
    let inertia = |theta: f64| {
        let (sine, cosine) = theta.sin_cos();
        0.25 + 0.1 + 0.1 + (1.5 * sine).powi(2) + (0.5 * cosine).powi(2) + (2.0 * sine).powi(2)
    };
    let start = 0.6_f64.atan2(0.8);
    let momentum = 3.0 * inertia(start).sqrt();
    let rate = |theta: f64| momentum / inertia(theta).sqrt();
    let (mut theta, duration, steps) = (start, 5.0, 100_000);
    let h = duration / f64::from(steps);
    for _ in 0..steps {
        let a = rate(theta);
        let b = rate(theta + 0.5 * h * a);
        let c = rate(theta + 0.5 * h * b);
        let d = rate(theta + h * c);
        theta += h / 6.0 * (a + 2.0 * (b + c) + d);
    }
    Mark {
        body,
        // The user's axes stood along the global ones: the pin from the centre of mass.
        point: Vector3::new(0.4, 0.3, 0.0),
        place: {
            let (sine, cosine) = theta.sin_cos();
            Vector3::new(cosine, sine, 0.0)
        },
        duration,
        joint: "slider_pin",
    }
}

/// The pin after two seconds at a rate of -1 rad/s.
fn rhombus() -> Mark<Rhombus> {
    let duration = 2.0;
    let angle = 0.8_f64.atan2(0.6) - duration;
    Mark {
        body: Rhombus::HANDLES.crank,
        point: Vector3::new(0.3, 0.4, 0.0),
        place: Vector3::new(angle.cos(), angle.sin(), 0.0),
        duration,
        joint: "rod",
    }
}

/// What is right to a hundredth is right.
const RIGHT: f64 = 1e-2;
/// Evaluations: more than any run takes that ends. One that stalls in a singular configuration says
/// that they are used up.
fn most_evaluations() -> usize {
    if is_exhaustive() { 500_000 } else { 50_000 }
}
/// What a step or a report may take beyond what is left of the budget.
const OVER: usize = 100;

fn run<M: JointCoordinates, F: Formulation<f64>, I: RunsBoth<M, F>>(
    model: &M,
    mark: &Mark<M>,
    (method, integrator): (F, I),
    (projected, by_joints): (bool, bool),
) -> Option<f64> {
    let mut simulation = Simulation::new(model, method, integrator);
    if projected {
        simulation = simulation.projection(Projection::default());
    }
    let mut error = f64::NAN;
    let observe = |sample: &Sample<'_, f64, M>| {
        error = (sample.point(mark.body, mark.point) - mark.place).norm();
        ControlFlow::Continue(())
    };
    let outcome = if by_joints {
        let simulation = simulation.joint_coordinates();
        simulation.run(0.0..=mark.duration, every(mark.duration), observe)
    } else {
        let simulation = simulation.absolute_coordinates();
        simulation.run(0.0..=mark.duration, every(mark.duration), observe)
    };
    let what =
        format!("{method:?}, {integrator:?}, projected: {projected}, by joints: {by_joints}");
    match outcome {
        Ok(report) => {
            let is_right = error <= RIGHT;
            let warnings = report.warnings();
            assert!(report.evaluations <= most_evaluations() + OVER, "{what}");
            println!(
                "{what}: off by {error:.1e} m, {} warnings, {} evaluations",
                warnings.len(),
                report.evaluations
            );
            for warning in warnings {
                println!("    {warning}");
            }
            assert!(
                is_right || !warnings.is_empty(),
                "{what}: wrong without a word"
            );
            for warning in warnings {
                if let Warning::NearlySingular { joint, .. } = warning {
                    assert_eq!(joint, mark.joint, "{what}");
                }
            }
            // Right or wrong, it was a matter of luck.
            let told = |warning: &Warning| !matches!(warning, Warning::CoarseTolerance { .. });
            assert!(
                warnings.into_iter().any(|warning| told(&warning)),
                "{what}: passed without a word"
            );
            Some(error)
        }
        Err(error) => {
            println!("{what}: {error}");
            if let Fault::Step(StepFault::Budget { evaluations, .. }) = error.fault {
                assert!(
                    evaluations <= most_evaluations() + OVER,
                    "{what}: {evaluations}"
                );
            }
            None
        }
    }
}

/// Straight on, at every tolerance and step, with and without a projection; a penalty to its bias.
fn sweep<M: JointCoordinates, F: Formulation<f64>>(model: &M, mark: &Mark<M>, method: F) {
    let yields = F::Terms::COMPLIANT && !F::ITERATED;
    let check = |error: Option<f64>, bound: f64, what: &dyn Debug| {
        let bound = if yields { RIGHT } else { bound };
        let is_right = error.is_some_and(|error| error < bound);
        assert!(is_right, "{what:?}: {error:?}");
    };
    for how in [(false, false), (true, false), (false, true), (true, true)] {
        for exponent in (5..=11).step_by(if is_exhaustive() { 1 } else { 4 }) {
            let relative = 10.0_f64.powi(-exponent);
            let absolute = 1e-2 * relative;
            let integrator =
                DormandPrince::new(Tolerance { relative, absolute }).budget(most_evaluations());
            let error = run(model, mark, (method, integrator), how);
            check(error, 1e3 * relative, &(how, integrator));
        }
        let steps = [1e-2, 1e-3, 1e-4];
        for &step in &steps[..if is_exhaustive() { 3 } else { 2 }] {
            let error = run(model, mark, (method, Rk4::every(step)), how);
            check(error, RIGHT, &(how, step));
        }
    }
}

macro_rules! sweeps {
    ($($name:ident: $method:expr;)*) => {
        mod a_parallelogram {
            use super::*;
            $(#[test]
            fn $name() {
                sweep(&FourBar::default(), &four_bar(), $method);
            })*
        }

        mod a_rhombus {
            use super::*;
            $(#[test]
            fn $name() {
                sweep(&Rhombus::default(), &rhombus(), $method);
            })*
        }

        mod a_slider_crank_of_equal_links {
            use super::*;
            $(#[test]
            fn $name() {
                sweep(&EqualLinks::default(), &equal_links(EqualLinks::HANDLES.crank), $method);
            })*
        }
    };
}

sweeps! {
    standard: StandardLagrange;
    baumgarte: Baumgarte::default();
    penalty: Penalty::default();
    augmented_lagrangian: AugmentedLagrangian::default();
}

/// Goes straight on at every tolerance, in both coordinates, and says so.
fn goes_straight_on<M: JointCoordinates>(
    model: &M,
    mark: &Mark<M>,
    method: AugmentedLagrangian<f64>,
) {
    for exponent in (5..=11).step_by(if is_exhaustive() { 1 } else { 2 }) {
        let relative = 10.0_f64.powi(-exponent);
        let absolute = 1e-2 * relative;
        let tolerance = Tolerance { relative, absolute };
        for by_joints in [false, true] {
            let integrator = DormandPrince853::new(tolerance).budget(most_evaluations());
            let error = run(model, mark, (method, integrator), (true, by_joints));
            let what = format!("{}, {relative:e}, by joints: {by_joints}", M::REPORT.name);
            let is_right = error.is_some_and(|error| error < 1e3 * relative);
            assert!(is_right, "{what}: off by {error:?} m");
        }
    }
}

#[test]
fn the_augmented_lagrangian_goes_straight_on() -> Result<(), Fault> {
    let (bar, crank, links) = (
        FourBar::default(),
        EqualLinks::default(),
        Rhombus::default(),
    );
    let of_crank = equal_links(EqualLinks::HANDLES.crank);
    for method in [None, Some(AugmentedLagrangian::default())] {
        let of = |own: Result<AugmentedLagrangian<f64>, Fault>| method.map_or(own, Ok);
        goes_straight_on(&bar, &four_bar(), of(AugmentedLagrangian::of(&bar))?);
        goes_straight_on(&crank, &of_crank, of(AugmentedLagrangian::of(&crank))?);
        goes_straight_on(&links, &rhombus(), of(AugmentedLagrangian::of(&links))?);
    }
    Ok(())
}

/// A factor that leaves next to no compliance in a singular configuration, with a tolerance of the
/// formulation and of the integrator.
fn extreme(tolerance: f64, relative: f64) {
    let mut method = AugmentedLagrangian::new(1e11, 10.0, 1.0);
    method.tolerance = tolerance;
    let absolute = 1e-2 * relative;
    let integrator =
        DormandPrince::new(Tolerance { relative, absolute }).budget(most_evaluations());
    run(
        &FourBar::default(),
        &four_bar(),
        (method, integrator),
        (false, false),
    );
    run(
        &EqualLinks::default(),
        &equal_links(EqualLinks::HANDLES.crank),
        (method, integrator),
        (false, false),
    );
}

#[test]
fn an_extreme_penalty_factor_is_warned_of() {
    for tolerance in [1e-10, 1e-11] {
        extreme(tolerance, 1e-6);
        extreme(tolerance, 1e-9);
    }
}

#[test]
fn an_extreme_penalty_factor_is_warned_of_at_tight_tolerances() {
    extreme(1e-11, 1e-11);
    if is_exhaustive() {
        extreme(1e-10, 1e-11);
    }
}

/// By its bodies a mechanism that is open by less than a thousandth passes at a distance that is no
/// longer small.
#[test]
fn what_is_open_by_a_little_is_warned_of_from_further() {
    let (model, mark) = (Rhombus::default(), rhombus());
    let how = (false, false);
    for step in (1..=12).map(|k| 2.5e-4 * f64::from(k)) {
        let short = SemiImplicitEuler::every(step);
        run(&model, &mark, (StandardLagrange, short), how);
    }
    for step in (1..=20).map(|k| 5e-4 * f64::from(k)) {
        let heun = Heun::every(step);
        run(&model, &mark, (StandardLagrange, heun), how);
    }
    for relative in (0..=20).map(|k| 10.0_f64.powf(-3.0 - 0.1 * f64::from(k))) {
        let absolute = 1e-2 * relative;
        let third =
            BogackiShampine::new(Tolerance { relative, absolute }).budget(most_evaluations());
        run(&model, &mark, (StandardLagrange, third), how);
    }
}

/// Methods of higher order take longer steps.
#[test]
fn long_steps_by_joints_are_looked_into() {
    let (model, mark) = (Rhombus::default(), rhombus());
    for how in [(false, true), (true, true)] {
        for exponent in 4..=11 {
            let relative = 10.0_f64.powi(-exponent);
            let absolute = 1e-2 * relative;
            let tolerance = Tolerance { relative, absolute };
            let higher = DormandPrince853::new(tolerance).budget(most_evaluations());
            run(&model, &mark, (StandardLagrange, higher), how);
            let implicit = RadauIIA::new(tolerance).budget(most_evaluations());
            run(&model, &mark, (StandardLagrange, implicit), how);
            let adams = Adams::new(tolerance).budget(most_evaluations());
            run(&model, &mark, (StandardLagrange, adams), how);
            let bdf = Bdf::new(tolerance).budget(most_evaluations());
            run(&model, &mark, (StandardLagrange, bdf), how);
        }
        for step in [0.2, 0.1, 0.05] {
            run(&model, &mark, (StandardLagrange, Rk4::every(step)), how);
            run(&model, &mark, (Penalty::default(), Rk4::every(step)), how);
        }
    }
}

macro_rules! flat {
    ($($(#[$attribute:meta])* $name:ident($angle:expr) { $($parameter:tt)* })*) => {$(
        $(#[$attribute])*
        #[derive(Mechanism)]
        #[mechanism(coordinates = "both", gravity = [0.0, -9.81, 0.0])]
        struct $name {
            #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.5 * cos($angle), 0.5 * sin($angle), 0.0])]
            crank: Body,
            #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.5 + cos($angle), sin($angle), 0.0])]
            coupler: Body,
            #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
            bearing: Revolute,
            #[joint(between = [crank, coupler], point = [cos($angle), sin($angle), 0.0], axis = [0.0, 0.0, 1.0])]
            pin: Revolute,
            #[joint(between = [ground, coupler], head = [1.0, 0.0, 0.0], tail = [1.0 + cos($angle), sin($angle), 0.0], length = 1.0)]
            rod: Distance,
            $($parameter)*
        }
    )*};
}

flat! {
    /// A rhombus that is flat but for `1e-9` rad.
    Flat(1e-9) {}
    /// The same that is no more than nearly so.
    NearlyFlat(1e-5) {}
    /// One of an angle that is known at run time only.
    AnyRhombus(angle) { #[param] angle: f64, }
}

/// Where links are in line the only row of the loop acts on no joint coordinate: its pivot is not
/// small beside itself, but beside what it is on free bodies.
#[test]
fn links_in_line_are_singular_in_both_descriptions() {
    fn is_singular<M: JointCoordinates>(model: &M) -> [bool; 3] {
        let bodies = model.described_state().expect("acceptable");
        let dynamics = Dynamics::<Problem<_, _>>::new(model, StandardLagrange)
            .expect("acceptable")
            .absolute_coordinates();
        let by_bodies = dynamics.evaluate(0.0, &bodies).map(|_| ());
        let dynamics = Dynamics::<Problem<_, _>>::new(model, StandardLagrange);
        let dynamics = dynamics.expect("acceptable").joint_coordinates();
        let joints = dynamics.initial_state().expect("consistent");
        let by_joints = dynamics.evaluate(0.0, &joints).map(|_| ());
        let mut stepper = Stepper::<Problem<_, _>, _>::new(model, StandardLagrange, Rk4)
            .expect("acceptable")
            .joint_coordinates();
        let mut state = joints;
        let stepped = stepper.step(&mut state, 1e-3);
        [by_bodies, by_joints, stepped].map(|outcome| match outcome {
            Ok(()) => false,
            Err(Fault::Step(StepFault::Singular { name, .. })) => {
                assert_eq!(name, "rod");
                true
            }
            Err(fault) => panic!("{fault}"),
        })
    }
    assert_eq!(is_singular(&Flat::default()), [true; 3]);
    assert_eq!(is_singular(&NearlyFlat::default()), [false; 3]);
    let with = |angle| AnyRhombus::new(angle).expect("acceptable");
    assert_eq!(is_singular(&with(1e-9)), [true; 3]);
    assert_eq!(is_singular(&with(1e-5)), [false; 3]);
}

/// By joints what follows from other equations is gone, and the pivots of the rest tell.
#[test]
fn equations_that_are_kept_hide_nothing_by_joints() {
    let (model, mark) = (KeptLinks::default(), equal_links(KeptLinks::HANDLES.crank));
    for projected in [false, true] {
        for exponent in 4..=11 {
            let relative = 10.0_f64.powi(-exponent);
            let absolute = 1e-2 * relative;
            let integrator =
                DormandPrince::new(Tolerance { relative, absolute }).budget(most_evaluations());
            let how = (projected, true);
            run(&model, &mark, (StandardLagrange, integrator), how);
            run(&model, &mark, (Baumgarte::default(), integrator), how);
        }
    }
}

/// With reports within steps and without, whether a method evaluates for them once a step or for
/// each.
#[test]
fn what_the_monitor_looks_at_is_no_part_of_a_run() {
    fn check(integrator: impl Runs<Problem<Rhombus, StandardLagrange, f64, Relative>>) {
        let model = Rhombus::default();
        for (is_projected, step) in [(false, 0.013), (true, 0.013), (false, 2.0), (true, 2.0)] {
            let run = |is_monitored: bool| {
                let mut simulation = Simulation::new(&model, StandardLagrange, integrator);
                if is_projected {
                    simulation = simulation.projection(Projection::default());
                }
                if !is_monitored {
                    simulation = simulation.unmonitored();
                }
                let simulation = simulation.joint_coordinates();
                let report = simulation.run(0.0..=2.0, every(step), |_| ControlFlow::Continue(()));
                let report = report.ok()?;
                Some((report.state, report.evaluations, report.accepted))
            };
            assert_eq!(
                run(true),
                run(false),
                "{integrator:?}, {is_projected}, {step}"
            );
        }
    }
    for exponent in [4, 6, 8] {
        let relative = 10.0_f64.powi(-exponent);
        let absolute = 1e-2 * relative;
        let tolerance = Tolerance { relative, absolute };
        check(DormandPrince::new(tolerance));
        check(DormandPrince853::new(tolerance));
        check(RadauIIA::new(tolerance));
        check(Bdf::new(tolerance));
        check(Adams::new(tolerance));
    }
    for step in [0.1, 0.02] {
        check(Rk4::every(step));
        check(Heun::every(step));
    }
}

#[test]
fn a_fast_rotor_makes_no_loop_singular() {
    let model = BesideRotor::default();
    for exponent in 4..=8 {
        let relative = 10.0_f64.powi(-exponent);
        let absolute = 1e-2 * relative;
        let integrator = DormandPrince::new(Tolerance { relative, absolute });
        let run = |is_monitored: bool| {
            let mut simulation = Simulation::new(&model, StandardLagrange, integrator).assembled();
            if !is_monitored {
                simulation = simulation.unmonitored();
            }
            let simulation = simulation.joint_coordinates();
            let report = simulation.run(0.0..=6.0, every(6.0), |_| ControlFlow::Continue(()));
            report.expect("nothing stops it")
        };
        let (monitored, unmonitored) = (run(true), run(false));
        let is_false = |warning| matches!(warning, Warning::NearlySingular { .. });
        assert!(
            !monitored.warnings().into_iter().any(is_false),
            "{}",
            monitored.warnings()
        );
        // What the monitor looks at is no part of the run.
        assert_eq!(monitored.evaluations, unmonitored.evaluations);
        assert_eq!(monitored.state, unmonitored.state);
    }
}

//! Generalized-alpha on constraints: its order, what it keeps, what it damps.

use holonom::error::{StartFault, StepFault};
use holonom::forces::SpringDamper;
use holonom::joints::{PointOnLine, Revolute};
use holonom::prelude::*;
use holonom::{
    DormandPrince853, GeneralizedAlpha, RadauIIA, Runs,
    mechanism::Absolute,
    state::{Array, Vector},
};
use holonom_models::{
    DrivenSliderCrank, FlyballGovernor, FourBar, HeavyTop, RodPendulum, SliderCrank,
};
use holonom_study::pendulum::{RigidPendulum, from_vertical, wrapped};
use holonom_tests::is_exhaustive;

use crate::pendulum::{SWINGS, final_swing};
use crate::singular::Arm;

fn orders(steps: [f64; 4], error: impl Fn(f64) -> f64) -> [f64; 3] {
    let errors = steps.map(error);
    println!("{steps:?}: {errors:?}");
    [0, 1, 2].map(|k| (errors[k] / errors[k + 1]).log2())
}

const fn halved(step: f64) -> [f64; 4] {
    [step, step / 2.0, step / 4.0, step / 8.0]
}

fn is_second([coarse, fine, finest]: [f64; 3]) {
    println!("{coarse} {fine} {finest}");
    for order in [coarse, fine, finest] {
        assert!((order - 2.0).abs() < 0.25, "{order}");
    }
}

#[test]
fn it_has_order_2_on_the_pendulum_with_any_damping() {
    let all = [0.5, 0.0, 0.8, 1.0];
    for &rho in &all[..if is_exhaustive() { all.len() } else { 1 }] {
        let swing = SWINGS[1];
        is_second(orders(halved(1.0 / 512.0), |step| {
            let method = GeneralizedAlpha::every(step).spectral_radius(rho);
            let [angle, rate] = final_swing(StandardLagrange, method, swing.time);
            (angle - swing.angle).hypot((rate - swing.rate) / 3.8356)
        }));
    }
}

fn end<M: Mechanism>(
    model: &M,
    integrator: impl Runs<Problem<M, StandardLagrange, f64, Absolute>>,
    time: f64,
) -> (M::State<f64>, usize, usize) {
    let report = Simulation::new(model, StandardLagrange, integrator)
        .absolute_coordinates()
        .run(0.0..=time, every(time), |_| ControlFlow::Continue(()))
        .expect("solvable");
    (report.state, report.evaluations, report.accepted)
}

fn exact<M: Mechanism>(model: &M, time: f64) -> M::State<f64> {
    let method = DormandPrince853::new(Tolerance {
        relative: 1e-13,
        absolute: 1e-14,
    });
    let report = Simulation::new(model, StandardLagrange, method)
        .absolute_coordinates()
        .projection(Projection::default())
        .run(0.0..=time, every(time), |_| ControlFlow::Continue(()));
    report.expect("solvable").state
}

/// The largest difference of velocities.
fn apart<M: Mechanism>(a: &M::State<f64>, b: &M::State<f64>) -> f64 {
    let pairs = a.velocities().as_slice().iter();
    pairs
        .zip(b.velocities().as_slice())
        .fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()))
}

fn has_order_2<M: Mechanism>(model: &M, step: f64, time: f64) {
    let exact = exact(model, time);
    is_second(orders(halved(step), |step| {
        let (found, evaluations, steps) = end(model, GeneralizedAlpha::every(step), time);
        println!("{} {evaluations} {steps}", M::REPORT.name);
        apart::<M>(&found, &exact)
    }));
}

#[test]
fn it_has_order_2_on_the_heavy_top_and_on_loops() {
    has_order_2(&HeavyTop::default(), 4e-4, 0.2);
    has_order_2(&FourBar::default(), 4e-3, 0.4);
    has_order_2(&SliderCrank::default(), 1e-4, 0.05);
}

/// The largest violations of a run, and whether it has a warning.
fn violations<S: holonom::Real, M: Mechanism>(
    model: &M,
    method: GeneralizedAlpha<S>,
    time: f64,
) -> [f64; 2] {
    let mut largest = [0.0_f64; 2];
    let (end, interval) = (S::constant(time), S::constant(time / 50.0));
    let report = Simulation::new(model, StandardLagrange, method)
        .absolute_coordinates()
        .run(S::zero()..=end, holonom::every(interval), |_| {
            ControlFlow::Continue(())
        })
        .expect("solvable");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    let mut course_state = report.state;
    let constants = model.constants::<S>().expect("sound");
    for (largest, values) in largest.iter_mut().zip([
        M::constraints(&constants, end, &course_state),
        M::constraint_rates(&constants, end, &course_state),
    ]) {
        for value in values.as_slice() {
            *largest = largest.max(value.to_f64().abs());
        }
    }
    M::rewrap(&constants, &mut course_state);
    largest
}

#[test]
fn positions_and_velocities_are_on_the_constraints() {
    let double = [
        violations(&FourBar::default(), GeneralizedAlpha::every(1e-3), 0.4),
        violations(&SliderCrank::default(), GeneralizedAlpha::every(2e-5), 0.05),
        violations(
            &DrivenSliderCrank::default(),
            GeneralizedAlpha::every(2e-5),
            0.05,
        ),
        violations(&HeavyTop::default(), GeneralizedAlpha::every(1e-4), 0.2),
    ];
    println!("{double:?}");
    for ([position, velocity], speed) in double.into_iter().zip([1.0, 20.0, 20.0, 100.0]) {
        assert!(
            position < 4e-15 && velocity < 1e-14 * speed,
            "{position:e} {velocity:e}"
        );
    }
    let single = [
        violations(&FourBar::default(), GeneralizedAlpha::every(1e-3_f32), 0.4),
        violations(&HeavyTop::default(), GeneralizedAlpha::every(1e-4_f32), 0.2),
    ];
    println!("{single:?}");
    for ([position, velocity], speed) in single.into_iter().zip([1.0, 100.0]) {
        assert!(
            position < 2e-6 && velocity < 5e-6 * speed,
            "{position:e} {velocity:e}"
        );
    }
}

#[test]
fn without_damping_the_energy_of_a_long_run_does_not_drift() {
    let rod = RodPendulum::default();
    let duration = if is_exhaustive() { 1000.0 } else { 200.0 };
    let run = |rho| {
        let mut windows = [0.0_f64; 2];
        let mut start: Option<f64> = None;
        Simulation::new(
            &rod,
            StandardLagrange,
            GeneralizedAlpha::every(0.01).spectral_radius(rho),
        )
        .run(0.0..=duration, every(0.05), |sample| {
            let start = *start.get_or_insert(sample.energy());
            let off = (sample.energy() - start).abs();
            if sample.time() < 0.1 * duration {
                windows[0] = windows[0].max(off);
            } else if sample.time() > 0.9 * duration {
                windows[1] = windows[1].max(off);
            }
            ControlFlow::Continue(())
        })
        .expect("solvable");
        windows
    };
    let [kept, lost] = [run(1.0), run(0.5)];
    println!("{kept:?} {lost:?}");
    // Of 34.4 J that swing.
    assert!(kept[0] < 0.05 && kept[1] < 1.1 * kept[0], "{kept:?}");
    assert!(lost[1] > 5.0 * lost[0], "{lost:?}");
}

/// A mass of 1 kg on a spring of 1e4 N/m along x: 100 rad/s, released 1 cm from its rest.
#[derive(Mechanism)]
struct Oscillator {
    #[body(mass = 1.0, position = [1.0, 0.0, 0.0])]
    mass: Particle,
    #[joint(between = [ground, mass], point = [1.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    line: PointOnLine,
    #[force(
        between = [ground, mass],
        head = [0.0, 0.0, 0.0],
        tail = [1.0, 0.0, 0.0],
        stiffness = 1e4,
        damping = 0.0,
        free_length = 0.99
    )]
    spring: SpringDamper,
}

/// The same whose spring is fixed a hundred metres away: the force is linear wherever an iteration
/// leads.
#[derive(Mechanism)]
struct LinearOscillator {
    #[body(mass = 1.0, position = [1.0, 0.0, 0.0])]
    mass: Particle,
    #[joint(between = [ground, mass], point = [1.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    line: PointOnLine,
    #[force(
        between = [ground, mass],
        head = [-100.0, 0.0, 0.0],
        tail = [1.0, 0.0, 0.0],
        stiffness = 1e4,
        damping = 0.0,
        free_length = 100.99
    )]
    spring: SpringDamper,
}

/// The energy (J) after so many steps.
fn energy_after(rho: f64, step: f64, steps: u32) -> f64 {
    let mut last = 0.0;
    let end = step * f64::from(steps);
    let method = GeneralizedAlpha::every(step).spectral_radius(rho);
    Simulation::new(&Oscillator::default(), StandardLagrange, method)
        .run(0.0..=end, every(end), |sample| {
            last = sample.energy();
            ControlFlow::Continue(())
        })
        .expect("solvable");
    last
}

/// Position (m from its rest) and velocity after so many steps of the linear recurrence that the
/// method is for `q'' = -w^2 q`, from 1 cm at rest.
fn by_recurrence(rho: f64, frequency: f64, step: f64, steps: u32) -> [f64; 2] {
    let (alpha_m, alpha_f) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
    let gamma = 0.5 + alpha_f - alpha_m;
    let beta = 0.25 * (gamma + 0.5) * (gamma + 0.5);
    let square = frequency * frequency;
    let (mut q, mut u) = (0.01, 0.0);
    let mut a = -square * q;
    for _ in 0..steps {
        let free = q + step * u + step * step * (0.5 - beta) * a;
        let right = -alpha_m * a - square * ((1.0 - alpha_f) * free + alpha_f * q);
        let next = right / (1.0 - alpha_m + square * (1.0 - alpha_f) * beta * step * step);
        u += step * ((1.0 - gamma) * a + gamma * next);
        q = free + step * step * beta * next;
        a = next;
    }
    [q, u]
}

#[test]
fn springs_are_followed_or_damped_as_the_theory_has_it_however_stiff() {
    // Of 100 rad/s, from a tenth of a radian a step to a hundred.
    for rho in [0.0, 0.5, 0.8, 1.0] {
        for step in [1e-3, 1e-2, 0.1, 1.0] {
            let (steps, time) = (20, 20.0 * step);
            let method = GeneralizedAlpha::every(step).spectral_radius(rho);
            let (state, evaluations, _) = end(&LinearOscillator::default(), method, time);
            let place = state.coordinates().as_slice()[0] - 0.99;
            let velocity = state.velocities().as_slice()[0];
            let expected = by_recurrence(rho, 100.0, step, steps);
            println!("{rho} {step} {evaluations}: {place:e} {velocity:e} {expected:?}");
            assert!((place - expected[0]).abs() < 1e-9, "{rho} {step}");
            assert!((velocity - expected[1]).abs() < 1e-7, "{rho} {step}");
        }
    }
}

/// The spring of a metre pushes to either side of its end: a step that is long for it has two
/// solutions, and which one is found the run must not leave without a warning.
#[test]
fn steps_with_two_solutions_are_warned_of() {
    for rho in [0.0, 0.5, 0.8, 1.0] {
        for step in [1e-3, 1e-2, 0.1, 1.0, 10.0] {
            let method = GeneralizedAlpha::every(step).spectral_radius(rho);
            let time = 20.0 * step;
            let outcome = Simulation::new(&Oscillator::default(), StandardLagrange, method).run(
                0.0..=time,
                every(time),
                |_| ControlFlow::Continue(()),
            );
            let Ok(report) = outcome else { continue };
            let place = report.state.coordinates().as_slice()[0] - 0.99;
            let [expected, _] = by_recurrence(rho, 100.0, step, 20);
            let warnings = report.warnings();
            println!("{rho} {step} {place:e} {expected:e} {warnings}");
            assert!(
                (place - expected).abs() < 1e-6 || !warnings.is_empty(),
                "{rho} {step}"
            );
        }
    }
}

/// As its documentation has it.
#[test]
fn slow_motions_lose_what_is_said_of_them() {
    for rho in [0.0_f64, 0.5] {
        let x: f64 = 0.1;
        let found = energy_after(rho, x / 100.0, 2000) / 0.5;
        let lost = ((1.0 - rho) / (1.0 + rho)).powi(3) * x.powi(4) / 2.0;
        let expected = (1.0 - lost).powi(4000);
        println!("{rho}: {found} {expected}");
        assert!((found - expected).abs() < 0.02, "{rho}: {found} {expected}");
    }
}

/// The dampers of the governor decay with 8117 1/s: at steps eighty times as long it goes on as it
/// does by the method of Radau.
#[test]
fn stiff_dampers_do_not_bound_its_steps() {
    let governor = FlyballGovernor::default();
    let height = |state: &<FlyballGovernor as Mechanism>::State<f64>| {
        FlyballGovernor::pose(state, FlyballGovernor::HANDLES.slider)
            .position
            .z
    };
    let method = RadauIIA::new(Tolerance {
        relative: 1e-10,
        absolute: 1e-12,
    });
    let exact = Simulation::new(&governor, StandardLagrange, method)
        .joint_coordinates()
        .run(0.0..=1.0, every(1.0), |_| ControlFlow::Continue(()))
        .expect("solvable");
    let exact = height(&exact.state);
    let errors = [0.01, 0.005, 0.0025].map(|step| {
        let (state, evaluations, steps) = end(&governor, GeneralizedAlpha::every(step), 1.0);
        println!("{step}: {evaluations} evaluations, {steps} steps");
        assert!(evaluations < 40 * steps, "{evaluations}");
        (height(&state) - exact).abs()
    });
    println!("{errors:?}");
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 2.0).abs() < 0.4, "{order}");
    }
}

#[test]
fn states_within_a_step_are_as_good_as_those_at_its_ends() {
    let rod = RodPendulum::default();
    let run = |step: f64| {
        let mut largest = 0.0_f64;
        Simulation::new(&rod, StandardLagrange, GeneralizedAlpha::every(step))
            .run(0.0..=2.0, every(0.0137), |sample| {
                let exact = RigidPendulum::CHAPTER_15.at(sample.time()).angle;
                let found = from_vertical(
                    sample.angle(RodPendulum::HANDLES.pivot),
                    core::f64::consts::FRAC_PI_2,
                );
                largest = largest.max(wrapped(found - exact).abs());
                ControlFlow::Continue(())
            })
            .expect("solvable");
        largest
    };
    is_second(orders(halved(1.0 / 64.0), run));
}

/// A door on two hinges, of which one is enough.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, -9.66, -1.70], redundant = "keep")]
struct Door {
    #[body(
        mass = 20.0,
        inertia = [6.66933333333333, 1.06933333333333, 7.73333333333333],
        position = [0.4, 1.0, 0.0]
    )]
    leaf: Body,
    #[joint(between = [ground, leaf], point = [0.0, 0.25, 0.0], axis = [0.0, 1.0, 0.0])]
    lower: Revolute,
    #[joint(between = [ground, leaf], point = [0.0, 1.75, 0.0], axis = [0.0, 1.0, 0.0])]
    upper: Revolute,
}

#[test]
fn dependent_equations_are_refused_by_name() {
    let error = Simulation::new(
        &Door::default(),
        StandardLagrange,
        GeneralizedAlpha::every(1e-3),
    )
    .run(0.0..=1.0, every(0.1), |_| ControlFlow::Continue(()))
    .expect_err("dependent");
    println!("{error}");
    assert!(
        matches!(
            error.fault,
            Fault::Step(StepFault::Singular { name: "upper", .. })
        ),
        "{error}"
    );
}

#[test]
fn settings_that_make_no_sense_are_refused() {
    let run = |method| {
        Simulation::new(&FourBar::default(), StandardLagrange, method)
            .run(0.0..=1.0, every(0.1), |_| ControlFlow::Continue(()))
            .expect_err("no sense")
            .fault
    };
    for rho in [-1e-9, 1.0 + 1e-9, f64::NAN, f64::INFINITY] {
        let fault = run(GeneralizedAlpha::every(1e-3).spectral_radius(rho));
        assert!(
            matches!(fault, Fault::Start(StartFault::SpectralRadius { .. })),
            "{fault}"
        );
    }
    for step in [0.0, -1e-3, f64::NAN, f64::INFINITY] {
        let fault = run(GeneralizedAlpha::every(step));
        assert!(
            matches!(fault, Fault::Start(StartFault::Setting { .. })),
            "{fault}"
        );
    }
}

/// Steps from good ones to such as nothing can be said of: a run is right, or has a warning, or
/// ends with a fault and its last good state.
#[test]
fn long_steps_end_with_a_fault_or_are_warned_of() {
    let rod = RodPendulum::default();
    let mut outcomes = [0_usize; 3];
    for rho in [0.0, 0.8, 1.0] {
        for k in 0..60 {
            let step = 1e-3 * 1.3_f64.powi(k);
            let time = (50.0 * step).max(2.0);
            let outcome = Simulation::new(
                &rod,
                StandardLagrange,
                GeneralizedAlpha::every(step).spectral_radius(rho),
            )
            .run(0.0..=time, every(time), |_| ControlFlow::Continue(()));
            match outcome {
                Ok(report) => {
                    let constants = rod.constants::<f64>().expect("sound");
                    let view = holonom::View::new(&constants, report.time, &report.state);
                    let found = from_vertical(
                        view.angle(RodPendulum::HANDLES.pivot),
                        core::f64::consts::FRAC_PI_2,
                    );
                    let exact = RigidPendulum::CHAPTER_15.at(report.time).angle;
                    let error = wrapped(found - exact).abs();
                    let warned = !report.warnings().is_empty();
                    assert!(warned || error < 0.01, "{rho} {step}: {error}");
                    outcomes[usize::from(warned)] += 1;
                }
                Err(error) => {
                    outcomes[2] += 1;
                    assert!(
                        matches!(
                            error.fault,
                            Fault::Step(
                                StepFault::NotSolved { .. }
                                    | StepFault::Singular { .. }
                                    | StepFault::RatesNotFinite { .. }
                                    | StepFault::StateNotFinite
                            )
                        ),
                        "{rho} {step}: {error}"
                    );
                    assert!(error.state.is_finite(), "{error}");
                }
            }
        }
    }
    println!("{outcomes:?}");
    assert!(outcomes.iter().all(|&count| count > 0), "{outcomes:?}");
}

#[test]
fn stabilisations_and_closures_go_with_it() {
    let model = SliderCrank::default();
    let method = GeneralizedAlpha::every(2e-5);
    let plain = end(&model, method, 0.05).0;
    let treated = Simulation::new(&model, StandardLagrange, method)
        .projection(Projection::default())
        .run(0.0..=0.05, every(0.05), |_| ControlFlow::Continue(()))
        .expect("solvable");
    let difference = apart::<SliderCrank>(&plain, &treated.state);
    println!("{difference:e}");
    // A second order of the step apart: the accelerations of a corrected state are evaluated anew.
    assert!(
        difference < 1e-3 && treated.warnings().is_empty(),
        "{}",
        treated.warnings()
    );
    let pushed = |method: GeneralizedAlpha<f64>| {
        let report = Simulation::new(&FourBar::default(), StandardLagrange, method)
            .forces(|time, _, loads| {
                let force = [3.0 * (5.0 * time).sin(), 0.0, 0.0];
                loads.force(FourBar::HANDLES.left, force);
            })
            .run(0.0..=0.4, every(0.4), |_| ControlFlow::Continue(()))
            .expect("solvable");
        assert!(report.warnings().is_empty(), "{}", report.warnings());
        report.state
    };
    let [coarse, fine, finest] =
        [4e-3, 2e-3, 1e-3].map(|step| pushed(GeneralizedAlpha::every(step)));
    let ratio = apart::<FourBar>(&coarse, &fine) / apart::<FourBar>(&fine, &finest);
    assert!((3.0..5.5).contains(&ratio), "{ratio}");
}

#[test]
fn an_arm_that_is_pulled_beyond_its_reach_stops() {
    for step in [1e-2, 1e-3, 1e-4] {
        let error = Simulation::new(
            &Arm::default(),
            StandardLagrange,
            GeneralizedAlpha::every(step),
        )
        .assembled()
        .run(0.0..=3.0, every(0.1), |_| ControlFlow::Continue(()))
        .expect_err("out of reach");
        println!("{error}");
        assert!((1.95..2.001).contains(&error.time), "{error}");
        assert!(
            matches!(
                error.fault,
                Fault::Step(StepFault::NotSolved { .. } | StepFault::Singular { .. })
            ),
            "{error}"
        );
    }
}

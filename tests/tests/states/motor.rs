//! A motor with its current: every method and formulation, in both coordinates.

use holonom::prelude::*;
use holonom::{
    Adams, AdamsBashforthMoulton4, Bdf, DormandPrince853, ImplicitMidpoint, Kutta3, Midpoint,
    RadauIIA, SemiImplicitEuler,
};

use crate::{Fan, K, L, VOLTAGE, tight};

const R: f64 = 0.5;
const END: f64 = 0.05;

/// How far current (over its largest) and speed are off at the end, and within where shown.
fn errors(sample: &Sample<'_, f64, Fan>) -> f64 {
    let h = Fan::HANDLES;
    let [current, speed] = Fan::closed_form(R, sample.time());
    let off = (sample.state_value(h.current) - current).abs() / 20.0;
    off.max((sample.angle_rate(h.bearing) - speed).abs() / 235.0)
}

/// The error at the end with a method, by bodies and by joints.
macro_rules! ends {
    ($formulation:expr, $integrator:expr) => {{
        let fan = Fan::of(R);
        let mut worst = [0.0_f64; 2];
        fan.simulation($formulation, $integrator)
            .absolute_coordinates()
            .run(0.0..=END, every(END), |sample| {
                worst[0] = worst[0].max(errors(sample));
            })
            .expect("it runs by bodies");
        fan.simulation($formulation, $integrator)
            .joint_coordinates()
            .run(0.0..=END, every(END), |sample| {
                worst[1] = worst[1].max(errors(sample));
            })
            .expect("it runs by joints");
        worst
    }};
}

#[test]
fn current_and_speed_are_those_of_the_closed_form() {
    let fan = Fan::of(R);
    let mut worst = 0.0_f64;
    let report = fan
        .simulation(StandardLagrange, tight())
        .joint_coordinates()
        .run(0.0..=END, every(1e-3), |sample| {
            worst = worst.max(errors(sample));
        })
        .expect("it runs");
    assert!(worst < 1e-11, "{worst:e}");
    assert!(report.warnings().is_empty(), "{:?}", report.warnings());
    for error in ends!(StandardLagrange, tight()) {
        assert!(error < 1e-11, "{error:e}");
    }
}

#[test]
fn formulations_leave_the_rate_as_it_is() {
    // Those of bodies stabilise what joints need not.
    for error in ends!(Baumgarte::new(10.0, 10.0), tight()) {
        assert!(error < 1e-10, "{error:e}");
    }
    for error in ends!(
        AugmentedLagrangian::of(&Fan::of(R)).expect("coefficients"),
        tight()
    ) {
        assert!(error < 1e-9, "{error:e}");
    }
}

#[test]
fn a_closure_beside_it_leaves_the_rate_as_it_is() {
    let fan = Fan::of(R);
    for by_joints in [false, true] {
        let mut worst = 0.0_f64;
        let run = fan
            .simulation(StandardLagrange, tight())
            .forces(|_, _, _| ());
        let mut see = |sample: &Sample<'_, f64, Fan>| worst = worst.max(errors(sample));
        let result = if by_joints {
            run.joint_coordinates().run(0.0..=END, every(END), &mut see)
        } else {
            run.absolute_coordinates()
                .run(0.0..=END, every(END), &mut see)
        };
        result.expect("it runs");
        assert!(worst < 1e-11, "{worst:e}");
    }
}

#[test]
fn methods_keep_their_order() {
    macro_rules! order {
        ($order:expr, $step:expr, $method:expr) => {{
            let method = $method;
            let [coarse, fine] =
                [$step, $step / 2.0].map(|step| ends!(StandardLagrange, method(step)));
            for (coarse, fine) in coarse.into_iter().zip(fine) {
                let found = (coarse / fine).log2();
                assert!(
                    (found - $order).abs() < 0.2,
                    "{}: order {found:.2}, errors {coarse:e} and {fine:e}",
                    stringify!($method)
                );
            }
        }};
    }
    order!(1.0, 1e-4, SemiImplicitEuler::every);
    order!(2.0, 1e-4, Midpoint::every);
    order!(2.0, 1e-4, ImplicitMidpoint::every);
    order!(3.0, 2e-4, Kutta3::every);
    order!(4.0, 2e-4, Rk4::every);
    order!(4.0, 1e-4, AdamsBashforthMoulton4::every);
}

#[test]
fn methods_with_control_come_to_their_tolerance() {
    let tolerance = Tolerance {
        relative: 1e-9,
        absolute: 1e-9,
    };
    for error in [
        ends!(StandardLagrange, DormandPrince853::new(tolerance)),
        ends!(StandardLagrange, RadauIIA::new(tolerance)),
        ends!(StandardLagrange, Bdf::new(tolerance)),
        ends!(StandardLagrange, Adams::new(tolerance)),
    ]
    .concat()
    {
        assert!(error < 1e-6, "{error:e}");
    }
}

#[test]
fn a_stepper_goes_with_the_run() {
    let fan = Fan::of(R);
    let h = Fan::HANDLES;
    let mut stepper = Stepper::new(&fan, StandardLagrange, Rk4)
        .expect("it is sound")
        .joint_coordinates();
    let mut state = stepper.initial_state().expect("sound parameters");
    for _ in 0..500 {
        stepper.step(&mut state, 1e-4).expect("a step");
    }
    let bodies = stepper.bodies(&state);
    let view = stepper.view(&bodies);
    let [current, speed] = Fan::closed_form(R, END);
    assert!((view.state_value(h.current) - current).abs() < 1e-6);
    assert!((view.angle_rate(h.bearing) - speed).abs() < 1e-5);
    // The rate that is read is that of the equation.
    let volts = VOLTAGE - R * view.state_value(h.current) - K * view.angle_rate(h.bearing);
    let rate = volts / L;
    assert!((view.state_rate(h.current) - rate).abs() < 1e-9 * rate.abs());
}

#[test]
fn it_runs_in_single_precision() {
    let fan = Fan::of(R);
    let mut end = [0.0_f32; 2];
    Simulation::new(&fan, StandardLagrange, Rk4::every(1e-4_f32))
        .run(0.0..=END as f32, every(END as f32), |sample| {
            end = [
                sample.state_value(Fan::HANDLES.current),
                sample.angle_rate(Fan::HANDLES.bearing),
            ];
        })
        .expect("it runs");
    let [current, speed] = Fan::closed_form(R, END);
    assert!((f64::from(end[0]) - current).abs() < 1e-3);
    assert!((f64::from(end[1]) - speed).abs() < 1e-2);
}

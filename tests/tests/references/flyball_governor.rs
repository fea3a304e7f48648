//! A05: the stiff flyball governor.

use core::f64::consts::FRAC_PI_6;

use holonom::RadauIIA;
use holonom::error::StepFault;
use holonom::prelude::*;
use holonom_models::FlyballGovernor;
use holonom_tests::is_exhaustive;

use super::{at_times, simpson, tight};

/// The height of the slider (m): by Radau and by Dormand-Prince 8(5,3) in minimal coordinates,
/// which agree to 5e-13.
const TIMES: [f64; 5] = [0.5, 1.0, 2.0, 5.0, 10.0];
const HEIGHT: [f64; 5] = [
    0.743_249_424_786_323,
    0.501_420_922_379_569,
    0.505_909_294_296_706,
    0.535_563_103_721_642,
    0.619_622_917_061_363,
];

/// At 10 s: `alpha` (rad), `alpha'` (rad/s), `s'` (m/s).
const LAST: [f64; 3] = [
    0.390_073_701_844_65,
    0.808_467_051_345_59,
    -0.747_603_354_164_5,
];

fn governs<F: Formulation<f64>>(method: F) {
    /// m, rad, m/s, rad/s.
    const ASKED: f64 = 1e-9;
    let handles = FlyballGovernor::HANDLES;
    at_times(
        &FlyballGovernor::default(),
        method,
        0.5,
        // Explicit steps are short: three hundred thousand to the end.
        &TIMES[..if is_exhaustive() { TIMES.len() } else { 2 }],
        |place, sample| {
            let height = (sample.pose(handles.slider).position.z - HEIGHT[place]).abs();
            println!("{height:e} m at {} s", sample.time());
            assert!(height <= ASKED);
            if sample.time() == 10.0 {
                for hinge in [handles.right_hinge, handles.left_hinge] {
                    let alpha = (sample.angle(hinge) + FRAC_PI_6 - LAST[0]).abs();
                    let rate = (sample.angle_rate(hinge) - LAST[1]).abs();
                    println!("{alpha:e} rad, {rate:e} rad/s");
                    assert!(alpha <= ASKED && rate <= 10.0 * ASKED);
                }
                let speed = (sample.velocity(handles.slider).z - LAST[2]).abs();
                assert!(speed <= 10.0 * ASKED, "{speed:e} m/s");
            }
        },
    );
}

#[test]
fn it_governs_as_its_reference() {
    governs(StandardLagrange);
    governs(Baumgarte::default());
}

#[test]
fn implicit_steps_are_as_long_as_its_slow_motion() {
    /// m.
    const ASKED: f64 = 1e-8;
    /// Explicit ones are shorter than 3.4e-4 s: thirty thousand.
    const STEPS: usize = 1000;
    let tolerance = Tolerance {
        relative: 3e-8,
        absolute: 3e-11,
    };
    let mut seen = 0;
    let report = Simulation::new(
        &FlyballGovernor::default(),
        StandardLagrange,
        RadauIIA::new(tolerance),
    )
    .joint_coordinates()
    .run(0.0..=10.0, every(0.5), |sample| {
        let here = |time: &f64| (time - sample.time()).abs() < 0.1;
        if let Some(place) = TIMES.iter().position(here) {
            let height = sample.pose(FlyballGovernor::HANDLES.slider).position.z;
            let error = (height - HEIGHT[place]).abs();
            println!("{error:e} m at {} s", sample.time());
            assert!(error <= ASKED);
            seen += 1;
        }
        ControlFlow::Continue(())
    })
    .expect("solvable");
    println!(
        "{} steps, {} evaluations",
        report.accepted, report.evaluations
    );
    assert_eq!(seen, TIMES.len());
    assert!(report.accepted + report.rejected <= STEPS);
    assert!(report.warnings().is_empty(), "{}", report.warnings());
}

#[test]
fn the_work_of_the_dampers_is_what_the_energy_loses() {
    /// The dampers (N s/m); the transients of 1e-4 s at the start are resolved.
    const DAMPING: f64 = 4e4;
    const STEP: f64 = 2.5e-5;
    /// J, of 239 J.
    const ASKED: f64 = 1e-8;
    let h = FlyballGovernor::HANDLES;
    let (mut power, mut energy) = (Vec::new(), Vec::new());
    Simulation::new(&FlyballGovernor::default(), StandardLagrange, tight())
        .run(0.0..=0.25, every(STEP), |sample| {
            let ends = [(h.right_arm, 0.05), (h.left_arm, -0.05)];
            let sum: f64 = ends
                .map(|(arm, side)| {
                    let middle = FlyballGovernor::MIDDLE.into();
                    let pin = [side, 0.0, 0.0].into();
                    let arrow = sample.point(arm, middle) - sample.point(h.slider, pin);
                    let velocity =
                        sample.point_velocity(arm, middle) - sample.point_velocity(h.slider, pin);
                    let rate = arrow.dot(&velocity) / arrow.norm();
                    DAMPING * rate * rate
                })
                .iter()
                .sum();
            // As the mechanism itself tells it; W, of some 20 W at most.
            assert!(
                (sample.power() + sum).abs() <= 1e-9,
                "{:e}",
                sample.power() + sum
            );
            power.push(sum);
            energy.push(sample.energy());
            ControlFlow::Continue(())
        })
        .expect("solvable");
    // Kinetic and potential energy of the data, from the height 0.
    assert!((energy[0] - 169.234_450_441_526 - 69.651).abs() <= 1e-11 * energy[0]);
    let lost = energy[0] - energy[energy.len() - 1];
    let work = simpson(STEP, &power);
    println!("lost {lost:e} J, work {work:e} J");
    assert!((lost - work).abs() <= ASKED);
    assert!(lost > 1e-3, "nothing is lost");
}

#[test]
fn it_keeps_its_angular_momentum() {
    // About the free axis: shaft and slider (their inertia about z), and the arms as they stand
    // out.
    const MOMENTUM: f64 = 53.868_998_658_418_4;
    let h = FlyballGovernor::HANDLES;
    at_times(
        &FlyballGovernor::default(),
        StandardLagrange,
        0.25,
        &[0.25, 0.5],
        |_, sample| {
            let mut sum = (0.3 * 2e-4 / 12.0 + 0.005) * sample.angular_velocity_global(h.shaft).z;
            for arm in [h.right_arm, h.left_arm] {
                let (r, v) = (sample.pose(arm).position, sample.velocity(arm));
                let w = sample.angular_velocity(arm);
                let across = 0.3 * 1.0001 / 12.0 + 0.3 * 5.0 / 5.3 * 0.25;
                let spin =
                    nalgebra::Vector3::new(0.3 * 2e-4 / 12.0 * w.x, across * w.y, across * w.z);
                let p = nalgebra::UnitQuaternion::new_normalize(sample.pose(arm).orientation);
                sum += 5.3 * (r.x * v.y - r.y * v.x) + (p * spin).z;
            }
            println!("{:e}", sum - MOMENTUM);
            assert!((sum - MOMENTUM).abs() <= 1e-10 * MOMENTUM);
        },
    );
}

/// An unstable method throws the ends of the springs across each other. That is no law that holds a
/// length at zero.
#[test]
fn steps_that_are_too_long_for_the_springs_are_named() {
    let governor = FlyballGovernor::default();
    // At some of these a length of zero is met where numbers tell no place from another.
    for step in [0.01, 5.14e-3, 5.11e-3, 5e-3, 4.87e-3, 2e-3] {
        let run = || governor.simulation(Baumgarte::new(10.0, 10.0), Rk4::every(step));
        let [bodies, joints] = [
            run()
                .absolute_coordinates()
                .run(0.0..=1.0, every(0.1), |_| ()),
            run().joint_coordinates().run(0.0..=1.0, every(0.1), |_| ()),
        ];
        for run in [bodies, joints] {
            match run {
                Ok(report) => assert!(!report.warnings().is_empty(), "{step} s is silent"),
                Err(error) => assert_eq!(error.fault, Fault::Step(StepFault::Unstable { step })),
            }
        }
    }
}

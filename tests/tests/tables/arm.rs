//! Inverse dynamics of a recorded motion of the UR5, against the recursion of Newton and Euler of
//! Pinocchio (`rnea`).

use holonom::prelude::*;
use holonom::spline::uniform_knots;

use super::data::{AXES, CENTRES, EFFORTS, MASSES, MOMENTS, POINTS, RECORDED, TIMES};

/// The arm, each hinge driven by a record and by what is told from outside, one added to the other.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Arm {
    #[param]
    recorded: [Spline<41>; 6],
    #[input(order = 2)]
    told: [Setpoint; 6],
    #[body(
        mass = MASSES[k],
        inertia = [MOMENTS[k][0], MOMENTS[k][1], MOMENTS[k][2]],
        position = [CENTRES[k][0], CENTRES[k][1], CENTRES[k][2]]
    )]
    links: [Body; 6],
    #[joint(
        between = [if k == 0 { ground } else { links[k - 1] }, links[k]],
        point = [POINTS[k][0], POINTS[k][1], POINTS[k][2]],
        axis = [AXES[k][0], AXES[k][1], AXES[k][2]]
    )]
    hinges: [Revolute; 6],
    #[joint(
        between = [if k == 0 { ground } else { links[k - 1] }, links[k]],
        axis = [AXES[k][0], AXES[k][1], AXES[k][2]],
        motion = recorded[k](time) + told[k]
    )]
    motors: [AngleDriver; 6],
}

fn record(scale: f64) -> [Spline<41>; 6] {
    RECORDED.map(|angles| {
        Spline::clamped(
            uniform_knots(0.0, 2.0),
            angles.map(|angle| scale * angle),
            [0.0; 2],
        )
    })
}

/// The largest difference of the driving efforts from the reference (N m).
fn difference(sample: &Sample<'_, f64, Arm>, expected: &[f64; 6]) -> f64 {
    let efforts = Arm::HANDLES.motors.map(|motor| {
        let effort = sample.driving_effort(motor);
        effort.expect("a driver has an effort")
    });
    let differences = efforts.iter().zip(expected).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max)
}

/// As a record in the mechanism: kinematics at every time of the reference.
#[test]
fn a_record_takes_the_moments_of_pinocchio() {
    let arm = Arm::new(record(1.0)).expect("six splines");
    let (mut count, mut worst) = (0, 0.0_f64);
    let report = KinematicAnalysis::new(&arm, StandardLagrange)
        .run(0.0..=2.0, every(0.2), |sample| {
            let place = TIMES
                .iter()
                .position(|time| (time - sample.time()).abs() < 1e-9);
            let expected = &EFFORTS[place.expect("a time of the reference")];
            worst = worst.max(difference(sample, expected));
            count += 1;
        })
        .expect("the drivers leave no freedom");
    assert_eq!(count, TIMES.len());
    // Moments of 80 N m.
    assert!(worst < 1e-10, "{worst}");
    assert!(report.warnings().is_empty());
}

/// Told from outside, time by time, half of it or all: the rest is a record.
#[test]
fn what_is_told_from_outside_takes_them_too() {
    for share in [0.5, 1.0] {
        let told = record(share);
        let mut arm = Arm::new(record(1.0 - share)).expect("six splines");
        let mut state = None;
        for (time, expected) in TIMES.iter().zip(&EFFORTS) {
            for (input, spline) in arm.told.iter_mut().zip(&told) {
                *input = Setpoint {
                    value: spline.value(*time),
                    rate: spline.slope(*time),
                    acceleration: spline.curvature(*time),
                };
            }
            let mut analysis = KinematicAnalysis::new(&arm, StandardLagrange);
            if let Some(state) = state {
                analysis = analysis.initial_state(state);
            }
            let mut worst = f64::NAN;
            let report = analysis.run(*time..=*time, every_step(), |sample| {
                worst = difference(sample, expected);
            });
            state = Some(report.expect("near the pose before").state);
            assert!(worst < 1e-10, "{worst} at {time}");
        }
    }
}

/// The same motion as a run in joint coordinates, whose drivers close loops.
#[test]
fn a_run_in_joint_coordinates_follows_the_record() {
    let arm = Arm::new(record(1.0)).expect("six splines");
    let tolerance = Tolerance {
        relative: 1e-9,
        absolute: 1e-9,
    };
    let (mut count, mut worst, mut off) = (0, 0.0_f64, 0.0_f64);
    Simulation::new(&arm, StandardLagrange, DormandPrince::new(tolerance))
        .joint_coordinates()
        .run(0.0..=2.0, every(0.2), |sample| {
            let place = TIMES
                .iter()
                .position(|time| (time - sample.time()).abs() < 1e-9);
            worst = worst.max(difference(
                sample,
                &EFFORTS[place.expect("a time of the reference")],
            ));
            for (hinge, spline) in Arm::HANDLES.motors.iter().zip(&arm.recorded) {
                let angle = sample.angle(*hinge);
                off = off.max((angle - spline.value(sample.time())).abs());
            }
            count += 1;
        })
        .expect("drivers in joint coordinates");
    assert_eq!(count, TIMES.len());
    assert!(off < 1e-6 && worst < 1e-4, "{off} rad, {worst} N m");
}

#[test]
fn inputs_of_order_two_are_set_together() {
    let mut arm = Arm::new(record(0.0)).expect("six splines");
    assert_eq!(arm.told[3], Setpoint::default());
    arm.told[3].rate = f64::NAN;
    let error = KinematicAnalysis::new(&arm, StandardLagrange)
        .run(0.0..=1.0, every(0.5), |_| ())
        .expect_err("the rate is none");
    assert!(
        error
            .to_string()
            .contains("`rate` of `told[3]` must be finite"),
        "{error}"
    );
    let mut broken = record(1.0);
    broken[2] = Spline::natural([0.0; 41], [0.0; 41]);
    let error = Arm::new(broken).expect_err("its knots do not increase");
    assert_eq!(
        error.to_string(),
        "`recorded[2]` is no spline: each knot must be above the one before it"
    );
}

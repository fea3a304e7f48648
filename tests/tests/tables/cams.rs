//! A cam from a table of 36 points, as a driver.

use core::f64::consts::TAU;

use holonom::prelude::*;
use holonom::spline::uniform_knots;

use super::data::{CAM, CAM_TIMES, LIFT};

/// The lift (m) over the angle of the shaft; the 37th point is the first one.
static CAM_TABLE: Spline<37> = Spline::periodic(uniform_knots(0.0, TAU), LIFT);

#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Follower {
    #[body(mass = 2.0)]
    tappet: Particle,
    #[joint(between = [ground, tappet], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    guide: PointOnLine,
    #[joint(
        between = [ground, tappet], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0],
        motion = CAM_TABLE(4.0 * time)
    )]
    cam: DisplacementDriver,
}

/// Position, velocity and acceleration of the tappet; the last by the force on it.
fn motion(time: f64) -> [f64; 3] {
    let handles = Follower::HANDLES;
    let mut motion = [f64::NAN; 3];
    KinematicAnalysis::new(&Follower::default(), StandardLagrange)
        .run(time..=time, every_step(), |sample| {
            let effort = sample.driving_effort(handles.cam).expect("of a driver");
            motion = [
                sample.pose(handles.tappet).position.z,
                sample.velocity(handles.tappet).z,
                effort / 2.0 - 9.81,
            ];
        })
        .expect("the driver leaves no freedom");
    motion
}

#[test]
fn a_follower_moves_as_its_table_says() {
    for (time, expected) in CAM_TIMES.into_iter().zip(CAM) {
        for (found, expected) in motion(time).into_iter().zip(expected) {
            let difference = (found - expected).abs();
            assert!(difference < 1e-12, "{time}: {found}, {expected}");
        }
    }
}

#[test]
fn its_acceleration_is_continuous_at_every_point_of_the_table() {
    let mut third = 0.0_f64;
    for point in 1..36 {
        let at = TAU / 36.0 * f64::from(point) / 4.0;
        let [before, after, later] = [-1e-7, 1e-7, 3e-7].map(|beside| motion(at + beside)[2]);
        let (over, beside) = (after - before, later - after);
        // As much over the knot as beside it.
        assert!(over.abs() < 1e-3, "{point}: {over}");
        third = third.max((over - beside).abs());
    }
    // The third derivative does jump.
    assert!(third > 1e-6, "{third}");
}

#[test]
fn single_precision_reads_the_same_table() {
    let handles = Follower::HANDLES;
    let mut heights = Vec::new();
    KinematicAnalysis::new(&Follower::default(), StandardLagrange)
        .run(0.0_f32..=3.0, every(0.25), |sample| {
            heights.push((sample.time(), sample.pose(handles.tappet).position.z));
        })
        .expect("the driver leaves no freedom");
    assert_eq!(heights.len(), 13);
    for (time, height) in heights {
        let expected = CAM_TABLE.value(4.0 * f64::from(time));
        assert!(
            (f64::from(height) - expected).abs() < 1e-6,
            "{time}: {height}, {expected}"
        );
    }
}

mod parts {
    //! An assembly whose table has the name of another one beside the mechanism.

    use super::*;

    /// A tappet with its cam, whose table is its own.
    #[derive(Assembly, Clone, Copy)]
    pub(super) struct Lifter {
        #[port]
        frame: Body,
        #[body(mass = 0.5, position = [0.0, 0.0, 0.1])]
        pub(super) tappet: Particle,
        #[joint(between = [frame, tappet], point = [0.0, 0.0, 0.1], axis = [0.0, 0.0, 1.0])]
        guide: PointOnLine,
        #[joint(
            between = [frame, tappet], point = [0.0, 0.0, 0.1], axis = [0.0, 0.0, 1.0],
            motion = RISE(time)
        )]
        cam: DisplacementDriver,
    }

    pub(super) const RISE: Spline<3> =
        Spline::clamped([0.0, 1.0, 2.0], [0.0, 0.1, 0.3], [0.0, 0.0]).held();
}

const RISE: Spline<2> = Spline::natural([0.0, 1.0], [0.0, 7.0]);

#[derive(Mechanism)]
struct Pair {
    #[part(at = [0.0, 0.0, 0.0], frame = ground)]
    left: parts::Lifter,
    #[body(mass = 0.5)]
    other: Particle,
    #[joint(between = [ground, other], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    guide: PointOnLine,
    #[joint(
        between = [ground, other], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0],
        motion = RISE(time)
    )]
    cam: DisplacementDriver,
}

#[test]
fn an_assembly_reads_its_own_table() {
    let handles = Pair::HANDLES;
    KinematicAnalysis::new(&Pair::default(), StandardLagrange)
        .run(0.0..=3.0, every(0.25), |sample| {
            let time: f64 = sample.time();
            let own = sample.pose(handles.left.tappet).position.z - 0.1;
            assert!((own - parts::RISE.value(time)).abs() < 1e-12);
            let other = sample.pose(handles.other).position.z;
            assert!((other - 7.0 * time).abs() < 1e-12);
        })
        .expect("both are driven");
    assert_eq!(RISE.value(0.5), 3.5);
}

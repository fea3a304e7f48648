//! Screws that carry bodies: a jack in a loop, a feed of a pitch that is known at run time, angles
//! and displacements that are set over many turns.

use core::f64::consts::TAU;

use holonom::error::StartFault;
use holonom::forces::TorsionalSpringDamper;
use holonom::joints::{Revolute, Screw, Spherical};
use holonom::prelude::*;
use holonom::{JointCoordinates, dynamics::Dynamics, error::Fault, mechanism::Freedom};
use nalgebra::Vector3;

use crate::descriptions::{both, both_under, reaction};

/// A boom that a screw jack lifts, of a thread so steep that the boom turns the spindle.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints", redundant = "drop")]
struct Jack {
    #[body(mass = 20.0, inertia = [6.0, 6.0, 0.2], position = [0.9, 0.0, 0.5])]
    boom: Body,
    #[body(mass = 3.0, inertia = [0.1, 0.1, 0.02], position = [0.65, 0.0, 0.1])]
    tube: Body,
    #[body(mass = 2.0, inertia = [0.08, 0.08, 0.05], position = [0.8, 0.0, 0.3])]
    spindle: Body,
    #[joint(between = [ground, boom], point = [0.0, 0.0, 0.5], axis = [0.0, 1.0, 0.0])]
    shoulder: Revolute,
    #[joint(between = [ground, tube], point = [0.6, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    foot: Revolute,
    #[joint(between = [tube, spindle], point = [0.6, 0.0, 0.0], axis = [0.3, 0.0, 0.4], pitch = 0.2)]
    thread: Screw,
    #[joint(between = [spindle, boom], point = [0.9, 0.0, 0.4])]
    head: Spherical,
}

/// A spindle in a nut of the ground carries an arm, and that another nut. A spring counts the turns
/// of the spindle as well.
#[derive(Mechanism)]
#[mechanism(gravity = [0.3, -0.2, -9.81], coordinates = "joints")]
struct Feed {
    #[param]
    pitch: f64,
    #[body(mass = 1.0, inertia = [0.02, 0.03, 0.04], position = [0.05, 0.0, 0.5])]
    spindle: Body,
    #[body(mass = 0.6, inertia = [0.02, 0.01, 0.025], position = [0.3, 0.1, 0.5])]
    arm: Body,
    #[body(mass = 0.4, inertia = [0.01, 0.012, 0.015], position = [0.5, 0.3, 0.4])]
    nut: Body,
    #[joint(between = [spindle, ground], point = [0.0, 0.0, 0.3], axis = [0.1, 0.0, 1.0], pitch = pitch)]
    thread: Screw,
    #[joint(between = [spindle, arm], point = [0.2, 0.0, 0.5], axis = [0.1, 0.0, 1.0])]
    hinge: Revolute,
    #[joint(between = [arm, nut], point = [0.4, 0.2, 0.4], axis = [0.0, 1.0, 0.0], pitch = -2.0 * pitch)]
    counter: Screw,
    #[force(between = [ground, spindle], axis = [0.1, 0.0, 1.0], stiffness = 0.4, damping = 0.02)]
    spring: TorsionalSpringDamper,
}

/// Threads in motion, the first one turned over and over.
fn started(feed: &Feed) -> <Feed as Mechanism>::State<f64> {
    let mut start = feed.described_state().expect("described");
    let handles = Feed::HANDLES;
    let set = [
        feed.set_angle(&mut start, handles.thread, 15.0),
        feed.set_angle_rate(&mut start, handles.thread, -2.0),
        feed.set_angle_rate(&mut start, handles.hinge, 3.0),
        feed.set_angle_rate(&mut start, handles.counter, 1.0),
    ];
    set.into_iter()
        .for_each(|set| set.expect("all of them move"));
    start
}

#[test]
fn the_equations_of_a_screw_disappear_from_its_loop() {
    let report = Jack::JOINT_REPORT;
    assert_eq!(report.closing, ["head", "head"]);
    let thread = report.motions_of("thread").next().expect("it carries");
    assert!(matches!(
        report.motions[thread].freedom,
        Freedom::Screw { .. }
    ));
    let handles = Jack::HANDLES;
    let read = |sample: &Sample<'_, f64, Jack>| {
        let mut values = vec![
            sample.angle(handles.thread),
            sample.angle_rate(handles.thread),
            sample.displacement(handles.thread),
            sample.angle(handles.shoulder),
        ];
        // In the plane of the motion, where all that is determined.
        let [x, _, z, ..] = reaction(sample, handles.head, handles.boom);
        values.extend([x, z]);
        values
    };
    let jack = Jack::default();
    let start = jack.described_state().expect("described");
    both(&jack, StandardLagrange, start, 1e-7, read);
    both(&jack, Baumgarte::default(), start, 1e-7, read);
    both(&jack, AugmentedLagrangian::default(), start, 1e-6, read);
}

#[test]
fn a_feed_of_a_pitch_at_run_time() {
    assert!(Feed::JOINT_REPORT.closing.is_empty());
    let handles = Feed::HANDLES;
    let read = |sample: &Sample<'_, f64, Feed>| {
        let mut values = vec![
            sample.angle(handles.thread),
            sample.displacement(handles.thread),
            sample.displacement_rate(handles.counter),
            sample.angle(handles.hinge),
            sample.kinetic_energy(),
        ];
        values.extend(reaction(sample, handles.thread, handles.spindle));
        values.extend(reaction(sample, handles.counter, handles.nut));
        values
    };
    for pitch in [0.05, -1.3, 0.0] {
        let feed = Feed::new(pitch).expect("acceptable");
        let start = started(&feed);
        both(&feed, StandardLagrange, start, 1e-7, read);
        let law = |time: f64, state: &_, loads: &mut Loads<'_, f64, Feed>| {
            let drag: Vector3<f64> = Feed::velocity(state, handles.nut) * -0.3;
            loads.force(handles.nut, drag.into());
            loads.force_at(handles.arm, [0.1, 0.0, 0.0], [0.0, 1.0, 2.0 * time]);
            loads.moment(handles.spindle, [0.1, 0.2, 0.3]);
        };
        both_under(&feed, StandardLagrange, start, law, read);
    }
}

#[test]
fn displacements_go_with_all_turns() {
    const PITCH: f64 = 0.02;
    let feed = Feed::new(PITCH).expect("acceptable");
    let stepper = feed
        .stepper(StandardLagrange, Rk4)
        .expect("one")
        .joint_coordinates();
    let thread = Feed::HANDLES.thread;
    let mut state = started(&feed);
    for turns in [3.25, 100.5, -40.0] {
        let angle = TAU * turns;
        feed.set_angle(&mut state, thread, angle).expect("it turns");
        feed.set_angle_rate(&mut state, thread, 7.0)
            .expect("it turns");
        for _ in 0..2 {
            let view = stepper.view(&state);
            assert!((view.angle(thread) - angle).abs() < 1e-11);
            assert!((view.displacement(thread) - PITCH * turns).abs() < 1e-13);
            assert!((view.displacement_rate(thread) - PITCH * 7.0 / TAU).abs() < 1e-13);
            assert!(view.violation() < 1e-24);
            // There and back.
            let joints = stepper.state_of(&state).expect("it is closed");
            let report = Feed::JOINT_REPORT;
            let place = report.motions_of("thread").next().expect("it carries");
            let counted = report.coordinate(place, &joints).expect("an angle");
            assert!((counted - angle).abs() < 1e-11);
            state = stepper.bodies(&joints);
        }
        // And by the displacement.
        feed.set_displacement(&mut state, thread, PITCH * (turns + 2.0))
            .expect("it moves");
        feed.set_displacement_rate(&mut state, thread, PITCH)
            .expect("it moves");
        let view = stepper.view(&state);
        assert!((view.angle(thread) - angle - 2.0 * TAU).abs() < 1e-11);
        assert!((view.angle_rate(thread) - TAU).abs() < 1e-12);
        assert!(view.violation() < 1e-24);
    }
}

/// Pair and unwrapped angle are two sums of the same increments, which round differently.
#[test]
fn a_screw_stays_on_its_thread_in_single_precision() {
    let feed = Feed::new(0.02).expect("acceptable");
    let mut stepper = Stepper::<Problem<_, _, f32>, _>::new(&feed, StandardLagrange, Rk4)
        .expect("one")
        .joint_coordinates();
    let mut start = feed.described_state::<f32>().expect("described");
    let set = feed.set_angle(&mut start, Feed::HANDLES.thread, 200.0);
    set.expect("it turns");
    let mut state = stepper.state_of(&start).expect("it is closed");
    let report = Feed::JOINT_REPORT;
    let place = report.motions_of("thread").next().expect("it carries");
    let motion = report.motions[place];
    let mut worst = 0.0_f64;
    for _ in 0..20_000 {
        stepper.step(&mut state, 1e-3).expect("regular");
        let counted = f64::from(report.coordinate(place, &state).expect("an angle"));
        let [c, s] = state.pairs()[motion.coordinate].map(f64::from);
        let angle = s.atan2(c) - motion.zero;
        let off = counted - if motion.is_reversed() { -angle } else { angle };
        worst = worst.max((off - TAU * (off / TAU).round()).abs());
    }
    assert!(worst < 4.0 * 200.0 * f64::from(f32::EPSILON), "{worst:e}");
}

/// What lies beside its thread is no state of the joints.
#[test]
fn a_nut_beside_its_thread_is_refused() {
    let feed = Feed::new(0.02).expect("acceptable");
    let mut state = feed.described_state::<f64>().expect("described");
    let mut pose = Feed::pose(&state, Feed::HANDLES.spindle);
    pose.position += Vector3::new(1e-3, 0.0, 1e-2);
    Feed::set_pose(&mut state, Feed::HANDLES.spindle, pose);
    let dynamics = Dynamics::<Problem<_, _>>::new(&feed, StandardLagrange)
        .expect("one")
        .joint_coordinates();
    let refused = dynamics.state_of(&state).expect_err("it is open");
    assert!(
        matches!(refused, Fault::Start(StartFault::Inconsistent { .. })),
        "{refused}"
    );
}

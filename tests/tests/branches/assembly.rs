//! What is set by `set_angle` is kept by `assemble`, on the branch of the description.

use holonom::error::AssemblyFault;
use holonom::joints::{Cylindrical, Distance, Revolute, Spherical};
use holonom::{View, constraints::Correction};

use holonom::prelude::*;

use super::linkages::{CRANK_ROCKER, DrivenFourBar, FourBar, Lengths, Random, wrapped};

/// Assembles a four-bar from its description with the crank at an angle; what crank and rocker are
/// off by.
fn assembled(lengths: Lengths, angle: f64) -> (f64, f64, Correction<f64>) {
    let mechanism = lengths.four_bar();
    let handles = FourBar::HANDLES;
    let constants = mechanism.constants().expect("lengths");
    let mut state = mechanism.described_state::<f64>().expect("lengths");
    mechanism
        .set_angle(&mut state, handles.a, angle)
        .expect("it carries the crank");
    let correction = mechanism
        .assemble(0.0, &mut state)
        .unwrap_or_else(|fault| panic!("{lengths:?} at {angle}: {fault}"));
    let view = View::new(&constants, 0.0, &state);
    let crank = wrapped(view.angle(handles.a) - angle).abs();
    (
        crank,
        lengths.error(angle, view.angle(handles.d)),
        correction,
    )
}

#[test]
fn every_angle_of_a_crank_is_assembled_on_its_own_branch() {
    for degrees in (0..360).step_by(5) {
        let angle = f64::from(degrees).to_radians();
        let (crank, rocker, correction) = assembled(CRANK_ROCKER, angle);
        assert!(crank < 1e-9, "{degrees}: the crank is off by {crank}");
        assert!(rocker < 1e-9, "{degrees}: the rocker is off by {rocker}");
        let moved = correction.moved.expect("of an assembly");
        assert_eq!(moved.passed, None);
        assert!(correction.violation_after < 1e-24);
        assert_eq!(moved.steps > 0, degrees > 0);
    }
}

/// Masses are no matter of where bodies stand: a light crank takes along what it carries.
#[test]
fn what_was_set_is_kept_where_the_crank_is_light() {
    for mass in [1e3, 1e-3, 1e-5, 1e-7, 1e-9] {
        for angle in [0.3, -1.0, 2.5] {
            let mut mechanism = CRANK_ROCKER.four_bar();
            mechanism.mass = mass;
            let handles = FourBar::HANDLES;
            let mut state = mechanism.described_state::<f64>().expect("lengths");
            mechanism
                .set_angle(&mut state, handles.a, angle)
                .expect("it carries the crank");
            mechanism
                .assemble(0.0, &mut state)
                .unwrap_or_else(|fault| panic!("{mass} at {angle}: {fault}"));
            let view = mechanism.view(0.0, &state).expect("finite");
            let crank = wrapped(view.angle(handles.a) - angle).abs();
            let rocker = CRANK_ROCKER.error(angle, view.angle(handles.d));
            assert!(
                crank < 1e-14,
                "{mass} at {angle}: the crank is off by {crank:e}"
            );
            assert!(
                rocker < 1e-13,
                "{mass} at {angle}: the rocker is off by {rocker:e}"
            );
        }
    }
}

#[test]
fn a_small_turn_is_kept_as_well() {
    for angle in [1e-6, 1e-4, 2e-3, -0.02] {
        let (crank, rocker, _) = assembled(CRANK_ROCKER, angle);
        assert!(crank < 1e-9 && rocker < 1e-9, "{angle}: {crank}, {rocker}");
    }
}

/// A crank and a rocker about axes that cross in one point, where the rod between them has no hold
/// on the rocker.
#[derive(Mechanism)]
struct Slack {
    #[body(mass = 1.0, inertia = [0.02, 0.02, 0.02], position = [0.2, 0.0, 0.0])]
    crank: Body,
    #[body(mass = 1.0, inertia = [0.05, 0.05, 0.05], position = [0.0, 0.3, 0.0])]
    rocker: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    a: Revolute,
    #[joint(between = [ground, rocker], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    d: Revolute,
    #[joint(between = [crank, rocker], head = [0.4, 0.0, 0.0], tail = [0.0, 0.6, 0.0])]
    rod: Distance,
}

#[test]
fn what_cannot_begin_to_move_is_refused_by_name() {
    let mechanism = Slack::default();
    let mut state = mechanism.described_state::<f64>().expect("literals");
    mechanism
        .set_angle(&mut state, Slack::HANDLES.a, 0.5)
        .expect("it carries the crank");
    let fault = mechanism.assemble(0.0, &mut state).expect_err("no way");
    assert!(
        matches!(
            fault,
            Fault::Assembly(AssemblyFault::WayEnds {
                joint: Some("a"),
                ..
            })
        ),
        "{fault}"
    );
}

#[test]
fn an_assembly_says_what_it_moved_most() {
    let (_, _, correction) = assembled(CRANK_ROCKER, 2.0);
    let moved = correction.moved.expect("of an assembly");
    // The coupler hung on the crank and was turned with it.
    assert_eq!((moved.body, moved.joint), ("coupler", Some("b")));
    assert!(moved.angle > 1.0, "{moved:?}");
}

#[test]
fn random_crank_rockers_are_assembled_on_their_own_branch() {
    let mut random = Random(1);
    for _ in 0..60 {
        let lengths = random.crank_rocker();
        for _ in 0..3 {
            let angle = random.within(-12.0, 12.0);
            let (crank, rocker, _) = assembled(lengths, angle);
            assert!(crank < 1e-7 && rocker < 1e-7, "{lengths:?} at {angle}");
        }
    }
}

#[test]
fn a_driver_leads_the_way_whether_its_angle_is_set_or_not() {
    let mechanism = CRANK_ROCKER.driven();
    let handles = DrivenFourBar::HANDLES;
    let constants = mechanism.constants().expect("lengths");
    for degrees in (0..360).step_by(5) {
        for is_set in [false, true] {
            let time = f64::from(degrees).to_radians();
            let mut state = mechanism.described_state::<f64>().expect("lengths");
            if is_set {
                mechanism
                    .set_angle(&mut state, handles.a, time)
                    .expect("it carries the crank");
            }
            mechanism.assemble(time, &mut state).expect("a way");
            let view = View::new(&constants, time, &state);
            let off = CRANK_ROCKER.error(time, view.angle(handles.d));
            assert!(off < 1e-9, "{degrees}, {is_set}: {off}");
            assert!((view.angle(handles.motor) - time).abs() < 1e-9);
        }
    }
}

#[test]
fn a_rocker_beyond_its_limit_is_refused_by_name() {
    let mechanism = CRANK_ROCKER.four_bar();
    let handles = FourBar::HANDLES;
    let described = mechanism.described_state::<f64>().expect("lengths");
    let mut state = described;
    mechanism
        .set_angle(&mut state, handles.d, 2.5)
        .expect("it carries the rocker");
    let given = state;
    let fault = mechanism
        .assemble(0.0, &mut state)
        .expect_err("no such configuration");
    let Fault::Assembly(AssemblyFault::WayEnds { joint, share }) = fault else {
        panic!("{fault}");
    };
    assert_eq!(joint, Some("d"), "{fault}");
    assert!(share > 0.1 && share < 0.9, "{fault}");
    assert!(fault.to_string().contains("joint `d`"), "{fault}");
    assert_eq!(state, given);
    // Within its limits it is kept.
    let mut state = described;
    mechanism
        .set_angle(&mut state, handles.d, 0.3)
        .expect("it carries the rocker");
    mechanism.assemble(0.0, &mut state).expect("a way");
    let constants = mechanism.constants().expect("lengths");
    let view = View::new(&constants, 0.0, &state);
    assert!((view.angle(handles.d) - 0.3).abs() < 1e-9);
    let off = CRANK_ROCKER.error(view.angle(handles.a), view.angle(handles.d));
    assert!(off < 1e-9, "{off}");
}

#[test]
fn a_state_to_start_from_says_which_branch() {
    let mechanism = CRANK_ROCKER.four_bar();
    let handles = FourBar::HANDLES;
    let constants = mechanism.constants().expect("lengths");
    let mirrored = Lengths {
        sign: -1.0,
        ..CRANK_ROCKER
    };
    // The other branch: the mirror image of the description, both pins turned over.
    let mut other = mechanism.described_state::<f64>().expect("lengths");
    let turn = mirrored.rocker(0.0) - CRANK_ROCKER.rocker(0.0);
    mechanism
        .set_angle(&mut other, handles.d, turn)
        .expect("it carries the rocker");
    let [_, _, rocker, base] = CRANK_ROCKER.links;
    let direction = |lengths: Lengths| {
        let (sine, cosine) = lengths.rocker(0.0).sin_cos();
        let x = base + rocker * cosine - CRANK_ROCKER.links[0];
        (rocker * sine).atan2(x)
    };
    let coupler = direction(mirrored) - direction(CRANK_ROCKER);
    mechanism
        .set_angle(&mut other, handles.b, coupler)
        .expect("it carries the coupler");
    mechanism.assemble(0.0, &mut other).expect("it is closed");
    let mut state = other;
    mechanism
        .set_angle(&mut state, handles.a, 2.0)
        .expect("it carries the crank");
    mechanism
        .assemble_from(0.0, &mut state, &other)
        .expect("a way");
    let view = View::new(&constants, 0.0, &state);
    assert!((view.angle(handles.a) - 2.0).abs() < 1e-9);
    let off = wrapped(view.angle(handles.d) - (mirrored.rocker(2.0) - CRANK_ROCKER.rocker(0.0)));
    assert!(off.abs() < 1e-9, "{off}");
}

/// Crank and rocker of one length, coupler and ground too: flat at half a turn, where a second
/// branch begins.
#[derive(Mechanism)]
struct Parallelogram {
    #[body(mass = 1.0, inertia = [0.02, 0.02, 0.02], position = [0.0, 0.2, 0.0])]
    crank: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.5, 0.4, 0.0])]
    coupler: Body,
    #[body(mass = 1.0, inertia = [0.02, 0.02, 0.02], position = [1.0, 0.2, 0.0])]
    rocker: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    a: Revolute,
    #[joint(between = [crank, coupler], point = [0.0, 0.4, 0.0], axis = [0.0, 0.0, 1.0])]
    b: Revolute,
    #[joint(between = [coupler, rocker], point = [1.0, 0.4, 0.0])]
    c: Spherical,
    #[joint(between = [ground, rocker], point = [1.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    d: Cylindrical,
}

#[test]
fn a_branch_point_on_the_way_is_said_by_its_joint() {
    let mechanism = Parallelogram::default();
    let handles = Parallelogram::HANDLES;
    let constants = mechanism.constants().expect("literals");
    // From a quarter of a turn: the links are in line at 90 degrees more.
    for (angle, is_passed) in [(1.2, false), (2.3, true), (-1.2, false), (-2.0, true)] {
        let mut state = mechanism.described_state::<f64>().expect("literals");
        mechanism
            .set_angle(&mut state, handles.a, angle)
            .expect("it carries the crank");
        let correction = mechanism.assemble(0.0, &mut state).expect("a way");
        let view = View::new(&constants, 0.0, &state);
        assert!((view.angle(handles.d) - angle).abs() < 1e-9, "{angle}");
        let passed = correction.moved.expect("of an assembly").passed;
        assert_eq!(passed.is_some(), is_passed, "{angle}: {passed:?}");
    }
}

/// Two cranks of 0.5 m on a base of 1 m, upright, and two couplers of 0.65 m that meet above them.
/// The other mechanisms here have one degree of freedom, where nothing is left to be held.
#[derive(Clone, Copy, Mechanism)]
struct FiveBar {
    /// Of the second crank.
    #[param]
    mass: f64,
    #[body(mass = 1.0, inertia = [0.02, 0.02, 0.02], position = [0.0, 0.25, 0.0])]
    left: Body,
    #[body(
        mass = mass, inertia = [0.02 * mass, 0.02 * mass, 0.02 * mass], position = [1.0, 0.25, 0.0]
    )]
    right: Body,
    #[body(mass = 1.0, inertia = [0.04, 0.04, 0.04], position = [0.25, 0.7, 0.0])]
    left_coupler: Body,
    #[body(mass = 1.0, inertia = [0.04, 0.04, 0.04], position = [0.75, 0.7, 0.0])]
    right_coupler: Body,
    #[joint(between = [ground, left], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    a: Revolute,
    #[joint(between = [ground, right], point = [1.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    e: Revolute,
    #[joint(between = [left, left_coupler], point = [0.0, 0.5, 0.0], axis = [0.0, 0.0, 1.0])]
    b: Revolute,
    #[joint(between = [right, right_coupler], point = [1.0, 0.5, 0.0], axis = [0.0, 0.0, 1.0])]
    d: Cylindrical,
    #[joint(between = [left_coupler, right_coupler], point = [0.5, 0.5 + sqrt(0.65 * 0.65 - 0.25), 0.0])]
    pin: Spherical,
    #[point(on = left_coupler, at = [0.5, 0.5 + sqrt(0.65 * 0.65 - 0.25), 0.0])]
    top: Point,
}

/// Where the couplers meet, above the line of their feet.
fn top(left: f64, right: f64) -> [f64; 2] {
    let foot = |base: f64, angle: f64| [base - 0.5 * angle.sin(), 0.5 * angle.cos()];
    let ([x1, y1], [x2, y2]) = (foot(0.0, left), foot(1.0, right));
    let (dx, dy) = (0.5 * (x2 - x1), 0.5 * (y2 - y1));
    let half = dx.hypot(dy);
    let height = (0.65 * 0.65 - half * half).sqrt() / half;
    [x1 + dx - height * dy, y1 + dy + height * dx]
}

#[test]
fn joints_that_are_held_stay_and_the_others_follow() {
    let h = FiveBar::HANDLES;
    for mass in [1.0, 1e-6, 1e3] {
        let bar = FiveBar::new(mass).expect("positive");
        for (left, right) in [(0.5, 0.0), (-0.4, 0.0), (0.0, 0.0), (0.3, 0.6), (1.2, 0.9)] {
            let mut state = bar.described_state::<f64>().expect("positive");
            bar.set_angle(&mut state, h.a, left).expect("it carries");
            bar.set_angle(&mut state, h.e, right).expect("it carries");
            let mut free = state;
            bar.assemble_holding(0.0, &mut state, (h.a, h.e))
                .expect("in reach");
            let view = bar.view(0.0, &state).expect("finite");
            let found = [view.angle(h.a) - left, view.angle(h.e) - right];
            assert!(
                found.iter().all(|off| off.abs() < 1e-13),
                "{left}, {right}: {found:?}"
            );
            let (place, [x, y]) = (view.position(h.top), top(left, right));
            assert!(
                (place.x - x).abs() < 1e-12 && (place.y - y).abs() < 1e-12,
                "{place}"
            );
            assert!(view.violation() < 1e-24);
            // What is as described is not held where nobody says so.
            bar.assemble(0.0, &mut free).expect("in reach");
            let moved = bar.view(0.0, &free).expect("finite").angle(h.e) - right;
            let is_left = left != 0.0 && right == 0.0;
            assert!(mass > 1.0 || (moved.abs() > 1e-3) == is_left, "{moved}");
        }
    }
}

/// What is not held is a guess: the couplers say on which side they meet.
#[test]
fn a_guess_of_the_others_says_which_branch() {
    let (bar, h) = (FiveBar::new(1.0).expect("positive"), FiveBar::HANDLES);
    let mut state = bar.described_state::<f64>().expect("positive");
    bar.set_angle(&mut state, h.a, 0.2).expect("it carries");
    // The described couplers lean inwards by acos(0.5 / 0.65); below, they hang by as much.
    let lean = 2.0 * (0.5_f64 / 0.65).acos();
    bar.set_angle(&mut state, h.b, -lean).expect("it carries");
    let mut pose = FiveBar::pose(&state, h.right_coupler);
    pose.position = [0.75, 0.3, 0.0].into();
    let (sine, cosine) = (0.5 * lean).sin_cos();
    pose.orientation = holonom::nalgebra::Quaternion::new(cosine, 0.0, 0.0, sine);
    FiveBar::set_pose(&mut state, h.right_coupler, pose);
    bar.assemble_holding(0.0, &mut state, [h.a, h.e])
        .expect("in reach");
    let view = bar.view(0.0, &state).expect("finite");
    assert!((view.angle(h.a) - 0.2).abs() < 1e-13 && view.angle(h.e).abs() < 1e-13);
    assert!(view.violation() < 1e-24 && view.position(h.top).y < 0.5);
}

#[test]
fn what_cannot_be_held_is_refused_by_name() {
    let (bar, h) = (FiveBar::new(1.0).expect("positive"), FiveBar::HANDLES);
    let described = bar.described_state::<f64>().expect("positive");
    let mut state = described;
    let fault = bar
        .assemble_holding(0.0, &mut state, h.pin)
        .expect_err("it closes the loop");
    assert!(
        matches!(
            fault,
            Fault::Assembly(AssemblyFault::CarriesNothing { joint: "pin", .. })
        ),
        "{fault}"
    );
    // The couplers do not reach so far, and three angles are more than two freedoms.
    for (held, left, coupler) in [(2, 1.5, 0.0), (3, 0.1, 0.2)] {
        let mut state = described;
        bar.set_angle(&mut state, h.a, left).expect("it carries");
        bar.set_angle(&mut state, h.e, -left * f64::from(3 - held))
            .expect("it carries");
        bar.set_angle(&mut state, h.b, coupler).expect("it carries");
        let given = state;
        let fault = if held == 2 {
            bar.assemble_holding(0.0, &mut state, [h.a, h.e])
        } else {
            bar.assemble_holding(0.0, &mut state, [h.a, h.b, h.e])
        };
        let fault = fault.expect_err("out of reach");
        assert!(
            matches!(fault, Fault::Assembly(AssemblyFault::WayEnds { .. })),
            "{fault}"
        );
        assert_eq!(state, given);
    }
}

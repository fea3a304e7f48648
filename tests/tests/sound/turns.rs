//! Poses do not tell turns; angles that count them can be read and set.

use core::f64::consts::TAU;

use holonom::error::AssemblyFault;
use holonom::forces::TorsionalSpringDamper;
use holonom::joints::{Gear, Revolute, Screw};
use holonom::nalgebra::{Quaternion, Vector3};
use holonom::prelude::*;
use holonom::{Pose, View};

/// A wheel that winds up a spring.
#[derive(Mechanism)]
struct Clockwork {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.2])]
    wheel: Body,
    #[joint(between = [ground, wheel], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[force(between = [ground, wheel], axis = [0.0, 0.0, 1.0], stiffness = 2.0)]
    spring: TorsionalSpringDamper,
}

/// A nut on a screw of 10 mm a turn.
#[derive(Mechanism)]
struct Press {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.2])]
    nut: Body,
    #[joint(between = [ground, nut], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0], pitch = 0.01)]
    thread: Screw,
}

/// A pair of wheels, the second of half the size.
#[derive(Mechanism)]
struct Pair {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.2])]
    large: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.2], position = [0.3, 0.0, 0.0])]
    small: Body,
    #[joint(between = [ground, large], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    large_bearing: Revolute,
    #[joint(between = [ground, small], point = [0.3, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    small_bearing: Revolute,
    #[joint(between = [large, small, ground], axis_i = [0.0, 0.0, 1.0], axis_j = [0.0, 0.0, 1.0], ratio = -2.0)]
    gear: Gear,
}

fn turned(angle: f64, position: [f64; 3]) -> Pose<f64> {
    let (sine, cosine) = (0.5 * angle).sin_cos();
    Pose {
        position: Vector3::from(position),
        orientation: Quaternion::new(cosine, 0.0, 0.0, sine),
    }
}

const TURNS: f64 = 10.3;

#[test]
fn a_spring_that_was_wound_up_stays_so_when_its_poses_are_set() {
    let clockwork = Clockwork::default();
    let handles = Clockwork::HANDLES;
    let wound = 0.5 * 2.0 * (TURNS * TAU).powi(2);
    let mut state = clockwork.described_state().expect("described");
    Clockwork::set_pose(&mut state, handles.wheel, turned(TURNS * TAU, [0.0; 3]));
    let energy = |state| {
        let mut energy = f64::NAN;
        Simulation::new(&clockwork, StandardLagrange, Rk4::every(0.01))
            .initial_state(state)
            .run(0.0..=0.0, every(1.0), |sample| {
                energy = sample.potential_energy();
                ControlFlow::Continue(())
            })
            .expect("regular");
        energy
    };
    // A pose alone does not tell.
    assert!(energy(state) < 2e-3 * wound);
    // A tenth of a turn off is near enough.
    for angle in [TURNS * TAU, TURNS * TAU - 0.6, TURNS * TAU + 3.0] {
        Clockwork::set_unwrapped_angles(&mut state, handles.spring, &[angle]).expect("one angle");
        assert_eq!(
            Clockwork::unwrapped_angles(&state, handles.spring),
            &[angle]
        );
        let found = energy(state);
        println!("{found} for {wound}");
        assert!((found / wound - 1.0).abs() < 1e-13, "{found} for {wound}");
    }
    let before = state;
    for angles in [&[][..], &[1.0, 2.0]] {
        let fault = Clockwork::set_unwrapped_angles(&mut state, handles.spring, angles)
            .expect_err("another number of them");
        assert_eq!(
            fault,
            AssemblyFault::CountedAngles {
                element: "spring",
                counted: 1,
                given: angles.len()
            }
        );
    }
    Clockwork::set_unwrapped_angles(&mut state, handles.bearing, &[1.0]).expect_err("none");
    assert_eq!(state, before);
    assert!(Clockwork::unwrapped_angles(&state, handles.bearing).is_empty());
}

#[test]
fn a_nut_stays_where_it_was_when_its_pose_is_set() {
    let press = Press::default();
    let handles = Press::HANDLES;
    let height = TURNS * 0.01;
    let place = turned(TURNS * TAU, [0.0, 0.0, height]);
    let mut state = press.described_state().expect("described");
    Press::set_pose(&mut state, handles.nut, place);
    // Ten pitches back: nothing tells that this is not meant.
    let mut lost = state;
    press.assemble(0.0, &mut lost).expect("somewhere else");
    assert!(Press::pose(&lost, handles.nut).position.z < 0.2 * height);

    Press::set_unwrapped_angles(&mut state, handles.thread, &[TURNS * TAU]).expect("one angle");
    let report = Simulation::new(&press, StandardLagrange, Rk4::every(0.01))
        .initial_state(state)
        .assembled()
        .run(0.0..=0.1, every(0.1), |sample| {
            assert!((sample.angle(handles.thread) - TURNS * TAU).abs() < 1e-12);
            ControlFlow::Continue(())
        })
        .expect("regular");
    let nut = Press::pose(&report.state, handles.nut).position;
    assert!((nut.z - height).abs() < 1e-15, "{}", nut.z);
}

#[test]
fn a_gear_counts_two_angles_in_the_order_of_its_definition() {
    let pair = Pair::default();
    let handles = Pair::HANDLES;
    let constants = pair.constants().expect("acceptable");
    let mut state = pair.described_state().expect("described");
    Pair::set_pose(&mut state, handles.large, turned(TURNS * TAU, [0.0; 3]));
    let (large, small) = (TURNS * TAU, -2.0 * TURNS * TAU);
    Pair::set_pose(&mut state, handles.small, turned(small, [0.3, 0.0, 0.0]));
    Pair::set_unwrapped_angles(&mut state, handles.gear, &[small, large]).expect("two angles");
    let violation = |state: &<Pair as Mechanism>::State<f64>| {
        View::<f64, Pair>::new(&constants, 0.0, state).violation()
    };
    assert!(violation(&state) < 1e-24);
    // They go from one mechanism to another.
    let mut other = pair.described_state::<f64>().expect("described");
    let angles = Pair::unwrapped_angles(&state, handles.gear).to_vec();
    Pair::set_unwrapped_angles(&mut other, handles.gear, &angles).expect("two angles");
    assert_eq!(Pair::unwrapped_angles(&other, handles.gear), angles);
    Pair::set_unwrapped_angles(&mut state, handles.gear, &[large, small]).expect("two angles");
    assert!(violation(&state) > 1e3);
}

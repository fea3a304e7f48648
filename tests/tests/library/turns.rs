//! Angles over a hundred turns: screws, gears and racks on bearings keep their proportion without a
//! jump, and go on after a restart.

use core::f64::consts::TAU;

use holonom::forces::TorsionalSpringDamper;
use holonom::joints::{Gear, Prismatic, RackAndPinion, Revolute, Screw};
use holonom::prelude::*;
use holonom::{StateParts, state::Array};
use holonom_assembler::accuracy::assert_close;
use nalgebra::{UnitQuaternion, Vector3};

/// The rate of the shaft that is set going (rad/s): a hundred turns in ten seconds.
const RATE: f64 = 20.0 * core::f64::consts::PI;
const END: f64 = 10.0;

/// What angles of some hundred radians may be off by, after ten seconds at a tolerance of 1e-10.
const ERROR: f64 = 1e-7;

const TOLERANCE: Tolerance<f64> = Tolerance {
    relative: 1e-10,
    absolute: 1e-12,
};

/// A nut on the ground's thread: 5 mm a turn along (1, 2, 2) / 3.
#[derive(Debug, Mechanism)]
struct Nut {
    #[body(
        mass = 2.0,
        inertia = [0.02, 0.02, 0.02],
        position = [0.3, 0.6, 0.6],
        velocity = [0.1 / 6.0, 0.1 / 3.0, 0.1 / 3.0],
        angular_velocity = [20.0 * PI / 3.0, 40.0 * PI / 3.0, 40.0 * PI / 3.0]
    )]
    nut: Body,
    #[joint(between = [ground, nut], point = [0.0, 0.0, 0.0], axis = [1.0, 2.0, 2.0], pitch = 0.005)]
    thread: Screw,
}

/// Two gears and a rack on a frame that turns itself, free in space: 20 and 50 teeth, and a rack on
/// the pinion.
#[derive(Debug, Mechanism)]
struct Train {
    #[body(mass = 4.0, inertia = [0.5, 0.6, 0.7], position = [0.0, 0.0, 0.0], angular_velocity = [0.0, 0.0, 0.7])]
    frame: Body,
    #[body(mass = 0.5, inertia = [0.002, 0.002, 0.003], position = [0.0, 0.1, 0.0])]
    pinion: Body,
    #[body(mass = 2.0, inertia = [0.02, 0.02, 0.03], position = [0.0, -0.25, 0.0])]
    wheel: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.01, 0.1], position = [0.1, 0.3, 0.0])]
    rack: Body,
    #[joint(between = [frame, pinion], point = [0.0, 0.1, 0.0], axis = [0.0, 0.0, 1.0])]
    a: Revolute,
    #[joint(between = [frame, wheel], point = [0.0, -0.25, 0.0], axis = [0.0, 0.0, 1.0])]
    b: Revolute,
    #[joint(between = [frame, rack], point = [0.1, 0.3, 0.0], axis = [1.0, 0.0, 0.0])]
    c: Prismatic,
    #[joint(between = [pinion, wheel, frame], axis_i = [0.0, 0.0, 1.0], axis_j = [0.0, 0.0, 1.0], ratio = -0.4)]
    gear: Gear,
    #[joint(
        between = [pinion, rack, frame],
        axis = [0.0, 0.0, 1.0],
        hub = [0.0, 0.1, 0.0],
        point = [0.1, 0.2, 0.0],
        slide = [1.0, 0.0, 0.0],
        radius = -0.002
    )]
    mesh: RackAndPinion,
}

/// Two shafts on the ground at an angle, bevel gears between them.
#[derive(Debug, Mechanism)]
struct Bevel {
    #[body(mass = 1.0, inertia = [0.01, 0.01, 0.02], position = [0.0, 0.0, 0.2], angular_velocity = [0.0, 0.0, -20.0 * PI])]
    first: Body,
    #[body(
        mass = 1.0,
        inertia = [0.02, 0.01, 0.01],
        position = [0.2, 0.0, 0.0],
        angular_velocity = [-30.0 * PI, 0.0, 0.0]
    )]
    second: Body,
    #[joint(between = [ground, first], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    a: Revolute,
    #[joint(between = [ground, second], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    b: Revolute,
    #[joint(between = [first, second, ground], axis_i = [0.0, 0.0, 1.0], axis_j = [1.0, 0.0, 0.0], ratio = 1.5)]
    gear: Gear,
}

/// `(q, u)` as a program would put it into a file.
fn saved<M: Mechanism>(state: &M::State<f64>) -> [Vec<f64>; 2] {
    [
        state.coordinates().as_slice().to_vec(),
        state.velocities().as_slice().to_vec(),
    ]
}

fn restored<M: Mechanism>([q, u]: &[Vec<f64>; 2]) -> M::State<f64> {
    let mut state = M::State::from_parts(Array::zeros(), Array::zeros());
    state.coordinates_mut().as_mut_slice().copy_from_slice(q);
    state.velocities_mut().as_mut_slice().copy_from_slice(u);
    state
}

/// Runs in one go and in two, shows both, and returns the last state.
fn over_a_hundred_turns<M: Mechanism + Default>(
    state: M::State<f64>,
    mut show: impl FnMut(&Sample<'_, f64, M>),
) -> M::State<f64> {
    /// Thirty-six turns and a third.
    const HALT: f64 = 3.633_333;
    let mechanism = M::default();
    let simulation = |state| {
        Simulation::new(&mechanism, StandardLagrange, DormandPrince::new(TOLERANCE))
            .initial_state(state)
    };
    let mut go = |from: f64, to: f64, state| {
        let course = simulation(state).run(from..=to, every(0.02), |sample| {
            show(sample);
            ControlFlow::Continue(())
        });
        course.expect("no singular position").state
    };
    let whole = go(0.0, END, state);
    let halted = saved::<M>(&go(0.0, HALT, state));
    let resumed = go(HALT, END, restored::<M>(&halted));
    let [once, twice] = [whole, resumed].map(|state| saved::<M>(&state).concat());
    assert_close("after a restart", &twice, &once, ERROR);
    whole
}

/// Between two samples nothing jumps.
struct Steady {
    last: Option<[f64; 2]>,
    most: f64,
}

impl Steady {
    const fn new(most: f64) -> Self {
        Self { last: None, most }
    }

    fn take(&mut self, time: f64, angle: f64) {
        if let Some([before, earlier]) = self.last
            && time > before
        {
            assert!(
                (angle - earlier).abs() <= self.most * (time - before) + 1e-9,
                "{earlier} {angle}"
            );
        }
        self.last = Some([time, angle]);
    }
}

#[test]
fn a_screw_advances_by_its_pitch_for_a_hundred_turns() {
    let (nut, thread) = (Nut::HANDLES.nut, Nut::HANDLES.thread);
    let state = Nut::default().described_state().expect("described");
    let mut steady = Steady::new(1.01 * RATE);
    let last = over_a_hundred_turns::<Nut>(state, |sample| {
        let turned = RATE * sample.time();
        steady.take(sample.time(), sample.angle(thread));
        assert!((sample.angle(thread) - turned).abs() < ERROR);
        assert!((sample.angle_rate(thread) - RATE).abs() < ERROR);
        let advance = 0.005 * turned / TAU;
        assert!((sample.displacement(thread) - advance).abs() < 1e-9);
        let along = Vector3::new(1.0, 2.0, 2.0) / 3.0;
        assert!((sample.pose(nut).position - along * (0.9 + advance)).amax() < 1e-9);
    });
    // The counter itself is the angle, to the round-off of a projection.
    let counter = last.coordinates().as_slice()[7];
    assert!((counter - 100.0 * TAU).abs() < ERROR, "{counter}");
}

#[test]
fn gears_and_racks_keep_their_ratio_on_a_frame_that_turns_for_a_hundred_turns() {
    let train = Train::default();
    let handles = Train::HANDLES;
    let mut state = train.described_state().expect("described");
    // Wheel and rack as the pinion drives them, on a frame that turns at 0.7 rad/s.
    let frame = Vector3::new(0.0, 0.0, 0.7);
    for (body, turns) in [
        (handles.pinion, RATE),
        (handles.wheel, -0.4 * RATE),
        (handles.rack, 0.0),
    ] {
        let place = Train::pose(&state, body).position;
        let mut velocity = frame.cross(&place);
        if body == handles.rack {
            velocity.x += -0.002 * RATE;
        }
        Train::set_velocity(&mut state, body, velocity);
        Train::set_angular_velocity(&mut state, body, frame + Vector3::z() * turns);
    }
    let constants = train.constants().expect("acceptable");
    let start = holonom::View::<f64, Train>::new(&constants, 0.0, &state);
    assert!(start.velocity_violation() < 1e-24);
    let energy = start.energy();
    let mut steady = Steady::new(2.0 * RATE);
    let mut turned = 0.0_f64;
    over_a_hundred_turns::<Train>(state, |sample| {
        // The angles of the hinges are those within a turn; the counters stand behind the
        // coordinates.
        let counters = &sample.state().coordinates().as_slice()[28..];
        let [wheel, pinion, meshed] = [counters[0], counters[1], counters[2]];
        steady.take(sample.time(), pinion);
        turned = turned.max(pinion.abs());
        assert!((wheel + 0.4 * pinion).abs() < ERROR, "{wheel} {pinion}");
        assert!((meshed - pinion).abs() < ERROR);
        let slide = sample.displacement(handles.c);
        assert!((slide + 0.002 * pinion).abs() < ERROR, "{slide} {pinion}");
        for (hinge, counted) in [(handles.a, pinion), (handles.b, wheel)] {
            let [seen, counted] = [sample.angle(hinge), counted].map(f64::sin_cos);
            assert!((seen.0 - counted.0).abs() < ERROR && (seen.1 - counted.1).abs() < ERROR);
        }
        assert!((sample.energy() - energy).abs() < 1e-6 * energy);
        // What the gear does to wheel and pinion is in balance at their ratio, along the axis and
        // nothing else but what the frame takes.
        let on = |body| sample.reaction(handles.gear, body).expect("regular");
        let [on_pinion, on_wheel, on_frame] =
            [handles.pinion, handles.wheel, handles.frame].map(on);
        for wrench in [on_pinion, on_wheel, on_frame] {
            assert!(wrench.force.norm() < 1e-9);
        }
        let scale = on_wheel.moment.norm().max(1e-3);
        assert!((on_pinion.moment - 0.4 * on_wheel.moment).norm() < 1e-8 * scale);
        assert!((on_pinion.moment + on_wheel.moment + on_frame.moment).norm() < 1e-8 * scale);
        // Rack and pinion push each other, and the bearing carries it. The rack is 0.1 m beside
        // the hub, not 0.002 m as its radius says: the frame holds against the rest.
        let on = |body| sample.reaction(handles.mesh, body).expect("regular");
        let [on_pinion, on_rack, on_frame] = [handles.pinion, handles.rack, handles.frame].map(on);
        let turn = UnitQuaternion::new_normalize(sample.pose(handles.rack).orientation);
        let along = turn * Vector3::x();
        let push = on_rack.force.dot(&along);
        let scale = push.abs().max(1e-3);
        assert!((on_rack.force - push * along).norm() < 1e-8 * scale);
        assert!((on_pinion.force + on_rack.force).norm() < 1e-8 * scale);
        assert!(on_frame.force.norm() < 1e-8 * scale);
        assert!((on_pinion.moment.z - 0.002 * push).abs() < 1e-8 * scale);
        assert!((on_frame.moment.z - (0.1 - 0.002) * push).abs() < 1e-8 * scale);
    });
    assert!(turned > 90.0 * TAU, "{turned}");
}

#[test]
fn bevel_gears_turn_backwards_for_a_hundred_turns() {
    let gear = Bevel::HANDLES;
    let state = Bevel::default().described_state().expect("described");
    over_a_hundred_turns::<Bevel>(state, |sample| {
        let counters = &sample.state().coordinates().as_slice()[14..];
        let turned = -RATE * sample.time();
        assert!((counters[1] - turned).abs() < ERROR);
        assert!((counters[0] - 1.5 * turned).abs() < ERROR);
        let [seen, expected] = [sample.angle(gear.b), 1.5 * turned].map(f64::sin_cos);
        assert!((seen.0 - expected.0).abs() < ERROR && (seen.1 - expected.1).abs() < ERROR);
    });
}

/// A ball that spins on a soft spring, whose energy tells the angle.
#[derive(Debug, Mechanism)]
struct Ball {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], angular_velocity = [0.0, 0.0, 20.0 * PI])]
    ball: Body,
    #[force(between = [ground, ball], axis = [0.0, 0.0, 1.0], stiffness = 2e-9)]
    spring: TorsionalSpringDamper,
}

/// Coarse steps let orientation and counter part, by a turn within a minute or two: the count
/// follows the orientation.
#[test]
fn a_counter_stays_with_its_angle() {
    const STEP: f64 = 0.02;
    let ball = Ball::default();
    let mut last = -RATE * STEP;
    Simulation::new(&ball, StandardLagrange, Rk4::every(STEP))
        .run(0.0..=100.0, every(STEP), |sample| {
            let angle = (sample.potential_energy() / 1e-9).sqrt();
            let advance = angle - last;
            // A turn too many or too few is five times the advance.
            assert!((advance / (RATE * STEP) - 1.0).abs() < 0.5, "{advance}");
            last = angle;
            ControlFlow::Continue(())
        })
        .expect("free");
    // That the two did part is what this is about.
    assert!((RATE * 100.0 - last).abs() > TAU, "{last}");
}

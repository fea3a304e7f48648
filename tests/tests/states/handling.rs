//! States that are set: at the start, by handlers, in files; and what leaves them as they are.

use holonom::Recorder;
use holonom::measure::NamedState;
use holonom::nalgebra::Vector3;
use holonom::prelude::*;

use crate::{Fan, tight};

/// A saw tooth beside a body that rests.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Saw {
    #[state(rate = 1.0, start = 0.25)]
    tooth: f64,
    #[state(rate = 0.0)]
    teeth: f64,
    #[body(free, mass = 1.0)]
    stone: Particle,
}

#[test]
fn a_handler_sets_a_state() {
    let h = Saw::HANDLES;
    let saw = Saw::default();
    let mut last = [0.0; 2];
    saw.simulation(StandardLagrange, tight())
        .on(
            "full",
            Crossing::Rising,
            |sample| sample.state_value(h.tooth) - 1.0,
            |event| {
                let teeth = event.state_value(h.teeth);
                event.set_state_value(h.tooth, 0.0);
                event.set_state_value(h.teeth, teeth + 1.0);
            },
        )
        .run(0.0..=3.5, every(0.5), |sample| {
            last = [h.tooth, h.teeth].map(|of| sample.state_value(of));
        })
        .expect("it runs");
    // Full at 0.75 s, 1.75 s and 2.75 s.
    assert!((last[0] - 0.75).abs() < 1e-9, "{last:?}");
    assert_eq!(last[1], 3.0);
}

#[test]
fn the_field_is_the_start() {
    let h = Saw::HANDLES;
    assert_eq!(Saw::default().tooth, 0.25);
    let saw = Saw {
        tooth: 7.0,
        ..Saw::default()
    };
    let mut state = saw.described_state::<f64>().expect("sound");
    assert_eq!(Saw::state_value(&state, h.tooth), 7.0);
    assert_eq!(Saw::state_value(&state, h.teeth), 0.0);
    Saw::set_state_value(&mut state, h.teeth, -2.0);
    saw.simulation(StandardLagrange, tight())
        .joint_coordinates()
        .initial_state(state)
        .run(0.0..=1.0, every(1.0), |sample| {
            assert!((sample.state_value(h.tooth) - 7.0 - sample.time()).abs() < 1e-12);
            assert_eq!(sample.state_value(h.teeth), -2.0);
        })
        .expect("it runs");
    let wrong = Saw {
        tooth: f64::NAN,
        ..Saw::default()
    };
    let fault = wrong.described_state::<f64>().expect_err("no number");
    assert_eq!(fault.to_string(), "`value` of `tooth` must be finite");
}

#[test]
fn positions_that_are_set_and_assembled_leave_it() {
    let (fan, h) = (Fan::of(0.5), Fan::HANDLES);
    let mut state = fan.described_state().expect("sound");
    Fan::set_state_value(&mut state, h.current, 1e3);
    fan.set_angle(&mut state, h.bearing, 2.0)
        .expect("it is free");
    fan.set_angle_rate(&mut state, h.bearing, 50.0)
        .expect("it is free");
    assert_eq!(Fan::state_value(&state, h.current), 1e3);
    // Off its bearing, and of another length of its Euler parameters.
    let mut pose = Fan::pose(&state, h.rotor);
    pose.position += Vector3::new(1e-3, 0.0, 0.0);
    Fan::set_pose(&mut state, h.rotor, pose);
    fan.assemble(0.0, &mut state).expect("it is near");
    assert_eq!(Fan::state_value(&state, h.current), 1e3);
    // Into joint coordinates and back.
    fan.simulation(StandardLagrange, tight())
        .joint_coordinates()
        .initial_state(state)
        .run(0.0..=0.0, every(1.0), |sample| {
            assert_eq!(sample.state_value(h.current), 1e3);
        })
        .expect("it runs");
}

#[test]
fn a_file_names_states() {
    let saw = Saw {
        teeth: 0.1 + 0.2,
        ..Saw::default()
    };
    let state = saw.described_state().expect("sound");
    let text = serde_json::to_string(&NamedState::<Saw>::new(0.5, state)).expect("a text");
    assert!(
        text.ends_with(
            r#""unwrapped_angles":{},"states":{"tooth":0.25,"teeth":0.30000000000000004}}"#
        ),
        "{text}"
    );
    let read: NamedState<Saw> = serde_json::from_str(&text).expect("the same mechanism");
    assert!(read.state == state);
    let refused = |from: &str, to: &str| {
        let other = text.replace(from, to);
        assert_ne!(other, text);
        let fault = serde_json::from_str::<NamedState<Saw>>(&other).expect_err("another file");
        fault.to_string()
    };
    let fault = refused(r#""tooth":0.25,"#, "");
    assert!(
        fault.starts_with("state `tooth` of `Saw` is missing"),
        "{fault}"
    );
    let fault = refused("tooth", "tuth");
    assert!(fault.starts_with("`Saw` has no state `tuth`"), "{fault}");
    let fault = refused("teeth\"", "tooth\"");
    assert!(fault.starts_with("state `tooth` is there twice"), "{fault}");
    let fault = refused(
        r#","states":{"tooth":0.25,"teeth":0.30000000000000004}"#,
        "",
    );
    assert!(fault.starts_with("missing field `states`"), "{fault}");
}

#[test]
fn a_record_has_a_column_for_each() {
    let mut recorder = Recorder::new(Vec::new());
    Saw::default()
        .simulation(StandardLagrange, tight())
        .run(0.0..=1.0, every(1.0), |sample| recorder.record(sample))
        .expect("it runs and is recorded");
    let text = String::from_utf8(recorder.into_inner()).expect("a text");
    let mut lines = text.lines();
    let mut heads = lines.next().expect("a head").split(',');
    let place = heads.position(|head| head == "tooth").expect("a column");
    let values: Vec<f64> = lines
        .map(|line| {
            let value = line.split(',').nth(place).expect("a value");
            value.parse().expect("a number")
        })
        .collect();
    assert_eq!(values.len(), 2);
    assert!((values[0] - 0.25).abs() < 1e-12 && (values[1] - 1.25).abs() < 1e-12);
}

/// A winding of its own.
#[derive(Assembly)]
struct Winding {
    #[port]
    base: Body,
    #[param]
    resistance: f64,
    #[state(rate = 1.0 - resistance * current - 0.1 * axle.rate, start = 0.5)]
    current: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    wheel: Body,
    #[joint(between = [base, wheel], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    axle: Revolute,
    #[force(between = [base, wheel], axis = [0.0, 0.0, 1.0], moment = 0.1 * current)]
    motor: TorsionalActuator,
}

/// Two of them, and the sum of their currents.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Pair {
    #[part(at = [0.0, 0.0, 0.0], base = ground)]
    left: Winding,
    #[part(at = [1.0, 0.0, 0.0], base = ground)]
    right: Winding,
    #[state(rate = left.current + right.current + 0.0 * right.axle.rate)]
    charge: f64,
}

#[test]
fn states_of_parts_are_read_by_their_way() {
    let pair = Pair::new(Winding::new(2.0), Winding::new(3.0)).expect("sound");
    let h = Pair::HANDLES;
    // L i' = 1 - R i - 0.1 w and J w' = 0.1 i with L = 1 and J = 0.1, in closed form.
    let current = |resistance: f64, t: f64| {
        let root = (resistance * resistance / 4.0 - 0.1).sqrt();
        let [a, b] = [-resistance / 2.0 + root, -resistance / 2.0 - root];
        // i(0) = 0.5, i'(0) = 1 - R / 2, i(infinity) = 0.
        let slope = 1.0 - resistance * 0.5;
        let of_a = (slope - b * 0.5) / (a - b);
        let parts = [(a, of_a), (b, 0.5 - of_a)];
        let value: f64 = parts
            .iter()
            .map(|(rate, part)| part * (rate * t).exp())
            .sum();
        let charge: f64 = parts
            .iter()
            .map(|(rate, part)| part * ((rate * t).exp() - 1.0) / rate)
            .sum();
        [value, charge]
    };
    let mut see = |sample: &Sample<'_, f64, Pair>| {
        let t = sample.time();
        let [[left, more], [right, most]] = [2.0, 3.0].map(|resistance| current(resistance, t));
        assert!((sample.state_value(h.left.current) - left).abs() < 1e-10);
        assert!((sample.state_value(h.right.current) - right).abs() < 1e-10);
        assert!((sample.state_value(h.charge) - more - most).abs() < 1e-10);
    };
    pair.simulation(StandardLagrange, tight())
        .absolute_coordinates()
        .run(0.0..=3.0, every(0.5), &mut see)
        .expect("it runs by bodies");
    pair.simulation(StandardLagrange, tight())
        .joint_coordinates()
        .run(0.0..=3.0, every(0.5), &mut see)
        .expect("it runs by joints");
    assert_eq!(h.right.current.name(), "right.current");
}

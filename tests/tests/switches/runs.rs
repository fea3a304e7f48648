//! Laws that switch beside what else happens in a run.

use holonom::error::{ModeFault, StartFault};
use holonom::prelude::*;
use holonom::run::Checkpoint;

/// A slider on springs that it leaves, pushed in windows of time.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Busy {
    #[input]
    push: f64,
    #[param]
    stiffness: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.5, 0.0, 0.0])]
    slider: Body,
    #[joint(between = [ground, slider], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rail: Prismatic,
    #[force(
        between = [ground, slider], head = [-9.0, 0.0, 0.0], tail = [0.5, 0.0, 0.0],
        force = push - stiffness * max(0.0, length - 9.2) + stiffness * max(0.0, 8.9 - length)
            + if sin(8.0 * time) > 0.3 { 1.0 } else { -0.5 }
    )]
    springs: Actuator,
    #[state(rate = abs(springs.rate))]
    way: f64,
}

fn busy() -> Busy {
    Busy::new(30.0).expect("acceptable")
}

#[test]
fn runs_go_on_from_checkpoints_to_the_last_bit() {
    let mechanism = busy();
    let (mut shown, mut kept): (Vec<_>, Vec<Checkpoint<Busy>>) = (Vec::new(), Vec::new());
    mechanism
        .simulation(StandardLagrange, DormandPrince::default())
        .checkpoints(7, |checkpoint| kept.push(checkpoint.clone()))
        .run(0.0..=4.0, every(0.25), |sample| {
            shown.push((sample.time(), *sample.state()));
        })
        .expect("it runs");
    assert!(kept.len() > 10);
    for checkpoint in kept.iter().step_by(3) {
        let mut rest = Vec::new();
        let text = serde_json::to_string(checkpoint).expect("it is written");
        let read: Checkpoint<Busy> = serde_json::from_str(&text).expect("it is read");
        mechanism
            .simulation(StandardLagrange, DormandPrince::default())
            .checkpoints(7, |_| ())
            .resume(&read, |sample| {
                rest.push((sample.time(), *sample.state()));
            })
            .expect("it goes on");
        let same = &shown[shown.len() - rest.len()..];
        assert!(same == rest, "from {}", read.time());
    }
}

#[test]
fn handlers_and_controllers_leave_laws_on_their_sides() {
    // An impact sets the rate on the other side of zero, a controller the input of a limit.
    let (mechanism, h) = (busy(), Busy::HANDLES);
    let (mut last, mut bounces) = (None::<(f64, f64, f64)>, 0);
    let report = mechanism
        .simulation(StandardLagrange, DormandPrince::default())
        .on(
            "stop",
            Crossing::Falling,
            |sample| sample.pose(h.slider).position.x + 0.05,
            |event| {
                bounces += 1;
                event.set_displacement_rate(h.rail, 0.5 * event.displacement_rate(h.rail).abs())
            },
        )
        .every_period(0.3, |sample, inputs| {
            inputs.push = -sample.displacement(h.rail);
        })
        .run(0.0..=4.0, every(1e-3), |sample| {
            // The way is what the place goes, whichever direction it has.
            let (x, v) = (
                sample.displacement(h.rail),
                sample.displacement_rate(h.rail),
            );
            let way = sample.state_value(h.way);
            if let Some((last_x, last_v, last_way)) = last
                && last_v * v > 0.0
            {
                let gone = (x - last_x).abs();
                assert!((way - last_way - gone).abs() < 1e-5, "{}", sample.time());
            }
            last = Some((x, v, way));
        })
        .expect("it runs");
    assert!(bounces > 2 && report.warnings().is_empty());
}

#[test]
fn a_companion_finds_switches_of_its_own() {
    let (mechanism, h) = (busy(), Busy::HANDLES);
    let relative = |tolerance: f64| Tolerance {
        relative: tolerance,
        absolute: tolerance,
    };
    let end = |run: Simulation<'_, _, _>| {
        let report = run.run(0.0..=4.0, every(0.25), |_| ()).expect("it runs");
        let state = report.state;
        let view = mechanism.view(4.0, &state).expect("acceptable");
        (view.displacement(h.rail), report.verification)
    };
    let (exact, _) =
        end(mechanism.simulation(StandardLagrange, DormandPrince::new(relative(1e-12))));
    for tolerance in [1e-4, 1e-6] {
        let method = DormandPrince::new(relative(tolerance));
        let run = mechanism.simulation(StandardLagrange, method).verified();
        let (reached, found) = end(run);
        let found = found.expect("it is verified");
        assert_eq!(found.compared, 17);
        let worst = found.worst().expect("one body").position;
        let wrong = (reached - exact).abs();
        assert!(
            wrong < 3.0 * worst && worst < 1e3 * tolerance,
            "{wrong:e} {worst:e}"
        );
    }
}

#[test]
fn what_laws_that_switch_cannot_do_is_refused() {
    let mechanism = busy();
    let refused = mechanism
        .sensitivities([Busy::HANDLES.stiffness])
        .expect("acceptable")
        .simulation(StandardLagrange, DormandPrince::default())
        .run(0.0..=1.0, every(0.5), |_| ())
        .expect_err("derivatives jump");
    assert_eq!(
        refused.fault,
        Fault::Start(StartFault::SwitchLeftOut { law: "springs" })
    );
}

#[test]
fn runs_in_single_precision_switch_as_well() {
    let (mechanism, h) = (busy(), Busy::HANDLES);
    let double = mechanism
        .simulation(StandardLagrange, DormandPrince::default())
        .run(0.0..=2.0, every(2.0), |_| ())
        .expect("it runs");
    let tolerance = Tolerance {
        relative: 1e-4_f32,
        absolute: 1e-5,
    };
    let single = Simulation::new(&mechanism, StandardLagrange, DormandPrince::new(tolerance))
        .run(0.0_f32..=2.0, every(2.0), |_| ())
        .expect("it runs");
    let [double, single] = [
        Busy::pose(&double.state, h.slider).position.x,
        f64::from(Busy::pose(&single.state, h.slider).position.x),
    ];
    assert!((double - single).abs() < 2e-3, "{double} and {single}");
}

/// A law about the place where an event is, and friction that lets go when a law jumps.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Beside {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [1.0, 0.0, 0.0])]
    slider: Body,
    #[joint(between = [ground, slider], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rail: Prismatic,
    #[force(
        between = [ground, slider], head = [-9.0, 0.0, 0.0], tail = [1.0, 0.0, 0.0],
        force = -sign(length - 9.0)
    )]
    motor: Actuator,
    #[body(mass = 2.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 1.0, 0.0])]
    sledge: Body,
    #[joint(between = [ground, sledge], point = [0.0, 1.0, 0.0], axis = [1.0, 0.0, 0.0])]
    track: Prismatic,
    #[force(
        between = [ground, sledge], head = [-9.0, 1.0, 0.0], tail = [0.0, 1.0, 0.0],
        force = if time < 1.0 { 3.0 } else if time < 2.0 { 7.0 } else { -1.0 }
    )]
    pull: Actuator,
}

#[test]
fn events_and_friction_beside_laws_that_switch() {
    let (mechanism, h) = (Beside::default(), Beside::HANDLES);
    let mut passes = 0;
    let report = mechanism
        .simulation(StandardLagrange, DormandPrince::default())
        .interactions([Interaction::friction(h.track.displacement(), 5.0)])
        .on(
            "passes",
            Crossing::Either,
            |sample| sample.pose(h.slider).position.x,
            |_| passes += 1,
        )
        .run(0.0..=40.0 * 2.0_f64.sqrt(), every(0.5), |sample| {
            let t = sample.time();
            // It sticks, slides by 1 m/s^2 for a second, and is stopped by 3 m/s^2.
            let speed = (t - 1.0).clamp(0.0, 1.0) - 3.0 * (t - 2.0).clamp(0.0, 1.0 / 3.0);
            let found = sample.displacement_rate(h.track);
            assert!((found - speed).abs() < 1e-9, "{found} and {speed} at {t}");
        })
        .expect("it runs");
    assert_eq!(passes, 20);
    let x = Beside::pose(&report.state, h.slider).position.x;
    assert!((x - 1.0).abs() < 1e-9, "{x}");
}

/// A rope that only pulls, as a part.
#[derive(Assembly)]
struct Hanging {
    #[param(like = 1.0)]
    stiffness: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, -1.0])]
    load: Body,
    #[joint(between = [ground, load], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    rail: Prismatic,
    #[force(
        between = [ground, load], head = [0.0, 0.0, 1.0], tail = [0.0, 0.0, -1.0],
        force = -stiffness * max(0.0, length - 2.0)
    )]
    rope: Actuator,
}

#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -10.0], coordinates = "both")]
struct Twice {
    #[input(order = 2)]
    raised: Setpoint,
    #[param]
    curve: Spline<3>,
    #[part(at = [0.0, 0.0, 0.0])]
    left: Hanging,
    #[part(at = [1.0, 0.0, 0.0])]
    right: Hanging,
    // It is raised from -2 to 1, and passes zero at 1.5 s.
    #[state(rate = sign(curve(time)))]
    tabled: f64,
    #[state(rate = sign(raised))]
    told: f64,
}

#[test]
fn laws_of_parts_of_tables_and_of_setpoints() {
    let mut names = Twice::SWITCHES.iter().map(|switch| switch.law);
    assert!(names.by_ref().eq(["left.rope", "right.rope", "tabled"]));
    let curve = Spline::natural([0.0, 1.0, 2.0], [-3.0, -1.0, 1.0]);
    let [left, right] = [40.0, 90.0].map(Hanging::new);
    let mut mechanism = Twice::new(curve, left, right).expect("acceptable");
    mechanism.raised.value = -2.0;
    let h = Twice::HANDLES;
    let tight = DormandPrince::new(super::tight());
    let report = mechanism
        .simulation(StandardLagrange, tight)
        .run(0.0..=2.0, every(0.01), |sample| {
            // About where the weight and the rope are in balance, at which it begins to move: it
            // never becomes slack.
            for (part, stiffness) in [(h.left, 40.0_f64), (h.right, 90.0)] {
                let wanted = 10.0 / stiffness * (1.0 - (stiffness.sqrt() * sample.time()).cos());
                let found = -1.0 - sample.pose(part.load).position.z;
                assert!((found - wanted).abs() < 1e-8, "{found} and {wanted}");
            }
        })
        .expect("it runs");
    let [tabled, told] = [h.tabled, h.told].map(|of| Twice::state_value(&report.state, of));
    assert!((tabled + 1.0).abs() < 1e-12 && (told + 2.0).abs() < 1e-12);
}

/// Something that is no number where it decides.
#[derive(Mechanism)]
struct Rooted {
    #[state(rate = if sqrt(1.0 - time) < 0.5 { 1.0 } else { 0.0 })]
    value: f64,
    #[state(rate = 1.0 + 0.0 * max(0.0, sqrt(0.5 - mirrored)))]
    mirrored: f64,
    #[body(free, mass = 1.0)]
    stone: Particle,
}

#[test]
fn what_is_not_a_number_is_refused_by_name() {
    let fault = Rooted::default()
        .simulation(StandardLagrange, DormandPrince::default())
        .run(0.0..=2.0, every(0.5), |_| ())
        .expect_err("it has no root")
        .fault;
    let Fault::Mode(ModeFault::SwitchUndecided { law, .. }) = fault else {
        panic!("{fault}");
    };
    assert!(["value", "mirrored"].contains(&law), "{fault}");
}

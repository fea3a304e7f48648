//! Laws that switch beside what else happens in a run.

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
            let (x, v) = (sample.displacement(h.rail), sample.displacement_rate(h.rail));
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
fn what_laws_that_switch_cannot_do_is_refused() {
    let mechanism = busy();
    let refused = mechanism
        .simulation(StandardLagrange, DormandPrince::default())
        .verified()
        .run(0.0..=1.0, every(0.5), |_| ())
        .expect_err("it has no companion");
    assert_eq!(refused.fault, Fault::NotVerified);
    let refused = mechanism
        .sensitivities([Busy::HANDLES.stiffness])
        .expect("acceptable")
        .simulation(StandardLagrange, DormandPrince::default())
        .run(0.0..=1.0, every(0.5), |_| ())
        .expect_err("derivatives jump");
    assert_eq!(refused.fault, Fault::SwitchLeftOut { law: "springs" });
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
    let Fault::SwitchUndecided { law, .. } = fault else {
        panic!("{fault}");
    };
    assert!(["value", "mirrored"].contains(&law), "{fault}");
}

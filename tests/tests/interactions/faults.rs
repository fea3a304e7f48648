//! What is refused, and how it is told.

use holonom::GeneralizedAlpha;
use holonom::error::{AssemblyFault, ReadingFault, StartFault};
use holonom::prelude::*;
use holonom::run::InteractionHandle;

use super::Ball;

fn fault(interaction: Interaction<f64, Ball>) -> Fault {
    let ball = Ball::default();
    let run = ball
        .simulation(StandardLagrange, DormandPrince::default())
        .interactions([interaction])
        .run(0.0..=1.0, every(0.1), |_| ());
    run.expect_err("it is refused").fault
}

#[test]
fn settings_are_checked_at_the_start() {
    let rail = Ball::HANDLES.rail.displacement();
    let limits = |bounds| Interaction::limits(rail, bounds);
    let refused = |interaction, name: &str| {
        let fault = fault(interaction);
        let is_told = matches!(fault, Fault::Start(StartFault::InteractionSetting { joint: "rail", setting, .. }) if setting == name);
        assert!(is_told, "{fault}");
    };
    refused(limits([1.0, -1.0]), "lower limit");
    refused(limits([f64::NAN, 1.0]), "lower limit");
    refused(limits([-1.0, 1.0]).restitution(1.5), "restitution");
    refused(limits([-1.0, 1.0]).restitution(f64::NAN), "restitution");
    refused(limits([-1.0, 1.0]).rest_below(-1.0), "rate of rest");
    let friction = |capacity| Interaction::friction(rail, capacity);
    refused(friction(-1.0), "capacity");
    refused(friction(f64::NAN), "capacity");
    refused(friction(2.0).stiction(1.0), "stiction");
    refused(friction(2.0).stiction(3.0).stribeck(0.0), "stribeck");
    refused(friction(2.0).stribeck(1.0), "stribeck");
    let clutch = |ratio| Interaction::clutch(rail, rail, ratio, 1.0);
    refused(clutch(2.0), "ratio of a quantity to itself");
    let told = fault(friction(-1.0)).to_string();
    let wanted = "the capacity of the interaction on `rail` is -1: it is zero or more";
    assert_eq!(told, wanted);
    let misplaced = fault(friction(1.0).restitution(0.5));
    let is_told = matches!(
        misplaced,
        Fault::Start(StartFault::MisplacedSetting {
            joint: "rail",
            setting: "restitution"
        })
    );
    assert!(is_told, "{misplaced}");
    let beyond = fault(limits([0.5, 1.0]));
    let is_told = matches!(
        beyond,
        Fault::Assembly(AssemblyFault::BeyondLimit {
            joint: "rail",
            limit: 0.5,
            ..
        })
    );
    assert!(is_told, "{beyond}");
}

#[test]
fn breaks_are_finite() {
    let ball = Ball::default();
    let run = ball
        .simulation(StandardLagrange, Rk4::every(0.1))
        .breaks(&[0.5, f64::NAN])
        .run(0.0..=1.0, every(0.1), |_| ());
    let fault = run.expect_err("no instant").fault;
    assert!(
        matches!(fault, Fault::Start(StartFault::BreakNotFinite { .. })),
        "{fault}"
    );
}

#[test]
fn handles_of_what_is_not_there_are_refused() {
    let (ball, rail) = (Ball::default(), Ball::HANDLES.rail.displacement());
    let brake = Interaction::brake(rail, 1.0);
    let stop = Interaction::limits(rail, [-9.0, 9.0]);
    let [first, second] = Interaction::handles(&[brake, brake]);
    assert_ne!(first, second);
    let engaged = |interaction: Interaction<f64, Ball>, handle: InteractionHandle<Ball>| {
        let run = ball
            .simulation(StandardLagrange, DormandPrince::default())
            .interactions([interaction])
            .on(
                "late",
                Crossing::Rising,
                |s| s.time() - 0.5,
                |event| event.engage(handle),
            )
            .run(0.0..=1.0, every(0.1), |_| ());
        run.map(|_| ()).map_err(|error| error.fault)
    };
    assert_eq!(engaged(brake, first), Ok(()));
    let another = Fault::Reading(ReadingFault::NoSuchInteraction {
        number: 1,
        interactions: 1,
    });
    assert_eq!(engaged(brake, second), Err(another));
    let no_limits = Fault::Reading(ReadingFault::NoSuchLimits { joint: "rail" });
    // A brake touches nowhere.
    let nowhere = ball
        .simulation(StandardLagrange, DormandPrince::default())
        .interactions([brake])
        .run(0.0..=0.1, every(0.1), |sample| {
            sample.contact_of(first).map(|_| ())
        });
    let no_contact = ReadingFault::NoContact {
        interaction: "rail",
    };
    assert!(matches!(nowhere, Err(RunError::Observer(fault)) if fault == no_contact));
    assert_eq!(engaged(brake, rail.limits()), Err(no_limits));
    // A stop is neither engaged nor released.
    let misplaced = Fault::Start(StartFault::MisplacedSetting {
        joint: "rail",
        setting: "engage",
    });
    let [listed] = Interaction::handles(&[stop]);
    for handle in [listed, rail.limits()] {
        assert_eq!(engaged(stop, handle), Err(misplaced));
    }
    // At the place of the handle is another interaction.
    let other = Fault::Reading(ReadingFault::NoSuchInteraction {
        number: 0,
        interactions: 1,
    });
    assert_eq!(engaged(stop, first), Err(other));
    assert_eq!(engaged(brake, listed), Err(other));
    let mut stepper = ball
        .stepper(StandardLagrange, Rk4)
        .expect("sound parameters")
        .interactions([stop]);
    let misplaced = Fault::Start(StartFault::MisplacedSetting {
        joint: "rail",
        setting: "release",
    });
    assert_eq!(stepper.release(rail.limits()), Err(misplaced));
    assert_eq!(stepper.engage(second), Err(another));
}

#[test]
fn generalized_alpha_is_refused() {
    let (ball, rail) = (Ball::default(), Ball::HANDLES.rail.displacement());
    let friction = Interaction::friction(rail, 1.0);
    let run = ball
        .simulation(StandardLagrange, GeneralizedAlpha::every(0.01))
        .absolute_coordinates()
        .interactions([friction])
        .run(0.0..=1.0, every(0.1), |_| ());
    assert_eq!(
        run.expect_err("it is refused").fault,
        Fault::Start(StartFault::NoInteractions)
    );
}

#[test]
fn an_impact_of_ones_own_acts_on_the_whole_mechanism() {
    use super::Arm;
    let (arm, h) = (Arm::default(), Arm::HANDLES);
    let mut start = arm.described_state().expect("it is described");
    arm.set_angle_rate(&mut start, h.elbow, 2.0)
        .expect("it is free");
    let mut checked = false;
    arm.simulation(StandardLagrange, DormandPrince::default())
        .joint_coordinates()
        .initial_state(start)
        .on(
            "stop",
            Crossing::Rising,
            |s| s.angle(h.elbow) - 0.5,
            |event| {
                let (before, energy) = (event.angle_rate(h.shoulder), event.kinetic_energy());
                let (q, r) = (event.angle(h.elbow), event.angle_rate(h.elbow));
                let impact = event.impact(h.elbow.angle(), 0.5)?;
                // The row of the shoulder in the mass matrix, by hand: its momentum is kept.
                let a = 0.25 + 3.0 * 0.25 + 0.1 + 2.0 * (1.0 + 0.16 + 0.8 * q.cos());
                let b = 0.1 + 2.0 * (0.16 + 0.4 * q.cos());
                let after = before + b / a * 1.5 * r;
                assert!((impact.rates[1] + 0.5 * r).abs() < 1e-12);
                let next = *event.state_mut();
                let view = arm.view(event.time(), &next).expect("a view");
                assert!((view.angle_rate(h.shoulder) - after).abs() < 1e-12);
                let lost = energy - view.kinetic_energy();
                assert!(
                    (impact.lost_energy - lost).abs() < 1e-12 && lost > 0.0,
                    "{impact:?} {lost}"
                );
                checked = true;
                Ok::<(), Fault>(())
            },
        )
        .run(0.0..=1.0, every(0.1), |_| ())
        .expect("it stops");
    assert!(checked);
}

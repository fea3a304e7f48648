//! What is refused of contacts with friction, and what has no motion or several.

use holonom::error::{ModeFault, StartFault, StepFault};
use holonom::nalgebra::Quaternion;
use holonom::prelude::*;
use holonom::run::Plane;

use super::balls::Bowling;
use super::blocks::Stack;
use super::tight;

type Of<M> = Interaction<f64, M>;

fn floor<M: Mechanism>() -> Plane<f64, M> {
    Plane::on_ground([0.0; 3], [0.0, 0.0, 1.0])
}

/// The fault of a run of the ball.
fn fault<const K: usize, const ALL: usize>(list: [Of<Bowling>; K]) -> Option<Fault>
where
    Bowling: holonom::run::Beside<K, ALL>,
{
    let run = Bowling::default()
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .interactions(list)
        .run(0.0..=0.1, every(0.1), |_| ());
    run.err().map(|error| error.fault)
}

#[test]
fn settings_that_are_none_are_named() {
    let h = Bowling::HANDLES;
    let contact = || Interaction::contact(h.ball, floor()).radius(0.1);
    let named = |fault: Option<Fault>, wanted: &str| match fault {
        Some(Fault::Start(StartFault::InteractionSetting {
            joint: "ball",
            setting,
            ..
        })) => assert_eq!(setting, wanted),
        fault => panic!("{wanted}: {fault:?}"),
    };
    named(fault(contact().with_friction(-0.1)), "coefficient");
    named(fault(contact().with_friction(f64::INFINITY)), "coefficient");
    named(fault(contact().radius(-0.1).with_friction(0.1)), "radius");
    named(
        fault(contact().radius(f64::NAN).with_friction(0.1)),
        "radius",
    );
    named(
        fault([contact().restitution_of_impulses(1.5)]),
        "restitution",
    );
    let along = floor().along([0.0, 0.0, 3.0]);
    let upright = Interaction::contact(h.ball, along).radius(0.1);
    named(fault(upright.with_friction(0.1)), "along");
    let disc = Interaction::contact_of_disc(h.ball, [0.0; 3], 0.1, floor());
    named(fault(disc.with_friction(0.1)), "axis");

    let misplaced = |fault: Option<Fault>, wanted: &str| match fault {
        Some(Fault::Start(StartFault::MisplacedSetting { setting, .. })) => {
            assert_eq!(setting, wanted);
        }
        fault => panic!("{wanted}: {fault:?}"),
    };
    let [normal, first, second] = contact().with_friction(0.1);
    let apart = "with_friction, apart from its contact";
    misplaced(fault([first, normal, second]), apart);
    misplaced(fault([normal, second, first]), apart);
    misplaced(fault([normal, first]), apart);
    misplaced(fault([normal, first, first]), apart);
    misplaced(fault([contact().radius(0.2), first, second]), apart);
    misplaced(fault([normal, first.stiction(0.2), second]), "stiction");
    misplaced(fault([normal, first.one_way(), second]), "one_way");
    misplaced(fault([contact().tube(0.1)]), "tube");
}

/// A block that falls on a corner, its centre of mass behind it.
fn falls(of_impulses: bool) -> Result<f64, Fault> {
    let (stack, h) = (Stack::new(0.0, 1.0).expect("it is"), Stack::HANDLES);
    let half: f64 = 0.0318;
    let (sine, cosine) = (2.0 * half).sin_cos();
    let mut start = stack.described_state().expect("it is described");
    let mut pose = stack.view(0.0, &start).expect("a view").pose(h.lower);
    pose.position = [0.0, 0.0, 0.5 * sine + cosine + 0.01].into();
    pose.orientation = Quaternion::new(half.cos(), 0.0, half.sin(), 0.0);
    Stack::set_pose(&mut start, h.lower, pose);
    Stack::set_velocity(&mut start, h.lower, [-0.7, 0.0, -1.0].into());
    let contact = Interaction::contact(h.right, floor());
    let contact = if of_impulses {
        contact.restitution_of_impulses(0.9)
    } else {
        contact.restitution(0.9)
    };
    let contact = contact.with_plane_friction(0.5);
    let [normal, _] = Interaction::handles(&contact);
    let mut lost = None;
    stack
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .initial_state(start)
        .interactions(contact)
        .run(0.0..=0.02, every(0.01), |sample| {
            lost = sample
                .impact(normal)
                .ok()
                .flatten()
                .map(|impact| impact.lost_energy);
        })
        .map_err(|error| error.fault)?;
    Ok(lost.expect("it falls"))
}

/// Kane and Levinson, Dynamics: theory and applications, 1985: with Newton's restitution the
/// friction of an impact may bring energy. That is no motion; with Poisson's it is lost.
#[test]
fn an_impact_that_would_bring_energy_is_named() {
    match falls(false) {
        Err(Fault::Mode(ModeFault::GainsEnergy {
            joint: "right",
            gained,
            ..
        })) => assert!(gained > 0.04 && gained < 0.1, "{gained}"),
        other => panic!("{other:?}"),
    }
    let lost = falls(true).expect("it loses energy");
    assert!(lost > 0.0, "{lost}");
}

/// Painleve's rod: beyond a coefficient of friction what slides is pressed down without end.
#[test]
fn a_block_that_digs_in_is_named() {
    let (stack, h) = (Stack::new(0.0, 1.0).expect("it is"), Stack::HANDLES);
    let half: f64 = -0.3;
    let (sine, cosine) = (2.0 * half).sin_cos();
    // With the corner at (x, z) from the centre of mass it is 1/m + x^2/I < -mu x z/I.
    let [x, z] = [0.5 * cosine - sine, -0.5 * sine - cosine];
    let critical = (1.25 / 3.0 + x * x) / (x * z).abs();
    for (friction, is_told) in [(critical - 1e-3, false), (critical + 1e-3, true)] {
        let mut start = stack.described_state().expect("it is described");
        let mut pose = stack.view(0.0, &start).expect("a view").pose(h.lower);
        pose.position = [0.0, 0.0, -z].into();
        pose.orientation = Quaternion::new(half.cos(), 0.0, half.sin(), 0.0);
        Stack::set_pose(&mut start, h.lower, pose);
        Stack::set_velocity(&mut start, h.lower, [1.0, 0.0, 0.0].into());
        let contact = Interaction::contact(h.right, floor()).with_plane_friction(friction);
        let run = stack
            .simulation(StandardLagrange, DormandPrince::new(tight()))
            .initial_state(start)
            .interactions(contact)
            .run(0.0..=1e-6, every(1e-6), |_| ());
        let fault = run.err().map(|error| error.fault);
        let told = matches!(
            fault,
            Some(Fault::Mode(ModeFault::NoUniqueFriction {
                joint: "right",
                ..
            }))
        );
        assert_eq!(told, is_told, "{friction} {critical}: {fault:?}");
    }
}

#[test]
fn a_disc_that_lies_flat_is_named() {
    let h = Bowling::HANDLES;
    let flat = Interaction::contact_of_disc(h.ball, [0.0, 0.0, 1.0], 0.1, floor());
    let found = fault(flat.with_friction(0.3));
    assert!(
        matches!(
            found,
            Some(Fault::Step(StepFault::EventNotANumber {
                event: "ball",
                ..
            }))
        ),
        "{found:?}"
    );
}

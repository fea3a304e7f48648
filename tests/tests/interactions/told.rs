//! What is told of modes, of their power, and of what goes wrong.

use holonom::ImplicitMidpoint;
use holonom::error::{ModeFault, StepFault};
use holonom::prelude::*;
use holonom::run::InteractionMode::{AtUpper, Sticking};

use super::{Belt, Block, Crank};

fn block(push: f64) -> Block {
    let mut block = Block::new(0.0, 0.0).expect("acceptable");
    block.push = push;
    block
}

/// The controller breaks the block loose at 1.25 s, between two reports.
#[test]
fn a_mode_that_a_controller_ends_is_shown_when_it_ends() {
    let (block, h) = (block(5.0), Block::HANDLES);
    let frictions = [Interaction::friction(h.slide.displacement(), 10.0)];
    let [friction] = Interaction::handles(&frictions);
    let mut loose = None;
    block
        .simulation(StandardLagrange, DormandPrince::default())
        .interactions(frictions)
        .every_period(1.25, |sample, inputs| {
            inputs.push = if sample.time() > 1.0 { 15.0 } else { 5.0 };
        })
        .run(0.0..=2.1, every(0.7), |sample| {
            if sample.mode(friction) != Ok(Sticking) && loose.is_none() {
                loose = Some(sample.time());
            }
        })
        .expect("it moves");
    assert_eq!(loose, Some(1.25));
}

/// The push ends at the stop, which bears what friction does not.
#[test]
fn friction_beside_a_stop_sticks_at_its_capacity() {
    let (block, h) = (block(20.0), Block::HANDLES);
    let slide = h.slide.displacement();
    for restitution in [0.0, 0.5] {
        let interactions = [
            Interaction::limits(slide, [-1.0, 0.5]).restitution(restitution),
            Interaction::friction(slide, 6.0),
        ];
        let handles = Interaction::handles(&interactions);
        block
            .simulation(StandardLagrange, DormandPrince::default())
            .interactions(interactions)
            .run(0.0..=4.0, every(1.0), |sample| -> Result<(), Fault> {
                let [stop, friction] = handles;
                let modes = [sample.mode(stop)?, sample.mode(friction)?];
                if sample.time() > 3.5 {
                    assert_eq!(modes, [AtUpper, Sticking]);
                    let efforts = [sample.effort(stop)?, sample.effort(friction)?];
                    assert!(
                        (efforts[0] + efforts[1] + 20.0).abs() < 1e-12,
                        "{efforts:?}"
                    );
                    assert!(efforts[1].abs() <= 6.0 && efforts[0] < 0.0, "{efforts:?}");
                } else if sample.time() == 0.0 {
                    assert_ne!(modes[1], Sticking);
                }
                Ok(())
            })
            .expect("it rests");
    }
}

/// By a capacity that is known, and by a coefficient of the load.
#[test]
fn power_has_the_friction() {
    let (block, h) = (block(2.0), Block::HANDLES);
    let by_load = Interaction::friction_by_load(h.slide, 0.2);
    let known = Interaction::friction(h.slide.displacement(), 3.0);
    for (friction, capacity) in [(known, 3.0), (by_load, 0.2 * 2.0 * super::GRAVITY)] {
        let mut start = block.described_state().expect("described");
        block
            .set_displacement_rate(&mut start, h.slide, 1.5)
            .expect("free");
        let mut last = None;
        block
            .simulation(StandardLagrange, DormandPrince::default())
            .interactions([friction])
            .initial_state(start)
            .run(0.0..=0.5, every(0.1), |sample| {
                let rate = sample.displacement_rate(h.slide);
                let power = sample.power();
                assert!((power - (2.0 - capacity) * rate).abs() < 1e-12, "{power}");
                // Power falls with the rate, which is linear in time.
                let now = (sample.time(), sample.kinetic_energy(), power);
                if let Some((time, energy, before)) = last.replace(now) {
                    let work = 0.5 * (before + power) * (now.0 - time);
                    assert!((now.1 - energy - work).abs() < 1e-9, "{now:?}");
                }
            })
            .expect("it slides");
    }
}

#[test]
fn a_handler_that_tears_a_loop_is_named() {
    let (crank, h) = (Crank::default(), Crank::HANDLES);
    let mut simulation = crank
        .simulation(StandardLagrange, DormandPrince::default())
        .on(
            "blow",
            Crossing::Rising,
            |s| s.time() - 0.1,
            |event| event.set_displacement_rate(h.rail, 3.0),
        );
    let fault = simulation.run(0.0..=1.0, every(0.1), |_| ());
    let fault = fault.expect_err("the rod tears").fault;
    let is_told = matches!(
        fault,
        Fault::Step(StepFault::HandlerOpens {
            event: "blow",
            joint: "rod",
            ..
        })
    );
    assert!(
        is_told && fault.to_string().contains("`event.impact`"),
        "{fault}"
    );
}

#[test]
fn a_driver_against_a_stop_is_named() {
    let (belt, h) = (Belt::default(), Belt::HANDLES);
    let stop = Interaction::limits(h.rollers.displacement(), [-0.1, 0.5]);
    let run = belt
        .simulation(StandardLagrange, DormandPrince::default())
        .interactions([stop])
        .run(0.0..=2.0, every(0.1), |_| ());
    let fault = run.expect_err("it is driven on").fault;
    let is_told = matches!(
        fault,
        Fault::Mode(ModeFault::DrivenAgainst {
            joint: "rollers",
            driver: "motor",
            is_upper: true,
            ..
        })
    );
    assert!(is_told, "{fault}");
}

/// Accelerations are constant within a mode, so that steps are exact, and each has a power of its
/// own.
#[test]
fn steps_that_are_exact_have_no_warning_however_few_a_mode_has() {
    let (block, h) = (block(4.0), Block::HANDLES);
    let slide = h.slide.displacement();
    let mut start = block.described_state().expect("described");
    block
        .set_displacement_rate(&mut start, h.slide, -6.0)
        .expect("free");
    let report = block
        .simulation(StandardLagrange, Rk4::every(0.3))
        .interactions([
            Interaction::limits(slide, [-1.0, 1.0]).restitution(0.9),
            Interaction::friction(slide, 1.0),
        ])
        .initial_state(start)
        .run(0.0..=3.0, every(3.0), |_| ())
        .expect("it bounces");
    let said = report.warnings().to_string();
    assert_eq!(said, "no warnings");
}

/// What friction holds moves by round-off only, which is compared with nothing.
#[test]
fn what_friction_holds_has_no_warning() {
    let (block, h) = (block(4.0), Block::HANDLES);
    let report = block
        .simulation(StandardLagrange, ImplicitMidpoint::every(0.01))
        .interactions([Interaction::friction(h.slide.displacement(), 10.0)])
        .run(0.0..=1.0, every(1.0), |_| ())
        .expect("it rests");
    let said = report.warnings().to_string();
    assert_eq!(said, "no warnings");
}

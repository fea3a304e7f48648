//! Capacities that a function scales: a clutch that is closed slowly, a brake by its pressure.

use holonom::error::{ModeFault, ReadingFault, StartFault};
use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::{InteractionHandle, InteractionMode as Mode, Reached};

use super::{Ball, Block, Gearbox, tight};

/// The motor turns, and the output rests.
fn turning(gearbox: &Gearbox, rate: f64) -> StateOf<Gearbox> {
    let mut state = gearbox.described_state().expect("it is described");
    gearbox
        .set_angle_rate(&mut state, Gearbox::HANDLES.input_shaft, rate)
        .expect("it is free");
    state
}

/// A clutch with a ratio `r` closes with `c t`: the slip is `w - k c t^2 / 2`, with the compliance
/// `k = 1/0.02 + r^2/0.1`, and what is lost is `w^2 / (2 k)`.
fn closes<C: Coordinates<Gearbox>>() {
    let (gearbox, h) = (Gearbox::default(), Gearbox::HANDLES);
    for (ratio, slope, rate) in [(1.0, 2.0, 30.0), (2.0, 0.4, -7.0), (-0.5, 1e3, 1e-2)] {
        let compliance = 1.0 / 0.02 + ratio * ratio / 0.1;
        let end = f64::sqrt(2.0 * f64::abs(rate) / (compliance * slope));
        let clutch = Interaction::clutch(
            h.input_shaft.angle(),
            h.output_shaft.angle(),
            ratio,
            0.5 * slope,
        );
        let interactions = [clutch];
        let [clutch] = Interaction::handles(&interactions);
        let mut met = None;
        let report = Simulation::new(&gearbox, StandardLagrange, DormandPrince::new(tight()))
            .coordinates::<C>()
            .initial_state(turning(&gearbox, rate))
            .interactions(interactions)
            .capacity_factor(clutch, |view, _| 2.0 * view.time())
            .run(0.0..=1.5 * end, every(end / 7.0), |sample| {
                let time = sample.time();
                let mode = sample.mode(clutch).expect("it is listed");
                let effort = sample.effort(clutch).expect("it is listed");
                let slip =
                    sample.angle_rate(h.input_shaft) - ratio * sample.angle_rate(h.output_shaft);
                if mode == Mode::Sticking {
                    met.get_or_insert(time);
                    assert!(slip.abs() < 1e-12 * rate.abs() && effort.abs() < 1e-9);
                } else {
                    let wanted = rate - rate.signum() * compliance * slope * time * time / 2.0;
                    assert!(
                        (slip - wanted).abs() < 1e-10 * rate.abs(),
                        "{slip} {wanted}"
                    );
                    let wanted = -rate.signum() * slope * time;
                    assert!((effort - wanted).abs() < 1e-12 * slope * end);
                    assert!(
                        (sample.power() - effort * slip).abs() <= 1e-12 * (effort * slip).abs()
                    );
                }
            })
            .expect("it closes");
        let met = met.expect("it is closed");
        assert!((met / end - 1.0).abs() < 1e-9, "{met} {end}");
        let energy = gearbox
            .view(1.5 * end, &report.state)
            .expect("a view")
            .kinetic_energy();
        let lost = 0.01 * rate * rate - energy;
        let wanted = rate * rate / (2.0 * compliance);
        assert!((lost / wanted - 1.0).abs() < 1e-10, "{lost} {wanted}");
    }
}

#[test]
fn a_clutch_is_closed_slowly() {
    closes::<Relative>();
    closes::<Absolute>();
}

/// A capacity of `8 N (1 - t/2)` falls through a push of 5 N. With a stiction of 10 N, that of
/// `10 N (1 - t/2)` does.
fn slips<C: Coordinates<Block>>() {
    let block = Block {
        push: 5.0,
        ..Block::new(0.0, 0.0).expect("a block")
    };
    let slide = Block::HANDLES.slide;
    let friction = Interaction::friction(slide.displacement(), 8.0);
    for (friction, start) in [(friction, 0.75), (friction.stiction(10.0), 1.0)] {
        let interactions = [friction];
        let [friction] = Interaction::handles(&interactions);
        let mut slid = None;
        Simulation::new(&block, StandardLagrange, DormandPrince::new(tight()))
            .coordinates::<C>()
            .interactions(interactions)
            .capacity_factor(friction, |view, _| 1.0 - 0.5 * view.time())
            .run(0.0..=1.9, every(0.1), |sample| {
                let time = sample.time();
                let effort = sample.effort(friction).expect("it is listed");
                if sample.mode(friction) == Ok(Mode::Sticking) {
                    assert!(slid.is_none() && (effort + 5.0).abs() < 1e-12);
                    assert!(sample.displacement(slide).abs() < 1e-12);
                    return;
                }
                let start = *slid.get_or_insert(time);
                assert!((effort + 8.0 - 4.0 * time).abs() < 1e-11, "{effort}");
                // 2 kg a = 5 - 8 + 4 t
                let rate = (time - start) * (time + start - 1.5);
                let found = sample.displacement_rate(slide);
                assert!((found - rate).abs() < 1e-10, "{time}: {found} {rate}");
            })
            .expect("it runs");
        let slid = slid.expect("it slides");
        assert!((slid - start).abs() < 1e-9, "{slid} {start}");
    }
}

#[test]
fn what_sticks_slips_where_its_capacity_falls_below_its_effort() {
    slips::<Relative>();
    slips::<Absolute>();
}

/// A brake by a reading of the motion: `c = x` N against a push of 5 N. The block oscillates about
/// `x = 5`, and its rate first vanishes at 10 m, where it sticks.
#[test]
fn a_capacity_follows_the_motion() {
    let block = Block {
        push: 5.0,
        ..Block::new(0.0, 0.0).expect("a block")
    };
    let slide = Block::HANDLES.slide;
    let interactions = [Interaction::friction(slide.displacement(), 2.0)];
    let [friction] = Interaction::handles(&interactions);
    let frequency = f64::sqrt(0.5);
    let report = block
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .interactions(interactions)
        .capacity_factor(friction, |view, _| 0.5 * view.displacement(slide).max(0.0))
        .run(0.0..=6.0, every(0.5), |sample| {
            let phase = (frequency * sample.time()).min(core::f64::consts::PI);
            let wanted = 5.0 * (1.0 - phase.cos());
            let found = sample.displacement(slide);
            assert!((found - wanted).abs() < 1e-8, "{found} {wanted}");
            let sticks = sample.mode(friction) == Ok(Mode::Sticking);
            let beyond = frequency * sample.time() - core::f64::consts::PI;
            assert!(beyond.abs() < 1e-8 || sticks == (beyond > 0.0), "{beyond}");
        })
        .expect("it runs");
    assert!(report.accepted > 5);
}

/// The input `load` is the pressure of a brake of 2 N m on the motor, which 3 N m drive.
#[test]
fn inputs_scale_a_capacity_between_steps_and_instants() {
    let gearbox = Gearbox {
        torque: 3.0,
        ..Gearbox::default()
    };
    let shaft = Gearbox::HANDLES.input_shaft;
    let interactions = [Interaction::brake(shaft.angle(), 2.0)];
    let [brake] = Interaction::handles(&interactions);
    let pressure = |time: f64| if time < 0.19999 { 1.0 } else { 2.0 };
    // 3 - 2 N m over 0.02 kg m^2 for 0.2 s, then 3 - 4 N m until it stands.
    let rate = |time: f64| (50.0 * time).min(20.0 - 50.0 * time).max(0.0);
    let report = gearbox
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .interactions(interactions)
        .capacity_factor(brake, |_, inputs| inputs.load)
        .every_period(0.1, |sample, inputs| inputs.load = pressure(sample.time()))
        .run(0.0..=0.6, every(0.05), |sample| {
            let (found, wanted) = (sample.angle_rate(shaft), rate(sample.time()));
            assert!((found - wanted).abs() < 1e-9, "{found} {wanted}");
        })
        .expect("it runs");
    let mut run = gearbox
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .interactions(interactions)
        .capacity_factor(brake, |_, inputs| inputs.load)
        .begin(0.0..=0.6)
        .expect("it begins");
    for time in [0.0, 0.2] {
        run.advance_to(time).expect("it advances");
        run.change(|event| event.inputs_mut().load = pressure(time))
            .expect("an input");
    }
    while run.advance().expect("it advances") != Reached::End {}
    let led = *run.state();
    let mut stepper = gearbox
        .stepper(StandardLagrange, Rk4)
        .expect("it is prepared")
        .interactions(interactions)
        .capacity_factor(brake, |_, inputs| inputs.load);
    let mut state = stepper.initial_state().expect("a state");
    let mut inputs = gearbox.inputs();
    for _ in 0..600 {
        inputs.load = pressure(stepper.time());
        stepper.set_inputs(&inputs).expect("they are finite");
        stepper.step(&mut state, 1e-3).expect("it steps");
        let bodies = stepper.bodies(&state);
        let (found, wanted) = (
            stepper.view(&bodies).angle_rate(shaft),
            rate(stepper.time()),
        );
        assert!((found - wanted).abs() < 1e-9, "{found} {wanted}");
    }
    assert_eq!(stepper.mode(brake), Ok(Mode::Sticking));
    let effort = stepper.effort(brake, &state).expect("it is listed");
    assert!((effort + 3.0).abs() < 1e-12, "{effort}");
    let bodies = stepper.bodies(&state);
    for state in [&report.state, &led, &bodies] {
        let angle = stepper.view(state).angle(shaft);
        assert!((angle - 2.0).abs() < 1e-9, "{angle}");
    }
}

/// Two functions are multiplied, and what else is said of a run may come before and behind.
#[test]
fn functions_of_one_capacity_are_multiplied() {
    let (block, slide) = (Block::new(0.0, 0.0).expect("a block"), Block::HANDLES.slide);
    let interactions = [Interaction::friction(slide.displacement(), 8.0)];
    let [friction] = Interaction::handles(&interactions);
    let report = block
        .simulation(StandardLagrange, RadauIIA::new(tight()))
        .interactions(interactions)
        .capacity_factor(friction, |view, _| 1.0 - 0.5 * view.time())
        .without_limits()
        .capacity_factor(friction, |view, _| 1.0 - 0.5 * view.time())
        .forces(|_, _, loads| loads.force_between(slide, 2.0))
        .verified()
        .run(0.0..=2.0, every(0.5), |_| ())
        .expect("it slips");
    // v' = 1 - (2 - t)^2 from 1 s on
    let view = block.view(2.0, &report.state).expect("a view");
    let rate = view.displacement_rate(slide);
    assert!((rate - (1.0 - 1.0 / 3.0)).abs() < 1e-9, "{rate}");
    let found = report.verification.expect("it is asked for");
    let worst = found.worst().expect("a body");
    assert!(found.ended.is_none() && worst.position < 1e-6, "{worst:?}");
}

/// Nothing to hold, and nothing to hold it with.
#[test]
fn a_capacity_of_zero_holds_nothing() {
    let (block, slide) = (Block::new(0.0, 3.0).expect("a block"), Block::HANDLES.slide);
    let interactions = [Interaction::friction(slide.displacement(), 2.0)];
    let [friction] = Interaction::handles(&interactions);
    let report = block
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .interactions(interactions)
        .capacity_factor(friction, |view, _| (1.0 - view.time()).max(0.0))
        .breaks(&[1.0])
        .run(0.0..=2.0, every(0.1), |_| ())
        .expect("it runs");
    // It slips at 3 t = 2 (1 - t), and slides freely from 1 s on.
    let start = 0.4;
    let at_one = 0.5 * (2.5 * (1.0 - start * start) - 2.0 * (1.0 - start));
    let wanted = at_one + 0.5 * 1.5 * 3.0;
    let view = block.view(2.0, &report.state).expect("a view");
    let found = view.displacement_rate(slide);
    assert!((found - wanted).abs() < 1e-9, "{found} {wanted}");
}

fn fault(
    interactions: [Interaction<f64, Ball>; 2],
    handle: InteractionHandle<Ball>,
    factor: impl Fn(f64) -> f64,
) -> Fault {
    let ball = Ball::default();
    let run = ball
        .simulation(StandardLagrange, DormandPrince::default())
        .interactions(interactions)
        .capacity_factor(handle, |view, _| factor(view.time()))
        .run(0.0..=1.0, every(0.1), |_| ());
    run.expect_err("it is refused").fault
}

#[test]
fn factors_that_are_none_are_refused() {
    let rail = Ball::HANDLES.rail.displacement();
    let stop = Interaction::limits(rail, [-9.0, 9.0]);
    let interactions = [Interaction::friction(rail, 1.0), stop];
    let [friction, limits] = Interaction::handles(&interactions);
    let told = fault(interactions, friction, |_| -0.5).to_string();
    let wanted = "the factor of the capacity of the friction on `rail` is -0.5 at 0 s: it must be finite and not negative";
    assert_eq!(told, wanted);
    for bad in [-1e-9, f64::NAN, f64::INFINITY] {
        let late = fault(
            interactions,
            friction,
            |time| if time > 0.5 { bad } else { 1.0 },
        );
        let is_told = matches!(late, Fault::Mode(ModeFault::CapacityFactor { joint: "rail", time, .. }) if time > 0.5);
        assert!(is_told, "{late}");
    }
    let misplaced = Fault::Start(StartFault::MisplacedSetting {
        joint: "rail",
        setting: "capacity_factor",
    });
    assert_eq!(fault(interactions, limits, |_| 1.0), misplaced);
    let dogs = [Interaction::brake(rail, f64::INFINITY), stop];
    assert_eq!(fault(dogs, friction, |_| 1.0), misplaced);
    let sticks = [
        Interaction::friction(rail, 1.0).stiction(f64::INFINITY),
        stop,
    ];
    assert_eq!(fault(sticks, friction, |_| 1.0), misplaced);
    let other = Fault::Reading(ReadingFault::NoSuchInteraction {
        number: 0,
        interactions: 2,
    });
    assert_eq!(fault([stop, stop], friction, |_| 1.0), other);
}

//! A block on an inclined plane.

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::InteractionMode as Mode;

use super::{GRAVITY, Incline, tight};

const SINE: f64 = 0.6;
const COSINE: f64 = 0.8;

fn thrown(incline: &Incline, rate: f64) -> StateOf<Incline> {
    let mut state = incline.described_state().expect("it is described");
    incline
        .set_displacement_rate(&mut state, Incline::HANDLES.slide, rate)
        .expect("it is free");
    state
}

fn throw<C: Coordinates<Incline>, F: Formulation<f64>>(formulation: F, bound: f64) {
    let (incline, h) = (Incline::default(), Incline::HANDLES);
    for (mu, up) in [(0.9, 3.1), (0.5, 2.3), (0.0, 1.7)] {
        // It rises, stops, and then stays or slides down.
        let brakes = GRAVITY * (SINE + mu * COSINE);
        let (stop, top) = (up / brakes, up * up / (2.0 * brakes));
        let falls = (GRAVITY * (SINE - mu * COSINE)).max(0.0);
        let frictions = [Interaction::friction_by_load(h.slide, mu)];
        let [friction] = Interaction::handles(&frictions);
        let mut modes = Vec::new();
        let report = Simulation::new(&incline, formulation, DormandPrince::new(tight()))
            .coordinates::<C>()
            .initial_state(thrown(&incline, -up))
            .interactions(frictions)
            .run(0.0..=2.0, every(0.1), |sample| -> Result<(), Fault> {
                let time = sample.time();
                let after = (time - stop).max(0.0);
                let before = time.min(stop);
                let place = -up * before + 0.5 * brakes * before * before;
                let place = place + 0.5 * falls * after * after;
                let found = sample.displacement(h.slide);
                assert!(
                    (found - place).abs() < bound,
                    "{mu} {time}: {found} {place}"
                );
                if (time - stop).abs() > 1e-9 {
                    let mode = sample.mode(friction)?;
                    if modes.last() != Some(&mode) {
                        modes.push(mode);
                    }
                    let effort = match mode {
                        Mode::Sticking => -2.0 * GRAVITY * SINE,
                        Mode::SlidingDown => 2.0 * GRAVITY * mu * COSINE,
                        _ => -2.0 * GRAVITY * mu * COSINE,
                    };
                    let found = sample.effort(friction)?;
                    assert!(
                        (found - effort).abs() < bound,
                        "{mu} {time}: {found} {effort}"
                    );
                }
                Ok(())
            })
            .expect("it slides");
        assert!((top - up * up / (2.0 * brakes)).abs() < 1e-15);
        let last = if falls > 0.0 {
            Mode::SlidingUp
        } else {
            Mode::Sticking
        };
        assert_eq!(modes, [Mode::SlidingDown, last], "{mu}");
        assert!(report.warnings().is_empty(), "{}", report.warnings());
    }
}

#[test]
fn a_block_that_is_thrown_up_stops_and_stays_or_slides_back() {
    throw::<Relative, _>(StandardLagrange, 1e-10);
    throw::<Absolute, _>(StandardLagrange, 1e-10);
    let baumgarte = Baumgarte {
        alpha: 5.0,
        beta: 5.0,
    };
    throw::<Relative, _>(baumgarte, 1e-10);
    throw::<Absolute, _>(baumgarte, 1e-10);
    throw::<Absolute, _>(AugmentedLagrangian::default(), 1e-6);
}

fn stays<C: Coordinates<Incline>>() {
    let (incline, h) = (Incline::default(), Incline::HANDLES);
    // A little above the angle of friction, and a little below.
    for (mu, stays) in [(0.750_001, true), (0.749_999, false)] {
        let end = if stays { 1e4 } else { 10.0 };
        let report = Simulation::new(&incline, StandardLagrange, DormandPrince::default())
            .coordinates::<C>()
            .interactions([Interaction::friction_by_load(h.slide, mu)])
            .run(0.0..=end, every(end), |_| ())
            .expect("it runs");
        let view = incline.view(end, &report.state).expect("a view");
        let found = view.displacement(h.slide);
        let wanted = if stays {
            0.0
        } else {
            0.5 * GRAVITY * (SINE - mu * COSINE) * end * end
        };
        assert!((found - wanted).abs() < 1e-10, "{mu}: {found:e} {wanted:e}");
    }
}

#[test]
fn a_block_within_its_angle_of_friction_does_not_creep() {
    stays::<Relative>();
    stays::<Absolute>();
}

fn loosens<C: Coordinates<Incline>>() {
    // 40 N press it on at first, 4 N/s less and less: it slips where
    // mu (m g cos + 40 - 4 t) = m g sin. Behind it m x'' = mu 4 (t - slip).
    let (incline, h) = (Incline::default(), Incline::HANDLES);
    let (mu, mass) = (0.4, 2.0);
    let slip = (40.0 + mass * GRAVITY * (COSINE - SINE / mu)) / 4.0;
    let frictions = [Interaction::friction_by_load(h.slide, mu)];
    let [friction] = Interaction::handles(&frictions);
    let mut seen = [false; 2];
    let report = Simulation::new(&incline, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .forces(|time, _, loads| {
            let press = 40.0 - 4.0 * time;
            loads.force(h.block, [-SINE * press, 0.0, -COSINE * press]);
        })
        .interactions(frictions)
        .run(0.0..=9.0, every(0.1), |sample| -> Result<(), Fault> {
            let time = sample.time();
            let after = (time - slip).max(0.0);
            let wanted = mu * 4.0 / mass * after.powi(3) / 6.0;
            let found = sample.displacement(h.slide);
            assert!((found - wanted).abs() < 1e-9, "{time}: {found} {wanted}");
            if (time - slip).abs() > 1e-8 {
                let sticks = time < slip;
                seen[usize::from(sticks)] = true;
                let mode = if sticks {
                    Mode::Sticking
                } else {
                    Mode::SlidingUp
                };
                assert_eq!(sample.mode(friction)?, mode, "{time} {slip}");
            }
            Ok(())
        })
        .expect("it slips");
    assert!(seen == [true; 2] && slip > 4.0 && slip < 8.0, "{slip}");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
}

#[test]
fn a_block_slips_where_its_load_no_longer_holds_it() {
    loosens::<Relative>();
    loosens::<Absolute>();
}

#[test]
fn stiction_and_stribeck_are_of_coefficients() {
    let (incline, h) = (Incline::default(), Incline::HANDLES);
    let friction = Interaction::friction_by_load(h.slide, 0.5).stiction(0.7);
    let rate = |friction: Interaction<f64, Incline>| {
        let report = incline
            .simulation(StandardLagrange, DormandPrince::new(tight()))
            .interactions([friction])
            .run(0.0..=1.0, every(1.0), |_| ())
            .expect("it slides");
        incline
            .view(1.0, &report.state)
            .expect("a view")
            .displacement_rate(h.slide)
    };
    // 0.7 does not hold it, 0.8 would.
    let wanted = GRAVITY * (SINE - 0.5 * COSINE);
    let found = rate(friction);
    assert!((found - wanted).abs() < 1e-10, "{found} {wanted}");
    let stuck = rate(Interaction::friction_by_load(h.slide, 0.5).stiction(0.8));
    assert!(stuck.abs() < 1e-20, "{stuck:e}");
    // The same motion as by a known capacity, whose load is that of the incline.
    let load = 2.0 * GRAVITY * COSINE;
    let known = Interaction::friction(h.slide.displacement(), 0.5 * load).stiction(0.7 * load);
    let (known, found) = (rate(known.stribeck(0.8)), rate(friction.stribeck(0.8)));
    assert!((known - found).abs() < 1e-10, "{known} {found}");
    assert!((known - wanted).abs() > 1e-2, "{known} {wanted}");
}

#[test]
fn steps_and_single_precision() {
    let (incline, h) = (Incline::default(), Incline::HANDLES);
    let brakes = GRAVITY * (SINE + 0.9 * COSINE);
    let frictions = [Interaction::friction_by_load(h.slide, 0.9)];
    let [friction] = Interaction::handles(&frictions);
    let mut stepper = incline
        .stepper(StandardLagrange, Rk4)
        .expect("it is prepared")
        .interactions(frictions);
    let mut state = stepper
        .state_of(&thrown(&incline, -2.0))
        .expect("it is consistent");
    for _ in 0..1000 {
        stepper.step(&mut state, 1e-3).expect("it moves");
    }
    let bodies = stepper.bodies(&state);
    let place = stepper.view(&bodies).displacement(h.slide);
    assert!((place + 2.0 / brakes).abs() < 1e-11, "{place}");
    assert_eq!(stepper.mode(friction), Ok(Mode::Sticking));
    let effort = stepper.effort(friction, &state).expect("it is known");
    assert!((effort + 2.0 * GRAVITY * SINE).abs() < 1e-10, "{effort}");

    let friction = Interaction::<f32, _>::friction_by_load(h.slide, 0.9);
    let mut start = incline.described_state::<f32>().expect("it is described");
    incline
        .set_displacement_rate(&mut start, h.slide, -2.0)
        .expect("it is free");
    let report = Simulation::<Problem<_, _, f32>, _>::new(
        &incline,
        StandardLagrange,
        DormandPrince::<f32>::default(),
    )
    .initial_state(start)
    .interactions([friction])
    .run(0.0..=1.0, every(0.1), |_| ())
    .expect("it stops");
    let place = incline
        .view(1.0, &report.state)
        .expect("a view")
        .displacement(h.slide);
    assert!((f64::from(place) + 2.0 / brakes).abs() < 1e-5, "{place}");
}

fn bounces<C: Coordinates<Incline>>() {
    let (incline, h) = (Incline::default(), Incline::HANDLES);
    let slide = h.slide.displacement();
    let mut impacts: Vec<f64> = Vec::new();
    let mut last = f64::NAN;
    let interactions = [
        Interaction::limits(slide, [f64::NEG_INFINITY, 1.0]).restitution(0.5),
        Interaction::friction_by_load(h.slide, 0.5),
    ];
    let [stop, friction] = Interaction::handles(&interactions);
    let report = Simulation::new(&incline, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .interactions(interactions)
        .run(0.0..=20.0, every(0.1), |sample| -> Result<(), Fault> {
            if let Some(impact) = sample.impact(stop)?
                && impact.time != last
            {
                last = impact.time;
                impacts.push(impact.rates[0]);
            }
            if sample.time() > 10.0 {
                // Stop and friction share what holds it.
                assert_eq!(sample.mode(friction)?, Mode::Sticking);
                let held = sample.effort(stop)? + sample.effort(friction)?;
                assert!((held + 2.0 * GRAVITY * SINE).abs() < 1e-10, "{held}");
                let capacity = 2.0 * GRAVITY * 0.5 * COSINE;
                assert!(sample.effort(friction)?.abs() < capacity * (1.0 + 1e-11));
                // The top of the last bounce is nearer than what counts as touching.
                let beyond = sample.displacement(h.slide) - 1.0;
                assert!(beyond.abs() < 1e-9, "{beyond:e}");
            }
            Ok(())
        })
        .expect("it comes to rest");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    // Down by g (sin - mu cos), up against g (sin + mu cos).
    let [down, up] = [-0.5, 0.5].map(|mu| GRAVITY * (SINE + mu * COSINE));
    assert!(
        (impacts[0] - (2.0 * down).sqrt()).abs() < 1e-10,
        "{impacts:?}"
    );
    for pair in impacts.windows(2).take(4) {
        let ratio = pair[1] / pair[0];
        assert!(
            (ratio - 0.5 * (down / up).sqrt()).abs() < 1e-8,
            "{impacts:?}"
        );
    }
    assert!(impacts.len() > 4, "{impacts:?}");
}

#[test]
fn a_block_that_rubs_bounces_on_a_stop_until_it_rests() {
    bounces::<Relative>();
    bounces::<Absolute>();
}

/// A coefficient that wears off: it slips where `mu (1 - t/2)` falls below 0.75.
fn wears<C: Coordinates<Incline>>() {
    let (incline, h) = (Incline::default(), Incline::HANDLES);
    let interactions = [Interaction::friction_by_load(h.slide, 1.0)];
    let [friction] = Interaction::handles(&interactions);
    let mut slid = None;
    let report = Simulation::new(&incline, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .interactions(interactions)
        .capacity_factor(friction, |view, _| 1.0 - 0.5 * view.time())
        .run(0.0..=1.5, every(0.1), |sample| {
            if sample.mode(friction) != Ok(Mode::Sticking) {
                let start = *slid.get_or_insert(sample.time());
                let after = sample.time() - start;
                // g (sin - cos (1 - t/2))
                let rate = 0.25 * GRAVITY * COSINE * after * after;
                let found = sample.displacement_rate(h.slide);
                assert!((found - rate).abs() < 1e-9, "{found} {rate}");
            }
        })
        .expect("it slips");
    let start = slid.expect("it slips");
    assert!(
        (start - 0.5).abs() < 1e-9 && report.warnings().is_empty(),
        "{start}"
    );
}

#[test]
fn a_coefficient_wears_off() {
    wears::<Relative>();
    wears::<Absolute>();
}

//! Limits in the description, which runs heed.

use core::f64::consts::{PI, TAU};

use holonom::error::{AssemblyFault, ReadingFault, StartFault};
use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::InteractionMode;

use super::{GRAVITY, tight};

/// A ball of 1 kg on a vertical rail between a floor and a lid, which are parameters. It is thrown
/// upwards at 3 m/s.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Shaft {
    #[param]
    floor: f64,
    #[param]
    height: f64,
    #[param]
    bounce: f64,
    #[body(
        mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 1.0], velocity = [0.0, 0.0, 3.0]
    )]
    ball: Body,
    #[joint(
        between = [ground, ball], point = [0.0, 0.0, 1.0], axis = [0.0, 0.0, 1.0],
        limits = [floor, floor + height], restitution = bounce
    )]
    rail: Prismatic,
}

/// Floor, height and restitution.
const NUMBERS: [f64; 3] = [-0.5, 0.75, 0.8];

fn shaft() -> Shaft {
    let [floor, height, bounce] = NUMBERS;
    Shaft::new(floor, height, bounce).expect("acceptable")
}

/// The displacement until the ball meets the lid or the floor a second time: it meets the lid
/// first, if that is low enough, and then the floor.
fn bounced(time: f64, [floor, height, bounce]: [f64; 3]) -> f64 {
    let thrown =
        |from: f64, rate: f64, since: f64| from + rate * since - 0.5 * GRAVITY * since * since;
    let (mut start, mut rate, mut since) = (0.0, 3.0, time);
    let lid = floor + height;
    let left = rate * rate - 2.0 * GRAVITY * lid;
    if left > 0.0 {
        let meets = (rate - left.sqrt()) / GRAVITY;
        if since < meets {
            return thrown(start, rate, since);
        }
        (start, rate, since) = (lid, -bounce * left.sqrt(), since - meets);
    }
    let fast = (rate * rate + 2.0 * GRAVITY * (start - floor)).sqrt();
    let falls = (rate + fast) / GRAVITY;
    if since < falls {
        return thrown(start, rate, since);
    }
    thrown(floor, bounce * fast, since - falls)
}

fn parameters_are_limits<C: Coordinates<Shaft>>() {
    let h = Shaft::HANDLES;
    for numbers in [NUMBERS, [-0.2, 1.0, 0.5]] {
        let [floor, height, bounce] = numbers;
        let shaft = Shaft::new(floor, height, bounce).expect("acceptable");
        let mut shown = 0;
        Simulation::new(&shaft, StandardLagrange, DormandPrince::new(tight()))
            .coordinates::<C>()
            .run(0.0..=0.8, every(0.01), |sample| {
                let (found, wanted) =
                    (sample.displacement(h.rail), bounced(sample.time(), numbers));
                assert!((found - wanted).abs() < 1e-11, "{found} {wanted}");
                shown += 1;
            })
            .expect("it bounces");
        assert!(shown > 80);
    }
}

#[test]
fn limits_may_be_parameters() {
    parameters_are_limits::<Relative>();
    parameters_are_limits::<Absolute>();
}

#[test]
fn limits_of_the_description_are_interactions() {
    let (shaft, h) = (shaft(), Shaft::HANDLES);
    let simulation = || shaft.simulation(StandardLagrange, Rk4::every(0.003));
    let rail = Interaction::limits(h.rail.displacement(), [-0.5, 0.25]).restitution(0.8);
    let wanted = simulation()
        .without_limits()
        .interactions([rail])
        .run(0.0..=3.0, every(0.1), |_| ())
        .expect("it bounces");
    let found = simulation()
        .run(0.0..=3.0, every(0.1), |_| ())
        .expect("it bounces");
    assert_eq!(found, wanted);
    assert_ne!(
        found.state,
        simulation()
            .interactions([])
            .without_limits()
            .run(0.0..=3.0, every(0.1), |_| ())
            .expect("it falls")
            .state
    );
    let fallen = simulation().without_limits();
    let fallen = fallen.run(0.0..=3.0, every(0.1), |_| ()).expect("it falls");
    let view = shaft.view(3.0, &fallen.state).expect("acceptable");
    assert!(view.displacement(h.rail) < -30.0);
}

/// What a run is given acts beside the limits of the description. Limits of the same quantity take
/// their place, and their handle is of those that hold. Everything may be said in any order.
#[test]
fn interactions_of_a_run_stand_beside_limits_of_the_description() {
    let (shaft, h) = (shaft(), Shaft::HANDLES);
    let simulation = || shaft.simulation(StandardLagrange, Rk4::every(0.003));
    let rail = h.rail.displacement();
    let friction = Interaction::friction(rail, 3.0);
    let [own] = shaft.limits();
    let end = |report: RunReport<f64, Shaft>| {
        let view = shaft.view(report.time, &report.state).expect("acceptable");
        (view.displacement(h.rail), view.displacement_rate(h.rail))
    };
    let handle = rail.limits();
    let (to, often) = (0.0..=2.0, every(0.1));
    let mut last = None;
    let beside = simulation().interactions([friction]);
    let beside = beside.run(to.clone(), often, |sample| {
        last = sample.impact(handle).expect("it has limits");
    });
    let beside = end(beside.expect("it rubs and bounces"));
    assert!(last.is_some());
    let list = [friction, own];
    let [_, listed] = Interaction::handles(&list);
    let mut last_listed = None;
    let run = simulation().interactions(list);
    let run = run.run(to.clone(), often, |sample| {
        last_listed = sample.impact(listed).expect("it is in the list");
        assert_eq!(sample.impact(handle), Ok(last_listed), "it is the list's");
    });
    assert_eq!(end(run.expect("it rubs and bounces")), beside);
    assert_eq!(last_listed, last);
    let alone = simulation().without_limits().interactions(list);
    let alone = alone.run(to.clone(), often, |sample| {
        assert_eq!(sample.impact(handle), sample.impact(listed));
    });
    assert_eq!(end(alone.expect("it bounces")), beside);
    let mut late = simulation()
        .on(
            "top",
            Crossing::Falling,
            |s| s.displacement_rate(h.rail),
            |_| (),
        )
        .interactions([friction, own])
        .without_limits()
        .initial_state(shaft.described_state().expect("described"));
    let (found, rate) = end(late.run(to.clone(), often, |_| ()).expect("it bounces"));
    assert!((found - beside.0).abs() < 1e-9 && (rate - beside.1).abs() < 1e-8);
    // A run's own limits may be wider.
    let wider = simulation().interactions([Interaction::limits(rail, [-2.0, 0.25])]);
    let stops = wider.run_until(to, Crossing::Falling, |sample| {
        sample.displacement(h.rail) + 1.9
    });
    assert!(stops.expect("it falls").stopped);
}

/// A handler, or the owner of a loop, lowers the floor while the ball flies.
#[test]
fn limits_change_with_their_parameters() {
    let [floor, height, bounce] = NUMBERS;
    let (shaft, h) = (shaft(), Shaft::HANDLES);
    let lower = Shaft::new(floor - 0.3, height + 0.3, bounce).expect("acceptable");
    let mut least = 0.0_f64;
    let mut simulation = shaft
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .on(
            "lower",
            Crossing::Rising,
            |s| s.time() - 0.2,
            |event| event.update(&lower),
        );
    let report = simulation.run(0.0..=0.8, every(0.01), |sample| {
        least = least.min(sample.displacement(h.rail));
    });
    let end = report.expect("it bounces").state;
    let view = lower.view(0.8, &end).expect("acceptable");
    let wanted = bounced(0.8, [floor - 0.3, height + 0.3, bounce]);
    assert!(
        (view.displacement(h.rail) - wanted).abs() < 1e-9,
        "{wanted}"
    );
    assert!((least + 0.8).abs() < 1e-9, "{least}");
    let mut stepper = shaft.stepper(StandardLagrange, Rk4).expect("acceptable");
    let mut state = stepper.initial_state().expect("described");
    for number in 0..800 {
        if number == 200 {
            stepper.update(&lower).expect("acceptable");
        }
        stepper.step(&mut state, 1e-3).expect("it bounces");
    }
    let bodies = stepper.bodies(&state);
    assert!((stepper.view(&bodies).displacement(h.rail) - wanted).abs() < 1e-9);
}

/// What does not heed them says so.
#[test]
fn what_does_not_heed_them_refuses() {
    use holonom::lanes::Ensemble;
    use holonom::sensitivity::SensitivityExt as _;
    let left_out = |fault: Fault| {
        let text = fault.to_string();
        let is_told = matches!(
            fault,
            Fault::Start(StartFault::LimitsLeftOut { joint: "rail", .. })
        );
        assert!(is_told && text.contains("without_limits"), "{text}");
    };
    let (shaft, h) = (shaft(), Shaft::HANDLES);
    let mut stepper = shaft.stepper(StandardLagrange, Rk4).expect("acceptable");
    let mut state = stepper.initial_state().expect("described");
    left_out(stepper.step_dense(&mut state, 0.01).expect_err("one"));
    let mut free = stepper.without_limits();
    assert!(free.step_dense(&mut state, 0.01).is_ok());
    let ensemble = Ensemble::<Problem<_, _>, _, 1>::new(&[shaft], StandardLagrange, Rk4);
    let mut ensemble = ensemble.expect("acceptable");
    left_out(ensemble.step(0.01).expect_err("it has none"));
    assert_eq!(ensemble.without_limits().step(0.01), Ok(()));
    let shaft = self::shaft();
    let along = shaft.sensitivities([h.height]).expect("acceptable");
    let along = along.simulation(StandardLagrange, Rk4::every(0.01));
    let run = along.run(0.0..=0.1, every(0.1), |_| ());
    left_out(run.expect_err("it has none").fault);
    let along = along.without_limits();
    assert!(along.run(0.0..=0.1, every(0.1), |_| ()).is_ok());
}

#[test]
fn a_stepper_heeds_them() {
    let (shaft, h) = (shaft(), Shaft::HANDLES);
    let mut stepper = shaft.stepper(StandardLagrange, Rk4).expect("acceptable");
    let mut state = stepper.initial_state().expect("it is described");
    for number in 1..=800_u32 {
        stepper.step(&mut state, 1e-3).expect("it bounces");
        let bodies = stepper.bodies(&state);
        let found = stepper.view(&bodies).displacement(h.rail);
        let wanted = bounced(f64::from(number) * 1e-3, NUMBERS);
        assert!((found - wanted).abs() < 1e-11, "{found} {wanted}");
    }
}

#[test]
fn what_a_run_refuses_is_named() {
    let beyond = Shaft::new(0.5, 1.0, 0.8).expect("finite");
    let run = |shaft: &Shaft| {
        let limited = shaft.simulation(StandardLagrange, Rk4::every(0.01));
        let run = limited.run(0.0..=1.0, every(0.1), |_| ());
        run.expect_err("it is refused").fault
    };
    let fault = run(&beyond);
    let is_told = matches!(
        fault,
        Fault::Assembly(AssemblyFault::BeyondLimit {
            joint: "rail",
            limit: 0.5,
            ..
        })
    );
    assert!(is_told, "{fault}");
    let unordered = Shaft::new(-1.0, -1.0, 0.8).expect("finite");
    let fault = run(&unordered);
    let setting = "lower limit";
    let is_told = matches!(fault, Fault::Start(StartFault::InteractionSetting { joint: "rail", setting: s, .. }) if s == setting);
    assert!(is_told, "{fault}");
    let lively = Shaft::new(-1.0, 2.0, 1.2).expect("finite");
    let is_told = |fault| matches!(fault, Fault::Start(StartFault::InteractionSetting { joint: "rail", setting, .. }) if setting == "restitution");
    assert!(is_told(run(&lively)));
    assert!(Shaft::new(f64::NAN, 1.0, 0.8).is_err());
    let mut spoiled = shaft();
    spoiled.floor = f64::INFINITY;
    assert!(matches!(run(&spoiled), Fault::Parameter(_)));
}

/// A nut of 2 kg that falls along a screw of 0.1 m a turn, to two turns below.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Nut {
    #[body(mass = 2.0, inertia = [0.01, 0.01, 0.02])]
    nut: Body,
    #[joint(
        between = [ground, nut], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0], pitch = 0.1,
        limits = [-2.0 * TAU, TAU], restitution = 0.5
    )]
    thread: Screw,
}

fn a_screw_stops_by_its_angle<C: Coordinates<Nut>>() {
    let (nut, h) = (Nut::default(), Nut::HANDLES);
    let lead = 0.1 / TAU;
    let acceleration = 2.0 * GRAVITY * lead / (2.0 * lead * lead + 0.02);
    let wanted = (2.0 * 2.0 * TAU / acceleration).sqrt();
    let stop = h.thread.angle().limits();
    let mut first = None;
    Simulation::new(&nut, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .run(0.0..=4.0, every(0.05), |sample| {
            if let Some(impact) = sample.impact(stop).expect("one") {
                first.get_or_insert(impact);
            }
            let height = sample.displacement(h.thread);
            assert!(height > -0.2 - 1e-10, "{height}");
        })
        .expect("it falls");
    let first = first.expect("it arrives");
    assert!((first.time - wanted).abs() < 1e-9, "{first:?} {wanted}");
    let [before, after] = first.rates;
    assert!((before + acceleration * wanted).abs() < 1e-8, "{first:?}");
    assert!((after + 0.5 * before).abs() < 1e-10 * before.abs());
}

#[test]
fn the_limits_of_a_screw_are_angles() {
    a_screw_stops_by_its_angle::<Relative>();
    a_screw_stops_by_its_angle::<Absolute>();
}

/// A chain that hangs down from hinges that turn less and less far.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Chain {
    #[body(mass = 1.0, inertia = [0.1, 0.01, 0.1], position = [0.0, 0.5 + k, 0.0])]
    links: [Body; 3],
    #[joint(between = [ground, links[0]], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    root: Revolute,
    #[joint(
        between = [links[k], links[k + 1]], point = [0.0, 1.0 + k, 0.0], axis = [1.0, 0.0, 0.0],
        limits = [-0.2 / (1.0 + k), 0.1]
    )]
    hinges: [Revolute; 2],
}

#[test]
fn elements_of_arrays_have_limits_of_their_own() {
    let (chain, h) = (Chain::default(), Chain::HANDLES);
    let mut least = [0.0_f64; 2];
    let report = chain
        .simulation(StandardLagrange, DormandPrince::default())
        .run(0.0..=1.5, every(0.01), |sample| {
            for (least, hinge) in least.iter_mut().zip(h.hinges) {
                *least = least.min(sample.angle(hinge));
            }
            let [first, second] = h.hinges.map(|hinge| sample.mode(hinge.angle().limits()));
            assert!(first.is_ok() && second.is_ok());
            let fault = ReadingFault::NoSuchLimits { joint: "root" };
            assert_eq!(sample.mode(h.root.angle().limits()), Err(fault));
        })
        .expect("it swings");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    for (least, bound) in least.into_iter().zip([-0.2, -0.1]) {
        assert!((least - bound).abs() < 1e-9, "{least} {bound}");
    }
}

/// A wing on a hinge, which falls to its stop.
#[derive(Assembly, Clone, Copy)]
struct Wing {
    #[port]
    hull: Body,
    #[param]
    droop: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.01, 0.1], position = [0.0, 0.5, 0.0])]
    plate: Body,
    #[joint(
        between = [hull, plate], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0],
        limits = [-droop, 0.5]
    )]
    hinge: Revolute,
}

#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Bird {
    #[part(hull = ground)]
    left: Wing,
    #[part(hull = ground, mirror = y)]
    right: Wing,
}

#[test]
fn parts_and_their_mirror_images_have_limits() {
    let bird = Bird::new(Wing::new(0.7), Wing::new(0.3)).expect("acceptable");
    let h = Bird::HANDLES;
    let mut last = [0.0; 2];
    bird.simulation(StandardLagrange, DormandPrince::default())
        .run(0.0..=2.0, every(0.1), |sample| {
            let hinges = [h.left.hinge, h.right.hinge];
            last = hinges.map(|hinge| sample.angle(hinge));
            let modes = hinges.map(|hinge| sample.mode(hinge.angle().limits()).expect("two"));
            let is_still = modes == [InteractionMode::AtLower; 2];
            assert!(is_still || sample.time() < 1.0, "{modes:?}");
        })
        .expect("it droops");
    assert!((last[0] + 0.7).abs() < 1e-12, "{last:?}");
    assert!((last[1] + 0.3).abs() < 1e-12, "{last:?}");
}

/// Numbers that are laid down elsewhere.
mod drawing {
    pub(super) const STOPS: [f64; 2] = [-core::f64::consts::PI, 0.25];
}

#[derive(Mechanism)]
#[mechanism(coordinates = "joints", kernels = [mass, inverse])]
struct Wheel {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.2], angular_velocity = [0.0, 0.0, -2.0])]
    wheel: Body,
    #[joint(
        between = [ground, wheel], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0],
        limits = [drawing::STOPS[0], drawing::STOPS[1]], restitution = 1.0
    )]
    hinge: Revolute,
}

#[test]
fn limits_may_be_constants() {
    let (wheel, h) = (Wheel::default(), Wheel::HANDLES);
    wheel
        .simulation(StandardLagrange, DormandPrince::default())
        .run(0.0..=20.0, every(0.1), |sample| {
            // To and fro at 2 rad/s.
            let (way, span) = (2.0 * sample.time(), PI + 0.25);
            let phase = (way + 0.25).rem_euclid(2.0 * span);
            let wanted = 0.25 - phase.min(2.0 * span - phase);
            let found = sample.angle(h.hinge);
            let off = (found - wanted + PI).rem_euclid(TAU) - PI;
            assert!(off.abs() < 1e-9, "{found} {wanted}");
        })
        .expect("it turns");
}

/// Nothing acts on the wheel, so that it is in equilibrium wherever it is asked for.
#[test]
fn equilibria_beyond_a_limit_are_named() -> Result<(), Fault> {
    let (wheel, h) = (Wheel::default(), Wheel::HANDLES);
    let space = wheel.coordinates([h.hinge])?;
    let [inside, beyond] = [space.state([0.2], [0.0])?, space.state([1.5], [0.0])?];
    assert!(space.equilibrium(&inside).is_ok() && space.check_limits(&inside).is_ok());
    let found = [
        space.equilibrium(&beyond).err(),
        space.check_limits(&beyond).map_err(Fault::from).err(),
    ];
    for fault in found {
        let is_told = matches!(
            fault,
            Some(Fault::Assembly(AssemblyFault::BeyondLimit { joint: "hinge", value, limit: 0.25 })) if (value - 1.5).abs() < 1e-12
        );
        assert!(is_told, "{fault:?}");
    }
    assert!(space.without_limits().equilibrium(&beyond).is_ok());
    Ok(())
}

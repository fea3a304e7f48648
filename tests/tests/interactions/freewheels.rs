//! Brakes and clutches that transmit their effort in one direction alone.

use holonom::error::{Fault, StartFault};
use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::InteractionMode::{SlidingDown, SlidingUp, Sticking};
use holonom::run::{InteractionMode, Plane};

use super::{Block, Falling, Gearbox, tight};

const ENDLESS: f64 = f64::INFINITY;

/// A block that is pushed by `push + ramp t`.
fn pushed(push: f64, ramp: f64) -> Block {
    let mut block = Block::new(0.0, ramp).expect("a block");
    block.push = push;
    block
}

fn brake(capacity: f64) -> Interaction<f64, Block> {
    Interaction::brake(Block::HANDLES.slide.displacement(), capacity).one_way()
}

/// What a block with a freewheel does: the time, its place, rate, effort and mode.
type Seen = (f64, f64, f64, f64, InteractionMode);

/// Runs a block from a place at a rate, with the brake engaged at a time where it is given. The
/// impulses along it come back, and how many steps it took.
fn run<C: Coordinates<Block>>(
    block: &Block,
    brake: Interaction<f64, Block>,
    [x, v]: [f64; 2],
    engaged: Option<f64>,
    seen: impl Fn(Seen),
) -> Option<[f64; 4]> {
    let h = Block::HANDLES;
    let mut start = block.described_state().expect("it is described");
    block
        .set_displacement(&mut start, h.slide, x)
        .and_then(|()| block.set_displacement_rate(&mut start, h.slide, v))
        .expect("it is free");
    let brakes = [brake];
    let [brake] = Interaction::handles(&brakes);
    let at = engaged.unwrap_or(-1.0);
    let mut impact = None;
    let report = Simulation::new(block, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .initial_state(start)
        .interactions(brakes)
        .on(
            "engage",
            Crossing::Rising,
            |sample| sample.time() - at,
            |event| event.engage(brake),
        )
        .run(0.0_f64..=6.0, every(0.25), |sample| {
            let effort = sample.effort(brake).expect("one interaction");
            let mode = sample.mode(brake).expect("one interaction");
            let (x, v) = (
                sample.displacement(h.slide),
                sample.displacement_rate(h.slide),
            );
            seen((sample.time(), x, v, effort, mode));
            impact = sample.impact(brake).expect("one interaction").map(|it| {
                let [before, after] = it.rates;
                [it.impulse, before, after, it.lost_energy]
            });
        })
        .expect("it goes through");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    assert!(report.accepted < 500, "{}", report.accepted);
    impact
}

fn near(what: f64, wanted: f64) {
    assert!((what - wanted).abs() < 1e-10, "{what} {wanted}");
}

/// The modes of both sides are told where one ends.
fn is_mode((time, .., mode): Seen, wanted: InteractionMode, ends: &[f64]) {
    let at_end = ends.iter().any(|end| (time - end).abs() < 1e-6);
    assert!(at_end || mode == wanted, "{time} {mode:?} {wanted:?}");
}

/// Both coordinates.
macro_rules! both {
    ($($test:ident: $body:ident;)*) => {$(
        #[test]
        fn $test() {
            $body::<Relative>();
            $body::<Absolute>();
        }
    )*};
}

both! {
    a_backstop_bears_any_effort_and_lets_go: lets_go;
    a_backstop_slips_above_its_capacity: slips;
    more_than_its_stiction_moves_it: breaks_away;
    what_never_moved_and_bears_nothing_stays: rests;
    an_effort_may_begin_at_zero: begins_at_zero;
    a_negative_rate_is_stopped_by_an_impulse: catches;
    a_swing_is_held_where_it_would_turn_back: holds_a_swing;
    it_is_engaged_while_it_moves: is_engaged;
    a_sprag_clutch_drives_and_is_overrun: drives;
    beside_dry_friction_it_lets_go_as_well: beside_friction;
}

/// `2 t - 8` N on 2 kg: free from 4 s on.
fn lets_go<C: Coordinates<Block>>() {
    for capacity in [ENDLESS, 8.5] {
        let seen = |seen: Seen| {
            let (time, x, v, effort, _) = seen;
            let free = (time - 4.0).max(0.0);
            near(x, free * free * free / 6.0);
            near(v, 0.5 * free * free);
            near(effort, (8.0 - 2.0 * time).max(0.0));
            is_mode(seen, if free > 0.0 { SlidingUp } else { Sticking }, &[4.0]);
        };
        let block = pushed(-8.0, 2.0);
        assert_eq!(
            run::<C>(&block, brake(capacity), [0.0; 2], None, seen),
            None
        );
    }
}

/// `2 t - 7` N against 4 N: down to 3 s, at rest to 3.5 s, and upwards.
fn slips<C: Coordinates<Block>>() {
    let seen = |seen: Seen| {
        let (time, x, v, effort, _) = seen;
        let (down, up) = (time.min(3.0), (time - 3.5).max(0.0));
        let fallen = (down * down * down / 3.0 - 1.5 * down * down) / 2.0;
        near(x, fallen + up * up * up / 6.0);
        near(v, (down * down - 3.0 * down) / 2.0 + 0.5 * up * up);
        let (mode, wanted) = if time < 3.0 {
            (SlidingDown, 4.0)
        } else if time < 3.5 {
            (Sticking, 7.0 - 2.0 * time)
        } else {
            (SlidingUp, 0.0)
        };
        is_mode(seen, mode, &[3.0, 3.5]);
        if (time - 3.0).abs() > 1e-6 {
            near(effort, wanted);
        }
    };
    run::<C>(&pushed(-7.0, 2.0), brake(4.0), [0.0; 2], None, seen);
}

/// `-2 t` N: at rest up to 6 N, then against 4 N.
fn breaks_away<C: Coordinates<Block>>() {
    let rate = |t: f64| 0.5 * t * t - 2.0 * t + 1.5;
    let way = |t: f64| t * t * t / 6.0 - t * t + 1.5 * t;
    let seen = |seen: Seen| {
        let (time, x, v, ..) = seen;
        let slid = time.max(3.0);
        near(v, -rate(slid));
        near(x, way(3.0) - way(slid));
        let mode = if time < 3.0 { Sticking } else { SlidingDown };
        is_mode(seen, mode, &[3.0]);
    };
    let brake = brake(4.0).stiction(6.0);
    run::<C>(&pushed(0.0, -2.0), brake, [0.0; 2], None, seen);
}

fn rests<C: Coordinates<Block>>() {
    for capacity in [ENDLESS, 5.0, 0.0] {
        let seen = |(_, x, v, effort, _): Seen| assert_eq!([x, v, effort], [0.0; 3]);
        let block = pushed(0.0, 0.0);
        assert_eq!(
            run::<C>(&block, brake(capacity), [0.0; 2], None, seen),
            None
        );
    }
}

fn begins_at_zero<C: Coordinates<Block>>() {
    for capacity in [ENDLESS, 15.0] {
        let rises = |(time, x, _, effort, _): Seen| {
            near(x, time * time * time / 6.0);
            near(effort, 0.0);
        };
        run::<C>(&pushed(0.0, 2.0), brake(capacity), [0.0; 2], None, rises);
        let holds = |(time, x, _, effort, _): Seen| {
            near(x, 0.0);
            near(effort, 2.0 * time);
        };
        run::<C>(&pushed(0.0, -2.0), brake(capacity), [0.0; 2], None, holds);
    }
}

fn catches<C: Coordinates<Block>>() {
    let stays = |(time, x, v, _, mode): Seen| {
        near(x, 0.0);
        if time > 0.0 {
            near(v, 0.0);
            assert_eq!(mode, Sticking);
        }
    };
    let impact = run::<C>(&pushed(-1.0, 0.0), brake(ENDLESS), [0.0, -3.0], None, stays);
    let impact = impact.expect("it is stopped");
    for (is, wanted) in impact.into_iter().zip([6.0, -3.0, 0.0, 9.0]) {
        near(is, wanted);
    }
    // With a capacity 4 N do it, within 1.5 s.
    let brakes = |seen: Seen| {
        let (time, x, v, effort, _) = seen;
        let left = (1.5 - time).max(0.0);
        near(v, -2.0 * left);
        near(x, left * left - 2.25);
        is_mode(
            seen,
            if left > 0.0 { SlidingDown } else { Sticking },
            &[1.5],
        );
        if (time - 1.5).abs() > 1e-6 {
            near(effort, if left > 0.0 { 4.0 } else { 0.0 });
        }
    };
    let impact = run::<C>(&pushed(0.0, 0.0), brake(4.0), [0.0, -3.0], None, brakes);
    assert_eq!(impact, None);
}

/// Half a swing from -0.1 m, by 200 N/m.
fn holds_a_swing<C: Coordinates<Block>>() {
    let block = Block::new(200.0, 0.0).expect("a block");
    let half = core::f64::consts::PI / 10.0;
    for (capacity, begins) in [(ENDLESS, -0.1), (20.5, -0.1), (ENDLESS, 0.1)] {
        let seen = |(time, x, _, effort, mode): Seen| {
            let is_over = begins > 0.0 || time > half;
            let phase = if is_over { half } else { time };
            near(x, -0.1 * (10.0 * phase).cos());
            if is_over {
                near(effort, 20.0);
                assert_eq!(mode, Sticking);
            }
        };
        let impact = run::<C>(&block, brake(capacity), [begins, 0.0], None, seen);
        near(impact.map_or(0.0, |[impulse, ..]| impulse), 0.0);
    }
}

fn is_engaged<C: Coordinates<Block>>() {
    let block = pushed(0.0, 0.0);
    let released = brake(ENDLESS).released();
    let falls = |(time, x, ..): Seen| near(x, -3.0 * time.min(0.3));
    let impact = run::<C>(&block, released, [0.0, -3.0], Some(0.3), falls);
    near(impact.expect("it is stopped")[0], 6.0);
    let rises = |(time, x, ..): Seen| near(x, 3.0 * time);
    let impact = run::<C>(&block, released, [0.0, 3.0], Some(0.3), rises);
    assert_eq!(impact, None);
    // It stops by itself, and is held.
    let held = |(time, x, _, effort, _): Seen| {
        let left = (3.0 - time).max(0.0);
        near(x, 4.5 - 0.5 * left * left);
        if (time - 3.0).abs() > 1e-6 {
            near(effort, if left > 0.0 { 0.0 } else { 2.0 });
        }
    };
    let impact = run::<C>(&pushed(-2.0, 0.0), released, [0.0, 3.0], Some(0.3), held);
    near(impact.map_or(0.0, |[impulse, ..]| impulse), 0.0);
}

/// A motor of 0.02 kg m^2 that drives 0.1 kg m^2.
fn drives<C: Coordinates<Gearbox>>() {
    let h = Gearbox::HANDLES;
    let (output, motor) = (h.output_shaft.angle(), h.input_shaft.angle());
    let clutches = [Interaction::clutch(output, motor, 1.0, ENDLESS).one_way()];
    let [clutch] = Interaction::handles(&clutches);
    // Torque, load and the first rates; rates after 1 s, effort and impulse.
    let common = 10.0 * 0.02 / 0.12;
    let cases = [
        ([0.6, 0.0, 0.0, 0.0], [5.0, 5.0, 0.5, 0.0]),
        ([0.0, 0.0, 10.0, 0.0], [common, common, 0.0, 0.1 * common]),
        ([0.0, 0.12, 6.0, 6.0], [5.0, 5.0, 0.02, 0.0]),
        ([0.0, -0.1, 6.0, 6.0], [6.0, 7.0, 0.0, 0.0]),
        ([0.01, 0.0, 1.0, 9.0], [1.5, 9.0, 0.0, 0.0]),
        // The motor comes up to the output within 0.5 s, and takes it along.
        ([0.6, 0.0, 0.0, 15.0], [17.5, 17.5, 0.5, 0.0]),
    ];
    for ([torque, load, v, w], [motor, output, effort, impulse]) in cases {
        let mut gears = Gearbox::default();
        (gears.torque, gears.load) = (torque, load);
        let mut start = gears.described_state().expect("it is described");
        gears
            .set_angle_rate(&mut start, h.input_shaft, v)
            .and_then(|()| gears.set_angle_rate(&mut start, h.output_shaft, w))
            .expect("they are free");
        let mut seen = [0.0; 4];
        Simulation::new(&gears, StandardLagrange, DormandPrince::new(tight()))
            .coordinates::<C>()
            .initial_state(start)
            .interactions(clutches)
            .run(0.0_f64..=1.0, every(0.3), |sample| {
                let impact = sample.impact(clutch).expect("one interaction");
                seen = [
                    sample.angle_rate(h.input_shaft),
                    sample.angle_rate(h.output_shaft),
                    sample.effort(clutch).expect("one interaction"),
                    impact.map_or(0.0, |impact| impact.impulse),
                ];
            })
            .expect("it turns");
        for (is, wanted) in seen.into_iter().zip([motor, output, effort, impulse]) {
            near(is, wanted);
        }
    }
}

/// `2 t - 8` N against friction of 2 N upwards: from 5 s on.
fn beside_friction<C: Coordinates<Block>>() {
    let (block, h) = (pushed(-8.0, 2.0), Block::HANDLES);
    let friction = Interaction::friction(h.slide.displacement(), 2.0);
    let report = Simulation::new(&block, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .interactions([brake(ENDLESS), friction])
        .run(0.0_f64..=7.0, every(0.5), |sample| {
            let free = (sample.time() - 5.0).max(0.0);
            near(sample.displacement(h.slide), free * free * free / 6.0);
        })
        .expect("it lets go");
    assert!(report.accepted < 500, "{}", report.accepted);
}

#[test]
fn it_is_misplaced_at_limits_contacts_and_friction_by_load() {
    let (h, point) = (Block::HANDLES, Falling::HANDLES.end);
    let fault = |interaction: Interaction<f64, Block>| {
        let block = pushed(0.0, 0.0);
        Simulation::new(&block, StandardLagrange, DormandPrince::new(tight()))
            .interactions([interaction])
            .run(0.0_f64..=1.0, every(1.0), |_| ())
            .expect_err("it is misplaced")
            .fault
    };
    let limits = Interaction::limits(h.slide.displacement(), [-1.0, 1.0]);
    let by_load = Interaction::friction_by_load(h.slide, 0.2);
    let misplaced = |joint| {
        let setting = "one_way";
        Fault::Start(StartFault::MisplacedSetting { joint, setting })
    };
    for interaction in [limits, by_load] {
        assert_eq!(fault(interaction.one_way()), misplaced("slide"));
    }
    let plane = Plane::on_ground([0.0; 3], [0.0, 0.0, 1.0]);
    let falling = Falling::default();
    let contact = Simulation::new(&falling, StandardLagrange, DormandPrince::new(tight()))
        .interactions([Interaction::contact(point, plane).one_way()])
        .run(0.0_f64..=1.0, every(1.0), |_| ());
    assert_eq!(
        contact.expect_err("it is misplaced").fault,
        misplaced("end")
    );
}

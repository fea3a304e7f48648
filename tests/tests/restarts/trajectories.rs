//! Trajectories against what observers were shown, and against closed forms.

use holonom::error::ReadingFault;
use holonom::integrate::{DormandPrince5, DormandPrince8, FixedStep};
use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::{Checkpoint, Steps, Trajectory};
use holonom::state::Vector as _;
use holonom::{
    Adams, AdamsBashforthMoulton4, Bdf, DormandPrince853, GeneralizedAlpha, RadauIIA, Runs,
};

use super::{Flap, Shown, flap};

const END: f64 = 2.0;

/// The largest difference of a trajectory from what the observer of its run was shown, and how many
/// states it holds for each step. Orientations are compared at length 1, and counted angles as the
/// orientations have them: reports leave those of the interpolant.
fn apart<I, C>(method: I, projected: bool) -> (f64, f64)
where
    C: Coordinates<Flap>,
    I: Runs<Problem<Flap, StandardLagrange, f64, C>>,
{
    let flap = flap();
    let mut shown: Shown<Flap> = Vec::new();
    let mut motion = Trajectory::new();
    let simulation = Simulation::new(&flap, StandardLagrange, method).coordinates::<C>();
    let simulation = if projected {
        simulation.projection(Projection::default())
    } else {
        simulation
    };
    let plain = simulation
        .run(0.0..=END, every(0.0137), |_| ())
        .expect("it runs");
    let report = simulation
        .trajectory(&mut motion)
        .run(0.0..=END, every(0.0137), |sample| {
            shown.push((sample.time(), *sample.state()));
        })
        .expect("it runs");
    assert_eq!(report.state, plain.state, "nothing is changed by a record");
    assert_eq!(report.accepted, plain.accepted);
    assert_eq!(motion.at(END).expect("within"), report.state);
    assert_eq!(motion.interval(), Some(0.0..=END));
    assert!(shown.len() > 140);
    let constants = Flap::prepare(&flap.parameters::<f64>().expect("acceptable"));
    let unit = |mut state: StateOf<Flap>| {
        Flap::rewrap(&constants, &mut state);
        for body in [Flap::HANDLES.door, Flap::HANDLES.flap] {
            let pose = Flap::pose(&state, body);
            Flap::set_pose(&mut state, body, pose);
        }
        state
    };
    let largest = shown.iter().fold(0.0, |largest: f64, (time, state)| {
        let (found, state) = (unit(motion.at(*time).expect("within")), unit(*state));
        let apart = found.weighted_norm(&state, 1.0, [(1.0, &found), (-1.0, &state)]);
        largest.max(apart)
    });
    (largest, motion.len() as f64 / report.accepted as f64)
}

#[test]
fn a_trajectory_is_what_observers_are_shown() {
    macro_rules! in_both {
        ($($method:expr),* $(,)?) => {$(
            let what = stringify!($method);
            let found = [
                apart::<_, Relative>($method, false),
                apart::<_, Relative>($method, true),
                apart::<_, Absolute>($method, false),
                apart::<_, Absolute>($method, true),
            ];
            println!("{what}: {found:?}");
            for (largest, _) in found {
                assert!(largest < 1e-10, "{what}: {found:?}");
            }
        )*};
    }
    let room = std::thread::Builder::new().stack_size(1 << 26);
    let compared = room.spawn(|| {
        in_both![
            Rk4::every(0.02),
            AdamsBashforthMoulton4::every(0.02),
            DormandPrince::default(),
            DormandPrince853::default(),
            Adams::default(),
            Bdf::default(),
        ];
        // A state within its step is solved for, up to 0.03 of what a step may leave, which is
        // `0.1 rtol^(2/3)`.
        let method = RadauIIA::<f64>::default();
        let allowed = 0.03 * 0.1 * method.tolerance.relative.powf(2.0 / 3.0);
        let radau = [
            apart::<_, Relative>(method, false),
            apart::<_, Absolute>(method, true),
        ];
        println!("Radau: {radau:?}, {allowed:e}");
        assert!(
            radau.iter().all(|(largest, _)| *largest < allowed),
            "{radau:?}"
        );
        let alpha = apart::<_, Absolute>(GeneralizedAlpha::every(0.02), false);
        assert!(alpha.0 < 1e-10, "{alpha:?}");
    });
    if let Err(panic) = compared.expect("a thread").join() {
        std::panic::resume_unwind(panic);
    }
}

/// A ball of 1 kg on a vertical rail, at the height 1 m.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Ball {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 1.0])]
    ball: Body,
    #[joint(between = [ground, ball], point = [0.0, 0.0, 1.0], axis = [0.0, 0.0, 1.0])]
    rail: Prismatic,
}

/// Both sides of a jump, and parabolas between jumps; across a restart.
#[test]
fn jumps_have_two_sides() {
    let (ball, h) = (Ball::default(), Ball::HANDLES);
    let build = || ball.simulation(StandardLagrange, DormandPrince::default());
    let bounce = |event: &mut holonom::run::Event<'_, f64, Ball>| {
        event.set_displacement_rate(h.rail, -0.5 * event.displacement_rate(h.rail))
    };
    let height = |sample: &Sample<'_, f64, Ball>| sample.pose(h.ball).position.z;
    let mut kept: Vec<Checkpoint<Ball>> = Vec::new();
    let mut whole = Trajectory::new();
    assert!(whole.is_empty() && whole.interval().is_none());
    build()
        .on("floor", Crossing::Falling, height, bounce)
        .trajectory(&mut whole)
        .checkpoints(1, |checkpoint| kept.push(checkpoint.clone()))
        .run(0.0..=1.0, every(1.0), |_| ())
        .expect("it bounces");

    let hit = (2.0_f64 / 9.81).sqrt();
    let ends: Vec<f64> = whole.ends().collect();
    let at = *ends
        .iter()
        .min_by(|a, b| (*a - hit).abs().total_cmp(&(*b - hit).abs()))
        .expect("one");
    assert!((at - hit).abs() < 1e-12, "{at} {hit}");
    let rate = |state: &StateOf<Ball>| Ball::velocity(state, h.ball).z;
    let before = whole.before(at).expect("within");
    let after = whole.at(at).expect("within");
    assert!((rate(&before) + 9.81 * hit).abs() < 1e-12);
    assert!((rate(&after) + 0.5 * rate(&before)).abs() < 1e-14);
    for k in 0..90 {
        let time = 0.01 * f64::from(k);
        let state = whole.at(time).expect("within");
        let since = time - hit;
        let exact = if since < 0.0 {
            1.0 - 0.5 * 9.81 * time * time
        } else {
            0.5 * 9.81 * (hit * since - since * since)
        };
        assert!(
            (Ball::pose(&state, h.ball).position.z - exact).abs() < 1e-12,
            "{time}"
        );
    }
    assert_eq!(
        whole.before(0.0).expect("within"),
        whole.at(0.0).expect("within")
    );
    for outside in [-1e-9, 1.0 + 1e-9, f64::NAN] {
        assert!(whole.at(outside).is_err() && whole.before(outside).is_err());
    }
    let error = whole.at(1.5).expect_err("outside").to_string();
    assert_eq!(
        error,
        "the trajectory goes from 0 s to 1 s, and was asked for 1.5 s"
    );
    let none = Trajectory::<Ball>::new()
        .at(1.0)
        .expect_err("none")
        .to_string();
    assert!(none.starts_with("the trajectory knows no motion"), "{none}");

    let mut resumed = whole.clone();
    let half = &kept[kept.len() / 2];
    build()
        .on("floor", Crossing::Falling, height, bounce)
        .trajectory(&mut resumed)
        .resume(half, |_| ())
        .expect("it goes on");
    assert!(resumed.ends().eq(whole.ends()) && resumed.len() == whole.len());
    let mut alone = Trajectory::new();
    build()
        .on("floor", Crossing::Falling, height, bounce)
        .trajectory(&mut alone)
        .resume(half, |_| ())
        .expect("it goes on");
    assert_eq!(alone.interval(), Some(half.time()..=1.0));
    for k in 0..50 {
        let time = half.time() + (1.0 - half.time()) * f64::from(k) / 50.0;
        assert_eq!(resumed.at(time), whole.at(time));
        assert_eq!(alone.at(time), whole.at(time));
    }
}

/// A step of a stepper, asked within, is what observers of a run of such steps are shown.
#[test]
fn a_step_that_is_asked_within_is_what_observers_are_shown() {
    fn compared<K, C>(scheme: K, method: FixedStep<f64, K>)
    where
        C: Coordinates<Flap>,
        K: Steps<Problem<Flap, StandardLagrange, f64, C>>,
        FixedStep<f64, K>: Runs<Problem<Flap, StandardLagrange, f64, C>>,
    {
        let flap = flap();
        let mut shown: Shown<Flap> = Vec::new();
        // Up to where a law of the flap begins, and the run begins anew.
        Simulation::new(&flap, StandardLagrange, method)
            .coordinates::<C>()
            .run(0.0..=0.25, every(0.003), |sample| {
                shown.push((sample.time(), *sample.state()));
            })
            .expect("it runs");
        let stepper = flap.stepper(StandardLagrange, scheme);
        let mut stepper = stepper.expect("acceptable").coordinates::<C>();
        let mut state = stepper.initial_state().expect("a start");
        let mut asked = 0;
        while stepper.time() < 0.24 {
            let from = stepper.time();
            let step = stepper.step_dense(&mut state, 0.01).expect("it moves");
            for (time, shown) in &shown {
                if (from..=stepper.time()).contains(time) {
                    let found = stepper.within(&step, *time).expect("within");
                    let (q, exact) = (found.velocities(), shown.velocities());
                    let off = q
                        .iter()
                        .zip(exact)
                        .map(|(a, b)| (a - b).abs())
                        .fold(0.0, f64::max);
                    assert!(off < 1e-12, "{time}: {off:e}");
                    asked += 1;
                }
            }
            let before = stepper.within(&step, from - 1e-3);
            assert!(matches!(
                before,
                Err(Fault::Reading(ReadingFault::OutsideTrajectory { .. }))
            ));
            let end = stepper.within(&step, stepper.time()).expect("within");
            assert_eq!(end.velocities(), stepper.bodies(&state).velocities());
        }
        assert!(asked > 75, "{asked}");
    }
    compared::<_, Relative>(Rk4, Rk4::every(0.01));
    compared::<_, Absolute>(Rk4, Rk4::every(0.01));
    compared::<_, Relative>(DormandPrince5, DormandPrince::every(0.01));
    compared::<_, Absolute>(DormandPrince8, DormandPrince853::every(0.01));
}

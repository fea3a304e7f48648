//! The rows of this project in the race of `benches/contact/run`: contacts with friction against
//! closed forms. A row: scene, engine, setting, steps, errors, depth, creep, times (s).

#![forbid(unsafe_code)]

use std::error::Error;
use std::ops::RangeInclusive;
use std::time::Duration;

use holonom::RunReport;
use holonom::nalgebra::Quaternion;
use holonom::prelude::*;
use holonom::run::{Plane, Reporting};
use holonom_study::StudyError;
use holonom_study::timing::{Candidate, Schedule, busy, race};

const GRAVITY: f64 = 9.81;

/// The slope on which the sliding block comes to rest (rad).
const SLOPE: f64 = 0.1;

/// Where the rocking block leans at first (rad).
const LEANS: f64 = 0.2;

/// Steps shorter than this would take minutes at rest (s).
const RESTS_BY: f64 = 1e-1;

/// A ball of 7 kg and 0.1 m that slips at first.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Ball {
    #[body(
        free, mass = 7.0, inertia = [0.028, 0.028, 0.028],
        position = [0.0, 0.0, 0.1], velocity = [8.0, 0.0, 0.0]
    )]
    ball: Body,
}

/// A block of 20 kg on a slope that falls along x, with axes along the slope.
#[derive(Mechanism)]
#[mechanism(
    gravity = [9.81 * sin(0.1), 0.0, -9.81 * cos(0.1)], coordinates = "joints"
)]
struct Block {
    #[body(
        free, mass = 20.0, inertia = [1.0 / 3.0, 2.0 / 3.0, 2.6 / 3.0],
        position = [0.0, 0.0, 0.1], velocity = [1.0, 0.0, 0.0]
    )]
    block: Body,
    #[point(on = block, at = [-0.3, -0.2, 0.0])]
    back_right: Point,
    #[point(on = block, at = [-0.3, 0.2, 0.0])]
    back_left: Point,
    #[point(on = block, at = [0.3, -0.2, 0.0])]
    front_right: Point,
    #[point(on = block, at = [0.3, 0.2, 0.0])]
    front_left: Point,
}

/// The same in a plane.
#[derive(Mechanism)]
#[mechanism(
    gravity = [9.81 * sin(0.1), 0.0, -9.81 * cos(0.1)], coordinates = "joints"
)]
struct Sled {
    #[body(
        mass = 20.0, inertia = [1.0 / 3.0, 2.0 / 3.0, 2.6 / 3.0],
        position = [0.0, 0.0, 0.1], velocity = [1.0, 0.0, 0.0]
    )]
    block: Body,
    #[joint(between = [ground, block], point = [0.0, 0.0, 0.1], normal = [0.0, 1.0, 0.0])]
    upright: Planar,
    #[point(on = block, at = [-0.3, 0.0, 0.0])]
    back: Point,
    #[point(on = block, at = [0.3, 0.0, 0.0])]
    front: Point,
}

/// A block of 1 m by 2 m in a plane.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Rocker {
    #[body(mass = 3.0, inertia = [1.25, 1.25, 0.5], position = [0.0, 0.0, 1.0])]
    block: Body,
    #[joint(between = [ground, block], point = [0.0, 0.0, 1.0], normal = [0.0, 1.0, 0.0])]
    upright: Planar,
    #[point(on = block, at = [-0.5, 0.0, 0.0])]
    left: Point,
    #[point(on = block, at = [0.5, 0.0, 0.0])]
    right: Point,
}

type Fails = Box<dyn Error>;

/// A method with its setting.
#[derive(Clone, Copy)]
enum Setting {
    /// A fixed step (s).
    Rk4(f64),
    /// A relative tolerance; the absolute one is a tenth of it.
    DormandPrince(f64),
}

const SETTINGS: [Setting; 7] = [
    Setting::Rk4(1e-1),
    Setting::Rk4(1e-2),
    Setting::Rk4(1e-3),
    Setting::DormandPrince(1e-3),
    Setting::DormandPrince(1e-6),
    Setting::DormandPrince(1e-9),
    Setting::DormandPrince(1e-12),
];

impl Setting {
    /// As a row names it.
    fn name(self) -> String {
        match self {
            Self::Rk4(step) => format!("holonom Rk4|step {step:.0e}"),
            Self::DormandPrince(relative) => {
                format!("holonom DormandPrince|tolerance {relative:.0e}")
            }
        }
    }

    /// Whether it follows 100 s at rest soon.
    fn may_rest(self) -> bool {
        !matches!(self, Self::Rk4(step) if step < RESTS_BY)
    }
}

/// Runs a mechanism by a setting.
macro_rules! run {
    (
        $setting:expr, $mechanism:expr, $start:expr, $contacts:expr, $span:expr, $reports:expr,
        $observe:expr
    ) => {
        match $setting {
            Setting::Rk4(step) => $mechanism
                .simulation(StandardLagrange, Rk4::every(step))
                .initial_state($start)
                .interactions($contacts)
                .run($span, $reports, $observe)?,
            Setting::DormandPrince(relative) => $mechanism
                .simulation(
                    StandardLagrange,
                    DormandPrince::new(Tolerance {
                        relative,
                        absolute: 0.1 * relative,
                    }),
                )
                .initial_state($start)
                .interactions($contacts)
                .run($span, $reports, $observe)?,
        }
    };
}

/// What a row says of a run.
struct Outcome {
    steps: usize,
    /// Of the position (m) at the end, or of the instants of impacts (s).
    error: f64,
    /// Of the velocity at the end (m/s).
    rate: f64,
    /// The greatest distance from the plane (m), positive above it.
    away: f64,
    /// How far it goes within 100 s at rest (m).
    creep: f64,
}

/// Keeps the distance that is greater.
fn widen(away: &mut f64, distance: f64) {
    if distance.abs() > away.abs() {
        *away = distance;
    }
}

/// Rolls until 2 s.
fn rolls(
    setting: Setting,
    reports: Reporting<f64>,
    away: &mut f64,
) -> Result<RunReport<f64, Ball>, Fails> {
    let (ball, h) = (Ball::default(), Ball::HANDLES);
    let floor = Plane::on_ground([0.0; 3], [0.0, 0.0, 1.0]);
    let contacts = Interaction::contact(h.ball, floor)
        .radius(0.1)
        .with_friction(0.2);
    let start = ball.described_state()?;
    let observe = |sample: &Sample<'_, f64, Ball>| widen(away, sample.position(h.ball).z - 0.1);
    Ok(run!(
        setting,
        ball,
        start,
        contacts,
        0.0..=2.0,
        reports,
        observe
    ))
}

fn rolls_as(setting: Setting) -> Result<Outcome, Fails> {
    let mut away = 0.0;
    let report = rolls(setting, every_step(), &mut away)?;
    let ball = Ball::default();
    let view = ball.view(2.0, &report.state)?;
    let (first, last) = (8.0, 8.0 * 5.0 / 7.0);
    let until = 2.0 * first / (7.0 * 0.2 * GRAVITY);
    let place = 0.5 * (first + last) * until + last * (2.0 - until);
    Ok(Outcome {
        steps: report.accepted,
        error: (view.position(Ball::HANDLES.ball).x - place).abs(),
        rate: (view.velocity(Ball::HANDLES.ball).x - last).abs(),
        away,
        creep: f64::NAN,
    })
}

/// Functions of a block that slides and rests: the run, its outcome, and a run for the clock.
macro_rules! slides {
    ($block:ident, $run:ident, $outcome:ident, [$($corner:ident),*], $contacts:expr) => {
        fn $run(
            setting: Setting,
            start: StateOf<$block>,
            span: RangeInclusive<f64>,
            reports: Reporting<f64>,
            away: &mut f64,
        ) -> Result<RunReport<f64, $block>, Fails> {
            let (block, h) = ($block::default(), $block::HANDLES);
            let floor =
                Plane::on_ground([0.0; 3], [0.0, 0.0, 1.0]).along([1.0, 0.0, 0.0]);
            let contacts = $contacts([$(h.$corner),*].map(|at| Interaction::contact(at, floor)));
            let observe = |sample: &Sample<'_, f64, $block>| {
                widen(away, sample.position(h.block).z - 0.1);
            };
            Ok(run!(setting, block, start, contacts, span, reports, observe))
        }

        fn $outcome(setting: Setting) -> Result<Outcome, Fails> {
            let (block, h) = ($block::default(), $block::HANDLES);
            let start = block.described_state()?;
            let mut away = 0.0;
            let report = $run(setting, start, 0.0..=1.0, every_step(), &mut away)?;
            let view = block.view(1.0, &report.state)?;
            let (place, rate) = (view.position(h.block).x, view.velocity(h.block).x.abs());
            let slows = GRAVITY * (0.3 * SLOPE.cos() - SLOPE.sin());
            let mut creep = f64::NAN;
            if setting.may_rest() {
                let span = 1.0..=101.0;
                let rest = $run(setting, report.state, span, every(100.0), &mut 0.0)?;
                creep = (block.view(101.0, &rest.state)?.position(h.block).x - place).abs();
            }
            Ok(Outcome {
                steps: report.accepted,
                error: (place - 0.5 / slows).abs(),
                rate,
                away,
                creep,
            })
        }
    };
}

slides!(
    Block,
    slides,
    slides_as,
    [back_right, back_left, front_right, front_left],
    |corners: [_; 4]| {
        let [[a, b, c], [d, e, f], [g, h, i], [j, k, l]] =
            corners.map(|corner: Interaction<f64, Block>| corner.with_friction(0.3));
        [a, b, c, d, e, f, g, h, i, j, k, l]
    }
);
slides!(Sled, sleds, sleds_as, [back, front], |corners: [_; 2]| {
    let [[a, b], [c, d]] =
        corners.map(|corner: Interaction<f64, Sled>| corner.with_plane_friction(0.3));
    [a, b, c, d]
});

/// Rocks until 4 s, with the instants of impacts.
fn rocks(setting: Setting) -> Result<(usize, Vec<f64>), Fails> {
    let (rocker, h) = (Rocker::default(), Rocker::HANDLES);
    let mut start = rocker.described_state()?;
    let mut pose = rocker.view(0.0, &start)?.pose(h.block);
    // It leans over its right corner, which stays where it is.
    let (sine, cosine) = LEANS.sin_cos();
    pose.position = [0.5 - 0.5 * cosine + sine, 0.0, 0.5 * sine + cosine].into();
    let (sine, cosine) = (0.5 * LEANS).sin_cos();
    pose.orientation = Quaternion::new(cosine, 0.0, sine, 0.0);
    Rocker::set_pose(&mut start, h.block, pose);
    let floor = Plane::on_ground([0.0; 3], [0.0, 0.0, 1.0]);
    let [[a, b], [c, d]] = [h.left, h.right]
        .map(|corner| Interaction::contact(corner, floor).with_plane_friction(0.8));
    let contacts = [a, b, c, d];
    let [left, _, right, _] = Interaction::handles(&contacts);
    let mut found = Vec::new();
    let observe = |sample: &Sample<'_, f64, Rocker>| -> Result<(), Fault> {
        for corner in [left, right] {
            if let Some(impact) = sample.impact(corner)?
                && impact.time == sample.time()
                && found.last() != Some(&impact.time)
            {
                found.push(impact.time);
            }
        }
        Ok(())
    };
    let report = run!(
        setting,
        rocker,
        start,
        contacts,
        0.0..=4.0,
        every(4.0),
        observe
    );
    Ok((report.accepted, found))
}

fn rocks_as(setting: Setting, instants: &[f64]) -> Result<Outcome, Fails> {
    let (steps, found) = rocks(setting)?;
    let errors = found.iter().zip(instants).map(|(a, b)| (a - b).abs());
    Ok(Outcome {
        steps,
        error: if found.len() < instants.len() {
            f64::NAN
        } else {
            errors.fold(0.0, f64::max)
        },
        rate: f64::NAN,
        away: f64::NAN,
        creep: f64::NAN,
    })
}

/// The first impacts of the rocking block (s): Housner, The behavior of inverted pendulum
/// structures during earthquakes, 1963.
fn housner() -> [f64; 5] {
    let (radius, slender) = (1.25_f64.sqrt(), 0.5_f64.atan());
    let squared = 1.5 * GRAVITY / radius;
    // By Simpson's rule in the root of the way.
    let falls = |inclination: f64| {
        let rate = |s: f64| {
            let drop = (slender - inclination).cos() - (slender - inclination + s * s).cos();
            if s == 0.0 {
                2.0 / (squared * (slender - inclination).sin()).sqrt()
            } else {
                2.0 * s / (squared * drop).sqrt()
            }
        };
        let (count, end) = (4000, inclination.sqrt());
        let step = end / f64::from(count);
        let inner: f64 = (1..count)
            .map(|k| if k % 2 == 1 { 4.0 } else { 2.0 } * rate(f64::from(k) * step))
            .sum();
        step / 3.0 * (rate(0.0) + inner + rate(end))
    };
    let (mut inclination, mut time) = (LEANS, falls(LEANS));
    let ratio = 1.0 - 1.5 * slender.sin().powi(2);
    [(); 5].map(|()| {
        let now = time;
        let height = ratio * ratio * ((slender - inclination).cos() - slender.cos());
        inclination = slender - (slender.cos() + height).acos();
        time += 2.0 * falls(inclination);
        now
    })
}

/// A run of a scene for the clock, until an end (s).
fn bare(scene: &str, setting: Setting, end: f64) -> Result<(), Fails> {
    let (span, report, none) = (0.0..=end, every(end), &mut 0.0);
    match scene {
        "rolls" => drop(rolls(setting, report, none)?),
        "slides" => {
            let start = Block::default().described_state()?;
            slides(setting, start, span, report, none)?;
        }
        "slides in a plane" => {
            let start = Sled::default().described_state()?;
            sleds(setting, start, span, report, none)?;
        }
        _ => drop(rocks(setting)?),
    }
    Ok(())
}

/// The seconds of the processor that each setting takes for a scene.
fn timed(scene: &str, settings: &[Setting], end: f64) -> Result<Vec<f64>, Fails> {
    let candidates = settings.iter().map(|&setting| {
        Candidate::new(setting.name(), move || match bare(scene, setting, end) {
            Ok(()) => Ok(1),
            Err(reason) => Err(StudyError::Run {
                name: setting.name(),
                reason: reason.to_string(),
            }),
        })
    });
    let schedule = Schedule {
        rounds: 3,
        turn: Duration::from_millis(1),
    };
    let timings = race(&mut candidates.collect::<Vec<_>>(), schedule, |_| ())?;
    if let Some(sentence) = busy(&timings) {
        eprintln!("{sentence}");
    }
    let medians = timings.iter().map(|timing| timing.time.median * 1e-9);
    Ok(medians.collect())
}

fn main() -> Result<(), Fails> {
    let instants = housner();
    for (scene, end) in [
        ("rolls", 2.0),
        ("slides", 1.0),
        ("slides in a plane", 1.0),
        ("rocks", 4.0),
    ] {
        let mut outcomes = Vec::new();
        for setting in SETTINGS {
            let outcome = match scene {
                "rolls" => rolls_as(setting),
                "slides" => slides_as(setting),
                "slides in a plane" => sleds_as(setting),
                _ => rocks_as(setting, &instants),
            };
            match outcome {
                Ok(outcome) => outcomes.push((setting, outcome)),
                // A row without numbers, and why.
                Err(reason) => {
                    println!("{scene}|{}|0|NaN|NaN|NaN|NaN|NaN|NaN", setting.name());
                    eprintln!("{scene}, {}: {reason}", setting.name());
                }
            }
        }
        let ended: Vec<_> = outcomes.iter().map(|(setting, _)| *setting).collect();
        let times = timed(scene, &ended, end)?;
        let rested: Vec<_> = ended.into_iter().filter(|s| s.may_rest()).collect();
        let mut rests = if scene.starts_with("slides") {
            timed(scene, &rested, end + 100.0)?.into_iter()
        } else {
            Vec::new().into_iter()
        };
        for ((setting, of), spent) in outcomes.iter().zip(times) {
            // Of the way to its rest and of 100 s there.
            let rest = if setting.may_rest() {
                rests.next().map_or(f64::NAN, |whole| whole / (end + 100.0))
            } else {
                f64::NAN
            };
            println!(
                "{scene}|{}|{}|{:e}|{:e}|{:e}|{:e}|{:e}|{rest:e}",
                setting.name(),
                of.steps,
                of.error,
                of.rate,
                of.away,
                of.creep,
                spent / end,
            );
        }
    }
    Ok(())
}

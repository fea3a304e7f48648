//! The trade on a mechanism of somebody else: an arm of two links, of which nothing is known
//! beforehand.

mod unusual;

use std::fs;
use std::path::PathBuf;
use std::time::Duration;

use holonom::joints::Revolute;
use holonom::prelude::*;
use holonom::{Real, View, integrate::TimeSpan};
use holonom_study::chapter15::Method;
use holonom_study::compare::{Coordinates, Precision};
use holonom_study::timing::Schedule;
use holonom_study::trade::{
    Choice, Entry, Family, Formulated, Grid, IntegratorSetting, Journal, Posed, PostStabilisation,
    Problem, Processor, Quantity, Reference, Setting, Source, Subject, Timing, Wish, measure,
    recommend, report,
};

#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Arm {
    #[body(mass = 2.0, inertia = [0.07, 0.01, 0.07], position = [0.0, 0.3, 0.0])]
    upper: Body,
    #[body(mass = 1.0, inertia = [0.03, 0.005, 0.03], position = [0.0, 0.6, -0.2], orientation = rotation([1.0, 0.0, 0.0], deg(-90.0)))]
    fore: Body,
    #[joint(between = [ground, upper], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    shoulder: Revolute,
    #[joint(between = [upper, fore], point = [0.0, 0.6, 0.0], axis = [1.0, 0.0, 0.0])]
    elbow: Revolute,
}

/// The arm falls for a second.
struct Falling(Arm);

impl Problem for Falling {
    type Mechanism = Arm;
    const IS_INLINED: bool = true;

    fn name(&self) -> &str {
        "arm"
    }

    fn mechanism(&self) -> &Arm {
        &self.0
    }

    fn span(&self) -> TimeSpan<f64> {
        TimeSpan {
            start: 0.0,
            end: 1.0,
            first_output: 0.25,
        }
    }

    fn time_scale(&self) -> f64 {
        1.0
    }

    fn quantity(&self) -> Quantity {
        Quantity {
            name: "angles",
            unit: "rad",
        }
    }

    fn read<S: Real>(&self, view: &View<'_, S, Arm>) -> Vec<f64> {
        let h = Arm::HANDLES;
        [view.angle(h.shoulder), view.angle(h.elbow)]
            .map(Real::to_f64)
            .into()
    }
}

fn falling() -> Posed<Falling> {
    Posed::in_both(Falling(Arm::default()))
}

/// Short, because nothing depends on how long it takes.
fn timing() -> Timing<'static> {
    Timing {
        schedule: Schedule {
            rounds: 1,
            turn: Duration::ZERO,
        },
        reference_kernel: None,
    }
}

fn setting(by: Coordinates, family: Family, step_or_tolerance: f64) -> Setting {
    Setting {
        coordinates: by,
        formulation: Formulated::Standard,
        is_derived: false,
        stabilisation: PostStabilisation::None,
        integration: IntegratorSetting {
            family,
            step_or_tolerance,
        },
        scalar: Precision::Double,
    }
}

#[test]
fn errors_go_with_the_order_of_the_integrator() {
    let subject = falling();
    let start = subject.start().unwrap();
    let reference = Reference::of(&subject, None).unwrap();
    assert_eq!(reference.source, Source::IntegratorSetting);
    assert!(reference.error < 1e-10, "{:e}", reference.error);
    for by in [Coordinates::Bodies, Coordinates::Joints] {
        for family in Family::ALL
            .into_iter()
            .filter(|family| !family.is_adaptive() && family.moves(by, Method::Standard))
        {
            let error = |step| {
                let run = subject.observe(&setting(by, family, step), &start).unwrap();
                reference.error_of(&subject, &run)
            };
            // Where round-off is far below.
            let step = if family.order() > 5 { 0.025 } else { 0.004 };
            let order = (error(step) / error(0.5 * step)).log2();
            let off = order - f64::from(family.order());
            // The leading coefficients of order 8 and of Adams are small: higher orders show.
            let is_small = family.order() > 5 || family == Family::AdamsBashforthMoulton4;
            assert!(
                off > -0.35 && (off < 0.35 || (is_small && off < 2.0)),
                "{} by {}: {order}",
                family.key(),
                by.key()
            );
        }
    }
}

#[test]
fn a_smaller_tolerance_is_a_smaller_error() {
    let subject = falling();
    let start = subject.start().unwrap();
    let reference = Reference::of(&subject, None).unwrap();
    let mut before = f64::INFINITY;
    for tolerance in [1e-4, 1e-6, 1e-8] {
        let setting = setting(Coordinates::Joints, Family::DormandPrince, tolerance);
        let run = subject.observe(&setting, &start).unwrap();
        let error = reference.error_of(&subject, &run);
        assert!(error < before && error < 100.0 * tolerance, "{error:e}");
        before = error;
    }
}

#[test]
fn a_run_that_is_timed_is_the_run_that_is_read() {
    let subject = falling();
    let start = subject.start().unwrap();
    for by in [Coordinates::Bodies, Coordinates::Joints] {
        let moving = |family: &Family| family.moves(by, Method::Standard);
        for family in Family::ALL.into_iter().filter(moving) {
            let value = if family.is_adaptive() { 1e-5 } else { 0.02 };
            for stabilisation in PostStabilisation::ALL {
                let setting = Setting {
                    stabilisation,
                    ..setting(by, family, value)
                };
                let run = subject.observe(&setting, &start).unwrap();
                let candidate = subject.candidate(&setting, &start).unwrap();
                let timing =
                    holonom_study::timing::race(&mut [candidate], timing().schedule, |_| ());
                assert_eq!(
                    timing.unwrap()[0].evaluations,
                    run.evaluations,
                    "{}",
                    setting.name()
                );
            }
        }
    }
}

/// A few runs.
fn grid() -> Grid {
    Grid {
        formulations: vec![
            Choice::Given(Formulated::Standard),
            Choice::Derived(Method::Baumgarte),
        ],
        families: vec![Family::Rk4, Family::DormandPrince],
        most_steps: 100.0,
        least_tolerance: 1e-6,
        ..Grid::default()
    }
}

fn scratch(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("holonom-trade-{}-{name}", std::process::id()))
}

#[test]
fn an_interrupted_trade_goes_on_and_is_written() {
    let directory = scratch("interrupted");
    let path = directory.join("arm.journal");
    let subject = falling();
    let whole = measure(&subject, &grid(), timing(), &path, |_, _| ()).unwrap();
    // By bodies in two formulations and two stabilisations, by joints in one, in two number types.
    let settings = grid().settings(&subject);
    assert_eq!(whole.rows.len() + whole.stopped.len(), settings.len());
    assert!(
        settings
            .iter()
            .map(|planned| planned.setting)
            .filter(|setting| setting.coordinates == Coordinates::Joints)
            .all(|setting| setting.formulation == Formulated::Standard
                && setting.stabilisation == PostStabilisation::None)
    );
    // What is in the journal is not run again: times, which no run repeats, are the same.
    let lines = fs::read_to_string(&path).unwrap();
    let half = lines.len() / 2;
    fs::write(&path, &lines[..half]).unwrap();
    let again = measure(&subject, &grid(), timing(), &path, |_, _| ()).unwrap();
    let kept = lines[..half].matches("\"seconds\"").count() - 1;
    assert!(kept > 10);
    assert_eq!(again.rows[..kept], whole.rows[..kept]);
    let what = |trade: &holonom_study::trade::Trade| -> Vec<_> {
        let rows = trade.rows.iter();
        rows.map(|row| (row.setting.clone(), row.error, row.evaluations))
            .collect()
    };
    assert_eq!(what(&again), what(&whole));

    let histories = report::histories(&subject).unwrap();
    let document = report::document(&again, &histories, "a command");
    let written = report::write(&again, &document, &directory).unwrap();
    assert!(written.iter().all(|path| path.exists()));
    let json = fs::read_to_string(directory.join("arm.json")).unwrap();
    let rows: Vec<serde_json::Map<String, serde_json::Value>> =
        serde_json::from_str(&json).unwrap();
    for key in [
        "coordinates",
        "formulation",
        "stabilisation",
        "integrator",
        "scalar",
        "step_or_tolerance",
        "error",
        "seconds",
        "evaluations",
        "max_violation",
        "energy_drift_joule",
        "warnings",
    ] {
        assert!(rows.iter().all(|row| row.contains_key(key)), "{key}");
    }
    assert_eq!(rows.len(), again.rows.len());
    let csv = fs::read_to_string(directory.join("arm.csv")).unwrap();
    assert_eq!(csv.lines().count(), rows.len() + 1);
    fs::remove_dir_all(&directory).unwrap();
}

#[test]
fn other_conditions_begin_anew() {
    let directory = scratch("conditions");
    let path = directory.join("journal");
    let mut journal = Journal::<Entry>::open(&path, "others").unwrap();
    let subject = falling();
    let stopped =
        holonom_study::trade::Stopped::new(&grid().settings(&subject)[0].setting, "made up".into());
    journal.add(Entry::Stopped(stopped)).unwrap();
    drop(journal);
    let trade = measure(&subject, &grid(), timing(), &path, |_, _| ()).unwrap();
    assert!(trade.stopped.iter().all(|entry| entry.reason != "made up"));
    fs::remove_dir_all(&directory).unwrap();
}

#[test]
fn a_recommendation_is_right_from_starts_that_it_was_not_tried_with() {
    let directory = scratch("recommend");
    let subject = falling();
    let grid = Grid {
        scalars: vec![Precision::Double],
        most_steps: 400.0,
        ..grid()
    };
    let trade = measure(
        &subject,
        &grid,
        timing(),
        &directory.join("journal"),
        |_, _| (),
    )
    .unwrap();
    let asked = 1e-5;
    let on = (Processor::Here, timing());
    let found = recommend(&subject, &trade, Wish::Error(asked), on, || ());
    let found = found.unwrap().expect("within reach");
    assert!(found.worst() < asked);
    for number in 100..110 {
        let start = subject.start_near(0.01, number).unwrap();
        let reference = Reference::of(&subject, Some(&start)).unwrap();
        let run = subject.observe(&found.setting, &start).unwrap();
        let error = reference.error_of(&subject, &run);
        assert!(error <= asked, "{error:e} from start {number}");
    }
    let text = report::recommendation(&trade, Wish::Error(asked), Processor::Here, Some(&found));
    assert!(text.contains(&found.setting.code("mechanism")), "{text}");
    // Below what the grid reaches.
    let found = recommend(&subject, &trade, Wish::Error(1e-13), on, || ()).unwrap();
    assert_eq!(found, None);
    fs::remove_dir_all(&directory).unwrap();
}

#[test]
fn starts_nearby_stand_and_differ() {
    let subject = falling();
    let own = subject.start().unwrap();
    let near = subject.start_near(0.01, 1).unwrap();
    assert_eq!(near, subject.start_near(0.01, 1).unwrap());
    assert_ne!(near, subject.start_near(0.01, 2).unwrap());
    let largest = own
        .0
        .iter()
        .zip(&near.0)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max);
    assert!(largest > 1e-4 && largest < 0.1, "{largest}");
}

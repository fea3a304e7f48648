//! Chapter 15 with the generated pendulum: the counts, the violations and the errors that the study
//! has to show.

use std::path::Path;
use std::time::Duration;

use holonom::joints::Revolute;
use holonom::run::Simulate as _;
use holonom::{
    AugmentedLagrangian, Baumgarte, DormandPrince, Fault, Formulation, Mechanism, Penalty,
    StandardLagrange, Tolerance, every, integrate::TimeSpan,
};
use holonom_models::RodPendulum;
use holonom_study::chapter15::outcome::{Instant, Outcome};
use holonom_study::chapter15::run::{Kind, Rival, Subject, compare};
use holonom_study::chapter15::{Method, Settings};
use holonom_study::chart::{Axis, Chart, Mark, Series};
use holonom_study::timing::{Candidate, Schedule};

const QUICK: Schedule = Schedule {
    rounds: 1,
    turn: Duration::ZERO,
};

fn subject(mechanism: &RodPendulum) -> Subject<'_, RodPendulum, Revolute> {
    let handles = RodPendulum::HANDLES;
    Subject {
        mechanism,
        rod: handles.rod,
        pivot: handles.pivot,
    }
}

fn outcomes() -> Vec<Outcome> {
    let pendulum = RodPendulum::default();
    compare(
        &subject(&pendulum),
        &Settings::TABLE_15_2,
        vec![],
        QUICK,
        |_| (),
    )
    .unwrap()
}

#[test]
fn evaluations_are_those_of_the_chapter() {
    for outcome in outcomes() {
        let (here, published) = (outcome.evaluations, outcome.method.published().evaluations);
        assert_eq!(
            here,
            6 * (outcome.accepted + outcome.rejected) + 1,
            "{:?}",
            outcome.method
        );
        match outcome.method {
            Method::Penalty | Method::AugmentedLagrangian => assert_eq!(here, published),
            // An independent calculation with the same step control gives these.
            Method::Standard => assert_eq!(here, 1765),
            Method::Baumgarte => assert_eq!(here, 2581),
        }
        assert!((here as f64 / published as f64 - 1.0).abs() < 0.1);
        assert_eq!(outcome.instants.len(), 501);
    }
}

#[test]
fn violation_grows_for_the_standard_formulation_alone() {
    for outcome in outcomes() {
        let first = outcome.largest_violation(0.0..1.0);
        let growth = outcome.largest_violation(9.0..f64::INFINITY) / first;
        match outcome.method {
            Method::Standard => assert!(growth >= 100.0, "{growth}"),
            _ => assert!(growth <= 10.0, "{:?}: {growth}", outcome.method),
        }
    }
}

#[test]
fn errors_are_those_of_an_independent_calculation() {
    let expected = [-4.6e-6, 2.6e-6, -4.1e-5, -7.0e-6];
    for (outcome, expected) in outcomes().iter().zip(expected) {
        let error = outcome.final_angle_error();
        assert!(
            (error / expected - 1.0).abs() < 0.02,
            "{:?}: {error:e}",
            outcome.method
        );
        let (radial, transverse) = outcome.largest_reaction_errors();
        assert!(
            radial < 1e-2 && transverse < 1e-3,
            "{radial:e}, {transverse:e}"
        );
        assert!(outcome.energy_drift() < 1e-3);
    }
}

/// The last report at tight tolerances.
fn tight(method: Method, formulation: impl Formulation<f64>) -> Instant {
    let pendulum = RodPendulum::default();
    let integrator = DormandPrince::new(Tolerance {
        relative: 1e-12,
        absolute: 1e-14,
    });
    let span = TimeSpan {
        start: 0.0,
        end: 10.0,
        first_output: 0.02,
    };
    let run = subject(&pendulum).record(method, formulation, integrator, span);
    *run.unwrap().reports.last().unwrap()
}

#[test]
fn tight_tolerances_lead_to_the_closed_form_but_for_the_bias_of_the_penalty() {
    let exact = [
        tight(Method::Standard, StandardLagrange),
        tight(Method::Baumgarte, Baumgarte::default()),
        tight(Method::AugmentedLagrangian, AugmentedLagrangian::default()),
    ];
    for instant in exact {
        assert!(
            (instant.angle - 0.776_118_948_971_798).abs() < 1e-8,
            "{:e}",
            instant.angle_error()
        );
        let (radial, transverse) = instant.reaction_errors();
        assert!(
            radial.abs() < 1e-6 && transverse.abs() < 1e-6,
            "{radial:e}, {transverse:e}"
        );
    }
    let bias = tight(Method::Penalty, Penalty::default()).angle_error();
    assert!((bias / -3.4e-5 - 1.0).abs() < 0.05, "{bias:e}");
}

#[test]
fn rivals_are_timed_beside_their_formulation() {
    let pendulum = RodPendulum::default();
    let rival = |method, kind| Rival {
        method,
        kind,
        candidate: Candidate::new("rival", || Ok(7)),
    };
    let rivals = vec![
        rival(Method::Baumgarte, Kind::Assembler),
        rival(Method::Standard, Kind::StaticMatrices),
    ];
    let mut progress = Vec::new();
    let outcomes = compare(
        &subject(&pendulum),
        &Settings::TABLE_15_2,
        rivals,
        QUICK,
        |p| progress.push(p),
    )
    .unwrap();
    let counts = |outcome: &Outcome| {
        (
            outcome.prices.assembler.len(),
            outcome.prices.static_matrices.len(),
        )
    };
    let counts: Vec<_> = outcomes.iter().map(counts).collect();
    assert_eq!(counts, [(0, 1), (1, 0), (0, 0), (0, 0)]);
    assert_eq!(outcomes[1].prices.assembler[0].evaluations, 7);
    assert_eq!(
        outcomes[0].prices.generated.evaluations,
        outcomes[0].evaluations
    );
    assert!(progress.is_sorted() && progress.last() == Some(&1.0));
}

#[test]
fn a_run_that_stops_says_which_and_why() {
    let pendulum = RodPendulum::default();
    let settings = Settings {
        relative: -1.0,
        ..Settings::TABLE_15_2
    };
    let error = compare(&subject(&pendulum), &settings, vec![], QUICK, |_| ()).unwrap_err();
    let text = error.to_string();
    assert!(
        text.contains("standard") && text.contains("tolerance"),
        "{text}"
    );
}

/// The pictures of the guide's first program. `HOLONOM_DRAW=1 cargo test -p holonom-study --test
/// chapter15` writes them anew.
#[test]
fn the_guide_shows_what_its_first_program_prints() {
    let (pendulum, handles) = (RodPendulum::default(), RodPendulum::HANDLES);
    let (mut angles, mut forces) = (Vec::new(), Vec::new());
    let report = pendulum
        .simulation(StandardLagrange, DormandPrince::default())
        .run(0.0..=2.0, every(0.02), |sample| -> Result<(), Fault> {
            let force = sample.reaction(handles.pivot, handles.rod)?.force.norm();
            angles.push((sample.time(), sample.angle(handles.pivot)));
            forces.push((sample.time(), force));
            Ok(())
        })
        .unwrap();
    assert!(report.warnings().is_empty());
    let chart = |quantity: &str, unit: &str, name: &str, points| Chart {
        title: format!("{name} of the pendulum"),
        x: Axis::linear("time", "s"),
        y: Axis::linear(quantity, unit),
        series: vec![Series {
            name: name.into(),
            slot: 0,
            mark: Mark::Line,
            points,
        }],
    };
    for (file, chart) in [
        ("first_angle", chart("angle", "rad", "Angle", angles)),
        ("first_reaction", chart("reaction", "N", "Reaction", forces)),
    ] {
        let drawn = chart.draw().unwrap().svg;
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../../runtime/src/guide")
            .join(file)
            .with_extension("svg");
        if std::env::var_os("HOLONOM_DRAW").is_some() {
            std::fs::write(&path, &drawn).unwrap();
        }
        let kept = std::fs::read_to_string(&path).unwrap_or_default();
        assert!(kept == drawn, "{} is not what is drawn now", path.display());
        // An empty line would end it within a page of documentation.
        assert!(!drawn.contains("\n\n"));
    }
}

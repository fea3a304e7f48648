//! `study compare` in a small setting: what it writes, not how fast anything is.

use std::time::Duration;

use holonom::{JointCoordinates, Mechanism};
use holonom_assembler::formulation::{Evaluator, Formulation};
use holonom_benches::compare::{Entry, entries, measure};
use holonom_models::{FourBar, RodPendulum};
use holonom_study::compare::measure::Refused;
use holonom_study::compare::record::{Row, from_json, json};
use holonom_study::compare::report::{self, Beside};
use holonom_study::target::Target;
use holonom_study::timing::Schedule;

const QUICK: Schedule = Schedule {
    rounds: 2,
    turn: Duration::ZERO,
};

fn small() -> (Vec<Row>, Vec<Refused>) {
    let mut chosen = entries();
    chosen.retain(|entry| ["pendulum", "four-bar"].contains(&entry.scene) && entry.n == 1);
    assert_eq!(chosen.len(), 2);
    let (mut prepared, mut rounds) = (0, 0);
    let measured = measure(&chosen, QUICK, |done| prepared = done, |done| rounds = done);
    assert_eq!((prepared, rounds), (2, 2));
    measured.unwrap()
}

fn row<'a>(rows: &'a [Row], which: [&str; 4]) -> &'a Row {
    let [scene, coordinates, formulation, scalar] = which;
    let is = |row: &&Row| {
        [&row.scene, &row.coordinates, &row.formulation, &row.scalar] == which.map(|text| text)
    };
    let mut found = rows.iter().filter(is);
    let row = found.next();
    let row = row.unwrap_or_else(|| panic!("no {scene} {coordinates} {formulation} {scalar}"));
    assert!(found.next().is_none());
    row
}

/// The same rows, but for the last digit of a time, which may get lost on the way through text.
fn assert_same(read: &[Row], written: &[Row]) {
    assert_eq!(read.len(), written.len());
    for (read, written) in read.iter().zip(written) {
        let (a, b) = (read.nanoseconds_throughput, written.nanoseconds_throughput);
        assert!((a / b - 1.0).abs() < 1e-12);
        let text = |row: &Row| (row.name(), row.operations, row.path, row.build.clone());
        assert_eq!(text(read), text(written));
    }
}

#[test]
fn every_right_hand_side_has_its_numbers() {
    let (rows, refused) = small();
    assert!(refused.is_empty(), "{refused:?}");
    assert_eq!(rows.len(), 1 + 2 * 2 * 4 * 2);

    let values: serde_json::Value = serde_json::from_str(&json(&rows).unwrap()).unwrap();
    for value in values.as_array().unwrap() {
        let object = value.as_object().unwrap();
        for text in ["scene", "coordinates", "formulation", "scalar", "build"] {
            assert!(object[text].is_string(), "{text}");
        }
        for count in ["n", "operations", "stage_operations", "path"] {
            assert!(object[count].as_u64().unwrap() > 0, "{count}");
        }
        for time in [
            "nanoseconds_throughput",
            "upper_quartile_nanoseconds",
            "spread",
            "processor_share",
            "nanoseconds_dependent",
            "rk4_step_nanoseconds",
            "reference_kernels",
        ] {
            assert!(object[time].as_f64().unwrap() > 0.0, "{time}");
        }
        let number = |key: &str| object[key].as_f64().unwrap();
        assert!(number("upper_quartile_nanoseconds") >= number("nanoseconds_throughput"));
        assert!(number("spread") >= 1.0 && number("processor_share") <= 1.0);
        let by_assembler = object["scalar"] == "f64" && object["scene"] != "reference kernel";
        assert_eq!(
            object["assembler_nanoseconds"].is_f64(),
            by_assembler,
            "{object:?}"
        );
        let is_one_kernel = object["formulation"] != "augmented-lagrangian";
        assert_eq!(object["kernel_nanoseconds"].is_f64(), is_one_kernel);
    }
    assert_same(&from_json(&json(&rows).unwrap()).unwrap(), &rows);

    let unit = row(&rows, ["reference kernel", "bodies", "standard", "f64"]);
    assert_eq!((unit.operations, unit.reference_kernels), (279, 1.0));
}

#[test]
fn counts_are_those_of_the_reports() {
    let (rows, _) = small();
    let operations = |name: &str| RodPendulum::REPORT.operations(name).unwrap();
    for scalar in ["f64", "f32"] {
        for (formulation, kernel) in [
            ("standard", "evaluate standard"),
            ("baumgarte", "evaluate baumgarte"),
            ("penalty", "evaluate penalty"),
        ] {
            let row = row(&rows, ["pendulum", "bodies", formulation, scalar]);
            let reported = operations(kernel);
            assert_eq!(
                (row.operations, row.path),
                (reported.total(), reported.depth)
            );
            let row = self::row(&rows, ["pendulum", "joints", formulation, scalar]);
            assert_eq!((row.operations, row.path), (1, 1));
        }
        let row = row(&rows, ["four-bar", "joints", "penalty", scalar]);
        let kernels = FourBar::JOINT_REPORT.kernels.iter();
        let reported = kernels.filter(|kernel| kernel.name == "evaluate penalty");
        let reported: Vec<_> = reported.map(|kernel| kernel.operations.total()).collect();
        assert_eq!(reported, [row.operations]);
        let row = self::row(&rows, ["four-bar", "joints", "standard", scalar]);
        assert!(row.stage_operations < row.operations, "{row:?}");
    }
    // Several solutions of one factorisation, two at least.
    let iterated = row(&rows, ["pendulum", "bodies", "augmented-lagrangian", "f64"]);
    let solution = operations("solve, compliant").total();
    let once = operations("evaluate penalty").total();
    assert!(iterated.operations > once + solution, "{iterated:?}");
}

#[test]
fn the_page_shows_what_was_measured_and_another_build_beside_it() {
    let (rows, refused) = small();
    let directory = std::env::temp_dir().join(format!("holonom-compare-{}", std::process::id()));
    assert_eq!(Beside::of(&directory).unwrap(), Beside::default());
    report::write_plain(&rows, &directory).unwrap();
    let beside = Beside::of(&directory).unwrap();
    assert_same(beside.plain.as_ref().unwrap(), &rows);
    let document = report::document(&rows, &refused, &beside, &Target::CURRENT);
    let written = report::write(&document, &rows, &directory).unwrap();
    assert!(written.iter().all(|path| path.is_file()));
    let page = std::fs::read_to_string(directory.join("index.html")).unwrap();
    for part in [
        "reference kernel (T)",
        "pendulum, joints",
        "four-bar, bodies",
        "target-cpu=native",
        "A plain build beside",
    ] {
        assert!(page.contains(part), "{part}");
    }
    assert_eq!(
        page.contains("Not here: augmented Lagrangian by joints"),
        !refused.is_empty()
    );
    std::fs::remove_dir_all(&directory).unwrap();
}

/// The assembler of every scene moves as its kernels do.
#[test]
fn assemblers_describe_the_same_mechanisms() {
    for entry in entries() {
        let Some(assembler) = entry.assembler else {
            continue;
        };
        let Entry { scene, n, .. } = entry;
        let prepared = (entry.prepare)(&entry).unwrap();
        let mut evaluator = Evaluator::new(assembler(), Formulation::Standard);
        for (state, rates) in prepared.states.iter().zip(&prepared.rates).step_by(7) {
            let mut expected = vec![0.0; state.len()];
            evaluator.rates(0.0, state, &mut expected).unwrap();
            let size = rates.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
            for (a, b) in rates.iter().zip(&expected) {
                assert!((a - b).abs() < 1e-9 * size, "{scene} {n}: {a} and {b}");
            }
        }
    }
}

//! The map of extremes, in small: nothing is wrong without a word.

use std::collections::BTreeMap;

use holonom_benches::extremes::{Coefficients, map};
use holonom_study::extremes::{Outcome, run};

/// Runs the cells of some axes.
fn swept(names: &[&str]) -> Vec<run::Row> {
    let (axes, mut cells) = map(Coefficients::Derived);
    cells.retain(|cell| names.contains(&axes[cell.axis].name));
    assert!(!cells.is_empty());
    let directory = std::env::temp_dir().join(format!("holonom-extremes-{}", std::process::id()));
    let journal = directory.join(names.concat().replace(' ', "-"));
    let rows = run::run(&axes, &cells, &journal, |_| ()).expect("a journal that can be written");
    std::fs::remove_file(journal).expect("the journal");
    assert_eq!(rows.len(), cells.len());
    rows
}

#[test]
fn nothing_is_wrong_in_double_precision() {
    let rows = swept(&[
        "size",
        "mass",
        "small and light",
        "distance",
        "start",
        "penalty",
        "baumgarte",
    ]);
    let double = || rows.iter().filter(|row| row.setting.scalar == "f64");
    for row in double() {
        assert_ne!(row.outcome, Outcome::Wrong, "{row:?}");
        assert!(
            row.outcome == Outcome::Holds || !row.reason.is_empty(),
            "{row:?}"
        );
    }
    // The map is none where all is the same.
    let mut counts = BTreeMap::new();
    for row in double() {
        *counts.entry(row.outcome.key()).or_insert(0) += 1;
    }
    assert!(
        counts["holds"] > 300 && counts["fails"] > 20 && counts["drifts"] > 20,
        "{counts:?}"
    );
}

#[test]
fn by_bodies_a_rod_holds_at_any_size_and_mass_with_coefficients_that_follow_from_it() {
    let rows = swept(&["size", "mass", "small and light"]);
    let stabilised = rows
        .iter()
        .filter(|row| row.setting.coordinates == "bodies" && row.setting.formulation != "standard");
    assert!(stabilised.clone().count() > 300);
    for row in stabilised {
        assert_eq!(row.outcome, Outcome::Holds, "{row:?}");
    }
}

#[test]
fn by_joints_a_rod_holds_at_any_size_mass_and_place() {
    let rows = swept(&["size", "mass", "distance"]);
    let by_joints = rows
        .iter()
        .filter(|row| row.setting.coordinates == "joints" && row.setting.scalar == "f64");
    assert!(by_joints.clone().count() > 50);
    for row in by_joints {
        assert_eq!(row.outcome, Outcome::Holds, "{row:?}");
    }
}

#[test]
fn a_map_has_its_cells_once() {
    let (axes, cells) = map(Coefficients::Derived);
    assert!(cells.len() >= 400, "{}", cells.len());
    let mut keys: Vec<_> = cells
        .iter()
        .map(|cell| {
            (
                axes[cell.axis].name,
                cell.value.to_bits(),
                cell.setting.name(),
                format!("{:?}", cell.setting.formulation),
            )
        })
        .collect();
    let all = keys.len();
    keys.sort();
    keys.dedup();
    assert_eq!(keys.len(), all);
}

#[test]
fn a_journal_of_other_promises_is_not_taken() {
    let (axes, mut cells) = map(Coefficients::Derived);
    cells.retain(|cell| axes[cell.axis].name == "size" && cell.value == 1.0);
    let directory = std::env::temp_dir().join(format!("holonom-promises-{}", std::process::id()));
    let journal = directory.join("journal");
    let errors = |cells: &[holonom_study::extremes::Cell]| -> Vec<Option<f64>> {
        let rows = run::run(&axes, cells, &journal, |_| ()).expect("a journal that can be written");
        rows.into_iter().map(|row| row.error).collect()
    };
    let first = errors(&cells);
    assert_eq!(errors(&cells), first);
    for cell in &mut cells {
        cell.scale = 2.0;
    }
    let halved: Vec<_> = first
        .iter()
        .map(|error| error.map(|error| error / 2.0))
        .collect();
    assert_eq!(errors(&cells), halved);
    std::fs::remove_dir_all(directory).expect("the journal");
}

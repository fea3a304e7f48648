//! `study estimate`: what it measures and what it writes, not how fast anything is.

use std::collections::BTreeSet;
use std::time::Duration;

use holonom::mechanism::{Kernel, Operations};
use holonom_benches::estimate::{Measured, Row, kernels, measure, table};
use holonom_study::statistics::Quartiles;
use holonom_study::timing::Schedule;

#[test]
fn twenty_kernels_and_more_are_held_against_their_reports() {
    let kernels = kernels().unwrap();
    let names: BTreeSet<&str> = kernels.iter().map(|kernel| &*kernel.name).collect();
    assert_eq!(names.len(), kernels.len());
    let operations = |kernel: &Kernel| kernel.operations.total();
    assert!(kernels.is_sorted_by_key(|kernel| operations(&kernel.reported)));
    let long = kernels.iter().map(|kernel| &kernel.reported);
    let long = long.filter(|kernel| operations(kernel) >= 100);
    assert!(long.clone().count() >= 20);
    // No core does four operations in a cycle, fused ones counted twice, nor waits for each.
    for kernel in long {
        assert!(kernel.cycles > operations(kernel) / 4, "{kernel:?}");
        assert!(kernel.cycles < 4 * operations(kernel), "{kernel:?}");
    }
}

/// A row of an estimate, and what was measured (ns).
fn row(total: usize, cycles: usize, least: f64) -> Row {
    let time = Quartiles::of(&[least]).unwrap();
    Row {
        name: format!("kernel {total}"),
        reported: Kernel {
            name: "evaluate standard",
            operations: Operations {
                additions: total,
                depth: 7,
                ..Operations::NONE
            },
            cycles,
        },
        waiting: time,
        independent: time,
    }
}

#[test]
fn the_table_has_ratios_and_how_many_are_close() {
    let measured = Measured {
        rows: vec![row(40, 99, 10.0), row(100, 59, 25.0), row(200, 90, 30.0)],
        cycle: 0.5,
        busy: None,
    };
    let table = table(&measured);
    let line = ["kernel 100", "100", "7", "59", "50", "1.18", "25", "25"];
    assert_eq!(table.rows[1], line);
    let close = "Of 2 kernels of at least 100 operations, the estimates of 1 are within 20 %";
    assert!(table.note.contains(close), "{}", table.note);
}

#[test]
fn without_fused_multiply_adds_nothing_is_measured() {
    if cfg!(not(target_feature = "fma")) {
        let schedule = Schedule {
            rounds: 1,
            turn: Duration::ZERO,
        };
        let refused = measure(schedule, |_| ()).unwrap_err().to_string();
        assert!(refused.contains("target-cpu=native"), "{refused}");
    }
}

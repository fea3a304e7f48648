//! Rows are the same in whatever shard they are computed, and files of shards join to that of all.

use std::fs;
use std::path::PathBuf;

use holonom::prelude::*;
use holonom_models::RodPendulum;
use holonom_study::StudyError;
use holonom_study::ensemble::rand_chacha::{ChaCha8Rng, rand_core::Rng};
use holonom_study::ensemble::{Draw, Row, Rows, Shard, Steps, Table, compute, merge};

const STEPS: Steps = Steps {
    step: 0.01,
    count: 50,
    every: 10,
};

/// A pendulum with a rate (rad/s) from 0 to 1; that of some rows is not finite.
fn draw(generator: &mut ChaCha8Rng) -> Result<Draw<RodPendulum, 1>, ParameterError> {
    let pendulum = RodPendulum::default();
    let mut start = pendulum.described_state()?;
    let drawn = generator.next_u32();
    let rate = if drawn.is_multiple_of(5) {
        f64::NAN
    } else {
        f64::from(drawn) / f64::from(u32::MAX)
    };
    let rod = RodPendulum::HANDLES.rod;
    RodPendulum::set_velocity(&mut start, rod, [0.0, 0.0, 0.5 * rate].into());
    RodPendulum::set_angular_velocity(&mut start, rod, [rate, 0.0, 0.0].into());
    Ok(Draw {
        mechanism: pendulum,
        start: Some(start),
        columns: [f64::from(drawn)],
    })
}

fn read(readings: &mut [f64; 2], view: &View<'_, f64, RodPendulum>) {
    let angle = view.angle(RodPendulum::HANDLES.pivot);
    *readings = [angle, readings[1].max(angle)];
}

fn rows(shard: &str) -> (Rows, Vec<Row<1, 2>>) {
    let rows = Rows {
        all: 43,
        shard: shard.parse().expect("a shard"),
        seed: 7,
    };
    let computed = compute(&rows, (StandardLagrange, Rk4, STEPS), draw, read, |_| ());
    (rows, computed.expect("sound rows"))
}

fn write(name: &str, shard: &str) -> PathBuf {
    let (of, rows) = rows(shard);
    let path = std::env::temp_dir().join(format!("holonom-rows-{}-{name}", std::process::id()));
    let table = Table::new(&of, (["drawn"], ["angle", "highest"]), &rows);
    table.write(&path).expect("written");
    path
}

#[test]
fn shards_have_the_rows_of_all() {
    let all = write("all.csv", "1/1");
    let parts = ["3/3", "1/3", "2/3"].map(|shard| write(&shard.replace('/', "of"), shard));
    let joined = std::env::temp_dir().join(format!("holonom-rows-{}-joined", std::process::id()));
    let table = merge(&parts).expect("all rows");
    table.write(&joined).expect("written");
    assert_eq!(
        fs::read(&all).expect("there"),
        fs::read(&joined).expect("there")
    );
    let missing = merge(&parts[..2]).expect_err("a shard is missing");
    assert!(matches!(missing, StudyError::Rows { .. }));
    let twice = merge(&[all.clone(), all.clone()]).expect_err("twice");
    assert!(
        twice.to_string().contains("row 0 is there twice"),
        "{twice}"
    );
}

#[test]
fn a_row_that_is_refused_says_so_and_leaves_the_others() {
    let (_, rows) = rows("1/1");
    assert_eq!(rows.len(), 43);
    let refused = rows.iter().filter(|row| row.stopped.is_some()).count();
    assert!((1..22).contains(&refused), "{refused}");
    for row in rows {
        assert_eq!(row.stopped.is_some(), row.readings[0].is_nan(), "{row:?}");
    }
}

#[test]
fn shards_are_all_rows_once() {
    for all in [0, 1, 7, 8, 100] {
        let mut numbers = Vec::new();
        for index in 1..=8 {
            let shard: Shard = format!("{index}/8").parse().expect("a shard");
            numbers.extend(shard.rows(all));
        }
        assert_eq!(numbers, (0..all).collect::<Vec<_>>());
    }
    for wrong in ["0/8", "9/8", "1", "a/b", "1/0"] {
        assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
    }
}

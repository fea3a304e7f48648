//! Rows are the same in whatever shard they are computed, and files of shards join to that of all.

use std::fs;
use std::path::{Path, PathBuf};

use holonom::prelude::*;
use holonom_models::RodPendulum;
use holonom_study::StudyError;
use holonom_study::ensemble::rand_chacha::{ChaCha8Rng, rand_core::Rng};
use holonom_study::ensemble::{Draw, Row, Rows, Shard, Steps, Table, compute, merge, resume};

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

/// Where a child process of the test below keeps its rows.
const JOURNAL: &str = "HOLONOM_ROWS_OF_A_CHILD";

fn kept(journal: &Path, done: impl Fn(u64) + Sync) -> Result<Table, StudyError> {
    let rows = Rows {
        all: 200,
        shard: Shard::ALL,
        seed: 7,
    };
    let names = (["drawn"], ["angle", "highest"]);
    let method = (StandardLagrange, Rk4, STEPS);
    resume(&rows, journal, names, method, draw, read, done)
}

/// Run by the test below in a process of its own; nothing otherwise. It never comes to an end: once
/// rows are kept, it waits to be killed.
#[test]
#[ignore = "a child process of another test"]
fn rows_of_a_child() {
    if let Some(journal) = std::env::var_os(JOURNAL) {
        let done = std::sync::atomic::AtomicU64::new(0);
        let wait = |further| {
            let order = std::sync::atomic::Ordering::SeqCst;
            while done.fetch_add(further, order) >= 40 {
                std::thread::park();
            }
        };
        kept(Path::new(&journal), wait).expect("sound rows");
    }
}

/// The child is killed once some rows are in its journal, and never gets to all of them. A shell
/// may have its jobs ignore an interrupt, which is inherited.
#[test]
fn an_interrupted_computation_goes_on() {
    use std::process::{Command, Stdio};

    let directory = std::env::temp_dir().join(format!("holonom-rows-kept-{}", std::process::id()));
    let journal = directory.join("journal");
    let lines = || {
        fs::read_to_string(&journal)
            .unwrap_or_default()
            .lines()
            .count()
    };
    for _ in 0..2 {
        let mut child = Command::new(std::env::current_exe().expect("this program"))
            .args([
                "--exact",
                "rows_of_a_child",
                "--ignored",
                "--test-threads=1",
            ])
            .env(JOURNAL, &journal)
            .env("RAYON_NUM_THREADS", "2")
            .stdout(Stdio::null())
            .spawn()
            .expect("a process");
        let before = lines();
        while lines() < before.max(20) {
            assert!(
                child.try_wait().expect("a status").is_none(),
                "it ended by itself"
            );
            std::thread::yield_now();
        }
        child.kill().expect("it runs");
        assert!(!child.wait().expect("a status").success());
    }
    let known = lines() as u64 - 1;
    assert!((20..200).contains(&known), "{known}");

    let told = std::sync::Mutex::new(Vec::new());
    let table = kept(&journal, |further| {
        told.lock().expect("sound").push(further)
    });
    let told = told.into_inner().expect("sound");
    // The last line may have been cut short.
    assert!(told[0] == known || told[0] == known - 1, "{told:?} {known}");
    assert_eq!(told.iter().sum::<u64>(), 200);
    let whole = kept(&directory.join("another"), |_| ()).expect("sound rows");
    assert_eq!(table.expect("sound rows"), whole);
    fs::remove_dir_all(&directory).expect("there");
}

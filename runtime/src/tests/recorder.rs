//! Samples as lines of a CSV file, read back.

use crate::dynamics::Dynamics;
use crate::state::State;
use core::ops::ControlFlow;
use std::io::{self, Write};
use std::string::String;
use std::vec::Vec;

use super::crank::{CRANK, Crank, MOTOR, crank};
use super::rod::{ROD, rod};
use crate::measure::UnwrappedAngle;
use crate::run::{RecordError, Simulate as _};
use crate::*;

fn follow(speed: f64, mut observe: impl FnMut(&Sample<'_, f64, Crank>)) {
    KinematicAnalysis::new(&crank(speed), StandardLagrange)
        .run(0.0..=1.0, every(0.1), |sample| {
            observe(sample);
            ControlFlow::Continue(())
        })
        .unwrap();
}

/// The names of the columns, and the rows.
fn parse(bytes: &[u8]) -> (Vec<String>, Vec<Vec<f64>>) {
    let mut reader = csv::Reader::from_reader(bytes);
    let names = reader.headers().unwrap().iter().map(String::from).collect();
    let rows = reader.records().map(|record| {
        let record = record.unwrap();
        record.iter().map(|field| field.parse().unwrap()).collect()
    });
    (names, rows.collect())
}

#[test]
fn what_was_recorded_reads_back_to_the_last_digit() {
    let mut recorder = Recorder::new(Vec::new()).with_reactions();
    let mut expected = Vec::new();
    follow(7.0, |sample| {
        recorder.record(sample).unwrap();
        let pose = sample.pose(CRANK);
        let wrench = sample.reaction(MOTOR, CRANK).unwrap();
        expected.push([
            ("time [s]", sample.time()),
            ("rod.position.z [m]", pose.position.z),
            ("rod.orientation.e0", pose.orientation.w),
            ("rod.orientation.e1", pose.orientation.i),
            ("rod.velocity.y [m/s]", sample.velocity(CRANK).y),
            (
                "rod.angular_velocity.x [rad/s]",
                sample.angular_velocity(CRANK).x,
            ),
            ("motor.angle [rad]", sample.angle(MOTOR)),
            ("motor.angle_rate [rad/s]", sample.angle_rate(MOTOR)),
            ("motor.displacement [m]", sample.displacement(MOTOR)),
            (
                "motor.displacement_rate [m/s]",
                sample.displacement_rate(MOTOR),
            ),
            ("kinetic_energy [J]", sample.kinetic_energy()),
            ("potential_energy [J]", sample.potential_energy()),
            ("violation", sample.violation()),
            ("motor.force.z [N]", wrench.force.z),
            ("motor.moment.x [N m]", wrench.moment.x),
        ]);
    });
    let (names, rows) = parse(&recorder.into_inner());
    assert_eq!(
        (names.len(), rows.len()),
        (1 + 13 + 4 + 3 + 6, expected.len())
    );
    for (row, expected) in rows.iter().zip(&expected) {
        for (name, value) in expected {
            let place = names.iter().position(|known| known == name).unwrap();
            assert_eq!(row[place], *value, "{name}");
        }
    }
    // The counter, not an angle within half a turn.
    assert!(expected[10][6].1 > 6.9);
}

#[test]
fn values_are_those_of_the_line() {
    let mut recorder = Recorder::new(Vec::new()).with_reactions();
    let mut beside = Recorder::new(Vec::new()).with_reactions();
    let mut rows = Vec::new();
    follow(7.0, |sample| {
        recorder.record(sample).unwrap();
        let values = beside.values(sample).unwrap();
        rows.push(values.into_iter().map(Option::unwrap).collect::<Vec<f64>>());
    });
    let columns = beside.columns::<Crank>();
    assert_eq!(parse(&recorder.into_inner()), (columns, rows));
    assert!(beside.into_inner().is_empty());
}

/// Takes a number of bytes and no more.
struct Full {
    taken: Vec<u8>,
    space: usize,
}

impl Write for Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = bytes.len().min(self.space - self.taken.len());
        if count == 0 {
            return Err(io::ErrorKind::StorageFull.into());
        }
        self.taken.extend(&bytes[..count]);
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_writer_that_fails_midway_keeps_all_lines_but_the_last() {
    let mut whole = Recorder::new(Vec::new());
    follow(7.0, |sample| whole.record(sample).unwrap());
    let whole = whole.into_inner();
    let lines = whole.split_inclusive(|byte| *byte == b'\n');
    let space = lines.take(5).map(<[u8]>::len).sum::<usize>() + 30;
    let taken = Vec::new();
    let mut recorder = Recorder::new(Full { taken, space });
    let mut outcomes = Vec::new();
    follow(7.0, |sample| outcomes.push(recorder.record(sample)));
    assert!(outcomes[..4].iter().all(Result::is_ok));
    assert!(
        matches!(&outcomes[4], Err(RecordError::Io(error)) if error.kind() == io::ErrorKind::StorageFull)
    );
    assert!(
        outcomes[5..]
            .iter()
            .all(|outcome| matches!(outcome, Err(RecordError::Torn)))
    );
    assert_eq!(recorder.into_inner().taken, whole[..space]);
}

/// Counts what it is asked to do.
#[derive(Default)]
struct Calls {
    written: usize,
    flushed: usize,
}

impl Write for Calls {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        assert!(bytes.ends_with(b"\n"));
        self.written += 1;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.flushed += 1;
        assert_eq!(self.flushed, self.written);
        Ok(())
    }
}

#[test]
fn a_line_is_written_in_one_piece_and_flushed() {
    let mut recorder = Recorder::new(Calls::default()).with_reactions();
    follow(1.0, |sample| recorder.record(sample).unwrap());
    assert_eq!(recorder.into_inner().written, 12);
}

#[test]
fn what_cannot_be_recorded_is_an_error_and_writes_nothing() {
    // Euler parameters of length zero: no reactions.
    let rod = rod();
    let dynamics = Dynamics::new(&rod, StandardLagrange).unwrap();
    let flat = State::from_parts([0.0; 7], [0.0; 6]);
    let mut recorder = Recorder::new(Vec::new()).with_reactions();
    let outcome = recorder.record(&Sample::new(dynamics.view(0.0, &flat), &dynamics));
    assert!(matches!(outcome, Err(RecordError::Evaluation(_))));

    let mut state: State<f64, 7, 6> = rod.described_state().unwrap();
    state.velocities_mut()[1] = f64::NAN;
    let mut recorder = Recorder::new(Vec::new());
    let outcome = recorder.record(&Sample::new(dynamics.view(0.0, &state), &dynamics));
    let Err(RecordError::NotFinite { column }) = outcome else {
        panic!("{outcome:?}");
    };
    assert_eq!(column, "rod.velocity.y [m/s]");
    assert!(recorder.writer().is_empty());

    follow(1.0, |sample| {
        let _ = recorder.record(sample);
    });
    let before = recorder.writer().len();
    let described = rod.described_state().unwrap();
    let outcome = recorder.record(&Sample::new(dynamics.view(0.0, &described), &dynamics));
    assert!(matches!(outcome, Err(RecordError::OtherMechanism)));
    assert_eq!(recorder.writer().len(), before);
    assert_eq!(dynamics.view(0.0, &described).velocity(ROD).norm(), 0.0);
}

#[test]
fn a_file_is_replaced() {
    let path =
        std::env::temp_dir().join(std::format!("holonom-recorder-{}.csv", std::process::id()));
    for speed in [3.0, 1.0] {
        let mut recorder = Recorder::create(&path).unwrap();
        follow(speed, |sample| recorder.record(sample).unwrap());
    }
    let (_, rows) = parse(&std::fs::read(&path).unwrap());
    std::fs::remove_file(&path).unwrap();
    assert_eq!(rows.len(), 11);
    assert!((rows[10][14] - 1.0).abs() < 1e-9);
    let nowhere = Recorder::create(path.join("below").join("a file"));
    assert!(matches!(nowhere, Err(RecordError::Io(_))));
}

#[test]
fn single_precision_is_recorded_as_it_is() {
    let mut recorder = Recorder::new(Vec::new());
    let mut times = Vec::new();
    KinematicAnalysis::new(&crank(1.0), StandardLagrange)
        .run(0.0_f32..=1.0, every(0.3), |sample| {
            times.push(sample.time());
            recorder.record(sample).unwrap();
            ControlFlow::Continue(())
        })
        .unwrap();
    let (_, rows) = parse(&recorder.into_inner());
    assert!(
        rows.iter()
            .zip(&times)
            .all(|(row, time)| row[0] == f64::from(*time))
    );
}

/// The rod turns over at 11 rad/s or more: ten times in six seconds.
#[test]
fn angles_of_a_record_go_on_over_turns() {
    let rod = rod();
    let mut state = rod.described_state().unwrap();
    crate::tests::rod::Rod::set_angular_velocity(&mut state, ROD, [12.0, 0.0, 0.0].into());
    crate::tests::rod::Rod::set_velocity(&mut state, ROD, [0.0, 0.0, 6.0].into());
    let mut recorder = Recorder::new(Vec::new());
    let mut followed = UnwrappedAngle::default();
    let mut angles = Vec::new();
    rod.simulation(StandardLagrange, Rk4::every(0.002))
        .initial_state(state)
        .run(0.0..=6.0, every(0.2), |sample| {
            angles.push(followed.read(sample, super::rod::PIVOT));
            recorder.record(sample)
        })
        .unwrap();
    let (names, rows) = parse(recorder.writer());
    let place = |wanted: &str| names.iter().position(|name| name == wanted).unwrap();
    let (angle, rate) = (
        place("pivot.angle [rad]"),
        place("pivot.angle_rate [rad/s]"),
    );
    for (pair, known) in rows.windows(2).zip(angles.windows(2)) {
        assert_eq!([pair[0][angle], pair[1][angle]], known);
        // As the rates have it, by the trapezium.
        let turned = 0.1 * (pair[0][rate] + pair[1][rate]);
        assert!((pair[1][angle] - pair[0][angle] - turned).abs() < 0.5);
    }
    assert!(rows.last().unwrap()[angle] > 60.0);
}

/// The body's z axis goes from across that of the ground to against it, where Euler angles are
/// singular.
#[test]
fn angles_that_are_singular_are_empty_fields() {
    let mut recorder = Recorder::new(Vec::new())
        .with_euler_angles()
        .with_bryant_angles()
        .with_roll_pitch_yaw();
    let mut expected = Vec::new();
    follow(core::f64::consts::FRAC_PI_2, |sample| {
        recorder.record(sample).unwrap();
        expected.push((sample.euler_angles(CRANK), sample.bryant_angles(CRANK)));
    });
    let bytes = recorder.into_inner();
    let mut reader = csv::Reader::from_reader(&bytes[..]);
    let names = reader.headers().unwrap().clone();
    let place = |name: &str| names.iter().position(|known| known == name).unwrap();
    let [first, middle, last] = ["precession", "nutation", "spin"]
        .map(|angle| place(&std::format!("rod.euler_angles.{angle} [rad]")));
    let bryant = place("rod.bryant_angles.first [rad]");
    assert_eq!(place("rod.roll_pitch_yaw.yaw [rad]") + 1, names.len());
    let mut singular = 0;
    for (row, (euler, angles)) in reader.records().zip(expected) {
        let row = row.unwrap();
        match euler {
            Ok(euler) => {
                assert_eq!(row[first].parse(), Ok(euler.precession));
                assert_eq!(row[middle].parse(), Ok(euler.nutation));
                assert_eq!(row[last].parse(), Ok(euler.spin));
            }
            Err(_) => {
                singular += 1;
                assert_eq!((&row[first], &row[last]), ("", ""));
                let nutation: f64 = row[middle].parse().unwrap();
                assert!((nutation - core::f64::consts::PI).abs() < 1e-7);
            }
        }
        assert_eq!(row[bryant].parse(), Ok(angles.unwrap().first));
    }
    assert_eq!(singular, 1);
}

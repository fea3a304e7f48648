//! The equations of motion of two arms: what `study arms` times, beside programs of others.

use std::collections::BTreeMap;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::Command;

use holonom::independent::{Chosen, IndependentCoordinates};
use holonom::mechanism::{HasInverse, HasMassMatrix, JointRates};
use holonom::prelude::*;
use holonom_models::{Panda, Ur5};
use holonom_study::StudyError;
use holonom_study::document::Table;
use holonom_study::format::fixed;
use holonom_study::statistics::Quartiles;
use holonom_study::timing::{Candidate, Schedule, race};

use crate::reference_kernel::candidate;

/// States, each with accelerations and torques, that are evaluated in turn.
const STATES: usize = 64;

/// How often programs of others are run among the rounds.
const TURNS: usize = 7;

/// What an evaluation costs.
#[derive(Clone, Debug)]
pub struct Row {
    /// Of which arm.
    pub arm: &'static str,
    /// What is evaluated.
    pub quantity: &'static str,
    /// By whom: empty for this project.
    pub by: String,
    /// Operations, where they are known.
    pub operations: Option<usize>,
    /// Nanoseconds.
    pub time: f64,
}

/// Rows, and what the reference kernel takes in the same run (ns).
#[derive(Clone, Debug)]
pub struct Measured {
    /// The rows, of each arm together.
    pub rows: Vec<Row>,
    /// The time `T` of the reference kernel (ns).
    pub unit: f64,
}

/// What others have for a quantity, and what their programs call it.
const QUANTITIES: [(&str, &str); 4] = [
    ("mass matrix", "mass"),
    ("inverse dynamics", "inverse"),
    ("forward dynamics", "forward"),
    ("linearisation", "linearise"),
];

/// Programs of others for one arm: `pinocchio-ur5` and so on.
struct Peer {
    by: String,
    program: PathBuf,
    operations: Option<usize>,
    times: BTreeMap<String, Vec<f64>>,
}

impl Peer {
    /// Those of an arm in a folder.
    fn all(folder: &Path, arm: &str) -> Result<Vec<Self>, StudyError> {
        let names = [("pinocchio", "Pinocchio"), ("casadi", "CasADi")];
        let peers = names.iter().map(|(file, by)| {
            let program = folder.join(format!("{file}-{}", arm.to_lowercase()));
            if !program.is_file() {
                return Err(fault(&program, "is not there: build it as its folder says"));
            }
            let counted = std::fs::read_to_string(program.with_extension("operations")).ok();
            let counted = counted
                .as_deref()
                .and_then(|text| text.split_whitespace().last());
            Ok(Self {
                by: (*by).to_owned(),
                program,
                operations: counted.and_then(|count| count.parse().ok()),
                times: BTreeMap::new(),
            })
        });
        peers.collect()
    }

    /// Runs it once.
    fn turn(&mut self) -> Result<(), StudyError> {
        let output = Command::new(&self.program).output();
        let output = output.map_err(|error| fault(&self.program, &error.to_string()))?;
        if !output.status.success() {
            return Err(fault(&self.program, &output.status.to_string()));
        }
        for line in String::from_utf8_lossy(&output.stdout).lines() {
            let time = line.split_once(' ').and_then(|(name, time)| {
                let time: f64 = time.trim().parse().ok()?;
                Some((name.to_owned(), time))
            });
            let (name, time) = time.ok_or_else(|| fault(&self.program, line))?;
            self.times.entry(name).or_default().push(time);
        }
        Ok(())
    }

    /// What it takes, for what it has.
    fn row(&self, arm: &'static str, (quantity, word): (&'static str, &str)) -> Option<Row> {
        let time = Quartiles::of(self.times.get(word)?)?;
        Some(Row {
            arm,
            quantity,
            by: self.by.clone(),
            operations: self.operations.filter(|_| word == "inverse"),
            time: time.median,
        })
    }
}

fn fault(program: &Path, reason: &str) -> StudyError {
    StudyError::Run {
        name: program.display().to_string(),
        reason: reason.to_owned(),
    }
}

/// Times both arms, beside the programs in a folder where one is given. `progress` is called with
/// how many of the parts that are told are done.
///
/// # Errors
/// [`StudyError`] where an arm cannot be evaluated, or a program of others does not run.
pub fn measure(
    peers: Option<&Path>,
    schedule: Schedule,
    mut progress: impl FnMut(usize),
) -> Result<Measured, StudyError> {
    let h = Ur5::HANDLES;
    let axes = [h.pan, h.lift, h.elbow, h.wrist_1, h.wrist_2, h.wrist_3];
    let mut measured = arm::<Ur5, 6>("UR5", axes, (peers, schedule))?;
    progress(1);
    let h = Panda::HANDLES;
    let [a, b, c, d] = [h.joint_1, h.joint_2, h.joint_3, h.joint_4];
    let axes = [a, b, c, d, h.joint_5, h.joint_6, h.joint_7];
    let further = arm::<Panda, 7>("Panda", axes, (peers, schedule))?;
    progress(2);
    measured.rows.extend(further.rows);
    measured.unit = 0.5 * (measured.unit + further.unit);
    Ok(measured)
}

/// The parts of [`measure`].
pub const PARTS: u64 = 2;

fn arm<M, const N: usize>(
    name: &'static str,
    axes: impl Chosen<M, N>,
    (peers, schedule): (Option<&Path>, Schedule),
) -> Result<Measured, StudyError>
where
    M: HasMassMatrix + HasInverse + Default,
{
    let refused = |fault: Fault| StudyError::Run {
        name: name.to_owned(),
        reason: fault.to_string(),
    };
    let arm = M::default();
    let space = arm.coordinates(axes).map_err(refused)?;
    let states = states(&space).map_err(refused)?;
    let mut peers = peers.map_or(Ok(Vec::new()), |folder| Peer::all(folder, name))?;
    let mut times = vec![Vec::new(); QUANTITIES.len() + 1];
    for _ in 0..TURNS {
        let each = Schedule {
            rounds: schedule.rounds.div_ceil(TURNS),
            ..schedule
        };
        let timings = race(&mut candidates(&space, &states)?, each, |_| ())?;
        for (times, timing) in times.iter_mut().zip(timings) {
            times.push(timing.time.median);
        }
        for peer in &mut peers {
            peer.turn()?;
        }
    }
    let median = |times: &Vec<f64>| Quartiles::of(times).map_or(f64::NAN, |time| time.median);
    let mut rows = Vec::new();
    for (quantity, times) in QUANTITIES.into_iter().zip(&times) {
        let mut asked = M::JOINT_REPORT.asked.iter();
        let kernel = asked.find(|kernel| kernel.name == quantity.1);
        rows.push(Row {
            arm: name,
            quantity: quantity.0,
            by: String::new(),
            operations: kernel.map(|kernel| kernel.operations.total()),
            time: median(times),
        });
        rows.extend(peers.iter().filter_map(|peer| peer.row(name, quantity)));
    }
    Ok(Measured {
        rows,
        unit: times.last().map_or(f64::NAN, median),
    })
}

/// A state, and numbers that are accelerations or torques.
type Posed<M, const N: usize> = (<M as JointCoordinates>::JointState<f64>, [f64; N]);

/// States between minus one and one (rad, rad/s), which do not depend on each other.
fn states<M: JointRates, const N: usize>(
    space: &IndependentCoordinates<M, N>,
) -> Result<Vec<Posed<M, N>>, Fault> {
    /// Weyl's sequence: what is left of multiples of the golden ratio.
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    let mut drawn = 0.0_f64;
    let mut draw = || {
        drawn = (drawn + GOLDEN).fract();
        2.0 * drawn - 1.0
    };
    let mut states = Vec::with_capacity(STATES);
    for _ in 0..STATES {
        let [positions, rates, others] = std::array::from_fn(|_| std::array::from_fn(|_| draw()));
        states.push((space.state(positions, rates)?, others));
    }
    Ok(states)
}

fn candidates<'a, M, const N: usize>(
    space: &'a IndependentCoordinates<M, N>,
    states: &'a [Posed<M, N>],
) -> Result<Vec<Candidate<'a>>, StudyError>
where
    M: HasMassMatrix + HasInverse,
{
    /// Evaluates at every state.
    fn each<'a, P, T: 'a>(
        name: &'static str,
        states: &'a [P],
        evaluate: impl Fn(&P) -> Result<T, Fault> + 'a,
    ) -> Candidate<'a> {
        Candidate::new(name, move || {
            for state in states {
                let value = evaluate(black_box(state)).map_err(|fault| StudyError::Run {
                    name: name.into(),
                    reason: fault.to_string(),
                })?;
                black_box(&value);
            }
            Ok(states.len() as u64)
        })
    }
    Ok(vec![
        each("mass", states, |(state, _)| space.mass(state)),
        each("inverse", states, |(state, others)| {
            space.inverse(state, *others)
        }),
        each("forward", states, |(state, others)| {
            space.forward(state, *others)
        }),
        each("linearise", states, |(state, _)| {
            space.linearise(state, [], |_| [])
        }),
        candidate()?,
    ])
}

/// The rows as a table.
#[must_use]
pub fn table(measured: &Measured) -> Table {
    let row = |row: &Row| {
        let by = if row.by.is_empty() {
            String::new()
        } else {
            format!(", {}", row.by)
        };
        vec![
            format!("{} {}{by}", row.arm, row.quantity),
            row.operations.map_or("-".into(), |count| count.to_string()),
            fixed(row.time / measured.unit, 1),
            fixed(row.time, 0),
        ]
    };
    Table {
        caption: "Equations of motion in the angles of an arm".into(),
        columns: ["", "operations", "time (T)", "time (ns)"]
            .map(String::from)
            .into(),
        rows: measured.rows.iter().map(row).collect(),
        note: format!(
            "T = {} ns, the pendulum written by hand. Medians; states are drawn.",
            fixed(measured.unit, 1)
        ),
    }
}

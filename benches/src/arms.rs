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
use holonom_study::target::Target;
use holonom_study::timing::{Candidate, Race, Schedule, busy};

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
    /// The time of the processor (ns).
    pub time: Quartiles,
}

/// Rows, and what the reference kernel takes in the same run (ns).
#[derive(Clone, Debug)]
pub struct Measured {
    /// The rows, of each arm together.
    pub rows: Vec<Row>,
    /// The time `T` of the reference kernel (ns).
    pub unit: f64,
    /// A sentence where the machine was not quiet.
    pub busy: Option<String>,
    /// What the programs of others were compiled for, where there are some.
    pub peers: Option<String>,
}

/// What is timed, and what the programs of others call it. Sines and cosines of the angles are part
/// of a state: they are at hand in a run, and inside the clock where angles are measured.
const QUANTITIES: [(&str, &str); 8] = [
    ("mass matrix", "mass"),
    ("mass matrix, from angles", "mass-angles"),
    ("inverse dynamics", "inverse"),
    ("inverse dynamics, from angles", "inverse-angles"),
    ("forward dynamics", "forward"),
    ("forward dynamics, from angles", "forward-angles"),
    ("linearisation", "linearise"),
    ("linearisation, from angles", "linearise-angles"),
];

/// The file in which `benches/peers/build` says what it has compiled for.
const FLAGS: &str = "flags";

/// Programs of others for one arm: `pinocchio-ur5` and so on.
struct Peer {
    by: String,
    program: PathBuf,
    operations: BTreeMap<String, usize>,
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
            let counted = std::fs::read_to_string(program.with_extension("operations"));
            let counted = counted.unwrap_or_default();
            let line = |line: &str| {
                let (word, count) = line.split_once(' ')?;
                Some((word.to_owned(), count.trim().parse().ok()?))
            };
            Ok(Self {
                by: (*by).to_owned(),
                program,
                operations: counted.lines().filter_map(line).collect(),
                times: BTreeMap::new(),
            })
        });
        peers.collect()
    }

    /// Runs it once: it prints a line `quantity nanoseconds` for each of its rounds.
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
            operations: self.operations.get(word).copied(),
            time,
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
    measured.unit = measured.unit.min(further.unit);
    measured.busy = measured.busy.or(further.busy);
    measured.peers = match peers.map(|folder| folder.join(FLAGS)) {
        Some(file) => Some(
            std::fs::read_to_string(&file)
                .map_err(|_| fault(&file, "is not there: build it as its folder says"))?,
        ),
        None => None,
    };
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
    let mut candidates = candidates(&space, &states)?;
    let mut race = Race::new(&mut candidates, schedule.turn)?;
    for _ in 0..TURNS {
        for _ in 0..schedule.rounds.div_ceil(TURNS) {
            race.round()?;
        }
        for peer in &mut peers {
            peer.turn()?;
        }
    }
    let timings = race.timings()?;
    let mut rows = Vec::new();
    for (quantity, timing) in QUANTITIES.into_iter().zip(&timings) {
        let mut asked = M::JOINT_REPORT.asked.iter();
        let word = match quantity.1 {
            "linearise" => "derivatives",
            word => word,
        };
        let kernel = asked.find(|kernel| kernel.name == word);
        rows.push(Row {
            arm: name,
            quantity: quantity.0,
            by: String::new(),
            operations: kernel.map(|kernel| kernel.operations.total()),
            time: timing.time,
        });
        rows.extend(peers.iter().filter_map(|peer| peer.row(name, quantity)));
    }
    Ok(Measured {
        rows,
        unit: timings.last().map_or(f64::NAN, |timing| timing.time.least),
        busy: busy(&timings),
        peers: None,
    })
}

/// A state of these angles and rates, and numbers that are accelerations or torques.
struct Posed<M: JointCoordinates, const N: usize> {
    state: M::JointState<f64>,
    angles: [f64; N],
    rates: [f64; N],
    others: [f64; N],
}

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
        let [angles, rates, others] = std::array::from_fn(|_| std::array::from_fn(|_| draw()));
        states.push(Posed {
            state: space.state(angles, rates)?,
            angles,
            rates,
            others,
        });
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
    let of = |posed: &Posed<M, N>| space.state(posed.angles, posed.rates);
    Ok(vec![
        each("mass", states, |posed| space.mass(&posed.state)),
        each("mass, from angles", states, move |posed| {
            space.mass(&of(posed)?)
        }),
        each("inverse", states, |posed| {
            space.inverse(&posed.state, posed.others)
        }),
        each("inverse, from angles", states, move |posed| {
            space.inverse(&of(posed)?, posed.others)
        }),
        each("forward", states, |posed| {
            space.forward(&posed.state, posed.others)
        }),
        each("forward, from angles", states, move |posed| {
            space.forward(&of(posed)?, posed.others)
        }),
        each("linearise", states, |posed| {
            space.linearise(&posed.state, [], |_| [])
        }),
        each("linearise, from angles", states, move |posed| {
            space.linearise(&of(posed)?, [], |_| [])
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
            fixed(row.time.least / measured.unit, 1),
            fixed(row.time.least, 0),
            format!(
                "{} to {}",
                fixed(row.time.lower, 0),
                fixed(row.time.upper, 0)
            ),
        ]
    };
    let compiled = match &measured.peers {
        Some(flags) => format!(
            " Compiled for {}; programs of others for: {}.",
            Target::CURRENT,
            flags.trim()
        ),
        None => String::new(),
    };
    Table {
        caption: "Equations of motion in the angles of an arm".into(),
        columns: ["", "operations", "time (T)", "time (ns)", "quartiles (ns)"]
            .map(String::from)
            .into(),
        rows: measured.rows.iter().map(row).collect(),
        note: format!(
            "T = {} ns, the pendulum written by hand. Times are the least of all turns, by the clock of the thread's processor; states are drawn. From angles: their \
             sines and cosines are computed within the time; else they are given, as a run has them.{compiled}",
            fixed(measured.unit, 1)
        ),
    }
}

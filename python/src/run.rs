//! A run over an interval of time.

use std::fmt;
use std::sync::Arc;

use holonom::dynamics::{Problem, WithCoordinates};
use holonom::integrate::Tolerance;
use holonom::run::{RecordError, Simulate as _};
use holonom::state::Array as _;
use holonom::{
    Bdf, DormandPrince, Mechanism, Projection, Recorder, Rk4, RunError, RunReport, Runs, Sample,
    StandardLagrange, every,
};
use holonom_film::Film;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::Column;
use crate::described::{Kind, values};
use crate::exposed::{Exposed, Valued};
use crate::faults::{Trouble, sentences, warn, wrong};
use crate::object::Object;
use crate::results::{MakesPage, Recorded, Run};
use crate::start::Start;

/// Frames of a film a second, at most.
const FRAMES: f64 = 60.0;
/// Reports between two looks for an interruption.
const LOOK: usize = 64;

/// What is said of a run.
#[derive(Debug)]
pub struct Setting<'a, 'py> {
    /// From, to (s).
    pub interval: (f64, f64),
    /// The time between reports (s).
    pub every: f64,
    /// Positions by name.
    pub start: Option<&'a Bound<'py, PyAny>>,
    /// Rates by name.
    pub rates: Option<&'a Bound<'py, PyAny>>,
    /// Inputs by name: a number, or one for every period.
    pub inputs: Option<&'a Bound<'py, PyDict>>,
    /// The time (s) that a number of an input holds.
    pub period: Option<f64>,
    /// The method.
    pub method: &'a str,
    /// The relative tolerance.
    pub tolerance: Option<f64>,
    /// The step (s) of a method with fixed steps.
    pub step: Option<f64>,
    /// Whether loops are closed after every step.
    pub projection: bool,
    /// Whether reactions are recorded.
    pub reactions: bool,
    /// Whether a film is made.
    pub film: bool,
}

/// A method with what it needs.
#[derive(Clone, Copy, Debug)]
enum Method {
    DormandPrince(Option<f64>),
    Bdf(Option<f64>),
    Rk4(f64),
}

impl Method {
    fn of(setting: &Setting<'_, '_>) -> PyResult<Self> {
        let positive = |name: &str, number: Option<f64>| match number {
            Some(number) if !(number > 0.0 && number.is_finite()) => {
                Err(wrong(format!("{name} must be positive, not {number}")))
            }
            _ => Ok(number),
        };
        let tolerance = positive("tolerance", setting.tolerance)?;
        let step = positive("step", setting.step)?;
        let method = setting.method;
        let adaptive = |of: fn(Option<f64>) -> Self| match step {
            Some(_) => Err(wrong(format!(
                "{method} chooses its steps: give a tolerance"
            ))),
            None => Ok(of(tolerance)),
        };
        match method {
            "dormand_prince" => adaptive(Self::DormandPrince),
            "bdf" => adaptive(Self::Bdf),
            "rk4" => match (step, tolerance) {
                (Some(step), None) => Ok(Self::Rk4(step)),
                (_, Some(_)) => Err(wrong("rk4 has no tolerance: give a step")),
                (None, None) => Err(wrong("rk4 needs a step (s)")),
            },
            _ => Err(wrong(format!(
                "`{method}` is no method; there are: dormand_prince, bdf, rk4"
            ))),
        }
    }
}

/// Inputs over time, each a number or one for every period.
struct Table {
    inputs: Vec<(usize, Vec<f64>)>,
    period: f64,
}

impl Table {
    fn of<E: Exposed>(setting: &Setting<'_, '_>) -> PyResult<Self> {
        let (from, to) = setting.interval;
        let values = values::<E::Mechanism>();
        let mut inputs = Vec::new();
        for (name, numbers) in setting.inputs.into_iter().flatten() {
            let name: String = name.extract()?;
            let known = values.iter().find(|value| value.name == name);
            let known = known.filter(|value| value.kind == Kind::Input && !value.is_array);
            let known =
                known.ok_or_else(|| wrong(format!("`{name}` is no input with one number")))?;
            let column = Column::read(&name, &numbers)?;
            if column.leading.len() > 1 || column.numbers().is_empty() {
                return Err(wrong(format!("{name} must have shape () or (K,)")));
            }
            if column.leading.len() == 1 && setting.period.is_none() {
                return Err(wrong(format!(
                    "{name} has a number for every period: give `period` (s)"
                )));
            }
            inputs.push((known.places[0], column.numbers().to_vec()));
        }
        // One call at the start where nothing changes; what is no interval, the run refuses.
        let whole = 2.0 * (to - from);
        let whole = if whole > 0.0 && whole.is_finite() {
            whole
        } else {
            1.0
        };
        let period = setting.period.unwrap_or(whole);
        if !(period > 0.0 && period.is_finite()) {
            return Err(wrong(format!("period must be positive, not {period}")));
        }
        Ok(Self { inputs, period })
    }

    /// Puts the numbers of an instant; the last ones stay.
    fn put(&self, instant: usize, numbers: &mut [f64]) {
        for (place, table) in &self.inputs {
            numbers[*place] = table[instant.min(table.len() - 1)];
        }
    }
}

/// What an observer keeps of a run.
struct Keeping<M> {
    recorder: Recorder<std::io::Sink>,
    rows: Vec<f64>,
    film: Option<Film<M>>,
    next_frame: f64,
    reports: usize,
}

/// Why an observer ends a run.
enum Stop {
    Record(RecordError),
    Interrupted(PyErr),
}

impl fmt::Display for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Record(error) => fmt::Display::fmt(error, f),
            Self::Interrupted(error) => fmt::Display::fmt(error, f),
        }
    }
}

impl<M: Mechanism> Keeping<M> {
    fn new(setting: &Setting<'_, '_>) -> Self {
        let recorder = Recorder::new(std::io::sink());
        let mut film = setting.film.then(Film::new);
        if setting.reactions {
            film = film.map(Film::with_reactions);
        }
        Self {
            recorder: if setting.reactions {
                recorder.with_reactions()
            } else {
                recorder
            },
            rows: Vec::new(),
            film,
            next_frame: f64::NEG_INFINITY,
            reports: 0,
        }
    }

    fn keep<E: Exposed<Mechanism = M>>(&mut self, sample: &Sample<'_, f64, M>) -> Result<(), Stop> {
        self.reports += 1;
        if self.reports.is_multiple_of(LOOK) {
            Python::attach(|py| py.check_signals()).map_err(Stop::Interrupted)?;
        }
        let row = self.recorder.values(sample).map_err(Stop::Record)?;
        self.rows
            .extend(row.into_iter().map(|number| number.unwrap_or(f64::NAN)));
        let readings = E::read(sample);
        if let Some(film) = &mut self.film
            && sample.time() >= self.next_frame
        {
            // A little early, so that rounding leaves no frame out.
            self.next_frame = sample.time() + 0.99 / FRAMES;
            film.record(sample);
            for (reading, &value) in E::READINGS.iter().zip(&readings) {
                film.reading(reading.name, unit(reading.about), value);
            }
        }
        self.rows.extend(readings);
        Ok(())
    }

    /// The columns of what was kept.
    fn recorded<E: Exposed<Mechanism = M>>(&self) -> Vec<Recorded> {
        let names = self.recorder.columns::<M>();
        let names = names.iter().map(|name| {
            let (name, unit) = name.split_once(" [").unwrap_or((name, ""));
            (name.to_owned(), unit.trim_end_matches(']').to_owned())
        });
        let own = E::READINGS.iter();
        let own = own.map(|of| (of.name.to_owned(), unit(of.about).to_owned()));
        let names: Vec<(String, String)> = names.chain(own).collect();
        let width = names.len();
        let columns = names.into_iter().enumerate();
        let columns = columns.map(|(place, (name, unit))| Recorded {
            name,
            unit,
            numbers: self
                .rows
                .iter()
                .skip(place)
                .step_by(width)
                .copied()
                .collect(),
        });
        columns.collect()
    }
}

/// The unit in the parentheses of a text.
pub(crate) fn unit(about: &str) -> &str {
    let last = about.rsplit_once('(');
    last.map_or("", |(_, unit)| unit.trim_end_matches(')'))
}

/// How a run ended.
enum Outcome {
    Done(Vec<String>, [usize; 3]),
    Failed(Trouble),
    Stopped(Stop),
}

impl<E: Exposed> Object<E> {
    /// Runs over an interval of time.
    ///
    /// # Errors
    /// Settings that are not acceptable, faults, an interruption.
    pub fn simulate(&self, py: Python<'_>, setting: &Setting<'_, '_>) -> PyResult<Run> {
        let method = Method::of(setting)?;
        let table = Table::of::<E>(setting)?;
        let start = start_of::<E>(setting)?;
        let valued = self.valued();
        let mut keeping = Keeping::new(setting);
        let (interval, period, projected) = (setting.interval, setting.every, setting.projection);
        let outcome = py.detach(|| {
            let of = Running::<E> {
                valued: &valued,
                interval,
                every: period,
                is_projected: projected,
            };
            of.run(method, &start, &table, &mut keeping)
        });
        let recorded = keeping.recorded::<E>();
        let (warnings, counts) = match &outcome {
            Outcome::Done(warnings, counts) => (warnings.clone(), *counts),
            _ => (Vec::new(), [0; 3]),
        };
        let page: Option<MakesPage> = keeping
            .film
            .map(|film| Box::new(move || film.html().map_err(|error| error.to_string())) as _);
        let name = E::Mechanism::REPORT.name;
        let run = Run::new(py, name, recorded, (warnings, counts), page);
        match outcome {
            Outcome::Done(warnings, _) => {
                warn(py, &warnings)?;
                Ok(run)
            }
            Outcome::Failed(trouble) => {
                let run = Py::new(py, run)?.into_any();
                Err(trouble.raised(py, Some(run)))
            }
            Outcome::Stopped(Stop::Interrupted(error)) => Err(error),
            Outcome::Stopped(Stop::Record(RecordError::Evaluation(fault))) => {
                Err(Trouble::from(fault).raised(py, None))
            }
            Outcome::Stopped(Stop::Record(error)) => Err(wrong(error.to_string())),
        }
    }
}

/// A run without the interpreter.
struct Running<'a, E: Exposed> {
    valued: &'a Arc<Valued<E::Mechanism>>,
    interval: (f64, f64),
    every: f64,
    is_projected: bool,
}

/// The problem of a run.
type Posed<E> = WithCoordinates<
    Problem<<E as Exposed>::Mechanism, StandardLagrange>,
    <E as Exposed>::Coordinates,
>;

impl<E: Exposed> Running<'_, E> {
    fn run(
        &self,
        method: Method,
        start: &Start,
        table: &Table,
        keeping: &mut Keeping<E::Mechanism>,
    ) -> Outcome {
        let mechanism = &self.valued.mechanism;
        let tolerance = |relative: Option<f64>| match relative {
            Some(relative) => Tolerance::of(mechanism, relative),
            None => Ok(Tolerance::default()),
        };
        let outcome = match method {
            Method::DormandPrince(relative) => tolerance(relative)
                .map_err(Trouble::from)
                .map(|tolerance| self.by(DormandPrince::new(tolerance), start, table, keeping)),
            Method::Bdf(relative) => tolerance(relative)
                .map_err(Trouble::from)
                .map(|tolerance| self.by(Bdf::new(tolerance), start, table, keeping)),
            Method::Rk4(step) => Ok(self.by(Rk4::every(step), start, table, keeping)),
        };
        outcome.unwrap_or_else(Outcome::Failed)
    }

    fn by<I>(
        &self,
        method: I,
        start: &Start,
        table: &Table,
        keeping: &mut Keeping<E::Mechanism>,
    ) -> Outcome
    where
        I: holonom::integrate::Method<f64> + Runs<Posed<E>>,
    {
        let (from, to) = self.interval;
        let mut numbers = self.valued.numbers.clone();
        table.put(0, &mut numbers);
        let prepared = || {
            let parameters = self.valued.mechanism.parameters::<f64>()?;
            let bodies = E::begin(self.valued, from, start)?;
            Ok::<_, holonom::Fault>((parameters, bodies))
        };
        let (mut parameters, bodies) = match prepared() {
            Ok(prepared) => prepared,
            Err(fault) => return Outcome::Failed(fault.into()),
        };
        let mut simulation = (self.valued.mechanism)
            .simulation(StandardLagrange, method)
            .coordinates::<E::Coordinates>()
            .initial_state(bodies);
        if self.is_projected {
            simulation = simulation.projection(Projection::default());
        }
        let mut instant = 0;
        let all_inputs = values::<E::Mechanism>().into_iter();
        let all_inputs = all_inputs.filter(|value| value.kind == Kind::Input);
        let places: Vec<usize> = all_inputs.flat_map(|value| value.places).collect();
        let result = simulation
            .every_period(table.period, |_, inputs| {
                table.put(instant, &mut numbers);
                instant += 1;
                for &place in &places {
                    parameters.as_mut_slice()[place] = numbers[place];
                }
                *inputs = E::Mechanism::inputs_of(&parameters);
            })
            .run(from..=to, every(self.every), |sample| {
                keeping.keep::<E>(sample)
            });
        finished(result)
    }
}

fn finished<M: Mechanism>(
    result: Result<RunReport<f64, M>, RunError<M::State<f64>, Stop>>,
) -> Outcome {
    match result {
        Ok(report) => {
            let counts = [report.evaluations, report.accepted, report.rejected];
            Outcome::Done(sentences(&report.warnings()), counts)
        }
        Err(RunError::Simulation(error)) => Outcome::Failed(Trouble {
            time: Some(error.time),
            ..Trouble::from(error.fault)
        }),
        Err(RunError::Observer(stop)) => Outcome::Stopped(stop),
    }
}

/// Positions and rates, by a dictionary or as arrays in the order of the coordinates.
fn start_of<E: Exposed>(setting: &Setting<'_, '_>) -> PyResult<Start> {
    let names: Vec<String> = E::coordinates().into_iter().map(|(name, _)| name).collect();
    let read = |name: &str, given: Option<&Bound<'_, PyAny>>| -> PyResult<Vec<(String, f64)>> {
        let Some(given) = given else {
            return Ok(Vec::new());
        };
        let Ok(dict) = given.cast::<PyDict>() else {
            let column = Column::read(name, given)?;
            if column.leading != [names.len()] {
                return Err(wrong(format!(
                    "{name} must have shape ({},), of {}, or be a dictionary",
                    names.len(),
                    names.join(", ")
                )));
            }
            return Ok(names
                .iter()
                .cloned()
                .zip(column.numbers().iter().copied())
                .collect());
        };
        let mut found = Vec::new();
        for (key, number) in dict {
            let key: String = key.extract()?;
            if !names.contains(&key) {
                let names = names.join(", ");
                return Err(wrong(format!(
                    "{name}: `{key}` is none of the coordinates {names}"
                )));
            }
            let column = Column::read(&key, &number)?;
            if !column.leading.is_empty() {
                return Err(wrong(format!("{name}: `{key}` must be one number")));
            }
            found.push((key, column.at(0)));
        }
        Ok(found)
    };
    Ok(Start {
        positions: read("start", setting.start)?,
        rates: read("rates", setting.rates)?,
    })
}

//! Many runs at once, in lanes and on cores.

use std::array::from_fn;

use holonom::constraints::Scales;
use holonom::dynamics::{Problem, WithCoordinates};
use holonom::error::Fault;
use holonom::lanes::Ensemble;
use holonom::mechanism::Relative;
use holonom::state::Array as _;
use holonom::{Baumgarte, Mechanism, Rk4};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{Column, Rows, common, shape_text};
use crate::described::{Kind, values};
use crate::exposed::{Analysed, Exposed, SpaceOf, Valued};
use crate::faults::{Trouble, joint, warn, wrong};
use crate::object::Object;
use crate::results::{Rollouts, owned};
use crate::start::{Start, space};
use crate::threads;

/// Runs that are moved by one step: as many numbers as a register of AVX2 has.
const LANES: usize = 4;

/// What is said of rollouts.
#[derive(Debug)]
pub struct Many<'a, 'py> {
    /// From, to (s).
    pub interval: (f64, f64),
    /// The step (s).
    pub step: f64,
    /// Steps between reports.
    pub every: usize,
    /// Positions, shape (B, N) or (N,).
    pub start: Option<&'a Bound<'py, PyAny>>,
    /// Rates, likewise.
    pub rates: Option<&'a Bound<'py, PyAny>>,
    /// Inputs by name: shape (), (B,) or (B, S).
    pub inputs: Option<&'a Bound<'py, PyDict>>,
    /// Parameters by name: shape () or (B,).
    pub parameters: Option<&'a Bound<'py, PyDict>>,
    /// Whether limits are heeded, which refuses a mechanism that has some.
    pub limits: bool,
    /// How many threads, as many as there are cores where nothing is said.
    pub threads: Option<usize>,
}

/// A number by place: one for all, one for each run, or one for each run and step.
struct Varied {
    place: usize,
    column: Column,
}

impl Varied {
    fn at(&self, run: usize, step: usize) -> f64 {
        let numbers = self.column.numbers();
        match self.column.leading.as_slice() {
            [] => numbers[0],
            [_] => numbers[run],
            [runs, steps, ..] => numbers[if *runs == 1 { 0 } else { run * steps } + step],
        }
    }
}

/// All that runs need, as plain numbers.
struct Plan<E: Exposed> {
    valued: std::sync::Arc<Valued<E::Mechanism>>,
    names: Vec<String>,
    interval: (f64, f64),
    step: f64,
    steps: usize,
    every: usize,
    runs: usize,
    start: Option<Rows>,
    rates: Option<Rows>,
    inputs: Vec<Varied>,
    parameters: Vec<Varied>,
    heeds_limits: bool,
}

/// What some runs came to, run by run.
#[derive(Default)]
struct Part {
    q: Vec<f64>,
    v: Vec<f64>,
    readings: Vec<f64>,
    energy: Vec<f64>,
    violation: Vec<f64>,
    stopped: Vec<(usize, f64, Fault)>,
}

type Posed<E> = WithCoordinates<Problem<<E as Exposed>::Mechanism, Baumgarte<f64>>, Relative>;

/// How many steps of a size an interval has.
fn steps(interval: (f64, f64), step: f64) -> PyResult<usize> {
    let (from, to) = interval;
    if !(step > 0.0 && step.is_finite()) {
        return Err(wrong(format!("dt must be positive, not {step}")));
    }
    let count = (to - from) / step;
    let whole = count.round();
    if !((1.0..1e9).contains(&whole) && (count - whole).abs() < 1e-6 * whole) {
        return Err(wrong(format!(
            "from {from} s to {to} s there are {count} steps of {step} s: their number must be whole, and at least 1"
        )));
    }
    Ok(whole as usize)
}

fn varied<E: Exposed>(
    given: Option<&Bound<'_, PyDict>>,
    (kind, what): (Kind, &str),
    steps: usize,
) -> PyResult<Vec<Varied>> {
    let values = values::<E::Mechanism>();
    let mut found = Vec::new();
    for (name, numbers) in given.into_iter().flatten() {
        let name: String = name.extract()?;
        let known = values
            .iter()
            .find(|value| value.name == name && value.kind == kind);
        let known = known.filter(|value| !value.is_array);
        let known = known.ok_or_else(|| wrong(format!("`{name}` is no {what} with one number")))?;
        let column = Column::read(&name, &numbers)?;
        let is_right = match column.leading.as_slice() {
            [] | [_] => true,
            [_, of_steps] => kind == Kind::Input && *of_steps == steps,
            _ => false,
        };
        if !is_right {
            let steps = if kind == Kind::Input {
                format!(", (B,) or (B, {steps}), a number for each step")
            } else {
                " or (B,)".to_owned()
            };
            let shape = shape_text(&column.leading);
            return Err(wrong(format!(
                "{name} must have shape (){steps}; it has {shape}"
            )));
        }
        found.push(Varied {
            place: known.places[0],
            column,
        });
    }
    Ok(found)
}

impl<E: Exposed> Plan<E> {
    fn of(valued: std::sync::Arc<Valued<E::Mechanism>>, many: &Many<'_, '_>) -> PyResult<Self> {
        let names: Vec<String> = E::coordinates().into_iter().map(|(name, _)| name).collect();
        let steps = steps(many.interval, many.step)?;
        if many.every == 0 || steps % many.every != 0 {
            let every = many.every;
            return Err(wrong(format!(
                "every must divide the {steps} steps, and {every} does not"
            )));
        }
        let rows = |name, given: Option<&Bound<'_, PyAny>>| -> PyResult<Option<Rows>> {
            let rows = given
                .map(|given| Rows::read(name, given, &names))
                .transpose()?;
            match rows {
                Some(rows) if rows.leading.len() > 1 => {
                    let shape = shape_text(&rows.leading);
                    Err(wrong(format!("{name} has one axis of runs, not {shape}")))
                }
                rows => Ok(rows),
            }
        };
        let (start, rates) = (rows("start", many.start)?, rows("rates", many.rates)?);
        let inputs = varied::<E>(many.inputs, (Kind::Input, "input"), steps)?;
        let parameters = varied::<E>(many.parameters, (Kind::Parameter, "parameter"), steps)?;
        let columns = inputs.iter().chain(&parameters);
        let columns: Vec<Column> = columns.map(|of| of.column.clone().by_runs()).collect();
        let leading = common(start.iter().chain(&rates), &columns)?;
        Ok(Self {
            valued,
            names,
            interval: many.interval,
            step: many.step,
            steps,
            every: many.every,
            runs: leading.first().copied().unwrap_or(1),
            start,
            rates,
            inputs,
            parameters,
            heeds_limits: many.limits,
        })
    }

    fn reports(&self) -> usize {
        1 + self.steps / self.every
    }

    /// The mechanism of a run.
    fn mechanism(&self, run: usize) -> Result<Valued<E::Mechanism>, Fault> {
        let mut numbers = self.valued.numbers.clone();
        for of in &self.parameters {
            numbers[of.place] = of.at(run, 0);
        }
        Valued::of::<E>(numbers)
    }

    fn start(&self, run: usize) -> Start {
        let of = |rows: &Option<Rows>| match rows {
            Some(rows) => self
                .names
                .iter()
                .cloned()
                .zip(rows.row(run).iter().copied())
                .collect(),
            None => Vec::new(),
        };
        Start {
            positions: of(&self.start),
            rates: of(&self.rates),
        }
    }

    /// The inputs of a run over a step.
    fn inputs(
        &self,
        parameters: &mut <E::Mechanism as Mechanism>::Parameters<f64>,
        run: usize,
        step: usize,
    ) -> <E::Mechanism as Mechanism>::Inputs<f64> {
        for of in &self.inputs {
            parameters.as_mut_slice()[of.place] = of.at(run, step);
        }
        E::Mechanism::inputs_of(parameters)
    }

    /// The formulation: loops are kept closed at the rate that suits the mechanism and the step. A
    /// tree has no equations for it.
    fn formulation(&self) -> Result<Baumgarte<f64>, Fault> {
        if E::Mechanism::REPORT.equations == 0 {
            return Ok(Baumgarte::default());
        }
        let scales = Scales::of(&self.valued.mechanism)?;
        Ok(Baumgarte::with_scales(&scales).at_step(self.step))
    }
}

impl<E: Exposed> Plan<E> {
    /// As many runs as there are lanes, from one on.
    fn part<const N: usize>(
        &self,
        space: &SpaceOf<E, N>,
        formulation: Baumgarte<f64>,
        first: usize,
    ) -> Result<Part, Trouble>
    where
        E: Analysed<N>,
    {
        let run = |lane: usize| (first + lane).min(self.runs - 1);
        let mut mechanisms = Vec::with_capacity(LANES);
        let mut bodies = Vec::with_capacity(LANES);
        let mut parameters = Vec::with_capacity(LANES);
        for run in (0..LANES).map(run) {
            let at = |fault: Fault| Trouble {
                index: Some(run),
                ..Trouble::from(fault)
            };
            let valued = self.mechanism(run).map_err(at)?;
            bodies.push(E::begin(&valued, self.interval.0, &self.start(run)).map_err(at)?);
            let mut own = valued.mechanism.parameters::<f64>()?;
            valued.put(&mut own);
            parameters.push(own);
            mechanisms.push(valued.mechanism);
        }
        let known = |_| Trouble::from(holonom::error::StepFault::StateNotFinite);
        let mechanisms: [E::Mechanism; LANES] = mechanisms.try_into().map_err(|_| known(()))?;
        let bodies = bodies.try_into().map_err(|_| known(()))?;
        let ensemble = Ensemble::<Problem<E::Mechanism, Baumgarte<f64>>, Rk4, LANES>::new(
            &mechanisms,
            formulation,
            Rk4,
        )?;
        let mut ensemble: Ensemble<Posed<E>, Rk4, LANES> = ensemble.joint_coordinates();
        ensemble = ensemble.starting_at(self.interval.0);
        if !self.heeds_limits {
            ensemble = ensemble.without_limits();
        }
        let mut set = |ensemble: &mut Ensemble<Posed<E>, Rk4, LANES>, step: usize| {
            let inputs = from_fn(|lane| self.inputs(&mut parameters[lane], run(lane), step));
            ensemble.set_inputs(&inputs)
        };
        set(&mut ensemble, 0)?;
        ensemble.start(&bodies);
        let mut lanes: [Part; LANES] = from_fn(|_| Part::default());
        let is_by_step = self.inputs.iter().any(|of| of.column.leading.len() == 2);
        self.report(space, &ensemble, &mut lanes);
        for step in 0..self.steps {
            if is_by_step && step > 0 {
                set(&mut ensemble, step)?;
            }
            ensemble.step(self.step)?;
            if (step + 1) % self.every == 0 {
                self.report(space, &ensemble, &mut lanes);
            }
        }
        let mut part = Part::default();
        for (lane, own) in lanes.into_iter().enumerate().take(self.runs - first) {
            part.q.extend(own.q);
            part.v.extend(own.v);
            part.readings.extend(own.readings);
            part.energy.extend(own.energy);
            part.violation.extend(own.violation);
            if let Some(stopped) = &ensemble.stopped()[lane] {
                part.stopped
                    .push((first + lane, stopped.time, stopped.fault));
            }
        }
        Ok(part)
    }

    /// Reads all lanes; those that have stopped are NaN.
    fn report<const N: usize>(
        &self,
        space: &SpaceOf<E, N>,
        ensemble: &Ensemble<Posed<E>, Rk4, LANES>,
        lanes: &mut [Part; LANES],
    ) where
        E: Analysed<N>,
    {
        let states = ensemble.states();
        for (lane, part) in lanes.iter_mut().enumerate() {
            let none = f64::NAN;
            if ensemble.stopped()[lane].is_none() {
                // Coordinates have positions: the macro refuses what has none.
                let positions = space.positions(&states[lane]);
                part.q.extend(positions.map_or([none; N], Into::into));
                part.v.extend(space.rates(&states[lane]).iter());
            } else {
                part.q.extend([none; N]);
                part.v.extend([none; N]);
                part.readings.extend(E::READINGS.iter().map(|_| none));
                part.energy.push(none);
                part.violation.push(none);
            }
        }
        ensemble.each(|lane, view| {
            if let Some(part) = lanes.get_mut(lane) {
                part.readings.extend(E::read(&view));
                part.energy.push(view.energy());
                part.violation.push(view.violation());
            }
        });
    }
}

impl<E: Exposed> Object<E> {
    /// Runs of many at once.
    ///
    /// # Errors
    /// Shapes and settings that are not acceptable; a start or a parameter that is refused. A run
    /// that cannot go on is no error.
    pub fn rollouts<const N: usize>(
        &self,
        py: Python<'_>,
        many: &Many<'_, '_>,
    ) -> PyResult<Rollouts>
    where
        E: Analysed<N>,
    {
        let plan = Plan::<E>::of(self.valued(), many)?;
        let threads = many.threads;
        let parts = py.detach(|| -> Result<Vec<Part>, Trouble> {
            let pieces = plan.runs.div_ceil(LANES);
            let mut parts = Vec::new();
            parts.resize_with(pieces, Part::default);
            let worker = || -> Result<_, Trouble> {
                let space = space::<E, N>(&plan.valued, plan.interval.0)?;
                Ok((space, plan.formulation()?))
            };
            let work = |(space, formulation): &mut (SpaceOf<E, N>, Baumgarte<f64>),
                        piece: usize,
                        part: &mut Part| {
                *part = plan.part(space, *formulation, piece * LANES)?;
                Ok(())
            };
            threads::each(threads::count(threads, pieces), &mut parts, worker, work)?;
            Ok(parts)
        });
        let parts = parts.map_err(|trouble| trouble.raised(py, None))?;
        let (runs, reports, readings) = (plan.runs, plan.reports(), E::READINGS.len());
        let all = |of: fn(&Part) -> &Vec<f64>| -> Vec<f64> {
            parts
                .iter()
                .flat_map(|part| of(part).iter().copied())
                .collect()
        };
        let stopped: Vec<_> = parts.iter().flat_map(|part| &part.stopped).collect();
        if let Some((run, time, fault)) = stopped.first() {
            let count = stopped.len();
            let text = format!(
                "{count} of {runs} rollouts stopped, and are NaN from there on; the first is number {run}, at {time} s: {fault}"
            );
            warn(py, &[text])?;
        }
        let time = |report: usize| plan.interval.0 + (report * plan.every) as f64 * plan.step;
        let stopped = stopped.iter().map(|(run, time, fault)| {
            (
                *run,
                *time,
                joint(fault).map(str::to_owned),
                fault.to_string(),
            )
        });
        Ok(Rollouts {
            time: PyArray1::from_vec(py, (0..reports).map(time).collect()).unbind(),
            q: owned(py, all(|part| &part.q), &[runs, reports, N])?,
            v: owned(py, all(|part| &part.v), &[runs, reports, N])?,
            readings: owned(py, all(|part| &part.readings), &[runs, reports, readings])?,
            energy: owned(py, all(|part| &part.energy), &[runs, reports])?,
            violation: owned(py, all(|part| &part.violation), &[runs, reports])?,
            stopped: stopped.collect(),
            names: plan.names.clone(),
            read: E::READINGS
                .iter()
                .map(|reading| reading.name.to_owned())
                .collect(),
        })
    }
}

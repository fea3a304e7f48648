//! The cycles that reports tell, beside those that kernels take: what `study estimate` times.
//!
//! A call that waits reads a state of which every number waits for the call before, as the stages
//! of an integrator do. A processor's clock is that of a chain of fused multiply-adds, of four
//! cycles each on every x86-64 core of the last years; additions take two, three or four.

use std::hint::black_box;
use std::rc::Rc;

use holonom::dynamics::{Dynamics, Problem};
use holonom::integrate::{OneStep as _, System};
use holonom::mechanism::{
    Compliant, HasInverse, HasMassMatrix, Kernel, Plain, Stabilisation, Terms,
};
use holonom::state::{Array, Vector};
use holonom::{Fault, JointCoordinates, Mechanism, Rk4, Scalar as _, StandardLagrange};
use holonom_models::{
    Bricard, CartPole, FlyballGovernor, FourBar, HeavyTop, Panda, RodPendulum, SliderCrank,
    SqueezingMechanism, Ur5,
};
use holonom_study::StudyError;
use holonom_study::compare::measure::candidate;
use holonom_study::document::Table;
use holonom_study::format::fixed;
use holonom_study::statistics::Quartiles;
use holonom_study::target::Target;
use holonom_study::timing::{Candidate, Race, Schedule, busy};

/// States that are evaluated in turn.
const STATES: usize = 32;
/// The step between two of them (s): the squeezing mechanism is small and fast.
const STEP: f64 = 1e-5;
/// Cycles of a fused multiply-add that waits for the one before.
const FUSED: f64 = 4.0;
/// So many of them make a chain: looking at the clock takes no time beside it.
const CHAIN: u64 = 100_000;
/// What takes fewer operations is a part of its caller, and is left out.
const FEWEST: usize = 30;
/// Kernels of at least so many operations are told apart: a call costs little beside them.
const MANY: usize = 100;
/// An estimate within this part of what was measured is a good one.
const CLOSE: f64 = 0.2;

/// A kernel, and what can be timed of it.
#[derive(Debug)]
pub struct Estimated {
    /// The mechanism and the kernel.
    pub name: String,
    /// What the report tells.
    pub reported: Kernel,
    waiting: Candidate<'static>,
    independent: Candidate<'static>,
}

/// A kernel as it was measured.
#[derive(Clone, Debug)]
pub struct Row {
    /// The mechanism and the kernel.
    pub name: String,
    /// What the report tells.
    pub reported: Kernel,
    /// A call that waits for the one before (ns).
    pub waiting: Quartiles,
    /// A call that does not (ns).
    pub independent: Quartiles,
}

/// All rows, by their operations.
#[derive(Clone, Debug)]
pub struct Measured {
    /// The rows.
    pub rows: Vec<Row>,
    /// What a cycle takes (ns).
    pub cycle: f64,
    /// A sentence where the machine was not quiet.
    pub busy: Option<String>,
}

/// Times every kernel. `progress` is called with the rounds that are done.
///
/// # Errors
/// [`StudyError`] where a mechanism cannot be evaluated, or this build has no fused multiply-adds:
/// the estimate is of code with them.
pub fn measure(
    schedule: Schedule,
    mut progress: impl FnMut(usize),
) -> Result<Measured, StudyError> {
    if cfg!(not(target_feature = "fma")) {
        return Err(StudyError::Run {
            name: "the estimate".into(),
            reason: "it is of code with fused multiply-adds: build with RUSTFLAGS=\"-C target-cpu=native\""
                .into(),
        });
    }
    let (mut about, mut candidates) = (Vec::new(), vec![clock()]);
    for kernel in kernels()? {
        about.push((kernel.name, kernel.reported));
        candidates.extend([kernel.waiting, kernel.independent]);
    }
    let mut race = Race::new(&mut candidates, schedule.turn)?;
    for round in 0..schedule.rounds {
        race.round()?;
        progress(round + 1);
    }
    let timings = race.timings()?;
    let times = timings[1..].chunks(2).zip(about);
    let rows = times.map(|(times, (name, reported))| Row {
        name,
        reported,
        waiting: times[0].time,
        independent: times[1].time,
    });
    Ok(Measured {
        rows: rows.collect(),
        cycle: timings[0].time.least / FUSED,
        busy: busy(&timings),
    })
}

/// A chain of fused multiply-adds.
fn clock() -> Candidate<'static> {
    Candidate::new("clock", || {
        let (mut x, one) = (black_box(0.5), black_box(1.0));
        for _ in 0..CHAIN {
            x = f64::fused(x, one, one);
        }
        black_box(x);
        Ok(CHAIN)
    })
}

/// The kernels that are measured, by their operations.
///
/// # Errors
/// [`StudyError`] where a mechanism cannot be evaluated.
pub fn kernels() -> Result<Vec<Estimated>, StudyError> {
    let of = [
        ("pendulum", all::<RodPendulum> as fn() -> _),
        ("heavy top", all::<HeavyTop>),
        ("cart-pole", all::<CartPole>),
        ("four-bar", all::<FourBar>),
        ("slider-crank", all::<SliderCrank>),
        ("governor", all::<FlyballGovernor>),
        ("squeezer", all::<SqueezingMechanism>),
        ("Bricard", all::<Bricard>),
        ("UR5", all::<Ur5>),
        ("Panda", all::<Panda>),
    ];
    let mut kernels = Vec::new();
    for (mechanism, all) in of {
        let found: Result<Vec<Estimated>, Fault> = all();
        let found = found.map_err(|fault| StudyError::Run {
            name: mechanism.into(),
            reason: fault.to_string(),
        })?;
        kernels.extend(found.into_iter().map(|kernel| Estimated {
            name: format!("{mechanism}, {}", kernel.name),
            ..kernel
        }));
    }
    kernels.retain(|kernel| kernel.reported.operations.total() >= FEWEST);
    kernels.sort_by_key(|kernel| kernel.reported.operations.total());
    Ok(kernels)
}

/// What both descriptions of a mechanism have.
fn all<M: HasMassMatrix + HasInverse + Default>() -> Result<Vec<Estimated>, Fault> {
    let mut kernels = by_bodies::<M>()?;
    kernels.extend(by_joints::<M>()?);
    Ok(kernels)
}

/// Coefficients that are not zero.
const STABILISATION: Stabilisation<f64> = Stabilisation {
    rate: 20.0,
    position: 100.0,
    compliance: 1e-6,
};

/// States along a motion from its start.
fn states<Y: System<f64>>(system: &mut Y, mut state: Y::State) -> Result<Rc<[Y::State]>, Fault> {
    let mut states = Vec::with_capacity(STATES);
    for _ in 0..STATES {
        Rk4.step(system, 0.0, &mut state, STEP)?;
        states.push(state.clone());
    }
    Ok(states.into())
}

fn by_bodies<M: JointCoordinates + Default>() -> Result<Vec<Estimated>, Fault> {
    fn of<M: Mechanism + Default, T: Terms>(
        name: &str,
        states: &Rc<[M::State<f64>]>,
    ) -> Result<Option<Estimated>, Fault> {
        let constants = M::prepare(&M::default().parameters::<f64>()?);
        let coefficients = M::coefficients(&constants, &STABILISATION);
        let place = (states[0], M::Multipliers::<f64>::zeros());
        let reported = (M::REPORT.kernels, name);
        evaluation(reported, states, place, move |state, (rates, forces)| {
            let (constants, coefficients) = (&constants, &coefficients);
            M::evaluate_into::<f64, T>(constants, coefficients, 0.0, state, rates, forces)
        })
    }
    let dynamics = Dynamics::<Problem<M, _>>::new(&M::default(), StandardLagrange)?;
    let mut dynamics = dynamics.absolute_coordinates();
    let start = dynamics.initial_state()?;
    let states = states(&mut dynamics, start)?;
    let kernels = [
        of::<M, Plain>("evaluate standard", &states)?,
        of::<M, Compliant>("evaluate penalty", &states)?,
    ];
    Ok(named("bodies", kernels))
}

fn by_joints<M: HasMassMatrix + HasInverse + Default>() -> Result<Vec<Estimated>, Fault> {
    let dynamics = Dynamics::<Problem<M, _>>::new(&M::default(), StandardLagrange)?;
    let mut dynamics = dynamics.joint_coordinates();
    let start = dynamics.initial_state()?;
    let states = &states(&mut dynamics, start)?;
    // As long as the program lives, which measures and ends: every kernel reads them.
    let constants = &*Box::leak(Box::new(M::prepare_joints(&M::default().parameters()?)));
    let coefficients = M::joint_coefficients(constants, &STABILISATION, &Array::zeros());
    // Without equations that close a loop, there is no evaluation without multipliers.
    let kernel = if M::JOINT_REPORT.closing.is_empty() {
        "evaluate standard"
    } else {
        "rates standard"
    };
    let place = (states[0], ());
    let reported = (M::JOINT_REPORT.kernels, kernel);
    let rates = evaluation(reported, states, place, move |state, (rates, ())| {
        M::joint_rates_into::<f64, Plain>(constants, &coefficients, 0.0, state, rates)
    })?;
    // Accelerations, efforts and weights.
    let mut numbers = M::JointVelocities::<f64>::zeros();
    let places = numbers.as_mut_slice().iter_mut().enumerate();
    places.for_each(|(place, number)| *number = 0.1 * (place + 1) as f64);
    let mut weights = M::AdjointWeights::<f64>::zeros();
    let places = weights.as_mut_slice().iter_mut().enumerate();
    places.for_each(|(place, number)| *number = 0.1 * (place + 1) as f64);
    let asked = |name| (M::JOINT_REPORT.asked, name);
    let kernels = [
        rates,
        given(asked("mass"), states, |x| M::mass_matrix(constants, 0.0, x))?,
        given(asked("inverse"), states, move |x| {
            M::inverse_dynamics(constants, 0.0, x, black_box(&numbers))
        })?,
        given(asked("forward"), states, move |x| {
            M::forward_dynamics(constants, 0.0, x, black_box(&numbers))
        })?,
        given(asked("derivatives"), states, |x| {
            M::derivatives(constants, 0.0, x)
        })?,
        given(asked("adjoint"), states, move |x| {
            M::adjoint::<f64, Plain>(constants, &coefficients, 0.0, x, black_box(&weights))
        })?,
    ];
    Ok(named("joints", kernels))
}

fn named<const N: usize>(description: &str, kernels: [Option<Estimated>; N]) -> Vec<Estimated> {
    let kernels = kernels.into_iter().flatten();
    let named = kernels.map(|kernel| Estimated {
        name: format!("{description}, {}", kernel.name),
        ..kernel
    });
    named.collect()
}

/// What a report tells of a kernel; nothing of one that is not there or too short.
fn told((kernels, name): (&[Kernel], &str)) -> Option<Kernel> {
    let mut kernels = kernels.iter();
    let found = kernels.find(|kernel| kernel.name == name).copied();
    found.filter(|kernel| kernel.operations.total() >= FEWEST)
}

/// An evaluation, which writes the rates of a state, and what else there is.
fn evaluation<X: Vector<f64> + 'static, F: Clone + 'static, V: 'static>(
    reported: (&[Kernel], &str),
    states: &Rc<[X]>,
    place: (X, F),
    evaluate: impl Fn(&X, &mut (X, F)) -> V + Clone + 'static,
) -> Result<Option<Estimated>, Fault> {
    let Some(reported) = told(reported) else {
        return Ok(None);
    };
    let (own, work, mut written) = (states.clone(), evaluate.clone(), place.clone());
    let independent = candidate(STATES as u64, move || {
        for state in &*own {
            black_box(work(black_box(state), &mut written));
            black_box(&written);
        }
        Ok(())
    })?;
    let (own, mut written) = (states.clone(), place);
    let waiting = candidate(STATES as u64, move || {
        let nothing = black_box(0.0);
        for state in &*own {
            let at = state.zip(&written.0, |x, rate| rate.fused(nothing, x));
            black_box(evaluate(&at, &mut written));
        }
        black_box(&written);
        Ok(())
    })?;
    Ok(Some(Estimated {
        name: reported.name.into(),
        reported,
        waiting,
        independent,
    }))
}

/// A kernel that gives its numbers.
fn given<X: Vector<f64> + 'static, O: Array<f64> + 'static>(
    reported: (&[Kernel], &str),
    states: &Rc<[X]>,
    evaluate: impl Fn(&X) -> O + Clone + 'static,
) -> Result<Option<Estimated>, Fault> {
    let Some(reported) = told(reported) else {
        return Ok(None);
    };
    let (own, work) = (states.clone(), evaluate.clone());
    let independent = candidate(STATES as u64, move || {
        for state in &*own {
            let numbers = work(black_box(state));
            black_box(&numbers);
        }
        Ok(())
    })?;
    let own = states.clone();
    let waiting = candidate(STATES as u64, move || {
        let nothing = black_box(0.0);
        let mut numbers = evaluate(&own[0]);
        for state in &*own {
            let mut before = numbers.as_slice().iter().cycle();
            let next = |x: f64, _| before.next().map_or(x, |number| number.fused(nothing, x));
            let at = state.zip(state, next);
            numbers = evaluate(&at);
        }
        black_box(&numbers);
        Ok(())
    })?;
    Ok(Some(Estimated {
        name: reported.name.into(),
        reported,
        waiting,
        independent,
    }))
}

/// The rows as a table.
#[must_use]
pub fn table(measured: &Measured) -> Table {
    let cycle = measured.cycle;
    let ratio = |row: &Row| row.reported.cycles as f64 * cycle / row.waiting.least;
    let line = |row: &Row| {
        let Kernel {
            operations, cycles, ..
        } = row.reported;
        vec![
            row.name.clone(),
            operations.total().to_string(),
            operations.depth.to_string(),
            cycles.to_string(),
            fixed(row.waiting.least / cycle, 0),
            fixed(ratio(row), 2),
            fixed(row.waiting.least, 0),
            fixed(row.independent.least, 0),
        ]
    };
    let long = measured.rows.iter();
    let long = long.filter(|row| row.reported.operations.total() >= MANY);
    let close = |row: &&Row| (ratio(row) - 1.0).abs() <= CLOSE;
    let (all, close) = (long.clone().count(), long.filter(close).count());
    let columns = [
        "",
        "operations",
        "chain",
        "estimate",
        "cycles",
        "ratio",
        "ns",
        "apart",
    ];
    Table {
        caption: "Cycles of a call, as the report tells them and as they are".into(),
        columns: columns.map(String::from).into(),
        rows: measured.rows.iter().map(line).collect(),
        note: format!(
            "Of {all} kernels of at least {MANY} operations, the estimates of {close} are within {:.0} % of what was measured. Chain: the longest one of dependent \
             operations. Estimate: cycles, as the report tells them. Cycles and ns: a call that waits for the one before; apart: one that does not (ns). Times are \
             the least of all turns, by the clock of the thread's processor. A cycle takes {} ns: a chain of fused multiply-adds takes four each. Compiled for {}.",
            100.0 * CLOSE,
            fixed(cycle, 4),
            Target::CURRENT
        ),
    }
}

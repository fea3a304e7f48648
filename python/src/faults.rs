//! Faults as exceptions, warnings of a run as Python's.

use std::ffi::CString;

use holonom::Warnings;
use holonom::error::{
    AnalysisFault, AssemblyFault, Fault, ModeFault, ParameterFault, ReadingFault, StartFault,
    StepFault,
};
use pyo3::exceptions::{PyRuntimeError, PyUserWarning, PyValueError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyType;

static FAULT: PyOnceLock<Py<PyType>> = PyOnceLock::new();
static WARNING: PyOnceLock<Py<PyType>> = PyOnceLock::new();

/// Why something could not be done: when, and where in a batch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Trouble {
    pub(crate) fault: Fault,
    /// The time of the last good state (s).
    pub(crate) time: Option<f64>,
    /// The place in a batch, counted over all its axes.
    pub(crate) index: Option<usize>,
}

impl<F: Into<Fault>> From<F> for Trouble {
    fn from(fault: F) -> Self {
        Self {
            fault: fault.into(),
            time: None,
            index: None,
        }
    }
}

fn class<'py>(
    py: Python<'py>,
    of: &PyOnceLock<Py<PyType>>,
    (name, about): (&str, &str),
    base: Bound<'py, PyType>,
) -> PyResult<Bound<'py, PyType>> {
    let class = of.get_or_try_init(py, || {
        let [name, about] = [name, about].map(|text| CString::new(text).unwrap_or_default());
        PyErr::new_type(py, &name, Some(&about), Some(&base), None)
    })?;
    Ok(class.bind(py).clone())
}

/// The class of exceptions.
pub(crate) fn fault_class(py: Python<'_>) -> PyResult<Bound<'_, PyType>> {
    let about = "A mechanism cannot do what it was asked for.\n\n\
        Attributes: time (s) of the last good state, joint (the field), index (the place in a batch, \
        counted over all its axes), run (what was recorded before); None where there is none.";
    let base = py.get_type::<PyRuntimeError>();
    class(py, &FAULT, ("holonom.Fault", about), base)
}

/// The class of warnings.
pub(crate) fn warning_class(py: Python<'_>) -> PyResult<Bound<'_, PyType>> {
    let about = "A reason not to trust the result of a run as it is.";
    let base = py.get_type::<PyUserWarning>();
    class(py, &WARNING, ("holonom.RunWarning", about), base)
}

impl Trouble {
    /// As an exception, with what was recorded before.
    pub(crate) fn raised(&self, py: Python<'_>, run: Option<Py<PyAny>>) -> PyErr {
        let made = || -> PyResult<Bound<'_, PyAny>> {
            let mut text = String::new();
            if let Some(index) = self.index {
                text.push_str(&format!("[{index}] "));
            }
            if let Some(time) = self.time {
                text.push_str(&format!("at {time} s: "));
            }
            text.push_str(&said(&self.fault));
            let exception = fault_class(py)?.call1((text,))?;
            exception.setattr("time", self.time)?;
            exception.setattr("joint", joint(&self.fault))?;
            exception.setattr("index", self.index)?;
            exception.setattr("run", run)?;
            Ok(exception)
        };
        made().map_or_else(|error| error, PyErr::from_value)
    }
}

/// What a fault says, in the words of Python.
fn said(fault: &Fault) -> String {
    let text = fault.to_string();
    match fault {
        Fault::Start(StartFault::LimitsLeftOut { .. }) => {
            text.replace(".without_limits()", "limits=False")
        }
        _ => text,
    }
}

/// A wrong argument.
pub(crate) fn wrong(text: impl Into<String>) -> PyErr {
    PyValueError::new_err(text.into())
}

/// Raises the warnings of a run, each where the user's program called.
pub(crate) fn warn(py: Python<'_>, texts: &[String]) -> PyResult<()> {
    let class = warning_class(py)?;
    for text in texts {
        let text = CString::new(text.as_str()).unwrap_or_default();
        PyErr::warn(py, class.as_any(), &text, 1)?;
    }
    Ok(())
}

/// Warnings as sentences.
pub(crate) fn sentences(warnings: &Warnings) -> Vec<String> {
    warnings.into_iter().map(|one| one.to_string()).collect()
}

/// The joint that a fault is about; the field of a parameter where there is no joint.
pub(crate) fn joint(fault: &Fault) -> Option<&'static str> {
    match fault {
        Fault::Step(fault) => of_step(fault),
        Fault::Start(fault) => of_start(fault),
        Fault::Mode(fault) => of_mode(fault),
        Fault::Assembly(fault) => of_assembly(fault),
        Fault::Reading(fault) => of_reading(fault),
        Fault::Analysis(fault) => of_analysis(fault),
        Fault::Parameter(error) => match error.fault {
            ParameterFault::NotAssembled { joint, .. }
            | ParameterFault::Dependent { joint, .. }
            | ParameterFault::Independent { joint, .. } => Some(joint),
            _ => Some(error.field),
        },
        _ => None,
    }
}

fn of_start(fault: &StartFault) -> Option<&'static str> {
    match *fault {
        StartFault::InteractionSetting { joint, .. }
        | StartFault::MisplacedSetting { joint, .. }
        | StartFault::LimitsLeftOut { joint, .. }
        | StartFault::Inconsistent { joint, .. }
        | StartFault::DirectionOpens { joint, .. } => Some(joint),
        _ => None,
    }
}

fn of_mode(fault: &ModeFault) -> Option<&'static str> {
    match *fault {
        ModeFault::NoMode { joint, .. }
        | ModeFault::Endless { joint, .. }
        | ModeFault::DrivenAgainst { joint, .. }
        | ModeFault::NoUniqueFriction { joint, .. }
        | ModeFault::CapacityFactor { joint, .. }
        | ModeFault::LoadNotUnique { joint, .. } => Some(joint),
        _ => None,
    }
}

fn of_assembly(fault: &AssemblyFault) -> Option<&'static str> {
    match *fault {
        AssemblyFault::CarriesNothing { joint, .. }
        | AssemblyFault::NotFree { joint, .. }
        | AssemblyFault::WrongSide { joint, .. }
        | AssemblyFault::BeyondLimit { joint, .. } => Some(joint),
        AssemblyFault::WayEnds { joint, .. } => joint,
        _ => None,
    }
}

fn of_reading(fault: &ReadingFault) -> Option<&'static str> {
    match *fault {
        ReadingFault::NoSuchPlace { joint, .. }
        | ReadingFault::NoEffort { joint, .. }
        | ReadingFault::NoSuchLimits { joint, .. } => Some(joint),
        _ => None,
    }
}

fn of_step(fault: &StepFault) -> Option<&'static str> {
    match *fault {
        StepFault::Singular { name, .. } => Some(name),
        StepFault::HandlerOpens { joint, .. } => Some(joint),
        StepFault::NotConverged { joint, .. }
        | StepFault::SizeUnderflow { joint, .. }
        | StepFault::NotSolved { joint, .. }
        | StepFault::Budget { joint, .. } => joint,
        _ => None,
    }
}

fn of_analysis(fault: &AnalysisFault) -> Option<&'static str> {
    match *fault {
        AnalysisFault::ChosenTwice { joint }
        | AnalysisFault::SeveralMotions { joint, .. }
        | AnalysisFault::Carried { joint, .. }
        | AnalysisFault::NotDetermined { joint }
        | AnalysisFault::NotIndependent { joint }
        | AnalysisFault::NoPosition { joint }
        | AnalysisFault::NotSteady { joint }
        | AnalysisFault::NotChosen { joint }
        | AnalysisFault::NotAssembled { joint, .. } => Some(joint),
        AnalysisFault::Jump { joint, .. } => joint,
        _ => None,
    }
}

//! What is added to a module: classes with their names and documentation, exceptions, stubs.

use holonom::{JointCoordinates, Mechanism};
use pyo3::exceptions::PyImportError;
use pyo3::prelude::*;
use pyo3::types::{PyCFunction, PyModule, PyTuple, PyType};

use crate::described::{Kind, coordinates, names_of, values};
use crate::exposed::Exposed;
use crate::faults::{fault_class, warning_class};
use crate::results::{Linearised, Rollouts, Run};
use crate::stubs::{self, Described};

/// The names of the coordinates of a class, and their units.
#[must_use]
pub fn coordinate_names<E: Exposed<Mechanism: JointCoordinates>>() -> Vec<(String, &'static str)> {
    let coordinates = coordinates::<E>().into_iter();
    coordinates.map(|of| (of.name.clone(), of.unit())).collect()
}

/// The joints that carry a body and have an angle or a displacement, and their units: what the
/// start of a class without coordinates is said by.
#[must_use]
pub fn joint_names<E: Exposed>() -> Vec<(String, &'static str)> {
    let report = &E::Mechanism::REPORT;
    let joints = report.joints.iter().enumerate();
    let carry = joints.filter(|(place, joint)| {
        let mut carriers = report.carriers.iter();
        // What has both is set by neither name.
        (joint.has_angle != joint.has_displacement)
            && carriers.any(|carrier| carrier.joint == Some(*place))
    });
    carry
        .map(|(_, joint)| {
            (
                joint.name.to_owned(),
                if joint.has_angle { "rad" } else { "m" },
            )
        })
        .collect()
}

/// Adds what every module has.
///
/// # Errors
/// None but those of Python.
pub fn begin(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    module.add("Fault", fault_class(py)?)?;
    module.add("RunWarning", warning_class(py)?)?;
    module.add_class::<Run>()?;
    module.add_class::<Rollouts>()?;
    module.add_class::<Linearised>()
}

/// Adds a class, and returns its part of the stubs.
///
/// # Errors
/// A field with the name of a method.
pub fn register<E: Exposed>(
    module: &Bound<'_, PyModule>,
    class: &Bound<'_, PyType>,
    is_analysed: bool,
) -> PyResult<String> {
    let py = module.py();
    let described = Described::of::<E>(is_analysed);
    class.setattr("__doc__", described.documentation())?;
    class.setattr("__module__", module.name()?)?;
    for value in values::<E::Mechanism>() {
        if class.hasattr(value.name)? {
            let (class, name) = (E::Mechanism::REPORT.name, value.name);
            return Err(PyImportError::new_err(format!(
                "the field `{name}` of {class} has the name of a method of its class: give it another one"
            )));
        }
    }
    let report = &E::Mechanism::REPORT;
    let owned = |names: Vec<&'static str>| names.into_iter().map(str::to_owned).collect();
    let lists: [(&str, Vec<String>); 7] = [
        (
            "coordinates",
            E::coordinates().into_iter().map(|(name, _)| name).collect(),
        ),
        (
            "parameters",
            owned(names_of::<E::Mechanism>(Kind::Parameter)),
        ),
        ("inputs", owned(names_of::<E::Mechanism>(Kind::Input))),
        ("states", owned(names_of::<E::Mechanism>(Kind::Start))),
        (
            "readings",
            owned(E::READINGS.iter().map(|reading| reading.name).collect()),
        ),
        (
            "bodies",
            owned(report.bodies.iter().map(|body| body.name).collect()),
        ),
        (
            "points",
            owned(report.points.iter().map(|point| point.name).collect()),
        ),
    ];
    for (name, list) in lists {
        class.setattr(name, PyTuple::new(py, list)?)?;
    }
    module.add(report.name, class)?;
    Ok(described.stub())
}

/// Adds `stubs()`.
///
/// # Errors
/// None but those of Python.
pub fn end(module: &Bound<'_, PyModule>, classes: Vec<String>) -> PyResult<()> {
    let text = stubs::module(&classes);
    let name = c"stubs";
    let about = c"stubs() -> str\n--\n\nThe text of the module's .pyi file.";
    let stubs = PyCFunction::new_closure(module.py(), Some(name), Some(about), move |_, _| {
        text.clone()
    })?;
    module.add("stubs", stubs)
}

//! An object of a class: its values by name, and the methods of its equations of motion.

use std::sync::{Arc, Mutex, PoisonError};

use holonom::state::Array as _;
use holonom::{JointCoordinates, Mechanism};
use numpy::PyArrayDyn;
use pyo3::exceptions::{PyAttributeError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};

use crate::arrays::{Column, Rows, array};
use crate::batch::{At, Batch, fixed, inputs_of};
use crate::described::{Kind, Value, names_of, values};
use crate::exposed::{Analysed, Exposed, Matrices, Valued};
use crate::faults::{Trouble, wrong};
use crate::results::Linearised;

/// An object of a class.
#[derive(Debug)]
pub struct Object<E: Exposed> {
    valued: Mutex<Arc<Valued<E::Mechanism>>>,
}

impl<E: Exposed> Object<E> {
    /// An object by keyword arguments: the parameters, and inputs and starts of states, which have
    /// defaults.
    ///
    /// # Errors
    /// A keyword that is none of these, a parameter that is missing or not acceptable.
    pub fn new(py: Python<'_>, keywords: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let (mut numbers, is_typical) = defaults::<E>().map_err(|of| of.raised(py, None))?;
        let mut missing: Vec<&str> = if is_typical {
            Vec::new()
        } else {
            names_of::<E::Mechanism>(Kind::Parameter)
        };
        for (name, given) in keywords.into_iter().flatten() {
            let name: String = name.extract()?;
            let value =
                value_of::<E>(&name).ok_or_else(|| PyTypeError::new_err(unknown::<E>(&name)))?;
            put(&mut numbers, &value, &given)?;
            missing.retain(|of| *of != value.name);
        }
        if !missing.is_empty() {
            let name = E::Mechanism::REPORT.name;
            let missing = missing.join(", ");
            return Err(PyTypeError::new_err(format!(
                "{name} needs the parameters {missing}"
            )));
        }
        let valued =
            Valued::of::<E>(numbers).map_err(|fault| Trouble::from(fault).raised(py, None))?;
        let valued = Mutex::new(Arc::new(valued));
        Ok(Self { valued })
    }

    /// The numbers as they are now. They stay what they are for those who have taken them.
    pub(crate) fn valued(&self) -> Arc<Valued<E::Mechanism>> {
        self.valued
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .clone()
    }

    /// A value by its name.
    ///
    /// # Errors
    /// A name of none.
    pub fn get<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let Some(value) = value_of::<E>(name) else {
            let class = E::Mechanism::REPORT.name;
            let text = format!("`{class}` has no attribute `{name}`");
            return Err(PyAttributeError::new_err(text));
        };
        let valued = self.valued();
        let numbers: Vec<f64> = value
            .places
            .iter()
            .map(|&place| valued.numbers[place])
            .collect();
        match numbers.as_slice() {
            [one] if !value.is_array => Ok(one.into_pyobject(py)?.into_any()),
            _ => {
                let count = numbers.len();
                let array = array(py, numbers, &[count])?;
                // A copy: to write into it would change nothing.
                array.call_method1("setflags", (false,))?;
                Ok(array.into_any())
            }
        }
    }

    /// Sets a value by its name. What is not acceptable leaves all as it was.
    ///
    /// # Errors
    /// A name of none, a number that is not acceptable.
    pub fn set(&self, py: Python<'_>, name: &str, given: &Bound<'_, PyAny>) -> PyResult<()> {
        let value = value_of::<E>(name);
        let value = value.ok_or_else(|| PyAttributeError::new_err(unknown::<E>(name)))?;
        let mut numbers = self.valued().numbers.clone();
        put(&mut numbers, &value, given)?;
        let valued =
            Valued::of::<E>(numbers).map_err(|fault| Trouble::from(fault).raised(py, None))?;
        *self.valued.lock().unwrap_or_else(PoisonError::into_inner) = Arc::new(valued);
        Ok(())
    }

    /// The values by name, for a copy in another process.
    ///
    /// # Errors
    /// None but those of Python.
    pub fn dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        for value in values::<E::Mechanism>() {
            dict.set_item(value.name, self.get(py, value.name)?)?;
        }
        Ok(dict)
    }

    /// As it is written.
    ///
    /// # Errors
    /// None but those of Python.
    pub fn repr(&self, py: Python<'_>) -> PyResult<String> {
        let mut texts = Vec::new();
        for value in values::<E::Mechanism>() {
            let shown = self.get(py, value.name)?;
            let shown: Bound<'_, PyString> = if value.is_array {
                shown.call_method0("tolist")?.repr()?
            } else {
                shown.repr()?
            };
            texts.push(format!("{}={shown}", value.name));
        }
        Ok(format!(
            "{}({})",
            E::Mechanism::REPORT.name,
            texts.join(", ")
        ))
    }
}

/// The default numbers, and whether there are typical parameters among them. NaN stands for what
/// the mechanism has by itself.
fn defaults<E: Exposed>() -> Result<(Vec<f64>, bool), Trouble> {
    if let Some(mechanism) = E::typical() {
        let parameters = mechanism.parameters::<f64>()?;
        return Ok((parameters.as_slice().to_vec(), true));
    }
    let numbers = <E::Mechanism as Mechanism>::Parameters::<f64>::zeros();
    Ok((vec![f64::NAN; numbers.as_slice().len()], false))
}

fn value_of<E: Exposed>(name: &str) -> Option<Value> {
    values::<E::Mechanism>()
        .into_iter()
        .find(|value| value.name == name)
}

fn unknown<E: Exposed>(name: &str) -> String {
    let names: Vec<&str> = values::<E::Mechanism>()
        .iter()
        .map(|value| value.name)
        .collect();
    let class = E::Mechanism::REPORT.name;
    format!(
        "`{name}` is no value of {class}; there are: {}",
        names.join(", ")
    )
}

/// Puts numbers in the places of a value.
fn put(numbers: &mut [f64], value: &Value, given: &Bound<'_, PyAny>) -> PyResult<()> {
    let column = Column::read(value.name, given)?;
    let expected: &[usize] = if value.is_array {
        &[value.places.len()]
    } else {
        &[]
    };
    if column.leading != expected {
        return Err(wrong(format!(
            "{} must have shape {}, not {}",
            value.name,
            crate::arrays::shape_text(expected),
            crate::arrays::shape_text(&column.leading)
        )));
    }
    for (&place, &number) in value.places.iter().zip(column.numbers()) {
        numbers[place] = number;
    }
    Ok(())
}

/// What the methods of the equations of motion are given besides states.
#[derive(Debug)]
pub struct Given<'a, 'py> {
    /// Inputs by name; those of the object where nothing is said.
    pub inputs: Option<&'a Bound<'py, PyDict>>,
    /// The time (s).
    pub time: f64,
}

fn names<E: Exposed>() -> Vec<String> {
    E::coordinates().into_iter().map(|(name, _)| name).collect()
}

/// Arrays of coordinates and of what is wanted beside them, with zeros for those that were left
/// out.
fn rows<E: Exposed>(given: &[(&'static str, Option<&Bound<'_, PyAny>>)]) -> PyResult<Vec<Rows>> {
    let names = names::<E>();
    let each = given.iter().map(|(name, numbers)| match numbers {
        Some(numbers) => Rows::read(name, numbers, &names),
        None => Ok(Rows::zeros(name, names.len())),
    });
    each.collect()
}

fn time(given: f64) -> PyResult<f64> {
    if given.is_finite() {
        Ok(given)
    } else {
        Err(wrong(format!("time must be finite, not {given}")))
    }
}

/// An array of a method.
pub type Array<'py> = Bound<'py, PyArrayDyn<f64>>;

impl<E: Exposed> Object<E> {
    fn batch<'py, const N: usize, const R: usize>(
        &self,
        py: Python<'py>,
        rows: &[Rows],
        given: &Given<'_, '_>,
        shapes: [&[usize]; R],
        compute: impl Fn(
            &crate::exposed::SpaceOf<E, N>,
            &crate::batch::StateOf<E>,
            &[&[f64]],
        ) -> Result<[Vec<f64>; R], holonom::Fault>
        + Sync
        + Send,
    ) -> PyResult<[Array<'py>; R]>
    where
        E: Analysed<N>,
    {
        let inputs = inputs_of::<E>(given.inputs)?;
        let time = time(given.time)?;
        let batch = Batch {
            rows,
            inputs: &inputs,
            time,
        };
        batch.results::<E, N, R>(py, &self.valued(), shapes, compute)
    }

    /// Accelerations.
    ///
    /// # Errors
    /// Shapes, numbers that are not finite, faults.
    pub fn forward_dynamics<'py, const N: usize>(
        &self,
        py: Python<'py>,
        [q, v, tau]: [Option<&Bound<'py, PyAny>>; 3],
        given: &Given<'_, '_>,
    ) -> PyResult<Array<'py>>
    where
        E: Analysed<N>,
    {
        let rows = rows::<E>(&[("q", q), ("v", v), ("tau", tau)])?;
        let [found] = self.batch::<N, 1>(py, &rows, given, [&[N]], |space, state, rows| {
            let found = space.forward(state, fixed::<N>(rows[2]))?;
            Ok([found.as_slice().to_vec()])
        })?;
        Ok(found)
    }

    /// Efforts.
    ///
    /// # Errors
    /// Shapes, numbers that are not finite, faults.
    pub fn inverse_dynamics<'py, const N: usize>(
        &self,
        py: Python<'py>,
        [q, v, a]: [Option<&Bound<'py, PyAny>>; 3],
        given: &Given<'_, '_>,
    ) -> PyResult<Array<'py>>
    where
        E: Analysed<N>,
    {
        let rows = rows::<E>(&[("q", q), ("v", v), ("a", a)])?;
        let [found] = self.batch::<N, 1>(py, &rows, given, [&[N]], |space, state, rows| {
            let found = space.inverse(state, fixed::<N>(rows[2]))?;
            Ok([found.as_slice().to_vec()])
        })?;
        Ok(found)
    }

    /// Mass matrices.
    ///
    /// # Errors
    /// Shapes, numbers that are not finite, faults.
    pub fn mass_matrix<'py, const N: usize>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        given: &Given<'_, '_>,
    ) -> PyResult<Array<'py>>
    where
        E: Analysed<N>,
    {
        let rows = rows::<E>(&[("q", Some(q)), ("v", None)])?;
        let [found] = self.batch::<N, 1>(py, &rows, given, [&[N, N]], |space, state, _| {
            // It is symmetric.
            Ok([space.mass(state)?.as_slice().to_vec()])
        })?;
        Ok(found)
    }

    /// Jacobians of a body's centre of mass or of a named point.
    ///
    /// # Errors
    /// Shapes, numbers that are not finite, faults.
    pub fn jacobian<'py, const N: usize>(
        &self,
        py: Python<'py>,
        at: &str,
        q: &Bound<'py, PyAny>,
        given: &Given<'_, '_>,
    ) -> PyResult<Array<'py>>
    where
        E: Analysed<N>,
    {
        let at = At::of::<E>(at)?;
        let rows = rows::<E>(&[("q", Some(q)), ("v", None)])?;
        let [found] = self.batch::<N, 1>(py, &rows, given, [&[6, N]], |space, state, _| {
            Ok([at.jacobian::<E, N>(space, state)?])
        })?;
        Ok(found)
    }

    /// Linear models.
    ///
    /// # Errors
    /// Shapes, numbers that are not finite, faults.
    pub fn linearised<'py, const N: usize>(
        &self,
        py: Python<'py>,
        [q, v]: [Option<&Bound<'py, PyAny>>; 2],
        given: &Given<'_, '_>,
    ) -> PyResult<Linearised>
    where
        E: Analysed<N>,
        E::Mechanism: JointCoordinates,
    {
        let rows = rows::<E>(&[("q", q), ("v", v)])?;
        let k = crate::described::inputs(&E::Mechanism::REPORT);
        let p = E::READINGS.len();
        let shapes: [&[usize]; 4] = [&[2 * N, 2 * N], &[2 * N, k], &[p, 2 * N], &[p, k]];
        let found = self.batch::<N, 4>(py, &rows, given, shapes, |space, state, _| {
            let Matrices(matrices) = E::linearise(space, state)?;
            Ok(matrices)
        })?;
        let names = names::<E>();
        let rates = names.iter().map(|name| format!("{name}_rate"));
        let inputs = E::Mechanism::REPORT
            .values
            .iter()
            .filter(|value| value.is_input);
        Ok(Linearised {
            matrices: found.map(Bound::unbind),
            states: names.iter().cloned().chain(rates).collect(),
            inputs: inputs.map(|value| value.name.to_owned()).collect(),
            outputs: E::READINGS
                .iter()
                .map(|reading| reading.name.to_owned())
                .collect(),
        })
    }
}

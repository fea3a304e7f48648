//! Arrays as they come in and go out: shapes, and numbers that are finite.

use numpy::{
    PyArray1, PyArrayDyn, PyArrayMethods as _, PyReadonlyArrayDyn, PyUntypedArrayMethods as _,
};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::faults::wrong;

/// Rows of numbers under leading axes.
#[derive(Clone, Debug)]
pub(crate) struct Rows {
    name: &'static str,
    pub(crate) leading: Vec<usize>,
    numbers: Vec<f64>,
    width: usize,
}

/// Any numbers as an array of `float64`, with its shape.
fn floats(name: &str, numbers: &Bound<'_, PyAny>) -> PyResult<(Vec<usize>, Vec<f64>)> {
    let py = numbers.py();
    // Not from complex numbers, or from objects.
    let keywords = PyDict::new(py);
    keywords.set_item("casting", "same_kind")?;
    let array = py.import("numpy")?.call_method1("asarray", (numbers,));
    let array = array.and_then(|array| array.call_method("astype", ("float64",), Some(&keywords)));
    let array = array.map_err(|error| wrong(format!("{name}: {}", error.value(py))))?;
    let array: PyReadonlyArrayDyn<'_, f64> = array.extract()?;
    let numbers: Vec<f64> = array.as_array().iter().copied().collect();
    if let Some(place) = numbers.iter().position(|number| !number.is_finite()) {
        return Err(wrong(format!(
            "{name} has a number that is not finite, {}, at place {place}",
            numbers[place]
        )));
    }
    Ok((array.shape().to_vec(), numbers))
}

/// A shape as Python writes it.
pub(crate) fn shape_text(shape: &[usize]) -> String {
    let sizes: Vec<String> = shape.iter().map(usize::to_string).collect();
    match sizes.as_slice() {
        [one] => format!("({one},)"),
        several => format!("({})", several.join(", ")),
    }
}

impl Rows {
    /// Rows of as many numbers as there are names, in their order.
    pub(crate) fn read(
        name: &'static str,
        numbers: &Bound<'_, PyAny>,
        names: &[String],
    ) -> PyResult<Self> {
        let (mut shape, numbers) = floats(name, numbers)?;
        let (given, width) = (shape.clone(), names.len());
        if shape.pop() != Some(width) {
            return Err(wrong(format!(
                "{name} must have shape (..., {width}), with a last axis of {}; it has {}",
                names.join(", "),
                shape_text(&given)
            )));
        }
        Ok(Self {
            name,
            leading: shape,
            numbers,
            width,
        })
    }

    /// The same row for all.
    pub(crate) fn zeros(name: &'static str, width: usize) -> Self {
        Self {
            name,
            leading: Vec::new(),
            numbers: vec![0.0; width],
            width,
        }
    }

    /// The row at a place; the one that is there for all.
    pub(crate) fn row(&self, place: usize) -> &[f64] {
        let place = if self.leading.is_empty() { 0 } else { place };
        &self.numbers[place * self.width..(place + 1) * self.width]
    }
}

/// One number, or one for every place of a batch.
#[derive(Clone, Debug)]
pub(crate) struct Column {
    name: String,
    pub(crate) leading: Vec<usize>,
    numbers: Vec<f64>,
}

impl Column {
    pub(crate) fn read(name: &str, numbers: &Bound<'_, PyAny>) -> PyResult<Self> {
        let (leading, numbers) = floats(name, numbers)?;
        Ok(Self {
            name: name.to_owned(),
            leading,
            numbers,
        })
    }

    pub(crate) fn at(&self, place: usize) -> f64 {
        let place = if self.leading.is_empty() { 0 } else { place };
        self.numbers[place]
    }

    pub(crate) fn numbers(&self) -> &[f64] {
        &self.numbers
    }

    /// The same with the first of its axes alone, that of runs, if it is not one for all.
    pub(crate) fn by_runs(mut self) -> Self {
        if self.leading.len() > 1 {
            self.leading.truncate(1);
            if self.leading == [1] {
                self.leading.clear();
            }
        }
        self
    }
}

/// The leading axes that all have in common; those without any go with every one.
pub(crate) fn common<'a>(
    rows: impl IntoIterator<Item = &'a Rows>,
    columns: impl IntoIterator<Item = &'a Column>,
) -> PyResult<Vec<usize>> {
    let rows = rows.into_iter().map(|of| (of.name, &of.leading));
    let columns = columns
        .into_iter()
        .map(|of| (of.name.as_str(), &of.leading));
    let mut found: Option<(&str, &Vec<usize>)> = None;
    for (name, leading) in rows
        .chain(columns)
        .filter(|(_, leading)| !leading.is_empty())
    {
        match found {
            None => found = Some((name, leading)),
            Some((_, known)) if known == leading => {}
            Some((first, known)) => {
                return Err(wrong(format!(
                    "{name} has the leading axes {}, {first} has {}: they must be the same, or none",
                    shape_text(leading),
                    shape_text(known)
                )));
            }
        }
    }
    Ok(found
        .map(|(_, leading)| leading.clone())
        .unwrap_or_default())
}

/// An array of this shape.
pub(crate) fn array<'py>(
    py: Python<'py>,
    numbers: Vec<f64>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    PyArray1::from_vec(py, numbers).reshape(shape.to_vec())
}

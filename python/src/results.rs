//! What methods return: a run, rollouts, linear models.

use std::fmt::Write as _;

use numpy::{PyArray1, PyArrayDyn};
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::arrays::array;
use crate::faults::wrong;

/// Makes the page of a film.
pub(crate) type MakesPage = Box<dyn Fn() -> Result<String, String> + Send + Sync>;

/// A column of a run.
#[derive(Clone, Debug)]
pub(crate) struct Recorded {
    pub(crate) name: String,
    pub(crate) unit: String,
    pub(crate) numbers: Vec<f64>,
}

/// A run: columns of numbers at the times of reports, and a film.
#[pyclass(frozen, module = "holonom")]
pub struct Run {
    mechanism: &'static str,
    names: Vec<String>,
    units: Vec<String>,
    columns: Vec<Py<PyArray1<f64>>>,
    /// Sentences.
    #[pyo3(get)]
    warnings: Vec<String>,
    /// Evaluations, accepted and rejected steps.
    counts: [usize; 3],
    page: Option<MakesPage>,
}

impl std::fmt::Debug for Run {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Run")
            .field("columns", &self.names)
            .finish_non_exhaustive()
    }
}

impl Run {
    pub(crate) fn new(
        py: Python<'_>,
        mechanism: &'static str,
        recorded: Vec<Recorded>,
        (warnings, counts): (Vec<String>, [usize; 3]),
        page: Option<MakesPage>,
    ) -> Self {
        let (mut names, mut units, mut columns) = (Vec::new(), Vec::new(), Vec::new());
        for column in recorded {
            names.push(column.name);
            units.push(column.unit);
            columns.push(PyArray1::from_vec(py, column.numbers).unbind());
        }
        Self {
            mechanism,
            names,
            units,
            columns,
            warnings,
            counts,
            page,
        }
    }

    fn html(&self) -> PyResult<String> {
        let page = self.page.as_ref();
        let page = page.ok_or_else(|| wrong("the run was made with film=False"))?;
        page().map_err(wrong)
    }
}

#[pymethods]
impl Run {
    /// The names of the columns, in their order.
    #[getter]
    fn columns(&self) -> Vec<String> {
        self.names.clone()
    }

    /// The unit of every column, by its name; "" for a number without one.
    #[getter]
    fn units<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let units = PyDict::new(py);
        for (name, unit) in self.names.iter().zip(&self.units) {
            units.set_item(name, unit)?;
        }
        Ok(units)
    }

    /// The times of the reports (s), shape (T,).
    #[getter]
    fn time(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.__getitem__(py, "time")
    }

    /// How often the rates were evaluated.
    #[getter]
    const fn evaluations(&self) -> usize {
        self.counts[0]
    }

    /// How many steps were accepted.
    #[getter]
    const fn accepted(&self) -> usize {
        self.counts[1]
    }

    /// How many steps were tried and rejected.
    #[getter]
    const fn rejected(&self) -> usize {
        self.counts[2]
    }

    /// A column, shape (T,); or several that have a name in common, as `run["rod.position"]` of
    /// `rod.position.x`, `.y` and `.z`, shape (T, 3).
    fn __getitem__(&self, py: Python<'_>, name: &str) -> PyResult<Py<PyAny>> {
        if let Some(place) = self.names.iter().position(|known| known == name) {
            return Ok(self.columns[place].clone_ref(py).into_any());
        }
        let parts = self.names.iter().zip(&self.columns).filter(|(known, _)| {
            let rest = known
                .strip_prefix(name)
                .and_then(|rest| rest.strip_prefix('.'));
            rest.is_some_and(|rest| !rest.contains('.'))
        });
        let parts: Vec<_> = parts.map(|(_, column)| column.clone_ref(py)).collect();
        // Those of a body or joint have other units each.
        if parts.is_empty() || !name.contains('.') {
            let names = self.names.join(", ");
            return Err(PyKeyError::new_err(format!(
                "`{name}` is no column; there are: {names}"
            )));
        }
        let stacked = py
            .import("numpy")?
            .call_method1("column_stack", (PyList::new(py, parts)?,))?;
        Ok(stacked.unbind())
    }

    fn __contains__(&self, name: &str) -> bool {
        self.names.iter().any(|known| known == name)
    }

    fn __len__(&self, py: Python<'_>) -> PyResult<usize> {
        self.time(py)?.bind(py).len()
    }

    /// The columns by their names.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let columns = PyDict::new(py);
        for (name, column) in self.names.iter().zip(&self.columns) {
            columns.set_item(name, column)?;
        }
        Ok(columns)
    }

    /// The columns as a `pandas.DataFrame` whose index is the time (s).
    fn to_pandas<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let frame = py
            .import("pandas")?
            .call_method1("DataFrame", (self.to_dict(py)?,))?;
        frame.call_method1("set_index", ("time",))
    }

    /// The film as one HTML page that needs no network.
    fn film(&self) -> PyResult<String> {
        self.html()
    }

    /// Writes the film to a file.
    fn save_film(&self, path: std::path::PathBuf) -> PyResult<()> {
        Ok(std::fs::write(path, self.html()?)?)
    }

    fn _repr_html_(&self) -> PyResult<Option<String>> {
        if self.page.is_none() {
            return Ok(None);
        }
        let page = self.html()?.replace('&', "&amp;").replace('"', "&quot;");
        let style = "width: 100%; height: 480px; border: 0";
        Ok(Some(format!(
            "<iframe title=\"film of {}\" sandbox=\"allow-scripts allow-downloads\" style=\"{style}\" srcdoc=\"{page}\"></iframe>",
            self.mechanism
        )))
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let mut text = format!("<run of {}, {} reports", self.mechanism, self.__len__(py)?);
        match self.warnings.len() {
            0 => {}
            1 => text.push_str(", 1 warning"),
            count => {
                let _ = write!(text, ", {count} warnings");
            }
        }
        text.push('>');
        Ok(text)
    }
}

/// Runs of many at once.
#[pyclass(frozen, module = "holonom")]
#[derive(Debug)]
pub struct Rollouts {
    /// The times of the reports (s), shape (T,).
    #[pyo3(get)]
    pub(crate) time: Py<PyArray1<f64>>,
    /// The coordinates (rad, m), shape (B, T, N).
    #[pyo3(get)]
    pub(crate) q: Py<PyArrayDyn<f64>>,
    /// Their rates (rad/s, m/s), shape (B, T, N).
    #[pyo3(get)]
    pub(crate) v: Py<PyArrayDyn<f64>>,
    /// The readings of the class, shape (B, T, P), in the order of its `readings`.
    #[pyo3(get)]
    pub(crate) readings: Py<PyArrayDyn<f64>>,
    /// Kinetic and potential energy (J), shape (B, T).
    #[pyo3(get)]
    pub(crate) energy: Py<PyArrayDyn<f64>>,
    /// The sum of squares of what the constraints are violated by, shape (B, T); zero in a tree.
    #[pyo3(get)]
    pub(crate) violation: Py<PyArrayDyn<f64>>,
    /// Those that stopped: number, time (s) of the last good state, joint or None, why.
    #[pyo3(get)]
    pub(crate) stopped: Vec<(usize, f64, Option<String>, String)>,
    pub(crate) names: Vec<String>,
    pub(crate) read: Vec<String>,
}

#[pymethods]
impl Rollouts {
    /// A coordinate, its rate (`..._rate`) or a reading by name, shape (B, T).
    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let of_rate = name.strip_suffix("_rate");
        let place = |names: &[String], name: &str| names.iter().position(|known| known == name);
        let (of, at) = if let Some(at) = place(&self.names, name) {
            (&self.q, at)
        } else if let Some(at) = place(&self.read, name) {
            (&self.readings, at)
        } else if let Some(at) = of_rate.and_then(|name| place(&self.names, name)) {
            (&self.v, at)
        } else {
            let names = [&self.names[..], &self.read].concat().join(", ");
            return Err(PyKeyError::new_err(format!("`{name}` is none of {names}")));
        };
        let arguments = (at, -1);
        of.bind(py).call_method("take", arguments, None)
    }

    /// All arrays by name, and `stopped`.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        all.set_item("time", &self.time)?;
        all.set_item("q", &self.q)?;
        all.set_item("v", &self.v)?;
        all.set_item("readings", &self.readings)?;
        all.set_item("energy", &self.energy)?;
        all.set_item("violation", &self.violation)?;
        all.set_item("stopped", &self.stopped)?;
        Ok(all)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let shape = self.q.bind(py).getattr("shape")?;
        Ok(format!(
            "<rollouts, q of shape {shape}, {} stopped>",
            self.stopped.len()
        ))
    }
}

/// Equations of motion, linear about states: `x' = A x + B u`, `y = C x + D u`.
#[pyclass(frozen, module = "holonom")]
#[derive(Debug)]
pub struct Linearised {
    pub(crate) matrices: [Py<PyArrayDyn<f64>>; 4],
    /// The names of `x`: coordinates, then their rates.
    #[pyo3(get)]
    pub(crate) states: Vec<String>,
    /// The names of `u`.
    #[pyo3(get)]
    pub(crate) inputs: Vec<String>,
    /// The names of `y`.
    #[pyo3(get)]
    pub(crate) outputs: Vec<String>,
}

#[pymethods]
impl Linearised {
    /// Shape (..., 2 N, 2 N).
    #[getter(A)]
    fn a(&self, py: Python<'_>) -> Py<PyArrayDyn<f64>> {
        self.matrices[0].clone_ref(py)
    }

    /// Shape (..., 2 N, K).
    #[getter(B)]
    fn b(&self, py: Python<'_>) -> Py<PyArrayDyn<f64>> {
        self.matrices[1].clone_ref(py)
    }

    /// Shape (..., P, 2 N).
    #[getter(C)]
    fn c(&self, py: Python<'_>) -> Py<PyArrayDyn<f64>> {
        self.matrices[2].clone_ref(py)
    }

    /// Shape (..., P, K).
    #[getter(D)]
    fn d(&self, py: Python<'_>) -> Py<PyArrayDyn<f64>> {
        self.matrices[3].clone_ref(py)
    }

    /// `A, B, C, D = linear`.
    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, pyo3::types::PyIterator>> {
        PyList::new(py, self.matrices.iter().map(|matrix| matrix.clone_ref(py)))?.try_iter()
    }
}

/// An array of these numbers that Python owns.
pub(crate) fn owned(
    py: Python<'_>,
    numbers: Vec<f64>,
    shape: &[usize],
) -> PyResult<Py<PyArrayDyn<f64>>> {
    Ok(array(py, numbers, shape)?.unbind())
}

//! The equations of motion over batches: states in, numbers out, without the interpreter.

use std::sync::Arc;

use holonom::error::Fault;
use holonom::mechanism::PointHandle;
use holonom::mechanism::ValueHandle;
use holonom::{BodyHandle, Mechanism as _};
use numpy::PyArrayDyn;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{Column, Rows, array, common};
use crate::described::{Kind, names_of, values};
use crate::exposed::{Analysed, Exposed, SpaceOf, Valued};
use crate::faults::{Trouble, wrong};
use crate::start::space;
use crate::threads;

/// Rows that one thread takes at a time.
const ROWS: usize = 512;

/// A batch of states, with what else is given for each.
pub(crate) struct Batch<'a> {
    /// Coordinates, rates, and efforts or accelerations, as many as there are.
    pub(crate) rows: &'a [Rows],
    /// Inputs, by the places of their numbers.
    pub(crate) inputs: &'a [(usize, Column)],
    /// The time (s).
    pub(crate) time: f64,
}

/// The joint state of the mechanism of a class.
pub(crate) type StateOf<E> =
    <<E as Exposed>::Mechanism as holonom::JointCoordinates>::JointState<f64>;

impl Batch<'_> {
    fn leading(&self) -> PyResult<Vec<usize>> {
        common(self.rows, self.inputs.iter().map(|(_, column)| column))
    }

    /// An array for each of some results, of these shapes behind the leading axes.
    pub(crate) fn results<'py, E: Analysed<N>, const N: usize, const R: usize>(
        &self,
        py: Python<'py>,
        valued: &Arc<Valued<E::Mechanism>>,
        shapes: [&[usize]; R],
        compute: impl Fn(&SpaceOf<E, N>, &StateOf<E>, &[&[f64]]) -> Result<[Vec<f64>; R], Fault>
        + Sync
        + Send,
    ) -> PyResult<[Bound<'py, PyArrayDyn<f64>>; R]> {
        let leading = self.leading()?;
        let count: usize = leading.iter().product();
        let found = py.detach(|| self.computed::<E, N, R>(valued, count, &compute));
        let found = found.map_err(|trouble| {
            let index = trouble.index.filter(|_| !leading.is_empty());
            Trouble { index, ..trouble }.raised(py, None)
        })?;
        let mut arrays = Vec::with_capacity(R);
        for (numbers, shape) in found.into_iter().zip(shapes) {
            arrays.push(array(py, numbers, &[&leading, shape].concat())?);
        }
        arrays
            .try_into()
            .map_err(|_| wrong("as many results as there are shapes"))
    }

    fn computed<E: Analysed<N>, const N: usize, const R: usize>(
        &self,
        valued: &Valued<E::Mechanism>,
        count: usize,
        compute: &(
             impl Fn(&SpaceOf<E, N>, &StateOf<E>, &[&[f64]]) -> Result<[Vec<f64>; R], Fault> + Sync
         ),
    ) -> Result<[Vec<f64>; R], Trouble> {
        let pieces = count.div_ceil(ROWS);
        let mut results: Vec<[Vec<f64>; R]> = Vec::new();
        results.resize_with(pieces, || std::array::from_fn(|_| Vec::new()));
        let threads = threads::count(None, pieces);
        let worker = || space::<E, N>(valued, self.time).map_err(Trouble::from);
        let work = |space: &mut SpaceOf<E, N>, piece: usize, result: &mut [Vec<f64>; R]| {
            for place in piece * ROWS..count.min((piece + 1) * ROWS) {
                let found = self.one::<E, N, R>(space, place, compute);
                let found = found.map_err(|fault| Trouble {
                    index: Some(place),
                    ..Trouble::from(fault)
                })?;
                for (to, numbers) in result.iter_mut().zip(found) {
                    to.extend(numbers);
                }
            }
            Ok(())
        };
        threads::each(threads, &mut results, worker, work)?;
        Ok(std::array::from_fn(|result| {
            let parts: Vec<&[f64]> = results.iter().map(|part| part[result].as_slice()).collect();
            parts.concat()
        }))
    }

    fn one<E: Analysed<N>, const N: usize, const R: usize>(
        &self,
        space: &mut SpaceOf<E, N>,
        place: usize,
        compute: &impl Fn(&SpaceOf<E, N>, &StateOf<E>, &[&[f64]]) -> Result<[Vec<f64>; R], Fault>,
    ) -> Result<[Vec<f64>; R], Fault> {
        for (value, column) in self.inputs {
            space.set_value(ValueHandle::new(*value), column.at(place))?;
        }
        let rows: Vec<&[f64]> = self.rows.iter().map(|rows| rows.row(place)).collect();
        let state = space.state(fixed::<N>(rows[0]), fixed::<N>(rows[1]))?;
        compute(space, &state, &rows)
    }
}

/// A row of as many numbers as there are coordinates.
pub(crate) fn fixed<const N: usize>(row: &[f64]) -> [f64; N] {
    std::array::from_fn(|place| row.get(place).copied().unwrap_or(f64::NAN))
}

/// The inputs of a batch by name, each one number or one for every place.
pub(crate) fn inputs_of<E: Exposed>(
    given: Option<&Bound<'_, PyDict>>,
) -> PyResult<Vec<(usize, Column)>> {
    let mut inputs = Vec::new();
    let values = values::<E::Mechanism>();
    for (name, numbers) in given.into_iter().flatten() {
        let name: String = name.extract()?;
        let known = values
            .iter()
            .find(|value| value.name == name && value.kind == Kind::Input);
        let known = known
            .filter(|value| value.places.len() == 1)
            .ok_or_else(|| {
                let names = names_of::<E::Mechanism>(Kind::Input).join(", ");
                wrong(format!(
                    "`{name}` is no input with one number; inputs are: {names}"
                ))
            })?;
        inputs.push((known.places[0], Column::read(&name, &numbers)?));
    }
    Ok(inputs)
}

/// A body or a named point, by its name.
#[derive(Clone, Copy, Debug)]
pub(crate) enum At {
    Body(usize),
    Point(usize),
}

impl At {
    pub(crate) fn of<E: Exposed>(name: &str) -> PyResult<Self> {
        let report = &E::Mechanism::REPORT;
        let point = report.points.iter().position(|point| point.name == name);
        let body = report.bodies.iter().position(|body| body.name == name);
        let found = point.map(Self::Point).or(body.map(Self::Body));
        found.ok_or_else(|| {
            let points = report.points.iter().map(|point| point.name);
            let names: Vec<&str> = points
                .chain(report.bodies.iter().map(|body| body.name))
                .collect();
            wrong(format!(
                "`{name}` is no point and no body; there are: {}",
                names.join(", ")
            ))
        })
    }

    /// Its Jacobian, row by row.
    pub(crate) fn jacobian<E: Analysed<N>, const N: usize>(
        self,
        space: &SpaceOf<E, N>,
        state: &StateOf<E>,
    ) -> Result<Vec<f64>, Fault> {
        let matrix = match self {
            Self::Body(place) => space.jacobian(state, BodyHandle::new(place))?,
            Self::Point(place) => space.jacobian(state, PointHandle::new(place))?,
        };
        Ok(matrix
            .row_iter()
            .flat_map(|row| row.iter().copied().collect::<Vec<_>>())
            .collect())
    }
}

//! Between the user's axes and those of the kernels, and the values of kernels.

use holonom_engine::model::inertia::{compose, rotation};
use holonom_engine::model::{BodyKind, Model};
use holonom_engine::plan::system::Terms;
use holonom_engine::symbolic::arena::{Arena, Expr, Input};
use holonom_engine::symbolic::equations::Kernel;
use holonom_engine::symbolic::evaluate::evaluate;

use crate::reading::{Described, Numbers, number};
use crate::reference::State;

/// What is multiplied with `Phi'` and `Phi`, and the compliance.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Coefficients {
    pub(crate) rate_gain: f64,
    pub(crate) position_gain: f64,
    pub(crate) compliance: f64,
}

impl Coefficients {
    /// The gains of `Phi'` and `Phi`, where the terms have them.
    pub(crate) fn gains(&self, terms: Terms) -> (f64, f64) {
        if terms == Terms::Plain {
            (0.0, 0.0)
        } else {
            (self.rate_gain, self.position_gain)
        }
    }
}

/// Everything that a kernel may ask for.
pub(crate) struct Inputs {
    pub(crate) symbols: Vec<f64>,
    time: f64,
    pub(crate) coordinates: Vec<f64>,
    pub(crate) velocities: Vec<f64>,
    pub(crate) coefficients: Coefficients,
    pub(crate) upper: Vec<f64>,
    pub(crate) lower: Vec<f64>,
}

/// From the user's to principal axes of a body.
pub(crate) fn user_axes(model: &Model, body: usize) -> [Numbers; 3] {
    rotation(model.bodies[body].user_axes)
}

pub(crate) fn turned(matrix: [Numbers; 3], v: Numbers) -> Numbers {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

pub(crate) fn transposed(m: [Numbers; 3]) -> [Numbers; 3] {
    [0, 1, 2].map(|k| [m[0][k], m[1][k], m[2][k]])
}

/// What stands for velocities, with rotations in the axes of the kernels, or back in the user's.
pub(crate) fn in_axes(model: &Model, values: &[f64], principal: bool) -> Vec<f64> {
    let mut result = values.to_vec();
    let layout = model.layout();
    for (body, described) in model.bodies.iter().enumerate() {
        if described.kind == BodyKind::Rigid {
            let first = layout.velocity[body] + 3;
            let turn = user_axes(model, body);
            let turn = if principal { turn } else { transposed(turn) };
            let given = [0, 1, 2].map(|k| values[first + k]);
            result[first..first + 3].copy_from_slice(&turned(turn, given));
        }
    }
    result
}

impl Inputs {
    /// `angles` are those that the state counts.
    pub(crate) fn new(
        model: &Model,
        described: &Described,
        state: &State,
        angles: &[(f64, f64)],
        coefficients: Coefficients,
    ) -> Self {
        let symbols = model.symbols.iter().map(|symbol| {
            let expr = syn::parse2(symbol.expression.clone()).expect("an expression");
            number(&expr, &described.values)
        });
        let (mut coordinates, mut velocities) = (Vec::new(), Vec::new());
        for (place, body) in model.bodies.iter().enumerate() {
            let (r, p) = state.poses[place];
            let (v, w) = state.rates[place];
            coordinates.extend(r);
            velocities.extend(v);
            if body.kind == BodyKind::Rigid {
                let [c0, c1, c2, c3] = body.user_axes;
                coordinates.extend(compose(p, [c0, -c1, -c2, -c3]));
                velocities.extend(turned(user_axes(model, place), w));
            }
        }
        // What was integrated is not quite the angle: it picks the turn, and the turn only.
        coordinates.extend(angles.iter().map(|(angle, _)| angle + 0.5));
        Self {
            symbols: symbols.collect(),
            time: state.time,
            coordinates,
            velocities,
            coefficients,
            upper: Vec::new(),
            lower: Vec::new(),
        }
    }

    /// The values of expressions, not a number where an input is unknown.
    pub(crate) fn values(&self, arena: &Arena, outputs: &[Expr]) -> Vec<f64> {
        let at = |values: &[f64], place: u32| values.get(place as usize).copied();
        let values = evaluate(arena, outputs, |input| match input {
            Input::Symbol(place) | Input::Varying(place) => at(&self.symbols, place),
            Input::RateGain => Some(self.coefficients.rate_gain),
            Input::PositionGain => Some(self.coefficients.position_gain),
            Input::Compliance(_) => Some(self.coefficients.compliance),
            Input::Time => Some(self.time),
            Input::Coordinate(place) => at(&self.coordinates, place),
            Input::Velocity(place) => at(&self.velocities, place),
            Input::Acceleration(_) => None,
            Input::Upper(place) => at(&self.upper, place),
            Input::Lower(place) => at(&self.lower, place),
        });
        let values = values.into_iter();
        values.map(|value| value.unwrap_or(f64::NAN)).collect()
    }

    pub(crate) fn of(&self, kernel: &Kernel) -> Vec<f64> {
        self.values(&kernel.arena, &kernel.outputs)
    }
}

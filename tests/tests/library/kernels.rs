//! The kernels of any mechanism as functions of `x = (q, u)`, without its type: what judges them is
//! compiled once.

use holonom::{
    ForceHandle, JointHandle, Mechanism, MechanismExt, Report, StateParts, View, Wrench,
    mechanism::{Plain, Stabilisation},
    state::Array,
};
use nalgebra::DMatrix;

/// The right-hand side at an instant.
#[derive(Clone, Debug)]
pub(crate) struct Evaluated {
    /// `(q', u')`.
    pub(crate) rates: Vec<f64>,
    /// `lambda`.
    pub(crate) multipliers: Vec<f64>,
    /// The smallest relative pivot.
    pub(crate) pivot: f64,
}

/// Energies (J), power (W).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Books {
    pub(crate) kinetic: f64,
    pub(crate) potential: f64,
    pub(crate) power: f64,
}

/// A mechanism at work, and the one element that it was described for. `x = (q, u)`; `q` ends with
/// the auxiliary states.
pub(crate) trait Kernels {
    fn report(&self) -> &'static Report;
    fn initial_state(&self) -> Vec<f64>;
    fn mass(&self) -> Vec<f64>;
    /// `Phi`, `Phi'`, `gamma`.
    fn rows(&self, time: f64, x: &[f64]) -> [Vec<f64>; 3];
    /// `D`, equations by velocities.
    fn jacobian(&self, time: f64, x: &[f64]) -> DMatrix<f64>;
    /// `g`.
    fn forces(&self, time: f64, x: &[f64]) -> Vec<f64>;
    fn coordinate_rates(&self, x: &[f64]) -> Vec<f64>;
    fn books(&self, time: f64, x: &[f64]) -> Books;
    /// With multipliers and Euler parameters normalised.
    fn evaluate(&self, time: f64, x: &[f64]) -> Evaluated;
    fn rewrap(&self, x: &mut [f64]);
    /// What the joint exerts on its body at a place.
    fn reaction(&self, time: f64, x: &[f64], multipliers: &[f64], place: usize) -> Wrench<f64>;
    /// Angle (rad) and displacement (m) of the joint, each with its rate.
    fn readings(&self, time: f64, x: &[f64]) -> [[f64; 2]; 2];
    /// Potential energy (J) and power (W) of the force, and its load on the body at a place: force
    /// (N, global), then moment (N m, principal axes).
    fn force(&self, time: f64, x: &[f64], place: usize) -> ([f64; 2], [f64; 6]);
}

/// A mechanism with its constants.
struct Prepared<M: Mechanism, E> {
    constants: M::Constants<f64>,
    coefficients: M::Coefficients<f64>,
    element: E,
}

/// What a mechanism was described for.
pub(crate) trait Element<M: Mechanism>: Copy + 'static {
    fn index(self) -> usize;
    fn reaction(
        self,
        view: &View<'_, f64, M>,
        lambda: &M::Multipliers<f64>,
        place: usize,
    ) -> Wrench<f64>;
    fn books(self, view: &View<'_, f64, M>) -> [f64; 2];
}

impl<M: Mechanism, J: 'static> Element<M> for JointHandle<M, J> {
    fn index(self) -> usize {
        self.index()
    }

    fn reaction(
        self,
        view: &View<'_, f64, M>,
        lambda: &M::Multipliers<f64>,
        place: usize,
    ) -> Wrench<f64> {
        view.reaction_on_place(lambda, self, place)
            .expect("a place of the joint")
    }

    fn books(self, _: &View<'_, f64, M>) -> [f64; 2] {
        unreachable!("a joint")
    }
}

impl<M: Mechanism, F: 'static> Element<M> for ForceHandle<M, F> {
    fn index(self) -> usize {
        self.index()
    }

    fn reaction(self, _: &View<'_, f64, M>, _: &M::Multipliers<f64>, _: usize) -> Wrench<f64> {
        unreachable!("a force")
    }

    fn books(self, view: &View<'_, f64, M>) -> [f64; 2] {
        let parts = view.force_parts(self);
        [parts.potential, parts.power]
    }
}

/// The kernels of a mechanism and one of its elements.
pub(crate) fn boxed<M: Mechanism, E: Element<M>>(mechanism: &M, element: E) -> Box<dyn Kernels> {
    let constants = mechanism.constants().expect("acceptable parameters");
    let rigid = Stabilisation {
        rate: 0.0,
        position: 0.0,
        compliance: 0.0,
    };
    Box::new(Prepared::<M, E> {
        coefficients: M::coefficients(&constants, &rigid),
        constants,
        element,
    })
}

/// `x = (q, u)` as a state.
pub(crate) fn state<M: Mechanism>(x: &[f64]) -> M::State<f64> {
    let mut state = M::State::<f64>::from_parts(Array::zeros(), Array::zeros());
    let (q, u) = x.split_at(M::REPORT.coordinates + M::REPORT.auxiliaries);
    state.coordinates_mut().as_mut_slice().copy_from_slice(q);
    state.velocities_mut().as_mut_slice().copy_from_slice(u);
    state
}

/// A state as `x = (q, u)`.
pub(crate) fn flat<M: Mechanism>(state: &M::State<f64>) -> Vec<f64> {
    let parts = [
        state.coordinates().as_slice(),
        state.velocities().as_slice(),
    ];
    parts.concat()
}

impl<M: Mechanism, E: Element<M>> Kernels for Prepared<M, E> {
    fn report(&self) -> &'static Report {
        const { &M::REPORT }
    }

    fn initial_state(&self) -> Vec<f64> {
        flat::<M>(&M::initial_state(&self.constants))
    }

    fn mass(&self) -> Vec<f64> {
        M::mass(&self.constants).as_slice().to_vec()
    }

    fn rows(&self, time: f64, x: &[f64]) -> [Vec<f64>; 3] {
        let (constants, state) = (&self.constants, state::<M>(x));
        [
            M::constraints(constants, time, &state),
            M::constraint_rates(constants, time, &state),
            M::gamma(constants, time, &state),
        ]
        .map(|rows| rows.as_slice().to_vec())
    }

    fn jacobian(&self, time: f64, x: &[f64]) -> DMatrix<f64> {
        let values = M::jacobian(&self.constants, time, &state::<M>(x));
        dense(&M::REPORT, values.as_slice())
    }

    fn forces(&self, time: f64, x: &[f64]) -> Vec<f64> {
        let forces = M::forces(&self.constants, time, &state::<M>(x));
        forces.as_slice().to_vec()
    }

    fn coordinate_rates(&self, x: &[f64]) -> Vec<f64> {
        let rates = M::coordinate_rates(&self.constants, &state::<M>(x));
        rates.as_slice().to_vec()
    }

    fn books(&self, time: f64, x: &[f64]) -> Books {
        let (constants, state) = (&self.constants, state::<M>(x));
        Books {
            kinetic: M::kinetic_energy(constants, &state),
            potential: M::potential_energy(constants, time, &state),
            power: M::power(constants, time, &state),
        }
    }

    fn evaluate(&self, time: f64, x: &[f64]) -> Evaluated {
        let (constants, coefficients) = (&self.constants, &self.coefficients);
        let found = M::evaluate::<f64, Plain>(constants, coefficients, time, &state::<M>(x));
        Evaluated {
            rates: flat::<M>(&found.rates),
            multipliers: found.multipliers.as_slice().to_vec(),
            pivot: found.pivot.relative,
        }
    }

    fn rewrap(&self, x: &mut [f64]) {
        let mut state = state::<M>(x);
        M::rewrap(&self.constants, &mut state);
        x.copy_from_slice(&flat::<M>(&state));
    }

    fn reaction(&self, time: f64, x: &[f64], multipliers: &[f64], place: usize) -> Wrench<f64> {
        let state = state::<M>(x);
        let mut lambda = M::Multipliers::<f64>::zeros();
        lambda.as_mut_slice().copy_from_slice(multipliers);
        let view = View::<f64, M>::new(&self.constants, time, &state);
        self.element.reaction(&view, &lambda, place)
    }

    fn readings(&self, time: f64, x: &[f64]) -> [[f64; 2]; 2] {
        let state = state::<M>(x);
        let angle = M::joint_angle(&self.constants, &state, self.element.index());
        let displacement =
            M::joint_displacement(&self.constants, time, &state, self.element.index());
        [
            [angle.angle(), angle.rate],
            [displacement.value, displacement.rate],
        ]
    }

    fn force(&self, time: f64, x: &[f64], place: usize) -> ([f64; 2], [f64; 6]) {
        let state = state::<M>(x);
        let view = View::<f64, M>::new(&self.constants, time, &state);
        let index = self.element.index();
        let load = M::force_load(&self.constants, time, &state, index, place);
        (self.element.books(&view), load)
    }
}

/// The Jacobian as a dense matrix.
fn dense(report: &Report, values: &[f64]) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(report.equations, report.velocities);
    for block in report.blocks {
        for row in 0..block.rows {
            for column in 0..block.columns {
                let value = values[block.offset + row * block.columns + column];
                matrix[(block.row + row, block.column + column)] += value;
            }
        }
    }
    matrix
}

//! Coordinates over numbers that are written down and cannot be compared.
//!
//! What programs that trace kernels ask for: the same numbers as of [`Coordinates`], without a
//! branch.

use crate::math::quaternion::{from_matrix_by_selection, scale, unit_factor};
use crate::math::scalar::Scalar;
use crate::math::vec3::read;
use crate::math::versine;
use crate::mechanism::coordinates::{Absolute, Coordinates, Relative};
use crate::mechanism::joint_kernels::{JointCoordinates, JointParts, JointReport};
use crate::mechanism::kernels::{Mechanism, Normalised, Plain, Stabilisation};
use crate::mechanism::relative::{bodies_by, closing_compliances, recount};
use crate::mechanism::report::BodyKind;
use crate::state::vector::{Array, MovingState as _, StateParts};

/// What a turn by an angle is made of, for programs that compute it as [`Scalar`] does in `f64`.
pub const TURN_OF_DOUBLE: [[f64; 6]; 2] = versine::SIX;
/// The same in `f32`.
pub const TURN_OF_SINGLE: [[f64; 3]; 2] = versine::THREE;
/// A quarter of a turn (rad) in parts, in `f64`.
pub const QUARTER_OF_DOUBLE: [f64; 3] = versine::QUARTER_BY_FORTY;
/// The same in `f32`.
pub const QUARTER_OF_SINGLE: [f32; 3] = versine::QUARTER_BY_SEVENTEEN;

/// Coordinates whose kernels can be traced.
///
/// It is implemented by [`Absolute`] and [`Relative`].
pub trait TracedCoordinates<M: Mechanism>: Coordinates<M> {
    /// The report on joint coordinates, where these are the coordinates.
    const JOINTS: Option<&'static JointReport>;

    /// What depends on parameters, and what depends on a formulation with these compliances of all
    /// equations of the bodies: zeros for one without.
    fn prepare<S: Scalar>(
        parameters: &M::Parameters<S>,
        stabilisation: &Stabilisation<S>,
        compliances: &M::Multipliers<S>,
    ) -> (Self::Constants<S>, Self::Coefficients<S>);

    /// The constants with these parameters, of which those that depend on inputs are computed
    /// again.
    fn with_inputs<S: Scalar>(
        parameters: &M::Parameters<S>,
        constants: Self::Constants<S>,
    ) -> Self::Constants<S>;

    /// [`Coordinates::normalise`] after a step.
    fn brought_to_normal_form<S: Scalar>(
        absolute: &M::Constants<S>,
        constants: &Self::Constants<S>,
        state: &mut Self::State<S>,
    );

    /// [`Coordinates::bodies`].
    fn bodies_by_selection<S: Scalar>(
        constants: &Self::Constants<S>,
        state: &Self::State<S>,
    ) -> M::State<S>;

    /// The `u` of `M u + D^T lambda = loads` and `D u = lower` with rigid constraints, the loads on
    /// bodies as [`Mechanism::forces`]; and the least relative pivot.
    #[doc(hidden)]
    fn moved_by<S: Scalar>(
        prepared: (&Self::Constants<S>, &Self::Coefficients<S>),
        time: S,
        state: &Self::State<S>,
        loads: &M::Velocities<S>,
        lower: &Self::Multipliers<S>,
    ) -> (Self::Velocities<S>, S);
}

/// A mechanism at an instant: what depends on parameters, on the formulation, and the time (s).
#[derive(Debug)]
pub struct AtTime<'a, S: Scalar, M: Mechanism, C: Coordinates<M>> {
    /// What depends on parameters.
    pub own: &'a C::Constants<S>,
    /// The same in absolute coordinates.
    pub absolute: &'a M::Constants<S>,
    /// What depends on the formulation.
    pub coefficients: &'a C::Coefficients<S>,
    /// The time (s).
    pub time: S,
}

/// Scales the Euler parameters at a place to length 1.
fn scale_to_unit_length<S: Scalar>(coordinates: &mut [S], place: usize) {
    let factor = unit_factor(&read(coordinates, place));
    scale(coordinates, place, factor);
}

impl<M: Mechanism> TracedCoordinates<M> for Absolute<Normalised> {
    const JOINTS: Option<&'static JointReport> = None;

    fn prepare<S: Scalar>(
        parameters: &M::Parameters<S>,
        stabilisation: &Stabilisation<S>,
        compliances: &M::Multipliers<S>,
    ) -> (M::Constants<S>, M::Coefficients<S>) {
        let constants = M::prepare(parameters);
        let coefficients = M::coefficients_by_row(&constants, stabilisation, compliances);
        (constants, coefficients)
    }

    fn with_inputs<S: Scalar>(
        parameters: &M::Parameters<S>,
        mut constants: M::Constants<S>,
    ) -> M::Constants<S> {
        M::take_inputs(parameters, &mut constants);
        constants
    }

    fn brought_to_normal_form<S: Scalar>(
        absolute: &M::Constants<S>,
        _constants: &M::Constants<S>,
        state: &mut M::State<S>,
    ) {
        let rigid = M::REPORT.bodies.iter();
        for body in rigid.filter(|body| body.kind == BodyKind::Rigid) {
            scale_to_unit_length(state.coordinates_mut().as_mut_slice(), body.coordinate + 3);
        }
        M::rewrap(absolute, state);
    }

    fn bodies_by_selection<S: Scalar>(
        _constants: &M::Constants<S>,
        state: &M::State<S>,
    ) -> M::State<S> {
        *state
    }

    fn moved_by<S: Scalar>(
        (constants, coefficients): (&M::Constants<S>, &M::Coefficients<S>),
        time: S,
        state: &M::State<S>,
        loads: &M::Velocities<S>,
        lower: &M::Multipliers<S>,
    ) -> (M::Velocities<S>, S) {
        let (factors, pivot) = M::factor::<S, Plain>(constants, coefficients, time, state);
        let (moved, _) = M::solve::<S, Plain>(constants, coefficients, &factors, loads, lower);
        (moved, pivot.relative)
    }
}

impl<M: JointCoordinates> TracedCoordinates<M> for Relative {
    const JOINTS: Option<&'static JointReport> = Some(&M::JOINT_REPORT);

    fn prepare<S: Scalar>(
        parameters: &M::Parameters<S>,
        stabilisation: &Stabilisation<S>,
        compliances: &M::Multipliers<S>,
    ) -> (M::JointConstants<S>, M::JointCoefficients<S>) {
        let constants = M::prepare_joints(parameters);
        let own = closing_compliances::<S, M>(compliances, stabilisation);
        let coefficients = M::joint_coefficients(&constants, stabilisation, &own);
        (constants, coefficients)
    }

    fn with_inputs<S: Scalar>(
        parameters: &M::Parameters<S>,
        mut constants: M::JointConstants<S>,
    ) -> M::JointConstants<S> {
        M::take_joint_inputs(parameters, &mut constants);
        constants
    }

    fn brought_to_normal_form<S: Scalar>(
        absolute: &M::Constants<S>,
        constants: &M::JointConstants<S>,
        state: &mut M::JointState<S>,
    ) {
        for &place in M::JOINT_REPORT.euler_parameters {
            scale_to_unit_length(state.rest_slice_mut(), place);
        }
        recount::<S, M>(absolute, state, |state| {
            <Self as TracedCoordinates<M>>::bodies_by_selection::<S>(constants, state)
        });
    }

    fn bodies_by_selection<S: Scalar>(
        constants: &M::JointConstants<S>,
        state: &M::JointState<S>,
    ) -> M::State<S> {
        let motions = M::body_motions(constants, state);
        bodies_by::<S, M>(&motions, |_, rows| from_matrix_by_selection(rows))
    }

    fn moved_by<S: Scalar>(
        (constants, coefficients): (&M::JointConstants<S>, &M::JointCoefficients<S>),
        time: S,
        state: &M::JointState<S>,
        loads: &M::Velocities<S>,
        lower: &M::ClosingMultipliers<S>,
    ) -> (M::JointVelocities<S>, S) {
        let mut rates = M::JointState::<S>::zeros();
        let pivot = <Self as Coordinates<M>>::rates_into::<S, Plain>(
            constants,
            coefficients,
            time,
            state,
            &mut rates,
            &mut Array::zeros(),
        );
        let factors = M::factor_joints::<S, Plain>(constants, coefficients, time, state);
        let (moved, _) =
            M::solve_joints::<S, Plain>(constants, coefficients, &factors, loads, lower);
        (moved, pivot.relative)
    }
}

//! Kernels in the rates of the joints, for mechanisms that ask for them.
//!
//! One rate stands for every motion of a joint that carries a body, in the order of
//! [`JointReport::motions`](crate::mechanism::JointReport::motions). It is read as handles read it,
//! in rad/s or m/s, with the sign of the joint. A ball has three: the angular velocity of its body
//! against the ground, in principal axes. An effort does work on such a rate: N m on an angle, N on
//! a displacement.

use crate::math::scalar::Scalar;
use crate::mechanism::joint_kernels::JointCoordinates;
use crate::state::vector::Array;

/// A mechanism that asks for kernels in the rates of its joints: the equations that close its
/// loops.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no kernels in the rates of its joints",
    label = "none were asked for",
    note = "write `#[mechanism(coordinates = \"joints\", kernels = [mass, inverse])]` above the struct"
)]
pub trait JointRates: JointCoordinates {
    /// `D` row by row, one number for each rate.
    type ClosingJacobian<S: Scalar>: Array<S>;

    /// `D` of the equations that remain, with `D w = Phi' - dPhi/dt` for rates `w`; beside it
    /// `gamma`, with `D w' = gamma`, `Phi'` at the rates of the
    /// state, and `Phi`.
    fn closing_rows<S: Scalar>(
        constants: &Self::JointConstants<S>,
        time: S,
        state: &Self::JointState<S>,
    ) -> (Self::ClosingJacobian<S>, [Self::ClosingMultipliers<S>; 3]);
}

/// A mechanism with `kernels = [mass]`: the mass matrix of its tree.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no kernel `mass`",
    label = "it was not asked for",
    note = "write `#[mechanism(coordinates = \"joints\", kernels = [mass])]` above the struct, beside the kernels that are there"
)]
pub trait HasMassMatrix: JointRates {
    /// All entries, row by row.
    type MassMatrix<S: Scalar>: Array<S>;

    /// Writes the mass matrix `M(q)`, without the equations that close loops, row by row into as
    /// many entries as it has; nothing into fewer. Zero where all of it is finite, else NaN.
    fn mass_matrix_into<S: Scalar>(
        constants: &Self::JointConstants<S>,
        time: S,
        state: &Self::JointState<S>,
        entries: &mut [S],
    ) -> S;

    /// The same matrix as a value.
    fn mass_matrix<S: Scalar>(
        constants: &Self::JointConstants<S>,
        time: S,
        state: &Self::JointState<S>,
    ) -> Self::MassMatrix<S> {
        let mut matrix = Self::MassMatrix::zeros();
        Self::mass_matrix_into(constants, time, state, matrix.as_mut_slice());
        matrix
    }
}

/// A mechanism with `kernels = [inverse]`: inverse dynamics of its tree.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no kernel `inverse`",
    label = "it was not asked for",
    note = "write `#[mechanism(coordinates = \"joints\", kernels = [inverse])]` above the struct, beside the kernels that are there"
)]
pub trait HasInverse: JointRates {
    /// The efforts that have to act beside the described forces for these accelerations, without
    /// the equations that close loops: `M(q) w' + h`.
    fn inverse_dynamics<S: Scalar>(
        constants: &Self::JointConstants<S>,
        time: S,
        state: &Self::JointState<S>,
        accelerations: &Self::JointVelocities<S>,
    ) -> Self::JointVelocities<S>;
}

/// A mechanism with `kernels = [gravity]`: the efforts that hold its weights.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no kernel `gravity`",
    label = "it was not asked for",
    note = "write `#[mechanism(coordinates = \"joints\", kernels = [gravity])]` above the struct, beside the kernels that are there"
)]
pub trait HasGravity: JointRates {
    /// The gradient of the potential of gravity.
    fn gravity_efforts<S: Scalar>(
        constants: &Self::JointConstants<S>,
        time: S,
        state: &Self::JointState<S>,
    ) -> Self::JointVelocities<S>;
}

/// A mechanism with `kernels = [coriolis]`: the efforts that motion takes.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no kernel `coriolis`",
    label = "it was not asked for",
    note = "write `#[mechanism(coordinates = \"joints\", kernels = [coriolis])]` above the struct, beside the kernels that are there"
)]
pub trait HasCoriolis: JointRates {
    /// `M(q) w' + C(q, w) w`: what these accelerations and the velocities take, without weights and
    /// described forces.
    fn coriolis_efforts<S: Scalar>(
        constants: &Self::JointConstants<S>,
        time: S,
        state: &Self::JointState<S>,
        accelerations: &Self::JointVelocities<S>,
    ) -> Self::JointVelocities<S>;
}

/// A mechanism with `kernels = [jacobian]`: where the axes of its joints are.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no kernel `jacobian`",
    label = "it was not asked for",
    note = "write `#[mechanism(coordinates = \"joints\", kernels = [jacobian])]` above the struct, beside the kernels that are there"
)]
pub trait HasJacobian: JointRates {
    /// Nine numbers for each rate: the axis of the turn, a point on it and the direction of the
    /// translation, all in global axes; zeros where there is none.
    type Axes<S: Scalar>: Array<S>;
    /// The rates that move each body. Beside one that only carries a ball along, the place of the
    /// ball's first rate: it moves the ball's centre and does not turn it, because the rates of a
    /// ball are those of its body against the ground.
    const MOVED_BY: &'static [&'static [(usize, Option<usize>)]];

    /// The axes. A body that a rate moves gets from it an angular velocity along the axis `a`, and
    /// at a point `p` the velocity `a x (p - o) + s` for a point `o` on the axis and the
    /// translation `s`.
    fn joint_axes<S: Scalar>(
        constants: &Self::JointConstants<S>,
        time: S,
        state: &Self::JointState<S>,
    ) -> Self::Axes<S>;
}

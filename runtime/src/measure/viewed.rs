//! Views of a mechanism, which prepare its constants.

use crate::error::ParameterError;
use crate::math::scalar::Scalar;
use crate::measure::access::MechanismExt as _;
use crate::measure::view::{OwnedView, View};
use crate::mechanism::kernels::Mechanism;

/// A state of a mechanism as a [`View`], by a method of the mechanism.
pub trait Viewed: Mechanism {
    /// A state of the bodies at a time (s), to be read by handle: poses, angles, energies.
    ///
    /// Where many states are read, `let constants = mechanism.constants()?` and [`View::new`]
    /// prepare the constants once.
    ///
    /// ```
    /// # use holonom::prelude::*;
    /// # #[derive(Mechanism)]
    /// # #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
    /// # struct Arm {
    /// #     #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 0.0])]
    /// #     rod: Body,
    /// #     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    /// #     shoulder: Revolute,
    /// # }
    /// let (arm, handles) = (Arm::default(), Arm::HANDLES);
    /// let mut state = arm.described_state::<f64>()?;
    /// arm.set_angle(&mut state, handles.shoulder, 0.5)?;
    /// let view = arm.view(0.0, &state)?;
    /// assert!((view.angle(handles.shoulder) - 0.5).abs() < 1e-14);
    /// assert!((view.potential_energy() - 0.5 * 9.81 * 0.5_f64.sin()).abs() < 1e-14);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A parameter that is not acceptable.
    fn view<'a, S: Scalar>(
        &self,
        time: S,
        state: &'a Self::State<S>,
    ) -> Result<OwnedView<'a, S, Self>, ParameterError> {
        Ok(View::of(self.constants()?, time, state))
    }
}

impl<M: Mechanism> Viewed for M {}

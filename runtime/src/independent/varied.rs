//! What changes beside positions: parameters, inputs and rates.

use core::marker::PhantomData;

use nalgebra::SVector;

use super::choice::Coordinate;
use super::directions::{Along, chosen};
use super::elimination::at;
use super::{Equations, IndependentCoordinates};
use crate::error::{Fault, ParameterError, ParameterFault, StepFault};
use crate::math::scalar::Real;
use crate::math::vec3::read;
use crate::math::without_bounds::copied;
use crate::mechanism::handle::ValueHandle;
use crate::mechanism::joint_rates::JointRates;
use crate::mechanism::kernels::is_no_inertia;
use crate::mechanism::report::{BodyKind, ValueInfo};
use crate::state::vector::Array;

/// A quantity that is sought, or along which equilibria are followed: a parameter or an input by
/// its handle, or the rate of a chosen coordinate by [`Varied::rate`].
pub struct Varied<M> {
    quantity: Quantity,
    mechanism: PhantomData<fn() -> M>,
}

#[derive(Clone, Copy, Debug)]
enum Quantity {
    Value(usize),
    /// The place of a rate, and its joint.
    Rate(usize, &'static str),
}

/// The same in chosen coordinates.
#[derive(Clone, Copy)]
pub(super) enum Adjusted {
    /// A parameter, by its place.
    Value(usize),
    /// The rate of a coordinate, by its number.
    Rate(usize),
}

impl From<Adjusted> for Along {
    fn from(quantity: Adjusted) -> Self {
        match quantity {
            Adjusted::Value(place) => Self::Value(place),
            Adjusted::Rate(number) => Self::Rate(number),
        }
    }
}

impl<M: JointRates> Varied<M> {
    /// The rate (rad/s, m/s) of a coordinate, such as the speed of a shaft in steady motion.
    ///
    /// # Errors
    /// [`AnalysisFault::SeveralMotions`],
    /// [`AssemblyFault::CarriesNothing`](crate::error::AssemblyFault::CarriesNothing),
    /// [`AnalysisFault::Carried`]: no such motion.
    ///
    /// [`AnalysisFault::SeveralMotions`]: crate::error::AnalysisFault::SeveralMotions
    /// [`AnalysisFault::Carried`]: crate::error::AnalysisFault::Carried
    pub fn rate(of: impl Coordinate<M>) -> Result<Self, Fault> {
        let (place, joint) = of.place()?;
        Ok(Self {
            quantity: Quantity::Rate(place, joint),
            mechanism: PhantomData,
        })
    }

    /// The name of the parameter, the input or the joint.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self.quantity {
            Quantity::Value(place) => M::REPORT.values.get(place).map_or("", |info| info.name),
            Quantity::Rate(_, joint) => joint,
        }
    }

    pub(super) fn adjusted(self, places: &[usize]) -> Result<Adjusted, Fault> {
        match self.quantity {
            Quantity::Value(place) => Ok(Adjusted::Value(place)),
            Quantity::Rate(place, joint) => chosen(places, (place, joint)).map(Adjusted::Rate),
        }
    }
}

impl<M> From<ValueHandle<M>> for Varied<M> {
    fn from(value: ValueHandle<M>) -> Self {
        Self {
            quantity: Quantity::Value(value.index()),
            mechanism: PhantomData,
        }
    }
}

copied!([M] Varied<M>);

impl<M> core::fmt::Debug for Varied<M> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_tuple("Varied").field(&self.quantity).finish()
    }
}

impl<M: JointRates, const N: usize, S: Real> IndependentCoordinates<M, N, S> {
    /// A parameter or an input, as the equations have it now.
    #[must_use]
    pub fn value(&self, of: ValueHandle<M>) -> S {
        self.parameter(of.index())
    }

    /// Sets one parameter or input, by handle.
    ///
    /// Where a parameter changes a closed loop, former states do not satisfy the constraints any
    /// more: [`IndependentCoordinates::state_near`](Self::state_near) closes the loop again.
    ///
    /// # Errors
    /// [`Fault::Parameter`] for a number that is not finite, or with which a mass or a moment of
    /// inertia is not positive, three moments are those of no body, or a direction has no length.
    /// The former number then stays.
    pub fn set_value(&mut self, of: ValueHandle<M>, value: S) -> Result<(), Fault> {
        self.set_parameter(of.index(), value)
    }

    /// Sets several. Where all of them are inputs, what depends on inputs is computed once.
    #[cfg(feature = "std")]
    pub(crate) fn set_values(&mut self, of: &[ValueHandle<M>], values: &[S]) -> Result<(), Fault> {
        let mut is_input_set = false;
        for (of, &value) in of.iter().zip(values) {
            let Some((info, former)) = self.put(of.index(), value)? else {
                continue;
            };
            if info.is_input {
                is_input_set = true;
            } else {
                self.prepare(info, of.index(), former)?;
            }
        }
        if is_input_set {
            self.take_inputs();
        }
        Ok(())
    }

    pub(crate) fn parameter(&self, place: usize) -> S {
        let known = self.parameters.as_slice().get(place);
        known.copied().unwrap_or(S::zero())
    }

    fn set_parameter(&mut self, place: usize, value: S) -> Result<(), Fault> {
        let Some((info, former)) = self.put(place, value)? else {
            return Ok(());
        };
        if info.is_input {
            self.take_inputs();
            return Ok(());
        }
        self.prepare(info, place, former)
    }

    /// Puts a number in its place; what it is, and the former one.
    fn put(&mut self, place: usize, value: S) -> Result<Option<(&'static ValueInfo, S)>, Fault> {
        let info = M::REPORT.values.get(place);
        let number = self.parameters.as_mut_slice().get_mut(place);
        let (Some(info), Some(number)) = (info, number) else {
            return Ok(None);
        };
        if !value.is_finite() {
            return Err(Fault::Parameter(ParameterError {
                field: info.name,
                attribute: "value",
                fault: ParameterFault::NotFinite,
            }));
        }
        Ok(Some((info, core::mem::replace(number, value))))
    }

    fn take_inputs(&mut self) {
        M::take_inputs(&self.parameters, &mut self.constants);
        M::take_joint_inputs(&self.parameters, &mut self.equations.constants);
    }

    /// Prepares for a parameter that was put; the former one, where it is refused.
    fn prepare(&mut self, info: &ValueInfo, place: usize, former: S) -> Result<(), Fault> {
        let constants = M::prepare(&self.parameters);
        if let Some(fault) = refused::<M, S>(info.name, &constants) {
            if let Some(number) = self.parameters.as_mut_slice().get_mut(place) {
                *number = former;
            }
            return Err(Fault::Parameter(fault));
        }
        self.constants = constants;
        let Equations { places, time, .. } = self.equations;
        self.equations = Equations::prepared((&self.parameters, &self.constants), places, time);
        self.describe();
        Ok(())
    }

    /// What a quantity is now, of a motion at these rates.
    pub(super) fn present(&self, of: Adjusted, rates: &SVector<S, N>) -> S {
        match of {
            Adjusted::Value(place) => self.parameter(place),
            Adjusted::Rate(number) => rates.get(number).copied().unwrap_or(S::zero()),
        }
    }

    /// Sets it.
    pub(super) fn adjust(
        &mut self,
        of: Adjusted,
        value: S,
        rates: &mut SVector<S, N>,
    ) -> Result<(), Fault> {
        match of {
            Adjusted::Value(place) => self.set_parameter(place, value),
            Adjusted::Rate(_) if !value.is_finite() => Err(Fault::Step(StepFault::StateNotFinite)),
            Adjusted::Rate(number) => {
                if let Some(rate) = rates.get_mut(number) {
                    *rate = value;
                }
                Ok(())
            }
        }
    }
}

/// What no mechanism can have, of a value: masses and moments of inertia of no body, and constants
/// that are not finite, as of a direction of length zero.
fn refused<M: JointRates, S: Real>(
    value: &'static str,
    constants: &M::Constants<S>,
) -> Option<ParameterError> {
    let mass = M::mass(constants);
    let bodies = M::REPORT.bodies.iter().enumerate();
    for (_, body) in bodies.filter(|(place, _)| !M::AS_GIVEN.contains(place)) {
        let [m, _, _, moments @ ..]: [S; 6] = match body.kind {
            BodyKind::Rigid => read(mass.as_slice(), body.velocity),
            BodyKind::Particle => [at(mass.as_slice(), body.velocity); 6],
        };
        let of_body = |attribute, fault| ParameterError {
            field: body.name,
            attribute,
            fault,
        };
        if m <= S::zero() {
            return Some(of_body("mass", ParameterFault::NotPositive));
        }
        let [a, b, c] = moments.map(Real::to_f64);
        if a.min(b).min(c) <= 0.0 {
            return Some(of_body("inertia", ParameterFault::NotPositive));
        }
        if is_no_inertia(a, b, c) {
            return Some(of_body("inertia", ParameterFault::TriangleInequality));
        }
    }
    let is_finite = constants.as_slice().iter().all(|number| number.is_finite());
    (!is_finite).then_some(ParameterError {
        field: value,
        attribute: "value",
        fault: ParameterFault::NotFinite,
    })
}

//! Motions in closed form as problems.

use holonom::{
    Fault, JointCoordinates, MechanismExt as _, Real, StateParts as _, View, integrate::TimeSpan,
    state::Array as _,
};
use holonom_study::pendulum::wrapped;
use holonom_study::trade::{Problem, Quantity};

/// A mechanism whose motion is known.
pub trait ClosedForm: JointCoordinates {
    /// Whether its values are angles, which count modulo a whole turn.
    const ARE_ANGLES: bool = true;

    /// What is read.
    fn read<S: Real>(&self, view: &View<'_, S, Self>) -> Vec<f64>;

    /// What that should be at a time (s).
    fn exact(&self, time: f64) -> Vec<f64>;
}

/// A motion of a mechanism from zero to an end, compared at twenty times.
#[derive(Clone, Copy, Debug)]
pub struct Case<M> {
    /// What moves.
    pub mechanism: M,
    /// How long (s).
    pub end: f64,
    /// The period (s) of its fastest motion.
    pub period: f64,
    /// By how much (m) the first body is put along y from where it should start.
    pub displaced: f64,
}

impl<M: ClosedForm> Problem for Case<M> {
    type Mechanism = M;

    fn name(&self) -> &str {
        std::any::type_name::<M>()
            .rsplit("::")
            .next()
            .unwrap_or_default()
    }

    fn mechanism(&self) -> &M {
        &self.mechanism
    }

    fn start(&self) -> Result<M::State<f64>, Fault> {
        let mut state = self.mechanism.described_state()?;
        if let Some(y) = state.coordinates_mut().as_mut_slice().get_mut(1) {
            *y += self.displaced;
        }
        Ok(state)
    }

    fn span(&self) -> TimeSpan<f64> {
        TimeSpan {
            start: 0.0,
            end: self.end,
            first_output: self.end / 20.0,
        }
    }

    fn time_scale(&self) -> f64 {
        self.period
    }

    fn quantity(&self) -> Quantity {
        Quantity {
            name: "value",
            unit: "1",
        }
    }

    fn read<S: Real>(&self, view: &View<'_, S, M>) -> Vec<f64> {
        self.mechanism.read(view)
    }

    fn reference(&self, time: f64) -> Option<Vec<f64>> {
        Some(self.mechanism.exact(time))
    }

    fn difference(&self, read: &[f64], reference: &[f64]) -> f64 {
        let pairs = read.iter().zip(reference);
        let sizes = pairs.map(|(a, b)| {
            if M::ARE_ANGLES {
                wrapped(a - b).abs()
            } else {
                (a - b).abs()
            }
        });
        // NaN stays.
        sizes.fold(0.0, |largest, x| if x <= largest { largest } else { x })
    }
}

/// The angle from the downward vertical of a place (m) seen from the hinge.
pub(super) fn hanging<S: Real>(y: S, z: S) -> f64 {
    y.to_f64().atan2(-z.to_f64())
}

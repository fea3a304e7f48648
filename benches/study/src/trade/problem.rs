//! A motion to measure a trade on.

use holonom::{Fault, Mechanism, MechanismExt as _, Real, View, integrate::TimeSpan};

/// A motion of a mechanism: what is moved, for how long, what is read of it, and what that should
/// be.
///
/// ```
/// use holonom::joints::Revolute;
/// use holonom::prelude::*;
/// use holonom::{Real, View, integrate::TimeSpan};
/// use holonom_study::trade::{Posed, Problem, Quantity, Subject};
///
/// #[derive(Mechanism)]
/// #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
/// struct Arm {
///     #[body(mass = 2.0, inertia = [0.1, 0.01, 0.1], position = [0.0, 0.3, 0.0])]
///     arm: Body,
///     #[joint(between = [ground, arm], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
///     shoulder: Revolute,
/// }
///
/// struct Swing(Arm);
///
/// impl Problem for Swing {
///     type Mechanism = Arm;
///
///     fn name(&self) -> &str {
///         "arm"
///     }
///     fn mechanism(&self) -> &Arm {
///         &self.0
///     }
///     fn span(&self) -> TimeSpan<f64> {
///         TimeSpan { start: 0.0, end: 5.0, first_output: 0.1 }
///     }
///     fn time_scale(&self) -> f64 {
///         1.5
///     }
///     fn quantity(&self) -> Quantity {
///         Quantity { name: "angle", unit: "rad" }
///     }
///     fn read<S: Real>(&self, view: &View<'_, S, Arm>) -> Vec<f64> {
///         vec![view.angle(Arm::HANDLES.shoulder).to_f64()]
///     }
/// }
///
/// let subject = Posed::in_both(Swing(Arm::default()));
/// assert_eq!(subject.facts().name, "arm");
/// ```
pub trait Problem {
    /// What is moved.
    type Mechanism: Mechanism;

    /// Its name, of letters, digits, `-` and `_`: of its files, and after `--problem`.
    fn name(&self) -> &str;

    /// A sentence for the reader: what is moved, and where its reference comes from.
    fn title(&self) -> String {
        self.name().into()
    }

    /// What is moved.
    fn mechanism(&self) -> &Self::Mechanism;

    /// Where it starts: as the mechanism describes it.
    ///
    /// # Errors
    /// A parameter that is not acceptable.
    fn start(&self) -> Result<<Self::Mechanism as Mechanism>::State<f64>, Fault> {
        Ok(self.mechanism().described_state()?)
    }

    /// From when to when (s), and the interval between the times at which it is compared.
    fn span(&self) -> TimeSpan<f64>;

    /// About the period (s) of the fastest motion that matters: the longest step that is tried is a
    /// quarter of it.
    fn time_scale(&self) -> f64;

    /// What an error is of.
    fn quantity(&self) -> Quantity;

    /// What is compared, at one time: any number of values, in that unit.
    fn read<S: Real>(&self, view: &View<'_, S, Self::Mechanism>) -> Vec<f64>;

    /// What should be read at a time (s): a closed form or a published value; `None` where nothing
    /// is known. Where nothing is known at any time of a run, the study integrates the motion
    /// twice, in ways that have little in common, and takes one for the reference and the other for
    /// its error.
    fn reference(&self, time: f64) -> Option<Vec<f64>> {
        let _ = time;
        None
    }

    /// The error of a reading: the largest difference of a value.
    fn difference(&self, read: &[f64], reference: &[f64]) -> f64 {
        let differences = read.iter().zip(reference).map(|(a, b)| (a - b).abs());
        // NaN stays.
        differences.fold(0.0, |largest, x| if x <= largest { largest } else { x })
    }

    /// Whether every integrator is compiled for this mechanism alone when runs are timed, as in a
    /// user's program, and not once for all formulations, which takes some nanoseconds more an
    /// evaluation. For mechanisms of few operations, where these count.
    const IS_INLINED: bool = false;
}

/// What an error is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// Its name.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
}

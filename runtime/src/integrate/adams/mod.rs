//! The methods of Adams of order 1 to 12 with control of step and order.

mod choice;
mod coefficients;
mod integration;

pub use integration::AdamsIntegration;

use super::controlled::controlled;

controlled! {
    /// The predictor-corrector methods of Adams of order 1 to 12 in divided differences: step and
    /// order are chosen for the tolerance, as in MATLAB's `ode113`. Two evaluations a step,
    /// whatever the order, and one for a step that is rejected: for motions that are smooth, where
    /// an evaluation takes time.
    ///
    /// Shampine and Gordon, *Computer Solution of Ordinary Differential Equations* (1975),
    /// subroutines STEP and INTRP, with the norm, the first step and the limits of MATLAB's suite
    /// (Shampine and Reichelt, *The MATLAB ODE Suite*, SIAM J. Sci. Comput. 18 (1997), 1-22).
    /// Predicted by the formula of order `k`, evaluated, corrected by that of order `k + 1` and
    /// evaluated again:
    ///
    /// - it begins at order 1 with `0.25 sqrt(rtol) / max |y'| / max(|y|, atol / rtol)`, at most
    ///   `T / 10` and the time to the first output, then doubles the step and raises the order
    ///   until an error forbids it;
    /// - error `h max |E| / max(|y|, |y predicted|, atol / rtol)`, accepted up to `rtol`; after a
    ///   rejection half the step, from the third on order 1;
    /// - the order goes where the estimate of the error is least, the step is kept, doubled, or
    ///   made smaller to between a half and nine tenths;
    /// - largest step `T / 10`, smallest `16 ulp(t)`; the last step is stretched to the end of the
    ///   interval if `1.1 h` reaches it. No evaluation lies beyond the end;
    /// - a trial whose rates cannot be computed counts as rejected, and the integration ends with
    ///   that fault only where the step gets too small.
    ///
    /// Output within a step is by the polynomial through the slopes that the corrector has used,
    /// and costs no evaluation. A state that was corrected after a step (a projection) costs one
    /// evaluation more; order and step go on.
    ///
    /// ```
    /// use holonom::{Adams, Tolerance};
    ///
    /// let ode113 = Adams::new(Tolerance { relative: 1e-6, absolute: 1e-9 });
    /// assert_eq!(ode113, Adams::default());
    /// ```
    Adams, AdamsIntegration
}

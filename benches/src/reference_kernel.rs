//! The reference kernel of all times: the rod pendulum of chapter 15, written by hand as a careful
//! person would.
//!
//! Positions and Euler parameters of length 1, point rows along global axes, angular velocities
//! along the rod's own axes. The masses are eliminated first, which leaves
//! `(D M^-1 D^T) lambda = D M^-1 g - gamma`, five by five, solved by `L D L^T` without a loop; then
//! `u' = M^-1 (g - D^T lambda)`. What is zero or known is left out, common factors are taken out,
//! products are added by [`Scalar::fused`], as generated code does it. Nothing beyond that: no row
//! is turned to where it would be simpler, `A^T A = I` is not used.

use std::hint::black_box;

use holonom::error::StepFault;
use holonom::{Fault, Real, Scalar, error::NotFinite, integrate::System, state::Vector as _};
use holonom_study::StudyError;
use holonom_study::compare::measure::{Subject, candidates};
use holonom_study::timing::Candidate;

use crate::baselines::START;

/// `x = (r, p, v, w)` of the rod: position (m, global), Euler parameters, velocity (m/s, global),
/// angular velocity (rad/s, body axes).
pub type State<S> = [S; 13];

/// Mass (kg).
const MASS: f64 = 7.02;
/// Moment of inertia across the rod (kg m^2).
const ACROSS: f64 = 0.585_526_5;
/// Moment of inertia about the rod (kg m^2).
const ALONG: f64 = 0.001_053;
/// From the hinge to the centre of mass (m).
const ARM: f64 = 0.5;
/// Gravity along -z (m/s^2).
const GRAVITY: f64 = 9.81;

/// The slope of a state and the multipliers of the hinge: three for its point along global axes,
/// two for its axis.
#[inline(always)]
#[must_use]
pub fn evaluate<S: Scalar>(state: &State<S>) -> (State<S>, [S; 5]) {
    let [_, _, _, e0, e1, e2, e3, vx, vy, vz, w1, w2, w3] = *state;
    let constant = S::constant;

    // The rotation matrix from its doubled vector part.
    let (d1, d2, d3) = (e1 + e1, e2 + e2, e3 + e3);
    let (d11, d22, d33) = (d1 * e1, d2 * e2, d3 * e3);
    let (d01, d02, d03) = (d1 * e0, d2 * e0, d3 * e0);
    let (d12, d13, d23) = (d1 * e2, d1 * e3, d2 * e3);
    let one = S::one();
    let a11 = one - (d22 + d33);
    let a22 = one - (d11 + d33);
    let a33 = one - (d11 + d22);
    let (a12, a21) = (d12 - d03, d12 + d03);
    let (a13, a31) = (d13 + d02, d13 - d02);
    let (a23, a32) = (d23 - d01, d23 + d01);

    // The first columns of `D M^-1 D^T`: the rows of the hinge's point are (1, -h a3, 0, h a1) in
    // (v, w), those of its axis (0, 0, -a_3, a_2).
    let arm = constant(ARM * ARM / ACROSS);
    let inverse_mass = constant(1.0 / MASS);
    let (k11, k21, k31) = (arm * a11, arm * a21, arm * a31);
    let (k13, k23, k33) = (arm * a13, arm * a23, arm * a33);
    let s11 = k11.fused(a11, k13.fused(a13, inverse_mass));
    let s21 = k21.fused(a11, k23 * a13);
    let s31 = k31.fused(a11, k33 * a13);
    let s22 = k21.fused(a21, k23.fused(a23, inverse_mass));
    let s32 = k31.fused(a21, k33 * a23);
    let s33 = k31.fused(a31, k33.fused(a33, inverse_mass));
    let lever = constant(ARM / ACROSS);
    let (m4, m5) = (lever * a22, lever * a32);
    let (s41, s42, s43) = (m4 * a11, m4 * a21, m4 * a31);
    let (s51, s52, s53) = (m5 * a11, m5 * a21, m5 * a31);
    let (across, along) = (constant(1.0 / ACROSS), constant(1.0 / ALONG));
    let (j42, j43) = (across * a22, along * a23);
    let s44 = j42.fused(a22, j43 * a23);
    let s54 = j42.fused(a32, j43 * a33);
    let s55 = (across * a32).fused(a32, (along * a33) * a33);

    // `M^-1 g`: gravity, and the gyroscopic moment over the inertia, `c (-w2 w3, 0, w1 w2)`.
    let (w12, w13, w23) = (w1 * w2, w1 * w3, w2 * w3);
    let (w11, w22, w33) = (w1 * w1, w2 * w2, w3 * w3);
    let slender = constant((ACROSS - ALONG) / ACROSS);
    let (n1, n3) = (-(slender * w23), slender * w12);
    let weight = constant(-GRAVITY);

    // `-gamma`: what `w x (w x s)` of the point and of the axis does to the rows.
    let half = constant(ARM);
    let (q1, q2, q3) = (-(half * w12), half * (w11 + w33), -(half * w23));
    let g1 = a11.fused(q1, a12.fused(q2, a13 * q3));
    let g2 = a21.fused(q1, a22.fused(q2, a23 * q3));
    let g3 = a31.fused(q1, a32.fused(q2, a33 * q3));
    let c1 = -(w22 + w33);
    let g4 = a21.fused(c1, a22.fused(w12, a23 * w13));
    let g5 = a31.fused(c1, a32.fused(w12, a33 * w13));

    // `D M^-1 g - gamma`.
    let (h1, h3) = (-(half * n1), half * n3);
    let b1 = a11.fused(h3, a13.fused(h1, g1));
    let b2 = a21.fused(h3, a23.fused(h1, g2));
    let b3 = a31.fused(h3, a33.fused(h1, g3 + weight));
    let b4 = a22.fused(n3, g4);
    let b5 = a32.fused(n3, g5);

    // `L D L^T`: the columns before division, then divided.
    let i1 = s11.reciprocal();
    let (l21, l31, l41, l51) = (s21 * i1, s31 * i1, s41 * i1, s51 * i1);
    let t22 = (-l21).fused(s21, s22);
    let t32 = (-l31).fused(s21, s32);
    let t42 = (-l41).fused(s21, s42);
    let t52 = (-l51).fused(s21, s52);
    let t33 = (-l31).fused(s31, s33);
    let t43 = (-l41).fused(s31, s43);
    let t53 = (-l51).fused(s31, s53);
    let t44 = (-l41).fused(s41, s44);
    let t54 = (-l51).fused(s41, s54);
    let t55 = (-l51).fused(s51, s55);
    let i2 = t22.reciprocal();
    let (l32, l42, l52) = (t32 * i2, t42 * i2, t52 * i2);
    let t33 = (-l32).fused(t32, t33);
    let t43 = (-l42).fused(t32, t43);
    let t53 = (-l52).fused(t32, t53);
    let t44 = (-l42).fused(t42, t44);
    let t54 = (-l52).fused(t42, t54);
    let t55 = (-l52).fused(t52, t55);
    let i3 = t33.reciprocal();
    let (l43, l53) = (t43 * i3, t53 * i3);
    let t44 = (-l43).fused(t43, t44);
    let t54 = (-l53).fused(t43, t54);
    let t55 = (-l53).fused(t53, t55);
    let i4 = t44.reciprocal();
    let l54 = t54 * i4;
    let t55 = (-l54).fused(t54, t55);
    let i5 = t55.reciprocal();

    // Forwards, and back.
    let y2 = (-l21).fused(b1, b2);
    let y3 = (-l32).fused(y2, (-l31).fused(b1, b3));
    let y4 = (-l43).fused(y3, (-l42).fused(y2, (-l41).fused(b1, b4)));
    let y5 = (-l54).fused(y4, (-l53).fused(y3, (-l52).fused(y2, (-l51).fused(b1, b5))));
    let x5 = y5 * i5;
    let x4 = (-l54).fused(x5, y4 * i4);
    let x3 = (-l43).fused(x4, (-l53).fused(x5, y3 * i3));
    let x2 = (-l32).fused(x3, (-l42).fused(x4, (-l52).fused(x5, y2 * i2)));
    let x1 = (-l21).fused(
        x2,
        (-l31).fused(x3, (-l41).fused(x4, (-l51).fused(x5, b1 * i1))),
    );

    // `u' = M^-1 (g - D^T lambda)`.
    let lighter = -inverse_mass;
    let (rx, ry) = (lighter * x1, lighter * x2);
    let rz = lighter.fused(x3, weight);
    let along_1 = a11.fused(x1, a21.fused(x2, a31 * x3));
    let along_3 = a13.fused(x1, a23.fused(x2, a33 * x3));
    let turn_1 = lever.fused(along_3, n1);
    let turn_2 = along * a23.fused(x4, a33 * x5);
    let turn_3 = (-across).fused(a22.fused(x4, a32 * x5), (-lever).fused(along_1, n3));

    // `p' = 1/2 L^T w`.
    let half = constant(0.5);
    let (h1, h2, h3) = (half * w1, half * w2, half * w3);
    let p0 = -(e1.fused(h1, e2.fused(h2, e3 * h3)));
    let p1 = e0.fused(h1, e2.fused(h3, -(e3 * h2)));
    let p2 = e0.fused(h2, e3.fused(h1, -(e1 * h3)));
    let p3 = e0.fused(h3, e1.fused(h2, -(e2 * h1)));
    let rates = [
        vx, vy, vz, p0, p1, p2, p3, rx, ry, rz, turn_1, turn_2, turn_3,
    ];
    (rates, [x1, x2, x3, x4, x5])
}

/// The reference kernel as a system that integrators move.
#[derive(Clone, Copy, Debug, Default)]
pub struct ReferenceKernel;

impl<S: Real> System<S> for ReferenceKernel {
    type State = State<S>;

    #[inline(always)]
    fn rates(&mut self, _time: S, state: &State<S>) -> Result<State<S>, Fault> {
        let (rates, _) = evaluate(state);
        if rates.is_finite() {
            Ok(rates)
        } else {
            Err(Fault::Step(StepFault::RatesNotFinite {
                origin: NotFinite::Unknown,
            }))
        }
    }

    #[inline(always)]
    fn stage(&mut self, _time: S, state: &State<S>, rates: &mut State<S>) -> Result<(), Fault> {
        *rates = evaluate(state).0;
        Ok(())
    }
}

/// The reference kernel as a candidate: the bare function, which no interface stands before.
#[derive(Clone, Copy, Debug, Default)]
pub struct Written(ReferenceKernel);

impl<S: Real> Subject<S> for Written {
    type System = ReferenceKernel;
    type Evaluation = (State<S>, [S; 5]);

    #[inline(always)]
    fn system(&mut self) -> &mut ReferenceKernel {
        &mut self.0
    }

    fn place(&self) -> Self::Evaluation {
        ([S::zero(); 13], [S::zero(); 5])
    }

    #[inline(always)]
    fn evaluate(&self, state: &State<S>, place: &mut Self::Evaluation) -> Result<(), Fault> {
        *place = evaluate(state);
        Ok(())
    }

    #[inline(always)]
    fn rates((rates, _): &(State<S>, [S; 5])) -> &State<S> {
        rates
    }

    #[inline(always)]
    fn kernel(&mut self, state: &State<S>, rates: &mut State<S>) {
        let multipliers;
        (*rates, multipliers) = evaluate(state);
        black_box(&multipliers);
    }
}

/// The reference kernel, to be timed beside others.
///
/// # Errors
/// [`StudyError::Run`], were it not to run.
pub fn candidate() -> Result<Candidate<'static>, StudyError> {
    let candidates = candidates::<f64, _>(Written::default(), START, 1e-3);
    let candidates = candidates.map_err(|fault| StudyError::Run {
        name: "reference kernel".into(),
        reason: fault.to_string(),
    })?;
    Ok(candidates.throughput)
}

//! Motions of these mechanisms with known answers, for the studies of `holonom-study`: what is
//! moved, for how long, what is read, and what that should be.
//!
//! | problem | motion | what is compared | reference |
//! |---|---|---|---|
//! | [`Pendulum`] | the rod of chapter 15, 10 s | angle (rad), every 0.5 s | closed form |
//! | [`LongPendulum`] | A01, a point mass, 2000 s | place (m), every 10 s | closed form |
//! | [`Parallelogram`], [`DoubleParallelogram`], [`QuintupleParallelogram`] | A02 with one, two and five windows, 10 s, ten times through a singular configuration | place (m) and velocity (m/s) of a pin, every 0.1 s | closed form |
//! | [`Squeezer`] | A03, 30 ms | seven angles (rad) at the end | two integrations in minimal coordinates |
//! | [`Ring`] | A04, Bricard's mechanism, 10 s | place (m) of a corner at 1, 2, 5, 10 s | a model of one angle |
//! | [`Governor`] | A05, 10 s, stiff | height (m) of the slider at 0.5, 1, 2, 5, 10 s | Radau and Dormand-Prince 8(5,3) in minimal coordinates |
//! | [`Top`] | C01, a top of 150 rad/s, 2 s | place (m) at 1 and 2 s | integrations in minimal coordinates |
//! | [`Slide`] | D02, the variable-length pendulum, 5 s | angle (rad) and length (m) at 1, 2, 5 s | two integrations of two coordinates |
//! | [`Crank`] | D03, a slider-crank of 150 rad/s, 0.2 s | angle of the crank (rad), place of the slider (m), at 0.1 and 0.2 s | two integrations of a minimal model |
//! | [`Chain`] | E02, a ratio of masses of 1e6, 1 s | place of the bob (m) at the end | tensions and angles |
//! | [`Leaf`] | E04, a door on two hinges, 10 s | angle (rad), every 0.1 s | closed form |
//!
//! The integrated references agree with each other to 1e-11 or better. Those of the pendulum and of
//! the parallelograms are there with their models, all others with the whole `catalogue`.

#[cfg(feature = "catalogue")]
mod loops;
#[cfg(feature = "catalogue")]
mod others;
#[cfg(feature = "four-bar")]
mod parallelograms;
mod pendulum;
#[cfg(feature = "catalogue")]
mod pendulums;

#[cfg(feature = "catalogue")]
pub use loops::{Crank, Ring, Squeezer};
#[cfg(feature = "catalogue")]
pub use others::{Chain, Governor, Slide, Top};
#[cfg(feature = "four-bar")]
pub use parallelograms::Parallelogram;
#[cfg(feature = "four-bars")]
pub use parallelograms::{DoubleParallelogram, QuintupleParallelogram};
pub use pendulum::Pendulum;
#[cfg(feature = "catalogue")]
pub use pendulums::{Leaf, LongPendulum};

/// A problem in a few lines. Behind `angles` values count modulo a whole turn.
macro_rules! problem {
    (
        $(#[$attribute:meta])*
        $name:ident: $mechanism:ty = $key:literal, $title:literal;
        0 to $end:literal s every $reporting:literal s, time scale $scale:literal s;
        $quantity:literal ($unit:literal) $($angles:ident)?;
        $view:ident => $read:expr;
        $time:ident => $reference:expr;
        $(inlined $inlined:literal;)?
    ) => {
        $(#[$attribute])*
        #[derive(Clone, Copy, Debug, Default)]
        pub struct $name($mechanism);

        impl holonom_study::trade::Problem for $name {
            type Mechanism = $mechanism;
            $(const IS_INLINED: bool = $inlined;)?

            fn name(&self) -> &str {
                $key
            }

            fn title(&self) -> std::string::String {
                $title.into()
            }

            fn mechanism(&self) -> &$mechanism {
                &self.0
            }

            fn span(&self) -> holonom::integrate::TimeSpan<f64> {
                holonom::integrate::TimeSpan { start: 0.0, end: $end, first_output: $reporting }
            }

            fn time_scale(&self) -> f64 {
                $scale
            }

            fn quantity(&self) -> holonom_study::trade::Quantity {
                holonom_study::trade::Quantity { name: $quantity, unit: $unit }
            }

            fn read<S: holonom::Real>(
                &self,
                $view: &holonom::View<'_, S, $mechanism>,
            ) -> std::vec::Vec<f64> {
                $read.into()
            }

            fn reference(&self, $time: f64) -> Option<std::vec::Vec<f64>> {
                let known: Option<std::vec::Vec<f64>> = $reference;
                known
            }

            $(fn difference(&self, read: &[f64], reference: &[f64]) -> f64 {
                $crate::problems::$angles(read, reference)
            })?
        }
    };
}
use problem;

/// The largest difference of angles, modulo a whole turn.
#[cfg(feature = "catalogue")]
fn angles(read: &[f64], reference: &[f64]) -> f64 {
    let differences = read.iter().zip(reference);
    let sizes = differences.map(|(a, b)| holonom_study::pendulum::wrapped(a - b).abs());
    sizes.fold(0.0, |largest, x| if x <= largest { largest } else { x })
}

/// The value of the instant at this time, of those where something is known.
#[cfg(feature = "catalogue")]
fn at<const N: usize>(time: f64, known: &[(f64, [f64; N])]) -> Option<std::vec::Vec<f64>> {
    /// Of times in single precision.
    const SAME: f64 = 1e-6;
    let here = |&&(then, _): &&(f64, [f64; N])| (then - time).abs() <= SAME * then;
    known.iter().find(here).map(|(_, values)| values.to_vec())
}

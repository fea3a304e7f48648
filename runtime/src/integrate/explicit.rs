//! Explicit Runge-Kutta methods, each written as its table.

/// An explicit Runge-Kutta method from its Butcher tableau.
///
/// ```text
/// slopes { first, inner [..], kept [..] }   their names; a step leaves those that it keeps to
///                                           the error and to the interpolant
/// stages { c => slope { slope: a, .. }, .. }
/// result { slope: b, .. }
/// error POWER, last { slope: b - b_hat, .. }  of an embedded pair; `last` is the slope at the end
/// within last { slope: [d1, d2, ..], .. }     weights of slopes within a step, see [`polynomial`];
///                                             the cubic through both ends where there is none
/// model { angle_error: .., .. }               what its `ErrorModel` has of its own
/// items { .. }                                functions of `Scheme` that no table gives
/// ```
///
/// Every stage is code of its own: the compiler sees numbers in the place of a table, and sums
/// have as many terms as there are entries. A sum adds its terms in the order of the table.
macro_rules! explicit {
    (@count [$($slope:ident),*]) => {{
        const NAMES: &[&str] = &[$(stringify!($slope)),*];
        NAMES.len()
    }};
    (@memory $like:ident []) => {{
        let _ = $like;
        []
    }};
    // Not by a function for each, whose array is copied.
    (@memory $like:ident [$($slope:ident),*]) => {
        [$({
            let $slope = $like.clone();
            $slope
        }),*]
    };
    (
        $(#[$about:meta])*
        $method:ident;
        slopes { $first:ident, inner [$($inner:ident),*], kept $kept:tt }
        stages { $($time:expr => $stage:ident { $($slope:ident: $a:expr),+ $(,)? })* }
        result { $($end:ident: $b:expr),+ $(,)? }
        $(error $power:expr, $last:ident { $($missed:ident: $e:expr),+ $(,)? })?
        $(within $to:ident { $($within:ident: $d:expr),+ $(,)? })?
        model { $($constant:ident: $value:expr),* $(,)? }
        $(items { $($item:tt)* })?
    ) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct $method;

        const _: () = {
            use crate::error::Fault;
            use crate::integrate::{Look, OneStep, Scheme, Slopes, StepStart, System};
            use crate::math::scalar::Scalar;
            use crate::state::vector::Vector;

            impl<S: Scalar> Scheme<S> for $method {
                type Stages<X: Vector<S>> = [X; explicit!(@count $kept)];

                fn stages<X: Vector<S>>(&self, like: &X) -> Self::Stages<X> {
                    explicit!(@memory like $kept)
                }

                $(
                    fn interpolate<X: Vector<S>>(
                        &self,
                        record: crate::integrate::StepRecord<'_, S, X, Self::Stages<X>>,
                        theta: S,
                    ) -> X {
                        let ($first, $to) = (record.first, record.last);
                        let $kept = record.stages;
                        let step = record.step;
                        let weight = |row| crate::integrate::dense::polynomial(row, step, theta);
                        record.from.plus([$((weight($d), $within)),+])
                    }
                )?

                fn error_model(&self) -> crate::integrate::ErrorModel {
                    crate::integrate::ErrorModel {
                        $($constant: $value,)*
                        ..Default::default()
                    }
                }

                fn tableau(&self) -> Option<crate::integrate::Tableau> {
                    use crate::integrate::tableau::place;

                    const NAMES: &[&str] = &[stringify!($first), $(stringify!($stage)),*];
                    const TABLEAU: crate::integrate::Tableau = crate::integrate::Tableau {
                        stages: &[$(&[$((place(NAMES, stringify!($slope)), $a)),+]),*],
                        result: &[$((place(NAMES, stringify!($end)), $b)),+],
                    };
                    Some(TABLEAU)
                }

                $($($item)*)?
            }

            impl<S: Scalar, Y: System<S>> OneStep<S, Y> for $method {
                #[inline]
                fn advanced<L: Look<S, Y::State>>(
                    &self,
                    system: &mut Slopes<'_, Y, L>,
                    start: StepStart<'_, S, Y::State>,
                    step: S,
                    kept: &mut <Self as Scheme<S>>::Stages<Y::State>,
                ) -> Result<Y::State, Fault> {
                    let StepStart { time, state, slope: $first } = start;
                    let $kept = kept;
                    $(
                        let mut $inner = crate::integrate::room_for($first);
                        let $inner = &mut $inner;
                    )*
                    $(
                        let terms = [$((S::constant($a) * step, &*$slope)),+];
                        let at = S::constant($time).fused(step, time);
                        system.stage(at, &state.plus(terms), $stage)?;
                    )*
                    Ok(state.plus([$((S::constant($b) * step, &*$end)),+]))
                }
            }

            $(
                impl<S: crate::math::scalar::Real> crate::integrate::EmbeddedPair<S> for $method {
                    const POWER: f64 = $power;

                    #[inline]
                    fn error<X: Vector<S>>(
                        &self,
                        record: &crate::integrate::StepRecord<'_, S, X, Self::Stages<X>>,
                        floor: S,
                    ) -> S {
                        let ($first, $last) = (record.first, record.last);
                        let $kept = record.stages;
                        let terms = [$((S::constant($e) * record.step, $missed)),+];
                        record.from.weighted_norm(record.to, floor, terms)
                    }
                }
            )?
        };
    };
}
pub(super) use explicit;

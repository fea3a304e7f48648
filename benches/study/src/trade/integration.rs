//! An integrator that is chosen at run time, as one type: what is compiled for a mechanism does not
//! grow with the number of integrators.

use holonom::{
    Fault, Heun, ImplicitMidpoint, Kutta3, Midpoint, Real, Rk4, SemiImplicitEuler, Tolerance,
    integrate::{
        AdamsFixedIntegration, AdamsIntegration, AdaptiveIntegration, Advance, AlphaEnd, AlphaStep,
        BdfIntegration, BogackiShampine3, Counts, DormandPrince5, DormandPrince8, FixedIntegration,
        GeneralizedAlphaIntegration, Integration, Integrator, Memory, Method, RadauIntegration,
        RigidConstraints, SecondOrder, System, TimeSpan,
    },
    state::Vector,
};

use super::movable::Movable;
use crate::chapter15::Method as Formulated;
use crate::compare::Coordinates;
use crate::format::two_digits;

/// The integrators: one row is all that this study knows of one.
///
/// ```text
/// /// What it is.
/// name in the enumeration: "name in JSON", order, Type::constructor(setting), kind, integration;
/// ```
///
/// The setting is a `step` or a `tolerance_of`. Methods that do much `beside` their evaluations are
/// not compiled as their own type for what is timed; an integration with large matrices is in a
/// `Box`.
macro_rules! integrators {
    ($dollar:tt $(
        $(#[$about:meta])*
        $family:ident: $key:literal, $order:literal,
            $method:ident::$new:ident($setting:ident), $kind:ident, $integration:ty;
    )*) => {
        /// A method of integration.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Family {
            $($(#[$about])* $family,)*
        }

        impl Family {
            /// All of them, those of fixed steps first.
            pub const ALL: [Self; [$($order),*].len()] = [$(Self::$family),*];

            /// The name in JSON and on the command line, and for a reader.
            #[must_use]
            pub const fn key(self) -> &'static str {
                match self { $(Self::$family => $key),* }
            }

            /// The name in `holonom`.
            pub(super) const fn name(self) -> &'static str {
                match self { $(Self::$family => stringify!($method)),* }
            }

            /// Whether it chooses its steps by a tolerance.
            #[must_use]
            pub fn is_adaptive(self) -> bool {
                match self { $(Self::$family => stringify!($setting) == "tolerance_of"),* }
            }

            /// The power of the step that the error of a motion goes with; of a method of many
            /// orders, the highest.
            #[must_use]
            pub const fn order(self) -> u32 {
                match self { $(Self::$family => $order),* }
            }
        }

        /// An [`IntegratorSetting`] under way.
        pub enum AnyIntegration<S: Real, X: Vector<S>> {
            $(
                #[doc = concat!("Of [`Family::", stringify!($family), "`].")]
                $family($integration),
            )*
        }

        impl IntegratorSetting {
            fn begin<S: Real, X: Vector<S>>(
                self,
                system: &mut Behind<'_, S, X>,
                span: TimeSpan<S>,
                state: X,
            ) -> Result<AnyIntegration<S, X>, Fault> {
                type Of<S, X> = AnyIntegration<S, X>;
                Ok(match self.family {
                    $(Family::$family => {
                        let integrator = holonom::$method::$new(self.$setting());
                        Of::$family(integrator.start(system, span, state)?.into())
                    })*
                })
            }
        }

        /// Calls `$then` with the integrator as its own type; for methods that do much besides
        /// evaluations, `$other` instead if it is given.
        macro_rules! own_type_of {
            ($dollar integration:expr, $dollar integrator:ident => $dollar then:expr
                $dollar (, $dollar other:expr)?) => {
                match $dollar integration.family {
                    $($crate::trade::Family::$family => {
                        $crate::trade::integration::as_own_type!(
                            $kind $dollar (, $dollar other)?; {
                                let $dollar integrator =
                                    holonom::$method::$new($dollar integration.$setting());
                                $dollar then
                            }
                        )
                    })*
                }
            };
        }

        pub(crate) use own_type_of as with_own_type;

        macro_rules! on_integration {
            ($dollar any:expr, $dollar integration:ident => $dollar then:expr) => {
                match $dollar any { $(AnyIntegration::$family($dollar integration) => $dollar then),* }
            };
        }
    };
}

/// What is done for a method of a kind.
macro_rules! as_own_type {
    (beside, $other:expr; $then:expr) => {
        $other
    };
    ($kind:ident $(, $other:expr)?; $then:expr) => {
        $then
    };
}
pub(crate) use as_own_type;

integrators! { $
    /// Semi-implicit Euler, order 1.
    SemiImplicitEuler: "semi-implicit-euler", 1,
        SemiImplicitEuler::every(step), bare, FixedIntegration<S, X, SemiImplicitEuler>;
    /// The midpoint rule, order 2.
    Midpoint: "midpoint", 2, Midpoint::every(step), bare, FixedIntegration<S, X, Midpoint>;
    /// The method of Heun, order 2.
    Heun: "heun", 2, Heun::every(step), bare, FixedIntegration<S, X, Heun>;
    /// The method of Kutta, order 3.
    Kutta3: "kutta-3", 3, Kutta3::every(step), bare, FixedIntegration<S, X, Kutta3>;
    /// The classical method of Runge and Kutta, order 4.
    Rk4: "rk4", 4, Rk4::every(step), bare, FixedIntegration<S, X, Rk4>;
    /// Dormand and Prince at a fixed step, order 5.
    DormandPrinceFixed: "dormand-prince-fixed", 5,
        DormandPrince::every(step), bare, FixedIntegration<S, X, DormandPrince5>;
    /// Dormand and Prince at a fixed step, order 8.
    DormandPrince853Fixed: "dormand-prince-853-fixed", 8,
        DormandPrince853::every(step), bare, FixedIntegration<S, X, DormandPrince8>;
    /// The implicit midpoint rule, order 2.
    ImplicitMidpoint: "implicit-midpoint", 2,
        ImplicitMidpoint::every(step), beside, FixedIntegration<S, X, ImplicitMidpoint>;
    /// Generalized-alpha on rigid constraints with a spectral radius of 0.8, order 2: by bodies
    /// with standard multipliers alone.
    GeneralizedAlpha: "generalized-alpha", 2,
        GeneralizedAlpha::every(step), beside, GeneralizedAlphaIntegration<S, X>;
    /// Adams, Bashforth and Moulton at a fixed step, order 4.
    AdamsBashforthMoulton4: "adams-bashforth-moulton-4", 4,
        AdamsBashforthMoulton4::every(step), bare, AdamsFixedIntegration<S, X>;
    /// Bogacki and Shampine 3(2) under the control of `ode23`.
    BogackiShampine: "bogacki-shampine", 3,
        BogackiShampine::new(tolerance_of), bare, AdaptiveIntegration<S, X, BogackiShampine3>;
    /// Dormand and Prince 5(4) under the control of `ode45`.
    DormandPrince: "dormand-prince", 5,
        DormandPrince::new(tolerance_of), bare, AdaptiveIntegration<S, X, DormandPrince5>;
    /// Dormand and Prince 8(5,3) under the same control.
    DormandPrince853: "dormand-prince-853", 8,
        DormandPrince853::new(tolerance_of), bare, AdaptiveIntegration<S, X, DormandPrince8>;
    /// Adams of order 1 to 12 under the control of `ode113`.
    Adams: "adams", 12, Adams::new(tolerance_of), beside, AdamsIntegration<S, X>;
    /// Backward differentiation of order 1 to 5 under the control of `ode15s`, implicit.
    Bdf: "bdf", 5, Bdf::new(tolerance_of), beside, Box<BdfIntegration<S, X>>;
    /// Radau IIA of order 5 under the control of `RADAU5`, implicit.
    RadauIIA: "radau", 5, RadauIIA::new(tolerance_of), beside, Box<RadauIntegration<S, X>>;
}

impl Family {
    /// The family of a name.
    #[must_use]
    pub fn of(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|family| family.key() == key)
    }

    /// Whether it moves what is described and formulated so: all methods do, but those that solve
    /// for rigid constraints themselves.
    #[must_use]
    pub const fn moves(self, coordinates: Coordinates, formulation: Formulated) -> bool {
        !matches!(self, Self::GeneralizedAlpha)
            || matches!(
                (coordinates, formulation),
                (Coordinates::Bodies, Formulated::Standard)
            )
    }
}

/// The absolute tolerance over the relative one, as `ode45` has them by default and chapter 15 uses
/// them: an element of a state below it, in SI units, counts as if it were so large.
pub const FLOOR: f64 = 1e-3;

/// A method with its step or its tolerance: an [`Integrator`] of any number type.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IntegratorSetting {
    /// The method.
    pub family: Family,
    /// The step (s), or the relative tolerance of a method that chooses its steps; the absolute one
    /// is [`FLOOR`] times that.
    pub step_or_tolerance: f64,
}

impl IntegratorSetting {
    pub(crate) fn step<S: Real>(self) -> S {
        S::constant(self.step_or_tolerance)
    }

    pub(crate) fn tolerance_of<S: Real>(self) -> Tolerance<S> {
        Tolerance {
            relative: S::constant(self.step_or_tolerance),
            absolute: S::constant(FLOOR * self.step_or_tolerance),
        }
    }

    /// As a user writes it.
    #[must_use]
    pub fn code(self) -> String {
        let (name, value) = (self.family.name(), self.step_or_tolerance);
        if self.family.is_adaptive() {
            let absolute = two_digits(FLOOR * value);
            format!("{name}::new(Tolerance {{ relative: {value:e}, absolute: {absolute:e} }})")
        } else {
            format!("{name}::every({value:e})")
        }
    }
}

impl<S: Real> Method<S> for IntegratorSetting {
    holonom::__hooks_of_method!(with_own_type);
}

impl<S: Real, Y: Movable<S>> Integrator<S, Y> for IntegratorSetting {
    type Integration = AnyIntegration<S, Y::State>;

    fn start(
        &self,
        system: &mut Y,
        span: TimeSpan<S>,
        state: Y::State,
    ) -> Result<AnyIntegration<S, Y::State>, Fault> {
        self.begin(&mut Behind { system }, span, state)
    }
}

impl<S: Real, X: Vector<S>> Integration<S, X> for AnyIntegration<S, X> {
    fn time(&self) -> S {
        on_integration!(self, integration => integration.time())
    }

    fn state(&self) -> &X {
        on_integration!(self, integration => integration.state())
    }

    fn estimate(&self) -> Option<S> {
        on_integration!(self, integration => integration.estimate())
    }

    fn replace(&mut self, state: X) {
        on_integration!(self, integration => integration.replace(state));
    }

    fn recount(&mut self, turns: &[S]) {
        on_integration!(self, integration => integration.recount(turns));
    }

    fn counts(&self) -> Counts {
        on_integration!(self, integration => integration.counts())
    }

    fn remember(&mut self, memory: &mut Memory<'_, S>) -> bool {
        on_integration!(self, integration => integration.remember(memory))
    }
}

impl<S: Real, Y: Movable<S>> Advance<S, Y> for AnyIntegration<S, Y::State> {
    fn advance(&mut self, system: &mut Y) -> Result<(), Fault> {
        let system = &mut Behind { system };
        on_integration!(self, integration => integration.advance(system))
    }

    fn at(&mut self, system: &mut Y, time: S) -> Result<Y::State, Fault> {
        let system = &mut Behind { system };
        on_integration!(self, integration => integration.at(system, time))
    }

    fn better_end(&self, system: &mut Y) -> Result<Option<Y::State>, Fault> {
        let system = &mut Behind { system };
        on_integration!(self, integration => integration.better_end(system))
    }
}

/// A system behind a pointer: one type for all systems with such states, so that a method is
/// compiled once for all of them.
struct Behind<'a, S: Real, X: Vector<S>> {
    system: &'a mut dyn WithJacobian<S, State = X>,
}

/// A system whose Jacobian is part of its object.
trait WithJacobian<S: Real>: Movable<S> {
    fn jacobian_of(
        &mut self,
        time: S,
        state: &Self::State,
        rates: &Self::State,
        columns: &mut <Self::State as Vector<S>>::Each<Self::State>,
    ) -> Result<usize, Fault>;
}

impl<S: Real, Y: Movable<S>> WithJacobian<S> for Y {
    fn jacobian_of(
        &mut self,
        time: S,
        state: &Y::State,
        rates: &Y::State,
        columns: &mut <Y::State as Vector<S>>::Each<Y::State>,
    ) -> Result<usize, Fault> {
        self.jacobian(time, state, rates, columns)
    }
}

impl<S: Real, X: Vector<S>> System<S> for Behind<'_, S, X> {
    type State = X;

    fn rates(&mut self, time: S, state: &X) -> Result<X, Fault> {
        self.system.rates(time, state)
    }

    fn stage(&mut self, time: S, state: &X, rates: &mut X) -> Result<(), Fault> {
        self.system.stage(time, state, rates)
    }

    fn diagnose(&mut self, time: S, state: &X) -> Option<Fault> {
        self.system.diagnose(time, state)
    }

    fn jacobian(
        &mut self,
        time: S,
        state: &X,
        rates: &X,
        columns: &mut X::Each<X>,
    ) -> Result<usize, Fault> {
        self.system.jacobian_of(time, state, rates, columns)
    }

    fn follow(&mut self, from: &X, step: S, to: &mut X) {
        self.system.follow(from, step, to);
    }

    fn renormalise(&mut self, state: &mut X, rates: Option<&mut X>) {
        self.system.renormalise(state, rates);
    }
}

impl<S: Real, X: Vector<S>> SecondOrder<S> for Behind<'_, S, X> {
    fn with_new_velocities(&mut self, time: S, state: &X, step: S, rates: &mut X) {
        self.system.with_new_velocities(time, state, step, rates);
    }
}

impl<S: Real, X: Vector<S>> RigidConstraints<S> for Behind<'_, S, X> {
    /// # Panics
    /// Where [`Family::moves`] is not so: nothing asks for such a run.
    fn step_on_constraints(&mut self, asked: AlphaStep<'_, S, X>) -> Result<AlphaEnd<X>, Fault> {
        let solved = self.system.on_constraints(asked);
        solved.expect("generalized-alpha is asked for bodies with standard multipliers alone")
    }
}

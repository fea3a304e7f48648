//! An integrator that is chosen at run time, as one type: what is compiled for a mechanism does not
//! grow with the number of integrators.

use holonom::{
    Fault, Heun, ImplicitMidpoint, Midpoint, Real, Rk4, SemiImplicitEuler, Tolerance,
    integrate::{
        AdamsCourse, AdamsFixedCourse, AdaptiveCourse, AlphaEnd, AlphaStep, BdfCourse,
        BogackiShampine3, Counts, Course, DormandPrince5, DormandPrince8, FixedCourse,
        GeneralizedAlphaCourse, Integrator, RadauCourse, Span, System,
    },
    state::Vector,
};

use super::grid::two_digits;
use crate::chapter15::Method;
use crate::compare::Coordinates;

/// A method of integration.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Family {
    /// Semi-implicit Euler, order 1.
    SemiImplicitEuler,
    /// The midpoint rule, order 2.
    Midpoint,
    /// The method of Heun, order 2.
    Heun,
    /// The classical method of Runge and Kutta, order 4.
    Rk4,
    /// Dormand and Prince at a fixed step, order 5.
    DormandPrinceFixed,
    /// Dormand and Prince at a fixed step, order 8.
    DormandPrince853Fixed,
    /// The implicit midpoint rule, order 2.
    ImplicitMidpoint,
    /// Generalized-alpha on rigid constraints with a spectral radius of 0.8, order 2: by bodies
    /// with standard multipliers alone.
    GeneralizedAlpha,
    /// Adams, Bashforth and Moulton at a fixed step, order 4.
    AdamsBashforthMoulton4,
    /// Bogacki and Shampine 3(2) under the control of `ode23`.
    BogackiShampine,
    /// Dormand and Prince 5(4) under the control of `ode45`.
    DormandPrince,
    /// Dormand and Prince 8(5,3) under the same control.
    DormandPrince853,
    /// Adams of order 1 to 12 under the control of `ode113`.
    Adams,
    /// Backward differentiation of order 1 to 5 under the control of `ode15s`, implicit.
    Bdf,
    /// Radau IIA of order 5 under the control of `RADAU5`, implicit.
    RadauIIA,
}

impl Family {
    /// All of them, those of fixed steps first.
    pub const ALL: [Self; 15] = [
        Self::SemiImplicitEuler,
        Self::Midpoint,
        Self::Heun,
        Self::Rk4,
        Self::DormandPrinceFixed,
        Self::DormandPrince853Fixed,
        Self::ImplicitMidpoint,
        Self::GeneralizedAlpha,
        Self::AdamsBashforthMoulton4,
        Self::BogackiShampine,
        Self::DormandPrince,
        Self::DormandPrince853,
        Self::Adams,
        Self::Bdf,
        Self::RadauIIA,
    ];

    /// The name in JSON and on the command line, and for a reader.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::SemiImplicitEuler => "semi-implicit-euler",
            Self::Midpoint => "midpoint",
            Self::Heun => "heun",
            Self::Rk4 => "rk4",
            Self::DormandPrinceFixed => "dormand-prince-fixed",
            Self::DormandPrince853Fixed => "dormand-prince-853-fixed",
            Self::ImplicitMidpoint => "implicit-midpoint",
            Self::GeneralizedAlpha => "generalized-alpha",
            Self::AdamsBashforthMoulton4 => "adams-bashforth-moulton-4",
            Self::BogackiShampine => "bogacki-shampine",
            Self::DormandPrince => "dormand-prince",
            Self::DormandPrince853 => "dormand-prince-853",
            Self::Adams => "adams",
            Self::Bdf => "bdf",
            Self::RadauIIA => "radau",
        }
    }

    /// The family of a name.
    #[must_use]
    pub fn of(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|family| family.key() == key)
    }

    /// Whether it chooses its steps by a tolerance.
    #[must_use]
    pub const fn is_adaptive(self) -> bool {
        matches!(
            self,
            Self::BogackiShampine
                | Self::DormandPrince
                | Self::DormandPrince853
                | Self::Adams
                | Self::Bdf
                | Self::RadauIIA
        )
    }

    /// Whether it moves what is described and formulated so: all methods do, but those that solve
    /// for rigid constraints themselves.
    #[must_use]
    pub const fn moves(self, coordinates: Coordinates, method: Method) -> bool {
        !matches!(self, Self::GeneralizedAlpha)
            || matches!(
                (coordinates, method),
                (Coordinates::Bodies, Method::Standard)
            )
    }

    /// The power of the step that the error of a motion goes with; of a method of many orders, the
    /// highest.
    #[must_use]
    pub const fn order(self) -> u32 {
        match self {
            Self::SemiImplicitEuler => 1,
            Self::Midpoint | Self::Heun | Self::ImplicitMidpoint | Self::GeneralizedAlpha => 2,
            Self::BogackiShampine => 3,
            Self::Rk4 | Self::AdamsBashforthMoulton4 => 4,
            Self::DormandPrinceFixed | Self::DormandPrince | Self::Bdf | Self::RadauIIA => 5,
            Self::DormandPrince853Fixed | Self::DormandPrince853 => 8,
            Self::Adams => 12,
        }
    }
}

/// The absolute tolerance over the relative one, as `ode45` has them by default and chapter 15 uses
/// them: an element of a state below it, in SI units, counts as if it were so large.
pub const FLOOR: f64 = 1e-3;

/// A method with its step or its tolerance: an [`Integrator`] of any number type.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Integration {
    /// The method.
    pub family: Family,
    /// The step (s), or the relative tolerance of a method that chooses its steps; the absolute one
    /// is [`FLOOR`] times that.
    pub step_or_tolerance: f64,
}

impl Integration {
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
        let value = self.step_or_tolerance;
        match self.family {
            Family::SemiImplicitEuler => format!("SemiImplicitEuler::every({value:e})"),
            Family::Midpoint => format!("Midpoint::every({value:e})"),
            Family::Heun => format!("Heun::every({value:e})"),
            Family::Rk4 => format!("Rk4::every({value:e})"),
            Family::DormandPrinceFixed => format!("DormandPrince::every({value:e})"),
            Family::DormandPrince853Fixed => format!("DormandPrince853::every({value:e})"),
            Family::ImplicitMidpoint => format!("ImplicitMidpoint::every({value:e})"),
            Family::GeneralizedAlpha => format!("GeneralizedAlpha::every({value:e})"),
            Family::AdamsBashforthMoulton4 => format!("AdamsBashforthMoulton4::every({value:e})"),
            Family::BogackiShampine => self.adaptive_code("BogackiShampine"),
            Family::DormandPrince => self.adaptive_code("DormandPrince"),
            Family::DormandPrince853 => self.adaptive_code("DormandPrince853"),
            Family::Adams => self.adaptive_code("Adams"),
            Family::Bdf => self.adaptive_code("Bdf"),
            Family::RadauIIA => self.adaptive_code("RadauIIA"),
        }
    }

    fn adaptive_code(self, method: &str) -> String {
        let relative = self.step_or_tolerance;
        let absolute = two_digits(FLOOR * relative);
        format!("{method}::new(Tolerance {{ relative: {relative:e}, absolute: {absolute:e} }})")
    }
}

/// Calls `$then` with the integrator as its own type; for methods that do much besides evaluations,
/// `$other` instead if it is given.
macro_rules! with_own_type {
    ($integration:expr, $integrator:ident => $then:expr) => {
        $crate::trade::integration::with_own_type!(@ $integration, $integrator => $then, {
            $crate::trade::Family::ImplicitMidpoint => {
                let $integrator = holonom::ImplicitMidpoint::every($integration.step());
                $then
            }
            $crate::trade::Family::GeneralizedAlpha => {
                let $integrator = holonom::GeneralizedAlpha::every($integration.step());
                $then
            }
            $crate::trade::Family::Adams => {
                let $integrator = holonom::Adams::new($integration.tolerance_of());
                $then
            }
            $crate::trade::Family::Bdf => {
                let $integrator = holonom::Bdf::new($integration.tolerance_of());
                $then
            }
            $crate::trade::Family::RadauIIA => {
                let $integrator = holonom::RadauIIA::new($integration.tolerance_of());
                $then
            }
        })
    };
    ($integration:expr, $integrator:ident => $then:expr, $other:expr) => {
        $crate::trade::integration::with_own_type!(@ $integration, $integrator => $then, {
            $crate::trade::Family::ImplicitMidpoint
            | $crate::trade::Family::GeneralizedAlpha
            | $crate::trade::Family::Adams
            | $crate::trade::Family::Bdf
            | $crate::trade::Family::RadauIIA => $other
        })
    };
    (@ $integration:expr, $integrator:ident => $then:expr, { $($others:tt)* }) => {
        match $integration.family {
            $crate::trade::Family::SemiImplicitEuler => {
                let $integrator = holonom::SemiImplicitEuler::every($integration.step());
                $then
            }
            $crate::trade::Family::Midpoint => {
                let $integrator = holonom::Midpoint::every($integration.step());
                $then
            }
            $crate::trade::Family::Heun => {
                let $integrator = holonom::Heun::every($integration.step());
                $then
            }
            $crate::trade::Family::Rk4 => {
                let $integrator = holonom::Rk4::every($integration.step());
                $then
            }
            $crate::trade::Family::DormandPrinceFixed => {
                let $integrator = holonom::DormandPrince::every($integration.step());
                $then
            }
            $crate::trade::Family::DormandPrince853Fixed => {
                let $integrator = holonom::DormandPrince853::every($integration.step());
                $then
            }
            $crate::trade::Family::AdamsBashforthMoulton4 => {
                let $integrator = holonom::AdamsBashforthMoulton4::every($integration.step());
                $then
            }
            $crate::trade::Family::BogackiShampine => {
                let $integrator = holonom::BogackiShampine::new($integration.tolerance_of());
                $then
            }
            $crate::trade::Family::DormandPrince => {
                let $integrator = holonom::DormandPrince::new($integration.tolerance_of());
                $then
            }
            $crate::trade::Family::DormandPrince853 => {
                let $integrator = holonom::DormandPrince853::new($integration.tolerance_of());
                $then
            }
            $($others)*
        }
    };
}
pub(crate) use with_own_type;

impl<S: Real> Integrator<S> for Integration {
    type Course<X: Vector<S>> = AnyCourse<S, X>;

    fn start<Y: System<S>>(
        &self,
        system: &mut Y,
        span: Span<S>,
        state: Y::State,
    ) -> Result<AnyCourse<S, Y::State>, Fault> {
        let system = &mut Behind { system };
        with_own_type!(*self, integrator => Ok(integrator.start(system, span, state)?.into()))
    }

    fn budget(&self) -> Option<usize> {
        with_own_type!(*self, integrator => Integrator::<S>::budget(&integrator))
    }

    fn fixed_step(&self) -> Option<S> {
        with_own_type!(*self, integrator => integrator.fixed_step())
    }

    fn silent_phase(&self) -> f64 {
        with_own_type!(*self, integrator => Integrator::<S>::silent_phase(&integrator))
    }

    fn velocity_lead(&self) -> f64 {
        with_own_type!(*self, integrator => Integrator::<S>::velocity_lead(&integrator))
    }

    fn turning_error(&self) -> f64 {
        with_own_type!(*self, integrator => Integrator::<S>::turning_error(&integrator))
    }

    fn tolerance(&self) -> Option<Tolerance<S>> {
        with_own_type!(*self, integrator => integrator.tolerance())
    }
}

/// An [`Integration`] under way.
pub enum AnyCourse<S: Real, X: Vector<S>> {
    /// Of [`Family::SemiImplicitEuler`].
    SemiImplicitEuler(FixedCourse<S, X, SemiImplicitEuler>),
    /// Of [`Family::Midpoint`].
    Midpoint(FixedCourse<S, X, Midpoint>),
    /// Of [`Family::Heun`].
    Heun(FixedCourse<S, X, Heun>),
    /// Of [`Family::Rk4`].
    Rk4(FixedCourse<S, X, Rk4>),
    /// Of [`Family::DormandPrinceFixed`].
    DormandPrinceFixed(FixedCourse<S, X, DormandPrince5>),
    /// Of [`Family::DormandPrince853Fixed`].
    DormandPrince853Fixed(FixedCourse<S, X, DormandPrince8>),
    /// Of [`Family::ImplicitMidpoint`].
    ImplicitMidpoint(FixedCourse<S, X, ImplicitMidpoint>),
    /// Of [`Family::GeneralizedAlpha`].
    GeneralizedAlpha(GeneralizedAlphaCourse<S, X>),
    /// Of [`Family::AdamsBashforthMoulton4`].
    AdamsBashforthMoulton4(AdamsFixedCourse<S, X>),
    /// Of [`Family::BogackiShampine`].
    BogackiShampine(AdaptiveCourse<S, X, BogackiShampine3>),
    /// Of [`Family::DormandPrince`].
    DormandPrince(AdaptiveCourse<S, X, DormandPrince5>),
    /// Of [`Family::DormandPrince853`].
    DormandPrince853(AdaptiveCourse<S, X, DormandPrince8>),
    /// Of [`Family::Adams`].
    Adams(AdamsCourse<S, X>),
    /// Of [`Family::Bdf`]; its matrices are large.
    Bdf(Box<BdfCourse<S, X>>),
    /// Of [`Family::RadauIIA`]; its matrices are large.
    RadauIIA(Box<RadauCourse<S, X>>),
}

macro_rules! from_courses {
    ($($course:ident<$($scheme:ident)?> => $variant:ident),*) => {$(
        impl<S: Real, X: Vector<S>> From<$course<S, X $(, $scheme)?>> for AnyCourse<S, X> {
            fn from(course: $course<S, X $(, $scheme)?>) -> Self {
                Self::$variant(course)
            }
        }
    )*};
}

from_courses!(
    FixedCourse<SemiImplicitEuler> => SemiImplicitEuler,
    FixedCourse<Midpoint> => Midpoint,
    FixedCourse<Heun> => Heun,
    FixedCourse<Rk4> => Rk4,
    FixedCourse<DormandPrince5> => DormandPrinceFixed,
    FixedCourse<DormandPrince8> => DormandPrince853Fixed,
    FixedCourse<ImplicitMidpoint> => ImplicitMidpoint,
    GeneralizedAlphaCourse<> => GeneralizedAlpha,
    AdamsFixedCourse<> => AdamsBashforthMoulton4,
    AdaptiveCourse<BogackiShampine3> => BogackiShampine,
    AdaptiveCourse<DormandPrince5> => DormandPrince,
    AdaptiveCourse<DormandPrince8> => DormandPrince853,
    AdamsCourse<> => Adams
);

impl<S: Real, X: Vector<S>> From<BdfCourse<S, X>> for AnyCourse<S, X> {
    fn from(course: BdfCourse<S, X>) -> Self {
        Self::Bdf(Box::new(course))
    }
}

impl<S: Real, X: Vector<S>> From<RadauCourse<S, X>> for AnyCourse<S, X> {
    fn from(course: RadauCourse<S, X>) -> Self {
        Self::RadauIIA(Box::new(course))
    }
}

macro_rules! on_course {
    ($any:expr, $course:ident => $then:expr) => {
        match $any {
            AnyCourse::SemiImplicitEuler($course) => $then,
            AnyCourse::Midpoint($course) => $then,
            AnyCourse::Heun($course) => $then,
            AnyCourse::Rk4($course) => $then,
            AnyCourse::DormandPrinceFixed($course) => $then,
            AnyCourse::DormandPrince853Fixed($course) => $then,
            AnyCourse::ImplicitMidpoint($course) => $then,
            AnyCourse::GeneralizedAlpha($course) => $then,
            AnyCourse::AdamsBashforthMoulton4($course) => $then,
            AnyCourse::BogackiShampine($course) => $then,
            AnyCourse::DormandPrince($course) => $then,
            AnyCourse::DormandPrince853($course) => $then,
            AnyCourse::Adams($course) => $then,
            AnyCourse::Bdf($course) => $then,
            AnyCourse::RadauIIA($course) => $then,
        }
    };
}

impl<S: Real, X: Vector<S>> Course<S, X> for AnyCourse<S, X> {
    fn time(&self) -> S {
        on_course!(self, course => course.time())
    }

    fn state(&self) -> &X {
        on_course!(self, course => course.state())
    }

    fn advance<Y: System<S, State = X>>(&mut self, system: &mut Y) -> Result<(), Fault> {
        let system = &mut Behind { system };
        on_course!(self, course => course.advance(system))
    }

    fn at<Y: System<S, State = X>>(&mut self, system: &mut Y, time: S) -> Result<X, Fault> {
        let system = &mut Behind { system };
        on_course!(self, course => course.at(system, time))
    }

    fn better_end<Y: System<S, State = X>>(&self, system: &mut Y) -> Result<Option<X>, Fault> {
        let system = &mut Behind { system };
        on_course!(self, course => course.better_end(system))
    }

    fn replace(&mut self, state: X) {
        on_course!(self, course => course.replace(state));
    }

    fn counts(&self) -> Counts {
        on_course!(self, course => course.counts())
    }
}

/// A system behind a pointer: one type for all systems with such states, so that a method is
/// compiled once for all of them.
struct Behind<'a, S: Real, X: Vector<S>> {
    system: &'a mut dyn System<S, State = X>,
}

impl<S: Real, X: Vector<S>> System<S> for Behind<'_, S, X> {
    type State = X;

    fn rates(&mut self, time: S, state: &X) -> Result<X, Fault> {
        self.system.rates(time, state)
    }

    fn stage(&mut self, time: S, state: &X, rates: &mut X) -> Result<(), Fault> {
        self.system.stage(time, state, rates)
    }

    fn with_new_velocities(
        &mut self,
        time: S,
        state: &X,
        step: S,
        rates: &mut X,
    ) -> Result<(), Fault> {
        self.system.with_new_velocities(time, state, step, rates)
    }

    fn step_on_constraints(&mut self, asked: AlphaStep<'_, S, X>) -> Result<AlphaEnd<X>, Fault> {
        self.system.step_on_constraints(asked)
    }

    fn settle(&mut self, state: &mut X, rates: Option<&mut X>) {
        self.system.settle(state, rates);
    }
}

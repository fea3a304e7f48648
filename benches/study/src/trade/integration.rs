//! An integrator that is chosen at run time, as one type: what is compiled for a mechanism does not grow with the number of integrators.

use holonom::{
    AdaptiveCourse, Counts, Course, DormandPrince, DormandPrince5, Fault, FixedCourse, Heun,
    Integrator, Midpoint, Real, Rk4, SemiImplicitEuler, Span, System, Tolerance, Vector,
};

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
    /// Dormand and Prince 5(4) under the control of `ode45`.
    DormandPrince,
}

impl Family {
    /// All of them, those of fixed steps first.
    pub const ALL: [Self; 6] = [
        Self::SemiImplicitEuler,
        Self::Midpoint,
        Self::Heun,
        Self::Rk4,
        Self::DormandPrinceFixed,
        Self::DormandPrince,
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
            Self::DormandPrince => "dormand-prince",
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
        matches!(self, Self::DormandPrince)
    }

    /// The power of the step that the error of a motion goes with.
    #[must_use]
    pub const fn order(self) -> u32 {
        match self {
            Self::SemiImplicitEuler => 1,
            Self::Midpoint | Self::Heun => 2,
            Self::Rk4 => 4,
            Self::DormandPrinceFixed | Self::DormandPrince => 5,
        }
    }

    /// Evaluations of a step.
    #[must_use]
    pub const fn stages(self) -> u32 {
        match self {
            Self::SemiImplicitEuler => 1,
            Self::Midpoint | Self::Heun => 2,
            Self::Rk4 => 4,
            Self::DormandPrinceFixed | Self::DormandPrince => 6,
        }
    }
}

/// The absolute tolerance over the relative one, as `ode45` has them by default and chapter 15 uses them: an element of a state below it, in SI units, counts as if it
/// were so large.
pub const FLOOR: f64 = 1e-3;

/// A method with its step or its tolerance: an [`Integrator`] of any number type.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Integration {
    /// The method.
    pub family: Family,
    /// The step (s), or the relative tolerance of a method that chooses its steps; the absolute one is [`FLOOR`] times that.
    pub step_or_tolerance: f64,
}

impl Integration {
    pub(crate) fn step<S: Real>(self) -> S {
        S::constant(self.step_or_tolerance)
    }

    pub(crate) fn dormand_prince<S: Real>(self) -> DormandPrince<S> {
        DormandPrince::new(Tolerance {
            relative: S::constant(self.step_or_tolerance),
            absolute: S::constant(FLOOR * self.step_or_tolerance),
        })
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
            Family::DormandPrince => format!(
                "DormandPrince::new(Tolerance {{ relative: {value:e}, absolute: {:e} }})",
                FLOOR * value
            ),
        }
    }
}

/// Calls `$then` with the integrator as its own type.
macro_rules! with_own_type {
    ($integration:expr, $integrator:ident => $then:expr) => {{
        let integration = $integration;
        match integration.family {
            $crate::trade::Family::SemiImplicitEuler => {
                let $integrator = holonom::SemiImplicitEuler::every(integration.step());
                $then
            }
            $crate::trade::Family::Midpoint => {
                let $integrator = holonom::Midpoint::every(integration.step());
                $then
            }
            $crate::trade::Family::Heun => {
                let $integrator = holonom::Heun::every(integration.step());
                $then
            }
            $crate::trade::Family::Rk4 => {
                let $integrator = holonom::Rk4::every(integration.step());
                $then
            }
            $crate::trade::Family::DormandPrinceFixed => {
                let $integrator = holonom::DormandPrince::every(integration.step());
                $then
            }
            $crate::trade::Family::DormandPrince => {
                let $integrator = integration.dormand_prince();
                $then
            }
        }
    }};
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

    fn turning_error(&self) -> f64 {
        with_own_type!(*self, integrator => Integrator::<S>::turning_error(&integrator))
    }

    fn tolerance(&self) -> Option<Tolerance<S>> {
        with_own_type!(*self, integrator => integrator.tolerance())
    }
}

/// An [`Integration`] under way.
#[allow(missing_docs, clippy::large_enum_variant)] // One for each type of course, and one of them at a time.
pub enum AnyCourse<S: Real, X: Vector<S>> {
    SemiImplicitEuler(FixedCourse<S, X, SemiImplicitEuler>),
    Midpoint(FixedCourse<S, X, Midpoint>),
    Heun(FixedCourse<S, X, Heun>),
    Rk4(FixedCourse<S, X, Rk4>),
    DormandPrinceFixed(FixedCourse<S, X, DormandPrince5>),
    DormandPrince(AdaptiveCourse<S, X>),
}

macro_rules! from_courses {
    ($($scheme:ident => $variant:ident),*) => {$(
        impl<S: Real, X: Vector<S>> From<FixedCourse<S, X, $scheme>> for AnyCourse<S, X> {
            fn from(course: FixedCourse<S, X, $scheme>) -> Self {
                Self::$variant(course)
            }
        }
    )*};
}

from_courses!(
    SemiImplicitEuler => SemiImplicitEuler,
    Midpoint => Midpoint,
    Heun => Heun,
    Rk4 => Rk4,
    DormandPrince5 => DormandPrinceFixed
);

impl<S: Real, X: Vector<S>> From<AdaptiveCourse<S, X>> for AnyCourse<S, X> {
    fn from(course: AdaptiveCourse<S, X>) -> Self {
        Self::DormandPrince(course)
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
            AnyCourse::DormandPrince($course) => $then,
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

    fn replace(&mut self, state: X) {
        on_course!(self, course => course.replace(state));
    }

    fn counts(&self) -> Counts {
        on_course!(self, course => course.counts())
    }
}

/// A system behind a pointer: one type for all systems with such states, so that a method is compiled once for all of them.
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

    fn settle(&mut self, state: &mut X, rates: Option<&mut X>) {
        self.system.settle(state, rates);
    }
}

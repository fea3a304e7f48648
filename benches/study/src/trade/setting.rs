//! What a run is done with, as a value.

use holonom::{AugmentedLagrangian, Baumgarte, Penalty, Real};

use super::integration::{Family, Integration};
use crate::chapter15::Method;
use crate::compare::{Coordinates, Precision};

/// A formulation with its coefficients, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Formulated {
    /// Lagrange multipliers.
    Standard,
    /// Lagrange multipliers with Baumgarte's terms.
    Baumgarte(Baumgarte<f64>),
    /// The penalty method.
    Penalty(Penalty<f64>),
    /// The augmented Lagrangian.
    AugmentedLagrangian(AugmentedLagrangian<f64>),
}

impl Formulated {
    /// A formulation with its default coefficients.
    #[must_use]
    pub fn default_of(method: Method) -> Self {
        match method {
            Method::Standard => Self::Standard,
            Method::Baumgarte => Self::Baumgarte(Baumgarte::default()),
            Method::Penalty => Self::Penalty(Penalty::default()),
            Method::AugmentedLagrangian => {
                Self::AugmentedLagrangian(AugmentedLagrangian::default())
            }
        }
    }

    /// Which formulation it is.
    #[must_use]
    pub const fn method(&self) -> Method {
        match self {
            Self::Standard => Method::Standard,
            Self::Baumgarte(_) => Method::Baumgarte,
            Self::Penalty(_) => Method::Penalty,
            Self::AugmentedLagrangian(_) => Method::AugmentedLagrangian,
        }
    }

    /// The coefficients in SI units: none, `[alpha, beta]`, or `[alpha, omega, mu]`.
    #[must_use]
    pub fn coefficients(&self) -> Vec<f64> {
        match *self {
            Self::Standard => Vec::new(),
            Self::Baumgarte(Baumgarte { alpha, beta }) => vec![alpha, beta],
            Self::Penalty(Penalty { alpha, omega, mu })
            | Self::AugmentedLagrangian(AugmentedLagrangian {
                alpha, omega, mu, ..
            }) => vec![alpha, omega, mu],
        }
    }

    /// As a user writes it.
    #[must_use]
    pub fn code(&self) -> String {
        if *self == Self::default_of(self.method()) {
            return match self {
                Self::Standard => "StandardLagrange",
                Self::Baumgarte(_) => "Baumgarte::default()",
                Self::Penalty(_) => "Penalty::default()",
                Self::AugmentedLagrangian(_) => "AugmentedLagrangian::default()",
            }
            .into();
        }
        match self {
            Self::Standard => "StandardLagrange".into(),
            Self::Baumgarte(Baumgarte { alpha, beta }) => {
                format!("Baumgarte {{ alpha: {alpha:e}, beta: {beta:e} }}")
            }
            Self::Penalty(Penalty { alpha, omega, mu }) => {
                format!("Penalty {{ alpha: {alpha:e}, omega: {omega:e}, mu: {mu:e} }}")
            }
            Self::AugmentedLagrangian(AugmentedLagrangian {
                alpha, omega, mu, ..
            }) => format!("AugmentedLagrangian::new({alpha:e}, {omega:e}, {mu:e})"),
        }
    }
}

pub(super) fn baumgarte<S: Real>(of: &Baumgarte<f64>) -> Baumgarte<S> {
    Baumgarte {
        alpha: S::constant(of.alpha),
        beta: S::constant(of.beta),
    }
}

pub(super) fn penalty<S: Real>(of: &Penalty<f64>) -> Penalty<S> {
    Penalty {
        alpha: S::constant(of.alpha),
        omega: S::constant(of.omega),
        mu: S::constant(of.mu),
    }
}

/// The same coefficients; tolerance and number of solutions are the defaults of the number type.
pub(super) fn augmented_lagrangian<S: Real>(
    of: &AugmentedLagrangian<f64>,
) -> AugmentedLagrangian<S> {
    AugmentedLagrangian::new(
        S::constant(of.alpha),
        S::constant(of.omega),
        S::constant(of.mu),
    )
}

/// What is done to a state after every step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Treatment {
    /// Nothing.
    None,
    /// Positions and velocities are corrected onto the constraints, see [`holonom::Projection`].
    Projection,
    /// Velocities alone are, see [`holonom::VelocityProjection`].
    VelocityProjection,
    /// Positions of bodies follow from the joints of a tree, see [`holonom::TreeRecovery`].
    TreeRecovery,
}

impl Treatment {
    /// All of them.
    pub const ALL: [Self; 4] = [
        Self::None,
        Self::Projection,
        Self::VelocityProjection,
        Self::TreeRecovery,
    ];

    /// The name in JSON and on the command line, and for a reader.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Projection => "projection",
            Self::VelocityProjection => "velocity-projection",
            Self::TreeRecovery => "tree-recovery",
        }
    }

    /// The treatment of a name.
    #[must_use]
    pub fn of(key: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|treatment| treatment.key() == key)
    }
}

/// What a run is done with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// The description.
    pub coordinates: Coordinates,
    /// The formulation.
    pub formulation: Formulated,
    /// What is done after every step.
    pub treatment: Treatment,
    /// The integrator.
    pub integration: Integration,
    /// The numbers.
    pub scalar: Precision,
}

impl Setting {
    /// The lines of Rust that run it, for a mechanism in a variable of that name; interval, reports and what is read are the reader's.
    #[must_use]
    pub fn code(&self, mechanism: &str) -> String {
        let numbers = match self.scalar {
            Precision::Double => "",
            Precision::Single => "::<f32, _, _, _>",
        };
        let tree = match self.treatment {
            Treatment::TreeRecovery => format!("let tree = TreeRecovery::new(&{mechanism})?;\n"),
            _ => String::new(),
        };
        let mut code = format!(
            "use holonom::prelude::*;\n{}\n{tree}let report = Simulation{numbers}::new(&{mechanism}, {}, {})\n",
            self.names().concat(),
            self.formulation.code(),
            self.integration.code()
        );
        if self.coordinates == Coordinates::Joints {
            code.push_str("    .joint_coordinates()\n");
        }
        code.push_str(match self.treatment {
            Treatment::None => "",
            Treatment::Projection => "    .projection(Projection::default())\n",
            Treatment::VelocityProjection => "    .treatment(&VelocityProjection::default())\n",
            Treatment::TreeRecovery => "    .treatment(&tree)\n",
        });
        code.push_str("    .run(start..=end, every(interval), |sample| {\n        // sample: what is read\n        ControlFlow::Continue(())\n    })?;\n");
        code
    }

    /// What the lines need that is not in the prelude.
    fn names(&self) -> [String; 2] {
        let name = |name: &str| format!("use holonom::{name};\n");
        let integrator = match self.integration.family {
            Family::SemiImplicitEuler => name("SemiImplicitEuler"),
            Family::Midpoint => name("Midpoint"),
            Family::Heun => name("Heun"),
            Family::ImplicitMidpoint => name("ImplicitMidpoint"),
            Family::AdamsBashforthMoulton4 => name("AdamsBashforthMoulton4"),
            Family::Adams => name("Adams"),
            Family::Bdf => name("Bdf"),
            Family::RadauIIA => name("RadauIIA"),
            Family::DormandPrince853Fixed | Family::DormandPrince853 => name("DormandPrince853"),
            Family::BogackiShampine => name("BogackiShampine"),
            Family::Rk4 | Family::DormandPrinceFixed | Family::DormandPrince => String::new(),
        };
        let treatment = match self.treatment {
            Treatment::None | Treatment::Projection => String::new(),
            Treatment::VelocityProjection => name("VelocityProjection"),
            Treatment::TreeRecovery => name("TreeRecovery"),
        };
        [integrator, treatment]
    }

    /// In words.
    #[must_use]
    pub fn name(&self) -> String {
        let treatment = match self.treatment {
            Treatment::None => String::new(),
            other => format!(", {}", other.key()),
        };
        format!(
            "{}, {}{treatment}, {} {:.1e}, {}",
            self.coordinates.key(),
            self.formulation.method().key(),
            self.integration.family.key(),
            self.integration.step_or_tolerance,
            self.scalar.key()
        )
    }
}

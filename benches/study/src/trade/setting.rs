//! What a run is done with, as a value.

use holonom::{AugmentedLagrangian, Baumgarte, Fault, Mechanism, Penalty, Real};

use super::integration::IntegratorSetting;
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

/// A formulation, and where its coefficients come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Choice {
    /// From the mechanism: those of `of`, such as [`Baumgarte::of`], and `at_step` where the step
    /// is fixed.
    Derived(Method),
    /// These.
    Given(Formulated),
}

impl Formulated {
    /// A formulation with the coefficients that follow from a mechanism, in the numbers that it is
    /// run with, and for the integrator.
    ///
    /// # Errors
    /// Why none follow, see [`holonom::constraints::Scales::of`].
    pub fn of<M: Mechanism>(
        method: Method,
        mechanism: &M,
        scalar: Precision,
        integration: IntegratorSetting,
    ) -> Result<Self, Fault> {
        match scalar {
            Precision::Double => derived::<f64, M>(method, mechanism, integration),
            Precision::Single => derived::<f32, M>(method, mechanism, integration),
        }
    }

    /// A formulation with the coefficients of chapter 15.
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

    /// The coefficients in SI units: none, `[alpha, beta]`, or `[alpha, omega, mu]` and, where a
    /// radian does not count as a metre, the length that it counts as.
    #[must_use]
    pub fn coefficients(&self) -> Vec<f64> {
        match *self {
            Self::Standard => Vec::new(),
            Self::Baumgarte(Baumgarte { alpha, beta }) => vec![alpha, beta],
            Self::Penalty(Penalty {
                alpha,
                omega,
                mu,
                radian,
            })
            | Self::AugmentedLagrangian(AugmentedLagrangian {
                alpha,
                omega,
                mu,
                radian,
                ..
            }) => [alpha, omega, mu].into_iter().chain(radian).collect(),
        }
    }

    /// As a user writes it, with its coefficients.
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
            Self::Penalty(Penalty {
                alpha,
                omega,
                mu,
                radian,
            }) => with_radian("Penalty", [*alpha, *omega, *mu], *radian),
            Self::AugmentedLagrangian(AugmentedLagrangian {
                alpha,
                omega,
                mu,
                radian,
                ..
            }) => with_radian("AugmentedLagrangian", [*alpha, *omega, *mu], *radian),
        }
    }
}

fn with_radian(name: &str, [alpha, omega, mu]: [f64; 3], radian: Option<f64>) -> String {
    let new = format!("{name}::new({alpha:e}, {omega:e}, {mu:e})");
    match radian {
        Some(radian) => format!("{name} {{ radian: Some({radian:e}), ..{new} }}"),
        None => new,
    }
}

fn derived<S: Real, M: Mechanism>(
    method: Method,
    mechanism: &M,
    integration: IntegratorSetting,
) -> Result<Formulated, Fault> {
    let step = (!integration.family.is_adaptive()).then(|| integration.step::<S>());
    Ok(match method {
        Method::Standard => Formulated::Standard,
        Method::Baumgarte => {
            let all = Baumgarte::<S>::of(mechanism)?;
            let Baumgarte { alpha, beta } = step.map_or(all, |step| all.at_step(step));
            Formulated::Baumgarte(Baumgarte::new(alpha.to_f64(), beta.to_f64()))
        }
        Method::Penalty => {
            let all = Penalty::<S>::of(mechanism)?;
            let all = step.map_or(all, |step| all.at_step(step));
            Formulated::Penalty(penalty(&all))
        }
        Method::AugmentedLagrangian => {
            let all = AugmentedLagrangian::<S>::of(mechanism)?;
            let all = step.map_or(all, |step| all.at_step(step));
            Formulated::AugmentedLagrangian(augmented_lagrangian(&all))
        }
    })
}

pub(super) fn baumgarte<S: Real>(of: &Baumgarte<f64>) -> Baumgarte<S> {
    Baumgarte {
        alpha: S::constant(of.alpha),
        beta: S::constant(of.beta),
    }
}

pub(super) fn penalty<S: Real, T: Real>(of: &Penalty<T>) -> Penalty<S> {
    let number = |of: T| S::constant(of.to_f64());
    Penalty {
        alpha: number(of.alpha),
        omega: number(of.omega),
        mu: number(of.mu),
        radian: of.radian.map(number),
    }
}

/// The same coefficients; tolerance and number of solutions are the defaults of the number type.
pub(super) fn augmented_lagrangian<S: Real, T: Real>(
    of: &AugmentedLagrangian<T>,
) -> AugmentedLagrangian<S> {
    let number = |of: T| S::constant(of.to_f64());
    AugmentedLagrangian {
        radian: of.radian.map(number),
        ..AugmentedLagrangian::new(number(of.alpha), number(of.omega), number(of.mu))
    }
}

/// What is done to a state after every step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PostStabilisation {
    /// Nothing.
    None,
    /// Positions and velocities are corrected onto the constraints, see [`holonom::Projection`].
    Projection,
    /// The same by the pseudo-inverse of the Jacobian, once: the method of the literature without
    /// weights (Marques, Souto and Flores 2017), to compare with.
    DirectCorrection,
    /// Velocities alone are, see [`holonom::run::VelocityProjection`].
    VelocityProjection,
    /// Positions of bodies follow from the joints of a tree, see [`holonom::run::TreeRecovery`].
    TreeRecovery,
}

impl PostStabilisation {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::None,
        Self::Projection,
        Self::DirectCorrection,
        Self::VelocityProjection,
        Self::TreeRecovery,
    ];

    /// The name in JSON and on the command line, and for a reader.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Projection => "projection",
            Self::DirectCorrection => "direct-correction",
            Self::VelocityProjection => "velocity-projection",
            Self::TreeRecovery => "tree-recovery",
        }
    }

    /// The stabilisation of a name.
    #[must_use]
    pub fn of(key: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|stabilisation| stabilisation.key() == key)
    }
}

/// What a run is done with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// The description.
    pub coordinates: Coordinates,
    /// The formulation.
    pub formulation: Formulated,
    /// Whether its coefficients are those that follow from the mechanism, see [`Choice::Derived`]:
    /// a user writes no numbers then.
    pub is_derived: bool,
    /// What is done after every step.
    pub stabilisation: PostStabilisation,
    /// The integrator.
    pub integration: IntegratorSetting,
    /// The numbers.
    pub scalar: Precision,
}

impl Setting {
    /// The lines of Rust that run it, for a mechanism in a variable of that name; interval, reports
    /// and what is read are the reader's.
    #[must_use]
    pub fn code(&self, mechanism: &str) -> String {
        let numbers = match self.scalar {
            Precision::Double => "",
            Precision::Single => "::<f32, _, _, _>",
        };
        let tree = match self.stabilisation {
            PostStabilisation::TreeRecovery => {
                format!("let tree = TreeRecovery::new(&{mechanism})?;\n")
            }
            _ => String::new(),
        };
        let mut code = format!(
            "use holonom::prelude::*;\n{}\n{tree}let report = Simulation{numbers}::new(&{mechanism}, {}, {})\n",
            self.names().concat(),
            self.formulation_code(mechanism),
            self.integration.code()
        );
        if self.coordinates == Coordinates::Joints {
            code.push_str("    .joint_coordinates()\n");
        }
        code.push_str(match self.stabilisation {
            PostStabilisation::None => "",
            PostStabilisation::Projection => "    .projection(Projection::default())\n",
            PostStabilisation::DirectCorrection => {
                "    .post_stabilisation(&DirectCorrection::default())\n"
            }
            PostStabilisation::VelocityProjection => {
                "    .post_stabilisation(&VelocityProjection::default())\n"
            }
            PostStabilisation::TreeRecovery => "    .post_stabilisation(&tree)\n",
        });
        code.push_str("    .run(start..=end, every(interval), |sample| {\n        // sample: what is read\n        ControlFlow::Continue(())\n    })?;\n");
        code
    }

    fn formulation_code(&self, mechanism: &str) -> String {
        let name = match self.formulation {
            Formulated::Baumgarte(_) if self.is_derived => "Baumgarte",
            Formulated::Penalty(_) if self.is_derived => "Penalty",
            Formulated::AugmentedLagrangian(_) if self.is_derived => "AugmentedLagrangian",
            _ => return self.formulation.code(),
        };
        let IntegratorSetting {
            family,
            step_or_tolerance,
        } = self.integration;
        let at_step = if family.is_adaptive() {
            String::new()
        } else {
            format!(".at_step({step_or_tolerance:e})")
        };
        format!("{name}::of(&{mechanism})?{at_step}")
    }

    /// What the lines need that is not in the prelude.
    fn names(&self) -> [String; 2] {
        let name = |name: &str| format!("use holonom::{name};\n");
        let integrator = match self.integration.family.name() {
            "Rk4" | "DormandPrince" => String::new(),
            other => name(other),
        };
        let stabilisation = match self.stabilisation {
            PostStabilisation::None | PostStabilisation::Projection => String::new(),
            PostStabilisation::DirectCorrection => {
                "use holonom_study::trade::DirectCorrection;\n".into()
            }
            PostStabilisation::VelocityProjection => name("run::VelocityProjection"),
            PostStabilisation::TreeRecovery => name("run::TreeRecovery"),
        };
        [integrator, stabilisation]
    }

    /// In words.
    #[must_use]
    pub fn name(&self) -> String {
        let stabilisation = match self.stabilisation {
            PostStabilisation::None => String::new(),
            other => format!(", {}", other.key()),
        };
        format!(
            "{}, {}{stabilisation}, {} {:.1e}, {}",
            self.coordinates.key(),
            self.formulation.method().key(),
            self.integration.family.key(),
            self.integration.step_or_tolerance,
            self.scalar.key()
        )
    }
}

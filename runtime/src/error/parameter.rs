//! Numbers of a description that are not acceptable, and what is said of them.

use core::fmt;

use crate::math::spline::SplineFault;

/// A number of the description that the macro could not see is not acceptable.
///
/// `{:?}` is the sentence of `Display`, for a `main` that returns the error. `{:#?}` has the
/// fields.
#[derive(Clone, Copy, PartialEq)]
pub struct ParameterError {
    /// The field of the mechanism.
    pub field: &'static str,
    /// The attribute.
    pub attribute: &'static str,
    /// What is wrong with it.
    pub fault: ParameterFault,
}

/// What is wrong with a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ParameterFault {
    /// NaN or infinite.
    NotFinite,
    /// Zero or negative where a positive number is needed.
    NotPositive,
    /// Principal moments of inertia of which one exceeds the sum of the others.
    TriangleInequality,
    /// A vector of length zero where a direction is needed.
    ZeroLength,
    /// A table that makes no spline.
    Spline(SplineFault),
    /// With this parameter no configuration was found that satisfies all equations: neither from
    /// the described one and near it, nor by continuation from the typical values of parameters.
    NotAssembled {
        /// The joint that stays open most.
        joint: &'static str,
    },
    /// With this parameter equations depend on each other at the start. They do not at the typical
    /// values of parameters (`like`).
    Dependent {
        /// The joint whose pivot vanishes.
        joint: &'static str,
    },
    /// With this parameter an equation that was left out does not follow from the others. It does
    /// at the typical values of parameters (`like`).
    Independent {
        /// The joint that it belongs to.
        joint: &'static str,
    },
}

impl core::error::Error for ParameterError {}

impl fmt::Display for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let fault = match self.fault {
            ParameterFault::NotFinite => "must be finite",
            ParameterFault::NotPositive => "must be positive",
            ParameterFault::TriangleInequality => {
                "must satisfy the triangle inequality: no principal moment exceeds the sum of the others"
            }
            ParameterFault::ZeroLength => "must not be the zero vector",
            ParameterFault::Spline(fault) => {
                return write!(f, "`{}` is {}", self.field, fault.sentence());
            }
            ParameterFault::NotAssembled { joint } => {
                return write!(
                    f,
                    "with this `{}` the mechanism cannot be assembled: joint `{joint}` stays open",
                    self.field
                );
            }
            ParameterFault::Dependent { joint } => {
                return write!(
                    f,
                    "with this `{}` the constraints depend on each other at joint `{joint}` at the start; at the typical values of the parameters they do not",
                    self.field
                );
            }
            ParameterFault::Independent { joint } => {
                return write!(
                    f,
                    "with this `{}` an equation of joint `{joint}` does not follow from the others; it was left out because it does at the typical values of the parameters",
                    self.field
                );
            }
        };
        write!(f, "`{}` of `{}` {fault}", self.attribute, self.field)
    }
}

impl fmt::Debug for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !f.alternate() {
            return fmt::Display::fmt(self, f);
        }
        f.debug_struct("ParameterError")
            .field("field", &self.field)
            .field("attribute", &self.attribute)
            .field("fault", &self.fault)
            .finish()
    }
}

//! Functions of one number in the expressions of definitions and laws.

/// A function of one number, with two derivatives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Function {
    /// `1 / x`.
    Reciprocal,
    /// The square root.
    SquareRoot,
    /// The sine of an angle in radians.
    Sine,
    /// The cosine of an angle in radians.
    Cosine,
    /// The angle of a sine, from `-pi/2` to `pi/2`; NaN beyond -1 and 1.
    ArcSine,
    /// The angle of a cosine, from 0 to `pi`; NaN beyond -1 and 1.
    ArcCosine,
    /// The angle of a tangent, from `-pi/2` to `pi/2`.
    ArcTangent,
    /// The exponential function.
    Exponential,
    /// 0 below 0, 1 above 1, `6 x^5 - 15 x^4 + 10 x^3` between: twice continuously differentiable.
    SmoothStep,
    /// A spline, or a derivative of it.
    Curve(Curve),
}

/// A spline by its place in the model, and which derivative of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Curve {
    /// The place in [`Model::splines`](super::Model::splines).
    pub spline: u32,
    /// 0 for the value, at most [`Curve::HIGHEST`] in what is generated.
    pub derivative: u8,
}

impl Curve {
    /// The last derivative that is continuous.
    pub const HIGHEST: u8 = 2;

    /// The next derivative.
    #[must_use]
    pub const fn derived(self) -> Self {
        Self {
            derivative: self.derivative + 1,
            ..self
        }
    }
}

impl Function {
    /// The functions that have a name in the language.
    pub const NAMED: [(&'static str, Self); 8] = [
        ("sqrt", Self::SquareRoot),
        ("sin", Self::Sine),
        ("cos", Self::Cosine),
        ("asin", Self::ArcSine),
        ("acos", Self::ArcCosine),
        ("atan", Self::ArcTangent),
        ("exp", Self::Exponential),
        ("smooth_step", Self::SmoothStep),
    ];

    /// The value of the function; NaN of a spline, whose table the macro does not see.
    #[must_use]
    pub fn of(self, x: f64) -> f64 {
        match self {
            Self::Reciprocal => x.recip(),
            Self::SquareRoot => x.sqrt(),
            Self::Sine => x.sin(),
            Self::Cosine => x.cos(),
            Self::ArcSine => x.asin(),
            Self::ArcCosine => x.acos(),
            Self::ArcTangent => x.atan(),
            Self::Exponential => x.exp(),
            Self::SmoothStep => {
                let x = x.clamp(0.0, 1.0);
                x * x * x * (x * (6.0 * x - 15.0) + 10.0)
            }
            Self::Curve(_) => f64::NAN,
        }
    }

    /// The function of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let known = Self::NAMED.iter().find(|(known, _)| *known == name);
        known.map(|(_, function)| *function)
    }
}

//! Kernels of the equations of motion in the rates of joints, which are there where they are asked
//! for.

/// Such a kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asked {
    /// The mass matrix.
    Mass,
    /// The efforts of given accelerations.
    Inverse,
    /// Those of them that hold the weights.
    Gravity,
    /// Those of them that the motion takes.
    Coriolis,
    /// The axes of the joints, of which Jacobians of points are made.
    Jacobian,
    /// The accelerations of given efforts.
    Forward,
    /// The accelerations with their derivatives.
    Derivatives,
    /// What a weighted sum of accelerations changes by.
    Adjoint,
}

impl Asked {
    /// What `kernels` takes.
    pub const ALL: [(&'static str, Self); 8] = [
        ("mass", Self::Mass),
        ("inverse", Self::Inverse),
        ("gravity", Self::Gravity),
        ("coriolis", Self::Coriolis),
        ("jacobian", Self::Jacobian),
        ("forward", Self::Forward),
        ("derivatives", Self::Derivatives),
        ("adjoint", Self::Adjoint),
    ];

    /// The word for it.
    #[must_use]
    pub fn word(self) -> &'static str {
        let mut all = Self::ALL.iter();
        all.find(|(_, kernel)| *kernel == self)
            .map_or("", |(word, _)| word)
    }
}

//! What is known about the motions that a joint states.

/// How the motions that a joint states compare with its equations.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Comparison {
    /// The motions are those that the equations leave.
    Agrees,
    /// Nothing can be said: the definition states no motions, the equations do not hold in the
    /// reference configuration or change with time, numbers cannot be seen, or what the motions
    /// speak of is not the same on both bodies there.
    Undecided,
    /// Motions that equations forbid: the place of the motion, and that of the equation that
    /// forbids it most.
    Forbidden(Vec<(usize, usize)>),
    /// An equation that does not hold after the motions, by its place.
    Violated(usize),
    /// Not all motions are independent of each other.
    Dependent {
        /// How many scalar motions are stated.
        stated: usize,
        /// How many of them are independent.
        independent: usize,
    },
    /// The equations leave more.
    Fewer {
        /// How many scalar motions are stated.
        stated: usize,
        /// How many are left.
        left: usize,
    },
}

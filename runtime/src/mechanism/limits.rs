//! The limits of joints that a description has, and arrays of as many things.

/// The limits of one joint, as its description has them.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointLimits<S> {
    /// The place of the joint in the report.
    pub joint: usize,
    /// Whether they are of its angle (rad), and not of its displacement (m).
    pub is_angle: bool,
    /// The lower one and the upper one.
    pub bounds: [S; 2],
    /// The rate after an impact over the one before it.
    pub restitution: S,
}

/// Several things, as many as the type says: an array, or [`Nothing`].
#[doc(hidden)]
pub trait Several<T>: AsRef<[T]> + AsMut<[T]> + Clone {
    /// How many.
    const COUNT: usize;

    /// As many things of another type.
    type Each<R: Copy>: AsRef<[R]> + AsMut<[R]>;

    /// One thing for each.
    fn each<R: Copy>(one: R) -> Self::Each<R>;

    /// Visits them as an array. [`Nothing`] has none to visit, so nothing is compiled for it.
    fn visit<V: Visit<T>>(&self, visit: V) -> Option<V::Output>;

    /// The same, to change them.
    fn visit_mut<V: VisitMut<T>>(&mut self, visit: V) -> Option<V::Output>;
}

/// What is done with an array of any length.
#[doc(hidden)]
pub trait Visit<T> {
    /// What comes of it.
    type Output;

    /// Does it.
    fn visit<const K: usize>(self, all: &[T; K]) -> Self::Output;
}

/// What changes an array of any length.
#[doc(hidden)]
pub trait VisitMut<T> {
    /// What comes of it.
    type Output;

    /// Does it.
    fn visit<const K: usize>(self, all: &mut [T; K]) -> Self::Output;
}

/// No things.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Nothing;

impl<T> AsRef<[T]> for Nothing {
    #[inline(always)]
    fn as_ref(&self) -> &[T] {
        &[]
    }
}

impl<T> AsMut<[T]> for Nothing {
    #[inline(always)]
    fn as_mut(&mut self) -> &mut [T] {
        &mut []
    }
}

impl<T> Several<T> for Nothing {
    const COUNT: usize = 0;

    type Each<R: Copy> = Nothing;

    #[inline(always)]
    fn each<R: Copy>(_one: R) -> Nothing {
        Nothing
    }

    #[inline(always)]
    fn visit<V: Visit<T>>(&self, _visit: V) -> Option<V::Output> {
        None
    }

    #[inline(always)]
    fn visit_mut<V: VisitMut<T>>(&mut self, _visit: V) -> Option<V::Output> {
        None
    }
}

impl<T: Clone, const K: usize> Several<T> for [T; K] {
    const COUNT: usize = K;

    type Each<R: Copy> = [R; K];

    #[inline(always)]
    fn each<R: Copy>(one: R) -> [R; K] {
        [one; K]
    }

    #[inline(always)]
    fn visit<V: Visit<T>>(&self, visit: V) -> Option<V::Output> {
        Some(visit.visit(self))
    }

    #[inline(always)]
    fn visit_mut<V: VisitMut<T>>(&mut self, visit: V) -> Option<V::Output> {
        Some(visit.visit(self))
    }
}

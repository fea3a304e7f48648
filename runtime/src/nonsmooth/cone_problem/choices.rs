//! What may act at an unknown, and the choices of modes that there are for it.

use crate::math::scalar::Real;
use crate::nonsmooth::tied::at;

/// What may act at an unknown.
#[derive(Clone, Copy, Debug)]
pub(in crate::nonsmooth) enum Role<S> {
    /// A known effort.
    Given(S),
    /// Friction at rest: efforts within bounds, and those while it slides down or up, which are at
    /// the upper and at the lower bound.
    Within { bounds: [S; 2], sliding: [S; 2] },
    /// A limit that pushes with a sign, with at least so much.
    Pushes {
        sign: S,
        least: S,
        rough: Option<Rough<S>>,
    },
    /// Friction in the plane of a contact, which stands before it.
    Tangent,
}

/// Friction of a contact.
#[derive(Clone, Copy, Debug)]
pub(in crate::nonsmooth) struct Rough<S> {
    /// Coulomb's coefficient.
    pub(in crate::nonsmooth) coefficient: S,
    /// The same while it sticks: less by round-off for what was found at its end.
    pub(in crate::nonsmooth) at_rest: S,
    /// The unknowns along which friction acts, one or two.
    pub(in crate::nonsmooth) tangents: [Option<usize>; 2],
    /// The direction of the slip that is there, of length 1.
    pub(in crate::nonsmooth) slip: Option<[S; 2]>,
}

/// A choice for one unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Choice<S> {
    Given(S),
    Holds,
    Slides(S, S),
    /// A limit: it bears, or has its least effort. Its friction.
    On(bool, Friction<S>),
    Tangent,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Friction<S> {
    Nothing,
    Sticks,
    /// It slips in a direction that is there.
    Slips([S; 2]),
    /// It begins to slip in a direction.
    Begins([S; 2]),
    /// It begins to slip in a direction that is looked for.
    Seeks,
}

impl<S: Real> Rough<S> {
    pub(super) fn has_plane(&self) -> bool {
        self.tangents.iter().all(Option::is_some)
    }

    /// In how many ways there may be friction.
    pub(super) fn ways(&self) -> usize {
        match (self.slip, self.has_plane()) {
            (Some(_), _) => 1,
            (None, true) => 2,
            (None, false) => 3,
        }
    }

    pub(super) fn way(&self, number: usize) -> Friction<S> {
        let (zero, one) = (S::zero(), S::one());
        match (self.slip, number) {
            (Some(slip), _) => Friction::Slips(slip),
            (None, 0) => Friction::Sticks,
            (None, _) if self.has_plane() => Friction::Seeks,
            (None, 1) => Friction::Begins([one, zero]),
            (None, _) => Friction::Begins([-one, zero]),
        }
    }

    /// A vector in the plane of the contact.
    pub(super) fn read<const K: usize>(&self, elements: &[S; K]) -> [S; 2] {
        let read = |index: Option<usize>| index.map_or(S::zero(), |index| at(elements, index));
        self.tangents.map(read)
    }
}

impl<S: Real> Role<S> {
    /// How many choices there are.
    pub(super) fn choices(&self) -> usize {
        match self {
            Self::Given(_) | Self::Tangent => 1,
            Self::Within { bounds, .. } if bounds[0] < bounds[1] => 3,
            Self::Within { .. } => 2,
            Self::Pushes { rough: None, .. } => 2,
            Self::Pushes {
                rough: Some(rough),
                least,
                ..
            } => {
                let without = if *least > S::zero() { rough.ways() } else { 1 };
                rough.ways() + without
            }
        }
    }

    pub(super) fn choice(&self, number: usize) -> Choice<S> {
        match *self {
            Self::Given(effort) => Choice::Given(effort),
            Self::Tangent => Choice::Tangent,
            Self::Within { bounds, sliding } => {
                let number = if bounds[0] < bounds[1] {
                    number
                } else {
                    number + 1
                };
                match number {
                    0 => Choice::Holds,
                    1 => Choice::Slides(S::one(), sliding[0]),
                    _ => Choice::Slides(-S::one(), sliding[1]),
                }
            }
            Self::Pushes { rough: None, .. } => Choice::On(number == 0, Friction::Nothing),
            Self::Pushes {
                rough: Some(rough),
                least,
                ..
            } => {
                let ways = rough.ways();
                if number < ways {
                    Choice::On(true, rough.way(number))
                } else if least > S::zero() {
                    Choice::On(false, rough.way(number - ways))
                } else {
                    Choice::On(false, Friction::Nothing)
                }
            }
        }
    }
}

//! What can be chosen: motions of joints that carry bodies.

use core::marker::PhantomData;

use super::degrees_of_freedom;
use crate::error::{AnalysisFault, AssemblyFault, Fault};
use crate::math::without_bounds::copied;
use crate::mechanism::handle::{BodyHandle, JointHandle};
use crate::mechanism::joint_kernels::{JointCoordinates, JointMotion};
use crate::mechanism::kernels::configurations_alone;

/// Something with one rate: a joint that has one motion, or one motion of a joint.
pub trait Coordinate<M>: Copy + sealed::Sealed {
    #[doc(hidden)]
    fn place(self) -> Result<(usize, &'static str), Fault>;
}

/// One motion of a joint, or of a body that moves freely.
///
/// Motions of a joint count in the order of its definition: of a cylindrical joint the angle and
/// then the displacement, of a universal joint the angles of its axes. A free body has three
/// displacements along the global axes, then its rotation; a free particle has the displacements.
///
/// A rotation in all directions, of a spherical joint or a free body, has three rates. They are the
/// angular velocity (rad/s) **of the body that it carries against the ground**, along principal
/// axes. An effort on such a rate is a moment on that body, and not one between two. They are rates
/// of no coordinates, so that [`IndependentCoordinates::positions`] refuses them.
///
/// [`IndependentCoordinates::positions`]: super::IndependentCoordinates::positions
pub struct Motion<M> {
    mover: Mover,
    number: usize,
    mechanism: PhantomData<fn() -> M>,
}

/// What moves: a joint or a free body, by its index.
#[derive(Clone, Copy, Debug)]
enum Mover {
    Joint(usize),
    Body(usize),
}

impl<M> Motion<M> {
    /// The motion of a joint by its number, from 0.
    #[must_use]
    pub const fn of<J>(joint: JointHandle<M, J>, number: usize) -> Self {
        Self {
            mover: Mover::Joint(joint.index()),
            number,
            mechanism: PhantomData,
        }
    }

    /// The motion of a body that no joint carries, by its number: displacements along x, y and z,
    /// then angular velocities along its principal axes.
    #[must_use]
    pub const fn free(body: BodyHandle<M>, number: usize) -> Self {
        Self {
            mover: Mover::Body(body.index()),
            number,
            mechanism: PhantomData,
        }
    }
}

copied!([M] Motion<M>);

impl<M> core::fmt::Debug for Motion<M> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_tuple("Motion")
            .field(&self.mover)
            .field(&self.number)
            .finish()
    }
}

impl<M: JointCoordinates, J> Coordinate<M> for JointHandle<M, J> {
    fn place(self) -> Result<(usize, &'static str), Fault> {
        let (joint, motions) = (self.name(), Mover::Joint(self.index()).rates::<M>());
        match motions {
            0 | 1 => Motion::of(self, 0).place(),
            motions => Err(Fault::Analysis(AnalysisFault::SeveralMotions {
                joint,
                motions,
            })),
        }
    }
}

impl<M: JointCoordinates> Coordinate<M> for Motion<M> {
    fn place(self) -> Result<(usize, &'static str), Fault> {
        let joint = self.mover.name::<M>();
        if let Some(rate) = self.mover.rate::<M>(self.number) {
            return Ok((rate, joint));
        }
        Err(match (self.mover, self.mover.rates::<M>()) {
            (Mover::Joint(index), 0) => carries_nothing::<M>(index, joint),
            (Mover::Body(index), 0) => Fault::Analysis(AnalysisFault::Carried {
                body: joint,
                joint: carrier::<M>(index).unwrap_or(""),
            }),
            (_, motions) => Fault::Analysis(AnalysisFault::SeveralMotions { joint, motions }),
        })
    }
}

impl Mover {
    fn name<M: JointCoordinates>(self) -> &'static str {
        match self {
            Self::Joint(index) => M::REPORT.joints.get(index).map_or("", |info| info.name),
            Self::Body(index) => M::REPORT.bodies.get(index).map_or("", |info| info.name),
        }
    }

    /// Its motions, as they stand in the tree, from the carrier outwards.
    fn motions<M: JointCoordinates>(self) -> impl DoubleEndedIterator<Item = &'static JointMotion> {
        let name = self.name::<M>();
        let motions = M::JOINT_REPORT.motions.iter();
        motions.filter(move |motion| match self {
            Self::Joint(_) => motion.joint == name,
            Self::Body(_) => motion.joint.is_empty() && motion.body == name,
        })
    }

    /// How many rates it has.
    fn rates<M: JointCoordinates>(self) -> usize {
        self.motions::<M>().map(|motion| motion.rates().len()).sum()
    }

    /// The place of a rate, by its number in the order of the definition: that of the tree, or the
    /// opposite where the joint carries the first of its bodies.
    fn rate<M: JointCoordinates>(self, number: usize) -> Option<usize> {
        let mut left = number;
        let mut found = |motion: &'static JointMotion| {
            let rate = motion.rates().nth(left);
            left = left.saturating_sub(motion.rates().len());
            rate
        };
        if self.is_reversed::<M>() {
            self.motions::<M>().rev().find_map(&mut found)
        } else {
            self.motions::<M>().find_map(&mut found)
        }
    }

    fn is_reversed<M: JointCoordinates>(self) -> bool {
        let Self::Joint(index) = self else {
            return false;
        };
        let mut carriers = M::REPORT.carriers.iter();
        let carried = carriers.position(|carrier| carrier.joint == Some(index));
        let bodies = M::REPORT.joints.get(index).map(|info| info.bodies);
        let first = bodies.and_then(|bodies| bodies.first().copied());
        carried.is_some() && first == Some(carried)
    }
}

/// The joint that carries a body.
fn carrier<M: JointCoordinates>(body: usize) -> Option<&'static str> {
    let joint = M::REPORT.carriers.get(body)?.joint?;
    M::REPORT.joints.get(joint).map(|info| info.name)
}

/// The refusal of a joint that carries no body, with one that carries one of its bodies.
fn carries_nothing<M: JointCoordinates>(index: usize, joint: &'static str) -> Fault {
    let info = M::REPORT.joints.get(index);
    let bodies = info.map_or(&[][..], |info| info.bodies);
    let mut carriers = bodies
        .iter()
        .rev()
        .filter_map(|body| carrier::<M>((*body)?));
    Fault::Assembly(AssemblyFault::CarriesNothing {
        joint,
        instead: carriers.next(),
    })
}

/// `N` coordinates: an array of handles, or a tuple where they are of different types.
pub trait Chosen<M, const N: usize>: sealed::Sealed {
    #[doc(hidden)]
    fn places(self) -> Result<[(usize, &'static str); N], Fault>;
}

impl<M, C: Coordinate<M>, const N: usize> Chosen<M, N> for [C; N] {
    fn places(self) -> Result<[(usize, &'static str); N], Fault> {
        let mut places = [(0, ""); N];
        for (place, coordinate) in places.iter_mut().zip(self) {
            *place = coordinate.place()?;
        }
        Ok(places)
    }
}

macro_rules! tuples {
    ($($count:literal: $($name:ident)*;)*) => {$(
        impl<M, $($name: Coordinate<M>),*> Chosen<M, $count> for ($($name,)*) {
            #[allow(non_snake_case, reason = "each value has the name of its type")]
            fn places(self) -> Result<[(usize, &'static str); $count], Fault> {
                let ($($name,)*) = self;
                Ok([$($name.place()?),*])
            }
        }

        impl<$($name: sealed::Sealed),*> sealed::Sealed for ($($name,)*) {}
    )*};
}

tuples! {
    1: A;
    2: A B;
    3: A B C;
    4: A B C D;
    5: A B C D E;
    6: A B C D E F;
    7: A B C D E F G;
    8: A B C D E F G H;
}

/// The places of the chosen rates, as many as there are degrees of freedom, each once.
pub(super) fn places<M: JointCoordinates, const N: usize>(
    chosen: impl Chosen<M, N>,
) -> Result<[usize; N], Fault> {
    configurations_alone::<M>()?;
    distinct(chosen, degrees_of_freedom::<M>())
}

/// The places of as many rates as there are degrees of freedom of some kind, each once.
pub(super) fn distinct<M: JointCoordinates, const N: usize>(
    chosen: impl Chosen<M, N>,
    degrees_of_freedom: usize,
) -> Result<[usize; N], Fault> {
    if N != degrees_of_freedom {
        return Err(Fault::Analysis(AnalysisFault::ChosenCount {
            chosen: N,
            degrees_of_freedom,
        }));
    }
    let chosen = chosen.places()?;
    for (number, (place, joint)) in chosen.iter().enumerate() {
        let mut before = chosen.iter().take(number);
        if before.any(|(other, _)| other == place) {
            return Err(Fault::Analysis(AnalysisFault::ChosenTwice { joint }));
        }
    }
    Ok(chosen.map(|(place, _)| place))
}

mod sealed {
    use crate::mechanism::handle::JointHandle;

    pub trait Sealed {}

    impl<M, J> Sealed for JointHandle<M, J> {}
    impl<M> Sealed for super::Motion<M> {}
    impl<C: Sealed, const N: usize> Sealed for [C; N] {}
}

//! What can be chosen: motions of joints that carry bodies.

use super::degrees_of_freedom;
use crate::error::Fault;
use crate::mechanism::handle::JointHandle;
use crate::mechanism::joint_kernels::{Freedom, JointCoordinates};
use crate::mechanism::report::Carrier;

/// Something with one rate: a joint that has one motion, or one motion of a joint.
pub trait Coordinate<M>: Copy + sealed::Sealed {
    #[doc(hidden)]
    fn place(self) -> Result<(usize, &'static str), Fault>;
}

/// One motion of a joint that has several, in the order of its definition: of a cylindrical joint
/// the angle and then the displacement, of a universal joint the angles of its axes.
///
/// Of a spherical joint, and of the rotation of a free body, the three angular velocities (rad/s)
/// along the principal axes of the body that it carries: they are rates of no coordinates, and
/// [`IndependentCoordinates::positions`](super::IndependentCoordinates::positions) refuses them.
pub struct Motion<M, J> {
    joint: JointHandle<M, J>,
    number: usize,
}

impl<M, J> Motion<M, J> {
    /// The motion of a joint by its number, from 0.
    #[must_use]
    pub const fn of(joint: JointHandle<M, J>, number: usize) -> Self {
        Self { joint, number }
    }
}

impl<M, J> Clone for Motion<M, J> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M, J> Copy for Motion<M, J> {}

impl<M, J> core::fmt::Debug for Motion<M, J> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_tuple("Motion")
            .field(&self.joint)
            .field(&self.number)
            .finish()
    }
}

impl<M: JointCoordinates, J> Coordinate<M> for JointHandle<M, J> {
    fn place(self) -> Result<(usize, &'static str), Fault> {
        let joint = self.name();
        match rates_of::<M>(joint).count() {
            0 => Err(carries_nothing::<M>(self.index(), joint)),
            1 => Motion::of(self, 0).place(),
            motions => Err(Fault::SeveralMotions { joint, motions }),
        }
    }
}

impl<M: JointCoordinates, J> Coordinate<M> for Motion<M, J> {
    fn place(self) -> Result<(usize, &'static str), Fault> {
        let joint = self.joint.name();
        let motions = rates_of::<M>(joint).count();
        let rate = rates_of::<M>(joint).nth(self.number);
        rate.map(|rate| (rate, joint)).ok_or_else(|| match motions {
            0 => carries_nothing::<M>(self.joint.index(), joint),
            _ => Fault::SeveralMotions { joint, motions },
        })
    }
}

/// The places of the rates of a joint.
fn rates_of<M: JointCoordinates>(joint: &'static str) -> impl Iterator<Item = usize> {
    let motions = M::JOINT_REPORT.motions.iter();
    let own = motions.filter(move |motion| motion.joint == joint);
    own.flat_map(|motion| {
        let rates = match motion.freedom {
            Freedom::Ball => 3,
            Freedom::Turn { .. } | Freedom::Slide | Freedom::Screw { .. } => 1,
        };
        motion.velocity..motion.velocity + rates
    })
}

/// The refusal of a joint that carries no body, with one that carries one of its bodies.
fn carries_nothing<M: JointCoordinates>(index: usize, joint: &'static str) -> Fault {
    let bodies = M::REPORT
        .joints
        .get(index)
        .map_or(&[][..], |info| info.bodies);
    let carrier = |body: &Option<usize>| -> Option<&Carrier> { M::REPORT.carriers.get((*body)?) };
    let carriers = bodies.iter().rev().filter_map(carrier);
    let mut joints = carriers.filter_map(|carrier| M::REPORT.joints.get(carrier.joint?));
    Fault::CarriesNothing {
        joint,
        instead: joints.next().map(|info| info.name),
    }
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
    let degrees_of_freedom = degrees_of_freedom::<M>();
    if N != degrees_of_freedom {
        return Err(Fault::ChosenCount {
            chosen: N,
            degrees_of_freedom,
        });
    }
    let chosen = chosen.places()?;
    for (number, (place, joint)) in chosen.iter().enumerate() {
        let mut before = chosen.iter().take(number);
        if before.any(|(other, _)| other == place) {
            return Err(Fault::ChosenTwice { joint });
        }
    }
    Ok(chosen.map(|(place, _)| place))
}

mod sealed {
    use crate::mechanism::handle::JointHandle;

    pub trait Sealed {}

    impl<M, J> Sealed for JointHandle<M, J> {}
    impl<M, J> Sealed for super::Motion<M, J> {}
    impl<C: Sealed, const N: usize> Sealed for [C; N] {}
}

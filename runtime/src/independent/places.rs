//! Where the chosen coordinates stand among the rates of all joints, known when they are chosen.

use core::ops::Deref;

use super::elimination::at;
use crate::math::scalar::Scalar;
use crate::mechanism::joint_kernels::Freedom;
use crate::mechanism::joint_rates::JointRates;
use crate::mechanism::turns;
use crate::state::vector::Array;

/// The places of the chosen rates.
#[derive(Clone, Copy)]
pub(super) struct Places<const N: usize> {
    places: [usize; N],
    /// Whether these are all rates, in their order: then none of them has to be sought.
    pub(super) are_all: bool,
    /// The places of their angles in the account of turns.
    counted: [Option<usize>; N],
}

impl<const N: usize> Deref for Places<N> {
    type Target = [usize; N];

    fn deref(&self) -> &[usize; N] {
        &self.places
    }
}

impl<const N: usize> Places<N> {
    pub(super) fn of<M: JointRates>(places: [usize; N]) -> Self {
        let rates = M::JointVelocities::<f64>::zeros().as_slice().len();
        Self {
            places,
            are_all: rates == N && places.iter().copied().eq(0..N),
            counted: places.map(counted::<M>),
        }
    }

    /// The places, and those in the account of turns.
    pub(super) fn with_counted(&self) -> impl Iterator<Item = (&usize, Option<usize>)> {
        self.places.iter().zip(self.counted)
    }

    /// Numbers of the chosen rates among those of all.
    #[inline]
    pub(super) fn take<S: Scalar>(&self, all: &[S]) -> [S; N] {
        if self.are_all {
            let mut chosen = [S::zero(); N];
            let places = chosen.iter_mut().zip(all);
            places.for_each(|(place, &number)| *place = number);
            return chosen;
        }
        self.places.map(|place| at(all, place))
    }

    /// Writes numbers of the chosen rates among those of all.
    #[inline]
    pub(super) fn put<S: Scalar>(&self, chosen: &[S; N], all: &mut [S]) {
        if self.are_all {
            let places = all.iter_mut().zip(chosen);
            places.for_each(|(place, &number)| *place = number);
            return;
        }
        for (&place, &number) in self.places.iter().zip(chosen) {
            if let Some(place) = all.get_mut(place) {
                *place = number;
            }
        }
    }

    /// Writes the chosen angles, over all turns, into the account of a state.
    #[inline]
    pub(super) fn count<S: Scalar>(&self, positions: impl Iterator<Item = S>, turns: &mut [S]) {
        for (place, position) in self.counted.iter().zip(positions) {
            if let Some(counted) = place.and_then(|place| turns.get_mut(place)) {
                *counted = position;
            }
        }
    }
}

/// The place in the account of angles of what a rate turns. A joint has one account: of several
/// turns none is known to be that of its angle.
fn counted<M: JointRates>(rate: usize) -> Option<usize> {
    let (_, motion) = M::JOINT_REPORT.motion_of_rate(rate)?;
    let motions = M::JOINT_REPORT.motions.iter();
    let turns = motions.filter(|other| {
        other.joint == motion.joint && matches!(other.freedom, Freedom::Turn { .. })
    });
    if !matches!(motion.freedom, Freedom::Turn { .. }) || turns.count() != 1 {
        return None;
    }
    let mut joints = M::REPORT.joints.iter();
    turns::place_of::<M>(joints.position(|joint| joint.name == motion.joint)?)
}

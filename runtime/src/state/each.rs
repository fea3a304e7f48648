//! One thing for every element of a state.

use core::array::from_fn;
use core::ops::{Index, IndexMut};

/// One thing for every element of a [`crate::state::State`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EachOfState<T, const Q: usize, const U: usize> {
    coordinates: [T; Q],
    velocities: [T; U],
}

impl<T: Clone, const Q: usize, const U: usize> EachOfState<T, Q, U> {
    pub(crate) fn new(value: T) -> Self {
        Self {
            coordinates: from_fn(|_| value.clone()),
            velocities: from_fn(|_| value.clone()),
        }
    }
}

impl<T, const Q: usize, const U: usize> Index<usize> for EachOfState<T, Q, U> {
    type Output = T;

    #[inline(always)]
    fn index(&self, index: usize) -> &T {
        if index < Q {
            &self.coordinates[index]
        } else {
            &self.velocities[index - Q]
        }
    }
}

impl<T, const Q: usize, const U: usize> IndexMut<usize> for EachOfState<T, Q, U> {
    #[inline(always)]
    fn index_mut(&mut self, index: usize) -> &mut T {
        if index < Q {
            &mut self.coordinates[index]
        } else {
            &mut self.velocities[index - Q]
        }
    }
}

/// One thing for every element of a [`crate::state::JointState`], the two of every pair among them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EachOfJoints<T, const TURNS: usize, const REST: usize, const RATES: usize> {
    pairs: [[T; 2]; TURNS],
    others: EachOfState<T, REST, RATES>,
}

impl<T: Clone, const TURNS: usize, const REST: usize, const RATES: usize>
    EachOfJoints<T, TURNS, REST, RATES>
{
    pub(crate) fn new(value: T) -> Self {
        Self {
            pairs: from_fn(|_| [value.clone(), value.clone()]),
            others: EachOfState::new(value),
        }
    }
}

impl<T, const TURNS: usize, const REST: usize, const RATES: usize> Index<usize>
    for EachOfJoints<T, TURNS, REST, RATES>
{
    type Output = T;

    #[inline(always)]
    fn index(&self, index: usize) -> &T {
        if index < 2 * TURNS {
            &self.pairs[index / 2][index % 2]
        } else {
            &self.others[index - 2 * TURNS]
        }
    }
}

impl<T, const TURNS: usize, const REST: usize, const RATES: usize> IndexMut<usize>
    for EachOfJoints<T, TURNS, REST, RATES>
{
    #[inline(always)]
    fn index_mut(&mut self, index: usize) -> &mut T {
        if index < 2 * TURNS {
            &mut self.pairs[index / 2][index % 2]
        } else {
            &mut self.others[index - 2 * TURNS]
        }
    }
}

//! The Jacobian of rates that an implicit method keeps, and what is known of its zeros.

use super::newton::remember_columns;
use super::{Memory, System};
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::state::vector::Vector;

/// The columns of a Jacobian by the elements of a state.
#[derive(Clone)]
pub(super) struct Jacobian<S: Real, X: Vector<S>> {
    pub(super) columns: X::Each<X>,
    /// Whether the rates of coordinates are made of velocities alone, of two at most.
    is_kinematic: bool,
    /// The velocities that a coordinate is moved by, and the factors, which are zero where there
    /// are fewer than two.
    moved: X::Each<[(usize, S); 2]>,
    /// The coordinates that the rates of velocities depend on, and how many these are.
    acting: (X::Each<usize>, usize),
}

/// What a Jacobian has where the rates of coordinates are made of velocities alone.
pub(super) struct Kinematics<'a, S: Real, X: Vector<S>> {
    pub(super) columns: &'a X::Each<X>,
    pub(super) moved: &'a X::Each<[(usize, S); 2]>,
    acting: (&'a X::Each<usize>, usize),
}

impl<S: Real, X: Vector<S>> Kinematics<'_, S, X> {
    /// The coordinates that the rates of velocities depend on.
    #[inline(always)]
    pub(super) fn acting(&self) -> impl Iterator<Item = usize> {
        let (coordinates, count) = self.acting;
        (0..count).map(|place| coordinates[place])
    }
}

impl<S: Real, X: Vector<S>> Jacobian<S, X> {
    /// A place for one between slopes like this.
    pub(super) fn new(like: &X) -> Self {
        Self {
            columns: like.each(like.zip(like, |_, _| S::zero())),
            is_kinematic: false,
            moved: like.each([(0, S::zero()); 2]),
            acting: (like.each(0), 0),
        }
    }

    /// Evaluates it, see [`System::jacobian`].
    pub(super) fn evaluate<Y: System<S, State = X>>(
        &mut self,
        system: &mut Y,
        time: S,
        (state, rates): (&X, &X),
    ) -> Result<(), Fault> {
        system.jacobian(time, state, rates, &mut self.columns)?;
        self.look(state);
        Ok(())
    }

    /// Its part of [`Integration::remember`](super::Integration::remember).
    pub(super) fn remember(&mut self, memory: &mut Memory<'_, S>, state: &X) {
        remember_columns::<S, X>(memory, &mut self.columns, state.length());
        self.look(state);
    }

    /// Its parts, where the rates of coordinates are made of velocities alone.
    #[inline(always)]
    pub(super) fn kinematics(&self) -> Option<Kinematics<'_, S, X>> {
        self.is_kinematic.then_some(Kinematics {
            columns: &self.columns,
            moved: &self.moved,
            acting: (&self.acting.0, self.acting.1),
        })
    }

    /// Finds what is zero.
    pub(super) fn look(&mut self, like: &X) {
        let coordinates = like.coordinate_count();
        let velocities = like.velocities_slice().len();
        self.is_kinematic = velocities > 0
            && coordinates + velocities == like.length()
            && (0..coordinates).all(|row| self.moves(row, coordinates, velocities));
        if !self.is_kinematic {
            return;
        }
        let (acting, count) = &mut self.acting;
        *count = 0;
        for coordinate in 0..coordinates {
            let column = &self.columns[coordinate];
            if column.velocities_slice().iter().any(|&x| x != S::zero()) {
                acting[*count] = coordinate;
                *count += 1;
            }
        }
    }

    /// Finds the velocities that a coordinate is moved by. Whether there is nothing else.
    fn moves(&mut self, row: usize, coordinates: usize, velocities: usize) -> bool {
        let at = |column: usize| self.columns[column].element(row);
        let is_alone = (0..coordinates).all(|column| at(column) == S::zero());
        let entries = (0..velocities).map(|velocity| (velocity, at(coordinates + velocity)));
        let mut entries = entries.filter(|&(_, factor)| factor != S::zero());
        let moved = [(); 2].map(|()| entries.next().unwrap_or((0, S::zero())));
        let are_few = entries.next().is_none();
        self.moved[row] = moved;
        is_alone && are_few
    }
}

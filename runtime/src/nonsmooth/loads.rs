//! The loads of bearings, as functions of efforts: affine before their sizes are taken.

use crate::error::{Fault, ModeFault};
use crate::formulation::{Formulation, Solution};
use crate::math::scalar::Real;
use crate::math::vec3::norm;
use crate::mechanism::coordinates::{Absolute, Coordinates};
use crate::mechanism::kernels::{Mechanism, Terms as _};
use crate::mechanism::report::Rank;
use crate::nonsmooth::bearing::{Ends, Placed};
use crate::nonsmooth::box_problem::Factors;
use crate::nonsmooth::columns::{Columns, Setting, solved};
use crate::nonsmooth::status::Tracked;
use crate::state::vector::Array;

/// The equations in absolute coordinates at the same state, and their multipliers without efforts:
/// joints of a tree have no multipliers in relative coordinates.
pub(crate) type Reactions<'a, S, M, F> = (
    &'a Setting<'a, S, M, F, Absolute>,
    &'a <M as Mechanism>::Multipliers<S>,
);

/// A row of the matrix of holds that is less than this part of its diagonal depends on others.
const DEPENDS: f64 = 1e-8;

/// Of what efforts that share a load do to it, what is more than round-off.
const SHARED: f64 = 1e-5;

/// The forces at the ends of all bearings. Zeros where friction does not go with a load.
pub(super) struct BearingLoads<S, const K: usize> {
    /// Without efforts.
    pub(super) offset: [Ends<S>; K],
    /// What a unit of each effort adds, row by row.
    pub(super) by_effort: [[Ends<S>; K]; K],
}

impl<S: Real, const K: usize> BearingLoads<S, K> {
    /// The loads by the efforts that have columns; `solution` is the one without efforts.
    #[inline(never)]
    pub(super) fn of<M, F, C>(
        setting: &Setting<'_, S, M, F, C>,
        reactions: Option<Reactions<'_, S, M, F>>,
        list: &[Tracked<S, M>; K],
        columns: &Columns<S, M, C, K>,
        solution: &Solution<S, M, C>,
    ) -> Result<Self, Fault>
    where
        M: Mechanism,
        F: Formulation<S>,
        C: Coordinates<M>,
    {
        if F::Terms::COMPLIANT && !matches!(M::REPORT.rank, Rank::Decided { .. }) {
            let mut by_load = list.iter().filter(|tracked| tracked.bearing().is_some());
            let joint = by_load.next().map_or("", |first| first.interaction.name());
            return Err(Fault::Mode(ModeFault::LoadNotUnique { joint }));
        }
        setting.here(|scene| {
            let jacobian = M::jacobian(scene.constants, scene.time, scene.bodies);
            let placed: [Option<Placed<S>>; K] = list.each_ref().map(|tracked| {
                let bearing = tracked.bearing()?;
                if !tracked.status.is_engaged {
                    return None;
                }
                bearing.placed(&tracked.interaction.quantity, scene, jacobian.as_slice())
            });
            let read = |multipliers: &M::Multipliers<S>| {
                placed.each_ref().map(|placed| match placed {
                    Some(placed) => {
                        placed.ends::<M>(scene.bodies, jacobian.as_slice(), multipliers)
                    }
                    None => zeros(),
                })
            };
            let mut loads = Self {
                offset: [zeros(); K],
                by_effort: [[zeros(); K]; K],
            };
            loads.offset = match reactions {
                Some((_, multipliers)) => read(multipliers),
                None => {
                    let Solution {
                        accelerations,
                        multipliers,
                        ..
                    } = solution;
                    of_all(setting, accelerations, multipliers, &read)
                }
            };
            for (effort, tracked) in list.iter().enumerate() {
                let Some((accelerations, multipliers)) = columns.column(effort) else {
                    continue;
                };
                let column = match reactions {
                    Some((absolute, _)) => {
                        let mut unit = M::Velocities::<S>::zeros();
                        let quantity = &tracked.interaction.quantity;
                        quantity.add_effort(scene, S::one(), &mut unit);
                        read(&solved(absolute, &unit)?.1)
                    }
                    None => of_all(setting, accelerations, multipliers, &read),
                };
                for (row, ends) in loads.by_effort.iter_mut().zip(column) {
                    row[effort] = ends;
                }
                if let Some(placed) = &placed[effort] {
                    let own = &mut loads.by_effort[effort][effort];
                    add(S::one(), &placed.by_itself(), own);
                }
            }
            Ok(loads)
        })
    }

    /// The forces at the ends of a bearing by efforts, without what is there without.
    pub(super) fn along(&self, index: usize, efforts: &[S; K]) -> Ends<S> {
        let mut ends = zeros();
        for (by_effort, &effort) in self.by_effort[index].iter().zip(efforts) {
            add(effort, by_effort, &mut ends);
        }
        ends
    }

    /// The forces at its ends.
    pub(super) fn at(&self, index: usize, efforts: &[S; K]) -> Ends<S> {
        let mut ends = self.along(index, efforts);
        add(S::one(), &self.offset[index], &mut ends);
        ends
    }

    /// The load of every bearing: the sizes of the forces at its ends together.
    pub(super) fn sizes(&self, efforts: &[S; K]) -> [S; K] {
        core::array::from_fn(|index| size(&self.at(index, efforts)))
    }

    /// Of what size the terms of these are.
    pub(super) fn scales(&self, efforts: &[S; K]) -> [S; K] {
        core::array::from_fn(|index| {
            let terms = self.by_effort[index].iter().zip(efforts);
            terms.fold(size(&self.offset[index]), |sum, (ends, &effort)| {
                size(ends).fused(effort.abs(), sum)
            })
        })
    }

    /// Of the bearings that are asked for one whose load depends on how efforts share what they
    /// hold together: that is not determined.
    pub(super) fn shared(
        &self,
        matrix: &[[S; K]; K],
        holds: &[bool; K],
        asked: &[bool; K],
    ) -> Option<usize> {
        let mut before = [false; K];
        for effort in 0..K {
            if !holds[effort] {
                continue;
            }
            let column = matrix.each_ref().map(|row| row[effort]);
            // The same motion by others.
            let mut others = Factors::of(matrix, &before).solve(&column);
            let terms = matrix[effort].iter().zip(&others);
            let diagonal = matrix[effort][effort];
            let rest = terms.fold(diagonal, |rest, (&w, &x)| (-w).fused(x, rest));
            if rest > S::constant(DEPENDS) * diagonal {
                before[effort] = true;
                continue;
            }
            others = others.map(|other| -other);
            others[effort] = S::one();
            for index in (0..K).filter(|&index| asked[index]) {
                let change = size(&self.along(index, &others));
                let offset = size(&self.offset[index]);
                let terms = self.scales(&others)[index] - offset;
                if change > S::constant(SHARED) * terms {
                    return Some(index);
                }
            }
        }
        None
    }
}

/// The loads of a solution in coordinates that have the rows of all joints; zeros in others.
fn of_all<S, M, F, C, const K: usize>(
    setting: &Setting<'_, S, M, F, C>,
    accelerations: &C::Velocities<S>,
    multipliers: &C::Multipliers<S>,
    read: &impl Fn(&M::Multipliers<S>) -> [Ends<S>; K],
) -> [Ends<S>; K]
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    let saddle = &setting.saddle;
    let all = C::by_all_rows(
        saddle.constants,
        saddle.state,
        saddle.right,
        accelerations,
        multipliers,
    );
    all.map_or([zeros(); K], |all| read(all.multipliers))
}

pub(super) fn zeros<S: Real>() -> Ends<S> {
    [[S::zero(); 3]; 3]
}

/// The sizes of all together.
pub(super) fn size<S: Real>(ends: &Ends<S>) -> S {
    ends.iter().fold(S::zero(), |sum, end| sum + norm(end))
}

/// `y = y + factor x`.
pub(super) fn add<S: Real>(factor: S, x: &Ends<S>, y: &mut Ends<S>) {
    let pairs = y.iter_mut().flatten().zip(x.iter().flatten());
    pairs.for_each(|(y, &x)| *y = x.fused(factor, *y));
}

//! What unit efforts do to a mechanism: further solutions of its factorised equations of motion.

use crate::error::Fault;
use crate::formulation::{Formulation, Saddle, Solution};
use crate::forward::{Forward, lifted};
use crate::math::scalar::Real;
use crate::mechanism::coordinates::{AbsoluteEquations, Coordinates};
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::reader::{LiftedReader, Reader};
use crate::nonsmooth::scene::Scene;
use crate::nonsmooth::status::Tracked;
use crate::state::vector::{Array, MovingState, StateParts as _, Vector};

/// The equations of motion at one time and state, factorised, with what reads the bodies.
pub struct Setting<'a, S: Real, M: Mechanism, F: Formulation<S>, C: Coordinates<M>> {
    pub(crate) saddle: Saddle<'a, S, M, C, F::Terms>,
    /// What [`Coordinates::begin`] left.
    pub(crate) rates: &'a C::State<S>,
    pub(crate) absolute: &'a AbsoluteEquations<S, M>,
    pub(crate) formulation: &'a F,
}

/// The part of its compliance without constraints below which a quantity has no freedom, in
/// `EPSILON`.
pub(super) const NO_FREEDOM: f64 = 1e3;

/// The numbers of a state that moves.
type Moving<S> = Forward<S, 1>;

impl<S, M, F, C> Setting<'_, S, M, F, C>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    /// Calls with the bodies at other velocities.
    pub(crate) fn with_velocities<R>(
        &self,
        velocities: &C::Velocities<S>,
        then: impl FnOnce(&Scene<'_, S, M>) -> R,
    ) -> R {
        let mut state = *self.saddle.state;
        let places = state.rates_slice_mut().iter_mut();
        places
            .zip(velocities.as_slice())
            .for_each(|(place, &velocity)| *place = velocity);
        self.with_scene(&state, then)
    }

    /// Calls with the bodies of the state.
    pub(crate) fn here<R>(&self, then: impl FnOnce(&Scene<'_, S, M>) -> R) -> R {
        self.with_scene(self.saddle.state, then)
    }

    fn with_scene<R>(&self, state: &C::State<S>, then: impl FnOnce(&Scene<'_, S, M>) -> R) -> R {
        C::with_bodies(self.saddle.constants, state, |bodies| {
            then(&Scene {
                constants: &self.absolute.constants,
                time: self.saddle.time,
                bodies,
            })
        })
    }

    /// How velocities have a part in the rates of all quantities.
    fn parts<const K: usize>(&self, list: &[Tracked<S, M>; K]) -> Parts<S, M, K> {
        let rows = self.here(|scene| {
            let mut reader = Reader::of(scene);
            list.each_ref().map(|tracked| {
                let quantity = &tracked.interaction.quantity;
                quantity.is_contact().then(|| {
                    let mut row = M::Velocities::<S>::zeros();
                    reader.each_part(quantity, |place, part| {
                        if let Some(element) = row.as_mut_slice().get_mut(place) {
                            *element = *element + part;
                        }
                    });
                    row
                })
            })
        });
        self.with_velocities(&Array::zeros(), |scene| Parts {
            rows,
            still: *scene.bodies.velocities(),
            offset: core::array::from_fn(|index| match rows[index] {
                Some(_) => S::zero(),
                None => list[index].interaction.quantity.rate(scene),
            }),
        })
    }

    /// What velocities add to the rates of those quantities that are asked for; zeros of others.
    fn added<const K: usize>(
        &self,
        list: &[Tracked<S, M>; K],
        parts: &Parts<S, M, K>,
        velocities: &C::Velocities<S>,
        is_asked: impl Fn(usize) -> bool,
    ) -> [S; K] {
        self.with_velocities(velocities, |scene| {
            let mut moving = *scene.bodies.velocities();
            let still = parts.still.as_slice();
            for (moving, &still) in moving.as_mut_slice().iter_mut().zip(still) {
                *moving = *moving - still;
            }
            let mut added = [S::zero(); K];
            for (index, rate) in added.iter_mut().enumerate() {
                if is_asked(index) {
                    *rate = match &parts.rows[index] {
                        Some(row) => {
                            let terms = row.as_slice().iter().zip(moving.as_slice());
                            terms.fold(S::zero(), |sum, (&part, &by)| part.fused(by, sum))
                        }
                        None => list[index].interaction.quantity.rate(scene) - parts.offset[index],
                    };
                }
            }
            added
        })
    }

    /// The accelerations of all quantities where the rates of the velocities are zero.
    #[inline(never)]
    pub(crate) fn bias<const K: usize>(&self, list: &[Tracked<S, M>; K]) -> [S; K] {
        let mut rates = *self.rates;
        let (constants, state) = (self.saddle.constants, self.saddle.state);
        let nothing = C::Velocities::<S>::zeros();
        C::finish(constants, self.saddle.time, state, &mut rates, &nothing);
        let mut moving = C::State::<Moving<S>>::zeros();
        let mut along = moving;
        for index in 0..state.length() {
            moving.set_element(index, Forward::fixed(state.element(index)));
            along.set_element(index, Forward::fixed(rates.element(index)));
        }
        let instant = Forward::new(S::zero(), [S::one()]);
        let moving = moving.plus([(instant, &along)]);
        let constants: C::Constants<Moving<S>> = lifted(constants);
        let absolute: M::Constants<Moving<S>> = lifted(&self.absolute.constants);
        C::with_bodies(&constants, &moving, |bodies| {
            let scene = Scene::<Moving<S>, M> {
                constants: &absolute,
                time: Forward::new(self.saddle.time, [S::one()]),
                bodies,
            };
            let mut reader = LiftedReader::of(&scene);
            list.each_ref().map(|tracked| {
                let rate = reader.rate(&tracked.interaction.quantity);
                let [acceleration] = rate.derivatives();
                acceleration
            })
        })
    }
}

/// How velocities have a part in the rates of quantities.
struct Parts<S: Real, M: Mechanism, const K: usize> {
    /// By the velocities of the bodies, of contacts.
    rows: [Option<M::Velocities<S>>; K],
    /// The velocities of the bodies where nothing moves but by time.
    still: M::Velocities<S>,
    /// The rates of what is no contact then.
    offset: [S; K],
}

/// The rates of all quantities.
pub(crate) fn rates<S: Real, M: Mechanism, const K: usize>(
    list: &[Tracked<S, M>; K],
    scene: &Scene<'_, S, M>,
) -> [S; K] {
    let mut reader = Reader::of(scene);
    list.each_ref()
        .map(|tracked| reader.rate(&tracked.interaction.quantity))
}

/// What a unit effort along each quantity does.
pub(crate) struct Columns<S: Real, M: Mechanism, C: Coordinates<M>, const K: usize> {
    velocities: [C::Velocities<S>; K],
    multipliers: [C::Multipliers<S>; K],
    /// What it does to the rate of every quantity: symmetric, positive semidefinite. Zeros of what
    /// has no freedom.
    pub(crate) delassus: [[S; K]; K],
    /// What it would do to its own rate without constraints.
    pub(super) free: [S; K],
    chosen: [bool; K],
    parts: Parts<S, M, K>,
}

impl<S: Real, M: Mechanism, C: Coordinates<M>, const K: usize> Columns<S, M, C, K> {
    /// The columns of those that are chosen; zeros of the others.
    #[inline(never)]
    pub(crate) fn of<F: Formulation<S>>(
        setting: &Setting<'_, S, M, F, C>,
        list: &[Tracked<S, M>; K],
        chosen: &[bool; K],
    ) -> Result<Self, Fault> {
        let mut columns = Self {
            velocities: [Array::zeros(); K],
            multipliers: [Array::zeros(); K],
            delassus: [[S::zero(); K]; K],
            free: [S::zero(); K],
            chosen: *chosen,
            parts: setting.parts(list),
        };
        let mass = M::metric::<S>(&setting.absolute.constants);
        let zero = S::zero();
        for (index, tracked) in list.iter().enumerate() {
            if !chosen[index] {
                continue;
            }
            let loads = columns.parts.rows[index].unwrap_or_else(|| {
                let mut loads = M::Velocities::<S>::zeros();
                setting.here(|scene| {
                    let quantity = &tracked.interaction.quantity;
                    quantity.add_effort(scene, S::one(), &mut loads);
                });
                loads
            });
            let free = loads.as_slice().iter().zip(mass.as_slice());
            let free = free.fold(zero, |sum, (&load, &mass)| {
                (load * load).fused(mass.reciprocal(), sum)
            });
            let (velocities, multipliers) = solved(setting, &loads)?;
            // Of what is chosen both halves of the matrix are the same.
            let is_asked = |row: usize| row >= index || !chosen[row];
            let rates = setting.added(list, &columns.parts, &velocities, is_asked);
            columns.velocities[index] = velocities;
            columns.multipliers[index] = multipliers;
            columns.free[index] = free;
            let compliance = rates[index];
            if compliance <= S::constant(NO_FREEDOM) * S::EPSILON * free {
                continue;
            }
            for (row, &rate) in rates.iter().enumerate() {
                columns.delassus[row][index] = rate;
            }
        }
        for i in 0..K {
            for j in 0..i {
                if chosen[i] && chosen[j] {
                    if columns.delassus[i][i] == zero {
                        columns.delassus[i][j] = zero;
                    }
                    columns.delassus[j][i] = columns.delassus[i][j];
                }
            }
        }
        Ok(columns)
    }

    /// The accelerations of all quantities at these rates of the velocities, exact to round-off:
    /// what these add to a [bias](Setting::bias).
    pub(crate) fn accelerations<F: Formulation<S>>(
        &self,
        setting: &Setting<'_, S, M, F, C>,
        list: &[Tracked<S, M>; K],
        bias: &[S; K],
        accelerations: &C::Velocities<S>,
    ) -> [S; K] {
        let mut all = setting.added(list, &self.parts, accelerations, |_| true);
        for (sum, &bias) in all.iter_mut().zip(bias) {
            *sum = *sum + bias;
        }
        all
    }

    /// The velocities and multipliers of one that was chosen.
    pub(super) fn column(&self, index: usize) -> Option<ColumnOf<'_, S, M, C>> {
        let column = (&self.velocities[index], &self.multipliers[index]);
        self.chosen[index].then_some(column)
    }

    /// Adds what efforts do to velocities or accelerations.
    pub(crate) fn add_velocities(&self, efforts: &[S; K], velocities: &mut C::Velocities<S>) {
        for (column, &effort) in self.velocities.iter().zip(efforts) {
            add(effort, column.as_slice(), velocities.as_mut_slice());
        }
    }

    /// Adds what they do to a solution.
    pub(crate) fn add_to(&self, efforts: &[S; K], solution: &mut Solution<S, M, C>) {
        self.add_velocities(efforts, &mut solution.accelerations);
        for (column, &effort) in self.multipliers.iter().zip(efforts) {
            let multipliers = solution.multipliers.as_mut_slice();
            add(effort, column.as_slice(), multipliers);
        }
    }
}

/// `y = y + factor x`, and nothing where the factor is zero.
fn add<S: Real>(factor: S, x: &[S], y: &mut [S]) {
    if factor != S::zero() {
        y.iter_mut()
            .zip(x)
            .for_each(|(y, &x)| *y = x.fused(factor, *y));
    }
}

/// Velocities and multipliers by loads.
pub(super) type ByLoads<S, M, C> = (
    <C as Coordinates<M>>::Velocities<S>,
    <C as Coordinates<M>>::Multipliers<S>,
);

/// The same of a unit effort.
type ColumnOf<'c, S, M, C> = (
    &'c <C as Coordinates<M>>::Velocities<S>,
    &'c <C as Coordinates<M>>::Multipliers<S>,
);

/// The solution for loads on the bodies alone.
pub(super) fn solved<S: Real, M: Mechanism, F: Formulation<S>, C: Coordinates<M>>(
    setting: &Setting<'_, S, M, F, C>,
    loads: &M::Velocities<S>,
) -> Result<ByLoads<S, M, C>, Fault> {
    let saddle = &setting.saddle;
    let prepared = (saddle.constants, saddle.coefficients);
    C::solve_loads::<S, F::Terms, _>(prepared, saddle.factors, loads, |right, solution| {
        let (accelerations, multipliers) = solution;
        let mut solution = Solution::<S, M, C> {
            accelerations,
            multipliers,
            iterations: 1,
            unconverged: false,
        };
        if F::ITERATED {
            let of_loads = Saddle { right, ..*saddle };
            setting.formulation.refine(&of_loads, &mut solution)?;
        }
        Ok((solution.accelerations, solution.multipliers))
    })
}

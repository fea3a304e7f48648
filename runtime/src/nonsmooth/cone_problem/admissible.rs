//! Whether what was found under a choice of modes is a solution.

use crate::math::scalar::Real;
use crate::nonsmooth::cone_problem::choices::{Choice, Friction, Role, Rough};
use crate::nonsmooth::cone_problem::{ConeProblem, ConeSolution, Outcome, UNCERTAIN, length};
use crate::nonsmooth::tied::{at, residuals};

/// What holds may have left so many times the round-off of its residual.
const LEFT_OVER: f64 = 1e4;

impl<S: Real, const K: usize> ConeProblem<S, K> {
    /// The efforts as a solution, if they are one.
    pub(super) fn admissible(
        &self,
        choices: &[Choice<S>; K],
        efforts: &[S; K],
    ) -> Option<ConeSolution<S, K>> {
        let rates = residuals(&self.matrix, &self.offset, efforts);
        let sizes = self.sizes(efforts);
        let noise = S::constant(UNCERTAIN) * S::EPSILON;
        let mut outcomes = [Outcome::Given; K];
        let mut idle: isize = 0;
        for index in 0..K {
            let (effort, rate) = (efforts[index], rates[index]);
            let diagonal = self.matrix[index][index];
            let moves = diagonal > S::zero();
            let of_rate = noise * sizes[index];
            let of_effort = if moves {
                of_rate.quotient(diagonal)
            } else {
                S::zero()
            };
            let rests = !moves || rate.abs() <= S::constant(LEFT_OVER) * of_rate;
            let is_right = match (choices[index], self.roles[index]) {
                (
                    Choice::Holds,
                    Role::Within {
                        bounds: [lower, upper],
                        ..
                    },
                ) => {
                    outcomes[index] = Outcome::Holds;
                    rests && effort >= lower - of_effort && effort <= upper + of_effort
                }
                (Choice::Slides(sign, _), _) => {
                    outcomes[index] = Outcome::Slides(sign);
                    sign * rate >= -of_rate
                }
                (Choice::On(bears, friction), Role::Pushes { sign, least, rough }) => {
                    let rightly = if bears {
                        outcomes[index] = Outcome::Holds;
                        rests && sign * effort >= least - of_effort
                    } else {
                        sign * rate >= -of_rate
                    };
                    let rubs = rough.is_none_or(|rough| {
                        let by = (&mut outcomes, &mut idle, of_effort);
                        self.rubs(&rough, (friction, effort), (efforts, &rates, &sizes), by)
                    });
                    rightly && rubs
                }
                _ => true,
            };
            if !is_right {
                return None;
            }
        }
        Some(ConeSolution {
            efforts: *efforts,
            residuals: rates,
            outcomes,
            idle,
        })
    }

    /// Whether the friction of a contact is as it was chosen.
    fn rubs(
        &self,
        rough: &Rough<S>,
        (friction, normal): (Friction<S>, S),
        (efforts, rates, sizes): (&[S; K], &[S; K], &[S; K]),
        (outcomes, idle, of_effort): (&mut [Outcome<S>; K], &mut isize, S),
    ) -> bool {
        let noise = S::constant(UNCERTAIN) * S::EPSILON;
        let (outcome, is_right) = match friction {
            Friction::Nothing => return true,
            Friction::Sticks => {
                let mut of_tangents = S::zero();
                let mut rests = true;
                for index in rough.tangents.into_iter().flatten() {
                    let diagonal = self
                        .matrix
                        .get(index)
                        .map_or(S::zero(), |row| at(row, index));
                    if diagonal > S::zero() {
                        let of_rate = noise * at(sizes, index);
                        of_tangents = of_tangents.max(of_rate.quotient(diagonal));
                        rests &= at(rates, index).abs() <= S::constant(LEFT_OVER) * of_rate;
                    }
                }
                let size = length(rough.read(efforts));
                let bears = rough.at_rest * (normal.abs() + of_effort);
                (Outcome::Holds, rests && size <= bears + of_tangents)
            }
            Friction::Slips(slip) => (Outcome::Slips(slip), true),
            Friction::Begins([x, y]) => {
                let [along, across] = rough.read(rates);
                let [first, second] = rough.read(sizes);
                let rate = x * along + y * across;
                // What was found at the end of its sticking is there to so many digits.
                let less = (rough.coefficient - rough.at_rest).quotient(rough.coefficient);
                let resolved = if rough.coefficient > S::zero() {
                    less
                } else {
                    S::zero()
                };
                let noise = (noise + resolved) * (first + second);
                let is_right = rate >= -noise;
                if rate <= noise {
                    let ended = rough.at_rest < rough.coefficient;
                    *idle += if ended { -1 } else { 1 };
                }
                (Outcome::Slips([x, y]), is_right)
            }
            Friction::Seeks => return false,
        };
        for index in rough.tangents.into_iter().flatten() {
            if let Some(place) = outcomes.get_mut(index) {
                *place = outcome;
            }
        }
        is_right
    }
}

//! The complementarity problem of contacts with Coulomb's cone, beside limits and dry friction.
//!
//! With a symmetric, positive semidefinite matrix `W`, look for efforts `x` with residuals
//! `w = W x + a`. At a contact, with the normal effort `N` and the friction `T` of its plane:
//! `N >= 0`, `w_n >= 0`, `N w_n = 0`, and `|T| <= mu N`, with `T = -mu N w_t / |w_t|` where `w_t`
//! is not zero (Moreau, *Unilateral contact and dry friction in finite freedom dynamics*, 1988).
//! Where the contact slips already, the direction of `T` is against that slip.
//!
//! Friction has no potential: there may be no solution, or several with different motions
//! (Painleve's paradox). So all choices of modes are tried, and what is found is told. Efforts that
//! depend on each other, as of a block on four corners, are shared: normal ones evenly, those of
//! friction in proportion to what each contact can bear.

use crate::math::scalar::Real;
use crate::nonsmooth::tied::{Lu, Tied, at, floors, residuals};

/// Choices of modes at the most.
const CHOICES: usize = 20_000;

/// Round-off of residuals and efforts, in `EPSILON`.
const NOISE: f64 = 256.0;

/// Residuals that differ by more than this part of their terms are of different motions.
const DIFFERENT: f64 = 1e-6;

/// Steps of Newton's method for directions of slip.
const STEPS: usize = 40;

/// Directions from which it starts.
const STARTS: usize = 8;

/// What may act at an unknown.
#[derive(Clone, Copy, Debug)]
pub(super) enum Role<S> {
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
pub(super) struct Rough<S> {
    /// Coulomb's coefficient.
    pub(super) coefficient: S,
    /// The same while it sticks: less by round-off for what was found at its end.
    pub(super) at_rest: S,
    /// The unknowns along which friction acts, one or two.
    pub(super) tangents: [Option<usize>; 2],
    /// The direction of the slip that is there, of length 1.
    pub(super) slip: Option<[S; 2]>,
}

/// Where an unknown is in a solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Outcome<S> {
    /// Nothing is held, or what acts is known.
    Given,
    /// It holds: a limit that bears, friction that sticks.
    Holds,
    /// Friction that slides at a rate of this sign.
    Slides(S),
    /// Friction of a contact, with the direction of its slip.
    Slips([S; 2]),
}

/// A problem of `K` unknowns.
#[derive(Clone, Copy, Debug)]
pub(super) struct ConeProblem<S, const K: usize> {
    pub(super) matrix: [[S; K]; K],
    pub(super) offset: [S; K],
    pub(super) roles: [Role<S>; K],
}

/// Its solution.
#[derive(Clone, Copy, Debug)]
pub(super) struct ConeSolution<S, const K: usize> {
    pub(super) efforts: [S; K],
    pub(super) residuals: [S; K],
    pub(super) outcomes: [Outcome<S>; K],
    /// At how many contacts slip begins without an acceleration, as others hold them, less those
    /// that were found at the end of their sticking.
    idle: isize,
}

/// Why there is none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NoSolution {
    /// No choice of modes is a solution.
    None,
    /// Several are, with different motions.
    Several,
    /// There are too many choices.
    TooMany,
}

/// A choice for one unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Choice<S> {
    Given(S),
    Holds,
    Slides(S, S),
    /// A limit: it bears, or has its least effort. Its friction.
    On(bool, Friction<S>),
    Tangent,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Friction<S> {
    Nothing,
    Sticks,
    /// It slips in a direction that is there.
    Slips([S; 2]),
    /// It begins to slip in a direction.
    Begins([S; 2]),
    /// It begins to slip in a direction that is looked for.
    Seeks,
}

/// What is solved for under a choice.
struct Guess<S, const K: usize> {
    tied: Tied<S, K>,
    given: [S; K],
}

impl<S: Real> Rough<S> {
    fn has_plane(&self) -> bool {
        self.tangents.iter().all(Option::is_some)
    }

    /// In how many ways there may be friction.
    fn ways(&self) -> usize {
        match (self.slip, self.has_plane()) {
            (Some(_), _) => 1,
            (None, true) => 2,
            (None, false) => 3,
        }
    }

    fn way(&self, number: usize) -> Friction<S> {
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
    fn read<const K: usize>(&self, elements: &[S; K]) -> [S; 2] {
        let read = |index: Option<usize>| index.map_or(S::zero(), |index| at(elements, index));
        self.tangents.map(read)
    }
}

impl<S: Real> Role<S> {
    /// How many choices there are.
    fn choices(&self) -> usize {
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

    fn choice(&self, number: usize) -> Choice<S> {
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

impl<S: Real, const K: usize> ConeProblem<S, K> {
    /// The solution, if all there are have the same motion.
    pub(super) fn solved(&self) -> Result<ConeSolution<S, K>, NoSolution> {
        let mut total: usize = 1;
        for role in &self.roles {
            total = total.saturating_mul(role.choices());
        }
        if total > CHOICES {
            return Err(NoSolution::TooMany);
        }
        let mut found: Option<ConeSolution<S, K>> = None;
        for number in 0..total {
            let Some(next) = self.under(self.numbered(number)) else {
                continue;
            };
            match &found {
                None => found = Some(next),
                Some(first) if self.differ(first, &next) => return Err(NoSolution::Several),
                Some(first) if next.idle < first.idle => found = Some(next),
                Some(_) => {}
            }
        }
        found.ok_or(NoSolution::None)
    }

    /// The choices of a number: what holds most comes first.
    fn numbered(&self, mut number: usize) -> [Choice<S>; K] {
        self.roles.each_ref().map(|role| {
            let choices = role.choices();
            let choice = role.choice(number.checked_rem(choices).unwrap_or(0));
            number = number.checked_div(choices).unwrap_or(0);
            choice
        })
    }

    fn differ(&self, a: &ConeSolution<S, K>, b: &ConeSolution<S, K>) -> bool {
        let sizes = [self.sizes(&a.efforts), self.sizes(&b.efforts)];
        (0..K).any(|index| {
            let [first, second] = sizes.each_ref().map(|sizes| sizes[index]);
            let difference = (a.residuals[index] - b.residuals[index]).abs();
            difference > S::constant(DIFFERENT) * first.max(second)
        })
    }

    /// Of what size the terms of the residuals are, beside the largest one in the metric of the
    /// mass: offsets are differences of what is as large.
    fn sizes(&self, efforts: &[S; K]) -> [S; K] {
        let mut sizes = self.offset.map(|offset| offset.abs());
        for (size, row) in sizes.iter_mut().zip(&self.matrix) {
            let terms = row.iter().zip(efforts);
            *size = terms.fold(*size, |sum, (&w, &x)| w.abs().fused(x.abs(), sum));
        }
        let root = |index: usize| self.matrix[index][index].max(S::zero()).sqrt();
        let mut strength = S::zero();
        for (index, &size) in sizes.iter().enumerate() {
            if root(index) > S::zero() {
                strength = strength.max(size.quotient(root(index)));
            }
        }
        core::array::from_fn(|index| sizes[index].max(strength * root(index)))
    }

    /// The solution under a choice, if it is one.
    fn under(&self, mut choices: [Choice<S>; K]) -> Option<ConeSolution<S, K>> {
        let seeks = |choice: &Choice<S>| matches!(choice, Choice::On(_, Friction::Seeks));
        if !choices.iter().any(seeks) {
            return self.admissible(&choices, &self.efforts(&choices)?);
        }
        let sought = choices.each_ref().map(seeks);
        // The slip that there would be without this friction: exact where it yields evenly.
        let mut smooth = choices;
        for (choice, &sought) in smooth.iter_mut().zip(&sought) {
            if let (Choice::On(bears, _), true) = (*choice, sought) {
                *choice = Choice::On(bears, Friction::Nothing);
            }
        }
        let free = residuals(&self.matrix, &self.offset, &self.efforts(&smooth)?);
        let mut turned = 0;
        while turned < STARTS {
            let angle = S::constant(turned as f64 * core::f64::consts::TAU / STARTS as f64);
            let (sine, cosine) = (angle.sin(), angle.cos());
            for (index, choice) in choices.iter_mut().enumerate() {
                if let (Choice::On(_, friction), true, Role::Pushes { rough, .. }) =
                    (choice, sought[index], self.roles[index])
                {
                    let [x, y] = rough.map_or([S::zero(); 2], |rough| rough.read(&free));
                    let start = [cosine * x - sine * y, sine * x + cosine * y];
                    *friction = Friction::Begins(unit(start)?);
                }
            }
            if let Some(efforts) = self.directed(&mut choices, &sought)
                && let Some(solution) = self.admissible(&choices, &efforts)
            {
                return Some(solution);
            }
            turned += 1;
        }
        None
    }

    /// What is solved for, and the efforts that are known.
    fn guess(&self, choices: &[Choice<S>; K]) -> Guess<S, K> {
        let mut guess = Guess {
            tied: Tied::nothing(),
            given: [S::zero(); K],
        };
        for (index, choice) in choices.iter().enumerate() {
            match (*choice, self.roles[index]) {
                (Choice::Given(effort) | Choice::Slides(_, effort), _) => {
                    guess.given[index] = effort;
                }
                (Choice::Holds, _) => guess.tied.holds[index] = true,
                (Choice::On(bears, friction), Role::Pushes { sign, least, rough }) => {
                    guess.tied.holds[index] = bears;
                    if !bears {
                        guess.given[index] = sign * least;
                    }
                    if let Some(rough) = rough {
                        guess.rub(index, &rough, friction);
                    }
                }
                _ => {}
            }
        }
        guess
    }

    /// All efforts under a choice.
    fn efforts(&self, choices: &[Choice<S>; K]) -> Option<[S; K]> {
        let Guess { tied, given } = self.guess(choices);
        let mut sticking = [None; K];
        for (index, choice) in choices.iter().enumerate() {
            let Role::Pushes {
                rough: Some(rough), ..
            } = self.roles[index]
            else {
                continue;
            };
            if let Choice::On(_, Friction::Sticks) = choice {
                for tangent in rough.tangents.into_iter().flatten() {
                    if let Some(place) = sticking.get_mut(tangent) {
                        *place = Some((index, rough.at_rest));
                    }
                }
            }
        }
        let efforts = tied.shared_beside(&self.matrix, (&self.offset, &given), &sticking);
        efforts
            .iter()
            .all(|effort| effort.is_finite())
            .then_some(efforts)
    }

    /// The efforts where slip begins in directions that are looked for by Newton's method, so that
    /// each is that of its residual.
    fn directed(&self, choices: &mut [Choice<S>; K], sought: &[bool; K]) -> Option<[S; K]> {
        for _ in 0..STEPS {
            let efforts = self.efforts(choices)?;
            let rates = residuals(&self.matrix, &self.offset, &efforts);
            let sizes = self.sizes(&efforts);
            let Guess { tied, .. } = self.guess(choices);
            let [_, floor] = floors();
            let factors = tied.factors(&self.matrix, &[S::one(); K], floor);
            let mut jacobian = [[S::zero(); K]; K];
            let mut turning = [S::zero(); K];
            let mut is_found = true;
            for index in 0..K {
                jacobian[index][index] = S::one();
                let Some((rough, direction)) = self.beginning(choices, sought, index) else {
                    continue;
                };
                let [x, y] = direction;
                let rate = rough.read(&rates);
                turning[index] = x * rate[1] - y * rate[0];
                let size = rough.read(&sizes);
                let noise = S::constant(NOISE) * S::EPSILON * (size[0] + size[1]);
                is_found &= turning[index].abs() <= noise;
                // What a turn of the direction does to all rates.
                let bears = rough.coefficient * efforts[index];
                let across = [y * bears, -(x * bears)];
                let mut turned = tied;
                for (tangent, by) in rough.tangents.into_iter().zip(across) {
                    if let Some(beside) = tangent.and_then(|index| turned.beside.get_mut(index)) {
                        *beside = by;
                    }
                }
                let mut change = [S::zero(); K];
                let nothing = [S::zero(); K];
                turned.complete((&self.matrix, &factors), &nothing, &mut change);
                let faster = residuals(&self.matrix, &nothing, &change);
                for (row, of_row) in jacobian.iter_mut().enumerate() {
                    if let Some((rough, [x, y])) = self.beginning(choices, sought, row) {
                        let faster = rough.read(&faster);
                        of_row[index] = x * faster[1] - y * faster[0];
                    }
                }
                jacobian[index][index] = jacobian[index][index] - (x * rate[0] + y * rate[1]);
            }
            if is_found {
                return Some(efforts);
            }
            let step = Lu::of(jacobian, [S::one(); K]).solve(turning);
            for index in 0..K {
                if let (Some((_, [x, y])), Choice::On(bears, _)) =
                    (self.beginning(choices, sought, index), choices[index])
                {
                    let by = (-step[index]).min(S::one()).max(-S::one());
                    let next = unit([x - by * y, y + by * x])?;
                    choices[index] = Choice::On(bears, Friction::Begins(next));
                }
            }
        }
        None
    }

    /// The friction of a contact whose direction of slip is looked for.
    fn beginning(
        &self,
        choices: &[Choice<S>; K],
        sought: &[bool; K],
        index: usize,
    ) -> Option<(Rough<S>, [S; 2])> {
        match (choices[index], self.roles[index]) {
            (
                Choice::On(_, Friction::Begins(direction)),
                Role::Pushes {
                    rough: Some(rough), ..
                },
            ) if sought[index] => Some((rough, direction)),
            _ => None,
        }
    }

    /// The efforts as a solution, if they are one.
    fn admissible(&self, choices: &[Choice<S>; K], efforts: &[S; K]) -> Option<ConeSolution<S, K>> {
        let rates = residuals(&self.matrix, &self.offset, efforts);
        let sizes = self.sizes(efforts);
        let noise = S::constant(NOISE) * S::EPSILON;
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
            let rests = !moves || rate.abs() <= S::constant(1e4) * of_rate;
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
        let noise = S::constant(NOISE) * S::EPSILON;
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
                        rests &= at(rates, index).abs() <= S::constant(1e4) * of_rate;
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

impl<S: Real, const K: usize> Guess<S, K> {
    /// The friction of the contact at an index.
    fn rub(&mut self, index: usize, rough: &Rough<S>, friction: Friction<S>) {
        let directions = match friction {
            Friction::Nothing | Friction::Seeks => return,
            Friction::Sticks => None,
            Friction::Slips(direction) | Friction::Begins(direction) => Some(direction),
        };
        for (place, tangent) in rough.tangents.into_iter().enumerate() {
            let Some(tangent) = tangent else {
                continue;
            };
            if let Some([x, y]) = directions {
                let component = if place == 0 { x } else { y };
                if let Some(follows) = self.tied.follows.get_mut(tangent) {
                    *follows = Some((index, -(rough.coefficient * component)));
                }
            } else if let Some(holds) = self.tied.holds.get_mut(tangent) {
                *holds = true;
            }
        }
    }
}

/// A direction, of length 1; `None` where there is none.
fn unit<S: Real>([x, y]: [S; 2]) -> Option<[S; 2]> {
    let size = length([x, y]);
    (size > S::smallest()).then(|| [x.quotient(size), y.quotient(size)])
}

/// The length of a vector in a plane.
pub(super) fn length<S: Real>([x, y]: [S; 2]) -> S {
    // In the scale of the larger one, whose square may not be a number.
    let largest = x.abs().max(y.abs());
    if largest <= S::smallest() {
        return largest;
    }
    let (x, y) = (x.quotient(largest), y.quotient(largest));
    largest * x.fused(x, y * y).sqrt()
}

#[cfg(test)]
mod tests;

//! The search for a solution among all choices of modes.

use crate::math::scalar::Real;
use crate::nonsmooth::cone_problem::choices::{Choice, Friction, Role, Rough};
use crate::nonsmooth::cone_problem::{
    ConeProblem, ConeSolution, NoSolution, Outcome, UNCERTAIN, length,
};
use crate::nonsmooth::tied::{Lu, Tied, floors, residuals};

/// Choices of modes at the most.
const CHOICES: usize = 20_000;

/// Residuals that differ by more than this part of their terms are of different motions.
const DIFFERENT: f64 = 1e-6;

/// Steps of Newton's method for directions of slip.
const STEPS: usize = 20;

/// Directions that are off by so many `EPSILON` over the floor of shares are found where a step no
/// longer halves that. Shares of what motion does not determine are known to no more digits.
const OF_SHARES: f64 = 16.0;

/// Directions from which it starts, before that of relaxation: first, and where that finds nothing.
const STARTS: [usize; 2] = [8, 64];

/// Directions of other contacts than the first one are then turned by the roots of these, times the
/// number of the start. So starts lie evenly among all directions of all contacts.
const ROOTS_OF: [f64; 8] = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0];

/// How solutions are looked for.
struct Search<'a, S, const K: usize> {
    /// Directions from which slip that is looked for starts.
    starts: usize,
    /// Residuals near to those of a solution.
    relaxed: &'a [S; K],
    /// Each contact is turned by another part of a turn.
    apart: bool,
}

impl<'a, S, const K: usize> Search<'a, S, K> {
    fn first(relaxed: &'a [S; K]) -> Self {
        Self {
            starts: STARTS[0],
            relaxed,
            apart: false,
        }
    }

    fn last(relaxed: &'a [S; K]) -> Self {
        Self {
            starts: STARTS[1],
            relaxed,
            apart: true,
        }
    }
}

impl<S: Real, const K: usize> Search<'_, S, K> {
    /// The sine and the cosine of what the direction of a contact is turned by at a start. All are
    /// turned alike at first, and each by another part of a turn in the last search.
    fn turned(&self, start: usize, number: usize) -> (S, S) {
        let other = number.checked_sub(1).filter(|_| self.apart);
        let part = match other.and_then(|other| ROOTS_OF.get(other)) {
            Some(&square) => S::constant(start as f64) * S::constant(square).sqrt(),
            None => S::constant(start as f64 / self.starts as f64),
        };
        let angle = part * S::constant(core::f64::consts::TAU);
        (angle.sin(), angle.cos())
    }
}

/// What is solved for under a choice.
struct Guess<S, const K: usize> {
    tied: Tied<S, K>,
    given: [S; K],
}

impl<S: Real, const K: usize> ConeProblem<S, K> {
    /// The solution, if all there are have the same motion.
    pub(in crate::nonsmooth) fn solved(&self) -> Result<ConeSolution<S, K>, NoSolution> {
        let mut total: usize = 1;
        for role in &self.roles {
            total = total.saturating_mul(role.choices());
        }
        if total > CHOICES {
            return Err(NoSolution::TooMany);
        }
        let relaxed = self.relaxed();
        match self.among(total, &Search::first(&relaxed))? {
            Some(found) => Ok(found),
            None => self
                .among(total, &Search::last(&relaxed))?
                .ok_or(NoSolution::None),
        }
    }

    /// The solution among so many choices.
    fn among(
        &self,
        total: usize,
        search: &Search<'_, S, K>,
    ) -> Result<Option<ConeSolution<S, K>>, NoSolution> {
        let mut found: Option<ConeSolution<S, K>> = None;
        for number in 0..total {
            let Some(next) = self.under(self.numbered(number), search) else {
                continue;
            };
            match &found {
                None => found = Some(next),
                Some(first) if self.differ(first, &next) => return Err(NoSolution::Several),
                Some(first) if self.is_before(&next, first) => found = Some(next),
                Some(_) => {}
            }
        }
        Ok(found)
    }

    /// The directions of slip where what there is holds or slips, at the friction of each contact.
    /// Those of contacts that are marked there are such that each is that of its residual, from
    /// the one that they have.
    pub(in crate::nonsmooth) fn directions(&self, begins: &[bool; K]) -> Option<[[S; 2]; K]> {
        let mut sought = [false; K];
        let mut choices = [Choice::Tangent; K];
        for (index, role) in self.roles.iter().enumerate() {
            choices[index] = match *role {
                Role::Given(effort) => Choice::Given(effort),
                Role::Tangent => Choice::Tangent,
                Role::Within { .. } => Choice::Holds,
                Role::Pushes { rough: None, .. } => Choice::On(true, Friction::Nothing),
                Role::Pushes {
                    rough: Some(rough), ..
                } => {
                    let first = rough.tangents[0].and_then(|first| begins.get(first));
                    sought[index] = first == Some(&true) && rough.slip.is_some();
                    Choice::On(
                        true,
                        match rough.slip {
                            None => Friction::Sticks,
                            Some(slip) if sought[index] => Friction::Begins(slip),
                            Some(slip) => Friction::Slips(slip),
                        },
                    )
                }
            };
        }
        self.directed(&mut choices, &sought)?;
        let mut directions = [[S::zero(); 2]; K];
        for (index, choice) in choices.iter().enumerate() {
            let Role::Pushes {
                rough: Some(rough), ..
            } = self.roles[index]
            else {
                continue;
            };
            if let Choice::On(_, Friction::Begins(slip) | Friction::Slips(slip)) = *choice {
                for tangent in rough.tangents.into_iter().flatten() {
                    if let Some(place) = directions.get_mut(tangent) {
                        *place = slip;
                    }
                }
            }
        }
        Some(directions)
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

    /// Whether a solution is taken in the place of another one, where only the shares of a load
    /// differ, and with them what friction does. Whatever the order of contacts is: the one in
    /// which fewer slip idly, or in which more of them bear, or which shares more evenly.
    fn is_before(&self, next: &ConeSolution<S, K>, first: &ConeSolution<S, K>) -> bool {
        if next.idle != first.idle {
            return next.idle < first.idle;
        }
        let (mut bearing, mut before): (usize, usize) = (0, 0);
        let (mut uneven, mut terms) = (S::zero(), S::zero());
        for (index, role) in self.roles.iter().enumerate() {
            if matches!(role, Role::Pushes { .. }) {
                bearing += usize::from(next.outcomes[index] == Outcome::Holds);
                before += usize::from(first.outcomes[index] == Outcome::Holds);
                let size = |effort: S| self.matrix[index][index] * effort * effort;
                let [now, then] = [next, first].map(|one| size(one.efforts[index]));
                uneven = uneven + (now - then);
                terms = terms + (now + then);
            }
        }
        if bearing != before {
            return bearing > before;
        }
        uneven < -(S::constant(DIFFERENT) * terms)
    }

    /// Whether contacts open differently.
    fn differ(&self, a: &ConeSolution<S, K>, b: &ConeSolution<S, K>) -> bool {
        let sizes = [self.sizes(&a.efforts), self.sizes(&b.efforts)];
        let is_limit = |index: &usize| matches!(self.roles[*index], Role::Pushes { .. });
        (0..K).filter(is_limit).any(|index| {
            let [first, second] = sizes.each_ref().map(|sizes| sizes[index]);
            let difference = (a.residuals[index] - b.residuals[index]).abs();
            difference > S::constant(DIFFERENT) * first.max(second)
        })
    }

    /// The solution under a choice, if it is one.
    fn under(
        &self,
        mut choices: [Choice<S>; K],
        search: &Search<'_, S, K>,
    ) -> Option<ConeSolution<S, K>> {
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
        for start in 0..=search.starts {
            let from = if start == search.starts {
                search.relaxed
            } else {
                &free
            };
            let mut number = 0;
            for (index, choice) in choices.iter_mut().enumerate() {
                if let (Choice::On(_, friction), true, Role::Pushes { rough, .. }) =
                    (choice, sought[index], self.roles[index])
                {
                    let [x, y] = rough.map_or([S::zero(); 2], |rough| rough.read(from));
                    let (sine, cosine) = search.turned(start, number);
                    let way = [cosine * x - sine * y, sine * x + cosine * y];
                    *friction = Friction::Begins(unit(way)?);
                    number += 1;
                }
            }
            if let Some(efforts) = self.directed(&mut choices, &sought)
                && let Some(solution) = self.admissible(&choices, &efforts)
            {
                return Some(solution);
            }
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
        let mut before = S::constant(f64::INFINITY);
        for _ in 0..STEPS {
            let efforts = self.efforts(choices)?;
            let rates = residuals(&self.matrix, &self.offset, &efforts);
            let sizes = self.sizes(&efforts);
            let Guess { tied, .. } = self.guess(choices);
            let [of_shares, floor] = floors();
            let factors = tied.factors(&self.matrix, &[S::one(); K], floor);
            let mut jacobian = [[S::zero(); K]; K];
            let (mut turning, mut scales) = ([S::zero(); K], [S::zero(); K]);
            let mut worst = S::zero();
            for index in 0..K {
                let Some((rough, direction)) = self.beginning(choices, sought, index) else {
                    continue;
                };
                scales[index] = S::one();
                let [x, y] = direction;
                let rate = rough.read(&rates);
                turning[index] = x * rate[1] - y * rate[0];
                let size = rough.read(&sizes);
                let size = (size[0] + size[1]).max(S::smallest());
                worst = worst.max(turning[index].abs().quotient(size));
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
            let gains_nothing = worst > S::constant(0.5) * before;
            let nearly = (S::constant(OF_SHARES) * S::EPSILON).quotient(of_shares);
            let is_found = worst <= S::constant(UNCERTAIN) * S::EPSILON;
            if is_found || gains_nothing && worst <= nearly {
                return Some(efforts);
            }
            before = worst;
            let step = Lu::of(&jacobian, scales).solve(&turning);
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

//! The search for the cheapest of several ways, each of which may have several ways within it.

use std::collections::VecDeque;

/// Trials within trials; deeper down, the first candidate is taken. Without a bound, their number
/// is exponential in the depth of a vector.
const MOST_TRIALS: usize = 4;

/// What a search has tried and chosen so far.
#[derive(Debug, Default)]
pub(super) struct Search {
    /// Trials within trials that are going on.
    trials: usize,
    /// The choices made in the trial that is going on, in the order in which they were needed.
    choices: Vec<usize>,
    /// Those that are known, from the trial of what is being done.
    known: VecDeque<usize>,
}

impl Search {
    /// The cheapest of so many candidates, the first on ties; `None` if there is none. `cost` tries
    /// one, and forgets it. What is chosen is to be done next, by this search.
    pub(super) fn choose(
        &mut self,
        candidates: usize,
        mut cost: impl FnMut(&mut Self, usize) -> usize,
    ) -> Option<usize> {
        match candidates {
            0 => return None,
            1 => return Some(0),
            _ => {}
        }
        let place = if let Some(known) = self.known.pop_front() {
            known
        } else if self.trials >= MOST_TRIALS {
            0
        } else {
            let before = self.choices.len();
            let mut best: Option<(usize, usize, Vec<usize>)> = None;
            for place in 0..candidates {
                self.trials += 1;
                let cost = cost(self, place);
                self.trials -= 1;
                let choices = self.choices.drain(before..);
                if best.as_ref().is_none_or(|(least, ..)| cost < *least) {
                    best = Some((cost, place, choices.collect()));
                }
                if cost == 0 {
                    break;
                }
            }
            let (_, place, choices) = best?;
            // What is done now was just tried: with the same choices all the way down.
            self.known = choices.into();
            place
        };
        self.choices.push(place);
        Some(place)
    }
}

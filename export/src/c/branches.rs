//! What is computed for one side of a choice alone, so that it can stand behind a branch.

use std::collections::HashMap;

use crate::tape::{Operation, Place, Tape, Unary};

/// How many operations a side must have for a branch to be worth more than to compute both.
const WORTH: usize = 8;

/// Choices by one comparison, and what stands on either side of it.
#[derive(Debug)]
pub(super) struct Branch {
    /// The choices, of which the first is where the branch stands.
    pub(super) choices: Vec<Place>,
    /// The operations of the side where the first number is less, and of the other, in order.
    pub(super) sides: [Vec<Place>; 2],
}

/// The branches of a function, by the places at which they stand; and which places are written
/// there.
pub(super) fn branches(
    tape: &Tape,
    needed: &[bool],
    kept: impl IntoIterator<Item = Place>,
) -> (HashMap<Place, Branch>, Vec<bool>) {
    let mut within = vec![false; needed.len()];
    let users = users(tape, needed, kept);
    let mut branches = HashMap::new();
    for choices in groups(tape, needed) {
        if choices.iter().any(|&choice| within[choice as usize]) {
            continue;
        }
        let side = |is_less: bool| side(tape, needed, &within, &users, &choices, is_less);
        let sides = [side(true), side(false)];
        if sides.iter().map(Vec::len).max().unwrap_or(0) < WORTH {
            continue;
        }
        for &place in sides.iter().flatten().chain(&choices) {
            within[place as usize] = true;
        }
        branches.insert(choices[0], Branch { choices, sides });
    }
    (branches, within)
}

/// Choices by the same comparison whose operands all stand before the first of them.
fn groups(tape: &Tape, needed: &[bool]) -> Vec<Vec<Place>> {
    let mut groups: Vec<([Place; 2], Vec<Place>)> = Vec::new();
    for (place, operation) in operations(tape).filter(|(place, _)| needed[*place as usize]) {
        let Operation::Select([a, b, less, otherwise]) = operation else {
            continue;
        };
        let is_joined = groups.iter_mut().any(|(of, choices)| {
            let is_same = *of == [a, b] && less.max(otherwise) < choices[0];
            if is_same {
                choices.push(place);
            }
            is_same
        });
        if !is_joined {
            groups.push(([a, b], vec![place]));
        }
    }
    groups.into_iter().map(|(_, choices)| choices).collect()
}

fn operations(tape: &Tape) -> impl DoubleEndedIterator<Item = (Place, Operation)> + '_ {
    let operations = tape.operations().iter().enumerate();
    operations.map(|(place, operation)| (Place::try_from(place).unwrap_or(Place::MAX), *operation))
}

/// Who uses what; `None` for what a call or the end of the function uses.
fn users(
    tape: &Tape,
    needed: &[bool],
    kept: impl IntoIterator<Item = Place>,
) -> Vec<Option<Vec<Place>>> {
    let mut users: Vec<Option<Vec<Place>>> = vec![Some(Vec::new()); needed.len()];
    for (place, operation) in operations(tape).filter(|(place, _)| needed[*place as usize]) {
        for operand in operation.operands() {
            if let Some(users) = &mut users[operand as usize] {
                users.push(place);
            }
        }
    }
    let given = tape
        .calls()
        .iter()
        .flat_map(|(call, _)| call.given.iter().copied());
    for place in kept.into_iter().chain(given) {
        users[place as usize] = None;
    }
    users
}

/// What is needed by one side of choices and by nothing else.
fn side(
    tape: &Tape,
    needed: &[bool],
    within: &[bool],
    users: &[Option<Vec<Place>>],
    choices: &[Place],
    is_less: bool,
) -> Vec<Place> {
    let mut refused: Vec<Place> = Vec::new();
    loop {
        let mut is_inside = vec![false; needed.len()];
        let serves = |place: Place, user: Place, is_inside: &[bool]| {
            if !choices.contains(&user) {
                return is_inside[user as usize];
            }
            let Operation::Select([a, b, less, otherwise]) = tape.at(user) else {
                return false;
            };
            let (own, other) = if is_less {
                (less, otherwise)
            } else {
                (otherwise, less)
            };
            place == own && ![a, b, other].contains(&place)
        };
        for (place, operation) in operations(tape).rev() {
            let at = place as usize;
            let is_plain = !matches!(
                operation,
                Operation::Constant(_) | Operation::Argument(_) | Operation::Result { .. }
            );
            let is_open = place < choices[0] && needed[at] && !within[at] && is_plain;
            is_inside[at] = is_open
                && !refused.contains(&place)
                && users[at].as_ref().is_some_and(|users| {
                    !users.is_empty() && users.iter().all(|&user| serves(place, user, &is_inside))
                });
        }
        // Sine and versine of a turn are written together.
        let is_apart = |place: Place, operation: Operation| {
            is_inside[place as usize]
                && partner(tape, operation)
                    .is_some_and(|partner| needed[partner as usize] && !is_inside[partner as usize])
        };
        let apart: Vec<Place> = operations(tape)
            .filter(|(place, operation)| is_apart(*place, *operation))
            .map(|(place, _)| place)
            .collect();
        if apart.is_empty() {
            let inside = operations(tape).map(|(place, _)| place);
            return inside.filter(|place| is_inside[*place as usize]).collect();
        }
        refused.extend(apart);
    }
}

/// The place of the other part of a turn.
pub(super) fn partner(tape: &Tape, operation: Operation) -> Option<Place> {
    let other = match operation {
        Operation::Unary(Unary::TurnSine, of) => Operation::Unary(Unary::TurnVersine, of),
        Operation::Unary(Unary::TurnVersine, of) => Operation::Unary(Unary::TurnSine, of),
        _ => return None,
    };
    tape.find(other)
}

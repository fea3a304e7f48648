//! Refuses what a definition says of how its joint moves, where its equations leave something else.

use proc_macro2::{Span, TokenStream};

use super::joints::plural;
use crate::diag::Faults;
use crate::model::{Comparison, ElementDef, Row};
use crate::syntax::joint::{JointSyntax, Statement};
use crate::syntax::motion::MotionSyntax;

/// Says what was found where it is stated. `places` are where the constraints are written. Whether
/// nothing was refused.
pub(super) fn refuse(
    syntax: &JointSyntax,
    joint: &ElementDef,
    places: &[Span],
    found: &Comparison,
    faults: &mut Faults,
) -> bool {
    let mut statements = syntax.statements.iter();
    let stated = statements.find_map(|statement| match statement {
        Statement::Motion {
            tokens, motions, ..
        } => Some((tokens, motions.as_slice())),
        _ => None,
    });
    let Some((tokens, motions)) = stated else {
        return true;
    };
    let refusal = Refusal {
        joint,
        places,
        tokens,
        motions,
    };
    refusal.say(found, faults)
}

/// Says what is wrong with the motions of a joint.
struct Refusal<'a> {
    joint: &'a ElementDef,
    places: &'a [Span],
    tokens: &'a TokenStream,
    motions: &'a [MotionSyntax],
}

impl Refusal<'_> {
    /// Whether there is nothing to say.
    fn say(&self, found: &Comparison, faults: &mut Faults) -> bool {
        let name = &self.joint.name;
        match found {
            Comparison::Agrees | Comparison::Undecided => return true,
            Comparison::Forbidden(pairs) => {
                for (motion, row) in pairs {
                    let (equation, forbids) = self.equation(*row, "forbids", "forbid");
                    faults.at(
                        &self.motions[*motion].tokens,
                        format!("{equation} {forbids} this motion; a joint states the motions that its equations leave"),
                    );
                }
            }
            Comparison::Violated(row) => {
                let (equation, hold) = self.equation(*row, "does not hold", "do not hold");
                faults.at(
                    self.tokens,
                    format!("{equation} {hold} after these motions, of which each carries those behind it"),
                );
            }
            Comparison::Dependent {
                stated,
                independent,
            } => {
                let stated = plural(*stated, "motion", "motions");
                faults.at(
                    self.tokens,
                    format!("`{name}` states {stated}, of which {independent} are independent of each other; state each once"),
                );
            }
            Comparison::Fewer { stated, left } => {
                let balls = if left.max(stated) < &3 {
                    ""
                } else {
                    " (a ball is three)"
                };
                let stated = plural(*stated, "motion", "motions");
                faults.at(
                    self.tokens,
                    format!("`{name}` states {stated}, and its equations leave {left}{balls}"),
                );
            }
        }
        false
    }

    /// An equation by its place and line, and a verb for it.
    fn equation(
        &self,
        row: usize,
        one: &'static str,
        many: &'static str,
    ) -> (String, &'static str) {
        let name = &self.joint.name;
        let mut first = 0;
        for (constraint, place) in self.joint.rows.iter().zip(self.places) {
            let line = place.start().line;
            let behind = first + constraint.equations();
            if row < behind {
                return match constraint {
                    Row::Scalar(_) => {
                        (format!("the equation `{name}[{first}]` (line {line})"), one)
                    }
                    // In which axes its components are written is nobody's business.
                    Row::Vector(_) => (
                        format!(
                            "the equations `{name}[{first}]` to `{name}[{}]` (line {line})",
                            behind - 1
                        ),
                        many,
                    ),
                };
            }
            first = behind;
        }
        unreachable!("a row of a joint is one of its equations")
    }
}

//! The mirror image of a joint or a force: whether its definition has one, and which of its
//! directions change sign in it.
//!
//! A mirrored part moves as the mirror image of the part, with the same angles and displacements.
//! Points and arrows are mirrored; the axis of a rotation, a pseudovector, is mirrored and turned
//! round. A definition does not say which of its directions is which, but how it uses them does:
//! with the right choice every expression either stays or changes sign as a whole.

use crate::model::{Action, Direction, ElementDef, Function, Motion, Term};

/// What a mirror does to an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Parity {
    /// It is zero.
    Any,
    /// A scalar stays, a vector is mirrored.
    Even,
    /// The same, with the other sign.
    Odd,
    /// Something else.
    Mixed,
}

impl Parity {
    fn sum(self, other: Self) -> Self {
        match (self, other) {
            (Self::Any, other) | (other, Self::Any) => other,
            (a, b) if a == b => a,
            _ => Self::Mixed,
        }
    }

    fn product(self, other: Self) -> Self {
        match (self, other) {
            (Self::Any, _) | (_, Self::Any) => Self::Any,
            (Self::Mixed, _) | (_, Self::Mixed) => Self::Mixed,
            (a, b) if a == b => Self::Even,
            _ => Self::Odd,
        }
    }

    fn turned_round(self) -> Self {
        self.product(Self::Odd)
    }

    fn stays(self) -> bool {
        matches!(self, Self::Any | Self::Even)
    }
}

/// Which directions, by the places of the parameters, are pseudovectors.
struct Choice(Vec<bool>);

impl Choice {
    fn direction(&self, parameter: usize) -> Parity {
        match self.0.get(parameter) {
            Some(true) => Parity::Odd,
            _ => Parity::Even,
        }
    }

    fn of(&self, term: &Term) -> Parity {
        match term {
            Term::Number(value) if *value == 0.0 => Parity::Any,
            Term::Number(_)
            | Term::Scalar(_)
            | Term::Time
            | Term::Point { .. }
            | Term::Origin(_)
            | Term::Components(_)
            | Term::Normal { which: 0, .. } => Parity::Even,
            Term::Fixed { parameter, .. } => self.direction(*parameter),
            // Axis, normal and binormal are right-handed in either world.
            Term::Normal { parameter, .. } => self.direction(*parameter).turned_round(),
            Term::Angle(turn) => self.direction(turn.axis).turned_round(),
            Term::Onto(_, inner) | Term::Initial(inner) | Term::Rate(inner) => self.of(inner),
            Term::Sum(terms) => {
                let parities = terms.iter().map(|(_, term)| self.of(term));
                parities.fold(Parity::Any, Parity::sum)
            }
            Term::Product(a, b) | Term::Dot(a, b) => self.of(a).product(self.of(b)),
            Term::Cross(a, b) => self.of(a).product(self.of(b)).turned_round(),
            Term::Function(function, inner) => match (self.of(inner), function) {
                (Parity::Odd, Function::Sine | Function::Reciprocal) => Parity::Odd,
                (Parity::Odd, Function::Cosine) => Parity::Even,
                (Parity::Odd | Parity::Mixed, _) => Parity::Mixed,
                (Parity::Any | Parity::Even, _) => Parity::Even,
            },
            Term::Law { arguments, .. } => {
                let stay = arguments.iter().all(|argument| self.of(argument).stays());
                if stay { Parity::Even } else { Parity::Mixed }
            }
        }
    }

    /// Whether the equations and forces of the image are those of the definition.
    fn holds(&self, definition: &ElementDef) -> bool {
        let mut equation = 0;
        let rows = definition.rows.iter().all(|row| {
            let own = equation..equation + row.equations();
            equation = own.end;
            let drives = definition.drive.is_some_and(|drive| own.contains(&drive));
            match self.of(row.term()) {
                Parity::Mixed => false,
                Parity::Odd => !drives,
                Parity::Any | Parity::Even => true,
            }
        });
        let mut requirements = definition.requirements.iter();
        let mut defaults = definition
            .parameters
            .iter()
            .filter_map(|parameter| parameter.default.as_ref());
        let actions = definition.actions.iter().all(|action| match action {
            Action::Potential(energy) => self.of(energy).stays(),
            Action::Along { effort, coordinate } => {
                self.of(effort).product(self.of(coordinate)).stays()
            }
            Action::Force { vector, .. } => self.of(vector).stays(),
            Action::Moment { vector, .. } => self.of(vector).turned_round().stays(),
        });
        rows && actions
            && requirements.all(|term| self.of(term).stays())
            && defaults.all(|term| self.of(term).stays())
    }

    /// How many of its readings and motions keep their sign.
    fn kept(&self, definition: &ElementDef) -> usize {
        let turn = |axis: usize| usize::from(self.direction(axis) == Parity::Odd);
        let angle = definition.angle.map_or(0, |angle| turn(angle.axis));
        let displacement = definition.displacement.as_ref();
        let displacement = displacement.map_or(0, |term| usize::from(self.of(term).stays()));
        let motions = definition.motions.iter().flatten();
        let motions = motions.map(|motion| match motion {
            Motion::Turn {
                axis:
                    Direction {
                        parameter,
                        normal: None,
                    },
                ..
            } => turn(*parameter),
            Motion::Slide {
                along:
                    Direction {
                        parameter,
                        normal: None,
                    },
            } => 1 - turn(*parameter),
            _ => 0,
        });
        angle + displacement + motions.sum::<usize>()
    }
}

/// Of every parameter, whether it changes sign when it is mirrored; `None` if the mirror image is
/// nothing that this definition describes, such as a screw of the other hand.
///
/// Where a direction is turned about and slid along, displacements keep their sign.
pub(super) fn pseudovectors(definition: &ElementDef) -> Option<Vec<bool>> {
    let parameters = &definition.parameters;
    let is_direction = |place: &usize| {
        let kind = parameters[*place].kind;
        kind.is_vector() && kind != crate::model::ParameterKind::Point
    };
    let directions: Vec<usize> = (0..parameters.len()).filter(is_direction).collect();
    // More directions than any joint has: none of them is a pseudovector then.
    let choices = if directions.len() <= 8 {
        1 << directions.len()
    } else {
        1_usize
    };
    let choices = (0..choices).map(|bits| {
        let mut choice = Choice(vec![false; parameters.len()]);
        for (bit, &place) in directions.iter().enumerate() {
            choice.0[place] = bits >> bit & 1 == 1;
        }
        choice
    });
    let possible = choices.filter(|choice| choice.holds(definition));
    let fewest = |choice: &Choice| choice.0.iter().filter(|is_odd| !**is_odd).count();
    let best = possible.max_by_key(|choice| (choice.kept(definition), fewest(choice)));
    best.map(|choice| choice.0)
}

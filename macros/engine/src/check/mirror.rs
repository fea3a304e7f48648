//! The mirror image of a joint or a force: whether its definition has one, and which of its
//! directions change sign in it.
//!
//! A mirrored part moves as the mirror image of the part, with the same angles and displacements.
//! Points and arrows are mirrored; the axis of a rotation, a pseudovector, is mirrored and turned
//! round. How a definition uses its directions tells them apart. With the right choice every
//! expression stays, or changes sign as a whole.

use crate::model::{Action, ElementDef, Function, Motion, Term};

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
            | Term::Normal { which: 0, .. } => Parity::Even,
            // Along global axes, which no mirror changes.
            Term::Components(parts) => self.if_all_stay(parts.iter().map(|part| &**part)),
            Term::Fixed { parameter, .. } => self.direction(*parameter),
            // Axis, normal and binormal are right-handed in either world.
            Term::Normal { parameter, .. } => self.direction(*parameter).turned_round(),
            Term::Angle(turn) => self.direction(turn.axis).turned_round(),
            Term::Spin { .. } => Parity::Odd,
            Term::Onto(_, inner) | Term::Initial(inner) | Term::Rate(inner) => self.of(inner),
            Term::Sum(terms) => {
                let parities = terms.iter().map(|(_, term)| self.of(term));
                parities.fold(Parity::Any, Parity::sum)
            }
            Term::Product(a, b) | Term::Dot(a, b) => self.of(a).product(self.of(b)),
            Term::Cross(a, b) => self.of(a).product(self.of(b)).turned_round(),
            Term::Function(function, inner) => match (self.of(inner), function) {
                (
                    Parity::Odd,
                    Function::Sine
                    | Function::ArcSine
                    | Function::ArcTangent
                    | Function::Reciprocal,
                ) => Parity::Odd,
                (Parity::Odd, Function::Cosine) => Parity::Even,
                (Parity::Odd | Parity::Mixed, _) => Parity::Mixed,
                (Parity::Any | Parity::Even, _) => Parity::Even,
            },
            Term::Direction(sine, cosine) => match (self.of(sine), self.of(cosine)) {
                (Parity::Odd, Parity::Even | Parity::Any) => Parity::Odd,
                (Parity::Even | Parity::Any, Parity::Even | Parity::Any) => Parity::Even,
                _ => Parity::Mixed,
            },
            Term::Law { arguments, .. } => self.if_all_stay(arguments.iter()),
        }
    }

    fn if_all_stay<'t>(&self, mut terms: impl Iterator<Item = &'t Term>) -> Parity {
        if terms.all(|term| self.of(term).stays()) {
            Parity::Even
        } else {
            Parity::Mixed
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

    /// Whether the displacement that can be read keeps its sign, and a contact is mirrored.
    fn keeps_readings(&self, definition: &ElementDef) -> bool {
        let contact = definition.contact.iter().flatten();
        let mut read = definition.displacement.iter().chain(contact);
        read.all(|term| self.of(term).stays())
    }

    /// How many of its angles and motions keep their sign.
    fn kept(&self, definition: &ElementDef) -> usize {
        let turns = |axis: usize| self.direction(axis) == Parity::Odd;
        let angles = definition.angle.iter().chain(&definition.turns);
        let angles = angles.filter(|angle| turns(angle.axis));
        let motions = definition.motions.iter().flatten();
        let motions = motions.filter(|motion| match motion {
            Motion::Turn { axis, .. } => axis.normal.is_none() && turns(axis.parameter),
            Motion::Slide { along } => along.normal.is_none() && !turns(along.parameter),
            Motion::Screw { .. } | Motion::Ball { .. } => false,
        });
        angles.count() + motions.count()
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
    let best = possible.max_by_key(|choice| {
        let arrows = choice.0.iter().filter(|is_odd| !**is_odd).count();
        let readings = choice.keeps_readings(definition);
        (readings, choice.kept(definition), arrows)
    });
    best.map(|choice| choice.0)
}

#[cfg(test)]
mod tests {
    use super::pseudovectors;
    use crate::check::joint;
    use crate::diag::Faults;
    use crate::model::ElementKind;
    use crate::syntax::joint::parse_transported;

    /// The pseudovectors of a definition by their names; `None` if it has no mirror image.
    fn mirrored(kind: ElementKind, text: &str) -> Option<Vec<String>> {
        let mut faults = Faults::new();
        let tokens = text.parse().expect("brackets in pairs");
        let syntax = parse_transported(tokens, kind, &mut faults).expect("a definition");
        let definition = joint::check(&syntax, &mut faults).expect("a sound one");
        assert!(faults.into_tokens().is_empty());
        let found = pseudovectors(&definition)?;
        let parameters = definition.parameters.iter().zip(found);
        let odd = parameters.filter(|(_, is_odd)| *is_odd);
        Some(
            odd.map(|(parameter, _)| parameter.name.to_string())
                .collect(),
        )
    }

    fn joint(text: &str) -> Option<Vec<String>> {
        mirrored(ElementKind::Joint, text)
    }

    #[test]
    fn the_axis_of_a_rotation_is_a_pseudovector_and_that_of_a_translation_is_none() {
        let hinge =
            "J(i, j; p: Point, a: Axis) { j.p - i.p; dot(i.a.normals(), j.a); angle about a; }";
        assert_eq!(joint(hinge).unwrap(), ["a"]);
        let slide = "J(i, j; p: Point, a: Axis, m: Law) { drive dot(i.a, j.p - i.p) to m(); }";
        assert!(joint(slide).unwrap().is_empty());
        let rack = "J(i, j, k; a: Axis, p: Point, s: Axis, r: Length) { dot(k.s, j.p - k.p) - r * angle(k, i, a); }";
        assert_eq!(joint(rack).unwrap(), ["a"]);
        // A cross product of two arrows is a pseudovector, and a volume changes its sign.
        let volume = "J(i, j; p: Point, a: Axis, b: Axis, h: Length) { dot(cross(i.a, i.b), j.p - i.p) - h; dot(i.a, j.p - i.p) - h; }";
        assert_eq!(joint(volume).unwrap(), ["b"]);
    }

    #[test]
    fn of_an_angle_and_a_displacement_along_one_axis_the_displacement_stays() {
        let sleeve = "J(i, j; p: Point, a: Axis) { dot(i.a.normals(), j.a); dot(i.a.normals(), j.p - i.p); angle about a; \
             displacement dot(i.a, j.p - i.p); }";
        assert!(joint(sleeve).unwrap().is_empty());
    }

    #[test]
    fn what_has_a_hand_has_no_mirror_image() {
        let screw =
            "J(i, j; p: Point, a: Axis, h: Length) { dot(i.a, j.p - i.p) - h * angle(i, j, a); }";
        assert_eq!(joint(screw), None);
        // The sine of an angle changes its sign, its square does not.
        let sine = "J(i, j; p: Point, a: Axis) { dot(i.a, j.p - i.p) - sin(angle(i, j, a)); }";
        assert_eq!(joint(sine), None);
        let square = "J(i, j; p: Point, a: Axis) { dot(i.a, j.p - i.p) - cos(angle(i, j, a)); }";
        assert!(joint(square).unwrap().is_empty());
        let along = "J(i, j; p: Point, a: Axis) { dot([angle(i, j, a), 0.0, 0.0], j.p - i.p) - 1.0; dot(i.a, j.p - i.p) - 1.0; }";
        assert_eq!(joint(along), None);
    }

    #[test]
    fn a_moment_is_a_pseudovector_and_a_force_is_none() {
        let force = |text| mirrored(ElementKind::Force, text).unwrap();
        assert!(force("F(j; p: Point, f: Vector) { force j.f at j.p; }").is_empty());
        assert_eq!(force("F(j; m: Vector) { moment j.m on j; }"), ["m"]);
        let both = "F(j; p: Point, f: Vector, m: Vector) { force j.f at j.p; moment cross(j.f, j.p - j.origin) + j.m on j; }";
        assert_eq!(force(both), ["m"]);
    }
}

//! What a definition fixes on its bodies.

use crate::model::{Action, ElementDef, ParameterKind, Term};

/// Whether a definition fixes a vector of its own on one of its bodies, or exerts a moment on it.
pub(super) fn turns(joint: &ElementDef, body: usize) -> bool {
    let moment = |action: &Action| matches!(action, Action::Moment { body: b, .. } if *b == body);
    let onto = |term: &Term| matches!(term, Term::Onto(b, _) if *b == body);
    joint.terms().any(|term| term.has(onto)) || joint.actions.iter().any(moment)
}

/// The vector parameters that a definition fixes on one of its bodies.
pub(super) fn uses(joint: &ElementDef, body: usize) -> Vec<(usize, ParameterKind)> {
    let mut found = Vec::new();
    let mut note = |term: &Term| match term {
        Term::Point { body: b, parameter }
        | Term::Fixed { body: b, parameter }
        | Term::Normal {
            body: b, parameter, ..
        } if *b == body => found.push(*parameter),
        Term::Angle(turn) if turn.from == body || turn.to == body => found.push(turn.axis),
        _ => {}
    };
    joint.terms().for_each(|term| term.visit(&mut note));
    if let Some(angle) = joint.angle {
        note(&Term::Angle(angle));
    }
    found.sort_unstable();
    found.dedup();
    found
        .into_iter()
        .map(|parameter| (parameter, joint.parameters[parameter].kind))
        .collect()
}

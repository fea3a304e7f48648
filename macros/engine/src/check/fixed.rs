//! What a definition fixes on its bodies.

use crate::model::{Action, ElementDef, ParameterKind, Term};

/// Whether a definition fixes a vector of its own on one of its bodies, reads its angular velocity
/// or exerts a moment on it.
pub(super) fn turns(joint: &ElementDef, body: usize) -> bool {
    let moment = |action: &Action| matches!(action, Action::Moment { body: b, .. } if *b == body);
    let turns = |term: &Term| match term {
        Term::Onto(b, _) => *b == body,
        Term::Spin { from, to } => *from == Some(body) || *to == body,
        _ => false,
    };
    joint.terms().any(|term| term.has(turns)) || joint.actions.iter().any(moment)
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
    for (body, parameter) in joint.angles.iter().flatten().copied().enumerate() {
        note(&Term::Fixed { body, parameter });
    }
    found.sort_unstable();
    found.dedup();
    found
        .into_iter()
        .map(|parameter| (parameter, joint.parameters[parameter].kind))
        .collect()
}

//! Equations that follow from others: refused, left out or kept, as the user says.

use syn::Expr;

use super::apart;
use crate::diag::{Faults, list};
use crate::model::{Binding, Contradiction, Model, Name, Rank, Redundant, RedundantRow};

/// Does with the redundant equations of a model, sound otherwise, what the user wishes, which was
/// written as `expr`.
pub(super) fn check(
    model: &mut Model,
    (wish, expr): (Redundant, Option<&Expr>),
    faults: &mut Faults,
) {
    stuck(model, faults);
    if faults.any() {
        return;
    }
    // Without the time nothing goes wrong unseen: the start cannot be assembled.
    if model.independence.is_driven || wish == Redundant::Drop {
        contradictions(model, faults);
        if faults.any() {
            return;
        }
    }
    if wish != Redundant::Keep {
        dormant(model, faults);
        if faults.any() {
            return;
        }
    }
    match wish {
        Redundant::Drop if !matches!(model.independence.rank, Rank::Decided { .. }) => {
            faults.at(expr, undecided(model));
        }
        Redundant::Drop if model.independence.is_alone => {
            faults.at(
                expr,
                "no equations can be left out: no other configuration that satisfies all of them was found near the reference one, and there they \
                 may depend on each other by chance; look for constraints that only touch each other, and for a singular start",
            );
        }
        Redundant::Drop if !model.independence.by_chance.is_empty() => by_chance(model, faults),
        Redundant::Refuse => refuse(model, faults),
        Redundant::Keep => {}
        Redundant::Drop => {
            for RedundantRow { joint, row, .. } in &model.independence.redundant {
                model.joints[*joint].dropped.push(*row);
            }
            for &(joint, components) in &model.independence.components {
                model.joints[joint].components.push(components);
            }
            model.independence.dropped = true;
        }
    }
}

/// One fault for each joint with an equation that is violated and cannot be helped. Points and axes
/// that stand in axes of bodies may be meant for another configuration.
fn stuck(model: &Model, faults: &mut Faults) {
    let is_local = |binding: &Binding| matches!(binding, Binding::Local(_));
    let stuck = model.independence.stuck.iter().copied();
    let stuck: Vec<(usize, usize)> = stuck
        .filter(|(joint, _)| !model.joints[*joint].bindings.iter().any(is_local))
        .collect();
    once_a_joint(model, &stuck, faults, |name, row| {
        let place = model.joints.iter().position(|joint| joint.name == *name);
        let apart = place.and_then(|place| apart::of_joint(model, place, None));
        let apart = apart.map_or_else(String::new, |apart| format!(" ({apart})"));
        format!(
            "`{name}[{row}]` does not hold in the reference configuration{apart}, and no motion that begins there brings it nearer: look for \
                 axes of `{name}` that are parallel and should be perpendicular, and for points that should be apart; what is meant for \
                 another configuration is given by `local(..)`"
        )
    });
}

/// Says something of the first of these rows, by joint and place, of every joint.
fn once_a_joint(
    model: &Model,
    rows: &[(usize, usize)],
    faults: &mut Faults,
    message: impl Fn(&Name, usize) -> String,
) {
    let mut named: Vec<usize> = Vec::new();
    for &(joint, row) in rows {
        if !named.contains(&joint) {
            named.push(joint);
            let name = &model.joints[joint].name;
            faults.at_name(name, message(name, row));
        }
    }
}

/// One fault for each joint with an equation that says nothing where it was looked at, but not
/// everywhere.
fn dormant(model: &Model, faults: &mut Faults) {
    once_a_joint(model, &model.independence.dormant, faults, |name, row| {
        format!(
            "the gradient of `{name}[{row}]` vanishes wherever the equations hold, as far as they were followed, though not everywhere: the \
                 equation follows from no others and cannot be left out, and its multiplier is not unique; write one whose gradient \
                 does not vanish, or `redundant = \"keep\"` for formulations with a compliance (penalty, augmented Lagrangian)"
        )
    });
}

/// One fault for each joint with an equation that follows from others where it was looked at, and
/// not elsewhere.
fn by_chance(model: &Model, faults: &mut Faults) {
    once_a_joint(model, &model.independence.by_chance, faults, |name, row| {
        format!(
            "`{name}[{row}]` cannot be left out: it follows from the other equations near the reference configuration by chance, and does not \
                 hold where these lead to; look for constraints that only touch each other, and for a singular start"
        )
    });
}

/// One fault for each equation that contradicts others.
fn contradictions(model: &Model, faults: &mut Faults) {
    for contradiction in &model.independence.contradictions {
        let Contradiction {
            joint,
            row,
            against,
            time,
            by_speed,
            way,
        } = contradiction;
        let name = &model.joints[*joint].name;
        let equations = match against.as_slice() {
            [] => "what cannot change".into(),
            several => {
                let names = several.iter().map(|&joint| &model.joints[joint].name);
                format!("equations of {}", list(names))
            }
        };
        let apart = apart::of_joint(model, *joint, Some(way)).filter(|_| !by_speed);
        let apart = apart.map_or_else(String::new, |apart| format!(" ({apart})"));
        let (what, cure) = match (model.independence.is_driven, by_speed) {
            (false, _) => (
                format!("where those hold, it does not{apart}"),
                "look for a point, an axis, a length or a law that does not fit",
            ),
            (true, by_speed) => {
                let how = if *by_speed {
                    "it asks for another speed"
                } else {
                    "it is violated"
                };
                let time = apart::brief(*time, 3);
                (
                    format!(
                        "where those hold, {how} at time = {time} s{apart}, so that no motion satisfies all of them"
                    ),
                    "let them ask for the same, or leave one out",
                )
            }
        };
        faults.at_name(
            name,
            format!(
                "`{name}[{row}]` contradicts {equations}: {what}; {cure} (`redundant` is no cure)"
            ),
        );
    }
}

/// Why equations that follow from others cannot be found, and what to do.
fn undecided(model: &Model) -> String {
    if model.independence.rank == Rank::NotAssembled {
        return "no equations can be left out: nothing near the reference configuration satisfies all of them; look for a point or \
                an axis that contradicts the others"
            .into();
    }
    let is_joint = |name: &Name| model.joints.iter().any(|joint| joint.name == *name);
    let mut places: Vec<String> = model
        .symbols
        .iter()
        .filter(|s| s.like.is_none())
        .filter(|s| {
            is_joint(&s.field) || matches!(s.attribute.as_str(), "position" | "orientation")
        })
        .map(|s| format!("`{}` of `{}`", s.attribute, s.field.text()))
        .collect();
    places.dedup();
    let among = if places.is_empty() {
        String::new()
    } else {
        format!(" ({})", places.join(", "))
    };
    format!(
        "no equations can be left out, because the constraints depend on numbers that the macro cannot see{among}: write literals in \
         the place of constants, say what a parameter is like (`#[param(like = 0.8)]`), choose joints without redundant equations, or write `redundant = \"keep\"` for \
         formulations with a compliance"
    )
}

/// One fault for each joint with redundant equations.
fn refuse(model: &Model, faults: &mut Faults) {
    let layout = model.layout();
    let freedom = model
        .independence
        .degrees_of_freedom(layout.velocities, layout.rows);
    // Drivers may leave nothing free on purpose.
    let is_locked = freedom <= 0 && !model.independence.is_driven;
    for (place, joint) in model.joints.iter().enumerate() {
        let own: Vec<&RedundantRow> = model
            .independence
            .redundant
            .iter()
            .filter(|redundant| redundant.joint == place)
            .collect();
        if own.is_empty() {
            continue;
        }
        let mut sources: Vec<usize> = own
            .iter()
            .flat_map(|row| row.follows_from.clone())
            .collect();
        sources.sort_unstable();
        sources.dedup();
        let name = &joint.name;
        let (count, of) = (own.len(), model.equations(joint));
        let (are, follow, them) = match count {
            1 => ("is", "follows", "it"),
            _ => ("are", "follow", "them"),
        };
        let from = match sources.as_slice() {
            [] => "cannot be violated".into(),
            several => {
                let names = several.iter().map(|&joint| &model.joints[joint].name);
                format!("{follow} from equations of {}", list(names))
            }
        };
        let what = match (count, of) {
            (1, 1) => "the equation".into(),
            (count, of) if count == of => format!("all {of} equations"),
            (count, of) => format!("{count} of the {of} equations"),
        };
        let rows = list(
            own.iter()
                .map(|redundant| format!("{name}[{}]", redundant.row)),
        );
        let is_chance = model.independence.is_alone || !model.independence.by_chance.is_empty();
        let cure = if is_chance {
            " in the reference configuration, and perhaps only there: look for constraints that only touch each other, and for a singular start, \
             or write `redundant = \"keep\"` for formulations with a compliance (penalty, augmented Lagrangian)"
                .into()
        } else if is_locked {
            ", and nothing is left that can move (0 degrees of freedom): a joint forbids more than was meant; choose one with fewer \
             equations, or another point or axis (`redundant` is no cure)"
                .into()
        } else {
            format!(
                "; leave {them} out by `#[mechanism(redundant = \"drop\")]`, or write `redundant = \"keep\"` for formulations with a \
                 compliance (penalty, augmented Lagrangian)"
            )
        };
        faults.at_name(
            name,
            format!("{what} of `{name}` {are} redundant: {rows} {from}, so that multipliers are not unique{cure}"),
        );
    }
}

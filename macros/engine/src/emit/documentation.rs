//! The documentation of a generated implementation: bodies, joints, rows, sizes, counts.

use proc_macro2::TokenStream;
use quote::quote;

use super::report::costs;
use crate::model::{BodyKind, Element, Model, Number, Rank};
use crate::plan::kernels::Kernels;
use crate::symbolic::time::Cost;

/// Documentation as attributes.
#[must_use]
pub fn documentation(model: &Model, kernels: &Kernels) -> TokenStream {
    let layout = model.layout();
    let mut lines = vec![
        format!(
            "Generated kernels: {} coordinates, {} velocities, {} constraint equations. {}",
            layout.coordinates,
            layout.velocities,
            layout.rows,
            independence(model)
        ),
        String::new(),
        "| body | kind | coordinates from | velocities from |".into(),
        "|---|---|---|---|".into(),
    ];
    for (place, body) in model.bodies.iter().enumerate() {
        let kind = match body.kind {
            BodyKind::Rigid => "body",
            BodyKind::Particle => "particle",
        };
        let (q, u) = (layout.coordinate[place], layout.velocity[place]);
        lines.push(format!("| `{}` | {kind} | {q} | {u} |", body.name));
    }
    lines.extend(shaped(model));
    if !model.joints.is_empty() {
        lines.push(String::new());
        lines.push("| joint | type | between | rows |".into());
        lines.push("|---|---|---|---|".into());
        for (place, joint) in model.joints.iter().enumerate() {
            let first = layout.row[place];
            lines.push(format!(
                "| `{}` | {} | {} | {}..{} |",
                joint.name,
                model.definition(joint).name,
                between(model, joint),
                first,
                first + model.equations(joint)
            ));
        }
    }
    if !model.forces.is_empty() {
        lines.push(String::new());
        lines.push("| force | type | between |".into());
        lines.push("|---|---|---|".into());
        for force in &model.forces {
            let (kind, bodies) = (&model.definition(force).name, between(model, force));
            lines.push(format!("| `{}` | {kind} | {bodies} |", force.name));
        }
    }
    lines.push(String::new());
    lines.push(
        "| kernel | operations | + - | * | / | sqrt | functions | depth | cycles (x86-64, AVX2) |"
            .into(),
    );
    lines.push("|---|---|---|---|---|---|---|---|---|".into());
    for (name, Cost { count, cycles }) in costs(kernels) {
        lines.push(format!(
            "| {name} | {} | {} | {} | {} | {} | {} | {} | {cycles} |",
            count.total(),
            count.additions,
            count.multiplications,
            count.divisions,
            count.square_roots,
            count.functions,
            count.depth
        ));
    }
    let lines = lines.iter().map(|line| format!(" {line}"));
    quote!(#( #[doc = #lines] )*)
}

/// What follows for bodies from their shapes; at the typical values of parameters.
fn shaped(model: &Model) -> Vec<String> {
    let mut lines = Vec::new();
    for body in model.bodies.iter().filter(|body| !body.shapes.is_empty()) {
        let one = |number: Number| match model.seen(number) {
            Some(value) => format!("{}", format!("{value:.6e}").parse().unwrap_or(value)),
            None => "..".into(),
        };
        let three = |numbers: [Number; 3]| numbers.map(one).join(", ");
        if lines.is_empty() {
            lines = vec![
                String::new(),
                "| body by shapes | mass (kg) | centre of mass (m) | principal moments (kg m²) |"
                    .into(),
                "|---|---|---|---|".into(),
            ];
        }
        lines.push(format!(
            "| `{}` | {} | {} | {} |",
            body.name,
            one(body.mass),
            three(body.position),
            three(body.inertia)
        ));
    }
    lines
}

/// The bodies of a joint or a force, by their names.
fn between(model: &Model, element: &Element) -> String {
    let name = |body: usize| model.bodies[body].name.to_string();
    let bodies = element.bodies.iter();
    let names: Vec<String> = bodies
        .map(|body| body.map_or("ground".into(), name))
        .collect();
    names.join(", ")
}

/// The rank, the degrees of freedom, and the equations that follow from others, in words.
fn independence(model: &Model) -> String {
    let (layout, found) = (model.layout(), &model.independence);
    let freedom = found.degrees_of_freedom(layout.velocities, layout.rows);
    let mut text = match found.rank {
        Rank::Decided { rank, .. } => {
            format!("Degrees of freedom (velocities less the rank, {rank}): {freedom}.")
        }
        Rank::NotDecided => format!(
            "Degrees of freedom (velocities less equations; the rank is not decided at expansion): {freedom}."
        ),
        Rank::NotAssembled => format!(
            "Degrees of freedom (velocities less equations; the rank is not decided at expansion, because the reference \
             configuration cannot be assembled): {freedom}."
        ),
    };
    if let Rank::Decided { rank, at_start } = found.rank
        && at_start < rank
    {
        text += &format!(" It starts in a singular configuration, of rank {at_start}.");
    }
    if !found.redundant.is_empty() {
        let rows: Vec<String> = found
            .redundant
            .iter()
            .map(|redundant| {
                let joint = &model.joints[redundant.joint].name;
                format!("`{joint}[{}]`", redundant.row)
            })
            .collect();
        let fate = if found.dropped {
            "left out"
        } else {
            "kept, so that the formulation needs a compliance"
        };
        text += &format!(" Redundant equations, {fate}: {}.", rows.join(", "));
    }
    text
}

//! The documentation of a generated implementation: bodies, joints, rows, sizes, counts.

use proc_macro2::TokenStream;
use quote::quote;

use super::report::counts;
use crate::model::{BodyKind, Model};
use crate::plan::kernels::Kernels;

/// Documentation as attributes.
#[must_use]
pub fn documentation(model: &Model, kernels: &Kernels) -> TokenStream {
    let layout = model.layout();
    let mut lines = vec![
        format!(
            "Generated kernels: {} coordinates, {} velocities, {} constraint equations; degrees of freedom (velocities less \
             equations): {}.",
            layout.coordinates,
            layout.velocities,
            layout.rows,
            layout.velocities.cast_signed() - layout.rows.cast_signed()
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
    if !model.joints.is_empty() {
        lines.push(String::new());
        lines.push("| joint | type | between | rows |".into());
        lines.push("|---|---|---|---|".into());
        for (place, joint) in model.joints.iter().enumerate() {
            let definition = model.definition(joint);
            let bodies: Vec<String> = joint
                .bodies
                .iter()
                .map(|body| {
                    body.map_or("ground".into(), |body| model.bodies[body].name.to_string())
                })
                .collect();
            let first = layout.row[place];
            lines.push(format!(
                "| `{}` | {} | {} | {}..{} |",
                joint.name,
                definition.name,
                bodies.join(", "),
                first,
                first + definition.equations()
            ));
        }
    }
    lines.push(String::new());
    lines.push("| kernel | operations | + - | * | / | sqrt | depth |".into());
    lines.push("|---|---|---|---|---|---|---|".into());
    for (name, count) in counts(kernels) {
        lines.push(format!(
            "| {name} | {} | {} | {} | {} | {} | {} |",
            count.total(),
            count.additions,
            count.multiplications,
            count.divisions,
            count.square_roots,
            count.depth
        ));
    }
    let lines = lines.iter().map(|line| format!(" {line}"));
    quote!(#( #[doc = #lines] )*)
}

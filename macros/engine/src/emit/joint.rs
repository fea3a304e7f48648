//! A joint: its type, its traits, its carrier.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::diag::list;
use crate::model::{BodyKind, JointDef};
use crate::syntax::joint::JointSyntax;
use crate::wire;

/// Writes a joint. A faulty definition still yields the type, so that its users see one error and not many.
#[must_use]
pub fn emit(syntax: &JointSyntax, joint: Option<&JointDef>, facade: &TokenStream) -> TokenStream {
    let JointSyntax {
        attributes,
        visibility,
        name,
        ..
    } = syntax;
    let fingerprint = joint.map_or(0, |joint| joint.fingerprint);
    let carrier = wire::carrier(syntax, facade, fingerprint, joint.is_some());
    let documentation = joint.map(documentation);
    let text = name.to_string();
    let equations = joint.map_or(0, JointDef::equations);
    let bodies = syntax.bodies.len();
    let fingerprint = Literal::u64_suffixed(fingerprint);
    let angle = syntax
        .statements
        .iter()
        .any(|s| matches!(s, crate::syntax::joint::Statement::Angle { .. }))
        .then(|| quote!(#[automatically_derived] impl #facade::HasAngle for #name {}));
    quote! {
        #(#attributes)*
        #documentation
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        #visibility struct #name;

        #[automatically_derived]
        impl #facade::Joint for #name {
            const NAME: &'static str = #text;
            const EQUATIONS: usize = #equations;
            const BODIES: usize = #bodies;
            const FINGERPRINT: u64 = #fingerprint;
        }
        #angle
        #carrier
    }
}

fn documentation(joint: &JointDef) -> TokenStream {
    let equations = joint.equations();
    let bodies = list(&joint.bodies);
    let mut lines = vec![
        String::new(),
        format!(
            "{equations} {}. Bodies, in the order of `between`: {bodies}. Attributes:",
            if equations == 1 {
                "equation"
            } else {
                "equations"
            }
        ),
        String::new(),
    ];
    for parameter in &joint.parameters {
        lines.push(format!(
            "- `{}`: {}",
            parameter.name,
            parameter.kind.example()
        ));
    }
    if joint.parameters.is_empty() {
        lines.push("- none".into());
    }
    if let Some(angle) = joint.angle {
        let axis = &joint.parameters[angle.axis].name;
        let (i, j) = (&joint.bodies[0], &joint.bodies[1]);
        lines.push(String::new());
        lines.push(format!(
            "The angle of the joint is that of `{j}` against `{i}`, right-handed about `{axis}`, zero in the described \
             configuration."
        ));
    }
    let lines = lines.iter().map(|line| format!(" {line}"));
    quote!(#( #[doc = #lines] )*)
}

/// The word for a kind of body in the run-time crate.
#[must_use]
pub fn kind(kind: BodyKind, facade: &TokenStream) -> TokenStream {
    match kind {
        BodyKind::Rigid => quote!(#facade::BodyKind::Rigid),
        BodyKind::Particle => quote!(#facade::BodyKind::Particle),
    }
}

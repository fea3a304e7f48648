//! A joint or a force: its type, its traits, its carrier.

use proc_macro2::{Literal, Span, TokenStream};
use quote::{quote, quote_spanned};

use crate::diag::list;
use crate::model::{BodyKind, Direction, ElementDef, ElementKind, Motion, Term};
use crate::syntax::joint::{JointSyntax, Statement};
use crate::wire;

/// Writes a joint. A faulty definition still yields the type, so that its users see one error and
/// not many.
#[must_use]
pub fn emit(syntax: &JointSyntax, joint: Option<&ElementDef>, facade: &TokenStream) -> TokenStream {
    let JointSyntax {
        attributes,
        visibility,
        name,
        ..
    } = syntax;
    let fingerprint = joint.map_or(0, |joint| joint.fingerprint);
    let carrier = wire::carrier(wire::Carrier {
        name,
        visibility,
        facade,
        fingerprint,
        definition: wire::element(syntax, joint.is_some()),
        word: syntax.kind.word(),
    });
    let documentation = joint.map(documentation);
    let text = name.to_string();
    let equations = joint.map_or(0, ElementDef::equations);
    let bodies = syntax.bodies.len();
    let fingerprint = Literal::u64_suffixed(fingerprint);
    let has = |wanted: fn(&Statement) -> bool| syntax.statements.iter().any(wanted);
    let marker = |present: bool, marker: TokenStream| {
        present
            .then(|| quote!(#[automatically_derived] impl #facade::__private::#marker for #name {}))
    };
    let traits = match syntax.kind {
        ElementKind::Force => quote! {
            #[automatically_derived]
            impl #facade::__private::Force for #name {
                const NAME: &'static ::core::primitive::str = #text;
                const BODIES: ::core::primitive::usize = #bodies;
                const FINGERPRINT: ::core::primitive::u64 = #fingerprint;
            }
        },
        ElementKind::Joint => {
            let angle = has(|s| matches!(s, Statement::Angle { axes, .. } if axes.len() == 1));
            let angle = marker(angle, quote!(HasAngle));
            let angles = has(|s| matches!(s, Statement::Angle { axes, .. } if axes.len() == 2));
            let angles = marker(angles, quote!(HasTwoAngles));
            let displacement = has(|s| matches!(s, Statement::Displacement(..)));
            let displacement = marker(displacement, quote!(HasDisplacement));
            let contact = has(|s| matches!(s, Statement::Contact(..)));
            let contact = marker(contact, quote!(HasContact));
            let driven = has(|s| matches!(s, Statement::Drive(..))).then(|| {
                let row = joint.and_then(|joint| joint.drive).unwrap_or_default();
                quote! {
                    #[automatically_derived]
                    impl #facade::__private::Driven for #name { const ROW: ::core::primitive::usize = #row; }
                }
            });
            quote! {
                #[automatically_derived]
                impl #facade::__private::Joint for #name {
                    const NAME: &'static ::core::primitive::str = #text;
                    const EQUATIONS: ::core::primitive::usize = #equations;
                    const BODIES: ::core::primitive::usize = #bodies;
                    const FINGERPRINT: ::core::primitive::u64 = #fingerprint;
                }
                #angle
                #angles
                #displacement
                #contact
                #driven
            }
        }
    };
    // Where the compiler speaks of it, it stands where the definition does.
    let at = name.span().resolved_at(Span::call_site());
    let declaration = quote_spanned!(at=> #visibility struct #name;);
    quote! {
        #(#attributes)*
        #documentation
        #[derive(
            ::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug, ::core::default::Default, ::core::cmp::PartialEq,
            ::core::cmp::Eq,
        )]
        #declaration

        #traits
        #[automatically_derived]
        impl #facade::__private::Element for #name {}
        #carrier
    }
}

fn documentation(joint: &ElementDef) -> TokenStream {
    let equations = joint.equations();
    let bodies = list(&joint.bodies);
    let opening = match (joint.kind, equations) {
        (ElementKind::Force, _) => String::new(),
        (_, 1) => "1 equation. ".into(),
        _ => format!("{equations} equations. "),
    };
    let mut lines = vec![
        String::new(),
        format!("{opening}Bodies, in the order of `between`: {bodies}. Attributes:"),
        String::new(),
    ];
    for parameter in &joint.parameters {
        let mut line = format!("- `{}`: {}", parameter.name, parameter.kind.example());
        if !parameter.arguments.is_empty() {
            let arguments = parameter.arguments.iter().map(ToString::to_string);
            let names = list(std::iter::once("time".to_string()).chain(arguments));
            line = format!("{line}, of {names}");
        }
        if let Some(default) = &parameter.default {
            line = match default {
                Term::Number(value) => format!("{line}; {value} if left out"),
                _ => format!("{line}; if left out, that of the reference configuration"),
            };
        }
        lines.push(line);
    }
    if joint.parameters.is_empty() {
        lines.push("- none".into());
    }
    if let Some(angle) = joint.angle {
        let axis = &joint.parameters[angle.axis].name;
        let (i, j) = (&joint.bodies[angle.from], &joint.bodies[angle.to]);
        let turns = if joint.turns.contains(&angle) {
            "; turns are counted"
        } else {
            ", from `-pi` to `pi`"
        };
        lines.push(String::new());
        lines.push(format!(
            "The angle of the joint is that of `{j}` against `{i}`, right-handed about `{axis}`, zero in the reference \
             configuration{turns}."
        ));
    }
    if let Some(angles) = joint.angles {
        let [first, second] = angles.map(|axis| &joint.parameters[axis].name);
        let (i, j) = (&joint.bodies[0], &joint.bodies[1]);
        lines.push(String::new());
        lines.push(format!(
            "The joint has two angles, of `{j}` against `{i}`: right-handed about `{first}` of `{i}`, then about `{second}` of `{j}`, \
             zero in the reference configuration, from `-pi` to `pi`."
        ));
    }
    if !joint.requirements.is_empty() {
        lines.push(String::new());
        lines.push(
            "The equations hold on another side as well: which one is meant is checked where a state is assembled and where a run begins."
                .into(),
        );
    }
    if let Some(motions) = &joint.motions {
        let (i, j) = (&joint.bodies[0], &joint.bodies[1]);
        let motions = motions.iter().map(|motion| self::motion(joint, *motion));
        lines.push(String::new());
        lines.push(match motions.len() {
            0 => format!("`{j}` does not move against `{i}`."),
            _ => format!(
                "`{j}` moves against `{i}` by {}; each carries those behind it.",
                list(motions)
            ),
        });
    }
    let lines = lines.iter().map(|line| format!(" {line}"));
    quote!(#( #[doc = #lines] )*)
}

/// A motion as it is written.
fn motion(joint: &ElementDef, motion: Motion) -> String {
    let name = |parameter: usize| &joint.parameters[parameter].name;
    let direction = |of: Direction| {
        let normal = match of.normal {
            None => "",
            Some(0) => ".normal()",
            Some(_) => ".binormal()",
        };
        format!("{}{normal}", name(of.parameter))
    };
    match motion {
        Motion::Turn { axis, point } => format!("turn {} at {}", direction(axis), name(point)),
        Motion::Slide { along } => format!("slide {}", direction(along)),
        Motion::Screw { axis, point, pitch } => {
            format!("screw {} at {} by {}", name(axis), name(point), name(pitch))
        }
        Motion::Ball { point } => format!("ball at {}", name(point)),
    }
}

/// The word for a kind of body in the run-time crate.
#[must_use]
pub fn kind(kind: BodyKind, facade: &TokenStream) -> TokenStream {
    match kind {
        BodyKind::Rigid => quote!(#facade::__private::BodyKind::Rigid),
        BodyKind::Particle => quote!(#facade::__private::BodyKind::Particle),
    }
}

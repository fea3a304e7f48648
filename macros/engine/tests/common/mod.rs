//! What a compiler session does between the derive and `assemble!`, without the compiler.
#![allow(dead_code, reason = "every test uses a part of it")]

use holonom_engine::check::definition::{Definition, Definitions};
use holonom_engine::diag::Faults;
use holonom_engine::model::{BodyKind, ElementDef, ElementKind, Model};
use holonom_engine::{check, passes, syntax};
use proc_macro2::TokenStream;
use quote::quote;

/// Definitions by the names of their types: built-in ones, and ones that use the rest of the
/// language.
const DEFINITIONS: [(&str, &str); 6] = [
    (
        "Revolute",
        "Revolute(i, j; point: Point, axis: Axis) { \
         j.point - i.point; dot(i.axis.normals(), j.axis); angle about axis; }",
    ),
    (
        "Spherical",
        "Spherical(i, j; point: Point) { j.point - i.point; }",
    ),
    (
        "Rod",
        "Rod(i, j; head: Point, tail: Point, length: Length) { \
         squared(j.tail - i.head) - length * length; }",
    ),
    (
        "Winch",
        "Winch(i, j; point: Point, axis: Axis, pitch: Length = initial(length(i.point - j.origin)), motion: Law) { \
         let d = j.point - i.point; let n = fixed(j, i.axis.normal()); \
         dot(i.axis.normals(), j.axis); dot(n, d) - sqrt(1.0 + squared(d)) / 2.0 + 0.5; \
         dot(i.axis, d) - pitch / TAU * angle(i, j, axis); drive angle(i, j, axis) to motion(); \
         angle about axis; displacement dot(i.axis, d); }",
    ),
    (
        "Damper",
        "Damper(i, j; head: Point, tail: Point, stiffness: Number, damping: Number = 0.0, force: Law(length, rate)) { \
         let d = length(j.tail - i.head); potential 0.5 * stiffness * d * d; -damping * rate(d) along d; \
         force(d, rate(d)) along d; }",
    ),
    (
        "Push",
        "Push(i, j; point: Point, thrust: Vector) { force i.thrust at j.point; moment cross(i.thrust, [0.1, 0.2, time]) on j; }",
    ),
];

/// Which of them are forces.
const FORCES: [&str; 2] = ["Damper", "Push"];

/// The annotated structs of `data`, by name.
pub(crate) const SCENES: [(&str, &str); 5] = [
    ("pendulum", include_str!("../data/pendulum.rs")),
    ("heavy top", include_str!("../data/heavy_top.rs")),
    (
        "double pendulum",
        include_str!("../data/double_pendulum.rs"),
    ),
    (
        "spherical pendulum",
        include_str!("../data/spherical_pendulum.rs"),
    ),
    ("spinning body", include_str!("../data/spinning_body.rs")),
];

/// The pendulum of chapter 15.
pub(crate) const PENDULUM: &str = SCENES[0].1;

/// A driven mechanism with forces and run-time values.
pub(crate) const HOIST: &str = include_str!("../data/hoist.rs");

/// Arrays of bodies, joints, forces and values.
pub(crate) const ROW: &str = include_str!("../data/row.rs");

/// A struct with several faults.
pub(crate) const FAULTY: &str = include_str!("../data/faulty.rs");

/// Tokens of a text.
pub(crate) fn tokens(text: &str) -> TokenStream {
    text.parse().expect("brackets in pairs")
}

/// The paths of the carriers, as text.
fn paths(item: &TokenStream) -> Vec<String> {
    let input = syn::parse2(item.clone());
    let paths = input.map_or_else(
        |_| Vec::new(),
        |input| syntax::mechanism::carrier_paths(&input),
    );
    paths.iter().map(ToString::to_string).collect()
}

/// The kind and the text of a definition.
pub(crate) fn definition(path: &str) -> Option<(ElementKind, TokenStream)> {
    let (name, text) = DEFINITIONS.iter().find(|(name, _)| *name == path)?;
    let kind = if FORCES.contains(name) {
        ElementKind::Force
    } else {
        ElementKind::Joint
    };
    Some((kind, tokens(text)))
}

/// What reaches `assemble!` for an annotated struct.
pub(crate) fn delivery(item: &TokenStream) -> TokenStream {
    delivery_of(item, definition)
}

/// What reaches `assemble!` for an annotated struct and definitions of one's own.
pub(crate) fn delivery_of(
    item: &TokenStream,
    find: impl Fn(&str) -> Option<(ElementKind, TokenStream)>,
) -> TokenStream {
    let definitions = paths(item).into_iter().map(|path| match path.as_str() {
        "Body" => quote!([body]),
        "Particle" => quote!([particle]),
        path => match find(path) {
            Some((ElementKind::Joint, definition)) => quote!([joint { #definition }]),
            Some((ElementKind::Force, definition)) => quote!([force { #definition }]),
            None => quote!([faulty]),
        },
    });
    quote!([::holonom] [#(#definitions)*] { #item })
}

/// What an annotated struct without faults means.
pub(crate) fn model(item: &TokenStream) -> Model {
    delivered(item, definition)
}

/// What an annotated struct without faults means, with definitions of one's own.
pub(crate) fn delivered(
    item: &TokenStream,
    find: impl Fn(&str) -> Option<(ElementKind, TokenStream)>,
) -> Model {
    checked(item, find).unwrap_or_else(|faults| panic!("faults: {faults}"))
}

/// What an annotated struct means, with definitions of one's own, or what is wrong with it.
pub(crate) fn checked(
    item: &TokenStream,
    find: impl Fn(&str) -> Option<(ElementKind, TokenStream)>,
) -> Result<Model, String> {
    let input = syn::parse2(item.clone()).expect("a struct");
    let mut faults = Faults::new();
    let written = syntax::mechanism::parse(&input, &Vec::new(), &mut faults);
    let mut definitions: Vec<ElementDef> = Vec::new();
    let mut types: Definitions = Vec::new();
    for path in paths(item) {
        let found = match path.as_str() {
            "Body" => Definition::Body(BodyKind::Rigid),
            "Particle" => Definition::Body(BodyKind::Particle),
            path => {
                let (kind, body) = find(path).expect("a known definition");
                let joint = syntax::joint::parse_transported(body, kind, &mut faults);
                let joint = joint.and_then(|joint| check::joint::check(&joint, &mut faults));
                let Some(joint) = joint else {
                    return Err(format!("of `{path}`: {}", faults.into_tokens()));
                };
                definitions.push(joint);
                Definition::Element(definitions.len() - 1)
            }
        };
        types.push((path, found));
    }
    let facade = quote!(::holonom);
    let model = passes::mechanism(&written, &types, definitions, &facade, &mut faults);
    let refused = faults.any();
    let errors = faults.into_tokens().to_string();
    model.filter(|_| !refused).ok_or(errors)
}

/// Everything that is generated for an annotated struct.
pub(crate) fn generated(item: &TokenStream) -> syn::File {
    syn::parse2(holonom_engine::assemble(delivery(item))).expect("items")
}

/// Rods of 1 m and 1 kg one behind the other along y; hinges about x, or about x and z in turn.
pub(crate) fn chain(joint: &str, rods: usize, alternating: bool) -> String {
    let mut text = String::from("#[mechanism(gravity = [0.0, 0.0, -9.81])] struct Chain {");
    for rod in 0..rods {
        let (head, centre) = (rod as f64, rod as f64 + 0.5);
        let before = match rod.checked_sub(1) {
            Some(before) => format!("rod_{before}"),
            None => "ground".into(),
        };
        let axis = match joint {
            "Revolute" if alternating && rod % 2 == 1 => ", axis = [0.0, 0.0, 1.0]",
            "Revolute" => ", axis = [1.0, 0.0, 0.0]",
            _ => "",
        };
        text += &format!(
            "#[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, {centre:?}, 0.0])] rod_{rod}: Body,
            #[joint(between = [{before}, rod_{rod}], point = [0.0, {head:?}, 0.0]{axis})] joint_{rod}: {joint},"
        );
    }
    text + "}"
}

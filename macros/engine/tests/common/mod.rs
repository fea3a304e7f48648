//! What a compiler session does between the derive and `assemble!`, without the compiler.
#![allow(dead_code, reason = "every test uses a part of it")]

use holonom_engine::check::mechanism::{Definition, Definitions};
use holonom_engine::diag::Faults;
use holonom_engine::model::{BodyKind, ElementKind, JointDef, Model};
use holonom_engine::{check, syntax};
use proc_macro2::TokenStream;
use quote::quote;

/// Definitions of joints by the names of their types: the built-in ones, and one more.
const JOINTS: [(&str, &str); 3] = [
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
];

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

fn definition(path: &str) -> Option<TokenStream> {
    let (_, text) = JOINTS.iter().find(|(name, _)| *name == path)?;
    Some(tokens(text))
}

/// What reaches `assemble!` for an annotated struct.
pub(crate) fn delivery(item: &TokenStream) -> TokenStream {
    let definitions = paths(item).into_iter().map(|path| match path.as_str() {
        "Body" => quote!([body]),
        "Particle" => quote!([particle]),
        path => definition(path).map_or_else(
            || quote!([faulty]),
            |definition| quote!([joint { #definition }]),
        ),
    });
    quote!([::holonom] [#(#definitions)*] { #item })
}

/// What an annotated struct without faults means.
pub(crate) fn model(item: &TokenStream) -> Model {
    let input = syn::parse2(item.clone()).expect("a struct");
    let mut faults = Faults::new();
    let written = syntax::mechanism::parse(&input, &mut faults);
    let mut definitions: Vec<JointDef> = Vec::new();
    let mut types: Definitions = Vec::new();
    for path in paths(item) {
        let found = match path.as_str() {
            "Body" => Definition::Body(BodyKind::Rigid),
            "Particle" => Definition::Body(BodyKind::Particle),
            path => {
                let body = definition(path).expect("a known joint");
                let joint = syntax::joint::parse_transported(body, ElementKind::Joint, &mut faults);
                let joint = joint.and_then(|joint| check::joint::check(&joint, &mut faults));
                definitions.extend(joint);
                Definition::Element(definitions.len() - 1)
            }
        };
        types.push((path, found));
    }
    let facade = quote!(::holonom);
    let model = check::mechanism::check(&written, &types, definitions, &facade, &mut faults);
    let errors = faults.into_tokens();
    model.unwrap_or_else(|| panic!("faults: {errors}"))
}

/// Everything that is generated for an annotated struct.
pub(crate) fn generated(item: &TokenStream) -> syn::File {
    syn::parse2(holonom_engine::assemble(delivery(item))).expect("items")
}

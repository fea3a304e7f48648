//! The definitions of the library, as they stand in the run-time crate.

use std::sync::OnceLock;

use holonom_engine::model::ElementKind;
use proc_macro2::TokenTree;
use syn::Item;

const FILES: [&str; 19] = [
    include_str!("../../../../runtime/src/joints/constant_velocity.rs"),
    include_str!("../../../../runtime/src/joints/cylindrical.rs"),
    include_str!("../../../../runtime/src/joints/distance.rs"),
    include_str!("../../../../runtime/src/joints/drivers.rs"),
    include_str!("../../../../runtime/src/joints/fixed.rs"),
    include_str!("../../../../runtime/src/joints/gears.rs"),
    include_str!("../../../../runtime/src/joints/links.rs"),
    include_str!("../../../../runtime/src/joints/planar.rs"),
    include_str!("../../../../runtime/src/joints/points.rs"),
    include_str!("../../../../runtime/src/joints/prismatic.rs"),
    include_str!("../../../../runtime/src/joints/revolute.rs"),
    include_str!("../../../../runtime/src/joints/rolling.rs"),
    include_str!("../../../../runtime/src/joints/screw.rs"),
    include_str!("../../../../runtime/src/joints/spherical.rs"),
    include_str!("../../../../runtime/src/joints/universal.rs"),
    include_str!("../../../../runtime/src/joints/vectors.rs"),
    include_str!("../../../../runtime/src/forces/actuators.rs"),
    include_str!("../../../../runtime/src/forces/given.rs"),
    include_str!("../../../../runtime/src/forces/springs.rs"),
];

/// Name, kind and text of every definition.
fn all() -> &'static [(String, ElementKind, String)] {
    static ALL: OnceLock<Vec<(String, ElementKind, String)>> = OnceLock::new();
    ALL.get_or_init(|| {
        let files = FILES
            .iter()
            .map(|text| syn::parse_file(text).expect("a file"));
        let items = files.flat_map(|file| file.items);
        items.filter_map(|item| definition_of(&item)).collect()
    })
}

/// Name, kind and text of a definition.
pub(crate) fn definition_of(item: &Item) -> Option<(String, ElementKind, String)> {
    let Item::Macro(item) = item else { return None };
    let kind = match item.mac.path.segments.last()?.ident.to_string().as_str() {
        "joint" => ElementKind::Joint,
        "force" => ElementKind::Force,
        _ => return None,
    };
    // Documentation, `pub joint`, then what counts.
    let mut tokens = item.mac.tokens.clone().into_iter();
    tokens.find(|token| matches!(token, TokenTree::Ident(word) if *word == kind.word()))?;
    let name = tokens.next()?;
    let rest: proc_macro2::TokenStream = tokens.collect();
    Some((name.to_string(), kind, format!("{name} {rest}")))
}

/// Kind and text of a definition.
pub(crate) fn definition(name: &str) -> Option<(ElementKind, String)> {
    let found = all().iter().find(|(known, ..)| known == name);
    found.map(|(_, kind, text)| (*kind, text.clone()))
}

/// The names of all definitions.
pub(crate) fn names() -> impl Iterator<Item = &'static str> {
    all().iter().map(|(name, ..)| name.as_str())
}

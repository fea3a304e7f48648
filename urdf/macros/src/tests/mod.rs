//! The items that are put in place, against the source that is printed; and what is refused.

use std::fs;
use std::path::{Path, PathBuf};

use holonom_urdf::{Options, Robot};
use proc_macro2::{Span, TokenStream};
use quote::{ToTokens, quote};
use syn::spanned::Spanned;
use syn::{Attribute, Field, File, ImplItem, Item, ItemStruct, Visibility};

use crate::expand::expand;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_owned()
}

/// The items that a call leaves, called as `holonom::urdf!` calls it.
fn placed(call: &str) -> File {
    let tokens: TokenStream = call.parse().expect("tokens");
    syn::parse2(expand(tokens, &folder())).expect("items")
}

fn structure(file: &File) -> &ItemStruct {
    let mut structures = file.items.iter().filter_map(|item| match item {
        Item::Struct(item) => Some(item),
        _ => None,
    });
    structures.next_back().expect("a struct")
}

fn text(tokens: impl ToTokens) -> String {
    tokens.to_token_stream().to_string()
}

/// The attributes but the derives, whose names are paths in place.
fn attributes(all: &[Attribute]) -> Vec<String> {
    let others = all.iter().filter(|one| !one.path().is_ident("derive"));
    others.map(text).collect()
}

/// A field without the path of its type.
fn field(field: &Field) -> (String, String, String) {
    let kind = text(&field.ty);
    let last = kind.rsplit("::").next().unwrap_or_default();
    let name = field.ident.as_ref().expect("a name");
    let attributes = attributes(&field.attrs).concat();
    (name.to_string(), last.trim().to_owned(), attributes)
}

/// The constants beside the struct.
fn constants(file: &File) -> Vec<String> {
    let items = file.items.iter().filter_map(|item| match item {
        Item::Impl(item) => Some(&item.items),
        _ => None,
    });
    let constants = items.flatten().map(|item| match item {
        ImplItem::Const(constant) => {
            assert!(matches!(constant.vis, Visibility::Public(_)));
            text(constant)
        }
        other => panic!("{}", text(other)),
    });
    constants.collect()
}

/// The joints and forces that are defined, wherever they are.
fn definitions(items: &[Item]) -> Vec<String> {
    let mut found = Vec::new();
    for item in items {
        match item {
            Item::Macro(item) => found.push(text(&item.mac.tokens)),
            Item::Mod(module) => {
                let (_, items) = module.content.as_ref().expect("a body");
                found.extend(definitions(items));
            }
            _ => {}
        }
    }
    found
}

#[test]
fn every_robot_is_as_it_is_printed() {
    let mut robots = 0;
    for data in ["../tests/data", "../tests/data/robots"] {
        for entry in fs::read_dir(folder().join(data)).expect("a folder") {
            let name = entry.expect("readable").file_name();
            let name = name.to_string_lossy();
            if !name.ends_with(".urdf") {
                continue;
            }
            let path = format!("{data}/{name}");
            let read = fs::read_to_string(folder().join(&path)).expect("readable");
            let robot = Robot::parse(&read).expect("sound");
            let printed = robot.mechanism(&Options::default()).expect("it moves");
            let file: File = syn::parse_str(&printed.to_string()).expect("Rust");
            let call = format!("[::holonom] pub struct {} = {path:?};", printed.name);
            let placed = placed(&call);
            let (one, other) = (structure(&placed), structure(&file));
            assert_eq!(attributes(&one.attrs), attributes(&other.attrs), "{name}");
            let fields = |item: &ItemStruct| item.fields.iter().map(field).collect::<Vec<_>>();
            assert_eq!(fields(one), fields(other), "{name}");
            assert_eq!(constants(&placed), constants(&file), "{name}");
            assert_eq!(definitions(&placed.items), definitions(&file.items));
            robots += 1;
        }
    }
    assert!(robots >= 14, "{robots} robots");
}

#[test]
fn the_printer_derives_what_is_derived_by_paths() {
    let robot = Robot::parse(&fs::read_to_string(folder().join("../arm.urdf")).expect("readable"));
    let printed = robot.expect("sound").mechanism(&Options::default());
    let printed = printed.expect("it moves").to_string();
    let file = syn::parse_str(&printed).expect("Rust");
    let placed = placed(r#"[::holonom] struct Arm = "../arm.urdf";"#);
    let names = |file: &File| {
        let mut derived = Vec::new();
        for attribute in &structure(file).attrs {
            if attribute.path().is_ident("derive") {
                let read = attribute.parse_nested_meta(|path| {
                    let last = path.path.segments.last().expect("a name");
                    derived.push(last.ident.to_string());
                    Ok(())
                });
                read.expect("paths");
            }
        }
        derived
    };
    assert_eq!(names(&placed), names(&file));
}

#[test]
fn options_attributes_and_fields_are_those_of_the_user() {
    let call = r#"[::holonom]
        /// Ours.
        #[urdf(floating, passive)]
        #[mechanism(coordinates = "both")]
        pub(crate) struct Arm = "../tests/data/robots/solo12.urdf" {
            #[joint(between = [ground, base_link])]
            own: Planar,
        }"#;
    let placed = placed(call);
    let placed = structure(&placed);
    let all = attributes(&placed.attrs);
    assert_eq!(all[0], text(quote!(#[doc = " Ours."])));
    assert!(all.iter().any(|one| one.contains("The root link floats")));
    let settings = quote!(#[mechanism(coordinates = "both", gravity = [0.0, 0.0, -9.81])]);
    let of_mechanism: Vec<_> = all.iter().filter(|one| one.contains("mechanism")).collect();
    assert_eq!(of_mechanism, [&text(settings)]);
    assert!(all.iter().all(|one| !one.contains("urdf (")), "{all:?}");
    assert_eq!(text(&placed.vis), "pub (crate)");
    let last = placed.fields.iter().next_back().expect("a field");
    assert_eq!(last.ident.as_ref().expect("a name"), "own");
    let is_input = |field: &Field| field.attrs.iter().any(|one| one.path().is_ident("input"));
    assert!(!placed.fields.iter().any(is_input));
}

/// What the user's `#[mechanism(..)]` does not name stays: gravity was dropped without a word.
#[test]
fn settings_of_the_user_stand_beside_those_of_the_file() {
    for (own, whole) in [
        (
            "",
            quote!(gravity = [0.0, 0.0, -9.81], coordinates = "joints"),
        ),
        (
            "redundant = \"drop\",",
            quote!(
                redundant = "drop",
                gravity = [0.0, 0.0, -9.81],
                coordinates = "joints"
            ),
        ),
        (
            "gravity = [0.0, 0.0, 0.0]",
            quote!(gravity = [0.0, 0.0, 0.0], coordinates = "joints"),
        ),
        (
            "coordinates = \"bodies\", gravity = [0.0, 0.0, -1.62],",
            quote!(coordinates = "bodies", gravity = [0.0, 0.0, -1.62],),
        ),
    ] {
        let call = format!(r#"[::holonom] #[mechanism({own})] struct Arm = "../arm.urdf";"#);
        let placed = placed(&call);
        let all = attributes(&structure(&placed).attrs);
        let found: Vec<_> = all.iter().filter(|one| one.contains("mechanism")).collect();
        assert_eq!(found, [&text(quote!(#[mechanism(#whole)]))]);
    }
}

/// Messages of errors, with the places at which they are.
fn refusals(call: &str) -> Vec<(String, Span)> {
    let file = placed(call);
    let errors = file.items.iter().filter_map(|item| match item {
        Item::Macro(item) => {
            assert!(
                item.mac
                    .path
                    .segments
                    .iter()
                    .any(|s| s.ident == "compile_error")
            );
            let message: syn::LitStr = item.mac.parse_body().expect("a message");
            Some((message.value(), item.mac.path.segments.span()))
        }
        _ => None,
    });
    errors.collect()
}

#[test]
fn all_faults_of_a_file_are_at_its_name() {
    let call = r#"[::holonom] struct Arm = "src/tests/broken.urdf";"#;
    let refusals = refusals(call);
    let messages: Vec<&str> = refusals.iter().map(|(message, _)| &**message).collect();
    let wanted = [
        "4: joint \"hinge\": type \"hinge\" is no joint of URDF; revolute, continuous, prismatic, fixed, \
         floating, planar are",
        "7: joint \"slide\": parent \"rods\" is no link; did you mean \"rod\"?",
        "8: joint \"slide\": `xyz` is \"1 0\"; 3 numbers with spaces between them are accepted",
    ];
    let wanted = wanted.map(|fault| format!("src/tests/broken.urdf:{fault}"));
    assert_eq!(messages, wanted);
    let name = call.find('"').expect("it is there");
    for (_, span) in &refusals {
        assert_eq!(span.start().column, name);
    }
}

#[test]
fn a_file_with_faults_is_watched_too() {
    let placed = placed(r#"[::holonom] struct Arm = "src/tests/broken.urdf";"#);
    let watched = text(&placed).matches("include_bytes").count();
    assert_eq!(watched, 1);
}

#[test]
fn a_file_that_is_not_there_and_options_that_are_none_are_refused() {
    let call = r#"[::holonom] struct Arm = "robots/none.urdf";"#;
    let [(message, span)] = &refusals(call)[..] else {
        panic!("one");
    };
    assert!(message.starts_with("robots/none.urdf: "), "{message}");
    assert!(message.ends_with("a path from the folder of `Cargo.toml` is accepted"));
    assert_eq!(span.start().column, call.find('"').expect("it is there"));

    let call = r#"[::holonom] #[urdf(float, passive, rounded, inertia = "given")] struct Arm = "../arm.urdf";"#;
    let found = refusals(call);
    let accepted =
        "`floating`, `passive`, `round_angles` and `inertia = \"as given\"` are accepted";
    let wanted = ["float", "rounded", "inertia = \"given\""]
        .map(|word| format!("`{word}` is no option; {accepted}"));
    let messages: Vec<&String> = found.iter().map(|(message, _)| message).collect();
    assert_eq!(messages, wanted.iter().collect::<Vec<_>>());
    assert_eq!(
        found[1].1.start().column,
        call.find("rounded").expect("it is there")
    );
}

//! Broken input never breaks the generator: whatever comes in, tokens come out, and none of them
//! reports a panic.

mod common;

use common::{FAULTY, HOIST, PENDULUM, ROW, SCENES, definition, delivery, delivery_of, tokens};
use holonom_engine::model::ElementKind;
use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use quote::quote;
use syn::DeriveInput;

/// A definition of shapes that the others do not have.
const JOINT: &str = "/** Everything. */ pub joint Any(i, j, k; point: Point, axis: Axis, size: Length) { \
    j.point - i.point + size * cross(i.axis, k.axis); dot(i.axis.normals(), j.axis); \
    squared(j.origin - -i.point) - size * 2.0; angle about axis; }";

/// A definition that says how its joint moves, and is compared with that.
const SLAB: &str = "/** A slab. */ pub joint Slab(i, j; point: Point, normal: Axis) { \
    dot(i.normal.normals(), j.normal); dot(i.normal, j.point - i.point); \
    motion slide normal.normal(), slide normal.binormal(), turn normal at point; }";

type EntryPoint = fn(TokenStream) -> TokenStream;

/// A small generator of numbers, the same ones on every machine (Knuth's linear congruence).
struct Dice(u64);

impl Dice {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        usize::try_from((self.0 >> 33) % bound.max(1) as u64).unwrap_or(0)
    }
}

fn size(tokens: TokenStream) -> usize {
    tokens
        .into_iter()
        .map(|token| match token {
            TokenTree::Group(group) => 1 + size(group.stream()),
            _ => 1,
        })
        .sum()
}

/// The tokens, and what `change` makes of one of their groups, the `place`-th token of all.
fn changed(
    tokens: TokenStream,
    place: &mut usize,
    change: &mut dyn FnMut(&mut Vec<TokenTree>, usize),
) -> TokenStream {
    let mut list: Vec<TokenTree> = Vec::new();
    let mut here = None;
    for token in tokens {
        if *place == 0 {
            here = Some(list.len());
        }
        *place = place.wrapping_sub(1);
        list.push(match token {
            TokenTree::Group(group) => {
                let inner = changed(group.stream(), place, change);
                let mut copy = Group::new(group.delimiter(), inner);
                copy.set_span(group.span());
                TokenTree::Group(copy)
            }
            other => other,
        });
    }
    if let Some(at) = here {
        change(&mut list, at);
    }
    list.into_iter().collect()
}

/// One of many ways to spoil tokens at one place.
fn spoil(list: &mut Vec<TokenTree>, at: usize, dice: &mut Dice) {
    let other = dice.below(list.len());
    let span = list[at].span();
    let group = |delimiter, inner| {
        let mut group = Group::new(delimiter, inner);
        group.set_span(span);
        TokenTree::Group(group)
    };
    match dice.below(7) {
        0 => drop(list.remove(at)),
        1 => list.truncate(at),
        2 => list.swap(at, other),
        3 => list.insert(at, list[other].clone()),
        4 => list[at] = group(Delimiter::Bracket, TokenStream::new()),
        5 => list[at] = group(Delimiter::None, list[at].clone().into()),
        _ => {
            let words = [
                ";",
                ",",
                "=",
                "-",
                "1e400",
                "0",
                "\"text\"",
                "ground",
                "'a",
                "!",
                "as",
                "r#mass",
                "PI",
                "time",
                "rate",
                "angle",
                "angle about axis, axis",
                "angular_velocity(i, j)",
                "atan2(time, 1.0)",
                "asin",
                "initial",
                "let",
                "along",
                "drive",
                "motion",
                "turn",
                "ball at point",
                "screw axis at point by length",
                "none",
                "i",
                "j",
                "(i.point)",
                "k",
                "[k - 1]",
                "% 2",
                "links[k]",
                "if k == 0 { 1.0 } else { ground }",
            ];
            let word = tokens(words[dice.below(words.len())]);
            list.splice(at..=at, word);
        }
    }
}

#[track_caller]
fn assert_survives(entry_point: EntryPoint, input: &TokenStream) -> TokenStream {
    let output = entry_point(input.clone());
    let text = output.to_string();
    assert!(
        !text.contains("generator failed"),
        "{input}\n\ngives\n\n{text}"
    );
    output
}

/// Every refusal says something, at a token of the input.
#[track_caller]
fn assert_refusals_have_places(input: &TokenStream, output: TokenStream) {
    let output: Vec<TokenTree> = output.into_iter().collect();
    for window in output.windows(3) {
        let [
            TokenTree::Ident(name),
            TokenTree::Punct(_),
            TokenTree::Group(message),
        ] = window
        else {
            continue;
        };
        if name == "compile_error" {
            let text = message.stream().to_string();
            assert!(text.len() > 10, "{input}\n\nis refused by {text}");
            // Outside of a compiler, the span of the macro's call is an empty one.
            assert!(
                !name.span().byte_range().is_empty(),
                "{input}\n\nis refused nowhere: {text}"
            );
        }
    }
}

/// The tokens, spoilt at some places.
fn spoilt(sound: &TokenStream, places: usize, dice: &mut Dice) -> TokenStream {
    let mut soup = sound.clone();
    for _ in 0..places {
        let mut place = dice.below(size(soup.clone()));
        let mut rolls = Dice(dice.below(usize::MAX) as u64);
        soup = changed(soup, &mut place, &mut |list, at| {
            spoil(list, at, &mut rolls)
        });
    }
    soup
}

fn assert_survives_soup(
    entry_point: EntryPoint,
    sound: &TokenStream,
    rounds: usize,
    seed: u64,
    has_places: impl Fn(&TokenStream) -> bool,
) {
    let mut dice = Dice(seed);
    assert_survives(entry_point, sound);
    for _ in 0..rounds {
        let places = 1 + dice.below(3);
        let soup = spoilt(sound, places, &mut dice);
        let output = assert_survives(entry_point, &soup);
        if !soup.is_empty() && has_places(&soup) {
            assert_refusals_have_places(&soup, output);
        }
    }
}

/// Behind the name of the run-time crate, which the user does not write.
fn joint(tokens: TokenStream) -> TokenStream {
    holonom_engine::joint(quote!([::holonom] #tokens))
}

fn force(tokens: TokenStream) -> TokenStream {
    holonom_engine::force(quote!([::holonom] #tokens))
}

fn assemble(item: TokenStream) -> TokenStream {
    holonom_engine::assemble(delivery(&item))
}

/// What a user writes for a definition, with places.
fn written(path: &str) -> TokenStream {
    let (kind, body) = definition(path).expect("a known definition");
    tokens(&format!("{} {body}", kind.word()))
}

#[test]
fn definitions_of_joints() {
    let (any, slab, winch) = (tokens(JOINT), tokens(SLAB), written("Winch"));
    assert_survives_soup(joint, &slab, 2000, 6, |_| true);
    assert_survives_soup(joint, &any, 2000, 1, |_| true);
    assert_survives_soup(joint, &winch, 3000, 2, |_| true);
    assert_survives(joint, &TokenStream::new());
    assert_survives(holonom_engine::joint, &TokenStream::new());
}

#[test]
fn definitions_of_forces() {
    let (damper, push) = (written("Damper"), written("Push"));
    assert_survives_soup(force, &damper, 3000, 3, |_| true);
    assert_survives_soup(force, &push, 1500, 4, |_| true);
    assert_survives(force, &TokenStream::new());
}

/// Whatever a definition says that is not refused, mechanisms can be made of it.
#[test]
fn what_is_not_refused_can_be_used() {
    let mut dice = Dice(5);
    let mut used = 0;
    for (item, path) in [
        (HOIST, "Winch"),
        (HOIST, "Damper"),
        (HOIST, "Push"),
        (PENDULUM, "Revolute"),
    ] {
        let (item, (kind, sound)) = (tokens(item), definition(path).expect("a known definition"));
        for _ in 0..150 {
            let soup = spoilt(&sound, 1, &mut dice);
            let output = match kind {
                ElementKind::Joint => joint(quote!(joint #soup)),
                ElementKind::Force => force(quote!(force #soup)),
            };
            let carriers = output.to_string();
            let refused = carriers.contains("[faulty]") || !carriers.contains("macro_rules");
            if !refused {
                used += 1;
                let find = |name: &str| {
                    (name == path)
                        .then(|| (kind, soup.clone()))
                        .or_else(|| definition(name))
                };
                assert_survives(holonom_engine::assemble, &delivery_of(&item, find));
            }
        }
    }
    // Nothing would be tested if all were refused.
    assert!(used > 60, "{used} definitions were used");
}

#[test]
fn annotated_structs() {
    // The compiler itself refuses what is no struct.
    let is_item = |item: &TokenStream| syn::parse2::<DeriveInput>(item.clone()).is_ok();
    let items = [(PENDULUM, 100), (FAULTY, 500), (HOIST, 200), (ROW, 150)];
    for (seed, (item, rounds)) in items.into_iter().enumerate() {
        let item = tokens(item);
        assert_survives_soup(holonom_engine::derive, &item, 1000, seed as u64, is_item);
        assert_survives_soup(assemble, &item, rounds, seed as u64, is_item);
    }
}

#[test]
fn deliveries_that_break_the_protocol() {
    for (item, rounds) in [(FAULTY, 500), (PENDULUM, 100), (HOIST, 100), (ROW, 50)] {
        let sound = delivery(&tokens(item));
        assert_survives_soup(holonom_engine::assemble, &sound, rounds, 3, |_| false);
    }
    assert_survives(holonom_engine::assemble, &TokenStream::new());
}

/// Descriptions that may be read and mean something odd.
#[test]
fn odd_mechanisms() {
    for (_, scene) in SCENES {
        for (from, to) in [
            ("mass = ", "mass = crate::M * "),
            ("position = [0.0", "position = [crate::X"),
            (
                "point = [0.0, 0.0, 0.0]",
                "point = local([0.0, crate::Y, 0.0], [1e300, 0.0, 0.0])",
            ),
            ("[ground, ", "[ground, ground, "),
            ("axis = [1.0, 0.0, 0.0]", "axis = [1e-300, 0.0, 0.0]"),
            (
                "axis = [1.0, 0.0, 0.0]",
                "axis = [crate::A, crate::B, 1e300]",
            ),
            ("pub struct", "pub enum"),
            ("7.02", "1e308"),
            ("0.0010530", "1e-320"),
        ] {
            let item = tokens(&scene.replace(from, to));
            assert_survives(holonom_engine::derive, &item);
            assert_survives(holonom_engine::assemble, &delivery(&item));
        }
    }
}

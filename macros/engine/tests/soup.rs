//! Broken input never breaks the generator: whatever comes in, tokens come out, and none of them reports a panic.

mod common;

use common::{FAULTY, PENDULUM, SCENES, delivery, tokens};
use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};

/// A definition that uses all of the language.
const JOINT: &str = "[::holonom] /** Everything. */ pub joint Any(i, j, k; point: Point, axis: Axis, size: Length) { \
    j.point - i.point + size * cross(i.axis, k.axis); dot(i.axis.normals(), j.axis); \
    squared(j.origin - -i.point) - size * 2.0; angle about axis; }";

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
    match dice.below(7) {
        0 => drop(list.remove(at)),
        1 => list.truncate(at),
        2 => list.swap(at, other),
        3 => list.insert(at, list[other].clone()),
        4 => list[at] = TokenTree::Group(Group::new(Delimiter::Bracket, TokenStream::new())),
        5 => {
            let inner = list[at].clone().into();
            list[at] = TokenTree::Group(Group::new(Delimiter::None, inner));
        }
        _ => {
            let words = [
                ";", ",", "=", "-", "1e400", "0", "\"text\"", "ground", "'a", "!", "as", "r#mass",
                "PI",
            ];
            let word = tokens(words[dice.below(words.len())]);
            list.splice(at..=at, word);
        }
    }
}

#[track_caller]
fn assert_survives(entry_point: EntryPoint, input: &TokenStream) {
    let output = entry_point(input.clone()).to_string();
    assert!(
        !output.contains("generator failed"),
        "{input}\n\ngives\n\n{output}"
    );
}

fn assert_survives_soup(entry_point: EntryPoint, sound: &TokenStream, rounds: usize, seed: u64) {
    let mut dice = Dice(seed);
    assert_survives(entry_point, sound);
    for _ in 0..rounds {
        let mut soup = sound.clone();
        for _ in 0..=dice.below(3) {
            let mut place = dice.below(size(soup.clone()));
            let mut rolls = Dice(dice.below(usize::MAX) as u64);
            soup = changed(soup, &mut place, &mut |list, at| {
                spoil(list, at, &mut rolls)
            });
        }
        assert_survives(entry_point, &soup);
    }
}

#[test]
fn definitions_of_joints() {
    assert_survives_soup(holonom_engine::joint, &tokens(JOINT), 2000, 1);
    assert_survives(holonom_engine::joint, &TokenStream::new());
}

#[test]
fn annotated_structs() {
    for (seed, item) in [PENDULUM, FAULTY].into_iter().enumerate() {
        let item = tokens(item);
        assert_survives_soup(holonom_engine::derive, &item, 1000, seed as u64);
        let assemble = |item: TokenStream| holonom_engine::assemble(delivery(&item));
        assert_survives_soup(assemble, &item, 100, seed as u64);
    }
}

#[test]
fn deliveries_that_break_the_protocol() {
    for (item, rounds) in [(FAULTY, 500), (PENDULUM, 100)] {
        let sound = delivery(&tokens(item));
        assert_survives_soup(holonom_engine::assemble, &sound, rounds, 3);
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

//! What cannot be exported, and by which error: the table of the README, line by line.

use crate::limits::Bars;
use crate::rollout::Balancer;
use holonom::mechanism::{Absolute, Relative};
use holonom::prelude::*;
use holonom_export::{Double, Export, ExportError, ExportExt as _};
use holonom_models::FourBar;

/// Nothing moves by its joints.
#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
struct Stuck {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 0.0])]
    block: Body,
    #[joint(between = [ground, block], point = [0.0, 0.0, 0.0])]
    weld: Fixed,
}

fn joints() -> Export<FourBar, Double, Relative> {
    Export::new(&FourBar::default(), StandardLagrange)
}

/// Errors of programs, and a part of what they say.
fn refused() -> Vec<(ExportError, &'static str)> {
    let bars = FourBar::default();
    let wide = Bars::new(5.0).expect("finite");
    let balancer = Balancer::new(0.2).expect("a height");
    let mut spoiled = Bars::new(0.9).expect("finite");
    spoiled.stop = f64::NAN;
    let compared = joints().reading("side", "", |view| {
        let height = view.position(FourBar::HANDLES.coupler).y;
        if height == holonom::Scalar::zero() {
            height
        } else {
            -height
        }
    });
    let mut bent = bars.described_state().expect("finite");
    bars.set_angle(&mut bent, FourBar::HANDLES.left_foot, 0.5)
        .expect("it turns");
    let opened = joints().starting_from(&bars, &bent);
    let named = |name: &str| joints().reading(name, "", |view| view.time());
    let all = [
        (
            wide.export(StandardLagrange).step(Rk4).c().err(),
            "the limits of joint `left_foot` are a turn or more apart",
        ),
        (
            bars.export(AugmentedLagrangian::default()).c().err(),
            "this formulation iterates",
        ),
        (
            Export::<_, Double, Absolute>::new(&balancer, Penalty::default())
                .c()
                .err(),
            "compliances of equations follow from lengths",
        ),
        (compared.c().err(), "`side` compares numbers"),
        (
            joints().joint_derivatives().c().err(),
            "write `kernels = [derivatives]`",
        ),
        (
            Stuck::default().export(StandardLagrange).c().err(),
            "nothing of the mechanism moves",
        ),
        (
            named("jacobian").derivatives().c().err(),
            "the name `jacobian` is given twice",
        ),
        (named("state").c().err(), "the name `state` is given twice"),
        (
            joints().about("crank", "").c().err(),
            "there is no parameter and no input `crank`",
        ),
        (joints().cuda().err(), "say `.step(Rk4)` before `.cuda()`"),
        (opened.c().err(), "joint `right_pin` is open by 0.6"),
        (
            spoiled.export(StandardLagrange).c().err(),
            "`stop` must be finite",
        ),
        (
            joints().write_c("/dev/null/nowhere").err(),
            "`/dev/null/nowhere`: ",
        ),
    ];
    let all = all.into_iter();
    all.map(|(error, text)| (error.expect(text), text))
        .collect()
}

#[test]
fn what_cannot_be_exported_is_named() {
    for (error, text) in refused() {
        let message = error.to_string();
        assert!(message.contains(text), "{message}");
    }
}

/// Every line of the table has a program above, and every error of a program a line.
#[test]
fn the_table_of_the_readme_has_these_errors() {
    let readme = include_str!("../../README.md");
    let (_, table) = readme
        .split_once("| what | error | what to do |")
        .expect("a table");
    let (table, _) = table.split_once("\n\n").expect("its end");
    let lines = table.lines().skip(2);
    let named = lines.filter_map(|line| line.split('|').nth(2)?.trim().split('`').nth(1));
    let mut named: Vec<String> = named.map(str::to_owned).collect();
    named.sort();
    let seen = refused().into_iter().map(|(error, _)| {
        let shown = format!("{error:?}");
        let end = shown.find(|c: char| !c.is_alphanumeric());
        shown[..end.unwrap_or(shown.len())].to_owned()
    });
    let mut seen: Vec<String> = seen.collect();
    seen.sort();
    seen.dedup();
    assert_eq!(named, seen);
}

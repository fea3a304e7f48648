//! The mechanism as Rust source for a reader.
//!
//! `page` lays out lines, `couplings` says how joints mimic, `fields` writes the struct with
//! `points` of fixed links and `shapes`, and `tables` the constants behind it.

mod couplings;
mod fields;
mod page;
mod points;
mod shapes;
mod tables;

use std::fmt;

use crate::mechanism::Mechanism;
use couplings::Coupling;
use page::Page;

impl fmt::Display for Mechanism {
    /// The source: `use`, the struct, and constants of limits and frames, as `rustfmt` has them.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&source(self))
    }
}

fn source(mechanism: &Mechanism) -> String {
    let mut page = Page::default();
    let couplings = couplings::of(mechanism);
    head(&mut page, mechanism);
    uses(&mut page, mechanism, &couplings);
    definitions(&mut page, mechanism, &couplings);
    fields::describe(&mut page, mechanism, &couplings);
    tables::limits(&mut page, mechanism);
    tables::frames(&mut page, mechanism);
    page.finish()
}

fn head(page: &mut Page, mechanism: &Mechanism) {
    let source = match &mechanism.source {
        Some(file) => format!(" of {}", page::name(file)),
        None => String::new(),
    };
    let text = format!(
        "The robot {}{source}, printed by holonom-urdf {}. Read it and change it: nothing here is \
         bound to the file.",
        page::name(&mechanism.robot),
        env!("CARGO_PKG_VERSION")
    );
    page.comment(0, "//", &text);
    page.blank();
}

fn uses(page: &mut Page, mechanism: &Mechanism, couplings: &[Option<Coupling>]) {
    let turns = |joint: &&crate::mechanism::Joint| joint.kind.is_turn();
    if mechanism
        .joints
        .iter()
        .filter(turns)
        .any(|joint| joint.motor.is_some())
    {
        page.line(0, "use holonom::forces::TorsionalActuator;");
    }
    let mut kinds: Vec<&str> = mechanism
        .joints
        .iter()
        .filter_map(|joint| fields::kind(joint.kind))
        .chain(
            couplings
                .iter()
                .flatten()
                .filter(|c| c.is_gear())
                .map(|_| "Gear"),
        )
        .collect();
    kinds.sort_unstable();
    kinds.dedup();
    match kinds[..] {
        [] => {}
        [kind] => page.line(0, &format!("use holonom::joints::{kind};")),
        _ => page.line(
            0,
            &format!("use holonom::joints::{{{}}};", kinds.join(", ")),
        ),
    }
    page.line(0, "use holonom::prelude::*;");
    page.blank();
}

/// Joints and forces that the crate `holonom` does not have.
fn definitions(page: &mut Page, mechanism: &Mechanism, couplings: &[Option<Coupling>]) {
    let slides = |joint: &&crate::mechanism::Joint| joint.kind.is_single() && !joint.kind.is_turn();
    if mechanism
        .joints
        .iter()
        .filter(slides)
        .any(|joint| joint.motor.is_some())
    {
        page.line(0, "holonom::force! {");
        let text = "A motor of a slide: `force` (N) pushes `j` along `axis`, and `i` the opposite way. It \
                    is an expression of `travel` (m, zero in the reference configuration), `rate` (m/s) \
                    and `time` (s).";
        page.comment(1, "///", text);
        page.line(
            1,
            "pub force SlideActuator(i, j; point: Point, axis: Axis, force: Law(travel, rate)) {",
        );
        page.line(2, "let d = dot(i.axis, j.point - i.point);");
        page.line(2, "force(d, rate(d)) along d;");
        page.line(1, "}");
        page.line(0, "}");
        page.blank();
    }
    let mut known: Vec<String> = Vec::new();
    for coupling in couplings
        .iter()
        .flatten()
        .filter(|coupling| !coupling.is_gear())
    {
        let name = coupling.kind();
        if !known.contains(&name) {
            coupling.define(page);
            known.push(name);
        }
    }
}

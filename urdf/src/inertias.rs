//! Whether what moves could be rigid bodies, and whether the robot as a whole has inertia where one
//! of its links has none.

use crate::definite::without_inertia;
use crate::document::Document;
use crate::faults::{Collector, Fault, Note};
use crate::spatial::Inertia;
use crate::tree::{Group, Tree};

/// How far one moment may exceed the sum of the others, as a part of it; the macro's own limit.
const EXCESS: f64 = 1e-9;

/// What is wrong with an inertia as that of a rigid body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Oddity {
    /// Nothing at all: a frame between joints.
    Nothing,
    /// Moments without a mass.
    Mass,
    /// A moment that is not positive.
    Sign,
    /// A moment above the sum of the others.
    Excess,
}

fn oddity(inertia: &Inertia) -> Option<Oddity> {
    let [least, middle, largest] = inertia.moments();
    if inertia.mass <= 0.0 && inertia.tensor.amax() == 0.0 {
        Some(Oddity::Nothing)
    } else if inertia.mass <= 0.0 {
        Some(Oddity::Mass)
    } else if least <= 0.0 {
        Some(Oddity::Sign)
    } else if largest > (least + middle) * (1.0 + EXCESS) {
        Some(Oddity::Excess)
    } else {
        None
    }
}

/// Whether the body of some links is to be taken as it is given.
pub(crate) fn is_odd(group: &Group) -> bool {
    group.inertia.as_ref().and_then(oddity).is_some()
}

/// How the inertias of a robot are taken.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Asked {
    /// The root is a body as well.
    pub(crate) floating: bool,
    /// Those that no body has are taken as they are given.
    pub(crate) as_given: bool,
}

/// Refuses what moves and has no inertia. What is odd and accepted is noted.
pub(crate) fn judge(document: &Document, tree: &Tree, asked: Asked) -> (Vec<Fault>, Vec<Note>) {
    let first = usize::from(!asked.floating);
    let moving = || tree.groups.iter().enumerate().skip(first);
    let odd = |group: &Group| group.inertia.as_ref().and_then(oddity);
    let mut collector = Collector::default();
    if !moving().any(|(_, group)| odd(group).is_some()) {
        return (Vec::new(), Vec::new());
    }
    let fixed = without_inertia(document, tree, asked.floating);
    for (place, group) in moving() {
        let link = &document.links[group.links[0]];
        let found = odd(group).zip(group.inertia.as_ref());
        let mut refuse = |message: String| {
            let message = format!("link \"{}\": {message}", link.name);
            collector.at(link.line, message);
        };
        let by = by(document, group);
        match found {
            Some((Oddity::Nothing, _)) if fixed.contains(&place) => refuse(format!(
                "{by}, and there is no mass; a positive mass and inertia are accepted, or a `fixed` joint"
            )),
            _ if fixed.contains(&place) && (asked.as_given || found.is_none()) => refuse(format!(
                "{by}, and neither it nor what it carries has an inertia that resists; a positive mass and \
                 inertia are accepted, or a `fixed` joint"
            )),
            None => {}
            Some((Oddity::Nothing, _)) => {
                let message = format!(
                    "link \"{}\": it has no mass, and moves by its joints",
                    link.name
                );
                collector.note(link.line, message);
            }
            Some((oddity, inertia)) if asked.as_given => {
                let message = format!(
                    "link \"{}\": {}; they are taken as given",
                    link.name,
                    found_in(inertia, oddity)
                );
                collector.note(link.line, message);
            }
            Some((oddity, inertia)) => {
                let accepted = match oddity {
                    Oddity::Excess => ": a moment up to the sum of the two others is accepted",
                    _ => "; positive ones are accepted",
                };
                let instead = if fixed.is_empty() {
                    "; to take it as given, say `--accept-inertia` or `#[urdf(inertia = \"as given\")]`"
                } else {
                    ""
                };
                refuse(format!(
                    "{by}, and {}{accepted}{instead}",
                    found_in(inertia, oddity)
                ));
            }
        }
    }
    collector.into_parts()
}

/// What moves a group, and what moves with it.
fn by(document: &Document, group: &Group) -> String {
    let by = match group.joint {
        Some(joint) => format!("joint \"{}\" moves it", document.joints[joint].name),
        None => "it is the root and floats".into(),
    };
    match group.links.len() {
        1 => by,
        2 => format!("{by} with link \"{}\"", document.links[group.links[1]].name),
        all => format!("{by} with {} links that are fixed to it", all - 1),
    }
}

fn found_in(inertia: &Inertia, oddity: Oddity) -> String {
    let moments = inertia.moments().map(brief).join(", ");
    let whose = match oddity {
        Oddity::Mass => "without a mass its",
        _ => "its",
    };
    let no_body = match oddity {
        Oddity::Excess => "; no body has these",
        _ => "",
    };
    format!("{whose} principal moments of inertia are {moments} kg m^2{no_body}")
}

/// Four digits of a number.
fn brief(x: f64) -> String {
    let rounded: f64 = format!("{x:.3e}").parse().unwrap_or(x);
    if rounded == 0.0 || (1e-3..1e6).contains(&rounded.abs()) {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}

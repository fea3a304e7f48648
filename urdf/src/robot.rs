//! A robot as its file gives it, checked.

use crate::describe;
use crate::document::{self, Document, Joint};
use crate::elements::Lines;
use crate::faults::{Collector, Faults, Note, advice};
use crate::mechanism::{Mechanism, Options};
use crate::tree::{self, Group, Tree};

/// A robot, read from a URDF file.
#[derive(Debug)]
pub struct Robot {
    pub(crate) document: Document,
    pub(crate) tree: Tree,
    pub(crate) notes: Vec<Note>,
}

impl Robot {
    /// Reads the text of a URDF file.
    ///
    /// # Errors
    ///
    /// Every fault of the file with its line. The text is no URDF. The links form no tree. A link
    /// that moves could be no rigid body.
    pub fn parse(text: &str) -> Result<Self, Faults> {
        Self::read(text, false)
    }

    /// Like [`Robot::parse`], but every angle of an `rpy` that is within 1e-5 rad of a quarter turn
    /// is taken as exactly that.
    ///
    /// Files often give 1.5708 for a right angle. The rest is no property of the robot, but it
    /// fills numbers that would be zero, and generated code grows with them.
    ///
    /// # Errors
    ///
    /// Those of [`Robot::parse`].
    pub fn parse_rounded(text: &str) -> Result<Self, Faults> {
        Self::read(text, true)
    }

    fn read(text: &str, quarter_turns: bool) -> Result<Self, Faults> {
        let mut faults = Collector::default();
        let read = read(text, quarter_turns, &mut faults);
        let notes = faults.finish()?;
        let (document, tree) = read.expect("without a fault there is a tree");
        Ok(Self {
            document,
            tree,
            notes,
        })
    }

    /// What is no fault, and yet worth knowing: elements of other tools that were skipped, and
    /// products of inertia that were left out.
    #[must_use]
    pub fn notes(&self) -> &[Note] {
        &self.notes
    }

    /// The mechanism that the robot is, with all joints at zero in the reference configuration.
    ///
    /// # Errors
    ///
    /// The root link, if it shall float and cannot.
    pub fn mechanism(&self, options: &Options) -> Result<Mechanism, Faults> {
        let mut faults = Collector::default();
        if options.floating {
            let root = &self.tree.groups[0];
            let link = &self.document.links[root.links[0]];
            if link.name == "world" {
                let message = "link \"world\": the root has the name of the ground and cannot float; \
                               make its joint `floating`, or rename it";
                faults.at(link.line, message);
            } else {
                could_move(&self.document, root, &mut faults);
            }
        }
        if !options.floating && self.tree.groups.len() == 1 {
            let root = &self.document.links[self.tree.groups[0].links[0]];
            let message = format!(
                "link \"{}\": it is the ground, and no joint moves a link; one at least is needed, or \
                 a root that floats",
                root.name
            );
            faults.at(root.line, message);
        }
        faults.finish()?;
        Ok(describe::mechanism(self, options))
    }
}

fn read(text: &str, quarter_turns: bool, faults: &mut Collector) -> Option<(Document, Tree)> {
    let text = &as_readers_take_it(text);
    let xml = match roxmltree::Document::parse(text) {
        Ok(xml) => xml,
        Err(error) => {
            faults.at(error.pos().row as usize, format!("no XML: {error}"));
            return None;
        }
    };
    let root = xml.root_element();
    let lines = Lines::of(text);
    if root.tag_name().name() != "robot" {
        let message = format!(
            "<{}>: the outermost element of a URDF is <robot>",
            root.tag_name().name()
        );
        faults.at(lines.of_node(root), message);
        return None;
    }
    let document = document::read(root, &lines, quarter_turns, faults);
    mimics(&document, faults);
    let tree = tree::grow(&document, faults)?;
    for group in &tree.groups[1..] {
        could_move(&document, group, faults);
    }
    Some((document, tree))
}

/// So many prefixes of a file may lack their namespace.
const PREFIXES: usize = 32;

/// The text as other readers of URDF take it, which do not keep to the letter of XML. A declaration
/// that does not stand first is left out. A prefix without a namespace gets one. Lines stay.
fn as_readers_take_it(text: &str) -> String {
    let mut text = text.to_owned();
    if let Some(start) = text.find("<?xml ").filter(|start| *start > 0)
        && let Some(length) = text[start..].find("?>")
    {
        let range = start..start + length + 2;
        let blank = text[range.clone()].replace(|c| c != '\n', " ");
        text.replace_range(range, &blank);
    }
    for _ in 0..PREFIXES {
        let Err(roxmltree::Error::UnknownNamespace(prefix, _)) = roxmltree::Document::parse(&text)
        else {
            break;
        };
        let Some(start) = text.find("<robot") else {
            break;
        };
        let declared = format!(" xmlns:{prefix}=\"prefix:{prefix}\"");
        text.insert_str(start + "<robot".len(), &declared);
    }
    text
}

/// Refuses what mimics a joint that has no position, or itself.
fn mimics(document: &Document, faults: &mut Collector) {
    let find = |name: &str| document.joints.iter().find(|joint| joint.name == name);
    let is_single = |joint: &Joint| joint.kind.is_none_or(|kind| kind.is_single());
    for joint in &document.joints {
        let Some(mimic) = &joint.mimic else { continue };
        let mut refuse = |message: String| {
            faults.at(mimic.line, format!("joint \"{}\": {message}", joint.name));
        };
        if !is_single(joint) {
            refuse(
                "it mimics another one; only a revolute, continuous or prismatic joint can".into(),
            );
        }
        let Some(leader) = find(&mimic.joint) else {
            let names = document.joints.iter().map(|joint| &*joint.name);
            let advice = advice(&mimic.joint, names);
            refuse(format!(
                "it mimics \"{}\", which is no joint; {advice}",
                mimic.joint
            ));
            continue;
        };
        if !is_single(leader) {
            refuse(format!(
                "it mimics \"{}\", which has no position; a revolute, continuous or prismatic joint has",
                mimic.joint
            ));
        }
        let next = |joint: &&Joint| find(&joint.mimic.as_ref()?.joint);
        let chain = std::iter::successors(Some(leader), next).take(document.joints.len());
        if chain.into_iter().any(|other| other.name == joint.name) {
            refuse(format!(
                "it mimics \"{}\", which follows it in turn",
                mimic.joint
            ));
        }
    }
}

/// How far one moment may exceed the sum of the others, as a part of it; the macro's own limit.
const EXCESS: f64 = 1e-9;

/// Refuses what moves and is no rigid body.
fn could_move(document: &Document, group: &Group, faults: &mut Collector) {
    let Some(inertia) = group.inertia else { return };
    let link = &document.links[group.links[0]];
    let by = match group.joint {
        Some(joint) => format!("joint \"{}\" moves it", document.joints[joint].name),
        None => "it is the root and floats".into(),
    };
    let with = match group.links.len() {
        1 => String::new(),
        2 => format!(" with link \"{}\"", document.links[group.links[1]].name),
        all => format!(" with {} links that are fixed to it", all - 1),
    };
    let moments = inertia.moments();
    let [least, middle, largest] = moments;
    let found = moments.map(brief).join(", ");
    let message = if inertia.mass <= 0.0 {
        format!(
            "{by}{with}, and there is no mass; a positive mass and inertia are accepted, or a \
             `fixed` joint"
        )
    } else if least <= 0.0 {
        format!(
            "{by}{with}, and its principal moments of inertia are {found} kg m^2; positive ones are \
             accepted"
        )
    } else if largest > (least + middle) * (1.0 + EXCESS) {
        format!(
            "{by}{with}, and its principal moments of inertia are {found} kg m^2; no body has these: \
             a moment up to the sum of the two others is accepted"
        )
    } else {
        return;
    };
    faults.at(link.line, format!("link \"{}\": {message}", link.name));
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

//! A robot as its file gives it, checked.

use crate::describe;
use crate::document::{self, Document};
use crate::elements::Lines;
use crate::faults::{Collector, Faults, Note};
use crate::inertias::{self, Asked};
use crate::mechanism::{Mechanism, Options};
use crate::mimics;
use crate::tree::{self, Tree};

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
    /// Every fault of the file with its line. The text is no URDF. The links form no tree. Beside
    /// these, links that move and could be no rigid bodies; alone they are refused by
    /// [`Robot::mechanism`].
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
        if let (false, Some((document, tree))) = (faults.is_clear(), &read) {
            // All that is wrong is said at once.
            let asked = Asked {
                floating: false,
                as_given: false,
            };
            let (found, _) = inertias::judge(document, tree, asked);
            faults.extend(found, Vec::new());
        }
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
    /// The root link, if it shall float and cannot. A link that moves and could be no rigid body,
    /// unless [`Options::accept_inertia`] says so; a joint that moves no inertia.
    pub fn mechanism(&self, options: &Options) -> Result<Mechanism, Faults> {
        let mut faults = Collector::default();
        if options.floating {
            let root = &self.tree.groups[0];
            let link = &self.document.links[root.links[0]];
            if link.name == "world" {
                let message = "link \"world\": the root has the name of the ground and cannot float; \
                               make its joint `floating`, or rename it";
                faults.at(link.line, message);
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
        if faults.is_clear() {
            let asked = Asked {
                floating: options.floating,
                as_given: options.accept_inertia,
            };
            let (found, notes) = inertias::judge(&self.document, &self.tree, asked);
            faults.extend(found, notes);
        }
        let notes = faults.finish()?;
        let mut mechanism = describe::mechanism(self, options);
        mechanism.notes.extend(notes);
        Ok(mechanism)
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
    let mut document = document::read(root, &lines, quarter_turns, faults);
    mimics::judge(&mut document, faults);
    let tree = tree::grow(&document, faults)?;
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

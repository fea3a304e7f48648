//! Elements and attributes of the file, with their lines.

use nalgebra::Vector3;
use roxmltree::Node;

use crate::faults::{Collector, is_like};
use crate::spatial::{Frame, rotation};

/// Where lines begin, so that a place is found without a walk through the file.
#[derive(Debug)]
pub(crate) struct Lines(Vec<usize>);

impl Lines {
    pub(crate) fn of(text: &str) -> Self {
        let ends = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        Self(ends.map(|(place, _)| place).collect())
    }

    /// The line of an element's tag, from 1.
    pub(crate) fn of_node(&self, node: Node<'_, '_>) -> usize {
        let start = node.range().start;
        self.0.partition_point(|end| *end < start) + 1
    }
}

/// An element that is read, and its name for messages: `joint "elbow"`.
pub(crate) struct Reader<'a> {
    pub(crate) lines: &'a Lines,
    pub(crate) faults: &'a mut Collector,
    pub(crate) owner: String,
    /// Angles near a quarter turn are taken as one.
    pub(crate) quarter_turns: bool,
}

impl Reader<'_> {
    pub(crate) fn at(&mut self, node: Node<'_, '_>, message: &str) {
        let message = format!("{}: {message}", self.owner);
        self.faults.at(self.lines.of_node(node), message);
    }

    /// Notes what is no fault.
    pub(crate) fn say(&mut self, node: Node<'_, '_>, message: &str) {
        let message = format!("{}: {message}", self.owner);
        self.faults.note(self.lines.of_node(node), message);
    }

    /// The only child element of a name, if it is there.
    pub(crate) fn child<'n, 'i>(&mut self, node: Node<'n, 'i>, tag: &str) -> Option<Node<'n, 'i>> {
        let mut all = node.children().filter(|child| is(*child, tag));
        let first = all.next();
        if let Some((first, second)) = first.zip(all.next()) {
            if says_the_same(first, second) {
                self.say(
                    second,
                    &format!("a second <{tag}> says the same, and is skipped"),
                );
            } else {
                self.at(second, &format!("a second <{tag}>; one is accepted"));
            }
        }
        first
    }

    /// An attribute that must be there.
    pub(crate) fn text<'n>(&mut self, node: Node<'n, '_>, name: &str) -> Option<&'n str> {
        let text = node.attribute(name).map(str::trim);
        let text = text.filter(|text| !text.is_empty());
        if text.is_none() {
            let tag = node.tag_name().name();
            self.at(node, &format!("<{tag}> has no attribute `{name}`"));
        }
        text
    }

    /// A number that may be left out. A fault gives nothing.
    pub(crate) fn number_or(
        &mut self,
        node: Node<'_, '_>,
        name: &str,
        default: f64,
    ) -> Option<f64> {
        let Some(text) = node.attribute(name) else {
            return Some(default);
        };
        match self.numbers::<1>(node, name, text)? {
            [number] => Some(number),
        }
    }

    /// A number that must be there.
    pub(crate) fn number(&mut self, node: Node<'_, '_>, name: &str) -> Option<f64> {
        self.text(node, name)?;
        self.number_or(node, name, 0.0)
    }

    /// A number that is not negative. What is left out is zero.
    pub(crate) fn size(&mut self, node: Node<'_, '_>, name: &str) -> Option<f64> {
        let number = self.number_or(node, name, 0.0)?;
        if number < 0.0 {
            let message = format!("`{name}` is {number}; zero or a positive number is accepted");
            self.at(node, &message);
            return None;
        }
        Some(number)
    }

    /// Three numbers that may be left out.
    pub(crate) fn vector_or(
        &mut self,
        node: Node<'_, '_>,
        name: &str,
        default: [f64; 3],
    ) -> Option<Vector3<f64>> {
        match node.attribute(name) {
            Some(text) => self.numbers(node, name, text).map(Vector3::from),
            None => Some(default.into()),
        }
    }

    fn numbers<const N: usize>(
        &mut self,
        node: Node<'_, '_>,
        name: &str,
        text: &str,
    ) -> Option<[f64; N]> {
        let read = |word: &str| word.parse().ok().filter(|x: &f64| x.is_finite());
        let numbers: Option<Vec<f64>> = text.split_whitespace().map(read).collect();
        let numbers = numbers.and_then(|numbers| numbers.try_into().ok());
        if numbers.is_none() {
            let expected = match N {
                1 => "a number is accepted".into(),
                _ => format!("{N} numbers with spaces between them are accepted"),
            };
            self.at(node, &format!("`{name}` is \"{text}\"; {expected}"));
        }
        numbers
    }

    /// The frame that `<origin>` gives; the identity where it is left out.
    pub(crate) fn origin(&mut self, node: Node<'_, '_>) -> Option<Frame> {
        let Some(origin) = self.child(node, "origin") else {
            return Some(Frame::IDENTITY);
        };
        let place = self.vector_or(origin, "xyz", [0.0; 3]);
        let angles = self.vector_or(origin, "rpy", [0.0; 3]);
        Some(Frame {
            origin: place?,
            rotation: rotation(angles?, self.quarter_turns),
        })
    }

    /// Refuses child elements that are neither read nor known to change no motion.
    pub(crate) fn refuse_others(&mut self, node: Node<'_, '_>, read: &[&str]) {
        for child in others(node, read) {
            let message = format!(
                "<{}> is not read here; <{}> are",
                child.tag_name().name(),
                read.join(">, <")
            );
            self.at(child, &message);
        }
    }

    /// Skips child elements that are not read: other tools have theirs, and none of these changes a
    /// motion here. They are noted, but those that are `known` to all. What may be a misspelt word
    /// is refused, and so is what would change the motion.
    pub(crate) fn skip_others(&mut self, node: Node<'_, '_>, read: &[&str], known: &[&str]) {
        for child in others(node, read) {
            let (name, space) = (child.tag_name().name(), child.tag_name().namespace());
            let is_own = !is_foreign(child);
            if is_own && known.contains(&name) {
                continue;
            }
            let mut words = read.iter().chain(known);
            let meant = words.find(|word| is_own && is_like(name, word));
            if space.is_some_and(|space| space.contains("xacro")) {
                let message = format!("<xacro:{name}> is no URDF; run `xacro` on the file first");
                self.at(child, &message);
            } else if CLOSING.contains(&name) {
                let message = format!(
                    "<{name}> closes a loop and is not read; close it in the struct, by a joint"
                );
                self.at(child, &message);
            } else if let Some(word) = meant {
                let message = format!("<{name}> is not read here; did you mean <{word}>?");
                self.at(child, &message);
            } else {
                let line = self.lines.of_node(child);
                let message = format!("<{name}> is no element of URDF and is skipped");
                self.faults.note(line, message);
            }
        }
    }
}

/// Whether two elements have the same attributes, and nothing else.
fn says_the_same(one: Node<'_, '_>, other: Node<'_, '_>) -> bool {
    let attributes = |node: Node<'_, '_>| {
        let all = node.attributes();
        let mut all: Vec<(String, String)> = all
            .map(|one| (one.name().to_owned(), one.value().trim().to_owned()))
            .collect();
        all.sort();
        all
    };
    let is_plain = |node: Node<'_, '_>| !node.children().any(|child| child.is_element());
    is_plain(one) && is_plain(other) && attributes(one) == attributes(other)
}

/// Elements of other tools without which the mechanism is another one.
const CLOSING: &[&str] = &["loop_joint"];

/// Whether an element has a name of URDF.
pub(crate) fn is(node: Node<'_, '_>, tag: &str) -> bool {
    node.has_tag_name(tag) && !is_foreign(node)
}

/// Whether an element has a prefix, so that it is another tool's whatever its name is.
fn is_foreign(node: Node<'_, '_>) -> bool {
    let robot = node.document().root_element();
    node.tag_name().namespace() != robot.tag_name().namespace()
}

/// Child elements that are none of some.
fn others<'n, 'i>(node: Node<'n, 'i>, read: &[&str]) -> impl Iterator<Item = Node<'n, 'i>> {
    let elements = node.children().filter(Node::is_element);
    elements.filter(|child| !read.iter().any(|tag| is(*child, tag)))
}

//! A unit that was written, and read again.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use holonom::Mechanism;
use holonom::mechanism::TracedCoordinates;
use holonom_fmu::{Fmu, Written};
use roxmltree::{Document, Node};

/// A file of a test.
pub(crate) fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(name)
}

/// A unit by its files.
pub(crate) struct Unit {
    pub(crate) written: Written,
    pub(crate) files: BTreeMap<String, Vec<u8>>,
}

impl Unit {
    /// Writes a unit to a file of this name, and reads it.
    pub(crate) fn of<M: Mechanism, C: TracedCoordinates<M>>(unit: Fmu<M, C>, name: &str) -> Self {
        let path = path(name);
        let written = unit.write(&path).expect("written");
        let file = File::open(&path).expect("it is there");
        let mut archive = zip::ZipArchive::new(file).expect("an archive");
        let mut files = BTreeMap::new();
        for place in 0..archive.len() {
            let mut file = archive.by_index(place).expect("a file");
            let mut bytes = Vec::new();
            file.read_to_end(&mut bytes).expect("readable");
            let path = file.name().expect("a text").into_owned();
            files.insert(path, bytes);
        }
        Self { written, files }
    }

    pub(crate) fn text(&self, file: &str) -> &str {
        let bytes = self.files.get(file).map_or(&[][..], Vec::as_slice);
        std::str::from_utf8(bytes).expect("a text")
    }

    pub(crate) fn description(&self) -> Document<'_> {
        Document::parse(self.text("modelDescription.xml")).expect("a document")
    }
}

/// All elements of a name.
pub(crate) fn elements<'a>(document: &'a Document<'_>, name: &str) -> Vec<Node<'a, 'a>> {
    let nodes = document.descendants();
    nodes.filter(|node| node.has_tag_name(name)).collect()
}

/// Attributes of an element, as they are written.
pub(crate) fn attributes(node: Node<'_, '_>) -> String {
    let attributes = node.attributes();
    let texts = attributes.map(|attribute| format!("{}={:?}", attribute.name(), attribute.value()));
    texts.collect::<Vec<_>>().join(" ")
}

/// The variable of a name.
pub(crate) fn variable<'a>(document: &'a Document<'_>, name: &str) -> Node<'a, 'a> {
    let variables = elements(document, "Float64");
    let mut variables = variables.into_iter();
    let found = variables.find(|variable| variable.attribute("name") == Some(name));
    found.unwrap_or_else(|| panic!("there is no variable `{name}`"))
}

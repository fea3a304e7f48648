//! The results of a study as a document, before anybody decides how it looks: the page and the
//! terminal show the same.

use crate::chart::Chart;

/// A whole study.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// What was studied.
    pub title: String,
    /// What the reader should know first.
    pub lead: Vec<String>,
    /// The parts in order.
    pub sections: Vec<Section>,
    /// Under which conditions it was done.
    pub colophon: Vec<String>,
}

/// A part of a document.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Its heading.
    pub heading: String,
    /// What it says and shows, in order.
    pub blocks: Vec<Block>,
}

/// A piece of a section.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// A paragraph.
    Text(String),
    /// A table.
    Table(Table),
    /// A picture.
    Figure(Figure),
}

/// A table. The first column names the row; the others are numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// What it shows, with its number if it has one.
    pub caption: String,
    /// The heads of the columns, with units.
    pub columns: Vec<String>,
    /// The rows, each as long as `columns`.
    pub rows: Vec<Vec<String>>,
    /// What the reader must know to read it right; may be empty.
    pub note: String,
}

/// A picture with its caption.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// A short name without spaces: the name of its file.
    pub name: String,
    /// What to draw.
    pub chart: Chart,
    /// What the reader should see.
    pub caption: String,
    /// Whether the terminal draws it too.
    pub headline: bool,
}

impl Document {
    /// All figures in order.
    pub fn figures(&self) -> impl Iterator<Item = &Figure> {
        self.sections
            .iter()
            .flat_map(|section| &section.blocks)
            .filter_map(|block| match block {
                Block::Figure(figure) => Some(figure),
                _ => None,
            })
    }
}

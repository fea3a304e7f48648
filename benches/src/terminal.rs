//! A document as text for a terminal.

use comfy_table::{
    Cell, CellAlignment, ColumnConstraint, ContentArrangement, LineStyle, Table as Grid, TableStyle,
};
use console::Term;
use holonom_study::StudyError;
use holonom_study::document::{Block, Document, Figure, Table};

/// Lines above, below the head and below.
const STYLE: TableStyle = {
    let line = LineStyle::none().fill('─').junction('─');
    TableStyle::new()
        .top_border(line)
        .header_separator(line)
        .bottom_border(line)
};

/// Height of a chart (lines).
const HEIGHT: usize = 20;

/// The width of the terminal (letters) within what tables can be read at; 100 where there is none.
#[must_use]
pub fn width() -> usize {
    let size = Term::stdout().size_checked();
    size.map_or(100, |(_, width)| usize::from(width).clamp(72, 120))
}

/// The document as text, `width` letters wide. Of the figures only the headline is drawn.
///
/// # Errors
/// [`StudyError::Picture`] where a figure has nothing to draw.
pub fn text(document: &Document, width: usize) -> Result<String, StudyError> {
    let mut text = format!(
        "{}\n{}\n",
        document.title,
        "=".repeat(document.title.chars().count())
    );
    for section in &document.sections {
        let mut blocks = Vec::new();
        for block in &section.blocks {
            match block {
                Block::Text(paragraph) => blocks.push(wrapped(paragraph, width)),
                Block::Table(content) => blocks.push(table(content, width)),
                Block::Figure(content) if content.headline => blocks.push(figure(content, width)?),
                Block::Figure(_) => {}
            }
        }
        if !blocks.is_empty() {
            let heading = &section.heading;
            let line = "-".repeat(heading.chars().count());
            text.push_str(&format!("\n{heading}\n{line}\n\n{}", blocks.join("\n")));
        }
    }
    text.push('\n');
    for paragraph in &document.colophon {
        text.push_str(&wrapped(paragraph, width));
    }
    Ok(text)
}

fn figure(figure: &Figure, width: usize) -> Result<String, StudyError> {
    // Room for the labels of the ordinate.
    let chart = figure.chart.text(width.saturating_sub(9), HEIGHT)?;
    Ok(format!("{chart}{}", wrapped(&figure.caption, width)))
}

fn table(table: &Table, width: usize) -> String {
    let mut grid = Grid::new();
    grid.load_style(STYLE)
        .set_content_arrangement(ContentArrangement::Dynamic)
        .set_width(u16::try_from(width).unwrap_or(u16::MAX))
        .set_header(cells(&table.columns));
    for row in &table.rows {
        grid.add_row(cells(row));
    }
    // The names of the rows stay whole.
    if let Some(names) = grid.column_mut(0) {
        names.set_constraint(ColumnConstraint::ContentWidth);
    }
    let note = if table.note.is_empty() {
        String::new()
    } else {
        wrapped(&table.note, width)
    };
    format!("{}\n{grid}\n{note}", table.caption)
}

/// The first cell to the left, the numbers to the right.
fn cells(texts: &[String]) -> Vec<Cell> {
    let cell = |(place, text): (usize, &String)| {
        let side = if place == 0 {
            CellAlignment::Left
        } else {
            CellAlignment::Right
        };
        Cell::new(text).set_alignment(side)
    };
    texts.iter().enumerate().map(cell).collect()
}

/// A paragraph in lines of at most `width` letters, where its words allow that.
fn wrapped(paragraph: &str, width: usize) -> String {
    let mut lines = String::new();
    let mut length = 0;
    for word in paragraph.split_whitespace() {
        let letters = word.chars().count();
        if length > 0 && length + 1 + letters > width {
            lines.push('\n');
            length = 0;
        } else if length > 0 {
            lines.push(' ');
            length += 1;
        }
        lines.push_str(word);
        length += letters;
    }
    lines.push('\n');
    lines
}

#[cfg(test)]
mod tests {
    use super::{text, wrapped};
    use holonom_study::chart::{Axis, Chart, Mark, Series};
    use holonom_study::document::{Block, Document, Figure, Section, Table};

    #[test]
    fn paragraphs_are_wrapped_at_words() {
        assert_eq!(wrapped("one two  three", 7), "one two\nthree\n");
        assert_eq!(wrapped("immeasurable", 3), "immeasurable\n");
    }

    #[test]
    fn tables_and_the_headline_are_shown() {
        let figure = |title: &str, headline| {
            let points = vec![(0.0, 1.0), (1.0, 2.0)];
            let series = vec![Series {
                name: "curve".into(),
                slot: 0,
                mark: Mark::Line,
                points,
            }];
            let (x, y) = (Axis::linear("time", "s"), Axis::linear("length", "m"));
            let chart = Chart {
                title: title.into(),
                x,
                y,
                series,
            };
            Block::Figure(Figure {
                name: title.into(),
                chart,
                caption: "Seen.".into(),
                headline,
            })
        };
        let table = Table {
            caption: "Table 1".into(),
            columns: vec!["what".into(), "value".into()],
            rows: vec![vec!["mass".into(), "7.02".into()]],
            note: "Weighed.".into(),
        };
        let blocks = vec![
            Block::Table(table),
            figure("Shown", true),
            figure("Hidden", false),
        ];
        let document = Document {
            title: "Study".into(),
            lead: vec![],
            sections: vec![
                Section {
                    heading: "Part".into(),
                    blocks,
                },
                Section {
                    heading: "Pictures only".into(),
                    blocks: vec![figure("Hidden", false)],
                },
            ],
            colophon: vec!["Done.".into()],
        };
        let text = text(&document, 60).unwrap();
        for part in [
            "Study\n=====",
            "Part\n----",
            "7.02",
            "Weighed.",
            "Shown: length (m)",
            "Done.",
        ] {
            assert!(text.contains(part), "{part} is missing in\n{text}");
        }
        assert!(!text.contains("Hidden") && !text.contains("Pictures only"));
        assert!(
            text.lines().all(|line| line.chars().count() <= 60),
            "{text}"
        );
    }
}

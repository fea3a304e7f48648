//! A document as a page of HTML that needs nothing but a browser: no network, no scripts, light and dark.

use std::path::{Path, PathBuf};

use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::chart::Picture;
use crate::document::{Block, Document, Figure, Section, Table};
use crate::error::StudyError;
use crate::files::write_atomically;

/// The style sheet of the page; the pictures bring their own.
const STYLE: &str = include_str!("page.css");

/// The page as HTML.
///
/// # Errors
/// [`StudyError::Picture`] where a figure has nothing to draw.
pub fn html_page(document: &Document) -> Result<String, StudyError> {
    let sections = document
        .sections
        .iter()
        .map(section)
        .collect::<Result<Vec<Markup>, StudyError>>()?;
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                title { (document.title) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                header {
                    h1 { (document.title) }
                    @for paragraph in &document.lead { p { (paragraph) } }
                }
                main { @for section in sections { (section) } }
                footer { @for paragraph in &document.colophon { p { (paragraph) } } }
            }
        }
    };
    Ok(page.into_string())
}

/// Writes `index.html` and one SVG file per figure into a directory; the paths of what was written, the page first.
///
/// # Errors
/// [`StudyError::Picture`] where a figure has nothing to draw, [`StudyError::Write`] where a file cannot be written.
pub fn write_page(document: &Document, directory: &Path) -> Result<Vec<PathBuf>, StudyError> {
    let index = directory.join("index.html");
    write_atomically(&index, html_page(document)?.as_bytes())?;
    let mut written = vec![index];
    for figure in document.figures() {
        let path = directory.join(format!("{}.svg", figure.name));
        write_atomically(&path, figure.chart.draw()?.svg.as_bytes())?;
        written.push(path);
    }
    Ok(written)
}

fn section(section: &Section) -> Result<Markup, StudyError> {
    let blocks = section
        .blocks
        .iter()
        .map(|block| match block {
            Block::Text(paragraph) => Ok(html! { p { (paragraph) } }),
            Block::Table(content) => Ok(table(content)),
            Block::Figure(content) => Ok(figure(content, &content.chart.draw()?)),
        })
        .collect::<Result<Vec<_>, StudyError>>()?;
    Ok(html! {
        section {
            h2 { (section.heading) }
            @for block in blocks { (block) }
        }
    })
}

fn table(table: &Table) -> Markup {
    html! {
        div.table {
            table {
                caption { (table.caption) }
                thead { tr { @for column in &table.columns { th scope="col" { (column) } } } }
                tbody {
                    @for row in &table.rows {
                        tr {
                            @for (place, cell) in row.iter().enumerate() {
                                @if place == 0 { th scope="row" { (cell) } } @else { td { (cell) } }
                            }
                        }
                    }
                }
            }
        }
        @if !table.note.is_empty() { p.note { (table.note) } }
    }
}

fn figure(figure: &Figure, picture: &Picture) -> Markup {
    html! {
        figure id=(figure.name) {
            h3 { (picture.title) }
            div.picture { (PreEscaped(&picture.svg)) }
            figcaption {
                (figure.caption)
                @if let Some(sentence) = picture.left_out.sentence() { " " (sentence) }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{html_page, write_page};
    use crate::chart::{Axis, Chart, Mark, Series};
    use crate::document::{Block, Document, Figure, Section, Table};

    fn document(values: &[f64]) -> Document {
        let points = values
            .iter()
            .enumerate()
            .map(|(k, &v)| (k as f64, v))
            .collect();
        let series = vec![Series {
            name: "curve".into(),
            slot: 0,
            mark: Mark::Line,
            points,
        }];
        let (x, y) = (Axis::linear("time", "s"), Axis::logarithmic("error", "rad"));
        Document {
            title: "A <study>".into(),
            lead: vec!["First & foremost.".into()],
            sections: vec![Section {
                heading: "Part".into(),
                blocks: vec![
                    Block::Table(Table {
                        caption: "Table 1".into(),
                        columns: vec!["what".into(), "value (kg)".into()],
                        rows: vec![vec!["mass".into(), "7.02".into()]],
                        note: "Weighed.".into(),
                    }),
                    Block::Figure(Figure {
                        name: "error".into(),
                        chart: Chart {
                            title: "The error".into(),
                            x,
                            y,
                            series,
                        },
                        caption: "It grows.".into(),
                        headline: true,
                    }),
                ],
            }],
            colophon: vec!["Done.".into()],
        }
    }

    #[test]
    fn the_page_holds_everything_and_needs_nothing() {
        let page = html_page(&document(&[0.0, 1.0, 2.0])).unwrap();
        for part in [
            "A &lt;study&gt;",
            "First &amp; foremost.",
            "value (kg)",
            "<td>7.02</td>",
            "<svg",
            "It grows. Left out: 1 value is zero",
            "Done.",
        ] {
            assert!(page.contains(part), "{part} is missing");
        }
        for foreign in ["<script", "<link", "url(", "src=", "@import"] {
            assert!(
                !page.contains(foreign),
                "{foreign} asks for more than the page"
            );
        }
        assert_eq!(
            page.matches("http").count(),
            page.matches("http://www.w3.org/2000/svg").count()
        );
    }

    #[test]
    fn page_and_pictures_are_written() {
        let directory = std::env::temp_dir().join(format!("holonom-page-{}", std::process::id()));
        let written = write_page(&document(&[1.0, 2.0]), &directory).unwrap();
        let names: Vec<_> = written
            .iter()
            .map(|p| p.file_name().unwrap().to_owned())
            .collect();
        assert_eq!(names, ["index.html", "error.svg"]);
        assert!(
            std::fs::read_to_string(&written[1])
                .unwrap()
                .starts_with("<svg")
        );
    }

    #[test]
    fn a_figure_without_points_is_an_error() {
        assert!(html_page(&document(&[f64::NAN])).is_err());
    }
}

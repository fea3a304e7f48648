//! A document as a page of HTML that needs nothing but a browser: no network, no scripts, light and
//! dark.

use std::fmt::{self, Write as _};
use std::path::{Path, PathBuf};

use crate::chart::Picture;
use crate::document::{Block, Document, Figure, Section, Table};
use crate::error::StudyError;
use crate::files::write_atomically;

/// The style sheet of the page; the pictures bring their own.
const STYLE: &str = include_str!("page.css");

/// Text between tags or in an attribute: what would be markup is escaped.
struct Text<'a>(&'a str);

impl fmt::Display for Text<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for letter in self.0.chars() {
            match letter {
                '&' => f.write_str("&amp;"),
                '<' => f.write_str("&lt;"),
                '>' => f.write_str("&gt;"),
                '"' => f.write_str("&quot;"),
                other => f.write_char(other),
            }?;
        }
        Ok(())
    }
}

/// Each text between an opening and a closing tag, one behind the other.
fn each<T: AsRef<str>>(opening: &str, texts: impl IntoIterator<Item = T>, closing: &str) -> String {
    let one = |text: T| format!("{opening}{}{closing}", Text(text.as_ref()));
    texts.into_iter().map(one).collect()
}

/// The page as HTML.
///
/// # Errors
/// [`StudyError::Picture`] where a figure has nothing to draw.
pub fn html_page(document: &Document) -> Result<String, StudyError> {
    let sections = document.sections.iter().map(section);
    let sections = sections.collect::<Result<String, StudyError>>()?;
    let title = Text(&document.title);
    let lead = each("<p>", &document.lead, "</p>");
    let colophon = each("<p>", &document.colophon, "</p>");
    Ok(format!(
        r#"<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1"><meta name="color-scheme" content="light dark"><title>{title}</title><style>{STYLE}</style></head><body><header><h1>{title}</h1>{lead}</header><main>{sections}</main><footer>{colophon}</footer></body></html>"#
    ))
}

/// Writes `index.html` and one SVG file per figure into a directory; the paths of what was written,
/// the page first.
///
/// # Errors
/// [`StudyError::Picture`] where a figure has nothing to draw, [`StudyError::Write`] where a file
/// cannot be written.
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

fn section(section: &Section) -> Result<String, StudyError> {
    let block = |block: &Block| match block {
        Block::Text(paragraph) => Ok(each("<p>", [paragraph], "</p>")),
        Block::Table(content) => Ok(table(content)),
        Block::Figure(content) => Ok(figure(content, &content.chart.draw()?)),
    };
    let blocks = section.blocks.iter().map(block);
    let blocks = blocks.collect::<Result<String, StudyError>>()?;
    let heading = Text(&section.heading);
    Ok(format!("<section><h2>{heading}</h2>{blocks}</section>"))
}

fn table(table: &Table) -> String {
    let row = |row: &Vec<String>| {
        let name = each(r#"<th scope="row">"#, row.first(), "</th>");
        let cells = each("<td>", row.iter().skip(1), "</td>");
        format!("<tr>{name}{cells}</tr>")
    };
    let caption = Text(&table.caption);
    let heads = each(r#"<th scope="col">"#, &table.columns, "</th>");
    let rows: String = table.rows.iter().map(row).collect();
    let note = Some(&table.note).filter(|note| !note.is_empty());
    let note = each(r#"<p class="note">"#, note, "</p>");
    format!(
        r#"<div class="table"><table><caption>{caption}</caption><thead><tr>{heads}</tr></thead><tbody>{rows}</tbody></table></div>{note}"#
    )
}

fn figure(figure: &Figure, picture: &Picture) -> String {
    let (name, title) = (Text(&figure.name), Text(&picture.title));
    let mut caption = Text(&figure.caption).to_string();
    if let Some(sentence) = picture.left_out.sentence() {
        caption.push(' ');
        caption.push_str(&Text(&sentence).to_string());
    }
    let svg = &picture.svg;
    format!(
        r#"<figure id="{name}"><h3>{title}</h3><div class="picture">{svg}</div><figcaption>{caption}</figcaption></figure>"#
    )
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

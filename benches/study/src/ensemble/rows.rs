//! Rows as CSV files, and files that are joined.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use csv::{Reader, StringRecord, Writer};

use super::{Row, Rows};
use crate::error::StudyError;
use crate::files::write_atomically;

/// Columns before those of a model: what determines the rows, how many there are, and which one.
const FIRST: [&str; 3] = ["seed", "rows", "row"];
/// Columns behind these: when (s) and why a row stopped, empty where it did not.
const LAST: [&str; 2] = ["stopped", "fault"];

/// Lines of rows under a head.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    head: StringRecord,
    lines: Vec<StringRecord>,
}

impl Table {
    /// The rows that were computed, under the names of what was drawn and read.
    #[must_use]
    pub fn new<const P: usize, const R: usize>(
        of: &Rows,
        (drawn, read): ([&str; P], [&str; R]),
        rows: &[Row<P, R>],
    ) -> Self {
        let names = FIRST.iter().chain(&drawn).chain(&read).chain(&LAST);
        Self {
            head: names.collect(),
            lines: rows.iter().map(|row| line(of, row)).collect(),
        }
    }

    /// The same with rows that are lines already, in their order.
    pub(super) fn of_lines<const P: usize, const R: usize>(
        of: &Rows,
        names: ([&str; P], [&str; R]),
        lines: impl IntoIterator<Item = StringRecord>,
    ) -> Self {
        let mut table = Self::new(of, names, &[]);
        table.lines.extend(lines);
        table
    }

    /// How many rows there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.lines.len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.lines.is_empty()
    }

    /// Writes a file, whole or not at all.
    ///
    /// # Errors
    /// [`StudyError::Write`], [`StudyError::Rows`].
    pub fn write(&self, path: &Path) -> Result<(), StudyError> {
        let mut writer = Writer::from_writer(Vec::new());
        writer.write_record(&self.head).map_err(unread(path))?;
        for line in &self.lines {
            writer.write_record(line).map_err(unread(path))?;
        }
        let contents = writer.into_inner().map_err(unread(path))?;
        write_atomically(path, &contents)
    }

    fn read(path: &Path) -> Result<Self, StudyError> {
        let mut reader = Reader::from_path(path).map_err(unread(path))?;
        let head = reader.headers().map_err(unread(path))?.clone();
        let lines = reader.records().collect::<Result<_, _>>();
        Ok(Self {
            head,
            lines: lines.map_err(unread(path))?,
        })
    }
}

/// The line of a row.
pub(super) fn line<const P: usize, const R: usize>(of: &Rows, row: &Row<P, R>) -> StringRecord {
    let mut line = StringRecord::new();
    for number in [of.seed, of.all, row.number] {
        line.push_field(&number.to_string());
    }
    for number in row.drawn.iter().chain(&row.readings) {
        line.push_field(&number.to_string());
    }
    let (time, fault) = match &row.stopped {
        Some((time, fault)) => (time.to_string(), fault.as_str()),
        None => (String::new(), ""),
    };
    line.push_field(&time);
    line.push_field(fault);
    line
}

fn unread<E: ToString>(path: &Path) -> impl Fn(E) -> StudyError + use<E> {
    let path = path.to_path_buf();
    move |error| StudyError::Rows {
        path: path.clone(),
        reason: error.to_string(),
    }
}

/// Joins the files of all shards, in whatever order they are given.
///
/// # Errors
/// [`StudyError::Rows`] for a file that cannot be read, has other columns, another seed or another
/// number of rows than the first, or a row that another file has; and where a row is missing.
pub fn merge(paths: &[PathBuf]) -> Result<Table, StudyError> {
    let mut known: Option<(StringRecord, [String; 2])> = None;
    let mut rows: BTreeMap<u64, StringRecord> = BTreeMap::new();
    for path in paths {
        let wrong = |reason: String| StudyError::Rows {
            path: path.clone(),
            reason,
        };
        let table = Table::read(path)?;
        for line in table.lines {
            let field = |place: usize| line.get(place).unwrap_or_default().to_owned();
            let these = (table.head.clone(), [field(0), field(1)]);
            if *known.get_or_insert_with(|| these.clone()) != these {
                return Err(wrong(
                    "other columns, seed or number of rows than before".into(),
                ));
            }
            let number = field(2).parse();
            let number = number.map_err(|_| wrong(format!("`{}` is no number", field(2))))?;
            if rows.insert(number, line).is_some() {
                return Err(wrong(format!("row {number} is there twice")));
            }
        }
    }
    let Some((head, [_, all])) = known else {
        return Err(StudyError::Rows {
            path: paths.first().cloned().unwrap_or_default(),
            reason: "there are none".into(),
        });
    };
    let mut expected = 0..all.parse::<u64>().unwrap_or(0);
    if let Some(missing) = expected.find(|number| !rows.contains_key(number)) {
        return Err(StudyError::Rows {
            path: paths.first().cloned().unwrap_or_default(),
            reason: format!("row {missing} of {all} is in none of the files"),
        });
    }
    Ok(Table {
        head,
        lines: rows.into_values().collect(),
    })
}

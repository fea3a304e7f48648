//! What is wrong with a file: every fault with its line.

use std::error::Error;
use std::fmt;

/// One fault: what was found in the file, and what would be accepted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The line of the file, from 1.
    pub line: usize,
    /// A sentence that begins with the element by name: `joint "elbow": ..`.
    pub message: String,
}

/// All faults of a file, in the order of their lines; at least one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Faults(Vec<Fault>);

impl Faults {
    /// The faults, in the order of their lines.
    pub fn iter(&self) -> impl Iterator<Item = &Fault> {
        self.0.iter()
    }

    /// The faults as a compiler prints them, one a line: `arm.urdf:12: joint "elbow": ..`.
    pub fn in_file(&self, name: &str) -> impl fmt::Display {
        fmt::from_fn(move |f| self.write(f, &format_args!("{name}:")))
    }

    fn write(&self, f: &mut fmt::Formatter<'_>, prefix: &dyn fmt::Display) -> fmt::Result {
        for (place, fault) in self.0.iter().enumerate() {
            let end = if place == 0 { "" } else { "\n" };
            write!(f, "{end}{prefix}{}: {}", fault.line, fault.message)?;
        }
        Ok(())
    }
}

impl fmt::Display for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write(f, &"line ")
    }
}

impl Error for Faults {}

/// What is no fault, and yet worth knowing: something of the file was skipped or supplied.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// The line of the file where it is first so, from 1.
    pub line: usize,
    /// How often it is so.
    pub count: usize,
    /// What is so: `<frame> is no element of URDF and is skipped`.
    pub message: String,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)?;
        match self.count {
            1 => Ok(()),
            2 => f.write_str(", twice"),
            count => write!(f, ", {count} times"),
        }
    }
}

/// Faults and notes while they are collected.
#[derive(Debug, Default)]
pub(crate) struct Collector {
    faults: Vec<Fault>,
    notes: Vec<Note>,
}

impl Collector {
    pub(crate) fn at(&mut self, line: usize, message: impl Into<String>) {
        let message = message.into();
        self.faults.push(Fault { line, message });
    }

    /// Notes what is no fault; the same more than once is counted.
    pub(crate) fn note(&mut self, line: usize, message: String) {
        let mut known = self.notes.iter_mut();
        if let Some(note) = known.find(|note| note.message == message) {
            note.count += 1;
            return;
        }
        self.notes.push(Note {
            line,
            count: 1,
            message,
        });
    }

    pub(crate) fn into_parts(self) -> (Vec<Fault>, Vec<Note>) {
        (self.faults, self.notes)
    }

    /// Whether nothing is wrong so far.
    pub(crate) fn is_clear(&self) -> bool {
        self.faults.is_empty()
    }

    pub(crate) fn extend(&mut self, faults: Vec<Fault>, notes: Vec<Note>) {
        self.faults.extend(faults);
        self.notes.extend(notes);
    }

    /// The notes, unless there are faults.
    pub(crate) fn finish(mut self) -> Result<Vec<Note>, Faults> {
        if self.faults.is_empty() {
            return Ok(self.notes);
        }
        self.faults.sort_by_key(|fault| fault.line);
        Err(Faults(self.faults))
    }
}

/// The known name that is nearest to an unknown one, as an advice; else all names, if they are few.
pub(crate) fn advice<'a>(unknown: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.into_iter().collect();
    let nearest = known.iter().min_by_key(|name| distance(unknown, name));
    match nearest {
        Some(name) if is_like(unknown, name) => format!("did you mean \"{name}\"?"),
        Some(_) if known.len() <= 8 => format!("the file has \"{}\"", known.join("\", \"")),
        Some(_) => format!("the file has {} others", known.len()),
        None => "the file has none".into(),
    }
}

/// Whether a word may be another one, misspelt.
pub(crate) fn is_like(word: &str, known: &str) -> bool {
    3 * distance(word, known) <= word.chars().count()
}

/// Insertions, deletions and replacements of characters from one word to the other.
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, y) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(x != *y);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

//! Lines, comments that are wrapped, attributes and numbers.

/// Characters of a line, as `rustfmt` has them.
const COLUMNS: usize = 100;

const INDENT: usize = 4;

#[derive(Debug, Default)]
pub(crate) struct Page(String);

impl Page {
    pub(crate) fn line(&mut self, depth: usize, text: &str) {
        self.0.extend(std::iter::repeat_n(' ', depth * INDENT));
        self.0.push_str(text);
        self.0.push('\n');
    }

    pub(crate) fn blank(&mut self) {
        self.0.push('\n');
    }

    /// A paragraph in lines that all begin with the mark.
    pub(crate) fn comment(&mut self, depth: usize, mark: &str, text: &str) {
        let mut line = mark.to_owned();
        for word in words(text) {
            let width = depth * INDENT + line.chars().count() + 1 + word.chars().count();
            if width > COLUMNS && line.len() > mark.len() {
                self.line(depth, &line);
                line.truncate(mark.len());
            }
            line.push(' ');
            line.push_str(word);
        }
        self.line(depth, &line);
    }

    /// An attribute of a field, in one line if that is short.
    pub(crate) fn attribute(&mut self, name: &str, pairs: &[(&str, String)]) {
        let pairs = pairs.iter().map(|(key, value)| match &**value {
            "" => (*key).to_owned(),
            value => format!("{key} = {value}"),
        });
        let pairs: Vec<String> = pairs.collect();
        let line = format!("#[{name}({})]", pairs.join(", "));
        if INDENT + line.len() <= COLUMNS && !line.contains('\n') {
            return self.line(1, &line);
        }
        self.line(1, &format!("#[{name}("));
        for (place, pair) in pairs.iter().enumerate() {
            let end = if place + 1 == pairs.len() { "" } else { "," };
            let pair = pair.replace('\n', &format!("\n{}", " ".repeat(2 * INDENT)));
            self.line(2, &format!("{pair}{end}"));
        }
        self.line(1, ")]");
    }

    pub(crate) fn finish(self) -> String {
        let mut text = self.0;
        text.truncate(text.trim_end().len());
        text.push('\n');
        text
    }
}

/// Words, with what stands between backquotes as one.
fn words(text: &str) -> impl Iterator<Item = &str> {
    let mut is_quoted = false;
    let parts = text.split(move |c: char| {
        is_quoted ^= c == '`';
        c == ' ' && !is_quoted
    });
    parts.filter(|word| !word.is_empty())
}

/// A name of the file in a comment.
pub(crate) fn name(name: &str) -> String {
    format!(
        "`{}`",
        name.replace('`', "'").replace(char::is_control, " ")
    )
}

/// `a`, `b` and `c`.
pub(crate) fn names<'a>(all: impl IntoIterator<Item = &'a String>) -> String {
    let all: Vec<String> = all.into_iter().map(|one| name(one)).collect();
    match &all[..] {
        [] => String::new(),
        [one] => one.clone(),
        [others @ .., last] => format!("{} and {last}", others.join(", ")),
    }
}

/// A number as Rust writes it, with the digits that it needs.
pub(crate) fn number(x: f64) -> String {
    if x == f64::INFINITY {
        "f64::INFINITY".into()
    } else if x == f64::NEG_INFINITY {
        "f64::NEG_INFINITY".into()
    } else {
        format!("{x:?}")
    }
}

pub(crate) fn vector(all: &[f64]) -> String {
    let all: Vec<String> = all.iter().map(|x| number(*x)).collect();
    format!("[{}]", all.join(", "))
}

/// Three principal moments, or the tensor in three lines.
pub(crate) fn tensor(rows: &[[f64; 3]; 3]) -> String {
    let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = *rows;
    if [xy, xz, yz] == [0.0; 3] {
        return vector(&[xx, yy, zz]);
    }
    let rows = rows.map(|row| format!("    {},\n", vector(&row)));
    format!("[\n{}]", rows.concat())
}

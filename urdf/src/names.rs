//! Names of the file as Rust identifiers.

use std::collections::HashSet;

/// Rust's keywords, and words that the language of attributes gives a meaning.
const TAKEN: &str = "abstract as async await become box break const continue crate do dyn else enum \
    extern false final fn for gen if impl in let loop macro match mod move mut override priv pub ref \
    return self static struct super trait true try type typeof union unsafe unsized use virtual \
    where while yield ground local rotation free time angle rate length travel k sqrt sin cos tan \
    exp deg smooth_step";

/// Names of fields: each is given out once.
#[derive(Debug)]
pub(crate) struct Names(HashSet<String>);

impl Names {
    pub(crate) fn new() -> Self {
        Self(TAKEN.split_whitespace().map(str::to_owned).collect())
    }

    /// A field's name from one of the file. `kind` goes before or behind it where that is needed.
    pub(crate) fn field(&mut self, name: &str, kind: &str) -> String {
        let mut field = snake_case(name);
        if !field.starts_with(|c: char| c.is_ascii_lowercase()) {
            field = format!("{kind}_{field}");
            field.truncate(field.trim_end_matches('_').len());
        }
        if self.0.contains(&field) {
            field = format!("{field}_{kind}");
        }
        self.unique(field)
    }

    /// The name itself, or with the first number that makes it another one.
    pub(crate) fn unique(&mut self, name: String) -> String {
        let numbered = (2..).map(|number| format!("{name}_{number}"));
        let mut all = std::iter::once(name.clone()).chain(numbered);
        let free = all.find(|name| !self.0.contains(name));
        let free = free.unwrap_or(name);
        self.0.insert(free.clone());
        free
    }
}

/// Lower case with underscores: `LFHip-Joint 2` is `lf_hip_joint_2`.
pub(crate) fn snake_case(name: &str) -> String {
    let letters: Vec<char> = name.chars().collect();
    let mut snake = String::new();
    for (place, &letter) in letters.iter().enumerate() {
        let is_ascii = letter.is_ascii_alphanumeric();
        let before = place.checked_sub(1).map(|place| letters[place]);
        let begins = letter.is_ascii_uppercase()
            && before.is_some_and(|before| {
                let next_is_lower = letters.get(place + 1).is_some_and(char::is_ascii_lowercase);
                before.is_ascii_lowercase()
                    || before.is_ascii_digit() && next_is_lower
                    || before.is_ascii_uppercase() && next_is_lower
            });
        if (begins || !is_ascii) && !snake.is_empty() && !snake.ends_with('_') {
            snake.push('_');
        }
        if is_ascii {
            snake.push(letter.to_ascii_lowercase());
        }
    }
    snake.truncate(snake.trim_end_matches('_').len());
    snake
}

/// The name of a type: `my-arm 2` is `MyArm2`. What may be one stays: `UR5e`.
pub(crate) fn type_name(name: &str) -> String {
    let may_be_one = name.starts_with(|c: char| c.is_ascii_uppercase())
        && name.chars().all(|c| c.is_ascii_alphanumeric())
        && name.contains(|c: char| c.is_ascii_lowercase());
    let snake = snake_case(name);
    let mut camel = String::new();
    for word in snake.split('_').filter(|_| !may_be_one) {
        let mut letters = word.chars();
        camel.extend(letters.next().map(|first| first.to_ascii_uppercase()));
        camel.push_str(letters.as_str());
    }
    if may_be_one {
        name.clone_into(&mut camel);
    }
    let is_taken = [
        "Body",
        "Mechanism",
        "Particle",
        "Point",
        "Self",
        "Revolute",
        "Prismatic",
        "Planar",
        "Gear",
    ]
    .contains(&&*camel)
        || camel.ends_with("Actuator")
        || camel.contains("Mimics");
    if is_taken || !camel.starts_with(|c: char| c.is_ascii_uppercase()) {
        camel.insert_str(0, "Robot");
    }
    camel
}

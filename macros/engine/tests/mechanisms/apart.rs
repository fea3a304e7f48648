//! A random mechanism, apart: what can be left out of it, or stand in another order.

use holonom_engine::model::ElementKind;

use crate::text::Text;
use crate::writing::Dice;

/// A field of the struct.
#[derive(Clone)]
pub(crate) struct Field {
    pub(crate) word: &'static str,
    pub(crate) name: String,
    pub(crate) ty: String,
    /// What a run-time value is.
    pub(crate) value: f64,
    /// `key = value`, or a key alone.
    pub(crate) entries: Vec<(String, String)>,
}

/// A mechanism, apart.
#[derive(Clone)]
pub(crate) struct Mechanism {
    pub(crate) attributes: Vec<(String, String)>,
    pub(crate) fields: Vec<Field>,
    pub(crate) definitions: Vec<(String, ElementKind, String)>,
}

fn list(entries: &[(String, String)]) -> String {
    let entries = entries.iter().map(|(key, value)| match value.as_str() {
        "" => key.clone(),
        value => format!("{key} = {value}"),
    });
    entries.collect::<Vec<_>>().join(", ")
}

impl Mechanism {
    pub(crate) fn text(&self) -> Text {
        let fields = self.fields.iter().map(|field| {
            let Field {
                word,
                name,
                ty,
                value,
                entries,
            } = field;
            match *word {
                "param" | "input" => format!("/// {value:?}\n#[{word}]\n{name}: {ty},\n"),
                _ => format!("#[{word}({})]\n{name}: {ty},\n", list(entries)),
            }
        });
        let fields: String = fields.collect();
        let attributes = match &self.attributes[..] {
            [] => String::new(),
            some => format!("#[mechanism({})]\n", list(some)),
        };
        Text {
            item: format!("{attributes}pub struct Random {{\n{fields}}}"),
            definitions: self.definitions.clone(),
        }
    }

    pub(crate) fn redundant(&mut self, wish: Option<&str>) {
        self.attributes.retain(|(key, _)| key != "redundant");
        if let Some(wish) = wish {
            self.attributes
                .push(("redundant".into(), format!("{wish:?}")));
        }
    }

    /// The same with its fields in another order.
    pub(crate) fn shuffled(&self, dice: &mut Dice) -> Self {
        let mut shuffled = self.clone();
        shuffle(&mut shuffled.fields, dice);
        shuffled
    }
}

pub(crate) fn shuffle<T>(items: &mut [T], dice: &mut Dice) {
    for k in (1..items.len()).rev() {
        items.swap(k, dice.below(k + 1));
    }
}

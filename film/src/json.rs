//! JSON as text: what the data of a page needs of it.

use std::fmt::Write as _;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

/// What has a JSON text.
pub(crate) trait Json {
    /// Appends the text.
    fn write(&self, text: &mut String);
}

impl Json for bool {
    fn write(&self, text: &mut String) {
        text.push_str(if *self { "true" } else { "false" });
    }
}

macro_rules! whole {
    ($($number:ty),*) => {$(
        impl Json for $number {
            fn write(&self, text: &mut String) {
                let _ = write!(text, "{self}");
            }
        }
    )*};
}
whole!(usize, u32, i32);

macro_rules! real {
    ($($number:ty),*) => {$(
        impl Json for $number {
            /// In as many digits as give the number back. JSON has no others than finite ones.
            fn write(&self, text: &mut String) {
                if self.is_finite() {
                    let _ = write!(text, "{self:?}");
                } else {
                    text.push_str("null");
                }
            }
        }
    )*};
}
real!(f32, f64);

impl Json for str {
    fn write(&self, text: &mut String) {
        text.push('"');
        for character in self.chars() {
            match character {
                '"' | '\\' => text.extend(['\\', character]),
                // It could end the script that the text is in.
                '<' | '\0'..='\x1f' => {
                    let _ = write!(text, "\\u{:04x}", u32::from(character));
                }
                _ => text.push(character),
            }
        }
        text.push('"');
    }
}

impl Json for String {
    fn write(&self, text: &mut String) {
        self.as_str().write(text);
    }
}

impl<T: Json + ?Sized> Json for &T {
    fn write(&self, text: &mut String) {
        (**self).write(text);
    }
}

impl<T: Json> Json for Option<T> {
    fn write(&self, text: &mut String) {
        match self {
            Some(value) => value.write(text),
            None => text.push_str("null"),
        }
    }
}

impl<T: Json> Json for [T] {
    fn write(&self, text: &mut String) {
        text.push('[');
        for (place, value) in self.iter().enumerate() {
            if place > 0 {
                text.push(',');
            }
            value.write(text);
        }
        text.push(']');
    }
}

impl<T: Json> Json for Vec<T> {
    fn write(&self, text: &mut String) {
        self[..].write(text);
    }
}

impl<T: Json, const N: usize> Json for [T; N] {
    fn write(&self, text: &mut String) {
        self[..].write(text);
    }
}

/// Numbers in single precision, little-endian, in base 64.
pub(crate) struct Floats<'a>(pub(crate) &'a [f32]);

impl Json for Floats<'_> {
    fn write(&self, text: &mut String) {
        let bytes: Vec<u8> = self.0.iter().flat_map(|x| x.to_le_bytes()).collect();
        STANDARD.encode(bytes).write(text);
    }
}

/// Whole numbers of 16 bits, little-endian, in base 64.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shorts(pub(crate) Vec<u16>);

impl Json for Shorts {
    fn write(&self, text: &mut String) {
        let bytes: Vec<u8> = self.0.iter().flat_map(|x| x.to_le_bytes()).collect();
        STANDARD.encode(bytes).write(text);
    }
}

/// The fields of a struct by their keys.
macro_rules! object {
    ($name:ty { $first_key:literal: $first:ident $(, $key:literal: $field:ident)* $(,)? }) => {
        impl $crate::json::Json for $name {
            fn write(&self, text: &mut String) {
                text.push_str(concat!("{\"", $first_key, "\":"));
                self.$first.write(text);
                $(
                    text.push_str(concat!(",\"", $key, "\":"));
                    self.$field.write(text);
                )*
                text.push('}');
            }
        }
    };
}
pub(crate) use object;

#[cfg(test)]
mod tests {
    use super::Json;

    fn text(value: &(impl Json + ?Sized)) -> String {
        let mut text = String::new();
        value.write(&mut text);
        text
    }

    #[test]
    fn any_text_is_read_as_it_was() {
        let odd = "a \"quote\", a \\, a </script>, a tab\t, a line\n, \u{1} and ü 🦀";
        let written = text(odd);
        assert!(!written.contains('<'), "{written}");
        let read: String = serde_json::from_str(&written).expect("JSON");
        assert_eq!(read, odd);
    }

    #[test]
    fn numbers_are_read_as_they_were_and_others_as_nothing() {
        let numbers = [
            0.0,
            -0.1,
            1e300,
            -1e-300,
            f64::MIN_POSITIVE,
            1.0 / 3.0,
            4e15,
            5e16,
        ];
        let read: Vec<f64> = serde_json::from_str(&text(&numbers)).expect("JSON");
        assert_eq!(read, numbers);
        let singles = [0.1_f32, 1e-30, f32::MAX, -7.0];
        let read: Vec<f32> = serde_json::from_str(&text(&singles)).expect("JSON");
        assert_eq!(read, singles);
        assert_eq!(text(&[f64::NAN, f64::INFINITY]), "[null,null]");
        assert_eq!(text(&[Some(3_usize), None]), "[3,null]");
    }
}

//! Units in texts such as `height of the link (m)`.

/// The base units of the standard, as its attributes are called.
const BASE: [&str; 9] = ["kg", "m", "s", "A", "K", "mol", "cd", "rad", "factor"];

/// Symbols with the exponents of kg, m, s, A, K, mol, cd and rad, and a factor.
const SYMBOLS: &[(&str, [i32; 8], f64)] = &[
    ("kg", [1, 0, 0, 0, 0, 0, 0, 0], 1.0),
    ("m", [0, 1, 0, 0, 0, 0, 0, 0], 1.0),
    ("s", [0, 0, 1, 0, 0, 0, 0, 0], 1.0),
    ("A", [0, 0, 0, 1, 0, 0, 0, 0], 1.0),
    ("K", [0, 0, 0, 0, 1, 0, 0, 0], 1.0),
    ("mol", [0, 0, 0, 0, 0, 1, 0, 0], 1.0),
    ("cd", [0, 0, 0, 0, 0, 0, 1, 0], 1.0),
    ("rad", [0, 0, 0, 0, 0, 0, 0, 1], 1.0),
    ("1", [0, 0, 0, 0, 0, 0, 0, 0], 1.0),
    ("mm", [0, 1, 0, 0, 0, 0, 0, 0], 1e-3),
    ("N", [1, 1, -2, 0, 0, 0, 0, 0], 1.0),
    ("J", [1, 2, -2, 0, 0, 0, 0, 0], 1.0),
    ("W", [1, 2, -3, 0, 0, 0, 0, 0], 1.0),
    ("Pa", [1, -1, -2, 0, 0, 0, 0, 0], 1.0),
    ("Hz", [0, 0, -1, 0, 0, 0, 0, 0], 1.0),
    ("V", [1, 2, -3, -1, 0, 0, 0, 0], 1.0),
    (
        "deg",
        [0, 0, 0, 0, 0, 0, 0, 1],
        std::f64::consts::PI / 180.0,
    ),
];

/// A unit, as it is written in a model description.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Unit {
    /// Such as `N.m` or `rad/s2`.
    pub(crate) name: String,
    exponents: [i32; 8],
    factor: f64,
}

impl Unit {
    /// The unit in the first parentheses of a text that have one, such as `(m/s, global)`.
    pub(crate) fn within(text: &str) -> Option<Self> {
        let behind = text.split('(').skip(1);
        let texts = behind.filter_map(|rest| rest.split([')', ',']).next());
        texts.map(str::trim).find_map(Self::parse)
    }

    /// A unit such as `N m`, `kg m^2` or `rad/s^2`; what stands behind a line is divided by.
    fn parse(text: &str) -> Option<Self> {
        let mut unit = Self {
            name: String::new(),
            exponents: [0; 8],
            factor: 1.0,
        };
        for (k, fraction) in text.split('/').enumerate() {
            for (l, word) in fraction.split([' ', '.']).enumerate() {
                let end =
                    word.trim_end_matches(|c: char| c.is_ascii_digit() || c == '^' || c == '-');
                let symbol = if end.is_empty() { word } else { end };
                let power = word[symbol.len()..].trim_start_matches('^');
                let power: i32 = if power.is_empty() {
                    1
                } else {
                    power.parse().ok()?
                };
                let (_, exponents, factor) = SYMBOLS.iter().find(|(known, ..)| *known == symbol)?;
                let power = if k > 0 && l == 0 { -power } else { power };
                for (sum, exponent) in unit.exponents.iter_mut().zip(exponents) {
                    *sum += power * exponent;
                }
                unit.factor *= factor.powi(power);
            }
        }
        unit.name = text.replace(' ', ".").replace('^', "");
        Some(unit)
    }

    /// The attributes of its base unit.
    pub(crate) fn base(&self) -> Vec<(&'static str, String)> {
        let exponents = BASE.iter().zip(&self.exponents);
        let present = exponents.filter(|(_, exponent)| **exponent != 0);
        let mut base: Vec<_> = present
            .map(|(name, exponent)| (*name, exponent.to_string()))
            .collect();
        if self.factor.to_bits() != 1.0_f64.to_bits() {
            base.push((BASE[8], format!("{:?}", self.factor)));
        }
        base
    }
}

#[cfg(test)]
mod tests {
    use super::Unit;

    fn of(text: &str) -> Option<(String, Vec<String>)> {
        let unit = Unit::within(text)?;
        let base = unit.base().into_iter();
        Some((
            unit.name.clone(),
            base.map(|(name, to)| name.to_owned() + &to).collect(),
        ))
    }

    #[test]
    fn units_are_found_in_texts() {
        let found = |name: &str, base: &[&str]| {
            let base = base.iter().map(|&text| text.to_owned());
            Some((name.to_owned(), base.collect()))
        };
        let cases = [
            ("height (of the link) (m)", found("m", &["m1"])),
            ("its rate (rad/s^2)", found("rad/s2", &["s-2", "rad1"])),
            (
                "velocity along x (m/s, global)",
                found("m/s", &["m1", "s-1"]),
            ),
            ("torque (N m)", found("N.m", &["kg1", "m2", "s-2"])),
            ("inertia (kg m^2)", found("kg.m2", &["kg1", "m2"])),
            ("its rate (1/s)", found("1/s", &["s-1"])),
            ("length (mm)", found("mm", &["m1", "factor0.001"])),
            ("the state x", None),
            ("a ratio (nothing)", None),
        ];
        for (text, unit) in cases {
            assert_eq!(of(text), unit, "{text}");
        }
    }
}

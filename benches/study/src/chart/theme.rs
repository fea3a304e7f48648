//! Colours for light and dark backgrounds, and the style sheet that switches between them.
//!
//! A drawn element carries the colour for light backgrounds as its attribute, which is all that a
//! reader without style sheets sees; the style sheet selects elements by that attribute and
//! replaces the colour in dark mode. Neighbouring slots differ in lightness and dash pattern too,
//! so that colour is never the only difference.

use std::fmt::Write as _;

use plotters::style::RGBColor;

/// How many series can be told apart.
pub const SLOTS: usize = 9;

/// One role of a colour in both modes.
#[derive(Clone, Copy)]
pub(super) struct Ink {
    pub(super) light: RGBColor,
    dark: RGBColor,
    /// Dash and gap (px).
    dash: Option<&'static [u32]>,
}

const fn ink(light: u32, dark: u32, dash: Option<&'static [u32]>) -> Ink {
    const fn colour(rgb: u32) -> RGBColor {
        let [_, red, green, blue] = rgb.to_be_bytes();
        RGBColor(red, green, blue)
    }
    Ink {
        light: colour(light),
        dark: colour(dark),
        dash,
    }
}

/// The series. Lightness alternates, so that neighbours differ without colour.
pub(super) const SERIES: [Ink; SLOTS] = [
    ink(0x2A78D6, 0x5AA0F0, None),
    ink(0xD9541E, 0xF08050, Some(&[9, 3])),
    ink(0x128A5E, 0x2FBF8A, None),
    ink(0x5B3FC0, 0xB3A2FF, Some(&[3, 4])),
    ink(0x8A6A00, 0xDDB02E, None),
    ink(0x6B6B68, 0xA6A6A1, Some(&[2, 3])),
    ink(0xC2408E, 0xF48AC6, None),
    ink(0x00617A, 0x4CC3DB, Some(&[12, 3])),
    ink(0xB3453F, 0xFF9D96, None),
];

/// Text beside axes and in legends.
pub(super) const TEXT: Ink = ink(0x3F3E3B, 0xC9C8C2, None);
/// The frame of the axes.
pub(super) const FRAME: Ink = ink(0x9A9891, 0x73726D, None);
/// Lines across the plot at ticks.
pub(super) const GRID: Ink = ink(0xE4E2DC, 0x33332F, None);

/// The background.
pub(super) const SURFACE: Ink = ink(0xFCFCFB, 0x1A1A19, None);

/// The family of all text in charts.
pub(super) const FONT: &str = "system-ui, -apple-system, Segoe UI, Roboto, DejaVu Sans, sans-serif";

/// The style sheet of a chart whose user units are `1 / scale` px.
pub(super) fn style_sheet(scale: u32) -> String {
    let mut css = String::from(
        ".holonom-chart polyline{stroke-linejoin:round;stroke-linecap:butt}\
         .holonom-chart text{font-variant-numeric:tabular-nums}",
    );
    for series in SERIES {
        if let Some(dash) = series.dash {
            let pattern: Vec<_> = dash.iter().map(|px| (px * scale).to_string()).collect();
            let (colour, pattern) = (hex(series.light), pattern.join(" "));
            let _ = write!(
                css,
                ".holonom-chart [stroke=\"{colour}\"]{{stroke-dasharray:{pattern}}}"
            );
        }
    }
    css.push_str("@media (prefers-color-scheme:dark){");
    for ink in SERIES.iter().chain([&TEXT, &FRAME, &GRID, &SURFACE]) {
        let (light, dark) = (hex(ink.light), hex(ink.dark));
        for attribute in ["stroke", "fill"] {
            let _ = write!(
                css,
                ".holonom-chart [{attribute}=\"{light}\"]{{{attribute}:{dark}}}"
            );
        }
    }
    css.push('}');
    css
}

/// A colour as the SVG back end writes it.
fn hex(RGBColor(red, green, blue): RGBColor) -> String {
    format!("#{red:02X}{green:02X}{blue:02X}")
}

#[cfg(test)]
mod tests {
    use super::{FRAME, GRID, Ink, SERIES, SURFACE, TEXT, hex, style_sheet};
    use plotters::style::RGBColor;

    /// Relative luminance and contrast of WCAG 2.
    fn contrast(a: RGBColor, b: RGBColor) -> f64 {
        let luminance = |RGBColor(r, g, b): RGBColor| {
            let part = |x: u8| {
                let x = f64::from(x) / 255.0;
                if x <= 0.040_45 {
                    x / 12.92
                } else {
                    ((x + 0.055) / 1.055).powf(2.4)
                }
            };
            0.2126 * part(r) + 0.7152 * part(g) + 0.0722 * part(b)
        };
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn every_ink_is_legible_on_both_backgrounds() {
        let legible = |ink: &Ink, least: f64| {
            contrast(ink.light, SURFACE.light) >= least && contrast(ink.dark, SURFACE.dark) >= least
        };
        assert!(SERIES.iter().all(|ink| legible(ink, 3.0)));
        assert!(legible(&TEXT, 7.0));
    }

    #[test]
    fn no_colour_stands_for_two_things() {
        let mut all: Vec<_> = SERIES
            .iter()
            .chain([&TEXT, &FRAME, &GRID, &SURFACE])
            .map(|ink| hex(ink.light))
            .collect();
        let count = all.len();
        all.sort();
        all.dedup();
        assert_eq!(all.len(), count);
    }

    #[test]
    fn the_style_sheet_is_safe_inside_a_document() {
        let css = style_sheet(8);
        assert!(!css.contains(['<', '&']));
        assert_eq!(css.matches('{').count(), css.matches('}').count());
    }
}

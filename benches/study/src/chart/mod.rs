//! Pictures of quantities over time, as SVG that stands alone and follows the reader's light or
//! dark mode.
//!
//! A chart never hides a number that it cannot draw: values that are not finite, and values that
//! are not positive on a logarithmic axis, interrupt the curve and are counted in
//! [`Picture::left_out`].

mod axis;
mod draw;
mod text;
mod theme;

use crate::error::StudyError;

pub use theme::SLOTS;

/// How an axis maps its values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Equal distances for equal differences.
    Linear,
    /// Equal distances for equal ratios; positive values only.
    Logarithmic,
}

/// What an axis shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The quantity.
    pub quantity: String,
    /// Its unit, `1` for a pure number.
    pub unit: String,
    /// How values are mapped.
    pub scale: Scale,
}

impl Axis {
    /// An axis with equal distances for equal differences.
    #[must_use]
    pub fn linear(quantity: impl Into<String>, unit: impl Into<String>) -> Self {
        Self {
            quantity: quantity.into(),
            unit: unit.into(),
            scale: Scale::Linear,
        }
    }

    /// An axis with equal distances for equal ratios.
    #[must_use]
    pub fn logarithmic(quantity: impl Into<String>, unit: impl Into<String>) -> Self {
        Self {
            quantity: quantity.into(),
            unit: unit.into(),
            scale: Scale::Logarithmic,
        }
    }

    /// Quantity and unit as they stand beside the axis.
    #[must_use]
    pub fn caption(&self) -> String {
        format!("{} ({})", self.quantity, self.unit)
    }
}

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A curve through the points.
    Line,
    /// A dot at every point.
    Dots,
}

/// One curve of a chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Its name in the legend.
    pub name: String,
    /// Its colour and dash pattern, below [`SLOTS`]. The same slot means the same thing in all
    /// charts of a page.
    pub slot: usize,
    /// How it is drawn.
    pub mark: Mark,
    /// Abscissa and ordinate, in the units of the axes.
    pub points: Vec<(f64, f64)>,
}

/// What to draw.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// What the chart shows, in a few words.
    pub title: String,
    /// The abscissa.
    pub x: Axis,
    /// The ordinate.
    pub y: Axis,
    /// The curves, the first at the bottom.
    pub series: Vec<Series>,
}

/// A drawn chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// What it shows, in a few words.
    pub title: String,
    /// An SVG document without XML declaration: a file of its own or a part of an HTML page.
    pub svg: String,
    /// What could not be drawn.
    pub left_out: LeftOut,
}

/// Points that a chart could not draw.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LeftOut {
    /// NaN or infinite.
    pub not_finite: usize,
    /// Zero or negative on a logarithmic axis.
    pub not_positive: usize,
}

impl LeftOut {
    /// A sentence for the reader; `None` where everything was drawn.
    #[must_use]
    pub fn sentence(&self) -> Option<String> {
        let count = |count: usize, what: &str| match count {
            0 => None,
            1 => Some(format!("1 value is {what}")),
            _ => Some(format!("{count} values are {what}")),
        };
        let parts: Vec<_> = [
            count(self.not_finite, "not finite"),
            count(
                self.not_positive,
                "zero or negative, which a logarithmic axis cannot show",
            ),
        ]
        .into_iter()
        .flatten()
        .collect();
        (!parts.is_empty()).then(|| format!("Left out: {}.", parts.join("; ")))
    }
}

/// The places of all abscissae, those of points that cannot be drawn for their ordinate included: a
/// curve that begins late shows that it does.
fn abscissae(chart: &Chart) -> impl Iterator<Item = f64> {
    let points = chart.series.iter().flat_map(|series| &series.points);
    points.filter_map(|&(x, _)| axis::place(x, chart.x.scale))
}

impl Chart {
    /// Draws the chart.
    ///
    /// # Errors
    /// [`StudyError::Picture`] where not a single point can be drawn.
    pub fn draw(&self) -> Result<Picture, StudyError> {
        draw::picture(self)
    }

    /// Draws the chart in letters, `width` wide and `height` lines high, the labels and the legend
    /// not counted.
    ///
    /// A letter stands for the largest value in its column; values that cannot be drawn are left
    /// out.
    ///
    /// # Errors
    /// [`StudyError::Picture`] where not a single point can be drawn.
    pub fn text(&self, width: usize, height: usize) -> Result<String, StudyError> {
        text::text(self, width, height)
    }
}

#[cfg(test)]
mod tests {
    use super::{Axis, Chart, LeftOut, Mark, Series};
    use crate::error::StudyError;

    fn chart(y: Axis, values: &[f64]) -> Chart {
        let points = values
            .iter()
            .enumerate()
            .map(|(k, &value)| (k as f64, value))
            .collect();
        Chart {
            title: "A < B & C".into(),
            x: Axis::linear("time", "s"),
            y,
            series: vec![Series {
                name: "one & only".into(),
                slot: 1,
                mark: Mark::Line,
                points,
            }],
        }
    }

    #[test]
    fn a_chart_has_title_units_legend_and_no_fixed_size() {
        let picture = chart(Axis::linear("angle", "rad"), &[1.0, 2.0, 1.5])
            .draw()
            .unwrap();
        for part in [
            "<title>A &lt; B &amp; C</title>",
            "time (s)",
            "angle (rad)",
            "one &amp; only",
        ] {
            assert!(picture.svg.contains(part), "{part} is missing");
        }
        assert!(picture.svg.starts_with("<svg") && !picture.svg.contains("<svg width"));
        assert_eq!(
            picture.svg.matches("<svg").count(),
            picture.svg.matches("</svg>").count()
        );
        assert_eq!(picture.left_out, LeftOut::default());
        assert_eq!(picture.left_out.sentence(), None);
    }

    #[test]
    fn what_cannot_be_drawn_interrupts_the_curve_and_is_counted() {
        let values = [1.0, 2.0, f64::NAN, 3.0, 4.0, 0.0, 5.0, 6.0, f64::INFINITY];
        let whole = chart(Axis::logarithmic("a", "1"), &[1.0, 2.0, 3.0])
            .draw()
            .unwrap();
        let broken = chart(Axis::logarithmic("a", "1"), &values).draw().unwrap();
        assert_eq!(
            broken.left_out,
            LeftOut {
                not_finite: 2,
                not_positive: 1
            }
        );
        let curves = |svg: &str| svg.matches("stroke=\"#D9541E\" stroke-width").count();
        assert_eq!(curves(&broken.svg), curves(&whole.svg) + 2);
        assert!(!broken.svg.contains("NaN") && !broken.svg.contains("inf"));
        let sentence = broken.left_out.sentence().unwrap();
        assert!(
            sentence.contains("2 values are not finite") && sentence.contains("1 value is zero")
        );
    }

    #[test]
    fn the_abscissa_begins_where_the_data_begin() {
        let svg = chart(Axis::logarithmic("a", "1"), &[0.0, 1.0, 2.0])
            .draw()
            .unwrap()
            .svg;
        assert!(svg.contains(">\n0.0\n<"), "{svg}");
    }

    #[test]
    fn nothing_to_draw_is_an_error_with_the_title() {
        for values in [vec![], vec![f64::NAN, f64::NAN]] {
            let error = chart(Axis::linear("a", "1"), &values).draw().unwrap_err();
            assert!(matches!(error, StudyError::Picture { title, .. } if title == "A < B & C"));
        }
    }

    #[test]
    fn constant_and_extreme_values_are_drawn() {
        for value in [0.0, -3.0, 1e-300, 1e300] {
            chart(Axis::linear("a", "1"), &[value, value])
                .draw()
                .unwrap();
        }
        for value in [1e-300, 1.0, 1e300] {
            chart(Axis::logarithmic("a", "1"), &[value, value])
                .draw()
                .unwrap();
        }
    }
}

//! From chart to SVG, with plotters.
//!
//! The back end knows whole pixels only, so everything is drawn [`SCALE`] times too large and the
//! view box scales it back.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::axis::{Range, place};
use super::theme::{self, FONT, FRAME, GRID, SERIES, SURFACE, TEXT};
use super::{Axis, Chart, LeftOut, Mark, Picture, Scale, abscissae};
use crate::error::StudyError;

/// User units per px.
const SCALE: u32 = 10;
/// Width and height of a chart without its legend (px).
const SIZE: (u32, u32) = (920, 380);
/// Height of one row of the legend (px).
const ROW: u32 = 24;
/// Room around the plot (px): left for the labels of the ordinate, above for its caption, below for
/// the abscissa.
const MARGIN: Margin = Margin {
    left: 62,
    right: 18,
    top: 30,
    bottom: 46,
};
/// The font size (px).
const FONT_SIZE: f64 = 14.0;

struct Margin {
    left: u32,
    right: u32,
    top: u32,
    bottom: u32,
}

/// Points of one series without interruption, in drawing coordinates.
type Piece = Vec<(f64, f64)>;

pub(super) fn picture(chart: &Chart) -> Result<Picture, StudyError> {
    let fault = |reason: String| StudyError::Picture {
        title: chart.title.clone(),
        reason,
    };
    let mut left_out = LeftOut::default();
    let pieces: Vec<Vec<Piece>> = chart
        .series
        .iter()
        .map(|s| split(&s.points, chart, &mut left_out))
        .collect();
    let drawn = || pieces.iter().flatten().flatten();
    let x = Range::around(abscissae(chart), chart.x.scale, 10, true);
    let y = Range::around(drawn().map(|p| p.1), chart.y.scale, 8, false);
    let (Some(x), Some(y)) = (x, y) else {
        return Err(fault("not a single point can be drawn".into()));
    };

    let legend = Legend::of(chart);
    let size = (SIZE.0, SIZE.1 + legend.height());
    let mut svg = String::new();
    {
        let root =
            SVGBackend::with_string(&mut svg, (size.0 * SCALE, size.1 * SCALE)).into_drawing_area();
        root.fill(&SURFACE.light)
            .and_then(|()| legend.draw(&root))
            .and_then(|()| plot(&root, chart, &pieces, (x, y), legend.height()))
            .and_then(|()| root.present())
            .map_err(|error| fault(error.to_string()))?;
    }
    Ok(Picture {
        title: chart.title.clone(),
        svg: dressed(&svg, chart, size),
        left_out,
    })
}

/// Cuts a series where it cannot be drawn.
fn split(points: &[(f64, f64)], chart: &Chart, left_out: &mut LeftOut) -> Vec<Piece> {
    let mut pieces = vec![Piece::new()];
    for &(x, y) in points {
        if let (Some(x), Some(y)) = (place(x, chart.x.scale), place(y, chart.y.scale)) {
            if let Some(piece) = pieces.last_mut() {
                piece.push((x, y));
            }
            continue;
        }
        if x.is_finite() && y.is_finite() {
            left_out.not_positive += 1;
        } else {
            left_out.not_finite += 1;
        }
        pieces.push(Piece::new());
    }
    pieces.retain(|piece| !piece.is_empty());
    pieces
}

type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;
type Drawn<'a> = Result<(), DrawingAreaErrorKind<<SVGBackend<'a> as DrawingBackend>::ErrorType>>;

fn plot<'a>(
    root: &Area<'a>,
    chart: &Chart,
    pieces: &[Vec<Piece>],
    (x, y): (Range, Range),
    top: u32,
) -> Drawn<'a> {
    let text = text_style(TEXT.light);
    root.draw(&Text::new(chart.y.caption(), at(4, top + 4), text.clone()))?;
    let area = root.margin((top + MARGIN.top) * SCALE, 0, 0, MARGIN.right * SCALE);
    let mut context = ChartBuilder::on(&area)
        .x_label_area_size(MARGIN.bottom * SCALE)
        .y_label_area_size(MARGIN.left * SCALE)
        .build_cartesian_2d(x, y)?;
    context
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID.light.stroke_width(SCALE))
        .axis_style(FRAME.light.stroke_width(SCALE))
        .set_all_tick_mark_size(5 * SCALE)
        .label_style(text)
        .x_desc(chart.x.caption())
        .draw()?;
    for (series, pieces) in chart.series.iter().zip(pieces) {
        let colour = SERIES[series.slot % SERIES.len()].light;
        for piece in pieces {
            // A single point between interruptions has no curve: it shows as a dot.
            if series.mark == Mark::Line && piece.len() > 1 {
                let style = colour.stroke_width(2 * SCALE);
                context.draw_series([PathElement::new(piece.clone(), style)])?;
            } else {
                let dot = |&point: &(f64, f64)| Circle::new(point, 3 * SCALE, colour.filled());
                context.draw_series(piece.iter().map(dot))?;
            }
        }
    }
    Ok(())
}

/// The names of the series in rows above the plot.
struct Legend<'a> {
    /// Name, slot, mark, and where it stands: distance from the left (px) and row.
    entries: Vec<(&'a str, usize, Mark, (u32, u32))>,
    rows: u32,
}

impl<'a> Legend<'a> {
    fn of(chart: &'a Chart) -> Self {
        let (mut x, mut row) = (4, 0);
        let mut entries = Vec::new();
        for series in &chart.series {
            // No font is at hand to measure with: 0.58 em is wide for a letter of a sans-serif
            // text.
            let width = 36 + (0.58 * FONT_SIZE * series.name.chars().count() as f64) as u32 + 18;
            if x > 4 && x + width > SIZE.0 {
                (x, row) = (4, row + 1);
            }
            entries.push((series.name.as_str(), series.slot, series.mark, (x, row)));
            x += width;
        }
        Self {
            entries,
            rows: row + 1,
        }
    }

    fn height(&self) -> u32 {
        self.rows * ROW + 4
    }

    fn draw<'b>(&self, root: &Area<'b>) -> Drawn<'b> {
        for &(name, slot, mark, (x, row)) in &self.entries {
            let colour = SERIES[slot % SERIES.len()].light;
            let y = row * ROW + ROW / 2;
            match mark {
                Mark::Line => root.draw(&PathElement::new(
                    vec![at(x, y), at(x + 28, y)],
                    colour.stroke_width(5 * SCALE / 2),
                ))?,
                Mark::Dots => root.draw(&Circle::new(at(x + 14, y), 3 * SCALE, colour.filled()))?,
            }
            let style = text_style(TEXT.light).pos(Pos::new(HPos::Left, VPos::Center));
            root.draw(&Text::new(name.to_owned(), at(x + 36, y), style))?;
        }
        Ok(())
    }
}

fn text_style(colour: RGBColor) -> TextStyle<'static> {
    // The back end divides font sizes by 1.24.
    (FONT, 1.24 * FONT_SIZE * f64::from(SCALE))
        .into_font()
        .color(&colour)
}

/// A place in px, in user units.
fn at(x: u32, y: u32) -> (i32, i32) {
    ((x * SCALE).cast_signed(), (y * SCALE).cast_signed())
}

/// Replaces the head of the document: no fixed size, a name for readers of the screen, a style
/// sheet.
fn dressed(svg: &str, chart: &Chart, (width, height): (u32, u32)) -> String {
    let body = svg.split_once('>').map_or(svg, |(_, body)| body);
    let title = escaped(&chart.title);
    let description = escaped(&description(chart));
    format!(
        "<svg class=\"holonom-chart\" role=\"img\" viewBox=\"0 0 {} {}\" xmlns=\"http://www.w3.org/2000/svg\">\n\
         <title>{title}</title>\n<desc>{description}</desc>\n<style>{}</style>{body}",
        width * SCALE,
        height * SCALE,
        theme::style_sheet(SCALE),
    )
}

fn description(chart: &Chart) -> String {
    let scale = |axis: &Axis| match axis.scale {
        Scale::Linear => "linear",
        Scale::Logarithmic => "logarithmic",
    };
    let names: Vec<_> = chart.series.iter().map(|s| s.name.as_str()).collect();
    format!(
        "{} ({} scale) over {} ({} scale): {}.",
        chart.y.caption(),
        scale(&chart.y),
        chart.x.caption(),
        scale(&chart.x),
        names.join(", ")
    )
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

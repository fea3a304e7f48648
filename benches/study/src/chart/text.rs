//! A chart in letters, for terminals.

use super::axis::{Range, place};
use super::{Axis, Chart, abscissae};
use crate::error::StudyError;

/// Draws the chart `width` letters wide and `height` lines high, the labels and the legend not
/// counted.
///
/// Every letter stands for the largest value in its column. Where two series meet, the later one is
/// seen.
pub(super) fn text(chart: &Chart, width: usize, height: usize) -> Result<String, StudyError> {
    let (width, height) = (width.max(10), height.max(4));
    let placed = |points: &[(f64, f64)]| -> Vec<(f64, f64)> {
        let both =
            |&(x, y): &(f64, f64)| Some((place(x, chart.x.scale)?, place(y, chart.y.scale)?));
        points.iter().filter_map(both).collect()
    };
    let series: Vec<_> = chart
        .series
        .iter()
        .map(|series| placed(&series.points))
        .collect();
    let all = || series.iter().flatten();
    let x = Range::around(abscissae(chart), chart.x.scale, 10, true);
    let y = Range::around(all().map(|p| p.1), chart.y.scale, height / 2, false);
    let (Some(x), Some(y)) = (x, y) else {
        return Err(StudyError::Picture {
            title: chart.title.clone(),
            reason: "not a single point can be drawn".into(),
        });
    };

    let mut canvas = vec![vec![' '; width]; height];
    let row = |y_value: f64| height - 1 - cell(y_value, (y.low, y.high), height);
    let letters = letters(chart);
    for (points, &letter) in series.iter().zip(&letters) {
        let mut highest = vec![f64::NEG_INFINITY; width];
        for &(at, value) in points {
            let column = &mut highest[cell(at, (x.low, x.high), width)];
            *column = column.max(value);
        }
        for (column, value) in highest.into_iter().enumerate() {
            if value.is_finite() {
                canvas[row(value)][column] = letter;
            }
        }
    }
    Ok(framed(chart, &canvas, &letters, (&x, &y), row))
}

/// One letter per series: the first of its name where these differ, capitals in order of the
/// alphabet otherwise.
fn letters(chart: &Chart) -> Vec<char> {
    let initials: Vec<_> = chart
        .series
        .iter()
        .filter_map(|s| s.name.chars().next())
        .collect();
    let unique = initials
        .iter()
        .enumerate()
        .all(|(k, letter)| !initials[..k].contains(letter));
    if unique && initials.len() == chart.series.len() {
        initials
    } else {
        ('A'..='Z').cycle().take(chart.series.len()).collect()
    }
}

/// Canvas, axes and legend together.
fn framed(
    chart: &Chart,
    canvas: &[Vec<char>],
    letters: &[char],
    (x, y): (&Range, &Range),
    row: impl Fn(f64) -> usize,
) -> String {
    let mut labels = vec![String::new(); canvas.len()];
    for &tick in &y.ticks {
        labels[row(tick)] = y.label(tick);
    }
    let margin = labels
        .iter()
        .map(|label| label.chars().count())
        .max()
        .unwrap_or(0);
    let mut text = format!("{}: {}\n", chart.title, Axis::caption(&chart.y));
    for (label, line) in labels.iter().zip(canvas) {
        let tick = if label.is_empty() { '│' } else { '┤' };
        let line: String = line.iter().collect();
        text.push_str(&format!("{label:>margin$} {tick}{}\n", line.trim_end()));
    }
    let width = canvas.first().map_or(0, Vec::len);
    let (first, last) = (x.label(x.low), x.label(x.high));
    let space = " ".repeat(margin + 1);
    text.push_str(&format!("{space}└{}\n", "─".repeat(width)));
    let middle = width.saturating_sub(first.chars().count() + last.chars().count());
    text.push_str(&format!(
        "{space} {first}{:^middle$}{last}\n",
        chart.x.caption()
    ));
    let names = chart.series.iter().zip(letters);
    let legend: Vec<_> = names
        .map(|(series, letter)| format!("{letter} {}", series.name))
        .collect();
    text.push_str(&format!("{space} {}\n", legend.join("   ")));
    text
}

/// The cell of `count` that a value between two bounds falls into.
fn cell(value: f64, (low, high): (f64, f64), count: usize) -> usize {
    let fraction = (value - low) / (high - low);
    ((fraction * (count - 1) as f64).round().max(0.0) as usize).min(count - 1)
}

#[cfg(test)]
mod tests {
    use crate::chart::{Axis, Chart, Mark, Series};

    fn chart(names: [&str; 2], values: [&[f64]; 2]) -> Chart {
        let series = |(name, values): (&str, &[f64])| Series {
            name: name.into(),
            slot: 0,
            mark: Mark::Line,
            points: values
                .iter()
                .enumerate()
                .map(|(k, &v)| (k as f64, v))
                .collect(),
        };
        Chart {
            title: "Title".into(),
            x: Axis::linear("time", "s"),
            y: Axis::logarithmic("error", "rad"),
            series: names.into_iter().zip(values).map(series).collect(),
        }
    }

    #[test]
    fn curves_axes_and_legend_are_there() {
        let values: [&[f64]; 2] = [&[1e-8, 1e-6, 1e-4, 1e-2], &[1e-6; 4]];
        let text = chart(["rising", "Level"], values).text(40, 13).unwrap();
        let lines: Vec<_> = text.lines().collect();
        assert_eq!(lines[0], "Title: error (rad)");
        assert!(lines[1].starts_with("10⁻² ┤") && lines[1].ends_with('r'));
        assert!(lines[13].starts_with("10⁻⁸ ┤r"));
        assert_eq!(
            text.matches('L').count(),
            6,
            "four points and the legend: {text}"
        );
        assert!(lines[15].contains("time (s)") && lines[16].contains("r rising   L Level"));
    }

    #[test]
    fn equal_initials_are_replaced() {
        let text = chart(["radial", "rate"], [&[1e-8, 1e-6], &[1e-7; 2]])
            .text(40, 9)
            .unwrap();
        assert!(text.contains("A radial   B rate"));
    }

    #[test]
    fn what_has_no_place_is_not_drawn() {
        let values: [&[f64]; 2] = [&[1e-8, f64::NAN, 0.0, 1e-2], &[]];
        let text = chart(["A", "B"], values).text(40, 13).unwrap();
        assert_eq!(
            text.matches('A').count(),
            2 + 2,
            "two points and the legend: {text}"
        );
        assert!(chart(["A", "B"], [&[f64::NAN], &[]]).text(40, 13).is_err());
    }
}

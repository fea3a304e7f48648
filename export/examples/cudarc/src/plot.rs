//! A drawing of angles over time.

use std::error::Error;
use std::path::Path;

use plotters::prelude::*;

use crate::Number;

/// Writes curves of angles (rad), the first number of each after one step in time (s), as SVG.
pub(crate) fn write(
    path: &Path,
    step: Number,
    curves: &[Vec<Number>],
) -> Result<(), Box<dyn Error>> {
    let points = |curve: &Vec<Number>| {
        let times = (1..=curve.len()).map(move |place| step * place as Number);
        times.zip(curve.iter().copied()).collect::<Vec<_>>()
    };
    let curves: Vec<_> = curves.iter().map(points).collect();
    let all = || curves.iter().flatten();
    let last = all().fold(step, |last, (time, _)| last.max(*time));
    let least = all().fold(Number::default(), |least, (_, angle)| least.min(*angle));
    let most = all().fold(Number::default(), |most, (_, angle)| most.max(*angle));
    let room = 0.05 * (most - least).max(0.1);

    let area = SVGBackend::new(path, (640, 400)).into_drawing_area();
    area.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&area)
        .margin(15)
        .x_label_area_size(40)
        .y_label_area_size(55)
        .build_cartesian_2d(0.0..last, least - room..most + room)?;
    chart
        .configure_mesh()
        .x_desc("time (s)")
        .y_desc("angle of the elbow (rad)")
        .light_line_style(TRANSPARENT)
        .draw()?;
    for (place, curve) in curves.into_iter().enumerate() {
        let colour = Palette99::pick(place).stroke_width(2);
        chart.draw_series(LineSeries::new(curve, colour))?;
    }
    area.present()?;
    Ok(())
}

//! The pictures of the comparison.

use super::record::Row;
use super::{Coordinates, Precision};
use crate::chapter15::Method;
use crate::chart::{Axis, Chart, Mark, Series};
use crate::document::Figure;

/// The families that come in sizes: name, what `n` counts, and a pair of slots.
const FAMILIES: [(&str, &str); 4] = [
    ("revolute-chain", "links"),
    ("alternating-chain", "links"),
    ("spherical-chain", "links"),
    ("four-bar", "windows"),
];

/// How time grows with the size of a mechanism, one picture for each family of which there are
/// three sizes or more.
#[must_use]
pub fn growth(rows: &[Row]) -> Vec<Figure> {
    let figures = FAMILIES.iter().filter_map(|&(scene, unit)| {
        let bodies = sizes(rows, scene, Coordinates::Bodies);
        let joints = sizes(rows, scene, Coordinates::Joints);
        if bodies.len() < 3 {
            return None;
        }
        let points = |rows: &[&Row], time: fn(&Row) -> Option<f64>| -> Vec<(f64, f64)> {
            let point = |row: &&Row| Some((row.n as f64, time(row)?));
            rows.iter().filter_map(point).collect()
        };
        let series = [
            ("bodies", 0, points(&bodies, |row| Some(row.nanoseconds_throughput))),
            ("bodies, waiting", 3, points(&bodies, |row| Some(row.nanoseconds_dependent))),
            ("joints", 1, points(&joints, |row| Some(row.nanoseconds_throughput))),
            ("joints, waiting", 5, points(&joints, |row| Some(row.nanoseconds_dependent))),
            ("assembler", 2, points(&bodies, |row| row.assembler_nanoseconds)),
        ];
        let series = series.into_iter().filter(|(.., points)| !points.is_empty());
        Some(Figure {
            name: format!("growth-{scene}"),
            chart: Chart {
                title: format!("Time of an evaluation, {scene}"),
                x: Axis::logarithmic(unit, "1"),
                y: Axis::logarithmic("time", "ns"),
                series: series.map(|(name, slot, points)| line(name, slot, points)).collect(),
            },
            caption: "Standard multipliers, f64. What grows in proportion to the size has the slope of one decade per decade.".into(),
            headline: scene == "revolute-chain",
        })
    });
    figures.collect()
}

/// How operations grow with the size.
#[must_use]
pub fn operations(rows: &[Row]) -> Option<Figure> {
    let mut series = Vec::new();
    for (family, slots) in [
        ("revolute-chain", [0, 1]),
        ("spherical-chain", [2, 3]),
        ("four-bar", [4, 5]),
    ] {
        for (coordinates, slot) in [Coordinates::Bodies, Coordinates::Joints]
            .into_iter()
            .zip(slots)
        {
            let sizes = sizes(rows, family, coordinates);
            if sizes.len() > 1 {
                let points = sizes
                    .iter()
                    .map(|row| (row.n as f64, row.operations as f64));
                series.push(line(
                    &format!("{family}, {}", coordinates.key()),
                    slot,
                    points.collect(),
                ));
            }
        }
    }
    (!series.is_empty()).then(|| Figure {
        name: "operations".into(),
        chart: Chart {
            title: "Operations of an evaluation".into(),
            x: Axis::logarithmic("links or windows", "1"),
            y: Axis::logarithmic("operations", "1"),
            series,
        },
        caption: "Standard multipliers.".into(),
        headline: false,
    })
}

/// Time over operations of all mechanisms.
#[must_use]
pub fn price(rows: &[Row]) -> Figure {
    let series = [Coordinates::Bodies, Coordinates::Joints]
        .into_iter()
        .zip([0, 1]);
    let series = series.map(|(coordinates, slot)| {
        let chosen = rows.iter().filter(|row| {
            row.is(coordinates, Method::Standard, Precision::Double) && !row.is_reference()
        });
        let points = chosen.map(|row| (row.operations as f64, row.nanoseconds_throughput));
        Series {
            mark: Mark::Dots,
            ..line(coordinates.key(), slot, points.collect())
        }
    });
    let unit = rows.iter().filter(|row| row.is_reference());
    let unit = unit.map(|row| (row.operations as f64, row.nanoseconds_throughput));
    let reference_kernel = Series {
        mark: Mark::Dots,
        ..line("reference kernel", 2, unit.collect())
    };
    Figure {
        name: "price".into(),
        chart: Chart {
            title: "Time over operations".into(),
            x: Axis::logarithmic("operations", "1"),
            y: Axis::logarithmic("time", "ns"),
            series: series.chain([reference_kernel]).collect(),
        },
        caption: "One dot for each mechanism: standard multipliers, f64.".into(),
        headline: false,
    }
}

/// The rows of a family in a description, smallest first.
fn sizes<'a>(rows: &'a [Row], scene: &str, coordinates: Coordinates) -> Vec<&'a Row> {
    let mut sizes: Vec<_> = rows
        .iter()
        .filter(|row| {
            row.scene == scene && row.is(coordinates, Method::Standard, Precision::Double)
        })
        .collect();
    sizes.sort_by_key(|row| row.n);
    sizes
}

fn line(name: &str, slot: usize, points: Vec<(f64, f64)>) -> Series {
    Series {
        name: name.into(),
        slot,
        mark: Mark::Line,
        points,
    }
}

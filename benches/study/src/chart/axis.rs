//! Ranges, ticks and labels of an axis.

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

use super::Scale;
use crate::format::{fixed, power_of_ten, scientific};

/// An axis in drawing coordinates: the value itself, or its decimal logarithm.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Range {
    pub(super) low: f64,
    pub(super) high: f64,
    pub(super) ticks: Vec<f64>,
    scale: Scale,
    step: f64,
    /// Whether ticks stand within decades.
    is_fine: bool,
}

/// A tight logarithmic axis of less than so many decades has ticks within them.
const FINE: f64 = 2.0;

/// The place of a value on an axis; `None` where it has none.
pub(super) fn place(value: f64, scale: Scale) -> Option<f64> {
    let place = match scale {
        Scale::Linear => value,
        Scale::Logarithmic => value.log10(),
    };
    place.is_finite().then_some(place)
}

impl Range {
    /// The range that holds all places, with `most` ticks or a few less; `None` without places.
    ///
    /// `tight` ends the axis at the outermost places instead of at ticks.
    pub(super) fn around(
        places: impl IntoIterator<Item = f64>,
        scale: Scale,
        most: usize,
        tight: bool,
    ) -> Option<Self> {
        let (mut low, mut high) = places
            .into_iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
                (low.min(x), high.max(x))
            });
        if low > high {
            return None;
        }
        if low == high {
            let margin = if scale == Scale::Linear && low != 0.0 {
                0.1 * low.abs()
            } else {
                1.0
            };
            (low, high) = (low - margin, high + margin);
        }
        if tight && scale == Scale::Logarithmic && high - low < FINE {
            let within = |&tick: &f64| (low - 1e-9..=high + 1e-9).contains(&tick);
            let decades = low.floor() as i32..=high.ceil() as i32;
            let ticks = decades
                .flat_map(|decade| [1.0, 2.0, 5.0].map(|x: f64| f64::from(decade) + x.log10()));
            return Some(Self {
                low,
                high,
                ticks: ticks.filter(within).collect(),
                scale,
                step: 1.0,
                is_fine: true,
            });
        }
        let step = step((high - low) / most.max(1) as f64, scale);
        let (first, last) = ((low / step).floor(), (high / step).ceil());
        let ticks = (0..=(last - first) as usize).map(|k| (first + k as f64) * step);
        if tight {
            let (from, to) = (low - 1e-9 * step, high + 1e-9 * step);
            return Some(Self {
                low,
                high,
                ticks: ticks.filter(|x| (from..=to).contains(x)).collect(),
                scale,
                step,
                is_fine: false,
            });
        }
        Some(Self {
            low: first * step,
            high: last * step,
            ticks: ticks.collect(),
            scale,
            step,
            is_fine: false,
        })
    }

    /// The text beside a tick.
    pub(super) fn label(&self, tick: f64) -> String {
        match self.scale {
            Scale::Logarithmic if self.is_fine => {
                let digits = (-tick.floor()).max(0.0) as usize;
                fixed(10.0_f64.powf(tick), digits)
            }
            Scale::Logarithmic => power_of_ten(tick.round() as i32),
            Scale::Linear => {
                let largest = self.low.abs().max(self.high.abs());
                // Adding zero turns a negative zero into a positive one.
                let tick = if tick.abs() < 1e-6 * self.step {
                    0.0
                } else {
                    tick
                };
                if (1e-3..1e5).contains(&largest) {
                    fixed(tick, (-self.step.log10()).ceil().max(0.0) as usize)
                } else {
                    scientific(
                        tick,
                        (tick.abs() / self.step).log10().floor().max(0.0) as usize,
                    )
                }
            }
        }
    }
}

impl Ranged for Range {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, place: &f64, (from, to): (i32, i32)) -> i32 {
        let fraction = (place - self.low) / (self.high - self.low);
        from + (fraction * f64::from(to - from)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() {
            Vec::new()
        } else {
            self.ticks.clone()
        }
    }

    fn range(&self) -> std::ops::Range<f64> {
        self.low..self.high
    }
}

impl ValueFormatter<f64> for Range {
    fn format_ext(&self, tick: &f64) -> String {
        self.label(*tick)
    }
}

/// The smallest round step that is not below `least`: 1, 2 or 5 times a power of ten, whole decades
/// on a logarithmic axis.
fn step(least: f64, scale: Scale) -> f64 {
    if scale == Scale::Logarithmic {
        return [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 20.0, 50.0, 100.0]
            .into_iter()
            .find(|&step| step >= least)
            .unwrap_or_else(|| least.ceil());
    }
    let decade = 10.0_f64.powf(least.log10().floor());
    [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|factor| factor * decade)
        .find(|&step| step >= least * (1.0 - 1e-12))
        .unwrap_or(10.0 * decade)
}

#[cfg(test)]
mod tests {
    use super::{Range, place};
    use crate::chart::Scale::{Linear, Logarithmic};

    fn labels(range: &Range) -> Vec<String> {
        range.ticks.iter().map(|&tick| range.label(tick)).collect()
    }

    #[test]
    fn linear_ticks_are_round() {
        let range = Range::around([0.0, 10.0], Linear, 10, true).unwrap();
        assert_eq!(labels(&range)[..3], ["0", "1", "2"]);
        assert_eq!((range.low, range.high, range.ticks.len()), (0.0, 10.0, 11));
        let range = Range::around([-17.2, 172.1], Linear, 8, false).unwrap();
        assert_eq!((range.low, range.high), (-50.0, 200.0));
        assert_eq!(labels(&range)[0], "\u{2212}50");
        let range = Range::around([-0.03, 0.071], Linear, 6, false).unwrap();
        assert_eq!(
            labels(&range)[..3],
            ["\u{2212}0.04", "\u{2212}0.02", "0.00"]
        );
    }

    #[test]
    fn small_numbers_are_written_with_powers() {
        let range = Range::around([-1.5e-6, 3e-6], Linear, 5, false).unwrap();
        assert_eq!(
            labels(&range),
            [
                "\u{2212}2·10⁻⁶",
                "\u{2212}1·10⁻⁶",
                "0",
                "1·10⁻⁶",
                "2·10⁻⁶",
                "3·10⁻⁶"
            ]
        );
    }

    #[test]
    fn decades_are_whole() {
        let places = [3e-25, 4.5e-11].map(|x| place(x, Logarithmic).unwrap());
        let range = Range::around(places, Logarithmic, 8, false).unwrap();
        assert_eq!((range.low, range.high), (-26.0, -10.0));
        assert_eq!(labels(&range)[..2], ["10⁻²⁶", "10⁻²⁴"]);
    }

    #[test]
    fn few_decades_have_ticks_within_them() {
        let places = [1.0, 40.0].map(|x| place(x, Logarithmic).unwrap());
        let range = Range::around(places, Logarithmic, 10, true).unwrap();
        assert_eq!(labels(&range), ["1", "2", "5", "10", "20"]);
        let places = [0.03, 0.4].map(|x| place(x, Logarithmic).unwrap());
        let range = Range::around(places, Logarithmic, 10, true).unwrap();
        assert_eq!(labels(&range), ["0.05", "0.1", "0.2"]);
    }

    #[test]
    fn places_exist_for_what_can_be_drawn() {
        assert_eq!(place(100.0, Logarithmic), Some(2.0));
        for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(place(value, Logarithmic), None);
        }
        assert_eq!(place(-1.0, Linear), Some(-1.0));
        assert_eq!(Range::around([], Linear, 5, false), None);
    }
}

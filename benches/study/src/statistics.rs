//! Order statistics of repeated measurements: what a disturbed machine leaves standing.

/// The least of a set of measurements, its middle and how far its halves reach.
///
/// Whatever else a machine does makes a run slower: the least is what the work takes, and the
/// quartiles say how far measurements are from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quartiles {
    /// The least of the measurements.
    pub least: f64,
    /// A quarter of the measurements is at most this.
    pub lower: f64,
    /// Half of the measurements is at most this.
    pub median: f64,
    /// Three quarters of the measurements are at most this.
    pub upper: f64,
    /// How many measurements there were.
    pub count: usize,
}

impl Quartiles {
    /// The quartiles of a set; `None` where it is empty or holds a NaN.
    #[must_use]
    pub fn of(measurements: &[f64]) -> Option<Self> {
        if measurements.is_empty() || measurements.iter().any(|x| x.is_nan()) {
            return None;
        }
        let mut sorted = measurements.to_vec();
        sorted.sort_by(f64::total_cmp);
        Some(Self {
            least: quantile(&sorted, 0.0),
            lower: quantile(&sorted, 0.25),
            median: quantile(&sorted, 0.5),
            upper: quantile(&sorted, 0.75),
            count: sorted.len(),
        })
    }
}

/// The quantile of a sorted set that is not empty, linear between neighbours.
fn quantile(sorted: &[f64], fraction: f64) -> f64 {
    let place = fraction * (sorted.len() - 1) as f64;
    let below = place.floor() as usize;
    let above = (below + 1).min(sorted.len() - 1);
    sorted[below] + (place - below as f64) * (sorted[above] - sorted[below])
}

/// The largest absolute value; NaN as soon as one of them is NaN; zero for none.
#[must_use]
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |largest: f64, value| {
        if largest.is_nan() || value.is_nan() {
            f64::NAN
        } else {
            largest.max(value.abs())
        }
    })
}

#[cfg(test)]
mod tests {
    use super::{Quartiles, largest};

    #[test]
    fn quartiles_of_odd_and_even_sets() {
        let odd = Quartiles::of(&[5.0, 1.0, 3.0]).unwrap();
        assert_eq!(
            (odd.least, odd.lower, odd.median, odd.upper, odd.count),
            (1.0, 2.0, 3.0, 4.0, 3)
        );
        let even = Quartiles::of(&[4.0, 1.0, 3.0, 2.0]).unwrap();
        assert_eq!((even.lower, even.median, even.upper), (1.75, 2.5, 3.25));
        assert_eq!(Quartiles::of(&[7.0]).unwrap().upper, 7.0);
    }

    #[test]
    fn one_outlier_does_not_move_the_median() {
        let quiet = Quartiles::of(&[1.0, 2.0, 3.0, 4.0, 5.0]).unwrap();
        let loud = Quartiles::of(&[1.0, 2.0, 3.0, 4.0, 5e9]).unwrap();
        assert_eq!(quiet.median, loud.median);
    }

    #[test]
    fn nothing_and_nan_have_no_quartiles() {
        assert!(Quartiles::of(&[]).is_none());
        assert!(Quartiles::of(&[1.0, f64::NAN]).is_none());
    }

    #[test]
    fn nan_travels_through_the_largest() {
        assert_eq!(largest([1.0, -3.0, 2.0]), 3.0);
        assert!(largest([1.0, f64::NAN, 2.0]).is_nan());
        assert_eq!(largest([]), 0.0);
    }
}

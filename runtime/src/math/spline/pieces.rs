//! The pieces of a spline over any numbers.

use crate::math::scalar::Scalar;

/// Which derivative.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// The value itself.
    Value,
    /// The first.
    Slope,
    /// The second.
    Curvature,
}

/// What a number of a table is.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Part {
    End,
    Knot,
    Value,
    Slope,
}

/// The ends of a piece: knot, value and slope of either.
type Piece<S> = [[S; 3]; 2];

/// Values or derivatives of the spline of `count` points whose numbers `at` gives.
///
/// Where lanes lie in different pieces, each chooses its own by a comparison with every knot.
#[inline]
pub(super) fn evaluate<S: Scalar, const K: usize>(
    count: usize,
    at: impl Fn(Part, usize) -> S,
    orders: [Order; K],
    x: S,
) -> [S; K] {
    let last = count.saturating_sub(1);
    let (first_knot, last_knot) = (at(Part::Knot, 0), at(Part::Knot, last));
    // Into the first period; where there is none, both factors are zero.
    let [period, inverse, before, after] = [0, 1, 2, 3].map(|k| at(Part::End, k));
    let turns = (x - first_knot).fused(inverse, -S::constant(0.5)).round();
    let x = x - turns * period;
    let point = |k| [Part::Knot, Part::Value, Part::Slope].map(|part| at(part, k));
    let piece = |k| [point(k), point(k + 1)];
    let inner = last.saturating_sub(1);
    let within = match x.bounds_passed(inner, |k| at(Part::Knot, k + 1)) {
        Some(place) => piece(place),
        None => {
            let mut chosen = piece(0);
            for k in 1..=inner {
                let [knot, ..] = point(k);
                let (other, former) = (piece(k), chosen);
                chosen = [0, 1].map(|end| {
                    [0, 1, 2].map(|part: usize| x.select(knot, former[end][part], other[end][part]))
                });
            }
            chosen
        }
    };
    let outside = |order, end: usize, knot: S, slope: S| match order {
        Order::Value => slope.fused(x - knot, at(Part::Value, end)),
        Order::Slope => slope,
        // A number of its kind, so that NaN travels.
        Order::Curvature => S::zero() * (x * slope),
    };
    orders.map(|order| {
        let inside = cubic(within, order, x);
        let behind = last_knot.select(x, outside(order, last, last_knot, after), inside);
        x.select(first_knot, outside(order, 0, first_knot, before), behind)
    })
}

/// A cubic by values and slopes at its ends.
#[inline]
fn cubic<S: Scalar>([from, to]: Piece<S>, order: Order, x: S) -> S {
    let ([x0, y0, d0], [x1, y1, d1]) = (from, to);
    let inverse = (x1 - x0).reciprocal();
    let chord = (y1 - y0) * inverse;
    let (two, three) = (S::constant(2.0), S::constant(3.0));
    // y0 + s (d0 + s (b + s c))
    let s = x - x0;
    let b = (three * chord - two * d0 - d1) * inverse;
    let c = (d0 + d1 - two * chord) * inverse * inverse;
    match order {
        Order::Value => s.fused(s.fused(s.fused(c, b), d0), y0),
        Order::Slope => s.fused(s.fused(three * c, two * b), d0),
        Order::Curvature => two * s.fused(three * c, b),
    }
}

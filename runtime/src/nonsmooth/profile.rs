//! Profiles of plane cams by their support function, and which tangent of one faces a point.
//!
//! A point `p` outside of a convex curve is at the distance `max f`, over all angles, with
//! `f = p u - h`. The slope of that by the angle is `f' = p u' - h'`, and that of `f'` is
//! `-(f + rho)` with the radius of curvature `rho`. So Newton's method has one maximum to find
//! wherever `f > 0`.

use core::f64::consts::{FRAC_PI_2, PI, TAU};
use core::fmt;

use crate::math::scalar::Scalar;
use crate::math::spline::radii::Lasting;
use crate::math::spline::{Order, Spline, Table};

/// A period that differs from a turn by no more (rad): knots are sums, or were degrees.
const OF_TURN: f64 = 1e-12;

/// How often the range of angles is halved: from half a turn to a 40th of a rad.
const HALVINGS: usize = 7;

/// Steps of Newton's method within what is left of it.
const WITHIN: usize = 5;

/// A step may leave the range by so much (rad): by round-off, where it is at its end.
const SLACK: f64 = 1e-6;

/// Further steps. They bring nothing but round-off to the angle, and the derivatives of numbers
/// that carry some.
const BEHIND: usize = 2;

/// The support function (m) of a convex curve over the angle (rad) of its normal.
#[derive(Clone, Copy)]
pub(crate) struct Profile(&'static dyn Lasting);

/// The same one, wherever it is copied to.
impl PartialEq for Profile {
    fn eq(&self, other: &Self) -> bool {
        core::ptr::addr_eq(self.0, other.0)
    }
}

impl Eq for Profile {}

impl fmt::Debug for Profile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.table().fmt(f)
    }
}

impl Profile {
    pub(super) fn of<const N: usize>(spline: &'static Spline<N>) -> Self {
        Self(spline)
    }

    /// The largest of its lengths (m).
    pub(super) fn reach(self) -> f64 {
        self.0.table().largest()
    }

    /// What is not acceptable of it, by its setting.
    pub(super) fn check(self) -> Result<(), (&'static str, f64)> {
        let table = self.0.table();
        if table.fault().is_some() {
            return Err(("profile", f64::NAN));
        }
        if (table.period() - TAU).abs() > OF_TURN {
            return Err(("period of a profile", table.period()));
        }
        let radius = table.least_radius();
        if radius > 0.0 && radius.is_finite() {
            Ok(())
        } else {
            Err(("least radius of curvature", radius))
        }
    }

    /// The point (m) where a normal is the outward one; of components along the zero direction and
    /// a quarter of a turn ahead, and of length 1.
    pub(super) fn point<S: Scalar>(self, normal: [S; 2]) -> [S; 2] {
        let [x, y] = normal;
        Tangent::of(&self.0.table(), y.atan2(x), normal).point()
    }

    /// The angle (rad) of the normal through a point (m) outside, and the support function (m)
    /// there. Of a point within, that of some tangent.
    pub(super) fn facing<S: Scalar>(self, point: [S; 2]) -> [S; 2] {
        let table = self.0.table();
        let at = |angle| Tangent::at(&table, angle);
        let (half, slack) = (S::constant(0.5), S::constant(SLACK));
        let middle = |a: S, b: S| half * (a + b);
        // Any point within.
        let [x, y] = {
            let ([ax, ay], [bx, by]) = (at(S::zero()).point(), at(S::constant(PI)).point());
            [middle(ax, bx), middle(ay, by)]
        };
        // Seen from there the point is less than a quarter of a turn from its normal.
        let [px, py] = point;
        let ahead = (py - y).atan2(px - x);
        let behind = at(ahead + S::constant(PI)).point();
        let quarter = S::constant(FRAC_PI_2);
        let [mut low, mut high, mut angle] = [ahead - quarter, ahead + quarter, ahead];
        for round in 0..HALVINGS + WITHIN {
            let tangent = at(angle);
            let way = tangent.way_to_normal(point, behind);
            low = way.select(S::zero(), low, angle);
            high = way.select(S::zero(), angle, high);
            let halved = middle(low, high);
            angle = if round < HALVINGS {
                halved
            } else {
                let next = angle + tangent.step(point);
                let next = next.select(low - slack, halved, next);
                (high + slack).select(next, halved, next)
            };
        }
        for _ in 0..BEHIND {
            angle = angle + at(angle).step(point);
        }
        [angle, table.evaluate(Order::Value, angle)]
    }
}

/// A tangent of a profile.
struct Tangent<S> {
    /// Its outward normal.
    normal: [S; 2],
    /// The support function (m), and its first two derivatives by the angle.
    height: S,
    slope: S,
    curvature: S,
}

impl<S: Scalar> Tangent<S> {
    fn at(table: &Table<'_>, angle: S) -> Self {
        Self::of(table, angle, [angle.cos(), angle.sin()])
    }

    fn of(table: &Table<'_>, angle: S, normal: [S; 2]) -> Self {
        let orders = [Order::Value, Order::Slope, Order::Curvature];
        let [height, slope, curvature] = table.evaluate_each(orders, angle);
        Self {
            normal,
            height,
            slope,
            curvature,
        }
    }

    /// Where it touches.
    fn point(&self) -> [S; 2] {
        let ([x, y], h, slope) = (self.normal, self.height, self.slope);
        [h * x - slope * y, h * y + slope * x]
    }

    /// How far a point is beyond it, and along it from where it touches.
    fn seen(&self, [px, py]: [S; 2]) -> [S; 2] {
        let [x, y] = self.normal;
        let beyond = px.fused(x, py * y) - self.height;
        [beyond, py.fused(x, -(px * y)) - self.slope]
    }

    /// A number with the sign of the way (rad) from here to the normal through a point outside;
    /// `behind` is a point of the curve that is not seen from there.
    fn way_to_normal(&self, point: [S; 2], behind: [S; 2]) -> S {
        let [beyond, along] = self.seen(point);
        // Where this one is not seen either, the chord between both leaves all that is seen, and
        // the point, on one side.
        let ([px, py], [x, y], [bx, by]) = (point, self.point(), behind);
        let side = (x - bx) * (py - by) - (y - by) * (px - bx);
        beyond.select(S::zero(), side, along)
    }

    /// A step of Newton's method: the angle between this normal and the direction of a point from
    /// the centre of curvature, so that it is exact on an arc.
    fn step(&self, point: [S; 2]) -> S {
        let [beyond, along] = self.seen(point);
        along.atan2(beyond + self.height + self.curvature)
    }
}

#[cfg(test)]
mod tests;

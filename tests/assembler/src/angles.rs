//! The angle of one body against another about an axis, with its turns counted.
//!
//! With `n1`, `n2`, `a` a right-handed frame in the reference configuration, `n1` and `n2` fixed on
//! body `i` and `m`, which is `n1` there, fixed on body `j`:
//!
//! ```text
//! x = n1 . m    y = n2 . m    s' = a . (w_j - w_i)
//! theta = atan2(y, x) + 2 pi round((s - atan2(y, x)) / 2 pi)
//! theta' = (x y' - y x') / c    c = x^2 + y^2
//! theta'' = (x y'' - y x'') / c - 2 (x y' - y x') (x x' + y y') / c^2
//! ```
//!
//! by the quotient rule alone, so that it holds off the constraints as well; the lengths of `p`
//! cancel in `theta`. The auxiliary state `s` only decides the number of turns: half a turn of
//! error in it does no harm. The gradient is that of the product `b . m` with
//! `b = (x n2 - y n1) / c` fixed on body `i` while `x`, `y` and `c` are held. Source: Haug (1989),
//! chapter 9 (relative angle of two bodies, its count of turns).

use core::f64::consts::TAU;

use nalgebra::Vector3;

use crate::kinematics::{Kinematics, Mark};

/// An angle between two bodies (rad): positive if `j` turns by the right hand about the axis
/// against `i`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Angle {
    /// `n1` and `n2` on body `i`.
    pub normals: [Mark; 2],
    /// `m` on body `j`.
    pub pointer: Mark,
    /// `a` on body `i`, for the auxiliary state.
    pub axis: Mark,
    /// Its place among the auxiliary states; without one the angle is between -pi and pi.
    pub(crate) slot: Option<usize>,
}

/// `x`, `y` and their rates.
struct Pair {
    x: f64,
    y: f64,
    x_rate: f64,
    y_rate: f64,
}

impl Pair {
    fn new(angle: &Angle, at: &Kinematics) -> Self {
        let [n1, n2] = angle.normals.map(|n| n.vector(at));
        let [n1_rate, n2_rate] = angle.normals.map(|n| n.vector_rate(at));
        let (m, m_rate) = (angle.pointer.vector(at), angle.pointer.vector_rate(at));
        Self {
            x: n1.dot(&m),
            y: n2.dot(&m),
            x_rate: n1_rate.dot(&m) + n1.dot(&m_rate),
            y_rate: n2_rate.dot(&m) + n2.dot(&m_rate),
        }
    }

    fn square(&self) -> f64 {
        self.x * self.x + self.y * self.y
    }

    /// `x y' - y x'`.
    fn sweep(&self) -> f64 {
        self.x * self.y_rate - self.y * self.x_rate
    }
}

/// The angle that differs from `principal` by whole turns and is nearest to `near` (rad).
#[must_use]
pub fn counted(principal: f64, near: f64) -> f64 {
    principal + TAU * ((near - principal) / TAU).round()
}

impl Angle {
    /// An angle that is not counted yet: a joint or a force gives it an auxiliary state where it is
    /// added.
    #[must_use]
    pub const fn new(normals: [Mark; 2], pointer: Mark, axis: Mark) -> Self {
        Self {
            normals,
            pointer,
            axis,
            slot: None,
        }
    }

    /// `atan2(y, x)`, between -pi and pi.
    #[must_use]
    pub fn principal(&self, at: &Kinematics) -> f64 {
        let pair = Pair::new(self, at);
        pair.y.atan2(pair.x)
    }

    /// `theta`.
    #[must_use]
    pub fn value(&self, at: &Kinematics) -> f64 {
        let principal = self.principal(at);
        self.slot
            .map_or(principal, |slot| counted(principal, at.turns[slot]))
    }

    /// `theta'`.
    #[must_use]
    pub fn rate(&self, at: &Kinematics) -> f64 {
        let pair = Pair::new(self, at);
        pair.sweep() / pair.square()
    }

    /// `theta''` at `u' = 0`.
    #[must_use]
    pub fn curvature(&self, at: &Kinematics) -> f64 {
        let pair = Pair::new(self, at);
        let (m, m_rate) = (self.pointer.vector(at), self.pointer.vector_rate(at));
        let m_curvature = self.pointer.curvature(at);
        let [x_curvature, y_curvature] = self.normals.map(|n| {
            n.curvature(at).dot(&m)
                + 2.0 * n.vector_rate(at).dot(&m_rate)
                + n.vector(at).dot(&m_curvature)
        });
        let growth = pair.x * pair.x_rate + pair.y * pair.y_rate;
        let square = pair.square();
        (pair.x * y_curvature - pair.y * x_curvature) / square
            - 2.0 * pair.sweep() * growth / (square * square)
    }

    /// The rate of the auxiliary state, `a . (A_j w_j - A_i w_i)` with `A` as it is read.
    #[must_use]
    pub fn turning_rate(&self, at: &Kinematics) -> f64 {
        let [i, j] = [self.axis.body, self.pointer.body].map(|body| at.frame(body));
        self.axis
            .vector(at)
            .dot(&(j.rotation * j.rate - i.rotation * i.rate))
    }

    /// Hands `factor` times the gradient to `add`.
    pub(crate) fn gradient(
        &self,
        at: &Kinematics,
        factor: f64,
        add: &mut impl FnMut(usize, &Vector3<f64>),
    ) {
        let pair = Pair::new(self, at);
        let [n1, n2] = &self.normals;
        let scale = factor / pair.square();
        let b = Mark {
            local: scale * (pair.x * n2.local - pair.y * n1.local),
            ..*n1
        };
        b.vector_gradient(at, &self.pointer.vector(at), add);
        self.pointer.vector_gradient(at, &b.vector(at), add);
    }
}

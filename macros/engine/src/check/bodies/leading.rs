//! Rotations that lead an axis of a body to a direction, which may depend on parameters.

use quote::ToTokens;
use syn::Expr;

use super::formula::{difference, is_zero, length, negative, number, sum};
use super::reader::Reader;

impl Reader<'_, '_> {
    /// Euler parameters, of any length, of a rotation that leads an axis of the body to a
    /// direction.
    ///
    /// Which of the many? In the plane of the axis `a` and the next one `b`, the third axis `c`
    /// stays where it is. In that of `a` and `c`, the second does. In that of `b` and `c` the axes
    /// are renamed first, so that `c` becomes `a`. So a mechanism in a coordinate plane has its
    /// normal as an axis of all bodies, whatever lengths are parameters. Elsewhere it is the least
    /// rotation. What leads backwards begins with half a turn.
    pub(super) fn leading(
        &mut self,
        at: impl ToTokens,
        axis: usize,
        d: &[Expr; 3],
    ) -> Option<[Expr; 4]> {
        let nonzero: Vec<usize> = (0..3).filter(|&k| !self.is_no_part(&d[k])).collect();
        let seen = d.each_ref().map(|part| self.glance(part));
        if nonzero.is_empty() || seen.iter().all(|part| *part == Some(0.0)) {
            self.faults
                .at(at, "there is no direction between points that are one");
            return None;
        }
        // Of one component the sign matters, and its size may be a parameter.
        let d: [Expr; 3] = match nonzero[..] {
            [only] => [0, 1, 2].map(|k| match seen[only] {
                _ if k != only => number(0.0),
                Some(value) if value < 0.0 => number(-1.0),
                _ => number(1.0),
            }),
            _ => [0, 1, 2].map(|k| {
                if nonzero.contains(&k) {
                    d[k].clone()
                } else {
                    number(0.0)
                }
            }),
        };
        let (a, b, c) = (axis, (axis + 1) % 3, (axis + 2) % 3);
        let is_zero = |k: usize| !nonzero.contains(&k);
        let (start, half, is_renamed) = if is_zero(c) {
            (a, c, false)
        } else if is_zero(b) {
            (a, b, false)
        } else if is_zero(a) {
            (b, a, true)
        } else {
            (a, c, false)
        };
        let backwards = seen[start].is_some_and(|part| part < 0.0);
        let size = length(&d);
        let (next, last) = ((start + 1) % 3, (start + 2) % 3);
        let mut p = [number(0.0), number(0.0), number(0.0), number(0.0)];
        // The axis at the start times the direction.
        if backwards {
            p[0] = difference(&size, &d[start]);
            p[next + 1] = d[last].clone();
            p[last + 1] = negative(&d[next]);
            let mut turn = [0.0; 4];
            turn[half + 1] = 1.0;
            p = composed(&p, turn);
        } else {
            p[0] = sum(&size, &d[start]);
            p[next + 1] = negative(&d[last]);
            p[last + 1] = d[next].clone();
        }
        if is_renamed {
            p = composed(&p, [1.0; 4]);
        }
        Some(p)
    }

    /// Whether a component is zero, and the macro can see it everywhere.
    fn is_no_part(&mut self, part: &Expr) -> bool {
        let seen = self.numbers.part(part, self.faults);
        is_zero(part) || seen.is_some_and(|part| part.is_written && part.seen == Some(0.0))
    }
}

/// The product with a rotation before it, whose Euler parameters are 0, 1 or -1.
fn composed(p: &[Expr; 4], first: [f64; 4]) -> [Expr; 4] {
    // Rows of the product: `first` with the signs of quaternions.
    let [b0, b1, b2, b3] = first;
    let rows = [
        [b0, -b1, -b2, -b3],
        [b1, b0, b3, -b2],
        [b2, -b3, b0, b1],
        [b3, b2, -b1, b0],
    ];
    rows.map(|row| {
        let mut total = number(0.0);
        for (factor, e) in row.into_iter().zip(p) {
            if factor == 1.0 {
                total = sum(&total, e);
            } else if factor == -1.0 {
                total = sum(&total, &negative(e));
            }
        }
        total
    })
}

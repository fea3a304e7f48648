//! Whether outputs over different arenas are the same functions of some of their nodes.

use super::arena::{Arena, Expr, Stage};

/// Outputs over an arena, as functions of given nodes.
#[derive(Clone, Copy)]
pub(crate) struct Above<'a> {
    pub(crate) arena: &'a Arena,
    pub(crate) outputs: &'a [Expr],
    pub(crate) given: &'a [Expr],
}

impl Above<'_> {
    /// Whether what is computed of the given nodes, and of inputs, is the same operation by operation, in one order.
    pub(crate) fn is_same(self, other: Self) -> bool {
        let live = |above: Self| {
            let given = above.given.iter().map(|expr| expr.node());
            above.arena.live_above(above.outputs, Stage::Literal, given)
        };
        let (own, others) = (live(self), live(other));
        let lengths = |above: Self| [above.outputs.len(), above.given.len()];
        if own.len() != others.len() || lengths(self) != lengths(other) {
            return false;
        }
        // Where each node stands in the other arena.
        let mut places = vec![0_u32; self.arena.len()];
        let mut signs_agree = true;
        for (own, others) in self.given.iter().zip(other.given) {
            places[own.node()] = others.node() as u32;
            signs_agree &= own.is_negative() == others.is_negative();
        }
        for (&own, &others) in own.iter().zip(&others) {
            places[own] = others as u32;
        }
        let moved = |expr: Expr| Expr::new(places[expr.node()], expr.is_negative());
        let same_nodes = own.iter().zip(&others).all(|(&own, &others)| {
            self.arena.node(own).with_operands(moved) == other.arena.node(others)
        });
        let same_outputs = self.outputs.iter().map(|&output| moved(output));
        signs_agree && same_nodes && same_outputs.eq(other.outputs.iter().copied())
    }
}

#[cfg(test)]
mod tests {
    use super::super::arena::Input;
    use super::*;

    /// `2 f(x) + y` for two functions, and `f(x)`.
    fn twice(function: impl Fn(&mut Arena, Expr) -> Expr, factor: f64) -> (Arena, Expr, Expr) {
        let mut arena = Arena::new();
        let x = arena.input(Input::Coordinate(0));
        let value = function(&mut arena, x);
        let y = arena.input(Input::Coordinate(1));
        let factor = arena.constant(factor);
        let product = arena.mul(factor, value);
        let sum = arena.add(product, y);
        (arena, sum, value)
    }

    fn is_same(a: &(Arena, Expr, Expr), b: &(Arena, Expr, Expr)) -> bool {
        let above = |(arena, output, given): &(Arena, Expr, Expr),
                     test: &dyn Fn(Above<'_>) -> bool| {
            test(Above {
                arena,
                outputs: &[*output],
                given: &[*given],
            })
        };
        above(a, &|a| above(b, &|b| a.is_same(b)))
    }

    #[test]
    fn only_what_is_above_the_given_nodes_counts() {
        let sine = twice(Arena::sin, 2.0);
        let power = twice(
            |arena, x| {
                let square = arena.square(x);
                arena.mul(x, square)
            },
            2.0,
        );
        assert!(is_same(&sine, &power));
        assert!(!is_same(&sine, &twice(Arena::sin, 3.0)));
        assert!(!is_same(&sine, &twice(|arena, x| -arena.sin(x), 2.0)));
    }
}

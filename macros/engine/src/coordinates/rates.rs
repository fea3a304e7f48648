//! The rates of the coordinates.

use super::freedom::Freedom;
use super::system::Reduced;
use crate::symbolic::arena::{Arena, Expr, Input};
use crate::symbolic::equations::euler_rates;

/// The rates of the pairs' angles, then of the further coordinates.
pub(super) fn coordinate_rates(reduced: &mut Reduced) -> Vec<Expr> {
    let Reduced { links, scene, .. } = reduced;
    let arena = &mut scene.space.arena;
    let mut rates = vec![Arena::ZERO; links.turns + links.rest];
    for link in &links.links {
        let mut rate = |k: usize| arena.input(Input::Velocity((link.velocity + k) as u32));
        match link.freedom {
            Freedom::Turn { pair, .. } | Freedom::Screw { pair, .. } => rates[pair] = rate(0),
            Freedom::Slide { rest, .. } => rates[links.turns + rest] = rate(0),
            Freedom::Ball { rest } => {
                let w = [0, 1, 2].map(rate);
                let first = 2 * links.turns + rest;
                let p = [0, 1, 2, 3].map(|k| arena.input(Input::Coordinate((first + k) as u32)));
                let of = euler_rates(arena, p, w);
                rates[links.turns + rest..links.turns + rest + 4].copy_from_slice(&of);
            }
        }
    }
    rates
}

//! Sums over accelerations that know nothing of each other, as short as they can be.

use crate::symbolic::arena::{Arena, Expr, Node};

/// A number and what it is a multiple of.
fn peeled(arena: &Arena, expr: Expr) -> (f64, Expr) {
    let sign = if expr.is_negative() { -1.0 } else { 1.0 };
    if let Some(number) = arena.literal(expr) {
        return (number, Arena::ONE);
    }
    if let Node::Multiply(a, b) = arena.get(expr) {
        for (number, rest) in [(a, b), (b, a)] {
            if let Some(number) = arena.literal(number) {
                return (sign * number, rest);
            }
        }
    }
    (sign, expr.abs())
}

/// `sum_k a_k b_k`. Numbers come last, so that sums that differ by them have the rest in common.
pub(super) fn sum_of_products(arena: &mut Arena, a: &[Expr], b: &[Expr]) -> Expr {
    let (mut sum, mut number) = (Arena::ZERO, Arena::ZERO);
    for (&a, &b) in a.iter().zip(b) {
        let product = arena.mul(a, b);
        let of = if arena.literal(product).is_some() {
            &mut number
        } else {
            &mut sum
        };
        *of = arena.add(*of, product);
    }
    arena.add(sum, number)
}

/// `sum_k a_k b_k`. Where all products have the same factor, they are summed before, if that is
/// cheaper.
pub(super) fn shortest_dot(arena: &mut Arena, a: &[Expr], b: &[Expr]) -> Expr {
    let ones = vec![Arena::ONE; a.len()];
    through(arena, &ones, a, b)
}

/// `sum_k a_k b_k / m_k` for given `1 / m_k`. Products with the same factor are summed before,
/// where that is cheaper.
pub(super) fn through(arena: &mut Arena, inverses: &[Expr], a: &[Expr], b: &[Expr]) -> Expr {
    let plain = |arena: &mut Arena| {
        let scaled = a.iter().zip(inverses);
        let scaled: Vec<Expr> = scaled.map(|(&a, &inverse)| arena.mul(a, inverse)).collect();
        sum_of_products(arena, &scaled, b)
    };
    let Some(groups) = groups(arena, inverses, a, b) else {
        return plain(arena);
    };
    let mark = arena.mark();
    plain(arena);
    let operations = arena.operations_since(mark);
    arena.rollback(mark);
    collected(arena, &groups);
    let is_cheaper = arena.operations_since(mark) < operations;
    arena.rollback(mark);
    if is_cheaper {
        collected(arena, &groups)
    } else {
        plain(arena)
    }
}

/// A number, and what it is to be multiplied with: a sum of products.
type Group = (f64, Vec<(Expr, Expr)>);

/// Products by their factors; none where all factors differ or one is not known.
fn groups(arena: &Arena, inverses: &[Expr], a: &[Expr], b: &[Expr]) -> Option<Vec<Group>> {
    let mut groups: Vec<Group> = Vec::new();
    for ((&a, &b), &inverse) in a.iter().zip(b).zip(inverses) {
        if a == Arena::ZERO || b == Arena::ZERO {
            continue;
        }
        let ((p, a), (q, b)) = (peeled(arena, a), peeled(arena, b));
        let factor = arena.literal(inverse)? * p * q;
        if !factor.is_normal() {
            return None;
        }
        let a = if factor < 0.0 { -a } else { a };
        match groups.iter_mut().find(|(known, _)| *known == factor.abs()) {
            Some((_, products)) => products.push((a, b)),
            None => groups.push((factor.abs(), vec![(a, b)])),
        }
    }
    // By 1 nothing is multiplied.
    let is_sum = |(factor, products): &Group| *factor != 1.0 && products.len() > 1;
    groups.iter().any(is_sum).then_some(groups)
}

fn collected(arena: &mut Arena, groups: &[Group]) -> Expr {
    let (mut sum, mut number) = (Arena::ZERO, Arena::ZERO);
    for (factor, products) in groups {
        let (a, b): (Vec<Expr>, Vec<Expr>) = products.iter().copied().unzip();
        let rest = sum_of_products(arena, &a, &b);
        let factor = arena.constant(*factor);
        // Of `c (1 - x)` the number goes to the others.
        let (constant, rest) = split(arena, rest);
        let [constant, rest] = [constant, rest].map(|x| arena.mul(factor, x));
        number = arena.add(number, constant);
        sum = arena.add(sum, rest);
    }
    arena.add(sum, number)
}

/// The number and the rest of a sum.
fn split(arena: &Arena, expr: Expr) -> (Expr, Expr) {
    if arena.literal(expr).is_some() {
        return (expr, Arena::ZERO);
    }
    if let Node::Add(a, b) = arena.get(expr) {
        let of = |x: Expr| if expr.is_negative() { -x } else { x };
        if arena.literal(a).is_some() {
            return (of(a), of(b));
        }
        if arena.literal(b).is_some() {
            return (of(b), of(a));
        }
    }
    (Arena::ZERO, expr)
}

/// Terms of a sum of products, those with the same factor but for a number made one:
/// `c a x + d a y = (c a) (x + d / c y)`.
pub(super) fn common(arena: &mut Arena, terms: Vec<(Expr, Expr)>) -> Vec<(Expr, Expr)> {
    let mut sums: Vec<(f64, Expr, Expr, Expr)> = Vec::new();
    for (factor, x) in terms {
        if factor == Arena::ZERO {
            continue;
        }
        let (number, base) = peeled(arena, factor);
        let same = |(first, known, ..): &&mut (f64, Expr, Expr, Expr)| {
            *known == base && base != Arena::ONE && (number / *first).is_normal()
        };
        match sums.iter_mut().find(same) {
            Some((first, _, _, sum)) => {
                let ratio = arena.constant(number / *first);
                let term = arena.mul(ratio, x);
                *sum = arena.add(*sum, term);
            }
            None => sums.push((number, base, factor, x)),
        }
    }
    let terms = sums.into_iter();
    terms.map(|(_, _, factor, sum)| (factor, sum)).collect()
}

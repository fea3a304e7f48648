//! The scalar level: a hash-consed arena of operations.
//!
//! Equal expressions are one node, so what is computed twice is computed once. Constants fold when
//! a node is made; signs stand outside the nodes, so that `a - b` and `b - a` are one node and
//! negation costs nothing. Ids are topological by construction: operands come before the node, and
//! no pass needs recursion.
//!
//! Only what has a number folds: `1 / 0`, an overflow or an underflow stay operations, and what is
//! made of them is not simplified, so that the kernels show what it is (`0 / 0` is not 1,
//! `0 * (1 / 0)` is not 0).

use std::collections::BTreeMap;

use super::index::Index;
use super::node::side;
pub use super::node::{Expr, Input, Node, Stage};
use crate::model::Curve;

/// A place in the history of an arena, to come back to.
#[derive(Clone, Copy, Debug)]
pub struct Mark(usize);

/// All nodes of one kernel.
#[derive(Clone, Debug)]
pub struct Arena {
    nodes: Vec<Node>,
    stages: Vec<Stage>,
    /// Whether the nodes are made of an operation on numbers that has none.
    without_number: Vec<bool>,
    index: Index,
    /// Nodes that are other expressions, and these.
    identified: Index,
    identities: Vec<Expr>,
    labels: BTreeMap<u32, String>,
}

impl Default for Arena {
    fn default() -> Self {
        Self::new()
    }
}

impl Arena {
    /// Zero, which every arena holds.
    pub const ZERO: Expr = Expr::new(0, false);
    /// One, which every arena holds.
    pub const ONE: Expr = Expr::new(1, false);

    /// An arena with zero and one.
    #[must_use]
    pub fn new() -> Self {
        let mut arena = Self {
            nodes: Vec::new(),
            stages: Vec::new(),
            without_number: Vec::new(),
            index: Index::default(),
            identified: Index::default(),
            identities: Vec::new(),
            labels: BTreeMap::new(),
        };
        arena.intern(Node::Constant(0.0_f64.to_bits()));
        arena.intern(Node::Constant(1.0_f64.to_bits()));
        arena
    }

    /// The operation behind a reference.
    #[inline(always)]
    #[must_use]
    pub fn get(&self, expr: Expr) -> Node {
        self.nodes.as_slice()[expr.node()]
    }

    /// When the value is known.
    #[inline(always)]
    #[must_use]
    pub fn stage(&self, expr: Expr) -> Stage {
        self.stages.as_slice()[expr.node()]
    }

    /// The number of nodes.
    #[must_use]
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether the arena holds no operation.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() <= 2
    }

    /// The value where it is known at expansion.
    #[must_use]
    pub fn literal(&self, expr: Expr) -> Option<f64> {
        match self.get(expr) {
            Node::Constant(bits) => {
                let value = f64::from_bits(bits);
                Some(if expr.is_negative() { -value } else { value })
            }
            _ => None,
        }
    }

    /// The name given to a node.
    #[must_use]
    pub fn label(&self, node: usize) -> Option<&str> {
        self.labels.get(&(node as u32)).map(String::as_str)
    }

    /// Names a node after its origin; the first name stays.
    pub fn name(&mut self, expr: Expr, label: impl FnOnce() -> String) {
        if self.get(expr).is_operation() {
            self.labels.entry(expr.node() as u32).or_insert_with(label);
        }
    }

    /// The present place, for [`Arena::rollback`].
    #[must_use]
    pub fn mark(&self) -> Mark {
        Mark(self.nodes.len())
    }

    /// Forgets every node made since the mark.
    pub fn rollback(&mut self, mark: Mark) {
        self.index.truncate(mark.0);
        self.nodes.truncate(mark.0);
        self.labels.split_off(&(mark.0 as u32));
        self.stages.truncate(mark.0);
        self.without_number.truncate(mark.0);
    }

    /// The operations among the nodes made since the mark that are not known before the state is.
    #[must_use]
    pub fn operations_since(&self, mark: Mark) -> usize {
        (mark.0..self.nodes.len())
            .filter(|&node| self.stages[node] >= Stage::State && self.nodes[node].is_operation())
            .count()
    }

    /// Declares that a node, wherever it is made from now on, is another expression.
    pub fn identify(&mut self, expr: Expr, with: Expr) {
        let node = self.get(expr);
        if node.is_operation() && expr.node() != with.node() {
            let with = with.with_sign_of(expr.is_negative());
            match self.identified.find(node.key()) {
                Some(known) => self.identities[known as usize] = with,
                None => {
                    self.identified.push(node.key());
                    self.identities.push(with);
                }
            }
        }
    }

    fn intern(&mut self, node: Node) -> Expr {
        if let Some(known) = self.identified.find(node.key()) {
            return self.identities[known as usize];
        }
        if let Some(place) = self.index.find(node.key()) {
            return Expr::new(place, false);
        }
        let place = u32::try_from(self.nodes.len()).expect("fewer than 2^31 nodes");
        let (stage, without_number) = match node {
            Node::Constant(_) => (Stage::Literal, false),
            Node::Input(input) => (input.stage(), false),
            _ => self.of_operation(node),
        };
        self.nodes.push(node);
        self.stages.push(stage);
        self.without_number.push(without_number);
        self.index.push(node.key());
        Expr::new(place, false)
    }

    /// The stage of an operation, and whether it is made of one on numbers that has none.
    fn of_operation(&self, node: Node) -> (Stage, bool) {
        let (mut latest, mut without_number) = (Stage::Literal, false);
        let mut see = |operand: Option<Expr>| {
            if let Some(operand) = operand {
                latest = latest.with(self.stage(operand));
                without_number |= self.is_without_number(operand);
            }
        };
        let (first, second) = node.pair();
        see(first);
        see(second);
        if matches!(node, Node::Curve(..)) {
            return (latest.with(Stage::State), without_number);
        }
        match latest {
            // An operation on literals that did not fold is left to the kernels, whose results show
            // it.
            Stage::Literal => (Stage::State, true),
            stage => (stage, without_number),
        }
    }

    #[inline(always)]
    fn is_without_number(&self, expr: Expr) -> bool {
        self.without_number.as_slice()[expr.node()]
    }

    /// A number known at expansion.
    ///
    /// # Panics
    /// If it is not finite.
    pub fn constant(&mut self, value: f64) -> Expr {
        assert!(
            value.is_finite(),
            "a constant is a finite number, not {value}"
        );
        let magnitude = self.intern(Node::Constant(value.abs().to_bits()));
        magnitude.with_sign_of(value < 0.0)
    }

    /// A number known later.
    pub fn input(&mut self, input: Input) -> Expr {
        self.intern(Node::Input(input))
    }

    /// `a + b`.
    pub fn add(&mut self, a: Expr, b: Expr) -> Expr {
        if a == Self::ZERO {
            return b;
        }
        if b == Self::ZERO {
            return a;
        }
        if a == -b && !self.is_without_number(a) {
            return Self::ZERO;
        }
        if a == b {
            let two = self.constant(2.0);
            return self.mul(two, a);
        }
        if let (Some(x), Some(y)) = (self.literal(a), self.literal(b))
            && (x + y).is_finite()
        {
            return self.constant(x + y);
        }
        if let Some(folded) = self
            .merge_constant_sum(a, b)
            .or_else(|| self.merge_constant_sum(b, a))
        {
            return folded;
        }
        let (first, second) = if a.node() < b.node() { (a, b) } else { (b, a) };
        let negative = first.is_negative();
        let sum = self.intern(Node::Add(first.abs(), second.with_sign_of(negative)));
        sum.with_sign_of(negative)
    }

    /// `c1 + (c2 + x)` is `(c1 + c2) + x`.
    fn merge_constant_sum(&mut self, constant: Expr, sum: Expr) -> Option<Expr> {
        let outer = self.literal(constant)?;
        let Node::Add(x, y) = self.get(sum) else {
            return None;
        };
        let (inner, rest) = match (self.literal(x), self.literal(y)) {
            (Some(inner), _) => (inner, y),
            (_, Some(inner)) => (inner, x),
            _ => return None,
        };
        let sign = sum.is_negative();
        let merged = outer + if sign { -inner } else { inner };
        if !merged.is_finite() {
            return None;
        }
        let inner = self.constant(merged);
        Some(self.add(inner, rest.with_sign_of(sign)))
    }

    /// `a - b`.
    pub fn sub(&mut self, a: Expr, b: Expr) -> Expr {
        self.add(a, -b)
    }

    /// `a b`.
    pub fn mul(&mut self, a: Expr, b: Expr) -> Expr {
        let negative = a.is_negative() != b.is_negative();
        let (a, b) = (a.abs(), b.abs());
        let is_zero = |a: Expr, b: Expr| a == Self::ZERO && !self.is_without_number(b);
        if is_zero(a, b) || is_zero(b, a) {
            return Self::ZERO;
        }
        if a == Self::ONE {
            return b.with_sign_of(negative);
        }
        if b == Self::ONE {
            return a.with_sign_of(negative);
        }
        if let (Some(x), Some(y)) = (self.literal(a), self.literal(b))
            && (x * y).is_normal()
        {
            return self.constant(x * y).with_sign_of(negative);
        }
        let product = self
            .merge_constant_product(a, b)
            .or_else(|| self.merge_constant_product(b, a))
            .unwrap_or_else(|| {
                let (first, second) = if a.node() < b.node() { (a, b) } else { (b, a) };
                self.intern(Node::Multiply(first, second))
            });
        product.with_sign_of(negative)
    }

    /// `c1 (c2 x)` is `(c1 c2) x`.
    fn merge_constant_product(&mut self, constant: Expr, product: Expr) -> Option<Expr> {
        let outer = self.literal(constant)?;
        let Node::Multiply(x, y) = self.get(product) else {
            return None;
        };
        let (inner, rest) = match (self.literal(x), self.literal(y)) {
            (Some(inner), _) => (inner, y),
            (_, Some(inner)) => (inner, x),
            _ => return None,
        };
        if !(outer * inner).is_normal() {
            return None;
        }
        let merged = self.constant(outer * inner);
        Some(self.mul(merged, rest))
    }

    /// `a^2`.
    pub fn square(&mut self, a: Expr) -> Expr {
        self.mul(a, a)
    }

    /// `1 / a`.
    pub fn reciprocal(&mut self, a: Expr) -> Expr {
        let negative = a.is_negative();
        let a = a.abs();
        let result = match self.get(a) {
            Node::Constant(bits) if f64::from_bits(bits).recip().is_normal() => {
                self.constant(f64::from_bits(bits).recip())
            }
            Node::Reciprocal(inner) if !self.is_without_number(a) => inner,
            _ => self.intern(Node::Reciprocal(a)),
        };
        result.with_sign_of(negative)
    }

    /// `a / b`: one reciprocal per divisor, shared by all dividends.
    pub fn div(&mut self, a: Expr, b: Expr) -> Expr {
        if a == b && a != Self::ZERO && !self.is_without_number(a) {
            return Self::ONE;
        }
        let reciprocal = self.reciprocal(b);
        self.mul(a, reciprocal)
    }

    /// The square root.
    pub fn sqrt(&mut self, a: Expr) -> Expr {
        match self.literal(a) {
            Some(value) if value >= 0.0 => self.constant(value.sqrt()),
            _ => self.intern(Node::SquareRoot(a)),
        }
    }

    /// -1 where `a` is negative, else 1.
    pub fn sign(&mut self, a: Expr) -> Expr {
        match self.literal(a) {
            Some(value) => self.constant(if value < 0.0 { -1.0 } else { 1.0 }),
            None => self.intern(Node::Sign(a)),
        }
    }

    /// `a`, at least 0 and at most 1.
    pub fn clamp(&mut self, a: Expr) -> Expr {
        match self.literal(a) {
            Some(value) => self.constant(value.clamp(0.0, 1.0)),
            None => self.intern(Node::Clamp(a)),
        }
    }

    /// The integer nearest to `a`.
    pub fn round(&mut self, a: Expr) -> Expr {
        match self.literal(a) {
            Some(value) => self.constant(value.round()),
            None => self
                .intern(Node::Round(a.abs()))
                .with_sign_of(a.is_negative()),
        }
    }

    /// `sin a`.
    pub fn sin(&mut self, a: Expr) -> Expr {
        match self.literal(a) {
            Some(value) => self.constant(value.sin()),
            None => self
                .intern(Node::Sine(a.abs()))
                .with_sign_of(a.is_negative()),
        }
    }

    /// `cos a`.
    pub fn cos(&mut self, a: Expr) -> Expr {
        match self.literal(a) {
            Some(value) => self.constant(value.cos()),
            None => self.intern(Node::Cosine(a.abs())),
        }
    }

    /// `exp a`.
    pub fn exp(&mut self, a: Expr) -> Expr {
        let value = self.literal(a).map(f64::exp);
        match value.filter(|value| value.is_finite()) {
            Some(value) => self.constant(value),
            None => self.intern(Node::Exponential(a)),
        }
    }

    /// The angle of the point `(cosine, sine)`, from `-pi` to `pi`.
    pub fn atan2(&mut self, sine: Expr, cosine: Expr) -> Expr {
        if let (Some(y), Some(x)) = (self.literal(sine), self.literal(cosine)) {
            return self.constant(y.atan2(x));
        }
        self.intern(Node::Angle(sine.abs(), cosine))
            .with_sign_of(sine.is_negative())
    }

    /// The side that is held, 1 or -1; where none is (0), the sign of `a`, which is 0 at zero.
    pub fn side(&mut self, held: Expr, a: Expr) -> Expr {
        match (self.literal(held), self.literal(a)) {
            (Some(held), Some(a)) => self.constant(side(if held == 0.0 { a } else { held })),
            _ => self.intern(Node::Side(held, a)),
        }
    }

    /// `a` where a side is not negative, else `b`: exactly, by two terms of which one is zero.
    pub fn select(&mut self, side: Expr, a: Expr, b: Expr) -> Expr {
        if a == b {
            return a;
        }
        if let Some(side) = self.literal(side) {
            return if side < 0.0 { b } else { a };
        }
        let (a, b) = (self.above(side, a), self.below(side, b));
        self.add(a, b)
    }

    /// `a` where a side is not negative, else zero.
    pub fn above(&mut self, side: Expr, a: Expr) -> Expr {
        self.where_side(a, |a| Node::Above(side, a))
    }

    /// `a` where a side is negative, else zero.
    pub fn below(&mut self, side: Expr, a: Expr) -> Expr {
        self.where_side(a, |a| Node::Below(side, a))
    }

    fn where_side(&mut self, a: Expr, node: impl Fn(Expr) -> Node) -> Expr {
        if a == Self::ZERO {
            return a;
        }
        self.intern(node(a.abs())).with_sign_of(a.is_negative())
    }

    /// A spline, or a derivative of it. It is left to the evaluation, whatever its argument is.
    pub fn curve(&mut self, curve: Curve, a: Expr) -> Expr {
        self.intern(Node::Curve(curve, a))
    }

    /// The sum of some terms, from left to right.
    pub fn sum(&mut self, terms: impl IntoIterator<Item = Expr>) -> Expr {
        terms
            .into_iter()
            .fold(Self::ZERO, |sum, term| self.add(sum, term))
    }

    /// The operation of a node of another arena, on operands of this one.
    pub(crate) fn again(&mut self, node: Node, operand: impl Fn(Expr) -> Expr) -> Expr {
        match node {
            Node::Constant(bits) => self.constant(f64::from_bits(bits)),
            Node::Input(input) => self.input(input),
            Node::Add(a, b) => self.add(operand(a), operand(b)),
            Node::Multiply(a, b) => self.mul(operand(a), operand(b)),
            Node::Reciprocal(a) => self.reciprocal(operand(a)),
            Node::SquareRoot(a) => self.sqrt(operand(a)),
            Node::Sign(a) => self.sign(operand(a)),
            Node::Clamp(a) => self.clamp(operand(a)),
            Node::Round(a) => self.round(operand(a)),
            Node::Sine(a) => self.sin(operand(a)),
            Node::Cosine(a) => self.cos(operand(a)),
            Node::Exponential(a) => self.exp(operand(a)),
            Node::Angle(a, b) => self.atan2(operand(a), operand(b)),
            Node::Side(held, a) => self.side(operand(held), operand(a)),
            Node::Above(side, a) => self.above(operand(side), operand(a)),
            Node::Below(side, a) => self.below(operand(side), operand(a)),
            Node::Curve(curve, a) => self.curve(curve, operand(a)),
        }
    }

    /// The nodes that the outputs need and that are known no earlier than `from`, in order of
    /// computation.
    #[must_use]
    pub fn live(&self, outputs: &[Expr], from: Stage) -> Vec<usize> {
        self.live_above(outputs, from, [])
    }

    /// The same without the given nodes, and what only these need.
    pub(crate) fn live_above(
        &self,
        outputs: &[Expr],
        from: Stage,
        given: impl IntoIterator<Item = usize>,
    ) -> Vec<usize> {
        let last = outputs.iter().map(|output| output.node()).max();
        let mut needed = vec![false; last.map_or(0, |last| last + 1)];
        let mut is_given = vec![false; needed.len()];
        for node in given {
            if let Some(is_given) = is_given.get_mut(node) {
                *is_given = true;
            }
        }
        for output in outputs {
            needed[output.node()] = true;
        }
        let mut live = Vec::new();
        let (needed, stages) = (needed.as_mut_slice(), self.stages.as_slice());
        let mut node = needed.len();
        while node > 0 {
            node -= 1;
            if needed[node] && stages[node] >= from && !is_given[node] {
                live.push(node);
                let (first, second) = self.node(node).pair();
                if let Some(operand) = first {
                    needed[operand.node()] = true;
                }
                if let Some(operand) = second {
                    needed[operand.node()] = true;
                }
            }
        }
        live.reverse();
        live
    }

    /// The node at a place.
    #[inline(always)]
    #[must_use]
    pub fn node(&self, place: usize) -> Node {
        self.nodes.as_slice()[place]
    }

    /// The stage of the node at a place.
    #[must_use]
    pub fn stage_of(&self, place: usize) -> Stage {
        self.stages[place]
    }
}

#[cfg(test)]
mod tests;

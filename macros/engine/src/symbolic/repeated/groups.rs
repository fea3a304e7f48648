//! What belongs to each group of outputs, and what a node is but for its numbers.

use crate::symbolic::arena::{Arena, Expr, Input, Node, Stage};
use crate::symbolic::table::Table;

/// What an argument or an output is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Leaf {
    /// A value that a call before has given, by its place among all of them.
    Value {
        /// The place.
        place: usize,
        /// Whether its sign is turned.
        is_negative: bool,
    },
    /// An input, likewise.
    Input {
        /// Which one.
        input: Input,
        /// Whether its sign is turned.
        is_negative: bool,
    },
    /// A number.
    Literal(f64),
    /// What is known before the state is, in the arena of the kernel.
    Earlier(Expr),
}

/// Where a node is computed.
const NOWHERE: u32 = u32::MAX;

pub(super) struct Finder<'a, F> {
    pub(super) arena: &'a Arena,
    pub(super) outputs: &'a [Expr],
    class: F,
    /// The group that computes each node.
    pub(super) owner: Vec<u32>,
    /// The nodes of each group, operands before what is made of them.
    pub(super) own: Vec<Vec<usize>>,
    /// Whether it is needed beyond that group.
    pub(super) is_handed_on: Vec<bool>,
    /// The place among the values of each node that was handed on, whether with its sign turned,
    /// and the place among the results of its call.
    pub(super) places: Table<usize, (usize, bool, usize)>,
    /// What a node is but for its numbers.
    keys: Vec<u64>,
    /// Whether it needs nothing of other groups.
    is_local: Vec<bool>,
    /// Whether its sign can be brought to numbers that it is made of.
    has_own_sign: Vec<bool>,
    pub(super) known: Table<Vec<Node>, Vec<usize>>,
}

impl<'a, F: Fn(Input) -> u64> Finder<'a, F> {
    pub(super) fn new(
        arena: &'a Arena,
        outputs: &'a [Expr],
        groups: &[Vec<usize>],
        class: F,
    ) -> Self {
        let mut finder = Self {
            arena,
            outputs,
            class,
            owner: vec![NOWHERE; arena.len()],
            own: Vec::new(),
            is_handed_on: vec![false; arena.len()],
            places: Table::default(),
            keys: vec![0; arena.len()],
            is_local: vec![false; arena.len()],
            has_own_sign: vec![false; arena.len()],
            known: Table::default(),
        };
        for (number, group) in groups.iter().enumerate() {
            let mut next: Vec<usize> = group.iter().map(|&k| outputs[k].node()).collect();
            for &node in &next {
                if finder.is_computed(node) {
                    finder.is_handed_on[node] = true;
                }
            }
            let mut own = Vec::new();
            while let Some(node) = next.pop() {
                if !finder.is_computed(node) || finder.owner[node] == number as u32 {
                    continue;
                }
                if finder.owner[node] != NOWHERE {
                    finder.is_handed_on[node] = true;
                    continue;
                }
                finder.owner[node] = number as u32;
                own.push(node);
                next.extend(arena.node(node).operands().map(Expr::node));
            }
            own.sort_unstable();
            finder.own.push(own);
        }
        finder
    }

    /// Whether a node is an operation on what is known with the state.
    pub(super) fn is_computed(&self, node: usize) -> bool {
        let is_late = self.arena.stage(expr(node)) >= Stage::State;
        is_late && !matches!(self.arena.node(node), Node::Input(_))
    }

    pub(super) fn is_early(&self, expr: Expr) -> bool {
        self.arena.stage(expr) < Stage::State
    }

    pub(super) fn leaf(&self, expr: Expr) -> Leaf {
        if let Some(value) = self.arena.literal(expr) {
            return Leaf::Literal(value);
        }
        if let Some(&(place, is_turned, _)) = self.places.get(&expr.node()) {
            return Leaf::Value {
                place,
                is_negative: expr.is_negative() != is_turned,
            };
        }
        match self.arena.get(expr) {
            Node::Input(input) if !self.is_early(expr) => Leaf::Input {
                input,
                is_negative: expr.is_negative(),
            },
            _ => Leaf::Earlier(expr),
        }
    }

    /// The keys of the nodes of a group: operands come before what is made of them.
    pub(super) fn find_keys(&mut self, own: &[usize]) {
        for &node in own {
            let made = self.arena.node(node);
            let mut keys = [0; 2];
            for (key, operand) in keys.iter_mut().zip(made.operands()) {
                *key = self.key(operand);
            }
            if matches!(made, Node::Add(..) | Node::Multiply(..)) {
                keys.sort_unstable();
            }
            self.keys[node] = mixed(mixed(kind(made), keys[0]), keys[1]);
            self.is_local[node] = made.operands().all(|operand| {
                let node = operand.node();
                !self.is_computed(node) || self.is_local[node] && !self.places.contains_key(&node)
            });
            let mut operands = made.operands().map(|operand| self.takes_sign(operand));
            self.has_own_sign[node] = match made {
                Node::Add(..) => operands.all(|takes| takes),
                Node::Multiply(a, b) => a != b && operands.any(|takes| takes),
                Node::Reciprocal(_) => operands.all(|takes| takes),
                _ => false,
            };
        }
    }

    /// Numbers that belong to formulas, not to a mechanism.
    pub(super) fn is_of_formula(&self, expr: Expr) -> bool {
        let value = self.arena.literal(expr.abs());
        value.is_some_and(|value| [0.0, 1.0, 2.0].contains(&value))
    }

    /// Whether a node is a number or a constant that becomes an argument with its sign.
    pub(super) fn is_given(&self, expr: Expr) -> bool {
        self.is_early(expr) && !self.is_of_formula(expr)
    }

    pub(super) fn takes_sign(&self, expr: Expr) -> bool {
        let node = expr.node();
        self.is_given(expr) || self.has_own_sign[node] && !self.places.contains_key(&node)
    }

    pub(super) fn key(&self, expr: Expr) -> u64 {
        if self.is_early(expr) {
            return if self.is_given(expr) { 1 } else { 9 };
        }
        if let Node::Input(input) = self.arena.get(expr) {
            return mixed(7, (self.class)(input));
        }
        match self.places.get(&expr.node()) {
            Some(&(_, _, result)) if !self.is_local[expr.node()] => mixed(8, result as u64),
            _ => self.keys[expr.node()],
        }
    }
}

fn expr(node: usize) -> Expr {
    Expr::new(node as u32, false)
}

const fn kind(node: Node) -> u64 {
    match node {
        Node::Add(..) => 2,
        Node::Multiply(..) => 3,
        Node::Reciprocal(_) => 4,
        Node::SquareRoot(_) => 5,
        _ => 6,
    }
}

const fn mixed(a: u64, b: u64) -> u64 {
    let sum = a.rotate_left(17) ^ b.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    (sum ^ sum >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9)
}

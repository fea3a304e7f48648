//! The function of a group, written anew over arguments.

use super::groups::{Finder, Leaf};
use crate::symbolic::arena::{Arena, Expr, Input, Node};
use crate::symbolic::table::Table;

/// The function of a group in the making.
pub(super) struct Body<'a, 'f, F> {
    pub(super) finder: &'f Finder<'a, F>,
    pub(super) arena: Arena,
    /// What each node has become.
    pub(super) made: Table<usize, Expr>,
    /// The arguments that stand for leaves.
    places: Table<Expr, Expr>,
    pub(super) arguments: Vec<Leaf>,
}

impl<'a, 'f, F: Fn(Input) -> u64> Body<'a, 'f, F> {
    /// Nothing is made yet.
    pub(super) fn new(finder: &'f Finder<'a, F>) -> Self {
        Self {
            finder,
            arena: Arena::new(),
            made: Table::default(),
            places: Table::default(),
            arguments: Vec::new(),
        }
    }

    pub(super) fn is_own(&self, expr: Expr) -> bool {
        let node = expr.node();
        self.finder.is_computed(node) && !self.finder.places.contains_key(&node)
    }

    /// An operand that is made or an argument. Numbers and constants are arguments with their sign.
    fn operand(&mut self, expr: Expr) -> Expr {
        if let Some(&made) = self.made.get(&expr.node()) {
            return if expr.is_negative() { -made } else { made };
        }
        if self.finder.is_of_formula(expr)
            && let Some(value) = self.finder.arena.literal(expr)
        {
            return self.arena.constant(value);
        }
        let is_early = self.finder.is_early(expr);
        let leaf = if is_early { expr } else { expr.abs() };
        let argument = match self.places.get(&leaf) {
            Some(&argument) => argument,
            None => {
                let place = self.arguments.len() as u32;
                let of_leaf = match self.finder.leaf(leaf) {
                    Leaf::Value { place, .. } => Leaf::Value {
                        place,
                        is_negative: false,
                    },
                    other => other,
                };
                self.arguments.push(of_leaf);
                let argument = self.arena.input(Input::Coordinate(place));
                self.places.insert(leaf, argument);
                argument
            }
        };
        if !is_early && expr.is_negative() != self.is_turned(leaf) {
            -argument
        } else {
            argument
        }
    }

    /// Whether the sign of what stands for a node already is turned.
    fn is_turned(&self, expr: Expr) -> bool {
        let made = self.made.get(&expr.node()).map(|made| made.is_negative());
        let handed_on = || self.finder.places.get(&expr.node());
        made.or_else(|| handed_on().map(|&(_, is_turned, _)| is_turned))
            .unwrap_or(false)
    }

    /// The operands of a node in order.
    fn operands(&self, expr: Expr) -> Vec<Expr> {
        let node = self.finder.arena.get(expr);
        let mut operands: Vec<Expr> = node.operands().collect();
        if matches!(node, Node::Add(..) | Node::Multiply(..)) {
            operands.sort_by_key(|&operand| self.finder.key(operand));
        }
        operands
    }

    /// Whether the sign of an operand can still be chosen.
    fn can_take(&self, operand: Expr) -> bool {
        self.finder.takes_sign(operand) && !self.made.contains_key(&operand.node())
    }

    /// Makes a node and what it needs.
    pub(super) fn make(&mut self, expr: Expr) {
        let mut tasks = vec![Task::Visit(expr)];
        while let Some(task) = tasks.pop() {
            match task {
                Task::Visit(expr) => {
                    if self.is_own(expr) && !self.made.contains_key(&expr.node()) {
                        self.visit(expr, &mut tasks);
                    }
                }
                Task::Take {
                    expr,
                    other,
                    taking,
                } => {
                    let known = [other, taking].map(|operand| self.is_turned(operand));
                    let is_turned = known[0] != known[1];
                    let takes = expr.is_negative() != is_turned && self.can_take(taking);
                    let taking = if takes { -taking } else { taking };
                    tasks.push(Task::Make(expr.node(), vec![other, taking], takes));
                    tasks.push(Task::Visit(taking));
                }
                Task::Make(node, operands, is_turned) => {
                    let operands: Vec<Expr> = operands.iter().map(|&x| self.operand(x)).collect();
                    let made = self.operation(node, &operands);
                    self.made.insert(node, if is_turned { -made } else { made });
                }
            }
        }
    }

    /// What has to be done for a node, last things first: operands with signs such that it becomes
    /// positive where it is wanted.
    fn visit(&self, expr: Expr, tasks: &mut Vec<Task>) {
        let mut operands = self.operands(expr);
        let mut is_turned = false;
        match (self.finder.arena.get(expr), &mut operands[..]) {
            (Node::Multiply(a, b), operands) if a != b => {
                // Numbers before what is made of them.
                operands.sort_by_key(|&operand| !self.finder.is_given(operand));
                let place = operands.iter().position(|&operand| self.can_take(operand));
                if let Some(place) = place {
                    let (taking, other) = (operands[place], operands[1 - place]);
                    tasks.push(Task::Take {
                        expr,
                        other,
                        taking,
                    });
                    tasks.push(Task::Visit(other));
                    return;
                }
            }
            (Node::Add(..) | Node::Reciprocal(_), operands) if expr.is_negative() => {
                operands.iter_mut().for_each(|operand| *operand = -*operand);
                is_turned = true;
            }
            _ => {}
        }
        tasks.push(Task::Make(expr.node(), operands.clone(), is_turned));
        tasks.extend(operands.into_iter().rev().map(Task::Visit));
    }

    /// The operation of a node on operands, of a sum or product in any order.
    fn operation(&mut self, node: usize, operands: &[Expr]) -> Expr {
        match (self.finder.arena.node(node), operands) {
            (Node::Add(..), &[a, b]) => self.arena.add(a, b),
            (Node::Multiply(..), &[a, b]) => self.arena.mul(a, b),
            (operation, _) => {
                let given: Vec<(Expr, Expr)> =
                    operation.operands().zip(operands.iter().copied()).collect();
                self.arena.again(operation, |operand| {
                    let known = given.iter().find(|(from, _)| *from == operand);
                    known.map_or(operand, |&(_, to)| to)
                })
            }
        }
    }
}

/// What is left to be done, last things first.
enum Task {
    /// A node and what it needs, with the sign that it is wanted with.
    Visit(Expr),
    /// The sign of a product, once the sign of one factor is known, by the other.
    Take {
        expr: Expr,
        other: Expr,
        taking: Expr,
    },
    /// A node of operands that are made, and whether its sign is then turned.
    Make(usize, Vec<Expr>, bool),
}

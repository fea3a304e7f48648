//! Kernels that do the same for many joints or bodies, as functions that are called for each.
//!
//! The outputs come in groups, one for each joint or body. A node belongs to the first group that
//! needs it; what later groups need of it is handed on. What a group computes is written anew over
//! arguments: numbers, constants, inputs and what earlier groups handed on. Groups that are then
//! equal node by node are one function.
//!
//! Signs stand outside nodes, so that the sign of a number in one group would be a difference of
//! shape: they are brought back to the numbers. Operands are put in an order that does not depend
//! on when they were made.

mod body;

use body::Body;

use super::arena::{Arena, Expr, Input, Node, Stage};
use super::equations::Kernel;
use super::table::Table;

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

/// A function of arguments, which are coordinates of its arena.
#[derive(Clone, Debug)]
pub struct Shape {
    /// The arena.
    pub arena: Arena,
    /// What it gives.
    pub outputs: Vec<Expr>,
    /// How many arguments it has.
    pub arguments: usize,
}

/// A kernel as calls of functions.
#[derive(Clone, Debug, Default)]
pub struct Repeated {
    /// The functions.
    pub shapes: Vec<Shape>,
    /// Each call: the function and its arguments. Its results stand behind those of the calls
    /// before.
    pub calls: Vec<(usize, Vec<Leaf>)>,
    /// How many values there are.
    pub values: usize,
    /// The outputs of the kernel.
    pub outputs: Vec<Leaf>,
}

/// Kernels of fewer operations stay as they are: those of a robot are read from step to step.
const LONG: usize = 1800;

impl Repeated {
    /// A kernel whose outputs come in groups; others are one group more. `class` tells inputs apart
    /// that mean different things for a joint or body. `None` where it would save less than half.
    #[must_use]
    pub fn new(
        kernel: &Kernel,
        mut groups: Vec<Vec<usize>>,
        class: impl Fn(Input) -> u64,
    ) -> Option<Self> {
        let Kernel { arena, outputs } = kernel;
        let mut live = arena.live(outputs, Stage::State);
        live.retain(|&place| !matches!(arena.node(place), Node::Input(_)));
        let has_curve = |&place: &usize| matches!(arena.node(place), Node::Curve(..));
        if live.len() < LONG || live.iter().any(has_curve) {
            return None;
        }
        let mut is_grouped = vec![false; outputs.len()];
        groups.iter().flatten().for_each(|&k| is_grouped[k] = true);
        groups.push((0..outputs.len()).filter(|&k| !is_grouped[k]).collect());
        let mut finder = Finder::new(arena, outputs, &groups, class);
        let mut found = Self::default();
        for (number, group) in groups.iter().enumerate() {
            finder.call(number, group, &mut found)?;
        }
        if 2 * found.operations() > live.len() {
            return None;
        }
        for &output in outputs {
            found.outputs.push(finder.leaf(output));
        }
        let outputs = found.outputs.iter();
        outputs
            .copied()
            .all(|leaf| is_named(arena, leaf))
            .then_some(found)
    }
}

impl Repeated {
    /// Kernels of which each is called by itself, with all of its outputs. The outputs of each are
    /// behind those of the one before; places of values begin with each anew.
    #[must_use]
    pub fn each(kernels: &[&Kernel], class: impl Fn(Input) -> u64 + Copy) -> Option<Self> {
        let mut found = Self::default();
        let mut known = Table::default();
        let mut most = 0;
        let mut operations = 0;
        for Kernel { arena, outputs } in kernels {
            let all = vec![(0..outputs.len()).collect()];
            let mut finder = Finder::new(arena, outputs, &all, class);
            let has_curve = |&place: &usize| matches!(arena.node(place), Node::Curve(..));
            if finder.own.iter().flatten().any(has_curve) {
                return None;
            }
            operations += finder.own.iter().map(Vec::len).sum::<usize>();
            finder.known = known;
            found.values = 0;
            let calls = found.calls.len();
            finder.call(0, &all[0], &mut found)?;
            if found.calls.len() == calls {
                // Nothing is computed.
                return None;
            }
            most = most.max(found.values);
            for &output in outputs {
                found.outputs.push(finder.leaf(output));
                if !is_named(arena, *found.outputs.last()?) {
                    return None;
                }
            }
            known = finder.known;
        }
        found.values = most;
        (operations >= LONG && 2 * found.operations() <= operations).then_some(found)
    }

    /// The operations of all functions.
    fn operations(&self) -> usize {
        let operations = self.shapes.iter();
        operations
            .map(|shape| shape.arena.len() - shape.arguments)
            .sum()
    }
}

/// Whether a table can name it: constants, and not coefficients.
fn is_named(arena: &Arena, leaf: Leaf) -> bool {
    match leaf {
        Leaf::Earlier(expr) => arena.stage(expr) < Stage::Coefficient,
        _ => true,
    }
}

/// Where a node is computed.
const NOWHERE: u32 = u32::MAX;

struct Finder<'a, F> {
    arena: &'a Arena,
    outputs: &'a [Expr],
    class: F,
    /// The group that computes each node.
    owner: Vec<u32>,
    /// The nodes of each group, operands before what is made of them.
    own: Vec<Vec<usize>>,
    /// Whether it is needed beyond that group.
    is_handed_on: Vec<bool>,
    /// The place among the values of each node that was handed on, whether with its sign turned,
    /// and the place among the results of its call.
    places: Table<usize, (usize, bool, usize)>,
    /// What a node is but for its numbers.
    keys: Vec<u64>,
    /// Whether it needs nothing of other groups.
    is_local: Vec<bool>,
    /// Whether its sign can be brought to numbers that it is made of.
    has_own_sign: Vec<bool>,
    known: Table<Vec<Node>, Vec<usize>>,
}

impl<'a, F: Fn(Input) -> u64> Finder<'a, F> {
    fn new(arena: &'a Arena, outputs: &'a [Expr], groups: &[Vec<usize>], class: F) -> Self {
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
    fn is_computed(&self, node: usize) -> bool {
        let is_late = self.arena.stage(expr(node)) >= Stage::State;
        is_late && !matches!(self.arena.node(node), Node::Input(_))
    }

    fn is_early(&self, expr: Expr) -> bool {
        self.arena.stage(expr) < Stage::State
    }

    fn leaf(&self, expr: Expr) -> Leaf {
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
    fn find_keys(&mut self, own: &[usize]) {
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
    fn is_of_formula(&self, expr: Expr) -> bool {
        let value = self.arena.literal(expr.abs());
        value.is_some_and(|value| [0.0, 1.0, 2.0].contains(&value))
    }

    /// Whether a node is a number or a constant that becomes an argument with its sign.
    fn is_given(&self, expr: Expr) -> bool {
        self.is_early(expr) && !self.is_of_formula(expr)
    }

    fn takes_sign(&self, expr: Expr) -> bool {
        let node = expr.node();
        self.is_given(expr) || self.has_own_sign[node] && !self.places.contains_key(&node)
    }

    fn key(&self, expr: Expr) -> u64 {
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

    /// The call of a group. `None` where it reads what a table cannot name.
    fn call(&mut self, group: usize, outputs: &[usize], found: &mut Repeated) -> Option<()> {
        let own = std::mem::take(&mut self.own[group]);
        if own.is_empty() {
            return Some(());
        }
        self.find_keys(&own);
        let mut body = Body::new(self);
        let mut wanted = Vec::new();
        for &output in outputs {
            let output = body.finder.outputs[output];
            if body.is_own(output) {
                body.make(output);
                wanted.push(output.node());
            }
        }
        let mut hidden: Vec<usize> = own
            .iter()
            .copied()
            .filter(|node| body.finder.is_handed_on[*node] && !wanted.contains(node))
            .collect();
        hidden.sort_by_key(|node| body.made[node].node());
        wanted.extend(hidden);
        let mut seen = Vec::new();
        wanted.retain(|&node| {
            let is_new = !seen.contains(&node);
            seen.push(node);
            is_new
        });
        let made: Vec<Expr> = wanted.iter().map(|node| body.made[node]).collect();
        let Body {
            arena, arguments, ..
        } = body;
        if !arguments.iter().all(|&leaf| is_named(self.arena, leaf)) {
            return None;
        }
        let outputs: Vec<Expr> = made.iter().map(|made| made.abs()).collect();
        let nodes: Vec<Node> = (0..arena.len()).map(|place| arena.node(place)).collect();
        // One that gives more will do: what nothing is carried by hands on less.
        let known = self.known.entry(nodes).or_default();
        let gives = |shape: &&usize| {
            let given = &found.shapes[**shape].outputs;
            outputs.iter().all(|output| given.contains(output))
        };
        let shape = known.iter().find(gives).copied();
        let shape = shape.unwrap_or_else(|| {
            known.push(found.shapes.len());
            found.shapes.push(Shape {
                arena,
                outputs,
                arguments: arguments.len(),
            });
            found.shapes.len() - 1
        });
        let given = &found.shapes[shape].outputs;
        for (&node, made) in wanted.iter().zip(&made) {
            let result = given.iter().position(|output| *output == made.abs());
            let result = result.expect("it gives what is wanted");
            let place = found.values + result;
            self.places
                .insert(node, (place, made.is_negative(), result));
        }
        found.values += given.len();
        found.calls.push((shape, arguments));
        Some(())
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

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
mod groups;

pub use groups::Leaf;

use body::Body;
use groups::Finder;

use super::arena::{Arena, Expr, Input, Node, Stage};
use super::equations::Kernel;
use super::table::Table;

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

impl<F: Fn(Input) -> u64> Finder<'_, F> {
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

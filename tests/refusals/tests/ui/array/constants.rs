//! Lengths of arrays by constants.
use holonom::prelude::*;

const N: usize = 3;
const M: usize = 4;

// Another number than the constant has.
#[derive(Mechanism)]
#[mechanism(N = 2)]
struct Row {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [k, 0.0, 0.0])]
    links: [Body; N],
    #[joint(between = [if k == 0 { ground } else { links[k - 1] }, links[k]], point = [k, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    hinges: [Revolute; N],
}

// A value that is no number, and a length of which nothing is said.
#[derive(Mechanism)]
#[mechanism(N = crate::N)]
struct Others {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], free)]
    links: [Body; N],
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], free)]
    others: [Body; M],
}

fn main() {}

//! Where the time itself stands in the equations, and the instants at which laws of it have a
//! break.

use super::kernels::Kernels;
use crate::model::Model;
use crate::symbolic::arena::{Arena, Expr, Input, Node, Stage};
use crate::symbolic::equations::Kernel;

/// Where the time stands, besides in the motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ExplicitTime {
    /// In the constraints: drivers.
    pub constraints: bool,
    /// In forces, and in the rates of the user's own states.
    pub forces: bool,
    /// In potential energies, or one of these states does.
    pub potential: bool,
    /// The instants (s), in order, at which a smooth step of the time begins or ends, as far as the
    /// macro can see them.
    pub breaks: Vec<f64>,
}

impl ExplicitTime {
    /// Reads it off the kernels of a mechanism.
    #[must_use]
    pub fn of(kernels: &Kernels, model: &Model) -> Self {
        let mut breaks = Vec::new();
        let mut with_time = vec![&kernels.constraints, &kernels.forces, &kernels.state_rates];
        if !model.velocity_rows().is_empty() {
            with_time.push(&kernels.constraint_rates);
        }
        for kernel in with_time {
            add_breaks(kernel, &mut breaks);
        }
        // They stand behind all other coordinates.
        let first = kernels.coordinate_rates.outputs.len() - kernels.state_rates.outputs.len();
        let is_state = |input| matches!(input, Input::Coordinate(place) if place as usize >= first);
        breaks.sort_by(f64::total_cmp);
        breaks.dedup();
        Self {
            // No other input stands in constraints than one that changes with time.
            constraints: reads(&kernels.constraints, |input| {
                matches!(input, Input::Time | Input::Varying(_))
            }) || model.drives_velocities(),
            forces: has_time(&kernels.forces) || has_time(&kernels.state_rates),
            potential: has_time(&kernels.potential_energy)
                || reads(&kernels.potential_energy, is_state),
            breaks,
        }
    }
}

fn has_time(kernel: &Kernel) -> bool {
    reads(kernel, |input| input == Input::Time)
}

fn reads(kernel: &Kernel, is_wanted: impl Fn(Input) -> bool) -> bool {
    let live = kernel.arena.live(&kernel.outputs, Stage::Literal);
    live.into_iter()
        .any(|place| matches!(kernel.arena.node(place), Node::Input(input) if is_wanted(input)))
}

/// Where the argument of a smooth step, held between 0 and 1, comes to either end.
fn add_breaks(Kernel { arena, outputs }: &Kernel, breaks: &mut Vec<f64>) {
    let live = arena.live(outputs, Stage::Literal);
    let lines = Lines::of(arena, &live);
    for place in live {
        let Node::Clamp(argument) = arena.node(place) else {
            continue;
        };
        if let Some(Line { start, slope }) = lines.get(argument)
            && slope != 0.0
        {
            let ends = [-start / slope, (1.0 - start) / slope];
            breaks.extend(ends.into_iter().filter(|end| end.is_finite()));
        }
    }
}

/// `start + slope * time`.
#[derive(Clone, Copy)]
struct Line {
    start: f64,
    slope: f64,
}

/// The nodes that are straight lines over the time.
struct Lines(Vec<Option<Line>>);

impl Lines {
    fn of(arena: &Arena, live: &[usize]) -> Self {
        let mut lines = Self(vec![None; arena.len()]);
        for &place in live {
            lines.0[place] = match arena.node(place) {
                Node::Constant(bits) => Some(Line {
                    start: f64::from_bits(bits),
                    slope: 0.0,
                }),
                Node::Input(Input::Time) => Some(Line {
                    start: 0.0,
                    slope: 1.0,
                }),
                Node::Add(a, b) => lines.get(a).zip(lines.get(b)).map(|(a, b)| Line {
                    start: a.start + b.start,
                    slope: a.slope + b.slope,
                }),
                Node::Multiply(a, b) => lines
                    .get(a)
                    .zip(lines.get(b))
                    .filter(|(a, b)| a.slope == 0.0 || b.slope == 0.0)
                    .map(|(a, b)| Line {
                        start: a.start * b.start,
                        slope: a.start * b.slope + a.slope * b.start,
                    }),
                _ => None,
            };
        }
        lines
    }

    fn get(&self, expr: Expr) -> Option<Line> {
        let sign = if expr.is_negative() { -1.0 } else { 1.0 };
        self.0[expr.node()].map(|line| Line {
            start: sign * line.start,
            slope: sign * line.slope,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::add_breaks;
    use crate::symbolic::arena::{Arena, Input};
    use crate::symbolic::equations::Kernel;

    #[test]
    fn a_smooth_step_has_two_breaks() {
        // (2 - time) / 4, and one that begins with a coordinate.
        let mut arena = Arena::new();
        let (time, x) = (arena.input(Input::Time), arena.input(Input::Coordinate(0)));
        let (two, quarter) = (arena.constant(2.0), arena.constant(0.25));
        let falling = arena.sub(two, time);
        let falling = arena.mul(quarter, falling);
        let other = arena.mul(time, x);
        let outputs = vec![arena.clamp(falling), arena.clamp(other)];
        let mut breaks = Vec::new();
        add_breaks(&Kernel { arena, outputs }, &mut breaks);
        assert_eq!(breaks, [2.0, -2.0]);
    }
}

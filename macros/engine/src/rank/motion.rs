//! A mechanism as numbers: its constraints at a configuration, and motions.
//!
//! Motions are measured without dimension: translations by the size of the mechanism, rotations in
//! radians.

use super::dense::dot;
use super::displacement::{Twist, apply};
use super::geometry::{along_screw, length, turned};
use super::limits::TOLERANCE;
use super::normal::solve_normal;
use super::sparse::{Row, Rows, transposed};
use crate::model::inertia::IDENTITY;
use crate::model::mechanism::Layout;
use crate::model::{BodyKind, Model};
use crate::symbolic::arena::{Arena, Input, Node, Stage};
use crate::symbolic::equations::{
    Block, Kernel, counter_rates, counters, initial_state, jacobian, rows,
};
use crate::symbolic::evaluate::evaluate;
use crate::symbolic::scene::Scene;
use crate::symbolic::tape::Tape;

/// A row of which no more than this is left anywhere is round-off, over the size that it should
/// have at least.
const VANISHING: f64 = 1e-13;
/// How often, and how much farther than near the start, a row that vanishes there is looked for.
const FAR_PLACES: usize = 8;
const FAR: f64 = 8.0;
/// A time of no particular meaning (s).
const LATER: f64 = 0.6180;

/// A configuration at a time.
#[derive(Clone, Debug)]
pub(super) struct Configuration {
    /// Those of the bodies; behind them the auxiliary variables.
    pub(super) coordinates: Vec<f64>,
    /// In s.
    pub(super) time: f64,
}

impl Configuration {
    /// The same at another time.
    pub(super) fn at(&self, time: f64) -> Self {
        Self {
            coordinates: self.coordinates.clone(),
            time,
        }
    }
}

/// Three rows that are components along directions fixed on a body. Where all three hold, their
/// gradients are those of the components along global axes, turned: the gradients of the directions
/// are multiplied with what vanishes.
struct Along {
    /// The first row.
    row: usize,
    body: usize,
    /// In axes of the body.
    axes: [[f64; 3]; 3],
}

/// Those of a model, where no component is left out.
fn components(model: &Model, layout: &Layout) -> Vec<Along> {
    let mut all = Vec::new();
    for (joint, &row) in model.joints.iter().zip(&layout.row) {
        for (first, components) in joint.components.iter().filter(|_| joint.dropped.is_empty()) {
            all.extend(joint.bodies[components.place].map(|body| Along {
                row: row + first,
                body,
                axes: components.axes,
            }));
        }
    }
    all
}

/// The constraints of a mechanism, ready to be evaluated.
pub(super) struct Constraints {
    kinds: Vec<BodyKind>,
    layout: Layout,
    /// The rows of each joint.
    counts: Vec<usize>,
    phi: Tape,
    jacobian: Tape,
    blocks: Vec<Block>,
    /// `Phi'` without motion, which is how the equations change with time; `None` where they do
    /// not.
    driven: Option<Tape>,
    /// The rates of the auxiliary variables, and what they count; `None` where no equation asks for
    /// an angle over turns.
    counted: Option<[Tape; 2]>,
    /// The times after the start at which a smooth step begins, is half done or ends, in order.
    /// Those of which the argument is no linear function of time are not known.
    pub(super) breaks: Vec<f64>,
    /// The size of the mechanism (m).
    pub(super) length: f64,
    /// The size of each row's gradient near the start; `None` for a row that vanishes everywhere.
    pub(super) sizes: Vec<Option<f64>>,
    /// What the size of a row is at least: that of an angle, a length or a squared length.
    least: f64,
    /// The vector equations whose components are along directions fixed on a body.
    components: Vec<Along>,
    /// What symbols are at the typical values of parameters.
    likes: Vec<Option<f64>>,
    /// The places of the run-time values that the constraints depend on, in order.
    pub(super) values: Vec<usize>,
}

impl Constraints {
    /// The constraints, and the configuration that the attributes describe, at the typical values
    /// of parameters; `None` where the macro cannot see a number that they depend on.
    pub(super) fn new(
        model: &Model,
        mut motion: impl FnMut(usize) -> Vec<f64>,
    ) -> Option<(Self, Configuration)> {
        let layout = model.layout();
        let mut initial = initial_state(model);
        let count = layout.coordinates + layout.auxiliaries;
        initial.outputs.truncate(count);
        let known = |input| symbol(input).and_then(|symbol| model.like(symbol));
        let start = evaluate(&initial.arena, &initial.outputs, known);
        let start = start.into_iter().collect::<Option<Vec<f64>>>()?;
        let scene = Scene::new(model);
        let (jacobian, blocks) = jacobian(&scene, model);
        let length = length(model);
        let phi = rows(&scene, [Arena::ONE, Arena::ZERO, Arena::ZERO]);
        let breaks = breaks(&phi, model);
        let initial = tape(&initial);
        let phi = tape(&phi);
        let is_driven = phi.reads(|input| input == Input::Time) || model.drives_velocities();
        let counts = phi.reads(
            |input| matches!(input, Input::Coordinate(place) if place as usize >= layout.coordinates),
        );
        let start = Configuration {
            coordinates: start,
            time: 0.0,
        };
        let mut constraints = Self {
            kinds: model.bodies.iter().map(|body| body.kind).collect(),
            counts: model
                .joints
                .iter()
                .map(|joint| model.equations(joint))
                .collect(),
            phi,
            driven: is_driven.then(|| tape(&rows(&scene, [Arena::ZERO, Arena::ONE, Arena::ZERO]))),
            counted: counts
                .then(|| [counter_rates(&scene), counters(&scene)].map(|kernel| tape(&kernel))),
            jacobian: tape(&jacobian),
            components: components(model, &layout),
            likes: model.symbols.iter().map(|symbol| symbol.like).collect(),
            values: Vec::new(),
            breaks,
            blocks,
            length,
            sizes: Vec::new(),
            least: length.powi(2).min(1.0),
            layout,
        };
        constraints.evaluate(&constraints.phi, &start)?;
        let tapes = [&initial, &constraints.phi, &constraints.jacobian];
        constraints.values = values(model, &tapes);
        // Off the constraints, so that a gradient that vanishes on them has a size.
        let mut places = vec![start.clone()];
        for _ in 1..3 {
            places.push(constraints.moved(&start, &motion(constraints.layout.velocities)));
        }
        let mut sizes = constraints.largest_gradients(&places)?;
        // So that a row that vanishes near the start only has a size, too: far away, at a later
        // time, and while smooth steps are under way.
        if sizes.contains(&None) {
            for _ in 0..FAR_PLACES {
                let far = motion(constraints.layout.velocities);
                let far: Vec<f64> = far.iter().map(|x| FAR * x).collect();
                places.push(constraints.moved(&start, &far));
            }
            let mut times = vec![0.0];
            if is_driven {
                times.push(LATER);
                times.extend(&constraints.breaks);
            }
            for time in times {
                let later = places.iter().map(|at| at.at(time)).collect::<Vec<_>>();
                let later = constraints.largest_gradients(&later);
                for (size, later) in sizes.iter_mut().zip(later.into_iter().flatten()) {
                    *size = size.or(later);
                }
            }
        }
        constraints.sizes = sizes;
        Some((constraints, start))
    }

    /// The largest gradient of each row among some configurations; `None` for a row of which only
    /// round-off is left.
    fn largest_gradients(&self, places: &[Configuration]) -> Option<Vec<Option<f64>>> {
        let mut sizes = vec![0.0_f64; self.layout.rows];
        for at in places {
            for (size, row) in sizes.iter_mut().zip(self.gradients(at)?) {
                *size = size.max(row.norm());
            }
        }
        let least = VANISHING * self.least;
        let sizes = sizes.into_iter();
        Some(sizes.map(|size| (size > least).then_some(size)).collect())
    }

    /// The number of velocities.
    pub(super) fn velocities(&self) -> usize {
        self.layout.velocities
    }

    /// Whether the time stands in an equation.
    pub(super) fn is_driven(&self) -> bool {
        self.driven.is_some()
    }

    /// The outputs of a kernel; `None` where one is not known, or beyond all numbers.
    pub(super) fn evaluate(&self, tape: &Tape, at: &Configuration) -> Option<Vec<f64>> {
        self.evaluate_moving(tape, at, &[])
    }

    /// The same with velocities; those that are not given are zero.
    fn evaluate_moving(
        &self,
        tape: &Tape,
        at: &Configuration,
        velocities: &[f64],
    ) -> Option<Vec<f64>> {
        let values = tape.evaluate(|input| match input {
            Input::Coordinate(place) => at.coordinates.get(place as usize).copied(),
            Input::Time => Some(at.time),
            Input::Velocity(place) => {
                Some(velocities.get(place as usize).copied().unwrap_or_default())
            }
            Input::Symbol(place) | Input::Varying(place) => {
                self.likes.get(place as usize).copied().flatten()
            }
            // Nothing that is evaluated here depends on the others.
            Input::RateGain
            | Input::PositionGain
            | Input::Compliance(_)
            | Input::Acceleration(_)
            | Input::Upper(_)
            | Input::Lower(_) => Some(0.0),
        });
        values.filter(|values| values.iter().all(|value| value.is_finite()))
    }

    /// `D` over motions without dimension.
    pub(super) fn gradients(&self, at: &Configuration) -> Option<Rows> {
        let values = self.evaluate(&self.jacobian, at)?;
        let mut rows = vec![Row::default(); self.layout.rows];
        for &Block {
            joint,
            body,
            offset,
        } in &self.blocks
        {
            let columns = self.kinds[body].velocities();
            let first = self.layout.velocity[body];
            let own = &mut rows[self.layout.row[joint]..][..self.counts[joint]];
            for (row, values) in own.iter_mut().zip(values[offset..].chunks(columns)) {
                for (k, value) in values.iter().enumerate() {
                    row.push(first + k, if k < 3 { value * self.length } else { *value });
                }
            }
        }
        for (first, turn) in self.turns(at) {
            let own: [Row; 3] = [0, 1, 2].map(|k| std::mem::take(&mut rows[first + k]));
            let width = own.iter().map(Row::width).max().unwrap_or_default();
            for (k, direction) in turn.iter().enumerate() {
                let mut sum = vec![0.0; width];
                for (row, share) in own.iter().zip(direction) {
                    row.add_to(*share, &mut sum);
                }
                rows[first + k] = Row::of(&sum);
            }
        }
        Some(rows)
    }

    /// The first row of each vector equation that is split along directions fixed on a body, and
    /// these in global axes.
    fn turns(&self, at: &Configuration) -> Vec<(usize, [[f64; 3]; 3])> {
        let turns = self.components.iter().map(|along| {
            let (_, orientation) = self.pose(at, along.body);
            let axes = along.axes.map(|direction| apply(orientation, direction));
            (along.row, axes)
        });
        turns.collect()
    }

    /// Values of all rows, of which those of vector equations are along global axes, along the
    /// directions of their components.
    fn split(&self, mut values: Vec<f64>, at: &Configuration) -> Vec<f64> {
        for (first, turn) in self.turns(at) {
            let own = [0, 1, 2].map(|k| values[first + k]);
            for (k, direction) in turn.iter().enumerate() {
                values[first + k] = dot(direction, &own);
            }
        }
        values
    }

    /// The rows of `D` over motions without dimension, of unit length; those beneath the tolerance
    /// are zero.
    pub(super) fn directions(&self, at: &Configuration, tolerance: f64) -> Option<Rows> {
        let mut rows = self.gradients(at)?;
        for (row, size) in rows.iter_mut().zip(&self.sizes) {
            let length = row.norm();
            let is_sound = size.is_some_and(|size| length > tolerance * size);
            let factor = if is_sound { length.recip() } else { 0.0 };
            row.scale(factor);
        }
        Some(rows)
    }

    /// How fast the equations change with time (1/s), over the lengths of their gradients: minus
    /// the speeds that they ask for, along the rows of [`Self::directions`]. Zero where those are.
    pub(super) fn demands(&self, at: &Configuration, tolerance: f64) -> Option<Vec<f64>> {
        let Some(driven) = &self.driven else {
            return Some(vec![0.0; self.layout.rows]);
        };
        let mut rates = self.split(self.evaluate(driven, at)?, at);
        let rows = self.gradients(at)?;
        for ((rate, row), size) in rates.iter_mut().zip(rows).zip(&self.sizes) {
            let length = row.norm();
            let is_sound = size.is_some_and(|size| length > tolerance * size);
            *rate = if is_sound { *rate / length } else { 0.0 };
        }
        Some(rates)
    }

    /// The smallest motion (1/s) that does what the equations ask for.
    pub(super) fn velocity(&self, at: &Configuration) -> Option<Vec<f64>> {
        // Where equations contradict each other, a compromise.
        const DAMPING: f64 = 1e-12;
        let directions = self.directions(at, TOLERANCE)?;
        let demands = self.demands(at, TOLERANCE)?;
        let speeds: Vec<f64> = demands.iter().map(|demand| -demand).collect();
        let shares = solve_normal(&directions, &speeds, DAMPING)?;
        Some(transposed(&directions, &shares, self.layout.velocities))
    }

    /// The rows that are violated where their gradients vanish, though these do not everywhere.
    pub(super) fn stuck(&self, at: &Configuration) -> Vec<usize> {
        // Of the size of a row.
        const VIOLATED: f64 = 0.01;
        let (Some(rows), Some(violations)) = (self.directions(at, TOLERANCE), self.violations(at))
        else {
            return Vec::new();
        };
        (0..rows.len())
            .filter(|&row| {
                self.sizes[row].is_some()
                    && rows[row].norm() == 0.0
                    && violations[row].abs() > VIOLATED
            })
            .collect()
    }

    /// The violations, over the sizes of the gradients: about the distances to where the
    /// constraints hold.
    pub(super) fn violations(&self, at: &Configuration) -> Option<Vec<f64>> {
        let mut values = self.split(self.evaluate(&self.phi, at)?, at);
        for (value, size) in values.iter_mut().zip(&self.sizes) {
            if *value != 0.0 {
                *value /= size.unwrap_or(self.least);
            }
        }
        Some(values)
    }

    /// Another configuration after a motion without dimension, straight on. Auxiliary variables
    /// move along.
    pub(super) fn moved(&self, at: &Configuration, motion: &[f64]) -> Configuration {
        self.moved_along(at, motion, |_, _, translation| translation)
    }

    /// Another configuration after a motion without dimension, each body along a screw: exact for
    /// one that turns about an axis at rest, however far.
    pub(super) fn screwed(&self, at: &Configuration, motion: &[f64]) -> Configuration {
        self.moved_along(at, motion, along_screw)
    }

    fn moved_along(
        &self,
        at: &Configuration,
        motion: &[f64],
        path: impl Fn([f64; 4], [f64; 3], [f64; 3]) -> [f64; 3],
    ) -> Configuration {
        let mut moved = at.clone();
        let mut velocities = motion.to_vec();
        for (body, kind) in self.kinds.iter().enumerate() {
            let (q, u) = (self.layout.coordinate[body], self.layout.velocity[body]);
            let mut translation = [0, 1, 2].map(|k| self.length * motion[u + k]);
            velocities[u..u + 3].copy_from_slice(&translation);
            if *kind == BodyKind::Rigid {
                let p = [3, 4, 5, 6].map(|k| at.coordinates[q + k]);
                let rotation = [3, 4, 5].map(|k| motion[u + k]);
                translation = path(p, rotation, translation);
                moved.coordinates[q + 3..q + 7].copy_from_slice(&turned(p, rotation));
            }
            for (coordinate, way) in moved.coordinates[q..q + 3].iter_mut().zip(translation) {
                *coordinate += way;
            }
        }
        if let Some([rates, _]) = &self.counted
            && let Some(rates) = self.evaluate_moving(rates, at, &velocities)
        {
            let counters = moved.coordinates.iter_mut().skip(self.layout.coordinates);
            for (counter, rate) in counters.zip(rates) {
                *counter += rate;
            }
        }
        moved
    }

    /// Whether a body has an orientation.
    pub(super) fn kind(&self, body: usize) -> BodyKind {
        self.kinds[body]
    }

    /// Where a body is.
    pub(super) fn pose(&self, at: &Configuration, body: usize) -> ([f64; 3], [f64; 4]) {
        let q = self.layout.coordinate[body];
        let position = [0, 1, 2].map(|k| at.coordinates[q + k]);
        match self.kinds[body] {
            BodyKind::Rigid => (position, [3, 4, 5, 6].map(|k| at.coordinates[q + k])),
            BodyKind::Particle => (position, IDENTITY),
        }
    }

    /// Puts a body somewhere else.
    pub(super) fn place(
        &self,
        at: &mut Configuration,
        body: usize,
        (position, orientation): ([f64; 3], [f64; 4]),
    ) {
        let q = self.layout.coordinate[body];
        at.coordinates[q..q + 3].copy_from_slice(&position);
        if self.kinds[body] == BodyKind::Rigid {
            at.coordinates[q + 3..q + 7].copy_from_slice(&orientation);
        }
    }

    /// The motion without dimension of a body that moves by a twist; the others are at rest.
    pub(super) fn velocity_of(&self, at: &Configuration, body: usize, twist: &Twist) -> Vec<f64> {
        let (position, [e0, e1, e2, e3]) = self.pose(at, body);
        let u = self.layout.velocity[body];
        let mut motion = vec![0.0; self.layout.velocities];
        for (x, velocity) in motion[u..].iter_mut().zip(twist.at(position)) {
            *x = velocity / self.length;
        }
        if self.kinds[body] == BodyKind::Rigid {
            // In axes of the body.
            let spin = apply([e0, -e1, -e2, -e3], twist.spin);
            motion[u + 3..u + 6].copy_from_slice(&spin);
        }
        motion
    }

    /// Auxiliary variables as the angles that they count.
    pub(super) fn rewrap(&self, at: &mut Configuration) {
        if let Some([_, angles]) = &self.counted
            && let Some(angles) = self.evaluate(angles, at)
        {
            at.coordinates.truncate(self.layout.coordinates);
            at.coordinates.extend(angles);
        }
    }
}

/// The symbol that an input is.
fn symbol(input: Input) -> Option<u32> {
    match input {
        Input::Symbol(place) | Input::Varying(place) => Some(place),
        _ => None,
    }
}

/// The places of the run-time values that some tapes read, in order.
fn values(model: &Model, tapes: &[&Tape]) -> Vec<usize> {
    let symbols = model.symbols.iter().enumerate();
    let read = symbols.filter(|(place, _)| {
        let is_it = |input| symbol(input).is_some_and(|symbol| symbol as usize == *place);
        tapes.iter().any(|tape| tape.reads(is_it))
    });
    let mut values: Vec<usize> = read.flat_map(|(_, symbol)| symbol.values.clone()).collect();
    values.sort_unstable();
    values.dedup();
    values
}

fn tape(kernel: &Kernel) -> Tape {
    Tape::new(&kernel.arena, &kernel.outputs)
}

/// See [`Constraints::breaks`].
fn breaks(Kernel { arena, outputs }: &Kernel, model: &Model) -> Vec<f64> {
    let mut breaks = Vec::new();
    for place in arena.live(outputs, Stage::Literal) {
        let Node::Clamp(argument) = arena.node(place) else {
            continue;
        };
        let at = |time: f64| {
            let known = |input| match symbol(input) {
                Some(symbol) => model.like(symbol),
                None => (input == Input::Time).then_some(time),
            };
            evaluate(arena, &[argument], known)
                .first()
                .copied()
                .flatten()
        };
        let (Some(a), Some(b), Some(c)) = (at(0.0), at(1.0), at(2.0)) else {
            continue;
        };
        let is_linear = (a - 2.0 * b + c).abs() <= 1e-9 * (a.abs() + b.abs() + c.abs());
        let times = [0.0, 0.5, 1.0].map(|value| (value - a) / (b - a));
        breaks.extend(
            times
                .into_iter()
                .filter(|time| is_linear && *time > 0.0 && time.is_finite()),
        );
    }
    breaks.sort_unstable_by(f64::total_cmp);
    breaks.dedup();
    breaks
}

//! What a mechanism's equations are at a state, by numbers: masses by hand, everything else by dual
//! numbers over the definitions.
//!
//! Bodies are taken in the user's axes, with their full tensors. Along curves `q(h)`
//! ([`crate::language`]):
//!
//! * a column of `D`: `r + h`, or `p + h/2 L(p)^T d` with `d` a unit vector of the body;
//! * `Phi'` and `-gamma`: `q + q' h + 1/2 q'' h^2` without accelerations, at the time `t + h`;
//! * generalised forces: what a force does along the curves of the columns of `D`.

use num_dual::Dual2_64;

use crate::language::{Acting, Interpreter};
use crate::pose::{Pose, constant, dot};
use crate::reading::{Described, Element, Numbers};

/// The state of a mechanism at one instant, in the user's axes.
#[derive(Clone, Debug)]
pub(crate) struct State {
    pub(crate) time: f64,
    /// Of each body: position, Euler parameters.
    pub(crate) poses: Vec<(Numbers, [f64; 4])>,
    /// Of each body: velocity, angular velocity in its axes.
    pub(crate) rates: Vec<(Numbers, Numbers)>,
    /// Whole turns of every unwrapped angle.
    pub(crate) turns: Vec<f64>,
}

/// The equations at a state.
pub(crate) struct Equations {
    pub(crate) phi: Vec<f64>,
    pub(crate) rate: Vec<f64>,
    pub(crate) gamma: Vec<f64>,
    /// By rows, then by velocities.
    pub(crate) gradients: Vec<Vec<f64>>,
    /// The joint of each row.
    pub(crate) joints: Vec<usize>,
    /// Three rows, from the first on, as they are where one of them is left out.
    components: Vec<(usize, [Component; 3])>,
    /// The mass matrix.
    pub(crate) mass: Vec<Vec<f64>>,
    /// Gravity, gyroscopic moments, forces.
    pub(crate) forces: Vec<f64>,
    pub(crate) kinetic: f64,
    pub(crate) potential: f64,
    pub(crate) power: f64,
    /// What is positive on the sides of the joints that are meant.
    pub(crate) sides: Vec<f64>,
    /// The unwrapped angles, and their rates.
    pub(crate) angles: Vec<(f64, f64)>,
    /// The largest number on the way.
    pub(crate) scale: f64,
}

/// A row along a direction fixed on a body.
#[derive(Clone, Default)]
struct Component {
    phi: f64,
    rate: f64,
    gamma: f64,
    gradient: Vec<f64>,
}

/// `1/2 L(p)^T w`: the rates of Euler parameters, `w` in body axes.
pub(crate) fn euler_rates(p: [f64; 4], w: Numbers) -> [f64; 4] {
    let [e0, x, y, z] = p;
    let [a, b, c] = w;
    [
        -0.5 * (x * a + y * b + z * c),
        0.5 * (e0 * a + y * c - z * b),
        0.5 * (e0 * b + z * a - x * c),
        0.5 * (e0 * c + x * b - y * a),
    ]
}

/// A curve of poses: values, first and second derivatives.
fn curve(at: &(Numbers, [f64; 4]), rate: Numbers, turn: Numbers) -> Pose {
    let (r, p) = at;
    let first = euler_rates(*p, turn);
    let second = euler_rates(first, turn);
    Pose {
        position: [0, 1, 2].map(|k| Dual2_64::new(r[k], rate[k], 0.0)),
        euler: [0, 1, 2, 3].map(|k| Dual2_64::new(p[k], first[k], second[k])),
    }
}

/// Equations that are violated by less than this, over the largest number on the way, hold.
const HOLDS: f64 = 1e-11;

const STILL: Numbers = [0.0; 3];

/// The poses of all bodies, standing and moving.
struct Motion<'a> {
    described: &'a Described,
    state: &'a State,
    starts: Vec<Pose>,
    standing: Vec<Pose>,
    moving: Vec<Pose>,
    /// The first velocity of each body.
    first: Vec<usize>,
    scale: f64,
}

impl<'a> Motion<'a> {
    fn new(described: &'a Described, state: &'a State) -> Self {
        let bodies = state.poses.iter().zip(&state.rates);
        let mut first = vec![0];
        for body in &described.bodies {
            first.push(first[first.len() - 1] + body.velocities());
        }
        Self {
            described,
            state,
            starts: (0..described.bodies.len())
                .map(|body| described.start(Some(body)))
                .collect(),
            standing: state
                .poses
                .iter()
                .map(|at| curve(at, STILL, STILL))
                .collect(),
            moving: bodies.map(|(at, (v, w))| curve(at, *v, *w)).collect(),
            first,
            scale: 1.0,
        }
    }

    /// Reads an element along a curve; `None` near a point where it has no derivative.
    fn read<T>(
        &mut self,
        (element, turns): (&Element, &[f64]),
        poses: &[Pose],
        rate: f64,
        of: impl FnOnce(&Interpreter<'_>) -> T,
    ) -> Option<T> {
        let time = Dual2_64::new(self.state.time, rate, 0.0);
        let values = &self.described.values;
        let interpreter = Interpreter::new(element, [poses, &self.starts], values, time, turns);
        let found = of(&interpreter);
        self.scale = self.scale.max(interpreter.scale.get());
        (!interpreter.singular.get()).then_some(found)
    }

    /// Body, column, and poses where the body moves along it, of all bodies of an element.
    fn columns(&self, element: &Element) -> Vec<(usize, usize, Vec<Pose>)> {
        let mut bodies: Vec<usize> = element.between.iter().copied().flatten().collect();
        bodies.dedup();
        let mut columns = Vec::new();
        for body in bodies {
            for column in 0..self.described.bodies[body].velocities() {
                let mut unit = [0.0; 6];
                unit[column] = 1.0;
                let [a, b, c, d, e, f] = unit;
                let mut poses = self.standing.clone();
                poses[body] = curve(&self.state.poses[body], [a, b, c], [d, e, f]);
                columns.push((body, column, poses));
            }
        }
        columns
    }
}

impl Equations {
    /// `None` near a point where something has no derivative, or is beyond all numbers.
    pub(crate) fn new(described: &Described, state: &State) -> Option<Self> {
        let mut motion = Motion::new(described, state);
        let velocities = motion.first[described.bodies.len()];
        let mut equations = Self {
            phi: Vec::new(),
            rate: Vec::new(),
            gamma: Vec::new(),
            gradients: Vec::new(),
            joints: Vec::new(),
            components: Vec::new(),
            mass: vec![vec![0.0; velocities]; velocities],
            forces: vec![0.0; velocities],
            kinetic: 0.0,
            potential: 0.0,
            power: 0.0,
            sides: Vec::new(),
            angles: Vec::new(),
            scale: 1.0,
        };
        equations.bodies(&motion);
        let mut turns = &state.turns[..];
        for (place, element) in described.elements.iter().enumerate() {
            let (own, rest) = turns.split_at(element.turns.len());
            turns = rest;
            let element = (element, own);
            if element.0.is_force {
                equations.force(&mut motion, element)?;
            } else {
                equations.joint(&mut motion, place, element)?;
            }
            equations.counters(&mut motion, element)?;
        }
        equations.scale = motion.scale;
        // Exponentials of exponentials are soon beyond all numbers.
        let numbers = equations.phi.iter().chain(&equations.rate);
        let numbers = numbers.chain(&equations.gamma).chain(&equations.forces);
        let mut numbers = numbers.chain(equations.gradients.iter().flatten());
        numbers.all(|x| x.is_finite()).then_some(equations)
    }

    fn bodies(&mut self, motion: &Motion<'_>) {
        for (place, body) in motion.described.bodies.iter().enumerate() {
            let first = motion.first[place];
            let (position, (velocity, w)) =
                (motion.state.poses[place].0, motion.state.rates[place]);
            for k in 0..3 {
                self.mass[first + k][first + k] = body.mass;
                self.forces[first + k] = body.mass * motion.described.gravity[k];
                self.kinetic += 0.5 * body.mass * velocity[k] * velocity[k];
                self.potential -= body.mass * motion.described.gravity[k] * position[k];
            }
            let Some(tensor) = body.inertia else { continue };
            let momentum = tensor.map(|row| row[0] * w[0] + row[1] * w[1] + row[2] * w[2]);
            for k in 0..3 {
                let (l, m) = ((k + 1) % 3, (k + 2) % 3);
                self.mass[first + 3 + k][first + 3..first + 6].copy_from_slice(&tensor[k]);
                self.forces[first + 3 + k] = momentum[l] * w[m] - momentum[m] * w[l];
                self.kinetic += 0.5 * w[k] * momentum[k];
            }
        }
    }

    fn joint(
        &mut self,
        motion: &mut Motion<'_>,
        place: usize,
        element: (&Element, &[f64]),
    ) -> Option<()> {
        let moving = motion.moving.clone();
        let along = motion.read(element, &moving, 1.0, |i| i.rows())?;
        let sides = motion.read(element, &moving, 1.0, |i| i.sides())?;
        self.sides.extend(sides);
        let first = self.phi.len();
        let components = motion.read(element, &moving, 1.0, |i| i.components(&along))?;
        for (row, along) in components {
            let split = along.map(|component| Component {
                phi: component.re,
                rate: component.v1,
                gamma: -component.v2,
                gradient: vec![0.0; self.forces.len()],
            });
            self.components.push((first + row, split));
        }
        for row in along {
            self.phi.push(row.re);
            self.rate.push(row.v1);
            self.gamma.push(-row.v2);
            self.gradients.push(vec![0.0; self.forces.len()]);
            self.joints.push(place);
        }
        // What an equation of velocities has at rest is no part of a gradient.
        let standing = motion.standing.clone();
        let at_rest = motion.read(element, &standing, 0.0, |i| i.rows())?;
        for (body, column, poses) in motion.columns(element.0) {
            let mut values = motion.read(element, &poses, 0.0, |i| i.rows())?;
            for (value, at_rest) in values.iter_mut().zip(&at_rest) {
                value.v1 -= at_rest.v1;
            }
            let components = motion.read(element, &poses, 0.0, |i| i.components(&values))?;
            for (row, along) in components {
                let mut own = self.components.iter_mut();
                let own = own.find(|(known, _)| *known == first + row);
                let (_, split) = own.expect("it was there at first");
                for (component, value) in split.iter_mut().zip(along) {
                    component.gradient[motion.first[body] + column] = value.v1;
                }
            }
            for (row, value) in self.gradients[first..].iter_mut().zip(values) {
                row[motion.first[body] + column] = value.v1;
            }
        }
        Some(())
    }

    fn force(&mut self, motion: &mut Motion<'_>, element: (&Element, &[f64])) -> Option<()> {
        let (moving, standing) = (motion.moving.clone(), motion.standing.clone());
        let now = motion.read(element, &moving, 1.0, |i| i.actions())?;
        // What every action does along a curve, whose angular velocities are given in the axes of
        // the bodies.
        let along =
            |now: &Acting, curve: &Acting, turn: &dyn Fn(usize) -> Numbers| match (now, curve) {
                (Acting::Potential(_), Acting::Potential(energy)) => -energy.v1,
                (Acting::Along(effort, _), Acting::Along(_, coordinate)) => {
                    effort.re * coordinate.v1
                }
                (Acting::Force(vector, _), Acting::Force(_, point)) => {
                    (0..3).map(|k| vector[k].re * point[k].v1).sum()
                }
                (Acting::Moment(moment, body), _) => element.0.between[*body]
                    .map_or(0.0, |place| {
                        dot(*moment, standing[place].outwards(turn(place).map(constant))).re
                    }),
                _ => unreachable!("one text gives one list of actions"),
            };
        for (body, column, poses) in motion.columns(element.0) {
            let curves = motion.read(element, &poses, 0.0, |i| i.actions())?;
            let turn = |place: usize| {
                let mut unit = STILL;
                if place == body && column >= 3 {
                    unit[column - 3] = 1.0;
                }
                unit
            };
            let pairs = now.iter().zip(&curves);
            let sum: f64 = pairs.map(|(now, curve)| along(now, curve, &turn)).sum();
            self.forces[motion.first[body] + column] += sum;
        }
        let spin = |place: usize| motion.state.rates[place].1;
        for action in &now {
            match action {
                Acting::Potential(energy) => self.potential += energy.re,
                action => self.power += along(action, action, &spin),
            }
        }
        Some(())
    }

    fn counters(&mut self, motion: &mut Motion<'_>, element: (&Element, &[f64])) -> Option<()> {
        let standing = motion.standing.clone();
        for (from, to, axis) in &element.0.turns {
            let (angle, direction) = motion.read(element, &standing, 0.0, |interpreter| {
                let angle = interpreter.angle_now(*from, *to, axis);
                (angle, interpreter.axis_now(*from, axis))
            })?;
            let mut rate = 0.0;
            for (body, sign) in [(*to, 1.0), (*from, -1.0)] {
                if let Some(place) = element.0.between[body] {
                    let spin = motion.state.rates[place].1.map(constant);
                    rate += sign * dot(direction, standing[place].outwards(spin)).re;
                }
            }
            self.angles.push((angle, rate));
        }
        Some(())
    }

    /// Whether the state is on the constraints.
    pub(crate) fn hold(&self) -> bool {
        self.phi.iter().all(|phi| phi.abs() <= HOLDS * self.scale)
    }

    /// The equations without some of the rows.
    pub(crate) fn without(mut self, dropped: &[bool]) -> Self {
        for (first, split) in std::mem::take(&mut self.components) {
            if !dropped[first..first + 3].contains(&true) {
                continue;
            }
            for (row, component) in (first..).zip(split) {
                self.phi[row] = component.phi;
                self.rate[row] = component.rate;
                self.gamma[row] = component.gamma;
                self.gradients[row] = component.gradient;
            }
        }
        let keep = |k: usize| !dropped[k];
        let select = |values: Vec<f64>| -> Vec<f64> {
            let kept = values.into_iter().enumerate().filter(|(k, _)| keep(*k));
            kept.map(|(_, value)| value).collect()
        };
        self.phi = select(self.phi);
        self.rate = select(self.rate);
        self.gamma = select(self.gamma);
        let gradients = self.gradients.into_iter().enumerate();
        self.gradients = gradients
            .filter(|(k, _)| keep(*k))
            .map(|(_, row)| row)
            .collect();
        let joints = self.joints.into_iter().enumerate();
        self.joints = joints
            .filter(|(k, _)| keep(*k))
            .map(|(_, joint)| joint)
            .collect();
        self
    }

    /// `[M D^T; D -e]`.
    pub(crate) fn saddle(&self, compliance: f64) -> Vec<Vec<f64>> {
        self.saddle_by_row(&vec![compliance; self.phi.len()])
    }

    /// With a compliance for each row.
    pub(crate) fn saddle_by_row(&self, compliances: &[f64]) -> Vec<Vec<f64>> {
        let (velocities, rows) = (self.forces.len(), self.phi.len());
        let mut matrix = vec![vec![0.0; velocities + rows]; velocities + rows];
        for (line, mass) in matrix.iter_mut().zip(&self.mass) {
            line[..velocities].copy_from_slice(mass);
        }
        for (k, gradient) in self.gradients.iter().enumerate() {
            matrix[velocities + k][..velocities].copy_from_slice(gradient);
            for (line, entry) in matrix.iter_mut().zip(gradient) {
                line[velocities + k] = *entry;
            }
            matrix[velocities + k][velocities + k] = -compliances[k];
        }
        matrix
    }
}

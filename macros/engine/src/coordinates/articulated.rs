//! Articulated inertias: from the leaves to the ground, what a link and all that it carries is to
//! what moves it, with its own motion solved for.
//!
//! A link answers to two accelerations: the angular one of its base, with which its frame turns,
//! and that of its origin. What turns freely against the ground answers to the second alone, so
//! that a chain of balls hands on a mass of 3 x 3 and a run of parallel axes on the ground one of 2
//! x 2. Gravity and velocities are not in here: they act on rigid links, whose wrenches are given.

use super::algebra::{add, apply};
use super::frames::{FrameId, Frames};
use super::freedom::Freedom;
use super::links::Links;
use super::wrenches::Wrench;
use crate::plan::symmetric::Symmetric;
use crate::symbolic::arena::{Arena, Expr};
use crate::symbolic::vector::{Triple, ZERO, cross, dot};

/// The angular acceleration of the base.
const BASE: usize = 0;
/// The angular acceleration of the link.
const OWN: usize = 3;
/// The acceleration of the origin.
const ORIGIN: usize = 6;
/// The rate of a velocity along a direction that is no coordinate axis, or of a screw.
const ALONG: usize = 9;

/// A quadratic form of accelerations and forces on them.
#[derive(Clone, Debug)]
struct Form {
    matrix: Symmetric,
    forces: Vec<Expr>,
}

/// A motion solved for: `x = value - sum l y`.
#[derive(Clone, Debug)]
struct Solved {
    place: usize,
    value: Expr,
    lower: Vec<(usize, Expr)>,
}

/// What is left of a form for what carries the link.
#[derive(Clone, Copy, Debug)]
struct Left {
    base: [Triple; 3],
    mixed: [Triple; 3],
    origin: [Triple; 3],
    moment: Triple,
    force: Triple,
}

impl Form {
    fn new() -> Self {
        Self {
            matrix: Symmetric::new(ALONG + 1),
            forces: vec![Arena::ZERO; ALONG + 1],
        }
    }

    /// Adds to a block on the diagonal.
    fn add_symmetric(&mut self, arena: &mut Arena, at: usize, block: [Triple; 3]) {
        for (k, row) in block.iter().enumerate() {
            for (l, &entry) in row[..=k].iter().enumerate() {
                self.matrix.add(arena, at + k, at + l, entry);
            }
        }
    }

    /// Adds to a block beside the diagonal.
    fn add_mixed(&mut self, arena: &mut Arena, [row, column]: [usize; 2], block: [Triple; 3]) {
        for (k, entries) in block.into_iter().enumerate() {
            for (l, entry) in entries.into_iter().enumerate() {
                self.matrix.add(arena, row + k, column + l, entry);
            }
        }
    }

    fn add_forces(&mut self, arena: &mut Arena, at: usize, forces: Triple) {
        for (k, force) in forces.into_iter().enumerate() {
            self.forces[at + k] = arena.add(self.forces[at + k], force);
        }
    }

    fn block(&self, row: usize, column: usize) -> [Triple; 3] {
        [0, 1, 2].map(|k| [0, 1, 2].map(|l| self.matrix.get(row + k, column + l)))
    }

    /// Declares that an acceleration is another one.
    fn identify(&mut self, arena: &mut Arena, place: usize, with: usize) {
        let twice = self.matrix.get(place, with);
        let twice = arena.add(twice, twice);
        let own = arena.add(twice, self.matrix.get(place, place));
        self.matrix.add(arena, with, with, own);
        for other in 0..=ALONG {
            if other != place && other != with {
                let entry = self.matrix.get(place, other);
                self.matrix.add(arena, with, other, entry);
            }
        }
        self.forces[with] = arena.add(self.forces[with], self.forces[place]);
        self.clear(place);
    }

    fn clear(&mut self, place: usize) {
        for other in 0..=ALONG {
            self.matrix.set(place, other, Arena::ZERO);
        }
        self.forces[place] = Arena::ZERO;
    }

    /// Solves for an acceleration.
    fn solve(&mut self, arena: &mut Arena, place: usize) -> Solved {
        let inverse = arena.reciprocal(self.matrix.get(place, place));
        let row: Vec<(usize, Expr)> = (0..=ALONG)
            .map(|other| (other, self.matrix.get(place, other)))
            .filter(|&(other, entry)| other != place && entry != Arena::ZERO)
            .collect();
        let value = arena.mul(self.forces[place], inverse);
        let scaled = row.iter().map(|&(k, entry)| (k, arena.mul(entry, inverse)));
        let lower: Vec<(usize, Expr)> = scaled.collect();
        for (number, &(k, factor)) in lower.iter().enumerate() {
            for &(l, entry) in &row[..=number] {
                let update = arena.mul(factor, entry);
                self.matrix.add(arena, k, l, -update);
            }
            let update = arena.mul(row[number].1, value);
            self.forces[k] = arena.sub(self.forces[k], update);
        }
        self.clear(place);
        Solved {
            place,
            value,
            lower,
        }
    }
}

impl Links {
    /// The axes of the acceleration of a link's origin: those of the ground for a ball on which
    /// nothing but balls hangs.
    fn origin_axes(&self, link: Option<usize>) -> FrameId {
        let is_ball = |link: usize| matches!(self.links[link].freedom, Freedom::Ball { .. });
        match link {
            Some(place) if is_ball(place) && self.children(link).all(is_ball) => Frames::GROUND,
            _ => self.axes(link),
        }
    }

    /// The unit vectors of a link's axes times a vector, in the axes of its origin's acceleration.
    fn arms(&self, arena: &mut Arena, link: usize, v: Triple) -> [Triple; 3] {
        let (from, to) = (self.links[link].axes, self.origin_axes(Some(link)));
        [0, 1, 2].map(|k| {
            let arm = cross(arena, Self::unit(k), v);
            self.frames.turn(arena, arm, from, to)
        })
    }

    /// The form of a link by itself.
    fn own_form(&self, arena: &mut Arena, link: usize, wrench: Wrench) -> Form {
        let mut form = Form::new();
        let inertia = self.inertia_in_axes(arena, link);
        form.add_symmetric(arena, OWN, inertia.tensor);
        let arms = self.arms(arena, link, inertia.first);
        form.add_mixed(arena, [OWN, ORIGIN], arms);
        for k in ORIGIN..ORIGIN + 3 {
            form.matrix.add(arena, k, k, inertia.mass);
        }
        let (from, to) = (self.links[link].axes, self.origin_axes(Some(link)));
        let force = self.frames.turn(arena, wrench.force, from, to);
        form.add_forces(arena, ORIGIN, force);
        form.add_forces(arena, OWN, wrench.moment);
        form
    }

    /// Adds what is left of a link to the form of its carrier.
    fn hand_on(&self, arena: &mut Arena, link: usize, carrier: usize, left: Left, form: &mut Form) {
        let offset = self.offset(arena, link);
        let arms = self.arms(arena, carrier, offset);
        let (from, to) = (
            self.origin_axes(Some(link)),
            self.origin_axes(Some(carrier)),
        );
        let origin = self.frames.tensor(arena, left.origin, from, to);
        let force = self.frames.turn(arena, left.force, from, to);
        form.add_symmetric(arena, ORIGIN, origin);
        form.add_forces(arena, ORIGIN, force);
        let moment = arms.map(|arm| dot(arena, arm, force));
        form.add_forces(arena, OWN, moment);
        let mut by_arms = arms.map(|arm| apply(arena, origin, arm));
        let mut further = [ZERO; 3];
        let base = self.base(link);
        if base.is_some() {
            let (from, to) = (self.links[link].axes, self.links[carrier].axes);
            let mixed = self.frames.matrix(arena, left.mixed, from, to);
            let own = self.frames.tensor(arena, left.base, from, to);
            let moment = self.frames.turn(arena, left.moment, from, to);
            // `mixed` times the arms: a row for each component of the base.
            let products = mixed.map(|row| arms.map(|arm| dot(arena, row, arm)));
            let at = if base == Some(carrier) {
                by_arms = [0, 1, 2].map(|k| add(arena, by_arms[k], mixed[k]));
                further = products;
                OWN
            } else {
                assert!(
                    base == self.base(carrier),
                    "a link turns with its carrier or with the base of its carrier"
                );
                form.add_mixed(arena, [BASE, ORIGIN], mixed);
                form.add_mixed(arena, [BASE, OWN], products);
                BASE
            };
            form.add_symmetric(arena, at, own);
            form.add_forces(arena, at, moment);
        }
        form.add_mixed(arena, [OWN, ORIGIN], by_arms);
        for k in 0..3 {
            for l in 0..=k {
                let entry = dot(arena, arms[k], by_arms[l]);
                let entry = arena.add(entry, further[k][l]);
                form.matrix.add(arena, OWN + k, OWN + l, entry);
            }
        }
    }

    /// Solves for the motion of a link against what moves it; `efforts` are along its velocities.
    fn solve_motion(
        &self,
        arena: &mut Arena,
        link: usize,
        form: &mut Form,
        efforts: &[Expr],
    ) -> Vec<Solved> {
        match self.links[link].freedom {
            Freedom::Turn { axis, .. } => {
                for k in (0..3).filter(|&k| k != axis) {
                    form.identify(arena, OWN + k, BASE + k);
                }
                // Along the axis the angular acceleration of the link itself takes the place of its
                // rate against the base.
                form.forces[OWN + axis] = arena.add(form.forces[OWN + axis], efforts[0]);
                form.forces[BASE + axis] = arena.sub(form.forces[BASE + axis], efforts[0]);
                vec![form.solve(arena, OWN + axis)]
            }
            Freedom::Slide { .. } => {
                for k in 0..3 {
                    form.identify(arena, OWN + k, BASE + k);
                }
                let along = self.slide(arena, link).unwrap_or(ZERO);
                if let Some((axis, sign)) = coordinate_axis(along) {
                    let effort = arena.mul(sign, efforts[0]);
                    let place = ORIGIN + axis;
                    form.forces[place] = arena.add(form.forces[place], effort);
                    let solved = form.solve(arena, place);
                    form.forces[place] = -effort;
                    return vec![solved];
                }
                for other in BASE..ALONG {
                    let row = [0, 1, 2].map(|k| form.matrix.get(ORIGIN + k, other));
                    let entry = dot(arena, along, row);
                    form.matrix.set(ALONG, other, entry);
                }
                let row = [0, 1, 2].map(|k| form.matrix.get(ALONG, ORIGIN + k));
                let own = dot(arena, along, row);
                form.matrix.set(ALONG, ALONG, own);
                let force = [0, 1, 2].map(|k| form.forces[ORIGIN + k]);
                let force = dot(arena, along, force);
                form.forces[ALONG] = arena.add(force, efforts[0]);
                vec![form.solve(arena, ALONG)]
            }
            Freedom::Screw { axis, advance, .. } => {
                let both = |arena: &mut Arena, turning: Expr, moving: Expr| {
                    let moving = arena.mul(advance, moving);
                    arena.add(turning, moving)
                };
                for other in BASE..ALONG {
                    let turning = form.matrix.get(OWN + axis, other);
                    let moving = form.matrix.get(ORIGIN + axis, other);
                    let entry = both(arena, turning, moving);
                    form.matrix.set(ALONG, other, entry);
                }
                let turning = form.matrix.get(ALONG, OWN + axis);
                let moving = form.matrix.get(ALONG, ORIGIN + axis);
                let own = both(arena, turning, moving);
                form.matrix.set(ALONG, ALONG, own);
                let force = both(arena, form.forces[OWN + axis], form.forces[ORIGIN + axis]);
                form.forces[ALONG] = arena.add(force, efforts[0]);
                for k in 0..3 {
                    form.identify(arena, OWN + k, BASE + k);
                }
                vec![form.solve(arena, ALONG)]
            }
            Freedom::Ball { .. } => {
                for (k, &effort) in efforts.iter().enumerate() {
                    form.forces[OWN + k] = arena.add(form.forces[OWN + k], effort);
                }
                (OWN..OWN + 3)
                    .map(|place| form.solve(arena, place))
                    .collect()
            }
        }
    }

    /// Rates of the velocities under wrenches on the links, which hold all that the motion takes
    /// without second rates, and efforts along the velocities.
    pub(super) fn articulated(
        &self,
        arena: &mut Arena,
        wrenches: &[Wrench],
        efforts: &[Expr],
    ) -> Vec<Expr> {
        let mut forms: Vec<Form> = Vec::new();
        for (link, wrench) in wrenches.iter().enumerate() {
            forms.push(self.own_form(arena, link, *wrench));
        }
        let mut solved = vec![Vec::new(); self.links.len()];
        for link in self.leaves_first() {
            let own = &self.links[link];
            let mut form = forms[link].clone();
            let efforts = &efforts[own.velocity..own.velocity + own.freedom.velocities()];
            solved[link] = self.solve_motion(arena, link, &mut form, efforts);
            if let Some(carrier) = own.carrier {
                let three = |at: usize| [0, 1, 2].map(|k| form.forces[at + k]);
                let left = Left {
                    base: form.block(BASE, BASE),
                    mixed: form.block(BASE, ORIGIN),
                    origin: form.block(ORIGIN, ORIGIN),
                    moment: three(BASE),
                    force: three(ORIGIN),
                };
                self.hand_on(arena, link, carrier, left, &mut forms[carrier]);
            }
        }
        self.accelerations(arena, &solved)
    }

    /// Rates of the velocities from the ground to the leaves.
    fn accelerations(&self, arena: &mut Arena, solved: &[Vec<Solved>]) -> Vec<Expr> {
        let mut rates = vec![Arena::ZERO; self.velocities];
        let (mut spins, mut origins): (Vec<Triple>, Vec<Triple>) = (Vec::new(), Vec::new());
        for (link, solved) in solved.iter().enumerate() {
            let own = &self.links[link];
            let base = self.base(link).map_or(ZERO, |base| {
                let from = self.links[base].axes;
                self.frames.turn(arena, spins[base], from, own.axes)
            });
            let origin = own.carrier.map_or(ZERO, |carrier| {
                let offset = self.offset(arena, link);
                let arms = self.arms(arena, carrier, offset);
                let spin = spins[carrier];
                // The sum over the unit vectors of the axes.
                let swept = [0, 1, 2].map(|k| {
                    let column = arms.map(|arm| arm[k]);
                    dot(arena, spin, column)
                });
                let origin = add(arena, origins[carrier], swept);
                let (from, to) = (
                    self.origin_axes(Some(carrier)),
                    self.origin_axes(Some(link)),
                );
                self.frames.turn(arena, origin, from, to)
            });
            let mut known = [Arena::ZERO; ALONG + 1];
            known[BASE..OWN].copy_from_slice(&base);
            known[ORIGIN..ALONG].copy_from_slice(&origin);
            for Solved {
                place,
                value,
                lower,
            } in solved.iter().rev()
            {
                let mut sum = *value;
                for &(k, factor) in lower {
                    let term = arena.mul(factor, known[k]);
                    sum = arena.sub(sum, term);
                }
                known[*place] = sum;
            }
            let three = |at: usize| [known[at], known[at + 1], known[at + 2]];
            let (mut spin, mut moved) = (base, three(ORIGIN));
            match own.freedom {
                Freedom::Turn { axis, .. } => {
                    spin[axis] = known[OWN + axis];
                    rates[own.velocity] = arena.sub(spin[axis], base[axis]);
                }
                Freedom::Slide { .. } => {
                    let along = self.slide(arena, link).unwrap_or(ZERO);
                    if let Some((axis, sign)) = coordinate_axis(along) {
                        let rate = arena.sub(moved[axis], origin[axis]);
                        rates[own.velocity] = arena.mul(sign, rate);
                    } else {
                        let rate = known[ALONG];
                        rates[own.velocity] = rate;
                        let further = along.map(|component| arena.mul(component, rate));
                        moved = add(arena, moved, further);
                    }
                }
                Freedom::Screw { axis, advance, .. } => {
                    let rate = known[ALONG];
                    rates[own.velocity] = rate;
                    spin[axis] = arena.add(spin[axis], rate);
                    let further = arena.mul(advance, rate);
                    moved[axis] = arena.add(moved[axis], further);
                }
                Freedom::Ball { .. } => {
                    spin = three(OWN);
                    rates[own.velocity..own.velocity + 3].copy_from_slice(&spin);
                }
            }
            spins.push(spin);
            origins.push(moved);
        }
        rates
    }
}

/// Which coordinate axis a direction is, if it is one, and its sense.
fn coordinate_axis(along: Triple) -> Option<(usize, Expr)> {
    let axis = (0..3).find(|&k| along[k].abs() == Arena::ONE)?;
    Some((axis, along[axis]))
}

//! The mass matrix: composite inertias from the leaves, and the momentum of every velocity handed
//! on to the ground.

use super::algebra::{Inertia, add, add_tensors, apply, cross_inertia, scale};
use super::freedom::Freedom;
use super::links::Links;
use super::wrenches::Wrench;
use crate::plan::symmetric::Symmetric;
use crate::symbolic::arena::{Arena, Expr};
use crate::symbolic::vector::{Triple, ZERO, cross};

/// What turns with a link, all of it, about the link's origin.
#[derive(Clone, Copy, Debug)]
struct Composite {
    /// The mass that the link carries, whether it turns with it or not.
    carried: Expr,
    /// What turns with the link, with the carried masses as points where they are carried.
    turning: Inertia,
    /// The first moments of the link, and of those that it carries and that turn with the base of
    /// its run.
    run: Triple,
}

impl Links {
    /// The composite inertias, leaves first, each in the axes of its link.
    fn composites(&self, arena: &mut Arena) -> Vec<Composite> {
        let none = Composite {
            carried: Arena::ZERO,
            turning: Inertia::NONE,
            run: ZERO,
        };
        let mut composites = vec![none; self.links.len()];
        for link in self.leaves_first() {
            let own = &self.links[link];
            // Constant in the link's own frame unless something moves along it: augmented by what
            // it carries, before it is turned.
            let mut augmented = own.inertia;
            let mut carried = own.inertia.mass;
            let mut sliding = Inertia::NONE;
            let children: Vec<usize> = self.children(Some(link)).collect();
            for &child in &children {
                let mass = composites[child].carried;
                carried = arena.add(carried, mass);
                let moves = matches!(
                    self.links[child].freedom,
                    Freedom::Slide { .. } | Freedom::Screw { .. }
                );
                if moves {
                    let offset = self.offset(arena, child);
                    let point = Inertia::point(arena, mass, offset);
                    sliding = sliding.plus(arena, point);
                } else {
                    let point = Inertia::point(arena, mass, self.links[child].offset);
                    augmented = augmented.plus(arena, point);
                }
            }
            let mut turning = Inertia {
                mass: Arena::ZERO,
                first: self.in_axes(arena, augmented.first, Some(link)),
                tensor: self
                    .frames
                    .tensor(arena, augmented.tensor, own.frame, own.axes),
            };
            turning = turning.plus(
                arena,
                Inertia {
                    mass: Arena::ZERO,
                    ..sliding
                },
            );
            let turning_with = (link + 1..self.links.len()).filter(|&k| self.base(k) == Some(link));
            for place in turning_with {
                let from = self.links[place].axes;
                let Inertia { first, tensor, .. } = composites[place].turning;
                let first = self.frames.turn(arena, first, from, own.axes);
                let tensor = self.frames.tensor(arena, tensor, from, own.axes);
                let at = self.seen_from(arena, place, link);
                let mixed = cross_inertia(arena, at, first);
                turning.first = add(arena, turning.first, first);
                turning.tensor = add_tensors(arena, turning.tensor, tensor);
                turning.tensor = add_tensors(arena, turning.tensor, mixed);
            }
            let mut run = turning.first;
            for &child in &children {
                if self.is_taken_along(child, link) {
                    let to = own.axes;
                    let from = self.links[child].axes;
                    let further = self.frames.turn(arena, composites[child].run, from, to);
                    run = add(arena, run, further);
                }
            }
            composites[link] = Composite {
                carried,
                turning,
                run,
            };
        }
        composites
    }

    /// Whether a link is carried by another one without turning with it, but turns with the same
    /// base.
    fn is_taken_along(&self, child: usize, link: usize) -> bool {
        self.base(child) != Some(link) && self.base(child) == self.base(link)
    }

    /// The origin of a link from that of one further down, in the axes of that one's motion.
    fn seen_from(&self, arena: &mut Arena, mut link: usize, from: usize) -> Triple {
        let mut at = ZERO;
        while link != from {
            let offset = self.offset(arena, link);
            let carrier = self.links[link].carrier.expect("it stands further down");
            let offset = self.frames.turn(
                arena,
                offset,
                self.links[carrier].axes,
                self.links[from].axes,
            );
            at = add(arena, at, offset);
            link = carrier;
        }
        at
    }

    /// The mass matrix.
    pub fn mass_matrix(&self, arena: &mut Arena) -> Symmetric {
        let composites = self.composites(arena);
        let mut matrix = Symmetric::new(self.velocities);
        for link in self.leaves_first() {
            let own = &self.links[link];
            let Composite {
                carried, turning, ..
            } = composites[link];
            // Angular velocity, and velocity of the origin.
            let units: Vec<(usize, [Option<Triple>; 2])> = match own.freedom {
                Freedom::Turn { axis, .. } => {
                    let unit = self.in_axes(arena, Self::unit(axis), Some(link));
                    vec![(own.velocity, [Some(unit), None])]
                }
                Freedom::Slide { .. } => {
                    let along = self.slide(arena, link).unwrap_or(ZERO);
                    vec![(own.velocity, [None, Some(along)])]
                }
                Freedom::Screw { axis, advance, .. } => {
                    let unit = Self::unit(axis);
                    let along = scale(arena, advance, unit);
                    vec![(own.velocity, [Some(unit), Some(along)])]
                }
                Freedom::Ball { .. } => (0..3)
                    .map(|k| (own.velocity + k, [Some(Self::unit(k)), None]))
                    .collect(),
            };
            for (velocity, [turn, slide]) in units {
                let mut wrenches = vec![Wrench::NONE; self.links.len()];
                let mut further = ZERO;
                let mut momentum = slide.map_or(Wrench::NONE, |along| Wrench {
                    force: along.map(|component| arena.mul(carried, component)),
                    moment: cross(arena, turning.first, along),
                });
                if let Some(unit) = turn {
                    for child in self.children(Some(link)) {
                        if self.is_taken_along(child, link) {
                            let offset = self.offset(arena, child);
                            let velocity = cross(arena, unit, offset);
                            let (from, to) = (self.links[child].axes, own.axes);
                            let run = self.frames.turn(arena, composites[child].run, from, to);
                            let moment = cross(arena, run, velocity);
                            further = add(arena, further, moment);
                        }
                    }
                    let about = Wrench {
                        force: cross(arena, unit, turning.first),
                        moment: apply(arena, turning.tensor, unit),
                    };
                    momentum = momentum.plus(arena, about);
                }
                wrenches[link] = momentum;
                let mut column = vec![Arena::ZERO; self.velocities];
                self.step(arena, link, &mut wrenches, &mut column);
                if let Some(base) = self.base(link) {
                    let to = self.links[base].axes;
                    let moment = self.frames.turn(arena, further, own.axes, to);
                    wrenches[base].moment = add(arena, wrenches[base].moment, moment);
                }
                let mut carrier = own.carrier;
                while let Some(place) = carrier {
                    self.step(arena, place, &mut wrenches, &mut column);
                    carrier = self.links[place].carrier;
                }
                for (other, value) in column.into_iter().enumerate() {
                    if value != Arena::ZERO {
                        matrix.set(velocity, other, value);
                    }
                }
            }
        }
        matrix
    }
}

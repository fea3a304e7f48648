//! Forces and moments on links, and what they are along the velocities.

use super::algebra::{Inertia, add, apply, scale};
use super::freedom::Freedom;
use super::kinematics::Kinematics;
use super::links::Links;
use crate::symbolic::arena::{Arena, Expr};
use crate::symbolic::vector::{Triple, ZERO, cross, dot};

/// A force and a moment about a link's origin, in the axes of its motion.
#[derive(Clone, Copy, Debug)]
pub struct Wrench {
    /// The force.
    pub force: Triple,
    /// The moment about the origin.
    pub moment: Triple,
}

impl Wrench {
    /// None.
    pub const NONE: Self = Self {
        force: ZERO,
        moment: ZERO,
    };

    /// The sum.
    #[must_use]
    pub fn plus(self, arena: &mut Arena, other: Self) -> Self {
        Self {
            force: add(arena, self.force, other.force),
            moment: add(arena, self.moment, other.moment),
        }
    }

    /// The opposite.
    #[must_use]
    pub fn opposite(self) -> Self {
        Self {
            force: self.force.map(|component| -component),
            moment: self.moment.map(|component| -component),
        }
    }
}

/// What the motion of a link takes without second rates (Newton, Euler).
pub(super) fn inertial(
    arena: &mut Arena,
    links: &Links,
    motion: &Kinematics,
    link: usize,
) -> Wrench {
    let Inertia {
        mass,
        first,
        tensor,
    } = links.inertia_in_axes(arena, link);
    let (w, dw, acceleration) = (motion.spin[link], motion.spin_bias[link], motion.bias[link]);
    let own = scale(arena, mass, acceleration);
    let bend = apply(arena, motion.second[link], first);
    let force = add(arena, own, bend);
    let by_origin = cross(arena, first, acceleration);
    let by_spin = apply(arena, tensor, dw);
    let sum = add(arena, by_origin, by_spin);
    let gyroscopic = gyroscopic(arena, tensor, w);
    Wrench {
        force,
        moment: add(arena, sum, gyroscopic),
    }
}

/// `w x I w`, from the products `w_k w_l`.
fn gyroscopic(arena: &mut Arena, tensor: [Triple; 3], w: Triple) -> Triple {
    [(0, 1, 2), (1, 2, 0), (2, 0, 1)].map(|(m, k, l)| {
        let difference = arena.sub(tensor[l][l], tensor[k][k]);
        let product = arena.mul(w[k], w[l]);
        let mut moment = arena.mul(difference, product);
        for (factor, a, b) in [(tensor[m][l], m, k), (-tensor[m][k], m, l)] {
            let product = arena.mul(w[a], w[b]);
            let term = arena.mul(factor, product);
            moment = arena.add(moment, term);
        }
        if tensor[k][l] != Arena::ZERO {
            let (first, second) = (arena.square(w[k]), arena.square(w[l]));
            let squares = arena.sub(first, second);
            let term = arena.mul(tensor[k][l], squares);
            moment = arena.add(moment, term);
        }
        moment
    })
}

impl Links {
    /// The link with whose frame a link's frame turns: its carrier, or that of its run; `None` for
    /// the ground.
    #[must_use]
    pub fn base(&self, link: usize) -> Option<usize> {
        let own = &self.links[link];
        match own.freedom {
            Freedom::Slide { .. } => return own.carrier,
            // What slides on the ground has its axes, but nothing turns with it.
            Freedom::Ball { .. } => return None,
            Freedom::Turn { .. } | Freedom::Screw { .. } => {}
        }
        let mut carrier = own.carrier;
        while let Some(place) = carrier {
            let frame = self.links[place].frame;
            if frame != own.frame && self.frames.follows(own.frame, frame) {
                return carrier;
            }
            carrier = self.links[place].carrier;
        }
        None
    }

    /// What wrenches on the links are along the velocities: their generalised forces, one for each
    /// velocity.
    ///
    /// A turn moves what is fixed in its frame, vectors between origins as well as moments: so
    /// forces are summed from link to link, moments from frame to frame.
    pub fn project(&self, arena: &mut Arena, mut wrenches: Vec<Wrench>) -> Vec<Expr> {
        let mut generalised = vec![Arena::ZERO; self.velocities];
        for link in self.leaves_first() {
            self.step(arena, link, &mut wrenches, &mut generalised);
        }
        generalised
    }

    /// One step of the projection: the generalised forces of a link, then its wrench onto what
    /// carries it.
    pub(super) fn step(
        &self,
        arena: &mut Arena,
        link: usize,
        wrenches: &mut [Wrench],
        generalised: &mut [Expr],
    ) {
        let Wrench { force, moment } = wrenches[link];
        let own = &self.links[link];
        match own.freedom {
            Freedom::Turn { axis, .. } => {
                let unit = self.in_axes(arena, Self::unit(axis), Some(link));
                generalised[own.velocity] = dot(arena, unit, moment);
            }
            Freedom::Slide { .. } => {
                let along = self.slide(arena, link).unwrap_or(ZERO);
                generalised[own.velocity] = dot(arena, along, force);
            }
            Freedom::Screw { axis, advance, .. } => {
                let along = arena.mul(advance, force[axis]);
                generalised[own.velocity] = arena.add(moment[axis], along);
            }
            Freedom::Ball { .. } => {
                generalised[own.velocity..own.velocity + 3].copy_from_slice(&moment);
            }
        }
        if let Some(carrier) = own.carrier {
            let to = self.links[carrier].axes;
            let force = self.frames.turn(arena, force, own.axes, to);
            let offset = self.offset(arena, link);
            let moment = cross(arena, offset, force);
            wrenches[carrier] = wrenches[carrier].plus(arena, Wrench { force, moment });
        }
        if let Some(base) = self.base(link) {
            let to = self.links[base].axes;
            let moment = self.frames.turn(arena, moment, own.axes, to);
            let onto = Wrench {
                moment,
                ..Wrench::NONE
            };
            wrenches[base] = wrenches[base].plus(arena, onto);
        }
    }
}

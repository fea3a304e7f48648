//! How links move: from the ground to the leaves, every link in the axes of its motion.

use super::algebra::{add, apply, scale};
use super::freedom::Freedom;
use super::links::Links;
use crate::symbolic::arena::{Arena, Expr, Input};
use crate::symbolic::vector::{Triple, ZERO, cross};

/// Which rates there are.
#[derive(Clone, Copy, Debug)]
pub(super) enum Moving<'a> {
    /// None: everything stands still.
    Not,
    /// Velocities, and no second rates.
    Steadily,
    /// Velocities, and these rates of theirs.
    Accelerated(&'a [Expr]),
}

impl Moving<'_> {
    /// A velocity.
    fn rate(self, arena: &mut Arena, velocity: usize) -> Expr {
        match self {
            Self::Not => Arena::ZERO,
            Self::Steadily | Self::Accelerated(_) => arena.input(Input::Velocity(velocity as u32)),
        }
    }

    /// The rate of a velocity.
    fn second_rate(self, velocity: usize) -> Expr {
        match self {
            Self::Not | Self::Steadily => Arena::ZERO,
            Self::Accelerated(rates) => rates[velocity],
        }
    }
}

/// The motion of the links, without second rates where these are not given.
#[derive(Clone, Debug)]
pub(super) struct Kinematics {
    /// The acceleration of the ground.
    pub(super) ground: Triple,
    /// Angular velocities.
    pub(super) spin: Vec<Triple>,
    /// Velocities of the origins.
    pub(super) velocity: Vec<Triple>,
    /// What angular accelerations are without second rates.
    pub(super) spin_bias: Vec<Triple>,
    /// What accelerations of the origins are without second rates.
    pub(super) bias: Vec<Triple>,
    /// `w' ~ + w~ w~`: what it takes from a fixed vector to its second derivative.
    pub(super) second: Vec<[Triple; 3]>,
}

/// `w' ~ + w~ w~`.
fn second(arena: &mut Arena, w: Triple, dw: Triple) -> [Triple; 3] {
    let mut q = [ZERO; 3];
    for k in 0..3 {
        for l in 0..3 {
            q[k][l] = arena.mul(w[k], w[l]);
        }
    }
    let mut matrix = [ZERO; 3];
    for (k, l, m) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
        matrix[k][k] = -arena.add(q[l][l], q[m][m]);
        matrix[k][l] = arena.sub(q[k][l], dw[m]);
        matrix[l][k] = arena.add(q[k][l], dw[m]);
    }
    matrix
}

impl Kinematics {
    /// The motion on a ground whose acceleration is given: minus gravity, so that weights need not
    /// be summed.
    #[must_use]
    pub(super) fn new(arena: &mut Arena, links: &Links, ground: Triple) -> Self {
        Self::of(arena, links, ground, Moving::Steadily)
    }

    /// The same with other rates.
    #[must_use]
    pub(super) fn of(arena: &mut Arena, links: &Links, ground: Triple, moving: Moving<'_>) -> Self {
        let mut motion = Self {
            ground,
            spin: Vec::new(),
            velocity: Vec::new(),
            spin_bias: Vec::new(),
            bias: Vec::new(),
            second: Vec::new(),
        };
        for (place, link) in links.links.iter().enumerate() {
            let axes = link.axes;
            let of =
                |values: &[Triple], link: Option<usize>| link.map_or(ZERO, |link| values[link]);
            let turned = |arena: &mut Arena, values: &[Triple], from: Option<usize>| {
                links
                    .frames
                    .turn(arena, of(values, from), links.axes(from), axes)
            };
            let base = links.base(place);
            let (base_spin, base_bias) = (
                turned(arena, &motion.spin, base),
                turned(arena, &motion.spin_bias, base),
            );
            let (spin, spin_bias) = match link.freedom {
                Freedom::Turn { axis, .. } | Freedom::Screw { axis, .. } => {
                    let rate = moving.rate(arena, link.velocity);
                    let unit = links.in_axes(arena, Links::unit(axis), Some(place));
                    let relative = unit.map(|component| arena.mul(component, rate));
                    let gyroscopic = cross(arena, base_spin, relative);
                    let bias = add(arena, base_bias, gyroscopic);
                    let own = scale(arena, moving.second_rate(link.velocity), unit);
                    (add(arena, base_spin, relative), add(arena, bias, own))
                }
                Freedom::Slide { .. } => (base_spin, base_bias),
                Freedom::Ball { .. } => {
                    let velocities = [0, 1, 2].map(|k| link.velocity + k);
                    let rates = velocities.map(|velocity| moving.rate(arena, velocity));
                    (
                        rates,
                        velocities.map(|velocity| moving.second_rate(velocity)),
                    )
                }
            };
            let offset = links.offset(arena, place);
            let carrier_spin = of(&motion.spin, link.carrier);
            let sweep = cross(arena, carrier_spin, offset);
            let mut velocity = add(arena, of(&motion.velocity, link.carrier), sweep);
            let mut bias = link.carrier.map_or(ground, |carrier| motion.bias[carrier]);
            if let Some(carrier) = link.carrier {
                let bend = apply(arena, motion.second[carrier], offset);
                bias = add(arena, bias, bend);
            }
            if let Some(along) = links.origin_rate(arena, place) {
                let rate = moving.rate(arena, link.velocity);
                let relative = along.map(|component| arena.mul(component, rate));
                velocity = add(arena, velocity, relative);
                let coriolis = cross(arena, carrier_spin, relative);
                let twice = add(arena, coriolis, coriolis);
                bias = add(arena, bias, twice);
                let own = scale(arena, moving.second_rate(link.velocity), along);
                bias = add(arena, bias, own);
            }
            let from = links.axes(link.carrier);
            motion
                .velocity
                .push(links.frames.turn(arena, velocity, from, axes));
            motion.bias.push(links.frames.turn(arena, bias, from, axes));
            motion.spin.push(spin);
            motion.spin_bias.push(spin_bias);
            motion.second.push(second(arena, spin, spin_bias));
        }
        motion
    }
}

//! Forces of the language: their sum on the bodies, their energy and their power.

use super::arena::{Arena, Expr};
use super::bind::Effect;
use super::motion::Gradient;
use super::scene::Scene;

impl Scene {
    /// Forces and moments of all force elements.
    pub fn applied(&mut self) -> Gradient {
        let mut gradient = Gradient::default();
        for place in 0..self.effects.len() {
            self.add_effects(place, &mut gradient);
        }
        gradient
    }

    /// Adds forces and moments of one force element.
    pub fn add_effects(&mut self, element: usize, gradient: &mut Gradient) {
        let Self {
            space,
            motion,
            effects,
            ..
        } = self;
        for effect in &effects[element] {
            match effect {
                Effect::Potential(energy) => {
                    energy.pull_back(space, motion, -Arena::ONE, gradient);
                }
                Effect::Along(effort, coordinate) => {
                    let effort = effort.value(space, motion);
                    coordinate.pull_back(space, motion, effort, gradient);
                }
                Effect::Force(force, point) => {
                    let force = force.value(space, motion);
                    point.pull_back(space, motion, Arena::ONE, force, gradient);
                }
                Effect::Moment(moment, Some(body)) => {
                    let moment = moment.value(space, motion);
                    let moment = space.moment_on(moment, *body);
                    gradient.add_moment(*body, moment);
                }
                Effect::Moment(_, None) => {}
            }
        }
    }

    /// The potential energy of one force element, and the power of what it does besides.
    pub fn energy_and_power(&mut self, element: usize) -> [Expr; 2] {
        let Self {
            space,
            motion,
            effects,
            ..
        } = self;
        let (mut energy, mut power) = (Arena::ZERO, Arena::ZERO);
        for effect in &effects[element] {
            match effect {
                Effect::Potential(potential) => {
                    let potential = potential.value(space, motion);
                    energy = space.arena.add(energy, potential);
                }
                Effect::Along(effort, coordinate) => {
                    let effort = effort.value(space, motion);
                    let rate = coordinate.rate(space, motion);
                    let product = space.arena.mul(effort, rate);
                    power = space.arena.add(power, product);
                }
                Effect::Force(force, point) => {
                    let force = force.value(space, motion);
                    let rate = point.rate(space, motion);
                    let product = space.dot(force, rate);
                    power = space.arena.add(power, product);
                }
                Effect::Moment(moment, Some(body)) => {
                    let moment = moment.value(space, motion);
                    let product = space.dot(moment, motion.spin[*body]);
                    power = space.arena.add(power, product);
                }
                Effect::Moment(_, None) => {}
            }
        }
        [energy, power]
    }
}

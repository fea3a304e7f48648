//! Joint coordinates of bodies that stand somewhere: what moves a body against its carrier is read
//! from how the two stand and move.
//!
//! What the joints of the tree forbid is not looked at: bodies that do not satisfy them are given
//! the nearest motion that does.

use super::algebra::{add, apply, scale, sub};
use super::frames::identity;
use super::freedom::Freedom;
use super::links::Links;
use crate::model::{BodyKind, Model};
use crate::symbolic::arena::{Arena, Expr, Input};
use crate::symbolic::fixed::transpose;
use crate::symbolic::functions::nearest_angle;
use crate::symbolic::rotation::normalised_rotation;
use crate::symbolic::vector::{Triple, ZERO, cross, dot};

/// How a link stands and moves, global axes.
#[derive(Clone, Copy, Debug)]
struct Pose {
    /// From its frame to global axes.
    axes: [Triple; 3],
    spin: Triple,
    /// Of the origin; unknown on the way to a body.
    position: Triple,
    velocity: Triple,
}

impl Pose {
    const fn ground() -> Self {
        let (o, l) = (Arena::ZERO, Arena::ONE);
        Self {
            axes: [[l, o, o], [o, l, o], [o, o, l]],
            spin: ZERO,
            position: ZERO,
            velocity: ZERO,
        }
    }

    /// What a column of the axes is: a coordinate axis of the frame.
    fn axis(&self, k: usize) -> Triple {
        [0, 1, 2].map(|row| self.axes[row][k])
    }
}

/// Joint coordinates, auxiliary variables and velocities from the coordinates, auxiliary variables
/// and velocities of the bodies. The user's own states stay what they are.
#[must_use]
pub fn from_bodies(arena: &mut Arena, model: &Model, links: &Links) -> Vec<Expr> {
    let layout = model.layout();
    let mut reader = Reader {
        links,
        poses: vec![Pose::ground(); links.links.len()],
        coordinates: vec![Arena::ZERO; 2 * links.turns + links.rest],
        counters: (0..layout.auxiliaries + layout.states)
            .map(|k| arena.input(Input::Coordinate((layout.coordinates + k) as u32)))
            .collect(),
        velocities: vec![Arena::ZERO; links.velocities],
    };
    // A link stands behind its carrier, and so do the bodies on it; of those welded to each other
    // the one that the joint carries comes first: a ball's Euler parameters are its own.
    let mut bodies: Vec<usize> = (0..model.bodies.len()).collect();
    bodies.sort_by_key(|&body| {
        let link = links.bodies[body].link;
        (
            link,
            link.is_some_and(|link| links.links[link].body != body),
        )
    });
    let mut last = None;
    for body in bodies {
        let standing = links.bodies[body];
        let Some(link) = standing.link else { continue };
        if last == Some(link) {
            // Welded to another one.
            continue;
        }
        last = Some(link);
        let [q, u] = [layout.coordinate[body], layout.velocity[body]];
        let at = |k: usize| Input::Coordinate((q + k) as u32);
        let rate = |k: usize| Input::Velocity((u + k) as u32);
        let position = [0, 1, 2].map(|k| arena.input(at(k)));
        let velocity = [0, 1, 2].map(|k| arena.input(rate(k)));
        let (mut axes, mut spin, mut p) = (identity(), ZERO, None);
        if model.bodies[body].kind == BodyKind::Rigid {
            let parameters = [3, 4, 5, 6].map(|k| arena.input(at(k)));
            let rotation = normalised_rotation(arena, parameters);
            // From the link's frame to principal axes, then to global ones.
            let columns = standing.axes.map(|row| apply(arena, rotation, row));
            axes = transpose(columns);
            let own = [3, 4, 5].map(|k| arena.input(rate(k)));
            spin = apply(arena, rotation, own);
            p = Some((parameters, own));
        }
        let arm = apply(arena, axes, standing.centre);
        let sweep = cross(arena, spin, arm);
        let pose = Pose {
            axes,
            spin,
            position: sub(arena, position, arm),
            velocity: sub(arena, velocity, sweep),
        };
        reader.read(arena, link, pose, p);
    }
    let Reader {
        mut coordinates,
        counters,
        velocities,
        ..
    } = reader;
    coordinates.extend(counters);
    coordinates.extend(velocities);
    coordinates
}

struct Reader<'a> {
    links: &'a Links,
    poses: Vec<Pose>,
    coordinates: Vec<Expr>,
    /// The auxiliary variables, and the user's own states behind them.
    counters: Vec<Expr>,
    velocities: Vec<Expr>,
}

impl Reader<'_> {
    /// Reads the motions between a body's link and what carries it.
    fn read(
        &mut self,
        arena: &mut Arena,
        link: usize,
        pose: Pose,
        parameters: Option<([Expr; 4], Triple)>,
    ) {
        let way = self.links.way(link);
        self.turns(arena, &way, pose);
        for &place in &way {
            let own = &self.links.links[place];
            if let (Freedom::Ball { rest }, Some((p, w))) = (own.freedom, parameters) {
                let squares = p.map(|e| arena.square(e));
                let square = arena.sum(squares);
                let length = arena.sqrt(square);
                let first = 2 * self.links.turns + rest;
                let unit = p.map(|e| arena.div(e, length));
                self.coordinates[first..first + 4].copy_from_slice(&unit);
                self.velocities[own.velocity..own.velocity + 3].copy_from_slice(&w);
                self.poses[place] = pose;
            }
        }
        self.slides(arena, &way, pose);
        self.poses[link] = pose;
    }

    fn pose(&self, link: Option<usize>) -> Pose {
        link.map_or(Pose::ground(), |link| self.poses[link])
    }

    /// How the frame of a turning link would stand if it were not turned.
    fn before_turn(&self, arena: &mut Arena, link: usize) -> Pose {
        let base = self.links.base(link);
        let pose = self.pose(base);
        let between = self.links.before_turn(arena, base, link);
        let rows = pose.axes.map(|row| {
            let columns = transpose(between);
            columns.map(|column| dot(arena, row, column))
        });
        Pose { axes: rows, ..pose }
    }

    /// Angles and their rates.
    fn turns(&mut self, arena: &mut Arena, way: &[usize], pose: Pose) {
        let turning: Vec<(usize, usize, usize)> = way
            .iter()
            .filter_map(|&place| {
                let (axis, pair) = self.links.links[place].freedom.turn()?;
                Some((place, axis, pair))
            })
            .collect();
        let mut number = 0;
        for &place in way {
            if matches!(self.links.links[place].freedom, Freedom::Slide { .. }) {
                // It turns with what carries it.
                self.poses[place] = self.pose(self.links.links[place].carrier);
            }
            let Some(&(turn, axis, pair)) = turning.get(number) else {
                continue;
            };
            if turn != place {
                continue;
            }
            number += 1;
            let before = self.before_turn(arena, place);
            let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
            let [bi, bj] = [i, j].map(|k| before.axis(k));
            let (cosine, sine) = match turning.get(number) {
                None => {
                    // The frame itself is known.
                    let [oi, oj] = [i, j].map(|k| pose.axis(k));
                    let parts = [(bi, oi), (bj, oj), (bj, oi), (bi, oj)];
                    let [ii, jj, ji, ij] = parts.map(|(a, b)| dot(arena, a, b));
                    (arena.add(ii, jj), arena.sub(ji, ij))
                }
                Some(&(next, other, _)) => {
                    // It carries the next axis along.
                    let between = self.links.between(arena, Some(place), next);
                    let [ai, aj] = [i, j].map(|k| between[k][other]);
                    let taken = pose.axis(other);
                    let [di, dj] = [bi, bj].map(|b| dot(arena, b, taken));
                    let parts = [(ai, di), (aj, dj), (ai, dj), (aj, di)];
                    let [ii, jj, ij, ji] = parts.map(|(a, b)| arena.mul(a, b));
                    (arena.add(ii, jj), arena.sub(ij, ji))
                }
            };
            let [cc, ss] = [cosine, sine].map(|x| arena.square(x));
            let square = arena.add(cc, ss);
            let length = arena.sqrt(square);
            let [c, s] = [cosine, sine].map(|x| arena.div(x, length));
            self.coordinates[2 * pair] = c;
            self.coordinates[2 * pair + 1] = s;
            self.count(arena, place, [c, s]);
            // Turned by its angle.
            let mut axes = transpose(before.axes);
            let [ci, si, cj, sj] =
                [(c, bi), (s, bi), (c, bj), (s, bj)].map(|(x, b)| scale(arena, x, b));
            axes[i] = add(arena, ci, sj);
            axes[j] = sub(arena, cj, si);
            self.poses[place] = Pose {
                axes: transpose(axes),
                ..before
            };
        }
        self.turn_rates(arena, &turning, pose);
    }

    /// The angle of a screw over any number of turns: that of its pair, near to what was counted.
    fn count(&mut self, arena: &mut Arena, link: usize, parts: [Expr; 2]) {
        if let Freedom::Screw {
            pair,
            is_reversed,
            counter,
            ..
        } = self.links.links[link].freedom
        {
            let [c, s] = self.links.since_reference(arena, pair, parts);
            let s = if is_reversed { -s } else { s };
            self.counters[counter] = nearest_angle(arena, self.counters[counter], s, c);
        }
    }

    fn turn_rates(&mut self, arena: &mut Arena, turning: &[(usize, usize, usize)], pose: Pose) {
        let Some(&(first, axis, _)) = turning.first() else {
            return;
        };
        let base = self.pose(self.links.base(first));
        let relative = sub(arena, pose.spin, base.spin);
        let a = self.poses[first].axis(axis);
        let along = dot(arena, a, relative);
        let velocity = |place: usize| self.links.links[place].velocity;
        match turning.get(1) {
            None => self.velocities[velocity(first)] = along,
            Some(&(second, other, _)) => {
                // The two rates that come nearest to it.
                let b = pose.axis(other);
                let (across, mixed) = (dot(arena, b, relative), dot(arena, a, b));
                let square = arena.square(mixed);
                let determinant = arena.sub(Arena::ONE, square);
                let rates = [(along, across), (across, along)].map(|(own, other)| {
                    let shared = arena.mul(mixed, other);
                    let rest = arena.sub(own, shared);
                    arena.div(rest, determinant)
                });
                self.velocities[velocity(first)] = rates[0];
                self.velocities[velocity(second)] = rates[1];
                let turned = scale(arena, rates[0], a);
                self.poses[first].spin = add(arena, base.spin, turned);
            }
        }
        if turning.len() == 1 {
            self.poses[first].spin = pose.spin;
        }
    }

    /// Displacements and their rates.
    fn slides(&mut self, arena: &mut Arena, way: &[usize], pose: Pose) {
        let Some(&first) = way.first() else { return };
        // From where the body's link would stand had nothing slid.
        let start = self.pose(self.links.links[first].carrier);
        let mut rest = sub(arena, pose.position, start.position);
        let mut rate = sub(arena, pose.velocity, start.velocity);
        let mut sliding = Vec::new();
        for &place in way {
            let own = &self.links.links[place];
            let carrier = self.pose(own.carrier);
            let mut offset = own.offset;
            if let Freedom::Screw {
                counter,
                is_reversed,
                ..
            } = own.freedom
            {
                let moved = self.links.advanced(arena, place, self.counters[counter]);
                offset = add(arena, offset, moved);
                let velocity = self.velocities[own.velocity];
                let velocity = if is_reversed { -velocity } else { velocity };
                let moving = self.links.advanced(arena, place, velocity);
                let moving = apply(arena, carrier.axes, moving);
                rate = sub(arena, rate, moving);
            }
            let offset = apply(arena, carrier.axes, offset);
            let sweep = cross(arena, carrier.spin, offset);
            rest = sub(arena, rest, offset);
            rate = sub(arena, rate, sweep);
            if let Freedom::Slide { along, rest } = own.freedom {
                let along = apply(arena, carrier.axes, along);
                sliding.push((
                    along,
                    carrier.spin,
                    2 * self.links.turns + rest,
                    own.velocity,
                ));
                self.poses[place] = carrier;
            }
        }
        for (along, spin, coordinate, velocity) in sliding {
            self.coordinates[coordinate] = dot(arena, along, rest);
            let turned = cross(arena, spin, along);
            let (first, second) = (dot(arena, along, rate), dot(arena, turned, rest));
            self.velocities[velocity] = arena.add(first, second);
        }
    }
}

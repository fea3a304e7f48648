//! Links: what carries what. A joint is one link for each of its motions, the last of which carries
//! the body; those before have no mass.

use super::algebra::{Inertia, add_tensors, apply, sub};
use super::align::{NOT_TURNED, ReferenceAngle, best_angle, turned_axes};
use super::frames::{FrameId, Frames, identity};
use super::freedom::Freedom;
use super::spanning::{Carried, Spanning};
use crate::model::{BodyKind, Direction, Model, Motion, Number};
use crate::symbolic::arena::{Arena, Input};
use crate::symbolic::fixed::{axis_and_normals, clean, placement, size, transpose, triple};
use crate::symbolic::vector::{Triple, ZERO};

/// A link.
#[derive(Clone, Debug)]
pub struct Link {
    /// The link that carries it, `None` for the ground.
    pub carrier: Option<usize>,
    /// Its motion.
    pub freedom: Freedom,
    /// The axes that it turns with.
    pub frame: FrameId,
    /// The axes in which its motion is written: its own, or those that they turn against.
    pub axes: FrameId,
    /// Its origin from that of the carrier, where nothing has slid; in the carrier's frame.
    pub offset: Triple,
    /// The inertia that moves with it, about its origin, in its frame.
    pub(super) inertia: Inertia,
    /// Its first velocity.
    pub velocity: usize,
    /// The joint that it is a motion of, `None` of a body that moves freely.
    pub joint: Option<usize>,
    /// The body that the joint carries.
    pub body: usize,
}

/// How a body stands on the link that it moves with.
#[derive(Clone, Copy, Debug)]
pub struct Standing {
    /// The link, `None` for a body that is welded to the ground.
    pub link: Option<usize>,
    /// Its centre of mass from the link's origin, in the link's frame.
    pub centre: Triple,
    /// From principal axes to the link's frame.
    pub axes: [Triple; 3],
}

/// The links of a mechanism.
#[derive(Clone, Debug)]
pub struct Links {
    /// All frames.
    pub frames: Frames,
    /// A link stands behind its carrier.
    pub links: Vec<Link>,
    /// Body by body.
    pub bodies: Vec<Standing>,
    /// Pairs of cosine and sine.
    pub turns: usize,
    /// Coordinates behind the pairs.
    pub rest: usize,
    /// All velocities.
    pub velocities: usize,
    /// The angle of every pair in the reference configuration.
    pub(super) angles: Vec<ReferenceAngle>,
    /// The constant rotations from global axes in the reference configuration to each frame.
    from_global: Vec<[Triple; 3]>,
    /// The origins of the links in the reference configuration, global axes.
    origins: Vec<Triple>,
}

/// How runs of parallel axes are described.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Runs {
    /// Every angle against the carrier, in axes of its own.
    Relative,
    /// Angles against the carrier of the run, in axes that do not turn within it.
    Shared,
}

impl Links {
    /// What entries of a row are compared by: velocities with one number here have one unit, and
    /// none of them is small for that. Translations are alike, and the rotations of a ball.
    #[must_use]
    pub(super) fn alike(&self) -> Vec<usize> {
        let mut alike = vec![0; self.velocities];
        for (number, link) in self.links.iter().enumerate() {
            if !matches!(link.freedom, Freedom::Slide { .. }) {
                let velocities = alike.iter_mut().skip(link.velocity);
                let velocities = velocities.take(link.freedom.velocities());
                velocities.for_each(|kind| *kind = number + 1);
            }
        }
        alike
    }

    /// The links of a spanning tree, with their origins and the angles that they are counted from
    /// where vectors have the most zeros.
    #[must_use]
    pub fn new(arena: &mut Arena, model: &Model, spanning: &Spanning, runs: Runs) -> Self {
        let mut links = Self::about(arena, model, spanning, runs, &[]);
        let closing = links.closing_points(arena, model, &spanning.closing);
        let fixed = links.fixed_vectors(arena, &closing);
        let aligned = Self::about(arena, model, spanning, runs, &fixed);
        if aligned.angles.iter().any(|&angle| angle != NOT_TURNED) {
            links = aligned;
        }
        links
    }

    /// The links with origins where offsets have the most zeros, and angles counted from where
    /// vectors that are fixed on them have.
    fn about(
        arena: &mut Arena,
        model: &Model,
        spanning: &Spanning,
        runs: Runs,
        fixed: &[Vec<Triple>],
    ) -> Self {
        let turns = spanning.carried.iter().flat_map(|carried| &carried.motions);
        let turns = turns
            .filter(|motion| matches!(motion, Motion::Turn { .. } | Motion::Screw { .. }))
            .count();
        let mut links = Self {
            frames: Frames::alone(),
            links: Vec::new(),
            bodies: vec![
                Standing {
                    link: None,
                    centre: ZERO,
                    axes: identity(),
                };
                model.bodies.len()
            ],
            turns,
            rest: 0,
            velocities: 0,
            angles: vec![NOT_TURNED; turns],
            from_global: vec![identity()],
            origins: Vec::new(),
        };
        let mut pairs = 0;
        for carried in &spanning.carried {
            links.carry(arena, model, carried, (runs, fixed), &mut pairs);
        }
        links.slide_origins(arena);
        links
    }

    pub(super) fn frame_of(&self, link: Option<usize>) -> FrameId {
        link.map_or(Frames::GROUND, |link| self.links[link].frame)
    }

    /// The rotation from global axes in the reference configuration to a frame.
    pub(super) fn rotation_into(&self, frame: FrameId) -> [Triple; 3] {
        self.from_global[frame.place()]
    }

    /// Adds the links of one body.
    fn carry(
        &mut self,
        arena: &mut Arena,
        model: &Model,
        carried: &Carried,
        (runs, fixed): (Runs, &[Vec<Triple>]),
        pairs: &mut usize,
    ) {
        let mut carrier = carried.by.and_then(|body| self.bodies[body].link);
        let body = &model.bodies[carried.body];
        let placed = placement(arena, model, Some(carried.body));
        for (place, motion) in carried.motions.iter().enumerate() {
            let later = carried.motions[place..].iter();
            let origin = later
                .filter_map(|motion| match motion {
                    Motion::Turn { point, .. }
                    | Motion::Screw { point, .. }
                    | Motion::Ball { point } => Some(*point),
                    Motion::Slide { .. } => None,
                })
                .map(|point| carried.point(arena, model, point))
                .next()
                .unwrap_or(placed.position);
            let base = self.frame_of(carrier);
            let link = match *motion {
                Motion::Turn { axis, .. } => {
                    let direction = carried.direction(arena, model, axis);
                    let (base, axis, is_negative) = self.along_axis(arena, base, direction);
                    let base = match (runs, carrier) {
                        (Runs::Shared, Some(carrier)) => self.base_of_run(carrier, base, axis),
                        _ => base,
                    };
                    let (pair, frame) = self.turned_frame(arena, (base, axis), fixed, pairs);
                    let freedom = Freedom::Turn {
                        axis,
                        pair,
                        is_reversed: is_negative != carried.is_reversed,
                    };
                    (freedom, frame, frame)
                }
                Motion::Screw { axis, pitch, .. } => {
                    let counter = carried.counter(model, axis);
                    let advance = carried.advance(arena, model, pitch);
                    let direction = carried.direction(arena, model, Direction::axis(axis));
                    let (base, axis, is_negative) = self.along_axis(arena, base, direction);
                    // It leaves the plane of a run, so that it is against its carrier.
                    let (pair, frame) = self.turned_frame(arena, (base, axis), fixed, pairs);
                    let freedom = Freedom::Screw {
                        axis,
                        pair,
                        is_reversed: is_negative != carried.is_reversed,
                        advance,
                        counter,
                    };
                    (freedom, frame, frame)
                }
                Motion::Slide { along } => {
                    let direction = carried.direction(arena, model, along);
                    let direction = if carried.is_reversed {
                        direction.map(|component| -component)
                    } else {
                        direction
                    };
                    let into = self.rotation_into(base);
                    let along = apply(arena, into, direction);
                    let along = clean(arena, along, 1.0);
                    let rest = self.rest;
                    self.rest += 1;
                    let axes = carrier.map_or(Frames::GROUND, |link| self.links[link].axes);
                    (Freedom::Slide { along, rest }, base, axes)
                }
                Motion::Ball { .. } => {
                    let rest = self.rest;
                    self.rest += 4;
                    let first = 2 * self.turns + rest;
                    let p =
                        [0, 1, 2, 3].map(|k| arena.input(Input::Coordinate((first + k) as u32)));
                    let frame = self.frames.free(arena, p);
                    self.from_global.push(transpose(placed.axes));
                    (Freedom::Ball { rest }, frame, frame)
                }
            };
            let (freedom, frame, axes) = link;
            let from = carrier.map_or(ZERO, |link| self.origins[link]);
            let offset = sub(arena, origin, from);
            let scale = size(arena, origin).max(size(arena, from));
            let offset = clean(arena, offset, scale);
            let offset = self.turned_into(arena, offset, base);
            let velocity = self.velocities;
            self.velocities += freedom.velocities();
            self.links.push(Link {
                carrier,
                freedom,
                frame,
                axes,
                offset,
                inertia: Inertia::NONE,
                velocity,
                joint: carried.joint,
                body: carried.body,
            });
            self.origins.push(origin);
            carrier = Some(self.links.len() - 1);
        }
        let frame = self.frame_of(carrier);
        let from = carrier.map_or(ZERO, |link| self.origins[link]);
        let arm = sub(arena, placed.position, from);
        let scale = size(arena, placed.position).max(size(arena, from));
        let arm = clean(arena, arm, scale);
        let centre = self.turned_into(arena, arm, frame);
        // Column by column: principal to global to frame.
        let columns = transpose(placed.axes).map(|column| self.turned_into(arena, column, frame));
        let axes = transpose(columns);
        self.bodies[carried.body] = Standing {
            link: carrier,
            centre,
            axes,
        };
        let Some(link) = carrier else { return };
        let mass = crate::symbolic::fixed::number(arena, body.mass);
        let mut inertia = Inertia::point(arena, mass, centre);
        if body.kind == BodyKind::Rigid {
            let principal = triple(arena, body.inertia);
            let mut tensor = super::algebra::NOTHING;
            for k in 0..3 {
                for l in 0..3 {
                    let products = [0, 1, 2].map(|m| {
                        let both = arena.mul(axes[k][m], axes[l][m]);
                        arena.mul(principal[m], both)
                    });
                    tensor[k][l] = arena.sum(products);
                }
            }
            inertia.tensor = add_tensors(arena, inertia.tensor, tensor);
        }
        self.links[link].inertia = self.links[link].inertia.plus(arena, inertia);
    }

    /// A pair, and the frame of the next link, which turns by it about a coordinate axis of another
    /// one. The angle counts from where the vectors that are fixed on the link have the most zeros.
    fn turned_frame(
        &mut self,
        arena: &mut Arena,
        (base, axis): (FrameId, usize),
        fixed: &[Vec<Triple>],
        pairs: &mut usize,
    ) -> (usize, FrameId) {
        let pair = *pairs;
        *pairs += 1;
        let [c, s] =
            [2 * pair, 2 * pair + 1].map(|place| arena.input(Input::Coordinate(place as u32)));
        let frame = self.frames.turned(base, axis, c, s);
        if let Some(fixed) = fixed.get(self.links.len()) {
            let fixed = fixed.iter().map(|&v| self.turned_into(arena, v, base));
            let fixed: Vec<Triple> = fixed.collect();
            self.angles[pair] = best_angle(arena, &fixed, axis);
        }
        let turned = self.turned_by(arena, base, axis, self.angles[pair]);
        self.from_global.push(turned);
        (pair, frame)
    }

    /// The rotation from global axes in the reference configuration to a frame that is turned about
    /// a coordinate axis of another.
    fn turned_by(
        &self,
        arena: &mut Arena,
        base: FrameId,
        axis: usize,
        angle: ReferenceAngle,
    ) -> [Triple; 3] {
        let into = self.rotation_into(base);
        if angle == NOT_TURNED {
            return into;
        }
        let across = ((axis + 1) % 3, (axis + 2) % 3);
        let columns = transpose(into);
        transpose(columns.map(|column| turned_axes(arena, column, across, angle, 1.0)))
    }

    /// A vector of the reference configuration in a frame, without round-off beside its size.
    fn turned_into(&self, arena: &mut Arena, v: Triple, frame: FrameId) -> Triple {
        let turned = apply(arena, self.rotation_into(frame), v);
        let scale = size(arena, v);
        clean(arena, turned, scale)
    }

    /// A point of the reference configuration in the frame of the link that a body stands on, from
    /// that link's origin; of the ground, as it is.
    pub(super) fn point_on(
        &self,
        arena: &mut Arena,
        model: &Model,
        body: Option<usize>,
        point: [Number; 3],
    ) -> Triple {
        let point = triple(arena, point);
        let Some(body) = body else { return point };
        let Standing { link, centre, .. } = self.bodies[body];
        let position = triple(arena, model.bodies[body].position);
        let arm = sub(arena, point, position);
        let scale = size(arena, point).max(size(arena, position));
        let arm = clean(arena, arm, scale);
        let arm = self.turned_into(arena, arm, self.frame_of(link));
        let sum = super::algebra::add(arena, centre, arm);
        clean(arena, sum, scale)
    }

    /// A frame at rest in another in which a direction is a coordinate axis; that one itself if it
    /// is one there.
    fn along_axis(
        &mut self,
        arena: &mut Arena,
        base: FrameId,
        direction: Triple,
    ) -> (FrameId, usize, bool) {
        let own = self.turned_into(arena, direction, base);
        for axis in 0..3 {
            let mut unit = ZERO;
            unit[axis] = Arena::ONE;
            if own == unit || own == unit.map(|component| -component) {
                return (base, axis, own != unit);
            }
        }
        let [third, first, second] = axis_and_normals(arena, own);
        let rows = transpose([first, second, third]);
        let frame = self.frames.fixed(base, rows);
        let into = self.rotation_into(base);
        let columns = transpose(into);
        let turned = columns.map(|column| {
            let turned = [first, second, third];
            let turned = apply(arena, turned, column);
            clean(arena, turned, 1.0)
        });
        self.from_global.push(transpose(turned));
        (frame, 2, false)
    }

    /// The rotation from a link's frame to that of one further down in the reference configuration,
    /// row by row.
    pub(super) fn between(
        &self,
        arena: &mut Arena,
        from: Option<usize>,
        link: usize,
    ) -> [Triple; 3] {
        let own = self.rotation_into(self.links[link].frame);
        self.rotation_between(arena, from, own)
    }

    /// The links of a body from the first to the last, which is given: those before have no body.
    pub(super) fn way(&self, link: usize) -> Vec<usize> {
        let has_body = |link: usize| self.bodies.iter().any(|body| body.link == Some(link));
        let mut way = vec![link];
        let mut carrier = self.links[link].carrier;
        while let Some(place) = carrier.filter(|&place| !has_body(place)) {
            way.push(place);
            carrier = self.links[place].carrier;
        }
        way.reverse();
        way
    }

    /// The rotation from a link's frame, were it not turned, to that of one further down, row by
    /// row.
    pub(super) fn before_turn(
        &self,
        arena: &mut Arena,
        from: Option<usize>,
        link: usize,
    ) -> [Triple; 3] {
        let own = self.rotation_into(self.frames.base(self.links[link].frame));
        self.rotation_between(arena, from, own)
    }

    fn rotation_between(
        &self,
        arena: &mut Arena,
        from: Option<usize>,
        own: [Triple; 3],
    ) -> [Triple; 3] {
        let from = self.rotation_into(self.frame_of(from));
        from.map(|row| {
            let turned = apply(arena, own, row);
            clean(arena, turned, 1.0)
        })
    }

    /// The axis of a link in the frame of its carrier.
    pub(super) fn axis_on_carrier(&self, arena: &mut Arena, link: usize, axis: usize) -> Triple {
        let rows = self.between(arena, self.links[link].carrier, link);
        rows.map(|row| row[axis])
    }

    /// A part of a link's inertia that is the same however the link is turned, about the origin and
    /// in the frame of the carrier.
    pub(super) fn part_on_carrier(&self, arena: &mut Arena, link: usize, part: Inertia) -> Inertia {
        let rows = self.between(arena, self.links[link].carrier, link);
        let mut tensor = super::algebra::NOTHING;
        for k in 0..3 {
            let column = apply(arena, part.tensor, rows[k]);
            tensor[k] = apply(arena, rows, column);
        }
        let turned = Inertia {
            mass: part.mass,
            first: apply(arena, rows, part.first),
            tensor,
        };
        turned.seen_at(arena, self.links[link].offset)
    }

    /// The frame that a link's angle is measured against: where its carrier turns about the same
    /// axis, the one that the carrier's is.
    fn base_of_run(&mut self, carrier: usize, base: FrameId, axis: usize) -> FrameId {
        let link = &self.links[carrier];
        match link.freedom {
            Freedom::Turn { axis: other, .. } if other == axis && link.frame == base => {
                self.frames.base(base)
            }
            _ => base,
        }
    }

    /// The carrier of a turn, where the angles of both are measured against what carries a run of
    /// parallel axes.
    pub(super) fn measured_with(&self, link: &Link) -> Option<usize> {
        let carrier = link.carrier?;
        let [own, other] = [link, &self.links[carrier]].map(|link| match link.freedom {
            Freedom::Turn { .. } => Some(self.frames.base(link.frame)),
            _ => None,
        });
        (own.is_some() && own == other).then_some(carrier)
    }

    /// The angle of a turn in the reference configuration (rad); zero of other motions.
    pub(super) fn zero(&self, arena: &Arena, link: &Link) -> f64 {
        let Some((_, pair)) = link.freedom.turn() else {
            return 0.0;
        };
        let [c, s] = self.angles[pair].map(|part| arena.literal(part));
        s.zip(c).map_or(0.0, |(s, c)| s.atan2(c))
    }

    /// The links from the leaves to the ground.
    pub fn leaves_first(&self) -> impl Iterator<Item = usize> + use<> {
        (0..self.links.len()).rev()
    }

    /// The links that a link carries.
    pub fn children(&self, link: Option<usize>) -> impl Iterator<Item = usize> + '_ {
        (0..self.links.len()).filter(move |&child| self.links[child].carrier == link)
    }

    /// Whether a link turns when its carrier does: else it is only taken along.
    #[must_use]
    pub fn turns_with_carrier(&self, link: usize) -> bool {
        let carrier = self.links[link].carrier;
        let carrier = self.frame_of(carrier);
        self.frames.follows(self.links[link].frame, carrier)
    }

    /// The axes in which the motion of a link, or of the ground, is written.
    #[must_use]
    pub fn axes(&self, link: Option<usize>) -> FrameId {
        link.map_or(Frames::GROUND, |link| self.links[link].axes)
    }

    /// Writes the motion of runs in axes that do not turn with them.
    pub fn share_axes(&mut self) {
        for place in 0..self.links.len() {
            let link = &self.links[place];
            if !matches!(link.freedom, Freedom::Turn { .. }) {
                if let (Freedom::Slide { .. }, Some(carrier)) = (link.freedom, link.carrier) {
                    self.links[place].axes = self.links[carrier].axes;
                }
                continue;
            }
            let base = self.frames.base(link.frame);
            let with_carrier = link.carrier.is_some() && !self.turns_with_carrier(place);
            let children: Vec<usize> = self.children(Some(place)).collect();
            let taken_along = children.iter().any(|&child| {
                matches!(self.links[child].freedom, Freedom::Turn { .. })
                    && !self.turns_with_carrier(child)
            });
            let turning = children.iter().any(|&child| self.turns_with_carrier(child));
            if (with_carrier || taken_along) && !turning {
                self.links[place].axes = base;
            }
        }
    }

    /// A vector of a link's own frame in the axes of its motion.
    pub fn in_axes(&self, arena: &mut Arena, v: Triple, link: Option<usize>) -> Triple {
        let (frame, axes) = (self.frame_of(link), self.axes(link));
        self.frames.turn(arena, v, frame, axes)
    }

    /// The inertia of a link in the axes of its motion.
    pub(super) fn inertia_in_axes(&self, arena: &mut Arena, link: usize) -> Inertia {
        let own = &self.links[link];
        Inertia {
            mass: own.inertia.mass,
            first: self.in_axes(arena, own.inertia.first, Some(link)),
            tensor: self
                .frames
                .tensor(arena, own.inertia.tensor, own.frame, own.axes),
        }
    }

    /// The unit vector of a turn.
    #[must_use]
    pub fn unit(axis: usize) -> Triple {
        let mut unit = ZERO;
        unit[axis] = Arena::ONE;
        unit
    }
}

//! Differentiation on vectors.
//!
//! Two rules, never a component of `p`: a virtual rotation `dw` (body axes) moves a vector `A s` by
//! `A (dw x s)`, and time does the same with `w`. Everything else is the product rule.

use super::arena::{Arena, Expr};
use super::expression::{AngleExpr, PairedAngle, ScalarExpr, VectorExpr};
use super::functions::nearest_angle;
use super::motion::{Gradient, Motion};
use super::vector::{Frame, Space, VectorId, ZERO};

impl VectorExpr {
    /// The vector itself.
    pub fn value(&self, space: &mut Space, motion: &Motion) -> VectorId {
        match self {
            Self::Fixed(body, s) => space.native(Frame::of(*body), *s),
            Self::Point(None, s) => space.native(Frame::Global, *s),
            Self::Point(Some(body), s) => {
                let arm = space.native(Frame::Body(*body), *s);
                space.sum([(Arena::ONE, motion.position[*body]), (Arena::ONE, arm)])
            }
            Self::Sum(terms) => {
                let terms: Vec<_> = terms
                    .iter()
                    .map(|(factor, term)| (*factor, term.value(space, motion)))
                    .collect();
                space.sum(terms)
            }
            Self::Scaled(factor, vector) => {
                let factor = factor.value(space, motion);
                let vector = vector.value(space, motion);
                space.scale(factor, vector)
            }
            Self::Cross(a, b) => {
                let (a, b) = (a.value(space, motion), b.value(space, motion));
                space.cross(Frame::Global, a, b)
            }
            Self::Rate(inner) => inner.rate(space, motion),
            Self::Spin([from, to]) => {
                let spin = |(body, sign): (Option<usize>, Expr)| Some((sign, motion.spin[body?]));
                let spins = [(*to, Arena::ONE), (*from, -Arena::ONE)];
                space.sum(spins.into_iter().filter_map(spin))
            }
        }
    }

    /// The time derivative; of what holds rates itself, without the terms of `v'` and `w'`.
    pub fn rate(&self, space: &mut Space, motion: &Motion) -> VectorId {
        match self {
            Self::Fixed(None, _) | Self::Point(None, _) => space.native(Frame::Global, ZERO),
            Self::Fixed(Some(body), s) => {
                let vector = space.native(Frame::Body(*body), *s);
                space.cross(Frame::Body(*body), motion.spin[*body], vector)
            }
            Self::Point(Some(body), s) => {
                let arm = Self::Fixed(Some(*body), *s).rate(space, motion);
                space.sum([(Arena::ONE, motion.velocity[*body]), (Arena::ONE, arm)])
            }
            Self::Sum(terms) => {
                let terms: Vec<_> = terms
                    .iter()
                    .map(|(factor, term)| (*factor, term.rate(space, motion)))
                    .collect();
                space.sum(terms)
            }
            Self::Scaled(factor, vector) => {
                let (f, v) = (factor.value(space, motion), vector.value(space, motion));
                let (df, dv) = (factor.rate(space, motion), vector.rate(space, motion));
                space.sum([(df, v), (f, dv)])
            }
            Self::Cross(a, b) => {
                let (da, db) = (a.rate(space, motion), b.rate(space, motion));
                let (a, b) = (a.value(space, motion), b.value(space, motion));
                let (first, second) = (
                    space.cross(Frame::Global, da, b),
                    space.cross(Frame::Global, a, db),
                );
                space.sum([(Arena::ONE, first), (Arena::ONE, second)])
            }
            Self::Rate(inner) => inner.bias(space, motion),
            // (A w)' = A w', since w x w vanishes.
            Self::Spin(_) => space.native(Frame::Global, ZERO),
        }
    }

    /// The second time derivative without the terms of `v'` and `w'`.
    pub fn bias(&self, space: &mut Space, motion: &Motion) -> VectorId {
        match self {
            Self::Fixed(None, _) | Self::Point(None, _) => space.native(Frame::Global, ZERO),
            Self::Fixed(Some(body), s) => space.spun(*body, motion.spin_components[*body], *s),
            Self::Point(Some(body), s) => {
                let arm = motion.arm(space, *body, *s);
                space.spun(*body, motion.spin_components[*body], arm)
            }
            Self::Sum(terms) => {
                let terms: Vec<_> = terms
                    .iter()
                    .map(|(factor, term)| (*factor, term.bias(space, motion)))
                    .collect();
                space.sum(terms)
            }
            Self::Scaled(factor, vector) => {
                let (f, v) = (factor.value(space, motion), vector.value(space, motion));
                let (df, dv) = (factor.rate(space, motion), vector.rate(space, motion));
                let (ddf, ddv) = (factor.bias(space, motion), vector.bias(space, motion));
                let two = space.arena.constant(2.0);
                let mixed = space.arena.mul(two, df);
                space.sum([(ddf, v), (mixed, dv), (f, ddv)])
            }
            Self::Cross(a, b) => {
                let (dda, ddb) = (a.bias(space, motion), b.bias(space, motion));
                let (da, db) = (a.rate(space, motion), b.rate(space, motion));
                let (a, b) = (a.value(space, motion), b.value(space, motion));
                let (first, mixed, last) = (
                    space.cross(Frame::Global, dda, b),
                    space.cross(Frame::Global, da, db),
                    space.cross(Frame::Global, a, ddb),
                );
                let two = space.arena.constant(2.0);
                space.sum([(Arena::ONE, first), (two, mixed), (Arena::ONE, last)])
            }
            Self::Rate(_) | Self::Spin(_) => {
                unreachable!("there is no rate of a rate in the language")
            }
        }
    }

    /// Adds the gradient of `covector . self`.
    pub fn pull_back(
        &self,
        space: &mut Space,
        motion: &Motion,
        factor: Expr,
        covector: VectorId,
        gradient: &mut Gradient,
    ) {
        match self {
            Self::Fixed(None, _) | Self::Point(None, _) => {}
            Self::Fixed(Some(body), s) => {
                // c . (dw x s) = dw . (s x c)
                let vector = space.native(Frame::Body(*body), *s);
                let covector = space.outside(covector, *body);
                let moment = space.cross(Frame::Body(*body), vector, covector);
                gradient.push_moment(*body, factor, moment);
            }
            Self::Point(Some(body), s) => {
                gradient.push_force(*body, factor, covector);
                let arm = motion.arm(space, *body, *s);
                Self::Fixed(Some(*body), arm).pull_back(space, motion, factor, covector, gradient);
            }
            Self::Sum(terms) => {
                for (coefficient, term) in terms {
                    let factor = space.arena.mul(factor, *coefficient);
                    term.pull_back(space, motion, factor, covector, gradient);
                }
            }
            Self::Scaled(scalar, vector) => {
                let value = scalar.value(space, motion);
                let scaled = space.arena.mul(factor, value);
                vector.pull_back(space, motion, scaled, covector, gradient);
                let vector = vector.value(space, motion);
                let along = space.dot(covector, vector);
                let seed = space.arena.mul(factor, along);
                scalar.pull_back(space, motion, seed, gradient);
            }
            Self::Cross(a, b) => {
                // c . (da x b) = da . (b x c) and c . (a x db) = db . (c x a)
                let (u, v) = (a.value(space, motion), b.value(space, motion));
                let (on_a, on_b) = (
                    space.cross(Frame::Global, v, covector),
                    space.cross(Frame::Global, covector, u),
                );
                a.pull_back(space, motion, factor, on_a, gradient);
                b.pull_back(space, motion, factor, on_b, gradient);
            }
            Self::Rate(_) | Self::Spin(_) => {
                unreachable!("only positions have a gradient by positions in the language")
            }
        }
    }
}

impl ScalarExpr {
    /// The number itself.
    pub fn value(&self, space: &mut Space, motion: &Motion) -> Expr {
        match self {
            Self::Constant(value) => *value,
            Self::Dot(a, b) => {
                let (a, b) = (a.value(space, motion), b.value(space, motion));
                space.dot(a, b)
            }
            Self::Sum(terms) => weighted(space, motion, terms, Self::value),
            Self::Product(a, b) => {
                let (a, b) = (a.value(space, motion), b.value(space, motion));
                space.arena.mul(a, b)
            }
            Self::Time => motion.time,
            Self::Setpoint([value, ..]) => *value,
            Self::Function(function, inner) => {
                let inner = inner.value(space, motion);
                function.value(&mut space.arena, inner)
            }
            Self::Angle(angle) => angle.value(space, motion),
            Self::Direction(angle) => {
                let (sine, cosine) = angle.parts(space, motion);
                space.arena.atan2(sine, cosine)
            }
            Self::Rate(inner) => inner.rate(space, motion),
            Self::State { value, .. } => *value,
            Self::Side { held, of } => {
                let of = of.value(space, motion);
                space.arena.side(*held, of)
            }
            Self::Select { side, parts } => selected(space, motion, (side, parts), Self::value),
        }
    }

    /// The time derivative; of what holds rates itself, without the terms of `v'` and `w'`.
    pub fn rate(&self, space: &mut Space, motion: &Motion) -> Expr {
        match self {
            Self::Constant(_) => Arena::ZERO,
            Self::Dot(a, b) => {
                let (da, db) = (a.rate(space, motion), b.rate(space, motion));
                let (a, b) = (a.value(space, motion), b.value(space, motion));
                let (first, second) = (space.dot(da, b), space.dot(a, db));
                space.arena.add(first, second)
            }
            Self::Sum(terms) => weighted(space, motion, terms, Self::rate),
            Self::Product(a, b) => {
                let (da, db) = (a.rate(space, motion), b.rate(space, motion));
                let (a, b) = (a.value(space, motion), b.value(space, motion));
                let (first, second) = (space.arena.mul(da, b), space.arena.mul(a, db));
                space.arena.add(first, second)
            }
            Self::Time => Arena::ONE,
            Self::Setpoint([_, rate, _]) => *rate,
            Self::Function(function, inner) => {
                let (x, dx) = (inner.value(space, motion), inner.rate(space, motion));
                let slope = function.slope(&mut space.arena, x);
                space.arena.mul(slope, dx)
            }
            Self::Angle(angle) | Self::Direction(angle) => angle.rate(space, motion),
            Self::Rate(inner) => inner.bias(space, motion),
            Self::State { place, .. } => motion.states[*place].value(space, motion),
            Self::Side { .. } => Arena::ZERO,
            Self::Select { side, parts } => selected(space, motion, (side, parts), Self::rate),
        }
    }

    /// The second time derivative without the terms of `v'` and `w'`.
    pub fn bias(&self, space: &mut Space, motion: &Motion) -> Expr {
        match self {
            Self::Constant(_) => Arena::ZERO,
            Self::Dot(a, b) => {
                let (dda, ddb) = (a.bias(space, motion), b.bias(space, motion));
                let (da, db) = (a.rate(space, motion), b.rate(space, motion));
                let (a, b) = (a.value(space, motion), b.value(space, motion));
                let (first, mixed, last) =
                    (space.dot(dda, b), space.dot(da, db), space.dot(a, ddb));
                let twice = space.arena.add(mixed, mixed);
                space.arena.sum([first, twice, last])
            }
            Self::Sum(terms) => weighted(space, motion, terms, Self::bias),
            Self::Product(a, b) => {
                let (dda, ddb) = (a.bias(space, motion), b.bias(space, motion));
                let (da, db) = (a.rate(space, motion), b.rate(space, motion));
                let (a, b) = (a.value(space, motion), b.value(space, motion));
                let arena = &mut space.arena;
                let (first, mixed, last) =
                    (arena.mul(dda, b), arena.mul(da, db), arena.mul(a, ddb));
                let twice = arena.add(mixed, mixed);
                arena.sum([first, twice, last])
            }
            Self::Time => Arena::ZERO,
            Self::Setpoint([.., acceleration]) => *acceleration,
            Self::Function(function, inner) => {
                let (x, dx) = (inner.value(space, motion), inner.rate(space, motion));
                let ddx = inner.bias(space, motion);
                let arena = &mut space.arena;
                let (slope, curvature) = (function.slope(arena, x), function.curvature(arena, x));
                let square = arena.square(dx);
                let (first, second) = (arena.mul(curvature, square), arena.mul(slope, ddx));
                arena.add(first, second)
            }
            Self::Angle(angle) | Self::Direction(angle) => angle.bias(space, motion),
            Self::Rate(_) => unreachable!("there is no rate of a rate in the language"),
            Self::State { .. } | Self::Side { .. } | Self::Select { .. } => {
                unreachable!("the laws of joints hold no states, and do not switch")
            }
        }
    }

    /// Adds `seed` times the gradient.
    pub fn pull_back(
        &self,
        space: &mut Space,
        motion: &Motion,
        seed: Expr,
        gradient: &mut Gradient,
    ) {
        match self {
            Self::Constant(_) => {}
            Self::Dot(a, b) => {
                let (u, v) = (a.value(space, motion), b.value(space, motion));
                a.pull_back(space, motion, seed, v, gradient);
                b.pull_back(space, motion, seed, u, gradient);
            }
            Self::Sum(terms) => {
                for (factor, term) in terms {
                    let seed = space.arena.mul(seed, *factor);
                    term.pull_back(space, motion, seed, gradient);
                }
            }
            Self::Product(a, b) => {
                let (u, v) = (a.value(space, motion), b.value(space, motion));
                let (on_a, on_b) = (space.arena.mul(seed, v), space.arena.mul(seed, u));
                a.pull_back(space, motion, on_a, gradient);
                b.pull_back(space, motion, on_b, gradient);
            }
            Self::Time | Self::Setpoint(_) | Self::State { .. } => {}
            Self::Function(function, inner) => {
                let x = inner.value(space, motion);
                let slope = function.slope(&mut space.arena, x);
                let seed = space.arena.mul(seed, slope);
                inner.pull_back(space, motion, seed, gradient);
            }
            Self::Angle(angle) | Self::Direction(angle) => {
                angle.pull_back(space, motion, seed, gradient);
            }
            Self::Rate(_) | Self::Side { .. } | Self::Select { .. } => {
                unreachable!("only positions have a gradient by positions in the language")
            }
        }
    }
}

/// The one of two expressions that a side selects.
fn selected(
    space: &mut Space,
    motion: &Motion,
    (side, parts): (&ScalarExpr, &[ScalarExpr; 2]),
    of: impl Fn(&ScalarExpr, &mut Space, &Motion) -> Expr,
) -> Expr {
    let side = side.value(space, motion);
    let [first, second] = parts.each_ref().map(|part| of(part, space, motion));
    space.arena.select(side, first, second)
}

fn weighted(
    space: &mut Space,
    motion: &Motion,
    terms: &[(Expr, ScalarExpr)],
    of: impl Fn(&ScalarExpr, &mut Space, &Motion) -> Expr,
) -> Expr {
    let mut sum = Arena::ZERO;
    for (factor, term) in terms {
        let value = of(term, space, motion);
        let product = space.arena.mul(*factor, value);
        sum = space.arena.add(sum, product);
    }
    sum
}

impl AngleExpr {
    /// `atan2(s, c) + 2 pi round((near - atan2(s, c)) / 2 pi)`.
    pub fn value(&self, space: &mut Space, motion: &Motion) -> Expr {
        let (sine, cosine) = self.parts(space, motion);
        nearest_angle(&mut space.arena, self.near, sine, cosine)
    }

    /// `(c s' - s c') / (c^2 + s^2)`.
    pub fn rate(&self, space: &mut Space, motion: &Motion) -> Expr {
        if let Some(paired) = &self.paired {
            return paired.rate(&mut space.arena);
        }
        let (s, c) = self.parts(space, motion);
        let (ds, dc) = (
            self.sine.rate(space, motion),
            self.cosine.rate(space, motion),
        );
        let forth = space.arena.mul(c, ds);
        let back = space.arena.mul(s, dc);
        let area = space.arena.sub(forth, back);
        let inverse = inverse_square(&mut space.arena, s, c);
        space.arena.mul(area, inverse)
    }

    /// `(c s'' - s c'' - 2 angle' (c c' + s s')) / (c^2 + s^2)` without accelerations.
    pub fn bias(&self, space: &mut Space, motion: &Motion) -> Expr {
        if self.paired.is_some() {
            return Arena::ZERO;
        }
        let (s, c) = self.parts(space, motion);
        let rate = self.rate(space, motion);
        let (ds, dc) = (
            self.sine.rate(space, motion),
            self.cosine.rate(space, motion),
        );
        let (dds, ddc) = (
            self.sine.bias(space, motion),
            self.cosine.bias(space, motion),
        );
        let arena = &mut space.arena;
        let products = [arena.mul(c, dds), -arena.mul(s, ddc)];
        let area = arena.sum(products);
        let growth = [arena.mul(c, dc), arena.mul(s, ds)];
        let growth = arena.sum(growth);
        let twice = arena.add(growth, growth);
        let turning = arena.mul(rate, twice);
        let area = arena.sub(area, turning);
        let inverse = inverse_square(arena, s, c);
        arena.mul(area, inverse)
    }

    /// Adds `seed` times the gradient.
    pub fn pull_back(
        &self,
        space: &mut Space,
        motion: &Motion,
        seed: Expr,
        gradient: &mut Gradient,
    ) {
        if let (Some(paired), false) = (&self.paired, gradient.is_by_bodies) {
            for &(velocity, sign) in &paired.along {
                let factor = space.arena.mul(sign, seed);
                gradient.push_along(velocity, factor);
            }
            return;
        }
        // Not those of pairs, which lack the positive number that both are multiplied with.
        let s = self.sine.value(space, motion);
        let c = self.cosine.value(space, motion);
        let inverse = inverse_square(&mut space.arena, s, c);
        let seed = space.arena.mul(seed, inverse);
        let (on_sine, on_cosine) = (space.arena.mul(seed, c), space.arena.mul(seed, s));
        self.sine.pull_back(space, motion, on_sine, gradient);
        self.cosine.pull_back(space, motion, -on_cosine, gradient);
    }

    fn parts(&self, space: &mut Space, motion: &Motion) -> (Expr, Expr) {
        if let Some(PairedAngle { cosine, sine, .. }) = &self.paired {
            return (*sine, *cosine);
        }
        (
            self.sine.value(space, motion),
            self.cosine.value(space, motion),
        )
    }
}

/// `1 / (c^2 + s^2)`.
fn inverse_square(arena: &mut Arena, s: Expr, c: Expr) -> Expr {
    let (ss, cc) = (arena.square(s), arena.square(c));
    let sum = arena.add(cc, ss);
    arena.reciprocal(sum)
}

//! Axes that turn against each other: a tree of frames, and what it takes to bring components from
//! one to another.

use crate::symbolic::arena::{Arena, Expr};
use crate::symbolic::fixed::transpose;
use crate::symbolic::rotation::normalised_rotation;
use crate::symbolic::vector::{Triple, dot};

/// A reference to a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FrameId(usize);

impl FrameId {
    /// Its place among the frames.
    pub(super) const fn place(self) -> usize {
        self.0
    }
}

/// How a frame lies in the one that it is based on.
#[derive(Clone, Copy, Debug)]
enum Turn {
    /// By a constant rotation: rows take components here to components in the base.
    Fixed([Triple; 3]),
    /// By an angle about a coordinate axis, given by cosine and sine.
    About(usize, Expr, Expr),
    /// By Euler parameters: rows take components here to components in the base.
    Free([Triple; 3]),
}

/// A symmetric tensor.
pub type Tensor = [Triple; 3];

/// All frames of a mechanism.
#[derive(Clone, Debug)]
pub struct Frames {
    frames: Vec<(FrameId, Turn)>,
}

impl Frames {
    /// The axes of the ground.
    pub const GROUND: FrameId = FrameId(0);

    /// The ground alone.
    #[must_use]
    pub fn alone() -> Self {
        // The ground stands for itself; nothing is turned there.
        let ground = (Self::GROUND, Turn::About(0, Arena::ONE, Arena::ZERO));
        Self {
            frames: vec![ground],
        }
    }

    fn add(&mut self, base: FrameId, turn: Turn) -> FrameId {
        self.frames.push((base, turn));
        FrameId(self.frames.len() - 1)
    }

    /// A frame at rest in another; that one itself where nothing is turned.
    pub fn fixed(&mut self, base: FrameId, rows: [Triple; 3]) -> FrameId {
        if rows == identity() {
            return base;
        }
        self.add(base, Turn::Fixed(rows))
    }

    /// A frame that turns about a coordinate axis of another.
    pub fn turned(&mut self, base: FrameId, axis: usize, cosine: Expr, sine: Expr) -> FrameId {
        self.add(base, Turn::About(axis, cosine, sine))
    }

    /// A frame that turns freely against the ground, by Euler parameters of any length.
    pub fn free(&mut self, arena: &mut Arena, p: [Expr; 4]) -> FrameId {
        let rows = normalised_rotation(arena, p);
        self.add(Self::GROUND, Turn::Free(rows))
    }

    /// The frame that a frame is based on.
    #[must_use]
    pub fn base(&self, frame: FrameId) -> FrameId {
        self.frames[frame.0].0
    }

    /// Whether a frame is at rest in the one that it is based on.
    pub(super) fn is_fixed(&self, frame: FrameId) -> bool {
        matches!(self.frames[frame.0].1, Turn::Fixed(_))
    }

    /// Axis, cosine and sine of a frame that turns about a coordinate axis.
    pub(super) fn pair(&self, frame: FrameId) -> Option<(usize, Expr, Expr)> {
        match self.frames[frame.0].1 {
            Turn::About(axis, c, s) => Some((axis, c, s)),
            Turn::Fixed(_) | Turn::Free(_) => None,
        }
    }

    /// Whether a frame is another one or turns with it.
    #[must_use]
    pub fn follows(&self, mut frame: FrameId, other: FrameId) -> bool {
        // A frame stands behind the one that it is based on.
        while frame > other {
            frame = self.base(frame);
        }
        frame == other
    }

    /// Components in another frame.
    pub fn turn(&self, arena: &mut Arena, v: Triple, from: FrameId, to: FrameId) -> Triple {
        let mut v = v;
        let (mut from, mut down, mut to) = (from, Vec::new(), to);
        while from != to {
            if from > to {
                v = self.up(arena, v, from);
                from = self.base(from);
            } else {
                down.push(to);
                to = self.base(to);
            }
        }
        for frame in down.into_iter().rev() {
            v = self.down(arena, v, frame);
        }
        v
    }

    /// The rotations of all frames into global axes, each by that of the frame that it is based on.
    #[must_use]
    pub(super) fn rotations(&self, arena: &mut Arena) -> Vec<[Triple; 3]> {
        let mut rotations = vec![identity()];
        for place in 1..self.frames.len() {
            let frame = FrameId(place);
            let base: [Triple; 3] = rotations[self.base(frame).0];
            rotations.push(base.map(|row| self.down(arena, row, frame)));
        }
        rotations
    }

    /// The steps from a frame to another: up to the base of a frame, or down to the frame.
    fn steps(&self, from: FrameId, to: FrameId) -> Vec<(FrameId, bool)> {
        let (mut from, mut to) = (from, to);
        let (mut steps, mut down) = (Vec::new(), Vec::new());
        while from != to {
            if from > to {
                steps.push((from, true));
                from = self.base(from);
            } else {
                down.push((to, false));
                to = self.base(to);
            }
        }
        steps.extend(down.into_iter().rev());
        steps
    }

    /// The components of a symmetric tensor in another frame.
    pub fn tensor(&self, arena: &mut Arena, t: Tensor, from: FrameId, to: FrameId) -> Tensor {
        let mut t = t;
        for (frame, is_up) in self.steps(from, to) {
            t = match self.frames[frame.0].1 {
                Turn::About(axis, c, s) => {
                    about_tensor(arena, t, axis, c, if is_up { s } else { -s })
                }
                Turn::Fixed(rows) | Turn::Free(rows) => {
                    let rows = if is_up { rows } else { transpose(rows) };
                    // `R t R^T`: first the columns of `t` turned, then the rows of that.
                    let half = t.map(|row| rows.map(|turned| dot(arena, turned, row)));
                    let mut result = t;
                    for k in 0..3 {
                        for l in k..3 {
                            let column = [half[0][l], half[1][l], half[2][l]];
                            result[k][l] = dot(arena, rows[k], column);
                            result[l][k] = result[k][l];
                        }
                    }
                    result
                }
            };
        }
        t
    }

    /// The components of any tensor in another frame.
    pub fn matrix(
        &self,
        arena: &mut Arena,
        t: [Triple; 3],
        from: FrameId,
        to: FrameId,
    ) -> [Triple; 3] {
        let mut t = t;
        for (frame, is_up) in self.steps(from, to) {
            t = match self.frames[frame.0].1 {
                Turn::About(axis, c, s) => {
                    about_matrix(arena, t, axis, c, if is_up { s } else { -s })
                }
                Turn::Fixed(rows) | Turn::Free(rows) => {
                    let rows = if is_up { rows } else { transpose(rows) };
                    let half = t.map(|row| rows.map(|turned| dot(arena, turned, row)));
                    let columns =
                        transpose(half).map(|column| rows.map(|row| dot(arena, row, column)));
                    transpose(columns)
                }
            };
        }
        t
    }

    fn up(&self, arena: &mut Arena, v: Triple, frame: FrameId) -> Triple {
        match self.frames[frame.0].1 {
            Turn::About(axis, c, s) => about(arena, v, axis, c, s),
            Turn::Fixed(rows) | Turn::Free(rows) => rows.map(|row| dot(arena, row, v)),
        }
    }

    fn down(&self, arena: &mut Arena, v: Triple, frame: FrameId) -> Triple {
        match self.frames[frame.0].1 {
            Turn::About(axis, c, s) => about(arena, v, axis, c, -s),
            Turn::Fixed(rows) | Turn::Free(rows) => {
                [0, 1, 2].map(|k| dot(arena, [rows[0][k], rows[1][k], rows[2][k]], v))
            }
        }
    }
}

/// The identity, row by row.
#[must_use]
pub fn identity() -> [Triple; 3] {
    let (o, l) = (Arena::ZERO, Arena::ONE);
    [[l, o, o], [o, l, o], [o, o, l]]
}

/// The two coordinates that a turn about an axis mixes, right-handed.
fn across(axis: usize) -> (usize, usize) {
    ((axis + 1) % 3, (axis + 2) % 3)
}

/// A vector turned about a coordinate axis.
pub fn about(arena: &mut Arena, v: Triple, axis: usize, c: Expr, s: Expr) -> Triple {
    let (i, j) = across(axis);
    let (ci, sj) = (arena.mul(c, v[i]), arena.mul(s, v[j]));
    let (si, cj) = (arena.mul(s, v[i]), arena.mul(c, v[j]));
    let mut turned = v;
    turned[i] = arena.sub(ci, sj);
    turned[j] = arena.add(si, cj);
    turned
}

/// A tensor turned about a coordinate axis; the block across it by the double angle.
fn about_matrix(arena: &mut Arena, t: [Triple; 3], axis: usize, c: Expr, s: Expr) -> [Triple; 3] {
    let (i, j) = across(axis);
    let mut turned = t;
    let (difference, sum) = (arena.sub(t[i][i], t[j][j]), arena.add(t[i][j], t[j][i]));
    let (ss, cs) = (arena.square(s), arena.mul(c, s));
    let (a, b) = (arena.mul(ss, difference), arena.mul(cs, sum));
    let shift = arena.add(a, b);
    turned[i][i] = arena.sub(t[i][i], shift);
    turned[j][j] = arena.add(t[j][j], shift);
    let (a, b) = (arena.mul(cs, difference), arena.mul(ss, sum));
    let shift = arena.sub(a, b);
    turned[i][j] = arena.add(t[i][j], shift);
    turned[j][i] = arena.add(t[j][i], shift);
    let column = about(arena, [t[0][axis], t[1][axis], t[2][axis]], axis, c, s);
    let row = about(arena, t[axis], axis, c, s);
    for k in [i, j] {
        turned[k][axis] = column[k];
        turned[axis][k] = row[k];
    }
    turned
}

/// A symmetric tensor turned about a coordinate axis; the block across it by the double angle.
fn about_tensor(arena: &mut Arena, t: Tensor, axis: usize, c: Expr, s: Expr) -> Tensor {
    let (i, j) = across(axis);
    let mut turned = t;
    let difference = arena.sub(t[i][i], t[j][j]);
    let (ss, cs) = (arena.square(s), arena.mul(c, s));
    let twice = |arena: &mut Arena, x: Expr| arena.add(x, x);
    let (two_cs, two_ss) = (twice(arena, cs), twice(arena, ss));
    // ii: t_ii - s^2 (t_ii - t_jj) - 2 c s t_ij, and ij: t_ij + c s (t_ii - t_jj) - 2 s^2 t_ij.
    let (a, b) = (arena.mul(ss, difference), arena.mul(two_cs, t[i][j]));
    let shift = arena.add(a, b);
    turned[i][i] = arena.sub(t[i][i], shift);
    turned[j][j] = arena.add(t[j][j], shift);
    let (a, b) = (arena.mul(cs, difference), arena.mul(two_ss, t[i][j]));
    let shift = arena.sub(a, b);
    turned[i][j] = arena.add(t[i][j], shift);
    turned[j][i] = turned[i][j];
    let mut column = [Arena::ZERO; 3];
    (column[i], column[j]) = (t[i][axis], t[j][axis]);
    let column = about(arena, column, axis, c, s);
    for k in [i, j] {
        turned[k][axis] = column[k];
        turned[axis][k] = column[k];
    }
    turned
}

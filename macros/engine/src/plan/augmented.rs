//! Masses that joints hand on: augmented bodies (Roberson and Wittenburg 1966).
//!
//! Where a joint's point rows `c (a - G y) = gamma` carry the acceleration `a` of a body's point,
//! with the motion `G y` of a point of another body, the mass `m` of the one body may stand at the
//! point of the other: `-m a.a + m (G y).(G y)` is added to the quadratic form of the masses, which
//! changes nothing where the rows hold. With `L = -m/2 c (a + G y)` that is `D^T L + L^T D`, so
//! that the system for `lambda - L x` with forces `f + L^T gamma` has the same accelerations,
//! whatever the state is. What was the mass of one body at a moving point is a number of the other
//! then, known before the state is, and the block of `a` is zero.
//!
//! Bodies are augmented from the leaves to the ground. The matrix differs from the original one by
//! the same numbers until the rows are eliminated together with `a`, if nothing of the other body
//! is eliminated before, and not at all behind: so every pivot is what it was.

use super::Pivot;
use super::Plan;
use super::symmetric::Symmetric;
use crate::model::BodyKind;
use crate::symbolic::arena::{Arena, Expr};
use crate::symbolic::scene::Scene;
use crate::symbolic::vector::Triple;

/// A body whose mass stands on others.
#[derive(Clone, Debug)]
pub(super) struct HandedOn {
    pub(super) body: usize,
    /// The first of the rows.
    row: usize,
    /// The body that they hold it to, and the point there, from the centre of mass; `None` for the
    /// ground.
    onto: Option<(usize, Triple)>,
}

/// What a row that hands on a mass takes from forces and gives to its multiplier.
#[derive(Clone, Debug)]
pub(super) struct Share {
    pub(super) row: usize,
    acceleration: usize,
    /// `c`.
    sign: Expr,
    mass: Expr,
    /// The other entries of the row.
    others: Vec<(usize, Expr)>,
}

/// The masses of the bodies, with what stands on them.
pub(super) struct Augmented {
    /// Of the translation: zero where it is handed on.
    pub(super) mass: Vec<Expr>,
    /// Masses on the points of each body.
    pub(super) points: Vec<Vec<(Expr, Triple)>>,
}

impl Augmented {
    /// The masses as described.
    pub(super) fn none(scene: &Scene) -> Self {
        Self {
            mass: scene.mass.clone(),
            points: vec![Vec::new(); scene.mass.len()],
        }
    }

    /// The masses where those of some bodies are handed on, which come from the leaves to the
    /// ground; and the masses that were.
    pub(super) fn new(scene: &mut Scene, handed_on: &[HandedOn]) -> (Self, Vec<Expr>) {
        let mut augmented = Self::none(scene);
        let mut masses = Vec::new();
        for HandedOn { body, onto, .. } in handed_on {
            let mass = std::mem::replace(&mut augmented.mass[*body], Arena::ZERO);
            masses.push(mass);
            if let Some((other, point)) = onto {
                let sum = scene.space.arena.add(augmented.mass[*other], mass);
                augmented.mass[*other] = sum;
                augmented.points[*other].push((mass, *point));
            }
        }
        (augmented, masses)
    }
}

/// The bodies whose mass a plan may hand on, in the order in which they are eliminated.
pub(super) fn handed_on(scene: &Scene, kinds: &[BodyKind], plan: &Plan) -> Vec<HandedOn> {
    let layout = &scene.layout;
    let place = |unknown: usize| {
        let eliminates = |pivot: &Pivot| pivot.unknowns().contains(&unknown);
        plan.pivots.iter().position(eliminates)
    };
    let saddle = |body: usize, row: usize, k: usize| {
        let pivot = Pivot::Saddle(layout.velocity[body] + k, layout.velocities + row + k);
        plan.pivots.iter().position(|known| *known == pivot)
    };
    let mut found: Vec<(usize, HandedOn)> = Vec::new();
    for (body, constraint) in plan.points.iter().enumerate() {
        let Some(constraint) = *constraint else {
            continue;
        };
        let (Some(onto), row) = (
            scene.joins(constraint, body),
            scene.constraints[constraint].row,
        ) else {
            continue;
        };
        let places: Option<Vec<usize>> = (0..3).map(|k| saddle(body, row, k)).collect();
        let Some(last) = places.and_then(|places| places.into_iter().max()) else {
            continue;
        };
        // Nothing of the other body is eliminated before.
        let waits = onto.is_none_or(|(other, _)| {
            let first = layout.velocity[other];
            let own = first..first + kinds[other].velocities();
            kinds[other] == BodyKind::Rigid
                && own
                    .into_iter()
                    .all(|k| place(k).is_some_and(|place| place > last))
        });
        if waits {
            found.push((last, HandedOn { body, row, onto }));
        }
    }
    found.sort_by_key(|(last, _)| *last);
    found.into_iter().map(|(_, handed_on)| handed_on).collect()
}

/// What the rows of bodies that hand on their masses take and give.
pub(super) fn shares(
    scene: &Scene,
    matrix: &Symmetric,
    handed_on: &[HandedOn],
    masses: &[Expr],
) -> Vec<Share> {
    let mut shares = Vec::new();
    for (HandedOn { body, row, .. }, &mass) in handed_on.iter().zip(masses) {
        for k in 0..3 {
            let acceleration = scene.layout.velocity[*body] + k;
            let row = scene.layout.velocities + row + k;
            let others = matrix.neighbours(row).filter(|&l| l != acceleration);
            shares.push(Share {
                row,
                acceleration,
                sign: matrix.get(row, acceleration),
                mass,
                others: others.map(|l| (l, matrix.get(row, l))).collect(),
            });
        }
    }
    shares
}

impl Share {
    /// `f + L^T gamma`.
    pub(super) fn add_forces(&self, arena: &mut Arena, right: &mut [Expr]) {
        let gamma = right[self.row];
        if gamma == Arena::ZERO {
            return;
        }
        let half = arena.constant(0.5);
        let mass = arena.mul(half, self.mass);
        let force = arena.mul(mass, gamma);
        let own = arena.mul(self.sign, force);
        right[self.acceleration] = arena.sub(right[self.acceleration], own);
        for &(unknown, entry) in &self.others {
            let force = arena.mul(entry, force);
            right[unknown] = arena.add(right[unknown], force);
        }
    }

    /// `lambda` from `lambda - L x`, with `L x = -m c a + m/2 gamma` where the rows hold.
    pub(super) fn add_reaction(&self, arena: &mut Arena, gamma: Expr, solution: &mut [Expr]) {
        let half = arena.constant(0.5);
        let mass = arena.mul(half, self.mass);
        let known = arena.mul(mass, gamma);
        let inertia = arena.mul(self.mass, solution[self.acceleration]);
        let inertia = arena.mul(self.sign, inertia);
        let sum = arena.add(solution[self.row], known);
        solution[self.row] = arena.sub(sum, inertia);
    }
}

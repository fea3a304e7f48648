//! Along which directions a vector equation is split where it loses a component.
//!
//! Multipliers of dependent rows may hold each other, `Y^T D = 0`; those of a vector equation are
//! vectors. In a planar loop they are along its normal. Where the plane turns in space, the
//! component along a global axis is independent here and dependent there. But the normal is fixed
//! on every body of the loop. So the vectors are followed over the configurations of a walk: where
//! they keep their directions in the ground, components are along global axes, else along
//! directions fixed on a body of the joint in which they keep them.

use super::dense::{dot, norm};
use super::displacement::{apply, cross};
use super::motion::{Configuration, Constraints};
use super::normal::Normal;
use super::span::independent;
use super::sparse::Rows;
use crate::model::inertia::{IDENTITY, principal, rotation, snap};
use crate::model::{BodyKind, Components, Element, Model, ParameterKind, Row};
use crate::symbolic::arena::Arena;
use crate::symbolic::fixed::copies;

/// A share below this is round-off.
const SHARE: f64 = 1e-5;
/// Of the square of a vector, what is across its directions and counts as nothing.
const STILL: f64 = 1e-9;
/// The angle (rad) by which a direction is taken for an axis that is written.
const SAME: f64 = 1e-6;

type Matrix = [[f64; 3]; 3];

const UNITS: Matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// The components of vector equations, by joint, that have to be along directions fixed on a body.
pub(super) type Found = Vec<(usize, (usize, Components))>;

/// A vector equation.
struct Vectorial {
    joint: usize,
    /// The first of its equations in the definition of the joint.
    first: usize,
    /// Its first row.
    row: usize,
}

/// The vector equations of joints that lose no equation.
fn vectorial(model: &Model) -> Vec<Vectorial> {
    let layout = model.layout();
    let mut all = Vec::new();
    for (joint, described) in model.joints.iter().enumerate() {
        let mut first = 0;
        for definition in &model.definition(described).rows {
            if described.dropped.is_empty() && matches!(definition, Row::Vector(_)) {
                let row = layout.row[joint] + first;
                all.push(Vectorial { joint, first, row });
            }
            first += definition.equations();
        }
    }
    all
}

/// The multipliers of all rows that hold each other, combination by combination.
struct Held {
    combinations: Vec<Vec<f64>>,
    at: Configuration,
}

impl Held {
    /// `None` where rows depend on each other that do not elsewhere. Multipliers of rows of unit
    /// length are taken for those of the rows as they are, of one vector equation in proportion.
    fn at(
        constraints: &Constraints,
        (at, rows): (&Configuration, &Rows),
        all: &[Vectorial],
        rank: usize,
    ) -> Option<Self> {
        let kept = independent(std::slice::from_ref(rows), super::limits::TOLERANCE);
        if kept.len() < rank {
            return None;
        }
        let basis: Rows = kept.iter().map(|&row| rows[row].clone()).collect();
        let normal = Normal::new(&basis, 0.0)?;
        let left_out = (0..rows.len()).filter(|row| !kept.contains(row));
        let combinations = left_out.map(|row| {
            let mut combination = vec![0.0; rows.len()];
            combination[row] = 1.0;
            let shares = normal.solve(&normal.products(&rows[row]));
            for (&other, share) in kept.iter().zip(shares) {
                combination[other] = -share;
            }
            combination
        });
        let mut combinations: Vec<Vec<f64>> = combinations.collect();
        let lengths: Vec<f64> = constraints
            .gradients(at)?
            .iter()
            .map(|row| row.norm())
            .collect();
        for vectorial in all {
            let own = &lengths[vectorial.row..][..3];
            let largest = own.iter().fold(0.0_f64, |largest, x| largest.max(*x));
            for (k, &length) in own.iter().enumerate() {
                // A row that vanishes holds nothing, however large its multiplier is.
                let factor = if length > 0.0 { largest / length } else { 1.0 };
                for combination in &mut combinations {
                    combination[vectorial.row + k] *= factor;
                }
            }
        }
        let at = at.clone();
        Some(Self { combinations, at })
    }

    /// The projector on what the multipliers of a vector equation span; `None` where they vanish.
    fn projector(&self, row: usize) -> Option<Matrix> {
        let mut sum = [[0.0; 3]; 3];
        for combination in &self.combinations {
            let own = &combination[row..][..3];
            for k in 0..3 {
                for l in 0..3 {
                    sum[k][l] += own[k] * own[l];
                }
            }
        }
        let (sizes, axes) = principal(sum);
        let axes = rotation(axes);
        let largest = sizes.iter().fold(0.0_f64, |largest, x| largest.max(*x));
        if largest < SHARE * SHARE {
            return None;
        }
        let mut projector = [[0.0; 3]; 3];
        for (size, axis) in sizes.into_iter().zip(axes) {
            if size > SHARE * largest {
                for k in 0..3 {
                    for l in 0..3 {
                        projector[k][l] += axis[k] * axis[l];
                    }
                }
            }
        }
        Some(projector)
    }

    /// Whether multipliers of a vector equation and of a joint of the ground hold each other.
    fn reaches_ground(&self, model: &Model, row: usize) -> bool {
        let layout = model.layout();
        let is_there = |combination: &[f64], row: usize, count: usize| {
            combination[row..][..count]
                .iter()
                .any(|share| share.abs() > SHARE)
        };
        let grounded = || {
            let joints = model.joints.iter().zip(&layout.row);
            joints.filter(|(joint, _)| joint.bodies.contains(&None))
        };
        self.combinations.iter().any(|combination| {
            let mut grounded = grounded();
            is_there(combination, row, 3)
                && grounded
                    .any(|(joint, &first)| is_there(combination, first, model.equations(joint)))
        })
    }
}

/// A matrix by components along axes.
fn along(matrix: &Matrix, axes: &Matrix) -> Matrix {
    axes.map(|a| {
        let image = matrix.map(|row| dot(&row, &a));
        axes.map(|b| dot(&image, &b))
    })
}

/// The components that have to be along directions fixed on a body, found at configurations of
/// which the rows of `D` are given.
pub(super) fn components(
    model: &Model,
    constraints: &Constraints,
    configurations: &[Configuration],
    (directions, rank): (&[Rows], usize),
) -> Found {
    let all = vectorial(model);
    let places = configurations.iter().zip(directions);
    let held: Vec<Held> = places
        .filter_map(|place| Held::at(constraints, place, &all, rank))
        .collect();
    let mut found = Found::new();
    for vectorial in all {
        let projectors: Vec<(Matrix, &Configuration)> = held
            .iter()
            .filter_map(|held| Some((held.projector(vectorial.row)?, &held.at)))
            .collect();
        let joint = &model.joints[vectorial.joint];
        // The constraints may turn what they do not turn here, where numbers are given later.
        let is_still = constraints.values.is_empty()
            || held
                .iter()
                .any(|held| held.reaches_ground(model, vectorial.row));
        let fixed = |body: Option<usize>| common(constraints, &projectors, body);
        let on_ground = fixed(None);
        if projectors.is_empty() || (on_ground.is_some() && is_still) {
            continue;
        }
        let components = places_of(model, joint).into_iter().find_map(|place| {
            let body = joint.bodies[place]?;
            let axes = directions_of(model, body, fixed(Some(body))?)?;
            Some(Components { place, axes })
        });
        found.extend(components.map(|one| (vectorial.joint, (vectorial.first, one))));
    }
    found
}

/// Components along directions fixed on the first or the last body of each joint that turns.
pub(super) fn of_bodies(model: &Model, first: bool) -> Found {
    let all = vectorial(model).into_iter();
    let components = all.filter_map(|vectorial| {
        let places = places_of(model, &model.joints[vectorial.joint]);
        let place = if first { places.first() } else { places.last() };
        let (place, axes) = (*place?, UNITS);
        Some((
            vectorial.joint,
            (vectorial.first, Components { place, axes }),
        ))
    });
    components.collect()
}

/// The places of a joint's bodies that turn, those with the most joints first: what others are
/// carried by.
fn places_of(model: &Model, joint: &Element) -> Vec<usize> {
    let turns = |body: usize| model.bodies[body].kind == BodyKind::Rigid;
    let mut places: Vec<usize> = (0..joint.bodies.len())
        .filter(|&place| joint.bodies[place].is_some_and(turns))
        .collect();
    let joints = |place: &usize| {
        let all = model.joints.iter();
        all.filter(|other| other.bodies.contains(&joint.bodies[*place]))
            .count()
    };
    places.sort_by_key(|place| std::cmp::Reverse(joints(place)));
    places
}

/// The mean of projectors in axes of a body, or the ground, if they are the same everywhere.
fn common(
    constraints: &Constraints,
    projectors: &[(Matrix, &Configuration)],
    body: Option<usize>,
) -> Option<Matrix> {
    let mut mean = [[0.0; 3]; 3];
    for (projector, at) in projectors {
        let orientation = body.map_or(IDENTITY, |body| constraints.pose(at, body).1);
        let own = along(projector, &UNITS.map(|unit| apply(orientation, unit)));
        for k in 0..3 {
            for l in 0..3 {
                mean[k][l] += own[k][l] / projectors.len() as f64;
            }
        }
    }
    let (sizes, _) = principal(mean);
    let is_pure = |size: &f64| size.abs() < STILL || (size - 1.0).abs() < STILL;
    sizes.iter().all(is_pure).then_some(mean)
}

/// Directions that a projector keeps or takes away, in axes of a body; `None` if it keeps all.
fn directions_of(model: &Model, body: usize, projector: Matrix) -> Option<Matrix> {
    let (sizes, axes) = principal(projector);
    let axes = rotation(axes);
    let kept: Vec<usize> = (0..3).filter(|&k| sizes[k] > 0.5).collect();
    let special = match kept[..] {
        [one] => one,
        [a, b] => 3 - a - b,
        _ => return None,
    };
    Some(triad(written(model, body, axes[special])))
}

/// Three directions at right angles, of which one is given: at the place of its largest component,
/// so that a body's own axes stay what they are.
fn triad(given: [f64; 3]) -> Matrix {
    let by_size = |a: &usize, b: &usize| given[*a].abs().total_cmp(&given[*b].abs());
    let largest = (0..3).max_by(by_size).unwrap_or_default();
    let sign = given[largest].signum();
    let own = given.map(|x| snap(sign * x));
    let (next, last) = ((largest + 1) % 3, (largest + 2) % 3);
    let mut axes = UNITS;
    axes[largest] = own;
    if own != UNITS[largest] {
        let across = cross(UNITS[last], own);
        let length = norm(&across);
        axes[next] = across.map(|x| snap(x / length));
        axes[last] = cross(own, axes[next]).map(snap);
    }
    axes
}

/// An axis of the body, or of a joint on it, that a direction is but for round-off; else the
/// direction.
fn written(model: &Model, body: usize, direction: [f64; 3]) -> [f64; 3] {
    let mut candidates = UNITS.to_vec();
    let mut arena = Arena::new();
    for joint in &model.joints {
        let places = joint.bodies.iter().enumerate();
        let places: Vec<usize> = places
            .filter(|(_, other)| **other == Some(body))
            .map(|(place, _)| place)
            .collect();
        let parameters = model.definition(joint).parameters.iter().enumerate();
        for (parameter, _) in parameters.filter(|(_, known)| known.kind == ParameterKind::Axis) {
            if places.is_empty() {
                continue;
            }
            let copies = copies(&mut arena, model, joint, parameter);
            for &place in &places {
                let axis = copies.vector[place].map(|component| arena.literal(component));
                if let [Some(x), Some(y), Some(z)] = axis {
                    candidates.push([x, y, z]);
                }
            }
        }
    }
    let is_it = |axis: &[f64; 3]| norm(&cross(*axis, direction)) < SAME;
    candidates.into_iter().find(is_it).unwrap_or(direction)
}

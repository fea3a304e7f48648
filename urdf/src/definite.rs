//! Whether every joint finds an inertia that resists it.
//!
//! The mass matrix of the tree is factorised from the leaves to the root. The pivot of a joint is
//! then what resists it while all joints behind it are free: its articulated inertia.

use std::collections::BTreeSet;

use nalgebra::{Matrix3, Rotation3, Unit, Vector3};

use crate::document::{Document, JointKind};
use crate::spatial::Frame;
use crate::tree::Tree;

/// Configurations that are looked at, the first with all joints at zero.
const CONFIGURATIONS: usize = 8;

/// The part of what a pivot is made of, sums of sizes, that is round-off.
const ROUND_OFF: f64 = 1e-12;

/// A motion of one coordinate: an angular velocity, and the velocity of the point at the origin.
#[derive(Clone, Copy)]
struct Twist {
    /// The place of the group that is moved, with all that it carries.
    group: usize,
    turning: Vector3<f64>,
    going: Vector3<f64>,
}

/// The places of the groups whose joints meet no inertia in some configuration.
pub(crate) fn without_inertia(document: &Document, tree: &Tree, floating: bool) -> BTreeSet<usize> {
    let mut found = BTreeSet::new();
    let mut random = 0.5;
    for configuration in 0..CONFIGURATIONS {
        // Weyl's sequence of the golden ratio: numbers without a pattern.
        let position = |joint: usize| {
            random = (random + 0.618_033_988_749_894_9_f64).fract();
            let size = match document.joints[joint].kind {
                Some(JointKind::Prismatic) => 0.2,
                _ => 3.0,
            };
            if configuration == 0 {
                0.0
            } else {
                size * (random - 0.5)
            }
        };
        let frames = frames(document, tree, position);
        found.extend(small_pivots(document, tree, &frames, floating));
    }
    found
}

/// The frames of all links.
fn frames(document: &Document, tree: &Tree, mut position: impl FnMut(usize) -> f64) -> Vec<Frame> {
    let mut frames = vec![Frame::IDENTITY; document.links.len()];
    for branch in &tree.joints {
        let joint = &document.joints[branch.joint];
        let moved = match joint.kind {
            Some(kind) if kind.is_turn() => Frame {
                rotation: turned(joint.axis, position(branch.joint)),
                origin: Vector3::zeros(),
            },
            Some(JointKind::Prismatic) => Frame {
                rotation: Matrix3::identity(),
                origin: joint.axis.normalize() * position(branch.joint),
            },
            _ => Frame::IDENTITY,
        };
        let at = frames[branch.parent].compose(&joint.origin);
        frames[branch.child] = at.compose(&moved);
    }
    frames
}

fn turned(axis: Vector3<f64>, angle: f64) -> Matrix3<f64> {
    Rotation3::from_axis_angle(&Unit::new_normalize(axis), angle).into_inner()
}

/// The motions of all joints, from the root outwards.
fn twists(document: &Document, tree: &Tree, frames: &[Frame], floating: bool) -> Vec<Twist> {
    let mut twists = Vec::new();
    for (group, moved) in tree.groups.iter().enumerate() {
        let frame = &frames[moved.links[0]];
        let zero = Vector3::zeros();
        let (kind, axis) = match moved.joint.map(|joint| &document.joints[joint]) {
            Some(joint) => (joint.kind, joint.axis),
            None if floating => (Some(JointKind::Floating), Vector3::x()),
            None => continue,
        };
        let mut turn = |axis: Vector3<f64>| {
            twists.push(Twist {
                group,
                turning: axis,
                going: frame.origin.cross(&axis),
            });
        };
        let axis = frame.rotation * axis.normalize();
        let units = [Vector3::x(), Vector3::y(), Vector3::z()];
        let slides: Vec<Vector3<f64>> = match kind {
            Some(JointKind::Revolute | JointKind::Continuous) => {
                turn(axis);
                Vec::new()
            }
            Some(JointKind::Prismatic) => vec![axis],
            Some(JointKind::Planar) => {
                turn(axis);
                let across = units[axis.iamin()].cross(&axis).normalize();
                vec![across, axis.cross(&across)]
            }
            Some(JointKind::Floating) => {
                units.into_iter().for_each(&mut turn);
                units.to_vec()
            }
            Some(JointKind::Fixed) | None => Vec::new(),
        };
        twists.extend(slides.into_iter().map(|going| Twist {
            group,
            turning: zero,
            going,
        }));
    }
    twists
}

/// The groups on the way from a group to the root.
fn carriers(document: &Document, tree: &Tree) -> Vec<Vec<usize>> {
    let mut carriers: Vec<Vec<usize>> = vec![Vec::new(); tree.groups.len()];
    carriers[0] = vec![0];
    for branch in &tree.joints {
        let [parent, child] = [branch.parent, branch.child].map(|link| tree.places[link].group);
        if parent != child && document.joints[branch.joint].kind.is_some() {
            carriers[child] = carriers[parent].clone();
            carriers[child].push(child);
        }
    }
    carriers
}

fn small_pivots(
    document: &Document,
    tree: &Tree,
    frames: &[Frame],
    floating: bool,
) -> BTreeSet<usize> {
    let twists = twists(document, tree, frames, floating);
    let carriers = carriers(document, tree);
    let count = twists.len();
    let (mut matrix, mut sizes) = (vec![vec![0.0; count]; count], vec![0.0; count]);
    for (place, group) in tree.groups.iter().enumerate() {
        let Some(inertia) = &group.inertia else {
            continue;
        };
        let own = inertia.carried(&frames[group.links[0]]);
        let moving = twists.iter().enumerate();
        let moving = moving.filter(|(_, twist)| carriers[place].contains(&twist.group));
        let moving: Vec<(usize, &Twist)> = moving.collect();
        let speed = |twist: &Twist| twist.going + twist.turning.cross(&own.centre);
        for &(i, one) in &moving {
            let (momentum, spin) = (own.mass * speed(one), own.tensor * one.turning);
            for &(j, other) in &moving {
                matrix[i][j] += momentum.dot(&speed(other)) + spin.dot(&other.turning);
            }
            sizes[i] += momentum.dot(&speed(one)).abs();
            sizes[i] += one
                .turning
                .abs()
                .dot(&(own.tensor.abs() * one.turning.abs()));
        }
    }
    let mut small = BTreeSet::new();
    for k in (0..count).rev() {
        let pivot = matrix[k][k];
        if pivot.is_nan() || pivot <= ROUND_OFF * sizes[k] {
            small.insert(twists[k].group);
            continue;
        }
        let row = matrix[k].clone();
        for above in matrix.iter_mut().take(k) {
            let share = above[k] / pivot;
            for (entry, x) in above.iter_mut().zip(&row).take(k) {
                *entry -= share * x;
            }
        }
    }
    small
}

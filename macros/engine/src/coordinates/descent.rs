//! Where a share of closing rows vanishes, if motion can lead there, or on another branch.
//!
//! A sweep is one way through configurations of as many dimensions as motion is free. What vanishes
//! somewhere need not vanish on it. So a mechanism is moved as the share changes most, downhill and
//! uphill, and on over valleys and hills. If the share depends on one loop alone, this turns that
//! loop all round, whatever else could move. A state may be set on another branch, where no motion
//! leads: there, ways begin where random configurations come to lie.

use std::cell::Cell;

use super::beginning::Beginning;
use super::from_bodies::from_bodies;
use super::links::Links;
use super::stops::{STEADY, passes_zero};
use crate::rank::closing::{Free, Place};
use crate::symbolic::arena::{Arena, Expr, Input};
use crate::symbolic::tape::Tape;

/// The largest motion of a body in a step: in radians, and in fractions of the size of the
/// mechanism.
const STEP: f64 = 0.3;
/// Steps of a way.
const STEPS: usize = 40;
/// Steps of all ways times the velocities of the bodies: so that an expansion ends. Of a mechanism
/// of dozens of bodies some choices are looked at along the sweep only.
const WORK: usize = 18_000;
/// How often a step that leads nowhere is halved.
const HALVINGS: usize = 4;
/// A change per radian that is nothing.
const FLAT: f64 = 1e-3;
/// The motion of a difference quotient.
const SMALL: f64 = 1e-6;

/// The closing rows as numbers, wherever the bodies are.
pub(super) struct Descent<'a> {
    beginning: &'a Beginning<'a>,
    free: &'a Free,
    /// Joint coordinates as functions of those of the bodies.
    joints: Tape,
    rows: Tape,
    width: usize,
    /// How much [`WORK`] is left.
    work: Cell<usize>,
}

impl<'a> Descent<'a> {
    /// The same of rows; none where nothing can be told.
    pub(super) fn new(
        arena: &Arena,
        beginning: &'a Beginning<'_>,
        links: &Links,
        rows: &[Vec<Expr>],
    ) -> Option<Self> {
        let mut arena = arena.clone();
        let outputs = from_bodies(&mut arena, beginning.model, links);
        let count = outputs.len() - links.velocities;
        let flat: Vec<Expr> = rows.iter().flatten().copied().collect();
        Some(Self {
            beginning,
            free: beginning.free()?,
            joints: Tape::new(&arena, &outputs[..count]),
            rows: Tape::new(&arena, &flat),
            width: links.velocities.max(1),
            work: Cell::new(WORK),
        })
    }

    /// Joint coordinates.
    pub(super) fn joints(&self, (time, bodies): &Place) -> Option<Place> {
        let joints = self.joints.evaluate(|input| match input {
            Input::Coordinate(place) => bodies.get(place as usize).copied(),
            Input::Velocity(_) => Some(0.0),
            Input::Time => Some(*time),
            _ => None,
        });
        joints.map(|joints| (*time, joints))
    }

    fn rows(&self, at: &Place) -> Option<Vec<Vec<f64>>> {
        let (time, joints) = self.joints(at)?;
        let rows = self.rows.evaluate(|input| match input {
            Input::Coordinate(place) => joints.get(place as usize).copied(),
            Input::Time => Some(time),
            _ => None,
        });
        rows.map(|rows| rows.chunks(self.width).map(<[f64]>::to_vec).collect())
    }

    /// Two places between which a share vanishes, or the second of which it hardly reaches, on ways
    /// that begin at a place of the sweep. A share of `None` is that of a singular position. Where
    /// motion has one way only, the sweep has been there.
    pub(super) fn vanishing(
        &self,
        from: &Place,
        share: impl Fn(Vec<Vec<f64>>) -> Option<f64>,
    ) -> Option<[Place; 2]> {
        self.on_ways(from, 2, &|place: &Place| share(self.rows(place)?))
    }

    /// The same on other branches, where no sweep has been: from where the share is least.
    pub(super) fn vanishing_elsewhere(
        &self,
        share: impl Fn(Vec<Vec<f64>>) -> Option<f64>,
    ) -> Option<[Place; 2]> {
        let share = &|place: &Place| share(self.rows(place)?);
        let places = self.beginning.elsewhere().iter();
        let shares = places.filter_map(|place| Some((place, share(place)?.abs())));
        let (from, least) = shares.min_by(|(_, a), (_, b)| a.total_cmp(b))?;
        if least <= STEADY {
            return Some([from.clone(), from.clone()]);
        }
        self.on_ways(from, 1, share)
    }

    /// The same on ways from a place, where motion has so many at least.
    fn on_ways(
        &self,
        from: &Place,
        fewest: usize,
        share: &impl Fn(&Place) -> Option<f64>,
    ) -> Option<[Place; 2]> {
        [-1.0, 1.0].into_iter().find_map(|side| {
            let mut at = from.clone();
            let mut value = share(&at)?;
            let mut heading: Option<Vec<f64>> = None;
            for _ in 0..STEPS {
                let motions = self.free.motions(&at);
                if motions.len() < fewest {
                    return None;
                }
                self.work
                    .set(self.work.get().checked_sub(motions[0].len())?);
                let slopes = self.slopes(&at, (value, &motions), share)?;
                let mut slope = norm(&slopes);
                let next = match &heading {
                    Some(before) if slope < FLAT => along(&motions, &products(&motions, before)),
                    None if slope < FLAT => return None,
                    before => {
                        let mut next = along(&motions, &slopes);
                        let sense = before.as_ref().map_or(side * value, |way| dot(way, &next));
                        let sense = sense.signum();
                        next.iter_mut().for_each(|x| *x *= sense);
                        slope *= sense;
                        next
                    }
                };
                // Towards zero no farther than a straight line tells.
                let most = next.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
                let mut length = STEP / most;
                if slope * value < 0.0 {
                    length = length.min((value / slope).abs());
                }
                let (reached, place) = self.step(&at, (value, &next, length), share)?;
                if reached * value < 0.0 || reached.abs() <= STEADY {
                    return Some([at, place]);
                }
                (value, at, heading) = (reached, place, Some(next));
            }
            None
        })
    }

    /// How a share changes along motions.
    fn slopes(
        &self,
        at: &Place,
        (value, motions): (f64, &[Vec<f64>]),
        share: impl Fn(&Place) -> Option<f64>,
    ) -> Option<Vec<f64>> {
        let slopes = motions.iter().map(|motion| {
            let small: Vec<f64> = motion.iter().map(|x| SMALL * x).collect();
            Some((share(&self.free.moved(at, &small))? - value) / SMALL)
        });
        slopes.collect()
    }

    /// The share and the place that a step leads to, a shorter one if need be.
    fn step(
        &self,
        at: &Place,
        (value, heading, mut length): (f64, &[f64], f64),
        share: impl Fn(&Place) -> Option<f64>,
    ) -> Option<(f64, Place)> {
        for _ in 0..=HALVINGS {
            let motion: Vec<f64> = heading.iter().map(|x| length * x).collect();
            if let Some(place) = self.free.reached(at, &motion)
                && let Some(reached) = share(&place)
                && (reached * value > 0.0 || passes_zero(value, reached))
            {
                return Some((reached, place));
            }
            length *= 0.5;
        }
        None
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

fn products(motions: &[Vec<f64>], motion: &[f64]) -> Vec<f64> {
    motions.iter().map(|own| dot(own, motion)).collect()
}

/// The motion of unit length of which the parts along others have given ratios.
fn along(motions: &[Vec<f64>], parts: &[f64]) -> Vec<f64> {
    let mut sum = vec![0.0; motions.first().map_or(0, Vec::len)];
    for (motion, part) in motions.iter().zip(parts) {
        for (sum, x) in sum.iter_mut().zip(motion) {
            *sum += part * x / norm(parts);
        }
    }
    sum
}

//! Kernels in the rates of the joints themselves: mass matrix, efforts, axes, and the rows of what
//! closes loops.
//!
//! Velocities of joint coordinates may be sums along a run of parallel axes, and count the other
//! way round than a joint does. What is generated here has one rate for every motion of a joint, as
//! handles read it, so that nobody counts places.
//!
//! The efforts of given accelerations are found as Newton and Euler have them (Luh, Walker, Paul
//! 1980; Featherstone, *Rigid Body Dynamics Algorithms*, section 5.3): motion from the ground to
//! the leaves, forces back. The ground accelerates against gravity, so that weights need no terms.
//! Described forces act meanwhile: an effort is what has to be added to them.

use super::algebra::scale;
use super::frames::Frames;
use super::freedom::Freedom;
use super::kinematics::{Kinematics, Moving};
use super::links::Links;
use super::origins::ToGround;
use super::system::Reduced;
use super::wrenches::{Wrench, inertial};
use crate::model::{Asked, Model};
use crate::plan::system::Terms;
use crate::symbolic::arena::{Arena, Expr, Input};
use crate::symbolic::equations::{Kernel, combinations};
use crate::symbolic::vector::{Triple, ZERO};

/// The kernels that are asked for, and the rows.
#[derive(Clone, Debug)]
pub struct JointRates {
    /// What is asked for. Of the mass matrix it is every entry row by row, of efforts one
    /// for each rate, of Jacobians axis, a point on it and direction of translation for each rate.
    pub asked: Vec<(Asked, Kernel)>,
    /// The accelerations of given efforts, where they are asked for, and no row closes a loop.
    pub forward: Option<Kernel>,
    /// The rows that remain: `D`, row by row; `gamma`; `Phi'`; `Phi`.
    pub rows: Kernel,
    /// Body by body the rates that move it. Beside one that only carries a ball along, whose
    /// rotation it leaves alone, the place of that ball's first rate.
    pub moved_by: Vec<Vec<(usize, Option<usize>)>>,
}

/// How velocities are made of the rates of joints: each of its own, and of another velocity.
pub(super) struct Sums {
    against: Vec<Option<usize>>,
    is_reversed: Vec<bool>,
}

impl Sums {
    pub(super) fn of(links: &Links) -> Self {
        let mut sums = Self {
            against: vec![None; links.velocities],
            is_reversed: vec![false; links.velocities],
        };
        for link in &links.links {
            let against = links.measured_with(link);
            sums.against[link.velocity] = against.map(|link| links.links[link].velocity);
            sums.is_reversed[link.velocity] = matches!(
                link.freedom,
                Freedom::Turn {
                    is_reversed: true,
                    ..
                } | Freedom::Screw {
                    is_reversed: true,
                    ..
                }
            );
        }
        sums
    }

    fn signed(&self, place: usize, value: Expr) -> Expr {
        if self.is_reversed[place] {
            -value
        } else {
            value
        }
    }

    /// Velocities, or their rates, of those of the joints.
    pub(super) fn velocities(&self, arena: &mut Arena, rates: &[Expr]) -> Vec<Expr> {
        let mut velocities: Vec<Expr> = Vec::new();
        for (place, &rate) in rates.iter().enumerate() {
            let own = self.signed(place, rate);
            // What carries a link stands before it.
            let velocity = match self.against[place] {
                Some(against) => arena.add(own, velocities[against]),
                None => own,
            };
            velocities.push(velocity);
        }
        velocities
    }

    /// The rates of the joints, or theirs, of velocities.
    pub(super) fn rates(&self, arena: &mut Arena, velocities: &[Expr]) -> Vec<Expr> {
        let places = velocities.iter().enumerate();
        let rates = places.map(|(place, &velocity)| {
            let own = match self.against[place] {
                Some(against) => arena.sub(velocity, velocities[against]),
                None => velocity,
            };
            self.signed(place, own)
        });
        rates.collect()
    }

    /// What does work on the velocities, of what does on the rates of the joints.
    pub(super) fn forces(&self, arena: &mut Arena, efforts: Vec<Expr>) -> Vec<Expr> {
        let places = efforts.into_iter().enumerate();
        let along: Vec<Expr> = places
            .map(|(place, effort)| self.signed(place, effort))
            .collect();
        let mut forces = along.clone();
        for (place, against) in self.against.iter().enumerate() {
            if let Some(against) = *against {
                forces[against] = arena.sub(forces[against], along[place]);
            }
        }
        forces
    }

    /// What does work on the rates of the joints, of what does on the velocities.
    pub(super) fn efforts(&self, arena: &mut Arena, mut along: Vec<Expr>) -> Vec<Expr> {
        for place in (0..along.len()).rev() {
            if let Some(against) = self.against[place] {
                along[against] = arena.add(along[against], along[place]);
            }
        }
        let places = along.into_iter().enumerate();
        places
            .map(|(place, effort)| self.signed(place, effort))
            .collect()
    }
}

impl JointRates {
    /// The kernels that a model asks for.
    pub(super) fn new(model: &Model, reduced: &Reduced) -> Option<Self> {
        if model.asked.is_empty() {
            return None;
        }
        let kernel = |outputs: &dyn Fn(&mut Reduced, &Sums) -> Vec<Expr>| {
            let mut reduced = reduced.clone();
            let sums = Sums::of(&reduced.links);
            let outputs = outputs(&mut reduced, &sums);
            let mut kernel = Kernel {
                arena: reduced.scene.space.arena,
                outputs,
            };
            kernel.gather(&[]);
            kernel
        };
        let asked = model.asked.iter().filter_map(|&asked| {
            let outputs: &dyn Fn(&mut Reduced, &Sums) -> Vec<Expr> = match asked {
                Asked::Forward | Asked::Derivatives | Asked::Adjoint => return None,
                Asked::Mass => &Reduced::mass_of_joints,
                Asked::Gravity => &|reduced, sums| reduced.efforts(sums, Wanted::Gravity),
                Asked::Coriolis => &|reduced, sums| reduced.efforts(sums, Wanted::Coriolis),
                Asked::Inverse => &|reduced, sums| reduced.efforts(sums, Wanted::All),
                Asked::Jacobian => &|reduced, sums| reduced.axes_of_joints(sums),
            };
            Some((asked, kernel(outputs)))
        });
        let is_tree = reduced.scene.layout.rows == 0;
        let forward = is_tree && model.asked.contains(&Asked::Forward);
        Some(Self {
            forward: forward.then(|| kernel(&Reduced::accelerations_of_efforts)),
            asked: asked.collect(),
            rows: kernel(&Reduced::rows_of_joints),
            moved_by: moved_by(&reduced.links),
        })
    }
}

/// Which part of the efforts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wanted {
    /// What holds the weights.
    Gravity,
    /// What the motion takes: momenta, Coriolis and gyroscopic terms.
    Coriolis,
    /// All.
    All,
}

impl Reduced {
    /// The accelerations of the joints' rates under efforts along these, which are
    /// [`Input::Acceleration`], and the described forces.
    fn accelerations_of_efforts(&mut self, sums: &Sums) -> Vec<Expr> {
        let arena = &mut self.scene.space.arena;
        let efforts = (0..self.links.velocities as u32).map(Input::Acceleration);
        let efforts = efforts.map(|effort| arena.input(effort)).collect();
        let along = sums.forces(arena, efforts);
        let solution = self.solve_with(Terms::Plain, &along);
        sums.rates(&mut self.scene.space.arena, &solution.accelerations)
    }

    /// Efforts along the rates of the joints.
    pub(super) fn efforts(&mut self, sums: &Sums, wanted: Wanted) -> Vec<Expr> {
        let ground = match wanted {
            Wanted::Coriolis => ZERO,
            _ => self.scene.gravity.map(|component| -component),
        };
        let given = match wanted {
            Wanted::Gravity => None,
            Wanted::Coriolis | Wanted::All => {
                let arena = &mut self.scene.space.arena;
                let rates = 0..self.links.velocities as u32;
                let rates = rates.map(|place| arena.input(Input::Acceleration(place)));
                let rates: Vec<Expr> = rates.collect();
                Some(sums.velocities(arena, &rates))
            }
        };
        let moving = given.as_deref().map_or(Moving::Not, Moving::Accelerated);
        let applied = (wanted == Wanted::All).then(|| self.scene.applied());
        let applied_wrenches = applied.as_ref().map(|applied| self.wrenches(applied));
        let Self { links, scene, .. } = self;
        let arena = &mut scene.space.arena;
        let motion = Kinematics::of(arena, links, ground, moving);
        let wrenches: Vec<Wrench> = (0..links.links.len())
            .map(|link| {
                let taken = inertial(arena, links, &motion, link);
                match &applied_wrenches {
                    Some(applied) => taken.plus(arena, applied[link].opposite()),
                    None => taken,
                }
            })
            .collect();
        let mut efforts = links.project(arena, wrenches);
        if let Some(applied) = applied {
            let mut along = vec![Arena::ZERO; links.velocities];
            applied.add_along(arena, &mut along);
            for (effort, along) in efforts.iter_mut().zip(along) {
                *effort = arena.sub(*effort, along);
            }
        }
        sums.efforts(arena, efforts)
    }

    /// The mass matrix, row by row.
    fn mass_of_joints(&mut self, sums: &Sums) -> Vec<Expr> {
        let Self { links, scene, .. } = self;
        let arena = &mut scene.space.arena;
        let mass = links.mass_matrix(arena);
        let places = 0..links.velocities;
        let rows = places.clone().map(|row| {
            let entries = places.clone().map(|column| mass.get(row, column));
            sums.efforts(arena, entries.collect())
        });
        let rows: Vec<Vec<Expr>> = rows.collect();
        let columns = places.clone().map(|column| {
            let entries = rows.iter().map(|row| row[column]);
            sums.efforts(arena, entries.collect())
        });
        let columns: Vec<Vec<Expr>> = columns.collect();
        // Both places of an entry have the same expression.
        let entries = places.clone().flat_map(|row| {
            let pairs = places.clone().map(move |column| (row, column));
            pairs.map(|(row, column)| columns[row.min(column)][row.max(column)])
        });
        entries.collect()
    }

    /// `D` of the rows that remain, row by row, `gamma`, `Phi'` and `Phi`.
    pub(super) fn rows_of_joints(&mut self, sums: &Sums) -> Vec<Expr> {
        let (rows, gamma) = self.rows(Terms::Plain);
        let arena = &mut self.scene.space.arena;
        let mut outputs: Vec<Expr> = Vec::new();
        for row in rows {
            outputs.extend(sums.efforts(arena, row));
        }
        outputs.extend(gamma);
        for place in [1, 0] {
            let mut factors = [Arena::ZERO; 3];
            factors[place] = Arena::ONE;
            outputs.extend(combinations(&mut self.scene, factors));
        }
        outputs
    }

    /// Of each rate the axis of the turn, a point on it, and the velocity of the translation along
    /// it, all in global axes; zeros where there is none.
    fn axes_of_joints(&mut self, sums: &Sums) -> Vec<Expr> {
        let Self { links, scene, .. } = self;
        let arena = &mut scene.space.arena;
        let mut axes = vec![[ZERO; 3]; links.velocities];
        let origins = links.origins_in_global_axes(arena, &ToGround::Stepwise);
        for (link, &origin) in links.links.iter().zip(&origins) {
            let global = |arena: &mut Arena, v: Triple| {
                links.frames.turn(arena, v, link.frame, Frames::GROUND)
            };
            let signed = |v: Triple| v.map(|component| sums.signed(link.velocity, component));
            match link.freedom {
                Freedom::Turn { axis, .. } => {
                    let axis = global(arena, Links::unit(axis));
                    axes[link.velocity] = [signed(axis), origin, ZERO];
                }
                Freedom::Screw { axis, advance, .. } => {
                    let axis = global(arena, Links::unit(axis));
                    let along = scale(arena, advance, axis);
                    axes[link.velocity] = [signed(axis), origin, signed(along)];
                }
                Freedom::Slide { along, .. } => {
                    axes[link.velocity] = [ZERO, ZERO, global(arena, along)];
                }
                Freedom::Ball { .. } => {
                    for k in 0..3 {
                        let axis = global(arena, Links::unit(k));
                        axes[link.velocity + k] = [axis, origin, ZERO];
                    }
                }
            }
        }
        axes.into_iter().flatten().flatten().collect()
    }
}

/// Body by body the rates that move it. The rates of a ball are those of its body against the
/// ground: what carries it moves its centre and does not turn it.
fn moved_by(links: &Links) -> Vec<Vec<(usize, Option<usize>)>> {
    let bodies = links.bodies.iter().map(|standing| {
        let mut rates = Vec::new();
        let mut link = standing.link;
        let mut ball = None;
        while let Some(place) = link {
            let own = &links.links[place];
            let places = own.velocity..own.velocity + own.freedom.velocities();
            rates.extend(places.map(|place| (place, ball)));
            if let Freedom::Ball { .. } = own.freedom {
                ball = Some(own.velocity);
            }
            link = own.carrier;
        }
        rates.sort_unstable();
        rates
    });
    bodies.collect()
}

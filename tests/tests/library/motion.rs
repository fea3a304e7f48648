//! Motions of two bodies with a joint between them: the violation stays bounded, and what the joint
//! leaves free moves by mechanics alone. Nothing of this knows an equation of a joint:
//! [`freedom`](crate::freedom) says what is free.

use core::ops::ControlFlow;

use holonom_assembler::assembler::Assembler;
use holonom_assembler::bodies::{BodyId, GROUND, Kind};
use holonom_assembler::states::{generator, make_consistent_at};
use nalgebra::Vector6;

use crate::comparison::Worst;
use crate::course::run;
use crate::data::Data;
use crate::freedom::{Freedom, Pair, beside, coordinates};
use crate::kernels::{Evaluated, Kernels};
use crate::library::{Entry, Placement, library};
use crate::mechanics::{Screw, momentum, screw, standing};
use crate::states::consistent;

/// Less sharp than this, a motion is not looked at further: the joint is near a singular position
/// (shafts folded back).
const SHARP: f64 = 0.2;

/// How long a motion goes on (s).
const DURATION: f64 = 1.0;

/// What is left of a violation after a motion at this tolerance.
const DRIFT: f64 = 1e-8;

/// The scene of one joint between two bodies in a test motion.
struct Trial<'a> {
    what: String,
    entry: &'a Entry,
    data: Data,
    kernels: Box<dyn Kernels>,
    scene: Assembler,
    ends: [BodyId; 2],
}

impl<'a> Trial<'a> {
    fn new(entry: &'a Entry, placement: &Placement, data: Data) -> Self {
        let (scene, bodies) = entry.assembler(placement, &data);
        let &[i, j] = bodies.as_slice() else {
            unreachable!("two bodies")
        };
        Self {
            what: format!("{} among {:?}", entry.name, placement.members),
            entry,
            kernels: (placement.describe)(&data),
            data,
            scene,
            ends: [i, j],
        }
    }

    /// Where and how the joint is free.
    fn freedom(&self, time: f64, x: &[f64]) -> (Pair<'_>, Freedom) {
        let pair = Pair::new(&self.scene, self.ends, time, x);
        let free = self.entry.free.expect("a joint of two bodies");
        let freedom = free(&pair, &self.data);
        (pair, freedom)
    }

    /// `M u' - g` body by body: what the joint does, by the laws of Newton and Euler alone. Nothing
    /// for the ground.
    fn efforts(&self, time: f64, x: &[f64], found: &Evaluated) -> [Option<Screw>; 2] {
        let accelerations = &found.rates[self.scene.coordinates()..];
        let mass = self.scene.mass();
        let forces = self.scene.forces_at(time, x);
        let at = self.scene.kinematics_at(time, x);
        self.ends.map(|end| {
            if end == GROUND {
                return None;
            }
            let body = self.scene.body(end);
            let (_, _, n) = self
                .scene
                .bodies()
                .find(|(other, ..)| *other == body)
                .expect("a body of the scene");
            let effort: Vec<f64> = (n..n + body.kind.velocities())
                .map(|k| mass[k] * accelerations[k] - forces[k])
                .collect();
            Some(screw(&at, end, body.kind, &effort))
        })
    }

    fn any_particle(&self) -> bool {
        self.ends
            .iter()
            .any(|end| self.scene.body(*end).kind == Kind::Particle)
    }
}

/// The largest deviations.
#[derive(Debug, Default)]
struct Deviations {
    violation: Worst,
    rate: Worst,
    newton: Worst,
    balance: Worst,
    reaction: Worst,
    freedom: Worst,
    momentum: Worst,
    energy: Worst,
    /// The largest effort of the joint (N, N m).
    largest: f64,
    /// The largest speed along each free direction (m/s, rad/s).
    speeds: Vec<f64>,
}

impl Deviations {
    /// What holds at an instant: free directions feel nothing of the joint, and its reactions are
    /// what moves the bodies.
    fn instant(&mut self, trial: &Trial<'_>, time: f64, x: &[f64]) {
        /// A solution of some twenty equations, relative to the largest force or moment.
        const SOLVED: f64 = 1e-12;
        let (kernels, what) = (&trial.kernels, &trial.what);
        let found = kernels.evaluate(time, x);
        let [on_i, on_j] = trial.efforts(time, x, &found);
        let (_, freedom) = trial.freedom(time, x);
        if freedom.sharpness < SHARP {
            return;
        }
        let point = freedom.point;
        let opposite = |screw: Screw| -screw.about(&point);
        let effort = match (on_i, on_j) {
            (_, Some(on_j)) => on_j.about(&point),
            (Some(on_i), None) => opposite(on_i),
            (None, None) => unreachable!("a body moves"),
        };
        // What is left of `M u' - g` is known to the round-off of its parts, a reaction to its own.
        let size = effort.norm();
        let scale = trial.scene.forces_at(time, x).norm().max(size).max(1e-6);
        self.largest = self.largest.max(size);
        for twist in &freedom.twists {
            let power = effort.dot(&(twist / twist.norm())).abs() / scale;
            self.newton
                .take(&format!("free direction of {what}"), power, SOLVED);
        }
        if let ([Some(on_i), Some(on_j)], false) = ([on_i, on_j], trial.any_particle()) {
            let sum = on_i.about(&point) + on_j.about(&point);
            self.balance.take(
                &format!("action and reaction of {what}"),
                sum.norm() / scale,
                SOLVED,
            );
        }
        for (place, expected) in [
            (0, on_i.map(|screw| -screw.about(&point))),
            (1, Some(effort)),
        ] {
            let wrench = kernels.reaction(time, x, &found.multipliers, place);
            let moment = wrench.moment + wrench.point.cross(&wrench.force);
            let screw = Screw {
                force: wrench.force,
                moment,
            };
            let found = match place {
                0 => opposite(screw),
                _ => screw.about(&point),
            };
            for twist in &freedom.twists {
                let size = found.norm().max(1e-6);
                let power = found.dot(&(twist / twist.norm())).abs() / size;
                self.reaction.take(
                    &format!("reaction {place} of {what} in a free direction"),
                    power,
                    SOLVED,
                );
            }
            if let Some(expected) = expected {
                let error = (found - expected).norm() / scale;
                self.reaction
                    .take(&format!("reaction {place} of {what}"), error, SOLVED);
            }
        }
    }
}

/// How many components of momentum a body keeps without gravity that is joined to the ground, the
/// first body of the joint: the free motions about and along lines that stand still in space.
fn kept(name: &str) -> usize {
    if ["Distance of a particle", "PointOnPlane of a particle"].contains(&name) {
        // It moves on a great circle or a straight line, which stand still as well.
        return 4;
    }
    match name.split(' ').next().unwrap_or_default() {
        "Fixed" | "ConstantVelocity" => 0,
        "Revolute" | "Universal" | "Screw" | "Prismatic" | "RevoluteSpherical"
        | "RevoluteRevolute" => 1,
        "Cylindrical" | "PointOnLine" | "Parallel2" => 2,
        "Spherical" | "Planar" | "PointOnPlane" | "Distance" | "Perpendicular2" => 3,
        "AngleDriver" | "DistanceDriver" | "DisplacementDriver" | "OrientationDriver" => 3,
        "Perpendicular1" | "Parallel1" => 4,
        _ => unreachable!("{name} is not of this table"),
    }
}

impl Deviations {
    /// What holds over a motion.
    fn motion(&mut self, trial: &Trial<'_>, start: f64, x: &[f64]) {
        let (kernels, scene, what) = (&trial.kernels, &trial.scene, &trial.what);
        let is_driven = scene.time_derivatives(0.3, 1).amax() > 0.0;
        let moving: Vec<BodyId> = trial
            .ends
            .into_iter()
            .filter(|end| *end != GROUND)
            .collect();
        let total = |x: &[f64]| -> Vector6<f64> {
            moving.iter().map(|body| momentum(scene, *body, x)).sum()
        };
        let energy = |x: &[f64]| {
            let books = kernels.books(start, x);
            books.kinetic + books.potential
        };
        let mut instants = Vec::new();
        let mut momenta = Vec::new();
        run(&**kernels, [start, start + DURATION], x, |time, at, _| {
            // Where the joint is violated, its points differ and with them the moments of action
            // and reaction.
            let mut exact = at.to_vec();
            make_consistent_at(scene, time, &mut exact).expect("close");
            self.instant(trial, time, &exact);
            let [phi, rate, _] = kernels.rows(time, at);
            let largest = |rows: &[f64]| rows.iter().fold(0.0_f64, |most, row| most.max(row.abs()));
            self.violation
                .take(&format!("violation of {what}"), largest(&phi), DRIFT);
            self.rate.take(
                &format!("rate of violation of {what}"),
                largest(&rate),
                10.0 * DRIFT,
            );
            let (pair, freedom) = trial.freedom(time, at);
            if freedom.sharpness < SHARP {
                return ControlFlow::Break(());
            }
            let relative = pair.relative(&freedom.point);
            if !is_driven {
                let beside = beside(&freedom.twists, &relative);
                self.freedom.take(
                    &format!("motion of {what} in a direction that is not free"),
                    beside,
                    10.0 * DRIFT,
                );
                let gain = (energy(at) - energy(x)).abs() / energy(x).abs().max(1.0);
                self.energy.take(&format!("energy of {what}"), gain, DRIFT);
            }
            let speeds = coordinates(&freedom.twists, &relative);
            self.speeds.resize(speeds.len(), 0.0);
            for (most, speed) in self.speeds.iter_mut().zip(speeds) {
                *most = most.max(speed.abs());
            }
            instants.push(freedom);
            momenta.push(total(at));
            ControlFlow::Continue(())
        });
        let kept = match trial.ends {
            [GROUND, _] => {
                let standing = standing(&instants);
                assert_eq!(standing.len(), kept(trial.entry.name), "{what}");
                standing
            }
            [_, GROUND] => Vec::new(),
            _ => (0..6)
                .map(|k| Vector6::from_fn(|row, _| f64::from(row == k)))
                .collect(),
        };
        let size = momenta.first().map_or(1.0, |first| first.norm().max(1.0));
        for (momentum, direction) in momenta
            .iter()
            .flat_map(|m| kept.iter().map(move |d| (m, d)))
        {
            let change = (momentum - momenta[0]).dot(direction).abs() / size;
            self.momentum
                .take(&format!("momentum of {what}"), change, DRIFT);
        }
    }
}

#[test]
fn free_motions_are_free_and_the_others_do_not_happen() {
    let mut rng = generator(202);
    for entry in library().iter().filter(|entry| entry.free.is_some()) {
        let mut worst = Deviations::default();
        for placement in &entry.placements {
            let data = Data {
                gravity: [0.0; 3],
                ..placement.data(&mut rng)
            };
            let trial = Trial::new(entry, placement, data);
            for (time, x) in consistent(&trial.scene, 3, 9) {
                worst.motion(&trial, time, x.as_slice());
            }
            // A particle on the ground does not turn, although a joint of particles would let it.
            let is_still = |speed: &f64| *speed < 0.05;
            let speeds = core::mem::take(&mut worst.speeds);
            let turns = !(trial.any_particle() && trial.ends.contains(&GROUND));
            assert!(
                !(turns && speeds.iter().any(is_still)),
                "{}: {speeds:?}",
                trial.what
            );
        }
        println!("{}: {worst:?}", entry.name);
    }
}

#[test]
fn free_directions_feel_nothing_of_a_joint() {
    const STATES: usize = 10;
    let mut rng = generator(201);
    for entry in library().iter().filter(|entry| entry.free.is_some()) {
        let mut worst = Deviations::default();
        for placement in &entry.placements {
            let trial = Trial::new(entry, placement, placement.data(&mut rng));
            for (time, x) in consistent(&trial.scene, STATES, 7) {
                worst.instant(&trial, time, x.as_slice());
            }
        }
        assert!(
            worst.largest > 0.01,
            "{} does nothing: {}",
            entry.name,
            worst.largest
        );
        println!("{}: {worst:?}", entry.name);
    }
}

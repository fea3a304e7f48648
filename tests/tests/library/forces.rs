//! Every force of the library, and potentials of one's own: loads, energies and powers against the
//! assembler and against differences of the energy; and the books of energy over motions.

mod by_closure;
mod table;

use core::ops::ControlFlow;

use holonom_assembler::assembler::Assembler;
use holonom_assembler::bodies::{BodyId, GROUND};
use holonom_assembler::dual;
use holonom_assembler::joints::smooth_normals;
use holonom_assembler::states::{displace, generator};

use self::table::{Entry, entries};
use crate::comparison::{ROUND_OFF, Worst, distance};
use crate::course::run;
use crate::data::Data;
use crate::kernels::Kernels;
use crate::library::Placement;
use crate::states::{all, consistent};

/// A force among bodies: its kernels, the assembler with it and without.
struct Scene {
    what: String,
    kernels: Box<dyn Kernels>,
    with: Assembler,
    without: Assembler,
    bodies: Vec<BodyId>,
}

impl Scene {
    fn new(entry: &Entry, placement: &Placement, data: &Data) -> Self {
        let (mut without, bodies) = data.assembler(placement.members);
        if placement.late {
            without = without.with_normals(smooth_normals);
        }
        let mut with = without.clone();
        if let Some(assemble) = entry.assemble {
            with.add_force(assemble(&without, &bodies, data));
        }
        Self {
            what: format!("{} among {:?}", entry.name, placement.members),
            kernels: (placement.describe)(data),
            with,
            without,
            bodies,
        }
    }

    /// `x` without the auxiliary states.
    fn bare(&self, x: &[f64]) -> Vec<f64> {
        let (q, u) = x.split_at(x.len() - self.with.velocities());
        [&q[..self.with.body_coordinates()], u].concat()
    }

    /// Where a body's velocities stand.
    fn place(&self, body: BodyId) -> usize {
        let described = self.with.body(body);
        let mut bodies = self.with.bodies();
        bodies
            .find(|(other, ..)| *other == described)
            .expect("a body of the scene")
            .2
    }
}

/// The scenes of all placements, with some data for each; the last of an entry is the one of
/// literals.
fn scenes(seed: u64, gravity: bool, mut test: impl FnMut(&Entry, &Scene)) {
    let mut rng = generator(seed);
    for entry in entries() {
        for placement in &entry.placements {
            for _ in 0..4 {
                let mut data = placement.data(&mut rng);
                if !gravity {
                    data.gravity = [0.0; 3];
                }
                test(&entry, &Scene::new(&entry, placement, &data));
            }
        }
    }
}

#[test]
fn loads_energies_and_powers_are_those_of_the_assembler() {
    let mut worst = Worst::default();
    scenes(301, true, |entry, scene| {
        if entry.assemble.is_none() {
            return;
        }
        for (time, x) in all(&scene.with, 5, 40) {
            let (what, x) = (&scene.what, x.as_slice());
            let bare = scene.bare(x);
            let added = scene.with.forces_at(time, x) - scene.without.forces_at(time, &bare);
            let potential = scene.with.potential_energy(x) - scene.without.potential_energy(&bare);
            let power = scene.with.power_at(time, x);
            let books = scene.kernels.books(time, x);
            let weight = 3.0 * scene.with.gravity().norm();
            let size = added.norm().max(1.0);
            let compare =
                |worst: &mut Worst, name: &str, found: &[f64], expected: &[f64], floor: f64| {
                    worst.take(
                        &format!("{name} of {what}"),
                        distance(found, expected, floor),
                        ROUND_OFF,
                    );
                };
            let g = scene.kernels.forces(time, x);
            compare(
                &mut worst,
                "g",
                &g,
                scene.with.forces_at(time, x).as_slice(),
                1.0,
            );
            compare(&mut worst, "power", &[books.power], &[power], size);
            compare(
                &mut worst,
                "energy",
                &[books.potential],
                &[scene.with.potential_energy(x)],
                weight.max(size),
            );
            for (place, body) in scene.bodies.iter().enumerate() {
                let ([own, own_power], load) = scene.kernels.force(time, x, place);
                compare(
                    &mut worst,
                    "own energy",
                    &[own],
                    &[potential],
                    weight.max(size),
                );
                compare(&mut worst, "own power", &[own_power], &[power], size);
                if *body == GROUND {
                    assert_eq!(load, [0.0; 6], "{what}");
                } else {
                    let n = scene.place(*body);
                    compare(&mut worst, "load", &load, &added.as_slice()[n..n + 6], size);
                }
            }
        }
    });
    println!("forces: {:e}", worst.0);
}

/// Minus the slope of the potential energy along every velocity, by differences of fourth order.
fn slopes(scene: &Scene, time: f64, x: &[f64]) -> Vec<f64> {
    const STEP: f64 = 1e-3;
    let energy = |column: usize, step: f64| {
        let report = scene.kernels.report();
        let mut bare = scene.bare(x);
        let mut motion = vec![0.0; scene.without.velocities()];
        motion[column] = step;
        displace(&scene.without, &mut bare, &motion);
        let (q, u) = bare.split_at(report.coordinates);
        let mut moved = [
            q,
            &x[report.coordinates..report.coordinates + report.auxiliaries],
            u,
        ]
        .concat();
        scene.kernels.rewrap(&mut moved);
        scene.kernels.books(time, &moved).potential
    };
    (0..scene.without.velocities())
        .map(|column| {
            let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|k| energy(column, k * STEP));
            -(a - 8.0 * b + 8.0 * c - d) / (12.0 * STEP)
        })
        .collect()
}

/// A state of a scene that may have angles which the assembler does not know of.
fn with_counters(scene: &Scene, x: &[f64]) -> Vec<f64> {
    let report = scene.kernels.report();
    let (q, u) = x.split_at(scene.without.coordinates());
    let mut full = [q, &vec![0.0; report.auxiliaries], u].concat();
    scene.kernels.rewrap(&mut full);
    full
}

#[test]
fn potentials_act_by_minus_their_slope() {
    /// Fourth order at 1 mm and 1 mrad.
    const DIFFERENCES: f64 = 1e-9;
    let mut worst = Worst::default();
    scenes(302, true, |entry, scene| {
        for (time, x) in consistent(&scene.without, 3, 41) {
            let x = with_counters(scene, x.as_slice());
            let mut rest = x.clone();
            let first = x.len() - scene.without.velocities();
            rest[first..].fill(0.0);
            // At rest neither dampers nor gyroscopic moments act.
            let is_potential = entry.assemble.is_none() || entry.name.ends_with("SpringDamper");
            let g = scene.kernels.forces(time, &rest);
            let slopes = slopes(scene, time, &rest);
            if is_potential {
                worst.take(
                    &format!("slope of {}", scene.what),
                    distance(&g, &slopes, 1.0),
                    DIFFERENCES,
                );
            } else {
                let mut added = vec![0.0; g.len()];
                for (place, body) in scene
                    .bodies
                    .iter()
                    .enumerate()
                    .filter(|(_, body)| **body != GROUND)
                {
                    let n = scene.place(*body);
                    added[n..n + 6].copy_from_slice(&scene.kernels.force(time, &rest, place).1);
                }
                let conservative: Vec<f64> =
                    g.iter().zip(&added).map(|(g, added)| g - added).collect();
                worst.take(
                    &format!("weight beside {}", scene.what),
                    distance(&conservative, &slopes, 1.0),
                    DIFFERENCES,
                );
            }
        }
    });
    println!("slopes: {:e}", worst.0);
}

#[test]
fn springs_act_by_minus_the_gradient_of_their_energy_in_dual_numbers() {
    let mut worst = Worst::default();
    scenes(303, false, |entry, scene| {
        if !entry.name.ends_with("SpringDamper") || scene.with.gravity().norm() > 0.0 {
            return;
        }
        for (time, x) in all(&scene.with, 4, 42) {
            let mut rest = x.as_slice().to_vec();
            rest[scene.with.coordinates()..].fill(0.0);
            let gradient = dual::spring_forces(&scene.with, &rest);
            let g = scene.kernels.forces(time, &rest);
            worst.take(
                &scene.what,
                distance(&g, gradient.as_slice(), 1.0),
                ROUND_OFF,
            );
        }
    });
    println!("gradients: {:e}", worst.0);
}

#[test]
fn energy_changes_by_the_work_of_what_has_no_potential() {
    /// Of a motion at a tolerance of 1e-10.
    const BOOKED: f64 = 1e-8;
    let (mut worst, mut work_done) = (Worst::default(), 0.0_f64);
    scenes(304, true, |entry, scene| {
        // An energy that depends on time changes by itself.
        if entry.name == "Attraction" {
            return;
        }
        let (time, x) = consistent(&scene.without, 1, 43).swap_remove(0);
        let x = with_counters(scene, x.as_slice());
        let energy = |time: f64, x: &[f64]| {
            let books = scene.kernels.books(time, x);
            books.kinetic + books.potential
        };
        let start = energy(time, &x);
        let (mut least, mut most) = (0.0_f64, 0.0_f64);
        // Without a hinge the axes drift apart, until the angle between the bodies has no value.
        let duration = if entry.name.starts_with("Torsional") {
            0.3
        } else {
            1.0
        };
        run(
            &*scene.kernels,
            [time, time + duration],
            &x,
            |at, x, work| {
                (least, most) = (least.min(work), most.max(work));
                let size = start.abs().max(work.abs()).max(1.0);
                let error = (energy(at, x) - start - work).abs() / size;
                worst.take(&format!("energy of {}", scene.what), error, BOOKED);
                ControlFlow::Continue(())
            },
        );
        work_done = work_done.max(most - least);
    });
    assert!(work_done > 1.0);
    println!("books: {:e}", worst.0);
}

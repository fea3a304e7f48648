//! The woodpecker toy goes down its pole: a sleeve with play, a spring, and a bird that pecks.
//!
//! ```text
//! cargo run -p holonom-film --example woodpecker -- FOLDER
//! ```
//!
//! Lengths and masses are those of Glocker, *Dynamik von Starrkörpersystemen mit Reibung und
//! Stößen* (1995), with true angles in place of small ones.

use holonom::prelude::*;
use holonom::run::Plane;
use holonom_film::Film;

/// Half of the thickness of the pole (m).
const POLE: f64 = 0.0025;

/// In the plane of x and z; the pole is along z.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Woodpecker {
    #[body(
        mass = 0.01, inertia = [1e-5, 1e-5, 1e-6], position = [0.0, 0.0, -0.09],
        shape = cylinder(radius = 0.0025, from = [0.0, 0.0, -0.2], to = [0.0, 0.0, 0.02])
    )]
    pole: Body,
    #[joint(between = [ground, pole], point = [0.0, 0.0, 0.0])]
    foot: Fixed,
    #[body(
        mass = 3e-4, inertia = [5e-9, 5e-9, 5e-9],
        shape = tube(
            outer = 0.0045, inner = 0.0031, from = [0.0, 0.0, -0.0058], to = [0.0, 0.0, 0.0058]
        )
    )]
    sleeve: Body,
    #[body(
        mass = 4.5e-3, inertia = [7e-7, 7e-7, 7e-7], position = [0.025, 0.0, 0.0],
        shapes = [
            ball(radius = 0.007, at = [0.025, 0.0, 0.0]),
            ball(radius = 0.005, at = [0.018, 0.0, 0.016]),
            cone(radius = 0.002, from = [0.014, 0.0, 0.0185], to = [0.0049, 0.0, 0.02]),
            cone(radius = 0.004, from = [0.029, 0.0, -0.002], to = [0.036, 0.0, -0.022]),
        ]
    )]
    bird: Body,
    // The sleeve goes along the pole and tilts.
    #[joint(between = [ground, sleeve], point = [0.0, 0.0, 0.0], normal = [0.0, 1.0, 0.0])]
    plane: Planar,
    #[joint(between = [ground, sleeve], point = [0.0, 0.0, 0.0], normal = [1.0, 0.0, 0.0])]
    middle: PointOnPlane,
    #[joint(between = [sleeve, bird], point = [0.01, 0.0, 0.0], axis = [0.0, -1.0, 0.0])]
    leaf: Revolute,
    #[force(between = [sleeve, bird], axis = [0.0, -1.0, 0.0], stiffness = 0.0056)]
    spring: TorsionalSpringDamper,
    #[point(on = sleeve, at = [0.0031, 0.0, 0.0058])]
    upper: Point,
    #[point(on = sleeve, at = [0.0031, 0.0, -0.0058])]
    lower: Point,
    #[point(on = bird, at = [0.0049, 0.0, 0.02])]
    beak: Point,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| ".".into());
    let (toy, h) = (Woodpecker::default(), Woodpecker::HANDLES);
    let pole = Plane::on_ground([POLE, 0.0, 0.0], [1.0, 0.0, 0.0]).along([0.0, 0.0, 1.0]);
    let [beak, beak_rubs] = Interaction::contact(h.beak, pole)
        .restitution(0.5)
        .with_plane_friction(0.3);
    let [lower, lower_rubs] = Interaction::contact(h.lower, pole).with_plane_friction(0.3);
    let [upper, upper_rubs] = Interaction::contact(h.upper, pole).with_plane_friction(0.3);
    let interactions = [beak, beak_rubs, lower, lower_rubs, upper, upper_rubs];
    let [beak, ..] = Interaction::handles(&interactions);
    // The bird is pulled back by 0.4 rad.
    let mut start = toy.described_state()?;
    toy.set_angle(&mut start, h.leaf, -0.4)?;
    let mut film = Film::new().titled("Woodpecker");
    let mut pecks = Vec::new();
    let report = toy
        .simulation(StandardLagrange, DormandPrince::default())
        .initial_state(start)
        .interactions(interactions)
        .run(0.0..=1.5, every(0.002), |sample| -> Result<(), Fault> {
            film.record(sample);
            film.reading("height", "mm", 1e3 * sample.position(h.sleeve).z);
            film.reading("bird against sleeve", "rad", sample.angle(h.leaf));
            if let Some(peck) = sample.impact(beak)?
                && pecks.last() != Some(&peck.time)
            {
                pecks.push(peck.time);
            }
            Ok(())
        })?;
    film.warnings(&report.warnings());
    println!("{} pecks: {pecks:.4?} s", pecks.len());
    println!(
        "down by {:.2} mm",
        -1e3 * toy.view(1.5, &report.state)?.position(h.sleeve).z
    );
    let folder = std::path::Path::new(&folder);
    film.save(folder.join("woodpecker.html"))?;
    film.save_svg(folder.join("woodpecker.svg"))?;
    println!("{}", folder.join("woodpecker.html").display());
    Ok(())
}

//! The mechanisms with published data that the assembler is tried on, and scenes of one joint with
//! random data.

use crate::assembler::Assembler;
use crate::bodies::{Body, GROUND};

#[cfg(feature = "random")]
mod random;

#[cfg(feature = "random")]
pub use random::{Ends, connected, random_body, two_bodies};

/// The standard acceleration of the published problems (m/s^2, global axes).
pub const GRAVITY: [f64; 3] = [0.0, 0.0, -9.81];

/// The rod of chapter 15 (Flores 2015, table 15.1) hinged to the ground about x, along y and at
/// rest.
#[must_use]
pub fn pendulum() -> Assembler {
    let mut scene = Assembler::new(GRAVITY);
    let rod = scene.add_body(rod([0.0, 0.5, 0.0]));
    scene.add_revolute([GROUND, rod], [0.0; 3], [1.0, 0.0, 0.0]);
    scene
}

/// The heavy top at 150 rad/s (Bruls, Cardona, Arnold 2012) with a spherical joint at the origin.
#[must_use]
pub fn heavy_top() -> Assembler {
    let mut scene = Assembler::new(GRAVITY);
    let rate = [0.0, 150.0, -4.61538];
    // v = w x (0, 1, 0)
    let top = Body::rigid(15.0, [0.234375, 0.46875, 0.234375], [0.0, 1.0, 0.0])
        .with_velocity([-rate[2], 0.0, rate[0]], rate);
    let top = scene.add_body(top);
    scene.add_spherical([GROUND, top], [0.0; 3]);
    scene
}

/// `links` rods of chapter 15 in a row along y, hinged to the ground and to each other about x.
#[must_use]
pub fn chain(links: usize) -> Assembler {
    let mut scene = Assembler::new(GRAVITY);
    let mut before = GROUND;
    let mut y = 0.0;
    for _ in 0..links {
        let body = scene.add_body(rod([0.0, y + 0.5, 0.0]));
        scene.add_revolute([before, body], [0.0, y, 0.0], [1.0, 0.0, 0.0]);
        before = body;
        y += 1.0;
    }
    scene
}

/// The rod of chapter 15: 1 m along y, axes along the global ones.
fn rod(position: [f64; 3]) -> Body {
    Body::rigid(7.02, [0.5855265, 0.0010530, 0.5855265], position)
}

/// A door on two hinges, 10 equations of which 5 are independent, released 90 degrees from
/// equilibrium.
///
/// 0.8 m wide along x, 2 m high along y, hinged along y at `x = z = 0`; the axis leans 10 degrees
/// from the vertical, so gravity has a part along -z, which turns the door about +y.
#[must_use]
pub fn door() -> Assembler {
    let lean = 10_f64.to_radians();
    let mut scene = Assembler::new([0.0, -9.81 * lean.cos(), -9.81 * lean.sin()]);
    let inertia = [6.66933333333333, 1.06933333333333, 7.73333333333333];
    let leaf = scene.add_body(Body::rigid(20.0, inertia, [0.4, 1.0, 0.0]));
    for height in [0.25, 1.75] {
        scene.add_revolute([GROUND, leaf], [0.0, height, 0.0], [0.0, 1.0, 0.0]);
    }
    scene
}

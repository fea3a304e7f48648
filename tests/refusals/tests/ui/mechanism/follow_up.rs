//! A fault is reported once: what uses the mechanism adds nothing.
#![deny(warnings)]

use holonom::joints::{Revolute, Spherical};
use holonom::prelude::*;

#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Broken {
    #[body(mass = -7.02, inertia = [0.5, 0.1, 0.5])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0])]
    number: u32,
    spare: Body,
}

#[derive(Debug, Mechanism)]
struct Generic<T: Copy + 'static> {
    #[body(mass = 1.0, free)]
    bead: Particle,
    #[body(mass = 1.0, free)]
    other: T,
}

holonom::joint! {
    /// Its last equation has a fault.
    joint Hinge(i, j; point: Point, axis: Axis) {
        j.point - i.point;
        dot(i.axis.normals(), j.axes);
        angle about axis;
    }
}

#[derive(Mechanism)]
struct Hinged {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Hinge,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0])]
    ball: Spherical,
}

const COORDINATES: usize = Broken::REPORT.coordinates;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let broken = Broken::default();
    let method = Baumgarte { alpha: 5.0, beta: 5.0 };
    let report = Simulation::new(&broken, method, Rk4::every(1e-3)).run(0.0..=1.0, every(0.1), |sample| {
        println!("{} {}", sample.angle(Broken::HANDLES.pivot), sample.angle(Broken::HANDLES.number));
        println!("{:?} {:?}", sample.pose(Broken::HANDLES.rod), sample.pose(Broken::HANDLES.spare));
        ControlFlow::Continue(())
    })?;
    println!("{} {COORDINATES} {:?}", report.evaluations, Broken::HANDLES);
    let generic = Generic::<f64>::default();
    let state = generic.described_state::<f64>()?;
    println!("{:?}", Generic::<f64>::pose(&state, Generic::<f64>::HANDLES.bead));
    let hinged = Hinged::default();
    Simulation::new(&hinged, method, Rk4::every(1e-3)).run(0.0..=1.0, every(0.1), |sample| {
        println!("{}", sample.angle(Hinged::HANDLES.hinge));
        ControlFlow::Continue(())
    })?;
    Ok(())
}

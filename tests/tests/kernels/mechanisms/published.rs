//! The models with published data.

use holonom_assembler::assembler::Assembler;
use holonom_assembler::bodies::{Body, GROUND};
use holonom_models::{HeavyTop, RodPendulum};

use super::add_revolute;
use crate::scene::Scene;

impl Scene for RodPendulum {
    fn assembler() -> Assembler {
        let mut scene = Assembler::new([0.0, 0.0, -9.81]);
        let inertia = [0.5855265, 0.0010530, 0.5855265];
        let rod = scene.add_body(Body::rigid(7.02, inertia, [0.0, 0.5, 0.0]));
        add_revolute(&mut scene, [GROUND, rod], [0.0; 3], [1.0, 0.0, 0.0]);
        scene
    }
}

impl Scene for HeavyTop {
    fn assembler() -> Assembler {
        let mut scene = Assembler::new([0.0, 0.0, -9.81]);
        let top = Body::rigid(15.0, [0.234375, 0.46875, 0.234375], [0.0, 1.0, 0.0])
            .with_velocity([4.61538, 0.0, 0.0], [0.0, 150.0, -4.61538]);
        let top = scene.add_body(top);
        scene.add_spherical([GROUND, top], [0.0; 3]);
        scene
    }
}

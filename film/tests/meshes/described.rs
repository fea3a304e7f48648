//! A body that is described by a mesh: its mass and its looks are those of the file.

use holonom::prelude::*;
use holonom_film::Film;

use crate::{Result, meshes};

/// A sleeve of aluminium that flies.
#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
struct Sleeve {
    #[body(
        shape = mesh(file = "../macros/engine/tests/data/sleeve.stl", scale = 0.001, at = [0.0, 0.0, 1.0]),
        density = 2700.0, angular_velocity = [3.0, -2.0, 5.0], free,
    )]
    sleeve: Body,
}

#[test]
fn a_body_looks_like_the_mesh_that_describes_it() -> Result {
    let sleeve = Sleeve::default();
    let mut film = Film::new();
    let mut begin = None;
    let report = sleeve.simulation(StandardLagrange, Rk4::every(0.001)).run(
        0.0..=0.2,
        every(0.1),
        |sample| {
            film.record(sample);
            begin.get_or_insert_with(|| sample.position(Sleeve::HANDLES.sleeve));
        },
    )?;
    assert!(report.warnings().into_iter().next().is_none());
    let [mesh] = &meshes(&film)?[..] else {
        panic!("one mesh");
    };
    assert_eq!((mesh.body, mesh.faces.len()), (Some(0), 128));
    // That of trimesh, as in the engine's test; a page has corners by 16 bits.
    let volume = 3.918_678_332_654_044e-5;
    assert!((mesh.volume() / volume - 1.0).abs() < 1e-3);
    let corners = mesh.points.iter().map(|point| point.norm());
    let far = corners.fold(0.0, f64::max);
    // The half of 50 mm along, 20 mm across.
    assert!((far - 0.025_f64.hypot(0.02)).abs() < 1e-5, "{far}");
    let begin = begin.ok_or("a frame")?;
    let wanted = [0.030_000_000_328, -0.010_000_000_113, 1.005];
    assert!(
        (0..3).all(|k| (begin[k] - wanted[k]).abs() < 1e-8),
        "{begin}"
    );
    Ok(())
}

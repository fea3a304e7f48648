//! Meshes with more triangles than a page has.

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;
use std::fs;

use holonom::nalgebra::Vector3;
use holonom::prelude::*;
use holonom_film::UrdfMeshes;
use holonom_models::RodPendulum;

use crate::{Result, Shown, film, folder, meshes};

/// A surface over a grid of parameters, as OBJ.
fn obj(steps: usize, patches: &[&dyn Fn(f64, f64) -> Vector3<f64>]) -> String {
    let mut text = String::new();
    for (patch, place) in patches.iter().enumerate() {
        for k in 0..=steps {
            for l in 0..=steps {
                let at = place(k as f64 / steps as f64, l as f64 / steps as f64);
                let _ = writeln!(text, "v {} {} {}", at.x, at.y, at.z);
            }
        }
        for k in 0..steps {
            for l in 0..steps {
                let first = 1 + patch * (steps + 1) * (steps + 1) + k * (steps + 1) + l;
                let [a, b, c, d] = [first, first + 1, first + steps + 2, first + steps + 1];
                let _ = writeln!(text, "f {a} {d} {c}\nf {a} {c} {b}");
            }
        }
    }
    text
}

fn ball(u: f64, v: f64) -> Vector3<f64> {
    let ((sine, cosine), (up, out)) = ((TAU * v).sin_cos(), (PI * (u - 0.5)).sin_cos());
    Vector3::new(-out * cosine, out * sine, up)
}

/// The sides of a cube of length 2 by two of its axes, all seen from outside.
fn side(axis: usize, sign: f64) -> impl Fn(f64, f64) -> Vector3<f64> {
    move |u, v| {
        let (u, v) = if sign > 0.0 { (u, v) } else { (v, u) };
        let mut at = Vector3::zeros();
        at[axis] = sign;
        at[(axis + 1) % 3] = 2.0 * u - 1.0;
        at[(axis + 2) % 3] = 2.0 * v - 1.0;
        at
    }
}

fn alone(name: &str, text: &str) -> Result<Shown> {
    let file = folder(name)?.join("fine.obj");
    fs::write(&file, text)?;
    let mut film = film()?;
    film.mesh(
        &RodPendulum::default(),
        RodPendulum::HANDLES.rod,
        &file,
        1.0,
    )?;
    let mut meshes = meshes(&film)?;
    assert_eq!(meshes.len(), 1);
    Ok(meshes.remove(0))
}

#[test]
fn a_ball_stays_a_ball() -> Result {
    let shown = alone("ball", &obj(130, &[&ball]))?;
    let count = shown.faces.len();
    assert!(
        count <= 20_000 && count > 10_000,
        "{count} of 33800 triangles"
    );
    let volume = shown.volume();
    assert!((volume / (4.0 / 3.0 * PI) - 1.0).abs() < 2e-3, "{volume}");
    Ok(())
}

/// Its corners are those of no cell of the grid.
#[test]
fn a_cube_keeps_its_corners() -> Result {
    let sides = [0, 1, 2].map(|axis| (side(axis, 1.0), side(axis, -1.0)));
    let mut patches: Vec<&dyn Fn(f64, f64) -> Vector3<f64>> = Vec::new();
    for (over, under) in &sides {
        patches.extend([over as &dyn Fn(f64, f64) -> Vector3<f64>, under]);
    }
    let shown = alone("cube", &obj(61, &patches))?;
    let count = shown.faces.len();
    assert!(
        count <= 20_000 && count > 10_000,
        "{count} of 44652 triangles"
    );
    assert!((shown.volume() - 8.0).abs() < 8e-3, "{}", shown.volume());
    let low = shown
        .points
        .iter()
        .fold(Vector3::zeros(), |low, at| at.inf(&low));
    let high = shown
        .points
        .iter()
        .fold(Vector3::zeros(), |high, at| at.sup(&high));
    assert!(
        (high - low - Vector3::repeat(2.0)).norm() < 2e-3,
        "{low} {high}"
    );
    for k in 0..8 {
        let at = Vector3::from([0, 1, 2].map(|axis| {
            if k & (1 << axis) > 0 {
                high[axis]
            } else {
                low[axis]
            }
        }));
        let nearest = shown.points.iter().map(|point| (point - at).norm());
        assert!(
            nearest.fold(f64::INFINITY, f64::min) < 2e-3,
            "no corner at {at}"
        );
    }
    Ok(())
}

/// All meshes of a robot are equally fine, whatever their own triangles are.
#[test]
fn a_robot_has_as_many_triangles_as_are_asked_for() -> Result {
    let folder = folder("budget")?;
    fs::write(folder.join("fine.obj"), obj(130, &[&ball]))?;
    fs::write(folder.join("coarse.obj"), obj(60, &[&ball]))?;
    let visual = |file: &str| {
        format!("<visual><geometry><mesh filename=\"{file}.obj\"/></geometry></visual>")
    };
    let text = format!(
        r#"<robot name="balls"><link name="wall">{}</link><link name="rod"><inertial><mass value="2"/>
        <inertia ixx="0.2" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.2"/></inertial>{}</link>
        <joint name="pivot" type="continuous"><parent link="wall"/><child link="rod"/></joint></robot>"#,
        visual("coarse"),
        visual("fine")
    );
    let urdf = folder.join("balls.urdf");
    fs::write(&urdf, text)?;
    for most in [300, 3000] {
        let mut film = film()?;
        let drawn = film.urdf_meshes(&UrdfMeshes::of(&urdf).triangles(most))?;
        let [before, after] = drawn.triangles;
        assert!(
            before == 41_000 && after <= most && after > most / 4,
            "{drawn}"
        );
        let counts: Vec<usize> = meshes(&film)?.iter().map(|mesh| mesh.faces.len()).collect();
        let [wall, rod] = counts[..] else {
            panic!("{counts:?}");
        };
        assert!(wall.abs_diff(rod) <= after / 10, "{counts:?}");
    }
    Ok(())
}

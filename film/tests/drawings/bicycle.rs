//! Pictures of the bicycle as it leans and recovers, from a run.

use holonom::nalgebra::{UnitQuaternion, Vector3};
use holonom::prelude::*;
use holonom_models::Bicycle;

use crate::joints::drawn;
use crate::pen::{Of, Pen, V};

/// How far apart the pictures are (s).
const EVERY: f64 = 0.4;

/// What is drawn of an instant, seen from its right side: wheels, and lines of frame and fork.
struct Picture {
    wheels: [(V, V, f64); 2],
    lines: Vec<[V; 2]>,
    lean: f64,
    steering: f64,
}

pub(crate) fn figure() -> String {
    let pictures = pictures();
    let cells: Vec<_> = pictures
        .iter()
        .enumerate()
        .map(|(number, picture)| {
            let at = format!("{:.1} s", EVERY * number as f64);
            let [lean, steering] = [picture.lean, picture.steering].map(f64::to_degrees);
            let angles = format!("lean {lean:.1}°, steering {steering:.1}°");
            (at, angles, |pen: &mut Pen| picture.draw(pen))
        })
        .collect();
    drawn(
        "The benchmark bicycle leans, steers into its lean, and recovers",
        &cells,
    )
}

impl Picture {
    fn draw(&self, pen: &mut Pen) {
        pen.line(V::new(0.0, -62.0, -36.0), V::new(0.0, 62.0, -36.0));
        for (centre, axle, radius) in self.wheels {
            pen.cylinder(Of::J, centre - axle, centre + axle, radius);
        }
        for &[from, to] in &self.lines {
            pen.cylinder(Of::I, from, to, 1.6);
        }
    }
}

/// As the example `bicycle` runs it.
fn pictures() -> Vec<Picture> {
    let (bicycle, h) = (Bicycle::default(), Bicycle::HANDLES);
    let mut state: StateOf<Bicycle> = bicycle.described_state().expect("it is described");
    let (speed, lean) = (4.6, Vector3::new(0.5, 0.0, 0.0));
    let bodies = [
        (h.rear_wheel, 0.3),
        (h.frame, f64::INFINITY),
        (h.fork, f64::INFINITY),
        (h.front_wheel, 0.35),
    ];
    for (body, radius) in bodies {
        let place = Bicycle::pose(&state, body).position;
        let rolling = Vector3::new(0.0, -speed / radius, 0.0);
        let velocity = Vector3::new(speed, 0.0, 0.0) + lean.cross(&place);
        Bicycle::set_velocity(&mut state, body, velocity);
        Bicycle::set_angular_velocity_global(&mut state, body, lean + rolling);
    }
    let turned = UnitQuaternion::from_quaternion;
    let mut pictures = Vec::new();
    Simulation::new(&bicycle, StandardLagrange, DormandPrince::default())
        .initial_state(state)
        .joint_coordinates()
        .run(0.0..=2.8, every(EVERY), |sample| {
            let hub = sample.position(h.rear_wheel);
            let middle = Vector3::new(hub.x + 0.5, hub.y, 0.0);
            // Its z axis points down. The pen's x axis goes to the viewer, its y axis to the right.
            let placed = |place: Vector3<f64>| {
                let [x, y, z] = (46.0 * (place - middle)).into();
                V::new(y, x, -z - 36.0)
            };
            let wheel = |body, radius| {
                let pose = sample.pose(body);
                let [x, y, z] = (turned(pose.orientation) * Vector3::y()).into();
                (placed(pose.position), V::new(y, x, -z), 46.0 * radius)
            };
            let on = |body, at: [f64; 3], centre: [f64; 3]| {
                let pose = sample.pose(body);
                let arm = Vector3::from(at) - Vector3::from(centre);
                placed(pose.position + turned(pose.orientation) * arm)
            };
            let frame = |at: [f64; 3]| on(h.frame, at, [0.3, 0.0, -0.9]);
            let fork = |at: [f64; 3]| on(h.fork, at, [0.9, 0.0, -0.7]);
            let (saddle, head) = ([0.3, 0.0, -0.9], [0.77, 0.0, -1.0]);
            let across = turned(sample.pose(h.frame).orientation) * Vector3::y();
            pictures.push(Picture {
                wheels: [wheel(h.rear_wheel, 0.3), wheel(h.front_wheel, 0.35)],
                lines: vec![
                    [frame([0.0, 0.0, -0.3]), frame(saddle)],
                    [frame(saddle), frame([0.8, 0.0, -0.9])],
                    [frame(saddle), frame([0.3, 0.0, -1.4])],
                    [fork(head), fork([1.02, 0.0, -0.35])],
                    [fork([0.77, -0.25, -1.0]), fork([0.77, 0.25, -1.0])],
                ],
                lean: across.z.asin(),
                steering: sample.angle(h.steering),
            });
        })
        .expect("it rides");
    pictures
}

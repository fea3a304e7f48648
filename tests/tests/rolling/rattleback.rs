//! A rattleback against its minimal equations (Garcia and Hubbard 1988).

use holonom::Pose;
use holonom::nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use holonom::prelude::*;

holonom::joint! {
    /// An ellipsoid `j` rolls on a plane of `i`. Its half-axes (m) are along `first`, `second` and
    /// what is perpendicular to both.
    pub(crate) joint RollingEllipsoid(
        i, j; center: Point, first: Axis, second: Axis, point: Point, normal: Axis,
        a: Length, b: Length, c: Length
    ) {
        let third = cross(j.first, j.second);
        let reach = a * a * dot(i.normal, j.first) * j.first
            + b * b * dot(i.normal, j.second) * j.second
            + c * c * dot(i.normal, third) * third;
        let height = sqrt(dot(i.normal, reach));
        let above = j.center - i.point;
        dot(i.normal, above) - height;
        let slip = rate(above) - cross(angular_velocity(i), above)
            - cross(angular_velocity(i, j), reach / height);
        dot(i.normal.normals(), slip);
    }
}

/// The stone of Kane and Levinson (1982), its centre of mass 1 cm under that of the ellipsoid.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
pub(crate) struct Rattleback {
    /// How far the half-axes are turned about the vertical against the principal axes (rad).
    #[param]
    turned: f64,
    #[body(mass = 1.0, inertia = [2e-4, 1.6e-3, 1.7e-3], position = [0.0, 0.0, 0.01])]
    stone: Body,
    #[joint(
        between = [ground, stone], center = [0.0, 0.0, 0.02],
        first = [cos(turned), sin(turned), 0.0], second = [-sin(turned), cos(turned), 0.0],
        point = [0.0, 0.0, 0.0], normal = [0.0, 0.0, 1.0], a = 0.2, b = 0.03, c = 0.02
    )]
    contact: RollingEllipsoid,
}

/// Mass, gravity, how far the centre of the ellipsoid is above that of the mass.
const STONE: [f64; 3] = [1.0, 9.81, 0.01];
const TURNED: f64 = -0.05;

/// The stone alone: angular velocity and the normal of the plane along axes of the stone, its
/// turn from them, and the place of its centre of mass.
#[derive(Clone, Copy)]
struct Stone {
    spin: Vector3<f64>,
    orientation: [f64; 4],
    place: Vector3<f64>,
}

impl Stone {
    fn rotation(&self) -> Matrix3<f64> {
        let [w, x, y, z] = self.orientation;
        let v = Vector3::new(x, y, z);
        (w * w - v.norm_squared()) * Matrix3::identity()
            + 2.0 * v * v.transpose()
            + 2.0 * w * v.cross_matrix()
    }

    fn normal(&self) -> Vector3<f64> {
        self.rotation().row(2).transpose()
    }

    /// From the centre of mass to the point of contact, and its rate along axes of the stone.
    fn arm(&self) -> [Vector3<f64>; 2] {
        let axes = Rotation3::from_axis_angle(&Vector3::z_axis(), TURNED).into_inner();
        let squares = Vector3::new(0.2_f64.powi(2), 0.03_f64.powi(2), 0.02_f64.powi(2));
        let shape = axes * Matrix3::from_diagonal(&squares) * axes.transpose();
        let n = self.normal();
        let turns = n.cross(&self.spin);
        let height = n.dot(&(shape * n)).sqrt();
        let arm = Vector3::new(0.0, 0.0, STONE[2]) - shape * n / height;
        let slope = n.dot(&(shape * turns)) / height.powi(3);
        [arm, shape * (n * slope - turns / height)]
    }

    /// The velocity of the centre of mass, along global axes.
    fn velocity(&self) -> Vector3<f64> {
        self.rotation() * self.arm()[0].cross(&self.spin)
    }

    /// Angular momentum about the centre of mass, with the force on the point of contact
    /// `m (d(r x w)/dt + g n)` for one that does not slip.
    fn rates(&self) -> Stone {
        let [mass, gravity, _] = STONE;
        let inertia = Matrix3::from_diagonal(&Vector3::new(2e-4, 1.6e-3, 1.7e-3));
        let ([r, rate], w) = (self.arm(), self.spin);
        let about = inertia + mass * (r.norm_squared() * Matrix3::identity() - r * r.transpose());
        let force = rate.cross(&w) + w.cross(&r.cross(&w)) + gravity * self.normal();
        let moment = mass * r.cross(&force) - w.cross(&(inertia * w));
        let [e, x, y, z] = self.orientation.map(|number| 0.5 * number);
        Stone {
            spin: about.try_inverse().expect("positive definite") * moment,
            orientation: [
                -x * w.x - y * w.y - z * w.z,
                e * w.x + y * w.z - z * w.y,
                e * w.y + z * w.x - x * w.z,
                e * w.z + x * w.y - y * w.x,
            ],
            place: self.velocity(),
        }
    }

    fn moved(&self, rates: &Stone, time: f64) -> Stone {
        Stone {
            spin: self.spin + time * rates.spin,
            orientation: core::array::from_fn(|k| {
                self.orientation[k] + time * rates.orientation[k]
            }),
            place: self.place + time * rates.place,
        }
    }

    /// By extrapolated steps of the midpoint rule (Hairer, Norsett and Wanner 1993, section II.9).
    fn after(mut self, steps: usize, step: f64) -> Stone {
        const COUNTS: [u32; 6] = [2, 4, 6, 8, 10, 12];
        for _ in 0..steps {
            let rates = self.rates();
            let mut last: Vec<Stone> = Vec::new();
            for (row, count) in COUNTS.into_iter().enumerate() {
                let short = step / f64::from(count);
                let (mut before, mut here) = (self, self.moved(&rates, short));
                for _ in 1..count {
                    (before, here) = (here, before.moved(&here.rates(), 2.0 * short));
                }
                let mut found = vec![here];
                for (column, known) in last.iter().enumerate() {
                    let ratio = f64::from(count) / f64::from(COUNTS[row - column - 1]);
                    let by = (ratio * ratio - 1.0).recip();
                    let better = found[column].moved(&found[column], by).moved(known, -by);
                    found.push(better);
                }
                last = found;
            }
            self = last[COUNTS.len() - 1];
        }
        self
    }
}

/// Spun at -5 rad/s with a lean of 0.01 rad, it turns the other way as fast within 2 s; spun the
/// way that it likes, it goes on.
#[test]
fn a_rattleback_reverses_its_spin() {
    let h = Rattleback::HANDLES;
    let rattleback = Rattleback::new(TURNED).expect("a rattleback");
    for (spin, later) in [(-5.0, 4.9), (5.0, 4.9)] {
        let lean = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 0.01);
        let orientation = lean.into_inner();
        let mut stone = Stone {
            spin: Vector3::new(0.0, 0.0, spin),
            orientation: [orientation.w, orientation.i, orientation.j, orientation.k],
            place: Vector3::zeros(),
        };
        stone.place.z = -stone.arm()[0].dot(&stone.normal());
        let mut state: StateOf<Rattleback> = rattleback.described_state().expect("as described");
        let position = stone.place;
        Rattleback::set_pose(
            &mut state,
            h.stone,
            Pose {
                position,
                orientation,
            },
        );
        Rattleback::set_angular_velocity(&mut state, h.stone, stone.spin);
        Rattleback::set_velocity(&mut state, h.stone, stone.velocity());
        let quarters: Vec<_> =
            core::iter::successors(Some(stone), |stone| Some(stone.after(500, 1e-3)))
                .take(5)
                .collect();
        assert!(quarters[4].spin.dot(&quarters[4].normal()) > later);
        let observe = |sample: &Sample<'_, f64, Rattleback>| {
            let expected = quarters[(2.0 * sample.time()).round() as usize];
            let pose = sample.pose(h.stone);
            let turned = UnitQuaternion::new_unchecked(pose.orientation).to_rotation_matrix();
            for off in [
                (sample.angular_velocity(h.stone) - expected.spin).norm(),
                (turned.into_inner() - expected.rotation()).norm(),
                (pose.position - expected.place).norm(),
            ] {
                assert!(off < 1e-9, "{spin} {} {off:e}", sample.time());
            }
        };
        let tight = DormandPrince853::new(Tolerance {
            relative: 1e-13,
            absolute: 1e-14,
        });
        let simulation =
            || Simulation::new(&rattleback, StandardLagrange, tight).initial_state(state);
        simulation()
            .absolute_coordinates()
            .run(0.0..=2.0, every(0.5), observe)
            .expect("a run");
        simulation()
            .joint_coordinates()
            .run(0.0..=2.0, every(0.5), observe)
            .expect("a run");
    }
}

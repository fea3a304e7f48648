//! Tops that slide on a round tip: they rise, and one turns over.

use holonom::nalgebra::{Quaternion, Vector3};
use holonom::prelude::*;
use holonom::run::{InteractionMode, Plane};

use super::tight;

const GRAVITY: f64 = 9.81;

/// A body of revolution about its z axis, with a round tip about a point of that axis.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Top {
    #[param]
    mass: f64,
    /// About the axis, and across it (kg m^2).
    #[param]
    along: f64,
    #[param]
    across: f64,
    /// The middle of the tip, from the centre of mass along the axis (m).
    #[param]
    offset: f64,
    #[body(free, mass = mass, inertia = [across, across, along])]
    top: Body,
    #[point(on = top, at = [0.0, 0.0, offset])]
    tip: Point,
}

#[derive(Clone, Copy, Debug)]
struct Shape {
    mass: f64,
    along: f64,
    across: f64,
    offset: f64,
    radius: f64,
    friction: f64,
}

/// The horizontal velocity of the centre of mass, the axis, and the angular momentum (global).
type Minimal = [Vector3<f64>; 3];

impl Shape {
    fn spin(&self, axis: &Vector3<f64>, momentum: &Vector3<f64>) -> Vector3<f64> {
        let rest = 1.0 / self.along - 1.0 / self.across;
        momentum / self.across + rest * momentum.dot(axis) * axis
    }

    /// The rates by Newton's and Euler's laws about the centre of mass. The normal effort is that
    /// which keeps the tip on the ground.
    fn rates(&self, [velocity, axis, momentum]: &Minimal) -> Minimal {
        let spin = self.spin(axis, momentum);
        let arm = self.offset * axis - Vector3::new(0.0, 0.0, self.radius);
        let turning = spin.cross(axis);
        let height_rate = -self.offset * turning.z;
        let slip = Vector3::new(velocity.x, velocity.y, height_rate) + spin.cross(&arm);
        let slip = Vector3::new(slip.x, slip.y, 0.0);
        let unit = Vector3::new(0.0, 0.0, 1.0) - self.friction * slip / slip.norm();
        // The acceleration of the height against the one that the ground asks for, affine in N.
        let excess = |normal: f64| {
            let change = arm.cross(&(normal * unit));
            let rest = 1.0 / self.along - 1.0 / self.across;
            let by_axis = change.dot(axis) + momentum.dot(&turning);
            let faster =
                change / self.across + rest * (by_axis * axis + momentum.dot(axis) * turning);
            let turned = faster.cross(axis) + spin.cross(&turning);
            normal / self.mass - GRAVITY + self.offset * turned.z
        };
        let (zero, one) = (excess(0.0), excess(1.0));
        let normal = -zero / (one - zero);
        let force = normal * unit;
        let faster = force / self.mass;
        [
            Vector3::new(faster.x, faster.y, 0.0),
            turning,
            arm.cross(&force),
        ]
    }

    fn step(&self, state: &Minimal, step: f64) -> Minimal {
        let plus = |rates: &Minimal, by: f64| -> Minimal {
            core::array::from_fn(|k| state[k] + by * rates[k])
        };
        let a = self.rates(state);
        let b = self.rates(&plus(&a, 0.5 * step));
        let c = self.rates(&plus(&b, 0.5 * step));
        let d = self.rates(&plus(&c, step));
        core::array::from_fn(|k| state[k] + step / 6.0 * (a[k] + 2.0 * (b[k] + c[k]) + d[k]))
    }

    /// Begins at rest but for a spin about its axis. Calls at every tenth of the time with the
    /// state of the body and the mode of the friction.
    fn runs(
        &self,
        (inclination, rate): (f64, f64),
        (step, end): (f64, f64),
        mut each: impl FnMut(f64, &Minimal, InteractionMode),
    ) {
        let top = Top::new(self.mass, self.along, self.across, self.offset).expect("it is");
        let h = Top::HANDLES;
        let (sine, cosine) = inclination.sin_cos();
        let mut start = top.described_state().expect("it is described");
        let mut pose = top.view(0.0, &start).expect("a view").pose(h.top);
        pose.position = [0.0, 0.0, self.radius - self.offset * cosine].into();
        let half = 0.5 * inclination;
        pose.orientation = Quaternion::new(half.cos(), 0.0, half.sin(), 0.0);
        Top::set_pose(&mut start, h.top, pose);
        Top::set_angular_velocity(&mut start, h.top, Vector3::new(0.0, 0.0, rate));
        assert!((self.axis(&pose.orientation) - Vector3::new(sine, 0.0, cosine)).norm() < 1e-15);
        let floor = Plane::on_ground([0.0; 3], [0.0, 0.0, 1.0]);
        let contact = Interaction::contact(h.tip, floor)
            .radius(self.radius)
            .with_friction(self.friction);
        let [normal, along, _] = Interaction::handles(&contact);
        top.simulation(StandardLagrange, Rk4::every(step))
            .initial_state(start)
            .interactions(contact)
            .run(0.0..=end, every(0.1 * end), |sample| -> Result<(), Fault> {
                assert_eq!(sample.mode(normal)?, InteractionMode::AtLower);
                let axis = self.axis(&sample.pose(h.top).orientation);
                let spin = sample.angular_velocity_global(h.top);
                let about = spin.dot(&axis) * axis;
                let momentum = self.along * about + self.across * (spin - about);
                let state = [sample.velocity(h.top), axis, momentum];
                each(sample.time(), &state, sample.mode(along)?);
                Ok(())
            })
            .unwrap_or_else(|fault| panic!("{fault}"));
    }

    /// The third axis of a body.
    fn axis(&self, p: &Quaternion<f64>) -> Vector3<f64> {
        Vector3::new(
            2.0 * (p.i * p.k + p.w * p.j),
            2.0 * (p.j * p.k - p.w * p.i),
            1.0 - 2.0 * (p.i * p.i + p.j * p.j),
        )
    }
}

#[test]
fn a_top_rises_on_its_tip_as_its_own_equations_say() {
    let top = Shape {
        mass: 0.1,
        along: 5.0e-5,
        across: 8.0e-5,
        offset: -0.02,
        radius: 0.005,
        friction: 0.1,
    };
    let axis = Vector3::new(1.2_f64.sin(), 0.0, 1.2_f64.cos());
    let mut state = [Vector3::zeros(), axis, top.along * 100.0 * axis];
    let mut before = 0.0;
    top.runs((1.2, 100.0), (2e-4, 1.5), |time, found, mode| {
        assert_eq!(mode, InteractionMode::Slipping);
        let steps = ((time - before) / 5e-5).ceil();
        for _ in 0..steps as usize {
            state = top.step(&state, (time - before) / steps);
        }
        before = time;
        let error = (found[1] - state[1]).norm();
        assert!(error < 1e-7, "{error:e} at {time}");
        assert!((found[2] - state[2]).norm() < 1e-7 * state[2].norm());
    });
    assert!(axis.z < 0.4 && state[1].z > 0.6, "{}", state[1].z);
}

/// Jellett's invariant: whatever friction does at the tip of a body of revolution, its angular
/// momentum along the arm to the tip is kept.
#[test]
fn a_tippe_top_turns_over_with_jelletts_invariant() {
    let tippe = Shape {
        mass: 0.006,
        along: 7.0e-7,
        across: 8.0e-7,
        offset: 0.003,
        radius: 0.015,
        friction: 0.05,
    };
    let invariant = |[_, axis, momentum]: &Minimal| {
        let arm = tippe.offset * axis - Vector3::new(0.0, 0.0, tippe.radius);
        momentum.dot(&arm)
    };
    let mut all = Vec::new();
    tippe.runs((0.6, 150.0), (1e-3, 8.4), |_, state, mode| {
        all.push((invariant(state), state[1].z, mode));
    });
    let (first, ..) = all[0];
    let scale = tippe.radius * tippe.along * 150.0;
    for (now, ..) in &all {
        assert!((now - first).abs() < 1e-5 * scale, "{now} {first}");
    }
    let [.., (_, last, _)] = all.as_slice() else {
        panic!("there are samples");
    };
    assert!(*last < -0.7, "{last}");
}

/// The edge of a disc that rolls in a circle: leant by an angle, its plane turning at a rate about
/// the vertical. With the angular momentum carried round, `W cos(lean) (A W sin(lean) - C w) =
/// m r (W r w cos(lean) + g sin(lean))`.
#[test]
fn a_disc_rolls_in_a_circle_on_its_edge() {
    let (mass, across, along, radius) = (2.0, 0.02, 0.04, 0.2);
    let top = Top::new(mass, along, across, 0.0).expect("it is");
    let h = Top::HANDLES;
    let floor = Plane::on_ground([0.0; 3], [0.0, 0.0, 1.0]);
    for (lean, turn) in [(0.3_f64, 2.0), (0.8, -3.0), (1.3, 6.0), (1.5, 40.0)] {
        let (sine, cosine) = lean.sin_cos();
        let spin = (across * turn * turn * cosine * sine - mass * GRAVITY * radius * sine)
            / (turn * cosine * (along + mass * radius * radius));
        let axle = Vector3::new(0.0, cosine, sine);
        let upward = Vector3::new(0.0, -sine, cosine);
        // From the z axis to the axle, about x.
        let half = 0.5 * (lean - core::f64::consts::FRAC_PI_2);
        let mut start = top.described_state().expect("it is described");
        let mut pose = top.view(0.0, &start).expect("a view").pose(h.top);
        pose.position = radius * upward;
        pose.orientation = Quaternion::new(half.cos(), half.sin(), 0.0, 0.0);
        Top::set_pose(&mut start, h.top, pose);
        let spins = spin * axle + turn * cosine * upward;
        Top::set_angular_velocity_global(&mut start, h.top, spins);
        Top::set_velocity(&mut start, h.top, spins.cross(&pose.position));
        let contact =
            Interaction::contact_of_disc(h.top, [0.0, 0.0, 1.0], radius, floor).with_friction(10.0);
        let [normal, along, _] = Interaction::handles(&contact);
        let period = core::f64::consts::TAU / turn.abs();
        let circle = radius * (spin / turn).abs();
        let mut places = Vec::new();
        top.simulation(StandardLagrange, DormandPrince::new(tight()))
            .initial_state(start)
            .interactions(contact)
            .run(
                0.0..=period,
                every(period / 4.0),
                |sample| -> Result<(), Fault> {
                    assert_eq!(
                        sample.mode(along)?,
                        InteractionMode::Sticking,
                        "{lean} {turn}"
                    );
                    assert!((sample.effort(normal)? - mass * GRAVITY).abs() < 1e-6);
                    places.push(sample.position(h.top));
                    Ok(())
                },
            )
            .unwrap_or_else(|fault| panic!("{fault}"));
        let [first, quarter, half, _, last] = places.as_slice() else {
            panic!("five places, {}", places.len());
        };
        assert!((last - first).norm() < 1e-9);
        assert!(((half - first).norm() - 2.0 * circle).abs() < 1e-9);
        assert!(((quarter - first).norm() - 2.0_f64.sqrt() * circle).abs() < 1e-9);
    }
}

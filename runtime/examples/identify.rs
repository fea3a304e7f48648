//! Identification: the base parameters of a UR5 from its torques on an exciting trajectory.
//!
//! ```text
//! cargo run --release -p holonom --features urdf --example identify
//! ```

use std::f64::consts::TAU;

use holonom::nalgebra::Vector6;
use holonom::prelude::*;

holonom::urdf! {
    #[mechanism(kernels = [inverse, jacobian])]
    struct Ur5 = "../urdf/tests/data/robots/ur5.urdf";
}

/// Seconds of the trajectory, which begins anew then.
const PERIOD: f64 = 20.0;
/// The standard deviations of measured torques (N m).
const NOISE: [f64; 6] = [2.0, 2.0, 1.5, 0.3, 0.3, 0.3];

/// Random numbers (splitmix64, Steele et al. 2014).
struct Random(u64);

impl Random {
    /// From -1 to 1.
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((bits ^ (bits >> 31)) >> 11) as f64 / f64::powi(2.0, 52) - 1.0
    }

    /// Of deviation 1: the sum of twelve, nearly normal.
    fn normal(&mut self) -> f64 {
        (0..12).map(|_| 0.5 * self.uniform()).sum()
    }
}

/// A trajectory of five harmonics (Swevers et al., IEEE Trans. Robotics and Automation 13, 1997).
struct Trajectory([[[f64; 2]; 5]; 6]);

impl Trajectory {
    fn new(random: &mut Random) -> Self {
        Self([(); 6].map(|()| [(); 5].map(|()| [(); 2].map(|()| 0.5 * random.uniform()))))
    }

    /// Angles (rad), their rates and accelerations at a time (s).
    fn at(&self, time: f64) -> [Vector6<f64>; 3] {
        let mut motion = [Vector6::zeros(); 3];
        for (joint, harmonics) in self.0.iter().enumerate() {
            for (number, [a, b]) in (1..).zip(harmonics) {
                let w = TAU * f64::from(number) / PERIOD;
                let (sine, cosine) = (w * time).sin_cos();
                motion[0][joint] += a * sine - b * cosine;
                motion[1][joint] += w * (a * cosine + b * sine);
                motion[2][joint] += w * w * (b * cosine - a * sine);
            }
        }
        motion
    }
}

fn main() -> Result<(), Fault> {
    let (arm, h) = (Ur5::default(), Ur5::HANDLES);
    let space = arm.coordinates([
        h.shoulder_pan_joint,
        h.shoulder_lift_joint,
        h.elbow_joint,
        h.wrist_1_joint,
        h.wrist_2_joint,
        h.wrist_3_joint,
    ])?;
    let mut run = space.identification([
        h.shoulder_link,
        h.upper_arm_link,
        h.forearm_link,
        h.wrist_1_link,
        h.wrist_2_link,
        h.wrist_3_link,
    ]);
    let mut random = Random(1986);
    let trajectory = Trajectory::new(&mut random);
    for sample in 0..1000 {
        let [q, v, a] = trajectory.at(PERIOD * f64::from(sample) / 1e3);
        let state = space.state(q, v)?;
        // In the place of a real arm: filtered encoders, and currents of motors.
        let noise = Vector6::from(NOISE.map(|size| size * random.normal()));
        run.observe(&state, a, space.inverse(&state, a)? + noise)?;
    }

    let found = run.identify(NOISE)?;
    let (count, described) = (found.base.count(), found.base.values(run.described()));
    println!(
        "{count} base parameters, {:.3} of the noise left",
        found.residual
    );
    println!("with multiples of others  described     found   +/-");
    for (number, parameter) in found.base.independent().enumerate().take(12) {
        let (value, deviation) = (found.values[number], found.deviations[number]);
        println!(
            "{parameter:24} {:10.3} {value:9.3} {deviation:5.3}",
            described[number]
        );
    }

    // What it is for: torques of another motion.
    let parameters = found.base.parameters(&found.values, run.described());
    let [q, v, a] = Trajectory::new(&mut random).at(3.0);
    let state = space.state(q, v)?;
    let blocks = space.regressors(&state, a, run.bodies())?;
    let torques: Vector6<f64> = blocks.iter().zip(&parameters).map(|(y, p)| y * p).sum();
    let error = (torques - space.inverse(&state, a)?).amax();
    println!("torques of another motion: off by {error:.2} N m at most");
    assert!(count == 36 && (found.residual - 1.0).abs() < 0.03 && error < 1.0);
    Ok(())
}

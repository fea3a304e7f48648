//! A joint of another module by its absolute path; a joint and a mechanism inside a function.

use mech::prelude::*;

/// A hook on two ropes.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
pub struct Crane {
    #[body(mass = 100.0, position = [0.0, 0.0, -8.0])]
    hook: Particle,
    #[joint(between = [ground, hook], from = [0.0, 0.0, 0.0], to = [0.0, 0.0, -8.0], length = 8.0)]
    rope: crate::ropes::Rope,
    #[joint(between = [ground, hook], from = [1.0, 0.0, 0.0], to = [0.0, 0.0, -8.0], length = 8.1)]
    spare: crate::ropes::spare::Rope,
}

/// The acceleration (m/s^2) of a hook of 100 kg that hangs beside its trolley by a tenth of the
/// rope's length.
///
/// # Errors
/// The description has no parameter that could be refused.
pub fn sway() -> Result<f64, ParameterError> {
    mech::joint! {
        /// Keeps a point at a distance from another.
        joint Rope(i, j; from: Point, to: Point, reach: Length) {
            squared(j.to - i.from) - reach * reach;
        }
    }

    #[derive(Mechanism)]
    #[mechanism(gravity = [0.0, 0.0, -10.0])]
    struct Trolley {
        #[body(mass = 100.0, position = [0.8, 0.0, -sqrt(8.0 * 8.0 - 0.8 * 0.8)])]
        hook: Particle,
        #[joint(
            between = [ground, hook],
            from = [0.0, 0.0, 0.0],
            to = [0.8, 0.0, -sqrt(8.0 * 8.0 - 0.8 * 0.8)],
            reach = 8.0
        )]
        rope: Rope,
    }

    let trolley = Trolley::default();
    let state = trolley.described_state::<f64>()?;
    let constants = trolley.constants::<f64>()?;
    let rigid = mech::mechanism::Stabilisation {
        rate: 0.0,
        position: 0.0,
        compliance: 0.0,
    };
    let coefficients = Trolley::coefficients(&constants, &rigid);
    let evaluation =
        Trolley::evaluate::<f64, mech::mechanism::Plain>(&constants, &coefficients, 0.0, &state);
    let [x, _, _] = *evaluation.rates.velocities();
    Ok(x)
}

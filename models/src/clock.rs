//! A pendulum clock with dry friction.

use core::f64::consts::TAU;

use holonom::Scalar;
use holonom::prelude::*;
use holonom::run::{Event, InteractionHandle};

/// A clock whose pendulum loses energy by dry friction. It gets it back once a period, when the
/// wheel goes on by a tooth. At the start it passes the vertical at 0.8 rad/s. Gravity is along -z.
///
#[doc = include_str!("sketches/clock.svg")]
///
/// ```text
///     z     ( o )  wheel on its arbor, 30 teeth, driven by a weight
///     |
///     |       o    pivot with dry friction       y away from the reader
///     |      /
///     o     O--- x     bob, angle from the vertical towards x
/// ```
///
/// Andronov, Vitt and Khaikin, *Theory of Oscillators*, 1966, chapter III: Coulomb friction, and a
/// fixed kinetic energy that is added each time the pendulum passes the vertical one way. Every
/// start leads to one swing, whose amplitudes `a` and `b` obey `V(a) - V(b) = T (a + b)` and
/// `E = 2 T (a + b)`, with the friction `T`, the energy `E` and `V` that of the weight. The data
/// are ours: a steel bob at 1 m, `T = 0.04` N m, and `E` of the wheel's moment over one tooth.
///
/// Good for: interactions. The friction sticks and slides; a dog holds the wheel at its teeth.
///
/// ```
/// use holonom::prelude::*;
/// use holonom_models::Clock;
///
/// let (clock, h) = (Clock::default(), Clock::HANDLES);
/// clock
///     .simulation(StandardLagrange, DormandPrince::default())
///     .interactions(Clock::interactions())
///     .on("beat", Crossing::Rising, |sample| sample.angle(h.pivot), Clock::beat)
///     .on("tooth", Crossing::Either, |sample| Clock::tooth(sample.angle(h.arbor)), Clock::lock)
///     .run(0.0..=10.0, every(0.1), |sample| {
///         println!("{:.1} s: {:.4} rad", sample.time(), sample.angle(h.pivot));
///     })?;
/// # Ok::<(), SimulationError<StateOf<Clock>>>(())
/// ```
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
pub struct Clock {
    #[body(
        shapes = [
            rod(radius = 0.005, from = [0.0, 0.0, 0.0], to = [0.0, 0.0, -0.88]),
            disc(radius = 0.12, thickness = 0.02, at = [0.0, 0.0, -1.0], axis = [0.0, 1.0, 0.0]),
        ],
        density = 7800.0,
        velocity = [0.8 * 0.29768 / 0.31, 0.0, 0.0], angular_velocity = [0.0, -0.8, 0.0]
    )]
    pendulum: Body,
    #[body(
        shapes = [
            disc(radius = 0.14, thickness = 0.004, at = [0.0, 0.0, 0.25], axis = [0.0, 1.0, 0.0]),
            rod(radius = 0.003, from = [0.0, 0.0, 0.25], to = [0.0, 0.0, 0.45]),
            ball(radius = 0.011906, at = [0.0, 0.0, 0.17]),
        ],
        density = 2700.0
    )]
    wheel: Body,
    #[joint(between = [ground, pendulum], point = [0.0, 0.0, 0.0], axis = [0.0, -1.0, 0.0])]
    pivot: Revolute,
    #[joint(between = [ground, wheel], point = [0.0, 0.0, 0.25], axis = [0.0, 1.0, 0.0])]
    arbor: Revolute,
    #[force(between = [ground, wheel], moment = [0.0, 0.15, 0.0])]
    weight: ConstantMoment,
}

impl Clock {
    /// The dry friction of the pivot (N m).
    pub const FRICTION: f64 = 0.04;
    /// One of 30 teeth (rad).
    pub const TOOTH: f64 = TAU / 30.0;
    /// What the pendulum gets at a beat (J): the moment of the weight over a tooth.
    pub const GAIN: f64 = 0.15 * Self::TOOTH;

    /// The friction of the pivot, and the dog that holds the wheel.
    #[must_use]
    pub fn interactions() -> [Interaction<f64, Self>; 2] {
        [
            Interaction::friction(Self::HANDLES.pivot.angle(), Self::FRICTION),
            Interaction::brake(Self::HANDLES.arbor.angle(), f64::INFINITY),
        ]
    }

    /// The handles of [`Clock::interactions`].
    #[must_use]
    pub fn interaction_handles() -> [InteractionHandle<Self>; 2] {
        Interaction::handles(&Self::interactions())
    }

    /// What a tooth does when the pendulum passes the vertical: the energy is added, and the wheel
    /// is let go.
    ///
    /// # Errors
    /// Those of [`Event::set_angle_rate`].
    pub fn beat(event: &mut Event<'_, f64, Self>) -> Result<(), Fault> {
        let pivot = Self::HANDLES.pivot;
        // The wheel stands still: all of it is the pendulum's.
        let gained = 1.0 + Self::GAIN / event.kinetic_energy();
        let rate = event.angle_rate(pivot) * Scalar::sqrt(gained);
        event.set_angle_rate(pivot, rate)?;
        let [_, dog] = Self::interaction_handles();
        event.release(dog)
    }

    /// Zero where the wheel, at an angle (rad), is at a tooth.
    #[must_use]
    pub fn tooth(angle: f64) -> f64 {
        Scalar::sin(angle * (0.5 * TAU / Self::TOOTH))
    }

    /// The dog holds the wheel at a tooth.
    ///
    /// # Errors
    /// Those of [`Event::engage`].
    pub fn lock(event: &mut Event<'_, f64, Self>) -> Result<(), Fault> {
        let [_, dog] = Self::interaction_handles();
        event.engage(dog)
    }
}

//! What is held by dry friction stays where it is.

use core::f64::consts::{PI, TAU};

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::InteractionMode as Mode;

use super::{GRAVITY, Moves, tight};

/// A block of 3 kg on an incline of 20 degrees that rises along x.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Wedge {
    #[body(mass = 3.0, inertia = [0.1, 0.1, 0.1])]
    block: Body,
    #[joint(
        between = [ground, block], point = [0.0, 0.0, 0.0],
        axis = [0.93969262078590838405, 0.0, 0.34202014332566873304]
    )]
    incline: Prismatic,
}

fn slope() -> f64 {
    PI / 9.0
}

/// The friction of a coefficient under the weight.
fn friction(coefficient: f64) -> f64 {
    coefficient * 3.0 * GRAVITY * slope().cos()
}

fn wedge<I, C>(integrator: I, capacity: f64, end: f64) -> (f64, f64, Mode)
where
    C: Coordinates<Wedge>,
    I: Moves<Wedge, C, 1>,
{
    let (wedge, h) = (Wedge::default(), Wedge::HANDLES);
    let mut last = (0.0, 0.0, Mode::Released);
    let interactions = [Interaction::friction(h.incline.displacement(), capacity)];
    let [friction] = Interaction::handles(&interactions);
    Simulation::new(&wedge, StandardLagrange, integrator)
        .coordinates::<C>()
        .interactions(interactions)
        .run(
            0.0..=end,
            every(0.01 * end),
            |sample| -> Result<(), Fault> {
                last = (
                    sample.displacement(h.incline),
                    sample.effort(friction)?,
                    sample.mode(friction)?,
                );
                Ok(())
            },
        )
        .expect("it runs");
    last
}

#[test]
fn a_wedge_does_not_creep() {
    let holds = 3.0 * GRAVITY * slope().sin();
    let standing = |(place, effort, mode): (f64, f64, Mode)| {
        assert!(place.abs() < 1e-10, "{place:e}");
        assert!((effort - holds).abs() < 1e-12 * holds, "{effort}");
        assert_eq!(mode, Mode::Sticking);
    };
    standing(wedge::<_, Relative>(
        DormandPrince::default(),
        friction(0.4),
        1e4,
    ));
    standing(wedge::<_, Absolute>(
        DormandPrince::default(),
        friction(0.4),
        1e4,
    ));
    standing(wedge::<_, Relative>(Rk4::every(2.0), friction(0.4), 1e4));
    standing(wedge::<_, Absolute>(Rk4::every(2.0), friction(0.4), 1e4));
}

#[test]
fn a_steeper_one_slides_as_galileo_says() {
    for coefficient in [0.0, 0.1, 0.36] {
        let acceleration = GRAVITY * (coefficient * slope().cos() - slope().sin());
        let wanted = 0.5 * acceleration * 4.0;
        for (place, _, mode) in [
            wedge::<_, Relative>(DormandPrince::new(tight()), friction(coefficient), 2.0),
            wedge::<_, Absolute>(DormandPrince::new(tight()), friction(coefficient), 2.0),
        ] {
            assert!((place / wanted - 1.0).abs() < 1e-10, "{place} {wanted}");
            assert_eq!(mode, Mode::SlidingDown);
        }
    }
}

/// A nut that carries 5 kg on a vertical bolt of 2 mm a turn.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Bolt {
    #[body(mass = 5.0, inertia = [0.02, 0.02, 0.01])]
    nut: Body,
    #[joint(
        between = [ground, nut], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0], pitch = 0.002
    )]
    thread: Screw,
}

#[test]
fn a_bolt_is_held_by_the_friction_of_its_thread() {
    let (bolt, h) = (Bolt::default(), Bolt::HANDLES);
    let drives = 5.0 * GRAVITY * 0.002 / TAU;
    let run = |part: f64, end: f64| {
        let friction = Interaction::friction(h.thread.angle(), part * drives);
        let report = bolt
            .simulation(StandardLagrange, DormandPrince::new(tight()))
            .interactions([friction])
            .run(0.0..=end, every(0.1 * end), |_| ())
            .expect("it runs");
        Bolt::pose(&report.state, h.nut).position.z
    };
    let place = run(1.1, 1e4);
    assert!(place.abs() < 1e-10, "{place:e}");
    // One coordinate: the inertia about the axis, and the mass by the lead.
    let lead = 0.002 / TAU;
    let rate = -0.1 * drives / (0.01 + 5.0 * lead * lead);
    let (place, wanted) = (run(0.9, 2.0), 0.5 * rate * 4.0 * lead);
    assert!((place / wanted - 1.0).abs() < 1e-9, "{place} {wanted}");
}

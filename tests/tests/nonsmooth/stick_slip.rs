//! A mass on a belt with a spring to the wall: the oscillator of brakes and of bows.

use core::f64::consts::PI;

use holonom::DormandPrince853;
use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::InteractionMode as Mode;

use super::{Moves, tight};

const STIFFNESS: f64 = 50.0;
const BELT: f64 = 0.2;
const SLIDING: f64 = 6.0;
const STICTION: f64 = 10.0;

/// A mass of 2 kg on a belt that runs along x at 0.2 m/s, on a spring of 50 N/m to the ground.
#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
struct Oscillator {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], velocity = [0.2, 0.0, 0.0])]
    belt: Body,
    #[body(mass = 2.0, inertia = [0.1, 0.1, 0.1], velocity = [0.2, 0.0, 0.0])]
    block: Body,
    #[joint(between = [ground, belt], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rollers: Prismatic,
    #[joint(
        between = [ground, belt], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0],
        motion = 0.2 * time
    )]
    drive: DisplacementDriver,
    #[joint(between = [belt, block], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    contact: Prismatic,
    #[force(
        between = [ground, block], head = [-10.0, 0.0, 0.0], tail = [0.0, 0.0, 0.0],
        stiffness = 50.0, free_length = 10.0
    )]
    spring: SpringDamper,
}

/// Where the block is at a time, and whether it sticks.
///
/// It slips where the spring holds the stiction, and moves about the place of the sliding friction
/// as a free oscillator does: `(S - F) / k cos(w t) + v / w sin(w t)`. It has the belt's speed
/// again as far before that place as it was beyond it.
fn exact(time: f64) -> (f64, bool) {
    let frequency = (STIFFNESS / 2.0).sqrt();
    let (middle, beyond) = (SLIDING / STIFFNESS, (STICTION - SLIDING) / STIFFNESS);
    let slips = (2.0 * PI - 2.0 * (beyond * frequency / BELT).atan()) / frequency;
    let sticks = 2.0 * beyond / BELT;
    let first = STICTION / STIFFNESS / BELT;
    if time < first {
        return (BELT * time, true);
    }
    let since = (time - first) % (slips + sticks);
    if since < slips {
        let angle = frequency * since;
        let swings = beyond * angle.cos() + BELT / frequency * angle.sin();
        (middle + swings, false)
    } else {
        (middle - beyond + BELT * (since - slips), true)
    }
}

/// The largest error of the place over eight changes of the mode.
fn error<I, C>(integrator: I) -> f64
where
    C: Coordinates<Oscillator>,
    I: Moves<Oscillator, C, 1>,
{
    let (oscillator, h) = (Oscillator::default(), Oscillator::HANDLES);
    let mut largest = 0.0_f64;
    let mut seen = [0; 2];
    let friction = Interaction::friction(h.contact.displacement(), SLIDING).stiction(STICTION);
    let frictions = [friction];
    let [friction] = Interaction::handles(&frictions);
    Simulation::new(&oscillator, StandardLagrange, integrator)
        .coordinates::<C>()
        .interactions(frictions)
        .run(0.0..=7.003, every(0.013), |sample| -> Result<(), Fault> {
            let time = sample.time();
            let (place, sticks) = exact(time);
            // Where a mode ends, both are right.
            let is_between = exact(time - 1e-8).1 != exact(time + 1e-8).1;
            match sample.mode(friction)? {
                Mode::Sticking if sticks || is_between => {
                    let speed = sample.velocity(h.block).x;
                    assert!((speed - BELT).abs() < 1e-12, "{speed} at {time}");
                }
                Mode::SlidingDown if !sticks || is_between => {
                    let effort = sample.effort(friction)?;
                    assert!((effort - SLIDING).abs() < 1e-12, "{effort} at {time}");
                }
                mode => panic!("{mode:?} at {time}"),
            }
            seen[usize::from(sticks)] += 1;
            let error = sample.pose(h.block).position.x - place;
            largest = largest.max(error.abs());
            Ok(())
        })
        .expect("it moves");
    assert!(seen.iter().all(|seen| *seen > 200), "{seen:?}");
    largest
}

#[test]
fn sticking_and_slipping_are_those_of_the_closed_form() {
    let errors = [
        error::<_, Relative>(DormandPrince::new(tight())),
        error::<_, Absolute>(DormandPrince::new(tight())),
        error::<_, Relative>(DormandPrince853::new(tight())),
        error::<_, Relative>(Rk4::every(1e-3)),
        error::<_, Absolute>(Rk4::every(1e-3)),
    ];
    assert!(errors.iter().all(|error| *error < 1e-9), "{errors:?}");
}

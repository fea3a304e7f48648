//! A block that rocks from corner to corner: two contacts of one body, of which one opens where
//! the other closes.

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::{InteractionMode as Mode, Plane};

use super::{assert_times, reference, tight};

/// A block of 1 kg, 0.3 m wide and 1.2 m high, that leans over its corner `a` at the origin by 0.6
/// of its slenderness.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Block {
    #[body(
        mass = 1.0, inertia = [0.1275, 0.1275, 0.1275],
        position = [
            0.0,
            0.6 * sin(0.14698719787611848) - 0.15 * cos(0.14698719787611848),
            0.6 * cos(0.14698719787611848) + 0.15 * sin(0.14698719787611848)
        ]
    )]
    block: Body,
    #[joint(between = [ground, block], point = [0.0, 0.0, 0.0], normal = [1.0, 0.0, 0.0])]
    plane: Planar,
    #[point(on = block, at = [0.0, 0.0, 0.0])]
    a: Point,
    #[point(
        on = block,
        at = [0.0, -0.3 * cos(0.14698719787611848), 0.3 * sin(0.14698719787611848)]
    )]
    b: Point,
}

fn rocks<C: Coordinates<Block>>(what: &str) {
    let (block, h) = (Block::default(), Block::HANDLES);
    let floor = Plane::on_ground([0.0; 3], [0.0, 0.0, 1.0]);
    let corners = [h.a, h.b].map(|corner| Interaction::contact(corner, floor));
    let handles = Interaction::handles(&corners);
    let mut times = Vec::new();
    let mut energy = None;
    let centre: StateOf<Block> = block.described_state().expect("described");
    let centre: f64 = Block::pose(&centre, h.block).position.y;
    block
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .interactions(corners)
        .run(0.0..=0.75, every(2e-3), |sample| -> Result<(), Fault> {
            for corner in handles {
                if let Some(impact) = sample.impact(corner)?
                    && times.last().is_none_or(|last| *last < impact.time)
                {
                    times.push(impact.time);
                    energy = None;
                }
            }
            // One corner bears it, by turns, and the floor takes nothing away.
            let [a, b] = handles;
            let modes = [sample.mode(a)?, sample.mode(b)?];
            let wanted = if times.len() % 2 == 0 {
                [Mode::AtLower, Mode::Free]
            } else {
                [Mode::Free, Mode::AtLower]
            };
            let is_struck = times.last().is_some_and(|time| *time == sample.time());
            assert!(
                is_struck || modes == wanted,
                "{modes:?} at {}",
                sample.time()
            );
            if !is_struck {
                let energy = *energy.get_or_insert(sample.energy());
                assert!((sample.energy() - energy).abs() < 1e-10, "{what}");
            }
            // Ice: the centre stays over its place.
            let aside: f64 = sample.pose(h.block).position.y - centre;
            assert!(aside.abs() < 1e-11, "{what}: {aside:e}");
            Ok(())
        })
        .expect("it rocks");
    assert_times(what, &times, &reference::ROCKING, 1e-10);
}

#[test]
fn a_block_rocks_on_ice_at_the_times_of_its_energy() {
    rocks::<Relative>("joints");
    rocks::<Absolute>("bodies");
}

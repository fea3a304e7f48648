//! A drawer that tilts in its guide, a wedge that locks itself, and a slider at its dead points.

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::InteractionMode as Mode;

use super::{GRAVITY, tight};

/// A drawer of 3 kg along x, pulled beside its middle.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Drawer {
    #[input]
    pull: f64,
    #[param]
    beside: f64,
    #[body(mass = 3.0, inertia = [0.1, 0.1, 0.1])]
    drawer: Body,
    #[joint(between = [ground, drawer], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    guide: Prismatic,
    #[force(between = [ground, drawer], point = [0.2, beside, 0.0], force = [pull, 0.0, 0.0])]
    hand: PointForce,
}

fn drawn<C: Coordinates<Drawer>>(beside: f64, guide: Option<f64>) -> f64 {
    let (mut drawer, h) = (Drawer::new(beside).expect("a drawer"), Drawer::HANDLES);
    drawer.pull = 6.0;
    let friction = Interaction::friction_by_load(h.guide, 0.4);
    let friction = guide.map_or(friction, |half_length| friction.guide(half_length));
    let report = Simulation::new(&drawer, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .interactions([friction])
        .run(0.0..=1.0, every(0.1), |_| ())
        .expect("it is pulled");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    drawer
        .view(1.0, &report.state)
        .expect("a view")
        .displacement_rate(h.guide)
}

fn drawer<C: Coordinates<Drawer>>() {
    // Forces of `F e / (2 l)` at both ends make the moment: it jams from `mu e = l` on.
    for (beside, half_length) in [
        (0.1, 0.25),
        (0.3, 0.25),
        (0.62, 0.25),
        (0.63, 0.25),
        (9.0, 0.25),
    ] {
        let wanted = (6.0_f64 - 0.4 * 6.0 * beside / half_length).max(0.0) / 3.0;
        let found = drawn::<C>(beside, Some(half_length));
        assert!((found - wanted).abs() < 1e-10, "{beside}: {found} {wanted}");
    }
    // Without a length moments do not count.
    let found = drawn::<C>(9.0, None);
    assert!((found - 2.0).abs() < 1e-10, "{found}");
}

#[test]
fn a_drawer_jams_that_is_pulled_too_far_beside_its_middle() {
    drawer::<Relative>();
    drawer::<Absolute>();
}

/// A wedge of 1 kg along x, under a block of 10 kg that slides along z on its face: one loop.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Wedge {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    wedge: Body,
    #[body(mass = 10.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 1.0])]
    block: Body,
    #[joint(between = [ground, wedge], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    floor: Prismatic,
    #[joint(between = [ground, block], point = [0.0, 0.0, 1.0], axis = [0.0, 0.0, 1.0])]
    wall: Prismatic,
    #[joint(between = [wedge, block], point = [0.0, 0.0, 1.0], normal = [0.28, 0.0, 0.96])]
    face: PointOnPlane,
}

/// The wedge's place and speed after a time, with a coefficient at the floor and one at the wall.
fn wedged<C: Coordinates<Wedge>>(mu: [f64; 2], end: f64) -> [f64; 2] {
    let (wedge, h) = (Wedge::default(), Wedge::HANDLES);
    let report = Simulation::new(&wedge, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .projection(Projection::default())
        .interactions([
            Interaction::friction_by_load(h.floor, mu[0]),
            Interaction::friction_by_load(h.wall, mu[1]),
        ])
        .run(0.0..=end, every(end), |_| ())
        .expect("it slides or stays");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    let view = wedge.view(end, &report.state).expect("a view");
    [view.displacement(h.floor), view.displacement_rate(h.floor)]
}

fn wedge<C: Coordinates<Wedge>>() {
    // The face pushes the wedge to -x by P sin, the floor bears g + P cos, the wall P sin.
    let (sine, cosine) = (0.28, 0.96);
    for mu in [[0.1, 0.0], [0.05, 0.2], [0.0, 0.0]] {
        // a = (P sin - mu (g + P cos)) / 1; 10 b = 10 g - P cos - nu P sin; b cos = a sin.
        let floor = sine - mu[0] * cosine;
        let wall = cosine + mu[1] * sine;
        let push = (10.0 * GRAVITY * cosine + 10.0 * mu[0] * GRAVITY * sine)
            / (10.0 * sine * floor + wall * cosine);
        let wanted = mu[0] * GRAVITY - push * floor;
        let [_, found] = wedged::<C>(mu, 0.1);
        assert!(
            (found - 0.1 * wanted).abs() < 1e-10,
            "{mu:?}: {found} {wanted}"
        );
    }
    // It locks itself where P sin <= mu (g + P cos) with 10 g = P cos + T, and the friction of the
    // wall T up to nu P sin: by the floor alone, or not without the wall.
    for mu in [[0.27, 0.2], [0.265, 0.2]] {
        let [place, rate] = wedged::<C>(mu, 1e4);
        assert!(
            place.abs() < 1e-10 && rate.abs() < 1e-12,
            "{place:e} {rate:e}"
        );
    }
    let [place, _] = wedged::<C>([0.265, 0.0], 1.0);
    assert!(place < -1e-4, "{place}");
}

#[test]
fn a_wedge_slides_or_locks_itself_without_creeping() {
    wedge::<Relative>();
    wedge::<Absolute>();
}

/// A crank of 0.3 m at 4 rad/s, without gravity, and a slider on a rod of 1 m.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Engine {
    #[body(mass = 2.0, inertia = [0.05, 0.01, 0.05], position = [0.0, 0.0, 0.3], velocity = [0.0, -1.2, 0.0], angular_velocity = [4.0, 0.0, 0.0])]
    crank: Body,
    #[body(mass = 1.0, inertia = [0.01, 0.01, 0.01], position = [0.0, 1.0, 0.3], velocity = [0.0, -1.2, 0.0])]
    slider: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[joint(between = [ground, slider], point = [0.0, 1.0, 0.3], axis = [0.0, 1.0, 0.0])]
    rail: Prismatic,
    #[joint(between = [crank, slider], head = [0.0, 0.0, 0.3], tail = [0.0, 1.0, 0.3])]
    rod: Distance,
}

fn passes<C: Coordinates<Engine>>() {
    let (engine, h) = (Engine::default(), Engine::HANDLES);
    let start = engine.described_state().expect("it is described");
    let energy = |sample: &View<'_, f64, Engine>| sample.kinetic_energy();
    let (mut way, mut before, mut modes) = (0.0, 0.0, Vec::new());
    let mut lost = [0.0; 2];
    let frictions = [Interaction::friction(h.rail.displacement(), 0.5)];
    let [friction] = Interaction::handles(&frictions);
    Simulation::new(&engine, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .initial_state(start)
        .interactions(frictions)
        .run(0.0..=3.0, every(1e-3), |sample| -> Result<(), Fault> {
            // A known friction takes its capacity times the way of the slider.
            let place = sample.displacement(h.rail);
            way += f64::abs(place - before);
            before = place;
            if sample.time() == 0.0 {
                lost[0] = energy(sample);
            }
            lost[1] = energy(sample);
            let mode = sample.mode(friction)?;
            if modes.last() != Some(&mode) {
                modes.push(mode);
            }
            Ok(())
        })
        .expect("it passes its dead points");
    let found = lost[0] - lost[1];
    assert!((found - 0.5 * way).abs() < 1e-8, "{found} {way}");
    assert!(
        modes.len() > 3 && !modes.contains(&Mode::Sticking),
        "{modes:?}"
    );
}

/// The slider has no freedom at a dead point: its friction turns round there, and does not hold.
#[test]
fn a_slider_passes_its_dead_points() {
    passes::<Relative>();
    passes::<Absolute>();
}

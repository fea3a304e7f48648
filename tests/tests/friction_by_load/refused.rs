//! Settings and joints that are refused, with their names.

use holonom::error::{ModeFault, StartFault};
use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::{Beside, Plane};

use super::Incline;

fn fault<M: Beside<1, 1>>(mechanism: &M, interaction: Interaction<f64, M>) -> Fault {
    let run = Simulation::new(mechanism, StandardLagrange, DormandPrince::default())
        .interactions([interaction])
        .run(0.0..=1.0, every(0.1), |_| ());
    run.map(|_| ()).expect_err("it is refused").fault
}

#[test]
fn settings_are_refused_by_name() {
    let (incline, slide) = (Incline::default(), Incline::HANDLES.slide);
    let by_load = |mu| Interaction::friction_by_load(slide, mu);
    for (interaction, wanted) in [
        (by_load(-0.1), "capacity"),
        (by_load(f64::NAN), "capacity"),
        (by_load(f64::INFINITY), "coefficient"),
        (by_load(0.5).stiction(0.4), "stiction"),
        (by_load(0.5).stiction(f64::INFINITY), "coefficient"),
        (by_load(0.5).guide(0.0), "guide"),
        (by_load(0.5).guide(f64::NAN), "guide"),
    ] {
        let fault = fault(&incline, interaction);
        let is_told = matches!(fault, Fault::Start(StartFault::InteractionSetting { joint: "slide", setting, .. }) if setting == wanted);
        assert!(is_told, "{wanted}: {fault}");
    }
    for (interaction, wanted) in [
        (by_load(0.5).radius(0.1), "radius"),
        (
            Interaction::friction(slide.displacement(), 0.5).guide(0.1),
            "guide",
        ),
        (
            Interaction::friction(slide.displacement(), 0.5).radius(0.1),
            "radius",
        ),
    ] {
        let fault = fault(&incline, interaction);
        let is_told = matches!(fault, Fault::Start(StartFault::MisplacedSetting { joint: "slide", setting }) if setting == wanted);
        assert!(is_told, "{wanted}: {fault}");
    }
}

/// A door on two hinges, of which one would do.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], redundant = "drop")]
struct Door {
    #[body(mass = 20.0, inertia = [3.0, 1.5, 4.0], position = [0.4, 0.0, 1.0])]
    door: Body,
    #[joint(between = [ground, door], point = [0.0, 0.0, 0.2], axis = [0.0, 0.0, 1.0])]
    lower: Revolute,
    #[joint(between = [ground, door], point = [0.0, 0.0, 1.8], axis = [0.0, 0.0, 1.0])]
    upper: Revolute,
}

/// A carriage that slides along x, and a table that moves up and down in it and stands on the
/// floor: on two legs, of which each would do.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Carriage {
    #[body(mass = 2.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 1.0], velocity = [3.0, 0.0, 0.0])]
    carriage: Body,
    #[body(mass = 5.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 0.5], velocity = [3.0, 0.0, 0.0])]
    table: Body,
    #[point(on = table, at = [0.3, 0.0, 0.0])]
    front: Point,
    #[point(on = table, at = [-0.2, 0.0, 0.0])]
    rear: Point,
    #[joint(between = [ground, carriage], point = [0.0, 0.0, 1.0], axis = [1.0, 0.0, 0.0])]
    rail: Prismatic,
    #[joint(between = [carriage, table], point = [0.0, 0.0, 0.5], axis = [0.0, 0.0, 1.0])]
    lift: Prismatic,
}

#[test]
fn a_load_that_is_not_determined_is_refused_by_name() {
    let (door, h) = (Door::default(), Door::HANDLES);
    for (hinge, name) in [(h.lower, "lower"), (h.upper, "upper")] {
        let friction = Interaction::friction_by_load(hinge, 0.2).radius(0.01);
        let fault = fault(&door, friction);
        assert_eq!(fault, Fault::Mode(ModeFault::LoadNotUnique { joint: name }));
    }
    let missing = fault(&door, Interaction::friction_by_load(h.lower, 0.2));
    assert_eq!(
        missing,
        Fault::Mode(ModeFault::LoadNotUnique { joint: "lower" })
    );
}

fn stands<C: Coordinates<Carriage>>() {
    let (carriage, h) = (Carriage::default(), Carriage::HANDLES);
    let floor = Plane::on_ground([0.0; 3], [0.0, 0.0, 1.0]);
    let [front, rear] = [h.front, h.rear].map(|leg| Interaction::contact(leg, floor));
    let friction = Interaction::friction_by_load(h.rail, 0.1);
    let slides = |interactions: [Interaction<f64, Carriage>; 3]| {
        let run = Simulation::new(&carriage, StandardLagrange, DormandPrince::default())
            .coordinates::<C>()
            .interactions(interactions)
            .run(0.0..=1.0, every(0.1), |_| ());
        let state = run.map_err(|error| error.fault)?.state;
        Ok::<f64, Fault>(carriage.view(1.0, &state)?.displacement_rate(h.rail))
    };
    // The moment in the rail is what the legs leave: they may share the weight in any way.
    let refused = slides([friction.guide(0.4), front, rear]);
    assert_eq!(
        refused,
        Err(Fault::Mode(ModeFault::LoadNotUnique { joint: "rail" }))
    );
    // The force in the rail is known all the same: the weight of the carriage.
    let rate = slides([friction, front, rear]).expect("it slides");
    let wanted = 3.0 - 0.1 * 2.0 * 9.81 / 7.0;
    assert!((rate - wanted).abs() < 1e-9, "{rate} {wanted}");
    // On one leg the moment in the rail is known: `5 g 0.3`, and `5 a 0.5` of the deceleration.
    let below = Plane::on_ground([0.0, 0.0, -1.0], [0.0, 0.0, 1.0]);
    let up = Interaction::contact(h.rear, below);
    let rate = slides([friction.guide(0.4), front, up]).expect("it slides");
    // At both ends `g` with half of the moment over 0.4 m: 7 a = 0.1 (3.75 g + 6.25 a).
    let wanted = 3.0 - 0.375 * 9.81 / (7.0 - 0.625);
    assert!((rate - wanted).abs() < 1e-9, "{rate} {wanted}");
}

#[test]
fn a_load_that_depends_on_a_share_is_refused_by_name() {
    stands::<Relative>();
    stands::<Absolute>();
}

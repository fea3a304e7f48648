//! The woodpecker toy: a sleeve with play slips down a pole while the bird on its spring pecks it.
//!
//! Glocker, Dynamik von Starrkoerpersystemen mit Reibung und Stoessen (1995); Leine, Glocker and
//! van Campen, Nonlinear Dynamics of the Woodpecker Toy (ASME DETC 2001): angles are small there,
//! and all gaps and slips linear in the height `y` (m) of the sleeve and the angles (rad) of sleeve
//! and bird. Here points move so, exactly, and together have the masses and the inertias.

mod minimal;

use holonom::prelude::*;
use holonom::run::Plane;

use super::tight;

const GRAVITY: f64 = 9.81;
const SLEEVE_MASS: f64 = 3e-4;
const SLEEVE_INERTIA: f64 = 5e-9;
const BIRD_MASS: f64 = 4.5e-3;
const BIRD_INERTIA: f64 = 7e-7;
const STIFFNESS: f64 = 5.6e-3;
/// Half of the play of the sleeve, and half its height.
const PLAY: f64 = 6e-4;
const HALF_HEIGHT: f64 = 5.8e-3;
const HOLE: f64 = 3.1e-3;
/// Of the spring from the pole, of the bird from the spring, and of the beak from the bird.
const SPRING: f64 = 0.01;
const BIRD: f64 = 0.015;
const BEAK: f64 = -0.0201;
const BEAK_HEIGHT: f64 = 0.02;
/// How far the beak is from the pole where no angle is turned.
const BEAK_GAP: f64 = SPRING + BIRD + BEAK - 2.5e-3;
const FRICTION: f64 = 0.3;
const RESTITUTION: f64 = 0.5;

holonom::joint! {
    /// The point `j` of the toy, which is drawn by `i`: its x and y are the angles of sleeve and
    /// bird, times lengths, and its z is the height.
    pub joint Drawn(
        i, j; sleeve: Number, bird: Number,
        across_sleeve: Number, across_bird: Number, up_sleeve: Number, up_bird: Number
    ) {
        let of_sleeve = dot([1.0, 0.0, 0.0], i.origin) / sleeve;
        let of_bird = dot([0.0, 1.0, 0.0], i.origin) / bird;
        let height = dot([0.0, 0.0, 1.0], i.origin) + up_sleeve * of_sleeve + up_bird * of_bird;
        j.origin - [across_sleeve * of_sleeve + across_bird * of_bird, 0.0, height];
    }
}

/// What each wall of the sleeve has of its mass, and the beak of the bird's; the tail has as much.
const WALL_MASS: f64 = 2e-5;
const BEAK_MASS: f64 = 2e-4;
const TURNING_MASS: f64 = SLEEVE_MASS - 2.0 * WALL_MASS;

#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -GRAVITY])]
struct Woodpecker {
    /// Lengths (m) by which the angles of sleeve and bird are drawn.
    #[param]
    sleeve: f64,
    #[param]
    bird: f64,
    #[body(mass = TURNING_MASS)]
    toy: Particle,
    #[body(mass = WALL_MASS)]
    wall: Particle,
    #[body(mass = WALL_MASS)]
    opposite: Particle,
    #[body(mass = BIRD_MASS - 2.0 * BEAK_MASS)]
    middle: Particle,
    #[body(mass = BEAK_MASS)]
    beak: Particle,
    #[body(mass = BEAK_MASS)]
    tail: Particle,
    #[joint(
        between = [toy, wall], sleeve = sleeve, bird = bird,
        across_sleeve = HALF_HEIGHT, across_bird = 0.0, up_sleeve = HOLE, up_bird = 0.0
    )]
    with_wall: Drawn,
    #[joint(
        between = [toy, opposite], sleeve = sleeve, bird = bird,
        across_sleeve = 0.0, across_bird = 0.0, up_sleeve = -HOLE, up_bird = 0.0
    )]
    with_opposite: Drawn,
    #[joint(
        between = [toy, middle], sleeve = sleeve, bird = bird,
        across_sleeve = 0.0, across_bird = 0.0, up_sleeve = SPRING, up_bird = BIRD
    )]
    with_middle: Drawn,
    #[joint(
        between = [toy, beak], sleeve = sleeve, bird = bird,
        across_sleeve = 0.0, across_bird = -BEAK_HEIGHT, up_sleeve = SPRING, up_bird = BIRD + BEAK
    )]
    with_beak: Drawn,
    #[joint(
        between = [toy, tail], sleeve = sleeve, bird = bird,
        across_sleeve = 0.0, across_bird = 0.0, up_sleeve = SPRING, up_bird = BIRD - BEAK
    )]
    with_tail: Drawn,
}

/// The lengths with which the points have the inertias of sleeve and bird.
fn toy() -> Woodpecker {
    let walls = WALL_MASS * (HALF_HEIGHT * HALF_HEIGHT + 2.0 * HOLE * HOLE);
    let beak_and_tail = BEAK_MASS * (BEAK_HEIGHT * BEAK_HEIGHT + 2.0 * BEAK * BEAK);
    let [sleeve, bird] = [SLEEVE_INERTIA - walls, BIRD_INERTIA - beak_and_tail]
        .map(|left| (left / TURNING_MASS).sqrt());
    Woodpecker::new(sleeve, bird).expect("they are lengths")
}

/// Height and angles, and their rates.
type Motion = [f64; 6];

fn interactions() -> [Interaction<f64, Woodpecker>; 6] {
    let h = Woodpecker::HANDLES;
    let pole = |x: f64, side: f64| {
        Plane::on_ground([x, 0.0, 0.0], [side, 0.0, 0.0]).along([0.0, 0.0, 1.0])
    };
    let [beak, beak_rubs] = Interaction::contact(h.beak, pole(-BEAK_GAP, 1.0))
        .restitution(RESTITUTION)
        .with_plane_friction(FRICTION);
    let [lower, lower_rubs] =
        Interaction::contact(h.wall, pole(-PLAY, 1.0)).with_plane_friction(FRICTION);
    let [upper, upper_rubs] =
        Interaction::contact(h.wall, pole(PLAY, -1.0)).with_plane_friction(FRICTION);
    [beak, beak_rubs, lower, lower_rubs, upper, upper_rubs]
}

fn put(toy: &Woodpecker, motion: &Motion) -> StateOf<Woodpecker> {
    let h = Woodpecker::HANDLES;
    let mut state = toy.described_state().expect("it is described");
    let ends = [
        (h.wall, [HALF_HEIGHT, 0.0, HOLE, 0.0]),
        (h.opposite, [0.0, 0.0, -HOLE, 0.0]),
        (h.middle, [0.0, 0.0, SPRING, BIRD]),
        (h.beak, [0.0, -BEAK_HEIGHT, SPRING, BIRD + BEAK]),
        (h.tail, [0.0, 0.0, SPRING, BIRD - BEAK]),
    ];
    let [drawn, rates] = [&motion[..3], &motion[3..]].map(|q| [q[0], q[1], q[2]]);
    let (sleeve, bird) = (toy.sleeve, toy.bird);
    let master = |[y, m, s]: [f64; 3]| [sleeve * m, bird * s, y];
    let mut set = |body, position: [f64; 3], velocity: [f64; 3]| {
        let mut pose = toy.view(0.0, &state).expect("a view").pose(body);
        pose.position = position.into();
        Woodpecker::set_pose(&mut state, body, pose);
        Woodpecker::set_velocity(&mut state, body, velocity.into());
    };
    set(h.toy, master(drawn), master(rates));
    for (body, [a, b, c, d]) in ends {
        let place = |[y, m, s]: [f64; 3]| [a * m + b * s, 0.0, y + c * m + d * s];
        set(body, place(drawn), place(rates));
    }
    state
}

/// The state of the limit cycle that Glocker gives, while the sleeve slips on its lower edge.
const GLOCKER: Motion = [0.0, -PLAY / HALF_HEIGHT, -0.2788, -0.3411, 0.0, -7.4583];
const SLIPS: minimal::Closed = Some((1, minimal::Way::Slips(-1.0)));

/// A peck of the limit cycle, to eight digits: where 130 cycles from that state lead to.
const PECK: Motion = [0.0, 0.089403853, 0.12, -0.093775192, 22.8785033, -8.4555887];

/// What the library finds from a state in which the sleeve slips or is free: the instants of all
/// changes, and the motion at the end.
fn found(start: &Motion, end: f64) -> (Vec<f64>, Motion) {
    let (toy, h) = (toy(), Woodpecker::HANDLES);
    let interactions = interactions();
    let handles = Interaction::handles(&interactions);
    let (sleeve, bird) = (toy.sleeve, toy.bird);
    let (mut instants, mut modes) = (Vec::new(), None);
    let report = toy
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .initial_state(put(&toy, start))
        .interactions(interactions)
        .forces(move |_, _, loads| {
            let place = loads.view().position(h.toy);
            let twist = STIFFNESS * (place.x / sleeve - place.y / bird);
            loads.force(h.toy, [-twist / sleeve, twist / bird, 0.0]);
        })
        .run(0.0..=end, every(end), |sample| -> Result<(), Fault> {
            let now = handles.map(|handle| sample.mode(handle));
            let peck = sample.impact(handles[0])?;
            let has_pecked = peck.is_some_and(|peck| peck.time == sample.time());
            let is_new = instants.last() != Some(&sample.time());
            if is_new && (has_pecked || modes.is_some_and(|modes| modes != now)) {
                instants.push(sample.time());
            }
            modes = Some(now);
            Ok(())
        })
        .expect("it pecks");
    let view = toy.view(end, &report.state).expect("a view");
    let (place, rate) = (view.position(h.toy), view.velocity(h.toy));
    let motion = [
        place.z,
        place.x / sleeve,
        place.y / bird,
        rate.z,
        rate.x / sleeve,
        rate.y / bird,
    ];
    (instants, motion)
}

fn assert_near(found: &Motion, wanted: &Motion, bounds: [f64; 2]) {
    for ((&found, &wanted), bound) in found
        .iter()
        .zip(wanted)
        .zip([[bounds[0]; 3], [bounds[1]; 3]].concat())
    {
        assert!((found - wanted).abs() < bound, "{found} {wanted}");
    }
}

#[test]
fn a_woodpecker_goes_down_its_pole() {
    let mut wanted = Vec::new();
    let (end, _) = minimal::run((GLOCKER, SLIPS), 0.45, |time, _| wanted.push(time));
    let (instants, motion) = found(&GLOCKER, 0.45);
    assert_eq!(instants.len(), wanted.len());
    for (found, wanted) in instants.iter().zip(&wanted) {
        assert!((found - wanted).abs() < 1e-10, "{found} {wanted}");
    }
    assert_near(&motion, &end, [1e-9, 1e-7]);
}

/// A cycle is 0.84 times as far from the limit cycle as the one before.
#[test]
fn it_does_so_in_glockers_limit_cycle() {
    // From one peck to the next.
    let mut pecks = [(0.0, [0.0; 6]); 2];
    minimal::run((PECK, None), 6.0, |time, motion| {
        if motion[2] > 0.999 * BEAK_GAP / BEAK_HEIGHT {
            pecks = [pecks[1], (time, *motion)];
        }
    });
    let [(before, first), (last, second)] = pecks;
    let (period, falls) = (last - before, first[0] - second[0]);
    let (start, _) = minimal::run((first, None), 0.02, |_, _| ());
    let (_, mut motion) = found(&start, period);
    motion[0] += falls;
    assert_near(&motion, &start, [1e-10, 1e-8]);
    assert!((period - 0.145976).abs() < 1e-6 && (falls - 0.019445).abs() < 1e-6);

    // It passes near where Glocker saw it, with lengths that are given to two digits.
    let mut next = (start, None);
    while next.0[2] > GLOCKER[2] {
        next = minimal::run(next, 1e-5, |_, _| ());
    }
    let ([_, sleeve, _, down, _, bird], closed) = next;
    assert_eq!(closed, SLIPS);
    assert!((sleeve - GLOCKER[1]).abs() < 1e-12);
    assert!((down / GLOCKER[3] - 1.0).abs() < 5e-3, "{down}");
    assert!((bird / GLOCKER[5] - 1.0).abs() < 1e-3, "{bird}");
}

//! What a page computes is what a stepper computes, to the last bit; what is refused leaves
//! everything as it was.
//!
//! `HOLONOM_POSES=folder` also writes the poses that `.ci/live` compares with those of a browser.

#[path = "../examples/linkage/mod.rs"]
mod linkage;

use std::error::Error;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::{env, fs};

use holonom::BodyHandle;
use holonom::dynamics::Solvable;
use holonom::error::ParameterFault;
use holonom::nalgebra::Vector3;
use holonom::prelude::*;
use holonom::run::Steps;
use holonom_live::{Live, LiveError, Refused, Session};
use holonom_live_border::Session as _;
use holonom_models::{CartPole, Ur5};
use linkage::FourBar;
use serde_json::Value;

const STEP: f64 = 1e-3;

/// Positions and Euler parameters of all bodies.
fn poses<M: Mechanism>(bodies: &StateOf<M>) -> Vec<f64> {
    let pose = |body| M::pose::<f64>(bodies, BodyHandle::new(body));
    let numbers = (0..M::REPORT.bodies.len()).map(pose).flat_map(|pose| {
        let [i, j, k, w] = pose.orientation.coords.into();
        let [x, y, z] = pose.position.into();
        [x, y, z, w, i, j, k]
    });
    numbers.collect()
}

/// The poses as a page reads them.
fn of_page<M, P, K>(session: &Session<M, P, K>) -> Vec<f64>
where
    M: Mechanism,
    P: Solvable<Number = f64, Mechanism = M, Forces: Clone>,
    K: Steps<P> + Copy,
{
    let mut numbers = Vec::new();
    session.numbers(&mut numbers);
    let first = 2 + session.values().len();
    numbers[first..first + 7 * M::REPORT.bodies.len()].to_vec()
}

/// A stepper as pages have it where nothing else is said.
fn stepper<M: Mechanism>(of: &M) -> Result<Stepper<Problem<M, StandardLagrange>, Rk4>, Fault>
where
    Rk4: Steps<Problem<M, StandardLagrange>>,
{
    Ok(of
        .stepper(StandardLagrange, Rk4)?
        .projection(Projection::default()))
}

/// Writes poses for the browser.
fn write(name: &str, stages: &[Vec<f64>]) {
    let Some(folder) = env::var_os("HOLONOM_POSES") else {
        return;
    };
    let mut text = String::new();
    for stage in stages {
        for number in stage {
            let _ = write!(text, "{:016x}", number.to_bits());
        }
        text.push('\n');
    }
    fs::write(PathBuf::from(folder).join(name), text).expect("a folder");
}

#[test]
fn a_four_bar_runs_as_a_stepper_does_under_all_sliders() -> Result<(), Box<dyn Error>> {
    let mut session = linkage::live(FourBar::default()).session()?;
    let mut four_bar = FourBar::default();
    let h = FourBar::HANDLES;
    let mut stages = Vec::new();

    // As it is described, but closed.
    let mut plain = stepper(&four_bar)?;
    let mut state = four_bar.described_state()?;
    four_bar.assemble(0.0, &mut state)?;
    session.advance(300)?;
    for _ in 0..300 {
        plain.step(&mut state, STEP)?;
    }
    assert_eq!(of_page(&session), poses::<FourBar>(&state));
    stages.push(of_page(&session));

    // A length, in parts of a twentieth of its range, 0.3 m.
    session.set(0, 0.3)?;
    let parts = 4.0;
    for part in 1..=4 {
        four_bar.crank = if part < 4 {
            0.25 + f64::from(part) / parts * (0.3 - 0.25)
        } else {
            0.3
        };
        plain.update(&four_bar)?;
        let open = state;
        four_bar.assemble_from(plain.time(), &mut state, &open)?;
    }
    assert_eq!(of_page(&session), poses::<FourBar>(&state), "moved");
    let view = four_bar.view(session.time(), &state)?;
    assert!(view.violation() < 1e-20 && view.velocity_violation() < 1e-20);
    session.advance(200)?;
    for _ in 0..200 {
        plain.step(&mut state, STEP)?;
    }
    assert_eq!(of_page(&session), poses::<FourBar>(&state), "run on");
    stages.push(of_page(&session));

    // An input.
    session.set(5, 2.0)?;
    four_bar.torque = 2.0;
    plain.update(&four_bar)?;
    session.advance(500)?;
    for _ in 0..500 {
        plain.step(&mut state, STEP)?;
    }
    assert_eq!(of_page(&session), poses::<FourBar>(&state), "turned");
    stages.push(of_page(&session));

    // A start.
    session.set(6, 1.0)?;
    let mut plain = stepper(&four_bar)?;
    let mut state = four_bar.described_state()?;
    four_bar.set_angle(&mut state, h.bearing, 1.0)?;
    four_bar.assemble(0.0, &mut state)?;
    assert_eq!(session.time(), 0.0);
    let angle: f64 = four_bar.view(0.0, &state)?.angle(h.bearing);
    assert!((angle - 1.0).abs() < 1e-9);
    session.advance(400)?;
    for _ in 0..400 {
        plain.step(&mut state, STEP)?;
    }
    assert_eq!(of_page(&session), poses::<FourBar>(&state), "begun anew");
    assert_eq!(session.time(), plain.time());
    stages.push(of_page(&session));
    write("four-bar.poses", &stages);
    Ok(())
}

#[test]
fn an_arm_in_joint_coordinates_runs_as_its_stepper_does() -> Result<(), Box<dyn Error>> {
    let h = Ur5::HANDLES;
    let build = |of: &Ur5| Ok(of.stepper(StandardLagrange, Rk4)?.joint_coordinates());
    let mut session = Live::new(Ur5::default())
        .stepper(build)
        .step(2e-3)
        .slider(|of| &mut of.elbow_torque, "N m", -50.0..=50.0)
        .start_angle(h.lift, ..)
        .session()?;
    let mut arm = Ur5::default();
    let mut plain = build(&arm)?;
    let mut state = plain.initial_state()?;
    session.advance(50)?;
    session.set(0, 10.0)?;
    session.advance(450)?;
    for step in 0..500 {
        if step == 50 {
            arm.elbow_torque = 10.0;
            plain.update(&arm)?;
        }
        plain.step(&mut state, 2e-3)?;
    }
    assert_eq!(of_page(&session), poses::<Ur5>(&plain.bodies(&state)));
    assert_eq!(session.values(), [10.0, 0.0]);
    Ok(())
}

#[test]
fn poses_of_an_arm_are_written_for_the_browser() -> Result<(), Box<dyn Error>> {
    let mut arm = Ur5::default();
    let mut plain = stepper(&arm)?;
    let mut state = plain.initial_state()?;
    let mut stages = Vec::new();
    for torque in [0.0, 10.0] {
        arm.elbow_torque = torque;
        plain.update(&arm)?;
        for _ in 0..500 {
            plain.step(&mut state, STEP)?;
        }
        stages.push(poses::<Ur5>(&plain.bodies(&state)));
    }
    assert!(stages[0] != stages[1] && stages[1].iter().all(|x| x.is_finite()));
    write("ur5.poses", &stages);
    Ok(())
}

/// A rod that turns at 20 rad/s. A length under a slider and many turns are in no fixture.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Spinner {
    #[param(like = 1.0)]
    length: f64,
    #[param(like = 2.0)]
    mass: f64,
    #[body(
        mass = mass,
        inertia = [0.01, 0.01, 0.01],
        position = [0.0, 0.5 * length, 0.0],
        velocity = [0.0, 0.0, 10.0 * length],
        angular_velocity = [20.0, 0.0, 0.0]
    )]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
}

#[test]
fn turns_are_kept_where_a_length_changes_in_both_coordinates() -> Result<(), Box<dyn Error>> {
    fn check<P>(live: Live<Spinner, P, Rk4>, keeps_rate: bool) -> Result<(), Box<dyn Error>>
    where
        P: Solvable<Number = f64, Mechanism = Spinner, Forces: Clone>,
        Rk4: Steps<P>,
    {
        let h = Spinner::HANDLES;
        let mut session = live
            .slider(|of| &mut of.length, "m", 0.5..=2.0)
            .slider(|of| &mut of.mass, "kg", ..)
            .session()?;
        session.advance(1000)?;
        let read = |session: &Session<Spinner, P, Rk4>| -> Result<[f64; 3], Fault> {
            let bodies = session.bodies();
            let view = session.mechanism().view(session.time(), &bodies)?;
            let far = view.position(h.rod).norm();
            Ok([view.angle(h.hinge), view.angle_rate(h.hinge), far])
        };
        let [angle, rate, _] = read(&session)?;
        assert!((angle - 20.0).abs() < 1e-6 && (rate - 20.0).abs() < 1e-9);
        // A mass changes no state, to the last bit.
        let before = of_page(&session);
        session.set(1, 3.5)?;
        assert_eq!(of_page(&session), before);
        session.set(0, 1.7)?;
        let [after, faster, far] = read(&session)?;
        assert!((after - angle).abs() < 1e-9, "{after} rad");
        assert!((far - 0.85).abs() < 1e-12, "{far} m");
        assert_eq!((faster - rate).abs() < 1e-9, keeps_rate, "{faster} rad/s");
        Ok(())
    }
    let live = || Live::new(Spinner::default());
    check(live(), false)?;
    let relative = |of: &Spinner| Ok(of.stepper(StandardLagrange, Rk4)?.joint_coordinates());
    check(live().stepper(relative), true)
}

#[test]
fn what_is_refused_leaves_everything_as_it_was() -> Result<(), Box<dyn Error>> {
    let mut session = linkage::live(FourBar::default()).session()?;
    session.advance(100)?;
    let (before, values) = (of_page(&session), session.values().to_vec());
    // The links do not reach over the base, wherever they are.
    let refused = session.set(3, 2.5).expect_err("out of reach");
    let Refused::Value { name, fault, .. } = &refused else {
        panic!("{refused}");
    };
    assert_eq!(name, "base");
    assert!(refused.to_string().starts_with("base = 2.5: "), "{refused}");
    assert!(
        matches!(fault, Fault::Parameter(error)
            if matches!(error.fault, ParameterFault::NotAssembled { .. })),
        "{fault}"
    );
    assert!(matches!(
        session.set(1, f64::NAN),
        Err(Refused::NotFinite { .. })
    ));
    assert!(matches!(
        session.set(9, 0.0),
        Err(Refused::NoSlider {
            place: 9,
            sliders: 7
        })
    ));
    assert_eq!((of_page(&session), session.values()), (before, &*values));
    // And the run goes on as if nobody had asked.
    let mut other = linkage::live(FourBar::default()).session()?;
    other.advance(100)?;
    for of in [&mut session, &mut other] {
        of.advance(50)?;
    }
    assert_eq!(of_page(&session), of_page(&other));
    Ok(())
}

/// Whether a four-bar of these lengths (crank, coupler, rocker, base) has a crank that turns over:
/// then coupler and rocker are never in line (Grashof), and the sides are two branches.
fn turns_over([crank, coupler, rocker, base]: [f64; 4]) -> bool {
    let longest = coupler.max(rocker).max(base);
    let others = coupler + rocker + base - longest;
    crank < coupler.min(rocker).min(base) && crank + longest < 0.999 * others
}

/// Moves of all lengths while it runs. A move that is accepted leaves the loop closed and on its
/// branch, where there are two; one that is refused leaves everything as it was.
#[test]
fn lengths_move_at_random_and_the_loop_stays_closed() -> Result<(), Box<dyn Error>> {
    let h = FourBar::HANDLES;
    let mut session = linkage::live(FourBar::default()).session()?;
    // Between the ends of both links at the knee (m), and on which side the rocker is.
    let knee = |session: &Session<FourBar, _, _>| -> Result<(f64, f64), Fault> {
        let (of, bodies) = (session.mechanism(), session.bodies());
        let view = of.view(session.time(), &bodies)?;
        let end = |body, far| view.point(body, Vector3::new(far, 0.0, 0.0));
        let (coupler, rocker) = (0.5 * of.coupler, 0.5 * of.rocker);
        let [a, b] = [end(h.coupler_link, coupler), end(h.rocker_link, rocker)];
        let along = a - end(h.coupler_link, -coupler);
        let back = end(h.rocker_link, -rocker) - b;
        Ok(((a - b).norm(), along.cross(&back).z))
    };
    let mut seed = 1_u32;
    let mut random = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed >> 8) / f64::from(1_u32 << 24)
    };
    // Some do not reach.
    let ends = [[0.1, 0.6], [0.5, 1.2], [0.3, 0.9], [0.4, 1.7]];
    let lengths = |of: &FourBar| [of.crank, of.coupler, of.rocker, of.base];
    let (mut moved, mut refused, mut branches) = (0, 0, 0);
    for _ in 0..200 {
        let place = (4.0 * random()) as usize;
        let [low, high] = ends[place];
        let (before, (_, side)) = (of_page(&session), knee(&session)?);
        let (old, value) = (lengths(session.mechanism()), low + random() * (high - low));
        match session.set(place, value) {
            Ok(()) => {
                moved += 1;
                let (open, now) = knee(&session)?;
                assert!(open < 1e-9, "{open} m at {} s", session.time());
                let has_branches = (0..=20).all(|part| {
                    let mut on_the_way = old;
                    on_the_way[place] += 0.05 * f64::from(part) * (value - old[place]);
                    turns_over(on_the_way)
                });
                branches += usize::from(has_branches);
                assert!(
                    !has_branches || now * side > 0.0,
                    "{old:?}: {side} m2, {now} m2"
                );
            }
            Err(_) => {
                refused += 1;
                assert_eq!(of_page(&session), before);
            }
        }
        if session.advance(40).is_err() {
            session.restart()?;
        }
    }
    let seen = [moved, refused, branches];
    assert!(seen.iter().all(|&count| count > 5), "{seen:?}");
    Ok(())
}

#[test]
fn a_fault_keeps_the_last_good_state() -> Result<(), Box<dyn Error>> {
    let mut session = Live::new(CartPole::default())
        .slider(|of| &mut of.push, "N", ..)
        .session()?;
    session.advance(10)?;
    let (before, time) = (of_page(&session), session.time());
    session.set(0, 1e308)?;
    let fault = session.advance(5).expect_err("beyond the range of numbers");
    assert!(matches!(fault, Fault::Step(_)), "{fault}");
    assert_eq!((of_page(&session), session.time()), (before, time));
    session.set(0, 0.0)?;
    session.advance(5)?;
    assert!((session.time() - 0.015).abs() < 1e-15);
    Ok(())
}

#[test]
fn sliders_have_the_names_of_fields_and_ranges_by_a_rule() -> Result<(), Box<dyn Error>> {
    let session = linkage::live(FourBar::default()).session()?;
    let controls: Value = serde_json::from_str(&session.controls())?;
    assert_eq!(controls["step"], STEP);
    let sliders = controls["sliders"].as_array().expect("a list");
    let said = |place: usize| {
        let slider = &sliders[place];
        let text = |key: &str| slider[key].as_str().expect("a text").to_owned();
        let end = |key: &str| slider[key].as_f64().expect("a number");
        (
            text("group"),
            text("name"),
            text("unit"),
            end("low"),
            end("high"),
        )
    };
    let of = |group: &str, name: &str, unit: &str, low, high| {
        (
            group.to_owned(),
            name.to_owned(),
            unit.to_owned(),
            low,
            high,
        )
    };
    assert_eq!(said(0), of("Parameters", "crank", "m", 0.1, 0.4));
    assert_eq!(said(4), of("Parameters", "stiffness", "N/m", 0.0, 120.0));
    assert_eq!(said(5), of("Inputs", "torque", "N m", -5.0, 5.0));
    let (group, name, unit, low, high) = said(6);
    assert_eq!((&*group, &*name, &*unit), ("Start", "bearing", "rad"));
    let start = session.values()[6];
    assert!(start.abs() > 1e-3, "the loop turns it as it is closed");
    let half = std::f64::consts::PI;
    assert_eq!((low, high), (start - half, start + half));

    // What is drawn follows the lengths.
    let mut session = session;
    let scene = |session: &Session<FourBar, _, _>| -> Result<Value, Box<dyn Error>> {
        Ok(serde_json::from_str(&session.scene()?)?)
    };
    let length = |scene: &Value| scene["shapes"][0]["sizes"][0].as_f64();
    assert_eq!(length(&scene(&session)?), Some(0.25));
    session.set(0, 0.35)?;
    assert_eq!(length(&scene(&session)?), Some(0.35));
    Ok(())
}

#[test]
fn settings_that_are_none_are_refused() {
    let cart = || Live::new(CartPole::default());
    let fault = |live: Live<CartPole>| live.session().err().expect("refused").to_string();
    let force = |live: Live<CartPole>| live.slider(|of| &mut of.push, "N", ..);
    assert!(fault(cart().step(0.0)).contains("positive"));
    assert!(fault(cart().named("pull")).contains("there is none"));
    assert!(fault(force(force(cart()))).contains("two sliders are called `push`"));
    assert!(force(force(cart()).named("pull")).session().is_ok());
    let ends = cart().slider(|of| &mut of.push, "N", 1.0..=-1.0);
    assert!(matches!(
        ends.session(),
        Err(LiveError::Range {
            low: 1.0,
            high: -1.0,
            ..
        })
    ));
}

/// A page has its module, without what is not run, and the film of its first seconds.
#[test]
fn a_page_has_a_module_and_a_film() -> Result<(), Box<dyn Error>> {
    let file = env::temp_dir().join(format!("holonom-live-{}.html", std::process::id()));
    let live = || linkage::live(FourBar::default()).preview(0.6);
    let head = b"\0asm\x01\0\0\0";
    // A section of exports, and one of names.
    let module = [head, &b"\x07\x0fholonom_advance"[..], b"\x00\x02ab"].concat();
    live().page_with(&file, &module)?;
    let page = fs::read_to_string(&file)?;
    fs::remove_file(&file)?;
    let between = |start: &str| {
        let (_, behind) = page.split_once(start).expect(start);
        behind.split_once("</script>").expect("it ends").0
    };
    let program = between("id=\"live\">");
    assert_eq!(program, "AGFzbQEAAAAHD2hvbG9ub21fYWR2YW5jZQ==");
    let film: Value = serde_json::from_str(between("id=\"film\">"))?;
    assert_eq!(film["title"], "A four-bar");
    let times = film["times"].as_array().expect("frames");
    let last = times.last().and_then(Value::as_f64).expect("a time");
    assert!(times.len() == 121 && (last - 0.6).abs() < 1e-12, "{last} s");
    assert_eq!(film["readings"].as_array().map(Vec::len), Some(4));
    let refused = live().page_with(&file, head);
    assert!(matches!(refused, Err(LiveError::NoModule)) && !file.exists());
    Ok(())
}

/// Steps that are too long for a stiff spring are noticed, and shorter ones are not.
#[test]
fn steps_that_are_too_long_are_noticed() -> Result<(), Box<dyn Error>> {
    for (step, is_wrong) in [(1e-3, false), (5e-3, true)] {
        let mut session = linkage::live(FourBar::default()).step(step).session()?;
        session.set(4, 2e4)?;
        for _ in 0..40 {
            session.advance(1)?;
        }
        let error = session.error();
        assert_eq!(error > 0.01, is_wrong, "{step} s: {error}");
        session.restart()?;
        assert_eq!(session.error(), 0.0, "nothing is known of a new run");
    }
    Ok(())
}

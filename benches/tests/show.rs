//! `study show` films what the other studies measure.

use holonom_benches::show::{first, scene, scenes};
use holonom_benches::trade;

#[test]
fn every_problem_can_be_shown() {
    let shown: Vec<&str> = scenes().iter().map(|scene| scene.name).collect();
    for name in trade::names() {
        assert!(shown.contains(&name.as_str()), "{name} beside {shown:?}");
    }
    let refused = scene("no such").expect_err("no problem");
    assert!(refused.contains("four-bar, pendulum"), "{refused}");
}

/// What a reader sees first is well: it moves, and nothing is warned about.
#[test]
fn what_is_shown_first_has_no_warnings() {
    for scene in first() {
        let film = scene.record(scene.seconds).expect(scene.name);
        assert_eq!(film.warnings, "no warnings", "{}", scene.name);
    }
}

#[test]
fn a_film_has_the_title_and_the_readings_of_its_problem() {
    let scene = scene("four-bar").expect("the default");
    let film = scene.record(0.5).expect("a run");
    assert_eq!(film.frames, 361);
    for part in ["\"title\":\"Four-bar\"", "left foot", "kinetic energy"] {
        assert!(film.html.contains(part), "{part}");
    }
    // Its links lie on one line after 0.708 s, not before.
    assert_eq!(film.warnings, "no warnings");
}

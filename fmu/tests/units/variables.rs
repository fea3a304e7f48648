//! What a description says of the variables of a mechanism.

use crate::unit::{Unit, attributes, elements, variable};
use holonom::mechanism::{Absolute, Relative};
use holonom::prelude::*;
use holonom_fmu::{Fmu, FmuExt as _};
use holonom_models::{CartPole, FourBar};

/// A pendulum with a parameter, and texts that a document has to escape.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Pendulum {
    #[param]
    damping: f64,
    #[input]
    torque: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.001, 0.1], position = [0.0, 0.5, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[force(
        between = [ground, rod],
        axis = [1.0, 0.0, 0.0],
        moment = torque - damping * rate
    )]
    motor: TorsionalActuator,
}

#[test]
fn a_pendulum_has_its_parameters_inputs_states_and_readings() {
    let pendulum = Pendulum::new(0.25).expect("described");
    let unit = pendulum
        .fmu(StandardLagrange)
        .description("a rod & a <motor>")
        .about("damping", "torque for a rate (N m s/rad)")
        .about("torque", "torque of the \"motor\" (N m)")
        .reading("height", "height of the rod (m)", |view| {
            view.position(Pendulum::HANDLES.rod).z
        });
    let unit = Unit::of(unit, "pendulum.fmu");
    let document = unit.description();
    let root = document.root_element();
    assert_eq!(root.attribute("fmiVersion"), Some("3.0"));
    assert_eq!(root.attribute("modelName"), Some("Pendulum"));
    assert_eq!(root.attribute("description"), Some("a rod & a <motor>"));
    for (name, expected) in [
        (
            "time",
            r#"name="time" valueReference="0" description="time (s)" causality="independent" variability="continuous" unit="s""#,
        ),
        (
            "hinge_angle",
            r#"name="hinge_angle" valueReference="1" description="angle of hinge (rad)" causality="output" variability="continuous" initial="exact" unit="rad" start="0.0""#,
        ),
        (
            "der(hinge_angle)",
            r#"name="der(hinge_angle)" valueReference="3" description="rate of the angle of hinge (rad/s)" causality="local" variability="continuous" initial="calculated" unit="rad/s" derivative="1""#,
        ),
        (
            "der(hinge_rate)",
            r#"name="der(hinge_rate)" valueReference="4" description="its rate (rad/s^2)" causality="local" variability="continuous" initial="calculated" unit="rad/s2" derivative="2""#,
        ),
        (
            "damping",
            r#"name="damping" valueReference="5" description="torque for a rate (N m s/rad)" causality="parameter" variability="tunable" initial="exact" unit="N.m.s/rad" start="0.25""#,
        ),
        (
            "torque",
            r#"name="torque" valueReference="6" description="torque of the \"motor\" (N m)" causality="input" variability="continuous" unit="N.m" start="0.0""#,
        ),
        (
            "height",
            r#"name="height" valueReference="7" description="height of the rod (m)" causality="output" variability="continuous" initial="calculated" unit="m""#,
        ),
    ] {
        assert_eq!(attributes(variable(&document, name)), expected);
    }
    let texts = |name: &str| {
        let elements = elements(&document, name).into_iter();
        elements.map(attributes).collect::<Vec<_>>()
    };
    assert_eq!(
        texts("Output"),
        [
            r#"valueReference="1" dependencies="1" dependenciesKind="constant""#,
            r#"valueReference="2" dependencies="2" dependenciesKind="constant""#,
            r#"valueReference="7""#,
        ]
    );
    let derivatives = [r#"valueReference="3""#, r#"valueReference="4""#];
    assert_eq!(texts("ContinuousStateDerivative"), derivatives);
    let unknowns = [derivatives[0], derivatives[1], r#"valueReference="7""#];
    assert_eq!(texts("InitialUnknown"), unknowns);
    assert!(texts("CoSimulation")[0].contains(r#"fixedInternalStepSize="0.001""#));
    assert!(texts("ModelExchange")[0].contains(r#"providesDirectionalDerivatives="true""#));
    assert!(texts("BaseUnit").contains(&r#"kg="1" m="2" s="-1" rad="-1""#.to_owned()));
}

#[test]
fn states_begin_where_a_run_begins() {
    let bars = FourBar::default();
    let stepper = bars.stepper(StandardLagrange, Rk4).expect("described");
    let state = stepper.initial_state().expect("described");
    let view = stepper.view(&state);
    let unit = Fmu::<FourBar, Relative>::new(&bars, Baumgarte::default());
    let unit = Unit::of(unit.named("bars").without_binary(), "bars.fmu");
    let document = unit.description();
    let start = |name: &str| -> f64 {
        let start = variable(&document, name).attribute("start");
        start.and_then(|text| text.parse().ok()).expect("a number")
    };
    let handles = FourBar::HANDLES;
    for (name, expected) in [
        ("left_foot_angle", view.angle(handles.left_foot)),
        ("left_foot_rate", view.angle_rate(handles.left_foot)),
        ("left_pin_rate", view.angle_rate(handles.left_pin)),
        ("right_foot_rate", view.angle_rate(handles.right_foot)),
    ] {
        assert!((start(name) - expected).abs() < 1e-14, "{name}");
    }
}

#[test]
fn a_state_of_bodies_has_a_variable_for_each_number() {
    let unit = Fmu::<CartPole, Absolute>::new(&CartPole::default(), StandardLagrange);
    let unit = Unit::of(unit.named("bodies").without_binary(), "bodies.fmu");
    let document = unit.description();
    let derivatives = elements(&document, "ContinuousStateDerivative");
    // Three coordinates, four Euler parameters and six velocities of each body, and an angle.
    assert!(derivatives.len() >= 26, "{}", derivatives.len());
    let quaternion = variable(&document, "pole_e0");
    assert_eq!(
        quaternion.attribute("start"),
        Some(format!("{:?}", 0.05_f64.cos()).as_str())
    );
}

#[test]
fn the_same_unit_has_the_same_bytes_and_its_sources() {
    let unit = |name: &str| {
        let unit = Fmu::<CartPole, Relative>::new(&CartPole::default(), StandardLagrange);
        Unit::of(unit.without_binary(), name)
    };
    let (one, other) = (unit("one.fmu"), unit("other.fmu"));
    assert_eq!(one.files, other.files);
    assert_eq!(one.written.platform, None);
    let names: Vec<&str> = one.files.keys().map(String::as_str).collect();
    assert_eq!(
        names,
        [
            "modelDescription.xml",
            "sources/buildDescription.xml",
            "sources/cart_pole.c",
            "sources/cart_pole.h",
            "sources/fmi3FunctionTypes.h",
            "sources/fmi3Functions.h",
            "sources/fmi3PlatformTypes.h",
            "sources/fmi3_absent.c",
            "sources/fmi3_events.h",
            "sources/fmi3_functions.c",
            "sources/fmi3_mechanism.h",
            "sources/fmi3_model.h",
        ]
    );
    let document = one.description();
    let token = document.root_element().attribute("instantiationToken");
    let header = one.text("sources/fmi3_model.h");
    assert!(header.contains(token.expect("a token")));
    let build = roxmltree::Document::parse(one.text("sources/buildDescription.xml"));
    let build = build.expect("a document");
    let sources = elements(&build, "SourceFile").into_iter();
    let sources: Vec<_> = sources.filter_map(|file| file.attribute("name")).collect();
    assert_eq!(
        sources,
        ["cart_pole.c", "fmi3_absent.c", "fmi3_functions.c"]
    );
}

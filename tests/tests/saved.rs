//! What is written to files and read from them: states by name, poses, wrenches and angles, bit for
//! bit; reports and warnings, which are only written. What is refused, word for word.

#![forbid(unsafe_code)]

use holonom::measure::{EulerAngles, NamedState};
use holonom::prelude::*;
use holonom::{KinematicReport, Pose, Wrench};
use nalgebra::{Quaternion, Vector3};
use rand::{Rng, RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;
use serde::{Serialize, de::DeserializeOwned};
use serde_json::{Value, from_str, from_value, json, to_string, to_value};

/// A nut on a screw, a wound wheel, two links of an array and a point: what a state can hold.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Workshop {
    #[body(mass = 0.2, inertia = [[0.08, 0.01, 0.0], [0.01, 0.09, 0.02], [0.0, 0.02, 0.12]])]
    nut: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.2], position = [1.0, 0.0, 0.0])]
    wheel: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.2], position = [2.0 + k, 0.0, 0.0], free)]
    links: [Body; 2],
    #[body(mass = 1.0, position = [5.0, 0.0, 0.0], free)]
    point: Particle,
    #[joint(between = [ground, nut], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0], pitch = 0.01)]
    screw: Screw,
    #[joint(between = [ground, wheel], point = [1.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[force(between = [ground, wheel], axis = [0.0, 0.0, 1.0], stiffness = 2.0)]
    spring: TorsionalSpringDamper,
}

/// The same fields in another order.
mod reordered {
    use holonom::prelude::*;

    #[derive(Mechanism)]
    #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
    pub(crate) struct Workshop {
        #[body(mass = 1.0, position = [5.0, 0.0, 0.0], free)]
        point: Particle,
        #[body(mass = 1.0, inertia = [0.1, 0.1, 0.2], position = [2.0 + k, 0.0, 0.0], free)]
        links: [Body; 2],
        #[body(mass = 1.0, inertia = [0.1, 0.1, 0.2], position = [1.0, 0.0, 0.0])]
        wheel: Body,
        #[body(mass = 0.2, inertia = [[0.08, 0.01, 0.0], [0.01, 0.09, 0.02], [0.0, 0.02, 0.12]])]
        nut: Body,
        #[joint(between = [ground, wheel], point = [1.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
        bearing: Revolute,
        #[joint(between = [ground, nut], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0], pitch = 0.01)]
        screw: Screw,
        #[force(between = [ground, wheel], axis = [0.0, 0.0, 1.0], stiffness = 2.0)]
        spring: TorsionalSpringDamper,
    }
}

/// The same names, but the wheel has another inertia.
mod reshaped {
    use holonom::prelude::*;

    #[derive(Mechanism)]
    pub(crate) struct Workshop {
        #[body(mass = 1.0, inertia = [[0.1, 0.02, 0.0], [0.02, 0.1, 0.0], [0.0, 0.0, 0.2]], free)]
        wheel: Body,
    }
}

/// Another name.
#[derive(Mechanism)]
struct Store {
    #[body(mass = 1.0, free)]
    point: Particle,
}

type Named = NamedState<Workshop>;

/// Numbers of all sizes, which are no state of a mechanism that moves.
fn random(rng: &mut impl Rng) -> Named {
    let mut state = Workshop::default()
        .described_state::<f64>()
        .expect("described");
    let mut number = || {
        let size: f64 = rng.random_range(-200.0..200.0);
        rng.random_range(-1.0..1.0) * size.exp()
    };
    state.coordinates_mut().fill_with(&mut number);
    state.velocities_mut().fill_with(&mut number);
    state.velocities_mut()[0] = -0.0;
    state.coordinates_mut()[0] = 5e-324;
    Named::new(number(), state)
}

fn bits(named: &Named) -> Vec<u64> {
    let state = &named.state;
    let numbers = state.coordinates().iter().chain(state.velocities());
    numbers.chain([&named.time]).map(|x| x.to_bits()).collect()
}

#[test]
fn a_state_comes_back_bit_for_bit() -> Result<(), serde_json::Error> {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for _ in 0..200 {
        let named = random(&mut rng);
        let read: Named = from_str(&to_string(&named)?)?;
        assert_eq!(bits(&read), bits(&named));
        // By way of a tree, whose keys are in another order.
        let read: Named = from_value(to_value(named)?)?;
        assert_eq!(bits(&read), bits(&named));
        // Into another order of fields, and back.
        let other: NamedState<reordered::Workshop> = from_str(&to_string(&named)?)?;
        let read: Named = from_str(&to_string(&other)?)?;
        assert_eq!(bits(&read), bits(&named));
    }
    Ok(())
}

#[test]
fn a_state_in_single_precision_comes_back() -> Result<(), Box<dyn std::error::Error>> {
    let mut state = Workshop::default().described_state::<f32>()?;
    state.velocities_mut().fill(0.1);
    let named = NamedState::<Workshop, f32>::new(0.3, state);
    let text = to_string(&named)?;
    assert!(text.contains(r#""velocity":[0.1,0.1,0.1]"#), "{text}");
    let read: NamedState<Workshop, f32> = from_str(&text)?;
    assert_eq!(read, named);
    Ok(())
}

/// A run of fixed steps that was ended, written and gone on with comes to the same bits.
#[test]
fn a_run_goes_on_as_if_it_had_not_ended() -> Result<(), Box<dyn std::error::Error>> {
    let workshop = Workshop::default();
    let mut start = workshop.described_state()?;
    workshop.set_angle(&mut start, Workshop::HANDLES.bearing, 20.3)?;
    let mut stepper = Stepper::new(&workshop, StandardLagrange, Rk4)?;
    let (mut whole, mut text) = (start, String::new());
    for step in 0..200 {
        if step == 100 {
            text = to_string(&Named::new(stepper.time(), whole))?;
        }
        stepper.step(&mut whole, 1e-3)?;
    }
    let Named { time, mut state } = from_str(&text)?;
    let mut stepper = Stepper::new(&workshop, StandardLagrange, Rk4)?.starting_at(time);
    for _ in 0..100 {
        stepper.step(&mut state, 1e-3)?;
    }
    assert_eq!(state, whole);
    let angle = workshop
        .view(time, &state)?
        .force_parts(Workshop::HANDLES.spring);
    assert!(
        angle.potential > 10.0 * 10.0,
        "it is wound up by three turns"
    );
    Ok(())
}

#[test]
fn a_file_is_readable() -> Result<(), Box<dyn std::error::Error>> {
    let workshop = Workshop::default();
    let mut state = workshop.described_state()?;
    workshop.set_angle(&mut state, Workshop::HANDLES.bearing, 7.0)?;
    let value = to_value(Named::new(0.5, state))?;
    assert_eq!(value["mechanism"], "Workshop");
    assert_eq!(value["time"], 0.5);
    let point = json!({ "position": [5.0, 0.0, 0.0], "velocity": [0.0, 0.0, 0.0] });
    assert_eq!(value["bodies"]["point"], point);
    assert_eq!(
        value["bodies"]["links[1]"]["position"],
        json!([3.0, 0.0, 0.0])
    );
    assert_eq!(
        value["bodies"]["links[1]"]["orientation"],
        json!([1.0, 0.0, 0.0, 0.0])
    );
    for (element, expected) in [("screw", 0.0), ("spring", 7.0)] {
        let angle = value["unwrapped_angles"][element][0].as_f64();
        let is_near = angle.is_some_and(|angle| (angle - expected).abs() < 1e-12);
        assert!(is_near, "{element}: {angle:?}");
    }
    Ok(())
}

/// What is refused, as what.
fn refused<M: Mechanism>(value: &Value) -> String {
    let refused = from_value::<NamedState<M>>(value.clone());
    refused.expect_err("refused").to_string()
}

#[test]
fn what_does_not_fit_is_refused_by_name() -> Result<(), Box<dyn std::error::Error>> {
    let state = Workshop::default().described_state()?;
    let whole = to_value(Named::new(0.5, state))?;
    let says = |change: &dyn Fn(&mut Value), message: &str| {
        let mut value = whole.clone();
        change(&mut value);
        assert_eq!(refused::<Workshop>(&value), message);
    };
    let text = to_string(&Named::new(0.5, state))?;
    let other = from_str::<NamedState<Store>>(&text)
        .expect_err("another mechanism")
        .to_string();
    let place = " at line 1 column 23";
    assert_eq!(
        other,
        format!("this is a state of `Workshop`, and not of `Store`{place}")
    );

    let object = |value: &mut Value, key: &str| value[key].as_object_mut().expect("one").clone();
    let without = |key: &'static str, name: &'static str| {
        move |value: &mut Value| {
            let mut left = object(value, key);
            left.remove(name).expect("there");
            value[key] = left.into();
        }
    };
    says(
        &without("bodies", "nut"),
        "body `nut` of `Workshop` is missing",
    );
    says(
        &without("unwrapped_angles", "spring"),
        "the unwrapped angles of `spring` of `Workshop` are missing",
    );
    says(
        &|value| value["bodies"]["bolt"] = json!({}),
        "`Workshop` has no body `bolt`",
    );
    says(
        &|value| value["unwrapped_angles"]["axle"] = json!([0.0]),
        "`Workshop` has no joint or force that counts turns `axle`",
    );
    says(
        &|value| value["unwrapped_angles"]["screw"] = json!([0.0, 1.0]),
        "invalid length 2, expected 1 unwrapped angles (rad)",
    );
    says(
        &|value| value["unwrapped_angles"]["screw"] = json!([]),
        "invalid length 0, expected 1 unwrapped angles (rad)",
    );
    says(
        &|value| value["bodies"]["wheel"]["orientation"] = json!([0.0, 0.0, 0.0, 0.0]),
        "the Euler parameters of body `wheel` have no length",
    );
    says(
        &|value| value["version"] = 2.into(),
        "unknown field `version`, expected one of `mechanism`, `time`, `bodies`, `unwrapped_angles`, `states`",
    );
    let wheel = json!({
        "mechanism": "Workshop", "time": 0.0, "bodies": { "wheel": whole["bodies"]["wheel"] },
        "unwrapped_angles": {},
    });
    assert_eq!(
        refused::<reshaped::Workshop>(&wheel),
        "the principal axes of body `wheel` are not those of the file: its inertia is another one"
    );
    let twice = text.replace(r#""nut":"#, r#""wheel":"#);
    let twice = from_str::<Named>(&twice).expect_err("twice").to_string();
    // That of the nut has other axes, if it comes first.
    assert!(twice.contains("body `wheel`"), "{twice}");
    Ok(())
}

#[test]
fn a_state_that_is_none_is_not_written() {
    let mut state = Workshop::default().described_state().expect("described");
    let refused = |named: &Named| to_string(named).expect_err("refused").to_string();
    let not_finite = "the state holds a number that is not finite";
    assert_eq!(refused(&Named::new(f64::NAN, state)), not_finite);
    state.velocities_mut()[2] = f64::INFINITY;
    assert_eq!(refused(&Named::new(0.0, state)), not_finite);
}

/// Written and read to the same value, in these words.
fn comes_back<T>(value: &T, written: &Value) -> Result<(), serde_json::Error>
where
    T: Serialize + DeserializeOwned + PartialEq + core::fmt::Debug,
{
    let text = to_string(value)?;
    assert_eq!(from_str::<Value>(&text)?, *written);
    assert_eq!(from_str::<T>(&text)?, *value);
    Ok(())
}

#[test]
fn readings_come_back() -> Result<(), serde_json::Error> {
    let pose = Pose {
        position: Vector3::new(1.0, 2.0, 1.0 / 3.0),
        orientation: Quaternion::new(0.1, 0.2, 0.3, 0.4),
    };
    // Scalar first.
    let written = json!({ "position": [1.0, 2.0, 1.0 / 3.0], "orientation": [0.1, 0.2, 0.3, 0.4] });
    comes_back(&pose, &written)?;
    let wrench = Wrench {
        force: Vector3::new(1.0, 2.0, 3.0),
        moment: Vector3::new(0.1, 0.2, 0.3),
        point: Vector3::zeros(),
        is_unique: true,
    };
    let written = json!({
        "force": [1.0, 2.0, 3.0], "moment": [0.1, 0.2, 0.3], "point": [0.0, 0.0, 0.0],
        "is_unique": true,
    });
    comes_back(&wrench, &written)?;
    let angles = EulerAngles {
        precession: 0.1,
        nutation: 0.2,
        spin: 0.3,
    };
    comes_back(
        &angles,
        &json!({ "precession": 0.1, "nutation": 0.2, "spin": 0.3 }),
    )
}

#[test]
fn reports_are_written_with_names_and_sentences() -> Result<(), Box<dyn std::error::Error>> {
    let report = to_value(Workshop::REPORT)?;
    assert_eq!(report["name"], "Workshop");
    assert_eq!(report["bodies"][0]["name"], "nut");
    assert_eq!(report["joints"][1]["kind"], "Revolute");
    assert!(report["rank"]["Decided"]["rank"].is_u64());
    let joints = to_value(reordered::Workshop::JOINT_REPORT)?;
    assert!(
        joints["motions"]
            .as_array()
            .is_some_and(|motions| !motions.is_empty())
    );

    fn is_written<T: Serialize>() {}
    is_written::<KinematicReport<f64, StateOf<Workshop>>>();

    let workshop = Workshop::default();
    let mut start = workshop.described_state()?;
    workshop.set_angle(&mut start, Workshop::HANDLES.bearing, 3.0)?;
    // Steps that are too long.
    let run = Simulation::new(&workshop, StandardLagrange, Rk4::every(0.5))
        .initial_state(start)
        .run(0.0..=20.0, every(1.0), |_| ())?;
    let written = to_value(run)?;
    assert_eq!(written["evaluations"], run.evaluations);
    assert_eq!(written["stopped"], false);
    let state: Named = from_value(written["state"].clone())?;
    assert_eq!(state, Named::new(run.time, run.state));
    assert!(!run.warnings().is_empty());
    let warnings = written["warnings"].as_array().ok_or("an array")?;
    assert_eq!(warnings.len(), run.warnings().len());
    for (written, warning) in warnings.iter().zip(run.warnings()) {
        assert_eq!(written["sentence"], warning.to_string());
        assert!(written["warning"].is_object());
    }
    assert_eq!(written["verification"], Value::Null);

    let verified = Simulation::new(&workshop, StandardLagrange, DormandPrince::default())
        .verified()
        .run(0.0..=0.5, every(0.1), |_| ())?;
    let written = to_value(verified)?;
    assert_eq!(written["verification"]["bodies"][1]["body"], "wheel");
    assert_eq!(written["verification"]["ended"], Value::Null);
    Ok(())
}

#[test]
fn poses_go_through_mint() {
    let pose = Pose {
        position: Vector3::new(1.0, 2.0, 3.0),
        orientation: Quaternion::new(0.1, 0.2, 0.3, 0.4),
    };
    let (point, turn): (mint::Point3<f64>, mint::Quaternion<f64>) = pose.into();
    assert_eq!((point.x, point.y, point.z), (1.0, 2.0, 3.0));
    assert_eq!((turn.s, turn.v.x, turn.v.y, turn.v.z), (0.1, 0.2, 0.3, 0.4));
    assert_eq!(Pose::from((point, turn)), pose);
    let velocity: mint::Vector3<f64> = Vector3::new(1.0, 2.0, 3.0).into();
    assert_eq!(velocity.y, 2.0);
}

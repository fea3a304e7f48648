//! The source that is printed: what the tests of motion compile is what the printer prints.

use std::fs;

use holonom_urdf::{Options, Robot};
use syn::{Fields, Item};

/// Robots whose source stands in `motion/robots`.
const COMPILED: [&str; 6] = [
    "crane",
    "double_pendulum",
    "gripper",
    "panda",
    "so100",
    "ur5",
];

/// Write the sources anew: `HOLONOM_URDF_WRITE=1 cargo test -p holonom-urdf --test robots`.
const WRITE: &str = "HOLONOM_URDF_WRITE";

#[test]
fn sources_of_the_tests_are_what_is_printed() {
    for robot in COMPILED {
        let source = crate::mechanism(robot).to_string();
        let file = format!("motion/robots/{robot}.rs");
        if std::env::var_os(WRITE).is_some() {
            fs::write(crate::path(&file), &source).expect("the folder is there");
        }
        assert!(
            source == crate::text(&file),
            "{file} is of another printer; set {WRITE}=1"
        );
    }
}

#[test]
fn every_robot_is_printed_as_rust() {
    let mut robots = 0;
    for entry in fs::read_dir(crate::path("data/robots")).expect("a folder") {
        let file = entry.expect("readable").file_name();
        let name = file.to_string_lossy();
        let robot = name.strip_suffix(".urdf").expect("only robots");
        let mechanism = crate::mechanism(robot);
        let source = mechanism.to_string();
        let parsed = syn::parse_file(&source).unwrap_or_else(|error| panic!("{robot}: {error}"));
        let fields = parsed.items.iter().find_map(|item| match item {
            Item::Struct(item) if item.ident == mechanism.name => Some(&item.fields),
            _ => None,
        });
        let Some(Fields::Named(fields)) = fields else {
            panic!("{robot}: no struct {}", mechanism.name);
        };
        let bodies = mechanism.bodies.iter().map(|body| &body.field);
        let joints = mechanism.joints.iter().map(|joint| &joint.field);
        for field in bodies.chain(joints) {
            let is_there =
                |other: &syn::Field| other.ident.as_ref().is_some_and(|own| own == field);
            assert!(
                fields.named.iter().any(is_there),
                "{robot}: no field {field}"
            );
        }
        for line in source
            .lines()
            .filter(|line| line.trim_start().starts_with("//"))
        {
            assert!(line.chars().count() <= 100, "{robot}: {line}");
        }
        robots += 1;
    }
    assert!(robots >= 12, "{robots} robots");
}

const ODD: &str = r#"<robot name="2 fast-arm">
  <link name="world"/>
  <link name="type"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial></link>
  <link name="LFHip 1"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial></link>
  <link name="lf_hip_1"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial></link>
  <link name="é"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial></link>
  <joint name="type" type="continuous"><parent link="world"/><child link="type"/></joint>
  <joint name="rate" type="continuous"><parent link="type"/><child link="LFHip 1"/></joint>
  <joint name="0" type="continuous"><parent link="type"/><child link="lf_hip_1"/></joint>
  <joint name="lf_hip_1" type="prismatic"><parent link="type"/><child link="é"/></joint>
</robot>"#;

#[test]
fn odd_names_become_fields() {
    let mechanism = Robot::parse(ODD)
        .expect("sound")
        .mechanism(&Options::default());
    let mechanism = mechanism.expect("it moves");
    let bodies: Vec<&str> = mechanism.bodies.iter().map(|body| &*body.field).collect();
    let joints: Vec<&str> = mechanism.joints.iter().map(|joint| &*joint.field).collect();
    assert_eq!(mechanism.name, "Robot2FastArm");
    assert_eq!(bodies, ["type_link", "lf_hip_1", "lf_hip_1_link", "link"]);
    assert_eq!(
        joints,
        ["type_joint", "rate_joint", "joint_0", "lf_hip_1_joint"]
    );
    syn::parse_file(&mechanism.to_string()).expect("Rust");
    for (given, wanted) in [
        ("UR5e", "UR5e"),
        ("UR5", "Ur5"),
        ("my arm", "MyArm"),
        ("body", "RobotBody"),
    ] {
        let mut options = Options::default();
        options.name = Some(given.into());
        let robot = Robot::parse(ODD).expect("sound");
        assert_eq!(robot.mechanism(&options).expect("it moves").name, wanted);
    }
}

#[test]
fn what_is_left_out_is_said() {
    let text = r#"<robot name="r"><link name="base"/>
        <link name="a"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial></link>
        <link name="b"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial></link>
        <joint name="one" type="floating"><parent link="base"/><child link="a"/>
        <dynamics damping="0.5"/></joint>
        <joint name="two" type="prismatic"><parent link="base"/><child link="b"/>
        <limit lower="0" upper="0" effort="1" velocity="1"/><dynamics friction="0.25"/></joint></robot>"#;
    let mechanism = Robot::parse(text)
        .expect("sound")
        .mechanism(&Options::default());
    let source = mechanism.expect("it moves").to_string();
    for said in [
        "// Damping of 0.5 is left out",
        "// Dry friction of 0.25 N is left out: a run takes it as an `Interaction::friction`.",
        "// Limits from 0 to 0 are left out: they leave no range.",
        "free",
    ] {
        assert!(source.contains(said), "{source}");
    }
    assert!(!source.contains("limits = "), "{source}");
}

#[test]
fn limits_of_positions_are_those_of_the_joints() {
    let mechanism = crate::mechanism("crane");
    let source = mechanism.to_string();
    for joint in &mechanism.joints {
        let [lower, upper] = joint.limits.position;
        let written = format!("limits = [{lower:?}, {upper:?}]");
        assert_eq!(source.contains(&written), lower.is_finite(), "{written}");
    }
    assert_eq!(source.matches("limits = ").count(), 4, "{source}");
}

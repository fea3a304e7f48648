//! What is fixed together, by numbers worked out by hand.

use holonom_urdf::{Mechanism, Options, Robot};

fn one_hinge(links: &str) -> Mechanism {
    let text = format!(
        r#"<robot name="hinge"><link name="base"/>{links}
        <joint name="hinge" type="continuous"><parent link="base"/><child link="a"/></joint></robot>"#
    );
    let robot = Robot::parse(&text).unwrap_or_else(|faults| panic!("{faults}"));
    robot.mechanism(&Options::default()).expect("it moves")
}

#[test]
fn an_inertial_frame_turns_the_inertia() {
    let mechanism = one_hinge(
        r#"<link name="a"><inertial>
            <origin xyz="0.1 0.2 0.3" rpy="0 0 1.5707963267948966"/><mass value="4"/>
            <inertia ixx="1" iyy="2" izz="2.5" ixy="0" ixz="0" iyz="0"/>
        </inertial></link>"#,
    );
    let body = &mechanism.bodies[0];
    assert_eq!(
        body.inertia,
        [[2.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 2.5]]
    );
    assert_eq!(
        (body.position, body.orientation),
        ([0.1, 0.2, 0.3], [1.0, 0.0, 0.0, 0.0])
    );
}

/// The first axis of the inertia, with the largest moment, lies along `(cos 30, sin 30)` of the
/// link.
#[test]
fn a_positive_angle_turns_from_the_inertial_frame_to_the_link() {
    let mechanism = one_hinge(
        r#"<link name="a"><inertial>
            <origin rpy="0 0 0.5235987755982988"/><mass value="4"/>
            <inertia ixx="3" iyy="2" izz="2.5"/>
        </inertial></link>"#,
    );
    let [[xx, xy, _], [_, yy, _], _] = mechanism.bodies[0].inertia;
    let product = 3.0_f64.sqrt() / 4.0; // (3 - 2) sin 30 cos 30
    assert!((xx - 2.75).abs() < 1e-15 && (yy - 2.25).abs() < 1e-15 && (xy - product).abs() < 1e-15);
}

/// 2 kg at the origin and 1 kg at (0, 0, 0.9), whose axes are turned by 90 degrees about x.
///
/// The centre is at 0.3; about it 2 * 0.3^2 + 1 * 0.6^2 = 0.54 kg m^2 across z.
#[test]
fn fixed_links_are_one_body() {
    let mechanism = one_hinge(
        r#"<link name="a"><inertial><mass value="2"/>
            <inertia ixx="0.1" iyy="0.2" izz="0.25"/></inertial></link>
        <link name="b"><inertial><origin xyz="0 0.4 0"/><mass value="1"/>
            <inertia ixx="0.01" iyy="0.02" izz="0.025"/></inertial></link>
        <link name="tool"/>
        <joint name="weld" type="fixed"><parent link="a"/><child link="b"/>
            <origin xyz="0 0 0.5" rpy="1.5707963267948966 0 0"/></joint>
        <joint name="mount" type="fixed"><parent link="b"/><child link="tool"/>
            <origin xyz="0 1 0"/></joint>"#,
    );
    let [body] = &mechanism.bodies[..] else {
        panic!("one body")
    };
    assert_eq!(body.links, ["a", "b", "tool"]);
    assert_eq!(body.mass, 3.0);
    let near =
        |found: f64, wanted: f64| assert!((found - wanted).abs() < 1e-15, "{found} {wanted}");
    let wanted = [0.1 + 0.01 + 0.54, 0.2 + 0.025 + 0.54, 0.25 + 0.02];
    for (row, wanted) in wanted.into_iter().enumerate() {
        near(body.position[row], [0.0, 0.0, 0.3][row]);
        for column in 0..3 {
            near(
                body.inertia[row][column],
                if row == column { wanted } else { 0.0 },
            );
        }
        // From the centre of mass: 0.5 + 1 - 0.3 along z.
        near(mechanism.frames[3].origin[row], [0.0, 0.0, 1.2][row]);
    }
}

#[test]
fn a_root_floats_where_it_is_asked_for() {
    let text = crate::text("data/robots/solo12.urdf");
    let robot = Robot::parse(&text).expect("sound");
    let fixed = robot.mechanism(&Options::default()).expect("it moves");
    let mut options = Options::default();
    options.floating = true;
    options.passive = true;
    let floating = robot.mechanism(&options).expect("the trunk has a mass");
    assert_eq!(floating.bodies.len(), fixed.bodies.len() + 1);
    assert_eq!(floating.bodies[0].mass, fixed.ground_mass);
    assert!(floating.ground.is_empty() && floating.joints[0].between[0] == Some(0));
    assert!(!floating.to_string().contains("#[input]"));
}

/// Right angles of six figures make numbers that would be zero.
#[test]
fn angles_are_rounded_to_quarter_turns() {
    let text = r#"<robot name="r"><link name="base"/>
        <link name="a"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial></link>
        <joint name="hinge" type="continuous"><parent link="base"/><child link="a"/>
        <origin rpy="1.5708 0 0"/><axis xyz="0 0 1"/></joint></robot>"#;
    let axis = |robot: Robot| {
        robot
            .mechanism(&Options::default())
            .expect("it moves")
            .joints[0]
            .axis
    };
    let [_, _, z] = axis(Robot::parse(text).expect("sound"));
    assert!((z + 3.67e-6).abs() < 1e-8, "{z}");
    assert_eq!(
        axis(Robot::parse_rounded(text).expect("sound")),
        [0.0, -1.0, 0.0]
    );
}

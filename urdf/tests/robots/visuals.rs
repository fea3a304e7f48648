//! What links look like, by points worked out by hand.

use holonom_urdf::{Mechanism, Options, Robot, Shape};

const ROBOT: &str = r#"<robot name="looks"><link name="base">
    <visual><geometry><box size="1 1 1"/></geometry></visual></link>
<link name="a"><inertial><origin xyz="0 0.5 0"/><mass value="2"/>
    <inertia ixx="1" ixy="0.1" iyy="2" izz="2.5"/></inertial>
    VISUALS</link>
<link name="b"><visual><origin rpy="0.5 0 0"/>
    <geometry><box size="0.6 0.2 0.1"/></geometry></visual></link>
<joint name="hinge" type="continuous"><parent link="base"/><child link="a"/>
    <origin xyz="1 2 3" rpy="0 0 1.5707963267948966"/></joint>
<joint name="weld" type="fixed"><parent link="a"/><child link="b"/><origin xyz="0 0 1"/></joint>
</robot>"#;

const VISUALS: &str = r#"
    <visual><origin xyz="0.1 0 0"/><geometry><box size="0.2 0.3 0.4"/></geometry></visual>
    <visual><origin rpy="0 1.5707963267948966 0"/>
        <geometry><cylinder radius="0.25" length="2"/></geometry></visual>
    <visual><geometry><mesh filename="package://robot/meshes/a cover.stl"/></geometry></visual>
    <visual name="tip"><origin xyz="0 0 0.5"/><geometry><sphere radius="0.125"/></geometry>
        <material name="red"/></visual>
    <visual><geometry><sphere radius="0"/></geometry></visual>
    <visual/>"#;

fn robot(visuals: &str) -> Result<Mechanism, String> {
    let robot = Robot::parse(&ROBOT.replace("VISUALS", visuals));
    let robot = robot.map_err(|faults| faults.in_file("looks.urdf").to_string())?;
    Ok(robot.mechanism(&Options::default()).expect("it moves"))
}

/// The link is turned by a quarter about z: its x axis is the global y, its y axis against x.
#[test]
fn primitives_become_shapes_of_the_body() {
    let mechanism = robot(VISUALS).expect("sound");
    let [body] = &mechanism.bodies[..] else {
        panic!("one body")
    };
    assert_eq!(body.visuals, ["a cover.stl", "sphere"]);
    let [block, cylinder, ball, bar] = &body.shapes[..] else {
        panic!("{:?}", body.shapes)
    };
    let wanted = Shape::Block {
        size: [0.2, 0.3, 0.4],
        at: [1.0, 2.1, 3.0],
    };
    assert_eq!(*block, wanted);
    let wanted = Shape::Cylinder {
        radius: 0.25,
        from: [1.0, 1.0, 3.0],
        to: [1.0, 3.0, 3.0],
    };
    assert_eq!(*cylinder, wanted);
    let wanted = Shape::Ball {
        radius: 0.125,
        at: [1.0, 2.0, 3.5],
    };
    assert_eq!(*ball, wanted);
    // About the link's x the box is turned by half a radian: its z axis was (0, -sin, cos).
    let (sine, cosine) = 0.5_f64.sin_cos();
    let wanted = Shape::Bar {
        width: 0.2,
        height: 0.1,
        from: [1.0, 1.7, 4.0],
        to: [1.0, 2.3, 4.0],
        up: [sine, 0.0, cosine],
    };
    assert_eq!(*bar, wanted);

    let source = mechanism.to_string();
    for said in [
        "    // Visuals that are not drawn: `a cover.stl` and `sphere`.\n",
        "        shapes = [\n            block(size = [0.2, 0.3, 0.4], at = [1.0, 2.1, 3.0]),\n",
        "            ball(radius = 0.125, at = [1.0, 2.0, 3.5]),\n",
    ] {
        assert!(source.contains(said), "{source}");
    }
}

#[test]
fn what_is_drawn_has_no_mass() {
    let [drawn, plain] = [VISUALS, ""].map(|visuals| {
        let mut mechanism = robot(visuals).expect("sound");
        mechanism.bodies[0].visuals.clear();
        mechanism.bodies[0].shapes.clear();
        mechanism.to_string()
    });
    assert_eq!(drawn, plain);
}

#[test]
fn sizes_that_are_none_are_refused_by_line() {
    let said = robot(
        r#"<visual><geometry><box size="1 2"/></geometry></visual>
<visual><geometry><box size="1 -2 3"/></geometry></visual>
<visual><geometry><box/></geometry></visual>
<visual><geometry><cylinder radius="1"/></geometry></visual>
<visual><geometry><sphere radius="-1"/></geometry></visual>
<visual><origin xyz="1"/><geometry><sphere radius="1"/></geometry></visual>"#,
    );
    let wanted = "\
looks.urdf:5: link \"a\": `size` is \"1 2\"; 3 numbers with spaces between them are accepted
looks.urdf:6: link \"a\": `size` has a negative length; zero or positive ones are accepted
looks.urdf:7: link \"a\": <box> has no attribute `size`
looks.urdf:8: link \"a\": <cylinder> has no attribute `length`
looks.urdf:9: link \"a\": `radius` is -1; zero or a positive number is accepted
looks.urdf:10: link \"a\": `xyz` is \"1\"; 3 numbers with spaces between them are accepted";
    assert_eq!(said.expect_err("refused"), wanted);
}

/// The frame of the mesh in that of its link, and of the ground, by hand: the centre of mass is
/// half a metre along y from the link.
#[test]
fn meshes_have_their_frames_on_bodies() {
    let text = ROBOT.replace(
        "<link name=\"base\">",
        "<material name=\"paint\"><color rgba=\"0 0.5 1 1\"/></material><link name=\"base\">
         <visual><origin xyz=\"7 8 9\"/><geometry><mesh filename=\"base.dae\"/></geometry></visual>",
    );
    let text = text.replace(
        "VISUALS",
        "<visual><origin xyz=\"1 2 3\" rpy=\"0 0 1.5707963267948966\"/><material name=\"paint\"/>
         <geometry><mesh filename=\"package://a/b.stl\" scale=\"1 2 3\"/></geometry></visual>",
    );
    let robot = Robot::parse(&text).expect("sound");
    let mechanism = robot.mechanism(&Options::default()).expect("it moves");
    let [base, arm] = &mechanism.meshes[..] else {
        panic!("{:?}", mechanism.meshes)
    };
    assert_eq!((&*base.file, base.body), ("base.dae", None));
    assert_eq!((base.origin, base.scale), ([7.0, 8.0, 9.0], [1.0; 3]));
    assert_eq!(
        (base.orientation, base.colour),
        ([1.0, 0.0, 0.0, 0.0], None)
    );
    assert_eq!((&*arm.file, arm.body), ("package://a/b.stl", Some(0)));
    assert_eq!((arm.origin, arm.scale), ([1.0, 1.5, 3.0], [1.0, 2.0, 3.0]));
    let half = 0.5_f64.sqrt();
    let turned = arm.orientation.iter().zip([half, 0.0, 0.0, half]);
    assert!(
        turned
            .into_iter()
            .all(|(found, wanted)| (found - wanted).abs() < 1e-15)
    );
    assert_eq!(arm.colour, Some([0.0, 0.5, 1.0, 1.0]));
}

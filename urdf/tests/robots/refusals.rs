//! Files that are refused: every fault with its line, what was found and what would be accepted.

use holonom_urdf::{Faults, Mechanism, Options, Robot};

const MASS: &str = r#"<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial>"#;

/// With all products of inertia.
const WHOLE: &str = r#"<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>"#;

/// A mechanism whose inertias are taken as given, of links and joints in lines from 2 on.
fn given(body: &str) -> Result<Mechanism, Faults> {
    let robot = Robot::parse(&format!("<robot name=\"arm\">\n{body}\n</robot>"))?;
    let mut options = Options::default();
    options.accept_inertia = true;
    robot.mechanism(&options)
}

/// What is noted of it, in the order of lines.
fn notes(body: &str) -> Vec<String> {
    let mechanism = given(body).unwrap_or_else(|faults| panic!("{faults}"));
    let mut notes = mechanism.notes;
    notes.sort_by_key(|note| note.line);
    let notes = notes.iter();
    notes.map(|note| format!("{}: {note}", note.line)).collect()
}

/// What is said of the links and joints in a robot, in lines from 2 on.
fn refusal(body: &str) -> String {
    let text = format!(
        "<robot name=\"arm\">\n{}\n</robot>",
        body.replace("MASS", MASS)
    );
    match Robot::parse(&text) {
        Err(faults) => faults.in_file("arm.urdf").to_string(),
        Ok(robot) => match robot.mechanism(&Options::default()) {
            Err(faults) => faults.in_file("arm.urdf").to_string(),
            Ok(_) => panic!("accepted: {text}"),
        },
    }
}

#[test]
fn a_type_that_is_no_joint() {
    let found = refusal(
        r#"<link name="base"/>
<link name="hand">MASS</link>
<joint name="elbow" type="screw"><parent link="base"/><child link="hand"/></joint>"#,
    );
    let wanted = "arm.urdf:4: joint \"elbow\": type \"screw\" is no joint of URDF; revolute, \
                  continuous, prismatic, fixed, floating, planar are";
    assert_eq!(found, wanted);
}

#[test]
fn a_link_that_is_not_there() {
    let found = refusal(
        r#"<link name="base"/>
<link name="forearm">MASS</link>
<joint name="elbow" type="revolute">
  <parent link="base"/><child link="fore_arm"/>
</joint>"#,
    );
    let wanted = "arm.urdf:4: joint \"elbow\": child \"fore_arm\" is no link; did you mean \
                  \"forearm\"?";
    assert_eq!(found, wanted);
}

#[test]
fn a_loop() {
    let found = refusal(
        r#"<link name="base"/>
<link name="a">MASS</link>
<link name="b">MASS</link>
<joint name="one" type="continuous"><parent link="base"/><child link="a"/></joint>
<joint name="two" type="continuous"><parent link="a"/><child link="b"/></joint>
<joint name="three" type="continuous"><parent link="base"/><child link="b"/></joint>"#,
    );
    let wanted = "arm.urdf:7: joint \"three\": link \"b\" is the child of joint \"two\" (line 6) \
                  already; a URDF is a tree; close a loop in the struct that is printed";
    assert_eq!(found, wanted);
}

#[test]
fn two_roots_and_a_circle() {
    let found = refusal(
        r#"<link name="base"/>
<link name="a">MASS</link>
<link name="b">MASS</link>
<joint name="one" type="continuous"><parent link="base"/><child link="a"/></joint>"#,
    );
    let wanted = "arm.urdf:4: link \"b\": no joint has it as its child, nor link \"base\" (line 2); \
                  one such link, the root, is accepted";
    assert_eq!(found, wanted);
    let found = refusal(
        r#"<link name="a">MASS</link>
<link name="b">MASS</link>
<joint name="one" type="continuous"><parent link="b"/><child link="a"/></joint>
<joint name="two" type="continuous"><parent link="a"/><child link="b"/></joint>"#,
    );
    let wanted = "arm.urdf:4: joint \"one\": its links \"b\" and \"a\" are in a circle of joints that \
                  no root carries; a URDF is a tree";
    assert_eq!(found, wanted);
}

#[test]
fn a_massless_link_that_moves() {
    let found = refusal(
        r#"<link name="base"/>
<link name="cross"/>
<link name="tool"/>
<link name="hand">MASS</link>
<joint name="pitch" type="continuous"><parent link="base"/><child link="cross"/></joint>
<joint name="mount" type="fixed"><parent link="cross"/><child link="tool"/></joint>
<joint name="yaw" type="continuous"><parent link="cross"/><child link="hand"/></joint>"#,
    );
    // The hand turns about the same axis, so that nothing resists both joints.
    let wanted = "arm.urdf:3: link \"cross\": joint \"pitch\" moves it with link \"tool\", and there is \
                  no mass; a positive mass and inertia are accepted, or a `fixed` joint";
    assert_eq!(found, wanted);
    // By itself, at the end of a chain.
    let found = refusal(
        r#"<link name="base"/>
<link name="hand">MASS</link>
<link name="tip"/>
<joint name="yaw" type="continuous"><parent link="base"/><child link="hand"/></joint>
<joint name="slide" type="prismatic"><parent link="hand"/><child link="tip"/></joint>"#,
    );
    let wanted = "arm.urdf:4: link \"tip\": joint \"slide\" moves it, and there is no mass; a positive \
                  mass and inertia are accepted, or a `fixed` joint";
    assert_eq!(found, wanted);
}

#[test]
fn inertias_of_no_body() {
    let found = refusal(
        r#"<link name="base"/>
<link name="a"><inertial><mass value="1"/><inertia ixx="1e-5" iyy="0.1234567" izz="3"/></inertial></link>
<link name="b"><inertial><mass value="1"/><inertia ixx="0" iyy="0" izz="0"/></inertial></link>
<joint name="one" type="continuous"><parent link="base"/><child link="a"/></joint>
<joint name="two" type="continuous"><parent link="a"/><child link="b"/></joint>"#,
    );
    let wanted = "arm.urdf:3: link \"a\": joint \"one\" moves it, and its principal moments of inertia \
                  are 1e-5, 0.1235, 3 kg m^2; no body has these: a moment up to the sum of \
                  the two others is accepted\n\
                  arm.urdf:4: link \"b\": joint \"two\" moves it, and its principal moments of inertia \
                  are 0, 0, 0 kg m^2; positive ones are accepted";
    assert_eq!(found, wanted);
}

#[test]
fn numbers_that_are_none() {
    let found = refusal(
        r#"<link name="base"/>
<link name="a"><inertial>
  <origin xyz="0 0"/>
  <mass value="-1"/>
  <inertia ixx="1,5" iyy="1"/>
</inertial></link>
<joint name="one" type="revolute"><parent link="base"/><child link="a"/>
  <origin rpy="0 0 pi"/>
  <axis xyz="0 0 0"/>
  <limit lower="1" upper="-1" effort="-5"/>
</joint>"#,
    );
    let wanted = "arm.urdf:4: link \"a\": `xyz` is \"0 0\"; 3 numbers with spaces between them are \
                  accepted\n\
                  arm.urdf:5: link \"a\": the mass is -1 kg; a positive mass is accepted\n\
                  arm.urdf:6: link \"a\": `ixx` is \"1,5\"; a number is accepted\n\
                  arm.urdf:6: link \"a\": <inertia> has no attribute `izz`\n\
                  arm.urdf:9: joint \"one\": `rpy` is \"0 0 pi\"; 3 numbers with spaces between them \
                  are accepted\n\
                  arm.urdf:10: joint \"one\": the axis has no direction; one that is not zero is \
                  accepted\n\
                  arm.urdf:11: joint \"one\": `effort` is -5; zero or a positive number is accepted";
    assert_eq!(found, wanted);
}

#[test]
fn a_second_element_is_refused_unless_it_says_the_same() {
    let twice = |second: &str| {
        format!(
            r#"<link name="base"/>
<link name="a">MASS</link>
<joint name="one" type="continuous"><parent link="base"/><child link="a"/>
  <axis xyz="0 0 1"/>
  {second}
</joint>"#
        )
    };
    let wanted = "arm.urdf:6: joint \"one\": a second <axis>; one is accepted";
    assert_eq!(refusal(&twice(r#"<axis xyz="0 1 0"/>"#)), wanted);
    let notes = notes(&twice(r#"<axis xyz="0 0 1"/>"#).replace("MASS", WHOLE));
    let wanted = "6: joint \"one\": a second <axis> says the same, and is skipped";
    assert_eq!(notes, [wanted]);
}

/// What other readers take with a word or without one is taken, and named.
#[test]
fn what_is_supplied_is_named() {
    let notes = notes(
        r#"<link name="base"/>
<link name="a"><inertial><mass value="1"/></inertial></link>
<joint name="one" type="prismatic"><parent link="base"/><child link="a"/>
  <mimic joint="index_q1"/>
  <limit lower="1" upper="-1"/>
</joint>"#,
    );
    let wanted = [
        "3: link \"a\": <inertial> has no <inertia>, and zeros are taken",
        "3: link \"a\": its principal moments of inertia are 0, 0, 0 kg m^2; they are taken as given",
        "4: joint \"one\": it mimics \"index_q1\", which is no joint, and moves by itself",
        "6: joint \"one\": the lower limit 1 exceeds the upper limit -1, and none is taken",
    ];
    assert_eq!(notes, wanted);
}

/// A hip of three hinges, of which two carry frames alone; and inertias that no body has. Bodies
/// are `as_given`, and only those.
#[test]
fn inertias_are_taken_as_given_where_the_robot_has_inertia() {
    let leg = r#"<link name="base"/>
<link name="a"/>
<link name="b"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="3" iyz="0" izz="1"/></inertial></link>
<link name="c">MASS</link>
<joint name="one" type="continuous"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/></joint>
<joint name="two" type="continuous"><parent link="a"/><child link="b"/><axis xyz="1 0 0"/></joint>
<joint name="three" type="continuous"><parent link="b"/><child link="c"/><axis xyz="0 1 0"/></joint>"#
        .replace("MASS", WHOLE);
    let wanted = "arm.urdf:4: link \"b\": joint \"two\" moves it, and its principal moments of inertia \
                  are 1, 1, 3 kg m^2; no body has these: a moment up to the sum of the two others is \
                  accepted; to take it as given, say `--accept-inertia` or `#[urdf(inertia = \"as given\")]`";
    assert_eq!(refusal(&leg), wanted);
    let wanted = [
        "3: link \"a\": it has no mass, and moves by its joints",
        "4: link \"b\": its principal moments of inertia are 1, 1, 3 kg m^2; no body has these; they are \
         taken as given",
    ];
    assert_eq!(notes(&leg), wanted);
    let mechanism = given(&leg).expect("it has inertia");
    let as_given = mechanism.bodies.iter().map(|body| body.is_as_given);
    assert_eq!(as_given.collect::<Vec<_>>(), [true, true, false]);
    let source = mechanism.to_string();
    assert_eq!(source.matches("as_given").count(), 2, "{source}");

    // A motion with a negative kinetic energy is refused nevertheless.
    let found = given(&leg.replace("iyy=\"3\"", "iyy=\"-3\"")).expect_err("it has none");
    let wanted = "line 3: link \"a\": joint \"one\" moves it, and there is no mass; a positive mass and \
                  inertia are accepted, or a `fixed` joint";
    assert_eq!(found.to_string(), wanted);
    let found = given(&leg.replace(
        "ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"3\"",
        "ixx=\"-9\" ixy=\"0\" ixz=\"0\" iyy=\"3\"",
    ));
    let found = found.expect_err("it has none").to_string();
    let wanted = "line 4: link \"b\": joint \"two\" moves it, and neither it nor what it carries has an \
                  inertia that resists; a positive mass and inertia are accepted, or a `fixed` joint";
    assert_eq!(found.lines().last(), Some(wanted));
}

#[test]
fn elements_that_are_not_read() {
    let found = refusal(
        r#"<link name="base"/>
<link name="a">MASS<inertal/></link>
<joint name="one" type="continuous"><parent link="base"/><child link="a"/></joint>
<loop_joint name="two"/>
<xacro:macro xmlns:xacro="http://www.ros.org/wiki/xacro" name="leg"/>
<gazebo reference="a"/>"#,
    );
    let wanted = "arm.urdf:3: link \"a\": <inertal> is not read here; did you mean <inertial>?\n\
                  arm.urdf:5: robot \"arm\": <loop_joint> closes a loop and is not read; close it in the \
                  struct, by a joint\n\
                  arm.urdf:6: robot \"arm\": <xacro:macro> is no URDF; run `xacro` on the file first";
    assert_eq!(found, wanted);
}

/// Readers of other tools take what is no XML to the letter, and have elements of their own.
#[test]
fn elements_of_other_tools_are_skipped_and_named() {
    let text = format!(
        r#"
<!-- Written by a tool. -->
<?xml version="1.0"?>
<robot name="arm">
<link name="base"/>
<link name="a">{MASS}<sim:inertial/><sim:wheel radius="1"/><frame/></link>
<sim:link name="none"/>
<joint name="one" type="continuous"><parent link="base"/><child link="a"/><frame/></joint>
<frame name="tip"/>
</robot>"#
    );
    let robot = Robot::parse(&text).expect("a robot");
    let notes = robot.notes().iter();
    let notes: Vec<String> = notes.map(|note| format!("{}: {note}", note.line)).collect();
    let skipped = "is no element of URDF and is skipped";
    let left_out = "is left out, and 0 is taken";
    let wanted = [
        format!("9: <frame> {skipped}, 3 times"),
        format!("6: <inertial> {skipped}"),
        format!("7: <link> {skipped}"),
        format!("6: link \"a\": `ixy` {left_out}"),
        format!("6: link \"a\": `ixz` {left_out}"),
        format!("6: link \"a\": `iyz` {left_out}"),
        format!("6: <wheel> {skipped}"),
    ];
    let sorted = |mut all: Vec<String>| {
        all.sort();
        all
    };
    assert_eq!(sorted(notes), sorted(wanted.to_vec()));
    let source = robot
        .mechanism(&Options::default())
        .expect("it moves")
        .to_string();
    assert!(
        source.contains("`<wheel> is no element of URDF and is skipped`"),
        "{source}"
    );
}

/// A prefix may lack its namespace. That of xacro is no other tool's.
#[test]
fn sources_of_xacro_are_refused_with_and_without_a_namespace() {
    let found = refusal(r#"<link name="base"/><xacro:macro name="leg"/>"#);
    let wanted =
        "arm.urdf:2: robot \"arm\": <xacro:macro> is no URDF; run `xacro` on the file first";
    assert_eq!(found, wanted);
}

#[test]
fn mimics_of_nothing() {
    let found = refusal(
        r#"<link name="base"/>
<link name="a">MASS</link>
<link name="b">MASS</link>
<link name="c">MASS</link>
<joint name="one" type="continuous"><parent link="base"/><child link="a"/>
  <mimic joint="two"/></joint>
<joint name="two" type="continuous"><parent link="base"/><child link="b"/>
  <mimic joint="one"/></joint>
<joint name="three" type="floating"><parent link="base"/><child link="c"/>
  <mimic joint="for"/></joint>"#,
    );
    let wanted = "arm.urdf:7: joint \"one\": it mimics \"two\", which follows it in turn\n\
                  arm.urdf:9: joint \"two\": it mimics \"one\", which follows it in turn\n\
                  arm.urdf:11: joint \"three\": it mimics another one; only a revolute, continuous or \
                  prismatic joint can\n\
                  arm.urdf:11: joint \"three\": it mimics \"for\", which is no joint; the file has \
                  \"one\", \"two\", \"three\"";
    assert_eq!(found, wanted);
}

#[test]
fn names_that_stand_twice_or_nowhere() {
    let found = refusal(
        r#"<link name="base"/>
<link name="a">MASS</link>
<link name="a">MASS</link>
<link>MASS</link>
<joint name="one" type="continuous"><child link="a"/></joint>
<joint name="one" type="continuous"><parent link="base"/><child/></joint>"#,
    );
    let wanted = "arm.urdf:4: link \"a\": line 3 has a link of that name\n\
                  arm.urdf:5: link: <link> has no attribute `name`\n\
                  arm.urdf:6: joint \"one\": <joint> has no <parent>\n\
                  arm.urdf:7: joint \"one\": <child> has no attribute `link`";
    assert_eq!(found, wanted);
}

#[test]
fn files_that_are_no_robots() {
    let of = |text: &str| match Robot::parse(text) {
        Err(faults) => faults.to_string(),
        Ok(_) => panic!("accepted: {text}"),
    };
    let found = of("<robot name=\"a\">\n<link name=\"b\">\n</robot>");
    assert_eq!(
        found,
        "line 3: no XML: expected 'link' tag, not 'robot' at 3:1"
    );
    let found = of("<?xml version=\"1.0\"?>\n<sdf version=\"1.7\"/>");
    assert_eq!(
        found,
        "line 2: <sdf>: the outermost element of a URDF is <robot>"
    );
    let found = of("<robot name=\"a\"/>");
    assert_eq!(
        found,
        "line 1: robot \"a\": no <link>; one at least is needed"
    );
    assert_eq!(
        refusal("<link name=\"base\">MASS</link>"),
        "arm.urdf:2: link \"base\": it is the ground, and no joint moves a link; one at least is \
         needed, or a root that floats"
    );
    let mut options = Options::default();
    options.floating = true;
    let robot = Robot::parse("<robot><link name=\"world\"/></robot>").expect("sound");
    let faults = robot
        .mechanism(&options)
        .expect_err("the world cannot float");
    assert_eq!(
        faults.to_string(),
        "line 1: link \"world\": the root has the name of the ground and cannot float; make its joint \
         `floating`, or rename it"
    );
}

/// Every element and every attribute is left out in turn: the rest is Rust, or is refused.
#[test]
fn what_lacks_a_part_is_printed_or_refused() {
    let [mut printed, mut refused] = [0, 0];
    for file in ["data/crane.urdf", "data/robots/ur5.urdf"] {
        let text = crate::text(file);
        let xml = roxmltree::Document::parse(&text).expect("a file of the tests");
        let elements = xml.descendants().filter(roxmltree::Node::is_element);
        let elements = elements.filter(|node| *node != xml.root_element());
        let attributes = elements.clone().flat_map(|node| node.attributes());
        let parts = attributes
            .map(|one| one.range())
            .chain(elements.map(|node| node.range()));
        for part in parts {
            let less = format!("{}{}", &text[..part.start], &text[part.end..]);
            let mut options = Options::default();
            options.floating = part.start % 2 == 0;
            match Robot::parse(&less).and_then(|robot| robot.mechanism(&options)) {
                Ok(mechanism) => {
                    printed += 1;
                    syn::parse_file(&mechanism.to_string()).expect("Rust");
                }
                Err(faults) => {
                    refused += 1;
                    assert!(faults.iter().all(|fault| fault.line > 0), "{faults}");
                }
            }
        }
    }
    assert!(
        printed > 100 && refused > 100,
        "{printed} printed, {refused} refused"
    );
}

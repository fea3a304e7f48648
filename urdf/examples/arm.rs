//! The struct of a robot from its URDF file.
//!
//! ```text
//! cargo run -p holonom-urdf --example arm
//! ```
//!
//! The command does the same with files: `holonom-urdf arm.urdf > arm.rs`.

use holonom_urdf::{Options, Robot};

const ARM: &str = r#"
<robot name="arm">
  <link name="base"/>
  <link name="upper_arm">
    <inertial>
      <origin xyz="0 0 0.2"/> <mass value="3"/>
      <inertia ixx="0.04" ixy="0" ixz="0" iyy="0.04" iyz="0" izz="0.004"/>
    </inertial>
  </link>
  <link name="forearm">
    <inertial>
      <origin xyz="0 0 0.15"/> <mass value="2"/>
      <inertia ixx="0.015" ixy="0" ixz="0" iyy="0.015" iyz="0" izz="0.002"/>
    </inertial>
  </link>
  <joint name="shoulder" type="continuous">
    <parent link="base"/> <child link="upper_arm"/>
    <origin xyz="0 0 0.3"/> <axis xyz="0 1 0"/> <dynamics damping="0.2"/>
  </joint>
  <joint name="elbow" type="continuous">
    <parent link="upper_arm"/> <child link="forearm"/>
    <origin xyz="0 0 0.4"/> <axis xyz="0 1 0"/> <dynamics damping="0.1"/>
  </joint>
</robot>"#;

fn main() -> Result<(), holonom_urdf::Faults> {
    let mechanism = Robot::parse(ARM)?.mechanism(&Options::default())?;
    // Global axes are those of the root link, all joints at zero.
    assert_eq!(mechanism.bodies[1].position, [0.0, 0.0, 0.85]);
    // The source of the struct, with an input for each motor, to be put beside a `main.rs`.
    println!("{mechanism}");

    // What cannot be carried over is refused, by name and line.
    let faults = Robot::parse(&ARM.replace(r#"child link="forearm""#, r#"child link="fore_arm""#))
        .expect_err("no such link");
    println!("{faults}");
    assert!(faults.to_string().contains("did you mean \"forearm\"?"));
    Ok(())
}

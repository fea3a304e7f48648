//! Functional mock-up units of some mechanisms, and beside each what our own run gives, for a
//! comparison with the runs of importers: `.ci/fmus` makes it.
//!
//! `cargo run -p holonom-fmu --example fmus -- FOLDER`

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use holonom::formulation::Formulation;
use holonom::mechanism::{Relative, TracedCoordinates};
use holonom::prelude::*;
use holonom::{JointCoordinates, Sample};
use holonom_fmu::Fmu;
use holonom_models::{CartPole, FourBar, HeavyTop, Ur5};

/// Two links on parallel axes with stops between them, with a damper and a motor at the first one,
/// and a current that a voltage drives.
#[derive(Clone, Copy, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Arm {
    /// The torque for a rate (N m s).
    #[param]
    damping: f64,
    /// The voltage (V) on the motor.
    #[input]
    voltage: f64,
    /// The current (A) in the motor, of 0.5 ohm and 0.1 H.
    #[state(rate = (voltage - 0.5 * current) / 0.1, start = 0.3)]
    current: f64,
    #[body(mass = 1.0, inertia = [0.083, 0.001, 0.083], position = [0.0, 0.5, 0.0])]
    upper: Body,
    #[body(
        mass = 0.5,
        inertia = [0.02, 0.001, 0.02],
        position = [0.0, 1.25, 0.0],
        velocity = [0.0, 0.0, -0.375],
        angular_velocity = [-1.5, 0.0, 0.0]
    )]
    lower: Body,
    #[joint(between = [ground, upper], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    shoulder: Revolute,
    #[joint(
        between = [upper, lower], point = [0.0, 1.0, 0.0], axis = [-1.0, 0.0, 0.0],
        limits = [-0.4, 0.4], restitution = 0.7
    )]
    elbow: Revolute,
    #[force(
        between = [ground, upper],
        axis = [1.0, 0.0, 0.0],
        moment = 0.8 * current - damping * rate
    )]
    motor: TorsionalActuator,
}

/// A variable of a unit, and the same of our own run.
type Column<M> = (&'static str, fn(&Sample<'_, f64, M>) -> f64);

/// Writes `name.fmu`, and `name.csv` of our own run with 101 instants; how many impacts it has.
fn write<M, F>(
    folder: &Path,
    unit: Fmu<M, Relative>,
    mechanism: &M,
    (formulation, end): (F, f64),
    columns: &[Column<M>],
) -> Result<usize, Box<dyn Error>>
where
    M: JointCoordinates + Clone,
    Relative: TracedCoordinates<M>,
    F: Formulation<f64>,
{
    let name = M::REPORT.name.to_lowercase();
    let written = unit
        .named(&name)
        .write(folder.join(format!("{name}.fmu")))?;
    let names: Vec<&str> = columns.iter().map(|(name, _)| *name).collect();
    let mut lines = format!("time,{}\n", names.join(","));
    let tight = Tolerance {
        relative: 1e-11,
        absolute: 1e-11,
    };
    let (mut impacts, mut last) = (0, f64::NAN);
    mechanism
        .simulation(formulation, DormandPrince::new(tight))
        .joint_coordinates()
        .run(0.0..=end, every(end / 100.0), |sample| {
            // A run is shown before and after impacts as well.
            impacts += usize::from(sample.time() == last);
            last = sample.time();
            let periods = sample.time() / end * 100.0;
            if (periods - periods.round()).abs() > 1e-9 {
                return;
            }
            let numbers = columns.iter().map(|(_, read)| read(sample));
            let numbers: Vec<String> = numbers.map(|number| format!("{number:?}")).collect();
            lines += &format!("{:?},{}\n", sample.time(), numbers.join(","));
        })?;
    fs::write(folder.join(format!("{name}.csv")), lines)?;
    println!(
        "{name}: {}, {impacts} impacts",
        written.platform.as_deref().unwrap_or("sources alone")
    );
    Ok(impacts)
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder: PathBuf = std::env::args().nth(1).ok_or("say a folder")?.into();
    fs::create_dir_all(&folder)?;

    let mut arm = Arm::new(0.2)?;
    arm.voltage = 2.0;
    let unit = Fmu::<Arm, Relative>::new(&arm, StandardLagrange)
        .about("damping", "torque for a rate (N m s/rad)")
        .about("voltage", "voltage on the motor (V)")
        .reading("height", "height of the lower link (m)", |view| {
            view.position(Arm::HANDLES.lower).z
        });
    let impacts = write(
        &folder,
        unit,
        &arm,
        (StandardLagrange, 2.0),
        &[
            ("shoulder_angle", |view| view.angle(Arm::HANDLES.shoulder)),
            ("shoulder_rate", |view| {
                view.angle_rate(Arm::HANDLES.shoulder)
            }),
            ("elbow_angle", |view| view.angle(Arm::HANDLES.elbow)),
            ("elbow_rate", |view| view.angle_rate(Arm::HANDLES.elbow)),
            ("current", |view| view.state_value(Arm::HANDLES.current)),
            ("height", |view| view.position(Arm::HANDLES.lower).z),
        ],
    )?;
    // A joint that was not within its limits again since an impact would rest at the next one.
    if impacts < 2 {
        return Err("an arm bounces at its limits more than once".into());
    }

    let mut cart = CartPole::default();
    cart.push = 1.0;
    let unit = Fmu::<CartPole, Relative>::new(&cart, StandardLagrange)
        .about("push", "force on the cart along x (N)")
        .reading("x", "of the pole (m)", |view| {
            view.position(CartPole::HANDLES.pole).x
        });
    write(
        &folder,
        unit,
        &cart,
        (StandardLagrange, 2.0),
        &[
            ("rail_position", |view| {
                view.displacement(CartPole::HANDLES.rail)
            }),
            ("hinge_angle", |view| view.angle(CartPole::HANDLES.hinge)),
            ("hinge_rate", |view| {
                view.angle_rate(CartPole::HANDLES.hinge)
            }),
            ("x", |view| view.position(CartPole::HANDLES.pole).x),
        ],
    )?;

    let (bars, baumgarte) = (FourBar::default(), Baumgarte::default());
    let unit = Fmu::<FourBar, Relative>::new(&bars, baumgarte).reading(
        "energy",
        "kinetic and potential energy (J)",
        |view| view.kinetic_energy() + view.potential_energy(),
    );
    // Before all links lie on one line.
    write(
        &folder,
        unit,
        &bars,
        (baumgarte, 0.5),
        &[
            ("left_foot_angle", |view| {
                view.angle(FourBar::HANDLES.left_foot)
            }),
            ("right_foot_angle", |view| {
                view.angle(FourBar::HANDLES.right_foot)
            }),
            ("energy", |view| {
                view.kinetic_energy() + view.potential_energy()
            }),
        ],
    )?;

    let mut robot = Ur5::default();
    (robot.lift_torque, robot.elbow_torque) = (-60.0, -20.0);
    let unit = Fmu::<Ur5, Relative>::new(&robot, StandardLagrange);
    write(
        &folder,
        unit,
        &robot,
        (StandardLagrange, 1.0),
        &[
            ("pan_angle", |view| view.angle(Ur5::HANDLES.pan)),
            ("lift_angle", |view| view.angle(Ur5::HANDLES.lift)),
            ("elbow_angle", |view| view.angle(Ur5::HANDLES.elbow)),
            ("wrist_2_rate", |view| view.angle_rate(Ur5::HANDLES.wrist_2)),
        ],
    )?;

    let top = HeavyTop::default();
    let unit = Fmu::<HeavyTop, Relative>::new(&top, StandardLagrange)
        .internal_step(1e-4)
        .reading("height", "height of the top (m)", |view| {
            view.position(HeavyTop::HANDLES.top).z
        });
    write(
        &folder,
        unit,
        &top,
        (StandardLagrange, 0.2),
        &[("height", |view| view.position(HeavyTop::HANDLES.top).z)],
    )?;
    Ok(())
}

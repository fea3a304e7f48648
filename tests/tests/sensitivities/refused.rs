//! Starts whose derivatives would open a joint.

use holonom::Forward;
use holonom::error::{AnalysisFault, AssemblyFault, StartFault};
use holonom::prelude::*;

/// A pendulum whose bob hangs at a parameter's length.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both", kernels = [mass])]
pub(super) struct Rod {
    #[param]
    length: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, length, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[joint(between = [ground, other], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    spindle: Revolute,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.3, 0.0])]
    other: Body,
}

type Lifted = Forward<f64, 1>;

/// A state of plain numbers stays where it is when the length changes, and the hinge opens.
#[test]
fn a_start_that_does_not_follow() -> Result<(), Fault> {
    let (rod, h) = (Rod::new(1.0)?, Rod::HANDLES);
    let along = rod.sensitivities([h.length])?;
    let mut plain = along.start();
    for number in plain.coordinates_mut() {
        *number = Lifted::fixed(number.value());
    }
    let run = |along: holonom::sensitivity::Sensitivities<Rod, 1>| {
        along
            .simulation(StandardLagrange, Rk4::every(0.01))
            .run(0.0..=0.1, every(0.1), |_| ())
            .map_err(|error| error.fault)
    };
    assert!(run(along).is_ok());
    let refused = run(along.initial_state(plain));
    let Err(fault) = refused else {
        panic!("accepted: {refused:?}")
    };
    assert!(matches!(
        fault,
        Fault::Start(StartFault::DirectionOpens {
            joint: "hinge",
            direction: 0,
            ..
        })
    ));
    // Nor are derivatives accepted that are none.
    let mut start = along.start();
    start.coordinates_mut()[1] = Lifted::new(start.coordinates()[1].value(), [f64::NAN]);
    assert!(run(along.initial_state(start)).is_err());
    // By joints the space finds them.
    let space = rod.coordinates([h.hinge, h.spindle])?;
    let start = space.state([0.4, 0.0], [0.0, 0.0])?;
    let found = space.sensitivities(&start, [h.length.into()])?;
    let [slope] = found.start().coordinates()[1].derivatives();
    assert!((slope - 0.4_f64.cos()).abs() < 1e-14);
    assert!(run(found).is_ok());
    Ok(())
}

/// A body on a hinge whose axis is a parameter: it stands where it is, and the hinge turns with it.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both", kernels = [mass])]
struct Aslant {
    #[param]
    a: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.2, 0.15], position = [0.3, 0.4, 0.1])]
    body: Body,
    #[joint(between = [ground, body], point = [0.0, 0.0, 0.0], axis = [a, 0.3, 1.0])]
    hinge: Revolute,
}

/// Terms that cancel leave round-off, which is no opening.
#[test]
fn an_axis_as_a_parameter() -> Result<(), Box<dyn std::error::Error>> {
    let h = Aslant::HANDLES;
    for a in [0.0, 0.2, 0.37] {
        let end = |a: f64, is_by_joints: bool| {
            let (body, mut angle) = (Aslant::new(a)?, 0.0);
            let simulation = body.simulation(StandardLagrange, Rk4::every(1e-3));
            let observe = |sample: &Sample<'_, f64, Aslant>| angle = sample.angle(h.hinge);
            if is_by_joints {
                let _ = simulation
                    .joint_coordinates()
                    .run(0.0..=0.5, every(0.5), observe)?;
            } else {
                let _ = simulation.run(0.0..=0.5, every(0.5), observe)?;
            }
            Ok::<_, Box<dyn std::error::Error>>(angle)
        };
        let along = Aslant::new(a)?.sensitivities([h.a])?;
        let simulation = along.simulation(StandardLagrange, Rk4::every(1e-3));
        for is_by_joints in [false, true] {
            let mut found = Lifted::fixed(0.0);
            let observe = |sample: &Sample<'_, Lifted, Aslant>| found = sample.angle(h.hinge);
            if is_by_joints {
                let along = along.simulation(StandardLagrange, Rk4::every(1e-3));
                let _ = along
                    .joint_coordinates()
                    .run(0.0..=0.5, every(0.5), observe)?;
            } else {
                let _ = simulation.run(0.0..=0.5, every(0.5), observe)?;
            }
            let step = 1e-5;
            let [after, before] = [end(a + step, is_by_joints)?, end(a - step, is_by_joints)?];
            let [slope] = found.derivatives();
            assert!(
                (slope - (after - before) / (2.0 * step)).abs() < 1e-7,
                "{slope}"
            );
        }
    }
    Ok(())
}

/// A direction that is not among the chosen coordinates.
#[test]
fn a_coordinate_that_follows() -> Result<(), Fault> {
    use holonom::independent::Direction;
    use holonom_models::FourBar;
    let (bar, h) = (FourBar::default(), FourBar::HANDLES);
    let space = bar.coordinates([h.left_foot])?;
    let start = space.state([0.4], [2.0])?;
    let refused = space.sensitivities(&start, [Direction::position(h.right_foot)]);
    assert!(matches!(
        refused.err(),
        Some(
            Fault::Analysis(AnalysisFault::NotChosen { .. })
                | Fault::Assembly(AssemblyFault::CarriesNothing { .. })
        )
    ));
    Ok(())
}

//! The equations of motion of robots in the coordinates of their joints, against Pinocchio.

use holonom::independent::{Chosen, IndependentCoordinates};
use holonom::mechanism::{HasCoriolis, HasGravity, HasInverse, HasJacobian, HasMassMatrix};
use holonom::nalgebra::{SMatrix, SVector};
use holonom::prelude::*;
use holonom::{BodyHandle, Fault};
use serde::Deserialize;

use super::{by_name, in_place, motion};

/// In the coordinates of the joints that mimic none, with the Jacobian of the last body's centre of
/// mass: kg, m, rad, s, N.
#[derive(Deserialize)]
pub(crate) struct Reference {
    mass: Vec<Vec<f64>>,
    gravity: Vec<f64>,
    coriolis: Vec<f64>,
    bias: Vec<f64>,
    jacobian: Vec<Vec<f64>>,
    jacobian_rate: Vec<Vec<f64>>,
    pub(crate) regressor: Option<Regressor>,
}

/// Efforts by the inertial parameters of the joints' bodies, ten a body, about the origin of the
/// joint; beside it the centres of mass (m) from there, in the axes of the link.
#[derive(Deserialize)]
pub(crate) struct Regressor {
    pub(crate) levers: Vec<[f64; 3]>,
    pub(crate) rows: Vec<Vec<f64>>,
}

/// Of the largest entry.
const LIMIT: f64 = 1e-13;

pub(crate) fn matrix<const R: usize, const C: usize>(rows: &[Vec<f64>]) -> SMatrix<f64, R, C> {
    assert_eq!((rows.len(), rows[0].len()), (R, C));
    SMatrix::from_fn(|row, column| rows[row][column])
}

pub(crate) fn close<const R: usize, const C: usize>(
    what: &str,
    found: SMatrix<f64, R, C>,
    wanted: SMatrix<f64, R, C>,
) {
    let error = (found - wanted).amax() / wanted.amax().max(f64::MIN_POSITIVE);
    println!("{what}: {error:.1e}");
    assert!(error < LIMIT, "{what}: {error:.1e}, {found} for {wanted}");
}

/// Everything at all states of a robot; `N` joints mimic none.
fn agrees<M, const N: usize>(
    robot: &str,
    chosen: impl Chosen<M, N> + Copy,
    last: BodyHandle<M>,
    names: [&str; N],
) -> Result<(), Fault>
where
    M: HasMassMatrix + HasInverse + HasGravity + HasCoriolis + HasJacobian + Default,
{
    let arm = M::default();
    let space: IndependentCoordinates<M, N> = arm.coordinates(chosen)?;
    let motion = motion(robot);
    for given in &motion.states {
        let wanted = given.equations.as_ref().expect("they are there");
        let of_all = |values: &[f64]| {
            let values = by_name(&motion.joints, values);
            SVector::from(names.map(|name| values[name]))
        };
        let (positions, rates) = (of_all(&given.positions), of_all(&given.rates));
        let accelerations = of_all(&given.accelerations);
        let state = space.state(positions, rates)?;
        let [back, rates_back] = [space.positions(&state)?, space.rates(&state)];
        let errors = [(back - positions).amax(), (rates_back - rates).amax()];
        assert!(errors.iter().all(|error| *error < 1e-14), "{errors:?}");
        let efforts = SVector::<f64, N>::from_column_slice(&given.efforts);
        close("M", space.mass(&state)?, matrix(&wanted.mass));
        let vector = |values: &[f64]| SVector::<f64, N>::from_column_slice(values);
        close("h", space.bias(&state)?, vector(&wanted.bias));
        close("g", space.gravity(&state)?, vector(&wanted.gravity));
        close("C v", space.coriolis(&state)?, vector(&wanted.coriolis));
        close("J", space.jacobian(&state, last)?, matrix(&wanted.jacobian));
        let rate = space.jacobian_rate(&state, last)?;
        close("J'", rate, matrix(&wanted.jacobian_rate));
        close("f", space.inverse(&state, accelerations)?, efforts);
        close("a", space.forward(&state, efforts)?, accelerations);
    }
    Ok(())
}

#[test]
fn ur5() -> Result<(), Fault> {
    let h = in_place::Ur5::HANDLES;
    agrees(
        "ur5",
        [
            h.shoulder_pan_joint,
            h.shoulder_lift_joint,
            h.elbow_joint,
            h.wrist_1_joint,
            h.wrist_2_joint,
            h.wrist_3_joint,
        ],
        h.wrist_3_link,
        [
            "shoulder_pan_joint",
            "shoulder_lift_joint",
            "elbow_joint",
            "wrist_1_joint",
            "wrist_2_joint",
            "wrist_3_joint",
        ],
    )
}

/// With a finger that follows another by an equation, and damping in all joints.
#[test]
fn panda() -> Result<(), Fault> {
    let h = in_place::Panda::HANDLES;
    agrees(
        "panda",
        (
            h.panda_joint1,
            h.panda_joint2,
            h.panda_joint3,
            h.panda_joint4,
            h.panda_joint5,
            h.panda_joint6,
            h.panda_joint7,
            h.panda_finger_joint1,
        ),
        h.panda_rightfinger,
        [
            "panda_joint1",
            "panda_joint2",
            "panda_joint3",
            "panda_joint4",
            "panda_joint5",
            "panda_joint6",
            "panda_joint7",
            "panda_finger_joint1",
        ],
    )
}

#[test]
fn so100() -> Result<(), Fault> {
    let h = in_place::SoArm100::HANDLES;
    agrees(
        "so100",
        [
            h.shoulder_pan,
            h.shoulder_lift,
            h.elbow_flex,
            h.wrist_flex,
            h.wrist_roll,
            h.gripper_joint,
        ],
        h.jaw,
        [
            "shoulder_pan",
            "shoulder_lift",
            "elbow_flex",
            "wrist_flex",
            "wrist_roll",
            "gripper",
        ],
    )
}

#[test]
fn double_pendulum() -> Result<(), Fault> {
    let h = in_place::Robot2dofPlanar::HANDLES;
    agrees(
        "double_pendulum",
        [h.joint1, h.joint2],
        h.link2,
        ["joint1", "joint2"],
    )
}

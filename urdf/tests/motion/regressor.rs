//! Regressors of inverse dynamics, against Pinocchio.

use holonom::independent::Chosen;
use holonom::mechanism::HasJacobian;
use holonom::nalgebra::{Matrix3, SMatrix, SVector, Vector3};
use holonom::prelude::*;
use holonom::{BodyHandle, Fault};

use super::equations::{close, matrix};
use super::{by_name, in_place, motion};

/// Pinocchio's parameters of a body by ours: its point of reference is the origin of the joint, at
/// `-c` from the described centre of mass, and its tensor is in the order xx, xy, yy, xz, yz, zz.
fn about_joint(c: Vector3<f64>) -> SMatrix<f64, 10, 10> {
    let columns: [SVector<f64, 10>; 10] = core::array::from_fn(|place| {
        let unit = |of: usize| f64::from(u8::from(place == of));
        let (mass, moment) = (unit(0), Vector3::from([1, 2, 3].map(unit)));
        let [xx, yy, zz, xy, xz, yz] = [4, 5, 6, 7, 8, 9].map(unit);
        let outwards = 2.0 * moment.dot(&c) + mass * c.norm_squared();
        let tensor = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
            + Matrix3::from_diagonal_element(outwards)
            - mass * c * c.transpose()
            - moment * c.transpose()
            - c * moment.transpose();
        let moment = moment + mass * c;
        let entries = [(0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2)].map(|at| tensor[at]);
        let mut column = SVector::<f64, 10>::zeros();
        column[0] = mass;
        column.fixed_rows_mut::<3>(1).copy_from(&moment);
        column.fixed_rows_mut::<6>(4).copy_from_slice(&entries);
        column
    });
    SMatrix::from_columns(&columns)
}

/// All blocks at the states that have a reference; bodies in the order of the joints.
fn agrees<M: HasJacobian + Default, const N: usize, const B: usize>(
    robot: &str,
    chosen: impl Chosen<M, N>,
    bodies: [BodyHandle<M>; B],
    names: [&str; N],
) -> Result<(), Fault> {
    let arm = M::default();
    let space = arm.coordinates(chosen)?;
    let motion = motion(robot);
    let mut count = 0;
    for given in &motion.states {
        let equations = given.equations.as_ref().expect("they are there");
        let Some(wanted) = &equations.regressor else {
            continue;
        };
        let of_all = |values: &[f64]| {
            let values = by_name(&motion.joints, values);
            SVector::from(names.map(|name| values[name]))
        };
        let state = space.state(of_all(&given.positions), of_all(&given.rates))?;
        let blocks = space.regressors(&state, of_all(&given.accelerations), bodies)?;
        assert_eq!(wanted.levers.len(), B);
        for (number, (block, lever)) in blocks.into_iter().zip(&wanted.levers).enumerate() {
            let rows: Vec<Vec<f64>> = wanted
                .rows
                .iter()
                .map(|row| row[10 * number..][..10].to_vec())
                .collect();
            let of_joint: SMatrix<f64, N, 10> = matrix(&rows);
            close(
                bodies[number].name(),
                block,
                of_joint * about_joint((*lever).into()),
            );
        }
        count += 1;
    }
    assert_eq!(count, 2);
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
        [
            h.shoulder_link,
            h.upper_arm_link,
            h.forearm_link,
            h.wrist_1_link,
            h.wrist_2_link,
            h.wrist_3_link,
        ],
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

/// With a finger that follows another by an equation.
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
        [
            h.panda_link1,
            h.panda_link2,
            h.panda_link3,
            h.panda_link4,
            h.panda_link5,
            h.panda_link6,
            h.panda_link7,
            h.panda_leftfinger,
            h.panda_rightfinger,
        ],
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

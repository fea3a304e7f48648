"""Derivatives of forward dynamics by Pinocchio: `derivatives_reference.rs`.

    pip install pin==4.1.0 example-robot-data-loaders==5.0.0
    python3 derivatives_reference.py > derivatives_reference.rs
"""
import numpy as np
import pinocchio as pin
from example_robot_data import load

LOCKED = {"ur5": [], "panda": ["panda_finger_joint1", "panda_finger_joint2"]}
print("//! Written by `derivatives_reference.py`.\n\n#![allow(clippy::unreadable_literal, reason = \"numbers as they were printed\")]\n")
for name, locked in LOCKED.items():
    robot = load(name)
    places = [robot.model.getJointId(joint) for joint in locked]
    model = pin.buildReducedModel(robot.model, places, pin.neutral(robot.model))
    data, n = model.createData(), model.nv
    q = np.array([0.3 + 0.2 * k for k in range(n)])
    v = np.array([0.5 - 0.3 * k for k in range(n)])
    tau = np.array([2.0 - 0.7 * k for k in range(n)])
    pin.computeABADerivatives(model, data, q, v, tau)
    inverse = np.triu(data.Minv) + np.triu(data.Minv, 1).T
    for what, matrix in [("POSITIONS", data.ddq_dq), ("RATES", data.ddq_dv), ("EFFORTS", inverse)]:
        rows = ", ".join("[" + ", ".join(repr(float(x)) for x in row) + "]" for row in matrix)
        print(f"pub(super) const {name.upper()}_BY_{what}: [[f64; {n}]; {n}] = [{rows}];")

"""Splines by SciPy, and the inverse dynamics of a recorded motion of the UR5 by Pinocchio.

    python tests/tests/tables/reference.py > tests/tests/tables/data.rs && rustfmt tests/tests/tables/data.rs

Written with SciPy 1.17 and Pinocchio 4.1 (the package `pin`), from the folder of the workspace.
"""

import numpy as np
import pinocchio
from scipy.interpolate import CubicSpline, PchipInterpolator

KNOTS = np.array([0.0, 0.3, 1.1, 1.4, 2.2, 3.0])
VALUES = np.array([0.2, 1.0, 0.7, 0.9, 2.0, 0.2])
AT = np.array([0.0, 0.25, 0.3, 1.3, 2.2, 2.9])


def array(name, values):
    values = np.asarray(values)
    kind = "f64"
    for size in reversed(values.shape):
        kind = f"[{kind}; {size}]"
    text = np.array2string(values, separator=", ", formatter={"float_kind": lambda x: repr(float(x))}, threshold=10**6)
    print(f"pub(super) const {name}: {kind} = {text};\n")


def orders(spline, at, count=3):
    return [[float(spline(x, k)) for k in range(count)] for x in at]


print("//! Values by SciPy and Pinocchio: `reference.py` writes this file.\n")
array("KNOTS", KNOTS)
array("VALUES", VALUES)
array("AT", AT)
array("NATURAL", orders(CubicSpline(KNOTS, VALUES, bc_type="natural"), AT))
array("CLAMPED", orders(CubicSpline(KNOTS, VALUES, bc_type=((1, 0.5), (1, -0.25))), AT))
array("PERIODIC", orders(CubicSpline(KNOTS, VALUES, bc_type="periodic"), AT))
array("THREE_POINTS", orders(CubicSpline([0, 1, 3], [1, 4, 1], bc_type="periodic"), [0.5, 2.5]))
# The second derivative jumps: SciPy takes the piece behind a knot, too.
array("MONOTONE", orders(PchipInterpolator(KNOTS, VALUES), AT))

# A cam of 36 points a turn (m): dwell, rise, dwell, return, in thousandths of a millimetre as a
# measuring machine gives them.
angles = np.linspace(0, 2 * np.pi, 37)
rise = lambda s: s**3 * (10 - 15 * s + 6 * s**2)
up = rise(np.clip((angles - 0.7) / 1.8, 0, 1))
down = rise(np.clip((angles - 3.6) / 2.0, 0, 1))
lift = np.round(0.03 * (up - down), 6)
lift[-1] = lift[0]
cam = CubicSpline(angles, lift, bc_type="periodic")
array("LIFT", lift)
times = np.array([0.0, 0.31, 0.55, 0.8, 1.03, 1.4, 1.9, 2.2])
turned = np.mod(4.0 * times, 2 * np.pi)
array("CAM_TIMES", times)
array("CAM", [[float(cam(x)), 4.0 * float(cam(x, 1)), 16.0 * float(cam(x, 2))] for x in turned])

# The arm: angles that begin and end at rest, recorded at 41 times.
model = pinocchio.buildModelFromUrdf("urdf/tests/data/robots/ur5.urdf")
data = model.createData()
model.gravity.linear = np.array([0.0, 0.0, -9.81])
recorded = np.linspace(0.0, 2.0, 41)
sizes = np.array([0.8, -0.6, 0.9, 0.5, -1.1, 1.4])
shares = np.array([1.0, 1.0, 0.7, 1.3, 0.9, 1.1])
wave = lambda t, share: (1 - np.cos(np.pi * t)) / 2 * (1 + 0.3 * share * np.sin(2 * np.pi * share * t))
angles = np.round(np.array([size * wave(recorded, share) for size, share in zip(sizes, shares)]), 9)
splines = [CubicSpline(recorded, row, bc_type=((1, 0.0), (1, 0.0))) for row in angles]
array("RECORDED", angles)
times = np.linspace(0.0, 2.0, 11)
motion = [[np.array([float(s(t, k)) for s in splines]) for k in range(3)] for t in times]
array("TIMES", times)
array("EFFORTS", [pinocchio.rnea(model, data, *m) for m in motion])

# Its links where all angles are zero, in global axes; moments of inertia about centres of mass.
pinocchio.forwardKinematics(model, data, np.zeros(6))
places, links = list(data.oMi)[1:], list(model.inertias)[1:]
array("MASSES", [link.mass for link in links])
array("CENTRES", [place.act(link.lever) for place, link in zip(places, links)])
turned = [place.rotation @ link.inertia @ place.rotation.T for place, link in zip(places, links)]
assert max(np.abs(moments - np.diag(np.diag(moments))).max() for moments in turned) < 1e-11
array("MOMENTS", [np.diag(moments) for moments in turned])
array("POINTS", [place.translation for place in places])
jacobian = pinocchio.computeJointJacobians(model, data, np.zeros(6))
array("AXES", jacobian[3:].T)

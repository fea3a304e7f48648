"""The gain of `runtime/examples/lqr.rs`, from its equations by hand and by SciPy: `regulator.rs`.

    pip install numpy scipy
    python regulator.py
"""

import numpy as np
from scipy.linalg import solve_discrete_are
from scipy.signal import cont2discrete

mass = np.array([[1.2, -0.06], [-0.06, 0.006 + 0.2 * 0.3**2]])
by_positions = np.linalg.solve(mass, np.diag([0.0, 0.2 * 9.81 * 0.3]))
by_push = np.linalg.solve(mass, np.array([[1.0], [0.0]]))
a = np.block([[np.zeros((2, 2)), np.eye(2)], [by_positions, np.zeros((2, 2))]])
b = np.vstack([np.zeros((2, 1)), by_push])
a, b, *_ = cont2discrete((a, b, np.eye(4), np.zeros((4, 1))), 1e-3)
q, r = np.diag([10.0, 100.0, 1.0, 1.0]), np.array([[0.1]])
p = solve_discrete_are(a, b, q, r)
k = np.linalg.solve(r + b.T @ p @ b, b.T @ p @ a)
print("A", a.tolist(), "\nB", b.ravel().tolist(), "\nK", k.ravel().tolist())

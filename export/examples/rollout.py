"""Rolls out many UR5 arms on a GPU: each falls from a start of its own, with a brake on every joint.

    cargo run --package holonom-export --example rollout -- FOLDER
    python3 rollout.py FOLDER

It needs a GPU of NVIDIA and CuPy. Nothing in continuous integration runs it.
"""

import re
import sys
from pathlib import Path

import cupy as cp
import numpy as np

FEEDBACK = """
#include "ur5.h"
/* A brake on every joint: a torque (N m) against its rate (rad/s). */
static UR5_FUNCTION void brake(const ur5_state *state, ur5_inputs *inputs)
{
    ur5_joints joints;
    ur5_get_joints(state, &joints);
    inputs->pan_torque = -5.0f * joints.pan_rate;
    inputs->lift_torque = -5.0f * joints.lift_rate;
    inputs->elbow_torque = -5.0f * joints.elbow_rate;
    inputs->wrist_1_torque = -0.5f * joints.wrist_1_rate;
    inputs->wrist_2_torque = -0.5f * joints.wrist_2_rate;
    inputs->wrist_3_torque = -0.5f * joints.wrist_3_rate;
}
#define UR5_FEEDBACK(constants, state, inputs, world, step) brake(state, inputs)
#include "ur5_rollout.cu"
"""

folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
worlds, steps, every = 1 << 20, 1000, 500
rows = int(re.search(r"ROLLOUT_STATE (\d+)", (folder / "ur5_rollout.cu").read_text())[1])

module = cp.RawModule(code=FEEDBACK, options=(f"-I{folder.resolve()}",))
launch = ((worlds + 127) // 128,), (128,)
# Counts are numbers of 8 bytes, as an address of 0 is.
count, none = np.uint64, np.uint64(0)

states = cp.empty((rows, worlds), cp.float32)
module.get_function("ur5_rollout_init")(*launch, (count(worlds), states))
# The rates are the last numbers of a state, in the order of ur5.h.
states[-6:] += cp.random.uniform(-0.5, 0.5, (6, worlds), dtype=cp.float32)
results = cp.empty((steps // every, rows, worlds), cp.float32)
taken, statuses = cp.empty(worlds, cp.uint64), cp.empty(worlds, cp.int32)

begin, end = cp.cuda.Event(), cp.cuda.Event()
begin.record()
module.get_function("ur5_rollout")(
    *launch,
    (count(worlds), count(steps), np.float32(1e-3), none, none, none, states, count(every), results, taken, statuses),
)
end.record()
end.synchronize()
nanoseconds = 1e6 * cp.cuda.get_elapsed_time(begin, end)
print(f"{nanoseconds / (worlds * steps):.4f} ns a step of Runge-Kutta and arm")
print(f"{int((statuses != 0).sum())} of {worlds} arms stopped; times {float(states[0].min())} to {float(states[0].max())} s")

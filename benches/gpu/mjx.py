"""What a step of a UR5 takes by MJX, in rows like those of `arm.py`, which is run before it.

    python3 mjx.py FOLDER UR5.urdf           on the GPU, by JAX
    python3 mjx.py FOLDER UR5.urdf --host    only compares the arm

FOLDER has `arm.npz`. The arm is compared with it first, by a run of MuJoCo.
"""

import sys
import time
import xml.etree.ElementTree as xml
from importlib.metadata import version
from pathlib import Path

import mujoco
import numpy as np

# Steps of MJX take longer than those of a rollout, and are alike.
STEPS = 100
METHODS = {"Euler": mujoco.mjtIntegrator.mjINT_EULER, "Runge-Kutta": mujoco.mjtIntegrator.mjINT_RK4}


def described(path, integrator, dt):
    """The arm without shapes, constraints and limits: what `arm.py` computes."""
    robot = xml.parse(path).getroot()
    for link in robot.iter("link"):
        for shape in [*link.findall("visual"), *link.findall("collision")]:
            link.remove(shape)
    model = mujoco.MjModel.from_xml_string(xml.tostring(robot, encoding="unicode"))
    model.opt.timestep, model.opt.integrator = dt, integrator
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    return model


def is_the_same(model, known):
    """Whether MuJoCo ends where a rollout does."""
    for start, end in zip(known["start"][:4], known["end"][:4]):
        data = mujoco.MjData(model)
        data.qpos[:], data.qvel[:] = start[0::2], start[1::2]
        for _ in range(int(known["steps"])):
            mujoco.mj_step(model, data)
        turned = data.qpos - end[0::2]
        away = [np.abs(np.arctan2(np.sin(turned), np.cos(turned))).max(), np.abs(data.qvel - end[1::2]).max()]
        if not max(away) < 1e-6:
            return False
    return True


def spent(model, worlds):
    """What a step takes (ns), of so many arms with rates of their own."""
    import jax
    from mujoco import mjx

    if jax.default_backend() != "gpu":
        raise RuntimeError("JAX has no GPU")
    of_jax, data = mjx.put_model(model), mjx.make_data(model)
    rates = jax.random.uniform(jax.random.key(1), (worlds, model.nv), minval=-1.0, maxval=1.0)
    arms = jax.vmap(lambda rates: data.replace(qvel=rates))(rates)

    def rolled(arm):
        return jax.lax.scan(lambda arm, _: (mjx.step(of_jax, arm), None), arm, None, length=STEPS)[0]

    roll = jax.jit(jax.vmap(rolled)).lower(arms).compile()
    times = []
    for _ in range(3):
        begun = time.perf_counter_ns()
        jax.block_until_ready(roll(arms))
        times.append(time.perf_counter_ns() - begun)
    return min(times) / (worlds * STEPS)


def main():
    folder, urdf = Path(sys.argv[1]), sys.argv[2]
    known = np.load(folder / "arm.npz")
    arms = {method: described(urdf, number, float(known["dt"])) for method, number in METHODS.items()}
    if not is_the_same(arms["Runge-Kutta"], known):
        sys.exit("the arm of the URDF file does not move as that of the rollout")
    if "--host" in sys.argv:
        print("the arm moves as that of MuJoCo")
        return
    for method, arm in arms.items():
        row = f"MJX {version('mujoco-mjx')}, step of {method}, float32"
        print(f"{row:44}", end="", flush=True)
        for worlds in known["batches"]:
            try:
                took = f"{spent(arm, int(worlds)):.4g}"
            except Exception as error:  # Out of memory, most of all.
                took = "-"
                print(error, file=sys.stderr)
            print(f"{took:>11}", end="", flush=True)
        print()


main()

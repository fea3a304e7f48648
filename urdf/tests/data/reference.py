"""What Pinocchio knows of the robots in this folder: writes `reference.json`.

    pip install pin        (numbers are those of 4.1.0)
    python reference.py

Lengths in m, masses in kg, angles in rad, all in global axes with all joints at zero. Efforts of
damping are added to what Pinocchio computes. A joint that mimics is put on its leader by the chain
rule: the mass matrix and the generalised forces are projected.
"""

import json
import pathlib
import xml.etree.ElementTree as ElementTree

import numpy as np
import pinocchio as pin

HERE = pathlib.Path(__file__).parent
DYNAMICS = ["ur5", "panda", "so100", "double_pendulum"]
REGRESSORS = ["ur5", "panda"]


def load(path):
    model = pin.buildModelFromUrdf(str(path))
    damping, mimics = {}, {}
    for joint in ElementTree.parse(path).getroot().findall("joint"):
        dynamics, mimic = joint.find("dynamics"), joint.find("mimic")
        if dynamics is not None:
            damping[joint.get("name")] = float(dynamics.get("damping", 0.0))
        if mimic is not None:
            mimics[joint.get("name")] = (mimic.get("joint"), float(mimic.get("multiplier", 1.0)))
    return model, damping, mimics


def singles(model):
    """Joints with one coordinate, and the places of their rates."""
    all_joints = range(1, model.njoints)
    return {model.names[i]: model.joints[i].idx_v for i in all_joints if model.joints[i].nv == 1}


def configuration(model):
    data = model.createData()
    rest = pin.neutral(model)
    pin.computeJointJacobians(model, data, rest)
    pin.updateFramePlacements(model, data)
    bodies, joints = [], []
    for i in range(1, model.njoints):
        place, inertia = data.oMi[i], model.inertias[i]
        turned = place.rotation @ inertia.inertia @ place.rotation.T
        bodies.append(
            {
                "joint": model.names[i],
                "mass": inertia.mass,
                "centre": (place * inertia.lever).tolist(),
                "inertia": turned.tolist(),
            }
        )
        if model.joints[i].nv == 1:
            column = data.J[:, model.joints[i].idx_v]
            is_turn = bool(np.linalg.norm(column[3:]) > 0.5)
            axis = column[3:] if is_turn else column[:3]
            point = place.translation.tolist()
            joints.append({"name": model.names[i], "point": point, "axis": axis.tolist()})
    frames = [
        {
            "link": frame.name,
            "origin": data.oMf[place].translation.tolist(),
            "rotation": data.oMf[place].rotation.tolist(),
        }
        for place, frame in enumerate(model.frames)
        if frame.type == pin.FrameType.BODY
    ]
    ground = model.inertias[0].mass
    return {"ground_mass": ground, "bodies": bodies, "joints": joints, "frames": frames}


def leaders(model, mimics):
    """The joints that follow none, and the rates of all by the rates of these."""
    names = [name for name in singles(model) if name not in mimics]
    rest = [v for v in range(model.nv) if v not in singles(model).values()]
    chain = np.zeros((model.nv, len(names) + len(rest)))
    for column, name in enumerate(names):
        chain[singles(model)[name], column] = 1.0
    for column, v in enumerate(rest):
        chain[v, len(names) + column] = 1.0
    for follower, (leader, multiplier) in mimics.items():
        chain[singles(model)[follower], names.index(leader)] = multiplier
    return names, chain


def accelerations(model, damping, chain, q, rates, efforts):
    """Accelerations of the joints that follow none. `efforts` are on these."""
    data = model.createData()
    mass = pin.crba(model, data, q)
    mass = np.triu(mass) + np.triu(mass, 1).T
    bias = pin.rnea(model, data, q, rates, np.zeros(model.nv))
    for name, v in singles(model).items():
        bias[v] += damping.get(name, 0.0) * rates[v]
    return np.linalg.solve(chain.T @ mass @ chain, efforts - chain.T @ bias)


def point_jacobian(model, data, body, q, rates):
    """Of the centre of mass of a joint's body, in global axes, and its rate: rows of the velocity,
    then of the angular velocity."""
    pin.computeJointJacobiansTimeVariation(model, data, q, rates)
    pin.forwardKinematics(model, data, q, rates)
    aligned = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    jacobian = pin.getJointJacobian(model, data, body, aligned)
    rate = pin.getJointJacobianTimeVariation(model, data, body, aligned)
    arm = data.oMi[body].rotation @ model.inertias[body].lever
    turning = np.cross(jacobian[3:] @ rates, arm)
    jacobian[:3] -= pin.skew(arm) @ jacobian[3:]
    rate[:3] -= pin.skew(arm) @ rate[3:] + pin.skew(turning) @ jacobian[3:]
    return jacobian, rate


def equations(model, damping, chain, q, rates):
    """In the coordinates of the joints that follow none."""
    data, still = model.createData(), np.zeros(model.nv)
    mass = pin.crba(model, data, q)
    mass = np.triu(mass) + np.triu(mass, 1).T
    gravity = pin.computeGeneralizedGravity(model, data, q)
    coriolis = pin.rnea(model, data, q, rates, still) - gravity
    damped = np.zeros(model.nv)
    for name, v in singles(model).items():
        damped[v] = damping.get(name, 0.0) * rates[v]
    jacobian, rate = point_jacobian(model, data, model.njoints - 1, q, rates)
    return {
        "mass": (chain.T @ mass @ chain).tolist(),
        "gravity": (chain.T @ gravity).tolist(),
        "coriolis": (chain.T @ coriolis).tolist(),
        "bias": (chain.T @ (coriolis + gravity + damped)).tolist(),
        "jacobian": (jacobian @ chain).tolist(),
        "jacobian_rate": (rate @ chain).tolist(),
    }


def regressor(model, chain, q, rates, a):
    """Efforts by the inertial parameters of all joints' bodies, in the order of Pinocchio: mass,
    first moments, and the tensor about the origin of the joint (xx, xy, yy, xz, yz, zz)."""
    data = model.createData()
    rows = chain.T @ pin.computeJointTorqueRegressor(model, data, q, rates, a)
    levers = [model.inertias[i].lever.tolist() for i in range(1, model.njoints)]
    return {"levers": levers, "rows": rows.tolist()}


def states(model, damping, mimics, random, has_regressor):
    names, chain = leaders(model, mimics)
    found = []
    for _ in range(5):
        size = np.array([0.02 if "finger" in name else 1.0 for name in names])
        angles = random.uniform(-1.5, 1.5, len(names)) * size
        rates = random.uniform(-1.5, 1.5, len(names)) * size
        efforts = random.uniform(-5.0, 5.0, len(names))
        q = pin.integrate(model, pin.neutral(model), chain @ angles)
        a = chain @ accelerations(model, damping, chain, q, chain @ rates, efforts)
        found.append(
            {
                "positions": (chain @ angles)[list(singles(model).values())].tolist(),
                "rates": (chain @ rates)[list(singles(model).values())].tolist(),
                "efforts": efforts.tolist(),
                "accelerations": a[list(singles(model).values())].tolist(),
                "equations": equations(model, damping, chain, q, chain @ rates),
            }
        )
        # Large: of the first two states.
        if has_regressor and len(found) <= 2:
            found[-1]["equations"]["regressor"] = regressor(model, chain, q, chain @ rates, a)
    return {"joints": list(singles(model)), "leaders": names, "states": found}


def crane(random):
    """In motion, but for the cart, the load and its flag: these are at rest.

    Which of load and flag carries the other is not told, so that neither may move.
    """
    model, damping, mimics = load(HERE / "crane.urdf")
    names, chain = leaders(model, mimics)
    data = model.createData()
    pin.forwardKinematics(model, data, pin.neutral(model))
    free = model.getJointId("hook")
    target = data.oMi[free].copy()
    places = list(singles(model).values())
    found = []
    for _ in range(5):
        rest = np.zeros(chain.shape[1] - len(names))
        positions = chain @ np.concatenate([random.uniform(-0.8, 0.8, len(names)), rest])
        rates = chain @ np.concatenate([random.uniform(-1.5, 1.5, len(names)), rest])
        rates[singles(model)["flag"]] = 0.0
        efforts = np.concatenate([random.uniform(-5.0, 5.0, len(names)), rest])
        q = pin.integrate(model, pin.neutral(model), positions)
        # The joint of the load is between it and the tip, which moves.
        pin.forwardKinematics(model, data, q)
        before = data.oMi[model.parents[free]] * model.jointPlacements[free]
        start = model.joints[free].idx_q
        q[start : start + 7] = pin.SE3ToXYZQUAT(before.actInv(target))
        pin.forwardKinematics(model, data, q, rates)
        start = model.joints[free].idx_v
        rates[start : start + 6] -= data.v[free].vector
        a = chain @ accelerations(model, damping, chain, q, rates, efforts)
        found.append(
            {
                "positions": positions[places].tolist(),
                "rates": rates[places].tolist(),
                "efforts": efforts[: len(names)].tolist(),
                "accelerations": a[places].tolist(),
            }
        )
    return {"joints": list(singles(model)), "leaders": names, "states": found}


def main():
    random = np.random.default_rng(35)
    robots = {}
    for path in sorted((HERE / "robots").glob("*.urdf")):
        model, damping, mimics = load(path)
        robots[path.stem] = configuration(model)
        if path.stem in DYNAMICS:
            robots[path.stem]["motion"] = states(
                model, damping, mimics, random, path.stem in REGRESSORS
            )
    robots["crane"] = configuration(load(HERE / "crane.urdf")[0])
    robots["crane"]["motion"] = crane(random)
    lines = ",\n".join(f"{json.dumps(name)}: {json.dumps(one)}" for name, one in robots.items())
    (HERE / "reference.json").write_text("{\n" + lines + "\n}\n")


main()

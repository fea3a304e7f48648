"""Tests of the example module, each against a closed form or another road. `bash .ci/python` runs them."""

import _thread
import html
import math
import os
import pickle
import re
import signal
import subprocess
import sys
import tempfile
import threading
import warnings
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

import linkages
from linkages import Drive, Fault, FourBar, HeavyTop, Rod, RunWarning, Ur5

G = 9.81
RANDOM = np.random.default_rng(7)


def raises(kind, call, *words):
    try:
        call()
    except kind as error:
        for word in words:
            assert word in str(error), f"{word!r} is not in {error}"
        return error
    raise AssertionError(f"nothing was raised; expected {kind.__name__}")


def close(a, b, tolerance):
    a, b = np.asarray(a), np.asarray(b)
    assert a.shape == b.shape, (a.shape, b.shape)
    worst = np.max(np.abs(a - b)) if a.size else 0.0
    assert worst <= tolerance, f"off by {worst}"


def solved(mechanism, q, v, end, n=11):
    """The same motion by the integrator of SciPy, over forward dynamics."""
    count = len(q)

    def slope(_, x):
        return np.concatenate([x[count:], mechanism.forward_dynamics(x[:count], x[count:])])

    times = np.linspace(0.0, end, n)
    run = solve_ivp(slope, (0.0, end), np.concatenate([q, v]), method="DOP853", t_eval=times, rtol=1e-11, atol=1e-12)
    return run.y[:count].T, run.y[count:].T


def test_a_rod_has_its_closed_form():
    rod = Rod(length=0.8, mass=2.0, torque=1.5)
    q = RANDOM.uniform(-3.0, 3.0, (7, 1))
    inertia = 2.0 * 0.8**2 / 3.0
    weight = 2.0 * G * 0.4 * np.cos(q)
    close(rod.forward_dynamics(q), (1.5 - weight) / inertia, 1e-12)
    close(rod.mass_matrix(q), np.full((7, 1, 1), inertia), 1e-14)
    close(rod.inverse_dynamics(q, None, np.full((7, 1), 3.0)), 3.0 * inertia + weight - 1.5, 1e-12)
    angle = q[0, 0]
    jacobian = rod.jacobian("tip", q[0])
    expected = [[0.0], [-0.8 * math.sin(angle)], [0.8 * math.cos(angle)], [1.0], [0.0], [0.0]]
    close(jacobian, expected, 1e-14)
    torques = np.linspace(-1.0, 1.0, 7)
    by_torque = rod.forward_dynamics(q, inputs={"torque": torques})
    close(by_torque, (torques[:, None] - weight) / inertia, 1e-12)
    linear = rod.linearised([angle])
    close(linear.A, [[0.0, 1.0], [2.0 * G * 0.4 * math.sin(angle) / inertia, 0.0]], 1e-12)
    close(linear.B, [[0.0], [1.0 / inertia]], 1e-13)
    close(linear.C, [[0.8 * math.cos(angle), 0.0]], 1e-14)
    close(linear.D, [[0.0]], 0.0)
    assert (linear.states, linear.inputs, linear.outputs) == (["hinge", "hinge_rate"], ["torque"], ["height"])


def test_a_batch_is_its_elements_one_by_one():
    arm = Ur5(pan_torque=3.0)
    q, v, tau = RANDOM.normal(size=(3, 4, 5, 6))
    for method, third in [(arm.forward_dynamics, tau), (arm.inverse_dynamics, tau)]:
        found = method(q, v, third)
        for at in np.ndindex(4, 5):
            close(found[at], method(q[at], v[at], third[at]), 0.0)
        close(method(q, v, third[0, 0])[1, 2], method(q[1, 2], v[1, 2], third[0, 0]), 0.0)
    matrices = [arm.mass_matrix(q), arm.jacobian("third_wrist", q), arm.linearised(q, v).A]
    for at in np.ndindex(4, 5):
        alone = [arm.mass_matrix(q[at]), arm.jacobian("third_wrist", q[at]), arm.linearised(q[at], v[at]).A]
        for batch, one in zip(matrices, alone):
            close(batch[at], one, 0.0)
    # More than one thread takes at a time.
    many = RANDOM.normal(size=(3000, 6))
    close(arm.mass_matrix(many)[[0, 1500, 2999]], arm.mass_matrix(many[[0, 1500, 2999]]), 0.0)
    assert arm.mass_matrix(np.zeros((0, 6))).shape == (0, 6, 6)


def test_inverse_dynamics_undo_forward_dynamics():
    for mechanism, size, spread in [(Ur5(lift_torque=1.0), 6, 1.0), (FourBar(torque=2.0), 1, 0.5)]:
        q, v, tau = (spread * RANDOM.normal(size=(20, size)) for _ in range(3))
        a = mechanism.forward_dynamics(q, v, tau)
        close(mechanism.inverse_dynamics(q, v, a), tau, 1e-9)
        mass = mechanism.mass_matrix(q)
        close(mass, np.swapaxes(mass, -1, -2), 1e-12)
        assert np.all(np.linalg.eigvalsh(mass) > 0.0)
        bias = mechanism.inverse_dynamics(q, v)
        close(np.einsum("bij,bj->bi", mass, a) + bias, tau, 1e-9)


def test_a_run_is_that_of_scipy():
    cases = [
        (Rod(length=0.8, mass=2.0, torque=1.5), [0.3], [1.0], 2.0),
        (Ur5(), 0.1 * RANDOM.normal(size=6), 0.3 * RANDOM.normal(size=6), 0.5),
        (FourBar(torque=0.5), [0.1], [0.2], 0.3),
    ]
    for mechanism, q, v, end in cases:
        run = mechanism.simulate(end, every=end / 10.0, start=q, rates=v, tolerance=1e-11, film=False)
        positions, rates = solved(mechanism, np.asarray(q), np.asarray(v), end)
        names = type(mechanism).coordinates
        close(np.column_stack([run[f"{name}.angle"] for name in names]), positions, 1e-7)
        close(np.column_stack([run[f"{name}.angle_rate"] for name in names]), rates, 1e-6)


def test_a_jacobian_gives_the_velocities_of_a_run():
    for mechanism, body, size in [(Ur5(), "third_wrist", 6), (FourBar(), "coupler", 1)]:
        q, v = 0.3 * RANDOM.normal(size=size), RANDOM.normal(size=size)
        first = mechanism.simulate(1e-6, every=1e-6, start=q, rates=v)
        close(mechanism.jacobian(body, q)[:3] @ v, first[f"{body}.velocity"][0], 1e-12)


def test_a_linear_model_is_that_of_differences():
    mechanism, h = FourBar(torque=2.0), 1e-5
    q, v = np.array([0.2]), np.array([0.7])
    a, b, c, d = mechanism.linearised(q, v)

    def difference(call):
        return (call(h) - call(-h)) / (2.0 * h)

    close(a[1, 0], difference(lambda h: mechanism.forward_dynamics(q + h, v)[0]), 1e-6)
    close(a[1, 1], difference(lambda h: mechanism.forward_dynamics(q, v + h)[0]), 1e-6)
    close(b[1, 0], difference(lambda h: mechanism.forward_dynamics(q, v, inputs={"torque": 2.0 + h})[0]), 1e-6)

    def height(h):
        return mechanism.simulate(1e-6, every=1e-6, start=q + h, rates=v)["coupler_height"][0]

    close(c[0, 0], difference(height), 1e-6)
    assert c.shape == (1, 2) and d.shape == (1, 1)


def test_a_loop_starts_where_it_was_asked_to():
    run = FourBar(crank_length=0.3).simulate(0.1, start={"crank": -0.4}, rates={"crank": 2.0}, reactions=True)
    close([run["crank.angle"][0], run["crank.angle_rate"][0]], [-0.4, 2.0], 1e-12)
    assert run["violation"].max() < 1e-18
    assert run["knee.force"].shape == (len(run), 3)
    assert run.units["knee.force.x"] == "N" and run.units["coupler_height"] == "m"
    # The described start, but for the rate.
    run = FourBar().simulate(0.1, rates=[1.0])
    close(run["crank.angle_rate"][0], 1.0, 1e-12)


def test_stops_are_heeded_or_said_not_to_be():
    bar = FourBar(torque=4.0)
    run = bar.simulate(3.0)
    rocker = run["rocker.angle"]
    assert rocker.min() > -1.2 - 1e-6 and rocker.max() < 0.7 + 1e-6
    assert min(abs(rocker.min() + 1.2), abs(rocker.max() - 0.7)) < 1e-6, (rocker.min(), rocker.max())
    fault = raises(Fault, lambda: bar.rollouts(0.1, 1e-3), "limits=False")
    assert fault.joint == "rocker"
    assert bar.rollouts(0.1, 1e-3, limits=False).q.shape == (1, 101, 1)


def test_rollouts_are_runge_kutta_steps():
    arm, dt, steps = Ur5(), 1e-2, 20
    start, rates = 0.2 * RANDOM.normal(size=(2, 5, 6))
    pan = 5.0 * RANDOM.normal(size=(5, steps))
    found = arm.rollouts(steps * dt, dt, start=start, rates=rates, inputs={"pan_torque": pan, "lift_torque": 2.0})
    q, v = start, rates
    for step in range(steps):
        inputs = {"pan_torque": pan[:, step], "lift_torque": 2.0}

        def slope(q, v):
            return v, arm.forward_dynamics(q, v, inputs=inputs)

        k1 = slope(q, v)
        k2 = slope(q + 0.5 * dt * k1[0], v + 0.5 * dt * k1[1])
        k3 = slope(q + 0.5 * dt * k2[0], v + 0.5 * dt * k2[1])
        k4 = slope(q + dt * k3[0], v + dt * k3[1])
        q, v = (
            x + dt / 6.0 * (a + 2.0 * b + 2.0 * c + d)
            for x, a, b, c, d in zip((q, v), k1, k2, k3, k4)
        )
        close(found.q[:, step + 1], q, 1e-10)
        close(found.v[:, step + 1], v, 1e-9)
    close(found["pan"], found.q[:, :, 0], 0.0)
    close(found["pan_rate"], found.v[:, :, 0], 0.0)
    # Alone, on one thread, and with reports after every fourth step.
    one = arm.rollouts(
        steps * dt, dt, every=4, start=start[3], rates=rates[3], threads=1,
        inputs={"pan_torque": pan[3:4], "lift_torque": 2.0},
    )
    close(one.q[0], found.q[3, ::4], 0.0)
    close(one.time, found.time[::4], 0.0)


def test_rollouts_have_parameters_of_their_own():
    lengths = np.linspace(0.5, 1.0, 9)
    rod = Rod(length=1.0, mass=1.0)
    found = rod.rollouts(1.0, 1e-3, every=100, parameters={"length": lengths}, rates=[0.5])
    for number, length in enumerate(lengths):
        run = Rod(length=length, mass=1.0).simulate(1.0, every=0.1, rates=[0.5], tolerance=1e-10)
        close(found["hinge"][number], run["hinge.angle"], 1e-7)
        close(found["height"][number], run["height"], 1e-7)
        close(found.energy[number], run["kinetic_energy"] + run["potential_energy"], 1e-7)
    linkages_of = FourBar().rollouts(0.2, 1e-3, parameters={"base": [0.85, 0.9, 0.95]}, limits=False)
    alone = FourBar(base=0.95).simulate(0.2, every=1e-3, tolerance=1e-10)
    close(linkages_of["crank"][2], alone["crank.angle"], 1e-6)
    assert linkages_of.violation.max() < 1e-16
    fault = raises(Fault, lambda: FourBar().rollouts(0.2, 1e-3, parameters={"base": [0.9, 3.0]}, limits=False))
    assert fault.index == 1 and fault.joint is not None


def test_a_rollout_that_stops_is_no_number_from_there_on():
    rod = Rod(length=1.0, mass=1.0)
    torque = np.zeros((3, 10))
    torque[1, 4:] = 1e308
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        found = rod.rollouts(1.0, 0.1, inputs={"torque": torque})
    assert [of.category for of in caught] == [RunWarning] and "1 of 3" in str(caught[0].message)
    [(number, time, _, why)] = found.stopped
    assert number == 1 and "not finite" in why
    reached = int(round(time / 0.1))
    assert reached >= 4 and np.isnan(found.q[1, reached + 1 :]).all() and np.isfinite(found.q[1, : reached + 1]).all()
    assert np.isfinite(found.q[[0, 2]]).all()
    close(found.q[0], found.q[2], 0.0)


def test_inputs_hold_for_a_period():
    rod = Rod(length=1.0, mass=3.0, torque=9.0)
    # It is held level, and then pushed on.
    run = rod.simulate(1.0, every=0.05, inputs={"torque": [3.0 * G * 0.5, 3.0 * G * 0.5 + 1.0]}, period=0.5)
    angle = np.interp([0.25, 0.5], run.time, run["hinge.angle"])
    close(angle, [0.0, 0.0], 1e-12)
    assert run["hinge.angle"][-1] > 0.05
    assert np.all(np.diff(run.time) > 0.0)
    close(rod.simulate(0.1)["hinge.angle_rate"][-1], rod.simulate(0.1, inputs={"torque": 9.0})["hinge.angle_rate"][-1], 0.0)


def test_faults_say_when_and_where():
    rod = Rod(length=1.0, mass=1.0)
    call = lambda: rod.simulate(2.0, inputs={"torque": [0.0, 1e308]}, period=0.5)
    fault = raises(Fault, call, "at 0.5", "not finite")
    assert abs(fault.time - 0.5) < 0.05 and fault.index is None
    # What was recorded before.
    assert fault.run.time[0] == 0.0 and abs(fault.run.time[-1] - 0.5) < 0.05
    fault = raises(Fault, lambda: FourBar(base=3.0))
    assert fault.joint is not None and fault.time is None
    # There the coupler does not reach the rocker.
    fault = raises(Fault, lambda: FourBar(crank_length=0.7, base=1.2).mass_matrix([[0.0], [1.5]]), "[1]")
    assert fault.index == 1 and fault.joint is not None
    fault = raises(Fault, lambda: Rod(length=1.0, mass=-1.0), "mass")
    assert isinstance(fault, RuntimeError)


def test_warnings_of_a_run_are_those_of_python():
    rod = Rod(length=1.0, mass=1.0)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        run = rod.simulate(10.0, method="rk4", step=0.25)
    assert run.warnings and [str(of.message) for of in caught] == run.warnings
    assert all(issubclass(of.category, RunWarning) for of in caught)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        raises(RunWarning, lambda: rod.simulate(10.0, method="rk4", step=0.25))
        assert not rod.simulate(2.0).warnings


def test_what_is_no_number_or_has_no_such_shape_is_refused():
    rod, arm = Rod(length=1.0, mass=1.0), Ur5()
    nan = float("nan")
    for call in [
        lambda: rod.forward_dynamics([nan]),
        lambda: rod.forward_dynamics([0.0], [math.inf]),
        lambda: rod.mass_matrix([[0.0], [nan]]),
        lambda: Rod(length=nan, mass=1.0),
        lambda: rod.simulate(1.0, start={"hinge": nan}),
        lambda: rod.rollouts(1.0, 0.1, start=[[nan]]),
        lambda: rod.rollouts(1.0, 0.1, inputs={"torque": nan}),
        lambda: rod.forward_dynamics([0.0], inputs={"torque": [nan]}),
    ]:
        raises(ValueError, call, "not finite")
    for wrong in ([1j], ["a"], [None], None):
        raises(ValueError, lambda: rod.mass_matrix(wrong), "q")
    raises(ValueError, lambda: rod.mass_matrix([0.0], time=nan), "finite")
    raises(ValueError, lambda: arm.mass_matrix(np.zeros(5)), "(..., 6)", "pan, lift", "(5,)")
    raises(ValueError, lambda: arm.mass_matrix(0.0), "(..., 6)")
    raises(ValueError, lambda: arm.forward_dynamics(np.zeros((3, 6)), np.zeros((2, 6))), "(2,)", "(3,)")
    raises(ValueError, lambda: arm.rollouts(1.0, 0.1, start=np.zeros((3, 6)), rates=np.zeros((2, 6))), "(2,)")
    raises(ValueError, lambda: arm.rollouts(1.0, 0.1, inputs={"pan_torque": np.zeros((1, 9))}), "(B, 10)")
    raises(ValueError, lambda: arm.rollouts(1.0, 0.3), "whole")
    raises(ValueError, lambda: arm.jacobian("tool", np.zeros(6)), "tool", "third_wrist")
    raises(ValueError, lambda: rod.simulate(1.0, start={"knee": 0.0}), "knee", "hinge")
    raises(ValueError, lambda: rod.simulate(1.0, inputs={"torque": [0.0, 1.0]}), "period")
    raises(ValueError, lambda: rod.simulate(1.0, method="euler"), "dormand_prince")
    raises(ValueError, lambda: rod.simulate(1.0, method="rk4"), "step")
    raises(ValueError, lambda: rod.simulate(1.0, step=0.1), "tolerance")
    raises(Fault, lambda: rod.simulate(-1.0))
    raises(Fault, lambda: rod.simulate(nan))
    raises(Fault, lambda: rod.simulate(1.0, every=0.0))
    raises(TypeError, lambda: Rod(length=1.0), "mass")
    raises(TypeError, lambda: Rod(length=1.0, mass=1.0, width=2.0), "width")
    raises(ValueError, lambda: Rod(length=[1.0, 2.0], mass=1.0), "shape ()")
    raises(KeyError, lambda: rod.simulate(0.1)["knee.angle"], "hinge.angle")


def test_arrays_may_lie_anywhere_in_memory():
    arm, q = Ur5(), RANDOM.normal(size=(4, 6))
    expected = arm.mass_matrix(q)
    shifted = np.frombuffer(b"x" + q.tobytes(), dtype=np.uint8)[1:].view(np.float64).reshape(4, 6)
    wide = np.zeros((8, 12))
    wide[::2, ::2] = q
    for same in [shifted, wide[::2, ::2], q[::-1][::-1], np.asfortranarray(q), q.astype(">f8"), q.tolist()]:
        close(arm.mass_matrix(same), expected, 0.0)
    assert not shifted.flags.aligned
    close(Rod(length=1, mass=1).mass_matrix(np.array([[0]])), [[[1.0 / 3.0]]], 1e-15)


def test_states_start_with_what_the_object_has():
    drive = Drive(voltage=2.0, current=-1.0)
    assert Drive.states == ("current",) and Drive().current == 0.3
    close(drive.forward_dynamics([[0.0], [1.0]]), [[-8.0], [-8.0]], 1e-12)

    def current(time):
        return 4.0 - 5.0 * np.exp(-5.0 * time)

    def rate(time):
        return 8.0 * (4.0 * time - (1.0 - np.exp(-5.0 * time)))

    run = drive.simulate(1.0, tolerance=1e-10)
    close(run["current"], current(run.time), 1e-7)
    close(run["shaft.angle_rate"], rate(run.time), 1e-6)
    found = drive.rollouts(1.0, 1e-3, every=10)
    close(found["flow"][0], current(found.time), 1e-9)
    close(found["shaft_rate"][0], rate(found.time), 1e-8)
    # A linear model would leave the current out.
    raises(Fault, lambda: drive.linearised([0.0]))


def test_values_are_attributes():
    rod = Rod(length=1.0, mass=2.0)
    rod.torque, rod.length = 3.0, 0.5
    assert (rod.length, rod.mass, rod.torque) == (0.5, 2.0, 3.0)
    raises(Fault, lambda: setattr(rod, "mass", -1.0))
    raises(AttributeError, lambda: setattr(rod, "width", 1.0), "width")
    raises(AttributeError, lambda: rod.width, "width")
    assert repr(rod) == "Rod(length=0.5, mass=2.0, torque=3.0)"
    assert repr(pickle.loads(pickle.dumps(rod))) == repr(rod)
    assert Rod.coordinates == ("hinge",) and Rod.parameters == ("length", "mass") and Rod.inputs == ("torque",)
    assert Rod.points == ("tip",) and Rod.readings == ("height",)
    assert FourBar().base == 0.9


def test_documentation_is_that_of_the_struct():
    assert Rod.__doc__.startswith("A uniform rod on a hinge about x")
    assert "length: The length (m)." in Rod.__doc__ and "hinge (rad)" in Rod.__doc__
    assert "shape (..., N)" in Rod.forward_dynamics.__doc__
    assert linkages.__doc__.strip() == "Linkages and arms."


def test_a_run_has_columns_a_frame_and_a_film():
    run = Rod(length=1.0, mass=1.0).simulate(1.0)
    assert len(run) == 101 and run.columns[0] == "time" and "hinge.angle" in run
    frame = run.to_pandas()
    assert frame.index.name == "time" and list(frame.columns) == run.columns[1:]
    close(frame["height"].to_numpy(), np.sin(run["hinge.angle"]), 1e-14)
    close(run["rod.position"][:, 2], run["rod.position.z"], 0.0)
    shown = run._repr_html_()
    [page] = re.fullmatch(r'<iframe [^>]* srcdoc="([^"]*)"></iframe>', shown).groups()
    assert html.unescape(page) == run.film()
    assert Rod(length=1.0, mass=1.0).simulate(0.1, film=False)._repr_html_() is None


def test_a_class_for_runs_alone():
    top = HeavyTop()
    assert not hasattr(top, "mass_matrix")
    run = top.simulate(0.5, tolerance=1e-10)
    energy = run["kinetic_energy"] + run["potential_energy"]
    close(energy, np.full_like(energy, energy[0]), 1e-6 * abs(energy[0]))


def test_a_run_leaves_the_interpreter_to_others():
    """Another thread gets its turn while a run goes on that would not end, and interrupts it."""
    previous = signal.signal(signal.SIGINT, signal.default_int_handler)
    other = threading.Thread(target=_thread.interrupt_main)

    def call():
        other.start()
        Rod(length=1.0, mass=1.0).simulate(1e6, film=False)

    try:
        raises(KeyboardInterrupt, call)
    finally:
        other.join()
        signal.signal(signal.SIGINT, previous)


def test_threads_do_not_disturb_each_other():
    arm = Ur5()
    start = 0.2 * RANDOM.normal(size=(16, 6))
    alone = arm.rollouts(0.2, 1e-2, start=start).q
    found = [None] * 4

    def work(number):
        found[number] = arm.rollouts(0.2, 1e-2, start=start).q

    threads = [threading.Thread(target=work, args=(number,)) for number in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for one in found:
        close(one, alone, 0.0)


def test_a_process_that_forks_goes_on():
    arm = Ur5()
    q = RANDOM.normal(size=(3000, 6))
    before = arm.mass_matrix(q)
    child = os.fork()
    if child == 0:
        os._exit(0 if np.array_equal(arm.mass_matrix(q), before) else 1)
    assert os.waitpid(child, 0)[1] == 0


USE = """
import numpy as np
from linkages import FourBar, Rod, Ur5

bar = FourBar(base=0.85, torque=1.0)
run = bar.simulate(1.0, start={"crank": 0.1})
angle: np.ndarray = run["crank.angle"]
bar.base = 0.9
A, B, C, D = Ur5().linearised([0.0] * 6)
"""


def checked(program):
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "linkages.pyi").write_text(linkages.stubs())
        Path(folder, "use.py").write_text(program)
        command = [sys.executable, "-m", "mypy", "--strict", "use.py", "linkages.pyi"]
        return subprocess.run(command, cwd=folder, capture_output=True, text=True)


def test_stubs_tell_a_checker_of_types():
    try:
        import mypy  # noqa: F401
    except ImportError:
        print("stubs were NOT checked: mypy is not there")
        return
    right = checked(USE)
    assert right.returncode == 0, right.stdout
    wrong = checked(USE + "Rod(length=1.0)\nbar.simulate('long')\n")
    assert "Missing named argument" in wrong.stdout and "incompatible type" in wrong.stdout, wrong.stdout


if __name__ == "__main__":
    tests = [(name, test) for name, test in list(globals().items()) if name.startswith("test_")]
    wanted = sys.argv[1:]
    for name, test in tests:
        if not wanted or name in wanted:
            test()
            print(f"{name}: ok", flush=True)

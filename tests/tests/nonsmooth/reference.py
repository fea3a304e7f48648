"""Times of impacts, angles and rates of mechanisms with stops and friction: `reference.rs`.

    pip install mpmath numpy scipy
    python reference.py > reference.rs

Minimal coordinates of our own. Between impacts energy is kept, so that times are integrals over
the coordinate, with 30 digits; with friction by the load, equations of Newton and Euler of every
body are integrated between the zeros of the normal force and of the slider's rate. Nothing of the
project is used.
"""

import numpy as np
from mpmath import acos, acosh, atan, cos, diff, mp, mpf, pi, quad, sin, sqrt
from scipy.integrate import solve_ivp

mp.dps = 30
G = mpf("9.81")


def between(mass, potential, energy, start, end):
    """The time from one place to another at a constant energy; it may start or end at rest."""

    def slowness(q):
        return sqrt(mass(q) / (2 * (energy - potential(q))))

    # Places of rest are singularities like 1 / sqrt, which q = a + (b - a) sin^2 takes away.
    span = end - start

    def swept(s):
        q = start + span * sin(s) ** 2
        return slowness(q) * abs(span) * 2 * sin(s) * cos(s)

    ends = [k * pi / 16 for k in range(9)]
    return quad(swept, ends, method="gauss-legendre", maxdegree=5)


def bounces(mass, potential, top, stop, restitution, number):
    """Times of the impacts of what is let go at rest at `top` and falls on `stop`."""
    energy, time, times = potential(top), mpf(0), []
    for _ in range(number):
        time += between(mass, potential, energy, top, stop)
        times.append(time)
        energy = potential(stop) + restitution**2 * (energy - potential(stop))
        # Where it is at rest again.
        top = mp.findroot(lambda q: potential(q) - energy, (stop, top), solver="anderson")
        time += between(mass, potential, energy, top, stop)
    return times


def pendulum():
    """A rod of 1 m, let go at 60 degrees from the vertical, and a stop 10 degrees before it."""
    mass = lambda q: mpf(2) / 3
    potential = lambda q: -G * cos(q)
    return bounces(mass, potential, pi / 3, pi / 18, mpf("0.5"), 6)


def four_bar():
    """Crank 1, coupler 2, rocker 1.5, ground 2 m; slender, 1 kg a metre; a stop of the rocker.

    The crank `a` from (0, 0) is let go at 70 degrees from the x axis; the rocker turns about
    (2, 0), its stop is where it stands when the crank is at 45 degrees.
    """
    crank, coupler, rocker, ground = mpf(1), mpf(2), mpf("1.5"), mpf(2)

    def coupler_and_rocker(a):
        x, y = crank * cos(a), crank * sin(a)
        dx, dy = ground - x, -y
        d = sqrt(dx * dx + dy * dy)
        b = mp.atan2(dy, dx) + acos((d * d + coupler**2 - rocker**2) / (2 * d * coupler))
        ex, ey = x + coupler * cos(b), y + coupler * sin(b)
        return b, mp.atan2(ey, ex - ground)

    def places(a):
        b, c = coupler_and_rocker(a)
        return (
            crank / 2 * sin(a),
            crank * cos(a) + coupler / 2 * cos(b),
            crank * sin(a) + coupler / 2 * sin(b),
            rocker / 2 * sin(c),
        )

    def mass(a):
        b_rate = diff(lambda t: coupler_and_rocker(t)[0], a)
        c_rate = diff(lambda t: coupler_and_rocker(t)[1], a)
        x, y = diff(lambda t: places(t)[1], a), diff(lambda t: places(t)[2], a)
        turned = coupler**3 / 12 * b_rate**2 + rocker**3 / 3 * c_rate**2
        return crank**3 / 3 + coupler * (x * x + y * y) + turned

    def potential(a):
        first, _, second, third = places(a)
        return G * (crank * first + coupler * second + rocker * third)

    start, stop = pi * 70 / 180, pi * 45 / 180
    times = bounces(mass, potential, start, stop, mpf("0.5"), 4)
    b, c = coupler_and_rocker(start)
    _, held = coupler_and_rocker(stop)
    return times, [b, c, held - c]


R, L = 0.1, 0.3
CRANK, ROD, SLIDER = 1.0, 0.8, 0.5
FRICTION, TORQUE, DRAG = 0.2, 2.0, 0.3


def crank_acceleration(q, w, sign, gravity):
    """Angle's acceleration and normal force; friction is `-FRICTION * sign * N` along +x.

    Newton and Euler of crank, rod and slider: nine unknowns are a'', b'', x'', both forces of
    both pins, the normal force N (+y) and friction.
    """
    s, c = np.sin(q), np.cos(q)
    b = -np.arcsin(R * s / L)
    bw = -R * c * w / (L * np.cos(b))
    # Unknowns: a'', b'', x'', px, py (crank on rod), qx, qy (rod on slider), N, F.
    A, y = np.zeros((9, 9)), np.zeros(9)
    # Pins: x = R cos a + L cos b, 0 = R sin a + L sin b, twice differentiated.
    A[0, :3] = [R * s, L * np.sin(b), 1]
    y[0] = -R * c * w**2 - L * np.cos(b) * bw**2
    A[1, :2] = [R * c, L * np.cos(b)]
    y[1] = R * s * w**2 + L * np.sin(b) * bw**2
    # Crank about its bearing.
    A[2, 0], A[2, 3], A[2, 4] = CRANK * R**2 / 3, -R * s, R * c
    y[2] = TORQUE - DRAG * w - CRANK * gravity * R / 2 * c
    # The rod: its centre is midway.
    A[3, :3] = [-ROD * R * s, -ROD * L / 2 * np.sin(b), 0]
    A[3, 3], A[3, 5] = -1, 1
    y[3] = ROD * (R * c * w**2 + L / 2 * np.cos(b) * bw**2)
    A[4, :3] = [ROD * R * c, ROD * L / 2 * np.cos(b), 0]
    A[4, 4], A[4, 6] = -1, 1
    y[4] = ROD * (R * s * w**2 + L / 2 * np.sin(b) * bw**2) - ROD * gravity
    # About its centre: p at -L/2, -q at +L/2.
    A[5, 1] = ROD * L**2 / 12
    A[5, 3], A[5, 4] = -L / 2 * np.sin(b), L / 2 * np.cos(b)
    A[5, 5], A[5, 6] = -L / 2 * np.sin(b), L / 2 * np.cos(b)
    # The slider.
    A[6, 2], A[6, 5], A[6, 8] = SLIDER, -1, -1
    A[7, 6], A[7, 7], y[7] = 1, 1, SLIDER * gravity
    A[8, 7], A[8, 8] = FRICTION * sign, 1
    found = np.linalg.solve(A, y)
    return found[0], found[7]


def slider_crank(gravity, tolerance=1e-13, method="DOP853"):
    """The crank's angle after 2 s from 30 degrees at rest, friction of the slide `mu |N|`."""

    def slide_rate(q, w):
        b = -np.arcsin(R * np.sin(q) / L)
        bw = -R * np.cos(q) * w / (L * np.cos(b))
        return -R * np.sin(q) * w - L * np.sin(b) * bw

    time, state = 0.0, [np.pi / 6, 0.0]
    # The slide starts towards -x; friction is against it, times the sign of N.
    slides, normal = -1.0, 1.0
    normal = np.sign(crank_acceleration(*state, slides, gravity)[1])
    kinks = 0
    while time < 2.0:
        def rates(_, y):
            return [y[1], crank_acceleration(y[0], y[1], slides * normal, gravity)[0]]

        def loses_contact(_, y):
            return crank_acceleration(y[0], y[1], slides * normal, gravity)[1]

        # In line where sin q = 0: the slider turns back.
        def turns(_, y):
            return np.sin(y[0])

        # Neither fires where it is at its zero at the start: begin a little later.
        first = solve_ivp(rates, [time, time + 1e-6], state, method, rtol=tolerance, atol=1e-15)
        time, state = first.t[-1], first.y[:, -1]
        loses_contact.terminal = turns.terminal = True
        run = solve_ivp(
            rates, [time, 2.0], state, method, events=[loses_contact, turns],
            rtol=tolerance, atol=1e-15, max_step=0.01,
        )
        time, state = run.t[-1], run.y[:, -1]
        if len(run.t_events[0]):
            normal = -normal
        if len(run.t_events[1]):
            slides = -slides
            # Friction is another from here on: so may be the sign of the normal force.
            after = [crank_acceleration(*state, slides * n, gravity)[1] * n for n in (1, -1)]
            assert (after[0] > 0) != (after[1] > 0), after
            normal = 1.0 if after[0] > 0 else -1.0
        kinks += 1
        assert kinks < 200
    return state, kinks


def rocking():
    """Housner's block, 1.2 m high and 0.3 m wide, let go at 0.6 of its slenderness: impacts."""
    half_width, half_height = mpf("0.15"), mpf("0.6")
    slender = atan(half_width / half_height)
    radius = sqrt(half_width**2 + half_height**2)
    mass = lambda q: mpf(4) / 3 * radius**2
    potential = lambda q: G * radius * cos(slender - q)
    ratio = 1 - mpf(3) / 2 * sin(slender) ** 2
    top, time, times = mpf("0.6") * slender, mpf(0), []
    energy = potential(top)
    for _ in range(4):
        time += between(mass, potential, energy, top, mpf(0))
        times.append(time)
        energy = potential(0) + ratio**2 * (energy - potential(0))
        top = slender - acos(energy / (G * radius))
        time += between(mass, potential, energy, top, mpf(0))
    # Housner's own formula, of the block linearised: what small slenderness leaves.
    frequency = sqrt(3 * G / (4 * radius))
    linear = acosh(1 / (1 - mpf("0.6"))) / frequency
    assert abs(linear / times[0] - 1) < 0.02
    return times, ratio


def clock():
    """Andronov's clock: both amplitudes and the period of the swing that all starts lead to.

    From an amplitude `a` to the next one, `b`, friction takes `T (a + b)` from `V`, the energy of
    the weight; where the pendulum passes the vertical the one way, `E` is added.
    """
    rod, bob = 7800 * pi * mpf("0.005") ** 2 * mpf("0.92"), 7800 * pi * mpf("0.08") ** 2 * mpf("0.03")
    inertia = rod * mpf("0.92") ** 2 / 3 + bob * (1 + mpf("0.08") ** 2 / 2)
    weight = G * (rod * mpf("0.46") + bob)
    friction = mpf("0.04")
    path = mpf("0.15") * 2 * pi / 30 / (2 * friction)
    energy = lambda q: -weight * cos(q)
    a = mp.findroot(lambda a: energy(a) - energy(path - a) - friction * path, path / 2 * mpf("1.02"))
    b = path - a
    period = mpf(0)
    # Away from the vertical, and back to it: friction is part of the potential of that way.
    for top, sign in [(a, 1), (a, -1), (b, 1), (b, -1)]:
        slope = lambda q: energy(q) + sign * friction * q
        period += between(lambda q: inertia, slope, slope(top), top, mpf(0))
    return [a, b, period]


def numbers(values):
    return ", ".join(repr(float(value)) for value in values)


def main():
    print("//! Written by `reference.py`.\n")
    print("/// Times of the impacts of a rod on a stop (s).")
    times = pendulum()
    print(f"pub(super) const PENDULUM: [f64; {len(times)}] = [{numbers(times)}];")
    times, angles = four_bar()
    print("/// Times of the impacts of a four-bar's rocker (s).")
    print(f"pub(super) const FOUR_BAR: [f64; {len(times)}] = [{numbers(times)}];")
    print("/// Its coupler and its rocker at the start, and the stop against that (rad).")
    print(f"pub(super) const FOUR_BAR_ANGLES: [f64; {len(angles)}] = [{numbers(angles)}];")
    print("/// Gravity (m/s^2), a crank's angle (rad) and rate (rad/s) after 2 s, friction by the load.")
    print("pub(super) const SLIDER_CRANK: [[f64; 3]; 2] = [")
    for gravity in (0.0, 9.81):
        (angle, rate), _ = slider_crank(gravity)
        (check, _), _ = slider_crank(gravity, 1e-10, "RK45")
        assert abs(angle - check) < 1e-6, (angle, check)
        print(f"    [{numbers((gravity, angle, rate))}],")
    print("];")
    times, ratio = rocking()
    print("/// Times of the impacts of a rocking block (s), and the ratio of its rates.")
    print(f"pub(super) const ROCKING: [f64; {len(times)}] = [{numbers(times)}];")
    print(f"pub(super) const ROCKING_RATIO: f64 = {numbers([ratio])};")
    print("/// Amplitudes of a clock's pendulum after a beat and before one (rad), its period (s).")
    print(f"pub(super) const CLOCK: [f64; 3] = [{numbers(clock())}];")


main()

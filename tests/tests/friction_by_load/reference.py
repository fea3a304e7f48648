"""Motions with friction by the load of a joint, in minimal coordinates: `reference.rs`.

    pip install numpy scipy
    python reference.py > reference.rs

Equations of Newton and Euler of every body, written by hand for each mechanism; the friction and the
load are solved together at every evaluation. Between the corners of the motion (a rate or a load
that passes zero) it is smooth, and integrated by DOP853 at a tolerance of 1e-13. Nothing of the
project is used.
"""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

GRAVITY = 9.81


def integrated(rates, start, state, end, events):
    """The state at the first zero of an event, or at the end; which event it was."""
    for event in events:
        event.terminal = True
    run = solve_ivp(
        rates, [start, end], state, "DOP853", events=events, rtol=1e-13, atol=1e-15, max_step=0.01
    )
    assert run.status >= 0, run.message
    found = [number for number, times in enumerate(run.t_events) if len(times)]
    if not found:
        return run.t[-1], run.y[:, -1], None
    # Anew to the zero itself: dense output has fewer digits than a step.
    event, time = events[found[0]], run.t_events[found[0]][0]
    last, before = run.t[-2], run.y[:, -2]

    def there(t):
        if t == last:
            return before
        step = solve_ivp(rates, [last, t], before, "DOP853", rtol=1e-13, atol=1e-15)
        return step.y[:, -1]

    reach = 1e-6
    low, high = max(last, time - reach), time + reach
    if event(low, there(low)) * event(high, there(high)) < 0:
        time = brentq(lambda t: event(t, there(t)), low, high, xtol=1e-15)
    return time, there(time), found[0]


def pendulum():
    """A rod of 2 kg and 1 m from the horizontal; a hinge with the radius 0.05 m and mu = 0.6.

    Times and angles (from the horizontal) at which its rate is zero, until it stays.
    """
    mass, length, radius, mu = 2.0, 0.5, 0.05, 0.6
    inertia = 1.0 / 6.0 + mass * length**2
    lever = mu * radius

    def acceleration(angle, rate, sign):
        # The force on the rod: m (a - g), along the rod and across it, by the moment x.
        along = mass * (-length * rate**2 + GRAVITY * np.sin(angle))
        still = -mass * GRAVITY * length * np.cos(angle) / inertia
        across, slope = mass * (length * still + GRAVITY * np.cos(angle)), mass * length / inertia
        # x = -sign lever |(along, across + slope x)|, as y = -sign x.
        slope = -sign * slope
        a = 1 - (lever * slope) ** 2
        b = -(lever**2) * across * slope
        c = -(lever**2) * (along**2 + across**2)
        assert a > 0
        y = (-b + np.sqrt(b * b - a * c)) / a
        return still - sign * y / inertia

    time, state, sign = 0.0, np.array([0.0, 0.0]), -1.0
    stops = []
    while True:
        def rates(_, y, sign=sign):
            return [y[1], acceleration(y[0], y[1], sign)]

        def rests(_, y):
            return y[1]

        # It does not fire at its zero at the start: begin a little later.
        first = solve_ivp(rates, [time, time + 1e-4], state, "DOP853", rtol=1e-13, atol=1e-15)
        time, state, found = integrated(rates, first.t[-1], first.y[:, -1], time + 10.0, [rests])
        assert found == 0
        stops.append((time, state[0]))
        if mass * GRAVITY * length * abs(np.cos(state[0])) <= lever * mass * GRAVITY:
            return stops
        state, sign = np.array([state[0], 0.0]), -sign


R, L = 0.1, 0.3
CRANK, ROD, SLIDER = 1.0, 0.8, 0.5
SLIDE, BEARING, TORQUE, DRAG = 0.2, 0.3 * 0.02, 2.0, 0.3


def crank_motion(q, w, turns, slides):
    """The crank's acceleration, forces of slide and bearing, and both frictions.

    Newton and Euler of crank, rod and slider. Unknown are a'', b'', x'', the forces p of the crank
    on the rod and f of the rod on the slider, and the normal force on the slider (+y).
    """
    s, c = np.sin(q), np.cos(q)
    b = -np.arcsin(R * s / L)
    bw = -R * c * w / (L * np.cos(b))
    A, y = np.zeros((8, 8)), np.zeros((8, 3))
    # Pins: x = R cos a + L cos b, 0 = R sin a + L sin b, twice differentiated.
    A[0, :3] = [R * s, L * np.sin(b), 1]
    y[0, 0] = -R * c * w**2 - L * np.cos(b) * bw**2
    A[1, :2] = [R * c, L * np.cos(b)]
    y[1, 0] = R * s * w**2 + L * np.sin(b) * bw**2
    # The crank about its bearing; -p acts on it at its end, the friction of the bearing on it.
    A[2, 0], A[2, 3], A[2, 4] = CRANK * R**2 / 3, -R * s, R * c
    y[2] = [TORQUE - DRAG * w - CRANK * GRAVITY * R / 2 * c, 0, 1]
    # The rod: its centre is midway.
    A[3, :3] = [-ROD * R * s, -ROD * L / 2 * np.sin(b), 0]
    A[3, 3], A[3, 5] = -1, 1
    y[3, 0] = ROD * (R * c * w**2 + L / 2 * np.cos(b) * bw**2)
    A[4, :3] = [ROD * R * c, ROD * L / 2 * np.cos(b), 0]
    A[4, 4], A[4, 6] = -1, 1
    y[4, 0] = ROD * (R * s * w**2 + L / 2 * np.sin(b) * bw**2) - ROD * GRAVITY
    # About its centre: p at -L/2, -f at +L/2.
    A[5, 1] = ROD * L**2 / 12
    A[5, 3], A[5, 4] = -L / 2 * np.sin(b), L / 2 * np.cos(b)
    A[5, 5], A[5, 6] = -L / 2 * np.sin(b), L / 2 * np.cos(b)
    # The slider, with the friction of the slide on it.
    A[6, 2], A[6, 5] = SLIDER, -1
    y[6, 1] = 1
    A[7, 6], A[7, 7], y[7, 0] = 1, 1, SLIDER * GRAVITY
    free, by_slide, by_bearing = np.linalg.solve(A, y).T
    friction = np.zeros(2)
    for _ in range(200):
        found = free + by_slide * friction[0] + by_bearing * friction[1]
        # The bearing on the crank: m (a - g) + p.
        centre = R / 2 * np.array([-s * found[0] - c * w**2, c * found[0] - s * w**2])
        bearing = CRANK * (centre + [0, GRAVITY]) + found[3:5]
        last = friction
        friction = np.array(
            [-slides * SLIDE * abs(found[7]), -turns * BEARING * np.hypot(*bearing)]
        )
        if np.all(abs(friction - last) <= 2e-15 * (1 + abs(friction))):
            break
    else:
        raise AssertionError("the frictions do not converge")
    return found[0], found[7], np.hypot(*bearing), friction


def slide_rate(q, w):
    b = -np.arcsin(R * np.sin(q) / L)
    bw = -R * np.cos(q) * w / (L * np.cos(b))
    return -R * np.sin(q) * w - L * np.sin(b) * bw


def slider_crank(times):
    """The crank's angle and rate from a quarter of a turn and 5 rad/s on, and the work of both frictions."""
    time, state = 0.0, np.array([np.pi / 2, 5.0, 0.0])
    slides = -1.0
    results = []
    for end in times:
        while time < end:
            def rates(_, y, slides=slides):
                acceleration, _, _, friction = crank_motion(y[0], y[1], 1.0, slides)
                power = friction[0] * slide_rate(y[0], y[1]) + friction[1] * y[1]
                return [y[1], acceleration, power]

            def load(_, y, slides=slides):
                return crank_motion(y[0], y[1], 1.0, slides)[1]

            def turns(_, y):
                return np.sin(y[0])

            first_end = min(time + 1e-7, end)
            first = solve_ivp(rates, [time, first_end], state, "DOP853", rtol=1e-13, atol=1e-15)
            time, state = first.t[-1], first.y[:, -1]
            if time >= end:
                break
            time, state, found = integrated(rates, time, state, end, [load, turns])
            assert state[1] > 0
            if found == 1:
                slides = -slides
        results.append((end, *state))
    return results


def row(values):
    return "[" + ", ".join(repr(float(value)) for value in values) + "]"


def table(about, name, rows):
    print(f"/// {about}")
    print(f"pub(super) const {name}: [[f64; {len(rows[0])}]; {len(rows)}] = [")
    for values in rows:
        print(f"    {row(values)},")
    print("];")


def main():
    print("//! Written by `reference.py`.\n")
    table("Times (s) and angles (rad) at which a rod comes to rest.", "PENDULUM", pendulum())
    table(
        "Times (s), a crank's angle (rad) and rate (rad/s), the work of both frictions (J).",
        "SLIDER_CRANK",
        slider_crank([0.1, 0.5, 1.0, 2.0]),
    )


main()

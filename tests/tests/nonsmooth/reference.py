"""Times of impacts, angles and rates of mechanisms with stops and friction: `reference.rs`.

    pip install mpmath
    python reference.py > reference.rs

Minimal coordinates of our own. Between impacts energy is kept, so that times are integrals over
the coordinate, with 30 digits. Nothing of the project is used.
"""

from mpmath import acos, atan, cos, diff, mp, mpf, pi, quad, sin, sqrt

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


def rocking():
    """A block on ice, 1.2 m high and 0.3 m wide, let go at 0.6 of its slenderness: impacts.

    Nothing pushes it sideways: its centre moves up and down, and the corner that it stands on
    slides. With `I` about the centre and half the width `b`, an impact of the other corner without
    restitution leaves `(I - m b^2) / (I + m b^2)` of the rate, and the first corner lifts.
    """
    b, h = mpf("0.15"), mpf("0.6")
    inertia = (b * b + h * h) / 3
    mass = lambda q: inertia + (b * cos(q) - h * sin(q)) ** 2
    potential = lambda q: G * (h * cos(q) + b * sin(q))
    ratio = (inertia - b * b) / (inertia + b * b)
    top, time, times = mpf("0.6") * atan(b / h), mpf(0), []
    energy = potential(top)
    for _ in range(4):
        time += between(mass, potential, energy, top, mpf(0))
        times.append(time)
        # Half of `mass` times the square of the rate, at the angle 0.
        energy = potential(0) + ratio**2 * (energy - potential(0))
        top = mp.findroot(lambda q: potential(q) - energy, (mpf(0), top), solver="anderson")
        time += between(mass, potential, energy, top, mpf(0))
    return times


def clock():
    """Andronov's clock: both amplitudes and the period of the swing that all starts lead to.

    From an amplitude `a` to the next one, `b`, friction takes `T (a + b)` from `V`, the energy of
    the weight; where the pendulum passes the vertical the one way, `E` is added.
    """
    length, radius = mpf("0.88"), mpf("0.12")
    rod, bob = (7800 * pi * volume for volume in (mpf("2.5e-5") * length, radius**2 * mpf("0.02")))
    inertia = rod * length**2 / 3 + bob * (1 + radius**2 / 2)
    weight = G * (rod * length / 2 + bob)
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
    times = rocking()
    print("/// Times of the impacts of a block that rocks on ice (s).")
    print(f"pub(super) const ROCKING: [f64; {len(times)}] = [{numbers(times)}];")
    print("/// Amplitudes of a clock's pendulum after a beat and before one (rad), its period (s).")
    print(f"pub(super) const CLOCK: [f64; 3] = [{numbers(clock())}];")


main()

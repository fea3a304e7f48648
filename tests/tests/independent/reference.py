"""Mass and bias of mechanisms with one degree of freedom in a minimal coordinate: `reference.rs`.

    pip install mpmath
    python reference.py > reference.rs

With the kinetic energy m(q) q'^2 / 2 and the potential V(q), the mass is m and the bias
m'(q) q'^2 / 2 + V'(q) (Lagrange). Positions are found as functions of the angle alone, with 40
digits, and differentiated by differences of high order: nothing of the project is used.
"""

from mpmath import mp, mpf, matrix, cos, sin, sqrt, diff, lu_solve, norm

mp.dps = 40
G = mpf("9.81")


def rotation(axis, angle):
    """About a unit vector (Rodrigues)."""
    x, y, z = axis
    c, s = cos(angle), sin(angle)
    k = matrix([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return matrix([[1, 0, 0], [0, 1, 0], [0, 0, 1]]) + s * k + (1 - c) * (k * k)


class Chain:
    """Bodies on hinges one after the other; points and axes in the reference configuration."""

    def __init__(self, hinges, bodies):
        self.hinges, self.bodies = hinges, bodies

    def place(self, angles, body):
        """Rotation and translation of a body from the reference configuration."""
        turn, shift = matrix([[1, 0, 0], [0, 1, 0], [0, 0, 1]]), matrix([0, 0, 0])
        for (point, axis), angle in zip(self.hinges[: body + 1], angles):
            point = matrix(point)
            local = rotation(axis, angle)
            shift = turn * (point - local * point) + shift
            turn = turn * local
        return turn, shift

    def energies(self, angles_of):
        """m(q) and V(q), gravity along -y."""

        def mass(q):
            total = mpf(0)
            for number, (m, inertia, centre) in enumerate(self.bodies):
                turn, _ = self.place(angles_of(q), number)

                def entry(t, what):
                    turn, shift = self.place(angles_of(t), number)
                    return what(turn, shift + turn * matrix(centre))

                v = [diff(lambda t: entry(t, lambda _, p: p[k]), q) for k in range(3)]
                rate = matrix(3, 3)
                for k in range(3):
                    for l in range(3):
                        rate[k, l] = diff(lambda t: entry(t, lambda r, _: r[k, l]), q)
                w = turn.T * rate
                w = [w[2, 1], w[0, 2], w[1, 0]]
                total += m * sum(x * x for x in v) + sum(i * x * x for i, x in zip(inertia, w))
            return total

        def potential(q):
            total = mpf(0)
            for number, (m, _, centre) in enumerate(self.bodies):
                turn, shift = self.place(angles_of(q), number)
                total += m * G * (shift + turn * matrix(centre))[1]
            return total

        return mass, potential


def bricard():
    x, y, z = [1, 0, 0], [0, 1, 0], [0, 0, 1]
    hinges = [([0, 0, 0], y), ([1, 0, 0], z), ([1, -1, 0], x), ([1, -1, 1], y), ([0, -1, 1], z)]
    slender, long = mpf("0.02") / 12, mpf("1.01") / 12
    half = mpf("0.5")
    bodies = [
        (1, (slender, long, long), [half, 0, 0]),
        (1, (long, slender, long), [1, -half, 0]),
        (1, (long, long, slender), [1, -1, half]),
        (1, (slender, long, long), [half, -1, 1]),
        (1, (long, slender, long), [0, -half, 1]),
    ]
    chain = Chain(hinges, bodies)
    known = {}

    def angles_of(q):
        # Differences raise the precision.
        if (q, mp.prec) in known:
            return known[q, mp.prec]

        def open_by(dependent):
            turn, shift = chain.place([q, *dependent], 4)
            end = turn * matrix([0, 0, 1]) + shift - matrix([0, 0, 1])
            axis = turn * matrix([1, 0, 0])
            return matrix([end[0], end[1], end[2], axis[1], axis[2]])

        # The last that was found is near.
        near = min(known, key=lambda other: abs(other[0] - q)) if known else None
        dependent = matrix(known[near][1:]) if known else matrix([0, 0, 0, 0])
        for _ in range(60):
            left = open_by(list(dependent))
            if norm(left) < 1000 * mp.eps:
                break
            jacobian = matrix(5, 4)
            for column in range(4):
                step = sqrt(mp.eps)
                moved = list(dependent)
                moved[column] += step
                jacobian[:, column] = (open_by(moved) - left) / step
            dependent -= lu_solve(jacobian, left)
        assert norm(open_by(list(dependent))) < 1000 * mp.eps
        known[q, mp.prec] = [q, *dependent]
        return known[q, mp.prec]

    return chain.energies(angles_of)


def slider_crank():
    r, l = mpf("0.153"), mpf("0.306")
    lean = lambda q: -mp.asin(r * sin(q) / l)
    slide = lambda q: r * cos(q) + sqrt(l * l - r * r * sin(q) ** 2)

    def mass(q):
        rate = diff(lean, q)
        x = lambda t: r * cos(t) + l / 2 * cos(lean(t))
        y = lambda t: r * sin(t) + l / 2 * sin(lean(t))
        m = mpf("0.038")
        crank = mpf("7.4e-5") + m * (r / 2) ** 2
        rod = m * (diff(x, q) ** 2 + diff(y, q) ** 2) + mpf("5.9e-4") * rate**2
        return crank + rod + mpf("0.076") * diff(slide, q) ** 2

    def potential(q):
        m = mpf("0.038")
        return m * G * (r / 2 * sin(q) + r * sin(q) + l / 2 * sin(lean(q)))

    return mass, potential


def four_bar():
    """A parallelogram, `q` of `left` about z from upright."""
    mass = lambda q: mpf(5) / 3
    potential = lambda q: 2 * G * cos(q)
    return mass, potential


def main():
    print("//! Written by `reference.py`.\n")
    for name, energies, angles in [
        ("FOUR_BAR", four_bar(), ["-1.1", "0.4", "1.3"]),
        ("SLIDER_CRANK", slider_crank(), ["-2.9", "0.7", "2.2"]),
        ("BRICARD", bricard(), ["0.05", "0.2", "0.45"]),
    ]:
        mass, potential = energies
        print("/// Angle (rad), mass (kg m^2), and bias (N m) at 1.5 rad/s.")
        print(f"pub(super) const {name}: [[f64; 3]; 3] = [")
        for angle in angles:
            q, rate = mpf(angle), mpf("1.5")
            bias = diff(mass, q) * rate**2 / 2 + diff(potential, q)
            numbers = [repr(float(number)) for number in (q, mass(q), bias)]
            print(f"    [{', '.join(numbers)}],")
        print("];")


main()

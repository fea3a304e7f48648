"""The equations of motion of an arm as CasADi has them: `casadi_arm.py FILE.urdf AXES OUT.c OUT.arm`.

Each link in its own axes, with numbers for all constants, so that CasADi leaves out what is zero and
shares what is common:

- `inverse`: Newton and Euler's equations outwards and back (Luh, Walker and Paul, 1980);
- `mass`: composite bodies (Walker and Orin, 1982);
- `forward`: both, and a factorisation L' D L from the tip, which fills nothing (Featherstone, 2008);
  at six and seven axes that is less than articulated bodies;
- `linearise`: derivatives of `forward` by angles, rates and torques, by way of those of `inverse`
  (Carpentier and Mansard, 2018).

A function is given cosines and sines of the angles, in pairs; with `_angles` it is given angles. All
values are held against Pinocchio's before the C file is written. Prints the operations of each. The
last file has the numbers of the arm, for `pinocchio.cpp`.
"""

import sys

import casadi
import numpy
import pinocchio


def exact(matrix):
    """Numbers as sparse symbols, without what rounding has left of zeros and ones."""
    matrix = numpy.array(matrix, dtype=float)
    rounded = numpy.round(matrix)
    matrix = numpy.where(numpy.abs(matrix - rounded) < 1e-9, rounded, matrix)
    return casadi.sparsify(casadi.SX(matrix))


def rotation(axis, cosine, sine):
    """The rotation about a coordinate axis, or against it."""
    place = int(numpy.argmax(numpy.abs(axis)))
    assert numpy.allclose(numpy.abs(axis), numpy.eye(3)[place]), axis
    c, s = cosine, axis[place] * sine
    rows = [
        [[1, 0, 0], [0, c, -s], [0, s, c]],
        [[c, 0, s], [0, 1, 0], [-s, 0, c]],
        [[c, -s, 0], [s, c, 0], [0, 0, 1]],
    ][place]
    return casadi.sparsify(casadi.vertcat(*[casadi.horzcat(*row) for row in rows]))


def cross(a, b):
    return casadi.sparsify(casadi.cross(a, b))


class Link:
    def __init__(self, model, joint):
        assert model.parents[joint] == joint - 1, "an arm is a chain"
        kind = model.joints[joint]
        data = kind.createData()
        kind.calc(data, numpy.zeros(kind.nq), numpy.zeros(kind.nv))
        self.direction = numpy.array(data.S).reshape(6)[3:]
        self.axis = exact(self.direction)
        place, inertia = model.jointPlacements[joint], model.inertias[joint]
        self.outwards, self.offset = exact(place.rotation), exact(place.translation)
        self.mass, self.lever = inertia.mass, exact(inertia.lever)
        self.spin = exact(inertia.inertia)
        c = numpy.array(inertia.lever)
        about = c @ c * numpy.eye(3) - numpy.outer(c, c)
        self.about_origin = exact(inertia.inertia + inertia.mass * about)


class Arm:
    def __init__(self, model):
        self.links = [Link(model, joint) for joint in range(1, model.njoints)]
        self.slope = exact(-model.gravity.linear)
        self.count = len(self.links)

    def turned(self, pairs):
        """From the axes of each link to those of the one before."""
        turns = zip(self.links, pairs)
        return [
            casadi.sparsify(link.outwards @ rotation(link.direction, *pair)) for link, pair in turns
        ]

    def inverse(self, turned, v, a):
        turn, rate, slope = casadi.SX(3, 1), casadi.SX(3, 1), self.slope
        loads = []
        for k, (link, outwards) in enumerate(zip(self.links, turned)):
            # Acceleration of the joint, then everything in the axes of the link.
            slope = slope + cross(turn, link.offset) + cross(rate, cross(rate, link.offset))
            slope = outwards.T @ slope
            carried = outwards.T @ rate
            own = link.axis * v[k]
            turn = outwards.T @ turn + link.axis * a[k] + cross(carried, own)
            rate = carried + own
            lever = link.lever
            centre = slope + cross(turn, lever) + cross(rate, cross(rate, lever))
            force = link.mass * centre
            moment = link.spin @ turn + cross(rate, link.spin @ rate) + cross(lever, force)
            loads.append((force, moment))
        torques = [None] * self.count
        force, moment = casadi.SX(3, 1), casadi.SX(3, 1)
        for k in reversed(range(self.count)):
            link, outwards = self.links[k], turned[k]
            force, moment = force + loads[k][0], moment + loads[k][1]
            torques[k] = casadi.dot(link.axis, moment)
            force = outwards @ force
            moment = outwards @ moment + cross(link.offset, force)
        return casadi.vertcat(*torques)

    def mass(self, turned):
        matrix = casadi.SX(self.count, self.count)
        masses = [link.mass for link in self.links]
        firsts = [link.mass * link.lever for link in self.links]
        seconds = [link.about_origin for link in self.links]
        for k in reversed(range(self.count)):
            axis = self.links[k].axis
            moment, force = seconds[k] @ axis, cross(axis, firsts[k])
            matrix[k, k] = casadi.dot(axis, moment)
            for j in reversed(range(k)):
                inner = self.links[j + 1]
                force = turned[j + 1] @ force
                moment = turned[j + 1] @ moment + cross(inner.offset, force)
                matrix[j, k] = matrix[k, j] = casadi.dot(self.links[j].axis, moment)
            if k > 0:
                # About the origin of the link before, by Steiner's theorem twice.
                p, m = self.links[k].offset, masses[k]
                first = turned[k] @ firsts[k]
                second = turned[k] @ seconds[k] @ turned[k].T
                second = casadi.triu(second) + casadi.triu(second, False).T
                along = 2 * casadi.dot(first, p) + m * casadi.dot(p, p)
                second = second + along * casadi.SX.eye(3)
                second = second - (first @ p.T + p @ first.T + m * p @ p.T)
                masses[k - 1] += m
                firsts[k - 1] = firsts[k - 1] + first + m * p
                seconds[k - 1] = seconds[k - 1] + second
        return matrix

    def forward(self, turned, v, x):
        bias = self.inverse(turned, v, casadi.SX(self.count, 1))
        return solve(factorised(self.mass(turned)), x - bias)

    def linearise(self, q, v, x):
        """By angles, rates and torques, each a matrix."""
        turned = self.turned([(casadi.cos(angle), casadi.sin(angle)) for angle in q.elements()])
        factors = factorised(self.mass(turned))
        unit = casadi.SX.eye(self.count)
        by_torques = casadi.horzcat(*[solve(factors, unit[:, k]) for k in range(self.count)])
        still = self.inverse(turned, v, casadi.SX(self.count, 1))
        a = casadi.SX.sym("a", self.count)
        torques = self.inverse(turned, v, a)
        slopes = casadi.horzcat(casadi.jacobian(torques, q), casadi.jacobian(torques, v))
        slopes = casadi.substitute(slopes, a, solve(factors, x - still))
        solved = [-solve(factors, slopes[:, k]) for k in range(2 * self.count)]
        return [
            casadi.horzcat(*solved[: self.count]),
            casadi.horzcat(*solved[self.count :]),
            by_torques,
        ]


def factorised(matrix):
    """L' D L, from the tip."""
    n = matrix.shape[0]
    lower, diagonal, rest = casadi.SX.eye(n), [None] * n, casadi.SX(matrix)
    for k in reversed(range(n)):
        diagonal[k] = rest[k, k]
        for i in range(k):
            lower[k, i] = rest[k, i] / diagonal[k]
        for i in range(k):
            for j in range(i + 1):
                rest[i, j] = rest[i, j] - lower[k, i] * rest[k, j]
                rest[j, i] = rest[i, j]
    return lower, diagonal


def solve(factors, right):
    lower, diagonal = factors
    n = len(diagonal)
    x = [right[i] for i in range(n)]
    for k in reversed(range(n)):
        for i in range(k):
            x[i] = x[i] - lower[k, i] * x[k]
    x = [x[k] / diagonal[k] for k in range(n)]
    for k in range(n):
        for i in range(k):
            x[k] = x[k] - lower[k, i] * x[i]
    return casadi.vertcat(*x)


def functions(arm):
    n = arm.count
    q, v, x, p = (casadi.SX.sym(name, size) for name, size in zip("qvxp", (n, n, n, 2 * n)))
    pairs = [(p[2 * k], p[2 * k + 1]) for k in range(n)]
    angles = [(casadi.cos(q[k]), casadi.sin(q[k])) for k in range(n)]
    made = {}
    for tail, given, turned in (("", p, arm.turned(pairs)), ("_angles", q, arm.turned(angles))):
        made["mass" + tail] = given, [arm.mass(turned)]
        made["inverse" + tail] = given, [arm.inverse(turned, v, x)]
        made["forward" + tail] = given, [arm.forward(turned, v, x)]
    made["linearise_angles"] = q, arm.linearise(q, v, x)
    return {
        name: casadi.Function(name, [given, v, x], casadi.cse([casadi.densify(o) for o in outputs]))
        for name, (given, outputs) in made.items()
    }


def symmetric(upper):
    return numpy.triu(upper) + numpy.triu(upper, 1).T


def verify(model, made):
    """Against Pinocchio, at random states."""
    data, random = model.createData(), numpy.random.default_rng(1)
    for _ in range(100):
        q, v, x = (random.uniform(-1.0, 1.0, model.nv) for _ in range(3))
        pinocchio.computeABADerivatives(model, data, q, v, x)
        by_angles, by_rates = data.ddq_dq.copy(), data.ddq_dv.copy()
        by_torques = symmetric(data.Minv)
        expected = {
            "mass": [symmetric(pinocchio.crba(model, data, q))],
            "inverse": [pinocchio.rnea(model, data, q, v, x).copy()],
            "forward": [pinocchio.aba(model, data, q, v, x).copy()],
            "linearise": [by_angles, by_rates, by_torques],
        }
        p = numpy.stack([numpy.cos(q), numpy.sin(q)], 1).flatten()
        for name, function in made.items():
            found = function.call([q if name.endswith("_angles") else p, v, x])
            for a, b in zip(found, expected[name.removesuffix("_angles")]):
                size = max(1.0, numpy.abs(b).max())
                error = numpy.abs(numpy.array(a).reshape(b.shape) - b).max()
                assert error < 1e-9 * size, (name, error, size)


def write(model, path):
    """The numbers of the arm, a line for each joint and its link."""
    with open(path, "w") as file:
        for joint, link in enumerate(Arm(model).links, start=1):
            place, inertia = model.jointPlacements[joint], model.inertias[joint]
            parts = [place.rotation, place.translation, link.direction, inertia.mass]
            parts += [inertia.lever, inertia.inertia]
            numbers = numpy.concatenate([numpy.ravel(part) for part in parts])
            print(*[repr(float(number)) for number in numbers], file=file)


def operations(function):
    """All instructions that compute: not inputs, outputs and constants."""
    still = (casadi.OP_INPUT, casadi.OP_OUTPUT, casadi.OP_CONST, casadi.OP_PARAMETER)
    return sum(
        function.instruction_id(k) not in still for k in range(function.n_instructions())
    )


def main():
    path, axes, out, numbers = sys.argv[1], int(sys.argv[2]), sys.argv[3], sys.argv[4]
    whole = pinocchio.buildModelFromUrdf(path)
    held = list(range(axes + 1, whole.njoints))
    model = pinocchio.buildReducedModel(whole, held, pinocchio.neutral(whole))
    made = functions(Arm(model))
    verify(model, made)
    write(model, numbers)
    generator = casadi.CodeGenerator(out, {"with_header": False})
    for name, function in made.items():
        generator.add(function)
        print(name.replace("_", "-"), operations(function))
    generator.generate()


main()

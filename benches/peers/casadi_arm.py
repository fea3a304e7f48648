"""Inverse dynamics of an arm as CasADi has it: `casadi_arm.py FILE.urdf AXES OUT.c`.

Newton and Euler's equations from the ground outwards and back, each link in its own axes (Luh,
Walker and Paul, 1980), with numbers for all constants, so that CasADi leaves out what is zero and
shares what is common. The values are held against Pinocchio's before the C file is written. Prints
the number of operations.
"""

import sys

import casadi
import numpy
import pinocchio


def rotation(axis, angle):
    """The rotation about a coordinate axis, or against it."""
    place = int(numpy.argmax(numpy.abs(axis)))
    assert numpy.allclose(numpy.abs(axis), numpy.eye(3)[place]), axis
    c, s = casadi.cos(angle), axis[place] * casadi.sin(angle)
    rows = [
        [[1, 0, 0], [0, c, -s], [0, s, c]],
        [[c, 0, s], [0, 1, 0], [-s, 0, c]],
        [[c, -s, 0], [s, c, 0], [0, 0, 1]],
    ][place]
    return casadi.vertcat(*[casadi.horzcat(*row) for row in rows])


def exact(matrix):
    """Numbers as sparse symbols, without what rounding has left of zeros and ones."""
    matrix = numpy.array(matrix, dtype=float)
    rounded = numpy.round(matrix)
    matrix = numpy.where(numpy.abs(matrix - rounded) < 1e-9, rounded, matrix)
    return casadi.sparsify(casadi.SX(matrix))


def inverse_dynamics(model):
    count = model.nv
    q, v, a = (casadi.SX.sym(name, count) for name in "qva")
    turn, rate, slope = (casadi.SX(3, 1) for _ in range(3))
    slope = exact(-model.gravity.linear)
    links = []
    for joint in range(1, model.njoints):
        place = model.jointPlacements[joint]
        axis = (model.joints[joint].createData(), model.joints[joint])[1]
        data = axis.createData()
        axis.calc(data, numpy.zeros(axis.nq), numpy.zeros(axis.nv))
        axis = numpy.array(data.S).reshape(6)[3:]
        k = joint - 1
        assert model.parents[joint] == k, "an arm is a chain"
        outwards = exact(place.rotation) @ rotation(axis, q[k])
        along = exact(axis)
        offset = exact(place.translation)
        # Acceleration of the joint, then everything in the axes of the link.
        slope = slope + casadi.cross(turn, offset) + casadi.cross(rate, casadi.cross(rate, offset))
        slope = outwards.T @ slope
        carried = outwards.T @ rate
        turn = outwards.T @ turn + along * a[k] + casadi.cross(carried, along * v[k])
        rate = carried + along * v[k]
        inertia = model.inertias[joint]
        lever = exact(inertia.lever)
        centre = slope + casadi.cross(turn, lever) + casadi.cross(rate, casadi.cross(rate, lever))
        force = inertia.mass * centre
        spin = exact(inertia.inertia)
        moment = spin @ turn + casadi.cross(rate, spin @ rate) + casadi.cross(lever, force)
        links.append((outwards, offset, along, force, moment))
    torques = [None] * count
    force, moment = casadi.SX(3, 1), casadi.SX(3, 1)
    for k in reversed(range(count)):
        outwards, offset, along, own_force, own_moment = links[k]
        force, moment = force + own_force, moment + own_moment
        torques[k] = casadi.dot(along, moment)
        force = outwards @ force
        moment = outwards @ moment + casadi.cross(offset, force)
    torques = casadi.cse(casadi.vertcat(*torques))
    return casadi.Function("inverse", [q, v, a], [torques])


def operations(function):
    """All instructions that compute: not inputs, outputs and constants."""
    still = (casadi.OP_INPUT, casadi.OP_OUTPUT, casadi.OP_CONST, casadi.OP_PARAMETER)
    return sum(
        function.instruction_id(k) not in still for k in range(function.n_instructions())
    )


def main():
    path, axes, out = sys.argv[1], int(sys.argv[2]), sys.argv[3]
    whole = pinocchio.buildModelFromUrdf(path)
    held = list(range(axes + 1, whole.njoints))
    model = pinocchio.buildReducedModel(whole, held, pinocchio.neutral(whole))
    function = inverse_dynamics(model)
    data = model.createData()
    random = numpy.random.default_rng(1)
    for _ in range(100):
        q, v, a = (random.uniform(-1.0, 1.0, axes) for _ in range(3))
        expected = pinocchio.rnea(model, data, q, v, a)
        found = numpy.array(function(q, v, a)).reshape(-1)
        assert numpy.allclose(found, expected, rtol=1e-9, atol=1e-9), (found, expected)
    generator = casadi.CodeGenerator(out, {"with_header": False})
    generator.add(function)
    generator.generate()
    print("operations", operations(function))


main()

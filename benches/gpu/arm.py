"""What a step, an evaluation and derivatives of a UR5 take on a GPU, by the number of arms at once.

    python3 arm.py FOLDER          on the GPU, by CuPy
    python3 arm.py FOLDER --host   on the processor instead, with fewer arms: needs no GPU

FOLDER has `single` and `double`, as the example `rollout` of holonom-export writes them. Numbers of
the GPU are compared with those of a C compiler. `arm.npz` is written there for `mjx.py`.
"""

import argparse
import ctypes
import re
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

STEPS, DT = 1000, 1e-3
HERE = Path(__file__).resolve().parent
# The launch does not matter for the numbers; small batches need small blocks to reach all of a GPU.
BLOCKS = (32, 64, 128)
# Counts are numbers of 8 bytes, as an address of 0 is.
count, none = np.uint64, np.uint64(0)


class Host:
    """The kernels as C. They are given what those of a GPU are."""

    name, blocks, arrays = "the processor, one thread", (1,), np

    def __init__(self, folder, options):
        library = folder / f"arm{''.join(options)}.so"
        command = ["cc", "-std=c99", "-O2", *options, "-shared", "-fPIC", f"-I{folder}", "-o", library, "-xc", HERE / "arm.cu", "-lm"]
        subprocess.run(command, check=True)
        self.library = ctypes.CDLL(str(library))

    def call(self, name, worlds, arguments, block=1):
        """Calls a kernel; what it took (ns)."""
        types = {"uint64": ctypes.c_size_t, "float32": ctypes.c_float, "float64": ctypes.c_double}
        address = lambda array: ctypes.c_void_p(array.ctypes.data)
        given = [address(x) if isinstance(x, np.ndarray) else types[x.dtype.name](x) for x in (count(worlds), *arguments)]
        begun = time.perf_counter_ns()
        getattr(self.library, name)(*given)
        return time.perf_counter_ns() - begun

    def joints(self, states):
        """Angles and rates of the joints, of states world by world."""
        joints = np.empty((len(states), 12), states.dtype)
        for state, of_state in zip(np.ascontiguousarray(states), joints):
            self.library.ur5_get_joints(ctypes.c_void_p(state.ctypes.data), ctypes.c_void_p(of_state.ctypes.data))
        return joints


class Card:
    """The kernels on the current GPU."""

    blocks = BLOCKS

    def __init__(self, folder):
        import cupy

        self.arrays = cupy
        try:
            self.name = cupy.cuda.runtime.getDeviceProperties(cupy.cuda.Device().id)["name"].decode()
        except cupy.cuda.runtime.CUDARuntimeError as error:
            sys.exit(f"no GPU of NVIDIA: {error}")
        self.module = cupy.RawModule(code=(HERE / "arm.cu").read_text(), options=(f"-I{folder.resolve()}",))

    def call(self, name, worlds, arguments, block=128):
        """Calls a kernel; what it took (ns)."""
        events = self.arrays.cuda.Event(), self.arrays.cuda.Event()
        kernel = self.module.get_function(name)
        events[0].record()
        kernel(((worlds + block - 1) // block,), (block,), (count(worlds), *arguments))
        events[1].record()
        events[1].synchronize()
        return 1e6 * self.arrays.cuda.get_elapsed_time(*events)


class Arms:
    """Many arms in the described configuration, with rates and torques of their own, at random."""

    def __init__(self, device, folder, worlds, real):
        self.device, self.worlds, self.real, xp = device, worlds, real, device.arrays
        rows = int(re.search(r"ROLLOUT_STATE (\d+)", (folder / "ur5_rollout.cu").read_text())[1])
        self.states = xp.empty((rows, worlds), real)
        device.call("ur5_rollout_init", worlds, (self.states,))

        def drawn(seed):
            # Of an arm, the same for every device and for every number of arms.
            numbers = np.random.default_rng(seed).uniform(-1.0, 1.0, (worlds, 6))
            return xp.asarray(np.ascontiguousarray(numbers.T.astype(real)))

        # The rates are the last numbers of a state, in the order of ur5.h.
        self.states[-6:] = drawn(1)
        self.inputs = drawn(2)
        self.start = self.states.copy()

    def rolled(self, block=128):
        """From the start, STEPS steps without torques; what it took (ns)."""
        xp = self.device.arrays
        self.states[...] = self.start
        taken, statuses = xp.empty(self.worlds, xp.uint64), xp.empty(self.worlds, xp.int32)
        arguments = (count(STEPS), self.real(DT), none, none, none, self.states, none, none, taken, statuses)
        spent = self.device.call("ur5_rollout", self.worlds, arguments, block)
        if not bool((taken == STEPS).all()) or bool(statuses.any()):
            sys.exit("an arm stopped on its way")
        return spent

    def evaluated(self, name, numbers):
        """What an evaluation takes in the states of now, by the size of a block; and its numbers."""
        results = self.device.arrays.empty((numbers, self.worlds), self.real)
        return lambda block=128: self.device.call(name, self.worlds, (self.states, self.inputs, results), block), results


def least(device, rounds, call):
    """The least of some rounds with blocks of every size."""
    return min(call(block) for block in device.blocks for _ in range(rounds))


def on_host(array):
    return array if isinstance(array, np.ndarray) else array.get()


def compared(what, these, those):
    """Ends where numbers differ by more than round-off, of the largest of them."""
    away = np.abs(these - those).max() / np.abs(those).max()
    if not away < 1e5 * np.finfo(those.dtype).eps:
        sys.exit(f"{what}: numbers are not those of the C compiler, by {away:.1e} of the largest")


def measured(device, folder, real, batches):
    """The rows of a table, by name; compared with the numbers of C."""
    host = Host(folder, ("-ffp-contract=off",))
    kernels = {"evaluation": ("arm_evaluation", 6), "with derivatives, 6 x 18": ("arm_derivatives", 108)}
    table = {"step of Runge-Kutta": [], **{row: [] for row in kernels}}
    few = min(64, *batches)
    expected = Arms(host, folder, few, real)
    expected.rolled()
    for worlds in batches:
        arms = Arms(device, folder, worlds, real)
        table["step of Runge-Kutta"].append(least(device, 4, arms.rolled) / (worlds * STEPS))
        first = lambda array: on_host(array[:, :few])
        # What the last digits of the time leave over are in row 1.
        compared("a rollout", np.delete(first(arms.states), 1, 0), np.delete(expected.states, 1, 0))
        arms.states[:, :few] = device.arrays.asarray(expected.states)
        for row, (name, numbers) in kernels.items():
            call, results = arms.evaluated(name, numbers)
            table[row].append(least(device, 20, call) / worlds)
            call, of_host = expected.evaluated(name, numbers)
            call()
            compared(row, first(results), of_host)
    return table, host, expected


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("folder", type=Path)
    arguments.add_argument("--host", action="store_true", help="on the processor instead")
    arguments = arguments.parse_args()
    batches = (64, 256) if arguments.host else (256, 4096, 65536, 1 << 20)
    lines = []
    for name, real in (("single", np.float32), ("double", np.float64)):
        folder = arguments.folder / name
        # Products and sums are rounded at once, as on a GPU.
        device = Host(folder, ("-march=native", "-ffp-contract=fast")) if arguments.host else Card(folder)
        table, host, expected = measured(device, folder, real, batches)
        lines += [f"{row + ', ' + real.__name__:44}" + "".join(f"{spent:11.4g}" for spent in spents) for row, spents in table.items()]
    np.savez(arguments.folder / "arm.npz", steps=STEPS, dt=DT, batches=batches,
             start=host.joints(expected.start.T), end=host.joints(expected.states.T))
    print(f"{device.name}: ns each, for a UR5, by the number of arms at once")
    print(" " * 44 + "".join(f"{worlds:11}" for worlds in batches))
    print("\n".join(lines))


main()

"""Rollouts of four-bars on many machines, by Dask: `python ensemble.py [COUNT [SCHEDULER]]`.

Without the address of a scheduler two processes of this machine do the work. Every task rolls out a
hundred linkages, in lanes.
"""

import contextlib
import sys

import numpy as np
from dask.distributed import Client, LocalCluster

COUNT, PIECE = 400, 100


def rolled_out(lengths, seed):
    """The greatest height of the coupler of each linkage in a second (m)."""
    from linkages import FourBar

    torques = np.random.default_rng(seed).uniform(-1.0, 1.0, len(lengths))
    found = FourBar().rollouts(
        1.0,
        5e-3,
        every=10,
        parameters={"crank_length": lengths},
        inputs={"torque": torques},
        limits=False,
        threads=1,
    )
    return found["coupler_height"].max(axis=1)


def main(count=COUNT, scheduler=None):
    lengths = np.random.default_rng(1).uniform(0.2, 0.28, count)
    with contextlib.ExitStack() as stack:
        if scheduler is None:
            scheduler = stack.enter_context(
                LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None)
            )
        client = stack.enter_context(Client(scheduler))
        pieces = [(lengths[at : at + PIECE], at) for at in range(0, count, PIECE)]
        tasks = [client.submit(rolled_out, *piece, pure=False) for piece in pieces]
        heights = np.concatenate(client.gather(tasks))
    # The first piece once more, here.
    assert np.array_equal(heights[:PIECE], rolled_out(*pieces[0]))
    return heights


if __name__ == "__main__":
    heights = main(*map(int, sys.argv[1:2]), *sys.argv[2:3])
    print(f"{len(heights)} linkages, {np.nanmin(heights):.3f} m to {np.nanmax(heights):.3f} m")

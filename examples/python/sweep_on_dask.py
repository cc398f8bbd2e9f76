"""A sweep on dask.distributed: which voxel size gives the best mesh of a simulated letter A?

    python3 sweep_on_dask.py FOLDER [SCHEDULER]

FOLDER keeps the recording; all workers must see it by the same path. SCHEDULER is the address of a
dask scheduler (tcp://host:8786); without it two workers are started on this machine.
"""

import pathlib
import sys

from dask.distributed import Client

VOXEL_SIZES = [0.003, 0.005, 0.008]  # metres


def f_score(recording, voxel_size):
    """Runs on a worker: F at 1 mm of the mesh, over all of the surface."""
    import turnscan

    turnscan.set_threads(1)  # the workers share the processors already
    made = turnscan.reconstruct(recording, voxel_size=voxel_size)
    truth = turnscan.Mesh.load(f"{recording}/truth/object.ply")
    figures = turnscan.evaluate(made.meshes[0], truth, samples=20000)
    return next(score["f"] for score in figures["scores"] if abs(score["threshold_m"] - 1e-3) < 1e-6)


def main(folder, scheduler=None):
    import turnscan

    recording = str(pathlib.Path(folder).absolute() / "letter")
    if not pathlib.Path(recording).exists():
        turnscan.simulate("builtin:letter-a", frames=24, noise="model", out=recording)
    client = Client(scheduler) if scheduler else Client(n_workers=2, threads_per_worker=1,
                                                        dashboard_address=None)
    with client:
        tasks = client.map(f_score, [recording] * len(VOXEL_SIZES), VOXEL_SIZES)
        for size, score in zip(VOXEL_SIZES, client.gather(tasks)):
            print(f"voxel size {1e3 * size:.0f} mm: F at 1 mm {score:.3f}")


if __name__ == "__main__":  # the workers of this machine read this file, too
    main(*sys.argv[1:])

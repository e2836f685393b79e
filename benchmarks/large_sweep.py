"""A large sweep on two workers: its memory, its time, what a lost worker and a lost run cost.

    python benchmarks/large_sweep.py 1e8 /tmp/large

It kills a worker when a third of the blocks is kept, and the whole run when two thirds are, starts
again, and holds all that was kept against what one process computes, bit by bit. The folder takes
about 8 bytes a point for each of ten variables while it runs.
"""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import distributed
import numpy as np
import psutil
import xarray as xr
from click import echo as say

import optipath as op

GOLD = {"n1": 0.18, "k1": 3.4, "n2": 0.18, "k2": 3.4}
WORKERS = {"n_workers": 2, "threads_per_worker": 1, "memory_limit": "2GiB"}
LOCAL = {"host": "127.0.0.1", "dashboard_address": None}


def axes(points: float) -> dict[str, np.ndarray]:
    """Return the axes of a grid of so many points."""
    return {
        "delta": np.linspace(0.01, 1.5, round(points / 200_000)),
        "rho": np.linspace(0.0, 3.1, 400),
        "phi": np.linspace(0.01, 1.5, 500),
    }


def swept(points: float, **options: object) -> xr.Dataset:
    """Return the sweep."""
    path = op.load_preset("npgr026")
    return path.sweep(**axes(points), **GOLD, filter="horizontal", **options)


def peak() -> float:
    """Return the most memory that this process has had, in GiB."""
    status = Path("/proc/self/status").read_text(encoding="ascii")
    return int(status.split("VmHWM:")[1].split()[0]) / 2**20


def keep(points: float, store: str) -> None:
    """Keep the sweep, and say what it took."""
    began = time.perf_counter()
    with distributed.LocalCluster(**WORKERS, **LOCAL) as cluster, cluster.get_client() as client:
        swept(points, store=store)
        most = max(client.run(peak).values())
    say(f"  {time.perf_counter() - began:.0f} s, {most:.2f} GiB a worker")


def only_s0(points: float, store: str) -> None:
    """Write S0 alone by Dask, of a sweep in chunks, and say what it took."""
    began = time.perf_counter()
    with distributed.LocalCluster(**WORKERS, **LOCAL) as cluster, cluster.get_client() as client:
        found = swept(points, chunks="auto")[["S0"]]
        found.to_zarr(store, zarr_format=2)
        most = max(client.run(peak).values())
    say(f"  {time.perf_counter() - began:.0f} s, {most:.2f} GiB a worker")


def started(function: str, points: float, store: Path) -> subprocess.Popen[bytes]:
    """Start a function of this file in a process of its own."""
    return subprocess.Popen([sys.executable, __file__, str(points), str(store), function])


def marks(store: Path) -> dict[str, int]:
    """Return which blocks are kept, and when each was."""
    folder = store / "blocks" / "done"
    there = folder.iterdir() if folder.exists() else ()
    return {each.name: each.stat().st_mtime_ns for each in there if each.name[0] != "."}


def wait_for(run: subprocess.Popen[bytes], store: Path, count: float) -> None:
    """Wait until so many blocks are kept."""
    while run.poll() is None and len(marks(store)) < count:
        time.sleep(0.1)


def workers_of(run: subprocess.Popen[bytes]) -> list[psutil.Process]:
    """Return the processes of the workers of a run."""
    found = psutil.Process(run.pid).children(recursive=True)
    return [each for each in found if "spawn_main" in " ".join(each.cmdline())]


def compare(points: float, store: Path) -> int:
    """Return how many numbers of a store are not those of one process, bit by bit."""
    differing, kept = 0, xr.open_zarr(store)
    path, given = op.load_preset("npgr026"), axes(points)
    for first in range(0, len(given["delta"]), 7):
        part = slice(first, first + 7)
        alone = path.sweep(**{**given, "delta": given["delta"][part]}, **GOLD, filter="horizontal")
        for name in kept.data_vars:
            here, there = (each.to_numpy() for each in (alone[name], kept[name][part]))
            differing += int(np.sum(here.view(np.int64) != there.view(np.int64)))
    return differing


def main(points: float, folder: Path) -> None:
    """Run it all."""
    folder.mkdir()
    store, blocks = (
        folder / "large.zarr",
        int(np.prod(swept(points, chunks="auto").S0.data.numblocks)),
    )
    say(f"{points:.0e} points in {blocks} blocks")
    run = started("keep", points, store)
    wait_for(run, store, blocks / 3)
    workers_of(run)[0].kill()
    say(f"a worker was killed when {len(marks(store))} were kept")
    wait_for(run, store, 2 * blocks / 3)
    run.send_signal(signal.SIGKILL)
    run.wait()
    time.sleep(5)  # Its workers see that it is gone.
    before = marks(store)
    say(f"the run was killed when {len(before)} were kept")
    began = time.perf_counter()
    assert started("keep", points, store).wait() == 0
    after = marks(store)
    again = sum(after[name] != moment for name, moment in before.items())
    say(
        f"the next one computed {len(after) - len(before)} and {again} of those once more, in "
        f"{time.perf_counter() - began:.0f} s"
    )
    say(f"numbers that one process has differently: {compare(points, store)}")
    say("S0 alone, by Dask:")
    assert started("only_s0", points, folder / "s0.zarr").wait() == 0
    with xr.open_zarr(folder / "s0.zarr") as alone, xr.open_zarr(store) as kept:
        say(f"  differing: {int((alone.S0 != kept.S0).sum())}")
    shutil.rmtree(folder)


if __name__ == "__main__":
    given, place, *function = sys.argv[1:]
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    {"keep": keep, "only_s0": only_s0, "": main}["".join(function)](float(given), Path(place))

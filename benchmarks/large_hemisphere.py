"""A large measurement on two workers: its memory, its time, and what a lost worker and run cost.

    python benchmarks/large_hemisphere.py 1e8 /tmp/hemisphere.zarr

A worker is killed when a third of the chunks is kept, and the whole run when two thirds are; the
next one goes on from there. What comes out is held bit by bit against a measurement without a
store, and without workers.
"""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from threading import Thread

import distributed
import numpy as np
import psutil
from click import echo as say

import optipath as op

WORKERS = {"n_workers": 2, "threads_per_worker": 1, "memory_limit": "1GiB"}
LOCAL = {"host": "127.0.0.1", "dashboard_address": None}


def measured(photons: float, **options: object) -> op.Hemisphere:
    """Return the measurement."""
    sample = op.Sample([(0.5 + 2.1j, 0.3)])
    return op.measure(sample, "50 deg", photons=int(photons), **options)


def resident(process: psutil.Process) -> float:
    """Return the memory of a process, in GiB; none where it is gone."""
    try:
        return float(process.memory_info().rss) / 2**30
    except psutil.Error:
        return 0.0


def watch(most: list[float]) -> None:
    """Keep the most memory that any worker has had."""
    while True:
        there = [resident(each) for each in workers_of(psutil.Process())]
        most[0] = max([most[0], *there])
        time.sleep(0.05)


def keep(photons: float, store: Path) -> None:
    """Measure by two workers, and say what it took."""
    began = time.perf_counter()
    with distributed.LocalCluster(**WORKERS, **LOCAL) as cluster, cluster.get_client() as client:
        found = measured(photons, store=store, scheduler=client)
    took = time.perf_counter() - began
    own = resident(psutil.Process())
    say(f"  {took:.0f} s, {own:.2f} GiB where they are added")
    np.savez(store.with_suffix(".npz"), *found.parts)


def alone(photons: float, store: Path) -> None:
    """Measure without a store and workers, and say in how many numbers it differs."""
    began = time.perf_counter()
    found = measured(photons)
    say(f"  {time.perf_counter() - began:.0f} s")
    with np.load(store.with_suffix(".npz")) as kept:
        others = [kept[name] for name in kept.files]
    differing = (
        int(np.sum(here.view(np.int64) != there.view(np.int64)))
        for here, there in zip(found.parts, others, strict=True)
    )
    say(f"  {sum(differing)} of {sum(each.size for each in others)} numbers differ")


def started(function: str, photons: float, store: Path) -> subprocess.Popen[bytes]:
    """Start a function of this file in a process of its own."""
    return subprocess.Popen([sys.executable, __file__, str(photons), str(store), function])


def marks(store: Path) -> dict[str, int]:
    """Return which chunks are kept, and when each was."""
    folder = store / "blocks" / "done"
    there = folder.iterdir() if folder.exists() else ()
    return {each.name: each.stat().st_mtime_ns for each in there if each.name[0] != "."}


def wait_for(run: subprocess.Popen[bytes], store: Path, count: float) -> None:
    """Wait until so many chunks are kept."""
    while run.poll() is None and len(marks(store)) < count:
        time.sleep(0.1)


def workers_of(run: psutil.Process) -> list[psutil.Process]:
    """Return the processes of the workers of a run."""
    try:
        found = run.children(recursive=True)
        return [each for each in found if "spawn_main" in " ".join(each.cmdline())]
    except psutil.Error:
        return []


def main(photons: float, store: Path) -> None:
    """Run it all."""
    chunks = -(-int(photons) // 2**22)
    say(f"{photons:.0e} photons in {chunks} chunks")
    most = [0.0]
    Thread(target=watch, args=(most,), daemon=True).start()
    run = started("keep", photons, store)
    wait_for(run, store, chunks / 3)
    workers_of(psutil.Process(run.pid))[0].kill()
    say(f"a worker was killed when {len(marks(store))} were kept")
    wait_for(run, store, 2 * chunks / 3)
    run.send_signal(signal.SIGKILL)
    run.wait()
    time.sleep(10)  # Its workers see that it is gone.
    before = marks(store)
    say(f"the run was killed when {len(before)} were kept")
    assert started("keep", photons, store).wait() == 0
    after = marks(store)
    again = sum(after[name] != moment for name, moment in before.items())
    say(f"  at most {most[0]:.2f} GiB a worker")
    say(f"  it walked {len(after) - len(before)} chunks, and {again} of those kept once more")
    say("in one process, without a store:")
    assert started("alone", photons, store).wait() == 0
    shutil.rmtree(store)
    store.with_suffix(".npz").unlink()


if __name__ == "__main__":
    given, place, *function = sys.argv[1:]
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    {"keep": keep, "alone": alone, "": main}["".join(function)](float(given), Path(place))

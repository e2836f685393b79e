"""Large jobs that are small: for tests of blocks that are kept, and for the workers of these."""

import os
import signal
import time
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
import xarray as xr

from optipath.errors import ValueFault

ROWS, COLUMNS = 4, 3


@dataclass(frozen=True)
class Powers:
    """Powers of whole numbers, four rows a block; each block that is computed is told in a log."""

    blocks: int
    log: str = ""
    slow: float = 0.0
    fails_at: int = -1
    kills_at: int = -1
    title: str = "powers"
    axis: bytes = b""

    @property
    def identity(self):
        return f"{self.title}\nblocks = {self.blocks}"

    @property
    def dataset(self):
        attrs = {"units": "1", "long_name": "power"}
        return xr.Dataset(
            {
                "power": (("number", "exponent"), np.zeros((ROWS * self.blocks, COLUMNS)), attrs),
                "total": ("block", np.zeros(self.blocks, "int64")),
            },
            {
                "number": ("number", np.arange(float(ROWS * self.blocks)), {"units": "m"}),
                "called": ("exponent", np.array(["itself", "square", "cube"])),
            },
            {"path": "[vertices]\n", "title": self.title},
        )

    @property
    def chunks(self):
        return {"power": (2, COLUMNS), "total": (1,)}

    def places(self, number):
        rows = slice(ROWS * number, ROWS * (number + 1))
        return {"power": (rows, slice(0, COLUMNS)), "total": (slice(number, number + 1),)}

    def task(self, number):
        return partial(self.compute, number)

    def compute(self, number):
        if self.log:
            told_in(Path(self.log), number)
        time.sleep(self.slow)
        if number == self.fails_at:
            raise ValueFault(f"block {number} is dark")
        if number == self.kills_at:
            os.kill(os.getpid(), signal.SIGKILL)
        rows = slice(ROWS * number, ROWS * (number + 1))
        values = np.arange(rows.start, rows.stop)[:, np.newaxis] ** np.arange(1.0, COLUMNS + 1)
        total = np.array([int(values.sum())])
        return {"power": values, "total": total}


class WhoComputes(Powers):
    """Its numbers are the process that computes them."""

    def compute(self, number):
        found = super().compute(number)
        return found | {"power": np.full_like(found["power"], os.getpid())}


def told_in(log, number):
    """Add a line in one piece, whichever processes do so at a time."""
    place = os.open(log, os.O_WRONLY | os.O_APPEND | os.O_CREAT)
    os.write(place, f"{number}\n".encode())
    os.close(place)


def computed(log):
    """The numbers of the blocks that were computed, in this order."""
    return [int(line) for line in log.read_text().split()] if log.exists() else []


def powers(blocks):
    """What they are, all at once."""
    return np.arange(ROWS * blocks)[:, np.newaxis] ** np.arange(1.0, COLUMNS + 1)


def marked(store):
    """The numbers of the blocks that a store says it has."""
    files = (Path(store) / "blocks" / "done").glob("*.0")
    return {int(file.stem) for file in files}

"""How light off rough surfaces depends on what these are made of: tables, and pictures of them.

    pip install "optipath[fast,chart]"
    python examples/surface_convergence.py docs/surfaces.json docs

Measures what is not in the file yet, an hour or less of one processor for all of it; prints the
tables of docs/surfaces.md, and draws its pictures into the folder.
"""

import functools
import io
import json
import sys
import warnings
from pathlib import Path
from typing import NamedTuple

import matplotlib.pyplot as plt
import numpy as np

import optipath as op
from optipath.surfaces import HeightField, energy
from optipath.surfaces.fields.random_waves import RandomWaves
from optipath.values.written_files import write_file

SHARES = "R_s", "R_m", "T_s", "T_m", "lost"
PHOTONS = 3 * 16_384
"""How many walk over each surface."""


class Case(NamedTuple):
    """Light on many surfaces of one kind; ``1j`` is the index of a perfect reflector."""

    index: str
    alpha: float
    incidence: float
    lengths: int = 40  # correlation lengths 2 / alpha along each side
    cells: int = 16  # a correlation length
    waves: int = 1000
    kind: str = "periodic"  # or "finite", or "independent": finite, of independent random waves
    surfaces: int = 32


GLASS = Case("1.5", 1.0, 1.0)
CELLS = 2, 3, 4, 5, 8, 16, 32
ALPHAS, INCIDENCES = (0.1, 0.2, 0.3, 0.5, 0.7, 1.0), (0.0, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5)
GRAZING = Case("1j", 0.1, 1.5)

BY_CELLS = [GLASS._replace(alpha=a, cells=c) for a in (0.1, 0.3, 1.0) for c in CELLS]
BY_WIDTH = [
    case._replace(lengths=n, waves=waves, surfaces=surfaces)
    for case in (GLASS, GRAZING)
    for n, waves, surfaces in ((10, 1000, 64), (20, 1000, 64), (40, 1000, 64), (80, 5000, 32))
]
BY_WAVES = [GLASS._replace(waves=n, surfaces=64) for n in (30, 100, 300, 1000, 3000)]
BY_KIND = [GLASS._replace(lengths=80, cells=8, kind=kind) for kind in ("finite", "independent")]
BY_DIRECTION = [
    Case("1j", alpha, theta, surfaces=8) for alpha in ALPHAS for theta in INCIDENCES
]
USUAL = [
    Case(index, alpha, theta, surfaces=32)
    for index in ("1.5", "1j")
    for alpha in (0.1, 0.3, 1.0)
    for theta in (0.0, 1.0, 1.5)
]
LARGE = [case._replace(lengths=80, waves=5000, surfaces=24) for case in USUAL]
AT_A_BORDER = [
    Case("1.5", alpha, theta, kind="finite", surfaces=8)
    for alpha in (0.1, 1.0)
    for theta in (0.0, 0.5, 1.0, 1.5)
]


@functools.lru_cache(maxsize=32)
def heights(lengths, cells, waves, kind, number):
    """Return the heights of one surface of alpha 1; others have the same ones further apart."""
    seed = np.random.SeedSequence(0, spawn_key=(number, 0))  # as the fields of a sample have it
    size, side = 2.0 * lengths, lengths * cells
    if kind != "independent":
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", op.MeshWarning)
            periodic = kind == "periodic"
            drawn = HeightField.beckmann(1.0, None, size, side, waves, seed, periodic=periodic)
        return drawn.heights
    phase, turn, length = np.random.default_rng(seed).random((3, waves))
    length = np.sqrt(-np.log(length))
    x, y = length * np.cos(2.0 * np.pi * turn), length * np.sin(2.0 * np.pi * turn)
    order, places = np.argsort(x), np.linspace(0.0, size, side + 1)
    amplitude = np.full(waves, np.sqrt(2.0 / waves))
    drawn = RandomWaves(x[order], y[order], 2.0 * np.pi * phase, amplitude)
    return drawn.heights(places, places)


def measured(case):
    """Return mean, standard error and, without the photons' chance, spread over surfaces."""
    found = []
    for number in range(case.surfaces):
        surface = heights(case.lengths, case.cells, case.waves, case.kind, number)
        size = (2.0 * case.lengths / case.alpha,) * 2
        field = HeightField(surface, size, case.kind == "periodic", (case.alpha, case.alpha))
        sample = op.Sample([(complex(case.index), field)])
        one = energy(sample, case.incidence, photons=PHOTONS, seed=number, threads=1)
        found.append([[getattr(one, name + end) for name in SHARES] for end in ("", "_se")])
    means, errors = np.moveaxis(np.array(found), 1, 0)
    spread = means.var(axis=0, ddof=1)
    alone = np.sqrt(np.maximum(spread - np.mean(errors**2, axis=0), 0.0))
    numbers = means.mean(axis=0), np.sqrt(spread / case.surfaces), alone
    return dict(zip(SHARES, np.round(numbers, 7).T.tolist(), strict=True))


def keep(file):
    """Measure what the file does not have yet, and return all that it has."""
    known = {}
    if file.exists():
        for row in json.loads(file.read_text("utf-8")):
            known[Case(*row["case"])] = row["shares"]
    for case in dict.fromkeys(CASES):
        if case not in known:
            known[case] = measured(case)
            print(*case, known[case], file=sys.stderr, flush=True)
            rows = [json.dumps({"case": each, "shares": known[each]}) for each in known]
            write_file(file, f"[{(',' + chr(10)).join(rows)}]\n".encode())
    return known


CASES = [
    *(BY_CELLS + BY_WAVES + BY_WIDTH + BY_KIND + USUAL + LARGE + BY_DIRECTION + AT_A_BORDER),
]

if __name__ == "__main__":
    keep(Path(sys.argv[1]))

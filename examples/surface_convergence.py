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
from operator import attrgetter
from pathlib import Path
from typing import NamedTuple

import matplotlib.pyplot as plt
import numpy as np

import optipath as op
from optipath.surfaces import HeightField, energy
from optipath.surfaces.random_field import RandomWaves
from optipath.values.files import write_file

SHARES = "R_s", "R_m", "T_s", "T_m", "lost", "scalar.R_m", "scalar.T_m"
PHOTONS = 3 * 16_384
"""How many walk over each surface."""


class Case(NamedTuple):
    """Light on many surfaces of one kind."""

    index: str  # below each interface, from the top; 1j of a perfect reflector
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
GRAZING, STEEP = Case("1j", 0.1, 1.5), Case("1.5", 1.0, 1.5)
WIDTHS = (10, 1000, 64), (20, 1000, 64), (40, 1000, 64), (80, 5000, 32)

BY_CELLS = [GLASS._replace(alpha=a, cells=c) for a in (0.3, 1.0) for c in CELLS]
BY_WIDTH = {
    name: [
        case._replace(lengths=lengths, waves=waves, surfaces=surfaces)
        for lengths, waves, surfaces in WIDTHS
    ]
    for name, case in (("T_m", GLASS), ("T_s", STEEP), ("R_m", GRAZING))
}
BY_WAVES = [GLASS._replace(waves=n, surfaces=64) for n in (30, 100, 300, 1000, 3000)]
BY_KIND = [GLASS._replace(lengths=80, cells=8, kind=kind) for kind in ("finite", "independent")]
BY_DIRECTION = [Case("1j", alpha, theta, surfaces=8) for alpha in ALPHAS for theta in INCIDENCES]
USUAL = [
    Case(index, alpha, theta, surfaces=32)
    for index in ("1.5", "1j")
    for alpha in (0.1, 0.3, 1.0)
    for theta in (0.0, 1.0, 1.5)
]
LARGE = [case._replace(lengths=80, waves=5000, surfaces=24) for case in USUAL]
BORDER_INCIDENCES = 0.0, 0.5, 1.0, 1.5
AT_A_BORDER = [
    Case("1.5 2.4", alpha, theta, lengths=lengths, kind="finite", surfaces=8)
    for alpha, lengths in ((0.1, 20), (0.1, 40), (1.0, 40))
    for theta in BORDER_INCIDENCES
]


@functools.lru_cache(maxsize=32)
def heights(lengths, cells, waves, kind, number, layer):
    """Return the heights of one surface of alpha 1; others have the same ones further apart."""
    seed = np.random.SeedSequence(0, spawn_key=(number, layer))  # as a sample's fields have it
    size, side = 2.0 * lengths, lengths * cells
    if kind != "independent":
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", op.errors.MeshWarning)
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


def field_of(case, number, layer):
    """Return one of the fields of a case."""
    surface = heights(case.lengths, case.cells, case.waves, case.kind, number, layer)
    size = (2.0 * case.lengths / case.alpha,) * 2
    return HeightField(surface, size, case.kind == "periodic", (case.alpha, case.alpha))


def measured(case):
    """Return mean, standard error and, without the photons' chance, spread over surfaces."""
    found = []
    for number in range(case.surfaces):
        layers = enumerate(case.index.split())
        sample = op.Sample([(complex(n), field_of(case, number, layer)) for layer, n in layers])
        one = energy(sample, case.incidence, photons=PHOTONS, seed=number, threads=1)
        found.append([[attrgetter(name + end)(one) for name in SHARES] for end in ("", "_se")])
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
    for case in CASES:
        if case not in known:
            known[case] = measured(case)
            print(*case, known[case], file=sys.stderr, flush=True)
            rows = [{"case": each, "shares": known[each]} for each in CASES if each in known]
            text = ",\n".join(json.dumps(row) for row in rows)
            write_file(file, f"[{text}]\n".encode())
    return known


_ALL = [BY_CELLS, BY_WAVES, BY_KIND, USUAL, LARGE, BY_DIRECTION, AT_A_BORDER, *BY_WIDTH.values()]
CASES = list(dict.fromkeys(case for cases in _ALL for case in cases))


def number(shares, name):
    """Return a share with its standard error, as a table has it."""
    mean, error, _ = shares[name]
    return f"{mean:.5f} ± {error:.5f}"


def apart(shares, name):
    """Return how far one surface is from others, where that is more than the photons' chance."""
    mean, _, spread = shares[name]
    return f"{100 * spread / mean:.1f} %" if spread else "-"


def table(heads, rows):
    """Print a table as documents have it."""
    for row in (heads, ["---"] * len(heads), *rows):
        print("|", " | ".join(str(each) for each in row), "|")
    print()


def table_of_cells(known):
    """Print what meshes of more and more cells give."""
    names, rows = (*SHARES[:4], *SHARES[-2:]), []
    for case in BY_CELLS:
        finest = known[case._replace(cells=CELLS[-1])]["T_m"][0]
        missing = f"{100 * (1 - known[case]['T_m'][0] / finest):.1f} %"
        rows.append([case.alpha, case.cells, *(number(known[case], s) for s in names), missing])
    table(["alpha", "cells", *names, "missing of T_m"], rows)


def table_of_widths(known):
    """Print what wider and wider fields give, and how far one surface is from others."""
    rows = [[width, waves, surfaces] for width, waves, surfaces in WIDTHS]
    for name, cases in BY_WIDTH.items():
        for row, case in zip(rows, cases, strict=True):
            row += [number(known[case], name), apart(known[case], name)]
    heads = ["T_m", "apart", "T_s, 1.5 rad", "apart", "R_m, mirror", "apart"]
    table(["width", "waves", "surfaces", *heads], rows)


def table_of_waves(known):
    """Print what more and more waves give, and those that are drawn independently."""
    rows = []
    for case in BY_WAVES + BY_KIND:
        shares = known[case]
        lost = f"{100 * shares['lost'][0]:.2f} %"
        what = [case.kind, case.lengths, case.cells, case.waves]
        rows.append([*what, number(shares, "T_m"), apart(shares, "T_m"), lost])
    table(["kind", "width", "cells", "waves", "T_m", "apart", "lost"], rows)


def table_beside_large(known):
    """Print how far fields as samples have them are from larger ones."""
    rows = []
    for usual, large in zip(USUAL, LARGE, strict=True):
        pairs = [(known[usual][name], known[large][name]) for name in SHARES[:4]]
        differences = [beside(*pair) if 1e-4 < pair[1][0] < 1.0 else "" for pair in pairs]
        rows.append([usual.index, usual.alpha, usual.incidence, *differences])
    table(["index", "alpha", "incidence", *SHARES[:4]], rows)


def table_of_borders(known):
    """Print how much light two layers of finite fields lose, by width and incidence."""
    rows = {}
    for case in AT_A_BORDER:
        lost = f"{100 * known[case]['lost'][0]:.1f} %"
        rows.setdefault((case.alpha, case.lengths), []).append(lost)
    table(["alpha", "width", *BORDER_INCIDENCES], [[*what, *lost] for what, lost in rows.items()])


def beside(one, other):
    """Return by how much a share differs from another, with the standard error of that."""
    error = np.hypot(one[1], other[1]) / other[0]
    return f"{100 * (one[0] / other[0] - 1):+.2f} ± {100 * error:.2f} %"


def by_cells(axes, known):
    """Draw what is transmitted after several events, over the cells a correlation length."""
    for name, label in (("T_m", "T_m"), ("scalar.T_m", "T_m without polarisation")):
        shares = [known[GLASS._replace(cells=cells)][name] for cells in CELLS]
        means, errors = [s[0] for s in shares], [s[1] for s in shares]
        axes.errorbar(CELLS, means, errors, marker="o", capsize=3, label=label)
    axes.axhline(0.052, color="C2", linestyle="--", label="M. Wang et al. (2017), table 1")
    axes.axhline(0.053, color="C3", linestyle=":", label="E. Heitz et al. (2016)")
    axes.set_xscale("log", base=2)
    axes.set_xticks(CELLS, CELLS)
    axes.set(xlabel="cells a correlation length", ylabel="T_m")
    axes.legend(loc="upper left", fontsize="small")


def by_choice(axes, known, cases, what, title):
    """Draw the same over what the surface is made of, and how much one surface is apart."""
    places = [getattr(case, what) for case in cases]
    shares = np.array([known[case]["T_m"] for case in cases])
    axes.errorbar(places, shares[:, 0], shares[:, 2], fmt="none", capsize=6, color="C0", alpha=0.4)
    axes.errorbar(places, shares[:, 0], shares[:, 1], marker="o", capsize=3, color="C0")
    axes.set_xscale("log")
    axes.set_xticks(places, places)
    axes.minorticks_off()
    axes.set(xlabel=title)


def draw(known, folder):
    """Draw the pictures of docs/surfaces.md."""
    figure, axes = plt.subplots(1, 3, sharey=True, figsize=(11.0, 4.0), layout="constrained")
    figure.suptitle(
        "Transmitted after several events: index 1.5, alpha 1, incidence 1 rad (faint: one surface)"
    )
    axes[0].set_ylim(0.048, 0.066)
    by_cells(axes[0], known)
    by_choice(axes[1], known, BY_WIDTH["T_m"], "lengths", "width of the field, correlation lengths")
    by_choice(axes[2], known, BY_WAVES, "waves", "random waves")
    save(figure, folder / "surface-convergence.png")
    figure, axes = plt.subplots(figsize=(7.0, 4.2), layout="constrained")
    for alpha in ALPHAS:
        shares = [known[case]["R_m"] for case in BY_DIRECTION if case.alpha == alpha]
        means, errors = [s[0] for s in shares], [s[1] for s in shares]
        axes.errorbar(INCIDENCES, means, errors, marker="o", capsize=3, label=f"alpha {alpha}")
    axes.set(xlabel="incidence (rad)", ylabel="R_m", xlim=(-0.02, 1.6), ylim=(0.0, None))
    axes.set_title("A perfect reflector: the share of light that is reflected several times")
    axes.legend()
    save(figure, folder / "surface-mirror.png")


def save(figure, file):
    """Write a picture."""
    for each in figure.axes:
        each.grid(visible=True, alpha=0.3)
    drawn = io.BytesIO()
    figure.savefig(drawn, dpi=110, format="png")
    write_file(file, drawn.getvalue())


TABLES = table_of_borders, table_of_cells, table_of_widths, table_of_waves, table_beside_large

if __name__ == "__main__":
    found = keep(Path(sys.argv[1]))
    for each in TABLES:
        each(found)
    draw(found, Path(sys.argv[2]))

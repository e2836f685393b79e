"""What the marks and lines of a chart mean, and in which regions methods fail, as words below."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from optipath.plots.charts.chart_frame import LINE, WIDTH
from optipath.plots.charts.chart_marks import POINTS
from optipath.plots.charts.chart_panel import FAILING
from optipath.plots.line_colours import FAINT, INK
from optipath.plots.text_width import broken, shortened, width_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.artist import Artist
    from matplotlib.figure import Figure

    from optipath.plots.charts.chart_marks import Looks, Mark

EDGE = 0.25
"""Between words and the edge of a picture, in inches."""

_HANDLE = 0.6
_ULP = "units in the last place, divided by 1 + the condition number"
_WAYS = {"stokes": "large: Stokes", "jones": "small: Jones"}
_FACES = {"numba": "filled: ", "numpy": "open: "}


def legend_rows(chart: Mapping[str, Any], looks: Looks, *, fails: bool) -> list[list[Artist]]:
    """Return what is explained, in rows that fit the width of a picture."""
    groups = _groups(looks)
    if fails:
        label = f"fails (over {chart['fails_above']:g} ulp*) in so many regions"
        groups[-1].insert(0, Patch(facecolor=FAILING, label=label))
        star = Line2D([], [], linewidth=0, marker="$*$", markersize=9, color=INK, label=_ULP)
        groups.append([star])
    return flowing(groups)


def flowing(groups: list[list[Artist]]) -> list[list[Artist]]:
    """Return groups of what is explained in rows that fit the width of a picture."""
    rows: list[list[Artist]] = []
    for group in groups:
        reached = WIDTH
        for handle in group:
            needed = _HANDLE + 1.03 * width_of(str(handle.get_label()), POINTS)
            if reached + needed > WIDTH - 2 * EDGE:
                rows.append([])
                reached = 0.0
            rows[-1].append(handle)
            reached += needed
    return rows


def _groups(looks: Looks) -> list[list[Artist]]:
    marker: dict[str, Any] = {"color": INK, "linewidth": 0, "markersize": 11}
    methods: list[Artist] = [
        Line2D([], [], color=looks.colour(name), lw=7, label=_short(name)) for name in looks.methods
    ]
    shapes = [
        Line2D([], [], marker=looks.shape(name), label=_short(name), **marker)
        for name in looks.dtypes
    ]
    faces = [
        Line2D([], [], marker="o", label=_FACES.get(name, "half: ") + _short(name))
        for name in looks.engines
    ]
    for line, name in zip(faces, looks.engines, strict=True):
        line.set(**marker, mew=1.8)
        line.set(**looks.face(name))
    sizes = [
        Line2D([], [], marker="o", label=_WAYS.get(name, f"large: {_short(name)}"))
        for name in looks.ways
    ]
    for line, name in zip(sizes, looks.ways, strict=True):
        line.set(**(marker | {"markersize": looks.size(name)}))
    ways = sizes if len(sizes) > 1 else []
    return [
        [*methods, *shapes],
        [
            *faces,
            *ways,
            Line2D([], [], marker="o", label="worst region", **marker),
            Line2D([], [], marker="_", label="middle region", **(marker | {"mew": 2})),
        ],
        [
            Line2D([], [], color=FAINT, lw=1.8, label="frontier: best that fails nowhere"),
            Line2D([], [], color=FAINT, ls="--", label="eps"),
            Line2D([], [], color=FAINT, lw=1.6, ls=":", label="machine's limit"),
        ],
    ]


def _short(name: str) -> str:
    return shortened(name, 3.0, POINTS)


def draw_legend(figure: Figure, rows: list[list[Artist]], top: float) -> None:
    """Draw rows of what is explained."""
    height = figure.get_figheight()
    for number, row in enumerate(rows):
        figure.legend(
            handles=row,
            ncols=len(row),
            loc="upper left",
            bbox_to_anchor=(EDGE / WIDTH, (top - LINE * 1.15 * number) / height),
            borderaxespad=0.0,
            borderpad=0.0,
            frameon=False,
            fontsize=POINTS,
            labelcolor=INK,
            handlelength=1.3,
            handletextpad=0.5,
            columnspacing=1.1,
        )


def failing_lines(marks: list[Mark], regions: list[str], inches: float) -> list[tuple[str, str]]:
    """Return in which regions methods fail."""
    found = []
    for method in dict.fromkeys(mark.method for mark in marks if mark.fails):
        own = [mark for mark in marks if mark.method == method]
        where = {name: [mark for mark in own if name in mark.fails] for name in regions}
        failing = [name for name, marked in where.items() if marked]
        begin = f"{shortened(method, 1.6, POINTS)}:"
        if all(len(marked) == len(own) for marked in where.values()):
            words = [begin, "everywhere"]
        elif len(regions) > len(failing) > len(regions) / 2:
            holds = [name for name, marked in where.items() if not marked]
            words = [begin, "all but:", *_listed(holds)]
        else:
            words = [begin, *_listed([_told(name, where[name], own) for name in failing])]
        found += [
            (method if number == 0 else "", line)
            for number, line in enumerate(broken(words, inches, POINTS))
        ]
    return found


def _told(region: str, failing: list[Mark], own: list[Mark]) -> str:
    """Return a region, with the precisions that fail there if others hold."""
    dtypes = {mark.dtype for mark in failing}
    if len(failing) == len(own):
        return region
    if len(failing) == sum(mark.dtype in dtypes for mark in own):
        return f"{region} ({', '.join(sorted(dtypes))})"
    return f"{region} (in part)"


def _listed(names: list[str]) -> list[str]:
    return [*(f"{name};" for name in names[:-1]), names[-1]]

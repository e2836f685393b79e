"""``optipath plot``: a picture of a preset and its light, in a file."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple

import click
import numpy as np

from optipath import plots
from optipath.cli.arguments import NEW_FILE, array_faults, check_place
from optipath.cli.console import say
from optipath.cli.options import flag, parameter_name
from optipath.cli.preset_command import READS, PresetGroup
from optipath.errors import OptipathError, ParameterError
from optipath.faults import did_you_mean, listed, shown, unknown
from optipath.materials.named_materials import WAVELENGTH, materials_among
from optipath.paths.files.presets import preset_of_case
from optipath.values.files import check_form
from optipath.values.units import displayed

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from pathlib import Path

    from matplotlib.figure import Figure

    from optipath.cli.preset_command import Chosen
    from optipath.paths.path_graph import PathGraph
    from optipath.values.text import AxisValues


@dataclass(frozen=True)
class PlotRequest:
    """What is to be drawn."""

    kind: str
    title: str
    path: PathGraph
    axes: dict[str, AxisValues | None]
    quantities: list[str]
    detector: str | None
    ends: tuple[str, ...]
    published: Mapping[str, tuple[float, ...]]


def request_of(
    chosen: Chosen,
    kind: str,
    *,
    x: Sequence[str],
    y: str | None,
    detector: str | None,
    reads: str | None,
) -> PlotRequest:
    """Return what a command line asks for."""
    axes = {name: chosen.axes.get(name) for name in [*map(parameter_name, x), *chosen.axes]}
    quantities = [name.strip() for name in ("S0" if y is None else y).split(",")]
    opened = preset_of_case(chosen.opened, chosen.preset, chosen.case)
    # All that nobody has given stays open.
    path = replace(chosen, opened=opened, case=None).path(reads)
    plan = path.compose()
    detectors, dumps = plan.program.detectors, plan.program.dumps
    faults = [] if detector is None else unknown("detector", detector, [*detectors, *dumps])
    faults += array_faults(plan.inputs)
    faults += _axis_faults(kind, axes, [*plan.inputs.open])
    if len({*x}) < len(x):
        faults.append(f"--x is given again with the name {x[-1]}; give each name once")
    if len(axes) > 1 and len(quantities) > 1:
        faults.append(f"a map is of one quantity, and --y names {len(quantities)}; give one")
    if detector is not None and kind == "poincare" and not axes:
        faults.append(
            "--detector is of a trail along --x, and without it the trail goes along the whole "
            "path; add --x NAME, or leave --detector out"
        )
    ParameterError.raise_for(faults)
    ends = (*detectors,) if detector is None else (detector,)
    is_changed = chosen.values or chosen.axes or reads or chosen.case is None
    published = {} if is_changed else path.cases[chosen.case or ""].published
    title = title_of(chosen, reads=reads, at=detector)
    return PlotRequest(kind, title, path, axes, quantities, detector, ends, published)


_AT_MOST = "no parameter", "one parameter at most", "two parameters at most"


def _axis_faults(kind: str, axes: Mapping[str, Any], known: Sequence[str]) -> list[str]:
    """Return what is wrong with what varies, and with how much does, a sentence each."""
    faults = [
        f"a picture is along parameters that have no single value, and {shown(name)} is none of "
        f"them{did_you_mean(name, known)}"
        for name in axes
        if name not in known
    ]
    counts = KINDS[kind].counts
    if len(axes) > counts[-1]:
        vary = f"{listed([flag(name) for name in axes])} var{'ies' if len(axes) == 1 else 'y'}"
        faults.append(f"--kind {kind} is along {_AT_MOST[counts[-1]]}, and {vary}; give one value")
    elif len(axes) < counts[0]:
        name = next(iter(known), "NAME")
        ways = f"name it, --x {flag(name)[2:]}, or give it several values, {flag(name)} "
        faults.append(f"--kind {kind} is along a parameter; {ways}START:STOP:COUNT")
    return faults


class PlotKind(NamedTuple):
    """A kind of picture."""

    draw: Callable[[PlotRequest], Any]
    takes: tuple[str, ...] = ()
    counts: range = range(1)


def drawn(request: PlotRequest) -> Any:
    """Return the picture that is asked for, with its title."""
    from optipath.plots.text import missing_letters_as_boxes  # noqa: PLC0415 - an extra

    with missing_letters_as_boxes():
        first: Any = np.array(KINDS[request.kind].draw(request), object).flat[0]
    figure = first.figure
    draw_title(figure, request.title)
    return figure


def _panel(count: int, width: float, height: float) -> Any:
    """Return axes beside one another."""
    from optipath.plots.axes import own_panel  # noqa: PLC0415 - an extra

    return own_panel(None, (1, count), (width * count, height))


def _ellipse(request: PlotRequest) -> Any:
    lights, ends = request.path.trace_all(), request.ends
    if len(ends) == 1:
        return plots.ellipse({ends[0]: lights[ends[0]]})
    panel = _panel(len(ends), 5.0, 5.8)
    for name, ax in zip(ends, panel.flat, strict=True):
        plots.ellipse(lights[name], ax, labels=name)
    return panel


def _poincare(request: PlotRequest) -> Any:
    if not request.axes:
        return plots.poincare_path(request.path)
    from optipath.plots.poincare_sphere import parameter_trail  # noqa: PLC0415 - an extra

    ((name, values),) = request.axes.items()
    return parameter_trail(request.path, name, request.detector, _texts(values))


def _stokes(request: PlotRequest) -> Any:
    from optipath.plots.light_texts import MOST  # noqa: PLC0415 - an extra

    if len(request.ends) > MOST:
        raise ParameterError(
            f"the path has {len(request.ends)} detectors, and a picture {MOST} at most; "
            f"add --detector {request.ends[0]}"
        )
    lights, known = request.path.trace_all(), request.published
    published = {name: known[name] for name in request.ends if name in known}
    return plots.stokes({name: lights[name] for name in request.ends}, published=published or None)


def _mueller(request: PlotRequest) -> Any:
    sources = request.path.compose().program.sources
    ways = [(source, end) for end in request.ends for source in sources]
    if len(ways) == 1:
        return plots.mueller(request.path.mueller(*ways[0]))
    panel = _panel(len(ways), 5.6, 5.4)
    for (source, end), ax in zip(ways, panel.flat, strict=True):
        plots.mueller(request.path.mueller(source, end), ax)
        ax.set_title(f"{source} to {end}\n{ax.get_title()}", parse_math=False)
    return panel


def _curve(request: PlotRequest) -> Any:
    path, detector, names = request.path, request.detector, request.quantities
    (x, values), *others = ((name, _texts(values)) for name, values in request.axes.items())
    if not others:
        return plots.curve(path, x, names, values=values, detector=detector)
    ((y, y_values),) = others
    given: Any = {"x_values": values, "y_values": y_values, "detector": detector}
    return plots.quantity_map(path, x, y, names[0], **given)


def _texts(values: AxisValues | None) -> Any:
    """Return the values of an axis as they were given, with their unit."""
    if values is None or not values.unit:
        return None if values is None else values.given
    return [f"{number} {values.unit}" for number in values.shown.tolist()]


def _of_path(request: PlotRequest) -> Any:
    """Draw a picture of the path alone."""
    return getattr(plots, request.kind)(request.path)


KINDS = {
    "ellipse": PlotKind(_ellipse, ("detector",)),
    "poincare": PlotKind(_poincare, ("x", "detector"), range(2)),
    "stokes": PlotKind(_stokes, ("detector",)),
    "geometry": PlotKind(_of_path),
    "bench": PlotKind(_of_path),
    "curve": PlotKind(_curve, ("x", "y", "detector"), range(1, 3)),
    "mueller": PlotKind(_mueller, ("detector",)),
    "energy": PlotKind(_of_path),
}


KIND = click.Option(["--kind"], type=click.Choice([*KINDS]), help="What is drawn; needed.")
X = click.Option(
    ["--x"],
    metavar="NAME",
    multiple=True,
    help="Of curve and poincare: the parameter that varies, over its usual range unless its own "
    "option gives several values. Of two, curve draws a map.",
)
Y = click.Option(
    ["--y"],
    metavar="NAME,NAME",
    help="Of curve: what goes up; S0 (by default) to S3, DoP, DoLP, AoP, ellipticity, psi, delta.",
)
DETECTOR = click.Option(
    ["--detector"],
    metavar="NAME",
    help="Of ellipse, stokes, mueller, curve and poincare with --x: at which detector or dump.",
)
OUT = click.Option(
    ["--out"],
    type=NEW_FILE,
    metavar="FILE",
    help="Draw into this file, which is needed; its ending is .png, .svg or .pdf.",
)


def _plot(chosen: Chosen, *, kind: str, out: Path, **requests: Any) -> None:
    """Draw a preset, or a TOML file, and its light into a file."""
    save = plots.save  # Before anything is computed: it tells whether what draws is there.
    save(drawn(request_of(chosen, kind, **requests)), out)
    say(f"wrote {out}")


def _faults(*, kind: str | None, out: Path | None, **requests: Any) -> list[str]:
    faults = []
    if kind is None:
        faults.append(f"--kind is missing; say what is drawn, one of {', '.join(KINDS)}")
    else:
        for option in sorted({"x", "y", "detector"}.difference(KINDS[kind].takes)):
            if requests[option] not in (None, ()):
                takers = " or ".join([name for name, one in KINDS.items() if option in one.takes])
                faults.append(
                    f"--{option} is of {takers}, and --kind {kind} has none; leave it out"
                )
    if out is None:
        return [*faults, "--out is missing, and a picture is drawn into a file; add --out plot.png"]
    with OptipathError.collecting(faults):
        check_form(out)
        check_place(out)
    return faults


plot = PresetGroup("plot", _plot, (KIND, X, Y, DETECTOR, READS, OUT), ranges=True, faults=_faults)


_POINTS, _LINE, _FILLED = 12.0, 0.26, 0.95
"""The size of letters, how many inches a line takes, and the share of the width it fills."""


def draw_title(figure: Figure, title: str) -> None:
    """Write a title above a picture, which becomes so much higher."""
    from optipath.plots.text import broken  # noqa: PLC0415 - an extra

    # Each name stays beside its value.
    whole = title.replace(" ", "\u00a0").replace(",\u00a0", ", ")
    said = broken(whole, _FILLED * figure.get_figwidth(), _POINTS).replace("\u00a0", " ")
    figure.set_figheight(figure.get_figheight() + _LINE * (1 + said.count("\n")))
    figure.suptitle(said, fontsize=_POINTS, parse_math=False)


def title_of(chosen: Chosen, **others: str | None) -> str:
    """Return the preset and the case, and each value that is given besides, with its name."""
    labels = {name: label for name, label, _ in materials_among(chosen.values)}
    texts: dict[str, Any] = {}
    for name, value in chosen.values.items():
        parameter = chosen.opened.parameters.get(name, WAVELENGTH)
        if isinstance(value, float):
            texts[name] = displayed(value, parameter.unit)
        elif name in labels or isinstance(value, str):
            texts[name] = labels.get(name, value)
        else:
            texts[name] = parameter.text(value)
    named = [f"{name} {text}" for name, text in {**texts, **others}.items() if text]
    return ", ".join([chosen.title, *named])

"""The kinds of pictures that ``optipath plot`` draws, and what each takes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.cli.picture_title import draw_title
from optipath.errors import ParameterError

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.cli.plot_request import PlotRequest
    from optipath.values.axis_texts import AxisValues


class PlotKind(NamedTuple):
    """A kind of picture."""

    draw: Callable[[PlotRequest], Any]
    takes: tuple[str, ...] = ()
    counts: range = range(1)


def drawn(asked: PlotRequest) -> Any:
    """Return the picture that is asked for, with its title."""
    import numpy as np  # noqa: PLC0415 - the command line starts without

    from optipath.plots.missing_letters import missing_letters_as_boxes  # noqa: PLC0415 - an extra

    with missing_letters_as_boxes():
        first: Any = np.array(KINDS[asked.kind].draw(asked), object).flat[0]
    figure = first.figure
    draw_title(figure, asked.title)
    return figure


def _ellipse(asked: PlotRequest) -> Any:
    from optipath.plots import ellipse  # noqa: PLC0415 - an extra
    from optipath.plots.own_axes import own_panel  # noqa: PLC0415 - ditto

    lights, count = asked.path.trace_all(), len(asked.ends)
    if count == 1:
        return ellipse({asked.end: lights[asked.end]})
    panel = own_panel(None, (1, count), (5.0 * count, 5.8))
    for name, ax in zip(asked.ends, panel.flat, strict=True):
        ellipse(lights[name], ax, labels=name)
    return panel


def _poincare(asked: PlotRequest) -> Any:
    if not asked.axes:
        from optipath.plots import poincare_path  # noqa: PLC0415 - an extra

        return poincare_path(asked.path)
    from optipath.plots.states.parameter_trail import parameter_trail  # noqa: PLC0415 - ditto

    ((name, values),) = asked.axes.items()
    return parameter_trail(asked.path, name, asked.end, _texts(values))


def _stokes(asked: PlotRequest) -> Any:
    from optipath.plots import stokes  # noqa: PLC0415 - an extra
    from optipath.plots.states.lights_to_draw import MOST  # noqa: PLC0415 - ditto

    if len(asked.ends) > MOST:
        raise ParameterError(
            f"the path has {len(asked.ends)} detectors, and their bars are told apart up to "
            f"{MOST}; add --detector {asked.ends[0]}"
        )
    lights = asked.path.trace_all()
    published = {name: asked.published[name] for name in asked.ends if name in asked.published}
    return stokes({name: lights[name] for name in asked.ends}, published=published or None)


def _mueller(asked: PlotRequest) -> Any:
    from optipath.plots import mueller  # noqa: PLC0415 - an extra
    from optipath.plots.own_axes import own_panel  # noqa: PLC0415 - ditto

    program = asked.path.compose().program
    ways = [(source, end) for end in asked.ends for source in program.sources]
    if len(ways) == 1:
        return mueller(asked.path.mueller(*ways[0]))
    panel = own_panel(None, (1, len(ways)), (5.6 * len(ways), 5.4))
    for (source, end), ax in zip(ways, panel.flat, strict=True):
        mueller(asked.path.mueller(source, end), ax)
        ax.set_title(f"{source} to {end}\n{ax.get_title()}", parse_math=False)
    return panel


def _curve(asked: PlotRequest) -> Any:
    from optipath.plots import curve, quantity_map  # noqa: PLC0415 - an extra

    (x, values), *other = asked.axes.items()
    if not other:
        return curve(asked.path, x, asked.quantities, values=_texts(values), detector=asked.end)
    ((y, y_values),) = other
    (quantity,) = asked.quantities
    given: Any = {"x_values": _texts(values), "y_values": _texts(y_values)}
    return quantity_map(asked.path, x, y, quantity, detector=asked.end, **given)


def _texts(values: AxisValues | None) -> Any:
    """Return the values of an axis as they were given, with their unit."""
    if values is None or not values.unit:
        return None if values is None else values.given
    return [f"{number} {values.unit}" for number in values.shown.tolist()]


def _geometry(asked: PlotRequest) -> Any:
    from optipath.plots import geometry  # noqa: PLC0415 - an extra

    return geometry(asked.path)


def _bench(asked: PlotRequest) -> Any:
    from optipath.plots import bench  # noqa: PLC0415 - an extra

    return bench(asked.path)


def _energy(asked: PlotRequest) -> Any:
    from optipath.plots import energy  # noqa: PLC0415 - an extra

    return energy(asked.path)


KINDS = {
    "ellipse": PlotKind(_ellipse, ("detector",)),
    "poincare": PlotKind(_poincare, ("x", "detector"), range(2)),
    "stokes": PlotKind(_stokes, ("detector",)),
    "geometry": PlotKind(_geometry),
    "bench": PlotKind(_bench),
    "curve": PlotKind(_curve, ("x", "y", "detector"), range(1, 3)),
    "mueller": PlotKind(_mueller, ("detector",)),
    "energy": PlotKind(_energy),
}

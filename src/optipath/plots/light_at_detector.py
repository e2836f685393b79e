"""Quantities of the light at a detector over one or two parameters, in steps to be drawn."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.errors import OptipathError, ParameterError
from optipath.faults import Cure, Fault, listed, shown, unknown
from optipath.light.quantities import QUANTITIES, LightQuantity
from optipath.paths.path_graph import PathGraph
from optipath.paths.usual_range import usual_range
from optipath.plots.colors import ColourScale
from optipath.sweeps.axes import read_values, unnamed_arrays
from optipath.values.units import in_unit

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    import numpy.typing as npt

    from optipath.plan.inputs import Inputs
    from optipath.values.parameters import Parameter
    from optipath.values.precision import Numbers


_READS = ("intensity", "linear", "stokes")
"""What a detector reads, from the least."""


class DrawnQuantity(NamedTuple):
    """A quantity of light as it is drawn."""

    light: LightQuantity

    @property
    def name(self) -> str:
        """What it is called, such as ``"DoLP"``."""
        return self.light.variable

    @property
    def unit(self) -> str:
        """The unit in which it is drawn; quantities of one share an axis."""
        return {"rad": "°"}.get(self.light.unit, self.light.unit)

    @property
    def label(self) -> str:
        """Its name, what it is, and its unit."""
        what = self.light.name.partition(",")[0]
        return f"{self.name}: {what}{' (°)' if self.unit == '°' else ''}"

    @property
    def short(self) -> str:
        """Its name and its unit."""
        return f"{self.name} (°)" if self.unit == "°" else self.name

    @property
    def period(self) -> float | None:
        """After how many degrees an angle is the same again."""
        return None if self.light.period is None else np.degrees(self.light.period)

    def is_read(self, reads: str) -> bool:
        """Return whether a detector reads enough, ``"stokes"``, ``"linear"`` or ``"intensity"``."""
        return _READS.index(self.light.reads) <= _READS.index(reads)

    def of(self, numbers: npt.ArrayLike) -> Numbers:
        """Return numbers of the light, in radians where they are angles, as they are drawn."""
        plain = np.asarray(numbers, np.float64)
        return np.degrees(plain) if self.unit == "°" else plain

    def colours(self, numbers: Numbers) -> ColourScale:
        """Return the colours of some numbers: in order, apart from 0, or round in a circle."""
        if self.period:
            return ColourScale.cyclic(self.period / 2.0)
        finite = numbers[np.isfinite(numbers)]
        low, high = self.light.limits or (-1.0 if self.name in {"S1", "S2", "S3"} else 0.0, None)
        largest = high or float(np.max(np.abs(finite), initial=0.0)) or 1.0
        return ColourScale.signed(largest) if low < 0.0 else ColourScale.share(largest)


def drawn_quantities(names: Any) -> list[DrawnQuantity]:
    """Return the quantities of some names, which may be written in small letters."""
    argument = [names] if isinstance(names, str) else names
    if not isinstance(argument, (list, tuple)) or not argument:
        raise OptipathError(f"quantities are {shown(names)}; give names such as 'S0', 'DoLP'")
    known = {each.variable: each for each in QUANTITIES}
    small = {name.lower(): name for name in known}
    read = [small.get(name.lower(), name) if isinstance(name, str) else name for name in argument]
    faults = [sentence for name in read for sentence in unknown("quantity", name, known)]
    if not faults and len({*read}) < len(read):
        faults = [f"quantities are {shown([*argument])}; give each of them once"]
    OptipathError.raise_for(faults)
    return [DrawnQuantity(known[name]) for name in read]


def drawn_quantity(name: Any) -> DrawnQuantity:
    """Return the quantity of one name."""
    if not isinstance(name, str):
        raise OptipathError(f"quantity is {shown(name)}; give one name, such as 'S0'")
    return drawn_quantities(name)[0]


def varied(
    path: PathGraph, names: Sequence[Any], fixed: Mapping[str, Any]
) -> tuple[Parameter, ...]:
    """Return the open parameters that go along axes, once all that is given for a path fits."""
    if not isinstance(path, PathGraph):
        raise OptipathError(f"a curve is of a path, not of {shown(path)}; give a PathGraph")
    inputs = path.compose().inputs
    faults = [
        inputs.unknown(name) if isinstance(name, str) else f"parameter {shown(name)} is unknown"
        for name in (*names, *fixed)
        if not isinstance(name, str) or name not in inputs.open
    ]
    faults += [
        f"parameter '{name}' goes along an axis; leave out {name}=..."
        for name in fixed
        if name in names
    ]
    if len({*map(str, names)}) < len(names):
        faults.append(f"both axes are '{names[0]}'; give two parameters")
    if not faults:
        faults += unnamed_arrays(inputs, {*names, *fixed})
        faults += [
            f"parameter '{name}' is {shown(value)}; a picture is of one value"
            for name, value in fixed.items()
            if not isinstance(value, str) and np.ndim(value) > len(inputs.tails.get(name, ()))
        ]
    ParameterError.raise_for(faults)
    return tuple(inputs.open[name] for name in names)


def axis_of(
    path: PathGraph, parameter: Parameter, values: Any, count: int
) -> tuple[AlongAxis, npt.NDArray[Any]]:
    """Return the values (count,) along an axis: as drawn, and in radians for a path."""
    name, inputs = parameter.name, path.compose().inputs
    unit, size = parameter.unit, in_unit(1.0, parameter.unit)
    if values is None:
        argument = np.linspace(*usual_range(path, name), count)
        numbers = argument * size
    else:
        read = read_values(inputs, name, values)
        _check_numbers(name, read.shown, read.given, read.unit)
        argument, numbers = read.given, np.asarray(read.shown, np.float64)
        if read.unit != unit and read.unit in {"rad", "m", "1/m", "rad/m"}:
            numbers = argument * size
        else:
            unit = read.unit
    default = _default(inputs, parameter, argument, numbers)
    return AlongAxis(name, unit, numbers, parameter.help, default), argument


def _check_numbers(
    name: str, numbers: npt.NDArray[Any], argument: npt.NDArray[Any], unit: str
) -> None:
    """Refuse what no axis can have: words, complex numbers, and one value alone."""
    if numbers.dtype.kind not in "biuf" or argument.dtype.kind == "O":
        entries = numbers.ravel().tolist()
        wrong = (e for e in entries if (e.imag if isinstance(e, complex) else str(e)[:1].isalpha()))
        odd = next(wrong, entries[0])
        raise ParameterError(
            f"parameter '{name}' has {shown(odd)} among its values, and an axis is of real "
            f"numbers; give it by itself, {name}=..., in a picture of another parameter"
        )
    if (different := np.unique(numbers)).size < 2:
        one = f"{different[0]:.15g} {unit}".rstrip() if different.size else "none"
        raise ParameterError(
            f"values of '{name}' are {one} alone; give two or more, such as '0 deg:90 deg:91'"
        )


def _default(inputs: Inputs, parameter: Parameter, argument: Any, numbers: Numbers) -> float | None:
    """Return where the value by default lies among those that are drawn."""
    if parameter.default is None or isinstance(parameter.default, str):
        return None
    value = inputs.open[parameter.name].resolve(parameter.default).value
    if np.ndim(value) or np.iscomplexobj(value):
        return None
    if not np.min(argument) <= value <= np.max(argument):
        return None
    order = np.argsort(argument)
    return float(np.interp(float(value), argument[order], numbers[order]))


def quantities_at(
    path: PathGraph,
    end: str,
    quantities: Sequence[DrawnQuantity],
    arguments: Mapping[str, npt.NDArray[Any]],
    fixed: Mapping[str, Any],
    *,
    chosen: bool,
) -> Numbers:
    """Return quantities of the light at a detector, as they are drawn, shape (k, count, ...).

    Of arguments that nobody gave, those that the path refuses have NaN.
    """
    shape = tuple(map(len, arguments.values()))
    spread = dict(zip(arguments, np.ix_(*arguments.values()), strict=True))
    try:
        light = path.trace_all(**spread, **fixed)[end]
        return np.stack([np.broadcast_to(q.of(q.light.of(light)), shape) for q in quantities])
    except ParameterError:
        if not chosen:
            raise
        count, axis = max((count, axis) for axis, count in enumerate(shape))
        if count == 1:
            return np.full((len(quantities), *shape), np.nan)
        name = [*arguments][axis]
        halves = [{**arguments, name: half} for half in np.array_split(arguments[name], 2)]
        parts = [quantities_at(path, end, quantities, e, fixed, chosen=True) for e in halves]
        return np.concatenate(parts, axis + 1)


def reads_of(path: PathGraph, end: str) -> str:
    """Return what an end of a path reads."""
    return str(path.graph.nodes[end]["element"].reads)


def end_of(path: PathGraph, detector: Any) -> str:
    """Return the detector that is meant."""
    ends = [name for name, e in path.graph.nodes(data="element") if not e.outputs]
    if detector is not None:
        ParameterError.raise_for(unknown("detector", detector, ends))
        return str(detector)
    detectors = [*path.compose().program.detectors]
    if len(detectors) > 1:
        first = detectors[0]
        cure = Cure(f"say which, by detector='{first}'", command=f"add --detector {first}")
        raise ParameterError(Fault(f"the path has the detectors {listed(detectors)}", cure))
    return detectors[0]


_SIGNS = {"deg": "°", "um": "µm"}
_LONGEST = 60


class AlongAxis(NamedTuple):
    """What goes along an axis. Shape: numbers (count,)."""

    name: str
    unit: str
    numbers: Numbers
    help: str = ""
    default: float | None = None

    @property
    def short(self) -> str:
        """What it is called, with its unit."""
        return self.name + self._in_unit

    @property
    def label(self) -> str:
        """What it is called, and what it is, where that is short.

        >>> import numpy as np
        >>> AlongAxis("theta", "deg", np.zeros(2), "angle of incidence, inside; of s").label
        'theta: angle of incidence, inside (°)'
        """
        whats = (self.help.partition(mark)[0] for mark in ";,")
        what = next((each for each in whats if 0 < len(each) <= _LONGEST), "")
        if not what:
            return self.short
        return (what if what.startswith(self.name) else f"{self.name}: {what}") + self._in_unit

    @property
    def _in_unit(self) -> str:
        return "" if self.unit in {"", "1"} else f" ({_SIGNS.get(self.unit, self.unit)})"

    @property
    def default_text(self) -> str:
        """The value by default with its unit, to four digits."""
        sign = _SIGNS.get(self.unit, self.unit)
        return f"{self.default:.4g}{'' if sign == '°' else ' '}{sign}".rstrip()


START = 721
"""How many values there are before steps are halved."""

_HALVINGS = 5
_NEAR = 0.01
"""How far the middle of a step may be off the line, of the size of the picture."""

_SMOOTH = 4.0
"""How much nearer to the line the middle of a smooth curve is after its step is halved."""

_FAST = 0.01
"""Where so many steps are rough there may be narrow lines within the others: all are halved."""

_IN_A_ROW = 4
"""A jump leaves a step that no halving mends, or two; fast changes leave many."""


class FineSteps(NamedTuple):
    """Values along an axis. Shapes: values (count,); numbers (count, k)."""

    values: Numbers
    numbers: Numbers
    resolved: bool

    def told(self, name: str) -> str:
        """Return what is to be said where lines are not near."""
        if self.resolved:
            return ""
        message = f"it changes faster with {name} than {len(self.values)} points tell"
        return f"{message}; give values in a smaller range"


def fine_steps(
    values: npt.ArrayLike,
    numbers: Numbers,
    numbers_at: Callable[[Numbers], Numbers],
    on_picture: Callable[[Numbers], Numbers],
) -> FineSteps:
    """Halve steps of values (n,) while numbers (n, k) at the middle are off the straight line.

    >>> bent = lambda x: np.maximum(x - 1.0, 0.0)[:, np.newaxis]
    >>> x = np.array([0.0, 1.0, 2.0])
    >>> fine_steps(x, bent(x), bent, on_picture=lambda y: y).values
    array([0. , 0.5, 1. , 1.5, 2. ])
    """
    values = np.asarray(values, np.float64)
    points = on_picture(numbers)
    halved = _any_there(points)
    rough = np.zeros_like(halved)
    for _ in range(_HALVINGS):
        (at,) = halved.nonzero()
        if not at.size:
            break
        middles = values[at] + (values[at + 1] - values[at]) / 2.0
        result = numbers_at(middles)
        off = _off_line(points[at], on_picture(result), points[at + 1])
        rough = np.zeros_like(halved)
        rough[at] = off > _SMOOTH * _NEAR
        values = np.insert(values, at + 1, middles)
        numbers = np.insert(numbers, at + 1, result, axis=0)
        points = on_picture(numbers)
        halved = np.zeros(len(values) - 1, np.bool_)
        first = (at + np.arange(at.size))[off > _NEAR]
        # A middle may be on the line by chance: neighbours are halved, too.
        for step in (first - 1, first, first + 1, first + 2):
            halved[step.clip(0, len(halved) - 1)] = True
        halved |= rough.mean() > _FAST
        halved &= _any_there(points)
    in_a_row = np.convolve(rough, np.ones(_IN_A_ROW))
    return FineSteps(values, numbers, resolved=bool(in_a_row.max(initial=0.0) < _IN_A_ROW))


def _any_there(points: Numbers) -> npt.NDArray[np.bool_]:
    """Return at which steps there is something to draw, at one end at least."""
    there = np.isfinite(points)
    return np.asarray((there[:-1] | there[1:]).any(axis=1))


def _off_line(left: Numbers, middle: Numbers, right: Numbers) -> Numbers:
    """Return how far middles are off the line, and 1 where it begins or ends beside them."""
    there = [np.isfinite(each) for each in (left, middle, right)]
    ends = (there[0] != there[1]) | (there[1] != there[2])
    with np.errstate(invalid="ignore"):
        off = np.abs(middle - left / 2.0 - right / 2.0)
    every: Numbers = np.where(ends, 1.0, np.nan_to_num(off, nan=0.0))
    return np.asarray(every.max(axis=1, initial=0.0))

"""The reference for what light meets step by step, its values being exact decimals.

A step is a word with values by name, as texts: `("reflection", {"n": "1.5", "incidence": "30"})`.
Angles are in degrees. No kernel and no element of the library is used.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

from optipath.lab.accuracy.boundary_reference import boundary, stack
from optipath.lab.accuracy.coherency_matrices import coherency, passed, stokes_of
from optipath.lab.accuracy.jones_matrices import times, turn
from optipath.lab.accuracy.many_digits import DIGITS, WORKING_DIGITS, cos_sin, mpmath

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from optipath.lab.accuracy.boundary_reference import Jones

    Values: TypeAlias = Mapping[str, Any]
    Step: TypeAlias = tuple[str, Values]


def mueller_of(steps: Iterable[Step]) -> list[list[Any]]:
    """Return the Mueller matrix of steps in the order in which light meets them.

    Examples
    --------
    >>> rows = mueller_of([("reflection", {"n": "1.5", "incidence": "0"})])
    >>> [float(entry) for entry in rows[0]]
    [0.04, 0.0, 0.0, 0.0]
    """
    with mpmath.workdps(WORKING_DIGITS):
        total = mpmath.eye(4)
        for does, values in steps:
            total = mpmath.matrix(STEPS[does](values)) * total
        least = mpmath.mpf(10) ** -DIGITS * (total[0, 0] or 1)
        rows = total.tolist()
        return [[x if abs(x) > least else mpmath.mpf(0) for x in row] for row in rows]


def _reflection(values: Values) -> list[list[Any]]:
    return _of_jones(boundary(_index(values), *_incidence(values)).reflected)


def _transmission(values: Values) -> list[list[Any]]:
    return _of_jones(boundary(_index(values), *_incidence(values)).transmitted)


def _layers(values: Values, *, reflected: bool) -> list[list[Any]]:
    indices = [mpmath.mpc(*map(mpmath.mpf, pair)) for pair in values["indices"]]
    return stack(indices, *_incidence(values), back=False, way=reflected)


def _reflecting_layers(values: Values) -> list[list[Any]]:
    return _layers(values, reflected=True)


def _transmitting_layers(values: Values) -> list[list[Any]]:
    return _layers(values, reflected=False)


def _polarizer(values: Values) -> list[list[Any]]:
    through = values.get("transmittance", "1"), values.get("leakage", "0")
    x, y = (mpmath.sqrt(mpmath.mpf(part)) for part in through)
    return _at_angle(((x, 0), (0, y)), values)


def _retarder(values: Values) -> list[list[Any]]:
    # The field is exp(-iwt): the slow component gains a positive phase.
    slow = mpmath.mpc(*cos_sin(_degrees(values["retardance"])))
    return _at_angle(((1, 0), (0, slow)), values)


def _rotator(values: Values) -> list[list[Any]]:
    return _of_jones(turn(-_degrees(values["angle"])))


def _faraday_rotator(values: Values) -> list[list[Any]]:
    factors = (mpmath.mpf(values[name]) for name in ("verdet", "field", "length"))
    return _of_jones(turn(-mpmath.fprod(factors)))


def _waveplate(values: Values) -> list[list[Any]]:
    names = "thickness", "birefringence", "wavelength"
    thickness, birefringence, wavelength = (mpmath.mpf(values[name]) for name in names)
    retardance = 360 * thickness * birefringence / wavelength
    return _retarder({**values, "retardance": retardance})


def _circular_polarizer(values: Values) -> list[list[Any]]:
    through = values.get("transmittance", "1"), values.get("leakage", "0")
    t, leakage = (mpmath.mpf(part) for part in through)
    sign = mpmath.mpf(values["handedness"])
    mean, half, across = (t + leakage) / 2, sign * (t - leakage) / 2, mpmath.sqrt(t * leakage)
    return [[mean, 0, 0, half], [0, across, 0, 0], [0, 0, across, 0], [half, 0, 0, mean]]


def _polarizing_reflection(values: Values) -> list[list[Any]]:
    u, v = _leaks(values)
    s, p = (1 - u) / (1 - u * v), v * (1 - u) / (1 - u * v)
    return _of_jones(((mpmath.sqrt(s), 0), (0, -mpmath.sqrt(p))))


def _polarizing_transmission(values: Values) -> list[list[Any]]:
    u, v = _leaks(values)
    s, p = u * (1 - v) / (1 - u * v), (1 - v) / (1 - u * v)
    return _of_jones(((mpmath.sqrt(s), 0), (0, mpmath.sqrt(p))))


def _leaks(values: Values) -> tuple[Any, Any]:
    names = "extinction_transmitted", "extinction_reflected"
    u, v = (1 / mpmath.mpf(values[name]) for name in names)
    return u, v


def _turned_frame(values: Values) -> list[list[Any]]:
    return _of_jones(turn(_degrees(values["angle"])))


STEPS = {
    "reflection": _reflection,
    "transmission": _transmission,
    "reflection by layers": _reflecting_layers,
    "transmission by layers": _transmitting_layers,
    "polarizer": _polarizer,
    "retarder": _retarder,
    "rotator": _rotator,
    "turned frame": _turned_frame,
    "faraday rotator": _faraday_rotator,
    "waveplate": _waveplate,
    "circular polarizer": _circular_polarizer,
    "reflection by a polarizing beam splitter": _polarizing_reflection,
    "transmission by a polarizing beam splitter": _polarizing_transmission,
}
"""What there is by its word: a function of the values, which returns the rows of a matrix."""


def _degrees(text: str) -> Any:
    return mpmath.radians(mpmath.mpf(text))


def _incidence(values: Values) -> tuple[Any, Any]:
    if "tan_incidence" in values:
        tangent = mpmath.mpf(values["tan_incidence"])
        cosine = 1 / mpmath.sqrt(1 + tangent * tangent)
        return cosine, tangent * cosine
    return cos_sin(_degrees(values["incidence"]))


def _index(values: Values) -> Any:
    behind = mpmath.mpc(mpmath.mpf(values["n"]), mpmath.mpf(values.get("k", "0")))
    return behind / mpmath.mpf(values.get("outside", "1"))


def _at_angle(matrix: Jones, values: Values) -> list[list[Any]]:
    angle = _degrees(values["angle"])
    return _of_jones(times(turn(-angle), times(matrix, turn(angle))))


def _of_jones(matrix: Jones) -> list[list[Any]]:
    units: Sequence[Any] = mpmath.eye(4).tolist()
    columns = [stokes_of(passed(matrix, coherency(unit))) for unit in units]
    return [list(row) for row in zip(*columns, strict=True)]

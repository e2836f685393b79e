"""Reference for single elements of exact decimals, and its table of Mueller matrices.

A step is a word with values by name, as texts: `("reflection", {"n": "1.5", "incidence": "30"})`.
Angles are in degrees. No kernel and no element of the library is used.

``python tests/step_reference.py > docs/reference-mueller-matrices.json`` writes it.
"""

from __future__ import annotations

import json
import re
import sys
from typing import TYPE_CHECKING, Any, TypeAlias

from optipath.lab.boundary_reference import boundary, stack
from optipath.lab.element_reference import (
    delaying,
    diagonal,
    passing_circular,
    splitting,
    turn,
    turned,
)
from optipath.lab.many_digits import DIGITS, WORKING_DIGITS, cos_sin, mpmath
from optipath.lab.path_reference import coherency, passed, stokes_of
from optipath.light.conventions import CONVENTIONS

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from optipath.lab.boundary_reference import Jones

    Values: TypeAlias = Mapping[str, Any]
    Step: TypeAlias = tuple[str, Values]


def mueller_of(steps: Iterable[Step]) -> list[list[Any]]:
    """Return the Mueller matrix of steps in the order in which light meets them.

    >>> rows = mueller_of([("reflection", {"n": "1.5", "incidence": "0"})])
    >>> [float(entry) for entry in rows[0]]
    [0.04, 0.0, 0.0, 0.0]
    """
    with mpmath.workdps(WORKING_DIGITS):
        total = mpmath.eye(4)
        for does, values in steps:
            total = mpmath.matrix(_matrix(does, values)) * total
        least = mpmath.mpf(10) ** -DIGITS * (total[0, 0] or 1)
        return [[x if abs(x) > least else mpmath.mpf(0) for x in row] for row in total.tolist()]


def _matrix(step: str, values: Values) -> list[list[Any]]:
    """Return the rows of the Mueller matrix of a step."""
    if step.endswith(" by layers"):
        indices = [mpmath.mpc(*map(mpmath.mpf, pair)) for pair in values["indices"]]
        y = indices[0].real * _incidence(values)[1]
        return stack(indices, y, way=step.startswith("reflection"))
    matrix = _jones(step, {name: mpmath.mpf(text) for name, text in values.items()})
    columns = [stokes_of(passed(matrix, coherency(unit))) for unit in mpmath.eye(4).tolist()]
    return [list(row) for row in zip(*columns, strict=True)]


def _jones(step: str, values: Values) -> Jones:
    """Return the Jones matrix of a step."""
    angle = mpmath.radians(values.get("angle", 0))
    shares = values.get("transmittance", mpmath.mpf(1)), values.get("leakage", mpmath.mpf(0))
    match step:
        case "reflection":
            return boundary(_index(values), *_incidence(values)).reflected
        case "transmission":
            return boundary(_index(values), *_incidence(values)).transmitted
        case "polarizer":
            return turned(diagonal(*map(mpmath.sqrt, shares)), angle)
        case "retarder":
            return turned(delaying(mpmath.radians(values["retardance"])), angle)
        case "waveplate":
            path = values["thickness"] * values["birefringence"]
            return turned(delaying(2 * mpmath.pi * path / values["wavelength"]), angle)
        case "rotator":
            return turn(-angle)
        case "faraday rotator":
            return turn(-values["verdet"] * values["field"] * values["length"])
        case "circular polarizer":
            return passing_circular(*shares, values["handedness"])
        case "turned frame":
            return turn(angle)
    ratios = values["extinction_transmitted"], values["extinction_reflected"]
    return splitting(*ratios, reflects=step.startswith("reflection"))


def _incidence(values: Values) -> tuple[Any, Any]:
    if "tan_incidence" in values:
        tangent = mpmath.mpf(values["tan_incidence"])
        cosine = 1 / mpmath.sqrt(1 + tangent * tangent)
        return cosine, tangent * cosine
    return cos_sin(mpmath.radians(mpmath.mpf(values["incidence"])))


def _index(values: Values) -> Any:
    return mpmath.mpc(values["n"], values.get("k", 0)) / values.get("outside", 1)


TABLE_DIGITS = 20

CONVENTION = {
    "field": "exp(-i w t); an index n + i k with k > 0 absorbs",
    "frame": "right-handed x, y, z; z is the direction of travel, and y = z cross x",
    "stokes": "S1 = |Ex|^2 - |Ey|^2, S2 = 2 Re(conj(Ex) Ey), S3 = 2 Im(conj(Ex) Ey): S3 > 0 is "
    "counter-clockwise to who looks at the source",
    "angles": "in degrees, exact decimals; azimuths from x towards y; tan_incidence is the tangent "
    "of the angle of incidence",
    "reflection, transmission": "x along s, perpendicular to the plane of incidence and the same "
    "before and behind; r_s = (c-g)/(c+g), r_p = (m^2 c-g)/(m^2 c+g), C + i S = r_s conj(r_p); "
    "what is let through is power carried, not radiance; outside is the index in front, 1 if not "
    "given",
    "layers": "indices [n, k] from the medium in front to the substrate; intensities add up, "
    "without interference",
    "polarizer": "angle is its axis; transmittance along it, 1 by default, leakage across it, 0 by "
    "default",
    "retarder": "angle is its fast axis; the slow component gains exp(+i retardance)",
    "rotator": "turns light from x towards y by angle",
    "faraday rotator": "turns light from x towards y by verdet * field * length radians; verdet "
    "in rad/(T m), field in T along the light, length in m",
    "waveplate": "a retarder of 360 * thickness * birefringence / wavelength degrees, both lengths "
    "in um",
    "circular polarizer": "handedness 1 lets S3 > 0 through, -1 S3 < 0; transmittance of it, 1 by "
    "default, leakage of the other, 0 by default",
    "polarizing beam splitter": "without loss, x = s; extinction_transmitted is Tp / Ts, "
    "extinction_reflected Rs / Rp; r_p and r_s of unlike sign, t_p and t_s of like sign",
    "turned frame": "the same light in a frame turned from x towards y by angle",
    "steps": "in the order in which light meets them; frame_in is that of the first step, and "
    "frame_out that of the last",
}

_GLASS, _OUT = {"n": "1.5"}, {"n": "1", "outside": "1.5"}
_RHOMB = {"n": "1", "outside": "1.5105"}
_SILVER, _STEEL = {"n": "0.2", "k": "3.4"}, {"n": "1.12", "k": "2.16"}
_BREWSTER = {"tan_incidence": "1.5"}
_MEDIA = {
    "glass": (_GLASS, ("0", "30", _BREWSTER, "75", "89.99", "90")),
    "from glass": (_OUT, ("0", "20", "41", "42", "60", "89.99")),
    "from water into glass": ({"n": "1.5", "outside": "1.33"}, ("50",)),
    "metal, n 0.2": (_SILVER, ("0", "50", "75", "89.99", "90")),
    "metal, n 1.12": (_STEEL, ("48", "85")),
    "weak absorber": ({"n": "1.5", "k": "0.001"}, (_BREWSTER,)),
    "absorber less dense than air": ({"n": "0.9", "k": "0.05"}, ("70",)),
}
_TRANSPARENT = {
    "glass": ("0", "30", _BREWSTER, "75", "89.99"),
    "from glass": ("0", "20", "41", "60"),
}
_CUBE = {"extinction_transmitted": "1000", "extinction_reflected": "20"}
_FILTERS: tuple[Step, ...] = (
    *(("polarizer", {"angle": angle}) for angle in ("0", "30", "45", "90", "-70")),
    ("polarizer", {"angle": "20", "transmittance": "0.9", "leakage": "0.2"}),
    *(("retarder", {"retardance": "90", "angle": angle}) for angle in ("0", "20", "45")),
    ("retarder", {"retardance": "180", "angle": "22.5"}),
    ("retarder", {"retardance": "35", "angle": "-50"}),
    *(("rotator", {"angle": angle}) for angle in ("30", "-12.5")),
    ("turned frame", {"angle": "30"}),
    ("faraday rotator", {"verdet": "-134", "field": "0.25", "length": "0.02"}),
    (
        "waveplate",
        {"thickness": "17.5", "birefringence": "0.0091", "wavelength": "0.55", "angle": "20"},
    ),
    (
        "waveplate",
        {"thickness": "2.5", "birefringence": "-0.172", "wavelength": "0.59", "angle": "0"},
    ),
    ("circular polarizer", {"handedness": "1"}),
    ("circular polarizer", {"handedness": "-1", "transmittance": "0.9", "leakage": "0.2"}),
    *((f"{way} by a polarizing beam splitter", _CUBE) for way in ("reflection", "transmission")),
)
_AIR, _PANE = ("1", "0"), ("1.5", "0")
_STACKS = {
    "pane": (_AIR, _PANE, _AIR),
    "two layers on glass": (_AIR, ("1.38", "0"), ("2.1", "0"), ("1.52", "0")),
    "varnish on metal": (_AIR, _PANE, ("0.2", "3.4")),
}
_SET_UPS = (
    ({"n": "1.33"}, {"n": "1.5"}, ("53", "0", "56"), ("none", "0", "90")),
    (_RHOMB, _RHOMB, ("48", "0", "54.6"), ("0", "90", "45")),
    (_STEEL, {"n": "0.608", "k": "2.12"}, ("48", "34", "20"), ("none", "0", "90")),
)


def entries() -> Iterator[tuple[str, list[Step]]]:
    """Yield every matrix of the table: its name, and the steps that it is of."""
    for name, (medium, angles) in _MEDIA.items():
        for angle in angles:
            yield _at(name, "reflection", medium, angle)
    for name, angles in _TRANSPARENT.items():
        for angle in angles:
            yield _at(name, "transmission", _MEDIA[name][0], angle)
    for does, values in _FILTERS:
        said = ", ".join(f"{key} {value}" for key, value in values.items())
        yield f"{does}, {said}", [(does, values)]
    for name, indices in _STACKS.items():
        for angle in ("0", "50"):
            yield _at(name, "reflection by layers", {"indices": indices}, angle)
            if indices[-1][1] == "0":
                yield _at(name, "transmission by layers", {"indices": indices}, angle)
    yield from _set_ups()


def mueller_table() -> str:
    """Return the table as JSON, one row of a matrix in a line."""
    made = "python tests/step_reference.py > docs/reference-mueller-matrices.json"
    signs = {name: _row(f"{sign:g}" for sign in c.signs) for name, c in CONVENTIONS.items()}
    content = {
        "description": "Mueller matrices from 50-digit arithmetic, rounded to 20 digits",
        "made by": made,
        "conventions": CONVENTION,
        "signs": {
            "description": "in another convention, entry [i][j] is multiplied by sign i and sign j",
            **signs,
        },
        "matrices": [_written(name, steps) for name, steps in entries()],
    }
    text = json.dumps(content, indent=1)
    # Python would round numbers to its floats: they are written as marked texts.
    return re.sub(r'"#([^"]*)"', r"\1", text) + "\n"


def _set_ups() -> Iterator[tuple[str, list[Step]]]:
    number = 0
    for x1, x2, (delta, rho, phi), filters in _SET_UPS:
        for axis in filters:
            number += 1
            first: list[Step] = [] if axis == "none" else [("polarizer", {"angle": axis})]
            # Along the light, the next plane of incidence is turned by -rho.
            turned = ("turned frame", {"angle": rho if rho == "0" else f"-{rho}"})
            behind = [
                ("reflection", {**x2, "incidence": phi}),
                turned,
                ("reflection", {**x1, "incidence": delta}),
            ]
            yield f"npgr026, case {number}", [*first, *behind]


def _at(name: str, does: str, values: dict[str, Any], angle: Any) -> tuple[str, list[Step]]:
    by_tangent = isinstance(angle, dict)
    said = "Brewster's angle" if by_tangent else f"{angle} deg"
    where = angle if by_tangent else {"incidence": angle}
    return f"{name}, {does}, {said}", [(does, {**values, **where})]


def _written(name: str, steps: list[Step]) -> dict[str, Any]:
    rows = mueller_of(steps)
    return {
        "name": name,
        "steps": [{"does": does, **_numbers(values)} for does, values in steps],
        "mueller": [_row(mpmath.nstr(entry, TABLE_DIGITS) for entry in row) for row in rows],
    }


def _numbers(values: Any) -> dict[str, Any]:
    return {
        name: f"#{value}" if isinstance(value, str) else [_row(pair) for pair in value]
        for name, value in values.items()
    }


def _row(numbers: Any) -> str:
    return f"#[{', '.join(numbers)}]"


if __name__ == "__main__":
    sys.stdout.write(mueller_table())

"""What the texts of options of ``optipath surface`` stand for."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.cli.given_axes import axis_given
from optipath.errors import SurfaceError, listed, shown
from optipath.values.axis_texts import AxisValues, read_entries
from optipath.values.named_materials import WAVELENGTH
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Sequence

_MOST = 1000
"""How many values there may be of which each has tables."""

_INCIDENCE, _AZIMUTH = (Parameter(name, unit="deg") for name in ("incidence", "azimuth"))


def incidences_of(texts: Sequence[str]) -> list[AxisValues]:
    """Return the angles of incidence that options give, each alone.

    Examples
    --------
    >>> [one.shown.item() for one in incidences_of(["0:60:3", "1 rad"])]
    [0.0, 30.0, 60.0, 1.0]
    """
    if not texts:
        raise SurfaceError("--incidence is missing; give the angle of incidence: --incidence 60")
    several = [_values(text, _INCIDENCE, "deg") for text in texts]
    _refuse_many("--incidence", sum([len(one.given) for one in several]))
    return [
        AxisValues(one.shown[at], one.unit, one.given[at])
        for one in several
        for at in range(len(one.given))
    ]


def wavelengths_of(text: str | None) -> AxisValues | None:
    """Return the wavelengths that an option gives, without an axis where it is one."""
    if text is None:
        return None
    found = _values(text, WAVELENGTH, "")
    _refuse_many("--wavelength", len(found.given))
    return found if axis_given(WAVELENGTH, text, ()) else found.reshaped(())


def azimuth_of(text: str) -> float:
    """Return an azimuth in radians."""
    if axis_given(_AZIMUTH, text, ()) is not None:
        raise SurfaceError(f"--azimuth takes one angle, and {shown(text)} is several; give one")
    return float(_values(text, _AZIMUTH, "deg").given[0])


def numbers_of(option: str, text: str, kind: Any, counts: tuple[int, ...]) -> tuple[Any, ...]:
    """Return numbers with commas between them.

    Examples
    --------
    >>> numbers_of("--cells", "640, 320", int, (1, 2))
    (640, 320)
    """
    try:
        found = tuple([kind(part) for part in text.split(",")])
    except ValueError:
        found = ()
    if len(found) not in counts:
        several = listed([str(count) for count in counts]).replace(" and ", " or ")
        usual = {int: "640", float: "1,0,0,0"}[kind]
        raise SurfaceError(
            f"{option} takes {several} numbers with commas between, such as {usual}, and not "
            f"{shown(text)}"
        )
    return found


def _refuse_many(option: str, count: int) -> None:
    if count > _MOST:
        raise SurfaceError(
            f"{option} gives {count:,} values, of which each has tables of its own; give "
            f"{_MOST:,} at most"
        )


def _values(text: str, parameter: Parameter, unit: str) -> AxisValues:
    return axis_given(parameter, text, ()) or read_entries([text], parameter, unit)

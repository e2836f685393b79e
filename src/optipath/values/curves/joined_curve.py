"""JoinedCurve: curves of several numbers as one, such as n by a formula and k by a table."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import ValueFault
from optipath.values.curves.curve import Curve
from optipath.values.units import format_quantity

if TYPE_CHECKING:
    from collections.abc import Hashable, Sequence


class JoinedCurve(Curve):
    """The numbers of several curves, at the wavelengths at which all are known.

    Parameters
    ----------
    label : str
        What sentences call the whole.
    curves : sequence of Curve
        What it is made of, with parts of different names.

    Raises
    ------
    ValueFault
        If there is no wavelength at which all are known.
    """

    curves: tuple[Curve, ...]

    def __init__(self, label: str, curves: Sequence[Curve]) -> None:
        lows, highs = zip(*[curve.span for curve in curves], strict=True)
        if max(lows) > min(highs):
            spans = [f"{', '.join(c.parts)} within {span_text(c.span)}" for c in curves]
            raise ValueFault(f"{label} has {' and '.join(spans)}, which have no wavelength in common")
        vars(self).update(
            label=label,
            curves=tuple(curves),
            parts=tuple([part for curve in curves for part in curve.parts]),
            span=(max(lows), min(highs)),
            beyond=curves[lows.index(max(lows))].beyond,
        )

    @property
    def content(self) -> tuple[Hashable, ...]:
        return (self.label, *[(type(one).__name__, one.content) for one in self.curves])

    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        del arguments
        return tuple([part for curve in self.curves for part in curve.numbers(xp, wavelength)])


def span_text(span: tuple[float, float]) -> str:
    """Return a range of wavelengths as text, in nanometres or micrometres.

    Examples
    --------
    >>> span_text((1.879e-7, 1.937e-6)), span_text((2e-7, 2e-4))
    ('187.9 nm .. 1937 nm', '0.2 um .. 200 um')
    """
    unit = "nm" if span[1] < 1e-5 else "um"
    return " .. ".join([format_quantity(end, unit) for end in span])

"""PageCurve: n, k or both as a page of a database has them, each by a table or a formula."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import ValueFault
from optipath.values.cures import argument
from optipath.values.curves.curve import Curve
from optipath.values.curves.wavelength_range import span_text

if TYPE_CHECKING:
    from collections.abc import Hashable, Mapping, Sequence


class PageCurve(Curve):
    """Several curves as one, at the wavelengths at which all of them are known.

    Units: within in metres.

    Examples
    --------
    >>> from optipath.values.curves.tabulated import Tabulated
    >>> n = Tabulated("n", ("n",), [4e-7, 8e-7], [[1.5, 1.3]])
    >>> k = Tabulated("k", ("k",), [5e-7, 9e-7], [[0.0, 0.4]])
    >>> PageCurve("paint", [n, k]).span
    (5e-07, 8e-07)
    """

    curves: tuple[Curve, ...]
    place: str
    source: str
    asked: Mapping[str, str]

    def __init__(
        self,
        label: str,
        curves: Sequence[Curve],
        *,
        within: tuple[float, float] | None = None,
        place: str = "",
        source: str = "",
        asked: Mapping[str, str] | None = None,
    ) -> None:
        lows, highs = zip(*[curve.span for curve in curves], strict=True)
        low, high = max(lows), min(highs)
        if low > high:
            spans = [f"{' and '.join(c.parts)} within {span_text(c.span)}" for c in curves]
            raise ValueFault(f"{label} has {', and '.join(spans)}, where no wavelength is in both")
        vars(self).update(
            label=label,
            curves=tuple(curves),
            parts=tuple([part for curve in curves for part in curve.parts]),
            place=place,
            source=source,
            asked=dict(asked or {}),
            span=(low, high),
            # The one with fewer ways to leave its range has the shorter sentence.
            beyond=min([curve.beyond for curve in curves], key=len),
        )
        if within is not None:
            clear = max(low, within[0]), min(high, within[1])
            own_k = argument("k", "1e-4")
            vars(self).update(
                span=clear, beyond=f"give k, as {own_k}" if own_k else "name another page"
            )

    @property
    def content(self) -> tuple[Hashable, ...]:
        return (self.label, self.span, *[(type(one).__name__, one.content) for one in self.curves])

    def unreal_of(self, place: int) -> str:
        curve, part = self._placed[place]
        return curve.unreal_of(part)

    def is_nowhere_0(self, place: int) -> bool:
        curve, part = self._placed[place]
        return curve.is_nowhere_0(part)

    @property
    def _placed(self) -> list[tuple[Curve, int]]:
        """The curve that has each part, and which of its own that is."""
        return [(curve, part) for curve in self.curves for part in range(len(curve.parts))]

    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        del arguments
        return tuple([part for curve in self.curves for part in curve.numbers(xp, wavelength)])

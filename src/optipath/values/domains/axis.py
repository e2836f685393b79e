"""The domain of axes: angles, some of which have names."""

from __future__ import annotations

import math
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from optipath.errors import ValueFault, did_you_mean
from optipath.values.domains.domain import Domain

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Mapping

    from optipath.values.use import Use

AXES: Mapping[str, float] = MappingProxyType(
    {
        "horizontal": 0.0,
        "vertical": math.pi / 2.0,
        "diagonal": math.pi / 4.0,
        "antidiagonal": -math.pi / 4.0,
    }
)
"""The angles of axes that have names, from x towards y."""


def axes_for(name: str, value: Any, uses: Iterable[Use]) -> Any:
    """Return what is given for a parameter, with angles for names of axes if it stands as one.

    Parameters
    ----------
    name : str
        The parameter.
    value : Any
        What is given: words of the parameter stay what they are.
    uses : iterable of Use
        Where parameters stand.

    Returns
    -------
    Any
    """
    if not isinstance(value, (str, list, tuple)):
        return value
    for use in uses:
        if isinstance(use.domain, AxisDomain) and use.value.formula == name:
            return _with_angles(value, use.value.all_words)
    return value


def _with_angles(value: Any, words: Collection[str]) -> Any:
    if isinstance(value, str):
        return value if value in words else AXES.get(value, value)
    # One row of them; a list of lists may be anything, even a part of itself.
    return [AXES.get(v, v) if isinstance(v, str) and v not in words else v for v in value]


class AxisDomain(Domain):
    """Angles of an axis across the light; some have names.

    Examples
    --------
    >>> AxisDomain("angle", "angle").parse("antidiagonal") == -math.pi / 4.0
    True
    """

    def parse(self, text: str) -> Any:
        if (word := text.strip()) in AXES:
            return AXES[word]
        if word[:1].isalpha():
            raise ValueFault(f"axis '{word}' is unknown{did_you_mean(word, AXES)}")
        return super().parse(text)

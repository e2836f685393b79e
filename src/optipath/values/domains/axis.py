"""The domain of axes: angles, some of which have names."""

from __future__ import annotations

import math
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from optipath.errors import ParameterError, ValueFault, did_you_mean
from optipath.spelling import closest
from optipath.values.domains.domain import Domain
from optipath.values.unknown_parameter import unknown_word

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from optipath.values.parameters import Parameter
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

    Raises
    ------
    ParameterError
        If it stands as an axis, and the word is no name of one.
    """
    if not isinstance(value, (str, list, tuple)):
        return value
    for use in uses:
        if isinstance(use.domain, AxisDomain) and use.value.formula == name:
            if isinstance(value, str):
                return _angle_of(value, use.value)
            # One row of them; a list of lists may be anything, even a part of itself.
            return [_angle_of(one, use.value) for one in value]
    return value


def _angle_of(value: Any, parameter: Parameter) -> Any:
    """Return the angle of an axis that has a name; the value itself where that is none."""
    if not isinstance(value, str) or value in parameter.all_words:
        return value
    if value[:1].isalpha() and value not in AXES:
        words = dict.fromkeys((*parameter.all_words, *AXES))
        raise ParameterError(unknown_word(parameter.name, value, words))
    return AXES.get(value, value)


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
            angle = "" if closest(word, AXES) else ", or give an angle such as '45 deg'"
            raise ValueFault(f"axis '{word}' is unknown{did_you_mean(word, AXES)}{angle}")
        return super().parse(text)

"""The domain of axes: angles, some of which have names."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import ParameterError, ValueFault
from optipath.values.axis_names import AXES
from optipath.values.domains.domain import Domain
from optipath.values.parameters import Parameter
from optipath.values.unknown_parameter import unknown_word, word_meant

if TYPE_CHECKING:
    from collections.abc import Iterable

    from optipath.values.use import Use


def axes_for(name: str, value: Any, uses: Iterable[Use]) -> Any:
    """Return what is given for a parameter, with angles for names of axes if it stands as one.

    It is the angle of the parameter itself that has the name, where its negative is the axis: on
    the way back, an axis stands at ``-a``.
    """
    if not isinstance(value, (str, list, tuple)):
        return value
    for use in uses:
        if not isinstance(use.domain, AxisDomain) or not isinstance(use.value, Parameter):
            continue
        if use.value.name == name and use.value.is_signed:
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
        raise ParameterError(unknown_word(parameter.name, value, words, "angle"))
    return AXES.get(value, value)


class AxisDomain(Domain):
    """Angles of an axis across the light; some have names.

    Examples
    --------
    >>> AxisDomain("angle", "angle").parse("antidiagonal")
    -0.7853981633974483
    """

    def parse(self, text: str) -> Any:
        if (word := text.strip()) in AXES:
            return AXES[word]
        if word[:1].isalpha():
            raise ValueFault(f"axis '{word}' is unknown{word_meant(word, AXES, self.dimension)}")
        return super().parse(text)


class OptionalAxisDomain(AxisDomain):
    """The same, or none.

    Examples
    --------
    >>> OptionalAxisDomain("angle", "angle").parts("dichroic_angle", None)
    []
    """

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        return [] if value is None else super().parts(name, value)

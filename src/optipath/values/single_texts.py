"""What one text stands for that is given for a parameter, at the command line or on the page."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import ParameterError
from optipath.values.domains.axis import axes_for
from optipath.values.other_part import other_part

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from optipath.values.parameters import Parameter
    from optipath.values.use import Use


def single_value(
    parameter: Parameter,
    text: str,
    uses: Sequence[Use],
    unit: str = "",
    called: Callable[[str], str] = str,
) -> Any:
    """Return what a text stands for: a number, a word of the parameter, or an axis.

    Examples
    --------
    >>> from optipath.values.parameters import Parameter
    >>> single_value(Parameter("delta", unit="deg"), "180", (), "deg")
    3.141592653589793
    """
    value = axes_for(parameter.name, text, uses)
    if isinstance(value, str):
        value = parameter.parse(value, unit)
    if isinstance(value, complex) and (other := other_part(uses, parameter.name, called)):
        name = called(parameter.name)
        raise ParameterError(f"'{text}' is complex, but {name} takes a real number; {other}")
    return value

"""Values that are given by name, and what to say where one is given by its place."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from optipath.errors import ParameterError, did_you_mean, shown

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence


def check_named(
    call: str, unnamed: Sequence[object], names: Iterable[str], first: str = ""
) -> None:
    """Refuse values that are given without a name.

    Examples
    --------
    >>> check_named("run", [0.5], ["delta", "rho"])
    Traceback (most recent call last):
    optipath.errors.ParameterError: values are given by name: run(delta=0.5); there are: delta, rho
    """
    if not unnamed:
        return
    value, known = unnamed[0], list(names)
    if not known:
        raise ParameterError(f"{call}() takes no values here: no parameter is open")
    if isinstance(value, Mapping):
        written = f"**{shown(dict(value))}"
    else:
        written = f"{known[0]}={shown(value)}"
    written = f"{first}, {written}" if first else written
    raise ParameterError(f"values are given by name: {call}({written}){did_you_mean('', known)}")

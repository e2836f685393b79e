"""Messages: of values that are missing, or given without a name."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from optipath.errors import Cure, Fault, ParameterError, did_you_mean, shown

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence


def no_value(name: str) -> Fault:
    """Return the fault of a parameter that nobody has given a value.

    >>> no_value("n")
    "parameter 'n' has no value; give one, n=..."
    """
    cure = Cure.giving(name, lambda way: f"give one, {way}")
    return Fault(f"parameter '{name}' has no value", cure, subject=name)


def no_function(name: str, raw_value: object, wanted: str) -> list[str]:
    """Return the sentence for what is no function; none for one, or for None.

    >>> no_function("progress", 3, "two numbers"), no_function("progress", print, "two numbers")
    (['progress is 3; give a function of two numbers'], [])
    """
    if raw_value is None or callable(raw_value):
        return []
    return [f"{name} is {shown(raw_value)}; give a function of {wanted}"]


PHOTONS_REPORTED = "two numbers: how many photons there are, and of how many"
"""Of what the function is that is told how far photons have been walked."""


def check_named(
    call: str, unnamed: Sequence[object], names: Iterable[str], first: str = ""
) -> None:
    """Refuse values that are given without a name.

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

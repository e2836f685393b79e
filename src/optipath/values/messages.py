"""Parts of messages: cures as Python, a preset file or the command line writes them."""

from __future__ import annotations

from collections.abc import Mapping
from contextvars import ContextVar
from typing import TYPE_CHECKING

from optipath.errors import ParameterError, did_you_mean, having, shown

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from contextlib import AbstractContextManager


_IN_FILE: ContextVar[bool] = ContextVar("_IN_FILE", default=False)
_IN_FIELDS: ContextVar[bool] = ContextVar("_IN_FIELDS", default=False)
_OPTIONS: ContextVar[Mapping[str, str] | None] = ContextVar("_OPTIONS", default=None)


def of_files() -> AbstractContextManager[None]:
    """Let all cures inside be written as preset files write them."""
    return having(_IN_FILE, value=True)


def of_fields() -> AbstractContextManager[None]:
    """Let all values inside be given in fields of their own, as on a page."""
    return having(_IN_FIELDS, value=True)


def of_options(options: Mapping[str, str]) -> AbstractContextManager[None]:
    """Let all arguments inside be named as options of a command line."""
    return having(_OPTIONS, options)


def argument(name: str, value: str = "") -> str:
    """Return how an argument is given where the fault is; nothing where no option gives it.

    >>> argument("k", "0.0")
    'k=0.0'
    >>> with of_options({"k": "--k1"}):
    ...     argument("k", "0.0"), argument("page")
    ('--k1 0.0', '')
    """
    options = _OPTIONS.get()
    if options is None:
        return cure(f"{name}={value}", f"{name} = {value}".rstrip())
    return f"{options[name]} {value}".rstrip() if name in options else ""


def cure(python: str, file: str) -> str:
    """Return a cure as it is written where the fault is.

    >>> cure("op.FOLLOWS", '"follows"')
    'op.FOLLOWS'
    >>> with of_files():
    ...     print(cure("op.FOLLOWS", '"follows"'))
    "follows"
    """
    return file if _IN_FILE.get() else python


def how_to_give(name: str) -> str:
    """Return how a value is given for a parameter, where files are run at the command line.

    >>> how_to_give("n_1")
    'n_1=...'
    >>> with of_files():
    ...     print(how_to_give("n_1"))
    --n-1 ...
    >>> with of_fields():
    ...     print(how_to_give("n_1"))
    in its field
    """
    if _IN_FIELDS.get():
        return "in its field"
    return cure(f"{name}=...", f"--{name.replace('_', '-')} ...")


def no_value(name: str) -> str:
    """Return the sentence for a parameter that nobody has given a value.

    >>> no_value("n")
    "parameter 'n' has no value; give one, n=..."
    """
    return f"parameter '{name}' has no value; give one, {how_to_give(name)}"


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


UNITS_ARE_WRITTEN: ContextVar[bool] = ContextVar("UNITS_ARE_WRITTEN", default=False)


def units_are_written() -> AbstractContextManager[None]:
    """Let no number inside be taken for one of degrees: all come from texts with units.

    >>> with units_are_written():
    ...     print(UNITS_ARE_WRITTEN.get())
    True
    """
    return having(UNITS_ARE_WRITTEN, value=True)

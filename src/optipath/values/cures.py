"""Cures as they are written where the fault is: in Python, a preset file, or a command line."""

from __future__ import annotations

from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

_IN_FILE: ContextVar[bool] = ContextVar("_IN_FILE", default=False)
_IN_FIELDS: ContextVar[bool] = ContextVar("_IN_FIELDS", default=False)
_OPTIONS: ContextVar[Mapping[str, str] | None] = ContextVar("_OPTIONS", default=None)


@contextmanager
def of_files() -> Iterator[None]:
    """Let all cures inside be written as preset files write them."""
    token = _IN_FILE.set(True)
    try:
        yield
    finally:
        _IN_FILE.reset(token)


@contextmanager
def of_fields() -> Iterator[None]:
    """Let all values inside be given in fields of their own, as on a page."""
    token = _IN_FIELDS.set(True)
    try:
        yield
    finally:
        _IN_FIELDS.reset(token)


@contextmanager
def of_options(options: Mapping[str, str]) -> Iterator[None]:
    """Let all arguments inside be named as options of a command line."""
    token = _OPTIONS.set(options)
    try:
        yield
    finally:
        _OPTIONS.reset(token)


def argument(name: str, value: str = "") -> str:
    """Return how an argument is given where the fault is; nothing where no option gives it.

    Examples
    --------
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

    Examples
    --------
    >>> cure("op.FOLLOWS", '"follows"')
    'op.FOLLOWS'
    >>> with of_files():
    ...     print(cure("op.FOLLOWS", '"follows"'))
    "follows"
    """
    return file if _IN_FILE.get() else python


def how_to_give(name: str) -> str:
    """Return how a value is given for a parameter, where files are run at the command line.

    Examples
    --------
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

    Examples
    --------
    >>> no_value("n")
    "parameter 'n' has no value; give one, n=..."
    """
    return f"parameter '{name}' has no value; give one, {how_to_give(name)}"

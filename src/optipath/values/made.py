"""What is checked when something is made of values: texts are read, and all faults told at once."""

from __future__ import annotations

from contextlib import contextmanager
from contextvars import ContextVar
from itertools import chain
from typing import TYPE_CHECKING, Any, TypeVar

from optipath.errors import ValueFault
from optipath.values.degree_warnings import warn_of_degrees
from optipath.values.domains.domain import in_unit_of
from optipath.values.parameters import Parameter
from optipath.values.specification import warn_where_it_stands
from optipath.values.use import Use

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping

    from optipath.values.domains.domain import Domain

T = TypeVar("T")

_EXACT = 1 << 53
"""Up to what size a float is every whole number."""

_is_checked_later: ContextVar[bool] = ContextVar("_is_checked_later", default=False)


@contextmanager
def checked_later() -> Iterator[None]:
    """Leave the values of what is made inside to the check of the whole path, which names nodes.

    Examples
    --------
    >>> from optipath.elements.attenuator import Attenuator
    >>> with checked_later():
    ...     Attenuator(1.5).faults("filter")
    ['filter.transmittance is 1.5; give a real fraction within 0 .. 1']
    """
    token = _is_checked_later.set(True)
    try:
        yield
    finally:
        _is_checked_later.reset(token)


def is_checked_later() -> bool:
    """Tell whether values are left to the check of the whole path."""
    return _is_checked_later.get()


def make_sound(
    whole: Any,
    domains: Mapping[str, Domain],
    quantities: Callable[[], Iterable[tuple[str, Any, Domain]]],
    *,
    of_fields: bool = True,
) -> bool:
    """Replace the values of something by what it keeps, and refuse what is not allowed."""
    sound: dict[str, Domain] = {}
    faults: dict[str, list[str]] = {}
    for name, domain in domains.items():
        value = getattr(whole, name)
        number = float(value) if type(value) is int and abs(value) <= _EXACT else value
        left_out = value is None and not domain.parts(name, value)
        if left_out or domain.quickly_allows(number):
            sound[name] = domain
            continue
        owner = f"{type(whole).__name__} {name}"
        try:
            object.__setattr__(whole, name, kept_value(owner, value, domain))
        except ValueFault as fault:
            faults[name] = list(fault.faults)
    if _is_checked_later.get():
        return False
    if of_fields and len(sound) == len(domains):
        return True
    uses = [
        Use(f"{type(whole).__name__} {name}", value, domain)
        for name, value, domain in quantities()
        if name not in faults and sound.get(name) is not domain
    ]
    refuse([*chain(*faults.values()), *faults_of(uses)])
    return True


def remember_sound(whole: Any) -> None:
    """Remember that all values of something are allowed, so that nobody looks at them again."""
    vars(whole)["_is_sound"] = True


def is_known_sound(whole: Any) -> bool:
    """Tell whether all values of something have been looked at, and are allowed."""
    return "_is_sound" in vars(whole)


def not_known_sound(whole: T) -> T:
    """Return a copy of something in which other values stand than those that were looked at."""
    vars(whole).pop("_is_sound", None)
    return whole


def kept_value(owner: str, value: Any, domain: Domain) -> Any:
    """Return a value as it is kept: numbers for texts, read-only arrays, parameters with a unit."""
    if domain.takes_large_angles and not _is_checked_later.get():
        # Of a parameter with a unit, it has been told when it was made.
        without = isinstance(value, Parameter) and (value.bound or not value.unit)
        if without:
            warn_of_degrees(owner, value.plain_numbers, value)
        elif not isinstance(value, Parameter):
            warn_of_degrees(owner, value)
        if isinstance(value, Parameter) and not value.offset_dimension:
            warn_of_degrees(f"the offset of parameter '{value.name}' at {owner}", value.offset)
    if isinstance(value, Parameter):
        if not value.unit and domain.dimension == "angle" and not _is_checked_later.get():
            warn_where_it_stands(value)
        return in_unit_of(value, domain)
    return domain.kept(domain.read(owner, value))


def refuse(faults: list[str]) -> None:
    """Raise with what is wrong with something that has just been made, unless it is told later."""
    if faults and not _is_checked_later.get():
        raise ValueFault(*faults)


def faults_of(uses: Iterable[Use]) -> list[str]:
    """Return what is wrong with the values that are known already, a sentence each."""
    found: list[str] = []
    for use in uses:
        try:
            use.check()
        except ValueFault as fault:
            found += fault.faults
    return found

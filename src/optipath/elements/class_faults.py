"""What is wrong with a class of elements, told when it is made."""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING, Any

from optipath.errors import listed, shown

if TYPE_CHECKING:
    from collections.abc import Iterator

TURN = "azimuth"
"""The field that turns the frame, and is no value of a matrix."""

_MEANT = {
    "kind": 'write class Name(op.Element, kind="..."), or ',
    "inputs": "write inputs: ClassVar[tuple[str, ...]], or ",
    "outputs": "write outputs: ClassVar[tuple[str, ...]], or ",
    "natural": "write natural: ClassVar[str], or ",
    "physical": "write physical: ClassVar[bool], or ",
    "straight": "write straight: ClassVar[bool], or ",
    "mirrored": "write mirrored: ClassVar[tuple[str, ...]], or ",
}
"""What is meant by fields that are called like what every element has."""

_GIVEN = ("physical", "straight")
"""What each element of a class may be given, with a domain; a class of one kind says it once."""


def _is_name(port: Any) -> bool:
    return isinstance(port, str)


def _are_names(ports: Any) -> bool:
    return isinstance(ports, (tuple, list)) and all(map(_is_name, ports))


_PORTS = (
    ("inputs", "the names of ports, such as ('in',)", _are_names),
    ("outputs", "the names of ports, such as ('out',)", _are_names),
    ("natural", "the name of a port", _is_name),
    ("entry", "the name of a port", _is_name),
)


def class_faults(element_class: type[Any], base: type[Any], kind: Any) -> list[str]:
    """Return what is wrong with a class of elements, a sentence each."""
    return [*_faults(element_class, base, kind)]


def _faults(element_class: type[Any], base: type[Any], kind: Any) -> Iterator[str]:
    name = element_class.__name__
    if not isinstance(kind, str):
        yield f"the kind of element class {name} must be a text, not {shown(kind)}"
    own = {field.name: field.type for field in fields(element_class)}
    for field, annotation in own.items():
        if hasattr(base, field) and not (field in _GIVEN and annotation not in (bool, "bool")):
            yield (
                f"field '{field}' of element class {name} is called like what every element has; "
                f"{_MEANT.get(field, '')}give it another name"
            )
    for which, what, is_right in _PORTS:
        if which not in own and not is_right(value := getattr(element_class, which)):
            yield f"{which} of element class {name} must be {what}, not {shown(value)}"
    if (said := vars(element_class).get("mirrored")) is not None and "mirrored" not in own:
        yield from _mirrored_faults(name, said, [field for field in own if field != TURN])
    if "mueller_rows" in vars(element_class):
        names = [field for field in own if field != TURN]
        yield from _rows_faults(name, vars(element_class)["mueller_rows"], names)


def _mirrored_faults(owner: str, said: Any, names: list[str]) -> Iterator[str]:
    """Say which of the fields that change their sign on the way back are none."""
    if not _are_names(said):
        yield f"mirrored of element class {owner} must be names of fields, not {shown(said)}"
        return
    for name in (name for name in said if name not in names):
        why = "whose links say how it is turned" if name == TURN else "which is none of its fields"
        yield f"mirrored of element class {owner} names '{name}', {why}; take it out"


def _rows_faults(owner: str, rows: Any, names: list[str]) -> Iterator[str]:
    """Say what is wrong with `mueller_rows` of a class whose fields are called so."""
    what = f"mueller_rows of element class {owner}"
    static = "put @staticmethod before it, and let it take xp and the number of each field"
    function = rows.__func__ if isinstance(rows, (staticmethod, classmethod)) else rows
    if not callable(function):
        yield f"{what} is {shown(rows)}; make it a static method that returns the rows"
        return
    code = getattr(function, "__code__", None)
    first, *taken = code.co_varnames[: code.co_argcount] if code and code.co_argcount else ("",)
    if isinstance(rows, classmethod):
        yield f"{what} is a class method; {static} in place of @classmethod: mueller_rows(xp, ...)"
    elif first == "self":
        yield f"{what} takes self; {static}: mueller_rows(xp, ...)"
    else:
        given = [name for name in names if name in taken]
        if given != [name for name in taken if name in names]:
            yield (
                f"{what} takes {listed(taken)}, but values come in the order of the fields, "
                f"{listed(names)}; take them in that order"
            )

"""The public names of a package, imported when they are used."""

from __future__ import annotations

import re
import sys
from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from optipath.faults import closest

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping


def public_names(
    package: str, needs: Callable[[], None] | None = None
) -> tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]:
    """Return ``__getattr__``, ``__dir__`` and ``__all__`` of a package with a stub of its names.

    The stub ``__init__.pyi`` has an import a line for each public name, which is done when it is
    used (PEP 562): of `optipath` with all of its room, so that kinds of elements are known all or
    none, elsewhere alone. `needs` raises where packages are missing.
    """
    space = vars(sys.modules[package])
    loader = space["__spec__"].loader
    stub = loader.get_data(f"{space['__file__'].rpartition('.')[0]}.pyi").decode()
    lines = re.findall(r"^from (optipath[\w.]*) import (\w+) as \w+$", stub, re.MULTILINE)
    home_of = {name: home for home, name in lines}
    public = sorted(home_of)

    def get(name: str) -> Any:
        if home_of.get(name, package) == package:
            return _other(package, name, home_of)
        if needs is not None:
            needs()
        parts = home_of[name].split(".")
        room = parts[:2] if package == parts[0] else parts
        for each, home in home_of.items():
            if home.split(".")[: len(room)] == room:
                space[each] = getattr(import_module(home), each)
        return space[name]

    return get, lambda: public, public


def _other(package: str, name: str, home_of: Mapping[str, str]) -> Any:
    """Return a module of the package, or its version; refuse what is neither."""
    if name == "__version__" and "." not in package:
        from importlib.metadata import version  # noqa: PLC0415 - takes its time

        return version(package)
    if not name.startswith("__") and find_spec(f"{package}.{name}") is not None:
        return import_module(f"{package}.{name}")
    places = {each: f"'{each}'" for each in home_of}
    for group in (each for each, home in home_of.items() if home == package and name[0] != "_"):
        for each in import_module(f"{package}.{group}").__all__:
            places.setdefault(each, f"op.{group}.{each}")
    near = closest(name, places)
    cure = f"; did you mean {places[near]}?" if near else ""
    cure = f"; it is {places[name]}" if name in places else cure
    wrong = f"module '{package}' has no attribute '{name}'{cure}"
    # By `from optipath import ...`, which else says a sentence of its own.
    if sys._getframe(2).f_code.co_name == "_handle_fromlist":  # noqa: SLF001 - of Python's importlib
        raise ImportError(wrong, name=package)
    # With an object, Python would add a name of its own to the one above.
    raise AttributeError(wrong, name=name)

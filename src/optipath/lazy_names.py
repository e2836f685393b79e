"""Public names that are imported when they are used (PEP 562)."""

from __future__ import annotations

import sys
from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from optipath.spelling import closest

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence


def lazy_names(
    package: str,
    homes: Mapping[str, Sequence[str]],
    *,
    at_once: bool = False,
    needs: Callable[[], None] | None = None,
) -> tuple[Callable[[str], Any], Callable[[], list[str]]]:
    """Return the ``__getattr__`` and the ``__dir__`` of a package that imports names by need."""
    home_of = {name: home for home, names in homes.items() for name in names}
    space = vars(sys.modules[package])

    def get(name: str) -> Any:
        if name not in home_of:
            return _other(package, name, space["__all__"])
        if needs is not None:
            needs()
        for home in homes if at_once else [home_of[name]]:
            module = import_module(f"{package}.{home}")
            space.update({each: getattr(module, each) for each in homes[home]})
        return space[name]

    return get, lambda: space["__all__"]


def _other(package: str, name: str, names: Sequence[str]) -> Any:
    """Return a room of the package, or its version; refuse what is neither."""
    if name == "__version__" and "." not in package:
        from importlib.metadata import version  # noqa: PLC0415 - takes its time

        return version(package)
    if not name.startswith("__") and find_spec(f"{package}.{name}") is not None:
        return import_module(f"{package}.{name}")
    near = closest(name, names)
    cure = f"; did you mean '{near}'?" if near else ""
    wrong = f"module '{package}' has no attribute '{name}'{cure}"
    raise AttributeError(wrong, name=name, obj=sys.modules[package])

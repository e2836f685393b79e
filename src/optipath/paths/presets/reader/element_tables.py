"""Reading an element: its kind, its values, and its world frames."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.elements.known_elements import element_class
from optipath.elements.own_couplings import is_own
from optipath.elements.registry import KINDS
from optipath.errors import shown
from optipath.kernels.carriers.own_code import called
from optipath.light.frames import Frame
from optipath.paths.format import schema
from optipath.paths.format.codec import decode
from optipath.paths.format.faults import Faults
from optipath.values.domains.choice import Choice
from optipath.values.made import checked_later
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.elements.element import Element

STAND_IN = Parameter("unknown")
"""Takes the place of a value that is missing or faulty, so that the rest is checked too."""


@checked_later()  # With the whole path, by the names of its nodes.
def read_element(
    where: str, table: dict[str, Any], parameters: Mapping[str, Parameter], faults: Faults
) -> Element | None:
    """Return the element that a table describes; None where its kind is not known."""
    named = table if "kind" in table else schema.as_meant(_no_fields(table), ["kind"])
    kind = named.get("kind")
    if not isinstance(kind, str):
        what = f"'kind' must be a text, not {shown(kind)}" if "kind" in named else "kind is missing"
        faults.append(f'{where}: {what}; write kind = "..."')
        return None
    found = faults.attempt(where, element_class, kind)
    if found is None:
        return None
    domains = found.domains()
    known = ["kind", "frames", *domains]
    if wrong := schema.key_faults(where, table, known):
        faults += wrong
        table = schema.as_meant(table, known)
    values: dict[str, Any] = {}
    for name, domain in domains.items():
        if name in table:
            value = faults.attempt(f"{where}.{name}", decode, table[name], domain, parameters)
            if value is not None:
                values[name] = value
            elif not isinstance(domain, Choice):
                values[name] = STAND_IN
        elif found.needs(name):
            faults.append(f"{where}: '{name}' is missing; every {kind} needs one")
            values[name] = STAND_IN
    what = f"element class {found.__name__}"
    # What code of a user's own says of a stand-in is no news.
    unknown = is_own(found) and any(value is STAND_IN for value in values.values())
    told = Faults() if unknown else faults
    return told.attempt(where, lambda: called(what, lambda: found(**values)))


def _no_fields(table: Mapping[str, Any]) -> dict[str, Any]:
    """Return what is in a table that no element has a field for, as it has for ``index``."""
    fields = {name for found in KINDS.values() for name in found.domains()}
    return {key: value for key, value in table.items() if key not in fields}


def read_frames(where: str, table: Any, faults: Faults) -> dict[str, Frame]:
    """Return the world frames of an element's ports."""
    if not isinstance(table, dict) or not all(isinstance(axes, dict) for axes in table.values()):
        faults.append(f"{where}.frames must be tables with x, y and z, one for each port")
        return {}
    frames = {}
    for port, axes in table.items():
        at = f"{where}.frames.{port}"
        wrong = schema.key_faults(at, axes, ("x", "y", "z", "rounding"))
        wrong += [f"{at}: axis '{axis}' is missing" for axis in "xyz" if axis not in axes]
        faults += wrong
        frame = None if wrong else faults.attempt(at, Frame, **axes)
        if frame is not None:
            frames[port] = frame
    return frames

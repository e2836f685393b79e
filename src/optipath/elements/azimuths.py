"""The azimuth of an element, by which it stands turned in the frame of the light before it."""

from __future__ import annotations

from typing import Any


def azimuth_at(element: Any, port: str) -> Any:
    """Return the azimuth by which a port is turned: that of an element is that of its ``in``.

    Light that comes from behind is in the plane of the element already, or its link says how
    it stands to it.

    Units: the result in radians.

    Examples
    --------
    >>> from optipath import Interface
    >>> pane = Interface(1.5, 0.8, azimuth=0.3)
    >>> azimuth_at(pane, "in"), azimuth_at(pane, "back")
    (0.3, 0.0)
    """
    is_other = port != "in" and "in" in element.inputs
    return 0.0 if is_other else getattr(element, "azimuth", 0.0)

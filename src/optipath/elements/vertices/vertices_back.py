"""The vertices of a chain in the order in which light meets them on its way back."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from optipath.elements.known_sizes import bound_value
from optipath.elements.vertices.by_angles import VerticesByAngles
from optipath.errors import PathError
from optipath.values.parameters import Parameter


def vertices_back(owner: str, vertices: Any) -> Any:
    """Return the points of a chain from its end to its start.

    Shapes: vertices (..., m + 2, 3); returns (..., m + 2, 3).

    Examples
    --------
    >>> import numpy as np
    >>> vertices_back("vertex", np.array([[0, 0, 0], [0, 0, 1], [0, 1, 1]])).tolist()
    [[0, 1, 1], [0, 0, 1], [0, 0, 0]]
    """
    if isinstance(vertices, VerticesByAngles):
        return replace(vertices, backwards=not vertices.backwards)
    if isinstance(vertices, Parameter):
        if not vertices.bound:
            raise PathError(
                f"the vertices of {owner} are parameter '{vertices.name}', whose points come in "
                f"the other order on the way back; give the points, or bind them first, "
                f"path.bind({vertices.name}=...)"
            )
        vertices = bound_value(vertices)
    return vertices[..., ::-1, :]

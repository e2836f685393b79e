"""Where rays meet meshes, in exact fractions: where the height above the surface comes to 0."""

from fractions import Fraction
from itertools import pairwise
from math import ceil, floor

import numpy as np


def surface_height(vertices, x, y):
    """The height over a point in cells; flat over each half of a cell."""
    rows, columns = vertices.shape
    column, line = min(floor(x), columns - 2), min(floor(y), rows - 2)
    u, v = x - column, y - line
    low, right, back, high = (
        Fraction(vertices[line + i, column + j].item()) for i in (0, 1) for j in (0, 1)
    )
    if u >= v:
        return low + u * (right - low) + v * (high - right)
    return low + v * (back - low) + u * (high - back)


def first_meeting(field, start, direction, side):
    """Where a ray meets a field; None where it does not.

    The ray is straight between its crossings of the lines of the mesh, where the surface is flat:
    it meets the surface in the first piece in which it comes nearer and gets below. To touch is not
    to meet.
    """
    above = height_above(field, start, direction)
    times = crossings(field, start, direction)
    for begin, end in pairwise(times):
        first, last = side * above(begin), side * above(end)
        if last < min(first, 0):
            return float(begin + (end - begin) * max(first, 0) / (max(first, 0) - last))
    return None


def height_above(field, start, direction):
    """How high a ray is above the surface, of the place along the ray."""
    vertices = field.vertices()

    def above(t):
        x, y, z = (one + Fraction(t) * step for one, step in exactly(start, direction))
        if field.periodic:
            x, y = x % field.cells[0], y % field.cells[1]
        return z - surface_height(vertices, x, y)

    return above


def crossings(field, start, direction):
    """Where a ray crosses lines of the mesh, from its start until it is gone from the mesh."""
    (x, along), (y, across), (z, up) = exactly(start, direction)
    edge = Fraction(float(np.max(field.heights) if up > 0 else np.min(field.heights)))
    last = max((edge - z) / up, Fraction(0))
    if not field.periodic:
        for one, step, cells in ((x, along, field.cells[0]), (y, across, field.cells[1])):
            if step:
                last = min(last, ((cells if step > 0 else 0) - one) / step)
    times = {Fraction(0), last}
    for one, step in ((x, along), (y, across), (x - y, along - across)):
        ends = sorted((one, one + last * step))
        if step:
            times |= {(line - one) / step for line in range(ceil(ends[0]), floor(ends[1]) + 1)}
    return sorted(times)


def exactly(start, direction):
    """Both as fractions, by axis."""
    return [
        (Fraction(float(one)), Fraction(float(step)))
        for one, step in zip(start, direction, strict=True)
    ]

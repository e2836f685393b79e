"""Light as the page has it: numbers for pictures, and texts as the command line prints them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.light.printed_numbers import Numbers
from optipath.plots.states.ellipse_points import ellipse_points
from optipath.sweeps.labels.light_quantities import QUANTITIES
from optipath.values.plain_json import plain

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.light.light import Light

PRINTED = Numbers(6)
"""How `optipath run` prints numbers where nobody says otherwise."""

_POINTS = 97
_HANDS = {1: "right-handed", -1: "left-handed", 0: "linear"}
_UNPOLARISED = "unpolarised"


def quantities_as_json() -> list[dict[str, str]]:
    """Return what light is told of, with labels and units."""
    return [
        {"name": each.variable, "label": each.name, "unit": each.shown_unit} for each in QUANTITIES
    ]


def end_as_json(light: Light, published: Sequence[float] | None) -> dict[str, Any]:
    """Return the light at a detector."""
    texts = PRINTED.stokes(light)
    told = [f"{number:g}" for number in published] if published else None
    return {
        "stokes": plain(light.stokes),
        "texts": texts,
        "published": list(published) if published else None,
        "published_texts": told,
        "quantities": _quantities(light, texts),
        "poincare": poincare(light),
        "ellipse": _ellipse(light),
    }


def link_as_json(name: str, start: str, end: str, light: Light) -> dict[str, Any]:
    """Return the light on a link."""
    return {
        "link": name,
        "start": start,
        "end": end,
        "stokes": plain(light.stokes),
        "dop": plain(light.dop),
        "poincare": poincare(light),
        "texts": PRINTED.stokes(light),
    }


def poincare(light: Light) -> list[float] | None:
    """Return (S1, S2, S3) over S0, a point within the sphere; None where there is none.

    Examples
    --------
    >>> import optipath as op
    >>> poincare(op.Light([2.0, 1.0, 0.0, 1.0])), poincare(op.Light([0.0, 0.0, 0.0, 0.0]))
    ([0.5, 0.0, 0.5], None)
    """
    point = np.asarray(light.normalized, float)[1:]
    return (point + 0.0).tolist() if np.isfinite(point).all() else None


def _quantities(light: Light, stokes: Sequence[str]) -> list[dict[str, Any]]:
    found = []
    for quantity in QUANTITIES:
        unit, component = quantity.shown_unit, quantity.attribute
        number = plain(np.asarray(quantity.of(light), float), unit)
        state = PRINTED.state(math.nan if number is None else number)
        text = stokes[int(component)] if component.isdigit() else state
        told = {"name": quantity.variable, "label": quantity.name, "unit": unit}
        found.append({**told, "number": number, "text": text})
    return found


def _ellipse(light: Light) -> dict[str, Any]:
    points = ellipse_points(light, _POINTS)
    angle = float(light.ellipticity_angle)
    there = bool(np.isfinite(points).all())
    hand = _HANDS[int(light.handedness)] if there else _UNPOLARISED
    return {
        "points": (points + 0.0).tolist() if there else None,
        "dop": plain(light.dop),
        "major": float(np.cos(angle)) if there else None,
        "minor": float(np.abs(np.sin(angle))) if there else None,
        "aop": plain(light.aop, "deg"),
        "handedness": hand,
    }

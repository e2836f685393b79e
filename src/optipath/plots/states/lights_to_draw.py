"""The lights that a picture shows, each by the name that it has there."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from optipath.errors import OptipathError, shown
from optipath.light.light import Light
from optipath.plots.line_colours import LINES
from optipath.values.arrays.jax_values import check_known

MOST = len(LINES)
"""How many lights are told apart beside one another."""


def known_light(light: Any) -> Light:
    """Return what is a light, with numbers that are known.

    Examples
    --------
    >>> known_light(Light([1.0, 0.0, 0.0, 1.0])).shape
    ()
    """
    if not isinstance(light, Light):
        raise OptipathError(
            f"{shown(light)} is no light; give a Light, as path.trace() returns it or "
            "op.Light([S0, S1, S2, S3]) makes it"
        )
    check_known("a picture of light", light.mantissa)
    return light


def lights_to_draw(light: Any, labels: Any = None) -> dict[str, Light]:
    """Return one or several lights by their names.

    Shape: light (n,).

    Examples
    --------
    >>> [*lights_to_draw(Light([[1.0, 0.0, 0.0, 1.0], [1.0, 1.0, 0.0, 0.0]]))]
    ['light[0]', 'light[1]']
    """
    if isinstance(light, Mapping):
        several = _by_name(light, labels)
    elif known_light(light).shape == ():
        several = {_names(labels, 1, [""])[0]: light}
    elif light.ndim > 1:
        raise OptipathError(
            f"light of shape {light.shape} is more than a row; give one row of it, "
            f"light[{', '.join('0' for _ in light.shape[1:])}], or light.reshape(n)"
        )
    else:
        _check_count(light.size, "light[:6], or every so many, light[::step]")
        names = _names(labels, light.size, [f"light[{place}]" for place in range(light.size)])
        several = dict(zip(names, light, strict=True))
    return several


def _by_name(light: Mapping[Any, Any], labels: Any) -> dict[str, Light]:
    _check_count(len(light), "a mapping of fewer")
    faults = [] if labels is None else ["labels are for a batch; a mapping has names already"]
    several = {str(name): known_light(each) for name, each in light.items()}
    faults += [
        f"light {shown(name)} is a batch of shape {each.shape}; give one of it by its index"
        for name, each in several.items()
        if each.shape
    ]
    if faults:
        raise OptipathError(*faults)
    return several


def _check_count(count: int, cure: str) -> None:
    if count == 0:
        raise OptipathError("there is no light to draw; give one at least")
    if count > MOST:
        raise OptipathError(
            f"{count} lights are too many to tell apart in one picture, which has {MOST} at most; "
            f"give {cure}"
        )


def _names(labels: Any, count: int, otherwise: list[str]) -> list[str]:
    """Return the names that are given, or others."""
    if labels is None:
        return otherwise
    if isinstance(labels, str):
        given = [labels]
    elif isinstance(labels, Sequence) and all(isinstance(each, str) for each in labels):
        given = list(labels)
    else:
        raise OptipathError(f"labels are {shown(labels)}; give a text for each light")
    if len(given) != count:
        raise OptipathError(f"there are {len(given)} labels for {count} lights; give one for each")
    if len({*given}) < count:
        raise OptipathError(f"labels {shown(given)} name two lights alike; give each its own")
    return given

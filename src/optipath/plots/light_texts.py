"""The lights of a picture: names, states in words, points of ellipses."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.path_values import Values
from optipath.errors import OptipathError, PathError
from optipath.faults import listed, shown
from optipath.light.light import Light
from optipath.paths.energy import lights_along
from optipath.paths.path_graph import PathGraph
from optipath.values.jax_values import check_known

if TYPE_CHECKING:
    from optipath.paths.energy import LightOnLink
    from optipath.values.precision import Numbers


MOST = 6
"""How many lights are told apart beside one another, of which each has a colour of `LINES`."""


def known_light(light: Any) -> Light:
    """Return what is a light, with numbers that are known."""
    if not isinstance(light, Light):
        raise OptipathError(f"{shown(light)} is no light; give a Light, as path.trace() returns it")
    check_known("a picture of light", light.stokes)
    return light


def lights_of_one(
    path: Any, what: str, values: Mapping[str, Any], lights: Sequence[LightOnLink] = ()
) -> Sequence[LightOnLink]:
    """Return the light on the links of a path, if it is not known; refuse a batch."""
    if not isinstance(path, PathGraph):
        raise OptipathError(f"{what} draws a path, not {shown(path)}; give a PathGraph")
    lights = lights or lights_along(path, **values)
    shapes = Values(path.graph).known_shapes | {n: np.shape(v) for n, v in values.items()}
    shapes |= {each.name: known_light(each.light).shape for each in lights}
    for name, shape in shapes.items():
        if shape:
            raise PathError(
                f"{what} draws one path, but {name} has the shape {shape}; give single values"
            )
    return lights


def lights_to_draw(light: Any, labels: Any = None) -> dict[str, Light]:
    """Return one or several lights by their names."""
    several: dict[str, Light] = {}
    if isinstance(light, Mapping):
        if labels is not None:
            raise OptipathError("labels are for a batch; a mapping has names already")
        several = {str(name): known_light(each) for name, each in light.items()}
        if batches := [name for name, each in several.items() if each.shape]:
            name, shape = batches[0], several[batches[0]].shape
            raise OptipathError(
                f"light {shown(name)} is a batch of shape {shape}; give one of it by its index"
            )
    elif known_light(light).ndim > 1:
        raise OptipathError(
            f"light of shape {light.shape} is more than a row; give one row, or light.reshape(n)"
        )
    count = len(light) if isinstance(light, Mapping) else light.size
    if not 0 < count <= MOST:
        raise OptipathError(
            f"{count} lights are not drawn in one picture; give 1 to {MOST}, such as light[:{MOST}]"
        )
    if isinstance(light, Mapping):
        return several
    names = [f"light[{place}]" for place in range(count)] if light.ndim else [""]
    if labels is not None:
        names = [labels] if isinstance(labels, str) else labels
        are_texts = isinstance(names, Sequence) and all(isinstance(each, str) for each in names)
        if not are_texts or not len(names) == len({*names}) == count:
            raise OptipathError(
                f"labels are {shown(labels)}; give {count} texts, one for each light, all different"
            )
    return dict(zip(names, light if light.ndim else [light], strict=True))


_MINUS = "\N{MINUS SIGN}"


def digits(value: float, count: int = 4) -> str:
    """Return a number as a picture shows it.

    >>> digits(0.25), digits(2e200), digits(0.1 + 0.2), digits(-0.0)
    ('0.25', '2e200', '0.3', '0')
    """
    mantissa, mark, power = f"{value + 0.0:.{count}g}".partition("e")
    return (mantissa + (f"e{int(power)}" if mark else "")).replace("-", _MINUS)


def intensity_text(light: Light) -> str:
    """Return the intensity of one light."""
    intensity = float(light.intensity)
    return "S0 is not read" if np.isnan(intensity) else f"S0 = {digits(intensity)}"


def no_ellipse(light: Light) -> str:
    """Return why one light has no ellipse; nothing where it has one."""
    numbers = np.asarray(light.stokes, float)
    if unread := [f"S{place}" for place in range(4) if np.isnan(numbers[place])]:
        return f"{listed(unread)} {'is' if len(unread) == 1 else 'are'} not read"
    if not np.isfinite(numbers).all():
        return "not finite"
    if numbers[0] < 0.0:
        return "no light: S0 is negative"
    if np.isnan(light.dop):
        return "dark" if numbers[0] == 0.0 else "dark: S0 is no more than rounding"
    return "unpolarised" if np.isnan(light.ellipticity_angle) else ""


def state_text(light: Light) -> str:
    """Return the state of polarisation of one light, its hand as `Light.handedness` has it.

    >>> import optipath as op
    >>> state_text(op.Light([1.0, 0.0, 0.6, 0.8])), state_text(op.Light([1.0, 0.0, 0.0, -1.0]))
    ('right-handed elliptical', 'left-handed circular')
    >>> state_text(op.Light([1.0, 0.5, 0.0, 0.0])), state_text(op.Light([1.0, 0.0, 0.0, 0.0]))
    ('linear', 'unpolarised')
    """
    if why := no_ellipse(light):
        return why
    if not light.handedness:
        return "linear"
    hand = "right" if light.handedness > 0 else "left"
    return f"{hand}-handed {'circular' if np.isnan(light.aop) else 'elliptical'}"


def figures_text(light: Light) -> str:
    """Return the figures that one light has: intensity, DoP, AoP and the ratio of its axes."""
    messages = [intensity_text(light)]
    if not np.isnan(light.dop):
        messages.append(f"DoP = {digits(float(light.dop))}")
    if not np.isnan(light.aop):
        messages.append(f"AoP = {angle_text(light)}")
    if light.handedness and not no_ellipse(light):
        messages.append(f"b/a = {digits(abs(float(light.ellipticity)), 3)}")
    return ", ".join(messages)


def angle_text(light: Light) -> str:
    """Return the angle of polarisation of one light in degrees."""
    return f"{digits(np.degrees(float(light.aop)))}°"


def ellipse_points(light: Light, count: int = 73) -> Numbers:
    """Return points (..., count, 2) of the ellipse of the polarized part, in order of time.

    >>> import optipath as op
    >>> ellipse_points(op.Light([1.0, 0.0, 0.0, 1.0]), 5).round(4) + 0.0
    array([[ 0.7071,  0.    ],
           [ 0.    ,  0.7071],
           [-0.7071,  0.    ],
           [ 0.    , -0.7071],
           [ 0.7071,  0.    ]])
    """
    time = np.linspace(0.0, 2.0 * np.pi, count)
    open_angle = np.asarray(light.ellipticity_angle, float)[..., np.newaxis]
    # Circular light has no axis; any will do.
    angle = np.nan_to_num(np.asarray(light.aop, float))[..., np.newaxis]
    along, across = np.cos(open_angle) * np.cos(time), np.sin(open_angle) * np.sin(time)
    cosine, sine = np.cos(angle), np.sin(angle)
    return np.stack([along * cosine - across * sine, along * sine + across * cosine], axis=-1)

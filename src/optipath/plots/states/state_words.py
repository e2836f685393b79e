"""What a picture says of light in words: its state, its intensity, its figures."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from optipath.errors import listed

if TYPE_CHECKING:
    from optipath.light.light import Light


_MINUS = "\N{MINUS SIGN}"


def digits(value: float, count: int = 4) -> str:
    """Return a number as a picture shows it.

    Examples
    --------
    >>> digits(0.25), digits(2e200), digits(0.1 + 0.2), digits(-0.0)
    ('0.25', '2e200', '0.3', '0')
    """
    text = f"{value + 0.0:.{count}g}"
    mantissa, mark, power = text.partition("e")
    return (mantissa + (f"e{int(power)}" if mark else "")).replace("-", _MINUS)


def intensity_text(light: Light) -> str:
    """Return the intensity of one light, however faint.

    Examples
    --------
    >>> import optipath as op
    >>> intensity_text(op.Light([0.5, 0.0, 0.0, 0.0]))
    'S0 = 0.5'
    >>> intensity_text(op.Light([1.0, 0.0, 0.0, 0.0], exponent=33219281))
    'S0 = 10^1e7'
    """
    plain, power = float(light.intensity), float(light.log10_intensity)
    # An exponent says that a float is no measure of it.
    if light.exponent and np.isfinite(power):
        return f"S0 = 10^{digits(power, 7)}"
    return f"S0 = {digits(plain)}" if not np.isnan(plain) else "S0 is not read"


def no_ellipse(light: Light) -> str:
    """Return why one light has no ellipse; nothing where it has one.

    Examples
    --------
    >>> import optipath as op
    >>> no_ellipse(op.Light([1.0, 0.0, 0.0, 0.0])), no_ellipse(op.Light([0.0, 0.0, 0.0, 0.0]))
    ('unpolarised', 'dark')
    >>> no_ellipse(op.Light([1.0, np.nan, np.nan, np.nan]))
    'S1, S2 and S3 are not read'
    """
    numbers = np.asarray(light.mantissa, float)
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

    Examples
    --------
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
    """Return the figures that one light has: intensity, DoP, AoP and the ratio of its axes.

    Examples
    --------
    >>> import optipath as op
    >>> figures_text(op.Light([2.0, 0.0, 0.6, 0.8]))
    'S0 = 2, DoP = 0.5, AoP = 45°, b/a = 0.5'
    """
    told = [intensity_text(light)]
    if not np.isnan(light.dop):
        told.append(f"DoP = {digits(float(light.dop))}")
    if not np.isnan(light.aop):
        told.append(f"AoP = {angle_text(light)}")
    if light.handedness and not no_ellipse(light):
        told.append(f"b/a = {digits(abs(float(light.ellipticity)), 3)}")
    return ", ".join(told)


def angle_text(light: Light) -> str:
    """Return the angle of polarisation of one light in degrees.

    Examples
    --------
    >>> import optipath as op
    >>> angle_text(op.Light([1.0, 0.0, 1.0, 0.0]))
    '45°'
    """
    return f"{digits(np.degrees(float(light.aop)))}°"

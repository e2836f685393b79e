"""Color: tristimulus values of spectral light and sRGB, by CIE 1931 and IEC 61966-2-1."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, TypeAlias, get_args

import numpy as np

from optipath.errors import ColourWarning, LightError, ValueFault
from optipath.faults import shown, unknown
from optipath.light.integration import spectral_axis, weighted_sum
from optipath.light.light import Light
from optipath.materials.illuminants import LUMENS_PER_WATT, NANOMETRES, Observer, observer_called
from optipath.materials.spectrum import Spectrum
from optipath.values.angles import warn
from optipath.values.arrays import Unchanging, check_broadcast, locked, same
from optipath.values.curve_value import CurveValue
from optipath.values.jax_values import check_known, is_traced, known, namespace

if TYPE_CHECKING:
    from optipath.values.precision import Array


FROM_XYZ = np.array(
    [[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]]
)
"""IEC 61966-2-1:1999, equation 7."""

_LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
"""What red, green and blue add to Y; equation 2."""

_WHITE = "give white=, the light without the sample, or op.Spectrum.illuminant('D65')"

Standard: TypeAlias = Literal["CIE 1931 2 deg"]
Beyond: TypeAlias = Literal["dark", "nearest"]
OutOfGamut: TypeAlias = Literal["refuse", "clip", "scale", "keep"]

_STEP = 0.5 / 255
"""Half of a step of eight bits, by which no display differs."""


class Srgb(Unchanging):
    """Colours for a display of sRGB.

    Parameters
    ----------
    linear : ndarray, shape (..., 3)
        Red, green and blue as powers of light, as they come out, in gamut or not.
    shown : ndarray, shape (..., 3)
        The same within 0 .. 1, or what is kept beyond.

    Attributes
    ----------
    linear : ndarray, shape (..., 3)
        As given.
    values : ndarray, shape (..., 3)
        Red, green and blue with the transfer function of sRGB, 0 .. 1.

    Examples
    --------
    >>> grey = Srgb(np.full(3, 0.2), np.full(3, 0.2))
    >>> grey.values.round(4), grey.hex, bool(grey.outside)
    (array([0.4845, 0.4845, 0.4845]), '#7c7c7c', False)
    """

    linear: Array
    values: Array

    def __init__(self, linear: Any, shown: Any) -> None:
        vars(self).update(linear=locked(linear), values=locked(encoded(shown)))

    @property
    def beyond(self) -> Array:
        """How far out of gamut the colours are, of shape (...).

        The most that one of red, green and blue is beyond 0 .. 1, with the transfer function of
        sRGB; less than half of a step of eight bits is no more than rounding.
        """
        xp = namespace(self.linear)
        result = encoded(self.linear)
        return xp.max(xp.maximum(result - 1.0, xp.maximum(-result, 0.0)), axis=-1)  # type: ignore[no-any-return]

    @property
    def outside(self) -> Array:
        """Which colours a display of sRGB cannot show, of shape (...)."""
        return self.beyond > _STEP

    @property
    def hex(self) -> Any:
        """The colour as in ``"#ffd700"``; nested lists of them for several."""
        check_known("a colour in letters", self.values)
        bytes_ = np.rint(255 * np.clip(known(self.values), 0.0, 1.0)).astype(int)
        text = np.array(["#{:02x}{:02x}{:02x}".format(*one) for one in bytes_.reshape(-1, 3)])
        return text.reshape(bytes_.shape[:-1]).tolist()

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Array:  # noqa: FBT001 - NumPy's
        return np.array(known(self.values), dtype=dtype, copy=copy)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Srgb):
            return NotImplemented
        return same(self.linear, other.linear) and same(self.values, other.values)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"Srgb({self.values!r})"


def srgb_of(
    light: Light, white: Any, seen: tuple[str, str], *, adapt: bool, out_of_gamut: str
) -> Srgb:
    """Return the colour of light; see `Light.to_srgb`."""
    faults = unknown("out_of_gamut", out_of_gamut, get_args(OutOfGamut))
    if white is None:
        faults.append(f"a colour is relative to what is white; {_WHITE}")
    if not isinstance(adapt, (bool, np.bool_)):
        faults.append(f"adapt is True or False, not {shown(adapt)}")
    ValueFault.raise_for(faults)
    observer, outside = seen
    xyz = tristimulus(light, white, observer, outside)
    if adapt:
        xyz = adapted(xyz, white_sums(light, white, observer_called(observer), outside))
    linear = times(FROM_XYZ, xyz)
    result = Srgb(linear, linear)
    if out_of_gamut == "keep":
        return result
    if out_of_gamut == "refuse":
        _refuse(result)
    scales = out_of_gamut == "scale"
    return Srgb(linear, _scaled(linear) if scales else namespace(linear).clip(linear, 0.0, 1.0))


def encoded(linear: Any) -> Any:
    """Return components with the transfer function of sRGB; negative ones as positive ones."""
    xp = namespace(linear)
    size = xp.abs(linear)
    bright = size > 0.0031308
    curved = 1.055 * xp.where(bright, size, 1.0) ** (1.0 / 2.4) - 0.055
    return xp.where(bright, xp.where(linear < 0.0, -curved, curved), 12.92 * linear)


def _scaled(linear: Any) -> Any:
    """Return colours mixed with grey of the same luminance, then dimmed, until all is within."""
    xp = namespace(linear)
    grey = xp.maximum((linear * _LUMINANCE).sum(axis=-1, keepdims=True), 0.0)
    least = linear.min(axis=-1, keepdims=True)
    below = least < 0.0
    share = xp.where(below, grey / xp.where(below, grey - least, 1.0), 1.0)
    mixed = xp.maximum(grey + share * (linear - grey), 0.0)
    return mixed / xp.maximum(mixed.max(axis=-1, keepdims=True), 1.0)


_GAMUT_CURE = "write out_of_gamut='clip', 'scale' or 'keep'"


def _refuse(colour: Srgb) -> None:
    """Refuse colours that a display cannot show, saying how many and how far."""
    if is_traced(colour.linear):
        raise ValueFault(
            f"whether colours that JAX traces are in gamut is not known; {_GAMUT_CURE}"
        )
    outside = np.atleast_1d(colour.outside)
    if not outside.any():
        return
    brightest = float(np.max(colour.linear))
    too = f" (a component up to {brightest:.3g} times that of white)" * (brightest > 1.0)
    raise ValueFault(
        f"{outside.sum()} of {outside.size} colours are out of the gamut of sRGB, by up to "
        f"{float(np.max(colour.beyond)):.3g} of its range{too}; {_GAMUT_CURE}"
    )


_VISIBLE = (380.0, 780.0)
_COARSE = 20.0
"""Nanometres between wavelengths, above which colours of smooth spectra are seen to be off."""

_ROUNDING = 1e-6


def tristimulus(light: Light, white: Any, observer: str, outside: str) -> Array:
    """Return X, Y and Z of spectral light; see `Light.to_xyz`. Shape: returns (..., 3)."""
    standard = observer_called(observer)
    total = _sums(light, standard, outside)
    warn_of(light, standard, outside)
    if white is None:
        return LUMENS_PER_WATT * total  # type: ignore[no-any-return]
    of_white = white_sums(light, white, standard, outside)
    check_broadcast({"light": total.shape[:-1], "white": of_white.shape[:-1]})
    return total / of_white[..., 1:2]  # type: ignore[no-any-return]


def white_sums(light: Light, white: Any, observer: Observer, outside: str) -> Any:
    """Return X, Y and Z (..., 3) of white."""
    if isinstance(white, Light):
        total = _sums(white, observer, outside)
    elif isinstance(white, (Spectrum, CurveValue)):
        grid, _ = spectral_axis(light)
        values = np.asarray(white.at(grid), np.float64)[:, np.newaxis]
        total = weighted_sum(values, _weights(grid, observer, outside), 0)
    else:
        raise ValueFault(f"white is {shown(white)}, which has no spectrum; {_WHITE}")
    if not is_traced(total) and not np.all(total[..., 1] > 0.0):
        raise ValueFault("white is dark (Y = 0), and nothing is relative to that")
    return total


def _sums(light: Light, observer: Observer, outside: str) -> Any:
    """Return X, Y and Z (..., 3) as sums over the wavelengths."""
    grid, axis = spectral_axis(light)
    weights = _weights(grid, observer, outside)
    return weighted_sum(known(light.stokes)[..., :1], weights, axis)


def _weights(grid: Array, observer: Observer, outside: str) -> Array:
    """Return what each wavelength adds to X, Y and Z, in the order of the grid."""
    ValueFault.raise_for(unknown("outside", outside, get_args(Beyond)))
    rises = grid[-1] > grid[0]
    rising = NANOMETRES * (grid if rises else grid[::-1])
    weights = observer.weights(rising, nearest=outside == "nearest")
    return weights if rises else weights[::-1]


def warn_of(light: Light, observer: Observer, outside: str) -> None:
    """Say what colour loses by wavelengths that are few, or end within what is seen."""
    grid = np.sort(spectral_axis(light)[0]) * NANOMETRES
    first, last = grid[[0, -1]]
    if last < _VISIBLE[0] or first > _VISIBLE[1]:
        light_of = f"light of {first:.6g} nm .. {last:.6g} nm"
        raise LightError(f"{light_of} is not seen; give wavelengths within 380 nm .. 780 nm")
    ends_within = first > _VISIBLE[0] + _ROUNDING or last < _VISIBLE[1] - _ROUNDING
    if ends_within and outside == "dark":
        warn(
            f"the light is known from {first:.6g} nm to {last:.6g} nm, and taken for dark "
            f"beyond, where white light has up to {100 * observer.left_out(grid):.3g} % of its X, "
            f"Y or Z; compute it from 380 nm to 780 nm, or write outside='nearest'",
            ColourWarning,
        )
    inside = grid[(grid >= _VISIBLE[0]) & (grid <= _VISIBLE[1])]
    widest = np.max(np.diff(inside if len(inside) > 1 else grid))
    if widest > _COARSE + _ROUNDING:
        warn(
            f"wavelengths are {widest:.6g} nm apart, and the light is linear between them: what "
            f"is narrower is not seen, and colours may be off by some per cent; take 5 nm",
            ColourWarning,
        )


BRADFORD = np.array(
    [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]]
)
"""From X, Y, Z to responses of cones: the linear Bradford transform of ICC.1:2022, annex E."""

DISPLAY_WHITE = np.array([0.3127, 0.3290, 0.3583]) / 0.3290
"""X, Y, Z of the white of sRGB, which is D65, x = 0.3127 and y = 0.3290 (IEC 61966-2-1)."""


def adapted(xyz: Any, white: Any) -> Any:
    """Return X, Y, Z (..., 3) as they are under the white of a display."""
    before = times(BRADFORD, white / white[..., 1:2])
    gain = times(BRADFORD, DISPLAY_WHITE) / before
    return times(np.linalg.inv(BRADFORD), gain * times(BRADFORD, xyz))


def times(matrix: Any, vectors: Any) -> Any:
    """Return products (..., 3) in an order that does not depend on how many there are."""
    xp = namespace(vectors)
    parts = [vectors[..., place, np.newaxis] * matrix[:, place] for place in range(3)]
    return xp.asarray(parts[0] + parts[1] + parts[2])

"""sRGB: colours of a display, by IEC 61966-2-1."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ValueFault, shown, unknown
from optipath.light.colour.adaptation import adapted
from optipath.light.colour.observer import observer_called
from optipath.light.colour.triples import times
from optipath.light.colour.tristimulus import tristimulus, white_sums
from optipath.values.arrays.jax_values import check_known, is_traced, known, namespace
from optipath.values.arrays.read_only import Unchanging, locked, same

if TYPE_CHECKING:
    from optipath.light.light import Light
    from optipath.values.roundings import Array

FROM_XYZ = np.array(
    [[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]]
)
"""IEC 61966-2-1:1999, equation 7."""

_LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
"""What red, green and blue add to Y; equation 2."""

OUT_OF_GAMUT = ("refuse", "clip", "scale", "keep")

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
        found = encoded(self.linear)
        return xp.max(xp.maximum(found - 1.0, xp.maximum(-found, 0.0)), axis=-1)  # type: ignore[no-any-return]

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
    light: Light,
    white: Any,
    seen: tuple[str, str],
    *,
    adapt: bool,
    out_of_gamut: str,
) -> Srgb:
    """Return the colour of light; see `Light.to_srgb`."""
    faults = unknown("out_of_gamut", out_of_gamut, OUT_OF_GAMUT)
    if white is None:
        faults.append(
            "a colour is relative to what is white; write white=..., the light of the same path "
            "without the sample, or op.Spectrum.illuminant('D65')"
        )
    if not isinstance(adapt, (bool, np.bool_)):
        faults.append(f"adapt is True or False, not {shown(adapt)}")
    if faults:
        raise ValueFault(*faults)
    observer, outside = seen
    xyz = tristimulus(light, white, observer, outside)
    if adapt:
        xyz = adapted(xyz, white_sums(light, white, observer_called(observer), outside)[0])
    linear = times(FROM_XYZ, xyz)
    found = Srgb(linear, linear)
    if out_of_gamut == "keep":
        return found
    if out_of_gamut == "scale":
        linear_in_gamut = _scaled(linear)
    else:
        linear_in_gamut = namespace(linear).clip(linear, 0.0, 1.0)
    if out_of_gamut == "refuse":
        _refuse(found)
    return Srgb(linear, linear_in_gamut)


def encoded(linear: Any) -> Any:
    """Return components with the transfer function of sRGB; negative ones as positive ones.

    Examples
    --------
    >>> encoded(np.array([0.0, 0.0031308, 0.5, 1.0])).round(4)
    array([0.    , 0.0404, 0.7354, 1.    ])
    """
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


def _refuse(colour: Srgb) -> None:
    """Refuse colours that a display cannot show, saying how many and how far."""
    if is_traced(colour.linear):
        raise ValueFault(
            "whether colours that JAX traces are in gamut is not known; write "
            "out_of_gamut='clip', 'scale' or 'keep'"
        )
    outside = np.atleast_1d(colour.outside)
    if not outside.any():
        return
    farthest = float(np.max(colour.beyond))
    brightest = float(np.max(colour.linear))
    which = (
        "the colour is" if outside.size == 1 else f"{outside.sum()} of {outside.size} colours are"
    )
    too = f" (a component up to {brightest:.3g} times that of white)" * (brightest > 1.0)
    raise ValueFault(
        f"{which} out of the gamut of sRGB, by up to {farthest:.3g} of its range{too}; "
        f"write out_of_gamut='clip', 'scale' or 'keep'"
    )

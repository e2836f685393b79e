"""Reflection curves over the incidence, with Brewster's and critical angles."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.elements.fresnel import fresnel_reflection
from optipath.errors import OptipathError
from optipath.faults import shown
from optipath.materials.index_domains import INDEX
from optipath.materials.material import Material
from optipath.plots.axes import own_axes
from optipath.plots.colors import DASHES, FAINT, INK, LINES
from optipath.plots.text import head, key_within, label_axes
from optipath.values.curve_value import CurveValue
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Callable

    from matplotlib.axes import Axes

    from optipath.values.precision import Numbers


_SIZE = 6.4, 4.4
_COUNT = 901
_NAMES = "$R_s$", "$R_p$", "$R$ unpolarised", "DoLP"


def reflection(
    index: Any, ax: Axes | None = None, *, outside: Any = 1.0, wavelength: Any = None
) -> Axes:
    """Draw what a boundary reflects of light from one side, against the angle of incidence.

    The reflectances of s, of p and of light without polarisation, and the degree of linear
    polarisation of the last one, by Fresnel's equations. Marked are Brewster's angle and the
    critical one; for what absorbs, the angle at which least of p is reflected and that of the
    highest degree of polarisation.

    Parameters
    ----------
    index : float, complex, str or Material
        Of the medium behind; n + ik, or the name of a material, such as ``"gold"``.
    ax : Axes, optional
        Where; a figure of its own by default, ``.figure`` of what is returned.
    outside : float, str or Material, optional
        The index of the medium in front, which does not absorb; a k below 1e-5 n is left out.
    wavelength : float or str, optional
        In vacuum, in metres or with a unit; needed where an index depends on it, and only there.

    Returns
    -------
    Axes

    Examples
    --------
    >>> ax = reflection("gold", wavelength="516 nm")
    >>> [text.get_text() for text in ax.get_legend().get_texts()][-2:]
    ['pseudo-Brewster angle 62.01°', 'highest DoLP 67.41°']
    """
    behind, front, message = _indices(index, outside, wavelength)
    ratio = behind / front
    ax = own_axes(ax, _SIZE)
    incidence = np.linspace(0.0, np.pi / 2, _COUNT)
    curves = reflected(ratio, incidence)
    lines: list[Any] = []
    for place, (name, values) in enumerate(zip(_NAMES, curves, strict=True)):
        colour, dash = LINES[place], DASHES[place]
        lines += ax.plot(np.degrees(incidence), values, color=colour, linestyle=dash, label=name)
    looks = (INK, ":"), (FAINT, "-.")
    for (name, angle), (colour, dash) in zip(marked_angles(ratio).items(), looks, strict=False):
        degrees = float(np.degrees(angle))
        style: dict[str, Any] = {"color": colour, "linestyle": dash, "zorder": 1.0}
        lines.append(ax.axvline(degrees, label=f"{name} {degrees:.2f}°", **style))
    ax.set(xlim=(0.0, 90.0), ylim=(-0.02, 1.02))
    ax.set_xticks(range(0, 91, 15))
    ax.grid(visible=True, alpha=0.3)
    label_axes(ax, "angle of incidence (°)", "reflectance, degree of polarisation")
    head(ax, message)
    key_within([ax], lines)
    return ax


def _indices(index: Any, outside: Any, wavelength: Any) -> tuple[complex, float, str]:
    """Return the index behind, that in front, and a title that says both."""
    arguments = {"index": index, "outside": outside}
    media = {name: _medium(name, one) for name, one in arguments.items()}
    depending = [n for n, one in media.items() if CurveValue in (type(one.n), type(one.k))]
    if depending and wavelength is None:
        raise OptipathError(
            f"{depending[0]} {shown(arguments[depending[0]])} depends on the wavelength; give one, "
            f"such as wavelength='550 nm'"
        )
    if wavelength is not None and not depending:
        raise OptipathError(
            f"wavelength is {shown(wavelength)}, and no index depends on it; leave it out"
        )
    numbers = [np.asarray(one.at(wavelength).refractive_index) for one in media.values()]
    for number, (name, argument) in zip(numbers, arguments.items(), strict=True):
        if number.ndim:
            raise OptipathError(
                f"{name} {shown(argument)} has the shape {number.shape}; a picture is of one index"
            )
    behind, front = map(complex, numbers)
    if front.imag <= CLEAR * front.real:
        front = complex(front.real)
    if front.imag or not front.real:
        raise OptipathError(
            f"outside is {_written(front)}; give the index of a clear medium, n above 0"
        )
    if behind == front:
        raise OptipathError(f"index and outside are both {_written(front)}; nothing is reflected")
    parameter, messages = Wavelength(), []
    texts = _distinguished(behind, front)
    for text, (name, argument) in zip(texts, arguments.items(), strict=True):
        known = f"{argument.strip()}" if _is_name(argument) else ""
        if known and name in depending:
            known += f" at {parameter.text(float(parameter.resolve(wavelength).value))}"
        messages.append(f"{known}, n = {text}" if known else f"n = {text}")
    return behind, front.real, f"reflection: {' in '.join(messages)}"


def _medium(name: str, argument: Any) -> Material:
    """Return the medium that an index, a name or a material stands for."""
    if isinstance(argument, Material):
        return argument
    if _is_name(argument):
        return Material.named(argument)
    number = INDEX.check(name, argument)
    return Material(number.real.copy(), number.imag.copy())


def _is_name(argument: Any) -> bool:
    return isinstance(argument, str) and argument.strip()[:1].isalpha()


def _distinguished(behind: complex, front: complex) -> tuple[str, str]:
    """Return two indices with as many digits as it takes to tell one from the other.

    >>> _distinguished(1.5, 1.0), _distinguished(1.00001, 1.0)
    (('1.5', '1'), ('1.00001', '1'))
    """
    for digits in range(4, 18):
        messages = _written(behind, digits), _written(front, digits)
        if messages[0] != messages[1]:
            break
    return messages


def _written(index: complex, digits: int = 4) -> str:
    n = f"{index.real:.{digits}g}"
    return f"{n} + {index.imag:.{digits}g}i" if index.imag else n


CLEAR = 1e-5
"""Below which k over n a medium is as one that does not absorb: angles are the same to 1e-9."""

_POINTS, _ROUNDS = 1001, 5
_SEEN = 1e-9
"""By how much a least reflectance lies below that at normal incidence, if there is one."""


class Reflected(NamedTuple):
    """The reflectances of a boundary for unpolarized light."""

    s: Numbers
    p: Numbers
    unpolarised: Numbers
    dolp: Numbers


def reflected(index: complex, incidence: Numbers) -> Reflected:
    """Return what a boundary reflects at an incidence in radians."""
    mean, half, _, _ = fresnel_reflection(index, np.cos(incidence), np.sin(incidence))
    with np.errstate(invalid="ignore", divide="ignore"):
        dolp = np.abs(half) / np.where(mean > 0.0, mean, np.nan)
    return Reflected(mean + half, mean - half, mean, dolp)


def marked_angles(index: complex) -> dict[str, float]:
    """Return the angles of a reflection that have names, in radians."""
    n = index.real
    if index == 1.0:
        return {}
    if index.imag <= CLEAR * n:
        brewster = {"Brewster's angle": float(np.arctan(n))}
        return brewster | ({"critical angle": float(np.arcsin(n))} if n < 1.0 else {})
    least = _least(lambda incidence: reflected(index, incidence).p)
    most = _least(lambda incidence: -reflected(index, incidence).dolp)
    upright, there = reflected(index, np.array([0.0, least])).p
    if not there < upright - _SEEN:
        return {}
    return {"pseudo-Brewster angle": least, "highest DoLP": most}


def _least(of: Callable[[Numbers], Numbers]) -> float:
    """Return between 0 and a right angle where a smooth function is least, by ever finer grids."""
    low, high = 0.0, np.pi / 2
    best = low
    for _ in range(_ROUNDS):
        grid = np.linspace(low, high, _POINTS)
        best = float(grid[np.nanargmin(of(grid))])
        step = float(grid[1] - grid[0])
        low, high = max(0.0, best - step), min(np.pi / 2, best + step)
    return best

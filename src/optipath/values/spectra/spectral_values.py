"""What spectra are made of: wavelengths, and numbers that are not negative."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ValueFault, shown
from optipath.values.curves.wavelength_range import WavelengthRange
from optipath.values.domains.quantities import NON_NEGATIVE
from optipath.values.domains.wavelengths import LONGEST, WAVELENGTH
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from optipath.values.curves.curve import Curve
    from optipath.values.domains.domain import Domain
    from optipath.values.spectra.spectrum_kind import SpectrumKind

    Array = np.ndarray[Any, Any]

LENGTH_CURE = "for nanometres write '{0:g} nm', or {0:g}e-9"


def one_number(owner: str, value: Any, domain: Domain = NON_NEGATIVE) -> float:
    """Return one number of a spectrum.

    Examples
    --------
    >>> one_number("power of a line", 2)
    2.0
    """
    array = several_numbers(owner, value, domain)
    if array.ndim:
        raise ValueFault(f"{owner} must be one number, not an array of shape {array.shape}")
    return float(array)


def several_numbers(owner: str, value: Any, domain: Domain = NON_NEGATIVE) -> Array:
    """Return numbers of a spectrum."""
    if isinstance(value, Parameter):
        raise ValueFault(
            f"{owner} cannot be the parameter '{value.name}'; give a number here, and a parameter "
            f"to Source(intensity=...), which a spectrum is multiplied by"
        )
    try:
        array = domain.check(owner, value)
        return np.array(array, np.float64)
    except (TypeError, ValueError):
        raise ValueFault(f"{owner} must be {domain.described()}, not {shown(value)}") from None


def some_wavelengths(owner: str, value: Any) -> Array:
    """Return wavelengths in metres, of numbers in metres or of texts.

    Examples
    --------
    >>> some_wavelengths("a grid", ["500 nm", "2.4 eV"]).round(10)
    array([5.000e-07, 5.166e-07])
    """
    array = several_numbers(owner, value, WAVELENGTH)
    refuse_longest(owner, array)
    return array


def refuse_longest(owner: str, metres: Any) -> None:
    """Raise where lengths are so large that they must be in another unit."""
    if np.size(metres) and (longest := float(np.max(metres))) > LONGEST:
        raise ValueFault(
            f"{owner} is {longest:g} metres, which is no wavelength of light; "
            f"{LENGTH_CURE.format(longest)}"
        )


def one_wavelength(owner: str, value: Any) -> float:
    """Return one wavelength in metres.

    Examples
    --------
    >>> one_wavelength("a line", "633 nm")
    6.33e-07
    """
    array = some_wavelengths(owner, value)
    if array.ndim:
        raise ValueFault(f"{owner} must be one wavelength, not an array of shape {array.shape}")
    return float(array)


def rising_edges(owner: str, value: Any) -> tuple[Array, bool]:
    """Return the edges of bins in metres, rising, and whether they were given falling.

    Shape: returns edges (n + 1,).
    """
    edges = some_wavelengths(owner, value)
    if edges.ndim != 1 or edges.size < 2:
        raise ValueFault(
            f"{owner} must be a row of two wavelengths or more, not of shape {edges.shape}"
        )
    steps = np.diff(edges)
    turned = bool(steps[0] < 0.0)
    if not np.all(steps < 0.0 if turned else steps > 0.0):
        raise ValueFault(f"{owner} neither rise nor fall throughout; sort them, each once")
    return (edges[::-1].copy() if turned else edges), turned


def value_outside(owner: str, outside: Any) -> float | None:
    """Return what a spectrum is beyond what it is known for; None where nobody says."""
    if outside is None:
        return None
    if np.ndim(outside) == 0 and not isinstance(outside, (str, bool)) and outside == 0.0:
        return 0.0
    raise ValueFault(
        f"outside of {owner} is {shown(outside)}; give 0.0 where nothing is there, or leave it out "
        f"(of samples 'nearest' and 'linear' may be given, too)"
    )


def values_at(kind: SpectrumKind, wavelengths: Array) -> Array:
    """Return what a spectrum is at wavelengths, lines aside.

    Units: wavelengths in metres.
    """
    check_known_at(kind, wavelengths)
    row = np.ascontiguousarray(wavelengths, np.float64).reshape(-1)
    with np.errstate(all="ignore"):
        return np.asarray(kind.density(np, row)).reshape(np.shape(wavelengths))


def check_known_at(kind: SpectrumKind | Curve, wavelengths: Array) -> None:
    """Raise where a spectrum is not known.

    Units: wavelengths in metres.
    """
    low, high = kind.span
    known = WavelengthRange("wavelength", "length", low, high, label=kind.label, beyond=kind.beyond)
    known.check("a wavelength", wavelengths)

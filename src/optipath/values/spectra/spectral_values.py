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

    Parameters
    ----------
    owner : str
        What has it, as sentences name it.
    value : Any
        What is given.
    domain : Domain, optional
        What it may be.

    Returns
    -------
    float

    Raises
    ------
    ValueFault
        If it is none.

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
    """Return numbers of a spectrum.

    Parameters
    ----------
    owner : str
        What has them, as sentences name it.
    value : Any
        What is given.
    domain : Domain, optional
        What they may be.

    Returns
    -------
    ndarray
        A copy.

    Raises
    ------
    ValueFault
        If they are none.
    """
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

    Parameters
    ----------
    owner : str
        What has them, as sentences name it.
    value : Any
        What is given.

    Returns
    -------
    ndarray

    Raises
    ------
    ValueFault
        If they are none, or so large that they must be in another unit.

    Examples
    --------
    >>> some_wavelengths("a grid", ["500 nm", "2.4 eV"]).round(10)
    array([5.000e-07, 5.166e-07])
    """
    array = several_numbers(owner, value, WAVELENGTH)
    refuse_longest(owner, array)
    return array


def refuse_longest(owner: str, metres: Any) -> None:
    """Raise where lengths are so large that they must be in another unit.

    Parameters
    ----------
    owner : str
        What has them, as sentences name it.
    metres : array_like
        The lengths.

    Raises
    ------
    ValueFault
        Saying how they are written.
    """
    if np.size(metres) and (longest := float(np.max(metres))) > LONGEST:
        raise ValueFault(
            f"{owner} is {longest:g} metres, which is no wavelength of light; "
            f"{LENGTH_CURE.format(longest)}"
        )


def one_wavelength(owner: str, value: Any) -> float:
    """Return one wavelength in metres.

    Parameters
    ----------
    owner, value
        As `some_wavelengths` takes them.

    Returns
    -------
    float

    Raises
    ------
    ValueFault
        As `some_wavelengths` does, and of several.

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

    Parameters
    ----------
    owner : str
        What has them, as sentences name it.
    value : Any
        What is given.

    Returns
    -------
    edges : ndarray, shape (n + 1,)
    turned : bool

    Raises
    ------
    ValueFault
        If they are no edges of bins.
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
    """Return what a spectrum is beyond what it is known for; None where nobody says.

    Parameters
    ----------
    owner : str
        The spectrum, as sentences name it.
    outside : Any
        What is given.

    Returns
    -------
    float or None

    Raises
    ------
    ValueFault
        If it is something else than 0.
    """
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

    Parameters
    ----------
    kind : SpectrumKind
        The spectrum.
    wavelengths : ndarray
        In metres.

    Returns
    -------
    ndarray
        Of the same shape.

    Raises
    ------
    ValueFault
        If one of them is beyond those for which it is known.
    """
    check_known_at(kind, wavelengths)
    row = np.ascontiguousarray(wavelengths, np.float64).reshape(-1)
    with np.errstate(all="ignore"):
        return np.asarray(kind.density(np, row)).reshape(np.shape(wavelengths))


def check_known_at(kind: SpectrumKind | Curve, wavelengths: Array) -> None:
    """Raise where a spectrum is not known.

    Parameters
    ----------
    kind : SpectrumKind or Curve
        The spectrum.
    wavelengths : ndarray
        In metres.

    Raises
    ------
    ValueFault
        Saying where it is.
    """
    low, high = kind.span
    known = WavelengthRange("wavelength", "length", low, high, label=kind.label, beyond=kind.beyond)
    known.check("a wavelength", wavelengths)

"""Spectrum: power by wavelength, of lamps, lines and bins, and of what detectors respond to."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ValueFault
from optipath.values.arrays.jax_values import is_traced, known, namespace
from optipath.values.curves.curve_value import curve_values
from optipath.values.domains.domain import Domain
from optipath.values.domains.quantities import NON_NEGATIVE
from optipath.values.parameters import Parameter
from optipath.values.spectra.arithmetic_of_kinds import product_of, quotient_of, sum_of
from optipath.values.spectra.histogram import Histogram
from optipath.values.spectra.lines import density_of_lines
from optipath.values.spectra.power_within import power_within
from optipath.values.spectra.refused_operations import RefusedOperations
from optipath.values.spectra.resampling import rebinned, resampled
from optipath.values.spectra.sampled import Sampled
from optipath.values.spectra.spectral_values import (
    check_known_at,
    one_number,
    some_wavelengths,
)
from optipath.values.spectra.spectrum_making import SpectrumMaking

if TYPE_CHECKING:
    from collections.abc import Hashable

    from optipath.values.spectra.spectrum_kind import SpectrumKind

_ABOVE = Domain("number above 0", minimum=1e-300)


class Spectrum(RefusedOperations, SpectrumMaking):
    """Power per nanometre by wavelength, or a relative value such as a response.

    ``Spectrum(wavelengths, values)`` goes through samples, as `sampled` does. Others are made by
    `histogram`, `line`, `led`, `black_body`, `illuminant`, `constant` and `from_csv`, and by
    arithmetic: a sum, a product with a number, a product or a quotient sample by sample, of two
    sampled spectra at the wavelengths of both. Between these the product of two straight lines is
    a parabola, and is taken as a straight line; so integrals are those of the trapezoids at the
    wavelengths of both, and finer samples, `resample`, bring them closer.

    Attributes
    ----------
    kind : SpectrumKind
        In which way the power is spread.

    Raises
    ------
    ValueFault
        If it is made of anything but samples or a kind.

    Examples
    --------
    >>> lamp = Spectrum.sampled(["400 nm", "600 nm"], [1.0, 3.0])
    >>> float(lamp.at("500 nm").round(12)), round(lamp.power(), 9)
    (2.0, 400.0)
    >>> lamp + Spectrum.line("532 nm", power=50.0)
    <Spectrum: a sampled spectrum + the line at 532 nm>
    """

    __array_ufunc__ = None  # NumPy's arrays leave products to it.

    @property
    def content(self) -> tuple[Hashable, ...]:
        return self.kind.content

    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        del arguments
        found = self.kind.density(xp, wavelength)
        if self.kind.lines:
            found = found + density_of_lines(self.kind.lines, wavelength)
        return (found,)

    def at(self, wavelength: Any) -> Any:
        """Return what it is at wavelengths, or what stands for it where these are a parameter.

        Parameters
        ----------
        wavelength : float, str, array_like or Parameter
            In metres or as texts. A line needs all wavelengths of a grid at once.

        Returns
        -------
        ndarray or CurveValue
            Power per nanometre.

        Raises
        ------
        OptipathError
            If a wavelength is none, or beyond those for which the spectrum is known.
        """
        if isinstance(wavelength, Parameter):
            return curve_values(self, wavelength)[0]
        given = known(wavelength)
        if is_traced(given):
            return self.numbers(namespace(given), given)[0]
        places = some_wavelengths("a wavelength", given)
        check_known_at(self, places)
        return self.evaluated(places)[0]

    def power(self, low: Any = None, high: Any = None) -> float:
        """Return the power between two wavelengths: the integral, and that of lines there.

        Parameters
        ----------
        low, high : float or str, optional
            In metres or as texts; by default, where the spectrum ends, and without both the whole
            power, that of a diode and a black body as well. A line at `low` counts, and one at a
            `high` that is given does not, so that parts sum up to the whole. (The last bin of
            `rebin` has the line at its end.)

        Returns
        -------
        float
            To about 1e-14.

        Raises
        ------
        ValueFault
            If it is not known there, or does not end and no end is given.

        Examples
        --------
        >>> laser = Spectrum.line("500 nm", power=2.0)
        >>> laser.power("400 nm", "500 nm"), laser.power("500 nm", "600 nm"), laser.power()
        (0.0, 2.0, 2.0)
        """
        return power_within(self.kind, low, high)

    def resample(self, wavelengths: Any, *, outside: Any = None) -> Spectrum:
        """Return the sampled spectrum of the same values at other wavelengths.

        Values are kept, and the power is that of straight lines between them; `rebin` keeps the
        power.

        Parameters
        ----------
        wavelengths : array_like, shape (n,)
            In metres or as texts.
        outside : {0.0, "nearest", "linear"}, optional
            What is beyond the new samples, as in `sampled`. Where this spectrum is not known it has
            no value in any case, unless it was itself made with an ``outside``.

        Returns
        -------
        Spectrum

        Raises
        ------
        ValueFault
            If it is not known there, or has lines, which have no value at a wavelength.
        """
        return Spectrum(resampled(self.kind, wavelengths, outside))

    def rebin(self, edges: Any, *, outside: str = "refuse") -> Spectrum:
        """Return the histogram of the same power in other bins.

        Power is kept, in each bin and in all of them to about 1e-14; `resample` keeps values. A
        line is in one bin, on an edge in the one above it.

        Parameters
        ----------
        edges : array_like, shape (n + 1,)
            In metres or as texts.
        outside : {"refuse", "drop"}, optional
            What becomes of power beyond the edges, of a spectrum that ends somewhere; one that
            does not is cut off.

        Returns
        -------
        Spectrum

        Raises
        ------
        ValueFault
            If the spectrum is not known in all bins, or power would be lost.
        """
        return Spectrum(rebinned(self.kind, edges, outside))

    @property
    def wavelengths(self) -> np.ndarray[Any, Any]:
        """The wavelengths of the samples, in metres and rising."""
        return self._of(Sampled, "wavelengths", "resample(wavelengths)")

    @property
    def values(self) -> np.ndarray[Any, Any]:
        """The values of the samples."""
        return self._of(Sampled, "values", "resample(wavelengths)")

    @property
    def edges(self) -> np.ndarray[Any, Any]:
        """The edges of the bins, in metres and rising."""
        return self._of(Histogram, "edges", "rebin(edges)")

    @property
    def powers(self) -> np.ndarray[Any, Any]:
        """The powers in the bins."""
        return self._of(Histogram, "powers", "rebin(edges)")

    def _of(self, kind: type[SpectrumKind], name: str, cure: str) -> np.ndarray[Any, Any]:
        if not isinstance(self.kind, kind):
            raise ValueFault(f"{self.label} has no {name}; ask for those of spectrum.{cure}")
        found: np.ndarray[Any, Any] = getattr(self.kind, name)
        return found

    def __add__(self, other: Any) -> Spectrum:
        if isinstance(other, Spectrum):
            return Spectrum(sum_of(self.kind, other.kind))
        if isinstance(other, (int, float)) and other == 0:
            return self  # With which Python's own sum begins.
        raise self._no_sum(other)

    __radd__ = __add__

    def __mul__(self, other: Any) -> Any:
        if isinstance(other, Spectrum):
            return Spectrum(product_of(self.kind, other.kind))
        return self._by_number(other, "a factor")

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Any:
        if isinstance(other, Spectrum):
            return Spectrum(quotient_of(self.kind, other.kind))
        return self._by_number(other, "a divisor", above=True)

    def __rtruediv__(self, other: Any) -> Spectrum:
        whole: Spectrum = Spectrum.constant(other) / self
        return whole

    def _by_number(self, other: Any, what: str, *, above: bool = False) -> Spectrum:
        number = one_number(f"{what} of {self.label}", other, _ABOVE if above else NON_NEGATIVE)
        with np.errstate(over="ignore"):  # Samples that are not finite are refused.
            return Spectrum(self.kind.times(1.0 / number if above else number))

    def __repr__(self) -> str:
        return f"<Spectrum: {self.label}>"

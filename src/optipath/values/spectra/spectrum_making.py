"""SpectrumMaking: the ways in which a spectrum is made of numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import ValueFault, shown
from optipath.values.curves.csv_columns import read_columns
from optipath.values.curves.curve import Curve
from optipath.values.domains.domain import Domain
from optipath.values.labels import label_of
from optipath.values.spectra.black_body import BlackBody
from optipath.values.spectra.even_spectrum import EvenSpectrum
from optipath.values.spectra.gaussian_line import GaussianLine
from optipath.values.spectra.histogram import Histogram
from optipath.values.spectra.illuminant import Illuminant
from optipath.values.spectra.lines import Lines
from optipath.values.spectra.sampled import Sampled
from optipath.values.spectra.spectral_values import (
    one_number,
    one_wavelength,
    refuse_longest,
    value_outside,
)
from optipath.values.spectra.spectral_width import WidthAtPeak
from optipath.values.spectra.spectrum_kind import EmissionLine, SpectrumKind

if TYPE_CHECKING:
    from os import PathLike
    from typing import Self

_TEMPERATURE = Domain("temperature in kelvins", minimum=1e-3, maximum=1e9)
_MAKERS = (
    "sampled(wavelengths, values), histogram, line, led, black_body, illuminant, constant or "
    "from_csv, as in Spectrum.line('633 nm')"
)


class SpectrumMaking(Curve):
    """A spectrum through samples, or by its kind, and its constructors.

    Shapes: wavelengths (n,); values (n,). Units: wavelengths in metres.
    """

    kind: SpectrumKind

    def __init__(
        self, wavelengths: Any, values: Any = None, *, outside: Any = None, name: str = ""
    ) -> None:
        kind = wavelengths
        if values is not None:
            label = label_of("a spectrum", name, "a sampled spectrum")
            kind = Sampled(wavelengths, values, outside, label)
        if not isinstance(kind, SpectrumKind):
            raise ValueFault(f"a Spectrum is not made of {shown(kind)}; use Spectrum.{_MAKERS}")
        vars(self).update(
            kind=kind,
            label=kind.label,
            span=kind.span,
            beyond=kind.beyond,
            takes_grid=bool(kind.lines),
        )

    @classmethod
    def sampled(cls, wavelengths: Any, values: Any, *, outside: Any = None, name: str = "") -> Self:
        """Return the spectrum through samples, linear between them.

        Parameters
        ----------
        wavelengths : array_like, shape (n,)
            In metres, or texts such as ``"516 nm"``; rising or falling.
        values : array_like, shape (n,)
            Power per nanometre, or relative values; not negative.
        outside : {0.0, "nearest", "linear"}, optional
            What is beyond the samples: nothing, as much as at the last one, or the last straight
            line on, as far as it is above 0; without it, to ask there is an error.
        name : str, optional
            What sentences call it.

        Returns
        -------
        Spectrum

        Raises
        ------
        ValueFault
            With all that is wrong with the samples.
        """
        return cls(wavelengths, () if values is None else values, outside=outside, name=name)

    @classmethod
    def from_csv(
        cls,
        path: str | PathLike[str],
        column: str = "power",
        *,
        unit: str = "",
        outside: Any = None,
        name: str = "",
    ) -> Self:
        """Return the spectrum through the samples of a file, as `sampled` does.

        Parameters
        ----------
        path : str or PathLike
            A file of separated values, whose first line has names: ``wavelength (nm), power``, or
            the unit stands behind each wavelength.
        column : str, optional
            The name of the column of values.
        unit : str, optional
            Of the wavelengths, where the first line has none.
        outside, name
            As `sampled` takes them; the name is that of the file by default.

        Returns
        -------
        Spectrum

        Raises
        ------
        ValueFault
            With all that is wrong, and the lines.
        """
        signs = {str(column): "such as 0 for what is noise"}
        found = read_columns(path, [column], unit=unit, signs=signs)
        values = found.columns[column]
        return cls.sampled(found.wavelengths, values, outside=outside, name=name or found.title)

    @classmethod
    def histogram(cls, edges: Any, powers: Any, *, outside: Any = None, name: str = "") -> Self:
        """Return the spectrum of bins; its density is the power of a bin by its width in nm.

        Parameters
        ----------
        edges : array_like, shape (n + 1,)
            In metres, or texts; rising or falling. An edge is of the bin above it.
        powers : array_like, shape (n,)
            The power in each bin; not negative.
        outside : 0.0, optional
            Where nothing is beyond the bins; without it, to ask there is an error.
        name : str, optional
            What sentences call it.

        Returns
        -------
        Spectrum

        Raises
        ------
        ValueFault
            If these are no bins.
        """
        return cls(Histogram(edges, powers, outside, label_of("a spectrum", name, "a histogram")))

    @classmethod
    def line(cls, wavelength: Any, power: Any = 1.0, *, outside: Any = None) -> Self:
        """Return the spectrum of a line, such as that of a laser: all power at one wavelength.

        In a run, all of it stands in the bin of the grid of wavelengths that holds the line,
        however wide that is.

        Parameters
        ----------
        wavelength : float or str
            In metres, or a text such as ``"633 nm"``.
        power : float, optional
            All of it; not negative.
        outside : 0.0, optional
            Where a grid may leave the line out; without it, that is an error.

        Returns
        -------
        Spectrum

        Raises
        ------
        ValueFault
            If the wavelength or the power is none.

        Examples
        --------
        >>> from optipath import Spectrum
        >>> Spectrum.line("500 nm").at(["400 nm", "500 nm", "600 nm"])
        array([0.  , 0.01, 0.  ])
        """
        place = one_wavelength("wavelength of a line", wavelength)
        all_of_it = one_number("power of a line", power)
        return cls(Lines([EmissionLine(place, all_of_it, value_outside("a line", outside))]))

    @classmethod
    def led(cls, peak: Any, width: Any, power: Any = 1.0) -> Self:
        """Return the spectrum of a light-emitting diode: a Gaussian along the wavelength.

        Parameters
        ----------
        peak, width : float or str
            The wavelength of the maximum and the full width at half maximum, in metres or texts.
            A width in eV, 1/cm or THz is the distance between the wavelengths half of it above
            and half of it below the peak.
        power : float, optional
            The integral over all wavelengths.

        Returns
        -------
        Spectrum

        Raises
        ------
        ValueFault
            If one of them is none.
        """
        place = one_wavelength("peak of a diode", peak)
        domain = WidthAtPeak("width", "length", minimum=5e-324, peak=place)
        wide = one_number("width of a diode", width, domain)
        refuse_longest("width of a diode", wide)
        return cls(GaussianLine(place, wide, one_number("power of a diode", power)))

    @classmethod
    def black_body(cls, temperature: Any) -> Self:
        """Return the spectral radiance of a black body, in W/(m2 sr nm), by Planck's law.

        Parameters
        ----------
        temperature : float
            In kelvins.

        Returns
        -------
        Spectrum

        Raises
        ------
        ValueFault
            If it is none.

        Examples
        --------
        >>> from optipath import Spectrum
        >>> float(Spectrum.black_body(5772).at("502 nm").round(3))
        26239.591
        """
        return cls(BlackBody(one_number("temperature of a black body", temperature, _TEMPERATURE)))

    @classmethod
    def illuminant(cls, name: str) -> Self:
        """Return a standard illuminant of the CIE: relative powers, 100 at 560 nm.

        Parameters
        ----------
        name : {"A", "D65", "E"}
            Incandescent light, daylight, or the same everywhere; 300 to 830 nm (CIE 15:2018).

        Returns
        -------
        Spectrum

        Raises
        ------
        ValueFault
            If there is none of that name.
        """
        return cls(Illuminant(name))

    @classmethod
    def constant(cls, value: Any = 1.0) -> Self:
        """Return the spectrum that is the same at each wavelength.

        Parameters
        ----------
        value : float, optional
            Power per nanometre, or a relative value; not negative.

        Returns
        -------
        Spectrum

        Raises
        ------
        ValueFault
            If it is none.
        """
        return cls(EvenSpectrum(one_number("value of a constant spectrum", value)))

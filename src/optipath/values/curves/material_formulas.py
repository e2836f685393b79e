"""MaterialFormulas: the ways to make a material by a published formula."""

from __future__ import annotations

from typing import Any, Self

from optipath.values.curves.curve_material import CurveMaterial
from optipath.values.curves.formula_curve import EVERYWHERE
from optipath.values.curves.oscillator_curve import DrudeLorentz, TaucLorentz
from optipath.values.curves.sellmeier_curve import Cauchy, Sellmeier
from optipath.values.labels import label_of


class MaterialFormulas(CurveMaterial):
    """Materials of formulas, whose coefficients are numbers or parameters.

    All of them take `span`, the least and the largest wavelength that the formula holds for, such
    as ``("310 nm", "2.5 um")``; `name`, which sentences call the material by; and `wavelength`.
    """

    @classmethod
    def sellmeier(
        cls,
        b: Any,
        c: Any = None,
        resonances: Any = None,
        offset: Any = 1.0,
        k: Any = 0.0,
        *,
        span: Any = EVERYWHERE,
        name: str = "",
        wavelength: Any = None,
    ) -> Self:
        """Return a transparent material by n^2 = offset + the sum of B w^2 / (w^2 - C).

        Sellmeier (1871), with coefficients as catalogues have them, in micrometres.

        Parameters
        ----------
        b, c : sequence of float or Parameter
            B, and C in square micrometres.
        resonances : sequence of float or Parameter, optional
            In place of C, the wavelengths of which these are the squares, in micrometres.
        offset, k : float or Parameter, optional
            The first term, and the extinction coefficient.
        span : pair of float or str, optional
            The wavelengths that it holds for, such as ``("310 nm", "2.5 um")``.
        name, wavelength
            As `tabulated` takes them.

        Returns
        -------
        Material

        Raises
        ------
        ValueFault
            With all that is wrong with the coefficients.

        Examples
        --------
        >>> from optipath.values.materials import Material
        >>> b, c = (1.03961212, 0.231792344, 1.01046945), (0.00600069867, 0.0200179144, 103.560653)
        >>> round(Material.sellmeier(b, c, name="BK7").at("587.6 nm").n, 5)
        1.5168
        """
        label = label_of("a material", name, "a Sellmeier formula")
        curve = Sellmeier(label, b, c, resonances=resonances, offset=offset, span=span)
        return cls.of_curve(curve, wavelength, k)

    @classmethod
    def cauchy(
        cls,
        coefficients: Any,
        k: Any = 0.0,
        *,
        span: Any = EVERYWHERE,
        name: str = "",
        wavelength: Any = None,
    ) -> Self:
        """Return a transparent material by n = A + B / w^2 + C / w^4 + ...

        Parameters
        ----------
        coefficients : sequence of float or Parameter
            A, a pure number, B in square micrometres, C in um^4, ...
        k : float or Parameter, optional
            The extinction coefficient.
        span, name, wavelength
            As `sellmeier` takes them.

        Returns
        -------
        Material

        Raises
        ------
        ValueFault
            With all that is wrong with the coefficients.

        Examples
        --------
        >>> from optipath.values.materials import Material
        >>> Material.cauchy([1.5, 0.004], wavelength="500 nm")
        Material(n=1.516, k=0.0)
        """
        curve = Cauchy(label_of("a material", name, "a Cauchy formula"), coefficients, span=span)
        return cls.of_curve(curve, wavelength, k)

    @classmethod
    def drude_lorentz(
        cls,
        plasma: Any,
        damping: Any,
        strength: Any = 1.0,
        oscillators: Any = (),
        background: Any = 1.0,
        *,
        span: Any = EVERYWHERE,
        name: str = "",
        wavelength: Any = None,
    ) -> Self:
        """Return a metal of free electrons (Drude) and bound ones (Lorentz); energies in eV.

        eps = background - f0 wp^2 / (w^2 + i g0 w) + the sum of f wp^2 / (w0^2 - w^2 - i g w), as
        in A. D. Rakic et al., Appl. Opt. 37, 5271 (1998), whose field is exp(+iwt).

        Parameters
        ----------
        plasma : float or Parameter
            wp, the photon energy of the plasma frequency.
        damping, strength : float or Parameter
            g0, and f0, a pure number, of free electrons; 0 where there are none.
        oscillators : sequence of sequence, optional
            The strength f, the energy w0 and the damping g of each.
        background : float or Parameter, optional
            The permittivity at high energies.
        span, name, wavelength
            As `sellmeier` takes them.

        Returns
        -------
        Material

        Raises
        ------
        ValueFault
            With all that is wrong with the coefficients.

        Examples
        --------
        >>> from optipath.values.materials import Material
        >>> Material.drude_lorentz(9.0, 0.02, background=4.0, name="silver")
        Material 'silver', any wavelength
        """
        label = label_of("a material", name, "a Drude-Lorentz model")
        given = {"strength": strength, "oscillators": oscillators, "background": background}
        return cls.of_curve(DrudeLorentz(label, plasma, damping, **given, span=span), wavelength)

    @classmethod
    def tauc_lorentz(
        cls,
        oscillators: Any,
        background: Any = 1.0,
        *,
        span: Any = EVERYWHERE,
        name: str = "",
        wavelength: Any = None,
    ) -> Self:
        """Return an amorphous film by oscillators above a gap; energies in eV.

        G. E. Jellison and F. A. Modine, Appl. Phys. Lett. 69, 371 and 2137 (1996).

        Parameters
        ----------
        oscillators : sequence of sequence
            The amplitude A, the energy E0, the broadening C, which is below 2 E0, and the gap Eg
            of each.
        background : float or Parameter, optional
            The permittivity at high energies.
        span, name, wavelength
            As `sellmeier` takes them.

        Returns
        -------
        Material

        Raises
        ------
        ValueFault
            With all that is wrong with the coefficients.

        Examples
        --------
        >>> from optipath.values.materials import Material
        >>> silicon = Material.tauc_lorentz([(122.0, 3.45, 2.54, 1.2)], 1.15)
        >>> round(silicon.at("500 nm").n, 4)
        4.4573
        """
        label = label_of("a material", name, "a Tauc-Lorentz model")
        return cls.of_curve(
            TaucLorentz(label, oscillators, background=background, span=span), wavelength
        )

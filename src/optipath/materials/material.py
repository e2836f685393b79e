"""Material: a medium of complex index n + ik, constant or by wavelength."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

import numpy as np

from optipath.errors import ParameterError, UnitError, ValueFault
from optipath.faults import Cure, Fault, shown
from optipath.materials.database import parts_by_name, parts_of_file
from optipath.materials.formulas import EVERYWHERE, Cauchy, DrudeLorentz, Sellmeier, TaucLorentz
from optipath.materials.tables import Tabulated
from optipath.values.arrays import ComparedByFields, as_argument, broadcast_fault, same
from optipath.values.columns import read_columns
from optipath.values.curve import Curve, span_text
from optipath.values.curve_value import CurveValue, curve_at
from optipath.values.domains import LEAST, Domain
from optipath.values.jax_values import is_traced
from optipath.values.parameters import Parameter, label_of
from optipath.values.units import parse_quantity
from optipath.values.use import make_sound

if TYPE_CHECKING:
    from os import PathLike

    from optipath.materials.tables import Extrapolation, Interpolation


_SIGN_OF_K = "where the field is exp(-iwt), so that k > 0 absorbs"


class _Part(Domain):
    """One of the two numbers of an index."""

    def parse(self, text: str) -> Any:
        return index_of(text)

    def _check_numbers(self, owner: str, array: Any, rounding: float) -> None:
        if array.dtype.kind == "c":
            cure = Cure.of("give n and k apart, such as {}".format, *_GOLD)
            raise ValueFault(Fault(f"{owner} is complex", cure))
        super()._check_numbers(owner, array, rounding)


class RealPart(_Part):
    """Its real part, for which a `Material` may stand."""

    takes_materials = True


def _number(value: Any) -> Any:
    """Return a known number, or an array of them; None for anything else."""
    value = value.placed(value.default) if isinstance(value, Parameter) and value.bound else value
    plain = isinstance(value, (int, float, np.ndarray, np.number)) and not is_traced(value)
    array = np.asarray(value if plain else "")
    return array if array.dtype.kind in "biuf" else None


def index_of(text: str) -> complex:
    """Return the number that a text stands for, which is no name of a material.

    >>> index_of("0.2+3.4j")
    (0.2+3.4j)
    """
    if text.strip()[:1].isalpha():
        such = Cure.of("give n and k as numbers, such as {}".format, *_GOLD)
        raise UnitError(Fault(f"'{text}' is no number", such))
    return parse_quantity(text, "")


_GOLD = ("Material(0.18, 3.4)", "{ n = 0.18, k = 3.4 }")


N = RealPart("index of refraction", minimum=0.0)
K = _Part("extinction coefficient", minimum=0.0)
N_OF_CLEAR = RealPart("index of refraction", minimum=LEAST, besides=" where k is 0")
PARTS = {"n": N, "k": K}


@dataclass(frozen=True, eq=False)
class Material(ComparedByFields):
    """A homogeneous medium, given by its complex index of refraction n + ik.

    Both may follow from the wavelength: `Material.tabulated`, `from_csv`, `sellmeier`, `cauchy`,
    `drude_lorentz`, `tauc_lorentz`, `named` and `from_yaml` make such ones, or raise a `ValueFault`
    with all that is wrong; `at` tells what they are at a wavelength.

    The wavelength is by default the parameter of that name, which is given when a path is traced;
    or another `Parameter`; or a number in metres or a text such as ``"516 nm"``, of which a
    constant material is made. The coefficients of formulas are numbers or parameters.

    Parameters
    ----------
    n : float, array_like or Parameter
        The index of refraction, not negative.
    k : float, array_like or Parameter, optional
        The extinction coefficient, not negative; k > 0 absorbs.

    Raises
    ------
    ValueFault
        If either is no such number.

    Examples
    --------
    >>> Material(0.608, 2.12)
    Material(n=0.608, k=2.12)
    """

    stands_for_index: ClassVar[bool] = True

    n: Any
    k: Any = 0.0

    def __post_init__(self) -> None:
        parts = lambda: [("n", self.n, self.domain_of_n), ("k", self.k, K)]  # noqa: E731
        make_sound(self, PARTS, parts, of_fields=False)

    @classmethod
    def tabulated(
        cls,
        wavelengths: Any,
        n: Any,
        k: Any = 0.0,
        *,
        interpolation: Interpolation = "linear",
        extrapolate: Extrapolation = "",
        name: str = "",
        wavelength: Any = None,
    ) -> Self:
        """Return a material of measured n and k.

        Parameters
        ----------
        wavelengths : array_like, shape (m,)
            In metres, or texts such as ``"516 nm"`` and ``"2.4 eV"``; rising or falling.
        n, k : array_like, shape (m,) or ()
            Not negative.
        interpolation : {"linear", "monotone"}, optional
            Between samples, of n and of k: straight lines, or cubics that overshoot no sample
            (Fritsch and Butland 1984).
        extrapolate : {"", "nearest", "linear"}, optional
            Beyond the samples: an error, the last sample, or the straight line on.
        name : str, optional
            What sentences call it.
        wavelength : float, str, array_like or Parameter, optional
            Of the run; the parameter ``wavelength`` by default.

        Returns
        -------
        Material

        Examples
        --------
        >>> Material.tabulated(["500 nm", "521 nm"], [0.97, 0.62], [1.87, 2.08], name="gold")
        Material 'gold', 500 nm .. 521 nm
        """
        label = label_of("a material", name, "a table of n and k")
        how: Any = {"interpolation": interpolation, "extrapolate": extrapolate}
        arguments = {"wavelengths": wavelengths, "n": n, "k": k}
        shapes = {name: as_argument(f"{name} of {label}", v).shape for name, v in arguments.items()}
        if not shapes["n"]:
            n = np.full(shapes["wavelengths"], n)
        rows = {"n": n, "k": k} if shapes["k"] else {"n": n}
        curve = Tabulated(label, tuple(rows), wavelengths, [*rows.values()], **how)
        _refuse_unphysical(curve, curve.columns[1] if shapes["k"] else k)
        return cls.of_curve(curve, wavelength, k)

    @classmethod
    def from_csv(
        cls,
        path: str | PathLike[str],
        *,
        k: float | None = None,
        unit: str = "",
        interpolation: Interpolation = "linear",
        extrapolate: Extrapolation = "",
        name: str = "",
        wavelength: Any = None,
    ) -> Self:
        """Return a material of a table in a file, with a line for each wavelength.

        Parameters
        ----------
        path : str or PathLike
            Its first line says what the columns are: ``wavelength (nm)`` or ``energy (eV)``, ``n``
            and ``k``; the separator is a comma, a semicolon or a tabulator, and lines that begin
            with ``#`` are comments.
        k : float, optional
            Of a file without a column k.
        unit : str, optional
            Of the wavelengths, where the first line has none.
        interpolation, extrapolate, name, wavelength
            As `tabulated` takes them; the name is that of the file by default.

        Returns
        -------
        Material
        """
        names = ["n", "k"] if k is None else ["n"]
        cures = {"k": "; or give k=0.0 where nothing absorbs"}
        table = read_columns(path, names, unit=unit, cures=cures)
        with ValueFault.wrapping(str(path)):
            return cls.tabulated(
                table.wavelengths,
                **{"k": k, **table.columns},
                interpolation=interpolation,
                extrapolate=extrapolate,
                name=name or table.title,
                wavelength=wavelength,
            )

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
            The least and the largest wavelength that it holds for: ``("310 nm", "2.5 um")``.
        name, wavelength
            As `tabulated` takes them.

        Returns
        -------
        Material

        Examples
        --------
        >>> b, c = (1.03961212, 0.231792344, 1.01046945), (0.00600069867, 0.0200179144, 103.560653)
        >>> round(Material.sellmeier(b, c, name="BK7").at("587.6 nm").n, 5)
        1.5168
        """
        label = label_of("a material", name, "a Sellmeier formula")
        return cls.of_curve(Sellmeier(label, b, c, resonances, offset, span=span), wavelength, k)

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

        Examples
        --------
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

        Examples
        --------
        >>> Material.drude_lorentz(9.0, 0.02, background=4.0, name="silver")
        Material 'silver', any wavelength
        """
        label = label_of("a material", name, "a Drude-Lorentz model")
        of_all = plasma, damping, strength, oscillators, background
        return cls.of_curve(DrudeLorentz(label, *of_all, span=span), wavelength)

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

        Examples
        --------
        >>> silicon = Material.tauc_lorentz([(122.0, 3.45, 2.54, 1.2)], 1.15)
        >>> round(silicon.at("500 nm").n, 4)
        4.4573
        """
        label = label_of("a material", name, "a Tauc-Lorentz model")
        return cls.of_curve(TaucLorentz(label, oscillators, background, span=span), wavelength)

    @classmethod
    def named(
        cls,
        name: str,
        *,
        page: str = "",
        interpolation: Interpolation = "linear",
        extrapolate: Extrapolation = "",
        n: Any = None,
        k: Any = None,
        wavelength: Any = None,
    ) -> Self:
        """Return the material of a page of refractiveindex.info; ``optipath materials`` lists them.

        Parameters
        ----------
        name : str
            A short name (``"gold"``), a book of the database (``"Au"``), or a page of it
            (``"main/Au/Johnson"``, ``"Au/Johnson"``, ``"N-BK7"``).
        page : str, optional
            Which page of the book: ``"Johnson"``.
        interpolation, extrapolate, wavelength
            As `tabulated` takes them; beyond the range of a formula, ``"nearest"`` alone.
        n, k : float, array_like or Parameter, optional
            In place of those of the page, and needed where it has none; k = 0 is taken only for
            short names that say where it is.

        Returns
        -------
        Material

        Raises
        ------
        MissingExtraError
            If the database is not installed, which the extra ``materials`` brings.
        MaterialError
            If there is no such page, several, or one that lacks n or k.

        Examples
        --------
        >>> Material.named("vacuum").refractive_index
        1.0
        """
        how = {"interpolation": interpolation, "extrapolate": extrapolate}
        return cls(**parts_by_name(name, page, {"n": n, "k": k}, wavelength, how))

    @classmethod
    def from_yaml(
        cls,
        path: str | PathLike[str],
        *,
        interpolation: Interpolation = "linear",
        extrapolate: Extrapolation = "",
        n: Any = None,
        k: Any = None,
        wavelength: Any = None,
    ) -> Self:
        """Return the material of a YAML file as refractiveindex.info has them.

        Parameters
        ----------
        path : str or path
            The file: tables and formulas under ``DATA``, wavelengths in micrometres.
        interpolation, extrapolate, n, k, wavelength
            As `named` takes them.

        Returns
        -------
        Material

        Raises
        ------
        MissingExtraError
            If PyYAML is not installed, which the extra ``materials`` brings.
        MaterialError
            With all that is wrong with the file.
        """
        how = {"interpolation": interpolation, "extrapolate": extrapolate}
        return cls(**parts_of_file(path, {"n": n, "k": k}, wavelength, how))

    @classmethod
    def of_curve(cls, curve: Curve, wavelength: Any = None, k: Any = 0.0) -> Self:
        """Return the material of a curve with the parts n and k, or with n alone.

        Parameters
        ----------
        curve : Curve
            What its n and k are.
        wavelength
            As `tabulated` takes it.
        k : float or Parameter, optional
            Of a curve of n alone, the same at all wavelengths.

        Returns
        -------
        Material
        """
        if not isinstance(curve, Curve):
            raise ValueFault(f"curve is {shown(curve)}; give a Curve, or use Material.tabulated")
        n, *rest = curve_at(curve, wavelength)
        return cls(n, rest[0] if rest else k)

    @property
    def refractive_index(self) -> Any:
        """The index n + ik as one number, or an array of these; real where nothing absorbs.

        Examples
        --------
        >>> Material(0.608, 2.12).refractive_index
        (0.608+2.12j)
        """
        for part in (self.n, self.k):
            if isinstance(part, Parameter):
                at = ", or give material.at('550 nm')" * isinstance(part, CurveValue)
                raise ParameterError(
                    f"{part.called} is not known yet; let the Material itself stand in the path{at}"
                )
        without = not is_traced(self.k) and not np.any(self.k)
        return self.n if without else self.n + 1j * self.k

    @property
    def span(self) -> tuple[float, float]:
        """The least and the largest wavelength that it may be asked for, in metres.

        Examples
        --------
        >>> Material(1.5).span
        (0.0, inf)
        """
        spans = [part.curve.span for part in (self.n, self.k) if isinstance(part, CurveValue)]
        lows, highs = zip((0.0, np.inf), *spans, strict=True)
        return max(lows), min(highs)

    @property
    def domain_of_n(self) -> Domain:
        """What n may be: 0 only where k is above 0, or not known yet."""
        if (k := _number(self.k)) is None:
            return N
        if not np.any(k):
            return N_OF_CLEAR
        if (n := _number(self.n)) is None or broadcast_fault({"n": n.shape, "k": k.shape}):
            return N
        return N if np.all(n) or not np.any((n == 0.0) & (k == 0.0)) else N_OF_CLEAR

    def at(self, wavelength: Any) -> Material:
        """Return what it is at a wavelength: a constant material, of arrays for several.

        Parameters
        ----------
        wavelength : float, str or array_like
            In vacuum, in metres, or texts such as ``"516 nm"`` and ``"2.4 eV"``.

        Raises
        ------
        ValueFault
            If it is not known there.
        ParameterError
            If it has coefficients that are parameters without a value.

        Examples
        --------
        >>> Material.cauchy([1.5, 0.004]).at("500 nm")
        Material(n=1.516, k=0.0)
        """
        parts = self.n, self.k
        if not any(isinstance(part, CurveValue) for part in parts):
            return self
        return Material(*[p.at(wavelength) if isinstance(p, CurveValue) else p for p in parts])

    def __repr__(self) -> str:
        n, k = self.n, self.k
        if isinstance(n, CurveValue):
            alike = k.curve == n.curve if isinstance(k, CurveValue) else same(k, 0.0)
            if alike:
                return f"Material {shown(n.curve.label)}, {span_text(self.span)}"
        return f"Material(n={_written(n)}, k={_written(k)})"


def _written(part: Any) -> str:
    return part.formula_of(shown(part.spoken)[1:-1]) if isinstance(part, CurveValue) else repr(part)


def _refuse_unphysical(curve: Tabulated, k: Any) -> None:
    """Refuse samples below 0, and n of 0 where k, an array or the same throughout, is 0."""

    def first(bad: Any) -> str:
        return f"{curve.wavelengths[bad][0] * 1e9:.10g} nm"

    faults = [
        f"{part} of {curve.label} is {column[bad][0]:g} at {first(bad)}; give none below 0"
        f"{f', {_SIGN_OF_K}' * (part == 'k')}"
        for part, column in zip(curve.parts, curve.columns, strict=True)
        if np.any(bad := column < 0.0)
    ]
    known = k if isinstance(k, (int, float, np.ndarray)) else 1.0
    if not faults and np.any(bad := (curve.columns[0] == 0.0) & (known == 0.0)):
        faults = [f"n of {curve.label} is 0 at {first(bad)}, where k is 0; give an n above 0 there"]
    ValueFault.raise_for(faults)

"""MaterialTables: the ways to make a material of measured n and k."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Self

import numpy as np

from optipath.errors import ValueFault
from optipath.values.arrays.array_likes import as_given
from optipath.values.curves.csv_columns import read_columns
from optipath.values.curves.curve_material import CurveMaterial
from optipath.values.curves.tabulated import Tabulated
from optipath.values.labels import label_of

if TYPE_CHECKING:
    from os import PathLike

_SIGN_OF_K = "where the field is exp(-iwt), so that k > 0 absorbs"


class MaterialTables(CurveMaterial):
    """Materials of samples, from arrays and files."""

    @classmethod
    def tabulated(
        cls,
        wavelengths: Any,
        n: Any,
        k: Any = 0.0,
        *,
        interpolation: str = "linear",
        extrapolate: str = "",
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
            By default the parameter ``wavelength``.

        Returns
        -------
        Material

        Raises
        ------
        ValueFault
            With all that is wrong with the samples.

        Examples
        --------
        >>> from optipath.values.materials import Material
        >>> gold = Material.tabulated(["500 nm", "521 nm"], [0.97, 0.62], [1.87, 2.08], name="gold")
        >>> gold
        Material 'gold', 500 nm .. 521 nm
        """
        label = label_of("a material", name, "a table of n and k")
        given = {"wavelengths": wavelengths, "n": n, "k": k}
        shapes = {name: as_given(f"{name} of {label}", v).shape for name, v in given.items()}
        columns: dict[str, Any] = {"n": n if shapes["n"] else np.full(shapes["wavelengths"], n)}
        constant = not shapes["k"]
        if not constant:
            columns["k"] = k
        curve = Tabulated(
            label,
            tuple(columns),
            wavelengths,
            [*columns.values()],
            interpolation=interpolation,
            extrapolate=extrapolate,
        )
        _refuse_unphysical(curve, k if constant else None)
        return cls.of_curve(curve, wavelength, k if constant else 0.0)

    @classmethod
    def from_csv(
        cls,
        path: str | PathLike[str],
        *,
        k: float | None = None,
        unit: str = "",
        interpolation: str = "linear",
        extrapolate: str = "",
        name: str = "",
        wavelength: Any = None,
    ) -> Self:
        """Return a material of a table in a file, with a line for each wavelength.

        Its first line says what the columns are: ``wavelength (nm)`` or ``energy (eV)``, ``n`` and
        ``k``; the separator is a comma, a semicolon or a tabulator, and lines that begin with
        ``#`` are comments.

        Parameters
        ----------
        path : str or PathLike
            The file.
        k : float, optional
            The extinction coefficient, of a file without a column k.
        unit : str, optional
            Of the wavelengths, where the first line has none.
        interpolation, extrapolate, name, wavelength
            As `tabulated` takes them; the name is that of the file by default.

        Returns
        -------
        Material

        Raises
        ------
        ValueFault
            With all that is wrong with the file, and the lines.
        """
        names = ["n", "k"] if k is None else ["n"]
        table = read_columns(
            path,
            names,
            unit=unit,
            cures={"k": "give k=0.0 where nothing absorbs"},
            signs={"k": _SIGN_OF_K},
        )
        return cls.tabulated(
            table.wavelengths,
            table.columns["n"],
            table.columns["k"] if k is None else k,
            interpolation=interpolation,
            extrapolate=extrapolate,
            name=name or table.title,
            wavelength=wavelength,
        )


def _refuse_unphysical(curve: Tabulated, k: Any = None) -> None:
    """Refuse samples below 0, and n of 0 where k, of the curve or at all wavelengths, is 0."""
    faults = [
        f"{part} of {curve.label} is {column[bad][0]:g} at "
        f"{curve.wavelengths[bad][0] * 1e9:.10g} nm; give none below 0"
        f"{f', {_SIGN_OF_K}' * (part == 'k')}"
        for part, column in zip(curve.parts, curve.columns, strict=True)
        if np.any(bad := column < 0.0)
    ]
    extinction = k if isinstance(k, (int, float)) else curve.columns[-1] if k is None else 1.0
    if not faults and np.any(bad := (curve.columns[0] == 0.0) & (extinction == 0.0)):
        place = f"{curve.wavelengths[bad][0] * 1e9:.10g} nm"
        faults = [f"n of {curve.label} is 0 at {place}, where k is 0; give an n above 0 there"]
    if faults:
        raise ValueFault(*faults)

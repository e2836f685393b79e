"""MaterialPages: the ways to make a material of a page of refractiveindex.info."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Self

from optipath.values.curves.curve_material import CurveMaterial
from optipath.values.database.named_parts import parts_by_name, parts_of_file

if TYPE_CHECKING:
    from os import PathLike


class MaterialPages(CurveMaterial):
    """Materials by name, and out of files as the database has them."""

    @classmethod
    def named(
        cls,
        name: str,
        *,
        page: str = "",
        interpolation: str = "linear",
        extrapolate: str = "",
        n: Any = None,
        k: Any = None,
        wavelength: Any = None,
    ) -> Self:
        """Return the material of a page of refractiveindex.info, which is read when it is met.

        It needs the extra ``materials``; ``optipath materials`` lists the names.

        Parameters
        ----------
        name : str
            A short name (``"gold"``), a book of the database (``"Au"``), or a page of it
            (``"main/Au/Johnson"``, ``"Au/Johnson"``, ``"N-BK7"``).
        page : str, optional
            Which page of the book: ``"Johnson"``.
        interpolation : {"linear", "monotone"}, optional
            Between the samples of tables.
        extrapolate : {"", "nearest", "linear"}, optional
            Beyond the range of a table; of a formula, ``"nearest"`` alone.
        n, k : float, array_like or Parameter, optional
            In place of those of the page, and needed where it has none; k = 0 is taken only for
            short names that say where it is.
        wavelength : float, str, array_like or Parameter, optional
            In metres, or with a unit; the parameter ``wavelength`` of the run by default.

        Returns
        -------
        Material
            Of numbers where the wavelength is known; else it stands in a path, which has the
            parameter ``wavelength`` then.

        Raises
        ------
        MissingExtraError
            If the database is not installed.
        MaterialError
            If there is no such page, several, or one that lacks n or k.
        ValueFault
            If a wavelength is out of its range.

        Examples
        --------
        >>> from optipath.values.materials import Material
        >>> Material.named("vacuum").refractive_index
        1.0
        """
        how = {"interpolation": interpolation, "extrapolate": extrapolate}
        return cls(**parts_by_name(name, page, {"n": n, "k": k}, wavelength, **how))

    @classmethod
    def from_yaml(
        cls,
        path: str | PathLike[str],
        *,
        interpolation: str = "linear",
        extrapolate: str = "",
        n: Any = None,
        k: Any = None,
        wavelength: Any = None,
    ) -> Self:
        """Return the material of a YAML file as refractiveindex.info has them.

        It needs the extra ``materials``, which brings PyYAML.

        Parameters
        ----------
        path : str or path
            The file: tables and formulas under ``DATA``, wavelengths in micrometres.
        interpolation, extrapolate, n, k, wavelength
            As `Material.named` takes them.

        Returns
        -------
        Material

        Raises
        ------
        MissingExtraError
            If PyYAML is not installed.
        MaterialError
            With all that is wrong with the file.
        ValueFault
            If a wavelength is out of its range.
        """
        how = {"interpolation": interpolation, "extrapolate": extrapolate}
        return cls(**parts_of_file(path, {"n": n, "k": k}, wavelength, **how))

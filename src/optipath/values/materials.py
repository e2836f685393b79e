"""Material: what an interface separates the light from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from optipath.errors import ParameterError, UnitError, ValueFault
from optipath.values.arrays.jax_values import is_traced
from optipath.values.arrays.read_only import same_fields
from optipath.values.cures import cure
from optipath.values.database.named_parts import parts_by_name, parts_of_file
from optipath.values.domains.domain import Domain
from optipath.values.made import make_sound
from optipath.values.parameters import Parameter
from optipath.values.units import parse_quantity

if TYPE_CHECKING:
    from os import PathLike


class _Part(Domain):
    """One of the two numbers of an index."""

    def parse(self, text: str) -> Any:
        return index_of(text)

    def _check_numbers(self, owner: str, array: Any, rounding: float) -> None:
        if array.dtype.kind == "c":
            raise ValueFault(f"{owner} is complex; give n and k apart, such as {_gold()}")
        super()._check_numbers(owner, array, rounding)


def index_of(text: str, asked: str = "") -> complex:
    """Return the number that a text stands for, which is no name of a material.

    Parameters
    ----------
    text : str
        What is given.
    asked : str, optional
        What to give in place of a name; n and k by default.

    Returns
    -------
    complex

    Raises
    ------
    UnitError
        If it stands for none.

    Examples
    --------
    >>> index_of("0.2+3.4j")
    (0.2+3.4j)
    """
    if text.strip()[:1].isalpha():
        asked = asked or f"n and k as numbers, such as {_gold()}"
        raise UnitError(f"'{text}' is no number; give {asked}")
    return parse_quantity(text, "")


def _gold() -> str:
    return cure("Material(0.18, 3.4)", "{ n = 0.18, k = 3.4 }")


N = _Part("index of refraction", minimum=0.0)
K = _Part("extinction coefficient", minimum=0.0)
_PARTS = {"n": N, "k": K}


@dataclass(frozen=True, eq=False)
class Material:
    """A homogeneous medium, given by its complex index of refraction n + ik.

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

    n: Any
    k: Any = 0.0

    def __post_init__(self) -> None:
        make_sound(
            self, _PARTS, lambda: [(name, getattr(self, name), of) for name, of in _PARTS.items()]
        )

    @property
    def refractive_index(self) -> Any:
        """The index n + ik as one number, or an array of these; real where nothing absorbs.

        Raises
        ------
        ParameterError
            If n or k is a parameter, and not known yet.

        Examples
        --------
        >>> Material(0.608, 2.12).refractive_index
        (0.608+2.12j)
        """
        for name in _PARTS:
            if isinstance(part := getattr(self, name), Parameter):
                raise ParameterError(
                    f"{name} of a Material is the parameter '{part.name}', which is not known yet; "
                    f"let the Material itself stand in the path"
                )
        without = not is_traced(self.k) and not np.any(self.k)
        return self.n if without else self.n + 1j * self.k

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

    __eq__ = same_fields
    __hash__ = None  # type: ignore[assignment]

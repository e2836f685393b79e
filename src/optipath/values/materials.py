"""Material: what an interface separates the light from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from optipath.errors import ParameterError, UnitError, ValueFault, shown
from optipath.values.arrays.jax_values import is_traced
from optipath.values.arrays.read_only import same, same_fields
from optipath.values.arrays.shapes import broadcast_fault
from optipath.values.cures import cure
from optipath.values.curves.curve_value import CurveValue
from optipath.values.curves.material_formulas import MaterialFormulas
from optipath.values.curves.material_tables import MaterialTables
from optipath.values.curves.wavelength_range import span_text
from optipath.values.database.material_pages import MaterialPages
from optipath.values.domains.domain import Domain
from optipath.values.made import make_sound
from optipath.values.parameters import Parameter
from optipath.values.units import parse_quantity


class _Part(Domain):
    """One of the two numbers of an index."""

    def parse(self, text: str) -> Any:
        return index_of(text)

    def described(self) -> str:
        above = self.minimum > 0.0
        return f"a real {self.name} above 0 where k is 0" if above else super().described()

    def _check_numbers(self, owner: str, array: Any, rounding: float) -> None:
        if array.dtype.kind == "c":
            raise ValueFault(f"{owner} is complex; give n and k apart, such as {_gold()}")
        super()._check_numbers(owner, array, rounding)


def _number(value: Any) -> Any:
    """Return a known number, or an array of them; None for anything else."""
    value = value.placed(value.default) if isinstance(value, Parameter) and value.bound else value
    plain = isinstance(value, (int, float, np.ndarray, np.number)) and not is_traced(value)
    array = np.asarray(value if plain else "")
    return array if array.dtype.kind in "biuf" else None


def index_of(text: str, asked: str = "") -> complex:
    """Return the number that a text stands for, which is no name of a material.

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
LEAST = float(np.finfo(float).tiny)
"""The least n of a medium that does not absorb; where n is 0, k is above 0."""
N_OF_CLEAR = _Part("index of refraction", minimum=LEAST)
_PARTS = {"n": N, "k": K}


@dataclass(frozen=True, eq=False)
class Material(MaterialTables, MaterialFormulas, MaterialPages):
    """A homogeneous medium, given by its complex index of refraction n + ik.

    Both may follow from the wavelength: `Material.tabulated`, `from_csv`, `sellmeier`, `cauchy`,
    `drude_lorentz`, `tauc_lorentz`, `named` and `from_yaml` make such ones, and `at` tells what
    they are there.

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
        parts = lambda: [("n", self.n, self.domain_of_n), ("k", self.k, K)]  # noqa: E731
        make_sound(self, _PARTS, parts, of_fields=False)

    @property
    def domain_of_n(self) -> Domain:
        """What n may be: 0 only where k is above 0, or not known yet."""
        if (k := _number(self.k)) is None:
            return N
        if not np.any(k):
            return N_OF_CLEAR
        if (n := _number(self.n)) is None or broadcast_fault({"n": n.shape, "k": k.shape}):
            return N
        return N_OF_CLEAR if np.any((n == 0.0) & (k == 0.0)) else N

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
            if isinstance(part := getattr(self, name), CurveValue):
                raise ParameterError(
                    f"{part.spoken} depends on the wavelength; give .at('550 nm'), or let the "
                    f"Material itself stand in the path"
                )
            if isinstance(part, Parameter):
                raise ParameterError(
                    f"{name} of a Material is the parameter '{part.name}', which is not known yet; "
                    f"let the Material itself stand in the path"
                )
        without = not is_traced(self.k) and not np.any(self.k)
        return self.n if without else self.n + 1j * self.k

    def at(self, wavelength: Any) -> Material:
        """Return what it is at a wavelength: a constant material.

        Parameters
        ----------
        wavelength : float, str or array_like
            In vacuum, in metres, or texts such as ``"516 nm"`` and ``"2.4 eV"``.

        Returns
        -------
        Material
            With arrays where several are given; itself where it does not depend on it.

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

    def __repr__(self) -> str:
        n, k = self.n, self.k
        if isinstance(n, CurveValue):
            alike = k.curve == n.curve if isinstance(k, CurveValue) else same(k, 0.0)
            if alike:
                return f"Material {shown(n.curve.label)}, {span_text(self.span)}"
        return f"Material(n={_written(n)}, k={_written(k)})"

    __eq__ = same_fields
    __hash__ = None  # type: ignore[assignment]


def _written(part: Any) -> str:
    return part.formula_of(shown(part.spoken)[1:-1]) if isinstance(part, CurveValue) else repr(part)

"""Which index each medium of a sample may have, and what is kept of it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from optipath.errors import SurfaceError, ValueFault, shown
from optipath.values.arrays.jax_values import is_traced
from optipath.values.cures import cure
from optipath.values.curves.curve_value import CurveValue
from optipath.values.domains.indices import IndexDomain, LitBehind
from optipath.values.domains.no_absorption import NoAbsorption
from optipath.values.made import faults_of
from optipath.values.materials import Material
from optipath.values.parameters import Parameter
from optipath.values.use import Use
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.values.domains.domain import Domain

_NAME = "index of refraction"


class ClearMediumDomain(LitBehind):
    """Positive real numbers: light goes to and fro in a medium above the last."""

    of_k: ClassVar[NoAbsorption] = NoAbsorption(
        "extinction coefficient", why=", since only the last medium may absorb"
    )

    def described(self) -> str:
        return (
            f"a real index of refraction within {self.minimum:g} .. {self.maximum:g}, since only "
            f"the last medium may absorb"
        )

    def _check_numbers(self, owner: str, array: npt.NDArray[Any], rounding: float) -> None:
        if np.any(array.imag):
            raise ValueFault(f"{owner} is {array[()]}, which absorbs; give {self.described()}")
        super()._check_numbers(owner, array, rounding)


class BaseDomain(IndexDomain):
    """Complex numbers n + ik other than 0, n and k not negative: the medium of the base."""

    def quickly_allows(self, value: Any) -> bool:
        return super().quickly_allows(value) and value != 0.0

    def described(self) -> str:
        return "an index of refraction n + ik with n and k not negative, and one of them above 0"

    def allows(self, numbers: Any) -> Any:
        return super().allows(numbers) & (numbers != 0.0)


# Limits as a stack of smooth layers has them.
CLEAR_MEDIUM = ClearMediumDomain(_NAME, minimum=1e-60, maximum=1e60)
BASE = BaseDomain(_NAME)


def medium_of(owner: str, value: Any, domain: Domain) -> float | complex | Material:
    """Return a medium as a sample keeps it.

    Examples
    --------
    >>> medium_of("outside", Material(1.5), CLEAR_MEDIUM), medium_of("base", "0.5+2.1j", BASE)
    (1.5, (0.5+2.1j))
    """
    if faults := _open_faults(owner, value):
        raise SurfaceError(*faults)
    if isinstance(value, Material) and depends_on_wavelength(value):
        if faults := faults_of([Use(*place) for place in domain.parts(owner, value)]):
            raise SurfaceError(*faults)
        return value
    several = isinstance(value, (list, tuple)) or is_traced(value)
    array = None if several else domain.check(owner, value)
    if array is None or array.ndim:
        raise SurfaceError(
            f"{owner} is {shown(value)}, but a sample has one index there; give one, such as "
            f"{cure('1.5 or 0.5+2.1j', '1.5 or { n = 0.5, k = 2.1 }')}, and make a sample for each"
        )
    number = complex(array)
    return number if number.imag else number.real


def depends_on_wavelength(medium: Any) -> bool:
    """Tell whether n or k of a medium follows from a curve."""
    return isinstance(medium, Material) and any(
        isinstance(part, CurveValue) for part in (medium.n, medium.k)
    )


def _open_faults(owner: str, value: Any) -> list[str]:
    """Return a sentence for each parameter that a medium follows from."""
    parts = [value.n, value.k] if isinstance(value, Material) else [value]
    names = dict.fromkeys(name for part in parts for name in _open_names(part))
    return [
        f"{owner} follows from the parameter '{name}'; give numbers, or a Material that follows "
        f"from the wavelength alone, made without wavelength=..."
        for name in names
    ]


def _open_names(part: Any) -> list[str]:
    """Return the parameters that a number follows from, but for the usual wavelength."""
    given_by = part.given_by if isinstance(part, CurveValue) else (part,)
    return [one.name for one in given_by if isinstance(one, Parameter) and one != Wavelength()]

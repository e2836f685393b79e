"""What is given of a boundary by itself, outside of any path: its media and an angle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ValueFault
from optipath.kernels.numbers.circular import cosine, sine
from optipath.values.angles import CosSin, is_angle, within_right_angle
from optipath.values.arrays.array_likes import as_given
from optipath.values.arrays.jax_values import is_traced, namespace
from optipath.values.arrays.kernel_values import kernel_values
from optipath.values.arrays.shapes import check_broadcast, first_place
from optipath.values.domains.domain import Domain
from optipath.values.domains.indices import INDEX, LIT_INDEX
from optipath.values.domains.quantities import INCIDENCE

if TYPE_CHECKING:
    from optipath.kernels.numbers.primitives import KernelFunction, Primitives

COSINE = Domain("cosine or sine", minimum=0.0, maximum=1.0)
_APART, _GRAZING = 1e-6, 2.0**-60


def given_index(name: str, value: Any, *, lit: bool = False) -> Any:
    """Return an index of refraction n + ik; NaN where JAX traces what is none."""
    return number_within(LIT_INDEX if lit else INDEX, name, value)


def number_within(domain: Domain, name: str, value: Any) -> Any:
    """Return a value that a domain allows; NaN where it does not and JAX traces the value."""
    numbers = domain.check(name, value)
    if not is_traced(numbers):
        return numbers
    return namespace(numbers).where(domain.allows(numbers), numbers, np.nan)


def given_cosine_and_sine(cos: Any, sin: Any) -> tuple[Any, Any]:
    """Return the cosine and the sine of an incidence; NaN where JAX traces what is no angle."""
    cos, sin = _given("cos_incidence", cos), _given("sin_incidence", sin)
    check_broadcast({"cos_incidence": cos.shape, "sin_incidence": sin.shape})
    traced = is_traced(cos) or is_traced(sin)
    c = number_within(COSINE, "cos_incidence", cos if traced else within_right_angle(cos, sin))
    s = number_within(COSINE, "sin_incidence", sin)
    if traced:
        xp = namespace(c if is_traced(c) else s)
        belong = xp.abs(xp.square(c) + xp.square(s) - 1.0) <= _APART
        return xp.where(belong, c, xp.nan), s
    if not is_angle(cos, sin):
        raise ValueFault("cos_incidence and sin_incidence belong to no angle: c^2 + s^2 is not 1")
    return c, s


def given_incidence(value: Any) -> tuple[Any, Any]:
    """Return the cosine and the sine of an incidence that is given as an angle, or a `CosSin`."""
    if isinstance(value, CosSin):
        return given_cosine_and_sine(value.cos, value.sin)
    angle = number_within(INCIDENCE, "incidence", value)
    check_broadcast({"incidence": angle.shape})
    cos, sin = kernel_values(_cosine_and_sine, angle)
    return cos, sin


def arriving_cosine(cos: Any, k1: Any) -> Any:
    """Return the cosine of the angle at which light arrives out of a medium with k = k1.

    At a right angle light arrives out of media that do not absorb alone: the wave along the face
    grows without limit next to it, and has none that they would share.
    """
    none = (k1 > 0.0) & (cos <= _GRAZING)
    if is_traced(none):
        return namespace(none).where(none, np.nan, cos)
    if np.any(none):
        raise ValueFault(
            f"incidence{first_place(none)} is a right angle out of a medium that absorbs, where "
            f"there is no such wave; give a smaller one, or an outside without k"
        )
    return cos


def parts_of(index: Any) -> tuple[Any, Any]:
    """Return n and k of indices, of which neither is -0."""
    if index.dtype.kind != "c":
        return index, np.zeros(())
    return index.real + 0.0, index.imag + 0.0


def _given(name: str, value: Any) -> Any:
    return value if is_traced(value) else as_given(name, COSINE.read(name, value))


def _cosine_and_sine(xp: Primitives) -> KernelFunction:
    of_cos, of_sin = cosine(xp), sine(xp)
    return lambda angle: (of_cos(angle), of_sin(angle))

"""Dichroism and retardance at once: the exponential of what a pure homogeneous medium does.

Per length, it does F = [[0, p], [p, [q]x]] to Stokes vectors, with a dichroism p = (p1, p2, p3),
linear along x, linear at 45 degrees and circular, a retardance q = (q1, q2, q3) likewise, and
[q]x v = q x v: the algebra of the Lorentz group (R. C. Jones, J. Opt. Soc. Am. 38, 671 (1948);
Azzam, J. Opt. Soc. Am. 68, 1756 (1978)).

Its Jones matrix is exp(g . sigma) = cosh T + (sinh T / T) g . sigma, with g = (p - iq) / 2,
T^2 = g . g, and Pauli's matrices in the order of Stokes' components.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.kernels.geometry.vectors import cross, dot, plus, times
from optipath.kernels.numbers.circular import cosine, sine
from optipath.kernels.numbers.complex_pairs import hypotenuse
from optipath.kernels.numbers.hyperbolic import scaled_hyperbolic
from optipath.kernels.numbers.norms import common_size
from optipath.kernels.numbers.vanishing import products

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from optipath.kernels.geometry.vectors import Vector
    from optipath.kernels.numbers.primitives import KernelFunction, Primitives

_FAR = 2.0**60
"""With what half a retardance no light is left where T is small beside it."""

_COSH = (2.0, 12.0, 30.0, 56.0, 90.0, 132.0, 182.0, 240.0)
_SINHC = (6.0, 20.0, 42.0, 72.0, 110.0, 156.0, 210.0, 272.0)
"""By what the terms of cosh T and of sinh T / T, as series in T^2, are less each time."""


def lorentz(xp: Primitives) -> KernelFunction:
    """Make ``(p1, p2, p3, q1, q2, q3, shift) ->`` the sixteen numbers of exp(F) exp(-shift).

    With a shift of |p|, it lets all through of one state of light at most.
    """
    parts, matrix = xp.apart(_parts(xp)), xp.apart(_mueller)
    return lambda *generator_and_shift: matrix(*parts(*generator_and_shift))


def retardance(xp: Primitives) -> KernelFunction:
    """Make ``(q1, q2, q3) ->`` the sixteen numbers of a rotation of the sphere (Rodrigues)."""
    exponential = lorentz(xp)

    def rotate(q1: Any, q2: Any, q3: Any) -> tuple[Any, ...]:
        # No light is lost, not even by a rounding.
        _, *rest = exponential(0.0, 0.0, 0.0, q1, q2, q3, 0.0)
        return 1.0, *rest

    return rotate


def _parts(xp: Primitives) -> KernelFunction:
    """Make what `_mueller` takes of the generator."""
    near, far, size_of = _near(xp), _far(xp), common_size(xp)
    where, absolute, sqrt = xp.where, xp.absolute, xp.sqrt

    def numbers(*generator_and_shift: Any) -> tuple[Any, ...]:
        *generator, shift = generator_and_shift
        size = size_of(*generator)
        near_one = tuple(part / size for part in generator)
        n, m = near_one[:3], near_one[3:]
        # T = size / 2 sqrt(a + 2ib).
        a, b = dot(n, n) - dot(m, m), -dot(n, m)
        small = sqrt(absolute(a) + 2.0 * absolute(b)) * size < 1.0
        pairs = zip(near(a, b, size, shift, small), far(a, b, size, shift, small), strict=True)
        return *near_one, *(where(small, one, other) for one, other in pairs)

    return numbers


def _near(xp: Primitives) -> Callable[..., tuple[Any, Any, Any, Any]]:
    """Make what `_mueller` takes, by series in T^2, for |T| up to a half."""
    where, exp, minimum = xp.where, xp.exp, xp.minimum

    def series(x: Any, y: Any, divisors: Sequence[float]) -> tuple[Any, Any]:
        real, imaginary = 1.0, 0.0
        for divisor in reversed(divisors):
            real, imaginary = (
                1.0 + (x * real - y * imaginary) / divisor,
                (x * imaginary + y * real) / divisor,
            )
        return real, imaginary

    def numbers(a: Any, b: Any, size: Any, shift: Any, small: Any) -> tuple[Any, Any, Any, Any]:
        half = minimum(0.5 * size, _FAR)
        square = half * half
        x, y = where(small, square * a, 0.0), where(small, 2.0 * square * b, 0.0)
        (ur, ui), (kr, ki) = series(x, y, _COSH), series(x, y, _SINHC)
        left = exp(-shift)
        along, across = ur * kr + ui * ki, ur * ki - ui * kr
        u, k = ur * ur + ui * ui, square * (kr * kr + ki * ki)
        return left * u, left * k, left * half * along, left * half * across

    return numbers


def _far(xp: Primitives) -> Callable[..., tuple[Any, Any, Any, Any]]:
    """Make what `_mueller` takes, by hyperbolic and circular functions of 2T."""
    where, exp, sqrt, absolute = xp.where, xp.exp, xp.sqrt, xp.absolute
    hyperbolic, sin, cos = scaled_hyperbolic(xp), sine(xp), cosine(xp)
    length = hypotenuse(xp)

    def numbers(a: Any, b: Any, size: Any, shift: Any, small: Any) -> tuple[Any, Any, Any, Any]:
        a, b = where(small, 1.0, a), where(small, 0.0, b)
        forward = a >= 0.0
        absolute_a = where(forward, a, -a)
        square = length(absolute_a, 2.0 * absolute(b))
        larger = sqrt(0.5 * (absolute_a + square))
        smaller = b / larger
        x, y = where(forward, larger, smaller), where(forward, smaller, larger)
        limited = where(small, 0.0, size)
        ch, sh = hyperbolic(limited * x, where(small, 0.0, shift))
        left = where(small, 1.0, exp(-shift))
        c, s = left * cos(limited * y), left * sin(limited * y)
        half = 0.5 / square
        return 0.5 * (ch + c), half * (ch - c), half * (sh * x + s * y), half * (s * x - sh * y)

    return numbers


def _mueller(*parts: Any) -> tuple[Any, ...]:
    """Return the Mueller matrix of the Jones matrix U + K (n - im) . sigma.

    It takes n, m, |U|^2, |K|^2, and the two parts of conj(U) K.
    """
    n, m, (u, k, along, across) = parts[:3], parts[3:6], parts[6:]
    weight = k * (dot(n, n) + dot(m, m))
    rest = u - weight
    filtering = _mixed(2.0 * along, n, 2.0 * across, m)
    x, y, z = _mixed(2.0 * along, m, -2.0 * across, n)
    turning = (rest, -z, y), (z, rest, -x), (-y, x, rest)
    odd = times(2.0 * k, cross(n, m))
    rows = [u + weight, *plus(filtering, odd)]
    for row in range(3):
        mixing = _mixed(2.0 * k * n[row], n, 2.0 * k * m[row], m)
        rows += [filtering[row] - odd[row], *plus(turning[row], mixing)]
    return tuple(rows)


def _mixed(a: Any, n: Vector, b: Any, m: Vector) -> Vector:
    """Return a n + b m, without the products that have a plain 0 for a factor."""
    x, y, z = (products((a, i), (b, j)) for i, j in zip(n, m, strict=True))
    return x, y, z

"""Homogeneous media: dichroism, retardance and depolarization at once, per meter.

Per length, it does F = [[0, p], [p, [q]x]] to Stokes vectors, with a dichroism p = (p1, p2, p3),
linear along x, linear at 45 degrees and circular, a retardance q = (q1, q2, q3) likewise, and
[q]x v = q x v: the algebra of the Lorentz group (R. C. Jones, J. Opt. Soc. Am. 38, 671 (1948);
Azzam, J. Opt. Soc. Am. 68, 1756 (1978)).

Its Jones matrix is exp(g . sigma) = cosh T + (sinh T / T) g . sigma, with g = (p - iq) / 2,
T^2 = g . g, and Pauli's matrices in the order of Stokes' components.

What depolarises per length, diag(0, -d, -d, -d), does not commute with dichroism, so that the
exponential has no closed form of `lorentz`'s kind. By Cayley and Hamilton, exp(X) is a polynomial
of X of the third degree: powers of X are what its characteristic polynomial leaves of them. The
series of a small part of X is so squared again and again (Higham, Functions of Matrices (2008),
sec. 4.5 and 10.3), as exp - 1 in place of exp, so that small products keep their digits.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

from optipath.kernels.exponential import scaled_hyperbolic
from optipath.kernels.filters import diagonal, retarder, turn
from optipath.kernels.primitives import products
from optipath.kernels.trigonometry import cosine, sine
from optipath.kernels.vectors import common_size, cross, dot, hypotenuse, norm, plus, times

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from optipath.kernels.primitives import Factory, KernelFunction, Primitives
    from optipath.kernels.vectors import Vector


_LEAST = 2.0**-53
"""What a number times this underflows to 0 is close to where digits get lost."""


def absorption(xp: Primitives, *, share: float, dichroic: bool) -> KernelFunction:
    """Make ``(absorption, [dichroism, circular dichroism,] length) -> (t,)``, by Beer and Lambert.

    Over a share of the length, and 0 where digits would underflow; beside dichroism, it is what the
    least absorbed of all states keeps (see `_excess` for its slopes).
    """
    left, excess, where, fixed = _left(xp), _excess(xp), xp.where, xp.fixed

    def attenuate(absorption: Any, length: Any) -> tuple[Any]:
        return (left(share * (absorption * length)),)

    def attenuate_least(absorption: Any, linear: Any, circular: Any, length: Any) -> tuple[Any]:
        least = absorption - excess(linear, circular)
        # A rounding below 0 is taken away from itself, so that its slope stays.
        return attenuate(least - where(least < 0.0, fixed(least), 0.0), length)

    return attenuate_least if dichroic else attenuate


def _left(xp: Primitives) -> Callable[[Any], Any]:
    """Make ``depth -> exp(-depth)``, 0 where that has lost digits."""
    exp, where = xp.exp, xp.where

    def left(depth: Any) -> Any:
        t = exp(-depth)
        return where(t * _LEAST > 0.0, t, 0.0)

    return left


def _excess(xp: Primitives) -> Callable[..., Any]:
    """Make ``(dichroism, ...) ->`` by how much the mean of all states is absorbed more per metre.

    It is taken out of the absorption and put back with the dichroism, which scales both by what
    cancels: a constant for slopes, as its own has a jump where there is no dichroism.
    """
    size, fixed = norm(xp), xp.fixed
    return lambda *dichroism: fixed(size(*dichroism))


def along(factory: Factory, xp: Primitives) -> KernelFunction:
    """Make ``(rate, length) -> numbers`` of a kernel that takes their product."""
    kernel = factory(xp)
    return lambda rate, length: kernel(rate * length)


def dichroism_along(xp: Primitives) -> KernelFunction:
    """Make ``(dichroism, retardance, length) -> (Fs, Fp, B, C, S)``, both along x.

    All are scaled, so that light along the axis that absorbs less keeps all.
    """
    retard, hyperbolic, left, excess = retarder(xp), scaled_hyperbolic(xp), _left(xp), _excess(xp)

    def filtered(dichroism: Any, retardance: Any, length: Any) -> tuple[Any, ...]:
        along = dichroism * length
        size = excess(dichroism) * length
        half = left(size)
        _, _, _, c, s = retard(retardance * length)
        _, difference = hyperbolic(along, size)
        return left(size - along), left(size + along), difference, half * c, half * s

    return filtered


def depolarization_along(xp: Primitives) -> KernelFunction:
    """Make ``(depolarization, length) ->`` the sixteen numbers of diag(1, t, t, t)."""
    exp = xp.exp
    return lambda depolarization, length: diagonal(exp(-(depolarization * length)))


def dichroism_and_retardance_along(xp: Primitives) -> KernelFunction:
    """Make the function of all that a pure medium does at once, the fast axis along x.

    ``(dichroism, circular dichroism, retardance, rotation, dichroic angle, angle, length)`` to the
    sixteen numbers, scaled so that light absorbed least keeps all.
    """
    generator, exponential, excess = _generator(xp), lorentz(xp), _excess(xp)
    return lambda *rates: exponential(*generator(*rates), excess(*rates[:2]) * rates[-1])


def depolarizing_dichroism_along(xp: Primitives) -> KernelFunction:
    """Make the same with the depolarisation as one more argument, the first."""
    generator, exponential, excess = _generator(xp), depolarizing_lorentz(xp), _excess(xp)

    def depolarize(depolarization: Any, *rates: Any) -> tuple[Any, ...]:
        lost, shift = depolarization * rates[-1], excess(*rates[:2]) * rates[-1]
        return exponential(*generator(*rates), lost, shift)

    return depolarize


def _generator(xp: Primitives) -> KernelFunction:
    """Make the six numbers that `lorentz` takes of what is given per metre."""
    turned = turn(xp)

    def of_rates(*rates: Any) -> tuple[Any, ...]:
        linear, circular, retardance, rotation, dichroic_angle, angle, length = rates
        cos, sin = turned(dichroic_angle - angle)
        along, q3 = linear * length, 2.0 * (rotation * length)
        return along * cos, along * sin, circular * length, retardance * length, 0.0, q3

    return of_rates


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
    # No light is lost, not even by a rounding.
    return lambda q1, q2, q3: (1.0, *exponential(0.0, 0.0, 0.0, q1, q2, q3, 0.0)[1:])


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
            along, across = x * real - y * imaginary, x * imaginary + y * real
            real, imaginary = 1.0 + along / divisor, across / divisor
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


Polynomial: TypeAlias = "Sequence[Any]"
"""Four numbers, as `_Ring` has them."""

LARGEST, LARGEST_DICHROISM = 200.0, 80.0
"""How large |p| + |q| + d may be, and |p| of it: exp(80) is a number in float32, too."""

_SQUARINGS, _TERMS = 10, 12


def depolarizing_lorentz(xp: Primitives) -> KernelFunction:
    """Make ``(p1, p2, p3, q1, q2, q3, d, shift) ->`` exp(F - diag(0, d, d, d) - shift).

    The sixteen numbers, with the F of `lorentz`; |p| + |q| + d <= `LARGEST`.
    """
    size_of, exp = common_size(xp), xp.exp
    polynomial, times = xp.apart(_polynomial), xp.apart(_times)

    def exponential(*generator_and_shift: Any) -> tuple[Any, ...]:
        *generator, shift = generator_and_shift
        size = size_of(*generator)
        p1, p2, p3, q1, q2, q3, d = (number / size for number in generator)
        x = (0.0, p1, p2, p3, p1, -d, -q3, q2, p2, q3, -d, -q1, p3, -q2, q1, -d)
        square = times(*x, *x)
        cube = times(*x, *square)
        p, q = (p1, p2, p3), (q1, q2, q3)
        P, Q = dot(p, p), dot(q, q)
        less_one, a, b, c = polynomial(size, P, Q, dot(p, q), d)
        left = exp(-shift)
        results = (
            products((a, one), (b, two), (c, three + (Q - P) * one))
            for one, two, three in zip(x, square, cube, strict=True)
        )
        return tuple(
            left * (1.0 + (less_one + entry) if place % 5 == 0 else entry)
            for place, entry in enumerate(results)
        )

    return exponential


def _polynomial(size: Any, P: Any, Q: Any, R: Any, d: Any) -> Polynomial:
    """Return the polynomial of X that is exp(size X) - 1, by |p|^2, |q|^2, p . q and d."""
    # det(x - X) = x y (y^2 + Q) - P y^2 - R^2 with y = x + d.
    square = d * d
    law = P * square + R * R, d * (Q - P + Q - square), -3.0 * square, -3.0 * d
    ring = _Ring(Q - P, law)
    part = size * 2.0**-_SQUARINGS
    series: Polynomial = (1.0, 0.0, 0.0, 0.0)
    for term in range(_TERMS, 1, -1):
        a, b, c, e = (part / term * number for number in ring.once_more(series))
        series = (1.0 + a, b, c, e)
    less_one: Polynomial = [part * number for number in ring.once_more(series)]
    for _ in range(_SQUARINGS):
        square = ring.squared(less_one)
        less_one = [2.0 * e + f for e, f in zip(less_one, square, strict=True)]
    return tuple(less_one)


class _Ring:
    """Polynomials of X as the coefficients of 1, X, X^2 and V = X^3 + k X, k = |q|^2 - |p|^2.

    V is 0 where nothing depolarises and p . q is 0, so that its coefficient, which is large
    where X turns light far, does no harm.
    """

    def __init__(self, k: Any, first: Polynomial) -> None:
        self.k = k
        self.first = first
        self.second = self.once_more(first)
        self.third = self.once_more(self.second)

    def once_more(self, polynomial: Polynomial) -> Polynomial:
        """Return X times a polynomial."""
        a, b, c, e = polynomial
        return _sum((0.0, a - self.k * c, b, c), (e, self.first))

    def squared(self, polynomial: Polynomial) -> Polynomial:
        """Return the square of a polynomial."""
        a, b, c, e = polynomial
        whole = (
            a * a,
            2.0 * b * (a - self.k * c),
            2.0 * a * c + b * b - self.k * (c * c),
            2.0 * (a * e + b * c),
        )
        once = 2.0 * b * e + c * c + self.k * (e * e)
        return _sum(whole, (once, self.first), (2.0 * c * e, self.second), (e * e, self.third))


def _sum(polynomial: Polynomial, *others: tuple[Any, Polynomial]) -> Polynomial:
    """Return a polynomial and multiples of others, together."""
    for factor, other in others:
        polynomial = [a + factor * b for a, b in zip(polynomial, other, strict=True)]
    return polynomial


def _times(*numbers: Any) -> tuple[Any, ...]:
    """Return the product of two matrices, their numbers one after the other."""
    one, other = numbers[:16], numbers[16:]
    return tuple(
        products(*zip(one[row : row + 4], other[column::4], strict=True))
        for row in range(0, 16, 4)
        for column in range(4)
    )

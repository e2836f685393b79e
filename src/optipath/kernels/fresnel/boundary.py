"""The boundary of two media: incident and refracted wave, absorbing or not.

Light that has come into an absorbing medium by a smooth face has its planes of constant
amplitude parallel to that face, and the wave along the face is real (Born & Wolf, Principles of
Optics, sec. 14.2). So it is at every face that is parallel to the first.
"""

from __future__ import annotations

from functools import wraps
from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.kernels.vectors import brought_near_one, complex_root, from_within, hypotenuse

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.primitives import Factory, KernelFunction, Primitives


LOST = -1.0
"""What n^2 - y^2 is taken for where all has been reflected before: all is reflected here, too."""


class Slant(NamedTuple):
    """How r_p differs from r_s: by z and g1 g2, all of it divided by n1."""

    z: Any
    re: Any
    im: Any
    z2: Any
    g2: Any
    q: Any

    @property
    def less(self) -> Any:
        """|z - c g|^2, which over q is |r_p / r_s|^2."""
        return (self.z - self.re) * (self.z - self.re) + self.im * self.im


class Boundary(NamedTuple):
    """What reflection and transmission are made of.

    Indices are divided by a power of two near the largest: no square overflows, and ratios stay.
    """

    p: Any
    a: Any
    b: Any
    squared: Any
    D: Any
    v: Any
    s: Any
    c: Any
    n1: Any
    n: Any
    k: Any

    @property
    def squares(self) -> tuple[Any, Any]:
        """p^2 + |g|^2 and 2 Re(p conj g)."""
        return self.p * self.p + self.squared, 2.0 * self.p * self.a

    def slant(self, _: Callable[..., Any]) -> Slant:
        """Return how the two polarisations differ, with c = p / n1 in place of g1 / n1."""
        z, re, im = self.n1 * (self.s * self.s), self.c * self.a, self.c * self.b
        z2, g2 = z * z, self.c * self.c * self.squared
        return Slant(z, re, im, z2, g2, (z2 + g2) + 2.0 * z * re)


def absorbing_boundary(xp: Primitives) -> Callable[..., Boundary]:
    """Make ``(n1, n, k, [n0,] cos, sin) -> Boundary``.

    The angle is in the medium n1, or in a medium n0 before parallel boundaries.
    """
    wave, root = absorbing_wave(xp), complex_root(xp)

    def boundary(n1: Any, n: Any, k: Any, *angle: Any) -> Boundary:
        n1, n, k, c, s, p, D, u = wave(n1, n, k, *angle)
        a, b, squared = root(u, n, k)
        return Boundary(p, a, b, squared, D, 2.0 * n * k, s, c, n1, n, k)

    return boundary


def absorbing_wave(xp: Primitives) -> KernelFunction:
    """Make ``(n1, n, k, [n0,] cos, sin) -> (n1, n, k, cos, sin, p, D, Re g^2)``.

    The indices come out divided; the angle is that in the medium n1.
    """
    divided, wave, absolute = brought_near_one(xp), _wave(xp), xp.absolute
    # Much nearer to its edge than the square of a cosine to its own: a medium without absorption
    # is one at grazing incidence, too.
    inside = from_within(xp, 6)

    def absorbing(n1: Any, n: Any, k: Any, *angle: Any) -> tuple[Any, ...]:
        *n0, c, s = angle
        # The absolute value makes -0 a 0.
        n1, n, k, *n0 = divided(n1, n, inside(absolute(k)), *n0)
        return n1, n, k, *wave(n1, n, k, *n0, c, s)

    return absorbing


def lossless_boundary(xp: Primitives) -> Callable[..., Boundary]:
    """Make ``(n1, n, [n0,] cos, sin) -> Boundary``, for media that absorb nothing."""
    wave = _lossless_wave(xp)
    sqrt, where, absolute = xp.sqrt, xp.where, xp.absolute

    def boundary(n1: Any, n: Any, *angle: Any) -> Boundary:
        n1, n, c, s, p, D, u = wave(n1, n, *angle)
        squared = absolute(u)
        size = sqrt(squared)
        forward = u >= 0.0
        a, b = where(forward, size, 0.0), where(forward, 0.0, size)
        return Boundary(p, a, b, squared, D, 0.0, s, c, n1, n, 0.0)

    return boundary


def denser_boundary(xp: Primitives) -> Callable[..., Boundary]:
    """Make ``(n1, n, [n0,] cos, sin) -> Boundary`` for n >= n1 without absorption.

    The same again, where nothing is reflected totally: Re g^2 is never negative.
    """
    sqrt, wave, lossless = xp.sqrt, _lossless_wave(xp), lossless_boundary(xp)

    def boundary(n1: Any, n: Any, *angle: Any) -> Boundary:
        if len(angle) > 2:
            # All may have been reflected before.
            return lossless(n1, n, *angle)
        n1, n, c, s, p, D, u = wave(n1, n, *angle)
        return Boundary(p, sqrt(u), 0.0, u, D, 0.0, s, c, n1, n, 0.0)

    return boundary


def _lossless_wave(xp: Primitives) -> KernelFunction:
    divided, wave = brought_near_one(xp), _wave(xp)

    def lossless(n1: Any, n: Any, *angle: Any) -> tuple[Any, ...]:
        *n0, c, s = angle
        n1, n, *n0 = divided(n1, n, *n0)
        return n1, n, *wave(n1, n, 0.0, *n0, c, s)

    return lossless


def _wave(xp: Primitives) -> KernelFunction:
    where, behind, inside = xp.where, refracted_wave(xp), from_within(xp)

    def wave(n1: Any, n: Any, k: Any, *angle: Any) -> tuple[Any, ...]:
        """Return the cosine and sine in n1, p, D = n^2 - k^2 - n1^2, and Re g^2."""
        k2 = k * k
        D = contrast(where, n1, n, k2)
        if len(angle) > 2:
            c, s, p, squared = behind(n1, n, *angle)
            return c, s, p, D, squared - k2
        c, s = inside(angle[0]), angle[1]
        p = n1 * c
        y = n1 * s
        # From whichever of cos and sin is small: that one carries the digits.
        return c, s, p, D, where(c < s, D + p * p, n * n - (y * y + k2))

    return wave


def contrast(where: Callable[..., Any], n1: Any, n: Any, loss: Any) -> Any:
    """Return n^2 - n1^2 - loss, with few roundings."""
    # Up to 2 n1, d is exact, and so is its product with n1 in front of vacuum.
    d = n - n1
    return where(d > n1, n * n - (n1 * n1 + loss), 2.0 * n1 * d + (d * d - loss))


def refracted_wave(xp: Primitives) -> KernelFunction:
    """Make ``(n1, n, n0, cos0, sin0) -> (cos, sin, p, n^2 - y^2)`` for the angle in n1.

    Parallel boundaries refract the light from n0 into n1; y = n0 sin0 is conserved.
    """
    sqrt, where, maximum, minimum = xp.sqrt, xp.where, xp.maximum, xp.minimum
    inside = from_within(xp)

    def refracted(n1: Any, n: Any, n0: Any, c0: Any, s0: Any) -> tuple[Any, ...]:
        along, y = squared_along_normal(xp, n0, inside(c0), s0)
        squared = along(n1)
        # Where all has been reflected before, there is no light, and any angle will do.
        p, missing = sqrt(maximum(squared, 0.0)), squared < 0.0
        return p / n1, minimum(y / n1, 1.0), p, where(missing, LOST, along(n))

    return refracted


def squared_along_normal(
    xp: Primitives, n0: Any, c0: Any, s0: Any
) -> tuple[Callable[[Any], Any], Any]:
    """Return ``n -> n^2 - y^2`` and the wave y = n0 sin0 along the face."""
    p0, y = n0 * c0, n0 * s0

    def along(m: Any) -> Any:
        return xp.where(c0 < s0, (m - n0) * (m + n0) + p0 * p0, (m - y) * (m + y))

    return along, y


_LEAST = 2.0**-60
"""The cosine next to grazing incidence, where there is a limit in one medium, and none in all."""


class InhomogeneousBoundary(NamedTuple):
    """What reflection and transmission need if the medium in front absorbs; as `Boundary`."""

    p: Any
    fades: Any
    c: Any
    e: Any
    s: Any
    kappa: Any
    a: Any
    b: Any
    squared: Any
    D: Any
    v: Any
    n1: Any
    n: Any
    k: Any

    @property
    def squares(self) -> tuple[Any, Any]:
        """|g1|^2 + |g2|^2 and 2 Re(g1 conj g2)."""
        even = (self.p * self.p + self.fades * self.fades) + self.squared
        return even, 2.0 * self.p * self.a + 2.0 * self.fades * self.b

    def slant(self, where: Callable[..., Any]) -> Slant:
        """Return how the two polarisations differ."""
        z = self.n1 * (self.s * self.s)
        re, im = self.c * self.a - self.e * self.b, self.c * self.b + self.e * self.a
        z2, g2 = z * z, (self.c * self.c + self.e * self.e) * self.squared
        # Where it cancels, next to a surface plasmon, it is a sum of squares.
        q = where(re < 0.0, (z + re) * (z + re) + im * im, (z2 + g2) + 2.0 * z * re)
        return Slant(z, re, im, z2, g2, q)

    def from_behind(self, where: Callable[..., Any]) -> InhomogeneousBoundary:
        """Return the same boundary as light from the other side meets it."""
        n = where(self.n > 0.0, self.n, 1.0)
        return InhomogeneousBoundary(
            self.a,
            self.b,
            self.a / n,
            self.b / n,
            self.n1 * self.s / n,
            self.k / n,
            self.p,
            self.fades,
            self.p * self.p + self.fades * self.fades,
            -self.D,
            -self.v,
            self.n,
            self.n1,
            self.n1 * self.kappa,
        )


def inhomogeneous_boundary(xp: Primitives) -> Callable[..., InhomogeneousBoundary]:
    """Make ``(n1, k1, n, k, [n0,] cos, sin) -> InhomogeneousBoundary``.

    The angle is that of the normal of constant phase in the medium in front, or one in a
    transparent medium n0 before parallel boundaries.
    """
    divided, root, inside = brought_near_one(xp), complex_root(xp), from_within(xp, 6)
    by_angle, refracted, absolute = inhomogeneous_wave(xp), _refracted(xp), xp.absolute
    where = xp.where

    def boundary(n1: Any, k1: Any, n: Any, k: Any, *angle: Any) -> InhomogeneousBoundary:
        *n0, cos, sin = angle
        # The absolute value makes -0 a 0.
        k1, k = inside(absolute(k1)), inside(absolute(k))
        n1, k1, n, k, *n0 = divided(n1, k1, n, k, *n0)
        k2 = k * k
        if n0:
            p, fades, s, squared = refracted(n1, k1, n, *n0, cos, sin)
            c, e, u = p / n1, fades / n1, squared - k2
        else:
            c, e, s = by_angle(n1, k1, cos, sin)
            p, fades, y = n1 * c, n1 * e, n1 * s
            # Re g2^2, from whichever of cos and sin is small: that one carries the digits.
            by_cos = contrast(where, n1, n, k2) + p * p - (fades - k1) * (fades + k1)
            u = where(c < s, by_cos, n * n - (y * y + k2))
        a, b, size = root(u, n, k)
        D = contrast(where, n1, n, (k - k1) * (k + k1))
        # Without the difference that n k - n1 k1 is.
        v = 2.0 * where(k1 > 0.0, (n - n1) * k + n1 * (k - k1), n * k)
        return InhomogeneousBoundary(p, fades, c, e, s, k1 / n1, a, b, size, D, v, n1, n, k)

    return boundary


def boundary_from_behind(xp: Primitives) -> Callable[..., InhomogeneousBoundary]:
    """Make the same of what `inhomogeneous_boundary` takes, as light from behind meets it."""
    boundary, where = inhomogeneous_boundary(xp), xp.where
    return lambda *argument: boundary(*argument).from_behind(where)


def inhomogeneous_wave(xp: Primitives) -> KernelFunction:
    """Make ``(n1, k1, cos, sin) -> (c, e, s)``, for the real angle in an absorbing medium.

    With the wave y = q sin along the face and g = q cos + ib along the normal, y^2 + g^2 =
    (n1 + ik1)^2 gives b = n1 k1 / (q cos) and q^2 = ((n1^2 - k1^2) + sqrt((n1^2 - k1^2)^2 +
    4 n1^2 k1^2 / cos^2)) / 2, which are Ketteler's equations (Born & Wolf, Principles of
    Optics, sec. 14.2, with the angle within). Here (q / n1)^2 - 1 is computed, without a
    difference: q is n1 where nothing absorbs. All three come out divided by n1: c + ie = g / n1,
    s = y / n1.
    """
    sqrt, where, inside = xp.sqrt, xp.where, from_within(xp)

    def wave(n1: Any, k1: Any, c: Any, s: Any) -> tuple[Any, Any, Any]:
        kappa, c = k1 / n1, inside(c)
        c = where((c > _LEAST) | (kappa == 0.0), c, _LEAST)
        across, far = kappa * s, (1.0 + kappa * kappa) * c
        size = sqrt(far * far + 4.0 * (across * across)) + far
        safe = where(c > 0.0, c, 1.0)
        rho = sqrt(1.0 + 2.0 * (across / safe) * (across / where(size > 0.0, size, 1.0)))
        normal = rho * c
        return normal, kappa / where(normal > 0.0, normal, 1.0), rho * s

    return wave


def phase_index(xp: Primitives) -> KernelFunction:
    """Make ``(n1, k1, cos, sin) -> (q,)``: the index by which Snell's law holds for real angles.

    A medium of index q without absorption, and the same angle in it, have the same wave along
    the face, q sin.
    """
    wave = inhomogeneous_wave(xp)

    def index(n1: Any, k1: Any, c: Any, s: Any) -> tuple[Any]:
        normal, _, along = wave(n1, k1, c, s)
        # Of the two ratios, that of the larger.
        near = c > s
        ratio = xp.where(near, normal, along) / xp.where(near, c, s)
        return (n1 * ratio,)

    return index


def real_index(_: Primitives) -> KernelFunction:
    """Make ``(n1, cos, sin) -> (n1,)``: the same where nothing absorbs."""
    return lambda n1, *_: (n1,)


def _refracted(xp: Primitives) -> KernelFunction:
    """Make ``(n1, k1, n, n0, cos0, sin0) -> (p, fades, s, Re g2^2 + k2^2)``."""
    where, minimum, root = xp.where, xp.minimum, complex_root(xp)
    inside = from_within(xp)

    def refracted(n1: Any, k1: Any, n: Any, n0: Any, c0: Any, s0: Any) -> tuple[Any, ...]:
        along, y = squared_along_normal(xp, n0, inside(c0), s0)
        squared, absorbs = along(n1), k1 > 0.0
        a, b, _ = root(squared - k1 * k1, n1, k1)
        # Where nothing absorbs and all has been reflected before, there is no light, and any
        # angle will do: the right one, as between media that do not absorb.
        missing = (squared < 0.0) & (k1 <= 0.0)
        s = y / n1
        s = where(absorbs, s, minimum(s, 1.0))
        return a, where(absorbs, b, 0.0), s, where(missing, LOST, along(n))

    return refracted


def refraction(xp: Primitives) -> KernelFunction:
    """Make ``(n1, n, k, cos, sin) -> (cos, sin)`` of the real angle of refraction.

    That is the angle at which planes of constant phase travel on: its tangent is n1 sin over
    the real part of g = sqrt(m2^2 - (n1 sin)^2) (Born & Wolf, Principles of Optics, sec. 14.2),
    which is Snell's law where nothing absorbs. Where all is reflected, it is a right angle.
    """
    boundary, where, length = absorbing_boundary(xp), xp.where, hypotenuse(xp)

    def refract(n1: Any, n: Any, k: Any, c: Any, s: Any) -> tuple[Any, Any]:
        at = boundary(n1, n, k, c, s)
        along = at.n1 * at.s
        size = length(along, at.a)
        there = size > 0.0
        size = where(there, size, 1.0)
        return where(there, at.a / size, 1.0), along / size

    return refract


def effective_index(xp: Primitives) -> KernelFunction:
    """Make ``(n1, k1, n, k, cos, sin) -> (n', k')`` of the wave behind a boundary.

    Its real wave vector is as long as n' = sqrt(y^2 + (Re g)^2), with y along the face, so that
    Snell's law holds with n' for the real angle; its imaginary one, along the normal, as long as
    k' = Im g. So n'^2 - k'^2 = n^2 - k^2 and n' k' cos(theta') = n k (Born & Wolf, Principles of
    Optics, sec. 14.2; P. E. Ciddor, Am. J. Phys. 44, 786 (1976)).
    """
    boundary, arriving, length = absorbing_boundary(xp), phase_index(xp), hypotenuse(xp)

    def index(n1: Any, k1: Any, n: Any, k: Any, c: Any, s: Any) -> tuple[Any, Any]:
        (q,) = arriving(n1, k1, c, s)
        at = boundary(q, n, k, c, s)
        # The indices are divided by a power of two there.
        divided = q / at.n1
        return divided * length(at.n1 * at.s, at.a), divided * at.b

    return index


def across(
    boundary: Callable[[Primitives], Callable[..., Any]],
    numbers: Callable[[Primitives], Callable[[Any], tuple[Any, ...]]],
    xp: Primitives,
) -> KernelFunction:
    """Make a kernel of a boundary, and of what becomes of light there."""
    at, becomes = boundary(xp), numbers(xp)
    return wraps(at)(lambda *argument: becomes(at(*argument)))


def refracting(factory: Factory, xp: Primitives) -> KernelFunction:
    """Make ``(n1, n, k, [n0,] cos, sin)``, of an angle before refraction, too."""
    kernel, refracted = factory(xp), refracted_wave(xp)

    def refract(n1: Any, n: Any, k: Any, *angle: Any) -> tuple[Any, ...]:
        if len(angle) > 2:
            angle = refracted(n1, n, *angle)[:2]
        return kernel(n1, n, k, *angle)

    return refract

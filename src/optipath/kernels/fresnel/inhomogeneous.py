"""The boundary of two media, of which that in front absorbs as well: its wave is inhomogeneous.

Light that has come into an absorbing medium by a smooth face has its planes of constant
amplitude parallel to that face, and the wave along the face is real (Born & Wolf, Principles of
Optics, sec. 14.2). So it is at every face that is parallel to the first.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.kernels.fresnel.boundary import LOST, contrast, squared_along_normal
from optipath.kernels.numbers.complex_pairs import brought_near_one, complex_root, from_within

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.numbers.primitives import KernelFunction, Primitives

_LEAST = 2.0**-60
"""The cosine next to grazing incidence, where there is a limit in one medium, and none in all."""


class InhomogeneousBoundary(NamedTuple):
    """What reflection and transmission are made of where the medium in front absorbs.

    Indices are divided by a power of two near the largest of them.
    """

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

    The angle is the real one in the medium in front, that of the normal to the planes of
    constant phase; or it is one in a medium n0 that does not absorb, from which parallel
    boundaries have refracted the light.
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


def real_index(xp: Primitives) -> KernelFunction:
    """Make ``(n1, cos, sin) -> (n1,)``: the same where nothing absorbs."""
    del xp
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
        lost = (squared < 0.0) & (k1 <= 0.0)
        s = y / n1
        s = where(absorbs, s, minimum(s, 1.0))
        return a, where(absorbs, b, 0.0), s, where(lost, LOST, along(n))

    return refracted

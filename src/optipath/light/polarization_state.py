"""What the numbers of a Stokes vector say of its ellipse, each angle in its own branch.

They are read off the vector over S0, so that light of any faintness will do. What light does not
have is NaN, as what is not known is: dark light has no degree of polarisation, unpolarised light no
ellipse, circular light no axis; nor has light of which the part in question is no more than noise.
Slopes that JAX takes are 0 there.
"""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.values.arrays.jax_values import is_traced, known, namespace

if TYPE_CHECKING:
    from optipath.values.roundings import Array


def ratio(part: Any, whole: Any) -> Any:
    """Return a part over the whole: 0 where that is 0, and NaN where it is infinite.

    Examples
    --------
    >>> ratio(np.array([1.0, 1.0, 1.0]), np.array([4.0, 0.0, np.inf]))
    array([0.25, 0.  ,  nan])
    """
    xp, dark = namespace(whole), whole == 0.0
    # What is not physical may run over, into infinity.
    with np.errstate(over="ignore", invalid="ignore"):
        known = part / xp.where(dark, 1.0, xp.where(xp.isinf(whole), np.nan, whole))
    return xp.where(dark, 0.0, known)


def length(*components: Any) -> Any:
    """Return the length of a vector from its components, however small; at 0 its slope is 0.

    Examples
    --------
    >>> print(length(np.float64(3e-200), np.float64(4e-200)))
    5e-200
    """
    return reduce(_hypotenuse, components)


@np.errstate(over="ignore")
def _hypotenuse(a: Any, b: Any) -> Any:
    xp = namespace(a)
    there = (a != 0.0) | (b != 0.0)
    return xp.where(there, xp.hypot(xp.where(there, a, 1.0), xp.where(there, b, 0.0)), 0.0)


def norm(vector: Array) -> Array:
    """Return the length along the last axis, however small; at 0 its slope is 0."""
    return length(*(vector[..., i] for i in range(vector.shape[-1])))  # type: ignore[no-any-return]


def direction(y: Any, x: Any) -> Any:
    """Return the angle from x to y in (-pi, pi], whatever signs zeros have; 0 where both are 0.

    Units: the result in radians.

    Examples
    --------
    >>> print(direction(np.float64(-0.0), np.float64(-1.0)).round(4))
    3.1416
    """
    xp = namespace(y)
    there = (x != 0.0) | (y != 0.0)
    angle = xp.arctan2(xp.where(there, y, 0.0), xp.where(there, x, 1.0))
    return xp.where(angle <= -np.pi, -angle, angle)


class PolarizationState:
    """What can be read off a Stokes vector, whatever its frame is."""

    mantissa: Array

    @property
    def _numbers(self) -> Array:
        """The mantissa, for NumPy unless JAX traces it."""
        return known(self.mantissa)  # type: ignore[no-any-return]

    @property
    def noise_floor(self) -> Array:
        """What of the mantissa is noise, of shape (...)."""
        raise NotImplementedError

    def _where_there(self, value: Any, *components: int) -> Array:
        """Return a value, NaN where light is dark, or has none of some components, for noise."""
        stokes, floor = self._numbers, self.noise_floor
        there = stokes[..., 0] > floor
        if components:
            there = there & (length(*(stokes[..., i] for i in components)) > floor)
        return _array(namespace(stokes).where(there, value, np.nan))

    @property
    def normalized(self) -> Array:
        """The Stokes vector over S0, of shape (..., 4), however faint; NaN where it is dark."""
        stokes = self._numbers
        there = (stokes[..., 0] > self.noise_floor)[..., np.newaxis]
        return namespace(stokes).where(there, self._shares, np.nan)  # type: ignore[no-any-return]

    @property
    def _shares(self) -> Array:
        """The Stokes vector over S0; 0 where that is 0."""
        stokes = self._numbers
        return ratio(stokes, stokes[..., :1])  # type: ignore[no-any-return]

    @property
    def _polarised(self) -> tuple[Array, Array, Array]:
        """S1, S2 and S3 over S0."""
        stokes = self._shares
        return stokes[..., 1], stokes[..., 2], stokes[..., 3]

    @property
    def _ellipse(self) -> tuple[Array, Array, Array]:
        """The same, 0 where they are no more than noise: what has no sign has no angle."""
        numbers, floor = self._numbers, self.noise_floor
        if is_traced(numbers):  # A slope is there also at 0.
            return self._polarised
        seen = np.where(np.abs(numbers) < floor[..., np.newaxis], 0.0, self._shares)
        return seen[..., 1], seen[..., 2], seen[..., 3]

    @property
    def dop(self) -> Array:
        """The degree of polarisation, of shape (...), however faint; NaN where it is dark."""
        return self._where_there(length(*self._polarised))

    @property
    def dolp(self) -> Array:
        """The degree of linear polarisation, hypot(S1, S2) / S0, shape (...); NaN where dark."""
        return self._where_there(length(*self._polarised[:2]))

    @property
    def docp(self) -> Array:
        """The signed degree of circular polarisation, S3 / S0, shape (...); NaN where dark."""
        return self._where_there(self._shares[..., 3])

    @property
    def aop(self) -> Array:
        """The angle of polarisation, of shape (...): of the major axis, from x towards y.

        In radians, in (-pi/2, pi/2]; NaN where S1 and S2 are no more than noise, as in
        circular and in unpolarised light.

        Examples
        --------
        >>> from optipath import Light
        >>> print(Light([1.0, 0.0, 1.0, 0.0]).aop.round(4))
        0.7854
        """
        s1, s2, _ = self._ellipse
        return self._where_there(0.5 * direction(s2, s1), 1, 2)

    @property
    def ellipticity(self) -> Array:
        """The minor axis over the major axis, in [-1, 1], with the sign of S3; shape (...).

        Of the polarised part; 0 where the light is linear, NaN where it is unpolarised. It is
        tan(asin(S3 / p) / 2) = S3 / (p + hypot(S1, S2)), p the length of (S1, S2, S3), with all
        the digits that S3 has.

        Examples
        --------
        >>> from optipath import Light
        >>> print(Light([2.0, 0.6, 0.0, -0.8]).ellipticity)
        -0.5
        """
        s1, s2, s3 = self._ellipse
        xp, linear = namespace(s1), length(s1, s2)
        # What is not physical may be infinite, and then is NaN here.
        with np.errstate(over="ignore", invalid="ignore"):
            axes = length(linear, s3) + linear
            return self._where_there(s3 / xp.where(axes == 0.0, 1.0, axes), 1, 2, 3)

    @property
    def ellipticity_angle(self) -> Array:
        """The arctangent of `ellipticity`, in [-pi/4, pi/4], of shape (...)."""
        s1, s2, s3 = self._ellipse
        return self._where_there(0.5 * direction(s3, length(s1, s2)), 1, 2, 3)

    @property
    def handedness(self) -> Array:
        """Integers of shape (...): 1 right-handed about the direction of travel, -1 left-handed.

        The sign of S3; 0 where S3 is no more than noise, or not read. By IEEE and the IAU: 1 is
        a field that turns counter-clockwise to who looks at the source, which Hecht, and
        Born & Wolf (sec. 1.4.2), call left-handed.

        Examples
        --------
        A quarter-wave plate whose fast axis is x makes light of +45 degrees right-handed:

        >>> from optipath import Light
        >>> quarter = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, -1], [0, 0, 1, 0]]
        >>> print(Light(np.array(quarter) @ [1.0, 0.0, 1.0, 0.0]).handedness)
        1
        """
        s3, floor = self._numbers[..., 3], self.noise_floor
        return _array((s3 > floor).astype(int) - (s3 < -floor).astype(int))

    @property
    def psi(self) -> Array:
        """The ellipsometric psi of the polarised part, of shape (...), in [0, pi/2].

        tan psi = abs(Ey) / abs(Ex), of partly polarised light those of its polarised part alone;
        NaN where it has none. Behind a sample that light of +45 degrees has met, with
        x along s and y along p, psi and `delta` are those of the sample.

        Examples
        --------
        >>> from optipath import Light
        >>> mirror = [[1, 0.6, 0, 0], [0.6, 1, 0, 0], [0, 0, -0.8, 0], [0, 0, 0, -0.8]]
        >>> stokes = np.array(mirror) @ [1.0, 0.0, 1.0, 0.0]
        >>> print(np.tan(Light(stokes).psi).round(12), Light(stokes).delta.round(4))
        0.5 3.1416
        """
        s1, s2, s3 = self._ellipse
        return self._where_there(0.5 * direction(length(s2, s3), s1), 1, 2, 3)

    @property
    def delta(self) -> Array:
        """The ellipsometric Delta of the polarised part, of shape (...), in (-pi, pi].

        The phase of Ey / Ex in the exp(+i w t) of ellipsometry, atan2(-S3, S2); that of the
        field exp(-i w t) of this library has the opposite sign. NaN where Ex or Ey of the
        polarised part is 0, in light along x, along y, or unpolarised.
        """
        _, s2, s3 = self._ellipse
        return self._where_there(direction(0.0 - s3, s2), 2, 3)


def _array(value: Any) -> Array:
    return namespace(value).asarray(value)  # type: ignore[no-any-return]

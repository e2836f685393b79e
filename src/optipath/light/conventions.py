"""Conventions of other software and books: signs of Stokes components, psi and Delta.

They differ from ours in the hand of S3, in which axis is x, or in the direction of y: only signs
change, so that a map is its own inverse.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias

import numpy as np

from optipath.errors import ValueFault
from optipath.faults import did_you_mean, shown, unknown
from optipath.values.jax_values import known, namespace

if TYPE_CHECKING:
    from optipath.values.precision import Array


class Convention(NamedTuple):
    """How somebody else writes light: signs of S0 .. S3, and what becomes of Delta, if anything."""

    signs: tuple[float, float, float, float]
    delta: str = ""


_S3 = 1.0, 1.0, 1.0, -1.0
_P_ALONG_X = 1.0, -1.0, -1.0, 1.0
_BOTH = 1.0, -1.0, -1.0, -1.0

CONVENTIONS = {
    # S3 > 0 turns clockwise to the sensor, which looks at the source; x is along s:
    # mitsuba.readthedocs.io, Polarization; figures of Mitsuba 3.9.1.
    "mitsuba": Convention(_S3),
    # S3 > 0 is an R-state, clockwise to who looks at the source: E. Hecht, Optics, 4th ed. (2002),
    # sec. 8.1.2 and 8.13, tables 8.5 and 8.6.
    "hecht": Convention(_S3),
    # x is along p, and S3 > 0 turns clockwise to who looks at the source; exp(+i w t): P. S. Hauge,
    # R. H. Muller and C. G. Smith, Surf. Sci. 96, 81 (1980); H. Fujiwara, Spectroscopic
    # Ellipsometry (2007), sec. 3.4.
    "ellipsometry": Convention(_BOTH, "same"),
    # S3 > 0 turns clockwise to who looks at the source: figures of py_pol 1.3.0.
    "py_pol": Convention(_S3),
    # As in ellipsometry: its Fresnel matrices have p along x; exp(+i w t):
    # pypolar.readthedocs.io, conventions; figures of pypolar 1.2.0.
    "pypolar": Convention(_BOTH, "same"),
    # x is along p, and S3 has our sign, not that of most books: figures of pyElli 0.23.1.
    "pyelli": Convention(_P_ALONG_X, "same"),
    # As ours: exp(-i w t), x along s, S3 > 0 counter-clockwise to who looks at the source: NIST,
    # SCATMECH, Conventions; figures of pySCATMECH 0.1.10.
    "scatmech": Convention((1.0, 1.0, 1.0, 1.0), "negative"),
    # It has no Stokes vectors: those of the field (E_s, -E_p), of which Delta is the phase:
    # S. J. Byrnes, arXiv:1603.02720; figures of tmm 0.2.0.
    "tmm": Convention((1.0, 1.0, -1.0, -1.0), "supplement"),
}
"""Those that light and Mueller matrices can be given in, by name."""


Software: TypeAlias = Literal[
    "mitsuba", "hecht", "ellipsometry", "py_pol", "pypolar", "pyelli", "scatmech", "tmm"
]


def signs_of(convention: Any) -> Array:
    """Return what a convention multiplies S0, S1, S2 and S3 by."""
    return np.array(_convention_of(convention).signs)


def changed_stokes(convention: Any, stokes: Any) -> Array:
    """Return Stokes vectors (..., 4) of ours in a convention, or the other way about."""
    stokes = known(stokes)
    # 0 is added since 0 times -1 is -0.
    return stokes * signs_of(convention).astype(stokes.dtype) + 0.0  # type: ignore[no-any-return]


def changed_matrix(convention: Any, matrix: Any) -> Array:
    """Return Mueller matrices (..., 4, 4) of ours in a convention, or back: both frames change."""
    matrix, signs = known(matrix), signs_of(convention)
    return matrix * np.outer(signs, signs).astype(matrix.dtype) + 0.0  # type: ignore[no-any-return]


def changed_delta(convention: Any, delta: Any) -> Array:
    """Return the ellipsometric Delta, in rad, of a convention by ours, in (-pi, pi]."""
    way = _convention_of(convention).delta
    if not way:
        having = [name for name, entry in CONVENTIONS.items() if entry.delta]
        raise ValueFault(
            f"convention {shown(convention)} has no psi and Delta{did_you_mean('', having)}"
        )
    xp = namespace(delta)
    result = {"same": delta, "negative": -delta, "supplement": np.pi - delta}[way]
    result = xp.where(result > np.pi, result - 2.0 * np.pi, result)
    return xp.where(result <= -np.pi, np.pi, result)  # type: ignore[no-any-return]


def _convention_of(convention: Any) -> Convention:
    ValueFault.raise_for(unknown("convention", convention, CONVENTIONS))
    return CONVENTIONS[convention]


class EllipsometricAngles:
    """What has an ellipsometric psi and Delta, in the conventions of others."""

    psi: Any
    delta: Any

    def ellipsometric_angles(self, convention: Software = "ellipsometry") -> tuple[Array, Array]:
        """Return psi and Delta as other software counts them, each in radians, of shape (...).

        Parameters
        ----------
        convention : str, optional
            ``"ellipsometry"``, which `psi` and `delta` are in, ``"pypolar"``, ``"pyelli"``,
            ``"scatmech"``, whose Delta is that of exp(-i w t), or ``"tmm"``, whose Delta is 180
            degrees minus ours.

        Returns
        -------
        psi : ndarray
            In [0, pi/2].
        delta : ndarray
            In (-pi, pi].

        Examples
        --------
        >>> from optipath import Interface
        >>> glass = Interface(index=1.5, incidence=np.pi / 6).mueller()
        >>> print([angle.round(4).item() for angle in glass.ellipsometric_angles()])
        [0.584, 3.1416]
        >>> print([angle.round(4).item() for angle in glass.ellipsometric_angles("tmm")])
        [0.584, 0.0]
        """
        return self.psi, changed_delta(convention, self.delta)

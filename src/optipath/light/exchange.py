"""Ellipsometric angles of light and Mueller matrices, given to other software."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.light.conventions import changed_delta

if TYPE_CHECKING:
    from optipath.values.roundings import Array


class EllipsometricAngles:
    """What has an ellipsometric psi and Delta, in the conventions of others."""

    psi: Any
    delta: Any

    def ellipsometric_angles(self, convention: str = "ellipsometry") -> tuple[Array, Array]:
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

        Raises
        ------
        ValueFault
            If there is no convention of that name, or it has no psi and Delta.

        Examples
        --------
        >>> import numpy as np
        >>> from optipath import Interface
        >>> glass = Interface(index=1.5, incidence=np.pi / 6).mueller()
        >>> print([angle.round(4).item() for angle in glass.ellipsometric_angles()])
        [0.584, 3.1416]
        >>> print([angle.round(4).item() for angle in glass.ellipsometric_angles("tmm")])
        [0.584, 0.0]
        """
        return self.psi, changed_delta(convention, self.delta)

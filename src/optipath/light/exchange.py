"""Light and Mueller matrices given to other software, and taken from it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Self

from optipath.light.conventions import changed_delta, changed_stokes
from optipath.values.arrays.shapes import real_array

if TYPE_CHECKING:
    from optipath.light.frames import Frame
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


class LightExchange(EllipsometricAngles):
    """How light is given to other software, and taken from it."""

    stokes: Any

    def to(self, convention: str) -> Array:
        """Return the Stokes vectors as other software writes them, of shape (..., 4).

        In the frame of this light: where the convention has x along p, ours is taken to be along
        s. ``docs/other-software.md`` says what differs, and where that comes from.

        Parameters
        ----------
        convention : str
            ``"mitsuba"``, ``"hecht"``, ``"ellipsometry"``, ``"py_pol"``, ``"pypolar"``,
            ``"pyelli"``, ``"scatmech"`` or ``"tmm"``.

        Returns
        -------
        ndarray, shape (..., 4)

        Raises
        ------
        ValueFault
            If there is no convention of that name.

        Examples
        --------
        >>> from optipath import Light
        >>> Light([1.0, 0.0, 0.6, 0.8]).to("mitsuba")
        array([ 1. ,  0. ,  0.6, -0.8])
        """
        return changed_stokes(convention, self.stokes)

    @classmethod
    def from_(
        cls, convention: str, stokes: Any, frame: Frame | None = None, **options: Any
    ) -> Self:
        """Return light out of Stokes vectors of other software.

        Parameters
        ----------
        convention : str
            As in `to`.
        stokes : array_like, shape (..., 4)
            As that software writes them.
        frame : Frame, optional
            The frame of the light, its x along s where the convention has x along p.
        **options
            What `Light` takes besides: the exponent of faint light, ``physical=False`` for
            measured noise.

        Returns
        -------
        Light

        Raises
        ------
        ValueFault
            If there is no convention of that name, or no light can be like that.
        ShapeError
            If the last axis has not four elements.

        Examples
        --------
        >>> from optipath import Light
        >>> right = Light.from_("hecht", [1.0, 0.0, 0.0, 1.0])
        >>> print(right.stokes, right.handedness)
        [ 1.  0.  0. -1.] -1
        """
        given = real_array("a Stokes vector", stokes, (4,))
        return cls(changed_stokes(convention, given), frame, **options)  # type: ignore[call-arg]

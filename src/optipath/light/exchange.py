"""Light and Mueller matrices given to other software, and taken from it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Self

from optipath.light.conventions import changed_delta, changed_matrix, changed_stokes
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


class MuellerExchange(EllipsometricAngles):
    """How Mueller matrices are given to other software, and taken from it."""

    matrix: Any

    def to(self, convention: str) -> Array:
        """Return the matrices as other software writes them, of shape (..., 4, 4).

        ``M.to(name) @ light.to(name)`` is ``(M @ light).to(name)``.

        Parameters
        ----------
        convention : str
            As in `Light.to`.

        Returns
        -------
        ndarray, shape (..., 4, 4)

        Raises
        ------
        ValueFault
            If there is no convention of that name.

        Examples
        --------
        >>> from optipath import Interface
        >>> Interface(index=1.5, incidence=1.309).mueller().to("ellipsometry").round(3)[0]
        array([ 0.253, -0.146,  0.   ,  0.   ])
        """
        return changed_matrix(convention, self.matrix)

    @classmethod
    def from_(
        cls,
        convention: str,
        matrix: Any,
        frame_in: Frame | None = None,
        frame_out: Frame | None = None,
    ) -> Self:
        """Return Mueller matrices out of those of other software.

        Parameters
        ----------
        convention : str
            As in `Light.to`.
        matrix : array_like, shape (..., 4, 4)
            As that software writes them.
        frame_in, frame_out : Frame, optional
            The frames of the light that comes in and that goes out; unit frames by default.

        Returns
        -------
        Mueller

        Raises
        ------
        ValueFault
            If there is no convention of that name.
        ShapeError
            If the last two axes have not four elements each.

        Examples
        --------
        >>> import numpy as np
        >>> from optipath import Mueller
        >>> quarter = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 1], [0, 0, -1, 0]]
        >>> Mueller.from_("mitsuba", quarter).matrix[3]
        array([0., 0., 1., 0.])
        """
        given = real_array("a Mueller matrix", matrix, (4, 4))
        frames = {"frame_in": frame_in, "frame_out": frame_out}
        own = {name: frame for name, frame in frames.items() if frame is not None}
        return cls(changed_matrix(convention, given), **own)  # type: ignore[call-arg]

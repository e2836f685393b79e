"""The angles of half and difference vectors, over which polarised BRDFs are tabulated."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from optipath.light.frames import Frame

Numbers = npt.NDArray[np.float64]

LOWEST = float(np.cos(np.radians(89.0)))
"""The cosine of the angle to the normal beyond which nothing is tabulated."""


class HalfAngles(NamedTuple):
    """The axes of a table, in radians (S. Rusinkiewicz, A New Change of Variables, 1998).

    The half vector h is halfway between the directions to the light and to the eye, at theta_h to
    the normal n; the light is at theta_d to h, and phi_d about it: 0 towards (n x h) x h, pi / 2
    towards n x h.
    """

    phi_d: Numbers
    theta_d: Numbers
    theta_h: Numbers

    @classmethod
    def of(cls, shape: tuple[int, int, int]) -> HalfAngles:
        """Return axes of a shape: whole turns and right angles in equal steps.

        Those of theta_h grow from 0 on, so that they are narrow where lobes are: the square of
        place / last, as in the table of W. Matusik et al., A Data-Driven Reflectance Model, 2003.

        Examples
        --------
        >>> axes = HalfAngles.of((5, 3, 4))
        >>> print(np.degrees(axes.theta_h))
        [ 0. 10. 40. 90.]
        """
        turns, rights, halves = shape
        squares = np.linspace(0.0, 1.0, halves) ** 2
        return cls(
            np.linspace(-np.pi, np.pi, turns),
            np.linspace(0.0, np.pi / 2.0, rights),
            squares * (np.pi / 2.0),
        )

    def frames(self, turn: int) -> tuple[npt.NDArray[np.bool_], Frame, Frame]:
        """Return the frames of the light that comes and goes at one of the phi_d.

        Shapes: returns there (theta_d, theta_h), before, behind (n,).
        """
        c, s = np.cos(self.phi_d[turn]), np.sin(self.phi_d[turn])
        ch, sh = np.cos(self.theta_h), np.sin(self.theta_h)
        # Of cos(theta_d) ch -+ sin(theta_d) c sh, which is R cos(theta_d + angle).
        size, angle = np.hypot(ch, c * sh), np.arctan2(np.abs(c) * sh, ch)
        most = np.arccos(np.minimum(LOWEST / size, 1.0)) - angle
        there = np.broadcast_to(most >= 0.0, (len(self.theta_d), len(self.theta_h)))
        theta_d = np.minimum(self.theta_d[:, np.newaxis], most)[there][:, np.newaxis]
        half = np.stack([sh, np.zeros_like(sh), ch], axis=-1)
        along = np.stack([c * ch, np.full_like(sh, s), -c * sh], axis=-1)
        x = np.stack([s * ch, np.full_like(sh, -c), -s * sh], axis=-1)
        half, along, x = (
            np.broadcast_to(each, (*there.shape, 3))[there] for each in (half, along, x)
        )
        to_eye = np.cos(theta_d) * half - np.sin(theta_d) * along
        from_light = -np.cos(theta_d) * half - np.sin(theta_d) * along
        before = Frame.trusted(x, np.cross(from_light, x), from_light)
        return there, before, Frame.trusted(x.copy(), np.cross(to_eye, x), to_eye)

"""Light that draws itself, by the room of pictures above it."""

from __future__ import annotations

from importlib import import_module
from inspect import signature
from typing import Any

from optipath.errors import ParameterError, unknown

_KINDS = ("ellipse", "poincare", "stokes")


class DrawnLight:
    """Light, or a batch, of which there are pictures."""

    def plot(self, kind: str = "ellipse", ax: Any = None, **options: Any) -> Any:
        r"""Draw the light with Matplotlib.

        Parameters
        ----------
        kind : {"ellipse", "poincare", "stokes"}, optional
            The polarisation ellipse, the point on the Poincaré sphere, or the Stokes vector as
            bars, as the functions of `optipath.plots` of these names draw them.
        ax : Axes, optional
            Where, of three dimensions for ``"poincare"``; a figure of its own by default,
            ``.figure`` of what is returned.
        **options
            What that function takes besides: ``labels`` of an ellipse, ``by`` and ``label`` on the
            sphere, ``published`` and ``labels`` of bars.

        Returns
        -------
        Axes

        Raises
        ------
        ParameterError
            If there is no such kind, it does not take an option, or JAX traces the light.
        OptipathError
            If the light, the axes or an option do not fit the picture.
        MissingExtraError
            If Matplotlib is not installed.

        Examples
        --------
        >>> import optipath as op
        >>> op.Light([1.0, 0.0, 1.0, 0.0]).plot().get_title()
        'linear\nS0 = 1, DoP = 1, AoP = 45°'
        """
        if faults := unknown("kind of picture", kind, _KINDS):
            raise ParameterError(*faults)
        draw = getattr(import_module("optipath.plots"), kind)
        known = [name for name in signature(draw).parameters if name not in ("light", "ax")]
        wrong = [fault for name in options for fault in unknown(f"{kind} option", name, known)]
        if wrong:
            raise ParameterError(*wrong)
        return draw(self, ax, **options)

"""A Mueller matrix that draws itself, by the room of pictures above it."""

from __future__ import annotations

from importlib import import_module
from typing import Any


class DrawnMatrix:
    """A Mueller matrix of which there is a picture."""

    def plot(self, ax: Any = None) -> Any:
        """Draw the matrix over its M00 as a map of its elements with Matplotlib.

        Parameters
        ----------
        ax : Axes, optional
            Where; a figure of its own by default, ``.figure`` of what is returned.

        Returns
        -------
        Axes

        Raises
        ------
        OptipathError
            If it is a batch, or the axes are something else.
        ParameterError
            If JAX traces it.
        MissingExtraError
            If Matplotlib is not installed.

        Examples
        --------
        >>> import optipath as op
        >>> op.Retarder("90 deg", "0 deg").mueller().plot().get_title()
        'M / M00, with M00 = 1'
        """
        return import_module("optipath.plots").mueller(self, ax)

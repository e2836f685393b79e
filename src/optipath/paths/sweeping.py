"""What a path is asked of the room above it: sweeps, and how uncertain its light is."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any, Never

from optipath.extras import needing

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from os import PathLike

    from optipath.composer.composer import Composer


class Sweeping:
    """A path whose parameters take many values, each along an axis of its own."""

    def sweep(
        self,
        /,
        *unnamed: Never,
        zip: Sequence[str] | Sequence[Sequence[str]] | Mapping[str, Sequence[str]] = (),  # noqa: A002 - what it does
        coords: str | PathLike[str] | Any = None,
        chunks: int | str | Mapping[str, int] | None = None,
        store: str | PathLike[str] | None = None,
        scheduler: Any = None,
        progress: bool | Callable[[int, int], None] = False,
        composer: Composer | None = None,
        **axes: Any,
    ) -> Any:
        """Return the light for every combination of some values, with named axes.

        Parameters
        ----------
        *unnamed
            None: values are given by name.
        zip : sequence of str, or several, optional
            Parameters whose values vary together, along one dimension: ``zip=("delta", "rho")``,
            or a mapping of its name to them.
        coords : str, PathLike, Dataset, DataArray or mapping, optional
            Axes besides: a CSV file with a column for each parameter, its unit in the heading; the
            coordinates of a Dataset; or a mapping from names to values.
        chunks : int, str or mapping of str to int, optional
            The variables are Dask arrays of so many values along each dimension; ``"auto"`` for
            blocks of about a million.
        store : str or PathLike, optional
            A Zarr store (``.zarr``) or a NetCDF file (``.nc``) that is written block by block; a
            Zarr store goes on where it stopped.
        scheduler : str or distributed.Client, optional
            What computes the blocks for a store: ``"threads"``, ``"processes"``, ``"synchronous"``,
            a client, or the address of a cluster.
        progress : bool or callable, optional
            Whether a bar shows how far it is; or what is told how many blocks are done, and of how
            many.
        composer : Composer, optional
            How the path is composed.
        **axes : array_like
            The values of parameters, in radians and metres, texts with units, a range
            ``"0 deg:90 deg:91"``, or a DataArray with ``attrs["units"]``; a single value that
            stands in no list is no axis.

        Returns
        -------
        xarray.Dataset
            The dimensions are called as the parameters, in the order given.

        Raises
        ------
        MissingExtraError
            If xarray is not installed.
        ParameterError
            With all that is wrong with the axes, or as `Plan.run`.
        ShapeError
            If the light takes more memory than is free.
        """
        own = {"zip": zip, "coords": coords, "chunks": chunks, "store": store}
        more = {"scheduler": scheduler, "progress": progress, "composer": composer}
        with needing("sweeps"):
            sweep = import_module("optipath.sweeps.sweep").sweep
            return sweep(self, unnamed, axes, **own, **more)

    def propagate(
        self,
        /,
        *unnamed: Never,
        method: str = "auto",
        samples: int | None = None,
        seed: int | None = None,
        correlation: Mapping[tuple[str, str], float] | None = None,
        detector: str | None = None,
        composer: Composer | None = None,
        **values: Any,
    ) -> Any:
        """Return the light with its uncertainty, which follows from those of values.

        To the first order by slopes (JCGM 100:2008, the GUM, eqs. 10 and 13), or by samples (its
        Supplement 1, JCGM 101:2008). What is doubtful is told in `Propagation.notes`.

        Parameters
        ----------
        *unnamed
            None: values are given by name.
        method : {"auto", "gradients", "differences", "monte-carlo"}, optional
            Slopes by JAX where it is installed, traces the path and does not take long, else by
            differences; by JAX; by differences; or samples of normal distributions, which are cut
            off at the ends of ranges.
        samples, seed : int, optional
            Of ``"monte-carlo"``: 10,000, and what random numbers begin with, 0, by default.
        correlation : mapping of pairs of str to float, optional
            Coefficients of correlation, ``{("n1", "k1"): 0.3}``; 0 for other pairs.
        detector : str, optional
            Its name; needed only where there are several.
        composer : Composer, optional
            How the path is composed; slopes are in float64, and exact.
        **values : tuple of two, or array_like
            A value and its standard uncertainty (one standard deviation), each in radians, metres
            or texts with units, ``delta=("48 deg", "0.1 deg")``; they may be arrays that
            broadcast. What is no tuple is exact.

        Returns
        -------
        Propagation

        Raises
        ------
        ParameterError
            With everything that is wrong with values, uncertainties and options.
        MissingExtraError
            If slopes by JAX are asked for, and JAX is not installed.

        Examples
        --------
        >>> import optipath as op
        >>> found = op.load_preset("malus").propagate(
        ...     angle=("30 deg", "0.1 deg"), intensity=(1.0, 0.002), method="differences"
        ... )
        >>> print(found.light.intensity.round(6), found.uncertainty_of("intensity").round(6))
        0.375 0.001065
        >>> {name: float(share.round(3)) for name, share in found.contributions_to("S0").items()}
        {'angle': 0.504, 'intensity': 0.496}
        """
        room = "optipath.sweeps.uncertainty"
        options = import_module(f"{room}.propagate_options").PropagateOptions(
            method, samples, seed, correlation, detector, composer
        )
        return import_module(f"{room}.propagate").propagate(self, unnamed, values, options)

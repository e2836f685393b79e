"""SampleIndices: the indices of the media of a sample, at one wavelength or at several."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from optipath.errors import OptipathError, SurfaceError
from optipath.paths.format.faults import Faults
from optipath.surfaces.samples.sample_media import BASE, CLEAR_MEDIUM, depends_on_wavelength
from optipath.values.arrays.jax_values import is_traced
from optipath.values.cures import cure
from optipath.values.curves.curve_value import CurveValue
from optipath.values.resolved import THERE
from optipath.values.use import Use
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    import numpy.typing as npt

    from optipath.values.domains.domain import Domain
    from optipath.values.resolved import Resolved

    Parts: TypeAlias = tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]

WHEN = "wavelength"
"""The parameter that media follow from."""


class SampleIndices(NamedTuple):
    """The indices of the media of a sample; only the last may depend on the wavelength."""

    outside: float
    inner: tuple[float, ...]
    n: npt.NDArray[np.float64]
    k: npt.NDArray[np.float64]

    @property
    def opaque(self) -> bool:
        """Whether all light that meets the last interface is reflected or absorbed there."""
        return bool(np.all(self.k))

    @property
    def base(self) -> Any:
        """That of the base as one number n + ik, or an array of such."""
        return (self.n + 1j * self.k)[()]


def indices_of(media: Mapping[str, Any], wavelength: Any) -> SampleIndices:
    """Return the indices of media.

    Units: wavelength in metres.
    """
    given = _given(media.values(), wavelength)
    domains = [CLEAR_MEDIUM] * (len(media) - 1) + [BASE]
    faults = Faults()
    found: dict[str, Parts] = {}
    for (place, medium), domain in zip(media.items(), domains, strict=True):
        parts = faults.attempt("", _parts_at, place, medium, domain, given)
        found |= {} if parts is None else {place: parts}
    if not faults:
        faults += _faults_of_several(found)
    if faults:
        raise SurfaceError(*dict.fromkeys(faults))
    *above, (n, k) = found.values()
    outside, *inner = [float(np.ravel(clear)[0]) for clear, _ in above]
    shape = np.shape(given[WHEN].value) if given else ()
    return SampleIndices(outside, tuple(inner), _laid_out(n, shape), _laid_out(k, shape))


def _laid_out(numbers: Any, shape: tuple[int, ...]) -> npt.NDArray[np.float64]:
    return np.array(np.broadcast_to(numbers, shape), np.float64)


def _given(media: Iterable[Any], wavelength: Any) -> dict[str, Resolved]:
    """Return the wavelengths that are given; nothing where no medium depends on them."""
    dependent = next(filter(depends_on_wavelength, media), None)
    if wavelength is None and dependent is None:
        return {}
    if wavelength is None:
        how = cure("such as '550 nm'", "--wavelength '550 nm'")
        raise SurfaceError(f"{dependent} depends on the wavelength; give one, {how}")
    if dependent is None:
        raise SurfaceError("wavelength is given, but no medium depends on it; leave it out")
    if is_traced(wavelength):
        raise SurfaceError("wavelength is traced by JAX, but samples have no slopes; give a number")
    try:
        given = Wavelength().resolve(wavelength)
    except OptipathError as error:
        raise SurfaceError(*error.faults) from None
    if not given.value.size:
        raise SurfaceError("wavelength is empty; give one or more")
    return {WHEN: given}


def _parts_at(place: str, medium: Any, domain: Domain, given: Mapping[str, Resolved]) -> Parts:
    """Return n and k of a medium at the wavelengths that are given."""
    if not depends_on_wavelength(medium):
        return np.asarray(np.real(medium)), np.asarray(np.imag(medium))
    n, k = [_part_at(place, Use(*part), given) for part in domain.parts(place, medium)]
    domain.check(place, n + 1j * k)
    return n, k


def _part_at(place: str, use: Use, given: Mapping[str, Resolved]) -> Any:
    if not isinstance(use.value, CurveValue):
        return np.asarray(use.value)
    when, _ = use.with_arguments()
    # Of n and k of one curve it is told once.
    replace(when, owner=place).check_given(given[WHEN].value)
    numbers = use.value.computed(given).value
    use.check_given(numbers, THERE, given)
    return use.value.placed(numbers)


def _faults_of_several(found: Mapping[str, Parts]) -> Iterator[str]:
    """Yield what keeps light of several wavelengths from one way through a sample."""
    *above, base = found
    for place in above:
        if np.ptp(found[place][0]):
            yield (
                f"{place} differs from wavelength to wavelength, and so do the ways of light below "
                f"it; give one wavelength at a time"
            )
    n, k = found[base]
    if n.size > 1 and not np.all(k):
        yield (
            f"{base} lets light through, whose ways differ from wavelength to wavelength; give one "
            f"wavelength at a time"
        )

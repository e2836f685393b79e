"""Light added up over its wavelengths."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import LightError, ShapeError, ValueFault
from optipath.faults import listed
from optipath.light.on_demand import rounding
from optipath.materials.illuminants import NANOMETRES, grid_fault, grid_widths
from optipath.materials.spectrum import check_response
from optipath.values.domains import Domain
from optipath.values.jax_values import check_known, is_traced, known, namespace
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from optipath.light.light import Light
    from optipath.values.precision import Array


_RESPONSE = Domain("response", minimum=0.0)


def spectral_axis(light: Light) -> tuple[Array, int]:
    """Return the wavelengths (n,) of light, in metres, and the batch axis along which they vary."""
    wavelength = light.wavelength
    if several := light.wavelengths_in_doubt:
        raise LightError(
            f"the light of this path depends on several wavelengths, {listed(several)}; say "
            f"which are those of its spectrum, light.at_wavelengths(...)"
        )
    if wavelength is None:
        raise LightError(
            "light of no known wavelengths has no spectrum; write light.at_wavelengths(...)"
        )
    check_known("the wavelengths that light is added up over", wavelength)
    every = np.broadcast_to(wavelength, light.shape)
    axes = [axis for axis in range(every.ndim) if _varies(every, axis)]
    if len(axes) != 1:
        many = f"axes {listed([*map(str, axes)])}" if axes else "no axis"
        raise LightError(
            f"the wavelengths vary along {many} of light of shape {light.shape}, not along one; "
            f"take a part of it, or trace wavelength=op.wavelengths('380 nm', '780 nm', '5 nm')"
        )
    (axis,) = axes
    grid = np.moveaxis(every, axis, -1)[(0,) * (every.ndim - 1)]
    if fault := grid_fault(grid):
        raise LightError(f"the wavelengths of the light {fault}; sort them, each once")
    return grid, axis


def _varies(numbers: Array, axis: int) -> bool:
    if numbers.strides[axis] == 0 or numbers.shape[axis] < 2:
        return False
    return bool(np.any(numbers != numbers.take([0], axis)))


def integrated(light: Light, response: Any = None, edges: Any = None) -> tuple[Any, Any, Any]:
    """Return light added up over its wavelengths, as `Light.of` takes it. Shape stokes (..., 4)."""
    ends = None if edges is None else _edges(edges)
    one_bin = ends is not None and ends.size == 2
    light, grid, axis = _along_bins(light, one_bin=one_bin)
    weights = grid_widths(grid) if ends is None else _widths_of(ends, grid)
    if response is not None:
        weights = weights * _response_at(response, grid)
    numbers = known(light.stokes)
    total = weighted_sum(numbers, weights[:, np.newaxis], axis).astype(numbers.dtype)
    noise = None if is_traced(total) else (noise_of_sum, light, weights, axis)
    return total, _frame_without(light, axis), noise


def _along_bins(light: Light, *, one_bin: bool) -> tuple[Light, Array, int]:
    """Return light with its wavelengths and their axis; one, where all of it is in one bin."""
    wavelength = light.wavelength
    if not one_bin or wavelength is None or is_traced(wavelength) or np.ptp(wavelength) > 0.0:
        return light, *spectral_axis(light)
    behind = light.ndim - wavelength.ndim
    single = [place for place, count in enumerate(light.shape) if count == 1 and place >= behind]
    if len(single) == 1:
        return light, wavelength.ravel()[:1], single[0]
    return light[np.newaxis], wavelength.ravel()[:1], 0


def weighted_sum(numbers: Any, weights: Any, axis: int) -> Any:
    """Return sums over an axis of numbers (..., k) times weights (n, k).

    By halves, so that sums do not depend on other axes.
    """
    shape = [1] * numbers.ndim
    shape[axis], shape[-1] = weights.shape
    products = numbers * weights.reshape(shape)
    xp = namespace(products)
    terms = xp.moveaxis(products, axis, 0)
    while len(terms) > 1:
        half = len(terms) // 2
        terms = xp.concatenate([terms[:half] + terms[half : 2 * half], terms[2 * half :]])
    return terms[0]


@np.errstate(over="ignore", under="ignore")
def noise_of_sum(light: Light, weights: Array, axis: int, stokes: Array) -> Array:
    """Return the noise (...) in light that has been added up."""
    shape = [1] * light.ndim
    shape[axis] = len(weights)
    floor = light.noise + rounding(known(light.stokes))
    return np.sum(floor * np.abs(weights).reshape(shape), axis=axis).astype(stokes.dtype)


def _edges(argument: Any) -> Array:
    """Return the edges of bins that somebody gives, in metres."""
    check_known("the edges of bins", argument)
    return np.asarray(Wavelength("edges").resolve(argument).value, np.float64)


def _widths_of(results: Array, grid: Array) -> Array:
    """Return the widths, in nanometres, of bins with these edges, each about a wavelength."""
    if results.shape != (len(grid) + 1,):
        raise ShapeError(
            f"{len(grid)} wavelengths have {len(grid) + 1} edges of bins, not {results.shape}"
        )
    ordered = grid if len(grid) > 1 else results
    up = 1.0 if ordered[-1] > ordered[0] else -1.0
    outside = (up * results[:-1] > up * grid) | (up * grid > up * results[1:])
    if np.any(outside) or np.any(up * np.diff(results) <= 0.0):
        place = int(np.argmax(outside))
        low, at, high = (1e9 * x for x in (results[place], grid[place], results[place + 1]))
        raise ValueFault(
            f"bin {place} is from {low:g} nm to {high:g} nm, and its wavelength is {at:g} nm; "
            f"give edges in the order of the wavelengths, and around each"
        )
    return np.abs(np.diff(results * NANOMETRES))


def _response_at(response: Any, grid: Array) -> Any:
    """Return the response at each wavelength, which is not below 0."""
    check_response("the response", response)
    asked = hasattr(response, "at") and not is_traced(response)
    result = _RESPONSE.check("the response", known(response.at(grid) if asked else response))
    if result.shape not in ((), (len(grid),)):
        raise ShapeError(
            f"the response has the shape {tuple(result.shape)}, and there are {len(grid)} "
            f"wavelengths; give one number for each, one for all, or a Spectrum"
        )
    return result


def _frame_without(light: Light, axis: int) -> Any:
    """Return the frame of light along an axis, which must be one."""
    frame = light.frame
    if frame.z.ndim == 1:
        return frame
    each = [np.broadcast_to(axes, (*light.shape, 3)) for axes in (frame.x, frame.y, frame.z)]
    if any(_varies(vectors, axis) for vectors in each):
        raise LightError(
            "light of each wavelength has a frame of its own, and light adds up in one; write "
            "light.in_frame(frame).integrate()"
        )
    return light[(slice(None),) * axis + (0,)].frame

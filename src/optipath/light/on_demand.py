"""Frames, noise and wavelengths of light, computed when they are first needed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import FrameError, LightError, ShapeError
from optipath.light.array_axes import each_number
from optipath.light.frame import Frame
from optipath.values.arrays import broadcast_fault, joint_shape, locked
from optipath.values.jax_values import is_traced, known, namespace
from optipath.values.units import displayed
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.values.precision import Array


class FramesOnDemand:
    """What has frames by their names; what makes one has an underscore before its name."""

    def _cached_frame(self, name: str) -> Any:
        """Return a frame as it is kept, which nobody has to make for it."""
        own = self.__dict__
        return own[name] if name in own else own[f"_{name}"]

    def _part_of_frame(
        self, name: str, batch: tuple[int, ...], change: Callable[[Any], Any]
    ) -> Frame | Callable[[], Frame]:
        """Return the frames that belong to a part of a batch, or what returns them."""
        stored = self._cached_frame(name)
        # At once, since what tells the part may change, but for what JAX traces.
        if type(stored) is Frame and (
            stored.z.ndim == 1 or not is_traced(change(np.broadcast_to(0.0, batch)))
        ):
            return _indexed_frame(stored, batch, change)
        return lambda: _indexed_frame(getattr(self, name), batch, change)

    def __getstate__(self) -> dict[str, Any]:
        # What makes frames stays here.
        own = dict(self.__dict__)
        for later in [name for name in own if name.startswith("_frame")]:
            del own[later]
            own[later[1:]] = getattr(self, later[1:])
        return own


def _indexed_frame(frame: Frame, batch: tuple[int, ...], change: Callable[[Any], Any]) -> Frame:
    if frame.z.ndim == 1:
        return frame
    axes = [np.broadcast_to(axis, (*batch, 3)) for axis in (frame.x, frame.y, frame.z)]
    x, y, z = [each_number(axis, change) for axis in axes]
    if is_traced(z):
        raise FrameError(
            "a frame is of numbers, not of an index that JAX traces; bring light to one frame "
            "before, light.in_frame(frame)[i], or look at it outside of jit and grad"
        )
    return Frame.trusted(x, y, z, frame.rounding)


def inherited_noise(
    lights: tuple[Any, ...],
    factor: Any = 1.0,
    *,
    mixed: bool = False,
    part: Callable[[Any], Any] | None = None,
    added: Any = 0.0,
) -> Callable[[Array], Array]:
    """Return what finds the noise (...) in Stokes vectors that are made of some lights."""
    for light in lights:
        # What is inherited twice is found now, lest sums of many lights keep all of them.
        if callable(vars(light).get("_noise")):
            vars(light)["_noise"] = light.noise

    def noise(stokes: Array) -> Array:
        total = np.zeros(stokes.shape[:-1], stokes.dtype)
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            for light in lights:
                numbers = known(light.stokes)
                floor = light.noise + rounding(numbers) if mixed else light.noise
                floor = floor * np.abs(factor) + added * np.abs(numbers[..., 0])
                total = total + (floor if part is None else part(floor))
        return total

    return noise


def noise_in(stokes: Any, noise: Any) -> Any:
    """Return the noise (...) in Stokes vectors: the rounding of S0 at least."""
    least = rounding(stokes)
    if noise is None or is_traced(stokes):
        return least
    if isinstance(noise, tuple):
        found, *arguments = noise
        noise = found(*arguments, stokes)
    return np.maximum(least, noise(stokes) if callable(noise) else noise)


def rounding(stokes: Any) -> Any:
    """Return by how much sums of numbers as large as S0 are rounded, of shape (...)."""
    xp = namespace(stokes)
    with np.errstate(under="ignore", over="ignore"):
        return abs(stokes[..., 0]) * float(xp.finfo(stokes.dtype).eps)


_ROUNDING = 2.0 * float(np.finfo(np.float32).eps)
"""By how much, as a share, wavelengths differ that are one, given in single precision."""


def common_wavelength(light: Any, other: Any) -> Any:
    """Return what light has that is made of this and of another one."""
    mine = light.kept_wavelength
    if mine is None or mine is other.kept_wavelength:
        return mine
    # Found now, lest sums of many lights keep what finds those of each.
    one, two = light.wavelength, other.wavelength
    if one is None or two is None or is_traced(one) or is_traced(two):
        return None
    if (apart := np.abs(one - two) > _ROUNDING * one).any():
        pair = [displayed(np.broadcast_to(w, apart.shape)[apart][0], "nm") for w in (one, two)]
        raise LightError(
            f"lights of different wavelengths, {pair[0]} and {pair[1]}, have no sum; "
            f"add light.integrate() of each, or, of powers, op.Light(light.stokes, light.frame)"
        )
    return light.wavelength


def part_of_wavelength(light: Any, change: Callable[[Any], Any]) -> Any:
    """Return what returns the wavelengths of a part of the batch; None where there are none."""
    stored, batch = light.kept_wavelength, light.shape
    if stored is None or light.wavelengths_in_doubt:
        return stored

    def part() -> Any:
        result = stored() if callable(stored) else stored
        if result is None:
            return None
        xp = namespace(result)
        result = change(xp.broadcast_to(result, batch))
        return namespace(result).asarray(result)

    return part


def wavelengths_for(batch: tuple[int, ...], argument: Any) -> Array:
    """Return wavelengths, in metres, that somebody gives for light."""
    result = Wavelength().resolve(argument).value
    shape = tuple(result.shape)
    if broadcast_fault({"one": shape, "other": batch}) or joint_shape(shape, batch) != batch:
        raise ShapeError(
            f"wavelengths of shape {shape} do not fit light of shape {batch}; give one for each "
            f"light, or an array that broadcasts to them, such as wavelengths[:, None]"
        )
    return result if is_traced(result) else locked(np.array(result, np.float64))

"""The lights of photons, added to the pixels that they fall on, by compiled code."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from optipath.engines.machine_code import MachineCode

_TEXT = """\
def path(
    places: "*int64", lights: "*float64", photons: "int64", numbers: "int64", sums: "*float64"
):
    for photon in range(photons):
        place = places[photon]
        if place >= 0:
            to, at = numbers * place, numbers * photon
            for number in range(numbers):
                sums[to + number] += lights[at + number]
    return photons
"""


@cache
def _adder() -> MachineCode:
    from optipath.engines.code_cache import CODE  # noqa: PLC0415 - an extra
    from optipath.engines.machine_code import compiled  # noqa: PLC0415 - an extra

    return CODE.function(_TEXT, compiled)


def add_to_pixels(
    places: npt.NDArray[np.int64],
    lights: npt.NDArray[np.float64],
    sums: npt.NDArray[np.float64],
) -> None:
    """Add the numbers of each photon to those of its pixel, one photon after the other.

    Parameters
    ----------
    places : ndarray of int, shape (photons,)
        The pixel of each; below 0 where it falls on none.
    lights : ndarray, shape (photons, numbers)
        What it carries.
    sums : ndarray, shape (pixels, numbers)
        Changed. All arrays lie in memory as C has them.

    Examples
    --------
    >>> import numpy as np
    >>> sums = np.zeros((2, 1))
    >>> add_to_pixels(np.array([1, -1, 1]), np.array([[1.0], [2.0], [4.0]]), sums)
    >>> print(sums.ravel())
    [0. 5.]
    """
    from optipath.engines.machine_code import address  # noqa: PLC0415 - an extra

    _adder()(address(places), address(lights), *lights.shape, address(sums))

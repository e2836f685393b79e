"""How much of light stays in each layer of a stack, by itself."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.alone import checked_alone, turned_alone
from optipath.errors import PathError, shown
from optipath.kernels.numbers.primitives import NUMPY
from optipath.light.frames import Frame
from optipath.light.light import Light
from optipath.light.mueller.matrix import Mueller
from optipath.values.arrays.shapes import check_broadcast
from optipath.values.operands import operand_of

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.values.operation import Operation


def absorbed_alone(
    stack: Any, operation: Operation, light: Any, enters: str, method: str
) -> npt.NDArray[np.float64]:
    """Return the share of light that stays in each layer of a stack.

    Shapes: light (..., 4); returns (..., layers).
    """
    if enters not in stack.inputs:
        raise PathError(
            f"{stack.kind} has no in-port {shown(enters)}; light arrives at 'in' or at 'back'"
        )
    batch = checked_alone(stack, enters)
    with np.errstate(all="ignore"):
        numbers = operation.numbers(NUMPY, lambda value: operand_of(value).numbers({}), method)
        shares = [np.broadcast_to(number, batch) for number in numbers]
        s, p = (
            np.stack(part, axis=-1) if part else np.empty((*batch, 0))
            for part in (shares[::2], shares[1::2])
        )
        along: Any = 0.0
        if light is not None:
            arriving = light if isinstance(light, Light) else Light(light)
            check_broadcast({stack.kind: batch, "the light": arriving.stokes.shape[:-1]})
            frame = turned_alone(stack, enters, arriving.frame)
            stokes = (Mueller.of(np.eye(4), frame, Frame()) @ arriving).stokes
            along = (stokes[..., 1] / stokes[..., 0])[..., np.newaxis]
        return np.asarray(0.5 * ((1.0 + along) * s + (1.0 - along) * p))

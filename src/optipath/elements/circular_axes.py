"""What acts along two circular states of light, as filters do along x and y."""

from __future__ import annotations

import math

from optipath.elements.coupling import turned
from optipath.kernels.catalogue import RETARDER
from optipath.values.operation import Operation

_QUARTER, _DIAGONAL = math.pi / 2, math.pi / 4


def along_circular_axes(*operations: Operation) -> tuple[Operation, ...]:
    """Return operations between quarter-wave plates: S3 > 0 takes the place of x, S3 < 0 of y.

    So no digits of light get lost that one of the two hardly lets through.

    Examples
    --------
    >>> from optipath.kernels.catalogue import POLARIZER
    >>> steps = along_circular_axes(Operation(POLARIZER, (1.0, 0.0)))
    >>> [step.kernel.name for step in steps]
    ['retarder', 'turn', 'polarizer', 'turn back', 'retarder']
    """
    there, back = Operation(RETARDER, (_QUARTER,)), Operation(RETARDER, (-_QUARTER,))
    # The plate makes light at -45 degrees of S3 > 0.
    return (there, *turned(-_DIAGONAL, *operations), back)

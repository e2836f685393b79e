"""What is left of an angle beside the right angles in it, in the digits that it is given in.

Next to a right angle that is all there is of its cosine; a formula of fewer digits is given
both, the angle rounded and what is left of it.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from optipath.engines.formulas.formula import Formula
from optipath.engines.formulas.recorder import Recorder
from optipath.engines.formulas.symbolic import SYMBOLIC
from optipath.kernels.numbers.trigonometry import DIGITS, from_axes, from_nearer_axis

FROM_NEARER, FROM_ANY = "left from the nearer axis", "left from axes"
"""Operations on an angle that is given: within 0 .. pi/2, or any."""

LEFT = {FROM_NEARER: from_nearer_axis, FROM_ANY: from_axes}
DOUBLE = DIGITS["float64"]


@cache
def left_formula(operation: str) -> Formula:
    """Return what is left of an angle as a formula of double precision, for engines that compile.

    Examples
    --------
    >>> [step.operation for step in left_formula(FROM_NEARER).steps]
    ['subtract', 'minimum', 'add', 'maximum', 'minimum']
    """
    recorder = Recorder(np.dtype(np.float64))
    left = LEFT[operation](SYMBOLIC, DOUBLE)(recorder.input("angle"))
    return Formula(recorder.dtype, (left,))

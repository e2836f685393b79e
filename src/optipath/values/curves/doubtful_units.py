"""Units of tables of wavelengths, where the numbers look like those of another one."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from optipath.values.displayed import displayed

if TYPE_CHECKING:
    from collections.abc import Sequence

_DOUBTS = {"um": (100e-6, np.inf, "nm"), "nm": (0.0, 10e-9, "um")}
"""Between which metres all wavelengths of a table in a unit are doubted, and what is meant.

The far infrared is 100 um and more, and 100 to 1000 is what light has in nanometres; X-rays are
below 10 nm, and 0.1 to 10 is what it has in micrometres. Of other units nothing is doubted: tables
of X-rays are usual in eV, and those of the far infrared in THz and 1/cm.
"""


def unit_doubted(metres: Sequence[float], unit: str) -> str:
    """Return why the unit of a table of wavelengths is most likely another one, if it is.

    Examples
    --------
    >>> print(unit_doubted([400e-6, 500e-6], "um"))  # doctest: +NORMALIZE_WHITESPACE
    the wavelengths are 400 um .. 500 um, which are most likely nm; give the unit nm, or, where
    they are meant, each with its unit, such as '400 um'
    >>> unit_doubted([0.4e-6, 0.5e-6], "um")
    ''
    """
    if not len(metres) or unit not in _DOUBTS:
        return ""
    low, high, meant = _DOUBTS[unit]
    least, most = float(min(metres)), float(max(metres))
    if not low <= least <= most <= high:
        return ""
    first = displayed(least, unit)
    return (
        f"the wavelengths are {first} .. {displayed(most, unit)}, which are most likely {meant}; "
        f"give the unit {meant}, or, where they are meant, each with its unit, such as '{first}'"
    )

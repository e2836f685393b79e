"""What goes along an axis of a picture: numbers in a unit, what they are, and the usual one."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

_SIGNS = {"deg": "°", "um": "µm"}
_LONGEST = 60


class AlongAxis(NamedTuple):
    """What goes along an axis.

    Shape: numbers (count,).
    """

    name: str
    unit: str
    numbers: npt.NDArray[np.float64]
    help: str = ""
    default: float | None = None

    @property
    def labels(self) -> tuple[str, ...]:
        """What it is called, the longest wording first.

        Examples
        --------
        >>> import numpy as np
        >>> AlongAxis("theta", "deg", np.zeros(2), "angle of incidence, inside").labels
        ('theta: angle of incidence, inside (°)', 'theta: angle of incidence (°)', 'theta (°)')
        """
        unit = "" if self.unit in {"", "1"} else f" ({_SIGNS.get(self.unit, self.unit)})"
        whats = [self.help, self.help.partition(";")[0], self.help.partition(",")[0]]
        kept = [what for what in dict.fromkeys(whats) if 0 < len(what) <= _LONGEST]
        said = [what if what.startswith(self.name) else f"{self.name}: {what}" for what in kept]
        return (*(f"{each}{unit}" for each in said), f"{self.name}{unit}")

    @property
    def default_text(self) -> str:
        """The value by default with its unit, to four digits; empty where there is none.

        Examples
        --------
        >>> import numpy as np
        >>> AlongAxis("theta", "deg", np.zeros(2), default=56.30993).default_text
        '56.31°'
        """
        if self.default is None:
            return ""
        sign = _SIGNS.get(self.unit, self.unit)
        return f"{self.default:.4g}{'' if sign == '°' else ' '}{sign}".rstrip()

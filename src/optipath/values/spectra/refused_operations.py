"""RefusedOperations: what cannot be done with spectra as with numbers, and what to do instead."""

from __future__ import annotations

import math
from typing import Any, NoReturn

from optipath.errors import ValueFault, shown


class RefusedOperations:
    """Differences and powers, which are refused with the cure."""

    label: str

    def _refused(self, *_: Any) -> NoReturn:
        raise ValueFault(
            f"a difference or power of {self.label} is no spectrum, which is nowhere below 0; "
            f"compute with its numbers, spectrum.at(wavelengths), and make one of what comes of "
            f"it, Spectrum(wavelengths, numbers)"
        )

    __neg__ = __sub__ = __rsub__ = __pow__ = __rpow__ = _refused

    def _no_sum(self, other: Any) -> ValueFault:
        """Return why a spectrum and something else have no sum."""
        same = float(other) if type(other) in (int, float) and 0.0 < other < math.inf else 1.0
        return ValueFault(
            f"{self.label} + {shown(other)} is no spectrum; add a spectrum, such as "
            f"Spectrum.constant({shown(same)}), which is the same at each wavelength"
        )

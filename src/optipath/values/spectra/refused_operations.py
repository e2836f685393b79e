"""RefusedOperations: what cannot be done with spectra as with numbers, and what to do instead."""

from __future__ import annotations

import math
from typing import Any, NoReturn

from optipath.errors import ValueFault, shown

_OF_NUMBERS = (
    "compute with its numbers, spectrum.at(wavelengths), and make one of what comes of it, "
    "Spectrum.sampled(wavelengths, numbers)"
)


class RefusedOperations:
    """Differences and powers, which are refused with the cure."""

    label: str

    def __neg__(self) -> NoReturn:
        self._refuse_less(f"-({self.label})")

    def __sub__(self, other: Any) -> NoReturn:
        self._refuse_less(f"{self.label} - {_named(other)}")

    def __rsub__(self, other: Any) -> NoReturn:
        self._refuse_less(f"{_named(other)} - {self.label}")

    def __pow__(self, other: Any) -> NoReturn:
        raise ValueFault(f"{self.label} ** {_named(other)} is no spectrum; {_OF_NUMBERS}")

    def __rpow__(self, other: Any) -> NoReturn:
        raise ValueFault(f"{_named(other)} ** ({self.label}) is no spectrum; {_OF_NUMBERS}")

    def _refuse_less(self, what: str) -> NoReturn:
        raise ValueFault(f"{what} is no spectrum, which is nowhere below 0; {_OF_NUMBERS}")

    def _no_sum(self, other: Any) -> ValueFault:
        """Return why a spectrum and something else have no sum."""
        number = isinstance(other, (int, float)) and not isinstance(other, bool)
        same = float(other) if number and 0.0 < other < math.inf else 1.0
        return ValueFault(
            f"{self.label} + {shown(other)} is no spectrum; add a spectrum, such as "
            f"Spectrum.constant({shown(same)}), which is the same at each wavelength"
        )


def _named(other: Any) -> str:
    return other.label if isinstance(other, RefusedOperations) else shown(other)

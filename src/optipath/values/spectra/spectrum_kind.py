"""SpectrumKind: how power is spread over wavelengths, in bins, along samples or in lines."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np

from optipath.values.arrays.read_only import Unchanging

if TYPE_CHECKING:
    from collections.abc import Hashable


class EmissionLine(NamedTuple):
    """Power at one wavelength.

    Units: wavelength in metres.
    """

    wavelength: float
    power: float
    outside: float | None = None


class SpectrumKind(Unchanging, ABC):
    """One way in which power is spread over wavelengths; a `Spectrum` has one.

    Units: span, extent in metres.
    """

    is_pointwise: ClassVar[bool] = True
    """Whether what it is at each wavelength says all, so that it can be multiplied by others."""
    label: str
    span: tuple[float, float] = (0.0, np.inf)
    beyond: str = ""
    lines: tuple[EmissionLine, ...] = ()

    @property
    def extent(self) -> tuple[float, float]:
        return self.span

    @property
    def integral(self) -> float | None:
        return None

    @property
    def terms(self) -> tuple[SpectrumKind, ...]:
        """What it is the sum of; itself where it is of one kind."""
        return (self,)

    @property
    def breaks(self) -> np.ndarray[Any, Any]:
        """The wavelengths between which it is smooth, in metres."""
        return np.empty(0)

    @property
    @abstractmethod
    def content(self) -> tuple[Hashable, ...]:
        """All that it is made of."""

    @abstractmethod
    def density(self, xp: Any, wavelength: Any) -> Any:
        """Return its power per nanometre, lines aside.

        Units: wavelength in metres.
        """

    @abstractmethod
    def times(self, factor: float) -> SpectrumKind:
        """Return a multiple of it."""

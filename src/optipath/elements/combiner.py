"""Combiner: where beams meet."""

from __future__ import annotations

from typing import ClassVar

from optipath.elements.coupling import Coupling
from optipath.elements.element import Element


class Combiner(Element, kind="combiner"):
    """Adds up all the light that arrives, incoherently, and sends it on.

    Examples
    --------
    >>> Combiner().merges
    True
    """

    merges: ClassVar[bool] = True

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the way straight through."""
        return (Coupling("in", "out", ()),)

"""FourPort: what light meets from the front and from behind."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from optipath.elements.coupling import Coupling
from optipath.elements.element import Element

if TYPE_CHECKING:
    from optipath.values.operation import Operation


class FourPort(Element):
    """An element with two sides.

    Light from the front enters at ``in``; what is reflected leaves at ``reflected``, and what
    passes at ``transmitted``. Light from behind enters at ``back``; what is reflected leaves at
    ``transmitted``, and what passes at ``reflected``.
    """

    inputs: ClassVar[tuple[str, ...]] = ("in", "back")
    outputs: ClassVar[tuple[str, ...]] = ("reflected", "transmitted")
    natural: ClassVar[str] = "reflected"
    entry: ClassVar[str] = "in"
    straight: ClassVar[bool] = False
    _ports_back: ClassVar[dict[str, str]] = {
        "in": "reflected",
        "reflected": "in",
        "back": "transmitted",
        "transmitted": "back",
    }

    def _ways(
        self, front: tuple[Operation, Operation], behind: tuple[Operation, Operation]
    ) -> tuple[Coupling, ...]:
        """Return the couplings for what reflects, and what lets through, from either side."""
        return (
            Coupling("in", "reflected", front[:1], reflects=True),
            Coupling("in", "transmitted", front[1:]),
            Coupling("back", "transmitted", behind[:1], reflects=True),
            Coupling("back", "reflected", behind[1:]),
        )

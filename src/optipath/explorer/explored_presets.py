"""What the page may open: the presets, and the file that the command was given."""

from __future__ import annotations

from collections import OrderedDict
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from optipath.errors import ParameterError, unknown
from optipath.explorer.explored_path import ExploredPath
from optipath.paths.presets.loader import load_preset, preset_descriptions

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.paths.path_graph import PathGraph

FIRST = "npgr026"
"""What the page opens where nobody says."""

_KEPT = 48
"""How many paths are kept composed."""


class ExploredPresets:
    """The paths that the page may open, read and composed once.

    Examples
    --------
    >>> presets = ExploredPresets("malus")
    >>> presets.opened, presets.explored("malus", {}).detectors
    ('malus', ('eye',))
    """

    def __init__(self, opened: str = FIRST) -> None:
        self._descriptions = preset_descriptions()
        self._bases: dict[str, PathGraph] = {}
        self._paths: OrderedDict[Any, ExploredPath] = OrderedDict()
        self.file = "" if opened in self._descriptions else opened
        self.opened = opened
        if self.file:
            path = load_preset(self.file)
            self.opened = Path(self.file).name
            self._bases[self.opened] = path
            self._descriptions = {self.opened: path.description, **self._descriptions}
        self.explored(self.opened, {}).plan  # noqa: B018 - whatever is wrong is told at once

    def as_json(self) -> list[dict[str, Any]]:
        """Return what there is, that of the file first."""
        return [
            {"name": name, "description": text, "file": self.is_file(name)}
            for name, text in self._descriptions.items()
        ]

    def is_file(self, preset: str) -> bool:
        """Tell whether a name is that of the file."""
        return bool(self.file) and preset == self.opened

    def source(self, preset: str) -> str:
        """Return what `load_preset` takes for a name: for the file what the command was given."""
        return self.file if self.is_file(preset) else preset

    def base(self, preset: str) -> PathGraph:
        """Return the path of a name, nothing chosen in it."""
        if faults := unknown("preset", preset, self._descriptions):
            raise ParameterError(*faults)
        if preset not in self._bases:
            self._bases[preset] = load_preset(preset)
        return self._bases[preset]

    def explored(
        self,
        preset: str,
        places: Mapping[str, str],
        materials: Mapping[str, Any] = MappingProxyType({}),
        told: tuple[str, ...] = (),
    ) -> ExploredPath:
        """Return a path, composed once for everything that is chosen before."""
        key = preset, *sorted(places.items()), told
        if key not in self._paths:
            path = self.base(preset)
            path = path.with_defaults(**places) if places else path
            path = path.bind(**materials) if materials else path
            self._paths[key] = ExploredPath(preset, path)
            if len(self._paths) > _KEPT:
                self._paths.popitem(last=False)
        self._paths.move_to_end(key)
        return self._paths[key]

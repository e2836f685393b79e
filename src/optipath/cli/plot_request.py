"""What ``optipath plot`` is asked for: a path, what varies, and where its light is looked at."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from optipath.cli.changed_title import title_of
from optipath.cli.given_axes import refuse_arrays
from optipath.errors import ParameterError, listed, shown, unknown
from optipath.paths.presets.loader import preset_of_case

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping, Sequence

    from optipath.cli.chosen import Chosen
    from optipath.paths.path_graph import PathGraph
    from optipath.plan.plan import Plan
    from optipath.values.axis_texts import AxisValues


@dataclass(frozen=True)
class PlotRequest:
    """What is to be drawn."""

    kind: str
    title: str
    path: PathGraph
    axes: dict[str, AxisValues | None]
    quantities: tuple[str, ...]
    ends: tuple[str, ...]
    published: Mapping[str, tuple[float, ...]]

    @property
    def end(self) -> str:
        """The only end at which the light is looked at."""
        if len(self.ends) > 1:
            raise ParameterError(
                f"the path has the detectors {listed(self.ends)}, of which this picture has one; "
                f"add --detector {self.ends[0]}"
            )
        return self.ends[0]


def request_of(
    chosen: Chosen,
    kind: str,
    counts: range,
    *,
    x: Sequence[str],
    y: str | None,
    detector: str | None,
    reads: str | None,
) -> PlotRequest:
    """Return what a command line asks for."""
    names = [name.strip().lstrip("-").replace("-", "_") for name in x]
    axes = {name: chosen.axes.get(name) for name in [*names, *chosen.axes]}
    quantities = tuple(["S0"] if y is None else [name.strip() for name in y.split(",")])
    path = _opened(chosen, reads)
    refuse_arrays(path, axes)
    plan = path.compose()
    ends, faults = _ends(plan, detector)
    faults += _array_faults(plan)
    faults += _name_faults(chosen, names, [*plan.inputs.open])
    faults += _count_faults(kind, counts, axes, [*plan.inputs.open])
    if len(axes) > 1 and len(quantities) > 1:
        faults.append(f"a map is of one quantity, and --y names {len(quantities)}; give one")
    if detector is not None and kind == "poincare" and not axes:
        faults.append(
            "--detector is of a trail along --x, and without it the trail goes along the whole "
            "path; add --x NAME, or leave --detector out"
        )
    if faults:
        raise ParameterError(*faults)
    changed = bool(chosen.values or chosen.axes or reads)
    published = {} if changed or chosen.case is None else path.cases[chosen.case].published
    title = title_of(chosen, reads=reads, at=detector)
    return PlotRequest(kind, title, path, axes, quantities, ends, published)


def _opened(chosen: Chosen, reads: str | None) -> PathGraph:
    """Return the path, in which all that nobody has given stays open."""
    opened = chosen.opened
    if chosen.case is not None:
        opened = preset_of_case(opened, chosen.preset, chosen.case)
    return replace(chosen, opened=opened, case=None).path(reads)


def _ends(plan: Plan, detector: str | None) -> tuple[tuple[str, ...], list[str]]:
    detectors, dumps = ([*names] for names in (plan.program.detectors, plan.program.dumps))
    if detector is None:
        return (*(detectors or dumps),), []
    return (detector,), unknown("detector", detector, [*detectors, *dumps])


def _array_faults(plan: Plan) -> list[str]:
    """Return which parameters have several values, of which a picture has one, a sentence each."""
    inputs = plan.inputs
    return [
        f"parameter '{name}' has several values in the file, and a picture is of one; give one by "
        f"--{name.replace('_', '-')}"
        for name, parameter in {**inputs.open, **inputs.bound}.items()
        if isinstance(parameter.default, np.ndarray)
        and parameter.default.ndim > len(inputs.tails.get(name, ()))
    ]


def _name_faults(chosen: Chosen, names: Sequence[str], known: Sequence[str]) -> list[str]:
    """Return what is wrong with the names of what varies, a sentence each."""
    faults = []
    for name in dict.fromkeys(names):
        flag = f"--{name.replace('_', '-')}"
        if names.count(name) > 1:
            faults.append(f"--x {name} is given {names.count(name)} times; give it once")
        if name in chosen.opened.choices:
            faults.append(f"--x {name} is a place, of which no axis has several; give {flag} WORD")
        elif name in chosen.values:
            faults.append(f"--x {name} varies what {flag} gives one value; leave one of them out")
        else:
            faults += unknown("--x", name, known)
    for name, values in chosen.axes.items():
        flag = f"--{name.replace('_', '-')}"
        if values.shown.dtype.kind == "U":
            word = next(one for one in values.shown.tolist() if one[:1].isalpha())
            faults.append(
                f"{flag} has the word {shown(word)}, and an axis is of numbers; leave it out"
            )
        if name not in known:
            faults.append(
                f"{flag} is given several values, and nothing depends on it; leave it out"
            )
    return faults


def _count_faults(
    kind: str, counts: range, axes: Collection[str], known: Sequence[str]
) -> list[str]:
    """Return what is wrong with how many parameters vary, a sentence each."""
    faults = []
    flags = [f"--{name.replace('_', '-')}" for name in axes]
    if len(axes) > counts[-1]:
        if not counts[-1]:
            faults.append(
                f"{listed(flags)} {'is' if len(flags) == 1 else 'are'} given several values, and "
                f"--kind {kind} is of one; give one, or write --kind curve or poincare"
            )
            return faults
        most = "two parameters" if counts[-1] > 1 else "one parameter"
        faults.append(
            f"--kind {kind} is along {most} at most, and {listed(flags)} vary; give one value of "
            f"the others"
        )
    if len(axes) < counts[0]:
        example = next(iter(known), "NAME").replace("_", "-")
        faults.append(
            f"--kind {kind} is along a parameter; name it, --x {example}, or give it several "
            f"values, --{example} START:STOP:COUNT"
        )
    return faults

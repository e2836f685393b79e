"""What the Dataset of a sweep says of itself: its path, its plan, its frames, the version."""

from __future__ import annotations

from dataclasses import fields
from importlib.metadata import version
from typing import TYPE_CHECKING, Any
from weakref import WeakKeyDictionary

from optipath.composer.composer import Composer
from optipath.errors import PathError, listed
from optipath.light.frames import Frame

if TYPE_CHECKING:
    from optipath.paths.path_graph import PathGraph
    from optipath.plan.answers import Answers
    from optipath.plan.plan import Plan

_COMPONENTS = ("S0", "S1", "S2", "S3")
_NOT_TOLD = ("threads", "keep")


def dataset_attributes(
    path: PathGraph, plan: Plan, composer: Composer | None = None
) -> dict[str, str | float]:
    """Return the attributes of the Dataset of a sweep, texts and numbers.

    Examples
    --------
    >>> import optipath as op
    >>> path = op.load_preset("malus")
    >>> attributes = dataset_attributes(path, path.compose())
    >>> attributes["method"], attributes["frame"]
    ('stable', 'eye: x = 1, 0, 0; y = 0, 1, 0; z = 0, 0, 1')
    """
    kept = _KEPT.get(plan.answers)
    words = path.description, dict(path.cases)
    if kept is None or kept[0] != words:
        kept = _KEPT[plan.answers] = words, _told(path, plan, composer or Composer())
    return dict(kept[1])


_KEPT: WeakKeyDictionary[Answers, tuple[Any, dict[str, str | float]]] = WeakKeyDictionary()
"""By what belongs to one plan alone; telling all of it takes longer than to run 1e6 points."""


def _told(path: PathGraph, plan: Plan, composer: Composer) -> dict[str, str | float]:
    options = {each.name: getattr(composer, each.name) for each in fields(Composer)}
    told = {name: value for name, value in options.items() if name not in _NOT_TOLD}
    return {
        "path": _toml(path),
        "explanation": plan.explain(),
        "optipath_version": version("optipath"),
        **{name: value for name, value in told.items() if value is not None},
        "frame": "\n".join(f"{name}: {_axes(end.frame)}" for name, end in _ends(plan)),
        **_unread(plan),
    }


def _toml(path: PathGraph) -> str:
    try:
        return path.to_toml()
    except PathError as fault:
        return f"the path cannot be written here, since it has no form in TOML: {fault}"


def _ends(plan: Plan) -> Any:
    return plan.program.detectors.items()


def _axes(frame: Any) -> str:
    if not isinstance(frame, Frame) or frame.z.ndim > 1:
        return "depends on the values"
    axes = {name: getattr(frame, name).tolist() for name in "xyz"}
    return "; ".join(f"{name} = {', '.join(map(_short, axis))}" for name, axis in axes.items())


def _short(number: float) -> str:
    """Return a number with all its digits, and without a point where it is whole."""
    return repr(number + 0.0).removesuffix(".0")


def _unread(plan: Plan) -> dict[str, str]:
    """Return a sentence of the components that detectors do not read, if there are any."""
    several = [(name, end.components) for name, end in _ends(plan) if end.components < 4]
    told = [
        f"{listed(_COMPONENTS[count:])} at {name}, which reads {listed(_COMPONENTS[:count])}"
        for name, count in several
    ]
    return {"unread": f"NaN: {'; '.join(told)}"} if told else {}

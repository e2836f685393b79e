"""What the page is answered: what there is, a path that is opened, traced or exported."""

from __future__ import annotations

import warnings
from contextlib import contextmanager
from importlib.metadata import version
from threading import Lock
from typing import TYPE_CHECKING, Any

from optipath.errors import AngleWarning, LoopWarning, OptipathError
from optipath.explorer.asked_state import asked_state
from optipath.explorer.exported_state import exported_as_json
from optipath.explorer.path_as_json import path_as_json
from optipath.explorer.read_values import FieldFaults, read_path, read_state
from optipath.explorer.traced_state import traced_as_json
from optipath.spelling import few_suggestions
from optipath.values.cures import of_fields, of_files
from optipath.values.written_units import units_are_written

if TYPE_CHECKING:
    from collections.abc import Iterator

    from optipath.explorer.explored_presets import ExploredPresets

_WARNINGS = (AngleWarning, LoopWarning)
_STATE = ("case", "places", "values", "detector", "curve", "want")


class PageAnswers:
    """What answers the page; one request after the other, since plans are shared.

    Examples
    --------
    >>> from optipath.explorer.explored_presets import ExploredPresets
    >>> answers = PageAnswers(ExploredPresets("malus"))
    >>> answers.trace({"preset": "malus", "values": {"angle": "60"}})["detectors"]["eye"]["texts"]
    ['0.125', '-0.0625', '0.108253', '0']
    """

    def __init__(self, presets: ExploredPresets) -> None:
        self._presets = presets
        self._lock = Lock()

    def presets(self) -> dict[str, Any]:
        """Return what may be opened, and what is opened first."""
        return {
            "presets": self._presets.as_json(),
            "opened": self._presets.opened,
            "version": version("optipath"),
        }

    def open(self, given: Any) -> dict[str, Any]:
        """Return what the page is told of a path."""
        with self._answering():
            asked = asked_state(given, ("places",))
            return _or_faults(
                lambda: {"faults": [], **path_as_json(read_path(self._presets, asked))}
            )

    def trace(self, given: Any) -> dict[str, Any]:
        """Return what the page shows of a state."""
        with self._answering() as told:
            asked = asked_state(given, _STATE)
            found = _or_faults(lambda: traced_as_json(read_state(self._presets, asked)))
            return found if found["faults"] else found | {"notes": [*found["notes"], *told()]}

    def export(self, given: Any) -> dict[str, Any]:
        """Return a state as a file, and what it is called."""
        with self._answering():
            asked = asked_state(given, (*_STATE, "form"), ("form",))
            return _or_faults(lambda: exported_as_json(self._presets, asked))

    @contextmanager
    def _answering(self) -> Iterator[Any]:
        """Let one request at a time be answered, its warnings told, as at the command line."""
        with (
            self._lock,
            few_suggestions(),
            of_files(),
            of_fields(),
            units_are_written(),
            warnings.catch_warnings(record=True) as heard,
        ):
            for kind in _WARNINGS:
                warnings.simplefilter("always", kind)
            yield lambda: dict.fromkeys(
                str(each.message) for each in heard or () if issubclass(each.category, _WARNINGS)
            )


def _or_faults(answer: Any) -> dict[str, Any]:
    """Return an answer, or what is wrong with the fields that it is asked by."""
    try:
        return dict(answer())
    except FieldFaults as found:
        return {"faults": [fault._asdict() for fault in found.faults]}
    except OptipathError as error:
        return {"faults": [{"field": None, "sentence": each} for each in error.faults]}

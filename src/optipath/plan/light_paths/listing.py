"""The ways of light through a path, listed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import ParameterError
from optipath.plan.light_paths.best_first import Search
from optipath.plan.light_paths.cycles import endless
from optipath.values.whole_numbers import whole_number

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from optipath.light.light import Light
    from optipath.plan.light_paths.light_path import LightPath
    from optipath.plan.running.runner import Runner


def light_paths(
    whole: Runner,
    limit: int | None,
    bounces: int | None,
    parameters: Mapping[str, Any],
    as_light: Callable[[Any, Any], Light],
) -> list[LightPath]:
    """Return the ways of light through a path, the brightest first."""
    faults = [] if limit is None else whole_number("limit", limit)
    faults += [] if bounces is None else whole_number("bounces", bounces, 0)
    if faults:
        raise ParameterError(*faults)
    if limit is None and (place := endless(whole.program, bounces)):
        cure = "a limit" if bounces is not None else "a limit, or a number of bounces"
        raise ParameterError(f"light goes round at '{place}' for ever; give {cure}")
    whole.for_jax.refuse_traced(parameters, "light paths are listed")
    _, batch = whole.inputs.resolve(parameters)
    found: list[LightPath] = []
    with whole.enough_for(batch, 4 * len(whole.program.readings) + 16):
        # Refuses light that never fades.
        whole.interpreter.lights(whole.reader.read(parameters))
        for path in Search(whole, parameters, as_light).paths(bounces):
            if len(found) == limit:
                break
            found.append(path)
    return found

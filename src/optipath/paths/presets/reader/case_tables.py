"""Reading a case: values for parameters, and what was published for them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import did_you_mean, shown
from optipath.paths.format import schema
from optipath.paths.format.codec import decode_given
from optipath.values.cases import Case

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Mapping

    from optipath.paths.format.faults import Faults
    from optipath.values.parameters import Parameter
    from optipath.values.use import Use

_LARGEST = 1e308


def read_case(
    where: str,
    table: dict[str, Any],
    parameters: Mapping[str, Parameter],
    doubtful: Collection[str],
    uses: Iterable[Use],
    faults: Faults,
) -> Case:
    """Return the case that a table describes, without what is faulty in it."""
    if loose := [name for name in table if name in parameters and name not in schema.CASE]:
        faults.append(
            f"{where}: the values of parameters stand in a table of their own; write values = "
            f"{{ {loose[0]} = ... }}"
        )
        table = {name: value for name, value in table.items() if name not in loose}
    sound = schema.checked(where, table, schema.CASE, faults)
    if sound is None:
        return Case({})
    table = sound
    values = {}
    for name, raw in table.get("values", {}).items():
        if name in doubtful:
            continue
        if name not in parameters:
            cure = did_you_mean(name, parameters)
            faults.append(f"{where}: parameter '{name}' is unknown{cure}")
            continue
        parameter = parameters[name]
        value = faults.attempt(f"{where}.{name}", decode_given, raw, parameter, uses)
        if value is not None:
            faults.attempt(f"{where}.{name}", parameter.resolve, value)
            values[name] = value
    published = {}
    for name, stokes in table.get("published", {}).items():
        if _is_stokes(stokes):
            published[name] = tuple(map(float, stokes))
        else:
            at = f"{where}.published.{name}"
            faults.append(f"{at} must be four finite numbers, not {shown(stokes)}")
    return Case(values, published, table.get("note", ""))


def _is_stokes(stokes: Any) -> bool:
    if not isinstance(stokes, list) or len(stokes) != 4:
        return False
    return all(type(part) in (int, float) and abs(part) < _LARGEST for part in stokes)

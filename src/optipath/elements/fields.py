"""The fields of an element class: which values are allowed in each, and when two are the same."""

from __future__ import annotations

from dataclasses import fields, is_dataclass
from functools import cache
from typing import TYPE_CHECKING, Any, get_args, get_type_hints

from optipath.elements.coupling import numbers_of
from optipath.errors import PathError
from optipath.values.arrays.read_only import same
from optipath.values.domains.domain import Domain
from optipath.values.domains.indices import INDEX
from optipath.values.domains.quantities import REAL, YES_OR_NO
from optipath.values.domains.stack_indices import INDICES
from optipath.values.domains.thick_layers import LENGTH_OF_LAYER, LENGTHS

if TYPE_CHECKING:
    from collections.abc import Iterator


@cache
def domains_of(element_class: type[Any]) -> dict[str, Domain]:
    """Return the domain that each field is annotated with, in order.

    Without one it is a real number, or True or False where that is what it says.
    """
    try:
        hints = get_type_hints(element_class, include_extras=True)
    except NameError as error:
        raise PathError(
            f"the annotations of element class {element_class.__name__} cannot be read: {error}; "
            f"import it where the module runs, not for type checking alone"
        ) from None
    # The base of all elements is no dataclass, and has no fields.
    own = fields(element_class) if is_dataclass(element_class) else ()
    plain = {f.name: YES_OR_NO if hints[f.name] is bool else REAL for f in own}
    return {name: next(_annotated(hints[name]), domain) for name, domain in plain.items()}


def _annotated(hint: Any) -> Iterator[Domain]:
    for part in get_args(hint):
        if isinstance(part, Domain):
            yield part
        else:
            yield from _annotated(part)


def same_value(first: Any, second: Any, domain: Domain) -> bool:
    """Tell whether two values of a field are equal, however an index is written."""
    listed = {INDICES: INDEX, LENGTHS: LENGTH_OF_LAYER}.get(domain)
    if listed is not None and isinstance(first, tuple) and isinstance(second, tuple):
        return len(first) == len(second) and all(
            same_value(one, other, listed) for one, other in zip(first, second, strict=True)
        )
    if same(first, second) or not domain.complex_parts:
        return same(first, second)
    pairs = zip(numbers_of(first, domain), numbers_of(second, domain), strict=True)
    return all(same(one, other) for one, other in pairs)

"""Lists in preset files of which each entry is a value of its own: of indices, and of lengths."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import PresetError, shown
from optipath.paths.format.faults import Faults
from optipath.values.domains.indices import FOLLOWED_OUTSIDE, INDEX
from optipath.values.domains.stack_indices import IndicesDomain
from optipath.values.domains.thick_layers import LENGTH_OF_LAYER, LengthsDomain
from optipath.values.follows import FOLLOWS

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.values.domains.domain import Domain


def entry_domain(domain: Domain) -> Domain | None:
    """Return what each entry of a list may be; None where a value is no list of values."""
    if isinstance(domain, IndicesDomain):
        return INDEX
    return LENGTH_OF_LAYER if isinstance(domain, LengthsDomain) else None


def decode_list(raw: Any, domain: Domain, decode: Callable[[Any, Domain], Any]) -> list[Any]:
    """Return the values of a list."""
    of_indices, each = isinstance(domain, IndicesDomain), entry_domain(domain)
    assert each is not None  # noqa: S101 - asked for lists alone
    if not isinstance(raw, list):
        what, example = (
            ("indices", "[1, 1.5, { n = 0.6, k = 2 }]")
            if of_indices
            else ("lengths", '["2 mm", "0.1 mm"]')
        )
        raise PresetError(f"{shown(raw)} is no list of {what}; write {example}")
    faults, found = Faults(), []
    for place, entry in enumerate(raw):
        # The medium in front may be misspelt as well.
        of_entry = FOLLOWED_OUTSIDE if of_indices and not place else each
        follows = of_indices and entry == FOLLOWS.word
        found.append(FOLLOWS if follows else faults.attempt(f"[{place}]", decode, entry, of_entry))
    if faults:
        raise PresetError(*faults)
    return found

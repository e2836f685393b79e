"""Whether there is a wavelength at which all materials and spectra of a path are known."""

from __future__ import annotations

from typing import TYPE_CHECKING

from optipath.values.curves.wavelength_range import WavelengthRange, is_within, span_text

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from optipath.values.use import Use


def range_faults(uses: Iterable[Use]) -> Iterator[str]:
    """Yield a sentence for each parameter at no value of which all curves are known."""
    asked: dict[str, list[tuple[tuple[float, float], WavelengthRange]]] = {}
    for use in uses:
        if use.is_open and isinstance(use.domain, WavelengthRange):
            span = use.value.span_for(*use.domain.interval)
            asked.setdefault(use.value.name, []).append((span, use.domain))
    for name, ranges in asked.items():
        (least, above) = max(ranges, key=lambda one: one[0][0])
        (most, below) = min(ranges, key=lambda one: one[0][1])
        if is_within(least[0], (0.0, most[1])):
            continue
        beyond = dict.fromkeys(filter(None, [below.beyond, above.beyond]))
        spans = [f"{one.label} is known within {span_text(one.interval)}" for one in (below, above)]
        otherwise = "".join(f", or {each}" for each in beyond)
        yield (
            f"parameter '{name}' can have no value: {' and '.join(spans)}; take what is known at "
            f"a common wavelength{otherwise}"
        )

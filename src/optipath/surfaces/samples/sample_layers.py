"""The layers of a sample as they are given, and what does not fit with them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import shown
from optipath.surfaces.fields.height_field import HeightField
from optipath.surfaces.samples.sample_layer import layer_of
from optipath.surfaces.samples.sample_media import BASE, CLEAR_MEDIUM

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.paths.format.faults import Faults
    from optipath.surfaces.samples.sample_layer import SampleLayer


def layers_of(given: Any, faults: Faults) -> tuple[SampleLayer, ...]:
    """Return the layers of a sample as it keeps them."""
    if not isinstance(given, (list, tuple)) or not given:
        faults.append(
            f"layers is {shown(given)}; give a list with a pair for each interface, the index of "
            f"refraction below it and its roughness, such as [(1.5, 0.1)]"
        )
        return ()
    domains = [CLEAR_MEDIUM] * (len(given) - 1) + [BASE]
    found = [
        faults.attempt("", layer_of, f"layers[{place}]", layer, domain)
        for place, (layer, domain) in enumerate(zip(given, domains, strict=True))
    ]
    return tuple([layer for layer in found if layer is not None])


def unused_faults(layers: Sequence[SampleLayer], cells: Any, *, periodic: bool) -> list[str]:
    """Return a sentence for what is given of random fields and says nothing of those there are.

    Examples
    --------
    >>> from optipath.surfaces.samples.sample_layer import SampleLayer
    >>> unused_faults([SampleLayer(1.5, (0.0, 0.0))], (640, 640), periodic=True)
    ['cells is given, but no interface is random; leave it out']
    """
    found = []
    if cells is not None and not any(layer.is_random for layer in layers):
        found.append("cells is given, but no interface is random; leave it out")
    for place, layer in enumerate(layers):
        heights = layer.roughness if isinstance(layer.roughness, HeightField) else None
        if not periodic and heights is not None and heights.periodic and not heights.is_flat:
            found.append(
                f"periodic is False, but the heights of layers[{place}] are periodic; give those a "
                f"border, or leave periodic out, which is of random fields"
            )
    return found

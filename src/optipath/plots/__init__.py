"""Pictures, drawn with Matplotlib into axes that are given or made; nothing is shown by itself."""

from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from optipath.errors import MissingExtraError
from optipath.spelling import closest

if TYPE_CHECKING:
    from optipath.plots.difference_discs import differences
    from optipath.plots.facet_panel import beside_facets
    from optipath.plots.hemisphere_map import hemisphere
    from optipath.plots.mueller_map import mueller_hemisphere
    from optipath.plots.plane_curves import in_plane
    from optipath.plots.saving import save

__all__ = [
    "beside_facets",
    "differences",
    "hemisphere",
    "in_plane",
    "mueller_hemisphere",
    "save",
]

_HOMES = {
    "beside_facets": "facet_panel",
    "differences": "difference_discs",
    "hemisphere": "hemisphere_map",
    "in_plane": "plane_curves",
    "mueller_hemisphere": "mueller_map",
    "save": "saving",
}
"""Where the names are from; each is imported when it is used (PEP 562)."""


def __dir__() -> list[str]:
    return __all__


if not TYPE_CHECKING:  # Else any name would do for who checks types.

    def __getattr__(name: str) -> Any:
        if name not in _HOMES:
            near = closest(name, __all__)
            cure = f"; did you mean '{near}'?" if near else ""
            raise AttributeError(f"module 'optipath.plots' has no attribute '{name}'{cure}")
        if find_spec("matplotlib") is None:
            raise MissingExtraError("pictures", "matplotlib", "plot")
        module = import_module(f"optipath.plots.{_HOMES[name]}")
        return globals().setdefault(name, getattr(module, name))

"""Pictures, drawn with Matplotlib into axes that are given or made; nothing is shown by itself."""

from importlib.util import find_spec
from typing import TYPE_CHECKING

from optipath.errors import MissingExtraError
from optipath.lazy_names import lazy_names

if TYPE_CHECKING:
    from optipath.plots.hemispheres.difference_discs import differences
    from optipath.plots.hemispheres.facet_panel import beside_facets
    from optipath.plots.hemispheres.hemisphere_map import hemisphere
    from optipath.plots.hemispheres.mueller_map import mueller_hemisphere
    from optipath.plots.hemispheres.plane_curves import in_plane
    from optipath.plots.saved_picture import save
    from optipath.plots.space.optical_bench import bench
    from optipath.plots.space.picture_in_space import geometry

__all__ = [
    "bench",
    "beside_facets",
    "differences",
    "geometry",
    "hemisphere",
    "in_plane",
    "mueller_hemisphere",
    "save",
]

_HOMES = {
    "hemispheres.difference_discs": ["differences"],
    "hemispheres.facet_panel": ["beside_facets"],
    "hemispheres.hemisphere_map": ["hemisphere"],
    "hemispheres.mueller_map": ["mueller_hemisphere"],
    "hemispheres.plane_curves": ["in_plane"],
    "saved_picture": ["save"],
    "space.optical_bench": ["bench"],
    "space.picture_in_space": ["geometry"],
}
"""Where the names are from; each is imported when it is used (PEP 562)."""


def _check_matplotlib() -> None:
    if find_spec("matplotlib") is None:
        raise MissingExtraError("pictures", "matplotlib", "plot")


if not TYPE_CHECKING:  # Else any name would do for who checks types.
    __getattr__, __dir__ = lazy_names(__name__, _HOMES, needs=_check_matplotlib)

"""Pictures, drawn with Matplotlib into axes that are given or made; nothing is shown by itself."""

from typing import TYPE_CHECKING

from optipath.extras import need
from optipath.lazy_names import lazy_names

if TYPE_CHECKING:
    from optipath.plots.charts.drawn_chart import chart
    from optipath.plots.curves.parameter_curve import curve
    from optipath.plots.curves.quantity_map import quantity_map
    from optipath.plots.curves.reflection_curves import reflection
    from optipath.plots.flow.energy_picture import energy
    from optipath.plots.hemispheres.difference_discs import differences
    from optipath.plots.hemispheres.facet_panel import beside_facets
    from optipath.plots.hemispheres.hemisphere_map import hemisphere
    from optipath.plots.hemispheres.mueller_map import mueller_hemisphere
    from optipath.plots.hemispheres.plane_curves import in_plane
    from optipath.plots.saved_picture import save
    from optipath.plots.space.optical_bench import bench
    from optipath.plots.space.picture_in_space import geometry
    from optipath.plots.states.ellipse_picture import ellipse
    from optipath.plots.states.mueller_picture import mueller
    from optipath.plots.states.sphere_picture import poincare
    from optipath.plots.states.sphere_trail import poincare_path
    from optipath.plots.states.stokes_bars import stokes

__all__ = [
    "bench",
    "beside_facets",
    "chart",
    "curve",
    "differences",
    "ellipse",
    "energy",
    "geometry",
    "hemisphere",
    "in_plane",
    "mueller",
    "mueller_hemisphere",
    "poincare",
    "poincare_path",
    "quantity_map",
    "reflection",
    "save",
    "stokes",
]

_HOMES = {
    "charts.drawn_chart": ["chart"],
    "curves.parameter_curve": ["curve"],
    "curves.quantity_map": ["quantity_map"],
    "curves.reflection_curves": ["reflection"],
    "flow.energy_picture": ["energy"],
    "hemispheres.difference_discs": ["differences"],
    "hemispheres.facet_panel": ["beside_facets"],
    "hemispheres.hemisphere_map": ["hemisphere"],
    "hemispheres.mueller_map": ["mueller_hemisphere"],
    "hemispheres.plane_curves": ["in_plane"],
    "saved_picture": ["save"],
    "space.optical_bench": ["bench"],
    "space.picture_in_space": ["geometry"],
    "states.ellipse_picture": ["ellipse"],
    "states.mueller_picture": ["mueller"],
    "states.sphere_picture": ["poincare"],
    "states.sphere_trail": ["poincare_path"],
    "states.stokes_bars": ["stokes"],
}
"""Where the names are from; each is imported when it is used (PEP 562)."""


def check_matplotlib() -> None:
    """Raise where Matplotlib is not installed."""
    need("pictures", "matplotlib")


if not TYPE_CHECKING:  # Else any name would do for who checks types.
    __getattr__, __dir__ = lazy_names(__name__, _HOMES, needs=check_matplotlib)

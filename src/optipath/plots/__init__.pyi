# The public names, each from the module that defines it; read when one is first used.

from optipath.plots.axes import save as save
from optipath.plots.charts import chart as chart
from optipath.plots.ellipses import ellipse as ellipse
from optipath.plots.energy_flow import energy as energy
from optipath.plots.hemisphere_maps import beside_facets as beside_facets
from optipath.plots.hemisphere_maps import differences as differences
from optipath.plots.hemisphere_maps import hemisphere as hemisphere
from optipath.plots.hemisphere_maps import mueller_hemisphere as mueller_hemisphere
from optipath.plots.mueller_matrix import mueller as mueller
from optipath.plots.parameter_curves import curve as curve
from optipath.plots.parameter_curves import quantity_map as quantity_map
from optipath.plots.plane_curves import in_plane as in_plane
from optipath.plots.poincare_sphere import poincare as poincare
from optipath.plots.poincare_sphere import poincare_path as poincare_path
from optipath.plots.reflection_curves import reflection as reflection
from optipath.plots.scene.bench import bench as bench
from optipath.plots.scene.geometry import geometry as geometry
from optipath.plots.stokes_bars import stokes as stokes

def check_matplotlib() -> None: ...

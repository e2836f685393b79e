# The public names, each from the module that defines it; read when one is first used.

from optipath.surfaces.ends import photon_ends as photon_ends
from optipath.surfaces.energy_shares import energy as energy
from optipath.surfaces.facet_model import single_scattering as single_scattering
from optipath.surfaces.formats.hemisphere_files import load_hemisphere as load_hemisphere
from optipath.surfaces.formats.mitsuba import write_measured_polarized as write_measured_polarized
from optipath.surfaces.height_field import HeightField as HeightField
from optipath.surfaces.hemisphere.hemisphere import Hemisphere as Hemisphere
from optipath.surfaces.hemisphere.measure import measure as measure
from optipath.surfaces.hemisphere.sensor import Sensor as Sensor
from optipath.surfaces.model_choice import ModelChoice as ModelChoice
from optipath.surfaces.model_choice import decide as decide
from optipath.surfaces.photon import Photon as Photon

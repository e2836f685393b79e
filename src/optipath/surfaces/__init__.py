"""Rough surfaces: fields of heights, samples of such layers, and photons that walk over them."""

from typing import TYPE_CHECKING

from optipath.lazy_names import lazy_names

if TYPE_CHECKING:
    from optipath.surfaces.decisions.decide import decide
    from optipath.surfaces.decisions.model_choice import ModelChoice
    from optipath.surfaces.ends.photon_ends import photon_ends
    from optipath.surfaces.energies.energy import energy
    from optipath.surfaces.facets.facet_model import single_scattering
    from optipath.surfaces.fields.height_field import HeightField
    from optipath.surfaces.files.load_hemisphere import load_hemisphere
    from optipath.surfaces.files.measured_polarized import write_measured_polarized
    from optipath.surfaces.hemispheres.hemisphere import Hemisphere
    from optipath.surfaces.hemispheres.measure import measure
    from optipath.surfaces.hemispheres.sensor import Sensor
    from optipath.surfaces.replay.photon import Photon

__all__ = [
    "HeightField",
    "Hemisphere",
    "ModelChoice",
    "Photon",
    "Sensor",
    "decide",
    "energy",
    "load_hemisphere",
    "measure",
    "photon_ends",
    "single_scattering",
    "write_measured_polarized",
]

_HOMES = {
    "decisions.decide": ["decide"],
    "decisions.model_choice": ["ModelChoice"],
    "ends.photon_ends": ["photon_ends"],
    "energies.energy": ["energy"],
    "facets.facet_model": ["single_scattering"],
    "fields.height_field": ["HeightField"],
    "files.load_hemisphere": ["load_hemisphere"],
    "files.measured_polarized": ["write_measured_polarized"],
    "hemispheres.hemisphere": ["Hemisphere"],
    "hemispheres.measure": ["measure"],
    "hemispheres.sensor": ["Sensor"],
    "replay.photon": ["Photon"],
}
"""Where the names are from; each is imported when it is used (PEP 562), without a compiler."""


if not TYPE_CHECKING:  # Else any name would do for who checks types.
    __getattr__, __dir__ = lazy_names(__name__, _HOMES)

"""Rough surfaces: fields of heights, samples of such layers, and photons that walk over them."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from optipath.spelling import closest

if TYPE_CHECKING:
    from optipath.surfaces.decisions.decide import decide
    from optipath.surfaces.decisions.model_choice import ModelChoice
    from optipath.surfaces.ends.photon_ends import photon_ends
    from optipath.surfaces.energies.energy import energy
    from optipath.surfaces.facets.facet_model import single_scattering
    from optipath.surfaces.fields.height_field import HeightField
    from optipath.surfaces.files.load_hemisphere import load_hemisphere
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
]

_HOMES = {
    "HeightField": "fields.height_field",
    "Photon": "replay.photon",
    "Hemisphere": "hemispheres.hemisphere",
    "Sensor": "hemispheres.sensor",
    "ModelChoice": "decisions.model_choice",
    "decide": "decisions.decide",
    "energy": "energies.energy",
    "load_hemisphere": "files.load_hemisphere",
    "measure": "hemispheres.measure",
    "photon_ends": "ends.photon_ends",
    "single_scattering": "facets.facet_model",
}
"""Where the names are from; each is imported when it is used (PEP 562), without a compiler."""


def __dir__() -> list[str]:
    return __all__


if not TYPE_CHECKING:  # Else any name would do for who checks types.

    def __getattr__(name: str) -> Any:
        if name not in _HOMES:
            near = closest(name, __all__)
            cure = f"; did you mean '{near}'?" if near else ""
            raise AttributeError(f"module 'optipath.surfaces' has no attribute '{name}'{cure}")
        module = import_module(f"optipath.surfaces.{_HOMES[name]}")
        return globals().setdefault(name, getattr(module, name))

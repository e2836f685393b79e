"""Polarised light along optical paths.

Optical elements are nodes of a path graph, each with its own reference frames. A
composer aligns the frames and orders the work; the plan it makes runs on one set of
values or on millions.
"""

from optipath import starting  # noqa: F401 - first, for Ctrl-C while the others are imported

# isort: split
from optipath.angles import CosSin
from optipath.cases import Case
from optipath.certificate import Certificate, intensity_bounds
from optipath.composer import Composer
from optipath.domains import (
    Absorption,
    Amplitude,
    Angle,
    AnglePerLength,
    Fraction,
    Incidence,
    Index,
    Length,
    MuellerMatrix,
    NonNegative,
    Real,
    StokesState,
)
from optipath.elements import (
    Attenuator,
    BeamSplitter,
    Combiner,
    Coupling,
    Depolarizer,
    Detector,
    Diattenuator,
    Dump,
    Element,
    Interface,
    LayerStack,
    Medium,
    Mirror,
    MuellerElement,
    Operation,
    Polarizer,
    Retarder,
    Rotator,
    Source,
    SpecularVertex,
)
from optipath.errors import (
    ComposerError,
    FrameError,
    LoopWarning,
    OptipathError,
    ParameterError,
    PathError,
    PresetError,
    ShapeError,
    UnitError,
    ValueFault,
)
from optipath.frames import Frame
from optipath.fresnel import fresnel_reflection, fresnel_transmission, refraction_angle
from optipath.incidence import PlaneOfIncidence, plane_of_incidence
from optipath.light import Light
from optipath.light_paths import LightPath
from optipath.materials import Material
from optipath.mueller import LuChipman, Mueller
from optipath.parameters import Parameter
from optipath.path_graph import PathGraph
from optipath.plan import Plan
from optipath.polarization_matters import Polarization, polarization
from optipath.presets import load_preset, preset_names
from optipath.vertex_paths import path_from_vertices
from optipath.vertices import VerticesByAngles, vertices_from_angles

__all__ = [
    "Absorption",
    "Amplitude",
    "Angle",
    "AnglePerLength",
    "Attenuator",
    "BeamSplitter",
    "Case",
    "Certificate",
    "Combiner",
    "Composer",
    "ComposerError",
    "CosSin",
    "Coupling",
    "Depolarizer",
    "Detector",
    "Diattenuator",
    "Dump",
    "Element",
    "Fraction",
    "Frame",
    "FrameError",
    "Incidence",
    "Index",
    "Interface",
    "LayerStack",
    "Length",
    "Light",
    "LightPath",
    "LoopWarning",
    "LuChipman",
    "Material",
    "Medium",
    "Mirror",
    "Mueller",
    "MuellerElement",
    "MuellerMatrix",
    "NonNegative",
    "Operation",
    "OptipathError",
    "Parameter",
    "ParameterError",
    "PathError",
    "PathGraph",
    "Plan",
    "PlaneOfIncidence",
    "Polarization",
    "Polarizer",
    "PresetError",
    "Real",
    "Retarder",
    "Rotator",
    "ShapeError",
    "Source",
    "SpecularVertex",
    "StokesState",
    "UnitError",
    "ValueFault",
    "VerticesByAngles",
    "fresnel_reflection",
    "fresnel_transmission",
    "intensity_bounds",
    "load_preset",
    "path_from_vertices",
    "plane_of_incidence",
    "polarization",
    "preset_names",
    "refraction_angle",
    "vertices_from_angles",
]

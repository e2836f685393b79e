"""Polarised light along optical paths.

Optical elements are nodes of a path graph, each with its own reference frames. A
composer aligns the frames and orders the work; the plan it makes runs on one set of
values or on millions.
"""

# First, for Ctrl-C while the others are imported.
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

# isort: split
from optipath.composer.composer import Composer
from optipath.elements.attenuator import Attenuator
from optipath.elements.beam_splitter import BeamSplitter
from optipath.elements.combiner import Combiner
from optipath.elements.coupling import Coupling, Operation
from optipath.elements.depolarizer import Depolarizer
from optipath.elements.diattenuator import Diattenuator
from optipath.elements.element import Element
from optipath.elements.fresnel import fresnel_reflection, fresnel_transmission, refraction_angle
from optipath.elements.interface import Interface
from optipath.elements.layer_stack import LayerStack
from optipath.elements.medium import Medium
from optipath.elements.mirror import Mirror
from optipath.elements.mueller_element import MuellerElement
from optipath.elements.polarizer import Polarizer
from optipath.elements.retarder import Retarder
from optipath.elements.rotator import Rotator
from optipath.elements.source import Source
from optipath.elements.specular_vertex import SpecularVertex
from optipath.elements.terminal import Detector, Dump
from optipath.elements.vertices.by_angles import VerticesByAngles, vertices_from_angles
from optipath.light.frames import Frame
from optipath.light.incidence import PlaneOfIncidence, plane_of_incidence
from optipath.light.light import Light
from optipath.light.mueller.matrix import LuChipman, Mueller
from optipath.paths.path_graph import PathGraph
from optipath.paths.polarization_matters import Polarization, polarization
from optipath.paths.presets.loader import load_preset, preset_names
from optipath.paths.vertex_paths import path_from_vertices
from optipath.plan.certificate import Certificate, intensity_bounds
from optipath.plan.light_paths.light_path import LightPath
from optipath.plan.plan import Plan
from optipath.values.angles import CosSin
from optipath.values.cases import Case
from optipath.values.domains.quantities import (
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
from optipath.values.materials import Material
from optipath.values.parameters import Parameter

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

"""Polarised light along optical paths.

Optical elements are nodes of a path graph, each with its own reference frames. A composer aligns
the frames and orders the work; the plan it makes runs on one set of values or on millions.
"""

import optipath.interruption  # noqa: F401 - before all else, for Ctrl-C while it is imported

# isort: split
from typing import TYPE_CHECKING

from optipath.errors import (
    AngleWarning,
    CoherenceWarning,
    ColourWarning,
    ComposerError,
    FrameError,
    IndexFault,
    LightError,
    LoopWarning,
    MaterialError,
    MeshWarning,
    OptipathError,
    ParameterError,
    PathError,
    PhotonWarning,
    PresetError,
    ShapeError,
    SurfaceError,
    UnitError,
    ValueFault,
)
from optipath.lazy_names import lazy_names

if TYPE_CHECKING:
    from optipath import plots as plots
    from optipath import surfaces as surfaces
    from optipath.composer.composer import Composer
    from optipath.elements.attenuator import Attenuator
    from optipath.elements.beam_splitter import BeamSplitter
    from optipath.elements.circular_diattenuator import CircularDiattenuator
    from optipath.elements.circular_polarizer import CircularPolarizer
    from optipath.elements.combiner import Combiner
    from optipath.elements.coupling import Coupling
    from optipath.elements.depolarizer import Depolarizer
    from optipath.elements.diattenuator import Diattenuator
    from optipath.elements.effective_index import EffectiveIndex, effective_index
    from optipath.elements.element import Element
    from optipath.elements.elliptical_retarder import EllipticalRetarder
    from optipath.elements.faraday_rotator import FaradayRotator
    from optipath.elements.fresnel import fresnel_reflection, fresnel_transmission, refraction_angle
    from optipath.elements.fresnel_amplitudes import FresnelAmplitudes, fresnel_amplitudes
    from optipath.elements.interface import Interface
    from optipath.elements.layer_stack import LayerStack
    from optipath.elements.medium import Medium
    from optipath.elements.mirror import Mirror
    from optipath.elements.mueller_element import MuellerElement
    from optipath.elements.polarizer import Polarizer
    from optipath.elements.polarizing_beam_splitter import PolarizingBeamSplitter
    from optipath.elements.refracting_vertex import RefractingVertex
    from optipath.elements.retarder import Retarder
    from optipath.elements.rotator import Rotator
    from optipath.elements.source import Source
    from optipath.elements.specular_vertex import SpecularVertex
    from optipath.elements.terminal import Detector, Dump
    from optipath.elements.vertex import Vertex
    from optipath.elements.vertices.by_angles import VerticesByAngles, vertices_from_angles
    from optipath.elements.waveplate import Waveplate
    from optipath.light.colour.srgb import Srgb
    from optipath.light.frames import Frame
    from optipath.light.incidence import PlaneOfIncidence, plane_of_incidence
    from optipath.light.light import Light
    from optipath.light.mueller.matrix import LuChipman, Mueller
    from optipath.paths.double_pass import there_and_back
    from optipath.paths.path_graph import PathGraph
    from optipath.paths.polarization_matters import Polarization, polarization
    from optipath.paths.presets.loader import load_preset, preset_names
    from optipath.paths.vertex_paths import path_from_vertices
    from optipath.plan.certificate import Certificate, intensity_bounds
    from optipath.plan.light_paths.light_path import LightPath
    from optipath.plan.plan import Plan
    from optipath.surfaces.files.load_hemisphere import load_hemisphere
    from optipath.surfaces.hemispheres.hemisphere import Hemisphere
    from optipath.surfaces.hemispheres.measure import measure
    from optipath.surfaces.hemispheres.sensor import Sensor
    from optipath.surfaces.samples.sample import Sample
    from optipath.surfaces.samples.sample_files import load_sample, sample_names
    from optipath.sweeps.uncertainty.propagation import Propagation
    from optipath.values.angles import CosSin
    from optipath.values.cases import Case
    from optipath.values.crystals import Crystal
    from optipath.values.curves.by_wavelength import drude_rotation, tabulated
    from optipath.values.domains.quantities import (
        Absorption,
        Amplitude,
        Angle,
        AnglePerLength,
        Axis,
        Fraction,
        Incidence,
        Index,
        Length,
        MuellerMatrix,
        NonNegative,
        Real,
        StokesState,
        YesOrNo,
    )
    from optipath.values.follows import FOLLOWS
    from optipath.values.materials import Material
    from optipath.values.operation import Operation
    from optipath.values.parameters import Parameter
    from optipath.values.spectra.spectrum import Spectrum
    from optipath.values.spectra.wavelength_grid import wavelengths
    from optipath.values.wavelength import Wavelength

__all__ = [  # noqa: RUF022 - as sorted() has it
    "Absorption",
    "Amplitude",
    "Angle",
    "AnglePerLength",
    "AngleWarning",
    "Attenuator",
    "Axis",
    "BeamSplitter",
    "Case",
    "Certificate",
    "CircularDiattenuator",
    "CircularPolarizer",
    "CoherenceWarning",
    "ColourWarning",
    "Combiner",
    "Composer",
    "ComposerError",
    "CosSin",
    "Coupling",
    "Crystal",
    "Depolarizer",
    "Detector",
    "Diattenuator",
    "Dump",
    "EffectiveIndex",
    "Element",
    "EllipticalRetarder",
    "FOLLOWS",
    "FaradayRotator",
    "Fraction",
    "Frame",
    "FrameError",
    "FresnelAmplitudes",
    "Hemisphere",
    "Incidence",
    "Index",
    "IndexFault",
    "Interface",
    "LayerStack",
    "Length",
    "Light",
    "LightError",
    "LightPath",
    "LoopWarning",
    "LuChipman",
    "Material",
    "MaterialError",
    "Medium",
    "MeshWarning",
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
    "PhotonWarning",
    "Plan",
    "PlaneOfIncidence",
    "Polarization",
    "Polarizer",
    "PolarizingBeamSplitter",
    "PresetError",
    "Propagation",
    "Real",
    "RefractingVertex",
    "Retarder",
    "Rotator",
    "Sample",
    "Sensor",
    "ShapeError",
    "Source",
    "Spectrum",
    "SpecularVertex",
    "Srgb",
    "StokesState",
    "SurfaceError",
    "UnitError",
    "ValueFault",
    "Vertex",
    "VerticesByAngles",
    "Wavelength",
    "Waveplate",
    "YesOrNo",
    "drude_rotation",
    "effective_index",
    "fresnel_amplitudes",
    "fresnel_reflection",
    "fresnel_transmission",
    "intensity_bounds",
    "load_hemisphere",
    "load_preset",
    "load_sample",
    "measure",
    "path_from_vertices",
    "plane_of_incidence",
    "polarization",
    "preset_names",
    "refraction_angle",
    "sample_names",
    "tabulated",
    "there_and_back",
    "vertices_from_angles",
    "wavelengths",
]

_HOMES = {
    "composer.composer": ["Composer"],
    "elements.attenuator": ["Attenuator"],
    "elements.beam_splitter": ["BeamSplitter"],
    "elements.circular_polarizer": ["CircularPolarizer"],
    "elements.circular_diattenuator": ["CircularDiattenuator"],
    "elements.combiner": ["Combiner"],
    "elements.coupling": ["Coupling"],
    "elements.depolarizer": ["Depolarizer"],
    "elements.diattenuator": ["Diattenuator"],
    "elements.effective_index": ["EffectiveIndex", "effective_index"],
    "elements.element": ["Element"],
    "elements.faraday_rotator": ["FaradayRotator"],
    "elements.elliptical_retarder": ["EllipticalRetarder"],
    "elements.fresnel": ["fresnel_reflection", "fresnel_transmission", "refraction_angle"],
    "elements.fresnel_amplitudes": ["FresnelAmplitudes", "fresnel_amplitudes"],
    "elements.interface": ["Interface"],
    "elements.layer_stack": ["LayerStack"],
    "elements.medium": ["Medium"],
    "elements.mirror": ["Mirror"],
    "elements.mueller_element": ["MuellerElement"],
    "elements.polarizer": ["Polarizer"],
    "elements.polarizing_beam_splitter": ["PolarizingBeamSplitter"],
    "elements.refracting_vertex": ["RefractingVertex"],
    "elements.retarder": ["Retarder"],
    "elements.rotator": ["Rotator"],
    "elements.source": ["Source"],
    "elements.specular_vertex": ["SpecularVertex"],
    "elements.terminal": ["Detector", "Dump"],
    "elements.waveplate": ["Waveplate"],
    "elements.vertex": ["Vertex"],
    "elements.vertices.by_angles": ["VerticesByAngles", "vertices_from_angles"],
    "light.colour.srgb": ["Srgb"],
    "light.frames": ["Frame"],
    "light.incidence": ["PlaneOfIncidence", "plane_of_incidence"],
    "light.light": ["Light"],
    "light.mueller.matrix": ["LuChipman", "Mueller"],
    "paths.double_pass": ["there_and_back"],
    "paths.path_graph": ["PathGraph"],
    "paths.polarization_matters": ["Polarization", "polarization"],
    "paths.presets.loader": ["load_preset", "preset_names"],
    "paths.vertex_paths": ["path_from_vertices"],
    "plan.certificate": ["Certificate", "intensity_bounds"],
    "plan.light_paths.light_path": ["LightPath"],
    "plan.plan": ["Plan"],
    "surfaces.files.load_hemisphere": ["load_hemisphere"],
    "surfaces.hemispheres.hemisphere": ["Hemisphere"],
    "surfaces.hemispheres.measure": ["measure"],
    "surfaces.hemispheres.sensor": ["Sensor"],
    "surfaces.samples.sample": ["Sample"],
    "surfaces.samples.sample_files": ["load_sample", "sample_names"],
    "sweeps.uncertainty.propagation": ["Propagation"],
    "values.angles": ["CosSin"],
    "values.cases": ["Case"],
    "values.crystals": ["Crystal"],
    "values.curves.by_wavelength": ["drude_rotation", "tabulated"],
    "values.domains.quantities": [
        "Absorption",
        "Amplitude",
        "Angle",
        "AnglePerLength",
        "Axis",
        "Fraction",
        "Incidence",
        "Index",
        "Length",
        "MuellerMatrix",
        "NonNegative",
        "Real",
        "StokesState",
        "YesOrNo",
    ],
    "values.follows": ["FOLLOWS"],
    "values.materials": ["Material"],
    "values.operation": ["Operation"],
    "values.parameters": ["Parameter"],
    "values.spectra.spectrum": ["Spectrum"],
    "values.spectra.wavelength_grid": ["wavelengths"],
    "values.wavelength": ["Wavelength"],
}
"""Where the names are from; all are imported when the first of them is used (PEP 562)."""


if not TYPE_CHECKING:  # Else any name would do for who checks types.
    __getattr__, __dir__ = lazy_names(__name__, _HOMES, at_once=True)

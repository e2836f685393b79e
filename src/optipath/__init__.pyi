# The public names, each from the module that defines it; read when one is first used.

from optipath import plots as plots
from optipath import surfaces as surfaces
from optipath.composer.composer import Composer as Composer
from optipath.elements.coupling import Coupling as Coupling
from optipath.elements.detectors import Detector as Detector
from optipath.elements.detectors import Dump as Dump
from optipath.elements.element import Element as Element
from optipath.elements.fresnel import (
    EffectiveIndex as EffectiveIndex,
)
from optipath.elements.fresnel import (
    FresnelAmplitudes as FresnelAmplitudes,
)
from optipath.elements.fresnel import (
    effective_index as effective_index,
)
from optipath.elements.fresnel import (
    fresnel_amplitudes as fresnel_amplitudes,
)
from optipath.elements.fresnel import (
    fresnel_reflection as fresnel_reflection,
)
from optipath.elements.fresnel import (
    fresnel_transmission as fresnel_transmission,
)
from optipath.elements.fresnel import (
    refraction_angle as refraction_angle,
)
from optipath.elements.interface import Interface as Interface
from optipath.elements.interface import Mirror as Mirror
from optipath.elements.layer_stack import LayerStack as LayerStack
from optipath.elements.medium import Medium as Medium
from optipath.elements.mueller_element import MuellerElement as MuellerElement
from optipath.elements.polarizers import (
    Attenuator as Attenuator,
)
from optipath.elements.polarizers import (
    CircularDiattenuator as CircularDiattenuator,
)
from optipath.elements.polarizers import (
    CircularPolarizer as CircularPolarizer,
)
from optipath.elements.polarizers import (
    Depolarizer as Depolarizer,
)
from optipath.elements.polarizers import (
    Diattenuator as Diattenuator,
)
from optipath.elements.polarizers import (
    Polarizer as Polarizer,
)
from optipath.elements.retarders import (
    EllipticalRetarder as EllipticalRetarder,
)
from optipath.elements.retarders import (
    Retarder as Retarder,
)
from optipath.elements.retarders import (
    Waveplate as Waveplate,
)
from optipath.elements.rotators import FaradayRotator as FaradayRotator
from optipath.elements.rotators import Rotator as Rotator
from optipath.elements.sources import Source as Source
from optipath.elements.splitters import (
    BeamSplitter as BeamSplitter,
)
from optipath.elements.splitters import (
    Combiner as Combiner,
)
from optipath.elements.splitters import (
    PolarizingBeamSplitter as PolarizingBeamSplitter,
)
from optipath.elements.vertex_chain import (
    VerticesByAngles as VerticesByAngles,
)
from optipath.elements.vertex_chain import (
    vertices_from_angles as vertices_from_angles,
)
from optipath.elements.vertices import (
    RefractingVertex as RefractingVertex,
)
from optipath.elements.vertices import (
    SpecularVertex as SpecularVertex,
)
from optipath.elements.vertices import (
    Vertex as Vertex,
)
from optipath.errors import (
    AngleWarning as AngleWarning,
)
from optipath.errors import (
    CoherenceWarning as CoherenceWarning,
)
from optipath.errors import (
    ColourWarning as ColourWarning,
)
from optipath.errors import (
    ComposerError as ComposerError,
)
from optipath.errors import (
    FrameError as FrameError,
)
from optipath.errors import (
    IndexFault as IndexFault,
)
from optipath.errors import (
    LightError as LightError,
)
from optipath.errors import (
    LoopWarning as LoopWarning,
)
from optipath.errors import (
    MaterialError as MaterialError,
)
from optipath.errors import (
    MeshWarning as MeshWarning,
)
from optipath.errors import (
    OptipathError as OptipathError,
)
from optipath.errors import (
    ParameterError as ParameterError,
)
from optipath.errors import (
    PathError as PathError,
)
from optipath.errors import (
    PhotonWarning as PhotonWarning,
)
from optipath.errors import (
    PresetError as PresetError,
)
from optipath.errors import (
    ShapeError as ShapeError,
)
from optipath.errors import (
    SurfaceError as SurfaceError,
)
from optipath.errors import (
    UnitError as UnitError,
)
from optipath.errors import (
    ValueFault as ValueFault,
)
from optipath.light.color import Srgb as Srgb
from optipath.light.frame import (
    Frame as Frame,
)
from optipath.light.frame import (
    PlaneOfIncidence as PlaneOfIncidence,
)
from optipath.light.frame import (
    plane_of_incidence as plane_of_incidence,
)
from optipath.light.light import Light as Light
from optipath.light.mueller import LuChipman as LuChipman
from optipath.light.mueller import Mueller as Mueller
from optipath.materials.by_wavelength import (
    drude_rotation as drude_rotation,
)
from optipath.materials.by_wavelength import (
    tabulated as tabulated,
)
from optipath.materials.crystals import Crystal as Crystal
from optipath.materials.index_domains import FOLLOWS as FOLLOWS
from optipath.materials.material import Material as Material
from optipath.materials.quantities import (
    Absorption as Absorption,
)
from optipath.materials.quantities import (
    Amplitude as Amplitude,
)
from optipath.materials.quantities import (
    Angle as Angle,
)
from optipath.materials.quantities import (
    AnglePerLength as AnglePerLength,
)
from optipath.materials.quantities import (
    Axis as Axis,
)
from optipath.materials.quantities import (
    Fraction as Fraction,
)
from optipath.materials.quantities import (
    Incidence as Incidence,
)
from optipath.materials.quantities import (
    Index as Index,
)
from optipath.materials.quantities import (
    Length as Length,
)
from optipath.materials.quantities import (
    MuellerMatrix as MuellerMatrix,
)
from optipath.materials.quantities import (
    NonNegative as NonNegative,
)
from optipath.materials.quantities import (
    Real as Real,
)
from optipath.materials.quantities import (
    StokesState as StokesState,
)
from optipath.materials.quantities import (
    YesOrNo as YesOrNo,
)
from optipath.materials.spectrum import Spectrum as Spectrum
from optipath.materials.spectrum import wavelengths as wavelengths
from optipath.paths.double_pass import there_and_back as there_and_back
from optipath.paths.files.presets import load_preset as load_preset
from optipath.paths.files.presets import preset_names as preset_names
from optipath.paths.path_graph import PathGraph as PathGraph
from optipath.paths.polarization import Polarization as Polarization
from optipath.paths.polarization import polarization as polarization
from optipath.paths.vertex_paths import path_from_vertices as path_from_vertices
from optipath.plan.certificate import (
    Certificate as Certificate,
)
from optipath.plan.certificate import (
    intensity_bounds as intensity_bounds,
)
from optipath.plan.light_paths import LightPath as LightPath
from optipath.plan.plan import Plan as Plan
from optipath.surfaces.formats.hemisphere_files import load_hemisphere as load_hemisphere
from optipath.surfaces.hemisphere.hemisphere import Hemisphere as Hemisphere
from optipath.surfaces.hemisphere.measure import measure as measure
from optipath.surfaces.hemisphere.sensor import Sensor as Sensor
from optipath.surfaces.sample import Sample as Sample
from optipath.surfaces.sample_files import load_sample as load_sample
from optipath.surfaces.sample_files import sample_names as sample_names
from optipath.sweeps.propagation import Propagation as Propagation
from optipath.values.angles import CosSin as CosSin
from optipath.values.cases import Case as Case
from optipath.values.operands import Operation as Operation
from optipath.values.parameters import Parameter as Parameter
from optipath.values.wavelength import Wavelength as Wavelength

__version__: str

# The public names, each from the module that defines it; read when one is first used.

# Groups of further names
from optipath import errors as errors
from optipath import fields as fields
from optipath import plots as plots
from optipath import surfaces as surfaces

# Paths, and the parameters that they leave open
from optipath.paths.path_graph import PathGraph as PathGraph
from optipath.paths.files.presets import load_preset as load_preset
from optipath.paths.files.presets import preset_names as preset_names
from optipath.paths.vertex_paths import path_from_vertices as path_from_vertices
from optipath.elements.vertex_chain import vertices_from_angles as vertices_from_angles
from optipath.elements.vertex_chain import VerticesByAngles as VerticesByAngles
from optipath.paths.double_pass import there_and_back as there_and_back
from optipath.values.parameters import Parameter as Parameter
from optipath.values.wavelength import Wavelength as Wavelength
from optipath.values.angles import CosSin as CosSin
from optipath.values.cases import Case as Case

# Elements where light begins and ends
from optipath.elements.ends import Source as Source
from optipath.elements.ends import Detector as Detector
from optipath.elements.ends import Dump as Dump

# Elements that are boundaries
from optipath.elements.interface import Interface as Interface
from optipath.elements.interface import Mirror as Mirror
from optipath.elements.layer_stack import LayerStack as LayerStack
from optipath.elements.vertices import SpecularVertex as SpecularVertex
from optipath.elements.vertices import RefractingVertex as RefractingVertex
from optipath.elements.vertices import Vertex as Vertex
from optipath.materials.index_domains import FOLLOWS as FOLLOWS

# Elements that filter and retard; media
from optipath.elements.polarizers import Polarizer as Polarizer
from optipath.elements.polarizers import CircularPolarizer as CircularPolarizer
from optipath.elements.polarizers import Diattenuator as Diattenuator
from optipath.elements.polarizers import CircularDiattenuator as CircularDiattenuator
from optipath.elements.polarizers import Attenuator as Attenuator
from optipath.elements.polarizers import Depolarizer as Depolarizer
from optipath.elements.retarders import Retarder as Retarder
from optipath.elements.retarders import EllipticalRetarder as EllipticalRetarder
from optipath.elements.retarders import Waveplate as Waveplate
from optipath.elements.retarders import Rotator as Rotator
from optipath.elements.retarders import FaradayRotator as FaradayRotator
from optipath.elements.medium import Medium as Medium
from optipath.elements.mueller_element import MuellerElement as MuellerElement

# Elements where light is split and merged
from optipath.elements.splitters import BeamSplitter as BeamSplitter
from optipath.elements.splitters import PolarizingBeamSplitter as PolarizingBeamSplitter
from optipath.elements.splitters import Combiner as Combiner

# Elements of one's own; the types of their fields are in `fields`
from optipath.elements.element import Element as Element
from optipath.elements.coupling import Coupling as Coupling
from optipath.values.operands import Operation as Operation

# Light and Mueller matrices, each in its frames
from optipath.light.light import Light as Light
from optipath.light.mueller import Mueller as Mueller
from optipath.light.frame import Frame as Frame
from optipath.light.frame import PlaneOfIncidence as PlaneOfIncidence
from optipath.light.frame import plane_of_incidence as plane_of_incidence
from optipath.light.color import Srgb as Srgb
from optipath.light.mueller import LuChipman as LuChipman

# Materials and spectra
from optipath.materials.material import Material as Material
from optipath.materials.crystals import Crystal as Crystal
from optipath.materials.spectrum import Spectrum as Spectrum
from optipath.materials.spectrum import wavelengths as wavelengths
from optipath.materials.by_wavelength import tabulated as tabulated
from optipath.materials.by_wavelength import drude_rotation as drude_rotation

# Plans, and what they say of light
from optipath.composer.composer import Composer as Composer
from optipath.plan.plan import Plan as Plan
from optipath.plan.light_paths import LightPath as LightPath
from optipath.sweeps.propagation import Propagation as Propagation
from optipath.plan.certificate import Certificate as Certificate
from optipath.plan.certificate import intensity_bounds as intensity_bounds
from optipath.paths.polarization import Polarization as Polarization
from optipath.paths.polarization import polarization as polarization

# Fresnel's equations by themselves
from optipath.elements.fresnel import fresnel_reflection as fresnel_reflection
from optipath.elements.fresnel import fresnel_transmission as fresnel_transmission
from optipath.elements.fresnel import fresnel_amplitudes as fresnel_amplitudes
from optipath.elements.fresnel import FresnelEntries as FresnelEntries
from optipath.elements.fresnel import FresnelAmplitudes as FresnelAmplitudes
from optipath.elements.fresnel import refraction_angle as refraction_angle
from optipath.elements.fresnel import effective_index as effective_index
from optipath.elements.fresnel import EffectiveIndex as EffectiveIndex

# Rough surfaces; there is more in `surfaces`
from optipath.surfaces.sample import Sample as Sample
from optipath.surfaces.sample_files import load_sample as load_sample
from optipath.surfaces.sample_files import sample_names as sample_names
from optipath.surfaces.hemisphere.measure import measure as measure
from optipath.surfaces.hemisphere.sensor import Sensor as Sensor
from optipath.surfaces.hemisphere.hemisphere import Hemisphere as Hemisphere
from optipath.surfaces.formats.hemisphere_files import load_hemisphere as load_hemisphere

# The base of all errors; the others, and the warnings, are in `errors`
from optipath.errors import OptipathError as OptipathError

__version__: str

"""The optical elements, one concept a file; a class of one's own is one more."""

from optipath.elements.attenuator import Attenuator
from optipath.elements.beam_splitter import BeamSplitter
from optipath.elements.combiner import Combiner
from optipath.elements.coupling import Coupling, Operation
from optipath.elements.depolarizer import Depolarizer
from optipath.elements.diattenuator import Diattenuator
from optipath.elements.element import Element
from optipath.elements.interface import Interface
from optipath.elements.layer_stack import LayerStack
from optipath.elements.medium import Medium
from optipath.elements.mirror import Mirror
from optipath.elements.mueller_element import MuellerElement
from optipath.elements.polarizer import Polarizer
from optipath.elements.registry import element_class
from optipath.elements.retarder import Retarder
from optipath.elements.rotator import Rotator
from optipath.elements.source import Source
from optipath.elements.specular_vertex import SpecularVertex
from optipath.elements.terminal import Detector, Dump, Terminal

__all__ = [
    "Attenuator",
    "BeamSplitter",
    "Combiner",
    "Coupling",
    "Depolarizer",
    "Detector",
    "Diattenuator",
    "Dump",
    "Element",
    "Interface",
    "LayerStack",
    "Medium",
    "Mirror",
    "MuellerElement",
    "Operation",
    "Polarizer",
    "Retarder",
    "Rotator",
    "Source",
    "SpecularVertex",
    "Terminal",
    "element_class",
]

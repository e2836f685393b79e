"""The kinds of elements that files may name: those of the library, and what users have added."""

from __future__ import annotations

from typing import Any

from optipath.elements.attenuator import Attenuator
from optipath.elements.beam_splitter import BeamSplitter
from optipath.elements.circular_diattenuator import CircularDiattenuator
from optipath.elements.circular_polarizer import CircularPolarizer
from optipath.elements.combiner import Combiner
from optipath.elements.depolarizer import Depolarizer
from optipath.elements.diattenuator import Diattenuator
from optipath.elements.elliptical_retarder import EllipticalRetarder
from optipath.elements.faraday_rotator import FaradayRotator
from optipath.elements.interface import Interface
from optipath.elements.layer_stack import LayerStack
from optipath.elements.medium import Medium
from optipath.elements.mirror import Mirror
from optipath.elements.mueller_element import MuellerElement
from optipath.elements.polarizer import Polarizer
from optipath.elements.polarizing_beam_splitter import PolarizingBeamSplitter
from optipath.elements.refracting_vertex import RefractingVertex
from optipath.elements.registry import KINDS
from optipath.elements.retarder import Retarder
from optipath.elements.rotator import Rotator
from optipath.elements.source import Source
from optipath.elements.specular_vertex import SpecularVertex
from optipath.elements.terminal import Detector, Dump
from optipath.elements.vertex import Vertex
from optipath.elements.waveplate import Waveplate
from optipath.errors import PathError, did_you_mean

STANDARD = (
    Attenuator,
    BeamSplitter,
    CircularPolarizer,
    CircularDiattenuator,
    Combiner,
    Depolarizer,
    Diattenuator,
    FaradayRotator,
    EllipticalRetarder,
    Interface,
    LayerStack,
    Medium,
    Mirror,
    MuellerElement,
    Polarizer,
    PolarizingBeamSplitter,
    RefractingVertex,
    Retarder,
    Rotator,
    Source,
    SpecularVertex,
    Detector,
    Dump,
    Waveplate,
    Vertex,
)
"""The elements that come with the library; importing them has entered their kinds."""


def element_class(kind: str) -> type[Any]:
    """Return the class of a kind.

    Examples
    --------
    >>> element_class("rotator").__name__
    'Rotator'
    """
    if kind not in KINDS:
        cure = did_you_mean(kind, sorted(KINDS))
        if "did you mean" not in cure:
            cure += (
                "; one of your own is known once its module is imported (optipath --import "
                "my_elements ...)"
            )
        raise PathError(f"element kind '{kind}' is unknown{cure}")
    return KINDS[kind]

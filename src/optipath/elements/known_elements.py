"""The kinds of elements that files may name: those of the library, and what users have added."""

from __future__ import annotations

from typing import Any

from optipath.elements.coupling import KINDS
from optipath.elements.ends import Detector, Dump, Source
from optipath.elements.interface import Interface, Mirror
from optipath.elements.layer_stack import LayerStack
from optipath.elements.medium import Medium
from optipath.elements.mueller_element import MuellerElement
from optipath.elements.polarizers import (
    Attenuator,
    CircularDiattenuator,
    CircularPolarizer,
    Depolarizer,
    Diattenuator,
    Polarizer,
)
from optipath.elements.retarders import EllipticalRetarder, Retarder, Waveplate
from optipath.elements.rotators import FaradayRotator, Rotator
from optipath.elements.splitters import BeamSplitter, Combiner, PolarizingBeamSplitter
from optipath.elements.vertices import RefractingVertex, SpecularVertex, Vertex
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

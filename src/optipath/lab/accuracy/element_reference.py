"""The reference for elements: their Jones matrices in many digits, written for nothing else."""

from __future__ import annotations

from functools import singledispatch
from typing import TYPE_CHECKING, Any

from optipath.elements.attenuator import Attenuator
from optipath.elements.beam_splitter import BeamSplitter
from optipath.elements.combiner import Combiner
from optipath.elements.coupling import Coupling
from optipath.elements.depolarizer import Depolarizer
from optipath.elements.diattenuator import Diattenuator
from optipath.elements.interface import Interface
from optipath.elements.layer_stack import LayerStack
from optipath.elements.medium import Medium
from optipath.elements.mirror import Mirror
from optipath.elements.mueller_element import MuellerElement
from optipath.elements.polarizer import Polarizer
from optipath.elements.refracting_vertex import RefractingVertex
from optipath.elements.retarder import Retarder
from optipath.elements.rotator import Rotator
from optipath.elements.specular_vertex import SpecularVertex
from optipath.elements.vertex import Vertex
from optipath.errors import PathError
from optipath.kernels.catalogue import INCIDENCE
from optipath.kernels.geometry.events import Event
from optipath.lab.accuracy.boundary_reference import Jones, boundary, refracted, stack
from optipath.lab.accuracy.exact_values import Reader
from optipath.lab.accuracy.many_digits import MANY_DIGITS, cos_sin, mpmath
from optipath.values.made import checked_later

if TYPE_CHECKING:
    from optipath.elements.element import Element


def turn(angle: Any) -> Jones:
    """Return what a turn of the frame does to the field."""
    c, s = cos_sin(angle)
    return (c, s), (-s, c)


@singledispatch
def jones(element: Element, way: Coupling, read: Reader) -> Jones | None:
    """Return the Jones matrix of a way through; None where only Mueller's will do.

    Parameters
    ----------
    element : Element
        What the light meets.
    way : Coupling
        The way through.
    read : Reader
        Gives its values in many digits.

    Returns
    -------
    Jones or None
        Its rows.
    """
    del element, way, read
    return None


@jones.register
def _(element: Interface, way: Coupling, read: Reader) -> Jones:
    before, behind = read.index(element.outside).real, read.index(element.index)
    c, s = cos_sin(read.angle(element.incidence))
    if element.incidence_in is not None:
        if way.enters == "back":
            before, behind = behind.real, before
        c, s = refracted(read.index(element.incidence_in).real / before, s)
    found = boundary(behind / before, c, s)
    return found.reflected if way.reflects else found.transmitted


@jones.register
def _(element: SpecularVertex, _: Coupling, read: Reader) -> Jones:
    points = element.in_chain.points_around()
    cos, sin = points.given_to(INCIDENCE).numbers(MANY_DIGITS, read.exact)
    m = read.index(element.index) / read.index(element.outside).real
    return boundary(m, *cos_sin(read.move(mpmath.atan2(sin, cos), 1))).reflected


@jones.register
def _(element: RefractingVertex, _: Coupling, read: Reader) -> Jones:
    points = element.in_chain.points_around()
    half, across = points.given_to(INCIDENCE).numbers(MANY_DIGITS, read.exact)
    c, s = cos_sin(read.move(2 * mpmath.atan2(half, across), 1))
    before, behind = read.index(element.outside).real, read.index(element.index).real
    if before == behind:
        return _diagonal(1, 1)
    # By n1 sin t = n2 sin(t -+ turned), which is Snell's law.
    side = 1 if behind > before else -1
    incidence = mpmath.atan2(behind * s, side * (behind * c - before))
    return boundary(behind / before, *cos_sin(incidence)).transmitted


@jones.register
def _(element: Vertex, way: Coupling, read: Reader) -> Jones:
    event = float(read.exact(element.event_here))
    if event == Event.BEHIND:
        return _diagonal(1, 1)
    kind = SpecularVertex if event == Event.REFLECTS else RefractingVertex
    at = element.vertices, element.place, element.outside, element.in_chain.count
    with checked_later():  # Other chains have other events.
        alike = kind(element.index, *at, "mask")
    return jones(alike, way, read)  # type: ignore[return-value]


@jones.register
def _(element: Polarizer, _: Coupling, read: Reader) -> Jones:
    return _filter(read, element.transmittance, element.leakage, element.angle)


@jones.register
def _(element: Diattenuator, _: Coupling, read: Reader) -> Jones:
    return _filter(read, element.maximum, element.minimum, element.angle)


@jones.register
def _(element: Retarder, _: Coupling, read: Reader) -> Jones:
    return _retarding(read, read.angle(element.retardance), element.angle)


@jones.register
def _(element: Rotator, _: Coupling, read: Reader) -> Jones:
    return turn(-read.angle(element.angle, 2))


@jones.register
def _(element: Attenuator, _: Coupling, read: Reader) -> Jones:
    root = mpmath.sqrt(read.real(element.transmittance))
    return _diagonal(root, root)


@jones.register
def _(element: Medium, _: Coupling, read: Reader) -> Jones:
    depth = read.real(element.absorption) * read.real(element.length)
    left = mpmath.exp(-depth / 2)
    rotation = read.angle_along(element.rotation, element.length, 2)
    dextrorotation = read.angle_along(element.dextrorotation, element.length, 2)
    retardance = read.angle_along(element.retardance, element.length)
    # Only one of the three is not 0.
    turned = turn(dextrorotation - rotation)
    passed = times(_retarding(read, retardance, element.angle), turned)
    return times(_diagonal(left, left), passed)


@jones.register
def _(element: Mirror, _: Coupling, read: Reader) -> Jones:
    return _diagonal(read.complex(element.r_s), read.complex(element.r_p))


@jones.register
def _(element: BeamSplitter, way: Coupling, read: Reader) -> Jones:
    reflectance = read.real(element.reflectance)
    root = mpmath.sqrt(reflectance if way.reflects else 1 - reflectance)
    return _diagonal(root, -root if way.reflects else root)


@jones.register
def _(_element: Combiner, _way: Coupling, _read: Reader) -> Jones:
    return _diagonal(1, 1)


@singledispatch
def mueller(element: Element, way: Coupling, read: Reader) -> list[list[Any]]:
    """Return the Mueller matrix of a way through what has no Jones matrix.

    Parameters
    ----------
    element : Element
        One whose class is registered here, or in `jones`.
    way : Coupling
        The way through.
    read : Reader
        Gives its values in many digits.

    Returns
    -------
    list of list of mpf
        Its rows.

    Raises
    ------
    PathError
        If nothing is registered for the class.
    """
    del way, read
    raise PathError(
        f"elements of class {type(element).__name__} have no reference in many digits: register "
        f"what computes their matrix with {__name__}.jones.register or .mueller.register, "
        "or leave them out"
    )


@mueller.register
def _(element: LayerStack, way: Coupling, read: Reader) -> list[list[Any]]:
    angle = cos_sin(read.angle(element.incidence))
    indices = [read.index(index) for index in element.indices]
    before = indices[0] if element.incidence_in is None else read.index(element.incidence_in)
    if way.enters == "back":
        indices.reverse()
    if indices[0] is not before:
        angle = refracted(before.real / indices[0].real, angle[1])
    return stack(indices, *angle, back=False, way=way.reflects)


@mueller.register
def _(element: Depolarizer, _: Coupling, read: Reader) -> list[list[Any]]:
    kept = 1 - read.real(element.depolarization)
    return mpmath.diag([1, kept, kept, kept]).tolist()  # type: ignore[no-any-return]


@mueller.register
def _(_: MuellerElement, way: Coupling, read: Reader) -> list[list[Any]]:
    numbers = [read.real(number) for number in way.operations[0].arguments]
    return [numbers[row : row + 4] for row in range(0, 16, 4)]


def _filter(read: Reader, along: Any, across: Any, angle: Any) -> Jones:
    roots = (mpmath.sqrt(read.real(transmittance)) for transmittance in (along, across))
    return _turned(_diagonal(*roots), read.angle(angle, 2))


def _retarding(read: Reader, retardance: Any, angle: Any) -> Jones:
    # The field is exp(-iwt): what falls behind gains a positive phase.
    slow = mpmath.mpc(*cos_sin(retardance))
    return _turned(_diagonal(1, slow), read.angle(angle, 2))


def _diagonal(x: Any, y: Any) -> Jones:
    return (x, 0), (0, y)


def _turned(matrix: Jones, angle: Any) -> Jones:
    return times(turn(-angle), times(matrix, turn(angle)))


def times(first: Jones, second: Jones) -> Jones:
    """Return the product of two matrices.

    Parameters
    ----------
    first, second : Jones
        The second is met first by the light.

    Returns
    -------
    Jones
    """
    (a, b), (c, d) = first
    (e, f), (g, h) = second
    return (a * e + b * g, a * f + b * h), (c * e + d * g, c * f + d * h)

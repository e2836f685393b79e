"""Reference for elements: Jones matrices in many digits.

Matrices are exponentials by mpmath, in place of the closed forms of the kernels.
"""

from __future__ import annotations

from functools import singledispatch
from typing import TYPE_CHECKING, Any

from optipath.elements.coupling import Coupling
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
from optipath.elements.retarders import (
    EllipticalRetarder,
    FaradayRotator,
    Retarder,
    Rotator,
    Waveplate,
)
from optipath.elements.splitters import BeamSplitter, Combiner, PolarizingBeamSplitter
from optipath.elements.vertices import RefractingVertex, SpecularVertex, Vertex
from optipath.errors import PathError
from optipath.kernels.catalog import INCIDENCE
from optipath.kernels.vertex_chain import Event
from optipath.lab.boundary_reference import (
    Jones,
    along_face,
    between,
    boundary,
    refracted,
    stack,
)
from optipath.lab.many_digits import MANY_DIGITS, Reader, cos_sin, mpmath
from optipath.values.use import checked_later

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.elements.element import Element


@singledispatch
def matrix_of(element: Element, way: Coupling, read: Reader) -> Any:
    """Return the Jones matrix of a way through, or Mueller's where only that will do."""
    del way, read
    cure = f"register what computes their matrix with {__name__}.matrix_of.register"
    raise PathError(f"elements of class {type(element).__name__} have no reference; {cure}")


@matrix_of.register
def _(element: Interface, way: Coupling, read: Reader) -> Jones:
    before, behind = read.index(element.outside), read.index(element.index)
    angle = read.angle(element.incidence)
    c, s = cos_sin(angle)
    elsewhere = element.incidence_in is not None
    measured = read.index(element.incidence_in) if elsewhere else before
    if measured.imag:
        # The index by which Snell's law holds for real angles.
        measured = along_face(measured, angle) / s if s else measured
    # What is reflected is the same from either side, r' = -r.
    turned = way.enters == "back" and (elsewhere or not way.reflects)
    first, second = (behind, before) if turned else (before, behind)
    if first.imag:
        result = between(first, second, measured.real * s)
    elif elsewhere or measured is not before:
        result = boundary(second / first.real, *refracted(measured.real / first.real, s))
    else:
        result = boundary(behind / before.real, c, s)
    return result.reflected if way.reflects else result.transmitted


@matrix_of.register
def _(element: SpecularVertex, _: Coupling, read: Reader) -> Jones:
    points = element.in_chain.points(around=True)
    cos, sin = points.passed_to(INCIDENCE).numbers(MANY_DIGITS, read.exact)
    m = read.index(element.index) / read.index(element.outside).real
    return boundary(m, *cos_sin(read.move(mpmath.atan2(sin, cos), 1))).reflected


@matrix_of.register
def _(element: RefractingVertex, _: Coupling, read: Reader) -> Jones:
    points = element.in_chain.points(around=True)
    half, across = points.passed_to(INCIDENCE).numbers(MANY_DIGITS, read.exact)
    c, s = cos_sin(read.move(2 * mpmath.atan2(half, across), 1))
    before, behind = read.index(element.outside).real, read.index(element.index).real
    if before == behind:
        return diagonal(1, 1)
    # By n1 sin t = n2 sin(t -+ turned), which is Snell's law.
    side = 1 if behind > before else -1
    incidence = mpmath.atan2(behind * s, side * (behind * c - before))
    return boundary(behind / before, *cos_sin(incidence)).transmitted


@matrix_of.register
def _(element: Vertex, way: Coupling, read: Reader) -> Jones:
    event = float(read.exact(element.event_here))
    if event == Event.BEHIND:
        return diagonal(1, 1)
    kind = SpecularVertex if event == Event.REFLECTS else RefractingVertex
    at = element.vertices, element.place, element.outside, element.in_chain.count
    with checked_later():  # Other chains have other events.
        alike = kind(element.index, *at, "mask")
    return matrix_of(alike, way, read)  # type: ignore[no-any-return]


@matrix_of.register
def _(element: FaradayRotator, _: Coupling, read: Reader) -> Jones:
    if element.angle is not None:
        return turn(-read.angle(element.angle, 2))
    factors = (read.real(factor) for factor in (element.verdet, element.field, element.length))
    return turn(-read.near_multiple(mpmath.fprod(factors), 2))


@matrix_of.register
def _(element: Waveplate, _: Coupling, read: Reader) -> Jones:
    path = read.real(element.thickness) * read.real(element.birefringence)
    retardance = 2 * mpmath.pi * path / read.real(element.wavelength)
    return retarding(read, read.move(retardance, 1), element.angle)


@matrix_of.register
def _(element: BeamSplitter, way: Coupling, read: Reader) -> Jones:
    reflectance = read.real(element.reflectance)
    root = mpmath.sqrt(reflectance if way.reflects else 1 - reflectance)
    return diagonal(root, -root if way.reflects else root)


_FORMULAS: dict[type[Any], Callable[[Any, Coupling, Reader], Any]] = {
    Polarizer: lambda it, _, read: filtering(read, it.transmittance, it.leakage, it.angle),
    Diattenuator: lambda it, _, read: filtering(read, it.maximum, it.minimum, it.angle),
    Attenuator: lambda it, _, read: diagonal(*[mpmath.sqrt(read.real(it.transmittance))] * 2),
    Retarder: lambda it, _, read: retarding(read, read.angle(it.retardance), it.angle),
    Rotator: lambda it, _, read: turn(-read.angle(it.angle, 2)),
    CircularDiattenuator: lambda it, _, read: passing_circular(
        read.real(it.right), read.real(it.left)
    ),
    CircularPolarizer: lambda it, _, read: passing_circular(
        read.real(it.transmittance), read.real(it.leakage), 1 if it.handedness == "right" else -1
    ),
    PolarizingBeamSplitter: lambda it, way, read: splitting(
        read.real(it.extinction_transmitted),
        read.real(it.extinction_reflected),
        reflects=way.reflects,
    ),
    Mirror: lambda it, _, read: diagonal(read.complex(it.r_s), read.complex(it.r_p)),
    Combiner: lambda *_: diagonal(1, 1),
    EllipticalRetarder: lambda it, _, read: exponential(
        (0, 0, 0), map(read.angle, (it.s1, it.s2, it.s3))
    ),
}
for _kind, _formula in _FORMULAS.items():
    matrix_of.register(_kind, _formula)


@matrix_of.register
def _(element: LayerStack, way: Coupling, read: Reader) -> list[list[Any]]:
    _, sine = cos_sin(read.angle(element.incidence))
    indices = [read.index(index) for index in element.indices]
    before = indices[0] if element.incidence_in is None else read.index(element.incidence_in)
    depths = []
    if any(index.imag for index in indices[1:-1]):
        wavelength = read.real(element.wavelength)
        lengths = map(read.real, element.lengths or ())
        depths = [4 * mpmath.pi * length / wavelength for length in lengths]
    turn = slice(None, None, -1 if way.enters == "back" else 1)
    return stack(indices[turn], before.real * sine, depths[turn], way=way.reflects)


@matrix_of.register
def _(element: Depolarizer, _: Coupling, read: Reader) -> list[list[Any]]:
    stored = 1 - read.real(element.depolarization)
    return mpmath.diag([1, stored, stored, stored]).tolist()  # type: ignore[no-any-return]


@matrix_of.register
def _(_: MuellerElement, way: Coupling, read: Reader) -> list[list[Any]]:
    numbers = [read.real(number) for number in way.operations[0].arguments]
    return [numbers[row : row + 4] for row in range(0, 16, 4)]


def exponential(dichroism: Any, retardance: Any, depth: Any = 0, depolarization: Any = 0) -> Any:
    """Return the Mueller matrix of a generator."""
    (p1, p2, p3), (q1, q2, q3), d = dichroism, retardance, depolarization
    generator = mpmath.matrix(
        [[0, p1, p2, p3], [p1, -d, -q3, q2], [p2, q3, -d, -q1], [p3, -q2, q1, -d]]
    )
    return (mpmath.exp(-depth) * mpmath.expm(generator, method="taylor")).tolist()


@matrix_of.register
def _(element: Medium, _: Coupling, read: Reader) -> list[list[Any]]:
    length = read.real(element.length)
    depth = length * read.real(element.absorption)
    rotation = read.angle_along(element.rotation, element.length, 2)
    rotation -= read.angle_along(element.dextrorotation, element.length, 2)
    retardance = read.angle_along(element.retardance, element.length)
    linear = length * read.real(element.dichroism)
    circular = length * read.real(element.circular_dichroism)
    fast = dichroic = cos_sin(2 * read.angle(element.angle, 2))
    if element.dichroic_angle is not None:
        dichroic = cos_sin(2 * read.angle(element.dichroic_angle, 2))
    return exponential(  # type: ignore[no-any-return]
        (*(linear * part for part in dichroic), circular),
        (*(retardance * part for part in fast), 2 * rotation),
        depth,
        length * read.real(element.depolarization),
    )


def turn(angle: Any) -> Jones:
    """Return what a turn of the frame does to the field."""
    c, s = cos_sin(angle)
    return (c, s), (-s, c)


def filtering(read: Reader, along: Any, across: Any, angle: Any) -> Jones:
    """Return what a filter does."""
    roots = (mpmath.sqrt(read.real(transmittance)) for transmittance in (along, across))
    return turned(diagonal(*roots), read.angle(angle, 2))


def retarding(read: Reader, retardance: Any, angle: Any) -> Jones:
    """Return what a retarder does. Units: retardance in radians."""
    return turned(delaying(retardance), read.angle(angle, 2))


def delaying(retardance: Any) -> Jones:
    """Return what a retarder with its fast axis along x does. Units: retardance in radians."""
    # The field is exp(-iwt): what falls behind gains a positive phase.
    return diagonal(1, mpmath.mpc(*cos_sin(retardance)))


def passing_circular(transmittance: Any, leakage: Any, sign: Any = 1) -> Jones:
    """Return what lets through circular light, that whose S3 has a sign and the other."""
    stored, missing = mpmath.sqrt(transmittance), mpmath.sqrt(leakage)
    # The field (1, i) has S3 > 0.
    both, apart = (stored + missing) / 2, mpmath.mpc(0, sign) * (stored - missing) / 2
    return (both, -apart), (apart, both)


def splitting(of_transmitted: Any, of_reflected: Any, *, reflects: bool) -> Jones:
    """Return what a splitter without loss does, by its extinction ratios."""
    u, v = 1 / of_transmitted, 1 / of_reflected
    if reflects:
        s, p = (1 - u) / (1 - u * v), v * (1 - u) / (1 - u * v)
        return diagonal(mpmath.sqrt(s), -mpmath.sqrt(p))
    s, p = u * (1 - v) / (1 - u * v), (1 - v) / (1 - u * v)
    return diagonal(mpmath.sqrt(s), mpmath.sqrt(p))


def diagonal(x: Any, y: Any) -> Jones:
    """Return a diagonal matrix."""
    return (x, 0), (0, y)


def turned(matrix: Jones, angle: Any) -> Jones:
    """Return the matrix of an element that is turned by an angle from x towards y."""
    return times(turn(-angle), times(matrix, turn(angle)))


def times(first: Jones, second: Jones) -> Jones:
    """Return the product of two matrices."""
    (a, b), (c, d) = first
    (e, f), (g, h) = second
    return (a * e + b * g, a * f + b * h), (c * e + d * g, c * f + d * h)

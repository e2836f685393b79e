"""Elements on the way back: what light meets that goes through them the other way."""

import numpy as np
import pytest

import optipath as op
from optipath.elements.coupling import KINDS
from paths import chain
from tables import rows

POINTS = np.array([[0, 0, 0], [0, 0, 2.0], [0.1, 0.2, 4], [0.5, -1.0, 2.2], [1, -2.0, -1.0]])
A = op.Parameter("a")
FOIL = (op.Retarder(1.0, 0.3) @ op.Diattenuator(0.9, 0.3, 0.8) @ op.Rotator(0.2)).matrix

ELEMENTS = [
    op.Attenuator(0.3),
    op.BeamSplitter(0.3),
    op.CircularDiattenuator(0.8, 0.3),
    op.CircularPolarizer("left", 0.9, 0.1),
    op.Depolarizer(0.3),
    op.Diattenuator(0.8, 0.3, 0.4),
    op.EllipticalRetarder(0.4, -0.7, 1.1),
    op.Interface(1.5, 1.2),
    op.Interface(0.2 + 3j, 1.2, outside=1.3),
    op.LayerStack([1.0, 1.5, 1.7], 0.7),
    op.Medium(0.1, 2.0, retardance=3.0, angle=0.3),
    op.Medium(0.1, 2.0, rotation=3.0),
    op.Medium(0.1, dextrorotation=[1.0, 2.0]),
    op.Medium(0.1, 9.0, 2.0, 7.0, 0.3, dichroism=4.0, dichroic_angle=0.8, circular_dichroism=-3.0),
    op.Medium(0.1, 9.0, 2.0, 7.0, 0.3, dichroism=4.0, depolarization=5.0),
    op.Mirror(-0.97 + 0.12j, 0.92 - 0.26j),
    op.MuellerElement(FOIL),
    op.MuellerElement(op.Parameter("m", FOIL, bound=True)),
    op.Polarizer(0.3, transmittance=0.9, leakage=0.2),
    op.PolarizingBeamSplitter("1000:1", 20.0),
    op.RefractingVertex(1.5, POINTS, 1),
    op.Retarder([0.4, 1.0], 0.3),
    op.Rotator(0.3),
    op.SpecularVertex(0.2 + 3j, POINTS, 2),
    op.SpecularVertex(0.2 + 3j, op.VerticesByAngles((0.3, 0.7, 1.2), (0.4, -2.0)), 1),
    op.Waveplate(1e-3, 0.009, 589e-9, 0.3),
]
"""Each that is reciprocal, and lets light through."""

INTO_METAL = ("in", "reflected")
OTHERS = {op.Combiner, op.Detector, op.Dump, op.FaradayRotator, op.Source, op.Vertex}


def test_every_kind_of_the_library_is_looked_at():
    of_library = {known for known in KINDS.values() if known.__module__.startswith("optipath.")}
    assert {type(element) for element in ELEMENTS} | OTHERS == of_library


@rows("element", ELEMENTS)
def test_a_reversed_element_does_what_its_reversed_matrix_does_and_has_its_ports(element):
    back, placed = element.reversed(), element.self_placed
    for port in (*element.inputs, *element.outputs):
        port_back = element.port_back(port)
        assert (port_back in element.outputs) == (port in element.inputs)
        assert element.port_back(port_back) == port
    for way in element.couplings():
        enters, leaves = way.enters, way.leaves
        if np.any(np.imag(getattr(element, "index", 0.0))) and (enters, leaves) != INTO_METAL:
            continue  # No light comes back out of what absorbs.
        expected = element.mueller(enters, leaves).reversed()
        frame = {} if placed or not element.straight else {"frame_in": expected.frame_in}
        found = back.mueller(element.port_back(leaves), element.port_back(enters), **frame)
        np.testing.assert_allclose(found.matrix, expected.matrix, atol=3e-16)
        if placed or frame:  # x, and with it y, may point the other way along their lines.
            assert expected.frame_in.turn_to(found.frame_in)[0] == pytest.approx(1.0, abs=1e-14)
            assert expected.frame_out.turn_to(found.frame_out)[0] == pytest.approx(1.0, abs=1e-14)
    there = back.reversed()
    if isinstance(element, op.MuellerElement):  # Its parameter is a number then.
        assert np.array_equal(there.mueller().matrix, element.mueller().matrix)
    else:
        assert there == element


@rows("port", ["inn", 3, "transmitted"])
def test_a_port_that_is_not_there_is_refused(port):
    with pytest.raises(op.errors.PathError, match=r"port of Mirror .* is unknown"):
        op.Mirror().port_back(port)


AXES = [
    op.Polarizer(0.3, 0.5, 0.9, 0.1),
    op.Diattenuator(0.9, 0.2, 0.3, 0.5),
    op.Retarder(1.0, 0.3, 0.5),
    op.Waveplate(1e-3, 0.009, 589e-9, 0.3, 0.5),
    op.Medium(0.1, 2.0, retardance=9.0, angle=0.3, azimuth=0.5),
    op.Medium(0.1, 9.0, 2.0, 7.0, 0.3, 0.5, dichroism=4.0, circular_dichroism=-3.0),
    op.Medium(0.1, 9.0, 2.0, 7.0, 0.3, 0.5, dichroism=4.0, dichroic_angle=0.8),
]


@rows("element", AXES)
def test_an_element_with_an_azimuth_is_met_in_the_frame_that_it_has_turned(element):
    there, other = element.mueller().reversed(), op.Retarder(0.7, 0.2, -0.4)
    light = op.Light([1.0, 0.3, 0.4, -0.5], there.frame_in)
    found = (element.reversed() @ light).in_frame(there.frame_out)
    np.testing.assert_allclose(found.stokes, (there @ light).stokes, atol=1e-15)
    expected = chain([element, other]).mueller().reversed().matrix
    found = chain([other.reversed(), element.reversed()]).mueller().matrix
    np.testing.assert_allclose(found, expected, atol=1e-15)


def test_parameters_change_their_sign_and_no_more():
    angle = op.Parameter("a", "30 deg", minimum="-90 deg", maximum="90 deg", help="axis")
    plate = op.Retarder(op.Parameter("r"), 2 * angle + "10 deg").reversed()
    assert plate.angle == -2 * angle - "10 deg"
    assert plate.retardance == op.Retarder(op.Parameter("r")).retardance
    interface = op.Interface(1.5, 0.3)
    assert interface.reversed() is interface
    with pytest.warns(op.errors.AngleWarning):
        plate = op.Polarizer(45)
    assert plate.reversed().angle == -45.0


def test_faradays_rotation_changes_its_sign_of_which_a_matrix_does_not_know():
    assert op.FaradayRotator(0.3).reversed() == op.FaradayRotator(-0.3)
    glass = op.FaradayRotator(verdet=5.0, field=2.0, length=0.1)
    assert glass.reversed() == op.FaradayRotator(verdet=5.0, field=-2.0, length=0.1)
    assert op.Rotator(0.3).reversed() == op.Rotator(0.3)
    rotator = op.FaradayRotator(0.3)
    difference = rotator.mueller().reversed().matrix - rotator.reversed().mueller().matrix
    assert abs(difference).max() == pytest.approx(2.0 * np.sin(0.6))


def turning(mirrored, **azimuth):
    """A class of elements that turn light, and say what of theirs changes its sign."""

    def rows_of(xp, angle):
        c, s = xp.cos(2.0 * angle), xp.sin(2.0 * angle)
        return (1, 0, 0, 0), (0, c, -s, 0), (0, s, c, 0), (0, 0, 0, 1)

    body = {"angle": 0.3, "mueller_rows": staticmethod(rows_of), **mirrored, **azimuth}
    body["__annotations__"] = dict.fromkeys(("angle", *azimuth), op.fields.Axis)
    return type("Unsaid", (op.Element,), body)


Unsaid, Natural = turning({}), turning({"mirrored": ()})
Magnetic = turning({"mirrored": ("angle",)})
Turned = turning({"mirrored": ("angle",)}, azimuth=0.0)


class Share(op.Element):
    share: op.fields.Fraction = 0.3
    mirrored = ("share",)

    def couplings(self):
        return op.Attenuator(self.share).couplings()


class FastPolarizer(op.Polarizer):
    """It inherits what changes its sign, and what it does to light."""


class OtherPolarizer(op.Polarizer):
    """It does something else, of which nobody knows what changes its sign."""

    def couplings(self):
        return op.Retarder(self.angle).couplings()


def test_a_class_of_ones_own_names_the_fields_that_change_their_sign():
    assert Natural(0.3).reversed() == Natural(0.3)
    assert Magnetic(0.3).reversed() == Magnetic(-0.3)
    assert FastPolarizer(0.3).reversed() == FastPolarizer(-0.3)
    assert Turned(0.3).reversed().angle == -0.3


@rows(
    "element, sentence",
    [
        (op.Source(), "light begins at source, which has no way back of its own"),
        (op.Detector(), "light ends at detector, which has no way back of its own"),
        (op.Combiner(), "combiner adds up light without loss, which has no way back; put a Beam"),
        (op.Mirror(azimuth=0.1), "mirror has an azimuth, which belongs to the link"),
        (op.Mirror(azimuth=op.Parameter("a")), "mirror has an azimuth, which belongs to the link"),
        (op.MuellerElement(FOIL, azimuth=0.1), "mueller has an azimuth, which belongs to the link"),
        (op.Polarizer(A, op.Parameter("b")), "polarizer has an azimuth, which belongs to the link"),
        (op.MuellerElement(A), r"bind it first, path.bind\(a=...\)"),
        (op.SpecularVertex(1.5, A, 1, reflections=1), r"bind it first, path.bind\(a=...\)"),
        (
            op.RefractingVertex(1.5, POINTS, 1, outside=op.FOLLOWS),
            r"from the vertex .* \(FOLLOWS\)",
        ),
        (op.Vertex(1.5, POINTS, 1, events=[[0, 0, 0], [0, 2, 2]]), "begin at several places"),
        (Unsaid(), "element class Unsaid does not say what changes"),
        (OtherPolarizer(0.3), "element class OtherPolarizer does not say what changes"),
        (Turned(0.3, 0.1), "has an azimuth, which belongs to the link"),
        (Share(), r"on the way back, Share.share is -0.3; give"),
    ],
)
def test_what_has_no_way_back_by_itself_is_refused_with_the_cure(element, sentence):
    with pytest.raises(op.errors.PathError, match=sentence):
        element.reversed()

"""The references themselves, against published values and closed forms."""

import mpmath
import numpy as np
import pytest

import optipath as op
from optipath.elements.coupling import Coupling
from optipath.lab.accuracy.element_reference import mueller
from optipath.lab.accuracy.exact_values import Reader
from optipath.lab.accuracy.path_reference import exact_batch, exact_lights, exact_stokes
from optipath.lab.accuracy.reference import reflection, transmission
from published import npgr026
from slabs import stack


@pytest.mark.parametrize("case", sorted(npgr026.EXACT))
def test_a_whole_path_gives_the_published_case_to_its_last_digits(case):
    lights = exact_lights(op.load_preset("npgr026", case=case))
    exact = [mpmath.mpf(text) for text in npgr026.EXACT[case]]
    # The angles of the preset are floats: what they are off by is all that is left.
    slack = 1e-12 if case == "3" else 1e-15
    for found, component in zip(lights["E"].stokes, exact, strict=True):
        assert abs(found - component) <= slack * exact[0]


@pytest.fixture(autouse=True)
def many_digits():
    with mpmath.workdps(60):
        yield


def test_brewsters_angle_and_total_reflection_are_as_in_the_books():
    A, B, C, S = reflection(1.5, 0.0, 1.0, 1.5).values
    assert abs(A - mpmath.mpf(25) / 338) <= 1e-49  # (1 - n^2)^2 / (1 + n^2)^2 / 2
    assert A == B
    assert (C, S) == (0, 0)
    A, B, C, S = reflection(0.5, 0.0, 0.75, 1.0).values
    assert (A, B) == (1, 0)
    # Born & Wolf, sec. 1.5.4: tan(delta/2) = cos sqrt(sin^2 - n^2) / sin^2, the sine being 0.8.
    half = (
        mpmath.mpf(3)
        / 5
        * mpmath.sqrt(mpmath.mpf("0.64") - mpmath.mpf("0.25"))
        / mpmath.mpf("0.64")
    )
    assert abs(S / (1 + C) - half) <= 1e-49


@pytest.mark.parametrize(("n", "k"), [(1.5, 0.0), (0.2, 3.4), (0.7, 0.0)])
def test_what_is_not_reflected_is_let_through(n, k):
    given = (n, k, 0.8, 0.6)
    F, T = reflection(*given).values, transmission(*given).values
    assert abs(F[0] + T[0] - 1) <= 1e-49
    assert abs(F[1] + T[1]) <= 1e-49


def test_the_condition_is_the_slope_in_tan_theta():
    # B ~ theta^2 next to the normal, and A does not follow the angle there.
    conditions = reflection(1.5, 0.0, 1.0, 1e-9).conditions
    assert conditions[1] == pytest.approx(2.0, abs=1e-12)
    assert conditions[0] <= 1e-30


def test_the_conditions_of_a_path_are_those_of_its_angles():
    # Malus: cos^2 a against tan 2a.
    light = exact_lights(op.load_preset("malus", angle=0.3))["eye"]
    slope = 2 * np.tan(0.3) * np.sin(4 * 0.3) / 4
    # The polariser turns the frame there and back again.
    assert light.conditions[0] == pytest.approx(slope, rel=1e-12)


def test_a_batch_has_one_reference_for_each():
    path = op.load_preset("malus")
    angles = np.array([0.1, 0.2, 0.3])
    lights = list(exact_batch(path.graph, angle=angles))
    for angle, light in zip(angles.tolist(), lights, strict=True):
        assert light["eye"] == exact_lights(path, angle=angle)["eye"]


def test_a_reference_of_a_batch_at_once_is_refused():
    with pytest.raises(op.ParameterError, match="single values"):
        exact_lights(op.load_preset("malus"), angle=[0.1, 0.2])


def everything():
    """A path of every element, with branches that meet."""
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(2.0, [1.0, 0.2, -0.3, 0.4]))
    lamp >> path.add("plate", op.Retarder(0.7, 0.2, azimuth=0.3))
    path["plate"] >> path.add("split", op.BeamSplitter(0.3, azimuth=-0.1))
    path.add("sum", op.Combiner())
    for name, element in (
        ("glass", op.Interface(1.5, 0.9, outside=1.2, azimuth=0.4)),
        ("metal", op.Interface(0.2 + 3j, 0.5)),
    ):
        port = "reflected" if name == "glass" else "transmitted"
        path.add(name, element)
        path.connect(f"split.{port}", f"{name}.in")
        path.connect(f"{name}.reflected", "sum.in", azimuth=0.2)
    path.add("cube", op.PolarizingBeamSplitter(1000.0, azimuth=0.3))
    path["sum"] >> path["cube"]
    path.add("both", op.Combiner())
    path.connect("cube.reflected", "both.in")
    path.connect("cube.transmitted", "both.in", azimuth=0.7)
    foil = np.diag([0.9, 0.5, 0.4, 0.3])
    node = path["both"]
    for number, element in enumerate(
        (
            op.Rotator(0.3),
            op.Polarizer(0.4, 0.1, 0.9, 0.05),
            op.Attenuator(0.5),
            op.MuellerElement(foil),
            op.Mirror(-0.9 + 0.2j, 0.8 - 0.3j, azimuth=0.5),
            op.Diattenuator(0.9, 0.3, angle=0.2, azimuth=0.1),
            op.Medium(0.1, 3.0, rotation=8.0),
            op.Medium(0.1, dextrorotation=3.0),
            op.Depolarizer(0.1),
            op.Medium(0.2, 0.0, retardance=5.0, angle=0.7, azimuth=0.2),
            op.FaradayRotator(0.4),
            op.FaradayRotator(verdet=-134.0, field=0.17, length=0.02),
            op.CircularPolarizer("left", 0.9, 0.3),
            op.Waveplate(2.3e-3, -0.0091, 5.89e-7, 0.3, azimuth=0.2),
            op.EllipticalRetarder(0.3, -0.7, 1.1, azimuth=0.4),
            op.CircularDiattenuator(0.9, 0.4),
            op.Medium(0.1, 3.0, dichroism=2.0, circular_dichroism=1.0, retardance=9.0, angle=0.3),
            op.Medium(0.1, 3.0, dichroism=2.0, retardance=4.0, dichroic_angle=0.8, rotation=2.0),
            op.Medium(0.1, 3.0, dichroism=-1.0, depolarization=1.5, dextrorotation=4.0),
        )
    ):
        node = node >> path.add(f"e{number}", element)
    node >> path.add("eye", op.Detector())
    return path


def test_every_element_has_a_reference_that_agrees_with_the_library():
    path = everything()
    exact = [float(part) for part in exact_lights(path)["eye"].stokes]
    np.testing.assert_allclose(path.trace().stokes, exact, rtol=0, atol=2e-16)


def test_turns_of_a_whole_number_of_right_angles_along_a_medium_are_exact():
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(stokes=[1, 1, 0, 0]))
    lamp >> path.add("quartz", op.Medium(np.pi / 0.7, rotation=0.35))
    path["quartz"] >> path.add("eye", op.Detector())
    assert exact_lights(path)["eye"].stokes == (1, -1, 0, 0)


def test_world_frames_have_a_reference():
    first, second = op.Frame(), op.Frame().turned(0.7)
    path = op.PathGraph()
    path.add("lamp", op.Source(stokes=[1, 0.6, 0.1, 0.2]), frames={"out": first})
    path.add("filter", op.Polarizer(0.2), frames={"in": second})
    path["lamp"] >> path["filter"] >> path.add("eye", op.Detector())
    exact = [float(part) for part in exact_lights(path)["eye"].stokes]
    np.testing.assert_allclose(path.trace().stokes, exact, rtol=0, atol=2e-16)


class Unregistered(op.Element):
    """An element of one's own."""

    share: op.Fraction = 0.5

    @staticmethod
    def mueller_rows(xp, share):
        c = xp.sqrt(share)
        return (1, 0, 0, 0), (0, share, 0, 0), (0, 0, c, 0), (0, 0, 0, c)


class Registered(Unregistered):
    """One whose matrix is told a second time, in many digits."""


@mueller.register
def _(element: Registered, way: Coupling, read: Reader):
    del way
    share = read.real(element.share)
    return mpmath.diag([1, share, mpmath.sqrt(share), mpmath.sqrt(share)]).tolist()


def through(element):
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(stokes=[1, 0.5, 0.5, 0.5]))
    lamp >> path.add("thing", element) >> path.add("eye", op.Detector())
    return path


def test_an_element_of_ones_own_has_the_reference_that_is_registered_for_it():
    stokes = exact_lights(through(Registered(op.Parameter("share"))), share=0.3)["eye"].stokes
    assert abs(stokes[2] - mpmath.sqrt(mpmath.mpf(0.3)) / 2) <= 1e-49


@pytest.mark.parametrize("reference", [exact_lights, exact_stokes])
def test_a_kernel_is_no_reference_of_itself(reference):
    cure = r"class Unregistered have no reference .* register .*element_reference\.jones\.register"
    with pytest.raises(op.PathError, match=cure):
        reference(through(Unregistered(0.5)))


@pytest.mark.parametrize("value", ["none", "horizontal"])
def test_optional_elements_are_left_out_of_the_reference_too(value):
    path = op.load_preset("npgr026", filter=value)
    exact = [float(part) for part in exact_lights(path)["E"].stokes]
    np.testing.assert_allclose(path.trace().stokes, exact, rtol=1e-14, atol=1e-15)


@pytest.mark.parametrize(("index", "expected"), [(1e300, [1, 0.3, 0.2, 0.1]), (1.0, [0, 0, 0, 0])])
def test_light_at_exactly_90_degrees_is_told_exactly(index, expected):
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(stokes=[1, 0.3, 0.2, 0.1]))
    lamp >> path.add("a", op.Interface(index, np.pi / 2)) >> path.add("eye", op.Detector())
    assert [float(part) for part in exact_lights(path)["eye"].stokes] == expected
    np.testing.assert_array_equal(path.trace().stokes, expected)


def test_crossed_polarizers_leave_nothing():
    assert exact_lights(op.load_preset("malus", case="crossed"))["eye"].stokes == (0, 0, 0, 0)


def test_an_angle_whose_rounding_is_a_turn_is_taken_as_it_is():
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(stokes=[1, 1, 0, 0]))
    lamp >> path.add("a", op.Polarizer("1e17 rad")) >> path.add("eye", op.Detector())
    exact = float(exact_lights(path)["eye"].stokes[0])
    assert exact == pytest.approx(float(mpmath.cos(mpmath.mpf(10) ** 17) ** 2), rel=1e-15)


def test_light_that_goes_round_next_to_a_critical_angle_has_a_reference():
    indices = 1.2013844143721588, 2.3154580605777224, 1.1992097736544047, 2.41156558882614
    lights = exact_stokes(stack(*indices, theta=1.5106189446918221))
    assert abs(lights["R"][0] + lights["T"][0] - 1) < 1e-45


def test_a_reference_is_of_a_path():
    with pytest.raises(op.PathError, match="PathGraph"):
        exact_lights("npgr026")

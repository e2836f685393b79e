"""Interfaces from both sides, between media that may absorb, and what is refused."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp

import optipath as op
from chains import by_engine
from optipath.lab.path_reference import exact_lights
from tables import rows, slow
from wired import read_back, wired

INDEX = st.floats(0.3, 4.0)
ANGLE = st.floats(0.0, np.pi / 2)


def both(element, enters):
    return [element.mueller(enters, leaves).matrix for leaves in ("reflected", "transmitted")]


@given(index=INDEX, outside=INDEX, angle=ANGLE)
def test_nothing_gets_lost_from_either_side(index, outside, angle):
    glass = op.Interface(index, angle, outside)
    for enters in ("in", "back"):
        first = sum(both(glass, enters))[0]
        np.testing.assert_allclose(first, [1.0, 0.0, 0.0, 0.0], rtol=1e-15, atol=4e-16)


@given(index=INDEX, outside=INDEX, angle=ANGLE)
def test_light_from_behind_sees_the_same_boundary_turned_round(index, outside, angle):
    glass = op.Interface(index, angle, outside)
    behind = float(op.refraction_angle(index, angle, outside))
    if max(behind, angle) > 1.5:
        return  # Next to the critical angle the angle itself has no more digits.
    other = op.Interface(outside, behind, index)
    np.testing.assert_allclose(both(glass, "back")[::-1], both(other, "in"), rtol=0, atol=1e-12)


def test_the_last_face_of_a_slab_keeps_its_digits_next_to_grazing_incidence():
    assert float(op.refraction_angle(1.0, 1.0, outside=1.5)) == np.pi / 2
    behind = float(op.refraction_angle(1.5, 0.7))
    inner = op.Interface(1.3, 0.7, outside=1.5, incidence_in=1.0)
    direct = op.Interface(1.3, behind, outside=1.5)
    np.testing.assert_allclose(both(inner, "in"), both(direct, "in"), rtol=0, atol=1e-15)
    apart = 1e-7
    glass = op.Interface(1.0, np.pi / 2 - apart, outside=1.5, incidence_in=1.0)
    with mp.workdps(50):
        c, s = mp.cos(mp.mpf(np.pi / 2 - apart)), mp.sin(mp.mpf(np.pi / 2 - apart))
        g = mp.sqrt(mp.mpf(1.5) ** 2 - s * s)
        along = 4 * c * g / (c + g) ** 2
    matrix = glass.mueller("in", "transmitted").matrix
    assert matrix[0, 0] + matrix[0, 1] == pytest.approx(float(along), rel=1e-9)


@rows("method", ["stable", "compensated", "amplitude", "textbook"])
def test_every_method_refracts_first(method):
    inner = op.Interface(0.6 + 2j, 0.7, outside=1.5, incidence_in=1.0)
    expected = inner.mueller("in", "reflected").matrix
    found = inner.mueller("in", "reflected", method=method).matrix
    np.testing.assert_allclose(found, expected, rtol=0, atol=2e-14)


def test_the_incidence_is_measured_in_a_medium_that_light_comes_from():
    for value in (0.0, -1.0, 1.5 - 1j, "air", op.Material(0.0, 0.1)):
        with pytest.raises(op.errors.ValueFault, match=r"^Interface incidence_in"):
            op.Interface(1.5, 0.5, incidence_in=value)
    for element in (op.Interface(0.1j, 0.3), op.LayerStack([1.0, 1.5, 1.5 + 0.1j], 0.3)):
        with pytest.raises(op.errors.PathError, match="since light comes from there"):
            element.mueller("back", "reflected")


def test_the_azimuth_of_an_element_is_that_of_its_front():
    def turned(azimuth, own):
        nodes = {"lamp": op.Source(stokes=[1.0, 0.5, 0.0, 0.0]), "eye": op.Detector()}
        nodes["split"] = op.BeamSplitter(0.3, azimuth=own)
        path = wired(nodes, "split.reflected -> eye")
        path.connect("lamp.out", "split.back", azimuth)
        return path.trace().stokes

    np.testing.assert_array_equal(turned(None, 0.4), turned(None, 0.0))
    np.testing.assert_allclose(turned(0.4, 0.9)[1], 0.7 * 0.5 * np.cos(0.8), rtol=1e-14)


GLASS = 1.5 + 0.01j
P, F = op.Parameter, op.FOLLOWS
LAMP = op.Source(stokes=[1.0, 0.3, 0.5, -0.4])
BEHIND = op.Interface(1.0, F, outside=F)


def through(*faces):
    """Light that goes through faces one behind the other, from a lamp to an eye."""
    ends = {"lamp": LAMP, "eye": op.Detector()}
    numbered = {f"f{number}": face for number, face in enumerate(faces)}
    starts = ["lamp", *(f"{name}.transmitted" for name in numbered)]
    links = zip(starts, [*numbered, "eye"], strict=True)
    return wired(ends | numbered, ", ".join(map(" -> ".join, links)))


def slab(first, *, depth=0.7):
    """A plate of a medium that absorbs, light going to and fro in it."""
    way, seen = op.Medium(1.0, absorption=depth), op.Detector()
    nodes = {"lamp": LAMP, "front": first, "behind": op.Interface(1.2, F, outside=F)}
    nodes |= {"down": way, "up": way, "T": seen, "R": seen}
    links = "lamp -> front, front.transmitted -> down, down -> behind, behind.reflected -> up"
    ends = "up -> front.back, front.reflected -> R, behind.transmitted -> T"
    return wired(nodes, f"{links}, {ends}", loops="sum")


def fault_of(call, *arguments, **values):
    with pytest.raises(op.OptipathError) as error:
        call(*arguments, **values)
    (fault,) = error.value.faults
    return fault


def test_what_normal_incidence_reflects_and_lets_through_is_in_closed_form():
    m = 1.5 + 0.2j
    found = [matrix[0, 0] for matrix in both(op.Interface(1.0, 0.0, outside=m), "in")]
    expected = [abs((m - 1) / (m + 1)) ** 2, abs(2 * m / (m + 1)) ** 2 / 1.5]
    np.testing.assert_allclose(found, expected, rtol=1e-15)
    assert sum(expected) != pytest.approx(1.0, rel=1e-3)


@pytest.mark.parametrize("depth", [0.7, slow(1e-9), slow(30.0)])
def test_a_plate_that_light_goes_to_and_fro_in_agrees_with_50_digits(depth):
    path = slab(op.Interface(GLASS, 0.9), depth=depth)
    exact = exact_lights(path)
    for port, light in path.trace_all().items():
        expected = np.array([float(part) for part in exact[port].stokes])
        np.testing.assert_allclose(light.stokes, expected, rtol=0, atol=1e-14 * expected[0])


def test_the_medium_and_the_angle_are_taken_over():
    taken = through(op.Interface(GLASS, 0.6), BEHIND)
    real = op.refraction_angle(GLASS, 0.6)
    for face in (
        op.Interface(1.0, 0.6, outside=GLASS, incidence_in=1.0),
        op.Interface(1.0, real, outside=GLASS),
        op.Interface(1.0, real, outside=op.Material(1.5, 0.01)),
    ):
        written = through(op.Interface(GLASS, 0.6), face)
        np.testing.assert_allclose(written.trace().stokes, taken.trace().stokes, rtol=1e-14)
    first = op.Interface(1.2, 0.4, outside=GLASS)
    written = through(first, op.Interface(1.0, 0.4, outside=1.2, incidence_in=GLASS))
    taken = through(first, BEHIND)
    np.testing.assert_array_equal(taken.trace().stokes, written.trace().stokes)
    expected = [float(part) for part in exact_lights(taken)["eye"].stokes]
    np.testing.assert_allclose(taken.trace().stokes, expected, rtol=0, atol=1e-15)
    # By Snell's law with the real wave along the face.
    angle = op.refraction_angle(1.2, 0.4, outside=GLASS)
    again = through(first, op.Interface(1.0, angle, outside=1.2))
    np.testing.assert_allclose(again.trace().stokes, taken.trace().stokes, rtol=1e-14)


def test_media_that_meet_must_agree_and_obey_snells_law():
    first = op.Interface(GLASS, 0.0)
    fault = fault_of(through(first, op.Interface(1.0, 0.0, outside=1.5)).check)
    assert "from n = 1.5 and k = 0.01 behind 'f0'" in fault
    assert "its outside is 1.5 with k = 0; give op.FOLLOWS for outside" in fault
    through(first, op.Interface(1.0, 0.0, outside=1.5 + 0.01j)).check()
    fault = fault_of(through(op.Interface(1.5, 0.0), op.Interface(1.0, 0.0, GLASS)).check)
    assert "its outside is 1.5 with k = 0.01; give outside = 1.5" in fault
    open_k = through(op.Interface(P("m"), 0.0), op.Interface(1.0, 0.0, outside=P("o")))
    open_k.trace(m=GLASS, o=GLASS)
    assert "with k = 0.02" in fault_of(open_k.trace, m=GLASS, o=1.5 + 0.02j)
    faces = op.Interface(GLASS, 0.6), op.Interface(1.0, 0.39, outside=GLASS)
    assert "in n = 1.5 and k = 0.01" in fault_of(through(*faces).check)


@rows(
    "face, enters, words",
    [
        (op.Interface(1.5, np.pi / 2, 1.3 + 0.01j), "in", "at most 84.987506 deg"),
        (op.Interface(1.5, np.radians(84.9876), 1.3 + 0.01j), "in", "at most 84.987506 deg"),
        (op.Interface(1.0, 0.3, outside=0.2 + 3.4j), "in", "k of at most n = 0.2"),
        (op.Interface(0.2 + 3.4j, 0.3), "back", "k of at most n = 0.2"),
        (op.Interface(1.0, 1.2, 1.2 + 1e-3j, incidence_in=1.5), "in", "53.130075 deg in n = 1.5"),
    ],
)
def test_a_wave_that_carries_no_power_is_refused_with_the_cure(face, enters, words):
    fault = fault_of(face.mueller, enters, "reflected")
    assert "fades along the normal faster than it goes on" in fault
    assert words in fault


@rows("degrees, front, n0", [(84.987506, 1.3 + 0.01j, None), (53.130075, 1.2 + 1e-3j, 1.5)])
def test_a_wave_at_the_angle_that_is_told_has_power(degrees, front, n0):
    face = op.Interface(1.0, np.radians(degrees), front, incidence_in=n0)
    assert np.all(np.isfinite(face.mueller("in", "transmitted").matrix))


def test_a_wave_is_looked_at_whenever_values_are_given():
    path = through(op.Interface(P("m"), P("t")), BEHIND)
    assert path.compose().inputs.agreements == ()
    path.trace(m=np.array([1.5, 1.5 + 0.1j]), t=0.4)
    assert "fades along the normal" in fault_of(path.trace, m=0.2 + 3.4j, t=0.4)
    assert "at 1, of 2 paths" in fault_of(path.trace, m=np.array([1.5, 0.2 + 3.4j]), t=0.4)
    of_k = through(op.Interface(op.Material(0.5, P("k")), 0.1), BEHIND)
    of_k.trace(k=0.1)
    assert "(parameter 'k')" in fault_of(of_k.trace, k=2.0)


def test_real_indices_for_parameters_give_the_same_numbers():
    given = {"m": np.linspace(1.3, 1.7, 40), "t": np.linspace(0.0, 1.5, 40)}
    expected = through(op.Interface(P("m"), P("t")), BEHIND).trace(**given).stokes
    for m in (P("m"), given["m"]):
        path = through(op.Interface(m, P("t")), op.Interface(1.0, P("t"), m, incidence_in=1))
        found = path.trace(**{n: given[n] for n in path.compose().inputs.open}).stokes
        np.testing.assert_allclose(expected, found, rtol=0, atol=2e-16)


@by_engine
def test_engines_agree(engine):
    path = slab(op.Interface(P("m"), P("t")))
    given = {"m": np.linspace(1.3, 1.6, 7) + 1j * np.linspace(0, 0.1, 7), "t": np.linspace(0, 1, 7)}
    expected = op.Composer(engine="numpy").compose(path).run_all(**given)
    found = op.Composer(engine=engine).compose(path).run_all(**given)
    for port, light in expected.items():
        np.testing.assert_allclose(found[port].stokes, light.stokes, rtol=1e-13, atol=1e-16)


@rows("dtype", ["float32", "longdouble"])
def test_other_precisions_agree(dtype):
    path = slab(op.Interface(GLASS, P("t")))
    tolerance = 3e-6 if dtype == "float32" else 1e-14
    for port, light in op.Composer(dtype=dtype).compose(path).run_all(t=0.8).items():
        expected = path.trace_all(t=0.8)[port].stokes
        np.testing.assert_allclose(light.stokes, expected, rtol=0, atol=tolerance)


def test_a_file_keeps_an_index_that_absorbs(tmp_path):
    face = op.Interface(op.Material(1.5, P("k", 0.01)), P("t", 0.4))
    for written in (through(face, BEHIND), through(op.Interface(1.2, 0.4, outside=GLASS))):
        again = read_back(written, tmp_path)
        assert again == written
        np.testing.assert_array_equal(again.trace().stokes, written.trace().stokes)


def test_directions_in_the_world_are_those_of_the_real_angle():
    face, t = op.Interface(1.0, "20 deg", outside=1.5 + 0.3j), np.radians(20)
    behind = op.refraction_angle(1.0, t, outside=1.5 + 0.3j)
    with mp.workdps(30):
        m2, angle = mp.mpc(1.5, 0.3) ** 2, mp.radians(20)
        root = mp.sqrt(m2.real**2 + (m2.imag / mp.cos(angle)) ** 2)
        y = mp.sqrt((m2.real + root) / 2) * mp.sin(angle)
        assert float(behind) == pytest.approx(float(mp.asin(y)), rel=1e-15)
    down, into = (
        op.Frame.from_direction((np.sin(a), 0, -np.cos(a)), (0, 1, 0)) for a in (t, behind)
    )
    path = op.PathGraph()
    path.add("lamp", LAMP, {"out": down})
    path["lamp"] >> path.add("face", face, {"in": down, "transmitted": into})
    path.add("eye", op.Detector(), {"in": into})
    path.connect("face.transmitted", "eye.in")
    path.check()

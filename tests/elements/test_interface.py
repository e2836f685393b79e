"""Interfaces from both sides, between media that may absorb, and what is refused."""

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp

import optipath as op
from chains import COMPILED
from optipath.lab.accuracy.path_reference import exact_lights
from tables import rows

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
    reflected, refracted = both(glass, "back")[::-1]
    np.testing.assert_allclose(reflected, both(other, "in")[0], rtol=0, atol=1e-12)
    np.testing.assert_allclose(refracted, both(other, "in")[1], rtol=0, atol=1e-12)


@given(index=INDEX, kappa=st.floats(0.0, 5.0), angle=st.floats(0.0, 1.57))
def test_the_real_angle_of_refraction_is_that_of_planes_of_constant_phase(index, kappa, angle):
    with mp.workdps(30):
        g = mp.sqrt(mp.mpc(index, kappa) ** 2 - mp.sin(angle) ** 2)
        expected = mp.atan2(mp.sin(angle), abs(g.real))
    found = op.refraction_angle(complex(index, kappa), angle)
    if kappa or index > np.sin(angle) * 1.0001:
        assert float(found) == pytest.approx(float(expected), abs=1e-13 / max(kappa, 1e-3))


def test_the_last_face_of_a_slab_keeps_its_digits_next_to_grazing_incidence():
    assert float(op.refraction_angle(1.0, 1.0, outside=1.5)) == np.pi / 2
    behind = float(op.refraction_angle(1.5, 0.7))
    inner = op.Interface(1.3, 0.7, outside=1.5, incidence_in=1.0)
    direct = op.Interface(1.3, behind, outside=1.5)
    for leaves in ("reflected", "transmitted"):
        found, expected = (e.mueller("in", leaves).matrix for e in (inner, direct))
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-15)
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


@rows("value", [0.0, -1.0, 1.5 - 1j, "air", op.Material(0.0, 0.1)])
def test_the_incidence_is_measured_in_a_medium_that_light_comes_from(value):
    with pytest.raises(op.ValueFault, match=r"^Interface incidence_in"):
        op.Interface(1.5, 0.5, incidence_in=value)


def test_the_azimuth_of_an_element_is_that_of_its_front():
    def turned(azimuth, own):
        path = op.PathGraph()
        path.add("lamp", op.Source(1.0, [1.0, 0.5, 0.0, 0.0]))
        path.add("split", op.BeamSplitter(0.3, azimuth=own))
        path.add("eye", op.Detector())
        path.connect("lamp.out", "split.back", azimuth)
        path.connect("split.reflected", "eye.in")
        return path.trace().stokes

    np.testing.assert_array_equal(turned(None, 0.4), turned(None, 0.0))
    np.testing.assert_allclose(turned(0.4, 0.9)[1], 0.7 * 0.5 * np.cos(0.8), rtol=1e-14)


@rows("element", [op.Interface(0.1j, 0.3), op.LayerStack([1.0, 1.5, 1.5 + 0.1j], 0.3)])
def test_an_element_alone_refuses_light_from_behind_as_well(element):
    with pytest.raises(op.PathError, match="since light comes from there"):
        element.mueller("back", "reflected")


GLASS = 1.5 + 0.01j

P, F = op.Parameter, op.FOLLOWS

BY_ENGINE = [*COMPILED, pytest.param("jax", marks=pytest.mark.slow)]  # JAX compiles long.


def through(*faces):
    """Light that goes through faces one behind the other, from a lamp to an eye."""
    path = op.PathGraph()
    path.add("lamp", op.Source(stokes=[1.0, 0.3, 0.5, -0.4]))
    light = "lamp.out"
    for number, face in enumerate(faces):
        path.add(f"f{number}", face)
        path.connect(light, f"f{number}.in")
        light = f"f{number}.transmitted"
    path.add("eye", op.Detector())
    path.connect(light, "eye.in")
    return path


def slab(first, *, depth=0.7):
    """A plate of a medium that absorbs, light going to and fro in it."""
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source(stokes=[1.0, 0.3, 0.5, -0.4]))
    path.add("front", first)
    for name in ("down", "up"):
        path.add(name, op.Medium(1.0, absorption=depth))
    path.add("behind", op.Interface(1.2, F, outside=F))
    path.add("T", op.Detector())
    path.add("R", op.Detector())
    for link in (
        ("lamp.out", "front.in"),
        ("front.transmitted", "down.in"),
        ("down.out", "behind.in"),
        ("behind.reflected", "up.in"),
        ("up.out", "front.back"),
        ("front.reflected", "R.in"),
        ("behind.transmitted", "T.in"),
    ):
        path.connect(*link)
    return path


def fault_of(call, *arguments, **values):
    with pytest.raises(op.OptipathError) as error:
        call(*arguments, **values)
    (fault,) = error.value.faults
    return fault


def test_what_normal_incidence_reflects_and_lets_through_is_in_closed_form():
    face = op.Interface(1.0, 0.0, outside=1.5 + 0.2j)
    m = 1.5 + 0.2j
    reflected = abs((m - 1) / (m + 1)) ** 2
    let_through = abs(2 * m / (m + 1)) ** 2 / 1.5
    assert face.mueller().matrix[0, 0] == pytest.approx(reflected, rel=1e-15)
    matrix = face.mueller("in", "transmitted").matrix
    assert matrix[0, 0] == pytest.approx(let_through, rel=1e-15)
    assert reflected + let_through != pytest.approx(1.0, rel=1e-3)


def test_a_plate_that_light_goes_to_and_fro_in_agrees_with_50_digits():
    for depth in (1e-9, 0.7, 30.0):
        path = slab(op.Interface(GLASS, 0.9), depth=depth)
        exact = exact_lights(path)
        for port, light in path.trace_all().items():
            expected = np.array([float(part) for part in exact[port].stokes])
            np.testing.assert_allclose(light.stokes, expected, rtol=0, atol=1e-14 * expected[0])


def test_the_medium_and_the_angle_are_taken_over():
    taken = through(op.Interface(GLASS, 0.6), op.Interface(1.0, F, outside=F))
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
    taken = through(first, op.Interface(1.0, F, outside=F))
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
    assert "its outside is 1.5 with k = 0; give outside = 1.5+0.01j, or op.FOLLOWS" in fault
    through(first, op.Interface(1.0, 0.0, outside=1.5 + 0.01j)).check()
    fault = fault_of(through(op.Interface(1.5, 0.0), op.Interface(1.0, 0.0, GLASS)).check)
    assert "its outside is 1.5 with k = 0.01; give outside = 1.5" in fault
    open_k = through(op.Interface(P("m"), 0.0), op.Interface(1.0, 0.0, outside=P("o")))
    open_k.trace(m=GLASS, o=GLASS)
    assert "with k = 0.02" in fault_of(open_k.trace, m=GLASS, o=1.5 + 0.02j)
    faces = op.Interface(GLASS, 0.6), op.Interface(1.0, 0.39, outside=GLASS)
    assert "in n = 1.5 and k = 0.01" in fault_of(through(*faces).check)
    for degrees in (84.987506, 53.130075):
        face = op.Interface(1.0, np.radians(degrees), outside=1.3 + 0.01j)
        if degrees < 60:
            face = op.Interface(1.0, np.radians(degrees), 1.2 + 1e-3j, incidence_in=1.5)
        assert np.all(np.isfinite(face.mueller("in", "transmitted").matrix))
    too_large = op.Interface(1.5, np.radians(84.9876), outside=1.3 + 0.01j)
    assert fault_of(too_large.mueller)


@rows(
    "face, enters, words",
    [
        (op.Interface(1.5, np.pi / 2, outside=1.3 + 0.01j), "in", "at most 84.987506 deg"),
        (op.Interface(1.0, 0.3, outside=0.2 + 3.4j), "in", "k of at most n = 0.2"),
        (op.Interface(0.2 + 3.4j, 0.3), "back", "k of at most n = 0.2"),
        (
            op.Interface(1.0, 1.2, outside=1.2 + 1e-3j, incidence_in=1.5),
            "in",
            "at most 53.130075 deg in n = 1.5",
        ),
    ],
)
def test_a_wave_that_carries_no_power_is_refused_with_the_cure(face, enters, words):
    fault = fault_of(face.mueller, enters, "reflected")
    assert "fades along the normal faster than it goes on" in fault
    assert words in fault


def test_a_wave_is_looked_at_whenever_values_are_given():
    path = through(op.Interface(P("m"), P("t")), op.Interface(1.0, F, outside=F))
    assert path.compose().inputs.agreements == ()
    path.trace(m=np.array([1.5, 1.5 + 0.1j]), t=0.4)
    assert "fades along the normal" in fault_of(path.trace, m=0.2 + 3.4j, t=0.4)
    assert "at 1, of 2 paths" in fault_of(path.trace, m=np.array([1.5, 0.2 + 3.4j]), t=0.4)
    of_k = through(op.Interface(op.Material(0.5, P("k")), 0.1), op.Interface(1.0, F, outside=F))
    of_k.trace(k=0.1)
    assert "(parameter 'k')" in fault_of(of_k.trace, k=2.0)


def test_real_indices_for_parameters_give_the_same_numbers_bit_for_bit():
    path = through(op.Interface(P("m"), P("t")), op.Interface(1.0, F, outside=F))
    plain = through(op.Interface(P("m"), P("t")), op.Interface(1.0, P("t"), P("m"), incidence_in=1))
    given = {"m": np.linspace(1.3, 1.7, 40), "t": np.linspace(0.0, 1.5, 40)}
    lossless = through(
        op.Interface(given["m"], P("t")), op.Interface(1.0, P("t"), given["m"], incidence_in=1)
    )
    for other in (plain, lossless):
        found = other.trace(**{n: given[n] for n in other.compose().inputs.open}).stokes
        np.testing.assert_allclose(path.trace(**given).stokes, found, rtol=0, atol=2e-16)


@pytest.mark.parametrize("engine", BY_ENGINE)
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
    path = through(
        op.Interface(op.Material(1.5, P("k", 0.01)), P("t", 0.4)), op.Interface(1.0, F, outside=F)
    )
    plain = through(op.Interface(1.2, 0.4, outside=GLASS))
    for written in (path, plain):
        file = tmp_path / "path.toml"
        file.write_text(written.to_toml(), "utf-8")
        again = op.load_preset(file)
        assert again == written
        np.testing.assert_array_equal(again.trace().stokes, written.trace().stokes)


def test_directions_in_the_world_are_those_of_the_real_angle():
    face = op.Interface(1.0, "20 deg", outside=1.5 + 0.3j)
    behind = op.refraction_angle(1.0, np.radians(20), outside=1.5 + 0.3j)
    with mpmath.workdps(30):
        m2, t = mpmath.mpc(1.5, 0.3) ** 2, mpmath.radians(20)
        root = mpmath.sqrt(m2.real**2 + (m2.imag / mpmath.cos(t)) ** 2)
        y = mpmath.sqrt((m2.real + root) / 2) * mpmath.sin(t)
        assert float(behind) == pytest.approx(float(mpmath.asin(y)), rel=1e-15)
    down = op.Frame.from_direction((np.sin(np.radians(20)), 0, -np.cos(np.radians(20))), (0, 1, 0))
    into = op.Frame.from_direction((np.sin(behind), 0, -np.cos(behind)), (0, 1, 0))
    path = op.PathGraph()
    path.add("lamp", op.Source(), {"out": down})
    path.add("face", face, {"in": down, "transmitted": into})
    path.add("eye", op.Detector(), {"in": into})
    path.connect("lamp.out", "face.in")
    path.connect("face.transmitted", "eye.in")
    path.check()
    op.Interface(1.0, "20 deg", outside=1.5 + 0.3j).mueller()

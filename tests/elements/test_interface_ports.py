"""Interfaces from both sides, Snell's law, and what is refused."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp

import optipath as op
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


def test_beyond_the_critical_angle_light_creeps_along_the_boundary():
    assert float(op.refraction_angle(1.0, 1.0, outside=1.5)) == np.pi / 2


def test_one_angle_serves_a_whole_stack():
    behind = float(op.refraction_angle(1.5, 0.7))
    inner = op.Interface(1.3, 0.7, outside=1.5, incidence_in=1.0)
    direct = op.Interface(1.3, behind, outside=1.5)
    for leaves in ("reflected", "transmitted"):
        found, expected = (e.mueller("in", leaves).matrix for e in (inner, direct))
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-15)


@rows("method", ["stable", "compensated", "amplitude", "textbook"])
def test_every_method_refracts_first(method):
    inner = op.Interface(0.6 + 2j, 0.7, outside=1.5, incidence_in=1.0)
    expected = inner.mueller("in", "reflected").matrix
    found = inner.mueller("in", "reflected", method=method).matrix
    np.testing.assert_allclose(found, expected, rtol=0, atol=2e-14)


def test_the_last_face_of_a_slab_keeps_its_digits_next_to_grazing_incidence():
    apart = 1e-7
    glass = op.Interface(1.0, np.pi / 2 - apart, outside=1.5, incidence_in=1.0)
    with mp.workdps(50):
        c, s = mp.cos(mp.mpf(np.pi / 2 - apart)), mp.sin(mp.mpf(np.pi / 2 - apart))
        g = mp.sqrt(mp.mpf(1.5) ** 2 - s * s)
        along = 4 * c * g / (c + g) ** 2
    matrix = glass.mueller("in", "transmitted").matrix
    assert matrix[0, 0] + matrix[0, 1] == pytest.approx(float(along), rel=1e-9)


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

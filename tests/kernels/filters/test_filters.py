"""Filters against Jones calculus: M from J with the Stokes vector of docs/conventions.md."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from tables import rows

ANGLES = st.floats(-4.0, 4.0)


def stokes_of(jones):
    x, y = jones
    return np.array(
        [
            abs(x) ** 2 + abs(y) ** 2,
            abs(x) ** 2 - abs(y) ** 2,
            2 * (x.conjugate() * y).real,
            2 * (x.conjugate() * y).imag,
        ]
    )


def turned(jones_matrix, angle):
    c, s = np.cos(angle), np.sin(angle)
    back = np.array([[c, -s], [s, c]])
    return back @ jones_matrix @ back.T


@st.composite
def fields(draw):
    parts = [draw(st.floats(-1.0, 1.0)) for _ in range(4)]
    return np.array([complex(*parts[:2]), complex(*parts[2:])])


def agrees(element, jones_matrix, field):
    light = element.mueller() @ op.Light(stokes_of(field))
    np.testing.assert_allclose(light.stokes, stokes_of(jones_matrix @ field), rtol=0, atol=1e-14)


@given(field=fields(), angle=ANGLES, k1=st.floats(0, 1), k2=st.floats(0, 1))
def test_a_polarizer_is_two_principal_transmittances(field, angle, k1, k2):
    matrix = turned(np.diag(np.sqrt([k1, k2])), angle)
    agrees(op.Polarizer(angle, transmittance=k1, leakage=k2), matrix, field)


@given(field=fields(), angle=ANGLES, retardance=ANGLES)
def test_a_retarder_delays_the_slow_axis(field, angle, retardance):
    # exp(-i w t): a longer way is a phase exp(+i retardance).
    matrix = turned(np.diag([1.0, np.exp(1j * retardance)]), angle)
    agrees(op.Retarder(retardance, angle), matrix, field)


@given(field=fields(), angle=ANGLES)
def test_a_rotator_turns_the_field_from_x_to_y(field, angle):
    c, s = np.cos(angle), np.sin(angle)
    agrees(op.Rotator(angle), np.array([[c, -s], [s, c]]), field)


@given(field=fields(), t=st.floats(0, 1))
def test_an_attenuator_dims_all_components(field, t):
    agrees(op.Attenuator(t), np.sqrt(t) * np.eye(2), field)


def test_polarizers_halve_unpolarised_light_and_plates_make_positive_helicity():
    light = op.Polarizer(np.pi / 2).mueller() @ op.Light([100.0, 0, 0, 0])
    np.testing.assert_allclose(light.stokes, [50, -50, 0, 0], rtol=0, atol=1e-13)
    light = op.Retarder(np.pi / 2).mueller() @ op.Light([1.0, 0, 1.0, 0])
    np.testing.assert_allclose(light.stokes, [1, 0, 0, 1], rtol=0, atol=1e-15)


@rows("port", ["reflected", "transmitted"])
def test_a_beam_splitter_shares_the_intensity(port):
    share = {"reflected": 0.3, "transmitted": 0.7}[port]
    light = op.BeamSplitter(0.3).mueller(leaves=port) @ op.Light([1.0, 0.5, 0.2, 0.1])
    assert light.intensity == pytest.approx(share, abs=1e-16)
    handed = -1.0 if port == "reflected" else 1.0
    np.testing.assert_allclose(light.stokes[2:], handed * share * np.array([0.2, 0.1]))

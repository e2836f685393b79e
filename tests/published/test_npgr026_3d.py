"""The assignment geometry in space: the same light, by way of points and world frames."""

import numpy as np
import pytest

import optipath as op
from chains import ENGINES
from published import npgr026

COUNT = 10_000


def exact(case):
    return np.array([float(component) for component in npgr026.EXACT[case]])


@pytest.mark.parametrize("case", sorted(npgr026.EXACT))
def test_a_published_case_agrees_with_the_exact_value(case):
    stokes = op.load_preset("npgr026-3d", case=case).trace().stokes
    # Case 3 lives off two reflections next to Brewster's angle.
    slack = 1e-11 if case == "3" else 1e-13
    assert np.max(np.abs(stokes - exact(case))) <= slack * exact(case)[0]


def test_parameters_and_cases_are_those_of_the_plane_preset():
    plane, space = op.load_preset("npgr026"), op.load_preset("npgr026-3d")
    assert plane.parameters == space.parameters
    assert plane.cases == space.cases


def random_values(seed, near):
    draw = np.random.default_rng(seed).uniform
    values = {name: draw(0.0, np.pi / 2, COUNT) for name in ("delta", "phi")}
    if near:
        for name in values:
            small = 10.0 ** draw(-12.0, -1.0, COUNT)
            values[name] = small if near == "normal" else np.pi / 2 - small
    values["rho"] = draw(-2 * np.pi, 2 * np.pi, COUNT)
    values |= {name: draw(0.1, 4.0, COUNT) for name in ("n1", "n2")}
    values |= {name: draw(0.0, 5.0, COUNT) for name in ("k1", "k2")}
    return values


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("near", ["", "normal", "grazing"])
@pytest.mark.parametrize("filtered", [False, True])
def test_random_values_give_the_light_of_the_plane_preset(engine, near, filtered):
    values = random_values(1, near)
    values["filter"] = np.linspace(-np.pi, np.pi, COUNT) if filtered else "none"
    composer = op.Composer(engine=engine)
    plane, space = (composer.compose(op.load_preset(n)) for n in ("npgr026", "npgr026-3d"))
    light, expected = space.run(**values), np.asarray(plane.run(**values).stokes)
    off = np.max(np.abs(np.asarray(light.stokes) - expected), axis=-1)
    assert np.all(off <= 1e-12 * expected[:, 0])
    frame = light.frame
    assert op.Frame(frame.x, frame.y, frame.z) == frame, "right-handed"


EDGES = [0.0, 1e-17, 1e-15, 0.7, np.pi / 2]


@pytest.mark.parametrize("delta", EDGES)
@pytest.mark.parametrize("phi", EDGES)
@pytest.mark.parametrize("axis", ["none", "horizontal", 0.2])
def test_where_a_surface_has_no_plane_of_its_own_the_angles_tell_it(delta, phi, axis):
    metal = {"n1": 1.12, "k1": 2.16, "n2": 0.608, "k2": 2.12, "rho": 0.6, "filter": axis}
    light = op.load_preset("npgr026-3d").trace(delta=delta, phi=phi, **metal)
    expected = op.load_preset("npgr026").trace(delta=delta, phi=phi, **metal)
    np.testing.assert_allclose(light.stokes, expected.stokes, rtol=0, atol=1e-13)


def test_x1_alone_without_a_plane_at_x2_is_seen_as_in_the_plane_preset():
    values = {"phi": 0.0, "delta": 0.8, "rho": 0.6, "filter": 0.2, "k2": 2.0}
    light = op.load_preset("npgr026-3d").trace(**values)
    expected = op.load_preset("npgr026").trace(**values).stokes
    np.testing.assert_allclose(light.stokes, expected, rtol=0, atol=1e-14)

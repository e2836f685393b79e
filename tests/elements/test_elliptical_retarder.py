import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from chains import ENGINES
from paths import chain
from tables import rows

STATE = [1.0, 0.5, 0.6, 0.4]


def rotation(vector):
    """The rotation of the sphere about a vector by the right-hand rule, in 50 digits."""
    x, y, z = map(mpmath.mpf, vector)
    with mpmath.workdps(50):
        return np.array(
            mpmath.expm(
                mpmath.matrix([[0, -z, y], [z, 0, -x], [-y, x, 0]]), method="taylor"
            ).tolist(),
            dtype=float,
        )


def matrix_of(vector):
    """The matrix of a retarder whose vector is not known to lie along an axis."""
    names = ("s1", "s2", "s3")
    path = chain([op.EllipticalRetarder(*map(op.Parameter, names))], STATE)
    return path.mueller(**dict(zip(names, vector, strict=True))).matrix


@rows("size", [1e-12, 1e-6, 0.3, 1.0, 3.0, 50.0])
@rows("seed", range(4))
def test_it_turns_the_sphere_about_its_vector(seed, size):
    vector = size * np.random.default_rng(seed).normal(size=3)
    found = op.EllipticalRetarder(*map("{} rad".format, vector)).mueller().matrix
    atol = 1e-15 + 4e-16 * np.linalg.norm(vector)
    np.testing.assert_allclose(found[1:, 1:], rotation(vector), rtol=0, atol=atol)
    np.testing.assert_array_equal(found[0], [1.0, 0.0, 0.0, 0.0])
    np.testing.assert_array_equal(found[:, 0], [1.0, 0.0, 0.0, 0.0])


@rows("retardance", [0.7, np.pi / 2, np.pi, -2.0])
@rows("angle", [0.0, 0.4, np.pi / 4, -1.1])
def test_one_of_no_s3_is_a_linear_retarder(retardance, angle):
    vector = retardance * np.cos(2 * angle), retardance * np.sin(2 * angle), 0.0
    wanted = op.Retarder(retardance, angle).mueller().matrix
    np.testing.assert_allclose(matrix_of(vector), wanted, rtol=0, atol=7e-16)


@rows("angle", [0.3, np.pi / 4, -1.2])
def test_one_of_s3_alone_is_a_rotator_of_half_the_angle(angle):
    wanted = op.Rotator(angle).mueller().matrix
    np.testing.assert_allclose(matrix_of((0.0, 0.0, 2 * angle)), wanted, rtol=0, atol=3e-16)
    np.testing.assert_array_equal(op.EllipticalRetarder(s3=2 * angle).mueller().matrix, wanted)


def test_one_that_is_known_to_be_linear_is_a_retarder_to_the_bit():
    found = op.EllipticalRetarder(0.7, azimuth=0.3)
    path, wanted = (chain([one], STATE).trace() for one in (found, op.Retarder(0.7, azimuth=0.3)))
    np.testing.assert_array_equal(path.stokes, wanted.stokes)


def test_the_state_along_the_vector_is_the_fast_one():
    # What is fast gains less phase: light half of it leads, as behind a quarter-wave plate.
    fast = np.array([0.48, 0.6, 0.64])
    plate = op.EllipticalRetarder(*(np.pi / 2 * fast)).mueller()
    np.testing.assert_allclose((plate @ op.Light([1, *fast])).stokes, [1, *fast], atol=4e-16)
    across = np.cross(fast, [0.0, 0.0, 1.0])
    across /= np.linalg.norm(across)
    found = (plate @ op.Light([1, *across])).stokes[1:]
    np.testing.assert_allclose(found, np.cross(fast, across), rtol=0, atol=4e-16)


@rows("engine, dtype", [("numpy", "float32"), *((engine, "float64") for engine in ENGINES)])
def test_every_engine_and_precision_agrees(engine, dtype):
    values = np.random.default_rng(1).uniform(-3.0, 3.0, (3, 3000))
    names = ("s1", "s2", "s3")
    path = chain([op.EllipticalRetarder(*map(op.Parameter, names), azimuth=0.2)], STATE)
    plan = op.Composer(engine=engine, dtype=dtype).compose(path)
    found = plan.run(**dict(zip(names, values, strict=True))).stokes
    wanted = chain([op.EllipticalRetarder(*values, azimuth=0.2)], STATE).trace().stokes
    atol = 2e-6 if "float32" in (dtype, np.asarray(found).dtype.name) else 4e-15
    np.testing.assert_allclose(np.asarray(found), wanted, rtol=0, atol=atol)


component = st.floats(-6.0, 6.0)


@given(st.tuples(component, component, component))
def test_the_opposite_vector_undoes_it_and_no_light_is_lost(vector):
    there, back = (
        op.EllipticalRetarder(*(sign * part for part in vector)).mueller().matrix
        for sign in (1.0, -1.0)
    )
    np.testing.assert_allclose(back @ there, np.eye(4), rtol=0, atol=2e-15)


def test_an_angle_in_degrees_is_warned_of():
    with pytest.warns(op.AngleWarning, match="EllipticalRetarder s2 is a plain number beyond 2 pi"):
        op.EllipticalRetarder(s2=90)


def test_it_has_no_jones_matrix_where_its_axis_is_none_of_the_frame():
    path = chain([op.EllipticalRetarder(0.1, 0.2, 0.3)], STATE)
    with pytest.raises(op.ComposerError, match="and has no Jones matrix here"):
        op.Composer(composing="jones").compose(path)


@pytest.mark.filterwarnings("ignore::optipath.AngleWarning")
def test_an_angle_that_floats_cannot_tell_is_refused():
    with pytest.raises(op.ValueFault, match=r"s1 is 1.7e\+308"):
        op.EllipticalRetarder(1.7e308, 1.7e308, 1.7e308)


@pytest.mark.filterwarnings("ignore::optipath.AngleWarning")
def test_the_largest_angles_give_numbers():
    assert np.all(np.isfinite(op.EllipticalRetarder(1e15, 1e15, -1e15).mueller().matrix))


@rows("vector", [[0.1, 0.2, 0.3], (0.1, 0.2, 0.3), ["6 deg", "12 deg", 0.3]])
def test_three_numbers_of_the_first_component_are_asked_about(vector):
    with pytest.raises(op.OptipathError, match="may be a rotation vector, or s1 of three paths"):
        op.EllipticalRetarder(vector)
    path = chain([op.EllipticalRetarder(op.Parameter("v"))], STATE)
    with pytest.raises(op.ParameterError, match=r"'v'.* may be a rotation vector"):
        path.trace(v=vector)


def test_what_can_be_of_several_retarders_alone_is_not_asked_about():
    several = [0.1, 0.2, 0.3]
    wanted = chain([op.EllipticalRetarder(np.array(several), 0.2)], STATE).trace().stokes
    path = chain([op.EllipticalRetarder(op.Parameter("v"), 0.2)], STATE)
    for found in (
        chain([op.EllipticalRetarder(several, 0.2)], STATE).trace(),
        path.trace(v=several),
        path.trace(v=np.array(several)),
    ):
        np.testing.assert_allclose(found.stokes, wanted)
    op.EllipticalRetarder(s3=several)
    op.EllipticalRetarder(several[:2])
    path = chain([op.EllipticalRetarder(op.Parameter("v"))], STATE)
    assert path.trace(v=np.array(several)).shape == (3,)


def test_retarders_of_three_paths_are_read_back(tmp_path):
    path = chain([op.EllipticalRetarder(np.array([0.1, 0.2, 0.3]))], STATE)
    (tmp_path / "three.toml").write_text(path.to_toml())
    again = op.load_preset(tmp_path / "three.toml")
    np.testing.assert_array_equal(again.trace().stokes, path.trace().stokes)

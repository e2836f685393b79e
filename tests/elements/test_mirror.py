import numpy as np
import pytest

import optipath as op
from paths import chain
from tables import rows

METALS = [0.608 + 2.12j, 1.12 + 2.16j, 0.17 + 3.15j, 1.5 + 0j]
STATE = [1.0, 0.5, 0.6, 0.4]


def fresnel(m, incidence):
    """Born & Wolf, sec. 1.5.2, by complex numbers."""
    c, g = np.cos(incidence), np.sqrt(m * m - np.sin(incidence) ** 2)
    return (c - g) / (c + g), (m * m * c - g) / (m * m * c + g)


@rows("index", METALS)
@rows("incidence", [0.0, 0.3, 0.9, 1.4])
def test_a_mirror_of_a_metals_amplitudes_is_the_metal(index, incidence):
    mirror = op.Mirror(*fresnel(index, incidence)).mueller()
    metal = op.Interface(index, incidence).mueller()
    np.testing.assert_allclose(mirror.matrix, metal.matrix, rtol=0, atol=4e-15)


def test_an_ideal_mirror_turns_handedness_and_diagonals_over():
    np.testing.assert_array_equal(op.Mirror().mueller().matrix, np.diag([1.0, 1.0, -1.0, -1.0]))


def test_an_ideal_mirror_is_a_beam_splitter_that_lets_nothing_through():
    splitter = op.BeamSplitter(1.0).mueller(leaves="reflected")
    np.testing.assert_array_equal(op.Mirror().mueller().matrix, splitter.matrix)


def test_a_phase_between_s_and_p_is_that_of_r_s_times_r_p_conjugated():
    # A phase of 90 degrees beside the mirror's own makes diagonal light circular.
    light = op.Mirror(-1.0, 1j).mueller() @ op.Light([1.0, 0.0, 1.0, 0.0])
    np.testing.assert_allclose(light.stokes, [1, 0, 0, -1], rtol=1e-15, atol=1e-16)


def test_nearly_equal_amplitudes_keep_the_digits_of_their_difference():
    small = 2.0**-40
    matrix = op.Mirror(-0.5 - small, 0.5).mueller().matrix
    assert matrix[0, 1] == 0.5 * small * (1.0 + small)


def test_no_mirror_polarises_by_more_than_all():
    rng = np.random.default_rng(1)
    phases = np.exp(1j * rng.uniform(-4, 4, (2, 500)))
    light = chain([op.Mirror(*(rng.uniform(0, 1, (2, 500)) * phases))], [1.0, 0.6, 0.0, 0.8])
    found = light.trace()
    assert np.all(found.dop <= 1.0 + 1e-12)
    assert np.all(found.intensity <= 1.0)


@rows("engine", ["numpy", "numba"])
def test_amplitudes_may_be_parameters_of_complex_numbers(engine):
    given = 0.7 * np.exp(1j * np.linspace(-3, 3, 3000))
    path = chain([op.Mirror(-0.9, op.Parameter("r"))], STATE)
    found = op.Composer(engine=engine).compose(path).run(r=given).stokes
    wanted = chain([op.Mirror(-0.9, given)], STATE).trace().stokes
    np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-15)
    alone = np.array([path.trace(r=r).stokes for r in given[:3]])
    np.testing.assert_allclose(alone, wanted[:3], rtol=0, atol=1e-15)


def test_a_parameter_of_amplitudes_may_be_real_and_have_a_sign():
    r = op.Parameter("r", 1.0)
    path = chain([op.Mirror(-r, r)], STATE)
    np.testing.assert_array_equal(path.trace().stokes, chain([op.Mirror()], STATE).trace().stokes)


def test_amplitudes_that_give_light_are_refused():
    with pytest.raises(op.ValueFault, match=r"Mirror r_s is 1\.2; .* a size of 1 or less") as error:
        op.Mirror(1.2, 0.8 + 0.8j)
    assert len(error.value.faults) == 2


@rows("r", [1.5, 1j + 0.1, np.full(3000, -1.1), np.full(3000, 0.9 + 0.9j)])
def test_amplitudes_that_give_light_are_refused_when_a_plan_runs(r):
    path = chain([op.Mirror(-1.0, op.Parameter("r"))])
    with pytest.raises(op.ParameterError, match="size of 1 or less"):
        path.trace(r=r)


def test_a_phase_rounded_up_is_no_fault():
    phases = np.exp(1j * np.linspace(0.0, 6.0, 1000))
    assert np.any(np.abs(phases) > 1.0)
    assert op.Mirror(phases, -phases).mueller().matrix.shape == (1000, 4, 4)


def test_world_frames_of_a_mirror_share_s():
    arriving = op.Frame()
    sideways = op.Frame.from_direction(z=(0, 1, 0), x=(1, 0, 0))
    assert op.Mirror().mueller(frame_in=arriving, frame_out=sideways).frame_out == sideways
    with pytest.raises(op.PathError, match="share one x"):
        op.Mirror().mueller(frame_in=arriving, frame_out=op.Frame().turned(0.3))


def test_an_azimuth_turns_the_plane_of_incidence():
    turned = chain([op.Mirror(-0.9, 0.5j, azimuth=0.4)], STATE).trace().stokes
    arriving = op.Light(STATE).in_frame(op.Frame().turned(0.4))
    by_hand = op.Mirror(-0.9, 0.5j).mueller() @ op.Light(arriving.stokes)
    np.testing.assert_allclose(turned, by_hand.stokes, rtol=1e-15, atol=1e-16)


@rows("engine", ["numpy", "numba"])
def test_the_rounding_of_single_precision_is_no_fault(engine):
    phases = np.exp(1j * np.linspace(0.0, 6.0, 3000)).astype(np.complex64)
    assert np.any(np.abs(phases.astype(complex)) > 1.0 + 1e-9)
    path = chain([op.Mirror(phases, op.Parameter("r"))], STATE)
    found = op.Composer(engine=engine).compose(path).run(r=phases)
    np.testing.assert_allclose(found.intensity, 1.0, rtol=1e-6)
    with pytest.raises(op.ParameterError, match="size of 1 or less"):
        path.trace(r=1.00001)


def test_amplitudes_may_be_given_as_texts(tmp_path):
    path = chain([op.Mirror(-0.5 + 0.1j, op.Parameter("r", "0.3+0.4j"))], STATE)
    wanted = path.trace(r=-0.9 + 0.1j).stokes
    np.testing.assert_array_equal(path.trace(r="(-0.9+0.1j)").stokes, wanted)
    text = path.to_toml().replace("{ re = -0.5, im = 0.1 }", '"-0.5+0.1j"')
    assert "0.1j" in text
    file = tmp_path / "mirror.toml"
    file.write_text(text)
    assert op.load_preset(str(file)) == path


@rows("amplitude", [0.9, -0.9, 0.3 - 0.4j, "-0.9+0.1j", np.array([0.1, 0.2])])
@rows("given", ["r_s", "r_p"])
def test_where_one_amplitude_is_given_the_other_is_minus_that(given, amplitude):
    matrix = op.Mirror(**{given: amplitude}).mueller().matrix
    share = np.abs(complex(amplitude) if isinstance(amplitude, str) else amplitude) ** 2
    ideal = np.diag([1.0, 1.0, -1.0, -1.0])
    np.testing.assert_allclose(matrix, np.multiply.outer(share, ideal), rtol=1e-15, atol=1e-16)


def test_an_amplitude_follows_a_parameter_and_goes_to_files_so():
    path = chain([op.Mirror(op.Parameter("r"))], STATE)
    wanted = np.array([1.0, 0.5, -0.6, -0.4]) * 0.81
    np.testing.assert_allclose(path.trace(r=-0.9).stokes, wanted, rtol=1e-15)
    assert 'r_p = "-$r"' in path.to_toml()


def test_a_file_that_says_one_amplitude_has_the_other(tmp_path):
    file = tmp_path / "path.toml"
    text = chain([op.Mirror(-0.9)]).to_toml()
    file.write_text(text.replace("r_p = 0.9\n", ""), "utf-8")
    assert "r_p = 0.9\n" in text
    assert op.load_preset(file) == chain([op.Mirror(-0.9, 0.9)])
    file.write_text(text.replace("r_p = 0.9\n", "").replace("r_s = -0.9", "r_s = 1.2"), "utf-8")
    with pytest.raises(op.OptipathError) as told:
        op.load_preset(file)
    assert len(told.value.faults) == 1

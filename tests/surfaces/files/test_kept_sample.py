import numpy as np
import pytest

import optipath as op
from hemispheres import PHOTONS, same_bits
from optipath.surfaces import HeightField

pytest.importorskip("h5netcdf")


def heights(seed=1):
    return np.random.default_rng(seed).normal(size=(12, 12))


def sample_of_heights(seed=1, description=""):
    field = HeightField.from_heights(heights(seed), 20.0, periodic=True)
    return op.Sample([(1j, field)], description=description)


@pytest.fixture
def saved(tmp_path):
    found = op.measure(sample_of_heights(), "40 deg", PHOTONS, sensor=12)
    found.save(tmp_path / "a.nc")
    return found, tmp_path / "a.nc"


def test_a_sample_that_has_no_form_in_files_is_told_where_it_is_asked_for(saved):
    found, file = saved
    again = op.load_hemisphere(file)
    assert same_bits(again, found)
    assert not again.seen.beam.sample.isotropic
    assert repr(again).startswith("Hemisphere of a sample that is not known at 40 deg")
    with pytest.raises(
        op.SurfaceError, match=r"not known: .*heights are in no file.*sample=\.\.\."
    ):
        again.seen.beam.block(0)


def test_it_can_be_given(saved):
    found, file = saved
    again = op.load_hemisphere(file, sample=sample_of_heights(description="the same"))
    assert same_bits(again, found)
    assert again.seen.beam.block(0, 16).photons == 16


def test_another_sample_is_refused(saved):
    _, file = saved
    with pytest.raises(op.SurfaceError, match=r"is not the one that was measured"):
        op.load_hemisphere(file, sample=sample_of_heights(seed=2))
    with pytest.raises(op.SurfaceError, match=r"sample is 'mirror'; give the op.Sample"):
        op.load_hemisphere(file, sample="mirror")


def test_a_sample_that_is_not_known_is_saved_again_and_can_be_given_then(saved):
    found, file = saved
    op.load_hemisphere(file).save(file)
    again = op.load_hemisphere(file, sample=sample_of_heights())
    assert same_bits(again, found)


def test_heights_of_a_file_may_be_others_now_and_are_not_read(tmp_path):
    np.save(tmp_path / "heights.npy", heights())
    text = 'format = 1\n[[layers]]\nindex = { n = 0.0, k = 1.0 }\nheights = "heights.npy"\n'
    (tmp_path / "mine.toml").write_text(text + "size = [20.0, 20.0]\nperiodic = true\n")
    sample = op.load_sample(tmp_path / "mine.toml")
    found = op.measure(sample, "40 deg", PHOTONS, sensor=12)
    found.save(tmp_path / "a.nc")
    np.save(tmp_path / "heights.npy", 2.0 * heights())
    again = op.load_hemisphere(tmp_path / "a.nc")
    assert same_bits(again, found)
    with pytest.raises(op.SurfaceError, match=r"its heights are not in this file; give it"):
        _ = again.seen.beam.sample.layers
    assert op.load_hemisphere(tmp_path / "a.nc", sample=sample).seen.beam.sample == sample

"""What is measured again, beside closed forms on flat samples."""

import numpy as np
import pytest

import optipath as op
from optipath.lab.published.experiment import Experiment, Measurement, Walks
from optipath.lab.published.experiment_files import load_experiment
from optipath.lab.published.reproduction import reproduce

pytest.importorskip("numba")
pytest.importorskip("xarray")


ROUGH = op.Sample([(1.5, 0.3), (2.4, 0.3)], surfaces=2, cells=400)


def amplitudes(m, theta):
    """r_s and r_p, as textbooks have them, of fields whose p keeps its sense."""
    c, g = np.cos(theta), np.sqrt(m**2 - np.sin(theta) ** 2 + 0j)
    return (c - g) / (c + g), (m**2 * c - g) / (m**2 * c + g)


def found(sample, measure, incidence, photons=20_000, **more):
    one = Measurement(measure, "", Walks(incidence, (), more.pop("cells", None)), **more)
    (again,) = reproduce(Experiment("own", "", "", sample, (one,), sensor=64), photons)
    assert (again.measurement, again.photons) == (one, photons)
    return again.found


def test_shares_of_a_flat_face_are_those_of_fresnel():
    value, error, mask, pixel = found(op.Sample([(1.5, 0)]), "R", "60 deg")
    r_s, r_p = amplitudes(1.5, np.pi / 3)
    assert abs(value - (abs(r_s) ** 2 + abs(r_p) ** 2) / 2.0) < 5 * error < 0.02
    assert (mask, pixel) == ("", "")


def test_shares_are_those_of_the_light_that_is_given():
    r_s, r_p = amplitudes(1.5, np.pi / 3)
    for s1, known in ((1.0, r_s), (-1.0, r_p)):
        light = (1.0, s1, 0.0, 0.0)
        value, error, *_ = found(op.Sample([(1.5, 0)]), "R", "60 deg", stokes=light)
        assert abs(value - abs(known) ** 2) < 5 * error < 0.02


def test_lights_from_one_direction_are_told_apart():
    walks = Walks("60 deg", (), None)
    lights = [(1.0, s1, 0.0, 0.0) for s1 in (1.0, -1.0, 0.0)]
    several = tuple(Measurement("R", "", walks, stokes=light) for light in lights)
    experiment = Experiment("own", "", "", op.Sample([(1.5, 0)]), several)
    both = [one.found for one in reproduce(experiment, 20_000)]
    assert both[0].value > 0.15
    assert both[1].value < 0.05
    assert abs((both[0].value + both[1].value) / 2.0 - both[2].value) < 5 * both[2].error


@pytest.mark.parametrize("measure", ["R+T", "scalar-R+T"])
def test_glass_reflects_or_lets_through_all_light(measure):
    value, error, *_ = found(op.Sample([(1.5, 0.3)], surfaces=2, cells=400), measure, "60 deg")
    assert abs(value - 1.0) < 5 * error + 1e-12


@pytest.mark.parametrize(("angle", "known"), [(50, 1.785), (56, 2.498), (60, 2.900), (65, 3.167)])
def test_adm_of_a_smooth_stack_is_the_exact_one(angle, known):
    # 1.5 on 2.4, flat: all light goes into one pixel; by the matrices of the two interfaces and
    # the geometric series between them, in per cent.
    sample = op.Sample([(1.5, 0), (2.4, 0)])
    value, error, mask, pixel = found(sample, "adm", f"{angle} deg", 200_000)
    assert abs(100.0 * value - known) < 500.0 * error + 0.001
    assert 100.0 * error < 0.05
    assert "64 x 64 pixels" in mask
    assert abs(int(pixel.split(" ")[0]) - angle) <= 1


def test_pixels_beside_the_plane_of_incidence_are_left_out_where_an_azimuth_is_given():
    *_, mask, pixel = found(ROUGH, "adm", "60 deg", 50_000, azimuth=10.0, noise=5.0)
    assert "azimuth within 10 deg" in mask
    assert int(pixel.split(" ")[2]) <= 10


def test_without_a_pixel_that_counts_there_is_no_value():
    value, error, *_ = found(ROUGH, "adm", "60 deg", 20_000, brighter_than=1e6)
    assert np.isnan([value, error]).all()


def test_mirrored_light_has_the_polarisation_of_fresnel():
    sample, theta = op.Sample([(0.2 + 3.4j, 0)]), np.radians(60.0)
    r_s, r_p = amplitudes(0.2 + 3.4j, theta)
    light = np.array([r_s, r_p])
    intensity, s1 = np.sum(abs(light) ** 2), abs(light[0]) ** 2 - abs(light[1]) ** 2
    s2 = 2.0 * np.real(np.conj(light[0]) * light[1])
    dolp = found(sample, "dolp", "60 deg", stokes=(1.0, 0.0, 1.0, 0.0))
    aop = found(sample, "aop", "60 deg", stokes=(1.0, 0.0, 1.0, 0.0))
    assert dolp.value == pytest.approx(np.hypot(s1, s2) / intensity, rel=1e-12)
    assert aop.value == pytest.approx(np.degrees(np.arctan2(abs(s2), abs(s1))) / 2.0, rel=1e-12)
    assert "where a mirror sends the light" in aop.mask


@pytest.mark.parametrize(("cells", "finer"), [(40, False), (640, True)])
def test_cells_are_those_of_the_experiment_without_a_warning(cells, finer):
    value, *_ = found(op.Sample([(1.5, 1.0)]), "scalar-T_m", "1 rad", 65_536, cells=cells)
    # A coarse mesh has too little light that is refracted twice.
    assert (value > 0.053) == finer


def test_a_seed_gives_the_same_numbers_with_any_number_of_threads():
    several = tuple(
        Measurement(measure, "", Walks("60 deg", (), None)) for measure in ("adm", "R_m")
    )
    experiment = Experiment("own", "", "", ROUGH, several, sensor=16)
    one, two = (
        [each.found for each in reproduce(experiment, 40_000, seed=3, threads=threads)]
        for threads in (1, 2)
    )
    assert one == two
    assert np.isfinite([each.value for each in one]).all()


def test_progress_is_told_of_each_direction():
    told = []
    experiment = load_experiment("wang-2017-table-2-alpha-0-1")
    again = reproduce(experiment, 1000, progress=lambda *counts: told.append(counts))
    assert all(one.agrees for one in again)
    assert told.count((1000, 1000)) >= 3


def test_too_few_photons_are_told_with_a_cure_that_can_be_followed():
    with pytest.raises(op.SurfaceError, match=r"measure with more photons$"):
        found(op.Sample([(1.5, 0.3)], cells=400), "adm", "60 deg", 1)

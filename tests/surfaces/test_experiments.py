"""Published experiments: their files, what agrees with a number, and what is measured again."""

import math
from itertools import product

import numpy as np
import pytest

import optipath as op
from optipath.surfaces.reproduction import (
    MEASURES,
    Experiment,
    Measurement,
    experiment_names,
    load_experiment,
    reproduce,
)
from tables import rows

AT_60, AT_80 = "60 deg", "80 deg"
ROUGH = op.Sample([(1.5, 0.3), (2.4, 0.3)], surfaces=2, cells=400)
OWN = """\
format = 1
description = "glass"
source = "a notebook"
sample = "glass-rough"

[[measurements]]
measure = "R"
incidence = ["60 deg", "1 rad"]
text = "a tenth"
published = [0.1, [0.05, 0.1]]
"""
TEXT, TABLE = 'text = "a tenth"', "[[measurements]]"


def test_a_value_agrees_within_the_range_what_is_allowed_and_two_errors():
    one = Measurement("adm", "16.5 to 18 %", AT_60, None, (0.165, 0.18), within=0.0150001)
    for value, error in ((0.165, 0.0), (0.151, 0.0), (0.149, 0.001), (0.1481, 0.001), (0.195, 0.0)):
        assert one.agrees(value, error) is True
    for value, error in ((0.149, 0.0), (0.1479, 0.001), (0.1951, 0.0), (math.nan, 0.0)):
        assert one.agrees(value, error) is False
    assert Measurement("adm", "larger", AT_60).agrees(0.165, 0.0) is None
    # Measurements of one direction share photons, in the order of the file.
    pairs = [("adm", AT_60), ("adm", AT_80), ("mdm", AT_60), ("mdm", AT_80)]
    several = tuple(Measurement(measure, "", incidence) for measure, incidence in pairs)
    found = reproduce(Experiment("own", "", "", op.Sample([(1.5, 0.1)]), several, sensor=8), 20_000)
    shared = [(one.measurement.incidence, one.measurement.measure) for one in found]
    assert shared == [(AT_60, "adm"), (AT_60, "mdm"), (AT_80, "adm"), (AT_80, "mdm")]


def written(folder, text):
    file = folder / "own.toml"
    file.write_text(text, "utf-8")
    return file


def refused(folder, text):
    with pytest.raises(op.errors.SurfaceError) as error:
        load_experiment(written(folder, text))
    return error.value.faults


def test_every_published_sample_has_an_experiment_with_its_source_numbers_and_wavelengths():
    samples = [name for name in op.sample_names() if name.startswith("wang-2017-")]
    assert experiment_names() == samples
    for name in samples:
        found = load_experiment(name)
        assert found.sample == op.load_sample(name)
        assert found.source.startswith("M. Wang et al., Optics Express 25(19), 2017, "), name
        assert all(one.text and one.measure in MEASURES for one in found.measurements), name
    with pytest.raises(op.errors.SurfaceError, match="did you mean 'wang-2017-table-1'"):
        load_experiment("wang-2017-tabel-1")
    found = load_experiment("wang-2017-simulation-01").measurements
    known = {one.incidence: one.published for one in found}
    numbers = {"50 deg": 0.165, "56 deg": 0.19, "60 deg": 0.205, "65 deg": 0.215}
    assert known == {angle: (number, number) for angle, number in numbers.items()}
    # Metals are looked at from 380 to 700 nm.
    found = load_experiment("wang-2017-simulation-07")
    assert found.wavelengths == tuple(f"{each} nm" for each in range(380, 701, 40))


def test_a_file_of_ones_own_may_have_a_sample_beside_it_pixels_and_wavelengths(tmp_path):
    found = load_experiment(written(tmp_path, OWN)).measurements
    known = [(one.incidence, one.published) for one in found]
    assert known == [("60 deg", (0.1, 0.1)), ("1 rad", (0.05, 0.1))]
    (tmp_path / "pane.toml").write_text(op.Sample([(1.7, 0.0)]).to_toml(), "utf-8")
    text = OWN.replace("glass-rough", "pane.toml")
    assert load_experiment(written(tmp_path, text)).sample == op.Sample([(1.7, 0.0)])
    # Without random fields it takes no cells.
    (fault,) = refused(tmp_path, text.replace(TEXT, f"{TEXT}\ncells = 20"))
    assert fault.startswith("measurements[0]: ")
    assert "cells" in fault
    more = '[[measurements]]\nmeasure = "adm"\nincidence = ["1 rad"]\ntext = "none"\n'
    text = OWN.replace(TABLE, f"sensor = 64\n{TABLE}") + more
    assert load_experiment(written(tmp_path, text)).sensor == 64
    text, cure = OWN.replace("glass-rough", "gold-rough"), 'wavelengths = ["550 nm"]'
    (fault,) = refused(tmp_path, text)
    assert fault.startswith("wavelengths: ")
    assert fault.endswith("depends on the wavelength; give one, --wavelength '550 nm'")
    cured = load_experiment(written(tmp_path, text.replace(TABLE, f"{cure}\n{TABLE}")))
    assert cured.wavelengths == ("550 nm",)


def test_all_faults_of_a_file_are_told_at_once(tmp_path):
    text = OWN.replace('"R"', '"adn"').replace("1 rad", "1 nm").replace("[0.05, 0.1]", '"x"')
    faults = refused(tmp_path, text.replace('sample = "', 'photons = 0\nsample = "'))
    assert len(faults) == 4
    told = " ".join(faults)
    for part in (
        "photons must be a whole number of 1 or more, not 0",
        "measurements[0]: measure 'adn' is unknown; did you mean 'adm'?",
        "measurements[0]: published is [0.1, 'x']; write a number, or ",
        "1 nm",
    ):
        assert part in told


ALL = OWN[OWN.index("[[") :]
AZIMUTH = "measurements[0]: 'azimuth' is {}; write a number from 0 to 180, in degrees"


@rows(
    "old, new, told",
    [
        ("format = 1", "format = 2", "format is 2, but this version reads format 1"),
        ("glass-rough", "nul\\u0000.toml", "cannot be read"),
        ("glass-rough", "glas-rough", "sample: sample 'glas-rough' is unknown"),
        ("[0.1, [", "[0.1, 0.2, [", "for each of the 2 angles of incidence"),
        ("[0.05, 0.1]", "[0.1, 0.05]", "published is [0.1, [0.1, 0.05]]; write a"),
        ("60 deg", "90 deg", "90 deg, along the sample"),
        ("text =", "text = 'a'\ntexd =", "key 'texd' is unknown; did you mean 'text'?"),
        (TEXT, f"{TEXT}\nwithin = -1", "'within' is -1; write a number from 0"),
        (TEXT, "", "'text' is missing"),
        (TEXT, f"{TEXT}\ncells = 1", "cells must be a whole number from 2, or two"),
        (TEXT, f"{TEXT}\nstokes = [1, 2, 0, 0]", "give S0 > 0 and S1^2"),
        ('"glass-rough"', '"gold-rough"\nwavelengths = ["500 nm", "600 nm"]', "of one wavelength"),
        ('"1 rad"', "1.0", 'incidence: 1.0 is no text; write one such as "60 deg"'),
        (ALL, "measurements = 3", "'measurements' must be a list, not 3"),
        ('["60 deg", "1 rad"]', '"50 deg"', "measurements[0]: 'incidence' must be a list, not"),
        ('"R"', "3", "measurements[0]: 'measure' must be a text, not 3"),
        ('"glass-rough"', "3", "'sample' must be a text, not 3"),
        (TABLE, f"wavelengths = 3\n{TABLE}", "'wavelengths' must be a list"),
        (TABLE, f"wavelengths = ['1 nm']\n{TABLE}", "no medium depends on it; leave it out"),
        *(("text =", f"azimuth = {a}\ntext =", AZIMUTH.format(a)) for a in (180.1, -1, "nan")),
    ],
)
def test_one_thing_that_is_wrong_is_told_once(old, new, told, tmp_path):
    own = OWN.replace('"R"', '"adm"') if "azimuth" in new else OWN
    (fault,) = refused(tmp_path, own.replace(old, new))
    assert told in fault


def test_each_key_is_of_the_measures_that_it_has_a_meaning_for_and_refused_of_all_others(tmp_path):
    keys = "stokes", "azimuth", "noise", "brighter_than", "sensor", "cells"
    known = {key: {name for name, one in MEASURES.items() if key in one.takes} for key in keys}
    shares = {"R_s", "R_m", "R", "T_s", "T_m", "T", "R+T"}
    without_pixels = shares | {f"scalar-{name}" for name in shares}
    assert known["stokes"] == shares | {"dolp", "aop"}
    assert known["azimuth"] == known["noise"] == known["brighter_than"] == {"adm", "mdm"}
    assert known["sensor"] == set(MEASURES) - without_pixels
    assert known["cells"] == set(MEASURES) - {"model-S3"}  # Of the model alone.
    for key, name in product(known.keys() - {"sensor"}, MEASURES):
        value = "[1.0, 0.0, 0.5, 0.0]" if key == "stokes" else "20"
        text = OWN.replace('"R"', f'"{name}"').replace(TEXT, f"{TEXT}\n{key} = {value}")
        if name in known[key]:
            assert load_experiment(written(tmp_path, text)).measurements
        else:
            told = f"'{key}' is given, but measure '{name}' does not depend on it; leave it out"
            assert refused(tmp_path, text) == (f"measurements[0]: {told}",)


# What is measured again, beside closed forms on flat samples.

GLASS = op.Sample([(1.5, 0)])


def walked(experiment, photons, **more):
    pytest.importorskip("numba")
    pytest.importorskip("xarray")
    return reproduce(experiment, photons, **more)


def amplitudes(m, theta):
    """r_s and r_p, as textbooks have them, of fields whose p keeps its sense."""
    c, g = np.cos(theta), np.sqrt(m**2 - np.sin(theta) ** 2 + 0j)
    return (c - g) / (c + g), (m**2 * c - g) / (m**2 * c + g)


def found(sample, measure, incidence, photons=20_000, **more):
    one = Measurement(measure, "", incidence, **more)
    (again,) = walked(Experiment("own", "", "", sample, (one,), sensor=64), photons)
    assert (again.measurement, again.photons) == (one, photons)
    return again.found


def test_shares_of_a_flat_face_are_those_of_fresnel_for_the_light_that_is_given():
    r_s, r_p = amplitudes(1.5, np.pi / 3)
    value, error, mask, pixel = found(GLASS, "R", "60 deg")
    assert abs(value - (abs(r_s) ** 2 + abs(r_p) ** 2) / 2.0) < 5 * error < 0.02
    assert (mask, pixel) == ("", "")
    for s1, known in ((1.0, r_s), (-1.0, r_p)):
        value, error, *_ = found(GLASS, "R", "60 deg", stokes=(1.0, s1, 0.0, 0.0))
        assert abs(value - abs(known) ** 2) < 5 * error < 0.02
    # Lights from one direction are told apart.
    lights = [(1.0, s1, 0.0, 0.0) for s1 in (1.0, -1.0, 0.0)]
    several = tuple(Measurement("R", "", AT_60, stokes=light) for light in lights)
    both = [one.found for one in walked(Experiment("own", "", "", GLASS, several), 20_000)]
    assert both[0].value > 0.15
    assert both[1].value < 0.05
    assert abs((both[0].value + both[1].value) / 2.0 - both[2].value) < 5 * both[2].error


@rows("angle, known", [(50, 1.785), (56, 2.498), (60, 2.900), (65, 3.167)])
def test_adm_of_a_smooth_stack_is_the_exact_one(angle, known):
    # 1.5 on 2.4, flat: all light goes into one pixel; by the matrices of the two interfaces and
    # the geometric series between them, in per cent.
    sample = op.Sample([(1.5, 0), (2.4, 0)])
    value, error, mask, pixel = found(sample, "adm", f"{angle} deg", 200_000)
    assert abs(100.0 * value - known) < 500.0 * error + 0.001
    assert 100.0 * error < 0.05
    assert "64 x 64 pixels" in mask
    assert abs(int(pixel.split(" ")[0]) - angle) <= 1


def test_what_is_left_out_of_adm_is_told_and_a_mirror_has_its_dolp_and_aop():
    *_, mask, pixel = found(ROUGH, "adm", "60 deg", 50_000, azimuth=10.0, noise=5.0)
    assert "azimuth within 10 deg" in mask
    assert int(pixel.split(" ")[2]) <= 10
    value, error, *_ = found(ROUGH, "adm", "60 deg", 20_000, brighter_than=1e6)
    assert np.isnan([value, error]).all()
    sample, given = op.Sample([(0.2 + 3.4j, 0)]), (1.0, 0.0, 1.0, 0.0)
    light = np.array(amplitudes(0.2 + 3.4j, np.radians(60.0)))
    intensity, s1 = np.sum(abs(light) ** 2), abs(light[0]) ** 2 - abs(light[1]) ** 2
    s2 = 2.0 * np.real(np.conj(light[0]) * light[1])
    dolp, aop = (found(sample, name, "60 deg", stokes=given) for name in ("dolp", "aop"))
    assert dolp.value == pytest.approx(np.hypot(s1, s2) / intensity, rel=1e-12)
    assert aop.value == pytest.approx(np.degrees(np.arctan2(abs(s2), abs(s1))) / 2.0, rel=1e-12)
    assert "where a mirror sends the light" in aop.mask


def test_all_light_is_kept_by_the_cells_and_pixels_of_the_experiment_and_mirrored_by_fresnel():
    for measure in ("R+T", "scalar-R+T"):
        value, error, *_ = found(ROUGH, measure, "60 deg")
        assert abs(value - 1.0) < 5 * error + 1e-12


@pytest.mark.slow
def test_a_coarse_mesh_has_too_little_light_that_is_refracted_twice():
    sample = op.Sample([(1.5, 1.0)])
    coarse, fine = (
        found(sample, "scalar-T_m", "1 rad", 65_536, cells=cells).value for cells in (40, 640)
    )
    assert coarse <= 0.053 < fine


def test_a_seed_gives_the_same_numbers_with_any_number_of_threads():
    several = tuple(Measurement(measure, "", AT_60) for measure in ("adm", "R_m"))
    experiment = Experiment("own", "", "", ROUGH, several, sensor=16)
    one, two = (walked(experiment, 40_000, seed=3, threads=threads) for threads in (1, 2))
    assert [each.found for each in one] == [each.found for each in two]
    assert np.isfinite([each.found.value for each in one]).all()
    # Progress is told of each direction, and too few photons with a cure.
    told = []
    experiment = load_experiment("wang-2017-table-2-alpha-0-1")
    again = walked(experiment, 1000, progress=lambda *counts: told.append(counts))
    assert all(one.agrees for one in again)
    assert told.count((1000, 1000)) >= 3
    with pytest.raises(op.errors.SurfaceError, match=r"measure with more photons$"):
        found(op.Sample([(1.5, 0.3)], cells=400), "adm", "60 deg", 1)

"""Experiments by name and by path, and what is refused in their files."""

import pytest

import optipath as op
from optipath.lab.published.experiment_files import experiment_names, load_experiment
from optipath.lab.published.measured_quantities import MEASURES

OWN = """\
format = 1
description = "glass"
source = "a notebook"
sample = "{sample}"

[[measurements]]
measure = "R"
incidence = ["60 deg", "1 rad"]
text = "a tenth"
published = [0.1, [0.05, 0.1]]
"""


def written(folder, text, **values):
    file = folder / "own.toml"
    file.write_text(text.format(**{"sample": "glass-rough", **values}), "utf-8")
    return file


def refused(folder, text):
    with pytest.raises(op.SurfaceError) as error:
        load_experiment(written(folder, text))
    return error.value.faults


def test_every_published_sample_has_an_experiment():
    samples = [name for name in op.sample_names() if name.startswith("wang-2017-")]
    assert experiment_names() == samples


@pytest.mark.parametrize("name", experiment_names())
def test_an_experiment_is_over_the_sample_of_its_name_and_says_its_source(name):
    found = load_experiment(name)
    assert found.sample == op.load_sample(name)
    assert found.source.startswith("M. Wang et al., Optics Express 25(19), 2017, ")
    assert all(one.text and one.measure in MEASURES for one in found.measurements)


def test_the_published_numbers_of_simulation_1_are_there():
    found = load_experiment("wang-2017-simulation-01").measurements
    known = {one.walks.incidence: one.published for one in found}
    assert known == {
        "50 deg": (0.165, 0.165),
        "56 deg": (0.19, 0.19),
        "60 deg": (0.205, 0.205),
        "65 deg": (0.215, 0.215),
    }


def test_metals_are_looked_at_from_380_to_700_nm():
    walks = load_experiment("wang-2017-simulation-07").measurements[0].walks
    assert walks.wavelengths == tuple(f"{each} nm" for each in range(380, 701, 40))


def test_a_file_of_ones_own_has_a_measurement_for_each_angle(tmp_path):
    found = load_experiment(written(tmp_path, OWN)).measurements
    assert [(one.walks.incidence, one.published) for one in found] == [
        ("60 deg", (0.1, 0.1)),
        ("1 rad", (0.05, 0.1)),
    ]


def test_its_sample_may_be_a_file_beside_it(tmp_path):
    (tmp_path / "pane.toml").write_text(op.Sample([(1.7, 0.2)]).to_toml(), "utf-8")
    found = load_experiment(written(tmp_path, OWN, sample="pane.toml"))
    assert found.sample == op.Sample([(1.7, 0.2)])


def test_a_name_that_is_misspelt_is_told_with_the_one_that_was_meant():
    with pytest.raises(op.SurfaceError, match="did you mean 'wang-2017-table-1'"):
        load_experiment("wang-2017-tabel-1")


def test_all_faults_of_a_file_are_told_at_once(tmp_path):
    text = OWN.replace('"R"', '"adn"').replace("1 rad", "1 nm").replace("[0.05, 0.1]", '"x"')
    faults = refused(tmp_path, text.replace('source = "a notebook"', "photons = 0"))
    assert len(faults) == 5
    told = " ".join(faults)
    for part in (
        "the experiment: 'source' is missing",
        "photons must be a whole number of 1 or more, not 0",
        "measurements[0]: measure 'adn' is unknown; did you mean 'adm'?",
        "measurements[0]: published: 'x' is neither a number nor [LEAST, LARGEST]",
        "1 nm",
    ):
        assert part in told


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("format = 1", "format = 2", "format is 2, but this version reads format 1"),
        ("glass-rough", "../own.toml", "'../own.toml' leads out of the folder of the experiment"),
        ("glass-rough", "nul\\u0000.toml", "cannot be read"),
        ("glass-rough", "glas-rough", "sample: sample 'glas-rough' is unknown"),
        ("{sample}", "gold-rough", "depends on the wavelength"),
        ("[0.1, [", "[0.1, 0.2, [", "3 numbers, but 2 angles of incidence"),
        ("[0.05, 0.1]", "[0.1, 0.05]", "neither a number nor"),
        ("60 deg", "90 deg", "90 deg, along the sample"),
        ("measure =", "mesure =", "key 'mesure' is unknown; did you mean 'measure'?"),
        ('text = "a tenth"', "within = -1", "'within' is -1; write a number from 0"),
        ('text = "a tenth"', "", "'text' is missing"),
        ('text = "a tenth"', "text = 1", "'text' must be a text, not 1"),
        ('text = "a tenth"', "cells = 1", "cells must be a whole number of 2 or more, not 1"),
        ('text = "a tenth"', "stokes = [1, 2, 0, 0]", "polarised by more than 100 %"),
        ("[[measurements]]", "wavelengths = ['1 nm', '2 nm']\n[[measurements]]", "one wavelength"),
    ],
)
def test_what_is_wrong_is_told(old, new, told, tmp_path):
    text = OWN if "{sample}" in old else OWN.replace("{sample}", "glass-rough")
    assert any(told in fault for fault in refused(tmp_path, text.replace(old, new)))


OTHER = OWN.replace("{sample}", "glass-rough")
TEXT = 'text = "a tenth"'
KEYS = ("stokes", "azimuth", "noise", "brighter_than", "sensor", "cells")


@pytest.mark.parametrize("key", ["stokes", "azimuth", "brighter_than", "noise", "cells"])
def test_what_a_measure_does_not_depend_on_is_refused(key, tmp_path):
    value = "[1.0, 0.0, 0.5, 0.0]" if key == "stokes" else "20"
    for name, measure in MEASURES.items():
        text = OTHER.replace('"R"', f'"{name}"').replace(TEXT, f"{TEXT}\n{key} = {value}")
        if key in measure.takes:
            assert load_experiment(written(tmp_path, text)).measurements
        else:
            (fault,) = refused(tmp_path, text)
            assert fault == (
                f"measurements[0]: '{key}' is given, but measure '{name}' does not depend on it; "
                f"leave it out"
            )


def test_each_key_is_of_the_measures_that_it_has_a_meaning_for():
    known = {key: {name for name, one in MEASURES.items() if key in one.takes} for key in KEYS}
    shares = {"R_s", "R_m", "R", "T_s", "T_m", "T", "R+T"}
    without_pixels = shares | {f"scalar-{name}" for name in shares}
    assert known["stokes"] == shares | {"dolp", "aop"}
    assert known["azimuth"] == known["noise"] == known["brighter_than"] == {"adm", "mdm"}
    assert known["sensor"] == set(MEASURES) - without_pixels
    assert known["cells"] == set(MEASURES) - {"model-S3"}  # Of the model alone.


def test_pixels_are_refused_where_none_are_measured(tmp_path):
    text = OTHER.replace("[[measurements]]", "sensor = 64\n[[measurements]]")
    assert refused(tmp_path, text) == (
        "'sensor' is given, but not for 'R', which no pixels see; leave it out",
    )
    more = text + '[[measurements]]\nmeasure = "adm"\nincidence = ["1 rad"]\ntext = "none"\n'
    assert load_experiment(written(tmp_path, more)).sensor == 64


def test_cells_of_a_sample_without_random_fields_are_refused(tmp_path):
    (tmp_path / "pane.toml").write_text(op.Sample([(1.7, 0.0)]).to_toml(), "utf-8")
    text = OWN.replace("{sample}", "pane.toml").replace(TEXT, f"{TEXT}\ncells = 20")
    (fault,) = refused(tmp_path, text)
    assert fault.startswith("measurements[0]: ")
    assert "cells" in fault


def test_a_tolerance_of_nothing_that_is_published_is_refused(tmp_path):
    text = OTHER.replace("published = [0.1, [0.05, 0.1]]", "within = 0.1")
    (fault,) = refused(tmp_path, text)
    assert fault.endswith(
        "'within' is given, but nothing is 'published'; give both, or leave it out"
    )


@pytest.mark.parametrize("azimuth", [500, 180.1, -1, "nan"])
def test_an_azimuth_is_within_180_deg(azimuth, tmp_path):
    text = OTHER.replace('"R"', '"adm"').replace(TEXT, f"{TEXT}\nazimuth = {azimuth}")
    assert refused(tmp_path, text) == (
        f"measurements[0]: 'azimuth' is {azimuth}; write a number from 0 to 180, in degrees",
    )


def test_the_cure_of_a_missing_wavelength_is_one_of_the_file(tmp_path):
    text = OWN.replace("{sample}", "gold-rough")
    (fault,) = refused(tmp_path, text)
    cure = 'wavelengths = ["550 nm"]'
    assert fault.endswith(f"depends on the wavelength; give one above [[measurements]], {cure}")
    cured = text.replace("[[measurements]]", f"{cure}\n[[measurements]]")
    assert load_experiment(written(tmp_path, cured)).measurements[0].walks.wavelengths == (
        "550 nm",
    )


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ('["60 deg", "1 rad"]', '"50 deg"', "measurements[0]: 'incidence' must be a list, not"),
        ('"R"', "3", "measurements[0]: 'measure' must be a text, not 3"),
        ('"glass-rough"', "3", "the experiment: 'sample' must be a text, not 3"),
        (OTHER[OTHER.index("[[") :], "measurements = 3", "'measurements' must be a list, not 3"),
        ("[[measurements]]", "wavelengths = 3\n[[measurements]]", "'wavelengths' must be a list"),
    ],
)
def test_a_key_of_the_wrong_type_is_told_once(old, new, told, tmp_path):
    (fault,) = refused(tmp_path, OTHER.replace(old, new))
    assert told in fault


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ('["60 deg", "1 rad"]\n', "[]\n", "incidence is empty; give one angle or more, such as"),
        ('"1 rad"', "1.0", 'incidence: 1.0 is no text; write one such as "60 deg"'),
        (OTHER[OTHER.index("[[") :], "measurements = []", "measures nothing; add a table [[meas"),
    ],
)
def test_what_measures_nothing_is_refused(old, new, told, tmp_path):
    assert any(told in fault for fault in refused(tmp_path, OTHER.replace(old, new)))

"""optipath surface: tables of energies, models, maps and experiments, and what is refused."""

import json
import re
import sys
from contextlib import contextmanager

import click
import numpy as np
import pytest

import optipath as op
from optipath.cli import main
from optipath.cli.printed_energy import measured
from optipath.cli.reproduce_command import reproduce
from optipath.cli.surface_command import surface
from optipath.engines.automatic import is_installed
from optipath.lab.published import reproduction
from optipath.surfaces.energies.energy_run import EnergyRun
from optipath.surfaces.walk import walk_code
from tables import rows

pytest.importorskip("numba")
pytest.importorskip("xarray")
pytest.importorskip("matplotlib")
BLOCK = 16384
COMPILED = pytest.mark.skipif(not is_installed("numba"), reason="needs the extra fast")
FLAT = "format = 1\n[[layers]]\nindex = 1.5\nalpha = 0\n"
METAL = "format = 1\n[[layers]]\nindex = { n = 0.5, k = 2.1 }\nalpha = 0\n"
COATED = FLAT + "[[layers]]\nindex = 2.4\nalpha = 0.0\n"
ABSORBS = METAL + "[[layers]]\nindex = 1.5\nalpha = 0.1\n"
SILVER = """\
format = 1
[[layers]]
index = { wavelengths = [400.0, 700.0], unit = "nm", n = [0.5, 0.2], k = [2.1, 4.0] }
alpha = 0
"""


@pytest.fixture(autouse=True)
def _files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    texts = {"flat": FLAT, "metal": METAL, "coated": COATED, "absorbs": ABSORBS, "silver": SILVER}
    texts |= {"rough": FLAT.replace("alpha = 0", "alpha = 0.4")}
    texts |= {"finite": texts["rough"].replace("format = 1", "format = 1\nperiodic = false")}
    texts |= {"pane": op.Sample([(1.5, 0)]).to_toml(), "own": OWN}
    for name, text in texts.items():
        (tmp_path / f"{name}.toml").write_text(text, "utf-8")


def told(capsys, *arguments):
    status = main(["surface", *arguments])
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def found(capsys, *arguments):
    status, out, err = told(capsys, *arguments, "--json")
    assert (status, err) == (0, "")
    return json.loads(out)


def refused(capsys, *arguments):
    status, out, err = told(capsys, *arguments)
    assert (status, out) == (2, "")
    assert err.startswith("optipath: ")
    return err.removeprefix("optipath: ").rstrip("\n")


def fresnel(m, theta):
    """The mean reflectance, as textbooks have it."""
    c, g = np.cos(theta), np.sqrt(m**2 - np.sin(theta) ** 2 + 0j)
    r_s, r_p = (c - g) / (c + g), (m**2 * c - g) / (m**2 * c + g)
    return float(abs(r_s) ** 2 + abs(r_p) ** 2) / 2.0


def test_without_a_sample_those_that_there_are_are_listed(capsys):
    status, out, err = told(capsys)
    assert (status, err) == (0, "")
    assert all(name in out for name in op.sample_names())
    assert list(found(capsys)) == op.sample_names()
    assert found(capsys)["glass-rough"] == op.load_sample("glass-rough").description


def test_a_shell_completes_names_of_samples_and_of_experiments():
    def completed(command, word):
        found = command.params[0].shell_complete(click.Context(command), word)
        return [one.value for one in found]

    assert completed(surface, "glass-on") == ["glass-on-glass", "glass-on-gold"]
    assert completed(surface, "repr") == ["reproduce"]
    experiments = ["wang-2017-figure-4", "wang-2017-figures-7-9"]
    assert completed(reproduce, "wang-2017-f") == experiments


@COMPILED
def test_a_flat_face_reflects_by_fresnel(capsys):
    energy = found(capsys, "flat.toml", "--incidence", "60", "--photons", "1e5")
    assert energy["sample"] == "flat.toml"
    assert (energy["incidence"], energy["units"]["incidence"]) == (60.0, "deg")
    assert energy["photons"] == 100_000
    assert isinstance(energy["photons"], int)
    assert abs(energy["R_s"] - fresnel(1.5, np.pi / 3)) < 6 * energy["R_s_se"]
    assert energy["R"] + energy["T"] == pytest.approx(1.0, abs=1e-12)
    assert energy["scalar"]["R_m"] == energy["difference"]["R_m"] == energy["lost"] == 0.0
    assert len(energy["reflected"]) == 16


@COMPILED
def test_a_metal_that_is_flat_reflects_a_known_share(capsys):
    energy = found(capsys, "metal.toml", "--incidence", "60", "--photons", "1000")
    assert energy["R"] == pytest.approx(fresnel(0.5 + 2.1j, np.pi / 3), rel=1e-12)
    assert energy["absorbed"] == pytest.approx(1.0 - energy["R"], rel=1e-12)


@COMPILED
def test_numbers_are_those_of_python(capsys):
    options = ["--photons", "20000", "--seed", "3", "--azimuth", "20", "--stokes", "1,0.6,0,0.3"]
    energy = found(capsys, "coated.toml", "--incidence", "65", *options)
    given = {"azimuth": "20 deg", "seed": 3, "stokes": [1, 0.6, 0, 0.3]}
    other = op.surfaces.energy(op.load_sample("coated.toml"), "65 deg", 20000, **given)
    assert (energy["R_m"], energy["R_m_se"]) == (float(other.R_m), float(other.R_m_se))
    assert energy["scalar"]["reflected"] == other.scalar.reflected.tolist()
    assert energy["difference"]["T_se"] == float(other.difference.T_se)
    assert energy["azimuth"] == pytest.approx(20.0, rel=1e-15)


@COMPILED
def test_the_table_has_a_row_for_each_number_of_events(capsys):
    status, out, err = told(capsys, "coated.toml", "--incidence", "65", "--photons", "20000")
    assert (status, err) == (0, "")
    energy = found(capsys, "coated.toml", "--incidence", "65", "--photons", "20000")
    lines = [line.split() for line in out.splitlines()]
    assert ["1", "event", measured(energy["R_s"], energy["R_s_se"])] in [one[:3] for one in lines]
    sums = {line[0]: line[1:] for line in lines if line and line[0] in {"R", "T_m", "absorbed"}}
    for name, texts in sums.items():
        models = energy, energy["scalar"], energy["difference"]
        assert texts == [measured(each[name], each[f"{name}_se"]) for each in models]
    assert "20,000 photons on one surface, seed 0" in out


@COMPILED
def test_the_last_row_is_of_as_many_events_or_more(capsys, tmp_path):
    # Light goes to and fro between a face and a mirror below it.
    layers = "[[layers]]\nindex = 3.0\nalpha = 0\n[[layers]]\nindex = 1j\nalpha = 0\n"
    (tmp_path / "caught.toml").write_text(f"format = 1\n{layers}".replace("1j", '"1j"'), "utf-8")
    _, out, _ = told(capsys, "caught.toml", "--incidence", "80", "--photons", "10000")
    rows = [line for line in out.splitlines() if " or more events" in line]
    assert rows
    assert all(row.split()[0] == "16" for row in rows)


@COMPILED
def test_each_angle_of_incidence_has_a_table(capsys):
    given = ["--incidence", "0:60:3", "--incidence", "1 rad", "--photons", "1000"]
    _, out, _ = told(capsys, "flat.toml", *given)
    assert re.findall(r"^incidence (.*)$", out, re.M) == ["0 deg", "30 deg", "60 deg", "1 rad"]
    energies = found(capsys, "flat.toml", *given)["directions"]
    assert [each["incidence"] for each in energies] == [0.0, 30.0, 60.0, 1.0]
    assert energies[3]["units"]["incidence"] == "rad"


@COMPILED
def test_wavelengths_ride_on_the_same_photons_and_have_a_table_each(capsys):
    given = ["--incidence", "40", "--wavelength", "400 nm:700 nm:2", "--photons", "1000"]
    energy = found(capsys, "silver.toml", *given)
    known = [fresnel(m, np.radians(40.0)) for m in (0.5 + 2.1j, 0.2 + 4.0j)]
    assert energy["R"] == pytest.approx(known, rel=1e-12)
    assert (energy["wavelength"], energy["units"]["wavelength"]) == ([400.0, 700.0], "nm")
    _, out, _ = told(capsys, "silver.toml", *given)
    assert re.findall(r"^wavelength (.*)$", out, re.M) == ["400 nm", "700 nm"]
    one = found(capsys, "silver.toml", *given[:3], "700 nm", *given[4:])
    assert one["R"] == energy["R"][1]


@COMPILED
def test_a_tolerance_is_reached_or_its_absence_told_in_a_line(capsys):
    energy = found(capsys, "flat.toml", "--incidence", "60", "--tolerance", "0.002")
    assert energy["R_se"] <= energy["tolerance"] == 0.002
    few = ["--incidence", "60", "--tolerance", "0.002", "--photons", "1000"]
    status, out, err = told(capsys, "flat.toml", *few)
    assert (status, err.count("\n")) == (0, 1)
    assert "more than the tolerance of 0.002; allow more --photons\n" in err
    assert "1,000 photons" in out


@COMPILED
def test_a_coarse_mesh_is_told_in_a_line_whose_cure_works(capsys):
    given = ["rough.toml", "--incidence", "60", "--photons", "1000", "--surfaces", "2"]
    status, _, err = told(capsys, *given, "--cells", "100")
    assert (status, err.count("\n")) == (0, 1)
    cure = re.search(r"--cells (\S+) are enough", err)[1]
    status, _, err = told(capsys, *given, "--cells", cure)
    assert (status, err) == (0, "")


@COMPILED
def test_lost_photons_are_told(capsys):
    given = ["--incidence", "60", "--photons", "1000", "--surfaces", "1", "--most-events", "1"]
    _, out, _ = told(capsys, "finite.toml", *given)
    assert re.search(r"; \d+ lost beside the field; \d+ lost after 1 event ", " ".join(out.split()))


def interrupting(monkeypatch, photons):
    """Let Ctrl-C come when so many photons have been walked."""

    @contextmanager
    def bar(_):
        def tell(done, _):
            if done >= photons:
                raise KeyboardInterrupt

        yield tell

    monkeypatch.setattr("optipath.cli.photon_bar.photon_bar", bar)


@COMPILED
def test_an_interrupt_tells_what_is_done(capsys, monkeypatch):
    interrupting(monkeypatch, 2 * BLOCK)
    given = ["flat.toml", "--incidence", "60"]
    status, out, err = told(capsys, *given)
    assert (status, err) == (130, "optipath: interrupted\n")
    assert "32,768 photons on one surface" in out
    assert "; interrupted, 1,000,000 were wanted" in out
    status, out, err = told(capsys, *given, "--json")
    assert (status, err) == (130, "optipath: interrupted\n")
    energy = json.loads(out)
    assert (energy["interrupted"], energy["photons"]) == (True, 2 * BLOCK)
    monkeypatch.undo()
    whole = op.surfaces.energy(op.Sample([(1.5, 0)]), "60 deg", photons=2 * BLOCK)
    assert energy["R"] == float(whole.R)


@COMPILED
def test_an_interrupt_before_all_keeps_the_directions_that_are_done(capsys, monkeypatch):
    walk = EnergyRun.walk

    def first_alone(self, *given):
        if self.beam.cos < 0.9:
            raise KeyboardInterrupt
        walk(self, *given)

    monkeypatch.setattr(EnergyRun, "walk", first_alone)
    given = ["flat.toml", "--incidence", "10,50,70", "--photons", "1000"]
    status, out, err = told(capsys, *given)
    assert (status, err) == (130, "optipath: interrupted\n")
    assert re.findall(r"^incidence (.*)$", out, re.M) == ["10 deg"]
    status, out, _ = told(capsys, *given, "--json")
    assert status == 130
    assert [each["incidence"] for each in json.loads(out)["directions"]] == [10.0]


@rows(
    "line, wrong",
    [
        ("glass-roug", "sample 'glass-roug' is unknown; did you mean 'glass-rough'?"),
        ("none.toml", "'none.toml' cannot be read: No such file or directory"),
        ("flat.txt", "see the names with `optipath surface`"),
        ("flat.toml", "--incidence is missing; give the angle of incidence: --incidence 60"),
        ("--incidence 60", "SAMPLE is missing, beside --incidence; give a file or one of: "),
        ("absorbs.toml --incidence 60", "absorbs.toml"),
        ("silver.toml --incidence 60", "give one, --wavelength '550 nm'"),
    ],
)
def test_a_wrong_sample_is_told(line, wrong, capsys):
    assert wrong in refused(capsys, *line.split())


@rows(
    "given, wrong",
    [
        ("--incidence 90", "incidence is 90 deg, along the sample"),
        ("--incidence -5", "incidence is -5 deg; give a real angle of incidence within 0 deg"),
        ("--incidence sixty", "give an angle such as '45 deg'"),
        ("--incidence 60nm", "is no angle"),
        ("--incidence nan", "not finite"),
        ("--incidence 0:80:1001", "--incidence gives 1,001 values, of which each has tables"),
        ("--wavelength 400nm:700nm:1001", "--wavelength gives 1,001 values"),
        ("--photons 0", "photons must be a whole number of 1 or more, not 0"),
        ("--photons 1e30", "photons is 1000000000000000019884624838656; give 1,000,000,000,000"),
        ("--photons 1e999", "'1e999' is no whole number; write one such as 1000, or 1e6"),
        ("--photons 1.5", "'1.5' is no whole number"),
        ("--photons many", "'many' is no whole number"),
        ("--threads 5000", "threads is 5000; give 1,024 at most"),
        ("--tolerance 0", "tolerance is 0.0; give a standard error within 0 .. 1"),
        ("--tolerance nan", "tolerance is nan; give a standard error within 0 .. 1"),
        ("--tolerance small", "'small' is not a valid float"),
        ("--seed -1", "seed must be a whole number of 0 or more, not -1"),
        ("--most-events 0", "most_events must be a whole number of 1 or more, not 0"),
        ("--azimuth 10,20,30", "--azimuth takes one angle, and '10,20,30' is several; give one"),
        ("--stokes 1,0,0", "--stokes takes 4 numbers with commas between, such as 1,0,0,0"),
        ("--stokes 0,0,0,0", "stokes has no intensity; give S0 > 0"),
        ("--stokes 1,2,0,0", "polarised by more than 100 %; give S1^2 + S2^2 + S3^2 <= S0^2"),
        ("--cells 1", "the sample: cells must be a whole number of 2 or more"),
        ("--cells 10,20,30", "--cells takes 1 or 2 numbers with commas between, such as 640"),
        ("--surfaces 0", "the sample: surfaces must be a whole number of 1 or more, not 0"),
        ("--sample-seed -3", "the sample: seed must be a whole number of 0 or more, not -3"),
        ("--wavelength 500", "'500' has no unit"),
        ("--wavelength 500nm", "wavelength is given, but no medium depends on it; leave it out"),
        ("--azimut 3", "option '--azimut' is unknown; did you mean '--azimuth'?"),
        ("60", "'60' belongs to no option"),
    ],
)
def test_a_wrong_value_is_told(given, wrong, capsys):
    angle = [] if "--incidence" in given else ["--incidence", "60"]
    assert wrong in refused(capsys, "rough.toml", *angle, *given.split())


def test_all_faults_are_told_at_once(capsys):
    given = "--incidence 95 --photons 0 --tolerance 2 --stokes 1 --surfaces 0 --azimuth x"
    lines = refused(capsys, "rough.toml", *given.split()).splitlines()
    assert lines[0] == "6 faults:"
    assert len(lines) == 7


@COMPILED
def test_a_mesh_larger_than_memory_is_refused(capsys):
    given = ["rough.toml", "--incidence", "60", "--cells", "10000000"]
    assert "a mesh of 1e+14 cells" in refused(capsys, *given)


@COMPILED
def test_forbidden_compilation_and_a_missing_extra_are_told(capsys, monkeypatch):
    walk_code.walk_code.cache_clear()
    with monkeypatch.context() as patch:
        patch.setenv("NUMBA_DISABLE_JIT", "1")
        wrong = refused(capsys, "flat.toml", "--incidence", "60")
    assert wrong.startswith("NUMBA_DISABLE_JIT is set")
    walk_code.walk_code.cache_clear()
    monkeypatch.setitem(sys.modules, "numba", None)
    wrong = refused(capsys, "flat.toml", "--incidence", "60")
    assert wrong.endswith('need numba, which is not installed; pip install "optipath[fast]"')


def decided(capsys, *arguments):
    status = main(["surface", *arguments, "--decide"])
    captured = capsys.readouterr()
    return status, captured.out, captured.err


@pytest.mark.slow
def test_the_model_is_told_with_its_evidence(capsys):
    given = ["glass-on-glass", "--incidence", "60", "--photons", "5e4"]
    status, out, _ = decided(capsys, *given)
    assert status == 0
    assert "the polarised model is needed for a tolerance of 2 %" in out
    assert "50,000 photons, 64 x 64 pixels" in out


def test_json_has_one_object_for_each_angle(capsys):
    given = ["glass-on-glass", "--incidence", "50, 60", "--photons", "5e3", "--tolerance", "0.9"]
    status, out, _ = decided(capsys, *given, "--json")
    found = json.loads(out)["directions"]
    assert (status, [each["incidence"] for each in found]) == (0, [50.0, 60.0])
    assert {each["tolerance"] for each in found} == {0.9}
    status, out, _ = decided(capsys, *given)
    assert status == 0
    assert "5,000 photons, " in out


def test_a_polarised_source_and_that_no_pixel_counts_are_told_in_a_sentence(capsys):
    status, _, err = decided(capsys, "glass-rough", "--incidence", "30", "--stokes", "1,1,0,0")
    assert (status, err) == (2, "optipath: --decide is of unpolarised light; leave --stokes out\n")
    status, _, err = decided(capsys, "glass-rough", "--incidence", "0", "--photons", "1")
    assert status == 2
    assert err.splitlines()[-1].startswith("optipath: no pixel counts: of 1 photon none is ref")


def test_light_may_be_looked_at_below(capsys):
    given = ["glass-rough", "--incidence", "30", "--photons", "2e3", "--tolerance", "0.5"]
    status, out, _ = decided(capsys, *given, "--side", "transmitted")
    assert status == 0
    assert "polarisation changes all transmitted light" in out


FEW = ["--photons", "2000", "--incidence", "50"]


@COMPILED
def test_a_map_is_drawn_into_a_file(capsys, tmp_path):
    drawn = ["surface", "flat.toml", *FEW, "--map", "S0", "--side", "transmitted"]
    assert main([*drawn, "--out", "map.svg"]) == 0
    assert capsys.readouterr().out == "wrote map.svg\n"
    assert ">S0, transmitted, incidence 50°</text>" in (tmp_path / "map.svg").read_text("utf-8")


@COMPILED
def test_a_map_is_of_the_light_and_the_wavelength_that_are_given(tmp_path):
    light = ["--stokes", "1,0,1,0", "--wavelength", "500 nm"]
    drawn = ["surface", "silver.toml", *FEW, *light, "--map", "S3"]
    assert main([*drawn, "--out", "map.svg"]) == 0
    written = (tmp_path / "map.svg").read_text("utf-8")
    assert "S3, reflected, incidence 50°, 500 nm" in written
    assert "source (1, 0, 1, 0)" in written


@rows(
    "sample, options, sentence",
    [
        ("flat", "--map S0", "--map draws into a file; name it, --out map.png"),
        ("flat", "--out map.png", "--out is of a map; say of what, --map S0"),
        ("flat", "--map S0 --out a.jpg", "cannot be drawn; use one of: .png, .svg"),
        ("flat", "--map DoL --out a.png", "'DoL' is unknown; did you mean 'DoLP'"),
        ("flat", "--map S0 --out a.png --json", "--json is of tables"),
        ("flat", "--map S0 --out a.png --incidence 20", "give --incidence once"),
        ("flat", "--map ADM --out a.png --stokes 1,1,0,0", "leave --stokes out"),
        (
            "silver",
            "--map S0 --out a.png --wavelength 500nm --side transmitted",
            "nothing goes through an opaque sample; leave --side out",
        ),
        (
            "silver",
            "--map S0 --out a.png --wavelength 500nm:600nm:2",
            "a map of S0 is of one wavelength",
        ),
        ("flat", "--map S0 --out nowhere/a.png", "cannot be written: there is no such folder"),
    ],
)
def test_what_goes_with_no_map_is_refused_before_photons_are_walked(
    sample, options, sentence, capsys, tmp_path
):
    assert main(["surface", f"{sample}.toml", *FEW, *options.split()]) == 2
    told = capsys.readouterr()
    assert told.out == ""
    assert sentence in told.err
    assert not [*tmp_path.glob("*.png")]


MIRROR = "wang-2017-table-2-alpha-0-1"
OWN = """\
format = 1
description = "a pane"
source = "a notebook"
sample = "pane.toml"

[[measurements]]
measure = "R"
incidence = ["0 deg", "56.31 deg"]
text = "four per cent"
published = [0.04, [0.2, 0.3]]

[[measurements]]
measure = "T"
incidence = ["0 deg"]
text = "the rest"
"""


def reproduced(capsys, *arguments):
    status = main(["surface", "reproduce", *arguments])
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def test_a_list_has_all_experiments_and_what_they_are(capsys):
    status, out, err = reproduced(capsys, "--list", "--json")
    assert (status, err) == (0, "")
    names = [name for name in op.sample_names() if name.startswith("wang-2017-")]
    assert [*json.loads(out)] == names
    assert json.loads(out)["wang-2017-simulation-01"] == "1.5 on 2.4, alpha 0.1 each"
    assert MIRROR in reproduced(capsys, "--list")[1]


@COMPILED
def test_what_is_published_stands_beside_what_is_computed(capsys):
    status, out, err = reproduced(capsys, "own.toml", "--photons", "1e5")
    assert (status, err) == (0, "")
    assert out.startswith("own.toml: a pane\na notebook; 100,000 photons a direction\n")
    assert '"four per cent"' in out
    rows = [line.split() for line in out.splitlines()]
    assert ["measured", "incidence", "published", "computed", "agrees"] in rows
    (first,) = (row for row in rows if row[:4] == ["R", "0", "deg", "0.04"])
    assert re.fullmatch(r"0\.0\d+\(\d+\)", first[4])
    assert first[5] == "yes"
    (second,) = (row for row in rows if row[:3] == ["R", "56.31", "deg"])
    assert (second[3:6], second[7]) == (["0.2", "to", "0.3"], "no")
    assert "R: share reflected" in out


@COMPILED
def test_json_has_all_of_it_with_all_digits(capsys):
    status, out, err = reproduced(capsys, "own.toml", "--photons", "1e5", "--json")
    assert (status, err) == (0, "")
    found = json.loads(out)
    assert found["interrupted"] is False
    (experiment,) = found["experiments"]
    assert (experiment["experiment"], experiment["source"]) == ("own.toml", "a notebook")
    known = [(one["measure"], one["incidence"]) for one in experiment["measurements"]]
    assert known == [("R", "0 deg"), ("T", "0 deg"), ("R", "56.31 deg")]
    first, rest, _ = experiment["measurements"]
    assert first["value"] + rest["value"] == pytest.approx(1.0, abs=1e-12)
    assert first["published"] == [0.04, 0.04]
    assert abs(first["value"] - 0.04) < 6.0 * first["standard_error"]
    assert (first["agrees"], first["photons"], first["text"]) == (True, 100_000, "four per cent")


@COMPILED
def test_several_may_be_named(capsys):
    given = [MIRROR, "own.toml", "--photons", "2000", "--threads", "1", "--seed", "2"]
    status, out, _ = reproduced(capsys, *given)
    assert status == 0
    assert out.index(MIRROR) < out.index("own.toml: a pane")
    assert out.count(" yes") >= 3


@COMPILED
def test_an_interrupt_keeps_what_is_done(capsys, monkeypatch):
    share = reproduction.MEASURES["R"]

    def one_alone(walked, measurement):
        if walked.walks.incidence != "0 deg":
            raise KeyboardInterrupt
        return share.of(walked, measurement)

    monkeypatch.setitem(reproduction.MEASURES, "R", share._replace(of=one_alone))
    status, out, err = reproduced(capsys, "own.toml", "--photons", "1000")
    assert (status, err) == (130, "optipath: interrupted\n")
    assert "four per cent" in out
    status, out, _ = reproduced(capsys, "own.toml", "--photons", "1000", "--json")
    found = json.loads(out)
    assert (status, found["interrupted"]) == (130, True)
    assert {one["incidence"] for one in found["experiments"][0]["measurements"]} == {"0 deg"}


@rows(
    "given, wrong",
    [
        (["wang-2017-tabel-1"], "did you mean 'wang-2017-table-1'?"),
        (["none.toml"], "'none.toml' cannot be read: No such file or directory"),
        (["Own"], "see the names with `optipath surface reproduce --list`"),
        (["pane.toml"], "the experiment: 'source' is missing"),
        (["own.toml", "--photons", "0"], "photons must be a whole number of 1 or more, not 0"),
        (["own.toml", "--photons", "0", "--json"], "photons must be a whole number of 1 or more"),
        (["own.toml", "--photons", "x"], "'x' is no whole number"),
        (["own.toml", "--incidence", "3"], "option '--incidence' is unknown"),
    ],
)
def test_what_is_wrong_is_told(given, wrong, capsys):
    status, out, err = reproduced(capsys, *given)
    assert (status, out) == (2, "")
    assert wrong in err


def test_the_word_comes_first_and_has_a_help_of_its_own(capsys):
    assert main(["surface", "--json", "reproduce"]) == 2
    assert "write optipath surface reproduce first" in capsys.readouterr().err
    assert reproduced(capsys, "--help")[1].startswith(
        "Usage: optipath surface reproduce [OPTIONS] [NAME]..."
    )
    assert main(["surface", "--help"]) == 0
    assert "optipath surface reproduce [NAME]..." in capsys.readouterr().out

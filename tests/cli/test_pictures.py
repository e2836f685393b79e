"""optipath plot and chart: pictures of presets, their light, and their errors."""

import json
import sys
import warnings
from itertools import product
from pathlib import Path
from unittest.mock import Mock

import numpy as np
import pytest

import optipath as op
from optipath.cli.plot_command import KINDS, drawn, request_of
from optipath.cli.preset_command import Chosen
from optipath.lab import chart
from optipath.lab import chart as critical_chart
from optipath.values.text import AxisValues
from pictures import faults_of, texts_of
from tables import slow

pytest.importorskip("matplotlib")


def pictures_of(preset):
    """Each kind with what it needs."""
    x = next(iter(op.load_preset(preset).compose().inputs.open))  # Its values are numbers.
    yield from ((kind, {}) for kind in KINDS if 0 in KINDS[kind].counts)
    yield "curve", {"x": (x,), "y": "S0,AoP"}


def request(preset, kind, case=None, *, x=(), y=None, reads=None, along=None, **values):
    about = Chosen(preset, op.load_preset(preset), case, values, along or {})
    given = {"x": x, "y": y, "detector": None, "reads": reads}
    return request_of(about, kind, **given)


def picture(*given, **values):
    return drawn(request(*given, **values))


def leaves_a_plane(preset, case):
    """Whether one plane of incidence is turned against another."""
    parameters = op.load_preset(preset, case=case).parameters
    turns = [parameters[name].default for name in ("rho", "turn") if name in parameters]
    return any(abs(np.sin(turn)) > 1e-9 for turn in turns)


EVERY = [(name, (None, *op.load_preset(name).cases)) for name in op.preset_names()]


@pytest.mark.parametrize(
    ("preset", "cases"),
    [("npgr026", ["8"]), *(pytest.param(*one, marks=pytest.mark.report) for one in EVERY)],
)
def test_every_picture_of_a_preset_is_whole_and_readable(preset, cases):
    for case, (kind, given) in product(cases, pictures_of(preset)):
        if kind == "bench" and leaves_a_plane(preset, case):
            with pytest.raises(op.OptipathError, match="geometry"):
                picture(preset, kind, case, **given)
            continue
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            figure = picture(preset, kind, case, **given)
            assert faults_of(figure) == []
        assert preset in figure.get_suptitle()
        labels = {axis.get_label_text() for ax in figure.axes for axis in (ax.xaxis, ax.yaxis)}
        assert labels - {""} or kind in {"geometry", "bench", "energy", "poincare"}


DRAWN = [
    "--kind stokes --filter none --place eye",
    "--kind curve --delta 0:90:10",
    "--kind curve --delta 0:90:5 --x phi --y dop",
    "--kind ellipse --case 8",
    "--kind curve --x delta --y s0,dolp --rho 10",
    "--kind poincare --delta 20:40:5",
    "--kind mueller --detector E",
    "--kind geometry --n1 1.5",
]


@pytest.mark.parametrize("lines", [DRAWN[:2], pytest.param(DRAWN[2:], marks=pytest.mark.report)])
def test_a_picture_is_drawn_into_a_file(lines, told):
    for line in lines:
        assert told(f"plot npgr026 {line} --out a.svg") == "wrote a.svg\n"


def test_a_title_says_preset_case_and_changes_and_breaks_between_values_if_it_is_long(tmp_path):
    def title(*given, **values):
        figure = picture(*given, **values)
        assert faults_of(figure) == []
        return figure.get_suptitle()

    told = title("npgr026", "stokes", "8", delta=0.5235987755982988, filter="none")
    assert told == "npgr026, case 8, delta 30 deg, filter none"
    many = ("delta", "rho", "phi", "filter", "n2", "k2")
    assert "\n" in title("npgr026", "stokes", "8", **dict.fromkeys((*many[:3], "n1", "k1"), 0.5))
    values = {"intensity": 123456789.123456, "n1": 0.123456789012345}
    for kind in ("stokes", "mueller"):
        lines = title("npgr026", kind, **values, **dict.fromkeys(many, 0.5812345678901)).split("\n")
        assert len(lines) > 3
        assert all(line.endswith(",") for line in lines[:-1])
    file = tmp_path / ("w" * 150 + ".toml")
    file.write_text(op.load_preset("malus").to_toml(), "utf-8")
    # Where a line breaks at a space, the space is not drawn.
    assert "".join(str(file).split()) in "".join(title(str(file), "stokes", angle=0.5).split())


def test_axes_keep_their_unit_sources_their_matrix_and_cases_what_was_published():
    values = AxisValues(np.array([1.7, 2.0]), "eV", np.array([729e-9, 620e-9]))
    figure = picture("quartz-quarter-wave", "curve", y="S3", along={"wavelength": values})
    assert figure.axes[0].get_xlabel().endswith("(eV)")
    assert figure.axes[0].lines[0].get_xdata() == pytest.approx([1.7, 2.0])
    words = [text.get_text() for text in texts_of(picture("sky-and-window", "mueller"))]
    for source in ("heaven to camera", "lamp to camera"):
        assert sum(text.startswith(source) for text in words) == 1
    path, case = op.load_preset("npgr026"), op.load_preset("npgr026", case="8")
    assert request("npgr026", "stokes", "8").published == path.cases["8"].published
    for of, given in ((None, {}), ("8", {"delta": 0.5}), ("8", {"reads": "intensity"})):
        assert request("npgr026", "stokes", of, **given).published == {}
    asked = request("npgr026", "curve", "8", x=("delta",)).path
    assert asked.trace().stokes.tolist() == pytest.approx(case.trace().stokes.tolist())
    assert float(asked.parameters["delta"].default) == float(case.parameters["delta"].default)


@pytest.mark.parametrize(
    ("fits", "alone"),
    [("stokes", "curve"), *map(slow, (("ellipse", "poincare"), ("mueller", "curve")))],
)
def test_all_detectors_are_drawn_where_they_fit_beside_one_another(
    fits, alone, tmp_path, told, refused
):
    path, theta = op.PathGraph(), op.Parameter("theta", 0.9)
    path.add("lamp", op.Source()) >> path.add("glass", op.Interface(1.5, theta))
    for port in ("reflected", "transmitted"):
        path[f"glass.{port}"] >> path.add(f"eye-{port}", op.Detector())
    (tmp_path / "two.toml").write_text(path.to_toml(), "utf-8")
    told(f"plot two.toml --kind {fits} --out a.svg")
    texts = (tmp_path / "a.svg").read_text("utf-8")
    assert "eye-reflected" in texts
    assert "eye-transmitted" in texts
    several = "the detectors eye-reflected and eye-transmitted; add --detector eye-reflected"
    asked = f"plot two.toml --kind {alone} --x theta --out a.svg"
    assert several in refused(asked)
    told(f"{asked} --detector eye-reflected")
    # More than there are colours are refused with the option that names one.
    path, last = op.PathGraph(), "lamp.out"
    path.add("lamp", op.Source())
    for number in range(7):
        path[last] >> path.add(f"split{number}", op.BeamSplitter())
        path[f"split{number}.reflected"] >> path.add(f"eye{number}", op.Detector())
        last = f"split{number}.transmitted"
    (tmp_path / "many.toml").write_text(path.to_toml(), "utf-8")
    asked = "plot many.toml --kind stokes --out a.svg"
    assert "add --detector eye0" in refused(asked)
    told(f"{asked} --detector eye0")


@pytest.mark.parametrize(
    ("kinds", "others"), [(["energy"], ["stokes"]), slow((["ellipse", "mueller"], [*KINDS]))]
)
def test_several_values_in_a_file_are_refused_and_any_letters_drawn(
    kinds, others, tmp_path, told, refused
):
    path = op.Source(op.Parameter("power", np.array([1.0, 2.0]))) >> op.Detector()
    (tmp_path / "x.toml").write_text(path.to_toml(), "utf-8")
    several = "parameter 'power' has several values in the file; give one"
    for kind in kinds:
        asked = f"plot x.toml --kind {kind} --out a.svg"
        assert several in refused(asked)
        told(f"{asked} --power 2")
    path = op.PathGraph()
    lamp = path.add("\u706f", op.Source())
    sheet = path.add("\u504f", op.Polarizer(op.Parameter("a", 0.3)))
    lamp >> sheet >> path.add("\u5149", op.Detector())
    (tmp_path / "x.toml").write_text(path.to_toml(), "utf-8")
    for kind in others:
        x = "--x a" if kind == "curve" else ""
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            told(f"plot x.toml --kind {kind} {x} --out a.svg")


def test_all_that_is_wrong_and_a_missing_extra_are_told(refused, monkeypatch):
    faults = refused("plot npgr026 --delta north", lines=4)
    missing = "--out is missing, and a picture is drawn into a file; add --out plot.png"
    for part in ("3 faults:", "--kind is missing", missing):
        assert part in faults
    monkeypatch.delattr("optipath.plots.save", raising=False)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    missing = refused("plot npgr026 --kind ellipse --out a.png")
    assert 'pip install "optipath[plot]"' in missing


QUICK = "chart malus --engine numpy --quick"


def read(name):
    return json.loads(Path(name).read_text("utf-8"))


def test_how_long_it_takes_is_told_and_errors_near_a_place_are_drawn_again(run, monkeypatch):
    status, _, err = run(f"{QUICK} --data a.json")
    assert status == 0
    first, *lines = err.splitlines()
    assert first.startswith("this takes less than a minute")
    shares = [int(line.split(" %")[0]) for line in lines]
    assert shares[0] == 0
    assert shares == sorted(set(shares))
    assert read("a.json")["effort"]["samples"] == 3
    assert Path("chart.png").exists()
    monkeypatch.setattr(critical_chart, "DISTANCES", (1e-3, 1e-1))
    assert run("chart --interface --near all --data a.json --out a.svg")[0] == 0
    places = [place["name"] for place in read("a.json")["places"]]
    assert places == ["brewster", "critical", "grazing", "normal"]
    assert run("chart --from a.json --out b.svg")[0] == 0
    a, b = (Path(name).read_text("utf-8") for name in ("a.svg", "b.svg"))
    assert a.count("<path") == b.count("<path")


@pytest.mark.slow
def test_a_chart_has_what_is_given_in_its_title(run, monkeypatch):
    monkeypatch.setattr(critical_chart, "DISTANCES", (1e-3, 1e-1))
    monkeypatch.setattr(chart, "REGIONS", chart.REGIONS[:1])
    given = "--case 8 --delta 30 --filter none --near normal --data a.json"
    assert run(f"chart npgr026 {given}")[0] == 0
    assert read("a.json")["title"] == "npgr026, case 8, delta 30 deg, filter none"
    assert run(f"{QUICK} --angle 30 --data b.json")[0] == 0
    assert read("b.json")["title"] == "malus, angle 30 deg"


def test_what_is_measured_is_kept_drawn_and_told_where_ctrl_c_ends_it(run, monkeypatch):
    found, errors = [], chart.path_errors

    def interrupted(*arguments):
        found.append(arguments)
        if len(found) > 40:
            raise KeyboardInterrupt
        return errors(*arguments)

    monkeypatch.setattr(chart, "REGIONS", chart.REGIONS[:3])
    monkeypatch.setattr(chart, "path_errors", interrupted)
    with monkeypatch.context() as patch:
        patch.setattr(chart, "many_paths", Mock(side_effect=KeyboardInterrupt))
        assert run(f"{QUICK} --data a.json")[0] == 130
        assert list(Path().iterdir()) == []  # Nothing was measured yet.
    given = "chart npgr026 --case 8 --engine numpy --quick --data a.json --out a.svg"
    status, out, err = run(given)
    assert status == 130
    assert "interrupted: 1 of 4 steps are measured, and are kept" in out
    assert "wrote a.json\nwrote a.svg" in out
    assert err.endswith("optipath: interrupted\n")
    assert read("a.json")["regions"] == {"measured": 1, "of": 4}
    assert "interrupted: 1 of 4 regions" in Path("a.svg").read_text("utf-8")
    assert run("chart --from a.json --out b.svg")[0] == 0

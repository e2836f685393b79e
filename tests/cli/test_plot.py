"""``optipath plot``: pictures of presets and their light."""

import os
import re
import subprocess
import sys
import warnings

import pytest
from click.testing import CliRunner

import optipath as op
from optipath.cli import main
from optipath.cli.chosen import Chosen
from optipath.cli.command import cli
from optipath.cli.plot_kinds import KINDS, drawn
from optipath.cli.plot_request import request_of
from pictures import faults_of, texts_of

pytest.importorskip("matplotlib")

WHOLE = "OPTIPATH_PICTURES" in os.environ
"""Whether all cases are drawn as well, which takes minutes."""


@pytest.fixture(autouse=True)
def _folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def chosen(preset, case=None, **values):
    return Chosen(preset, op.load_preset(preset), case, values)


def picture(preset, kind, case=None, *, x=(), y=None, detector=None, reads=None, **values):
    about = chosen(preset, case, **values)
    given = {"x": x, "y": y, "detector": detector, "reads": reads}
    return drawn(request_of(about, kind, KINDS[kind], **given))


def words(figure):
    return [text.get_text() for text in texts_of(figure)]


def open_parameter(path):
    """A parameter whose values are numbers."""
    return next(iter(path.compose().inputs.open))


def pictures_of(preset):
    """Each kind with what it needs."""
    x = open_parameter(op.load_preset(preset))
    yield from ((kind, {}) for kind in KINDS if KINDS[kind].least_axes == 0)
    yield "curve", {"x": (x,), "y": "S0,AoP"}


EVERY = [(preset, None) for preset in op.preset_names()]
EVERY += [(preset, case) for preset, _ in EVERY for case in op.load_preset(preset).cases if WHOLE]


@pytest.mark.parametrize(("preset", "case"), EVERY)
def test_every_picture_of_a_preset_is_whole_and_readable(preset, case):
    for kind, given in pictures_of(preset):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            try:
                figure = picture(preset, kind, case, **given)
            except op.OptipathError as error:
                assert kind == "bench", (kind, error.faults)
                assert "geometry" in str(error)
                continue
            assert faults_of(figure) == [], kind
        assert preset in figure.get_suptitle()
        for ax in figure.axes:
            if ax.axison and ax.name != "3d":
                assert ax.get_xlabel() or ax.get_ylabel() or not ax.get_xticks().size, kind


@pytest.mark.parametrize(
    "arguments",
    [
        ["--kind", "ellipse", "--case", "8"],
        ["--kind", "poincare", "--x", "delta"],
        ["--kind", "poincare", "--delta", "20:40:5"],
        ["--kind", "curve", "--x", "delta", "--y", "s0,dolp", "--rho", "10"],
        ["--kind", "curve", "--delta", "0:90:10"],
        ["--kind", "curve", "--delta", "0:90:5", "--x", "phi", "--y", "dop"],
        ["--kind", "stokes", "--filter", "none", "--place", "eye"],
        ["--kind", "mueller", "--detector", "E"],
        ["--kind", "geometry", "--n1", "1.5"],
    ],
)
@pytest.mark.parametrize("ending", ["svg"])
def test_a_picture_is_drawn_into_a_file(arguments, ending, capsys):
    assert main(["plot", "npgr026", *arguments, "--out", f"a.{ending}"]) == 0
    told = capsys.readouterr()
    assert told.out == f"wrote a.{ending}\n"
    assert told.err == ""


def test_the_title_says_preset_case_and_what_was_changed():
    figure = picture("npgr026", "stokes", "8", delta=0.5235987755982988, filter="none")
    assert figure.get_suptitle() == "npgr026, case 8, delta 30 deg, filter none"


def test_a_long_title_goes_on_in_the_next_line():
    path = op.load_preset("npgr026")
    many = dict.fromkeys(("delta", "rho", "phi", "n1", "k1", "n2", "k2"), 0.5)
    figure = picture("npgr026", "stokes", "8", **many)
    assert "\n" in figure.get_suptitle()
    assert faults_of(figure) == []
    assert path.parameters.keys() >= many.keys()


def test_published_values_stand_beside_those_of_an_unchanged_case_alone():
    def told(case, reads=None, **values):
        given = {"x": (), "y": None, "detector": None, "reads": reads}
        about = chosen("npgr026", case, **values)
        return request_of(about, "stokes", KINDS["stokes"], **given).published

    assert told("8") == op.load_preset("npgr026").cases["8"].published
    assert told(None) == {}
    assert told("8", delta=0.5) == {}
    assert told("8", reads="intensity") == {}


def test_the_line_by_default_is_that_of_the_case():
    given = {"x": ("delta",), "y": None, "detector": None, "reads": None}
    asked = request_of(chosen("npgr026", "8"), "curve", KINDS["curve"], **given)
    case = op.load_preset("npgr026", case="8")
    assert asked.path.trace().stokes.tolist() == pytest.approx(case.trace().stokes.tolist())
    assert float(asked.path.parameters["delta"].default) == float(case.parameters["delta"].default)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ([], "--kind is missing; say what is drawn, one of ellipse, poincare"),
        (["--kind", "ellipse", "--out", ""], "is no name of a file"),
        (["--kind", "ellipse", "--out", "a.jpg"], "cannot be drawn; use one of: .png, .svg, .pdf"),
        (["--kind", "ellipse", "--out", "none/a.png"], "there is no such folder"),
        (["--kind", "elipse"], "'elipse' is not one of"),
        (["--kind", "ellipse", "--x", "delta"], "--x is of poincare or curve, and --kind ellipse"),
        (["--kind", "stokes", "--y", "S0"], "--y is of curve, and --kind stokes has none"),
        (["--kind", "energy", "--detector", "E"], "--detector is of ellipse or"),
        (["--kind", "poincare", "--detector", "E"], "add --x NAME, or leave --detector out"),
        (["--kind", "ellipse", "--detector", "X1"], "detector 'X1' is unknown"),
        (["--kind", "curve"], "name it, --x delta, or give it several values"),
        (["--kind", "curve", "--x", "delt"], "'delt' is unknown; did you mean 'delta'"),
        (["--kind", "curve", "--x", "place"], "--x"),
        (["--kind", "curve", "--x", "delta", "--x", "delta"], "--x delta is given 2 times"),
        (["--kind", "curve", "--x", "delta", "--delta", "30"], "delta"),
        (["--kind", "curve", "--x", "delta", "--y", "S9"], "'S9' is unknown"),
        (["--kind", "curve", "--x", "delta", "--y", ""], "unknown"),
        (
            ["--kind", "curve", "--x", "delta", "--x", "rho", "--y", "S0,S1"],
            "a map is of one quantity, and --y names 2; give one",
        ),
        (
            ["--kind", "curve", "--x", "delta", "--x", "rho", "--x", "phi"],
            "--kind curve is along two parameters at most",
        ),
        (["--kind", "poincare", "--x", "delta", "--x", "rho"], "one parameter at most"),
        (["--kind", "ellipse", "--delta", "0:90:4"], "--delta is given several values"),
        (["--kind", "ellipse", "--case", "8", "--case", "7"], "plot takes one case"),
        (["--kind", "ellipse", "--case", "77"], "'77'"),
        (["--kind", "ellipse", "--delta", "north"], "north"),
        (["--kind", "ellipse", "--json"], "--json"),
    ],
)
def test_what_cannot_be_drawn_is_refused_in_a_line(arguments, sentence, capsys, tmp_path):
    out = [] if "--out" in arguments else ["--out", "a.png"]
    assert main(["plot", "npgr026", *arguments, *out]) == 2
    told = capsys.readouterr()
    assert told.out == ""
    assert told.err.count("\n") == 1
    assert sentence in told.err
    assert not [*tmp_path.iterdir()]


def test_all_that_is_wrong_is_told_at_once(capsys):
    assert main(["plot", "npgr026", "--delta", "north"]) == 2
    told = capsys.readouterr().err
    assert "3 faults:" in told
    assert "--kind is missing" in told
    assert "--out is missing, and a picture is drawn into a file; add --out plot.png" in told


def test_without_the_extra_it_says_which(monkeypatch, capsys):
    monkeypatch.delattr("optipath.plots.save", raising=False)
    monkeypatch.setattr("optipath.plots.find_spec", lambda _: None)
    assert main(["plot", "npgr026", "--kind", "ellipse", "--out", "a.png"]) == 2
    assert "pip install 'optipath[plot]'" in capsys.readouterr().err


def test_kinds_are_completed_by_a_shell():
    line = {"COMP_WORDS": "optipath plot npgr026 --kind po", "COMP_CWORD": "4"}
    found = subprocess.run(
        [sys.executable, "-c", "from optipath.cli import main; main()"],
        env={**os.environ, **line, "_OPTIPATH_COMPLETE": "bash_complete"},
        capture_output=True,
        text=True,
        check=True,
    )
    assert found.stdout == "plain,poincare\n"


def test_help_tells_the_kinds():
    told = CliRunner().invoke(cli, ["plot", "npgr026", "--help"]).output
    assert re.search(r"--kind \[" + r"\|".join(KINDS), told)

"""``optipath surface reproduce``: experiments by name or file, their table, and what is refused."""

import json
import re

import click
import pytest

import optipath as op
from optipath.cli import main
from optipath.cli.reproduce_command import reproduce
from optipath.cli.surface_command import surface
from optipath.engines.automatic import is_installed
from optipath.lab.published import reproduction
from tables import rows

COMPILED = pytest.mark.skipif(not is_installed("numba"), reason="needs the extra fast")
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


@pytest.fixture(autouse=True)
def _files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "80")
    (tmp_path / "pane.toml").write_text(op.Sample([(1.5, 0)]).to_toml(), "utf-8")
    (tmp_path / "own.toml").write_text(OWN, "utf-8")


def told(capsys, *arguments):
    status = main(["surface", "reproduce", *arguments])
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def test_a_list_has_all_experiments_and_what_they_are(capsys):
    status, out, err = told(capsys, "--list", "--json")
    assert (status, err) == (0, "")
    names = [name for name in op.sample_names() if name.startswith("wang-2017-")]
    assert [*json.loads(out)] == names
    assert json.loads(out)["wang-2017-simulation-01"] == "1.5 on 2.4, alpha 0.1 each"
    assert MIRROR in told(capsys, "--list")[1]


@COMPILED
def test_what_is_published_stands_beside_what_is_computed(capsys):
    status, out, err = told(capsys, "own.toml", "--photons", "1e5")
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
    status, out, err = told(capsys, "own.toml", "--photons", "1e5", "--json")
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
    status, out, _ = told(capsys, *given)
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
    status, out, err = told(capsys, "own.toml", "--photons", "1000")
    assert (status, err) == (130, "optipath: interrupted\n")
    assert "four per cent" in out
    status, out, _ = told(capsys, "own.toml", "--photons", "1000", "--json")
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
    status, out, err = told(capsys, *given)
    assert (status, out) == (2, "")
    assert wrong in err


def test_options_before_the_word_are_refused(capsys):
    assert main(["surface", "--json", "reproduce"]) == 2
    assert "write optipath surface reproduce first" in capsys.readouterr().err


def test_help_is_its_own_and_that_of_surface_names_it(capsys):
    assert told(capsys, "--help")[1].startswith(
        "Usage: optipath surface reproduce [OPTIONS] [NAME]..."
    )
    assert main(["surface", "--help"]) == 0
    assert "optipath surface reproduce [NAME]..." in capsys.readouterr().out


def test_a_shell_completes_the_word_and_the_names():
    words = surface.params[0].shell_complete(click.Context(surface), "repr")
    assert [one.value for one in words] == ["reproduce"]
    names = reproduce.params[0].shell_complete(click.Context(reproduce), "wang-2017-f")
    assert [one.value for one in names] == ["wang-2017-figure-4", "wang-2017-figures-7-9"]

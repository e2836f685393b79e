"""How tests give commands: in this process, in a folder of their own, 80 columns wide."""

import json
import shlex

import pytest

from optipath.cli import main


@pytest.fixture(autouse=True)
def _folder_of_its_own_and_eighty_columns(tmp_path, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def run(capsys):
    """Give a line of command, and words that are no line; the status, the output, the errors."""

    def give(line, *words):
        status = main([*shlex.split(line), *map(str, words)])
        captured = capsys.readouterr()
        return status, captured.out, captured.err

    return give


@pytest.fixture
def told(run):
    """Give a command that has nothing to complain of; what it prints."""

    def give(line, *words):
        status, out, err = run(line, *words)
        assert (status, err) == (0, ""), line
        return out

    return give


@pytest.fixture
def found(told):
    """Give a command that has nothing to complain of; what it tells as JSON."""
    return lambda line, *words: json.loads(told(line, *words, "--json"))


@pytest.fixture
def refused(run):
    """Give a command that is refused in so many lines, one if not said; the sentence."""

    def give(line, *words, lines=1):
        status, out, err = run(line, *words)
        assert (status, out, len(err.splitlines())) == (2, "", lines), (line, err)
        assert err.startswith("optipath: ")
        return err.removeprefix("optipath: ").rstrip("\n")

    return give

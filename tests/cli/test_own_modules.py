"""Elements of a user's own at the command line: ``optipath --import my_elements run file.toml``."""

import json
import sys

import pytest

from optipath.cli.command import main
from optipath.elements.registry import KINDS
from tables import rows

MODULE = """
import optipath as op

class Foil(op.Element, kind="test-imported-foil"):
    share: op.Fraction = 0.5

    @staticmethod
    def mueller_rows(xp, share):
        return [[share * (row == column) for column in range(4)] for row in range(4)]
"""
POST_INIT = """
    def __post_init__(self):
        super().__post_init__()
        if self.share > 0.5:
            raise ValueError(f"{self.share} is too much")
"""
ROWS = """
    @staticmethod
    def mueller_rows(xp, share):
        raise {}
"""
FILE = """
format = 1
description = "a foil of one's own"
[parameters.share]
default = 0.5
[elements.lamp]
kind = "source"
[elements.foil]
kind = "test-imported-foil"
share = "$share"
[elements.eye]
kind = "detector"
[[links]]
from = "lamp.out"
to = "foil.in"
[[links]]
from = "foil.out"
to = "eye.in"
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "imported_foils.py").write_text(MODULE, "utf-8")
    (tmp_path / "path.toml").write_text(FILE, "utf-8")
    path = list(sys.path)
    yield tmp_path
    assert sys.path == path
    KINDS.pop("test-imported-foil", None)
    sys.modules.pop("imported_foils", None)


@rows(
    "modules",
    [["imported_foils"], ["imported_foils.py"], ["./imported_foils.py", "imported_foils"]],
)
@pytest.mark.usefixtures("folder")
def test_a_module_or_a_file_of_python_brings_its_elements(modules, capsys):
    options = [word for name in modules for word in ("--import", name)]
    assert main([*options, "run", "path.toml", "--share", "0.25", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["detectors"]["eye"]["stokes"][0] == 0.25


def test_what_a_module_prints_is_no_part_of_the_json(folder, capsys):
    (folder / "imported_foils.py").write_text("print('hello')\n" + MODULE, "utf-8")
    assert main(["--import", "imported_foils", "run", "path.toml", "--json"]) == 0
    captured = capsys.readouterr()
    assert json.loads(captured.out)["preset"] == "path.toml"
    assert captured.err == "hello\n"


def test_a_file_elsewhere_is_imported_by_its_path(folder, tmp_path_factory, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path_factory.mktemp("elsewhere"))
    file = str(folder / "imported_foils.py")
    assert main(["--import", file, "explain", str(folder / "path.toml")]) == 0
    assert "1 source" in capsys.readouterr().out


@pytest.mark.usefixtures("folder")
def test_without_it_the_kind_is_unknown_and_the_cure_named(capsys):
    assert main(["run", "path.toml"]) == 2
    error = capsys.readouterr().err
    assert "element kind 'test-imported-foil' is unknown" in error
    assert "optipath --import my_elements" in error


def test_a_file_never_says_what_is_imported(folder, capsys):
    (folder / "path.toml").write_text('import = "imported_foils"\n' + FILE, "utf-8")
    assert main(["run", "path.toml"]) == 2
    assert "key 'import' is unknown" in capsys.readouterr().err
    assert "imported_foils" not in sys.modules


@rows(
    "name, text, expected",
    [
        ("broken", "def (", "'broken' raises SyntaxError: invalid syntax (broken.py, line 1)"),
        ("broken.py", "1 / 0", "'broken.py' raises ZeroDivisionError: division by zero"),
        ("broken.py", "raise SystemExit(0)", "'broken.py' raises SystemExit: 0"),
        ("broken", "import no_such_module", "'broken' raises ModuleNotFoundError: No module named"),
        ("no_such_module", "", "there is no module 'no_such_module' in this folder or on Python"),
        ("no_such_file.py", "", "there is no file 'no_such_file.py'"),
        ("path.toml", "", "takes the name of a module or a file that ends in .py, not 'path.toml'"),
        ("", "", "takes the name of a module or a file that ends in .py, not ''"),
        (".", "", "takes the name of a module or a file that ends in .py, not '.'"),
        ("json.py", "x = 1", "a module named 'json' is there already; rename 'json.py'"),
    ],
)
def test_what_cannot_be_imported_is_told_in_a_line(name, text, expected, folder, capsys):
    if text:
        (folder / (name if name.endswith(".py") else f"{name}.py")).write_text(text, "utf-8")
    assert main(["--import", name, "presets"]) == 2
    captured = capsys.readouterr()
    assert expected in captured.err
    assert len(captured.err.splitlines()) == 1
    assert not captured.out
    assert sys.modules.get("broken") is None


@pytest.mark.parametrize(
    ("method", "share", "expected"),
    [
        (
            POST_INIT,
            "0.75",
            "elements.foil: element class Foil raises ValueError: 0.75 is too much",
        ),
        (POST_INIT, '"x"', "elements.foil.share: 'x' is not a quantity"),
        (ROWS.format("SystemExit(7)"), "0.5", "class Foil raises SystemExit: 7"),
        (ROWS.format("MemoryError"), "0.5", "the memory of this machine does not suffice"),
    ],
)
def test_whatever_code_of_ones_own_raises_is_told_in_a_line(
    method, share, expected, folder, capsys
):
    (folder / "imported_foils.py").write_text(MODULE + method, "utf-8")
    (folder / "path.toml").write_text(FILE.replace('"$share"', share), "utf-8")
    assert main(["--import", "imported_foils", "run", "path.toml"]) == 2
    captured = capsys.readouterr()
    assert expected in captured.err
    assert len(captured.err.splitlines()) == 1

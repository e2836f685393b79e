"""Elements of a user's own at the command line: ``optipath --import my_elements run file.toml``."""

import json
import sys

import pytest

from optipath.elements.coupling import KINDS
from optipath.explorer.server import PageServer
from tables import rows

MODULE = """
import optipath as op

class Foil(op.Element, kind="test-imported-foil"):
    share: op.fields.Fraction = 0.5
    straight = True

    @staticmethod
    def mueller_rows(xp, share):
        return [[share * (row == column) for column in range(4)] for row in range(4)]
"""
FOIL = "elements.foil"
POST_INIT = """
    def __post_init__(self):
        super().__post_init__()
        if self.share > 0.5:
            raise ValueError(f"{self.share} is too much")
"""
DECLARED = "[parameters.share]\ndefault = 0.5\n"
FILE = f"""
format = 1
description = "a foil of one's own"
links = [{{ from = "lamp.out", to = "foil.in" }}, {{ from = "foil.out", to = "eye.in" }}]
{DECLARED}[elements]
lamp = {{ kind = "source" }}
foil = {{ kind = "test-imported-foil", share = "$share" }}
eye = {{ kind = "detector" }}
"""


@pytest.fixture(autouse=True)
def folder(tmp_path):
    (tmp_path / "imported_foils.py").write_text(MODULE, "utf-8")
    (tmp_path / "path.toml").write_text(FILE, "utf-8")
    path = list(sys.path)
    yield tmp_path
    assert sys.path == path
    KINDS.pop("test-imported-foil", None)
    sys.modules.pop("imported_foils", None)


@rows("modules", ["imported_foils", "imported_foils.py", "./imported_foils.py imported_foils"])
def test_a_module_or_a_file_brings_elements_to_the_explorer_too(modules, found, run, monkeypatch):
    served, imported = [], "".join(f"--import {name} " for name in modules.split())
    light = found(f"{imported} run path.toml --share 0.25")
    assert light["detectors"]["eye"]["stokes"][0] == 0.25
    monkeypatch.setattr(PageServer, "serve_forever", lambda *one: served.extend(one))
    assert run(f"{imported} explore path.toml --no-browser")[0] == 0
    shown = served[0].answers.trace({"preset": "path.toml", "want": ["scene", "energy"]})
    assert shown["detectors"]["eye"]["texts"] == ["0.5", "0", "0", "0"]


def test_what_a_module_prints_is_no_json(folder, tmp_path_factory, monkeypatch, run):
    file = folder / "imported_foils.py"
    file.write_text("print('hello')\n" + MODULE, "utf-8")
    status, out, err = run("--import imported_foils run path.toml --json")
    assert (status, err) == (0, "hello\n")
    assert json.loads(out)["preset"] == "path.toml"
    del sys.modules["imported_foils"], KINDS["test-imported-foil"]
    monkeypatch.chdir(tmp_path_factory.mktemp("elsewhere"))
    status, out, _ = run("--import", file, "explain", folder / "path.toml")
    assert status == 0
    assert "1 source" in out


def test_without_it_the_kind_is_unknown_and_a_file_never_says_what_is_imported(folder, refused):
    error = refused("run path.toml")
    assert "element kind 'test-imported-foil' is unknown" in error
    assert "optipath --import my_elements" in error
    (folder / "path.toml").write_text('import = "imported_foils"\n' + FILE, "utf-8")
    assert "key 'import' is unknown" in refused("run path.toml")
    assert "imported_foils" not in sys.modules


@rows(
    "name, text, expected",
    [
        ("broken", "def (", "'broken' raises SyntaxError: invalid syntax (broken.py, line 1)"),
        ("broken.py", "1 / 0", "'broken.py' raises ZeroDivisionError: division by zero"),
        ("broken.py", "raise SystemExit(0)", "'broken.py' raises SystemExit: 0"),
        ("broken", "import no_such_module", "'broken' raises ModuleNotFoundError: No module named"),
        *(
            (name, "", f"or a file that ends in .py, and '{name}' is neither; look at its name")
            for name in ("no_such_module", "no_such_file.py", "path.toml", "")
        ),
        *(
            (f"{name}.py", "x = 1", f"a module named '{name}' is there already; rename '{name}.py'")
            for name in ("json", "imaplib")  # That is not imported before.
        ),
    ],
)
def test_what_cannot_be_imported_is_told_in_a_line(name, text, expected, folder, refused):
    if text:
        (folder / (name if name.endswith(".py") else f"{name}.py")).write_text(text, "utf-8")
    assert expected in refused("--import", name, "presets")
    assert sys.modules.get("broken") is None


@pytest.mark.parametrize(
    ("old", "new", "share", "expected"),
    [
        ("", "", '"x"', f"{FOIL}.share: 'x' is not a quantity"),
        ("", POST_INIT, "0.75", f"{FOIL}: element class Foil raises ValueError: 0.75 is too much"),
        ("return", "raise SystemExit(7) #", "0.5", "class Foil raises SystemExit: 7"),
        ("return", "raise MemoryError #", "0.5", "the memory of this machine does not suffice"),
    ],
)
def test_whatever_own_code_raises_is_told(old, new, share, expected, folder, refused):
    module = MODULE.replace(old, new) if old else MODULE + new
    (folder / "imported_foils.py").write_text(module, "utf-8")
    (folder / "path.toml").write_text(
        FILE.replace(DECLARED, "").replace('"$share"', share), "utf-8"
    )
    assert expected in refused("--import imported_foils run path.toml")

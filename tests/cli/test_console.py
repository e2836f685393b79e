import re
import xml.etree.ElementTree as ET

import optipath as op
from optipath.cli import main
from tables import rows

ESCAPE = "\x1b]0;title\x07\x1b[31m\x9b2J\u202e[/b][red]"


def hostile(tmp_path):
    """Write a preset in which every text that may be anything commands the terminal."""
    path = op.PathGraph(
        f"description{ESCAPE}",
        {f"case{ESCAPE}": op.Case({"angle": 0.1}, {f"eye{ESCAPE}": (1, 0, 0, 0)}, f"note{ESCAPE}")},
    )
    angle = op.Parameter(
        "angle", 0.1, unit="deg", help=f"help{ESCAPE}", words={f"word{ESCAPE}": 0.2}, optional=True
    )
    lamp = path.add(f"lamp{ESCAPE}", op.Source())
    (
        lamp
        >> path.add(f"filter{ESCAPE}", op.Polarizer(angle))
        >> path.add(f"eye{ESCAPE}", op.Detector())
    )
    file = tmp_path / f"file{ESCAPE.replace('/', '')}.toml"
    file.write_text(path.to_toml(), "utf-8")
    return str(file)


def everything(capsys, *arguments):
    status = main([str(argument) for argument in arguments])
    captured = capsys.readouterr()
    return status, captured.out + captured.err


def is_tame(text):
    # Nothing that a terminal obeys, and no direction of writing turned.
    return not re.search("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e]", text)


@rows(
    "command",
    [
        ["run"],
        ["run", "--case", f"case{ESCAPE}"],
        ["run", "--json"],
        ["run", "--help"],
        ["run", "--angle", f"word{ESCAPE}"],
        ["show"],
        ["explain"],
        ["explain", "--json"],
        ["polarization"],
        ["polarization", "--json"],
    ],
)
def test_no_text_of_a_file_commands_the_terminal(command, tmp_path, capsys):
    file = hostile(tmp_path)
    status, told = everything(capsys, command[0], file, *command[1:])
    assert status == 0
    assert is_tame(told)
    assert ("\\x1b" if "--json" not in command else "\\u001b") in told


@rows(
    "command",
    [
        ["run", "--case", f"x{ESCAPE}"],
        ["run", "--angle", f"x{ESCAPE}"],
        ["run", f"--x{ESCAPE}"],
        ["show", "--case", f"x{ESCAPE}"],
        ["show", "--svg", f"/no{ESCAPE}/x.svg"],
    ],
)
def test_no_fault_that_quotes_a_text_commands_the_terminal(command, tmp_path, capsys):
    status, told = everything(capsys, command[0], hostile(tmp_path), *command[1:])
    assert status == 2
    assert told.count("\n") == 1
    assert is_tame(told)


@rows(
    "text",
    [
        r'"\u001b[31m" = 1',
        r'format = 1\n[elements."\u001b[31m"]\nkind = "\u001b[31m"',
        r'format = 1\n[parameters."\u001b[31m"]\nunit = "\u001b[31m"',
        "x = \x1b[31m",
        'x = "\x1b[31m"',
        r'[[links]]\nfrom = "\u001b[31m.out"\nto = "\u009b.in"',
        r'[cases."\u001b[31m"]\nvalues = {"\u001b[31m" = 1}',
    ],
)
def test_no_key_of_a_file_commands_the_terminal(text, tmp_path, capsys):
    file = tmp_path / "x.toml"
    file.write_text(text.replace(r"\n", "\n"), "utf-8")
    status, told = everything(capsys, "run", file)
    assert status == 2
    assert is_tame(told)


def test_a_picture_loads_nothing_and_holds_its_texts_as_texts(tmp_path, capsys):
    picture = tmp_path / "x.svg"
    assert everything(capsys, "show", hostile(tmp_path), "--svg", picture)[0] == 0
    text = picture.read_text("utf-8")
    assert is_tame(text)
    assert re.findall(r"https?://[^\"]*|url\((?!#)", text) == ["http://www.w3.org/2000/svg"]
    assert "@font-face" not in text
    assert "<script" not in text
    shown = "".join(ET.fromstring(text).itertext()).replace("\xa0", " ")  # noqa: S314 - our own
    for word in ("description", "help", "note", "[red]"):
        assert word in shown


def test_a_name_that_is_longer_than_a_box_goes_on_in_the_next_line(tmp_path, capsys):
    path = op.PathGraph()
    path.add("lamp" * 60, op.Source()) >> path.add("eye" * 60, op.Detector())
    file, picture = tmp_path / "x.toml", tmp_path / "x.svg"
    file.write_text(path.to_toml(), "utf-8")
    assert everything(capsys, "show", file, "--svg", picture)[0] == 0
    texts = ET.fromstring(picture.read_text("utf-8")).iter("{http://www.w3.org/2000/svg}text")  # noqa: S314
    assert "eye" * 60 in "".join(text.text for text in texts)


def words_of(text):
    """The words of what is printed, in a table or row by row, the frame of tables aside."""
    return {word.rstrip(":,") for word in re.findall(r"[^\s│┃┏┳┓┡╇┩├┼┤└┴┘━─]+", text)}


@rows("columns", ["", "0", "1", "20", "-5", "abc", "²", "9" * 5000, "50"])
@rows("command", [["presets"], ["show", "npgr026"], ["run", "npgr026", "--case", "3"]])
def test_nothing_is_cut_whatever_columns_says(columns, command, monkeypatch, capsys):
    monkeypatch.setenv("COLUMNS", "300")
    whole = everything(capsys, *command)[1]
    monkeypatch.setenv("COLUMNS", columns)
    found = everything(capsys, *command)[1]
    joined = re.sub(r"\s", "", found)  # A word that is longer than a line stands on two.
    assert {word for word in words_of(whole) - words_of(found) if word not in joined} == set()


@rows(
    "arguments",
    [
        ["show", "malus", "--svg", ""],
        ["show", "malus", "--svg", "{folder}"],
        ["show", "malus", "--svg", "{folder}/none/x.svg"],
        ["show", "malus", "--svg", "{folder}/file/x.svg"],
        ["show", "malus", "--svg", "/dev/full"],
        ["show", "malus", "--svg", "{folder}/" + "x" * 300],
        ["show", "malus", "--svg", "a\0b"],
        ["chart", "malus", "--out", ""],
        ["chart", "malus", "--out", "{folder}"],
        ["chart", "malus", "--out", "{folder}/none/x.png"],
        ["chart", "malus", "--data", ""],
        ["chart", "malus", "--data", "{folder}"],
        ["accuracy", "--write", ""],
        ["accuracy", "--write", "{folder}"],
        ["chart", "--from", ""],
        ["show", ""],
        ["run", ""],
        ["run", "{folder}"],
        ["run", "{folder}/none.toml"],
        ["run", "a\0b.toml"],
    ],
)
def test_places_that_take_no_file_are_refused_in_one_line(arguments, tmp_path, capsys):
    (tmp_path / "file").touch()
    arguments = [argument.replace("{folder}", str(tmp_path)) for argument in arguments]
    status, told = everything(capsys, *arguments)
    assert status == 2
    assert told.startswith("optipath: ")
    assert told.count("\n") == 1


def test_a_picture_that_cannot_be_written_leaves_the_one_before(tmp_path, capsys, monkeypatch):
    picture = tmp_path / "x.svg"
    assert everything(capsys, "show", "malus", "--svg", picture)[0] == 0
    before = picture.read_bytes()

    def full(_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", full)
    status, told = everything(capsys, "show", "npgr026", "--svg", picture)
    assert (status, told.count("\n")) == (2, 1)
    assert "No space left" in told
    assert picture.read_bytes() == before
    assert [file.name for file in tmp_path.iterdir()] == ["x.svg"]

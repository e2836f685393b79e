"""What is printed fits the terminal, has the digits it is worth, and commands nothing."""

import json
import logging
import re
import shlex
import xml.etree.ElementTree as ET

import pytest

import optipath as op
from optipath.cli import main
from optipath.engines.code_cache import CodeCache
from optipath.lab.bench.timing import duration
from tables import rows


def told(capsys, *arguments):
    assert main(list(arguments)) == 0
    return capsys.readouterr().out


def test_numbers_have_six_digits_and_all_of_them_in_json(capsys):
    assert "33.9959 " in told(capsys, "run", "npgr026", "--case", "7")
    found = json.loads(told(capsys, "run", "npgr026", "--case", "7", "--json"))
    assert len(repr(found["detectors"]["E"]["stokes"][0])) > 15
    # Crossed polarisers: what is left is the rounding of cos(90 deg).
    table = dict(re.findall(r"│ (S\d) +│ (\S+) ", told(capsys, "run", "malus", "--angle", "90")))
    assert set(table.values()) == {"0"}


def test_psi_and_delta_are_those_of_ellipsometry_with_their_units(capsys):
    out = told(capsys, "run", "ellipsometer-pcsa")
    # Silicon at 70 degrees, by r_p / r_s of the textbooks.
    assert re.search(r"Psi \(ellipsometry\) +│ 10.5727 deg ", out)
    assert re.search(r"Delta \(ellipsometry\) +│ 179.23 deg ", out)
    assert re.search(r"AoP +│ \S+ deg ", out)


@rows("digits", [3, 9])
@rows(
    "command",
    [
        ["run", "npgr026", "--case", "7"],
        ["run", "npgr026", "--case", "all"],
        ["polarization", "npgr026", "--case", "7"],
    ],
)
def test_digits_are_as_many_as_are_asked_for(digits, command, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "120")
    exact = op.load_preset("npgr026", case=7).trace().intensity
    assert f" {exact:.{digits}g} " in told(capsys, *command, "--digits", str(digits))


def test_light_too_faint_for_a_float_has_its_logarithm(capsys, tmp_path):
    path = op.PathGraph()
    node = path.add("lamp", op.Source())
    for number in range(40):
        node >>= path.add(f"dim{number}", op.Attenuator(1e-10))
    node >> path.add("eye", op.Detector())
    file = tmp_path / "faint.toml"
    file.write_text(path.to_toml(), "utf-8")
    assert re.search(r"log10 S0 +│ -400 ", told(capsys, "run", str(file)))


@rows("columns", ["20", "40", "80", "120"])
@rows(
    "line",
    [
        "presets",
        "run npgr026 --case 6",
        "run npgr026 --case all",
        "polarization npgr026",
        "explain npgr026",
        "explain glass-slab",
    ],
)
def test_no_line_is_wider_than_the_terminal(columns, line, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", columns)
    assert max(map(len, told(capsys, *line.split()).splitlines())) <= int(columns)


def test_what_a_preset_is_made_of_fits_a_narrow_terminal(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "40")
    shown = told(capsys, "show", "glass-slab")
    assert max(map(len, shown.splitlines())) <= 40
    assert "incidence=follows  outside=follows" in shown


@rows("columns", ["40", "80"])
def test_descriptions_are_whole(columns, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", columns)
    listed = " ".join(told(capsys, "presets").split())
    helped = " ".join(told(capsys, "run", "--help").split())
    for name in op.preset_names():
        words = op.load_preset(name).description.split()
        assert words[-1] in listed
        assert words[-1] in helped


def test_a_narrow_table_has_each_label_above_its_value(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "40")
    lines = told(capsys, "run", "npgr026", "--case", "6").splitlines()
    assert lines[lines.index("S0") + 1] == "  computed: 50"
    assert lines[lines.index("phi") + 1] == "  54.6 deg"


def test_explanations_go_on_in_indented_lines(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "300")
    whole = told(capsys, "explain", "npgr026")
    monkeypatch.setenv("COLUMNS", "60")
    wrapped = told(capsys, "explain", "npgr026")
    assert wrapped.split() == whole.split()
    assert re.search("\nfewer than 58 paths .*\n    ", wrapped)


def test_a_share_that_is_rounding_is_printed_as_0(capsys):
    rows = told(capsys, "polarization", "npgr026", "--case", "4").splitlines()
    shares = {row.split("│")[1].strip(): row.split("│")[2].strip() for row in rows if "│" in row}
    assert [shares[head] for head in ("difference", "at least", "at most")] == ["0 %"] * 3


@rows(
    "command, asked",
    [
        ("run", "parameter 'angle_1' has no value; give one, --angle-1 ..."),
        ("polarization", "parameter 'angle_1' has no value; give one, --angle-1 ..."),
        ("explain", "certificate: depends on angle_1; give --angle-1 ..."),
    ],
)
def test_a_value_that_is_missing_is_asked_for_by_its_option(capsys, tmp_path, command, asked):
    file = tmp_path / "open.toml"
    path = op.Source() >> op.Polarizer(op.Parameter("angle_1")) >> op.Detector()
    file.write_text(path.to_toml(), "utf-8")
    main([command, str(file)])
    assert asked in "".join(capsys.readouterr())


def compiling(cache, caplog, monkeypatch, *texts):
    """What is told in compiling some texts with a folder for a cache."""

    def refuse(_):
        raise ValueError("stop")

    monkeypatch.setenv("OPTIPATH_CACHE", str(cache))
    caplog.clear()
    code = CodeCache()
    with caplog.at_level(logging.WARNING, "optipath"):
        for text in texts:
            with pytest.raises(ValueError, match="stop"):
                code.function(text, refuse)
    return [record.message for record in caplog.records]


def test_that_something_is_compiled_is_told_once_and_whether_it_is_kept(
    caplog, monkeypatch, tmp_path
):
    messages = compiling(tmp_path, caplog, monkeypatch, "first", "second")
    assert [message for message in messages if "compiling" in message] == [
        "compiling for Numba, which takes some seconds a path; what is compiled is kept"
    ]
    not_kept, told_of_it = compiling("/dev/null", caplog, monkeypatch, "first")
    assert not_kept.startswith("compiled code is not kept: ")
    assert told_of_it == "compiling for Numba, which takes some seconds a path"


def test_times_have_the_unit_that_suits_them():
    seconds = [1.05e-6, 999.6e-9, 0.0457, 59.9, 4321.0]
    assert [*map(duration, seconds)] == ["1.05 us", "1 us", "45.7 ms", "59.9 s", "4,320 s"]


def test_parameters_have_as_many_digits_as_results(capsys):
    given = ["run", "npgr026", "--rho", "0.6rad"]
    for cases in ([], ["--case", "1", "--case", "2"]):
        assert re.search(r"rho +34\.3775 deg", told(capsys, *given, *cases))
        assert re.search(r"rho +34\.4 deg", told(capsys, *given, *cases, "--digits", "3"))


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


def test_no_text_of_a_file_commands_the_terminal(tmp_path, capsys):
    file = hostile(tmp_path)
    for options in (
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
    ):
        status, told = everything(capsys, options[0], file, *options[1:])
        assert status == 0
        assert is_tame(told)
        assert ("\\x1b" if "--json" not in options else "\\u001b") in told


def test_no_fault_that_quotes_a_text_commands_the_terminal(tmp_path, capsys):
    file = hostile(tmp_path)
    for options in (
        ["run", "--case", f"x{ESCAPE}"],
        ["run", "--angle", f"x{ESCAPE}"],
        ["run", f"--x{ESCAPE}"],
        ["show", "--case", f"x{ESCAPE}"],
        ["show", "--svg", f"/no{ESCAPE}/x.svg"],
    ):
        status, told = everything(capsys, options[0], file, *options[1:])
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


@rows("line", ["presets", "show npgr026", "run npgr026 --case 3"])
def test_nothing_is_cut_whatever_columns_says(line, monkeypatch, capsys):
    monkeypatch.setenv("COLUMNS", "300")
    whole = everything(capsys, *line.split())[1]
    for columns in ("", "0", "1", "20", "-5", "abc", "²", "9" * 5000, "50"):
        monkeypatch.setenv("COLUMNS", columns)
        found = everything(capsys, *line.split())[1]
        joined = re.sub(r"\s", "", found)  # A word that is longer than a line stands on two.
        missing = {word for word in words_of(whole) - words_of(found) if word not in joined}
        assert missing == set(), columns


@rows(
    "line",
    [
        "show malus --svg ''",
        "show malus --svg '{folder}'",
        "show malus --svg '{folder}/none/x.svg'",
        "show malus --svg '{folder}/file/x.svg'",
        "show malus --svg /dev/full",
        "show malus --svg '{folder}/" + "x" * 300 + "'",
        "show malus --svg 'a\0b'",
        "chart malus --out ''",
        "chart malus --out '{folder}'",
        "chart malus --out '{folder}/none/x.png'",
        "chart malus --data ''",
        "chart malus --data '{folder}'",
        "accuracy --write ''",
        "accuracy --write '{folder}'",
        "chart --from ''",
        "show ''",
        "run ''",
        "run '{folder}'",
        "run '{folder}/none.toml'",
        "run 'a\0b.toml'",
    ],
)
def test_places_that_take_no_file_are_refused_in_one_line(line, tmp_path, capsys):
    (tmp_path / "file").touch()
    status, told = everything(capsys, *shlex.split(line.replace("{folder}", str(tmp_path))))
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

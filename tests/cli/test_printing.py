"""What is printed has the digits that it is worth, and fits the terminal."""

import json
import logging
import re

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


def test_psi_and_delta_are_those_of_ellipsometry_with_their_units(capsys):
    out = told(capsys, "run", "ellipsometer-pcsa")
    # Silicon at 70 degrees, by r_p / r_s of the textbooks.
    assert re.search(r"Psi \(ellipsometry\) +│ 10.5727 deg ", out)
    assert re.search(r"Delta \(ellipsometry\) +│ 179.23 deg ", out)
    assert re.search(r"AoP +│ \S+ deg ", out)


def test_rounding_is_printed_as_nothing(capsys):
    # Crossed polarisers: what is left is the rounding of cos(90 deg).
    rows = dict(re.findall(r"│ (S\d) +│ (\S+) ", told(capsys, "run", "malus", "--angle", "90")))
    assert set(rows.values()) == {"0"}


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
    "command",
    [
        ["presets"],
        ["run", "npgr026", "--case", "6"],
        ["run", "npgr026", "--case", "all"],
        ["polarization", "npgr026"],
        ["explain", "npgr026"],
        ["explain", "glass-slab"],
    ],
)
def test_no_line_is_wider_than_the_terminal(columns, command, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", columns)
    assert max(map(len, told(capsys, *command).splitlines())) <= int(columns)


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


def test_what_a_preset_is_made_of_fits_a_narrow_terminal(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "40")
    shown = told(capsys, "show", "glass-slab")
    assert max(map(len, shown.splitlines())) <= 40
    assert "incidence=follows  outside=follows" in shown


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


def test_that_something_is_compiled_is_told_once(caplog, monkeypatch, tmp_path):
    monkeypatch.setenv("OPTIPATH_CACHE", str(tmp_path))
    cache = CodeCache()
    with caplog.at_level(logging.WARNING, "optipath"):
        for text in ("first", "second"):
            with pytest.raises(ValueError, match="stop"):
                cache.function(text, refuse)
    assert [record.message for record in caplog.records if "compiling" in record.message] == [
        "compiling for Numba, which takes some seconds a path; what is compiled is kept"
    ]


def test_that_nothing_is_kept_is_not_contradicted(caplog, monkeypatch):
    monkeypatch.setenv("OPTIPATH_CACHE", "/dev/null")
    with caplog.at_level(logging.WARNING, "optipath"), pytest.raises(ValueError, match="stop"):
        CodeCache().function("first", refuse)
    not_kept, compiling = [record.message for record in caplog.records]
    assert not_kept.startswith("compiled code is not kept: ")
    assert compiling == "compiling for Numba, which takes some seconds a path"


def refuse(_):
    raise ValueError("stop")


@rows(
    "seconds, text",
    [
        (1.05e-6, "1.05 us"),
        (999.6e-9, "1 us"),
        (0.0457, "45.7 ms"),
        (59.9, "59.9 s"),
        (4321.0, "4,320 s"),
    ],
)
def test_times_have_the_unit_that_suits_them(seconds, text):
    assert duration(seconds) == text


def test_parameters_have_as_many_digits_as_results(capsys):
    given = ["run", "npgr026", "--rho", "0.6rad"]
    for cases in ([], ["--case", "1", "--case", "2"]):
        assert re.search(r"rho +34\.3775 deg", told(capsys, *given, *cases))
        assert re.search(r"rho +34\.4 deg", told(capsys, *given, *cases, "--digits", "3"))

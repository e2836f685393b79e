import json
import os
import subprocess
import sys
import sysconfig
import tomllib
from pathlib import Path

import pytest

import optipath as op
from optipath.cli import main
from optipath.lab.accuracy.regions import REGIONS
from optipath.lab.accuracy.tables import SEARCHED
from tables import rows


def run(capsys, *arguments):
    status = main(list(arguments))
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def test_presets_lists_every_preset(capsys):
    status, out, err = run(capsys, "presets")
    assert (status, err) == (0, "")
    assert all(name in out for name in op.preset_names())


def test_presets_as_json(capsys):
    _, out, _ = run(capsys, "presets", "--json")
    assert list(json.loads(out)) == op.preset_names()


def test_run_as_json_has_the_keys_that_others_read(capsys):
    status, out, err = run(capsys, "run", "npgr026", "--delta", "48", "--filter", "30", "--json")
    found = json.loads(out)
    assert (status, err) == (0, "")
    assert list(found) == [
        "preset",
        "parameters",
        "units",
        "model",
        "method",
        "engine",
        "detectors",
    ]
    assert found["preset"] == "npgr026"
    assert found["method"] == "stable"
    assert found["model"] == "full"
    assert found["parameters"]["delta"] == 48.0
    assert found["parameters"]["filter"] == 30.0
    assert found["units"]["delta"] == "deg"
    assert len(found["detectors"]["E"]["stokes"]) == 4


def test_run_takes_units_and_negative_numbers(capsys):
    _, plain, _ = run(capsys, "run", "npgr026", "--rho", "-34", "--json")
    _, with_unit, _ = run(capsys, "run", "npgr026", "--rho", "-34 deg", "--json")
    assert plain == with_unit
    assert json.loads(plain)["parameters"]["rho"] == -34.0


def test_run_prints_the_published_value_beside_the_computed_one(capsys):
    status, out, _ = run(capsys, "run", "npgr026", "--case", "3")
    assert status == 0
    for part in ("published", "1.2e-10", "-1.21725e-10", "note: The published S1"):
        assert part in out


def test_a_case_with_other_values_has_no_published_value(capsys):
    _, out, _ = run(capsys, "run", "npgr026", "--case", "3", "--delta", "20", "--json")
    assert "published" not in json.loads(out)["detectors"]["E"]


def test_run_by_another_method_says_so(capsys):
    _, out, _ = run(capsys, "run", "npgr026", "--method", "textbook", "--json")
    assert json.loads(out)["method"] == "textbook"


def test_run_names_what_ran_one_path(capsys):
    assert json.loads(run(capsys, "run", "malus", "--json")[1])["engine"] == "floats"
    assert run(capsys, "run", "malus")[1].splitlines()[-1].endswith("engine floats")


# A process that runs a handful once makes no formula for it.
@rows("count, ran", [(5, "numpy, step by step"), (2000, "numpy")])
def test_run_names_what_ran_a_batch(count, ran, capsys, tmp_path):
    file = tmp_path / "arrays.toml"
    angles = ", ".join(f'"{90 * place / count} deg"' for place in range(count))
    text = op.load_preset("malus").to_toml().replace('default = "30 deg"', f"default = [{angles}]")
    file.write_text(text, "utf-8")
    assert json.loads(run(capsys, "run", str(file), "--json")[1])["engine"] == ran
    assert run(capsys, "run", str(file))[1].splitlines()[-1].endswith(f"engine {ran}")


def test_the_file_of_a_preset_is_read_once(capsys, monkeypatch):
    read = []
    parse = tomllib.loads
    monkeypatch.setattr(tomllib, "loads", lambda text: read.append(text) or parse(text))
    for command in ("run", "explain", "polarization"):
        read.clear()
        assert run(capsys, command, "npgr026", "--case", "7", "--delta", "40", "--json")[0] == 0
        assert len(read) == 1


def test_one_run_calls_few_functions_of_the_library(capsys):
    def note(frame, event, _):
        calls.append(event == "call" and frame.f_code.co_filename.startswith(folder))

    calls, folder = [], str(Path(op.__file__).parent)
    command = ["run", "npgr026", "--delta", "48", "--json"]
    run(capsys, *command)  # What is made once for all runs.
    before = sys.getprofile()
    sys.setprofile(note)
    try:
        main(command)
    finally:
        sys.setprofile(before)
    assert sum(calls) < 8000


def test_help_lists_every_parameter_with_its_help(capsys):
    status, out, _ = run(capsys, "run", "npgr026", "--help")
    assert status == 0
    for name, parameter in op.load_preset("npgr026").parameters.items():
        assert f"--{name}" in out
        assert parameter.help.split()[0] in out


def test_show_tells_parameters_elements_links_and_notes(capsys):
    status, out, _ = run(capsys, "show", "npgr026")
    assert status == 0
    for part in (
        "delta",
        "53 deg",
        "0 deg .. 90 deg",
        "X2.in",
        "azimuth=-$rho",
        "misprint",
        "0.666",
    ):
        assert part in out or part == "misprint"


def test_show_draws_into_a_file(capsys, tmp_path):
    file = tmp_path / "picture.svg"
    status, _, _ = run(capsys, "show", "malus", "--svg", str(file))
    assert status == 0
    assert file.read_text("utf-8").startswith("<svg")


def test_explain_tells_the_steps(capsys):
    status, out, _ = run(capsys, "explain", "npgr026", "--case", "1", "--rho", "20")
    assert status == 0
    assert "4 steps" in out.splitlines()[0]
    assert "X2.reflected" in out


def test_explain_tells_the_model_the_cost_and_the_certificate(capsys):
    values = ["--n1", "0.2", "--k1", "3.4", "--n2", "0.2", "--k2", "3.4", "--filter", "none"]
    arguments = ["explain", "npgr026", *values, "--reads", "intensity", "--tolerance", "0.1"]
    status, out, _ = run(capsys, *arguments)
    assert status == 0
    assert "model scalar: where its certificate allows it; exact is 'sp'" in out
    assert "operations per path" in out
    assert "certificate: at E" in out
    assert len(out.splitlines()) < 35
    found = json.loads(run(capsys, *arguments, "--json")[1])
    assert found["operations"]["plan"]["all"] < found["operations"]["full"]["all"]
    assert 0.9 < found["certificate"]["bounds"]["E"]["lower"] <= 1.0
    assert found["tolerance"] == {
        "most": 0.1,
        "model": "scalar",
        "otherwise": "sp",
        "text": "model scalar where its certificate is within it, sp elsewhere",
    }
    assert all(step["live"][0] == "S0" for step in found["steps"])


def test_polarization_tells_the_exact_result_beside_the_scalar_one(capsys):
    panes = ["polarization", "npgr026", "--n1", "1.5", "--n2", "1.5", "--rho", "90"]
    status, out, _ = run(capsys, *panes)
    assert status == 0
    assert "polarisation changes S0 by up to" in out
    found = json.loads(run(capsys, *panes, "--json")[1])["detectors"]["E"]
    assert sorted(found["culprits"]) == ["X1", "X2"]
    share = found["exact"] / found["scalar"]
    assert found["lower"] <= share <= found["upper"]


def test_a_model_that_is_not_exact_is_refused_in_one_line(capsys):
    status, out, err = run(capsys, "run", "malus", "--model", "scalar")
    assert (status, out) == (2, "")
    assert "model 'scalar' is not exact for this path" in err


def test_a_file_of_ones_own_works_wherever_a_name_does(capsys, tmp_path):
    file = tmp_path / "my own.toml"
    file.write_text(op.load_preset("malus").to_toml(), "utf-8")
    for command in ("show", "run", "explain"):
        assert run(capsys, command, str(file))[0] == 0
    _, out, _ = run(capsys, "run", str(file), "--angle", "60", "--json")
    assert json.loads(out)["detectors"]["eye"]["stokes"][0] == pytest.approx(0.125)


def test_unread_components_are_null(capsys, tmp_path):
    file = tmp_path / "intensity.toml"
    text = op.load_preset("malus").to_toml().replace('reads = "stokes"', 'reads = "intensity"')
    file.write_text(text, "utf-8")
    _, out, _ = run(capsys, "run", str(file), "--json")
    assert json.loads(out)["detectors"]["eye"]["stokes"] == [pytest.approx(0.375), None, None, None]
    _, out, _ = run(capsys, "run", str(file))
    assert "not read" in out


@rows(
    "arguments, messages",
    [
        (["run", "npgr62"], ["'npgr62'", "did you mean 'npgr026'"]),
        (["run", "../x"], ["../x"]),
        (["run", "npgr026", "--detla", "3"], ["--detla", "--delta"]),
        (["run", "npgr026", "--delta", "95"], ["delta", "95 deg", "0 deg .. 90 deg"]),
        (["run", "npgr026", "--delta", "abc"], ["delta", "abc"]),
        (["run", "npgr026", "--delta", "3 dge"], ["did you mean 'deg'"]),
        (["run", "npgr026", "--k1", "-1"], ["k1", "-1"]),
        (["run", "npgr026", "--n1", "nan"], ["n1", "nan"]),
        (["run", "npgr026", "--n1", "inf"], ["n1", "inf"]),
        (["run", "npgr026", "--filter", "horizontl"], ["did you mean 'horizontal'"]),
        (["run", "npgr026", "--case", "10"], ["case '10' is unknown"]),
        (["run", "npgr026", "--delta"], ["--delta"]),
        (["run", "npgr026", "--method", "exact"], ["exact"]),
        (["run", "npgr026", "more"], ["more"]),
        (["run"], ["PRESET"]),
        (["show"], ["PRESET"]),
        (["show", "npgr026", "--svg", "/no/such/folder/x.svg"], ["cannot be written"]),
        (["explain", "no-such.toml"], ["no-such.toml"]),
        (["rnu"], ["rnu"]),
        (["--what"], ["--what"]),
    ],
)
def test_bad_input_ends_with_status_2_and_one_line(arguments, messages, capsys):
    status, out, err = run(capsys, *arguments)
    assert status == 2
    assert out == ""
    assert err.count("\n") == 1
    for message in messages:
        assert message in err


def test_all_wrong_options_are_told_at_once(capsys):
    arguments = ["run", "npgr026", "--delta", "91", "--n1", "x", "--rho", "3 dge", "--case", "99"]
    status, _, err = run(capsys, *arguments)
    assert status == 2
    for part in ("'delta' is 91 deg", "--n1", "did you mean 'deg'", "case '99'"):
        assert part in err


@rows("as_json", [True, False])
def test_arrays_in_a_file_give_a_light_for_each_of_their_values(capsys, tmp_path, as_json):
    file = tmp_path / "arrays.toml"
    text = op.load_preset("malus").to_toml()
    text = text.replace('default = "30 deg"', 'default = ["0 deg", "30 deg", "60 deg"]')
    file.write_text(text, "utf-8")
    status, out, err = run(capsys, "run", str(file), *(["--json"] if as_json else []))
    assert (status, err) == (0, "")
    if as_json:
        found = json.loads(out)
        assert found["parameters"]["angle"] == [0.0, 30.0, 60.0]
        assert [row[0] for row in found["detectors"]["eye"]["stokes"]] == pytest.approx(
            [0.5, 0.375, 0.125]
        )
    else:
        assert "0.375" in out


def test_output_that_cannot_be_written_ends_with_one_line():
    with Path("/dev/full").open("w", encoding="utf-8") as full:
        done = subprocess.run(
            [sys.executable, "-m", "optipath", "run", "malus"],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    assert "cannot be written" in done.stderr


def test_several_faults_of_a_file_stand_on_a_line_each(capsys, tmp_path):
    file = tmp_path / "bad.toml"
    text = op.load_preset("malus").to_toml()
    file.write_text(text.replace("source", "sorce").replace("analyzer.in", "analyzer.inn"), "utf-8")
    status, out, err = run(capsys, "run", str(file))
    assert (status, out) == (2, "")
    assert err.splitlines() == [
        "optipath: bad.toml has 2 faults:",
        "- elements.lamp: element kind 'sorce' is unknown; did you mean 'source'?",
        "- links[1]: port 'analyzer.inn' does not exist; did you mean 'analyzer.in'?",
    ]


def test_one_fault_of_a_file_stands_on_one_line(capsys, tmp_path):
    file = tmp_path / "bad.toml"
    file.write_text(op.load_preset("malus").to_toml().replace("source", "sorce"), "utf-8")
    assert run(capsys, "run", str(file))[2] == (
        "optipath: bad.toml: elements.lamp: element kind 'sorce' is unknown; "
        "did you mean 'source'?\n"
    )


@rows("command", ["run", "explain", "bench", "chart", "polarization"])
@rows("word", ["--plot", "--n", "--n12"])
def test_an_option_that_is_near_to_none_has_no_suggestion(command, word, capsys):
    status, _, err = run(capsys, command, "npgr026", word, "3")
    assert status == 2
    assert f"option '{word}' is unknown; there are: --delta, --rho, --phi, --n1," in err


@rows(
    "arguments, message",
    [
        (
            ["run", "npgr026", "--detla", "3"],
            "option '--detla' is unknown; did you mean '--delta'?",
        ),
        (["--vrsion"], "option '--vrsion' is unknown; did you mean '--version'?"),
        (["rnu"], "command 'rnu' is unknown; did you mean 'run'?"),
        (["dance"], "command 'dance' is unknown; there are: accuracy, bench, cache,"),
    ],
)
def test_what_is_misspelt_is_suggested_and_all_else_is_listed(arguments, message, capsys):
    assert message in run(capsys, *arguments)[2]


@rows("command", ["run", "show", "explain"])
@rows("case", ["10", "0", "x"])
def test_an_unknown_case_lists_all_cases(command, case, capsys):
    _, _, err = run(capsys, command, "npgr026", "--case", case)
    assert err == (
        f"optipath: case '{case}' is unknown in preset 'npgr026'; "
        f"there are: 1, 2, 3, 4, 5, 6, 7, 8, 9\n"
    )


def test_the_name_of_an_axis_is_its_angle(capsys):
    lights = [
        json.loads(run(capsys, "run", "npgr026", "--filter", angle, "--json")[1])["detectors"]
        for angle in ("antidiagonal", "-45 deg")
    ]
    assert lights[0] == lights[1]


def test_a_complex_number_for_one_part_of_an_index_names_the_option_of_the_other(capsys):
    _, _, err = run(capsys, "run", "npgr026", "--n1", "0.17+3.15j")
    assert err == (
        "optipath: '0.17+3.15j' is complex, but --n1 takes a real number; give k by --k1\n"
    )
    assert "give n by --n2" in run(capsys, "run", "npgr026", "--k2", "0.17+3.15j")[2]


def test_a_parameter_named_like_an_option_is_refused(capsys, tmp_path):
    path = op.PathGraph()
    path.add("lamp", op.Source(op.Parameter("json", 1.0))) >> path.add("eye", op.Detector())
    file = tmp_path / "reserved.toml"
    file.write_text(path.to_toml(), "utf-8")
    status, _, err = run(capsys, "run", str(file))
    assert status == 2
    assert "'json'" in err


COMMAND = str(Path(sysconfig.get_path("scripts")) / "optipath")


@rows("command", [[COMMAND], [sys.executable, "-m", "optipath"]])
def test_the_command_is_installed(command):
    done = subprocess.run([*command, "--version"], capture_output=True, text=True, check=True)
    assert done.stdout.startswith("optipath")


def test_a_terminal_without_the_letters_gets_question_marks(tmp_path):
    file = tmp_path / "letters.toml"
    text = op.load_preset("malus").to_toml().replace("Malus's law", "Étienne Malus' law")
    file.write_text(text, "utf-8")
    for command in (["show", str(file)], ["run", str(file)], ["presets"]):
        done = subprocess.run(
            [sys.executable, "-m", "optipath", *command],
            capture_output=True,
            check=False,
            env={**os.environ, "PYTHONIOENCODING": "ascii"},
        )
        assert done.returncode == 0
        assert done.stderr == b""


def test_without_arguments_it_says_what_it_can_do(capsys):
    status, out, _ = run(capsys)
    assert status == 0
    assert "presets" in out


def test_chart_measures_draws_and_draws_again(tmp_path, capsys):
    out, data, again = (tmp_path / name for name in ("a.svg", "a.json", "b.svg"))
    chart = ["chart", "malus", "--angle", "20", "--engine", "numpy"]
    assert main([*chart, "--out", str(out), "--data", str(data)]) == 0
    measured = json.loads(data.read_text("utf-8"))
    assert measured["parameters"]["angle"] == "20 deg"
    assert main(["chart", "--from", str(data), "--out", str(again)]) == 0
    assert out.read_text("utf-8").count("<path") == again.read_text("utf-8").count("<path")
    assert "wrote" in capsys.readouterr().out


@rows(
    "arguments, message",
    [
        (["chart"], "PRESET is missing"),
        (["show"], "PRESET is missing; give a file or one of: absorbing-pile, "),
        (["chart", "--interface", "malus"], "leave it out"),
        (["chart", "--out", "x.png", "malus"], "behind the preset"),
        (["chart", "malus", "--out", "x.docx"], "ending"),
        (["chart", "malus", "--out", "nowhere/x.png"], "no such folder"),
        (["chart", "malus", "--angle", "north"], "angle"),
        (["chart", "--from", "nothing.json"], "nothing.json"),
        (["accuracy", "--samples", "0"], "samples"),
        (["accuracy", "--write", "nothing.md"], "nothing.md"),
    ],
)
def test_chart_and_accuracy_refuse_in_one_line(arguments, message, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(arguments) == 2
    captured = capsys.readouterr()
    assert captured.err.count("\n") == 1
    assert message in captured.err


def test_accuracy_prints_its_tables_and_writes_them_into_their_place(tmp_path, capsys):
    document = tmp_path / "accuracy.md"
    document.write_text("a <!-- tables: optipath accuracy --> b <!-- end of tables --> c", "utf-8")
    assert main(["accuracy", "--samples", "1", "--write", str(document)]) == 0
    text = document.read_text("utf-8")
    assert text.startswith("a <!-- tables")
    assert text.endswith("of tables --> c")
    assert "| exactly 90 deg | 0 | 0 | 0 |" in text
    assert main(["accuracy", "--samples", "1"]) == 0
    assert "exactly 90 deg" in capsys.readouterr().out


def test_accuracy_searches_for_worst_cases_and_writes_them_into_their_place(tmp_path, monkeypatch):
    monkeypatch.setattr("optipath.lab.accuracy.tables.REGIONS", REGIONS[:1])
    document = tmp_path / "accuracy.md"
    begin, end = SEARCHED
    document.write_text(f"a {begin} b {end} c", "utf-8")
    assert main(["accuracy", "--search", "1", "--write", str(document)]) == 0
    text = document.read_text("utf-8")
    assert text.startswith(f"a {begin}")
    assert "Worst cases found of compensated, float64" in text
    assert text.count("| generic |") == 3


def test_a_feature_whose_extra_is_missing_says_which(monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "mpmath", None)
    for name in [name for name in sys.modules if name.startswith("optipath.lab.accuracy")]:
        monkeypatch.delitem(sys.modules, name)
    assert main(["accuracy", "--samples", "1"]) == 2
    assert 'pip install "optipath[chart]"' in capsys.readouterr().err


def test_files_that_are_no_text_are_refused_in_one_line(tmp_path, capsys):
    file = tmp_path / "x"
    file.write_bytes(b"\xff\xfe")
    for arguments in (["chart", "--from", str(file)], ["accuracy", "--write", str(file)]):
        assert main(arguments) == 2
        assert capsys.readouterr().err.endswith("is no text in UTF-8\n")


def test_a_picture_and_its_data_need_two_files(capsys):
    assert main(["chart", "malus", "--out", "a.svg", "--data", "a.svg"]) == 2
    assert "give two files" in capsys.readouterr().err


def test_faint_light_is_told_beside_the_zeros(tmp_path, capsys):
    path = op.PathGraph()
    node = path.add("lamp", op.Source())
    for name in ("a", "b"):
        node = node >> path.add(name, op.Attenuator(1e-200))
    node >> path.add("eye", op.Detector())
    file = tmp_path / "faint.toml"
    file.write_text(path.to_toml(), "utf-8")
    assert main(["run", str(file), "--json"]) == 0
    light = json.loads(capsys.readouterr().out)["detectors"]["eye"]
    assert light["log10_intensity"] == pytest.approx(-400)
    assert light["normalized"] == [1, 0, 0, 0]
    assert main(["run", str(file)]) == 0
    assert "log10 S0" in capsys.readouterr().out


def test_a_warning_is_one_line_on_standard_error(capsys):
    assert main(["run", "glass-slab", "--theta", "89.9999"]) == 0
    (line,) = capsys.readouterr().err.strip().splitlines()
    assert line.startswith("optipath: of the light that goes round at 'front.transmitted'")


def test_run_tells_psi_and_delta_of_the_light(capsys):
    assert main(["run", "ellipsometer-pcsa", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)["detectors"]["state"]["polarization"]
    # Silicon at 70 degrees, by r_p / r_s of the textbooks.
    assert told["Psi"] == pytest.approx(10.5726710654, abs=1e-9)
    assert told["Delta"] == pytest.approx(179.229814133, abs=1e-9)
    angles = ["aop", "ellipticity_angle", "Psi", "Delta"]
    assert told["units"] == dict.fromkeys(angles, "deg")


def test_complex_numbers_are_read_and_told_as_what_they_are(capsys, tmp_path):
    file = tmp_path / "mirror.toml"
    path = op.PathGraph()
    mirror = path.add("mirror", op.Mirror(-1.0, op.Parameter("r", 0.3 + 0.4j)))
    gold = path.add("gold", op.Interface(op.Parameter("m", 0.2 + 3j), 0.5))
    path.add("lamp", op.Source()) >> mirror >> gold >> path.add("eye", op.Detector())
    file.write_text(path.to_toml())
    _, out, _ = run(capsys, "run", str(file), "--r=-0.3+0.2j", "--json")
    told = json.loads(out)["parameters"]
    assert told == {"r": {"re": -0.3, "im": 0.2}, "m": {"n": 0.2, "k": 3.0}}


def test_the_cache_of_compiled_code_is_shown_and_cleared(capsys, tmp_path, monkeypatch):
    monkeypatch.setenv("OPTIPATH_CACHE", str(tmp_path / "cache"))
    monkeypatch.setenv("OPTIPATH_CACHE_BYTES", "5000")
    (tmp_path / "cache").mkdir(mode=0o700)
    (tmp_path / "cache" / "one.code").write_bytes(bytes(1234))
    shown = {"folder": str(tmp_path / "cache"), "entries": 1, "bytes": 1234, "limit": 5000}
    assert json.loads(run(capsys, "cache", "--json")[1]) == shown
    _, out, _ = run(capsys, "cache")
    assert str(tmp_path / "cache") in out
    assert "1,234" in out
    assert "removed 1 " in run(capsys, "cache", "--clear")[1]
    assert json.loads(run(capsys, "cache", "--json")[1])["entries"] == 0


def test_trouble_with_the_cache_is_one_line(capsys, tmp_path, monkeypatch):
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv("OPTIPATH_CACHE", str(tmp_path / "file"))
    for arguments in (["cache"], ["cache", "--clear"], ["cache", "--json"]):
        status, out, err = run(capsys, *arguments)
        assert (status, out) == (2, "")
        assert "is no folder" in err
        assert err.count("\n") == 1

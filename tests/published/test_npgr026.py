import json
from decimal import Decimal

import numpy as np
import pytest

import optipath as op
from optipath.cli import main
from published import npgr026

CASES = sorted(npgr026.VALUES)


def exact(case):
    return np.array([float(component) for component in npgr026.EXACT[case]])


def relative_error(stokes, case):
    return np.max(np.abs(stokes - exact(case))) / exact(case)[0]


def in_radians(values):
    angles = {name: np.radians(values[name]) for name in ("delta", "rho", "phi")}
    return {**values, **angles}


def command(case):
    options = [f"--{name}={value!r}" for name, value in npgr026.VALUES[case].items()]
    return ["run", "npgr026", *[option.replace("'", "") for option in options], "--json"]


def tolerance(case):
    # Case 3 lives off two reflections next to Brewster's angle.
    return 1e-12 if case == "3" else 1e-13


@pytest.mark.parametrize("case", CASES)
def test_a_named_case_agrees_with_the_exact_value(case):
    stokes = op.load_preset("npgr026", case=case).trace().stokes
    assert relative_error(stokes, case) <= tolerance(case)


@pytest.mark.parametrize("case", CASES)
def test_values_given_when_loading_agree_with_the_exact_value(case):
    path = op.load_preset("npgr026", **in_radians(npgr026.VALUES[case]))
    assert relative_error(path.trace().stokes, case) <= tolerance(case)


@pytest.mark.parametrize("case", CASES)
def test_values_given_when_tracing_agree_with_the_exact_value(case):
    stokes = op.load_preset("npgr026").trace(**in_radians(npgr026.VALUES[case])).stokes
    assert relative_error(stokes, case) <= tolerance(case)


@pytest.mark.parametrize("case", CASES)
def test_the_textbook_method_agrees_save_what_it_loses_in_case_3(case):
    plan = op.Composer(method="textbook").compose(op.load_preset("npgr026", case=case))
    error = relative_error(plan.run().stokes, case)
    if case == "3":
        assert error < 5e-11, "documented in docs/methods.md"
    else:
        assert error <= 1e-11


@pytest.mark.parametrize("case", CASES)
def test_the_command_line_agrees_with_the_exact_value(case, capsys):
    assert main(command(case)) == 0
    found = json.loads(capsys.readouterr().out)
    assert relative_error(np.array(found["detectors"]["E"]["stokes"]), case) <= tolerance(case)


@pytest.mark.parametrize("case", CASES)
def test_the_command_line_case_shows_the_published_value_beside_the_computed_one(case, capsys):
    assert main(["run", "npgr026", "--case", case, "--json"]) == 0
    reading = json.loads(capsys.readouterr().out)["detectors"]["E"]
    assert reading["published"] == [float(digits) for digits in npgr026.PUBLISHED[case]]
    for position, digits in enumerate(npgr026.PUBLISHED[case]):
        printed = Decimal(digits)
        half_a_unit = 0.5 * 10.0 ** printed.as_tuple().exponent
        if case == "3" and position == 1:
            printed = -printed  # The misprint.
        assert abs(reading["stokes"][position] - float(printed)) <= half_a_unit


def test_the_misprints_are_noted_in_the_preset():
    cases = op.load_preset("npgr026").cases
    assert "sign" in cases["3"].note
    assert all("0.666" in cases[case].note for case in "456")
    assert not any(cases[case].note for case in "12")


def test_the_metals_are_named_with_what_tables_have_of_them_and_make_of_the_cases():
    """Figures of refractiveindex.info at 516 nm: Cu and Au of Johnson and Christy."""
    copper, gold = 1.18784 + 2.599376j, 0.70232 + 2.032392j
    tables = {"n1": copper.real, "k1": copper.imag, "n2": gold.real, "k2": gold.imag}
    for case in "789":
        path = op.load_preset("npgr026", case=case)
        note = path.cases[case].note
        assert "X1 is copper and X2 gold, at 516 nm" in note
        for index in (copper, gold):
            assert f"{index.real:.3f}+{index.imag:.3f}i" in note
        assert f"{float(path.trace(**tables).intensity):.3f}" in note


def test_all_nine_cases_run_as_one_batch():
    rows = [in_radians(npgr026.VALUES[case]) for case in CASES]
    columns = {name: [row[name] for row in rows] for name in rows[0]}
    stokes = op.load_preset("npgr026").trace(**columns).stokes
    assert stokes.shape == (9, 4)
    for row, case in zip(stokes, CASES, strict=True):
        assert relative_error(row, case) <= tolerance(case)

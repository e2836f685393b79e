"""The published tables are what their commands write, and right."""

import json
import re
import subprocess
import sys
from decimal import Decimal
from pathlib import Path

import numpy as np
import pytest

import optipath as op
from optipath.lab.accuracy.mueller_table import mueller_table
from optipath.lab.accuracy.regions import REGIONS
from optipath.lab.accuracy.tables import BEGIN, END, SEARCHED, put_tables, tables
from optipath.light.conventions import CONVENTIONS
from published import npgr026
from tables import rows

ROOT = Path(__file__).parents[2]
ACCURACY = (ROOT / "docs" / "accuracy.md").read_text("utf-8")
FILE = ROOT / "docs" / "reference-mueller-matrices.json"
TABLE = json.loads(FILE.read_text("utf-8"))
EXACT = json.loads(FILE.read_text("utf-8"), parse_float=Decimal)["matrices"]
MATRICES = {entry["name"]: entry for entry in TABLE["matrices"]}


def numbers(text):
    """The errors of a text, by row; infinity where all is lost."""
    words = [word.strip("*") for word in re.findall(r"\| ([^|\n]*) (?=\|)", text)]
    return [float(word) if re.fullmatch(r"[\d.e]+", word) else word for word in words]


@pytest.mark.parametrize("count", [2, pytest.param(200, marks=pytest.mark.report)])
def test_the_published_tables_are_true(count):
    # Digits may differ from one platform's cosine to another's, but not what holds.
    fresh = put_tables(ACCURACY, tables(count))
    old, new = (numbers(text.split(BEGIN)[1].split(END)[0]) for text in (ACCURACY, fresh))
    assert len(old) == len(new) > 300
    for before, now in zip(old, new, strict=True):
        if isinstance(before, str) or isinstance(now, str):
            assert before == now or count < 200
        elif count < 200:  # Fewer samples find no larger errors.
            assert now <= 1.5 * before + 0.3
        elif before < 1000 or now < 1000:  # They do not both fail.
            assert abs(before - now) <= 0.5 * max(before, now) + 0.3


def test_the_published_worst_cases_are_within_the_promised_limits_and_have_a_place():
    found = ACCURACY.split(SEARCHED[0])[1].split(SEARCHED[1])[0]
    stable, single, compensated = found.split("Worst cases found of ")[1:]
    for text, limit in ((stable, 20.0), (single, 20.0), (compensated, 1.5)):
        errors = [word for word in numbers(text) if isinstance(word, float)]
        assert len(errors) == (len(REGIONS) + 1) * 8  # and anywhere
        assert max(errors) <= limit
    with pytest.raises(op.OptipathError, match="no place"):
        put_tables("# Accuracy", [])


def test_the_file_of_mueller_matrices_is_what_its_command_writes():
    assert FILE.read_text("utf-8") == mueller_table()
    command, file = TABLE["made by"].split(" > ")
    _, *arguments = command.split()
    done = subprocess.run([sys.executable, *arguments], capture_output=True, text=True, check=True)
    assert done.stdout == (ROOT / file).read_text("utf-8")
    # Names are unique, numbers have twenty digits, and the page counts the matrices.
    assert len(MATRICES) == len(TABLE["matrices"])
    entries = [number for entry in EXACT for row in entry["mueller"] for number in row]
    assert max(len(number.normalize().as_tuple().digits) for number in entries) == 20
    page = (ROOT / "docs" / "other-software.md").read_text("utf-8")
    assert f"{len(MATRICES)} Mueller matrices with 20 digits" in page


@rows("case", sorted(npgr026.EXACT))
def test_the_matrix_of_a_case_gives_the_published_light(case):
    (entry,) = (e for e in EXACT if e["name"] == f"npgr026, case {case}")
    for row, component in zip(entry["mueller"], npgr026.EXACT[case], strict=True):
        difference = abs(100 * row[0] - Decimal(component))
        assert difference <= Decimal("1e-19") * Decimal(npgr026.EXACT[case][0])


def asked(step):
    return step["n"], step.get("k", 0), step.get("outside", 1), step.get("incidence")


def test_figures_and_signs_of_other_software_are_those_of_the_table():
    figures = json.loads((ROOT / "tests/peers/figures/pypolar.json").read_text("utf-8"))
    signs = np.array(TABLE["signs"]["pypolar"])
    of_one = [entry for entry in TABLE["matrices"] if len(entry["steps"]) == 1]
    alone = {
        asked(entry["steps"][0]): entry["mueller"]
        for entry in of_one
        if entry["steps"][0]["does"] == "reflection"
    }
    for setup in figures["reflection"]:
        found = np.array(alone[asked(setup)]) * np.outer(signs, signs)
        np.testing.assert_allclose(setup["mueller"], found, rtol=0, atol=1e-14)
    assert len(figures["reflection"]) >= 5
    said = {name: tuple(signs) for name, signs in TABLE["signs"].items() if name != "description"}
    assert said == {name: convention.signs for name, convention in CONVENTIONS.items()}


def element(does, n=1.0, k=0.0, outside=1.0, incidence=0.0, tan_incidence=None, angle=0.0, **rest):
    """The element that a step is, as a user writes it."""
    radians = np.radians(incidence) if tan_incidence is None else np.arctan(tan_incidence)
    turned = np.radians(angle)
    match does:
        case "reflection" | "transmission":
            return op.Interface(complex(n, k) if k else n, radians, outside=outside)
        case "faraday rotator":
            return op.FaradayRotator(**rest)
        case "waveplate":
            thickness, wavelength = (f"{rest[name]} um" for name in ("thickness", "wavelength"))
            return op.Waveplate(thickness, rest["birefringence"], wavelength, turned)
        case "circular polarizer":
            return op.CircularPolarizer("right" if rest.pop("handedness") > 0 else "left", **rest)
        case "polarizer":
            return op.Polarizer(turned, **rest)
        case "retarder":
            return op.Retarder(np.radians(rest["retardance"]), turned)
    if does.endswith("by layers"):
        return op.LayerStack([complex(*pair) for pair in rest["indices"]], radians)
    if does.endswith("polarizing beam splitter"):
        return op.PolarizingBeamSplitter(**rest)
    return op.Rotator(turned if does == "rotator" else -turned)


@rows("name", MATRICES)
def test_elements_have_the_matrices_of_the_table(name):
    found = np.eye(4)
    for step in MATRICES[name]["steps"]:
        splits = "beam splitter" in step["does"]
        way = "transmitted" if step["does"].startswith("transmission") else splits and "reflected"
        met = element(**step)
        part = met.mueller("in", way) if way else met.mueller()
        found = part.matrix @ found
    # Degrees are rounded when they become radians.
    np.testing.assert_allclose(found, MATRICES[name]["mueller"], rtol=0, atol=2e-15)

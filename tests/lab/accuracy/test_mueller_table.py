"""The table of reference Mueller matrices: what its command writes, and right."""

import json
import subprocess
import sys
from decimal import Decimal
from pathlib import Path

import numpy as np
import pytest

import optipath as op
from optipath.lab.accuracy.mueller_table import mueller_table
from optipath.light.conventions import CONVENTIONS
from published import npgr026

ROOT = Path(__file__).parents[3]
FILE = ROOT / "docs" / "reference-mueller-matrices.json"
TABLE = json.loads(FILE.read_text("utf-8"))
MATRICES = {entry["name"]: entry for entry in TABLE["matrices"]}


def test_the_file_is_what_its_command_writes():
    assert FILE.read_text("utf-8") == mueller_table()
    command, file = TABLE["made by"].split(" > ")
    _, *arguments = command.split()
    done = subprocess.run([sys.executable, *arguments], capture_output=True, text=True, check=True)
    assert done.stdout == (ROOT / file).read_text("utf-8")


def test_names_are_unique_and_numbers_have_twenty_digits():
    assert len(MATRICES) == len(TABLE["matrices"])
    exact = json.loads(FILE.read_text("utf-8"), parse_float=Decimal)
    digits = [
        len(number.normalize().as_tuple().digits)
        for entry in exact["matrices"]
        for row in entry["mueller"]
        for number in row
    ]
    assert max(digits) == 20


def test_the_page_says_how_many_there_are():
    page = (ROOT / "docs" / "other-software.md").read_text("utf-8")
    assert f"{len(MATRICES)} Mueller matrices with 20 digits" in page


@pytest.mark.parametrize("case", sorted(npgr026.EXACT))
def test_the_matrix_of_a_case_gives_the_published_light(case):
    exact = json.loads(FILE.read_text("utf-8"), parse_float=Decimal)
    (entry,) = (e for e in exact["matrices"] if e["name"] == f"npgr026, case {case}")
    for row, component in zip(entry["mueller"], npgr026.EXACT[case], strict=True):
        difference = abs(100 * row[0] - Decimal(component))
        assert difference <= Decimal("1e-19") * Decimal(npgr026.EXACT[case][0])


def test_figures_of_other_software_are_those_of_the_table():
    figures = json.loads((ROOT / "tests/peers/figures/pypolar.json").read_text("utf-8"))
    signs, compared = np.array(TABLE["signs"]["pypolar"]), 0
    known = {}
    for entry in TABLE["matrices"]:
        if len(entry["steps"]) == 1 and entry["steps"][0]["does"] == "reflection":
            (step,) = entry["steps"]
            asked = step["n"], step.get("k", 0), step.get("outside", 1), step.get("incidence")
            known[asked] = np.array(entry["mueller"])
    for setup in figures["reflection"]:
        asked = setup["n"], setup["k"], setup.get("outside", 1), setup["incidence"]
        found = known[asked] * np.outer(signs, signs)
        np.testing.assert_allclose(setup["mueller"], found, rtol=0, atol=1e-14)
        compared += 1
    assert compared >= 5


def test_the_signs_of_the_table_are_those_of_the_conventions():
    said = {name: tuple(signs) for name, signs in TABLE["signs"].items() if name != "description"}
    assert said == {name: convention.signs for name, convention in CONVENTIONS.items()}


def element(does, n=1.0, k=0.0, outside=1.0, incidence=0.0, tan_incidence=None, angle=0.0, **rest):
    """The element that a step is, as a user writes it."""
    radians = np.radians(incidence) if tan_incidence is None else np.arctan(tan_incidence)
    turned = np.radians(angle)
    if does in ("reflection", "transmission"):
        return op.Interface(complex(n, k) if k else n, radians, outside=outside)
    if does.endswith("by layers"):
        return op.LayerStack([complex(*pair) for pair in rest["indices"]], radians)
    if does.endswith("polarizing beam splitter"):
        return op.PolarizingBeamSplitter(**rest)
    if does == "faraday rotator":
        return op.FaradayRotator(**rest)
    if does == "waveplate":
        thickness, wavelength = (f"{rest[name]} um" for name in ("thickness", "wavelength"))
        return op.Waveplate(thickness, rest["birefringence"], wavelength, turned)
    if does == "circular polarizer":
        return op.CircularPolarizer("right" if rest.pop("handedness") > 0 else "left", **rest)
    if does == "polarizer":
        return op.Polarizer(turned, **rest)
    if does == "retarder":
        return op.Retarder(np.radians(rest["retardance"]), turned)
    return op.Rotator(turned if does == "rotator" else -turned)


@pytest.mark.parametrize("name", MATRICES)
def test_elements_have_the_matrices_of_the_table(name):
    found = np.eye(4)
    for step in MATRICES[name]["steps"]:
        splits = "beam splitter" in step["does"]
        way = "transmitted" if step["does"].startswith("transmission") else splits and "reflected"
        met = element(**step)
        part = met.mueller("in", way) if way else met.mueller()
        found = part.matrix @ found
    expected = MATRICES[name]["mueller"]
    # Degrees are rounded when they become radians.
    np.testing.assert_allclose(found, expected, rtol=0, atol=2e-15)

"""What other software computes and books print, against ours in their conventions.

The scripts in `computing/` have made the files in `figures/`, but for Hecht's, which are quoted.
"""

import json
from pathlib import Path

import numpy as np
import pytest

import optipath as op
from optipath.light.conventions import CONVENTIONS
from tables import rows

FIGURES = Path(__file__).parent / "figures"
P_ALONG_X = ("ellipsometry", "pyelli", "pypolar")
PLUS_45 = op.Light([1.0, 0.0, 1.0, 0.0])
FILES = {name: json.loads((FIGURES / f"{name}.json").read_text("utf-8")) for name in CONVENTIONS}


def figures(kind):
    """Each answer of a kind: its convention, what was asked, and how many digits it has."""
    answers = [(name, file["precision"], file.get(kind, [])) for name, file in FILES.items()]
    every = [(name, each, precision) for name, precision, found in answers for each in found]
    return rows("name, setup, precision", every)


def azimuth(name, degrees):
    """An azimuth of ours: from s, where theirs may be from p, which is 90 degrees further."""
    return np.radians(degrees + (90.0 if name in P_ALONG_X else 0.0))


def interface(_, setup, leaves="reflected"):
    index = complex(setup["n"], setup["k"]) if setup["k"] else setup["n"]
    incidence, outside = np.radians(setup["incidence"]), setup.get("outside", 1.0)
    return op.Interface(index, incidence, outside=outside).mueller("in", leaves)


def over_m00(name, setup):
    matrix = interface(name, setup).matrix
    return op.Mueller(matrix / matrix[0, 0])


def transmission(name, setup):
    return interface(name, setup, "transmitted")


def polarizer(name, setup):
    return op.Polarizer(azimuth(name, setup["angle"])).mueller()


def retarder(name, setup):
    """Its angle is that of the fast axis."""
    return op.Retarder(np.radians(setup["retardance"]), azimuth(name, setup["angle"])).mueller()


def circular(_, setup):
    # S3 > 0 of ours is counter-clockwise to who looks at the source (test_conventions.py).
    return op.Light([1.0, 0.0, 0.0, -1.0 if setup["clockwise"] else 1.0])


def ellipse(name, setup):
    along, round_ = 2.0 * azimuth(name, setup["azimuth"]), 2.0 * np.radians(setup["ellipticity"])
    s3 = (-1.0 if setup["clockwise"] else 1.0) * np.sin(round_)
    flat = np.cos(round_)
    return op.Light([1.0, flat * np.cos(along), flat * np.sin(along), s3])


def agree(found, expected, precision):
    np.testing.assert_allclose(found, expected, rtol=0, atol=precision)


def agree_both_ways(name, ours, theirs, precision):
    """Ours in their convention is theirs, and theirs in ours is ours."""
    agree(ours.to(name), theirs, precision)
    if isinstance(ours, op.Light):
        # Light is judged by the rounding of the numbers that it is given in.
        given = np.array(theirs, np.float32 if precision > 1e-7 else np.float64)
        agree(op.Light.from_(name, given).stokes, ours.stokes, precision)
    else:
        agree(op.Mueller.from_(name, theirs).matrix, ours.matrix, precision)


def test_every_convention_has_figures_that_say_how_they_were_made():
    assert {path.stem for path in FIGURES.glob("*.json")} == {*CONVENTIONS}
    for file in FILES.values():
        assert file["software"]
        script = file["made by"].removeprefix("python ")
        assert script == "hand" or (Path(__file__).parents[2] / script).is_file()


@pytest.mark.parametrize(
    ("kind", "made"),
    [
        ("reflection", interface),
        ("normalized_reflection", over_m00),
        ("transmission", transmission),
        ("polarizer", polarizer),
        ("retarder", retarder),
        ("circular", circular),
        ("elliptical", ellipse),
    ],
)
def test_matrices_and_states_are_those_of_the_software(kind, made):
    @figures(kind)
    def each(name, setup, precision):
        theirs = setup["stokes" if "stokes" in setup else "mueller"]
        agree_both_ways(name, made(name, setup), theirs, precision)

    each()


@figures("turned_frame")
def test_numbers_in_a_turned_frame_are_those_of_the_software(name, setup, precision):
    turned = op.Frame().turned(np.radians(setup["angle"]))
    for stokes in np.array([[1, 1, 0, 0], [1, 0, 1, 0], [1, 0, 0, 1.0]]):
        expected = np.array(setup["mueller"]) @ stokes
        light = op.Light.from_(name, stokes).in_frame(turned)
        agree(light.to(name), expected, precision)


@figures("reflected_at_45")
def test_light_of_45_degrees_is_reflected_as_the_books_have_it(name, setup, precision):
    # +45 degrees from p is -45 degrees from s.
    found = (interface(name, setup) @ op.Light([1.0, 0.0, -1.0, 0.0])).to(name)
    agree(found / found[0], setup["stokes"], precision)


@figures("psi_delta")
def test_psi_and_delta_are_those_of_the_software(name, setup, precision):
    psi, delta = setup["angles"]
    ours = interface(name, setup)
    for found in (ours, ours @ PLUS_45):
        own_psi, own_delta = found.ellipsometric_angles(name)
        agree(own_psi, psi, precision)
        # 180 degrees is -180 degrees.
        agree(np.exp(1j * own_delta), np.exp(1j * delta), precision)


@figures("amplitudes")
def test_a_reflection_is_made_of_the_amplitudes_of_the_software(name, setup, precision):
    r_s, r_p = (complex(*parts) for parts in setup["r"])
    ours = interface(name, setup)
    agree_both_ways(name, ours, op.Mirror(r_s, r_p).mueller().matrix, precision)
    _, _, s2, s3 = (ours @ PLUS_45).to(name)
    # Delta of tmm.ellips is the phase of -r_p / r_s.
    agree(complex(s2, s3), -r_p * r_s.conjugate(), precision)

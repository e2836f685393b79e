"""What other software computes and books print, against ours in their conventions.

The scripts in `computing/` have made the files in `figures/`, but for Hecht's, which are quoted.
"""

import json
from pathlib import Path

import numpy as np
import pytest

import optipath as op
from optipath.light.conventions import CONVENTIONS

FIGURES = Path(__file__).parent / "figures"
P_ALONG_X = ("ellipsometry", "pyelli", "pypolar")
PLUS_45 = op.Light([1.0, 0.0, 1.0, 0.0])


def asked(kind):
    """Each answer of a kind: its convention, what was asked, and how many digits it has."""
    for name in sorted(CONVENTIONS):
        figures = json.loads((FIGURES / f"{name}.json").read_text("utf-8"))
        for number, setup in enumerate(figures.get(kind, [])):
            yield pytest.param(name, setup, figures["precision"], id=f"{name}-{number}")


def figures(kind):
    return pytest.mark.parametrize(("name", "setup", "precision"), list(asked(kind)))


def azimuth(name, degrees):
    """An azimuth of ours: from s, where theirs may be from p, which is 90 degrees further."""
    return np.radians(degrees + (90.0 if name in P_ALONG_X else 0.0))


def interface(setup, leaves="reflected"):
    index = complex(setup["n"], setup["k"]) if setup["k"] else setup["n"]
    incidence, outside = np.radians(setup["incidence"]), setup.get("outside", 1.0)
    return op.Interface(index, incidence, outside=outside).mueller("in", leaves)


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
    for path in FIGURES.glob("*.json"):
        figures = json.loads(path.read_text("utf-8"))
        assert figures["software"]
        script = figures["made by"].removeprefix("python ")
        assert script == "hand" or (Path(__file__).parents[2] / script).is_file()


@figures("reflection")
def test_a_reflection_is_that_of_the_software(name, setup, precision):
    agree_both_ways(name, interface(setup), setup["mueller"], precision)


@figures("normalized_reflection")
def test_a_reflection_over_m00_is_that_of_the_software(name, setup, precision):
    ours = interface(setup)
    whole = op.Mueller(ours.matrix / ours.matrix[0, 0])
    agree_both_ways(name, whole, setup["mueller"], precision)


@figures("transmission")
def test_a_transmission_is_that_of_the_software(name, setup, precision):
    agree_both_ways(name, interface(setup, "transmitted"), setup["mueller"], precision)


@figures("polarizer")
def test_a_polariser_at_an_angle_is_that_of_the_software(name, setup, precision):
    ours = op.Polarizer(azimuth(name, setup["angle"])).mueller()
    agree_both_ways(name, ours, setup["mueller"], precision)


@figures("retarder")
def test_a_retarder_by_its_fast_axis_is_that_of_the_software(name, setup, precision):
    angles = np.radians(setup["retardance"]), azimuth(name, setup["angle"])
    agree_both_ways(name, op.Retarder(*angles).mueller(), setup["mueller"], precision)


@figures("turned_frame")
def test_numbers_in_a_turned_frame_are_those_of_the_software(name, setup, precision):
    turned = op.Frame().turned(np.radians(setup["angle"]))
    for stokes in np.array([[1, 1, 0, 0], [1, 0, 1, 0], [1, 0, 0, 1.0]]):
        expected = np.array(setup["mueller"]) @ stokes
        light = op.Light.from_(name, stokes).in_frame(turned)
        agree(light.to(name), expected, precision)


@figures("circular")
def test_circular_light_has_the_sign_that_the_software_gives_its_hand(name, setup, precision):
    # S3 > 0 of ours is counter-clockwise to who looks at the source (test_conventions.py).
    ours = op.Light([1.0, 0.0, 0.0, -1.0 if setup["clockwise"] else 1.0])
    agree_both_ways(name, ours, setup["stokes"], precision)


@figures("elliptical")
def test_an_ellipse_has_the_numbers_of_the_software(name, setup, precision):
    along = 2.0 * azimuth(name, setup["azimuth"])
    flat = np.cos(2.0 * np.radians(setup["ellipticity"]))
    round_ = np.sin(2.0 * np.radians(setup["ellipticity"]))
    sign = -1.0 if setup["clockwise"] else 1.0
    ours = op.Light([1.0, flat * np.cos(along), flat * np.sin(along), sign * round_])
    agree_both_ways(name, ours, setup["stokes"], precision)


@figures("reflected_at_45")
def test_light_of_45_degrees_is_reflected_as_the_books_have_it(name, setup, precision):
    # +45 degrees from p is -45 degrees from s.
    light = interface(setup) @ op.Light([1.0, 0.0, -1.0, 0.0])
    found = light.to(name)
    agree(found / found[0], setup["stokes"], precision)


@figures("psi_delta")
def test_psi_and_delta_are_those_of_the_software(name, setup, precision):
    psi, delta = setup["angles"]
    ours = interface(setup)
    for found in (ours, ours @ PLUS_45):
        own_psi, own_delta = found.ellipsometric_angles(name)
        agree(own_psi, psi, precision)
        # 180 degrees is -180 degrees.
        agree(np.exp(1j * own_delta), np.exp(1j * delta), precision)


@figures("amplitudes")
def test_a_reflection_is_made_of_the_amplitudes_of_the_software(name, setup, precision):
    r_s, r_p = (complex(*parts) for parts in setup["r"])
    mirror = op.Mirror(r_s, r_p).mueller().matrix
    agree_both_ways(name, interface(setup), mirror, precision)


@figures("amplitudes")
def test_reflected_light_is_that_of_which_the_software_takes_delta(name, setup, precision):
    r_s, r_p = (complex(*parts) for parts in setup["r"])
    light = interface(setup) @ PLUS_45
    _, _, s2, s3 = light.to(name)
    # Delta of tmm.ellips is the phase of -r_p / r_s.
    agree(complex(s2, s3), -r_p * r_s.conjugate(), precision)

"""What other software computes and books print, against ours in their conventions.

The scripts in `computing/` have made the files in `figures/`, but for Hecht's, which are quoted.
"""

import json
from functools import partial
from pathlib import Path

import numpy as np
import pytest

import measured_tables
import optipath as op
from measured_tables import FLIPPED
from optipath.light.conventions import CONVENTIONS
from tables import rows

FIGURES = Path(__file__).parent / "figures"
P_ALONG_X = ("ellipsometry", "pyelli", "pypolar")
PLUS_45 = op.Light([1.0, 0.0, 1.0, 0.0])


def read(name):
    return json.loads((FIGURES / f"{name}.json").read_text("utf-8"))


FILES = {name: read(name) for name in CONVENTIONS}
STACKS, TABLES = read("stacks/tmm"), read("tables/mitsuba")


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


def polarizer(name, setup):
    return op.Polarizer(azimuth(name, setup["angle"])).mueller()


def retarder(name, setup):
    """Its angle is that of the fast axis."""
    return op.Retarder(np.radians(setup["retardance"]), azimuth(name, setup["angle"])).mueller()


MADE = {
    "reflection": interface,
    "normalized_reflection": over_m00,
    "transmission": partial(interface, leaves="transmitted"),
    "polarizer": polarizer,
    "retarder": retarder,
    # S3 > 0 of ours is counter-clockwise to who looks at the source (test_conventions.py).
    "circular": lambda _, setup: op.Light([1.0, 0.0, 0.0, -1.0 if setup["clockwise"] else 1.0]),
    "elliptical": ellipse,
}


@pytest.mark.parametrize("kind", MADE)
def test_matrices_and_states_are_those_of_the_software(kind):
    @figures(kind)
    def each(name, setup, precision):
        theirs = setup["stokes" if "stokes" in setup else "mueller"]
        agree_both_ways(name, MADE[kind](name, setup), theirs, precision)

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


PORTS = ("reflected", "transmitted")


@pytest.mark.filterwarnings("ignore::optipath.errors.CoherenceWarning")  # Of films, on purpose.
@rows("setup", STACKS["shares"])
def test_a_stack_shares_light_out_as_that_of_tmm(setup):
    layers = [complex(*index) for index in setup["indices"]]
    media = [setup.get("front", 1.0), *layers, complex(*setup.get("substrate", [1.0, 0.0]))]
    lengths = [length * 1e-9 for length in setup["lengths"]]
    incidence = np.radians(setup["incidence"])
    stack = op.LayerStack(media, incidence, lengths=lengths, wavelength=500e-9)
    reflected, transmitted = (stack.mueller("in", port).matrix[0, :2] for port in PORTS)
    for share, sign in zip(setup["shares"], (1.0, -1.0), strict=True):
        absorbed = stack.absorbed([1.0, sign, 0.0, 0.0])
        ours = [reflected @ [1.0, sign], *absorbed, transmitted @ [1.0, sign]]
        np.testing.assert_allclose(ours, share, rtol=0.0, atol=STACKS["precision"])


@rows("setup", STACKS["powers"])
def test_a_face_lit_from_an_absorbing_medium_has_the_powers_of_tmm(setup):
    behind, front = complex(*setup["behind"]), complex(*setup["front"])
    incidence = np.radians(setup["incidence"])
    face = op.Interface(behind, incidence, outside=front, incidence_in=1.0)
    lines = [face.mueller("in", port).matrix[0, :2] for port in PORTS]
    ours = [[line @ [1.0, sign] for line in lines] for sign in (1.0, -1.0)]
    np.testing.assert_allclose(ours, setup["powers"], rtol=0.0, atol=STACKS["precision"])


def test_mitsuba_reads_from_a_table_what_was_written_and_nearly_the_brdf(tmp_path):
    table, file = TABLES["table"], tmp_path / "metal.pbsdf"
    metal = op.Material.tabulated(table["wavelengths"], table["n"], table["k"])
    brdf = partial(op.surfaces.single_scattering, metal, table["alpha"])
    given = {"wavelengths": table["tabulated"], "shape": tuple(table["shape"])}
    op.surfaces.write_measured_polarized(file, brdf, **given)
    arrays = measured_tables.read(file)
    brightest = max(each["mueller"][0][0] for each in TABLES["evaluated"])
    for each in TABLES["evaluated"]:
        light, eye, wavelength = np.array(each["light"]), np.array(each["eye"]), each["wavelength"]
        ways, bases = (-light, eye), (np.array(each["basis_in"]), np.array(each["basis_out"]))
        frames = map(op.Frame.from_direction, ways, bases)
        into, out = (op.Mueller(np.eye(4), frame, frame) for frame in frames)
        found = measured_tables.look_up(arrays, light, eye, wavelength)
        own = [op.Frame.from_direction(z, np.cross(light, eye)) for z in ways]
        turned = out @ op.Mueller(FLIPPED @ found @ FLIPPED, *own) @ into
        ours = FLIPPED @ turned.matrix @ FLIPPED * light[2]
        np.testing.assert_allclose(ours, each["mueller"], rtol=0.0, atol=TABLES["precision"])
        # The table is coarse.
        exact = (out @ brdf(*ways, wavelength=wavelength * 1e-9) @ into).to("mitsuba") * light[2]
        assert np.abs(exact - each["mueller"]).max() < 0.05 * brightest

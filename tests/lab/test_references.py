"""The references, against published values and closed forms; errors by them; published tables."""

import json
import re
import subprocess
import sys
from decimal import Decimal
from itertools import product
from pathlib import Path

import mpmath
import numpy as np
import pytest

import optipath as op
from chains import MATERIALS, random_chains
from optipath.elements.coupling import Coupling
from optipath.lab.boundary_reference import reflection, transmission
from optipath.lab.element_reference import matrix_of
from optipath.lab.errors import errors
from optipath.lab.many_digits import Reader
from optipath.lab.path_reference import exact_batch, exact_lights, exact_stokes
from optipath.lab.regions import REGIONS
from optipath.lab.tables import BEGIN, END, SEARCHED, put_tables, tables, worst
from optipath.light.conventions import CONVENTIONS
from paths import chain
from published import npgr026
from slabs import stack
from step_reference import mueller_table
from tables import rows

NAMES = {region.name: region for region in REGIONS}
HALF = (1, 0.5, 0.5, 0.5)
SKEW = (1, 0.3, 0.2, 0.1)
MALUS = op.load_preset("malus")


@pytest.fixture(autouse=True)
def many_digits():
    with mpmath.workdps(60):
        yield


def of_eye(path, **given):
    """The exact light at the detector of a chain."""
    return exact_lights(path, **given)["eye"]


def assert_as_the_reference(path, exact=exact_lights, end="eye", rtol=0.0, atol=2e-16):
    stokes = exact(path)[end]
    stokes = np.array(getattr(stokes, "stokes", stokes), float)
    np.testing.assert_allclose(path.trace().stokes, stokes, rtol=rtol, atol=atol)


@rows("case", sorted(npgr026.EXACT))
def test_a_whole_path_gives_the_published_case_to_its_last_digits(case):
    lights = exact_lights(op.load_preset("npgr026", case=case))
    exact = [mpmath.mpf(text) for text in npgr026.EXACT[case]]
    # The angles of the preset are floats: what they are off by is all that is left.
    slack = 1e-12 if case == "3" else 1e-15
    for found, component in zip(lights["E"].stokes, exact, strict=True):
        assert abs(found - component) <= slack * exact[0]


def test_brewsters_angle_total_reflection_and_slopes_of_angles_are_as_in_the_books():
    A, B, C, S = reflection(1.5, 0.0, 1.0, 1.5).values
    assert abs(A - mpmath.mpf(25) / 338) <= 1e-49  # (1 - n^2)^2 / (1 + n^2)^2 / 2
    assert A == B
    assert (C, S) == (0, 0)
    A, B, C, S = reflection(0.5, 0.0, 0.75, 1.0).values
    assert (A, B) == (1, 0)
    # Born & Wolf, sec. 1.5.4: tan(delta/2) = cos sqrt(sin^2 - n^2) / sin^2, the sine being 0.8.
    number = mpmath.mpf
    half = number(3) / 5 * mpmath.sqrt(number("0.64") - number("0.25")) / number("0.64")
    assert abs(S / (1 + C) - half) <= 1e-49
    # What is not reflected is let through.
    for index in ((1.5, 0.0), (0.2, 3.4), (0.7, 0.0)):
        F, T = (each(*index, 0.8, 0.6).values for each in (reflection, transmission))
        assert abs(F[0] + T[0] - 1) <= 1e-49
        assert abs(F[1] + T[1]) <= 1e-49
    # B ~ theta^2 next to the normal, and A does not follow the angle there.
    conditions = reflection(1.5, 0.0, 1.0, 1e-9).conditions
    assert conditions[1] == pytest.approx(2.0, abs=1e-12)
    assert conditions[0] <= 1e-30
    # Malus: cos^2 a against tan 2a.
    slope = 2 * np.tan(0.3) * np.sin(4 * 0.3) / 4
    # The polariser turns the frame there and back again.
    assert of_eye(MALUS, angle=0.3).conditions[0] == pytest.approx(slope, rel=1e-12)


def test_a_batch_has_one_reference_for_each_and_turns_and_angles_are_exact():
    angles = np.array([0.1, 0.2, 0.3])
    lights = list(exact_batch(MALUS.graph, angle=angles))
    for angle, light in zip(angles.tolist(), lights, strict=True):
        assert light["eye"] == of_eye(MALUS, angle=angle)
    with pytest.raises(op.errors.PathError, match="PathGraph"):
        exact_lights("npgr026")
    with pytest.raises(op.errors.ParameterError, match="single values"):
        exact_lights(MALUS, angle=[0.1, 0.2])
    # Turns are exact, and angles are taken as they are.
    quartz = op.Medium(np.pi / 0.7, rotation=0.35)
    assert of_eye(chain([quartz], (1, 1, 0, 0))).stokes == (1, -1, 0, 0)
    assert of_eye(op.load_preset("malus", case="crossed")).stokes == (0, 0, 0, 0)
    exact = float(of_eye(chain([op.Polarizer("1e17 rad")], (1, 1, 0, 0))).stokes[0])
    assert exact == pytest.approx(float(mpmath.cos(mpmath.mpf(10) ** 17) ** 2), rel=1e-15)
    for index, expected in ((1e300, [1, 0.3, 0.2, 0.1]), (1.0, [0, 0, 0, 0])):
        path = chain([op.Interface(index, np.pi / 2)], SKEW)
        assert [float(part) for part in of_eye(path).stokes] == expected
        np.testing.assert_array_equal(path.trace().stokes, expected)


FILMS = [
    op.Rotator(0.3),
    op.Polarizer(0.4, 0.1, 0.9, 0.05),
    op.Attenuator(0.5),
    op.MuellerElement(np.diag([0.9, 0.5, 0.4, 0.3])),
    op.Mirror(-0.9 + 0.2j, 0.8 - 0.3j, azimuth=0.5),
    op.Diattenuator(0.9, 0.3, angle=0.2, azimuth=0.1),
    op.Medium(0.1, 3.0, rotation=8.0),
    op.Medium(0.1, dextrorotation=3.0),
    op.Depolarizer(0.1),
    op.Medium(0.2, 0.0, retardance=5.0, angle=0.7, azimuth=0.2),
    op.FaradayRotator(0.4),
    op.FaradayRotator(verdet=-134.0, field=0.17, length=0.02),
    op.CircularPolarizer("left", 0.9, 0.3),
    op.Waveplate(2.3e-3, -0.0091, 5.89e-7, 0.3, azimuth=0.2),
    op.EllipticalRetarder(0.3, -0.7, 1.1, azimuth=0.4),
    op.CircularDiattenuator(0.9, 0.4),
    op.Medium(0.1, 3.0, dichroism=2.0, circular_dichroism=1.0, retardance=9.0, angle=0.3),
    op.Medium(0.1, 3.0, dichroism=2.0, retardance=4.0, dichroic_angle=0.8, rotation=2.0),
    op.Medium(0.1, 3.0, dichroism=-1.0, depolarization=1.5, dextrorotation=4.0),
]


def everything():
    """A path of every element, with branches that meet."""
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(2.0, [1.0, 0.2, -0.3, 0.4]))
    lamp >> path.add("plate", op.Retarder(0.7, 0.2, azimuth=0.3))
    path["plate"] >> path.add("split", op.BeamSplitter(0.3, azimuth=-0.1))
    path.add("sum", op.Combiner())
    path.add("glass", op.Interface(1.5, 0.9, outside=1.2, azimuth=0.4))
    path.add("metal", op.Interface(0.2 + 3j, 0.5))
    for name, port in (("glass", "reflected"), ("metal", "transmitted")):
        path.connect(f"split.{port}", f"{name}.in")
        path.connect(f"{name}.reflected", "sum.in", azimuth=0.2)
    path.add("cube", op.PolarizingBeamSplitter(1000.0, azimuth=0.3))
    path["sum"] >> path["cube"]
    path.add("both", op.Combiner())
    path.connect("cube.reflected", "both.in")
    path.connect("cube.transmitted", "both.in", azimuth=0.7)
    node = path["both"]
    for number, element in enumerate(FILMS):
        node = node >> path.add(f"e{number}", element)
    node >> path.add("eye", op.Detector())
    return path


def between_frames():
    path = op.PathGraph()
    path.add("lamp", op.Source(stokes=[1, 0.6, 0.1, 0.2]), frames={"out": op.Frame()})
    path.add("filter", op.Polarizer(0.2), frames={"in": op.Frame().turned(0.7)})
    path["lamp"] >> path["filter"] >> path.add("eye", op.Detector())
    return path


@rows(
    "path, exact",
    [
        (everything(), exact_stokes),
        (chain([op.LayerStack([1.0, 1.38, 0.2 + 3j], 0.6)], SKEW), exact_stokes),
        (chain([op.LayerStack([1.2, 1.5, 2.0, 1.3], 0.6)], SKEW), exact_stokes),
        (between_frames(), exact_lights),
    ],
)
def test_every_element_and_world_frames_have_a_reference_that_agrees_with_the_library(path, exact):
    assert_as_the_reference(path, exact)


class Unregistered(op.Element):
    """An element of one's own."""

    share: op.fields.Fraction = 0.5

    @staticmethod
    def mueller_rows(xp, share):
        c = xp.sqrt(share)
        return (1, 0, 0, 0), (0, share, 0, 0), (0, 0, c, 0), (0, 0, 0, c)


class Registered(Unregistered):
    """One whose matrix is told a second time, in many digits."""


@matrix_of.register
def _(element: Registered, way: Coupling, read: Reader):
    del way
    share = read.real(element.share)
    return mpmath.diag([1, share, mpmath.sqrt(share), mpmath.sqrt(share)]).tolist()


def test_an_element_of_ones_own_has_the_reference_that_is_registered_for_it_alone():
    stokes = of_eye(chain([Registered(op.Parameter("share"))], HALF), share=0.3).stokes
    assert abs(stokes[2] - mpmath.sqrt(mpmath.mpf(0.3)) / 2) <= 1e-49
    cure = (
        r"class Unregistered have no reference; register .*element_reference\.matrix_of\.register"
    )
    for reference in (exact_lights, exact_stokes):
        with pytest.raises(op.errors.PathError, match=cure):
            reference(chain([Unregistered(0.5)], HALF))


def test_light_that_goes_round_next_to_a_critical_angle_has_a_reference_and_what_is_left_out_none():
    indices = 1.2013844143721588, 2.3154580605777224, 1.1992097736544047, 2.41156558882614
    lights = exact_stokes(stack(*indices, theta=1.5106189446918221))
    assert abs(lights["R"][0] + lights["T"][0] - 1) < 1e-45
    for value in ("none", "horizontal"):
        path = op.load_preset("npgr026", filter=value)
        assert_as_the_reference(path, end="E", rtol=1e-14, atol=1e-15)


@rows("case", ["3", "6", "8"])
def test_points_in_space_give_the_same_light_as_angles_to_50_digits(case):
    space, plane = (op.load_preset(name, case=case) for name in ("npgr026-3d", "npgr026"))
    found, expected = exact_lights(space)["E"], exact_lights(plane)["E"]
    for one, other in zip(found.stokes, expected.stokes, strict=True):
        assert abs(one - other) <= 1e-50
    np.testing.assert_allclose(found.conditions, expected.conditions, rtol=1e-6, atol=1e-20)


@rows("reflections", [1, 3, 5])
def test_light_along_a_chain_is_right_to_its_last_digits(reflections):
    points, materials = random_chains(1, reflections), MATERIALS[:reflections]
    path = op.path_from_vertices(points, materials, events="R" * reflections)
    assert_as_the_reference(path, atol=1e-14 * float(of_eye(path).stokes[0]))


def test_an_error_is_counted_in_ulp_of_the_exact_value_over_its_condition():
    exact = [((1.0, 0.5, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))]
    off = errors(np.array([[1.0 + 2.0**-51, 0.5, 0.0, 0.0]]), exact, "float64")
    np.testing.assert_array_equal(off.componentwise, [[1.0, 0.0, 0.0, 0.0]])
    np.testing.assert_array_equal(off.normwise, [1.0])
    # The unit is that of the precision.
    found, exact = np.array([[1.0 + 2.0**-23, 0, 0, 0]], "float32"), [((1, 0, 0, 0), (0, 0, 0, 0))]
    assert errors(found, exact, "float32").componentwise[0, 0] == 1.0
    assert errors(found.astype(float), exact, "float64").componentwise[0, 0] == 2.0**29
    # What should be nothing has no ulp to hide in, nor what is not finite.
    off = errors(np.array([[1.0, 1e-17, 0.0, 0.0]]), exact, "float64")
    assert off.componentwise.max() > 1e300
    assert off.normwise[0] < 0.1
    off = errors(np.array([[np.nan, 0, 0, 0]]), exact, "float64")
    assert np.isinf([off.componentwise[0, 0], off.normwise[0]]).all()


def test_samples_are_boundaries_and_angles_of_a_seed_and_a_name_of_their_own():
    assert len(NAMES) == len(REGIONS)
    for region, dtype in product(REGIONS, ("float64", "float32")):
        samples = region.samples(500, dtype)
        assert all(part.shape == (500,) and part.dtype == dtype for part in samples)
        assert np.all(np.isfinite(samples) & (np.asarray(samples) >= 0))
        wide = np.array([samples.cos, samples.sin], dtype=float)
        assert np.all(wide <= 1)
        np.testing.assert_allclose(np.hypot(*wide), 1.0, rtol=0, atol=2 * np.finfo(dtype).eps)
    for region in REGIONS:
        random = np.random.default_rng([3, *region.name.encode()])
        units = random.random((region.dimensions, 50))
        np.testing.assert_array_equal(region.at(units), region.samples(50, seed=3))
    assert not np.array_equal(REGIONS[0].samples(9).n, REGIONS[0].samples(9, seed=1).n)
    # They lie where their region says.
    by_name = {name: region.samples(500) for name, region in NAMES.items()}
    total = by_name["k = 0, total reflection"]
    assert np.all(total.sin > total.n)
    brewster = by_name["near Brewster's angle"]
    for off, nearest, farthest in (
        (np.degrees(by_name["grazing"].cos), 1e-11, 0.1),
        (np.abs(brewster.incidence - np.arctan(brewster.n)), 1e-10, 0.11),
    ):
        assert off.min() < nearest
        assert off.max() <= farthest
    extreme = by_name["extreme magnitudes"]
    size = np.abs(extreme.n + 1j * extreme.k)
    assert np.all((size < 1e-162) | (size > 1e140))


def found_in(region, component, generations):
    return worst("stable", NAMES[region], component, generations=generations)


def test_a_search_finds_more_than_samples_do_the_same_every_time_and_no_less_when_longer():
    found = [found_in("metals", "B", generations).error for generations in (1, 4, 8)]
    assert found == sorted(found)
    assert found[0] < found[-1]
    first, second = (found_in("generic", "A", 15) for _ in range(2))
    assert first == second
    assert first.error > 5.0
    # A double zero of C; and nothing where a component vanishes.
    found = found_in("k = 0, total reflection", "C near 0", 5)
    assert 0.3 < found.n < 0.6
    assert found.error > 0.5
    assert found_in("exactly normal", "B", 1).error == 0.0


# The published tables are what their commands write, and right.

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
    command = [sys.executable, *arguments]
    done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=ROOT)
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

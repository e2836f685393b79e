"""What polarisation changes: the scalar model, its sums over all rounds, and who brings it in."""

import json
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import optipath as op
from incoherent_stacks import exact_stack
from lossless import networks
from optipath.cli.command import main
from paths import chain
from tables import rows
from wired import wired

# Of films, on purpose.
pytestmark = pytest.mark.filterwarnings("ignore::optipath.errors.CoherenceWarning")

ANGLES = np.radians([50.0, 56.0, 60.0, 65.0])
TINTED = {"lengths": [0.2], "wavelength": 5e-7}
INDICES, TURNS, SHARES = st.floats(1.0, 4.0), st.floats(-3.0, 3.0), st.floats(0.0, 1.0)
INCIDENCES, PORTS = st.floats(0.0, 1.55), ["reflected", "transmitted"]


def stack(media, incidence, port="reflected", **others):
    """A path on which unpolarised light meets a stack."""
    ends = {"lamp": op.Source(), "layers": op.LayerStack(media, incidence, **others)}
    return wired({**ends, "eye": op.Detector()}, f"lamp -> layers, layers.{port} -> eye")


def layer_by_hand(n, below, incidence, port="reflected", medium=None):
    """A layer of two interfaces, and what is between them, in a loop."""
    bottom = op.Interface(below, op.FOLLOWS, outside=op.FOLLOWS)
    ends = {"lamp": op.Source(), "top": op.Interface(n, incidence), "bottom": bottom}
    links = "top.transmitted -> bottom, bottom.reflected -> top.back"
    if medium is not None:
        ends |= {"down": medium, "up": medium}
        links = "top.transmitted -> down, down -> bottom, bottom.reflected -> up, up -> top.back"
    links = f"lamp -> top, {links}, {'top' if port == 'reflected' else 'bottom'}.{port} -> eye"
    return wired({**ends, "eye": op.Detector()}, links, loops="sum")


def fresnel(n1, n2, y):
    """What a boundary reflects of s and of p, y being n sin(incidence); for real indices."""
    g1, g2 = (np.sqrt(n * n - y * y + 0j) for n in (n1, n2))
    s = abs((g1 - g2) / (g1 + g2)) ** 2
    p = abs((n2 * n2 * g1 - n1 * n1 * g2) / (n2 * n2 * g1 + n1 * n1 * g2)) ** 2
    return s, p


def mean(n1, n2, y):
    return sum(fresnel(n1, n2, y)) / 2


def test_layers_on_others_differ_from_the_scalar_model_as_their_loops_do():
    found = op.polarization(stack([1.0, 1.5, 2.4], ANGLES))
    assert 100.0 * found.difference == pytest.approx([-1.785, -2.498, -2.900, -3.167], abs=5e-4)
    assert (found.exact[3], found.scalar[3]) == pytest.approx((0.16024, 0.16548), abs=5e-6)
    sample = op.Sample([(1.5, 0.1), (2.4, 0.1)])
    found = op.polarization(op.Source() >> sample.smooth("56 deg") >> op.Detector())
    assert found.difference == pytest.approx(-0.02498, abs=5e-6)
    n, k, metal = 1.5, 1e-7, 0.2 + 3.4j
    # The way is slanted; that the wave is not quite homogeneous matters no more than k does.
    length = TINTED["lengths"][0] / np.sqrt(1.0 - (np.sin(ANGLES) / n) ** 2)
    medium = op.Medium(length, absorption=4.0 * np.pi * k / TINTED["wavelength"])
    by_stack = op.polarization(stack([1.0, n + k * 1j, metal], ANGLES, **TINTED))
    by_hand = op.polarization(layer_by_hand(n, metal, ANGLES, medium=medium))
    np.testing.assert_allclose(by_hand.scalar, by_stack.scalar, rtol=1e-6)
    np.testing.assert_allclose(by_hand.difference, by_stack.difference, rtol=1e-5)


@settings(max_examples=15)
@given(n=INDICES, below=INDICES, incidence=INCIDENCES)
def test_two_boundaries_reflect_the_geometric_series_of_their_means(n, below, incidence):
    y = np.sin(incidence)
    top, bottom = mean(1.0, n, y), mean(n, below, y)
    series = top + (1.0 - top) ** 2 * bottom / (1.0 - top * bottom)
    for path in (stack([1.0, n, below], incidence), layer_by_hand(n, below, incidence)):
        assert op.polarization(path).scalar == pytest.approx(series, rel=1e-12, abs=1e-15)


@rows("port", PORTS)
@rows(
    "media, lengths",
    [
        ([1.0, 1.3, 2.1, 1.6], [1e-3, 2e-3]),
        ([1.0, 1.5 + 1e-4j, 2.4], [1e-3]),
        ([1.0, 1.5, 1.7 + 1e-5j, 1.3], [1e-3, 2e-3]),
        ([1.2, 1.6 + 1e-5j, 0.9 + 0.2j, 1.5, 1.4], [1e-3, 3e-7, 1e-3]),
        ([1.0, 1.5 + 1e-5j, 0.2 + 3.4j], [1e-3]),
    ],
)
def test_layers_that_absorb_agree_with_50_digits(media, lengths, port):
    angles = [0.0, 0.4, 0.98, 1.5]
    found = op.polarization(stack(media, angles, port, lengths=lengths, wavelength=5e-7))
    for name in ("scalar", "exact"):
        exact = [exact_stack(media, lengths, 5e-7, a, scalar=name == "scalar") for a in angles]
        expected = [float(sum(getattr(each, port)[:2]) / 2) for each in exact]
        np.testing.assert_allclose(getattr(found, name), expected, rtol=1e-12)


@rows("port", PORTS)
def test_a_stack_and_the_same_boundaries_in_a_loop_agree_to_the_last_digits(port):
    for n, below in ((1.5, 2.4), (2.4, 1.5), (1.3, 1.0)):
        one = op.polarization(stack([1.0, n, below], ANGLES, port))
        other = op.polarization(layer_by_hand(n, below, ANGLES, port))
        for name in ("exact", "scalar", "difference"):
            expected, found = getattr(one, name), getattr(other, name)
            np.testing.assert_allclose(found, expected, rtol=1e-14, atol=4e-16)


def ring(elements, kept=0.7):
    """Light let into a ring by a beam splitter, which lets some of it out each time."""
    row = {f"e{number}": element for number, element in enumerate(elements)}
    way = ["door.transmitted", *row, "door.back"]
    links = ", ".join(f"{start} -> {end}" for start, end in pairwise(way))
    return wired(
        {"lamp": op.Source(), "door": op.BeamSplitter(kept), "eye": op.Detector(), **row},
        f"lamp -> door, door.reflected -> eye, {links}",
        loops="sum",
    )


def test_sums_over_all_rounds_are_those_of_means_and_nothing_gets_lost():
    matrix = np.diag([0.8, 0.5, 0.4, 0.3])
    matrix[0, 1:], matrix[1:, 0] = [0.1, -0.1, 0.05], [0.2, 0.05, -0.1]
    elements = [op.Polarizer(0.3), op.Retarder(1.0, 0.2), op.MuellerElement(matrix)]
    path, out, light = ring(elements), 0.7, 0.3
    for _ in range(200):
        light *= 0.5 * 1.0 * 0.8
        out, light = out + 0.3 * light, 0.7 * light
    found = op.polarization(path)
    assert found.scalar == pytest.approx(out, rel=1e-14)
    assert found.exact == path.trace().intensity
    assert found.certificate.lower * out < found.exact < found.certificate.upper * out
    bottom = op.Interface(2.4, op.FOLLOWS, outside=op.FOLLOWS)
    ends = {"lamp": op.Source(), "top": op.LayerStack([1.0, 1.5, 1.8], 0.9), "bottom": bottom}
    links = "lamp -> top, top.transmitted -> bottom, bottom.reflected -> top.back, top -> eye"
    found = op.polarization(wired({**ends, "eye": op.Detector()}, links, loops="sum"))
    whole = op.polarization(stack([1.0, 1.5, 1.8, 2.4], 0.9))
    assert found.scalar == pytest.approx(whole.scalar, rel=1e-14)
    assert found.difference == pytest.approx(whole.difference, rel=1e-12)
    assert set(found.elements) == {"top", "bottom"}
    for network in networks(5, first=3, size=(2, 6)):
        ends = network.path.compose().whole.readings
        found = sum(op.polarization(network.path, end).scalar for end in ends)
        assert found == pytest.approx(network.emitted, rel=1e-13)


@settings(max_examples=10)
@given(st.lists(INDICES, min_size=2, max_size=5), st.floats(0.0, 1e-3), st.sampled_from(PORTS))
def test_at_normal_incidence_unpolarised_light_is_what_the_scalar_model_says(media, k, port):
    lengths = [1e-3] * (len(media) - 1)
    tinted = [1.0, *(n + k * 1j for n in media[:-1]), media[-1]]
    found = op.polarization(stack(tinted, 0.0, port, lengths=lengths, wavelength=5e-7))
    assert found.difference == pytest.approx(0.0, abs=1e-13)
    by_hand = op.polarization(layer_by_hand(*media[:2], 0.0))
    assert by_hand.difference == pytest.approx(0.0, abs=1e-13)


@settings(max_examples=20)
@given(st.lists(INDICES, min_size=2, max_size=4), INCIDENCES, st.tuples(TURNS, TURNS), SHARES)
def test_what_is_exact_keeps_within_bounds_of_a_stack_among_others(media, incidence, angles, dop):
    layers = op.LayerStack([1.0, *media], incidence)
    elements = [op.Polarizer(angles[0]), layers, op.Retarder(1.0, 0.4), op.Interface(1.5, 1.0)]
    found = op.polarization(chain([*elements, op.Polarizer(angles[1])], [1.0, 0.0, dop, 0.0]))
    assert found.certificate is not None
    assert found.certificate.scalar is found.scalar
    assert found.certificate.lower * found.scalar <= found.exact
    assert found.exact <= found.certificate.upper * found.scalar


@rows("make", [stack, lambda media, a: layer_by_hand(*media[1:], a)])
def test_batches_give_what_single_paths_give_and_values_that_jax_traces_are_refused(make):
    path, angles = make([1.0, 1.5, 2.4], op.Parameter("a")), np.linspace(0.0, 1.57, 20_000)
    found = op.polarization(path, a=angles)
    for place in (0, 7_777, -1):
        one = op.polarization(path, a=float(angles[place]))
        for name in ("exact", "scalar", "difference"):
            assert getattr(found, name)[place] == getattr(one, name)
    jax = pytest.importorskip("jax")
    with pytest.raises(op.errors.ParameterError, match="not of values that JAX traces"):
        jax.jit(lambda a: op.polarization(path, a=a).difference)(ANGLES)


@pytest.mark.slow
def test_jax_gives_what_the_others_give():
    jax, a = pytest.importorskip("jax"), op.Parameter("a")
    for path in (stack([1.0, 1.5, 2.4], a), ring([op.Polarizer(a), op.Polarizer(0.3)])):
        found, expected = (op.polarization(path, a=n) for n in (jax.numpy.asarray(ANGLES), ANGLES))
        np.testing.assert_allclose(found.difference, expected.difference, rtol=1e-4, atol=1e-6)


def test_the_command_bounds_what_polarization_does_in_loops(capsys):
    assert main(["polarization", "glass-slab", "--theta", "56"]) == 0
    assert "at most" in capsys.readouterr().out
    assert main(["polarization", "glass-slab", "--theta", "56", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)["detectors"]["transmitted"]
    assert found["lower"] < 1.0 + found["difference"] < found["upper"] < 1.1
    # Through a slab goes (1 - R) / (1 + R).
    s, p, R = *fresnel(1.0, 1.5, np.sin(np.radians(56))), mean(1.0, 1.5, np.sin(np.radians(56)))
    assert found["scalar"] == pytest.approx((1 - R) / (1 + R), rel=1e-12)
    exact = ((1 - s) / (1 + s) + (1 - p) / (1 + p)) / 2
    assert found["difference"] == pytest.approx(exact * (1 + R) / (1 - R) - 1, rel=1e-9)


def test_a_stack_is_taken_as_a_whole_and_a_detector_by_its_name():
    text = str(stack([1.0, 1.5, 2.4], 0.9).compose().explain())
    assert "S0 is 1 .. 1 of the scalar model's, which takes a stack as a whole" in text
    layers, angle = op.LayerStack([1.0, 1.5, 2.4], op.Parameter("a")), np.linspace(0.0, 1.5, 9)
    glass = op.Interface(1.5, op.Parameter("a"))
    path = op.Source() >> layers >> glass >> op.Detector(reads="intensity")
    plan = op.Composer(tolerance=0.03).compose(path)
    found, exact = plan.run(a=angle).intensity, path.trace(a=angle).intensity
    np.testing.assert_allclose(found, exact, rtol=0.03)
    assert np.max(np.abs(found / exact - 1.0)) > 0.01  # The scalar model has been run for some.
    ends = {"lamp": op.Source(), "split": op.BeamSplitter(0.25), "a": op.Detector()}
    links = "lamp -> split, split.reflected -> a, split.transmitted -> b"
    path = wired({**ends, "b": op.Detector()}, links)
    assert op.polarization(path, "b").exact == 0.75
    for asked, told in (
        ((path,), "2 detectors"),
        ((path, "bb"), "there are: a, b"),
        ((op.load_preset("glass-slab"), "transmited"), "detector 'transmited' does not exist"),
    ):
        with pytest.raises(op.errors.ParameterError, match=told):
            op.polarization(*asked)


def test_the_elements_that_bring_the_difference_in_are_named_with_their_shares():
    elements = [op.Interface(0.05 + 3.9j, 0.5), op.Retarder(1.0, 0.3), op.Polarizer(0.7)]
    found = op.polarization(chain(elements, [1.0, 0.0, 0.9, 0.0]))
    assert (found.culprits, {*found.elements}) == (("e2",), {"e0", "e1", "e2"})
    assert found.elements["e1"] == 0.0
    found = op.polarization(chain([op.Rotator(0.3), op.Attenuator(0.5)], [1.0, 0.5, 0.0, 0.2]))
    assert (found.difference, found.culprits) == (0.0, ())
    assert found.certificate.error >= 0.0
    crossed = op.polarization(op.load_preset("two-panes"))
    assert (crossed.exact, crossed.difference) == pytest.approx((0.0, -1.0), abs=1e-15)
    dark = op.polarization(chain([op.Attenuator(0.0), op.Polarizer(0.1), op.Polarizer(1.0)]))
    assert dark.scalar == dark.difference == 0.0
    found = op.polarization(stack([1.5, 1.0, 1.5], [0.8, 1.2]))
    np.testing.assert_allclose(found.difference, 0.0, rtol=0, atol=1e-15)
    through = op.polarization(stack([1.5, 1.0, 1.5], 0.8, "transmitted"))
    assert through.scalar == through.exact == through.difference == 0.0
    angle = np.linspace(0.0, 1.5, 7)
    panes = op.load_preset("npgr026", n1=1.5, n2=1.5, rho=np.pi / 2)
    found = op.polarization(panes, delta=angle, phi=angle)
    A, B, _, _ = op.fresnel_reflection(1.5, np.cos(angle), np.sin(angle))
    np.testing.assert_allclose(found.scalar, 100.0 * A * A, rtol=1e-13)
    # Without one of the two nothing is lost.
    for share in (found.difference, found.elements["X1"], found.elements["X2"]):
        np.testing.assert_allclose(share, -((B / A) ** 2), rtol=0, atol=1e-13)
    found = op.polarization(stack([1.0, 1.5, 2.4], ANGLES))
    for bound in (found.certificate.lower, found.certificate.upper):
        np.testing.assert_allclose(bound - 1.0, found.difference, rtol=0, atol=1e-12)
    assert found.culprits == ("layers",)
    np.testing.assert_array_equal(found.elements["layers"], found.difference)
    found = op.polarization(layer_by_hand(1.5, 2.4, 1.0))
    y, exact, without = np.sin(1.0), [], []
    for top, bottom in zip(fresnel(1.0, 1.5, y), fresnel(1.5, 2.4, y), strict=True):
        for where, first in ((exact, top), (without, mean(1.0, 1.5, y))):
            where.append(first + (1.0 - first) ** 2 * bottom / (1.0 - first * bottom))
    share = (sum(exact) - sum(without)) / 2.0 / found.scalar
    assert found.elements["top"] == pytest.approx(share, rel=1e-12)

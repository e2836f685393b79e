"""The scalar model of light that goes round: sums over all rounds, each boundary by its mean."""

import json
import os

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import optipath as op
from incoherent_stacks import exact_stack
from lossless import networks
from optipath.cli.command import main
from paths import chain

pytestmark = pytest.mark.filterwarnings(
    "ignore::optipath.CoherenceWarning"
)  # Of films, on purpose.

ANGLES = np.radians([50.0, 56.0, 60.0, 65.0])
TINTED = {"lengths": [0.2], "wavelength": 5e-7}
INDICES = st.floats(1.0, 4.0)
INCIDENCES = st.floats(0.0, 1.55)


def stack(media, incidence, port="reflected", **others):
    """A path on which unpolarised light meets a stack."""
    path = op.PathGraph()
    path.add("lamp", op.Source())
    path.add("layers", op.LayerStack(media, incidence, **others))
    path.add("eye", op.Detector())
    path.connect("lamp.out", "layers.in")
    path.connect(f"layers.{port}", "eye.in")
    return path


def layer_by_hand(n, below, incidence, port="reflected", medium=None):
    """A layer of two interfaces, and what is between them, in a loop."""
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source())
    path.add("top", op.Interface(n, incidence))
    path.add("bottom", op.Interface(below, op.FOLLOWS, outside=op.FOLLOWS))
    path.add("eye", op.Detector())
    path.connect("lamp.out", "top.in")
    if medium is None:
        path.connect("top.transmitted", "bottom.in")
        path.connect("bottom.reflected", "top.back")
    else:
        for name, start, end in (
            ("down", "top.transmitted", "bottom.in"),
            ("up", "bottom.reflected", "top.back"),
        ):
            path.add(name, medium)
            path.connect(start, f"{name}.in")
            path.connect(f"{name}.out", end)
    path.connect(f"{'top' if port == 'reflected' else 'bottom'}.{port}", "eye.in")
    return path


def fresnel(n1, n2, y):
    """What a boundary reflects of s and of p, y being n sin(incidence); for real indices."""
    g1, g2 = (np.sqrt(n * n - y * y + 0j) for n in (n1, n2))
    s = abs((g1 - g2) / (g1 + g2)) ** 2
    p = abs((n2 * n2 * g1 - n1 * n1 * g2) / (n2 * n2 * g1 + n1 * n1 * g2)) ** 2
    return s, p


def mean(n1, n2, y):
    s, p = fresnel(n1, n2, y)
    return (s + p) / 2


def test_a_layer_of_1_5_on_2_4_reflects_less_than_the_scalar_model_says():
    found = op.polarization(stack([1.0, 1.5, 2.4], ANGLES))
    np.testing.assert_allclose(
        100.0 * found.difference, [-1.785, -2.498, -2.900, -3.167], rtol=0, atol=5e-4
    )
    assert found.exact[3] == pytest.approx(0.16024, abs=5e-6)
    assert found.scalar[3] == pytest.approx(0.16548, abs=5e-6)


def test_a_sample_with_smooth_interfaces_is_such_a_stack():
    sample = op.Sample([(1.5, 0.1), (2.4, 0.1)])
    found = op.polarization(op.Source() >> sample.smooth("56 deg") >> op.Detector())
    assert found.difference == pytest.approx(-0.02498, abs=5e-6)


@settings(max_examples=15)
@given(n=INDICES, below=INDICES, incidence=INCIDENCES)
def test_two_boundaries_reflect_the_geometric_series_of_their_means(n, below, incidence):
    y = np.sin(incidence)
    top, bottom = mean(1.0, n, y), mean(n, below, y)
    series = top + (1.0 - top) ** 2 * bottom / (1.0 - top * bottom)
    for path in (stack([1.0, n, below], incidence), layer_by_hand(n, below, incidence)):
        found = op.polarization(path)
        assert found.scalar == pytest.approx(series, rel=1e-12, abs=1e-15)


@settings(max_examples=10)
@given(first=INDICES, second=INDICES, below=INDICES, incidence=INCIDENCES)
def test_three_boundaries_let_through_the_series_within_the_series(first, second, below, incidence):
    y = np.sin(incidence)
    a, b, c = mean(1.0, first, y), mean(first, second, y), mean(second, below, y)
    lower = b + (1.0 - b) ** 2 * c / (1.0 - b * c)
    all_three = 1.0 - (a + (1.0 - a) ** 2 * lower / (1.0 - a * lower))
    found = op.polarization(stack([1.0, first, second, below], incidence, "transmitted"))
    assert found.scalar == pytest.approx(all_three, rel=1e-9, abs=1e-15)


@pytest.mark.parametrize("port", ["reflected", "transmitted"])
@pytest.mark.parametrize(
    ("media", "lengths"),
    [
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
        exact = [
            getattr(exact_stack(media, lengths, 5e-7, angle, scalar=name == "scalar"), port)
            for angle in angles
        ]
        expected = [float((s + p) / 2) for s, p, _ in exact]
        np.testing.assert_allclose(getattr(found, name), expected, rtol=1e-12)


@pytest.mark.parametrize("port", ["reflected", "transmitted"])
def test_a_stack_and_the_same_boundaries_in_a_loop_agree_to_the_last_digits(port):
    for n, below in ((1.5, 2.4), (2.4, 1.5), (1.3, 1.0)):
        one = op.polarization(stack([1.0, n, below], ANGLES, port))
        other = op.polarization(layer_by_hand(n, below, ANGLES, port))
        for name in ("exact", "scalar", "difference"):
            expected, found = getattr(one, name), getattr(other, name)
            np.testing.assert_allclose(found, expected, rtol=1e-14, atol=4e-16)


def test_a_tinted_layer_on_a_metal_agrees_with_its_loop():
    n, k, metal = 1.5, 1e-7, 0.2 + 3.4j
    # The way is slanted; that the wave is not quite homogeneous matters no more than k does.
    length = TINTED["lengths"][0] / np.sqrt(1.0 - (np.sin(ANGLES) / n) ** 2)
    medium = op.Medium(length, absorption=4.0 * np.pi * k / TINTED["wavelength"])
    by_stack = op.polarization(stack([1.0, n + k * 1j, metal], ANGLES, **TINTED))
    by_hand = op.polarization(layer_by_hand(n, metal, ANGLES, medium=medium))
    np.testing.assert_allclose(by_hand.scalar, by_stack.scalar, rtol=1e-6)
    np.testing.assert_allclose(by_hand.difference, by_stack.difference, rtol=1e-5)


def ring(elements, kept=0.7):
    """Light let into a ring by a beam splitter, which lets some of it out each time."""
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source())
    path.add("door", op.BeamSplitter(kept))
    path.add("eye", op.Detector())
    path.connect("lamp.out", "door.in")
    path.connect("door.reflected", "eye.in")
    leaves = "door.transmitted"
    for number, element in enumerate(elements):
        path.add(f"e{number}", element)
        path.connect(leaves, f"e{number}.in")
        leaves = f"e{number}.out"
    path.connect(leaves, "door.back")
    return path


def test_the_sum_over_all_rounds_of_a_ring_is_that_of_means_one_by_one():
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
    assert found.certificate is None


def test_a_stack_in_a_loop_is_taken_by_its_boundaries():
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source())
    path.add("top", op.LayerStack([1.0, 1.5, 1.8], 0.9))
    path.add("bottom", op.Interface(2.4, op.FOLLOWS, outside=op.FOLLOWS))
    path.add("eye", op.Detector())
    path.connect("lamp.out", "top.in")
    path.connect("top.transmitted", "bottom.in")
    path.connect("bottom.reflected", "top.back")
    path.connect("top.reflected", "eye.in")
    found = op.polarization(path)
    whole = op.polarization(stack([1.0, 1.5, 1.8, 2.4], 0.9))
    assert found.scalar == pytest.approx(whole.scalar, rel=1e-14)
    assert found.difference == pytest.approx(whole.difference, rel=1e-12)
    assert set(found.elements) == {"top", "bottom"}


def test_no_light_of_the_scalar_model_gets_lost_in_networks():
    for network in networks(5, first=3, size=(2, 6)):
        ends = network.path.compose().whole.readings
        found = sum(op.polarization(network.path, end).scalar for end in ends)
        assert found == pytest.approx(network.emitted, rel=1e-13)


@settings(max_examples=10)
@given(media=st.lists(INDICES, min_size=2, max_size=5), incidence=INCIDENCES)
def test_what_a_stack_reflects_and_lets_through_is_all_that_came(media, incidence):
    both = [
        op.polarization(stack([1.0, *media], incidence, port)).scalar
        for port in ("reflected", "transmitted")
    ]
    assert sum(both) == pytest.approx(1.0, rel=1e-13)


@settings(max_examples=10)
@given(
    media=st.lists(INDICES, min_size=2, max_size=5),
    k=st.floats(0.0, 1e-3),
    port=st.sampled_from(["reflected", "transmitted"]),
)
def test_at_normal_incidence_unpolarised_light_is_what_the_scalar_model_says(media, k, port):
    lengths = [1e-3] * (len(media) - 1)
    tinted = [1.0, *(n + k * 1j for n in media[:-1]), media[-1]]
    found = op.polarization(stack(tinted, 0.0, port, lengths=lengths, wavelength=5e-7))
    assert found.difference == pytest.approx(0.0, abs=1e-13)
    assert op.polarization(layer_by_hand(*media[:2], 0.0)).difference == pytest.approx(
        0.0, abs=1e-13
    )


def test_behind_total_reflection_nothing_differs():
    found = op.polarization(stack([1.5, 1.0, 1.5], [0.8, 1.2]))
    np.testing.assert_allclose(found.difference, 0.0, rtol=0, atol=1e-15)
    through = op.polarization(stack([1.5, 1.0, 1.5], 0.8, "transmitted"))
    assert through.scalar == through.exact == through.difference == 0.0


@settings(max_examples=20)
@given(
    media=st.lists(INDICES, min_size=2, max_size=4),
    incidence=INCIDENCES,
    angles=st.tuples(st.floats(-3.0, 3.0), st.floats(-3.0, 3.0)),
    dop=st.floats(0.0, 1.0),
)
def test_what_is_exact_keeps_within_the_bounds_of_a_stack_among_others(
    media, incidence, angles, dop
):
    layers = op.LayerStack([1.0, *media], incidence)
    elements = [op.Polarizer(angles[0]), layers, op.Retarder(1.0, 0.4), op.Interface(1.5, 1.0)]
    found = op.polarization(chain([*elements, op.Polarizer(angles[1])], [1.0, 0.0, dop, 0.0]))
    assert found.certificate is not None
    assert found.certificate.scalar is found.scalar
    assert found.certificate.lower * found.scalar <= found.exact
    assert found.exact <= found.certificate.upper * found.scalar


def test_bounds_of_a_stack_alone_leave_nothing_open():
    found = op.polarization(stack([1.0, 1.5, 2.4], ANGLES))
    for bound in (found.certificate.lower, found.certificate.upper):
        np.testing.assert_allclose(bound - 1.0, found.difference, rtol=0, atol=1e-12)


def test_the_share_of_a_stack_is_that_of_all_its_boundaries():
    found = op.polarization(stack([1.0, 1.5, 2.4], ANGLES))
    assert found.culprits == ("layers",)
    np.testing.assert_array_equal(found.elements["layers"], found.difference)


def test_the_share_of_a_boundary_in_a_loop_is_what_its_mean_alone_would_change():
    found = op.polarization(layer_by_hand(1.5, 2.4, 1.0))
    y, exact, without = np.sin(1.0), [], []
    for top, bottom in zip(fresnel(1.0, 1.5, y), fresnel(1.5, 2.4, y), strict=True):
        for where, first in ((exact, top), (without, mean(1.0, 1.5, y))):
            where.append(first + (1.0 - first) ** 2 * bottom / (1.0 - first * bottom))
    share = (sum(exact) - sum(without)) / 2.0 / found.scalar
    assert found.elements["top"] == pytest.approx(share, rel=1e-12)


@pytest.mark.parametrize("make", [stack, lambda media, a: layer_by_hand(*media[1:], a)])
def test_batches_give_what_single_paths_give(make):
    path, angles = make([1.0, 1.5, 2.4], op.Parameter("a")), np.linspace(0.0, 1.57, 20_000)
    found = op.polarization(path, a=angles)
    for place in (0, 7_777, -1):
        one = op.polarization(path, a=float(angles[place]))
        for name in ("exact", "scalar", "difference"):
            assert getattr(found, name)[place] == getattr(one, name)


@pytest.mark.skipif("OPTIPATH_SETS" not in os.environ, reason="JAX compiles for long")
@pytest.mark.parametrize(
    "make",
    [
        lambda a: stack([1.0, 1.5, 2.4], a),
        lambda a: ring([op.Polarizer(a), op.Polarizer(0.3)]),
    ],
)
def test_jax_gives_what_the_others_give(make):
    jax = pytest.importorskip("jax")
    path = make(op.Parameter("a"))
    found = op.polarization(path, a=jax.numpy.asarray(ANGLES))
    np.testing.assert_allclose(
        found.difference, op.polarization(path, a=ANGLES).difference, rtol=1e-4, atol=1e-6
    )


@pytest.mark.parametrize("make", [stack, lambda media, a: layer_by_hand(*media[1:], a)])
def test_values_that_jax_traces_are_refused(make):
    jax = pytest.importorskip("jax")
    path = make([1.0, 1.5, 2.4], op.Parameter("a"))
    with pytest.raises(op.ParameterError, match="not of values that JAX traces"):
        jax.jit(lambda a: op.polarization(path, a=a).difference)(ANGLES)


def test_an_end_that_is_not_there_is_told_where_light_goes_round():
    with pytest.raises(op.ParameterError, match="detector 'transmited' does not exist"):
        op.polarization(op.load_preset("glass-slab"), "transmited")


def test_the_command_says_that_loops_have_no_bounds(capsys):
    assert main(["polarization", "glass-slab", "--theta", "56"]) == 0
    assert "there are no bounds of what it could change" in " ".join(
        capsys.readouterr().out.split()
    )
    assert main(["polarization", "glass-slab", "--theta", "56", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)["detectors"]["transmitted"]
    assert found["lower"] is found["upper"] is None
    # Through a slab goes (1 - R) / (1 + R).
    s, p, R = *fresnel(1.0, 1.5, np.sin(np.radians(56))), mean(1.0, 1.5, np.sin(np.radians(56)))
    assert found["scalar"] == pytest.approx((1 - R) / (1 + R), rel=1e-12)
    exact = ((1 - s) / (1 + s) + (1 - p) / (1 + p)) / 2
    assert found["difference"] == pytest.approx(exact * (1 + R) / (1 - R) - 1, rel=1e-9)


def test_explanations_say_that_their_scalar_model_takes_a_stack_as_a_whole():
    text = str(stack([1.0, 1.5, 2.4], 0.9).compose().explain())
    assert "S0 is 1 .. 1 of the scalar model's, which takes a stack as a whole" in text


def test_a_tolerance_holds_for_a_stack_before_another_boundary():
    layers, angle = op.LayerStack([1.0, 1.5, 2.4], op.Parameter("a")), np.linspace(0.0, 1.5, 9)
    glass = op.Interface(1.5, op.Parameter("a"))
    path = op.Source() >> layers >> glass >> op.Detector(reads="intensity")
    plan = op.Composer(tolerance=0.03).compose(path)
    found, exact = plan.run(a=angle).intensity, path.trace(a=angle).intensity
    np.testing.assert_allclose(found, exact, rtol=0.03)
    assert np.max(np.abs(found / exact - 1.0)) > 0.01  # The scalar model has been run for some.

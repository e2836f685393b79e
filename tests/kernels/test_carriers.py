"""Bounds of intensities, and matrices that have none."""

import inspect
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from optipath.engines.program import execute
from optipath.kernels.carriers.carried import add, carry, stokes_of
from optipath.kernels.carriers.carrier import (
    Carrier,
    JonesCarrier,
    MatrixCarrier,
    ScaledCarrier,
    StokesCarrier,
)
from optipath.kernels.carriers.intensities import BoundsCarrier, IntensityCarrier
from optipath.kernels.carriers.structures import BLOCK, ROTATION, SCALE, is_physical
from optipath.kernels.primitives import FLOAT, NUMPY
from optipath.kernels.trigonometry import cosine, sine
from random_matrices import jones, of_jones, unit_vectors
from tables import rows, slow, slow_except
from wired import wired

OF_STOKES = StokesCarrier, ScaledCarrier, JonesCarrier, MatrixCarrier


@rows("carrier", [*OF_STOKES, IntensityCarrier, BoundsCarrier])
def test_every_carrier_keeps_the_contract_and_says_if_it_goes_through_no_loop(carrier):
    for name in ("emit", "act", "add", "meet", "read"):
        ours, promised = (inspect.signature(getattr(c, name)) for c in (carrier, Carrier))
        assert len(ours.parameters) == len(promised.parameters)
    if carrier in {JonesCarrier, IntensityCarrier}:
        with pytest.raises(NotImplementedError, match=f"{carrier.__name__} carries no light"):
            carrier(FLOAT).meet(None, {})


SIGNED = st.floats(-1.0, 1.0)


@st.composite
def lights(draw):
    direction = np.array([draw(SIGNED) for _ in range(3)])
    length = max(float(np.linalg.norm(direction)), 1.0)
    return (1.0, *(direction / length).tolist())


@st.composite
def steps(draw):
    kind, angle = draw(st.sampled_from([SCALE, ROTATION, BLOCK])), draw(st.floats(-4.0, 4.0))
    if kind is SCALE:
        return SCALE, (draw(st.floats(1e-3, 1.0)),)
    if kind is ROTATION:
        return ROTATION, (np.cos(angle), np.sin(angle))
    Fs, Fp = draw(st.floats(0.01, 1.0)), draw(st.floats(0.01, 1.0))
    size = np.sqrt(Fs * Fp)
    return BLOCK, (Fs, Fp, 0.5 * (Fs - Fp), size * np.cos(angle), size * np.sin(angle))


def result(carrier, light, chain=(), beside=None):
    carrier = carrier(FLOAT)
    state = carrier.emit(light)
    for structure, numbers in chain:
        state = carrier.act(structure, numbers, state)
    stokes, exponent = carrier.read(carrier.add(state, carrier.emit(beside)) if beside else state)
    return np.array(stokes) * 2.0**exponent


@given(
    first=lights(), second=lights(), share=st.floats(1e-9, 1.0), chain=st.lists(steps(), max_size=6)
)
def test_all_ways_of_carrying_light_agree_and_add_it_incoherently(first, second, share, chain):
    plain = result(StokesCarrier, first, chain)
    second = tuple(share * part for part in second)
    for carrier in OF_STOKES:
        np.testing.assert_allclose(result(carrier, first, chain), plain, rtol=0, atol=1e-14)
        found = result(carrier, first, beside=second)
        np.testing.assert_allclose(found, np.add(first, second), rtol=0, atol=2e-15)


@given(light=lights(), chain=st.lists(steps(), min_size=20, max_size=40))
def test_jones_columns_are_never_polarised_by_more_than_100_percent(light, chain):
    s0, *rest = result(JonesCarrier, light, chain)
    assert np.linalg.norm(rest) <= s0 * (1 + 2.3e-16)


def branches():
    nodes = {
        "lamp": op.Source(stokes=[1.0, 0.3, 0.2, -0.1]),
        "split": op.BeamSplitter(0.3),
        "glass": op.Interface(1.5 + 0.2j, op.Parameter("theta"), azimuth=0.2),
        "sum": op.Combiner(),
        "plate": op.Retarder(0.5, 0.3),
        "eye": op.Detector(),
    }
    links = "lamp -> split, split.reflected -> glass, split.transmitted -> sum, glass -> sum, "
    return wired(nodes, links + "sum -> plate, plate -> eye")


def test_paths_that_part_and_meet_are_carried_by_jones_columns_unless_they_depolarise():
    theta = np.linspace(0, 1.5, 7)
    plan = op.Composer(composing="jones").compose(branches())
    expected = branches().trace(theta=theta)
    np.testing.assert_allclose(plan.run(theta=theta).stokes, expected.stokes, rtol=0, atol=2e-15)
    matrix = branches().mueller(theta=theta).matrix
    np.testing.assert_allclose(plan.mueller(theta=theta).matrix, matrix, rtol=0, atol=5e-15)
    assert "Jones" in plan.explain()
    foil = op.MuellerElement(np.diag([1.0, 0.5, 0.5, 0.5]))
    with pytest.raises(op.errors.ComposerError, match=r"'mueller\.out' .* may depolarise"):
        op.Composer(composing="jones").compose(op.Source() >> foil >> op.Detector())


@rows("carrier", OF_STOKES)
@pytest.mark.parametrize("dtype", ["float32", slow("longdouble")])
def test_no_number_changes_its_precision_on_the_way(dtype, carrier):
    paths = [op.load_preset(name) for name in op.preset_names()]
    paths += [branches(), op.load_preset("npgr026", filter=["none", "horizontal"])]
    for path in paths:
        plan = op.Composer(dtype=dtype).compose(path)
        structures = (evaluation.kernel.structure for evaluation in plan.whole.evaluations)
        has_jones = all(s is None or s.jones is not None for s in structures)
        if carrier is JonesCarrier and (plan.whole.loops or not has_jones):
            continue
        given_, _ = plan.inputs.resolve({"theta": 0.3} if "theta" in plan.inputs.open else {})
        leaves = [operand.numbers(given_) for operand in plan.whole.operands]
        leaves = [n if n.dtype == bool else n.astype(dtype) for n in leaves]
        found = execute(plan.whole, leaves, carrier(NUMPY), None, lambda n: np.asarray(n, dtype))
        for reading in plan.whole.readings.values():
            read = found[reading.light][0][: reading.components]
            assert {np.asarray(component).dtype for component in read} == {np.dtype(dtype)}


class _Emptied:
    """A loop from which light comes as it arrives."""

    def count(self, _):
        return 4

    def lights(self, arriving):
        return dict(arriving)


@rows("dtype", [np.float32, np.float64, np.longdouble])
def test_exponents_of_dark_light_stay_integers_of_the_size_that_frexp_gives(dtype):
    # NumPy from 2.5 refuses integers that do not fit the others.
    way = ScaledCarrier(NUMPY)
    intensity, dark = np.array([0.0, 1.0, 1e-30], dtype), np.zeros(3, dtype)
    state = way.emit((intensity, dark, dark, dark))
    none = way.act(SCALE, (dark,), state)
    states = [none, way.add(state, none), way.meet(_Emptied(), {0: state})[0]]
    assert {exponent.dtype for _, exponent in states} == {np.frexp(intensity)[1].dtype}


def test_faint_light_that_meets_none_at_all_in_a_loop_keeps_its_digits():
    way, dark = ScaledCarrier(NUMPY), np.zeros(1)
    faint = way.emit((np.ones(1), dark, dark, dark))
    for _ in range(9):
        faint = way.act(SCALE, (np.full(1, 1e-300),), faint)
    arriving = {0: faint, 1: way.emit((dark, dark, dark, dark))}
    components, exponent = way.read(way.meet(_Emptied(), arriving)[0])
    assert np.log10(components[0]) + exponent * np.log10(2.0) == pytest.approx(-2700.0, abs=1e-9)


PARTS = st.tuples(st.floats(1e-3, 10), st.floats(-1, 1), st.floats(-5, 5), st.floats(-5, 5))
COMPONENTS = PARTS.map(lambda p: (p[0], p[0] * p[1], *p[2:]))


@given(first=COMPONENTS, second=COMPONENTS)
def test_carrying_light_loses_nothing_and_lights_add_component_by_component(first, second):
    one, other = carry(FLOAT, first), carry(FLOAT, second)
    np.testing.assert_allclose(stokes_of(FLOAT, one), first, rtol=1e-15)
    total = stokes_of(FLOAT, add(FLOAT, one, other))
    np.testing.assert_allclose(total, np.add(first, second), rtol=1e-14, atol=1e-14)


def test_light_next_to_crossed_filters_keeps_its_digits():
    # A leakage of 1e-20 behind a crossed polariser is 1e-20, not the rounding of 1.
    path = op.Source(2.0) >> op.Polarizer(leakage=1e-20) >> op.Polarizer(np.pi / 2) >> op.Detector()
    np.testing.assert_allclose(path.trace().stokes, [1e-20, -1e-20, 0, 0], rtol=1e-15, atol=1e-36)
    assert sine(FLOAT)(math.pi) == cosine(FLOAT)(math.pi / 2) == 0.0
    assert cosine(NUMPY)(np.float32(np.pi / 2)) == 0.0
    assert cosine(NUMPY)(np.pi / 2 - 1e-12) == np.cos(np.pi / 2 - 1e-12)
    axes = np.random.default_rng(3).uniform(-4, 4, 100_000)
    path = op.Source() >> op.Polarizer(axes) >> op.Polarizer(axes + np.pi / 2) >> op.Detector()
    light = path.trace().intensity
    assert np.all((light >= 0.0) & (light <= 1e-15))


@given(angle=st.floats(-7.0, 7.0))
def test_elsewhere_cosine_and_sine_are_those_of_the_platform(angle):
    for ours, theirs in ((cosine, math.cos), (sine, math.sin)):
        assert abs(ours(FLOAT)(angle) - theirs(angle)) <= 4.5e-16


@rows("distance", [1e-1, 1e-3, 1e-5, 1e-7, 1e-9, 1e-12])
def test_nearly_crossed_polarizers_keep_malus_law_to_the_last_digits(distance):
    path = op.Source(2.0) >> op.Polarizer() >> op.Polarizer(distance) >> op.Polarizer(np.pi / 2)
    law = np.cos(distance) ** 2 * np.sin(distance) ** 2
    assert (path >> op.Detector()).trace().intensity == pytest.approx(law, rel=1e-14)


@given(turn=st.floats(-6.2, 6.2), incidence=st.floats(0.0, 1.57), axis=st.floats(-6.2, 6.2))
def test_no_intensity_is_negative_by_a_rounding(turn, incidence, axis):
    path = op.load_preset("npgr026", n1=3.836, n2=0.2842, delta=1.2187)
    assert path.trace(rho=turn, phi=incidence, filter=axis).intensity >= -1e-30


def test_angles_so_huge_that_their_rounding_is_a_turn_keep_their_length():
    light = op.Rotator("1e16 rad").mueller() @ op.Light([1.0, 1.0, 0.0, 0.0])
    assert light.dop == pytest.approx(1.0, abs=1e-15)


def test_the_precision_is_the_composers_not_that_of_the_input():
    path = op.load_preset("npgr026")
    single = np.float32(0.8)
    for value in (single, np.array(single), [single]):
        stokes = np.ravel(path.trace(delta=value).stokes)
        np.testing.assert_array_equal(stokes, path.trace(delta=float(single)).stokes)
    assert op.fresnel_reflection(np.float32(1.5), 1.0, 0.0)[0].dtype == np.float64


SHARES = st.floats(0.0, 1.0)
ROUNDING = 20 * np.finfo(float).eps


def behind(dop, diattenuations, axes):
    """The intensity behind diattenuators of mean 1, each with an axis on the Poincare sphere."""
    s0, s = np.ones(len(dop)), dop[:, np.newaxis] * axes[0]
    for d, axis in zip(diattenuations, axes[1:], strict=True):
        along = np.sum(s * axis, axis=-1)
        # Chipman, Lam & Young (2018): the diattenuator of axis a, its mean transmittance 1.
        across = np.sqrt(1.0 - d * d)[:, np.newaxis]
        s_along = along[:, np.newaxis] * axis
        s = d[:, np.newaxis] * s0[:, np.newaxis] * axis + s_along + across * (s - s_along)
        s0 = s0 + d * along
    return s0


@pytest.mark.parametrize("length", slow_except([2, 5, 10], range(2, 11)))
def test_no_chain_leaves_its_bounds_and_some_reach_them(rng, length):
    count = 112_000  # A million for all lengths together.
    dop = rng.choice([0.0, 1.0, -1.0], count, p=[0.3, 0.1, 0.6])
    dop = np.where(dop < 0.0, rng.random(count), dop)
    diattenuations = rng.random((length, count)) ** rng.choice([0.2, 1.0, 4.0], (length, 1))
    diattenuations[0, ::50] = 1.0
    axes = [unit_vectors(rng, count) for _ in range(length + 1)]
    # Some with all axes along one line, one way or the other.
    for axis in axes:
        axis[::5] = axes[0][::5] * rng.choice([-1.0, 1.0], (len(axis[::5]), 1))
    ratio = behind(dop, diattenuations, axes)
    lower, upper = op.intensity_bounds(dop, list(diattenuations))
    slack = 1e-14 * upper  # What goes to and fro is as large as that.
    assert np.all((lower - slack <= ratio) & (ratio <= upper + slack))
    lit = lower > 1e-6
    assert min(np.max(ratio / upper), np.max(lower[lit] / ratio[lit])) > 0.99


@given(dop=SHARES, shares=st.lists(SHARES, max_size=6))
def test_bounds_enclose_one_by_the_hyperbolic_formula_whatever_the_signs(dop, shares):
    lower, upper = op.intensity_bounds(dop, shares)
    assert 0.0 <= lower <= 1.0 + 1e-15
    assert upper >= 1.0 - 1e-15
    assert (lower, upper) == op.intensity_bounds(dop, [-share for share in shares])
    if max(dop, *shares, 0.0) < 0.999:
        lengths = np.arctanh([dop, *shares])
        scale = np.prod(np.cosh(lengths))
        least = max(0.0, 2.0 * lengths.max() - lengths.sum())
        assert upper == pytest.approx(np.cosh(lengths.sum()) / scale, rel=1e-9)
        assert lower == pytest.approx(np.cosh(least) / scale, rel=1e-9)


@rows(
    "dop, shares, message",
    [
        (1.5, [], "source_dop"),
        (0.0, [0.1, -2.0], r"diattenuations\[1\]"),
        (0.5, [1j], "complex"),
        (0.5, 0.5, "sequence"),
    ],
)
def test_shares_that_cannot_be_are_refused(dop, shares, message):
    with pytest.raises(op.errors.ParameterError, match=message):
        op.intensity_bounds(dop, shares)


@rows("terms", [1, 2, 3, 4])
@rows("least", [-0.1, -1e-6, -1e-13])
def test_the_sign_of_the_least_eigenvalue_is_told_to_a_few_roundings(terms, least):
    mixed = of_jones(jones(np.random.default_rng(terms), 2000, terms)).sum(axis=-3)
    # The ideal depolariser has the eigenvalues 1/4: of M00 = 1, the least one is known.
    matrices = mixed / mixed[:, :1, :1] + 4.0 * least * np.diag([1.0, 0.0, 0.0, 0.0])
    matrices /= matrices[:, :1, :1]
    values = op.Mueller(matrices).cloude_eigenvalues[:, 3]
    numbers = np.moveaxis(matrices.reshape(-1, 16), -1, 0)
    for spare in (0.0, -0.5 * least, -least, -2.0 * least):
        found = is_physical(NUMPY, numbers, spare)
        assert np.all(found[values > -spare + ROUNDING])
        assert not np.any(found[values < -spare - ROUNDING])


@rows("size", [1e-300, 1.0, 1e300])
def test_elements_of_any_size_are_judged_by_what_they_do(size):
    can_be = [1, 1, 1, 1], [1, 1, -1, -1], [1, 0, 0, 0]
    cannot = [1, 1, 1, -1], [1, 1.001, 1, 1], [0, 1, 0, 0], [-1, -1, -1, -1]
    for diagonal in (*can_be, *cannot):
        numbers = (size * np.diag(diagonal).astype(float)).ravel().tolist()
        assert is_physical(FLOAT, numbers, 1e-12) == (diagonal in can_be), diagonal

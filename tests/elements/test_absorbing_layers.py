"""Layers that absorb: against 50 digits, Beer and Lambert, tmm's algorithm, and energy."""

import re
from itertools import pairwise

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import optipath as op
from chains import by_engine
from incoherent_stacks import exact_stack, mueller_of
from tables import rows
from wired import wired

pytestmark = pytest.mark.filterwarnings(
    "ignore::optipath.errors.CoherenceWarning"
)  # Of films, on purpose.

WAVE = {"wavelength": 500e-9}
FILM = {"lengths": [op.Parameter("d")], **WAVE}
OF_PANE = {"lengths": [4e-3], "wavelength": 550e-9}
STATE = [1.0, 0.3, 0.4, 0.5]
GLASS = [1.0, 1.5 + 1e-6j, 1.0]


def drawn(rng, *, thick):
    """Media, lengths, a wavelength and an incidence; media may be thinner than the wavelength."""
    count = rng.integers(1, 7)
    layers = [
        complex(rng.uniform(1.3, 2.5), 10.0 ** rng.uniform(-9, -0.52) * (rng.random() < 0.7))
        for _ in range(count)
    ]
    substrate = complex(rng.uniform(0.9, 2.5), rng.uniform(0, 3) * (rng.random() < 0.5))
    first = float(rng.uniform(1.0, 1.3))
    wavelength = float(10.0 ** rng.uniform(-6.6, -5.0))
    least = wavelength * (1.0 if thick else 0.2)
    lengths = 10.0 ** rng.uniform(np.log10(least), 0, count)
    media = [n.real if n.imag == 0 else n for n in layers]
    return [first, *media, substrate], lengths.tolist(), wavelength, float(rng.uniform(0, 1.5))


def stack_of(case, **others):
    media, lengths, wavelength, incidence = case
    return op.LayerStack(media, incidence, lengths=lengths, wavelength=wavelength, **others)


@settings(max_examples=5)
@given(seed=st.integers(0, 2**32 - 1))
def test_a_stack_is_the_linear_system_of_its_intensities_in_50_digits(seed):
    rng = np.random.default_rng(seed)
    for thick in (True, False):
        case = drawn(rng, thick=thick)
        exact, stack = exact_stack(*case), stack_of(case)
        for leaves in ("reflected", "transmitted"):
            expected = mueller_of(getattr(exact, leaves))
            found = stack.mueller("in", leaves).matrix
            # The light that has passed has the rounding of an exponent of up to 700.
            scale = 1e-12 if leaves == "transmitted" else 5e-14
            np.testing.assert_allclose(found, expected, rtol=0, atol=scale * expected[0, 0])
        shares = np.array([[float(share) for share in layer] for layer in exact.absorbed])
        tolerance = 1e-13 * (1.0 + np.abs(shares).max())
        np.testing.assert_allclose(stack.absorbed(), shares.mean(1), rtol=0, atol=tolerance)
        seen = 0.5 * (1.3 * shares[:, 0] + 0.7 * shares[:, 1])
        np.testing.assert_allclose(stack.absorbed([1, 0.3, 0.4, 0.5]), seen, rtol=0, atol=tolerance)
    # Light from behind.
    media, lengths, wavelength, _ = drawn(rng, thick=True)
    case = [*media[:-1], 1.4], lengths, wavelength, float(rng.uniform(0, 1.3))
    exact, stack = exact_stack(*case, back=True), stack_of(case)
    for leaves, parts in (("transmitted", exact.reflected), ("reflected", exact.transmitted)):
        found, expected = stack.mueller("back", leaves).matrix, mueller_of(parts)
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-13 * max(expected[0, 0], 1e-9))
    shares = [float(s + p) / 2 for s, p in exact.absorbed]
    np.testing.assert_allclose(stack.absorbed(enters="back"), shares, rtol=0, atol=1e-13)


def test_an_incidence_before_other_parallel_faces_is_right_too():
    case = [1.33, 1.5 + 1e-4j, 1.2], [1e-4], 5e-7, 0.9
    exact, stack = exact_stack(*case, n0=1.1), stack_of(case, incidence_in=1.1)
    for leaves in ("reflected", "transmitted"):
        expected = mueller_of(getattr(exact, leaves))
        np.testing.assert_allclose(stack.mueller("in", leaves).matrix, expected, rtol=0, atol=1e-15)


def tmm_incoherent(polarization, media, lengths, incidence, wavelength):
    """R, T and the absorbed shares by the transfer matrices of tmm's inc_tmm, in 50 digits.

    Written after the published algorithm (S. J. Byrnes, arXiv:1603.02720; tmm is not installed).
    """
    media = [mpmath.mpc(m) for m in media]
    y = media[0].real * mpmath.sin(incidence)
    # Cosines by Snell's law, of the wave that goes forward.
    cosines = [mpmath.sqrt(1 - (y / m) ** 2) for m in media]
    cosines = [c if (m * c).imag >= 0 else -c for m, c in zip(media, cosines, strict=True)]

    def power(i, j):
        (m1, c1), (m2, c2) = (media[i], cosines[i]), (media[j], cosines[j])
        if polarization == "s":
            r, t = (m1 * c1 - m2 * c2) / (m1 * c1 + m2 * c2), 2 * m1 * c1 / (m1 * c1 + m2 * c2)
            return abs(r) ** 2, abs(t) ** 2 * (m2 * c2).real / (m1 * c1).real
        r, t = (m2 * c1 - m1 * c2) / (m2 * c1 + m1 * c2), 2 * m1 * c1 / (m2 * c1 + m1 * c2)
        share = (m2 * mpmath.conj(c2)).real / (m1 * mpmath.conj(c1)).real
        return abs(r) ** 2, abs(t) ** 2 * share

    last = len(media) - 1
    passes = [
        mpmath.exp(-4 * mpmath.pi * length * (media[i] * cosines[i]).imag / wavelength)
        for i, length in zip(range(1, last), lengths, strict=True)
    ]
    matrices = []
    for i in range(last):
        (R, T), (R_back, T_back) = power(i, i + 1), power(i + 1, i)
        rows = mpmath.matrix([[1, -R_back], [R, T_back * T - R_back * R]]) / T
        P = passes[i - 1] if i else mpmath.mpf(1)
        matrices.append(mpmath.diag([1 / P, P]) * rows)
    total = mpmath.eye(2)
    for matrix in matrices:
        total = total * matrix
    T, R = 1 / total[0, 0], total[1, 0] / total[0, 0]
    light, forward_backward = mpmath.matrix([T, 0]), {last: (T, 0)}
    for i in range(last - 1, 0, -1):
        light = matrices[i] * light
        forward_backward[i] = light[0], light[1]
    entering = []
    for i in range(1, last + 1):
        before = forward_backward[i - 1][0] * passes[i - 2] if i > 1 else 1
        entering.append(before * power(i - 1, i)[1] - forward_backward[i][1] * power(i, i - 1)[1])
    return R, T, [a - b for a, b in pairwise(entering)]


@rows("k", [1e-9, 1e-4, 1e-2, 0.2])
@rows("incidence", [0.0, 0.7, 1.4])
def test_a_stack_is_what_tmm_means_by_incoherent_layers(k, incidence):
    media, wavelength = [1.0, 1.5 + 1j * k, 1.4, 2.1 + 2j * k, 1.3 + 0.5j], 5e-7
    lengths = [2e-8 / k, 1e-4, 1e-8 / k]
    stack = op.LayerStack(media, incidence, lengths=lengths, wavelength=wavelength)
    for sign, polarization in ((1, "s"), (-1, "p")):
        with mpmath.workdps(50):
            exact = tmm_incoherent(polarization, media, lengths, mpmath.mpf(incidence), wavelength)
        R, T, shares = (np.asarray(part, float) for part in exact)
        light = op.Light([1.0, sign, 0.0, 0.0])
        for leaves, expected in (("reflected", R), ("transmitted", T)):
            found = (stack.mueller("in", leaves) @ light).intensity
            np.testing.assert_allclose(found, expected, rtol=1e-13)
        np.testing.assert_allclose(stack.absorbed(light), shares, rtol=1e-12, atol=1e-15)


def test_a_plate_that_hardly_absorbs_dims_light_along_its_slanted_way():
    # Of a plate of R and t = exp(-alpha d / cos of the angle in it): T = (1-R)^2 t / (1 - R^2 t^2).
    n, alpha, d, theta = 1.5, 20.0, 0.01, 0.8
    inside = np.arcsin(np.sin(theta) / n)
    left = np.exp(-alpha * d / np.cos(inside))
    A, B, _, _ = op.fresnel_reflection(n, np.cos(theta), np.sin(theta))
    each = [(1 - R) ** 2 * left / (1 - (R * left) ** 2) for R in (A + B, A - B)]
    plate = op.LayerStack(
        [1, op.Material(n, alpha * 1e-6 / (4 * np.pi)), 1], theta, lengths=[d], wavelength=1e-6
    )
    found = plate.mueller("in", "transmitted").matrix[0, 0]
    np.testing.assert_allclose(found, sum(each) / 2, rtol=1e-10)


@settings(max_examples=20, deadline=None)
@given(seed=st.integers(0, 2**32 - 1))
def test_what_is_reflected_let_through_and_absorbed_is_all_that_came(seed):
    rng = np.random.default_rng(seed)
    case = drawn(rng, thick=True)
    stack, light = stack_of(case), op.Light([1.0, *rng.uniform(-0.5, 0.5, 3)])
    out = [(stack.mueller("in", leaves) @ light).intensity for leaves in stack.outputs]
    shares = stack.absorbed(light)
    assert sum(out) + shares.sum() == pytest.approx(1.0, abs=1e-13)


@rows("leaves", ["reflected", "transmitted"])
def test_layers_known_to_be_lossless_are_what_they_are_without_lengths_bit_for_bit(leaves, rng):
    for _ in range(10):
        media, theta = [1.0, *rng.uniform(1.0, 2.5, 3), 0.6 + 2j], float(rng.uniform(0, 1.5))
        given = [media[0], complex(media[1], 0.0), op.Material(media[2], 0.0), *media[3:]]
        plain = op.LayerStack(media, theta)
        told = op.LayerStack(given, theta, lengths=[1e-3, 1e-6, 1.0], wavelength="500 nm")
        found, expected = (stack.mueller("in", leaves).matrix for stack in (told, plain))
        np.testing.assert_array_equal(found, expected)
        assert not told.absorbed().any()


def test_a_layer_is_two_interfaces_with_a_medium_between_in_a_loop():
    m, theta, d, wavelength = 1.5 + 0.01j, 0.9, 1e-5, 500e-9
    # Along the normal, as a wave fades whose planes of constant amplitude are the faces.
    fades = 4.0 * np.pi / wavelength * np.sqrt(m * m - np.sin(theta) ** 2).imag
    way, seen = op.Medium(d, absorption=float(fades)), op.Detector()
    nodes = {"lamp": op.Source(1.0, STATE), "front": op.Interface(m, theta), "down": way, "up": way}
    nodes |= {"behind": op.Interface(1.2, op.FOLLOWS, outside=op.FOLLOWS)}
    nodes |= {"reflected": seen, "transmitted": seen}
    links = "lamp -> front, front.transmitted -> down, down -> behind, behind.reflected -> up"
    ends = "up -> front.back, front.reflected -> reflected, behind.transmitted -> transmitted"
    stack = op.LayerStack([1.0, m, 1.2], theta, lengths=[d], wavelength=wavelength)
    for leaves, light in wired(nodes, f"{links}, {ends}", loops="sum").trace_all().items():
        expected = stack.mueller("in", leaves).matrix @ STATE
        np.testing.assert_allclose(light.stokes, expected, rtol=0, atol=1e-15)


def test_opaque_layers_let_nothing_through_and_absorb_all_that_enters():
    stack = op.LayerStack([1.0, 1.5 + 0.3j, 1.2 + 0.01j, 1.0], 0.7, lengths=[1.0, 1.0], **WAVE)
    face = op.Interface(1.5 + 0.3j, 0.7).mueller("in", "reflected").matrix
    found = stack.mueller("in", "reflected").matrix
    np.testing.assert_allclose(found, face, rtol=1e-15, atol=1e-16)
    assert not stack.mueller("in", "transmitted").matrix.any()
    np.testing.assert_allclose(stack.absorbed(), [1.0 - face[0, 0], 0.0], rtol=1e-15)


def path_of():
    m, theta, d, wavelength = map(op.Parameter, ("m", "theta", "d", "wavelength"))
    stack = op.LayerStack([1.0, m, 0.6 + 2j], theta, lengths=[d], wavelength=wavelength)
    return op.Source(1.0, STATE) >> stack >> op.Detector()


def exact_stokes(m, theta, d, wavelength):
    """What comes back of the light of the path, in as many digits as are worked with."""
    exact = exact_stack([1.0, m, 0.6 + 2j], [d], wavelength, theta, digits=mpmath.mp.dps)
    s, p, both = exact.reflected
    sums = (s + p) / 2 + 0.3 * (s - p) / 2, (s - p) / 2 + 0.3 * (s + p) / 2
    across = 0.4 * both.real + 0.5 * both.imag, 0.5 * both.real - 0.4 * both.imag
    return np.array([*sums, *across])


@by_engine
def test_engines_agree(engine):
    theta, d = np.linspace(0.0, 1.5, 7), np.logspace(-6, 0, 7)
    plan = op.Composer(engine=engine).compose(path_of())
    light = plan.run(m=1.5 + 1e-5j, theta=theta, d=d, wavelength=500e-9)
    with mpmath.workdps(50):
        expected = [exact_stokes(1.5 + 1e-5j, *pair, 500e-9) for pair in zip(theta, d, strict=True)]
    np.testing.assert_allclose(light.stokes, np.array(expected, float), rtol=0, atol=1e-14)


def test_a_layer_whose_length_jax_traces_may_be_of_any_length(jax):
    plan = op.Composer(engine="jax").compose(path_of())
    given = {"m": 1.5 + 1e-5j, "theta": 0.6, "wavelength": 500e-9}
    # Traced, and not compiled, which takes long.
    light = jax.eval_shape(lambda d: plan.run(d=d, **given).stokes, 1e-9)
    assert light.shape == (4,)


@pytest.mark.slow
def test_slopes_are_those_of_50_digits_and_finite_where_a_layer_is_opaque(jax, jacobian):
    plan = op.Composer(engine="jax").compose(path_of())

    def stokes(values, k):
        theta, d, wavelength = values
        return plan.run(m=1.5 + 1j * k, theta=theta, d=d, wavelength=wavelength).stokes

    given = [(0.1, 1.0), *((k, 1e-8 / k) for k in (1e-7, 1e-2))]
    values = np.array([[0.6, d, 500e-9] for _, d in given]), np.array([k for k, _ in given])
    slopes = jax.vmap(jacobian(stokes))(*values)
    assert np.isfinite(slopes[0]).all()
    for (k, d), found in zip(given[1:], slopes[1:], strict=True):
        at = [0.6, d, 500e-9]
        with mpmath.workdps(60):
            for place in range(3):
                step = mpmath.mpf(at[place]) * mpmath.mpf(10) ** -20
                ends = [[*at[:place], at[place] + d, *at[place + 1 :]] for d in (-step, step)]
                less, more = (exact_stokes(1.5 + 1j * k, *end) for end in ends)
                expected = np.array((more - less) / (2 * step), float)
                scale = np.abs(expected).max()
                np.testing.assert_allclose(found[:, place], expected, rtol=0, atol=1e-12 * scale)


def test_a_thick_pile_of_30_layers_composes_and_goes_into_a_file_and_back():
    pile = op.LayerStack(
        [1.0, *[1.5 + 1e-6j, 1.0] * 14, 1.5 + 1e-6j, 1.0], 0.9, lengths=[1e-3] * 29, **WAVE
    )
    out = sum(pile.mueller("in", leaves).matrix[0, 0] for leaves in pile.outputs)
    assert out + pile.absorbed().sum() == pytest.approx(1.0, abs=1e-14)
    path = path_of()
    assert 'lengths = ["$d"]' in path.to_toml()
    given = {"m": 1.5 + 1e-5j, "theta": 0.3, "d": "2 mm", "wavelength": "550 nm"}
    assert path.bind(**given).trace() == path.trace(**given)
    again = op.LayerStack([1, 1.5, 1], 0.3, lengths=["1 mm"], wavelength="5 um")
    assert again == op.LayerStack([1, 1.5, 1], 0.3, lengths=[1e-3], wavelength=5e-6)
    assert again != op.LayerStack([1, 1.5, 1], 0.3, lengths=[2e-3], wavelength=5e-6)


@rows(
    "given, message",
    [
        ({}, r"indices\[1\] is complex.* give the stack the lengths .* and the wavelength, too"),
        ({"lengths": [1e-3]}, r"absorbs, give the stack the wavelength, too"),
        (WAVE, r"absorbs, give the stack the lengths \(one for each layer\), too"),
        (
            {"lengths": [1.0, 2.0], **WAVE},
            "lengths is .*; give a list of lengths, one for each layer",
        ),
        ({"lengths": 1e-3, **WAVE}, r"lengths is 0\.001; give a list of lengths"),
        ({"lengths": op.Parameter("d"), **WAVE}, "cannot be a parameter; give a list"),
        ({"lengths": [-1.0], **WAVE}, r"lengths\[0\] is -1000 mm"),
        ({"lengths": ["1 deg"], **WAVE}, r"lengths\[0\]: '1 deg' is no length"),
        ({"lengths": [1.0], "wavelength": 500.0}, r"wavelength is 5e\+11 nm"),
    ],
)
def test_what_is_missing_or_does_not_fit_is_told(given, message):
    with pytest.raises(op.errors.ValueFault, match=message):
        op.LayerStack(GLASS, 0.5, **given)


def test_values_by_which_light_would_gain_are_told_when_they_are_given():
    path = op.Source() >> op.LayerStack([1.0, op.Parameter("n"), 1.0], 0.5) >> op.Detector()
    with pytest.raises(op.OptipathError, match=r"give the stack the lengths .* and the wavelength"):
        path.trace(n=1.5 + 1e-6j)
    path = op.Source() >> op.LayerStack([1.5, 1.2 + 1e-3j, 1.5], 1.2, **FILM) >> op.Detector()
    with pytest.raises(op.OptipathError, match="by interference; give a length of at least"):
        path.trace(d=2e-8)
    assert path.trace(d=1e-5).intensity < 1.0
    n, k, d = map(op.Parameter, "nkd")
    stack = op.LayerStack([1.0, op.Material(n, k), 1.0], 0.5, lengths=[d], **WAVE)
    with pytest.raises(op.OptipathError) as told:
        (op.Source() >> stack >> op.Detector()).trace(n=0.2, k=3.0, d=1e-8)
    words = "n = 0.2 (parameter 'n') and k = 3 (parameter 'k'), at a length of 10 nm (parameter"
    assert str(told.value).count("light would gain") == str(told.value).count(words) == 1


# Media, incidence in degrees, and length in wavelengths: surface plasmons at a face, and waves
# that hardly go on.
GAINS = [
    ([1.5, 1.2 + 1e-3j, 1.5], np.degrees(1.2), 0.04),
    ([1.515, 0.06 + 4.2j, 1.0], 42.812, 60 / 633),
    ([1.515, 0.06 + 4.2j, 1.0], 42.812, 58.42 / 633),
    ([2.803, 1.0902 + 0.0046986j, 2.0616 + 9.4379j], 23.067, 1.23),
    ([1.4985, 0.37707 + 0.0005011j, 1.8664 + 3.6961j], 14.663, 5.675),
    ([1.6547, 0.065035 + 0.00021363j, 2.2167 + 0.0582j], 2.2516, 1.0),
]


@rows("media, degrees, length", GAINS)
def test_no_light_comes_from_nothing_at_the_length_that_is_told(media, degrees, length):
    def stack(length):
        theta = np.radians(degrees)
        return op.LayerStack(media, theta, lengths=[length], wavelength=1e-6)

    with pytest.raises(
        op.errors.PathError, match=r"R \+ T is above 1 by .*least ([0-9.]+) nm"
    ) as told:
        stack(length * 1e-6).mueller()
    least = float(re.search(r"at least ([0-9.]+) nm", str(told.value))[1]) * 1e-9
    with pytest.raises(op.errors.PathError, match="light would gain"):
        stack(0.99 * least).mueller()
    exact = exact_stack(media, [least], 1e-6, np.radians(degrees))
    assert min(float(share) for share in exact.absorbed[0]) >= 0.0
    for s_or_p in range(2):
        shares = exact.reflected[s_or_p], exact.transmitted[s_or_p]
        assert all(0.0 <= float(share) <= 1.0 for share in shares)
    assert 0.0 <= stack(least).absorbed()[0] <= 1.0


@settings(max_examples=12, deadline=None)
@given(seed=st.integers(0, 2**32 - 1))
def test_a_length_of_one_wave_along_the_normal_over_2_pi_is_always_enough(seed):
    rng = np.random.default_rng(seed)
    m, behind = (
        complex(10.0 ** rng.uniform(-2, 0.5), 10.0 ** rng.uniform(-6, 1)) for _ in range(2)
    )
    first, theta = float(rng.uniform(1, 4)), float(rng.uniform(0, 1.57))
    goes_on = np.sqrt(m * m - (first * np.sin(theta)) ** 2).real
    length = 1.0001 * 1e-6 / (2.0 * np.pi * goes_on)
    stack = op.LayerStack([first, m, behind], theta, lengths=[length], wavelength=1e-6)
    for sign in (1.0, -1.0):
        light = op.Light([1.0, sign, 0.0, 0.0])
        assert (stack.mueller() @ light).intensity <= 1.0 + 1e-12
        assert stack.absorbed(light)[0] >= -1e-12


@rows("media", [[1.0, 1.5 + 1e-5j, 1.3], [1.0, 1.5 + 1e-10j, 0.05 + 4j]])
def test_a_layer_that_is_next_to_lossless_may_have_no_length(media):
    thin = op.LayerStack(media, 0.9, lengths=[0.0], **WAVE)
    clear = op.LayerStack([media[0], media[1].real, media[2]], 0.9)
    found, expected = (stack.mueller().matrix[0] for stack in (thin, clear))
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-9)
    np.testing.assert_allclose(thin.absorbed(), 0.0, atol=1e-9)


@rows("indices", [[1, op.FOLLOWS, 1.5], [1, (1.5, 1e-6), 1], op.Parameter("d"), [1.5]])
def test_what_is_wrong_with_indices_is_all_that_is_told(indices):
    with pytest.raises(op.errors.ValueFault, match="indices") as told:
        op.LayerStack(indices, 0.3, lengths=["1 mm"], wavelength=5e-7)
    assert "lengths has" not in str(told.value)


def test_what_is_absorbed_is_that_of_light_in_its_own_frame_and_asked_with_words():
    stack, turned = (op.LayerStack(GLASS, 1.0, azimuth, **OF_PANE) for azimuth in (0.0, "90 deg"))
    np.testing.assert_allclose(stack.absorbed([1, 1, 0, 0]), turned.absorbed([1, -1, 0, 0]))
    several = op.LayerStack(GLASS, [0.1, 0.2], **OF_PANE)
    assert several.absorbed().shape == (2, 1)
    assert np.isnan(several.absorbed([0, 0, 0, 0])).all()
    assert several.absorbed(np.ones((3, 1, 4)) * [1, 0, 0, 0]).shape == (3, 2, 1)
    with pytest.raises(op.errors.ShapeError, match=r"layer-stack \(2,\), the light \(3,\)"):
        several.absorbed(np.ones((3, 4)) * [1, 0, 0, 0])
    with pytest.raises(op.errors.PathError, match=r"no in-port .reflected.; light arrives at .in."):
        stack.absorbed(enters="reflected")
    with pytest.raises(op.OptipathError, match="polarised by 200 %"):
        stack.absorbed([1, 2, 0, 0])
    stack = op.LayerStack([1.0, op.Parameter("m"), 1.0], 0.5, **OF_PANE)
    with pytest.raises(op.errors.PathError, match="parameter 'm' of layer-stack has no value yet"):
        stack.absorbed()

"""Stacks of layers against Stokes' pile, 50-digit adding, and their own boundaries."""

import warnings

import numpy as np
import pytest

import optipath as op
from optipath.lab.path_reference import exact_lights, exact_stokes
from tables import rows
from wired import read_back, wired


def path_of(stack, enters="in", leaves="reflected", state=(1.0, 0.3, 0.4, 0.5)):
    nodes = {"lamp": op.Source(1.0, state), "stack": stack, "eye": op.Detector()}
    return wired(nodes, f"lamp.out -> stack.{enters}, stack.{leaves} -> eye.in")


def assert_is_exact(path, atol=4e-15):
    exact = [float(part) for part in exact_lights(path)["eye"].stokes]
    np.testing.assert_allclose(path.trace().stokes, exact, rtol=0, atol=atol)


@rows("faces", [2, 4, 10])
def test_a_pile_of_plates_is_stokes_formula(faces):
    theta = np.linspace(0, 1.5, 40)
    pile = op.LayerStack([1.0, 1.5] * (faces // 2) + [1.0], theta)
    A, B, _, _ = op.fresnel_reflection(1.5, np.cos(theta), np.sin(theta))
    along, across = ((1 - F) / (1 + (faces - 1) * F) for F in (A + B, A - B))
    matrix = pile.mueller("in", "transmitted").matrix
    np.testing.assert_allclose(matrix[:, 0, 0], (along + across) / 2, rtol=2e-14)
    np.testing.assert_allclose(matrix[:, 0, 1], (along - across) / 2, rtol=0, atol=2e-15)


@rows("leaves", ["reflected", "transmitted"])
def test_a_stack_on_metal_and_light_from_behind_are_right_to_the_last_digits(rng, leaves):
    for layers in (0, 1, 3) * 2:
        indices = [1.0, *rng.uniform(0.7, 2.5, layers), complex(*rng.uniform(0.2, 3, 2))]
        assert_is_exact(path_of(op.LayerStack(indices, float(rng.uniform(0, 1.5))), "in", leaves))
        indices = rng.uniform(1.0, 2.5, 4).tolist()
        assert_is_exact(path_of(op.LayerStack(indices, float(rng.uniform(0, 1.5))), "back", leaves))


@rows("turned, other", [("reflected", "transmitted"), ("transmitted", "reflected")])
def test_light_from_behind_is_that_of_the_stack_turned_round(turned, other):
    # Glass seen from behind reflects all light where it meets the second medium.
    indices, incidence = [1.9, 1.3, 2.4, 2.3], 1.1
    behind = float(np.arcsin(indices[0] / indices[-1] * np.sin(incidence)))
    back = path_of(op.LayerStack(indices, incidence), "back", other)
    front = path_of(op.LayerStack(indices[::-1], behind), "in", turned)
    expected = front.trace().stokes
    for found in (back.trace().stokes, *(exact_stokes(path)["eye"] for path in (back, front))):
        np.testing.assert_allclose([float(part) for part in found], expected, rtol=0, atol=4e-15)


def test_a_stack_of_two_media_is_an_interface_and_one_like_its_neighbour_nothing():
    stack, interface = op.LayerStack([1.2, 0.6 + 2j], 0.8), op.Interface(0.6 + 2j, 0.8, 1.2)
    for leaves in ("reflected", "transmitted"):
        found, expected = (e.mueller("in", leaves).matrix for e in (stack, interface))
        np.testing.assert_allclose(found, expected, rtol=1e-15, atol=2e-16)
    plain, twice = op.LayerStack([1.0, 1.5, 1.0], 0.8), op.LayerStack([1.0, 1.5, 1.5, 1.0], 0.8)
    np.testing.assert_allclose(
        twice.mueller().matrix, plain.mueller().matrix, rtol=1e-15, atol=2e-16
    )


def test_energy_is_kept_from_either_side_and_none_passes_a_gap_beyond_the_critical_angle(rng):
    gap = op.LayerStack([1.5, 1.0, 1.5], incidence=1.0)
    assert gap.mueller("in", "reflected").matrix[0, 0] == 1.0
    assert not gap.mueller("in", "transmitted").matrix.any()
    stack = op.LayerStack(rng.uniform(1.0, 2.5, 12).tolist(), np.linspace(0, 1.57, 50))
    for enters in ("in", "back"):
        first = sum(stack.mueller(enters, leaves).matrix[:, 0] for leaves in stack.outputs)
        np.testing.assert_allclose(first, [[1, 0, 0, 0]] * 50, rtol=0, atol=1e-14)


def test_a_stack_goes_into_a_file_and_back(tmp_path):
    path = path_of(op.LayerStack([1.0, op.Parameter("n"), 0.6 + 2j], 0.5))
    assert 'indices = [1.0, "$n", { n = 0.6, k = 2.0 }]' in path.to_toml()
    assert read_back(path, tmp_path) == path
    assert path.bind(n=1.5).trace() == path.trace(n=1.5)


@rows(
    "indices, message",
    [
        (1.5, r" is 1.5; give a list of two indices or more.* such as \[1, 1.5, 1.33\]"),
        ([1.5], "give a list of two indices or more"),
        (None, " is None; give a list of two indices or more"),
        (op.Parameter("n"), "cannot be a parameter; give a list"),
        ([1.0, 1.5 + 1j, 1.0], r"\[1\] is complex.*give the stack the lengths.*and the wavel"),
        ([1.0, op.Material(1.5, 0.1), 1.0], r"\[1\]\.k is 0\.1"),
        ([0.0, 1.5], r"\[0\] is 0"),
        ([1.5] * 1001, "entries; give 1,000 at most"),
        (np.full(20_000, 1.5), "entries; give 1,000 at most"),
        ([1.0, 1e61, 1.0], r"\[1\] is .* within 1e-60 \.\. 1e\+60"),
        ([1.0, 1e-61, 1.0], r"\[1\] is .* within 1e-60 \.\. 1e\+60"),
    ],
)
def test_media_that_make_no_stack_are_refused(indices, message):
    with pytest.raises(op.errors.ValueFault, match=f"^LayerStack indices.*{message}"):
        op.LayerStack(indices, 0.5)


def test_substrates_that_absorb_and_jones_columns_are_refused():
    with pytest.raises(
        op.errors.PathError, match=r"stack\.indices\[-1\] is complex.*by port 'back'"
    ):
        path_of(op.LayerStack([1.0, 0.6 + 2j], 0.5), "back", "reflected").check()
    with pytest.raises(op.errors.ComposerError, match=r"stack\.reflected.*may depolarise"):
        op.Composer(composing="jones").compose(path_of(op.LayerStack([1.0, 1.5, 1.0], 0.5)))


def test_all_components_keep_their_digits_though_next_to_nothing_gets_through():
    rng = np.random.default_rng(4)
    assert np.isfinite(op.LayerStack([1.0] * 1000, 0.1).mueller().matrix).all()
    nodes = {"lamp": op.Source(1.0, [1.0, 0.6, 0.64, 0.48]), "r": op.Detector(), "t": op.Detector()}
    links = "lamp.out -> stack.in, stack.reflected -> r, stack.transmitted -> t"
    for number in range(24):
        angle = np.pi / 2 - 10.0 ** rng.uniform(-12, 0) if number % 2 else rng.uniform(0, 1e-3)
        scale = 10.0 ** rng.uniform(-8, 8) if number % 3 == 0 else 1.0
        media = scale * rng.uniform(1.0, 2.5, rng.integers(3, 5))
        media[[0, -1]] = 1.0, rng.choice([1.0, media[-1]])
        substrate = complex(media[-1], rng.uniform(0, 3)) if number % 4 == 1 else media[-1]
        stack = op.LayerStack([*media[:-1], substrate], float(angle))
        path = wired({**nodes, "stack": stack}, links)
        exact = exact_stokes(path)
        for name, light in path.trace_all().items():
            expected = np.array([float(part) for part in exact[name]])
            np.testing.assert_allclose(light.stokes, expected, rtol=0, atol=2e-14 * expected[0])


@rows("n", [1e-3, 1e20, 1e45, 1e59])
def test_a_layer_of_any_index_lets_through_what_the_closed_form_says(n):
    # With T of one face, T / (2 - T) of both; T_s = 4 c / n and T_p = 4 / (c n) for large n.
    c = np.cos(0.9)
    total = np.sin(0.9) > n
    expected = 0.0 if total else (2.0 * c + 2.0 / c) / (2.0 * n)
    found = op.LayerStack([1.0, n, 1.0], 0.9).mueller("in", "transmitted")
    np.testing.assert_allclose(found.matrix[0, 0], expected, rtol=1e-13)


def warned(action):
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("default")
        action()
    return [one.category for one in told]


def stack(length, n=1.5, wavelength="500 nm"):
    return op.LayerStack([1.0, n, 1.5], 0.3, lengths=[length], wavelength=wavelength)


def test_layers_thinner_than_ten_wavelengths_are_warned_of():
    path = op.Source() >> stack(op.Parameter("d")) >> op.Detector()
    by_wavelength = op.Source() >> stack("1 um", wavelength=op.Wavelength()) >> op.Detector()
    by_index = op.Source() >> stack("1 um", op.Parameter("n")) >> op.Detector()
    rows = [
        (lambda: stack("5 nm"), 1),
        (lambda: stack("3 um"), 1),  # 9 wavelengths in it
        (lambda: stack("3.4 um"), 0),
        (lambda: stack("3 um", 2.0), 0),
        (lambda: stack(np.array([1e-3, 1e-7])), 1),
        (lambda: stack("5 nm", wavelength=None), 0),
        (lambda: stack("4 mm"), 0),
        (lambda: path.bind(d="100 nm"), 1),
        (lambda: path.bind(d="1 mm").trace(), 0),
        (lambda: path.trace(d="25 nm"), 1),
        (lambda: path.trace(d=["1 mm", "25 nm"]), 1),
        (lambda: path.trace(d="1 mm"), 0),
        (lambda: by_wavelength.trace(wavelength="500 nm"), 1),
        (lambda: by_index.trace(n=1.4), 1),
    ]
    for number, (action, count) in enumerate(rows):
        assert warned(action) == [op.errors.CoherenceWarning] * count, number


def test_psi_and_delta_of_what_has_no_ratio_of_amplitudes_are_warned_of_once_a_place():
    glass = op.Interface(1.5, "56 deg").mueller()
    rows = [
        (glass, 0),
        (op.Interface(0.2 + 3.0j, "70 deg").mueller(), 0),
        (op.Mueller(glass.matrix + 1e-4 * np.eye(4)[::-1] * glass.matrix[0, 0]), 0),
        (op.Retarder(0.5, 0.0).mueller(), 0),
        (op.Retarder(0.5, 0.3).mueller(), 1),
        (op.Depolarizer(0.5).mueller(), 1),
        (op.Mueller(np.zeros((4, 4))), 0),
    ]
    for number, (matrix, count) in enumerate(rows):

        def twice(matrix=matrix):
            for _ in range(2):
                matrix.ellipsometric_angles()

        assert warned(twice) == [op.errors.CoherenceWarning] * count, number
    jax = pytest.importorskip("jax")
    angles = jax.jit(lambda m: op.Mueller(m).ellipsometric_angles())
    assert warned(lambda: angles(np.diag([1.0, 0.5, 0.5, 0.5]).astype("f4"))) == []

"""Light to and from other software, and as it is drawn."""

import sys

import numpy as np
import pytest

import optipath as op
from optipath.light.conventions import CONVENTIONS, changed_delta
from random_matrices import jones, of_jones
from tables import rows

STOKES = np.array([[2.0, 0.7, -0.4, 1.1], [1.0, 0.0, 0.0, -1.0]])


def test_the_signs_are_those_of_the_page():
    # docs/other-software.md
    found = {name: op.Light([2.0, 1.0, 1.0, 1.0]).to(name) for name in CONVENTIONS}
    expected = {
        "mitsuba": [2, 1, 1, -1],
        "hecht": [2, 1, 1, -1],
        "py_pol": [2, 1, 1, -1],
        "ellipsometry": [2, -1, -1, -1],
        "pypolar": [2, -1, -1, -1],
        "pyelli": [2, -1, -1, 1],
        "scatmech": [2, 1, 1, 1],
        "tmm": [2, 1, -1, -1],
    }
    assert {name: stokes.tolist() for name, stokes in found.items()} == expected


@rows("name", CONVENTIONS)
def test_light_and_matrices_come_back_and_act_on_each_other_in_every_convention(name):
    light = op.Light(STOKES, op.Frame().turned(0.3))
    assert op.Light.from_(name, light.to(name), light.frame) == light
    frames = op.Frame().turned(0.3), op.Frame().turned(-0.2)
    rng = np.random.default_rng(1)
    one, two = (op.Mueller(of_jones(jones(rng))) for _ in range(2))
    matrix = op.Mueller(one.matrix, *frames)
    assert op.Mueller.from_(name, matrix.to(name), *frames) == matrix
    apart, light = two.to(name) @ one.to(name), op.Light(STOKES)
    np.testing.assert_allclose((two @ one).to(name), apart, rtol=0, atol=1e-13)
    after = light.to(name) @ apart.T
    np.testing.assert_allclose((two @ one @ light).to(name), after, rtol=0, atol=1e-12)


def test_faint_and_measured_light_is_taken():
    light = op.Light.from_("hecht", [1e-300, 0.6e-300, 0.0, 0.8e-300])
    assert light == op.Light([1e-300, 0.6e-300, 0.0, -0.8e-300])
    noisy = [1.0, 0.9, 0.0, 0.6]
    with pytest.raises(op.OptipathError, match="physical=False"):
        op.Light.from_("mitsuba", noisy)
    light = op.Light.from_("mitsuba", noisy, physical=False)
    np.testing.assert_array_equal(light.to("mitsuba"), noisy)
    assert np.isnan(changed_delta("tmm", np.array([np.nan]))).all()
    assert np.isnan(changed_delta("scatmech", np.array([np.nan]))).all()


def test_names_and_shapes_that_there_are_not_are_refused():
    light, matrix = op.Light([1.0, 0.0, 0.0, 0.0]), op.Polarizer(0.1).mueller()
    for act in (
        light.to,
        matrix.to,
        light.ellipsometric_angles,
        lambda name: op.Light.from_(name, [1.0, 0.0, 0.0, 0.0]),
        lambda name: op.Mueller.from_(name, np.eye(4)),
    ):
        for name, told in (
            ("mitsuba3", "'mitsuba3' is .*; did you mean 'mitsuba'"),
            (None, "None"),
        ):
            with pytest.raises(op.OptipathError, match=f"convention {told}"):
                act(name)
    with pytest.raises(op.OptipathError, match="'hecht' has no psi and Delta; there are: ellips"):
        op.Light([1.0, 0.0, 1.0, 0.0]).ellipsometric_angles("hecht")
    with pytest.raises(op.OptipathError, match=r"of shape \(\.\.\., 4\)"):
        op.Light.from_("hecht", [1.0, 0.0, 0.0])
    with pytest.raises(op.OptipathError, match=r"of shape \(\.\.\., 4, 4\)"):
        op.Mueller.from_("hecht", np.eye(3))


def test_what_is_given_is_not_changed_and_keeps_its_precision():
    light = op.Light([1.0, 0.0, 0.0, 0.0])
    assert not np.signbit(light.to("ellipsometry")).any()
    assert not np.signbit(op.Polarizer(0.0).mueller().to("mitsuba")).any()
    light = op.Light(STOKES.astype(np.float32))
    assert light.to("mitsuba").dtype == np.float32
    assert op.Light.from_("mitsuba", light.to("mitsuba")).stokes.dtype == np.float32
    assert op.Mueller(np.eye(4, dtype=np.float32)).to("tmm").dtype == np.float32
    light = op.Light(STOKES)
    light.to("scatmech")[...] = 0.0
    assert light == op.Light(STOKES)


@rows("delta", [-np.pi / 2, -0.3, 0.0, 0.3, np.pi / 2, np.pi])
def test_delta_of_tmm_is_180_degrees_minus_ours(delta):
    # The phase of E_p over E_s is Delta in exp(+i w t), and so -Delta in our field.
    light = op.Light([1.0, 0.0, np.cos(delta), -np.sin(delta)])
    psi, found = light.ellipsometric_angles("tmm")
    assert psi == pytest.approx(np.pi / 4)
    assert found == pytest.approx(np.angle(-np.exp(-1j * delta)))
    assert -np.pi < found <= np.pi


def test_jax_takes_slopes_through_a_convention():
    jax = pytest.importorskip("jax")

    def s3(x):
        light = op.Light.from_("hecht", jax.numpy.stack([1.0 + 0 * x, 0 * x, 0 * x, 0.5 * x]))
        return light.to("mitsuba")[3] + 2.0 * light.stokes[3]

    # theirs + 2 * (minus theirs)
    assert jax.grad(s3)(0.3) == pytest.approx(-0.5)


def test_each_kind_of_picture_is_the_function_of_its_name_in_axes_that_may_be_given():
    figures = pytest.importorskip("matplotlib.figure")
    light = op.Light([1.0, 0.0, 0.6, 0.8])
    for kind in ("ellipse", "poincare", "stokes"):
        one, other = light.plot(kind), getattr(op.plots, kind)(light)
        assert one.get_title() == other.get_title()
    ax = figures.Figure().add_subplot()
    assert light.plot(ax=ax) is ax
    assert ax.get_title().startswith("right-handed elliptical")
    batch = op.Light([[1.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, -1.0]])
    ax = batch.plot("poincare", by=[0.0, 1.0], label="turns")
    assert [each.get_ylabel() for each in ax.figure.axes[1:]] == ["turns"]
    ax = figures.Figure().add_subplot()
    assert op.Mueller(np.eye(4)).plot(ax) is ax
    for kind, options, told in (
        ("elipse", {}, "kind of picture 'elipse' is unknown; did you mean 'ellipse'"),
        (3, {}, "there are: ellipse, poincare, stokes"),
        ("stokes", {"publish": [1]}, "stokes option 'publish' .* did you mean 'published'"),
        ("ellipse", {"by": [1]}, "ellipse option 'by' is unknown"),
    ):
        with pytest.raises(op.errors.ParameterError, match=told):
            light.plot(kind, **options)


def test_without_matplotlib_the_extra_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    monkeypatch.delitem(vars(op.plots), "ellipse", raising=False)
    with pytest.raises(op.OptipathError, match="matplotlib"):
        op.Light([1.0, 0.0, 0.6, 0.8]).plot()

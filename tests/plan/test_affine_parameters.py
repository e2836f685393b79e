"""Paths whose fields are multiples of a parameter with an offset.

What is expected is the same path with a parameter of its own there, given what NumPy makes of it.
"""

import numpy as np
import pytest

import optipath as op
from chains import ENGINES
from optipath.paths.drawing import draw
from paths import chain
from tables import rows, slow_except

D = op.Parameter("d")
OFFSET = op.Parameter("any", unit="deg").parse("80 deg")


def through(*elements):
    return chain(elements, (100.0, 50.0, 20.0, 10.0))


def glasses(first, second):
    return through(
        op.Interface(1.5 + 0.3j, first), op.Interface(1.4, second, azimuth=0.3), op.Polarizer(0.2)
    )


AFFINE = glasses(2 * D + 0.1, "80 deg" - D)
PLAIN = glasses(op.Parameter("a"), op.Parameter("b"))


def values_of(d):
    numbers = np.asarray(d, float)
    a, b = 2.0 * numbers + 0.1, -1.0 * numbers + OFFSET
    return {"a": a, "b": b} if numbers.ndim else {"a": float(a), "b": float(b)}


ARRAY = np.linspace(0.0, 0.6, 60)
EVERY = [
    ARRAY,
    ARRAY[:, None],
    [0.1, 0.2],
    np.float32([0.1, 0.2]),
    np.float64(0.3),
    0.3,
    0.0,
    -0.05,
]
MANNERS = [{"engine": e, "dtype": dtype} for e in ENGINES for dtype in ("float64", "float32")]
MANNERS = [{"composing": "jones"}, {"method": "textbook"}, *slow_except(MANNERS[:2], MANNERS)]


@pytest.mark.parametrize("options", MANNERS)
def test_it_is_as_if_the_numbers_had_been_given_themselves_bit_for_bit(options):
    affine, plain = (op.Composer(**options).compose(path) for path in (AFFINE, PLAIN))
    for d in EVERY if options.get("engine", "numpy") == "numpy" else [ARRAY]:
        for _ in range(2):  # A batch is read, and then known by its shape.
            found, expected = affine.run(d=d).stokes, plain.run(**values_of(d)).stokes
            np.testing.assert_array_equal(found, expected)


def test_runs_of_one_path_are_the_same_step_by_step_and_by_a_function_that_is_made():
    for d in (0.3, 0.2, 0.1) * 8:
        found, expected = AFFINE.trace(d=d).stokes, PLAIN.trace(**values_of(d)).stokes
        np.testing.assert_array_equal(found, expected)
    path = through(op.Polarizer(2 * D - 0.2))
    plain = through(op.Polarizer(op.Parameter("a")))
    for d in (0.3, 0.1, 0.3, 0.1, 0.0) * 3:
        np.testing.assert_array_equal(path.trace(d=d).stokes, plain.trace(a=2 * d - 0.2).stokes)


def test_the_parameter_of_the_path_is_the_plain_one_by_its_own_default_and_range():
    d = op.Parameter("d", default="20 deg", unit="deg", minimum=0.0, maximum=0.6)
    path = through(op.Polarizer(2 * d + "10 deg"))
    assert path.parameters == {"d": d}
    expected = through(op.Polarizer(np.radians(50.0))).trace().stokes
    np.testing.assert_allclose(path.trace().stokes, expected, rtol=1e-14)
    with pytest.raises(op.errors.ParameterError, match=r"'d' is .*51.56\d* deg, outside its range"):
        path.trace(d=0.9)
    assert path.bind(d=0.1).parameters["d"].default == 0.1


def test_a_field_that_would_leave_its_domain_is_told_with_both():
    path = through(op.Interface(1.5, 2 * D + "10 deg"))
    for d, told in (
        (1.1, r"136.05\d* deg; give a real angle .* within 0 deg .. 90 deg$"),
        (np.array([0.1, 1.1]), r"136.05\d* deg at 1; give .* 90 deg$"),
        ("63.02535746439057 deg", r"136.05\d* deg; give .* 90 deg$"),
        (1e308, "inf"),
    ):
        with pytest.raises(
            op.errors.ParameterError, match=rf"'d' \(at .* as 2 \* d \+ 10 deg\) is .*{told}"
        ):
            path.trace(d=d)
    with pytest.raises(op.errors.ParameterError, match="as 2"):
        path.bind(d=1.1)
    with pytest.raises(op.errors.ValueFault, match=r"at Interface incidence, as 2 \* d \+ 10 deg"):
        op.Interface(1.5, 2 * op.Parameter("d", 1.1) + "10 deg")


@rows("degrees", range(0, 91, 3))
def test_a_sum_of_a_right_angle_is_one(degrees):
    path = through(op.Interface(1.5, D + f"{degrees} deg"))
    for d in (f"{90 - degrees} deg", np.radians(90.0 - degrees), [np.radians(90.0 - degrees)]):
        # All is reflected at grazing incidence.
        np.testing.assert_array_equal(path.trace(d=d).intensity, 100.0)


def test_words_go_through_and_none_leaves_the_element_and_its_offset_out():
    words = {"horizontal": 0.0, "vertical": np.pi / 2}
    f = op.Parameter("f", "none", unit="deg", words=words, optional=True)
    path = through(op.Polarizer(2 * f + "10 deg"))
    expected = [
        [100.0, 50.0, 20.0, 10.0],
        through(op.Polarizer(np.radians(10.0))).trace().stokes,
        through(op.Polarizer(np.radians(190.0))).trace().stokes,
    ]
    found = path.trace(f=["none", "horizontal", "vertical"]).stokes
    np.testing.assert_allclose(found, expected, rtol=1e-14, atol=1e-13)
    np.testing.assert_array_equal(path.trace().stokes, expected[0])
    share = op.Parameter("share", "none", optional=True)
    path = through(op.Attenuator(2 * share + 1.5))
    assert path.trace().intensity == 100.0
    found = path.trace(share=["none", -0.5]).intensity
    np.testing.assert_allclose(found, [100.0, 50.0])
    with pytest.raises(op.errors.ParameterError, match=r"as 2 \* share \+ 1.5\) is 1.9"):
        path.trace(share=["none", 0.2])


def test_a_cosine_and_a_sine_are_taken_by_their_angle_and_keep_their_digits_alone():
    pair = op.CosSin(np.cos([0.1, 0.3]), np.sin([0.1, 0.3]))
    np.testing.assert_allclose(
        AFFINE.trace(d=pair).stokes, AFFINE.trace(d=[0.1, 0.3]).stokes, rtol=1e-13
    )
    with pytest.raises(op.errors.ParameterError, match="belong to no angle"):
        AFFINE.trace(d=op.CosSin(0.5, 0.5))
    both = through(op.Interface(1.5, D), op.Interface(1.5, D / 2 + 0.1))
    alone = through(op.Interface(1.5, D), op.Interface(1.5, np.pi / 4 + 0.1))
    grazing = op.CosSin(1e-9, 1.0)
    np.testing.assert_allclose(both.trace(d=grazing).stokes, alone.trace(d=grazing).stokes)
    assert both.trace(d=grazing).intensity != both.trace(d=np.pi / 2).intensity


def test_indices_materials_and_amplitudes_take_multiples():
    n, rs = op.Parameter("n"), op.Parameter("rs")
    for affine, known, values in (
        (op.Interface(2 * n + 0.1, 0.3), op.Interface(1.5 + 0.4j, 0.3), {"n": 0.7 + 0.2j}),
        (
            op.Interface(op.Material(2 * n, n / 4), 0.3),
            op.Interface(op.Material(1.4, 0.175), 0.3),
            {"n": 0.7},
        ),
        (op.Mirror(-rs / 2, 0.3), op.Mirror(-0.3 + 0.1j, 0.3), {"rs": 0.6 - 0.2j}),
        (op.Medium(2 * n, absorption=3.0), op.Medium(0.2, absorption=3.0), {"n": 0.1}),
    ):
        found, expected = through(affine).trace(**values).stokes, through(known).trace().stokes
        np.testing.assert_allclose(found, expected, rtol=1e-13, atol=1e-13)


def test_numbers_that_belong_together_and_offsets_of_another_dimension_are_refused():
    with pytest.raises(op.errors.ValueFault, match=r"stokes is 2 \* d, but takes several numbers"):
        op.Source(1.0, 2 * D)
    with pytest.raises(
        op.errors.ValueFault, match="parameter 'd' has an offset that is a length, but Interface"
    ):
        op.Interface(1.5, D + "1 nm")
    with pytest.raises(
        op.errors.ValueFault, match="parameter 'd' has an offset that is an angle, but Attenuator"
    ):
        op.Attenuator(D + "1 deg")


@rows("angle", [2 * D + 45.0, 45.0 - D])
def test_an_offset_that_looks_like_degrees_is_warned_of(angle):
    with pytest.warns(op.errors.AngleWarning, match="offset of parameter 'd' .* is a plain number"):
        op.Polarizer(angle)
    op.Polarizer(D + "45 deg")


def test_turns_that_undo_each_other_vanish_and_bound_ones_stand_as_their_multiples():
    path = through(op.Rotator(2 * D + 0.1), op.Rotator(-(2 * D + 0.1)))
    assert [step.label for step in path.compose().program.steps] == ["lamp.out"]
    other = through(op.Rotator(2 * D + 0.1), op.Rotator(-2 * D))
    np.testing.assert_allclose(
        other.trace(d=0.4).stokes, through(op.Rotator(0.1)).trace().stokes, rtol=1e-14
    )
    for d in (0.2, np.array([0.1, 0.2])):
        bound, expected = AFFINE.bind(d=d), PLAIN.trace(**values_of(d)).stokes
        np.testing.assert_allclose(bound.trace().stokes, expected, rtol=1e-13, atol=1e-13)


def test_slopes_are_those_of_the_multiple():
    jax = pytest.importorskip("jax")
    affine, plain = (
        op.Composer(dtype="float32").compose(through(op.Interface(1.5 + 0.2j, incidence)))
        for incidence in (2 * D + 0.1, D)
    )

    def slope(plan, at):
        return float(jax.jit(jax.grad(lambda d: plan.run(d=d).intensity))(at))

    assert slope(affine, 0.2) == pytest.approx(2 * slope(plain, 0.5), rel=1e-5)
    found = jax.jit(jax.vmap(lambda d: affine.run(d=d).intensity))(jax.numpy.array([0.2, 0.8]))
    np.testing.assert_array_equal(np.isfinite(found), [True, False])


def test_drawings_and_certificates_know_the_multiple_and_its_span():
    drawn = draw(through(op.Interface(1.5, 2 * D + "10 deg"), op.Polarizer(-D)))
    assert "incidence=2 * $d + 10 deg" in drawn
    assert "angle=-$d" in drawn
    share = op.Parameter("share", minimum=0.0, maximum=0.4)
    path = through(op.Attenuator(2 * share + 0.1), op.Polarizer(0.3))
    found = path.compose().certificate(share=0.2)
    expected = through(op.Attenuator(0.5), op.Polarizer(0.3)).compose().certificate()
    assert float(found.error) == pytest.approx(float(expected.error))

"""Elements of a user's own: fields that say their range, and Jones matrices."""

import pickle
from typing import Annotated

import numpy as np
import pytest

import optipath as op
from chains import ENGINES
from paths import chain
from tables import rows, slow_except
from wired import read_back

F, Within = op.fields, op.fields.Within


def of(annotation):
    """A class of elements with one field so annotated."""
    body = {"__annotations__": {"x": annotation}, "mirrored": ("x",)}
    body["jones_rows"] = staticmethod(lambda _, *x: ((1.0, 0.0 * x[0]), (0.0, 1.0)))
    return type("Own", (op.Element,), body)


class Turned(op.Element, kind="test-turned"):
    """A filter with a range, and a Jones matrix."""

    angle: Annotated[F.Angle, Within(0, "90 deg")]
    share: Annotated[F.Real, Within(0.25, 1)] = 0.5
    length: Annotated[F.Real, Within("400 nm", "700 nm")] = 500e-9

    @staticmethod
    def jones_rows(xp, angle, share, length):
        c, s = xp.cos(angle), xp.sin(angle)
        return (c, s), (-share * s, share * c + 0.0 * length)


@rows(
    "annotation, allowed, refused",
    [
        (Annotated[float, Within(0, 2)], [0, 2.0, "1.5", [0.1, 2]], [-1e-9, 2.1, "1 mm", 1j, None]),
        (Within(0, 2), [0, 2.0], [-1, 2.1]),
        (Annotated[float, Within(None, 5)], [5, -1e9], [5.1]),
        (Annotated[float, Within(5)], [5, 1e9], [4.9]),
        (Annotated[float, Within("0 deg", "90 deg")], ["90 deg", 1.5], [-0.1, "91 deg", "1 nm"]),
        (Annotated[F.Angle, Within(0, "90 deg")], [0, "90 deg"], ["-1 deg", 1.6]),
        (Annotated[F.Axis, Within(0, 1)], ["horizontal"], ["vertical"]),
        (Annotated[F.Length, Within("1 mm")], [0.001, "1 cm"], ["999 um", 0]),
        (Annotated[F.Fraction, Within(0.5)], [0.5, 1.0], [0.4, 1.1]),
        (Annotated[F.Fraction, "a note", Within(0.5, 9)], [0.5, 1.0], [0.4, 1.1]),
        (Annotated[float, Within(0, 3), Within(2, 5)], [2, 3], [1.9, 3.1]),
        (Annotated[float, "a note", 3, object()], [1e9], ["1 mm"]),
    ],
)
def test_a_field_takes_what_is_within_its_range(annotation, allowed, refused):
    own = of(annotation)
    for value in allowed:
        assert np.all(np.isfinite(own(value).x))
    for value in refused:
        with pytest.raises((op.errors.ValueFault, op.errors.UnitError), match=r"^Own x"):
            own(value)


@rows(
    "annotation, told",
    [
        (Annotated[float, Within], r"Within says no range; write op.fields.Within\(least, most\)"),
        (Annotated[float, (0, 2)], r"\(0, 2\) says no range; write"),
        ((0, 2), r"\(0, 2\) says no range; write"),
        (Annotated[float, [0, 2]], r"\[0, 2\] says no range; write"),
        (Annotated[float, range(3)], r"range\(0, 3\) says no range"),
        (Annotated[float, type("Ge", (), {"ge": 0})()], "says no range"),
        (Annotated[bool, Within(0, 1)], "for real numbers, not for True or False; take it out"),
        (Annotated[F.Index, Within(1, 2)], "for real numbers, not for an index"),
        (Annotated[F.StokesState, Within(0, 1)], "for real numbers, not for .* Stokes vector"),
        (Annotated[F.Angle, Within(0, 90)], "is 90 rad; write degrees as '90 deg'"),
        (Annotated[F.Angle, Within("0 nm")], "an end of Within: '0 nm' is no angle"),
        (
            Annotated[F.Fraction, Within(2, 3)],
            "2 .. 3 has no number that is a real fraction .*; give others",
        ),
    ],
)
def test_what_is_no_range_of_a_field_is_refused_by_the_name_of_the_field(annotation, told):
    with pytest.raises(op.errors.PathError, match=rf"^field 'x' of element class Own: .*{told}"):
        of(annotation)(1.0)


@rows("ends", [(2, 0), ("a",), ("1 foo",), (np.nan,), ([1, 2],), (True,), ("0 deg", "5 nm")])
def test_ends_that_are_no_range_are_refused_where_they_are_written(ends):
    with pytest.raises(op.OptipathError):
        Within(*ends)


def test_parameters_arrays_files_and_sentences_know_the_range(tmp_path):
    path = chain([Turned(op.Parameter("a"), op.Parameter("s", 0.5), op.Parameter("l", 5e-7))])
    for given, told in (
        ({"a": 1.6}, "'a'.* is 91.67.* deg; give a real angle within 0 deg .. 90 deg"),
        ({"a": 0.1, "s": [0.3, 0.2]}, "'s' .* is 0.2 at 1; give a real number within 0.25 .. 1"),
        ({"a": 0.1, "l": 8e-7}, "'l' .* is 800 nm; give a real length within 400 nm .. 700 nm"),
    ):
        with pytest.raises(op.errors.ParameterError, match=told):
            path.trace(**given)
    again = read_back(path, tmp_path)
    assert again.trace(a="30 deg", l="600 nm") == path.trace(a=np.pi / 6, l=6e-7)
    with pytest.raises(op.errors.ParameterError, match=r"within 0 deg .. 90 deg"):
        again.trace(a=-0.1)
    assert pickle.loads(pickle.dumps(path)).trace(a=0.2) == path.trace(a=0.2)


def jones(rng):
    """A Jones matrix that lets no light gain."""
    matrix = rng.normal(size=(2, 2)) + 1j * rng.normal(size=(2, 2))
    return matrix / np.linalg.norm(matrix, 2) * rng.uniform(0.5, 1.0)


PAULI = np.array([[[1, 0], [0, 1]], [[1, 0], [0, -1]], [[0, 1], [1, 0]], [[0, -1j], [1j, 0]]])


def mueller_of(J):
    """The Mueller matrix by the traces of its definition."""
    return 0.5 * np.einsum("iab,bc,jcd,ad->ij", PAULI, J, PAULI, J.conj()).real


def pure(J, *, pairs=False):
    """An element of a Jones matrix whose last imaginary part is open, as complex numbers or not."""
    (a, b), (c, d) = J

    def jones_rows(_, last):
        if pairs:
            return ((a.real, a.imag), (b.real, b.imag)), ((c.real, c.imag), (d.real, last))
        return (a, b), (c, d.real + 1j * last)

    body = {"jones_rows": staticmethod(jones_rows), "__annotations__": {"last": F.Real}}
    return type("AnyJones", (op.Element,), body), d.imag


@rows("pairs", [False, True])
def test_the_mueller_matrix_is_that_of_the_jones_matrix(pairs):
    rng = np.random.default_rng(3)
    for _ in range(50):
        J = jones(rng)
        own, last = pure(J, pairs=pairs)
        np.testing.assert_allclose(own(last).mueller().matrix, mueller_of(J), atol=1e-15)


@pytest.mark.parametrize("engine", slow_except(["numpy", "numba"], ENGINES))
@rows("composing", ["stokes", "jones"])
@rows("pairs", [False, True])
def test_every_engine_and_way_to_compose_gives_the_light_behind_jones_matrices(
    engine, composing, pairs, request
):
    if engine == "jax":
        request.getfixturevalue("jax")
    rng = np.random.default_rng(4)
    J, K = jones(rng), jones(rng)
    (own, last), (second, of_second) = (pure(matrix, pairs=pairs) for matrix in (J, K))

    def path(first, other):
        glass = op.Interface(0.2 + 3.0j, 1.0, azimuth=0.3)
        elements = [first, glass, op.Attenuator(0.5), other, op.Polarizer(0.4)]
        return chain(elements, [1.0, 0.5, 0.2, 0.1])

    expected = path(*map(op.MuellerElement, map(mueller_of, (J, K)))).trace().stokes
    plan = op.Composer(engine=engine, composing=composing).compose(
        path(own(op.Parameter("x")), second(of_second))
    )
    for size in ((), (3000,)):
        found = plan.run(x=np.full(size, last)).stokes
        np.testing.assert_allclose(found, np.broadcast_to(expected, (*size, 4)), atol=1e-15)
    assert plan.engine == ("numpy" if engine == "numba" and not pairs else engine)


def test_a_jones_matrix_is_no_depolarizer_to_bounds_and_comparisons():
    """Its certificate is that of the polarizer that it is."""
    body = {"jones_rows": staticmethod(lambda *_: ((1.0, 0.0), (0.0, 0.0)))}
    own = type("Grid", (op.Element,), body)()
    found, wanted = (
        chain([op.Interface(1.5, 0.9), one, op.Interface(1.5, 0.9, azimuth=0.4)], reads="intensity")
        for one in (own, op.Polarizer())
    )
    for value in ("scalar", "lower", "upper"):
        both = (getattr(path.compose().certificate(), value) for path in (found, wanted))
        assert next(both) == pytest.approx(next(both), rel=1e-12)
    both = [op.polarization(path) for path in (found, wanted)]
    assert both[0].exact == pytest.approx(both[1].exact, rel=1e-14)
    assert both[0].elements["e1"] == pytest.approx(both[1].elements["e1"], rel=1e-14)


@rows(
    "rows_of, told",
    [
        (lambda _, x: ((x, 0), (0, 1, 3)), "must return two rows of two entries, not"),
        (lambda _, x: ((x, (0, 1, 2)), (0, 1)), r"gives the entry \(0, 1, 2\); give numbers"),
        (lambda _, x: (((1j, x), 0), (0, 1)), r"gives the entry \(1j, .*0.5.*; give numbers"),
        (lambda _, x: ((x, "a"), (0, 1)), "gives the entry 'a'; give numbers"),
        (lambda _, x: ((x, None), (0, 1)), "gives the entry None; give numbers"),
        (lambda _, x: ((x, 0), (0, np.ones(3))), r"entry of shape \(3,\) for paths of shape \(\)"),
        (lambda *_: ((2.0, 0), (0, 1)), "makes light up to 4 times as bright"),
    ],
)
def test_what_is_no_jones_matrix_is_refused_with_its_class(rows_of, told):
    body = {"jones_rows": staticmethod(rows_of), "__annotations__": {"x": F.Real}}
    with pytest.raises(op.errors.PathError, match=told):
        type("Own", (op.Element,), body)(0.5).mueller()


def test_a_class_gives_one_of_both_matrices_and_a_subclass_may_give_the_other():
    body = {name: staticmethod(lambda *_: np.eye(4)) for name in ("mueller_rows", "jones_rows")}
    with pytest.raises(op.errors.PathError, match="class Own has mueller_rows and jones_rows"):
        type("Own", (op.Element,), body)
    with pytest.raises(op.errors.PathError, match="jones_rows of element class Own takes b and a"):
        type(
            "Own",
            (op.Element,),
            {
                "jones_rows": staticmethod(lambda xp, b, a: a + b + xp),
                "__annotations__": {"a": F.Real, "b": F.Real},
            },
        )
    below = type("Own", (op.Element,), {"mueller_rows": body["mueller_rows"]})
    above = type("Other", (below,), {"jones_rows": staticmethod(lambda *_: ((0.5, 0), (0, 0.5)))})
    assert [kind().mueller().matrix[0, 0] for kind in (below, above)] == [1.0, 0.25]

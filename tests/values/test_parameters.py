"""Parameters, affine expressions of them, and domains: yes or no, pairs, clear media."""

import copy
import math
import operator
import pickle
import re
from decimal import Decimal
from fractions import Fraction
from itertools import product

import numpy as np
import pytest

import optipath as op
from optipath.materials.quantities import YesOrNo
from paths import chain
from tables import rows
from wired import read, read_back


def test_texts_words_and_none_stand_for_values():
    assert op.Parameter("a", unit="deg").resolve("180 deg").value == np.pi
    assert op.Parameter("a", "180 deg", unit="deg") == op.Parameter("a", np.pi, unit="deg")
    resolved = op.Parameter("a", words={"up": 1.0}, optional=True).resolve(["up", "none", 0.5])
    np.testing.assert_array_equal(resolved.value, [1.0, 0.0, 0.5])
    np.testing.assert_array_equal(resolved.present, [True, False, True])
    parameter = op.Parameter("r", "-0.3+0.2j")
    assert parameter.default_text() == "-0.3+0.2j"
    assert parameter.parse(parameter.default_text()) == -0.3 + 0.2j


@rows(
    "keywords, message",
    [
        ({"name": "not a name"}, "letters, digits"),
        ({"offset": "D65", "offset_dimension": ["length"]}, "must be a text, not"),
        *(({"unit": "dge"}, "did you mean 'deg'"), ({"unit": None}, "'None' is unknown")),
        *(
            ({"default": 2.0, "maximum": 1.0}, "outside its range"),
            ({"default": "up"}, "word 'up'"),
        ),
        ({"default": 1 + 1j, "minimum": 0.0}, "complex but has a range"),
        *(({"default": 10**400}, "must be a number"), ({"bound": True}, "bound but has no value")),
        *(({"minimum": least, "maximum": 1.0}, "lower end") for least in (2.0, np.nan)),
        *(({"minimum": "x"}, "is not a quantity"), ({"help": 3}, "must be a text")),
        ({"maximum": 1.0, "words": {"up": 2.0}}, "outside its range"),
        *(({"words": {"up": up}}, told) for up, told in ((np.nan, "finite"), ([1.0], "a number"))),
        ({"words": {"none": 1.0}}, "cannot have the word 'none'"),
        *(({"words": 3}, "dict from word"), ({"optional": "yes"}, "True or False")),
        *(({"scale": scale}, "and a scale other than 0") for scale in (0, "2", 1j)),
        ({"offset": np.nan}, "finite real numbers and a scale other than 0"),
    ],
)
def test_a_parameter_that_cannot_be_is_refused(keywords, message):
    with pytest.raises(op.OptipathError, match=message):
        op.Parameter(**{"name": "a"} | keywords)


@rows("number", [-1.0, 0.0, 1.0, 1.0 + 2**-52, np.nan, np.inf, -np.inf])
@rows("low, high", [(-1.0, 1.0), (-np.inf, 0.0), (-np.inf, np.inf)])
def test_a_float_is_judged_as_an_array_of_it_is(number, low, high):
    parameter = op.Parameter("a", minimum=low, maximum=high)
    if low <= number <= high and np.isfinite(number):
        resolved = parameter.resolve(number)
        assert resolved.value == parameter.resolve(np.array(number)).value == number
        assert (resolved.value.shape, resolved.present.shape) == ((), ())
        return
    sentences = []
    for given in (number, np.array(number)):
        with pytest.raises(op.errors.ParameterError) as error:
            parameter.resolve(given)
        sentences.append(str(error.value))
    assert sentences[0] == sentences[1]


D, N, Q = (op.Parameter(name) for name in "dnq")
TEN_DEG = math.radians(10.0)


@rows(
    "parameter, scale, offset",
    [
        *((2 * D + 0.1, 2.0, 0.1), (D / 2, 0.5, 0.0), (D - 0.1, 1.0, -0.1), (0.1 - D, -1.0, 0.1)),
        *((-(2 * D + 0.1), -2.0, -0.1), (2 * (D + 1) * 3 - 1, 6.0, 5.0), (+D, 1.0, 0.0)),
        *((np.float64(2) * D, 2.0, 0.0), (D * np.float32(2), 2.0, 0.0)),
        *((np.int64(2) - D, -1.0, 2.0), (np.array(2.0) * D, 2.0, 0.0), (np.negative(D), -1.0, 0.0)),
        *(
            (np.add(1.0, -D), -1.0, 1.0),
            (Fraction(1, 4) * D, 0.25, 0.0),
            (D / np.float64(4), 0.25, 0),
        ),
        *((sum([2 * D, 1.0]), 2.0, 1.0), (D + "10 deg", 1.0, TEN_DEG), ("10 deg" - D, -1, TEN_DEG)),
        (2 * (D - "10 deg"), 2.0, -2 * TEN_DEG),
        *((op.Parameter("d", scale=2, offset="10 deg"), 2.0, TEN_DEG), (D + "2 mm", 1.0, 0.002)),
    ],
)
def test_a_multiple_with_an_offset_of_a_parameter_is_one(parameter, scale, offset):
    assert (parameter.scale, parameter.offset) == (scale, pytest.approx(offset, rel=1e-15))
    assert parameter.alone() == D
    assert parameter == op.Parameter("d", scale=scale, offset=parameter.offset)


def test_a_multiple_is_specified_equal_written_copied_and_pickled_as_the_value_itself_is():
    negative = -D
    assert -negative == 2 * D / 2 == D
    assert -D != D != 2 * D
    assert (negative.is_negative, D.is_negative) == (True, False)
    assert math.copysign(1.0, negative.offset) == 1.0
    words = {"up": 1.0}
    parameter = op.Parameter("d", 0.5, "deg", -1.0, 2.0, help="a turn", words=words, optional=True)
    affine = 3 * parameter + "1 deg"
    for multiple in (affine, -parameter):
        assert multiple.same_specification(parameter)
        assert multiple != parameter
    assert (affine.default, affine.minimum, affine.maximum, affine.unit) == (0.5, -1.0, 2.0, "deg")
    assert affine.alone() == parameter
    assert not any((D == Q, D == 2.0, np.float64(2.0) == D, np.any(np.ones(3) == D)))
    assert D in [Q, D]
    assert {D: 1}[op.Parameter("d")] == 1
    assert (D.formula, (-D).formula) == ("d", "-d")
    assert (2 * D + 0.1).formula == "2 * d + 0.1"
    assert (0.5 - D / 2).formula == "-0.5 * d + 0.5"
    assert (op.Parameter("d", unit="deg") * 2 - "10 deg").formula == "2 * d - 10 deg"
    for copied in (copy.copy, copy.deepcopy, lambda one: pickle.loads(pickle.dumps(one))):
        assert copied(2 * D + "10 deg") == 2 * D + "10 deg"


COMPARED = [operator.lt, operator.le, operator.gt, operator.ge]
PRODUCTS = [operator.mul, operator.truediv, operator.add, operator.sub, operator.pow]
OTHERS = [Q, D, [1, 2], np.ones(3), 1j, None, "x", True, np.nan, np.inf, 10**400, Decimal(2)]
REFUSED = [
    *(lambda: D**2, lambda: 2**D, lambda: 1 / D, lambda: D / 0, lambda: 0 * D, lambda: D * "2 deg"),
    *(lambda: D % 2, lambda: abs(D), lambda: float(D), lambda: np.sin(D), lambda: math.sin(D)),
    *(lambda: np.radians(D), lambda: np.maximum(D, 0.0), lambda: np.sum(D)),
    *(lambda: np.add(D, 1.0, out=np.zeros(1)), lambda: np.float64(1.0) < D),
    *(lambda: D * 1e300 * 1e300, lambda: D * 1e-300 * 1e-300),
]


@rows("refused", REFUSED)
def test_anything_else_is_refused_with_the_way_out(refused):
    with pytest.raises(op.errors.ParameterError, match=r"parameter 'd' .*(give them|give numbers)"):
        refused()


def test_what_is_no_real_number_is_refused_on_either_side_and_complex_sums_are_a_material():
    for operation, other in product([*PRODUCTS, *COMPARED], OTHERS):
        for pair in ((D, other), (other, D)):
            with pytest.raises(op.OptipathError):
                operation(*pair)
    for imaginary in (lambda: D + 1j * Q, lambda: D + 0.1j, lambda: D - 0.1j):
        with pytest.raises(op.errors.ParameterError, match=r"write op.Material\(n, k\)"):
            imaginary()
    jax = pytest.importorskip("jax")
    with pytest.raises(op.errors.ParameterError, match="a value of JAX"):
        D * jax.numpy.asarray(2.0)


def test_a_text_is_an_offset_by_its_unit():
    angle = op.Parameter("d", unit="deg")
    for add, sentence in (
        (lambda: D + "10 degg", "did you mean 'deg'"),
        (lambda: angle + "10", "has no unit, but an angle"),
        (lambda: D + "1 deg" + "1 nm", "'1 nm' is no angle"),
        (lambda: op.Parameter("d", unit="deg", offset="2 nm"), "'2 nm' is no angle"),
        (lambda: D + "10" + "1 deg", "'1 deg' has the unit 'deg', but a pure number is"),
    ):
        with pytest.raises(op.errors.UnitError, match=sentence):
            add()
    # A text without a unit is an offset of pure numbers.
    path = op.Source() >> op.Attenuator(D + "0.1") >> op.Detector()
    assert path.trace(d=0.25).intensity == 0.25 + 0.1
    assert op.Interface(D - "0.5", 0.0).index.placed(2.0) == 1.5
    with pytest.raises(op.errors.ValueFault, match=r"an offset that is a pure number, but Rotator"):
        op.Rotator(D + "10")


class Shutter(op.Element, kind="test-shutter"):
    shut: YesOrNo = False

    @staticmethod
    def mueller_rows(xp, shut):
        through = xp.where(shut, 0.0, 1.0)
        return [[through * (row == column) for column in range(4)] for row in range(4)]


def test_a_yes_no_field_gives_its_rows_1_or_0_and_goes_to_toml_and_back(tmp_path):
    for shut in (True, False):
        path = chain([Shutter(shut)])
        assert path.trace().stokes[0] == (0.0 if shut else 1.0)
        assert f"shut = {str(shut).lower()}\n" in path.to_toml()
        assert read_back(path, tmp_path) == path
    of_numpy = Shutter(np.array([True])[0])
    assert of_numpy.shut is True
    assert of_numpy == Shutter(shut=True) != Shutter(shut=False)
    for value in (1, "yes", None, [True], np.array([True, False])):
        with pytest.raises(op.OptipathError, match=r"shut is .*; give True or False"):
            chain([Shutter(value)]).check()
    with pytest.raises(op.OptipathError, match="cannot be a parameter; give True or False"):
        chain([Shutter(op.Parameter("a"))]).check()
    with pytest.raises(op.OptipathError, match=r"shut: the value is 1; give true or false"):
        read(chain([Shutter(shut=True)]).to_toml().replace("= true", "= 1"), tmp_path)
    with pytest.raises(op.OptipathError, match="shut is 3; give True or False"):
        chain([Shutter(3)]).to_toml()


def glass(**index):
    return chain([op.Interface(op.Parameter("n", **index), 0.3)])


WAYS = {
    "trace": lambda n: glass().trace(n=n),
    "bind": lambda n: glass().bind(n=n).trace(),
    "default": lambda n: glass(default=n).trace(),
    "constant": lambda n: chain([op.Interface(n, 0.3)]).trace(),
}


@rows("way", WAYS)
def test_a_list_of_media_is_that_of_indices(way):
    indices = np.array([1.5, 1.6 + 0.1j, 2.0])
    media = [op.Material(1.5), op.Material(1.6, 0.1), 2.0]
    np.testing.assert_array_equal(WAYS[way](media).stokes, WAYS[way](indices).stokes)


GRID = [4e-7, 5e-7, 6e-7]
ABSORBING = op.Material.tabulated(GRID, 1.5, [1e-8, 2e-8, 3e-8], name="glass")
PARTLY = op.Material.tabulated(GRID, 1.5, [0.0, 2e-8, 3e-8], name="glass")
CONSTANT = op.Material(1.5, 1e-8)
MEDIUM_CURE = "take the medium without its k"
DOWN = [[0, 0, 3], [0, 0, 2], [0, 0, 0]]


def front(medium):
    return op.LayerStack([medium, 1.5, 1.0], 0.3)


PLACES = [
    *(front, lambda medium: op.LayerStack([1.0, medium, 1.0], 0.3)),
    lambda medium: op.path_from_vertices(DOWN, [medium], events="T"),
]


@rows("place", PLACES)
@rows("medium", [ABSORBING, CONSTANT])
def test_a_medium_that_absorbs_everywhere_is_refused_with_a_cure_that_works(place, medium):
    with pytest.raises(op.OptipathError, match=re.escape(MEDIUM_CURE)) as refused:
        place(medium)
    assert "another wavelength" not in str(refused.value)
    assert place(op.Material(medium.n)) is not None


def test_a_medium_that_absorbs_at_some_wavelengths_is_refused_there_with_the_same_cure(tmp_path):
    path = op.Source() >> front(PARTLY) >> op.Detector()
    assert path.trace(wavelength="400 nm").intensity > 0.0
    with pytest.raises(
        op.errors.ParameterError, match=r"k of glass at 500 nm is 2e-08, and"
    ) as refused:
        path.trace(wavelength="500 nm")
    assert str(refused.value).endswith(MEDIUM_CURE)
    # A table has not the reason of the formula beside it.
    formula = "{type: formula 1, wavelength_range: 0.4 0.6, coefficients: 0 1.0 0.01}"
    table = "{type: tabulated k, data: '0.4 0\n\n 0.5 1e-8\n\n 0.6 1e-8'}"
    page = tmp_path / "page.yml"
    page.write_text(f"DATA: [{formula}, {table}]")
    path = op.Source() >> front(op.Material.from_yaml(page)) >> op.Detector()
    with pytest.raises(op.errors.ParameterError) as refused:
        path.trace(wavelength="500 nm")
    assert "formula" not in str(refused.value)

"""What is given for one parameter of a sweep: numbers, texts, words, arrays with units."""

import subprocess
import sys
import warnings
from contextlib import suppress

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from optipath.sweeps.axes.read_axes import grid_of
from tables import rows

NPGR = op.load_preset("npgr026").compose()
TURNED = (
    op.Source(stokes=[1, 1, 0, 0]) >> op.Rotator(op.Parameter("a", unit="deg")) >> op.Detector()
)
COLOURED = (
    op.Source(stokes=[1, 1, 0, 0])
    >> op.Interface(op.Material.cauchy([1.5, 4e-15]), 0.5)
    >> op.Detector()
)
UNITS = {"angle": ["deg", "rad", "mrad", "arcmin", "arcsec"], "length": ["nm", "um", "angstrom"]}


def axis_of(given, plan=NPGR):
    """The only axis of what is given by name."""
    (axis,) = grid_of(plan.inputs, given).axes
    return axis


def labelled(values, unit=None):
    xarray = pytest.importorskip("xarray")
    return xarray.DataArray(values, dims="x", attrs={} if unit is None else {"units": unit})


def refused(given, plan=NPGR):
    with pytest.raises(op.ParameterError) as caught:
        grid_of(plan.inputs, given)
    return str(caught.value)


def test_plain_numbers_are_radians_as_they_are():
    numbers = np.array([0.1, 0.2, 0.7])
    axis = axis_of({"delta": numbers})
    assert (axis.name, axis.dimension, axis.unit) == ("delta", "delta", "rad")
    assert axis.given.tolist() == axis.shown.tolist() == numbers.tolist()
    assert axis.help == NPGR.inputs.open["delta"].help


def test_an_axis_stays_as_it_is_when_what_was_given_or_is_shown_changes():
    numbers = np.array([0.1, 0.2])
    for value in (numbers, labelled(numbers, "rad")):
        axis = axis_of({"delta": value})
        with suppress(ValueError):  # It is read-only where it is what is given as well.
            axis.shown[0] = 0.3
        numbers[1] = 0.4
        assert axis.given.tolist() == [0.1, 0.2]
        numbers[1] = 0.2


@rows("several", [[0, 1], (0, 1), range(2), np.arange(2), np.arange(2.0)])
def test_lists_ranges_and_arrays_are_axes(several):
    axis = axis_of({"k1": several})
    assert axis.given.tolist() == [0.0, 1.0]
    assert (axis.given.dtype, axis.unit) == (np.float64, "")


def test_a_single_value_is_fixed_and_no_axis():
    grid = grid_of(
        NPGR.inputs, {"delta": "48 deg", "rho": 0.1, "n1": np.array(1.3), "filter": "none"}
    )
    assert grid.axes == ()
    assert grid.fixed == {"delta": 48 * (np.pi / 180), "rho": 0.1, "n1": 1.3, "filter": "none"}
    assert grid.points == 1


def test_texts_are_shown_in_the_unit_of_the_first():
    axis = axis_of({"delta": ["10 deg", "0.5 rad", "600 arcmin"]})
    assert axis.unit == "deg"
    assert axis.shown.tolist() == pytest.approx([10.0, np.degrees(0.5), 10.0], rel=1e-15)
    assert axis.given[1] == 0.5


def test_a_range_in_one_text_is_an_axis_with_its_unit():
    axis = axis_of({"phi": "0 deg:80 deg:9"})
    assert (axis.unit, axis.shown.tolist()) == ("deg", [10.0 * step for step in range(9)])
    assert axis.given[3] == 30 * (np.pi / 180)


def test_words_are_shown_as_texts_and_none_stays_a_word():
    axis = axis_of({"filter": ["none", "horizontal", 0.5, "30 deg"]})
    assert axis.unit == ""
    assert axis.shown.tolist() == ["none", "horizontal", "0.5 rad", "30 deg"]
    assert axis.given.tolist() == ["none", 0.0, 0.5, 30 * (np.pi / 180)]


def test_words_without_none_are_numbers_for_a_run():
    axis = axis_of({"filter": ["vertical", "horizontal"]})
    assert axis.shown.tolist() == ["vertical", "horizontal"]
    assert axis.given.dtype == np.float64
    assert axis.given.tolist() == [np.pi / 2, 0.0]


def test_names_of_axes_are_angles():
    path = op.Source(1) >> op.Polarizer(op.Parameter("angle")) >> op.Detector()
    axis = axis_of({"angle": ["antidiagonal", "vertical"]}, path.compose())
    assert axis.shown.tolist() == ["antidiagonal", "vertical"]
    assert axis.given.tolist() == [-np.pi / 4, np.pi / 2]


def test_what_words_are_shown_as_gives_them_back():
    axis = axis_of({"filter": ["none", "horizontal", 0.5]})
    again = axis_of({"filter": labelled(axis.shown)})
    assert again.given.tolist() == axis.given.tolist()


def test_photon_energies_are_shown_as_they_are_given():
    axis = axis_of({"wavelength": "1.8 eV:2.4 eV:4"}, COLOURED.compose())
    assert (axis.unit, axis.shown.tolist()) == ("eV", [1.8, 2.0, 2.2, 2.4])
    assert axis.given[0] == pytest.approx(688.801e-9, rel=1e-6)


def test_photon_energies_among_lengths_are_shown_as_lengths():
    axis = axis_of({"wavelength": ["2 eV", "500 nm"]}, COLOURED.compose())
    assert axis.unit == "nm"
    assert axis.shown == pytest.approx([619.921, 500.0], rel=1e-6)


def test_wave_numbers_that_are_written_in_two_ways_are_shown_as_lengths():
    axis = axis_of({"wavelength": ["20000 1/cm", "19000 cm^-1"]}, COLOURED.compose())
    assert axis.unit == "nm"
    assert axis.shown == pytest.approx([500.0, 1e7 / 19000], rel=1e-14)


def test_complex_indices_are_an_axis_where_the_path_takes_them():
    path = op.Source(1) >> op.Interface(op.Parameter("n"), 0.5) >> op.Detector()
    axis = axis_of({"n": np.array([1.5, 0.2 + 3j])}, path.compose())
    assert axis.given.tolist() == [1.5, 0.2 + 3j]


def test_a_material_is_its_index():
    grid = grid_of(NPGR.inputs, {"n1": op.Material(1.4), "n2": [op.Material(1.5), 1.6, 1.7]})
    assert grid.fixed == {"n1": 1.4}
    assert grid.axes[0].given.tolist() == [1.5, 1.6, 1.7]


def test_jax_arrays_are_arrays():
    jnp = pytest.importorskip("jax.numpy")
    axis = axis_of({"delta": jnp.array([0.25, 0.5])})
    assert isinstance(axis.given, np.ndarray)
    assert axis.given.tolist() == [0.25, 0.5]


@given(st.lists(st.sampled_from(["nm", "um", "m", "eV", "1/cm", "THz", "cm^-1"]), min_size=1))
def test_what_is_shown_is_what_is_given_in_its_unit(units):
    size = {"nm": 500.0, "um": 0.5, "m": 5e-7, "eV": 2.5, "1/cm": 2e4, "cm^-1": 2e4, "THz": 600.0}
    plan = COLOURED.compose()
    axis = axis_of({"wavelength": [f"{size[unit]!r} {unit}" for unit in units]}, plan)
    again = axis_of(
        {"wavelength": [f"{number!r} {axis.unit}" for number in axis.shown.tolist()]}, plan
    )
    assert again.given == pytest.approx(axis.given, rel=4e-16)


@given(st.data())
def test_the_axis_of_an_array_with_units_has_the_very_numbers_of_its_texts(data):
    name, plan = data.draw(st.sampled_from([("a", TURNED), ("wavelength", COLOURED)]))
    parameter = plan.compose().inputs.open[name]
    unit = data.draw(st.sampled_from(UNITS["angle" if name == "a" else "length"]))
    low, high = (-6.0, 6.0) if name == "a" else (4e-7, 7e-7)
    size = parameter.parse(f"1 {unit}")
    numbers = data.draw(st.lists(st.floats(low / size, high / size), min_size=1, max_size=5))
    axis = axis_of({name: labelled(numbers, unit)}, plan.compose())
    alone = [float(parameter.resolve(f"{number!r} {unit}").value) for number in numbers]
    assert axis.given.tolist() == alone
    assert axis.shown.tolist() == numbers
    assert (
        axis_of({name: [f"{number!r} {unit}" for number in numbers]}, plan.compose()).given.tolist()
        == alone
    )


def test_a_sweep_takes_what_a_single_run_takes_for_the_number_with_its_unit():
    axis = axis_of({"a": labelled([48.0, 12.3], "deg")}, TURNED.compose())
    plan = TURNED.compose()
    for text, number in zip(["48 deg", "12.3 deg"], axis.given, strict=True):
        assert np.array_equal(plan.run(a=text).stokes, plan.run(a=float(number)).stokes)


@rows("unit", ["", "1", "dimensionless", None])
def test_numbers_without_a_dimension_need_no_unit(unit):
    assert axis_of({"n1": labelled([1.3, 1.5], unit)}).unit == ""


@rows(
    "unit, told",
    [
        (None, "is a DataArray without a unit; write one of deg, rad"),
        ("1", "is a DataArray without a unit"),
        ("degrees", "did you mean 'deg'?"),
        ("nm", "'1 nm' is no angle"),
        (3, "the unit of parameter 'delta' is 3"),
    ],
)
def test_a_unit_that_is_missing_or_wrong_is_told(unit, told):
    assert told in refused({"delta": labelled([10.0, 48.0], unit)})


def test_complex_numbers_with_a_unit_are_told():
    assert "'(10+1j) deg' is not a quantity" in refused({"delta": labelled([10 + 1j], "deg")})


@rows(
    "value, told",
    [
        (np.zeros((2, 3)), "has the shape (2, 3), and an axis has one dimension"),
        ([["1 deg"], ["2 deg"]], "has the shape (2, 1), and an axis has one dimension"),
        ([], "has no values; give one at least"),
        (None, "has no value; give one, delta=..."),
        (True, "must be a number, not True"),
        ([True, False], "must be a number, not [True, False]"),
        (["1 deg", None], "must be a number, not None"),
        ({1: 2}, "must be a number, not {1: 2}"),
        (np.array(["2020-01-01"], "M8[D]"), "must be a number, not array(['2020-01-01']"),
        (np.ma.masked_array([0.1, 0.2], [0, 1]), "has masked entries"),
        (op.CosSin(0.6, 0.8), "is a cosine and a sine, which no axis shows; give the angle"),
        (op.Material(1.5), "a Material stands for an index of refraction"),
        ([0.1, 1 + 1j], "is complex"),
        ("0:90:91", "'0:90:91' has no unit; write '0 deg:90 deg:91' if it is in deg"),
        ("0 nm:90 nm:91", "'0 nm' is no angle"),
        ("0 deg:90 deg", "does not say how many values there are"),
        (["10 degs", "horizontal"], "did you mean 'deg'?"),
    ],
)
def test_what_is_no_axis_is_told(value, told):
    message = refused({"delta": value})
    assert told in message
    assert "delta" in message


def test_a_material_that_waits_for_a_parameter_is_told_as_everywhere():
    material = op.Material(op.Parameter("n"), 0.1)
    told = "is put in place before a path runs; write path.bind(n1=...)"
    assert told in refused({"n1": material})


def test_two_numbers_that_may_be_one_index_are_asked_about():
    path = op.Source(1) >> op.Interface(op.Parameter("n"), 0.5) >> op.Detector()
    assert "which may be n and k, or the indices of two paths" in refused(
        {"n": (0.2, 3.4)}, path.compose()
    )


def test_what_takes_several_numbers_for_one_path_is_no_axis():
    path = op.Source(stokes=op.Parameter("s")) >> op.Detector()
    told = "takes several numbers for one path, which no axis has; bind it, by path.bind(s=...)"
    assert told in refused({"s": [1, 0, 0, 0]}, path.compose())


def test_series_of_pandas_are_asked_for_their_numbers():
    pandas = pytest.importorskip("pandas")
    assert "give its numbers alone, .to_numpy()" in refused({"delta": pandas.Series([0.1, 0.2])})


def test_degrees_for_radians_are_warned_of_once_from_the_line_of_the_caller():
    pytest.importorskip("xarray")
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        TURNED.sweep(a=[0.1, 45.0]).DoP.load()
    (warning,) = caught
    assert warning.category is op.AngleWarning
    assert warning.filename == __file__
    assert "parameter 'a' is a plain number" in str(warning.message)


def test_texts_of_many_turns_are_what_they_say():
    pytest.importorskip("xarray")
    TURNED.sweep(a="0 deg:1000 deg:7").DoP.load()


def test_axes_are_read_without_xarray():
    code = (
        "import sys; import optipath as op; from optipath.sweeps.axes.read_axes import grid_of;"
        "grid_of(op.load_preset('malus').compose().inputs, {'angle': [0.1]});"
        "print('xarray' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"


@pytest.mark.filterwarnings("ignore::optipath.AngleWarning")
def test_numbers_of_half_precision_are_labels_of_single():
    pytest.importorskip("xarray")
    half = np.array([0.1, 0.2], np.float16)
    found = op.load_preset("malus").sweep(angle=half)
    assert found.angle.dtype == np.float32
    assert (found.angle.values == half).all()
    assert (found.S0.values == op.load_preset("malus").compose().run(angle=half).S0).all()

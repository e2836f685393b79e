"""What is given for the axes of a sweep: numbers, texts, columns, and how they make a grid."""

from contextlib import suppress
from importlib import import_module

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from chains import ENGINES
from optipath.sweeps.axes import grid_of
from tables import rows

xr = pytest.importorskip("xarray")
PATH = op.load_preset("npgr026")
NPGR, BOUND = PATH.compose(), PATH.bind(delta=0.5).compose()
SPECTRUM = op.load_preset("copper-gold-spectrum").compose()
LAMP = op.Source(stokes=[1, 1, 0, 0])
TURNED = LAMP >> op.Rotator(op.Parameter("a", unit="deg")) >> op.Detector()
GLASS = op.Interface(op.Material.cauchy([1.5, 4e-15]), 0.5)
COLOURED = (LAMP >> GLASS >> op.Detector()).compose()
INDEX = (op.Source(1) >> op.Interface(op.Parameter("n"), 0.5) >> op.Detector()).compose()
FILTER = (op.Source(1) >> op.Polarizer(op.Parameter("filter")) >> op.Detector()).compose()
POWER = (op.Source(op.Parameter("power")) >> op.Detector()).compose()
STATE = (op.Source(stokes=op.Parameter("s")) >> op.Detector()).compose()
UNITS = {"angle": ["deg", "rad", "mrad", "arcmin", "arcsec"], "length": ["nm", "um", "angstrom"]}
DEG = np.pi / 180
TWO = {"delta": [0.1, 0.2], "rho": [0.3, 0.4]}
THREE = {"phi": [0.5, 0.6, 0.7]}
PAIR = "delta", "rho"


def grid(given=None, zip=(), coords=None, plan=NPGR):  # noqa: A002 - as `path.sweep` has it
    return grid_of(plan.inputs, given or {}, zip, coords)


def axis_of(given, plan=NPGR):
    """The only axis of what is given by name."""
    (axis,) = grid(given, plan=plan).axes
    return axis


def refused(*args, **keywords):
    with pytest.raises(op.errors.ParameterError) as caught:
        grid(*args, **keywords)
    return caught.value.faults


def labelled(values, unit=None, dim="x"):
    return xr.DataArray(values, dims=dim, attrs={} if unit is None else {"units": unit})


def written(folder, text):
    file = folder / "points.csv"
    file.write_text(text, "utf-8")
    return file


def test_numbers_lists_ranges_and_arrays_are_axes_in_radians_as_they_are_and_one_is_none():
    axis = axis_of({"delta": np.array([0.1, 0.2, 0.7])})
    assert (axis.name, axis.dimension, axis.unit) == ("delta", "delta", "rad")
    assert axis.given.tolist() == axis.shown.tolist() == [0.1, 0.2, 0.7]
    assert axis.help == NPGR.inputs.open["delta"].help
    for numbers in ([0, 1], (0, 1), range(2), np.arange(2), np.arange(2.0)):
        axis = axis_of({"k1": numbers})
        assert (axis.given.tolist(), axis.given.dtype, axis.unit) == ([0.0, 1.0], np.float64, "")
    if "jax" in ENGINES:
        axis = axis_of({"delta": import_module("jax.numpy").array([0.25, 0.5])})
        assert isinstance(axis.given, np.ndarray)
        assert axis.given.tolist() == [0.25, 0.5]
    found = grid({"delta": "48 deg", "rho": 0.1, "n1": np.array(1.3), "filter": "none"})
    assert (found.axes, found.points) == ((), 1)
    assert found.fixed == {"delta": 48 * DEG, "rho": 0.1, "n1": 1.3, "filter": "none"}


def test_an_axis_stays_as_it_is_and_needs_no_unit_where_it_has_no_dimension():
    numbers = np.array([0.1, 0.2])
    for value in (numbers, labelled(numbers, "rad")):
        axis = axis_of({"delta": value})
        with suppress(ValueError):  # It is read-only where it is what is given as well.
            axis.shown[0] = 0.3
        numbers[1] = 0.4
        assert axis.given.tolist() == [0.1, 0.2]
        numbers[1] = 0.2
    for unit in ("", "1", "dimensionless", None):
        assert axis_of({"n1": labelled([1.3, 1.5], unit)}).unit == ""
    assert axis_of({"n": np.array([1.5, 0.2 + 3j])}, INDEX).given.tolist() == [1.5, 0.2 + 3j]
    found = grid({"n1": op.Material(1.4), "n2": [op.Material(1.5), 1.6, 1.7]})
    assert found.fixed == {"n1": 1.4}
    assert found.axes[0].given.tolist() == [1.5, 1.6, 1.7]


def test_texts_are_shown_in_the_unit_of_the_first_and_several_kinds_of_wavelengths_as_lengths():
    axis = axis_of({"delta": ["10 deg", "0.5 rad", "600 arcmin"]})
    assert axis.unit == "deg"
    assert axis.shown.tolist() == pytest.approx([10.0, np.degrees(0.5), 10.0], rel=1e-15)
    assert axis.given[1] == 0.5
    axis = axis_of({"phi": "0 deg:80 deg:9"})
    assert (axis.unit, axis.shown.tolist()) == ("deg", [10.0 * step for step in range(9)])
    assert axis.given[3] == 30 * DEG
    axis = axis_of({"wavelength": "1.8 eV:2.4 eV:4"}, COLOURED)
    assert (axis.unit, axis.shown.tolist()) == ("eV", [1.8, 2.0, 2.2, 2.4])
    assert axis.given[0] == pytest.approx(688.801e-9, rel=1e-6)
    for texts, shown in (
        (["2 eV", "500 nm"], [619.9209921660013, 500.0]),
        (["20000 1/cm", "19000 cm^-1"], [500.0, 1e7 / 19000]),
    ):
        axis = axis_of({"wavelength": texts}, COLOURED)
        assert axis.unit == "nm"
        assert axis.shown == pytest.approx(shown, rel=1e-14)


def test_words_are_shown_as_texts_which_give_them_back_and_are_numbers_without_none():
    axis = axis_of({"filter": ["none", "horizontal", 0.5, "30 deg"]})
    assert axis.unit == ""
    assert axis.shown.tolist() == ["none", "horizontal", "0.5 rad", "30 deg"]
    assert axis.given.tolist() == ["none", 0.0, 0.5, 30 * DEG]
    assert axis_of({"filter": labelled(axis.shown)}).given.tolist() == axis.given.tolist()
    for plan, angles in (
        (NPGR, {"vertical": np.pi / 2, "horizontal": 0.0}),
        (FILTER, {"antidiagonal": -np.pi / 4, "vertical": np.pi / 2}),
    ):
        axis = axis_of({"filter": [*angles]}, plan)
        assert axis.shown.tolist() == [*angles]
        assert (axis.given.tolist(), axis.given.dtype) == ([*angles.values()], np.float64)


@given(st.lists(st.sampled_from(["nm", "um", "m", "eV", "1/cm", "THz", "cm^-1"]), min_size=1))
def test_what_is_shown_is_what_is_given_in_its_unit(units):
    size = {"nm": 500.0, "um": 0.5, "m": 5e-7, "eV": 2.5, "1/cm": 2e4, "cm^-1": 2e4, "THz": 600.0}
    axis = axis_of({"wavelength": [f"{size[unit]!r} {unit}" for unit in units]}, COLOURED)
    texts = [f"{number!r} {axis.unit}" for number in axis.shown.tolist()]
    again = axis_of({"wavelength": texts}, COLOURED)
    assert again.given == pytest.approx(axis.given, rel=4e-16)


@given(st.data())
def test_the_axis_of_an_array_with_units_has_the_very_numbers_of_its_texts(data):
    name, plan = data.draw(st.sampled_from([("a", TURNED.compose()), ("wavelength", COLOURED)]))
    parameter = plan.inputs.open[name]
    unit = data.draw(st.sampled_from(UNITS["angle" if name == "a" else "length"]))
    low, high = (-6.0, 6.0) if name == "a" else (4e-7, 7e-7)
    size = parameter.parse(f"1 {unit}")
    numbers = data.draw(st.lists(st.floats(low / size, high / size), min_size=1, max_size=5))
    texts = [f"{number!r} {unit}" for number in numbers]
    alone = [float(parameter.resolve(text).value) for text in texts]
    axis = axis_of({name: labelled(numbers, unit)}, plan)
    assert axis.given.tolist() == alone == axis_of({name: texts}, plan).given.tolist()
    assert axis.shown.tolist() == numbers


@rows(
    "value, told",
    [
        (labelled([10.0, 48.0]), "is a DataArray without a unit; write one of deg, rad"),
        (labelled([10.0, 48.0], "degs"), "did you mean 'deg'?"),
        (labelled([10.0, 48.0], "nm"), "'1 nm' is no angle"),
        (labelled([10.0, 48.0], 3), "is a DataArray of unit 3; write one of deg"),
        (labelled([10 + 1j], "deg"), "'(10+1j) deg' is not a quantity"),
        (labelled([True], "deg"), "must be a number"),
        (np.zeros((2, 3)), "has the shape (2, 3), and an axis has one dimension"),
        ([["1 deg"], ["2 deg"]], "has the shape (2, 1), and an axis has one dimension"),
        ([], "has no values; give one at least"),
        (None, "has no value; give one, delta=..."),
        (True, "must be a number, not True"),
        (["1 deg", None], "must be a number, not None"),
        (np.array(["2020-01-01"], "M8[D]"), "must be a number, not array(['2020-01-01']"),
        (np.ma.masked_array([0.1, 0.2], [0, 1]), "has masked entries"),
        (op.CosSin(0.6, 0.8), "is a CosSin, and an axis is of numbers; give an angle itself"),
        (op.Material(1.5), "a Material stands for an index of refraction"),
        ([0.1, 1 + 1j], "is complex"),
        ("0:90:91", "'0' has no unit, but an angle is asked for"),
        ("0 nm:90 nm:91", "'0 nm' is no angle"),
    ],
)
def test_what_is_no_axis_or_has_no_unit_is_told(value, told):
    message = "; ".join(refused({"delta": value}))
    assert told in message
    assert "delta" in message


IN_PLACE = op.Material(op.Parameter("n"), 0.1)
MILLION = dict.fromkeys(("delta", "rho", "phi"), np.zeros(10**6))


@rows(
    "given, plan, told",
    [
        ({"n1": IN_PLACE}, NPGR, "is put in place before a path runs; write path.bind(n1=...)"),
        ({"s": [1, 0, 0, 0]}, STATE, "which no axis has; bind it, by path.bind(s=...)"),
        ({"k1": np.array([0, np.nan])}, NPGR, "parameter 'k1' is nan at 1; give a finite number"),
        ({"k1": np.array([0, -np.inf])}, NPGR, "parameter 'k1' is -inf at 1; give a finite"),
        ({"delta": [0.1, 1.6]}, NPGR, "'delta' is 91.6732 deg at 1, outside its range"),
        ({"delta": range(91)}, NPGR, "is 114.592 deg at 2, outside"),
        ({"wavelength": range(400, 701)}, SPECTRUM, "for nanometres write '400 nm'"),
        (MILLION, NPGR, "a batch has 9e+15 paths at most, not 1e+18 paths"),
        ({"delta": [0.1]}, BOUND, "parameter 'delta' is bound to"),
    ],
)
def test_values_of_an_axis_that_do_not_do_are_told_with_place_or_cure(given, plan, told):
    (fault,) = refused(given, plan=plan)
    assert told in fault


def test_degrees_for_radians_are_warned_of_once_from_the_line_of_the_caller():
    with pytest.warns(op.errors.AngleWarning, match="parameter 'a' is a plain number") as caught:
        TURNED.sweep(a=[0.1, 45.0]).DoP.load()
    assert [warning.filename for warning in caught] == [__file__]
    TURNED.sweep(a="0 deg:1000 deg:7").DoP.load()  # Texts are what they say.


@pytest.mark.filterwarnings("ignore::optipath.errors.AngleWarning")
def test_a_sweep_is_of_the_numbers_of_single_runs():
    plan = TURNED.compose()
    axis = axis_of({"a": labelled([48.0, 12.3], "deg")}, plan)
    for text, number in zip(["48 deg", "12.3 deg"], axis.given, strict=True):
        assert np.array_equal(plan.run(a=text).stokes, plan.run(a=float(number)).stokes)


def test_dimensions_are_called_as_parameters_in_the_order_given_or_as_zip_says():
    assert grid(THREE | TWO).sizes == {"phi": 3, "delta": 2, "rho": 2}
    assert (grid().sizes, grid().points) == ({}, 1)
    given = TWO | THREE | {"n1": [1.1, 1.2, 1.3]}
    assert grid(given, zip=[PAIR, ("phi", "n1")]).sizes == {"delta_rho": 2, "phi_n1": 3}
    assert grid(TWO, zip={"point": PAIR}).sizes == {"point": 2}
    found = grid(TWO | THREE, zip=PAIR)
    assert found.sizes == {"delta_rho": 2, "phi": 3}
    assert [axis.dimension for axis in found.axes] == ["delta_rho", "delta_rho", "phi"]
    assert found.given()["delta"].shape == found.given()["rho"].shape == (2, 1)
    for zipped, told in (
        (("delta", "phi"), "there are 2 of 'delta' and 3 of 'phi'; give as many each"),
        ([PAIR, ("rho", "phi")], "zip names 'rho' twice"),
        (("delta", "delta"), "zip names 'delta' twice"),
        (("delta", "roh"), "zip names 'roh', which has no axis of its own; did you mean 'rho'?"),
        (("delta", "n1"), "zip names 'n1', which has no axis of its own"),
        ({"k1": PAIR}, "zip calls a dimension 'k1', which is the name of a parameter"),
        ({3: PAIR}, "write zip=('a', 'b'), zip=[('a', 'b')"),
        ("delta", "zip is 'delta', and a group is two names or more; write zip=('a', 'b')"),
        (("delta",), "a group is two names or more"),
        ([("delta", 3)], "a group is two names or more"),
    ):
        (fault,) = refused(TWO | THREE | {"n1": 1.3}, zip=zipped)
        assert told in fault, zipped


def test_all_faults_are_told_at_once_and_what_may_be_meant_is_asked_about():
    given = {"detla": [0.1], "delta": [0.1, 2.5], "rho": [np.nan], "phi": [], "n1": [1.0, -1.0]}
    faults = refused(given, zip=("rho", "k1"), coords={"delta": [0.1], "foo": 1})
    for told in (
        "parameter 'detla' is unknown; did you mean 'delta'?",
        "parameter 'foo' is unknown",
        "'delta' is given by its name, and in coords as well; leave one of them out",
        "parameter 'phi' has no values",
        "zip names 'k1', which has no axis of its own",
        "parameter 'rho' is nan at 0; give a finite number",
        "parameter 'n1' is -1 at 1",
    ):
        assert any(told in fault for fault in faults), told
    first, second = refused({"delta": [0.1, 1.6], "rho": [0.1, 0.2, 7.0]})
    assert "'delta' is 91.6732 deg at 1" in first
    assert "at 2, outside its range" in second
    # A hundred million points are refused at once for one of an axis.
    given = {"delta": np.zeros(10_000), "rho": np.append(np.zeros(9_999), 7.0)}
    with pytest.raises(op.errors.ParameterError, match="at 9999, outside its range"):
        grid_of(NPGR.inputs, given, ranges=False)
    assert refused(plan=POWER) == ("parameter 'power' has no value; give one, power=...",)
    plan = (op.Source(op.Parameter("chunks")) >> op.Detector()).compose()
    (fault,) = refused(plan=plan)
    assert fault.endswith("sweep has a keyword of that name; give it by coords={'chunks': ...}")
    assert grid(coords={"chunks": [1.0, 2.0]}, plan=plan).sizes == {"chunks": 2}
    turned = op.Rotator(op.Parameter("a", default=[0.1, 0.2]))
    faults = refused(plan=(op.Source([1.0, 2.0]) >> turned >> op.Detector()).compose())
    assert "has an array of shape (2,), and no axis has its name" in faults[0]
    assert "parameter 'a' has an array of shape (2,) by default" in faults[1]
    given = {name: labelled(values, "rad", "point") for name, values in TWO.items()}
    (fault,) = refused(given)
    assert "write zip={'point': ('delta', 'rho')} if they vary together" in fault
    assert ", or .rename(point='rho') for all combinations" in fault
    assert grid(given, zip={"point": PAIR}).sizes == {"point": 2}
    apart = given | {"rho": given["rho"].rename(point="rho")}
    for axes in (apart, TWO | {"delta": given["delta"]}):
        assert grid(axes).sizes == {"delta": 2, "rho": 2}


def test_columns_of_a_file_vary_together_and_a_dataset_gives_the_same_axes_again(tmp_path):
    file = written(tmp_path, "delta (deg),rho_mrad,filter\n10,5,none\n20,6,horizontal\n")
    found = grid(THREE, coords=file)
    assert found.sizes == {"phi": 3, "point": 2}
    units = [(axis.name, axis.unit) for axis in found.axes[1:]]
    assert units == [("delta", "deg"), ("rho", "mrad"), ("filter", "")]
    assert found.axes[1].given.tolist() == [10 * DEG, 20 * DEG]
    assert found.axes[3].given.tolist() == ["none", 0.0]
    assert grid(coords=str(written(tmp_path, "n1\n1.3\n1.4\n"))).sizes == {"n1": 2}
    found = PATH.sweep(coords=written(tmp_path, "n1 (1),delta (deg)\n1.5,20\n1.6,30\n"))
    assert found.n1.values.tolist() == [1.5, 1.6]
    assert found.n1.units == "1"
    given = {"delta": "0 deg:80 deg:2", "rho": [0.3, 0.4], "filter": ["none", "vertical"]}
    given["n1"] = 1.2
    again = grid(coords=PATH.sweep(**given, zip=PAIR))
    for axis, other in zip(grid(given, PAIR).axes, again.axes, strict=True):
        assert (axis.name, axis.dimension, axis.unit) == (other.name, other.dimension, other.unit)
        assert axis.given.tolist() == other.given.tolist()
    assert again.fixed["n1"] == 1.2


def test_what_is_wrong_in_a_file_is_told_with_its_name_and_the_lines_of_cells(tmp_path):
    def told_in(text):
        file = written(tmp_path, text)
        faults = refused(coords=file)
        assert all(fault.startswith(f"{file}: ") for fault in faults)
        return [fault.removeprefix(f"{file}: ") for fault in faults]

    for text, sentence in {
        "delta\n10\n": "column 'delta' has no unit; write its name as 'delta (deg)'",
        "detla (deg)\n10\n": "parameter 'detla' is unknown; did you mean 'delta'?",
        "delta (degs)\n10\n": "unit 'degs' of '10 degs' is unknown; did you mean 'deg'?",
        "n1\nhigh\n": "parameter 'n1' knows no word 'high'",
        "n1,n1\n1,2\n": "line 1 names 'n1' twice",
        "delta (deg),rho (deg)\n10,5,20,5\n": "line 2 has 4 values, and line 1 has 2 names",
        "delta (deg);rho (deg)\n10,5;5\n": "'10,5 deg' is not a quantity",
        "delta (deg);rho (deg)\n11;1.000,5\n": "'1.000,5 deg' is not a quantity",
    }.items():
        (fault,) = told_in(text)
        assert sentence in fault
    assert told_in("n1,delta (deg)\n1.5,20\nnan,120\n-1,130\n") == [
        "line 3: parameter 'n1' cannot be 'nan', which is not finite; give a number",
        "line 4: parameter 'n1' is -1, outside its range; give 0 or more",
        "line 3: parameter 'delta' is 120 deg, outside its range; give 0 deg .. 90 deg",
        "line 4: parameter 'delta' is 130 deg, outside its range; give 0 deg .. 90 deg",
    ]
    found = told_in("delta (deg)\n" + "100\n" * 50)
    assert [found[0][:7], len(found)] == ["line 2:", 50]
    for coords, sentence in {
        "nowhere.csv": "nowhere.csv: it cannot be read: No such file",
        3: "coords is 3; give the name of a CSV file, a Dataset",
        "before.nc": "give what it holds, coords=xr.open_dataset('before.nc')",
        "before.zarr": "coords=xr.open_zarr('before.zarr')",
    }.items():
        (fault,) = refused(coords=coords)
        assert sentence in fault


MEASURED = xr.Dataset(
    {"measured": ("point", [1.0, 2.0])},
    {
        "delta": ("point", [10.0, 20.0], {"units": "deg"}),
        "rho": ("point", [1.0, 2.0], {"units": "deg"}),
        "phi": ("phi", [0.1, 0.2, 0.3], {"units": "rad"}),
        "n1": 1.2,
        "detector": ("detector", ["a"]),
    },
)


def test_coordinates_along_one_dimension_vary_together_and_what_is_no_axis_is_told():
    found = grid({"k1": [0.0]}, coords=MEASURED)
    assert (found.sizes, found.fixed) == ({"k1": 1, "point": 2, "phi": 3}, {"n1": 1.2})
    assert found.axes[1].given.tolist() == [10 * DEG, 20 * DEG]
    assert grid(coords=MEASURED["measured"]).sizes == {"point": 2}
    beside = MEASURED.drop_vars("rho").assign_coords(rho=("phi", [0.0, 0.1, 0.2], {"units": "rad"}))
    along = {axis.name: axis.dimension for axis in grid(coords=beside).axes}
    assert along == {"delta": "point", "phi": "phi", "rho": "phi"}
    # Labels of points are no axes.
    named = MEASURED.assign_coords(point=["a", "b"])
    assert grid(coords=named).sizes == {"point": 2, "phi": 3}
    stacked = MEASURED[["phi"]].assign_coords(k1=("k1", [0.0, 0.1])).stack(point=("phi", "k1"))
    assert grid(coords=stacked.drop_vars("delta", errors="ignore")).sizes == {"point": 6}
    faults = refused(TWO, coords=MEASURED)
    assert all("in coords as well; leave one of them out" in fault for fault in faults)
    assert grid(TWO, coords=MEASURED.drop_vars(["delta", "rho"])).points == 12
    several = MEASURED.assign_coords(foo=1, k1=(("point", "phi"), np.ones((2, 3))))
    faults = refused(coords=several)
    assert "leave it out, .drop_vars('foo')" in faults[0]
    assert "coordinate 'k1' is along point, phi, and an axis has one dimension" in faults[1]
    assert grid(coords=several.drop_vars(["foo", "k1"])).points == 6
    (fault,) = refused(coords=MEASURED.rename_dims(point="k1"))
    assert "is along the dimension 'k1', which is the name of a parameter with" in fault


def test_tables_are_no_axes_and_no_coords_and_what_to_give_is_told():
    pandas = pytest.importorskip("pandas")
    df = pandas.DataFrame(TWO)
    for table, told in (
        ({"delta": df["delta"]}, "give its numbers alone, as .to_numpy()"),
        ({"delta": df}, "is a DataFrame, and an axis is of numbers; give"),
        (
            {"delta": xr.Dataset(coords=TWO)},
            "is a Dataset, and an axis is of numbers; give",
        ),
    ):
        (fault,) = refused(table)
        assert told in fault
    (fault,) = refused(coords=df)
    assert fault.startswith("coords is a DataFrame; give the name of a CSV file, a Data")
    assert grid(coords={"delta": df["delta"].to_numpy()}).sizes == {"delta": 2}

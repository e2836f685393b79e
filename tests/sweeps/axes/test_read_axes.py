"""The grid of a sweep: which axes there are, along which dimensions, and what is wrong."""

import numpy as np
import pytest

import optipath as op
from optipath.sweeps.axes.read_axes import grid_of
from tables import rows

NPGR = op.load_preset("npgr026").compose()
TWO = {"delta": [0.1, 0.2], "rho": [0.3, 0.4]}
THREE = {"phi": [0.5, 0.6, 0.7]}


def grid(given=None, zip=(), coords=None, plan=NPGR):  # noqa: A002 - as `path.sweep` has it
    return grid_of(plan.inputs, given or {}, zip, coords)


def refused(*args, **keywords):
    with pytest.raises(op.ParameterError) as caught:
        grid(*args, **keywords)
    return caught.value.faults


def written(folder, text):
    file = folder / "points.csv"
    file.write_text(text, "utf-8")
    return file


def test_dimensions_are_called_as_parameters_in_the_order_given():
    assert grid(THREE | TWO).sizes == {"phi": 3, "delta": 2, "rho": 2}


def test_no_axis_is_a_grid_of_one_point():
    assert (grid().sizes, grid().points) == ({}, 1)


def test_zip_makes_one_dimension_of_several_parameters():
    found = grid(TWO | THREE, zip=("delta", "rho"))
    assert found.sizes == {"delta_rho": 2, "phi": 3}
    assert [axis.dimension for axis in found.axes] == ["delta_rho", "delta_rho", "phi"]
    assert found.given()["delta"].shape == found.given()["rho"].shape == (2, 1)


def test_zip_takes_several_groups():
    given = TWO | THREE | {"n1": [1.1, 1.2, 1.3]}
    assert grid(given, zip=[("delta", "rho"), ("phi", "n1")]).sizes == {"delta_rho": 2, "phi_n1": 3}


def test_zip_names_a_dimension():
    assert grid(TWO, zip={"point": ("delta", "rho")}).sizes == {"point": 2}


@rows(
    "zipped, told",
    [
        (("delta", "phi"), "there are 2 of 'delta' and 3 of 'phi'; give as many each"),
        ([("delta", "rho"), ("rho", "phi")], "zip names 'rho' twice"),
        (("delta", "delta"), "zip names 'delta' twice"),
        (("delta", "roh"), "zip names 'roh', which has no axis of its own; did you mean 'rho'?"),
        (("delta", "n1"), "zip names 'n1', which has no axis of its own"),
        ({"k1": ("delta", "rho")}, "zip calls a dimension 'k1', which is the name of a parameter"),
        ({3: ("delta", "rho")}, "zip calls a dimension 3; give it a text for a name"),
        ("delta", "zip is 'delta'; write zip=('a', 'b')"),
        (("delta",), "a group is two names or more"),
        ([("delta", 3)], "a group is two names or more"),
        (3, "zip is 3; write zip=('a', 'b')"),
    ],
)
def test_what_zip_cannot_mean_is_told(zipped, told):
    (fault,) = refused(TWO | THREE | {"n1": 1.3}, zip=zipped)
    assert told in fault


def test_all_faults_are_told_at_once():
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


@rows("bad", [np.nan, np.inf, -np.inf])
def test_what_is_not_finite_is_told_with_its_place(bad):
    (fault,) = refused({"k1": np.array([0.0, 1.0, bad])})
    assert fault.startswith(f"parameter 'k1' is {bad} at 2; give a finite number")


def test_what_is_out_of_range_is_told_with_its_place_along_the_axis():
    faults = refused({"delta": [0.1, 1.6], "rho": [0.1, 0.2, 7.0]})
    assert "parameter 'delta' is 91.6732 deg at 1, outside its range" in faults[0]
    assert "at 2, outside its range" in faults[1]


def test_degrees_that_are_refused_are_told_with_the_radians_that_they_are():
    (fault,) = refused({"delta": range(91)})
    assert "did you mean '2 deg' or np.radians(2)?" in fault


def test_wavelengths_in_plain_nanometres_are_told():
    plan = op.load_preset("copper-gold-spectrum").compose()
    (fault,) = refused({"wavelength": range(400, 701)}, plan=plan)
    assert "is 400 metres, which is no wavelength of light; for nanometres write '400 nm'" in fault


def test_a_hundred_million_points_are_refused_at_once_for_one_of_an_axis():
    given = {"delta": np.zeros(10_000), "rho": np.append(np.zeros(9_999), 7.0)}
    with pytest.raises(op.ParameterError) as caught:
        grid_of(NPGR.inputs, given, ranges=False)
    (fault,) = caught.value.faults
    assert "at 9999, outside its range" in fault


def test_more_points_than_a_batch_has_are_told():
    given = dict.fromkeys(("delta", "rho", "phi"), np.zeros(10**6))
    (fault,) = refused(given)
    assert "a batch has 9e+15 paths at most, not 1e+18 paths" in fault


def test_bound_parameters_say_where_they_are_bound():
    plan = op.load_preset("npgr026").bind(delta=0.5).compose()
    (fault,) = refused({"delta": [0.1]}, plan=plan)
    assert "parameter 'delta' is bound to" in fault


def test_parameters_without_a_value_are_told():
    path = op.Source(op.Parameter("power")) >> op.Detector()
    assert refused(plan=path.compose()) == ("parameter 'power' has no value; give one, power=...",)


def test_a_parameter_with_the_name_of_a_keyword_is_given_by_coords():
    plan = (op.Source(op.Parameter("chunks")) >> op.Detector()).compose()
    (fault,) = refused(plan=plan)
    assert fault.endswith("sweep has a keyword of that name; give it by coords={'chunks': ...}")
    assert grid(coords={"chunks": [1.0, 2.0]}, plan=plan).sizes == {"chunks": 2}


def test_arrays_that_the_path_has_are_told():
    path = (
        op.Source([1.0, 2.0]) >> op.Rotator(op.Parameter("a", default=[0.1, 0.2])) >> op.Detector()
    )
    faults = refused(plan=path.compose())
    assert "has an array of shape (2,), and no axis has its name" in faults[0]
    assert "parameter 'a' has an array of shape (2,) by default" in faults[1]


def test_arrays_along_one_dimension_are_asked_about():
    xarray = pytest.importorskip("xarray")
    given = {
        name: xarray.DataArray(values, dims="point", attrs={"units": "rad"})
        for name, values in TWO.items()
    }
    (fault,) = refused(given)
    assert "write zip={'point': ('delta', 'rho')} if they vary together" in fault
    assert ", or .rename(point='rho') for all combinations" in fault
    assert grid(given, zip={"point": ("delta", "rho")}).sizes == {"point": 2}
    apart = given | {"rho": given["rho"].rename(point="rho")}
    assert grid(apart).sizes == {"delta": 2, "rho": 2}
    assert grid(TWO | {"delta": given["delta"]}).sizes == {"delta": 2, "rho": 2}


def test_columns_of_a_file_vary_together(tmp_path):
    file = written(tmp_path, "delta (deg),rho_mrad,filter\n10,5,none\n20,6,horizontal\n")
    found = grid(THREE, coords=file)
    assert found.sizes == {"phi": 3, "point": 2}
    assert [(axis.name, axis.unit) for axis in found.axes[1:]] == [
        ("delta", "deg"),
        ("rho", "mrad"),
        ("filter", ""),
    ]
    assert found.axes[1].given.tolist() == [10 * (np.pi / 180), 20 * (np.pi / 180)]
    assert found.axes[3].given.tolist() == ["none", 0.0]


def test_the_only_column_of_a_file_is_an_axis_of_its_own(tmp_path):
    assert grid(coords=str(written(tmp_path, "n1\n1.3\n1.4\n"))).sizes == {"n1": 2}


@rows(
    "text, told",
    [
        ("delta\n10\n", "column 'delta' has no unit; write its name as 'delta (deg)'"),
        ("detla (deg)\n10\n", "parameter 'detla' is unknown; did you mean 'delta'?"),
        ("delta (degs)\n10\n", "unit 'degs' of '10 degs' is unknown; did you mean 'deg'?"),
        ("n1\nhigh\n", "parameter 'n1' knows no word 'high'"),
        ("n1,n1\n1,2\n", "line 1 names 'n1' twice"),
    ],
)
def test_what_is_wrong_in_a_file_is_told_with_its_name(tmp_path, text, told):
    (fault,) = refused(coords=written(tmp_path, text))
    assert "points.csv: " in fault
    assert told in fault


def test_a_file_that_is_not_there_is_told():
    (fault,) = refused(coords="nowhere.csv")
    assert fault == "nowhere.csv: there is no such file; look at its name"


def test_coords_of_another_kind_are_told():
    (fault,) = refused(coords=3)
    assert fault.startswith("coords is 3; give the name of a CSV file, a Dataset")


def dataset():
    xarray = pytest.importorskip("xarray")
    return xarray.Dataset(
        {"measured": ("point", [1.0, 2.0])},
        {
            "delta": ("point", [10.0, 20.0], {"units": "deg"}),
            "rho": ("point", [1.0, 2.0], {"units": "deg"}),
            "phi": ("phi", [0.1, 0.2, 0.3], {"units": "rad"}),
            "n1": 1.2,
            "detector": ("detector", ["a"]),
        },
    )


def test_coordinates_along_one_dimension_vary_together():
    found = grid({"k1": [0.0]}, coords=dataset())
    assert found.sizes == {"k1": 1, "point": 2, "phi": 3}
    assert found.fixed == {"n1": 1.2}
    assert found.axes[1].given.tolist() == [10 * (np.pi / 180), 20 * (np.pi / 180)]


def test_what_is_in_a_dataset_as_well_is_left_out_of_it():
    faults = refused(TWO, coords=dataset())
    assert all("such as coords.drop_vars(['delta', 'rho'])" in fault for fault in faults)
    assert grid(TWO, coords=dataset().drop_vars(["delta", "rho"])).points == 12


def test_coordinates_of_an_array_are_axes():
    assert grid(coords=dataset()["measured"]).sizes == {"point": 2}


def test_coordinates_that_are_no_axes_are_told_with_a_cure():
    several = dataset().assign_coords(foo=1, k1=(("point", "phi"), np.ones((2, 3))))
    faults = refused(coords=several)
    assert "leave it out, .drop_vars('foo')" in faults[0]
    assert "coordinate 'k1' is along point, phi, and an axis has one dimension" in faults[1]
    assert grid(coords=several.drop_vars(["foo", "k1"])).points == 6


def test_labels_of_points_are_no_axes():
    named = dataset().assign_coords(point=["a", "b"])
    assert grid(coords=named).sizes == {"point": 2, "phi": 3}
    stacked = dataset()[["phi"]].assign_coords(k1=("k1", [0.0, 0.1])).stack(point=("phi", "k1"))
    assert grid(coords=stacked.drop_vars("delta", errors="ignore")).sizes == {"point": 6}


def test_a_dimension_with_the_name_of_another_parameter_is_told():
    (fault,) = refused(coords=dataset().rename_dims(point="k1"))
    assert (
        "is along the dimension 'k1', which is the name of a parameter with another axis" in fault
    )


def test_what_stands_along_the_dimension_of_a_parameter_varies_with_it():
    beside = (
        dataset().drop_vars("rho").assign_coords(rho=("phi", [0.0, 0.1, 0.2], {"units": "rad"}))
    )
    assert {axis.name: axis.dimension for axis in grid(coords=beside).axes} == {
        "delta": "point",
        "phi": "phi",
        "rho": "phi",
    }


def test_the_dataset_of_a_sweep_gives_the_same_axes_again():
    pytest.importorskip("xarray")
    given = {
        "delta": "0 deg:80 deg:2",
        "rho": [0.3, 0.4],
        "filter": ["none", "vertical"],
        "n1": 1.2,
    }
    together = ("delta", "rho")
    first = op.load_preset("npgr026").sweep(**given, zip=together)
    again = grid(coords=first)
    for axis, other in zip(grid(given, together).axes, again.axes, strict=True):
        assert (axis.name, axis.dimension, axis.unit) == (other.name, other.dimension, other.unit)
        assert axis.given.tolist() == other.given.tolist()
    assert again.fixed["n1"] == 1.2


def test_tables_are_no_axes_and_no_coords_and_what_to_give_is_told():
    pandas, xarray = pytest.importorskip("pandas"), pytest.importorskip("xarray")
    df, ds = pandas.DataFrame(TWO), xarray.Dataset(coords=TWO)
    (fault,) = refused({"delta": df})
    assert "is a DataFrame; give one of its columns, such as df['delta'].to_numpy()" in fault
    (fault,) = refused({"delta": ds})
    assert "is a Dataset; give one of its coordinates, such as ds['delta']" in fault
    (fault,) = refused(coords=df)
    assert fault.startswith("coords is a DataFrame; give a CSV file, a Dataset, or columns by name")
    assert "{'delta': df['delta'].to_numpy()}, and zip=" in fault
    assert grid(coords={"delta": df["delta"].to_numpy()}).sizes == {"delta": 2}


def test_files_that_are_no_tables_are_opened_and_given():
    (fault,) = refused(coords="before.nc")
    assert fault.endswith("give what it holds, coords=xr.open_dataset('before.nc')")
    (fault,) = refused(coords="before.zarr")
    assert fault.endswith("coords=xr.open_zarr('before.zarr')")

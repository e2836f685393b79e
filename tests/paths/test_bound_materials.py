"""A material that is bound to the n of an index gives its k as well."""

import copy
import pickle

import numpy as np
import pytest

import optipath as op
from optipath.paths.drawing import draw

GRID = np.array([4.0e-7, 4.4e-7, 5.16e-7])
N, K = [1.5, 1.0, 0.3], [1.9, 1.8, 2.9]


def metal(wavelength=None):
    nodes = ["400 nm", "500 nm", "600 nm"]
    return op.Material.tabulated(nodes, N, K, name="paint", wavelength=wavelength)


def interpolated(wavelengths):
    nodes = [4e-7, 5e-7, 6e-7]
    return np.interp(wavelengths, nodes, N), np.interp(wavelengths, nodes, K)


def test_a_material_gives_n_and_k_of_the_path():
    path = op.load_preset("npgr026", case=7, n1=metal())
    assert "wavelength" in path.parameters
    assert {"n1", "k1"}.isdisjoint(path.parameters)
    n, k = interpolated(GRID)
    expected = op.load_preset("npgr026", case=7).trace(n1=n, k1=k).stokes
    np.testing.assert_allclose(path.trace(wavelength=GRID).stokes, expected, rtol=1e-13)


def test_two_materials_share_one_wavelength():
    path = op.load_preset("npgr026").bind(n1=metal(), n2=metal(), wavelength="500 nm")
    expected = op.load_preset("npgr026").trace(n1=1.0, k1=1.8, n2=1.0, k2=1.8)
    assert path.trace() == expected


def test_a_constant_material_gives_both_as_well():
    path = op.load_preset("npgr026", case=7).bind(n1=op.Material(1.12, 2.16))
    assert path.parameters["k1"].bound
    assert path.trace() == op.load_preset("npgr026", case=7).trace()
    # The k of the case would be none of glass.
    glass = op.load_preset("npgr026", case=7).bind(n1=op.Material(1.5))
    assert glass.trace() == op.load_preset("npgr026", case=7).trace(n1=1.5, k1=0.0)


def test_an_index_that_is_one_parameter_takes_a_material():
    path = op.Source() >> op.Interface(op.Parameter("m"), "40 deg") >> op.Detector()
    light = path.bind(m=metal()).trace(wavelength="500 nm")
    np.testing.assert_allclose(light.stokes, path.trace(m=1.0 + 1.8j).stokes, rtol=1e-13)


def test_what_was_published_for_other_values_is_left_out():
    path = op.load_preset("npgr026", n1=metal())
    assert path.cases["7"].published == {}
    assert "k1" not in path.cases["7"].values
    assert path.cases["7"].values["n2"] == 0.608


@pytest.mark.parametrize(
    ("give", "sentence"),
    [
        (lambda path: path.bind(n1=metal(), k1=0.1), "'k1' is given by 'n1', .* leave k1 out"),
        (lambda path: path.trace(n1=metal()), r"depends on wavelength, .* path.bind\(n1=...\)"),
        (lambda path: path.with_defaults(n1=metal()), r"bind it, by path.bind\(.1=...\)"),
        (lambda path: path.bind(delta=metal()), "'delta' .* stands for an index of refraction"),
        (lambda path: path.bind(k1=metal()), "'k1' .* stands for an index of refraction"),
        (
            lambda path: path.bind(n1=metal(), wavelength="1 um"),
            "1000 nm; .* 400 nm .. 600 nm, for which paint",
        ),
        (lambda path: path.bind(n1=metal(), wavelength=516), "write '516 nm'"),
    ],
)
def test_what_a_material_cannot_do_is_told_with_the_cure(give, sentence):
    with pytest.raises(op.OptipathError, match=sentence):
        give(op.load_preset("npgr026"))


def test_a_k_that_is_known_where_the_path_is_built_is_not_replaced():
    gold = op.Material(op.Parameter("n"), 2.0)
    path = op.Source() >> op.Interface(gold, 0.3) >> op.Detector()
    with pytest.raises(op.ParameterError, match="k is 2 where the path is built"):
        path.bind(n=metal())


def test_a_k_that_stands_elsewhere_too_is_not_replaced():
    k = op.Parameter("k")
    one, two = op.Material(op.Parameter("n"), k), op.Material(1.5, k)
    path = op.Source() >> op.Interface(one, 0.3) >> op.Interface(two, 0.4) >> op.Detector()
    with pytest.raises(op.ParameterError, match=r"'k' stands at interface-2.index.k besides"):
        path.bind(n=metal())


def test_a_multiple_of_n_takes_no_material():
    half = op.Material(0.5 * op.Parameter("n"), op.Parameter("k"))
    path = op.Source() >> op.Interface(half, 0.3) >> op.Detector()
    with pytest.raises(op.ParameterError, match=r"'n' stands as 0.5 \* n"):
        path.bind(n=metal())


def test_the_path_is_copied_kept_and_written(tmp_path):
    path = op.load_preset("npgr026", case=7, n1=metal())
    file = tmp_path / "path.toml"
    file.write_text(path.to_toml(), "utf-8")
    for other in (copy.copy(path), copy.deepcopy(path), pickle.loads(pickle.dumps(path))):
        assert other == path
        assert other.trace(wavelength="500 nm") == path.trace(wavelength="500 nm")
    assert op.load_preset(file) == path
    assert op.load_preset("npgr026", case=7, n1=metal("500 nm")) != path
    plan = pickle.loads(pickle.dumps(path.compose()))
    assert plan.run(wavelength=GRID) == path.trace(wavelength=GRID)


def test_drawings_and_explanations_call_a_material_by_its_name():
    path = op.load_preset("npgr026", n1=metal())
    assert "X1  interface  index=paint  incidence=$delta" in draw(path)
    explained = str(path.compose().explanation())
    assert "parameter wavelength: must be given" in explained
    assert "n of paint follows from wavelength" in explained
    green = str(path.bind(wavelength="516 nm").compose().explanation())
    assert "parameter wavelength = 516 nm" in green
    assert "paint" not in green


def test_questions_of_a_plan_take_the_wavelength():
    n, k = interpolated(5.16e-7)
    path = op.load_preset("npgr026", case=8, n1=metal())
    same = op.load_preset("npgr026", case=8, n1=float(n), k1=float(k))
    green = path.bind(wavelength="516 nm")
    for ask in (
        lambda one: one.trace().stokes,
        lambda one: one.mueller().matrix,
        lambda one: one.reversed().trace().stokes,
        lambda one: one.paths()[0].light.stokes,
        lambda one: op.polarization(one).certificate.upper,
        lambda one: one.compose().certificate().lower,
    ):
        np.testing.assert_allclose(ask(green), ask(same), rtol=1e-12, atol=1e-15)


def test_the_reference_takes_what_a_curve_comes_to():
    pytest.importorskip("mpmath")
    from optipath.lab.accuracy.path_reference import exact_stokes  # noqa: PLC0415

    path = op.load_preset("npgr026", case=8, n1=metal())
    exact = [float(part) for part in exact_stokes(path, wavelength="516 nm")["E"]]
    light = path.trace(wavelength="516 nm")
    np.testing.assert_allclose(light.stokes, exact, rtol=20 * 2.0**-52)


def test_a_material_may_be_bound_behind_the_wavelength():
    path = op.load_preset("npgr026", case=7, n1=metal())
    found = path.bind(wavelength="500 nm").bind(n2=metal())
    expected = path.bind(wavelength="500 nm", n2=metal())
    assert found.trace() == expected.trace()
    assert found.parameters["wavelength"].bound


def test_a_wavelength_that_is_bound_in_a_part_of_a_path_and_open_in_another_is_refused():
    part = (op.Source() >> op.Interface(metal(), 0.3)).bind(wavelength="500 nm")
    path = part >> op.Interface(metal(), 0.3) >> op.Detector()
    with pytest.raises(
        op.PathError, match=r"'wavelength' is open at .*, and bound elsewhere to 500 nm; bind it"
    ):
        path.trace()

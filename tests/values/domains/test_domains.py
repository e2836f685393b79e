"""Domains: yes or no, pairs of numbers, and media that must not absorb."""

import re

import numpy as np
import pytest

import optipath as op
from optipath.values.domains.quantities import YesOrNo
from paths import chain
from tables import rows


class Shutter(op.Element, kind="test-shutter"):
    shut: YesOrNo = False

    @staticmethod
    def mueller_rows(xp, shut):
        through = xp.where(shut, 0.0, 1.0)
        return [[through * (row == column) for column in range(4)] for row in range(4)]


def test_a_yes_no_field_gives_its_rows_1_or_0_and_goes_to_toml_and_back(tmp_path):
    file = tmp_path / "shutter.toml"
    for shut in (True, False):
        path = chain([Shutter(shut)])
        assert path.trace().stokes[0] == (0.0 if shut else 1.0)
        assert f"shut = {str(shut).lower()}\n" in path.to_toml()
        file.write_text(path.to_toml(), "utf-8")
        assert op.load_preset(file) == path
    of_numpy = Shutter(np.array([True])[0])
    assert of_numpy.shut is True
    assert of_numpy == Shutter(shut=True) != Shutter(shut=False)


def test_what_is_neither_yes_nor_no_is_refused_by_paths_and_files(tmp_path):
    for value in (1, 0.0, "yes", None, [True], np.array([True, False])):
        with pytest.raises(op.OptipathError, match=r"shut is .*; give True or False"):
            chain([Shutter(value)]).check()
    with pytest.raises(op.OptipathError, match="cannot be a parameter; give True or False"):
        chain([Shutter(op.Parameter("a"))]).check()
    file = tmp_path / "shutter.toml"
    file.write_text(chain([Shutter(shut=True)]).to_toml().replace("= true", "= 1"), "utf-8")
    with pytest.raises(op.OptipathError, match=r"shut: the value is 1; give true or false"):
        op.load_preset(file)
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
def test_a_pair_is_asked_about_however_it_is_given_and_written(way):
    for pair in ([1.5, 1.6], ["1.5", "1.6"], (1.5, "1.6")):
        with pytest.raises(op.OptipathError, match=r"may be n and k.*write Material\(1.5, 1.6\)"):
            WAYS[way](pair)


@rows("way", WAYS)
def test_a_list_of_media_is_that_of_their_indices(way):
    indices = np.array([1.5, 1.6 + 0.1j, 2.0])
    media = [op.Material(1.5), op.Material(1.6, 0.1), 2.0]
    np.testing.assert_array_equal(WAYS[way](media).stokes, WAYS[way](indices).stokes)


def test_a_pair_that_cannot_be_one_number_is_two_and_others_are_asked_about_once():
    for give in (lambda n: op.Interface(n, 0.3), WAYS["trace"]):
        with pytest.raises(op.OptipathError) as told:
            give([1.5, -1])
        assert len(told.value.faults) == 1
        assert "is -1.0 at 1; give an index" in str(told.value)
    # An amplitude of 0.9+0.8j would be of more light than comes.
    assert np.shape(op.Mirror((0.9, 0.8), 0.5).r_s) == (2,)
    mirror = chain([op.Mirror(op.Parameter("r"))])
    path = op.PathGraph()
    path.add("lamp", op.Source()) >> path.add("A", op.Interface(op.Parameter("n"), 0.3))
    back = path.add("B", op.Interface(1.2, op.FOLLOWS, outside=op.FOLLOWS))
    path["A.transmitted"] >> back
    path["B.transmitted"] >> path.add("eye", op.Detector())
    for trace, pair in ((mirror.trace, {"r": (0.9, 0.1)}), (path.trace, {"n": [1.5, 0]})):
        with pytest.raises(op.ParameterError) as told:
            trace(**pair)
        assert len(told.value.faults) == 1


GRID = [4e-7, 5e-7, 6e-7]
ABSORBING = op.Material.tabulated(GRID, 1.5, [1e-8, 2e-8, 3e-8], name="glass")
PARTLY = op.Material.tabulated(GRID, 1.5, [0.0, 2e-8, 3e-8], name="glass")
CONSTANT = op.Material(1.5, 1e-8)


CURE = "take the medium without its k, such as Material(glass.n)"


def front(medium):
    return op.LayerStack([medium, 1.5, 1.0], 0.3)


def way(medium):
    down = [[0, 0, 3], [0, 0, 2], [0, 0, 0]]
    return op.path_from_vertices(down, [medium], events="T")


@rows("place", [lambda medium: op.LayerStack([1.0, medium, 1.0], 0.3), front, way])
@rows("medium", [ABSORBING, CONSTANT])
def test_a_medium_that_absorbs_everywhere_is_refused_with_a_cure_that_works(place, medium):
    with pytest.raises(op.OptipathError, match=re.escape(CURE)) as refused:
        place(medium)
    assert "another wavelength" not in str(refused.value)
    assert place(op.Material(medium.n)) is not None


def test_a_medium_that_absorbs_at_some_wavelengths_is_refused_there_with_the_same_cure(tmp_path):
    path = op.Source() >> front(PARTLY) >> op.Detector()
    assert path.trace(wavelength="400 nm").intensity > 0.0
    with pytest.raises(op.ParameterError, match=r"k of glass at 500 nm is 2e-08, and") as refused:
        path.trace(wavelength="500 nm")
    assert str(refused.value).endswith(CURE)
    # A table has not the reason of the formula beside it.
    formula = "{type: formula 1, wavelength_range: 0.4 0.6, coefficients: 0 1.0 0.01}"
    table = "{type: tabulated k, data: '0.4 0\n\n 0.5 1e-8\n\n 0.6 1e-8'}"
    page = tmp_path / "page.yml"
    page.write_text(f"DATA: [{formula}, {table}]")
    path = op.Source() >> front(op.Material.from_yaml(page)) >> op.Detector()
    with pytest.raises(op.ParameterError) as refused:
        path.trace(wavelength="500 nm")
    assert "formula" not in str(refused.value)

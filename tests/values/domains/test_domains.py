"""Domains: yes or no, pairs of numbers, and media that must not absorb."""

import re

import numpy as np
import pytest

import optipath as op
from optipath.values.domains.quantities import YesOrNo
from paths import chain
from tables import rows
from wired import read, read_back, wired


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
def test_a_pair_is_asked_about_however_it_is_given_and_a_list_of_media_is_that_of_indices(way):
    for pair in (["1.5", "1.6"], (1.5, "1.6")):
        with pytest.raises(op.OptipathError, match=r"may be n and k.*write Material\(1.5, 1.6\)"):
            WAYS[way](pair)
    indices = np.array([1.5, 1.6 + 0.1j, 2.0])
    media = [op.Material(1.5), op.Material(1.6, 0.1), 2.0]
    np.testing.assert_array_equal(WAYS[way](media).stokes, WAYS[way](indices).stokes)


def test_a_pair_that_cannot_be_one_number_is_two_and_others_are_asked_about_once():
    # An amplitude of 0.9+0.8j would be of more light than comes.
    assert np.shape(op.Mirror((0.9, 0.8), 0.5).r_s) == (2,)
    faces = {"A": op.Interface(op.Parameter("n"), 0.3)}
    faces["B"] = op.Interface(1.2, op.FOLLOWS, outside=op.FOLLOWS)
    ends = {"lamp": op.Source(), "eye": op.Detector()}
    path = wired(ends | faces, "lamp -> A, A.transmitted -> B, B.transmitted -> eye")
    for give, word in (
        (lambda: op.Interface([1.5, -1], 0.3), "is -1.0 at 1; give an index"),
        (lambda: WAYS["trace"]([1.5, -1]), "is -1.0 at 1; give an index"),
        (lambda: chain([op.Mirror(op.Parameter("r"))]).trace(r=(0.9, 0.1)), "r"),
        (lambda: path.trace(n=[1.5, 0]), "n"),
    ):
        with pytest.raises(op.OptipathError, match=word) as told:
            give()
        assert len(told.value.faults) == 1


GRID = [4e-7, 5e-7, 6e-7]
ABSORBING = op.Material.tabulated(GRID, 1.5, [1e-8, 2e-8, 3e-8], name="glass")
PARTLY = op.Material.tabulated(GRID, 1.5, [0.0, 2e-8, 3e-8], name="glass")
CONSTANT = op.Material(1.5, 1e-8)
CURE = "take the medium without its k, such as Material(glass.n)"
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

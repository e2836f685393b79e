"""Two numbers that may be the parts of one, and lists of media."""

import numpy as np
import pytest

import optipath as op
from paths import chain
from tables import rows


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


def test_a_pair_that_cannot_be_one_number_is_two():
    for give in (lambda n: op.Interface(n, 0.3), WAYS["trace"]):
        with pytest.raises(op.OptipathError) as told:
            give([1.5, -1])
        assert len(told.value.faults) == 1
        assert "is -1.0 at 1; give an index" in str(told.value)
    # An amplitude of 0.9+0.8j would be of more light than comes.
    assert np.shape(op.Mirror((0.9, 0.8), 0.5).r_s) == (2,)


def test_a_pair_is_asked_about_once_and_nothing_else_is_said_of_it():
    mirror = chain([op.Mirror(op.Parameter("r"))])
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source())
    lamp >> path.add("A", op.Interface(op.Parameter("n"), 0.3))
    path.add("B", op.Interface(1.2, op.FOLLOWS, outside=op.FOLLOWS))
    path.connect("A.transmitted", "B.in")
    path.add("eye", op.Detector())
    path.connect("B.transmitted", "eye")
    for trace, pair in ((mirror.trace, {"r": (0.9, 0.1)}), (path.trace, {"n": [1.5, 0]})):
        with pytest.raises(op.ParameterError) as told:
            trace(**pair)
        assert len(told.value.faults) == 1

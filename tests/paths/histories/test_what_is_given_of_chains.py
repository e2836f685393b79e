"""Ids, lengths and events of chains as they are given, and what is wrong with them."""

import numpy as np
import pytest

import optipath as op
from chains import random_chains

POINTS = random_chains(1, 2, (3,))


@pytest.mark.parametrize(
    ("given", "messages"),
    [
        ({"ids": [[0, 1], [1, 2], [0, 0]]}, ["ids is 2 at (1, 1)", "0 .. 1"]),
        ({"ids": [[0, -1], [1, 0], [0, 0]]}, ["ids is -1 at (0, 1)"]),
        ({"ids": [[0, 0.5], [1, 0], [0, 0]]}, ["ids is 0.5 at (0, 1)"]),
        ({"ids": [[0, np.nan], [1, 0], [0, 0]]}, ["ids is nan at (0, 1)"]),
        ({"ids": "01"}, ["ids must be whole numbers, not '01'"]),
        ({"ids": 1}, ["ids must have shape (..., m)"]),
        ({"ids": [[0, 1, 0]]}, ["vertices must have shape (..., m + 2, 3), m = 3"]),
        ({"lengths": [1, 2, 3]}, ["lengths is 3 at 2", "1 .. 2"]),
        ({"lengths": [0, 2, 1]}, ["lengths is 0 at 0"]),
        ({"lengths": [1.5, 2, 1]}, ["lengths is 1.5 at 0"]),
        ({"lengths": "abc"}, ["lengths must be whole numbers"]),
        ({"events": ["RR", "RX", "R"]}, ["events: letter 2 of chain 1 is 'X'; give R for each"]),
        ({"events": ["RR", "", "R"]}, ["letter 1 of chain 1 is missing"]),
        ({"events": ["RR", "rt", "R"]}, ["letter 1 of chain 1 is 'r'"]),
        ({"events": ["RR", "RRR", "R"]}, ["events of chain 1 has 3 letters for 2 vertices"]),
        ({"events": [1, 2, 3]}, ["events is [1, 2, 3]; give R for each"]),
        ({"events": [["RR"] * 2] * 3}, ["a text for each chain, in one row"]),
        ({"events": [["R"] * 3] * 3}, ["an array of shape (..., 2) of single letters"]),
        ({"events": [["", "R"]] * 3}, ["letter 1 of chain 0 is missing"]),
        ({"events": "RRR", "lengths": [1, 2, 1]}, ["has 3 letters for 2 vertices at most"]),
        ({"bad": "maks"}, ["bad 'maks' is unknown; did you mean 'mask'?"]),
        (
            {"ids": [[0, 1]] * 2, "lengths": [1] * 4, "events": ["R"] * 5},
            ["vertices (3,), ids (2,), lengths (4,), events (5,)"],
        ),
        (
            {"lengths": [0], "events": [1], "bad": "no", "outside": -1.0},
            ["lengths is 0", "events is [1]", "bad 'no'", "outside is -1"],
        ),
    ],
)
def test_what_is_wrong_is_told_in_words(given, messages):
    with pytest.raises(op.PathError) as error:
        op.path_from_vertices(POINTS, [1.5, 1.2 + 2j], **given)
    for message in messages:
        assert message in str(error.value)


@pytest.mark.parametrize(
    ("palette", "message"),
    [
        ([1.5, op.Parameter("n")], r"materials\[1\] is given when the path runs, but ids choose"),
        ([1.5, op.Material(op.Parameter("n"))], r"materials\[1\] is given when the path runs"),
        ([1.5, np.array([1.0, 2.0])], r"materials\[1\] is an array, and ids choose from numbers"),
        ([1.5, "glass"], r"materials\[1\]: 'glass'"),
        ([1.5, -1.0], r"materials\[1\]"),
    ],
)
def test_a_palette_is_of_numbers(palette, message):
    with pytest.raises(op.PathError, match=message):
        op.path_from_vertices(POINTS, palette, ids=[[0, 1]] * 3)


def test_media_of_chains_that_differ_are_known():
    index, events = op.Parameter("n"), ["RR", "R", "RR"]
    with pytest.raises(op.PathError, match=r"materials\[1\] is given when .* but which medium"):
        op.path_from_vertices(POINTS, [1.5, index], events=events)
    with pytest.raises(op.PathError, match="outside is given when the path runs"):
        op.path_from_vertices(POINTS, [1.5, 1.5], events=events, outside=index)


def test_chains_by_angles_do_not_end_early():
    chain = op.VerticesByAngles((0.3, 0.4), (0.1,))
    with pytest.raises(op.PathError, match="one length and reflect; give the points"):
        op.path_from_vertices(chain, [1.5, 1.5], lengths=[1, 2])


def test_a_vertex_at_which_every_chain_goes_through_is_asked_about_in_a_batch_of_lengths_too():
    through = [[0.0, 0, 2], [0, 0.1, 1], [0, 0.1, 0], [0, 5, 1]]
    points = np.array([through, through])
    points[0, 3] = np.nan
    with pytest.raises(op.PathError, match="events='RR' where it is reflected"):
        op.path_from_vertices(points, [1.5, 1.5], lengths=[1, 2])
    op.path_from_vertices(points, [1.5, 1.5], lengths=[1, 2], events="RR")


def test_ids_and_lengths_may_be_whole_numbers_of_any_type():
    expected = op.path_from_vertices(POINTS, [1.5, 1.2], ids=[[0, 1]] * 3, lengths=[1, 2, 2])
    for kind in (np.uint8, np.int32, np.float64):
        ids, lengths = np.array([[0, 1]] * 3, kind), np.array([1, 2, 2], kind)
        assert op.path_from_vertices(POINTS, [1.5, 1.2], ids=ids, lengths=lengths) == expected

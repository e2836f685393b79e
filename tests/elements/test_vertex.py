import numpy as np
import pytest

import optipath as op
from tables import rows

DOWN = [[0.0, 0, 3], [0, 0, 2], [0, 0, 1], [0, 0, 0]]
BEND = [[0.0, 0, 1], [0, 0, 0], [0, 1, -2]]
CORNER = [[0.0, 0, 3], [0, 0, 0], [0, 4, 0]]


@rows("method", ["stable", "compensated", "amplitude", "textbook"])
@rows("index", [1.5, 0.2 + 3.4j])
def test_it_reflects_as_a_specular_vertex_does(method, index):
    found = op.Vertex(index, CORNER, 1, events=[0]).mueller(method=method)
    expected = op.SpecularVertex(index, CORNER, 1).mueller(method=method)
    np.testing.assert_allclose(found.matrix, expected.matrix, rtol=0, atol=1e-15)
    assert found.frame_out == expected.frame_out


@rows("method", ["stable", "compensated", "amplitude", "textbook"])
@rows("front, behind", [(1.0, 1.5), (1.5, 1.0)])
def test_it_refracts_as_a_refracting_vertex_does(method, front, behind):
    found = op.Vertex(behind, BEND, 1, front, events=[1]).mueller(method=method)
    expected = op.RefractingVertex(behind, BEND, 1, front).mueller(method=method)
    np.testing.assert_allclose(found.matrix, expected.matrix, rtol=0, atol=4e-15)
    assert found.frame_out == expected.frame_out


def test_behind_the_end_of_a_chain_light_is_exactly_as_it_was():
    points = np.array([*BEND, [np.nan] * 3, [np.inf] * 3])
    ended = op.Vertex(0.2 + 3j, points, 2, 1.5, events=[1, 2, 2])
    np.testing.assert_array_equal(ended.mueller().matrix, np.eye(4))
    before = op.RefractingVertex(1.5, BEND, 1)
    assert ended.mueller().frame_out == before.mueller().frame_out


def test_a_chain_that_cannot_be_has_no_matrix():
    masked = op.Vertex(1.5, CORNER, 1, events=[3], bad="mask")
    path = op.PathGraph()
    node = path.add("light", op.Source()) >> path.add("vertex", masked)
    node >> path.add("eye", op.Detector())
    assert np.all(np.isnan(path.trace().stokes))
    with pytest.raises(op.ValueFault, match="there is no such chain, says the event at 'Vertex'"):
        op.Vertex(1.5, CORNER, 1, events=[3])


@rows(
    "given, message",
    [
        ({"events": [0.5]}, "events is 0.5"),
        ({"events": [4]}, "events is 4"),
        ({"events": [-1]}, "events is -1"),
        ({"events": [0, 0]}, r"vertices must have shape \(..., 4, 3\)"),
        ({"events": 0}, r"events must have shape \(..., 1\), not \(\)"),
        ({"events": "R"}, "events"),
        ({"events": op.Parameter("e")}, "events cannot be a parameter"),
        ({"events": [1], "index": 0.2 + 3j}, "into a medium that absorbs, k = 3"),
        ({"events": [1]}, "light is turned by 90 deg at 'Vertex'"),
        ({"events": [0], "bad": "no"}, "bad is 'no'"),
        ({"events": [0], "place": 2}, "place must be a whole number of 1 .. 1"),
        ({"events": [1], "vertices": op.VerticesByAngles((0.3,))}, "are angles, which say"),
    ],
)
def test_what_is_wrong_is_told_in_words(given, message):
    with pytest.raises(op.ValueFault, match=message):
        op.Vertex(**{"index": 1.5, "vertices": CORNER, "place": 1, **given})


def test_media_of_two_vertices_agree_for_each_chain():
    events = [[1.0, 0.0], [0.0, 0.0]]
    points = [DOWN, DOWN]
    path = op.PathGraph()
    first = path.add("first", op.Vertex(1.5, points, 1, events=events))
    path.add("light", op.Source()) >> first
    second = op.Vertex(1.2, points, 2, outside=[1.5, 1.5], events=events)
    first >> path.add("second", second) >> path.add("eye", op.Detector())
    with pytest.raises(
        op.PathError, match=r"'second.in' is lit from n = 1 .* \(at 1, of 2 paths\)"
    ):
        path.check()

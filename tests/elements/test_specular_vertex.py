import numpy as np
import pytest

import optipath as op
from tables import rows

CORNER = [[0.0, 0.0, 3.0], [0.0, 0.0, 0.0], [0.0, 4.0, 0.0]]
TWICE = [*CORNER, [2.0, 4.0, 0.0]]


def path_of(*nodes, links=True):
    path, before = op.PathGraph(), None
    for name, element in nodes:
        node = path.add(name, element)
        if before is not None and links:
            before >> node
        before = node
    return path


def test_a_vertex_reflects_as_an_interface_at_its_angle_does():
    vertex = op.SpecularVertex(0.608 + 2.12j, CORNER, place=1)
    matrix = vertex.mueller()
    expected = op.Interface(0.608 + 2.12j, np.pi / 4).mueller()
    np.testing.assert_allclose(matrix.matrix, expected.matrix, rtol=0, atol=1e-15)
    np.testing.assert_array_equal(matrix.frame_in.z, [0, 0, -1])
    np.testing.assert_array_equal(matrix.frame_out.z, [0, 1, 0])


def test_the_medium_that_light_comes_from_may_be_another():
    vertex = op.SpecularVertex(1.0, CORNER, place=1, outside=1.5)
    expected = op.Interface(1.0, np.pi / 4, outside=1.5).mueller()
    np.testing.assert_allclose(vertex.mueller().matrix, expected.matrix, rtol=0, atol=1e-15)


@rows("method", ["stable", "compensated", "amplitude", "textbook"])
def test_every_method_is_there_for_vertices(method):
    vertex = op.SpecularVertex(0.608 + 2.12j, CORNER, place=1)
    expected = op.Interface(0.608 + 2.12j, np.pi / 4).mueller(method=method)
    np.testing.assert_allclose(
        vertex.mueller(method=method).matrix, expected.matrix, rtol=0, atol=1e-14
    )


def test_a_polarizer_before_a_vertex_stands_in_its_frame_of_incidence():
    path = path_of(
        ("lamp", op.Source()),
        ("filter", op.Polarizer(angle=0.3)),
        ("vertex", op.SpecularVertex(1.5, CORNER, place=1)),
        ("eye", op.Detector()),
    )
    expected = path_of(
        ("lamp", op.Source()),
        ("filter", op.Polarizer(angle=0.3)),
        ("glass", op.Interface(1.5, np.pi / 4)),
        ("eye", op.Detector()),
    )
    np.testing.assert_allclose(path.trace().stokes, expected.trace().stokes, rtol=1e-15, atol=1e-16)
    np.testing.assert_array_equal(path.mueller().frame_in.x, [-1, 0, 0])


def test_light_behind_an_analyzer_is_told_in_the_frame_of_the_vertex_before_it():
    vertex = op.SpecularVertex(1.5, CORNER, place=1)
    nodes = [("lamp", op.Source()), ("vertex", vertex)]
    straight = path_of(*nodes, ("analyzer", op.Polarizer(0.2)), ("eye", op.Detector()))
    np.testing.assert_array_equal(straight.trace().frame.z, [0, 1, 0])


TURNS = [0.4, np.array([0.1, -0.4, 2.0]), op.Parameter("turn", 0.4), -op.Parameter("turn", 0.4)]


def angle_of(turn):
    if isinstance(turn, op.Parameter):
        return turn.placed(turn.default)
    return turn


def behind_a_vertex(*between, azimuth=None):
    """A path in which light meets a vertex and then, maybe, other elements."""
    vertex = op.SpecularVertex(1.5, CORNER, place=1)
    path = path_of(("lamp", op.Source()), ("vertex", vertex), *between)
    last = f"{between[-1][0]}.{between[-1][1].outputs[-1]}" if between else "vertex.reflected"
    path.add("eye", op.Detector())
    path.connect(last, "eye.in", azimuth=azimuth)
    return path, vertex.own_frame("reflected").frame({})


@rows("turn", TURNS)
def test_a_turned_link_behind_a_vertex_turns_the_frame_of_the_light(turn):
    path, own = behind_a_vertex(azimuth=turn)
    light = path.trace()
    expected = own.turned(angle_of(turn))
    for axis in "xyz":
        found = getattr(light.frame, axis)
        np.testing.assert_allclose(found, np.broadcast_to(getattr(expected, axis), found.shape))
    plain = behind_a_vertex()[0].trace().stokes
    np.testing.assert_allclose(light.in_frame(own).stokes - plain, 0.0, rtol=1e-15, atol=1e-16)


@rows("turn", TURNS)
def test_a_turned_element_behind_a_vertex_turns_the_frame_of_the_light(turn):
    path, own = behind_a_vertex(("analyzer", op.Polarizer(azimuth=turn)))
    assert path.trace().frame.x.shape == (*np.shape(angle_of(turn)), 3)
    np.testing.assert_allclose(
        path.trace().frame.x, own.turned(angle_of(turn)).x, rtol=0, atol=1e-15
    )
    twice, own = behind_a_vertex(("analyzer", op.Polarizer(azimuth=turn)), azimuth=0.3)
    expected = own.turned(angle_of(turn) + 0.3)
    np.testing.assert_allclose(twice.trace().frame.x, expected.x, rtol=0, atol=1e-15)


def test_the_turn_of_a_frame_is_the_one_that_a_run_was_given():
    path, own = behind_a_vertex(azimuth=op.Parameter("turn"))
    several = np.linspace(-1.0, 1.0, 5)
    np.testing.assert_allclose(
        path.trace(turn=several).frame.x, own.turned(several).x, rtol=0, atol=1e-15
    )
    plan = path.compose()
    for where, light in plan.stream(2, turn=several):
        np.testing.assert_allclose(light.frame.x, own.turned(several[where]).x, rtol=0, atol=1e-15)
    bound = path.bind(turn=0.7).trace()
    np.testing.assert_allclose(bound.frame.x, own.turned(0.7).x, rtol=0, atol=1e-15)


def test_light_straight_through_a_beam_splitter_keeps_the_frame_of_the_vertex():
    splitter = ("splitter", op.BeamSplitter(azimuth=0.2))
    path, own = behind_a_vertex(splitter, azimuth=0.3)
    np.testing.assert_allclose(path.trace().frame.x, own.turned(0.5).x, rtol=0, atol=1e-15)
    path.add("side", op.Detector())
    path.connect("splitter.reflected", "side.in")
    lights = path.compose().run_all()
    np.testing.assert_allclose(lights["eye"].frame.x, own.turned(0.5).x, rtol=0, atol=1e-15)
    assert lights["side"].frame == op.Frame(), "where it goes is not known"


def test_light_that_may_come_from_behind_a_beam_splitter_has_no_frame_of_a_vertex():
    path, _ = behind_a_vertex(("splitter", op.BeamSplitter()))
    path.add("other", op.Source())
    path.connect("other.out", "splitter.back")
    assert path.trace().frame == op.Frame()


@rows("turn", TURNS[::2])
def test_light_before_a_vertex_is_told_in_the_frame_that_its_turns_lead_from(turn):
    vertex = op.SpecularVertex(1.5, CORNER, place=1)
    path = path_of(
        ("lamp", op.Source()),
        ("filter", op.Polarizer(0.1, azimuth=turn)),
        ("splitter", op.BeamSplitter(azimuth=0.2)),
        links=False,
    )
    path["lamp"] >> path["filter"] >> path["splitter"]
    path.add("vertex", vertex) >> path.add("eye", op.Detector())
    path.connect("splitter.transmitted", "vertex.in", azimuth=0.3)
    frame = (path.bind(turn=0.4) if path.parameters else path).mueller().frame_in
    own = vertex.own_frame("in").frame({})
    np.testing.assert_allclose(frame.turned(angle_of(turn) + 0.5).x, own.x, rtol=0, atol=1e-15)


def test_light_that_is_kept_on_its_way_has_the_frame_of_the_vertex():
    path, own = behind_a_vertex(("analyzer", op.Polarizer(azimuth=0.4)))
    lights = path.trace(keep="all")
    np.testing.assert_allclose(
        lights["analyzer.out -> eye.in"].frame.x, own.turned(0.4).x, rtol=0, atol=1e-15
    )
    arriving = op.SpecularVertex(1.5, CORNER, place=1).own_frame("in").frame({})
    np.testing.assert_array_equal(lights["lamp.out -> vertex.in"].frame.x, arriving.x)


def test_light_of_two_vertices_is_the_same_whichever_way_they_are_added():
    first, second = (op.SpecularVertex(1.5, TWICE, place) for place in (1, 2))
    path = op.PathGraph()
    for name, element in (("b", second), ("a", first), ("lamp", op.Source()), ("e", op.Detector())):
        path.add(name, element)
    path["lamp"] >> path["a"] >> path["b"] >> path["e"]
    expected = op.path_from_vertices(TWICE, [1.5, 1.5]).trace()
    assert path.trace() == expected


@rows(
    "chain, place, others, message",
    [
        (CORNER, 2, {}, r"^SpecularVertex.place must be .* of 1 .. 1, not 2"),
        (CORNER, 0, {}, r"place must be .* not 0"),
        (CORNER, 1.5, {}, r"place must be .* not 1.5"),
        (CORNER, 1, {"reflections": -1}, r"reflections must be .* not -1"),
        (CORNER, 1, {"reflections": 2}, r"vertices must have shape \(..., 4, 3\), not \(3, 3\)"),
        (op.Parameter("v"), 1, {}, r"tell the number of reflections"),
        ([1.0, 2.0], 1, {}, r"shape \(..., 3, 3\), not \(2,\)"),
        ([[0, 0, 0], [1, 1]], 1, {}, "rows of unequal lengths"),
        ([[1j, 0, 0], [0, 1, 0], [0, 0, 1]], 1, {}, "is complex"),
    ],
)
def test_a_vertex_that_is_not_in_its_chain_is_refused(chain, place, others, message):
    with pytest.raises(op.ValueFault, match=message):
        op.SpecularVertex(1.5, chain, place, **others)


@rows("place", [1, 1.0, np.float64(1.0), "1"])
def test_a_place_is_a_whole_number_however_it_is_given(place):
    vertex = op.SpecularVertex(1.5, CORNER, place)
    assert vertex.place == 1
    assert type(vertex.place) is int


def test_a_vertex_takes_no_frames_but_its_own():
    path = op.PathGraph()
    vertex = op.SpecularVertex(1.5, CORNER, place=1)
    lamp, eye = path.add("lamp", op.Source()), path.add("eye", op.Detector())
    lamp >> path.add("vertex", vertex, {"in": op.Frame()}) >> eye
    with pytest.raises(op.PathError, match="'vertex' has its frames from its vertices"):
        path.check()


def test_vertices_that_do_not_follow_each_other_are_refused():
    first, other = op.SpecularVertex(1.5, TWICE, 1), op.SpecularVertex(1.5, TWICE[::-1], 2)
    for second in (first, other):
        path = path_of(("lamp", op.Source()), ("a", first), ("b", second), ("eye", op.Detector()))
        with pytest.raises(op.PathError, match="must lead from a vertex to the next of one chain"):
            path.check()


def test_what_stands_relatively_between_two_vertices_is_refused():
    path = path_of(
        ("lamp", op.Source()),
        ("a", op.SpecularVertex(1.5, TWICE, 1)),
        ("filter", op.Polarizer()),
        ("b", op.SpecularVertex(1.5, TWICE, 2)),
        ("eye", op.Detector()),
    )
    with pytest.raises(op.PathError, match=r"'filter' stands relatively between .* 'a' and 'b'"):
        path.check()


def test_world_frames_beside_a_vertex_are_refused():
    path = path_of(("vertex", op.SpecularVertex(1.5, CORNER, 1)), ("eye", op.Detector()))
    path.add("lamp", op.Source(), {"out": op.Frame()}) >> path["vertex"]
    with pytest.raises(op.PathError, match="'lamp' has world frames of its own"):
        path.check()


def test_an_azimuth_between_vertices_is_refused():
    path = path_of(("lamp", op.Source()), ("a", op.SpecularVertex(1.5, TWICE, 1)), links=False)
    path.add("b", op.SpecularVertex(1.5, TWICE, 2)) >> path.add("eye", op.Detector())
    path["lamp"] >> path["a"]
    path.connect("a.reflected", "b.in", azimuth=0.1)
    with pytest.raises(op.PathError, match="by its vertices and by an azimuth"):
        path.check()


def test_lights_of_several_vertices_do_not_meet():
    path = path_of(("lamp", op.Source()), ("a", op.SpecularVertex(1.5, CORNER, 1)))
    path["lamp"] >> path.add("b", op.SpecularVertex(1.5, CORNER, 1))
    eye = path.add("eye", op.Detector())
    path["a"] >> eye
    path["b"] >> eye
    with pytest.raises(op.PathError, match="several lights meet at 'eye' in frames of vertices"):
        path.check()

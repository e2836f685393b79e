"""Vertices of chains that reflect, refract, or do what an event says."""

import numpy as np
import pytest

import optipath as op
from optipath.elements.vertices.event_fits import EventFits
from optipath.elements.vertices.vertex_domain import legs_fit
from optipath.kernels.catalogue import EVENT_AT_VERTEX
from optipath.kernels.geometry.events import Event
from optipath.kernels.numbers.primitives import NUMPY
from optipath.values.domains.indices import LIT_INDEX, OUTSIDE
from optipath.values.domains.wavelengths import WAVELENGTH
from tables import rows

CORNER = [[0.0, 0.0, 3.0], [0.0, 0.0, 0.0], [0.0, 4.0, 0.0]]

TWICE = [*CORNER, [2.0, 4.0, 0.0]]
INTO_GLASS = [[0.0, -1.0, 1.0], [0.0, 0.0, 0.0], [0.0, 1.0, -np.sqrt(3.5)]]  # 45 degrees, 1.5
MIXED = [*INTO_GLASS, [0.0, 2.0, -np.sqrt(3.5) + 1.0]]
TURNED = [[0.0, 0.0, 1.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0]]


def path_of(*nodes, links=True):
    path, before = op.PathGraph(), None
    for name, element in nodes:
        node = path.add(name, element)
        if before is not None and links:
            before >> node
        before = node
    return path


@rows("index, outside", [(0.608 + 2.12j, 1.0), (1.0, 1.5)])
def test_a_vertex_reflects_as_an_interface_at_its_angle_does(index, outside):
    matrix = op.SpecularVertex(index, CORNER, place=1, outside=outside).mueller()
    expected = op.Interface(index, np.pi / 4, outside).mueller()
    np.testing.assert_allclose(matrix.matrix, expected.matrix, rtol=0, atol=1e-15)
    np.testing.assert_array_equal(matrix.frame_in.z, [0, 0, -1])
    np.testing.assert_array_equal(matrix.frame_out.z, [0, 1, 0])


@rows("method", ["stable", "compensated", "amplitude", "textbook"])
def test_every_method_is_there_for_vertices(method):
    vertex = op.SpecularVertex(0.608 + 2.12j, CORNER, place=1)
    expected = op.Interface(0.608 + 2.12j, np.pi / 4).mueller(method=method)
    np.testing.assert_allclose(
        vertex.mueller(method=method).matrix, expected.matrix, rtol=0, atol=1e-14
    )


def test_light_behind_filters_is_told_in_the_frame_of_the_vertex():
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
    vertex = op.SpecularVertex(1.5, CORNER, place=1)
    nodes = [("lamp", op.Source()), ("vertex", vertex)]
    straight = path_of(*nodes, ("analyzer", op.Polarizer(0.2)), ("eye", op.Detector()))
    np.testing.assert_array_equal(straight.trace().frame.z, [0, 1, 0])
    path, own = behind_a_vertex(("analyzer", op.Polarizer(azimuth=0.4)))
    lights = path.trace(keep="all")
    np.testing.assert_allclose(
        lights["analyzer.out -> eye.in"].frame.x, own.turned(0.4).x, rtol=0, atol=1e-15
    )
    arriving = op.SpecularVertex(1.5, CORNER, place=1).own_frame("in").frame({})
    np.testing.assert_array_equal(lights["lamp.out -> vertex.in"].frame.x, arriving.x)


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


def test_light_keeps_the_frame_of_the_vertex_through_a_splitter_unless_it_may_come_from_behind():
    splitter = ("splitter", op.BeamSplitter(azimuth=0.2))
    path, own = behind_a_vertex(splitter, azimuth=0.3)
    np.testing.assert_allclose(path.trace().frame.x, own.turned(0.5).x, rtol=0, atol=1e-15)
    path.add("side", op.Detector())
    path.connect("splitter.reflected", "side.in")
    lights = path.compose().run_all()
    np.testing.assert_allclose(lights["eye"].frame.x, own.turned(0.5).x, rtol=0, atol=1e-15)
    assert lights["side"].frame == op.Frame(), "where it goes is not known"
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


@rows(
    "framed, frames, sentence",
    [
        ("vertex", {"in": op.Frame()}, "'vertex' has its frames from its vertices"),
        ("lamp", {"out": op.Frame()}, "'lamp' has world frames of its own"),
    ],
)
def test_a_vertex_takes_no_frames_but_its_own(framed, frames, sentence):
    path = op.PathGraph()
    elements = op.Source(), op.SpecularVertex(1.5, CORNER, 1), op.Detector()
    for name, element in zip(("lamp", "vertex", "eye"), elements, strict=True):
        path.add(name, element, frames if name == framed else None)
    path["lamp"] >> path["vertex"] >> path["eye"]
    with pytest.raises(op.PathError, match=sentence):
        path.check()


FIRST, SECOND = (op.SpecularVertex(1.5, TWICE, place) for place in (1, 2))
INTO = op.RefractingVertex(1.5, MIXED, 1)
NO_NEXT = "must lead from a vertex to the next of one chain"


@rows(
    "elements, sentence",
    [
        ((FIRST, FIRST), NO_NEXT),
        ((FIRST, op.SpecularVertex(1.5, TWICE[::-1], 2)), NO_NEXT),
        ((INTO, op.SpecularVertex(2.0, TURNED, 1, 1.5)), NO_NEXT),
        ((FIRST, op.Polarizer(), SECOND), "'b' stands relatively between .* 'a' and 'c'"),
        (
            (INTO, op.SpecularVertex(0.2 + 3.4j, MIXED, 2)),
            r"lit from n = 1.5 behind 'a'.*outside is 1; give",
        ),
    ],
)
def test_vertices_that_do_not_follow_each_other_are_refused(elements, sentence):
    path = path_of(
        ("lamp", op.Source()), *zip("abc", elements, strict=False), ("eye", op.Detector())
    )
    with pytest.raises(op.PathError, match=sentence):
        path.check()


def test_what_cannot_stand_between_vertices_is_refused():
    path = path_of(("lamp", op.Source()), ("a", op.SpecularVertex(1.5, TWICE, 1)), links=False)
    path.add("b", op.SpecularVertex(1.5, TWICE, 2)) >> path.add("eye", op.Detector())
    path["lamp"] >> path["a"]
    path.connect("a.reflected", "b.in", azimuth=0.1)
    with pytest.raises(op.PathError, match="by its vertices and by an azimuth"):
        path.check()
    path = path_of(("lamp", op.Source()), ("a", op.SpecularVertex(1.5, CORNER, 1)))
    path["lamp"] >> path.add("b", op.SpecularVertex(1.5, CORNER, 1))
    eye = path.add("eye", op.Detector())
    path["a"] >> eye
    path["b"] >> eye
    with pytest.raises(op.PathError, match="several lights meet at 'eye' in frames of vertices"):
        path.check()
    path = op.path_from_vertices(INTO_GLASS, [op.Parameter("n")], events="T")
    with pytest.raises(op.ParameterError, match="light goes on in"):
        path.trace(n=1.5 + 0.1j)
    masked = op.Vertex(1.5, CORNER, 1, events=[3], bad="mask")
    path = op.PathGraph()
    node = path.add("light", op.Source()) >> path.add("vertex", masked)
    node >> path.add("eye", op.Detector())
    assert np.all(np.isnan(path.trace().stokes))
    with pytest.raises(op.ValueFault, match="there is no such chain, says the event at 'Vertex'"):
        op.Vertex(1.5, CORNER, 1, events=[3])


@rows("method", ["stable", "compensated", "amplitude", "textbook"])
def test_a_vertex_lets_through_what_an_interface_at_its_angle_does(method):
    matrix = op.RefractingVertex(1.5, INTO_GLASS, place=1).mueller(method=method)
    expected = op.Interface(1.5, np.pi / 4).mueller("in", "transmitted", method=method)
    np.testing.assert_allclose(matrix.matrix, expected.matrix, rtol=0, atol=1e-15)
    np.testing.assert_allclose(matrix.frame_in.z, [0, np.sqrt(0.5), -np.sqrt(0.5)], rtol=1e-15)
    np.testing.assert_array_equal(matrix.frame_out.x, [1, 0, 0])


@rows("method", ["stable", "compensated", "amplitude", "textbook"])
def test_light_out_of_glass_is_that_into_it(method):
    back = op.RefractingVertex(1.0, INTO_GLASS[::-1], place=1, outside=1.5)
    angle = np.arcsin(np.sin(np.pi / 4) / 1.5)
    expected = op.Interface(1.0, angle, outside=1.5).mueller("in", "transmitted", method=method)
    np.testing.assert_allclose(
        back.mueller(method=method).matrix, expected.matrix, rtol=0, atol=1e-14
    )


def test_a_refraction_may_follow_a_reflection_and_go_before_one():
    path = path_of(
        ("lamp", op.Source()),
        ("filter", op.Polarizer(0.3)),
        ("top", op.RefractingVertex(op.Material(1.5), MIXED, 1)),
        ("bottom", op.SpecularVertex(0.2 + 3.4j, MIXED, 2, outside=op.FOLLOWS)),
        ("eye", op.Detector()),
    )
    light = path.trace()
    chain = op.path_from_vertices(MIXED, [1.5, 0.2 + 3.4j], events="TR")
    polarized = op.Polarizer(0.3).mueller().matrix[:, 0]
    np.testing.assert_allclose(light.stokes, chain.mueller().matrix @ polarized, rtol=1e-14)
    assert light.frame == chain.trace().frame


@rows(
    "arguments, others, message",
    [
        ((1.5, TURNED, 1), {}, "by 90 deg at 'RefractingVertex', but .* turns it by 48.1896851"),
        ((1.5, INTO_GLASS, 2), {}, "place must be a whole number of 1 .. 1, not 2"),
        ((1.5, INTO_GLASS, 1), {"count": 0}, "count must be a whole number above 0, not 0"),
        ((1.5, op.Parameter("p"), 1), {}, "tell the number of vertices of the chain, count=..."),
        ((1.5 + 1j, INTO_GLASS, 1), {}, "index is complex; give a real index .* light goes on in"),
        (
            (op.Material(1.5, 1), INTO_GLASS, 1),
            {},
            "index.k is 1; give 0, since light goes on in there",
        ),
        ((1.5, op.VerticesByAngles((0.3,)), 1), {}, "are angles, which say reflections alone"),
    ],
)
def test_what_is_no_such_vertex_is_refused(arguments, others, message):
    with pytest.raises(op.ValueFault, match=message) as error:
        op.RefractingVertex(*arguments, **others)
    assert len(error.value.faults) == 1


def test_a_chain_that_refracts_is_explained_and_drawn():
    path = op.path_from_vertices(INTO_GLASS, [1.5], events="T")
    assert "Fresnel transmission (stable, lossless)" in path.compose().explain()
    assert "RefractingVertex" in str(path) or "refracting-vertex" in path.to_toml()


DOWN = [[0.0, 0, 3], [0, 0, 2], [0, 0, 1], [0, 0, 0]]

BEND = [[0.0, 0, 1], [0, 0, 0], [0, 1, -2]]


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


def test_light_can_go_so_where_the_kernel_has_an_angle_or_the_chain_has_ended():
    rng = np.random.default_rng(1)
    count = 4000
    event = rng.integers(0, 4, count).astype(float)
    n1, n2 = rng.choice([1.0, 1.2, 1.5, 2.4], (2, count))
    k = rng.choice([0.0, 0.0, 0.0, 1.0], count)
    scale = 10.0 ** rng.choice([-80, -70, -69.9, 0, 0, 0, 69.9, 70, 80], count)
    start, leg, turn = rng.normal(size=(3, 3, count)) * scale
    here = start + leg
    points = np.concatenate([start, here, here + leg + rng.uniform(0, 1, count) * turn])
    points[rng.integers(0, 9, 50), rng.integers(0, count, 50)] = np.nan
    given = event, n1, n2, k
    with np.errstate(all="ignore"):
        found = EventFits((), "vertex1").fits(np, *given, *points)
        cos = EVENT_AT_VERTEX.made_for(NUMPY)(n1, n2, k, event, *points)[2]
    np.testing.assert_array_equal(found, ~np.isnan(cos) | (event == Event.BEHIND))
    assert 0.3 < np.mean(found) < 0.9


@pytest.mark.filterwarnings("error")
def test_numbers_of_single_precision_are_checked_without_a_word():
    jax = pytest.importorskip("jax")
    points = np.array([[0, 0, 0], [0, 0, 0], [0, 0, 1]], np.float32)
    assert jax.jit(legs_fit)(points).tolist() == [False, True]
    for domain in (WAVELENGTH, OUTSIDE, LIT_INDEX):
        for number, allowed in ((0.0, False), (0.5, True)):
            assert bool(jax.jit(domain.allows)(np.float32(number))) is allowed

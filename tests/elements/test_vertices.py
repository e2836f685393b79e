"""Vertices of chains that reflect, refract, or do what an event says."""

import numpy as np
import pytest

import optipath as op
from optipath.elements.vertex_chain import legs_fit
from optipath.elements.vertex_place import EventFits
from optipath.kernels.catalog import EVENT_AT_VERTEX
from optipath.kernels.primitives import NUMPY
from optipath.kernels.vertex_chain import Event
from optipath.materials.index_domains import LIT_INDEX, OUTSIDE
from optipath.values.wavelength import WAVELENGTH
from paths import chain
from tables import rows
from wired import wired

CORNER = [[0.0, 0.0, 3.0], [0.0, 0.0, 0.0], [0.0, 4.0, 0.0]]
TWICE = [*CORNER, [2.0, 4.0, 0.0]]
INTO_GLASS = [[0.0, -1.0, 1.0], [0.0, 0.0, 0.0], [0.0, 1.0, -np.sqrt(3.5)]]  # 45 degrees, 1.5
MIXED = [*INTO_GLASS, [0.0, 2.0, -np.sqrt(3.5) + 1.0]]
TURNED = [[0.0, 0.0, 1.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
DOWN = [[0.0, 0, 3], [0, 0, 2], [0, 0, 1], [0, 0, 0]]
BEND = [[0.0, 0, 1], [0, 0, 0], [0, 1, -2]]
GLASS, LAMP, EYE = op.SpecularVertex(1.5, CORNER, 1), op.Source(), op.Detector()
METAL = 0.608 + 2.12j
INSIDE = np.arcsin(np.sqrt(0.5) / 1.5)


@rows("method", ["stable", "compensated", "amplitude", "textbook"])
@rows(
    "vertex, interface, atol",
    [
        (op.SpecularVertex(METAL, CORNER, 1), op.Interface(METAL, np.pi / 4), 1e-15),
        (op.SpecularVertex(1.0, CORNER, 1, 1.5), op.Interface(1.0, np.pi / 4, 1.5), 1e-15),
        (op.RefractingVertex(1.5, INTO_GLASS, 1), op.Interface(1.5, np.pi / 4), 1e-15),
        (op.RefractingVertex(1.0, INTO_GLASS[::-1], 1, 1.5), op.Interface(1.0, INSIDE, 1.5), 1e-14),
    ],
)
def test_a_vertex_does_what_an_interface_at_its_angle_does(vertex, interface, atol, method):
    found = vertex.mueller(method=method).matrix
    expected = interface.mueller("in", vertex.natural, method=method).matrix
    atol = 1e-14 if vertex.natural == "reflected" and method != "stable" else atol
    np.testing.assert_allclose(found, expected, rtol=0, atol=atol)


@rows("method", ["stable", "compensated", "amplitude", "textbook"])
@rows(
    "vertex, other",
    [
        (op.Vertex(1.5, CORNER, 1, events=[0]), GLASS),
        (op.Vertex(0.2 + 3.4j, CORNER, 1, events=[0]), op.SpecularVertex(0.2 + 3.4j, CORNER, 1)),
        (op.Vertex(1.5, BEND, 1, events=[1]), op.RefractingVertex(1.5, BEND, 1)),
        (op.Vertex(1.0, BEND, 1, 1.5, events=[1]), op.RefractingVertex(1.0, BEND, 1, 1.5)),
    ],
)
def test_a_vertex_of_an_event_is_the_one_that_does_just_that(vertex, other, method):
    found, expected = (one.mueller(method=method) for one in (vertex, other))
    atol = 1e-15 if other.natural == "reflected" else 4e-15
    np.testing.assert_allclose(found.matrix, expected.matrix, rtol=0, atol=atol)
    assert found.frame_out == expected.frame_out


def test_light_is_told_in_the_frame_of_the_vertex_before_and_behind_filters():
    matrix = GLASS.mueller()
    np.testing.assert_array_equal([matrix.frame_in.z, matrix.frame_out.z], [[0, 0, -1], [0, 1, 0]])
    matrix = op.RefractingVertex(1.5, INTO_GLASS, place=1).mueller()
    np.testing.assert_allclose(matrix.frame_in.z, [0, np.sqrt(0.5), -np.sqrt(0.5)], rtol=1e-15)
    np.testing.assert_array_equal(matrix.frame_out.x, [1, 0, 0])
    path = chain([op.Polarizer(0.3), GLASS])
    expected = chain([op.Polarizer(0.3), op.Interface(1.5, np.pi / 4)]).trace().stokes
    np.testing.assert_allclose(path.trace().stokes, expected, rtol=1e-15, atol=1e-16)
    np.testing.assert_array_equal(path.mueller().frame_in.x, [-1, 0, 0])
    straight = chain([GLASS, op.Polarizer(0.2)])
    np.testing.assert_array_equal(straight.trace().frame.z, [0, 1, 0])
    lights = chain([GLASS, op.Polarizer(azimuth=0.4)]).trace(keep="all")
    found, expected = lights["e1.out -> eye.in"].frame, OWN.turned(0.4)
    np.testing.assert_allclose(found.x, expected.x, rtol=0, atol=1e-15)
    arriving = GLASS.own_frame("in").frame({})
    np.testing.assert_array_equal(lights["lamp.out -> e0.in"].frame.x, arriving.x)


OWN = GLASS.own_frame("reflected").frame({})
TURNS = [0.4, np.array([0.1, -0.4, 2.0]), op.Parameter("turn", 0.4), -op.Parameter("turn", 0.4)]


def angle_of(turn):
    return turn.placed(turn.default) if isinstance(turn, op.Parameter) else turn


def behind_a_vertex(between=None, azimuth=None):
    """A path in which light meets a vertex and then, maybe, another element."""
    nodes = {"lamp": LAMP, "vertex": GLASS, "eye": EYE} | ({"more": between} if between else {})
    path = wired(nodes, "lamp -> vertex, vertex -> more" if between else "lamp -> vertex")
    last = f"more.{between.outputs[-1]}" if between else "vertex"
    path.connect(last, "eye.in", azimuth=azimuth)
    return path


@rows("turn", TURNS)
def test_a_turned_link_or_element_behind_a_vertex_turns_the_frame_of_the_light(turn):
    light, expected = behind_a_vertex(azimuth=turn).trace(), OWN.turned(angle_of(turn))
    for axis in "xyz":
        found = getattr(light.frame, axis)
        np.testing.assert_allclose(found, np.broadcast_to(getattr(expected, axis), found.shape))
    plain = behind_a_vertex().trace().stokes
    np.testing.assert_allclose(light.in_frame(OWN).stokes - plain, 0.0, rtol=1e-15, atol=1e-16)
    for more in (0.0, 0.3):
        found = behind_a_vertex(op.Polarizer(azimuth=turn), more or None).trace().frame.x
        assert found.shape == (*np.shape(angle_of(turn)), 3)
        expected = OWN.turned(angle_of(turn) + more).x
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-15)


def test_the_turn_of_a_frame_is_the_one_that_a_run_was_given():
    path, several = behind_a_vertex(azimuth=op.Parameter("turn")), np.linspace(-1.0, 1.0, 5)
    for turn, light in (
        (several, path.trace(turn=several)),
        *((several[where], light) for where, light in path.compose().stream(2, turn=several)),
        (0.7, path.bind(turn=0.7).trace()),
    ):
        np.testing.assert_allclose(light.frame.x, OWN.turned(turn).x, rtol=0, atol=1e-15)


def test_light_keeps_the_frame_of_the_vertex_through_a_splitter_unless_it_may_come_from_behind():
    path = behind_a_vertex(op.BeamSplitter(azimuth=0.2), azimuth=0.3)
    np.testing.assert_allclose(path.trace().frame.x, OWN.turned(0.5).x, rtol=0, atol=1e-15)
    path.add("side", op.Detector())
    path.connect("more.reflected", "side.in")
    lights = path.compose().run_all()
    np.testing.assert_allclose(lights["eye"].frame.x, OWN.turned(0.5).x, rtol=0, atol=1e-15)
    assert lights["side"].frame == op.Frame(), "where it goes is not known"
    path = behind_a_vertex(op.BeamSplitter())
    path.add("other", op.Source())
    path.connect("other.out", "more.back")
    assert path.trace().frame == op.Frame()


@rows("turn", TURNS[::2])
def test_light_before_a_vertex_is_told_in_the_frame_that_its_turns_lead_from(turn):
    filters = {"filter": op.Polarizer(0.1, azimuth=turn), "splitter": op.BeamSplitter(azimuth=0.2)}
    nodes = {"lamp": LAMP, **filters, "vertex": GLASS, "eye": EYE}
    path = wired(nodes, "lamp -> filter, filter -> splitter, vertex -> eye")
    path.connect("splitter.transmitted", "vertex.in", azimuth=0.3)
    frame = (path.bind(turn=0.4) if path.parameters else path).mueller().frame_in
    own = GLASS.own_frame("in").frame({})
    np.testing.assert_allclose(frame.turned(angle_of(turn) + 0.5).x, own.x, rtol=0, atol=1e-15)


@rows("place", [1, 1.0, np.float64(1.0), "1"])
def test_a_place_is_a_whole_number_however_it_is_given(place):
    vertex = op.SpecularVertex(1.5, CORNER, place)
    assert vertex.place == 1
    assert type(vertex.place) is int


FIRST, SECOND = (op.SpecularVertex(1.5, TWICE, place) for place in (1, 2))


def test_light_of_two_vertices_is_the_same_whichever_way_they_are_added():
    nodes = {"b": SECOND, "a": FIRST, "lamp": LAMP, "e": EYE}
    path = wired(nodes, "lamp -> a, a -> b, b -> e")
    assert path.trace() == op.path_from_vertices(TWICE, [1.5, 1.5]).trace()


INTO = op.RefractingVertex(1.5, MIXED, 1)
NO_NEXT = "must lead from a vertex to the next of one chain"


@rows(
    "elements, sentence",
    [
        ((FIRST, FIRST), NO_NEXT),
        ((FIRST, op.SpecularVertex(1.5, TWICE[::-1], 2)), NO_NEXT),
        ((INTO, op.SpecularVertex(2.0, TURNED, 1, 1.5)), NO_NEXT),
        ((FIRST, op.Polarizer(), SECOND), "'e1' stands relatively between .* 'e0' and 'e2'"),
        ((INTO, op.SpecularVertex(0.2 + 3.4j, MIXED, 2)), "n = 1.5 behind 'e0'.*is 1; give"),
    ],
)
def test_vertices_that_do_not_follow_each_other_are_refused(elements, sentence):
    with pytest.raises(op.errors.PathError, match=sentence):
        chain(elements).check()


def test_what_cannot_stand_between_vertices_is_refused():
    path = wired({"lamp": LAMP, "a": FIRST, "b": SECOND, "eye": EYE}, "lamp -> a, b -> eye")
    path.connect("a.reflected", "b.in", azimuth=0.1)
    with pytest.raises(op.errors.PathError, match="by its vertices and by an azimuth"):
        path.check()
    nodes = {"lamp": LAMP, "a": GLASS, "b": op.SpecularVertex(1.5, CORNER, 1), "eye": EYE}
    with pytest.raises(
        op.errors.PathError, match="several lights meet at 'eye' in frames of vertices"
    ):
        wired(nodes, "lamp -> a, lamp -> b, a -> eye, b -> eye").check()
    path = op.path_from_vertices(INTO_GLASS, [op.Parameter("n")], events="T")
    with pytest.raises(op.errors.ParameterError, match="light goes on in"):
        path.trace(n=1.5 + 0.1j)
    masked = op.Vertex(1.5, CORNER, 1, events=[3], bad="mask")
    assert np.all(np.isnan(chain([masked]).trace().stokes))
    with pytest.raises(
        op.errors.ValueFault, match="there is no such chain, says the event at 'Vertex'"
    ):
        op.Vertex(1.5, CORNER, 1, events=[3])
    for node, frames, sentence in (
        ("vertex", {"in": op.Frame()}, "'vertex' has its frames from its vertices"),
        ("lamp", {"out": op.Frame()}, "'lamp.out -> vertex.in': light travels along"),
    ):
        path = op.PathGraph()
        for name, element in (("lamp", LAMP), ("vertex", GLASS), ("eye", EYE)):
            path.add(name, element, frames if name == node else None)
        path["lamp"] >> path["vertex"] >> path["eye"]
        with pytest.raises(op.errors.PathError, match=sentence):
            path.check()


def test_a_refraction_may_follow_a_reflection_and_go_before_one():
    bottom = op.SpecularVertex(0.2 + 3.4j, MIXED, 2, outside=op.FOLLOWS)
    path = chain([op.Polarizer(0.3), op.RefractingVertex(op.Material(1.5), MIXED, 1), bottom])
    light = path.trace()
    whole = op.path_from_vertices(MIXED, [1.5, 0.2 + 3.4j], events="TR")
    polarized = op.Polarizer(0.3).mueller().matrix[:, 0]
    np.testing.assert_allclose(light.stokes, whole.mueller().matrix @ polarized, rtol=1e-14)
    assert light.frame == whole.trace().frame
    path = op.path_from_vertices(INTO_GLASS, [1.5], events="T")
    assert "Fresnel transmission (stable, lossless)" in path.compose().explain()
    assert "RefractingVertex" in str(path) or "refracting-vertex" in path.to_toml()


SPECULAR, REFRACTING = op.SpecularVertex, op.RefractingVertex
ABSORBING, AT = op.Material(1.5, 1), (1.5, CORNER, 1)
ANGLES, OPEN = op.VerticesByAngles((0.3,)), op.Parameter("v")


@rows(
    "kind, arguments, others, message",
    [
        (SPECULAR, (1.5, CORNER, 2), {}, r"^SpecularVertex.place must be .* of 1 .. 1, not 2"),
        (SPECULAR, (1.5, CORNER, 0), {}, r"place must be .* not 0"),
        (SPECULAR, (1.5, CORNER, 1.5), {}, r"place must be .* not 1.5"),
        (SPECULAR, AT, {"reflections": -1}, r"reflections must be .* not -1"),
        (SPECULAR, AT, {"reflections": 2}, r"shape \(..., 4, 3\), not \(3, 3\)"),
        (SPECULAR, (1.5, OPEN, 1), {}, r"tell the number of reflections"),
        (SPECULAR, (1.5, [1.0, 2.0], 1), {}, r"shape \(..., 3, 3\), not \(2,\)"),
        (SPECULAR, (1.5, [[0, 0, 0], [1, 1]], 1), {}, "rows of unequal lengths"),
        (SPECULAR, (1.5, [[1j, 0, 0], [0, 1, 0], [0, 0, 1]], 1), {}, "is complex"),
        (REFRACTING, (1.5, TURNED, 1), {}, "by 90 deg at .*, but .* turns it by 48.1896851"),
        (REFRACTING, (1.5, INTO_GLASS, 2), {}, "place must be a whole number of 1 .. 1, not 2"),
        (REFRACTING, (1.5, INTO_GLASS, 1), {"count": 0}, "count must be .* above 0, not 0"),
        (REFRACTING, (1.5, OPEN, 1), {}, "tell the number of vertices of the chain, count=..."),
        (REFRACTING, (1.5 + 1j, INTO_GLASS, 1), {}, "is complex; give a real index .* goes on"),
        (REFRACTING, (ABSORBING, INTO_GLASS, 1), {}, "index.k is 1; give 0, since light goes"),
        (REFRACTING, (1.5, ANGLES, 1), {}, "are angles, which say reflections alone"),
        (op.Vertex, AT, {"events": [0.5]}, "events is 0.5"),
        (op.Vertex, AT, {"events": [4]}, "events is 4"),
        (op.Vertex, AT, {"events": [-1]}, "events is -1"),
        (op.Vertex, AT, {"events": [0, 0]}, r"vertices must have shape \(..., 4, 3\)"),
        (op.Vertex, AT, {"events": 0}, r"events must have shape \(..., 1\), not \(\)"),
        (op.Vertex, AT, {"events": "R"}, "events"),
        (op.Vertex, AT, {"events": OPEN}, "events cannot be a parameter"),
        (op.Vertex, (0.2 + 3j, CORNER, 1), {"events": [1]}, "into a medium that absorbs, k = 3"),
        (op.Vertex, AT, {"events": [1]}, "light is turned by 90 deg at 'Vertex'"),
        (op.Vertex, AT, {"events": [0], "bad": "no"}, "bad is 'no'"),
        (op.Vertex, (1.5, CORNER, 2), {"events": [0]}, "place must be a whole number of 1 .. 1"),
        (op.Vertex, (1.5, ANGLES, 1), {"events": [1]}, "are angles, which say"),
    ],
)
def test_what_is_no_such_vertex_is_refused(kind, arguments, others, message):
    with pytest.raises(op.errors.ValueFault, match=message) as error:
        kind(*arguments, **others)
    assert len(error.value.faults) == 1 or kind is not REFRACTING


def test_behind_the_end_of_a_chain_light_is_exactly_as_it_was():
    points = np.array([*BEND, [np.nan] * 3, [np.inf] * 3])
    ended = op.Vertex(0.2 + 3j, points, 2, 1.5, events=[1, 2, 2])
    np.testing.assert_array_equal(ended.mueller().matrix, np.eye(4))
    before = op.RefractingVertex(1.5, BEND, 1)
    assert ended.mueller().frame_out == before.mueller().frame_out


def test_media_of_two_vertices_agree_for_each_chain():
    events = [[1.0, 0.0], [0.0, 0.0]]
    first = op.Vertex(1.5, [DOWN, DOWN], 1, events=events)
    second = op.Vertex(1.2, [DOWN, DOWN], 2, outside=[1.5, 1.5], events=events)
    with pytest.raises(
        op.errors.PathError, match=r"'e1.in' is lit from n = 1 .* \(at 1, of 2 paths\)"
    ):
        chain([first, second]).check()


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

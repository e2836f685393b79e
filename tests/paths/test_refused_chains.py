"""Chains of vertices that cannot be, and what is wrong with how they are given."""

import numpy as np
import pytest

import optipath as op
from chains import ENGINES, MATERIALS, random_chains
from tables import rows

CORNER = [[0.0, 0.0, 3.0], [0.0, 0.0, 0.0], [0.0, 4.0, 0.0]]
INTO_GLASS = [[0.0, -1.0, 1.0], [0.0, 0.0, 0.0], [0.0, 1.0, -np.sqrt(3.5)]]  # 45 degrees, 1.5
TURNED = [[0.0, 0.0, 1.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
DOWN = [[0.0, 0, 3], [0, 0, 0], [0, 0, -1]]
POINTS = random_chains(1, 2, (3,))
PAIR = [1.5, 1.2 + 2j]
N = op.Parameter("n")
TWO_PATHS = "may be n and k, or the indices of two paths"


def of(*arguments, **others):
    return arguments, others


def bent(points=INTO_GLASS, materials=(1.5,), **given):
    return of(points, [*materials], **{"events": "T", **given})


def many(**given):
    return of(POINTS, PAIR, **given)


def chosen(second):
    return of(POINTS, [1.5, second], ids=[[0, 1]] * 3)


@rows(
    "given, messages",
    [
        (of(CORNER, []), ["materials must be a sequence"]),
        (of(CORNER, 1.5), ["materials must be a sequence", "not 1.5"]),
        (of(CORNER, [1.5, 1.5]), ["(..., m + 2, 3), m = 2 for 2 materials, not (3, 3)"]),
        (of(CORNER[:2], [-1.5]), ["m = 1 for 1 material, not (2, 3)", "-1.5"]),
        (of([[0, 0], [1, 1], [2, 0]], [1.5]), ["not (3, 2)"]),
        (of([[0, 0, 0], [1, 1]], [1.5]), ["rows of unequal lengths"]),
        (of([[0, 0, np.inf], *CORNER[1:]], [-1.5]), ["finite", "-1.5"]),
        (of([CORNER[0], CORNER[0], CORNER[2]], [1.5]), ["vertices 0 and 1", "are one point"]),
        (of(CORNER, ["glass"]), ["'glass'"]),
        (of(CORNER, [1.5], [[0, 0]]), ["normals must have shape (..., 1, 3), not (1, 2)"]),
        (of(CORNER, [-1.5], [[0, 1, 0]]), ["off the bisector", "-1.5"]),
        (of(CORNER, [1.5], [[0, 0, 0]]), ["the normal of vertex 1 has no length"]),
        (of(CORNER, [1.5], [[0, 0, 1]] * 2), ["normals must have shape (..., 1, 3)"]),
        (of(op.Parameter("v"), [1.5], [[0, 0, 1]]), ["points that are known"]),
        (of(op.VerticesByAngles((0.3,)), PAIR), ["1 incidence, m = 2 for 2 materials"]),
        (of(op.VerticesByAngles((2.0,)), [1.5]), ["vertices.incidences[0] is 2 rad, which is 1"]),
        (of(None, [1.5]), ["m = 1 for 1 material, not None"]),
        (of("abc", [1.5]), ["not 'abc'"]),
        (of({}, [1.5]), ["not {}"]),
        (of(iter(CORNER), [1.5]), ["not <list_iterator"]),
        (of(CORNER, [1.5], [[0, 1j, 1]]), ["normals must be real numbers, not"]),
        (of(CORNER, [1.5], [[0, 1], [1]]), ["the array of normals has rows of unequal lengths"]),
        (of(CORNER, [1.5], [[0, np.nan, 1]]), ["the normal of vertex 1 is not finite"]),
        (of([[CORNER] * 3] * 2, [1.5], [[[0, 1, 1]]] * 2), ["vertices (2, 3), normals (2,)"]),
        (
            of([CORNER[0], CORNER[0], [0, 0, np.nan]], [-1.5], [[0, 0, 0]]),
            ["3 faults", "vertex 2, counted from the light as 0, is [0.0, 0.0, nan]", "no length"],
        ),
        (of([CORNER[0], CORNER[0], CORNER[2]], [1.5], [[0, 1, 1]]), ["vertices 0 and 1"]),
        (of(CORNER, [1.5], bad=np.zeros((1, 2))), ["bad ", "is unknown; there are: refuse, ma"]),
        # Ids, lengths and events of chains that differ.
        (many(ids=[[0, 1], [1, 2], [0, 0]]), ["ids is 2 at (1, 1)", "0 .. 1"]),
        (many(ids=[[0, -1], [1, 0], [0, 0]]), ["ids is -1 at (0, 1)"]),
        (many(ids=[[0, 0.5], [1, 0], [0, 0]]), ["ids is 0.5 at (0, 1)"]),
        (many(ids=[[0, np.nan], [1, 0], [0, 0]]), ["ids is nan at (0, 1)"]),
        (many(ids="01"), ["ids must be whole numbers, not '01'"]),
        (many(ids=1), ["ids must have shape (..., m)"]),
        (many(ids=[[0, 1, 0]]), ["vertices must have shape (..., m + 2, 3), m = 3"]),
        (many(lengths=[1, 2, 3]), ["lengths is 3 at 2", "1 .. 2"]),
        (many(lengths=[0, 2, 1]), ["lengths is 0 at 0"]),
        (many(lengths=[1.5, 2, 1]), ["lengths is 1.5 at 0"]),
        (many(lengths="abc"), ["lengths must be whole numbers"]),
        (many(events=["RR", "RX", "R"]), ["events: letter 2 of chain 1 is 'X'; give R for each"]),
        (many(events=["RR", "", "R"]), ["letter 1 of chain 1 is missing"]),
        (many(events=["RR", "rt", "R"]), ["letter 1 of chain 1 is 'r'"]),
        (many(events=["RR", "RRR", "R"]), ["events of chain 1 has 3 letters for 2 vertices"]),
        (many(events=[1, 2, 3]), ["events is [1, 2, 3]; give R for each"]),
        (many(events=[["RR"] * 2] * 3), ["a text for each chain, in one row"]),
        (many(events=[["R"] * 3] * 3), ["an array of shape (..., 2) of single letters"]),
        (many(events=[["", "R"]] * 3), ["letter 1 of chain 0 is missing"]),
        (many(events="RRR", lengths=[1, 2, 1]), ["has 3 letters for 2 vertices at most"]),
        (many(bad="maks"), ["bad 'maks' is unknown; did you mean 'mask'?"]),
        (
            many(ids=[[0, 1]] * 2, lengths=[1] * 4, events=["R"] * 5),
            ["vertices (3,), ids (2,), lengths (4,), events (5,)"],
        ),
        (
            many(lengths=[0], events=[1], bad="no", outside=-1.0),
            ["lengths is 0", "events is [1]", "bad 'no'", "outside is -1"],
        ),
        (chosen(N), ["materials[1] is given when the path runs, but ids choose"]),
        (chosen(op.Material(N)), ["materials[1] is given when the path runs"]),
        (chosen(np.array([1.0, 2.0])), ["materials[1] is an array, and ids choose from numbers"]),
        (chosen("glass"), ["materials[1]: 'glass'"]),
        (chosen(-1.0), ["materials[1]"]),
        (
            of(POINTS, [1.5, N], events=["RR", "R", "RR"]),
            ["materials[1] is given when", "but which medium"],
        ),
        (many(events=["RR", "R", "RR"], outside=N), ["outside is given when the path runs"]),
        (
            of(op.VerticesByAngles((0.3, 0.4), (0.1,)), [1.5, 1.5], lengths=[1, 2]),
            ["one length and reflect; give the points"],
        ),
        (bent(DOWN, (1.5,), outside=(1.0, 0.1)), [TWO_PATHS]),
        (bent(DOWN, ((1.5, 0.1),)), [TWO_PATHS]),
    ],
)
def test_what_is_wrong_is_told_in_words(given, messages):
    arguments, others = given
    with pytest.raises(op.PathError) as error:
        op.path_from_vertices(*arguments, **others)
    for message in messages:
        assert message in str(error.value)


@rows(
    "given, message",
    [
        (bent(TURNED), "by 90 deg at 'vertex1', but .* turns it by 48.18968"),
        (bent([INTO_GLASS, TURNED]), r"90 deg at 'vertex1'.*\(at 1, of 2 paths\)"),
        (bent(materials=[1.0]), "from n = 1 into n = 1 lets it go straight on; move the point"),
        (bent(materials=[1.0], outside=1.01), "turns it by 8.0693"),
        (bent(materials=[1.5 + 0.1j]), "vertex1.index is complex; give a real index"),
        (
            bent(materials=[op.Material(1.5, 0.1)]),
            "vertex1.index.k is 0.1; give 0, since light goes on in there",
        ),
        (bent(materials=[0.0]), "vertex1.index is 0"),
        (bent(op.VerticesByAngles((0.3,))), "'?vertex1'?.vertices are angles, which say refl"),
        (bent(events="t"), "events is 't'; give R .*: 'T'"),
        (bent(events=" T"), "events is ' T'; give R .*: 'T'"),
        (bent(events=1), "events is 1; give R .*, such as 'RT'"),
        (bent(events="TT"), "events has 2 letters for 1 material; give R or T"),
        (bent(events=""), "events has 0 letters for 1 material"),
        (bent(outside=1j), "outside is complex; give a real index"),
        (bent(outside=-1.0), "outside is -1"),
        (bent(outside=op.FOLLOWS), "outside .*FOLLOWS"),
        (bent(materials=[N], normals=[[0, 0, 1]]), "media that are known; leave"),
        (bent(normals=[[0, 1, 1]]), "vertex 1 is off the one that refracts"),
        # Events are not counted against materials that are none.
        (of(DOWN, 1.5, events="T"), "materials must be a sequence"),
        *(
            (
                bent([*INTO_GLASS, [0.0, 2.0, -3.0], [0.0, 3.0, -3.0]], materials, events=events),
                r"^vertex1\.index",
            )
            for medium in (1.5 + 1j, op.Material(1.5, 0.1), -1.0, np.inf, "glass")
            for materials in ([medium, 1.2, 3.0],)
            for events in ("TTR", "TRR", "TRT")
        ),
    ],
)
def test_one_thing_that_is_wrong_with_a_refraction_is_told_once(given, message):
    arguments, others = given
    with pytest.raises(op.PathError, match=message) as error:
        op.path_from_vertices(*arguments, **others)
    assert len(error.value.faults) == 1


def test_points_that_may_be_those_of_a_refraction_are_asked_about_for_whole_chains():
    message = (
        r"turned by 16.8745 deg at vertex 1, which is a reflection at an incidence of 81.5628 deg, "
        r"or a refraction from n = 1 into n = 1.5 at 45 deg; say which, events='R' where it is "
        r"reflected, events='T' where it goes through"
    )
    with pytest.raises(op.PathError, match=message):
        op.path_from_vertices(INTO_GLASS, [1.5])
    assert op.path_from_vertices(INTO_GLASS, [1.5], events="R").trace().intensity < 0.5
    assert op.path_from_vertices(INTO_GLASS, [1.5], events="T").trace().intensity > 0.9
    # Defaults of parameters are known enough.
    points, n = op.Parameter("points", default=INTO_GLASS), op.Parameter("n", default=1.5)
    with pytest.raises(op.PathError, match="say which"):
        op.path_from_vertices(points, [n])
    slab = np.array([[0, -1, 1], [0, 0, 0], [0, 1, -np.sqrt(3.5)], [0, 2, -np.sqrt(3.5) - 1]])
    with pytest.raises(op.PathError, match=r"events='RR' where .* events='TT' where it goes"):
        op.path_from_vertices(slab, [1.5, 1.0])
    op.path_from_vertices(slab, [1.5, 1.0], events="TT")
    through = [[0.0, 0, 2], [0, 0.1, 1], [0, 0.1, 0], [0, 5, 1]]
    points = np.array([through, through])
    points[0, 3] = np.nan
    with pytest.raises(op.PathError, match="events='RR' where it is reflected"):
        op.path_from_vertices(points, [1.5, 1.5], lengths=[1, 2])
    op.path_from_vertices(points, [1.5, 1.5], lengths=[1, 2], events="RR")


LEGS = np.diff(INTO_GLASS, axis=0) / np.linalg.norm(np.diff(INTO_GLASS, axis=0), axis=-1)[:, None]


@rows(
    "points, materials, others",
    [
        (INTO_GLASS, [1.5 + 2j], {}),  # What absorbs lets nothing through.
        (INTO_GLASS, [1.0], {}),  # Equal media do not turn light.
        ([INTO_GLASS, TURNED], [1.5], {}),  # One chain can only be reflected.
        ([[0, 0, 0], [0, 0, 1], [0, 0, 2]], [1.5], {}),  # Straight on.
        (op.Parameter("points"), [1.5], {}),  # Not known yet.
        (INTO_GLASS, [N], {}),
        (INTO_GLASS, [np.array([])], {}),
        (op.VerticesByAngles((1.5,)), [1.5], {}),
        (INTO_GLASS, [1.5], {"normals": np.diff(LEGS, axis=0)}),
    ],
)
def test_nothing_is_asked_where_there_is_one_reading(points, materials, others):
    path = op.path_from_vertices(points, materials, **others)
    assert path.element("vertex1").kind == "specular-vertex"


def test_the_one_normal_or_coordinate_that_is_wrong_is_named():
    tilted = [0.0, np.sin(np.radians(46.0)), np.cos(np.radians(46.0))]
    with pytest.raises(op.PathError, match=r"vertex 1 is off the bisector .* by 1 deg"):
        op.path_from_vertices(CORNER, [1.5], [tilted])
    with pytest.raises(op.PathError, match=r"vertex 1 of chain 1 is off .* by 45 deg"):
        op.path_from_vertices([CORNER, CORNER], [1.5], [[[0, 1, 1]], [[0, 1, 0]]])
    # Of faulty vertices, no angle.
    with pytest.raises(op.PathError) as error:
        op.path_from_vertices(np.array(CORNER) * np.nan, [1.5], [[0, 1, 0]])
    assert "off the bisector" not in str(error.value)
    points = random_chains(18, 3, (10_000,))
    points[7777, 3, 2] = np.nan
    with pytest.raises(op.PathError, match=r"vertex 3 of chain 7777, .* nan\]"):
        op.path_from_vertices(points, MATERIALS[:3])
    plan = op.path_from_vertices(op.Parameter("points"), MATERIALS[:3]).compose()
    with pytest.raises(op.ParameterError, match=r"'points' is nan at \(7777, 3, 2\)"):
        plan.run(points=points)


@rows("batch, chain, told", [((7,), (5,), "chain 5"), ((2, 4), (1, 2), r"chain \(1, 2\)")])
def test_the_chain_of_a_batch_that_is_wrong_is_named(batch, chain, told):
    points = np.broadcast_to(np.array(CORNER), (*batch, 3, 3)).copy()
    normals = np.broadcast_to([[0.0, 1.0, 1.0]], (*batch, 1, 3)).copy()
    for wrong, message in (
        (np.nan, rf"vertex 2 of {told}, counted from the light as 0, is \[nan, nan, nan\]"),
        (points[(*chain, 1)], rf"vertices 1 and 2 of {told}"),
        (1e80, rf"vertices 1 and 2 of {told}, .*1e\+80 apart; legs are within 1e-70 .. 1e\+70"),
    ):
        faulty = points.copy()
        faulty[(*chain, 2)] = wrong
        with pytest.raises(op.PathError, match=message):
            op.path_from_vertices(faulty, [1.5], normals)
    normals[chain] = [[0.0, 1.0, 1.001]]
    with pytest.raises(op.PathError, match=rf"the normal of vertex 1 of {told} is off .* 0.0286 d"):
        op.path_from_vertices(points, [1.5], normals)


@rows("seed", range(3))
def test_normals_next_to_the_tolerance_are_told_apart_exactly(seed):
    points = random_chains(20 + seed, 3, (5000,))
    legs = np.diff(points, axis=-2)
    legs /= np.linalg.norm(legs, axis=-1, keepdims=True)
    bisectors = np.diff(legs, axis=-2)
    across = np.cross(bisectors, legs[:, 1:])
    across /= np.linalg.norm(across, axis=-1, keepdims=True)
    size = np.linalg.norm(bisectors, axis=-1, keepdims=True)
    op.path_from_vertices(points, MATERIALS[:3], bisectors + 0.99e-6 * size * across)
    off = np.zeros((5000, 3, 1))
    off[4321, 1] = 1.01e-6
    with pytest.raises(op.PathError, match="vertex 2 of chain 4321 is off"):
        op.path_from_vertices(points, MATERIALS[:3], bisectors + off * size * across)


APART = r"apart; legs are within 1e-70 .. 1e\+70"


@pytest.mark.parametrize("engine", ENGINES)
def test_points_given_later_are_checked_and_what_no_surface_refracts_is_refused_by_every_engine(
    engine,
):
    path = op.path_from_vertices(op.Parameter("points"), [1.5])
    plan = op.Composer(engine=engine).compose(path)
    for count in (1, 3, 3000):
        points = random_chains(13, 1, (count,))
        together, nan = points.copy(), points.copy()
        together[-1, 2], nan[-1, 2, 1] = together[-1, 1], np.nan
        wrong = [(together, r"vertices 1 and 2.* are one point"), (nan, "is nan")]
        wrong += [(other, r"must have shape \(\.\.\., 3, 3\)") for other in (points[:, :2], 0.5)]
        for scale in (1e-160, 1e-75, 1e75, 1e155):
            scaled = points.copy()
            scaled[-1] *= scale
            with pytest.raises(op.PathError, match=APART):
                op.path_from_vertices(scaled, [1.5])
            wrong.append((scaled, APART))
        for given, message in wrong:
            with pytest.raises(op.ParameterError, match=message):
                plan.run(points=given)
    path = op.path_from_vertices(op.Parameter("points"), [N], events="T")
    plan = op.Composer(engine=engine).compose(path)
    message = r"turned by 90 deg at 'vertex1', but a refraction from n = 1 into n = 1.5 \(par"
    for count in (1, 7, 3000):
        points = np.array([INTO_GLASS] * count)
        assert np.all(plan.run(points=points, n=1.5).intensity > 0.9)
        points[-1] = TURNED
        with pytest.raises(op.ParameterError, match=message) as error:
            plan.run(points=points, n=1.5)
        assert count == 1 or f"of {count} paths" in str(error.value)
    with pytest.raises(op.ParameterError, match="lets it go straight on"):
        plan.run(points=points[0], n=1.0)

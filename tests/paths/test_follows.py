"""op.FOLLOWS: a boundary takes its medium in front and its angle over from the one before."""

import copy
import pickle

import numpy as np
import pytest

import optipath as op
from optipath.lab.accuracy.path_reference import exact_lights
from tables import rows
from wired import read_back, wired


def following(index):
    return op.Interface(index, op.FOLLOWS, outside=op.FOLLOWS)


SECOND = following(1.0)


def stack_of(*boundaries, loops="sum"):
    """Boundaries one behind the other; with loops, light goes to and fro between them."""
    path = op.PathGraph(loops=loops)
    path.add("lamp", op.Source())
    light = "lamp.out"
    for number, boundary in enumerate(boundaries):
        path.add(f"b{number}", boundary)
        path.connect(light, f"b{number}.in")
        if number and loops == "sum":
            path.connect(f"b{number}.reflected", f"b{number - 1}.back")
        light = f"b{number}.transmitted"
    path.add("T", op.Detector())
    path.connect(light, "T.in")
    return path


def faults_of(path):
    with pytest.raises(op.PathError) as error:
        path.check()
    return error.value.faults


@rows(
    "boundaries, indices",
    [
        ([following(n) for n in (1.2, 1.7, 1.0)], [1.0, 1.5, 1.2, 1.7, 1.0]),
        ([op.LayerStack([op.FOLLOWS, 1.2, 1.0], op.FOLLOWS)], [1.0, 1.5, 1.2, 1.0]),
    ],
)
def test_faces_in_loops_and_a_stack_take_over_from_face_to_face(boundaries, indices):
    path = stack_of(op.Interface(1.5, 0.7), *boundaries)
    whole = op.LayerStack(indices, 0.7).mueller("in", "transmitted").matrix[:, 0]
    np.testing.assert_allclose(path.trace().stokes, whole, rtol=0, atol=1e-15)
    exact = [float(part) for part in exact_lights(path)["T"].stokes]
    np.testing.assert_allclose(path.trace().stokes, exact, rtol=0, atol=1e-15)


def test_taking_over_is_what_one_would_write_through_filters_and_vertices_too():
    n, theta = op.Parameter("n"), op.Parameter("theta")
    written = op.Interface(1.0, theta, outside=n, incidence_in=1.0)
    paths = [stack_of(op.Interface(n, theta), back) for back in (SECOND, written)]
    given = {"n": np.array([1.3, 1.5]), "theta": 0.6}
    first, second = (path.trace(**given).stokes for path in paths)
    assert np.array_equal(first, second)
    assert paths[0].compose().whole == paths[1].compose().whole
    assert np.array_equal(paths[0].bind(n=1.3, theta=0.6).trace().stokes, first[0])
    first, points = (
        op.Interface(1.5, 0.4, outside=1.33),
        [[0, 0, 0], [0, 0, 3], [0, 2, 3], [1, 2, 3]],
    )

    def filtered(outside):
        return first >> op.Polarizer(0.2) >> op.Interface(1.5, 0.4, outside=outside)

    def vertices(outside):
        vertex = op.SpecularVertex(1.5, points, 1, outside=1.2)
        return vertex >> op.SpecularVertex(1.5, points, 2, outside=outside)

    for path, outside in ((filtered, 1.33), (vertices, 1.2)):
        taken, given = (
            (op.Source() >> path(medium) >> op.Detector()).trace().stokes
            for medium in (op.FOLLOWS, outside)
        )
        assert np.array_equal(taken, given)


@rows(
    "boundaries, words",
    [
        (
            [SECOND],
            [
                "'b0' takes its outside over (FOLLOWS), but no boundary before it sends",
                "'b0' takes its incidence over (FOLLOWS), but no parallel boundary before",
            ],
        ),
        ([op.Interface(1.5, op.FOLLOWS)], ["'b0' takes its incidence over (FOLLOWS), but no"]),
        (
            [op.Interface(1.5, 0.3), op.Interface(1.0, op.FOLLOWS, 1.5, parallel=False)],
            ["is not parallel to what is before it; give the angle"],
        ),
        (
            [op.Interface(1.5, 0.3), op.Interface(1.0, op.FOLLOWS, 1.5, incidence_in=1.0)],
            ["has an incidence_in of its own, which comes with it; leave that out"],
        ),
        (
            [op.Interface(1.5 + 1j, 0.3), op.LayerStack([op.FOLLOWS, 1.2, 1.0], op.FOLLOWS)],
            ["the medium before 'b1.in' absorbs"],
        ),
        ([op.Interface(1.5, 0.3, outside=op.FOLLOWS), SECOND], ["'b0' takes its outside over"]),
    ],
)
def test_where_nothing_can_be_taken_over_a_fault_says_so_once(boundaries, words):
    faults = faults_of(stack_of(*boundaries, loops="refuse"))
    assert len(faults) == len(words)
    assert all(word in fault for word, fault in zip(words, faults, strict=True))


ARITHMETIC = (op.ParameterError, r"FOLLOWS .* has no arithmetic; give the number")


@rows(
    "call, error, sentence",
    [
        (lambda: op.FOLLOWS + 0.1, *ARITHMETIC),
        (lambda: 2 * op.FOLLOWS, *ARITHMETIC),
        (lambda: -op.FOLLOWS, *ARITHMETIC),
        (lambda: np.float64(2.0) * op.FOLLOWS, *ARITHMETIC),
        (lambda: np.ones(2) - op.FOLLOWS, *ARITHMETIC),
        (
            lambda: op.Interface(op.FOLLOWS, 0.3),
            op.ValueFault,
            "index must be an index of refraction",
        ),
        (
            lambda: op.LayerStack([1, op.FOLLOWS, 1], 0.3),
            *(op.ValueFault, r"indices\[1\] cannot be FOLLOWS; only"),
        ),
        (SECOND.mueller, op.PathError, "interface takes its outside and incidence over from"),
    ],
)
def test_what_cannot_be_taken_over_is_refused_when_it_is_written(call, error, sentence):
    with pytest.raises(error, match=sentence):
        call()


def merged(*boundaries):
    """Boundaries whose lights meet at one face, which takes over what they have."""
    path = wired({"both": op.Combiner(), "face": SECOND, "eye": op.Detector()}, "both -> face")
    for number, boundary in enumerate(boundaries):
        path.add(f"lamp{number}", op.Source())
        path.add(f"b{number}", boundary)
        path.connect(f"lamp{number}", f"b{number}")
        path.connect(f"b{number}.transmitted", "both")
    path.connect("face.transmitted", "eye.in")
    return path


ANGLES = (
    "'face' has taken its incidence over (FOLLOWS) from other light: n sin(incidence) is 0.5 at "
    "'b1' and 0.6427876097 at 'face' (40 deg in n = 1); light of several directions merges there: "
    "give each light a face of its own"
)
MEDIA = (
    "lit from 2 * m = 1.6 behind 'b1' (by 'b1.transmitted'), but has taken its outside over "
    "(FOLLOWS) from other light, in n = 1.5 (parameter 'n'); light of several media merges there: "
    "give each light a face of its own"
)
STEEP = op.Interface(1.5, "40 deg")


@rows(
    "boundaries, given, words",
    [
        (
            [op.Interface(1.5, 0.3), op.Interface(1.6, 0.3)],
            *({}, "light of several media comes to 'face.in'; give each light a face of its own"),
        ),
        (
            [op.Interface(op.Parameter("n"), 0.3), op.Interface(2 * op.Parameter("m"), 0.3)],
            *({"n": 1.5, "m": 0.8}, MEDIA),
        ),
        ([STEEP, op.Interface(1.5, "30 deg")], {}, ANGLES),
        ([STEEP, op.Interface(1.5, op.Parameter("t"))], {"t": "30 deg"}, ANGLES),
    ],
)
def test_lights_that_differ_and_merge_have_nothing_to_take_over(boundaries, given, words):
    with pytest.raises(op.OptipathError) as error:
        merged(*boundaries).trace(**given)
    (fault,) = error.value.faults
    assert words in fault


def test_faces_in_space_and_those_that_only_take_over_from_each_other_have_nothing():
    frames = {"in": op.Frame(), "transmitted": op.Frame()}
    path = op.PathGraph()
    path.add("lamp", op.Source(), {"out": op.Frame()})
    path.add("front", op.Interface(1.5, 0.0), frames)
    path.add("back", SECOND, frames)
    path.add("eye", op.Detector())
    for link in (("lamp", "front"), ("front.transmitted", "back"), ("back.transmitted", "eye")):
        path.connect(*link)
    (fault,) = faults_of(path)
    assert fault == (
        "'back' takes its incidence over (FOLLOWS), but its world frames say how it stands to what "
        "is before it; give the angle"
    )
    face = op.Interface(1.0, 0.3, outside=op.FOLLOWS)
    ends = {"lamp": op.Source(), "half": op.BeamSplitter(), "a": face, "b": face}
    links = "lamp -> half, half.transmitted -> a, a -> b, b -> half.back, half.reflected -> eye"
    path = wired({**ends, "eye": op.Detector()}, links, loops="sum")
    assert all("give it at one of them" in fault for fault in faults_of(path))


def test_files_copies_and_texts_know_it(tmp_path):
    assert repr(SECOND).startswith("Interface(index=1.0, incidence=FOLLOWS, outside=FOLLOWS")
    assert pickle.loads(pickle.dumps(SECOND)) == SECOND == copy.deepcopy(SECOND)
    assert pickle.loads(pickle.dumps(op.FOLLOWS)) is op.FOLLOWS is copy.copy(op.FOLLOWS)
    assert op.Interface(1.0, 0.3, outside=1.5) != op.Interface(1.0, 0.3, outside=op.FOLLOWS)
    stack = op.LayerStack([op.FOLLOWS, 1.2, 1.0], op.FOLLOWS)
    assert stack != op.LayerStack([1.5, 1.2, 1.0], op.FOLLOWS)
    for second in (SECOND, stack, op.Interface(1.0, 0.1, outside=1.5, parallel=False)):
        loops = "sum" if second.parallel else "refuse"
        path = stack_of(op.Interface(1.5, op.Parameter("theta")), second, loops=loops)
        text = path.to_toml()
        assert 'incidence = "follows"' in text or "parallel = false" in text
        assert read_back(path, tmp_path) == path

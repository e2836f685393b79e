"""Where light goes from boundary to boundary, media and Snell's law agree on both sides.

What faces take over from those before them, and which of them are parallel.
"""

import copy
import itertools
import pickle
import re
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import optipath as op
from chains import ENGINES
from optipath.lab.path_reference import exact_lights
from tables import rows, slow_except
from wired import read_back, wired

THETA = np.radians(40.0)
INSIDE = np.arcsin(np.sin(THETA) / 1.5)
F, EYE, SINES = op.FOLLOWS, op.Detector(), r"n sin\(incidence\)"
GLASS, FRONT, FLAT = (op.Interface(1.5, angle) for angle in (THETA, 0.3, 0.0))
WRONG, FOLLOWING = (op.Interface(1.0, angle, outside) for angle, outside in ((THETA, 1.5), (F, F)))
RIGHT, STACK = replace(WRONG, incidence_in=1.0), op.LayerStack([F, 1.2, 1.0], F)
N, M = op.Parameter("n"), op.Parameter("m")
OPEN = op.Interface(N, op.Parameter("theta")), op.Interface(1.0, op.Parameter("phi"), outside=M)
STEEP = op.Interface(1.5, "40 deg")
OF_N, OF_M = op.Interface(N, 0.3), op.Interface(2 * M, 0.3)
ANGLES = "n sin(incidence) is 0.5 at 'b1' and 0.6427876097 at 'face' (40 deg in n = 1)"
MEDIA = "lit from 2 * m = 1.6 behind 'b1' (by 'b1.transmitted'), but has taken its outside over"
SEEDS = st.integers(0, 10**6)
LOSSLESS = [op.Medium(0.1), op.Attenuator(1.0), op.Rotator(0.0), op.Combiner(), op.Retarder(0.0)]


class Window(op.Element):
    """An element of one's own that light goes straight through."""

    loss: op.fields.Fraction = 0.1

    @staticmethod
    def mueller_rows(_, loss):
        t = 1.0 - loss
        return (t, 0, 0, 0), (0, t, 0, 0), (0, 0, t, 0), (0, 0, 0, t)


def in_a_row(row, loops="sum", enter="in", stokes=(1, 0, 0, 0)):
    """A lamp, elements by name, each lit by what passes the one before, and an eye."""
    path = wired({"lamp": op.Source(stokes=stokes), **row, "T": EYE}, "", loops=loops)
    light = "lamp.out"
    for name, element in row.items():
        path.connect(light, f"{name}.{enter if name == 'back' else 'in'}")
        ways = [out for out in ("out", "transmitted", "reflected") if out in element.outputs]
        light = f"{name}.{ways[0]}"
    path.connect(light, "T.in")
    return path


def faces(front, back, between=None, before=None, to=None, azimuth=None, enter="in"):
    """Two faces; light goes to and fro between them where it has a way back."""
    row = {"before": before, "front": front, "between": between, "back": back}
    path = in_a_row({name: one for name, one in row.items() if one is not None}, enter=enter)
    if to:
        path.connect("back.reflected", to, azimuth=azimuth)
    return path


slab = partial(faces, to="front.back")
R_S, R_P = ((f(THETA - INSIDE) / f(THETA + INSIDE)) ** 2 for f in (np.sin, np.tan))
FRESNEL = sum((1 - r) / (1 + r) / 2 for r in (R_S, R_P))


def stack_of(*boundaries, loops="sum"):
    """Boundaries one behind the other; with loops, light goes to and fro between them."""
    path = in_a_row({f"b{number}": each for number, each in enumerate(boundaries)}, loops=loops)
    for number in range(1, len(boundaries) if loops == "sum" else 1):
        path.connect(f"b{number}.reflected", f"b{number - 1}.back")
    return path


def faults_of(path, **parameters):
    with pytest.raises(op.errors.ParameterError if parameters else op.errors.PathError) as error:
        path.trace(**parameters)
    return error.value.faults


def fault_of(path, **parameters):
    (fault,) = faults_of(path, **parameters)
    return fault


def test_taking_over_is_what_one_would_write_through_filters_and_vertices_too():
    # Faces in loops and a stack take over from face to face.
    for boundaries, indices in (
        ([op.Interface(n, F, F) for n in (1.2, 1.7, 1.0)], [1.0, 1.5, 1.2, 1.7, 1.0]),
        ([STACK], [1.0, 1.5, 1.2, 1.0]),
    ):
        path = stack_of(op.Interface(1.5, 0.7), *boundaries)
        whole = op.LayerStack(indices, 0.7).mueller("in", "transmitted").matrix[:, 0]
        exact = [float(part) for part in exact_lights(path)["T"].stokes]
        found = np.broadcast_to(path.trace().stokes, (2, 4))
        np.testing.assert_allclose(found, [whole, exact], rtol=0, atol=1e-15)
    n, theta = op.Parameter("n"), op.Parameter("theta")
    written = op.Interface(1.0, theta, outside=n, incidence_in=1.0)
    paths = [stack_of(op.Interface(n, theta), back) for back in (FOLLOWING, written)]
    given = {"n": np.array([1.3, 1.5]), "theta": 0.6}
    first, second = (path.trace(**given).stokes for path in paths)
    assert np.array_equal(first, second)
    assert paths[0].compose().whole == paths[1].compose().whole
    assert np.array_equal(paths[0].bind(n=1.3, theta=0.6).trace().stokes, first[0])
    points = [[0, 0, 0], [0, 0, 3], [0, 2, 3], [1, 2, 3]]
    first, vertex = op.Interface(1.5, 0.4, 1.33), op.SpecularVertex(1.5, points, 1, outside=1.2)
    for path, outside in (
        (lambda n: first >> op.Polarizer(0.2) >> op.Interface(1.5, 0.4, outside=n), 1.33),
        (lambda n: vertex >> op.SpecularVertex(1.5, points, 2, outside=n), 1.2),
    ):
        taken, given = (op.Source() >> path(n) >> op.Detector() for n in (F, outside))
        assert np.array_equal(taken.trace().stokes, given.trace().stokes)


@rows(
    "boundaries, words",
    [
        ([FOLLOWING], ["outside over (FOLLOWS), but no b", "incidence over (FOLLOWS), but no p"]),
        ([op.Interface(1.5, F)], ["'b0' takes its incidence over (FOLLOWS), but no"]),
        ([FRONT, op.Interface(1.0, F, 1.5, parallel=False)], ["no parallel boundary before it"]),
        (
            [FRONT, op.Interface(1.0, F, 1.5, incidence_in=1.0)],
            ["has an incidence_in of its own, which comes with it; leave"],
        ),
        ([op.Interface(1.5 + 1j, 0.3), STACK], ["the medium before 'b1.in' absorbs"]),
        ([op.Interface(1.5, 0.3, outside=F), FOLLOWING], ["'b0' takes its outside over"]),
    ],
)
def test_where_nothing_can_be_taken_over_a_fault_says_so_once(boundaries, words):
    faults = faults_of(stack_of(*boundaries, loops="refuse"))
    assert all(word in fault for word, fault in zip(words, faults, strict=True))


@rows(
    "call, sentence",
    [
        (lambda: op.Interface(F, 0.3), "ValueFault.*index must be an index of refraction"),
        (
            lambda: op.LayerStack([1, F, 1], 0.3),
            "ValueFault.*medium in front, can be FOLLOWS",
        ),
        (FOLLOWING.mueller, "PathError.*interface takes its outside and incidence over from"),
    ],
)
def test_what_cannot_be_taken_over_is_refused_when_it_is_written(call, sentence):
    with pytest.raises(op.OptipathError) as error:
        call()
    assert re.search(sentence, f"{error.type.__name__}: {error.value}")


def merged(*boundaries):
    """Boundaries whose lights meet at one face, which takes over what they have."""
    path = wired({"both": op.Combiner(), "face": FOLLOWING, "eye": op.Detector()}, "both -> face")
    for number, boundary in enumerate(boundaries):
        path.add(f"lamp{number}", op.Source())
        path.add(f"b{number}", boundary)
        path.connect(f"lamp{number}", f"b{number}")
        path.connect(f"b{number}.transmitted", "both")
    path.connect("face.transmitted", "eye.in")
    return path


@rows(
    "boundaries, given, words",
    [
        ([FRONT, op.Interface(1.6, 0.3)], {}, "light of several media comes to 'face.in'; give"),
        ([OF_N, OF_M], {"n": 1.5, "m": 0.8}, MEDIA),
        ([STEEP, op.Interface(1.5, "30 deg")], {}, ANGLES),
        ([STEEP, op.Interface(1.5, op.Parameter("t"))], {"t": "30 deg"}, ANGLES),
    ],
)
def test_lights_that_differ_and_merge_have_nothing_to_take_over(boundaries, given, words):
    assert words in fault_of(merged(*boundaries), **given)


def test_faces_in_space_and_those_that_only_take_over_from_each_other_have_nothing():
    frames = {"in": op.Frame(), "transmitted": op.Frame()}
    path = op.PathGraph()
    path.add("lamp", op.Source(), {"out": op.Frame()}) >> path.add("front", FLAT, frames)
    path["front.transmitted"] >> path.add("back", FOLLOWING, frames)
    path["back.transmitted"] >> path.add("eye", EYE)
    assert "before it, without world frames, refracts to it; give the angle" in fault_of(path)
    face = op.Interface(1.0, 0.3, outside=F)
    ends = {"lamp": op.Source(), "half": op.BeamSplitter(), "a": face, "b": face}
    links = "lamp -> half, half.transmitted -> a, a -> b, b -> half.back, half.reflected -> eye"
    path = wired({**ends, "eye": op.Detector()}, links, loops="sum")
    assert all("give it at one of them" in fault for fault in faults_of(path))


def test_files_copies_and_texts_know_it(tmp_path):
    assert repr(FOLLOWING).startswith("Interface(index=1.0, incidence=FOLLOWS, outside=FOLLOWS")
    assert pickle.loads(pickle.dumps(FOLLOWING)) == FOLLOWING == copy.deepcopy(FOLLOWING)
    assert pickle.loads(pickle.dumps(F)) is F is copy.copy(F)
    assert op.Interface(1.0, 0.3, outside=1.5) != op.Interface(1.0, 0.3, outside=F)
    assert op.LayerStack([1.5, 1.2, 1.0], F) != STACK
    for second in (FOLLOWING, STACK, op.Interface(1.0, 0.1, outside=1.5, parallel=False)):
        loops = "sum" if second.parallel else "refuse"
        path = stack_of(op.Interface(1.5, op.Parameter("theta")), second, loops=loops)
        text = path.to_toml()
        assert 'incidence = "follows"' in text or "parallel = false" in text
        assert read_back(path, tmp_path) == path


@rows("before", [None, op.LayerStack([1, 1.5, 1], "10 deg")])
@rows("back", [RIGHT, FOLLOWING])
def test_a_front_that_is_not_parallel_to_what_is_before_it_is_parallel_to_its_back(before, back):
    front = op.Interface(1.5, THETA, parallel=False)
    light = slab(front, back, before=before).trace()
    if before is None:
        assert light.intensity == pytest.approx(FRESNEL, rel=1e-12)
        assert f"{light.intensity:.6f}" == "0.914261"
    assert "n sin(incidence)" in fault_of(slab(front, WRONG, before=before))


@rows("azimuth", [0.3, 1e-6, np.pi / 2])
def test_no_azimuth_in_a_loop_switches_the_look_at_angles_off(azimuth):
    turned = op.Interface(1.0, THETA, outside=1.5, azimuth=azimuth)
    filtered = slab(GLASS, WRONG, between=op.Polarizer(0.0, azimuth=azimuth))
    # A turn of a thousandth is none without a loop, too.
    hardly = faces(GLASS, op.Interface(1.0, THETA, outside=1.5, azimuth=1e-4))
    for path in (slab(GLASS, WRONG, azimuth=azimuth), slab(GLASS, turned), filtered, hardly):
        with pytest.raises(op.errors.PathError, match=SINES):
            path.trace()


def test_faces_between_which_light_goes_to_and_fro_have_one_plane_of_incidence():
    words = "light goes to and fro between 'back' and 'front', which are parallel then, but"
    assert words in fault_of(slab(GLASS, RIGHT, azimuth=0.3))
    fault = fault_of(slab(GLASS, RIGHT, between=op.Polarizer(0.0, azimuth=0.3)))
    assert "turns the plane of incidence by 17.18873385 deg" in fault
    turned = op.Interface(1.0, THETA, outside=1.5, incidence_in=1.0, azimuth=op.Parameter("a"))
    path = slab(GLASS, turned)
    assert path.trace(a=[0.0, np.pi]).intensity == pytest.approx([FRESNEL] * 2, rel=1e-12)
    assert "40.10704566 deg (parameter 'a')" in fault_of(path, a=0.7)
    # Turns add up along the way.
    undone = slab(GLASS, turned, between=op.Polarizer(0.0, azimuth=0.3))
    undone.trace(a=-0.3)
    assert "let the azimuths on the way add up to 0" in fault_of(undone, a=0.0)


def test_faces_at_normal_incidence_may_be_turned_and_others_that_take_over_may_not():
    constant = faces(GLASS, op.Interface(1.0, F, outside=F, azimuth=0.7))
    assert "'back' takes its incidence over (FOLLOWS), as a face parallel" in fault_of(constant)
    path = faces(GLASS, op.Interface(1.0, F, outside=F, azimuth=op.Parameter("a")))
    path.trace(a=0.0)
    for a in (0.7, [0.0, 0.7]):
        assert "by 40.10704566 deg (parameter 'a')" in fault_of(path, a=a)
    for azimuth in (0.7, op.Parameter("a", 0.7)):
        back = op.Interface(1.0, F, outside=F, azimuth=azimuth)
        for to, azimuth_back, left in ((None, None, 0.96**2), ("front.back", azimuth, 3 / 3.25)):
            light = slab(FLAT, back, to=to, azimuth=azimuth_back).trace()
            assert light.intensity == pytest.approx(left, rel=1e-12)


@rows("indices", [[1, 1.5, 1], [1, 1.5, 1.3, 1.7]])
def test_a_stack_that_is_turned_about_its_normal_does_the_same(indices):
    state, turn = np.array([1, 0.4, 0.3, 0.2]), 0.3
    row = {"f0": op.Interface(indices[1], op.Parameter("t", 0.0), azimuth=op.Parameter("a0", 0.0))}
    for number, index in enumerate(indices[2:], start=1):
        azimuth = op.Parameter(f"a{number}", turn * (-2) ** number)
        row[f"f{number}"] = op.Interface(index, F, F, azimuth=azimuth)
    path = in_a_row(row, stokes=state)
    path["f0.reflected"] >> path.add("R", EYE)
    for (before, _), (name, face) in itertools.pairwise(row.items()):
        path.connect(f"{name}.reflected", f"{before}.back", azimuth=face.azimuth)
    # Of layers that lose nothing and do not interfere, (1 - T) / T adds up.
    pairs = np.array(list(itertools.pairwise(indices)))
    loss = np.sum((pairs[:, 0] - pairs[:, 1]) ** 2 / (4 * pairs[:, 0] * pairs[:, 1]))
    through, back = 1 / (1 + loss), loss / (1 + loss)
    both = 2 * sum(turn * (-2) ** number for number in range(1, len(indices) - 1))
    c, s = np.cos(both), np.sin(both)
    turned = [1, c * state[1] + s * state[2], c * state[2] - s * state[1], state[3]]
    found = path.trace_all()
    np.testing.assert_allclose(found["T"].stokes, through * np.array(turned), atol=1e-14)
    np.testing.assert_allclose(found["R"].stokes, back * state * [1, 1, -1, -1], atol=1e-14)


@rows("back", [None, -0.3, op.Parameter("b")])
def test_light_that_goes_to_and_fro_is_turned_alike_on_both_ways(back):
    turned = op.Interface(1.0, F, outside=F, azimuth=0.3)
    late = {"b": [0.3, -0.3]} if isinstance(back, op.Parameter) else {}
    fault = fault_of(slab(FLAT, turned, azimuth=back), **late)
    second = "0 deg" if back is None else "-17.18873385 deg"
    there, back = "'front.transmitted' to 'back.in'", "'back.reflected' to 'front.back'"
    turns = f"turns the plane of incidence by 17.18873385 deg, and that from {back} by {second}"
    assert f"the way from {there} {turns}" in fault
    assert "let the azimuths on either way add up to the same" in fault
    several = op.Interface(1.0, F, outside=F, azimuth=np.array([0.0, np.pi, 0.3]))
    assert fault_of(slab(FLAT, several)).endswith("(at 2, of 3 paths)")
    # A half turn is none to polarised light.
    half = slab(FLAT, turned, azimuth=0.3 - np.pi)
    assert half.trace().intensity == pytest.approx(3 / 3.25, rel=1e-12)


def before_mirror(go, back, *, again=None):
    """A face with a mirror behind it, and another between that and the way back, or none."""
    ends = {"lamp": op.Source(stokes=[1, 0.4, 0.3, 0.2]), "f": FLAT}
    ends |= {"m": op.Mirror(-0.9, azimuth=go), "plate": op.Retarder(0.0), "R": op.Detector()}
    path = wired(ends, "lamp -> f, f.transmitted -> m, m -> plate, f.reflected -> R", loops="sum")
    light = path["plate"]
    if again is not None:
        light = light >> path.add("again", op.Mirror(azimuth=again))
    path.connect(light.name, "f.back", azimuth=back)
    return path


@rows("go", [0.3, op.Parameter("a"), np.array([0.0, 0.3])])
def test_light_that_a_mirror_sends_back_is_turned_alike_on_both_ways(go):
    late = {"a": 0.3} if isinstance(go, op.Parameter) else {}
    fault = fault_of(before_mirror(go, None), **late)
    assert "between 'f' and 'm', but the way from 'f.transmitted' to 'm.in' turns" in fault
    assert "and that from 'm.reflected' to 'f.back' by 0 deg; let" in fault
    # A mirror without axes may turn about its normal: it is 0.04 + 0.96^2 0.81 / (1 - 0.04 0.81).
    r = 0.04 + 0.96**2 * 0.81 / (1 - 0.04 * 0.81)
    light = before_mirror(go, go).trace(**late).stokes
    expected = np.broadcast_to(r * np.array([1, 0.4, -0.3, -0.2]), light.shape)
    np.testing.assert_allclose(light, expected, rtol=1e-12, atol=1e-15)
    # What two mirrors send back may be turned.
    assert before_mirror(0.3, None, again=0.2).trace().S0 > 0.0


def test_a_ring_may_turn_its_light_and_a_face_at_an_angle_sends_none_back():
    turned = op.Interface(1.0, F, outside=F, azimuth=op.Parameter("turn"))
    ends = {"lamp": op.Source(stokes=[1, 1, 0, 0]), "both": op.Combiner(), "R": op.Detector()}
    ends |= {"a": FLAT, "b": turned, "half": op.Attenuator(0.5)}
    links = "both -> a, a.transmitted -> b, b.transmitted -> half, half -> both, a -> R"
    path = wired(ends, f"lamp -> both, {links}", loops="sum")
    turn = np.array([0.0, 0.3])
    # What goes round is turned by as much each time: a geometric series in exp(-2i turn).
    once = 0.5 * 0.96**2
    linear = 0.04 / (1 - once * np.exp(-2j * turn))
    expected = [[0.04 / (1 - once), each.real, -each.imag, 0] for each in linear]
    np.testing.assert_allclose(path.trace(turn=turn).stokes, expected, rtol=1e-12, atol=1e-15)
    front, back = op.Interface(1.5, "48.59 deg"), op.Interface(1.0, "20 deg", 1.5, parallel=False)
    faces(front, back).check()
    told = "between 'front' and 'back', which says parallel=False, though light comes back"
    assert told in fault_of(slab(front, back))


@rows("turned_first", [True, False])
def test_every_route_to_a_face_is_looked_at(turned_first):
    filters = op.Polarizer(0.0, azimuth=0.5), op.Polarizer(0.0)
    ends = dict(zip(["a", "b"] if turned_first else ["b", "a"], filters, strict=True))
    ends |= {"lamp": op.Source(), "front": GLASS, "half": op.BeamSplitter(), "both": op.Combiner()}
    links = "lamp -> front, front.transmitted -> half, half.transmitted -> a, a -> both, b -> both"
    path = wired({**ends, "back": WRONG, "T": EYE}, f"{links}, both -> back, back.transmitted -> T")
    path.connect("half.transmitted", "b.in", tap=True)
    with pytest.raises(op.errors.PathError, match=SINES):
        path.check()


def test_beyond_the_critical_angle_the_one_behind_is_a_right_angle():
    t = np.radians(np.arange(90.0))
    u = op.refraction_angle(1.0, t, 1.5)
    gap = op.Interface(1.0, op.Parameter("t"), outside=1.5)
    beyond = op.Interface(1.5, op.Parameter("u"), outside=1.0)
    for to in (None, "front.back"):
        light = slab(gap, beyond, to=to).trace(t=t, u=u)
        assert np.all(light.intensity[np.sin(t) > 1 / 1.5] == pytest.approx(0.0, abs=1e-12))
        assert light.intensity[0] > 0.9
        # A right angle for light that does get there is wrong.
        with pytest.raises(op.errors.ParameterError, match=SINES):
            slab(gap, beyond, to=to).trace(t=t, u=np.pi / 2)
    outside = op.Interface(1.0, np.pi / 2, outside=1.5, incidence_in=1.0)
    assert "n sin(incidence)" in fault_of(faces(op.Interface(1.5, "60 deg", outside=1.5), outside))


def test_multiples_absorptions_and_what_is_taken_for_granted_are_told():
    def plates(**about):
        plate = op.LayerStack([1, 1.5, 1], "30 deg")
        return faces(plate, op.LayerStack([1, 1.5, 1], "60 deg", **about))

    told = fault_of(plates())
    assert "(60 deg in n = 1); give 'back' an incidence of op.FOLLOWS" in told
    assert told.endswith("unless they say parallel=False)")
    plates(parallel=False).check()
    turning = plates(azimuth=op.Parameter("turn"))
    assert turning.trace(turn=[0.1, 0.5]).shape == (2,)
    where = "planes of incidence are one where azimuths come to 0 deg (parameter 'turn')"
    assert where in fault_of(turning, turn=[0.0, 0.1, 0.5])
    path = faces(GLASS, op.Interface(1.0, F, outside=2 * M))
    assert "outside is 2 * m = 1.6; give op.FOLLOWS for outside" in fault_of(path, m=0.8)
    path.trace(m=0.75)
    # No value of a parameter makes it the same as its double.
    fault = fault_of(faces(op.Interface(N, THETA), op.Interface(1.0, F, outside=2 * N)), n=1.5)
    assert "is lit from n = 1.5 (parameter 'n')" in fault
    assert fault.endswith("but its outside is 2 * n = 3; give op.FOLLOWS for outside")
    path = faces(op.Interface(2 * N, THETA), op.Interface(1.0, F, outside=1.5))
    assert "'back.in' is lit from 2 * n = 1.6 behind 'front'" in fault_of(path, n=0.8)
    front = op.Interface(op.Material(N, op.Parameter("k")), 0.3)
    path = faces(front, op.LayerStack([F, 1.2, 1.0], 0.1, parallel=False))
    path.trace(n=1.5, k=0.0)
    fault = fault_of(path, n=1.5, k=0.1)
    assert "with k = 0.1 (parameter 'k') behind 'front' (by 'front.transmitted')" in fault


@rows("late", [False, True])
def test_of_a_row_of_faults_only_the_first_is_told(late):
    pairs = itertools.pairwise([1.0, 1.5, 1.4, 1.6, 1.3, 1.7, 1.0])
    row = [op.Interface(n, THETA, outside, incidence_in=1.0) for outside, n in pairs]
    row[2] = replace(row[2], incidence=op.Parameter("t") if late else THETA, incidence_in=None)
    values = {"t": THETA} if late else {}
    assert "enters 'b2.in'" in fault_of(stack_of(*row, loops="refuse"), **values)


def test_a_second_face_that_forgets_its_medium_or_where_its_angle_is_measured_is_refused():
    fault = fault_of(faces(GLASS, op.Interface(1.0, THETA, incidence_in=1.0)))
    assert "'back.in' is lit from n = 1.5 behind 'front' (by 'front.transmitted')" in fault
    assert fault.endswith("its outside is 1; give outside = 1.5, or op.FOLLOWS for outside")
    fault = fault_of(faces(GLASS, WRONG))
    for part in (
        "'front.transmitted' enters 'back.in'",
        "n sin(incidence) is 0.6427876097 at 'front' and 0.9641814145 at 'back'",
        "give 'back' an incidence of op.FOLLOWS",
    ):
        assert part in fault


@rows(
    "back",
    [
        *(RIGHT, FOLLOWING, op.Interface(1.0, INSIDE, 1.5), op.Interface(1.0, F, op.Material(1.5))),
        op.LayerStack([1.5, 1.5, 1.0], THETA, incidence_in=1.0),
        op.LayerStack([F, 1.5, 1.0], F),
    ],
)
def test_a_slab_lets_through_0_912_however_its_second_face_is_written_rightly(back):
    # T_s and T_p of the two faces by Fresnel's printed formulas.
    once = np.sin(2 * THETA) * np.sin(2 * INSIDE) / np.sin(THETA + INSIDE) ** 2
    intensity = faces(GLASS, back).trace().intensity
    both = (once**2 + once**2 / np.cos(THETA - INSIDE) ** 4) / 2
    assert intensity == pytest.approx(both, rel=1e-14)
    assert f"{intensity:.3f}" == "0.912"


@rows(
    "between",
    [
        *(op.Medium(0.1, 1.0), op.Polarizer(0.3), op.Attenuator(0.5), op.Rotator(0.2), Window()),
        *(op.Retarder(0.3), op.Depolarizer(0.1), op.BeamSplitter(0.3), op.Combiner()),
        op.MuellerElement(np.eye(4)),
    ],
)
def test_what_light_goes_straight_through_stands_in_the_same_medium(between):
    fault = fault_of(faces(GLASS, op.Interface(1.0, THETA, incidence_in=1.0), between))
    assert "outside is 1; give outside = 1.5" in fault
    assert "n sin(incidence)" in fault_of(faces(GLASS, WRONG, between))
    faces(GLASS, FOLLOWING, between).check()
    # A mirror turns light but keeps it in its medium.
    told = fault_of(faces(GLASS, op.Interface(1.0, 0.7), op.Mirror()))
    assert "outside is 1; give outside = 1.5" in told
    faces(GLASS, op.Interface(1.0, 0.7, outside=1.5), op.Mirror()).check()


def test_what_light_meets_next_is_in_the_medium_it_is_in():
    first, second = op.Interface(1.5, 0.3), op.Interface(1.5, 0.9, outside=1.33)
    fault = fault_of(op.Source() >> first.named("first") >> second.named("second") >> EYE)
    assert "'second.in' is lit from n = 1 in front of 'first' (by 'first.reflected')" in fault
    fault = fault_of(faces(GLASS, op.Interface(1.6, THETA, incidence_in=1.0), enter="back"))
    assert "'back.back' is lit from n = 1.5 behind 'front'" in fault
    assert "its index is 1.6; give index = 1.5" in fault
    back = op.LayerStack([0.6, 1.0, 1.2], 0.1, parallel=False)
    for index in (0.6 + 2j, op.Material(0.6, 2.0)):
        fault = fault_of(faces(op.Interface(index, THETA), back))
        assert "'back.in' is lit from a medium that absorbs, with k = 2 behind 'front'" in fault
    metal = op.Interface(op.Material(0.6, op.Parameter("k")), THETA)
    assert "k = 2 (parameter 'k')" in fault_of(faces(metal, back), k=2.0)

    def unfolded(index, incidence, **about):
        path = faces(GLASS, FOLLOWING)
        path.add("again", op.Interface(index, incidence, **about)) >> path.add("R", op.Dump())
        path.connect("back.reflected", "again.back")
        return path

    unfolded(1.5, THETA).check()
    unfolded(1.5, 0.1, parallel=False).check()
    assert "its index is 1.6" in faults_of(unfolded(1.6, THETA))[0]
    assert "'back.reflected' enters 'again.back'" in faults_of(unfolded(1.5, 0.1))[0]
    # Two faces of one gap are parallel, whichever side they turn to it.
    ends = {"lamp": op.Source(), "a": op.Interface(1.5, 0.3), "b": op.Interface(1.5, 0.4)}
    links = "lamp -> a.back, a.reflected -> b, b.reflected -> a, b.transmitted -> eye"
    assert "n sin(incidence)" in fault_of(wired({**ends, "eye": EYE}, links, loops="sum"))


def test_faces_at_an_angle_say_so_by_a_flag_or_by_their_frames():
    def prism(**about):
        base = op.Interface(1.0, np.pi / 4, outside=F, **about)
        ends = {"lamp": op.Source(), "entry": FLAT, "base": base, "exit": op.Interface(1.0, 0.0, F)}
        links = "lamp -> entry, entry.transmitted -> base, base -> exit, exit.transmitted -> eye"
        return wired({**ends, "eye": EYE}, links)

    # Total reflection at the base, and 4 % lost at either face.
    assert prism(parallel=False).trace().intensity == pytest.approx(0.96**2, rel=1e-14)
    assert prism(parallel=False) != prism()
    assert "'entry.transmitted' enters 'base.in'" in faults_of(prism())[0]
    # A prism: the second face is not parallel, and its frames say so.
    along = op.Frame.from_direction(z=(0, 0, 1), x=(1, 0, 0))
    mirrored = op.Frame.from_direction(z=(0, 1, 0), x=(1, 0, 0))
    path, frames = op.PathGraph(), {"in": along, "transmitted": along}
    path.add("lamp", op.Source(), {"out": along}) >> path.add("front", FLAT, frames)
    base = op.Interface(1.0, np.pi / 4, outside=F)
    base = path.add("base", base, {"in": along, "reflected": mirrored})
    path["front.transmitted"] >> base >> path.add("eye", EYE, {"in": mirrored})
    assert path.trace().intensity == pytest.approx(0.96, rel=1e-14)


@rows("turn, is_parallel", [(0.0, True), (np.pi, True), (-np.pi, True), (0.5, False)])
def test_a_face_turned_about_the_light_has_another_plane_of_incidence(turn, is_parallel):
    # The turn may be given when the path runs, and turns add up along the way.
    known, late = (replace(WRONG, azimuth=azimuth) for azimuth in (turn, op.Parameter("turn")))
    for path, values in (
        (faces(GLASS, known), {}),
        (faces(GLASS, late), {"turn": turn}),
        (faces(GLASS, late, op.Polarizer(0, azimuth=0.5)), {"turn": turn - 0.5}),
    ):
        if is_parallel:
            assert "n sin(incidence)" in fault_of(path, **values)
        else:
            path.trace(**values)


def test_values_are_looked_at_whenever_they_are_given_and_give_nan_where_jax_traces():
    path = faces(*OPEN)
    path.check()
    good = {"n": 1.5, "m": 1.5, "theta": THETA, "phi": INSIDE}
    for _ in range(8):  # Long enough for functions and recipes to be made.
        path.trace(**good)
        path.trace(**{name: np.full(5, value) for name, value in good.items()})
    for wrong, told in (
        # An angle in a medium that is wrong itself says nothing.
        ({"m": 1.6}, r"n = 1\.5 \(.* 'n'\).* outside is 1\.6 \(parameter 'm'\); give op"),
        ({"phi": 0.1}, r"\(parameter 'phi'\)"),
        ({"n": np.full(5, 1.5), "m": [1.5, 1.5, 1.5, 1.6, 1.5]}, "but its outside is"),
        ({"n": np.nan}, "parameter 'n' is nan"),
    ):
        with pytest.raises(op.errors.ParameterError, match=told) as error:
            path.trace(**good | wrong)
        assert len(error.value.faults) == 1
    jax = pytest.importorskip("jax")
    plan = op.Composer(dtype="float32").compose(faces(*OPEN))

    @jax.jit
    def intensity(n, m, phi):
        return plan.run(n=n, m=m, theta=THETA, phi=phi).intensity

    assert float(intensity(1.5, 1.5, INSIDE)) == pytest.approx(0.9116117533, rel=1e-6)
    assert np.isnan(float(intensity(1.5, 1.6, INSIDE)))
    assert np.isnan(float(intensity(1.5, 1.5, THETA)))


@pytest.mark.parametrize("engine", slow_except(["numpy", "numba"], ENGINES))
def test_every_engine_refuses_media_that_do_not_meet(engine):
    plan = op.Composer(engine=engine).compose(faces(*OPEN))
    n = np.linspace(1.2, 1.8, 50)
    theta = np.linspace(0.0, 1.5, 50)
    phi = np.arcsin(np.sin(theta) / n)
    assert plan.run(n=n, m=n, theta=theta, phi=phi).stokes.shape == (50, 4)
    with pytest.raises(op.errors.ParameterError, match="is lit from n"):
        plan.run(n=n, m=n[::-1], theta=theta, phi=phi)
    for question in (plan.run_all, plan.mueller, plan.paths):
        with pytest.raises(op.errors.ParameterError, match="n sin"):
            question(n=1.5, m=1.5, theta=0.3, phi=0.3)


def test_angles_may_be_rounded_and_one_parameter_on_both_sides_is_not_looked_at():
    n, theta = np.float32(1.33), np.linspace(0.0, 1.5, 7, dtype=np.float32)
    faces(*OPEN).trace(n=n, m=1.33, theta=theta, phi=np.arcsin(np.sin(theta) / n))
    for digits in (3, 5, 7):
        assert faults_of(faces(GLASS, op.Interface(1.0, round(INSIDE, digits), outside=1.5)))
    # Next to grazing incidence, where a sine hardly changes.
    grazing = faces(op.Interface(1.0, np.radians(89.999)), op.Interface(1.0, np.pi / 2))
    assert "n sin(incidence)" in fault_of(grazing)
    # Of layers that may absorb one asks how much, and of dichroism whether light is lost.
    for preset in {*op.preset_names()} - {"absorbing-pile", "dichroic-sheet"}:
        assert op.load_preset(preset).compose().inputs.agreements == ()
    n, minus = op.Parameter("n"), -op.Parameter("theta")
    back = op.Interface(1.0, minus, outside=n, incidence_in=1.0)
    assert faces(op.Interface(n, minus), back).compose().inputs.agreements == ()
    other = op.Interface(1.0, op.Parameter("theta"), outside=n, incidence_in=1.0)
    # The other sign is another angle.
    assert len(faces(op.Interface(n, minus), other).compose().inputs.agreements) == 1


class Hand:
    """A stack of random media, whose faces are written in one of several right ways."""

    def __init__(self, seed):
        self.rng = rng = np.random.default_rng(seed)
        self.indices = [1.0, *rng.uniform(1.0, 2.0, rng.integers(1, 5)), 1.0]
        self.theta = float(rng.uniform(0.0, 1.4))
        self.values = {}
        self.faces = []
        for before, behind in zip(self.indices, self.indices[1:], strict=False):
            own = float(np.arcsin(np.sin(self.theta) / before))
            ways = [
                op.Interface(behind, self.theta, outside=before, incidence_in=1.0),
                op.Interface(behind, own, outside=before),
                op.Interface(op.Material(behind), self.given(own), outside=self.given(before)),
            ]
            if self.faces:
                ways.append(op.Interface(behind, F, outside=F))
            self.faces.append(ways[rng.integers(len(ways))])

    def given(self, value):
        """A constant, an array, or a parameter that is given it."""
        way = self.rng.integers(3)
        if way < 2:
            return (value, np.full(2, value))[way]
        name = f"p{len(self.values)}"
        self.values[name] = value
        return op.Parameter(name)

    def traced(self):
        row, rng = {}, self.rng
        for number, face in enumerate(self.faces):
            for place in range(rng.integers(3) if number else 0):
                row[f"between {number}{place}"] = LOSSLESS[rng.integers(len(LOSSLESS))]
            row[f"face {number}"] = face
        path = in_a_row(row)
        for number in range(1, len(self.faces)):
            path.connect(f"face {number}.reflected", f"face {number - 1}.back")
        # A face may be written in another way than the one that they were drawn for.
        return path.trace(**{name: self.values[name] for name in path.parameters})


@settings(max_examples=12)
@given(seed=SEEDS)
def test_faces_written_rightly_by_hand_are_the_stack(seed):
    hand = Hand(seed)
    whole = op.LayerStack(hand.indices, hand.theta).mueller("in", "transmitted").matrix[:, 0]
    light = hand.traced()
    expected = np.broadcast_to(whole, light.stokes.shape)
    np.testing.assert_allclose(light.stokes, expected, rtol=0, atol=2e-14)


@settings(max_examples=50)
@given(seed=SEEDS, wrong=st.sampled_from(["outside", "index", "incidence"]))
def test_one_wrong_medium_or_angle_of_a_stack_by_hand_is_refused(seed, wrong):
    hand = Hand(seed)
    # A face that follows another has nothing of its own that could be wrong but its index.
    own = [n for n, face in enumerate(hand.faces) if n and face.outside is not F]
    number = hand.rng.choice(own) if own and wrong != "index" else 0
    assume(number or wrong == "index")
    face = hand.faces[number]
    change = 1.0 + 10.0 ** hand.rng.uniform(-6, -1)
    if wrong == "incidence":
        measured_in = 1.0 if face.incidence_in is not None else hand.indices[number]
        angle = np.arcsin(np.sin(hand.theta) / measured_in)
        hand.faces[number] = replace(face, incidence=float(angle / change))
    elif wrong == "outside":
        hand.faces[number] = replace(face, outside=hand.indices[number] * change)
    else:
        hand.faces[0] = replace(face, index=hand.indices[1] * change)
        if len(hand.faces) > 1 and hand.faces[1].outside is F:
            hand.faces[1] = replace(hand.faces[1], outside=hand.indices[1])
    with pytest.raises(op.OptipathError, match=r"is lit from n|n sin\(incidence\)"):
        hand.traced()

"""Paths run the other way, and the theorem of reciprocity between both."""

import re

import numpy as np
import pytest

import optipath as op
from reciprocal_paths import ReciprocalPath, matrices_there_and_back
from tables import rows
from wired import read_back, wired

WEDGES = r"n sin\(incidence\)|parallel=False|light goes to and fro between"
CORNER = np.array([[0, 0, 0], [0, 0, 2.0], [0.1, 2.2, 2], [2.5, 2.0, 2.2]])


class Faraday(op.Element):
    """A rotation that changes its sign, written as a user would."""

    angle: op.Angle
    mirrored = ("angle",)

    @staticmethod
    def mueller_rows(xp, angle):
        c, s = xp.cos(2.0 * angle), xp.sin(2.0 * angle)
        return (1, 0, 0, 0), (0, c, -s, 0), (0, s, c, 0), (0, 0, 0, 1)


def same_matrix(path, *, atol=1e-14, **values):
    """Whether the matrix of the reversed path is the reversed matrix of the path."""
    there, back = path.mueller(**values).reversed(), path.reversed().mueller(**values)
    np.testing.assert_allclose(back.matrix, there.matrix, rtol=0, atol=atol)
    return True


def same_frames(path, **values):
    """Whether both matrices are the same, with frames that are not turned to each other."""
    there, back = path.mueller(**values).reversed(), path.reversed().mueller(**values)
    for first, second in ((there.frame_in, back.frame_in), (there.frame_out, back.frame_out)):
        np.testing.assert_allclose(first.turn_to(second), (1.0, 0.0), atol=1e-14)
    return same_matrix(path, atol=1e-15, **values)


def turns_of(path):
    return {(a, b): turn for a, b, turn in path.graph.edges(data="azimuth")}


@pytest.mark.parametrize("count", [60, pytest.param(1000, marks=pytest.mark.slow)])
@pytest.mark.filterwarnings("ignore::optipath.AngleWarning")
def test_random_graphs_obey_the_theorem_of_reciprocity_and_stay_what_they_were(count):
    refused = 0
    for seed in range(1, count + 1):
        drawn = ReciprocalPath(seed)
        path = drawn.path()
        before = path.to_toml()
        try:
            pairs = list(matrices_there_and_back(path, drawn.values))
        except (op.PathError, op.ParameterError) as error:
            # Which faces are parallel cannot be said of every wedge; that is told.
            assert re.search(WEDGES, str(error))  # noqa: PT017
            refused += 1
            continue
        assert path.to_toml() == before
        for there, back in pairs:
            apart = abs(there.matrix - back.matrix).max()
            assert apart <= 1e-13 * there.matrix[0, 0], seed
    assert refused <= count // 10


@rows("rotator", [op.FaradayRotator(0.4), Faraday(0.4)])
def test_with_a_faraday_rotator_the_theorem_does_not_hold(rotator):
    path = op.Source() >> op.Polarizer(0.0) >> rotator >> op.Polarizer(0.7) >> op.Detector()
    there, back = path.mueller().reversed().matrix, path.reversed().mueller().matrix
    assert there[0, 0] == pytest.approx(0.5 * np.cos(0.3) ** 2)
    assert back[0, 0] == pytest.approx(0.5 * np.cos(1.1) ** 2)
    for seed in range(12):
        rng = np.random.default_rng(seed)
        chain = op.Source()
        for _ in range(3):
            chain = chain >> op.Retarder(*rng.uniform(0.3, 2.0, 2))
            chain = chain >> op.Diattenuator(0.9, 0.1, 0.4) >> rotator
        path = chain >> op.Detector()
        there, back = path.mueller().reversed().matrix, path.reversed().mueller().matrix
        assert abs(there - back).max() > 1e-3 * there[0, 0], seed
    # An isolator lets light through one way.
    eighth = np.pi / 4
    path = op.Source() >> op.Polarizer(0.0) >> op.FaradayRotator(eighth) >> op.Polarizer(eighth)
    path = path >> op.Detector()
    assert path.trace().intensity == pytest.approx(0.5)
    assert path.reversed().trace().intensity < 1e-30


def test_faces_and_azimuths_stand_on_the_way_back_as_they_did():
    plate, foil = op.Retarder(1.0, 0.2, azimuth=0.3), op.Polarizer(0.5, leakage=0.1)
    ends = {"lamp": op.Source(), "plate": plate, "foil": foil}
    ends |= {"pane": op.Interface(1.5, 0.7, azimuth=-0.6), "eye": op.Detector()}
    path = wired(ends, "lamp -> plate, foil -> pane")
    path.connect("plate", "foil", azimuth=0.4)
    path.connect("pane", "eye", azimuth=0.9)
    assert turns_of(path.reversed()) == {
        ("eye", "pane"): 0.9,
        ("pane", "foil"): -0.6,
        ("foil", "plate"): 0.4,
        ("plate", "lamp"): 0.3,
    }
    assert same_matrix(path)
    there = op.plane_of_incidence((0, 0, 1), (0, 1, -1))
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(), {"out": there.arriving.turned(0.3)})
    frames = {"in": there.arriving, "reflected": there.reflected}
    pane = path.add("pane", op.Interface(0.2 + 3j, there.incidence), frames)
    lamp >> pane >> path.add("eye", op.Detector())
    assert same_matrix(path, atol=1e-15)
    there, back = path.mueller().reversed(), path.reversed().mueller()
    assert (back.frame_in, back.frame_out) == (there.frame_in, there.frame_out)
    path = two_faces(op.Interface(1.5, 0.7), op.Interface(1.0, 0.4, outside=1.5, parallel=False))
    back = path.reversed()
    assert [back.element(name).parallel for name in ("front", "rear")] == [False, True]
    assert same_matrix(path)
    assert back.reversed() == path
    front = op.Interface(op.Parameter("n", 1.5), 0.7)
    path = two_faces(front, op.Interface(1.0, op.FOLLOWS, outside=op.FOLLOWS))
    rear = path.reversed().element("rear")
    assert (rear.outside, rear.incidence, rear.incidence_in) == (op.Parameter("n", 1.5), 0.7, 1.0)
    assert same_matrix(path, n=np.array([1.3, 1.7]))


def test_a_path_back_and_forth_is_the_same_in_every_place_of_a_node():
    drawn = ReciprocalPath(3)
    once = drawn.path().reversed().reversed()
    assert once.reversed().reversed() == once
    path = op.Source(stokes=(1, 1, 0, 0)) >> op.Retarder(op.Parameter("r"), 0.3) >> op.Detector()
    assert path.reversed().reversed(path.element("source")) == path
    # One element in two places is reversed once.
    plate = op.Retarder(1.0, 0.3)
    back = (op.Source() >> plate >> plate >> op.Detector()).reversed()
    assert back.element("retarder") is back.element("retarder-2")
    assert same_matrix(op.load_preset("fresnel-rhomb"))
    for preset in ("glass-slab", "pile-of-plates"):
        path = op.load_preset(preset)
        back = path.reversed()
        (lamp,) = (name for name in path if not path.element(name).inputs)
        for name in (name for name in path if not path.element(name).outputs):
            there, found = path.mueller(lamp, name).reversed(), back.mueller(name, lamp)
            np.testing.assert_allclose(found.matrix, there.matrix, atol=1e-15)
    ends = {"lamp": op.Source(), "split": op.BeamSplitter(0.3, azimuth=0.2)}
    ends |= {"plate": op.Retarder(1.0, 0.3, azimuth=0.4), "foil": op.Diattenuator(0.9, 0.4, 0.7)}
    links = "lamp -> split, split.transmitted -> plate, plate -> foil, split.reflected -> eye"
    path = wired({**ends, "eye": op.Detector()}, links, loops="sum")
    path.connect("foil", "split.back", azimuth=0.5)
    assert path.reversed().loops == "sum"
    assert same_matrix(path)
    for place in ("lamp", "between", "eye"):
        chosen = placed().bind(place=place).mueller().reversed()
        found = placed().reversed().bind(place=place).mueller()
        np.testing.assert_allclose(found.matrix, chosen.matrix, atol=1e-15)
    path = placed(azimuth=0.4)
    path.cases["one"] = op.Case({"place": "eye"})
    back = path.reversed()
    assert not back.choices
    assert not back.cases
    assert same_matrix(path)
    assert same_matrix(path.bind(place="eye"))


def two_faces(front, rear):
    ends = {"lamp": op.Source(), "front": front, "rear": rear, "eye": op.Detector()}
    return wired(ends, "lamp -> front, front.transmitted -> rear, rear.transmitted -> eye")


def test_chains_of_points_go_back_with_their_points_and_media():
    path = op.path_from_vertices(CORNER, [1.5, 0.2 + 3j])
    assert same_frames(path)
    back = path.reversed()
    assert back.element("vertex1").vertices is back.element("vertex2").vertices
    several = np.array([1.5, 1.6])
    points = [[0, 0, 0], [0, 0, 2.0], [0.0, 0.0, 4.0], [0.0, 0.0, 5.0], [0.0, 0.0, 7.0]]
    path = op.path_from_vertices(points, [several, 1.3, several], events="TTT")
    back = path.reversed()
    for place, medium in ((3, 1.3), (2, several), (1, 1.0)):
        np.testing.assert_array_equal(back.element(f"vertex{place}").index, medium)
    assert same_matrix(path)
    points = [[0, 0, 0], [0, 0, 2.0], [0.1, 0.2, 4], [0.5, -1.0, 2.2], [1, -2.0, -1.0]]
    path = op.path_from_vertices(points, [1.5, 0.2 + 3j, 1.0], events="TRT")
    last, first = (path.reversed().element(f"vertex{k}") for k in (3, 1))
    assert [(last.outside, last.index), (first.outside, first.index)] == [(1.0, 1.5), (1.5, 1.0)]
    assert same_matrix(path)


@rows("aside", [0.0, 0.2])
@rows("order", [1, -1])
def test_what_stands_beside_a_vertex_without_a_plane_stands_as_it_did(order, aside):
    # At one vertex light is turned aside; at the other it comes back along its way.
    points = np.array([[0.3, 0, 0], [0, 0, 2.0], [0.0, 2.2, 2.0], [aside, 0.3, 2.0]])[::order]
    ends = {"lamp": op.Source(), "first": op.Polarizer(0.4, 0.3)}
    ends |= {
        "one": op.SpecularVertex(0.2 + 3j, points, 1),
        "two": op.SpecularVertex(1.5, points, 2),
    }
    ends |= {"last": op.Diattenuator(0.9, 0.2, 0.4), "eye": op.Detector()}
    path = wired(ends, "lamp -> first, first -> one, one -> two, two -> last, last -> eye")
    assert same_matrix(path)
    beside, vertex = ("one", "first") if order == -1 else ("last", "two")
    assert (turns_of(path.reversed())[beside, vertex] is None) == (aside > 0.0)


ANGLES = op.VerticesByAngles((op.Parameter("a"), 0.7, 1.2), (0.4, op.Parameter("b")))


@rows("a, b", [(0.3, 1.0), (0.0, -2.0), (np.pi / 2, 0.3)])
def test_a_chain_by_angles_goes_back_through_the_same_points(a, b):
    path = op.path_from_vertices(ANGLES, [1.5, 0.2 + 3j, 1.5])
    assert same_frames(path, a=a, b=b)
    back = path.reversed()
    assert back.reversed().reversed() == back


@rows("preset, backwards", [("npgr026", 0), ("npgr026-3d", 1)])
def test_a_reversed_path_is_written_and_read_back(preset, backwards, tmp_path):
    back = op.load_preset(preset).reversed()
    assert read_back(back, tmp_path) == back
    assert ("backwards = true" in back.to_toml()) == backwards


def test_light_begins_at_the_detectors_and_parameters_cases_and_words_stay():
    ends = {"eye": op.Detector("intensity"), "wall": op.Dump()}
    path = wired(
        {"lamp": op.Source(7.0), "split": op.BeamSplitter(0.3), **ends},
        "lamp -> split, split.transmitted -> eye, split.reflected -> wall",
    )
    assert path.reversed().trace().intensity == pytest.approx(0.7)
    assert path.reversed(op.Source(10.0)).trace().intensity == pytest.approx(7.0)
    both = path.reversed({"eye": op.Source(10.0), "wall": op.Source(20.0)})
    assert both.trace().intensity == pytest.approx(13.0)
    assert path.reversed().reversed().element("wall") == op.Dump()
    assert both.element("lamp") == op.Detector()
    path = op.load_preset("npgr026")
    back = path.reversed()
    assert {**path.parameters, "intensity": None} == {**back.parameters, "intensity": None}
    assert back.description == path.description
    assert back.cases["8"].values["delta"] == path.cases["8"].values["delta"]
    assert "intensity" not in back.parameters
    assert not back.cases["8"].published
    assert same_matrix(path, atol=1e-16, delta=0.4, rho=0.3, filter=0.2)
    back = (op.Source() >> op.Polarizer(op.Parameter("a")) >> op.Detector()).reversed()
    for angles in ("diagonal", ["diagonal", "vertical"]):
        degrees = {"diagonal": 45.0, "vertical": 90.0}
        numbers = np.radians(np.vectorize(degrees.get)(angles))
        wanted = np.asarray(back.trace(a=numbers).stokes)
        np.testing.assert_array_equal(back.trace(a=angles).stokes, wanted)
        np.testing.assert_array_equal(back.bind(a=angles).trace().stokes, wanted)
    np.testing.assert_allclose(back.trace(a="diagonal").S2, -0.5, rtol=1e-15)


def placed(*, azimuth=0.0):
    path = op.Source() >> op.Polarizer(0.2) >> op.Retarder(1.0, 0.3, azimuth) >> op.Mirror()
    path = path >> op.Detector()
    behind = {"lamp": "source.out", "between": "retarder.out", "eye": "mirror.reflected"}
    path.offer("place", "polarizer", behind)
    return path


class Unsaid(op.Element):
    mueller_rows = Faraday.__dict__["mueller_rows"]
    angle: op.Angle = 0.0


class Fork(op.Element):
    outputs = ("left", "right")
    natural = "left"
    mirrored = ()

    def couplings(self):
        half = op.Attenuator(0.5).couplings()[0].operations
        return tuple(op.Coupling("in", way, half) for way in self.outputs)


def test_what_cannot_go_back_is_told_at_once_with_cures_that_do():
    ends = {"lamp": op.Source(), "mine": Unsaid(), "fork": Fork(), "both": op.Combiner()}
    path = wired(
        {**ends, "eye": op.Detector(), "second": op.Source(), "tap": op.Detector()},
        "lamp -> mine, mine -> fork, fork.left -> both, fork.right -> both, both -> eye, "
        "second -> eye",
    )
    path.connect("mine", "tap", tap=True)
    with pytest.raises(op.PathError) as caught:
        path.reversed({"ey": op.Source(), "tap": op.Detector()})
    told = caught.value.faults
    for sentence in (
        "source['ey']: no light ends there; did you mean 'eye'?",
        "source['tap'] must be a Source, not Detector(reads='stokes', response=None)",
        "'mine': element class Unsaid does not say what changes its sign on the way back; write",
        "'both': combiner adds up light without loss, which has no way back; put a BeamSplitter",
        "link 'mine.out -> tap.in' is a tap, which takes nothing of the light",
        "light of 'both.out' and 'second.out' adds up at 'eye.in', which has no way back",
        "'fork': element class Fork does not say by which port light goes back; give it a class",
    ):
        assert any(sentence in fault for fault in told), sentence
    path = op.Source() >> op.Polarizer() >> op.Detector()
    ends = {"plate": op.Retarder(1.0), "cube": op.BeamSplitter()}
    ends |= {name: op.Detector() for name in ("one", "other", "within")}
    for name, element in ends.items():
        path.add(name, element)
    path.connect("polarizer", "plate", tap=True)
    path.connect("plate", "cube")
    path.connect("cube.transmitted", "one")
    path.connect("cube.reflected", "other")
    path.connect("plate", "within", tap=True)
    path.trace_all()
    with pytest.raises(op.PathError) as caught:
        path.reversed()
    (fault,) = caught.value.faults
    for cure in fault.partition("take it out, ")[2].split(" and "):
        eval(cure, {"path": path})  # noqa: S307
    assert [*path] == ["source", "polarizer", "detector"]
    assert same_matrix(path)


class Raising(Fork):
    inputs = ("in",)
    outputs = ("out",)
    natural = "out"

    def reversed(self):
        return {}["nothing"]


class Wrong(Raising):
    def reversed(self):
        return 3


class Elsewhere(Raising):
    def reversed(self):
        return op.Mirror()


def through(element):
    return op.Source() >> element.named("mine") >> op.Detector().named("eye")


def split():
    path = op.Source() >> op.BeamSplitter()
    path["beam-splitter.transmitted"] >> op.Detector()
    path["beam-splitter.reflected"] >> op.Detector()
    return path


OWN = "element class "
NO_SOURCE = "must be a Source"


@rows(
    "path, source, sentence",
    [
        (split(), op.Source(), re.escape("give it by name, source={'detector': ...}")),
        *((through(op.Mirror()), source, NO_SOURCE) for source in (3, "lamp", op.Mirror())),
        (through(op.Mirror()), {3: op.Source()}, "no light ends there"),
        (through(op.Mirror()), {"eye": 2.0}, NO_SOURCE),
        (through(Raising()), None, rf"reversed\(\) of {OWN}Raising"),
        (through(Wrong()), None, rf"reversed\(\) of {OWN}Wrong gives 3; return an element"),
        (
            *(through(Elsewhere()), None),
            f"'mine': {OWN}Elsewhere does not say by which port light goes back",
        ),
    ],
)
def test_light_that_is_no_source_and_what_ones_own_class_gives_are_told(path, source, sentence):
    with pytest.raises(op.PathError, match=sentence):
        path.reversed(source)
    if sentence == NO_SOURCE:
        assert path.reversed({}) == path.reversed()


REPLACED = "path.replace('photometer', op.Detector())"


@rows(
    "preset, cures",
    [
        ("faraday-isolator", ["path.remove('passed')"]),
        ("ellipsometer-pcsa", ["path.remove('state')", REPLACED]),
    ],
)
def test_the_cures_of_a_preset_with_a_tap_leave_a_path_that_runs_both_ways(preset, cures):
    path = op.load_preset(preset)
    with pytest.raises(op.PathError) as caught:
        path.reversed()
    for cure, fault in zip(cures, caught.value.faults, strict=True):
        assert fault.endswith(cure)
        eval(cure, {"path": path, "op": op})  # noqa: S307
    path.trace()
    path.reversed().trace()

"""Paths run the other way, the theorem of reciprocity between both, and ways there and back."""

import re

import numpy as np
import pytest

import optipath as op
from reciprocal_paths import ReciprocalPath, matrices_there_and_back
from tables import rows, slow
from wired import read_back, wired

WEDGES = r"n sin\(incidence\)|parallel=False|light goes to and fro between"
QUARTER, LINEAR = np.pi / 2, (1, 1, 0, 0)
NO_SOURCE = "must be a Source"
CORNER = np.array([[0, 0, 0], [0, 0, 2.0], [0.1, 2.2, 2], [2.5, 2.0, 2.2]])


class Faraday(op.Element):
    """A rotation that changes its sign, written as a user would."""

    angle: op.fields.Angle
    mirrored = ("angle",)

    @staticmethod
    def mueller_rows(xp, angle):
        c, s = xp.cos(2.0 * angle), xp.sin(2.0 * angle)
        return (1, 0, 0, 0), (0, c, -s, 0), (0, s, c, 0), (0, 0, 0, 1)


def assert_same(path, *, atol=1e-14, frames=False, **values):
    """Whether the matrix of the reversed path is the reversed matrix of the path, in its frames."""
    there, back = path.mueller(**values).reversed(), path.reversed().mueller(**values)
    np.testing.assert_allclose(back.matrix, there.matrix, rtol=0, atol=atol)
    for end in ("frame_in", "frame_out") if frames else ():
        turn = getattr(there, end).turn_to(getattr(back, end))
        np.testing.assert_allclose(turn, (1.0, 0.0), atol=1e-14)


def turns_of(path):
    return {(a, b): turn for a, b, turn in path.graph.edges(data="azimuth")}


@pytest.mark.parametrize("count", [25, slow(1000)])
@pytest.mark.filterwarnings("ignore::optipath.errors.AngleWarning")
def test_random_graphs_obey_the_theorem_of_reciprocity_and_stay_what_they_were(count):
    refused = 0
    for seed in range(1, count + 1):
        drawn = ReciprocalPath(seed)
        path = drawn.path()
        before = path.to_toml()
        try:
            pairs = list(matrices_there_and_back(path, drawn.values))
        except (op.errors.PathError, op.errors.ParameterError) as error:
            # Which faces are parallel cannot be said of every wedge; that is told.
            assert re.search(WEDGES, str(error))  # noqa: PT017
            refused += 1
            continue
        assert path.to_toml() == before
        for there, back in pairs:
            assert abs(there.matrix - back.matrix).max() <= 1e-13 * there.matrix[0, 0], seed
    assert refused <= count // 10


@rows("rotator", [op.FaradayRotator(0.4), Faraday(0.4)])
def test_with_a_faraday_rotator_the_theorem_does_not_hold(rotator):
    path = op.Source() >> op.Polarizer(0.0) >> rotator >> op.Polarizer(0.7) >> op.Detector()
    lights = path.trace().intensity, path.reversed().trace().intensity
    assert lights == pytest.approx((0.5 * np.cos(0.3) ** 2, 0.5 * np.cos(1.1) ** 2))
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
    path = op.Source() >> op.Polarizer(0.0) >> op.FaradayRotator(np.pi / 4)
    path = path >> op.Polarizer(np.pi / 4) >> op.Detector()
    lights = path.trace().intensity, path.reversed().trace().intensity
    assert lights == pytest.approx((0.5, 0.0), abs=1e-30)


def test_faces_and_azimuths_stand_on_the_way_back_as_they_did():
    plate, foil = op.Retarder(1.0, 0.2, azimuth=0.3), op.Polarizer(0.5, leakage=0.1)
    pane = op.Interface(1.5, 0.7, azimuth=-0.6)
    ends = {"lamp": op.Source(), "plate": plate, "foil": foil, "pane": pane, "eye": op.Detector()}
    path = wired(ends, "lamp -> plate, foil -> pane")
    path.connect("plate", "foil", azimuth=0.4)
    path.connect("pane", "eye", azimuth=0.9)
    turns = {("eye", "pane"): 0.9, ("pane", "foil"): -0.6, ("foil", "plate"): 0.4}
    assert turns_of(path.reversed()) == turns | {("plate", "lamp"): 0.3}
    assert_same(path)
    there = op.plane_of_incidence((0, 0, 1), (0, 1, -1))
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(), {"out": there.arriving.turned(0.3)})
    frames = {"in": there.arriving, "reflected": there.reflected}
    pane = path.add("pane", op.Interface(0.2 + 3j, there.incidence), frames)
    lamp >> pane >> path.add("eye", op.Detector())
    assert_same(path, atol=1e-15)
    there, back = path.mueller().reversed(), path.reversed().mueller()
    assert (back.frame_in, back.frame_out) == (there.frame_in, there.frame_out)
    path = two_faces(op.Interface(1.5, 0.7), op.Interface(1.0, 0.4, outside=1.5, parallel=False))
    back = path.reversed()
    assert [back.element(name).parallel for name in ("front", "rear")] == [False, True]
    assert_same(path)
    assert back.reversed() == path
    front = op.Interface(op.Parameter("n", 1.5), 0.7)
    path = two_faces(front, op.Interface(1.0, op.FOLLOWS, outside=op.FOLLOWS))
    rear = path.reversed().element("rear")
    assert (rear.outside, rear.incidence, rear.incidence_in) == (op.Parameter("n", 1.5), 0.7, 1.0)
    assert_same(path, n=np.array([1.3, 1.7]))


def test_a_path_back_and_forth_is_the_same_in_every_place_of_a_node():
    once = ReciprocalPath(3).path().reversed().reversed()
    assert once.reversed().reversed() == once
    path = op.Source(stokes=(1, 1, 0, 0)) >> op.Retarder(op.Parameter("r"), 0.3) >> op.Detector()
    assert path.reversed().reversed(path.element("source")) == path
    # One element in two places is reversed once.
    plate = op.Retarder(1.0, 0.3)
    back = (op.Source() >> plate >> plate >> op.Detector()).reversed()
    assert back.element("retarder") is back.element("retarder-2")
    assert_same(op.load_preset("fresnel-rhomb"))
    for preset in ("glass-slab", "pile-of-plates"):
        path = op.load_preset(preset)
        (lamp,) = (name for name in path if not path.element(name).inputs)
        for name in (name for name in path if not path.element(name).outputs):
            there, back = path.mueller(lamp, name).reversed(), path.reversed().mueller(name, lamp)
            np.testing.assert_allclose(back.matrix, there.matrix, atol=1e-15)
    ends = {"lamp": op.Source(), "split": op.BeamSplitter(0.3, azimuth=0.2)}
    ends |= {"plate": op.Retarder(1.0, 0.3, azimuth=0.4), "foil": op.Diattenuator(0.9, 0.4, 0.7)}
    links = "lamp -> split, split.transmitted -> plate, plate -> foil, split.reflected -> eye"
    path = wired({**ends, "eye": op.Detector()}, links, loops="sum")
    path.connect("foil", "split.back", azimuth=0.5)
    assert path.reversed().loops == "sum"
    assert_same(path)
    for place in ("lamp", "between", "eye"):
        chosen = placed().bind(place=place).mueller().reversed()
        found = placed().reversed().bind(place=place).mueller()
        np.testing.assert_allclose(found.matrix, chosen.matrix, atol=1e-15)
    path = placed(azimuth=0.4)
    path.cases["one"] = op.Case({"place": "eye"})
    assert ({**path.reversed().choices}, path.reversed().cases) == ({}, {})
    assert_same(path)
    assert_same(path.bind(place="eye"))


def two_faces(front, rear):
    ends = {"lamp": op.Source(), "front": front, "rear": rear, "eye": op.Detector()}
    return wired(ends, "lamp -> front, front.transmitted -> rear, rear.transmitted -> eye")


def test_chains_of_points_go_back_with_their_points_and_media():
    path = op.path_from_vertices(CORNER, [1.5, 0.2 + 3j])
    assert_same(path, atol=1e-15, frames=True)
    back = path.reversed()
    assert back.element("vertex1").vertices is back.element("vertex2").vertices
    several, points = np.array([1.5, 1.6]), [[0.0, 0, z] for z in (0, 2, 4, 5, 7)]
    path = op.path_from_vertices(points, [several, 1.3, several], events="TTT")
    back = path.reversed()
    for place, medium in ((3, 1.3), (2, several), (1, 1.0)):
        np.testing.assert_array_equal(back.element(f"vertex{place}").index, medium)
    assert_same(path)
    points = [[0, 0, 0], [0, 0, 2.0], [0.1, 0.2, 4], [0.5, -1.0, 2.2], [1, -2.0, -1.0]]
    path = op.path_from_vertices(points, [1.5, 0.2 + 3j, 1.0], events="TRT")
    last, first = (path.reversed().element(f"vertex{k}") for k in (3, 1))
    assert [(last.outside, last.index), (first.outside, first.index)] == [(1.0, 1.5), (1.5, 1.0)]
    assert_same(path)


@rows("aside", [0.0, 0.2])
@rows("order", [1, -1])
def test_what_stands_beside_a_vertex_without_a_plane_stands_as_it_did(order, aside):
    # At one vertex light is turned aside; at the other it comes back along its way.
    points = np.array([[0.3, 0, 0], [0, 0, 2.0], [0.0, 2.2, 2.0], [aside, 0.3, 2.0]])[::order]
    one, two = op.SpecularVertex(0.2 + 3j, points, 1), op.SpecularVertex(1.5, points, 2)
    path = op.Source() >> op.Polarizer(0.4, 0.3).named("first") >> one.named("one")
    path = path >> two.named("two") >> op.Diattenuator(0.9, 0.2, 0.4).named("last") >> op.Detector()
    assert_same(path)
    beside, vertex = ("one", "first") if order == -1 else ("last", "two")
    assert (turns_of(path.reversed())[beside, vertex] is None) == (aside > 0.0)


def test_a_chain_by_angles_goes_back_through_the_same_points_and_files_know_it(tmp_path):
    angles = op.VerticesByAngles((op.Parameter("a"), 0.7, 1.2), (0.4, op.Parameter("b")))
    path = op.path_from_vertices(angles, [1.5, 0.2 + 3j, 1.5])
    for a, b in ((0.3, 1.0), (0.0, -2.0), (np.pi / 2, 0.3)):
        assert_same(path, atol=1e-15, frames=True, a=a, b=b)
    back = path.reversed()
    assert back.reversed().reversed() == back
    for preset, backwards in (("npgr026", False), ("npgr026-3d", True)):
        back = op.load_preset(preset).reversed()
        assert read_back(back, tmp_path) == back
        assert ("backwards = true" in back.to_toml()) == backwards


def test_light_begins_at_the_detectors_and_parameters_cases_and_words_stay():
    ends = {"lamp": op.Source(7.0), "split": op.BeamSplitter(0.3), "eye": op.Detector("intensity")}
    links = "lamp -> split, split.transmitted -> eye, split.reflected -> wall"
    path = wired({**ends, "wall": op.Dump()}, links)
    both = path.reversed({"eye": op.Source(10.0), "wall": op.Source(20.0)})
    backs = path.reversed(), path.reversed(op.Source(10.0)), both
    assert [back.trace().intensity for back in backs] == pytest.approx([0.7, 7.0, 13.0])
    ends = path.reversed().reversed().element("wall"), both.element("lamp")
    assert ends == (op.Dump(), op.Detector())
    path = op.load_preset("npgr026")
    back = path.reversed()
    assert {**path.parameters, "intensity": None} == {**back.parameters, "intensity": None}
    assert back.description == path.description
    assert back.cases["8"].values["delta"] == path.cases["8"].values["delta"]
    assert "intensity" not in back.parameters
    assert not back.cases["8"].published
    assert_same(path, atol=1e-16, delta=0.4, rho=0.3, filter=0.2)
    back = (op.Source() >> op.Polarizer(op.Parameter("a")) >> op.Detector()).reversed()
    for angles, degrees in (("diagonal", 45.0), (["diagonal", "vertical"], [45.0, 90.0])):
        wanted = back.trace(a=np.radians(degrees)).stokes
        for light in (back.trace(a=angles), back.bind(a=angles).trace()):
            np.testing.assert_array_equal(light.stokes, wanted)
    np.testing.assert_allclose(back.trace(a="diagonal").S2, -0.5, rtol=1e-15)


def placed(*, azimuth=0.0):
    path = op.Source() >> op.Polarizer(0.2) >> op.Retarder(1.0, 0.3, azimuth) >> op.Mirror()
    path = path >> op.Detector()
    behind = {"lamp": "source.out", "between": "retarder.out", "eye": "mirror.reflected"}
    path.offer("place", "polarizer", behind)
    return path


class Unsaid(op.Element):
    mueller_rows = Faraday.__dict__["mueller_rows"]
    angle: op.fields.Angle = 0.0


class Fork(op.Element):
    outputs = ("left", "right")
    natural = "left"
    mirrored = ()

    def couplings(self):
        half = op.Attenuator(0.5).couplings()[0].operations
        return tuple(op.Coupling("in", way, half) for way in self.outputs)


def test_what_cannot_go_back_is_told_at_once_with_cures_that_do():
    ends = {"lamp": op.Source(), "mine": Unsaid(), "fork": Fork(), "both": op.Combiner()}
    ends |= {"eye": op.Detector(), "second": op.Source(), "tap": op.Detector()}
    links = "lamp -> mine, mine -> fork, fork.left -> both, fork.right -> both, both -> eye"
    path = wired(ends, f"{links}, second -> eye")
    path.connect("mine", "tap", tap=True)
    with pytest.raises(op.errors.PathError) as caught:
        path.reversed({"ey": op.Source(), "tap": op.Detector()})
    told = caught.value.faults
    for sentence in (
        "source['ey']: no light ends there; did you mean 'eye'?",
        "source['tap'] must be a Source, not Detector(",
        "'mine': element class Unsaid does not say what changes its sign on the way back; write",
        "'both': combiner adds up light without loss, which has no way back; put a BeamSplitter",
        "link 'mine.out -> tap.in' is a tap, which has no way back; take it out",
        "light of 'both.out' and 'second.out' adds up at 'eye.in', which has no way back",
        "'fork': element class Fork does not say by which port light goes back; give it a class",
    ):
        assert any(sentence in fault for fault in told), sentence


class Given(Fork):
    outputs = ("out",)
    natural = "out"

    def reversed(self):
        return self.given()


def through(element):
    return op.Source() >> element.named("mine") >> op.Detector().named("eye")


def giving(given):
    """A path through an element of a class of one's own that gives this where it goes back."""
    return through(type("Mine", (Given,), {"given": lambda _: given()})())


def split():
    path = op.Source() >> op.BeamSplitter()
    path["beam-splitter.transmitted"] >> op.Detector()
    path["beam-splitter.reflected"] >> op.Detector()
    return path


@rows(
    "path, source, sentence",
    [
        (split(), op.Source(), "of one of 2 detectors; give it by name"),
        *((through(op.Mirror()), source, NO_SOURCE) for source in (3, op.Mirror(), {"eye": 2.0})),
        (through(op.Mirror()), {3: op.Source()}, "no light ends there"),
        (giving({}.popitem), None, r"reversed\(\) of element class Mine"),
        (giving(lambda: 3), None, r"reversed\(\) of element class Mine gives 3; return an element"),
        (giving(op.Mirror), None, "'mine': element class Mine does not say by which port light go"),
    ],
)
def test_light_that_is_no_source_and_what_ones_own_class_gives_are_told(path, source, sentence):
    with pytest.raises(op.errors.PathError, match=sentence):
        path.reversed(source)
    if sentence == NO_SOURCE:
        assert path.reversed({}) == path.reversed()


def twice(*elements, stokes=LINEAR):
    path = op.Source(stokes=stokes) >> op.there_and_back(*elements, op.Mirror()) >> op.Detector()
    return path.trace()


def test_a_double_pass_doubles_what_plates_do_and_turns_back_at_glass():
    light = twice(op.Retarder(QUARTER, np.pi / 8)).stokes
    np.testing.assert_allclose(light, [1, 0, -1, 0], atol=1e-15)
    # At 45 degrees behind a polariser, nothing comes back through it.
    way = op.there_and_back(op.Retarder(QUARTER, np.pi / 4), op.Mirror())
    path = op.Source() >> op.Polarizer(0.0) >> way >> op.Polarizer(0.0) >> op.Detector()
    assert path.trace().intensity < 1e-30
    path = op.Source() >> op.there_and_back(op.Attenuator(0.5), op.Interface(1.5, 0.0))
    assert (path >> op.Detector()).trace().intensity == pytest.approx(0.25 * 0.04)
    # A double pass is its own way back.
    plate, foil = op.Retarder(1.0, 0.2, 0.4), op.Diattenuator(0.9, 0.2, 0.7)
    path = op.Source() >> op.there_and_back(plate, foil, op.Mirror(-0.9, 0.8)) >> op.Detector()
    found, expected = path.reversed().mueller().matrix, path.mueller().reversed().matrix
    assert found.shape == (4, 4)
    np.testing.assert_allclose(found, expected)


@rows("retardance", [0.3, 1.0, 2.5])
@rows("angle", [0.0, 0.4, -1.3])
def test_retardance_and_faradays_rotation_double_and_natural_rotation_is_undone(retardance, angle):
    # Chipman, Lam & Young, table 6.5, of twice the retardance; then y and z are turned over.
    c, s = np.cos(2 * angle), np.sin(2 * angle)
    cd, sd = np.cos(2 * retardance), np.sin(2 * retardance)
    expected = [1, c * c + s * s * cd, -c * s * (1 - cd), s * sd]
    np.testing.assert_allclose(twice(op.Retarder(retardance, angle)).stokes, expected, atol=2e-15)
    angle /= 2  # Twice as much is within the half turn of an axis.
    assert twice(op.Rotator(angle)).aop == pytest.approx(0.0, abs=1e-15)
    # Seen in the frame that is turned over.
    assert twice(op.FaradayRotator(angle)).aop == pytest.approx(-2 * angle)
    sugar = op.Medium("1 dm", absorption=3.0, dextrorotation=angle * 10)
    np.testing.assert_allclose(twice(sugar).stokes, np.exp(-0.6) * np.array(LINEAR), atol=1e-15)


def test_azimuths_and_parameters_are_the_same_on_both_ways():
    # The same in angles from the frame of the lamp alone.
    stokes = (1, 0.3, -0.2, 0.5)
    foil = op.Diattenuator(0.9, 0.2, 0.1, azimuth=0.5)
    turned = twice(op.Retarder(1.0, 0.2, azimuth=0.3), foil, stokes=stokes)
    plate, foil = op.Retarder(1.0, 0.5), op.Diattenuator(0.9, 0.2, 0.9)
    plain = twice(plate, foil, stokes=stokes).in_frame(op.Frame().turned(-0.3))
    np.testing.assert_allclose(turned.stokes, plain.stokes, atol=1e-15)
    first, second = op.Retarder(1.0, 0.2), op.Diattenuator(0.9, 0.2, 0.7)
    turned = op.there_and_back(first, second, op.Mirror(azimuth=op.Parameter("a")))
    path = op.Source(stokes=LINEAR) >> turned >> op.Detector()
    expected = np.broadcast_to(twice(first, second).stokes, (2, 4))
    np.testing.assert_allclose(path.trace(a=[0.4, -1.0]).stokes, expected, atol=1e-15)
    plate = op.Retarder(op.Parameter("retardance"), op.Parameter("angle")).named("plate")
    path = op.Source(stokes=LINEAR).named("lamp") >> op.there_and_back(plate, op.Mirror())
    path = path >> op.Detector().named("eye")
    light = path.trace(retardance=[QUARTER, 1.0], angle=[np.pi / 8, 0.4]).stokes
    np.testing.assert_allclose(light[0], [1, 0, -1, 0], atol=1e-15)
    np.testing.assert_allclose(light[1], twice(op.Retarder(1.0, 0.4)).stokes, atol=1e-15)
    preset = op.load_preset("double-pass-waveplate")
    assert list(path) == list(preset)
    for case in preset.cases.values():
        published = case.published["eye"]
        np.testing.assert_allclose(path.trace(**case.values).stokes, published, atol=1e-15)


def test_nodes_are_named_a_folding_mirror_is_met_again_and_choices_are_refused():
    plate = op.Retarder(1.0).named("plate")
    path = op.there_and_back(plate, op.Retarder(2.0), op.Rotator(0.1), op.Mirror())
    assert " ".join(path) == "plate retarder rotator mirror rotator-2 retarder-2 plate-back"
    assert list(op.there_and_back(op.Mirror())) == ["mirror"]
    first, second = op.Retarder(1.0, 0.2, 0.3), op.Polarizer(0.7, 0.1)
    one, other = op.there_and_back(first >> second, op.Mirror()), (first, second, op.Mirror())
    assert one == op.there_and_back(*other)
    fold = op.Interface(0.2 + 3j, 0.8)
    path = op.Source(stokes=LINEAR) >> op.there_and_back(op.Retarder(1.0, 0.3), fold, op.Mirror())
    matrix = fold.mueller().matrix
    plate, back = op.Retarder(1.0, 0.3).mueller().matrix, op.Retarder(1.0, -0.3).mueller().matrix
    expected = back @ matrix @ op.Mirror().mueller().matrix @ matrix @ plate @ LINEAR
    np.testing.assert_allclose((path >> op.Detector()).trace().stokes, expected, atol=1e-15)
    piece = op.Polarizer() >> op.Retarder(1.0) >> op.Rotator(0.1)
    piece.offer("place", "retarder", {"first": "polarizer.out"})
    with pytest.raises(
        op.errors.PathError, match="choice 'place' moves a node on the way there alone"
    ):
        op.there_and_back(piece, op.Mirror())


@rows(
    "elements, sentence",
    [
        ((), "needs elements, and last where light turns back"),
        ((op.Retarder(1.0),), "light does not turn back at 'retarder', which is given last"),
        ((op.Retarder(1.0), op.BeamSplitter()), "light does not turn back at 'beam-splitter'"),
        ((op.Mirror() >> op.Mirror(),), "light turns back at one element, and <PathGraph: mirror "),
        *(
            ((op.Interface(1.5, angle),), "give it an incidence of 0.0")
            for angle in (0.3, op.Parameter("t"), op.FOLLOWS)
        ),
        ((op.Source(), op.Mirror()), "light begins at 'source'; let op.there_and_back"),
        ((op.Combiner(), op.Mirror()), "'combiner': combiner adds up light without loss"),
        ((op.Mirror,), "Mirror is a class"),
        (("mirror",), "a chain is made of elements"),
    ],
)
def test_what_does_not_go_there_and_back_is_refused(elements, sentence):
    with pytest.raises(op.errors.PathError, match=sentence):
        op.there_and_back(*elements)

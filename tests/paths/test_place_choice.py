"""A node that takes one of several places, chosen by word before the path is composed."""

import copy
import functools
import json
import operator
import pickle

import numpy as np
import pytest

import optipath as op
from optipath.cli.command import main
from tables import rows
from wired import read, read_back

ROWS = {
    "light": "L >> P >> X2 >> X1 >> E",
    "between": "L >> X2 >> P >> X1 >> E",
    "eye": "L >> X2 >> X1 >> P >> E",
}

npgr026 = functools.partial(op.load_preset, "npgr026")


def built(place, angle):
    """Case 8 of the two reflections, with the filter at a place, element by element."""
    second = op.Interface(0.608 + 2.12j, np.radians(20.0))
    first = op.Interface(1.12 + 2.16j, np.radians(48.0), azimuth=np.radians(-34.0))
    row = [op.Source(100.0), second, first, op.Detector()]
    row.insert([*ROWS].index(place) + 1, op.Polarizer(angle))
    return functools.reduce(operator.rshift, row)


@rows("place", [*ROWS])
@rows("angle", [0.0, 0.7])
def test_the_filter_stands_at_the_light_between_the_surfaces_or_before_the_eye(place, angle):
    path = npgr026(case=8, place=place, filter=angle)
    expected = built(place, angle).trace().stokes
    np.testing.assert_allclose(path.trace().stokes, expected, rtol=1e-14, atol=1e-14)
    assert repr(path) == f"<PathGraph: {ROWS[place]}>"


def test_before_the_eye_the_unfiltered_light_is_filtered_by_malus_law():
    lit = npgr026(case=7).trace()
    angles = np.linspace(0.0, np.pi, 7)
    eye = npgr026(case=7).bind(place="eye", filter=angles).trace()
    s0, s1, s2, _ = lit.stokes
    expected = 0.5 * (s0 + s1 * np.cos(2 * angles) + s2 * np.sin(2 * angles))
    np.testing.assert_allclose(eye.intensity, expected, rtol=1e-14)
    # The filter is open wherever it stands.
    path = npgr026(case=7, place="eye")
    assert path.trace().intensity == lit.intensity
    assert path.trace(filter="horizontal").dop == pytest.approx(1.0)


def turned(plate=None, link=None, **own):
    """A filter behind gold, turned by 0.35, with a plate that does nothing before it or none."""
    path = op.Source(100) >> op.Interface(0.17 + 3.15j, "45 deg").named("gold")
    path.add("filter", op.Polarizer(0.2, **own)) >> path.add("eye", op.Detector())
    path.connect("gold", "filter", azimuth=link)
    path.offer("place", "filter", {"lamp": "source", "gold": "gold"})
    if plate is not None:
        path.insert("plate", op.Retarder(0.0, azimuth=plate), behind="gold")
    return path


@rows("how", [{"azimuth": 0.35}, {"link": 0.35}])
@rows("plate", [None, 0.1, op.Parameter("a", 0.1)])
def test_a_filter_that_is_moved_stays_turned_in_the_light(plate, how):
    path, gold = turned(plate, **how), op.Interface(0.17 + 3.15j, "45 deg")
    # The eye stays as it was turned, too.
    eye = op.Retarder(0.0, azimuth=0.35) >> op.Detector()
    expected = (op.Source(100) >> op.Polarizer(0.55) >> gold >> eye).trace().stokes
    moved = path.bind(place="lamp")
    found = [moved.trace().stokes, moved.bind(place="gold").trace().stokes]
    np.testing.assert_allclose(found, [expected, path.trace().stokes], rtol=1e-13, atol=1e-13)
    if plate is not None:
        path.remove("plate")
        found = path.bind(place="lamp").trace().stokes
        np.testing.assert_allclose(found, expected, rtol=1e-13, atol=1e-13)


def test_a_filter_is_moved_past_a_turned_plate_or_by_hand():
    path = turned(op.Parameter("a"))
    path.disconnect("plate")
    path.replace("filter", op.Polarizer(0.2, azimuth=op.Parameter("b")))
    path.connect("plate", "filter")
    with pytest.raises(op.ParameterError, match=r"by b and by a, .* path\.remove\('filter'\), and"):
        path.bind(place="lamp")
    path.remove("filter")
    path.insert("filter", op.Polarizer(azimuth=op.Parameter("b")), behind="source")
    assert path.trace(a=0.1, b=0.2).intensity > 0.0

    def path(place):
        path = op.Source(stokes=[2, 1, 1, 0]) >> op.Polarizer(0.3, azimuth=0.2).named("filter")
        path = path >> op.Retarder(0.8, azimuth=op.Parameter("a", 0.4)).named("plate")
        path = path >> op.Polarizer().named("last") >> op.Detector()
        path.offer("place", "filter", {"before": "source", "behind": "plate"})
        return path.bind(place=place)

    # The plate stands at 0.6, and so does what is behind it.
    filtered, plate = op.Polarizer(0.5), op.Retarder(0.8, 0.6)
    lamp, last = op.Source(stokes=[2, 1, 1, 0]), op.Polarizer(0.6)
    for place, row in (("before", (filtered, plate)), ("behind", (plate, filtered))):
        expected = (lamp >> row[0] >> row[1] >> last >> op.Detector()).trace().intensity
        assert path(place).trace().intensity == pytest.approx(expected, rel=1e-13)


def test_choices_are_copied_compared_joined_and_chosen_again(tmp_path):
    path = npgr026()
    assert path == npgr026(place="light")
    assert " ".join(path.parameters) == "delta rho phi n1 k1 n2 k2 filter intensity"
    assert path.choices["place"].place(path.graph) == "light"
    moved = npgr026(place="eye")
    assert moved.bind(place="between").bind(place="light") == path
    for place in ("light", "eye"):
        path = npgr026(place=place)
        copies = copy.copy(path), copy.deepcopy(path), pickle.loads(pickle.dumps(path))
        for again in (read_back(path, tmp_path), *copies):
            assert again == path
            assert again.choices == path.choices
            assert again.bind(place="between") == path.bind(place="between")
            assert repr(again.bind(place="eye")) == f"<PathGraph: {ROWS['eye']}>"
        assert path.reading("intensity").choices == path.choices
    path = op.Source() >> op.Polarizer() >> op.Mirror() >> op.Detector()
    other = copy.copy(path)
    other.offer("place", "polarizer", {"light": "source", "eye": "mirror"})
    assert path != other
    assert "place" not in path.choices
    assert other.bind(place="eye").choices == other.choices
    tail = op.Polarizer() >> op.Mirror() >> op.Polarizer().named("last") >> op.Detector()
    tail.offer("place", "last", {"before": "polarizer.out", "behind": "mirror.reflected"})
    path = op.Source() >> op.Polarizer() >> tail
    moved = "source >> polarizer >> polarizer-2 >> last >> mirror >> detector"
    assert repr(path.bind(place="before")) == f"<PathGraph: {moved}>"
    twice = op.Source() >> op.Polarizer().named("a") >> op.Mirror()
    twice.offer("place", "a", {"light": "source"})
    with pytest.raises(op.PathError, match="choice 'place' stands on both sides"):
        twice >> tail


@rows(
    "choose, told",
    [
        (lambda: npgr026(place="eyes", delta="steep"), r"(?s)'eyes' .* you mean 'eye'\?.*delta"),
        (lambda: npgr026(plce="eye"), "did you mean 'place'"),
        (lambda: npgr026().trace(place="eye"), r"path\.bind\(place=\.\.\.\)"),
        (lambda: npgr026().compose().run(delta=[0.1, 0.2], place="eye"), r"path\.bind\(place="),
    ],
)
def test_a_place_is_chosen_by_its_word_before_a_path_runs(choose, told):
    with pytest.raises(op.ParameterError, match=told):
        choose()


@rows(
    "offered, told",
    [
        (("place", "Q", {"light": "L.out"}), "'Q' does not exist"),
        (("place", "X1", {"light": "L.out"}), "not go straight through 'X1'"),
        (("place", "P", {"light": "L.ou"}), "did you mean 'L.out'"),
        (("place", "P", {"out": "X1.transmitted"}), "feeds no one link"),
        *((("place", "P", given), "a port for each word") for given in ({}, ["L.out"])),
        (("place", "E", {"light": "L.out"}), "'E' has no way out"),
        (("place", "P", {"own": "P.out"}), "feeds no one link"),
        (("a b", "P", {"light": "L.out"}), "letters, digits and underscores"),
    ],
)
def test_places_that_cannot_be_taken_are_told_when_they_are_offered(offered, told):
    path = npgr026()
    path._graph.graph.pop("choices")
    with pytest.raises(op.PathError, match=told):
        path.offer(*offered)
    assert not path.choices


@rows(
    "old, new, told",
    [
        ('"X1.reflected" }', '"X1.refl" }', "choices.place: place 'eye': port 'X1.refl' does not"),
        ('element = "P"', 'elemnt = "P"', "choices.place: key 'elemnt' is unknown"),
        ('element = "P"', "", "choices.place: 'element' is missing"),
        ("[choices.place]", "[choices.rho]", "'rho' is a parameter and a choice"),
    ],
)
def test_faults_of_choices_in_a_file_have_their_place_and_nodes(old, new, told, tmp_path):
    text = npgr026().to_toml()
    with pytest.raises(op.PathError, match=told):
        read(text.replace(old, new, 1), tmp_path)
    path = npgr026()
    path.cases.clear()
    path.remove("P")
    assert ("choices" in path.to_toml(), {*path.choices}) == (False, set())
    path = npgr026()
    path.disconnect("X1", "E")
    with pytest.raises(op.PathError, match=r"choice 'place': place 'eye': 'X1\.reflected' feeds"):
        path.to_toml()


def test_the_command_line_takes_the_place_and_tells_of_places(capsys):
    assert main(["run", "npgr026", "--case", "8", "--place", "eye", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["choices"] == {"place": "eye"}
    expected = built("eye", 0.0).trace().stokes
    assert found["detectors"]["E"]["stokes"] == pytest.approx(expected, abs=1e-12)
    assert main(["run", "npgr026", "--case", "8", "--json"]) == 0
    assert "choices" not in json.loads(capsys.readouterr().out)
    assert main(["run", "npgr026", "--place", "eyes"]) == 2
    assert "place 'eyes' is unknown; did you mean 'eye'?" in capsys.readouterr().err
    assert main(["show", "npgr026"]) == 0
    assert "light, between, eye" in " ".join(capsys.readouterr().out.split())

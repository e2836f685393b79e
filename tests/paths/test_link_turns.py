"""Changes of a path by which nothing behind is turned, whatever azimuths stand on the way."""

import re

import numpy as np
import pytest

import optipath as op

A = op.Parameter("a")
AT = {"a": 0.37}


def two_reflections():
    return op.load_preset("npgr026", case=7)


def stokes(path):
    return path.trace(**{name: AT[name] for name in AT if name in path.parameters}).stokes


def by_angle(turn, behind, path=None):
    """A polariser behind a port that is turned by its angle, which turns nothing else."""
    path = path or two_reflections()
    path.insert("new", op.Polarizer(0.2 + turn), behind=behind)
    return stokes(path)


@pytest.mark.parametrize(
    ("azimuth", "turn"),
    [
        (0.5, 0.5),
        (0.0, 0.0),
        (A, 0.37),
        (2 * A + 0.1, 0.84),
        (np.array([0.1, 0.2]), np.array([0.1, 0.2])),
    ],
)
@pytest.mark.parametrize("first", [0.3, A])
@pytest.mark.parametrize("behind", ["P", "X1"])
def test_what_replaces_an_inserted_element_turns_nothing_behind_it(behind, first, azimuth, turn):
    path = two_reflections()
    path.insert("new", op.Polarizer(0.2, azimuth=first), behind=behind)
    path.replace("new", op.Polarizer(0.2, azimuth=azimuth))
    np.testing.assert_allclose(stokes(path), by_angle(turn, behind), rtol=1e-13, atol=1e-13)
    path.remove("new")
    np.testing.assert_allclose(stokes(path), stokes(two_reflections()), rtol=1e-13, atol=1e-13)


def test_turns_of_what_was_inserted_are_written_and_read_back(tmp_path):
    path = two_reflections()
    path.insert("new", op.Polarizer(0.2, azimuth=2 * A + 0.1), behind="P")
    file = tmp_path / "path.toml"
    file.write_text(path.to_toml(), "utf-8")
    again = op.load_preset(file)
    again.replace("new", op.Polarizer(0.2, azimuth=-A))
    np.testing.assert_allclose(stokes(again), by_angle(-0.37, "P"), rtol=1e-13, atol=1e-13)


def test_an_azimuth_that_a_link_says_instead_is_none_of_what_stands_behind():
    path = two_reflections()
    path.insert("new", op.Polarizer(0.2, azimuth=0.3), behind="P")
    path.disconnect("P.out", "new.in")
    path.connect("P.out", "new.in", azimuth=0.0)
    path.replace("new", op.Polarizer(0.2))
    np.testing.assert_allclose(stokes(path), by_angle(0.0, "P"), rtol=1e-14)
    path.remove("new")
    assert path == two_reflections()


def test_what_is_behind_each_link_of_a_replaced_element_stays_as_it_was_turned():
    path = op.Source() >> op.Polarizer(azimuth=0.3).named("first") >> op.Polarizer()
    path.add("second", op.Polarizer(0.1)) >> path.add("state", op.Detector())
    path.connect("first", "second", tap=True)
    path = path >> op.Detector().named("eye")
    path.replace("first", op.Polarizer(azimuth=0.5))
    lights = path.trace_all()
    assert lights["eye"].intensity == pytest.approx(0.5 * np.cos(0.2) ** 2)
    assert lights["state"].intensity == pytest.approx(0.5 * np.cos(0.1) ** 2)


@pytest.mark.parametrize(
    ("own", "turn", "behind"),
    [
        (0.25, 0.25, 0.1),
        (0.25, 0.25, 2 * A),
        (A, 0.37, 0.1),
        (A, 0.37, 2 * A),
        ("10 deg" - A, np.radians(10) - 0.37, A + 0.25),
        (np.array([0.1, 0.2]), np.array([0.1, 0.2]), 0.1),
    ],
)
def test_an_element_is_inserted_before_one_that_has_an_azimuth_as_well(own, turn, behind):
    def path():
        gold = op.Interface(0.17 + 3.15j, 0.8, azimuth=behind)
        return op.Source(stokes=[5, 3, 1, 2]) >> op.Polarizer() >> gold >> op.Detector()

    found = path()
    found.insert("new", op.Polarizer(0.2, azimuth=own), behind="polarizer")
    expected = by_angle(turn, "polarizer", path())
    np.testing.assert_allclose(stokes(found), expected, rtol=1e-13, atol=1e-13)
    found.remove("new")
    expected = np.broadcast_to(stokes(path()), stokes(found).shape)
    np.testing.assert_allclose(stokes(found), expected, rtol=1e-13, atol=1e-13)


def test_an_azimuth_goes_over_to_all_links_that_it_turns():
    class Merging(op.Element):
        azimuth: op.Angle = 0.0
        merges = True

        @staticmethod
        def mueller_rows(xp):
            return np.diag([1, 1, 0, 0]).tolist()

    path = op.PathGraph()
    path.add("sum", Merging(azimuth=0.4)) >> path.add("eye", op.Detector())
    for lamp in ("one", "two"):
        path.add(lamp, op.Source(stokes=[1, 1, 0, 0])) >> path["sum"]
    path.insert("new", op.Retarder(0.0, azimuth=0.25), behind="one")
    assert path.trace().stokes == pytest.approx([2, 2 * np.cos(0.8), 0, 0])


@pytest.mark.parametrize("removed", [False, True])
def test_turns_that_make_no_one_azimuth_are_refused_with_a_cure_that_does(removed):
    path, other = two_reflections(), op.Polarizer(0.2, azimuth=A)

    def change(path):
        if removed:
            path.remove("old")
        else:
            path.insert("new", other, behind="X2")

    if removed:
        path = op.Source(stokes=[5, 3, 1, 2]) >> op.Retarder(0.0, azimuth=A).named("old")
        last = op.Mirror(-0.9, 0.7, azimuth=op.Parameter("rho", 0.2))
        path = path >> last.named("X1") >> op.Detector()
    before = path.to_toml()
    with pytest.raises(
        op.PathError, match=r"'X1' would be turned by .* no one azimuth does"
    ) as told:
        change(path)
    assert path.to_toml() == before
    expected = stokes(path) if removed else by_angle(0.37, "X2")
    behind, before = re.search(r"behind='(.*)', before='(.*)'\)", str(told.value)).groups()
    path.insert("between", op.Attenuator(1.0), behind=behind, before=before)
    change(path)
    np.testing.assert_allclose(stokes(path), expected, rtol=1e-13, atol=1e-13)


def test_another_parameter_as_azimuth_is_given_by_an_element_put_in_anew():
    path = op.Source() >> op.Polarizer(azimuth=A) >> op.Polarizer(0.6) >> op.Detector()
    other = op.Polarizer(azimuth=op.Parameter("b", 0.2))
    with pytest.raises(op.PathError, match=r"by a and by -b, .* path\.remove\('polarizer'\)"):
        path.replace("polarizer", other)
    path.remove("polarizer")
    path.insert("between", op.Attenuator(1.0), behind="source")
    path.insert("polarizer", other, behind="source")
    assert path.trace(a=0.37).intensity == pytest.approx(0.5 * np.cos(0.6 + 0.37 - 0.2) ** 2)


def pane(index, azimuth=0.4, polarizer=0.1):
    path = op.Source(stokes=[1, 0.5, 0.2, 0.1]) >> op.Polarizer(0.2, azimuth=polarizer)
    return path >> op.Interface(index, 0.6, azimuth=azimuth) >> op.Detector()


@pytest.mark.parametrize("azimuth", [0.4, 0.7, 2 * A + 0.1, np.array([0.1, 0.7])])
@pytest.mark.parametrize("plate", [0.25, 0.9])
def test_an_azimuth_that_its_link_has_taken_over_is_given_anew_by_a_replacement(azimuth, plate):
    path = pane(1.5, azimuth)
    path.insert("plate", op.Retarder(0.0, azimuth=plate), behind="polarizer")
    path.remove("plate")
    path.replace("interface", op.Interface(1.6, 0.6, azimuth=azimuth))
    assert path == pane(1.6, azimuth)


def test_a_replacement_that_stands_as_its_link_says_turns_nothing_behind_it():
    path = pane(1.5)
    path.insert("plate", op.Retarder(0.0, azimuth=0.25), behind="source")
    path.remove("plate")
    path.replace("polarizer", op.Polarizer(0.2, azimuth=0.1))
    assert path == pane(1.5)


def test_a_replacement_that_is_turned_otherwise_than_its_link_says_is_refused():
    path = pane(1.5)
    path.insert("plate", op.Retarder(0.0, azimuth=0.25), behind="polarizer")
    with pytest.raises(op.PathError, match=r"'interface' by 0\.15.* turned by 0\.4; leave the"):
        path.replace("interface", op.Interface(1.6, 0.6, azimuth=0.4))
    path.replace("interface", op.Interface(1.6, 0.6))
    np.testing.assert_allclose(stokes(path), stokes(pane(1.6)), rtol=1e-14)


def test_arrays_that_do_not_fit_are_no_one_azimuth():
    path = op.Source() >> op.Polarizer(azimuth=np.array([0.1, 0.2, 0.3])) >> op.Detector()
    with pytest.raises(op.PathError, match="no one azimuth does for both"):
        path.insert("new", op.Polarizer(azimuth=np.array([0.1, 0.2])), behind="source")


def test_world_frames_with_an_azimuth_are_one_fault_where_an_element_is_replaced():
    frame = op.Frame()
    path = op.PathGraph()
    nodes = [
        path.add(name, element, {port: frame})
        for name, element, port in (
            ("lamp", op.Source(), "out"),
            ("filter", op.Polarizer(), "in"),
            ("eye", op.Detector(), "in"),
        )
    ]
    nodes[0] >> nodes[1] >> nodes[2]
    with pytest.raises(op.PathError) as told:
        path.replace("filter", op.Polarizer(azimuth=0.1))
    assert len(told.value.faults) == 1

import json

import pytest

import optipath as op
from charts import texts_over_marks
from optipath.lab.accuracy.peer_times import peer_times
from pictures import faults_of, texts_of

ERROR = {"worst": 1.0, "median": 0.5}
CHART = {
    "format": 1,
    "title": "npgr026, case 8",
    "parameters": {"filter": "horizontal", "n1": "1.12", "k1": "2.16", "delta": "48 deg"},
    "machine": {"model": "EPYC"},
    "versions": {"python": "3.11.7", "optipath": "0.1.0", "numpy": "2.4.6"},
    "limits_ns": {"memory": 2.0},
    "fails_above": 1000.0,
    "contenders": [
        {
            "method": "stable",
            "dtype": "float64",
            "engine": "numba",
            "composing": "stokes",
            "eps": 2.2e-16,
            "ns": {"least": 30.0, "median": 33.0},
            "errors": {"componentwise": {"generic": ERROR}, "normwise": {"generic": ERROR}},
        }
    ],
}
NAMES = ["tmm", "mitsuba, llvm", "katsu", "numpy by hand", "jax by hand", "pypolar", "py_pol"]


def race(**changes):
    results = [
        {"contender": name, "how": "", "paths": 10, "least": ns, "median": ns, "error": error}
        for name, ns, error in (
            ("optipath, numba", 20.0, 1e-16),
            *((name, 100.0 * 1.3**place, 1e-15) for place, name in enumerate(NAMES)),
            ("slow", 1e6, float("nan")),
        )
    ]
    path = {"filter": "horizontal", "n1": 1.12, "k1": 2.16}
    found = {
        "path": {"preset": "npgr026"},
        "contests": {"absorbing": {"path": path, "results": results, "left out": {}}},
        "processor": "EPYC",
        "software": {**CHART["versions"], "tmm": "0.2"},
        **changes,
    }
    return json.dumps(found)


def test_times_are_multiplied_so_that_optipath_is_as_fast_in_both():
    found = peer_times(race(), "race.json", CHART)
    assert found.shared == "optipath, numba"
    assert found.ratio == pytest.approx(1.5)
    times = {racer.name: racer.ns for racer in found.racers}
    assert times["optipath, numba"] == pytest.approx(30.0)
    assert times["tmm"] == pytest.approx(150.0)


def test_a_peer_without_any_right_digit_has_an_error_of_1():
    racer = peer_times(race(), "race.json", CHART).racers[-1]
    assert racer.error == 1.0
    assert not racer.is_own


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"processor": "Xeon"}, "the processor of 'race.json' is 'Xeon', and that of the chart"),
        ({"software": {"python": "3.12.0"}}, "python of 'race.json' is '3.12.0'"),
        ({"path": {"preset": "malus"}}, "the preset of 'race.json' is 'malus'"),
    ],
)
def test_another_machine_other_versions_and_another_path_are_refused(changes, message):
    with pytest.raises(op.OptipathError, match=message):
        peer_times(race(**changes), "race.json", CHART)


def test_a_chart_that_does_not_say_its_processor_is_refused():
    old = {**CHART, "machine": {"system": "Linux"}}
    with pytest.raises(op.OptipathError, match="that of the chart not told"):
        peer_times(race(), "race.json", old)


def test_other_values_and_other_contenders_are_refused():
    other = {**CHART, "parameters": {"filter": "none"}}
    with pytest.raises(op.OptipathError, match="the chart is of other values"):
        peer_times(race(), "race.json", other)
    (entry,) = CHART["contenders"]
    single = {**CHART, "contenders": [{**entry, "dtype": "float32"}]}
    with pytest.raises(op.OptipathError, match="share no contender"):
        peer_times(race(), "race.json", single)


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"contests": 3}'])
def test_what_is_no_race_is_refused(text):
    with pytest.raises(op.OptipathError, match=r"race\.py --json"):
        peer_times(text, "race.json", CHART)


@pytest.mark.parametrize(
    ("name", "value"),
    [("error", 10**400), ("error", -1e-9), ("error", True), ("least", True), ("least", 10**400)],
)
def test_a_time_or_an_error_that_is_no_such_number_is_refused(name, value):
    found = json.loads(race())
    found["contests"]["absorbing"]["results"][1][name] = value
    with pytest.raises(op.OptipathError, match="is no whole race"):
        peer_times(json.dumps(found), "race.json", CHART)


def test_peers_stand_in_a_panel_of_their_own_with_their_names(tmp_path):
    pytest.importorskip("matplotlib")
    file = tmp_path / "race.json"
    file.write_text(race(), "utf-8")
    panel = op.plots.chart(CHART, peers=file)
    figure = panel[0].figure
    texts = texts_of(figure)
    words = [text.get_text() for text in texts]
    assert set(NAMES) <= set(words)
    assert any("times x 1.5" in word for word in words)
    assert faults_of(figure) == []
    assert texts_over_marks(figure, texts) == []
    colours = {line.get_color() for line in panel[2].get_lines() if line.get_marker() == "o"}
    assert len(colours) == 2
    op.plots.save(panel, tmp_path / "x.png", 60)

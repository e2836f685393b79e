import json
from pathlib import Path

import pytest
from hypothesis import Phase, given, settings

import optipath as op
from charts import charts, texts_over_marks
from optipath.lab.accuracy.chart_file import KINDS
from pictures import faults_of, texts_of
from tables import rows

pytest.importorskip("matplotlib")
DOCS = Path(__file__).parents[3] / "docs"
RECORDED = ["chart.json", "chart-interface.json"]


def words_of(panel):
    return [text.get_text() for text in texts_of(panel[0].figure)]


def recorded(name):
    return json.loads((DOCS / name).read_text("utf-8"), object_hook=_infinite)


def _infinite(entry):
    return {key: float("inf") if value is None else value for key, value in entry.items()}


def assert_clear(panel):
    figure = panel[0].figure
    assert faults_of(figure) == []
    assert texts_over_marks(figure, texts_of(figure)) == []


@rows("name", RECORDED)
def test_no_text_of_a_recorded_chart_is_over_another_or_over_a_mark_or_cut(name):
    assert_clear(op.plots.chart(DOCS / name))


@settings(max_examples=6, deadline=None, phases=[Phase.reuse, Phase.generate])
@given(charts())
def test_no_text_of_any_chart_is_over_another_or_over_a_mark_or_cut(chart):
    assert_clear(op.plots.chart(chart))


@rows("name", RECORDED)
def test_every_contender_has_a_mark_in_each_panel(name):
    chart = recorded(name)
    for ax in op.plots.chart(chart):
        marked = [line for line in ax.get_lines() if line.get_marker() in "osD"]
        assert len(marked) == len(chart["contenders"])


def test_methods_precisions_engines_and_limits_are_named_in_readable_texts():
    panel = op.plots.chart(DOCS / "chart.json")
    assert min(text.get_fontsize() for text in texts_of(panel[0].figure)) >= 14
    chart = recorded("chart.json")
    looks = {}
    for line in op.plots.chart(chart)[0].get_lines():
        if line.get_marker() in "osD":
            looks.setdefault(line.get_color(), set()).add(line.get_marker())
    assert len(looks) == 4
    assert all(shapes == {"o", "s", "D"} for shapes in looks.values())
    words = words_of(op.plots.chart(DOCS / "chart.json"))
    assert words.count("frontier") == 2
    assert words.count("memory: 2.37 ns") == 2
    words = " ".join(words_of(op.plots.chart(DOCS / "chart-interface.json")))
    assert "all but: near the critical angle;" in words
    assert "n near 1, grazing" in words


def test_the_unit_of_what_fails_is_explained_and_neither_is_told_where_nothing_fails():
    chart = recorded("chart.json")
    words = " ".join(words_of(op.plots.chart(chart)))
    assert "fails (over 1000 ulp*) in so many regions" in words
    assert "units in the last place, divided by 1 + the condition number" in words
    chart["fails_above"] = 1e29
    for entry in chart["contenders"]:
        for kind in KINDS:
            for error in entry["errors"][kind].values():
                error.update(worst=9.0, median=1.0)
    panel = op.plots.chart(chart)
    words = " ".join(words_of(panel))
    assert not any(each in words for each in ("ulp", "fails (", "last place"))
    assert_clear(panel)


def test_what_was_left_out_is_said_and_what_is_no_chart_refused():
    chart = recorded("chart.json")
    chart["effort"] = {"samples": 3, "rounds": 3, "left_out": "of Numba only stable"}
    chart["regions"] = {"measured": 5, "of": 21}
    words = " ".join(words_of(op.plots.chart(chart)))
    assert "3 samples a region" in words
    assert "of Numba only stable" in words
    assert "interrupted: 5 of 21 regions" in words
    with pytest.raises(op.OptipathError, match="what is given is no whole chart"):
        op.plots.chart({"format": 1})
    with pytest.raises(op.OptipathError, match=r"'nowhere\.json' cannot be read"):
        op.plots.chart("nowhere.json")


def near(**more):
    errors = {
        "stable": {kind: [1.0, 1.0, 2.0] for kind in KINDS},
        "textbook": {kind: [1.0, 1e6, float("inf")] for kind in KINDS},
    }
    places = [
        {"name": name, "called": name, "distances": [1e-1, 1e-3, 1e-5], "errors": errors}
        for name in ("brewster", "normal", "grazing")
    ]
    return {
        "format": 1,
        "drawn": "errors next to critical places",
        "title": "glass",
        "dtype": "float64",
        "eps": 2.0**-52,
        "fails_above": 1000.0,
        "samples": 4,
        "places": places,
        **more,
    }


def test_errors_near_critical_places_are_a_panel_a_place():
    panel = op.plots.chart(near())
    assert [ax.get_xlabel() for ax in panel] == [
        f"distance from {name} (rad)" for name in ("brewster", "normal", "grazing")
    ]
    for ax in panel:
        curves = [line for line in ax.get_lines() if len(line.get_xdata()) == 3]
        assert len(curves) == 4
        # A lost number is drawn where no digit is right, and none of them is beyond.
        assert max(max(line.get_ydata()) for line in curves) == 1.0
    assert_clear(panel)
    one = near(title="long title " * 20, regions={"measured": 3, "of": 9})
    one["places"] = one["places"][:1]
    panel = op.plots.chart(one)
    assert_clear(panel)
    assert "interrupted: 3 of 9 distances" in " ".join(words_of(panel))
    spoilt = near()
    spoilt["places"][0]["distances"] = [1e-1]
    with pytest.raises(op.OptipathError, match="no whole chart"):
        op.plots.chart(spoilt)
    with pytest.raises(op.OptipathError, match="peers stand beside"):
        op.plots.chart(near(), peers="race.json")

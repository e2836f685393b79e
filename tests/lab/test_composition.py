"""Benches: what is measured, compared with the same work by hand, and how it is told and drawn."""

import json
from collections import Counter

import numpy as np
import pytest

import optipath as op
from optipath.cli import main
from optipath.engines.numpy_engine import NumpyEngine
from optipath.lab import composition
from optipath.lab.bench import Timing, random_values
from optipath.lab.composition import LIGHT, MATRIX, Rates, measured, mixed_path, walked
from optipath.plots.charts import throughput
from pictures import faults_of, texts_of
from tables import slow_except

COMPOSED = ["composed", "composed and run"]


@pytest.fixture
def once(monkeypatch):
    """Each call is made once, and is said to take 2 s, by the median 4 s."""

    def run_once(contenders, tick=print):
        for name, call in contenders.items():
            tick(name)
            call()
        return dict.fromkeys(contenders, Timing(9.0, 2.0, 4.0))

    monkeypatch.setattr(composition, "race", run_once)


@pytest.mark.parametrize("count", [3, 4, 5, 10, 100])
def test_light_and_matrices_by_hand_are_those_of_the_plan(count):
    path, graph = mixed_path(count)
    assert (len(path), len(graph)) == (count, count - 2)
    plan = path.compose()
    for size in (1, 7):
        values = random_values(plan, size)
        light, matrix = (walked(graph, values, start) for start in (LIGHT, MATRIX))
        np.testing.assert_allclose(light[..., 0], plan.run(**values).stokes, rtol=0, atol=1e-14)
        np.testing.assert_allclose(matrix, plan.mueller(**values).matrix, rtol=0, atol=1e-14)
    one = {name: float(value[0]) for name, value in values.items()}
    assert walked(graph, one, LIGHT)[:, 0] == pytest.approx(plan.run(**one).stokes, abs=1e-14)


def test_elements_of_mixed_paths_are_of_three_kinds_by_parameter_and_by_numbers_of_their_own():
    path, _ = mixed_path(1000)
    kinds = Counter(type(node["element"]).__name__ for _, node in path.graph.nodes(data=True))
    assert kinds == {"Interface": 333, "Polarizer": 333, "Rotator": 332, "Source": 1, "Detector": 1}
    elements = {repr(node["element"]) for _, node in path.graph.nodes(data=True)}
    assert sum("Parameter" in each for each in elements) == 3
    assert sum("Parameter" not in each for each in elements) == 499 + 2
    assert path.trace().intensity > 1e-6


@pytest.mark.usefixtures("once")
def test_rates_are_of_elements_of_long_paths_and_of_short_paths_and_of_what_is_given():
    told = []
    path = op.load_preset("npgr026")
    rates = measured({"mine": path}, elements=300, engines=["numpy"], progress=told.append)
    of_path = {}
    for each in rates:
        of_path.setdefault(each.path, {})[each.work] = each
    long, short, own = of_path.values()
    assert [*of_path] == ["300 mixed elements", "10 mixed elements", "mine"]
    batches = [f"{what}, 10,000 values, numpy" for what in ("light", "matrices")]
    works = [*(f"paths {each}" for each in COMPOSED), "light, one value", *batches]
    assert [*long] == [f"elements {each}" for each in COMPOSED] + [
        "light, one value",
        "matrices, one value",
    ]
    assert [*short] == [*own] == works
    for each, count in (
        (long["elements composed"], 300),
        (long["matrices, one value"], 298),
        (short["paths composed"], 1),
        (short["light, 10,000 values, numpy"], 10_000),
        (short["matrices, 10,000 values, numpy"], 80_000),
    ):
        assert each[2:] == (count / 2, count / 4, count / 2, count / 4)
    # Three elements of the preset pass light on; formulas by hand are those of mixed paths.
    assert own["matrices, 10,000 values, numpy"][2:] == (15_000.0, 7_500.0, None, None)
    assert len(told) == 2 * (len(long) + len(short)) + len(own)
    closed = measured({"closed": op.Source() >> op.Detector()}, engines=["numpy"])
    assert [each.work for each in closed if each.path == "closed"] == works[:3]


@pytest.mark.usefixtures("once")
@pytest.mark.parametrize("long", slow_except([False], [False, True]))
def test_no_formula_is_compiled_twice_and_of_several_sources_the_first_gives_the_matrix(
    monkeypatch, long
):
    compiled, texts = NumpyEngine.compiled, Counter()

    def counted(engine, formula):
        texts[tuple(map(repr, formula.steps)), formula.dtype.name] += 1
        return compiled(engine, formula)

    monkeypatch.setattr(NumpyEngine, "compiled", counted)
    paths = {name: op.load_preset(name) for name in ("npgr026", "sky-and-window")}
    rates = measured(paths, elements=20, largest=2000, engines=["numpy"], long=long)
    # Formulas that another test made are found again.
    assert set(texts.values()) <= {1}
    sizes = ["10", "100", "1,000", "2,000"] if long else ["2,000"]
    works = [each.work for each in rates if each.path == "sky-and-window"][3:]
    assert works == [f"{w}, {size} values, numpy" for size in sizes for w in ("light", "matrices")]


def test_light_that_differs_from_that_by_hand_is_an_error(monkeypatch):
    monkeypatch.setattr(composition, "walked", lambda *_: np.ones((4, 1)))
    with pytest.raises(op.OptipathError, match="light of 10 elements by hand is not that of"):
        measured({}, elements=10)


@pytest.mark.usefixtures("once")
def test_the_command_tells_and_draws_rates_with_a_preset_and_without(capsys, tmp_path, monkeypatch):
    def told(*words):
        status = main(["bench", *words, "--engine", "numpy", "--elements", "300"])
        out, err = capsys.readouterr()
        assert (status, err.replace("wrote a.svg\n", "")) == (0, "")
        return out

    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "80")
    lines = [" ".join(line.split()) for line in told().splitlines()]
    assert lines[0] == "300 mixed elements"
    assert "elements composed 150 75 150 75 1" in lines
    assert "matrices, 10,000 values, numpy 40 k 20 k 40 k 20 k 1" in lines
    assert not any("npgr026" in line for line in lines)
    found = json.loads(told("malus", "--json", "--out", "a.svg"))
    assert {each["path"] for each in found["rates"]} == {
        "300 mixed elements",
        "10 mixed elements",
        "malus",
    }
    assert found["rates"][0]["best"] == 150.0
    assert "numpy" in found["about"]
    drawn = (tmp_path / "a.svg").read_text("utf-8")
    assert "elements composed" in drawn
    assert ">malus<" in drawn


def test_a_picture_has_each_rate_beside_that_by_hand_and_no_text_over_another():
    rates = [
        Rates("1,000 mixed elements", "elements composed", 7e3, 6e3, 1.3e5, 1.2e5),
        Rates("1,000 mixed elements", "light, one value", 9.83, 9.0, 141.0, 140.0),
        Rates("a preset", "matrices, 1,000,000 values, numba float32", 2.1e8, 2e8),
    ]
    panel = throughput(rates)
    words = [text.get_text() for text in texts_of(panel[0].figure)]
    assert {"7 k", "130 k", "9.83", "141", "210 M", "optipath"} <= {*words}
    assert faults_of(panel[0].figure) == []

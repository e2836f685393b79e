"""Pure pieces of the page, run in the browser."""

import math
from itertools import combinations

import pytest

from optipath.values.units import UNITS
from tables import rows

pytestmark = pytest.mark.slow

pytest.importorskip("playwright.sync_api", reason="needs the extra 'browser'")


@pytest.fixture
def it(stayed):
    if stayed.page.url == "about:blank":
        stayed.open("preset=malus")
    return stayed.imported


def test_a_state_comes_back_from_its_address_and_a_wavelength_that_is_only_offered_is_left_out(it):
    made = """(() => {
      let state = it.newState("a b");
      state = it.withEntry(state, "values", "n.1", "1.5 + 2i & more");
      state = it.withEntry(state, "places", "place", "eye");
      state = { ...state, case: "8", curve: { ...state.curve, x: "n.1", y: ["S0"] } };
      state = { ...state, views: { ...state.views, sphere: [10.5, -20] } };
      return [state, it.fromHash("#" + it.toHash(state))];
    })()"""
    state, again = it("state.js", made)
    assert state == again
    assert it("state.js", "it.fromHash('#case=8')") is None
    made = """[true, false].map((offered) => it.withoutIdle(
      it.withEntry(it.newState("a"), "values", "wavelength", "500 nm"),
      { parameters: [{ name: "wavelength", default: "", offered }] },
    ).values)"""
    assert it("state.js", made) == [{}, {"wavelength": "500 nm"}]


def test_a_history_has_one_step_a_drag_and_two_hundred_and_forgets_what_was_undone(it):
    steps = """(() => {
      const history = new it.History(1);
      history.push(2, "slide"); history.push(3, "slide"); history.settle();
      history.push(4, "slide");
      const back = [history.undo(), history.undo(), history.undo()];
      return [...back, history.canUndo, history.redo(), history.redo(), history.canRedo];
    })()"""
    assert it("state.js", steps) == [3, 1, 1, False, 3, 4, False]
    steps = """(() => {
      const history = new it.History(1);
      history.push(2); history.push(3); history.undo(); history.push(4);
      return [...history.states, history.canRedo];
    })()"""
    assert it("state.js", steps) == [1, 2, 4, False]
    steps = """(() => {
      const history = new it.History(0);
      for (let i = 1; i <= 500; i += 1) history.push(i);
      return [history.now, history.states.length, history.states[0]];
    })()"""
    assert it("state.js", steps) == [500, 201, 300]


TAKEN = {"number": -1500.0, "written": "-1.5e3", "unit": "deg/mm"}
POWER = "-8.2\N{MIDDLE DOT}10\N{SUPERSCRIPT MINUS}\N{SUPERSCRIPT SIX}"


@rows(
    "module, expression, expected",
    [
        ("units.js", "it.taken(' -1.5e3 deg/mm ')", TAKEN),
        ("units.js", "it.taken('gold')", None),
        ("units.js", "it.plainText(it.typeset('-24.91 deg'))", "-24.91 deg"),
        ("units.js", "it.plainText(it.typeset('1e-9 - 2i'))", "1e-9 - 2i"),
        ("units.js", "it.stepped(0.1 + 0.2, 0, 0.1)", "0.3"),
        ("units.js", "it.stepped(516.4, 380, 1)", "516"),
        ("units.js", "it.powered(-8.21e-6)", POWER),
        ("units.js", "it.powered(0.25)", "0.25"),
        ("projection.js", "it.turned([170, 80, 2], 20, 30)", [-170, 90, 2]),
        ("ticks.js", "it.ticks(0, 1, 5)", [0, 0.2, 0.4, 0.6, 0.8, 1]),
        ("ticks.js", "it.degreeTicks(0, 90, 4)", [0, 30, 60, 90]),
        ("ticks.js", "it.ticks(2, 2)", [2]),
        ("ticks.js", "it.rangeOf([null])", [0, 1]),
    ],
)
def test_texts_steps_views_and_ticks(it, module, expression, expected):
    assert it(module, expression) == expected


def test_units_are_as_large_as_those_of_the_library_and_axes_of_equal_numbers_have_a_length(it):
    for unit, known in UNITS.items():
        size = pytest.approx(known.size * 10.0**known.power)
        assert it("units.js", f"it.sizeOf({unit!r})") == size, unit
    low, high = it("ticks.js", "it.rangeOf([5, 5, null])")
    assert low < 5 < high


def test_a_projection_keeps_lengths_and_labels_are_not_over_one_another_but_in_their_order(it):
    zero = pytest.approx(0.0, abs=1e-12)
    assert it("projection.js", "it.projected([90, 0])([0, 2, 0])") == [zero, zero, 2.0]
    x, y, near = it("projection.js", "it.projected([0, 0])([0, 0, 1])")
    assert (x, y) == (0.0, -1.0), near
    seen = it("projection.js", "it.projected([33, 21])([1, -2, 3])")
    assert math.hypot(*seen) == pytest.approx(math.sqrt(14.0))
    labels = 'Array.from({ length: 6 }, () => ({ at: [100, 100], words: "delta = 48" }))'
    boxes = it("labels.js", f"it.placed({labels}, [400, 400]).map((each) => each.box)")
    for a, b in combinations(boxes, 2):
        assert a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1]
    found = it("labels.js", "it.spread([50, 51, 49], 15, 0, 60)")
    assert sorted(found) == [found[2], found[0], found[1]]
    assert found[1] - found[0] >= 15
    assert max(found) <= 60


def test_curves_that_may_miss_something_are_told_and_power_that_goes_round_leads_back_once(it):
    sampled = "{{ x: [0, 1], lines: [{{ values: Array.from({{ length: 2001 }}, {}) }}] }}"
    slow, fast, rounding = "Math.sin(i / 8)", "Math.sin(i * i / 1000)", "i + 1e-9 * (-1) ** i"
    drawn = ", ".join(sampled.format(f"(_, i) => {each}") for each in (slow, fast, rounding))
    assert it("curve_faults.js", f"[{drawn}].map(it.isTooFast)") == [False, True, False]
    assert "itself" in it("curve_faults.js", "it.flat({ x: [30, 30, 30] })")[0]
    energy = """{ links: [
      { start: "lamp", end: "front", name: "a", power: 1, text: "1" },
      { start: "front", end: "back", name: "b", power: 0.9, text: "0.9" },
      { start: "back", end: "front", name: "c", power: 0.1, text: "0.1" },
      { start: "front", end: "eye", name: "d", power: 0.2, text: "0.2" }],
      leaves: [{ name: "back.out", power: 0.8, text: "0.8" }], taken: [], ends: [] }"""
    kept = "({ layers, bands }) => [layers, bands.map((each) => each.back)]"
    layers, back = it("flow.js", f"({kept})(it.flowOf({energy}))")
    assert layers == [["lamp"], ["front"], ["back", "eye"]]
    assert back == [False, False, True, False]


def test_of_questions_that_wait_the_newest_is_asked(it):
    asked = """(async () => {
      const answered = [];
      let free;
      const slow = (n) => new Promise((done) => { free = () => done(n * 10); });
      const ask = it.newest(slow, (n, answer) => answered.push(answer));
      const all = ask(1); ask(2); ask(3);
      free(); await new Promise((done) => setTimeout(done, 0));
      free(); await all;
      return answered;
    })()"""
    assert it("api.js", f"await {asked}") == [10, 30]

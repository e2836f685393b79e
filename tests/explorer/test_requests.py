"""What the page asks for: strict JSON of a known shape, and a sentence to all else."""

import json
import random

import pytest

from explorer.served import head_of, posted, raw
from optipath.errors import OptipathError
from optipath.explorer.asked_state import AskedCurve, asked_state
from optipath.explorer.strict_json import read_json
from tables import rows, slow

ALL = ("case", "places", "values", "detector", "curve", "want")
CURVE = {"x": "delta", "from": "0", "to": "90", "count": 181, "y": ["S0"]}
MALUS = {"preset": "malus"}


@rows(
    "given, told",
    [
        (b"", "no JSON at character 0"),
        (b'{"a": 1} {"b": 2}', "no JSON at character 9"),
        (b"\xff\xfe", "no UTF-8 from byte 0"),
        (b'{"a": NaN}', "has NaN, which JSON does not know"),
        (b'{"a": 1e999}', "no finite number"),
        (b'{"a": ' + b"9" * 5000 + b"}", "too many digits"),
        (b'{"a": "\\ud800"}', "half a character"),
        (b'{"a": 1, "a": 2}', "the name 'a' twice"),
        (b'{"a":' * 9 + b"1" + b"}" * 9, "brackets more than 8 levels deep"),
        (b'{"a": "\x00"}', "no JSON"),
    ],
)
def test_what_is_no_json_is_refused_in_a_sentence(given, told):
    with pytest.raises(OptipathError, match="the request ") as refused:
        read_json(given)
    assert told in str(refused.value)
    assert str(refused.value).count("\n") == 0


def test_what_is_json_and_a_whole_state_are_read():
    found = read_json(b'{"a": ["[[[[[[[[[[", 1.5, null, true, "\\""]}')
    assert found == {"a": ["[[[[[[[[[[", 1.5, None, True, '"']}
    assert read_json(b'{"a":' * 8 + b"1" + b"}" * 8)["a"]
    state = {"preset": "npgr026", "case": "8", "detector": None, "want": ["energy", "energy"]}
    state |= {"places": {"place": "eye"}, "values": {"delta": "48 deg"}, "curve": CURVE}
    found = asked_state(state, ALL)
    asked = found.preset, found.case, found.detector, found.want
    assert asked == ("npgr026", "8", None, ("energy",))
    for count in (2, 181, 2001):
        found = asked_state(MALUS | {"curve": CURVE | {"count": count}}, ALL)
        assert found.curve == AskedCurve("delta", "0", "90", count, ("S0",))


@rows(
    "given, told",
    [
        ([], "a request is an object"),
        ({}, "preset is missing"),
        ({"preset": None}, "preset must be a text, not null"),
        (MALUS | {"vales": {}}, "name 'vales' is unknown; did you mean 'values'?"),
        (MALUS | {"case": 8}, "case must be a text, not 8"),
        (MALUS | {"values": {"angle": 30}}, "values.angle must be a text, not 30"),
        (MALUS | {"values": ["angle"]}, "values must be an object"),
        (MALUS | {"values": {str(n): "" for n in range(501)}}, "an object of 501"),
        (MALUS | {"values": {"angle": "3" * 2001}}, "2001 characters; 2000 are the"),
        ({"preset": {"a": [None, False]}}, 'a text, not {"a": [null, false]}'),
        ({"preset": [0] * 99}, "0, 0,..."),
        (MALUS | {"want": "scene"}, "want must be a list"),
        (MALUS | {"want": ["scenes"]}, "did you mean 'scene'?"),
        (MALUS | {"curve": {}}, "curve.x is missing"),
        (MALUS | {"curve": CURVE | {"count": 1}}, "from 2 to 2001, not 1"),
        (MALUS | {"curve": CURVE | {"count": True}}, "from 2 to 2001, not true"),
        (MALUS | {"curve": CURVE | {"count": 2002}}, "from 2 to 2001, not 2002"),
        (MALUS | {"curve": CURVE | {"z": ""}}, "name in curve 'z' is unknown"),
        (MALUS | {"curve": CURVE | {"y": [1]}}, "curve.y[0] must be a text, not 1"),
    ],
)
def test_another_shape_is_refused_in_a_sentence(given, told):
    with pytest.raises(OptipathError) as refused:
        asked_state(given, ALL)
    assert told in str(refused.value)


def test_all_faults_of_shape_are_told_at_once_and_what_is_needed_must_be_there():
    with pytest.raises(OptipathError) as refused:
        asked_state({"case": 8, "want": 3, "x": 1}, ALL)
    assert len(refused.value.faults) == 4
    with pytest.raises(OptipathError, match="form is missing; give it"):
        asked_state(MALUS, (*ALL, "form"), ("form",))


COUNTS = pytest.mark.parametrize("count", [300, slow(10_000)])
STATE = MALUS | {"case": None, "places": {}, "values": {"angle": "30 deg"}, "detector": "eye"}
STATE |= {"curve": CURVE | {"x": "angle", "count": 5}, "want": ["energy", "scene", "explanation"]}
ODD = [
    None, True, 0, -1, 1e308, 10**30, "", "\x00", "\x1b]0;x\x07", "@/etc/passwd", "0:90:9999999",
    "9" * 1999, "1e99999", "nan", "../../x", "{}", [], [[[]]], {}, {"x": {}}, "\u202e",
    "\U0001d538" * 300, "__class__", "none", "1+2j", "30 deg", "gold", "a,b", "%s%n", "\u0663",
    "<script>",
]  # fmt: skip


def changed(draw, found):
    """Return a state with an odd part somewhere."""
    state = json.loads(json.dumps(found))
    for _ in range(draw.randint(1, 3)):
        part = state
        while isinstance(part, dict) and part:
            key = draw.choice([*part])
            if draw.random() < 0.4 or not isinstance(part[key], dict):
                if draw.random() < 0.2:
                    part[str(draw.choice(ODD))] = part.pop(key)
                else:
                    part[key] = draw.choice(ODD)
                break
            part = part[key]
    return state


@COUNTS
def test_odd_states_are_answered_with_sentences(server, count):
    draw = random.Random(21)  # noqa: S311 - the same each time
    for _ in range(count):
        state, place = changed(draw, STATE), draw.choice(["open", "trace", "export"])
        if place == "open":
            state = {name: state[name] for name in state if name in ("preset", "places")}
        if place == "export":
            state["form"] = draw.choice(["csv", "toml", "python", *ODD])
        status, found = posted(server, f"api/{place}", state)
        told = [found["error"]] if status == 400 else [f["sentence"] for f in found["faults"]]
        assert status in (200, 400), state
        for text in told:
            assert text.isprintable()
            assert "Traceback" not in text
            assert "/optipath/" not in text


@COUNTS
def test_damaged_bytes_are_answered_or_hung_up_on(server, capfd, count):
    draw = random.Random(22)  # noqa: S311 - the same each time
    body = json.dumps(STATE).encode()
    head = head_of(server, f"Content-Length: {len(body)}\r\nConnection: close\r\n")
    for _ in range(count):
        sent = bytearray(head + body)
        for _ in range(draw.randint(1, 6)):
            place = draw.randrange(len(sent) + 1) % max(len(sent), 1)
            if draw.random() < 0.5:
                sent[place] = draw.randrange(256)
            elif draw.random() < 0.5:
                del sent[place : place + draw.randint(1, 40)]
            else:
                sent[place:place] = draw.randbytes(draw.randint(1, 40))
        found = raw(server, bytes(sent), close=True)
        assert not found or found.startswith(b"HTTP/1.")
        assert b"Traceback" not in found
        assert b" 500 " not in found[:16]
    assert capfd.readouterr().err == ""
    assert posted(server, "api/trace", STATE)[1]["faults"] == []

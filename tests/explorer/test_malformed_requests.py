"""Hundreds of requests that nobody should send: each gets a sentence, and the next an answer."""

import json
import random

import pytest

from explorer.served import page_server, posted, raw
from tables import slow

COUNTS = pytest.mark.parametrize("count", [300, slow(10_000)])
STATE = {
    "preset": "malus",
    "case": None,
    "places": {},
    "values": {"angle": "30 deg"},
    "detector": "eye",
    "curve": {"x": "angle", "from": "0", "to": "90", "count": 5, "y": ["S0"]},
    "want": ["energy", "scene", "explanation"],
}
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


@pytest.fixture(scope="module")
def server():
    with page_server() as found:
        yield found


def is_sentence(text):
    return text.isprintable() and "Traceback" not in text and "/optipath/" not in text


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
        assert all(map(is_sentence, told)), told


@COUNTS
def test_damaged_bytes_are_answered_or_hung_up_on(server, capfd, count):
    draw = random.Random(22)  # noqa: S311 - the same each time
    body = json.dumps(STATE).encode()
    head = (
        f"POST /{server.token}/api/trace HTTP/1.1\r\nHost: 127.0.0.1:{server.server_port}\r\n"
        f"Content-Type: application/json\r\nContent-Length: {len(body)}\r\n"
        "Connection: close\r\n\r\n"
    ).encode()
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

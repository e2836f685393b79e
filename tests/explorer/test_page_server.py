"""The server: whom it answers, what it is asked in strict JSON, and what it never does."""

import json
import random
import re
import socket
import time

import pytest

from explorer.served import asked, head_of, page_server, posted, raw
from optipath.errors import OptipathError
from optipath.explorer.server import HOST, PageHandler, page_files, read_json
from optipath.explorer.state import RequestedCurve, requested_state
from optipath.values.units import UNITS
from tables import rows, slow

ARABIC_TWO = "\u0662".encode().decode("latin-1")
FORBIDDEN = {"error": "this is not the address that optipath explore has printed"}
ALL = ("case", "places", "values", "detector", "curve", "want")
CURVE = {"x": "delta", "from": "0", "to": "90", "count": 181, "y": ["S0"]}
MALUS = {"preset": "malus"}


@pytest.fixture(scope="module")
def server():
    with page_server() as found:
        yield found


def test_it_listens_to_this_machine_alone_at_an_address_that_is_free(server):
    assert server.socket.getsockname()[0] == HOST == "127.0.0.1"
    assert server.address == f"http://127.0.0.1:{server.server_port}/{server.token}/"
    assert len(server.token) == 32
    taken = pytest.raises(OptipathError, match=r"cannot be listened at.*give another")
    with taken, page_server(port=server.server_port):
        pass


def test_the_page_comes_with_headers_that_let_nothing_else_in_and_files_with_types(server):
    status, headers, page = asked(server, "GET", "")
    assert status == 200
    assert page.startswith(b"<!doctype html>")
    assert headers["Content-Security-Policy"].startswith("default-src 'self'; style-src 'self'")
    assert "unsafe" not in headers["Content-Security-Policy"]
    sent = {"X-Content-Type-Options": "nosniff", "Referrer-Policy": "no-referrer"}
    assert {*headers.items()} >= {*sent.items(), ("Cache-Control", "no-store")}
    assert headers["Server"] == "optipath"
    kinds = {"main.js": "text/javascript", "style.css": "text/css", "icon.svg": "image/svg+xml"}
    for name, kind in kinds.items():
        status, headers, content = asked(server, "GET", f"page/{name}")
        assert (status, headers.get_content_type()) == (200, kind)
        assert len(content) == int(headers["Content-Length"])


def test_the_units_are_those_of_the_library_and_the_page_has_no_table_of_its_own(server):
    served = json.loads(asked(server, "GET", "api/presets")[2])["units"]
    assert {name: unit["dimension"] for name, unit in served.items()} == {
        name: unit.dimension for name, unit in UNITS.items()
    }
    for name, unit in UNITS.items():
        assert served[name]["size"] == pytest.approx(unit.size * 10.0**unit.power), name
    code = page_files()["page/units.js"][1].decode()
    assert "useUnits(" in page_files()["page/main.js"][1].decode()
    assert [name for name in UNITS if re.search(rf"\b{re.escape(name)}\W*:", code)] == []


def test_questions_are_answered(server):
    status, _, answer = asked(server, "GET", "api/presets")
    found = json.loads(answer)
    assert (status, found["opened"]) == (200, "malus")
    assert {"name", "description", "file"} == {*found["presets"][0]}
    status, found = posted(server, "api/trace", {"preset": "malus", "values": {"angle": "60"}})
    assert (status, found["detectors"]["eye"]["texts"][0]) == (200, "0.125")
    assert posted(server, "api/open", {"preset": "malus"})[1]["detectors"] == ["eye"]
    status, headers, content = asked(server, "HEAD", "api/presets")
    assert (status, content) == (200, b"")
    assert int(headers["Content-Length"]) > 100
    # One connection serves many.
    place = f"GET /{server.token}/api/presets HTTP/1.1\r\nHost: 127.0.0.1:{server.server_port}\r\n"
    sent = f"{place}\r\n" * 3 + f"{place}Connection: close\r\n\r\n"
    assert raw(server, sent.encode()).count(b"HTTP/1.1 200 OK") == 4


@rows("below", ["/", "", "/favicon.ico", "/{token}", "/{token}x/", "/{other}/"])
def test_nothing_is_told_without_the_token(server, below):
    other = server.token[:-1] + ("A" if server.token[-1] != "A" else "B")
    below = below.format(token=server.token, other=other)
    for method in ("GET", "POST", "HEAD"):
        status, headers, answer = asked(server, method, "", below=below or "*")
        assert status == 403
        assert "Access-Control-Allow-Origin" not in headers
        assert method == "HEAD" or json.loads(answer) == FORBIDDEN


@rows(
    "header, text",
    [
        *(("Host", name) for name in ("evil.example", "127.0.0.1", "127.0.0.1:1")),
        *(("Origin", place) for place in ("http://evil.example", "null", "https://127.0.0.1")),
        ("Sec_Fetch_Site", "cross-site"),
    ],
)
def test_other_pages_are_refused_even_with_the_token(server, header, text):
    assert asked(server, "GET", "", **{header: text})[0] == 403
    assert posted(server, "api/trace", {"preset": "malus"}, **{header: text}) == (403, FORBIDDEN)


def test_its_page_has_two_names_and_a_fault_of_its_own_a_sentence(server, monkeypatch, capsys):
    for name in ("127.0.0.1", "localhost"):
        host = f"{name}:{server.server_port}"
        assert asked(server, "GET", "", Host=host, Origin=f"http://{host}")[0] == 200
    both = {"Host": f"localhost:{server.server_port}", "Origin": server.address.rpartition("/")[0]}
    assert asked(server, "GET", "", **both)[0] == 403

    def broken(_):
        raise ZeroDivisionError("secret /home/me\nmore")

    monkeypatch.setattr(server.answers, "trace", broken)
    status, found = posted(server, "api/trace", {"preset": "malus"})
    assert (status, "secret" in found["error"]) == (500, False)
    assert capsys.readouterr().err.count("\n") == 1


def test_nothing_else_is_sent_and_no_other_method_answered(server):
    odd = "page/../request_guards.py page/%2e%2e/request_guards.py page//etc/passwd ?x=1 page/ api "
    odd += "../../etc/passwd page/index.html api/trace/ api/open?preset=malus page/main.js\\.."
    for place in odd.split():
        status, _, answer = asked(server, "GET", place)
        nothing = {"error": "there is nothing at this address"}
        assert (status, json.loads(answer)) == (404, nothing), place
    for method in ("PUT", "DELETE", "OPTIONS", "PATCH", "TRACE", "CONNECT", "FOO"):
        assert asked(server, method, "")[0] == 501, method
    assert asked(server, "GET", "api/trace")[0] == 405
    assert posted(server, "page/main.js", {})[0] == 405
    assert posted(server, "page/none.js", {})[0] == 404


@rows(
    "headers, body, status, told",
    [
        ({}, b"x" * (64 * 1024 + 1), 413, "65536 are the most"),
        ({"Content_Type": "application/jsonx"}, b"{}", 400, "Content-Type: application/json"),
        *(
            ({"Content_Length": n}, b"{}", 400, "Content-L")
            for n in ("-5", "+2", "1e3", ARABIC_TWO)
        ),
        ({"Content_Length": "99999999999"}, b"{}", 413, "65536 are the most"),
        ({"Transfer_Encoding": "chunked"}, b"0\r\n\r\n", 400, "in parts"),
        ({"Content_Encoding": "gzip"}, b"{}", 400, "packed"),
        ({}, b"{", 400, "no JSON"),
        ({}, b"[]", 400, "a request is an object"),
        ({}, b'{"preset": "malus", "path": "/etc"}', 400, "name 'path' is unknown"),
    ],
)
def test_what_is_malformed_is_refused_in_a_sentence(server, headers, body, status, told):
    found = posted(server, "api/trace", body, **headers)
    assert found[0] == status
    assert told in found[1]["error"]
    assert [*found[1]] == ["error"]


@rows(
    "sent, status",
    [
        (b"\r\n", b""),
        (b"GET\r\n\r\n", b"400"),
        (b"GET / HTTP/9.9\r\n\r\n", b"505"),
        (b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03\r\n\r\n", b"400"),
        (b"GET /" + b"a" * 70000 + b" HTTP/1.1\r\n\r\n", b"414"),
        (b"GET / HTTP/1.1\r\nA: " + b"a" * 70000 + b"\r\n\r\n", b"431"),
        (b"GET / HTTP/1.1\r\n" + b"A: b\r\n" * 200 + b"\r\n", b"431"),
        (b"GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n", b"403"),
        (b"GET /\r\n", b"403"),
        ("Content-Length: 2\r\nContent-Length: 30\r\n", b"400"),
    ],
)
def test_what_is_no_request_gets_a_status_and_nothing_of_it_back(server, sent, status):
    sent = sent if isinstance(sent, bytes) else head_of(server, sent) + b"{}"
    found = raw(server, sent, close=True)
    assert found[9:12] == status
    assert b"Traceback" not in found
    assert b"aaaa" not in found


def test_who_says_nothing_or_half_is_hung_up_on(monkeypatch):
    monkeypatch.setattr(PageHandler, "timeout", 0.2)
    with page_server() as server:
        begin = time.monotonic()
        assert raw(server, b"GET / HT") == b""
        # A body that never comes is not waited for.
        assert raw(server, head_of(server, "Content-Length: 30\r\n") + b"{}") == b""
        assert time.monotonic() - begin < 8.0
    with pytest.raises(ConnectionRefusedError):
        asked(server, "GET", "")


def test_many_connections_that_say_nothing_keep_nobody_waiting(server):
    held = [socket.create_connection((HOST, server.server_port), 10) for _ in range(200)]
    try:
        for each in held:
            each.sendall(b"G")
        assert asked(server, "GET", "")[0] == 200
    finally:
        for each in held:
            each.close()


@rows(
    "given",
    [
        *(b"", b'{"a": 1} {"b": 2}', b"\xff\xfe", b'{"a": ' + b"9" * 5000 + b"}"),
        *(b'{"a":' * 60_000, b'{"a": "\x00"}'),
    ],
)
def test_what_is_no_json_is_refused_in_a_sentence(given):
    with pytest.raises(OptipathError, match="the request is no JSON: ") as refused:
        read_json(given)
    assert str(refused.value).count("\n") == 0


def test_what_is_json_and_a_whole_state_are_read_and_all_faults_told_at_once():
    found = read_json(b'{"a": ["[[[[[[[[[[", 1.5, null, true, "\\""]}')
    assert found == {"a": ["[[[[[[[[[[", 1.5, None, True, '"']}
    state = {"preset": "npgr026", "case": "8", "detector": None, "want": ["energy", "energy"]}
    state |= {"places": {"place": "eye"}, "values": {"delta": "48 deg"}, "curve": CURVE}
    found = requested_state(state, ALL)
    asked = found.preset, found.case, found.detector, found.want
    assert asked == ("npgr026", "8", None, ("energy",))
    for count in (2, 181, 2001):
        found = requested_state(MALUS | {"curve": CURVE | {"count": count}}, ALL)
        assert found.curve == RequestedCurve("delta", "0", "90", count, ("S0",))
    # All faults of shape are told at once, and what is needed must be there.
    with pytest.raises(OptipathError) as refused:
        requested_state({"case": 8, "want": 3, "x": 1}, ALL)
    assert len(refused.value.faults) == 4
    with pytest.raises(OptipathError, match="form is missing; give it"):
        requested_state(MALUS, (*ALL, "form"), ("form",))


@rows(
    "given, told",
    [
        ([], "a request is an object"),
        ({}, "preset is missing"),
        ({"preset": None}, "preset must be a text, not null"),
        (MALUS | {"vales": {}}, "name 'vales' is unknown; did you mean 'values'?"),
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
        requested_state(given, ALL)
    assert told in str(refused.value)


COUNTS = pytest.mark.parametrize("count", [100, slow(10_000)])
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

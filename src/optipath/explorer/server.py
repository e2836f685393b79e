"""Server of the page: one local address, guarded requests."""

from __future__ import annotations

import json
import math
import os
import re
import socket
import sys
import time
from contextlib import suppress
from functools import cache
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from importlib.resources import files
from io import BufferedReader, RawIOBase
from secrets import compare_digest, token_urlsafe
from socketserver import TCPServer
from threading import BoundedSemaphore, Lock
from typing import TYPE_CHECKING, Any, NamedTuple, Never, Self

from optipath.errors import OptipathError, ParameterError, printable, shown

if TYPE_CHECKING:
    from email.message import Message

    from optipath.explorer.answers import PageAnswers


HOST = "127.0.0.1"
"""Nobody else than this machine can reach it."""

_MOST = 48
"""How many connections there are at most; a browser has six."""


class PageServer(ThreadingHTTPServer):
    """The server of one page, at an address that nobody can guess."""

    daemon_threads = True
    block_on_close = False
    request_queue_size = 16
    # Elsewhere it lets a second program listen where one does already.
    allow_reuse_address = os.name == "posix"

    def __init__(self, answers: PageAnswers, port: int = 0) -> None:
        self.answers = answers
        self.token = token_urlsafe(24)
        self._free = BoundedSemaphore(_MOST)
        self._open: set[socket.socket] = set()
        self._lock = Lock()
        try:
            super().__init__((HOST, port), PageHandler)
        except (OSError, OverflowError) as error:
            reason = getattr(error, "strerror", None) or error
            raise ParameterError(
                f"port {port} cannot be listened at: {reason}; give another, or leave --port out"
            ) from None

    def server_bind(self) -> None:
        """Listen, without asking anybody for the name of this machine."""
        TCPServer.server_bind(self)
        self.server_name, self.server_port = HOST, int(self.server_address[1])

    @property
    def address(self) -> str:
        """What a browser opens."""
        return f"http://{HOST}:{self.server_port}/{self.token}/"

    def process_request(self, request: Any, client_address: Any) -> None:
        """Answer a connection in a thread of its own; hang up where there are too many."""
        if not self._free.acquire(blocking=False):
            self.shutdown_request(request)
            return
        with self._lock:
            self._open.add(request)
        try:
            super().process_request(request, client_address)
        except RuntimeError:  # No thread can be started.
            self.shutdown_request(request)

    def shutdown_request(self, request: Any) -> None:
        """Close a connection, and let another have its place."""
        with self._lock:
            was_open = request in self._open
            self._open.discard(request)
        super().shutdown_request(request)
        if was_open:
            self._free.release()

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Say nothing: whoever asked has hung up."""
        del request, client_address

    def server_close(self) -> None:
        """Stop listening, and hang up on all who are connected."""
        super().server_close()
        with self._lock:
            still_open = [*self._open]
        for connection in still_open:
            with suppress(OSError):
                connection.shutdown(socket.SHUT_RDWR)

    def __enter__(self) -> Self:
        return self


_FIRST, _NEXT, _SENDING = 10.0, 60.0, 20.0
"""Seconds for a first request, for another of somebody who knows the token, and for an answer."""

_DRAINED = 1 << 20
"""How many bytes of a refused request are read, so that its sender comes to read the answer."""

_HEADERS = {
    "Content-Security-Policy": (
        "default-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; "
        "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    ),
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-store",
}
_JSON = "application/json; charset=utf-8"
_ROUTES = {"api/open": "open", "api/trace": "trace", "api/export": "export"}
_PRESETS = "api/presets"


class _PatientReader(RawIOBase):
    """What reads a connection up to a moment, however slowly it comes."""

    def __init__(self, connection: socket.socket) -> None:
        self.connection = connection
        self.until = 0.0

    def readable(self) -> bool:
        return True

    def readinto(self, buffer: Any) -> int:
        left = self.until - time.monotonic()
        if left <= 0.0:
            raise TimeoutError
        self.connection.settimeout(left)
        return self.connection.recv_into(buffer)


class PageHandler(BaseHTTPRequestHandler):
    """One connection; see `BaseHTTPRequestHandler`, which calls its methods."""

    server: Any  # A `PageServer`, which makes these.
    protocol_version = "HTTP/1.1"
    default_request_version = "HTTP/1.0"

    def setup(self) -> None:
        """Begin a connection, of which nobody is known yet."""
        super().setup()
        self.rfile.close()
        self._patient = _PatientReader(self.connection)
        self.rfile = BufferedReader(self._patient)
        self._known = False

    def handle_one_request(self) -> None:
        """Answer one request, which must be there whole before its time is up."""
        self._patient.until = time.monotonic() + (_NEXT if self._known else _FIRST)
        self.close_connection = True
        super().handle_one_request()

    def version_string(self) -> str:
        """Return what the server calls itself, without the version of anything."""
        return "optipath"

    def log_message(self, *_: Any) -> None:
        """Write no log: an address in it would hold the token."""

    def handle_expect_100(self) -> bool:
        """Promise nothing: whether what follows is read is told by the answer."""
        return True

    def do_GET(self) -> None:
        """Answer with a file of the page, or with what there is."""
        place = self._admitted()
        if place is None:
            return
        file = page_files().get(place)
        if file is not None:
            self._send(HTTPStatus.OK, file.kind, file.content)
        elif place == _PRESETS:
            self._send_json(self.server.answers.presets())
        elif place in _ROUTES:
            self._refuse(Refusal(405, f"{place} is asked by POST"))
        else:
            self._refuse(Refusal(404, "there is nothing at this address"))

    do_HEAD = do_GET  # noqa: N815 - as the base class calls it

    def do_POST(self) -> None:
        """Answer a question about a path."""
        place = self._admitted()
        if place is None:
            return
        if place not in _ROUTES:
            known = place == _PRESETS or place in page_files()
            sentence = "this is asked by GET" if known else "there is nothing at this address"
            self._refuse(Refusal(405 if known else 404, sentence))
        elif refusal := body_refusal(self.headers):
            self._refuse(refusal)
        elif (body := self._body()) is not None:
            self._answer(_ROUTES[place], body)

    def __getattr__(self, name: str) -> Any:
        # Whatever other method there may be is refused, by a status that says so.
        if name.startswith("do_"):
            return self._other_method
        raise AttributeError(name)

    def _other_method(self) -> None:
        if self._admitted() is not None:
            self._refuse(Refusal(405, "the page is asked by GET, HEAD and POST"))

    def _admitted(self) -> str | None:
        """Return what is asked for; None where nobody may ask, who has been told so then."""
        place = requested_place(self.path, self.server.token)
        refusal = origin_refusal(self.headers, self.server.server_port)
        if place is None or refusal is not None:
            self._refuse(refusal or forbidden())
            return None
        self._known = True
        has_body = self.headers.get("Content-Length", "0") != "0"
        self.close_connection = self.close_connection or (self.command != "POST" and has_body)
        return place

    def _body(self) -> bytes | None:
        """Return what stands behind the head; None where the sender does not send all of it."""
        length = int(self.headers["Content-Length"])
        body = self.rfile.read(length)
        self.close_connection = self.close_connection or len(body) < length
        return body if len(body) == length else None

    def _answer(self, name: str, body: bytes) -> None:
        try:
            result = getattr(self.server.answers, name)(read_json(body))
            content = json.dumps(result, allow_nan=False).encode()
        except OptipathError as error:
            self._send_json({"error": "; ".join(error.faults)}, HTTPStatus.BAD_REQUEST)
        except Exception as error:  # noqa: BLE001 - the page gets a sentence, whatever happens
            self._tell(error)
            sentence = "optipath could not answer this, which is a fault of its own; please tell us"
            self._send_json({"error": sentence}, HTTPStatus.INTERNAL_SERVER_ERROR)
        else:
            self._send(HTTPStatus.OK, _JSON, content)

    def _tell(self, error: Exception) -> None:
        """Write a fault of the program's own where it runs, and nowhere else."""
        with suppress(OSError, ValueError):
            message = f"optipath: fault of the explorer: {type(error).__name__}: {error}"
            sys.stderr.write(printable(" ".join(message.split())) + "\n")

    def send_error(self, code: int, message: str | None = None, explain: str | None = None) -> None:
        """Refuse what is no request at all, without repeating any of it."""
        del message, explain
        self.request_version = "HTTP/1.1"  # So that a head is sent, whatever was asked.
        self._refuse(Refusal(code, "the request cannot be read; open the address that is printed"))

    def _refuse(self, refusal: Refusal) -> None:
        """Say why, and hang up."""
        self.close_connection = True
        self._send_json({"error": refusal.sentence}, refusal.status)
        with suppress(OSError):
            self._drain()

    def _drain(self) -> None:
        """Read what still comes, for a moment: a sender that cannot write never reads."""
        self.connection.shutdown(1)
        self._patient.until = min(self._patient.until, time.monotonic() + 1.0)
        left = _DRAINED
        while left > 0 and (read := len(self.rfile.read1(1 << 16))):
            left -= read

    def _send_json(self, result: Any, status: int = HTTPStatus.OK) -> None:
        self._send(status, _JSON, json.dumps(result, allow_nan=False).encode())

    def _send(self, status: int, kind: str, content: bytes) -> None:
        self.connection.settimeout(_SENDING)
        self.send_response(status)
        for name, text in _HEADERS.items():
            self.send_header(name, text)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(content)))
        if status == HTTPStatus.METHOD_NOT_ALLOWED:
            self.send_header("Allow", "GET, HEAD, POST")
        if self.close_connection:
            self.send_header("Connection", "close")
        self.end_headers()
        if getattr(self, "command", None) != "HEAD":
            self.wfile.write(content)


LARGEST_BODY = 64 * 1024
"""How many bytes a request has at most behind its head."""

_LENGTH = re.compile(r"[0-9]{1,12}", re.ASCII)
_FORBIDDEN = "this is not the address that optipath explore has printed"
_CROSS = "cross-site"


class Refusal(NamedTuple):
    """Why a request is not answered."""

    status: int
    sentence: str


def requested_place(path: str, token: str) -> str | None:
    """Return what is asked for below the token; None where the token is not the right one.

    >>> paths = ("/abc/api/open", "/abd/", "/abc")
    >>> tuple(requested_place(path, "abc") for path in paths)
    ('api/open', None, None)
    """
    before, _, behind = path.removeprefix("/").partition("/")
    is_below = path.startswith("/") and path.count("/") > 1
    is_right = compare_digest(before.encode("utf-8", "surrogatepass"), token.encode())
    return behind if is_right and is_below else None


def origin_refusal(headers: Message, port: int) -> Refusal | None:
    """Return why a request is refused that another page has sent, or came by another name."""
    hosts = headers.get_all("Host", [])
    if len(hosts) != 1 or hosts[0].strip() not in {f"127.0.0.1:{port}", f"localhost:{port}"}:
        return Refusal(403, _FORBIDDEN)
    origins = headers.get_all("Origin", [])
    if any(origin.strip() != f"http://{hosts[0].strip()}" for origin in origins):
        return Refusal(403, _FORBIDDEN)
    if any(_CROSS in site for site in headers.get_all("Sec-Fetch-Site", [])):
        return Refusal(403, _FORBIDDEN)
    return None


def forbidden() -> Refusal:
    """Return what is told to all who do not know the token."""
    return Refusal(403, _FORBIDDEN)


def body_refusal(headers: Message) -> Refusal | None:
    """Return why what stands behind the head of a request is not read."""
    kinds = headers.get_all("Content-Type", [])
    if headers.get_all("Transfer-Encoding") or headers.get_all("Content-Encoding"):
        return Refusal(400, "the request is sent in parts or packed; send JSON with its length")
    lengths = headers.get_all("Content-Length", [])
    if len(lengths) != 1 or not _LENGTH.fullmatch(lengths[0].strip()):
        return Refusal(400, "the request has no Content-Length, or no number; give its bytes")
    if int(lengths[0]) > LARGEST_BODY:
        return Refusal(413, f"the request has {int(lengths[0])} bytes; {LARGEST_BODY} are the most")
    if len(kinds) != 1 or kinds[0].partition(";")[0].strip().lower() != "application/json":
        return Refusal(400, "the request is of another type; send Content-Type: application/json")
    return None


_TYPES = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".svg": "image/svg+xml",
}


class PageFile(NamedTuple):
    """A file of the page."""

    kind: str
    content: bytes


@cache
def page_files() -> dict[str, PageFile]:
    """Return the files by the name under which they are asked for."""
    folder = files("optipath.explorer").joinpath("page")
    results = {}
    for file in folder.iterdir():
        kind = _TYPES.get("." + file.name.rpartition(".")[2])
        if kind is not None:
            name = "" if file.name == "index.html" else f"page/{file.name}"
            results[name] = PageFile(kind, file.read_bytes())
    return results


_DEEPEST = 8
"""How many brackets within each other a request has at most; its shape needs three."""

_TEXTS = re.compile(r'"(?:[^"\\]|\\.)*"?', re.DOTALL)


def read_json(argument: bytes) -> Any:
    """Return what a JSON text says.

    >>> read_json(b'{"preset": "malus"}')
    {'preset': 'malus'}
    """
    try:
        text = argument.decode()
    except UnicodeDecodeError as fault:
        raise _refused(f"is no UTF-8 from byte {fault.start} on; send JSON in UTF-8") from None
    if _depth(text) > _DEEPEST:
        raise _refused(f"has brackets more than {_DEEPEST} levels deep; send one object")
    try:
        result = json.loads(
            text, parse_constant=_no_number, parse_float=_finite, object_pairs_hook=_once
        )
        json.dumps(result, ensure_ascii=False).encode()
    except UnicodeEncodeError:
        raise _refused("has half a character, a surrogate by itself; send whole ones") from None
    except json.JSONDecodeError as fault:
        raise _refused(f"is no JSON at character {fault.pos}; send one JSON object") from None
    except ValueError:
        raise _refused("has a whole number of too many digits; send values as texts") from None
    return result


def _depth(text: str) -> int:
    """Return how many brackets stand within each other at most, those in texts aside."""
    depth = deepest = 0
    for each in _TEXTS.sub("", text):
        depth += (each in "[{") - (each in "]}")
        deepest = max(deepest, depth)
    return deepest


def _no_number(word: str) -> Never:
    raise _refused(f"has {word}, which JSON does not know; send values as texts")


def _finite(text: str) -> float:
    number = float(text)
    if not math.isfinite(number):
        raise _refused(f"has {shown(text)}, which is no finite number; send values as texts")
    return number


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    results = dict(pairs)
    if len(results) < len(pairs):
        names = [name for name, _ in pairs]
        twice = next(name for name in names if names.count(name) > 1)
        raise _refused(f"has the name {shown(twice)} twice; leave one out")
    return results


def _refused(what: str) -> ParameterError:
    return ParameterError(f"the request {what}")

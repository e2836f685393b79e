"""One connection of the page: what it asks for, within limits, and what it is answered."""

from __future__ import annotations

import json
import sys
import time
from contextlib import suppress
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler
from io import BufferedReader, RawIOBase
from typing import TYPE_CHECKING, Any

from optipath.errors import OptipathError, printable
from optipath.explorer.page_files import page_files
from optipath.explorer.request_guards import (
    Refusal,
    body_refusal,
    forbidden,
    origin_refusal,
    place_asked,
)
from optipath.explorer.strict_json import read_json

if TYPE_CHECKING:
    import socket

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
        place = place_asked(self.path, self.server.token)
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
            found = getattr(self.server.answers, name)(read_json(body))
            content = json.dumps(found, allow_nan=False).encode()
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
            told = f"optipath: fault of the explorer: {type(error).__name__}: {error}"
            sys.stderr.write(printable(" ".join(told.split())) + "\n")

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

    def _send_json(self, found: Any, status: int = HTTPStatus.OK) -> None:
        self._send(status, _JSON, json.dumps(found, allow_nan=False).encode())

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

"""Server of the page: one local address, guarded requests."""

from __future__ import annotations

import json
import os
import sys
from contextlib import suppress
from functools import cache
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from importlib.resources import files
from secrets import compare_digest, token_urlsafe
from socketserver import TCPServer
from typing import TYPE_CHECKING, Any

from optipath.errors import OptipathError, ParameterError
from optipath.faults import printable

if TYPE_CHECKING:
    from optipath.explorer.answers import PageAnswers


HOST = "127.0.0.1"
"""Nobody else than this machine can reach it."""


class PageServer(ThreadingHTTPServer):
    """The server of one page, at an address that nobody can guess."""

    daemon_threads = True
    block_on_close = False
    # Elsewhere it lets a second program listen where one does already.
    allow_reuse_address = os.name == "posix"

    def __init__(self, answers: PageAnswers, port: int = 0) -> None:
        self.answers = answers
        self.token = token_urlsafe(24)
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

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Say nothing: whoever asked has hung up."""
        del request, client_address


LARGEST_BODY = 64 * 1024
"""How many bytes a request has at most behind its head."""

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
_NOTHING = "there is nothing at this address"


class PageHandler(BaseHTTPRequestHandler):
    """One connection; see `BaseHTTPRequestHandler`, which calls its methods."""

    server: Any  # A `PageServer`, which makes these.
    protocol_version = "HTTP/1.1"
    default_request_version = "HTTP/1.0"
    timeout = 20.0
    """Seconds for which nothing may come, or be taken."""

    def version_string(self) -> str:
        """Return what the server calls itself, without the version of anything."""
        return "optipath"

    def log_message(self, *_: Any) -> None:
        """Write no log: an address in it would hold the token."""

    def do_GET(self) -> None:
        """Answer with a file of the page, or with what there is."""
        place = self._admitted()
        if place is None:
            return
        self.close_connection = self.close_connection or "Content-Length" in self.headers
        if file := page_files().get(place):
            self._send(HTTPStatus.OK, *file)
        elif place == _PRESETS:
            self._send_json(self.server.answers.presets())
        elif place in _ROUTES:
            self._refuse(405, f"{place} is asked by POST")
        else:
            self._refuse(404, _NOTHING)

    do_HEAD = do_GET  # noqa: N815 - as the base class calls it

    def do_POST(self) -> None:
        """Answer a question about a path."""
        place = self._admitted()
        if place is None:
            return
        length, kind = self.headers.get("Content-Length", ""), self.headers.get_content_type()
        if place == _PRESETS or place in page_files():
            self._refuse(405, "this is asked by GET")
        elif place not in _ROUTES:
            self._refuse(404, _NOTHING)
        elif "Transfer-Encoding" in self.headers or "Content-Encoding" in self.headers:
            self._refuse(400, "the request is sent in parts or packed; send JSON with its length")
        elif not (length.isascii() and length.isdigit()) or self._has_several("Content-Length"):
            self._refuse(400, "the request has no Content-Length, or no number; give its bytes")
        elif len(length) > len(str(LARGEST_BODY)) or int(length) > LARGEST_BODY:
            self._refuse(413, f"the request is too long; {LARGEST_BODY} are the most bytes")
        elif kind != "application/json":
            self._refuse(400, "the request is of another type; send Content-Type: application/json")
        elif len(body := self.rfile.read(int(length))) == int(length):
            self._answer(_ROUTES[place], body)
        else:
            self.close_connection = True

    def _admitted(self) -> str | None:
        """Return what is asked for; None where nobody may ask, who has been told so then."""
        token, _, place = self.path.removeprefix("/").partition("/")
        known = compare_digest(token.encode("utf-8", "surrogatepass"), self.server.token.encode())
        if known and self.path.count("/") > 1 and self._is_from_the_page():
            return place
        self._refuse(403, "this is not the address that optipath explore has printed")
        return None

    def _is_from_the_page(self) -> bool:
        """Tell whether no other page has sent the request, nor came it by another name."""
        host = self.headers.get("Host", "")
        origin = self.headers.get("Origin", f"http://{host}")
        return (
            host in {f"{name}:{self.server.server_port}" for name in (HOST, "localhost")}
            and origin == f"http://{host}"
            and self.headers.get("Sec-Fetch-Site") != "cross-site"
            and not any(map(self._has_several, ("Host", "Origin", "Sec-Fetch-Site")))
        )

    def _has_several(self, header: str) -> bool:
        return len(self.headers.get_all(header, [])) > 1

    def _answer(self, name: str, body: bytes) -> None:
        try:
            result = getattr(self.server.answers, name)(read_json(body))
            content = json.dumps(result, allow_nan=False).encode()
        except OptipathError as error:
            sentences = [fault.written("page") for fault in error.faults]
            self._send_json({"error": "; ".join(sentences)}, HTTPStatus.BAD_REQUEST)
        except Exception as error:  # noqa: BLE001 - the page gets a sentence, whatever happens
            with suppress(OSError, ValueError):  # There may be no terminal to write it to.
                message = f"optipath: fault of the explorer: {type(error).__name__}: {error}"
                sys.stderr.write(printable(" ".join(message.split())) + "\n")
            sentence = "optipath could not answer this, which is a fault of its own; please tell us"
            self._send_json({"error": sentence}, HTTPStatus.INTERNAL_SERVER_ERROR)
        else:
            self._send(HTTPStatus.OK, _JSON, content)

    def send_error(self, code: int, message: str | None = None, explain: str | None = None) -> None:
        """Refuse what is no request at all, without repeating any of it."""
        del message, explain
        self.request_version = "HTTP/1.1"  # So that a head is sent, whatever was asked.
        self._refuse(code, "the request cannot be read; open the address that is printed")

    def _refuse(self, status: int, sentence: str) -> None:
        """Say why, and hang up, once the sender has had a moment to come to read it."""
        self.close_connection = True
        self._send_json({"error": sentence}, status)
        with suppress(OSError):
            self.connection.settimeout(1.0)
            self.connection.shutdown(1)
            self.rfile.read(2 * LARGEST_BODY)

    def _send_json(self, result: Any, status: int = HTTPStatus.OK) -> None:
        self._send(status, _JSON, json.dumps(result, allow_nan=False).encode())

    def _send(self, status: int, kind: str, content: bytes) -> None:
        self.send_response(status)
        for name, text in _HEADERS.items():
            self.send_header(name, text)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(content)))
        if self.close_connection:
            self.send_header("Connection", "close")
        self.end_headers()
        if getattr(self, "command", None) != "HEAD":
            self.wfile.write(content)


_TYPES = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".svg": "image/svg+xml",
}


@cache
def page_files() -> dict[str, tuple[str, bytes]]:
    """Return the kind and the content of files, by the name under which they are asked for."""
    results = {}
    for file in files("optipath.explorer").joinpath("page").iterdir():
        if kind := _TYPES.get("." + file.name.rpartition(".")[2]):
            name = "" if file.name == "index.html" else f"page/{file.name}"
            results[name] = kind, file.read_bytes()
    return results


def read_json(argument: bytes) -> Any:
    """Return what a JSON text says."""
    try:
        return json.loads(argument.decode())
    except (ValueError, RecursionError) as error:
        raise ParameterError(f"the request is no JSON: {printable(str(error))}") from None

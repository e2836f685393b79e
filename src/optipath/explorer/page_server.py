"""The server of the page: one address of this machine, few connections, none of them for long."""

from __future__ import annotations

import os
import socket
from contextlib import suppress
from http.server import ThreadingHTTPServer
from secrets import token_urlsafe
from socketserver import TCPServer
from threading import BoundedSemaphore, Lock
from typing import TYPE_CHECKING, Any, Self

from optipath.errors import ParameterError
from optipath.explorer.page_handler import PageHandler

if TYPE_CHECKING:
    from optipath.explorer.page_answers import PageAnswers

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

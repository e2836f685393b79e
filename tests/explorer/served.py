"""A server of the page in this process, and what sends it bytes."""

import json
import socket
from contextlib import contextmanager, suppress
from http.client import HTTPConnection
from threading import Thread

from optipath.explorer.answers import PageAnswers
from optipath.explorer.paths import ExploredPresets
from optipath.explorer.server import PageServer


@contextmanager
def page_server(preset="malus", port=0):
    """Serve a page inside; nothing is left of it behind."""
    with PageServer(PageAnswers(ExploredPresets(preset)), port) as server:
        thread = Thread(target=server.serve_forever, kwargs={"poll_interval": 0.02})
        thread.start()
        try:
            yield server
        finally:
            server.shutdown()
            thread.join()


def asked(server, method, place, body=None, below=None, **headers):
    """Ask once; return the status, the headers and what is said."""
    connection = HTTPConnection("127.0.0.1", server.server_port, timeout=20)
    headers = {name.replace("_", "-"): text for name, text in headers.items()}
    below = f"/{server.token}/" if below is None else below
    try:
        connection.request(method, below + place, body, headers)
        answer = connection.getresponse()
        return answer.status, answer.headers, answer.read()
    finally:
        connection.close()


def posted(server, place, body, **headers):
    """Ask about a path; return the status and the answer."""
    sent = body if isinstance(body, bytes) else json.dumps(body).encode()
    headers = {"Content_Type": "application/json", **headers}
    status, _, answer = asked(server, "POST", place, sent, **headers)
    return status, json.loads(answer)


def head_of(server, lines):
    """The head of a question about a path, with further lines."""
    place = f"POST /{server.token}/api/trace HTTP/1.1\r\nHost: 127.0.0.1:{server.server_port}\r\n"
    return f"{place}Content-Type: application/json\r\n{lines}\r\n".encode()


def raw(server, sent, *, close=False):
    """Send bytes as they are; return all that comes back."""
    with socket.create_connection(("127.0.0.1", server.server_port), 20.0) as connection:
        found = b""
        with suppress(OSError):  # It has hung up.
            connection.sendall(sent)
            if close:
                connection.shutdown(socket.SHUT_WR)
            while part := connection.recv(1 << 16):
                found += part
        return found

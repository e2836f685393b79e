"""Who is answered: the page that this program has opened, and nobody else."""

from __future__ import annotations

import re
from secrets import compare_digest
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from email.message import Message

LARGEST_BODY = 64 * 1024
"""How many bytes a request has at most behind its head."""

_LENGTH = re.compile(r"[0-9]{1,12}", re.ASCII)
_FORBIDDEN = "this is not the address that optipath explore has printed"
_CROSS = "cross-site"


class Refusal(NamedTuple):
    """Why a request is not answered."""

    status: int
    sentence: str


def place_asked(path: str, token: str) -> str | None:
    """Return what is asked for below the token; None where the token is not the right one.

    Examples
    --------
    >>> place_asked("/abc/api/open", "abc"), place_asked("/abd/", "abc"), place_asked("/abc", "abc")
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

"""JSON that comes over the wire, read as strictly as it can be."""

from __future__ import annotations

import json
import math
import re
from typing import Any, Never

from optipath.errors import ParameterError, shown

_DEEPEST = 8
"""How many brackets within each other a request has at most; its shape needs three."""

_TEXTS = re.compile(r'"(?:[^"\\]|\\.)*"?', re.DOTALL)


def read_json(given: bytes) -> Any:
    """Return what a JSON text says.

    Examples
    --------
    >>> read_json(b'{"preset": "malus"}')
    {'preset': 'malus'}
    """
    try:
        text = given.decode()
    except UnicodeDecodeError as fault:
        raise _refused(f"is no UTF-8 from byte {fault.start} on; send JSON in UTF-8") from None
    if _depth(text) > _DEEPEST:
        raise _refused(f"has brackets more than {_DEEPEST} levels deep; send one object")
    try:
        found = json.loads(
            text, parse_constant=_no_number, parse_float=_finite, object_pairs_hook=_once
        )
        json.dumps(found, ensure_ascii=False).encode()
    except UnicodeEncodeError:
        raise _refused("has half a character, a surrogate by itself; send whole ones") from None
    except json.JSONDecodeError as fault:
        raise _refused(f"is no JSON at character {fault.pos}; send one JSON object") from None
    except ValueError:
        raise _refused("has a whole number of too many digits; send values as texts") from None
    return found


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
    found = dict(pairs)
    if len(found) < len(pairs):
        names = [name for name, _ in pairs]
        twice = next(name for name in names if names.count(name) > 1)
        raise _refused(f"has the name {shown(twice)} twice; leave one out")
    return found


def _refused(what: str) -> ParameterError:
    return ParameterError(f"the request {what}")

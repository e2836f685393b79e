"""Spelling: the word that a misspelt one was meant for."""

from __future__ import annotations

import math
from contextlib import contextmanager
from contextvars import ContextVar
from difflib import get_close_matches
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

_MOST_WORDS, _LONGEST = 1000, 100
"""How many words are compared, and how long they may be: the time grows with both."""

_ALIKE = 0.65
"""How like each other two words are, from 0 to 1, of which one may be meant for the other."""

_BEGINNING = 3
"""How many letters a word begins with at least that is meant for a longer one."""

_SIGNS = "-$"

_looks_left: ContextVar[float] = ContextVar("_looks_left", default=math.inf)


def closest(word: str, known: Iterable[str]) -> str | None:
    """Return the known word that a misspelt one was meant for; None where none is near.

    The beginning of a known word is meant for that; that of several, for none of them. Words of
    one or two letters are too short to tell, and numbers are no misspellings of each other, nor
    are such letters with a number.

    Examples
    --------
    >>> closest("--detla", ["--delta", "--rho"])
    '--delta'
    >>> closest("ellips", ["pyelli", "ellipsometry"])
    'ellipsometry'
    >>> closest("--plot", ["--delta"]), closest("10", ["1", "2"]), closest("n12", ["n1", "n2"])
    (None, None, None)
    """
    left, asked = _looks_left.get(), _bare(word)
    _looks_left.set(left - 1)
    if left <= 0 or len(word) > _LONGEST:
        return None
    words = [*known][:_MOST_WORDS]
    by_bare = {_bare(name): name for name in reversed(words) if len(name) <= _LONGEST}
    begun = [name for name in by_bare if name.startswith(asked)] if len(asked) >= _BEGINNING else []
    if len(begun) > 1 and asked not in by_bare:
        return None
    for found in get_close_matches(asked, begun or by_bare, cutoff=0.0 if begun else _ALIKE):
        if found == asked or not _too_short(asked, found):
            return by_bare[found]
    return None


def looks_left() -> bool:
    """Tell whether `closest` will look once more; see `few_suggestions`."""
    return _looks_left.get() > 0


@contextmanager
def few_suggestions(most: int = 20) -> Iterator[None]:
    """Let misspelt words be looked for so often inside, and no more: each look takes its time.

    Examples
    --------
    >>> with few_suggestions(1):
    ...     [closest(word, ["in", "out"]) for word in ("ou", "outt")]
    ['out', None]
    """
    token = _looks_left.set(most)
    try:
        yield
    finally:
        _looks_left.reset(token)


def _bare(word: str) -> str:
    """Return a word in small letters, without the signs in front, which make all words alike."""
    return word.lower().lstrip(_SIGNS)


def _too_short(asked: str, found: str) -> bool:
    letters = ["".join(c for c in word if not c.isdigit()) for word in (asked, found)]
    return max(map(len, (asked, found))) < 3 or (letters[0] == letters[1] and len(letters[0]) < 3)

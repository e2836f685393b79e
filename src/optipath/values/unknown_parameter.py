"""What is said of a name that no parameter has, and of a word that one does not know."""

from __future__ import annotations

from typing import TYPE_CHECKING

from optipath.errors import did_you_mean
from optipath.spelling import closest

if TYPE_CHECKING:
    from collections.abc import Iterable

_OF_A_COMPOSER = ("method", "model", "engine", "dtype", "tolerance", "composing", "loops")
_CASE = "cas"
"""What the word case begins with, however it goes on."""


def unknown_parameter(name: str, known: Iterable[str]) -> str:
    """Return the sentence for a parameter that there is not.

    Parameters
    ----------
    name : str
        What was written.
    known : iterable of str
        What could have been meant.

    Returns
    -------
    str
        It says where a case is named, and an option of a composer, if these were meant.

    Examples
    --------
    >>> unknown_parameter("dtype", ["delta"])
    "'dtype' is no parameter of the path; write Composer(dtype=...).compose(path)"
    """
    names = [*known]
    if closest(name, names) is None:
        if name in _OF_A_COMPOSER:
            return f"'{name}' is no parameter of the path; write Composer({name}=...).compose(path)"
        if name.lower().startswith(_CASE):
            return f"'{name}' is no parameter of the path; write load_preset(..., case=...)"
    return f"parameter '{name}' is unknown{did_you_mean(name, names)}"


def unknown_word(name: str, word: str, known: Iterable[str]) -> str:
    """Return the sentence for a word that a parameter does not know.

    Parameters
    ----------
    name, word : str
        The parameter, and what was given for it.
    known : iterable of str
        The words that it knows.

    Returns
    -------
    str

    Examples
    --------
    >>> unknown_word("filter", "vertikal", ["horizontal", "vertical"])
    "parameter 'filter' knows no word 'vertikal'; did you mean 'vertical'?"
    >>> unknown_word("t", "half", [])
    "parameter 't' knows no word 'half'; give a number"
    """
    words = [*known]
    return f"parameter '{name}' knows no word '{word}'" + (
        did_you_mean(word, words) if words else "; give a number"
    )

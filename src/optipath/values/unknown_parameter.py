"""What is said of a name that no parameter has, and of a word that one does not know."""

from __future__ import annotations

from typing import TYPE_CHECKING

from optipath.errors import did_you_mean, there_are
from optipath.spelling import closest, looks_left
from optipath.values.axis_names import AXES
from optipath.values.units import USUAL_UNITS, format_quantity, with_article

if TYPE_CHECKING:
    from collections.abc import Iterable

_OF_A_COMPOSER = ("method", "model", "engine", "dtype", "tolerance", "composing", "loops")
_CASE = "cas"
"""What the word case begins with, however it goes on."""


def unknown_parameter(name: str, known: Iterable[str]) -> str:
    """Return the sentence for a parameter that there is not.

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


def unknown_word(name: str, word: str, known: Iterable[str], dimension: str = "") -> str:
    """Return the sentence for a word that a parameter does not know, or that is no number.

    Examples
    --------
    >>> unknown_word("filter", "vertikal", ["horizontal", "vertical"])
    "parameter 'filter' knows no word 'vertikal'; did you mean 'vertical'?"
    >>> unknown_word("t", "half", [])
    "parameter 't' knows no word 'half'; give a number"
    """
    if word.lower() == "nan":
        wanted = _number(dimension)
        return f"parameter '{name}' cannot be '{word}', which is not finite; give {wanted}"
    return f"parameter '{name}' knows no word '{word}'{word_meant(word, known, dimension)}"


def word_meant(word: str, known: Iterable[str], dimension: str) -> str:
    """Return the cure for a word that is unknown where a number may stand, too.

    Examples
    --------
    >>> word_meant("antidiagonal", ["diagonal"], "angle")
    "; write '-45 deg' for the axis 'antidiagonal'"
    >>> word_meant("off", ["none"], "angle")
    "; there are: none, or give an angle such as '45 deg'"
    """
    if not looks_left():
        return ""
    words = [*known]
    unit = USUAL_UNITS[dimension]
    # By its letters alone, an axis is near the one at right angles to it.
    near = closest(word, [*words, *AXES] if dimension == "angle" else words)
    if near in words:
        return f"; did you mean '{near}'?"
    if near is not None:
        return f"; write '{format_quantity(AXES[near], unit)}' for the axis '{near}'"
    number = _number(dimension)
    return f"{there_are(words)}, or give {number}" if words else f"; give {number}"


def _number(dimension: str) -> str:
    """Return what a number of a dimension is, with an example."""
    unit = USUAL_UNITS[dimension]
    return f"{with_article(dimension)} such as '45 {unit}'" if dimension else "a number"

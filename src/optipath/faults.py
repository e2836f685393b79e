"""Faults: what is wrong, and the cure; values as sentences show them, the word that was meant."""

from __future__ import annotations

import re
from difflib import get_close_matches
from reprlib import Repr
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Sequence
    from typing import Self

_LONGEST = 600
_LONGEST_QUOTE, _MOST_LISTED = 60, 40

Medium: TypeAlias = Literal["python", "file", "command", "page"]
"""Where a fault is read, and its cure is followed."""


class Cure(NamedTuple):
    """A cure as Python writes it, a file, the command line and the page.

    What is not given is written as in a file on the page and the command line, and as in Python in
    a file.

    >>> Cure("give True", "give true").written("command")
    'give true'
    """

    python: str
    file: str | None = None
    command: str | None = None
    page: str | None = None

    @classmethod
    def of(cls, wording: Callable[[str], str], *ways: str) -> Cure:
        """Return a cure that differs in one part, which is given as each medium writes it."""
        return cls(*map(wording, ways))

    @classmethod
    def giving(cls, name: str, wording: Callable[[str], str] = str) -> Cure:
        """Return the cure that a value is to be given for a parameter.

        >>> cure = Cure.giving("n_1", lambda way: f"give one, {way}")
        >>> [cure.written(medium) for medium in ("python", "command", "page")]
        ['give one, n_1=...', 'give one, --n-1 ...', 'give one, in its field']
        """
        option = f"--{name.replace('_', '-')} ..."
        return cls.of(wording, f"{name}=...", f"{name} = ...", option, "in its field")

    def written(self, medium: Medium) -> str:
        """Return the cure as it is written in a medium."""
        result: str | None = getattr(self, medium)
        if result is None:
            result = self.written("file" if medium in ("page", "command") else "python")
        return result


class Fault(str):
    """What is wrong, and the cure; as a text, the sentence that Python shows.

    Attributes
    ----------
    reason : str
        The sentence without place and cure.
    cure : str or Cure
        What to do; nothing where no cure is sure.
    subject : str
        The name of the parameter or field that it is about, for forms; nothing where it is none.
    place : str
        Where it is, such as a table of a file.

    Examples
    --------
    >>> fault = Fault("parameter 'n' is 0", "give a number above 0", subject="n")
    >>> print(fault.under("cases.a"))
    cases.a: parameter 'n' is 0; give a number above 0
    >>> fault.under("cases.a").subject
    'n'
    """

    __slots__ = ("cure", "place", "reason", "subject")

    reason: str
    cure: str | Cure
    subject: str
    place: str

    def __new__(
        cls, reason: str, cure: str | Cure = "", subject: str = "", place: str = ""
    ) -> Self:
        written = cure.python if isinstance(cure, Cure) else cure
        result = super().__new__(cls, sentence(place, reason, written))
        result.reason, result.cure, result.subject, result.place = reason, cure, subject, place
        return result

    @classmethod
    def of(cls, fault: str) -> Fault:
        """Return a fault; a plain sentence is a reason."""
        return fault if isinstance(fault, Fault) else cls(fault)

    def __reduce__(self) -> tuple[Any, ...]:
        return Fault, (self.reason, self.cure, self.subject, self.place)

    def but(self, **changes: Any) -> Fault:
        """Return the fault with other parts."""
        return Fault(**{name: getattr(self, name) for name in self.__slots__} | changes)

    def under(self, place: str) -> Fault:
        """Return the fault within an outer place, of which one such as ".n" or "[0]" is a part."""
        if not place:
            return self
        colon = ": " if self.place and self.place[0] not in ".[" else ""
        return self.but(place=f"{place}{colon}{self.place}")

    def cured(self, cure: str) -> Fault:
        """Return the fault with one more cure; nothing is none."""
        if not cure:
            return self
        if isinstance(self.cure, Cure):
            ways = [self.cure.written(m) for m in ("python", "file", "command", "page")]
            return self.but(cure=Cure.of(lambda way: f"{way}; {cure}", *ways))
        return self.but(cure=f"{self.cure}; {cure}" if self.cure else cure)

    def within(self, medium: Medium) -> Fault:
        """Return the fault of what is written in a medium, whoever reads of it."""
        return self.but(cure=self.cure.written(medium)) if isinstance(self.cure, Cure) else self

    def written(self, medium: Medium) -> str:
        """Return the sentence for who reads it in a medium."""
        return str(self.within(medium))


def sentence(place: str, reason: str, cure: str) -> str:
    """Return a sentence on one line, cut where it is long."""
    where, instead = f"{place}: " if place else "", f"; {cure}" if cure else ""
    text = printable(f"{where}{reason}{instead}").replace("\n", "\\n")
    return text if len(text) <= _LONGEST else f"{text[:300]} ... {text[-150:]}"


def did_you_mean(word: object, known: Iterable[str]) -> str:
    """Return the cure for a misspelt word, ready to be put behind the fault."""
    names = [name for name in known if name]
    if (result := closest(word if isinstance(word, str) else shown(word), names)) is not None:
        return f"; did you mean '{result}'?"
    return there_are(names)


def there_are(names: Sequence[str]) -> str:
    """Return what there is, ready to be put behind a fault."""
    if (more := len(names) - _MOST_LISTED) > 0:
        return f"; there are: {', '.join(names[:_MOST_LISTED])} and {more} more"
    return f"; there are: {', '.join(names)}" if names else "; there are none"


def unknown(what: str, word: object, known: Collection[str]) -> list[str]:
    """Return the sentence for a word that is none of those there are; none for one that is."""
    if isinstance(word, str) and word in known:
        return []
    return [f"{what} {shown(word)} is unknown{did_you_mean(word, known)}"]


def no_value(name: str) -> Fault:
    """Return the fault of a parameter that nobody has given a value.

    >>> no_value("n")
    "parameter 'n' has no value; give one, n=..."
    """
    cure = Cure.giving(name, "give one, {}".format)
    return Fault(f"parameter '{name}' has no value", cure, subject=name)


def listed(words: Sequence[str]) -> str:
    """Return words as a sentence lists them."""
    *others, last = words
    return f"{', '.join(others)} and {last}" if others else last


def _short(text: str, most: int) -> str:
    return text if len(text) <= most else f"{text[: most // 2]}...{text[3 - most // 2 :]}"


# Control characters but for the end of a line, what turns the direction of
# writing, other ends of lines, and halves of characters, which no file in UTF-8 can hold.
_UNSEEN = re.compile(
    "[\x00-\x09\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff]"
)


def printable(text: str) -> str:
    r"""Return a text in which control characters are shown as Python writes them.

    >>> print(printable("a \x1b[31mred\x1b[0m word"))
    a \x1b[31mred\x1b[0m word
    """
    return _UNSEEN.sub(lambda result: result[0].encode("unicode_escape").decode(), text)


class _Short(Repr):
    """Representations that stop where they become long or deep."""

    def __init__(self) -> None:
        super().__init__()
        self.maxlevel = 4
        self.maxlist = self.maxtuple = self.maxset = self.maxdict = 12
        self.maxstring, self.maxlong, self.maxother = 60, 60, 60

    def repr_int(self, x: int, level: int) -> str:
        """Return its digits, or how many bits it has where Python refuses to write them."""
        try:
            return super().repr_int(x, level)
        except ValueError:
            return f"an integer of {x.bit_length()} bits"


_SHORT = _Short()


def shown(value: object) -> str:
    """Return the representation of any value, on one line, cut where it is long or deep.

    >>> shown("red"), shown([[[[[1]]]]])
    ("'red'", '[[[[...]]]]')
    >>> shown(1 << 20_000)
    'an integer of 20001 bits'
    """
    try:
        # Arrays are written in rows.
        text = printable(re.sub(r"\n\s*", " ", _SHORT.repr(value)))
        return _short(text, _LONGEST_QUOTE + 2)
    except Exception:  # noqa: BLE001 - somebody else's repr may raise anything
        return f"something of type {type(value).__name__}"


_MOST_WORDS, _LONGEST_WORD = 1000, 100
"""How many words are compared, and how long they may be: the time grows with both."""

_ALIKE = 0.65
"""How like each other two words are, from 0 to 1, of which one may be meant for the other."""

_BEGINNING = 3
"""How many letters a word begins with at least that is meant for a longer one."""

_SIGNS = "-$"


def closest(word: str, known: Iterable[str]) -> str | None:
    """Return the known word that a misspelt one was meant for; None where none is near.

    An unambiguous beginning is meant for its word. Short words (one or two letters) and numbers are
    no misspellings.

    >>> closest("--detla", ["--delta", "--rho"])
    '--delta'
    >>> closest("ellips", ["pyelli", "ellipsometry"])
    'ellipsometry'
    >>> closest("--plot", ["--delta"]), closest("10", ["1", "2"]), closest("n12", ["n1", "n2"])
    (None, None, None)
    """
    request = _bare(word)
    if len(word) > _LONGEST_WORD:
        return None
    words = [*known][:_MOST_WORDS]
    by_bare = {_bare(name): name for name in reversed(words) if len(name) <= _LONGEST_WORD}
    begun = (
        [name for name in by_bare if name.startswith(request)] if len(request) >= _BEGINNING else []
    )
    if len(begun) > 1 and request not in by_bare:
        return None
    for result in get_close_matches(request, begun or by_bare, cutoff=0.0 if begun else _ALIKE):
        if result == request or not _too_short(request, result):
            return by_bare[result]
    return None


def _bare(word: str) -> str:
    """Return a word in small letters, without the signs in front, which make all words alike."""
    return word.lower().lstrip(_SIGNS)


def _too_short(request: str, result: str) -> bool:
    letters = ["".join(c for c in word if not c.isdigit()) for word in (request, result)]
    return max(map(len, (request, result))) < 3 or (
        letters[0] == letters[1] and len(letters[0]) < 3
    )

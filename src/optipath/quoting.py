"""How texts and values are quoted in sentences: short, and safe to show on a terminal."""

from __future__ import annotations

import re
from reprlib import Repr

# Control characters but for the end of a line and the tabulator, what turns the direction of
# writing, other ends of lines, and halves of characters, which no file in UTF-8 can hold.
_UNSEEN = re.compile(
    "[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff]"
)


def printable(text: str) -> str:
    r"""Return a text in which control characters are shown as Python writes them.

    Examples
    --------
    >>> print(printable("a \x1b[31mred\x1b[0m word"))
    a \x1b[31mred\x1b[0m word
    """
    return _UNSEEN.sub(lambda found: found[0].encode("unicode_escape").decode(), text)


class _Short(Repr):
    """Representations that stop where they become long or deep."""

    def __init__(self) -> None:
        super().__init__()
        self.maxlevel = 4
        self.maxlist = self.maxtuple = self.maxset = self.maxdict = 12
        self.maxstring = 200
        self.maxlong = 60
        self.maxother = 300

    def repr_int(self, x: int, level: int) -> str:
        """Return its digits, or how many bits it has where Python refuses to write them."""
        try:
            return super().repr_int(x, level)
        except ValueError:
            return f"an integer of {x.bit_length()} bits"


def shown(value: object) -> str:
    """Return the representation of any value, on one line, cut where it is long or deep.

    Examples
    --------
    >>> shown("red"), shown([[[[[1]]]]])
    ("'red'", '[[[[...]]]]')
    >>> shown(1 << 20_000)
    'an integer of 20001 bits'
    """
    try:
        # Arrays are written in rows.
        return printable(re.sub(r"\n\s*", " ", _SHORT.repr(value)))
    except Exception:  # noqa: BLE001 - somebody else's repr may raise anything
        return f"something of type {type(value).__name__}"


_SHORT = _Short()

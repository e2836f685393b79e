"""Which keys a preset file may have, and of which type."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import did_you_mean, shown

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

FORMAT = 1

TOP = {"format": int, "description": str, "parameters": dict, "elements": dict, "links": list}
TOP |= {"cases": dict, "loops": str}
PARAMETER = {"default": object, "unit": str, "range": list, "help": str, "words": dict}
PARAMETER |= {"optional": bool, "bound": bool}
LINK = {"from": str, "to": str, "azimuth": object}
CASE = {"values": dict, "published": dict, "note": str}

_WORDS = {
    int: "a whole number",
    str: "a text",
    dict: "a table",
    list: "a list",
    bool: "true or false",
}


def key_faults(where: str, table: Mapping[str, Any], known: Iterable[str]) -> list[str]:
    """Return a sentence for each key that is not known.

    Parameters
    ----------
    where : str
        The table's place in the file.
    table : mapping of str to Any
        What stands there.
    known : iterable of str
        The keys that it may have.

    Returns
    -------
    list of str
        Nothing where all are known.

    Examples
    --------
    >>> key_faults("links[0]", {"form": "a.out"}, ["from", "to"])
    ["links[0]: key 'form' is unknown; did you mean 'from'?"]
    """
    return [
        f"{where}: key '{key}' is unknown{did_you_mean(key, known)}"
        for key in table
        if key not in known
    ]


def type_faults(where: str, table: Mapping[str, Any], schema: Mapping[str, Any]) -> list[str]:
    """Return a sentence for each key that is unknown or has a value of another type.

    Parameters
    ----------
    where, table
        As `key_faults` takes them.
    schema : mapping of str to type
        The keys that it may have, and the types of their values.

    Returns
    -------
    list of str
        Nothing where all is well.
    """
    wrong = [
        f"{where}: '{key}' must be {_WORDS[kind]}, not {shown(table[key])}"
        for key, kind in schema.items()
        if key in table and kind not in (object, type(table[key]))
    ]
    return key_faults(where, table, schema) + wrong

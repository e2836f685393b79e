"""The first line of a file of columns: what they are called, and their units."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from optipath.errors import did_you_mean, listed
from optipath.values.units import UNITS, unit_of, units_of

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

_AXES = {
    "wavelength": "length",
    "wl": "length",
    "lambda": "length",
    "\u03bb": "length",
    "energy": "photon energy",
    "photon energy": "photon energy",
    "wavenumber": "wave number",
    "wave number": "wave number",
    "frequency": "frequency",
}
"""What the first column may be called, and what it is."""
_CALLED = {dimension: name for name, dimension in reversed(_AXES.items())}

_SPELT = {"\u00b5m": "um", "\u03bcm": "um", "microns": "um", "micron": "um", "ev": "eV"}
_SPELT |= dict.fromkeys(("\u00c5", "\u212b", "A", "angstroms", "Angstrom"), "angstrom")
_SPECTRAL = ("eV", "meV", "keV", "1/cm", "cm^-1", "cm-1", "1/um", "1/mm", "1/m")
_FREQUENCIES = ("THz", "GHz", "PHz", "Hz")
_HEAD = re.compile(r"(.*?)\s*(?:\(([^()]*)\)|\[([^][]*)\])?")


def split_heading(head: str) -> tuple[str, str]:
    """Return what a column is called, and its unit; ``""`` for none.

    Examples
    --------
    >>> split_heading("delta (deg)"), split_heading("wavelength_nm"), split_heading("n1")
    (('delta', 'deg'), ('wavelength', 'nm'), ('n1', ''))
    """
    match = _HEAD.fullmatch(head.strip())
    name, unit = (match[1], match[2] or match[3] or "") if match else (head, "")
    before, line, behind = name.rpartition("_")
    if not unit and line and (behind in UNITS or behind in _SPECTRAL or behind in _SPELT):
        name, unit = before, behind
    return name.strip(), _SPELT.get(unit.strip(), unit.strip())


def _name_and_unit(head: str) -> tuple[str, str]:
    """Return what a column is called, in small letters, and its unit."""
    name, unit = split_heading(head)
    return name.lower(), unit


def axis_of(
    number: int,
    header: list[str],
    unit: str,
    faults: list[str],
    *,
    names: Sequence[str] = (),
    rows: Sequence[Sequence[str]] = (),
) -> tuple[int, str]:
    """Return which column has the wavelengths, and in which unit."""
    heads = [_name_and_unit(head) for head in header]
    found = [place for place, (name, _) in enumerate(heads) if name in _AXES]
    if not found:
        if has_numbers(header):
            what = f"line {number} has numbers, and no names of columns"
        else:
            what = f"line {number} names no column of wavelengths, but {listed(header)}"
        faults.append(
            f"{what}; begin with a line such as '{', '.join(['wavelength (nm)', *names])}'"
        )
        return 0, ""
    if len(found) > 1:
        both = listed([f"'{header[place]}'" for place in found])
        faults.append(f"line {number} has {both}; keep one of them")
        return 0, ""
    name, own = heads[found[0]]
    dimension = _AXES[name]
    units = {
        "length": units_of("length"),
        "photon energy": [*_SPECTRAL[:3]],
        "wave number": [*_SPECTRAL[3:]],
        "frequency": [*_FREQUENCIES],
    }
    known = units[dimension]
    if own and unit and own != _SPELT.get(unit, unit):
        faults.append(f"line {number} has the unit {own}, and unit='{unit}' is given; leave it out")
    own = own or _SPELT.get(unit, unit)
    cells = [row[found[0]] for row in rows if len(row) > found[0]]
    if not own and cells and unit_of(cells[0]):
        return found[0], ""
    other = next((_CALLED[one] for one, those in units.items() if own in those), name)
    if not own:
        likely = "um" if dimension == "length" and _in_micrometres(cells) else known[0]
        faults.append(
            f"line {number}: '{name}' has no unit; write '{name} ({likely})', or give "
            f"unit='{likely}'"
        )
    elif own not in known and other != name:
        faults.append(
            f"line {number}: '{own}' is no unit of '{name}', but of '{other}'; write "
            f"'{other} ({own})'"
        )
    elif own not in known:
        faults.append(
            f"line {number}: the unit '{own}' of '{name}' is unknown{did_you_mean(own, known)}"
        )
    return found[0], own


def _in_micrometres(cells: Sequence[str]) -> bool:
    """Tell whether all numbers are such as wavelengths of light have in micrometres."""
    try:
        return bool(cells) and all(0.1 <= float(cell) <= 30.0 for cell in cells)
    except ValueError:
        return False


def is_header(cells: Sequence[str]) -> bool:
    """Tell whether a line names a column of wavelengths.

    Examples
    --------
    >>> is_header(["wl", "k"]), is_header(["0.5", "1.2"])
    (True, False)
    """
    return any(_name_and_unit(cell)[0] in _AXES for cell in cells)


def names_in(header: Sequence[str], names: Sequence[str]) -> list[str]:
    """Return those of some names that a first line has.

    Examples
    --------
    >>> names_in(["wl (um)", "N"], ["n", "k"])
    ['n']
    """
    heads = [_name_and_unit(head)[0] for head in header]
    return [name for name in names if name.lower() in heads]


def places_of(
    number: int,
    header: list[str],
    names: Sequence[str],
    cures: Mapping[str, str],
    faults: list[str],
) -> dict[str, int]:
    """Return which columns have the numbers that are asked for."""
    heads = [_name_and_unit(head)[0] for head in header]
    found = {}
    for name in names:
        places = [place for place, head in enumerate(heads) if head == name.lower()]
        if len(places) == 1:
            found[name] = places[0]
        elif places:
            faults.append(f"line {number} has {len(places)} columns '{name}'; keep one")
        else:
            others = [head for head in heads if head not in _AXES]
            cure = f"; or {cures[name]}" if name in cures else ""
            meant = did_you_mean(name, others) if others else ""
            faults.append(f"line {number} names no column '{name}'{meant}{cure}")
    return found


def has_numbers(header: list[str]) -> bool:
    """Tell whether a first line has numbers alone, and no names.

    Examples
    --------
    >>> has_numbers(["500", "1.5"]), has_numbers(["wavelength (nm)", "n"])
    (True, False)
    """
    try:
        return bool([float(cell) for cell in header])
    except ValueError:
        return False

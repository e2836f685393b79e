"""The first line of a file of columns: what they are called, and their units."""

from __future__ import annotations

import re
from decimal import Decimal, InvalidOperation
from typing import TYPE_CHECKING

from optipath.errors import did_you_mean, listed
from optipath.values.units import UNITS, units_of

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

_AXES = {
    "wavelength": "length",
    "wl": "length",
    "lambda": "length",
    "\u03bb": "length",
    "energy": "photon energy",
    "e": "photon energy",
    "photon energy": "photon energy",
    "wavenumber": "wave number",
    "wave number": "wave number",
    "frequency": "frequency",
}
"""What the first column may be called, and what it is."""

_ANGSTROM = "Angstrom"
_ANGSTROMS = ("A", "\u00c5", "\u212b", _ANGSTROM, "angstrom", "Angstroms", "angstroms")
_SPELT = {
    "\u00b5m": "um",
    "\u03bcm": "um",
    "microns": "um",
    "micron": "um",
    "ev": "eV",
    **dict.fromkeys(_ANGSTROMS, _ANGSTROM),
}
_SPECTRAL = ("eV", "meV", "keV", "1/cm", "cm^-1", "cm-1", "1/um", "1/mm", "1/m")
_BEHIND_A_LINE = {*UNITS, *_SPECTRAL, *_SPELT} - {"A"}
"""Units that may end a name; a single A is more likely that of a sample."""
_FREQUENCIES = ("THz", "GHz", "PHz", "Hz")
_HEAD = re.compile(r"(.*?)\s*(?:\(([^()]*)\)|\[([^][]*)\])?")


def _name_and_unit(head: str) -> tuple[str, str]:
    """Return what a column is called, in small letters, and its unit."""
    match = _HEAD.fullmatch(head.strip())
    name, unit = (match[1], match[2] or match[3] or "") if match else (head, "")
    before, line, behind = name.rpartition("_")
    if not unit and line and behind in _BEHIND_A_LINE:
        name, unit = before, behind
    return name.strip().lower(), _SPELT.get(unit.strip(), unit.strip())


def quantity_text(cell: str, unit: str) -> str:
    """Return a number of a file with a unit that texts have.

    Parameters
    ----------
    cell : str
        What stands in the file.
    unit : str
        As `axis_of` returns it.

    Returns
    -------
    str

    Examples
    --------
    >>> quantity_text("5890", "Angstrom"), quantity_text("2.1", "eV")
    ('589.0 nm', '2.1 eV')
    """
    if unit != _ANGSTROM:
        return f"{cell} {unit}"
    try:
        return f"{Decimal(cell).scaleb(-1)} nm"
    except InvalidOperation:
        return f"{cell} nm"


def _is_axis(name: str, own: str, unit: str) -> bool:
    """Tell whether a column has wavelengths; "e" is an energy only where its unit says so."""
    energies = _SPECTRAL[:3]
    return name in _AXES and (name != "e" or (own or _SPELT.get(unit, unit)) in energies)


def axis_of(number: int, header: list[str], unit: str, faults: list[str]) -> tuple[int, str]:
    """Return which column has the wavelengths, and in which unit.

    Parameters
    ----------
    number : int
        That of the line.
    header : list of str
        What stands in it.
    unit : str
        The unit where the line has none.
    faults : list of str
        To which is added what is wrong.

    Returns
    -------
    place : int
    unit : str
    """
    heads = [_name_and_unit(head) for head in header]
    found = [place for place, head in enumerate(heads) if _is_axis(*head, unit)]
    if not found:
        if has_numbers(header):
            what = f"line {number} has numbers, and no names of columns"
        else:
            what = f"line {number} names no column of wavelengths, but {listed(header)}"
        faults.append(f"{what}; begin with a line such as 'wavelength (nm), n, k'")
        return 0, ""
    if len(found) > 1:
        both = listed([f"'{header[place]}'" for place in found])
        faults.append(f"line {number} has {both}; keep one of them")
        return 0, ""
    name, own = heads[found[0]]
    dimension = _AXES[name]
    known = {
        "length": [*units_of("length"), _ANGSTROM],
        "photon energy": [*_SPECTRAL[:3]],
        "wave number": [*_SPECTRAL[3:]],
        "frequency": [*_FREQUENCIES],
    }[dimension]
    if own and unit and own != _SPELT.get(unit, unit):
        faults.append(f"line {number} has the unit {own}, and unit='{unit}' is given; leave it out")
    own = own or _SPELT.get(unit, unit)
    if not own:
        # Files of refractiveindex.info say "wl", and mean micrometres.
        such = "um" if name == "wl" else known[0]
        faults.append(
            f"line {number}: '{name}' has no unit; write '{name} ({such})', or give unit='{such}'"
        )
    elif own not in known:
        faults.append(
            f"line {number}: the unit '{own}' of '{name}' is unknown{did_you_mean(own, known)}"
        )
    return found[0], own


def places_of(
    number: int,
    header: list[str],
    names: Sequence[str],
    cures: Mapping[str, str],
    faults: list[str],
) -> dict[str, int]:
    """Return which columns have the numbers that are asked for.

    Parameters
    ----------
    number : int
        That of the line.
    header : list of str
        What stands in it.
    names : sequence of str
        What the columns are called.
    cures : mapping of str to str
        What else to do where one is missing.
    faults : list of str
        To which is added what is wrong.

    Returns
    -------
    dict of str to int
    """
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

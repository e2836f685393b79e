"""How units are called elsewhere, so that who writes them so is told how they are called here."""

from __future__ import annotations

from typing import TYPE_CHECKING

from optipath.errors import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Collection

_LENGTHS = {"nano": "nm", "micro": "um", "milli": "mm", "centi": "cm", "deci": "dm", "": "m"}
_ANGLES = {"radian": "rad", "milliradian": "mrad", "arcminute": "arcmin", "arcsecond": "arcsec"}

_SINGULAR = {
    **{f"{prefix}{metre}": u for prefix, u in _LENGTHS.items() for metre in ("meter", "metre")},
    **_ANGLES,
    "degree": "deg",
    "micron": "um",
    "ångström": "angstrom",
    "angstroem": "angstrom",
    "angstrom": "angstrom",
    "tesla": "T",
    "millitesla": "mT",
    "gauss": "G",
    "kilogauss": "kG",
    "arc minute": "arcmin",
    "arc second": "arcsec",
}
_SIGNS = {"°": "deg", "º": "deg", "'": "arcmin", '"': "arcsec", "µm": "um", "μm": "um", "µ": "um"}
_SIGNS |= dict.fromkeys(("å", "\u212b"), "angstrom")
_NAMES = {**_SINGULAR, **{f"{name}s": unit for name, unit in _SINGULAR.items()}, **_SIGNS}
_NAMES |= {"degs": "deg", "rads": "rad", "mic": "um", "mu": "um"}

_GONS = dict.fromkeys(("gon", "gons", "gradian", "gradians"), "a gon is 0.9 deg")
_GONS |= dict.fromkeys(
    ("grad", "grads"), "a grad is 0.9 deg where it is a gon, and 1 deg in German"
)


def usual_name(word: str) -> str:
    """Return a unit as it is called here; the word itself where it has no other name.

    Examples
    --------
    >>> usual_name("degrees/Millimeter"), usual_name("cm^-1"), usual_name("°"), usual_name("nm")
    ('deg/mm', '1/cm', 'deg', 'nm')
    """
    for power in ("^-1", "**-1", "-1", "⁻¹"):
        if word.endswith(power):
            word = f"1/{word.removesuffix(power)}"
    if word.startswith("per "):
        word = f"1/{word.removeprefix('per ')}"
    parts = word.replace(" per ", "/").split("/")
    return "/".join(_NAMES.get(part.strip().lower(), part.strip()) for part in parts)


def unit_meant(word: str, units: Collection[str]) -> str:
    """Return the cure for an unknown unit, ready to be put behind the fault.

    Examples
    --------
    >>> unit_meant("degrees", ["deg", "rad"]), unit_meant("pints", ["deg", "rad"])
    ("; did you mean 'deg'?", '; there are: deg, rad')
    >>> unit_meant("grad", ["deg", "rad"])
    '; a grad is 0.9 deg where it is a gon, and 1 deg in German; write it in deg'
    """
    name = usual_name(word)
    if name in units:
        return f"; did you mean '{name}'?"
    if name.lower() in _GONS and "deg" in units:
        return f"; {_GONS[name.lower()]}; write it in deg"
    return did_you_mean(word, units)

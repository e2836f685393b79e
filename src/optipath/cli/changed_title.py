"""What a picture or a chart is of, in a line: the preset, the case and what was changed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from optipath.values.displayed import displayed
from optipath.values.named_materials import WAVELENGTH, materials_among

if TYPE_CHECKING:
    from optipath.cli.chosen import Chosen


def title_of(chosen: Chosen, **others: str | None) -> str:
    """Return the preset and the case, and each value that is given besides, with its name.

    Examples
    --------
    >>> import optipath as op
    >>> from optipath.cli.chosen import Chosen
    >>> path = op.load_preset("npgr026")
    >>> title_of(Chosen("npgr026", path, "8", {"delta": 0.5235987755982988}), reads="intensity")
    'npgr026, case 8, delta 30 deg, reads intensity'
    """
    labels = {name: label for name, label, _ in materials_among(chosen.values)}
    told = [chosen.title]
    for name, value in chosen.values.items():
        parameter = chosen.opened.parameters.get(name, WAVELENGTH)
        if isinstance(value, float):
            text = displayed(value, parameter.unit)
        elif name in labels or isinstance(value, str):
            text = labels.get(name, value)
        else:
            text = parameter.text(value)
        told.append(f"{name} {text}")
    return ", ".join([*told, *(f"{name} {text}" for name, text in others.items() if text)])

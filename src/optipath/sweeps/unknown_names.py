"""Names that no parameter has: what a sweep and what uncertainty say of them."""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING, Any

from optipath.composer.composer import Composer
from optipath.errors import listed, shown
from optipath.spelling import closest

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.values.inputs import Inputs

_OPTIONS = frozenset(each.name for each in fields(Composer)) - {"keep"}
"""Of a composer, which is given besides and not composed by hand."""


def unknown_names(inputs: Inputs, given: Mapping[str, Any]) -> list[str]:
    """Return what is wrong with names that no parameter has.

    Examples
    --------
    >>> import optipath as op
    >>> inputs = op.load_preset("malus").compose().inputs
    >>> unknown_names(inputs, {"engine": "numba", "dtype": "float32"})
    ["'engine' and 'dtype' are no parameters of the path; give \
    composer=op.Composer(engine='numba', dtype='float32')"]
    """
    unknown = [name for name in given if name not in inputs.open]
    chosen = {*inputs.open, *inputs.bound, *inputs.choices}
    options = [name for name in unknown if name in _OPTIONS and closest(name, chosen) is None]
    faults = [inputs.unknown(name) for name in unknown if name not in options]
    if options:
        names = listed([f"'{name}'" for name in options])
        are = "is no parameter" if len(options) == 1 else "are no parameters"
        written = ", ".join(f"{name}={shown(given[name])}" for name in options)
        faults.append(f"{names} {are} of the path; give composer=op.Composer({written})")
    return faults

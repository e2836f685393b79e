"""FormulaCurve: n and k by a formula whose coefficients are numbers or parameters."""

from __future__ import annotations

from abc import abstractmethod
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ValueFault, shown
from optipath.values.arrays.jax_values import is_traced
from optipath.values.cures import cure
from optipath.values.curves.coefficients import REAL
from optipath.values.curves.curve import Curve
from optipath.values.domains.wavelengths import LONGEST_FIRST, WAVELENGTH, too_long
from optipath.values.operands import Operand
from optipath.values.parameters import Parameter
from optipath.values.use import Use

if TYPE_CHECKING:
    from collections.abc import Hashable

    from optipath.values.curves.coefficients import Coefficient
    from optipath.values.domains.domain import Domain

EVERYWHERE = (0.0, np.inf)


class FormulaCurve(Curve):
    """n and k by a published formula.

    Units: span in metres.
    """

    parts: tuple[str, ...] = ("n", "k")

    def __init__(self, label: str, span: Any, **given: Any) -> None:
        vars(self).update(label=label, beyond="take another formula", **given)
        faults: list[str] = []
        for name, value, domain in self.arguments():
            try:
                _check(f"{name} of {label}", value, domain)
            except ValueFault as fault:
                faults += fault.faults
        try:
            vars(self).update(span=read_span(f"span of {label}", span))
        except ValueFault as fault:
            faults += fault.faults
        if faults:
            raise ValueFault(*faults)
        vars(self).update({name: _plain(value) for name, value in given.items()})

    @abstractmethod
    def arguments(self) -> list[Coefficient]:
        """Return its coefficients, in the order of `numbers`: names, values, what they may be."""

    @property
    def content(self) -> tuple[Hashable, ...]:
        # Equal ones say the same of their parameters, which share a name.
        keys = [(name, Operand(value).key()) for name, value, _ in self.arguments()]
        return (self.label, self.span, *keys)


def _check(owner: str, value: Any, domain: Domain) -> None:
    if isinstance(value, Parameter):
        Use(owner, value, domain).check()
        return
    if domain.check(owner, value).ndim:
        raise ValueFault(f"{owner} is {shown(value)}; give one number, or a Parameter for several")


def _plain(given: Any) -> Any:
    """Return coefficients as floats, so that 2 and 2.0 make equal curves."""
    if isinstance(given, tuple):
        return tuple(map(_plain, given))
    is_open = given is None or isinstance(given, Parameter) or is_traced(given)
    return given if is_open else REAL.check("", given).item() + 0.0


def read_span(owner: str, span: Any) -> tuple[float, float]:
    """Return the least and the largest wavelength that a formula holds for, in metres.

    Examples
    --------
    >>> read_span("span of a glass", ("400 nm", "1 um"))
    (4e-07, 1e-06)
    """
    if span == EVERYWHERE:
        return EVERYWHERE
    ends = WAVELENGTH.check(owner, list(span) if isinstance(span, tuple) else span)
    if ends.shape != (2,) or not ends[0] < ends[1]:
        such = cure("('400 nm', '700 nm')", '["400 nm", "700 nm"]')
        raise ValueFault(
            f"{owner} is {shown(span)}; give the least and the largest wavelength, such as {such}"
        )
    if ends[0] > LONGEST_FIRST:
        raise ValueFault(f"the least wavelength of the {owner} is {too_long(float(ends[0]))}")
    return float(ends[0]), float(ends[1])

"""Drude-Lorentz and Tauc-Lorentz oscillators: n and k of what absorbs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.errors import ValueFault
from optipath.kernels.dispersion import (
    drude_lorentz_permittivity,
    index_of_permittivity,
    tauc_lorentz_permittivity,
)
from optipath.materials.formulas import (
    EVERYWHERE,
    NOT_NEGATIVE,
    POSITIVE,
    REAL,
    FormulaCurve,
    coefficients_of,
    oscillators_of,
)
from optipath.values.agreement import Agreement, first_faults, text_of
from optipath.values.operands import Operand
from optipath.values.wavelength import HC

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping, Sequence

    from optipath.materials.formulas import Coefficient
    from optipath.values.parameters import Resolved


_BOUND = ("strength", "energy", "damping")
_ABOVE_GAP = ("amplitude", "energy", "broadening", "gap")


class DrudeLorentz(FormulaCurve):
    """Electrons that are free, and bound ones; energies in electronvolts.

    >>> from optipath.values.curve_value import curve_values
    >>> n, k = curve_values(DrudeLorentz("a metal", 9.0, 0.02), 1e-6)
    >>> round(float(n), 4), round(float(k), 4)
    (0.0591, 7.1891)
    """

    plasma: Any
    damping: Any
    strength: Any
    oscillators: tuple[tuple[Any, ...], ...]
    background: Any
    unreal = "its coefficients give no permittivity that is a number"

    def __init__(
        self,
        label: str,
        plasma: Any,
        damping: Any,
        *,
        strength: Any = 1.0,
        oscillators: Any = (),
        background: Any = 1.0,
        span: Any = EVERYWHERE,
    ) -> None:
        arguments = {"plasma": plasma, "damping": damping, "strength": strength}
        rows = oscillators_of(label, oscillators, _BOUND)
        super().__init__(label, span, **arguments, oscillators=rows, background=background)

    def arguments(self) -> list[Coefficient]:
        domains = (NOT_NEGATIVE, NOT_NEGATIVE, POSITIVE)
        return [
            ("background", self.background, REAL),
            ("plasma", self.plasma, NOT_NEGATIVE),
            ("strength", self.strength, NOT_NEGATIVE),
            ("damping", self.damping, NOT_NEGATIVE),
            *coefficients_of(self.oscillators, _BOUND, domains),
        ]

    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        background, plasma, strength, damping, *rest = arguments
        bound = [rest[at : at + 3] for at in range(0, len(rest), 3)]
        result = drude_lorentz_permittivity(
            HC / wavelength, background, plasma, (strength, damping), bound
        )
        return index_of_permittivity(xp, *result)


class TaucLorentz(FormulaCurve):
    """Oscillators above a gap, of amorphous films; energies in electronvolts.

    >>> from optipath.values.curve_value import curve_values
    >>> silicon = TaucLorentz("silicon", [(122.0, 3.45, 2.54, 1.2)], background=1.15)
    >>> n, k = curve_values(silicon, 500e-9)
    >>> round(float(n), 4), round(float(k), 4)
    (4.4573, 1.0883)
    """

    oscillators: tuple[tuple[Any, ...], ...]
    background: Any
    unreal = "its coefficients give no permittivity that is a number"

    def __init__(
        self, label: str, oscillators: Any, *, background: Any = 1.0, span: Any = EVERYWHERE
    ) -> None:
        rows = oscillators_of(label, oscillators, _ABOVE_GAP)
        if not rows:
            raise ValueFault(
                f"{label} has no oscillators; give one or more, or n as a number for what is the "
                f"same at all wavelengths"
            )
        super().__init__(label, span, oscillators=rows, background=background)
        limits = self._limits([value for _, value, _ in self.arguments()])
        if faults := first_faults([law for law in limits if not law.is_open]):
            raise ValueFault(*faults)

    def arguments(self) -> list[Coefficient]:
        domains = (NOT_NEGATIVE, POSITIVE, POSITIVE, NOT_NEGATIVE)
        return [
            ("background", self.background, REAL),
            *coefficients_of(self.oscillators, _ABOVE_GAP, domains),
        ]

    def misfits(self, arguments: Sequence[Any], given: Mapping[str, Resolved]) -> list[str]:
        return first_faults(self._limits(arguments), given)

    def _limits(self, arguments: Sequence[Any]) -> list[BroadeningLimit]:
        _, *rest = arguments
        pairs = [rest[at + 1 : at + 3] for at in range(0, len(rest), 4)]
        return [
            BroadeningLimit(
                (Operand(energy), Operand(broadening)), f"oscillators[{place}] of {self.label}"
            )
            for place, (energy, broadening) in enumerate(pairs)
        ]

    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        real, *rest = arguments
        energy = HC / wavelength
        imaginary = 0.0 * energy
        for at in range(0, len(rest), 4):
            more, absorbed = tauc_lorentz_permittivity(xp, energy, *rest[at : at + 4])
            real, imaginary = real + more, imaginary + absorbed
        return index_of_permittivity(xp, real, imaginary)


@dataclass(frozen=True, eq=False)
class BroadeningLimit(Agreement):
    """C < 2 E0 of energy and broadening, so that alpha of Jellison and Modine (1996) is real."""

    owner: str

    def fits(self, xp: Any, *numbers: Any) -> Any:
        del xp
        energy, broadening = numbers
        return ~(broadening >= 2.0 * energy)

    def sentence(self, *numbers: float, varying: Collection[int] = ()) -> str:
        del varying
        energy, broadening = [text_of(*each) for each in zip(self.operands, numbers, strict=True)]
        return (
            f"{self.owner} has the broadening {broadening} and the energy {energy}; the formula "
            f"holds for a broadening below twice the energy, which is {2.0 * numbers[0]:.12g}"
        )

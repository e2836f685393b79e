"""Media on both sides of a boundary, and waves incident from absorbing media."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from optipath.elements.coupling import numbers_of
from optipath.kernels.fresnel.boundary import inhomogeneous_boundary, phase_index, refraction
from optipath.kernels.primitives import NUMPY, of_module
from optipath.materials.index_domains import FOLLOWS, INDEX
from optipath.materials.material import Material
from optipath.values.agreement import Agreement, text_of
from optipath.values.arrays import changed
from optipath.values.operands import operand_of


class MediaOfBoundary:
    """What a boundary has and other elements have not: media, ``outside`` in front."""

    may_follow: ClassVar[tuple[str, ...]] = ("outside",)
    lit_from_absorbing: ClassVar[bool] = False
    media_fields: ClassVar[tuple[str, str]] = ("outside", "index")

    def medium_at(self, port: str) -> Any:
        """Return the index of refraction at a port, in front or behind."""
        face: Any = self
        return face.outside if port in ("in", "reflected") else face.index

    def followed(self) -> tuple[str, ...]:
        """Return the fields that are taken over from the boundary before."""
        return tuple([name for name in self.may_follow if getattr(self, name) is FOLLOWS])

    def taking_over(self, **values: Any) -> Any:
        """Return a boundary like it with values of the one before in place of `FOLLOWS`."""
        face: Any = self
        return changed(face, _is_sound=False, **values)


_ROUNDING = 1e-9
"""By how much a wave may fade faster than it goes on, as a share of either."""


@dataclass(frozen=True, eq=False)
class ArrivingWave(Agreement):
    """A wave in an absorbing medium goes on along the normal at least as fast as it fades.

    Im g <= Re g of the wave g along the normal; beyond (grazing, behind total reflection, in
    metals) transmittance over the arriving wave alone grows without limit. The operands are n and k
    of the medium, those of the one in which the incidence is measured, and the incidence.
    """

    enters: str

    @property
    def waits_for_complex(self) -> bool:
        """Whether k is that of a parameter which is a real number by default."""
        k = self.operands[1]
        default = getattr(k.value, "default", 0.0)
        is_real = not isinstance(default, Material) and not np.iscomplexobj(default)
        return k.part == "imag" and not k.known and is_real

    def fits(self, xp: Any, *numbers: Any) -> Any:
        goes_on, fades = self._wave(xp, *numbers)
        return ~((numbers[1] > 0.0) & (fades > (1.0 + _ROUNDING) * goes_on))

    def sentence(self, *numbers: float) -> str:
        n, k, n0, k0, _ = numbers
        goes_on, fades = self._wave(np, *numbers)
        of_n, of_k = self.operands[:2]
        cure = f"an index there with k of at most n = {n:.12g}"
        if k <= n:
            most = math.floor(math.degrees(self._largest(n, k, n0, k0)) * 1e6) / 1e6
            there = "" if (n, k) == (n0, k0) else f" in n = {n0:.12g}, k = {k0:.12g}"
            cure = f"an incidence of at most {most:.12g} deg{there}"
        return (
            f"'{self.enters}' is lit from n = {text_of(of_n, n)} and k = {text_of(of_k, k)} at an "
            f"incidence at which light fades along the normal faster than it goes on there "
            f"(Im g = {fades:.4g}, Re g = {goes_on:.4g}), so that the light that arrives carries "
            f"no power of its own; give {cure}"
        )

    def _wave(self, xp: Any, n: Any, k: Any, n0: Any, k0: Any, angle: Any) -> tuple[Any, Any]:
        """Return the real and the imaginary part of the wave along the normal."""
        with np.errstate(all="ignore"):
            (q,) = phase_index(of_module(xp))(n0, k0, xp.cos(angle), xp.sin(angle))
        return along_normal(xp, n, k, q, angle)

    def _largest(self, n: float, k: float, n0: float, k0: float) -> float:
        """Return the largest incidence: of y^2 = n^2 - k^2, where Re g^2 is 0."""
        y = math.sqrt((n - k) * (n + k))
        with np.errstate(all="ignore"):
            c, s = refraction(NUMPY)(*map(np.float64, (y, n0, k0, 0.0, 1.0)))
        return float(np.arctan2(s, c))


def along_normal(xp: Any, n: Any, k: Any, n0: Any, angle: Any) -> tuple[Any, Any]:
    """Return the real and the imaginary part of the wave along the normal, of an angle in n0."""
    arguments = n, k, n, k, n0, xp.cos(angle), xp.sin(angle)
    with np.errstate(all="ignore"):
        at = inhomogeneous_boundary(of_module(xp))(*arguments)
        return at.p / at.n1 * n, at.fades / at.n1 * n


def arriving_waves(owner: str, element: Any, port: str) -> list[ArrivingWave]:
    """Return what must hold of light that enters a port, where its medium may absorb."""
    if not getattr(element, "lit_from_absorbing", False) or port not in element.inputs:
        return []
    incidence, measured = element.measured
    medium = element.medium_at(port)
    if [value for value in (incidence, measured, medium) if value is FOLLOWS]:
        return []  # What it takes over is looked at.
    n, k = numbers_of(medium, INDEX)
    if type(k) is float and k == 0.0:
        return []
    operands = (n, k, *numbers_of(measured, INDEX), incidence)
    return [ArrivingWave(tuple(map(operand_of, operands)), f"{owner}.{port}")]

"""What facets scatter of polarised light that each of them reflects once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.kernels.carriers.structures import BLOCK, turn_linear
from optipath.kernels.facets.half_vector import facet_between
from optipath.kernels.facets.slope_density import beckmann
from optipath.kernels.facets.smith_masking import masked_cosines
from optipath.kernels.geometry.vertex_chain import points_of

if TYPE_CHECKING:
    from optipath.kernels.carriers.kernel import Kernel
    from optipath.kernels.numbers.primitives import KernelFunction, Primitives


@dataclass(frozen=True)
class FacetScattering:
    """Makes ``(alpha_x, alpha_y, k_in, x_in, k_out, x_out, n1, n, [k]) -> sixteen numbers``.

    Those of the polarised reflectance distribution, row by row: the Mueller matrix of the facet
    between two directions, times density / (4 tilt^4) G / (cos_in cos_out). Of each vector there
    are three numbers.
    """

    reflection: Kernel
    masking: str

    def __call__(self, xp: Primitives) -> KernelFunction:
        """Return the function of the sixteen numbers."""
        facet, density = facet_between(xp), beckmann(xp)
        reflect, cosines = self.reflection.made_for(xp), masked_cosines(xp, self.masking)

        def scattered(alpha_x: Any, alpha_y: Any, *numbers: Any) -> tuple[Any, ...]:
            k_in, x_in, k_out, x_out = points_of(numbers[:12])
            met = facet(k_in, x_in, k_out, x_out)
            rows = BLOCK.rows(xp, reflect(*numbers[12:], met.cos, met.sin))
            # One after the other, so that tiny numbers are not lost together.
            share = 0.25 * density(*met.slopes, alpha_x, alpha_y) / met.tilt**2 / met.tilt**2
            share = share / cosines(k_in, k_out, alpha_x, alpha_y)
            turned = _turned(rows, met.turn_in, met.turn_out)
            return tuple(share * entry for row in turned for entry in row)

        return scattered


def _turned(rows: Any, turn_in: tuple[Any, Any], turn_out: tuple[Any, Any]) -> Any:
    """Return the rows of a Mueller matrix between a turn before and a turn behind."""
    c, s = turn_in
    first, *middle, last = [(a, *turn_linear((c, -s), b1, b2), d) for a, b1, b2, d in rows]
    columns = [turn_linear(turn_out, *pair) for pair in zip(*middle, strict=True)]
    return first, *zip(*columns, strict=True), last

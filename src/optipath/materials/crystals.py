"""Crystal: a uniaxial crystal by its two indices, and the data of some."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.errors import ValueFault
from optipath.faults import did_you_mean, shown
from optipath.kernels.dispersion import index_of_square, sellmeier_square
from optipath.materials.by_wavelength import drude_rotation
from optipath.materials.formulas import MICROMETRES, Sellmeier
from optipath.materials.material import Material
from optipath.values.arrays import ComparedByFields
from optipath.values.curve import Curve
from optipath.values.curve_value import CurveValue, curve_values

if TYPE_CHECKING:
    from collections.abc import Hashable

    from optipath.values.domains import Domain


_KNOWN: dict[str, tuple[str, tuple[str, str], dict[str, Any], dict[str, Any]]] = {
    "quartz": (
        "Ghosh 1999",
        ("198 nm", "2053.1 nm"),
        {"offset": 1.28604141, "b": (1.07044083, 1.10202242), "c": (1.00585997e-2, 100.0)},
        {"offset": 1.28851804, "b": (1.09509924, 1.15662475), "c": (1.02101864e-2, 100.0)},
    ),
    "calcite": (
        "Ghosh 1999",
        ("204 nm", "2172 nm"),
        {"offset": 1.73358749, "b": (0.96464345, 1.82831454), "c": (1.94325203e-2, 120.0)},
        {"offset": 1.35859695, "b": (0.82427830, 0.14429128), "c": (1.06689543e-2, 120.0)},
    ),
    "magnesium fluoride": (
        "Dodge 1984",
        ("200 nm", "7 um"),
        {
            "b": (0.48755108, 0.39875031, 2.3120353),
            "resonances": (0.04338408, 0.09461442, 23.793604),
        },
        {
            "b": (0.41344023, 0.50497499, 2.4904862),
            "resonances": (0.03684262, 0.09076162, 23.771995),
        },
    ),
    "sapphire": (
        "Malitson and Dodge 1972",
        ("200 nm", "5 um"),
        {"b": (1.4313493, 0.65054713, 5.3414021), "resonances": (0.0726631, 0.1193242, 18.028251)},
        {"b": (1.5039759, 0.55069141, 6.5927379), "resonances": (0.0740288, 0.1216529, 20.072248)},
    ),
}
"""Source, range, and the coefficients of Sellmeier's formula of the ordinary and the extraordinary
ray, in micrometres.

G. Ghosh, Opt. Commun. 163, 95 (1999); M. J. Dodge, Appl. Opt. 23, 1980 (1984); I. H. Malitson
and M. J. Dodge, J. Opt. Soc. Am. 62, 1405 (1972), their formula by M. J. Dodge in Handbook of Laser
Science and Technology IV, part 2, p. 30 (CRC Press, 1986). All at room temperature."""

CRYSTALS = tuple(_KNOWN)
"""The names of those whose data are published."""

_SHORT = {"mgf2": "magnesium fluoride", "al2o3": "sapphire", "sio2": "quartz", "caco3": "calcite"}


@dataclass(frozen=True, eq=False)
class Crystal(ComparedByFields):
    """A uniaxial crystal, by its two indices of refraction.

    Parameters
    ----------
    ordinary, extraordinary : Material
        The media that its two rays meet.
    rotatory_power : float or Parameter, optional
        The optical rotation along the optic axis in radians per metre, positive for what is
        dextrorotatory: `Medium` takes it as ``dextrorotation``.
    label : str, optional
        What sentences call it.

    Examples
    --------
    >>> quartz = Crystal.named("quartz")
    >>> round(quartz.birefringence.at("589.3 nm"), 5)
    0.0091
    """

    ordinary: Material
    extraordinary: Material
    rotatory_power: Any = None
    label: str = "the crystal"

    def __post_init__(self) -> None:
        for name in ("ordinary", "extraordinary"):
            if not isinstance(ray := getattr(self, name), Material):
                raise ValueFault(
                    f"{name} of {self.label} is {shown(ray)}; give a Material, such as "
                    f"Material(1.544)"
                )

    @classmethod
    def named(cls, name: str, wavelength: Any = None) -> Crystal:
        """Return a crystal whose data are published.

        They are quartz (which turns light to the right) and calcite by Ghosh (1999), magnesium
        fluoride by Dodge (1984), and sapphire by Malitson and Dodge (1972); the rotatory power of
        quartz by T. M. Lowry and W. R. C. Coode-Adams, Phil. Trans. R. Soc. A 226, 391 (1927).

        Parameters
        ----------
        name : str
            ``"quartz"``, ``"calcite"``, ``"magnesium fluoride"`` or ``"sapphire"``; or a
            formula, such as ``"MgF2"``.
        wavelength : Parameter, float, str or array_like, optional
            As `Material.tabulated` takes it. Where it is known, the indices are numbers, and there
            is a rotatory power where one was measured.

        Returns
        -------
        Crystal

        Examples
        --------
        >>> Crystal.named("calcite").label
        'calcite (Ghosh 1999)'
        """
        key = _SHORT.get(str(name).lower(), str(name).lower())
        if key not in _KNOWN:
            raise ValueFault(f"crystal {shown(name)} is unknown{did_you_mean(str(name), _KNOWN)}")
        source, span, *rays = _KNOWN[key]
        ordinary, extraordinary = [
            Material.of_curve(Sellmeier(f"{way} {key} ({source})", **ray, span=span), wavelength)
            for way, ray in zip(("ordinary", "extraordinary"), rays, strict=True)
        ]
        rotation = _rotation_of_quartz(wavelength) if key == "quartz" else None
        return cls(ordinary, extraordinary, rotation, f"{key} ({source})")

    @property
    def birefringence(self) -> Any:
        """n_e - n_o: positive where the ordinary ray is the fast one, as in quartz."""
        n_e, n_o = self.extraordinary.n, self.ordinary.n
        if not _is_plain(n_e) or not _is_plain(n_o) or len(n_e.curve.b) != len(n_o.curve.b):
            return n_e - n_o
        if n_e.depends_on[0] != n_o.depends_on[0]:
            return n_e - n_o
        curve = BirefringenceCurve(f"the birefringence of {self.label}", n_e.curve, n_o.curve)
        return curve_values(curve, n_e.depends_on[0])[0]


def _is_plain(n: Any) -> bool:
    """Tell whether an index is that of a formula of Sellmeier, and no multiple of it."""
    return isinstance(n, CurveValue) and isinstance(n.curve, Sellmeier) and n.quantity == n.name


def _rotation_of_quartz(wavelength: Any) -> Any:
    """Return the rotatory power; measurements of 1882 are within 0.5 % of it up to 760 nm."""
    numbers = (9.5639, -2.3113), (0.0127493, 0.000974), -0.1905
    label = "the rotatory power of quartz (Lowry and Coode-Adams 1927)"
    span = ("226 nm", "1.1 um")
    try:
        return drude_rotation(*numbers, "deg/mm", label=label, span=span, wavelength=wavelength)
    except ValueFault:
        return None  # The indices are known farther.


@dataclass(frozen=True, eq=False)
class BirefringenceCurve(Curve):
    """n_e - n_o, by the differences of the coefficients of two formulas of as many terms.

    Subtracted indices would lose digits. With a and b for the extraordinary and the ordinary ray,
    each pair of terms differs by w^2 ((B_a - B_b) (w^2 - C_b) + B_b (C_a - C_b)) / ((w^2 - C_a)
    (w^2 - C_b)), and the squares of the indices by the sum of these.
    """

    label: str
    extraordinary: Sellmeier
    ordinary: Sellmeier

    @property
    def span(self) -> tuple[float, float]:  # type: ignore[override]
        """The wavelengths at which both are known."""
        rays = self.extraordinary.span, self.ordinary.span
        return max(low for low, _ in rays), min(high for _, high in rays)

    @property
    def content(self) -> tuple[Hashable, ...]:
        return self.label, self.extraordinary.digest, self.ordinary.digest

    def arguments(self) -> list[tuple[str, Any, Domain]]:
        return [*self.extraordinary.arguments(), *self.ordinary.arguments()]

    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        half = len(self.extraordinary.arguments())
        one, b, c = self.extraordinary.terms(arguments[:half])
        other, b0, c0 = self.ordinary.terms(arguments[half:])
        micrometres = wavelength * MICROMETRES
        square = micrometres * micrometres
        total = one - other + 0.0 * square
        for *strengths, pole, pole0 in zip(b, b0, c, c0, strict=True):
            ahead, ahead0 = square - pole, square - pole0
            at_resonance = (ahead == 0.0) | (ahead0 == 0.0)
            over = (strengths[0] - strengths[1]) * ahead0 + strengths[1] * (pole - pole0)
            term = square * over / xp.where(at_resonance, 1.0, ahead * ahead0)
            total = total + xp.where(at_resonance, xp.nan, term)
        indices = [
            index_of_square(xp, sellmeier_square(xp, micrometres, *terms))
            for terms in ((one, b, c), (other, b0, c0))
        ]
        return (total / (indices[0] + indices[1]),)

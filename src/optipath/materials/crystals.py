"""Crystal: a uniaxial crystal by its two indices, and the data of some."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

from optipath.errors import ValueFault, did_you_mean, shown
from optipath.materials.by_wavelength import drude_rotation
from optipath.materials.formulas import BirefringenceCurve, Sellmeier
from optipath.materials.material import Material
from optipath.values.arrays import same_fields
from optipath.values.curve_value import CurveValue, curve_values


class _Ray(NamedTuple):
    """The formula of Sellmeier of one ray, in micrometres."""

    offset: float
    b: tuple[float, ...]
    c: tuple[float, ...] | None = None
    resonances: tuple[float, ...] | None = None


class _Data(NamedTuple):
    source: str
    ordinary: _Ray
    extraordinary: _Ray
    span: tuple[str, str]


_KNOWN = {
    "quartz": _Data(
        "Ghosh 1999",
        _Ray(1.28604141, (1.07044083, 1.10202242), (1.00585997e-2, 100.0)),
        _Ray(1.28851804, (1.09509924, 1.15662475), (1.02101864e-2, 100.0)),
        ("198 nm", "2053.1 nm"),
    ),
    "calcite": _Data(
        "Ghosh 1999",
        _Ray(1.73358749, (0.96464345, 1.82831454), (1.94325203e-2, 120.0)),
        _Ray(1.35859695, (0.82427830, 0.14429128), (1.06689543e-2, 120.0)),
        ("204 nm", "2172 nm"),
    ),
    "magnesium fluoride": _Data(
        "Dodge 1984",
        _Ray(
            1.0,
            (0.48755108, 0.39875031, 2.3120353),
            resonances=(0.04338408, 0.09461442, 23.793604),
        ),
        _Ray(
            1.0,
            (0.41344023, 0.50497499, 2.4904862),
            resonances=(0.03684262, 0.09076162, 23.771995),
        ),
        ("200 nm", "7 um"),
    ),
    "sapphire": _Data(
        "Malitson and Dodge 1972",
        _Ray(
            1.0,
            (1.4313493, 0.65054713, 5.3414021),
            resonances=(0.0726631, 0.1193242, 18.028251),
        ),
        _Ray(
            1.0,
            (1.5039759, 0.55069141, 6.5927379),
            resonances=(0.0740288, 0.1216529, 20.072248),
        ),
        ("200 nm", "5 um"),
    ),
}
"""G. Ghosh, Opt. Commun. 163, 95 (1999); M. J. Dodge, Appl. Opt. 23, 1980 (1984); I. H. Malitson
and M. J. Dodge, J. Opt. Soc. Am. 62, 1405 (1972), their formula by M. J. Dodge in Handbook of Laser
Science and Technology IV, part 2, p. 30 (CRC Press, 1986). All at room temperature."""

CRYSTALS = tuple(_KNOWN)
"""The names of those whose data are published."""

_SHORT = {"mgf2": "magnesium fluoride", "al2o3": "sapphire", "sio2": "quartz", "caco3": "calcite"}


@dataclass(frozen=True, eq=False)
class Crystal:
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
        """Refuse what is no Material."""
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
            The wavelength of the run; ``Wavelength()`` by default. Where it is known, the
            indices are numbers, and there is a rotatory power where one was measured.

        Returns
        -------
        Crystal

        Raises
        ------
        ValueFault
            If it is unknown.

        Examples
        --------
        >>> Crystal.named("calcite").label
        'calcite (Ghosh 1999)'
        """
        key = _SHORT.get(str(name).lower(), str(name).lower())
        if key not in _KNOWN:
            raise ValueFault(f"crystal {shown(name)} is unknown{did_you_mean(str(name), _KNOWN)}")
        source, *rays, span = _KNOWN[key]
        materials = [
            _material(f"{way} {key} ({source})", ray, span, wavelength)
            for way, ray in zip(("ordinary", "extraordinary"), rays, strict=True)
        ]
        rotation = _rotation_of_quartz(wavelength) if key == "quartz" else None
        return cls(materials[0], materials[1], rotation, f"{key} ({source})")

    @property
    def birefringence(self) -> Any:
        """n_e - n_o: positive where the ordinary ray is the fast one, as in quartz."""
        rays = self.extraordinary.n, self.ordinary.n
        if not all(isinstance(ray, CurveValue) and _is_plain(ray) for ray in rays):
            return rays[0] - rays[1]
        one, other = [ray.curve for ray in rays]
        if len(one.b) != len(other.b) or rays[0].depends_on[0] != rays[1].depends_on[0]:
            return rays[0] - rays[1]
        curve = BirefringenceCurve(f"the birefringence of {self.label}", one, other)
        return curve_values(curve, rays[0].depends_on[0])[0]

    __eq__ = same_fields
    __hash__ = None  # type: ignore[assignment]


def _is_plain(ray: CurveValue) -> bool:
    """Tell whether an index is that of a formula of Sellmeier, and no multiple of it."""
    return isinstance(ray.curve, Sellmeier) and ray.quantity == ray.name


def _material(label: str, ray: _Ray, span: tuple[str, str], wavelength: Any) -> Material:
    curve = Sellmeier(label, ray.b, ray.c, resonances=ray.resonances, offset=ray.offset, span=span)
    return Material.of_curve(curve, wavelength)


def _rotation_of_quartz(wavelength: Any) -> Any:
    """Return the rotatory power; measurements of 1882 are within 0.5 % of it up to 760 nm."""
    numbers = (9.5639, -2.3113), (0.0127493, 0.000974), -0.1905
    label = "the rotatory power of quartz (Lowry and Coode-Adams 1927)"
    span = ("226 nm", "1.1 um")
    try:
        return drude_rotation(*numbers, "deg/mm", label=label, span=span, wavelength=wavelength)
    except ValueFault:
        return None  # The indices are known farther.

"""Short names of materials, each for one page of the database that was chosen for it."""

from __future__ import annotations

from functools import cache
from typing import NamedTuple


class CuratedName(NamedTuple):
    """A short name, and the page that it stands for.

    Units: clear in metres.
    """

    names: tuple[str, ...]
    place: str
    reference: str
    why: str
    clear: tuple[float, float] | None = None
    data: str = ""

    @property
    def label(self) -> str:
        """What sentences call it: ``"gold (Johnson and Christy 1972)"``."""
        return f"{self.names[0]} ({self.reference})"


_NOBLE, _TRANSITION = "Johnson and Christy 1972", "Johnson and Christy 1974"
_METAL = "evaporated films, the usual reference from the ultraviolet to the near infrared"
_O, _E = "ordinary ray", "extraordinary ray"

CURATED = (
    CuratedName(("gold",), "main/Au/Johnson", _NOBLE, _METAL),
    CuratedName(("silver",), "main/Ag/Johnson", _NOBLE, _METAL),
    CuratedName(("copper",), "main/Cu/Johnson", _NOBLE, _METAL),
    CuratedName(
        ("aluminium", "aluminum"), "main/Al/Rakic", "Rakić 1995", "from X-rays to far infrared"
    ),
    CuratedName(("chromium",), "main/Cr/Johnson", _TRANSITION, _METAL),
    CuratedName(("nickel",), "main/Ni/Johnson", _TRANSITION, _METAL),
    CuratedName(("iron",), "main/Fe/Johnson", _TRANSITION, _METAL),
    CuratedName(("cobalt",), "main/Co/Johnson", _TRANSITION, _METAL),
    CuratedName(("palladium",), "main/Pd/Johnson", _TRANSITION, _METAL),
    CuratedName(("titanium",), "main/Ti/Johnson", _TRANSITION, _METAL),
    CuratedName(
        ("platinum",), "main/Pt/Tselin", "Tselin et al. 2024", "ellipsometry, of the widest range"
    ),
    CuratedName(
        ("tungsten",),
        "main/W/Werner",
        "Werner et al. 2009",
        "from far ultraviolet to near infrared; the table of Weaver has a wavelength twice",
    ),
    CuratedName(
        ("mercury",),
        "main/Hg/Inagaki",
        "Inagaki et al. 1981",
        "liquid, from far ultraviolet to infrared",
    ),
    CuratedName(
        ("silicon",), "main/Si/Green-2008", "Green 2008", "crystal at 300 K, self-consistent"
    ),
    CuratedName(
        ("germanium",), "main/Ge/Nunley", "Nunley et al, 2016", "crystal, of the widest range"
    ),
    CuratedName(
        ("GaAs", "gallium arsenide"),
        "main/GaAs/Papatryfonos",
        "Papatryfonos et al. 2021",
        "crystal, beyond the edge of absorption as well",
    ),
    CuratedName(
        ("diamond",), "main/C/Phillip", "Phillip and Taft 1964", "the only one from 35 nm to 10 um"
    ),
    CuratedName(
        ("TiO2", "titania"),
        "main/TiO2/Siefke",
        "Siefke et al. 2016",
        "amorphous film; the crystal is rutile",
    ),
    CuratedName(("rutile-o",), "main/TiO2/Devore-o", "Devore 1951", _O, (0.45e-6, 1.53e-6)),
    CuratedName(("rutile-e",), "main/TiO2/Devore-e", "Devore 1951", _E, (0.45e-6, 1.53e-6)),
    CuratedName(
        ("silica", "fused silica"),
        "main/SiO2/Malitson",
        "Malitson 1965",
        "the usual formula; water in it absorbs from 2.2 um on",
        (0.21e-6, 2.1e-6),
    ),
    CuratedName(("quartz-o",), "main/SiO2/Ghosh-o", "Ghosh 1999", _O, (0.198e-6, 2.0531e-6)),
    CuratedName(("quartz-e",), "main/SiO2/Ghosh-e", "Ghosh 1999", _E, (0.198e-6, 2.0531e-6)),
    CuratedName(("calcite-o",), "main/CaCO3/Ghosh-o", "Ghosh 1999", _O, (0.23e-6, 2.1e-6)),
    CuratedName(("calcite-e",), "main/CaCO3/Ghosh-e", "Ghosh 1999", _E, (0.23e-6, 2.1e-6)),
    CuratedName(
        ("sapphire-o",), "main/Al2O3/Malitson-o", "Malitson and Dodge 1972", _O, (0.2e-6, 4e-6)
    ),
    CuratedName(
        ("sapphire-e",), "main/Al2O3/Malitson-e", "Malitson and Dodge 1972", _E, (0.2e-6, 4e-6)
    ),
    CuratedName(("MgF2-o",), "main/MgF2/Dodge-o", "Dodge 1984", _O, (0.2e-6, 6e-6)),
    CuratedName(("MgF2-e",), "main/MgF2/Dodge-e", "Dodge 1984", _E, (0.2e-6, 6e-6)),
    CuratedName(
        ("LiNbO3-o", "lithium niobate-o"),
        "main/LiNbO3/Zelmon-o",
        "Zelmon et al. 1997",
        _O,
        (0.42e-6, 4e-6),
    ),
    CuratedName(
        ("LiNbO3-e", "lithium niobate-e"),
        "main/LiNbO3/Zelmon-e",
        "Zelmon et al. 1997",
        _E,
        (0.42e-6, 4e-6),
    ),
    CuratedName(("BBO-o",), "main/BaB2O4/Tamosauskas-o", "Tamošauskas et al. 2018", _O),
    CuratedName(("BBO-e",), "main/BaB2O4/Tamosauskas-e", "Tamošauskas et al. 2018", _E),
    CuratedName(
        ("CaF2", "fluorite"),
        "main/CaF2/Malitson",
        "Malitson 1963",
        "the usual formula",
        (0.23e-6, 7.5e-6),
    ),
    CuratedName(
        ("BK7",),
        "specs/SCHOTT-optical/N-BK7",
        "Schott 2017",
        "N-BK7, which has taken its place",
        data="specs/schott/optical/N-BK7.yml",
    ),
    *[
        CuratedName(
            (glass,),
            f"specs/SCHOTT-optical/{glass}",
            "Schott 2017",
            f"lead glass; that without lead is N-{glass}",
            data=f"specs/schott/optical/{glass}.yml",
        )
        for glass in ("F2", "SF6", "SF10", "SF11")
    ],
    CuratedName(
        ("PMMA", "acrylic"),
        "organic/poly_methyl_methacrylate/Szczurowski",
        "Szczurowski 2013",
        "from violet to near infrared",
        (0.405e-6, 1.08e-6),
        "organic/(C5H8O2)n - poly(methyl methacrylate)/nk/Szczurowski.yml",
    ),
    CuratedName(
        ("polycarbonate",),
        "organic/polycarbonate/Sultanova",
        "Sultanova et al. 2009",
        "visible light and near infrared",
        (0.437e-6, 1.052e-6),
        "organic/(C16H14O3)n - polycarbonate/nk/Sultanova.yml",
    ),
    CuratedName(
        ("polystyrene",),
        "organic/polystyrene/Sultanova",
        "Sultanova et al. 2009",
        "visible light and near infrared",
        (0.437e-6, 1.052e-6),
        "organic/(C8H8)n - polystyrene/nk/Sultanova.yml",
    ),
    CuratedName(
        ("water",), "main/H2O/Hale", "Hale and Querry 1973", "25 °C, from 200 nm to 200 um"
    ),
    CuratedName(("ice",), "main/H2O/Warren-2008", "Warren and Brandt 2008", "the later of two"),
    CuratedName(
        ("air",),
        "other/air/Ciddor",
        "Ciddor 1996",
        "15 °C, 101325 Pa, 450 ppm CO2",
        (0.23e-6, 1.69e-6),
        "other/mixed gases/air/nk/Ciddor.yml",
    ),
)
"""The names in the order of the list."""


def alike(name: str) -> str:
    """Return a name in small letters, with spaces for hyphens and underscores.

    Examples
    --------
    >>> alike("Fused_Silica"), alike("quartz-o")
    ('fused silica', 'quartz o')
    """
    return " ".join(name.replace("_", " ").replace("-", " ").casefold().split())


@cache
def curated_names() -> dict[str, CuratedName]:
    """Return what each name stands for, as `alike` writes it.

    Examples
    --------
    >>> curated_names()["aluminum"].place
    'main/Al/Rakic'
    """
    return {alike(name): curated for curated in CURATED for name in curated.names}

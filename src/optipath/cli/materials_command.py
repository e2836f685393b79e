"""``optipath materials``: materials by name, and what they are at a wavelength."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import click
import numpy as np

from optipath.cli.console import (
    DIGITS,
    JSON,
    PlainConsole,
    headed,
    say,
    say_json,
    say_wrapped,
    title,
)
from optipath.cli.options import StrictCommand, completed_by, given_options
from optipath.elements.fresnel import effective_index, fresnel_reflection
from optipath.errors import MaterialError, OptipathError
from optipath.faults import did_you_mean, listed
from optipath.materials.database import described, known_spans, pages_with
from optipath.materials.database_names import CURATED, VACUUM, alike, catalog_pages
from optipath.materials.material import Material
from optipath.materials.quantities import INCIDENCE as INCIDENCE_DOMAIN
from optipath.materials.quantities import plain
from optipath.values.curve import WavelengthRange, span_text
from optipath.values.curve_value import CurveValue
from optipath.values.units import format_quantity, in_unit, parse_quantity
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import numpy.typing as npt

    from optipath.materials.database_names import NamedPage
    from optipath.materials.tables import PageCurve


_UNIT, _LONGEST = "nm", 1e-5
_NOTHING = "n = 1, k = 0"
_VACUUM = {"name": VACUUM, "names": [VACUUM], "page": "", "range": None, "source": ""}
_VACUUM |= {"about": _NOTHING}


_short_names = completed_by(lambda: [name for one in CURATED for name in one.names])

WORDS = click.Argument(["words"], nargs=-1, metavar="[SEARCH]", shell_complete=_short_names)
AT = click.Option(
    ["--at", "wavelengths"],
    metavar="WAVELENGTH",
    multiple=True,
    help="Tell n and k there: '516 nm', '2.4 eV'. May be repeated.",
)
PAGE = click.Option(["--page"], default="", show_default=False, help="Which page of the book.")
OWN = [
    click.Option([f"--{part}"], type=float, help=f"In place of the {part} of the page.")
    for part in ("n", "k")
]
INCIDENCE = click.Option(
    ["--incidence"], default="0", metavar="ANGLE", help="Where the effective index is told."
)


def _materials(
    words: tuple[str, ...],
    wavelengths: tuple[str, ...],
    page: str,
    incidence: str,
    *,
    digits: int,
    as_json: bool,
    **own: float | None,
) -> None:
    """List materials by name, or tell n and k of one with --at."""
    name = " ".join(words)
    if wavelengths:
        report = material_report(name, page, wavelengths, incidence, own)
        say_json(report.as_json()) if as_json else report.print(digits)
        return
    if wrong := {"--page", "--incidence", "--n", "--k"}.intersection(given_options()):
        raise click.UsageError(
            f"{listed(sorted(wrong))} goes with --at; write --at '550 nm' as well"
        )
    # Of vacuum no page is needed.
    is_vacuum = alike(name) == VACUUM
    result = [] if is_vacuum else pages_with(name.split())
    if not result and not is_vacuum:
        names = [VACUUM, *(name for curated in CURATED for name in curated.names)]
        raise MaterialError(f"no page has '{name}'{did_you_mean(name, names)}")
    with_vacuum = is_vacuum or not words
    if as_json:
        several = [_as_json(one) for one in result] + [_VACUUM] * with_vacuum
        say_json({"materials": several, "units": {"range": _UNIT}})
        return
    rows = [(one.name, _range_text(one), described(one)) for one in result]
    rows += [(VACUUM, "any wavelength", _NOTHING)] * with_vacuum
    PlainConsole().print(headed("material", "range", "source", rows=rows, box=None))
    if not words:
        say(f"\n{len(catalog_pages())} pages of refractiveindex.info: optipath materials WORD")


materials = click.command(
    "materials", cls=StrictCommand, params=[WORDS, AT, PAGE, *OWN, INCIDENCE, DIGITS, JSON]
)(_materials)


def _range_text(one: NamedPage) -> str:
    """Return what is known and where, with as many digits as a list needs."""
    spans = known_spans(one)
    low, high = (f([s[at] for s in spans.values()], default=0.0) for at, f in ((0, max), (1, min)))
    each = {",".join(spans): (low, high)} if low < high else spans
    unit = "nm" if high < _LONGEST else "um"
    ends = {part: [f"{in_unit(end, unit):.5g}" for end in span] for part, span in each.items()}
    return "; ".join([f"{part} {' .. '.join(span)} {unit}" for part, span in ends.items()])


def _as_json(one: NamedPage) -> dict[str, Any]:
    return {
        "name": one.name,
        "names": list(one.curated.names) if one.curated else [one.name],
        "page": one.page.place,
        "range": {
            part: [in_unit(e, _UNIT) for e in span] for part, span in known_spans(one).items()
        },
        "source": one.page.about_page,
        "about": described(one),
    }


@dataclass(frozen=True)
class MaterialReport:
    """The report of a material; incidence in radians, figures by name, each of shape (n,)."""

    name: str
    curve: PageCurve | None
    incidence: float
    wavelengths: npt.NDArray[Any]
    figures: Mapping[str, npt.NDArray[Any]]

    def as_json(self) -> dict[str, Any]:
        """Return it as JSON can hold it, with all digits."""
        curve = self.curve
        return {
            "material": self.name,
            "page": curve.place if curve else "",
            "source": curve.source if curve else "",
            "range": curve and [plain(end, _UNIT) for end in curve.span],
            "incidence": plain(self.incidence, "deg"),
            "wavelength": plain(self.wavelengths, _UNIT),
            **{name: plain(numbers) for name, numbers in self.figures.items()},
            "units": {"range": _UNIT, "wavelength": _UNIT, "incidence": "deg"},
        }

    def print(self, digits: int) -> None:
        """Print it as a table."""
        console, curve = PlainConsole(), self.curve
        console.print(title(self.name, span_text(curve.span) if curve else "at any wavelength"))
        angle = format_quantity(self.incidence, "deg")
        behind = [f"{part} at {angle}" for part in ("n'", "k'")]
        rows = [
            [f"{in_unit(wavelength, _UNIT):.{digits}g} {_UNIT}", *(f"{n:.{digits}g}" for n in row)]
            for wavelength, *row in zip(self.wavelengths, *self.figures.values(), strict=True)
        ]
        heads = "wavelength", "n", "k", "normal reflectance", *behind
        console.print(headed(*heads, rows=rows, box=None))
        if curve and curve.source:
            say_wrapped(f"{curve.place}: {curve.source}")


def material_report(
    name: str, page: str, wavelengths: Sequence[str], incidence: str, own: Mapping[str, Any]
) -> MaterialReport:
    """Return what a material is at wavelengths. Units: incidence in degrees."""
    if not name:
        raise MaterialError("--at needs the name of a material: optipath materials gold --at ...")
    faults: list[str] = []
    where, angle = [], 0.0
    for text in wavelengths:
        with OptipathError.collecting(faults, about="--at"):
            where.append(float(Wavelength().resolve(text).value))
    with OptipathError.collecting(faults):
        asked = parse_quantity(incidence, "angle", "deg")
        angle = float(INCIDENCE_DOMAIN.check("--incidence", asked))
    MaterialError.raise_for(faults)
    parts = Material.named(name, page=page, **own)
    there = np.array(where)
    figures: dict[str, npt.NDArray[Any]] = {}
    curves: list[PageCurve] = []
    for key, part in (("n", parts.n), ("k", parts.k)):
        if isinstance(part, CurveValue):
            curves.append(part.curve)
            for wavelength in where:
                WavelengthRange.of(part.curve).check("--at", wavelength)
        numbers = part.at(there) if isinstance(part, CurveValue) else part
        figures[key] = np.broadcast_to(np.asarray(numbers, np.float64), there.shape)
    index = figures["n"] + 1j * figures["k"]
    figures["reflectance"] = fresnel_reflection(index, 1.0, 0.0)[0]
    figures["effective_n"], figures["effective_k"] = effective_index(index, angle)
    first = curves[0] if curves else None
    return MaterialReport(first.label if first else name, first, angle, there, figures)

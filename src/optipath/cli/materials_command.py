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
    cell,
    headed,
    say,
    say_json,
    say_wrapped,
    title,
)
from optipath.cli.options import StrictCommand
from optipath.elements.fresnel import effective_index, fresnel_reflection
from optipath.errors import MaterialError, collecting, did_you_mean
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
    from click.shell_completion import CompletionItem

    from optipath.materials.database_names import NamedPage
    from optipath.materials.tables import PageCurve


_UNIT, _LONGEST = "nm", 1e-5
_NOTHING = "n = 1, k = 0"
_VACUUM = {"name": VACUUM, "names": [VACUUM], "page": "", "range": None, "source": ""}
_VACUUM |= {"about": _NOTHING}


class _Name(click.Argument):
    """Words, which a shell completes to short names."""

    def shell_complete(self, ctx: click.Context, incomplete: str) -> list[CompletionItem]:
        """Return the short names that begin so."""
        from click.shell_completion import CompletionItem  # noqa: PLC0415 - for shells alone

        del ctx
        names = [name for curated in CURATED for name in curated.names]
        return [CompletionItem(name) for name in names if name.startswith(incomplete)]


WORDS = _Name(["words"], nargs=-1, metavar="[SEARCH]")
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
    n: float | None,
    k: float | None,
    digits: int,
    as_json: bool,
) -> None:
    """List materials by name, or tell n and k of one with --at."""
    if wavelengths:
        message = reported_at(" ".join(words), page, wavelengths, incidence, {"n": n, "k": k})
        say_json(message.as_json()) if as_json else message.print(digits)
        return
    arguments = {"--page": page, "--incidence": incidence != "0", "--n": n is not None}
    for option in [name for name, there in {**arguments, "--k": k is not None}.items() if there]:
        raise click.UsageError(f"{option} goes with --at; write --at '550 nm' as well")
    # Of vacuum no page is needed.
    vacuum = alike(" ".join(words)) == VACUUM
    result = [] if vacuum else pages_with(" ".join(words).split())
    if not result and not vacuum:
        names = [VACUUM, *[name for curated in CURATED for name in curated.names]]
        meant = did_you_mean(" ".join(words), names)
        raise MaterialError(f"no page has '{' '.join(words)}'{meant}")
    if as_json:
        listed = [_as_json(one) for one in result] + [_VACUUM] * (vacuum or not words)
        say_json({"materials": listed, "units": {"range": _UNIT}})
        return
    _print(result, vacuum=vacuum or not words, everything=not words)


materials = click.command(
    "materials", cls=StrictCommand, params=[WORDS, AT, PAGE, *OWN, INCIDENCE, DIGITS, JSON]
)(_materials)


def _print(results: list[NamedPage], *, vacuum: bool, everything: bool) -> None:
    table = headed("material", "range", "source", box=None)
    for one in results:
        table.add_row(*map(cell, (one.name, _range_text(one), described(one))))
    if vacuum:
        table.add_row(*map(cell, (VACUUM, "any wavelength", _NOTHING)))
    PlainConsole().print(table)
    if everything:
        say(f"\n{len(catalog_pages())} pages of refractiveindex.info: optipath materials WORD")


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
    """The report of a material: figures (n,), span in metres, incidence in radians."""

    name: str
    place: str
    source: str
    span: tuple[float, float] | None
    incidence: float
    wavelengths: npt.NDArray[Any]
    n: npt.NDArray[Any]
    k: npt.NDArray[Any]
    reflectance: npt.NDArray[Any]
    effective_n: npt.NDArray[Any]
    effective_k: npt.NDArray[Any]

    def as_json(self) -> dict[str, Any]:
        """Return it as JSON can hold it, with all digits."""
        results = {
            "material": self.name,
            "page": self.place,
            "source": self.source,
            "range": self.span and [plain(end, "nm") for end in self.span],
            "incidence": plain(self.incidence, "deg"),
            "wavelength": plain(self.wavelengths, "nm"),
        }
        for key in ("n", "k", "reflectance", "effective_n", "effective_k"):
            results[key] = plain(getattr(self, key))
        return results | {"units": {"range": "nm", "wavelength": "nm", "incidence": "deg"}}

    def print(self, digits: int) -> None:
        """Print it as a table."""
        console = PlainConsole()
        console.print(title(self.name, span_text(self.span) if self.span else "at any wavelength"))
        angle = format_quantity(self.incidence, "deg")
        behind = [f"{part} at {angle}" for part in ("n'", "k'")]
        table = headed("wavelength", "n", "k", "normal reflectance", *behind, box=None)
        columns = (self.n, self.k, self.reflectance, self.effective_n, self.effective_k)
        for wavelength, *numbers in zip(self.wavelengths, *columns, strict=True):
            texts = [f"{number:.{digits}g}" for number in numbers]
            table.add_row(*map(cell, (f"{in_unit(wavelength, 'nm'):.{digits}g} nm", *texts)))
        console.print(table)
        if self.source:
            say_wrapped(f"{self.place}: {self.source}")


def reported_at(
    name: str, page: str, wavelengths: Sequence[str], incidence: str, own: Mapping[str, Any]
) -> MaterialReport:
    """Return what a material is at wavelengths. Units: incidence in degrees."""
    if not name:
        raise MaterialError("--at needs the name of a material: optipath materials gold --at ...")
    faults: list[str] = []
    where, angle = [], 0.0
    for text in wavelengths:
        with collecting(faults, about="--at"):
            where.append(float(Wavelength().resolve(text).value))
    with collecting(faults):
        angle = float(
            INCIDENCE_DOMAIN.check("--incidence", parse_quantity(incidence, "angle", "deg"))
        )
    if faults:
        raise MaterialError(*faults)
    parts = Material.named(name, page=page, **own)
    there = np.array(where)
    curve: PageCurve | None = None
    figures = []
    for part in (parts.n, parts.k):
        if isinstance(part, CurveValue):
            curve = curve or part.curve
            for wavelength in where:
                WavelengthRange.of(part.curve).check("--at", wavelength)
        result = part.at(there) if isinstance(part, CurveValue) else part
        figures.append(np.broadcast_to(np.asarray(result, np.float64), there.shape))
    n, k = figures
    index = n + 1j * k
    effective_n, effective_k = effective_index(index, angle)
    return MaterialReport(
        curve.label if curve else name,
        curve.place if curve else "",
        curve.source if curve else "",
        curve.span if curve else None,
        angle,
        there,
        n,
        k,
        fresnel_reflection(index, 1.0, 0.0)[0],
        effective_n,
        effective_k,
    )

"""``optipath materials``: materials by name, and what they are at a wavelength."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from optipath.cli.console import DIGITS, JSON, PlainConsole, cell, headed, say, say_json
from optipath.cli.material_report import told_at
from optipath.cli.misplaced import StrictCommand
from optipath.errors import MaterialError, did_you_mean
from optipath.values.database.catalog_pages import catalog_pages
from optipath.values.database.curated_names import CURATED, alike
from optipath.values.database.named_pages import VACUUM
from optipath.values.database.search import FoundPage, pages_with
from optipath.values.units import in_unit

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem

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
        told = told_at(" ".join(words), page, wavelengths, incidence, {"n": n, "k": k})
        say_json(told.as_json()) if as_json else told.print(digits)
        return
    given = {"--page": page, "--incidence": incidence != "0", "--n": n is not None}
    for option in [name for name, there in {**given, "--k": k is not None}.items() if there]:
        raise click.UsageError(f"{option} goes with --at; write --at '550 nm' as well")
    # Of vacuum no page is needed.
    vacuum = alike(" ".join(words)) == VACUUM
    found = [] if vacuum else pages_with(" ".join(words).split())
    if not found and not vacuum:
        names = [VACUUM, *[name for curated in CURATED for name in curated.names]]
        meant = did_you_mean(" ".join(words), names)
        raise MaterialError(f"no page has '{' '.join(words)}'{meant}")
    if as_json:
        listed = [_as_json(one) for one in found] + [_VACUUM] * (vacuum or not words)
        say_json({"materials": listed, "units": {"range": _UNIT}})
        return
    _print(found, vacuum=vacuum or not words, everything=not words)


materials = click.command(
    "materials", cls=StrictCommand, params=[WORDS, AT, PAGE, *OWN, INCIDENCE, DIGITS, JSON]
)(_materials)


def _print(found: list[FoundPage], *, vacuum: bool, everything: bool) -> None:
    table = headed("material", "range", "source", box=None)
    for one in found:
        table.add_row(*map(cell, (one.name, _range_text(one), one.described)))
    if vacuum:
        table.add_row(*map(cell, (VACUUM, "any wavelength", _NOTHING)))
    PlainConsole().print(table)
    if everything:
        say(f"\n{len(catalog_pages())} pages of refractiveindex.info: optipath materials WORD")


def _range_text(one: FoundPage) -> str:
    """Return what is known and where, with as many digits as a list needs."""
    spans = one.spans()
    low, high = (f([s[at] for s in spans.values()], default=0.0) for at, f in ((0, max), (1, min)))
    each = {",".join(spans): (low, high)} if low < high else spans
    unit = "nm" if high < _LONGEST else "um"
    ends = {part: [f"{in_unit(end, unit):.5g}" for end in span] for part, span in each.items()}
    return "; ".join([f"{part} {' .. '.join(span)} {unit}" for part, span in ends.items()])


def _as_json(one: FoundPage) -> dict[str, Any]:
    return {
        "name": one.name,
        "names": list(one.curated.names) if one.curated else [one.name],
        "page": one.page.place,
        "range": {part: [in_unit(e, _UNIT) for e in span] for part, span in one.spans().items()},
        "source": one.page.about_page,
        "about": one.described,
    }

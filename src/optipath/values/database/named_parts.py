"""n and k of a material by name or from a file, as values that stand in a path."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import MaterialError
from optipath.values.curves.curve_at import curve_at
from optipath.values.database.curated_names import alike
from optipath.values.database.installed import read_yaml
from optipath.values.database.named_pages import VACUUM, NamedPage, named_page
from optipath.values.database.page_reading import page_curve
from optipath.values.given_files import given_file

if TYPE_CHECKING:
    from collections.abc import Mapping
    from os import PathLike

    from optipath.values.curves.page_curve import PageCurve


def parts_by_name(
    name: str,
    page: str,
    own: Mapping[str, Any],
    wavelength: Any,
    *,
    interpolation: str,
    extrapolate: str,
) -> dict[str, Any]:
    """Return n and k of a material by its name.

    Units: wavelength in metres.
    """
    given = {part: value for part, value in own.items() if value is not None}
    if isinstance(name, str) and alike(name) == VACUUM and not page:
        return {"n": 1.0, "k": 0.0, **given}
    found = named_page(name, page)
    if found.clear and "k" not in given:
        given["k"] = 0.0
    else:
        found = found._replace(clear=None)
    curve = curve_of(found, own=given, interpolation=interpolation, extrapolate=extrapolate)
    return {**dict(zip(curve.parts, curve_at(curve, wavelength), strict=True)), **given}


def parts_of_file(
    path: str | PathLike[str],
    own: Mapping[str, Any],
    wavelength: Any,
    *,
    interpolation: str,
    extrapolate: str,
) -> dict[str, Any]:
    """Return n and k of a material from a YAML file of refractiveindex.info.

    Units: wavelength in metres.
    """
    given = {part: value for part, value in own.items() if value is not None}
    file = given_file(path, MaterialError)
    curve = page_curve(
        read_yaml(file, str(file), installed=False),
        file.name,
        str(file),
        wanted=_wanted(file.name, given),
        interpolation=interpolation,
        extrapolate=extrapolate,
    )
    return {**dict(zip(curve.parts, curve_at(curve, wavelength), strict=True)), **given}


def curve_of(
    found: NamedPage,
    *,
    own: Mapping[str, Any],
    interpolation: str = "linear",
    extrapolate: str = "",
) -> PageCurve:
    """Return the curve of a page of the database, without the parts that are given apart."""
    how = {"interpolation": interpolation, "extrapolate": extrapolate}
    usual = {"interpolation": "linear", "extrapolate": ""}
    about = found.page.place
    return page_curve(
        read_yaml(found.page.file, about, installed=True),
        found.label,
        about,
        wanted=_wanted(found.name, own),
        within=found.clear,
        asked={"name": found.name, **{k: v for k, v in how.items() if v != usual[k]}},
        remedy=f"name another page, or mend a copy of {found.page.file} for Material.from_yaml",
        **how,
    )


def _wanted(name: str, own: Mapping[str, Any]) -> list[str]:
    wanted = [part for part in ("n", "k") if part not in own]
    if not wanted:
        raise MaterialError(
            f"'{name}' is asked for with an n and a k of its own; op.Material(n, k) needs no name"
        )
    return wanted

"""Pictures in files, whose endings say in which form."""

from __future__ import annotations

from io import BytesIO
from typing import TYPE_CHECKING, Any

from optipath.errors import OptipathError
from optipath.values.written_files import write_file

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.figure import Figure

_METADATA: dict[str, dict[str, Any]] = {
    ".png": {},
    ".svg": {"Date": None},
    ".pdf": {"CreationDate": None},
}
"""The endings, and what is said in each form so that a picture has the same bits every time."""

_TEXT_IS_TEXT: dict[Any, Any] = {
    "svg.fonttype": "none",
    "pdf.fonttype": 42,
    "svg.hashsalt": "optipath",
}


def check_form(file: Path) -> None:
    """Refuse a file in whose form nothing can be drawn."""
    if file.suffix.lower() not in _METADATA:
        known = ", ".join(_METADATA)
        raise OptipathError(f"'{file}' has an ending that cannot be drawn; use one of: {known}")


def write_picture(figure: Figure, file: Path, dots_per_inch: float | str = "figure") -> None:
    """Draw a figure into a file, with texts that can be searched and set in another type."""
    from matplotlib import rc_context  # noqa: PLC0415 - an extra

    check_form(file)
    form, drawn = file.suffix.lower(), BytesIO()
    # For as long as it is written: there is no other way to say it.
    with rc_context(_TEXT_IS_TEXT):
        figure.savefig(drawn, format=form[1:], dpi=dots_per_inch, metadata=_METADATA[form])
    write_file(file, drawn.getvalue())

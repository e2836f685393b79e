"""What the text of a preset holds, read as TOML."""

from __future__ import annotations

import tomllib
from typing import Any

from optipath.errors import PresetError
from optipath.paths.format.limits import refuse_unwieldy
from optipath.paths.format.slips import likely_cure


def parsed(text: str, source: str) -> dict[str, Any]:
    """Return what a text holds."""
    try:
        refuse_unwieldy(text)
    except PresetError as error:
        raise PresetError(f"'{source}' is not TOML as presets use it: {error}") from None
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError) as error:  # Numbers of 4300 digits are a ValueError.
        reason = "too deeply nested" if isinstance(error, RecursionError) else str(error)
        cure = likely_cure(text, reason)
        raise PresetError(f"'{source}' is not TOML: {reason}{cure}") from None

"""``optipath cache``: the compiled code that is kept on disk."""

from __future__ import annotations

import click

from optipath.cli.console import JSON, say_json
from optipath.cli.options import StrictCommand
from optipath.engines.code_cache import CODE

CLEAR = click.Option(["--clear"], is_flag=True, help="Remove all that is kept.")


def _cache(*, clear: bool, as_json: bool) -> None:
    """Show the folder of compiled code and how much it holds, or clear it."""
    removed = CODE.clear() if clear else 0
    entries = CODE.entries()
    results = {
        "folder": str(CODE.folder),
        "entries": len(entries),
        "bytes": sum(entry.length for entry in entries),
        "limit": CODE.limit,
    }
    if as_json:
        say_json(results | ({"removed": removed} if clear else {}))
    elif clear:
        click.echo(f"removed {removed} entries from {results['folder']}")
    else:
        for name, value in results.items():
            click.echo(f"{name:8} {value if isinstance(value, str) else f'{value:,}'}")


cache = click.command("cache", cls=StrictCommand, params=[CLEAR, JSON])(_cache)

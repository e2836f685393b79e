"""``optipath explore``: paths on a page in the browser, with sliders."""

from __future__ import annotations

import webbrowser
from threading import Thread

import click

from optipath.cli.console import say
from optipath.cli.options import StrictCommand, completed_by
from optipath.explorer.answers import PageAnswers
from optipath.explorer.paths import FIRST, ExploredPresets
from optipath.explorer.server import PageServer
from optipath.paths.files.presets import preset_names

PRESET = click.Argument(
    ["preset"], required=False, metavar="[PRESET]", shell_complete=completed_by(preset_names)
)
BROWSER = click.Option(
    ["--browser/--no-browser"],
    default=True,
    show_default=False,
    help="Open the page, or only print its address.",
)
PORT = click.Option(
    ["--port"],
    type=click.IntRange(0, 65535),
    default=0,
    show_default=False,
    help="Where it listens on this machine; a free one by default.",
)


def _explore(preset: str | None, *, browser: bool, port: int) -> None:
    """Show presets, or a TOML file, on a page in the browser that is served from this machine."""
    presets = ExploredPresets(FIRST if preset is None else preset)
    with PageServer(PageAnswers(presets), port) as server:
        say(f"the explorer is at {server.address}")
        say("it is open to this machine alone, and to nobody without this address; Ctrl-C ends it")
        if browser:
            # Some browsers come back only when they are closed.
            Thread(target=_open, args=[server.address], daemon=True).start()
        server.serve_forever()


def _open(address: str) -> None:
    """Open the page where there is a browser; the address has been printed all the same."""
    try:
        result = webbrowser.open(address)
    except (webbrowser.Error, OSError):
        result = False
    if not result:
        say("no browser could be opened; open the address above")


explore = click.command("explore", cls=StrictCommand, params=[PRESET, BROWSER, PORT])(_explore)

"""An honest race against the peers: the same work, in turns, the error beside every time.

pip install ".[fast,jax,chart]" mitsuba pypolar py_pol tmm katsu; what is not there is left out.
Mitsuba and Dr.Jit also need the shared library of LLVM.
"""

import one_thread  # noqa: F401 - before NumPy comes

# isort: split

import json
from pathlib import Path

import click

from contest import contest
from report import BEGIN, END, has_place, machine, markdown, put
from work import FILTER, MATERIALS, PRESET


@click.command(help=__doc__)
@click.option("--paths", type=click.IntRange(1_000), default=1_000_000, show_default=True)
@click.option(
    "--seconds", default=0.5, show_default=True, help="About how long each contender runs."
)
@click.option("--json", "json_file", type=click.Path(path_type=Path), help="Write a JSON file.")
@click.option(
    "--write", "page", type=click.Path(exists=True, path_type=Path), help="Write into a page."
)
def main(paths, seconds, json_file, page):
    if page and not has_place(page.read_text(encoding="utf-8")):
        raise click.ClickException(
            f"{page} has no place for the tables; put '{BEGIN}' and '{END}' into it"
        )
    contests = {name: contest(name, paths, seconds, tick) for name in MATERIALS}
    text = markdown(contests, machine())
    click.echo(text)
    if json_file:
        json_file.write_text(json.dumps(as_json(contests), indent=1), encoding="utf-8")
    if page:
        page.write_text(put(page.read_text(encoding="utf-8"), text), encoding="utf-8")


def tick(what):
    click.echo(what, err=True)


def as_json(contests):
    """Return what `optipath chart --peers` reads."""
    found = {
        name: {
            "path": {**FILTER, **MATERIALS[name]._asdict()},
            "results": [result._asdict() for result in results],
            "left out": absent,
        }
        for name, (results, absent) in contests.items()
    }
    return {"path": {"preset": PRESET}, "contests": found, **machine()}


if __name__ == "__main__":
    main()

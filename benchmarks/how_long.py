"""How long the commands of the README take, each once, in a fresh copy and fresh environments.

python benchmarks/how_long.py --write docs/performance.md
"""

import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import click

from optipath.lab.bench import processor

ROOT = Path(__file__).parents[1]
BEGIN = "<!-- how long: python benchmarks/how_long.py --write docs/performance.md -->"
END = "<!-- end of how long -->"
NOT_TIMED = ("optipath explore", "optipath run ./my-path.toml")  # no end; no file
ALSO = ("pytest tests/light", "pytest benchmarks --benchmark-only")


@click.command(help=__doc__)
@click.option("--python", default=sys.executable, help="The Python of the environments.")
@click.option("--write", "page", type=click.Path(exists=True, path_type=Path), help="A page.")
def main(python, page):
    with tempfile.TemporaryDirectory() as folder:
        rows = list(timed(Path(folder), python))
    failed = [command for command, taken in rows if taken is None]
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    version = ".".join(map(str, sys.version_info[:3]))
    text = "\n".join(
        [
            "| command | seconds |",
            "| --- | ---: |",
            *(f"| `{command}` | {taken:,.1f} |" for command, taken in rows if taken),
            "",
            f"On {cores} cores of {processor()}, Python {version}.",
        ]
    )
    click.echo(text)
    if page:
        before, rest = page.read_text(encoding="utf-8").split(BEGIN)
        _, after = rest.split(END)
        page.write_text(f"{before}{BEGIN}\n\n{text}\n\n{END}{after}", encoding="utf-8")
    if failed:
        raise click.ClickException(f"these failed: {', '.join(failed)}")


def timed(folder, python):
    """Yield each command of the README with its seconds, as it ends."""
    clone = ["git", "clone", "--quiet", ROOT, folder / "copy"]
    subprocess.run(clone, check=True)
    environment = None
    for block in re.findall(r"```sh\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL):
        for line in re.sub(r"\s+#.*", "", block.replace("\\\n", " ")).splitlines():
            for command in re.sub(r"\s+", " ", line).split(" && "):
                if command.startswith("pip install"):
                    environment = folder / f"environment {len(list(folder.iterdir()))}"
                    subprocess.run([python, "-m", "venv", environment], check=True)
                if not command.startswith(NOT_TIMED):
                    yield command, seconds(command, folder / "copy", environment)
                for other in ALSO if command == "pytest" else ():
                    yield other, seconds(other, folder / "copy", environment)


def seconds(command, folder, environment):
    """Return how long a command takes, or None where it fails."""
    given = {
        **os.environ,
        "PATH": os.pathsep.join([str(environment / "bin"), os.environ["PATH"]]),
        "OPTIPATH_CACHE": str(environment / "cache"),
        "PIP_DISABLE_PIP_VERSION_CHECK": "1",
    }
    begun = time.perf_counter()
    done = subprocess.run(
        ["sh", "-c", command],  # noqa: S607 - the user's own shell, as README's reader has it
        cwd=folder,
        env=given,
        capture_output=True,
        text=True,
        check=False,
    )
    taken = time.perf_counter() - begun
    click.echo(f"{taken:8.1f} s  {command}", err=True)
    if done.returncode:
        click.echo(f"{command} failed: {done.stdout[-2000:]}{done.stderr[-2000:]}", err=True)
        return None
    return taken


if __name__ == "__main__":
    main()

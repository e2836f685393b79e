"""How the command ends where signals, pipes and streams come in between, and what it serves."""

import json
import os
import signal
import socket
import subprocess
import sys
import time
import webbrowser
from urllib.request import Request, urlopen

import pytest

from optipath.cli import explore_command, main
from optipath.explorer.page_server import PageServer
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
    ("library", "as_script"),
    [
        ("difflib", 1),
        ("click", 0),
        *(pytest.param(*each, marks=pytest.mark.slow) for each in (("difflib", 0), ("numpy", 1))),
    ],
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
        (LOST, signal.SIGINT, (130, "optipath: interrupted\n")),
        (WAITS, signal.SIGTERM, (143, "")),
        *(
            pytest.param(
                text, signal.SIGINT, (130, "optipath: interrupted\n"), marks=pytest.mark.slow
            )
            for text in (WAITS, f"exec({WAITS!r})")
        ),
    ],
)
def test_a_signal_while_it_works_is_told_in_one_line_at_most(text, sent, found, tmp_path):
    environment = with_library(tmp_path, "matplotlib", text)
    chart = ["chart", "malus", "--out", str(tmp_path / "x.png")]
    assert interrupted(chart, environment, sent) == found


def test_a_script_imports_the_library_and_keeps_its_own_way_with_interrupts(tmp_path):
    (tmp_path / "script.py").write_text(
        "import optipath, signal\nprint(optipath.Source().intensity)\n"
        "print(signal.getsignal(signal.SIGINT).__name__)\n"
    )
    code = "import pathlib, runpy; runpy.run_path(pathlib.Path('script.py'))"  # As argv has it.
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    assert done.stdout == "1.0\ndefault_int_handler\n"


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


OWN = """
from dataclasses import dataclass
import optipath as op

class Halved(op.Element, kind="test-halved"):
    inputs = ("in",)
    outputs = ("out",)
    straight = True

    @staticmethod
    def mueller_rows(xp):
        half = [0.5, 0.0, 0.0, 0.0]
        return [[0.5 if row == column else 0.0 for column in range(4)] for row in range(4)]
"""


@pytest.fixture
def served(monkeypatch):
    """Serve nothing; tell what would have been."""
    found = []

    def serve(server):
        found.append(server)

    monkeypatch.setattr(PageServer, "serve_forever", serve)
    return found


@pytest.fixture
def opened(monkeypatch):
    found = []
    monkeypatch.setattr(webbrowser, "open", lambda address: found.append(address) or True)
    monkeypatch.setattr(explore_command, "Thread", AtOnce)
    return found


class AtOnce:
    """A thread that is done before it begins."""

    def __init__(self, target, args, daemon):
        assert daemon
        self.run = lambda: target(*args)

    def start(self):
        self.run()


def test_the_address_is_printed_and_opened_where_a_browser_is_wanted(capsys, served, opened):
    assert main(["explore", "malus"]) == 0
    out = capsys.readouterr().out
    assert served[0].address in out
    assert "Ctrl-C ends it" in out
    assert opened == [served[0].address]
    assert served[0].answers.presets()["opened"] == "malus"
    assert main(["explore", "--no-browser"]) == 0
    assert served[1].address in capsys.readouterr().out
    assert len(opened) == 1
    assert served[1].answers.presets()["opened"] == "npgr026"


@pytest.mark.parametrize("how", [lambda _: False, lambda _: 1 / 0])
def test_without_a_browser_the_address_is_printed_all_the_same(
    capsys, served, opened, monkeypatch, how
):
    del opened

    def fails(address):
        try:
            return how(address)
        except ZeroDivisionError:
            raise webbrowser.Error("could not locate runnable browser") from None

    monkeypatch.setattr(webbrowser, "open", fails)
    assert main(["explore"]) == 0
    out = capsys.readouterr().out
    assert served[0].address in out
    assert "no browser could be opened; open the address above" in out


def test_a_port_that_is_taken_is_told(capsys, served):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        assert main(["explore", "--no-browser", "--port", str(port)]) == 2
    told = capsys.readouterr().err
    assert told.startswith(f"optipath: port {port} cannot be listened at")
    assert told.endswith("give another, or leave --port out\n")
    assert served == []


@rows(
    "line, told",
    [
        ("mallus", "did you mean 'malus'"),
        ("none.toml", "none.toml"),
        ("malus npgr026", "'npgr026' belongs to no option"),
        ("--port 70000", "70000"),
        ("--prot 70", "--port"),
        ("bad.toml", "sauce"),
    ],
)
def test_what_cannot_be_opened_is_told_at_once(line, told, capsys, served, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    bad = 'format = 1\ndescription = "x"\n[elements.L]\nkind = "sauce"\n'
    (tmp_path / "bad.toml").write_text(bad, "utf-8")
    assert main(["explore", *line.split()]) == 2
    error = capsys.readouterr().err
    assert told in error
    assert error.count("\n") == 1 or told == "sauce"
    assert served == []


def test_elements_of_ones_own_are_traced(served, opened, tmp_path):
    del opened
    module = tmp_path / "own_halves.py"
    module.write_text(OWN, "utf-8")
    file = tmp_path / "halves.toml"
    file.write_text(
        'format = 1\ndescription = "Halved"\n'
        '[elements.L]\nkind = "source"\n[elements.H]\nkind = "test-halved"\n'
        '[elements.E]\nkind = "detector"\n'
        '[[links]]\nfrom = "L.out"\nto = "H.in"\n[[links]]\nfrom = "H.out"\nto = "E.in"\n',
        "utf-8",
    )
    assert main(["--import", str(module), "explore", str(file)]) == 0
    found = served[0].answers.trace({"preset": "halves.toml", "want": ["scene", "energy"]})
    assert found["detectors"]["E"]["texts"] == ["0.5", "0", "0", "0"]


def answer(address, **state):
    body = json.dumps({"preset": "malus", **state}).encode()
    headers = {"Content-Type": "application/json"}
    with urlopen(Request(f"{address}api/trace", body, headers), timeout=30) as found:  # noqa: S310
        return json.load(found)


def test_it_serves_until_an_interrupt_ends_it_in_one_line():
    command = [*START, "explore", "malus", "--no-browser"]
    environment = {**os.environ, "PYTHONUNBUFFERED": ""}
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment
    ) as process:
        try:
            address = process.stdout.readline().split()[-1]
            found = answer(address, values={"angle": "60 deg"})
            assert found["detectors"]["eye"]["texts"][0] == "0.125"
            process.send_signal(signal.SIGINT)
            _, told = process.communicate(timeout=60)
        finally:
            process.kill()
    assert (process.returncode, told) == (130, "optipath: interrupted\n")


def test_it_needs_no_extra():
    code = (
        "import sys; from optipath.cli import explore_command; "
        "from optipath.explorer.explored_presets import ExploredPresets; "
        "from optipath.explorer.page_answers import PageAnswers; "
        "PageAnswers(ExploredPresets()).trace({'preset': 'npgr026', "
        "'want': ['scene', 'energy', 'explanation']}); "
        "print([name for name in ('matplotlib', 'xarray', 'pandas', 'numba', 'jax', 'scipy') "
        "if name in sys.modules])"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True, text=True)
    assert ran.stdout == "[]\n"

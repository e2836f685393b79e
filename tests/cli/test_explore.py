"""``optipath explore``: what is told, what is opened, and how it ends."""

import json
import os
import signal
import socket
import subprocess
import sys
import webbrowser
from urllib.request import Request, urlopen

import pytest

from optipath.cli import explore_command, main
from optipath.explorer.page_server import PageServer
from tables import rows

START = [sys.executable, "-m", "optipath"]
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


@pytest.fixture(autouse=True)
def interrupts_are_heard():
    """In the background of a shell they are ignored, and so they are by what is started there."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


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


def test_the_address_is_printed_and_opened(capsys, served, opened):
    assert main(["explore", "malus"]) == 0
    (server,) = served
    out = capsys.readouterr().out
    assert server.address in out
    assert "Ctrl-C ends it" in out
    assert opened == [server.address]
    assert server.answers.presets()["opened"] == "malus"


def test_no_browser_is_opened_where_none_is_wanted(capsys, served, opened):
    assert main(["explore", "--no-browser"]) == 0
    assert served[0].address in capsys.readouterr().out
    assert opened == []
    assert served[0].answers.presets()["opened"] == "npgr026"


@rows("how", [lambda _: False, lambda _: 1 / 0])
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
    "arguments, told",
    [
        (["mallus"], "did you mean 'malus'"),
        (["none.toml"], "none.toml"),
        (["malus", "npgr026"], "'npgr026' belongs to no option"),
        (["--port", "70000"], "70000"),
        (["--prot", "70"], "--port"),
    ],
)
def test_what_cannot_be_opened_is_told_at_once(capsys, served, arguments, told):
    assert main(["explore", *arguments]) == 2
    error = capsys.readouterr().err
    assert told in error
    assert error.count("\n") == 1
    assert served == []


def test_faults_of_a_file_are_told_at_once(capsys, served, tmp_path):
    file = tmp_path / "bad.toml"
    file.write_text('format = 1\n[elements.L]\nkind = "sauce"\n', "utf-8")
    assert main(["explore", str(file)]) == 2
    assert "sauce" in capsys.readouterr().err
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

import json
import subprocess
import sys
from pathlib import Path

import pytest

from optipath.cli import main
from optipath.lab.accuracy import chart, critical_chart
from tables import rows

DOCS = Path(__file__).parents[2] / "docs"
QUICK = ["chart", "malus", "--engine", "numpy", "--quick"]


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def test_how_long_it_takes_is_told_before_and_progress_in_lines(capsys):
    assert main([*QUICK, "--data", "a.json"]) == 0
    first, *lines = capsys.readouterr().err.splitlines()
    assert first.startswith("this takes less than a minute")
    shares = [int(line.split(" %")[0]) for line in lines]
    assert shares[0] == 0
    assert shares == sorted(set(shares))
    assert json.loads(Path("a.json").read_text("utf-8"))["effort"]["samples"] == 3
    assert Path("chart.png").exists()


def test_the_title_says_what_was_changed(monkeypatch):
    monkeypatch.setattr(critical_chart, "DISTANCES", (1e-3, 1e-1))
    given = ["--case", "8", "--delta", "30", "--filter", "none", "--near", "normal"]
    assert main(["chart", "npgr026", *given, "--data", "a.json"]) == 0
    title = json.loads(Path("a.json").read_text("utf-8"))["title"]
    assert title == "npgr026, case 8, delta 30 deg, filter none"
    monkeypatch.setattr(chart, "REGIONS", chart.REGIONS[:1])
    assert main([*QUICK, "--angle", "30", "--data", "b.json"]) == 0
    assert json.loads(Path("b.json").read_text("utf-8"))["title"] == "malus, angle 30 deg"


def test_what_is_measured_is_kept_drawn_and_told_where_ctrl_c_ends_it(capsys, monkeypatch):
    found, errors = [], chart.path_errors

    def interrupted(*arguments):
        found.append(arguments)
        if len(found) > 40:
            raise KeyboardInterrupt
        return errors(*arguments)

    monkeypatch.setattr(chart, "path_errors", interrupted)
    monkeypatch.setattr(chart, "REGIONS", chart.REGIONS[:3])
    arguments = ["chart", "npgr026", "--case", "8", "--engine", "numpy", "--quick"]
    assert main([*arguments, "--data", "a.json", "--out", "a.svg"]) == 130
    captured = capsys.readouterr()
    assert "interrupted: 1 of 4 steps are measured, and are kept" in captured.out
    assert "wrote a.json\nwrote a.svg" in captured.out
    assert captured.err.endswith("optipath: interrupted\n")
    assert json.loads(Path("a.json").read_text("utf-8"))["regions"] == {"measured": 1, "of": 4}
    assert "interrupted: 1 of 4 regions" in Path("a.svg").read_text("utf-8")
    assert main(["chart", "--from", "a.json", "--out", "b.svg"]) == 0


def test_nothing_is_written_where_nothing_was_measured_yet(monkeypatch):
    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(chart, "many_paths", interrupted)
    assert main([*QUICK, "--data", "a.json"]) == 130
    assert list(Path().iterdir()) == []


WITHOUT_MPMATH = """
import subprocess
import sys
sys.modules["mpmath"] = None
from optipath.cli import main
sys.exit(main(sys.argv[1:]))
"""


def without_mpmath(*arguments):
    command = [sys.executable, "-c", WITHOUT_MPMATH, *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_a_chart_is_drawn_again_without_mpmath():
    done = without_mpmath("chart", "--from", str(DOCS / "chart.json"), "--out", "a.png")
    assert done.returncode == 0, done.stderr
    assert Path("a.png").read_bytes().startswith(b"\x89PNG")


def test_what_measures_says_that_it_needs_mpmath():
    done = without_mpmath(*QUICK)
    assert done.returncode == 2
    assert 'pip install "optipath[chart]"' in done.stderr


def test_errors_near_a_place_are_measured_drawn_and_drawn_again(monkeypatch):
    monkeypatch.setattr(critical_chart, "DISTANCES", (1e-3, 1e-1))
    near = ["chart", "--interface", "--near", "all", "--data", "a.json", "--out", "a.svg"]
    assert main(near) == 0
    places = json.loads(Path("a.json").read_text("utf-8"))["places"]
    assert [place["name"] for place in places] == ["brewster", "critical", "grazing", "normal"]
    assert main(["chart", "--from", "a.json", "--out", "b.svg"]) == 0
    a, b = (Path(name).read_text("utf-8") for name in ("a.svg", "b.svg"))
    assert a.count("<path") == b.count("<path")
    assert main(["chart", "npgr026", "--near", "normal", "--out", "c.svg"]) == 0


@rows(
    "arguments, message",
    [
        (["npgr026", "--near", "normal", "--quick"], "--quick is for times"),
        (["npgr026", "--near", "nirmal"], "'nirmal' is not one of"),
        (["--interface", "--near", "normal", "--quick"], "--quick is for times"),
        (["--quick", "npgr026"], "--quick stands behind the preset"),
        (["--interface", "--peers", "r.json"], "--peers stand beside a path"),
        (["--from", "r.json", "--near", "normal"], "leave them out of --from"),
        (["npgr026", "--peers", "none.json"], "none.json"),
        (["malus", "--near", "normal"], "has no interface"),
        (["npgr026", "--peers", "r.json", "--quick"], "is no whole race"),
    ],
)
def test_what_does_not_go_together_is_refused_before_anything_is_measured(
    arguments, message, capsys
):
    Path("r.json").write_text("{}", "utf-8")
    assert main(["chart", *arguments]) == 2
    captured = capsys.readouterr()
    assert message in captured.err
    assert captured.err.count("\n") == 1
    assert not Path("chart.png").exists()

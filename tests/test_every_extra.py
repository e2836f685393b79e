"""Every command and feature, with the packages of each extra alone."""

import subprocess
import sys
from pathlib import Path

import pytest

from optipath.extras import EXTRAS

SCRIPT = Path(__file__).with_name("every_extra.py")
ALONE = [("none",), *((extra,) for extra in EXTRAS if extra != "chart"), ("chart", "plot")]


@pytest.mark.parametrize("extras", [*ALONE, (*EXTRAS,)], ids=" ".join)
def test_whatever_is_missing_is_named_with_its_extra(extras):
    for package in [package for extra in extras for package in EXTRAS.get(extra, ())]:
        pytest.importorskip(package)
    done = subprocess.run(
        [sys.executable, SCRIPT, "--quick", *extras], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")

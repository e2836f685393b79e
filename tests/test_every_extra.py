"""Every command and feature, with the packages of each extra alone."""

import subprocess
import sys
from pathlib import Path

import pytest

from optipath.extras import EXTRAS
from tables import slow

SCRIPT = Path(__file__).with_name("every_extra.py")
ALONE = [(extra,) for extra in EXTRAS if extra != "chart"]
LONG = [(each,) for each in (*ALONE, ("chart", "plot"), (*EXTRAS,))]


@pytest.mark.parametrize("extras", [("none",), *map(slow, LONG)], ids=" ".join)
def test_whatever_is_missing_is_named_with_its_extra(extras):
    for package in [package for extra in extras for package in EXTRAS.get(extra, ())]:
        pytest.importorskip(package)
    done = subprocess.run(
        [sys.executable, SCRIPT, "--quick", *extras], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")

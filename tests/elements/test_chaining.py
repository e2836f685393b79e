import subprocess
import sys

import pytest

import optipath as op
from optipath.elements import chaining


def test_a_chain_without_paths_is_refused_in_words(monkeypatch):
    source, detector = op.Source(), op.Detector()
    monkeypatch.setattr(chaining, "_BEGINNINGS", [])
    with pytest.raises(op.PathError, match="from optipath import PathGraph"):
        source >> detector


def test_elements_are_chained_whatever_else_of_the_library_is_imported():
    code = (
        "from optipath import Detector, Source;print((Source(2.0) >> Detector()).trace().intensity)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "2.0"

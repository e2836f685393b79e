"""What comes before the first light: importing, loading, composing."""

import subprocess
import sys

import pytest

import optipath as op


@pytest.mark.benchmark(group="import")
@pytest.mark.parametrize("names", ["numpy, networkx", "optipath"])
def test_import(benchmark, names):
    command = [sys.executable, "-c", f"import {names}"]
    benchmark(subprocess.run, command, check=True)


@pytest.mark.benchmark(group="load a preset")
@pytest.mark.parametrize("name", op.preset_names())
def test_load(benchmark, name):
    benchmark(op.load_preset, name)


@pytest.mark.benchmark(group="compose a preset")
@pytest.mark.parametrize("name", op.preset_names())
def test_compose(benchmark, name):
    benchmark(op.Composer().compose, op.load_preset(name))


@pytest.mark.benchmark(group="the first light of a path that was just loaded")
@pytest.mark.parametrize("name", ["npgr026"])
def test_first_light(benchmark, name):
    benchmark(lambda: op.load_preset(name, case="8").trace().stokes)
